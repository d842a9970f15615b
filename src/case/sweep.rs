//! The optional table `[sweep]`: which parameters `vinesink sweep` varies, how each point is worked out, and
//! what is recorded.

mod axis;
mod recorded;

use schemars::{JsonSchema, Schema};
use serde::Deserialize;

use super::reader::{Reader, Table};
use super::record::Recording;
use super::schema::{add_names, in_design, schema_of};
use super::value::or;
use crate::excitation::Scene;
use crate::system::Parameter;

pub use axis::SweepAxis;
pub use recorded::Recorded;

/// What the case says about its sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepSettings {
    /// The axes in the order of the file, but for that which is followed: it is the last. The last
    /// varies fastest.
    pub axes: Vec<SweepAxis>,
    /// Starts at each point, that from rest among them, or places of the absorber; 1 where starts are an axis, or motions are
    /// followed.
    pub starts: u32,
    /// Excitation periods measured where a motion is not seen to repeat.
    pub periods: u64,
    /// Whether a motion is followed along the last axis, up and then down.
    pub follow: bool,
    /// What is recorded, each once.
    pub record: Vec<Recorded>,
}

impl SweepSettings {
    /// Number of points: every combination of the axes' values.
    pub fn points(&self) -> u64 {
        self.axes.iter().map(|axis| axis.values.len() as u64).product()
    }
}

/// Which parameters `vinesink sweep` varies, how each point is worked out, and what is recorded. The table may
/// be left out. Whatever is not an axis keeps the case's own number.
#[derive(Deserialize, JsonSchema)]
#[schemars(extend("additionalProperties" = false), transform = with_axes)]
pub(super) struct SweepTable {
    /// Starts at each point, that from rest among them; 4 unless given. Places of the absorber where the structure is
    /// not driven steadily; as many as for the case itself unless given.
    #[schemars(range(min = 1, max = 1000), extend("x-symbol" = "N"), example = 4)]
    starts: Option<u32>,
    /// Excitation periods measured where a motion is not seen to repeat; 250 unless given.
    #[schemars(range(min = 48, max = 1_000_000), extend("x-symbol" = "n"), example = 250)]
    periods: Option<u64>,
    /// The axis along which a motion is followed from point to point, up and then down, which shows hysteresis,
    /// instead of being looked for at each point from several starts.
    #[schemars(example = &"frequency")]
    follow: Option<String>,
    /// What is recorded of each point; the layers that nothing is recorded of are not computed.
    #[schemars(length(min = 1), example = vec!["regime", "peak", "orbit_peak"])]
    record: Option<Vec<Recorded>>,
}

fn with_axes(schema: &mut Schema) {
    with_axes_of(schema, &Parameter::ALL);
}

/// An axis for each of these parameters, with values as the parameter has them.
pub(super) fn with_axes_of(schema: &mut Schema, parameters: &[Parameter]) {
    let mut axis = schema_of::<axis::AxisTable>();
    for word in ["$schema", "title"] {
        axis.as_object_mut().and_then(|axis| axis.remove(word));
    }
    add_names::<Parameter>(schema, |key| {
        parameters.iter().find(|one| one.key() == key)?;
        let mut axis = axis.clone();
        for end in ["from", "to"] {
            axis["properties"][end]["x-parameter"] = key.into();
        }
        axis["properties"]["values"]["items"] = in_design(key);
        Some(axis)
    });
}

/// Most points of a sweep.
const MOST_POINTS: f64 = 1e12;
const DEFAULT_STARTS: u32 = 4;
const DEFAULT_PERIODS: u64 = 250;
/// Pairs of parameters that say the same of a design.
const RIVALS: [(Parameter, Parameter); 3] = [
    (Parameter::AbsorberMass, Parameter::MassRatio),
    (Parameter::Damping, Parameter::DampingRatio),
    (Parameter::Frequency, Parameter::Detuning),
];

/// Reads the table, which may be missing.
pub(super) fn read(
    reader: &mut Reader,
    root: &Table,
    of_case: Option<u64>,
) -> Option<SweepSettings> {
    let (table, read) = reader.optional::<SweepTable>(root, "sweep")?;
    let mut axes = axes_among(reader, &table, &Parameter::ALL)?;
    let scene = reader.design?.scene();
    check_scene(reader, &table, read.record.as_deref().unwrap_or_default(), scene)?;
    let follow = match &read.follow {
        Some(followed) => Some(find_followed(reader, &table, &axes, followed)?),
        None => None,
    };
    let is_start = |axis: &SweepAxis| scene == Scene::Steady && axis.parameter.is_initial();
    let alone = match axes.iter().any(is_start) {
        true => Some("the start is an axis itself"),
        false => follow.map(|_| "a motion is followed from point to point"),
    };
    if let (Some(why), Some(_)) = (alone, read.starts) {
        let message = format!("`starts` has no meaning where {why}");
        let help = "remove the line `starts`";
        reader.report(table.span_of("starts"), message, "expected no `starts`", help);
        return None;
    }
    let mut record: Vec<Recorded> = Vec::new();
    for one in read.record.clone().unwrap_or_else(|| Recorded::usual(scene)) {
        if !record.contains(&one) {
            record.push(one);
        }
    }
    if let Some(index) = follow {
        let followed = axes.remove(index);
        axes.push(followed);
        let of_starts = record.iter().find(|one| one.is_of_starts());
        if let (Some(one), Some(_)) = (of_starts, &read.record) {
            let message = format!("`{}` has no meaning where a motion is followed", one.key());
            let at = table.span_of_value("record");
            reader.report(at, message, "expected what one motion has", "leave it out");
            return None;
        }
        record.retain(|one| !one.is_of_starts());
    }
    let of_case = of_case.and_then(|starts| u32::try_from(starts).ok());
    let usual = match reader.design?.transient() {
        Some(transient) => {
            let records = reader.recording.as_ref().map_or(1, Recording::count);
            of_case.unwrap_or(transient.places(records))
        }
        None => DEFAULT_STARTS,
    };
    let starts = if alone.is_some() { 1 } else { read.starts.unwrap_or(usual) };
    let periods = read.periods.unwrap_or(DEFAULT_PERIODS);
    Some(SweepSettings { axes, starts, periods, follow: follow.is_some(), record })
}

/// The axes in the order of the file, where these parameters may be axes.
pub(super) fn axes_among(
    reader: &mut Reader,
    table: &Table,
    parameters: &[Parameter],
) -> Option<Vec<SweepAxis>> {
    let mut axes = Vec::new();
    for parameter in parameters.iter().copied().filter(|one| table.has(one.key())) {
        let at = table.span_of(parameter.key()).start;
        axes.push((at, axis::read(reader, table, parameter)?));
    }
    axes.sort_by_key(|(at, _)| *at);
    let axes: Vec<SweepAxis> = axes.into_iter().map(|(_, axis)| axis).collect();
    check_axes(reader, table, &axes, parameters)?;
    Some(axes)
}

/// Reports axes that are too few, too many, or say the same thing twice.
fn check_axes(
    reader: &mut Reader,
    table: &Table,
    axes: &[SweepAxis],
    parameters: &[Parameter],
) -> Option<()> {
    if axes.is_empty() {
        let names = parameters.iter().map(|parameter| format!("\"{}\"", parameter.key()));
        let names = or(&names.collect::<Vec<_>>());
        reader.report(
            table.span_of(""),
            "the sweep varies nothing",
            format!("expected at least one of {names}"),
            "write for example clearance = { from = \"5 mm\", to = \"40 mm\", count = 100 }",
        );
        return None;
    }
    let has = |parameter| axes.iter().any(|axis| axis.parameter == parameter);
    if let Some((one, other)) = RIVALS.into_iter().find(|(one, other)| has(*one) && has(*other)) {
        let message = format!("`{}` and `{}` say the same thing twice", one.key(), other.key());
        let at = table.span_of(other.key());
        reader.report(at, message, "expected only one of the two axes", "remove one of the two");
        return None;
    }
    let points: f64 = axes.iter().map(|axis| axis.values.len() as f64).product();
    if points > MOST_POINTS {
        let message = format!("the sweep has {points:e} points");
        let help = "lower the count of an axis";
        reader.report(table.span_of(""), message, "expected at most 1e12", help);
        return None;
    }
    Some(())
}

/// Reports what is about steady vibration where the structure is not driven steadily, and the other way round.
fn check_scene(reader: &mut Reader, table: &Table, asked: &[Recorded], scene: Scene) -> Option<()> {
    let of = Recorded::ALL.into_iter().filter(|one| one.is_of(scene));
    let of: Vec<String> = of.map(|one| format!("\"{}\"", one.key())).collect();
    let unsuited = asked.iter().find(|one| !one.is_of(scene)).map(|one| ("record", one.key()));
    let settings = ["periods", "follow"].into_iter();
    let mut settings = settings.filter(|key| scene != Scene::Steady && table.has(key));
    let Some((place, key)) = unsuited.or_else(|| settings.next().map(|key| (key, key))) else {
        return Some(());
    };
    let message = format!("`{key}` has no meaning for a structure that is {}", scene.words());
    let expected = format!("expected a record of {}", or(&of));
    reader.report(table.span_of_value(place), message, expected, "leave it out");
    None
}

/// Which axis is followed.
fn find_followed(
    reader: &mut Reader,
    table: &Table,
    axes: &[SweepAxis],
    written: &str,
) -> Option<usize> {
    let may_be = |axis: &&SweepAxis| !axis.parameter.is_initial();
    let found = axes.iter().position(|axis| axis.parameter.key() == written && may_be(&axis));
    if found.is_none() {
        let keys = axes.iter().filter(may_be).map(|axis| format!("\"{}\"", axis.parameter.key()));
        let keys: Vec<String> = keys.collect();
        let (expected, help) = match keys.first() {
            Some(key) => (or(&keys), format!("write for example follow = {key}")),
            None => (
                "an axis other than the start's".to_owned(),
                "remove the line; starts cannot be followed".to_owned(),
            ),
        };
        let message = format!("`follow` is \"{written}\", which is no axis that can be followed");
        let at = table.span_of_value("follow");
        reader.report(at, message, format!("expected {expected}"), help);
    }
    found
}
