//! What the time that an impact takes does to a motion.
//!
//! The model's impacts take no time. One of a time `T` on a wall that is a linear spring and damper without tension acts
//! like one of no time with the clearance `b + s v T` and the restitution `r + q a T/v`, to first order in `T`: `v` is the relative
//! speed towards the wall and `a` the relative acceleration towards it just before, `s` the share of the contact after which its impulse
//! acts.

use std::f64::consts::PI;

use crate::motions::Motion;
use crate::numerics::bracket::bisected;
use crate::simulation::{
    Impact, ModalImpact, ModalObserver, ModalSimulation, Observer, Segment, Simulation,
};
use crate::system::{ModalState, ModalSystem, System};

/// What impacts are like: mean speed towards the wall, and mean acceleration towards it just before, in units that belong to a clearance and
/// a time.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Impacts {
    /// `v`.
    pub speed: f64,
    /// `a`.
    pub acceleration: f64,
}

impl Impacts {
    /// The clearance and restitution without a contact time that act like these with one.
    pub fn act_like(self, [clearance, restitution]: [f64; 2], time: f64) -> [f64; 2] {
        let Self { speed, acceleration } = self;
        let [s, q] = pad(restitution);
        let shifted = restitution + q * acceleration * time / speed;
        [clearance + s * speed * time, shifted.clamp(0.0, 1.0)]
    }
}

/// `s` and `q` of a wall that is a linear spring and damper and lets go where its force is zero, by its restitution.
pub fn pad(restitution: f64) -> [f64; 2] {
    if restitution <= 0.0 {
        // The harder it is damped, the sooner its impulse has acted.
        return [0.0, 1.0];
    }
    // r = exp(-z T w), and T w from the zero of its force: it falls with the damping ratio z.
    let off = |z: f64| libm::exp(-z * duration(z)) - restitution;
    let z = bisected([0.0, MOST_DAMPED], off).unwrap_or_default();
    let s = (restitution + 2.0 * z * restitution / duration(z)) / (1.0 + restitution);
    [s, (1.0 + restitution) * (1.0 - 2.0 * s)]
}

/// Damping ratio beyond which the restitution is below 1e-7.
const MOST_DAMPED: f64 = 1e3;

/// Contact time of such a wall over `1/w` of its undamped oscillation, by its damping ratio.
fn duration(z: f64) -> f64 {
    let square = 1.0 - z * z;
    if square > 1e-8 {
        let w = square.sqrt();
        (PI - libm::atan2(2.0 * z * w, 1.0 - 2.0 * z * z)) / w
    } else if square < -1e-8 {
        let w = (-square).sqrt();
        libm::atanh(2.0 * z * w / (2.0 * z * z - 1.0)) / w
    } else {
        2.0
    }
}

/// Excitation periods in which impacts are looked at, and of several modes as many that are left out before, over the decay of
/// the slowest.
const PERIODS: u64 = 64;
const DECAYS: f64 = 8.0;
const MOST_IMPACTS: u64 = 100_000;

/// Adds up what impacts are like.
#[derive(Default)]
struct Sums {
    impacts: f64,
    speed: f64,
    acceleration: f64,
    /// The structure's acceleration at the end of the last flight.
    last: f64,
}

impl Sums {
    fn add(&mut self, speed: f64, acceleration: f64) {
        self.impacts += 1.0;
        self.speed += speed;
        self.acceleration += acceleration;
    }

    fn mean(&self) -> Option<Impacts> {
        let Self { impacts, speed, acceleration, .. } = *self;
        let found = Impacts { speed: speed / impacts, acceleration: acceleration / impacts };
        (impacts > 0.0 && found.speed > 0.0).then_some(found)
    }
}

impl Observer for Sums {
    fn segment(&mut self, segment: &Segment) {
        let (motion, end) = (&segment.motion, segment.duration);
        self.last = motion.acceleration(end, motion.at(end));
    }

    fn impact(&mut self, impact: &Impact) {
        let speed = impact.x_velocity_before - impact.y_velocity_before;
        self.add(speed.abs(), self.last * impact.side.sign());
    }
}

impl Impacts {
    /// Those of a motion, over the clearance in fast time; none where there are none. An absorber in flight does not accelerate but
    /// along a tilted cavity, where both walls together see no more.
    pub fn of(system: &System, motion: &Motion) -> Option<Self> {
        let mut sums = Sums::default();
        let mut simulation = Simulation::new(system, motion.state(), 0.0).ok()?;
        simulation.run(PERIODS, MOST_IMPACTS, &mut sums);
        sums.mean()
    }
}

/// Those of each absorber of several modes at one excitation.
struct OfAbsorbers {
    each: Vec<Sums>,
    square: f64,
}

impl ModalObserver for OfAbsorbers {
    fn impact(&mut self, impact: &ModalImpact) {
        let speed = impact.x_velocity[0] - impact.y_velocity[0];
        // Nearly harmonic: the acceleration is that of its displacement.
        let acceleration = -self.square * impact.x * impact.side.sign();
        self.each[impact.absorber].add(speed.abs(), acceleration);
    }
}

/// Impacts of each absorber from rest, in the units of the system; none of one that rests.
pub fn of_absorbers(system: &ModalSystem) -> Vec<Option<Impacts>> {
    let frequency = system.frequency_ratio();
    let none = || system.absorbers().iter().map(|_| Sums::default()).collect();
    let mut found = OfAbsorbers { each: none(), square: frequency * frequency };
    let slowest = system.modes().iter().map(|mode| mode.damping_ratio * mode.frequency);
    let slowest = slowest.filter(|rate| *rate > 0.0).fold(f64::INFINITY, f64::min);
    let settling = (DECAYS / slowest / (2.0 * PI / frequency)).min(PERIODS as f64 * 64.0) as u64;
    if let Ok(mut simulation) = ModalSimulation::new(system, &ModalState::AT_REST, 0.0) {
        simulation.run(settling, MOST_IMPACTS, &mut ());
        simulation.run(PERIODS, MOST_IMPACTS, &mut found);
    }
    found.each.iter().map(Sums::mean).collect()
}

#[cfg(test)]
mod tests {
    use super::{Impacts, pad};

    /// The table of a pad by two programs, three digits.
    #[test]
    fn the_impulse_of_a_pad_acts_where_it_should() {
        for (r, s, q) in [
            (0.3, 0.326, 0.454),
            (0.4, 0.364, 0.381),
            (0.5, 0.396, 0.312),
            (0.6, 0.423, 0.246),
            (0.7, 0.446, 0.184),
            (0.8, 0.467, 0.121),
            (0.9, 0.484, 0.061),
            (1.0, 0.5, 0.0),
        ] {
            let [found_s, found_q] = pad(r);
            assert!(
                (found_s - s).abs() < 6e-4 && (found_q - q).abs() < 1.6e-3,
                "{r} {found_s} {found_q}"
            );
        }
        assert!((pad(0.2)[0] - 0.277).abs() < 6e-4);
        // Across critical damping, exp(-2), and down to none.
        let [below, above] = [0.1353, 0.13537].map(|r| pad(r)[0]);
        assert!((below - above).abs() < 1e-4);
        assert!(pad(0.01)[0] > 0.0 && pad(0.01)[0] < pad(0.1)[0]);
        assert_eq!(pad(0.0), [0.0, 1.0]);
    }

    #[test]
    fn the_pair_is_that_of_the_formula() {
        let [b, r] = Impacts { speed: 0.8, acceleration: 6.0 }.act_like([0.016, 0.6], 0.001);
        let [s, q] = pad(0.6);
        assert!((b - 0.016 - s * 0.0008).abs() < 1e-15 && (r - 0.6 - q * 0.0075).abs() < 1e-15);
    }
}
