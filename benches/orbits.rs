//! Exact orbits against finding the same motions by simulation, in the same run.
//!
//! The first lines printed are the ratios; then criterion's own report. Nothing here asserts a time.

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use vinesink::orbits::branch::{BranchDirection, Settings, follow};
use vinesink::orbits::{Branch, SymmetricFamily, symmetric_orbits};
use vinesink::simulation::Simulation;
use vinesink::system::{Parameter, State, System};
use vinesink_benches as common;

/// Periods in which the transient of a 1:1 motion dies out to 1e-10.
const TRANSIENT: u64 = 400;
/// Orbits of the branch that is timed.
const ORBITS: usize = 200;

/// Table 1 of Li, Seguy, Berlioz (2016) at 8.5 Hz, b = 20 mm, F = 0.25 mm.
fn system() -> System {
    common::table_1(8.5, 20.0)
}

/// A branch over the clearance of exactly [`ORBITS`] orbits with multipliers and admissibility.
fn branch(system: &System) -> Branch {
    let start = symmetric_orbits(system).expect("damped").pop().expect("exists").orbit;
    let settings = Settings {
        most_points: ORBITS,
        first_step: 0.004,
        largest_step: 0.004,
        ..Settings::within([0.05, 10.0])
    };
    let branch =
        follow(system, &start, Parameter::Clearance, BranchDirection::Down, &settings).expect("regular");
    assert_eq!(branch.points.len(), ORBITS, "{:?}", branch.end);
    branch
}

fn simulated(system: &System) -> State {
    let start = State { x: 0.1, x_velocity: 0.1, y: 0.0, y_velocity: 0.2 };
    let mut simulation = Simulation::new(system, start, 0.0).expect("inside the cavity");
    simulation.run(TRANSIENT, u64::MAX, &mut ());
    simulation.state()
}

fn timed<T>(repeats: u32, mut work: impl FnMut() -> T) -> Duration {
    let mut best = Duration::MAX;
    for _ in 0..5 {
        let begin = Instant::now();
        for _ in 0..repeats {
            black_box(work());
        }
        best = best.min(begin.elapsed() / repeats);
    }
    best
}

fn ratios(system: &System) {
    let orbits = timed(1000, || symmetric_orbits(black_box(system)));
    let family = timed(10, || SymmetricFamily::of(black_box(system)));
    let branch = timed(10, || branch(black_box(system)));
    let simulated = timed(10, || simulated(black_box(system)));
    let ratio = |a: Duration, b: Duration| a.as_secs_f64() / b.as_secs_f64();
    println!("both symmetric orbits, with multipliers and proof of admissibility: {orbits:.1?}");
    println!(
        "  one simulated transient of {TRANSIENT} periods takes {:.0} times as long",
        ratio(simulated, orbits)
    );
    println!("branch of {ORBITS} orbits: {branch:.1?}");
    println!(
        "  simulating {ORBITS} transients takes {:.0} times as long",
        ORBITS as f64 * ratio(simulated, branch)
    );
    println!("all limits at one frequency: {family:.1?}");
}

fn orbits(criterion: &mut Criterion) {
    let system = system();
    ratios(&system);
    criterion.bench_function("symmetric orbits", |bencher| {
        bencher.iter(|| symmetric_orbits(black_box(&system)));
    });
    criterion.bench_function("branch of 200 orbits", |bencher| {
        bencher.iter(|| branch(black_box(&system)));
    });
}

criterion_group!(benches, orbits);
criterion_main!(benches);
