//! Long-term motions, found from many starts and matched by what they are.

use serde::Serialize;

use super::lyapunov::Lyapunov;
use super::modulation::{self, Amplitudes};
use super::{
    Classification, DynamicsKind, Energetics, Periodicity, Regime, Thresholds, classify,
    periodicity,
};
use crate::operation_count;
use crate::simulation::{
    self, Doubt, Energy, Impact, ImpactLog, Simulation, StartError, Statistics, Stop,
    SustainedContact,
};
use crate::system::{State, System};

/// How long a trajectory is followed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Effort {
    /// Excitation periods left out as transient.
    pub discard: u64,
    /// Excitation periods measured.
    pub periods: u64,
    /// How often the transient is prolonged while the motion has neither repeated nor settled.
    pub prolongations: u32,
    /// Largest number of impacts in one stretch.
    pub impact_limit: u64,
}

/// What a trajectory became.
#[derive(Debug, Clone, Serialize)]
pub struct Attractor {
    /// Its regime, and why.
    #[serde(flatten)]
    pub classification: Classification,
    /// Largest absolute displacement of the oscillator over the clearance that was seen.
    pub peak: f64,
    /// By how much another window, ten times as long, may exceed that, at odds of 19 to 1, from the largest
    /// values of blocks of this one; 0 where the motion repeats.
    pub peak_error: f64,
    /// Largest relative speed of an impact, over the clearance, in fast time.
    pub impact_speed: f64,
    /// As `peak_error`.
    pub impact_speed_error: f64,
    /// Whether its transient is over: it repeats, or its averages do not drift.
    pub settled: bool,
    /// Root mean square displacement of the oscillator over the clearance.
    pub rms: f64,
    /// Two standard errors of `rms` and of the impacts per period, where the motion does not repeat.
    pub errors: Option<[f64; 2]>,
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
    /// Periods since the start, transient included.
    pub followed: u64,
    /// Why the measurement ended.
    pub stop: Stop,
    /// Largest penetration of a wall over the clearance.
    pub penetration: f64,
    /// A state on the attractor, at excitation phase 0.
    pub state: State,
    /// The last impacts of the measured window.
    #[serde(skip)]
    pub impacts: Vec<Impact>,
    /// `C`, `E` and the peak in every period that was kept of the measured window.
    #[serde(skip)]
    pub amplitudes: Vec<Amplitudes>,
}

/// Impacts that are kept of each attractor, at least: enough for every figure and every average.
const KEPT_IMPACTS: usize = 20_000;
/// Relative difference of `C`, `E` and peak in the last repetition below which two repeating motions
/// with the same impacts are one: a thousand times what a repetition to 1e-6 leaves open.
const SAME_PERIODIC: f64 = 1e-3;
/// The same for a motion that is still settling and the one that it settles on.
const SAME_SETTLING: f64 = 0.02;
/// The same for motions that do not repeat, whose averages over some hundred periods scatter.
const SAME_MODULATED: f64 = 0.2;

impl Attractor {
    /// Follows a trajectory until its transient is over and measures it.
    ///
    /// # Errors
    /// [`StartError`] for an impossible start.
    pub fn reach(system: &System, start: State, effort: &Effort) -> Result<Self, StartError> {
        let mut simulation = Simulation::new(system, start, 0.0)?;
        let mut found = Self::measure(&mut simulation, effort);
        for _ in 0..effort.prolongations {
            let evidence = &found.classification.evidence;
            let resting = evidence.impacts_per_period == 0.0 && evidence.settled;
            if found.stop != Stop::EndTime || evidence.periodicity.is_some() || resting {
                break;
            }
            // A strongly modulated motion never repeats; it only has to be stationary.
            if evidence.settled && evidence.modulation_depth > 0.02 {
                break;
            }
            found = Self::measure(&mut simulation, effort);
        }
        if found.arrived_late() {
            found = Self::measure(&mut simulation, effort);
        }
        Ok(found)
    }

    /// Continues from where this attractor was left, leaves out `discard` periods and measures over
    /// `periods`; twice, if a transient turns out to have ended on the way.
    ///
    /// # Errors
    /// [`StartError`] if the attractor's state is not finite.
    pub fn continued(
        &self,
        system: &System,
        discard: u64,
        periods: u64,
    ) -> Result<Self, StartError> {
        let mut simulation = Simulation::new(system, self.state, 0.0)?;
        let effort = Effort { discard, periods, prolongations: 0, impact_limit: u64::MAX };
        let mut found = Self::measure(&mut simulation, &effort);
        if found.arrived_late() {
            found = Self::measure(&mut simulation, &Effort { discard: 0, ..effort });
        }
        found.take_extremes(self);
        Ok(Self { followed: self.followed + found.followed, ..found })
    }

    /// Whether its amplitude is that of its start: without impacts and damping a free vibration never
    /// fades.
    pub fn keeps_its_start(&self) -> bool {
        let rests = self.classification.regime == Regime::AtRest;
        rests && self.peak > 0.0 && self.energetics.damper_power == 0.0
    }

    /// Every reason not to trust the measurement.
    pub fn doubts(&self) -> Vec<Doubt> {
        simulation::doubts(self.stop, &self.energy, self.penetration, self.peak)
    }

    /// Whether the motion was seen to repeat.
    pub fn repeats(&self) -> bool {
        self.classification.evidence.periodicity.is_some()
    }

    /// Whether the motion repeats at the end of the window but did not from its beginning: a chaotic
    /// transient, which may last thousands of periods, ended within it.
    fn arrived_late(&self) -> bool {
        let evidence = &self.classification.evidence;
        evidence.periodicity.is_some_and(|found| {
            let z = f64::from(found.impacts) / f64::from(found.periods);
            let threshold = Thresholds::default().impacts_per_period;
            (evidence.impacts_per_period - z).abs() > threshold || !evidence.settled
        })
    }

    /// Continues a trajectory through its transient and measures what follows.
    pub fn measure(simulation: &mut Simulation, effort: &Effort) -> Self {
        let mut log = ImpactLog::of_the_last(KEPT_IMPACTS);
        Self::measure_with(simulation, effort, &mut log)
    }

    /// The same, the impacts of the measured window being kept in `log`.
    pub fn measure_with(simulation: &mut Simulation, effort: &Effort, log: &mut ImpactLog) -> Self {
        let system = *simulation.system();
        let before = simulation.operations();
        let mut stop = simulation.run(effort.discard, effort.impact_limit, &mut ());
        let mut statistics = Statistics::begin(&system, simulation.state());
        let mut lyapunov = Lyapunov::begin(&system);
        // A transient given up for its impacts is measured all the same: the impacts are the regime.
        if matches!(stop, Stop::EndTime | Stop::ImpactLimit) {
            let mut counts = (&mut statistics, &mut *log);
            let observer = &mut (&mut counts, &mut lyapunov);
            let measured = simulation.run(effort.periods, effort.impact_limit, observer);
            stop = if stop == Stop::EndTime { measured } else { stop };
        }
        operation_count::note(simulation.operations() - before);
        let thresholds = Thresholds::default();
        let (oscillator_harmonic, absorber_harmonic) = statistics.harmonics();
        let exponent = lyapunov.exponent();
        let period = system.period();
        let classification = classify(&statistics, &log.impacts, exponent, period, &thresholds);
        let repeats = classification.evidence.periodicity.is_some();
        let [peak_error, impact_speed_error] =
            if repeats { [0.0; 2] } else { statistics.errors_of_largest() };
        let open = classification.dynamics == DynamicsKind::TransientNotOver;
        Self {
            settled: repeats || !(open || modulation::drifting(statistics.records())),
            peak_error,
            impact_speed: statistics.impact_speed(),
            impact_speed_error,
            classification,
            errors: (!repeats).then(|| statistics.errors()),
            peak: statistics.peak(),
            rms: statistics.rms(),
            oscillator_harmonic,
            absorber_harmonic,
            energy: statistics.energy(),
            energetics: Energetics::of(&system, &statistics),
            sustained_contact: statistics.sustained_contact(),
            periods: statistics.periods(),
            impact_count: statistics.impacts(),
            followed: simulation.periods(),
            stop,
            penetration: statistics.penetration(),
            state: simulation.state(),
            impacts: log.impacts.clone(),
            amplitudes: modulation::amplitudes(statistics.records(), thresholds.shortest_capture),
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
        let scatter = |one: &Self| one.settled && !one.repeats() && one.stop == Stop::EndTime;
        if !(scatter(self) && scatter(other) && self.is_same(other)) {
            return;
        }
        self.peak = self.peak.max(other.peak);
        self.impact_speed = self.impact_speed.max(other.impact_speed);
        if other.periods > self.periods {
            self.peak_error = other.peak_error;
            self.impact_speed_error = other.impact_speed_error;
        } else if other.periods == self.periods {
            self.peak_error = self.peak_error.max(other.peak_error);
            self.impact_speed_error = self.impact_speed_error.max(other.impact_speed_error);
        }
    }

    /// Whether this motion, which does not repeat yet, is on its way to the other, which does. Near
    /// the end of its stability a motion takes thousands of periods to settle. Its regime may still
    /// change: what is left of the transient makes intervals unequal.
    fn settles_on(&self, other: &Self) -> bool {
        let visits = |one: &Self| one.classification.evidence.visits_per_period;
        let apart = (visits(self) - visits(other)).abs();
        self.classification.dynamics == DynamicsKind::TransientNotOver
            && apart <= Thresholds::default().impacts_per_period
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

    fn is_alike(&self, other: &Self, limit: f64) -> bool {
        within(self.rms, other.rms, limit) && within(self.peak, other.peak, limit)
    }

    /// The impacts of one repetition, each a complete state of the motion; `None` if it does not
    /// repeat. An exact orbit solver can begin here.
    pub fn last_repetition(&self) -> Option<(Periodicity, &[Impact])> {
        let found = self.classification.evidence.periodicity?;
        Some((found, periodicity::last_repetition(found, &self.impacts)?))
    }
}

/// Whether two sizes differ by no more than `limit`, relative to the larger.
fn within(a: f64, b: f64, limit: f64) -> bool {
    (a - b).abs() <= limit * a.max(b)
}
