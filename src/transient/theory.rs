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
    /// Oscillations until the amplitude is at the level; infinite where nothing takes the energy.
    pub oscillations: f64,
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
    /// The decay from an amplitude down to a level, both over the clearance.
    pub fn of(system: &System, from: f64, level: f64) -> Self {
        let decay = FreeDecay::of(system);
        let residual = decay.residual_amplitude();
        let oscillation = system.mass_ratio() * TAU;
        let closed = from <= decay.largest_amplitude() && level >= residual;
        let path: Vec<[f64; 2]> = if closed {
            let place = |k: u32| {
                let amplitude = from * libm::pow(level / from, f64::from(k) / f64::from(POINTS));
                let time = decay.time(from, amplitude.clamp(level, from))?;
                Some([time / oscillation, amplitude])
            };
            (0..=POINTS).filter_map(place).collect()
        } else {
            let range = [(1.0 - BEYOND) * level, (1.0 + BEYOND) * from];
            let curve = DissipationCurve::of(system.restitution(), range);
            let path = AveragedFlow::of(system, &curve).decay(from, level);
            path.iter().map(|at| [at.slow_time / oscillation, at.amplitude]).collect()
        };
        let there = path
            .last()
            .filter(|[time, reached]| time.is_finite() && *reached <= level * (1.0 + END));
        let oscillations = there.map_or(f64::INFINITY, |[time, _]| *time);
        let method = if closed { Method::ClosedForm } else { Method::Theory };
        Self { path, oscillations, residual, method }
    }
}

/// How near to the level, relatively, a path in steps of amplitude ends.
const END: f64 = 1e-6;
