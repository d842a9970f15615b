//! Whether a quantity moved by more than it is known to: by the errors of both sides, and rounding.

use serde_json::{Value, json};

use crate::quantity::catalogue::{self, Dimension, Kind};

/// Relative error of what is exact but for rounding: roots are found to some 1e-12, and six digits more
/// than a report prints are left.
pub(super) const ROUNDING: f64 = 1e-9;
/// The same for a simulated motion: it counts as repeating when it closes to this over its size.
const REPETITION: f64 = 1e-6;
/// An error that grows by more than this factor is a change itself: behind it any number may hide.
const LOOSER: f64 = 10.0;
/// A relative change below this reads better as a number of its own.
const SMALL: f64 = 1e-4;

/// What became of a quantity.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Moved {
    /// Nothing beyond the errors of both sides.
    Within,
    /// More; with the change as a quantity, and what is allowed.
    Beyond(Option<Value>, Option<f64>),
    /// The error of one side is not known.
    Unjudged,
}

/// Whether a value of a document is a quantity.
pub(super) fn is_quantity(value: &Value) -> bool {
    ["id", "value", "error", "method"].iter().all(|field| value.get(field).is_some())
}

/// What a quantity is; none if this version's catalogue does not have it.
pub(super) fn kind(quantity: &Value) -> Option<&'static Kind> {
    catalogue::kind(quantity["id"].as_str()?)
}

/// Compares two quantities. One that is without limit on one side only has changed.
pub(super) fn moved(old: &Value, new: &Value) -> Moved {
    let (a, b) = match (old["value"].as_f64(), new["value"].as_f64()) {
        (Some(a), Some(b)) if old["id"] == new["id"] => (a, b),
        (None, None) if old["id"] == new["id"] => return Moved::Within,
        _ => return Moved::Beyond(None, None),
    };
    let Some(errors) = old["error"].as_f64().zip(new["error"].as_f64()) else {
        return Moved::Unjudged;
    };
    let dimension = kind(new).map_or(Dimension::Number, |kind| kind.dimension);
    let change = if dimension == Dimension::Angle { around(b - a) } else { b - a };
    let simulated = [old, new].iter().any(|one| one["method"] == "simulation");
    let tolerance = if simulated { REPETITION } else { ROUNDING };
    // Numbers without dimension are of order one, and zero by chance.
    let size = a.abs().max(b.abs());
    let scale = if is_pure(dimension) { size.max(1.0) } else { size };
    let allowed = errors.0 + errors.1 + tolerance * scale;
    let looser = errors.1 > LOOSER * errors.0 && errors.1 > tolerance * scale;
    if change.abs() <= allowed {
        return if looser { Moved::Beyond(None, Some(allowed)) } else { Moved::Within };
    }
    let relative = change / a.abs();
    let change = if is_difference(dimension) || a.abs() < allowed || relative.abs() < SMALL {
        json!({"id": new["id"], "value": change, "error": 0.0})
    } else {
        json!({"id": catalogue::RELATIVE_CHANGE.id, "value": relative, "error": 0.0})
    };
    Moved::Beyond(Some(change), Some(allowed))
}

fn is_pure(dimension: Dimension) -> bool {
    is_difference(dimension) || matches!(dimension, Dimension::Number | Dimension::Count)
}

/// Whether people subtract two of these rather than divide them.
fn is_difference(dimension: Dimension) -> bool {
    use Dimension::{Angle, Change, Inclination, Level, Share};
    matches!(dimension, Angle | Inclination | Change | Level | Share)
}

/// The same angle between minus and plus half a turn.
fn around(angle: f64) -> f64 {
    let turn = std::f64::consts::TAU;
    angle - turn * (angle / turn).round()
}

/// Whether two values differ in numbers alone, and in lists, which grow and shrink by chance.
pub(super) fn alike(old: &Value, new: &Value) -> bool {
    match (old, new) {
        (Value::Object(old), Value::Object(new)) => {
            old.len() == new.len()
                && old.iter().all(|(key, a)| new.get(key).is_some_and(|b| alike(a, b)))
        }
        (Value::Number(_), Value::Number(_)) | (Value::Array(_), Value::Array(_)) => true,
        _ => old == new,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quantity(id: &str, value: f64, error: Option<f64>, method: &str) -> Value {
        json!({"id": id, "value": value, "error": error, "method": method})
    }

    fn allowed(id: &str, method: &str, error: f64, values: [f64; 2]) -> Option<f64> {
        let [old, new] = values.map(|value| quantity(id, value, Some(error), method));
        match moved(&old, &new) {
            Moved::Beyond(_, allowed) => allowed,
            other => panic!("{id}: {other:?}"),
        }
    }

    /// By hand: errors of both sides, and 1e-9 or, simulated, 1e-6 of the larger value or of one.
    #[test]
    fn errors_of_both_sides_add_up() {
        let peak = "peak_displacement";
        assert_eq!(allowed(peak, "exact-orbit", 0.0, [-2.0, 1.0]), Some(2e-9));
        assert_eq!(allowed(peak, "simulation", 0.0, [2.0, 1.0]), Some(2e-6));
        assert_eq!(allowed(peak, "simulation", 0.25, [2.0, 4.0]), Some(0.5 + 4e-6));
        assert_eq!(allowed("trace", "theory", 0.0, [0.25, 0.5]), Some(1e-9));
        let near = [1e-3, 1e-3 + 1e-11].map(|value| quantity(peak, value, Some(0.0), "theory"));
        assert!(matches!(moved(&near[0], &near[1]), Moved::Beyond(..)));
    }

    #[test]
    fn a_full_turn_is_no_change_and_an_unknown_error_no_judgement() {
        let angle = |value| quantity("impact_phase", value, Some(0.0), "exact-orbit");
        assert_eq!(moved(&angle(0.5), &angle(0.5 - std::f64::consts::TAU)), Moved::Within);
        let [old, new] = [1.0, 2.0].map(|value| quantity("modulation_depth", value, None, "x"));
        assert_eq!(moved(&old, &new), Moved::Unjudged);
        let peak = |value: Value| json!({"id": "bare_peak", "value": value, "error": 0.0});
        assert_eq!(moved(&peak(json!(1.0)), &peak(Value::Null)), Moved::Beyond(None, None));
    }

    #[test]
    fn lengths_change_by_a_share_and_levels_by_decibels() {
        let change = |id: &str, values: [f64; 2]| {
            let [old, new] = values.map(|value| quantity(id, value, Some(0.0), "theory"));
            match moved(&old, &new) {
                Moved::Beyond(Some(change), _) => {
                    (change["id"].as_str().map(str::to_owned), change["value"].as_f64())
                }
                other => panic!("{other:?}"),
            }
        };
        let relative = catalogue::RELATIVE_CHANGE.id.to_owned();
        assert_eq!(change("peak_displacement", [2.0, 3.0]), (Some(relative), Some(0.5)));
        assert_eq!(change("change_db", [-2.0, -5.0]), (Some("change_db".into()), Some(-3.0)));
        assert_eq!(change("bare_peak", [0.0, 3.0]), (Some("bare_peak".into()), Some(3.0)));
    }
}
