//! The numbers of a motion, each with how far it may be off.

use std::f64::consts::SQRT_2;

use serde::Serialize;

use crate::numerics::scatter::{
    LONGER, error_of_largest, error_of_root, twice_error_of_mean, twice_standard_error,
};
use crate::orbits::{ImpactMap, Measures, Orbit, OrbitError, SteadyOrbit};
use crate::regimes::Evidence;
use crate::simulation::{Course, PeriodRecord, Statistics, lost_in};
use crate::system::{Shaking, System};

/// Relative rounding of what is computed along an orbit that is hardly disturbed, and of one that is disturbed in
/// proportion: the defect that Newton's method leaves grows by the distance of the largest multiplier from 1, at a
/// bifurcation to its root.
const ROUNDING: f64 = 1e-12;
const DEFECT: f64 = 1e-14;
const ROOT_OF_DEFECT: f64 = 1e-7;

/// A number and its error.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Value {
    /// The number.
    pub value: f64,
    /// How far it may be off; of a largest value how much larger it may be.
    pub error: f64,
}

impl Value {
    /// A number with its error.
    pub const fn new(value: f64, error: f64) -> Self {
        Self { value, error }
    }

    /// One without any.
    pub const fn exact(value: f64) -> Self {
        Self::new(value, 0.0)
    }
}

/// What is known of every motion. Lengths over the clearance, fast time.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Facts {
    /// Largest absolute displacement of the oscillator. Of a motion that wanders the largest that was seen; its error is
    /// by how much a run ten times as long as the window of its search may exceed it, at odds of 19 to 1.
    pub peak: Value,
    /// Root mean square displacement of the oscillator; of a motion that wanders with two standard errors.
    pub rms: Value,
    /// Largest relative speed of an impact, with an error as that of the peak.
    pub impact_speed: Value,
    /// Impacts per excitation period, with an error as that of the root mean square.
    pub impacts_per_period: Value,
    /// Visits to a wall per excitation period: a chattering sequence that ends in sustained contact is one.
    pub visits_per_period: f64,
    /// Share of the excitation's work that impacts dissipate, neither friction nor the damper; none where it does no work.
    pub efficiency: Option<Value>,
    /// Velocity and acceleration of the oscillator between impacts, errors as those of peak and root mean square; none where
    /// the search was not asked for them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shaking: Option<Shaking<Value>>,
}

impl Facts {
    /// Of an orbit, which rounding alone separates from what it says.
    pub(super) fn of_orbit(system: &System, orbit: &Orbit) -> Result<Self, OrbitError> {
        let map = ImpactMap::of(system)?;
        let (cycle, measures) = (&orbit.cycle, Measures::of(system, &orbit.cycle)?);
        let leaves = (1.0 - orbit.radius_per_period()).abs();
        let relative = ROUNDING.max((DEFECT / leaves.max(f64::EPSILON)).min(ROOT_OF_DEFECT));
        let rounded = |value: f64| Value::new(value, relative * value);
        let impacts = cycle.impact_count() as f64 / f64::from(cycle.periods());
        let energy = measures.energy;
        let work = energy.damper + energy.impact + energy.friction;
        Ok(Self {
            peak: rounded(measures.peaks.displacement),
            rms: rounded(measures.rms),
            impact_speed: rounded(SteadyOrbit::impact_speed_of(&map, cycle)),
            impacts_per_period: Value::exact(impacts),
            visits_per_period: impacts,
            efficiency: (work > 0.0).then(|| rounded(energy.impact / work)),
            shaking: None,
        })
    }

    /// Of a sine about a place that the absorber's weight shifts.
    pub(super) fn of_sine(amplitude: f64, shift: f64) -> Self {
        Self {
            peak: Value::exact(amplitude + shift),
            rms: Value::exact(libm::hypot(amplitude / SQRT_2, shift)),
            efficiency: (amplitude > 0.0).then_some(Value::exact(0.0)),
            ..Self::default()
        }
    }

    /// What statistics tell of a window; of its last repetition alone, in which nothing is stored, if the motion repeats.
    pub(super) fn measured(statistics: &Statistics, evidence: &Evidence) -> Self {
        // What repeats has no scatter, whose error takes some time to find.
        let wanders = evidence.periodicity.is_none();
        let nothing = || [0.0; 2];
        let [peak_error, speed_error] =
            if wanders { statistics.errors_of_largest() } else { nothing() };
        let [rms_error, impacts_error] = if wanders { statistics.errors() } else { nothing() };
        // Of a free vibration the work of the excitation is no number.
        let driven = statistics.energy().input != 0.0;
        let of_share = |[share, error]: [f64; 2]| Value::new(share, error);
        let efficiency = || statistics.efficiency().filter(|_| driven).map(of_share);
        let seen = Self {
            peak: Value::new(statistics.peak(), peak_error),
            rms: Value::new(statistics.rms(), rms_error),
            impact_speed: Value::new(statistics.impact_speed(), speed_error),
            impacts_per_period: Value::new(evidence.impacts_per_period, impacts_error),
            visits_per_period: evidence.visits_per_period,
            efficiency: if wanders { efficiency() } else { None },
            shaking: None,
        };
        let Some(found) = evidence.periodicity else { return seen };
        let records = statistics.records();
        let last = found.last(records);
        let before = records.len().checked_sub(last.len() + 1).map(|k| records[k]);
        let [dissipated, impact] = lost_in(before, last);
        // What is left of a transient changes a repetition by its closure.
        let closed = |value: f64| Value::new(value, found.closure * value);
        let largest = |value: fn(&PeriodRecord) -> f64| last.iter().map(value).fold(0.0, f64::max);
        let mean_square = last.iter().map(|record| record.mean_square).sum::<f64>();
        Self {
            peak: closed(largest(|record| record.peak)),
            rms: closed((mean_square / f64::from(found.periods)).sqrt()),
            impact_speed: closed(largest(|record| record.impact_speed)),
            impacts_per_period: Value::exact(evidence.impacts_per_period),
            efficiency: (driven && dissipated > 0.0).then(|| closed(impact / dissipated)),
            ..seen
        }
    }

    /// The same where what changes in a repetition is this part of how far it still is from the end.
    pub(super) fn within(self, part: f64) -> Self {
        let far = |of: Value| Value::new(of.value, of.error / part);
        Self {
            peak: far(self.peak),
            rms: far(self.rms),
            impact_speed: far(self.impact_speed),
            efficiency: self.efficiency.map(far),
            ..self
        }
    }

    /// Of several windows of one motion: averages of averages, the largest of largest values, and the errors of what all of
    /// them have seen, a largest value for a run ten times as long as so many `periods`.
    pub(super) fn pooled(all: &[(Self, &Course)], periods: u64) -> Self {
        let count = all.len().max(1) as f64;
        let mean =
            |of: &dyn Fn(&Self) -> f64| all.iter().map(|one| of(&one.0)).sum::<f64>() / count;
        let seen = all.iter().map(|(_, course)| course.peak.len()).sum::<usize>().max(1) as f64;
        let longer = LONGER * periods as f64 / seen;
        let windows = |of: fn(&Course) -> &Vec<f64>| -> Vec<&[f64]> {
            all.iter().map(|(_, course)| of(course).as_slice()).collect()
        };
        let largest = |of: fn(&Self) -> Value, course: fn(&Course) -> &Vec<f64>| {
            let value = all.iter().map(|one| of(&one.0).value).fold(0.0, f64::max);
            Value::new(value, error_of_largest(&windows(course), longer))
        };
        let rms = mean(&|one| one.rms.value * one.rms.value).sqrt();
        let square = twice_error_of_mean(&windows(|one| &one.mean_square));
        let work: Option<Vec<Value>> = all.iter().map(|one| one.0.efficiency).collect();
        let share = work.map(|shares| {
            let values: Vec<f64> = shares.iter().map(|one| one.value).collect();
            let error = shares.iter().map(|one| one.error * one.error).sum::<f64>().sqrt() / count;
            let apart = if shares.len() < 2 { 0.0 } else { twice_standard_error(&values) };
            Value::new(values.iter().sum::<f64>() / count, error.max(apart))
        });
        Self {
            peak: largest(|one| one.peak, |one| &one.peak),
            rms: Value::new(rms, error_of_root(rms, square)),
            impact_speed: largest(|one| one.impact_speed, |one| &one.impact_speed),
            impacts_per_period: Value::new(
                mean(&|one| one.impacts_per_period.value),
                twice_error_of_mean(&windows(|one| &one.impacts)),
            ),
            visits_per_period: mean(&|one| one.visits_per_period),
            efficiency: share,
            shaking: None,
        }
    }
}
