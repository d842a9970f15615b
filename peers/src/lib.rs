//! Other people's tools on vinesink's work, in the same run on the same core: what each costs, how
//! well it knows when impacts happen, and how many it misses.

pub mod diffsol;
pub mod engine;
pub mod judge;
pub mod runge_kutta;
pub mod script;
pub mod several;

#[path = "../../tests/reference/mod.rs"]
mod reference;

use std::time::Duration;

use rustix::time::{ClockId, clock_gettime};
use vinesink::system::{Cavity, Excitation, Parameters, State, System};

/// Clearances in mm: periodic with three impacts per period, and chaotic.
pub const CLEARANCES: [f64; 2] = [11.5, 7.5];
/// At rest but for a small velocity of the oscillator, at excitation phase 0.
pub const START: State = State { x: 0.0, x_velocity: 0.01, y: 0.0, y_velocity: 0.0 };

/// Table 1 of Li, Seguy, Berlioz (2016) at resonance, with F = 0.25 mm, which is inferred.
pub fn system(clearance_mm: f64) -> System {
    let mass_ratio = 0.032 / 4.168;
    System::new(Parameters {
        mass_ratio,
        damping: 3.02 / (0.032 * (11.47e3_f64 / 4.168).sqrt()),
        restitution: 0.6,
        frequency_ratio: 1.0,
        forcing_per_clearance: 0.25 / mass_ratio / clearance_mm,
        excitation: Excitation::BaseDisplacement,
        cavity: Cavity::IDEAL,
    })
    .expect("Table 1 is a valid system")
}

/// An impact as a tool saw it: when, on which wall, and the state it went on with. The absorber is on
/// the wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Fast time since the start.
    pub time: f64,
    /// +1 where `x - y = b`, -1 where it is `-b`.
    pub side: f64,
    /// Displacement of the oscillator over the clearance.
    pub x: f64,
    /// Its velocity afterwards.
    pub x_velocity: f64,
    /// The absorber's.
    pub y_velocity: f64,
}

/// What it took to run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Run {
    pub took: Duration,
    pub impacts: u64,
}

/// Why a tool could not do its work.
pub type Failure = Box<dyn std::error::Error>;

/// Something that simulates from [`START`].
pub trait Tool {
    /// What it is, with version and setting.
    fn name(&self) -> String;
    /// Everything before the first steady run, where it is more than can be neglected: starting,
    /// importing and compiling.
    fn preparation(&self) -> Option<Duration> {
        None
    }
    /// Simulates so many periods; the time is its own work, without preparation.
    fn run(&mut self, system: &System, periods: u64) -> Result<Run, Failure>;
    /// The same, with every impact.
    fn hits(&mut self, system: &System, periods: u64) -> Result<Vec<Hit>, Failure>;
}

/// Equation (2): velocities of oscillator and absorber after an impact.
fn rebound(system: &System, x_velocity: f64, y_velocity: f64) -> [f64; 2] {
    let (eps, r) = (system.mass_ratio(), system.restitution());
    let exchanged = (1.0 + r) * (x_velocity - y_velocity) / (1.0 + eps);
    [x_velocity - eps * exchanged, y_velocity + exchanged]
}

/// Equation (1): acceleration of the oscillator in flight.
#[derive(Debug, Clone, Copy)]
struct Acceleration {
    frequency: f64,
    damping: f64,
    sine: f64,
    cosine: f64,
}

impl Acceleration {
    fn of(system: &System) -> Self {
        let (sine, cosine) = system.excitation_amplitudes();
        let damping = system.mass_ratio() * system.damping();
        Self { frequency: system.frequency_ratio(), damping, sine, cosine }
    }

    #[inline]
    fn at(&self, time: f64, x: f64, v: f64) -> f64 {
        let (sin, cos) = libm::sincos(self.frequency * time);
        self.sine * sin + self.cosine * cos - self.damping * v - x
    }
}

/// Runs `work` and takes the time that this thread spent on it: on a machine with other work to do a
/// tool that runs longer would otherwise be interrupted more often.
fn timed(work: impl FnOnce() -> Result<u64, Failure>) -> Result<Run, Failure> {
    let begin = spent();
    let impacts = work()?;
    Ok(Run { took: spent() - begin, impacts })
}

fn spent() -> Duration {
    let now = clock_gettime(ClockId::ThreadCPUTime);
    Duration::new(now.tv_sec.unsigned_abs(), u32::try_from(now.tv_nsec).unwrap_or_default())
}
