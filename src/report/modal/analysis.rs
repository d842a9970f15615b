//! What theory says of the mode that each load drives, the exact orbits there and where they attract, and the amplitudes at which each
//! absorber is in 1:1 resonance.

use serde_json::{Value, json};

use super::{frequency_unit, given, load_row, stretch_rows, theory, told_of_one, units};
use crate::case::ModalCase;
use crate::method::Method;
use crate::modal::{LoadOrbits, Stretches, working_range};
use crate::orbits::{ModalOrbit, ReachEnd};
use crate::quantity::catalogue as of;
use crate::quantity::{Kind, Quantity};
use crate::report::document::{Content, headed};
use crate::report::error::RenderError;
use crate::report::template::render;
use crate::system::ModalParameter;

/// For each load and each mode in its range the frequency in Hz, the orbits there and where one attracts, in SI; orbits of a case that
/// lists no loads are at the top.
pub fn analysis(case: &ModalCase, found: &[LoadOrbits]) -> Value {
    told_of_one(case, of_loads(case, found))
}

fn of_loads(case: &ModalCase, found: &[LoadOrbits]) -> Value {
    let omega = case.omega();
    let orbit = |one: &ModalOrbit, at: f64| {
        let radius = one.spectral_radius();
        let mut told = json!(one);
        told["at"] = json!(at);
        told["impact_times"] = one.impact_times.iter().map(|time| json!(time / omega)).collect();
        told["impact_speeds"] =
            one.impact_speeds.iter().map(|speed| json!(speed * omega)).collect();
        told["spectral_radius"] = json!(radius);
        // Of a whole period.
        told["largest_multiplier"] = json!(radius * radius);
        told["stable"] = json!(one.stable());
        told
    };
    let loads = found.iter().map(|one| {
        json!({
            "load": one.load + 1,
            "at": one.at,
            "unit": frequency_unit(case),
            "orbits": one.orbits.iter().map(|orbit_of| orbit(orbit_of, one.at)).collect::<Vec<_>>(),
            "theory": one.theory.as_ref().map(|found| theory::row(case, found)),
            "stable": one.along.iter().map(|along| stretches(case, one.load, along)).collect::<Vec<_>>(),
        })
    });
    let absorbers = case.absorbers.iter().map(|one| {
        let [lower, upper] = working_range(one);
        json!({ "place": case.places[one.place], "from": lower, "to": upper })
    });
    let fields =
        json!({ "loads": loads.collect::<Vec<_>>(), "absorbers": absorbers.collect::<Vec<_>>() });
    let heading = [&case.title, &case.source, &case.text_hash];
    headed(heading.map(String::as_str), units(case).name(), Content::Analysis, fields)
}

/// Where an orbit attracts along a number.
fn stretches(case: &ModalCase, load: usize, of: &Stretches) -> Value {
    let (what, absorber, kind) = varied(case, load, of);
    let unit = kind.dimension.symbol(!case.reduced);
    let end = |end: &ReachEnd| json!({ "value": end.value, "kind": end.kind });
    let found = of.found.iter().map(|[from, to]| json!({ "from": end(from), "to": end(to) }));
    json!({
        "of": what,
        "absorber": absorber,
        "unit": unit,
        "looked_at": of.range,
        "stretches": found.collect::<Vec<_>>(),
    })
}

/// What a number is called, of which absorber it is, and its kind.
fn varied(
    case: &ModalCase,
    load: usize,
    of: &Stretches,
) -> (&'static str, Option<usize>, &'static Kind) {
    match of.parameter {
        ModalParameter::FrequencyRatio => ("frequency", None, &of::EXCITATION_FREQUENCY),
        ModalParameter::Clearance(j) => ("clearance", Some(j + 1), &of::CLEARANCE),
        _ => ("amplitude", None, case.loads[load].amplitude_kind()),
    }
}

/// The same on a terminal.
///
/// # Errors
/// [`RenderError::Template`] if the template does not fit.
pub fn analysis_text(case: &ModalCase, found: &[LoadOrbits]) -> Result<String, RenderError> {
    let mut facts = of_loads(case, found);
    let quantities = |numbers: &Value, kind: &'static Kind| -> Value {
        let numbers = numbers.as_array().into_iter().flatten().filter_map(Value::as_f64);
        numbers.map(|one| json!(Quantity::new(kind, one, Method::ExactOrbit))).collect()
    };
    for (k, one) in found.iter().enumerate() {
        facts["loads"][k]["excitation"] = load_row(case, &case.loads[one.load]);
        facts["loads"][k]["at"] = json!(given(&of::EXCITATION_FREQUENCY, one.at));
        for (told, along) in
            facts["loads"][k]["stable"].as_array_mut().into_iter().flatten().zip(&one.along)
        {
            let (.., kind) = varied(case, one.load, along);
            told["looked_at"] = json!(along.range.map(|value| given(kind, value)));
            told["stretches"] = json!(stretch_rows(kind, along));
        }
        for orbit in facts["loads"][k]["orbits"].as_array_mut().into_iter().flatten() {
            orbit["speeds"] = quantities(&orbit["impact_speeds"], &of::IMPACT_SPEED);
            orbit["at_absorbers"] = quantities(&orbit["harmonics_at_absorbers"], &of::PEAK);
        }
    }
    for absorber in facts["absorbers"].as_array_mut().into_iter().flatten() {
        for end in ["from", "to"] {
            absorber[end] = json!(absorber[end].as_f64().map(|one| given(&of::PEAK, one)));
        }
    }
    render("loads-analysis.txt", &units(case), &facts)
}
