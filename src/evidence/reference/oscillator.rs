//! The oscillator of equation (1) in multiple precision, by the textbook: decaying exponentials, real
//! or complex, and the steady motion.

use super::real::{Functions, Real};
use crate::system::System;

/// Halvings of the scan's step for which the way is known in advance.
pub(super) const LEVELS: usize = 40;
/// Steps of the scan in the shortest period, or decay time, of the motion.
const SCAN: f64 = 64.0;

/// Free motion.
enum Kind {
    /// Underdamped, with its ringing frequency.
    Ringing(Real),
    /// Overdamped, with half the distance of its two rates.
    Creeping(Real),
    /// Critically damped.
    Critical,
}

/// An oscillator with its excitation, per unit of its own mass.
pub(super) struct Oscillator {
    decay: Real,
    stiffness: Real,
    omega: Real,
    /// Of `sin` and `cos` of the phase.
    force: [Real; 2],
    kind: Kind,
    /// Of `sin` and `cos` of the phase; `None` where the motion grows for ever.
    steady: Option<[Real; 2]>,
    /// By halvings of the scan's step.
    steps: Vec<Step>,
}

/// The way across one step.
struct Step {
    length: Real,
    /// Free motion: `x` and `v` from `x` and `v`.
    free: [Real; 4],
    /// Sine and cosine of the excitation's turn.
    turn: [Real; 2],
}

/// Where a motion is, a time `s` after it began at `begin`.
#[derive(Clone)]
pub(super) struct Point {
    pub s: Real,
    free: [Real; 2],
    sin: Real,
    cos: Real,
}

/// One stretch of smooth motion.
pub(super) struct Motion<'a> {
    oscillator: &'a Oscillator,
    functions: &'a Functions,
    begin: Real,
    start: Point,
}

/// Displacement, velocity, acceleration and jerk.
pub(super) struct Kinematics {
    pub x: Real,
    pub v: Real,
    pub a: Real,
    pub jerk: Real,
}

impl Oscillator {
    /// The oscillator of a system that carries `added` mass, relative to its own.
    pub(super) fn new(system: &System, added: &Real, functions: &Functions) -> Self {
        let p = system.parameters();
        let (one, two) = (Real::of(1.0), Real::of(2.0));
        let mass = &one + added;
        let omega = Real::of(p.frequency_ratio);
        let damping = &Real::of(p.mass_ratio) * &Real::of(p.damping);
        let sine = &Real::of(p.mass_ratio) * &Real::of(p.forcing_per_clearance);
        let cosine = match p.excitation {
            crate::system::Excitation::BaseDisplacement => &(&damping * &omega) * &sine,
            crate::system::Excitation::Force => Real::of(0.0),
        };
        let force = [&sine / &mass, &cosine / &mass];
        let decay = &(&damping / &mass) / &two;
        let stiffness = &one / &mass;
        let discriminant = &stiffness - &(&decay * &decay);
        let kind = if discriminant.is_positive() {
            Kind::Ringing(discriminant.sqrt())
        } else if discriminant.is_negative() {
            Kind::Creeping((-&discriminant).sqrt())
        } else {
            Kind::Critical
        };
        let reactance = &stiffness - &(&omega * &omega);
        let loss = &(&two * &decay) * &omega;
        let scale = &(&reactance * &reactance) + &(&loss * &loss);
        let steady = (!scale.is_zero()).then(|| {
            [
                &(&(&force[0] * &reactance) + &(&force[1] * &loss)) / &scale,
                &(&(&force[1] * &reactance) - &(&force[0] * &loss)) / &scale,
            ]
        });
        let fastest = 1.0_f64.max(p.frequency_ratio).max(2.0 * decay.to_f64());
        let mut oscillator =
            Self { decay, stiffness, omega, force, kind, steady, steps: Vec::new() };
        let mut length = Real::of(std::f64::consts::TAU / (SCAN * fastest));
        for _ in 0..=LEVELS {
            oscillator.steps.push(oscillator.step(&length, functions));
            length = &length / &two;
        }
        oscillator
    }

    fn step(&self, length: &Real, functions: &Functions) -> Step {
        let (one, zero) = (Real::of(1.0), Real::of(0.0));
        let [xx, vx] = self.free([&one, &zero], length, functions);
        let [xv, vv] = self.free([&zero, &one], length, functions);
        let (sin, cos) = functions.sincos(&(&self.omega * length));
        Step { length: length.clone(), free: [xx, xv, vx, vv], turn: [sin, cos] }
    }

    /// Length of the scan's step.
    pub(super) fn scan_step(&self) -> f64 {
        self.steps[0].length.to_f64()
    }

    /// Free motion a time `s` after `x`, `v`.
    fn free(&self, [x, v]: [&Real; 2], s: &Real, functions: &Functions) -> [Real; 2] {
        let d = &self.decay;
        match &self.kind {
            Kind::Ringing(w) => {
                let envelope = functions.exp(&-&(d * s));
                let (sin, cos) = functions.sincos(&(w * s));
                let (sin, cos) = (&envelope * &sin, &envelope * &cos);
                // e^{-d s} (x cos + c sin)
                let c = &(v + &(d * x)) / w;
                let fall = &(x * w) + &(d * &c);
                [&(x * &cos) + &(&c * &sin), &(v * &cos) - &(&fall * &sin)]
            }
            Kind::Creeping(spread) => {
                let (slow, fast) = (spread - d, -&(d + spread));
                let part = &(v - &(&fast * x)) / &(&slow - &fast);
                let rest = x - &part;
                let part = &part * &functions.exp(&(&slow * s));
                let rest = &rest * &functions.exp(&(&fast * s));
                [&part + &rest, &(&slow * &part) + &(&fast * &rest)]
            }
            Kind::Critical => {
                let envelope = functions.exp(&-&(d * s));
                let rate = v + &(d * x);
                let there = x + &(&rate * s);
                [&there * &envelope, &(&rate - &(d * &there)) * &envelope]
            }
        }
    }

    /// Displacement and velocity of the forced motion at a time with the given sine and cosine of the
    /// phase.
    fn forced(&self, time: &Real, sin: &Real, cos: &Real) -> [Real; 2] {
        if let Some([p, q]) = &self.steady {
            return [&(p * sin) + &(q * cos), &self.omega * &(&(p * cos) - &(q * sin))];
        }
        // Undamped and driven at its own frequency: a vibration that grows in proportion to time.
        let [p, q] = &self.force;
        let two = Real::of(2.0);
        let slope = &(&(q * sin) - &(p * cos)) / &(&two * &self.omega);
        let force = &(p * sin) + &(q * cos);
        [&slope * time, &slope + &(&(time * &force) / &two)]
    }

    /// The motion through `x`, `v` at the time `begin`; the excitation's phase is 0 at time 0.
    pub(super) fn motion<'a>(
        &'a self,
        functions: &'a Functions,
        begin: &Real,
        x: &Real,
        v: &Real,
    ) -> Motion<'a> {
        let (sin, cos) = functions.sincos(&(&self.omega * begin));
        let [forced_x, forced_v] = self.forced(begin, &sin, &cos);
        let start = Point { s: Real::of(0.0), free: [x - &forced_x, v - &forced_v], sin, cos };
        Motion { oscillator: self, functions, begin: begin.clone(), start }
    }
}

impl Motion<'_> {
    /// The motion's beginning.
    pub(super) fn start(&self) -> &Point {
        &self.start
    }

    /// One step further: the scan's step halved `level` times.
    pub(super) fn step(&self, from: &Point, level: usize) -> Point {
        let Step { length, free: [xx, xv, vx, vv], turn: [sin, cos] } =
            &self.oscillator.steps[level];
        let [x, v] = &from.free;
        Point {
            s: &from.s + length,
            free: [&(xx * x) + &(xv * v), &(vx * x) + &(vv * v)],
            sin: &(&from.sin * cos) + &(&from.cos * sin),
            cos: &(&from.cos * cos) - &(&from.sin * sin),
        }
    }

    /// The point at any time, by exponentials and sines.
    pub(super) fn point(&self, s: &Real) -> Point {
        let Self { oscillator, functions, begin, start } = self;
        let free = oscillator.free([&start.free[0], &start.free[1]], s, functions);
        let (sin, cos) = functions.sincos(&(&oscillator.omega * &(begin + s)));
        Point { s: s.clone(), free, sin, cos }
    }

    /// What moves how fast there, by equation (1).
    pub(super) fn at(&self, point: &Point) -> Kinematics {
        let o = self.oscillator;
        let Point { s, free, sin, cos } = point;
        let [forced_x, forced_v] = o.forced(&(&self.begin + s), sin, cos);
        let (x, v) = (&free[0] + &forced_x, &free[1] + &forced_v);
        let [p, q] = &o.force;
        let two = Real::of(2.0);
        let damping = &two * &o.decay;
        let force = &(p * sin) + &(q * cos);
        let a = &(&force - &(&damping * &v)) - &(&o.stiffness * &x);
        let rate = &o.omega * &(&(p * cos) - &(q * sin));
        let jerk = &(&rate - &(&damping * &a)) - &(&o.stiffness * &v);
        Kinematics { x, v, a, jerk }
    }
}
