//! The arithmetic of one number or of several side by side.
//!
//! A formula written over [`Real`] gives the same bits in either: every operation used here is
//! correctly rounded and nothing is fused, so that a batch of trajectories is the same trajectories.
//! The lanes are [`fearless_simd`]'s; which instructions they become is chosen at run time.

use std::ops::{Add, BitAnd, BitOr, Div, Index, IndexMut, Mul, Neg, Not, Sub};

use fearless_simd::{Simd, f64x4, f64x8, mask64x8, prelude::*};

/// Numbers that a formula is evaluated for at once.
pub trait Real:
    Copy
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
{
    /// A truth value for each number.
    type Mask: Mask;
    /// `number` for each of them.
    fn like(self, number: f64) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Where `self < other`.
    fn less(self, other: Self) -> Self::Mask;
    /// Where `self <= other`.
    fn at_most(self, other: Self) -> Self::Mask;
    /// `yes` where `mask`, else `no`.
    fn choose(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// Four polynomials in `x`, by four coefficients for each power, lowest power first.
    fn polynomials<S: Simd, const N: usize>(
        simd: S,
        x: [Self; 4],
        coefficients: &[[f64; 4]; N],
    ) -> [Self; 4];
    /// The larger of two; `other` where `self` is not a number.
    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        Self::choose(other.less(self), self, other)
    }
    /// The smaller of two; `other` where `self` is not a number.
    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        Self::choose(self.less(other), self, other)
    }
}

/// Truth values, one for each number of a [`Real`].
pub trait Mask: Copy + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self> {
    /// Whether one of them holds.
    fn any(self) -> bool;
    /// Whether all of them hold.
    fn all(self) -> bool;
}

impl Real for f64 {
    type Mask = bool;
    #[inline(always)]
    fn like(self, number: f64) -> Self {
        number
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self::abs(self)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::sqrt(self)
    }
    #[inline(always)]
    fn less(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn at_most(self, other: Self) -> bool {
        self <= other
    }
    #[inline(always)]
    fn choose(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn polynomials<S: Simd, const N: usize>(
        simd: S,
        x: [Self; 4],
        coefficients: &[[f64; 4]; N],
    ) -> [Self; 4] {
        let x = f64x4::simd_from(simd, x);
        let mut sum = f64x4::simd_from(simd, coefficients[N - 1]);
        for k in (0..N - 1).rev() {
            sum = sum * x + f64x4::simd_from(simd, coefficients[k]);
        }
        sum.into()
    }
}

impl Mask for bool {
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
    #[inline(always)]
    fn all(self) -> bool {
        self
    }
}

/// Numbers in a vector.
const WIDTH: usize = 8;
/// Vectors in a [`Wide`]: the second works while the first waits. The vectors of WebAssembly are so short that one of ours is
/// four of them, and code that is half as long is loaded sooner.
const VECTORS: usize = if cfg!(target_arch = "wasm32") { 1 } else { 2 };
/// Numbers side by side in a [`Wide`].
pub const LANES: usize = WIDTH * VECTORS;

/// [`LANES`] numbers.
#[derive(Debug, Clone, Copy)]
pub struct Wide<S: Simd>([f64x8<S>; VECTORS]);

/// [`LANES`] truth values.
#[derive(Debug, Clone, Copy)]
pub struct WideMask<S: Simd>([mask64x8<S>; VECTORS]);

impl<S: Simd> Wide<S> {
    /// `number` in every lane.
    #[inline(always)]
    pub fn splat(simd: S, number: f64) -> Self {
        Self([f64x8::splat(simd, number); VECTORS])
    }

    /// Those of an array.
    #[inline(always)]
    pub fn load(simd: S, numbers: &[f64; LANES]) -> Self {
        let mut all = Self::splat(simd, 0.0);
        for k in 0..VECTORS {
            all.0[k] = f64x8::from_slice(simd, &numbers[WIDTH * k..WIDTH * (k + 1)]);
        }
        all
    }

    /// Into an array.
    #[inline(always)]
    pub fn store(self, numbers: &mut [f64; LANES]) {
        for k in 0..VECTORS {
            self.0[k].store_slice(&mut numbers[WIDTH * k..WIDTH * (k + 1)]);
        }
    }

    /// Where the number is neither infinite nor not a number.
    #[inline(always)]
    pub fn is_finite(self) -> WideMask<S> {
        self.abs().at_most(self.like(f64::MAX))
    }
}

impl<S: Simd> WideMask<S> {
    /// The lowest bit is lane 0.
    #[inline(always)]
    pub fn from_bits(simd: S, bits: u64) -> Self {
        let mut mask = Self([mask64x8::splat(simd, false); VECTORS]);
        for k in 0..VECTORS {
            mask.0[k] = mask64x8::from_bitmask(simd, bits >> (WIDTH * k) & 0xff);
        }
        mask
    }

    /// Lane 0 is the lowest bit.
    #[inline(always)]
    pub fn bits(self) -> u64 {
        let mut bits = 0;
        for k in 0..VECTORS {
            bits |= self.0[k].to_bitmask() << (WIDTH * k);
        }
        bits
    }
}

impl<S: Simd> Index<usize> for Wide<S> {
    type Output = f64;
    #[inline(always)]
    fn index(&self, lane: usize) -> &f64 {
        &self.0[lane / WIDTH][lane % WIDTH]
    }
}

impl<S: Simd> IndexMut<usize> for Wide<S> {
    #[inline(always)]
    fn index_mut(&mut self, lane: usize) -> &mut f64 {
        &mut self.0[lane / WIDTH][lane % WIDTH]
    }
}

/// `$of`, a [`Wide`] or [`WideMask`], with every vector `k` replaced: a loop, because a closure would not be
/// compiled for the vector instructions.
macro_rules! each_vector {
    ($of:ident, $k:ident => $vector:expr) => {{
        for $k in 0..VECTORS {
            $of.0[$k] = $vector;
        }
        $of
    }};
}

macro_rules! binary_operators {
    ($($type:ident $trait:ident<$other:ty> $method:ident: $k:ident, $right:ident => $operand:expr;)*) => {$(
        impl<S: Simd> $trait<$other> for $type<S> {
            type Output = Self;
            #[inline(always)]
            fn $method(mut self, $right: $other) -> Self {
                each_vector!(self, $k => self.0[$k].$method($operand))
            }
        }
    )*};
}
binary_operators! {
    Wide Add<Self> add: k, other => other.0[k];
    Wide Sub<Self> sub: k, other => other.0[k];
    Wide Mul<Self> mul: k, other => other.0[k];
    Wide Div<Self> div: k, other => other.0[k];
    Wide Add<f64> add: k, other => other;
    Wide Sub<f64> sub: k, other => other;
    Wide Mul<f64> mul: k, other => other;
    WideMask BitAnd<Self> bitand: k, other => other.0[k];
    WideMask BitOr<Self> bitor: k, other => other.0[k];
}

impl<S: Simd> Neg for Wide<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(mut self) -> Self {
        each_vector!(self, k => -self.0[k])
    }
}

impl<S: Simd> Not for WideMask<S> {
    type Output = Self;
    #[inline(always)]
    fn not(mut self) -> Self {
        each_vector!(self, k => !self.0[k])
    }
}

impl<S: Simd> Real for Wide<S> {
    type Mask = WideMask<S>;
    #[inline(always)]
    fn like(self, number: f64) -> Self {
        Self::splat(self.0[0].simd, number)
    }
    #[inline(always)]
    fn abs(mut self) -> Self {
        each_vector!(self, k => self.0[k].simd.abs_f64x8(self.0[k]))
    }
    #[inline(always)]
    fn sqrt(mut self) -> Self {
        each_vector!(self, k => self.0[k].simd.sqrt_f64x8(self.0[k]))
    }
    #[inline(always)]
    fn less(self, other: Self) -> Self::Mask {
        let mut mask = WideMask([self.0[0].simd_lt(other.0[0]); VECTORS]);
        each_vector!(mask, k => self.0[k].simd_lt(other.0[k]))
    }
    #[inline(always)]
    fn at_most(self, other: Self) -> Self::Mask {
        let mut mask = WideMask([self.0[0].simd_le(other.0[0]); VECTORS]);
        each_vector!(mask, k => self.0[k].simd_le(other.0[k]))
    }
    #[inline(always)]
    fn choose(mask: Self::Mask, mut yes: Self, no: Self) -> Self {
        each_vector!(yes, k => mask.0[k].select(yes.0[k], no.0[k]))
    }
    #[inline(always)]
    fn polynomials<T: Simd, const N: usize>(
        _simd: T,
        mut x: [Self; 4],
        coefficients: &[[f64; 4]; N],
    ) -> [Self; 4] {
        for (j, x) in x.iter_mut().enumerate() {
            let mut sum = x.like(coefficients[N - 1][j]);
            for k in (0..N - 1).rev() {
                sum = sum * *x + coefficients[k][j];
            }
            *x = sum;
        }
        x
    }
}

impl<S: Simd> Mask for WideMask<S> {
    #[inline(always)]
    fn any(self) -> bool {
        self.bits() != 0
    }
    #[inline(always)]
    fn all(self) -> bool {
        !(!self).any()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fearless_simd::{Level, dispatch};

    fn formula<R: Real>(x: R, y: R) -> R {
        let ratio = (x * 3.0 - y) / (y.abs() + 1.0);
        R::choose(ratio.less(x), ratio.abs().sqrt(), x.larger(y)).smaller(x.like(7.0))
    }

    #[inline(always)]
    fn together<S: Simd>(simd: S, pairs: &[[f64; 2]; LANES]) -> [f64; LANES] {
        let (mut x, mut y) = (Wide::splat(simd, 0.0), Wide::splat(simd, 0.0));
        for (lane, pair) in pairs.iter().enumerate() {
            [x[lane], y[lane]] = *pair;
        }
        let results = formula(x, y);
        std::array::from_fn(|lane| results[lane])
    }

    #[test]
    fn lanes_give_the_bits_of_numbers_alone() {
        let x = [0.1, -2.0, 3.7, 1e300, -1e-300, f64::NAN, 0.3, 12.5];
        let y = [0.7, 1.0 / 3.0, f64::NAN, 2.0, 5.0, 1.0, -0.0, f64::INFINITY];
        let pairs =
            std::array::from_fn(|k| if k < 8 { [x[k], y[k]] } else { [y[k - 8], x[k - 8]] });
        for level in [Level::new(), Level::baseline()] {
            let lanes = dispatch!(level, simd => together(simd, &pairs));
            for ([x, y], lane) in pairs.into_iter().zip(lanes) {
                let alone = formula(x, y);
                assert!(lane.to_bits() == alone.to_bits() || alone.is_nan(), "{x} {y}");
            }
        }
    }

    #[test]
    fn bits_and_masks_are_the_same_lanes() {
        #[inline(always)]
        fn back<S: Simd>(simd: S, bits: u64) -> u64 {
            (!WideMask::from_bits(simd, !bits & 0xffff)).bits()
        }
        for bits in [0, 1, 0x80, 0x100, 0x8001, 0xffff, 0x1234] {
            assert_eq!(dispatch!(Level::new(), simd => back(simd, bits)), bits);
        }
    }
}
