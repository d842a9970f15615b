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

/// `1/k!` with the signs of a cosine's or sine's series, from `k = first` in steps of two.
const fn alternating(first: usize) -> [f64; 9] {
    let mut coefficients = [1.0; 9];
    let mut k = 1;
    while k < 9 {
        let place = (2 * k + first) as f64;
        coefficients[k] = -coefficients[k - 1] / (place * (place - 1.0));
        k += 1;
    }
    coefficients
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
}
