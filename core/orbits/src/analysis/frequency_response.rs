//! Frequency response of the 1:1 motion as explicit curves (Fig. 7), without continuation.
//!
//! At a given amplitude `beta` the condition for a fixed point is a quadratic in `sigma`: each
//! amplitude is reached at two detunings or at none.

use serde::Serialize;

use super::ManifoldPoint;
use super::manifold::{Manifold, ManifoldBranch};
use crate::equations::fixed_points::{DETUNING_0, DETUNING_1, DETUNING_2, UNTUNED};
use crate::numerics::polynomial::quadratic_roots;
use crate::system::System;

/// A point of the response curve.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ResponsePoint {
    /// `sigma`.
    pub detuning: f64,
    /// `B/b`.
    #[serde(rename = "B")]
    pub absorber_amplitude: f64,
    /// `C/b`.
    #[serde(rename = "C")]
    pub oscillator_amplitude: f64,
    /// Where on the manifold.
    pub branch: ManifoldBranch,
}

/// The two sides of the response curve, by ascending amplitude: where the quadratic has no real
/// root the sides are interrupted, which cuts them into pieces.
pub fn response(
    system: &System,
    manifold: &Manifold,
    largest: f64,
) -> [Vec<Vec<ResponsePoint>>; 2] {
    let mut sides = [vec![Vec::new()], vec![Vec::new()]];
    for shift in amplitudes(manifold, largest) {
        let point = manifold.point(shift);
        let roots = detunings(system, manifold, shift);
        for (index, side) in sides.iter_mut().enumerate() {
            let response = roots.get(index).map(|&detuning| ResponsePoint {
                detuning,
                absorber_amplitude: point.absorber_amplitude,
                oscillator_amplitude: point.oscillator_amplitude,
                branch: manifold.branch(shift),
            });
            match (response, side.last_mut()) {
                (Some(response), Some(last)) => last.push(response),
                (None, Some(last)) if !last.is_empty() => side.push(Vec::new()),
                _ => {}
            }
        }
    }
    sides.map(|side| side.into_iter().filter(|piece| piece.len() > 1).collect())
}

/// The detunings, ascending, at which `B = b (1 + shift)` is a fixed point: two, or none where the
/// forcing does not reach that amplitude.
pub fn detunings(system: &System, manifold: &Manifold, shift: f64) -> Vec<f64> {
    let ManifoldPoint { absorber_amplitude: ratio, oscillator_amplitude: oscillator } =
        manifold.point(shift);
    let (lambda, gamma) = (system.damping(), system.forcing_per_clearance());
    let untuned = UNTUNED.at([lambda, manifold.restitution_ratio, ratio]);
    quadratic_roots([
        DETUNING_0.at([lambda, gamma, shift, untuned]),
        DETUNING_1.at([ratio, shift]),
        DETUNING_2.at([oscillator * oscillator]),
    ])
}

/// Values of `B/b - 1` from almost -1 to `largest - 1`, with the ends of the branches among them.
fn amplitudes(manifold: &Manifold, largest: f64) -> Vec<f64> {
    const COUNT: i32 = 1200;
    let mut shifts: Vec<f64> =
        (1..=COUNT).map(|k| largest * f64::from(k) / f64::from(COUNT) - 1.0).collect();
    shifts.push(manifold.fold_shift);
    shifts.push(manifold.symmetry_breaking.absorber_amplitude - 1.0);
    shifts.sort_by(f64::total_cmp);
    shifts
}
