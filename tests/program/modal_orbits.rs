//! What `vinesink analyze` says of the exact orbits of several modes, and where they attract.

use std::fs;

use assert_cmd::Command;
use serde_json::Value;
use tempfile::tempdir;

const MAST: &str = "cases/several/mast.toml";

fn vinesink(arguments: &[&str]) -> std::process::Output {
    let mut command = Command::cargo_bin("vinesink").expect("built");
    command.args(arguments).output().expect("it runs")
}

/// What `analyze` says of a case, as JSON.
fn analysis(text: &str) -> Value {
    let folder = tempdir().expect("a folder");
    let path = folder.path().join("case.toml");
    fs::write(&path, text).expect("written");
    let path = path.to_str().expect("UTF-8");
    let output = vinesink(&["analyze", path, "--format", "json"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

fn list(of: &Value) -> &[Value] {
    of.as_array().expect("a list")
}

/// Whether an orbit is stable under a load.
fn stable(analysis: &Value, load: usize) -> bool {
    list(&analysis["loads"][load]["orbits"]).iter().any(|orbit| orbit["stable"] == true)
}

/// The ends that are told are those of cases that have these numbers of their own.
#[test]
fn stretches_end_where_other_cases_have_no_stable_orbit() {
    let mast = fs::read_to_string(MAST).expect("a shipped case");
    let told = analysis(&mast);
    let third = &told["loads"][2];
    assert_eq!((&third["load"], stable(&told, 2)), (&Value::from(3), true), "{third}");
    let mut ends = 0;
    for (of, unit, from) in [("amplitude", "N", "110.3 N"), ("clearance", "m", "2.7 mm")] {
        let along = list(&third["stable"]).iter().find(|along| along["of"] == of);
        let along = along.expect("looked at");
        assert_eq!(along["unit"], unit);
        let stretches = list(&along["stretches"]);
        assert_eq!(stretches.len(), 1, "{along}");
        for (side, way) in [("from", -1.0), ("to", 1.0)] {
            let end = &stretches[0][side];
            let value = end["value"].as_f64().expect("a number");
            assert!(end["kind"].is_string(), "{along}");
            for (factor, expected) in [(1.0 - 1e-4 * way, true), (1.0 + 1e-4 * way, false)] {
                let other = mast.replace(from, &format!("{} {unit}", factor * value));
                assert_eq!(stable(&analysis(&other), 2), expected, "{of} {side} {end}");
            }
            ends += 1;
        }
    }
    assert_eq!(ends, 4);
    let text = String::from_utf8(vinesink(&["analyze", MAST]).stdout).expect("UTF-8");
    let amplitudes =
        "amplitudes from 70.29 N (Neimark\u{2013}Sacker) to 128.1 N (symmetry breaking)";
    assert!(text.contains(amplitudes), "{text}");
    assert!(text.contains("None is stable at amplitudes from 3.518 N to 56.28 N;"), "{text}");
}

/// A load over several modes has orbits near each of them.
#[test]
fn a_load_over_several_modes_is_looked_at_near_each() {
    let mast = fs::read_to_string(MAST).expect("a shipped case");
    let (before, _) = mast.split_once("[[excitation]]").expect("loads");
    let load = "[[excitation]]\nkind = \"force\"\nplace = \"tip\"\namplitude = \"20 N\"\n\
                from = \"5 Hz\"\nto = \"25 Hz\"\n";
    let told = analysis(&format!("{before}{load}"));
    let at: Vec<f64> = list(&told["loads"]).iter().filter_map(|one| one["at"].as_f64()).collect();
    assert_eq!(at, [6.894, 19.31], "{told}");
    assert!(list(&told["loads"]).iter().all(|one| one["load"] == 1));
}
