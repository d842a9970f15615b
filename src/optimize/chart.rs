//! Design charts: which clearance is best for a single excitation, against its frequency, and against its
//! amplitude, to which it is proportional.

use serde::Serialize;

use super::search::{on_line, scan};
use super::task::Task;
use crate::analysis::{FixedPointCurve, Manifold};
use crate::case::{BandOver, Design, Objective};
use crate::executor::{Executor, Serial, map};
use crate::numerics::scan::largest;
use crate::orbits::{SymmetricFamily, attracting_orbit};
use crate::system::System;

/// Frequencies of a chart.
const FREQUENCIES: u32 = 61;
/// Reach of the chart beside a case without a band of frequencies, over the frequency.
const REACH: f64 = 0.05;
/// Pieces in which the best clearance of one excitation is looked for.
const PIECES: usize = 128;
/// Width to which it is narrowed down, over the logarithm of the range.
const WIDTH: f64 = 1e-7;

/// The clearances that suit one excitation, in the units of the design.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Suited {
    /// `Omega`.
    pub frequency_ratio: f64,
    /// The widest stretch with a stable symmetric 1:1 orbit.
    pub stable: Option<[f64; 2]>,
    /// The best, whatever the bounds of the task.
    pub best: Option<f64>,
}

/// Where clearances of a chart are looked for, over the case's own.
const WIDE: [f64; 2] = [0.02, 50.0];

/// The best clearance against the frequency of a single excitation with the case's own amplitude, with
/// the chosen restitution and mass.
pub fn chart(task: &Task, choice: &Design, executor: &dyn Executor) -> Vec<Suited> {
    let Some(band) = task.band_of(choice) else { return Vec::new() };
    let (own, clearance) = (band.base.frequency_ratio(), choice.clearance());
    let [from, to] = match &task.case.band {
        Some(_) if band.over == BandOver::Frequency => band.range,
        _ => [own * (1.0 - REACH), own * (1.0 + REACH)],
    };
    let at = |k: usize| {
        let part = k as f64 / f64::from(FREQUENCIES - 1);
        from * (1.0 - part) + to * part
    };
    let count = FREQUENCIES as usize;
    map(executor, "design chart", count, |k| {
        let system = band.base.with_frequency_ratio(at(k)).ok();
        let best = system.and_then(|system| best(task.objective, &system));
        let stable = system.and_then(|system| widest(&system));
        Suited {
            frequency_ratio: at(k),
            stable: stable.map(|ends| ends.map(|end| end * clearance)),
            best: best.map(|factor| factor * clearance),
        }
    })
}

/// The widest stretch of clearances with a stable symmetric orbit, over the system's own.
fn widest(system: &System) -> Option<[f64; 2]> {
    let family = SymmetricFamily::of(system).ok()?;
    let stretches = family.stable.iter().map(|stretch| stretch.clearance);
    stretches.max_by(|a, b| (a[1] / a[0]).total_cmp(&(b[1] / b[0])))
}

/// The best clearance for one system's excitation, over its own.
fn best(objective: Objective, system: &System) -> Option<f64> {
    match objective {
        Objective::Z3Share => {
            let manifold = Manifold::of(system.restitution());
            let curve = FixedPointCurve::of(system, &manifold);
            let factor = |part: f64| WIDE[0] * libm::pow(WIDE[1] / WIDE[0], part);
            let inside = |part: f64| {
                let gamma = system.forcing_per_clearance() / factor(part);
                f64::from(u8::from(curve.zone(gamma).is_z3()))
            };
            let scanned = scan("", PIECES, &Serial, &inside);
            let found = on_line(&scanned, WIDTH, &inside).filter(|best| best.score > 0.0)?;
            Some(factor(found.parts[0]))
        }
        Objective::StableShare => widest(system).map(|[low, high]| libm::sqrt(low * high)),
        // As far, in relation to itself, from one end as from the other.
        Objective::Margin => widest(system).map(|[low, high]| 0.5 * (low + high)),
        Objective::WorstAmplitude => {
            let still = |factor: f64| {
                let there = system.with_clearance_scaled(factor).ok()?;
                Some(-factor * attracting_orbit(&there)?.peaks.displacement)
            };
            largest(widest(system)?, PIECES as u32, still).map(|(factor, _)| factor)
        }
    }
}
