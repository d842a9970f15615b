//! The optional table `[uncertainty]`: by how much a built design may differ from its case.

use super::quantity::{Force, Frequency, Length};
use super::reader::{Bound, Field, Reader};
use super::table::Table;
use super::{Design, PhysicalExcitation};

/// Standard deviations of normally distributed errors; 0 where nothing is uncertain.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Uncertainty {
    /// Of the clearance, in metres or the case's own unit.
    pub clearance: f64,
    /// Of the restitution.
    pub restitution: f64,
    /// Of the excitation's frequency, as a frequency ratio.
    pub frequency_ratio: f64,
    /// Of the excitation's amplitude, over the case's own.
    pub amplitude: f64,
}

impl Uncertainty {
    /// Whether anything is uncertain.
    pub fn is_any(&self) -> bool {
        *self != Self::default()
    }
}

pub(super) const TABLE: &str = "uncertainty";
pub(super) const KEYS: &[&str] = &["clearance", "restitution", "frequency", "amplitude"];

const CLEARANCE: &str = "clearance";
const AMPLITUDE: &str = "amplitude";

fn field(key: &'static str, symbol: &'static str, example: &'static str) -> Field {
    Field::new(key, symbol, Bound::NotNegative, example)
}

/// Reads the table, which may be missing.
pub(super) fn read(reader: &mut Reader, root: &Table, design: Option<&Design>) -> Uncertainty {
    let table = reader.table(root, TABLE);
    let (Some(table), Some(design)) = (table, design) else { return Uncertainty::default() };
    let scales = design.scales();
    let mut given = |key: &'static str, read: &dyn Fn(&mut Reader) -> Option<f64>| {
        if table.has(key) { read(reader).unwrap_or(0.0) } else { 0.0 }
    };
    let restitution =
        given("restitution", &|reader| table.number(reader, field("restitution", "s_r", "0.05")));
    let (clearance, frequency_ratio, amplitude) = match design {
        Design::Physical(physical) => (
            given(CLEARANCE, &|reader| {
                table.quantity::<Length>(reader, field(CLEARANCE, "s_b", "\"0.2 mm\""))
            }),
            given("frequency", &|reader| {
                let hertz = table
                    .quantity::<Frequency>(reader, field("frequency", "s_f", "\"0.05 Hz\""))?;
                scales.frequency_ratio(hertz)
            }),
            match physical.excitation {
                PhysicalExcitation::BaseDisplacement { amplitude_m } => {
                    given(AMPLITUDE, &|reader| {
                        let field = field(AMPLITUDE, "s_F", "\"0.02 mm\"");
                        Some(table.quantity::<Length>(reader, field)? / amplitude_m)
                    })
                }
                PhysicalExcitation::Force { amplitude_n } => given(AMPLITUDE, &|reader| {
                    let field = field(AMPLITUDE, "s_P", "\"0.2 N\"");
                    Some(table.quantity::<Force>(reader, field)? / amplitude_n)
                }),
            },
        ),
        Design::Reduced(reduced) => (
            given(CLEARANCE, &|reader| table.number(reader, field(CLEARANCE, "s_b", "0.02"))),
            given("frequency", &|reader| {
                table.number(reader, field("frequency", r"s_\Omega", "0.005"))
            }),
            given(AMPLITUDE, &|reader| {
                Some(table.number(reader, field(AMPLITUDE, "s_G", "0.1"))? / reduced.forcing)
            }),
        ),
    };
    if !amplitude.is_finite() {
        reader.report(
            table.span_of_value(AMPLITUDE),
            "the amplitude is uncertain in a case that is not driven",
            "expected an excitation with an amplitude above 0",
            "give the case's own excitation an amplitude, or remove the line",
        );
        return Uncertainty::default();
    }
    Uncertainty { clearance, restitution, frequency_ratio, amplitude }
}

/// By how much a built design may differ from its case, as standard deviations of normally distributed
/// errors. Each key may be left out.
#[derive(schemars::JsonSchema)]
#[schemars(deny_unknown_fields)]
#[expect(dead_code, reason = "describes the table to editors; read() is what reads it")]
pub(super) struct UncertaintyTable {
    /// Of the clearance: a length, or a plain number beside [reduced].
    #[schemars(example = "0.2 mm")]
    clearance: Option<serde_json::Value>,
    /// Of the restitution.
    #[schemars(range(min = 0.0), example = 0.05)]
    restitution: Option<f64>,
    /// Of the excitation's frequency, that of a whole band included: a frequency, or a frequency ratio
    /// beside [reduced].
    #[schemars(example = "0.05 Hz")]
    frequency: Option<serde_json::Value>,
    /// Of the excitation's amplitude, as in [excitation]; that of a whole band in proportion.
    #[schemars(example = "0.02 mm")]
    amplitude: Option<serde_json::Value>,
}
