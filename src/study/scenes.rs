//! Simulations that exist for a figure: the motion itself, the neighbourhood in frequency, and the
//! line between two asymmetric impacts and more.

use serde::Serialize;

use crate::analysis::motion::state_of;
use crate::analysis::{Analysis, BoundaryKind, boundaries};
use crate::regimes::attractor::Effort;
use crate::regimes::{Attractor, Regime};
use crate::simulation::{Simulation, StartError, Stop, Trace};
use crate::system::{State, System};
use crate::validation::tolerance::LARGEST_DAMPING;

use super::StudyError;

/// Effort of one point of a map: enough to recognise a regime. More than ten thousand impacts in a
/// few hundred periods are recognised as more than two per period without going on.
const POINT: Effort = Effort { discard: 400, periods: 100, prolongations: 1, impact_limit: 10_000 };

/// The motion on an attractor, from its state at phase 0.
///
/// # Errors
/// [`StartError`] if that state is not finite.
pub fn trace(
    system: &System,
    state: State,
    periods: u64,
    samples_per_period: f64,
) -> Result<Trace, StartError> {
    let mut simulation = Simulation::new(system, state, 0.0)?;
    let mut trace = Trace::new(samples_per_period);
    simulation.run(periods, u64::MAX, &mut trace);
    Ok(trace)
}

/// What simulation finds at one frequency, everything else being the case's.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SweepPoint {
    /// `Omega`.
    pub frequency_ratio: f64,
    /// Largest displacement of the oscillator over the clearance.
    pub peak: f64,
    /// Its regime.
    pub regime: Regime,
}

/// Simulated peaks at the given frequency ratios, each from the motion that the theory predicts
/// there, or from a moving absorber where it predicts none.
///
/// # Errors
/// [`StudyError`] where theory or simulation cannot be carried out.
pub fn sweep(system: &System, frequency_ratios: &[f64]) -> Result<Vec<SweepPoint>, StudyError> {
    let mut points = Vec::new();
    for &frequency_ratio in frequency_ratios {
        let Ok(there) = system.with_frequency_ratio(frequency_ratio) else { continue };
        let reached = Attractor::reach(&there, moving_start(&Analysis::of(&there)?), &POINT)?;
        if reached.stop != Stop::EndTime {
            // Nothing was measured.
            continue;
        }
        let regime = reached.classification.regime;
        points.push(SweepPoint { frequency_ratio, peak: reached.peak, regime });
    }
    Ok(points)
}

/// On the largest motion that the theory predicts; else an absorber that crosses its cavity.
fn moving_start(analysis: &Analysis) -> State {
    let best = analysis.stable_points().last().or_else(|| analysis.fixed_points.last());
    match best {
        Some(point) => state_of(point, &analysis.system),
        None => State { x: 0.0, x_velocity: 0.0, y: 0.0, y_velocity: 1.0 },
    }
}

/// A point of the line between Z2 and Z1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct GrazingPoint {
    /// `Omega`.
    pub frequency_ratio: f64,
    /// Clearance over the case's.
    pub clearance: f64,
}

/// Where, going down in clearance from symmetry breaking, more than two impacts per period first
/// appear, at each frequency ratio; by bisection, to two percent of the clearance.
///
/// # Errors
/// [`StudyError`] where theory or simulation cannot be carried out.
pub fn grazing_line(
    system: &System,
    frequency_ratios: &[f64],
) -> Result<Vec<GrazingPoint>, StudyError> {
    let mut line = Vec::new();
    // Without a resonance the boundaries, and this line beside them, mean nothing.
    if system.mass_ratio() * system.damping() > LARGEST_DAMPING {
        return Ok(line);
    }
    for &frequency_ratio in frequency_ratios {
        let Ok(there) = system.with_frequency_ratio(frequency_ratio) else { continue };
        let at = there.detuning();
        let found = boundaries::explicit_boundary(
            BoundaryKind::SymmetryBreaking,
            &there,
            [at].into_iter(),
        )?;
        let Some(breaking) = found.first() else { continue };
        let top = system.forcing_per_clearance() / breaking.forcing_over_clearance;
        if !(top.is_finite() && top > 0.0) {
            continue;
        }
        if let Some(clearance) = bisect(&there, top)? {
            line.push(GrazingPoint { frequency_ratio, clearance });
        }
    }
    Ok(line)
}

fn bisect(system: &System, top: f64) -> Result<Option<f64>, StudyError> {
    let above_two = |clearance: f64| -> Result<bool, StudyError> {
        let Ok(there) = system.with_clearance_scaled(clearance) else { return Ok(false) };
        let reached = Attractor::reach(&there, moving_start(&Analysis::of(&there)?), &POINT)?;
        let crowded = reached.stop == Stop::ImpactLimit;
        Ok(crowded || reached.classification.regime == Regime::AboveTwo)
    };
    let (mut low, mut high) = (0.15 * top, 0.98 * top);
    if !above_two(low)? || above_two(high)? {
        return Ok(None);
    }
    while high - low > 0.02 * top {
        let middle = 0.5 * (low + high);
        if above_two(middle)? {
            low = middle;
        } else {
            high = middle;
        }
    }
    Ok(Some(0.5 * (low + high)))
}
