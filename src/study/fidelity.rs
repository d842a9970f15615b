//! Which layer answers which question: the cheapest whose error is known to be small enough.
//!
//! The closed form answers where an exact orbit that is stable and admissible measures its error; the
//! exact orbit answers where there is one; simulation answers where there is none, and wherever it is
//! asked which other motions coexist, which no single orbit knows. A layer may also be insisted on.

use std::collections::BTreeMap;

use serde::Serialize;

use super::StudyError;
use super::estimate::{self, Estimate, ORBIT_ROUNDING};
use crate::case::{AccuracySettings, Case};
use crate::excitation::Scene;
use crate::method::Method;
use crate::motions::{MotionKind, Motions};
use crate::operation_count;
use crate::regimes::Regime;
use crate::simulation::Doubt;
use crate::system::System;
use crate::validation::tolerance::{asymptotic_error, averages_error};

/// How exact the answers must be.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct AccuracyTarget {
    /// Largest relative error of the root mean square displacement.
    pub amplitude: f64,
    /// Largest error of the impacts per period.
    pub impacts_per_period: f64,
    /// Whether other long-term motions are looked for.
    pub coexistence: bool,
}

impl AccuracyTarget {
    /// What a layer is held to that is insisted on, where the case asks for nothing. Motions are measured as the case says,
    /// whatever a command asks for.
    fn of_layer(layer: Method) -> Self {
        let asked = AccuracySettings::default();
        match layer {
            Method::Simulation => Self {
                amplitude: f64::INFINITY,
                impacts_per_period: f64::INFINITY,
                coexistence: false,
            },
            _ => Self::of(&asked),
        }
    }

    /// What a case asks for.
    pub fn of(settings: &AccuracySettings) -> Self {
        Self {
            amplitude: settings.amplitude(),
            impacts_per_period: settings.impacts_per_period(),
            coexistence: settings.coexistence,
        }
    }
}

/// A question that a report answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Question {
    /// The root mean square displacement of the oscillator.
    Amplitude,
    /// Impacts per excitation period.
    ImpactsPerPeriod,
    /// The regime.
    Regime,
    /// Which other long-term motions there are.
    Coexistence,
}

/// How an error is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum KnownBy {
    /// The exact orbit beside it.
    ExactOrbit,
    /// Three times those and the randomness of captures, see [`averages_error`].
    Averages,
    /// Neglected terms, `eps (2 + abs(sigma) + lambda)`; no orbit was there to measure it.
    Asymptotics,
    /// Closure of the orbit: rounding.
    Closure,
    /// Scatter between blocks of a simulation: two standard errors.
    Scatter,
    /// Nothing: it is an outcome and has no size.
    Outcome,
}

/// An answer and what it stands on.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Answered {
    /// What was asked.
    pub question: Question,
    /// Which layer answers.
    pub layer: Method,
    /// A number: lengths over the clearance.
    pub value: Option<f64>,
    /// A regime.
    pub regime: Option<Regime>,
    /// How many other long-term motions were found, for [`Question::Coexistence`].
    pub others: Option<usize>,
    /// Its error, relative for the amplitude, absolute for the impacts.
    pub error: Option<f64>,
    /// How that is known.
    pub known_by: KnownBy,
    /// The largest error that was asked for.
    pub allowed: Option<f64>,
    /// Whether the error is known to be within it.
    pub enough: bool,
}

/// Which layer answers, decided without simulating.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerPlan {
    /// The system.
    pub system: System,
    /// What was asked for.
    pub demand: AccuracyTarget,
    /// The layer that was insisted on.
    pub forced: Option<Method>,
    /// The layer that answers amplitude, impacts and regime.
    pub layer: Method,
    /// What the closed form says, and what that cost in operations.
    pub closed_form: (Estimate, u64),
    /// The same for the symmetric orbit.
    pub orbit: (Estimate, u64),
    /// The same for the averaged flow where it was insisted on: it is never the cheapest that is exact enough.
    pub averaged_flow: Option<(Estimate, u64)>,
}

/// Everything that was asked, answered.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Answers {
    /// What was asked for.
    pub demand: AccuracyTarget,
    /// The layer that was insisted on, if one was.
    pub forced: Option<Method>,
    /// One for each question.
    pub answers: Vec<Answered>,
    /// Relative error of the closed form, where the exact orbit measures it.
    pub error_of_closed_form: Option<f64>,
    /// Operations of closed form, exact orbit and simulation, `None` for what was not done; of the averaged flow where
    /// it was insisted on.
    pub operations: BTreeMap<Method, Option<u64>>,
    /// Whether other motions were looked for.
    pub coexistence_looked_for: bool,
    /// Why the simulation that answers is not to be trusted; nothing of it is enough then.
    pub doubts: Vec<Doubt>,
}

impl Answers {
    /// Whether everything that was asked for is known well enough.
    pub fn enough(&self) -> bool {
        self.answers.iter().all(|answer| answer.enough)
    }
}

impl LayerPlan {
    /// The plan of a case that asks for accuracy, or where a layer is insisted on.
    ///
    /// # Errors
    /// As [`LayerPlan::of`].
    pub fn of_case(case: &Case, forced: Option<Method>) -> Result<Option<Self>, StudyError> {
        if case.design.scene() != Scene::Steady {
            return Ok(None);
        }
        let demand = case.accuracy.as_ref().map(AccuracyTarget::of);
        let demand = demand.or(forced.map(AccuracyTarget::of_layer));
        demand.map(|demand| Self::of(&case.system(), demand, forced)).transpose()
    }

    /// Decides from the closed form and the symmetric orbit.
    ///
    /// # Errors
    /// [`StudyError`] where the theory cannot be carried out, and where the layer that is insisted on
    /// has no answer.
    pub fn of(
        system: &System,
        demand: AccuracyTarget,
        forced: Option<Method>,
    ) -> Result<Self, StudyError> {
        let (closed_form, cost) = operation_count::counted(|| estimate::closed_form(system));
        let closed_form = (closed_form?, cost);
        let orbit = operation_count::counted(|| estimate::symmetric_orbit(system));
        let averaged_flow = (forced == Some(Method::AveragedFlow)).then(|| {
            let (answer, cost) = operation_count::counted(|| estimate::averaged_flow(system));
            answer.map(|answer| (answer, cost))
        });
        let averaged_flow = averaged_flow.transpose()?;
        let layer = Method::Simulation;
        let mut plan =
            Self { system: *system, demand, forced, layer, closed_form, orbit, averaged_flow };
        plan.layer = match forced {
            Some(layer) => layer,
            None if plan.error_of_closed_form().is_some_and(|e| e.abs() <= demand.amplitude) => {
                Method::Theory
            }
            None if plan.orbit.0.rms.is_some() => Method::ExactOrbit,
            None => Method::Simulation,
        };
        plan.check()?;
        Ok(plan)
    }

    fn check(&self) -> Result<(), StudyError> {
        let (answer, why, instead) = match self.layer {
            Method::Theory => (
                &self.closed_form.0,
                "no stable fixed point: the theory has no steady amplitude",
                "the exact orbit or simulation may have one",
            ),
            Method::AveragedFlow => {
                let why = match self.system.cavity().is_ideal() {
                    true => "the averaged flow has no stable amplitude with impacts",
                    false => "the averaged flow is that of an ideal cavity",
                };
                let (answer, _) = self.averaged_flow.as_ref().ok_or(StudyError::NoMotion)?;
                (answer, why, "simulation has one")
            }
            Method::ExactOrbit => {
                let why = "no symmetric orbit is stable and admissible";
                (&self.orbit.0, why, "simulation has one")
            }
            _ => return Ok(()),
        };
        match answer.rms {
            Some(_) => Ok(()),
            None => Err(StudyError::NoAnswer { layer: self.layer.words(), why, instead }),
        }
    }

    /// Relative error of the closed form's amplitude, measured by the exact orbit.
    pub fn error_of_closed_form(&self) -> Option<f64> {
        Some(self.closed_form.0.rms? / self.orbit.0.rms? - 1.0)
    }

    /// Whether long-term motions must be simulated: for the amplitude itself, or for what coexists,
    /// unless a cheaper layer was insisted on.
    pub fn needs_simulation(&self) -> bool {
        self.layer == Method::Simulation || (self.demand.coexistence && self.forced.is_none())
    }

    /// The answers; `simulated` are the long-term motions, where [`LayerPlan::needs_simulation`], and why the main one of them
    /// is not to be trusted.
    ///
    /// # Errors
    /// [`StudyError`] where there is no motion.
    pub fn answers(
        &self,
        simulated: Option<(&Motions, Vec<Doubt>)>,
    ) -> Result<Answers, StudyError> {
        let (motions, doubts) =
            simulated.map_or((None, Vec::new()), |(motions, doubts)| (Some(motions), doubts));
        let mut answers = match (self.layer, motions) {
            (Method::Simulation, Some(motions)) => self.by_simulation(motions)?,
            (Method::Simulation, None) => return Err(StudyError::NoMotion),
            (Method::AveragedFlow, _) => self.by_averaged_flow()?,
            (layer, _) => self.by_closed_form_or_orbit(layer),
        };
        if self.demand.coexistence {
            let others = motions.map(|found| found.len().saturating_sub(1));
            let layer = if others.is_some() { Method::Simulation } else { self.layer };
            answers.push(Answered {
                others,
                enough: others.is_some(),
                ..Answered::new(Question::Coexistence, layer, KnownBy::Outcome)
            });
        }
        let compared = self.layer != Method::Simulation;
        let doubts = if compared { Vec::new() } else { doubts };
        if !doubts.is_empty() {
            answers.iter_mut().for_each(|answer| answer.enough = false);
        }
        let mut operations = BTreeMap::from([
            (Method::Theory, compared.then_some(self.closed_form.1)),
            (Method::ExactOrbit, compared.then_some(self.orbit.1)),
            (Method::Simulation, motions.map(Motions::operations)),
        ]);
        let averaged_flow = self.averaged_flow.iter();
        operations.extend(averaged_flow.map(|(_, cost)| (Method::AveragedFlow, Some(*cost))));
        Ok(Answers {
            doubts,
            demand: self.demand,
            forced: self.forced,
            answers,
            error_of_closed_form: self.error_of_closed_form(),
            operations,
            coexistence_looked_for: motions.is_some(),
        })
    }

    fn by_closed_form_or_orbit(&self, layer: Method) -> Vec<Answered> {
        // Two impacts a period are what both mean by the motion; they are as certain as it is.
        let (answer, error, known_by) = match (layer, self.error_of_closed_form()) {
            (Method::Theory, Some(error)) => {
                (&self.closed_form.0, error.abs(), KnownBy::ExactOrbit)
            }
            (Method::Theory, None) => {
                (&self.closed_form.0, asymptotic_error(&self.system), KnownBy::Asymptotics)
            }
            _ => (&self.orbit.0, ORBIT_ROUNDING, KnownBy::Closure),
        };
        self.told(layer, known_by, answer, [error, 0.0])
    }

    fn by_averaged_flow(&self) -> Result<Vec<Answered>, StudyError> {
        let (answer, _) = self.averaged_flow.as_ref().ok_or(StudyError::NoMotion)?;
        let symmetric = answer.regime == Some(Regime::TwoSymmetric);
        let orbit = self.orbit.0.rms.filter(|_| symmetric);
        if let Some((rms, orbit)) = answer.rms.zip(orbit) {
            let errors = [(rms / orbit - 1.0).abs(), 0.0];
            return Ok(self.told(Method::AveragedFlow, KnownBy::ExactOrbit, answer, errors));
        }
        let error = averages_error(&self.system, answer.regime) + answer.scatter.unwrap_or(0.0);
        // How far averages of impacts are off nobody has estimated.
        Ok(self.told(Method::AveragedFlow, KnownBy::Averages, answer, [error, f64::INFINITY]))
    }

    fn by_simulation(&self, motions: &Motions) -> Result<Vec<Answered>, StudyError> {
        let main = motions.main().ok_or(StudyError::NoMotion)?;
        let known_by = match main.kind() {
            MotionKind::Wanders => KnownBy::Scatter,
            MotionKind::Orbit(_) | MotionKind::Rest(_) | MotionKind::Repeats(_) => KnownBy::Closure,
        };
        let answer = Estimate::of_motion(main);
        let errors = [answer.scatter, answer.impacts_scatter];
        let errors = errors.map(|scatter| scatter.unwrap_or(f64::INFINITY));
        Ok(self.told(Method::Simulation, known_by, &answer, errors))
    }

    /// Amplitude, impacts per period and regime as a layer answers them, with the errors of the first two.
    fn told(
        &self,
        layer: Method,
        known_by: KnownBy,
        answer: &Estimate,
        errors: [f64; 2],
    ) -> Vec<Answered> {
        let number = |question, value: Option<f64>, error: f64, allowed: f64| Answered {
            value,
            error: Some(error),
            allowed: Some(allowed),
            enough: value.is_some() && error <= allowed,
            ..Answered::new(question, layer, known_by)
        };
        let AccuracyTarget { amplitude, impacts_per_period, .. } = self.demand;
        let impacts = answer.impacts_per_period;
        let impacts = number(Question::ImpactsPerPeriod, impacts, errors[1], impacts_per_period);
        let certain = !matches!(known_by, KnownBy::Asymptotics | KnownBy::Averages);
        vec![
            number(Question::Amplitude, answer.rms, errors[0], amplitude),
            Answered { enough: certain && impacts.enough, ..impacts },
            Answered {
                regime: answer.regime,
                enough: certain && answer.regime.is_some(),
                ..Answered::new(Question::Regime, layer, known_by)
            },
        ]
    }
}

impl Answered {
    fn new(question: Question, layer: Method, known_by: KnownBy) -> Self {
        Self {
            question,
            layer,
            value: None,
            regime: None,
            others: None,
            error: None,
            known_by,
            allowed: None,
            enough: false,
        }
    }
}
