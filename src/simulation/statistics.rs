//! What is measured along a trajectory: impacts, amplitudes, first harmonics, energy balance.
//!
//! Work of the excitation and loss in the damper are integrated independently of the change of
//! stored energy, in closed form where the oscillator rings and else by quadrature that is exact to
//! rounding, so that the balance is a check and not an identity.

mod impact_statistics;

use std::f64::consts::FRAC_PI_4;

use serde::Serialize;

use super::events::{Absorber, Impact, Observer, Segment, Side};
use super::integrals::{Integrals, Integrator};
use crate::numerics::bracket::brent;
use crate::numerics::quadrature;
use crate::numerics::scatter::{error_of_largest, twice_standard_error};
use crate::operation_count;
use crate::system::{State, System};

pub use impact_statistics::ImpactStatistics;

/// Energy balance over a window, per unit of the oscillator's mass, over the squared clearance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Energy {
    /// Work of the excitation.
    pub input: f64,
    /// Lost in the damper.
    pub damper: f64,
    /// Lost in impacts, including the ends of chattering sequences.
    pub impact: f64,
    /// Change of kinetic and potential energy.
    pub stored: f64,
    /// `abs(input - damper - impact - stored)` over the largest energy that appears in the balance.
    pub relative_residual: f64,
}

/// Time spent in sustained contact.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct SustainedContact {
    /// How often the absorber stuck to a wall.
    pub intervals: u64,
    /// Total fast time it stayed there.
    pub duration_tau: f64,
}

/// What one excitation period looked like.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PeriodRecord {
    /// Impacts on the `+b` and on the `-b` side.
    pub impacts: [u32; 2],
    /// Visits to the walls: as impacts, but a chattering sequence that ended in sustained contact
    /// is one visit, counted where it began.
    pub visits: [u32; 2],
    /// Largest absolute displacement of the oscillator.
    pub peak: f64,
    /// Largest relative speed of an impact.
    pub impact_speed: f64,
    /// Mean square displacement of the oscillator.
    pub mean_square: f64,
    /// Energy lost in the damper and in impacts up to the end of the period.
    pub lost: [f64; 2],
    /// State at the end of the period, phase 0.
    pub end: State,
    /// First harmonic of the absorber: coefficients of `sin` and `cos` of the excitation's phase.
    pub absorber_harmonic: [f64; 2],
    /// The same for the oscillator.
    pub oscillator_harmonic: [f64; 2],
}

/// An [`Observer`] that accumulates over whole excitation periods.
#[derive(Debug, Clone)]
pub struct Statistics {
    system: System,
    integrator: Integrator,
    panel: f64,
    first_panel: f64,
    start: State,
    end: State,
    impacts: u64,
    visits: u64,
    /// Successive impacts on one wall since the last impact on the other or the last contact.
    run: Option<(Side, u32)>,
    peak: f64,
    impact_speed: f64,
    squared: f64,
    input: f64,
    damper: f64,
    impact_loss: f64,
    contact: SustainedContact,
    penetration: f64,
    largest_energy: f64,
    current: Current,
    periods: u64,
    records: Vec<PeriodRecord>,
}

/// Blocks whose averages are compared: fewer say little of their scatter, more are too short to be
/// independent.
const BLOCKS: usize = 10;
/// Blocks whose largest values are compared: as many as leave each some periods of a short window.
const BLOCKS_OF_LARGEST: usize = 16;
/// At least this many of the last periods are kept one by one; sums run over all of them. It bounds
/// the memory of a run of any length, and no regime needs longer to show.
const KEPT: usize = 20_000;

/// Sums of the period under way.
#[derive(Debug, Clone, Copy, Default)]
struct Current {
    impacts: [u32; 2],
    visits: [u32; 2],
    peak: f64,
    impact_speed: f64,
    squared: f64,
    x_harmonic: [f64; 2],
    y_harmonic: [f64; 2],
}

impl Statistics {
    /// Begins to measure at `start`, at the beginning of an excitation period.
    pub fn begin(system: &System, start: State) -> Self {
        let oscillating = 1.0_f64.max(system.frequency_ratio());
        let decaying = oscillating.max(system.mass_ratio() * system.damping());
        Self {
            system: *system,
            integrator: Integrator::of(system),
            panel: FRAC_PI_4 / oscillating,
            first_panel: FRAC_PI_4 / decaying,
            start,
            end: start,
            impacts: 0,
            visits: 0,
            run: None,
            peak: start.x.abs(),
            impact_speed: 0.0,
            squared: 0.0,
            input: 0.0,
            damper: 0.0,
            impact_loss: 0.0,
            contact: SustainedContact::default(),
            penetration: 0.0,
            largest_energy: start.energy(system.mass_ratio()),
            current: Current::default(),
            periods: 0,
            records: Vec::new(),
        }
    }

    /// Whole periods measured.
    pub fn periods(&self) -> u64 {
        self.periods
    }

    /// Impacts in the window.
    pub fn impacts(&self) -> u64 {
        self.impacts
    }

    /// `z`, impacts per excitation period.
    pub fn impacts_per_period(&self) -> f64 {
        self.impacts as f64 / self.periods().max(1) as f64
    }

    /// Visits to a wall per excitation period: as `z`, but a chattering sequence that was seen to end
    /// in sustained contact is one visit, however many impacts it takes.
    pub fn visits_per_period(&self) -> f64 {
        self.visits as f64 / self.periods().max(1) as f64
    }

    /// Largest absolute displacement of the oscillator, over the clearance.
    pub fn peak(&self) -> f64 {
        self.peak
    }

    /// Largest relative speed of an impact, over the clearance, in fast time.
    pub fn impact_speed(&self) -> f64 {
        self.impact_speed
    }

    /// By how much another run, ten times as long, may exceed [`Self::peak`] and [`Self::impact_speed`] of a
    /// motion that does not repeat, at odds of 19 to 1, from their scatter between blocks of the kept periods.
    pub fn errors_of_largest(&self) -> [f64; 2] {
        let length = (self.records.len() / BLOCKS_OF_LARGEST).max(1);
        let error = |value: &dyn Fn(&PeriodRecord) -> f64| {
            let blocks = self.records.chunks_exact(length);
            let largest: Vec<f64> =
                blocks.map(|block| block.iter().map(value).fold(0.0, f64::max)).collect();
            error_of_largest(&largest)
        };
        [error(&|record| record.peak), error(&|record| record.impact_speed)]
    }

    /// Root mean square of the oscillator's displacement, over the clearance.
    pub fn rms(&self) -> f64 {
        let duration = self.periods().max(1) as f64 * self.system.period();
        (self.squared / duration).sqrt()
    }

    /// Two standard errors of [`Self::rms`] and of [`Self::impacts_per_period`], from their scatter
    /// between ten blocks of the kept periods: how well a motion that does not repeat is known.
    pub fn errors(&self) -> [f64; 2] {
        let blocks: Vec<&[PeriodRecord]> =
            self.records.chunks_exact((self.records.len() / BLOCKS).max(1)).collect();
        let error = |value: &dyn Fn(&PeriodRecord) -> f64| {
            let mean =
                |block: &[PeriodRecord]| block.iter().map(value).sum::<f64>() / block.len() as f64;
            let means: Vec<f64> = blocks.iter().map(|block| mean(block)).collect();
            twice_standard_error(&means)
        };
        let impacts = |record: &PeriodRecord| f64::from(record.impacts[0] + record.impacts[1]);
        // The square varies twice as much as its root.
        let rms = error(&|record| record.mean_square) / (2.0 * self.rms()).max(f64::MIN_POSITIVE);
        [rms, error(&impacts)]
    }

    /// Largest penetration of a wall, over the clearance: rounding.
    pub fn penetration(&self) -> f64 {
        self.penetration
    }

    /// Sustained contact in the window.
    pub fn sustained_contact(&self) -> SustainedContact {
        self.contact
    }

    /// One record per period, for the last periods of a long run.
    pub fn records(&self) -> &[PeriodRecord] {
        &self.records
    }

    /// The energy balance over the window.
    pub fn energy(&self) -> Energy {
        let eps = self.system.mass_ratio();
        let stored = self.end.energy(eps) - self.start.energy(eps);
        let gap = self.input - self.damper - self.impact_loss - stored;
        let scale = [self.input.abs(), self.damper, self.impact_loss, self.largest_energy];
        let scale = scale.into_iter().fold(f64::MIN_POSITIVE, f64::max);
        Energy {
            input: self.input,
            damper: self.damper,
            impact: self.impact_loss,
            stored,
            relative_residual: gap.abs() / scale,
        }
    }

    /// Share of the excitation's work that impacts dissipate; none where it does no work. The work is
    /// what becomes of it.
    pub fn efficiency(&self) -> Option<f64> {
        let energy = self.energy();
        let work = energy.stored + energy.damper + energy.impact;
        (work > 0.0).then(|| energy.impact / work)
    }

    /// Mean first harmonics of oscillator and absorber over the kept periods: coefficients of `sin` and `cos`.
    pub fn harmonics(&self) -> ([f64; 2], [f64; 2]) {
        let count = self.records.len().max(1) as f64;
        let mut mean = ([0.0; 2], [0.0; 2]);
        for record in &self.records {
            for k in 0..2 {
                mean.0[k] += record.oscillator_harmonic[k] / count;
                mean.1[k] += record.absorber_harmonic[k] / count;
            }
        }
        mean
    }

    /// A displacement that was reached in a period, the number of whole periods before which is given.
    fn raise(&mut self, period: u64, peak: f64) {
        if period == self.periods {
            self.current.peak = self.current.peak.max(peak);
            return;
        }
        self.peak = self.peak.max(peak);
        let back = (self.periods - period) as usize;
        let record = self.records.len().checked_sub(back);
        if let Some(record) = record.and_then(|at| self.records.get_mut(at)) {
            record.peak = record.peak.max(peak);
        }
    }

    /// Turns the chattering sequence that has just ended into the visit that its first impact began.
    fn close_sequence(&mut self) {
        let Some((side, length)) = self.run.take() else { return };
        let wall = index(side);
        let mut further = length.saturating_sub(1);
        self.visits -= u64::from(further);
        // The latest impacts on this wall are the sequence's; it may have lasted several periods.
        let earlier = self.records.iter_mut().rev().map(|record| &mut record.visits[wall]);
        for visits in std::iter::once(&mut self.current.visits[wall]).chain(earlier) {
            if further == 0 {
                break;
            }
            let here = further.min(*visits);
            *visits -= here;
            further -= here;
        }
    }

    fn integrate(&mut self, segment: &Segment) {
        let sums = match self.integrator.over(segment) {
            Some(sums) => sums,
            None => self.by_quadrature(segment),
        };
        self.squared += sums.displacement_squared;
        self.current.squared += sums.displacement_squared;
        self.input += sums.work;
        self.damper += self.system.mass_ratio() * self.system.damping() * sums.velocity_squared;
        let scale = self.system.frequency_ratio() / std::f64::consts::PI;
        for k in 0..2 {
            self.current.x_harmonic[k] += scale * sums.oscillator[k];
            self.current.y_harmonic[k] += scale * sums.absorber[k];
        }
    }

    fn by_quadrature(&self, segment: &Segment) -> Integrals {
        let omega = self.system.frequency_ratio();
        let (sine, cosine) = self.system.excitation_amplitudes();
        let mut sums = [0.0; 7];
        quadrature::graded_nodes(segment.duration, self.first_panel, self.panel, |s, weight| {
            let State { x, x_velocity, y, .. } = segment.at(s);
            operation_count::note(2 * operation_count::ELEMENTARY + 30);
            let (sin, cos) = libm::sincos(segment.phase + omega * s);
            let force = sine * sin + cosine * cos;
            let terms = [
                x * x,
                x_velocity * x_velocity,
                force * x_velocity,
                x * sin,
                x * cos,
                y * sin,
                y * cos,
            ];
            for (sum, term) in sums.iter_mut().zip(terms) {
                *sum += weight * term;
            }
        });
        let [displacement_squared, velocity_squared, work, x_sin, x_cos, y_sin, y_cos] = sums;
        Integrals {
            displacement_squared,
            velocity_squared,
            work,
            oscillator: [x_sin, x_cos],
            absorber: [y_sin, y_cos],
        }
    }

    /// Largest absolute displacement within a segment: at its ends, or where the velocity changes
    /// sign between two points a panel apart.
    fn find_peak(&mut self, segment: &Segment) {
        if let Some(peak) = self.integrator.peak(segment) {
            self.current.peak = self.current.peak.max(peak);
            return;
        }
        let panels = (segment.duration / self.panel).ceil().max(1.0);
        let step = segment.duration / panels;
        let mut before = segment.motion.at(0.0);
        for k in 0..panels as u64 {
            let from = k as f64 * step;
            let after = segment.motion.at(from + step);
            let mut peak = before.x.abs().max(after.x.abs());
            if (before.v > 0.0) != (after.v > 0.0)
                && let Some(root) = brent(from, from + step, 1e-12, |s| segment.motion.at(s).v)
            {
                peak = peak.max(segment.motion.at(root.at).x.abs());
            }
            self.current.peak = self.current.peak.max(peak);
            before = after;
        }
    }
}

/// Place of a wall in a pair.
fn index(side: Side) -> usize {
    usize::from(side == Side::Minus)
}

impl Observer for Statistics {
    fn segment(&mut self, segment: &Segment) {
        self.integrate(segment);
        self.find_peak(segment);
        if matches!(segment.absorber, Absorber::Carried(_)) {
            self.contact.duration_tau += segment.duration;
        }
    }

    fn impact(&mut self, impact: &Impact) {
        self.impacts += 1;
        let speed = (impact.x_velocity_before - impact.y_velocity_before).abs();
        self.current.impact_speed = self.current.impact_speed.max(speed);
        self.impact_loss += impact.loss;
        self.penetration = self.penetration.max(impact.penetration);
        let wall = index(impact.side);
        self.current.impacts[wall] += 1;
        self.current.visits[wall] += 1;
        self.visits += 1;
        self.run = match self.run {
            Some((side, length)) if side == impact.side => Some((side, length + 1)),
            _ => Some((impact.side, 1)),
        };
    }

    fn sticks(&mut self, loss: f64) {
        self.close_sequence();
        self.impact_loss += loss;
        self.contact.intervals += 1;
    }

    fn period(&mut self, state: &State) {
        let current = std::mem::take(&mut self.current);
        self.peak = self.peak.max(current.peak);
        self.impact_speed = self.impact_speed.max(current.impact_speed);
        self.end = *state;
        self.largest_energy = self.largest_energy.max(state.energy(self.system.mass_ratio()));
        self.periods += 1;
        if self.records.len() >= 2 * KEPT {
            self.records.drain(..KEPT);
        }
        self.records.push(PeriodRecord {
            impacts: current.impacts,
            visits: current.visits,
            peak: current.peak,
            impact_speed: current.impact_speed,
            mean_square: current.squared / self.system.period(),
            lost: [self.damper, self.impact_loss],
            end: *state,
            absorber_harmonic: current.y_harmonic,
            oscillator_harmonic: current.x_harmonic,
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::{Simulation, Stop};
    use crate::system::{Excitation, Parameters};

    /// Compares closed forms with quadrature and, for peaks, with samples, stretch by stretch.
    struct Comparison {
        statistics: Statistics,
        integrator: Integrator,
        compared: u32,
    }

    impl Observer for Comparison {
        fn segment(&mut self, segment: &Segment) {
            let Some(closed) = self.integrator.over(segment) else { return };
            let sampled = self.statistics.by_quadrature(segment);
            self.compared += 1;
            // Either is rounded some fifty times at the size of the motion, or of its free and steady
            // parts, squared, times the duration.
            let (free, velocity) = segment.motion.free();
            let whole = segment.at(0.0);
            let parts = [free, velocity, whole.x, whole.x_velocity, whole.y, whole.y_velocity, 1.0];
            let size = parts.iter().map(|part| part * part).sum::<f64>();
            let (sine, cosine) = self.statistics.system.excitation_amplitudes();
            let slow = 1.0 / self.statistics.system.frequency_ratio().min(1.0);
            let scale = (size + sine * sine + cosine * cosine) * (segment.duration + slow * slow);
            let pairs = [
                (closed.displacement_squared, sampled.displacement_squared),
                (closed.velocity_squared, sampled.velocity_squared),
                (closed.work, sampled.work),
                (closed.oscillator[0], sampled.oscillator[0]),
                (closed.oscillator[1], sampled.oscillator[1]),
                (closed.absorber[0], sampled.absorber[0]),
                (closed.absorber[1], sampled.absorber[1]),
            ];
            for (one, other) in pairs {
                assert!((one - other).abs() < 1e-14 * scale, "{closed:?} {sampled:?} {scale}");
            }
            let Some(peak) = self.integrator.peak(segment) else { return };
            let mut largest = 0.0_f64;
            for k in 0..=400 {
                let at = segment.at(segment.duration * f64::from(k) / 400.0);
                largest = largest.max(at.x.abs());
            }
            // Samples miss a turning point by an eighth of the square of their distance.
            let apart = segment.duration / 400.0;
            let missed = 0.125 * apart * apart * (size.sqrt() * 30.0);
            let noise = 1e-14 * size.sqrt();
            assert!(
                peak >= largest - noise && peak <= largest + missed + noise,
                "{peak} {largest}"
            );
        }
    }

    pub(super) const START: State = State { x: 0.1, x_velocity: 0.4, y: -0.3, y_velocity: 0.2 };

    /// With few and many impacts, chattering, lasting contact, resonance, and hardly any damping or none.
    pub(super) fn systems() -> impl Iterator<Item = System> {
        let all = [
            (0.0077, 1.8, 1.0, 0.6, 2.8),
            (0.0077, 1.8, 0.96, 0.0, 300.0),
            (0.0077, 1.8, 1.01, 0.6, 30.0),
            (0.0077, 0.03, 1.0, 0.8, 3.0),
            (0.0077, 0.0, 1.01, 1.0, 30.0),
            (0.3, 4.0, 0.2, 0.5, 10.0),
            (0.5, 3.0, 4.0, 0.3, 5.0),
            (1e-3, 900.0, 1.3, 0.8, 400.0),
        ];
        let system = |(eps, lambda, omega, r, gamma)| {
            System::new(Parameters {
                mass_ratio: eps,
                damping: lambda,
                restitution: r,
                frequency_ratio: omega,
                forcing_per_clearance: gamma,
                excitation: Excitation::BaseDisplacement,
            })
        };
        all.map(|one| system(one).expect("valid")).into_iter()
    }

    #[test]
    fn closed_forms_agree_with_quadrature_and_samples() {
        let mut compared = 0;
        for system in systems() {
            let mut comparison = Comparison {
                statistics: Statistics::begin(&system, START),
                integrator: Integrator::of(&system),
                compared: 0,
            };
            let mut simulation = Simulation::new(&system, START, 0.0).expect("inside");
            assert_eq!(simulation.run(30, u64::MAX, &mut comparison), Stop::EndTime);
            compared += comparison.compared;
        }
        assert!(compared > 600, "{compared}");
    }
}
