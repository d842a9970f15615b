//! The slow invariant manifold (16), `C^2 = (1 + R) B^2 - 2 b B + b^2`, its branches, and whether
//! a point of it is a motion.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, TAU};

use serde::Serialize;

use crate::cavity::ManifoldPoint;
use crate::equations::manifold::{
    ABSORBER_PHASE, BREAKING_RATIO, BREAKING_SHIFT, FOLD_OSCILLATOR, FOLD_RATIO, FOLD_SHIFT,
    MANIFOLD_SQUARE, STABLE_RATIO, STABLE_ROOT,
};
use crate::equations::stated::{CURVATURE, RESTITUTION_RATIO};
use crate::numerics::bracket::bisected;
use crate::operation_count;

/// Rounding allowed to a motion that touches the wall between impacts.
pub(super) const CAVITY_ROUNDING: f64 = 1e-12;

/// A part of the manifold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ManifoldBranch {
    /// Below the fold: unstable.
    Left,
    /// Between fold and symmetry breaking: stable.
    Stable,
    /// Beyond symmetry breaking: two symmetric impacts are unstable, two asymmetric ones appear.
    Right,
}

impl ManifoldBranch {
    /// The name in a report.
    pub fn words(self) -> &'static str {
        match self {
            Self::Left => "left, unstable",
            Self::Stable => "stable",
            Self::Right => "right, unstable",
        }
    }
}

/// The manifold of a restitution coefficient.
///
/// ```
/// use std::f64::consts::PI;
/// use vinesink_core::analysis::{Manifold, ManifoldBranch};
///
/// let manifold = Manifold::of(0.6);
/// // rho = 0.4 / 1.6 = 1/4, R = 4 rho^2 / pi^2, and the fold is at B = b / (1 + R), C = b sqrt(R / (1 + R)).
/// let curvature = 0.25 / (PI * PI);
/// assert!((manifold.fold.absorber_amplitude - 1.0 / (1.0 + curvature)).abs() < 1e-15);
/// assert!((manifold.fold.oscillator_amplitude - (curvature / (1.0 + curvature)).sqrt()).abs() < 1e-15);
/// // At B = b equation (16) leaves C = b sqrt(R).
/// assert!((manifold.point(0.0).oscillator_amplitude - curvature.sqrt()).abs() < 1e-15);
/// assert_eq!(manifold.branch(0.0), ManifoldBranch::Stable);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Manifold {
    /// `r`.
    #[serde(skip)]
    pub restitution: f64,
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
        let restitution_ratio = RESTITUTION_RATIO.at([restitution]);
        let curvature = CURVATURE.at([restitution_ratio]);
        Self {
            restitution,
            restitution_ratio,
            curvature,
            fold: ManifoldPoint {
                absorber_amplitude: FOLD_RATIO.at([curvature]),
                oscillator_amplitude: FOLD_OSCILLATOR.at([curvature, 1.0]),
            },
            symmetry_breaking: ManifoldPoint {
                absorber_amplitude: BREAKING_RATIO.at([]),
                oscillator_amplitude: MANIFOLD_SQUARE.at([curvature, BREAKING_SHIFT.at([])]).sqrt(),
            },
            fold_shift: FOLD_SHIFT.at([curvature]),
        }
    }

    /// The point whose absorber amplitude is `b (1 + shift)`, by (16) in its shifted form.
    pub fn point(&self, shift: f64) -> ManifoldPoint {
        ManifoldPoint {
            absorber_amplitude: 1.0 + shift,
            oscillator_amplitude: MANIFOLD_SQUARE.at([self.curvature, shift]).sqrt(),
        }
    }

    /// `B/b`, over the clearance, on the stable branch, or beyond it, by `C/b`: the larger root of (16); `None` below the fold.
    pub fn stable_absorber(&self, oscillator: f64) -> Option<f64> {
        let root = STABLE_ROOT.at([self.curvature, oscillator * oscillator]);
        (root >= 0.0).then(|| STABLE_RATIO.at([self.curvature, root]))
    }

    /// The branch on which `B = b (1 + shift)` lies; the two ends of the stable branch belong to it.
    pub fn branch(&self, shift: f64) -> ManifoldBranch {
        if shift < self.fold_shift {
            ManifoldBranch::Left
        } else if 1.0 + shift <= self.symmetry_breaking.absorber_amplitude {
            ManifoldBranch::Stable
        } else {
            ManifoldBranch::Right
        }
    }

    /// The largest amplitude `C/b`, over the clearance, of the stable branch whose points are motions: that of symmetry
    /// breaking, except for almost plastic impacts, `r` below a few hundredths, after which the absorber would leave its
    /// cavity.
    pub fn largest_stable_motion(&self) -> f64 {
        let [from, to] = [self.fold, self.symmetry_breaking].map(|end| end.oscillator_amplitude);
        let beyond = |oscillator: f64| {
            let ratio = self.stable_absorber(oscillator).unwrap_or(self.fold.absorber_amplitude);
            let point =
                ManifoldPoint { absorber_amplitude: ratio, oscillator_amplitude: oscillator };
            let phase = self.absorber_phase(ratio, ratio - 1.0);
            Self::largest_relative_displacement(point, phase) - 1.0 - CAVITY_ROUNDING
        };
        bisected([from, to], beyond).unwrap_or(to)
    }

    /// `Theta`, the phase of the absorber against the oscillator, from (14) and (15), at `B = b
    /// ratio`; `shift` is `ratio - 1`, each being passed with its own accuracy.
    pub fn absorber_phase(&self, ratio: f64, shift: f64) -> f64 {
        ABSORBER_PHASE.at([self.restitution_ratio, ratio, shift])
    }

    /// Largest `abs(w0)` over the clearance between two impacts of the motion (12): above 1 the
    /// point is not a motion, because the absorber would have left its cavity.
    ///
    /// `theta` is the point's `Theta`. With `z` the sawtooth's phase, `w0 = C sin(z - Theta) + (2/pi) B z` from `z = -pi/2` to
    /// `pi/2`, with turning points where `cos(z - Theta) = -(2/pi) B / C`.
    pub fn largest_relative_displacement(point: ManifoldPoint, theta: f64) -> f64 {
        let ManifoldPoint { absorber_amplitude: absorber, oscillator_amplitude: oscillator } =
            point;
        let slope = FRAC_2_PI * absorber;
        if slope > oscillator {
            return 1.0;
        }
        operation_count::note(operation_count::ELEMENTARY + 15);
        let angle = libm::acos(-slope / oscillator);
        let swing = ((oscillator - slope) * (oscillator + slope)).sqrt();
        [(theta + angle, swing), (theta - angle, -swing), (theta + angle - TAU, swing)]
            .into_iter()
            .filter(|(z, _)| z.abs() < FRAC_PI_2)
            .map(|(z, swing)| (swing + slope * z).abs())
            .fold(1.0, f64::max)
    }
}
