//! A structure that is swept through resonance, against an independent integration, energy, the steady motions and
//! what a person would do by hand.

#![allow(clippy::disallowed_methods, reason = "a test may use the platform's functions")]

use std::f64::consts::TAU;

use vinesink::case::Case;
use vinesink::criteria::judge_transient;
use vinesink::excitation::{SineSweep, SweepRate};
use vinesink::executor::Serial;
use vinesink::flights::Passage;
use vinesink::linear::swept;
use vinesink::measure::Measure;
use vinesink::orbits::attracting_orbit;
use vinesink::simulation::Simulation;
use vinesink::system::{Excitation, State, System};
use vinesink::transient::{Study, SweepStudy};

const FAST: &str = include_str!("../../cases/sweep-fast.toml");

fn case(changes: &[(&str, &str)]) -> Case {
    let mut text = FAST.to_owned();
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    Case::parse("sweep.toml", &text).expect("a case")
}

fn start(w: f64) -> State {
    State { y: -w, ..State::AT_REST }
}

/// The largest displacement of a linear structure in each period of the true sweep, whose frequency and whose base's
/// velocity change all the time, by Runge and Kutta's method in steps of a five-hundredth of a period; between two of them
/// the displacement is 2e-5 of itself larger at the most.
fn integrated(system: &System, omega0: f64, sweep: &SineSweep) -> Vec<f64> {
    let (eps, loss) = (system.mass_ratio(), system.mass_ratio() * system.damping());
    let forcing = eps * system.forcing_per_clearance();
    let excited = |tau: f64| {
        let time = tau / omega0;
        let (sine, cosine) = (TAU * sweep.turns(time)).sin_cos();
        let h = 1e-3;
        let omega = TAU * (sweep.turns(time + h) - sweep.turns(time - h)) / (2.0 * h) / omega0;
        match system.excitation() {
            Excitation::Force => forcing * sine,
            Excitation::BaseDisplacement => forcing * (sine + loss * omega * cosine),
        }
    };
    let slope = |tau: f64, [x, v]: [f64; 2]| [v, excited(tau) - x - loss * v];
    let mut state = [0.0_f64; 2];
    let period = |n: u64| {
        let [begin, end] = [n, n + 1].map(|n| omega0 * sweep.time(n as f64));
        let h = (end - begin) / 500.0;
        let mut peak = state[0].abs();
        for k in 0..500 {
            let tau = begin + f64::from(k) * h;
            let along = |by: f64, s: [f64; 2]| [state[0] + by * s[0], state[1] + by * s[1]];
            let a = slope(tau, state);
            let b = slope(tau + 0.5 * h, along(0.5 * h, a));
            let c = slope(tau + 0.5 * h, along(0.5 * h, b));
            let d = slope(tau + h, along(h, c));
            for i in 0..2 {
                state[i] += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
            }
            peak = peak.max(state[0].abs());
        }
        peak
    };
    (0..sweep.count()).map(period).collect()
}

/// The phase is off by 2e-4 at the most, at any rate: the largest displacement of every period is that of the true sweep.
/// Both kinds of sweep and of excitation, up and down, up to the fastest that is allowed.
#[test]
fn a_sweep_in_stretches_is_the_true_sweep() {
    for (changes, rates) in [
        (vec![("\"9 Hz\"", "\"16 Hz\"")], ["\"2.75 Hz/s\"", "\"0.1 Hz/s\""]),
        (
            vec![("\"7.5 Hz\"", "\"16 Hz\""), ("\"9 Hz\"", "\"7.6 Hz\"")],
            ["\"30 oct/min\"", "\"1 oct/min\""],
        ),
        (
            vec![
                ("\"9 Hz\"", "\"16 Hz\""),
                ("\"base-displacement\"", "\"force\""),
                ("\"0.25 mm\"", "\"2.9 N\""),
            ],
            ["\"2.5 Hz/s\"", "\"6 Hz/min\""],
        ),
    ] {
        for rate in rates {
            let all = [changes.clone(), vec![("\"0.1 Hz/s\"", rate)]].concat();
            let case = case(&all);
            let (system, units) = (case.system(), case.units());
            let sweep = case.design.sine_sweep().expect("swept");
            // An absorber in the middle of a cavity too large to be reached.
            let system = system.with_clearance_scaled(1e3).expect("valid");
            let flown = Passage::follow(&system, &units, &sweep, start(0.0)).expect("flown");
            assert_eq!(flown.impacts, 0);
            let alone = swept(&system, None, &units, &sweep, false);
            let exact = integrated(&system, units.natural_frequency, &sweep);
            assert_eq!((flown.envelope.len(), alone.envelope.len()), (exact.len(), exact.len()));
            let largest = exact.iter().copied().fold(0.0, f64::max);
            let worst = |found: &Passage| {
                let off = |(one, exact): (&[f64; 2], &f64)| (one[1] - exact).abs() / largest;
                found.envelope.iter().zip(&exact).map(off).fold(0.0, f64::max)
            };
            // The constant and the harmonic that are left of the force, and the largest sample of the integration.
            let (with, without) = (worst(&flown), worst(&alone));
            assert!(with < 1e-4 && without < 1e-4, "{rate}: {with:e} {without:e}");
            // Velocity and acceleration, by the engine and by matrices.
            let mut told = |_: &_| {};
            let flown = Passage::follow_telling(
                &system,
                &units,
                &sweep,
                start(0.0),
                u64::MAX,
                true,
                &mut told,
            );
            let flown = flown.expect("flown").0.shaking.expect("asked for");
            let alone = swept(&system, None, &units, &sweep, true).shaking.expect("asked for");
            for [with, without] in [
                [flown.peak_velocity, alone.peak_velocity],
                [flown.peak_acceleration, alone.peak_acceleration],
            ] {
                // Cubics over a 128th of a period leave 1.5e-8.
                assert!((without / with - 1.0).abs() < 1e-7, "{rate}: {with} {without}");
            }
        }
    }
}

/// Stretches follow one another without a gap, in whole periods, and the excitation goes on where it was.
#[test]
fn stretches_make_up_the_sweep() {
    let case = case(&[("\"9 Hz\"", "\"16 Hz\""), ("\"0.1 Hz/s\"", "\"2.7 Hz/s\"")]);
    let (units, sweep) = (case.units(), case.design.sine_sweep().expect("swept"));
    let all: Vec<_> = sweep.stretches(&units).collect();
    assert_eq!(all.iter().filter(|one| one.first).count() as u64, sweep.count());
    assert!(all.len() as u64 > 5 * sweep.count());
    let time: f64 = all.iter().map(|one| (TAU - one.begins) / one.ratio).sum();
    let wanted = units.natural_frequency * sweep.time(sweep.count() as f64);
    assert!((time / wanted - 1.0).abs() < 1e-12, "{time} {wanted}");
    // Slow enough, a period is one stretch.
    let slow = sweep.faster(1e-3);
    assert_eq!(slow.stretches(&units).count() as u64, slow.count());
}

/// With impacts: energy of every period, and the exact orbit that a slow sweep follows where it attracts.
#[test]
fn a_slow_sweep_follows_the_exact_orbit_and_loses_no_energy() {
    let case = case(&[
        ("\"7.5 mm\"", "\"20 mm\""),
        ("\"7.5 Hz\"", "\"8.5 Hz\""),
        ("\"9 Hz\"", "\"8.51 Hz\""),
        ("\"0.1 Hz/s\"", "\"0.0001 Hz/s\""),
    ]);
    let (system, units) = (case.system(), case.units());
    let sweep = case.design.sine_sweep().expect("swept");
    let after = attracting_orbit(&system).expect("one attracts").orbit.cycle.impacts[0];
    let mut simulation = Simulation::new(&system, after.state(), after.phase).expect("a start");
    simulation.run(1, u64::MAX, &mut ());
    let found = Passage::follow(&system, &units, &sweep, simulation.state()).expect("flown");
    assert!(found.residual < 1e-9, "{}", found.residual);
    assert_eq!(found.impacts, 2 * sweep.count());
    for [ratio, peak] in found.envelope.iter().step_by(100) {
        let there = system.with_frequency_ratio(*ratio).expect("valid");
        let orbit = attracting_orbit(&there).expect("one attracts").peaks.displacement;
        assert!((peak / orbit - 1.0).abs() < 1e-3, "{ratio}: {peak} {orbit}");
    }
}

/// Twice `k` periods up and down: the closed forms of time and phase are each other's inverse, for both kinds of rate.
#[test]
fn time_and_phase_belong_together() {
    for rate in [SweepRate::Linear(0.3), SweepRate::Octaves(2.0)] {
        for (from, to) in [(5.0, 9.0), (9.0, 5.0)] {
            let sweep = SineSweep { from, to, rate, turn: 1.0 };
            for n in [0.0, 1.0, 17.3, sweep.count() as f64] {
                assert!((sweep.turns(sweep.time(n)) - n).abs() < 1e-9, "{sweep:?} {n}");
            }
            let end = sweep.time(sweep.count() as f64);
            let f = (sweep.turns(end) - sweep.turns(end - 1e-4)) / 1e-4;
            // Less than a period is left over.
            assert!((f - to).abs() < 2.0 * sweep.fastest_change() * to, "{f} {to}");
            let duration = match rate {
                SweepRate::Linear(_) => 4.0 / 0.3,
                SweepRate::Octaves(_) => 30.0 * 1.8_f64.log2(),
            };
            assert!((end - duration).abs() < 1.0 / from.min(to), "{end} {duration}");
        }
    }
}

/// What a study tells is what its passages did, and criteria are about the worst of them.
#[test]
fn the_worst_place_of_the_absorber_counts() {
    let case = case(&[
        ("\"7.5 Hz\"", "\"8 Hz\""),
        ("\"9 Hz\"", "\"8.8 Hz\""),
        (
            "restitution = 0.6",
            "restitution = 0.6\n[criteria]\npeak_displacement = \"<= 8 mm\"\nreduction_db = \">= 3\"\n[simulation]\nstarts = 8",
        ),
    ]);
    let study = SweepStudy::of_case(&case, &Serial).expect("swept").expect("studied");
    assert_eq!((study.starts.even, study.starts.all.len()), (8, 12));
    let (system, units) = (case.system(), case.units());
    let peaks = [-0.875, -0.625, -0.375, -0.125, 0.125, 0.375, 0.625, 0.875].map(|w| {
        let found = Passage::follow(&system, &units, &study.sweep, start(w)).expect("flown");
        found.peak()[1]
    });
    // Even places, and closer ones.
    assert!(study.starts.all.iter().zip(peaks).all(|((_, found), peak)| found.peak()[1] == peak));
    let worst = study.starts.all.iter().map(|(_, found)| found.peak()[1]).fold(0.0, f64::max);
    assert_eq!(study.worst().expect("flown").1.peak()[1], worst);
    let judged = judge_transient(&case, &Study::Sweep(Box::new(study.clone())));
    let of = |measure| {
        judged
            .iter()
            .find(|one| one.criterion.measure == measure)
            .expect("asked")
            .found
            .expect("found")
    };
    assert!((of(Measure::Peak) - 7.5e-3 * worst).abs() < 1e-15);
    let alone = swept(&system, None, &units, &study.sweep, false).peak()[1];
    assert!((of(Measure::ReductionDb) - 20.0 * (alone / worst).log10()).abs() < 1e-12);
    // The faster the sweep, the less the structure alone comes up, and the later.
    let alone: Vec<[f64; 2]> = study.by_rate.iter().map(|one| one.peaks[1]).collect();
    assert!(
        alone.windows(2).all(|two| two[1][1] < two[0][1] && two[1][0] >= two[0][0]),
        "{alone:?}"
    );
}
