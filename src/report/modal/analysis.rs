//! The exact orbits under each load, and the amplitudes at which each absorber is in 1:1 resonance by theory.

use serde_json::{Value, json};

use super::{frequency_unit, given, load_row, units};
use crate::case::ModalCase;
use crate::method::Method;
use crate::modal::working_range;
use crate::orbits::ModalOrbit;
use crate::quantity::catalogue as of;
use crate::quantity::{Kind, Quantity};
use crate::report::document::{Content, headed};
use crate::report::error::RenderError;
use crate::report::template::render;

/// `vinesink/answer@1`: for each load the frequency in Hz and the orbits there, in SI.
pub fn analysis(case: &ModalCase, found: &[(f64, Vec<ModalOrbit>)]) -> Value {
    let omega = case.omega();
    let orbit = |one: &ModalOrbit| {
        let radius = one.spectral_radius();
        let mut told = json!(one);
        told["impact_times"] = one.impact_times.iter().map(|time| json!(time / omega)).collect();
        told["impact_speeds"] =
            one.impact_speeds.iter().map(|speed| json!(speed * omega)).collect();
        told["spectral_radius"] = json!(radius);
        // Of a whole period.
        told["largest_multiplier"] = json!(radius * radius);
        told["stable"] = json!(one.stable());
        told
    };
    let loads = found.iter().map(|(at, orbits)| {
        json!({ "at": at, "unit": frequency_unit(case), "orbits": orbits.iter().map(orbit).collect::<Vec<_>>() })
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

/// The same on a terminal.
///
/// # Errors
/// [`RenderError::Template`] if the template does not fit.
pub fn analysis_text(
    case: &ModalCase,
    found: &[(f64, Vec<ModalOrbit>)],
) -> Result<String, RenderError> {
    let mut facts = analysis(case, found);
    let quantities = |numbers: &Value, kind: &'static Kind| -> Value {
        let numbers = numbers.as_array().into_iter().flatten().filter_map(Value::as_f64);
        numbers.map(|one| json!(Quantity::new(kind, one, Method::ExactOrbit))).collect()
    };
    for ((k, load), (at, _)) in case.loads.iter().enumerate().zip(found) {
        facts["loads"][k]["load"] = load_row(case, load);
        facts["loads"][k]["at"] = json!(given(&of::EXCITATION_FREQUENCY, *at));
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
    render("modal-analysis.txt", &units(case), &facts)
}
