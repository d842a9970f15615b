//! The tables of a structure of one mode that several absorbers or loads may stand beside: `[oscillator]`, which is a mode at one place,
//! and `[band]`, which is the range of the only load.

use std::ops::Range;

use schemars::JsonSchema;
use serde::Deserialize;

use super::{Load, StructuralMode};
use crate::case::physical::OscillatorTable;
use crate::case::reader::{Reader, Table};
use crate::system::LARGEST_DAMPING_RATIO;

/// The range of frequencies of the one excitation, in place of its own. The table may be left out.
#[derive(Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct BandOfSeveral {
    /// Where it begins, above 0.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0), example = "8 Hz")]
    from: f64,
    /// Where it ends, above `from`.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0), example = "9 Hz")]
    to: f64,
}

/// What the one place of `[oscillator]` is called.
pub(super) const THE_PLACE: &str = "structure";

/// Refuses `[oscillator]` beside modes.
pub(super) fn refuse_both(reader: &mut Reader, root: &Table) {
    let own = ["mode", "modes", "reduced"].into_iter().find(|name| root.has(name));
    let (Some(own), Some(_)) = (own, root.value("oscillator")) else { return };
    let own = if own == "mode" { "[[mode]]".to_owned() } else { format!("[{own}]") };
    let message =
        format!("[oscillator] has no meaning beside {own}: both say what the structure is");
    let help = format!("remove [oscillator], or {own} where the structure has one mode");
    reader.report(root.span_of("oscillator"), message, "expected one of the two", help);
}

/// The structure of `[oscillator]`, a mode at one place that moves with its base, and where it says its damping.
pub(super) fn read_oscillator(
    reader: &mut Reader,
    root: &Table,
) -> Option<(Range<usize>, StructuralMode)> {
    let (table, read) = reader.optional::<OscillatorTable>(root, "oscillator")?;
    let [frequency_hz, damping_ratio, mass_kg] = read.mode(reader, &table)?;
    let key = if table.has("damping") { "damping" } else { "damping_ratio" };
    let span = table.span_of_value(key);
    if damping_ratio > LARGEST_DAMPING_RATIO {
        let message = "the structure is damped too heavily for several absorbers or loads";
        let expected = format!("expected a damping ratio of at most {LARGEST_DAMPING_RATIO}");
        let help =
            "check its unit; one absorber and one load may be on a structure that does not ring";
        reader.report(span, message, expected, help);
        return None;
    }
    let mode = StructuralMode {
        frequency_hz,
        damping_ratio,
        mass_kg,
        shape: vec![1.0],
        participation: 1.0,
        forcing: 0.0,
    };
    Some((span, mode))
}

/// The range of `[band]`, in place of the frequency of the one load; none where something was reported.
pub(super) fn band_of(
    reader: &mut Reader,
    table: &Table,
    band: &BandOfSeveral,
    loads: &[Load],
) -> Option<[f64; 2]> {
    let span = table.span.clone();
    match loads {
        [load] if load.range_hz[0] < load.range_hz[1] => {
            let message = "[band] and the excitation both say a range of frequencies";
            let help = "remove [band], or write `frequency` in place of `from` and `to`";
            reader.report(span, message, "expected one of the two", help);
            None
        }
        [_, _, ..] => {
            let message = "[band] is of one excitation, and there are several";
            let help = "write `from` and `to` in each [[excitation]] that has a range";
            reader.report(span, message, "expected one excitation", help);
            None
        }
        _ if band.from >= band.to => {
            let message = "the band ends where it begins, or before";
            let help = "swap `from` and `to`, or write a larger `to`";
            reader.report(table.span_of_value("to"), message, "expected `to` above `from`", help);
            None
        }
        _ => Some([band.from, band.to]),
    }
}
