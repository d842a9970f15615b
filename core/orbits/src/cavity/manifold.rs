//! All motions of a cavity with two impacts per cycle on which a quantity has a given value.
//!
//! The manifold is `d_c(nu) c_c = n_c(nu)`. `d_c` has one zero `nu_0`: 0 for equal ends, and without tilt `n_c` has it
//! too, so that `nu = nu_0` with any `c_c` belongs to the manifold. Else the motions near to it, which
//! are the almost symmetric ones, are at `c_c` in proportion to `1/(nu - nu_0)`: places are even in the logarithm of that
//! distance.
//!
//! No motion has `C > 47 b`. One of the flights takes at least `pi`; in it the third difference of `w` over steps of
//! `pi/4` is at most 8, that of the parabola `y` is 0, and that of `x` is `8 C sin(pi/8)^3 cos(psi)`, where the middle
//! `psi` can be chosen from a range of `pi/4`, so that `abs(cos(psi)) >= sin(pi/8)`: `C <= 1/sin(pi/8)^4 = 46.6`.

use std::f64::consts::FRAC_PI_2;

use super::CavityTheory;
use super::motion::CavityMotion;
use super::shape::MotionShape;
use crate::equations::cavity::IN_PHASE;
use crate::numerics::bracket::bisected;
use crate::numerics::scan::sign_changes;

/// An amplitude beyond which there is no motion; see the head of this file.
const LARGEST: f64 = 47.0;
/// Distance from `pi/2` up to which `nu` is looked at: `c_c` there is above 300 for every pair of ends, unless tilt or
/// friction are as large.
const MARGIN: f64 = 1e-3;
/// Distance from symmetry breaking from which the asymmetric motions are looked at: its square is rounding.
const SMALLEST: f64 = 1e-8;
/// Places on a stretch with `nu = nu_0`, and least on another one.
const PLACES: u32 = 512;
/// Places on another stretch, in a factor e of the distance from `nu_0`.
const DENSITY: f64 = 24.0;
/// Rounding of `n_c`, over its terms.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// A stretch of the manifold, by a parameter from 0 to 1.
enum ManifoldStretch {
    /// `nu = nu_0`.
    Line(f64),
    /// `nu_0`, and the signed distances from it at both ends.
    Side(f64, [f64; 2]),
}

impl ManifoldStretch {
    /// `nu` and `c_c`.
    fn place(&self, cavity: &CavityTheory, part: f64) -> [f64; 2] {
        match *self {
            Self::Line(nu) => [nu, (LARGEST + 1.0) * part - 1.0 / libm::cos(nu)],
            Self::Side(zero, [from, to]) => {
                let nu = zero + from * libm::exp(part * libm::log(to / from));
                [nu, IN_PHASE.at(cavity.equation(nu))]
            }
        }
    }

    fn places(&self) -> u32 {
        match *self {
            Self::Line(_) => PLACES,
            Self::Side(_, [from, to]) => PLACES.max((DENSITY * libm::log(to / from)) as u32),
        }
    }
}

impl CavityTheory {
    /// All motions at an amplitude `C/b` of the oscillator, by ascending absorber amplitude, inadmissible ones included.
    pub fn motions_at(&self, oscillator: f64) -> Vec<CavityMotion> {
        self.motions_where(|shape| shape.amplitude - oscillator)
    }

    /// All motions at which the amplitude of the oscillator is smallest or largest along the manifold, by ascending absorber
    /// amplitude, inadmissible ones included: folds, at which a multiplier of the impact pair is 1 and two motions begin
    /// or end; in a symmetric cavity symmetry breaking as well.
    pub fn folds(&self) -> Vec<CavityMotion> {
        self.motions_where(|shape| self.direction(shape).amplitude)
    }

    /// All motions at which `f` changes its sign, by ascending absorber amplitude.
    pub(super) fn motions_where(&self, f: impl Fn(&MotionShape) -> f64) -> Vec<CavityMotion> {
        let mut found = Vec::new();
        for stretch in self.stretches() {
            let shape = |part: f64| {
                let [nu, in_phase] = stretch.place(self, part);
                self.shape(nu, in_phase)
            };
            let roots = sign_changes([0.0, 1.0], stretch.places(), |part| f(&shape(part)));
            let motions = roots.into_iter().map(shape).filter(MotionShape::is_motion);
            found.extend(motions.map(|shape| self.complete(&shape)));
        }
        found.sort_by(|a, b| a.absorber_amplitude.total_cmp(&b.absorber_amplitude));
        found
    }

    fn stretches(&self) -> Vec<ManifoldStretch> {
        let end = FRAC_PI_2 - MARGIN;
        // `d_c` over the cosine grows with `nu`, from below 0 to above.
        let factor = |nu: f64| self.equation(nu)[1];
        let zero = if self.ratios[1] == 0.0 { Some(0.0) } else { bisected([-end, end], factor) };
        let Some(zero) = zero else { return Vec::new() };
        let [side, _] = self.equation(zero);
        let terms = 4.0 * zero.abs() + 5.0 * (self.acceleration.abs() + self.friction) + 4.0;
        let slope = (factor(zero + MARGIN) - factor(zero - MARGIN)) / (2.0 * MARGIN);
        let symmetric = side.abs() <= ROUNDING * terms && (side == 0.0 || self.ratios[1] != 0.0);
        // At this distance `c_c` is four times the largest.
        let nearest = if symmetric { SMALLEST } else { 0.25 * side.abs() / (slope * LARGEST) };
        let nearest = nearest.max(f64::MIN_POSITIVE);
        let sides = [-1.0, 1.0].into_iter().filter_map(|sign| {
            let range = [sign * nearest, sign * end - zero];
            (range[1] / range[0] > 1.0).then_some(ManifoldStretch::Side(zero, range))
        });
        symmetric.then_some(ManifoldStretch::Line(zero)).into_iter().chain(sides).collect()
    }
}
