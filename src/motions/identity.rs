//! When two ends are one motion, by the table on the page of the room; and the orbit that a repetition is.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix4, Vector4};
use serde::Serialize;

use super::watch::{Sample, Watch};
use super::{Facts, Kind, Measured, Motion, Reached, Value};
use crate::numerics::scatter::twice_standard_error;
use crate::orbits::newton::solve;
use crate::orbits::{AfterImpact, Closure, Cycle, Multipliers, ONE_ORBIT, Orbit, Origin, Wall};
use crate::regimes::{ImpactSequence, Periodicity, Regime};
use crate::simulation::{Impact, Side, Simulation, Stop, Tangent};
use crate::system::{State, System};

/// Distance in state, over the clearance and radians, below which the halves of a simulated cycle count as mirror images:
/// far above the closure of a simulated repetition.
const MIRRORED: f64 = 1e-4;
/// Distance between simulated and exact impacts, over the size of the orbit, above which Newton's method has gone
/// elsewhere.
const SAME: f64 = 1e-3;
/// Longest cycle that is proven; a longer one is a chattering sequence, which ends in contact and is no cycle of impacts.
const MOST_IMPACTS: usize = 64;
/// Relative difference of `C`, `E` and peak below which two repetitions with the same impacts are one: a thousand times what
/// a repetition to 1e-6 leaves open.
const SAME_REPETITION: f64 = 1e-3;
/// Closure of a repetition, over its size, at which Newton's method ends: what a few hundred impacts leave of rounding. It
/// ends as well where it comes no closer, and has failed then if the closure is larger than the other.
const POLISHED: f64 = 1e-13;
const ROUGH: f64 = 1e-9;
/// Steps of Newton's method without coming closer after which it is given up; next to a bifurcation it may go astray for a
/// few, and each then halves the distance.
const STEPS: u32 = 6;
/// Distance from an attracting orbit, over its size, times its distance from losing stability, below which a trajectory that
/// comes closer is on it. Next to a saddle-node the orbit that bounds its basin is as far away as its largest multiplier is
/// from 1, next to other bifurcations the root of that.
const CAPTURED: f64 = 0.03;
/// What two averages that scatter may differ by, over the sum of their errors.
const ERRORS: f64 = 2.0;
/// Windows from which on their scatter says more than each of them.
const MANY: usize = 4;
/// A change from the first half of all windows to the second, over twice its standard error, that is no chance.
const DRIFT: f64 = 1.5;
/// Modulation in the second half of a window over that in the first which is that of a motion that stays: of a few windows,
/// in which it is sampled to a few per cent, and of many in which it comes and goes.
const STAYS: std::ops::Range<f64> = 0.9..1.1;
const MANY_STAY: std::ops::Range<f64> = 0.5..2.0;
/// Relative difference below which averages are the same whatever their errors: what nobody measures.
const NO_DIFFERENCE: f64 = 1e-3;

/// A motion that was seen to repeat and that Newton's method does not cover.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Repetition {
    /// Excitation periods until it repeats.
    pub periods: u32,
    /// Impacts until then.
    pub impacts: u32,
    /// Which walls they are on; none where they are more than a sequence holds.
    pub sequence: Option<ImpactSequence>,
    /// `C` and `E` of equation (17) over the whole repetition, and the peak, over the clearance.
    pub amplitudes: [f64; 3],
    /// Largest distance between states that should be equal, over the size of the motion.
    pub closure: f64,
    /// Largest modulus of the multipliers over one excitation period, from exact tangents along it.
    pub multiplier: Option<f64>,
    /// Whether the absorber rests on a wall in it.
    pub contact: bool,
}

impl Repetition {
    /// As it was seen.
    pub(super) fn seen(sample: &Sample, found: Periodicity) -> Self {
        Self {
            periods: found.periods,
            impacts: found.impacts,
            sequence: sample.evidence.sequence,
            amplitudes: sample.amplitudes,
            closure: found.closure,
            multiplier: None,
            contact: sample.contact,
        }
    }

    /// Walls in the order of the impacts, as `+-`.
    pub fn walls(&self) -> String {
        self.sequence.map(|sequence| sequence.to_string()).unwrap_or_default()
    }

    fn is_same(&self, other: &Self) -> bool {
        let near = |(a, b): (f64, f64)| (a - b).abs() <= SAME_REPETITION * a.max(b);
        (self.periods, self.impacts, self.sequence)
            == (other.periods, other.impacts, other.sequence)
            && self.amplitudes.into_iter().zip(other.amplitudes).all(near)
    }
}

/// A state at phase 0 on a motion that repeats, by Newton's method on the simulated map over its periods, whatever happens on
/// the way: contact, or a slip that reverses.
struct Polished {
    state: State,
    periods: u32,
    /// Largest modulus of the multipliers over one excitation period.
    multiplier: f64,
}

/// Where a state at phase 0 is after some periods, and how that changes with it: exact tangents.
fn period_map(system: &System, state: State, periods: u32) -> Option<(State, Matrix4<f64>)> {
    let unit = |k: usize| {
        let [x, x_velocity, y, y_velocity] = [0, 1, 2, 3].map(|j| f64::from(u8::from(j == k)));
        Tangent::begin(system, State { x, x_velocity, y, y_velocity })
    };
    let mut tangents = ((unit(0), unit(1)), (unit(2), unit(3)));
    let mut simulation = Simulation::new(system, state, 0.0).ok()?;
    if simulation.run(periods.into(), u64::MAX, &mut tangents) != Stop::EndTime {
        return None;
    }
    let ((a, b), (c, d)) = tangents;
    let column = |tangent: Tangent| vector(&tangent.change) * libm::exp(tangent.logarithm());
    Some((simulation.state(), Matrix4::from_columns(&[a, b, c, d].map(column))))
}

fn vector(state: &State) -> Vector4<f64> {
    Vector4::new(state.x, state.x_velocity, state.y, state.y_velocity)
}

impl Polished {
    /// From a state, a motion that repeats after so many periods, or a part of them; none where Newton's method finds none.
    fn of(system: &System, from: State, periods: u32) -> Option<Self> {
        let size = from.size().max(1.0);
        let (mut state, mut last, mut best, mut astray) = (from, f64::INFINITY, f64::INFINITY, 0);
        let map = loop {
            let (end, map) = period_map(system, state, periods)?;
            let off = vector(&end) - vector(&state);
            let closure = off.amax() / size;
            if closure <= POLISHED || closure <= ROUGH && closure >= 0.5 * last {
                break map;
            }
            if closure < 0.9 * best {
                (best, astray) = (closure, 0);
            } else if astray == STEPS {
                return None;
            } else {
                astray += 1;
            }
            last = closure;
            let step = (Matrix4::identity() - map).lu().solve(&off)?;
            state = State {
                x: state.x + step[0],
                x_velocity: state.x_velocity + step[1],
                y: state.y + step[2],
                y_velocity: state.y_velocity + step[3],
            };
        };
        // What settles from alternate sides is seen to repeat after twice its periods.
        for shorter in (1..periods).filter(|shorter| periods.is_multiple_of(*shorter)) {
            let (end, map) = period_map(system, state, shorter)?;
            if end.distance(&state) <= ONE_ORBIT * size {
                return Some(Self::with(state, shorter, &map));
            }
        }
        Some(Self::with(state, periods, &map))
    }

    fn with(state: State, periods: u32, map: &Matrix4<f64>) -> Self {
        let radius = Multipliers::of(map).map_or(0.0, |one| one.spectral_radius());
        let multiplier = libm::pow(radius, 1.0 / f64::from(periods));
        Self { state, periods, multiplier }
    }

    /// What is seen of it.
    fn sample(&self, system: &System) -> Option<Sample> {
        let mut simulation = Simulation::new(system, self.state, 0.0).ok()?;
        let mut watch = Watch::begin(&simulation);
        let stop =
            simulation.run(Periodicity::shown_in(self.periods), u64::MAX, &mut watch.observers);
        watch.sample(&simulation, stop)
    }
}

/// What a trajectory that repeats is.
pub(super) enum Proof {
    /// An orbit that attracts, or a repetition that no solver of orbits covers, with what is seen of it.
    Is(Kind, Box<Sample>),
    /// An orbit, or a repetition, that does not attract: the trajectory is about to leave it.
    Leaves,
    /// Neither: it is still settling.
    Open,
}

impl Proof {
    /// Of a trajectory that was seen to repeat, by Newton's method from its last repetition.
    pub fn of(system: &System, sample: &Sample, found: Periodicity) -> Self {
        let proven = orbit(system, &sample.impacts, found.periods).filter(|_| !sample.contact);
        let near_orbit = proven.is_some();
        if let Some(orbit) = proven.filter(Orbit::attracts) {
            return Self::Is(Kind::Orbit(Box::new(orbit)), Box::new(sample.clone()));
        }
        // Beside an orbit that does not attract there may be a motion whose slip reverses, and which does.
        let size = sample.end.size().max(1.0);
        let near = |one: &Polished| one.state.distance(&sample.end) <= SAME * size;
        let Some(polished) = Polished::of(system, sample.end, found.periods).filter(near) else {
            if near_orbit {
                return Self::Leaves;
            }
            let is_over = found.has_settled();
            let seen = Kind::Repeats(Repetition::seen(sample, found));
            return if is_over { Self::Is(seen, Box::new(sample.clone())) } else { Self::Open };
        };
        if polished.multiplier > 1.0 + ONE_ORBIT {
            return Self::Leaves;
        }
        let seen =
            polished.sample(system).and_then(|seen| Some((seen.evidence.periodicity?, seen)));
        let seen = seen.filter(|(found, _)| found.periods == polished.periods);
        let Some((found, seen)) = seen else { return Self::Open };
        let multiplier = Some(polished.multiplier);
        let kind = Kind::Repeats(Repetition { multiplier, ..Repetition::seen(&seen, found) });
        Self::Is(kind, Box::new(seen))
    }

    /// Of the motion that repeats every excitation period to which Newton's method leads from a state, wherever it is.
    pub fn solved(system: &System, from: State) -> Self {
        let sample = Polished::of(system, from, 1).and_then(|one| one.sample(system));
        let found = sample.and_then(|sample| Some((sample.evidence.periodicity?, sample)));
        found.map_or(Self::Open, |(found, sample)| Self::of(system, &sample, found))
    }
}

impl Kind {
    /// Whether two motions of one place are one, whatever is known of both; by averages that is for [`Cluster`] to say.
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
    pub(super) fn proven(system: &System, kind: Kind, sample: Option<&Sample>) -> Option<Self> {
        let (facts, regime, state) = match &kind {
            Kind::Orbit(orbit) => {
                let facts = Facts::of_orbit(system, orbit).ok()?;
                (facts, regime_of(orbit), state_of(system, orbit)?)
            }
            Kind::Repeats(repetition) => {
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

/// A motion of a place that trajectories are held against.
#[derive(Debug, Clone)]
pub(super) struct Known {
    pub motion: Motion,
    /// Its states at the ends of its excitation periods, and those of its mirror image.
    states: Vec<State>,
    size: f64,
}

impl Known {
    /// A motion with where it stands at phase 0, if it repeats and is known to attract.
    pub fn new(system: &System, motion: Motion) -> Self {
        let states = match &motion.kind {
            Kind::Orbit(orbit) => states(system, orbit),
            Kind::Repeats(Repetition { periods, multiplier: Some(_), .. }) => {
                let State { x, x_velocity, y, y_velocity } = motion.state;
                let turned =
                    State { x: -x, x_velocity: -x_velocity, y: -y, y_velocity: -y_velocity };
                let twin = system.cavity().is_symmetric().then_some((turned, PI));
                states_from(system, [(motion.state, 0.0)].into_iter().chain(twin), *periods)
            }
            _ => Vec::new(),
        };
        let size = states.iter().map(State::size).fold(1.0, f64::max);
        Self { motion, states, size }
    }

    /// How far a state at phase 0 is from it, over what counts as being on it; infinite where that is not known.
    pub fn distance(&self, state: &State) -> f64 {
        let Some(multiplier) = self.motion.largest_multiplier() else { return f64::INFINITY };
        let near =
            self.states.iter().map(|known| known.distance(state)).fold(f64::INFINITY, f64::min);
        let room = CAPTURED * (1.0 - multiplier);
        near / (room * self.size).max(f64::MIN_POSITIVE)
    }
}

/// States on an orbit, and on its mirror image where that is a motion of its own, at the ends of the excitation periods.
fn states(system: &System, orbit: &Orbit) -> Vec<State> {
    let first = orbit.cycle.impacts[0];
    let twin =
        matches!(orbit.cycle.closure, Closure::Repeats { .. }) && system.cavity().is_symmetric();
    let begins = std::iter::once(first).chain(twin.then(|| first.mirrored(1.0)));
    let begins = begins.map(|begin| (begin.state(), begin.phase));
    states_from(system, begins, orbit.cycle.periods())
}

/// States at the ends of so many excitation periods from states at phases.
fn states_from(
    system: &System,
    begins: impl Iterator<Item = (State, f64)>,
    periods: u32,
) -> Vec<State> {
    let mut found = Vec::new();
    for (state, phase) in begins {
        let Ok(mut simulation) = Simulation::new(system, state, phase) else { continue };
        for _ in 0..periods {
            simulation.run(1, u64::MAX, &mut ());
            found.push(simulation.state());
        }
    }
    found
}

/// A state of an orbit at phase 0.
pub(super) fn state_of(system: &System, orbit: &Orbit) -> Option<State> {
    states(system, orbit).first().copied()
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

/// Starts that wander together: windows of one motion, as far as averages tell.
pub(super) struct Cluster {
    /// Which flights they are.
    pub members: Vec<usize>,
    samples: Vec<Sample>,
}

impl Cluster {
    /// Puts together what wanders, in the order of the starts.
    pub fn all(samples: impl Iterator<Item = (usize, Sample)>) -> Vec<Self> {
        let mut clusters: Vec<Self> = Vec::new();
        for (member, sample) in samples {
            match clusters.iter_mut().find(|one| one.holds(&sample)) {
                Some(one) => {
                    one.members.push(member);
                    one.samples.push(sample);
                }
                None => clusters.push(Self { members: vec![member], samples: vec![sample] }),
            }
        }
        clusters
    }

    /// Whether another window is one of the same motion: its averages are within twice both errors, where what several
    /// windows differ by is an error as well.
    fn holds(&self, sample: &Sample) -> bool {
        let ended = |one: &Sample| one.stop == Stop::EndTime;
        ended(&self.samples[0]) == ended(sample) && self.is_like(&sample.facts)
    }

    /// Whether what is known of a motion that wanders may be of these windows.
    pub fn is_like(&self, facts: &Facts) -> bool {
        let windows: Vec<Facts> = self.samples.iter().map(|one| one.facts).collect();
        near(&windows, facts)
    }

    /// Whether relative error of the root mean square and error of the impacts per period are within limits.
    pub fn is_within(&self, [amplitude, impacts]: [f64; 2]) -> bool {
        let windows: Vec<Facts> = self.samples.iter().map(|one| one.facts).collect();
        let Facts { rms, impacts_per_period, .. } = Facts::pooled(&windows);
        rms.error <= amplitude * rms.value && impacts_per_period.error <= impacts
    }

    /// Whether its averages still go up or down: of a few windows where most do, of many where all do together.
    pub fn drifts(&self) -> bool {
        let count = self.samples.len();
        if count < MANY {
            return 2 * self.samples.iter().filter(|one| one.drifts).count() > count;
        }
        let change = |one: &Sample| one.mean_squares[1] - one.mean_squares[0];
        let changes: Vec<f64> = self.samples.iter().map(change).collect();
        let mean = changes.iter().sum::<f64>() / count as f64;
        let size = self.samples.iter().map(|one| one.mean_squares[0]).sum::<f64>() / count as f64;
        mean.abs() > (DRIFT * twice_standard_error(&changes)).max(NO_DIFFERENCE * size)
    }

    /// Whether it may be on its way to a motion that repeats, or to other averages; `young` is one that was not measured
    /// often enough to tell.
    pub fn settles(&self, young: bool) -> bool {
        let repeats = |one: &Sample| one.evidence.periodicity.is_some();
        let depth = |half: usize| self.samples.iter().map(|one| one.depths[half]).sum::<f64>();
        let stays = if self.samples.len() < MANY { STAYS } else { MANY_STAY };
        let fades = depth(0) > 0.0 && !stays.contains(&(depth(1) / depth(0)));
        let repeating = 2 * self.samples.iter().filter(|one| one.of_repeating_kind()).count();
        self.drifts()
            || repeating > self.samples.len()
                && (young || fades || self.samples.iter().any(repeats))
    }

    /// The motion. It has the regime of what all its windows show together.
    pub fn motion(&self, reached: Reached, settled: bool) -> Motion {
        let facts: Vec<Facts> = self.samples.iter().map(|one| one.facts).collect();
        let evidence: Vec<_> = self.samples.iter().map(|one| one.evidence).collect();
        Motion {
            facts: Facts::pooled(&facts),
            kind: Kind::Wanders,
            regime: Regime::of_several(&evidence),
            state: self.samples[0].begin,
            reached,
            settled: settled && !self.drifts(),
            stop: self.samples[0].stop,
        }
    }
}

/// Whether averages are within twice both errors of those of some windows.
fn near(windows: &[Facts], other: &Facts) -> bool {
    let count = windows.len() as f64;
    let near = |of: fn(&Facts) -> Value| {
        let values = || windows.iter().map(of);
        let mean = values().map(|one| one.value).sum::<f64>() / count;
        let apart = |one: Value| (one.value - mean) * (one.value - mean);
        let scatter = (values().map(apart).sum::<f64>() / count).sqrt();
        let own = (values().map(|one| one.error * one.error).sum::<f64>() / count).sqrt();
        let (other, errors) = (of(other).value, own.max(2.0 * scatter) + of(other).error);
        (mean - other).abs() <= (ERRORS * errors).max(NO_DIFFERENCE * mean.max(other))
    };
    near(|facts| facts.rms) && near(|facts| facts.impacts_per_period)
}
