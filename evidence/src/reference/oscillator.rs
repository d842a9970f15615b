//! The oscillator of equation (1) together with its excitation: `z = (x, x', sin, cos)` with `z' = A z`, a linear
//! system whose Taylor series is summed in multiple precision. No closed form is solved for, so that
//! damping of any size and resonance without damping need no case of their own.

use super::real::{BITS, Decimal};
use vinesink::system::{Excitation, System};

/// Halvings of the scan's step for which the way is known in advance.
pub(super) const LEVELS: usize = 40;
/// Steps of the scan in the shortest period, or decay time, of the motion.
const SCAN: f64 = 64.0;
/// Terms of a series over a step, in which `abs(A s)` is below 0.3: the last is below 1e-83 of the first.
const TERMS: u32 = 48;

/// Displacement, velocity, sine and cosine of the excitation's phase.
pub(super) type Vector = [Decimal; 4];

/// An oscillator with its excitation, per unit of its own mass.
pub(super) struct ReferenceOscillator {
    damping: Decimal,
    stiffness: Decimal,
    omega: Decimal,
    /// Of sine and cosine of the phase.
    force: [Decimal; 2],
    /// By halvings of the scan's step: its length, and what becomes of each unit vector.
    steps: Vec<(Decimal, [Vector; 4])>,
}

/// Where a motion is, a time `s` after it began.
#[derive(Clone)]
pub(super) struct TimePoint {
    pub s: Decimal,
    pub z: Vector,
}

impl ReferenceOscillator {
    /// The oscillator of a system that carries `added` mass, relative to its own.
    pub(super) fn new(system: &System, added: &Decimal) -> Self {
        let p = system.parameters();
        let one = Decimal::of(1.0);
        let mass = &one + added;
        let omega = Decimal::of(p.frequency_ratio);
        let damping = &Decimal::of(p.mass_ratio) * &Decimal::of(p.damping);
        let sine = &Decimal::of(p.mass_ratio) * &Decimal::of(p.forcing_per_clearance);
        let cosine = match p.excitation {
            Excitation::BaseDisplacement => &(&damping * &omega) * &sine,
            Excitation::Force => Decimal::of(0.0),
        };
        let force = [&sine / &mass, &cosine / &mass];
        let (damping, stiffness) = (&damping / &mass, &one / &mass);
        let fastest = 1.0_f64.max(p.frequency_ratio).max(damping.to_f64());
        let mut oscillator = Self { damping, stiffness, omega, force, steps: Vec::new() };
        let mut length = Decimal::of(std::f64::consts::TAU / (SCAN * fastest));
        for _ in 0..=LEVELS {
            let units = [0, 1, 2, 3].map(|k| {
                let unit = [0, 1, 2, 3].map(|j| Decimal::of(f64::from(u8::from(j == k))));
                oscillator.series(&unit, &length)
            });
            oscillator.steps.push((length.clone(), units));
            length = &length / &Decimal::of(2.0);
        }
        oscillator
    }

    /// `A z`: velocity, acceleration by equation (1), and the turn of the excitation.
    pub(super) fn rate(&self, [x, v, sin, cos]: &Vector) -> Vector {
        let [p, q] = &self.force;
        let force = &(p * sin) + &(q * cos);
        let a = &(&force - &(&self.damping * v)) - &(&self.stiffness * x);
        [v.clone(), a, &self.omega * cos, -&(&self.omega * sin)]
    }

    /// The sum of `(A s)^k z/k!`.
    fn series(&self, z: &Vector, s: &Decimal) -> Vector {
        let (mut sum, mut term) = (z.clone(), z.clone());
        for k in 1..=TERMS {
            let part = s / &Decimal::of(f64::from(k));
            term = self.rate(&term).map(|rate| &rate * &part);
            sum = std::array::from_fn(|j| &sum[j] + &term[j]);
            if is_nothing(&term, &sum) {
                break;
            }
        }
        sum
    }

    /// Length of the scan's step.
    pub(super) fn scan_step(&self) -> f64 {
        self.steps[0].0.to_f64()
    }

    /// One step further: the scan's step halved `level` times.
    pub(super) fn step(&self, from: &TimePoint, level: usize) -> TimePoint {
        let (length, units) = &self.steps[level];
        let z = std::array::from_fn(|j| {
            let parts = [0, 1, 2, 3].map(|k| &units[k][j] * &from.z[k]);
            &(&parts[0] + &parts[1]) + &(&parts[2] + &parts[3])
        });
        TimePoint { s: &from.s + length, z }
    }

    /// Any time later, or earlier, that is within a step.
    pub(super) fn later(&self, from: &TimePoint, s: &Decimal) -> TimePoint {
        TimePoint { s: &from.s + s, z: self.series(&from.z, s) }
    }
}

/// Whether a term, and so those after it, is too small by far to change a sum.
fn is_nothing(term: &Vector, sum: &Vector) -> bool {
    let least = sum.iter().filter_map(Decimal::exponent).min();
    let most = term.iter().filter_map(Decimal::exponent).max();
    // As many bits again for what a large force makes of the next terms.
    most.is_none_or(|most| least.is_some_and(|least| most < least - 2 * BITS as i32))
}
