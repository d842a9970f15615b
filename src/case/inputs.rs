//! The numbers of a case for display: as its author wrote them, and what follows from them.

use std::ops::Range;

use serde::Serialize;

use super::{Case, Design};

/// One number of a case, given or derived.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Input {
    /// The table it stands in; empty for a derived number.
    pub table: String,
    /// The key in the case file, or the name of what was derived.
    pub name: &'static str,
    /// The symbol in LaTeX.
    pub symbol: String,
    /// The value in `unit`.
    pub value: f64,
    /// SI unit symbol, "1" for a pure number (lengths of a reduced case included).
    pub unit: &'static str,
    /// The text in the case file, with its own unit and without quotes; empty when derived.
    pub as_written: String,
    /// Where its value stands in the text.
    #[serde(skip)]
    pub(super) span: Range<usize>,
}

impl Case {
    /// The numbers of the case file, in the order in which its tables are documented.
    pub fn inputs(&self) -> &[Input] {
        &self.inputs
    }

    /// The numbers that follow from the inputs, the dimensionless ones that decide the dynamics
    /// among them.
    pub fn derived(&self) -> Vec<Input> {
        let (system, units) = (self.system(), self.units());
        let unit = units.length_unit();
        let damping_ratio = system.mass_ratio() * system.damping() / 2.0;
        let numbers = [
            ("natural_frequency", "f_0", units.frequency(1.0), "Hz"),
            ("mass_ratio", r"\varepsilon", system.mass_ratio(), "1"),
            ("damping", r"\lambda", system.damping(), "1"),
            ("damping_ratio", r"\zeta_1", damping_ratio, "1"),
            ("frequency_ratio", r"\Omega", system.frequency_ratio(), "1"),
            ("detuning", r"\sigma", system.detuning(), "1"),
            ("forcing", "G", self.design.forcing(), unit),
            ("forcing_per_clearance", r"\gamma", system.forcing_per_clearance(), "1"),
        ];
        let place = match &self.design {
            Design::Physical(of) if of.shape * of.shape != 1.0 => {
                let mass = of.structure().mass_kg;
                Some(("mass_at_the_absorber", r"m_1/\phi^2", mass, "kg"))
            }
            _ => None,
        };
        let derived =
            |(name, symbol, value, unit): (&'static str, &str, f64, &'static str)| Input {
                table: String::new(),
                name,
                symbol: symbol.to_owned(),
                value,
                unit,
                as_written: String::new(),
                span: 0..0,
            };
        let cavity = system.cavity();
        let of_cavity = [
            ("gravity_along", "a", cavity.gravity_along, "1"),
            ("friction_acceleration", "f", cavity.friction_acceleration, "1"),
            ("restitution_difference", "r_1 - r_2", cavity.restitution_difference, "1"),
        ];
        // A reduced design has no frequency but ratios.
        let numbers = numbers.into_iter().skip(usize::from(!units.physical));
        let numbers = place.into_iter().chain(numbers);
        numbers.chain(of_cavity.into_iter().filter(|_| !cavity.is_ideal())).map(derived).collect()
    }
}
