//! How much accuracy for how much work: every layer asked the same question about one case.
//!
//! The question is the long-term motion that most starts lead to: the root mean square of the
//! oscillator's displacement, which every layer gives and which averages well, and the impacts per
//! period. The **best answer** is the exact orbit that the motion is proven to be, and where it is
//! none the longest simulation, with the scatter between its blocks. Errors are differences from it;
//! one that is smaller than the best answer's own is only known to be below that.
//!
//! Costs are operations as [`crate::operation_count`] counts them. Time is not measured here: whoever has a
//! clock runs [`TradeoffMethod::run`] again.

pub mod by_hand;
mod figure;
pub mod method;
pub mod page;

use serde::Serialize;

use crate::executor::Executor;
use crate::motions::{Effort, Measured, Motion, MotionKind, Place, Window, measured, motions};
use crate::regimes::Regime;
use crate::simulation::Simulation;
use crate::study::StudyError;
use crate::study::estimate::{self, Estimate, ORBIT_ROUNDING};
use crate::system::{State, System};
use by_hand::{ByHand, Flights, Locate};

pub use figure::figure;
pub use method::{ImpactSearch, MethodGroup, TradeoffMethod};

/// What is tried.
#[derive(Debug, Clone, PartialEq)]
pub struct TradeoffEffort {
    /// Where the long-term motion is looked for.
    pub search: Effort,
    /// Lengths of simulations, in excitation periods, transient included.
    pub lengths: Vec<u64>,
    /// Steps per period of the baseline.
    pub steps: Vec<u32>,
    /// Length of the baseline's runs, and of those at other tolerances and by the slow search.
    pub usual_length: u64,
    /// Periods over which a motion that is no orbit is measured for the best answer.
    pub longest: u64,
    /// Periods in which the baseline's flights are checked one by one.
    pub flights: u64,
}

impl Default for TradeoffEffort {
    fn default() -> Self {
        Self {
            search: Effort::default(),
            // From what shows a regime to what a modulated motion's average takes.
            lengths: vec![50, 100, 200, 500, 1000, 5000],
            steps: vec![50, 200, 1000, 5000],
            usual_length: 1000,
            // Twenty times the longest simulation that it judges, so that its scatter is a quarter
            // of theirs.
            longest: 100_000,
            // Some thousand impacts: a miss in a thousand is seen.
            flights: 2000,
        }
    }
}

/// Excursions at which chattering sequences are ended, over the clearance: larger than the engine's own.
const EXCURSIONS: [f64; 3] = [1e-3, 1e-6, 1e-9];
/// Periods simulated before Newton's method takes over.
const BEFORE_NEWTON: u64 = 400;

/// What all answers are compared with.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Best {
    /// Exact orbit or simulation.
    pub layer: MethodGroup,
    /// Periods measured, if it is a simulation.
    pub periods: Option<u64>,
    /// Impacts and periods of the orbit, if it is one.
    pub orbit: Option<(usize, u32)>,
    /// Root mean square displacement over the clearance.
    #[serde(rename = "rms_over_clearance")]
    pub rms: f64,
    /// Its relative error: two standard errors of a simulation, rounding of an orbit.
    pub rms_error: f64,
    /// Impacts per period.
    pub impacts_per_period: f64,
    /// Its error.
    pub impacts_error: f64,
    /// The regime.
    pub regime: Regime,
    /// Excitation periods in which a deviation shrinks to `1/e`: from an orbit by its largest
    /// multiplier, else by the oscillator's damping alone, which impacts may shorten; `None` without
    /// damping.
    pub decay_periods: Option<f64>,
    /// Whether it is a simulation that is still in its transient: its error is that, and no scatter.
    pub in_transient: bool,
}

/// The error of an answer.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ErrorOf {
    /// Size of the difference from the best answer; for a motion that does not repeat at least twice
    /// the answer's own standard error, since a lucky difference is no knowledge.
    pub value: f64,
    /// Whether that is below what the best answer itself is known to, which is then `value`.
    pub below: bool,
}

/// Share of a transient from which on it may be any error: a start may be many times larger than the
/// motion that it leads to.
const MUCH_LEFT: f64 = 0.1;

/// Ratio of the errors of a run and of the best answer up to which they may be one transient.
const ALIKE: f64 = 10.0;

/// One method on the case.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Trial {
    /// What was tried.
    #[serde(flatten)]
    pub method: TradeoffMethod,
    /// What it answers.
    #[serde(flatten)]
    pub answer: Estimate,
    /// What it cost.
    pub operations: u64,
    /// Relative error of the root mean square displacement.
    pub rms_error: Option<ErrorOf>,
    /// Absolute error of the impacts per period.
    #[serde(rename = "impacts_per_period_error")]
    pub impacts_error: Option<ErrorOf>,
    /// For the baseline: its flights, one by one.
    pub flights: Option<Flights>,
}

/// Accuracy and cost of every layer on one case.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Tradeoff {
    /// The system.
    #[serde(skip)]
    pub system: System,
    /// Where simulations begin.
    pub start: State,
    /// Which of the evenly spread starts that is; `None` where none of them leads to the motion.
    pub start_number: Option<u32>,
    /// The best answer.
    pub best: Best,
    /// Share of starts that lead to the motion in question.
    pub share: f64,
    /// How many other long-term motions there are.
    #[serde(rename = "other_motions")]
    pub others: usize,
    /// Whether the absorber rests on a wall at times.
    #[serde(rename = "sustained_contact")]
    pub rests: bool,
    /// Every method.
    #[serde(skip)]
    pub trials: Vec<Trial>,
}

impl Tradeoff {
    /// Tries every layer on `system`; `progress` is called after each of about
    /// [`Tradeoff::steps`] steps.
    ///
    /// # Errors
    /// [`StudyError`] where theory or simulation cannot be carried out.
    pub fn of(
        system: &System,
        effort: &TradeoffEffort,
        on: &dyn Executor,
        progress: &mut dyn FnMut(u64),
    ) -> Result<Self, StudyError> {
        let place = Place::new(system, effort.search.starts);
        let starts = place.starts.clone();
        let found = motions(&[place], &effort.search, on)?.pop().ok_or(StudyError::NoMotion)?;
        let (index, main) = found.main_index().zip(found.main()).ok_or(StudyError::NoMotion)?;
        progress(u64::from(effort.search.starts));
        let best = best(system, main, effort)?;
        progress(1);
        // The first start that leads there, so that transients are those of the case.
        let first = found.led().iter().position(|led| *led == Some(index));
        let first = first.and_then(|first| Some((u32::try_from(first).ok()?, *starts.get(first)?)));
        let (start_number, start) = (first.map(|one| one.0), first.map(|one| one.1));
        let start = start.unwrap_or(main.state());
        let seen = measured(system, main, &effort.search, &mut Measured::log())?;
        let rests = seen.sustained_contact.intervals > 0;
        let mut trials = Vec::new();
        for method in methods(&best, rests, effort) {
            trials.push(trial(system, start, method, &best, effort)?);
            progress(1);
        }
        Ok(Self {
            system: *system,
            start,
            start_number,
            share: found.share(main),
            others: found.len() - 1,
            rests,
            best,
            trials,
        })
    }

    /// Number of progress steps, about.
    pub fn steps(effort: &TradeoffEffort) -> u64 {
        u64::from(effort.search.starts)
            + 5
            + (2 * effort.lengths.len() + 2 * effort.steps.len()) as u64
    }

    /// Excitation periods that a simulation left out for its transient, if what is left of that and not
    /// scatter makes its error: its decay leaves enough of it, and the motion repeats, so that it has no
    /// scatter, or its averages settle, or those of the best answer do, which is longer, and it is not much
    /// further off than that.
    pub fn transient(&self, trial: &Trial) -> Option<u64> {
        let TradeoffMethod::Simulation { periods, .. } = trial.method else { return None };
        let error = trial.rms_error.filter(|error| !error.below)?.value;
        let (best, left_out) = (&self.best, periods / 2);
        let left = best.decay_periods.map_or(1.0, |decay| libm::exp(-(left_out as f64) / decay));
        let with_best = best.in_transient && error < ALIKE * best.rms_error;
        let seen = best.layer == MethodGroup::ExactOrbit || with_best || trial.answer.settles;
        (seen && left > error.min(MUCH_LEFT)).then_some(left_out)
    }

    /// The place of the cheapest trial of a layer whose error of the root mean square is within `allowed`:
    /// with the right regime, where it tells one, and not by chance, which means that every longer run and
    /// every smaller step of the same kind is within it too.
    pub fn cheapest(&self, layer: MethodGroup, allowed: f64) -> Option<usize> {
        let within = |trial: &Trial| trial.rms_error.is_some_and(|error| error.value <= allowed);
        let lasts = |(_, trial): &(usize, &Trial)| {
            let named = trial.answer.regime.is_none_or(|regime| regime == self.best.regime);
            let mut refined = self.trials.iter().filter(|other| other.method.refines(trial.method));
            named && within(trial) && refined.all(within)
        };
        let enough = self.of_layer(layer).filter(lasts);
        enough.min_by_key(|(_, trial)| trial.operations).map(|(place, _)| place)
    }

    /// The trials of a layer, with their places.
    fn of_layer(&self, layer: MethodGroup) -> impl Iterator<Item = (usize, &Trial)> {
        let all = self.trials.iter().enumerate();
        all.filter(move |(_, trial)| trial.method.layer() == layer)
    }
}

/// Whether a state is on a motion that repeats.
fn repeats(system: &System, state: State, effort: &TradeoffEffort) -> Result<bool, StudyError> {
    let window = Window { discard: 0, periods: effort.search.periods, impact_limit: u64::MAX };
    let seen = Measured::reach(system, state, &window)?;
    Ok(seen.classification.evidence.periodicity.is_some())
}

fn best(system: &System, main: &Motion, effort: &TradeoffEffort) -> Result<Best, StudyError> {
    let (layer, periods, orbit, decay_rate, answer) = match main.orbit() {
        Some(proven) => {
            let orbit = Some((proven.cycle.impact_count(), proven.cycle.periods()));
            let rate = -libm::log(proven.radius_per_period());
            (MethodGroup::ExactOrbit, None, orbit, rate, Estimate::of_motion(main))
        }
        None => {
            let mut periods = effort.longest;
            let answer = loop {
                let mut simulation = Simulation::new(system, main.state(), 0.0)?;
                let answer = estimate::measured(&mut simulation, periods);
                let answer = answer.ok_or(StudyError::NoMotion)?;
                // What wanders may be a transient: what a run that has left it averages is of two motions.
                let wanders = matches!(main.kind(), MotionKind::Wanders);
                let is_shortest = periods <= effort.search.periods;
                if !wanders || is_shortest || !repeats(system, simulation.state(), effort)? {
                    break answer;
                }
                periods /= 2;
            };
            let rate = 0.5 * system.mass_ratio() * system.damping() * system.period();
            (MethodGroup::Simulation, Some(periods), None, rate, answer)
        }
    };
    Ok(Best {
        layer,
        periods,
        orbit,
        rms: answer.rms.unwrap_or(0.0),
        rms_error: answer.scatter.unwrap_or(0.0).max(ORBIT_ROUNDING),
        impacts_per_period: answer.impacts_per_period.unwrap_or(0.0),
        impacts_error: answer.impacts_scatter.unwrap_or(0.0),
        regime: main.regime(),
        in_transient: answer.settles,
        decay_periods: (decay_rate > 0.0).then(|| 1.0 / decay_rate),
    })
}

fn methods(best: &Best, rests: bool, effort: &TradeoffEffort) -> Vec<TradeoffMethod> {
    let mut all = vec![TradeoffMethod::FixedPoints];
    all.extend(effort.lengths.iter().map(|periods| TradeoffMethod::SlowFlow { periods: *periods }));
    all.extend([TradeoffMethod::AveragedFlow, TradeoffMethod::SymmetricOrbit]);
    if best.layer == MethodGroup::ExactOrbit && best.regime != Regime::TwoSymmetric {
        all.push(TradeoffMethod::OrbitFromSimulation { periods: BEFORE_NEWTON });
    }
    let simulation =
        |periods, search, excursion| TradeoffMethod::Simulation { periods, search, excursion };
    all.extend(effort.lengths.iter().map(|n| simulation(*n, ImpactSearch::Panels, None)));
    if rests {
        let usual = effort.usual_length;
        all.extend(EXCURSIONS.iter().map(|at| simulation(usual, ImpactSearch::Panels, Some(*at))));
    }
    all.push(simulation(effort.usual_length, ImpactSearch::StepByStep, None));
    for locate in [Locate::Bisection, Locate::Interpolation] {
        let periods = effort.usual_length;
        all.extend(effort.steps.iter().map(|n| TradeoffMethod::FixedStep {
            periods,
            steps: *n,
            locate,
        }));
    }
    all
}

fn trial(
    system: &System,
    start: State,
    method: TradeoffMethod,
    best: &Best,
    effort: &TradeoffEffort,
) -> Result<Trial, StudyError> {
    let (answer, operations) = method.run(system, start)?;
    // What repeats has no scatter but that of its transient, which is an error and seen as one.
    let repeats = best.layer == MethodGroup::ExactOrbit;
    let own = |scatter: Option<f64>| scatter.filter(|scatter| !repeats && scatter.is_finite());
    let flights = match method {
        TradeoffMethod::FixedStep { steps, locate, .. } => {
            Some(Flights::of(&ByHand::new(system, steps, locate), start, effort.flights)?)
        }
        _ => None,
    };
    let error = |value: f64, scatter: Option<f64>, best: f64| {
        let value = value.abs().max(own(scatter).unwrap_or(0.0));
        ErrorOf { value: value.max(best), below: value < best }
    };
    Ok(Trial {
        method,
        operations,
        rms_error: answer
            .rms
            .map(|rms| error(rms / best.rms - 1.0, answer.scatter, best.rms_error)),
        impacts_error: answer.impacts_per_period.map(|z| {
            error(z - best.impacts_per_period, answer.impacts_scatter, best.impacts_error)
        }),
        flights,
        answer,
    })
}
