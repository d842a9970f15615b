//! A second opinion in 77 decimal digits: equations (1) and (2) once more, for a few dozen impacts.
//!
//! It shares no code with [`crate::simulation`] and none of its ideas: the oscillator is the
//! textbook's, walls are looked for by a fine scan in multiple precision whose first steps are a
//! thousand thousand million times shorter, a crossing is halved and polished by Newton's method, and
//! chattering is followed until the gap opens by 1e-40 clearances. It costs a thousand times as much
//! and proves nothing, but no rounding of the engine can hide behind its own.

mod oscillator;
pub mod real;

use oscillator::{LEVELS, Motion, Oscillator, Point};
use real::{Functions, Real};

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

/// The library for multiple precision could not allocate its constants.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("no memory for the constants of the multiple-precision reference")]
pub struct NoMemory;

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
    functions: Functions,
    eps: Real,
    restitution: Real,
    alone: Oscillator,
    carrying: Oscillator,
    time: Real,
    /// `x`, `x'`, `y`, `y'`.
    state: [Real; 4],
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
    ///
    /// # Errors
    /// [`NoMemory`].
    pub fn new(system: &System, start: State, rounding: f64) -> Result<Self, NoMemory> {
        let functions = Functions::new().ok_or(NoMemory)?;
        let eps = Real::of(system.mass_ratio());
        let alone = Oscillator::new(system, &Real::of(0.0), &functions);
        let carrying = Oscillator::new(system, &eps, &functions);
        let [x, v, y, u] = [start.x, start.x_velocity, start.y, start.y_velocity].map(Real::of);
        let gap = &x - &y;
        let side = if gap.is_negative() { -1.0 } else { 1.0 };
        let touches = (&gap.abs() - &Real::of(1.0)).is_zero() && (&v - &u).is_zero();
        let moved = Real::of(rounding);
        // What touches is moved together.
        let y = if touches { &y + &moved } else { y };
        let x = &x + &moved;
        let motion = alone.motion(&functions, &Real::of(0.0), &x, &v);
        let closing = &motion.at(motion.start()).a * &Real::of(side);
        let rests = (touches && closing.is_positive()).then_some(side);
        Ok(Self {
            functions,
            eps,
            restitution: Real::of(system.restitution()),
            alone,
            carrying,
            time: Real::of(0.0),
            state: [x, v, y, u],
            rests,
            rounding,
            impacts: 0,
        })
    }

    /// The next event; `None` if there is none up to `latest`, and then the trajectory stands where
    /// it stood.
    pub fn next(&mut self, latest: f64) -> Option<Event> {
        match self.rests {
            Some(side) => self.release(side, latest),
            None => self.impact(latest),
        }
    }

    fn release(&mut self, side: f64, latest: f64) -> Option<Event> {
        let [x, v, ..] = &self.state;
        let motion = self.carrying.motion(&self.functions, &self.time, x, v);
        let sign = Real::of(side);
        let pulls = |point: &Point| {
            let at = motion.at(point);
            Look { happened: (&sign * &at.a).is_negative(), rises: at.jerk.is_positive() }
        };
        let span = latest - self.time.to_f64();
        let before = scan(&motion, span, self.carrying.scan_step(), pulls)?;
        let s = polish(before.s, |s| {
            let at = motion.at(&motion.point(s));
            (at.a, at.jerk)
        });
        let at = motion.at(&motion.point(&s));
        self.time = &self.time + &s;
        let y = &at.x - &sign;
        let event = Event::Release { tau: self.time.to_f64(), x: at.x.to_f64() };
        self.state = [at.x, at.v.clone(), y, at.v];
        self.rests = None;
        Some(event)
    }

    fn impact(&mut self, latest: f64) -> Option<Event> {
        let [x, v, y, u] = &self.state;
        let motion = self.alone.motion(&self.functions, &self.time, x, v);
        let one = Real::of(1.0);
        let gap = |point: &Point| &motion.at(point).x - &(y + &(u * &point.s));
        let outside = |point: &Point| {
            let at = motion.at(point);
            let gap = &at.x - &(y + &(u * &point.s));
            let happened = (&gap.abs() - &one).is_positive();
            Look { happened, rises: (&at.v - u).is_positive() }
        };
        let span = latest - self.time.to_f64();
        let near = match self.short_flight(&motion) {
            Some(s) => s,
            None => scan(&motion, span, self.alone.scan_step(), outside)?.s,
        };
        let side = if gap(&motion.point(&near)).is_negative() { -1.0 } else { 1.0 };
        let sign = Real::of(side);
        let s = polish(near, |s| {
            let at = motion.at(&motion.point(s));
            (&(&at.x - &(y + &(u * s))) - &sign, &at.v - u)
        });
        if s.to_f64() > span {
            return None;
        }
        let at = motion.at(&motion.point(&s));
        self.time = &self.time + &s;
        let approach = &at.v - u;
        let r = &self.restitution;
        let total = &one + &self.eps;
        let exchanged = &(&(&one + r) * &approach) / &total;
        let after = [&at.v - &(&self.eps * &exchanged), u + &exchanged];
        let kept = &one - &(r * r);
        let loss = &(&(&self.eps * &kept) * &(&approach * &approach)) / &(&Real::of(2.0) * &total);
        let opening = &(&approach * r) * &sign;
        let closing = &sign * &at.a;
        // The gap opens by u^2 / (2 a).
        let limit = &closing * &Real::of(2.0 * EXCURSION);
        let sticks = closing.is_positive() && !limit.is_below(&(&opening * &opening));
        // An excursion that rounding would fill is left to its parabola.
        let room = &(&Real::of(2.0 * ROOM * self.rounding) * &closing) - &(&opening * &opening);
        self.impacts += 1;
        let rounded = (GOLDEN * f64::from(self.impacts)).fract() < 0.5 && room.is_negative();
        let rounding = if rounded { self.rounding } else { 0.0 };
        let place = &at.x - &(&sign * &(&one - &Real::of(rounding)));
        let event = Event::Impact {
            tau: self.time.to_f64(),
            side,
            x: at.x.to_f64(),
            loss: loss.to_f64(),
            sticks,
        };
        let [x_velocity, y_velocity] = after;
        self.state = if sticks || r.is_zero() {
            let common = &(&x_velocity + &(&self.eps * &y_velocity)) / &total;
            [at.x, common.clone(), place, common]
        } else {
            [at.x, x_velocity, place, y_velocity]
        };
        self.rests = sticks.then_some(side);
        Some(event)
    }

    /// The duration of a flight so short that it is a parabola, `2 u / a`, to nine digits.
    fn short_flight(&self, motion: &Motion) -> Option<Real> {
        let [x, v, y, u] = &self.state;
        let gap = x - y;
        let touching = &gap.abs() - &Real::of(1.0);
        if !touching.abs().is_below(&Real::of(1e-60)) {
            return None;
        }
        let sign = Real::of(if gap.is_negative() { -1.0 } else { 1.0 });
        let opening = -&(&sign * &(v - u));
        let closing = &sign * &motion.at(motion.start()).a;
        if !(opening.is_positive() && closing.is_positive()) {
            return None;
        }
        let duration = &(&Real::of(2.0) * &opening) / &closing;
        let short = Real::of(SHORTEST * self.alone.scan_step());
        duration.is_below(&short).then_some(duration)
    }
}

/// What a scan sees at a point.
#[derive(Clone, Copy)]
struct Look {
    happened: bool,
    /// Whether the curve that is watched rises there.
    rises: bool,
}

/// The last point before it happened, to a scan step halved [`LEVELS`] times; `None` if it has not
/// happened within `span`. Steps grow from that smallest one, doubling the way each time. Between two
/// points with opposite slopes the extremum is looked at as well: a touch may be far shorter than a
/// step.
fn scan(motion: &Motion, span: f64, step: f64, look: impl Fn(&Point) -> Look) -> Option<Point> {
    let mut here = motion.start().clone();
    let mut rises = look(&here).rises;
    let mut level = LEVELS;
    let mut walked = 0.0;
    loop {
        let there = motion.step(&here, level);
        let seen = look(&there);
        if seen.happened {
            break;
        }
        if seen.rises != rises
            && let Some((before, finer)) = at_extremum(motion, &here, level, rises, &look)
        {
            (here, level) = (before, finer);
            break;
        }
        (here, rises) = (there, seen.rises);
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
        let there = motion.step(&here, finer);
        if !look(&there).happened {
            here = there;
        }
    }
    Some(here)
}

/// Halves a step towards the extremum in it; where it has happened on the way, the point before and
/// the halvings of the step from there.
fn at_extremum(
    motion: &Motion,
    from: &Point,
    level: usize,
    rises: bool,
    look: &impl Fn(&Point) -> Look,
) -> Option<(Point, usize)> {
    let mut here = from.clone();
    for finer in level + 1..=LEVELS {
        let there = motion.step(&here, finer);
        let seen = look(&there);
        if seen.happened {
            return Some((here, finer));
        }
        if seen.rises == rises {
            here = there;
        }
    }
    None
}

/// Newton's method.
fn polish(mut s: Real, curve: impl Fn(&Real) -> (Real, Real)) -> Real {
    for _ in 0..CORRECTIONS {
        let (value, slope) = curve(&s);
        if value.is_zero() || slope.is_zero() {
            break;
        }
        let correction = &value / &slope;
        let size = correction.abs().to_f64();
        s = &s - &correction;
        if size <= CORRECTED * s.abs().to_f64() {
            break;
        }
    }
    s
}
