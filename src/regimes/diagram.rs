//! Bifurcation diagrams by simulation: one parameter is moved in steps, up and then down, and the
//! trajectory goes on from where the last step left it, so that each branch is followed until it is
//! lost. Where both ways differ there is hysteresis.

use serde::Serialize;

use super::attractor::Effort;
use super::{Attractor, DynamicsKind, Regime};
use crate::simulation::{StartError, Stop};
use crate::system::{InvalidParameter, Parameter, State, System};

/// Most points of each kind at one value: a chaotic band is a band with this many.
const MOST_POINTS: usize = 40;

/// The way in which a value was reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SweepDirection {
    /// From smaller values.
    Up,
    /// From larger values.
    Down,
}

/// The motion at one value.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DiagramPoint {
    /// The parameter.
    pub value: f64,
    /// How it was reached.
    pub way: SweepDirection,
    /// What the impacts do.
    pub regime: Regime,
    /// What kind of dynamics it is.
    pub dynamics: DynamicsKind,
    /// `z`.
    pub impacts_per_period: f64,
    /// Largest displacement of the oscillator, over the base system's clearance.
    pub peak: f64,
    /// Largest displacement of the last periods one by one, over the base system's clearance.
    pub period_peaks: Vec<f64>,
    /// Times between the last impacts, over the excitation period.
    pub intervals: Vec<f64>,
    /// Excitation phase of the last impacts, `0 .. 2 pi`.
    pub phases: Vec<f64>,
    /// Whether the motion was given up at the limit on impacts: it chatters without end, and the
    /// numbers are those of the part that was simulated.
    pub lost_to_impact_limit: bool,
}

/// Why a diagram cannot be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DiagramError {
    /// A value that the parameter cannot have.
    #[error(transparent)]
    Parameter(#[from] InvalidParameter),
    /// A state that overflowed.
    #[error(transparent)]
    Start(#[from] StartError),
}

/// Moves `parameter` over `values` in ascending order and back, beginning at `start` (over the clearance
/// at the first value). Every point is followed with `effort`, `progress` is told of each.
///
/// # Errors
/// [`DiagramError`] for values without a system, or an impossible start.
pub fn sweep(
    base: &System,
    parameter: Parameter,
    values: &[f64],
    start: State,
    effort: &Effort,
    progress: &mut dyn FnMut(u64),
) -> Result<Vec<DiagramPoint>, DiagramError> {
    let mut ascending = values.to_vec();
    ascending.sort_by(f64::total_cmp);
    let up = ascending.iter().map(|value| (*value, SweepDirection::Up));
    let down = ascending.iter().rev().map(|value| (*value, SweepDirection::Down));
    let mut points = Vec::with_capacity(2 * ascending.len());
    let mut last: Option<(f64, State)> = None;
    for (value, way) in up.chain(down) {
        let system = parameter.applied(base, value)?;
        let unit = parameter.unit(value);
        let begin = match last {
            Some((before, state)) => carried_over(state, before / unit, 1.0),
            None => start,
        };
        let found = Attractor::reach(&system, begin, effort)?;
        points.push(point(&found, value, way, unit, system.period()));
        last = Some((unit, found.state));
        progress(1);
    }
    Ok(points)
}

/// The same physical state over another clearance and at another natural frequency, each given as the old
/// one over the new one. If the absorber is outside the new cavity, the wall has pushed it along.
pub fn carried_over(state: State, clearance: f64, natural_frequency: f64) -> State {
    let gap = (clearance * state.relative_displacement()).clamp(-1.0, 1.0);
    let x = clearance * state.x;
    let speed = clearance * natural_frequency;
    State {
        x,
        x_velocity: speed * state.x_velocity,
        y: x - gap,
        y_velocity: speed * state.y_velocity,
    }
}

fn point(
    found: &Attractor,
    value: f64,
    way: SweepDirection,
    unit: f64,
    period: f64,
) -> DiagramPoint {
    let impacts = tail(&found.impacts, MOST_POINTS + 1);
    let interval = |two: &[crate::simulation::Impact]| (two[1].tau - two[0].tau) / period;
    DiagramPoint {
        value,
        way,
        regime: found.classification.regime,
        dynamics: found.classification.dynamics,
        impacts_per_period: found.classification.evidence.impacts_per_period,
        peak: unit * found.peak,
        period_peaks: tail(&found.amplitudes, MOST_POINTS)
            .iter()
            .map(|one| unit * one.peak)
            .collect(),
        intervals: impacts.windows(2).map(interval).collect(),
        phases: tail(impacts, MOST_POINTS).iter().map(|impact| impact.phase).collect(),
        lost_to_impact_limit: found.stop == Stop::ImpactLimit,
    }
}

fn tail<T>(all: &[T], most: usize) -> &[T] {
    &all[all.len().saturating_sub(most)..]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_state_keeps_its_lengths_and_stays_in_the_cavity() {
        let state = State { x: 0.5, x_velocity: -1.0, y: -0.3, y_velocity: 2.0 };
        // From clearance 1 to 2: every length is half as many clearances.
        let wider = carried_over(state, 0.5, 1.0);
        assert_eq!((wider.x, wider.x_velocity, wider.y_velocity), (0.25, -0.5, 1.0));
        assert!((wider.y + 0.15).abs() < 1e-15);
        // From 1 to 0.5 the gap of 0.8 has no room: the wall is at 1.
        let narrower = carried_over(state, 2.0, 1.0);
        assert_eq!((narrower.relative_displacement(), narrower.x), (1.0, 1.0));
        // Where time runs four times as fast, velocities are a quarter.
        let stiffer = carried_over(state, 1.0, 0.25);
        assert_eq!((stiffer.x, stiffer.x_velocity, stiffer.y_velocity), (0.5, -0.25, 0.5));
    }
}
