//! A closed sequence of impacts: which walls it meets in which order, after how many periods it repeats, its states, and
//! how well it closes.

use std::f64::consts::{PI, TAU};

use nalgebra::Matrix4;
use serde::Serialize;

use super::OrbitError;
use super::impact_map::{AfterImpact, ImpactMap, Leg, Step, Wall};
use crate::numerics::cyclic_word::canonical;

/// How a cycle of impacts closes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Closure {
    /// On itself, after so many excitation periods.
    Repeats {
        /// `n`.
        periods: u32,
    },
    /// On its mirror image after so many half periods (an odd number): a symmetric orbit, of which
    /// half is computed.
    Mirrors {
        /// `n`, the number of excitation periods of the whole orbit.
        periods: u32,
    },
}

impl Closure {
    /// Advance of the excitation's phase over the computed part, radians.
    pub fn turn(self) -> f64 {
        match self {
            Self::Repeats { periods } => f64::from(periods) * TAU,
            Self::Mirrors { periods } => f64::from(periods) * PI,
        }
    }

    /// The linear map that takes the end of the computed part to its beginning, on
    /// `(phase, x, x', y')`.
    pub fn matrix(self) -> Matrix4<f64> {
        match self {
            Self::Repeats { .. } => Matrix4::identity(),
            Self::Mirrors { .. } => {
                Matrix4::from_diagonal(&nalgebra::Vector4::new(1.0, -1.0, -1.0, -1.0))
            }
        }
    }
}

/// A closed sequence of impacts: the state after each, and the time to the next.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Cycle {
    /// How it closes.
    pub closure: Closure,
    /// The state after each impact, in order; for [`Closure::Mirrors`] of half the orbit.
    pub impacts: Vec<AfterImpact>,
    /// Fast time from each to the next.
    pub durations: Vec<f64>,
}

impl Cycle {
    /// The wall that ends flight `index`.
    pub fn next_wall(&self, index: usize) -> Wall {
        match (self.impacts.get(index + 1), self.closure) {
            (Some(next), _) => next.wall,
            (None, Closure::Repeats { .. }) => self.impacts[0].wall,
            (None, Closure::Mirrors { .. }) => self.impacts[0].wall.opposite(),
        }
    }

    /// The whole orbit's sequence of walls over one repetition, as `+-`; of its rotations always the
    /// same one, so that one motion has one name.
    pub fn sequence(&self) -> String {
        let whole = self.unfolded();
        let minus: Vec<bool> =
            whole.impacts.iter().map(|after| after.wall == Wall::Minus).collect();
        canonical(&minus).into_iter().map(|minus| if minus { '-' } else { '+' }).collect()
    }

    /// `p`, impacts of the whole orbit.
    pub fn impact_count(&self) -> usize {
        match self.closure {
            Closure::Repeats { .. } => self.impacts.len(),
            Closure::Mirrors { .. } => 2 * self.impacts.len(),
        }
    }

    /// `n`, excitation periods of the whole orbit.
    pub fn periods(&self) -> u32 {
        match self.closure {
            Closure::Repeats { periods } | Closure::Mirrors { periods } => periods,
        }
    }

    /// The same orbit written out over a whole repetition.
    pub fn unfolded(&self) -> Self {
        let Closure::Mirrors { periods } = self.closure else { return self.clone() };
        // The second half begins where the mirror image of the first begins, half a turn later.
        let later = self.impacts.iter().map(|after| after.mirrored(f64::from(periods)));
        Self {
            closure: Closure::Repeats { periods },
            impacts: self.impacts.iter().copied().chain(later).collect(),
            durations: self.durations.repeat(2),
        }
    }

    /// Half of the cycle, if its second half is the mirror image of the first to within `tolerance`
    /// over the clearance (radians for the phase).
    pub fn folded(&self, tolerance: f64) -> Option<Self> {
        let Closure::Repeats { periods } = self.closure else { return None };
        let count = self.impacts.len();
        if periods % 2 == 0 || count % 2 == 1 {
            return None;
        }
        let half = count / 2;
        let mirrors = (0..half).all(|k| {
            let mirror = self.impacts[k].mirrored(f64::from(periods));
            let there = &self.impacts[k + half];
            there.wall == mirror.wall && (mirror.vector() - there.vector()).amax() <= tolerance
        });
        mirrors.then(|| self.beginning(half, Closure::Mirrors { periods }))
    }

    /// Its first impacts, closed in another way.
    fn beginning(&self, count: usize, closure: Closure) -> Self {
        Self {
            closure,
            impacts: self.impacts[..count].to_vec(),
            durations: self.durations[..count].to_vec(),
        }
    }

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
                    here.wall == before.wall && apart(here, before) < tolerance * cycle.size()
                })
        };
        let rounds = (2..=periods).rev().find(repeats)?;
        let closure = Closure::Repeats { periods: cycle.periods() / rounds as u32 };
        Some(cycle.beginning(count / rounds, closure))
    }

    /// Whether another cycle is the same motion or its mirror image, to within `tolerance` over its
    /// size: some impact of the one begins the other.
    pub fn is_one_with(&self, other: &Self, tolerance: f64) -> bool {
        let same_kind = self.periods() == other.periods() && self.sequence() == other.sequence();
        let (a, b) = (self.unfolded(), other.unfolded());
        let mirrored = b.impacts.iter().map(|after| after.mirrored(-1.0)).collect();
        let limit = tolerance * a.size();
        same_kind
            && [b.impacts.clone(), mirrored].iter().any(|image| {
                (0..a.impacts.len()).any(|shift| {
                    let pairs = a.impacts.iter().zip(image.iter().cycle().skip(shift));
                    pairs.map(|(a, b)| apart(a, b)).fold(0.0, f64::max) < limit
                })
            })
    }

    /// Largest difference, lengths over the clearance and fast time, between its states and those of a cycle with as many
    /// impacts.
    pub fn distance(&self, other: &Self) -> f64 {
        let pairs = self.impacts.iter().zip(&other.impacts);
        pairs.map(|(a, b)| (a.vector() - b.vector()).amax()).fold(0.0, f64::max)
    }

    /// Its size, against which defects and distances are measured: the largest displacement or velocity
    /// after an impact, at least 1.
    pub(super) fn size(&self) -> f64 {
        let largest = |after: &AfterImpact| after.vector().rows(1, 3).amax();
        self.impacts.iter().map(largest).fold(1.0, f64::max)
    }

    /// The steps of the impact map along the cycle.
    pub fn steps(&self, map: &ImpactMap) -> Vec<Step> {
        (0..self.impacts.len())
            .map(|k| map.step(&self.impacts[k], self.next_wall(k), self.durations[k]))
            .collect()
    }

    /// Its flights.
    pub fn flights(&self, map: &ImpactMap) -> Vec<Leg> {
        (0..self.impacts.len())
            .map(|k| map.leg(&self.impacts[k], self.next_wall(k), self.durations[k]))
            .collect()
    }

    /// Jacobian of the map around the cycle, its closure included.
    pub fn jacobian(&self, map: &ImpactMap) -> Matrix4<f64> {
        let product = self
            .steps(map)
            .iter()
            .fold(Matrix4::identity(), |product, step| step.jacobian() * product);
        self.closure.matrix() * product
    }

    /// # Errors
    /// [`OrbitError::NotACycle`] where lengths disagree or a duration is not positive.
    pub(super) fn check(&self) -> Result<(), OrbitError> {
        let count = self.impacts.len();
        let refuse = |reason| Err(OrbitError::NotACycle { reason });
        if count == 0 || self.periods() == 0 {
            return refuse("it has no impact or no period");
        }
        if self.durations.len() != count {
            return refuse("each impact needs a time to the next");
        }
        if matches!(self.closure, Closure::Mirrors { periods } if periods % 2 == 0) {
            return refuse("a motion equals its mirror image after an odd number of half periods");
        }
        if !self.durations.iter().all(|duration| duration.is_finite() && *duration > 0.0) {
            return refuse("a time between impacts is not positive");
        }
        Ok(())
    }
}

/// Largest difference of two states after impact; phases differ by whole turns.
fn apart(a: &AfterImpact, b: &AfterImpact) -> f64 {
    let difference = a.vector() - b.vector();
    let turns = (difference[0] / TAU).round();
    difference.rows(1, 3).amax().max((difference[0] - turns * TAU).abs())
}

/// How well a cycle closes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Convergence {
    /// Largest defect of the closure and of the impact conditions, over the size of the orbit.
    pub residual: f64,
    /// Newton steps taken.
    pub iterations: u32,
}
