//! The layers that a question can be put to, and what each answers.

use super::by_hand::{ByHand, Listener, Locate};
use crate::analysis::motion::root_mean_square;
use crate::analysis::slow_motion::{SlowEnd, SlowFlow};
use crate::analysis::{FixedPoint, Manifold, fixed_points};
use crate::numerics::scatter::twice_standard_error;
use crate::operation_count;
use crate::orbits::{Measures, symmetric_orbits};
use crate::regimes::{Attractor, Regime, Window, classify};
use crate::simulation::{ContactTolerance, ImpactLog, Simulation, Statistics, Stop};
use crate::study::{Proof, StudyError};
use crate::system::{State, System};

/// Which search for impacts a simulation uses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Search {
    /// By phasors in panels of the period.
    Panels,
    /// By bounding parabolas, step by step.
    StepByStep,
}

/// A way to an answer. Periods are excitation periods in all; a simulation leaves the first half to
/// the transient and measures the second.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// The manifold and the fixed points of the slow flow, in closed form.
    FixedPoints,
    /// The slow flow (18), integrated for so many excitation periods.
    SlowFlow {
        /// Excitation periods.
        periods: u64,
    },
    /// The symmetric orbit of the full system, in closed form.
    SymmetricOrbit,
    /// Any other orbit: a simulation of so many periods gives its impacts, Newton's method the orbit.
    OrbitFromSimulation {
        /// Excitation periods.
        periods: u64,
    },
    /// The event engine.
    Simulation {
        /// Excitation periods.
        periods: u64,
        /// How impacts are found.
        search: Search,
        /// Excursion at which a chattering sequence is ended, over the clearance.
        excursion: f64,
    },
    /// The Runge-Kutta method with a fixed step.
    FixedStep {
        /// Excitation periods.
        periods: u64,
        /// Steps in a period.
        steps: u32,
        /// How impacts are located in a step.
        locate: Locate,
    },
}

/// The group that a method belongs to, in order of effort.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Layer {
    /// Manifold and fixed points.
    ClosedForm,
    /// Slow flow in time.
    SlowFlow,
    /// Exact periodic orbit.
    ExactOrbit,
    /// Event-driven simulation.
    Simulation,
    /// Fixed-step integration.
    FixedStep,
}

impl Layer {
    /// The name in a report.
    pub fn words(self) -> &'static str {
        match self {
            Self::ClosedForm => "closed form",
            Self::SlowFlow => "slow flow",
            Self::ExactOrbit => "exact orbit",
            Self::Simulation => "event-driven simulation",
            Self::FixedStep => "fixed step by hand",
        }
    }
}

/// What a method answers; lengths over the clearance. `None` where it gives no such answer.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Answer {
    /// Root mean square displacement of the oscillator.
    pub rms: Option<f64>,
    /// Twice the standard error of `rms`, relative, from the scatter between blocks of the measured
    /// window; for simulations only.
    pub scatter: Option<f64>,
    /// Whether the blocks approach a value exponentially: a transient makes `scatter`.
    pub settles: bool,
    /// Impacts per excitation period.
    pub impacts_per_period: Option<f64>,
    /// Twice the standard error of that.
    pub impacts_scatter: Option<f64>,
    /// The regime.
    pub regime: Option<Regime>,
    /// Why something is missing.
    pub why_not: Option<&'static str>,
}

/// Blocks that a measured window is cut into: enough for a standard error, few enough for each to be
/// longer than what it averages over.
const BLOCKS: u64 = 10;
/// Impacts after which a stretch is given up.
const IMPACT_LIMIT: u64 = 10_000_000;

impl Method {
    /// The layer it belongs to.
    pub fn layer(self) -> Layer {
        match self {
            Self::FixedPoints => Layer::ClosedForm,
            Self::SlowFlow { .. } => Layer::SlowFlow,
            Self::SymmetricOrbit | Self::OrbitFromSimulation { .. } => Layer::ExactOrbit,
            Self::Simulation { .. } => Layer::Simulation,
            Self::FixedStep { .. } => Layer::FixedStep,
        }
    }

    /// Whether it is `other` with a longer run or smaller steps, all else being the same.
    pub fn refines(self, other: Self) -> bool {
        match (self, other) {
            (Self::SlowFlow { periods: more }, Self::SlowFlow { periods }) => more > periods,
            (
                Self::Simulation { periods: more, search, excursion },
                Self::Simulation { periods, search: same, excursion: equal },
            ) => more > periods && search == same && excursion == equal,
            (
                Self::FixedStep { steps: more, periods, locate },
                Self::FixedStep { steps, periods: equal, locate: same },
            ) => more > steps && periods == equal && locate == same,
            _ => false,
        }
    }

    /// What it answers about `system`; simulations begin at `start`. The second value is what that
    /// cost in operations.
    ///
    /// # Errors
    /// [`StudyError`] where it cannot be carried out.
    pub fn run(self, system: &System, start: State) -> Result<(Answer, u64), StudyError> {
        let (answer, operations) = operation_count::counted(|| self.answer(system, start));
        Ok((answer?, operations))
    }

    fn answer(self, system: &System, start: State) -> Result<Answer, StudyError> {
        match self {
            Self::FixedPoints => closed_form(system),
            Self::SlowFlow { periods } => slow_flow(system, periods),
            Self::SymmetricOrbit => Ok(symmetric_orbit(system)),
            Self::OrbitFromSimulation { periods } => orbit_near(system, start, periods),
            Self::Simulation { periods, search, excursion } => {
                simulated(system, start, periods, search, excursion)
            }
            Self::FixedStep { periods, steps, locate } => {
                Ok(by_hand(&ByHand::new(system, steps, locate), start, periods))
            }
        }
    }
}

fn no_answer(why: &'static str) -> Answer {
    Answer { why_not: Some(why), ..Answer::default() }
}

fn steady(rms: f64) -> Answer {
    Answer {
        rms: Some(rms),
        impacts_per_period: Some(2.0),
        regime: Some(Regime::TwoSymmetric),
        ..Answer::default()
    }
}

/// The answer that a stable fixed point is.
pub fn of_fixed_point(system: &System, point: &FixedPoint) -> Answer {
    steady(root_mean_square(
        system,
        point.oscillator_amplitude,
        point.absorber_amplitude,
        point.absorber_phase,
    ))
}

fn closed_form(system: &System) -> Result<Answer, StudyError> {
    let manifold = Manifold::of(system.restitution());
    let points = fixed_points::solve(system, &manifold)?;
    let stable = points.iter().rfind(|point| point.stable && point.admissible);
    Ok(match stable {
        Some(point) => of_fixed_point(system, point),
        None => no_answer("no stable fixed point: the theory has no steady amplitude"),
    })
}

/// The flow begins in the middle of the stable branch, in phase with the excitation.
fn slow_flow(system: &System, periods: u64) -> Result<Answer, StudyError> {
    let manifold = Manifold::of(system.restitution());
    let flow = SlowFlow::of(system, &manifold);
    let middle = 0.5
        * (manifold.fold.oscillator_amplitude + manifold.symmetry_breaking.oscillator_amplitude);
    let Some(start) = flow.point(middle, 0.0) else {
        return Ok(no_answer("the stable branch has no middle"));
    };
    Ok(match flow.follow(start, periods) {
        SlowEnd::Settles(at) | SlowEnd::Moving(at)
            if at.absorber_amplitude > manifold.symmetry_breaking.absorber_amplitude =>
        {
            no_answer("beyond symmetry breaking, where the branch is unstable")
        }
        SlowEnd::Settles(at) | SlowEnd::Moving(at) => steady(root_mean_square(
            system,
            at.oscillator_amplitude,
            at.absorber_amplitude,
            at.absorber_phase,
        )),
        SlowEnd::LeavesAtFold { .. } => {
            no_answer("leaves the manifold at the fold: the theory gives no steady amplitude")
        }
    })
}

fn symmetric_orbit(system: &System) -> Answer {
    let orbits = symmetric_orbits(system).unwrap_or_default();
    let Some(orbit) = orbits.iter().find(|orbit| orbit.orbit.attracts()) else {
        return no_answer("no symmetric orbit is stable and admissible");
    };
    match Measures::of(system, &orbit.orbit.cycle) {
        Ok(measures) => steady(measures.rms),
        Err(_) => no_answer("no steady motion between impacts"),
    }
}

fn orbit_near(system: &System, start: State, periods: u64) -> Result<Answer, StudyError> {
    let mut simulation = Simulation::new(system, start, 0.0)?;
    let discard = periods / 2;
    let window = Window { discard, periods: periods - discard, impact_limit: IMPACT_LIMIT };
    let found = Attractor::measure(&mut simulation, &window);
    Ok(match Proof::of(system, &found) {
        Some(proof) => Answer {
            rms: Some(proof.measures.rms),
            impacts_per_period: Some(impacts_per_period(&proof)),
            regime: Some(found.classification.regime),
            ..Answer::default()
        },
        None => no_answer("the simulated motion does not repeat yet: no orbit to solve for"),
    })
}

/// Impacts per period of a proven orbit.
pub fn impacts_per_period(proof: &Proof) -> f64 {
    proof.orbit.cycle.impact_count() as f64 / f64::from(proof.orbit.cycle.periods())
}

fn simulated(
    system: &System,
    start: State,
    periods: u64,
    search: Search,
    excursion: f64,
) -> Result<Answer, StudyError> {
    let tolerance = ContactTolerance { excursion, ..ContactTolerance::default() };
    let mut simulation = Simulation::new(system, start, 0.0)?.with_tolerance(tolerance);
    if search == Search::StepByStep {
        simulation = simulation.step_by_step();
    }
    let discard = periods / 2;
    let stop = simulation.run(discard, IMPACT_LIMIT, &mut ());
    let answer = match stop {
        Stop::EndTime => measured(&mut simulation, periods - discard),
        other => Some(no_answer(other.words())),
    };
    // The slow search notes every evaluation itself.
    if search == Search::Panels {
        operation_count::note(simulation.operations());
    }
    Ok(answer.unwrap_or_else(|| no_answer("the run was ended by its limit on impacts")))
}

/// The averages of so many periods from here, with their scatter between blocks.
pub fn measured(simulation: &mut Simulation, periods: u64) -> Option<Answer> {
    let system = *simulation.system();
    let mut statistics = Statistics::begin(&system, simulation.state());
    let mut log = ImpactLog::of_the_last(LAST_IMPACTS);
    let blocks = BLOCKS.min(periods).max(1);
    let mut sums = vec![[0.0; 2]];
    for block in 0..blocks {
        let until = periods * (block + 1) / blocks;
        let length = until - statistics.periods();
        let observer = &mut (&mut statistics, &mut log);
        if simulation.run(length, IMPACT_LIMIT, observer) != Stop::EndTime {
            return None;
        }
        let so_far = statistics.periods() as f64;
        sums.push([statistics.rms() * statistics.rms() * so_far, statistics.impacts() as f64]);
    }
    let lengths = (0..blocks).map(|k| (periods * (k + 1) / blocks - periods * k / blocks) as f64);
    let means: Vec<[f64; 2]> = sums
        .windows(2)
        .zip(lengths)
        .map(|(pair, length)| [0, 1].map(|k| (pair[1][k] - pair[0][k]) / length))
        .collect();
    let rms = statistics.rms();
    let [scatter, impacts_scatter] = scatters(&means, rms);
    let classified = classify(&statistics, &log.impacts, None, system.period());
    Some(Answer {
        rms: Some(rms),
        scatter: Some(scatter),
        settles: settles(&means.iter().map(|block| block[0]).collect::<Vec<_>>()),
        impacts_per_period: Some(statistics.impacts_per_period()),
        impacts_scatter: Some(impacts_scatter),
        regime: Some(classified.regime),
        why_not: None,
    })
}

/// Impacts that are kept of a run: enough to name its regime.
const LAST_IMPACTS: usize = 20_000;

/// Two standard errors of the root mean square, relative, and of the impacts per period, from means
/// of `x^2` and impacts in blocks.
fn scatters(means: &[[f64; 2]], rms: f64) -> [f64; 2] {
    // The square varies twice as much as its root.
    let square = (2.0 * rms * rms).max(f64::MIN_POSITIVE);
    let error =
        |k: usize| twice_standard_error(&means.iter().map(|block| block[k]).collect::<Vec<_>>());
    [error(0) / square, error(1)]
}

/// Share of the variance between blocks that an exponential must explain to be taken for one: a
/// modulation, regular or not, comes and goes and leaves it far below.
const EXPLAINED: f64 = 0.95;
/// What three blocks may at least leave of it: what is over within a block is no trend.
const LEAST_LEFT: f64 = 1e-3;

/// Whether averages over successive blocks approach a value exponentially.
fn settles(blocks: &[f64]) -> bool {
    let third = blocks.len() / 3;
    if third < 3 {
        return false;
    }
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let [first, second, last] = [0, 1, 2].map(|k| mean(&blocks[k * third..(k + 1) * third]));
    let left = (second - last) / (first - second);
    if !(LEAST_LEFT..1.0).contains(&left) {
        return false;
    }
    let factor = libm::pow(left, 1.0 / third as f64);
    let shape: Vec<f64> = (0..blocks.len()).map(|k| libm::pow(factor, k as f64)).collect();
    let (middle, level) = (mean(&shape), mean(blocks));
    let product = |a: &[f64], a0: f64, b: &[f64], b0: f64| {
        a.iter().zip(b).map(|(a, b)| (a - a0) * (b - b0)).sum::<f64>()
    };
    let across = product(&shape, middle, blocks, level);
    let explained = across * across / product(&shape, middle, &shape, middle);
    explained > EXPLAINED * product(blocks, level, blocks, level)
}

/// Impacts per period, over all periods so far and ten more, above which a fixed step is given up: it
/// has one in nearly every step, and none of them is an impact.
const MOST_IMPACTS: u64 = 400;

/// Counts impacts and sums squares at the ends of steps, in blocks of the second half of a run.
struct Sums {
    impacts: u64,
    skip: u64,
    steps: u64,
    all: u64,
    /// Of each block: steps, squares, impacts.
    blocks: Vec<[f64; 3]>,
}

impl Sums {
    fn block(&mut self) -> Option<&mut [f64; 3]> {
        let measured = self.steps.checked_sub(self.skip)?;
        let count = self.blocks.len() as u64;
        self.blocks.get_mut((measured * count / (self.all - self.skip).max(1)) as usize)
    }
}

impl Listener for Sums {
    fn impact(&mut self, _: f64, _: &State) {
        operation_count::note(12);
        self.impacts += 1;
        if let Some(block) = self.block() {
            block[2] += 1.0;
        }
    }
    fn step(&mut self, state: &State) {
        operation_count::note(2);
        if let Some(block) = self.block() {
            block[0] += 1.0;
            block[1] += state.x * state.x;
        }
        self.steps += 1;
    }
}

fn by_hand(hand: &ByHand, start: State, periods: u64) -> Answer {
    let discard = periods / 2;
    let per_period = hand.steps_per_period();
    let blocks = BLOCKS.min(periods - discard).max(1) as usize;
    let (skip, all) = (discard * per_period, periods * per_period);
    let mut sums = Sums { impacts: 0, skip, steps: 0, all, blocks: vec![[0.0; 3]; blocks] };
    let mut end = start;
    for period in 0..periods {
        end = hand.run(end, 1, &mut sums);
        if sums.impacts > MOST_IMPACTS * (period + 10) {
            return no_answer("impacts in nearly every step, so it was given up");
        }
    }
    if !end.x.is_finite() {
        return no_answer("a number that overflowed");
    }
    let total = |k: usize| sums.blocks.iter().map(|block| block[k]).sum::<f64>();
    let means: Vec<[f64; 2]> = sums
        .blocks
        .iter()
        .map(|[steps, squares, impacts]| [squares / steps, impacts / steps * per_period as f64])
        .collect();
    let rms = (total(1) / total(0)).sqrt();
    let [scatter, impacts_scatter] = scatters(&means, rms);
    Answer {
        rms: Some(rms),
        scatter: Some(scatter),
        impacts_per_period: Some(total(2) / total(0) * per_period as f64),
        impacts_scatter: Some(impacts_scatter),
        ..Answer::default()
    }
}

#[cfg(test)]
mod tests {
    use super::settles;

    #[test]
    fn only_an_exponential_settles() {
        let blocks =
            |of: &dyn Fn(f64) -> f64| (0..10).map(|k| of(f64::from(k))).collect::<Vec<_>>();
        for factor in [0.2, 0.6, 0.97] {
            assert!(settles(&blocks(&|k| 3.0 - libm::pow(factor, k))), "{factor}");
            // Some modulation on top of it changes nothing.
            assert!(settles(&blocks(&|k| libm::pow(factor, k) + 0.01 * libm::sin(2.5 * k))));
        }
        for turn in [0.5, 1.0, 2.0, 2.5, 3.0] {
            assert!(!settles(&blocks(&|k| 1.0 + libm::sin(turn * k + 0.3))), "{turn}");
        }
        // Neither one that grows, nor what does not change, nor a single odd block.
        assert!(!settles(&blocks(&|k| libm::pow(1.5, k))));
        assert!(!settles(&[1.0; 10]));
        assert!(!settles(&blocks(&|k| if k == 0.0 {
            5.0
        } else {
            1.0 + 0.1 * libm::sin(7.0 * k)
        })));
        assert!(!settles(&[2.0, 1.0]));
    }
}
