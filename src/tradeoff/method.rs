//! The layers that a question can be put to, and what each answers.

use serde::Serialize;

use super::by_hand::{ByHand, Locate};
use crate::analysis::Manifold;
use crate::analysis::motion::root_mean_square;
use crate::analysis::slow_motion::{SlowEnd, SlowFlow};
use crate::motions::{Measured, Window, orbit_of};
use crate::operation_count;
use crate::orbits::Measures;
use crate::simulation::{ContactTolerance, Simulation, Stop};
use crate::study::StudyError;
use crate::study::estimate::{self, BLOCKS, Estimate, IMPACT_LIMIT, WhyNoAnswer, measured};
use crate::system::{State, System};

/// Which search for impacts a simulation uses.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ImpactSearch {
    /// By phasors in panels of the period.
    Panels,
    /// By bounding parabolas, step by step.
    StepByStep,
}

/// A way to an answer. Periods are excitation periods in all; a simulation leaves the first half to
/// the transient and measures the second.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "method", rename_all = "kebab-case")]
pub enum TradeoffMethod {
    /// The manifold and the fixed points of the slow flow, in closed form.
    FixedPoints,
    /// The slow flow (18), integrated for so many excitation periods.
    SlowFlow {
        /// Excitation periods.
        periods: u64,
    },
    /// The dissipation curve, and the steady amplitudes of the slow flow on it, in any regime.
    AveragedFlow,
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
        search: ImpactSearch,
        /// Excursion at which a chattering sequence is ended, over the clearance, where that is not the
        /// engine's own.
        excursion: Option<f64>,
    },
    /// The Runge-Kutta method with a fixed step.
    FixedStep {
        /// Excitation periods.
        periods: u64,
        /// Steps in a period.
        #[serde(rename = "steps_per_period")]
        steps: u32,
        /// How impacts are located in a step.
        locate: Locate,
    },
}

/// The group that a method belongs to, in order of effort.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum MethodGroup {
    /// Manifold and fixed points.
    ClosedForm,
    /// Slow flow in time.
    SlowFlow,
    /// Slow flow with averages over the motion of the impact pair.
    AveragedFlow,
    /// Exact periodic orbit.
    ExactOrbit,
    /// Event-driven simulation.
    Simulation,
    /// Fixed-step integration.
    FixedStep,
}

impl TradeoffMethod {
    /// The layer it belongs to.
    pub fn layer(self) -> MethodGroup {
        match self {
            Self::FixedPoints => MethodGroup::ClosedForm,
            Self::SlowFlow { .. } => MethodGroup::SlowFlow,
            Self::AveragedFlow => MethodGroup::AveragedFlow,
            Self::SymmetricOrbit | Self::OrbitFromSimulation { .. } => MethodGroup::ExactOrbit,
            Self::Simulation { .. } => MethodGroup::Simulation,
            Self::FixedStep { .. } => MethodGroup::FixedStep,
        }
    }

    /// Whether it is `other` with a longer run or smaller steps, all else being the same.
    pub fn refines(self, other: Self) -> bool {
        let ((one, size), (same, less)) = (self.refined(), other.refined());
        one == same && size > less
    }

    /// The method without what refines it, and that: its length, or of a fixed step the steps in a period.
    fn refined(mut self) -> (Self, u64) {
        let size = match &mut self {
            Self::SlowFlow { periods } | Self::Simulation { periods, .. } => {
                std::mem::take(periods)
            }
            Self::FixedStep { steps, .. } => u64::from(std::mem::take(steps)),
            _ => 0,
        };
        (self, size)
    }

    /// What it answers about `system`; simulations begin at `start`. The second value is what that
    /// cost in operations.
    ///
    /// # Errors
    /// [`StudyError`] where it cannot be carried out.
    pub fn run(self, system: &System, start: State) -> Result<(Estimate, u64), StudyError> {
        let (answer, operations) = operation_count::counted(|| self.answer(system, start));
        Ok((answer?, operations))
    }

    fn answer(self, system: &System, start: State) -> Result<Estimate, StudyError> {
        match self {
            Self::FixedPoints => estimate::closed_form(system),
            Self::SlowFlow { periods } => slow_flow(system, periods),
            Self::AveragedFlow => estimate::averaged_flow(system),
            Self::SymmetricOrbit => Ok(estimate::symmetric_orbit(system)),
            Self::OrbitFromSimulation { periods } => orbit_near(system, start, periods),
            Self::Simulation { periods, search, excursion } => {
                simulated(system, start, periods, search, excursion)
            }
            Self::FixedStep { periods, steps, locate } => {
                Ok(fixed_step(&ByHand::new(system, steps, locate), start, periods))
            }
        }
    }
}

/// The flow begins in the middle of the stable branch, in phase with the excitation.
fn slow_flow(system: &System, periods: u64) -> Result<Estimate, StudyError> {
    let manifold = Manifold::of(system.restitution());
    let flow = SlowFlow::of(system, &manifold);
    let middle = 0.5
        * (manifold.fold.oscillator_amplitude + manifold.symmetry_breaking.oscillator_amplitude);
    let Some(start) = flow.point(middle, 0.0) else {
        return Ok(Estimate::none(WhyNoAnswer::NoMiddle));
    };
    Ok(match flow.follow(start, periods) {
        SlowEnd::Settles(at) | SlowEnd::Moving(at)
            if at.absorber_amplitude > manifold.symmetry_breaking.absorber_amplitude =>
        {
            Estimate::none(WhyNoAnswer::BeyondSymmetryBreaking)
        }
        SlowEnd::Settles(at) | SlowEnd::Moving(at) => Estimate::steady(root_mean_square(
            system,
            at.oscillator_amplitude,
            at.absorber_amplitude,
            at.absorber_phase,
        )),
        SlowEnd::LeavesAtFold { .. } => Estimate::none(WhyNoAnswer::LeavesAtFold),
    })
}

fn orbit_near(system: &System, start: State, periods: u64) -> Result<Estimate, StudyError> {
    let mut simulation = Simulation::new(system, start, 0.0)?;
    let discard = periods / 2;
    let window = Window { discard, periods: periods - discard, impact_limit: IMPACT_LIMIT };
    let found = Measured::of(&mut simulation, &window, &mut Measured::log());
    let measures = orbit_of(system, &found).and_then(|one| Measures::of(system, &one.cycle).ok());
    Ok(match measures {
        // Errors are differences from the best answer, which is this orbit.
        Some(measures) => Estimate {
            rms: Some(measures.rms),
            impacts_per_period: Some(found.facts.impacts_per_period.value),
            regime: Some(found.regime()),
            ..Estimate::default()
        },
        None => Estimate::none(WhyNoAnswer::NotRepeating),
    })
}

fn simulated(
    system: &System,
    start: State,
    periods: u64,
    search: ImpactSearch,
    excursion: Option<f64>,
) -> Result<Estimate, StudyError> {
    let usual = ContactTolerance::default();
    let tolerance = ContactTolerance { excursion: excursion.unwrap_or(usual.excursion), ..usual };
    let mut simulation = Simulation::new(system, start, 0.0)?.with_tolerance(tolerance);
    if search == ImpactSearch::StepByStep {
        simulation = simulation.step_by_step();
    }
    let discard = periods / 2;
    let stop = simulation.run(discard, IMPACT_LIMIT, &mut ());
    let answer = match stop {
        Stop::EndTime => measured(&mut simulation, periods - discard),
        Stop::NotFinite => Some(Estimate::none(WhyNoAnswer::Overflow)),
        Stop::WallsUnresolved => Some(Estimate::none(WhyNoAnswer::WallsUnresolved)),
        Stop::ImpactLimit => None,
    };
    // The slow search notes every evaluation itself.
    if search == ImpactSearch::Panels {
        operation_count::note(simulation.operations());
    }
    Ok(answer.unwrap_or_else(|| Estimate::none(WhyNoAnswer::ImpactLimit)))
}

/// Impacts per period, over all periods so far and ten more, above which a fixed step is given up: it
/// has one in nearly every step, and none of them is an impact.
const MOST_IMPACTS: u64 = 400;

/// The first half of the periods is left out, the second measured in blocks.
fn fixed_step(hand: &ByHand, start: State, periods: u64) -> Estimate {
    let discard = periods / 2;
    let measured = periods - discard;
    let blocks = BLOCKS.min(measured).max(1);
    let ends = (0..=blocks).map(|block| discard + measured * block / blocks);
    let (mut state, mut done, mut all_impacts) = (start, 0, 0);
    // Of each block: the sum of x^2 over the steps in a period, and of impacts; then the mean of both.
    let (mut total, mut means) = ([0.0; 2], Vec::new());
    for (block, end) in ends.enumerate() {
        let (first, mut sums) = (done, [0.0; 2]);
        while done < end {
            let run = hand.run(state, 1);
            let impacts = run.impacts.len() as u64;
            operation_count::note(12 * impacts + 2 * hand.steps_per_period());
            all_impacts += impacts;
            if all_impacts > MOST_IMPACTS * (done + 10) {
                return Estimate::none(WhyNoAnswer::ImpactsInEveryStep);
            }
            sums[0] += run.squares / hand.steps_per_period() as f64;
            sums[1] += impacts as f64;
            (state, done) = (run.end, done + 1);
        }
        if block > 0 {
            total = [0, 1].map(|k| total[k] + sums[k]);
            means.push(sums.map(|sum| sum / (end - first) as f64));
        }
    }
    if !state.x.is_finite() {
        return Estimate::none(WhyNoAnswer::Overflow);
    }
    let [square, impacts] = total.map(|sum| sum / measured as f64);
    Estimate { settles: false, ..Estimate::averaged(square.sqrt(), impacts, &means) }
}
