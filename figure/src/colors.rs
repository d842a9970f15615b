//! Colours of large areas: tints for kinds, ramps for values.
//!
//! A ramp is a curve in CIELAB, where equal distances look about equally different, passed through at
//! constant speed with lightness in proportion to the value. So no step looks larger than another,
//! and a print in grey, or an eye that tells fewer colours apart, still sees the order.

use std::f64::consts::PI;

/// A colour of an area: red, green and blue of sRGB, from 0 to 255.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tint(pub [u8; 3]);

impl Tint {
    /// Where nothing is known; no ramp and no tint of a regime is like it.
    pub const UNKNOWN: Self = Self([0x6A, 0x6A, 0x6A]);

    /// As an SVG attribute's value.
    #[must_use]
    pub fn hex(self) -> String {
        let [red, green, blue] = self.0;
        format!("#{red:02X}{green:02X}{blue:02X}")
    }

    /// The colour of CIELAB coordinates under the white of daylight (D65), cut to what a screen can show.
    #[must_use]
    pub fn of_lab([lightness, a, b]: [f64; 3]) -> Self {
        let [red, green, blue] = linear_of_lab([lightness, a, b]).map(|part| {
            let part = part.clamp(0.0, 1.0);
            let curved = if part <= 0.003_130_8 {
                12.92 * part
            } else {
                1.055 * libm::pow(part, 1.0 / 2.4) - 0.055
            };
            (255.0 * curved).round() as u8
        });
        Self([red, green, blue])
    }
}

/// Linear sRGB of CIELAB coordinates (IEC 61966-2-1 and CIE 15); outside 0 to 1 where no screen shows it.
fn linear_of_lab([lightness, a, b]: [f64; 3]) -> [f64; 3] {
    const WHITE: [f64; 3] = [0.950_47, 1.0, 1.088_83];
    const KNEE: f64 = 6.0 / 29.0;
    let y = (lightness + 16.0) / 116.0;
    let of = |part: f64| {
        if part > KNEE { part * part * part } else { 3.0 * KNEE * KNEE * (part - 4.0 / 29.0) }
    };
    let [x, y, z] = [WHITE[0] * of(y + a / 500.0), WHITE[1] * of(y), WHITE[2] * of(y - b / 200.0)];
    [
        3.240_454_2 * x - 1.537_138_5 * y - 0.498_531_4 * z,
        -0.969_266_0 * x + 1.876_010_8 * y + 0.041_556_0 * z,
        0.055_643_4 * x - 0.204_025_9 * y + 1.057_225_2 * z,
    ]
}

/// From values to colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ramp {
    /// From light yellow over green to dark blue: a helix of constant chroma.
    Sequential,
    /// Orange below 0, blue above it, nearly white at 0.
    Diverging,
}

impl Ramp {
    /// CIELAB coordinates of a value within a range.
    #[must_use]
    pub fn lab(self, value: f64, (low, high): (f64, f64)) -> [f64; 3] {
        let polar = |lightness: f64, chroma: f64, degrees: f64| {
            let (sin, cos) = libm::sincos(degrees * PI / 180.0);
            [lightness, chroma * cos, chroma * sin]
        };
        match self {
            Self::Sequential => {
                let part = ((value - low) / (high - low)).clamp(0.0, 1.0);
                polar(93.0 - 69.0 * part, 28.0, 100.0 + 190.0 * part)
            }
            Self::Diverging => {
                let part = (value / low.abs().max(high.abs())).clamp(-1.0, 1.0);
                let hue = if part < 0.0 { 52.0 } else { 282.0 };
                polar(97.0 - 55.0 * part.abs(), 50.0 * part.abs(), hue)
            }
        }
    }

    /// The colour of a value within a range; values beyond have the colour of the nearer end.
    #[must_use]
    pub fn tint(self, value: f64, range: (f64, f64)) -> Tint {
        Tint::of_lab(self.lab(value, range))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// No step of a ramp looks larger than another, none leaves what a screen can show, and lightness
    /// alone tells the order.
    #[test]
    fn ramps_are_even() {
        const STEPS: u32 = 200;
        for (ramp, range, first, last) in [
            (Ramp::Sequential, (3.0, 11.0), 3.0, 11.0),
            (Ramp::Diverging, (-2.0, 5.0), 0.0, 5.0),
            (Ramp::Diverging, (-5.0, 2.0), -5.0, 0.0),
        ] {
            let at = |k: u32| {
                let value = first + (last - first) * f64::from(k) / f64::from(STEPS);
                ramp.lab(value, range)
            };
            let distance = |a: [f64; 3], b: [f64; 3]| {
                libm::sqrt((0..3).map(|i| (a[i] - b[i]) * (a[i] - b[i])).sum())
            };
            let whole: f64 = (0..STEPS).map(|k| distance(at(k), at(k + 1))).sum();
            for k in 0..STEPS {
                let share = distance(at(k), at(k + 1)) / whole * f64::from(STEPS);
                // Constant speed but for rounding of the arithmetic.
                assert!((share - 1.0).abs() < 1e-9, "{ramp:?} {k}: {share}");
                let lightness = (at(k + 1)[0] - at(k)[0]).abs();
                let even = (at(STEPS)[0] - at(0)[0]).abs() / f64::from(STEPS);
                assert!((lightness - even).abs() < 1e-9, "{ramp:?} {k}: {lightness}");
                let shown = linear_of_lab(at(k));
                // A thousandth below black in linear light is less than one of 255 steps of sRGB there.
                let inside = shown.iter().all(|part| (-1e-3..=1.0 + 1e-3).contains(part));
                assert!(inside, "{ramp:?} {k}: {shown:?}");
            }
        }
        // White, and mid grey by the published conversion: L* 53.585 is sRGB 128.
        assert_eq!(Tint::of_lab([100.0, 0.0, 0.0]), Tint([255, 255, 255]));
        assert_eq!(Tint::of_lab([53.585, 0.0, 0.0]), Tint([128, 128, 128]));
        assert_eq!(Ramp::Diverging.lab(0.0, (-1.0, 4.0)), [97.0, 0.0, 0.0]);
    }
}
