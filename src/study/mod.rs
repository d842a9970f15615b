//! Puts the layers together for one case: what is analysed, simulated and confronted, and how far
//! the nearest boundaries are.

pub mod answer;
pub mod averages;
pub mod confirmations;
pub mod deviations;
pub mod diagrams;
pub mod exact_branches;
pub mod fidelity;
pub mod margins;
pub mod plots;
pub mod proofs;
pub mod scenes;
pub mod stretches;

use crate::analysis::motion::state_of;
use crate::analysis::{Analysis, AnalysisError};
use crate::band::{Band, Inactive, Rivals, Survey};
use crate::case::{Case, SimulationSettings};
use crate::operation_count;
use crate::orbits::FullSystem;
use crate::regimes::FoundAttractor;
use crate::regimes::diagram::DiagramError;
use crate::regimes::search;
use crate::simulation::StartError;
use crate::system::{State, System};
use crate::validation::asymptotic_error::asymptotic_errors;
use crate::validation::{self, AsymptoticError, Claim};

pub use crate::regimes::search::SearchEffort as StudyEffort;
pub use averages::Averages;
pub use confirmations::Confirmations;
pub use deviations::Deviations;
pub use margins::Margins;
pub use proofs::{LongTermMotions, Proof};

/// Why a case cannot be studied.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// The theory cannot be evaluated.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// A predicted motion cannot be simulated.
    #[error(transparent)]
    Start(#[from] StartError),
    /// No start led to a motion that could be measured.
    #[error(
        "no start led to a motion that could be measured; ask for more than 0 starts in [simulation]"
    )]
    NoMotion,
    /// The layer that was insisted on has no answer.
    #[error("the {layer} was asked for, but it has no answer here: {why}; {instead}")]
    NoAnswer {
        /// Which layer.
        layer: &'static str,
        /// Why it has none.
        why: &'static str,
        /// What would.
        instead: &'static str,
    },
    /// A parameter cannot be swept.
    #[error(transparent)]
    Diagram(#[from] DiagramError),
}

impl StudyEffort {
    /// The effort that a case asks for; the default where it leaves the choice.
    pub fn of(settings: &SimulationSettings) -> Self {
        let default = Self::default();
        let starts = settings.starts.and_then(|starts| u32::try_from(starts).ok());
        Self {
            starts: starts.unwrap_or(default.starts),
            discard: settings.discard.or(default.discard),
            periods: settings.periods.unwrap_or(default.periods),
        }
    }
}

/// Everything that is known about a case.
#[derive(Debug, Clone)]
pub struct CaseStudy {
    /// The theory.
    pub analysis: Analysis,
    /// Every long-term motion that was found, with its proof; none where nothing was simulated.
    pub motions: LongTermMotions,
    /// Theory against simulation.
    pub claims: Vec<Claim>,
    /// The exact layer: symmetric orbits and the boundaries around them.
    pub exact: FullSystem,
    /// The theory's boundaries beside the exact ones.
    pub asymptotic_errors: Vec<AsymptoticError>,
    /// Distances to the nearest boundaries.
    pub margins: Margins,
    /// What simulation says of them.
    pub confirmations: Confirmations,
    /// How thoroughly.
    pub effort: StudyEffort,
    /// What is known along the case's band; none without one.
    pub band: Option<Survey>,
    /// The averaged flow; none where nobody asked for it.
    pub averages: Option<Averages>,
    /// Whether anything was simulated; if not, `motions` is empty.
    pub simulated: bool,
    /// The bare oscillator and a tuned mass damper at the case's own excitation.
    pub rivals: Rivals,
    /// What an absorber that starts from rest leaves where it stays inactive.
    pub inactive: Option<Inactive>,
    /// What deviations of a rig make of it; none where nobody asked for it.
    pub deviations: Option<Deviations>,
}

impl CaseStudy {
    /// Studies a system; `progress` is told how much of [`CaseStudy::steps`] was done.
    ///
    /// # Errors
    /// [`StudyError`] where theory or simulation cannot be carried out.
    pub fn of(
        system: &System,
        effort: StudyEffort,
        progress: &mut dyn FnMut(u64),
    ) -> Result<Self, StudyError> {
        let study = Self::without_simulation(system, effort)?;
        let motions = long_term_motions(&study.analysis, &effort, progress)?;
        let (analysis, exact) = (&study.analysis, &study.exact);
        let window = effort.window(system);
        let (inactive, found) = (study.inactive.as_ref(), &motions.attractors);
        let further = validation::confront_simulation(analysis, exact, inactive, found, &window)?;
        let confirmations = Confirmations::of(exact, &study.margins)?;
        let mut claims = study.claims;
        claims.extend(further);
        Ok(Self {
            motions,
            claims,
            confirmations,
            effort: StudyEffort { discard: Some(window.discard), ..effort },
            simulated: true,
            ..study
        })
    }

    /// The same from theory and exact orbits alone: attractors, and whatever simulation would confirm,
    /// stay empty.
    ///
    /// # Errors
    /// [`StudyError`] where the theory cannot be carried out.
    pub fn without_simulation(system: &System, effort: StudyEffort) -> Result<Self, StudyError> {
        let sketch = Self::sketch(system)?;
        let (analysis, exact) = (&sketch.analysis, &sketch.exact);
        Ok(Self {
            claims: validation::confront_theory(analysis, exact),
            asymptotic_errors: asymptotic_errors(analysis, exact),
            margins: Margins::of(analysis, exact),
            effort,
            inactive: Inactive::of(system),
            ..sketch
        })
    }

    /// The theory and the exact orbits at the case itself alone, which take no longer than a frame of a moving
    /// picture: no claims, no exact limits.
    ///
    /// # Errors
    /// [`StudyError`] where the theory cannot be carried out.
    pub fn sketch(system: &System) -> Result<Self, StudyError> {
        let analysis = Analysis::of(system)?;
        let clearance = validation::boundaries::clearances(&analysis);
        Ok(Self {
            motions: LongTermMotions::default(),
            claims: Vec::new(),
            asymptotic_errors: Vec::new(),
            margins: Margins { clearance, exact: None, best_clearance: None },
            confirmations: Confirmations::default(),
            effort: StudyEffort::default(),
            band: None,
            averages: None,
            simulated: false,
            rivals: Rivals::along(&Band::point(system)),
            inactive: None,
            deviations: None,
            exact: FullSystem::of(system),
            analysis,
        })
    }

    /// The same with what is known along a band.
    #[must_use]
    pub fn along(self, survey: Survey) -> Self {
        Self { band: Some(survey), ..self }
    }

    /// The same with the averaged flow, and its claims about the motions that were simulated; none where the cavity is not
    /// ideal.
    ///
    /// # Errors
    /// [`StudyError`] where the theory cannot be carried out.
    pub fn with_averages(mut self) -> Result<Self, StudyError> {
        let system = &self.analysis.system;
        // The curve is that of an ideal cavity.
        if !system.cavity().is_ideal() {
            return Ok(self);
        }
        let averages = Averages::of(system)?.with_cycle(system);
        let found = &self.motions.attractors;
        if !averages.curve.depends_on_start {
            let Averages { states, cycle, range, .. } = &averages;
            let claims =
                validation::motions::averaged(system, states, cycle.as_ref(), *range, found);
            self.claims.extend(claims);
        }
        Ok(Self { averages: Some(averages), ..self })
    }

    /// The same with what would spoil it first.
    ///
    /// # Errors
    /// [`StudyError`] where a motion cannot be simulated.
    pub fn with_deviations(self, case: &Case) -> Result<Self, StudyError> {
        Ok(Self { deviations: Deviations::of(case, &self)?, ..self })
    }

    /// What was simulated, if anything was.
    pub fn simulated_motions(&self) -> Option<&LongTermMotions> {
        self.simulated.then_some(&self.motions)
    }

    /// Number of progress steps that a study takes, about.
    pub fn steps(effort: &StudyEffort) -> u64 {
        u64::from(effort.starts) + 2
    }

    /// The moving attractor that most starts lead to, or rest if there is no other.
    pub fn main_attractor(&self) -> Option<&FoundAttractor> {
        self.motions.main().map(|(main, _)| main)
    }
}

/// Every long-term motion that evenly spread starts and the theory's predictions lead to.
///
/// # Errors
/// [`StartError`] if a predicted motion cannot be simulated.
pub fn long_term_motions(
    analysis: &Analysis,
    effort: &StudyEffort,
    progress: &mut dyn FnMut(u64),
) -> Result<LongTermMotions, StartError> {
    let system = &analysis.system;
    let find = || search::find(system, &predicted_starts(analysis), effort, progress);
    let (found, operations) = operation_count::counted(find);
    Ok(LongTermMotions { operations, ..LongTermMotions::proven(system, found?, effort.starts) })
}

/// Starts on every motion that theory predicts, rest included.
fn predicted_starts(analysis: &Analysis) -> Vec<State> {
    let system = &analysis.system;
    let rest = system.linear_response().map(|linear| linear.state(system));
    let rest = rest.filter(|state| state.relative_displacement().abs() < 1.0);
    analysis.fixed_points.iter().map(|point| state_of(point, system)).chain(rest).collect()
}
