//! The theory's areas and strips along a band, in closed form.

use super::{Band, Stretch};
use crate::analysis::{Area, AsymmetricLimits, FixedPointCurve, Manifold, Zone};
use crate::numerics::scan::sign_changes;

/// Pieces of a band in which crossings of the theory's boundaries are looked for. A boundary is a
/// quotient of low polynomials of the detuning; pairs of crossings within a piece are found by the
/// dip between them.
const PIECES: u32 = 256;

/// The areas and strips along a band, in order; where there is no system or no theory, Z4.
pub fn zones(band: &Band) -> Vec<Stretch<Zone>> {
    let manifold = Manifold::of(band.base.restitution());
    let curve = |at: f64| {
        let system = band.system(at).ok()?;
        Some((FixedPointCurve::of(&system, &manifold), system.forcing_per_clearance()))
    };
    let excess = |at: f64, boundary: &dyn Fn(&FixedPointCurve) -> f64| {
        curve(at).map_or(f64::NAN, |(curve, gamma)| gamma - boundary(&curve))
    };
    let mut places: Vec<f64> = band.corners().collect();
    // Where a fixed point changes its branch, or two collide, one of these is crossed.
    let grazing = AsymmetricLimits::of(band.base.restitution()).grazing;
    let boundaries: [&dyn Fn(&FixedPointCurve) -> f64; 4] = [
        &FixedPointCurve::hopf,
        &FixedPointCurve::symmetry_breaking,
        &|curve| curve.collision().map_or(0.0, |(gamma, _)| gamma),
        &|curve| grazing.map_or(0.0, |end| curve.forcing_of(&end)),
    ];
    for boundary in boundaries {
        places.extend(sign_changes(band.range, PIECES, |at| excess(at, boundary)));
    }
    let nothing = Zone { area: Area::Z4, strip: None };
    band.cut(places, |at| curve(at).map_or(nothing, |(curve, gamma)| curve.zone(gamma)))
}
