//! Measures a trajectory: what happens at impacts at once, what happens in flight for several flights
//! together, in full or from impacts alone.
//!
//! In full, every flight is integrated from where it began, which its end has no part in: the balance of
//! energy is a check. From impacts alone, nothing is integrated: see [`super::telescope`].

use super::super::events::{Absorber, Detail, Impact, Observer, Segment};
use super::super::integrals::{Ends, Integrals, Quadrature, Ringing};
use super::super::peaks;
use super::super::phasor::Steady;
use super::Statistics;
use super::telescope::{Reach, Telescope};
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
    /// Flights that are yet to be measured, and the whole periods before each; after them, where the flight
    /// under way began.
    flights: Ends<[f64; LANES]>,
    periods: [u64; LANES],
    /// How many are yet to be measured: less than [`LANES`].
    open: usize,
}

impl Measurement {
    /// Begins to measure in full at `start`, at the beginning of an excitation period.
    pub fn begin(system: &System, start: State) -> Self {
        let mut begun = Self {
            statistics: Statistics::begin(system, start),
            ringing: Ringing::of(system),
            quadrature: Quadrature::of(system),
            telescope: None,
            flights: Ends::default(),
            periods: [0; LANES],
            open: 0,
        };
        begun.depart(0.0, &start);
        begun
    }

    /// The same from impacts alone, without harmonics and the excitation's work: the more impacts a period has,
    /// the less it costs beside the other. In full without a damping ratio of 1e-4 or an oscillator that rings.
    pub fn of_impacts(system: &System, start: State) -> Self {
        let in_full = Self::begin(system, start);
        Self { telescope: Telescope::begin(in_full.ringing, start), ..in_full }
    }

    /// What has been measured so far. Of impacts alone, harmonics and the work of the excitation may be missing
    /// and are then 0.
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
    }

    /// A flight ends in a state, from which the oscillator goes on with the velocity `v`. It is kept to be
    /// measured, if that may matter.
    #[inline(always)]
    fn end_flight(&mut self, phase: f64, end: &State, steady: Option<Steady<f64>>, v: f64) {
        let Some(ringing) = &self.ringing else { return };
        let (flights, lane) = (&mut self.flights, self.open);
        flights.phase[1][lane] = phase;
        flights.x[1][lane] = end.x;
        flights.v[1][lane] = end.x_velocity;
        let from = flights.x[0][lane];
        let peak = &mut self.statistics.current.peak;
        *peak = peak.max(from.abs()).max(end.x.abs());
        let duration = (phase - flights.phase[0][lane]) * ringing.rates.inverse_frequency;
        if let Some(telescope) = &mut self.telescope {
            let steady = steady.unwrap_or_else(|| ringing.rates.steady(phase));
            let reach = Reach { duration, known: *peak };
            if !telescope.jump(from, end, steady, v, reach) {
                return;
            }
        }
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
        let in_full = self.telescope.is_none();
        if in_full {
            operation_count::note(INTEGRALS * open as u64);
        }
        // Those that are left have no duration.
        let Ends { phase: [begin, end], .. } = &mut self.flights;
        end[open..].copy_from_slice(&begin[open..]);
        let mut measured = peaks::Measured::default();
        peaks::together(ringing, &self.flights, in_full, &mut measured);
        let mut lane = 0;
        for flights in self.periods[..open].chunk_by(|one, next| one == next) {
            let lanes = lane..lane + flights.len();
            lane = lanes.end;
            let all = lanes
                .map(|lane| (measured.peaks[lane], in_full.then(|| measured.integrals.at(lane))));
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
        let carried = matches!(segment.absorber, Absorber::Carried(_));
        if self.ringing.is_some() && !carried {
            return;
        }
        let (peak, integrals) = (self.quadrature.peak(segment), self.quadrature.over(segment));
        let period = self.statistics.periods;
        self.statistics.add(period, std::iter::once((peak, Some(integrals))));
        if !carried {
            return;
        }
        self.statistics.contact.duration_tau += segment.duration;
        let Some(ringing) = &self.ringing else { return };
        let phase = segment.phase + ringing.rates.frequency * segment.duration;
        let end = segment.at(segment.duration);
        let steady = ringing.rates.steady(phase);
        if let Some(telescope) = &mut self.telescope {
            telescope.carried(segment.duration, &end, steady);
        }
        self.depart(phase, &end);
    }

    fn impact(&mut self, impact: &Impact) {
        let before = impact.state_before();
        let steady = impact.steady.map(|[x, v]| Steady { x, v });
        let (x_velocity, y_velocity) = (impact.x_velocity_after, impact.y_velocity_after);
        self.end_flight(impact.phase, &before, steady, x_velocity);
        self.depart(impact.phase, &State { x_velocity, y_velocity, ..before });
        self.statistics.impact(impact);
    }

    fn sticks(&mut self, loss: f64) {
        self.statistics.sticks(loss);
    }

    fn period(&mut self, state: &State) {
        let origin = self.ringing.map(|ringing| ringing.rates.origin);
        self.end_flight(std::f64::consts::TAU, state, origin, state.x_velocity);
        self.depart(0.0, state);
        if let Some(telescope) = &mut self.telescope {
            let [displacement_squared, velocity_squared] =
                telescope.end_period(self.statistics.system.period());
            let squares =
                Integrals { displacement_squared, velocity_squared, ..Integrals::default() };
            self.statistics.add(self.statistics.periods, std::iter::once((0.0, Some(squares))));
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
    fn impacts_alone_say_what_flights_do() {
        let (mut in_contact, mut without) = (0, 0);
        for system in systems() {
            let mut both =
                (Measurement::of_impacts(&system, START), Measurement::begin(&system, START));
            without += u32::from(both.0.telescope.is_none());
            let mut simulation = Simulation::new(&system, START, 0.0).expect("inside");
            let (of_impacts, in_full) = (&mut both.0, &mut both.1);
            assert_eq!(simulation.run(60, u64::MAX, &mut (of_impacts, in_full)), Stop::EndTime);
            let (mut of_impacts, mut in_full) = both;
            let statistics = in_full.statistics();
            in_contact += u32::from(statistics.sustained_contact().intervals > 0);
            // The antiderivative is as large as the phasors squared over the damping, and is rounded
            // some ten times at each of two ends.
            let size =
                statistics.records().iter().map(|record| record.end.size()).fold(1.0, f64::max);
            let steady = system.linear_response().map_or(0.0, |response| response.amplitude());
            let phasors = (size + steady) * (size + steady);
            let damping = 2.0 * system.mass_ratio() * system.damping();
            let rounded = 40.0 * f64::EPSILON * phasors / damping.max(1e-4);
            for (one, other) in of_impacts.statistics().records().iter().zip(statistics.records()) {
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
            assert!((of_impacts.statistics().peak() / statistics.peak() - 1.0).abs() < 1e-12);
            assert!(
                (of_impacts.statistics().rms() / statistics.rms() - 1.0).abs() < 1e-9,
                "{system:?}"
            );
            let energy = statistics.energy();
            let wanted = (energy.input > 0.0).then(|| energy.impact / energy.input);
            let found = of_impacts.statistics().efficiency();
            let near = found.zip(wanted).map(|(a, b)| (a - b).abs() < 1e-8 * b.max(1.0));
            assert!(near.unwrap_or(found == wanted), "{found:?} {wanted:?} {system:?}");
        }
        assert!(in_contact > 0 && without == 1, "{in_contact} {without}");
    }

    /// What is asked for on the way leaves the flight under way as it is.
    #[test]
    fn statistics_may_be_asked_for_on_the_way() {
        for system in systems() {
            let run = |parts: u64| {
                let mut measurement = Measurement::begin(&system, START);
                let mut simulation = Simulation::new(&system, START, 0.0).expect("inside");
                for _ in 0..parts {
                    // Several flights wait then, seldom as many as are measured together.
                    simulation.run(60 / parts, u64::MAX, &mut measurement);
                    measurement.statistics();
                }
                measurement.statistics().clone()
            };
            let (once, often) = (run(1), run(60));
            assert_eq!(once.impacts(), often.impacts());
            // Exponentials of flights side by side are halved alike: rounding.
            assert!((often.rms() / once.rms() - 1.0).abs() < 1e-13, "{system:?}");
            assert!((often.peak() / once.peak() - 1.0).abs() < 1e-13, "{system:?}");
            let (a, b) = (often.energy().input, once.energy().input);
            assert!((a - b).abs() <= 1e-12 * once.largest_energy.max(b.abs()), "{system:?}");
        }
    }
}
