//! Units with their prefixes: what a page shows a dimension in, and what a case may be written in.

use std::f64::consts::{PI, TAU};

use super::catalogue::Dimension;
use crate::system::STANDARD_GRAVITY;

/// A unit with a prefix.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// Its symbol; empty for a pure number. A space stands for a product.
    pub symbol: &'static str,
    /// Its size in the unit without prefix.
    pub size: f64,
    /// The size as a power of ten, with which a number is read without a second rounding,
    pub exponent: i32,
    /// times this quotient: `[254, 10000]` for an inch.
    pub quotient: [f64; 2],
}

pub(super) const fn unit(symbol: &'static str, exponent: i32) -> Unit {
    // Exact, and so is the rounding of the one quotient.
    let (mut power, mut k) = (1.0, 0);
    while k < exponent.abs() {
        power *= 10.0;
        k += 1;
    }
    let size = if exponent < 0 { 1.0 / power } else { power };
    Unit { symbol, size, exponent, quotient: [1.0, 1.0] }
}

/// One that is no power of ten. Of whole numbers a value of few digits is rounded once.
const fn quotient(symbol: &'static str, times: f64, over: f64) -> Unit {
    Unit { symbol, size: times / over, exponent: 0, quotient: [times, over] }
}

const RADIANS_PER_SECOND: Unit = quotient("rad/s", 1.0, TAU);
/// An inch is 25.4 mm, a pound 0.453 592 37 kg, and a pound of force that times standard gravity, 4.448 221 615 260 5 N, by
/// the yard and pound agreement of 1959.
const INCH: [f64; 2] = [254.0, 1e4];
const POUND: [f64; 2] = [45_359_237.0, 1e8];
const POUND_OF_FORCE: [f64; 2] = [44_482_216_152_605.0, 1e13];
/// A pound of force over an inch, and times one.
const PER_INCH: [f64; 2] = [POUND_OF_FORCE[0], 254e9];
/// Squared standard gravity.
const GRAVITY_SQUARED: [f64; 2] = [980_665.0 * 980_665.0, 1e10];
/// `9.80665 m/s²`.
pub(crate) const GRAVITY: Unit = quotient("g", STANDARD_GRAVITY, 1.0);
const DEGREE: Unit = quotient("deg", PI, 180.0);

impl Dimension {
    /// Its units in SI, from the largest to the smallest.
    pub(super) fn units(self) -> &'static [Unit] {
        match self {
            Self::Length => {
                const { &[unit("km", 3), unit("m", 0), unit("mm", -3), unit("µm", -6), unit("nm", -9)] }
            }
            Self::Time => const { &[unit("s", 0), unit("ms", -3), unit("µs", -6)] },
            Self::Frequency => const { &[unit("kHz", 3), unit("Hz", 0), unit("mHz", -3)] },
            Self::FrequencyRate => const { &[unit("Hz/s", 0), unit("mHz/s", -3)] },
            Self::OctaveRate => const { &[unit("oct/min", 0)] },
            Self::Velocity => {
                const { &[unit("km/s", 3), unit("m/s", 0), unit("mm/s", -3), unit("µm/s", -6)] }
            }
            Self::Acceleration => const { &[unit("m/s²", 0), unit("mm/s²", -3)] },
            Self::Mass => const { &[unit("t", 3), unit("kg", 0), unit("g", -3), unit("mg", -6)] },
            Self::Stiffness => const { &[unit("MN/m", 6), unit("kN/m", 3), unit("N/m", 0)] },
            Self::Damping => const { &[unit("kN s/m", 3), unit("N s/m", 0), unit("mN s/m", -3)] },
            Self::Force => const { &[unit("MN", 6), unit("kN", 3), unit("N", 0), unit("mN", -3)] },
            Self::Energy => {
                const { &[unit("kJ", 3), unit("J", 0), unit("mJ", -3), unit("µJ", -6), unit("nJ", -9)] }
            }
            Self::Power => const { &[unit("kW", 3), unit("W", 0), unit("mW", -3), unit("µW", -6)] },
            Self::Impulse => const { &[unit("kN s", 3), unit("N s", 0), unit("mN s", -3)] },
            Self::AccelerationDensity => const { &[unit("(m/s²)²/Hz", 0)] },
            Self::Angle => const { &[unit("rad", 0)] },
            Self::Inclination => const { &[DEGREE] },
            Self::Share | Self::Change => const { &[unit("%", -2)] },
            Self::Level => const { &[unit("dB", 0)] },
            Self::Number | Self::Count => const { &[unit("", 0)] },
        }
    }

    /// The same for a page in inches and pounds; what has no such unit is in that of SI.
    pub(super) fn us_units(self) -> &'static [Unit] {
        const INCH_POUND: f64 = POUND_OF_FORCE[0] * 0.0254;
        match self {
            Self::Length => const { &[quotient("in", INCH[0], INCH[1])] },
            Self::Velocity => const { &[quotient("in/s", INCH[0], INCH[1])] },
            Self::Acceleration => const { &[GRAVITY] },
            Self::Mass => {
                const { &[quotient("lb", POUND[0], POUND[1]), quotient("oz", POUND[0], 16.0 * POUND[1])] }
            }
            Self::Stiffness => const { &[quotient("lbf/in", PER_INCH[0], PER_INCH[1])] },
            Self::Damping => const { &[quotient("lbf s/in", PER_INCH[0], PER_INCH[1])] },
            Self::Force => const { &[quotient("lbf", POUND_OF_FORCE[0], POUND_OF_FORCE[1])] },
            Self::Impulse => const { &[quotient("lbf s", POUND_OF_FORCE[0], POUND_OF_FORCE[1])] },
            Self::Energy => const { &[quotient("in lbf", INCH_POUND, 1e13)] },
            Self::Power => const { &[quotient("in lbf/s", INCH_POUND, 1e13)] },
            _ => self.units(),
        }
    }

    /// Units that a case may be written in beside those of a page.
    fn further_units(self) -> &'static [Unit] {
        match self {
            Self::Length => {
                const {
                    &[
                        unit("cm", -2),
                        quotient("in", INCH[0], INCH[1]),
                        // A thousandth of an inch.
                        quotient("mil", INCH[0], 1e3 * INCH[1]),
                        quotient("thou", INCH[0], 1e3 * INCH[1]),
                    ]
                }
            }
            Self::Mass => {
                const {
                    &[
                        unit("ug", -9),
                        quotient("lb", POUND[0], POUND[1]),
                        quotient("oz", POUND[0], 16.0 * POUND[1]),
                    ]
                }
            }
            Self::Frequency => {
                const {
                    &[
                        unit("MHz", 6),
                        RADIANS_PER_SECOND,
                        quotient("rpm", 1.0, 60.0),
                        quotient("cpm", 1.0, 60.0),
                    ]
                }
            }
            Self::FrequencyRate => const { &[quotient("Hz/min", 1.0, 60.0)] },
            Self::OctaveRate => const { &[quotient("oct/s", 60.0, 1.0)] },
            Self::Velocity => const { &[unit("cm/s", -2), quotient("in/s", INCH[0], INCH[1])] },
            Self::Stiffness => {
                const {
                    &[
                        unit("mN/m", -3),
                        unit("N/mm", 3),
                        unit("kN/mm", 6),
                        unit("N/cm", 2),
                        unit("N/um", 6),
                        quotient("lbf/in", PER_INCH[0], PER_INCH[1]),
                    ]
                }
            }
            Self::Damping => {
                const {
                    &[
                        unit("Ns/m", 0),
                        unit("kNs/m", 3),
                        unit("mNs/m", -3),
                        unit("N s/mm", 3),
                        unit("Ns/mm", 3),
                        unit("kg/s", 0),
                        unit("g/s", -3),
                        quotient("lbf s/in", PER_INCH[0], PER_INCH[1]),
                    ]
                }
            }
            Self::Force => {
                const {
                    &[
                        unit("uN", -6),
                        unit("nN", -9),
                        quotient("lbf", POUND_OF_FORCE[0], POUND_OF_FORCE[1]),
                    ]
                }
            }
            Self::Acceleration => {
                const {
                    &[
                        unit("m/s^2", 0),
                        unit("m/s2", 0),
                        unit("mm/s^2", -3),
                        unit("mm/s2", -3),
                        unit("cm/s²", -2),
                        unit("cm/s^2", -2),
                        unit("cm/s2", -2),
                        GRAVITY,
                        quotient("in/s²", INCH[0], INCH[1]),
                        quotient("in/s2", INCH[0], INCH[1]),
                    ]
                }
            }
            Self::Impulse => {
                const {
                    &[
                        unit("Ns", 0),
                        unit("kNs", 3),
                        quotient("lbf s", POUND_OF_FORCE[0], POUND_OF_FORCE[1]),
                    ]
                }
            }
            Self::AccelerationDensity => {
                const {
                    &[
                        unit("(m/s2)2/Hz", 0),
                        unit("m²/s³", 0),
                        unit("m2/s3", 0),
                        quotient("g²/Hz", GRAVITY_SQUARED[0], GRAVITY_SQUARED[1]),
                        quotient("g2/Hz", GRAVITY_SQUARED[0], GRAVITY_SQUARED[1]),
                        quotient("g^2/Hz", GRAVITY_SQUARED[0], GRAVITY_SQUARED[1]),
                    ]
                }
            }
            Self::Inclination => {
                const { &[Unit { symbol: "°", ..DEGREE }, unit("rad", 0), unit("mrad", -3)] }
            }
            _ => &[],
        }
    }

    /// Every unit that it is read in.
    pub fn accepted_units(self) -> impl Iterator<Item = &'static Unit> {
        self.units().iter().chain(self.further_units())
    }

    /// The symbol of its unit without prefix: that of SI, or `1` for a pure number and for a case in reduced
    /// units.
    pub fn symbol(self, physical: bool) -> &'static str {
        let pure = matches!(self, Self::Share | Self::Change | Self::Number | Self::Count);
        let own = !physical && self.own_unit().is_some();
        let plain = self.accepted_units().find(|one| one.size == 1.0);
        plain.filter(|_| !pure && !own).map_or("1", |unit| unit.symbol)
    }

    /// Its unit for a case in reduced units, where the oscillator has m1 = k1 = 1 and lengths are in the unit
    /// of the case's own clearance.
    pub(super) fn own_unit(self) -> Option<Unit> {
        match self {
            Self::Length => Some(unit("units", 0)),
            Self::Time => Some(unit("/ω₀", 0)),
            // A frequency is a ratio to the natural one.
            Self::Frequency => Some(unit("f₀", 0)),
            Self::FrequencyRate => Some(unit("f₀ω₀", 0)),
            Self::Velocity => Some(unit("ω₀ units", 0)),
            Self::Acceleration => Some(unit("ω₀² units", 0)),
            Self::Energy => Some(unit("m₁ω₀² units²", 0)),
            Self::Power => Some(unit("m₁ω₀³ units²", 0)),
            Self::Impulse => Some(unit("m₁ω₀ units", 0)),
            Self::Mass => Some(unit("m₁", 0)),
            Self::Stiffness => Some(unit("k₁", 0)),
            Self::Force => Some(unit("k₁ units", 0)),
            Self::Damping => Some(unit("m₁ω₀", 0)),
            _ => None,
        }
    }
}
