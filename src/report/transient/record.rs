//! A structure that a record or noise drives.

mod figure;

use serde_json::{Value, json};

use super::{sample, word_of, worst_rows};
use crate::case::{Case, RecordSource};
use crate::excitation::RecordQuantity;
use crate::flights::Response;
use crate::measure::{Device, Measure};
use crate::method::Method;
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;
use crate::report::document::{Scale, Word};
use crate::transient::{RecordStudy, SpectrumPoint, Study};

pub(super) use figure::figures;

/// What its page has beside what all have.
pub(super) fn add(case: &Case, all: &Study, study: &RecordStudy, facts: &mut Value) {
    let scale = Scale::of(case);
    let place = |(w, found): &(f64, Response)| {
        json!({
            "absorber": scale.units.quantity(&of::RELATIVE_DISPLACEMENT, *w, Method::Given),
            "peak": scale.units.quantity(&of::PEAK, found.peak, Method::Simulation),
            "rms": scale.units.quantity(&of::RMS, found.rms, Method::Simulation),
            "impacts": Quantity::new(&of::IMPACT_COUNT, found.impacts as f64, Method::Simulation),
            "impact_speed": scale.units.quantity(&of::IMPACT_SPEED, found.impact_speed, Method::Simulation),
        })
    };
    for (name, measure) in TOLD {
        facts[name] = json!(all.quantity(&case.units(), measure, Device::Absorber));
    }
    facts["records"] = study.realisations.len().into();
    // Under the first record.
    if let Some(first) = study.first() {
        facts["worst"] = worst_rows(case, &first.places, Measure::Peak, place);
        facts["sample"] = sample(first.places.sample());
        facts["places"] = first.places.by_place().into_iter().map(place).collect();
    }
    let exact = |kind, peak| scale.units.quantity(kind, peak, Method::ClosedForm);
    let natural = |ratio: f64| scale.units.quantity(&of::STRUCTURE_FREQUENCY, ratio, Method::Given);
    let point = |one: &SpectrumPoint| {
        json!({
            "frequency": natural(one.ratio),
            "bare": exact(&of::BARE_PEAK, one.bare),
            "absorber": scale.units.quantity(&of::PEAK, one.absorber, Method::Simulation).with_error(f64::NAN),
            "damper": exact(&of::DAMPER_PEAK, one.damped),
        })
    };
    facts["spectrum"] = study.spectrum.iter().map(point).collect();
    facts["input"] = input(case, study);
}

/// What drives the structure.
fn input(case: &Case, study: &RecordStudy) -> Value {
    let source = case.recording.as_ref().map(|recording| match &recording.source {
        RecordSource::File { path, read, .. } => {
            json!({ "file": path, "sha256": read.as_ref().map(|read| &read.sha256) })
        }
        RecordSource::Spectrum(spectrum) => json!({
            "corners": spectrum.corners,
            "seed": spectrum.seed,
        }),
    });
    let quantity = case.recording.as_ref().map(|recording| recording.quantity);
    let kind = match quantity {
        Some(RecordQuantity::BaseDisplacement) => &of::DISPLACEMENT,
        Some(RecordQuantity::Force) => &of::FORCE_AMPLITUDE,
        _ => &of::ACCELERATION,
    };
    let peak = study.input_peaks.iter().copied().fold(0.0, f64::max);
    json!({
        "source": source,
        "quantity": quantity.map(RecordQuantity::name),
        // The largest value of all records.
        "peak": Quantity::new(kind, peak, Method::Given),
        "duration": Quantity::new(&of::TIME, study.length.0, Method::Given),
        "samples": study.length.1,
        // After the end of a record; and what may come where a motion was given up.
        "followed": case.units().quantity(&of::TIME, study.rang(), Method::Simulation),
        "open": (study.open() > 0.0).then(|| case.units().quantity(&of::PEAK, study.open(), Method::Simulation)),
    })
}

/// What is said of the absorber, by the names that pages use: of one record and of several it is of different kinds.
const TOLD: [(&str, Measure); 5] = [
    ("peak", Measure::Peak),
    ("rms", Measure::Rms),
    ("impact_speed", Measure::ImpactSpeed),
    ("reduction_db", Measure::ReductionDb),
    ("reduction_db_tmd", Measure::ReductionDbTmd),
];

/// What has no place in the list of measures.
pub(super) fn quantities(study: &RecordStudy) -> Vec<Quantity> {
    let given = |kind, value| Quantity::new(kind, value, Method::Given);
    vec![
        given(&of::DAMPER_FREQUENCY_RATIO, study.damper.tuning),
        given(&of::DAMPER_DAMPING_RATIO, study.damper.damping_ratio),
    ]
}

pub(super) fn word(study: &Study) -> Word {
    let over_bare = |of: Measure| {
        let value = |by: Device| study.ask(of, by).map_or(f64::NAN, |found| found.value[0]);
        value(Device::Absorber) / value(Device::Without)
    };
    let [peak, rms] = [Measure::Peak, Measure::Rms].map(over_bare);
    word_of(peak.max(rms), peak.min(rms))
}
