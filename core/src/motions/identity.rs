//! When two ends are one motion, by the table on the page of the room; and the orbit that a repetition is.

use std::f64::consts::{PI, TAU};

use super::model::{Proof, states_from};
use super::repetition::{Polished, Repetition};
use super::watch::WindowSample;
use super::{Facts, Measured, Motion, MotionKind, Reached};
use crate::orbits::newton::solve;
use crate::orbits::{AfterImpact, Closure, Cycle, ONE_ORBIT, Orbit, Origin, Wall};
use crate::regimes::{Periodicity, Regime};
use crate::simulation::{Impact, Side, Stop};
use crate::system::{State, System};

/// Distance in state, over the clearance and radians, below which the halves of a simulated cycle count as mirror images:
/// far above the closure of a simulated repetition.
const MIRRORED: f64 = 1e-4;
/// Distance between simulated and exact impacts, over the size of the orbit, above which Newton's method has gone
/// elsewhere.
const SAME: f64 = 1e-3;
/// Longest cycle that is proven; a longer one is a chattering sequence, which ends in contact and is no cycle of impacts.
const MOST_IMPACTS: usize = 64;
impl Proof<System> {
    /// Of a trajectory that was seen to repeat, by Newton's method from its last repetition.
    pub fn of(system: &System, sample: &WindowSample, found: Periodicity) -> Self {
        let orbit = orbit_in(system, sample, found);
        let near_orbit = orbit.is_some();
        if let Some(proof) = Self::attracting(orbit, sample) {
            return proof;
        }
        // Beside an orbit that does not attract there may be a motion whose slip reverses, and which does.
        let size = sample.end.size().max(1.0);
        let near = |one: &Polished| one.state.distance(&sample.end) <= SAME * size;
        let Some(polished) = Polished::of(system, sample.end, found.periods).filter(near) else {
            if near_orbit {
                return Self::Leaves;
            }
            let is_over = found.has_settled();
            let seen = MotionKind::Repeats(Repetition::seen(sample, found));
            return if is_over { Self::Is(seen, Box::new(sample.clone())) } else { Self::Open };
        };
        if polished.multiplier > 1.0 + ONE_ORBIT {
            return Self::Leaves;
        }
        polished
            .seen(system)
            .map_or(Self::Open, |(sample, found)| Self::polished(&polished, sample, found))
    }

    /// Of the motion that repeats every excitation period to which Newton's method leads from a state, wherever it is.
    pub fn solved(system: &System, from: State) -> Self {
        let attracts = |one: &Polished| one.multiplier <= 1.0 + ONE_ORBIT;
        let Some(polished) = Polished::of(system, from, 1).filter(attracts) else {
            return Self::Open;
        };
        let Some((sample, found)) = polished.seen(system) else { return Self::Open };
        let orbit = Self::attracting(orbit_in(system, &sample, found), &sample);
        orbit.unwrap_or_else(|| Self::polished(&polished, sample, found))
    }

    /// An orbit, if it attracts.
    fn attracting(orbit: Option<Orbit>, sample: &WindowSample) -> Option<Self> {
        let orbit = orbit.filter(Orbit::attracts)?;
        Some(Self::Is(MotionKind::Orbit(Box::new(orbit)), Box::new(sample.clone())))
    }

    /// A repetition that attracts.
    fn polished(polished: &Polished, sample: WindowSample, found: Periodicity) -> Self {
        let multiplier = Some(polished.multiplier);
        let kind =
            MotionKind::Repeats(Repetition { multiplier, ..Repetition::seen(&sample, found) });
        Self::Is(kind, Box::new(sample))
    }
}

impl MotionKind {
    /// Whether two motions of one place are one, whatever is known of both; by averages that is for [`super::cluster`] to say.
    pub(super) fn is_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Rest(_), Self::Rest(_)) => true,
            (Self::Orbit(a), Self::Orbit(b)) => a.cycle.is_one_with(&b.cycle, ONE_ORBIT),
            (Self::Repeats(a), Self::Repeats(b)) => a.is_same(b),
            _ => false,
        }
    }
}

impl Motion {
    /// One that is proven or was seen to repeat.
    pub(super) fn proven(
        system: &System,
        kind: MotionKind,
        sample: Option<&WindowSample>,
    ) -> Option<Self> {
        let (facts, regime, state) = match &kind {
            MotionKind::Orbit(orbit) => {
                let facts = Facts::of_orbit(system, orbit).ok()?;
                (facts, regime_of(orbit), state_of(system, orbit)?)
            }
            MotionKind::Repeats(repetition) => {
                let sample = sample?;
                let left = 1.0 - repetition.multiplier.unwrap_or_default();
                (sample.facts.within(left.max(ONE_ORBIT)), sample.regime(), sample.end)
            }
            _ => return None,
        };
        let (reached, settled, stop) = (Reached::default(), true, Stop::EndTime);
        Some(Self { facts, kind, regime, state, reached, settled, stop })
    }

    /// The same as one that was solved for.
    pub(super) fn solved(mut self) -> Self {
        self.reached.solved = true;
        self
    }
}

/// The admissible orbit that a trajectory is on whose last repetition was measured, attracting or not; none where it does not
/// repeat, rests on a wall in between, or where Newton's method finds no such orbit at that place.
pub fn orbit_of(system: &System, measured: &Measured) -> Option<Orbit> {
    let (repetition, impacts) = measured.last_repetition()?;
    let flies = measured.sustained_contact.intervals == 0;
    flies.then(|| orbit(system, impacts, repetition.periods)).flatten()
}

/// The same of a trajectory that was seen side by side with others.
fn orbit_in(system: &System, sample: &WindowSample, found: Periodicity) -> Option<Orbit> {
    (!sample.contact).then(|| orbit(system, &sample.impacts, found.periods)).flatten()
}

fn orbit(system: &System, impacts: &[Impact], periods: u32) -> Option<Orbit> {
    if impacts.is_empty() || impacts.len() > MOST_IMPACTS {
        return None;
    }
    let simulated = cycle(system, impacts, periods)?;
    let start = simulated.folded(MIRRORED).unwrap_or_else(|| simulated.clone());
    let mut orbit = solve(system, &start, Origin::Simulation).ok()?;
    if let Some(once) = orbit.cycle.once(ONE_ORBIT) {
        let start = once.folded(ONE_ORBIT).unwrap_or(once);
        orbit = solve(system, &start, Origin::Simulation).ok()?;
    }
    let exact = orbit.cycle.unfolded();
    let size = exact.impacts.iter().map(|impact| impact.vector().amax()).fold(1.0, f64::max);
    let near = exact.distance(&simulated) < SAME * size;
    (orbit.admissibility.admissible && near).then_some(orbit)
}

/// The impacts of one repetition as a cycle; the time from the last to the first completes it.
fn cycle(system: &System, impacts: &[Impact], periods: u32) -> Option<Cycle> {
    let omega = system.frequency_ratio();
    let first = impacts.first()?;
    let whole = f64::from(periods) * TAU / omega;
    let passed = |impact: &Impact| impact.tau - first.tau;
    let times: Vec<f64> = impacts.iter().map(passed).chain([whole]).collect();
    let after = |impact: &Impact| AfterImpact {
        wall: if impact.side == Side::Plus { Wall::Plus } else { Wall::Minus },
        phase: first.phase + omega * passed(impact),
        x: impact.x,
        x_velocity: impact.x_velocity_after,
        y_velocity: impact.y_velocity_after,
    };
    Some(Cycle {
        closure: Closure::Repeats { periods },
        impacts: impacts.iter().map(after).collect(),
        durations: times.windows(2).map(|pair| pair[1] - pair[0]).collect(),
    })
}

/// States of a motion that attracts, and of its mirror image, with their phases, and after how many periods it repeats; none of one
/// that is known by averages.
pub(super) fn begins(system: &System, motion: &Motion) -> (Vec<(State, f64)>, u32) {
    match &motion.kind {
        MotionKind::Orbit(orbit) => (on(system, orbit), orbit.cycle.periods()),
        MotionKind::Repeats(Repetition { periods, multiplier: Some(_), .. }) => {
            let State { x, x_velocity, y, y_velocity } = motion.state;
            let turned = State { x: -x, x_velocity: -x_velocity, y: -y, y_velocity: -y_velocity };
            let twin = system.cavity().is_symmetric().then_some((turned, PI));
            ([(motion.state, 0.0)].into_iter().chain(twin).collect(), *periods)
        }
        _ => (Vec::new(), 0),
    }
}

/// States after an impact of an orbit, and on its mirror image where that is a motion of its own, with their phases.
fn on(system: &System, orbit: &Orbit) -> Vec<(State, f64)> {
    let first = orbit.cycle.impacts[0];
    let twin =
        matches!(orbit.cycle.closure, Closure::Repeats { .. }) && system.cavity().is_symmetric();
    let begins = std::iter::once(first).chain(twin.then(|| first.mirrored(1.0)));
    begins.map(|begin| (begin.state(), begin.phase)).collect()
}

/// A state of an orbit at phase 0.
pub(super) fn state_of(system: &System, orbit: &Orbit) -> Option<State> {
    states_from(system, &on(system, orbit), orbit.cycle.periods()).first().copied()
}

/// What an orbit's impacts do.
pub(super) fn regime_of(orbit: &Orbit) -> Regime {
    let per_period = orbit.cycle.impact_count() as f64 / f64::from(orbit.cycle.periods());
    let symmetric = matches!(orbit.cycle.closure, Closure::Mirrors { .. });
    match per_period {
        more if more > 2.0 => Regime::AboveTwo,
        2.0 if symmetric => Regime::TwoSymmetric,
        2.0 => Regime::TwoAsymmetric,
        _ => Regime::BelowTwo,
    }
}
