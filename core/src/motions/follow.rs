//! Trajectories that are followed one by one, where nobody asks what else there is; and bifurcation diagrams by simulation:
//! one parameter is moved in steps, up and then down, and the trajectory goes on from where the last step left it, so that
//! each branch is followed until it is lost. Where both ways differ there is hysteresis.

use serde::Serialize;

use super::flight::{StartFlight, StartOutcome, flown};
use super::repetition::Repetition;
use super::rest::Rest;
use super::watch::{Watch, WindowSample};
use super::{Effort, Facts, Motion, MotionKind, Reached, SettlingTime};
use crate::operation_count;
use crate::simulation::{Impact, Simulation, StartError, Stop};
use crate::system::{InvalidParameter, Parameter, State, System};

/// How often a transient is left out, the first time included, of a motion that is still settling; each
/// time the window after it is longer.
const ROUNDS: u64 = 3;

/// What each start leads to, all of them side by side, each as if it were alone: seen, not proven, and of a transient that
/// lasts nobody knows. None where a start could not be followed.
///
/// # Errors
/// [`StartError`] where a start is outside the cavity or not finite.
pub fn follow(
    starts: &[(System, State)],
    effort: &Effort,
) -> Result<Vec<Option<Motion>>, StartError> {
    let mut motions: Vec<Option<Motion>> = vec![None; starts.len()];
    let mut flights: Vec<StartFlight<System>> = Vec::with_capacity(starts.len());
    for (index, (system, start)) in starts.iter().enumerate() {
        let flight = Simulation::new(system, *start, 0.0)?;
        // Starts of one system follow each other.
        let before = index.checked_sub(1).filter(|before| starts[*before].0 == *system);
        let left_out = match (effort.discard, before) {
            (Some(discard), _) => discard,
            (None, Some(before)) => flights[before].left_out,
            (None, None) => SettlingTime::of(system).periods,
        };
        let window = effort.periods;
        flights.push(StartFlight { index, flight, before: 0, left_out, window, whole: false });
    }
    for round in 1..=ROUNDS {
        flights.iter_mut().for_each(|one| one.window = effort.periods * round);
        for (flight, end) in flown(std::mem::take(&mut flights), effort.most_impacts, &|_| &[]) {
            let settling = match &end {
                StartOutcome::Seen(sample) => {
                    let repeats = sample.evidence.periodicity.is_some();
                    let open = sample.drifts || sample.of_repeating_kind();
                    sample.stop == Stop::EndTime && !repeats && open
                }
                _ => false,
            };
            let index = flight.index;
            let motion = Motion::seen(&flight, end);
            motions[index] = motion.map(|one| one.shaken(flight.flight.system(), effort));
            if settling && round < ROUNDS {
                flights.push(flight);
            } else {
                operation_count::note(flight.flight.operations());
            }
        }
        flights.sort_by_key(|flight| flight.index);
    }
    Ok(motions)
}

impl Motion {
    /// What a start led to.
    fn seen(flight: &StartFlight<System>, end: StartOutcome<System>) -> Option<Self> {
        let system = flight.flight.system();
        let reached =
            Reached { starts: 1, followed: flight.flight.periods(), ..Reached::default() };
        let motion = match end {
            StartOutcome::Lost | StartOutcome::On(_) | StartOutcome::Open => return None,
            StartOutcome::Rests(state) => {
                let amplitude = system.linear_response()?.amplitude();
                let facts = Facts::of_sine(amplitude, 0.0);
                Self::resting(Rest::seen(system, amplitude), facts, state)
            }
            StartOutcome::Seen(sample) => {
                let WindowSample { facts, evidence, end: state, stop, .. } = *sample;
                let kind = match evidence.periodicity {
                    Some(found) if found.impacts == 0 => {
                        MotionKind::Rest(Rest::seen(system, facts.peak.value))
                    }
                    Some(found) => MotionKind::Repeats(Repetition::seen(&sample, found)),
                    None => MotionKind::Wanders,
                };
                let settled = evidence.periodicity.is_some() || !sample.drifts;
                Self { facts, kind, regime: sample.regime(), state, reached, settled, stop }
            }
        };
        Some(Self { reached, ..motion })
    }
}

/// Most points of each kind at one value, and periods from which they are taken: a chaotic band is a band
/// with this many.
const MOST_POINTS: usize = 40;
/// Impacts after which these periods are given up: a hundred in each.
const MOST_IMPACTS: u64 = 4000;

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
#[derive(Debug, Clone, PartialEq)]
pub struct DiagramPoint {
    /// The parameter.
    pub value: f64,
    /// How it was reached.
    pub way: SweepDirection,
    /// The motion; lengths over the clearance at this value.
    pub motion: Motion,
    /// Largest displacement of the oscillator, over the base system's clearance.
    pub peak: f64,
    /// Largest displacement of the last periods one by one, over the base system's clearance.
    pub period_peaks: Vec<f64>,
    /// Times between the last impacts, over the excitation period.
    pub intervals: Vec<f64>,
}

/// Why a diagram cannot be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DiagramError {
    /// A value that the parameter cannot have.
    #[error(transparent)]
    Parameter(#[from] InvalidParameter),
    /// A state that overflowed.
    #[error(transparent)]
    Start(#[from] StartError),
}

/// Moves `parameter` over `values` in ascending order and back, beginning at `start` (over the clearance
/// at the first value). Every point is followed with `effort`, `progress` is told of each; one that cannot be
/// followed is left out.
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
        let begin = last.map_or(start, |(before, state)| carried_over(state, before / unit, 1.0));
        if let Some(motion) = follow(&[(system, begin)], effort)?.pop().flatten() {
            last = Some((unit, motion.state));
            points.push(DiagramPoint::of(motion, &system, value, way, unit)?);
        }
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

impl DiagramPoint {
    /// Adds to a motion what a diagram shows of its last periods and impacts.
    fn of(
        motion: Motion,
        system: &System,
        value: f64,
        way: SweepDirection,
        unit: f64,
    ) -> Result<Self, StartError> {
        let mut simulation = Simulation::new(system, motion.state, 0.0)?;
        let mut watch = Watch::begin(&simulation);
        let periods = MOST_POINTS as u64;
        let stop = simulation.run(periods, MOST_IMPACTS, &mut watch.observers);
        let records = watch.statistics().records();
        let period_peaks: Vec<f64> = records.iter().map(|one| unit * one.peak).collect();
        let impacts = watch.impacts();
        let impacts = &impacts[impacts.len().saturating_sub(MOST_POINTS + 1)..];
        let interval = |two: &[Impact]| (two[1].tau - two[0].tau) / system.period();
        Ok(Self {
            value,
            way,
            peak: period_peaks.iter().copied().fold(unit * motion.facts.peak.value, f64::max),
            period_peaks,
            intervals: impacts.windows(2).map(interval).collect(),
            motion: Motion {
                stop: if motion.stop == Stop::EndTime { stop } else { motion.stop },
                ..motion
            },
        })
    }
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
