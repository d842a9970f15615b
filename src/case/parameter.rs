//! What a parameter is in a design: its value, the quantity that it is, and how it is written.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::Design;
use super::excitation::impossible;
use super::number::Form;
use crate::excitation::{Scene, Transient};
use crate::quantity::Dimension;
use crate::system::{Parameter, System};

impl Design {
    /// The value of a parameter in SI, or a plain number of a reduced design; `None` for a part of the start,
    /// or what the design has not.
    pub fn value(&self, parameter: Parameter) -> Option<f64> {
        if self.holds(parameter) {
            return (self.row(parameter)?.get)(self);
        }
        self.transient()?.number(parameter).copied()
    }

    /// The design with another value; unchanged by what is a part of the start, or what it has not. A
    /// mass, stiffness or damping changes alone: the others keep their numbers, not their ratios.
    #[must_use]
    pub fn with(mut self, parameter: Parameter, value: f64) -> Self {
        if let Some(row) = self.row(parameter).filter(|_| self.holds(parameter)) {
            (row.set)(&mut self, value);
        } else if let Some(number) = self.transient_mut().and_then(|of| of.number(parameter)) {
            // It is no number of the design itself.
            *number = value;
        }
        // What has no frequency of its own is counted in the structure's.
        if let (Scene::Release | Scene::Record, Self::Physical(p)) = (self.scene(), &mut self) {
            p.frequency_hz = p.natural_frequency_rad_per_s() / TAU;
        }
        self
    }

    /// The system; none where values that are each valid leave none, or nothing that could happen to it.
    pub fn possible_system(&self) -> Option<System> {
        let possible = self.transient().is_none_or(|of| impossible(&of).is_none());
        possible.then(|| self.system().ok())?
    }

    /// Whether a parameter is a number of the structure and its absorber, or of steady excitation.
    fn is_of_system(&self, parameter: Parameter) -> bool {
        use Parameter as P;
        match (self.scene(), parameter) {
            _ if self.carried(parameter).is_some() => false,
            (Scene::Steady, other) => other != P::Rate,
            (scene, P::Amplitude) => scene == Scene::Sweep,
            (_, P::Frequency | P::Detuning | P::Rate) => false,
            (_, other) => !other.is_initial(),
        }
    }

    /// Whether its own numbers say a parameter, or what it is subjected to; the ratio of a reduced design is its own
    /// whatever happens to it.
    fn holds(&self, parameter: Parameter) -> bool {
        let ratio = matches!(parameter, Parameter::Frequency | Parameter::Detuning);
        self.is_of_system(parameter) || ratio && !self.is_physical()
    }

    /// The same with errors added to some parameters; restitutions stay between 0 and 1, an angle within a quarter
    /// turn, an amplitude, friction and damping at 0 or more.
    #[must_use]
    pub fn deviating(self, errors: &[(Parameter, f64)]) -> Self {
        errors.iter().fold(self, |design, (parameter, error)| {
            let value = design.value(*parameter).unwrap_or(f64::NAN) + error;
            let apart = design.restitution_difference().abs();
            design.with(*parameter, possible(*parameter, value, apart))
        })
    }

    /// Restitution at the wall `x - y = +b` less that at `x - y = -b`.
    pub fn restitution_difference(&self) -> f64 {
        match self {
            Self::Physical(of) => of.restitution_difference,
            Self::Reduced(of) => of.cavity.restitution_difference,
        }
    }

    /// The design with restitutions further apart, their mean as it is.
    #[must_use]
    pub fn with_restitutions_apart(mut self, by: f64) -> Self {
        let difference = match &mut self {
            Self::Physical(of) => &mut of.restitution_difference,
            Self::Reduced(of) => &mut of.cavity.restitution_difference,
        };
        *difference += by.copysign(*difference);
        self
    }

    /// `b`, in metres or the design's own unit.
    pub fn clearance(&self) -> f64 {
        self.units().clearance
    }

    /// What a number of the cavity that a design of the other kind has is called in this one.
    pub(super) fn counterpart(&self, parameter: Parameter) -> Option<Parameter> {
        let other = match parameter {
            Parameter::Inclination => Parameter::GravityAlong,
            Parameter::GravityAlong => Parameter::Inclination,
            Parameter::Friction => Parameter::FrictionAcceleration,
            Parameter::FrictionAcceleration => Parameter::Friction,
            _ => return None,
        };
        self.row(parameter).is_none().then_some(other)
    }

    /// The symbol of the SI unit in which a parameter's values are held; "1" for a plain number.
    pub fn unit(&self, parameter: Parameter) -> &'static str {
        self.kind(parameter).dimension.symbol(self.units().physical)
    }

    /// How values of a parameter are written beside this design: as the design's own; `None` where it has no
    /// such number.
    pub(super) fn form(&self, parameter: Parameter) -> Option<Form> {
        let of_system = self.is_of_system(parameter);
        let says = |mut of: Transient| of.number(parameter).is_some();
        if !of_system && !self.transient().is_some_and(says) {
            return None;
        }
        if !of_system || !parameter.is_initial() {
            let form = Form::of(self.schema(parameter)?)?;
            if parameter != Parameter::Rate || !self.is_physical() {
                return Some(form);
            }
            let dimension = self.kind(parameter).dimension;
            let example = format!("\"{}\"", dimension.words().1);
            return Some(Form { dimension: Some(dimension), exact: true, example, ..form });
        }
        let symbol = match parameter {
            Parameter::InitialDisplacement => "x_0",
            Parameter::InitialVelocity => r"\dot{x}_0",
            Parameter::InitialAbsorberDisplacement => "y_0",
            _ => r"\dot{y}_0",
        };
        let dimension = self.kind(parameter).dimension;
        Some(match dimension {
            _ if !self.is_physical() => Form::free(None, "0.5", symbol),
            Dimension::Length => Form::free(Some(dimension), "\"5 mm\"", symbol),
            _ => Form::free(Some(dimension), "\"0.2 m/s\"", symbol),
        })
    }
}

/// The nearest value that a parameter may have, where the restitutions of the walls are so far apart.
pub(super) fn possible(parameter: Parameter, value: f64, apart: f64) -> f64 {
    match parameter {
        Parameter::Restitution => value.max(0.5 * apart).min(1.0 - 0.5 * apart),
        Parameter::Inclination => value.clamp(-FRAC_PI_2, FRAC_PI_2),
        Parameter::Amplitude
        | Parameter::Friction
        | Parameter::FrictionAcceleration
        | Parameter::DampingRatio => value.max(0.0),
        _ => value,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Case;

    #[test]
    fn a_value_that_is_set_is_the_value_that_is_there() {
        let design = Case::parse("a case", &Case::starting_text("t")).expect("valid").design;
        let design = design.with(Parameter::Inclination, 0.01).with(Parameter::Friction, 0.003);
        for parameter in Parameter::ALL {
            let Some(own) = design.value(parameter) else { continue };
            let other = design.with(parameter, 1.1 * own).value(parameter).expect("the same key");
            assert!((other / own - 1.1).abs() < 1e-12, "{parameter:?}");
        }
        assert_eq!(design.value(Parameter::InitialVelocity), None);
        assert_eq!(design.with(Parameter::InitialVelocity, 1.0), design);
        let off = [(Parameter::Restitution, 2.0), (Parameter::Amplitude, -1e9)];
        let built = design.deviating(&off);
        assert_eq!(built.value(Parameter::Restitution), Some(1.0));
        assert_eq!(built.value(Parameter::Amplitude), Some(0.0));
        let off = [(Parameter::Inclination, -2.0), (Parameter::Friction, -0.1)];
        let built = design.deviating(&off);
        assert_eq!(built.value(Parameter::Inclination), Some(-FRAC_PI_2));
        assert_eq!(built.value(Parameter::Friction), Some(0.0));
    }
}
