//! The event engine against what one would write by hand, in the same run on the same work: the
//! classical Runge-Kutta method with a two-hundredth of the period as its step and bisection of each
//! impact. And the analysis of a case against a hundred simulated periods.
//!
//! The first lines printed are the ratio of the two and the impacts per second; then criterion's own
//! report. Nothing here asserts a time.

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use vinesink::analysis::Analysis;
use vinesink::simulation::{
    Measurement, ModalMeter, ModalObserver, ModalSimulation, Reading, Sensor, Simulation, Stop,
    batch,
};
use vinesink::system::{
    Cavity, ModalAbsorber, ModalParameters, ModalState, ModalSystem, Mode, Parameters, State,
    System,
};
use vinesink::tradeoff::by_hand::{ByHand, Locate};
use vinesink_benches as common;

const PERIODS: u64 = 200;
/// Clearances in mm: strongly modulated, and two impacts per period.
const CLEARANCES: [f64; 2] = [11.5, 7.5];
const START: State = State { x: 0.0, x_velocity: 0.01, y: 0.0, y_velocity: 0.0 };

/// Table 1 of Li, Seguy, Berlioz (2016) at resonance, with F = 0.25 mm.
fn system(clearance_mm: f64) -> System {
    common::table_1(common::natural_frequency() / std::f64::consts::TAU, clearance_mm)
}

fn engine(system: &System, periods: u64) -> u64 {
    let mut simulation = Simulation::new(system, START, 0.0).expect("inside the cavity");
    assert_eq!(simulation.run(periods, u64::MAX, &mut ()), Stop::EndTime);
    simulation.impacts()
}

/// Trajectories of a batch.
const TRAJECTORIES: u32 = 64;

/// Many of them side by side, each a little faster at the start.
fn side_by_side(system: &System, periods: u64) -> u64 {
    let mut simulations: Vec<Simulation> = (0..TRAJECTORIES)
        .map(|k| {
            let faster = 1.0 + f64::from(k) / f64::from(TRAJECTORIES);
            let start = State { x_velocity: START.x_velocity * faster, ..START };
            Simulation::new(system, start, 0.0).expect("inside the cavity")
        })
        .collect();
    let mut nobody: Vec<()> = vec![(); simulations.len()];
    let stops = batch::run(&mut simulations, periods, u64::MAX, &mut nobody);
    assert!(stops.iter().all(|stop| *stop == Stop::EndTime));
    simulations.iter().map(Simulation::impacts).sum()
}

/// One trajectory with everything that a report measures of it.
fn measured(system: &System, periods: u64) -> u64 {
    let mut simulation = Simulation::new(system, START, 0.0).expect("inside the cavity");
    let mut measurement = Measurement::begin(system, START);
    assert_eq!(simulation.run(periods, u64::MAX, &mut measurement), Stop::EndTime);
    let statistics = measurement.statistics();
    statistics.impacts()
}

/// Time per impact of another way, over that of the single engine.
fn per_impact([ours, other]: [(Duration, u64); 2]) -> f64 {
    let each = |(time, impacts): (Duration, u64)| time.as_secs_f64() / impacts as f64;
    each(other) / each(ours)
}

/// The same with the slow, finer search alone.
fn step_by_step(system: &System, periods: u64) -> u64 {
    let simulation = Simulation::new(system, START, 0.0).expect("inside the cavity");
    let mut simulation = simulation.step_by_step();
    assert_eq!(simulation.run(periods, u64::MAX, &mut ()), Stop::EndTime);
    simulation.impacts()
}

/// Steps of the hand-written integrator in a period.
const STEPS: u32 = 200;

/// Impacts that the hand-written integrator sees in so many periods.
fn by_hand(system: &System, periods: u64) -> u64 {
    ByHand::new(system, STEPS, Locate::Bisection).run(START, periods).impacts.len() as u64
}

fn timed(work: &mut impl FnMut() -> u64) -> (Duration, u64) {
    let begin = Instant::now();
    let count = black_box(work());
    (begin.elapsed(), count)
}

/// Shortest of several runs of either, taken in turns so that both see the same machine.
fn compare(mut one: impl FnMut() -> u64, mut other: impl FnMut() -> u64) -> [(Duration, u64); 2] {
    let mut best = [timed(&mut one), timed(&mut other)];
    for _ in 0..30 {
        for (best, now) in best.iter_mut().zip([timed(&mut one), timed(&mut other)]) {
            best.0 = best.0.min(now.0);
        }
    }
    best
}

fn impacts(criterion: &mut Criterion) {
    for clearance in CLEARANCES {
        let system = system(clearance);
        let [ours, theirs] = compare(|| engine(&system, PERIODS), || by_hand(&system, PERIODS));
        println!(
            "b = {clearance} mm, {PERIODS} periods: engine {} impacts in {:.0} us, {:.2e} a second; \
             Runge-Kutta {} impacts in {:.0} us; ratio {:.1}",
            ours.1,
            ours.0.as_secs_f64() * 1e6,
            ours.1 as f64 / ours.0.as_secs_f64(),
            theirs.1,
            theirs.0.as_secs_f64() * 1e6,
            theirs.0.as_secs_f64() / ours.0.as_secs_f64(),
        );
        let slow = || step_by_step(&system, PERIODS);
        let [ours, slower] = compare(|| engine(&system, PERIODS), slow);
        println!(
            "b = {clearance} mm: step by step {:.2e} impacts a second; ratio {:.1}",
            slower.1 as f64 / slower.0.as_secs_f64(),
            slower.0.as_secs_f64() / ours.0.as_secs_f64(),
        );
        let alone = || engine(&system, PERIODS);
        println!(
            "b = {clearance} mm, per impact and relative to one trajectory: {TRAJECTORIES} side by side \
             {:.2}, with all statistics {:.2}",
            per_impact(compare(alone, || side_by_side(&system, PERIODS))),
            per_impact(compare(alone, || measured(&system, PERIODS))),
        );
        let mut group = criterion.benchmark_group(format!("{PERIODS} periods, b = {clearance} mm"));
        group.bench_function("event engine", |bench| bench.iter(|| engine(&system, PERIODS)));
        group.bench_function("64 side by side", |bench| {
            bench.iter(|| side_by_side(&system, PERIODS));
        });
        group
            .bench_function("Runge-Kutta, T/200", |bench| bench.iter(|| by_hand(&system, PERIODS)));
        group.finish();
    }
}

/// Clearances in mm: chatter, several impacts per period with ends of sliding between them, two impacts.
const RUBBING: [f64; 3] = [0.3, 2.5, 7.5];
/// Of 0.2 degrees.
const SINE: f64 = 0.003_490_651;
/// Coefficients of friction: of a good slider, and of a bad one.
const FRICTION: [f64; 2] = [0.005, 0.05];

/// The engine in a cavity inclined by 0.2 degrees that rubs, beside the ideal one.
fn real_cavity(_: &mut Criterion) {
    for (clearance, friction) in RUBBING.into_iter().flat_map(|b| FRICTION.map(|mu| (b, mu))) {
        let ideal = system(clearance);
        let omega0 = common::natural_frequency();
        let gravity = 9.80665 / (clearance * 1e-3 * omega0 * omega0);
        let cavity = Cavity {
            gravity_along: gravity * SINE,
            friction_acceleration: gravity * friction,
            restitution_difference: 0.02,
        };
        let real = System::new(Parameters { cavity, ..ideal.parameters() }).expect("valid");
        println!(
            "b = {clearance} mm, friction {friction}: time per impact over that of the ideal cavity {:.2}, with all \
             statistics {:.2}",
            per_impact(compare(|| engine(&ideal, PERIODS), || engine(&real, PERIODS))),
            per_impact(compare(|| measured(&ideal, PERIODS), || measured(&real, PERIODS))),
        );
    }
}

/// A mast of three modes with a ball at its tip, driven at a frequency of the second or the third.
fn mast(frequency_ratio: f64, driven: usize) -> ModalSystem {
    let mode = |k: usize, frequency: f64| Mode {
        frequency,
        damping_ratio: 0.005,
        mass: 30.0,
        forcing: if k == driven { 2.5e-4 * frequency * frequency } else { 0.0 },
        shape: vec![1.0],
        ..Mode::default()
    };
    let modes = [1.0, 6.267, 17.55].into_iter().enumerate().map(|(k, of)| mode(k, of));
    ModalSystem::new(ModalParameters {
        modes: modes.collect(),
        absorbers: vec![ModalAbsorber { mass: 3.0, clearance: 2.7e-3, restitution: 0.3 }],
        frequency_ratio,
        ..ModalParameters::default()
    })
    .expect("valid")
}

/// Sensors of displacements, and of velocities and accelerations as well, beside nobody.
fn several(_: &mut Criterion) {
    let tip = |reads| Sensor { reads, ..Sensor::displacement(vec![1.0; 3]) };
    let middle = |reads| Sensor { reads, ..Sensor::displacement(vec![0.34, -0.71, 0.02]) };
    for (frequency, driven) in [(5.86, 1), (17.2, 2)] {
        let system = mast(frequency, driven);
        let flown = |observer: &mut dyn ModalObserver| {
            let mut simulation =
                ModalSimulation::new(&system, &ModalState::AT_REST, 0.0).expect("inside");
            assert_eq!(simulation.run(PERIODS, u64::MAX, observer), Stop::EndTime);
            simulation.impacts()
        };
        let read = |reads: &[Reading]| {
            let sensors = reads.iter().flat_map(|one| [tip(*one), middle(*one)]);
            let mut meter = ModalMeter::new(&system, &sensors.collect::<Vec<_>>());
            flown(&mut meter)
        };
        let all = [Reading::Displacement, Reading::Velocity, Reading::Acceleration];
        println!(
            "mast at {frequency}: time per impact over that of a flight that nobody watches, with the displacements of two \
             places {:.2}, with velocities and accelerations too {:.2}",
            per_impact(compare(|| flown(&mut ()), || read(&all[..1]))),
            per_impact(compare(|| flown(&mut ()), || read(&all))),
        );
    }
}

fn analysis(criterion: &mut Criterion) {
    let system = system(7.5);
    let analyse = || Analysis::of(&system).expect("analysable").fixed_points.len() as u64;
    let [theory, simulation] = compare(analyse, || engine(&system, 100));
    println!(
        "b = 7.5 mm: analysis in {:.0} us, 100 simulated periods in {:.0} us; ratio {:.1}",
        theory.0.as_secs_f64() * 1e6,
        simulation.0.as_secs_f64() * 1e6,
        simulation.0.as_secs_f64() / theory.0.as_secs_f64(),
    );
    let mut group = criterion.benchmark_group("one case, b = 7.5 mm");
    group.bench_function("analysis", |bench| bench.iter(|| Analysis::of(&system)));
    group.bench_function("100 periods", |bench| bench.iter(|| engine(&system, 100)));
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1));
    targets = impacts, real_cavity, several, analysis
}
criterion_main!(benches);
