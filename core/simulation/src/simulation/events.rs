//! What happens along a trajectory, as observers are told: smooth stretches, impacts, sticking, the
//! end of each excitation period.

use serde::Serialize;

use super::flow::{Kinematics, SmoothMotion};
use crate::system::State;

/// A start that no motion can have.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StartError {
    /// The absorber would start outside its cavity.
    #[error(
        "the start has x - y = {gap}, outside the cavity; choose X and Y with abs(X - Y) at most 1 \
         (lengths are over the clearance)"
    )]
    OutsideCavity {
        /// The relative displacement asked for.
        gap: f64,
    },
    /// A number is infinite or not a number.
    #[error(
        "the start of the motion is not finite; give four ordinary numbers X,XDOT,Y,YDOT, and check the units of the \
         case: one value is many orders of magnitude away from the others"
    )]
    NotFinite {
        /// The state asked for.
        state: State,
    },
}

/// A wall of the cavity: where `x - y = +b` or `x - y = -b`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub enum Side {
    /// `x - y = +b`.
    Plus,
    /// `x - y = -b`.
    Minus,
}

impl Side {
    /// That on whose side a gap is.
    #[inline(always)]
    pub(crate) fn of(gap: f64) -> Self {
        if gap > 0.0 { Self::Plus } else { Self::Minus }
    }

    /// +1 or -1, a factor.
    pub fn sign(self) -> f64 {
        match self {
            Self::Plus => 1.0,
            Self::Minus => -1.0,
        }
    }

    /// Its place in a pair, the plus side first.
    #[inline(always)]
    pub(crate) fn index(self) -> usize {
        usize::from(self == Self::Minus)
    }
}

/// One impact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Impact {
    /// Fast time since the start of the run.
    pub tau: f64,
    /// Excitation phase, `0 .. 2 pi`.
    pub phase: f64,
    /// Which wall.
    pub side: Side,
    /// Oscillator displacement over the clearance.
    pub x: f64,
    /// Oscillator velocity before.
    pub x_velocity_before: f64,
    /// Oscillator velocity after.
    pub x_velocity_after: f64,
    /// Absorber velocity before.
    pub y_velocity_before: f64,
    /// Absorber velocity after.
    pub y_velocity_after: f64,
    /// Energy lost, per unit of the oscillator's mass.
    pub loss: f64,
    /// How far past the wall the search stopped: rounding, over the clearance.
    pub penetration: f64,
}

impl Impact {
    /// The state just before it, on the wall.
    pub fn state_before(&self) -> State {
        State {
            x: self.x,
            x_velocity: self.x_velocity_before,
            y: self.x - self.side.sign(),
            y_velocity: self.y_velocity_before,
        }
    }
}

/// A stretch of smooth motion, as observers see it.
#[derive(Debug, Clone, Copy)]
pub struct Segment {
    /// Motion of the oscillator.
    pub motion: SmoothMotion,
    /// Motion of the absorber.
    pub absorber: AbsorberMotion,
    /// Whole periods since the start of the run.
    pub turns: u64,
    /// Excitation phase at the beginning.
    pub phase: f64,
    /// Length in fast time.
    pub duration: f64,
}

/// How the absorber moves during a [`Segment`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AbsorberMotion {
    /// On a straight line, or on a parabola in a cavity that is tilted or rubs.
    Flying {
        /// Displacement at the beginning.
        y: f64,
        /// Velocity at the beginning.
        y_velocity: f64,
        /// Acceleration.
        y_acceleration: f64,
    },
    /// At rest against a wall, moving with the oscillator.
    Carried(Side),
    /// At rest in the cavity, held by friction and moving with the oscillator.
    Held {
        /// Where, `x - y`.
        gap: f64,
    },
}

impl Segment {
    /// The state a time `s` after the beginning.
    pub fn at(&self, s: f64) -> State {
        let Kinematics { x, v } = self.motion.at(s);
        match self.absorber {
            AbsorberMotion::Flying { y, y_velocity, y_acceleration } => {
                let gained = y_acceleration * s;
                let y = y + (y_velocity + 0.5 * gained) * s;
                State { x, x_velocity: v, y, y_velocity: y_velocity + gained }
            }
            AbsorberMotion::Carried(side) => {
                State { x, x_velocity: v, y: x - side.sign(), y_velocity: v }
            }
            AbsorberMotion::Held { gap } => State { x, x_velocity: v, y: x - gap, y_velocity: v },
        }
    }
}

/// The absorber, sliding in a cavity that rubs, has come to rest relative to the oscillator.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Reversal {
    /// Fast time since the start of the run.
    pub tau: f64,
    /// Excitation phase, `0 .. 2 pi`.
    pub phase: f64,
    /// The state, both velocities equal.
    pub state: State,
    /// The sign of `x' - y'` before.
    pub before: f64,
    /// That after; 0 where friction holds it.
    pub after: f64,
}

/// What an [`Observer`] needs to be told of; to describe the rest would cost time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Detail {
    /// Nothing.
    Nothing,
    /// Impacts, ends of chattering sequences, ends of periods and sustained contact.
    Events,
    /// Flights as well, which cost more to describe than to fly.
    Flights,
}

/// Receives what happens, in order.
///
/// With the system of the crate page, whose steady motion has two impacts per period, half a period apart:
///
/// ```
/// # use vinesink_core::system::{Cavity, Excitation, Parameters, System};
/// # let system = System::new(Parameters {
/// #     mass_ratio: 0.032 / 4.168, damping: 1.799, restitution: 0.6, frequency_ratio: 8.0 / 8.349,
/// #     forcing_per_clearance: 4.3417, excitation: Excitation::BaseDisplacement,
/// #     cavity: Cavity::IDEAL,
/// # })?;
/// use std::f64::consts::PI;
/// use vinesink_core::orbits::attracting_orbit;
/// use vinesink_core::simulation::{Detail, Impact, Observer, Simulation};
///
/// #[derive(Default)]
/// struct Phases(Vec<f64>);
///
/// impl Observer for Phases {
///     fn detail(&self) -> Detail {
///         Detail::Events // flights need not be described
///     }
///     fn impact(&mut self, impact: &Impact) {
///         self.0.push(impact.phase);
///     }
/// }
///
/// // From the exact orbit, right after an impact.
/// let after = attracting_orbit(&system).expect("one attracts").orbit.cycle.impacts[0];
/// let mut simulation = Simulation::new(&system, after.state(), after.phase)?;
/// let mut phases = Phases::default();
/// simulation.run(10, u64::MAX, &mut phases);
/// assert!(phases.0.windows(2).all(|pair| ((pair[1] - pair[0]).abs() - PI).abs() < 1e-9));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Observer {
    /// What it needs; it may be told of more. The same at any time.
    fn detail(&self) -> Detail {
        Detail::Flights
    }
    /// A stretch of smooth motion was completed.
    fn segment(&mut self, _segment: &Segment) {}
    /// An impact took place.
    fn impact(&mut self, _impact: &Impact) {}
    /// A chattering sequence ended: the absorber sticks, and the rest of its relative energy is
    /// lost.
    fn sticks(&mut self, _loss: f64) {}
    /// Sliding ended; only where there is friction.
    fn reversal(&mut self, _reversal: &Reversal) {}
    /// An excitation period is over; the phase is 0 again.
    fn period(&mut self, _state: &State) {}
}

/// An observer that ignores everything: for transients.
impl Observer for () {
    fn detail(&self) -> Detail {
        Detail::Nothing
    }
}

/// What is lent to be told.
impl<O: Observer + ?Sized> Observer for &mut O {
    fn detail(&self) -> Detail {
        (**self).detail()
    }
    fn segment(&mut self, segment: &Segment) {
        (**self).segment(segment);
    }
    fn impact(&mut self, impact: &Impact) {
        (**self).impact(impact);
    }
    fn sticks(&mut self, loss: f64) {
        (**self).sticks(loss);
    }
    fn reversal(&mut self, reversal: &Reversal) {
        (**self).reversal(reversal);
    }
    fn period(&mut self, state: &State) {
        (**self).period(state);
    }
}

/// Whoever is there is told.
impl<O: Observer> Observer for Option<O> {
    fn detail(&self) -> Detail {
        self.as_ref().map_or(Detail::Nothing, Observer::detail)
    }
    fn segment(&mut self, segment: &Segment) {
        if let Some(observer) = self {
            observer.segment(segment);
        }
    }
    fn impact(&mut self, impact: &Impact) {
        if let Some(observer) = self {
            observer.impact(impact);
        }
    }
    fn sticks(&mut self, loss: f64) {
        if let Some(observer) = self {
            observer.sticks(loss);
        }
    }
    fn reversal(&mut self, reversal: &Reversal) {
        if let Some(observer) = self {
            observer.reversal(reversal);
        }
    }
    fn period(&mut self, state: &State) {
        if let Some(observer) = self {
            observer.period(state);
        }
    }
}

/// Both are told. Whoever keeps two observers keeps such a pair: one that passes events on by itself may forget one.
impl<A: Observer, B: Observer> Observer for (A, B) {
    fn detail(&self) -> Detail {
        self.0.detail().max(self.1.detail())
    }
    fn segment(&mut self, segment: &Segment) {
        self.0.segment(segment);
        self.1.segment(segment);
    }
    fn impact(&mut self, impact: &Impact) {
        self.0.impact(impact);
        self.1.impact(impact);
    }
    fn sticks(&mut self, loss: f64) {
        self.0.sticks(loss);
        self.1.sticks(loss);
    }
    fn reversal(&mut self, reversal: &Reversal) {
        self.0.reversal(reversal);
        self.1.reversal(reversal);
    }
    fn period(&mut self, state: &State) {
        self.0.period(state);
        self.1.period(state);
    }
}
