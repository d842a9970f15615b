//! A structure that a record or noise drives.

mod figure;

use serde_json::{Value, json};

use super::{sample, word_of, worst_rows};
use crate::case::{Case, RecordSource, Subject};
use crate::criteria::of_records;
use crate::excitation::RecordQuantity;
use crate::flights::Response;
use crate::method::Method;
use crate::quantity::catalogue as of;
use crate::quantity::{Kind, Quantity};
use crate::report::document::{Scale, Word};
use crate::transient::{Measured, RecordStudy, SpectrumPoint};

pub(super) use figure::figures;

/// What its page has beside what all have.
pub(super) fn add(case: &Case, study: &RecordStudy, facts: &mut Value) {
    let scale = Scale::of(case);
    let places = study.realisations.first().map_or(&[][..], |first| &first.places);
    let place = |(w, found): &(f64, Response)| {
        json!({
            "absorber": scale.units.quantity(&of::RELATIVE_DISPLACEMENT, *w, Method::Given),
            "peak": scale.units.quantity(&of::PEAK, found.peak, Method::Simulation),
            "rms": scale.units.quantity(&of::RMS, found.rms, Method::Simulation),
            "impacts": Quantity::new(&of::IMPACT_COUNT, found.impacts as f64, Method::Simulation),
            "impact_speed": scale.units.quantity(&of::IMPACT_SPEED, found.impact_speed, Method::Simulation),
        })
    };
    for (name, told) in told(case, study) {
        facts[name] = json!(told);
    }
    facts["records"] = study.realisations.len().into();
    // Under the first record.
    facts["worst"] = worst_rows(places, |(_, found)| found.peak, place);
    let mut places: Vec<&(f64, Response)> = places.iter().collect();
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    facts["sample"] = sample(study.even, places.len());
    facts["places"] = places.into_iter().map(place).collect();
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
        RecordSource::File { path, read } => {
            json!({ "file": path, "sha256": read.as_ref().map(|(digest, _)| digest) })
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
    })
}

/// What is said of the absorber, by the names that pages use.
const TOLD: [(&str, Subject); 5] = [
    ("peak", Subject::PeakDisplacement),
    ("rms", Subject::RmsDisplacement),
    ("impact_speed", Subject::ImpactVelocity),
    ("reduction_db", Subject::ReductionDb),
    ("reduction_db_tmd", Subject::ReductionDbTmd),
];

fn told<'a>(
    case: &'a Case,
    study: &'a RecordStudy,
) -> impl Iterator<Item = (&'static str, Quantity)> + 'a {
    TOLD.into_iter().filter_map(|(name, subject)| {
        let kind = subject.kind_under(study.realisations.len())?;
        let [value, error] = of_records(&case.units(), study, subject);
        Some((name, Quantity::new(kind, value, Method::Simulation).with_error(error)))
    })
}

pub(super) fn quantities(case: &Case, study: &RecordStudy) -> Vec<Quantity> {
    let scale = Scale::of(case);
    let given = |kind, value| Quantity::new(kind, value, Method::Given);
    let (simulated, exact) = (Method::Simulation, Method::ClosedForm);
    let length = |kind: &'static Kind, value: Measured, method| {
        scale.units.quantity_with(kind, value, method)
    };
    let plain = |kind: &'static Kind, value| Quantity::new(kind, value, simulated);
    let shown = study.shown().map(|(_, worst)| worst);
    let mut all: Vec<Quantity> = told(case, study).map(|(_, told)| told).collect();
    all.extend([
        length(&of::BARE_PEAK, study.mean(|one| one.bare.peak), exact),
        length(&of::BARE_RMS, study.mean(|one| one.bare.rms), exact),
        length(&of::DAMPER_PEAK, study.mean(|one| one.damped.peak), exact),
        length(&of::DAMPER_RMS, study.mean(|one| one.damped.rms), exact),
        length(&of::DAMPER_STROKE, study.mean(|one| one.damped.stroke), exact),
        given(&of::DAMPER_FREQUENCY_RATIO, study.damper.tuning),
        given(&of::DAMPER_DAMPING_RATIO, study.damper.damping_ratio),
    ]);
    if let Some(worst) = shown {
        all.push(plain(&of::IMPACT_COUNT, worst.impacts as f64));
        all.push(plain(&of::IMPACT_ENERGY_SHARE, worst.impact_loss / worst.work));
    }
    all
}

pub(super) fn word(study: &RecordStudy) -> Word {
    let [peak, _] = study.worst(|one, place| place.peak / one.bare.peak);
    let [rms, _] = study.worst(|one, place| place.rms / one.bare.rms);
    word_of(peak.max(rms), peak.min(rms))
}
