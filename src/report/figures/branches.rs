//! Frequency responses in pieces of one stability.

use crate::analysis::frequency_response::{ResponsePoint, response};
use crate::analysis::{AnalysisError, Branch, Manifold};
use crate::system::System;

/// A part of a response curve, stable or not.
pub(super) struct Piece {
    pub stable: bool,
    pub points: Vec<[f64; 2]>,
}

/// The response of a system up to `B/b = largest`; `place` puts its points on the axes.
///
/// On the stable branch a fixed point is a saddle where the curve has turned back: `gamma^2` then
/// falls with the amplitude, so that on the lower side of the resonance the frequency falls and on
/// the upper side it rises.
pub(super) fn branches_of(
    system: &System,
    manifold: &Manifold,
    largest: f64,
    place: &dyn Fn(&ResponsePoint) -> [f64; 2],
) -> Result<Vec<Piece>, AnalysisError> {
    let mut all: Vec<Piece> = Vec::new();
    for (side, curves) in response(system, manifold, largest).iter().enumerate() {
        let outwards = if side == 0 { 1.0 } else { -1.0 };
        let stable = |pair: &[ResponsePoint]| {
            let within = pair.iter().all(|point| point.branch == Branch::Stable);
            within && (pair[1].detuning - pair[0].detuning) * outwards > 0.0
        };
        for curve in curves {
            let pairs: Vec<&[ResponsePoint]> = curve.windows(2).collect();
            for run in pairs.chunk_by(|a, b| stable(a) == stable(b)) {
                let ends = run.iter().map(|pair| &pair[0]).chain(run.last().map(|pair| &pair[1]));
                all.push(Piece {
                    stable: run.first().is_some_and(|pair| stable(pair)),
                    points: ends.map(place).collect(),
                });
            }
        }
    }
    Ok(all)
}

/// All stable pieces, or all others, as one line with gaps.
pub(super) fn joined(pieces: &[Piece], stable: bool) -> Vec<[f64; 2]> {
    let chosen = pieces.iter().filter(|piece| piece.stable == stable);
    chosen.flat_map(|piece| piece.points.iter().copied().chain([[f64::NAN; 2]])).collect()
}
