//! The ends of the range: nothing hangs, nothing panics, and what cannot be trusted says so.

use crate::common;
use assert_cmd::Command;
use vinesink::executor::Serial;
use vinesink::motions::{Effort, Place, motions};
use vinesink::operation_count::counted;
use vinesink::simulation::trust::{self, Doubt};
use vinesink::simulation::{Energy, Measurement, Simulation, Stop};
use vinesink::system::{Parameters, State, System};

const START: State = State { x: 0.25, x_velocity: 0.3, y: -0.4, y_velocity: 0.6 };

/// A structure damped a million times more than critically comes back so slowly that no start settles: it is
/// measured where it is, and not flown on for millions of periods.
#[test]
fn an_overdamped_structure_is_not_waited_for() {
    let base = common::table_1(8.0, 7.5).parameters();
    let system = System::new(Parameters { damping: 3e8 * base.damping, ..base }).expect("valid");
    let search = || motions(&[Place::new(&system, 4)], &Effort::over(100), &Serial);
    let (found, operations) = counted(|| search().expect("inside").remove(0));
    assert!(found.iter().any(|motion| motion.reached().starts > 0));
    // 1.2e8, of some thousand periods of four starts, of which hundreds of times as many were flown.
    assert!(operations < 300_000_000, "{operations:e}");
}

/// Far beyond any physics: the run ends, and is not trusted.
#[test]
fn absurd_forcing_ends_and_is_flagged() {
    for forcing_per_clearance in [1e10, 1e14, 1e16, 1e20, 1e50, 1e155, 1e200, 1e307] {
        for restitution in [0.0, 0.6, 1.0] {
            for frequency_ratio in [1e-3, 1.0, 1e3] {
                let table = common::table_1(8.0, 7.5).parameters();
                let system = System::new(Parameters {
                    forcing_per_clearance,
                    restitution,
                    frequency_ratio,
                    ..table
                })
                .expect("valid");
                let mut simulation = Simulation::new(&system, START, 0.0).expect("inside");
                let mut measurement = Measurement::begin(&system, START);
                let stop = simulation.run(2, 1000, &mut measurement);
                let statistics = measurement.statistics();
                // A fast excitation moves the oscillator by its forcing over a million only.
                if frequency_ratio <= 1.0 {
                    let doubts = statistics.doubts(stop);
                    assert!(!doubts.is_empty(), "{forcing_per_clearance:e} {restitution}");
                }
            }
        }
    }
}

/// An overdamped oscillator's fast rate, or a slow excitation, must not shorten every step.
#[test]
fn overdamped_and_slowly_driven_oscillators_cost_no_more_than_others() {
    let base = common::table_1(8.0, 7.5).parameters();
    let heavy = Parameters { mass_ratio: 0.9, damping: 1e3, ..base };
    let slow = Parameters { mass_ratio: 0.18, frequency_ratio: 1e-3, restitution: 0.0, ..base };
    let slow = Parameters { forcing_per_clearance: 6000.0, ..slow };
    for (parameters, periods) in [(heavy, 20), (slow, 1)] {
        let system = System::new(parameters).expect("valid");
        let mut simulation = Simulation::new(&system, START, 0.0).expect("inside");
        assert_eq!(simulation.run(periods, 1_000_000, &mut ()), Stop::EndTime);
        let time = periods as f64 * system.period();
        let events = time + simulation.impacts() as f64;
        let each = simulation.evaluations() as f64 / events;
        assert!(each < 50.0, "{each} evaluations for each impact or unit of time");
    }
}

#[test]
fn each_reason_to_doubt_is_given_where_it_applies_and_not_elsewhere() {
    let sound = Energy {
        input: 2.0,
        damper: 1.5,
        impact: 0.5,
        friction: 0.0,
        stored: 0.0,
        relative_residual: 0.0,
    };
    let kinds = |stop, energy: &Energy, penetration, peak| -> Vec<&'static str> {
        trust::doubts(stop, energy, penetration, peak)
            .iter()
            .map(|doubt| match doubt {
                Doubt::Unfinished { .. } => "unfinished",
                Doubt::Energy { .. } => "energy",
                Doubt::Penetration { .. } => "penetration",
                Doubt::Resolution { .. } => "resolution",
            })
            .collect()
    };
    assert_eq!(kinds(Stop::EndTime, &sound, 1e-15, 3.0), [""; 0]);
    assert_eq!(kinds(Stop::ImpactLimit, &sound, 1e-15, 3.0), ["unfinished"]);
    let open = Energy { input: 2.0 + 1e-7, ..sound };
    assert_eq!(kinds(Stop::EndTime, &open, 1e-15, 1.0), ["energy"]);
    // Half the squared peak is the largest energy, and hides it.
    assert_eq!(kinds(Stop::EndTime, &open, 1e-15, 1e3), [""; 0]);
    let undefined = Energy { input: f64::NAN, ..sound };
    assert_eq!(kinds(Stop::EndTime, &undefined, 1e-15, 1.0), ["energy"]);
    assert_eq!(kinds(Stop::EndTime, &sound, 2e-9, 1.0), ["penetration"]);
    assert_eq!(kinds(Stop::EndTime, &sound, 0.0, 1e7), ["resolution"]);
}

#[test]
fn simulate_warns_and_exits_with_1_where_it_is_not_to_be_trusted() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("tiny.toml");
    let case = |forcing: &str| {
        format!(
            "title = \"t\"\nsource = \"s\"\n[reduced]\nmass_ratio = 0.0077\ndamping = 1.8\n\
             restitution = 0.6\nclearance = 1.0\nforcing = {forcing}\nfrequency_ratio = 0.958\n"
        )
    };
    let run = |forcing: &str, format: &str| {
        std::fs::write(&path, case(forcing)).expect("written");
        Command::cargo_bin("vinesink")
            .expect("built")
            .args(["simulate", path.to_str().expect("UTF-8"), "--initial", "0,0.01,0,0"])
            .args(["--periods", "50", "--discard", "10", "--format", format])
            .output()
            .expect("runs")
    };
    let sound = run("4.342", "json");
    assert_eq!(sound.status.code(), Some(0));
    let document: serde_json::Value = serde_json::from_slice(&sound.stdout).expect("JSON");
    assert_eq!(document["trusted"], true);
    assert_eq!(document["doubts"], serde_json::json!([]));
    let unsound = run("1e9", "json");
    assert_eq!(unsound.status.code(), Some(1));
    let document: serde_json::Value = serde_json::from_slice(&unsound.stdout).expect("JSON");
    assert_eq!(document["trusted"], false);
    let kinds: Vec<&str> = document["doubts"]
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(|doubt| doubt["kind"].as_str())
        .collect();
    assert!(kinds.contains(&"resolution"), "{document}");
    assert!(document["doubts"][0]["advice"].as_str().is_some_and(|advice| !advice.is_empty()));
    let warning = String::from_utf8(unsound.stderr).expect("UTF-8");
    assert!(warning.contains("not to be trusted"), "{warning}");
    let text = String::from_utf8(run("1e9", "text").stdout).expect("UTF-8");
    assert!(text.contains("NOT TO BE TRUSTED"), "{text}");
}
