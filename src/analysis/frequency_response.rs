//! Frequency response of the 1:1 motion as explicit curves (Fig. 7), without continuation.
//!
//! At a given amplitude `beta` the condition for a fixed point is a quadratic in `sigma`: each
//! amplitude is reached at two detunings or at none.

use serde::Serialize;

use super::boundaries::quadratic_roots;
use super::manifold::{Branch, Manifold};
use super::values_of;
use crate::equations::equations;
use crate::symbolic::Symbol;
use crate::system::System;

/// A point of the response curve.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ResponsePoint {
    /// `sigma`.
    pub detuning: f64,
    /// `B/b`.
    #[serde(rename = "B")]
    pub absorber: f64,
    /// `C/b`.
    #[serde(rename = "C")]
    pub oscillator: f64,
    /// Where on the manifold.
    pub branch: Branch,
}

/// The two sides of the response curve, by ascending amplitude: where the quadratic has no real
/// root the sides are interrupted, which cuts them into pieces.
pub fn response(system: &System, manifold: &Manifold, largest: f64) -> [Vec<Vec<ResponsePoint>>; 2] {
    let values = values_of(system, manifold);
    let mut sides = [vec![Vec::new()], vec![Vec::new()]];
    for shift in amplitudes(manifold, largest) {
        let point = manifold.point(shift);
        let at = values
            .clone()
            .with(Symbol::Shift, shift)
            .with(Symbol::AmplitudeRatio, point.absorber)
            .with(Symbol::ManifoldSquare, point.oscillator * point.oscillator);
        let roots = quadratic_roots(equations().by_detuning(&at));
        for (index, side) in sides.iter_mut().enumerate() {
            let piece = match roots.get(index) {
                Some(&detuning) => Some(ResponsePoint {
                    detuning,
                    absorber: point.absorber,
                    oscillator: point.oscillator,
                    branch: manifold.branch(shift),
                }),
                None => None,
            };
            match (piece, side.last_mut()) {
                (Some(piece), Some(last)) => last.push(piece),
                (None, Some(last)) if !last.is_empty() => side.push(Vec::new()),
                _ => {}
            }
        }
    }
    sides.map(|side| side.into_iter().filter(|piece| piece.len() > 1).collect())
}

/// Values of `B/b - 1` from almost -1 to `largest - 1`, with the ends of the branches among them.
fn amplitudes(manifold: &Manifold, largest: f64) -> Vec<f64> {
    const COUNT: i32 = 1200;
    let mut shifts: Vec<f64> =
        (1..=COUNT).map(|k| largest * f64::from(k) / f64::from(COUNT) - 1.0).collect();
    shifts.push(manifold.fold_shift);
    shifts.push(manifold.symmetry_breaking.absorber - 1.0);
    shifts.sort_by(f64::total_cmp);
    shifts
}
