//! `vinesink diff` as a reviewer and a script use it: shipped reports against copies with one thing
//! changed. The truth is the change that was made.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::{Value, json};
use tempfile::TempDir;

/// A motion that repeats, one that is chaotic.
const STEADY: &str = "li2016-8p5hz-fig4c";
const CHAOTIC: &str = "li2016-8p5hz-fig4d";

fn shipped(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("reports").join(name)
}

fn vinesink(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_vinesink"));
    command.current_dir(folder).args(arguments).output().expect("it runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

#[track_caller]
fn diff(folder: &Path, arguments: &[&str], code: i32) -> String {
    let output = vinesink(folder, &[&["diff"], arguments].concat());
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", text(&output.stderr));
    assert!(output.stderr.is_empty(), "{}", text(&output.stderr));
    text(&output.stdout)
}

/// The message of what must end with 2 and without a result, in one line.
#[track_caller]
fn refused(folder: &Path, arguments: &[&str]) -> String {
    let output = vinesink(folder, &[&["diff"], arguments].concat());
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
    assert!(output.stdout.is_empty() && !message.contains("panicked"), "{message}");
    message.split(['\n', '│', ' ']).filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder");
    for entry in fs::read_dir(from).expect("a folder") {
        let path = entry.expect("an entry").path();
        let to = to.join(path.file_name().expect("a name"));
        if path.is_dir() {
            copy(&path, &to);
        } else {
            fs::copy(&path, &to).expect("copied");
        }
    }
}

/// `old/` and `new/` with the same reports.
fn two_trees(names: &[&str]) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for side in ["old", "new"] {
        for name in names {
            copy(&shipped(name), &folder.path().join(side).join(name));
        }
    }
    folder
}

/// Changes a report in `new/` at a JSON pointer.
fn edit(folder: &TempDir, name: &str, pointer: &str, change: impl Fn(&mut Value)) {
    edit_side(folder, "new", name, |report| change(report.pointer_mut(pointer).expect(pointer)));
}

fn edit_side(folder: &TempDir, side: &str, name: &str, change: impl Fn(&mut Value)) {
    let path = folder.path().join(side).join(name).join("report.json");
    let read = fs::read_to_string(&path).expect("readable");
    let mut report = serde_json::from_str(&read).expect("JSON");
    change(&mut report);
    fs::write(path, serde_json::to_string_pretty(&report).expect("JSON")).expect("written");
}

fn scaled(factor: f64) -> impl Fn(&mut Value) {
    move |value| *value = json!(value.as_f64().expect("a number") * factor)
}

/// The only report of a difference in JSON.
fn only_report(folder: &TempDir, code: i32) -> Value {
    let printed = diff(folder.path(), &["old", "new", "--format", "json"], code);
    let document: Value = serde_json::from_str(&printed).expect("JSON");
    assert_eq!(document["format"], "vinesink/diff@1");
    assert_eq!(document["reports"].as_array().map(Vec::len), Some(1), "{printed}");
    document["reports"][0].clone()
}

fn only_report_is_none(folder: &TempDir) {
    let printed = diff(folder.path(), &["old", "new"], 0);
    assert_eq!(printed, "No change: 1 report is the same within their errors.\n");
}

#[test]
fn equal_reports_are_one_line() {
    let folder = two_trees(&[STEADY, CHAOTIC]);
    let same = "No change: 2 reports are the same within their errors.\n";
    assert_eq!(diff(folder.path(), &["old", "new"], 0), same);
    let one = "No change: 1 report is the same within their errors.\n";
    let (old, new) = (format!("old/{STEADY}"), format!("new/{STEADY}/report.json"));
    assert_eq!(diff(folder.path(), &[&old, &new], 0), one);
}

/// What is known to rounding may round, what is simulated may move within its error; a little more is
/// a change. Factors are from the errors in the reports: z = 1.45 ± 0.081 on either side.
#[test]
fn numbers_may_move_within_what_they_are_known_to() {
    let orbit = "/data/analysis/orbits/1/peak_displacement";
    let main = "/data/attractors/0";
    let (z, rms) = (format!("{main}/impacts_per_period"), format!("{main}/displacement/rms"));
    let power = format!("{main}/energetics/input_power");
    let cases: [(&str, &str, f64, &str, bool); 13] = [
        (STEADY, orbit, 1.0 + 1e-10, "rounding", false),
        (STEADY, orbit, 1.0 + 1e-8, "rounding", true),
        (STEADY, "/data/bare_amplitude", 1.0 - 1e-8, "rounding", true),
        (STEADY, &rms, 1.0 + 1e-7, "repetition", false),
        (STEADY, &rms, 1.0 + 1e-5, "repetition", true),
        (STEADY, "/data/analysis/exact_boundaries/0/clearance", 1.0 + 1e-7, "bracket", true),
        (STEADY, "/data/analysis/fixed_points/0/residual", 100.0, "residual", false),
        (CHAOTIC, &z, 1.0 + 0.40 / 1.29, "two-standard-errors", false),
        (CHAOTIC, &z, 1.0 + 0.60 / 1.29, "two-standard-errors", true),
        (CHAOTIC, &rms, 1.07, "two-standard-errors", false),
        (CHAOTIC, &rms, 1.1, "two-standard-errors", true),
        // Averages that are known well.
        ("li2016-8p5hz-fig4a", &power, 1.05, "other-errors", false),
        ("li2016-8p5hz-fig4a", &power, 1.1, "other-errors", true),
    ];
    for (name, pointer, factor, basis, beyond) in cases {
        let folder = two_trees(&[name]);
        edit(&folder, name, pointer, scaled(factor));
        let report = only_report(&folder, i32::from(beyond));
        let (numbers, within) = (&report["numbers"], &report["folded"]["within"]);
        let (there, other) = if beyond { (numbers, within) } else { (within, numbers) };
        assert_eq!(other, &json!([]), "{pointer} × {factor}");
        assert_eq!(there.as_array().map(Vec::len), Some(1), "{pointer} × {factor}: {report:#}");
        assert_eq!(there[0]["basis"], basis, "{pointer}");
    }
}

#[test]
fn a_verdict_a_number_an_input_and_a_figure_are_seen_first() {
    let folder = two_trees(&[STEADY, CHAOTIC]);
    edit(&folder, STEADY, "/data/claims/1/verdict", |verdict| *verdict = json!("refuted"));
    edit(&folder, STEADY, "/verdict/tone", |tone| *tone = json!("bad"));
    edit(&folder, STEADY, "/data/attractors/0/displacement/peak", scaled(1.1));
    edit(&folder, STEADY, "/data/analysis/orbits/1/stable", |stable| *stable = json!(false));
    edit(&folder, STEADY, "/tables/inputs/rows/0/2", |value| *value = json!("4.2 kg"));
    let figure = folder.path().join("new").join(STEADY).join("figures/map.svg");
    fs::write(&figure, "<svg/>").expect("written");
    let printed = diff(folder.path(), &["old", "new"], 1);
    let counts =
        "\n\n1 input, 2 verdicts, 1 state, 1 number, 1 figure. 1 report is the same. Old: `old`";
    assert!(
        printed.starts_with("## 1 of 2 reports changed") && printed.contains(counts),
        "{printed}"
    );
    for row in [
        "| Oscillator mass | 4.168 kg | 4.2 kg |",
        "\n>\n> Before: Steady 1:1 resonance: the absorber works.",
        "| amplitude C at fixed point 1 | confirmed | refuted | |",
        "| motion two-symmetric: peak of x | 3.587 mm | 3.945 mm | +10 % |",
        "| exact orbit 2: stable | yes | no |",
        "<img src=\"old/li2016-8p5hz-fig4c/figures/map.svg\"",
        "<img src=\"new/li2016-8p5hz-fig4c/figures/map.svg\"",
    ] {
        assert!(printed.contains(row), "{row} is missing in\n{printed}");
    }
    let at = |wanted: &str| printed.find(wanted).unwrap_or_else(|| panic!("{wanted}\n{printed}"));
    let order =
        ["| Input |", "| Key number |", "<details>", "Everything else: 1 state", "| State |"];
    assert!(order.map(at).is_sorted(), "{printed}");
    let url = "https://forge/raw/abc/reports";
    let addressed = diff(folder.path(), &["old", "new", "--old-url", url], 1);
    assert!(addressed.contains(&format!("{url}/{STEADY}/figures/map.svg")), "{addressed}");
}

/// Each kind of change alone is one that a script must see.
#[test]
fn every_kind_of_change_fails() {
    let changes: [(&str, &str, Value); 6] = [
        ("verdicts", "/verdict/tone", json!("bad")),
        ("verdicts", "/data/claims/1/verdict", json!("undecided")),
        ("states", "/data/analysis/orbits/1/stable", json!(false)),
        ("states", "/data/analysis/area", json!("Z4")),
        ("inputs", "/provenance/effort/starts", json!(64)),
        ("numbers", "/data/analysis/manifold/fold/C", json!(0.2)),
    ];
    for (kind, pointer, value) in changes {
        let folder = two_trees(&[STEADY]);
        edit(&folder, STEADY, pointer, |there| *there = value.clone());
        let report = only_report(&folder, 1);
        for list in ["verdicts", "criteria", "states", "inputs", "numbers"] {
            let count = report[list].as_array().map(Vec::len);
            assert_eq!(count, Some(usize::from(list == kind)), "{pointer}: {list}");
        }
    }
    let folder = two_trees(&[STEADY]);
    let note = |kind: &str| json!([{"kind": kind, "text": "ratio 0.2"}]);
    edit(&folder, STEADY, "/notes", |notes| *notes = note("validity"));
    assert_eq!(only_report(&folder, 1)["states"][0]["what"], "note");
    edit_side(&folder, "old", STEADY, |report| {
        report["notes"] = json!([{"kind": "validity", "text": "ratio 0.1"}])
    });
    only_report_is_none(&folder);
    edit_side(&folder, "old", STEADY, |report| report["notes"] = json!([]));
    // The claim itself says that it is refuted.
    edit(&folder, STEADY, "/notes", |notes| *notes = note("refuted"));
    only_report_is_none(&folder);
    // Explanations and what is about the run alone fail nothing.
    let folder = two_trees(&[STEADY]);
    edit(&folder, STEADY, "/data/claims/1/tolerance/reason", |reason| *reason = json!("other"));
    edit(&folder, STEADY, "/data/attractors/0/periods", |periods| *periods = json!(999));
    edit(&folder, STEADY, "/data", |data| data["another_version"] = json!(3.0));
    let turn = std::f64::consts::TAU;
    let phase = "/data/analysis/orbits/1/phase";
    edit(&folder, STEADY, phase, |phase| *phase = json!(phase.as_f64().expect("a phase") - turn));
    let folded = only_report(&folder, 0)["folded"].clone();
    assert_eq!(folded["wording"].as_array().map(Vec::len), Some(1), "{folded:#}");
    assert_eq!((&folded["unjudged"], &folded["unknown"]), (&json!(1), &json!(1)));
    assert_eq!(folded["within"][0]["path"], "analysis/orbits[2]/phase");
}

/// A motion that one start in 32 found may be missed by the next 32; one that half of them found, not.
#[test]
fn a_motion_that_chance_may_have_missed_is_no_change() {
    let intervals = [(1, [0.0055, 0.157], 0), (16, [0.336, 0.664], 1)];
    for (starts, interval, code) in intervals {
        let folder = two_trees(&[STEADY]);
        edit(&folder, STEADY, "/data/attractors", |list| {
            let mut motion = list[1].clone();
            motion["regime"] = json!("above-two");
            motion["starts"] = json!(starts);
            motion["share_of_starts"] = json!(f64::from(starts) / 32.0);
            motion["share_interval_95"] = json!(interval);
            list.as_array_mut().expect("a list").push(motion);
        });
        let report = only_report(&folder, code);
        let found = if code == 0 { &report["folded"]["wording"] } else { &report["states"] };
        assert_eq!(found[0]["what"], "motion above-two", "{starts}");
    }
}

/// Another main motion: what it vibrates by is told although the two motions are not the same one.
#[test]
fn another_main_motion_is_compared_with_the_old_one() {
    let [old, new] = [CHAOTIC, STEADY].map(|name| shipped(name).display().to_string());
    let printed = diff(Path::new("."), &[&old, &new], 1);
    for row in [
        "\n> Steady 1:1 resonance: the absorber works.",
        "| main motion | strongly-modulated | two-symmetric | |",
        "| motion main: peak of x | 7.993 mm | 3.587 mm | −55 % |",
        "| Absorber clearance | 28 mm | 20 mm |",
        "Everything else: ",
    ] {
        assert!(printed.contains(row), "{row} is missing in\n{printed}");
    }
}

/// The same sentence about another number is no other verdict; other words are one.
#[test]
fn a_headline_is_compared_by_its_words() {
    let folder = two_trees(&[CHAOTIC]);
    let headline = "/verdict/headline";
    edit(&folder, CHAOTIC, headline, |text| {
        *text = json!(text.as_str().expect("text").replace("7.92 mm", "7.95 mm"));
    });
    only_report_is_none(&folder);
    edit(&folder, CHAOTIC, headline, |text| {
        *text = json!(text.as_str().expect("text").replace("Strongly modulated", "Steady"));
    });
    assert_eq!(only_report(&folder, 1)["verdicts"][0]["what"], "verdict");
}

#[test]
fn figures_alone_are_shown_and_do_not_fail() {
    let folder = two_trees(&[STEADY]);
    let figures = folder.path().join("new").join(STEADY).join("figures");
    fs::write(figures.join("map.svg"), "<svg/>").expect("written");
    fs::remove_file(figures.join("sim.svg")).expect("removed");
    let printed = diff(folder.path(), &["old", "new"], 0);
    assert!(printed.contains("2 figures in 1 report without any other change"), "{printed}");
    assert!(printed.contains("figures/sim.svg\" width=\"400\""), "{printed}");
    assert!(printed.contains(" | – |"), "a figure that is gone has no new side: {printed}");
}

#[test]
fn motions_and_reports_that_appear_or_vanish_are_told() {
    let folder = two_trees(&[STEADY]);
    edit(&folder, STEADY, "/data/attractors", |list| {
        list.as_array_mut().expect("a list").remove(0);
    });
    copy(&shipped(CHAOTIC), &folder.path().join("new/fresh"));
    copy(&shipped(CHAOTIC), &folder.path().join("old/gone"));
    let printed = diff(folder.path(), &["old", "new"], 1);
    assert!(printed.contains("| motion two-symmetric | there | – |"), "{printed}");
    assert!(printed.contains("### Reports added\n\n- **fresh**: Strongly modulated"), "{printed}");
    assert!(printed.contains("### Reports removed\n\n- **gone**: Strongly"), "{printed}");
    // Its numbers are not told one by one.
    assert!(!printed.contains("spectral"), "{printed}");
}

/// A criterion as a case with criteria will have it.
fn criterion(name: &str, asked: &str, found: f64, error: Value, holds: Value) -> Value {
    let error = error.as_f64().map(|error| 1e-3 * error);
    json!({"name": name, "asked": asked, "found": 1e-3 * found, "unit": "m", "error": error,
        "margin": 0.0, "holds": holds, "near_limit": false, "decided_by": "exact-orbit"})
}

#[test]
fn criteria_that_flip_come_first() {
    let folder = two_trees(&[STEADY]);
    let criteria = |side: &str, list: Vec<Value>| {
        edit_side(&folder, side, STEADY, |report| report["criteria"] = json!(list));
    };
    let none = || Value::Null;
    let old = [
        criterion("moved", "<= 4", 3.0, json!(0.1), json!(true)),
        criterion("within", "<= 4", 3.0, json!(0.1), json!(true)),
        criterion("exact", "<= 4", 3.0, none(), json!(true)),
        criterion("asked", "<= 4", 3.0, none(), json!(true)),
        criterion("flipped", "<= 4", 3.9, none(), json!(true)),
        criterion("undecided", "<= 4", 3.9, json!(0.5), json!(true)),
        criterion("gone", "<= 4", 3.9, none(), json!(true)),
    ];
    let new = [
        criterion("moved", "<= 4", 3.3, json!(0.1), json!(true)),
        criterion("within", "<= 4", 3.15, json!(0.1), json!(true)),
        criterion("exact", "<= 4", 3.0 + 1e-12, none(), json!(true)),
        criterion("asked", "<= 5", 3.0, none(), json!(true)),
        criterion("flipped", "<= 4", 4.1, none(), json!(false)),
        criterion("undecided", "<= 4", 3.9, json!(0.5), none()),
        criterion("new", "<= 4", 3.9, none(), json!(true)),
    ];
    criteria("old", old.to_vec());
    criteria("new", old.to_vec());
    assert_eq!(
        diff(folder.path(), &["old", "new"], 0),
        "No change: 1 report is the same within their errors.\n"
    );
    criteria("new", new.to_vec());
    let report = only_report(&folder, 1);
    let names: Vec<&str> = report["criteria"]
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(|c| c["name"].as_str())
        .collect();
    assert_eq!(names, ["flipped", "undecided", "moved", "asked", "new", "gone"]);
    let printed = diff(folder.path(), &["old", "new"], 1);
    for row in [
        "2 flipped criteria, 4 other criteria",
        "| flipped ≤ 4 | holds (3.900 mm) | fails (4.100 mm) | **flipped** |",
        "| undecided ≤ 4 | holds (3.900 mm) | could not be measured (3.900 mm) | **flipped** |",
        "| asked ≤ 4, now ≤ 5 | holds (3.000 mm) | holds (3.000 mm) | |",
        "| gone ≤ 4 | holds (3.900 mm) | – | |",
    ] {
        assert!(printed.contains(row), "{row}\n{printed}");
    }
}

/// The table says what the reports say of the same criteria, and where that would be the same twice, it
/// has more digits.
#[test]
fn criteria_are_called_as_in_the_report() {
    const BAND: &str = "li2016-band";
    let folder = two_trees(&[BAND]);
    let change = |side: &str, name: &str, found: f64, holds: bool| {
        edit_side(&folder, side, BAND, |report| {
            let list = report["criteria"].as_array_mut().expect("a list");
            let criterion = list.iter_mut().find(|one| one["name"] == name).expect(name);
            criterion["found"] = json!(found);
            criterion["error"] = json!(0.0);
            criterion["holds"] = json!(holds);
            criterion["near_limit"] = json!(!holds);
        });
    };
    change("new", "z3_share", 0.95, true);
    change("old", "stable_share", 0.749_99, false);
    change("new", "stable_share", 0.750_01, true);
    change("new", "peak_displacement", 0.0165, false);
    for side in ["old", "new"] {
        edit_side(&folder, side, BAND, |report| {
            report["criteria"].as_array_mut().expect("a list").push(json!({
                "name": "no_coexistence", "asked": "true", "unit": "1", "error": 0.0,
                "found": u8::from(side == "old"), "holds": side == "old", "near_limit": false,
            }));
        });
    }
    let printed = diff(folder.path(), &["old", "new"], 1);
    for row in [
        "| share of the band in area Z3 ≥ 85 % | fails (72.8 %) | holds (95.0 %) | **flipped** |",
        "| share of the band with a stable 1:1 orbit ≥ 75 % | too close to call (74.999 %) | holds (75.001 %) | **flipped** |",
        "| peak displacement ≤ 16 mm | holds (14.46 mm) | too close to call (16.50 mm) | **flipped** |",
        "| no other motion beside true | holds (true) | fails (false) | **flipped** |",
    ] {
        assert!(printed.contains(row), "{row}\n{printed}");
    }
    let report = fs::read_to_string(shipped(BAND).join("report.md")).expect("a report");
    assert!(
        report.contains("| share of the band in area Z3 | ✗ fails | ≥ 85.0 % | 72.8 % |"),
        "{report}"
    );
}

/// GitHub refuses longer comments.
#[test]
fn the_longest_difference_fits_in_a_comment() {
    const REPORTS: usize = 150;
    let folder = tempfile::tempdir().expect("a folder");
    for index in 0..REPORTS {
        for side in ["old", "new"] {
            let report = folder.path().join(side).join(format!("case-{index:03}"));
            fs::create_dir_all(&report).expect("a folder");
            fs::copy(shipped(CHAOTIC).join("report.json"), report.join("report.json"))
                .expect("copied");
        }
        edit_side(&folder, "new", &format!("case-{index:03}"), |report| {
            for list in ["fixed_points", "orbits"] {
                for point in report["data"]["analysis"][list].as_array_mut().expect("a list") {
                    for (_, value) in point.as_object_mut().expect("an object") {
                        if let Some(number) = value.as_f64() {
                            *value = json!(1.5 * number + 1.0);
                        }
                    }
                }
            }
        });
    }
    let printed = diff(folder.path(), &["old", "new"], 1);
    let length = printed.chars().count();
    assert!(length > 50_000 && length <= 60_000, "{length} characters");
    let notice = printed.lines().last().expect("a line");
    assert!(
        notice.starts_with("_Cut here: ") && notice.contains("sections are left out"),
        "{notice}"
    );
    // Cut between sections: no table and no folded part stays open.
    assert_eq!(printed.matches("<details>").count(), printed.matches("</details>").count());
    assert!(printed.starts_with("## 150 of 150 reports changed"));
}

#[test]
fn what_cannot_be_compared_says_why() {
    let folder = two_trees(&[STEADY, CHAOTIC]);
    let path = folder.path();
    let missing = refused(path, &["nowhere", "new"]);
    assert!(missing.contains("`nowhere`") && missing.contains("check the path"), "{missing}");
    fs::create_dir(path.join("empty")).expect("a folder");
    let empty = refused(path, &["empty", "empty"]);
    assert!(empty.contains("no report.json in `empty`"), "{empty}");
    let mixed = refused(path, &[&format!("old/{STEADY}"), "new"]);
    assert!(mixed.contains("is one report, `new` is a folder of 2"), "{mixed}");
    let file = path.join("new").join(STEADY).join("report.json");
    fs::write(&file, "{\"format\":\n<<<<<<< HEAD").expect("written");
    let broken = refused(path, &["old", "new"]);
    assert!(broken.contains("report.json is not JSON") && broken.contains("line 2"), "{broken}");
    fs::write(&file, "{\"format\": \"vinesink/report@9\"}").expect("written");
    let newer = refused(path, &["old", "new"]);
    assert!(newer.contains("`vinesink/report@9`"), "{newer}");
    fs::write(&file, b"{\"format\": \"\xff\"}").expect("written");
    let binary = refused(path, &["old", "new"]);
    assert!(binary.contains("not UTF-8"), "{binary}");
    // A report without any content is a poor one, not a crash.
    fs::write(&file, "{\"format\": \"vinesink/report@1\"}").expect("written");
    diff(path, &["old", "new"], 1);
}

#[test]
fn one_side_without_reports_makes_all_of_the_other_new() {
    let folder = two_trees(&[STEADY]);
    fs::create_dir(folder.path().join("empty")).expect("a folder");
    let printed = diff(folder.path(), &["empty", "new"], 1);
    assert!(printed.contains("1 report added") && printed.contains(STEADY), "{printed}");
}

/// A case with a band and criteria that takes a moment.
const BAND: &str = r#"
title = "Beam"
source = "made up"

[oscillator]
mass = "1200 kg"
frequency = "2.1 Hz"
damping_ratio = "0.4 %"

[absorber]
mass_ratio = "1.5 %"
clearance = "50 mm"
restitution = 0.6

[excitation]
kind = "force"
amplitude = "250 N"
frequency = "2.1 Hz"

[band]
from = "1.9 Hz"
to = "2.3 Hz"

[criteria]
peak_displacement = "<= 8 mm"
stable_share = ">= 75 %"
impact_velocity = "<= 1.5 m/s"
reduction_db_tmd = ">= -3 dB"
"#;

/// Writes `cases/beam.toml` and, into `reports`, its report.
fn beam(folder: &Path, clearance: &str, reports: &str) {
    fs::create_dir_all(folder.join("cases")).expect("a folder");
    let case = BAND.replace("50 mm", clearance);
    fs::write(folder.join("cases/beam.toml"), case).expect("written");
    let output = vinesink(folder, &["report", "cases/beam.toml", "--out", reports]);
    assert!(output.status.success(), "{}", text(&output.stderr));
}

/// One changed number, with all that follows from it: forty lines are read, the rest is folded.
#[test]
fn one_changed_clearance_is_read_in_forty_lines() {
    let folder = tempfile::tempdir().expect("a folder");
    beam(folder.path(), "50 mm", "old");
    beam(folder.path(), "60 mm", "reports");
    let printed = diff(folder.path(), &["old", "reports"], 1);
    let (read, folded) = printed.split_once("<details>").expect("a fold");
    assert!(read.lines().count() <= 40, "{} lines\n{read}", read.lines().count());
    let at = |wanted: &str| read.find(wanted).unwrap_or_else(|| panic!("{wanted}\n{read}"));
    let order = [
        "| Absorber clearance | 50 mm | 60 mm |",
        "| peak displacement ≤ 8 mm | fails (",
        "| main motion |",
        "| motion main: peak of x |",
    ];
    assert!(order.map(at).is_sorted(), "{read}");
    let key = read.split("| Key number |").nth(1).expect("key numbers");
    assert_eq!(key.lines().filter(|line| line.starts_with("| ")).count(), 1 + 8, "{key}");
    assert!(folded.contains("<summary>Everything else: ") && folded.contains("values the same"));
    // An absorber changes nothing of a structure without it: what rounding moved there is not told.
    assert!(!printed.contains("without absorber |") && !printed.contains("e−"), "{printed}");
    assert!(!printed.contains("Out of date"), "the old one is an earlier version: {printed}");
}

/// Numbers that differ in their last digits, in every shipped report.
#[test]
fn rounding_never_appears() {
    fn round(value: &mut Value, count: &mut usize) {
        match value {
            Value::Object(fields) => fields.values_mut().for_each(|field| round(field, count)),
            Value::Array(items) => items.iter_mut().for_each(|item| round(item, count)),
            Value::Number(number) if number.is_f64() => {
                *count += 1;
                let sign = if count.is_multiple_of(2) { 1.0 } else { -1.0 };
                *value = json!(value.as_f64().expect("a number") * (1.0 + sign * 1e-13));
            }
            _ => {}
        }
    }
    let names: Vec<String> = fs::read_dir(shipped(""))
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.join("report.json").is_file())
        .map(|path| path.file_name().expect("a name").to_string_lossy().into_owned())
        .collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let folder = two_trees(&names);
    for name in &names {
        let mut count = 0;
        let path = folder.path().join("new").join(name).join("report.json");
        let read = fs::read_to_string(&path).expect("readable");
        let mut report: Value = serde_json::from_str(&read).expect("JSON");
        round(&mut report["data"], &mut count);
        round(&mut report["criteria"], &mut count);
        assert!(count > 100, "{name}: {count} numbers");
        fs::write(path, report.to_string()).expect("written");
    }
    let same = format!("No change: {} reports are the same within their errors.\n", names.len());
    assert_eq!(diff(folder.path(), &["old", "new"], 0), same);
}

/// A case that was edited after its report: the report is named, and what to do.
#[test]
fn a_report_of_another_case_text_is_out_of_date() {
    let folder = two_trees(&[STEADY]);
    let (path, file) = (folder.path(), format!("{STEADY}.toml"));
    let hash = |text: &str| vinesink::digest::sha256(text.as_bytes());
    let reported = |side: &str, text: &str| {
        edit_side(&folder, side, STEADY, |report| {
            report["provenance"]["case_sha256"] = json!(hash(text));
        });
    };
    reported("old", "b = 1");
    reported("new", "b = 1");
    fs::create_dir(path.join("cases")).expect("a folder");
    let case = path.join("cases").join(&file);
    fs::write(&case, "b = 1").expect("written");
    diff(path, &["old", "new"], 0);
    fs::write(&case, "b = 2").expect("written");
    let told = |arguments: &[&str]| {
        let printed = diff(path, arguments, 1);
        let head = "## 1 report out of date\n\n1 report is the same. ";
        assert!(printed.starts_with(head), "{printed}");
        printed
    };
    let [old, new] = ["old", "new"].map(|side| format!("{side}/{STEADY}"));
    let files = [&old, &new].map(|report| format!("{report}/report.json"));
    for arguments in [["old", "new"], [&old, &new], [&files[0], &files[1]]] {
        let printed = told(&arguments);
        let [was, is] = [hash("b = 1"), hash("b = 2")];
        let line = format!(
            "\n**Out of date**\n\n- `{new}/report.json` was made from another text of `cases/{file}` (SHA-256 {}…, the file has {}…): run `vinesink report cases/{file} --out new`.\n",
            &was[..8],
            &is[..8]
        );
        assert!(printed.contains(&line), "{line}{printed}");
    }
    let printed = diff(path, &["old", "new", "--format", "json"], 1);
    let json: Value = serde_json::from_str(&printed).expect("JSON");
    assert_eq!(json["stale"].as_array().map(Vec::len), Some(1), "{json:#}");
    let (stale, current) = (&json["stale"][0], json!(hash("b = 2")));
    assert_eq!((&stale["reason"], &stale["current"]), (&json!("case-text"), &current));
    // From elsewhere the case is found beside its report.
    fs::create_dir(path.join("elsewhere")).expect("a folder");
    diff(&path.join("elsewhere"), &["../old", "../new"], 1);
    // Cases in a folder of another name, and where no report's case is.
    fs::rename(path.join("cases"), path.join("designs")).expect("renamed");
    diff(path, &["old", "new"], 0);
    let named = told(&["old", "new", "--cases", "designs"]);
    assert!(named.contains(&format!("`designs/{file}`")), "{named}");
    let none = refused(path, &["old", "new", "--cases", "nowhere"]);
    assert!(none.contains("`nowhere` has the case of none of these reports"), "{none}");
    // The old one is an earlier version of the design, unless it has a case of its own.
    reported("new", "b = 2");
    diff(path, &["old", "new", "--cases", "designs"], 0);
    fs::create_dir(path.join("old/cases")).expect("a folder");
    fs::copy(path.join("designs").join(&file), path.join("old/cases").join(&file)).expect("copied");
    fs::rename(path.join("designs"), path.join("cases")).expect("renamed");
    assert!(told(&["old", "new"]).contains(&format!("of `old/cases/{file}`")));
}

#[test]
fn a_report_of_another_version_is_out_of_date() {
    let folder = two_trees(&[STEADY, CHAOTIC]);
    for name in [STEADY, CHAOTIC] {
        edit_side(&folder, "old", name, |report| report["provenance"]["version"] = json!("0.0.7"));
    }
    let printed = diff(folder.path(), &["old", "new"], 1);
    let (line, this) = (
        format!(
            "- `old/{STEADY}/report.json` and 1 other of the old side: written by version 0.0.7, this is "
        ),
        env!("CARGO_PKG_VERSION"),
    );
    let command = format!(
        "{line}{this}: run `vinesink report cases/{STEADY}.toml --out old`, and the same for the others.\n"
    );
    assert!(printed.contains(&command), "{printed}");
    assert!(
        printed.starts_with("## 2 reports out of date\n\n2 reports are the same. "),
        "{printed}"
    );
}
