//! Impact times against a reference of 77 decimal digits that shares no code with the engine: the
//! closed form between impacts in multiple precision, scanned finely, polished by Newton.

mod common;

use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Neg, Sub};

use astro_float::{BigFloat, Consts, Radix, RoundingMode};
use vinesink::simulation::{ImpactLog, Simulation, Stop};
use vinesink::system::{State, System};

const BITS: usize = 256;
const ROUND: RoundingMode = RoundingMode::ToEven;

thread_local! {
    static CONSTS: RefCell<Consts> = RefCell::new(Consts::new().expect("constants"));
}

#[derive(Clone, Debug)]
struct Real(BigFloat);

impl Real {
    fn of(number: f64) -> Self {
        Self(BigFloat::from_f64(number, BITS))
    }
    fn sin(&self) -> Self {
        Self(CONSTS.with(|c| self.0.sin(BITS, ROUND, &mut c.borrow_mut())))
    }
    fn cos(&self) -> Self {
        Self(CONSTS.with(|c| self.0.cos(BITS, ROUND, &mut c.borrow_mut())))
    }
    fn exp(&self) -> Self {
        Self(CONSTS.with(|c| self.0.exp(BITS, ROUND, &mut c.borrow_mut())))
    }
    fn sqrt(&self) -> Self {
        Self(self.0.sqrt(BITS, ROUND))
    }
    fn is_negative(&self) -> bool {
        self.0.is_negative()
    }
    fn to_f64(&self) -> f64 {
        let text = CONSTS.with(|c| self.0.format(Radix::Dec, ROUND, &mut c.borrow_mut()));
        text.expect("a number").parse().expect("a number")
    }
}

macro_rules! operator {
    ($name:ident, $method:ident) => {
        impl $name for &Real {
            type Output = Real;
            fn $method(self, other: &Real) -> Real {
                Real(self.0.$method(&other.0, BITS, ROUND))
            }
        }
    };
}
operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);
impl Neg for &Real {
    type Output = Real;
    fn neg(self) -> Real {
        Real(BigFloat::neg(&self.0))
    }
}

/// One flight: absolute time of its start, state there.
struct Flight<'a> {
    reference: &'a Reference,
    start: Real,
    free_x: Real,
    free_v: Real,
    y: Real,
    y_velocity: Real,
}

struct Reference {
    eps: Real,
    restitution: Real,
    omega: Real,
    decay: Real,
    ringing: Real,
    steady: [Real; 2],
}

impl Reference {
    fn new(system: &System) -> Self {
        let p = system.parameters();
        let (eps, lambda, omega) =
            (Real::of(p.mass_ratio), Real::of(p.damping), Real::of(p.frequency_ratio));
        let (one, two) = (Real::of(1.0), Real::of(2.0));
        let damping = &eps * &lambda;
        let decay = &damping / &two;
        let ringing = (&one - &(&decay * &decay)).sqrt();
        let sine = &eps * &Real::of(p.forcing_per_clearance);
        let cosine = &(&damping * &omega) * &sine;
        let reactance = &one - &(&omega * &omega);
        let loss = &damping * &omega;
        let scale = &(&reactance * &reactance) + &(&loss * &loss);
        let steady = [
            &(&(&sine * &reactance) + &(&cosine * &loss)) / &scale,
            &(&(&cosine * &reactance) - &(&sine * &loss)) / &scale,
        ];
        Self { eps, restitution: Real::of(p.restitution), omega, decay, ringing, steady }
    }

    fn forced(&self, tau: &Real) -> [Real; 2] {
        let phase = &self.omega * tau;
        let (sin, cos) = (phase.sin(), phase.cos());
        let [p, q] = &self.steady;
        [&(p * &sin) + &(q * &cos), &self.omega * &(&(p * &cos) - &(q * &sin))]
    }

    fn flight(&self, start: Real, state: &[Real; 4]) -> Flight<'_> {
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
    fn at(&self, s: &Real) -> [Real; 4] {
        let r = self.reference;
        let envelope = (-&(&r.decay * s)).exp();
        let angle = &r.ringing * s;
        let (sin, cos) = (&envelope * &angle.sin(), &envelope * &angle.cos());
        // x = e^{-d s} (a cos + c sin) with c = (v + d a) / w
        let c = &(&self.free_v + &(&r.decay * &self.free_x)) / &r.ringing;
        let x = &(&self.free_x * &cos) + &(&c * &sin);
        let rate = &(&c * &r.ringing) - &(&r.decay * &self.free_x);
        let fall = &(&self.free_x * &r.ringing) + &(&r.decay * &c);
        let v = &(&rate * &cos) - &(&fall * &sin);
        let [fx, fv] = r.forced(&(&self.start + s));
        [&x + &fx, &v + &fv, &self.y + &(&self.y_velocity * s), self.y_velocity.clone()]
    }

    /// First time at which `abs(x - y)` reaches 1, by steps of `step` and Newton.
    fn impact(&self, step: f64) -> (Real, f64) {
        let mut s = step;
        loop {
            let [x, _, y, _] = self.at(&Real::of(s));
            let gap = &x - &y;
            let side = if gap.is_negative() { -1.0 } else { 1.0 };
            let excess = &(&Real::of(side) * &gap) - &Real::of(1.0);
            if !excess.is_negative() {
                let mut root = Real::of(s);
                for _ in 0..9 {
                    let [x, v, y, u] = self.at(&root);
                    let correction = &(&(&x - &y) - &Real::of(side)) / &(&v - &u);
                    root = &root - &correction;
                }
                return (root, side);
            }
            s += step;
        }
    }
}

#[test]
fn impact_times_agree_with_the_multiple_precision_reference_over_fifty_periods() {
    let system = common::table_1(8.0, 7.5);
    let start = State { x: 0.25, x_velocity: 0.3, y: -0.4, y_velocity: 0.6 };
    let mut simulation = Simulation::new(&system, start, 0.0).expect("inside the cavity");
    let mut log = ImpactLog::default();
    assert_eq!(simulation.run(50, 10_000, &mut log), Stop::EndTime);
    assert!(log.impacts.len() > 95, "a stable 1:1 case: {} impacts", log.impacts.len());

    let reference = Reference::new(&system);
    let mut time = Real::of(0.0);
    let mut state = [start.x, start.x_velocity, start.y, start.y_velocity].map(Real::of);
    let mut worst = 0.0_f64;
    for impact in &log.impacts {
        let flight = reference.flight(time.clone(), &state);
        let (s, side) = flight.impact(system.period() / 97.0);
        time = &time + &s;
        let [x, v, _, u] = flight.at(&s);
        let one = Real::of(1.0);
        let exchanged = &(&(&one + &reference.restitution) * &(&v - &u)) / &(&one + &reference.eps);
        state =
            [x.clone(), &v - &(&reference.eps * &exchanged), &x - &Real::of(side), &u + &exchanged];
        assert_eq!(impact.side.sign(), side);
        worst = worst.max((impact.tau - time.to_f64()).abs());
    }
    // A stable orbit forgets rounding; what is left is some ulps of tau = 330, 6e-14 each.
    assert!(worst < 1e-12, "largest error of an impact time: {worst:e}");
}
