//! The simulation at the ends of its range: what is simulated there, measured, and compared with the
//! reference in multiple precision. A run that the simulation trusts must agree with the reference;
//! one that it does not trust must say so.

pub mod contact;
pub mod list;
pub mod measure;
pub mod units;

pub use contact::{ContactCost, contact_costs};
pub use list::{Entry, Group, entries};
pub use measure::{Comparison, MeasureError, Measured, Run};
pub use units::{UnitCheck, UnitError, unit_checks};

use crate::simulation::Doubt;

/// How much further than rounding once an event a sound run may be from the reference: an event is
/// some dozen operations, each of which rounds, and so is the end of a period.
const ROUNDINGS: f64 = 32.0;

/// What became of a run.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// It is trusted, and agrees with the reference as far as rounding lets anyone see.
    Holds,
    /// The simulation says itself that it is not to be trusted.
    Flagged(Vec<Doubt>),
    /// It was not begun.
    Refused(String),
    /// It is trusted and should not be.
    Wrong,
}

/// An entry of the list, measured.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// The entry.
    pub entry: Entry,
    /// What was measured; `None` where the run was refused.
    pub measured: Option<Measured>,
    /// What it means.
    pub verdict: Verdict,
}

impl Entry {
    /// Runs it.
    ///
    /// # Errors
    /// [`MeasureError::Memory`]; an impossible start is a verdict.
    pub fn outcome(self) -> Result<Outcome, MeasureError> {
        match self.run.measure() {
            Ok(measured) => {
                let verdict = Verdict::of(&measured);
                Ok(Outcome { entry: self, measured: Some(measured), verdict })
            }
            Err(MeasureError::Start(refusal)) => {
                let verdict = Verdict::Refused(refusal.to_string());
                Ok(Outcome { entry: self, measured: None, verdict })
            }
            Err(error) => Err(error),
        }
    }
}

impl Verdict {
    fn of(measured: &Measured) -> Self {
        if !measured.doubts.is_empty() {
            return Self::Flagged(measured.doubts.clone());
        }
        match &measured.comparison {
            Some(comparison) if !comparison.agrees(measured) => Self::Wrong,
            _ => Self::Holds,
        }
    }
}

impl Comparison {
    /// Whether the run is as close to the reference as rounding lets it be: once an event, or once a
    /// period where periods are more.
    fn agrees(&self, measured: &Measured) -> bool {
        let periods = measured.periods as f64 * self.part;
        let each = (periods / self.events.max(1) as f64).max(1.0);
        let allowed = ROUNDINGS * each * (self.one_rounding + self.clock);
        self.same_order && self.error <= allowed
    }
}
