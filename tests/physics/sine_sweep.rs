//! A structure that is swept through resonance, against an independent integration, energy, the steady motions and
//! what a person would do by hand.

#![allow(clippy::disallowed_methods, reason = "a test may use the platform's functions")]

use std::f64::consts::{PI, TAU};

use vinesink::case::{Case, Subject};
use vinesink::criteria::judge_sweep;
use vinesink::executor::Serial;
use vinesink::orbits::attracting_orbit;
use vinesink::simulation::Simulation;
use vinesink::system::{Excitation, State, System};
use vinesink::transient::linear::swept;
use vinesink::transient::{Passage, SineSweep, SweepRate, SweepStudy};

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

/// Amplitudes of a linear structure at the end of each period of the true sweep, whose frequency and whose base's
/// velocity change all the time, by Runge and Kutta's method in steps of a five-hundredth of a period.
fn integrated(system: &System, omega0: f64, sweep: &SineSweep) -> Vec<[f64; 2]> {
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
    let mut state = [0.0; 2];
    let period = |n: u64| {
        let [begin, end] = [n, n + 1].map(|n| omega0 * sweep.time(n as f64));
        let h = (end - begin) / 500.0;
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
        }
        state
    };
    (0..sweep.count()).map(period).collect()
}

/// The phase is off by `2 pi d/8` within a period at the most, always to one side: amplitudes by the square of that, and
/// at a rate a quarter as fast by a sixteenth. Both kinds of sweep and of excitation, up and down.
#[test]
fn a_sweep_in_periods_is_the_true_sweep_but_for_the_square_of_its_phase_error() {
    for (changes, rates) in [
        (vec![], ["\"0.4 Hz/s\"", "\"0.1 Hz/s\""]),
        (
            vec![("\"7.5 Hz\"", "\"9.3 Hz\""), ("\"9 Hz\"", "\"7.6 Hz\"")],
            ["\"4 oct/min\"", "\"1 oct/min\""],
        ),
        (
            vec![("\"base-displacement\"", "\"force\""), ("\"0.25 mm\"", "\"2.9 N\"")],
            ["\"0.4 Hz/s\"", "\"6 Hz/min\""],
        ),
    ] {
        for rate in rates {
            let all = [changes.clone(), vec![("\"0.1 Hz/s\"", rate)]].concat();
            let case = case(&all);
            let (system, scales) = (case.system(), case.scales());
            let sweep = case.design.sine_sweep().expect("swept");
            // An absorber in the middle of a cavity too large to be reached.
            let system = system.with_clearance_scaled(1e3).expect("valid");
            let flown = Passage::follow(&system, &scales, &sweep, start(0.0)).expect("flown");
            assert_eq!(flown.impacts, 0);
            let alone = swept(&system, None, &scales, &sweep);
            let exact = integrated(&system, scales.natural_frequency, &sweep);
            let largest = exact.iter().map(|[x, v]| x.hypot(*v)).fold(0.0, f64::max);
            let phase = TAU * sweep.fastest_change() / 8.0;
            let (mut worst, mut apart) = (0.0_f64, 0.0_f64);
            for (n, [_, peak]) in flown.envelope.iter().enumerate() {
                // Within the period the structure swings twice: the envelope lies between its ends, about.
                let [a, b] = [n.max(1) - 1, n].map(|n| exact[n][0].hypot(exact[n][1]));
                let outside = (a.min(b) - peak).max(peak - a.max(b)).max(0.0);
                worst = worst.max(outside / largest);
                apart = apart.max((alone.envelope[n][1] - peak).abs() / largest);
            }
            // The damped motion's own ripple within a period, 0.5 zeta, and 12 % of frequency between x and v.
            assert!(worst < 0.02 + phase * phase, "{rate}: {worst}");
            // 128 samples a period miss at most 3e-4 of a peak.
            assert!(apart < 4e-4, "{rate}: {apart}");
        }
    }
}

/// The state at the end of every period of the engine, against the integration: first order in the rate in the phase,
/// second order in the amplitude. Pieces of half a period, flown by the mirrored system, are four times as near.
#[test]
fn pieces_of_half_a_period_change_nothing_but_the_square_of_the_phase_error() {
    let case = case(&[]);
    let (scales, sweep) = (case.scales(), case.design.sine_sweep().expect("swept"));
    let system = case.system().with_clearance_scaled(1e3).expect("valid");
    let exact = integrated(&system, scales.natural_frequency, &sweep);
    let largest = exact.iter().map(|[x, v]| x.hypot(*v)).fold(0.0, f64::max);
    let whole = states(&system, &scales.natural_frequency, &sweep, 1);
    let half = states(&system, &scales.natural_frequency, &sweep, 2);
    let error = |found: &[State]| {
        let off = |(one, exact): (&State, &[f64; 2])| {
            (one.x.hypot(one.x_velocity) - exact[0].hypot(exact[1])).abs() / largest
        };
        found.iter().zip(&exact).map(off).fold(0.0, f64::max)
    };
    let phase = TAU * sweep.fastest_change() / 8.0;
    assert!(
        error(&whole) < phase && error(&half) < 0.3 * phase,
        "{} {} {phase}",
        error(&whole),
        error(&half)
    );
}

/// States at the ends of periods, in whole or half pieces; the mirrored motion is that under the opposite force.
fn states(system: &System, omega0: &f64, sweep: &SineSweep, parts: u32) -> Vec<State> {
    let mut state = start(0.0);
    let mut found = Vec::new();
    for k in 0..sweep.count() * u64::from(parts) {
        let [begin, end] = [k, k + 1].map(|k| sweep.time(k as f64 / f64::from(parts)));
        let ratio = TAU / f64::from(parts) / (end - begin) / omega0;
        let piece = system.with_frequency_ratio(ratio).expect("valid");
        let mirrored = |s: State| State {
            x: -s.x,
            x_velocity: -s.x_velocity,
            y: -s.y,
            y_velocity: -s.y_velocity,
        };
        let first = parts == 2 && k % 2 == 0;
        let begin = if first { mirrored(state) } else { state };
        let phase = if parts == 2 { PI } else { 0.0 };
        let mut simulation = Simulation::new(&piece, begin, phase).expect("a start");
        simulation.run(1, u64::MAX, &mut ());
        state = if first { mirrored(simulation.state()) } else { simulation.state() };
        if !first {
            found.push(state);
        }
    }
    found
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
    let (system, scales) = (case.system(), case.scales());
    let sweep = case.design.sine_sweep().expect("swept");
    let after = attracting_orbit(&system).expect("one attracts").orbit.cycle.impacts[0];
    let mut simulation = Simulation::new(&system, after.state(), after.phase).expect("a start");
    simulation.run(1, u64::MAX, &mut ());
    let found = Passage::follow(&system, &scales, &sweep, simulation.state()).expect("flown");
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
    assert_eq!(study.starts.len(), 8);
    let (system, scales) = (case.system(), case.scales());
    let peaks = [-0.875, -0.625, -0.375, -0.125, 0.125, 0.375, 0.625, 0.875].map(|w| {
        let found = Passage::follow(&system, &scales, &study.sweep, start(w)).expect("flown");
        found.peak()[1]
    });
    let worst = peaks.into_iter().fold(0.0, f64::max);
    assert_eq!(study.worst().expect("flown").1.peak()[1], worst);
    let judged = judge_sweep(&case, &study);
    let of = |subject| {
        judged
            .iter()
            .find(|one| one.criterion.subject == subject)
            .expect("asked")
            .found
            .expect("found")
    };
    assert!((of(Subject::PeakDisplacement) - 7.5e-3 * worst).abs() < 1e-15);
    let alone = swept(&system, None, &scales, &study.sweep).peak()[1];
    assert!((of(Subject::ReductionDb) - 20.0 * (alone / worst).log10()).abs() < 1e-12);
    // The faster the sweep, the less the structure alone comes up, and the later.
    let alone: Vec<[f64; 2]> = study.by_rate.iter().map(|one| one.peaks[1]).collect();
    assert!(
        alone.windows(2).all(|two| two[1][1] < two[0][1] && two[1][0] >= two[0][0]),
        "{alone:?}"
    );
}
