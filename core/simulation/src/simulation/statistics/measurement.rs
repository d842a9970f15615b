//! Measures a trajectory: what happens at impacts at once, what happens in flight for several flights
//! together.
//!
//! Every flight is integrated from where it began, which its end has no part in: the balance of energy is a
//! check.

use super::super::events::{AbsorberMotion, Detail, Impact, Observer, Reversal, Segment};
use super::super::integrals::{FlightEnds, Quadrature, Ringing};
use super::super::peaks;
use super::super::sliding::Sliding;
use super::{PeriodRecord, Statistics};
use crate::numerics::lanes::LANES;
use crate::operation_count;
use crate::system::{State, System};

/// Operations of a flight's integrals: its ends, two exponentials, the five and their sums.
const INTEGRALS: u64 = 5 * operation_count::ELEMENTARY + 300;

/// An [`Observer`] that measures [`Statistics`] over whole excitation periods.
///
/// With the system of the crate page, once its transient is over:
///
/// ```
/// # use vinesink_core::system::{Cavity, Excitation, Parameters, System};
/// # let system = System::new(Parameters {
/// #     mass_ratio: 0.032 / 4.168, damping: 1.799, restitution: 0.6, frequency_ratio: 8.0 / 8.349,
/// #     forcing_per_clearance: 4.3417, excitation: Excitation::BaseDisplacement,
/// #     cavity: Cavity::IDEAL,
/// # })?;
/// use vinesink_core::simulation::{Measurement, Simulation};
/// use vinesink_core::system::State;
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
    sliding: Sliding,
    /// Sign of `x' - y'` in the flight under way.
    sense: f64,
    /// Periods at the beginning in which flights are left out.
    without_flights: u64,
    /// Flights that are yet to be measured, and the whole periods before each; after them, where the flight
    /// under way began.
    flights: FlightEnds<[f64; LANES]>,
    periods: [u64; LANES],
    /// How many are yet to be measured: less than [`LANES`].
    open: usize,
}

impl Measurement {
    /// Begins to measure at `start`, at the beginning of an excitation period.
    pub fn begin(system: &System, start: State) -> Self {
        Self::begin_within(system, start, 0.0)
    }

    /// The same at a phase within a period, whose rest is measured as if it were all of it.
    pub fn begin_within(system: &System, start: State, phase: f64) -> Self {
        let mut begun = Self {
            statistics: Statistics::begin(system, start),
            ringing: Ringing::of(system),
            quadrature: Quadrature::of(system),
            sliding: Sliding::of(system),
            sense: Sliding::first_sense(system, &start),
            without_flights: 0,
            flights: FlightEnds::default(),
            periods: [0; LANES],
            open: 0,
        };
        begun.depart(phase, &start);
        begun
    }

    /// The same, but in so many periods at the beginning nothing but impacts and states are noted: flights are
    /// missing in their records and in the sums over the window.
    #[doc(hidden)]
    pub fn after(periods: u64, system: &System, start: State) -> Self {
        Self { without_flights: periods, ..Self::begin(system, start) }
    }

    /// The same, its records in the memory of another that is over.
    #[doc(hidden)]
    pub fn with_memory(mut self, mut records: Vec<PeriodRecord>) -> Self {
        records.clear();
        self.statistics.records = records;
        self
    }

    /// That memory, once nobody asks for records any more.
    #[doc(hidden)]
    pub fn take_memory(&mut self) -> Vec<PeriodRecord> {
        std::mem::take(&mut self.statistics.records)
    }

    fn leaves_flights_out(&self) -> bool {
        self.statistics.periods < self.without_flights
    }

    /// What has been measured so far.
    pub fn statistics(&mut self) -> &Statistics {
        self.measure_open();
        &self.statistics
    }

    /// A flight begins.
    #[inline(always)]
    fn depart(&mut self, phase: f64, from: &State) {
        let (flights, lane) = (&mut self.flights, self.open);
        flights.phase[0][lane] = phase;
        flights.x[0][lane] = from.x;
        flights.v[0][lane] = from.x_velocity;
        flights.y[lane] = from.y;
        flights.y_velocity[lane] = from.y_velocity;
        flights.y_acceleration[lane] = self.sliding.acceleration(self.sense);
        flights.rest[lane] = self.sliding.rest(self.sense);
    }

    /// A flight ends in a state. It is kept to be measured.
    #[inline(always)]
    fn end_flight(&mut self, phase: f64, end: &State) {
        if self.leaves_flights_out() {
            return;
        }
        let (flights, lane) = (&mut self.flights, self.open);
        let slid = end.relative_displacement() - (flights.x[0][lane] - flights.y[lane]);
        self.statistics.slides(slid);
        let Some(ringing) = &self.ringing else { return };
        flights.phase[1][lane] = phase;
        flights.x[1][lane] = end.x;
        flights.v[1][lane] = end.x_velocity;
        let from = flights.x[0][lane];
        let peak = &mut self.statistics.current.peak;
        *peak = peak.max(from.abs()).max(end.x.abs());
        let duration = (phase - flights.phase[0][lane]) * ringing.rates.inverse_frequency;
        if duration <= 0.0 {
            return;
        }
        self.periods[lane] = self.statistics.periods;
        self.open += 1;
        if self.open == LANES {
            self.measure_open();
        }
    }

    /// Measures the flights that are kept.
    #[inline(never)]
    fn measure_open(&mut self) {
        let Some(ringing) = &self.ringing else { return };
        let open = std::mem::take(&mut self.open);
        if open == 0 {
            return;
        }
        operation_count::note(INTEGRALS * open as u64);
        // Those that are left have no duration.
        let FlightEnds { phase: [begin, end], .. } = &mut self.flights;
        end[open..].copy_from_slice(&begin[open..]);
        let mut measured = peaks::Contribution::default();
        peaks::together(ringing, &self.flights, &mut measured);
        let mut lane = 0;
        for flights in self.periods[..open].chunk_by(|one, next| one == next) {
            let lanes = lane..lane + flights.len();
            lane = lanes.end;
            let all = lanes.map(|lane| (measured.peaks[lane], measured.integrals.at(lane)));
            self.statistics.add(flights[0], all);
        }
        if open < LANES {
            self.flights.begin_like(open, 0);
        }
    }
}

impl Observer for Measurement {
    fn detail(&self) -> Detail {
        if self.ringing.is_none() { Detail::Flights } else { Detail::Events }
    }

    fn segment(&mut self, segment: &Segment) {
        let Segment { absorber, duration, .. } = *segment;
        let flies = matches!(absorber, AbsorberMotion::Flying { .. });
        if self.leaves_flights_out() || self.ringing.is_some() && flies {
            return;
        }
        let (peak, integrals) = (self.quadrature.peak(segment), self.quadrature.over(segment));
        self.statistics.add(self.statistics.periods, std::iter::once((peak, integrals)));
        self.sense = match absorber {
            AbsorberMotion::Flying { .. } => return,
            AbsorberMotion::Carried(side) => {
                self.statistics.contact.duration_tau += duration;
                -side.sign()
            }
            AbsorberMotion::Held { .. } => {
                let pull = segment.motion.acceleration(duration, segment.motion.at(duration));
                (pull - self.sliding.gravity).signum()
            }
        };
        let phase = segment.phase + self.statistics.system.frequency_ratio() * duration;
        self.depart(phase, &segment.at(duration));
    }

    fn impact(&mut self, impact: &Impact) {
        let before = impact.state_before();
        let (x_velocity, y_velocity) = (impact.x_velocity_after, impact.y_velocity_after);
        self.end_flight(impact.phase, &before);
        self.sense = -impact.side.sign();
        self.depart(impact.phase, &State { x_velocity, y_velocity, ..before });
        self.statistics.impact(impact);
    }

    fn sticks(&mut self, loss: f64) {
        self.statistics.sticks(loss);
    }

    fn reversal(&mut self, reversal: &Reversal) {
        let Reversal { phase, state, after, .. } = reversal;
        self.end_flight(*phase, state);
        self.sense = *after;
        self.depart(*phase, state);
    }

    fn period(&mut self, state: &State) {
        self.end_flight(std::f64::consts::TAU, state);
        self.depart(0.0, state);
        self.statistics.period(state);
    }
}

#[cfg(test)]
mod tests;
