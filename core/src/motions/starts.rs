//! Starting states that cover the plausible ones evenly, without randomness.
//!
//! The sequence is Richtmyer's (1951): multiples of the square roots of the first primes, modulo 1.
//! Quadratic irrationals have bounded partial quotients, so that any stretch of it is spread evenly
//! on each axis and shares of starts mean something with a few dozen of them. (Powers of the root of
//! `g^5 = g + 1`, which are even in four dimensions in the long run, begin with one that is 6/7 to
//! three digits and visits seven places only.)

use crate::system::{State, System};

/// One prime for each coordinate.
const PRIMES: [f64; 4] = [2.0, 3.0, 5.0, 7.0];
/// Largest size of a start, over the clearance: near an undamped resonance the linear amplitude
/// says nothing about where motions begin.
const LARGEST: f64 = 10.0;
/// How far starts go, over the linear amplitude.
pub(super) const REACH: f64 = 1.2;

/// The `index`-th place of the sequence on the axis of a prime, from 0 to 1.
pub(super) fn position(prime: f64, index: u32) -> f64 {
    (0.5 + prime.sqrt() * f64::from(index + 1)).fract()
}

/// A start from rest: the absorber lies halfway between the middle of its cavity and a wall, as it does
/// on average if it may lie anywhere. Exactly in the middle the slightest push would wake it.
pub const FROM_REST: State = State { y: 0.5, ..State::AT_REST };

/// So many starts of a system, evenly spread. An absorber at rest needs none: that motion is solved for.
pub fn spread(system: &System, count: u32) -> impl Iterator<Item = State> + use<> {
    let sample = StartBox::around(system);
    (0..count).map(move |index| sample.start(index))
}

/// The box that starts are drawn from, over the clearance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StartBox {
    /// Oscillator displacement and velocity, and absorber velocity, within plus and minus this.
    pub reach: f64,
}

impl StartBox {
    /// A box that holds the linear response and motions as large as the clearance.
    pub fn around(system: &System) -> Self {
        let linear = system.linear_response().map_or(LARGEST, |response| response.amplitude());
        Self { reach: REACH * linear.clamp(1.0, LARGEST) }
    }

    /// The `index`-th start: oscillator anywhere in the box, absorber anywhere in its cavity.
    pub fn start(&self, index: u32) -> State {
        let coordinates = PRIMES.map(|prime| 2.0 * position(prime, index) - 1.0);
        let x = self.reach * coordinates[0];
        State {
            x,
            x_velocity: self.reach * coordinates[1],
            y: x - coordinates[2],
            y_velocity: self.reach * coordinates[3],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn starts_are_inside_the_cavity_and_spread_evenly() {
        let starts: Vec<State> = (0..64).map(|k| StartBox { reach: 2.0 }.start(k)).collect();
        assert!(starts.iter().all(|start| start.relative_displacement().abs() <= 1.0));
        // Each half of each axis gets 32 of 64 starts; an even sequence misses by a few.
        let axes: [fn(&State) -> f64; 4] =
            [|s| s.x, |s| s.x_velocity, State::relative_displacement, |s| s.y_velocity];
        for axis in axes {
            let upper = starts.iter().filter(|start| axis(start) > 0.0).count();
            assert!(upper.abs_diff(32) <= 4, "{upper}");
        }
    }
}
