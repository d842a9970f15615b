//! Real numbers of 256 bits, 77 decimal digits, with the operators that formulas are written in.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// Constants of elementary functions, for those who go on from here with closed forms.
pub use astro_float::Consts;
use astro_float::{BigFloat, RoundingMode};

/// Precision of every operation.
pub const BITS: usize = 256;
/// How each is rounded.
pub const ROUND: RoundingMode = RoundingMode::ToEven;

/// A number of 77 decimal digits.
#[derive(Clone, Debug)]
pub struct Decimal(pub BigFloat);

impl Decimal {
    /// The number that a floating-point number stands for, exactly.
    pub fn of(number: f64) -> Self {
        Self(BigFloat::from_f64(number, BITS))
    }

    /// Absolute value.
    pub fn abs(&self) -> Self {
        Self(self.0.abs())
    }

    /// Whether it is below 0.
    pub fn is_negative(&self) -> bool {
        self.0.is_negative() && !self.0.is_zero()
    }

    /// Whether it is above 0.
    pub fn is_positive(&self) -> bool {
        self.0.is_positive() && !self.0.is_zero()
    }

    /// Whether it is 0.
    pub fn is_zero(&self) -> bool {
        self.0.is_zero()
    }

    /// The power of two next above its absolute value; `None` for 0.
    pub fn exponent(&self) -> Option<i32> {
        if self.0.is_zero() { None } else { self.0.exponent() }
    }

    /// Whether it is below another.
    pub fn is_below(&self, other: &Self) -> bool {
        (self - other).is_negative()
    }

    /// The nearest floating-point number, to a unit in the last place; NaN where there is none.
    pub fn to_f64(&self) -> f64 {
        let Some((words, _, _, exponent, _)) = self.0.as_raw_parts() else { return f64::NAN };
        // The value is 0.mantissa times 2^exponent, the last word being the most significant.
        let weight = libm::scalbn(1.0, -(usize::BITS as i32));
        let mantissa = words.iter().fold(0.0, |sum, word| (sum + *word as f64) * weight);
        let size = libm::scalbn(mantissa, exponent);
        if self.0.is_negative() { -size } else { size }
    }
}

macro_rules! operator {
    ($name:ident, $method:ident) => {
        impl $name for &Decimal {
            type Output = Decimal;
            fn $method(self, other: &Decimal) -> Decimal {
                Decimal(self.0.$method(&other.0, BITS, ROUND))
            }
        }
    };
}
operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl Neg for &Decimal {
    type Output = Decimal;
    fn neg(self) -> Decimal {
        Decimal(BigFloat::neg(&self.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_survive_the_way_there_and_back() {
        for number in [0.0, 1.0, -1.0, 0.1, -3.7e-200, 8.9e300, 1.0 + f64::EPSILON] {
            assert_eq!(Decimal::of(number).to_f64(), number);
        }
        // A third is the nearest floating-point number to 1/3 and more.
        let third = &Decimal::of(1.0) / &Decimal::of(3.0);
        assert_eq!(third.to_f64(), 1.0 / 3.0);
        let rest = &(&third * &Decimal::of(3.0)) - &Decimal::of(1.0);
        assert!(rest.to_f64().abs() < 1e-76, "{}", rest.to_f64());
    }
}
