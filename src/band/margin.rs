//! How far the clearance may be off, along a band, before the stable 1:1 motion is lost.

use serde::Serialize;

use super::Band;
use crate::numerics::scan;
use crate::orbits::{FullSystem, SymmetricFamily};

/// Pieces in which the smallest gap is looked for before it is narrowed down. A gap is the distance to
/// the nearest of a few smooth boundaries, so its smallest value is at an end, at a kink or in a
/// smooth dip.
const PIECES: u32 = 12;

/// Distance of the clearance from the nearest end of the stretch with a stable symmetric 1:1 orbit, or, in a cavity that
/// is not ideal, with a stable orbit of one impact on each wall.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ClearanceMargin {
    /// By which share the clearance may shrink.
    pub down: f64,
    /// By which share it may grow.
    pub up: f64,
}

impl ClearanceMargin {
    /// The smaller of the two.
    pub fn smaller(&self) -> f64 {
        self.down.min(self.up)
    }

    /// At a place of a band; none where no such orbit attracts.
    pub fn of(band: &Band, at: f64) -> Option<Self> {
        let system = band.system(at).ok()?;
        let stretch = if system.cavity().is_ideal() {
            *SymmetricFamily::of(&system).ok()?.stretch_around(1.0)?
        } else {
            FullSystem::of(&system).stretch()?
        };
        let [low, high] = stretch.clearance;
        Some(Self { down: 1.0 - low, up: high - 1.0 })
    }
}

/// The smallest gap and where it is. A place without a stable 1:1 motion has none: the smallest is
/// then 0, there.
pub fn smallest(band: &Band) -> (f64, f64) {
    let range = match band.is_point() {
        true => [0.5 * (band.range[0] + band.range[1]); 2],
        false => band.range,
    };
    scan::smallest(range, PIECES, |at| {
        ClearanceMargin::of(band, at).map_or(0.0, |gap| gap.smaller())
    })
}
