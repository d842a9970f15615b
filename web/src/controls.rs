//! What the sliders show and move: numbers of the case's design.

use serde_json::{Value, json};
use vinesink::case::{Case, Design};
use vinesink::study::plots::window;
use vinesink::system::Parameter;

/// The sliders of a design, in the page's order.
fn parameters(design: &Design) -> [Parameter; 6] {
    use Parameter as P;
    let damping = match design {
        Design::Physical(_) => P::DampingRatio,
        Design::Reduced(_) => P::Damping,
    };
    [P::Clearance, P::Restitution, P::MassRatio, damping, P::Frequency, P::Amplitude]
}

/// How far a slider goes to either side of the value it begins with, as a factor.
const RANGE: f64 = 8.0;
/// Up to where a slider goes whose value begins at 0.
const FROM_ZERO: f64 = 0.05;
/// The least and the largest mass ratio of a slider.
const MASS_RATIOS: [f64; 2] = [1e-4, 0.3];

/// The range of a slider and whether equal ratios get equal room.
fn range(case: &Case, parameter: Parameter, value: f64) -> ([f64; 2], bool) {
    match parameter {
        Parameter::Restitution => ([0.0, 1.0], false),
        Parameter::Frequency => {
            let system = case.system();
            let unit = value / system.frequency_ratio();
            (window(&system).map(|ratio| ratio * unit), false)
        }
        _ if value == 0.0 => ([0.0, FROM_ZERO], false),
        Parameter::MassRatio => {
            ([(value / RANGE).max(MASS_RATIOS[0]), (value * RANGE).min(MASS_RATIOS[1])], true)
        }
        _ => ([value / RANGE, value * RANGE], true),
    }
}

/// The sliders of a case: value and range in SI, the value's words, and the unit of its field.
pub fn controls(case: &Case) -> Value {
    let units = case.units();
    let one = |parameter: Parameter| {
        let kind = case.design.kind(parameter);
        let value = case.design.value(parameter)?;
        let (range, log) = range(case, parameter, value);
        let unit = units.unit(kind.dimension, value);
        Some(json!({
            "key": parameter.key(), "name": kind.name, "symbol": kind.symbol,
            "value": value, "words": units.text(kind, value),
            "unit": { "symbol": unit.symbol, "size": unit.size },
            "range": range, "log": log,
        }))
    };
    parameters(&case.design).into_iter().filter_map(one).collect()
}
