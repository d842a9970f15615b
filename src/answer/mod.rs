//! What every command knows of a case, put together in one place: the long-term motions, what is known along its range, its
//! study, or what becomes of a structure that is not driven steadily; and its criteria. `simulate`, `analyze`, `check`, `report`, `optimize`, the Python package
//! and the live page read it from here, so that no two of them can differ.
//!
//! For the program itself: this module may change at any time.

pub mod branch;
pub mod several;
pub mod trajectory;

use crate::alternatives::{Alternatives, Known};
use crate::analysis::Analysis;
use crate::band::Survey;
use crate::case::{Case, ExtraFigure};
use crate::criteria::{self, Judged};
use crate::excitation::{Release, Scene};
use crate::executor::Executor;
use crate::motions::{Effort, Measured, Motions, Place, measured, motions};
use crate::operating_range::{
    Combined, HoldsFor, Reliability, Together, Varied, combined, holds_for,
};
use crate::orbits::FullSystem;
use crate::simulation::ImpactLog;
use crate::study::fidelity::{Answers, LayerPlan};
use crate::study::{CaseStudy, StudyError};
use crate::system::System;
use crate::transient::Study;

/// What is asked of a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Asked {
    /// What can happen at its own excitation.
    Motions,
    /// The same, with theory and exact orbits beside it.
    Analysis,
    /// Whether its criteria hold.
    Criteria,
    /// The same, with all motions that can happen along its range.
    Decision,
    /// Everything at its own excitation alone, but for what only some cases ask for.
    Study,
    /// Everything.
    Report,
}

/// What is looked at beside a case, as it is not too long.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Decided {
    /// What else could be done.
    pub alternatives: bool,
    /// How far each of these numbers may change before a criterion fails.
    pub ranges: &'static [Varied],
    /// To where: all criteria hold, or none fails.
    pub until: Together,
    /// What holds where amplitude and natural frequency change at once.
    pub combined: bool,
    /// With which probability all criteria hold where numbers are uncertain.
    pub reliability: bool,
}

impl Decided {
    /// All of it.
    pub const ALL: Self = Self {
        alternatives: true,
        ranges: &Varied::ALL,
        until: Together::Undecided,
        combined: true,
        reliability: true,
    };
    /// What a document of `check` has.
    pub const CHECKED: Self = Self { combined: false, ..Self::ALL };
    /// None of it.
    pub const NOTHING: Self =
        Self { alternatives: false, ranges: &[], combined: false, reliability: false, ..Self::ALL };
}

/// Theory and exact orbits of a case.
#[derive(Debug, Clone)]
pub struct Theory {
    /// The theory.
    pub analysis: Analysis,
    /// The exact orbits, and their boundaries.
    pub exact: FullSystem,
}

/// What is known of a case.
#[derive(Debug, Clone)]
pub struct Answer {
    /// How thoroughly motions were searched.
    pub effort: Effort,
    /// The long-term motions at the case's own excitation; none where nothing was simulated.
    pub motions: Option<Motions>,
    /// What is known along the range that criteria are about; none where nothing asks for it.
    pub survey: Option<Survey>,
    /// The criteria; empty where the case has none, or where they were not asked for.
    pub judged: Vec<Judged>,
    /// Theory and exact orbits alone, where that was asked for.
    pub theory: Option<Theory>,
    /// Theory, orbits, and all motions measured in full; none where it was not asked for.
    pub study: Option<CaseStudy>,
    /// Which layer answers, where accuracy was asked for.
    pub answers: Option<Answers>,
    /// What becomes of a structure that is not driven steadily, and nothing above but its criteria; none of another.
    pub transient: Option<Study>,
    /// What else could be done; none where it was not asked for.
    pub alternatives: Option<Alternatives>,
    /// How far numbers of the case may change before a criterion fails; empty where one does, or nobody asked.
    pub holds_for: Vec<HoldsFor>,
    /// The same where amplitude and natural frequency change at once.
    pub combined: Vec<Combined>,
    /// With which probability its criteria hold; none where nothing is uncertain, or nobody asked.
    pub reliability: Option<Reliability>,
}

impl Theory {
    fn of(system: &System) -> Result<Self, StudyError> {
        Ok(Self { analysis: Analysis::of(system)?, exact: FullSystem::of(system) })
    }
}

impl Answer {
    /// What is known of a case, by the layers that `plan` needs, or all of them.
    ///
    /// # Errors
    /// [`StudyError`] where theory or simulation cannot be carried out.
    pub fn of(
        case: &Case,
        asked: Asked,
        plan: Option<&LayerPlan>,
        on: &dyn Executor,
    ) -> Result<Self, StudyError> {
        Self::with(case, asked, plan, case.effort(), on)
    }

    /// The same with another effort than the case asks for.
    ///
    /// # Errors
    /// As [`Answer::of`].
    pub fn with(
        case: &Case,
        asked: Asked,
        plan: Option<&LayerPlan>,
        effort: Effort,
        on: &dyn Executor,
    ) -> Result<Self, StudyError> {
        match case.design.scene() {
            Scene::Steady => Self::steady(case, asked, plan, effort, on),
            _ => Self::transient(case, asked, effort, on),
        }
    }

    /// The same with what decides whether the absorber is taken: its alternatives, and how far its criteria hold.
    ///
    /// # Errors
    /// As [`Answer::of`].
    pub fn decided(
        self,
        case: &Case,
        what: Decided,
        on: &dyn Executor,
    ) -> Result<Self, StudyError> {
        let (survey, study) = (self.survey.as_ref(), self.transient.as_ref());
        let known = Known { survey, study, effort: &self.effort };
        let alternatives = match what.alternatives {
            true => Alternatives::of(case, known, on)?,
            false => None,
        };
        let holds_for = holds_for(case, &self.judged, what.ranges, what.until, &self.effort, on)?;
        let combined = match what.combined {
            true => combined(case, &holds_for, &self.effort, on)?,
            false => Vec::new(),
        };
        let reliability = match what.reliability {
            true => Reliability::of(case, &self.effort, on)?,
            false => None,
        };
        Ok(Self { alternatives, holds_for, combined, reliability, ..self })
    }

    /// That of a case that is driven steadily; who calls this links nothing of what is not steady, as the live page.
    ///
    /// # Errors
    /// As [`Answer::of`].
    pub fn steady(
        case: &Case,
        asked: Asked,
        plan: Option<&LayerPlan>,
        effort: Effort,
        on: &dyn Executor,
    ) -> Result<Self, StudyError> {
        let system = case.system();
        let studies = matches!(asked, Asked::Study | Asked::Report);
        let judges = matches!(asked, Asked::Criteria | Asked::Decision | Asked::Report)
            && !case.criteria.is_empty();
        let layers = plan.is_none_or(LayerPlan::needs_simulation);
        let simulates = layers || judges && criteria::needs_simulation(&case.criteria);
        let found = match simulates {
            true => motions(&[Place::new(&system, effort.starts)], &effort, on)?.pop(),
            false => None,
        };
        let study = match &found {
            _ if !studies => None,
            _ if !layers => Some(CaseStudy::without_simulation(&system, effort)?),
            Some(found) => {
                let study = CaseStudy::of(&system, found, effort)?;
                Some(if asked == Asked::Report { further(study, case, on)? } else { study })
            }
            None => None,
        };
        let along = asked == Asked::Report && case.band.is_some();
        let compares = matches!(asked, Asked::Decision | Asked::Report);
        let survey = (judges || compares).then(|| {
            let mut settings = criteria::settings(case);
            let flown = compares && layers || settings.effort.is_some();
            settings.effort = flown.then_some(effort);
            Survey::of(&case.range(), &settings, found.as_ref(), on)
        });
        let survey = survey.transpose()?;
        let judged = survey.as_ref().filter(|_| judges).map(|survey| {
            criteria::contact::judge_in_contact(case, survey, effort, |band, settings| {
                Survey::of(band, settings, None, on)
            })
        });
        let judged = judged.transpose()?.unwrap_or_default();
        let study = study.map(|study| match survey.as_ref().filter(|_| along) {
            Some(survey) => study.along(survey.clone()),
            None => study,
        });
        let theory = (asked == Asked::Analysis).then(|| Theory::of(&system)).transpose()?;
        let motions = found;
        let mut answer = Self { motions, survey, judged, theory, study, ..Self::nothing(effort) };
        if let Some(plan) = plan {
            let found = answer.motions.as_ref().filter(|_| plan.needs_simulation());
            let doubts = match answer.main(case, &mut Measured::log())? {
                Some(main) if found.is_some() => main.doubts(),
                _ => Vec::new(),
            };
            answer.answers = Some(plan.answers(found.map(|found| (found, doubts)))?);
        }
        Ok(answer)
    }

    /// Of which nothing is known yet.
    const fn nothing(effort: Effort) -> Self {
        Self {
            effort,
            motions: None,
            survey: None,
            judged: Vec::new(),
            theory: None,
            study: None,
            answers: None,
            transient: None,
            alternatives: None,
            holds_for: Vec::new(),
            combined: Vec::new(),
            reliability: None,
        }
    }

    /// That of a case which is not driven steadily; an analysis is of theory alone.
    fn transient(
        case: &Case,
        asked: Asked,
        effort: Effort,
        on: &dyn Executor,
    ) -> Result<Self, StudyError> {
        if case.design.release().is_some_and(Release::is_rest) {
            return Err(StudyError::AtRest);
        }
        let found = match asked {
            Asked::Analysis => Study::by_theory(case),
            _ => Study::of_case(case, on).transpose()?,
        };
        let found = found.ok_or(StudyError::NotSteady(case.design.scene().words()))?;
        let judges = matches!(asked, Asked::Criteria | Asked::Decision | Asked::Report);
        let again =
            |case: &Case| Study::of_case(case, on).transpose()?.ok_or(StudyError::NotStudied);
        let judged = match judges {
            true => criteria::contact::judge_transient_in_contact(case, &found, again)?,
            false => Vec::new(),
        };
        Ok(Self { judged, transient: Some(found), ..Self::nothing(effort) })
    }

    /// The main motion measured in full, its impacts kept in `log`; none where nothing was simulated.
    ///
    /// # Errors
    /// [`StudyError`] where its state is not finite.
    pub fn main(&self, case: &Case, log: &mut ImpactLog) -> Result<Option<Measured>, StudyError> {
        let main = self.motions.as_ref().and_then(Motions::main);
        let measured = main.map(|main| measured(&case.system(), main, &self.effort, log));
        Ok(measured.transpose()?)
    }

    /// The study.
    ///
    /// # Errors
    /// [`StudyError::NotStudied`] where it was not asked for.
    pub fn studied(&self) -> Result<&CaseStudy, StudyError> {
        self.study.as_ref().ok_or(StudyError::NotStudied)
    }

    /// Whether every simulation in the study is to be trusted.
    pub fn trusted(&self) -> bool {
        let measured = self.study.iter().flat_map(|study| &study.measured);
        measured.into_iter().all(|one| one.doubts().is_empty())
    }

    /// Whether it is as exact as was asked for.
    pub fn exact_enough(&self) -> bool {
        self.answers.as_ref().is_none_or(Answers::enough)
    }
}

/// What only some cases ask for.
fn further(mut study: CaseStudy, case: &Case, on: &dyn Executor) -> Result<CaseStudy, StudyError> {
    if case.report.figures.contains(&ExtraFigure::Dissipation) {
        study = study.with_averages()?;
    }
    // With criteria it is said over the whole range how far they hold.
    if case.report.deviations && case.criteria.is_empty() {
        study = study.with_deviations(case, on)?;
    }
    Ok(study)
}
