//! The event engine in a real cavity: tilted, with friction, with a restitution for each end.
//!
//! Truth: free fall and sliding friction on a structure that does not move; conservation of energy; the equations
//! themselves along each stretch; the slow search beside the fast one; central differences of the flow.

use crate::common;
use std::f64::consts::TAU;
use vinesink::simulation::{
    AbsorberMotion, Detail, Impact, ImpactLog, Measurement, Observer, Reversal, Segment,
    Simulation, Stop, Tangent,
};
use vinesink::system::{Cavity, Excitation, Parameters, State, System};

/// A structure so heavy that nothing moves it, at rest.
fn bench(gravity_along: f64, friction_acceleration: f64) -> System {
    System::new(Parameters {
        mass_ratio: 1.0 / (1_u64 << 60) as f64,
        damping: 0.0,
        restitution: 0.5,
        frequency_ratio: 0.5,
        forcing_per_clearance: 0.0,
        excitation: Excitation::Force,
        cavity: Cavity { gravity_along, friction_acceleration, restitution_difference: 0.4 },
    })
    .expect("valid")
}

#[derive(Default)]
struct Events {
    reversals: Vec<Reversal>,
    impacts: Vec<Impact>,
    held: f64,
    carried: f64,
}

impl Observer for Events {
    fn detail(&self) -> Detail {
        Detail::Flights
    }
    fn segment(&mut self, segment: &Segment) {
        match segment.absorber {
            AbsorberMotion::Held { .. } => self.held += segment.duration,
            AbsorberMotion::Carried(_) => self.carried += segment.duration,
            AbsorberMotion::Flying { .. } => {}
        }
    }
    fn impact(&mut self, impact: &Impact) {
        self.impacts.push(*impact);
    }
    fn reversal(&mut self, reversal: &Reversal) {
        self.reversals.push(*reversal);
    }
}

fn watched(system: &System, start: State, periods: u64) -> (State, Events) {
    let mut simulation = Simulation::new(system, start, 0.0).expect("inside");
    let mut events = Events::default();
    assert_eq!(simulation.run(periods, 10_000, &mut events), Stop::EndTime);
    (simulation.state(), events)
}

fn near(found: f64, wanted: f64) {
    assert!((found - wanted).abs() < 1e-14 * (1.0 + wanted.abs()), "{found} for {wanted}");
}

#[test]
fn sliding_stops_after_the_way_that_friction_takes() {
    // From y = 0 at a velocity of 0.5: u/f, u^2/(2 f).
    let (end, events) = watched(&bench(0.0, 0.2), State { y_velocity: 0.5, ..State::AT_REST }, 1);
    assert_eq!(events.reversals.len(), 1);
    let Reversal { tau, before, after, .. } = events.reversals[0];
    assert_eq!((before, after), (-1.0, 0.0));
    near(tau, 2.5);
    near(end.y, 0.625);
    near(events.held, 2.0 * TAU - 2.5);
    assert!(events.impacts.is_empty());
}

#[test]
fn a_slope_steeper_than_friction_is_slid_down_and_rests_on_the_lower_wall() {
    let (a, f) = (0.3, 0.1);
    let (end, events) = watched(&bench(a, f), State { y: -0.5, ..State::AT_REST }, 20);
    // y = 1 is the wall x - y = -1, whose restitution is 0.3.
    let first = &events.impacts[0];
    near(first.tau, (2.0 * 1.5 / (a - f)).sqrt());
    near(first.y_velocity_before, (2.0 * 1.5 * (a - f)).sqrt());
    near(first.y_velocity_after, -0.3 * first.y_velocity_before);
    // Up with a + f, down with a - f: each bounce keeps r sqrt((a - f)/(a + f)) of the speed.
    let kept = 0.3 * ((a - f) / (a + f)).sqrt();
    near(events.impacts[1].y_velocity_before / first.y_velocity_before, kept);
    assert_eq!(events.reversals[0].after, -1.0);
    assert_eq!(end.y, 1.0);
    assert!(events.carried > 0.0 && events.held == 0.0);
}

#[test]
fn friction_that_is_steeper_than_the_slope_holds() {
    for gravity in [0.1, -0.1] {
        let (end, events) = watched(&bench(gravity, 0.1), State { y: 0.3, ..State::AT_REST }, 3);
        assert_eq!(end.y, 0.3);
        near(events.held, 6.0 * TAU);
    }
    // Thrown up it stops where gravity does not bring it back.
    let (end, _) = watched(&bench(0.1, 0.3), State { y_velocity: -0.4, ..State::AT_REST }, 3);
    near(end.y, -0.4 * 0.4 / (2.0 * 0.4));
}

/// Numbers that are spread evenly and never repeat.
struct Spread(f64);

impl Spread {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = (self.0 * 997.0 + 0.618_033_988_749_894_9).fract();
        low + (high - low) * self.0
    }
}

/// Friction 0 to 10, tilt 0 to 90 degrees, restitutions 0 to 1 each.
fn any(spread: &mut Spread) -> (System, State) {
    let gravity = libm::pow(10.0, spread.between(-1.5, 1.3));
    let tilt = spread.between(-1.0, 1.0);
    let (sin, cos) = libm::sincos(tilt * tilt * tilt * TAU / 4.0);
    let sliding = [0.0, 0.003, 0.1, 1.0, 10.0][spread.between(0.0, 5.0) as usize];
    let ends = [spread.between(-0.1, 1.0).max(0.0), spread.between(-0.1, 1.0).max(0.0)];
    let system = System::new(Parameters {
        mass_ratio: libm::pow(10.0, spread.between(-4.0, -0.3)),
        damping: spread.between(0.0, 3.0),
        restitution: 0.5 * (ends[0] + ends[1]),
        frequency_ratio: spread.between(0.6, 1.4),
        forcing_per_clearance: libm::pow(10.0, spread.between(-1.0, 2.0)),
        excitation: Excitation::BaseDisplacement,
        cavity: Cavity {
            gravity_along: gravity * sin,
            friction_acceleration: gravity * cos * sliding,
            restitution_difference: ends[0] - ends[1],
        },
    });
    let start = State {
        x: spread.between(-1.0, 1.0),
        x_velocity: spread.between(-1.0, 1.0),
        y: 0.0,
        y_velocity: spread.between(-1.0, 1.0),
    };
    (system.expect("valid"), State { y: start.x + spread.between(-0.99, 0.99), ..start })
}

/// Checks each stretch against the equations and the cavity.
struct Inspector {
    system: System,
    stretches: [u64; 3],
    wrong: Vec<String>,
}

impl Observer for Inspector {
    fn segment(&mut self, segment: &Segment) {
        let Cavity { gravity_along: a, friction_acceleration: f, .. } = self.system.cavity();
        let eps = self.system.mass_ratio();
        let scale = 1.0 + segment.at(0.0).size() + f + a.abs();
        // Rounding of states, and of accelerations by differences of velocities below.
        let small = 1e-13 * scale;
        let kind = match segment.absorber {
            AbsorberMotion::Flying { .. } => 0,
            AbsorberMotion::Held { .. } => 1,
            AbsorberMotion::Carried(_) => 2,
        };
        self.stretches[kind] += 1;
        let parts = [0.02, 0.21, 0.4, 0.63, 0.86, 0.97];
        let mut sense = 0.0;
        for part in parts {
            let s = part * segment.duration;
            let state = segment.at(s);
            let slope = state.x_velocity - state.y_velocity;
            let forces = segment.motion.force(s) * if kind == 0 { 1.0 } else { 1.0 + eps };
            let alone = forces - eps * self.system.damping() * state.x_velocity - state.x;
            let needed = (alone - a) / (1.0 + eps);
            let mut check = |good: bool, what: &str| {
                if !good {
                    self.wrong.push(format!("{what}: {state:?} {segment:?} {:?}", self.system));
                }
            };
            check(state.relative_displacement().abs() <= 1.0 + small, "outside");
            match segment.absorber {
                AbsorberMotion::Flying { y_acceleration, .. } => {
                    if f > 0.0 && slope.abs() > small {
                        check(sense == 0.0 || slope * sense > 0.0, "turned");
                        sense = slope.signum();
                        check((y_acceleration - a - sense * f).abs() < small, "friction");
                    }
                    let at = segment.motion.at(s);
                    let found = segment.motion.acceleration(s, at);
                    check(
                        (found - (alone - eps * (y_acceleration - a))).abs() < small,
                        "oscillator",
                    );
                }
                AbsorberMotion::Held { .. } => check(needed.abs() <= f + small, "slips"),
                AbsorberMotion::Carried(side) => {
                    check(side.sign() * needed >= -f - small, "is pulled")
                }
            }
        }
    }
}

#[test]
fn every_stretch_obeys_the_equations_and_the_energy_balances() {
    let mut spread = Spread(0.3);
    let mut stretches = [0; 3];
    for _ in 0..400 {
        let (system, start) = any(&mut spread);
        let mut simulation = Simulation::new(&system, start, 0.0).expect("inside");
        let mut measured = Measurement::begin(&system, start);
        let mut inspector = Inspector { system, stretches: [0; 3], wrong: Vec::new() };
        let stop = simulation.run(30, 3000, &mut (&mut measured, &mut inspector));
        assert!(inspector.wrong.is_empty(), "{}", inspector.wrong[0]);
        if stop == Stop::EndTime {
            let doubts = measured.statistics().doubts(stop);
            assert!(doubts.is_empty(), "{doubts:?} {system:?} {start:?}");
        }
        (0..3).for_each(|k| stretches[k] += inspector.stretches[k]);
    }
    assert!(stretches.iter().all(|count| *count > 1000), "{stretches:?}");
}

#[test]
fn the_energy_balances_over_a_thousand_periods() {
    let mut spread = Spread(0.8);
    for _ in 0..12 {
        let (system, start) = any(&mut spread);
        let mut simulation = Simulation::new(&system, start, 0.0).expect("inside");
        let mut measured = Measurement::begin(&system, start);
        let stop = simulation.run(1000, 100_000, &mut measured);
        let residual = measured.statistics().energy().relative_residual;
        assert!(stop != Stop::EndTime || residual < 1e-9, "{residual} {system:?}");
    }
}

/// Closed form of whole flights against Simpson's rule over a sampled motion.
#[test]
fn what_is_measured_is_what_a_trace_has() {
    let table = common::table_1(8.0, 7.5).parameters();
    let cavity =
        Cavity { gravity_along: 0.1, friction_acceleration: 0.25, restitution_difference: 0.1 };
    let system = System::new(Parameters { mass_ratio: 0.2, cavity, ..table }).expect("valid");
    let start = State { x: 0.3, x_velocity: 0.2, y: 0.1, y_velocity: 0.8 };
    let mut simulation = Simulation::new(&system, start, 0.0).expect("inside");
    let mut measured = Measurement::begin(&system, start);
    let mut sums = Sums { frequency: system.frequency_ratio(), ..Sums::default() };
    simulation.run(4, u64::MAX, &mut (&mut measured, &mut sums));
    assert!(sums.held > 0 && sums.turned > 0, "{sums:?}");
    let statistics = measured.statistics();
    let duration = 4.0 * system.period();
    // Intervals of 1/400 of a stretch: h^4/180 times a fourth derivative leaves 1e-12.
    let close =
        |found: f64, wanted: f64| assert!((found - wanted).abs() < 1e-9, "{found} {wanted}");
    close(statistics.rms() * statistics.rms() * duration, sums.square);
    // Between samples it rises by at most x'' h^2/8.
    let missed = statistics.peak() - sums.peak;
    assert!((-1e-13..5e-5).contains(&missed), "{missed}");
    let (oscillator, absorber) = statistics.harmonics();
    let scale = system.frequency_ratio() / (TAU / 2.0) / 4.0;
    for k in 0..2 {
        close(oscillator[k], scale * sums.harmonics[k]);
        close(absorber[k], scale * sums.harmonics[2 + k]);
    }
    assert!(statistics.energy().friction > 0.0 && statistics.energy().relative_residual < 1e-13);
}

#[derive(Debug, Default)]
struct Sums {
    frequency: f64,
    square: f64,
    peak: f64,
    harmonics: [f64; 4],
    held: u64,
    turned: u64,
}

impl Observer for Sums {
    fn segment(&mut self, segment: &Segment) {
        self.held += u64::from(matches!(segment.absorber, AbsorberMotion::Held { .. }));
        let pieces = 400;
        let h = segment.duration / f64::from(pieces);
        for k in 0..=pieces {
            let end = k == 0 || k == pieces;
            let weight = h / 3.0
                * if end {
                    1.0
                } else if k % 2 == 1 {
                    4.0
                } else {
                    2.0
                };
            let s = f64::from(k) * h;
            let state = segment.at(s);
            let (sin, cos) = libm::sincos(segment.phase + self.frequency * s);
            self.square += weight * state.x * state.x;
            self.peak = self.peak.max(state.x.abs());
            let products = [state.x * sin, state.x * cos, state.y * sin, state.y * cos];
            (0..4).for_each(|j| self.harmonics[j] += weight * products[j]);
        }
    }
    fn reversal(&mut self, _: &Reversal) {
        self.turned += 1;
    }
}

/// A motion that is not chaotic has the same impacts by either search; each is found to rounding.
#[test]
fn panels_and_steps_find_the_same_impacts() {
    let mut spread = Spread(0.1);
    let mut compared = 0;
    for _ in 0..200 {
        let (system, start) = any(&mut spread);
        let log = |simulation: Simulation| {
            let mut simulation = simulation;
            let mut log = ImpactLog::default();
            simulation.run(3, 12, &mut log);
            log.impacts
        };
        let fast = Simulation::new(&system, start, 0.0).expect("inside");
        let (fast, slow) = (log(fast.clone()), log(fast.step_by_step()));
        for (one, other) in fast.iter().zip(&slow) {
            // Slow impacts are badly conditioned, and what follows them is.
            if (one.x_velocity_before - one.y_velocity_before).abs() < 0.03 {
                break;
            }
            assert!((one.tau - other.tau).abs() < 1e-11, "{one:?} {other:?} {system:?}");
            compared += 1;
        }
    }
    assert!(compared > 300, "{compared}");
}

/// As in the tests of the tangent map: differences are good to `h^2` and to rounding over `h`.
#[test]
fn the_tangent_map_is_the_derivative_of_the_flow() {
    let table = common::table_1(8.0, 7.5).parameters();
    let mut seen = [false; 3];
    for (cavity, forcing) in [
        (
            Cavity { gravity_along: 0.03, friction_acceleration: 0.0, restitution_difference: 0.1 },
            1.0,
        ),
        (
            Cavity {
                gravity_along: 0.02,
                friction_acceleration: 0.05,
                restitution_difference: 0.0,
            },
            1.0,
        ),
        (
            Cavity { gravity_along: 0.0, friction_acceleration: 0.15, restitution_difference: 0.1 },
            0.6,
        ),
        (
            Cavity { gravity_along: 0.05, friction_acceleration: 0.3, restitution_difference: 0.0 },
            0.3,
        ),
    ] {
        let forcing_per_clearance = forcing * table.forcing_per_clearance;
        let system =
            System::new(Parameters { cavity, forcing_per_clearance, mass_ratio: 0.05, ..table })
                .expect("valid");
        let start = State { x: 0.3, x_velocity: 0.2, y: 0.1, y_velocity: 0.8 };
        let periods = 3;
        let (_, events) = watched(&system, start, periods);
        seen[0] |= !events.impacts.is_empty();
        seen[1] |= events.reversals.iter().any(|one| one.after == 0.0);
        seen[2] |= events.reversals.iter().any(|one| one.after != 0.0);
        let with = |k: usize, by: f64| {
            let mut all = [start.x, start.x_velocity, start.y, start.y_velocity];
            all[k] += by;
            State { x: all[0], x_velocity: all[1], y: all[2], y_velocity: all[3] }
        };
        let numbers = |s: State| [s.x, s.x_velocity, s.y, s.y_velocity];
        for k in 0..4 {
            let unit = with(k, 1.0);
            let change = State {
                x: unit.x - start.x,
                x_velocity: unit.x_velocity - start.x_velocity,
                y: unit.y - start.y,
                y_velocity: unit.y_velocity - start.y_velocity,
            };
            let mut simulation = Simulation::new(&system, start, 0.0).expect("inside");
            let mut tangent = Tangent::begin(&system, change);
            simulation.run(periods, 1000, &mut tangent);
            let exact = numbers(tangent.change);
            let h = 1e-6;
            let [ahead, behind] = [h, -h].map(|h| numbers(watched(&system, with(k, h), periods).0));
            let size = exact.iter().fold(0.1_f64, |a, b| a.max(b.abs()));
            for j in 0..4 {
                let difference = (ahead[j] - behind[j]) / (2.0 * h);
                assert!(
                    (exact[j] - difference).abs() < 1e-6 * size,
                    "{k} {j}: {exact:?} {difference} {cavity:?}"
                );
            }
        }
    }
    assert_eq!(seen, [true; 3]);
}
