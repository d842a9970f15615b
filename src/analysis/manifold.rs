//! The slow invariant manifold (16), `C^2 = (1 + R) B^2 - 2 b B + b^2`, its branches, and whether
//! a point of it is a motion.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

use serde::Serialize;

use crate::equations::equations;
use crate::symbolic::{Symbol, Values};

/// Smallest `rho` that formulas are evaluated with: elastic impacts, `rho = 0`, are the limit of
/// inelastic ones, and several formulas are quotients of two quantities that vanish in it.
const SMALLEST_RATIO: f64 = 1e-100;

/// A part of the manifold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Branch {
    /// Below the fold: unstable.
    Left,
    /// Between fold and symmetry breaking: stable.
    Stable,
    /// Beyond symmetry breaking: two symmetric impacts are unstable, two asymmetric ones appear.
    Right,
}

impl Branch {
    /// The name in a report.
    pub fn words(self) -> &'static str {
        match self {
            Self::Left => "left, unstable",
            Self::Stable => "stable",
            Self::Right => "right, unstable",
        }
    }
}

/// A point of the manifold, over the clearance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ManifoldPoint {
    /// Amplitude of the absorber's sawtooth, `B/b`.
    #[serde(rename = "B")]
    pub absorber: f64,
    /// Amplitude of the oscillator, `C/b`.
    #[serde(rename = "C")]
    pub oscillator: f64,
}

/// The manifold of a restitution coefficient.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Manifold {
    /// `rho = (1 - r)/(1 + r)`.
    pub restitution_ratio: f64,
    /// `R = 4 rho^2/pi^2`.
    pub curvature: f64,
    /// Where the left branch meets the stable one.
    pub fold: ManifoldPoint,
    /// Where the stable branch meets the right one.
    pub symmetry_breaking: ManifoldPoint,
    /// `B/b - 1` at the fold, kept apart because `B/b` rounds to 1 as impacts become elastic.
    #[serde(skip)]
    pub fold_shift: f64,
}

impl Manifold {
    /// The manifold for restitution `r` in `0..=1`.
    pub fn of(restitution: f64) -> Self {
        let ratio = ((1.0 - restitution) / (1.0 + restitution)).max(SMALLEST_RATIO);
        let curvature = 4.0 * ratio * ratio / (std::f64::consts::PI * std::f64::consts::PI);
        let values = Values::new()
            .with(Symbol::RestitutionRatio, ratio)
            .with(Symbol::ManifoldCurvature, curvature);
        let [fold_shift, fold_square, breaking_shift, breaking_square] =
            equations().special_points(&values);
        Self {
            restitution_ratio: ratio,
            curvature,
            fold: ManifoldPoint { absorber: 1.0 + fold_shift, oscillator: fold_square.sqrt() },
            symmetry_breaking: ManifoldPoint {
                absorber: 1.0 + breaking_shift,
                oscillator: breaking_square.sqrt(),
            },
            fold_shift,
        }
    }

    /// The point whose absorber amplitude is `b (1 + shift)`.
    pub fn point(&self, shift: f64) -> ManifoldPoint {
        let values = Values::new()
            .with(Symbol::ManifoldCurvature, self.curvature)
            .with(Symbol::Shift, shift);
        ManifoldPoint { absorber: 1.0 + shift, oscillator: equations().square(&values).sqrt() }
    }

    /// The branch on which `B = b (1 + shift)` lies; the two ends of the stable branch belong to it.
    pub fn branch(&self, shift: f64) -> Branch {
        if shift < self.fold_shift {
            Branch::Left
        } else if 1.0 + shift <= self.symmetry_breaking.absorber {
            Branch::Stable
        } else {
            Branch::Right
        }
    }

    /// `Theta`, the phase of the absorber against the oscillator, from (14) and (15).
    pub fn absorber_phase(&self, shift: f64) -> f64 {
        libm::atan2(FRAC_2_PI * self.restitution_ratio * (1.0 + shift), -shift)
    }

    /// Largest `abs(w0)` over the clearance between two impacts of the motion (12): above 1 the
    /// point is not a motion, because the absorber would have left its cavity.
    ///
    /// With `z` the sawtooth's phase, `w0 = C sin(z - Theta) + (2/pi) B z` from `z = -pi/2` to
    /// `pi/2`, with turning points where `cos(z - Theta) = -(2/pi) B / C`.
    pub fn largest_relative_displacement(&self, shift: f64) -> f64 {
        let ManifoldPoint { absorber, oscillator } = self.point(shift);
        let theta = self.absorber_phase(shift);
        let displacement =
            |z: f64| (oscillator * libm::sin(z - theta) + FRAC_2_PI * absorber * z).abs();
        let cosine = -FRAC_2_PI * absorber / oscillator;
        if !(-1.0..=1.0).contains(&cosine) {
            return 1.0;
        }
        let angle = libm::acos(cosine);
        [theta + angle, theta - angle, theta + angle - std::f64::consts::TAU]
            .into_iter()
            .filter(|z| z.abs() < FRAC_PI_2)
            .map(displacement)
            .fold(1.0, f64::max)
    }
}
