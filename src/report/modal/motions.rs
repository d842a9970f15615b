//! The motions of a structure of several modes, as lists of every structure have them, with what each place and absorber does.

use serde_json::{Value, json};

use super::frequency_unit;
use crate::case::ModalCase;
use crate::modal::AlongLoad;
use crate::motions::{ModalMotion, Motions, RestKind, SensorExtent};
use crate::report::document::motions::{Listed, pair};
use crate::simulation::Reading;

/// The largest displacement of any place in a motion, with its error.
pub(super) fn peak(motion: &ModalMotion) -> [f64; 2] {
    let each = motion.read(Reading::Displacement).map(|one| [one.peak, one.error]);
    each.max_by(|a, b| a[0].total_cmp(&b[0])).unwrap_or_default()
}

/// Motions at a frequency of a load.
pub(super) fn rows(case: &ModalCase, motions: &[ModalMotion]) -> Vec<Value> {
    let of_starts = motions.iter().map(|motion| motion.starts).sum();
    motions.iter().enumerate().map(|(k, one)| row(case, k, one, of_starts)).collect()
}

/// The same along a load.
pub(super) fn over_frequencies(case: &ModalCase, along: &AlongLoad) -> Vec<Value> {
    let place = along.places.iter().map(|one| {
        json!({ "at": one.at, "unit": frequency_unit(case), "motions": rows(case, &one.motions) })
    });
    place.collect()
}

fn row(case: &ModalCase, index: usize, motion: &ModalMotion, of_starts: u32) -> Value {
    let largest = |each: &mut dyn Iterator<Item = [f64; 2]>| {
        each.max_by(|a, b| a[0].total_cmp(&b[0])).unwrap_or_default()
    };
    let told = motion.regimes();
    let resting = motion.resting.iter().zip(1_u32..).filter(|(share, _)| share.is_some());
    let resting: Vec<u32> = resting.map(|(_, j)| j).collect();
    let visits = told.map(|one| one.visits_per_period.iter().copied().fold(0.0, f64::max));
    let fastest = largest(&mut motion.impact_speed.iter().copied());
    let listed = Listed {
        id: Motions::id(index),
        kind: motion.kind_name(),
        regime: motion.regime(),
        settled: motion.settled,
        why_not: motion.why_not(case.count_inactive),
        rest: motion.rests().then_some(RestKind::Floating),
        peak: peak(motion),
        rms: largest(&mut motion.read(Reading::Displacement).map(|one| one.rms)),
        impacts_per_period: largest(&mut motion.impacts_per_period.iter().copied()),
        impact_speed: (!motion.rests()).then(|| fastest.map(|one| case.omega() * one)),
        efficiency: told.and_then(|one| one.efficiency),
        starts: [motion.starts, of_starts],
        share: motion.share(of_starts),
        share_sudden: motion.sudden,
        repeats_after: motion.repeats_after,
        largest_multiplier: motion.largest_multiplier,
        visits_per_period: visits,
        followed: motion.followed,
        further: &[
            // Absorbers that rest where no wall reaches them, from 1.
            ("resting", json!(resting)),
            ("places", json!(places(case, motion))),
            ("absorbers", json!(absorbers(case, motion))),
        ],
    };
    listed.row()
}

/// What each place does.
fn places(case: &ModalCase, motion: &ModalMotion) -> Vec<Value> {
    let row =
        |one: &SensorExtent| json!({ "peak": pair([one.peak, one.error]), "rms": pair(one.rms) });
    let displaced = motion.read(Reading::Displacement).zip(&case.places);
    let of_place = |(one, name): (&SensorExtent, &String)| {
        let mut told = row(one);
        told["place"] = json!(name);
        told
    };
    let mut places: Vec<Value> = displaced.map(of_place).collect();
    // What else criteria ask for.
    for (reads, name) in [(Reading::Velocity, "velocity"), (Reading::Acceleration, "acceleration")]
    {
        for (place, one) in places.iter_mut().zip(motion.read(reads)) {
            place[name] = row(one);
        }
    }
    places
}

/// What each absorber does.
fn absorbers(case: &ModalCase, motion: &ModalMotion) -> Vec<Value> {
    let told = motion.regimes();
    let each = motion.impacts_per_period.iter().zip(&motion.impact_speed).enumerate();
    let row = |(j, (impacts, speed)): (usize, (&[f64; 2], &[f64; 2]))| {
        let speed = pair(speed.map(|one| case.omega() * one));
        json!({
            "absorber": j + 1,
            "at_rest": motion.resting[j].is_some(),
            // The share of its places in which it may.
            "share": motion.resting[j],
            "regime": told.map(|one| one.regimes[j]),
            "impacts_per_period": pair(*impacts),
            "impact_speed": motion.resting[j].is_none().then_some(speed),
            "visits_per_period": told.map(|one| one.visits_per_period[j]),
        })
    };
    each.map(row).collect()
}
