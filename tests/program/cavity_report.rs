//! What is printed and claimed of a case whose cavity is tilted, rubs, or has ends that differ: it is of that cavity.
//!
//! Truth: the library's theory of the cavity and its exact orbits, which `tests/physics` proves; simulation.

use std::f64::consts::TAU;
use std::fs;
use std::process::Command;

use serde_json::Value;
use vinesink::analysis::Analysis;
use vinesink::case::Case;
use vinesink::cavity::{CavityTheory, Forcing};
use vinesink::executor::Serial;
use vinesink::motions::{Effort, Motions, Place, Window, at_rest, motions};
use vinesink::orbits::{FullSystem, Measures, Orbit, two_impact_orbits};
use vinesink::study::margins::Margins;
use vinesink::system::{Cavity, Parameter, Parameters, System};
use vinesink::validation::{Claim, Verdict, confront_simulation, confront_theory};

const TILTED: &str = include_str!("../cavity/tilted.toml");
const KEYS: &str = "restitution = [0.65, 0.55]\ninclination = \"0.5 deg\"\nfriction = \"0.3 %\"\n";
/// A gentle tilt, friction, ends that differ, and all of them.
const CAVITIES: [&str; 4] = [
    "restitution = 0.6\ninclination = \"0.3 deg\"\n",
    "restitution = 0.6\nfriction = \"5 %\"\n",
    "restitution = [0.7, 0.5]\n",
    KEYS,
];

fn with(keys: &str) -> String {
    assert!(TILTED.contains(KEYS));
    TILTED.replacen(KEYS, keys, 1)
}

fn system(keys: &str) -> System {
    Case::parse("case.toml", &with(keys)).unwrap_or_else(|error| panic!("{error:?}")).system()
}

fn printed(text: &str, arguments: &[&str]) -> String {
    told("analyze", text, arguments)
}

fn told(command: &str, text: &str, arguments: &[&str]) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("case.toml"), text).expect("written");
    let mut program = Command::new(env!("CARGO_BIN_EXE_vinesink"));
    let program = program.current_dir(folder.path()).args([command, "case.toml"]);
    let output = program.args(arguments).output().expect("it runs");
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    String::from_utf8(output.stdout).expect("UTF-8")
}

const WINDOW: Window = Window { discard: 100, periods: 20, impact_limit: 100_000 };

/// What can be solved for.
fn solved(system: &System) -> Motions {
    let place = Place::with(system, Vec::new());
    motions(&[place], &Effort::default(), &Serial).expect("finite").remove(0)
}

/// Claims by the layers of a system, the exact orbits being those given.
fn claims(system: &System, exact: &FullSystem) -> Vec<Claim> {
    let analysis = Analysis::of(system).expect("theory");
    let mut all = confront_theory(&analysis, exact);
    let known = solved(system);
    all.extend(confront_simulation(&analysis, exact, &known, &[], &WINDOW).expect("runs"));
    all
}

fn ids_of(claims: &[Claim], verdict: Verdict) -> Vec<&str> {
    claims.iter().filter(|one| one.verdict == verdict).map(|one| one.id.as_str()).collect()
}

#[test]
fn analyze_prints_what_the_library_knows_of_the_cavity() {
    for keys in CAVITIES {
        let system = system(keys);
        let found: Value =
            serde_json::from_str(&printed(&with(keys), &["--format", "json"])).expect("JSON");
        let Cavity { gravity_along, friction_acceleration, .. } = system.cavity();
        let ends = system.restitutions();
        let theory = CavityTheory::new(gravity_along, friction_acceleration, ends).expect("valid");
        let points = theory.fixed_points(&Forcing::of(&system));
        let told = &found["theory"]["cavity"];
        let number = |of: &Value, key: &str| of[key]["value"].as_f64().expect("a number");
        let near = |one: f64, other: f64| {
            assert!((one / other - 1.0).abs() < 1e-14, "{keys}: {one} {other}");
        };
        let all = told["fixed_points"].as_array().expect("points");
        assert_eq!((all.len(), points.is_empty()), (points.len(), false));
        let clearance = 7.5e-3;
        for (one, point) in all.iter().zip(&points) {
            near(
                number(one, "oscillator_amplitude"),
                clearance * point.motion.oscillator_amplitude,
            );
            near(number(one, "absorber_amplitude"), clearance * point.motion.absorber_amplitude);
            near(number(one, "flight_share"), point.motion.times[0] / TAU);
            assert_eq!(one["stable"].as_bool(), Some(point.stable));
        }
        let orbits = two_impact_orbits(&system).expect("solved").orbits;
        let all = told["orbits"].as_array().expect("orbits");
        assert_eq!((all.len(), orbits.is_empty()), (orbits.len(), false));
        for (one, orbit) in all.iter().zip(&orbits) {
            let peaks = Measures::of(&system, &orbit.cycle).expect("measured").peaks;
            near(number(one, "peak"), clearance * peaks.displacement);
            near(number(one, "multiplier"), orbit.radius_per_period());
            let share = orbit.cycle.unfolded().durations[0] / system.period();
            near(number(one, "flight_share"), share);
        }
        // Friction alone leaves a fold and a symmetry breaking.
        assert_eq!(told["fold"].is_array(), keys == CAVITIES[1]);
        let text = printed(&with(keys), &[]);
        assert!(text.contains("are those of an ideal cavity with the mean restitution"), "{text}");
        assert_eq!(text.matches("of the period: ").count(), points.len() + orbits.len(), "{text}");
        assert!(!text.contains("none"), "{text}");
    }
    let ideal = with("restitution = 0.6\n");
    let found: Value = serde_json::from_str(&printed(&ideal, &["--format", "json"])).expect("JSON");
    assert!(found.get("cavity").is_none() && found["theory"].get("cavity").is_none());
    assert!(!printed(&ideal, &[]).contains("cavity with"));
}

#[test]
fn every_claim_of_a_gentle_cavity_is_confirmed() {
    for keys in CAVITIES {
        let system = system(keys);
        let found = claims(&system, &FullSystem::of(&system));
        assert_eq!(ids_of(&found, Verdict::Confirmed).len(), found.len(), "{keys}: {found:#?}");
        let has = |id: &str| found.iter().any(|one| one.id == id);
        for id in ["fixed-point-2-t_1", "fixed-point-2-stability", "orbit-1-repeats"] {
            assert!(has(id), "{keys}: {id}");
        }
        // Those of an ideal cavity are not raised; ends that differ leave an absorber at rest alone.
        assert!(!has("area") && !found.iter().any(|one| one.id.starts_with("boundary")));
        assert_eq!(has("rest"), keys == CAVITIES[2], "{keys}");
        assert!(!has("fixed-point-2-Theta"));
    }
}

/// Held by friction, on the wall that gravity pulls it to, and sliding.
#[test]
fn an_absorber_at_rest_is_confirmed_by_simulation() {
    let base = system("restitution = 0.6\n").parameters();
    for (keys, factor) in [
        ("restitution = 0.6\nfriction = \"20 %\"\n", 0.1),
        ("restitution = 0.6\ninclination = \"-3 deg\"\n", 0.05),
        ("restitution = 0.6\nfriction = \"0.1 %\"\n", 1.0),
        ("restitution = 0.6\nfriction = \"2 %\"\n", 0.5),
    ] {
        let cavity = system(keys).cavity();
        let forcing_per_clearance = factor * base.forcing_per_clearance;
        let gentle = Parameters { cavity, forcing_per_clearance, ..base };
        let system = System::new(gentle).expect("valid");
        let found = claims(&system, &FullSystem::of(&system));
        let claim = found.iter().find(|one| one.id == "inactive").expect("it may rest");
        assert_eq!(claim.verdict, Verdict::Confirmed, "{keys}: {claim:?}");
        assert!(claim.tolerance < 0.05, "{keys}: {claim:?}");
    }
}

/// Orbits of the opposite inclination, and an absorber that is said to rest with another amplitude, refute what is claimed.
#[test]
fn what_is_not_so_is_refuted() {
    let [tilted, opposite] = ["3 deg", "-3 deg"]
        .map(|of| system(&format!("restitution = 0.6\ninclination = \"{of}\"\n")));
    let mut exact = FullSystem::of(&tilted);
    exact.two_impact = FullSystem::of(&opposite).two_impact;
    let found = claims(&tilted, &exact);
    let refuted = ids_of(&found, Verdict::Refuted);
    for id in ["fixed-point-2-t_1", "orbit-1-repeats"] {
        assert!(refuted.contains(&id), "{id} {refuted:?}");
    }
    let base = system("restitution = 0.6\nfriction = \"20 %\"\n").parameters();
    let quiet = System::new(Parameters { forcing_per_clearance: 0.4, ..base }).expect("valid");
    // Held, with what a forcing that is larger by a thousandth would give.
    let louder = System::new(Parameters { forcing_per_clearance: 0.4004, ..base }).expect("valid");
    assert!(at_rest(&quiet).is_some());
    let wrong = solved(&louder);
    let (analysis, exact) = (Analysis::of(&quiet).expect("theory"), FullSystem::of(&quiet));
    let found = confront_simulation(&analysis, &exact, &wrong, &[], &WINDOW).expect("runs");
    assert_eq!(ids_of(&found, Verdict::Refuted), ["inactive"]);
    // And a cavity in which nothing can rest claims nothing of it.
    let steep = Cavity { gravity_along: 1e-4, ..Cavity::IDEAL };
    let awake = System::new(Parameters { cavity: steep, ..base }).expect("valid");
    assert!(at_rest(&awake).is_none());
}

/// When the forcing alone changes, gravity and friction stay: its limits are no reciprocals of those of the clearance. Each
/// is where the exact orbit ends, solved anew on either side.
#[test]
fn limits_of_the_forcing_are_those_of_the_orbit() {
    for keys in [
        "restitution = 0.6\ninclination = \"5 deg\"\n",
        "restitution = 0.6\ninclination = \"2 deg\"\nfriction = \"5 %\"\n",
    ] {
        let system = system(keys);
        let analysis = Analysis::of(&system).expect("theory");
        let margins = Margins::of(&analysis, &FullSystem::of(&system)).exact.expect("attracts");
        let attracts = |factor: f64| {
            let there = Parameter::Amplitude.applied(&system, factor).expect("valid");
            let found = two_impact_orbits(&there).expect("solved").orbits;
            // The other half of an imperfect pitchfork leans the other way.
            let leans = |one: &&Orbit| one.cycle.unfolded().durations[0] < 0.5 * there.period();
            found.iter().filter(leans).any(Orbit::attracts)
        };
        assert!(attracts(1.0), "{keys}");
        let [low, high] = margins.forcing.map(|end| end.expect("an end").factor);
        assert!(attracts(low * 1.002) && !attracts(low * 0.998), "{keys} {low}");
        assert!(attracts(high * 0.998) && !attracts(high * 1.002), "{keys} {high}");
        let reciprocals = margins.clearance.map(|end| 1.0 / end.expect("an end").factor);
        let off = (low / reciprocals[1] - 1.0).abs().max((high / reciprocals[0] - 1.0).abs());
        assert!(off > 0.01, "{keys} {off}");
    }
}

/// The weight of an absorber on the lower wall shifts the structure: `check`, by closed form, has the peak and the root mean
/// square of `simulate`.
#[test]
fn the_absorbers_weight_counts_in_criteria() {
    let steep = with("restitution = 0.6\ninclination = \"30 deg\"\n")
        .replace("amplitude = \"0.25 mm\"", "amplitude = \"0.02 mm\"");
    let text = format!(
        "{steep}\n[criteria]\npeak_displacement = \"<= 1 m\"\nrms_displacement = \"<= 1 m\"\n"
    );
    let read = |command, more: &[&str]| -> Value {
        let options = [&["--format", "json"], more].concat();
        serde_json::from_str(&told(command, &text, &options)).expect("JSON")
    };
    let (checked, simulated) = (read("check", &["--criteria-only"]), read("simulate", &[]));
    let criteria = &checked["cases"][0]["criteria"];
    let motion = &simulated["displacement"];
    for (k, key) in ["peak", "rms"].into_iter().enumerate() {
        assert_eq!(criteria[k]["decided_by"], "closed-form");
        let [found, seen] =
            [&criteria[k]["found"], &motion[key]].map(|one| one.as_f64().expect(key));
        assert!((found / seen - 1.0).abs() < 1e-9, "{key}: {found} {seen}");
    }
}
