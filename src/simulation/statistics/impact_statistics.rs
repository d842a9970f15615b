//! The same measurements at a fraction of the cost: nothing is integrated, all is taken from impacts.
//!
//! In flight the oscillator is `x = Re(z + u)`, a free phasor `z` that turns with `p = -d + i w` and a
//! steady one `u` that turns with `i Omega`. Therefore `(Re(a z + b u))^2` has the antiderivative
//!
//! `V = Re(a^2 z^2/(4 p)) + |a z|^2/(4 Re p) + Re(a b z u/(p + i Omega)) + Re(a b* z u*/(p - i Omega))
//! + Re(b^2 u^2/(4 i Omega))`
//!
//! beside `|b u|^2/2` per unit of time. `V` is linear in five products of `z` and `u`, so an integral over a
//! period follows from what these lose at its impacts, where only the oscillator's velocity jumps. A flight
//! is searched for its peak where bounds do not rule one out.

use nalgebra::Complex;

use super::super::events::{Absorber, Detail, Impact, Observer, Segment};
use super::super::integrals::Ringing;
use super::super::peaks::{self, Flight, Moment};
use super::super::phasor::{Rates, Steady};
use super::Statistics;
use crate::numerics::lanes::LANES;
use crate::system::{State, System};

type Phasor = Complex<f64>;

/// Damping ratio below which `V` is not known well enough: it loses as many digits as the square of the
/// ring-down time has.
const LEAST_DAMPING: f64 = 1e-4;

/// An [`Observer`] that measures what [`Statistics`] does, but for harmonics and the balance of energy.
/// Without a damping ratio of 1e-4 or an oscillator that rings it is as dear.
#[derive(Debug, Clone)]
pub struct ImpactStatistics {
    statistics: Statistics,
    telescope: Option<Telescope>,
    /// Flights that are yet to be searched for their peaks, several at a time.
    open: Vec<Flight>,
}

/// What turns impacts into integrals.
#[derive(Debug, Clone)]
struct Telescope {
    of: Ringing,
    rates: Rates<f64>,
    frequency: f64,
    displacement: Antiderivative,
    velocity: Antiderivative,
    /// Size of `p^2 + Omega^2`.
    bend: f64,
    /// Turn of `z` as `u` sees it, squared.
    drift: f64,
    /// Where the flight under way began.
    begin: Place,
    /// By how much the products have grown over the flights of this period, but for their value where the
    /// flight under way began.
    grown: Products,
    /// Time in sustained contact in this period.
    contact: f64,
    period: f64,
}

/// A place of a flight.
#[derive(Debug, Clone, Copy)]
struct Place {
    phase: f64,
    x: f64,
    v: f64,
    z: Phasor,
    u: Phasor,
}

/// What the antiderivatives are linear in.
#[derive(Debug, Clone, Copy)]
struct Products {
    zz: Phasor,
    size: f64,
    zu: Phasor,
    zu_conj: Phasor,
    uu: Phasor,
}

impl Products {
    fn at(Place { z, u, .. }: &Place) -> Self {
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

    /// Adds what a jump of the free phasor from `before` to `after` takes away.
    fn jump(&mut self, before: Phasor, after: Phasor, u: Phasor) {
        let lost = before - after;
        self.zz += lost * (before + after);
        self.size += before.norm_sqr() - after.norm_sqr();
        self.zu += lost * u;
        self.zu_conj += lost * u.conj();
    }
}

/// `V` of a linear form `Re(a z + b u)`: coefficients of the products.
#[derive(Debug, Clone, Copy)]
struct Antiderivative {
    of: Products,
    /// `|b|^2/2`.
    rate: f64,
}

impl Antiderivative {
    fn of(a: Phasor, b: Phasor, pole: Phasor, frequency: f64) -> Self {
        let turn = Phasor::new(0.0, frequency);
        let of = Products {
            zz: a * a / (pole * 4.0),
            size: a.norm_sqr() / (4.0 * pole.re),
            zu: a * b / (pole + turn),
            zu_conj: a * b.conj() / (pole - turn),
            uu: b * b / (turn * 4.0),
        };
        Self { of, rate: 0.5 * b.norm_sqr() }
    }

    fn grown(&self, by: &Products) -> f64 {
        let Self { of, .. } = self;
        (of.zz * by.zz).re
            + of.size * by.size
            + (of.zu * by.zu).re
            + (of.zu_conj * by.zu_conj).re
            + (of.uu * by.uu).re
    }
}

impl Telescope {
    fn begin(statistics: &Statistics) -> Option<Self> {
        let system = &statistics.system;
        let of = statistics.integrator.alone()?;
        let rates = statistics.integrator.rates()?;
        let Ringing { pole, .. } = of;
        let frequency = system.frequency_ratio();
        let turn = Phasor::new(0.0, frequency);
        if -pole.re < LEAST_DAMPING * pole.im {
            return None;
        }
        let (zero, one) = (Phasor::new(0.0, 0.0), Phasor::new(1.0, 0.0));
        let mut telescope = Self {
            of,
            rates,
            frequency,
            displacement: Antiderivative::of(one, one, pole, frequency),
            velocity: Antiderivative::of(pole, turn, pole, frequency),
            bend: (pole * pole + frequency * frequency).norm_sqr().sqrt(),
            drift: (pole - turn).norm_sqr(),
            begin: Place { phase: 0.0, x: 0.0, v: 0.0, z: one, u: one },
            grown: Products { zz: zero, size: 0.0, zu: zero, zu_conj: zero, uu: zero },
            contact: 0.0,
            period: system.period(),
        };
        telescope.depart(telescope.place(0.0, statistics.start.x, statistics.start.x_velocity));
        Some(telescope)
    }

    fn place(&self, phase: f64, x: f64, v: f64) -> Place {
        let (sin, cos) = libm::sincos(phase);
        let u = self.of.steady * Phasor::new(cos, sin);
        Place { phase, x, v, z: self.free(x, v, u), u }
    }

    fn free(&self, x: f64, v: f64, u: Phasor) -> Phasor {
        let (free, velocity) = (x - u.re, v + self.frequency * u.im);
        let pole = self.of.pole;
        Phasor::new(free, -(velocity - pole.re * free) / pole.im)
    }

    /// A flight begins at a place.
    fn depart(&mut self, from: Place) {
        self.grown.add(-1.0, &Products::at(&from));
        self.begin = from;
    }

    /// A flight ends at a place, from which the next goes on with the velocity `v`.
    fn jump(&mut self, end: Place, v: f64) {
        let z = self.free(end.x, v, end.u);
        self.grown.jump(end.z, z, end.u);
        self.begin = Place { v, z, ..end };
    }

    /// No flight is under way any more; by how much the products have grown.
    fn arrive(&mut self) -> Products {
        self.grown.add(1.0, &Products::at(&self.begin));
        self.grown
    }

    /// The flight that ends at a place, if it may reach beyond a displacement that is known.
    fn flight(&self, end: &Place, known: f64, period: u64) -> Option<Flight> {
        let begin = &self.begin;
        let duration = (end.phase - begin.phase) / self.frequency;
        let eighth = 0.125 * duration * duration;
        // Within the circle of z + u, which bends away from its chord by no more than an eighth of the
        // squared duration times the largest second derivative; and above the higher end by no more
        // than that of x = Re(z + u) itself, x'' = -Omega^2 x + Re((p^2 + Omega^2) z).
        let size = |one: Phasor| one.norm_sqr().sqrt();
        let free = size(begin.z);
        let circle = size(begin.z + begin.u).max(size(end.z + end.u));
        let by_circle = circle + eighth * self.drift * free;
        let bend = self.frequency * self.frequency * by_circle + self.bend * free;
        let by_bend = begin.x.abs().max(end.x.abs()) + eighth * bend;
        let moment = |place: &Place| Moment {
            x: place.x,
            v: place.v,
            steady: Steady { x: place.u.re, v: -self.frequency * place.u.im },
        };
        (by_bend > known && by_circle > known).then(|| Flight {
            period,
            begin: moment(begin),
            duration,
            end: moment(end),
        })
    }
}

impl ImpactStatistics {
    /// Begins to measure at `start`, at the beginning of an excitation period.
    pub fn begin(system: &System, start: State) -> Self {
        let statistics = Statistics::begin(system, start);
        let telescope = Telescope::begin(&statistics);
        Self { statistics, telescope, open: Vec::with_capacity(LANES) }
    }

    /// What has been measured so far. Harmonics and the work of the excitation may be missing and are then 0.
    pub fn statistics(&mut self) -> &Statistics {
        self.search();
        &self.statistics
    }

    /// A flight ends at a place, from which the oscillator goes on with the velocity `after`. It is kept to be
    /// searched for its peak, if that may matter.
    fn end_flight(&mut self, end: Place, after: f64) {
        let Some(telescope) = &mut self.telescope else { return };
        let peak = &mut self.statistics.current.peak;
        *peak = peak.max(telescope.begin.x.abs()).max(end.x.abs());
        let flight = telescope.flight(&end, *peak, self.statistics.periods);
        telescope.jump(end, after);
        self.open.extend(flight);
        if self.open.len() == LANES {
            self.search();
        }
    }

    /// Searches the flights that are kept.
    fn search(&mut self) {
        let Some(telescope) = &self.telescope else { return };
        if self.open.is_empty() {
            return;
        }
        let peaks = peaks::together(&telescope.rates, &self.open);
        for (flight, peak) in self.open.drain(..).zip(peaks) {
            self.statistics.raise(flight.period, peak);
        }
    }
}

impl Observer for ImpactStatistics {
    fn detail(&self) -> Detail {
        if self.telescope.is_none() { Detail::Flights } else { Detail::Events }
    }

    fn segment(&mut self, segment: &Segment) {
        match (&mut self.telescope, segment.absorber) {
            (None, _) => self.statistics.segment(segment),
            (Some(_), Absorber::Flying { .. }) => {}
            (Some(telescope), Absorber::Carried(_)) => {
                self.statistics.segment(segment);
                let State { x, x_velocity, .. } = segment.at(segment.duration);
                let phase = segment.phase + telescope.frequency * segment.duration;
                telescope.contact += segment.duration;
                telescope.arrive();
                telescope.depart(telescope.place(phase, x, x_velocity));
            }
        }
    }

    fn impact(&mut self, impact: &Impact) {
        if let Some(telescope) = &self.telescope {
            let end = telescope.place(impact.phase, impact.x, impact.x_velocity_before);
            self.end_flight(end, impact.x_velocity_after);
        }
        self.statistics.impact(impact);
    }

    fn sticks(&mut self, loss: f64) {
        self.statistics.sticks(loss);
    }

    fn period(&mut self, state: &State) {
        if let Some(telescope) = &self.telescope {
            let end = telescope.place(0.0, state.x, state.x_velocity);
            self.end_flight(Place { phase: std::f64::consts::TAU, ..end }, state.x_velocity);
        }
        if let Some(telescope) = &mut self.telescope {
            let grown = telescope.arrive();
            let flown = telescope.period - telescope.contact;
            let size = telescope.of.steady.norm_sqr();
            let over = |form: &Antiderivative| form.grown(&grown) + form.rate * size * flown;
            let (squared, velocity_squared) =
                (over(&telescope.displacement), over(&telescope.velocity));
            telescope.contact = 0.0;
            telescope.grown.add(-1.0, &grown);
            telescope.depart(Place { phase: 0.0, ..telescope.begin });
            let statistics = &mut self.statistics;
            statistics.squared += squared;
            statistics.current.mean_square += squared;
            let damping = statistics.system.mass_ratio() * statistics.system.damping();
            statistics.damper += damping * velocity_squared;
        }
        self.statistics.period(state);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::statistics::tests::{START, systems};
    use crate::simulation::{Simulation, Stop};

    /// Against every stretch integrated.
    #[test]
    fn it_measures_what_statistics_do() {
        let (mut in_contact, mut without) = (0, 0);
        for system in systems() {
            let mut both =
                (ImpactStatistics::begin(&system, START), Statistics::begin(&system, START));
            without += u32::from(both.0.telescope.is_none());
            let mut simulation = Simulation::new(&system, START, 0.0).expect("inside");
            let (impact_statistics, statistics) = (&mut both.0, &mut both.1);
            assert_eq!(
                simulation.run(60, u64::MAX, &mut (impact_statistics, statistics)),
                Stop::EndTime
            );
            let (mut impact_statistics, statistics) = both;
            in_contact += u32::from(statistics.sustained_contact().intervals > 0);
            // The antiderivative is as large as the phasors squared over the damping, and is rounded
            // some ten times at each of two ends.
            let size =
                statistics.records().iter().map(|record| record.end.size()).fold(1.0, f64::max);
            let steady = system.linear_response().map_or(0.0, |response| response.amplitude());
            let phasors = (size + steady) * (size + steady);
            let damping = 2.0 * system.mass_ratio() * system.damping();
            let rounded = 40.0 * f64::EPSILON * phasors / damping.max(1e-4);
            for (one, other) in
                impact_statistics.statistics().records().iter().zip(statistics.records())
            {
                assert_eq!(
                    (one.impacts, one.visits, one.end),
                    (other.impacts, other.visits, other.end)
                );
                let (a, b) = (one.mean_square, other.mean_square);
                let visits = f64::from(one.impacts[0] + one.impacts[1] + 1);
                assert!(
                    (a - b).abs() <= visits * rounded + 1e-13 * b,
                    "{a} {b} {rounded} {system:?}"
                );
                assert_eq!(one.impact_speed, other.impact_speed);
                let (a, b) = (one.peak, other.peak);
                assert!((a - b).abs() <= 1e-13 * (size + steady), "{a} {b} {system:?}");
            }
            assert!(
                (impact_statistics.statistics().peak() / statistics.peak() - 1.0).abs() < 1e-12
            );
            assert!(
                (impact_statistics.statistics().rms() / statistics.rms() - 1.0).abs() < 1e-9,
                "{system:?}"
            );
            let energy = statistics.energy();
            let wanted = (energy.input > 0.0).then(|| energy.impact / energy.input);
            let found = impact_statistics.statistics().efficiency();
            let near = found.zip(wanted).map(|(a, b)| (a - b).abs() < 1e-8 * b.max(1.0));
            assert!(near.unwrap_or(found == wanted), "{found:?} {wanted:?} {system:?}");
        }
        assert!(in_contact > 0 && without == 1, "{in_contact} {without}");
    }
}
