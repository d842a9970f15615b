//! The mean square of whatever is read in flights, from integrals over them of products of phasors: those of the modes, and that of the
//! excitation.
//!
//! With `x = Re sum_a g_a Z_a`, `x^2 = Re sum_ab (g_a g_b Z_a Z_b + g_a conj(g_b) Z_a conj(Z_b))/2`. A product turns with a rate `w` of
//! its own, `p_a + p_b` or `p_a + conj(p_b)`, so that its integral over a flight is its difference between both ends, over `w`: summed
//! over flights, whatever is read of them. Rounding of a difference grows with `1/abs(w)`; products that are slower than [`SLOW`] are
//! integrated flight by flight. Of `n` flights in a time unit the error is below `n 1e-16/SLOW` of the squared amplitude.

use super::MOST;
use super::motion::{Constants, Phasors};
use crate::simulation::flow::{Phasor, mean_to};

/// Rate below which a product is slow, over the unit of time.
const SLOW: f64 = 1e-3;

/// Those of all pairs, the first no earlier than the second; the excitation stands behind the last mode.
#[derive(Debug, Clone)]
pub(super) struct Products {
    modes: usize,
    /// Of each pair the differences of real and imaginary parts: both real, both imaginary, the first real, the second real.
    differences: [[[f64; 4]; MOST + 1]; MOST + 1],
    /// Rates at which the phasors turn.
    rates: [Phasor; MOST + 1],
    /// Pairs whose products are slow, with their rate and their integral; the second may be conjugated.
    slow: Vec<Slow>,
}

#[derive(Debug, Clone, Copy)]
struct Slow {
    pair: [usize; 2],
    conjugated: bool,
    rate: Phasor,
    integral: Phasor,
}

const NOTHING: Phasor = Phasor::new(0.0, 0.0);

impl Products {
    pub fn of(constants: &Constants<MOST, MOST>, modes: usize) -> Self {
        let mut rates = [NOTHING; MOST + 1];
        for (rate, mode) in rates.iter_mut().zip(&constants.modes).take(modes) {
            *rate = Phasor::new(-mode.decay, mode.ringing);
        }
        rates[modes] = Phasor::new(0.0, constants.frequency);
        let mut slow = Vec::new();
        for a in 0..=modes {
            for b in 0..=a {
                for conjugated in [false, true] {
                    let rate = rates[a] + turned(rates[b], conjugated);
                    if rate.norm_sqr() < SLOW * SLOW {
                        slow.push(Slow { pair: [a, b], conjugated, rate, integral: NOTHING });
                    }
                }
            }
        }
        Self { modes, differences: [[[0.0; 4]; MOST + 1]; MOST + 1], rates, slow }
    }

    /// Adds a flight.
    pub fn add(&mut self, begin: &Phasors<MOST>, end: &Phasors<MOST>, duration: f64) {
        let modes = self.modes;
        // The excitation stands behind the modes; a copy of all phasors would take longer than the sums.
        let phasor = |at: &Phasors<MOST>, k: usize| match k < modes {
            true => at.z[k],
            false => [at.rotor[1], at.rotor[0]],
        };
        for (a, row) in self.differences.iter_mut().enumerate().take(modes + 1) {
            let ([re, im], [later_re, later_im]) = (phasor(begin, a), phasor(end, a));
            for (b, sum) in row.iter_mut().enumerate().take(a + 1) {
                let (of, later) = (phasor(begin, b), phasor(end, b));
                sum[0] += later_re * later[0] - re * of[0];
                sum[1] += later_im * later[1] - im * of[1];
                sum[2] += later_re * later[1] - re * of[1];
                sum[3] += later_im * later[0] - im * of[0];
            }
        }
        for one in &mut self.slow {
            let [a, b] = one.pair.map(|k| {
                let [re, im] = phasor(begin, k);
                Phasor::new(re, im)
            });
            let turn = one.rate * duration;
            let ((sin, cos), size) = (libm::sincos(turn.im), libm::exp(turn.re));
            let mean = mean_to(turn, Phasor::new(size * cos, size * sin));
            one.integral += a * turned(b, one.conjugated) * mean * duration;
        }
    }

    /// The integral of the square of what has these factors of the phasors of modes, and of `sin` and `cos` of the phase, as the
    /// derivative of this order of it.
    pub fn square(&self, shape: &[f64], [sin, cos]: [f64; 2], order: usize) -> f64 {
        let factor = |a: usize| match a == self.modes {
            true => Phasor::new(cos, -sin),
            false => (0..order).fold(Phasor::new(shape[a], 0.0), |of, _| of * self.rates[a]),
        };
        let factors: Vec<Phasor> = (0..=self.modes).map(factor).collect();
        let mut sum = 0.0;
        for (a, first) in factors.iter().enumerate() {
            for (b, second) in factors.iter().enumerate().take(a + 1) {
                let share = if a == b { 0.5 } else { 1.0 };
                for conjugated in [false, true] {
                    let product = first * turned(*second, conjugated);
                    sum += share * (product * self.integral([a, b], conjugated)).re;
                }
            }
        }
        // Of what does not move rounding may be left.
        sum.max(0.0)
    }

    /// The integral of the product of a pair.
    fn integral(&self, pair: [usize; 2], conjugated: bool) -> Phasor {
        let slow = self.slow.iter().find(|one| one.pair == pair && one.conjugated == conjugated);
        slow.map_or_else(
            || {
                let [a, b] = pair;
                let [reals, imaginaries, first, second] = self.differences[a][b];
                let difference = match conjugated {
                    false => Phasor::new(reals - imaginaries, first + second),
                    true => Phasor::new(reals + imaginaries, second - first),
                };
                difference / (self.rates[a] + turned(self.rates[b], conjugated))
            },
            |one| one.integral,
        )
    }

    /// Begins anew.
    pub fn clear(&mut self) {
        self.differences = [[[0.0; 4]; MOST + 1]; MOST + 1];
        self.slow.iter_mut().for_each(|one| one.integral = NOTHING);
    }
}

/// A phasor, or its conjugate.
fn turned(of: Phasor, conjugated: bool) -> Phasor {
    if conjugated { of.conj() } else { of }
}
