//! What the layers know of a point. A layer is asked when something of it is recorded, and at most once where
//! the answer is costly. Lengths are over the clearance.

use std::cell::OnceCell;

use super::GridPoint;
use crate::analysis::{AsymmetricLimits, FixedPointCurve, Manifold, Zone, fixed_points};
use crate::motions::{Motion, Motions, Section, steady};
use crate::system::System;

/// A point and what was found there.
pub(super) struct PointFacts<'a> {
    pub point: &'a GridPoint,
    /// What simulation finds: from several starts; or followed upwards and downwards.
    pub found: Vec<PointMotions>,
    orbit: OnceCell<Option<Motion>>,
}

/// What simulation finds, from several starts or in one direction.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct PointMotions {
    /// The long-term motions.
    pub motions: Motions,
    /// A second look at the main one.
    pub section: Section,
}

/// Relative distance from a boundary to where it is looked whether the area there is another.
const BESIDE: f64 = 1e-9;

impl<'a> PointFacts<'a> {
    pub fn of(point: &'a GridPoint, found: Vec<PointMotions>) -> Self {
        Self { point, found, orbit: OnceCell::new() }
    }

    fn theory(&self) -> Option<(&'a System, Manifold)> {
        let system = self.point.system.as_ref()?;
        Some((system, Manifold::of(system.restitution())))
    }

    /// The theory's area and strip.
    pub fn zone(&self) -> Option<Zone> {
        let (system, manifold) = self.theory()?;
        Some(FixedPointCurve::of(system, &manifold).zone(system.forcing_per_clearance()))
    }

    /// Smallest amplitude of a stable fixed point.
    pub fn theory_peak(&self) -> Option<f64> {
        let (system, manifold) = self.theory()?;
        let points = fixed_points(system, &manifold).ok()?;
        let stable = points.iter().filter(|point| point.stable && point.admissible);
        stable.map(|point| point.oscillator_amplitude).min_by(f64::total_cmp)
    }

    /// Relative change of the excitation that leads to the nearest boundary of the theory; none where no
    /// excitation, or none at this frequency, leads to another area.
    pub fn boundary_distance(&self) -> Option<f64> {
        let (system, manifold) = self.theory()?;
        let gamma = system.forcing_per_clearance();
        let curve = FixedPointCurve::of(system, &manifold);
        let collision = curve.collision().map(|(gamma, _)| gamma);
        let grazing = AsymmetricLimits::of(manifold.restitution).grazing;
        let grazing = grazing.map(|end| curve.forcing_of(&end));
        let places = [Some(curve.hopf()), Some(curve.symmetry_breaking()), collision, grazing];
        let is_boundary = |at: &f64| {
            *at > 0.0 && curve.zone(at * (1.0 - BESIDE)) != curve.zone(at * (1.0 + BESIDE))
        };
        let near = |at: &f64| libm::log(at / gamma).abs();
        let boundaries = places.into_iter().flatten().filter(is_boundary);
        let nearest = boundaries.min_by(|a, b| near(a).total_cmp(&near(b)))?;
        (gamma > 0.0).then(|| nearest / gamma - 1.0)
    }

    /// Amplitude of the oscillator alone; none where nothing limits it.
    pub fn bare(&self) -> Option<f64> {
        self.point.system.as_ref().and_then(System::linear_response).map(|found| found.amplitude())
    }

    /// The 1:1 motion that attracts: of the list where there is one.
    pub fn orbit(&self) -> Option<&Motion> {
        let listed = self.found.iter().find_map(|found| found.motions.steady());
        let solved = || self.point.system.as_ref().and_then(steady);
        listed.or_else(|| self.orbit.get_or_init(solved).as_ref())
    }
}
