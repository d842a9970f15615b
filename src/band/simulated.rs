//! What simulation finds along a band, from several starts at each place: many trajectories side by
//! side.

use serde::Serialize;

use crate::regimes::starts::StartBox;
use crate::simulation::{
    Impact, Nobody, Observer, Segment, Simulation, StartError, Statistics, Stop, batch,
};
use crate::system::{State, System};

/// E-folds of the damped free motion that are left out: what a start leaves is then below 1e-5.
const FADED: f64 = 12.0;
/// Fewest and most periods left out: a motion needs some to be captured, and hardly damped ones fade
/// by impacts or not at all.
const LEFT_OUT: [f64; 2] = [150.0, 2000.0];
/// Relative difference of root mean squares up to which two motions that hardly scatter are one.
const ALIKE: f64 = 0.01;
/// Impacts in one stretch, per period asked for, at which a trajectory is given up.
const MOST_IMPACTS: u64 = 1000;

/// How thoroughly each place is simulated.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Effort {
    /// Evenly spread starts at each place.
    pub starts: u32,
    /// Excitation periods measured, after a transient that follows from the damping.
    pub periods: u64,
}

impl Default for Effort {
    fn default() -> Self {
        Self { starts: 8, periods: 250 }
    }
}

/// A long-term motion that was simulated. Lengths over the clearance, fast time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Motion {
    /// Largest absolute displacement of the oscillator.
    pub peak: f64,
    /// Root mean square displacement of the oscillator.
    pub rms: f64,
    /// Two standard errors of that, between blocks of the window.
    pub rms_error: f64,
    /// Impacts per excitation period.
    pub impacts_per_period: f64,
    /// Two standard errors of that.
    pub impacts_error: f64,
    /// Largest relative speed of an impact.
    pub impact_speed: f64,
    /// How many of the starts led to it.
    pub starts: u32,
}

impl Motion {
    /// Whether two starts ended in one motion, as far as root mean square and impacts tell.
    fn is_same(&self, other: &Self) -> bool {
        let near =
            |a: f64, b: f64, errors: f64| (a - b).abs() <= (ALIKE * a.max(b)).max(2.0 * errors);
        near(self.rms, other.rms, self.rms_error + other.rms_error)
            && near(
                self.impacts_per_period,
                other.impacts_per_period,
                self.impacts_error + other.impacts_error,
            )
    }
}

/// Measures one trajectory.
struct Watch {
    statistics: Statistics,
    fastest: f64,
}

impl Observer for Watch {
    fn segment(&mut self, segment: &Segment) {
        self.statistics.segment(segment);
    }
    fn impact(&mut self, impact: &Impact) {
        let speed = (impact.x_velocity_before - impact.y_velocity_before).abs();
        self.fastest = self.fastest.max(speed);
        self.statistics.impact(impact);
    }
    fn sticks(&mut self, loss: f64) {
        self.statistics.sticks(loss);
    }
    fn period(&mut self, state: &State) {
        self.statistics.period(state);
    }
}

/// The distinct motions of each system, in the order in which starts led to them.
///
/// # Errors
/// [`StartError`] where a start is not finite.
pub fn motions(systems: &[System], effort: &Effort) -> Result<Vec<Vec<Motion>>, StartError> {
    motions_from(systems, effort, &[])
}

/// The same from further starts as well, those of every system.
///
/// # Errors
/// [`StartError`] where a start is not finite.
pub fn motions_from(
    systems: &[System],
    effort: &Effort,
    further: &[State],
) -> Result<Vec<Vec<Motion>>, StartError> {
    let each = effort.starts as usize + further.len();
    let mut simulations = Vec::with_capacity(systems.len() * each);
    for system in systems {
        let sample = StartBox::around(system);
        let starts = (0..effort.starts).map(|index| sample.start(index));
        for start in starts.chain(further.iter().copied()) {
            simulations.push(Simulation::new(system, start, 0.0)?);
        }
    }
    let left_out = systems.iter().map(left_out).max().unwrap_or(0);
    let mut nobody: Vec<Nobody> = simulations.iter().map(|_| Nobody).collect();
    batch::run(&mut simulations, left_out, left_out * MOST_IMPACTS, &mut nobody);
    let begin = |one: &Simulation| Watch {
        statistics: Statistics::begin(one.system(), one.state()),
        fastest: 0.0,
    };
    let mut watches: Vec<Watch> = simulations.iter().map(begin).collect();
    let limit = effort.periods * MOST_IMPACTS;
    let stops = batch::run(&mut simulations, effort.periods, limit, &mut watches);
    let ended: Vec<(Watch, Stop)> = watches.into_iter().zip(stops).collect();
    Ok(ended.chunks(each.max(1)).map(distinct).collect())
}

/// Periods after which what a start leaves has faded.
fn left_out(system: &System) -> u64 {
    let decay = 0.5 * system.mass_ratio() * system.damping() * system.period();
    (FADED / decay).clamp(LEFT_OUT[0], LEFT_OUT[1]) as u64
}

/// The motions of one system that trajectories have ended in.
fn distinct(ended: &[(Watch, Stop)]) -> Vec<Motion> {
    let mut distinct: Vec<Motion> = Vec::new();
    let measured = |stop: &Stop| matches!(stop, Stop::EndTime | Stop::ImpactLimit);
    for (watch, _) in ended.iter().filter(|(_, stop)| measured(stop)) {
        let statistics = &watch.statistics;
        let [rms_error, impacts_error] = statistics.errors();
        let motion = Motion {
            peak: statistics.peak(),
            rms: statistics.rms(),
            rms_error,
            impacts_per_period: statistics.impacts_per_period(),
            impacts_error,
            impact_speed: watch.fastest,
            starts: 1,
        };
        match distinct.iter_mut().find(|known| known.is_same(&motion)) {
            Some(known) => known.join(&motion),
            None => distinct.push(motion),
        }
    }
    distinct
}

impl Motion {
    /// Takes over another start's measurement of the same motion: the larger extremes.
    fn join(&mut self, other: &Self) {
        self.peak = self.peak.max(other.peak);
        self.impact_speed = self.impact_speed.max(other.impact_speed);
        self.starts += other.starts;
    }
}
