//! Puts the layers together for one case: what is analysed, simulated and confronted, and how far
//! the nearest boundaries are.

pub mod averages;
pub mod confirmations;
pub mod deviations;
pub mod diagrams;
pub mod estimate;
pub mod exact_branches;
pub mod fidelity;
pub mod margins;
pub mod plots;
pub mod scenes;
pub mod stretches;

use crate::analysis::{Analysis, AnalysisError};
use crate::band::{Band, Rivals, Survey};
use crate::case::Case;
use crate::executor::Executor;
use crate::flights::DrivenError;
use crate::motions::{DiagramError, Effort, Measured, Motion, Motions, at_rest, measured};
use crate::orbits::FullSystem;
use crate::simulation::StartError;
use crate::system::System;
use crate::validation::asymptotic_error::asymptotic_errors;
use crate::validation::{self, AsymptoticError, Claim};

pub use averages::Averages;
pub use confirmations::Confirmations;
pub use deviations::Deviations;
pub use margins::Margins;

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
    /// A study was read where nobody had asked for one.
    #[error("the case was not studied; ask for a study of it")]
    NotStudied,
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
    /// What becomes of a structure that is not driven steadily cannot be followed.
    #[error(transparent)]
    Driven(#[from] DrivenError),
    /// A structure is let go from 0.
    #[error("nothing sets the oscillator in motion; let it go from a displacement above 0")]
    AtRest,
    /// Something that is about steady vibration was asked of a structure that is not driven steadily.
    #[error("its structure is {0}, and an analysis is about one that is driven steadily")]
    NotSteady(&'static str),
}

/// Everything that is known about a case.
#[derive(Debug, Clone)]
pub struct CaseStudy {
    /// The theory.
    pub analysis: Analysis,
    /// Every long-term motion at the case's own excitation; none where nothing was simulated.
    pub motions: Motions,
    /// Each of them measured in full.
    pub measured: Vec<Measured>,
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
    pub effort: Effort,
    /// What is known along the case's band; none without one.
    pub band: Option<Survey>,
    /// The averaged flow; none where nobody asked for it.
    pub averages: Option<Averages>,
    /// Whether anything was simulated; if not, `motions` is empty.
    pub simulated: bool,
    /// The bare oscillator and a tuned mass damper at the case's own excitation.
    pub rivals: Rivals,
    /// The motion with an absorber that stays at rest, where it does from some resting places.
    pub rest: Option<Motion>,
    /// What deviations of a rig make of it; none where nobody asked for it.
    pub deviations: Option<Deviations>,
}

impl CaseStudy {
    /// Studies a system whose long-term motions were found with an effort.
    ///
    /// # Errors
    /// [`StudyError`] where theory or simulation cannot be carried out.
    pub fn of(system: &System, motions: &Motions, effort: Effort) -> Result<Self, StudyError> {
        let study = Self::without_simulation(system, effort)?;
        let each = motions.iter();
        let each = each.map(|one| measured(system, one, &effort, &mut Measured::log()));
        let measured: Vec<Measured> = each.collect::<Result<_, StartError>>()?;
        let (analysis, exact) = (&study.analysis, &study.exact);
        let window = effort.window(system);
        let further =
            validation::confront_simulation(analysis, exact, motions, &measured, &window)?;
        let confirmations = Confirmations::of(exact, &study.margins, motions)?;
        let mut claims = study.claims;
        claims.extend(further);
        Ok(Self {
            motions: motions.clone(),
            measured,
            claims,
            confirmations,
            effort: Effort { discard: Some(window.discard), ..effort },
            simulated: true,
            ..study
        })
    }

    /// The same from theory and exact orbits alone: motions, and whatever simulation would confirm,
    /// stay empty.
    ///
    /// # Errors
    /// [`StudyError`] where the theory cannot be carried out.
    pub fn without_simulation(system: &System, effort: Effort) -> Result<Self, StudyError> {
        let sketch = Self::sketch(system)?;
        let (analysis, exact) = (&sketch.analysis, &sketch.exact);
        Ok(Self {
            claims: validation::confront_theory(analysis, exact),
            asymptotic_errors: asymptotic_errors(analysis, exact),
            margins: Margins::of(analysis, exact),
            effort,
            rest: at_rest(system),
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
        let clearance = validation::clearances::clearances(&analysis);
        Ok(Self {
            motions: Motions::default(),
            measured: Vec::new(),
            claims: Vec::new(),
            asymptotic_errors: Vec::new(),
            margins: Margins { clearance, exact: None, best_clearance: None },
            confirmations: Confirmations::default(),
            effort: Effort::default(),
            band: None,
            averages: None,
            simulated: false,
            rivals: Rivals::of_displacement(&Band::point(system)),
            rest: None,
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
        let found = &self.motions;
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
    pub fn with_deviations(self, case: &Case, on: &dyn Executor) -> Result<Self, StudyError> {
        Ok(Self { deviations: Deviations::of(case, &self, on)?, ..self })
    }

    /// What was simulated, if anything was.
    pub fn simulated_motions(&self) -> Option<&Motions> {
        self.simulated.then_some(&self.motions)
    }

    /// Each motion with what was measured of it.
    pub fn each(&self) -> impl Iterator<Item = (&Motion, &Measured)> {
        self.motions.iter().zip(&self.measured)
    }

    /// The main motion: the moving one that most starts lead to, or rest if there is no other.
    pub fn main(&self) -> Option<(&Motion, &Measured)> {
        self.each().nth(self.motions.main_index()?)
    }
}
