//! Everything exact that is known of one system: its symmetric 1:1 orbits and the boundaries around
//! them.

use serde::Serialize;

use super::boundaries::ExactBoundaries;
use super::branch::{BranchDirection, Settings, follow};
use super::impact_map::ImpactMap;
use super::limits::{Limit, StableStretch};
use super::measures::Peaks;
use super::orbit::Orbit;
use super::special_point::SpecialPoint;
use super::symmetric::{SymmetricOrbit, attracting_orbit, symmetric_orbits};
use super::two_impact::{SteadyOrbit, TwoImpactOrbits, two_impact_orbits};
use crate::bifurcation::Bifurcation;
use crate::numerics::scan::largest;
use crate::system::{Parameter, System};

/// Band of the frequency ratio, over the system's own, in which limits are looked for: one at half
/// or twice the frequency is no neighbour.
const FREQUENCIES: [f64; 2] = [0.5, 2.0];
/// Clearances, and forcings, over the system's own between which the attracting orbit of a cavity that is not ideal is
/// followed.
const CLEARANCES: [f64; 2] = [0.05, 20.0];
/// Gravity along the cavity and friction, over `b omega0^2`, up to which limits are looked for: accelerations of the
/// oscillator are about 1.
const LARGEST_ACCELERATION: f64 = 20.0;
/// Clearances looked at per unit of their logarithm for the smallest vibration: the optimum is
/// known to one percent.
const CLEARANCES_PER_E_FOLD: f64 = 100.0;
/// Distance from the ends of a stretch, over the clearance there, at which the orbit is still asked
/// for: far outside of their rounding.
const INSIDE: f64 = 1e-6;
/// Fewest and most steps over one stretch of clearances: one clearance in its middle, and no more
/// than twenty e-folds, of which the outer ones are no design.
const STEPS: [f64; 2] = [2.0, 2000.0];

/// The exact layer of one system.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct FullSystem {
    /// The system.
    pub system: System,
    /// Its symmetric 1:1 orbits, at most two, ascending in the absorber's amplitude.
    pub orbits: Vec<SymmetricOrbit>,
    /// All its orbits with two impacts per period, one on each wall; `None` for an ideal cavity, where the asymmetric ones
    /// are a part of the boundaries.
    pub two_impact: Option<TwoImpactOrbits>,
    /// The boundaries at its frequency and forcing; `None` without forcing, for an undamped
    /// oscillator driven at its natural frequency, which has no steady motion between impacts, and for a cavity that is
    /// not ideal.
    pub boundaries: Option<ExactBoundaries>,
}

impl FullSystem {
    /// Solves `system`. Nothing here iterates but one-dimensional roots.
    pub fn of(system: &System) -> Self {
        let driven = system.forcing_per_clearance() > 0.0;
        let real = driven && !system.cavity().is_ideal();
        Self {
            system: *system,
            orbits: symmetric_orbits(system).unwrap_or_default(),
            two_impact: real.then(|| two_impact_orbits(system).ok()).flatten(),
            boundaries: driven.then(|| ExactBoundaries::of(system).ok()).flatten(),
        }
    }

    /// The symmetric orbit that attracts, if there is one.
    pub fn attracting(&self) -> Option<&SymmetricOrbit> {
        self.orbits.iter().find(|orbit| orbit.orbit.attracts())
    }

    /// Its orbits with two impacts per period: the symmetric ones, or all that a cavity that is not ideal has.
    pub fn two_impact_orbits(&self) -> Vec<&Orbit> {
        match &self.two_impact {
            Some(found) => found.orbits.iter().collect(),
            None => self.orbits.iter().map(|one| &one.orbit).collect(),
        }
    }

    /// The same with peaks and impact speeds.
    pub fn two_impact_measured(&self) -> Vec<SteadyOrbit> {
        let map = ImpactMap::of(&self.system).ok();
        let each = self.two_impact_orbits().into_iter().zip(map.iter().cycle());
        each.map(|(orbit, map)| SteadyOrbit::of(map, orbit.clone())).collect()
    }

    /// The orbit with two impacts per period that attracts: the symmetric one, or what a cavity that is not ideal has
    /// instead.
    pub fn attracting_orbit(&self) -> Option<&Orbit> {
        self.two_impact_orbits().into_iter().find(|orbit| orbit.attracts())
    }

    /// Peak displacement of the oscillator on that orbit, over the clearance.
    pub fn attracting_peak(&self) -> Option<f64> {
        let map = ImpactMap::of(&self.system).ok()?;
        Some(Peaks::of(&map, &self.attracting_orbit()?.cycle).displacement)
    }

    /// The stretch of clearances, over the system's own, in which the attracting orbit of this
    /// system persists: from all limits, or in a cavity that is not ideal by continuation to
    /// either side; `None` where that does not come to an end.
    pub fn stretch(&self) -> Option<StableStretch> {
        let orbit = self.attracting_orbit()?;
        if self.two_impact.is_none() {
            return self.boundaries.as_ref()?.symmetric.stretch_around(1.0).copied();
        }
        let end = |direction| self.limit(orbit, Parameter::Clearance, CLEARANCES, direction);
        let limits = [end(BranchDirection::Down)?, end(BranchDirection::Up)?];
        let clearance = [0, 1].map(|k| limits[k].value);
        Some(StableStretch { clearance, ends: [0, 1].map(|k| Some(limits[k].kind)) })
    }

    /// Every stretch of clearances with an attracting symmetric orbit.
    pub fn stable_stretches(&self) -> &[StableStretch] {
        self.boundaries.as_ref().map_or(&[], |found| &found.symmetric.stable)
    }

    /// Limits of the symmetric orbits that bound stability.
    pub fn stability_limits(&self) -> impl Iterator<Item = &Limit> {
        let limits = self.boundaries.iter().flat_map(|found| &found.symmetric.limits);
        limits.filter(|limit| limit.bounds_stability)
    }

    /// Where the attracting orbit loses stability or ends as the frequency alone is lowered and
    /// raised, by continuation; values are frequency ratios.
    pub fn frequency_limits(&self) -> [Option<SpecialPoint>; 2] {
        let range = FREQUENCIES.map(|factor| factor * self.system.frequency_ratio());
        [BranchDirection::Down, BranchDirection::Up].map(|direction| {
            self.limit(self.attracting_orbit()?, Parameter::Frequency, range, direction)
        })
    }

    /// The same as the forcing alone is lowered and raised; values are over the system's own. In an ideal cavity they
    /// are the reciprocals of the clearances at the ends of [`Self::stretch`].
    pub fn forcing_limits(&self) -> [Option<SpecialPoint>; 2] {
        [BranchDirection::Down, BranchDirection::Up].map(|direction| {
            self.limit(self.attracting_orbit()?, Parameter::Amplitude, CLEARANCES, direction)
        })
    }

    /// The same as the cavity alone is tilted, towards `x - y = -b` and towards `x - y = b`; values are gravity's
    /// accelerations along it over `b omega0^2`.
    pub fn tilt_limits(&self) -> [Option<SpecialPoint>; 2] {
        [BranchDirection::Down, BranchDirection::Up].map(|direction| {
            let range = [-LARGEST_ACCELERATION, LARGEST_ACCELERATION];
            self.limit(self.attracting_orbit()?, Parameter::GravityAlong, range, direction)
        })
    }

    /// The same as friction alone grows; the value is its acceleration over `b omega0^2`.
    pub fn friction_limit(&self) -> Option<SpecialPoint> {
        let (orbit, range) = (self.attracting_orbit()?, [-1.0, LARGEST_ACCELERATION]);
        self.limit(orbit, Parameter::FrictionAcceleration, range, BranchDirection::Up)
    }

    /// The first bifurcation on the branch of an attracting orbit.
    fn limit(
        &self,
        start: &Orbit,
        parameter: Parameter,
        range: [f64; 2],
        direction: BranchDirection,
    ) -> Option<SpecialPoint> {
        let settings = Settings::within(range);
        let branch = follow(&self.system, start, parameter, direction, &settings).ok()?;
        // The branch sets out stable: the first bifurcation ends that, but for a crossing of branches.
        branch.specials.into_iter().find(|special| special.kind != Bifurcation::BranchPoint)
    }

    /// The clearance at which the attracting symmetric orbit vibrates least, to rounding.
    pub fn best_clearance(&self) -> Option<BestClearance> {
        let of_stretch = |stretch: &StableStretch| {
            // At its very ends it stops attracting.
            let ends = [1.0 + INSIDE, 1.0 - INSIDE];
            let [from, to] = [0, 1].map(|k| libm::log(stretch.clearance[k] * ends[k]));
            let steps = ((to - from) * CLEARANCES_PER_E_FOLD).ceil().clamp(STEPS[0], STEPS[1]);
            let (at, peak) =
                largest([from, to], steps as u32, |at| Some(-self.steady_peak(libm::exp(at))?))?;
            Some(BestClearance { factor: libm::exp(at), peak: -peak })
        };
        let found = self.stable_stretches().iter().filter_map(of_stretch);
        found.min_by(|a, b| a.peak.total_cmp(&b.peak))
    }

    /// Peak displacement of the attracting symmetric orbit at a clearance, both over the system's own;
    /// `None` where none attracts.
    pub fn steady_peak(&self, factor: f64) -> Option<f64> {
        let there = self.system.with_clearance_scaled(factor).ok()?;
        Some(factor * attracting_orbit(&there)?.peaks.displacement)
    }
}

/// A clearance and the vibration there.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BestClearance {
    /// Clearance over the system's own.
    pub factor: f64,
    /// Peak displacement of the oscillator over the system's own clearance.
    pub peak: f64,
}
