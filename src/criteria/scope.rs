//! What a survey says of each criterion.

use super::{Judged, ROUNDING, Seen, Value, of_motion};
use crate::band::exact::{self, attracting};
use crate::band::{Inactive, Motions, Survey, inactive, theory};
use crate::case::{Criterion, Scales, Subject};
use crate::method::Method;
use crate::orbits::{Measures, SymmetricOrbit};
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
        let (value, by) = match criterion.subject {
            Subject::Z3Share => (Some(self.z3_share()), Method::Theory),
            Subject::StableShare => (Some(self.stable_share()), Method::ExactOrbit),
            Subject::MarginClearance => (Some(self.margin()), Method::ExactOrbit),
            Subject::NoCoexistence => (self.one_motion(), Method::Simulation),
            _ => (self.worst(criterion), Method::Simulation),
        };
        criterion.judged(value, by)
    }

    /// A place, where the range has more than one.
    fn place(&self, at: f64) -> Option<f64> {
        (!self.survey.band().is_point()).then_some(at)
    }

    /// The share in Z3, with what the theory's own error in the boundaries makes of it.
    fn z3_share(&self) -> Value {
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
        Value::known(found, off, Method::Theory)
    }

    fn stable_share(&self) -> Value {
        // All and nothing have no end that could be off.
        let error = if self.survey.motions.stability.len() > 1 { SHARE_ROUNDING } else { 0.0 };
        Value::known(self.survey.motions.stable_share(), error, Method::ExactOrbit)
    }

    fn margin(&self) -> Value {
        let (at, found) = self.survey.smallest_gap;
        Value { at: self.place(at), ..Value::known(found, ROUNDING, Method::ExactOrbit) }
    }

    /// 1 where every place has one motion, 0 where one has several; `None` where nothing was simulated.
    fn one_motion(&self) -> Option<Value> {
        let motions = &self.survey.motions;
        motions.places.first()?;
        let several = motions.places.iter().find(|place| place.count(motions.count_inactive) > 1);
        let inactive = several.filter(|_| motions.count_inactive);
        Some(Value {
            at: several.and_then(|place| self.place(place.at)),
            inactive: inactive.and_then(|place| Some(place.inactive?.share)),
            ..Value::known(f64::from(u8::from(several.is_none())), 0.0, Method::Simulation)
        })
    }

    /// The worst value of a criterion about motions; its error covers all others with theirs. `None` where
    /// nothing was simulated.
    fn worst(&self, criterion: &Criterion) -> Option<Value> {
        self.survey.motions.places.first()?;
        let all = self.worst_orbit(criterion).into_iter().chain(self.worst_inactive(criterion));
        let all: Vec<Value> = all.chain(self.simulated(criterion)).collect();
        let room = |value: &Value| criterion.room(value.found);
        let worst = *all.iter().min_by(|a, b| room(a).total_cmp(&room(b)))?;
        let least = all.iter().map(|one| room(one) - one.error).fold(f64::INFINITY, f64::min);
        Some(Value { error: room(&worst) - least, ..worst })
    }

    fn of_motion(&self, criterion: &Criterion, seen: &Seen) -> Option<[f64; 2]> {
        of_motion(criterion.subject, seen, &self.survey.rivals, &self.scales)
    }

    /// The worst of the attracting orbit, wherever there is one.
    fn worst_orbit(&self, criterion: &Criterion) -> Option<Value> {
        let Motions { band, stability, orbit, .. } = &self.survey.motions;
        let value = |at: f64, orbit: &SymmetricOrbit| {
            let system = band.system(at).ok()?;
            self.of_motion(criterion, &seen(&system, orbit, criterion.subject)?)
        };
        let at = if criterion.is_against_displacement() {
            orbit.as_ref()?.at
        } else {
            let loss = |at: f64, orbit: &SymmetricOrbit| {
                value(at, orbit).map_or(f64::NEG_INFINITY, |[found, _]| -criterion.room(found))
            };
            exact::largest_value(band, stability, loss)?.0
        };
        let [found, error] = value(at, &attracting(band, at)?)?;
        Some(Value { at: self.place(at), ..Value::known(found, error, Method::ExactOrbit) })
    }

    /// The worst of an absorber that never wakes, in closed form, wherever it can rest.
    fn worst_inactive(&self, criterion: &Criterion) -> Option<Value> {
        let Motions { band, inactive, count_inactive: true, .. } = &self.survey.motions else {
            return None;
        };
        let value = |at: f64| {
            let inactive = Inactive::of(&band.system(at).ok()?)?;
            let [found, error] = self.of_motion(criterion, &Seen::inactive(&inactive))?;
            Some(Value {
                at: self.place(at),
                inactive: Some(inactive.share),
                ..Value::known(found, error, Method::ClosedForm)
            })
        };
        let at = if criterion.is_against_displacement() {
            inactive.as_ref()?.0
        } else {
            inactive::largest_by(band, |at| value(at).map(|one| -criterion.room(one.found)))?.0
        };
        value(at)
    }

    /// The motions that starts led to; where one is the exact orbit, the orbit knows it better.
    fn simulated(&self, criterion: &Criterion) -> impl Iterator<Item = Value> {
        let motions = &self.survey.motions;
        motions.places.iter().flat_map(move |place| {
            place.beside_orbit().filter_map(move |motion| {
                let seen = Seen::simulated(motion, motions.unresolved);
                let [found, error] = self.of_motion(criterion, &seen)?;
                Some(Value {
                    at: self.place(place.at),
                    settled: motion.settled,
                    ..Value::known(found, error, Method::Simulation)
                })
            })
        })
    }
}

/// What a criterion needs of an orbit; the average only where it is asked for, as it takes as long as
/// the orbit itself.
fn seen(system: &System, orbit: &SymmetricOrbit, subject: Subject) -> Option<Seen> {
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
