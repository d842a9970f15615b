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

/// The start from rest: the absorber lies halfway between the middle of its cavity and a wall, as it does
/// on average if it may lie anywhere. Exactly in the middle the slightest push would wake it.
pub const FROM_REST: State = State { y: 0.5, ..State::AT_REST };

/// So many starts of a system: the one from rest; the oscillator on its steady motion, the absorber at rest
/// in the middle, or over the oscillator where the motion is too large for that; then others evenly spread;
/// at least one.
///
/// Where the steady motion is smaller than the clearance the second start leads to the motion without
/// impacts, often the largest there is, which of 64 evenly spread starts none leads to.
pub fn of(system: &System, count: u32) -> impl Iterator<Item = State> + use<> {
    let sample = StartBox::around(system);
    let steady = system.linear_response().map(|linear| {
        let state = linear.state(system);
        if linear.amplitude() < 1.0 { state } else { State { y: state.x, ..state } }
    });
    let spread = (0..).map(move |index| sample.start(index));
    [FROM_REST].into_iter().chain(steady).chain(spread).take(count.max(1) as usize)
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
        Self { reach: 1.2 * linear.clamp(1.0, LARGEST) }
    }

    /// The `index`-th start: oscillator anywhere in the box, absorber anywhere in its cavity.
    pub fn start(&self, index: u32) -> State {
        let coordinates = PRIMES.map(|prime| {
            let position = (0.5 + prime.sqrt() * f64::from(index + 1)).fract();
            2.0 * position - 1.0
        });
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
    use crate::system::{Cavity, Excitation, Parameters};

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

    #[test]
    fn the_first_start_is_from_rest_halfway_to_a_wall() {
        let parameters = Parameters {
            mass_ratio: 0.01,
            damping: 2.0,
            restitution: 0.6,
            frequency_ratio: 1.0,
            forcing_per_clearance: 3.0,
            excitation: Excitation::BaseDisplacement,
            cavity: Cavity::IDEAL,
        };
        let system = System::new(parameters).expect("valid");
        let starts: Vec<State> = of(&system, 5).collect();
        assert_eq!(starts[0], State { x: 0.0, x_velocity: 0.0, y: 0.5, y_velocity: 0.0 });
        let sample = StartBox::around(&system);
        let steady = system.linear_response().expect("damped");
        assert!(steady.amplitude() > 1.0 && starts[1].relative_displacement() == 0.0);
        assert_eq!(starts[1].x, steady.state(&system).x);
        assert_eq!(starts[2..], [0, 1, 2].map(|k| sample.start(k)));
        assert_eq!(of(&system, 0).count(), 1);
    }
}
