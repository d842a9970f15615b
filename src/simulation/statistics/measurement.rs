//! Measures a trajectory: what happens at impacts at once, what happens in flight for several flights
//! together, in full or from impacts alone.
//!
//! In full, every flight is integrated from where it began, which its end has no part in: the balance of
//! energy is a check. From impacts alone, nothing is integrated: in flight the oscillator is `x = Re(z + u)`,
//! a free phasor `z` that turns with `p = -d + i w` and a steady one `u` that turns with `i Omega`, so the five
//! integrals of [`super::super::integrals`] are what five products of `z` and `u` gain in flights, over `2 p`,
//! `2 Re p`, `p + i Omega`, `p - i Omega` and `2 i Omega`; over a period, what they lose at impacts, where only
//! the oscillator's velocity jumps. A flight is then searched for its peak only where bounds do not rule
//! one out.

use super::super::events::{Absorber, Detail, Impact, Observer, Segment};
use super::super::integrals::{Ends, Five, Phasor, Product, Quadrature, Ringing, Turning};
use super::super::peaks;
use super::super::phasor::{Rates, Steady};
use super::Statistics;
use crate::numerics::lanes::LANES;
use crate::operation_count;
use crate::system::{State, System};

/// Damping ratio below which products are not known well enough: the quotients lose as many digits as the
/// square of the ring-down time has.
const LEAST_DAMPING: f64 = 1e-4;
/// Operations of a flight's integrals: its ends, two exponentials, the five and their sums.
const INTEGRALS: u64 = 5 * operation_count::ELEMENTARY + 300;

/// An [`Observer`] that measures [`Statistics`] over whole excitation periods.
///
/// With the system of the crate page, once its transient is over:
///
/// ```
/// # use vinesink::system::{Excitation, Parameters, System};
/// # let system = System::new(Parameters {
/// #     mass_ratio: 0.032 / 4.168, damping: 1.799, restitution: 0.6, frequency_ratio: 8.0 / 8.349,
/// #     forcing_per_clearance: 4.3417, excitation: Excitation::BaseDisplacement,
/// # })?;
/// use vinesink::simulation::{Measurement, Simulation};
/// use vinesink::system::State;
///
/// let mut simulation = Simulation::new(&system, State { y: 0.5, ..State::AT_REST }, 0.0)?;
/// simulation.run(1000, u64::MAX, &mut ());
/// let mut measured = Measurement::begin(&system, simulation.state());
/// simulation.run(100, u64::MAX, &mut measured);
///
/// let statistics = measured.statistics();
/// assert_eq!(statistics.impacts_per_period(), 2.0);
/// assert!((statistics.peak() - 0.475).abs() < 1e-3); // over the clearance
/// // Work and losses are integrated apart from the energy that is stored: the balance is a check.
/// assert!(statistics.energy().relative_residual < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Measurement {
    statistics: Statistics,
    /// Without it stretches are integrated by quadrature.
    ringing: Option<Ringing>,
    quadrature: Quadrature,
    telescope: Option<Telescope>,
    /// Periods at the beginning in which flights are left out.
    without_flights: u64,
    /// Where the flight under way began: phase, state.
    begin: (f64, State),
    /// Flights that are yet to be measured.
    open: Vec<Ends<f64>>,
    /// The whole periods before each.
    periods: Vec<u64>,
}

/// What turns impacts into integrals.
#[derive(Debug, Clone)]
struct Telescope {
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
    fn begin(ringing: Option<Ringing>, start: State) -> Option<Self> {
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

    /// A flight ends in a state, from which the next goes on with the oscillator's velocity `v`; whether it may
    /// have reached beyond a displacement that is known.
    fn jump(&mut self, from: f64, end: &State, steady: Steady<f64>, v: f64, flight: Reach) -> bool {
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
    fn end_period(&mut self, period: f64) -> [f64; 2] {
        let grown = self.arrive();
        let Ringing { pole, turn, .. } = self.of;
        let one = Phasor::new(1.0, 0.0);
        let over = |product: Phasor, rate: Phasor| {
            let integral = product * (one / rate);
            Turning { re: integral.re, im: integral.im }
        };
        let five = Five {
            zz: over(grown.zz, pole * 2.0),
            size: grown.size / (2.0 * pole.re),
            ze: over(grown.zu, pole + turn),
            ze_conj: over(grown.zu_conj, pole - turn),
            ee: over(grown.uu, turn * 2.0),
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
struct Reach {
    duration: f64,
    /// Displacement that has been reached for certain.
    known: f64,
}

impl Measurement {
    /// Begins to measure in full at `start`, at the beginning of an excitation period.
    pub fn begin(system: &System, start: State) -> Self {
        Self {
            statistics: Statistics::begin(system, start),
            ringing: Ringing::of(system),
            quadrature: Quadrature::of(system),
            telescope: None,
            without_flights: 0,
            begin: (0.0, start),
            open: Vec::with_capacity(LANES),
            periods: Vec::with_capacity(LANES),
        }
    }

    /// The same from impacts alone, at a fraction of the cost: without harmonics and the excitation's work. In
    /// full without a damping ratio of 1e-4 or an oscillator that rings.
    pub fn of_impacts(system: &System, start: State) -> Self {
        let in_full = Self::begin(system, start);
        Self { telescope: Telescope::begin(in_full.ringing, start), ..in_full }
    }

    /// The same, and in so many periods at the beginning nothing but impacts and states: their records have
    /// neither peak nor mean square, nor a part in the sums over the window.
    pub(crate) fn of_impacts_after(periods: u64, system: &System, start: State) -> Self {
        Self { without_flights: periods, ..Self::of_impacts(system, start) }
    }

    fn leaves_flights_out(&self) -> bool {
        self.statistics.periods < self.without_flights
    }

    /// What has been measured so far. Of impacts alone, harmonics and the work of the excitation may be missing
    /// and are then 0.
    pub fn statistics(&mut self) -> &Statistics {
        self.measure_open();
        &self.statistics
    }

    /// A flight ends in a state, from which the oscillator goes on with the velocity `v`. It is kept to be
    /// measured, if that may matter.
    fn end_flight(&mut self, phase: f64, end: State, steady: Option<Steady<f64>>, v: f64) {
        let Some(ringing) = &self.ringing else { return };
        if self.leaves_flights_out() {
            return;
        }
        let (from, begin) =
            std::mem::replace(&mut self.begin, (phase, State { x_velocity: v, ..end }));
        let peak = &mut self.statistics.current.peak;
        *peak = peak.max(begin.x.abs()).max(end.x.abs());
        let duration = (phase - from) * ringing.rates.inverse_frequency;
        if let Some(telescope) = &mut self.telescope {
            let steady = steady.unwrap_or_else(|| ringing.rates.steady(phase));
            let reach = Reach { duration, known: *peak };
            if !telescope.jump(begin.x, &end, steady, v, reach) {
                return;
            }
        }
        if duration <= 0.0 {
            return;
        }
        let ends = Ends {
            phase: [from, phase],
            x: [begin.x, end.x],
            v: [begin.x_velocity, end.x_velocity],
            y: begin.y,
            y_velocity: begin.y_velocity,
        };
        self.open.push(ends);
        self.periods.push(self.statistics.periods);
        if self.open.len() == LANES {
            self.measure_open();
        }
    }

    /// Measures the flights that are kept.
    fn measure_open(&mut self) {
        let Some(ringing) = &self.ringing else { return };
        if self.open.is_empty() {
            return;
        }
        let in_full = self.telescope.is_none();
        if in_full {
            operation_count::note(INTEGRALS * self.open.len() as u64);
        }
        let measured = peaks::together(ringing, &self.open, in_full);
        self.open.clear();
        for (period, one) in self.periods.drain(..).zip(measured) {
            self.statistics.add(period, &one);
        }
    }
}

impl Observer for Measurement {
    fn detail(&self) -> Detail {
        if self.ringing.is_none() { Detail::Flights } else { Detail::Events }
    }

    fn segment(&mut self, segment: &Segment) {
        let carried = matches!(segment.absorber, Absorber::Carried(_));
        if self.leaves_flights_out() || self.ringing.is_some() && !carried {
            return;
        }
        let measured = peaks::Measured {
            peak: self.quadrature.peak(segment),
            integrals: Some(self.quadrature.over(segment)),
        };
        self.statistics.add(self.statistics.periods, &measured);
        if !carried {
            return;
        }
        self.statistics.contact.duration_tau += segment.duration;
        let Some(ringing) = &self.ringing else { return };
        let phase = segment.phase + ringing.rates.frequency * segment.duration;
        self.begin = (phase, segment.at(segment.duration));
        if let Some(telescope) = &mut self.telescope {
            telescope.contact += segment.duration;
            telescope.arrive();
            telescope.depart(&self.begin.1, ringing.rates.steady(phase));
        }
    }

    fn impact(&mut self, impact: &Impact) {
        let before = impact.state_before();
        let steady = impact.steady.map(|[x, v]| Steady { x, v });
        self.end_flight(impact.phase, before, steady, impact.x_velocity_after);
        self.begin.1.y_velocity = impact.y_velocity_after;
        self.statistics.impact(impact);
    }

    fn sticks(&mut self, loss: f64) {
        self.statistics.sticks(loss);
    }

    fn period(&mut self, state: &State) {
        let origin = self.ringing.map(|ringing| ringing.rates.origin);
        self.end_flight(std::f64::consts::TAU, *state, origin, state.x_velocity);
        self.begin.0 = 0.0;
        if !self.leaves_flights_out()
            && let Some(telescope) = &mut self.telescope
        {
            let squares = telescope.end_period(self.statistics.system.period());
            self.statistics.add_squares(self.statistics.periods, squares);
        }
        self.statistics.period(state);
        if self.statistics.periods == self.without_flights {
            self.begin.1 = *state;
            self.telescope = Telescope::begin(self.ringing, *state);
        }
    }
}

#[cfg(test)]
mod tests;
