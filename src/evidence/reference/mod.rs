//! A second opinion in 77 decimal digits: equations (1) and (2) once more, for a few dozen impacts.
//!
//! It shares no code with [`crate::simulation`] and none of its ideas: the motion is a Taylor series of
//! its own equation, walls are looked for by a fine scan in multiple precision whose first steps are a
//! thousand thousand million times shorter, a crossing is halved and polished by Newton's method, and
//! chattering is followed until the gap opens by 1e-40 clearances. It costs a thousand times as much
//! and proves nothing, but no rounding of the engine can hide behind its own.

mod oscillator;
pub mod real;

use oscillator::{LEVELS, Oscillator, Point, Vector};
use real::Real;

use crate::system::{State, System};

/// Opening of the gap, over the clearance, below which a chattering sequence has ended.
const EXCURSION: f64 = 1e-40;
/// Flights shorter than the scan's step halved as often as this are solved from their parabola.
const SHORTEST: f64 = 1e-9;
/// Roundings that an excursion must be wide for one to be added to it.
const ROOM: f64 = 8.0;
/// The multiples of the golden section are spread evenly and never repeat.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// Corrections by Newton's method; each doubles the twelve digits that halving leaves.
const CORRECTIONS: u32 = 12;
/// Relative correction that ends them: from there the next would be below 77 digits.
const CORRECTED: f64 = 1e-45;

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
    /// The absorber leaves a wall that it rested on, the contact force having vanished.
    Release {
        /// When.
        tau: f64,
        /// Displacement of the oscillator over the clearance.
        x: f64,
    },
}

/// A trajectory in multiple precision.
pub struct Reference {
    eps: Real,
    restitution: Real,
    alone: Oscillator,
    carrying: Oscillator,
    time: Real,
    /// The oscillator with its excitation.
    z: Vector,
    y: Real,
    y_velocity: Real,
    /// The wall that the absorber rests on.
    rests: Option<f64>,
    rounding: f64,
    impacts: u32,
}

impl Reference {
    /// A trajectory from `start` at phase 0.
    ///
    /// With a `rounding` above 0, over the clearance, the oscillator starts displaced by that much,
    /// and so does the absorber from the walls, from every second one in an order that never repeats
    /// and has no symmetry: how far this moves later impacts is what rounding once an event may cost,
    /// whoever computes.
    pub fn new(system: &System, start: State, rounding: f64) -> Self {
        let eps = Real::of(system.mass_ratio());
        let alone = Oscillator::new(system, &Real::of(0.0));
        let carrying = Oscillator::new(system, &eps);
        let [x, v, y, u] = [start.x, start.x_velocity, start.y, start.y_velocity].map(Real::of);
        let gap = &x - &y;
        let side = if gap.is_negative() { -1.0 } else { 1.0 };
        let touches = (&gap.abs() - &Real::of(1.0)).is_zero() && (&v - &u).is_zero();
        let moved = Real::of(rounding);
        // What touches is moved together.
        let y = if touches { &y + &moved } else { y };
        let z = [&x + &moved, v, Real::of(0.0), Real::of(1.0)];
        let closing = &alone.rate(&z)[1] * &Real::of(side);
        let rests = (touches && closing.is_positive()).then_some(side);
        Self {
            eps,
            restitution: Real::of(system.restitution()),
            alone,
            carrying,
            time: Real::of(0.0),
            z,
            y,
            y_velocity: u,
            rests,
            rounding,
            impacts: 0,
        }
    }

    /// The next event; `None` if there is none up to `latest`, and then the trajectory stands where
    /// it stood.
    pub fn next(&mut self, latest: f64) -> Option<Event> {
        match self.rests {
            Some(side) => self.release(side, latest),
            None => self.impact(latest),
        }
    }

    fn start(&self) -> Point {
        Point { s: Real::of(0.0), z: self.z.clone() }
    }

    fn release(&mut self, side: f64, latest: f64) -> Option<Event> {
        let carrying = &self.carrying;
        // The wall's pull, and its rate.
        let pull = |point: &Point| {
            let rate = carrying.rate(&point.z);
            [&rate[1], &carrying.rate(&rate)[1]].map(|one| &Real::of(-side) * one)
        };
        let before = scan(carrying, self.start(), latest - self.time.to_f64(), &pull)?;
        let Point { s, z } = polished(carrying, before, &pull);
        self.time = &self.time + &s;
        self.y = &z[0] - &Real::of(side);
        self.y_velocity = z[1].clone();
        let event = Event::Release { tau: self.time.to_f64(), x: z[0].to_f64() };
        self.z = z;
        self.rests = None;
        Some(event)
    }

    fn impact(&mut self, latest: f64) -> Option<Event> {
        let (alone, y, u) = (&self.alone, &self.y, &self.y_velocity);
        let one = Real::of(1.0);
        let gap = |point: &Point| &point.z[0] - &(y + &(u * &point.s));
        // How far outside the absorber is, and its rate.
        let excess = |point: &Point| {
            let (gap, opening) = (gap(point), &point.z[1] - u);
            let rate = if gap.is_negative() { -&opening } else { opening };
            [&gap.abs() - &one, rate]
        };
        let span = latest - self.time.to_f64();
        let near = match self.short_flight() {
            Some(s) => alone.later(&self.start(), &s),
            None => scan(alone, self.start(), span, &excess)?,
        };
        let side = if gap(&near).is_negative() { -1.0 } else { 1.0 };
        let at = polished(alone, near, &excess);
        if at.s.to_f64() > span {
            return None;
        }
        self.time = &self.time + &at.s;
        Some(self.struck(&at.z, side))
    }

    /// Equation (2), and whether the absorber stays on the wall.
    fn struck(&mut self, z: &Vector, side: f64) -> Event {
        let (one, sign) = (Real::of(1.0), Real::of(side));
        let [x, v, sin, cos] = z.clone();
        let approach = &v - &self.y_velocity;
        let r = &self.restitution;
        let total = &one + &self.eps;
        let exchanged = &(&(&one + r) * &approach) / &total;
        let after = [&v - &(&self.eps * &exchanged), &self.y_velocity + &exchanged];
        let kept = &one - &(r * r);
        let loss = &(&(&self.eps * &kept) * &(&approach * &approach)) / &(&Real::of(2.0) * &total);
        let opening = &(&approach * r) * &sign;
        let closing = &sign * &self.alone.rate(z)[1];
        // The gap opens by u^2 / (2 a).
        let limit = &closing * &Real::of(2.0 * EXCURSION);
        let sticks = closing.is_positive() && !limit.is_below(&(&opening * &opening));
        // An excursion that rounding would fill is left to its parabola.
        let room = &(&Real::of(2.0 * ROOM * self.rounding) * &closing) - &(&opening * &opening);
        self.impacts += 1;
        let rounded = (GOLDEN * f64::from(self.impacts)).fract() < 0.5 && room.is_negative();
        let rounding = if rounded { self.rounding } else { 0.0 };
        self.y = &x - &(&sign * &(&one - &Real::of(rounding)));
        let [x_velocity, y_velocity] = if sticks || r.is_zero() {
            let common = &(&after[0] + &(&self.eps * &after[1])) / &total;
            [common.clone(), common]
        } else {
            after
        };
        let (tau, loss) = (self.time.to_f64(), loss.to_f64());
        let event = Event::Impact { tau, side, x: x.to_f64(), loss, sticks };
        self.z = [x, x_velocity, sin, cos];
        self.y_velocity = y_velocity;
        self.rests = sticks.then_some(side);
        event
    }

    /// The duration of a flight so short that it is a parabola, `2 u / a`, to nine digits.
    fn short_flight(&self) -> Option<Real> {
        let gap = &self.z[0] - &self.y;
        let touching = &gap.abs() - &Real::of(1.0);
        if !touching.abs().is_below(&Real::of(1e-60)) {
            return None;
        }
        let sign = Real::of(if gap.is_negative() { -1.0 } else { 1.0 });
        let opening = -&(&sign * &(&self.z[1] - &self.y_velocity));
        let closing = &sign * &self.alone.rate(&self.z)[1];
        if !(opening.is_positive() && closing.is_positive()) {
            return None;
        }
        let duration = &(&Real::of(2.0) * &opening) / &closing;
        let short = Real::of(SHORTEST * self.alone.scan_step());
        duration.is_below(&short).then_some(duration)
    }
}

/// The last point before what is `watched`, a value with its rate, exceeds 0, to a scan step halved
/// [`LEVELS`] times; `None` if it does not within `span`. Steps grow from that smallest one, doubling the
/// way each time. Between two points a maximum is looked at as well: a touch may be far shorter than a
/// step.
fn scan(
    oscillator: &Oscillator,
    start: Point,
    span: f64,
    watched: &impl Fn(&Point) -> [Real; 2],
) -> Option<Point> {
    let step = oscillator.scan_step();
    let mut rises = watched(&start)[1].is_positive();
    let mut here = start;
    let mut level = LEVELS;
    let mut walked = 0.0;
    loop {
        let there = oscillator.step(&here, level);
        let [value, rate] = watched(&there);
        if value.is_positive() {
            break;
        }
        if rises
            && !rate.is_positive()
            && let Some(before) = at_maximum(oscillator, &here, level, watched)
        {
            (here, level) = before;
            break;
        }
        (here, rises) = (there, rate.is_positive());
        walked += libm::scalbn(step, -(level as i32));
        if walked > span {
            return None;
        }
        // The first step is taken twice.
        if level > 0 && walked >= libm::scalbn(step, 1 - level as i32) {
            level -= 1;
        }
    }
    for finer in level + 1..=LEVELS {
        let there = oscillator.step(&here, finer);
        if !watched(&there)[0].is_positive() {
            here = there;
        }
    }
    Some(here)
}

/// Halves a step towards the maximum in it; where the value exceeds 0 on the way, the point before and
/// the halvings of the step from there.
fn at_maximum(
    oscillator: &Oscillator,
    from: &Point,
    level: usize,
    watched: &impl Fn(&Point) -> [Real; 2],
) -> Option<(Point, usize)> {
    let mut here = from.clone();
    for finer in level + 1..=LEVELS {
        let there = oscillator.step(&here, finer);
        let [value, rate] = watched(&there);
        if value.is_positive() {
            return Some((here, finer));
        }
        if rate.is_positive() {
            here = there;
        }
    }
    None
}

/// The zero of what is `watched` next to a point, by Newton's method.
fn polished(oscillator: &Oscillator, near: Point, watched: &impl Fn(&Point) -> [Real; 2]) -> Point {
    let mut at = near.clone();
    for _ in 0..CORRECTIONS {
        let [value, rate] = watched(&at);
        if value.is_zero() || rate.is_zero() {
            break;
        }
        let correction = &value / &rate;
        at = oscillator.later(&near, &(&(&at.s - &near.s) - &correction));
        if correction.abs().to_f64() <= CORRECTED * at.s.abs().to_f64() {
            break;
        }
    }
    at
}
