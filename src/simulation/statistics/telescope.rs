//! The integrals of a period from impacts alone.
//!
//! In flight the oscillator is `x = Re(z + u)`, a free phasor `z` that turns with `p = -d + i w` and a steady
//! one `u` that turns with `i Omega`, so the five integrals of [`super::super::integrals`] are what five
//! products of `z` and `u` gain in flights, over `2 p`, `2 Re p`, `p + i Omega`, `p - i Omega` and `2 i Omega`;
//! over a period, what they lose at impacts, where only the oscillator's velocity jumps. A flight is then
//! searched for its peak only where bounds do not rule one out.

use super::super::integrals::{Five, Phasor, Product, Ringing, Turning};
use super::super::phasor::{Rates, Steady};
use crate::system::State;

/// Damping ratio below which products are not known well enough: the quotients lose as many digits as the
/// square of the ring-down time has.
const LEAST_DAMPING: f64 = 1e-4;
/// What turns impacts into integrals.
#[derive(Debug, Clone)]
pub(super) struct Telescope {
    of: Ringing,
    /// Of `x^2` and `x'^2`.
    squares: [Product; 2],
    /// Size of `p^2 + Omega^2`.
    bend: f64,
    /// Turn of `z` as `u` sees it, squared.
    drift: f64,
    /// Phasors where the flight under way began.
    z: Phasor,
    u: Phasor,
    /// By how much the products have grown over the flights of this period, but for their value where the
    /// flight under way began.
    grown: Products,
    /// Time in sustained contact in this period.
    contact: f64,
}

/// What the five integrals are gains of.
#[derive(Debug, Clone, Copy, Default)]
struct Products {
    zz: Phasor,
    size: f64,
    zu: Phasor,
    zu_conj: Phasor,
    uu: Phasor,
}

impl Products {
    fn of(z: Phasor, u: Phasor) -> Self {
        Self { zz: z * z, size: z.norm_sqr(), zu: z * u, zu_conj: z * u.conj(), uu: u * u }
    }

    /// Adds so many times others.
    fn add(&mut self, times: f64, other: &Self) {
        self.zz += other.zz * times;
        self.size += other.size * times;
        self.zu += other.zu * times;
        self.zu_conj += other.zu_conj * times;
        self.uu += other.uu * times;
    }

    /// Adds what a jump of the free phasor takes away.
    fn jump(&mut self, before: Phasor, after: Phasor, u: Phasor) {
        let lost = before - after;
        self.zz += lost * (before + after);
        self.size += before.norm_sqr() - after.norm_sqr();
        self.zu += lost * u;
        self.zu_conj += lost * u.conj();
    }
}

impl Telescope {
    pub(super) fn begin(ringing: Option<Ringing>, start: State) -> Option<Self> {
        let of = ringing?;
        let Ringing { pole, turn, steady, .. } = of;
        if -pole.re < LEAST_DAMPING * pole.im {
            return None;
        }
        let one = Phasor::new(1.0, 0.0);
        let squares = [[one, one], [pole, turn]].map(|form| Product::of(form, form));
        let mut telescope = Self {
            of,
            squares,
            bend: (pole * pole - turn * turn).norm_sqr().sqrt(),
            drift: (pole - turn).norm_sqr(),
            z: one,
            u: steady,
            grown: Products::default(),
            contact: 0.0,
        };
        telescope.depart(&start, of.rates.origin);
        Some(telescope)
    }

    fn free(&self, x: f64, v: f64, u: Phasor) -> Phasor {
        let Rates { frequency, decay, inverse_ringing, .. } = self.of.rates;
        let (free, velocity) = (x - u.re, v + frequency * u.im);
        Phasor::new(free, -(velocity + decay * free) * inverse_ringing)
    }

    fn phasors(&self, state: &State, steady: Steady<f64>) -> (Phasor, Phasor) {
        let u = Phasor::new(steady.x, -steady.v * self.of.rates.inverse_frequency);
        (self.free(state.x, state.x_velocity, u), u)
    }

    /// A flight begins.
    fn depart(&mut self, from: &State, steady: Steady<f64>) {
        (self.z, self.u) = self.phasors(from, steady);
        self.grown.add(-1.0, &Products::of(self.z, self.u));
    }

    /// No flight is under way any more; by how much the products have grown.
    fn arrive(&mut self) -> Products {
        self.grown.add(1.0, &Products::of(self.z, self.u));
        self.grown
    }

    /// The absorber was carried for a time, after which a flight begins.
    pub(super) fn carried(&mut self, duration: f64, from: &State, steady: Steady<f64>) {
        self.contact += duration;
        self.arrive();
        self.depart(from, steady);
    }

    /// A flight ends in a state, from which the next goes on with the oscillator's velocity `v`; whether it may
    /// have reached beyond a displacement that is known.
    pub(super) fn jump(
        &mut self,
        from: f64,
        end: &State,
        steady: Steady<f64>,
        v: f64,
        flight: Reach,
    ) -> bool {
        let (z, u) = self.phasors(end, steady);
        let eighth = 0.125 * flight.duration * flight.duration;
        // Within the circle of z + u, which bends away from its chord by no more than an eighth of the
        // squared duration times the largest second derivative; and above the higher end by no more
        // than that of x = Re(z + u) itself, x'' = -Omega^2 x + Re((p^2 + Omega^2) z).
        let free = self.z.norm_sqr().sqrt();
        let circle = (self.z + self.u).norm_sqr().max((z + u).norm_sqr()).sqrt();
        let by_circle = circle + eighth * self.drift * free;
        let bend = self.of.rates.squared * by_circle + self.bend * free;
        let by_bend = from.abs().max(end.x.abs()) + eighth * bend;
        let after = self.free(end.x, v, u);
        self.grown.jump(z, after, u);
        (self.z, self.u) = (after, u);
        by_bend > flight.known && by_circle > flight.known
    }

    /// Integrals of `x^2` and `x'^2` over the flights of a period that is over.
    pub(super) fn end_period(&mut self, period: f64) -> [f64; 2] {
        let grown = self.arrive();
        let Ringing { pole, over, .. } = self.of;
        let turning = |integral: Phasor| Turning { re: integral.re, im: integral.im };
        let five = Five {
            zz: turning(grown.zz * over.zz),
            size: grown.size / (2.0 * pole.re),
            ze: turning(grown.zu * over.ze),
            ze_conj: turning(grown.zu_conj * over.ze_conj),
            ee: turning(grown.uu * over.ee),
            duration: (period - self.contact) * self.of.steady.norm_sqr(),
        };
        self.contact = 0.0;
        self.grown = Products::default();
        self.grown.add(-1.0, &Products::of(self.z, self.u));
        self.squares.map(|square| square.over(&five))
    }
}

/// How far a flight may have reached.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reach {
    pub duration: f64,
    /// Displacement that has been reached for certain.
    pub known: f64,
}
