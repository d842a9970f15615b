//! From dimensionless results to quantities in SI, or in the units of a reduced case.

use serde_json::{Value, json};

use crate::case::{BandOver, Case, Design, Orientation};
use crate::method::Method;
use crate::quantity::catalogue as of;
use crate::quantity::{Kind, Quantity, Units};
use crate::system::Parameter;

/// Relative error of the place of a minimum, where the slope vanishes, and of multipliers where two of them
/// meet: the root of that of rounding.
pub(super) const ROOT_OF_ROUNDING: f64 = 1e-6;

/// A number with the error of a minimum or a multiplier.
pub(super) fn rounded(of: Quantity) -> Quantity {
    of.with_error(ROOT_OF_ROUNDING * of.value.abs())
}

/// What a case says of its cavity; nothing of one that is level, without friction, its ends alike.
pub fn cavity(case: &Case) -> Vec<Quantity> {
    let (design, system) = (&case.design, case.system());
    if system.cavity().is_ideal() {
        return Vec::new();
    }
    let given = |kind, value| Quantity::new(kind, value, Method::Given);
    let of_cavity = [
        Parameter::Inclination,
        Parameter::Friction,
        Parameter::GravityAlong,
        Parameter::FrictionAcceleration,
    ];
    let values = of_cavity.into_iter().filter_map(|one| Some((one, design.value(one)?)));
    let mut all: Vec<Quantity> =
        values.map(|(one, value)| given(design.kind(one), value)).collect();
    let ends = [&of::RESTITUTION_PLUS, &of::RESTITUTION_MINUS];
    all.extend(ends.into_iter().zip(system.restitutions()).map(|(kind, value)| given(kind, value)));
    all
}

/// How the cavity lies and what carries the absorber, where the case says so.
pub fn support(case: &Case) -> Option<Value> {
    let Design::Physical(physical) = &case.design else { return None };
    let support = physical.support?;
    let given = |kind, value| Quantity::new(kind, value, Method::Given);
    let found = |kind, value: Option<f64>| {
        value.map(|value| Quantity::new(kind, value, Method::ClosedForm))
    };
    Some(json!({
        "orientation": physical.orientation().map(Orientation::name),
        "inclination": given(&of::INCLINATION, physical.inclination_rad),
        "support": support.kind.name(),
        "frequency": support.frequency_hz.map(|one| given(&of::SUPPORT_FREQUENCY, one)),
        // Of a pendulum its length, of a spring what the absorber's weight stretches it by.
        "length": found(&of::SUPPORT_LENGTH, physical.support_length_m()),
        "left_out": found(&of::SUPPORT_LEFT_OUT, case.support_left_out()),
    }))
}

/// Makes the quantities of one case.
#[derive(Debug, Clone, Copy)]
pub struct Scale {
    /// The units of the case and its pages.
    pub units: Units,
    /// What an excitation frequency is: in Hz, or over the natural one for a reduced case.
    frequency: &'static Kind,
    /// The case's excitation, and its amplitude in SI.
    excitation: (&'static Kind, f64),
    /// Whether the absorber is carried, so that no tilt and no friction acts on it.
    carried: bool,
}

impl Scale {
    /// That of a case.
    pub fn of(case: &Case) -> Self {
        let design = &case.design;
        let amplitude = design.value(Parameter::Amplitude).unwrap_or_default();
        let excitation = (design.kind(Parameter::Amplitude), amplitude);
        let carried = design.support().is_some_and(|support| support.carries());
        Self {
            units: case.units(),
            frequency: design.kind(Parameter::Frequency),
            excitation,
            carried,
        }
    }

    /// The unit of a quantity: of SI, or empty for a pure number and in a reduced case.
    pub fn unit(&self, of: &Quantity) -> &'static str {
        of.kind.dimension.symbol(self.units.physical)
    }

    /// An excitation frequency, of its ratio to the natural one.
    pub fn frequency(&self, ratio: f64, method: Method) -> Quantity {
        self.units.quantity(self.frequency, ratio, method)
    }

    /// The frequency of a tuned mass damper, by its tuning.
    pub fn damper_frequency(&self, tuning: f64) -> Quantity {
        let found = self.frequency(tuning, Method::ClosedForm);
        let kind = match self.units.physical {
            true => &of::DAMPER_FREQUENCY,
            false => &of::DAMPER_FREQUENCY_RATIO,
        };
        Quantity { kind, ..found }
    }

    /// An excitation amplitude over the case's.
    pub fn amplitude(&self, over_own: f64, method: Method) -> Quantity {
        Quantity::new(self.excitation.0, over_own * self.excitation.1, method)
    }

    /// The tilt of a cavity, or gravity along it for a reduced case; none where that is more than gravity, or acts on
    /// no absorber.
    pub fn tilt(&self, acceleration: f64, method: Method) -> Option<Quantity> {
        if self.carried {
            return None;
        }
        let (kind, value) = match self.units.physical {
            false => (&of::GRAVITY_ALONG, acceleration),
            true => (&of::INCLINATION, self.units.inclination(acceleration)?),
        };
        Some(Quantity::new(kind, value, method))
    }

    /// The coefficient of friction of a cavity with such accelerations by gravity and friction, or the latter for a reduced
    /// case; none where it acts on no absorber.
    pub fn friction(&self, accelerations: [f64; 2], method: Method) -> Option<Quantity> {
        if self.carried {
            return None;
        }
        let (kind, value) = match self.units.physical {
            false => (&of::FRICTION_ACCELERATION, accelerations[1]),
            true => (&of::FRICTION, self.units.friction(accelerations)?),
        };
        Some(Quantity::new(kind, value, method))
    }

    /// A place of a band.
    pub fn place(&self, over: BandOver, at: f64) -> Quantity {
        match over {
            BandOver::Frequency => self.frequency(at, Method::Given),
            BandOver::Amplitude => self.amplitude(at, Method::Given),
        }
    }
}
