//! The theory's areas and strips along a band, in closed form.

use super::{Band, Stretch};
use crate::analysis::boundaries::{Boundaries, crossings, crossings_of, vanishing};
use crate::analysis::{Area, AsymmetricLimits, FixedPointCurve, Manifold, Zone};
use crate::bifurcation::Bifurcation;
use crate::cavity::CavityMotion;
use crate::numerics::scan::sign_changes;
use crate::system::BandOver;

/// Pieces of a band with an amplitude of its own at each frequency, in which crossings of the theory's boundaries are looked
/// for. A boundary is a quotient of low polynomials of the detuning; pairs of crossings within a piece are found by the dip
/// between them.
const PIECES: u32 = 256;
/// Where a fixed point changes its branch, or two collide, one of these is crossed; where one is lost otherwise, its absorber
/// amplitude vanishes.
const BOUNDARIES: [Bifurcation; 3] =
    [Bifurcation::NeimarkSacker, Bifurcation::SymmetryBreaking, Bifurcation::SaddleNode];

/// The areas and strips along a band, in order; where there is no system or no theory, Z4.
pub fn zones(band: &Band) -> Vec<Stretch<Zone>> {
    let nothing = Zone { area: Area::Z4, strip: None };
    let grazing = AsymmetricLimits::of(band.base.restitution()).grazing;
    cut(band, grazing, |zone| zone.unwrap_or(nothing))
}

/// The share of a band in area Z3, strips included.
pub fn z3_share(band: &Band) -> f64 {
    // Where an asymmetric motion grazes is not asked.
    let found = cut(band, None, |zone| zone.is_some_and(|zone| zone.is_z3()));
    band.share(&found, |z3| *z3)
}

/// The band cut where one of the boundaries is crossed, `grazing` being that of the asymmetric motion.
fn cut<T: PartialEq>(
    band: &Band,
    grazing: Option<CavityMotion>,
    of: impl Fn(Option<Zone>) -> T,
) -> Vec<Stretch<T>> {
    let manifold = Manifold::of(band.base.restitution());
    let mut places: Vec<f64> = band.corners().collect();
    match band.over {
        BandOver::Frequency if band.spectrum.len() < 2 => {
            let Ok(there) = band.system(band.range[0]) else {
                return band.cut(Vec::new(), |_| of(None));
            };
            let mut found: Vec<f64> = BOUNDARIES
                .into_iter()
                .flat_map(|kind| crossings(kind, &there, &manifold))
                .collect();
            found.extend(vanishing(&there, &manifold));
            found.extend(grazing.iter().flat_map(|end| crossings_of(end, &there, &manifold)));
            places.extend(found.into_iter().map(|detuning| 1.0 + there.mass_ratio() * detuning));
        }
        BandOver::Frequency => {
            let excess = |at: f64, boundary: &dyn Fn(&FixedPointCurve) -> f64| {
                let system = band.system(at);
                system.map_or(f64::NAN, |system| {
                    let curve = FixedPointCurve::of(&system, &manifold);
                    system.forcing_per_clearance() - boundary(&curve)
                })
            };
            let boundaries: [&dyn Fn(&FixedPointCurve) -> f64; 5] = [
                &FixedPointCurve::hopf,
                &FixedPointCurve::vanishing,
                &FixedPointCurve::symmetry_breaking,
                &|curve| curve.collision().map_or(0.0, |(gamma, _)| gamma),
                &|curve| grazing.map_or(0.0, |end| curve.forcing_of(&end)),
            ];
            for boundary in boundaries {
                places.extend(sign_changes(band.range, PIECES, |at| excess(at, boundary)));
            }
        }
        BandOver::Amplitude => {
            let boundaries = Boundaries::of(&band.base, &manifold);
            let all = boundaries.of_symmetric().chain(boundaries.of_asymmetric());
            let vanishing = FixedPointCurve::of(&band.base, &manifold).vanishing();
            let all = all.map(|(_, gamma)| gamma).chain([vanishing]);
            places.extend(all.map(|gamma| gamma / band.base.forcing_per_clearance()));
        }
    }
    band.cut(places, |at| {
        of(band.system(at).ok().map(|system| {
            let curve = FixedPointCurve::of(&system, &manifold);
            curve.zone_within(system.forcing_per_clearance(), || grazing)
        }))
    })
}
