//! How far a number may move before it has changed: what it is known to, by its own account.
//!
//! A number with an error is compared as an interval: two runs agree where their intervals overlap,
//! so errors add up. What comes from a closed form or an exact orbit is compared against rounding.
//! A number that chance moves and whose error nobody has measured is not judged.

use serde::Serialize;
use serde_json::Value;

use super::leaves::Leaf;
use super::motion;

/// Why a number may move as far as it may.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Basis {
    /// A closed form, an exact orbit or an input: rounding only.
    Rounding,
    /// A multiplier or a minimum: known to the root of rounding where two meet or the slope vanishes.
    RootOfRounding,
    /// A number that is an error itself and should be about zero.
    Residual,
    /// A simulated motion that repeats, as exactly as a repetition is asked to close.
    Repetition,
    /// Two standard errors on either side.
    TwoStandardErrors,
    /// An interval on either side: 95 % of a share, or of a Lyapunov exponent.
    Interval,
    /// A bracket or an enclosure on either side.
    Bracket,
    /// An average without an error of its own: three times those of rms displacement and impacts.
    OtherErrors,
    /// The largest of peaks that are modulated: a share of the modulation's depth on either side.
    Modulation,
    /// What the report says that the number is known to.
    Stated,
}

/// How far a number may move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Allowance {
    /// By as much, in the number's own unit.
    Within(f64, Basis),
    /// It moves by chance, or says what computing cost: counted, not judged.
    Unjudged,
    /// Another number says the same.
    Restated,
}

/// Relative error of what is exact but for rounding: roots are found to some 1e-12, and six digits more
/// than a report prints are left.
pub(super) const ROUNDING: f64 = 1e-9;
/// The same for multipliers, which are known to the root of the rounding where two of them meet, and
/// for the place of a minimum, where the slope vanishes.
const ROOT_OF_ROUNDING: f64 = 1e-6;
/// What an error or a residual of an exact solution may be without being a finding.
const RESIDUAL: f64 = 1e-9;

/// How far the number called `key` may move from `a` to `b`.
pub(super) fn allowance(key: &str, old: Leaf<'_>, new: Leaf<'_>, a: f64, b: f64) -> Allowance {
    let scale = a.abs().max(b.abs());
    let last = key.rsplit('/').next().unwrap_or(key);
    let rounding = Allowance::Within(ROUNDING * scale, Basis::Rounding);
    match key {
        "analysis/exact_boundaries/bracket"
        | "analysis/orbits/multipliers"
        | "attractors/proof/multipliers"
        | "claims/difference"
        | "claims/tolerance/value" => Allowance::Restated,
        "analysis/exact_boundaries/clearance" => {
            let width = bracket(old.element) + bracket(new.element);
            Allowance::Within(width + ROUNDING * scale, Basis::Bracket)
        }
        "analysis/fixed_points/B" => {
            let enclosed = number(old.element, "enclosure") + number(new.element, "enclosure");
            Allowance::Within(enclosed + ROUNDING * scale, Basis::Bracket)
        }
        "claims/observed/number" => claimed(old.element, new.element, scale),
        "layers/answers/value" => {
            let relative = old.element["question"] == "amplitude";
            let size = if relative { scale } else { 1.0 };
            let errors = number(old.element, "error") + number(new.element, "error");
            Allowance::Within(errors * size + ROUNDING * scale, Basis::Stated)
        }
        "layers/answers/error" | "layers/answers/others" => Allowance::Unjudged,
        _ if key.starts_with("layers/operations/") => Allowance::Unjudged,
        // The place of a smallest value is one of a grid's.
        "band/smallest_gap/at" => Allowance::Unjudged,
        "band/worst_peak" => {
            let errors = number(old.element, "error") + number(new.element, "error");
            Allowance::Within(errors + ROUNDING * scale, Basis::Stated)
        }
        "band/smallest_gap/share" | "band/stable_orbit/at" => {
            Allowance::Within(ROOT_OF_ROUNDING * scale, Basis::RootOfRounding)
        }
        _ if key.starts_with("attractors/proof/") || key.starts_with("analysis/orbits/") => {
            match last {
                "residual" => Allowance::Within(RESIDUAL, Basis::Residual),
                "distance_from_simulation" => Allowance::Within(motion::CLOSURE, Basis::Repetition),
                "spectral_radius" | "spectral_radius_per_period" => {
                    Allowance::Within(ROOT_OF_ROUNDING * scale, Basis::RootOfRounding)
                }
                "phase" => Allowance::Within(ROUNDING, Basis::Rounding),
                // It may be next to zero; the motion's size says what that means.
                "impact_displacement" => {
                    let size = number(new.element, "peak_displacement").max(scale);
                    Allowance::Within(ROUNDING * size, Basis::Rounding)
                }
                _ => rounding,
            }
        }
        _ if key.starts_with("attractors/") => {
            motion::allowance(key, old.element, new.element, a, b)
        }
        _ if key.starts_with("confirmations/") => {
            motion::probed(key, old.element, new.element, a, b)
        }
        _ if key.starts_with("margins/best_clearance/") => {
            Allowance::Within(ROOT_OF_ROUNDING * scale, Basis::RootOfRounding)
        }
        _ => match last {
            "residual" | "enclosure" | "test" => Allowance::Within(RESIDUAL, Basis::Residual),
            // Of order one, and zero by chance.
            "eta" | "Theta" | "trace" | "error_of_theory" => {
                Allowance::Within(ROUNDING * scale.max(1.0), Basis::Rounding)
            }
            _ => rounding,
        },
    }
}

/// Whether a number is an angle in radians, which is the same after a full turn.
pub(super) fn is_angle(key: &str) -> bool {
    ["/eta", "/Theta", "/phase"].iter().any(|angle| key.ends_with(angle))
}

/// The number of a field, 0 where there is none.
pub(super) fn number(element: &Value, field: &str) -> f64 {
    element[field].as_f64().unwrap_or(0.0)
}

/// Width of an element's bracket.
fn bracket(element: &Value) -> f64 {
    let end = |index: usize| element["bracket"][index].as_f64();
    end(0).zip(end(1)).map_or(0.0, |(low, high)| (high - low).abs())
}

/// What a claim was checked against: an exact orbit, or a simulation as exact as the claim asks.
fn claimed(old: &Value, new: &Value, scale: f64) -> Allowance {
    let simulated = [old, new].iter().any(|claim| claim["checked_by"] == "simulation");
    let angle = new["observed"]["number"][1] == "angle";
    let size = if angle { 1.0 } else { scale };
    if !simulated {
        return Allowance::Within(ROUNDING * size.max(scale), Basis::Rounding);
    }
    let tolerance = |claim: &Value| number(&claim["tolerance"], "value");
    Allowance::Within(tolerance(old).max(tolerance(new)) * size + ROUNDING * scale, Basis::Stated)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn allowed(key: &str, element: &Value, a: f64, b: f64) -> Allowance {
        let leaf = Leaf { value: element, element };
        allowance(key, leaf, leaf, a, b)
    }

    #[test]
    fn exact_numbers_may_round_and_no_more() {
        let none = json!({});
        for key in ["analysis/fixed_points/C", "bare_amplitude", "margins/clearance/factor"] {
            assert_eq!(allowed(key, &none, -2.0, 1.0), Allowance::Within(2e-9, Basis::Rounding));
        }
        let residual = allowed("analysis/fixed_points/residual", &none, 1e-17, 3e-17);
        assert_eq!(residual, Allowance::Within(1e-9, Basis::Residual));
    }

    #[test]
    fn brackets_and_stated_errors_add_up() {
        let boundary = json!({"bracket": [1.0, 1.25]});
        let found = allowed("analysis/exact_boundaries/clearance", &boundary, 0.0, 0.0);
        assert_eq!(found, Allowance::Within(0.5, Basis::Bracket));
        let answer = json!({"question": "amplitude", "error": 0.125});
        let found = allowed("layers/answers/value", &answer, 0.0, 4.0);
        assert_eq!(found, Allowance::Within(1.0 + 4e-9, Basis::Stated));
        let claim = json!({"checked_by": "simulation", "tolerance": {"value": 0.5}});
        let found = allowed("claims/observed/number", &claim, 2.0, 1.0);
        assert_eq!(found, Allowance::Within(1.0 + 2e-9, Basis::Stated));
        let orbit = json!({"checked_by": "exact-orbit", "tolerance": {"value": 0.5}});
        let found = allowed("claims/observed/number", &orbit, 2.0, 1.0);
        assert_eq!(found, Allowance::Within(2e-9, Basis::Rounding));
    }
}
