//! A tuned mass damper in the JSON of an optimisation.

use serde::Serialize;

use crate::band::Rivals;
use crate::band::rivals::DETUNED;

/// The tuned mass damper of the absorber's mass that is best along the band.
#[derive(Debug, Clone, Serialize)]
pub struct DamperDocument {
    /// Its natural frequency over the structure's.
    tuning: f64,
    damping_ratio: f64,
    largest_peak: f64,
    at: f64,
    /// Largest displacement against the structure.
    stroke: f64,
    detuned: [DetunedDocument; 2],
}

/// The same damper where the structure's frequency is off.
#[derive(Debug, Clone, Serialize)]
struct DetunedDocument {
    /// The structure's frequency over the one that the damper was designed for.
    factor: f64,
    largest_peak: f64,
    stroke: f64,
}

impl DamperDocument {
    /// Writes it down, `length` turning a length over the clearance into one of the case.
    pub fn new(rivals: &Rivals, length: impl Fn(f64) -> f64) -> Self {
        let Rivals { damper, damped, detuned, .. } = rivals;
        let detuned = |k: usize| DetunedDocument {
            factor: DETUNED[k],
            largest_peak: length(detuned[k].amplitude),
            stroke: length(detuned[k].stroke),
        };
        Self {
            tuning: damper.tuning,
            damping_ratio: damper.damping_ratio,
            largest_peak: length(damped.amplitude),
            at: damped.at,
            stroke: length(damped.stroke),
            detuned: [detuned(0), detuned(1)],
        }
    }
}
