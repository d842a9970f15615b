//! The units of a design and its pages: from a dimensionless number to SI, and from there (`shown`) to what a reader
//! sees.

mod shown;

use std::ops::Deref;

use super::Quantity;
use super::catalogue::{Dimension, Kind};
use super::unit::Unit;
use crate::method::Method;
use crate::system::STANDARD_GRAVITY;
use crate::system::Scales;

/// The units of a design and its pages: SI, or for a reduced design those of an oscillator with m1 = k1 = 1, lengths in
/// the unit of its own clearance. They turn what is dimensionless into quantities, as its [`Scales`] do, and quantities into
/// text; the unit that a page's lengths share is that of the clearance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Units {
    scales: Scales,
    /// Whether pages are in inches and pounds.
    us: bool,
    /// Whether accelerations on pages are in g.
    in_g: bool,
    /// A dimension whose numbers are in a unit of their own.
    told_in: Option<(Dimension, Unit)>,
    /// Acceleration of the oscillator at the top of an impact's pulse, over the relative speed of the impact.
    pulse: Option<f64>,
}

impl From<Scales> for Units {
    fn from(scales: Scales) -> Self {
        Self { scales, us: false, in_g: false, told_in: None, pulse: None }
    }
}

impl Deref for Units {
    type Target = Scales;

    fn deref(&self) -> &Scales {
        &self.scales
    }
}

/// The conversion from dimensionless numbers, and back.
impl Units {
    /// A number of some dimension in these units, of the dimensionless one: lengths over the clearance, times over
    /// `1/omega0`, frequencies over the natural one, masses over `m1`.
    pub fn number(&self, dimension: Dimension, value: f64) -> f64 {
        match dimension {
            Dimension::Length => self.length(value),
            Dimension::Time => self.time(value),
            Dimension::Frequency => self.frequency(value),
            Dimension::FrequencyRate => self.frequency(value) * self.natural_frequency,
            Dimension::Velocity => self.velocity(value),
            Dimension::Acceleration => self.acceleration(value),
            Dimension::Mass => self.oscillator_mass * value,
            Dimension::Stiffness => self.number(Dimension::Damping, value) * self.natural_frequency,
            Dimension::Damping => self.oscillator_mass * self.natural_frequency * value,
            Dimension::Force => self.oscillator_mass * self.acceleration(value),
            Dimension::Energy => self.energy(value),
            Dimension::Power => self.energy(value) * self.natural_frequency,
            Dimension::Impulse => self.oscillator_mass * self.velocity(value),
            // Cases have it, pages do not.
            Dimension::AccelerationDensity
            | Dimension::OctaveRate
            | Dimension::Angle
            | Dimension::Inclination
            | Dimension::Share
            | Dimension::Change
            | Dimension::Level
            | Dimension::Number
            | Dimension::Count => value,
        }
    }

    /// The quantity of a kind whose dimensionless number is this: see [`Units::number`].
    pub fn quantity(&self, kind: &'static Kind, value: f64, method: Method) -> Quantity {
        Quantity::new(kind, self.number(kind.dimension, value), method)
    }

    /// The same with its error.
    pub fn quantity_with(
        &self,
        kind: &'static Kind,
        [value, error]: [f64; 2],
        method: Method,
    ) -> Quantity {
        self.quantity(kind, value, method).with_error(self.number(kind.dimension, error))
    }

    /// The unit of [`Scales::clearance`] and [`Scales::length`]: "m", or "1" for a
    /// reduced design's own.
    pub fn length_unit(&self) -> &'static str {
        Dimension::Length.symbol(self.physical)
    }

    /// The same of an oscillator on which an impact of unit relative speed has a pulse with this largest acceleration.
    #[must_use]
    pub const fn with_pulse(self, pulse: Option<f64>) -> Self {
        Self { pulse, ..self }
    }

    /// That acceleration over the speed, in 1/s; none where impacts take no time.
    pub const fn pulse(&self) -> Option<f64> {
        self.pulse
    }

    /// The inclination in rad of a cavity along which gravity accelerates by so much over `b omega0^2`; none where that is
    /// more than gravity.
    pub fn inclination(&self, along: f64) -> Option<f64> {
        let sine = self.acceleration(along) / STANDARD_GRAVITY;
        (sine.abs() <= 1.0).then(|| libm::asin(sine))
    }

    /// The coefficient of friction in a cavity by the accelerations of gravity along it and of friction, over
    /// `b omega0^2`; none where gravity does not press on it.
    pub fn friction(&self, accelerations: [f64; 2]) -> Option<f64> {
        let [sine, friction] = accelerations.map(|one| self.acceleration(one) / STANDARD_GRAVITY);
        let coefficient = friction / ((1.0 - sine) * (1.0 + sine)).sqrt();
        coefficient.is_finite().then_some(coefficient)
    }
}

/// Whose they are, and what pages are in.
impl Units {
    /// Those of a page of quantities, with a clearance in metres, of an oscillator of 1 kg and 1 rad/s.
    pub const fn physical(clearance_m: f64) -> Self {
        let scales = Scales { physical: true, clearance: clearance_m, ..Scales::REDUCED };
        Self { scales, us: false, in_g: false, told_in: None, pulse: None }
    }

    /// Those of a reduced design whose clearance is 1.
    pub const fn reduced() -> Self {
        Self { scales: Scales::REDUCED, us: false, in_g: false, told_in: None, pulse: None }
    }

    /// The same with pages in inches and pounds; documents stay in SI, and a reduced design in its own units.
    #[must_use]
    pub const fn in_us(self) -> Self {
        Self { us: true, ..self }
    }

    /// The same with accelerations on pages in g.
    #[must_use]
    pub const fn in_g(self) -> Self {
        Self { in_g: true, ..self }
    }

    /// The same with numbers of a dimension in the unit of this one.
    #[must_use]
    pub fn told_like(self, dimension: Dimension, value: f64) -> Self {
        Self { told_in: Some((dimension, self.unit(dimension, value))), ..self }
    }

    /// What documents call them: SI, or a reduced design's.
    pub fn name(&self) -> &'static str {
        if self.physical { "si" } else { "reduced" }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// By hand: m1 = 2 kg, omega0 = 3 rad/s, b = 5 m.
    #[test]
    fn each_dimension_has_its_unit() {
        let own = Scales { oscillator_mass: 2.0, natural_frequency: 3.0, ..*Units::physical(5.0) };
        let own = Units::from(own);
        for (dimension, one) in [
            (Dimension::Length, 5.0),
            (Dimension::Time, 1.0 / 3.0),
            (Dimension::Frequency, 3.0 / TAU),
            (Dimension::FrequencyRate, 9.0 / TAU),
            (Dimension::Velocity, 15.0),
            (Dimension::Acceleration, 45.0),
            (Dimension::Mass, 2.0),
            (Dimension::Stiffness, 18.0),
            (Dimension::Damping, 6.0),
            (Dimension::Force, 90.0),
            (Dimension::Energy, 450.0),
            (Dimension::Power, 1350.0),
            (Dimension::Impulse, 30.0),
            (Dimension::Share, 1.0),
        ] {
            let found = own.number(dimension, 1.0);
            assert!((found / one - 1.0).abs() < 1e-15, "{dimension:?} {found}");
            assert_eq!(Units::reduced().number(dimension, 0.7), 0.7, "{dimension:?}");
        }
    }
}
