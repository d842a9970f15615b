//! What holds along every trajectory, whatever the system and the start.
//!
//! The truth is physics that the engine does not use: between impacts the motion is the textbook's
//! closed form, written here a second time (underdamped, steady part plus decaying part); at an
//! impact momentum is kept and equation (2) reverses the relative velocity; a wall pushes and never
//! pulls; the absorber never leaves its cavity.

use crate::common;
use std::f64::consts::TAU;

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use vinesink::simulation::AbsorberMotion;
use vinesink::simulation::{
    Impact, ImpactLog, Measurement, Observer, Segment, Side, Simulation, StartError, Stop, Trace,
};
use vinesink::system::{Cavity, Excitation, Parameters, State, System};

/// Largest number of impacts of one random run; chattering near r = 1 may use it up.
const IMPACT_LIMIT: u64 = 30_000;
/// Points at which the cavity is looked into, per excitation period.
const GRID: f64 = 400.0;

/// Rounding of positions and velocities of the given size, after some dozen operations.
fn rounding(size: f64) -> f64 {
    64.0 * f64::EPSILON * (1.0 + size)
}

fn size(state: &State) -> f64 {
    state.x.abs() + state.x_velocity.abs() + state.y.abs() + state.y_velocity.abs()
}

/// The oscillator of equation (1) by the textbook: steady part plus decaying, ringing part.
#[derive(Debug, Clone, Copy)]
struct Textbook {
    decay: f64,
    ringing: f64,
    omega: f64,
    sine: f64,
    cosine: f64,
    force: [f64; 2],
}

impl Textbook {
    /// `None` where this form loses digits: not underdamped, or on a sharp resonance.
    fn of(system: &System) -> Option<Self> {
        let Parameters { mass_ratio: eps, damping, frequency_ratio: omega, .. } =
            system.parameters();
        let decay = 0.5 * eps * damping;
        let force = eps * system.forcing_per_clearance();
        let transmitted = match system.excitation() {
            Excitation::BaseDisplacement => eps * damping * omega,
            Excitation::Force => 0.0,
        };
        let force = [force, force * transmitted];
        let (stiffness, loss) = (1.0 - omega * omega, 2.0 * decay * omega);
        let scale = stiffness * stiffness + loss * loss;
        (decay < 0.9 && scale > 1e-4).then(|| Self {
            decay,
            ringing: (1.0 - decay * decay).sqrt(),
            omega,
            sine: (force[0] * stiffness + force[1] * loss) / scale,
            cosine: (force[1] * stiffness - force[0] * loss) / scale,
            force,
        })
    }

    fn steady(&self, phase: f64) -> [f64; 2] {
        let (sin, cos) = libm::sincos(phase);
        [self.sine * sin + self.cosine * cos, self.omega * (self.sine * cos - self.cosine * sin)]
    }

    /// Displacement and velocity a time `s` after passing `x`, `v` at `phase`.
    fn at(&self, x: f64, v: f64, phase: f64, s: f64) -> [f64; 2] {
        let [steady_x, steady_v] = self.steady(phase);
        let a = x - steady_x;
        let b = (v - steady_v + self.decay * a) / self.ringing;
        let envelope = libm::exp(-self.decay * s);
        let (sin, cos) = libm::sincos(self.ringing * s);
        let [later_x, later_v] = self.steady(phase + self.omega * s);
        let free = envelope * (a * cos + b * sin);
        let rate = envelope * self.ringing * (b * cos - a * sin) - self.decay * free;
        [free + later_x, rate + later_v]
    }

    fn acceleration(&self, x: f64, v: f64, phase: f64) -> f64 {
        let (sin, cos) = libm::sincos(phase);
        self.force[0] * sin + self.force[1] * cos - 2.0 * self.decay * v - x
    }
}

/// Looks at everything that happens and refuses what physics refuses.
struct Inspector {
    system: System,
    textbook: Option<Textbook>,
    complaint: Option<String>,
    /// State and phase at the end of the last stretch, of the given absorber.
    last: Option<(State, AbsorberMotion)>,
    carried: u64,
    released: u64,
    impacts: Vec<Impact>,
}

impl Inspector {
    fn new(system: &System) -> Self {
        Self {
            system: *system,
            textbook: Textbook::of(system),
            complaint: None,
            last: None,
            carried: 0,
            released: 0,
            impacts: Vec::new(),
        }
    }

    fn check(&mut self, holds: bool, complaint: impl FnOnce() -> String) {
        if !holds && self.complaint.is_none() {
            self.complaint = Some(complaint());
        }
    }

    fn look_into_the_cavity(&mut self, segment: &Segment) {
        let start = segment.at(0.0);
        // Free and steady motion may be far larger than their sum, and each of them is rounded.
        let (sine, cosine) = segment.motion.oscillator().steady.unwrap_or_default();
        let cancelled = f64::EPSILON * libm::hypot(sine, cosine);
        let pieces = (GRID * segment.duration / self.system.period()).ceil().max(4.0);
        for k in 0..=pieces as u64 {
            let s = segment.duration * k as f64 / pieces;
            let state = segment.at(s);
            let gap = state.relative_displacement().abs();
            // NaN is not below anything.
            self.check(gap <= 1.0 + rounding(size(&state) + size(&start)) + cancelled, || {
                format!("abs(w) = {gap} at {s} of {segment:?}")
            });
            let (Some(textbook), AbsorberMotion::Flying { y, y_velocity, .. }) =
                (self.textbook, segment.absorber)
            else {
                continue;
            };
            let [x, v] = textbook.at(start.x, start.x_velocity, segment.phase, s);
            let gap = (x - y - y_velocity * s).abs();
            let largest = 1.0 + size(&start) + textbook.force[0] + size(&state);
            self.check(gap < 1.0 + 1e-9, || format!("stepped over: {gap} at {s} of {segment:?}"));
            // On the sharpest resonance that is left, the steady part is 100 times the motion.
            let same = (x - state.x).abs() + (v - state.x_velocity).abs() < 1e-12 * largest;
            self.check(same, || format!("{x} {v} is not {state:?}"));
        }
    }

    fn feel_the_contact(&mut self, segment: &Segment, side: Side) {
        let Parameters { mass_ratio: eps, damping, frequency_ratio, .. } = self.system.parameters();
        let force = eps * self.system.forcing_per_clearance();
        let transmitted = match self.system.excitation() {
            Excitation::BaseDisplacement => eps * damping * frequency_ratio,
            Excitation::Force => 0.0,
        };
        for k in 0..=50 {
            let s = segment.duration * f64::from(k) / 50.0;
            let state = segment.at(s);
            let (sin, cos) = libm::sincos(segment.phase + frequency_ratio * s);
            let total =
                force * (sin + transmitted * cos) - eps * damping * state.x_velocity - state.x;
            // The wall accelerates the absorber together with the oscillator.
            let push = side.sign() * total / (1.0 + eps);
            let size = size(&state) * (1.0 + eps * damping) + force * (1.0 + transmitted);
            self.check(push > -rounding(size), || format!("the wall pulls: {push} in {segment:?}"));
        }
    }
}

impl Observer for Inspector {
    fn segment(&mut self, segment: &Segment) {
        match segment.absorber {
            AbsorberMotion::Flying { .. } => {
                self.released +=
                    u64::from(matches!(self.last, Some((_, AbsorberMotion::Carried(_)))));
            }
            AbsorberMotion::Carried(side) => {
                self.carried += 1;
                self.feel_the_contact(segment, side);
            }
            AbsorberMotion::Held { .. } => panic!("held without friction: {segment:?}"),
        }
        self.look_into_the_cavity(segment);
        self.last = Some((segment.at(segment.duration), segment.absorber));
    }

    fn impact(&mut self, impact: &Impact) {
        let eps = self.system.mass_ratio();
        let r = self.system.restitution();
        let (x, y) = (impact.x_velocity_before, impact.y_velocity_before);
        let (later_x, later_y) = (impact.x_velocity_after, impact.y_velocity_after);
        let small = rounding(x.abs() + y.abs());
        self.check((x + eps * y - later_x - eps * later_y).abs() <= small, || {
            format!("momentum changes: {impact:?}")
        });
        self.check((later_x - later_y + r * (x - y)).abs() <= small, || {
            format!("restitution is not {r}: {impact:?}")
        });
        self.check(impact.side.sign() * (x - y) > 0.0, || format!("not approaching: {impact:?}"));
        let energy = |x: f64, y: f64| 0.5 * (x * x + eps * y * y);
        let (before, after) = (energy(x, y), energy(later_x, later_y));
        let small = rounding(before) * 4.0;
        self.check(after <= before + small, || format!("energy rises: {impact:?}"));
        self.check((before - after - impact.loss).abs() <= small && impact.loss >= 0.0, || {
            format!("the loss is not {}: {impact:?}", before - after)
        });
        let later = self.impacts.last().is_none_or(|last| last.tau <= impact.tau);
        self.check(later, || format!("time runs backwards: {impact:?}"));
        self.impacts.push(*impact);
    }
}

fn systems() -> impl Strategy<Value = System> {
    let restitution = prop_oneof![8 => 0.0..=1.0, 1 => Just(0.0), 1 => Just(1.0)];
    let damping = prop_oneof![6 => 0.0..50.0, 1 => Just(0.0), 1 => 0.0..2.0];
    let excitation = prop_oneof![Just(Excitation::BaseDisplacement), Just(Excitation::Force)];
    (-5.0..-0.301, damping, restitution, 0.3..3.0, -2.0..2.0, excitation).prop_map(
        |(log_eps, damping, restitution, frequency_ratio, log_gamma, excitation)| {
            System::new(Parameters {
                mass_ratio: libm::exp10(log_eps),
                damping,
                restitution,
                frequency_ratio,
                forcing_per_clearance: libm::exp10(log_gamma),
                excitation,
                cavity: Cavity::IDEAL,
            })
            .expect("valid")
        },
    )
}

fn starts() -> impl Strategy<Value = State> {
    (-3.0..3.0, -3.0..3.0, -1.0..=1.0, -3.0..3.0).prop_map(|(x, x_velocity, gap, y_velocity)| {
        State { x, x_velocity, y: x - gap, y_velocity }
    })
}

fn limited(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(2016),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// Everything about a run, to the last bit.
fn bits(impacts: &[Impact], state: State) -> Vec<u64> {
    let end = [state.x, state.x_velocity, state.y, state.y_velocity];
    impacts
        .iter()
        .flat_map(|impact| {
            [impact.tau, impact.phase, impact.x, impact.x_velocity_after, impact.y_velocity_after]
        })
        .chain(end)
        .map(f64::to_bits)
        .collect()
}

proptest! {
    #![proptest_config(limited(500))]

    #[test]
    fn every_trajectory_obeys_the_laws(
        system in systems(),
        start in starts(),
        periods in 20_u64..50,
    ) {
        let mut simulation = Simulation::new(&system, start, 0.0).expect("inside the cavity");
        let mut inspector = Inspector::new(&system);
        let mut measurement = Measurement::begin(&system, start);
        let stop = simulation.run(periods, IMPACT_LIMIT, &mut (&mut inspector, &mut measurement));
        let statistics = measurement.statistics();
        prop_assert_eq!(inspector.complaint, None);
        prop_assert!(stop != Stop::NotFinite, "{:?}", stop);
        prop_assert_eq!(stop == Stop::ImpactLimit, simulation.impacts() >= IMPACT_LIMIT);
        if stop == Stop::EndTime {
            let energy = statistics.energy();
            prop_assert!(energy.relative_residual < 1e-9, "{:?}", energy);
            prop_assert_eq!(statistics.impacts(), inspector.impacts.len() as u64);
        }
        prop_assert!(simulation.state().x.is_finite() && simulation.state().y.is_finite());
    }

    #[test]
    fn the_same_start_gives_the_same_bits(system in systems(), start in starts()) {
        let run = |stretches: &[u64]| {
            let mut simulation = Simulation::new(&system, start, 0.0).expect("inside the cavity");
            let mut log = ImpactLog::default();
            for periods in stretches {
                simulation.run(*periods, IMPACT_LIMIT, &mut log);
            }
            bits(&log.impacts, simulation.state())
        };
        let once = run(&[20]);
        prop_assert_eq!(&once, &run(&[20]));
        // A run that is continued is the run that was never interrupted.
        if once.len() < IMPACT_LIMIT as usize {
            prop_assert_eq!(&once, &run(&[7, 13]));
        }
    }

    /// A flight is placed so that the first maximum of w is 1 + margin, to rounding.
    #[test]
    fn grazing_is_neither_missed_nor_invented(
        system in systems(),
        x in -1.0..1.0,
        x_velocity in 0.2..2.0,
        y_velocity in -0.5..0.5,
        exponent in 3_i32..=12,
    ) {
        let Some(textbook) = Textbook::of(&system) else { return Ok(()) };
        let relative = |s: f64| {
            let [now, v] = textbook.at(x, x_velocity, 0.0, s);
            (now - y_velocity * s, v - y_velocity)
        };
        let Some((top, low)) = first_maximum(&relative) else { return Ok(()) };
        let highest = relative(top).0;
        let margin = libm::exp10(-f64::from(exponent));
        for (margin, expected) in [(margin, true), (-margin, false)] {
            // w = relative(s) - y reaches 1 + margin at its first maximum, if no lower wall is near.
            let y = highest - 1.0 - margin;
            let start = State { x, x_velocity, y, y_velocity };
            if low - y < -0.99 || start.relative_displacement().abs() > 0.999 {
                continue;
            }
            let mut simulation = Simulation::new(&system, start, 0.0).expect("inside the cavity");
            let mut log = ImpactLog::default();
            simulation.run(20, 1, &mut log);
            // The maximum is a quarter of a flat parabola wide: sqrt(margin) on either side.
            let early = log.impacts.first().filter(|impact| impact.tau < top + 1e-9);
            prop_assert_eq!(early.is_some(), expected, "margin {} {:?}", margin, start);
            if let Some(impact) = early {
                prop_assert_eq!(impact.side, Side::Plus);
                let there = relative(impact.tau);
                // The slope at the crossing is sqrt(2 curvature margin): rounding over it.
                prop_assert!((there.0 - y - 1.0).abs() < 1e-12, "{:?} {:?}", there, impact);
                prop_assert!(there.1 > -1e-9, "found on the way back: {:?}", impact);
            }
        }
    }
}

/// Time of the first maximum of a curve given with its slope, within the first half turn, and the
/// lowest value up to there.
fn first_maximum(curve: &impl Fn(f64) -> (f64, f64)) -> Option<(f64, f64)> {
    let step = 1e-3;
    let mut low = curve(0.0).0;
    for k in 0..3000 {
        let (mut left, mut right) = (f64::from(k) * step, f64::from(k + 1) * step);
        low = low.min(curve(right).0);
        if curve(left).1 > 0.0 && curve(right).1 <= 0.0 {
            for _ in 0..60 {
                let middle = 0.5 * (left + right);
                if curve(middle).1 > 0.0 { left = middle } else { right = middle }
            }
            return Some((left, low));
        }
    }
    None
}

/// `w = A sin(tau)` with the absorber at rest, unforced and undamped: hit where A is above 1.
#[test]
fn a_sine_that_grazes_the_wall_by_a_hair_is_told_from_one_that_does_not() {
    let system = System::new(Parameters {
        mass_ratio: 0.01,
        damping: 0.0,
        restitution: 0.6,
        frequency_ratio: 0.7,
        forcing_per_clearance: 0.0,
        excitation: Excitation::BaseDisplacement,
        cavity: Cavity::IDEAL,
    })
    .expect("valid");
    for exponent in 3..=12 {
        let margin = libm::exp10(-f64::from(exponent));
        let run = |amplitude| {
            let start = State { x: 0.0, x_velocity: amplitude, y: 0.0, y_velocity: 0.0 };
            let mut simulation = Simulation::new(&system, start, 0.0).expect("inside the cavity");
            let mut log = ImpactLog::default();
            simulation.run(50, 1, &mut log);
            log.impacts
        };
        assert!(run(1.0 - margin).is_empty(), "an impact was invented at {margin}");
        let impact = run(1.0 + margin)[0];
        // asin(1/(1+m)) is pi/2 - sqrt(2 m), conditioned like 1/sqrt(m).
        let exact = libm::asin(1.0 / (1.0 + margin));
        assert!((impact.tau - exact).abs() < 1e-14 / margin.sqrt(), "{margin}: {impact:?}");
    }
}

fn inspected(system: &System, start: State, periods: u64) -> Inspector {
    let mut simulation = Simulation::new(system, start, 0.0).expect("inside the cavity");
    let mut inspector = Inspector::new(system);
    assert_eq!(simulation.run(periods, 10_000_000, &mut inspector), Stop::EndTime);
    assert_eq!(inspector.complaint, None);
    inspector
}

/// In a clearance far below the oscillator's amplitude the absorber chatters to rest on a wall
/// again and again. A sequence lasts `2 u / (a (1 - r))`, which at r = 0.95 is less than half a
/// period only when the flight across, and with it `u`, is very short.
#[test]
fn chattering_ends_in_contact_that_pushes_and_is_released() {
    for (restitution, clearance, fewest) in
        [(0.0, 0.3, 0.0), (0.6, 0.3, 5.0), (0.95, 0.003, 50.0), (0.99, 1e-4, 100.0)]
    {
        let table = common::table_1(8.0, clearance);
        let system = System::new(Parameters { restitution, ..table.parameters() }).expect("valid");
        let start = State { x: 0.3, x_velocity: 0.2, y: 0.1, y_velocity: 0.8 };
        let seen = inspected(&system, start, 60);
        assert!(seen.carried > 60, "{} stretches of contact at r = {restitution}", seen.carried);
        assert!(seen.released > 30, "{} releases at r = {restitution}", seen.released);
        // A chattering sequence is many impacts; a plastic one is a single one.
        let sequence = seen.impacts.len() as f64 / seen.released as f64;
        assert!(sequence > fewest, "{sequence} impacts per release at r = {restitution}");
    }
}

/// The force is gone at the moment of release, found by the hand-written equation of motion.
#[test]
fn the_absorber_is_released_when_the_contact_force_vanishes() {
    struct Releases {
        textbook: Textbook,
        last: Option<(f64, f64)>,
        checked: u64,
    }
    impl Observer for Releases {
        fn segment(&mut self, segment: &Segment) {
            if let Some((force, size)) = self.last.take()
                && matches!(segment.absorber, AbsorberMotion::Flying { .. })
            {
                assert!(force.abs() < rounding(size), "released at a force of {force}");
                self.checked += 1;
            }
            if matches!(segment.absorber, AbsorberMotion::Carried(_)) {
                let end = segment.at(segment.duration);
                let phase = segment.phase + self.textbook.omega * segment.duration;
                let force = self.textbook.acceleration(end.x, end.x_velocity, phase);
                self.last = Some((force, 2.0 * size(&end) + self.textbook.force[0]));
            }
        }
    }
    let system = common::table_1(8.0, 0.3);
    let start = State { x: 0.3, x_velocity: 0.2, y: 0.1, y_velocity: 0.8 };
    let mut simulation = Simulation::new(&system, start, 0.0).expect("inside the cavity");
    let textbook = Textbook::of(&system).expect("underdamped");
    let mut releases = Releases { textbook, last: None, checked: 0 };
    assert_eq!(simulation.run(100, 1_000_000, &mut releases), Stop::EndTime);
    assert!(releases.checked > 50, "{} releases", releases.checked);
}

#[test]
fn a_start_on_the_wall_collides_flies_or_sticks() {
    let system = common::table_1(8.0, 7.5);
    let begin = |side: f64, x: f64, relative: f64| {
        let start = State { x, x_velocity: 0.1, y: x - side, y_velocity: 0.1 - relative };
        let mut simulation = Simulation::new(&system, start, 0.0).expect("on the wall is inside");
        let mut log = Trace::new(10.0);
        let mut seen = Inspector::new(&system);
        assert_eq!(simulation.run(2, 1000, &mut (&mut log, &mut seen)), Stop::EndTime);
        assert_eq!(seen.complaint, None);
        let at_once = log.impacts.first().is_some_and(|(_, impact)| impact.tau == 0.0);
        (at_once, seen.carried > 0)
    };
    for side in [1.0, -1.0] {
        let (moving_out, moving_in) = (0.5 * side, -0.5 * side);
        assert!(begin(side, 0.0, moving_out).0, "moving outwards it collides at once");
        assert!(!begin(side, 0.0, moving_in).0, "moving inwards it flies");
        // With x = -0.5 on the plus side the spring drives the wall towards the absorber.
        assert_eq!(begin(side, -0.5 * side, 0.0), (false, true), "the wall pushes: it sticks");
        let (at_once, _) = begin(side, 0.5 * side, 0.0);
        assert!(!at_once, "the wall recedes: it flies");
    }
}

#[test]
fn impossible_starts_are_refused() {
    let system = common::table_1(8.0, 7.5);
    let at_rest = State { x: 0.0, x_velocity: 0.0, y: 0.0, y_velocity: 0.0 };
    for gap in [1.0 + 1e-9, -1.0 - 1e-9, 2.0, 1e300] {
        let error = Simulation::new(&system, State { x: gap, ..at_rest }, 0.0).map(drop);
        assert_eq!(error, Err(StartError::OutsideCavity { gap }));
    }
    for number in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let starts = [
            State { x: number, ..at_rest },
            State { x_velocity: number, ..at_rest },
            State { y: number, ..at_rest },
            State { y_velocity: number, ..at_rest },
        ];
        for start in starts {
            let error = Simulation::new(&system, start, 0.0).map(drop);
            assert!(matches!(error, Err(StartError::NotFinite { .. })), "{start:?}: {error:?}");
        }
        let error = Simulation::new(&system, at_rest, number).map(drop);
        assert!(matches!(error, Err(StartError::NotFinite { .. })), "phase {number}: {error:?}");
    }
}

#[test]
fn the_limit_on_impacts_ends_a_run_and_is_not_passed() {
    let system = common::table_1(8.0, 0.3);
    let start = State { x: 0.3, x_velocity: 0.2, y: 0.1, y_velocity: 0.8 };
    let mut simulation = Simulation::new(&system, start, 0.0).expect("inside the cavity");
    let mut log = ImpactLog::default();
    assert_eq!(simulation.run(1000, 25, &mut log), Stop::ImpactLimit);
    assert_eq!((log.impacts.len(), simulation.impacts()), (25, 25));
    // The limit counts from where a run is continued.
    assert_eq!(simulation.run(1000, 10, &mut log), Stop::ImpactLimit);
    assert_eq!(simulation.impacts(), 35);
    assert!(log.impacts.windows(2).all(|pair| pair[0].tau <= pair[1].tau));
    assert!(log.impacts.iter().all(|impact| (0.0..TAU).contains(&impact.phase)));
}
