//! A second opinion in 77 decimal digits: equations (1) and (2) once more, with gravity along the cavity,
//! friction in it and two restitutions, for a few dozen impacts.
//!
//! It shares no code with [`vinesink::simulation`] and none of its ideas: the motion is a Taylor series of
//! its own equation, walls are looked for by a fine scan in multiple precision whose first steps are a
//! thousand thousand million times shorter, a crossing is halved and polished by Newton's method, and
//! chattering is followed until the gap opens by 1e-40 clearances. A constant force moves the origin that the
//! oscillator is counted from. It costs a thousand times as much and proves nothing, but no rounding of the engine
//! can hide behind its own.

mod flight;
mod friction;
mod oscillator;
pub mod real;
mod search;

use flight::ReferenceFlight;
use oscillator::{ReferenceOscillator, TimePoint, Vector};
use real::Decimal;
use search::{polished, scan};

use vinesink::system::{Cavity, State, System};

/// Opening of the gap, over the clearance, below which a chattering sequence has ended.
const EXCURSION: f64 = 1e-40;
/// Flights shorter than the scan's step halved as often as this are solved from their parabola.
const SHORTEST: f64 = 1e-9;
/// Roundings that an excursion must be wide for one to be added to it.
const ROOM: f64 = 8.0;
/// The multiples of the golden section are spread evenly and never repeat.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// What happens next on a trajectory; times are fast time since the start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Event {
    /// An impact.
    Impact {
        /// When.
        tau: f64,
        /// +1 where `x - y = +b`, else -1.
        side: f64,
        /// Displacement of the oscillator over the clearance.
        x: f64,
        /// Energy that it takes, per unit of the oscillator's mass.
        loss: f64,
        /// Whether the absorber stays on the wall.
        sticks: bool,
    },
    /// Friction has stopped the absorber relative to the oscillator, and it slides back.
    Reversal {
        /// When.
        tau: f64,
        /// Displacement of the oscillator over the clearance.
        x: f64,
    },
    /// Friction has stopped the absorber relative to the oscillator, and holds it.
    Stick {
        /// When.
        tau: f64,
        /// Displacement of the oscillator over the clearance.
        x: f64,
        /// The wall that it touches, +1 or -1; `None` within the cavity.
        wall: Option<f64>,
    },
    /// The absorber leaves the wall that it rested on, or the place where friction held it.
    Release {
        /// When.
        tau: f64,
        /// Displacement of the oscillator over the clearance.
        x: f64,
    },
}

/// A trajectory in multiple precision.
pub struct Reference {
    eps: Decimal,
    /// At the walls `x - y = +b` and `x - y = -b`.
    restitutions: [Decimal; 2],
    gravity: Decimal,
    friction: Decimal,
    alone: ReferenceOscillator,
    carrying: ReferenceOscillator,
    time: Decimal,
    /// The oscillator with its excitation.
    z: Vector,
    y: Decimal,
    y_velocity: Decimal,
    mode: ReferenceMode,
    rounding: f64,
    /// Events that may be disturbed.
    events: u32,
}

/// What the absorber does.
#[derive(Clone)]
enum ReferenceMode {
    /// Nothing but gravity acts on it.
    Flies,
    /// Friction acts on it; the sign of `x' - y'`.
    Slides(f64),
    /// It moves with the oscillator, `gap` behind it, at a wall or held by friction alone.
    Rests { wall: Option<f64>, gap: Decimal },
}

impl Reference {
    /// A trajectory from `start` at phase 0.
    ///
    /// With a `rounding` above 0, over the clearance, the oscillator starts displaced by that much,
    /// and so does the absorber from the walls, from every second one in an order that never repeats
    /// and has no symmetry: how far this moves later impacts is what rounding once an event may cost,
    /// whoever computes. So does the absorber where friction stops it, and both where friction gives way.
    pub fn new(system: &System, start: State, rounding: f64) -> Self {
        let eps = Decimal::of(system.mass_ratio());
        let alone = ReferenceOscillator::new(system, &Decimal::of(0.0));
        let carrying = ReferenceOscillator::new(system, &eps);
        let [x, v, y, u] = [start.x, start.x_velocity, start.y, start.y_velocity].map(Decimal::of);
        let gap = &x - &y;
        let side = if gap.is_negative() { -1.0 } else { 1.0 };
        let touches = (&gap.abs() - &Decimal::of(1.0)).is_zero() && (&v - &u).is_zero();
        let moved = Decimal::of(rounding);
        // What touches is moved together.
        let y = if touches { &y + &moved } else { y };
        let slip = &v - &u;
        let Cavity { gravity_along, friction_acceleration, .. } = system.cavity();
        let mut reference = Self {
            eps,
            restitutions: system.restitutions().map(Decimal::of),
            gravity: Decimal::of(gravity_along),
            friction: Decimal::of(friction_acceleration),
            alone,
            carrying,
            time: Decimal::of(0.0),
            z: [&x + &moved, v, Decimal::of(0.0), Decimal::of(1.0)],
            y,
            y_velocity: u,
            mode: ReferenceMode::Flies,
            rounding,
            events: 0,
        };
        reference.mode = match slip.is_zero() {
            true => reference.settled(touches.then_some(side)),
            false => reference.moving(&slip),
        };
        reference
    }

    /// The next event; `None` if there is none up to `latest`, and then the trajectory stands where
    /// it stood.
    pub fn next(&mut self, latest: f64) -> Option<Event> {
        match self.mode.clone() {
            ReferenceMode::Flies => self.fly(latest),
            ReferenceMode::Slides(direction) => self.slide(direction, latest),
            ReferenceMode::Rests { wall, gap } => self.release(wall, &gap, latest),
        }
    }

    /// Where the trajectory stands, right after its last event: fast time, displacement and velocity of the
    /// oscillator, and of the absorber.
    pub fn moment(&self) -> [Decimal; 5] {
        let [x, v, ..] = &self.z;
        [&self.time, x, v, &self.y, &self.y_velocity].map(Decimal::clone)
    }

    /// Whether the absorber moves with the oscillator.
    pub fn rests(&self) -> bool {
        matches!(self.mode, ReferenceMode::Rests { .. })
    }

    /// The motion from here while `x' - y'` has that sign; 0 without friction.
    fn flight(&self, direction: f64) -> ReferenceFlight {
        let friction = &Decimal::of(direction) * &self.friction;
        let accelerations = [&self.gravity, &friction, &self.eps];
        ReferenceFlight::new(&self.z, [&self.y, &self.y_velocity], accelerations)
    }

    fn arrive(&mut self, flight: &ReferenceFlight, at: &TimePoint) {
        self.time = &self.time + &at.s;
        self.z = flight.z(at);
        [self.y, self.y_velocity] = flight.absorber(at);
    }

    fn fly(&mut self, latest: f64) -> Option<Event> {
        let (alone, flight) = (&self.alone, self.flight(0.0));
        let one = Decimal::of(1.0);
        // How far outside the absorber is, and its rate.
        let excess = |point: &TimePoint| {
            let [gap, opening] = flight.gap(point);
            let rate = if gap.is_negative() { -&opening } else { opening };
            [&gap.abs() - &one, rate]
        };
        let span = latest - self.time.to_f64();
        let near = match self.short_flight() {
            Some(s) => alone.later(&flight.start(), &s),
            None => scan(alone, flight.start(), span, &excess)?,
        };
        let side = if flight.gap(&near)[0].is_negative() { -1.0 } else { 1.0 };
        let at = polished(alone, near, &excess);
        if at.s.to_f64() > span {
            return None;
        }
        self.arrive(&flight, &at);
        Some(self.struck(side))
    }

    /// Equation (2), and whether the absorber stays on the wall.
    fn struck(&mut self, side: f64) -> Event {
        let (one, sign) = (Decimal::of(1.0), Decimal::of(side));
        let disturbed = self.is_disturbed();
        let [x, v, sin, cos] = self.z.clone();
        let approach = &v - &self.y_velocity;
        let r = &self.restitutions[usize::from(side < 0.0)];
        let total = &one + &self.eps;
        let exchanged = &(&(&one + r) * &approach) / &total;
        let after = [&v - &(&self.eps * &exchanged), &self.y_velocity + &exchanged];
        let kept = &one - &(r * r);
        let loss =
            &(&(&self.eps * &kept) * &(&approach * &approach)) / &(&Decimal::of(2.0) * &total);
        let opening = &(&approach * r) * &sign;
        self.z = [x.clone(), after[0].clone(), sin, cos];
        let closing = self.stopping(side);
        // The gap opens by u^2 / (2 a).
        let limit = &closing * &Decimal::of(2.0 * EXCURSION);
        let sticks = closing.is_positive() && !limit.is_below(&(&opening * &opening));
        // An excursion that rounding would fill is left to its parabola.
        let room = &(&Decimal::of(2.0 * ROOM * self.rounding) * &closing) - &(&opening * &opening);
        let rounding = if disturbed && room.is_negative() { self.rounding } else { 0.0 };
        self.y = &x - &(&sign * &(&one - &Decimal::of(rounding)));
        let [x_velocity, y_velocity] = if sticks || r.is_zero() {
            let common = &(&after[0] + &(&self.eps * &after[1])) / &total;
            [common.clone(), common]
        } else {
            after
        };
        let (tau, loss) = (self.time.to_f64(), loss.to_f64());
        let event = Event::Impact { tau, side, x: x.to_f64(), loss, sticks };
        self.z[1] = x_velocity;
        self.y_velocity = y_velocity;
        self.mode = match sticks {
            true => ReferenceMode::Rests { wall: Some(side), gap: sign },
            false => self.moving(&-&sign),
        };
        event
    }

    /// Whether rounding may act on this event.
    fn is_disturbed(&mut self) -> bool {
        self.events += 1;
        (GOLDEN * f64::from(self.events)).fract() < 0.5
    }

    /// The duration of a flight so short that it is a parabola, `2 u / a`, to nine digits.
    fn short_flight(&self) -> Option<Decimal> {
        let gap = &self.z[0] - &self.y;
        let touching = &gap.abs() - &Decimal::of(1.0);
        if !touching.abs().is_below(&Decimal::of(1e-60)) {
            return None;
        }
        let side = if gap.is_negative() { -1.0 } else { 1.0 };
        let opening = -&(&Decimal::of(side) * &(&self.z[1] - &self.y_velocity));
        let closing = self.stopping(side);
        if !(opening.is_positive() && closing.is_positive()) {
            return None;
        }
        let duration = &(&Decimal::of(2.0) * &opening) / &closing;
        let short = Decimal::of(SHORTEST * self.alone.scan_step());
        duration.is_below(&short).then_some(duration)
    }
}
