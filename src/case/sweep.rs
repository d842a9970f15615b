//! The optional table `[sweep]`: which parameters `vinesink sweep` varies, how each point is worked out, and
//! what is recorded.

mod axis;
mod parameter;
mod recorded;

use std::ops::RangeInclusive;

use toml::de::DeValue;

use super::Design;
use super::list::List;
use super::reader::{Bound, Field, Reader};
use super::suggest::nearest;
use super::table::{Table, kind};

pub use axis::SweepAxis;
pub use parameter::SweepParameter;
pub use recorded::{Layer, Recorded};

/// What the case says about its sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepSettings {
    /// The axes in the order of the file, but for that which is followed: it is the last. The last
    /// varies fastest.
    pub axes: Vec<SweepAxis>,
    /// Starts at each point, that from rest among them; 1 where starts are an axis, or motions are
    /// followed.
    pub starts: u32,
    /// Excitation periods measured where a motion is not seen to repeat.
    pub periods: u64,
    /// Whether a motion is followed along the last axis, up and then down.
    pub follow: bool,
    /// What is recorded, each once.
    pub record: Vec<Recorded>,
}

pub(super) const TABLE: &str = "sweep";
pub(super) const KEYS: &[&str] = &{
    let mut keys = [""; SweepParameter::ALL.len() + SETTINGS.len()];
    let mut k = 0;
    while k < keys.len() {
        keys[k] = if k < SETTINGS.len() {
            SETTINGS[k]
        } else {
            SweepParameter::ALL[k - SETTINGS.len()].key()
        };
        k += 1;
    }
    keys
};
const SETTINGS: [&str; 4] = ["starts", "periods", "follow", "record"];
pub(super) use axis::KEYS as AXIS_KEYS;

const STARTS: RangeInclusive<u64> = 1..=1000;
const PERIODS: RangeInclusive<u64> = 48..=1_000_000;
/// Most points of a sweep.
const MOST_POINTS: f64 = 1e12;
const DEFAULT_STARTS: u32 = 4;
const DEFAULT_PERIODS: u64 = 250;
const RECORD: List =
    List { key: "record", bound: Bound::Any, example: "[\"regime\", \"peak\", \"orbit_peak\"]" };

/// Reads the table, which may be missing.
pub(super) fn read(
    reader: &mut Reader,
    root: &Table,
    design: Option<&Design>,
) -> Option<SweepSettings> {
    let table = reader.table(root, TABLE)?;
    let design = design?;
    let starts = table.whole_number(reader, Field::new("starts", "N", Bound::Any, "4"), STARTS);
    let periods =
        table.whole_number(reader, Field::new("periods", "n", Bound::Any, "250"), PERIODS);
    let record = read_record(reader, &table);
    let mut axes = Vec::new();
    for parameter in SweepParameter::ALL.into_iter().filter(|one| table.has(one.key())) {
        let at = table.span_of(parameter.key());
        let axis = reader.table(&table, parameter.key())?;
        axes.push((at.start, axis::read(reader, &axis, parameter, design)?));
    }
    axes.sort_by_key(|(at, _)| *at);
    let mut axes: Vec<SweepAxis> = axes.into_iter().map(|(_, axis)| axis).collect();
    if axes.is_empty() {
        reader.report(
            root.span_of(TABLE),
            "the sweep varies nothing",
            format!("expected at least one of {}", names(SweepParameter::ALL.map(|p| p.key()))),
            "write for example clearance = { from = \"5 mm\", to = \"40 mm\", count = 100 }",
        );
        return None;
    }
    let has = |parameter| axes.iter().any(|axis| axis.parameter == parameter);
    let twice = axes.iter().filter_map(|axis| Some((axis.parameter, axis.parameter.rival()?)));
    if let Some((one, other)) = twice.into_iter().find(|(_, other)| has(*other)) {
        reader.report(
            table.span_of(other.key()),
            format!("`{}` and `{}` say the same thing twice", one.key(), other.key()),
            "expected only one of the two axes",
            "remove one of the two",
        );
        return None;
    }
    let points: f64 = axes.iter().map(|axis: &SweepAxis| axis.values.len() as f64).product();
    if points > MOST_POINTS {
        reader.report(
            root.span_of(TABLE),
            format!("the sweep has {points:e} points"),
            "expected at most 1e12",
            "lower the count of an axis",
        );
        return None;
    }
    let follow = match table.has("follow") {
        true => Some(read_followed(reader, &table, &axes)?),
        false => None,
    };
    let alone = match axes.iter().find(|axis| axis.parameter.is_initial()) {
        Some(axis) => Some((axis.parameter.key(), "the start is an axis itself")),
        None => follow.map(|_| ("follow", "a motion is followed from point to point")),
    };
    if let (Some((_, why)), Some(_)) = (alone, starts) {
        let message = format!("`starts` has no meaning where {why}");
        let help = "remove the line `starts`";
        reader.report(table.span_of("starts"), message, "expected no `starts`", help);
        return None;
    }
    let mut record = record?;
    if let Some(index) = follow {
        let followed = axes.remove(index);
        axes.push(followed);
        let asked = table.has("record");
        if let Some(one) = record.iter().find(|one| asked && one.is_of_starts()) {
            let message = format!("`{}` has no meaning where a motion is followed", one.key());
            let help = "leave it out";
            reader.report(
                table.span_of_value("record"),
                message,
                "expected what one motion has",
                help,
            );
            return None;
        }
        record.retain(|one| !one.is_of_starts());
    }
    Some(SweepSettings {
        axes,
        starts: alone.map_or(starts.map_or(DEFAULT_STARTS, |starts| starts as u32), |_| 1),
        periods: periods.unwrap_or(DEFAULT_PERIODS),
        follow: follow.is_some(),
        record,
    })
}

/// Which axis is followed.
fn read_followed(reader: &mut Reader, table: &Table, axes: &[SweepAxis]) -> Option<usize> {
    let written = table.text(reader, "follow", "follow = \"frequency\"")?;
    let may_be = |axis: &&SweepAxis| !axis.parameter.is_initial();
    let found = axes.iter().position(|axis| axis.parameter.key() == written && may_be(&axis));
    if found.is_none() {
        let keys: Vec<&str> = axes.iter().filter(may_be).map(|axis| axis.parameter.key()).collect();
        let help = match keys.first() {
            Some(key) => format!("write for example follow = \"{key}\""),
            None => "remove the line; starts cannot be followed".to_owned(),
        };
        let message = format!("`follow` is \"{written}\", which is no axis that can be followed");
        let expected = match keys.is_empty() {
            true => "expected an axis other than the start's".to_owned(),
            false => format!("expected {}", names(keys)),
        };
        reader.report(table.span_of_value("follow"), message, expected, help);
    }
    found
}

/// What is recorded; the usual where the case does not say.
fn read_record(reader: &mut Reader, table: &Table) -> Option<Vec<Recorded>> {
    let Some((_, value)) = table.entry(RECORD.key) else { return Some(Recorded::USUAL.to_vec()) };
    let all = Recorded::ALL.map(Recorded::key);
    let items = match value.get_ref() {
        DeValue::Array(items) if !items.is_empty() => items,
        other => {
            let message = format!("`record` is {}", kind(other));
            let message = if other.is_array() { "`record` is empty".to_owned() } else { message };
            let expected = format!("expected a list of {}", names(all));
            reader.report(value.span(), message, expected, RECORD.help());
            return None;
        }
    };
    let mut found = Vec::new();
    for item in items {
        let text = item.get_ref().as_str().unwrap_or("");
        match Recorded::ALL.into_iter().find(|one| one.key() == text) {
            Some(one) if !found.contains(&one) => found.push(one),
            Some(_) => {}
            None => {
                let written = reader.as_written(item.span());
                let help = match nearest(text, &all) {
                    Some(near) => format!("did you mean \"{near}\"?"),
                    None => RECORD.help(),
                };
                let message = format!("`record` holds {written}");
                reader.report(item.span(), message, format!("expected {}", names(all)), help);
                return None;
            }
        }
    }
    Some(found)
}

/// Names in quotes, "or" before the last.
fn names(all: impl IntoIterator<Item = &'static str>) -> String {
    let quoted: Vec<String> = all.into_iter().map(|name| format!("\"{name}\"")).collect();
    match quoted.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} or {last}", rest.join(", ")),
        None => String::new(),
    }
}

/// Which parameters `vinesink sweep` varies, how each point is worked out, and what is recorded. The table may
/// be left out. Whatever is not an axis keeps the case's own number.
#[derive(schemars::JsonSchema)]
#[schemars(deny_unknown_fields)]
#[expect(dead_code, reason = "describes the table to editors; read() is what reads it")]
pub(super) struct SweepTable {
    /// Clearances.
    clearance: Option<axis::AxisTable>,
    /// Frequencies of the excitation, or frequency ratios beside [reduced].
    frequency: Option<axis::AxisTable>,
    /// Detunings sigma, beside [reduced].
    detuning: Option<axis::AxisTable>,
    /// Amplitudes of the excitation, as in [excitation]; the reduced forcing G beside [reduced].
    amplitude: Option<axis::AxisTable>,
    /// Restitutions.
    restitution: Option<axis::AxisTable>,
    /// Masses of the absorber, with a unit.
    absorber_mass: Option<axis::AxisTable>,
    /// Masses of the absorber over that of the oscillator.
    mass_ratio: Option<axis::AxisTable>,
    /// Masses of the oscillator, with a unit.
    mass: Option<axis::AxisTable>,
    /// Stiffnesses of the oscillator, with a unit.
    stiffness: Option<axis::AxisTable>,
    /// Viscous dampings of the oscillator, with a unit; lambda beside [reduced].
    damping: Option<axis::AxisTable>,
    /// Dampings of the oscillator over the critical one.
    damping_ratio: Option<axis::AxisTable>,
    /// Displacements of the oscillator at the start.
    initial_displacement: Option<axis::AxisTable>,
    /// Velocities of the oscillator at the start.
    initial_velocity: Option<axis::AxisTable>,
    /// Displacements of the absorber at the start; unless given it is half a clearance from the oscillator.
    initial_absorber_displacement: Option<axis::AxisTable>,
    /// Velocities of the absorber at the start.
    initial_absorber_velocity: Option<axis::AxisTable>,
    /// Starts at each point, that from rest among them; 4 unless given.
    #[schemars(range(min = 1, max = 1000), example = 4)]
    starts: Option<u64>,
    /// Excitation periods measured where a motion is not seen to repeat; 250 unless given.
    #[schemars(range(min = 48, max = 1_000_000), example = 250)]
    periods: Option<u64>,
    /// The axis along which a motion is followed from point to point, up and then down, which shows hysteresis,
    /// instead of being looked for at each point from several starts.
    #[schemars(example = &"frequency")]
    follow: Option<String>,
    /// What is recorded of each point; the layers that nothing is recorded of are not computed.
    record: Option<Vec<Recorded>>,
}
