//! What else could be done in place of the absorbers, as data.

use serde_json::{Map, Value, json};

use super::{closed, given, mass, numbers};
use crate::alternatives::Row;
use crate::case::{ModalCase, Of};
use crate::modal::{ModalAnswer, PlacedDampers, resting};
use crate::operating_range::Varies;
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;
use crate::report::document::{Devices, alternatives, designed};

/// The devices beside the absorbers, and who wins where; nothing where that was not asked for.
pub(super) fn rows(case: &ModalCase, answer: &ModalAnswer) -> (Value, Value) {
    let damper = |row: &Row<PlacedDampers>| damper(case, row);
    let kept_alone = Varies::kept_without_absorber(case);
    let of = Devices { physical: !case.reduced, kept_alone, damper: &damper };
    let found = answer.alternatives.as_ref().map(|found| alternatives(found, &of));
    let (rows, mut choice) = found.unwrap_or_default();
    if let Some(Of::Place(place)) = answer.alternatives.as_ref().map(|found| found.of) {
        choice["place"] = json!(case.places[place]);
    }
    if choice["inactive"] == true {
        (choice["resting"], choice["absorbers"]) =
            (json!(numbers(&resting(case, answer))), json!(case.absorbers.len()));
    }
    if case.modes.len() > 1 && choice.is_object() {
        choice["of_all_modes"] = json!(true);
    }
    (rows, choice)
}

/// Each damper of a row.
fn damper(case: &ModalCase, row: &Row<PlacedDampers>) -> Map<String, Value> {
    let each = row
        .damper
        .as_ref()
        .map(|dampers| each(case, dampers, row.changed, row.given_damping.is_some()));
    // What the search for all of them ended at.
    let bounds = row.damper.as_ref().map(|one| one.at_bound(row.given_damping.is_some()));
    let bounds = bounds.filter(|_| !row.changed).unwrap_or_default();
    let alike = bounds.first().filter(|first| bounds.iter().all(|one| one == *first));
    Map::from_iter([
        ("each".to_owned(), json!(each)),
        ("at_bound".to_owned(), json!(alike.copied().flatten())),
    ])
}

/// What dampers are; their frequencies may have changed, and their damping ratios may be given.
pub(super) fn each(
    case: &ModalCase,
    dampers: &PlacedDampers,
    is_changed: bool,
    is_given: bool,
) -> Vec<Value> {
    let bounds = dampers.at_bound(is_given).into_iter().map(|one| one.filter(|_| !is_changed));
    let designed = |quantity: Quantity| designed::<PlacedDampers>(quantity);
    let each = dampers.each.iter().zip(dampers.frequencies_hz(case));
    let each = each.zip(dampers.places.iter().zip(bounds));
    let told = each.map(|((one, frequency), (place, at_bound))| {
        let damping_ratio = match is_given {
            true => given(&of::DAMPER_DAMPING_RATIO, one.damping_ratio),
            false => designed(closed(&of::DAMPER_DAMPING_RATIO, one.damping_ratio)),
        };
        json!({
            "place": case.places[*place],
            "mass": mass(case, &of::ABSORBER_MASS, dampers.mass_kg),
            "frequency": designed(closed(&of::DAMPER_FREQUENCY, frequency)),
            "damping_ratio": damping_ratio,
            "at_bound": at_bound,
        })
    });
    told.collect()
}
