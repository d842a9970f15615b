//! What is solved for before a start is flown: the orbits with one impact on each wall per period that attract, and the
//! absorber at rest.
//!
//! Where the absorber rubs its slip may reverse between two impacts. The solver of orbits knows cycles that slide one way
//! from wall to wall; one that would reverse is where simulation begins, which finds what the motion is like then.

use super::identity::state_of;
use super::model::{KnownMotion, Proof};
use super::rest::{AtRest, Rest};
use super::watch::Watch;
use super::{Facts, Motion, MotionKind, Reached};
use crate::orbits::{Orbit, attracting_orbit, attracting_orbits, two_impact_orbits};
use crate::regimes::Regime;
use crate::simulation::{Simulation, Stop};
use crate::system::{State, System};

/// Excitation periods for which a trajectory from a cycle that would reverse is followed: it need not repeat by then, but be
/// where Newton's method finds what it comes to.
const LONGEST: u64 = 400;
/// Periods after which it is looked at again; then after twice as many.
const FIRST: u64 = 60;

/// The attracting 1:1 motions of a system, one impact on each wall per excitation period: orbits, and what an orbit becomes
/// whose slip reverses. Of two mirror images one.
pub fn one_to_one(system: &System) -> Vec<Motion> {
    known(system).into_iter().map(|one| one.motion).collect()
}

/// The one of them that a single number speaks of: the symmetric one, or else that with the largest peak.
pub fn steady(system: &System) -> Option<Motion> {
    if system.cavity().is_ideal() {
        // There is no need to look for others.
        let symmetric = attracting_orbit(system).map(|one| MotionKind::Orbit(Box::new(one.orbit)));
        let motion = symmetric.and_then(|kind| Motion::proven(system, kind, None));
        if motion.is_some() {
            return motion.map(Motion::solved);
        }
    }
    steady_of(&one_to_one(system)).cloned()
}

/// That of some motions.
pub(super) fn steady_of(motions: &[Motion]) -> Option<&Motion> {
    let of_kind = motions.iter().filter(|motion| motion.is_solved() && motion.is_one_to_one());
    let order = |motion: &Motion| (motion.regime == Regime::TwoSymmetric, motion.facts.peak.value);
    of_kind.max_by(|a, b| {
        let ((first, peak), (second, other)) = (order(a), order(b));
        first.cmp(&second).then(peak.total_cmp(&other))
    })
}

/// The same with where they stand at phase 0.
pub(super) fn known(system: &System) -> Vec<KnownMotion<System>> {
    let mut found: Vec<KnownMotion<System>> = Vec::new();
    let may_reverse = system.cavity().friction_acceleration > 0.0;
    let orbits = match may_reverse {
        true => two_impact_orbits(system).map(|all| all.orbits),
        false => attracting_orbits(system),
    };
    // Without excitation, or at an undamped resonance, there are none.
    for orbit in orbits.unwrap_or_default() {
        let (kind, sample) = match (orbit.attracts(), orbit.admissibility.reverses()) {
            (true, _) => (MotionKind::Orbit(Box::new(orbit)), None),
            (false, true) => match repeated(system, &orbit) {
                Some(Proof::Is(kind, sample)) => (kind, Some(*sample)),
                _ => continue,
            },
            (false, false) => continue,
        };
        if found.iter().any(|one| one.motion.kind.is_same(&kind)) {
            continue;
        }
        let motion = Motion::proven(system, kind, sample.as_ref());
        let motion = motion.filter(Motion::is_one_to_one);
        found.extend(motion.map(|motion| KnownMotion::new(system, motion.solved())));
    }
    found
}

/// What a trajectory from a cycle ends in, if it is soon seen to repeat, or close enough for Newton's method.
fn repeated(system: &System, orbit: &Orbit) -> Option<Proof<System>> {
    let begin = state_of(system, orbit)?;
    // Most are so near that there is nothing to fly.
    if let proof @ Proof::Is(..) = Proof::solved(system, begin) {
        return Some(proof);
    }
    let mut simulation = Simulation::new(system, begin, 0.0).ok()?;
    let mut stretch = FIRST;
    while simulation.periods() < LONGEST {
        let mut watch = Watch::begin(&simulation);
        let stop = simulation.run(stretch, 1000 * stretch, &mut watch.observers);
        if stop != Stop::EndTime {
            return None;
        }
        let proof = match watch.repetition() {
            Some(found) => Proof::of(system, &watch.sample(&simulation, stop)?, found),
            // Next to a bifurcation it takes long to repeat.
            None => match Proof::solved(system, simulation.state()) {
                Proof::Leaves => Proof::Open,
                proof => proof,
            },
        };
        if !matches!(proof, Proof::Open) {
            return Some(proof);
        }
        stretch *= 2;
    }
    None
}

/// The absorber at rest, where resting places stay so.
pub fn at_rest(system: &System) -> Option<Motion> {
    let AtRest { rest, facts, state } = AtRest::of(system)?;
    Some(Motion::resting(rest, facts, state).solved())
}

impl Motion {
    /// One with an absorber at rest.
    pub(super) fn resting(rest: Rest, facts: Facts, state: State) -> Self {
        Self {
            facts,
            kind: MotionKind::Rest(rest),
            regime: Regime::AtRest,
            state,
            reached: Reached::default(),
            settled: true,
            stop: Stop::EndTime,
        }
    }
}
