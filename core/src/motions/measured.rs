//! A motion, or a trajectory, measured in full: statistics, energy, the kind of dynamics, its impacts.

use super::{Effort, Facts, Motion, MotionKind, SettlingTime};
use crate::operation_count;
use crate::regimes::modulation::{self, Amplitudes};
use crate::regimes::periodicity;
use crate::regimes::thresholds::SHORTEST_CAPTURE;
use crate::regimes::{
    Classification, DynamicsKind, Energetics, Lyapunov, Periodicity, Regime, classify,
};
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

/// Most impacts of a trajectory that is measured in full: at a million a second some minutes.
const MOST_IMPACTS: u64 = 200_000_000;
/// How often the window is doubled for a motion whose kind of dynamics is still open: an exponent's error shrinks with the
/// window, and sixteen of them settle all but the rarest intermittency.
const LONGEST_WAIT: u32 = 4;
/// Impacts that are kept, at least: enough for every figure and every average.
const KEPT_IMPACTS: usize = 20_000;

impl Effort {
    /// Periods left out of a trajectory of a system.
    pub fn left_out(&self, system: &System) -> u64 {
        self.discard.unwrap_or_else(|| SettlingTime::of(system).periods)
    }

    /// In which a trajectory is measured in full.
    pub fn window(&self, system: &System) -> Window {
        let discard = self.left_out(system);
        Window { discard, periods: self.periods, impact_limit: MOST_IMPACTS }
    }
}

/// What a window shows. As far as it is of a motion that a search has found, the motion's own numbers stand.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Measured {
    /// The numbers that every motion has.
    pub facts: Facts,
    /// What its impacts do, what kind of dynamics it is, and why.
    pub classification: Classification,
    /// Whether it is over with settling.
    pub settled: bool,
    /// Where it stands at the end of the window, phase 0.
    pub state: State,
    /// Excitation periods from the start to there.
    pub followed: u64,
    /// Why the measurement ended: at the limit on impacts the numbers are those of a part.
    pub stop: Stop,
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

/// Measures a motion in full over the window of an effort; one that wanders for longer, while it is open what kind of
/// dynamics it is. Its impacts are kept in `log`.
///
/// # Errors
/// [`StartError`] if its state is not finite.
pub fn measured(
    system: &System,
    motion: &Motion,
    effort: &Effort,
    log: &mut ImpactLog,
) -> Result<Measured, StartError> {
    let wanders = matches!(motion.kind, MotionKind::Wanders);
    let mut periods = effort.periods;
    let mut longest = log.clone();
    let mut found = Measured::from(system, motion.state, periods, &mut longest)?;
    for _ in 0..LONGEST_WAIT {
        let open = matches!(
            found.classification.dynamics,
            DynamicsKind::TransientNotOver | DynamicsKind::Undecided
        );
        if !wanders || !open {
            break;
        }
        periods = periods.saturating_mul(2);
        longest = log.clone();
        found = Measured::from(system, motion.state, periods, &mut longest)?;
    }
    *log = longest;
    found.facts = motion.facts;
    found.settled = motion.settled;
    found.followed = motion.reached.followed;
    found.classification.regime = motion.regime;
    if let Some(orbit) = motion.orbit() {
        // What is proven stands above what was seen.
        let impacts = u32::try_from(orbit.cycle.impact_count()).unwrap_or(u32::MAX);
        let periods = orbit.cycle.periods();
        found.classification.dynamics = DynamicsKind::Periodic { impacts, periods };
    }
    Ok(found)
}

impl Measured {
    /// Measures a trajectory from a start at excitation phase 0.
    ///
    /// # Errors
    /// [`StartError`] for an impossible start.
    pub fn reach(system: &System, start: State, window: &Window) -> Result<Self, StartError> {
        let mut log = ImpactLog::of_the_last(KEPT_IMPACTS);
        Ok(Self::of(&mut Simulation::new(system, start, 0.0)?, window, &mut log))
    }

    fn from(
        system: &System,
        state: State,
        periods: u64,
        log: &mut ImpactLog,
    ) -> Result<Self, StartError> {
        let window = Window { discard: 0, periods, impact_limit: MOST_IMPACTS };
        Ok(Self::of(&mut Simulation::new(system, state, 0.0)?, &window, log))
    }

    /// A log of as many impacts as every figure and every average needs.
    pub fn log() -> ImpactLog {
        ImpactLog::of_the_last(KEPT_IMPACTS)
    }

    /// Continues a trajectory through its transient and measures what follows, the impacts of the measured window being
    /// kept in `log`.
    pub fn of(simulation: &mut Simulation, window: &Window, log: &mut ImpactLog) -> Self {
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
        let evidence = &classification.evidence;
        let drifts = evidence.periodicity.is_none() && modulation::drifting(statistics.records());
        Self {
            facts: Facts::measured(statistics, evidence),
            settled: !drifts && classification.dynamics != DynamicsKind::TransientNotOver,
            state: simulation.state(),
            followed: simulation.periods(),
            stop,
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
            classification,
        }
    }

    /// What its impacts do.
    pub fn regime(&self) -> Regime {
        self.classification.regime
    }

    /// Whether it was seen to repeat.
    pub fn repeats(&self) -> bool {
        self.classification.evidence.periodicity.is_some()
    }

    /// Whether its amplitude is that of its start: without impacts and damping a free vibration never
    /// fades.
    pub fn keeps_its_start(&self) -> bool {
        let still = self.regime() == Regime::AtRest && self.facts.peak.value > 0.0;
        still && self.energetics.damper_power == 0.0
    }

    /// Every reason not to trust the measurement.
    pub fn doubts(&self) -> Vec<Doubt> {
        simulation::doubts(self.stop, &self.energy, self.penetration, self.facts.peak.value)
    }

    /// The impacts of one repetition, each a complete state of the motion; `None` if it does not
    /// repeat.
    pub fn last_repetition(&self) -> Option<(Periodicity, &[Impact])> {
        let found = self.classification.evidence.periodicity?;
        Some((found, periodicity::last_repetition(found, &self.impacts)?))
    }
}
