//! What is not steady harmonic motion: a structure that is released or struck, and comes to rest; one that is swept
//! through its resonance ([`SweepStudy`]); one that a record or noise drives ([`RecordStudy`]).
//!
//! Lengths over the clearance, fast time `tau = omega0 t`, as everywhere. The *amplitude* of the structure at a
//! time is `sqrt(x^2 + x'^2)`, the root of its own energy: that of the vibration that it would go on with alone.
//! What it does depends on where in its cavity the absorber is at the beginning, which nobody knows: it is
//! simulated from places all over the cavity ([`Ringdown`]), and the worst counts. Beside it stand the structure
//! alone and a tuned mass damper of the same mass ([`linear`]), and theory ([`Predicted`]).

mod clearance;
mod driven;
mod flight;
pub mod linear;
mod passage;
mod places;
mod record;
mod record_study;
mod ringdown;
mod study;
mod sweep;
mod theory;

pub use clearance::{Best, RELEASES, best_clearance, looked_at};
pub use driven::{DrivenError, Response, follow};
pub use flight::Flight;
#[cfg(feature = "sweep")]
pub(crate) use passage::worst;
pub use passage::{ByRate, Jump, SweepStart, SweepStudy};
#[cfg(feature = "sweep")]
pub(crate) use places::Places;
pub use places::{share_above, with_closer, worst_of_places};
pub use record::{Piece, Record, RecordQuantity, Spectrum};
pub use record_study::{Measured, Realisation, RecordStudy, SpectrumPoint};
pub use ringdown::{Ringdown, STEPS};
pub use study::{Decay, DecayStudy, DecayTime, Inactive};
#[cfg(feature = "sweep")]
pub(crate) use study::{bare, followed};
pub use sweep::{Passage, SineSweep, SweepRate};
pub use theory::Predicted;

use crate::case::{Case, Recording};
use crate::executor::Executor;
use crate::quantity::Units;
use crate::simulation::StartError;
use crate::system::{InvalidParameter, Parameter, Parameters, State, System};

/// What a structure is subjected to that is not steady harmonic excitation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Transient {
    /// It is let go or struck.
    Release(Release),
    /// The frequency of its excitation is swept.
    Sweep(SineSweep),
    /// A record or noise drives it, whose values are of this quantity.
    Record(RecordQuantity),
}

impl Transient {
    /// The numbers that a parameter is in it: how far and how fast a structure is let go, how hard it is struck, how
    /// fast it is swept.
    pub(crate) fn numbers(&mut self, parameter: Parameter) -> Vec<&mut f64> {
        use Parameter as P;
        let (struck, shock) = match self {
            Self::Release(of) => (of.impulse > 0.0, of.impulse > 0.0 || of.absorber_velocity > 0.0),
            _ => (false, false),
        };
        match (self, parameter, struck, shock) {
            (Self::Release(of), P::Amplitude, true, _) => vec![&mut of.impulse],
            (Self::Release(of), P::Amplitude, _, true) => {
                vec![&mut of.velocity, &mut of.absorber_velocity]
            }
            (Self::Release(of), P::InitialDisplacement, _, false) => vec![&mut of.displacement],
            (Self::Release(of), P::InitialVelocity, _, false) => vec![&mut of.velocity],
            (Self::Sweep(of), P::Rate, ..) => match &mut of.rate {
                SweepRate::Linear(rate) | SweepRate::Octaves(rate) => vec![rate],
            },
            _ => Vec::new(),
        }
    }

    /// Places of the absorber that are simulated unless a case says how many: of several records fewer of each.
    pub fn places(self, recording: Option<&Recording>) -> u32 {
        match self {
            Self::Release(_) => DecayStudy::STARTS,
            Self::Sweep(_) => SweepStudy::STARTS,
            Self::Record(_) => RecordStudy::usual_places(recording.map_or(1, Recording::count)),
        }
    }
}

/// What a structure is subjected to: which criteria, tables and commands make sense of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scene {
    /// Harmonic excitation.
    Steady,
    /// None: it is let go or struck.
    Release,
    /// Harmonic excitation whose frequency changes.
    Sweep,
    /// A record or noise.
    Record,
}

impl Scene {
    /// Seconds for an oscillation on the way to rest, a period of a sweep or a piece of a record from one place of the
    /// absorber, measured in the release profile on one core of an ARM server: 2.8, 1.6 and 0.3 us with some impacts each.
    pub const fn seconds(self) -> f64 {
        match self {
            Self::Release => 3e-6,
            Self::Steady | Self::Sweep => 1.6e-6,
            Self::Record => 0.4e-6,
        }
    }

    /// "a structure that is ...".
    pub const fn words(self) -> &'static str {
        match self {
            Self::Steady => "driven steadily",
            Self::Release => "released or struck",
            Self::Sweep => "swept through resonance",
            Self::Record => "driven by a record",
        }
    }
}

/// What became of a structure that is not driven steadily.
#[derive(Debug, Clone)]
pub enum Study {
    /// One that was released or struck.
    Release(Box<DecayStudy>),
    /// One that was swept through resonance.
    Sweep(Box<SweepStudy>),
    /// One that a record drove.
    Record(Box<RecordStudy>),
}

impl Study {
    /// Studies a case that is not driven steadily; none for another.
    ///
    /// # Errors
    /// [`DrivenError`] where the motion is so large that rounding hides the walls, or samples are missing.
    pub fn of_case(case: &Case, executor: &dyn Executor) -> Option<Result<Self, DrivenError>> {
        let boxed = |done: Result<Self, StartError>| done.map_err(DrivenError::from);
        match case.design.transient()? {
            Transient::Release(_) => DecayStudy::of_case(case, executor)
                .map(|done| boxed(done.map(|study| Self::Release(Box::new(study))))),
            Transient::Sweep(_) => SweepStudy::of_case(case, executor)
                .map(|done| boxed(done.map(|study| Self::Sweep(Box::new(study))))),
            Transient::Record(_) => RecordStudy::of_case(case, executor)
                .map(|done| done.map(|study| Self::Record(Box::new(study)))),
        }
    }
}

/// How a structure is set in motion, in SI or the units of a reduced case; the absorber's place is open.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Release {
    /// Displacement of the structure.
    pub displacement: f64,
    /// Its velocity.
    pub velocity: f64,
    /// Velocity of the absorber: that of the structure where the base was set in motion, else 0.
    pub absorber_velocity: f64,
    /// Impulse on the structure, which adds to its velocity.
    pub impulse: f64,
}

impl Release {
    /// The same, so many times as strong.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let Self { displacement, velocity, absorber_velocity, impulse } = *self;
        Self {
            displacement: factor * displacement,
            velocity: factor * velocity,
            absorber_velocity: factor * absorber_velocity,
            impulse: factor * impulse,
        }
    }

    /// The amplitude with which the structure begins, over the clearance.
    pub(crate) fn amplitude(&self, units: &Units) -> f64 {
        amplitude(&self.state(units, 0.0))
    }

    /// Where no wall ever reaches an absorber at rest.
    fn inactive(&self, system: &System, units: &Units) -> Inactive {
        study::inactive(system, &self.state(units, 0.0))
    }

    /// The state in which an absorber at a relative displacement `w` begins.
    fn state(&self, units: &Units, w: f64) -> State {
        let x = units.over_clearance(self.displacement);
        let velocity = self.velocity + self.impulse / units.oscillator_mass;
        let speed = units.velocity(1.0);
        let y_velocity = self.absorber_velocity / speed;
        State { x, x_velocity: velocity / speed, y: x - w, y_velocity }
    }
}

/// Starts that count: where `inactive` is false those alone in which the absorber hits a wall, unless it never does.
fn counted<T>(starts: &[T], inactive: bool, impacts: impl Fn(&T) -> u64) -> Vec<&T> {
    let awake: Vec<&T> = starts.iter().filter(|start| inactive || impacts(start) > 0).collect();
    if awake.is_empty() { starts.iter().collect() } else { awake }
}

/// The amplitude of a structure in a state.
fn amplitude(state: &State) -> f64 {
    libm::hypot(state.x, state.x_velocity)
}

/// A system without excitation, whose "period" is a step of time.
fn unforced(system: &System, step: f64) -> Result<System, InvalidParameter> {
    System::new(Parameters {
        forcing_per_clearance: 0.0,
        frequency_ratio: std::f64::consts::TAU / step,
        ..system.parameters()
    })
}

/// The time after which an amplitude stays at a level or below it: where it jumps below, or on an exponential between two
/// times at which it is seen.
#[derive(Debug, Clone, Copy)]
struct Settling {
    level: f64,
    last: [f64; 2],
    /// Infinite while it is above.
    time: f64,
}

impl Settling {
    fn to(level: f64) -> Self {
        Self { level, last: [0.0, 0.0], time: 0.0 }
    }

    fn see(&mut self, time: f64, amplitude: f64) {
        if amplitude > self.level {
            self.time = f64::INFINITY;
        } else if self.time.is_infinite() {
            let [before, above] = self.last;
            let part = libm::log(above / self.level) / libm::log(above / amplitude);
            self.time = before + (time - before) * if part.is_finite() { part } else { 1.0 };
        }
        self.last = [time, amplitude];
    }
}

#[cfg(test)]
mod tests {
    use super::Settling;

    #[test]
    fn the_last_crossing_counts() {
        let time = |level: f64| {
            let mut settling = Settling::to(level);
            for (time, power) in [0.0, 1.0, 2.0, 1.0, 3.0, 4.0].into_iter().enumerate() {
                settling.see(time as f64, libm::exp(-power));
            }
            // A jump, as an impact makes it.
            settling.see(5.0, libm::exp(-4.5));
            settling.see(5.0, libm::exp(-6.0));
            settling.time
        };
        assert!((time(libm::exp(-2.5)) - 3.75).abs() < 1e-12, "{}", time(libm::exp(-2.5)));
        assert_eq!([time(2.0), time(libm::exp(-5.0)), time(1e-3)], [0.0, 5.0, f64::INFINITY]);
    }
}
