//! An axis of a sweep in the units that the case's reader uses.

use serde::Serialize;

use crate::case::{Case, Design, PhysicalExcitation};
use crate::report::figure::{Axis, Scale, edges};
use crate::report::numbers::{LengthFormat, significant};

/// An axis as it is shown.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AxisShown {
    /// Its key in the table `[sweep]`, and the name of its column.
    pub key: String,
    /// What it is: `clearance`.
    pub name: String,
    /// The name with symbol and unit: `clearance b (mm)`.
    pub label: String,
    /// The shown unit; empty for a pure number.
    pub unit: String,
    /// Its values in the shown unit, ascending.
    pub values: Vec<f64>,
    /// Whether each is so many times the one before.
    pub logarithmic: bool,
    /// The case's own value in the shown unit, where the case has one.
    pub own: Option<f64>,
}

/// How a parameter is shown.
struct Way {
    name: &'static str,
    symbol: &'static str,
    /// The shown unit, and how many SI units make one of it.
    unit: (&'static str, f64),
    /// The case's own value in SI units.
    own: Option<f64>,
}

impl AxisShown {
    /// The axis of a key of `[sweep]` with its values in SI units (lengths of a reduced design in its own
    /// unit, ratios as plain numbers). A key that is not known is shown as it is.
    pub fn of(case: &Case, key: &str, values: &[f64], logarithmic: bool) -> Self {
        let largest = values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        let way = way(case, key, largest).unwrap_or(Way {
            name: "",
            symbol: "",
            unit: ("", 1.0),
            own: None,
        });
        let (unit, size) = way.unit;
        let name = if way.name.is_empty() { key.replace('_', " ") } else { way.name.to_owned() };
        let label = format!("{name} {}", way.symbol);
        let shown = if unit.is_empty() { "1" } else { unit };
        Self {
            key: key.to_owned(),
            label: format!("{} ({shown})", label.trim_end()),
            name,
            unit: unit.to_owned(),
            values: values.iter().map(|value| value / size).collect(),
            logarithmic,
            own: way.own.map(|own| own / size),
        }
    }

    /// Whether it varies where motions start, not the system.
    pub fn is_initial(&self) -> bool {
        self.key.starts_with("initial_")
    }

    /// The boundaries of the values' cells.
    pub(super) fn edges(&self) -> Vec<f64> {
        edges(&self.values, self.scale())
    }

    const fn scale(&self) -> Scale {
        if self.logarithmic { Scale::Log } else { Scale::Linear }
    }

    /// The axis of a figure, from one value to another.
    pub(super) fn drawn(&self, from: f64, to: f64) -> Axis {
        let axis = Axis::linear(self.label.clone()).with_range(from, to);
        Axis { scale: self.scale(), ..axis }
    }

    /// A value with so many digits that neighbours differ, and its unit.
    pub(super) fn number(&self, index: usize) -> String {
        let value = self.values[index];
        let near = [index.checked_sub(1), Some(index + 1)];
        let step = near
            .into_iter()
            .flatten()
            .filter_map(|k| Some((self.values.get(k)? - value).abs()))
            .fold(f64::INFINITY, f64::min);
        let needed = libm::ceil(libm::log10(value.abs() / step));
        let digits = if needed.is_finite() { needed.clamp(3.0, 6.0) as usize } else { 3 };
        let number = significant(value, digits);
        if self.unit.is_empty() { number } else { format!("{number} {}", self.unit) }
    }

    /// The same with its name.
    pub(super) fn text(&self, index: usize) -> String {
        format!("{} {}", self.name, self.number(index))
    }
}

fn way(case: &Case, key: &str, largest: f64) -> Option<Way> {
    let (system, scales) = (case.system(), case.scales());
    let lengths = LengthFormat::of(&scales);
    let length = (lengths.unit, 1.0 / lengths.number(1.0));
    let physical = match &case.design {
        Design::Physical(physical) => Some(physical),
        Design::Reduced(_) => None,
    };
    let percent = ("%", 0.01);
    let pure = ("", 1.0);
    let way = |name, symbol, unit, own| Some(Way { name, symbol, unit, own });
    match key {
        "clearance" => way("clearance", "b", length, Some(scales.clearance)),
        "frequency" => match physical {
            Some(design) => way("frequency", "f", ("Hz", 1.0), Some(design.frequency_hz)),
            None => way("frequency ratio", "Ω", pure, Some(system.frequency_ratio())),
        },
        "frequency_ratio" => way("frequency ratio", "Ω", pure, Some(system.frequency_ratio())),
        "detuning" => way("detuning", "σ", pure, Some(system.detuning())),
        "amplitude" => match physical.map(|design| design.excitation) {
            Some(PhysicalExcitation::BaseDisplacement { amplitude_m }) => {
                way("base displacement", "F", length, Some(amplitude_m))
            }
            Some(PhysicalExcitation::Force { amplitude_n }) => {
                way("force", "P", ("N", 1.0), Some(amplitude_n))
            }
            None => way("reduced forcing", "G", length, Some(scales.forcing)),
        },
        "amplitude_over_own" => way("amplitude over the case's own", "", pure, Some(1.0)),
        "restitution" => way("restitution", "r", pure, Some(system.restitution())),
        "absorber_mass" => {
            let unit = if largest < 1.0 { ("g", 1e-3) } else { ("kg", 1.0) };
            way("absorber mass", "m₂", unit, physical.map(|design| design.absorber_mass_kg))
        }
        "mass_ratio" => way("mass ratio", "ε", percent, Some(system.mass_ratio())),
        "mass" => way("oscillator mass", "m₁", ("kg", 1.0), physical.map(|design| design.mass_kg)),
        "stiffness" => {
            let unit = if largest < 1e3 { ("N/m", 1.0) } else { ("kN/m", 1e3) };
            way("stiffness", "k₁", unit, physical.map(|design| design.stiffness_n_per_m))
        }
        "damping" => match physical {
            Some(design) => way("damping", "c₁", ("N s/m", 1.0), Some(design.damping_n_s_per_m)),
            None => way("damping", "λ", pure, Some(system.damping())),
        },
        "damping_ratio" => {
            let own = system.mass_ratio() * system.damping() / 2.0;
            way("damping ratio", "ζ", percent, Some(own))
        }
        "initial_displacement" => way("initial displacement", "x", length, None),
        "initial_absorber_displacement" => {
            way("initial displacement of the absorber", "y", length, None)
        }
        "initial_velocity" | "initial_absorber_velocity" => {
            let unit = if physical.is_some() { ("m/s", 1.0) } else { pure };
            match key {
                "initial_velocity" => way("initial velocity", "ẋ", unit, None),
                _ => way("initial velocity of the absorber", "ẏ", unit, None),
            }
        }
        _ => None,
    }
}
