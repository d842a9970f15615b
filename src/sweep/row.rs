//! What is recorded of a point: closed form, exact orbits, and every motion that its starts lead to.

use crate::analysis::{Area, FixedPointCurve, Manifold, Strip, Zone};
use crate::band::simulated::{Effort, Motion, motions};
use crate::orbits::attracting_orbit;
use crate::regimes::Regime;
use crate::simulation::StartError;
use crate::system::System;

use super::{Coordinate, Plan};

/// What is recorded of a point. Lengths over the case's own clearance.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Its number.
    pub point: u64,
    /// Where it lies.
    pub coordinates: Vec<Coordinate>,
    /// The theory's area and strip; no area where closed form cannot tell Z1 from Z2.
    pub zone: Zone,
    /// Peak displacement of the exact symmetric orbit that attracts, if one does.
    pub orbit_peak: Option<f64>,
    /// Amplitude of the oscillator alone; none where nothing limits it.
    pub bare: Option<f64>,
    /// The motion that most starts lead to; none where nothing could be measured.
    pub main: Option<Main>,
    /// The largest peak of any motion.
    pub largest_peak: Option<f64>,
    /// Distinct motions that starts lead to.
    pub motions: u32,
}

/// The motion that most starts lead to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Main {
    /// Its regime.
    pub regime: Regime,
    /// Impacts per excitation period.
    pub impacts_per_period: f64,
    /// Largest displacement of the oscillator.
    pub peak: f64,
    /// Root mean square displacement of the oscillator.
    pub rms: f64,
    /// Share of the starts that led to it.
    pub share: f64,
}

/// The rows of some points; one whose values together leave no system is left out.
///
/// # Errors
/// [`StartError`] where a start is not finite.
pub fn rows(plan: &Plan, points: std::ops::Range<u64>) -> Result<Vec<Row>, StartError> {
    let there = |point: u64| plan.system(point).ok().map(|system| (point, system));
    let places: Vec<(u64, (System, f64))> = points.filter_map(there).collect();
    let systems: Vec<System> = places.iter().map(|(_, (system, _))| *system).collect();
    let effort = Effort { starts: plan.settings.starts, periods: plan.settings.periods };
    let found = motions(&systems, &effort)?;
    let row = |((point, (system, clearance)), motions): (&(u64, (System, f64)), Vec<Motion>)| {
        let length = |over_own: f64| over_own * clearance;
        let main = motions.iter().max_by_key(|motion| motion.starts);
        let largest = motions.iter().map(|motion| motion.peak).max_by(f64::total_cmp);
        Row {
            point: *point,
            coordinates: plan.coordinates(*point),
            zone: zone(system),
            orbit_peak: attracting_orbit(system).map(|orbit| length(orbit.peaks.displacement)),
            bare: system.linear_response().map(|response| length(response.amplitude())),
            main: main.map(|motion| Main {
                regime: motion.regime,
                impacts_per_period: motion.impacts_per_period,
                peak: length(motion.peak),
                rms: length(motion.rms),
                share: f64::from(motion.starts) / f64::from(effort.starts.max(1)),
            }),
            largest_peak: largest.map(length),
            motions: motions.len() as u32,
        }
    };
    Ok(places.iter().zip(found).map(row).collect())
}

fn zone(system: &System) -> Zone {
    let Ok(manifold) = Manifold::of(system.restitution()) else {
        return Zone { area: Some(Area::Z4), strip: None };
    };
    FixedPointCurve::of(system, &manifold).zone(system.forcing_per_clearance())
}

/// A zone as a result names it: an area, or `Z1|Z2` where closed form cannot tell.
pub fn area_name(zone: Zone) -> &'static str {
    match zone.area {
        Some(Area::Z1) => "Z1",
        Some(Area::Z2) => "Z2",
        Some(Area::Z3) => "Z3",
        Some(Area::Z4) => "Z4",
        None => "Z1|Z2",
    }
}

/// A strip as a result names it.
pub fn strip_name(zone: Zone) -> Option<&'static str> {
    zone.strip.map(|strip| match strip {
        Strip::A1 => "A1",
        Strip::A2 => "A2",
    })
}
