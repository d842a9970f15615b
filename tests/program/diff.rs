//! `vinesink diff` as a reviewer and a script use it: reports of shipped cases against copies with one thing
//! changed. The truth is the change that was made.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

use regex::Regex;
use serde_json::{Value, json};
use tempfile::TempDir;
use vinesink::diff::markdown::markdown;
use vinesink::diff::{Difference, Document, Reports};

use crate::common::{BAND, BRIDGE};

/// A motion that repeats, one that is chaotic.
const STEADY: &str = "li2016-8p5hz-fig4c";
const CHAOTIC: &str = "li2016-8p5hz-fig4d";

/// One that is chaotic and hardly modulated: its averages are known well.
const WELL_KNOWN: &str = "li2016-8p5hz-fig4a";
/// A line of a case that makes its report quick.
const FEWER: &str = "\n[simulation]\nstarts = 4\n";

/// The report of a shipped case; all are written once.
fn shipped(name: &str) -> PathBuf {
    static REPORTS: OnceLock<TempDir> = OnceLock::new();
    let folder = REPORTS.get_or_init(|| {
        let folder = tempfile::tempdir().expect("a folder");
        for name in [STEADY, CHAOTIC, WELL_KNOWN] {
            let file = format!("{name}.toml");
            let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(&file);
            let case = fs::read_to_string(case).expect("a case") + FEWER;
            fs::write(folder.path().join(&file), case).expect("written");
            let output = vinesink(folder.path(), &["report", &file, "--out", "."]);
            assert!(output.status.success(), "{}", text(&output.stderr));
            fs::remove_file(folder.path().join(&file)).expect("removed");
        }
        folder
    });
    folder.path().join(name)
}

fn vinesink(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_vinesink"));
    command.env("VINESINK_PROGRESS_SECONDS", "1000000");
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
    assert_eq!(document["format"], "vinesink/diff@2");
    assert_eq!(document["reports"].as_array().map(Vec::len), Some(1), "{printed}");
    document["reports"][0].clone()
}

/// What is said where no case is found.
const NO_CASE: &str =
    "Checked against their cases: none, because no case was found; `--cases` names their folder.";

/// The answer where nothing changed, of so many reports whose cases are not there.
fn no_change(reports: &str) -> String {
    format!("No change: {reports} the same within their errors.\n{NO_CASE}\n")
}

fn only_report_is_none(folder: &TempDir) {
    let printed = diff(folder.path(), &["old", "new"], 0);
    assert_eq!(printed, no_change("1 report is"));
}

#[test]
fn equal_reports_are_one_line() {
    let folder = two_trees(&[STEADY, CHAOTIC]);
    assert_eq!(diff(folder.path(), &["old", "new"], 0), no_change("2 reports are"));
    let one = no_change("1 report is");
    let (old, new) = (format!("old/{STEADY}"), format!("new/{STEADY}/report.json"));
    assert_eq!(diff(folder.path(), &[&old, &new], 0), one);
}

/// What is known to rounding may round, what is simulated may move within the errors of both sides; a little
/// more is a change.
#[test]
fn numbers_may_move_within_what_they_are_known_to() {
    let main = "/motions/0";
    let at = |field: &str| format!("{main}/{field}/value");
    let cases: [(&str, &str, f64, bool); 9] = [
        (STEADY, "/theory/orbits/1/peak/value", 1.0 + 1e-10, false),
        (STEADY, "/theory/orbits/1/peak/value", 1.0 + 1e-8, true),
        (STEADY, "/quantities/bare_peak/value", 1.0 - 1e-8, true),
        (STEADY, "/theory/boundaries/2/exact/value", 1.0 + 1e-7, true),
        (STEADY, &at("rms"), 1.0 + 1e-10, false),
        (STEADY, &at("rms"), 1.0 + 1e-8, true),
        // Averages that are known well.
        (WELL_KNOWN, &at("energy/work"), 1.05, false),
        (WELL_KNOWN, &at("energy/work"), 1.1, true),
        (WELL_KNOWN, &at("rms"), 1.001, true),
    ];
    for (name, pointer, factor, beyond) in cases {
        let folder = two_trees(&[name]);
        edit(&folder, name, pointer, scaled(factor));
        counts_one(&folder, beyond, &format!("{pointer} × {factor}"));
    }
    for (field, share, beyond) in [
        ("rms", 1.9, false),
        ("rms", 2.1, true),
        ("impacts_per_period", 1.9, false),
        ("peak", 2.1, true),
    ] {
        let folder = two_trees(&[CHAOTIC]);
        edit(&folder, CHAOTIC, &format!("{main}/{field}"), |quantity| {
            let [value, error] = ["value", "error"].map(|key| quantity[key].as_f64().expect(key));
            assert!(error > 1e-3 * value, "{field}: {quantity}");
            quantity["value"] = json!(value + share * error);
        });
        counts_one(&folder, beyond, &format!("{field} by {share} errors"));
    }
}

/// One number is beyond its error, or within it.
#[track_caller]
fn counts_one(folder: &TempDir, beyond: bool, what: &str) {
    let report = only_report(folder, i32::from(beyond));
    assert_eq!(report["numbers"].as_array().map(Vec::len), Some(usize::from(beyond)), "{what}");
    assert_eq!(report["folded"]["within"], usize::from(!beyond), "{what}: {report:#}");
}

#[test]
fn a_verdict_a_number_an_input_and_a_figure_are_seen_first() {
    let folder = two_trees(&[STEADY, CHAOTIC]);
    edit(&folder, STEADY, "/claims/1/verdict", |verdict| *verdict = json!("refuted"));
    edit(&folder, STEADY, "/verdict/word", |word| *word = json!("works"));
    for peak in ["/quantities/peak_displacement/value", "/motions/0/peak/value"] {
        edit(&folder, STEADY, peak, scaled(1.1));
    }
    edit(&folder, STEADY, "/theory/orbits/1/stable", |stable| *stable = json!(false));
    edit(&folder, STEADY, "/inputs/0/as_written", |value| *value = json!("4.2 kg"));
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
        "> Works: less vibration than without absorber.\n>\n> Before: Mixed: less vibration",
        "| Amplitude C at fixed point 1 | confirmed | refuted | |",
        "| Peak displacement | 3.587 mm | 3.945 mm | +10 % |",
        "| Exact orbit 2 stable | yes | no |",
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
    let changes = [
        ("verdict", "/verdict/word", json!("works")),
        ("verdict", "/verdict/headline", json!("little")),
        ("claims", "/claims/1/verdict", json!("undecided")),
        ("states", "/theory/orbits/1/stable", json!(false)),
        ("states", "/theory/area", json!("Z4")),
        ("states", "/claims/1/reason", json!("another reason")),
        ("states", "/figures/0/caption", json!("Another sentence.")),
        ("states", "/theory/orbits/1/peak/method", json!("simulation")),
        ("numbers", "/theory/orbits/1/peak/error", json!(0.5)),
        ("numbers", "/quantities/mass_ratio/value", json!(0.5)),
        ("inputs", "/provenance/effort/starts", json!(64)),
        ("numbers", "/theory/fixed_points/0/eta/value", json!(0.2)),
    ];
    for (kind, pointer, value) in changes {
        let folder = two_trees(&[STEADY]);
        edit(&folder, STEADY, pointer, |there| *there = value.clone());
        let report = only_report(&folder, 1);
        assert_eq!(report["verdict"], kind == "verdict", "{pointer}");
        for list in ["claims", "criteria", "states", "inputs", "numbers"] {
            let count = report[list].as_array().map(Vec::len);
            assert_eq!(count, Some(usize::from(list == kind)), "{pointer}: {list}");
        }
    }
    let folder = two_trees(&[STEADY]);
    let limit = |name: &str, value: f64| {
        json!([{"kind": "limit", "limit": name, "value": {
        "id": "offset", "value": value, "error": 0.0, "method": "given"}}])
    };
    edit(&folder, STEADY, "/notes", |notes| *notes = limit("offset", 0.2));
    assert_eq!(only_report(&folder, 1)["states"][0]["what"], "note");
    edit_side(&folder, "old", STEADY, |report| report["notes"] = limit("offset", 0.1));
    only_report_is_none(&folder);
    edit_side(&folder, "old", STEADY, |report| report["notes"] = json!([]));
    // The claim itself says that it is refuted.
    edit(&folder, STEADY, "/notes", |notes| *notes = json!([{"kind": "refuted", "claim": 1}]));
    only_report_is_none(&folder);
    // A field that one of the two has is a change, unless they are of different versions, of which one is stale anyway.
    let folder = two_trees(&[STEADY]);
    edit(&folder, STEADY, "/theory", |theory| theory["another"] = json!(3.0));
    let state = only_report(&folder, 1)["states"][0].clone();
    assert_eq!((&state["path"], &state["new"]), (&json!("theory/another"), &json!("there")));
    edit(&folder, STEADY, "/provenance/version", |version| *version = json!("0.0.7"));
    assert_eq!(only_report(&folder, 1)["folded"]["unknown"], 1);
    // Numbers of explanations and what is about the run alone fail nothing.
    let folder = two_trees(&[STEADY]);
    let sentence = "/figures/0/caption";
    edit_side(&folder, "old", STEADY, |report| {
        report["figures"][0]["caption"] = json!("A peak of 1.00 mm.")
    });
    edit(&folder, STEADY, sentence, |caption| *caption = json!("A peak of 1.01 mm."));
    edit(&folder, STEADY, "/motions/0/numerics/periods", |periods| *periods = json!(999));
    edit(&folder, STEADY, "/theory/orbits/1/residual", |residual| *residual = json!(1e-12));
    let turn = std::f64::consts::TAU;
    let phase = "/theory/orbits/1/phase/value";
    edit(&folder, STEADY, phase, |phase| *phase = json!(phase.as_f64().expect("a phase") - turn));
    let folded = only_report(&folder, 0)["folded"].clone();
    for (kind, count) in [("wording", 1), ("unjudged", 2), ("unknown", 0), ("within", 1)] {
        assert_eq!(folded[kind], count, "{kind}: {folded:#}");
    }
}

/// A motion that one start in 32 found may be missed by the next 32; one that half of them found, not.
#[test]
fn a_motion_that_chance_may_have_missed_is_no_change() {
    let intervals = [(1, 0.0055, 0), (16, 0.336, 1)];
    for (starts, low, code) in intervals {
        let folder = two_trees(&[STEADY]);
        for side in ["old", "new"] {
            edit_side(&folder, side, STEADY, |report| {
                report["provenance"]["effort"]["starts"] = json!(32)
            });
        }
        edit(&folder, STEADY, "/motions", |list| {
            let mut motion = list[1].clone();
            motion["regime"] = json!("above-two");
            motion["starts"] = json!(starts);
            motion["reached"]["interval"][0]["value"] = json!(low);
            list.as_array_mut().expect("a list").push(motion);
        });
        let report = only_report(&folder, code);
        assert_eq!(report["folded"]["wording"], 1 - code, "{starts}");
        assert_eq!(report["states"].as_array().map(Vec::len), Some(code as usize), "{starts}");
    }
}

/// Another main motion: what it vibrates by is told although the two motions are not the same one.
#[test]
fn another_main_motion_is_compared_with_the_old_one() {
    let [old, new] = [CHAOTIC, STEADY].map(|name| shipped(name).display().to_string());
    let printed = diff(Path::new("."), &[&old, &new], 1);
    for row in [
        "\n> Mixed: less vibration than without absorber.",
        "| Main motion | strongly modulated response | two symmetric impacts per period | |",
        "| Peak displacement | ",
        " | 3.587 mm | −",
        "| Absorber clearance | 28 mm | 20 mm |",
        "Everything else: ",
    ] {
        assert!(printed.contains(row), "{row} is missing in\n{printed}");
    }
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
    edit(&folder, STEADY, "/motions", |list| {
        list.as_array_mut().expect("a list").remove(0);
    });
    copy(&shipped(CHAOTIC), &folder.path().join("new/fresh"));
    // Of another design, or it would be the same one under a new name.
    copy(
        &Path::new(env!("CARGO_MANIFEST_DIR")).join("reports/footbridge-jump"),
        &folder.path().join("old/gone"),
    );
    let printed = diff(folder.path(), &["old", "new"], 1);
    assert!(printed.contains("| Motion two-symmetric | there | – |"), "{printed}");
    assert!(printed.contains("### Reports added\n\n- **fresh**: Mixed: "), "{printed}");
    assert!(printed.contains("### Reports removed\n\n- **gone**: "), "{printed}");
    // Its numbers are not told one by one.
    assert!(!printed.contains("spectral"), "{printed}");
}

/// A criterion in `report.json`, with lengths in mm.
/// What one side did not look at is one line, however much the other found.
#[test]
fn a_list_that_one_side_has_is_told_as_one() {
    let folder = two_trees(&[STEADY]);
    edit(&folder, STEADY, "/combined", |list| {
        assert_eq!(*list, json!([]), "without criteria nothing is combined");
        *list = (0..9).map(|k| json!({ "outcome": "holds", "of": k })).collect();
    });
    let printed = diff(folder.path(), &["old", "new"], 1);
    assert!(printed.contains("| Combination | – | 9 entries |"), "{printed}");
    assert!(!printed.contains("| Combination 1 |"), "{printed}");
}

fn criterion(name: &str, asked: &str, found: f64, error: f64, outcome: &str) -> Value {
    let holds = match outcome {
        "not-measured" => Value::Null,
        other => json!(other == "holds"),
    };
    json!({"name": name, "asked": asked, "relation": "at-most", "holds": holds, "outcome": outcome,
        "found_flag": null, "found": {"id": "peak_displacement", "value": 1e-3 * found,
            "error": 1e-3 * error, "method": "exact-orbit"}})
}

fn set_criteria(folder: &TempDir, side: &str, list: &[Value]) {
    edit_side(folder, side, STEADY, |report| {
        report["criteria"] = json!({"count": list.len(), "failing": 0, "all": list});
    });
}

#[test]
fn criteria_that_flip_come_first() {
    let folder = two_trees(&[STEADY]);
    let old = [
        criterion("moved", "<= 4", 3.0, 0.1, "holds"),
        criterion("within", "<= 4", 3.0, 0.1, "holds"),
        criterion("exact", "<= 4", 3.0, 0.0, "holds"),
        criterion("asked", "<= 4", 3.0, 0.0, "holds"),
        criterion("flipped", "<= 4", 3.9, 0.0, "holds"),
        criterion("undecided", "<= 4", 3.9, 0.5, "holds"),
        criterion("gone", "<= 4", 3.9, 0.0, "holds"),
    ];
    let new = [
        criterion("moved", "<= 4", 3.3, 0.1, "holds"),
        criterion("within", "<= 4", 3.15, 0.1, "holds"),
        criterion("exact", "<= 4", 3.0 + 1e-12, 0.0, "holds"),
        criterion("asked", "<= 5", 3.0, 0.0, "holds"),
        criterion("flipped", "<= 4", 4.1, 0.0, "fails"),
        criterion("undecided", "<= 4", 3.9, 0.5, "not-measured"),
        criterion("new", "<= 4", 3.9, 0.0, "holds"),
    ];
    set_criteria(&folder, "old", &old);
    set_criteria(&folder, "new", &old);
    only_report_is_none(&folder);
    set_criteria(&folder, "new", &new);
    let report = only_report(&folder, 1);
    let list = report["criteria"].as_array().expect("a list");
    let names: Vec<&str> = list.iter().filter_map(|one| one["name"].as_str()).collect();
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
/// What decides whether the absorber is taken stands before what explains it: worst values, who wins, how far the promise
/// holds; a phase is last.
#[test]
fn what_decides_is_read_before_what_explains() {
    let folder = tempfile::tempdir().expect("a folder");
    let reports = Path::new(env!("CARGO_MANIFEST_DIR")).join("reports");
    for side in ["old", "new"] {
        copy(&reports.join("mast-mode-2"), &folder.path().join(side).join("mast-mode-2"));
    }
    for pointer in [
        "/theory/fixed_points/0/eta/value",
        "/theory/fixed_points/0/oscillator_amplitude/value",
        "/ranges/0/to/value",
        "/alternatives/9/worst/value",
        "/band/worst/peak/value",
    ] {
        // Beyond the error of a worst peak that another motion may exceed.
        edit(&folder, "mast-mode-2", pointer, scaled(2.0));
    }
    edit(&folder, "mast-mode-2", "/choice/winner", |winner| *winner = json!("absorber"));
    let comment = diff(folder.path(), &["old", "new"], 1);
    let at = |wanted: &str| comment.find(wanted).unwrap_or_else(|| panic!("{wanted}\n{comment}"));
    let order = [
        "| Better device | damper | absorber |",
        "| Peak displacement over the band |",
        "| Range of amplitude to: amplitude of the force |",
        "| Damper ±5 % worst: peak displacement with a tuned mass damper |",
        "| Fixed point 1: amplitude of the oscillator |",
        "| Fixed point 1: phase of the oscillator |",
    ];
    assert!(order.map(at).is_sorted(), "{comment}");
}

#[test]
fn criteria_are_called_as_in_the_report() {
    let folder = two_trees(&[STEADY]);
    let share = |name: &str, id: &str, asked: &str, found: f64, outcome: &str| {
        let mut criterion = criterion(name, asked, 1.0, 0.0, outcome);
        criterion["found"]["id"] = json!(id);
        criterion["found"]["value"] = json!(found);
        criterion
    };
    let flag = |found: bool| {
        let mut flag =
            criterion("no_coexistence", "true", 0.0, 0.0, if found { "holds" } else { "fails" });
        flag["found"] = Value::Null;
        flag["found_flag"] = json!(found);
        flag
    };
    let mut close = criterion("peak_displacement", "<= 16 mm", 16.5, 0.0, "too-close-to-call");
    close["holds"] = json!(false);
    let mut closer =
        share("stable_share", "stable_share", ">= 75 %", 0.749_99, "too-close-to-call");
    closer["holds"] = json!(false);
    let old = [
        share("z3_share", "z3_share", ">= 85 %", 0.728, "fails"),
        closer,
        criterion("peak_displacement", "<= 16 mm", 14.46, 0.0, "holds"),
        flag(true),
    ];
    let new = [
        share("z3_share", "z3_share", ">= 85 %", 0.95, "holds"),
        share("stable_share", "stable_share", ">= 75 %", 0.750_01, "holds"),
        close,
        flag(false),
    ];
    set_criteria(&folder, "old", &old);
    set_criteria(&folder, "new", &new);
    let printed = diff(folder.path(), &["old", "new"], 1);
    for row in [
        "| share of the band in area Z3 ≥ 85 % | fails (72.8 %) | holds (95.0 %) | **flipped** |",
        "| share of the band with a stable 1:1 orbit ≥ 75 % | too close to call (74.999 %) | holds (75.001 %) | **flipped** |",
        "| peak displacement ≤ 16 mm | holds (14.46 mm) | too close to call (16.50 mm) | **flipped** |",
        "| no other motion beside true | holds (true) | fails (false) | **flipped** |",
    ] {
        assert!(printed.contains(row), "{row}\n{printed}");
    }
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
                for point in report["theory"][list].as_array_mut().expect("a list") {
                    for (_, quantity) in point.as_object_mut().expect("an object") {
                        if let Some(number) = quantity["value"].as_f64() {
                            quantity["value"] = json!(1.5 * number + 1.0);
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
    fs::write(&file, "{\"format\": \"vinesink/report@2\"}").expect("written");
    diff(path, &["old", "new"], 1);
}

/// The format of before has the same fields but what was asked.
#[test]
fn a_report_of_the_format_before_is_compared() {
    let folder = two_trees(&[STEADY]);
    edit_side(&folder, "old", STEADY, |report| {
        report["format"] = json!("vinesink/report@2");
        report.as_object_mut().expect("a report").remove("asked");
    });
    let printed = diff(folder.path(), &["old", "new"], 0);
    assert!(printed.starts_with("No change: 1 report is the same"), "{printed}");
}

/// Reports of the format before have no errors to compare by: they are named, and what to do.
#[test]
fn a_report_of_the_old_format_is_out_of_date() {
    let folder = two_trees(&[STEADY, CHAOTIC]);
    for name in [STEADY, CHAOTIC] {
        edit_side(&folder, "old", name, |report| {
            *report = json!({"format": "vinesink/report@1", "name": name, "title": "T",
                "verdict": {"tone": "good", "headline": "Steady 1:1 resonance: the absorber works."},
                "provenance": {"version": env!("CARGO_PKG_VERSION")}});
        });
    }
    let printed = diff(folder.path(), &["old", "new"], 1);
    assert!(
        printed.starts_with(&format!(
            "## 2 reports out of date\n\nOld: `old`, new: `new`. {NO_CASE}\n"
        )),
        "{printed}"
    );
    for name in [STEADY, CHAOTIC] {
        let line = format!(
            "- `old/{name}/report.json` has the old format `vinesink/report@1`, without errors to compare by; this version writes `vinesink/answer@2`: run `vinesink report cases/{name}.toml --out old`.\n"
        );
        assert!(printed.contains(&line), "{printed}");
    }
    fs::remove_dir_all(folder.path().join("new").join(CHAOTIC)).expect("removed");
    let removed = diff(folder.path(), &["old", "new"], 1);
    assert!(removed.contains("### Reports removed\n\n- **"), "{removed}");
}

#[test]
fn one_side_without_reports_makes_all_of_the_other_new() {
    let folder = two_trees(&[STEADY]);
    fs::create_dir(folder.path().join("empty")).expect("a folder");
    let printed = diff(folder.path(), &["empty", "new"], 1);
    assert!(printed.contains("1 report added") && printed.contains(STEADY), "{printed}");
}

/// What makes of a footbridge a case with a band and criteria that takes a moment.
const JUDGED: &str = r#"
[simulation]
starts = 2
periods = 50
discard = 100

[criteria]
peak_displacement = "<= 8 mm"
stable_share = ">= 75 %"
impact_velocity = "<= 1.5 m/s"
reduction_db_tmd = ">= -3 dB"
"#;

/// Writes `cases/beam.toml` and, into `reports`, its report.
fn beam(folder: &Path, clearance: &str, reports: &str) {
    fs::create_dir_all(folder.join("cases")).expect("a folder");
    let case = format!("{BRIDGE}{BAND}{JUDGED}").replace("50 mm", clearance);
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
        "| share of the band with a stable 1:1 orbit ≥ 75 % | fails (",
        "| Main motion |",
        "displacement at its own frequency |",
    ];
    assert!(order.map(at).is_sorted(), "{read}");
    let key = read.split("| Key number |").nth(1).expect("key numbers");
    assert_eq!(key.lines().filter(|line| line.starts_with("| ")).count(), 1 + 8, "{key}");
    assert!(folded.contains("<summary>Everything else: ") && folded.contains("values the same"));
    // An absorber changes nothing of a structure without it: what rounding moved there is not told.
    assert!(
        !printed.contains("peak displacement without absorber") && !printed.contains("e−"),
        "{printed}"
    );
    assert!(!printed.contains("Out of date"), "the old one is an earlier version: {printed}");
}

/// Numbers that differ in their last digits, in every part of a report.
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
    let names = [STEADY, CHAOTIC, WELL_KNOWN, "beam"];
    let folder = two_trees(&names[..3]);
    beam(folder.path(), "50 mm", "old");
    copy(&folder.path().join("old/beam"), &folder.path().join("new/beam"));
    // Beside it the others would be reports whose cases are gone.
    fs::remove_dir_all(folder.path().join("cases")).expect("removed");
    for name in &names {
        let mut count = 0;
        let path = folder.path().join("new").join(name).join("report.json");
        let read = fs::read_to_string(&path).expect("readable");
        let mut report: Value = serde_json::from_str(&read).expect("JSON");
        for part in report.as_object_mut().expect("an object").values_mut() {
            round(part, &mut count);
        }
        assert!(count > 100, "{name}: {count} numbers");
        fs::write(path, report.to_string()).expect("written");
    }
    let printed = diff(folder.path(), &["old", "new"], 0);
    let same = format!("No change: {} reports are the same within their errors.\n", names.len());
    assert!(printed.starts_with(&same), "{printed}");
    // It fails on both sides.
    assert!(printed.contains("Failed before too: `beam` (4 of 4 criteria)."), "{printed}");
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
    // Cases in a folder of another name, found or named, and where no report's case is.
    fs::rename(path.join("cases"), path.join("designs")).expect("renamed");
    assert!(told(&["old", "new"]).contains(&format!("of `designs/{file}`")));
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
    for name in [STEADY, CHAOTIC] {
        let line = format!(
            "- `old/{name}/report.json` was written by version 0.0.7, this is {}: run `vinesink report cases/{name}.toml --out old`.\n",
            env!("CARGO_PKG_VERSION")
        );
        assert!(printed.contains(&line), "{line}\n{printed}");
    }
    assert!(
        printed.starts_with("## 2 reports out of date\n\n2 reports are the same. "),
        "{printed}"
    );
}

/// The keys that a schema gives an example or a choice, by the tables that they stand in; of a list of tables one.
fn keys_of(schema: &Value, at: &[String], found: &mut Vec<Vec<String>>) {
    let inner = schema["anyOf"].as_array().into_iter().flatten().chain([schema]);
    let table = inner.into_iter().find(|one| one["properties"].is_object());
    match table.filter(|_| schema["examples"].is_null()) {
        Some(table) => {
            for (key, one) in table["properties"].as_object().expect("properties") {
                keys_of(one, &[at, std::slice::from_ref(key)].concat(), found);
            }
        }
        None => found.push(at.to_vec()),
    }
}

/// Any key that a case may have, a number, a word, a flag, a list or a table, is a row where it changes, comes or goes.
#[test]
fn every_key_of_a_case_is_an_input() {
    let mut all = Vec::new();
    let schema = vinesink::case::schema();
    for name in ["one", "several"] {
        keys_of(&schema["$defs"][name], &[], &mut all);
    }
    all.retain(|path| !["title", "source"].contains(&path[0].as_str()));
    assert!(all.len() > 150, "{} keys", all.len());
    let values =
        [json!(false), json!(true), json!("7 mm"), json!(["a", "b"]), json!(0.25), Value::Null];
    let of = |path: &[String], value: &Value, listed: bool| {
        let mut case = value.clone();
        for key in path.iter().rev() {
            case = json!({ key.as_str(): case });
        }
        // As [[mode]] and [[absorber]] stand there.
        if listed {
            let table = case[&path[0]].take();
            case[&path[0]] = json!([table, { "restitution": 0.5 }]);
        }
        let report =
            json!({"format": "vinesink/answer@2", "asked": "report", "title": "T", "case": case});
        let report = Document::parse("c/report.json", &report.to_string(), BTreeMap::new());
        Reports::from([("c".to_owned(), report.expect("a report"))])
    };
    for (k, path) in all.iter().enumerate() {
        let listed = path.len() > 1 && k % 2 == 1;
        let mut name = path.clone();
        if listed {
            name.insert(1, "1".to_owned());
        }
        let name = name.join(" ").replace('_', " ");
        for pair in values.windows(2) {
            let sides = [&pair[0], &pair[1]].map(|value| of(path, value, listed));
            for (old, new) in [(&sides[0], &sides[1]), (&sides[1], &sides[0])] {
                let found = Difference::of(("old", old), ("new", new));
                let told = found.reports.first().map_or(&[][..], |one| &one.inputs);
                assert_eq!(
                    told.iter().map(|one| &one.what).collect::<Vec<_>>(),
                    [&name],
                    "{pair:?}"
                );
                assert!(found.is_significant());
            }
            let same = Difference::of(("old", &sides[0]), ("new", &sides[0]));
            assert!(same.reports.is_empty() && !same.is_significant(), "{name}");
        }
    }
}

/// Reports of a verdict each, with a peak and many numbers, before and after.
fn many(folder: &Path, count: usize, change: impl Fn(usize, &mut Value)) {
    let text = fs::read_to_string(shipped(CHAOTIC).join("report.json")).expect("readable");
    let whole: Value = serde_json::from_str(&text).expect("JSON");
    for index in 0..count {
        for side in ["old", "new"] {
            let report = folder.join(side).join(format!("case-{index:03}"));
            fs::create_dir_all(&report).expect("a folder");
            let mut own = whole.clone();
            own["verdict"]["word"] = json!("holds");
            own["criteria"] = json!({"count": 1, "failing": 0,
                "all": [criterion("peak_displacement", "<= 4", 3.9, 0.0, "holds")]});
            if side == "new" {
                change(index, &mut own);
            }
            fs::write(report.join("report.json"), own.to_string()).expect("written");
        }
    }
}

/// A criterion that held and fails.
fn flip(report: &mut Value) {
    report["verdict"]["word"] = json!("fails");
    report["criteria"] = json!({"count": 1, "failing": 1,
        "all": [criterion("peak_displacement", "<= 4", 4.1, 0.0, "fails")]});
}

/// Every number of the theory is another one: a section of some hundred lines.
fn stir(report: &mut Value) {
    for list in ["fixed_points", "orbits"] {
        for point in report["theory"][list].as_array_mut().expect("a list") {
            for (_, quantity) in point.as_object_mut().expect("an object") {
                if let Some(number) = quantity["value"].as_f64() {
                    quantity["value"] = json!(1.5 * number + 1.0);
                }
            }
        }
    }
}

/// What flips is read before what is worse, and that before the rest, wherever its name stands among the others.
#[test]
fn the_worst_comes_first_and_no_flip_is_cut() {
    let folder = tempfile::tempdir().expect("a folder");
    many(folder.path(), 150, |index, report| {
        stir(report);
        match index {
            // The last by name.
            149 => flip(report),
            120 => {
                let peak =
                    report.pointer_mut("/quantities/peak_displacement/value").expect("a peak");
                *peak = json!(2.0 * peak.as_f64().expect("a number"));
            }
            _ => {}
        }
    });
    let printed = diff(folder.path(), &["old", "new"], 1);
    assert!(printed.chars().count() <= 60_000);
    assert!(printed.contains("_Cut here: "), "{printed}");
    let flipped = "- **case-149**: FAILS (1 of 1), before HOLDS. Peak displacement ≤ 4: **fails (4.100 mm)**, held before (3.900 mm).";
    assert!(printed.contains(flipped), "{}", &printed[..600]);
    let at = |wanted: &str| printed.find(wanted).unwrap_or_else(|| panic!("{wanted}"));
    let order = ["\n### case-149:", "\n### case-120:", "\n### case-000:", "_Cut here"];
    assert!(order.map(at).is_sorted());
    // As data, in the same order.
    let printed = diff(folder.path(), &["old", "new", "--format", "json"], 1);
    let document: Value = serde_json::from_str(&printed).expect("JSON");
    let folders: Vec<_> = (0..3).map(|k| &document["reports"][k]["folder"]).collect();
    assert_eq!(folders, ["case-149", "case-120", "case-000"]);
}

/// However many flip: with their numbers, as words, as names, and of more names than fit how many are left.
#[test]
fn every_flip_is_named() {
    let side = |count: usize, flips: bool| -> Reports {
        let report = |k: usize| {
            let mut report = json!({"format": "vinesink/answer@2", "asked": "report", "title": "T",
                "verdict": {"word": "holds", "headline": "less"}, "units": "si",
                "quantities": {"clearance": {"id": "clearance", "value": 1e-3, "error": 0.0, "method": "given"}},
                "criteria": {"count": 1, "failing": 0,
                    "all": [criterion("peak_displacement", "<= 4", 3.9, 0.0, "holds")]}});
            if flips {
                flip(&mut report);
            }
            let name = format!("case-{k:04}");
            (
                name,
                Document::parse("c/report.json", &report.to_string(), BTreeMap::new())
                    .expect("a report"),
            )
        };
        (0..count).map(report).collect()
    };
    let more = Regex::new(r"and (\d+) more names").expect("valid");
    for (count, part) in [
        (3, "before HOLDS. Peak"),
        (150, "before HOLDS. Peak"),
        (700, "before HOLDS."),
        (1500, "flip**: case-0000, "),
        (4000, " more names."),
    ] {
        let (old, new) = (side(count, false), side(count, true));
        let printed = markdown(&Difference::of(("old", &old), ("new", &new)), [None, None])
            .expect("Markdown");
        assert!(printed.chars().count() <= 60_000, "{count}");
        let verdicts = format!("**{count} verdicts flip**");
        assert!(
            printed.contains(&verdicts) && printed.contains(part),
            "{count}: {}",
            &printed[..400]
        );
        let named = (0..count).filter(|k| printed.contains(&format!("case-{k:04}"))).count();
        let left = more.captures(&printed);
        let left = left.map_or(0, |found| found[1].parse().expect("a number"));
        assert_eq!(named + left, count);
        assert!(count > 1500 || left == 0, "{count}: {left}");
    }
}

/// Names of reports with characters that mean something in an address, in the comment and in the index.
#[test]
fn names_are_encoded_in_addresses() {
    for (name, encoded) in
        [("a#b", "a%23b"), ("50 % open", "50%20%25%20open"), ("ü?x=1&y", "%C3%BC%3Fx%3D1%26y")]
    {
        let folder = tempfile::tempdir().expect("a folder");
        for side in ["old", "new"] {
            copy(&shipped(STEADY), &folder.path().join(side).join(name));
        }
        fs::write(folder.path().join("new").join(name).join("figures/map.svg"), "<svg/>")
            .expect("written");
        let printed =
            diff(folder.path(), &["old", "new", "--new-url", "https://forge.example/raw?a=1"], 0);
        for image in [
            format!("<img src=\"old/{encoded}/figures/map.svg\""),
            format!("<img src=\"https://forge.example/raw?a=1/{encoded}/figures/map.svg\""),
        ] {
            assert!(printed.contains(&image), "{image}\n{printed}");
        }
        // The folder of all may have such a name as well.
        fs::rename(folder.path().join("old"), folder.path().join("old #1")).expect("renamed");
        let printed = diff(folder.path(), &["old #1", "new"], 0);
        assert!(
            printed.contains(&format!("<img src=\"old%20%231/{encoded}/figures/map.svg\"")),
            "{printed}"
        );
    }
}

/// One name for one number: what it is over is a part of its name, and what caused a flip stands in the first lines.
#[test]
fn a_number_over_the_band_is_not_called_as_one_at_a_frequency() {
    let folder = tempfile::tempdir().expect("a folder");
    beam(folder.path(), "50 mm", "old");
    copy(&folder.path().join("old"), &folder.path().join("new"));
    let change = |pointer: &str, value: Value| {
        edit(&folder, "beam", pointer, |there| *there = value.clone());
    };
    change("/case/absorber/clearance", json!("60 mm"));
    change("/band/worst/regime", json!("at-rest"));
    for peak in [
        "/criteria/all/1/found/value",
        "/band/worst/peak/value",
        "/quantities/peak_displacement/value",
    ] {
        edit(&folder, "beam", peak, scaled(3.0));
    }
    edit_side(&folder, "old", "beam", |report| {
        report["criteria"]["all"][1]["outcome"] = json!("holds");
        report["criteria"]["all"][1]["holds"] = json!(true);
        report["band"]["worst"]["regime"] = json!("two-symmetric");
    });
    let printed = diff(folder.path(), &["old", "new"], 1);
    let (read, _) = printed.split_once("<details>").unwrap_or((&printed, ""));
    for part in [
        "\n> Peak displacement over the band ≤ 8 mm: **fails (292.7 mm)**, held before (97.56 mm).\n",
        "> Absorber clearance from 50 mm to 60 mm. The worst motion over the band went from two symmetric impacts per period to absorber at rest, no impacts.\n",
        "\n| peak displacement over the band ≤ 8 mm | holds (97.56 mm) | fails (292.7 mm) | **flipped** |",
        "| Peak displacement at its own frequency | ",
        "Failed before too: share of the band with a stable 1:1 orbit ≥ 75 %",
    ] {
        assert!(read.contains(part), "{part}\n{read}");
    }
    assert!(
        !read.contains("| Peak displacement | ") && !read.contains("| peak displacement ≤"),
        "{read}"
    );
    assert!(
        !Regex::new(r"(?m)^[^`]*\w/\w+/\w").expect("valid").is_match(read),
        "a path of JSON: {read}"
    );
}
