//! What would spoil a design first: each row against a simulation of the design with its number changed by hand.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::{Value, json};
use vinesink::answer::{Answer, Asked};
use vinesink::case::Case;
use vinesink::executor::Serial;
use vinesink::motions::{Measured, Motion, Window, starts};
use vinesink::orbits::FullSystem;
use vinesink::study::deviations::{Deviation, STARTS};
use vinesink::study::{CaseStudy, Deviations};

/// Table 1 with a small clearance: one steady motion of two impacts per period, which every start leads to.
const STEADY: &str = "title = \"t\"\nsource = \"s\"\n[oscillator]\nmass = \"4.168 kg\"\nstiffness = \"11.47 kN/m\"\n\
    damping = \"3.02 N s/m\"\n[absorber]\nmass = \"32 g\"\nclearance = \"7.5 mm\"\nrestitution = 0.6\n[excitation]\n\
    kind = \"base-displacement\"\namplitude = \"0.25 mm\"\nfrequency = \"8 Hz\"\n[simulation]\nstarts = 4\n";
const REDUCED: &str = "title = \"t\"\nsource = \"s\"\n[reduced]\nmass_ratio = 0.0077\ndamping = 1.8\nrestitution = 0.6\n\
    clearance = 1.0\nforcing = 4.34\nfrequency_ratio = 0.958\nkind = \"force\"\n[simulation]\nstarts = 4\n";

fn parsed(text: &str) -> Case {
    Case::parse("case.toml", text).unwrap_or_else(|error| panic!("{error:?}"))
}

fn found(case: &Case) -> (CaseStudy, Deviations) {
    let answer = Answer::of(case, Asked::Study, None, &Serial).expect("a study");
    let study = answer.studied().expect("it was asked for").clone();
    let deviations = Deviations::of(case, &study, &Serial).expect("simulated").expect("it moves");
    (study, deviations)
}

fn rig(of: &Deviations, deviation: Deviation) -> &Motion {
    &of.rigs.iter().find(|rig| rig.deviation == deviation).expect("a row").motion
}

fn peak(of: &Motion) -> f64 {
    of.facts().peak.value
}

/// The largest peak of another design, each start alone, with the whole window measured.
fn largest(study: &CaseStudy, text: &str) -> f64 {
    let system = parsed(text).system();
    let own = study.motions.iter().filter(|one| one.rest().is_none()).map(Motion::state);
    let window = Window { discard: 800, periods: 50, impact_limit: u64::MAX };
    let starts = own.chain(starts::spread(&system, STARTS));
    let reach = |start| Measured::reach(&system, start, &window).expect("a start");
    starts.map(|start| reach(start).facts.peak.value).fold(0.0, f64::max)
}

/// A repetition closes to 1e-6, and shrinks by a multiplier of 0.95 in each period: 2e-5 are left to go.
fn close(value: f64, expected: f64, what: &str) {
    assert!((value / expected - 1.0).abs() < 2e-5, "{what}: {value} {expected}");
}

#[test]
fn each_row_is_the_design_with_one_number_changed() {
    let (study, found) = found(&parsed(STEADY));
    assert_eq!(found.rigs.len(), Deviation::ALL.len());
    let stiffness = "stiffness = \"11.47 kN/m\"\ndamping = \"3.02 N s/m\"";
    // Mass and damping ratio stay.
    let detuned = |factor: f64| {
        let [k, c] = [11.47 * factor * factor, 3.02 * factor];
        (stiffness, format!("stiffness = \"{k} kN/m\"\ndamping = \"{c} N s/m\""))
    };
    let restitution = "restitution = 0.6";
    for (deviation, (from, to)) in [
        (Deviation::Tilt, (restitution, format!("{restitution}\ninclination = \"0.2 deg\""))),
        (Deviation::Friction, (restitution, format!("{restitution}\nfriction = 0.005"))),
        (Deviation::UnequalEnds, (restitution, "restitution = [0.61, 0.59]".into())),
        (Deviation::RestitutionLower, (restitution, "restitution = 0.58".into())),
        (Deviation::RestitutionHigher, (restitution, "restitution = 0.62".into())),
        (Deviation::FrequencyLower, detuned(0.99)),
        (Deviation::FrequencyHigher, detuned(1.01)),
    ] {
        let changed = STEADY.replacen(from, &to, 1);
        assert_ne!(changed, STEADY);
        let expected = largest(&study, &changed);
        close(peak(rig(&found, deviation)), expected, &format!("{deviation:?}"));
    }
    let own = largest(&study, STEADY);
    close(peak(&found.own), own, "the case");
    for rig in &found.rigs {
        assert_eq!(rig.change, Some(peak(&rig.motion) / peak(&found.own) - 1.0));
    }
    assert!(found.rigs.windows(2).all(|pair| pair[0].change >= pair[1].change));
}

#[test]
fn deviations_are_added_to_what_a_cavity_has() {
    let own = "restitution = [0.55, 0.65]\ninclination = \"-0.5 deg\"\nfriction = 0.003";
    let with = |keys: &str| parsed(&STEADY.replacen("restitution = 0.6", keys, 1));
    for (deviation, keys) in [
        (Deviation::Tilt, own.replacen("-0.5", "-0.7", 1)),
        (Deviation::Friction, own.replacen("0.003", "0.008", 1)),
        (Deviation::UnequalEnds, own.replacen("[0.55, 0.65]", "[0.54, 0.66]", 1)),
        (Deviation::RestitutionLower, own.replacen("[0.55, 0.65]", "[0.53, 0.63]", 1)),
    ] {
        let system = deviation.system(&with(own).design).expect("a system");
        let [found, expected] = [system, with(&keys).system()].map(|one| {
            let (cavity, [plus, minus]) = (one.cavity(), one.restitutions());
            [cavity.gravity_along, cavity.friction_acceleration, plus, minus]
        });
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-14, "{deviation:?}: {found} {expected}");
        }
    }
}

/// Of a force on a structure that is 1 % stiffer in frequency: Omega is over it, gamma over its square; the damping ratio stays.
#[test]
fn a_reduced_design_has_no_gravity() {
    let (study, found) = found(&parsed(REDUCED));
    let rows: Vec<Deviation> = found.rigs.iter().map(|rig| rig.deviation).collect();
    assert_eq!(rows.len(), 5, "{rows:?}");
    assert!(!rows.contains(&Deviation::Tilt) && !rows.contains(&Deviation::Friction));
    let changed = REDUCED
        .replacen("forcing = 4.34", &format!("forcing = {:?}", 4.34 / (1.01 * 1.01)), 1)
        .replacen("ratio = 0.958", &format!("ratio = {:?}", 0.958 / 1.01), 1);
    let peak = peak(rig(&found, Deviation::FrequencyHigher));
    close(peak, largest(&study, &changed), "a stiffer structure");
    // No wall gives back more than it gets.
    let elastic = parsed(&REDUCED.replacen("restitution = 0.6", "restitution = 0.99", 1));
    assert!(Deviation::RestitutionHigher.system(&elastic.design).is_none());
    assert!(Deviation::UnequalEnds.system(&elastic.design).is_some());
}

/// A motion that never repeats: only what is beyond what ten times as long a run may add is a change.
#[test]
fn what_scatters_is_not_ranked() {
    let text = fs::read_to_string("cases/li2016-8p5hz-fig4d.toml").expect("a case");
    let text = format!("{text}\n[simulation]\nstarts = 2\nperiods = 200\n");
    let (_, found) = found(&parsed(&text));
    let range = |motion: &Motion| {
        let peak = motion.facts().peak;
        [peak.value, peak.value + peak.error]
    };
    let own = range(&found.own);
    assert!(own[1] > own[0]);
    let mut within = 0;
    for rig in &found.rigs {
        let other = range(&rig.motion);
        let overlap = own[0].max(other[0]) <= own[1].min(other[1]);
        assert_eq!(rig.change.is_none(), overlap, "{rig:?} {own:?}");
        within += u32::from(overlap);
    }
    assert!(within >= 2 && found.rigs.iter().any(|rig| rig.change.is_some()));
    let order: Vec<f64> = found.rigs.iter().map(|rig| rig.change.unwrap_or(0.0)).collect();
    assert!(order.windows(2).all(|pair| pair[0] >= pair[1]), "{order:?}");
}

fn vinesink(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_vinesink"));
    command.current_dir(folder).args(arguments).output().expect("it runs")
}

fn report(folder: &Path, name: &str, text: &str) -> (String, Value) {
    fs::write(folder.join(format!("{name}.toml")), text).expect("written");
    let output = vinesink(folder, &["report", &format!("{name}.toml")]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let read = |file: &str| fs::read_to_string(folder.join("reports").join(name).join(file));
    let json = serde_json::from_str(&read("report.json").expect("written")).expect("JSON");
    (read("report.md").expect("written"), json)
}

#[test]
fn a_report_says_it_unless_it_is_asked_not_to() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = STEADY.to_owned();
    let (page, facts) = report(folder.path(), "case", &text);
    let rows = facts["deviations"]["rows"].as_array().expect("rows");
    let first = &rows[0];
    // The exact orbits of both designs.
    let peak = |stiffness: &str| {
        let system = parsed(&STEADY.replacen("11.47 kN/m", stiffness, 1)).system();
        let exact = FullSystem::of(&system);
        7.5 * exact.attracting().expect("an orbit").peaks.displacement
    };
    let [own, worst] = [peak("11.47 kN/m"), peak("11.241747 kN/m")];
    let said = format!(
        "\nA natural frequency 1 % lower than assumed would spoil this design first: peak {worst:.2} mm instead of \
         {own:.2} mm.\n"
    );
    assert!(page.contains(&said), "{page}");
    assert_eq!(first["deviation"], json!("frequency-lower"));
    assert!(page.contains("| A tilt of 0.2 deg |"), "{page}");
    let without = format!("{text}[report]\ndeviations = false\n");
    let (page, facts) = report(folder.path(), "short", &without);
    assert!(!page.contains("spoil") && facts["deviations"].is_null());
}

/// A report of before there was such a table differs in nothing that is told; another peak is told by its name.
#[test]
fn a_comparison_names_the_deviation() {
    let folder = tempfile::tempdir().expect("a folder");
    let (_, facts) = report(folder.path(), "case", STEADY);
    let file = |side: &str| folder.path().join(side).join("case/report.json");
    let compared = |old: &Value, new: &Value| {
        for (side, facts) in [("old", old), ("new", new)] {
            fs::create_dir_all(file(side).parent().expect("a folder")).expect("made");
            fs::write(file(side), facts.to_string()).expect("written");
        }
        let output = vinesink(folder.path(), &["diff", "old", "new"]);
        String::from_utf8(output.stdout).expect("text").to_lowercase()
    };
    let mut before = facts.clone();
    before.as_object_mut().expect("an object").remove("deviations");
    assert!(compared(&before, &facts).contains("| deviation | – | there |"));
    before["provenance"]["version"] = json!("0.0.7");
    assert!(!compared(&before, &facts).contains("deviation"));
    let mut moved = facts.clone();
    let rows = moved["deviations"]["rows"].as_array_mut().expect("rows");
    rows.reverse();
    assert!(!compared(&facts, &moved).contains("deviation"), "the order follows from the peaks");
    let tilt = moved["deviations"]["rows"].as_array_mut().expect("rows").iter_mut();
    for row in tilt.filter(|row| row["deviation"] == "tilt") {
        row["peak"]["value"] = json!(0.004);
    }
    let told = compared(&facts, &moved);
    assert!(told.contains("deviation tilt: peak displacement"), "{told}");
    assert_eq!(told.matches("deviation ").count(), 1, "{told}");
}
