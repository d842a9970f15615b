//! What criteria ask of a structure of several modes, by what is known along its loads.

use super::alternatives::designs;
use super::linear::linear_most;
use super::orbits;
use super::sensors::{Look, measured, parts};
use super::{AlongLoad, AtFrequency, ModalAnswer};
use crate::case::{Criterion, ModalCase, Of};
use crate::criteria::{Findings, Found, Judged, Worst};
use crate::linear::{ModalDamper, reduction};
use crate::measure::Measure;
use crate::method::Method;
use crate::motions::{ModalMotion, longest_flight};
use crate::numerics::scan;
use crate::orbits::{ModalOrbit, antiperiodic_orbits, stable_reach};
use crate::system::ModalParameter;

/// Pieces of a load's range in which the smallest margin of a clearance is looked for.
const PIECES: u32 = 12;

/// What is known along the loads of a case, or along one of them.
struct Scope<'a> {
    case: &'a ModalCase,
    along: &'a [AlongLoad],
    load: Option<usize>,
}

impl ModalAnswer {
    /// The largest displacement of any place under a load, or under any; none where no motion was found.
    pub fn worst(&self, case: &ModalCase, load: Option<usize>) -> Option<Worst> {
        let scope = Scope { case, along: &self.along, load };
        let peak = Criterion::at_most(Measure::Peak, 0.0)?;
        Worst::of(&scope.each(&peak), &peak)
    }

    /// What each motion that counts, under any load, has of a criterion.
    pub fn each(&self, case: &ModalCase, asked: &Criterion) -> Vec<Found> {
        Scope { case, along: &self.along, load: None }.each(asked)
    }

    /// A criterion by what is known.
    pub(super) fn judge(&self, case: &ModalCase, asked: &Criterion) -> Judged {
        let scope = Scope { case, along: &self.along, load: None };
        match asked.measure {
            Measure::StableShare => scope.stable_share(asked),
            Measure::MarginClearance => scope.margin(asked),
            _ => Judged::of_motions(asked, &scope),
        }
    }
}

/// The loads of a case where no motion is known.
pub(super) fn unflown(case: &ModalCase) -> Vec<AlongLoad> {
    case.loads.iter().map(|load| AlongLoad::at_some(*load, Vec::new(), Vec::new())).collect()
}

/// Whether a motion at a frequency of a load that counts misses a criterion: not all can hold then. What compares with dampers or the
/// structure alone is not looked at.
pub(super) fn misses(case: &ModalCase, load: usize, here: &AtFrequency) -> bool {
    let mut along = unflown(case);
    along[load].places.push(here.clone());
    let scope = Scope { case, along: &along, load: Some(load) };
    let asked = case.criteria.iter().filter(|one| one.measure.is_of_motions());
    asked.filter(|one| one.measure.against().is_none()).any(|one| {
        let found = scope.each(one);
        found.iter().any(|of| one.is_missed_by([of.value, of.own], of.known_by, of.settled))
    })
}

/// The layer that a motion is known by.
fn method(motion: &ModalMotion) -> Method {
    match (motion.rests(), motion.is_orbit) {
        (true, _) => Method::ClosedForm,
        (false, true) => Method::ExactOrbit,
        (false, false) => Method::Simulation,
    }
}

impl Scope<'_> {
    /// What the motions of a choice have of what is asked.
    fn found(
        &self,
        asked: &Criterion,
        chosen: impl Fn(&AtFrequency, &ModalMotion) -> bool,
    ) -> Vec<Found> {
        let against = against(self.case, asked);
        let mut all = Vec::new();
        let loads = self.along.iter().enumerate();
        for (load, along) in loads.filter(|(k, _)| self.load.is_none_or(|one| one == *k)) {
            for of in parts(self.case, asked.measure, asked.of) {
                let looks = Look::of(asked, of);
                let between = looks.map(|one| along.between(&one)).fold(0.0, f64::max);
                for here in &along.places {
                    let followed = self.followed(along, here);
                    let motions = here.motions.iter().enumerate();
                    for (number, motion) in motions.filter(|(_, one)| chosen(here, one)) {
                        let number_of =
                            |between: f64| self.value(motion, of, asked, against, between);
                        let between = if motion.rests() { 0.0 } else { between };
                        let (Some([value, error]), Some([_, own])) =
                            (number_of(between), number_of(0.0))
                        else {
                            continue;
                        };
                        all.push(Found {
                            value,
                            error,
                            own,
                            load,
                            at: Some(here.at),
                            of,
                            motion: number,
                            known_by: method(motion),
                            settled: motion.settled,
                            followed,
                            resting: std::array::from_fn(|j| {
                                motion.resting.get(j).is_some_and(Option::is_some)
                            }),
                            rest: motion.rest_share(),
                        });
                    }
                }
            }
        }
        all
    }

    /// Excitation periods that a start is flown for at most.
    fn followed(&self, along: &AlongLoad, here: &AtFrequency) -> u64 {
        let system = self.case.system(&along.load, here.at);
        system.map_or(0, |system| longest_flight(&system, self.case.periods) as u64)
    }

    /// What is asked of a part in a motion, with its error, which is at least what may lie between the frequencies.
    fn value(
        &self,
        motion: &ModalMotion,
        of: Of,
        asked: &Criterion,
        against: f64,
        between: f64,
    ) -> Option<[f64; 2]> {
        let [value, error] = measured(self.case, motion, of, asked.measure)?;
        let known = [value, error.max(between)];
        match asked.measure.against() {
            None => Some(known),
            // What nothing limits says nothing.
            Some(_) => against.is_finite().then(|| reduction(known, against)),
        }
    }

    /// The share of the range of a load in which an exact orbit attracts that impacts on every absorber twice a period, of the load
    /// where it is least.
    fn stable_share(&self, asked: &Criterion) -> Judged {
        let each = self.along.iter().enumerate().map(|(number, along)| {
            let share = orbits::stable_share(self.case, &along.load).unwrap_or_default();
            (number, share)
        });
        let (load, share) = each.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default();
        Judged::of_stability(asked, share, load, None)
    }

    /// By which share the clearance of one absorber may be off, at any frequency of any load, before such an orbit is lost.
    fn margin(&self, asked: &Criterion) -> Judged {
        let each = self.along.iter().enumerate().map(|(number, along)| {
            let (at, gap) =
                scan::smallest(along.load.range_hz, PIECES, |at| gap(self.case, along, at));
            (number, at, gap)
        });
        let least = each.min_by(|a, b| a.2.total_cmp(&b.2));
        let (load, at, gap) = least.unwrap_or_default();
        Judged::of_stability(asked, gap, load, Some(at))
    }
}

impl Findings for Scope<'_> {
    fn each(&self, asked: &Criterion) -> Vec<Found> {
        self.found(asked, |here, motion| motion.counts(here.count_rest))
    }

    fn too_few(&self, asked: &Criterion) -> Vec<Found> {
        self.found(asked, |here, motion| here.count_rest && !motion.counts(true))
    }
}

/// The largest displacement that a criterion compares with, in m: that of its place, or of any, under all loads; not a number where it
/// compares nothing.
pub(super) fn against(case: &ModalCase, asked: &Criterion) -> f64 {
    let peak = Criterion::at_most(Measure::Peak, 0.0);
    let peak = peak.map(|peak| Criterion { of: asked.of, ..peak });
    let with = |dampers: &[ModalDamper]| {
        let most = peak.as_ref().and_then(|peak| linear_most(case, peak, dampers));
        most.unwrap_or(f64::NAN)
    };
    let damped = || {
        // The best of what moves, whatever else is asked.
        let case = ModalCase { criteria: Vec::new(), ..case.clone() };
        designs(&case).iter().map(|one| with(&one.on(&case, 1.0))).fold(f64::NAN, f64::min)
    };
    asked.measure.compared_with(|| with(&[]), damped)
}

/// By which share a clearance may be off at a frequency in Hz before an orbit no longer attracts, of the orbit that allows most; 0 where
/// none attracts.
fn gap(case: &ModalCase, along: &AlongLoad, at: f64) -> f64 {
    /// How far it is looked, over the clearance.
    const RANGE: [f64; 2] = [0.25, 4.0];
    let Ok(system) = case.system(&along.load, at) else { return 0.0 };
    let of = |orbit: &ModalOrbit| {
        let each = system.absorbers().iter().enumerate().map(|(j, one)| {
            let range = RANGE.map(|part| part * one.clearance);
            let ends = stable_reach(&system, orbit, ModalParameter::Clearance(j), range);
            let room = |value: f64| (value / one.clearance - 1.0).abs();
            ends.map_or(0.0, |ends| {
                ends.map(|end| room(end.value)).into_iter().fold(f64::INFINITY, f64::min)
            })
        });
        each.fold(f64::INFINITY, f64::min)
    };
    let stable = antiperiodic_orbits(&system).into_iter().filter(ModalOrbit::stable);
    stable.map(|orbit| of(&orbit)).fold(0.0, f64::max)
}
