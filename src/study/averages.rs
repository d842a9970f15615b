//! The averaged flow of a case: what the absorber takes in every regime, and the steady amplitudes that follow.

use super::StudyError;
use crate::dissipation::{AveragedFlow, DissipationCurve, ModulatedCycle, Recapture, SteadyState};
use crate::system::System;

/// Smallest amplitude of the curve, over the clearance: below, motions with impacts are rare and slow.
const LEAST: f64 = 0.1;
/// Bounds of the largest: through all regimes up to three impacts per period, and what a second is enough for.
const LARGEST: [f64; 2] = [1.5, 6.0];

/// The curve of a case's restitution and the steady amplitudes on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Averages {
    /// The curve.
    pub curve: DissipationCurve,
    /// The amplitudes over which motions with impacts were followed.
    pub range: [f64; 2],
    /// All steady amplitudes within, ascending.
    pub states: Vec<SteadyState>,
    /// The modulated cycle, where it was asked for and the flow has one.
    pub cycle: Option<ModulatedCycle>,
}

impl Averages {
    /// Of a system, up to the amplitude that its forcing cannot exceed at any frequency, `gamma/lambda`, as far as
    /// that is of use.
    ///
    /// # Errors
    /// [`StudyError`] where the theory cannot be carried out.
    pub fn of(system: &System) -> Result<Self, StudyError> {
        let [least, most] = LARGEST;
        let bound = system.forcing_per_clearance() / system.damping();
        // Without damping and forcing nothing bounds it.
        let range = [LEAST, bound.max(least).min(most)];
        let curve = DissipationCurve::of(system.restitution(), range);
        let states = AveragedFlow::of(system, &curve).steady_states()?;
        Ok(Self { curve, range, states, cycle: None })
    }

    /// The same with the modulated cycle, which costs some times as much as the curve.
    #[must_use]
    pub fn with_cycle(self, system: &System) -> Self {
        let recapture = Recapture::of(system.restitution());
        let cycle = recapture.and_then(|recapture| ModulatedCycle::of(system, &recapture));
        Self { cycle, ..self }
    }
}
