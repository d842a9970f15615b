//! A structure of several modes with several absorbers under its loads: every long-term motion along each, the structure alone
//! and tuned mass dampers beside it, and its criteria.
//!
//! For the program itself: this module may change at any time.

mod along;
mod cost;
mod dampers;
mod drift;
mod forces;
mod linear;
mod optimum;
mod orbits;
mod rest;
mod sensors;

use crate::case::{ActsOn, Load, ModalCase, PlaceCriterion, RewriteError};
use crate::contact::of_absorbers;
use crate::criteria::{Judged, all_hold};
use crate::executor::Executor;
use crate::measure::PlaceMeasure;
use crate::motions::longest_flight;
use crate::simulation::ModalStartError;
use crate::system::InvalidModalSystem;

pub use along::{AlongLoad, AtFrequency, WorstOfPlace, seconds};
pub use dampers::{DamperChoice, choices};
pub use drift::{OffStructure, off_structures};
pub use forces::{ForceLimits, ForceStep, OverForce, working_range};
pub use linear::{linear_most, linear_peak, linear_places};
pub use optimum::{JudgedAbsorbers, ModalOptimum, checks, clearance_bounds};
pub use orbits::{LoadOrbits, Stretches, orbits};
pub use sensors::sensors;

/// Why there is no answer.
#[derive(Debug, thiserror::Error)]
pub enum ModalError {
    /// A frequency of a load at which there is no structure.
    #[error(transparent)]
    System(#[from] InvalidModalSystem),
    /// Other absorbers cannot be written into the case.
    #[error(transparent)]
    Rewrite(#[from] RewriteError),
    /// A motion cannot be flown.
    #[error(transparent)]
    Start(#[from] ModalStartError),
}

/// What is known of a structure under its loads.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalAnswer {
    /// Along each load, in the order of the case.
    pub along: Vec<AlongLoad>,
    /// Its criteria.
    pub judged: Vec<JudgedPlace>,
}

/// A criterion and what it came to.
#[derive(Debug, Clone, PartialEq)]
pub struct JudgedPlace {
    /// Which place was asked about; none: every one.
    pub place: Option<usize>,
    /// The worst place and load.
    pub worst: WorstOfPlace,
    /// What it came to there; its error covers every other place and load.
    pub judged: Judged,
}

impl ModalAnswer {
    /// Of a case, searched with its starts; where impacts take time its criteria have what that makes of them.
    ///
    /// # Errors
    /// [`ModalError`] where a motion cannot be flown.
    pub fn of(case: &ModalCase, on: &dyn Executor) -> Result<Self, ModalError> {
        Self::in_no_time(case, on)?.in_contact(case, |shifted| Self::in_no_time(shifted, on))
    }

    /// The same with what it makes of the criteria that impacts take time: `again` looks at another case in the same way.
    fn in_contact(
        self,
        case: &ModalCase,
        again: impl Fn(&ModalCase) -> Result<Self, ModalError>,
    ) -> Result<Self, ModalError> {
        let worst = self.judged.iter().map(|one| &one.worst).filter(|one| !one.rests);
        let worst = worst.max_by(|a, b| a.value.total_cmp(&b.value));
        let Some(worst) = worst else { return Ok(self) };
        let Ok(system) = case.system(&case.loads[worst.load], worst.at) else { return Ok(self) };
        let Some(shifted) = case.acting_like(&of_absorbers(&system)) else { return Ok(self) };
        let there = again(&shifted)?;
        let in_contact = |(one, shifted): (JudgedPlace, &JudgedPlace)| {
            let rest = [one.worst.rests, shifted.worst.rests];
            match rest {
                // Absorbers at rest meet their walls where they are.
                [true, true] => one,
                [own, there] => JudgedPlace {
                    judged: one.judged.in_contact(&shifted.judged, own != there),
                    ..one
                },
            }
        };
        let judged = self.judged.into_iter().zip(&there.judged).map(in_contact);
        Ok(Self { judged: judged.collect(), along: self.along })
    }

    /// The same where impacts take no time.
    fn in_no_time(case: &ModalCase, on: &dyn Executor) -> Result<Self, ModalError> {
        let along = case.loads.iter().map(|load| AlongLoad::of(case, load, on));
        Ok(Self::judged(case, along.collect::<Result<_, _>>()?))
    }

    /// Of what is known along the loads of a case.
    fn judged(case: &ModalCase, along: Vec<AlongLoad>) -> Self {
        let mut answer = Self { along, judged: Vec::new() };
        answer.judged = case.criteria.iter().filter_map(|one| answer.judge(case, one)).collect();
        answer
    }

    /// The largest displacement of any place under any load without absorbers, in m.
    pub fn bare(&self) -> f64 {
        let all = self.along.iter().flat_map(|along| &along.bare);
        all.map(|[most, _]| *most).fold(0.0, f64::max)
    }

    /// The largest displacement of any place under a load, or under any.
    pub fn worst(&self, load: Option<usize>) -> Option<WorstOfPlace> {
        self.worst_of(PlaceMeasure::PEAK, None, load)
    }

    /// The worst of what is measured of a place, or of all, under a load, or under any.
    pub fn worst_of(
        &self,
        asked: PlaceMeasure,
        place: Option<usize>,
        load: Option<usize>,
    ) -> Option<WorstOfPlace> {
        let loads = self.along.iter().enumerate().filter(|(k, _)| load.is_none_or(|one| one == *k));
        let all = loads.flat_map(|(k, along)| {
            let places = 0..along.bare.len();
            let places = places.filter(move |p| place.is_none_or(|one| one == *p));
            places.filter_map(move |p| along.worst(k, p, asked))
        });
        let all: Vec<WorstOfPlace> = all.collect();
        let worst = all.iter().copied().max_by(|a, b| a.value.total_cmp(&b.value))?;
        let largest = |of: fn(&WorstOfPlace) -> f64| all.iter().map(of).fold(0.0, f64::max);
        Some(WorstOfPlace {
            error: largest(|one| one.value + one.error) - worst.value,
            settled: largest(|one| one.settled),
            all_settled: all.iter().all(|one| one.all_settled),
            ..worst
        })
    }

    fn judge(&self, case: &ModalCase, asked: &PlaceCriterion) -> Option<JudgedPlace> {
        let worst = self.worst_of(asked.measure, asked.place, None)?;
        let decided_by = worst.method();
        // What has settled may fail it, whatever else there is.
        let fails = worst.settled > asked.criterion.limit;
        let system = case.system(&case.loads[worst.load], worst.at).ok();
        let followed = system.map_or(0, |system| longest_flight(&system, case.periods) as u64);
        let undecided = (!worst.all_settled && !fails).then_some(followed);
        let judged =
            Judged::of_worst(&asked.criterion, [worst.value, worst.error], decided_by, undecided);
        let here = || self.along.iter().flat_map(|along| &along.places);
        let places = (0..case.places.len()).filter(|p| asked.place.is_none_or(|one| one == *p));
        let limit = asked.criterion.limit;
        let few = here().filter_map(|one| one.too_few(places.clone(), asked.measure, limit));
        let few = few.max_by(f64::total_cmp).filter(|_| judged.holds == Some(true));
        let judged = Judged { inactive: worst.share, but_at_rest: few, ..judged };
        Some(JudgedPlace { place: asked.place, worst, judged })
    }

    /// Every criterion as one of a single mode is told.
    pub fn criteria(&self) -> Vec<Judged> {
        self.judged.iter().map(|one| one.judged.clone()).collect()
    }

    /// Whether every criterion holds.
    pub fn all_hold(&self) -> bool {
        all_hold(&self.criteria())
    }
}

/// The mode in which a load acts, or that which is nearest to its range.
fn driven_mode(case: &ModalCase, load: &Load) -> usize {
    let off = |k: &usize| {
        let own = case.modes[*k].frequency_hz;
        let [from, to] = load.range_hz;
        libm::log(own.clamp(from, to) / own).abs()
    };
    let nearest = (0..case.modes.len()).min_by(|a, b| off(a).total_cmp(&off(b)));
    match load.on {
        ActsOn::Mode(mode) => mode,
        _ => nearest.unwrap_or_default(),
    }
}

/// For each load the worst displacement that a model of the driven mode alone has: of the mode in which the load acts, or of
/// that which is nearest to its range.
///
/// # Errors
/// [`ModalError`] where a motion cannot be flown.
pub fn modes_alone(
    case: &ModalCase,
    on: &dyn Executor,
) -> Result<Vec<Option<WorstOfPlace>>, ModalError> {
    if case.modes.len() == 1 {
        return Ok(vec![None; case.loads.len()]);
    }
    let each = case.loads.iter().enumerate().map(|(number, load)| {
        let driven = driven_mode(case, load);
        let on_mode = match load.on {
            ActsOn::Mode(_) => ActsOn::Mode(0),
            other => other,
        };
        let load = Load { on: on_mode, ..*load };
        let alone = ModalCase {
            modes: vec![case.modes[driven].clone()],
            loads: vec![load],
            ..case.clone()
        };
        let along = AlongLoad::of(&alone, &load, on)?;
        let all = (0..case.places.len()).filter_map(|p| along.worst(number, p, PlaceMeasure::PEAK));
        Ok(all.max_by(|a, b| a.value.total_cmp(&b.value)))
    });
    each.collect()
}
