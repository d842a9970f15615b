//! What is asked of a structure of several modes: limits by place, how impacts count in them, and the bounds of better absorbers.

use std::ops::Range;

use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::Value;
use toml::Spanned;

use super::place::find_place;
use super::{Bounds, PlacedAbsorber, StructuralMode};
use crate::case::criteria::{Criterion, sensor_sees, with_placed_subjects};
use crate::case::optimize::Objective;
use crate::case::physical::MOST_CONTACT;
use crate::case::reader::{Reader, Table};
use crate::case::schema::in_design;
use crate::measure::Measure;
use crate::quantity::numbers::rounded_to;

/// What the structure must achieve.
#[derive(Deserialize, JsonSchema)]
#[schemars(extend("additionalProperties" = false), transform = with_placed_subjects)]
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

/// Within which bounds `vinesink optimize` looks. The table may be left out.
#[derive(Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct ModalOptimizeTable {
    /// What is looked for; what the first criterion asks unless given, or else that all criteria hold with the most room, and without
    /// criteria the smallest displacement of any place. `z3-share` is of one mode.
    #[schemars(example = "stable-share")]
    objective: Option<Objective>,
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
    if read.objective == Some(Objective::Z3Share) {
        let help =
            "ask for `objective = \"stable-share\"`, the same of the exact orbits of all modes";
        let expected = "expected an objective of the whole structure";
        let message = "`z3-share` is an area of the theory of one mode and one absorber";
        reader.report(table.span_of_value("objective"), message, expected, help);
    }
    let listed = table.value("places").and_then(|value| value.get_ref().as_array());
    let spans = listed.into_iter().flatten().map(Spanned::span);
    let of = |(name, span): (&String, Range<usize>)| find_place(reader, span, Some(name), places);
    let mut at: Vec<usize> = read.places.iter().zip(spans).filter_map(of).collect();
    at.sort_unstable();
    at.dedup();
    Bounds {
        objective: read.objective,
        clearance_m: read.clearance,
        restitution: read.restitution,
        places: at,
        split_mass: read.split_mass,
    }
}

/// Gives absorbers the time that an impact takes for a sensor which reads up to so many hertz, and reports times that say nothing.
pub(super) fn read_contact_times(
    reader: &mut Reader,
    root: &Table,
    upto: Option<(Range<usize>, f64)>,
    criteria: &[Criterion],
    modes: &[StructuralMode],
    absorbers: &mut [PlacedAbsorber],
) {
    let times = absorbers.iter().filter(|one| one.contact_time_s.is_some()).count();
    let asks = criteria.iter().any(|one| one.measure == Measure::PeakAcceleration);
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
