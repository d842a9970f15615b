//! From one impact to the next: the map whose cycles are the periodic orbits, with its exact
//! Jacobian.
//!
//! The state right after an impact on side `s` is `(phase, x, x', y')`; the absorber's place is
//! `y = x - s`. A flight of length `D` leads to the wall on side `s1` where `w(D) = s1`; the impact
//! follows equation (2). The length depends on the state through that condition, so that
//! `dD = -dw / w'` enters every derivative: the saltation of a discontinuous system. Written with `D`
//! In a real cavity the absorber has `y'' = a - s f` and the oscillator takes `eps s f`: an absorber that leaves the
//! wall on side `s` slides that way until the next impact, or the flight is none (`admissibility`).
//!
//! With `D`
//! as an unknown of its own, the map has no event to search for, and Newton's method sees it whole.

use nalgebra::{Matrix4, Vector2, Vector4};

use super::flight::{Arrival, Course, Derivatives, OrbitFlight};
use crate::system::{Cavity, State, System};

/// A wall of the cavity: where `x - y = +b` or `x - y = -b`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize)]
pub enum Wall {
    /// `x - y = +b`.
    #[serde(rename = "+")]
    Plus,
    /// `x - y = -b`.
    #[serde(rename = "-")]
    Minus,
}

impl Wall {
    /// +1 or -1, a factor.
    pub fn sign(self) -> f64 {
        match self {
            Self::Plus => 1.0,
            Self::Minus => -1.0,
        }
    }

    /// The opposite wall.
    pub fn opposite(self) -> Self {
        match self {
            Self::Plus => Self::Minus,
            Self::Minus => Self::Plus,
        }
    }
}

/// The state right after an impact; lengths over the clearance, fast time.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct AfterImpact {
    /// The wall that the absorber has hit and still touches.
    pub wall: Wall,
    /// Phase of the excitation, radians.
    pub phase: f64,
    /// Displacement of the oscillator.
    pub x: f64,
    /// Velocity of the oscillator.
    pub x_velocity: f64,
    /// Velocity of the absorber.
    pub y_velocity: f64,
}

impl AfterImpact {
    /// As a vector `(phase, x, x', y')`.
    pub fn vector(&self) -> Vector4<f64> {
        Vector4::new(self.phase, self.x, self.x_velocity, self.y_velocity)
    }

    /// The state with the vector `(phase, x, x', y')` on the same wall.
    #[must_use]
    pub fn moved_to(&self, vector: &Vector4<f64>) -> Self {
        let [phase, x, x_velocity, y_velocity] = (*vector).into();
        Self { wall: self.wall, phase, x, x_velocity, y_velocity }
    }

    /// The mirror image, which has the opposite sign everywhere, so many half periods of the excitation
    /// later; the image of a motion is a motion after an odd number of them.
    pub fn mirrored(&self, later: f64) -> Self {
        Self {
            wall: self.wall.opposite(),
            phase: self.phase + later * std::f64::consts::PI,
            x: -self.x,
            x_velocity: -self.x_velocity,
            y_velocity: -self.y_velocity,
        }
    }

    /// All four displacements and velocities.
    pub fn state(&self) -> State {
        State {
            x: self.x,
            x_velocity: self.x_velocity,
            y: self.x - self.wall.sign(),
            y_velocity: self.y_velocity,
        }
    }

    /// The oscillator from here on.
    fn course(&self, flight: &OrbitFlight) -> Course {
        flight.course(self.phase, Vector2::new(self.x, self.x_velocity))
    }
}

/// A flight of the absorber from one impact to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Leg {
    /// The state after the first impact.
    pub start: AfterImpact,
    /// The wall of the next.
    pub to: Wall,
    /// Fast time between them.
    pub duration: f64,
    /// Acceleration of the absorber.
    pub(super) acceleration: f64,
    course: Course,
}

impl Leg {
    /// The oscillator a time `s` after the first impact.
    pub fn oscillator(&self, s: f64) -> Derivatives {
        self.course.at(s)
    }

    /// The relative displacement `w` a time `s` after the first impact.
    pub fn relative(&self, s: f64) -> Derivatives {
        self.relative_of(self.oscillator(s), s)
    }

    /// The relative displacement, and a bound on its second derivative from then on.
    pub(super) fn bounded(&self, s: f64) -> (Derivatives, f64) {
        let (oscillator, bound) = self.course.bounded(s);
        (self.relative_of(oscillator, s), bound + self.acceleration.abs())
    }

    /// The oscillator after each of `count` steps of equal length; see [`Course::at_steps`].
    pub(super) fn oscillator_at_steps(
        &self,
        step: f64,
        count: u32,
    ) -> impl Iterator<Item = Derivatives> + use<> {
        self.course.at_steps(step, count)
    }

    /// The same, the oscillator's motion being known.
    pub fn relative_of(&self, at: Derivatives, s: f64) -> Derivatives {
        let sliding = self.acceleration * s;
        let x = at.x - self.start.x + self.start.wall.sign() - self.start.y_velocity * s;
        let v = at.v - self.start.y_velocity - sliding;
        Derivatives { x: x - 0.5 * sliding * s, v, a: at.a - self.acceleration, ..at }
    }

    /// What friction pushes the oscillator with, per unit of mass.
    pub(super) fn push(&self) -> f64 {
        self.course.push()
    }

    /// Displacement of the absorber a time `s` after the first impact.
    pub(super) fn absorber(&self, s: f64) -> f64 {
        let place = self.start.x - self.start.wall.sign();
        place + self.start.y_velocity * s + 0.5 * self.acceleration * s * s
    }
}

/// What the map does to one state, and everything that depends on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// The state after the next impact.
    pub next: AfterImpact,
    /// `w(D)` minus the wall's side: 0 where the flight really ends at that wall.
    pub gap: f64,
    /// `w'` just before the impact.
    pub approach: f64,
    /// Derivatives of `next` at fixed `D`.
    pub next_by_state: Matrix4<f64>,
    /// Derivative of `next` by `D`.
    pub next_by_duration: Vector4<f64>,
    /// Derivatives of `gap` by the state at fixed `D`; by `D` it is `approach`.
    pub gap_by_state: Vector4<f64>,
    /// Derivatives of `next` as [`crate::system::Parameter::derivatives`] has them: by the forcing, the
    /// frequency, the restitution, gravity along the cavity and friction.
    pub next_by_parameter: [Vector4<f64>; 5],
    /// The same for `gap`.
    pub gap_by_parameter: [f64; 5],
}

impl Step {
    /// The Jacobian of the impact map: `next` by the state, the duration following it.
    pub fn jacobian(&self) -> Matrix4<f64> {
        self.next_by_state - self.next_by_duration * self.gap_by_state.transpose() / self.approach
    }
}

/// The impact map of a system.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImpactMap {
    /// The oscillator between impacts.
    pub flight: OrbitFlight,
    mass_ratio: f64,
    restitutions: [f64; 2],
    cavity: Cavity,
}

impl ImpactMap {
    /// The map of `system`.
    ///
    /// # Errors
    /// [`super::OrbitError::NoSteadyMotion`] for an undamped oscillator driven at its natural
    /// frequency.
    pub fn of(system: &System) -> Result<Self, super::OrbitError> {
        Ok(Self {
            flight: OrbitFlight::of(system)?,
            mass_ratio: system.mass_ratio(),
            restitutions: system.restitutions(),
            cavity: system.cavity(),
        })
    }

    /// What the cavity has beyond two equal walls.
    pub(super) fn cavity(&self) -> &Cavity {
        &self.cavity
    }

    /// Restitution at a wall.
    pub(super) fn restitution(&self, wall: Wall) -> f64 {
        self.restitutions[usize::from(wall == Wall::Minus)]
    }

    /// After an impact on a wall: acceleration of the absorber, and what friction pushes the oscillator with.
    pub(super) fn sliding(&self, wall: Wall) -> [f64; 2] {
        let friction = wall.sign() * self.cavity.friction_acceleration;
        [self.cavity.gravity_along - friction, self.mass_ratio * friction]
    }

    /// The map under another forcing `gamma`; the present one must not be 0.
    pub fn with_forcing(&self, forcing: f64) -> Self {
        Self { flight: self.flight.with_forcing(forcing), ..*self }
    }

    /// The flight for `duration` to the wall `to`.
    pub fn leg(&self, start: &AfterImpact, to: Wall, duration: f64) -> Leg {
        let [acceleration, push] = self.sliding(start.wall);
        let course = start.course(&self.flight).pushed(push);
        Leg { start: *start, to, duration, acceleration, course }
    }

    /// Flies for `duration` and collides with the wall `to`.
    pub fn step(&self, start: &AfterImpact, to: Wall, duration: f64) -> Step {
        let [acceleration, push] = self.sliding(start.wall);
        let Arrival { at, by_phase, by_start, by_forcing, by_frequency } =
            start.course(&self.flight).pushed(push).arrival(duration);
        let yv = start.y_velocity + acceleration * duration;
        let approach = at.v - yv;
        // Equation (2): the absorber gains `gain` times the approach, the oscillator loses eps of it.
        let eps = self.mass_ratio;
        let gain = (1.0 + self.restitution(to)) / (1.0 + eps);
        let rebound = |dv: f64, dyv: f64| (dv - eps * gain * (dv - dyv), dyv + gain * (dv - dyv));
        let (after_v, after_yv) = rebound(at.v, yv);
        let column = |phase: f64, x: f64, dv: f64, dyv: f64| {
            let (dv, dyv) = rebound(dv, dyv);
            Vector4::new(phase, x, dv, dyv)
        };
        let restitution_share = approach / (1.0 + eps);
        let frequency = self.flight.frequency();
        let half_square = 0.5 * duration * duration;
        // Friction slows the absorber down and pushes the oscillator.
        let slowed = -start.wall.sign();
        let [pushed_x, pushed_v] =
            [1.0 - by_start[(0, 0)], -by_start[(1, 0)]].map(|by| -slowed * eps * by);
        Step {
            next: AfterImpact {
                wall: to,
                phase: start.phase + frequency * duration,
                x: at.x,
                x_velocity: after_v,
                y_velocity: after_yv,
            },
            gap: at.x - start.x + start.wall.sign()
                - start.y_velocity * duration
                - to.sign()
                - half_square * acceleration,
            approach,
            next_by_state: Matrix4::from_columns(&[
                column(1.0, by_phase.x, by_phase.y, 0.0),
                column(0.0, by_start[(0, 0)], by_start[(1, 0)], 0.0),
                column(0.0, by_start[(0, 1)], by_start[(1, 1)], 0.0),
                column(0.0, 0.0, 0.0, 1.0),
            ]),
            next_by_duration: column(frequency, at.v, at.a, acceleration),
            gap_by_state: Vector4::new(
                by_phase.x,
                by_start[(0, 0)] - 1.0,
                by_start[(0, 1)],
                -duration,
            ),
            next_by_parameter: [
                column(0.0, by_forcing.x, by_forcing.y, 0.0),
                column(duration, by_frequency.x, by_frequency.y, 0.0),
                Vector4::new(0.0, 0.0, -eps * restitution_share, restitution_share),
                column(0.0, 0.0, 0.0, duration),
                column(0.0, pushed_x, pushed_v, slowed * duration),
            ],
            gap_by_parameter: [
                by_forcing.x,
                by_frequency.x,
                0.0,
                -half_square,
                pushed_x - slowed * half_square,
            ],
        }
    }
}
