//! A motion measured in full: statistics, energy, the kind of dynamics, its impacts.

use std::ops::{Deref, DerefMut};

use super::lyapunov::Lyapunov;
use super::modulation::{self, Amplitudes};
use super::motion::within;
use super::thresholds::{IMPACTS_PER_PERIOD, SHORTEST_CAPTURE};
use super::{
    Classification, DynamicsKind, Energetics, Motion, Periodicity, Regime, classify, periodicity,
};
use crate::operation_count;
use crate::simulation::{
    self, Doubt, Energy, Impact, ImpactLog, Measurement, Simulation, StartError, Stop,
    SustainedContact,
};
use crate::system::{State, System};

/// What is measured of a trajectory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    /// Excitation periods left out before.
    pub discard: u64,
    /// Excitation periods measured.
    pub periods: u64,
    /// Largest number of impacts in either.
    pub impact_limit: u64,
}

/// A motion measured in full over a window; as a [`Motion`] it has peak, root mean square and the rest.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Attractor {
    /// The motion.
    pub motion: Motion,
    /// Its regime, and why.
    pub classification: Classification,
    /// First harmonic of the oscillator: coefficients of `sin` and `cos` of the excitation's phase.
    pub oscillator_harmonic: [f64; 2],
    /// The same for the absorber.
    pub absorber_harmonic: [f64; 2],
    /// Energy balance of the measured window.
    pub energy: Energy,
    /// What that balance means for the absorber.
    pub energetics: Energetics,
    /// Sustained contact in the measured window.
    pub sustained_contact: SustainedContact,
    /// Periods measured.
    pub periods: u64,
    /// Impacts in them.
    pub impact_count: u64,
    /// Largest penetration of a wall over the clearance.
    pub penetration: f64,
    /// The last impacts of the measured window.
    pub impacts: Vec<Impact>,
    /// `C`, `E` and the peak in every period that was kept of the measured window.
    pub amplitudes: Vec<Amplitudes>,
}

impl Deref for Attractor {
    type Target = Motion;
    fn deref(&self) -> &Motion {
        &self.motion
    }
}

impl DerefMut for Attractor {
    fn deref_mut(&mut self) -> &mut Motion {
        &mut self.motion
    }
}

/// Impacts that are kept of each attractor, at least: enough for every figure and every average.
const KEPT_IMPACTS: usize = 20_000;
/// Relative difference of `C`, `E` and peak in the last repetition below which two repeating motions
/// with the same impacts are one: a thousand times what a repetition to 1e-6 leaves open.
pub(super) const SAME_PERIODIC: f64 = 1e-3;
/// The same for a motion that is still settling and the one that it settles on.
const SAME_SETTLING: f64 = 0.02;
/// The same for motions that do not repeat, whose averages over some hundred periods scatter.
const SAME_MODULATED: f64 = 0.2;

impl Attractor {
    /// Measures a trajectory from a start at excitation phase 0.
    ///
    /// # Errors
    /// [`StartError`] for an impossible start.
    pub fn reach(system: &System, start: State, window: &Window) -> Result<Self, StartError> {
        Ok(Self::measure(&mut Simulation::new(system, start, 0.0)?, window))
    }

    /// Measures a motion on from where it was left.
    ///
    /// # Errors
    /// [`StartError`] if its state is not finite.
    pub(super) fn of(
        motion: &Motion,
        system: &System,
        window: &Window,
    ) -> Result<Self, StartError> {
        let mut found = Self::reach(system, motion.state, window)?;
        found.followed += motion.followed;
        found.take_extremes_of(motion);
        Ok(found)
    }

    /// Whether its amplitude is that of its start: without impacts and damping a free vibration never
    /// fades.
    pub fn keeps_its_start(&self) -> bool {
        self.regime == Regime::AtRest && self.peak > 0.0 && self.energetics.damper_power == 0.0
    }

    /// Every reason not to trust the measurement.
    pub fn doubts(&self) -> Vec<Doubt> {
        simulation::doubts(self.stop, &self.energy, self.penetration, self.peak)
    }

    /// Continues a trajectory through its transient and measures what follows.
    pub fn measure(simulation: &mut Simulation, window: &Window) -> Self {
        Self::measure_with(simulation, window, &mut ImpactLog::of_the_last(KEPT_IMPACTS))
    }

    /// The same, the impacts of the measured window being kept in `log`.
    pub fn measure_with(simulation: &mut Simulation, window: &Window, log: &mut ImpactLog) -> Self {
        let system = *simulation.system();
        let before = simulation.operations();
        let mut stop = simulation.run(window.discard, window.impact_limit, &mut ());
        let mut measurement = Measurement::begin(&system, simulation.state());
        let mut lyapunov = Lyapunov::begin(&system);
        // A transient given up for its impacts is measured all the same: the impacts are the regime.
        if matches!(stop, Stop::EndTime | Stop::ImpactLimit) {
            let mut counts = (&mut measurement, &mut *log);
            let observer = &mut (&mut counts, &mut lyapunov);
            let measured = simulation.run(window.periods, window.impact_limit, observer);
            stop = if stop == Stop::EndTime { measured } else { stop };
        }
        operation_count::note(simulation.operations() - before);
        let statistics = measurement.statistics();
        let (oscillator_harmonic, absorber_harmonic) = statistics.harmonics();
        let classification =
            classify(statistics, &log.impacts, lyapunov.exponent(), system.period());
        let mut motion = Motion::of(statistics, &classification.evidence, simulation, stop);
        motion.settled &= classification.dynamics != DynamicsKind::TransientNotOver;
        Self {
            motion,
            classification,
            oscillator_harmonic,
            absorber_harmonic,
            energy: statistics.energy(),
            energetics: Energetics::of(&system, statistics),
            sustained_contact: statistics.sustained_contact(),
            periods: statistics.periods(),
            impact_count: statistics.impacts(),
            penetration: statistics.penetration(),
            impacts: log.impacts.clone(),
            amplitudes: modulation::amplitudes(statistics.records(), SHORTEST_CAPTURE),
        }
    }

    /// Whether two trajectories ended in the same long-term motion (or in its mirror image).
    ///
    /// Motions that repeat are one if their impacts are, in number, periods and order of walls, and
    /// rms and peak agree. A motion that is still settling is the one that it settles on. Motions
    /// that never repeat are known by averages only.
    pub fn is_same(&self, other: &Self) -> bool {
        let (mine, theirs) = (&self.classification, &other.classification);
        let same_regime = mine.regime == theirs.regime;
        if same_regime && mine.regime == Regime::AtRest {
            // A damped oscillator has one steady motion without impacts.
            return true;
        }
        match (mine.evidence.periodicity, theirs.evidence.periodicity) {
            (Some(a), Some(b)) => {
                same_regime
                    && (a.impacts, a.periods) == (b.impacts, b.periods)
                    && mine.evidence.sequence == theirs.evidence.sequence
                    && self.repeats_like(other)
            }
            (Some(_), None) => other.settles_on(self),
            (None, Some(_)) => self.settles_on(other),
            (None, None) => {
                let decided = |dynamics| {
                    matches!(dynamics, DynamicsKind::Chaotic | DynamicsKind::QuasiPeriodic)
                };
                let contradict = decided(mine.dynamics)
                    && decided(theirs.dynamics)
                    && mine.dynamics != theirs.dynamics;
                same_regime && !contradict && within(self.rms, other.rms, SAME_MODULATED)
            }
        }
    }

    /// Takes over the other's measurement of the same motion if that one repeats and this does not, and
    /// what is larger in it if neither does.
    pub fn replace_if_settled(&mut self, other: Self) {
        if other.repeats() && !self.repeats() {
            *self = other;
        } else {
            self.take_extremes(&other);
        }
    }

    /// Takes over the larger extremes of another measurement of the same motion, and the errors of the
    /// longer one, where neither repeats and both have settled.
    pub fn take_extremes(&mut self, other: &Self) {
        if other.periods >= self.periods {
            let longer = other.periods > self.periods;
            let error = |own: f64, other: f64| if longer { other } else { own.max(other) };
            if self.scatters_like(other) {
                self.peak_error = error(self.peak_error, other.peak_error);
                self.impact_speed_error = error(self.impact_speed_error, other.impact_speed_error);
            }
        }
        self.take_extremes_of(other);
    }

    fn take_extremes_of(&mut self, other: &Motion) {
        if self.scatters_like(other) {
            self.peak = self.peak.max(other.peak);
            self.impact_speed = self.impact_speed.max(other.impact_speed);
        }
    }

    /// Whether neither of two measurements repeats and both have settled on averages that agree.
    fn scatters_like(&self, other: &Motion) -> bool {
        let scatters = |one: &Motion| one.settled && !one.repeats() && one.stop == Stop::EndTime;
        let alike = self.regime == other.regime && within(self.rms, other.rms, SAME_MODULATED);
        scatters(self) && scatters(other) && alike
    }

    /// Whether this motion, which does not repeat yet, is on its way to the other, which does. Near
    /// the end of its stability a motion takes thousands of periods to settle. Its regime may still
    /// change: what is left of the transient makes intervals unequal.
    fn settles_on(&self, other: &Self) -> bool {
        let visits = |one: &Self| one.classification.evidence.visits_per_period;
        let apart = (visits(self) - visits(other)).abs();
        self.classification.dynamics == DynamicsKind::TransientNotOver
            && apart <= IMPACTS_PER_PERIOD
            && self.is_alike(other, SAME_SETTLING)
    }

    /// Whether the last repetitions of two motions are alike: the window before them may hold the end
    /// of a transient.
    fn repeats_like(&self, other: &Self) -> bool {
        let last = |one: &Self| {
            let periods = one.classification.evidence.periodicity.map_or(1, |found| found.periods);
            let tail = one.amplitudes.len().saturating_sub(periods as usize);
            one.amplitudes[tail..].iter().fold([0.0; 3], |[c, e, peak], at| {
                [c + at.oscillator_amplitude, e + at.absorber_amplitude, peak.max(at.peak)]
            })
        };
        let pairs = last(self).into_iter().zip(last(other));
        pairs.into_iter().all(|(a, b)| within(a, b, SAME_PERIODIC))
    }

    /// The impacts of one repetition, each a complete state of the motion; `None` if it does not
    /// repeat. An exact orbit solver can begin here.
    pub fn last_repetition(&self) -> Option<(Periodicity, &[Impact])> {
        let found = self.classification.evidence.periodicity?;
        Some((found, periodicity::last_repetition(found, &self.impacts)?))
    }
}
