//! A motion that seems to repeat is proven periodic by an orbit that Newton's method converges to, and
//! two that converge to one orbit are one motion, however far apart they still were.

use std::f64::consts::TAU;

use serde::Serialize;

use crate::orbits::newton::solve;
use crate::orbits::{AfterImpact, Closure, Cycle, Measures, Orbit, Origin, Wall};
use crate::regimes::{Attractor, DynamicsKind, FoundAttractor, Regime};
use crate::simulation::{Impact, Side};
use crate::system::{State, System};

/// Distance in state, over the clearance and radians, below which the halves of a simulated cycle
/// count as mirror images: far above the closure of a simulated repetition.
const MIRRORED: f64 = 1e-4;
/// Distance between simulated and exact impacts, over the size of the orbit, above which Newton's
/// method has gone elsewhere.
const SAME: f64 = 1e-3;
/// Distance between the impacts of two solved orbits, over their size, below which they are one: solved
/// to 1e-10, with room for the multipliers of a nearly singular orbit.
const ONE_ORBIT: f64 = 1e-6;
/// Longest cycle that is proven; a longer one is a chattering sequence, which ends in contact and is
/// no cycle of impacts.
const MOST_IMPACTS: usize = 64;

/// An exact orbit that a simulated motion is.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Proof {
    /// The orbit.
    pub orbit: Orbit,
    /// Its averages.
    pub measures: Measures,
    /// Largest distance between the simulated and the exact impacts, over the orbit's size.
    pub distance: f64,
}

impl Proof {
    /// Of a motion that was seen to repeat; `None` where it was not, where it rests on a wall in
    /// between, or where Newton's method finds no admissible orbit at that place.
    pub fn of(system: &System, found: &Attractor) -> Option<Self> {
        let (repetition, impacts) = found.last_repetition()?;
        let contact = found.sustained_contact.intervals > 0;
        if contact || impacts.is_empty() || impacts.len() > MOST_IMPACTS {
            return None;
        }
        let simulated = cycle(system, impacts, repetition.periods)?;
        let start = simulated.folded(MIRRORED).unwrap_or_else(|| simulated.clone());
        let mut orbit = solve(system, &start, Origin::Simulation).ok()?;
        if let Some(once) = orbit.cycle.once(ONE_ORBIT) {
            let start = once.folded(ONE_ORBIT).unwrap_or(once);
            orbit = solve(system, &start, Origin::Simulation).ok()?;
        }
        let distance = distance(&orbit.cycle.unfolded(), &simulated);
        let holds = orbit.admissibility.admissible && distance < SAME;
        let measures = Measures::of(system, &orbit.cycle).ok()?;
        holds.then_some(Self { orbit, measures, distance })
    }
}

/// Every long-term motion that was found, each with its proof, by share of starts.
#[derive(Debug, Clone, Default)]
pub struct LongTermMotions {
    /// What they are.
    pub attractors: Vec<FoundAttractor>,
    /// For each of them the exact orbit that it is, where it is one.
    pub proofs: Vec<Option<Proof>>,
    /// What finding them has cost, in operations as [`crate::operation_count`] counts them.
    pub operations: u64,
}

impl LongTermMotions {
    /// Proves what was `found` from `starts` evenly spread starts, where it can be proven, and merges
    /// what one orbit proves to be one motion (or its mirror image).
    pub fn proven(system: &System, found: Vec<FoundAttractor>, starts: u32) -> Self {
        let mut motions = Self::default();
        for mut one in found {
            let proof = Proof::of(system, &one.attractor);
            if let Some(proof) = &proof {
                // What is proven stands above what was seen.
                one.attractor.classification.dynamics = proof.dynamics();
            }
            let known = motions.proofs.iter().position(|known| match (known, &proof) {
                (Some(known), Some(proof)) => {
                    known.orbit.cycle.is_one_with(&proof.orbit.cycle, ONE_ORBIT)
                }
                _ => false,
            });
            if let Some(known) = known {
                motions.attractors[known].absorb(one);
                motions.attractors[known].set_share(starts);
            } else {
                motions.attractors.push(one);
                motions.proofs.push(proof);
            }
        }
        motions
    }

    /// The place of the moving one that most starts lead to, or of rest if there is no other.
    pub fn main_index(&self) -> usize {
        let moves = |found: &FoundAttractor| found.regime() != Regime::AtRest;
        self.attractors.iter().position(moves).unwrap_or(0)
    }

    /// That motion, followed and measured once more from its state by `follow`; none where no start led anywhere.
    ///
    /// # Errors
    /// Those of `follow`.
    pub fn followed<E>(
        &mut self,
        follow: impl FnOnce(State) -> Result<Attractor, E>,
    ) -> Result<Option<Attractor>, E> {
        let index = self.main_index();
        let Some(main) = self.attractors.get_mut(index) else { return Ok(None) };
        let mut motion = follow(main.attractor.state)?;
        // One motion has one peak, wherever it is printed.
        main.attractor.take_extremes(&motion);
        motion.take_extremes(&main.attractor);
        Ok(Some(motion))
    }

    /// That motion with its proof.
    pub fn main(&self) -> Option<(&FoundAttractor, Option<&Proof>)> {
        let main = self.main_index();
        Some((self.attractors.get(main)?, self.proofs.get(main)?.as_ref()))
    }
}

impl Proof {
    fn dynamics(&self) -> DynamicsKind {
        let cycle = &self.orbit.cycle;
        let impacts = u32::try_from(cycle.impact_count()).unwrap_or(u32::MAX);
        DynamicsKind::Periodic { impacts, periods: cycle.periods() }
    }
}

/// The impacts of one repetition as a cycle; the time from the last to the first completes it.
fn cycle(system: &System, impacts: &[Impact], periods: u32) -> Option<Cycle> {
    let omega = system.frequency_ratio();
    let first = impacts.first()?;
    let whole = f64::from(periods) * TAU / omega;
    let passed = |impact: &Impact| impact.tau - first.tau;
    let times: Vec<f64> = impacts.iter().map(passed).chain([whole]).collect();
    Some(Cycle {
        closure: Closure::Repeats { periods },
        impacts: impacts
            .iter()
            .map(|impact| AfterImpact {
                wall: if impact.side == Side::Plus { Wall::Plus } else { Wall::Minus },
                phase: first.phase + omega * passed(impact),
                x: impact.x,
                x_velocity: impact.x_velocity_after,
                y_velocity: impact.y_velocity_after,
            })
            .collect(),
        durations: times.windows(2).map(|pair| pair[1] - pair[0]).collect(),
    })
}

fn distance(exact: &Cycle, simulated: &Cycle) -> f64 {
    let size = exact.impacts.iter().map(|impact| impact.vector().amax()).fold(1.0, f64::max);
    exact.distance(simulated) / size
}
