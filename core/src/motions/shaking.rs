//! Velocity and acceleration of the structure in a motion, measured where somebody asks for them: a motion that repeats is
//! flown once round, one that wanders over its window again.

use super::{Effort, Facts, Motion, MotionKind, RestKind, Value};
use crate::numerics::scatter::{LONGER, error_of_largest, error_of_root, twice_error_of_mean};
use crate::simulation::{Detail, Observer, Segment, ShakingMeter, Simulation};
use crate::system::{Shaking, State, System};

/// Periods of an absorber that rests and still slides, or was seen on a wall.
const RESTING: u64 = 20;
/// Relative rounding of what is flown once round.
const ROUNDING: f64 = 1e-12;

/// What was measured in each period.
struct InPeriods {
    meter: ShakingMeter,
    periods: Vec<ShakingMeter>,
}

impl Observer for InPeriods {
    fn detail(&self) -> Detail {
        self.meter.detail()
    }

    fn segment(&mut self, segment: &Segment) {
        self.meter.segment(segment);
    }

    fn period(&mut self, _: &State) {
        self.periods.push(self.meter.taken());
    }
}

impl InPeriods {
    fn flown(system: &System, state: State, periods: u64, most_impacts: u64) -> Option<Self> {
        let mut simulation = Simulation::new(system, state, 0.0).ok()?;
        let mut seen = Self { meter: ShakingMeter::of(system), periods: Vec::new() };
        let natural = (1.0 / system.frequency_ratio()).max(1.0);
        let limit = ((periods as f64 * natural) as u64).saturating_mul(most_impacts);
        simulation.run(periods, limit, &mut seen);
        Some(seen)
    }

    fn found(&self) -> Shaking {
        self.periods.iter().fold(self.meter, ShakingMeter::and).found()
    }

    /// The same of a motion that does not repeat: of a largest value by how much a run ten times as long may exceed it,
    /// of a root mean square two standard errors.
    fn wandering(&self) -> Shaking<Value> {
        let found = self.found();
        let each =
            |of: &dyn Fn(&ShakingMeter) -> f64| self.periods.iter().map(of).collect::<Vec<_>>();
        let largest = |k: usize, value: f64| {
            Value::new(value, error_of_largest(&[&each(&|one| one.peaks()[k])], LONGER))
        };
        let average = |k: usize, value: f64| {
            let error = twice_error_of_mean(&[&each(&|one| one.mean_squares()[k])]);
            Value::new(value, error_of_root(value, error))
        };
        Shaking {
            peak_velocity: largest(0, found.peak_velocity),
            rms_velocity: average(0, found.rms_velocity),
            peak_acceleration: largest(1, found.peak_acceleration),
            rms_acceleration: average(1, found.rms_acceleration),
        }
    }
}

/// Numbers of a motion that repeats, as well known as those of its displacement. An acceleration is the difference of forces
/// as large as the displacement.
fn closed(facts: &Facts, found: Shaking) -> Shaking<Value> {
    let relative = |of: Value| if of.value > 0.0 { of.error / of.value } else { 0.0 };
    let known = [facts.peak, facts.rms, facts.impact_speed].map(relative);
    let known = known.into_iter().fold(ROUNDING, f64::max);
    let of = |value: f64| Value::new(value, known * value.max(facts.peak.value));
    found.map(of)
}

impl Motion {
    /// The same with how hard the structure shakes in it, where that is asked for and was not measured.
    pub(super) fn shaken(mut self, system: &System, effort: &Effort) -> Self {
        if effort.shaking && self.facts.shaking.is_none() {
            self.facts.shaking = self.shaking(system, effort);
        }
        self
    }

    fn shaking(&self, system: &System, effort: &Effort) -> Option<Shaking<Value>> {
        let fly = |periods: u64| InPeriods::flown(system, self.state, periods, effort.most_impacts);
        let periods = match &self.kind {
            MotionKind::Rest(rest) if rest.rest == RestKind::Floating => {
                // Without damping the free vibration beside the steady one stays; both may be in step.
                let free = if system.damping() == 0.0 { 1.0 } else { 0.0 };
                let fastest = system.frequency_ratio().max(free);
                let found = Shaking::of_sine(rest.amplitude, fastest);
                return Some(found.map(|value| Value::new(value, ROUNDING * value)));
            }
            MotionKind::Rest(_) => RESTING,
            MotionKind::Orbit(orbit) => orbit.cycle.periods().into(),
            MotionKind::Repeats(repetition) => repetition.periods.into(),
            MotionKind::Wanders => return Some(fly(effort.periods)?.wandering()),
        };
        Some(closed(&self.facts, fly(periods)?.found()))
    }
}
