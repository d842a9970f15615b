//! What is swept: a structure of one mode with one absorber, or of several.

use std::ops::Range;
use std::path::Path;

use miette::{IntoDiagnostic, Result};
use vinesink::case::{Case, ModalCase};
use vinesink::case_input::AnyCase;
use vinesink::excitation::Scene;
use vinesink::program::parallel::Parallel;
use vinesink::report::sweep::{AxisShown, SweptCase};
use vinesink::sweep::columns::{self, Column};
use vinesink::sweep::limits::{StabilityLimit, stability_limits};
use vinesink::sweep::{Grid, ModalPlan, Plan, work};
use vinesink::system::Parameter;

use super::{Long, Work};

/// A case with what is worked out at every point.
pub enum Subject {
    One(Box<(Case, Plan)>),
    Several(Box<(ModalCase, ModalPlan)>),
}

impl Subject {
    /// None where the case does not say what to vary.
    pub fn of(case: AnyCase) -> Option<Self> {
        Some(match case {
            AnyCase::One(case) => {
                let plan = Plan::of(&case)?;
                Self::One(Box::new((*case, plan)))
            }
            AnyCase::Several(case) => {
                let plan = ModalPlan::of(&case)?;
                Self::Several(Box::new((*case, plan)))
            }
        })
    }

    pub fn grid(&self) -> &Grid {
        match self {
            Self::One(of) => &of.1,
            Self::Several(of) => &of.1.grid,
        }
    }

    /// The columns, empty.
    pub fn empty(&self) -> Vec<Column> {
        match self {
            Self::One(of) => columns::empty(&of.1),
            Self::Several(of) => of.1.empty(),
        }
    }

    /// Some points.
    pub fn points(&self, numbers: Range<u64>) -> Result<Vec<Column>> {
        match self {
            Self::One(of) => work::points(&of.1, numbers).into_diagnostic(),
            Self::Several(of) => Ok(of.1.points(numbers)),
        }
    }

    /// Seconds that a point takes at most, about, as far as that is known before; 0 for closed forms.
    pub fn roughly(&self) -> f64 {
        match self {
            Self::One(of) if flies(of) => Work::points(&of.1).seconds_of_each(),
            Self::One(_) => 0.0,
            Self::Several(of) => of.1.seconds(),
        }
    }

    /// Points at most that are worked out in a row to tell how long all take.
    pub fn sample(&self) -> u64 {
        match self {
            Self::One(_) => u64::MAX,
            // About a second.
            Self::Several(of) => ((1.0 / of.1.seconds()) as u64).max(1),
        }
    }

    /// Whether each point takes as long as is ordinary, or more is asked for.
    pub fn is_ordinary(&self, path: &Path, long: Long) -> Result<()> {
        match self {
            Self::One(of) if flies(of) => long.allows(path, &of.0, &[Work::points(&of.1)]),
            Self::One(_) => Ok(()),
            Self::Several(of) => long.allows_seconds(path, of.1.seconds(), "motions at a point"),
        }
    }

    /// The same of all points together, so many seconds, which was measured or is `what`.
    pub fn all_ordinary(&self, path: &Path, long: Long, seconds: f64, what: &str) -> Result<()> {
        let slips = match self {
            Self::One(of) => of.0.warnings(),
            Self::Several(of) => &of.0.warnings,
        };
        long.allows_sweep(path, slips, seconds, what)
    }

    pub fn shown(&self) -> SweptCase<'_> {
        match self {
            Self::One(of) => SweptCase::One(&of.0),
            Self::Several(of) => SweptCase::Several(&of.0),
        }
    }

    pub fn axes(&self) -> Vec<AxisShown> {
        let axes = self.grid().settings.axes.iter();
        match self {
            Self::One(of) => axes.map(|axis| AxisShown::of(&of.0, axis)).collect(),
            Self::Several(of) => axes.map(|axis| AxisShown::of_several(&of.0, axis)).collect(),
        }
    }

    /// Limits of the exact orbit, which a map over frequency and clearance shows.
    pub fn limits(&self) -> Vec<StabilityLimit> {
        let Self::One(of) = self else { return Vec::new() };
        let axes = &of.1.settings.axes;
        let along = |parameter| axes.iter().find(|axis| axis.parameter == parameter);
        match (axes.len(), along(Parameter::Frequency), along(Parameter::Clearance)) {
            (2, Some(frequency), Some(_)) => stability_limits(&of.0, &frequency.values, &Parallel),
            _ => Vec::new(),
        }
    }
}

/// Whether points are more than closed forms.
fn flies((case, plan): &(Case, Plan)) -> bool {
    plan.needs_simulation() || case.design.scene() != Scene::Steady
}
