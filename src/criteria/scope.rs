//! What a survey says of each criterion.

use super::{Judged, ROUNDING, Seen, of_motion};
use crate::band::exact::{self, attracting};
use crate::band::{Inactive, Motions, Survey, inactive, theory};
use crate::case::{Criterion, Scales, Subject};
use crate::method::Method;
use crate::orbits::{Measures, SteadyOrbit};
use crate::system::System;
use crate::validation::tolerance::asymptotic_error;

/// Places of a band at which the theory's own error is asked for.
const PLACES: u32 = 25;
/// Error of a share whose ends are roots: their rounding.
const SHARE_ROUNDING: f64 = 1e-9;

/// A survey and the units of its case.
pub(super) struct Scope<'a> {
    pub(super) survey: &'a Survey,
    pub(super) scales: Scales,
}

impl Scope<'_> {
    /// Judges one criterion.
    pub(super) fn judge(&self, criterion: &Criterion) -> Judged {
        match criterion.subject {
            Subject::Z3Share => self.z3_share(criterion),
            Subject::StableShare => {
                // All and nothing have no end that could be off.
                let ends = self.survey.motions.stability.len() > 1;
                let error = if ends { SHARE_ROUNDING } else { 0.0 };
                let share = self.survey.motions.stable_share();
                criterion.judged(Some(share), error, Method::ExactOrbit)
            }
            Subject::MarginClearance => {
                let (at, found) = self.survey.smallest_gap;
                let judged = criterion.judged(Some(found), ROUNDING, Method::ExactOrbit);
                Judged { at: self.place(at), ..judged }
            }
            // Where nothing was simulated, nothing is known of motions.
            _ if self.survey.motions.places.is_empty() => {
                criterion.judged(None, 0.0, Method::Simulation)
            }
            Subject::NoCoexistence => self.one_motion(criterion),
            _ => self.worst(criterion),
        }
    }

    /// A place, where the range has more than one.
    fn place(&self, at: f64) -> Option<f64> {
        (!self.survey.band().is_point()).then_some(at)
    }

    /// The share in Z3, with what the theory's own error in the boundaries makes of it.
    fn z3_share(&self, criterion: &Criterion) -> Judged {
        let band = self.survey.band();
        let share = |factor: f64| {
            let base = band.base.with_clearance_scaled(factor).unwrap_or(band.base);
            let band = band.with_base(base);
            band.share(&theory::zones(&band), |zone| zone.is_z3())
        };
        let found = self.survey.z3_share();
        let error = band
            .places(PLACES)
            .filter_map(|at| band.system(at).ok())
            .map(|system| asymptotic_error(&system))
            .fold(0.0, f64::max);
        let shifted = [1.0 - error.min(0.9), 1.0 + error].map(share);
        let off =
            shifted.map(|other| (other - found).abs()).into_iter().fold(SHARE_ROUNDING, f64::max);
        criterion.judged(Some(found), off, Method::Theory)
    }

    /// 1 where every place has one motion, 0 where one has several.
    fn one_motion(&self, criterion: &Criterion) -> Judged {
        let motions = &self.survey.motions;
        let several = motions.places.iter().find(|place| place.count(motions.count_inactive) > 1);
        let inactive = several.filter(|_| motions.count_inactive);
        let found = Some(f64::from(u8::from(several.is_none())));
        Judged {
            at: several.and_then(|place| self.place(place.at)),
            inactive: inactive.and_then(|place| Some(place.inactive?.share)),
            ..criterion.judged(found, 0.0, Method::Simulation)
        }
    }

    /// The worst value of a criterion about motions; its error covers all others with theirs.
    fn worst(&self, criterion: &Criterion) -> Judged {
        let all = self.worst_orbit(criterion).into_iter().chain(self.worst_inactive(criterion));
        let all: Vec<Judged> = all.chain(self.simulated(criterion)).collect();
        let room = |one: &Judged| one.margin.unwrap_or(f64::INFINITY);
        let Some(worst) = all.iter().min_by(|a, b| room(a).total_cmp(&room(b))) else {
            return criterion.judged(None, 0.0, Method::Simulation);
        };
        let least = all.iter().map(|one| room(one) - one.error).fold(f64::INFINITY, f64::min);
        let Judged { at, inactive, settled, .. } = *worst;
        let judged = criterion.judged(worst.found, room(worst) - least, worst.decided_by);
        Judged { at, inactive, settled, ..judged }
    }

    fn of_motion(&self, criterion: &Criterion, seen: &Seen) -> Option<[f64; 2]> {
        of_motion(criterion.subject, seen, &self.survey.rivals, &self.scales)
    }

    /// The worst of the attracting orbit, wherever there is one.
    fn worst_orbit(&self, criterion: &Criterion) -> Option<Judged> {
        let Motions { band, stability, orbit, .. } = &self.survey.motions;
        let value = |at: f64, orbit: &SteadyOrbit| {
            let system = band.system(at).ok()?;
            self.of_motion(criterion, &seen(&system, orbit, criterion.subject)?)
        };
        let at = if criterion.is_against_displacement() {
            orbit.as_ref()?.at
        } else {
            let loss = |at: f64, orbit: &SteadyOrbit| {
                value(at, orbit).map_or(f64::NEG_INFINITY, |[found, _]| -criterion.room(found))
            };
            exact::largest_value(band, stability, loss)?.0
        };
        let [found, error] = value(at, &attracting(band, at)?)?;
        let judged = criterion.judged(Some(found), error, Method::ExactOrbit);
        Some(Judged { at: self.place(at), ..judged })
    }

    /// The worst of an absorber that never wakes, in closed form, wherever it can rest.
    fn worst_inactive(&self, criterion: &Criterion) -> Option<Judged> {
        let Motions { band, inactive, count_inactive: true, .. } = &self.survey.motions else {
            return None;
        };
        let sag = Inactive::sag(&band.base);
        let value = |amplitude: f64| {
            let [found, error] = self.of_motion(criterion, &Seen::inactive(amplitude, sag))?;
            Some(criterion.judged(Some(found), error, Method::ClosedForm))
        };
        let at = if criterion.is_against_displacement() {
            inactive.as_ref()?.0
        } else {
            let loss = |amplitude: f64| value(amplitude)?.margin.map(|room| -room);
            inactive::largest_by(band, loss)?.0
        };
        let there = Inactive::of(&band.system(at).ok()?)?;
        let judged = value(there.amplitude)?;
        Some(Judged { at: self.place(at), inactive: Some(there.share), ..judged })
    }

    /// The motions that starts led to; where one is the exact orbit, the orbit knows it better.
    fn simulated(&self, criterion: &Criterion) -> impl Iterator<Item = Judged> {
        let motions = &self.survey.motions;
        motions.places.iter().flat_map(move |place| {
            place.beside_orbit().filter_map(move |motion| {
                let seen = Seen::simulated(motion, motions.unresolved);
                let [found, error] = self.of_motion(criterion, &seen)?;
                Some(Judged {
                    at: self.place(place.at),
                    settled: motion.settled,
                    ..criterion.judged(Some(found), error, Method::Simulation)
                })
            })
        })
    }
}

/// What a criterion needs of an orbit; the average only where it is asked for, as it takes as long as
/// the orbit itself.
fn seen(system: &System, orbit: &SteadyOrbit, subject: Subject) -> Option<Seen> {
    let rms = match subject {
        Subject::RmsDisplacement => Measures::of(system, &orbit.orbit.cycle).ok()?.rms,
        _ => f64::NAN,
    };
    let rounded = |value: f64| [value, ROUNDING * value];
    Some(Seen {
        peak: rounded(orbit.peaks.displacement),
        rms: rounded(rms),
        impact_speed: rounded(orbit.impact_speed),
        impacts_per_period: [2.0, 0.0],
    })
}
