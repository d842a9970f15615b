//! Exact rational numbers: the coefficients of every expression.
//!
//! Validity: numerator and denominator stay within 128 bits. The expressions are constants of the
//! program, so leaving that range is a mistake in the program and stops it with a message.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg};

/// `numerator / denominator` in lowest terms, the denominator positive.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Rational {
    numerator: i128,
    denominator: i128,
}

impl Rational {
    /// 0.
    pub const ZERO: Self = Self { numerator: 0, denominator: 1 };
    /// 1.
    pub const ONE: Self = Self { numerator: 1, denominator: 1 };
    /// -1.
    pub const MINUS_ONE: Self = Self { numerator: -1, denominator: 1 };

    /// Brings the fraction to lowest terms.
    ///
    /// # Panics
    /// If the denominator is 0.
    pub fn new(numerator: i128, denominator: i128) -> Self {
        if denominator == 1 {
            return Self { numerator, denominator };
        }
        assert!(denominator != 0, "a rational number needs a denominator other than 0");
        let divisor = greatest_common_divisor(numerator, denominator) * denominator.signum();
        if divisor == 1 {
            return Self { numerator, denominator };
        }
        Self { numerator: numerator / divisor, denominator: denominator / divisor }
    }

    /// The numerator, which carries the sign.
    pub fn numerator(self) -> i128 {
        self.numerator
    }

    /// The denominator, at least 1.
    pub fn denominator(self) -> i128 {
        self.denominator
    }

    /// Whether this is 0.
    pub fn is_zero(self) -> bool {
        self.numerator == 0
    }

    /// Whether this is below 0.
    pub fn is_negative(self) -> bool {
        self.numerator < 0
    }

    /// `1 / self`.
    ///
    /// # Panics
    /// If `self` is 0.
    pub fn reciprocal(self) -> Self {
        Self::new(self.denominator, self.numerator)
    }

    /// `self` to an integer power, negative ones included.
    ///
    /// # Panics
    /// On overflow, and for a negative power of 0.
    pub fn power(self, exponent: i32) -> Self {
        let base = if exponent < 0 { self.reciprocal() } else { self };
        (0..exponent.unsigned_abs()).fold(Self::ONE, |product, _| product * base)
    }

    /// The largest rational that divides both with integer quotients; not negative.
    pub fn common_content(self, other: Self) -> Self {
        let numerator = greatest_common_divisor(self.numerator, other.numerator);
        let shared = greatest_common_divisor(self.denominator, other.denominator);
        Self::new(numerator, times(self.denominator / shared, other.denominator))
    }

    /// The absolute value.
    pub fn abs(self) -> Self {
        Self { numerator: self.numerator.abs(), ..self }
    }
}

impl From<i32> for Rational {
    fn from(value: i32) -> Self {
        Self { numerator: value.into(), denominator: 1 }
    }
}

impl Add for Rational {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        if self.is_zero() {
            return other;
        }
        let left = times(self.numerator, other.denominator);
        let right = times(other.numerator, self.denominator);
        let numerator = left.checked_add(right).unwrap_or_else(|| overflow("sum"));
        Self::new(numerator, times(self.denominator, other.denominator))
    }
}

impl Mul for Rational {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let numerator = times(self.numerator, other.numerator);
        Self::new(numerator, times(self.denominator, other.denominator))
    }
}

impl Neg for Rational {
    type Output = Self;

    fn neg(self) -> Self {
        Self { numerator: -self.numerator, ..self }
    }
}

impl Ord for Rational {
    fn cmp(&self, other: &Self) -> Ordering {
        times(self.numerator, other.denominator).cmp(&times(other.numerator, self.denominator))
    }
}

impl PartialOrd for Rational {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

fn times(left: i128, right: i128) -> i128 {
    left.checked_mul(right).unwrap_or_else(|| overflow("product"))
}

fn overflow(what: &str) -> i128 {
    panic!("an exact {what} of coefficients left the range of 128 bit integers")
}

fn greatest_common_divisor(left: i128, right: i128) -> i128 {
    let (mut larger, mut smaller) = (left.abs(), right.abs());
    while smaller != 0 {
        // Division of 64 bit numbers is several times as fast, and nearly always enough.
        let remainder = match (u64::try_from(larger), u64::try_from(smaller)) {
            (Ok(larger), Ok(smaller)) => i128::from(larger % smaller),
            _ => larger % smaller,
        };
        (larger, smaller) = (smaller, remainder);
    }
    larger
}
