//! What an axis of a sweep can vary.

use super::super::physical::PhysicalExcitation;
use super::super::quantity::{
    Damping, Dimension, Force, Frequency, Length, Mass, Stiffness, Velocity,
};
use super::super::reader::Bound;
use super::super::reduced::Tuning;
use super::super::{Design, LengthUnit};

/// A number of a case, or of a start, that an axis varies; every other number of the case stays.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SweepParameter {
    /// `b`.
    Clearance,
    /// `f` in Hz, or `Omega` of a reduced design.
    Frequency,
    /// `sigma` of a reduced design.
    Detuning,
    /// `F` in m or `P` in N, or `G` of a reduced design.
    Amplitude,
    /// `r`.
    Restitution,
    /// `m2` in kg.
    AbsorberMass,
    /// `m2/m1`.
    MassRatio,
    /// `m1` in kg.
    Mass,
    /// `k1` in N/m.
    Stiffness,
    /// `c1` in N s/m, or `lambda` of a reduced design.
    Damping,
    /// `c1/(2 sqrt(k1 m1))`.
    DampingRatio,
    /// `x` at the start.
    InitialDisplacement,
    /// `x'` at the start.
    InitialVelocity,
    /// `y` at the start.
    InitialAbsorberDisplacement,
    /// `y'` at the start.
    InitialAbsorberVelocity,
}

/// How values of a parameter are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Written {
    Number,
    Length,
    Mass,
    Frequency,
    Stiffness,
    Damping,
    Force,
    Velocity,
}

/// How values are written, and what they may be.
#[derive(Debug, Clone, Copy)]
pub(super) struct Form {
    pub written: Written,
    pub bound: Bound,
    /// A value as a person might write it.
    pub example: &'static str,
}

impl Written {
    /// The unit that values are held in.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Number => "1",
            Self::Length => Length::SI,
            Self::Mass => Mass::SI,
            Self::Frequency => Frequency::SI,
            Self::Stiffness => Stiffness::SI,
            Self::Damping => Damping::SI,
            Self::Force => Force::SI,
            Self::Velocity => Velocity::SI,
        }
    }
}

impl SweepParameter {
    /// All of them.
    pub const ALL: [Self; 15] = [
        Self::Clearance,
        Self::Frequency,
        Self::Detuning,
        Self::Amplitude,
        Self::Restitution,
        Self::AbsorberMass,
        Self::MassRatio,
        Self::Mass,
        Self::Stiffness,
        Self::Damping,
        Self::DampingRatio,
        Self::InitialDisplacement,
        Self::InitialVelocity,
        Self::InitialAbsorberDisplacement,
        Self::InitialAbsorberVelocity,
    ];

    /// Its key in a case, and its column in results.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Clearance => "clearance",
            Self::Frequency => "frequency",
            Self::Detuning => "detuning",
            Self::Amplitude => "amplitude",
            Self::Restitution => "restitution",
            Self::AbsorberMass => "absorber_mass",
            Self::MassRatio => "mass_ratio",
            Self::Mass => "mass",
            Self::Stiffness => "stiffness",
            Self::Damping => "damping",
            Self::DampingRatio => "damping_ratio",
            Self::InitialDisplacement => "initial_displacement",
            Self::InitialVelocity => "initial_velocity",
            Self::InitialAbsorberDisplacement => "initial_absorber_displacement",
            Self::InitialAbsorberVelocity => "initial_absorber_velocity",
        }
    }

    /// Its name and symbol in a text about a design.
    pub fn words(self, design: &Design) -> [&'static str; 2] {
        let excitation = match design {
            Design::Physical(physical) => Some(physical.excitation),
            Design::Reduced(_) => None,
        };
        match self {
            Self::Clearance => ["clearance", "b"],
            Self::Frequency if excitation.is_none() => ["frequency ratio", "Ω"],
            Self::Frequency => ["frequency", "f"],
            Self::Detuning => ["detuning", "σ"],
            Self::Amplitude => match excitation {
                Some(PhysicalExcitation::BaseDisplacement { .. }) => ["base displacement", "F"],
                Some(PhysicalExcitation::Force { .. }) => ["force", "P"],
                None => ["reduced forcing", "G"],
            },
            Self::Restitution => ["restitution", "r"],
            Self::AbsorberMass => ["absorber mass", "m₂"],
            Self::MassRatio => ["mass ratio", "ε"],
            Self::Mass => ["oscillator mass", "m₁"],
            Self::Stiffness => ["stiffness", "k₁"],
            Self::Damping if excitation.is_none() => ["damping", "λ"],
            Self::Damping => ["damping", "c₁"],
            Self::DampingRatio => ["damping ratio", "ζ"],
            Self::InitialDisplacement => ["initial displacement", "x"],
            Self::InitialVelocity => ["initial velocity", "ẋ"],
            Self::InitialAbsorberDisplacement => ["initial displacement of the absorber", "y"],
            Self::InitialAbsorberVelocity => ["initial velocity of the absorber", "ẏ"],
        }
    }

    /// Its symbol in LaTeX.
    pub(super) const fn symbol(self) -> &'static str {
        match self {
            Self::Clearance => "b",
            Self::Frequency => "f",
            Self::Detuning => r"\sigma",
            Self::Amplitude => "F",
            Self::Restitution => "r",
            Self::AbsorberMass => "m_2",
            Self::MassRatio => r"\varepsilon",
            Self::Mass => "m_1",
            Self::Stiffness => "k_1",
            Self::Damping => "c_1",
            Self::DampingRatio => r"\zeta_1",
            Self::InitialDisplacement => "x_0",
            Self::InitialVelocity => r"\dot{x}_0",
            Self::InitialAbsorberDisplacement => "y_0",
            Self::InitialAbsorberVelocity => r"\dot{y}_0",
        }
    }

    /// Whether it is a part of the start, not of the design.
    pub fn is_initial(self) -> bool {
        matches!(
            self,
            Self::InitialDisplacement
                | Self::InitialVelocity
                | Self::InitialAbsorberDisplacement
                | Self::InitialAbsorberVelocity
        )
    }

    /// Whether it is a ratio to other numbers of a design, so that these have to be known first.
    pub fn is_ratio(self) -> bool {
        matches!(self, Self::MassRatio | Self::DampingRatio)
    }

    /// Whether its values are lengths beside a design: in metres, or in a reduced design's own unit.
    pub fn is_length(self, design: &Design) -> bool {
        match self {
            Self::Clearance | Self::InitialDisplacement | Self::InitialAbsorberDisplacement => true,
            Self::Amplitude => self.unit(design) != Force::SI,
            _ => false,
        }
    }

    /// Another parameter that says the same of a design.
    pub(super) fn rival(self) -> Option<Self> {
        match self {
            Self::AbsorberMass => Some(Self::MassRatio),
            Self::Damping => Some(Self::DampingRatio),
            Self::Frequency => Some(Self::Detuning),
            _ => None,
        }
    }

    /// How its values are written beside a design; `None` where the design has no such number.
    pub(super) fn form(self, design: &Design) -> Option<Form> {
        let form = |written, bound, example| Some(Form { written, bound, example });
        let number = |bound, example| form(Written::Number, bound, example);
        let physical = match design {
            Design::Physical(physical) => physical,
            Design::Reduced(_) => {
                return match self {
                    Self::Clearance => number(Bound::Positive, "1.0"),
                    Self::Frequency => number(Bound::Positive, "0.97"),
                    Self::Detuning => number(Bound::Any, "-5.0"),
                    Self::Amplitude => number(Bound::NotNegative, "4.3"),
                    Self::Restitution => number(Bound::UpToOne, "0.6"),
                    Self::MassRatio => number(Bound::Positive, "0.0077"),
                    Self::Damping => number(Bound::NotNegative, "1.8"),
                    Self::AbsorberMass | Self::Mass | Self::Stiffness | Self::DampingRatio => None,
                    _ => number(Bound::Any, "0.5"),
                };
            }
        };
        match self {
            Self::Clearance => form(Written::Length, Bound::Positive, "\"7.5 mm\""),
            Self::Frequency => form(Written::Frequency, Bound::Positive, "\"8 Hz\""),
            Self::Detuning => None,
            Self::Amplitude => match physical.excitation {
                PhysicalExcitation::BaseDisplacement { .. } => {
                    form(Written::Length, Bound::NotNegative, "\"0.25 mm\"")
                }
                PhysicalExcitation::Force { .. } => {
                    form(Written::Force, Bound::NotNegative, "\"2.9 N\"")
                }
            },
            Self::Restitution => number(Bound::UpToOne, "0.6"),
            Self::AbsorberMass => form(Written::Mass, Bound::Positive, "\"32 g\""),
            Self::MassRatio => number(Bound::Positive, "0.0077"),
            Self::Mass => form(Written::Mass, Bound::Positive, "\"4.168 kg\""),
            Self::Stiffness => form(Written::Stiffness, Bound::Positive, "\"11.47 kN/m\""),
            Self::Damping => form(Written::Damping, Bound::NotNegative, "\"3.02 N s/m\""),
            Self::DampingRatio => number(Bound::NotNegative, "0.0069"),
            Self::InitialDisplacement | Self::InitialAbsorberDisplacement => {
                form(Written::Length, Bound::Any, "\"5 mm\"")
            }
            Self::InitialVelocity | Self::InitialAbsorberVelocity => {
                form(Written::Velocity, Bound::Any, "\"0.2 m/s\"")
            }
        }
    }

    /// The unit of its values beside a design: an SI unit, or "1".
    pub fn unit(self, design: &Design) -> &'static str {
        match self.form(design) {
            // Lengths of a reduced design are in a unit of its own.
            Some(form) => form.written.unit(),
            None => LengthUnit::Own.symbol(),
        }
    }

    /// Its value in a design; `None` for a part of the start, or what the design has not.
    pub fn of(self, design: &Design) -> Option<f64> {
        match design {
            Design::Physical(p) => Some(match self {
                Self::Clearance => p.clearance_m,
                Self::Frequency => p.frequency_hz,
                Self::Amplitude => match p.excitation {
                    PhysicalExcitation::BaseDisplacement { amplitude_m } => amplitude_m,
                    PhysicalExcitation::Force { amplitude_n } => amplitude_n,
                },
                Self::Restitution => p.restitution,
                Self::AbsorberMass => p.absorber_mass_kg,
                Self::MassRatio => p.absorber_mass_kg / p.mass_kg,
                Self::Mass => p.mass_kg,
                Self::Stiffness => p.stiffness_n_per_m,
                Self::Damping => p.damping_n_s_per_m,
                Self::DampingRatio => p.damping_n_s_per_m / p.critical_damping_n_s_per_m(),
                _ => return None,
            }),
            Design::Reduced(r) => Some(match self {
                Self::Clearance => r.clearance,
                Self::Frequency => match r.tuning {
                    Tuning::FrequencyRatio(ratio) => ratio,
                    Tuning::Detuning(detuning) => libm::fma(r.mass_ratio, detuning, 1.0),
                },
                Self::Detuning => match r.tuning {
                    Tuning::FrequencyRatio(ratio) => (ratio - 1.0) / r.mass_ratio,
                    Tuning::Detuning(detuning) => detuning,
                },
                Self::Amplitude => r.forcing,
                Self::Restitution => r.restitution,
                Self::MassRatio => r.mass_ratio,
                Self::Damping => r.damping,
                _ => return None,
            }),
        }
    }

    /// The design with another value; unchanged by what is a part of the start, or what it has not. A
    /// mass, stiffness or damping changes alone: the others keep their numbers, not their ratios.
    #[must_use]
    pub fn applied(self, design: &Design, value: f64) -> Design {
        let mut changed = *design;
        match &mut changed {
            Design::Physical(p) => match self {
                Self::Clearance => p.clearance_m = value,
                Self::Frequency => p.frequency_hz = value,
                Self::Amplitude => {
                    p.excitation = match p.excitation {
                        PhysicalExcitation::BaseDisplacement { .. } => {
                            PhysicalExcitation::BaseDisplacement { amplitude_m: value }
                        }
                        PhysicalExcitation::Force { .. } => {
                            PhysicalExcitation::Force { amplitude_n: value }
                        }
                    }
                }
                Self::Restitution => p.restitution = value,
                Self::AbsorberMass => p.absorber_mass_kg = value,
                Self::MassRatio => p.absorber_mass_kg = value * p.mass_kg,
                Self::Mass => p.mass_kg = value,
                Self::Stiffness => p.stiffness_n_per_m = value,
                Self::Damping => p.damping_n_s_per_m = value,
                Self::DampingRatio => p.damping_n_s_per_m = value * p.critical_damping_n_s_per_m(),
                _ => {}
            },
            Design::Reduced(r) => match self {
                Self::Clearance => r.clearance = value,
                Self::Frequency => r.tuning = Tuning::FrequencyRatio(value),
                Self::Detuning => r.tuning = Tuning::Detuning(value),
                Self::Amplitude => r.forcing = value,
                Self::Restitution => r.restitution = value,
                Self::MassRatio => r.mass_ratio = value,
                Self::Damping => r.damping = value,
                _ => {}
            },
        }
        changed
    }
}
