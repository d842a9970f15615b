//! The manifold, and what it takes from the oscillator, at several restitutions (Fig. 9).

use std::f64::consts::{FRAC_2_PI, PI};

use crate::analysis::motion::read_off;
use serde::Serialize;

use crate::analysis::{Manifold, ManifoldBranch};
use crate::motions::Measured;
use crate::study::CaseStudy;
use crate::system::{Parameters, System};

use super::{Line, branches, even, first_drawn, steady_orbits_at};

/// Steps in restitution.
const STEPS: u32 = 200;
/// Restitutions among which the smallest vibration is looked for.
const TRIED: u32 = 100;

/// What the manifold gives at one restitution for the oscillator's amplitude.
#[derive(Debug, Clone, Copy)]
pub struct Taken {
    /// `r`.
    pub restitution: f64,
    /// `B/b`.
    pub absorber: f64,
    /// `E/b = 8 B/(pi^2 b)`.
    pub harmonic: f64,
    /// `E sin(Theta)/b`, the part that enters the first equation of (18).
    pub damping: f64,
    /// Where on the manifold.
    pub branch: ManifoldBranch,
}

/// Which restitutions matter at an oscillator amplitude.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Strongest {
    /// Where `E` is largest, among those with a steady 1:1 motion.
    pub harmonic: f64,
    /// Where `E sin(Theta)` is, among the same.
    pub damping: f64,
    /// The smallest and the largest with a steady 1:1 motion.
    pub stable: [f64; 2],
}

/// Restitutions at the oscillator amplitude of a case.
#[derive(Debug, Clone)]
pub struct Restitutions {
    /// `C/b`: the stable fixed point's, else the observed one.
    pub level: f64,
    /// By ascending restitution.
    pub taken: Vec<Taken>,
    /// Which matter.
    pub strongest: Strongest,
    /// At the case's clearance and forcing: the restitution whose exact symmetric orbit attracts and vibrates
    /// least, with its peak.
    pub best: Option<(f64, f64)>,
}

impl Restitutions {
    /// Of a case's own amplitude; none where nothing is steady at it.
    pub fn of(study: &CaseStudy) -> Option<Self> {
        let stable = study.analysis.stable_points().last().map(|point| point.oscillator_amplitude);
        let seen = || Some(observed(study, first_drawn(study)?.1)?[1]);
        let level = stable.or_else(seen)?;
        let taken: Vec<Taken> =
            even(0.0, 1.0, STEPS).filter_map(|restitution| taken(restitution, level)).collect();
        let strongest = strongest(&taken)?;
        Some(Self { level, taken, strongest, best: best(&study.analysis.system) })
    }

    /// `[restitution, value]` on the stable branch of the manifold, and beside it.
    pub fn lines(&self, value: fn(&Taken) -> f64) -> [Line; 2] {
        let stable = |[_, next]: [&Taken; 2]| next.branch == ManifoldBranch::Stable;
        branches(&self.taken, &stable, &|at| [at.restitution, value(at)])
    }
}

/// What was observed of a motion: `[B/b, C/b]` by its first harmonics.
pub fn observed(study: &CaseStudy, found: &Measured) -> Option<[f64; 2]> {
    let system = &study.analysis.system;
    let seen = read_off(system, found.oscillator_harmonic, found.absorber_harmonic);
    let place = [seen.absorber_amplitude, seen.oscillator_amplitude];
    place.iter().all(|value| value.is_finite()).then_some(place)
}

/// The right one of the two points of the manifold at a given `C/b`; none below the fold.
fn taken(restitution: f64, level: f64) -> Option<Taken> {
    let manifold = Manifold::of(restitution);
    let absorber = manifold.stable_absorber(level)?;
    let harmonic = 8.0 / (PI * PI) * absorber;
    let sine = FRAC_2_PI * manifold.restitution_ratio * absorber / level;
    let branch = manifold.branch(absorber - 1.0);
    Some(Taken { restitution, absorber, harmonic, damping: harmonic * sine, branch })
}

/// Where 1:1 resonance is not steady the manifold takes nothing.
fn strongest(all: &[Taken]) -> Option<Strongest> {
    let stable = || all.iter().filter(|at| at.branch == ManifoldBranch::Stable);
    let largest = |value: fn(&Taken) -> f64| {
        let at = stable().max_by(|a, b| value(a).total_cmp(&value(b)))?;
        Some(at.restitution)
    };
    Some(Strongest {
        harmonic: largest(|at| at.harmonic)?,
        damping: largest(|at| at.damping)?,
        stable: [stable().next()?.restitution, stable().next_back()?.restitution],
    })
}

/// At small restitutions an orbit of the theory may be none: the absorber would leave its cavity.
fn best(system: &System) -> Option<(f64, f64)> {
    let tried = even(0.0, 1.0, TRIED).filter_map(|restitution| {
        let there = System::new(Parameters { restitution, ..system.parameters() }).ok();
        let orbits = steady_orbits_at(there);
        let orbit = orbits.iter().find(|orbit| orbit.orbit.attracts())?;
        Some((restitution, orbit.peaks.displacement))
    });
    tried.min_by(|a, b| a.1.total_cmp(&b.1))
}
