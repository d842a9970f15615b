//! The absorber that serves a case best: clearance, and on request restitution and mass.
//!
//! Cheap layers propose: areas of the theory and stability of orbits as roots, or a coarse survey of the
//! band ([`task`]), looked at everywhere between the bounds ([`search`]). The survey of the whole band
//! disposes: every absorber that is shown was judged as `check` judges it ([`design`]), criteria included,
//! and the best of those whose criteria hold wins. The same once more for what is expected where parameters
//! are uncertain ([`robust`]).
//!
//! For the program itself: this module may change at any time.

pub mod chart;
pub mod claim;
pub mod design;
pub mod guess;
pub mod robust;
pub mod search;
pub mod sensitivity;
pub mod task;

mod choose;

pub use design::JudgedDesign;
pub use task::{Bounds, Task};

use crate::analysis::Strip;
use crate::band::theory;
use crate::case::{self, Case, Criterion, Objective, Relation, RewriteError, Rewritten};
use crate::executor::Executor;
use crate::flights::DrivenError;
use crate::measure::Measure;
use crate::operating_range::{Edge, edges};
use crate::simulation::StartError;
use design::Judge;

/// Why a case cannot be optimised.
#[derive(Debug, thiserror::Error)]
pub enum OptimizeError {
    /// Nothing drives the oscillator: every absorber is as good as any other.
    #[error("the case is not driven: its excitation has the amplitude 0")]
    NotDriven,
    /// The chosen absorber cannot be written into the case.
    #[error(transparent)]
    Rewrite(#[from] RewriteError),
    /// A simulation cannot begin.
    #[error(transparent)]
    Start(#[from] StartError),
    /// A motion beside the chosen absorber cannot be followed.
    #[error(transparent)]
    Driven(#[from] DrivenError),
    /// Areas are those of an ideal cavity.
    #[error("{}; ask for stable-share", crate::case::AREAS_ARE_IDEAL)]
    RealCavity,
    /// The objective has a value nowhere between the bounds.
    #[error("the objective cannot be evaluated anywhere between the bounds")]
    Nowhere,
}

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Optimization {
    /// What was looked for.
    pub task: Task,
    /// The best of all that were judged: of those whose criteria hold, if there are any.
    pub best: JudgedDesign,
    /// Its objective and error once more, by a check of the case as it is written.
    pub checked: (f64, f64),
    /// The case's own absorber.
    pub own: JudgedDesign,
    /// Where no absorber meets all criteria: the one that misses them least.
    pub closest: Option<JudgedDesign>,
    /// The mass ratio with which by the first guess the displacement that a criterion allows is reached, where no absorber
    /// meets all criteria.
    pub needed_mass_ratio: Option<f64>,
    /// The best in expectation, where something is uncertain.
    pub robust: Option<robust::Robust>,
    /// Every absorber that was judged, in the order of the clearance.
    pub judged: Vec<JudgedDesign>,
    /// Clearances whose objective is as good as the best one's, all else held, before rounding.
    pub plateau: [f64; 2],
    /// What the cheap layer says over the clearance: places with the objective's value. A line joins them
    /// only for an exact objective.
    pub landscape: Vec<(f64, f64)>,
    /// What a change of each parameter does at the best.
    pub sensitivities: Vec<sensitivity::Sensitivity>,
    /// The paper's claim on the case itself.
    pub claim: Option<claim::OptimumClaim>,
    /// Numbers a fiftieth beside which the best no longer does what is said of it.
    pub edges: Vec<Edge>,
    /// Where the share in Z3 is looked for, how much of it is in the strips A1 and A2, in which the motion is
    /// not, or not always, a steady 1:1 one.
    pub strips: Option<[f64; 2]>,
    /// The best clearance of one excitation alone.
    pub chart: Vec<chart::Suited>,
}

fn strips(task: &Task, choice: &case::Design) -> Option<[f64; 2]> {
    if task.objective != Objective::Z3Share {
        return None;
    }
    let band = task.band_of(choice)?;
    let zones = theory::zones(&band);
    let share = |strip| band.share(&zones, |zone| zone.is_z3() && zone.strip == Some(strip));
    Some([Strip::A1, Strip::A2].map(share))
}

/// The absorber with the smallest worst amplitude of a few clearances between the bounds of a task.
///
/// # Errors
/// As [`Optimization::of`].
pub fn best_of_few(
    task: &Task,
    text: &str,
    executor: &dyn Executor,
) -> Result<JudgedDesign, OptimizeError> {
    let designs = choose::few(&Judge { task, text }, executor)?;
    choose::best(&designs, task.objective).cloned().ok_or(OptimizeError::Nowhere)
}

impl Optimization {
    /// Optimises a task, `text` being that of its case's file.
    ///
    /// # Errors
    /// [`OptimizeError`] where there is nothing to choose, the text is not the case's, or the objective
    /// has no value.
    pub fn of(task: &Task, text: &str, executor: &dyn Executor) -> Result<Self, OptimizeError> {
        let judge = Judge { task, text };
        let own = judge.own(executor)?;
        let proposed = choose::propose(task, executor)?;
        let mut designs = choose::judged(&judge, &proposed, executor)?;
        let robust = robust::best(&judge, &proposed, &designs, &own, executor)?;
        let best = choose::best(&designs, task.objective).ok_or(OptimizeError::Nowhere)?.clone();
        // The case's own absorber wins ties.
        let best =
            if own.is_clearly_worse_than(&best, task.objective) { best } else { own.clone() };
        let text = best.written.text.clone();
        let again = Case::parse("the optimised case", &text).map_err(Box::new);
        let again = Rewritten { case: again.map_err(RewriteError::from)?, text };
        let again = judge.judged(again, executor)?;
        let closest = designs.iter().chain([&own]).filter(|_| !best.is_feasible());
        let closest = closest.min_by(|a, b| a.violation().total_cmp(&b.violation())).cloned();
        let allows =
            |one: &&Criterion| one.measure == Measure::Peak && one.relation == Relation::AtMost;
        let limit = task.case.criteria.iter().find(allows).filter(|_| closest.is_some());
        let needed = limit.and_then(|one| guess::mass_ratio(&task.case, one.limit));
        let watched = (task.objective == Objective::WorstAmplitude).then_some(Measure::Peak);
        let edges = match best.is_feasible() {
            true => edges(&best.written.case, watched, &task.effort, executor)?,
            false => Vec::new(),
        };
        designs.sort_by(|a, b| a.choice.clearance().total_cmp(&b.choice.clearance()));
        Ok(Self {
            closest,
            needed_mass_ratio: needed.filter(|one| *one > best.written.case.system().mass_ratio()),
            judged: designs,
            robust,
            plateau: proposed.plateau,
            landscape: proposed.landscape,
            sensitivities: sensitivity::of(task, &best.choice, executor),
            claim: claim::OptimumClaim::of(&task.case.system()),
            edges,
            strips: strips(task, &best.choice),
            chart: chart::chart(task, &best.choice, executor),
            task: task.clone(),
            checked: (again.value, again.error),
            best,
            own,
        })
    }

    /// Whether the best is another absorber than the case's own, and not worse.
    pub fn improves(&self) -> bool {
        self.reached() && self.best.choice != self.own.choice
    }

    /// Whether anything was reached: a share or margin above 0, an amplitude that is a number.
    pub fn reached(&self) -> bool {
        let value = self.best.value;
        value.is_finite() && (value != 0.0 || self.task.objective == Objective::WorstAmplitude)
    }

    /// Whether the answer is one that an engineer can take: reached, better than the case's own, and with
    /// all criteria holding.
    pub fn succeeds(&self) -> bool {
        self.improves() && self.best.is_feasible()
    }
}
