//! What a search of absorbers or dampers makes small, of every structure.

use crate::linear::{BandSystems, bare_amplitude};
use crate::measure::Measure;
use crate::system::System;

/// What the largest displacement over that of the structure alone counts beside limits that are of something else: one that holds
/// by a little more is not worth several times the vibration.
const BESIDE: f64 = 0.1;

/// What a design of dampers makes small: by how much limits are [`missed`], each with what comes of what it allows, and where some are
/// of something else than displacement a little of the largest displacement, over that of the structure alone; without limits that
/// displacement.
pub fn missed_with(limits: &[(Measure, f64)], [peak, bare]: [f64; 2]) -> f64 {
    if limits.is_empty() {
        return peak;
    }
    let over: Vec<f64> = limits.iter().map(|(_, over)| *over).collect();
    // What nothing limits alone is nothing to compare with.
    let beside = bare.is_finite() && !limits.iter().all(|(of, _)| is_of_displacement(*of));
    missed(&over) + if beside { BESIDE * peak / bare } else { 0.0 }
}

/// Whether the smallest displacement leaves it most room.
fn is_of_displacement(of: Measure) -> bool {
    matches!(of, Measure::Peak | Measure::Rms)
}

/// Limits of what a structure of one mode does that moves in sines, by which its damper is designed: each measure with the most that
/// is allowed, over the clearance and in fast time.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SineLimits(Vec<(Measure, f64)>);

impl SineLimits {
    /// Of these limits; of displacement alone they ask for what nobody asks for, the smallest one.
    pub fn of(limits: impl Iterator<Item = (Measure, f64)>) -> Self {
        let all: Vec<(Measure, f64)> = limits.collect();
        let is_of_one = all.iter().all(|(of, _)| is_of_displacement(*of));
        Self(if is_of_one { Vec::new() } else { all })
    }

    /// Whether displacement alone is asked for.
    pub fn is_of_displacement(&self) -> bool {
        self.0.is_empty()
    }

    /// [`missed_with`] along a band of a structure with a damper that lets it move by this amplitude.
    pub fn missed(&self, along: &BandSystems<'_>, amplitude: impl Fn(&System) -> f64) -> f64 {
        let over =
            |(of, most): &(Measure, f64)| (*of, of.largest_of_sines(along, &amplitude) / most);
        let over: Vec<(Measure, f64)> = self.0.iter().map(over).collect();
        let bare = if over.is_empty() { f64::NAN } else { along.largest(bare_amplitude).1 };
        missed_with(&over, [along.largest(&amplitude).1, bare])
    }
}

/// By how much limits are missed, of what they are about over what they allow: where all are met the largest, else 1 and the
/// logarithms of those above 1: a design that misses a limit which none meets is still better the more of the others it meets.
pub fn missed(over: &[f64]) -> f64 {
    let by = over.iter().filter(|one| **one > 1.0).map(|one| libm::log(*one));
    let by: f64 = by.sum();
    if by > 0.0 { 1.0 + by } else { over.iter().copied().fold(0.0, f64::max) }
}

#[cfg(test)]
mod tests {
    use super::missed;

    #[test]
    fn what_nothing_meets_leaves_the_others_their_say() {
        // Of limits that are met the tightest, of one alone its own order.
        assert_eq!(missed(&[0.3, 0.9]), 0.9);
        let order = [0.2, 0.99, 1.0, 1.01, 5.0, f64::INFINITY].map(|one| missed(&[one]));
        assert!(order.windows(2).all(|pair| pair[0] < pair[1]), "{order:?}");
        // One that is eleven times too much: the better design is that which meets the other.
        assert!(missed(&[11.0, 0.9]) < missed(&[10.9, 1.5]));
    }
}
