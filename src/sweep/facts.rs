//! What the layers know of a point.

use crate::analysis::{FixedPointCurve, Manifold, Zone, fixed_points};
use crate::case::{Layer, Recorded};
use crate::orbits::{SymmetricOrbit, attracting_orbit};
use crate::regimes::Motion;
use crate::system::System;

use super::{Plan, Point};

/// What the layers know of a point; lengths over its clearance. A layer that nothing is recorded of is not
/// asked.
pub(super) struct Facts<'a> {
    pub point: &'a Point,
    /// The theory's area and strip; no area where closed form cannot tell Z1 from Z2.
    pub zone: Option<Zone>,
    /// Smallest amplitude of a stable fixed point.
    pub theory_peak: Option<f64>,
    /// Relative change of the excitation that leads to the nearest boundary.
    pub boundary_distance: Option<f64>,
    /// Amplitude of the oscillator alone; none where nothing limits it.
    pub bare: Option<f64>,
    /// The exact symmetric orbit that attracts.
    pub orbit: Option<SymmetricOrbit>,
    /// What simulation finds: from several starts; or followed upwards and downwards.
    pub found: Vec<Found>,
}

/// What simulation finds, from several starts or in one direction.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Found {
    /// Distinct motions, in the order in which starts led to them.
    pub motions: Vec<Motion>,
    /// Lyapunov exponent of the main one, per excitation period.
    pub lyapunov: Option<f64>,
    /// Displacements of the main one at the end of successive excitation periods.
    pub section: Vec<f64>,
}

impl Found {
    /// The motion that most starts lead to, the first of several.
    pub fn main(&self) -> Option<&Motion> {
        self.motions.iter().rev().max_by_key(|motion| motion.starts)
    }
}

impl<'a> Facts<'a> {
    /// Of a point, beside what simulation has found.
    pub fn of(plan: &Plan, point: &'a Point, found: Vec<Found>) -> Self {
        let wants = |recorded| plan.settings.record.contains(&recorded);
        let system = point.system.as_ref();
        let manifold = system.map(|system| Manifold::of(system.restitution()));
        let theory = system.zip(manifold.as_ref());
        Self {
            point,
            zone: system.filter(|_| wants(Recorded::Area)).map(zone),
            theory_peak: theory.filter(|_| wants(Recorded::TheoryPeak)).and_then(smallest_stable),
            boundary_distance: theory
                .filter(|_| wants(Recorded::BoundaryDistance))
                .and_then(|(system, manifold)| boundary_distance(system, manifold)),
            bare: system.and_then(System::linear_response).map(|response| response.amplitude()),
            orbit: system
                .filter(|_| plan.needs(Layer::Orbit) || wants(Recorded::OrbitReached))
                .and_then(attracting_orbit),
            found,
        }
    }
}

fn zone(system: &System) -> Zone {
    let manifold = Manifold::of(system.restitution());
    FixedPointCurve::of(system, &manifold).zone(system.forcing_per_clearance())
}

fn smallest_stable((system, manifold): (&System, &Manifold)) -> Option<f64> {
    let points = fixed_points::solve(system, manifold).ok()?;
    let stable = points.iter().filter(|point| point.stable && point.admissible);
    stable.map(|point| point.oscillator_amplitude).min_by(f64::total_cmp)
}

/// Relative distance from a boundary to where it is looked whether the area there is another.
const BESIDE: f64 = 1e-9;

/// Relative change of the excitation that leads to the nearest boundary of the theory; none where no
/// excitation, or none at this frequency, leads to another area.
fn boundary_distance(system: &System, manifold: &Manifold) -> Option<f64> {
    let gamma = system.forcing_per_clearance();
    let curve = FixedPointCurve::of(system, manifold);
    let collision = curve.collision().map(|(gamma, _)| gamma);
    let places = [Some(curve.hopf()), Some(curve.symmetry_breaking()), collision];
    let is_boundary =
        |at: &f64| *at > 0.0 && curve.zone(at * (1.0 - BESIDE)) != curve.zone(at * (1.0 + BESIDE));
    let near = |at: &f64| libm::log(at / gamma).abs();
    let nearest = places
        .into_iter()
        .flatten()
        .filter(is_boundary)
        .min_by(|a, b| near(a).total_cmp(&near(b)))?;
    (gamma > 0.0).then(|| nearest / gamma - 1.0)
}
