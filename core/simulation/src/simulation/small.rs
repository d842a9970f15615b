//! Sines, cosines and exponentials of small arguments, by series exact to rounding.

use fearless_simd::Simd;

use crate::numerics::lanes::{Mask, Real};

/// Largest angle by which either phasor of a flight turns in a panel; the series end accordingly.
pub(super) const LARGEST_ANGLE: f64 = 0.8;

/// `c[0] + x (c[1] + x (...))`.
#[inline(always)]
fn series<R: Real, const N: usize>(x: R, coefficients: [f64; N]) -> R {
    let mut sum = x.like(coefficients[N - 1]);
    for k in (0..N - 1).rev() {
        sum = sum * x + coefficients[k];
    }
    sum
}

/// `1/k!` with the signs of a cosine's or sine's series, from `k = first` in steps of two; `sign` is `-1`, or `1` for the
/// hyperbolic functions.
const fn every_second(first: usize, sign: f64) -> [f64; 9] {
    let mut coefficients = [1.0; 9];
    let mut k = 1;
    while k < 9 {
        let place = (2 * k + first) as f64;
        coefficients[k] = sign * coefficients[k - 1] / (place * (place - 1.0));
        k += 1;
    }
    coefficients
}

/// The same with alternating signs.
const fn alternating(first: usize) -> [f64; 9] {
    every_second(first, -1.0)
}

/// Sine and cosine of two angles of at most [`LARGEST_ANGLE`], to rounding: the first terms left out are
/// below `0.8^18/18! = 3e-18`.
#[inline(always)]
pub(super) fn small_angles<R: Real, S: Simd>(simd: S, [a, b]: [R; 2]) -> [(R, R); 2] {
    const SERIES: [[f64; 4]; 9] = {
        let (sine, cosine) = (alternating(1), alternating(0));
        let mut series = [[0.0; 4]; 9];
        let mut k = 0;
        while k < 9 {
            series[k] = [sine[k], cosine[k], sine[k], cosine[k]];
            k += 1;
        }
        series
    };
    let (a_squared, b_squared) = (a * a, b * b);
    let squared = [a_squared, a_squared, b_squared, b_squared];
    let [a_sin, a_cos, b_sin, b_cos] = R::polynomials(simd, squared, &SERIES);
    [(a * a_sin, a_cos), (b * b_sin, b_cos)]
}

/// Sine and cosine of one such angle.
#[inline(always)]
pub(super) fn small_angle(a: f64) -> (f64, f64) {
    const SINE: [f64; 9] = alternating(1);
    const COSINE: [f64; 9] = alternating(0);
    let squared = a * a;
    (a * series(squared, SINE), series(squared, COSINE))
}

/// `e^x` for `-0.78 < x <= 0`: an oscillator that rings decays no more in a panel.
#[inline(always)]
pub(super) fn small_exponential<R: Real>(x: R) -> R {
    const INVERSE_FACTORIALS: [f64; 18] = {
        let mut coefficients = [1.0; 18];
        let mut k = 1;
        while k < 18 {
            coefficients[k] = coefficients[k - 1] / k as f64;
            k += 1;
        }
        coefficients
    };
    let [c0, c1, c2, c3, c4, c5, c6, c7, ..] = INVERSE_FACTORIALS;
    // 0.02^8/8! is 6e-19, and 0.78^18/18! is 2e-18.
    let short = series(x, [c0, c1, c2, c3, c4, c5, c6, c7]);
    let far = x.less(x.like(-0.02));
    if far.any() {
        return R::choose(far, series(x, INVERSE_FACTORIALS), short);
    }
    short
}

/// Largest angle that [`angles`] reduces: its multiple of a quarter turn times the first part below is exact.
#[cfg(test)]
const LARGEST_REDUCED: f64 = 100.0;

/// Sine and cosine of two angles of up to some hundred, to rounding.
#[inline(always)]
pub(super) fn angles<R: Real, S: Simd>(simd: S, [a, b]: [R; 2]) -> [(R, R); 2] {
    let ((a_quarters, a), (b_quarters, b)) = (to_an_eighth(a), to_an_eighth(b));
    let [a, b] = small_angles(simd, [a, b]);
    [turned(a, a_quarters), turned(b, b_quarters)]
}

/// `e^{x + i angle}` of an angle of up to some hundred and `-8 LARGEST_ANGLE < x <= 0`, to rounding.
#[inline(always)]
pub(super) fn spiral<R: Real, S: Simd>(simd: S, x: R, angle: R) -> [R; 2] {
    const SERIES: [[f64; 4]; 9] = {
        let circular = [alternating(1), alternating(0)];
        let hyperbolic = [every_second(1, 1.0), every_second(0, 1.0)];
        let mut series = [[0.0; 4]; 9];
        let mut k = 0;
        while k < 9 {
            series[k] = [circular[0][k], circular[1][k], hyperbolic[0][k], hyperbolic[1][k]];
            k += 1;
        }
        series
    };
    let (quarters, reduced) = to_an_eighth(angle);
    // The power of a part.
    let far = x.less(x.like(-LARGEST_ANGLE));
    let part = R::choose(far, x * 0.125, x);
    let (squared, small) = (reduced * reduced, part * part);
    let [sin, cos, sinh, cosh] = R::polynomials(simd, [squared, squared, small, small], &SERIES);
    let mut envelope = cosh + part * sinh;
    if far.any() {
        let mut power = envelope;
        for _ in 0..3 {
            power = power * power;
        }
        envelope = R::choose(far, power, envelope);
    }
    let (sin, cos) = turned((reduced * sin, cos), quarters);
    [envelope * cos, envelope * sin]
}

/// The nearest number of quarter turns, and what is left of an angle: a quarter turn in three parts, of 33 bits each but
/// the last.
#[inline(always)]
fn to_an_eighth<R: Real>(angle: R) -> (R, R) {
    const QUARTER: [f64; 3] =
        [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_7e-21];
    let [first, second, third] = QUARTER;
    let quarters = nearest_integer(angle * std::f64::consts::FRAC_2_PI);
    (quarters, angle - quarters * first - quarters * second - quarters * third)
}

/// Sine and cosine so many quarter turns further.
#[inline(always)]
fn turned<R: Real>((sin, cos): (R, R), quarters: R) -> (R, R) {
    // -2 to 2.
    let left = quarters - nearest_integer(quarters * 0.25) * 4.0;
    let (half, three) = (left.like(0.5), left.like(1.5));
    let odd = half.less(left.abs()) & left.abs().less(three);
    let (s, c) = (R::choose(odd, cos, sin), R::choose(odd, sin, cos));
    let sine_negative = left.less(-half) | three.less(left);
    let cosine_negative = half.less(left) | left.less(-three);
    (R::choose(sine_negative, -s, s), R::choose(cosine_negative, -c, c))
}

/// Nearest integer of a number below `2^51`, ties to even: the digits behind the point are rounded off.
#[inline(always)]
fn nearest_integer<R: Real>(x: R) -> R {
    const SHIFT: f64 = 6_755_399_441_055_744.0;
    (x + SHIFT) - SHIFT
}

/// `e^x - 1` for `x <= 0`, to rounding: by its series, or squared from where that reaches.
#[inline(always)]
pub(super) fn exponential_minus_one<R: Real>(x: R) -> R {
    const SERIES: [f64; 17] = {
        let mut coefficients = [1.0; 17];
        let mut k = 1;
        while k < 17 {
            coefficients[k] = coefficients[k - 1] / (k + 1) as f64;
            k += 1;
        }
        coefficients
    };
    let (mut reduced, mut halvings) = (x, 0);
    // Beyond 2^10 all is lost.
    while reduced.less(x.like(-0.78)).any() && halvings < 10 {
        (reduced, halvings) = (reduced * 0.5, halvings + 1);
    }
    let mut lost = reduced.larger(x.like(-0.78)) * series(reduced.larger(x.like(-0.78)), SERIES);
    for _ in 0..halvings {
        lost = lost * (lost + 2.0);
    }
    lost
}

#[cfg(test)]
mod tests {
    use fearless_simd::{Level, dispatch};

    use super::*;

    #[test]
    fn small_series_are_exact_to_rounding() {
        for k in 0..=400 {
            let part = f64::from(k) / 400.0;
            let angle = LARGEST_ANGLE * part;
            let [(sin, cos), other] =
                dispatch!(Level::baseline(), simd => small_angles(simd, [angle, -angle]));
            assert_eq!(other, (-sin, cos));
            assert!((sin - libm::sin(angle)).abs() <= 2.0 * f64::EPSILON * angle);
            assert!((cos - libm::cos(angle)).abs() <= f64::EPSILON);
            let decay = -0.78 * part;
            assert!((small_exponential(decay) - libm::exp(decay)).abs() <= f64::EPSILON);
        }
    }

    #[test]
    fn angles_and_exponentials_are_exact_to_rounding() {
        for k in -4000..=4000 {
            let angle = LARGEST_REDUCED * f64::from(k) / 4000.0;
            let near = f64::from(k) * std::f64::consts::FRAC_PI_4;
            let both = dispatch!(Level::baseline(), simd => angles(simd, [angle, near * 0.03]));
            for ((sin, cos), angle) in both.into_iter().zip([angle, near * 0.03]) {
                assert!((sin - libm::sin(angle)).abs() <= f64::EPSILON, "{angle}");
                assert!((cos - libm::cos(angle)).abs() <= f64::EPSILON, "{angle}");
            }
            let decay = (f64::from(k) - 4000.0) * 7.5e-4;
            let found = dispatch!(Level::baseline(), simd => spiral(simd, decay, angle));
            let scale = libm::exp(decay);
            // Of the hyperbolic functions' sum a third may be left, and the eighth power of a part multiplies its error.
            let off = if decay < -LARGEST_ANGLE { 24.0 } else { 3.0 } * f64::EPSILON;
            for (found, of) in found.into_iter().zip([libm::cos(angle), libm::sin(angle)]) {
                assert!((found - scale * of).abs() <= off * scale, "{decay} {angle}");
            }
            let fall = -1e-9 * libm::exp(f64::from(k + 4000) / 8000.0 * 24.5);
            let (found, wanted) = (exponential_minus_one(fall), libm::expm1(fall));
            // Each squaring doubles the relative error of what is left.
            assert!((found - wanted).abs() <= 8.0 * f64::EPSILON * wanted.abs(), "{fall}");
        }
    }
}
