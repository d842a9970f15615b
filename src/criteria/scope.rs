//! The range in which a case's criteria are asked about, and what is known of it so far: a band, or
//! the case's own excitation alone.

use std::cell::OnceCell;

use super::{Judged, ROUNDING, Seen, Value, of_motion};
use crate::band::exact::{self, attracting};
use crate::band::rivals;
use crate::band::simulated::{self, Place};
use crate::band::{Band, Stretch, Survey, margin, theory};
use crate::case::{Case, Criterion, Scales, Subject};
use crate::orbits::{Measures, SymmetricOrbit};
use crate::regimes::long_term::{Effort, motions};
use crate::simulation::StartError;
use crate::study::fidelity::Fidelity;
use crate::system::System;
use crate::validation::tolerance::asymptotic_error;

/// Places of a band at which the theory's own error is asked for.
const PLACES: u32 = 25;
/// Error of a share whose ends are roots: their rounding.
const SHARE_ROUNDING: f64 = 1e-9;

/// The range, and what is known of it so far.
pub struct Scope {
    band: Band,
    /// Whether it is a band, and not one excitation.
    ranges: bool,
    scales: Scales,
    /// The largest amplitudes along the range of the bare oscillator and of one with the best tuned
    /// mass damper, over the clearance; infinite where nothing limits them.
    rivals: [f64; 2],
    stability: OnceCell<Vec<Stretch<bool>>>,
    simulated: OnceCell<Vec<Place>>,
}

impl Scope {
    /// That of a case; what a survey of its band knows is not found again.
    pub fn of(case: &Case, known: Option<&Survey>) -> Self {
        let system = case.system();
        let band = case
            .band
            .as_ref()
            .map_or_else(|| Band::point(&system), |settings| Band::of(&system, settings));
        let simulated = known.map(|survey| &survey.simulated).filter(|places| !places.is_empty());
        Self {
            rivals: rivals::largest_amplitudes(&band),
            band,
            ranges: case.band.is_some(),
            scales: case.scales(),
            stability: known.map_or_else(OnceCell::new, |survey| survey.stability.clone().into()),
            simulated: simulated.map_or_else(OnceCell::new, |places| places.clone().into()),
        }
    }

    /// Judges one criterion.
    ///
    /// # Errors
    /// [`StartError`] where a start of a simulation is not finite.
    pub fn judge(&self, criterion: &Criterion) -> Result<Judged, StartError> {
        let (value, by) = match criterion.subject {
            Subject::Z3Share => (Some(self.z3_share()), Fidelity::Manifold),
            Subject::StableShare => (Some(self.stable_share()), Fidelity::Orbit),
            Subject::MarginClearance => (Some(self.margin()), Fidelity::Orbit),
            Subject::NoCoexistence => (self.one_motion()?, Fidelity::Simulation),
            _ => (self.worst(criterion)?, Fidelity::Simulation),
        };
        Ok(criterion.judged(value, by))
    }

    /// The share in Z3, with what the theory's own error in the boundaries makes of it.
    fn z3_share(&self) -> Value {
        let share = |factor: f64| {
            let base = self.band.base.with_clearance_scaled(factor).unwrap_or(self.band.base);
            let band = self.band.with_base(base);
            band.share(&theory::zones(&band), |zone| zone.is_z3())
        };
        let found = share(1.0);
        let places = self.band.places(PLACES);
        let error = places
            .filter_map(|at| self.band.system(at).ok())
            .map(|system| asymptotic_error(&system))
            .fold(0.0, f64::max);
        let shifted = [1.0 - error.min(0.9), 1.0 + error].map(share);
        let off =
            shifted.map(|other| (other - found).abs()).into_iter().fold(SHARE_ROUNDING, f64::max);
        Value { found, error: off, at: None, by: Fidelity::Manifold }
    }

    fn stable_share(&self) -> Value {
        let found = self.band.share(self.stability(), |stable| *stable);
        // All and nothing have no end that could be off.
        let error = if self.stability().len() > 1 { SHARE_ROUNDING } else { 0.0 };
        Value { found, error, at: None, by: Fidelity::Orbit }
    }

    fn margin(&self) -> Value {
        let middle = 0.5 * (self.band.range[0] + self.band.range[1]);
        let (at, found) = if self.ranges {
            let (at, gap) = margin::smallest(&self.band);
            (Some(at), gap)
        } else {
            (None, margin::Gap::of(&self.band, middle).map_or(0.0, |gap| gap.smaller()))
        };
        Value { found, error: ROUNDING, at, by: Fidelity::Orbit }
    }

    /// 1 where every place has one motion, 0 where one has several.
    fn one_motion(&self) -> Result<Option<Value>, StartError> {
        let several = self.simulated()?.iter().find(|place| place.motions.len() > 1);
        let at = several.map(|place| place.at).filter(|_| self.ranges);
        let found = f64::from(u8::from(several.is_none()));
        Ok(Some(Value { found, error: 0.0, at, by: Fidelity::Simulation }))
    }

    /// The worst value of a criterion about motions.
    fn worst(&self, criterion: &Criterion) -> Result<Option<Value>, StartError> {
        let exact = self.worst_exact(criterion);
        let both = exact.into_iter().chain(self.worst_simulated(criterion)?);
        Ok(both.min_by(|a, b| criterion.room(a.found).total_cmp(&criterion.room(b.found))))
    }

    /// The worst of the attracting orbit, wherever there is one.
    fn worst_exact(&self, criterion: &Criterion) -> Option<Value> {
        let value = |at: f64, orbit: &SymmetricOrbit| {
            let system = self.band.system(at).ok()?;
            let seen = seen(&system, orbit, criterion.subject)?;
            of_motion(criterion.subject, &seen, self.rivals, &self.scales)
        };
        let loss = |at: f64, orbit: &SymmetricOrbit| {
            value(at, orbit).map_or(f64::NEG_INFINITY, |(found, _)| -criterion.room(found))
        };
        let (place, _) = exact::largest_value(&self.band, self.stability(), loss)?;
        let (found, error) = value(place, &attracting(&self.band, place)?)?;
        let at = Some(place).filter(|_| self.ranges);
        Some(Value { found, error, at, by: Fidelity::Orbit })
    }

    /// The worst of the motions that starts led to; where that is the exact orbit's, the orbit knows it
    /// better.
    fn worst_simulated(&self, criterion: &Criterion) -> Result<Option<Value>, StartError> {
        let mut worst: Option<Value> = None;
        for Place { at, motions } in self.simulated()? {
            let orbit = attracting(&self.band, *at);
            for motion in motions.iter().filter(|one| {
                !orbit
                    .as_ref()
                    .is_some_and(|orbit| one.is_orbit_with_peak(orbit.peaks.displacement))
            }) {
                let Some((found, error)) =
                    of_motion(criterion.subject, &Seen::from(motion), self.rivals, &self.scales)
                else {
                    continue;
                };
                let at = Some(*at).filter(|_| self.ranges);
                if worst.is_none_or(|known| criterion.room(found) < criterion.room(known.found)) {
                    worst = Some(Value { found, error, at, by: Fidelity::Simulation });
                }
            }
        }
        Ok(worst)
    }

    fn stability(&self) -> &[Stretch<bool>] {
        self.stability.get_or_init(|| exact::stability(&self.band))
    }

    /// The motions along the band, or at the case's own excitation.
    fn simulated(&self) -> Result<&[Place], StartError> {
        if self.simulated.get().is_none() {
            let effort = Effort::default();
            let found = if self.ranges {
                simulated::along(&self.band, self.stability(), &effort)?
            } else {
                let at = self.band.base.frequency_ratio();
                let found = motions(&[self.band.base], &effort)?;
                found.into_iter().map(|motions| Place { at, motions }).collect()
            };
            return Ok(self.simulated.get_or_init(|| found));
        }
        Ok(self.simulated.get().map_or(&[], Vec::as_slice))
    }
}

/// What a criterion needs of an orbit; the average only where it is asked for, as it takes as long as
/// the orbit itself.
fn seen(system: &System, orbit: &SymmetricOrbit, subject: Subject) -> Option<Seen> {
    let rms = match subject {
        Subject::RmsDisplacement => Measures::of(system, &orbit.orbit.cycle).ok()?.rms,
        _ => f64::NAN,
    };
    Some(Seen {
        peak: orbit.peaks.displacement,
        rms,
        impact_speed: orbit.impact_speed,
        impacts_per_period: 2.0,
        error: ROUNDING,
        impacts_error: 0.0,
    })
}
