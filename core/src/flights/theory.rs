//! What theory says of a decay: the closed form where the absorber makes two symmetric impacts per oscillation all the
//! way, else the slow flow on the dissipation curve, above and below that.

use std::f64::consts::TAU;

use crate::analysis::FreeDecay;
use crate::dissipation::{AveragedFlow, DissipationCurve};
use crate::method::Method;
use crate::system::System;

/// A predicted decay; its error is of first order in the mass ratio.
#[derive(Debug, Clone, PartialEq)]
pub struct Predicted {
    /// Oscillations since the start, and the amplitude over the clearance, falling.
    pub path: Vec<[f64; 2]>,
    /// Oscillations until the amplitude is at the level; infinite where nothing takes the energy, none from beyond
    /// [`Predicted::LARGEST`] and in a cavity that is not ideal.
    pub oscillations: Option<f64>,
    /// The amplitude at which capture ends, over the clearance: below it impacts are few.
    pub residual: f64,
    /// The closed form, or the slow flow on the dissipation curve.
    pub method: Method,
}

/// Points of a path in closed form.
const POINTS: u32 = 60;
/// By how much the curve is computed beyond the ends of a decay, relatively.
const BEYOND: f64 = 0.02;

impl Predicted {
    /// Largest amplitude that a decay is predicted from, over the clearance: the curve takes a second up to there, and
    /// its impacts per oscillation grow with the amplitude.
    pub const LARGEST: f64 = 12.0;

    /// Amplitude, over the clearance, below which impacts are so rare that no average knows them.
    pub const SMALLEST: f64 = 0.05;

    /// No prediction.
    pub fn none(system: &System) -> Self {
        let residual = FreeDecay::of(system).residual_amplitude();
        Self { path: Vec::new(), oscillations: None, residual, method: Method::Theory }
    }

    /// The decay from an amplitude down to a level, both over the clearance.
    pub fn of(system: &System, from: f64, level: f64) -> Self {
        // Neither theory knows of gravity, friction and ends that differ.
        if !system.cavity().is_ideal() {
            return Self::none(system);
        }
        let decay = FreeDecay::of(system);
        let residual = decay.residual_amplitude();
        let closed = from <= decay.largest_amplitude() && level >= residual || from <= residual;
        let method = if closed { Method::ClosedForm } else { Method::Theory };
        if from > Self::LARGEST {
            return Self { method, ..Self::none(system) };
        }
        // An absorber that is not caught leaves the structure to its own damping.
        let active = if from <= residual { from } else { level.max(Self::SMALLEST.min(residual)) };
        let mut path = active_decay(system, &decay, [from, active], closed);
        let there = path.last().filter(|[_, reached]| *reached <= active * (1.0 + END));
        let oscillations = there.map_or(f64::INFINITY, |[time, _]| *time);
        if active > level && oscillations.is_finite() {
            let rate = 0.5 * system.damping() * system.mass_ratio() * TAU;
            let alone = |k: u32| {
                let part = f64::from(k) / f64::from(POINTS) * libm::log(active / level);
                [oscillations + part / rate, active * libm::exp(-part)]
            };
            path.extend((1..=POINTS).map(alone));
        }
        let there = path.last().filter(|[_, reached]| *reached <= level * (1.0 + END));
        let oscillations = Some(there.map_or(f64::INFINITY, |[time, _]| *time));
        path.retain(|[time, _]| time.is_finite());
        Self { path, oscillations, residual, method }
    }
}

/// Oscillations and amplitudes while the absorber is caught, or its impacts are known on average.
fn active_decay(
    system: &System,
    decay: &FreeDecay,
    [from, to]: [f64; 2],
    closed: bool,
) -> Vec<[f64; 2]> {
    let oscillation = system.mass_ratio() * TAU;
    if from == to {
        return vec![[0.0, from]];
    }
    if closed {
        let place = |k: u32| {
            let amplitude = from * libm::pow(to / from, f64::from(k) / f64::from(POINTS));
            let time = decay.time(from, amplitude.clamp(to, from))?;
            Some([time / oscillation, amplitude])
        };
        return (0..=POINTS).filter_map(place).collect();
    }
    let range = [(1.0 - BEYOND) * to, (1.0 + BEYOND) * from];
    let curve = DissipationCurve::of(system.restitution(), range);
    let path = AveragedFlow::of(system, &curve).decay(from, to);
    path.iter().map(|at| [at.slow_time / oscillation, at.amplitude]).collect()
}

/// How near to the level, relatively, a path in steps of amplitude ends.
const END: f64 = 1e-6;
