//! The simulation at the ends of its range: what is simulated there, measured, and compared with the
//! reference in multiple precision. A run that the simulation trusts must agree with the reference;
//! one that it does not trust must say so. The same of the other layers, against a table.

pub mod contact;
pub mod layers;
pub mod list;
pub mod measure;
pub mod units;

pub use contact::{ContactTable, contact_costs};
pub use layers::{CheckedLayer, LayerOutcome};
pub use list::{Entry, Start, Varied, entries};
pub use measure::{Comparison, MeasuredRun};
pub use units::{UnitCheck, unit_checks};

use serde::Serialize;
use serde_json::json;

use vinesink::case::CaseError;
use vinesink::quantity::Units;
use vinesink::report::render::RenderError;
use vinesink::report::template;
use vinesink::simulation::StartError;
use vinesink::simulation::trust::{ENERGY_RESIDUAL, RESOLUTION};
use vinesink::system::InvalidParameter;

/// How much further than rounding once an event a sound run may be from the reference: an event is
/// some dozen operations, each of which rounds, and so is the end of a period.
const ROUNDINGS: f64 = 32.0;

/// Why the page cannot be made: one of its lists is wrong.
#[derive(Debug, thiserror::Error)]
pub enum ExtremesError {
    /// A case is none.
    #[error(transparent)]
    Case(#[from] Box<CaseError>),
    /// A system is none.
    #[error(transparent)]
    System(#[from] InvalidParameter),
    /// The table of the layers cannot be read.
    #[error("the table of the layers: {0}")]
    Table(serde_json::Error),
    /// A start is impossible.
    #[error(transparent)]
    Start(#[from] StartError),
}

/// What became of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "is", content = "why", rename_all = "kebab-case")]
pub enum RunVerdict {
    /// It is trusted, and agrees with the reference as far as rounding lets anyone see.
    Holds,
    /// The simulation says itself that it is not to be trusted, and why.
    Flagged(Vec<String>),
    /// It was not begun.
    Refused(String),
    /// It is trusted and should not be.
    Wrong,
}

/// An entry of the list, measured.
#[derive(Debug, Clone, Serialize)]
pub struct MeasuredEntry {
    /// The entry.
    pub entry: Entry,
    /// What was measured; `None` where the run was refused.
    pub measured: Option<MeasuredRun>,
    /// What it means.
    pub verdict: RunVerdict,
}

impl Entry {
    /// Runs it.
    pub fn outcome(self) -> MeasuredEntry {
        let (measured, verdict) = match self.measure() {
            Ok(measured) => {
                let verdict = RunVerdict::of(&measured);
                (Some(measured), verdict)
            }
            Err(refusal) => (None, RunVerdict::Refused(refusal.to_string())),
        };
        MeasuredEntry { entry: self, measured, verdict }
    }
}

impl RunVerdict {
    fn of(measured: &MeasuredRun) -> Self {
        if !measured.doubts.is_empty() {
            return Self::Flagged(measured.doubts.iter().map(|doubt| doubt.words()).collect());
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
    fn agrees(&self, measured: &MeasuredRun) -> bool {
        let periods = measured.periods as f64 * self.part;
        let each = (periods / self.events.max(1) as f64).max(1.0);
        let allowed = ROUNDINGS * each * (self.one_rounding + self.clock);
        self.same_order && self.error <= allowed
    }
}

/// Whether nothing that is trusted is wrong.
pub fn holds(outcomes: &[MeasuredEntry], layers: &[LayerOutcome], units: &[UnitCheck]) -> bool {
    outcomes.iter().all(|outcome| outcome.verdict != RunVerdict::Wrong)
        && layers.iter().all(|outcome| outcome.verdict != RunVerdict::Wrong)
        && units.iter().all(|check| check.holds)
}

/// The page as Markdown.
///
/// # Errors
/// [`RenderError::Template`] if template and page do not fit.
pub fn page(
    outcomes: &[MeasuredEntry],
    layers: &[LayerOutcome],
    contact: &[ContactTable],
    units: &[UnitCheck],
) -> Result<String, RenderError> {
    let context = json!({
        "outcomes": outcomes,
        "layers": CheckedLayer::ALL.map(|layer| {
            let rows: Vec<_> = layers.iter().filter(|one| one.layer == layer).collect();
            json!({ "layer": layer, "rows": rows })
        }),
        "contact": contact,
        "units": units,
        "table_1": list::table_1(&[]),
        "limits": {
            "energy": ENERGY_RESIDUAL,
            "resolution": RESOLUTION,
            "impacts": list::IMPACT_LIMIT,
            "followed": measure::FOLLOWED,
            "roundings": ROUNDINGS,
            "layer_roundings": layers::ROUNDINGS,
            "residual": layers::RESIDUAL,
            "operations": layers::MOST_OPERATIONS,
        },
    });
    template::render("extremes.md", &Units::reduced(), &context)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_tells_every_kind_of_run() {
        let wanted = |entry: &Entry| {
            entry.periods <= 200
                && (entry.varied == [(Varied::Restitution, 0.6), (Varied::Clearance, 0.3)]
                    || entry.varied.contains(&(Varied::Forcing, 1e307))
                    || entry.varied.contains(&(Varied::Damping, 100.0))
                    || entry.start == Start::Outside)
        };
        let chosen = entries().expect("valid").into_iter().filter(wanted);
        let outcomes: Vec<MeasuredEntry> = chosen.map(Entry::outcome).collect();
        let contact = ContactTable { varied: vec![(Varied::Clearance, 0.3)], costs: Vec::new() };
        let rows = layers::rows().expect("a table");
        let layers: Vec<LayerOutcome> =
            rows.iter().take(3).map(|row| row.outcome().expect("valid")).collect();
        let text = page(&outcomes, &layers, &[contact], &[]).expect("a page");
        for part in [
            "| damping $\\lambda$ | $100$ | 200 | ",
            "| several at once | $\\gamma = 10^{307}$, $\\varepsilon = 0.9$ | 0 of 200 | – | – | – | 0",
            "- start, outside by $10^{-9}\\,b$: refused: the start has",
            "Table 1 with $b = 0.3\\,\\mathrm{mm}$:",
            "Above $10^{-9}\\,b$",
            "| theory | 3 | 3 | 0 | 0 | 0 |",
            "| Table 1 | 14 | ",
        ] {
            assert!(text.contains(part), "{part} in\n{text}");
        }
    }
}
