//! The paper's claim about the best clearance (section 3.4 and the red cross of its Fig. 6c): the
//! oscillator vibrates least where the steady 1:1 motion is about to disappear.

use serde::Serialize;

use crate::orbits::FullSystem;
use crate::system::System;

/// Distance from the end, over the clearance there, at which the orbit is still asked for.
const INSIDE: f64 = 1e-6;
/// Relative difference of clearances up to which the two places are one: nobody builds closer.
const SAME_PLACE: f64 = 0.01;

/// Where the stable 1:1 orbit vibrates least, and where it disappears. Over the case's own clearance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct OptimumClaim {
    /// Clearance at which the stable symmetric orbit vibrates least.
    pub best_clearance: f64,
    /// Its amplitude there.
    pub best_amplitude: f64,
    /// Largest clearance of the stretch around it: beyond it the stable 1:1 motion is gone.
    pub end_clearance: f64,
    /// The orbit's amplitude there.
    pub end_amplitude: f64,
    /// What ends it, as its bifurcation is called.
    pub ends_by: Option<&'static str>,
    /// How far the best clearance lies below the end, over the end.
    pub distance: f64,
    /// By how much the amplitude at the end exceeds the best one, over the latter.
    pub excess: f64,
    /// Whether both places are one.
    pub holds: bool,
}

impl OptimumClaim {
    /// That of a system; `None` where no symmetric orbit is stable at any clearance.
    pub fn of(system: &System) -> Option<Self> {
        let full = FullSystem::of(system);
        let best = full.best_clearance()?;
        let stretch = full.stable_stretches().iter().find(|stretch| {
            stretch.clearance[0] <= best.factor && best.factor <= stretch.clearance[1]
        })?;
        let end = stretch.clearance[1];
        let end_amplitude = full.steady_peak(end * (1.0 - INSIDE))?;
        let (distance, excess) = (1.0 - best.factor / end, end_amplitude / best.peak - 1.0);
        Some(Self {
            best_clearance: best.factor,
            best_amplitude: best.peak,
            end_clearance: end,
            end_amplitude,
            ends_by: stretch.ends[1].map(|kind| kind.words()),
            distance,
            excess,
            holds: distance <= SAME_PLACE || excess <= 0.0,
        })
    }
}
