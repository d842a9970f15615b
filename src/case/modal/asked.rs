//! What is asked of a structure of several modes: limits by place, how impacts count in them, and the bounds of better absorbers.

use std::ops::Range;

use schemars::{JsonSchema, Schema};
use serde::Deserialize;
use serde_json::{Value, json};
use toml::Spanned;
use toml::de::DeValue;

use super::place::find_place;
use super::{Bounds, PlaceCriterion, PlacedAbsorber, StructuralMode};
use crate::case::criteria::{Criterion, Subject, possible, sensor_sees};
use crate::case::number::{Form, sign_of};
use crate::case::physical::MOST_CONTACT;
use crate::case::reader::{Reader, Table};
use crate::case::schema::{add_key, in_design};
use crate::case::value::ValuePlace;
use crate::measure::Measure;
use crate::quantity::Dimension;
use crate::quantity::numbers::rounded_to;

/// What may be asked of a place.
const SUBJECTS: [(Subject, &str); 6] = [
    (Subject::PeakDisplacement, "Largest absolute displacement"),
    (Subject::RmsDisplacement, "Root mean square displacement"),
    (Subject::PeakVelocity, "Largest absolute velocity; of an impact that before and behind it"),
    (Subject::RmsVelocity, "Root mean square velocity"),
    (Subject::Acceleration, "Largest absolute acceleration between impacts"),
    (Subject::RmsAcceleration, "Root mean square acceleration between impacts"),
];

/// What the structure must achieve.
#[derive(Deserialize, JsonSchema)]
#[schemars(extend("additionalProperties" = false), transform = with_subjects)]
pub(super) struct ModalCriteriaTable {
    /// f_c, up to which a sensor reads `acceleration`, above 0: it then includes impacts, each of which an ideal low-pass filter
    /// shows with a peak of 2 f_c times the jump of the velocity, as `contact_time` = pi/(4 f_c) of every absorber does.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0), example = "1 kHz")]
    pub acceleration_upto: Option<f64>,
    /// Whether absorbers that rest where no wall reaches them count; true unless given. False for devices in which they cannot
    /// rest there.
    #[schemars(example = false)]
    pub count_inactive: Option<bool>,
}

/// An example of a limit.
fn example(subject: Subject) -> &'static str {
    match subject.dimension() {
        Some(Dimension::Velocity) => "<= 20 mm/s",
        Some(Dimension::Acceleration) => "<= 0.05 g",
        _ => "<= 4 mm",
    }
}

fn with_subjects(schema: &mut Schema) {
    for (subject, what) in SUBJECTS {
        let description = format!(
            "{what}: of the worst place as a text; of one place, or several, as a table or a list of tables with `limit` and `place`."
        );
        let property = json!({ "description": description, "examples": [example(subject)] });
        add_key(schema, subject.key(), property);
    }
}

/// Within which bounds `vinesink optimize` looks. The table may be left out.
#[derive(Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct ModalOptimizeTable {
    /// Bounds of each absorber's clearance; a third to three times its own unless given.
    #[schemars(with = "Option<[Value; 2]>", extend("x-ascending" = true))]
    #[schemars(extend("items" = in_design("clearance")))]
    #[schemars(example = vec!["1 mm", "8 mm"])]
    clearance: Option<[f64; 2]>,
    /// Bounds of the restitution of all absorbers, from 0 to 1; each its own unless given.
    #[schemars(extend("items" = { "type": "number", "minimum": 0, "maximum": 1 }, "x-ascending" = true))]
    #[schemars(example = vec![0.0, 0.7])]
    restitution: Option<[f64; 2]>,
    /// Places at which absorbers may be; each its own unless given.
    #[schemars(example = vec!["tip", "middle"])]
    #[serde(default)]
    places: Vec<String>,
    /// Whether the absorbers may share their mass otherwise, as much as it is together; false unless given.
    #[schemars(example = true)]
    #[serde(default)]
    split_mass: bool,
}

/// Between which bounds better absorbers are looked for.
pub(super) fn read_bounds(reader: &mut Reader, root: &Table, places: &[String]) -> Bounds {
    let Some((table, read)) = reader.optional::<ModalOptimizeTable>(root, "optimize") else {
        return Bounds::default();
    };
    let span = table.span_of_value("places");
    let of = |name: &String| find_place(reader, span.clone(), Some(name), places);
    let mut at: Vec<usize> = read.places.iter().filter_map(of).collect();
    at.sort_unstable();
    at.dedup();
    Bounds {
        clearance_m: read.clearance,
        restitution: read.restitution,
        places: at,
        split_mass: read.split_mass,
    }
}

/// Limits: a text, a table, or a list of tables.
pub(super) fn read_criteria(
    reader: &mut Reader,
    table: &Table,
    places: &[String],
) -> Vec<PlaceCriterion> {
    let each = SUBJECTS.into_iter();
    each.flat_map(|(subject, _)| read_limits(reader, table, subject, places)).collect()
}

/// Limits of one subject.
fn read_limits(
    reader: &mut Reader,
    table: &Table,
    subject: Subject,
    places: &[String],
) -> Vec<PlaceCriterion> {
    let key = subject.key();
    let example = if reader.plain { "<= 1.5" } else { example(subject) };
    let kind = subject.measure().of_place().zip(subject.dimension());
    let Some((value, (measure, dimension))) = table.value(key).zip(kind) else { return Vec::new() };
    let mut found = Vec::new();
    let each: Vec<&Spanned<DeValue>> = match value.get_ref() {
        DeValue::Array(all) => all.iter().collect(),
        _ => vec![value],
    };
    for one in each {
        let (limit, place) = match one.get_ref() {
            DeValue::Table(entries) => (entries.get("limit"), entries.get("place")),
            _ => (Some(one), None),
        };
        let place = match place {
            None => Some(None),
            Some(value) => {
                let name = value.get_ref().as_str().unwrap_or_default();
                find_place(reader, value.span(), Some(name), places).map(Some)
            }
        };
        let text = limit.and_then(|value| Some((value, value.get_ref().as_str()?)));
        let sign = text.and_then(|(_, text)| sign_of(text, &["<=", "≤"]));
        let (Some((value, _)), Some(sign)) = (text, sign) else {
            let help = format!(
                "write {key} = \"{example}\", or {{ limit = \"{example}\", place = \"{}\" }}",
                places.first().map_or("", String::as_str)
            );
            let message = format!("a limit of `{key}` is not written as one");
            let expected = "expected \"<=\", as it is the most that is allowed, and a value with its unit, in quotes";
            reader.report(one.span(), &message, expected, &help);
            continue;
        };
        let place_of = ValuePlace {
            table: "criteria",
            key,
            subject: format!("`{key}`"),
            line: format!("{key} = \"{example}\""),
            value,
            sign,
            alone: false,
        };
        let form = reader.written(Form::free(Some(dimension), example, ""));
        let as_written = reader.as_written(value.span());
        let limit = reader.number(&place_of, &form);
        let Some((limit, place)) = limit.zip(place) else { continue };
        if let Err(problem) = possible(limit, &as_written, dimension) {
            let help = format!("write for example {}", place_of.line);
            reader.refuse(&place_of, &problem, "expected a value above 0".to_owned(), help);
            continue;
        }
        let criterion = Criterion::at_most(subject.measure(), limit);
        let criterion = criterion.map(|one| Criterion { as_written, ..one });
        found.extend(criterion.map(|criterion| PlaceCriterion { place, measure, criterion }));
    }
    found
}

/// Gives absorbers the time that an impact takes for a sensor which reads up to so many hertz, and reports times that say nothing.
pub(super) fn read_contact_times(
    reader: &mut Reader,
    root: &Table,
    upto: Option<(Range<usize>, f64)>,
    criteria: &[PlaceCriterion],
    modes: &[StructuralMode],
    absorbers: &mut [PlacedAbsorber],
) {
    let times = absorbers.iter().filter(|one| one.contact_time_s.is_some()).count();
    let asks = criteria.iter().any(|one| one.criterion.measure == Measure::PeakAcceleration);
    let most = MOST_CONTACT / modes.iter().map(|mode| mode.frequency_hz).fold(0.0, f64::max);
    if let Some((span, upto)) = upto {
        let time = sensor_sees(reader, span, upto, [asks, times > 0], most);
        absorbers.iter_mut().for_each(|one| one.contact_time_s = time.or(one.contact_time_s));
        return;
    }
    let longest = absorbers.iter().filter_map(|one| one.contact_time_s).fold(0.0, f64::max);
    if times > 0 && times < absorbers.len() {
        reader.report(
            root.span_of("absorber"),
            "some absorbers have a `contact_time` and some have none",
            "expected it of all or of none",
            "write contact_time = \"0.5 ms\" in every [[absorber]]: impacts without it would be left out",
        );
    } else if longest > most {
        reader.report(
            root.span_of("absorber"),
            "an impact takes more than a fiftieth of the fastest mode's period",
            format!("expected a `contact_time` of at most {} s", rounded_to(most, 3)),
            "leave out modes that an impact is too slow to shake, or write a shorter time",
        );
    }
}
