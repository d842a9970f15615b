//! What lists of motions of one place say of them, whatever the structure is: their order, which of them stands for them, and why one does
//! not count.

use std::cmp::Ordering;

use super::model::LongTerm;
use super::{NEGLIGIBLE, WhyNot};

/// The order of two motions by their shares and largest displacements: the larger share first, then the larger displacement.
pub(super) fn order(a: (f64, f64), b: (f64, f64)) -> Ordering {
    b.0.total_cmp(&a.0).then(b.1.total_cmp(&a.1))
}

/// The share of a motion that so many of the starts led to.
pub(super) fn share_of_starts(starts: u32, of: u32) -> f64 {
    f64::from(starts) / f64::from(of.max(1))
}

/// The place of the motion that stands for all: the moving one that most starts lead to, or else that at rest; where no start was flown
/// the first that moves.
pub(super) fn main<M: LongTerm>(all: &[M]) -> Option<usize> {
    let order = |motion: &M| {
        let (moves, starts) = (!motion.rests(), motion.reached().starts);
        (moves && starts > 0, starts, moves)
    };
    // The first of equal ones.
    (0..all.len()).rev().max_by_key(|index| order(&all[*index]))
}

impl WhyNot {
    /// Why a motion does not count in which absorbers rest in a share of their places, and to which so many starts led; none of one in
    /// which none rests, or which does.
    pub(super) fn of(rest: Option<f64>, starts: u32, count_rest: bool) -> Option<Self> {
        let share = rest?;
        match () {
            () if !count_rest => Some(Self::LeftOut),
            () if share < NEGLIGIBLE && starts == 0 => Some(Self::BelowThreshold),
            () => None,
        }
    }
}
