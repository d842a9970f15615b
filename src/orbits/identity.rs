//! When two cycles are one motion: gone round more than once, begun at another impact, or mirrored.

use std::f64::consts::TAU;

use super::impact_map::AfterImpact;
use super::newton::size;
use super::orbit::{Closure, Cycle};

impl Cycle {
    /// A cycle that goes round more than once to within `tolerance` over its size, cut to once;
    /// `None` if it is none. A motion that comes to its orbit from alternate sides repeats after
    /// twice its periods long before it does after once.
    pub fn once(&self, tolerance: f64) -> Option<Self> {
        let cycle = self.unfolded();
        let (count, periods) = (cycle.impacts.len(), cycle.periods() as usize);
        let repeats = |rounds: &usize| {
            let length = count / rounds;
            count % rounds == 0
                && periods % rounds == 0
                && (length..count).all(|k| {
                    let (here, before) = (&cycle.impacts[k], &cycle.impacts[k - length]);
                    cycle.walls[k] == cycle.walls[k - length]
                        && apart(here, before) < tolerance * size(&cycle)
                })
        };
        let rounds = (2..=periods).rev().find(repeats)?;
        let length = count / rounds;
        Some(Self {
            closure: Closure::Repeats { periods: cycle.periods() / rounds as u32 },
            walls: cycle.walls[..length].to_vec(),
            impacts: cycle.impacts[..length].to_vec(),
            durations: cycle.durations[..length].to_vec(),
        })
    }

    /// Whether another cycle is the same motion or its mirror image, to within `tolerance` over its
    /// size: some impact of the one begins the other.
    pub fn is_one_with(&self, other: &Self, tolerance: f64) -> bool {
        let same_kind = self.periods() == other.periods() && self.sequence() == other.sequence();
        let (a, b) = (self.unfolded(), other.unfolded());
        let mirrored = b.impacts.iter().map(AfterImpact::mirrored).collect();
        let limit = tolerance * size(&a);
        same_kind
            && [b.impacts.clone(), mirrored].iter().any(|image| {
                (0..a.impacts.len()).any(|shift| {
                    let pairs = a.impacts.iter().zip(image.iter().cycle().skip(shift));
                    pairs.map(|(a, b)| apart(a, b)).fold(0.0, f64::max) < limit
                })
            })
    }
}

/// Largest difference of two states after impact; phases differ by whole turns.
fn apart(a: &AfterImpact, b: &AfterImpact) -> f64 {
    let difference = a.vector() - b.vector();
    let turns = (difference[0] / TAU).round();
    difference.rows(1, 3).amax().max((difference[0] - turns * TAU).abs())
}
