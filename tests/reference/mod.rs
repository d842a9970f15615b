//! The truth about impact times, to 77 decimal digits and without a line of the engine: the closed
//! form between impacts in multiple precision, scanned finely, polished by Newton. Underdamped
//! oscillators under base displacement; no sustained contact.
#![allow(dead_code)]

use std::cell::RefCell;

use vinesink::system::{Parameters, System};
pub use vinesink_evidence::reference::real::Decimal;
use vinesink_evidence::reference::real::{BITS, Consts, ROUND};

/// Distance from a wall, over the clearance, that no motion here crosses and comes back within one
/// step: an eighth of its square times accelerations of some clearances.
const NEAR: f64 = 0.01;

thread_local! {
    static CONSTANTS: RefCell<Consts> = RefCell::new(Consts::new().expect("constants"));
}

fn sincos(angle: &Decimal) -> (Decimal, Decimal) {
    CONSTANTS.with_borrow_mut(|constants| {
        (Decimal(angle.0.sin(BITS, ROUND, constants)), Decimal(angle.0.cos(BITS, ROUND, constants)))
    })
}

fn exp(number: &Decimal) -> Decimal {
    CONSTANTS.with_borrow_mut(|constants| Decimal(number.0.exp(BITS, ROUND, constants)))
}

#[test]
fn functions_have_seventy_digits() {
    let angle = &Decimal::of(1e3) / &Decimal::of(3.0);
    let (sin, cos) = sincos(&angle);
    let one = &(&sin * &sin) + &(&cos * &cos);
    assert!((&one - &Decimal::of(1.0)).to_f64().abs() < 1e-75);
    let (up, down) = (exp(&angle), exp(&-&angle));
    assert!((&(&up * &down) - &Decimal::of(1.0)).to_f64().abs() < 1e-70);
    // Abramowitz and Stegun, table 4.6: sin 1.
    assert!((sincos(&Decimal::of(1.0)).0.to_f64() - 0.841_470_984_807_896_5).abs() < 1e-15);
}

/// One flight: absolute time of its start, state there.
struct Flight<'a> {
    reference: &'a Reference,
    start: Decimal,
    free_x: Decimal,
    free_v: Decimal,
    y: Decimal,
    y_velocity: Decimal,
}

/// A system whose motions it knows.
pub struct Reference {
    eps: Decimal,
    restitution: Decimal,
    omega: Decimal,
    decay: Decimal,
    ringing: Decimal,
    steady: [Decimal; 2],
    /// Displacement that the oscillator is pushed to, and its rate.
    line: [Decimal; 2],
}

impl Reference {
    /// Under a force `f + g tau` over the clearance and the oscillator's stiffness, instead of the excitation.
    pub fn pushed(system: &System, [f, g]: [f64; 2]) -> Self {
        let none = Parameters { forcing_per_clearance: 0.0, ..system.parameters() };
        let without = Self::new(&System::new(none).expect("valid"));
        let lag = &(&Decimal::of(2.0) * &without.decay) * &Decimal::of(g);
        Self { line: [&Decimal::of(f) - &lag, Decimal::of(g)], ..without }
    }

    pub fn new(system: &System) -> Self {
        let p = system.parameters();
        let (eps, lambda, omega) =
            (Decimal::of(p.mass_ratio), Decimal::of(p.damping), Decimal::of(p.frequency_ratio));
        let (one, two) = (Decimal::of(1.0), Decimal::of(2.0));
        let damping = &eps * &lambda;
        let decay = &damping / &two;
        let ringing = Decimal((&one - &(&decay * &decay)).0.sqrt(BITS, ROUND));
        let sine = &eps * &Decimal::of(p.forcing_per_clearance);
        let cosine = &(&damping * &omega) * &sine;
        let reactance = &one - &(&omega * &omega);
        let loss = &damping * &omega;
        let scale = &(&reactance * &reactance) + &(&loss * &loss);
        let steady = [
            &(&(&sine * &reactance) + &(&cosine * &loss)) / &scale,
            &(&(&cosine * &reactance) - &(&sine * &loss)) / &scale,
        ];
        Self {
            eps,
            restitution: Decimal::of(p.restitution),
            omega,
            decay,
            ringing,
            steady,
            line: [0.0; 2].map(Decimal::of),
        }
    }

    fn forced(&self, tau: &Decimal) -> [Decimal; 2] {
        let phase = &self.omega * tau;
        let (sin, cos) = sincos(&phase);
        let [p, q] = &self.steady;
        let [level, rate] = &self.line;
        let x = &(&(p * &sin) + &(q * &cos)) + &(level + &(rate * tau));
        [x, &(&self.omega * &(&(p * &cos) - &(q * &sin))) + rate]
    }

    fn flight(&self, start: Decimal, state: &[Decimal; 4]) -> Flight<'_> {
        let [x, v] = self.forced(&start);
        Flight {
            reference: self,
            start,
            free_x: &state[0] - &x,
            free_v: &state[1] - &v,
            y: state[2].clone(),
            y_velocity: state[3].clone(),
        }
    }
}

impl Flight<'_> {
    /// `x`, `x'`, `y`, `y'` after a time `s`.
    fn at(&self, s: &Decimal) -> [Decimal; 4] {
        let r = self.reference;
        let envelope = exp(&-&(&r.decay * s));
        let angle = &r.ringing * s;
        let (sin, cos) = sincos(&angle);
        let (sin, cos) = (&envelope * &sin, &envelope * &cos);
        // x = e^{-d s} (a cos + c sin) with c = (v + d a) / w
        let c = &(&self.free_v + &(&r.decay * &self.free_x)) / &r.ringing;
        let x = &(&self.free_x * &cos) + &(&c * &sin);
        let rate = &(&c * &r.ringing) - &(&r.decay * &self.free_x);
        let fall = &(&self.free_x * &r.ringing) + &(&r.decay * &c);
        let v = &(&rate * &cos) - &(&fall * &sin);
        let [fx, fv] = r.forced(&(&self.start + s));
        [&x + &fx, &v + &fv, &self.y + &(&self.y_velocity * s), self.y_velocity.clone()]
    }

    /// First time at which `abs(x - y)` reaches 1, and the wall, by steps of `step`, and of the
    /// 64th part of that near a wall, where a whole one could pass over a graze; none after the latest.
    fn first_impact(&self, step: f64, latest: f64) -> Option<(Decimal, f64)> {
        let mut s = step.min(latest);
        loop {
            let [x, _, y, _] = self.at(&Decimal::of(s));
            let gap = &x - &y;
            let side = if gap.is_negative() { -1.0 } else { 1.0 };
            let excess = &(&Decimal::of(side) * &gap) - &Decimal::of(1.0);
            if !excess.is_negative() {
                return Some((self.impact_near(Decimal::of(s), side, 9), side));
            }
            if s >= latest {
                return None;
            }
            s = latest.min(s + if excess.to_f64() > -NEAR { step / 64.0 } else { step });
        }
    }

    /// The time at which that wall is met, by Newton: each correction doubles the digits.
    fn impact_near(&self, guess: Decimal, side: f64, corrections: u32) -> Decimal {
        let mut root = guess;
        for _ in 0..corrections {
            let [x, v, y, u] = self.at(&root);
            let correction = &(&(&x - &y) - &Decimal::of(side)) / &(&v - &u);
            root = &root - &correction;
        }
        root
    }
}

/// A moment of the reference motion: absolute time, and the state there, after the impact if there
/// was one: `x`, `x'`, `y`, `y'`.
#[derive(Clone, Debug)]
pub struct Moment {
    pub time: Decimal,
    pub state: [Decimal; 4],
    /// The wall, +1 or -1; 0 at the start of a motion.
    pub side: f64,
    /// Relative speed with which the wall was met.
    pub approach: f64,
}

impl Moment {
    /// The start of a motion at excitation phase 0.
    pub fn start(state: [f64; 4]) -> Self {
        Self { time: Decimal::of(0.0), state: state.map(Decimal::of), side: 0.0, approach: 0.0 }
    }
}

impl Reference {
    /// The next impact, searched in steps of `step`.
    pub fn next(&self, from: &Moment, step: f64) -> Moment {
        let flight = self.flight(from.time.clone(), &from.state);
        let (after, side) = flight.first_impact(step, f64::INFINITY).expect("an impact");
        self.struck(&flight, after, side)
    }

    /// The impacts from a moment up to a time, and the moment then.
    pub fn until(&self, mut from: Moment, end: f64, step: f64) -> (Vec<Moment>, Moment) {
        let mut impacts = Vec::new();
        loop {
            let flight = self.flight(from.time.clone(), &from.state);
            let left = &Decimal::of(end) - &from.time;
            let Some((after, side)) = flight.first_impact(step, left.to_f64()) else {
                let state = flight.at(&left);
                return (
                    impacts,
                    Moment { time: Decimal::of(end), state, side: 0.0, approach: 0.0 },
                );
            };
            from = self.struck(&flight, after, side);
            impacts.push(from.clone());
        }
    }

    /// The impact of a motion next to one that meets the wall `side` about `after` later, within
    /// `1e-20` of it.
    pub fn next_near(&self, from: &Moment, after: &Decimal, side: f64) -> Moment {
        let flight = self.flight(from.time.clone(), &from.state);
        let after = flight.impact_near(after.clone(), side, 3);
        self.struck(&flight, after, side)
    }

    /// Equation (2) at the end of a flight.
    fn struck(&self, flight: &Flight, after: Decimal, side: f64) -> Moment {
        let [x, v, _, u] = flight.at(&after);
        let approach = &v - &u;
        let exchanged = &(&(&Decimal::of(1.0) + &self.restitution) * &approach)
            / &(&Decimal::of(1.0) + &self.eps);
        Moment {
            time: &flight.start + &after,
            state: [
                x.clone(),
                &v - &(&self.eps * &exchanged),
                &x - &Decimal::of(side),
                &u + &exchanged,
            ],
            side,
            approach: approach.to_f64(),
        }
    }
}
