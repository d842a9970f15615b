//! A case that a record drives: its commands, and what is said of a record that is wrong.

use std::fs;
use std::process::Output;

use assert_cmd::Command;
use serde_json::Value;
use tempfile::TempDir;
use vinesink::case::{Case, CaseError};

const CASE: &str = include_str!("../../cases/tower-record.toml");
const HEAD: &str = "time (s),acceleration (m/s²)\n";

/// A sine of 0.4 Hz in samples of 0.2 s.
fn short() -> String {
    let value = |k: u32| libm::sin(0.5 * f64::from(k));
    (0..=24).map(|k| format!("{:.2},{:.4}\n", 0.2 * f64::from(k), 0.1 * value(k))).collect()
}

fn vinesink(folder: &TempDir, arguments: &[&str]) -> Output {
    let mut command = Command::cargo_bin("vinesink").expect("the program");
    command.current_dir(folder.path()).args(arguments).output().expect("it runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

fn of_case(record: Option<&str>, case: &str) -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("tower.toml"), case).expect("written");
    if let Some(record) = record {
        fs::write(folder.path().join("tower-record.csv"), record).expect("written");
    }
    folder
}

#[test]
fn simulate_check_and_report_answer_and_others_say_why_not() {
    let folder = of_case(Some(&format!("{HEAD}{}", short())), CASE);
    let run = |arguments: &[&str]| {
        let output = vinesink(&folder, arguments);
        (output.status.code(), text(&output.stdout), text(&output.stderr))
    };
    let (code, printed, said) = run(&["simulate", "tower.toml", "--format", "json"]);
    assert_eq!((code, said.as_str()), (Some(0), ""));
    let printed: Value = serde_json::from_str(&printed).expect("JSON");
    let number = |id: &str| printed["quantities"][id]["value"].as_f64().expect("a number");
    // With and without, the same peak but for what a mass of 3 % can do within two swings.
    assert!((number("peak_displacement") / number("bare_peak") - 1.0).abs() < 0.2);
    let (code, printed, _) = run(&["check", "tower.toml"]);
    assert!(code == Some(0) && printed.contains("impact velocity"), "{printed}");
    let (code, ..) = run(&["report", "tower.toml", "--out", "out"]);
    assert_eq!(code, Some(0));
    let read = |name: &str| fs::read_to_string(folder.path().join("out/tower").join(name));
    let page = read("report.md").expect("a page");
    assert!(page.contains("> **HOLDS.** The structure moves by at most"), "{page}");
    for periodic in ["Z3", "orbit", "per period", "excitation frequency"] {
        assert!(!page.contains(periodic), "{periodic}");
    }
    for drawing in ["history", "response-spectrum"] {
        assert!(read(&format!("figures/{drawing}.svg")).expect("a figure").contains("</svg>"));
    }
    assert_eq!(run(&["report", "tower.toml", "--out", "out", "--check"]).0, Some(0));
    for command in ["analyze", "tradeoff"] {
        let (code, printed, said) = run(&[command, "tower.toml"]);
        assert_eq!((code, printed.as_str()), (Some(2), ""), "{command}");
        let said = said.split(['\n', '│', ' ']).filter(|word| !word.is_empty());
        let said = said.collect::<Vec<_>>().join(" ");
        assert!(said.contains("its structure is driven by a record"), "{command}: {said}");
    }
}

/// The tower under a base acceleration of these values every 0.1 s, and what `optimize` says of it.
fn optimized(count: u32, value: impl Fn(f64) -> f64) -> (TempDir, Option<i32>, Value) {
    let row = |t: f64| format!("{t:.1},{}\n", value(t));
    let rows = (0..=count).map(|k| row(0.1 * f64::from(k)));
    let case = CASE.replace("\"100 mm\"", "\"40 mm\"").replace("<= 55 mm", "<= 70 mm");
    let folder = of_case(Some(&format!("{HEAD}{}", rows.collect::<String>())), &case);
    let output = vinesink(
        &folder,
        &["optimize", "tower.toml", "--write", "better.toml", "--format", "json"],
    );
    let printed = serde_json::from_slice(&output.stdout).expect("JSON");
    (folder, output.status.code(), printed)
}

/// Two periods short of twenty of the tower's own frequency. What is written does what is said, by `check`, and its
/// clearance is not above the best: beyond that the absorber is lost.
#[test]
fn the_best_clearance_is_checked_and_written() {
    let (folder, code, found) = optimized(360, |t| 0.04 * libm::sin(std::f64::consts::PI * t));
    assert_eq!((code, &found["answer"]), (Some(0), &"found".into()), "{found}");
    let number = |of: &Value| of["value"].as_f64().expect("a number");
    let (checked, error) = (number(&found["checked"]), found["checked"]["error"].as_f64());
    assert!(checked < number(&found["own"]["value"]) && checked < number(&found["alone"]));
    let written = fs::read_to_string(folder.path().join("better.toml")).expect("written");
    assert!(written.contains("file = \"tower-record.csv\"     # beside"), "{written}");
    let clearance = Case::parse("better.toml", &written).expect("a case").design.clearance();
    let best = found["optimum"]["clearance"].as_f64().expect("a number");
    assert!(clearance <= best && clearance > 0.999 * best, "{clearance} {best}");
    let output = vinesink(&folder, &["check", "better.toml", "--format", "json"]);
    let judged: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    for (k, one) in found["criteria"]["all"].as_array().expect("criteria").iter().enumerate() {
        assert_eq!(judged["cases"][0]["criteria"][k]["found"], one["found"]["value"]);
    }
    let peak = judged["cases"][0]["criteria"][0]["found"].as_f64().expect("a number");
    assert!(peak <= checked + error.expect("a number") && peak > 0.9 * checked, "{peak} {found}");
}

/// A blow is over before the absorber can have done anything.
#[test]
fn where_no_absorber_helps_nothing_is_written() {
    let blow = |t: f64| 5.0 * libm::sin(std::f64::consts::PI * t.min(0.2) / 0.2);
    let (folder, code, found) = optimized(60, blow);
    assert_eq!((code, &found["answer"]), (Some(1), &"no-help".into()), "{found}");
    assert!(!folder.path().join("better.toml").exists());
}

/// What is in brackets says how much worse the worst place may be; what is behind `±` is about a mean. One number is
/// told alike by every command.
#[test]
fn one_number_has_one_error() {
    let several =
        "spectrum = [[0.2, 0.02], [1.0, 0.02]]\nduration = \"20 s\"\nseed = 3\nrealisations = 3\n";
    let file = "file = \"tower-record.csv\"     # beside this file: time and acceleration\n";
    let asked = "[criteria]\nreduction_db = \">= -20 dB\"\nreduction_db_tmd = \">= -20 dB\"";
    for (source, mark) in [(file, "("), (several, "±")] {
        let case = CASE.replace(file, source).replace("[criteria]", asked);
        let quake = |k: u32| 0.2 * libm::sin(0.3 * f64::from(k)) * libm::exp(-0.01 * f64::from(k));
        let rows = (0..200).map(|k| format!("{:.1},{:.4}\n", 0.1 * f64::from(k), quake(k)));
        let folder = of_case(Some(&format!("{HEAD}{}", rows.collect::<String>())), &case);
        let run = |arguments: &[&str]| text(&vinesink(&folder, arguments).stdout);
        let (checked, simulated) =
            (run(&["check", "tower.toml", "--criteria-only"]), run(&["simulate", "tower.toml"]));
        run(&["report", "tower.toml", "--out", "out"]);
        let page = folder.path().join("out/tower/report.md");
        let page = fs::read_to_string(page).expect("a page");
        // Columns are two spaces apart: criterion, verdict, asked, found.
        let rows: Vec<Vec<&str>> = checked
            .lines()
            .skip(2)
            .take_while(|line| !line.is_empty())
            .map(|line| line.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).collect())
            .collect();
        assert_eq!(rows.len(), 5, "{checked}");
        assert!(rows.iter().any(|row| row[3].contains(mark)), "{checked}");
        for row in rows {
            // Behind the number stands of which share of places it is the worst.
            let (found, of_places) = row[3].split_once(", worst of ").expect("a share");
            assert!(of_places.ends_with(" % of places"), "{of_places}");
            // Of one record, only where the last places have added something.
            assert!(mark == "(" || found.contains(mark), "{found} {checked}");
            let reduction = row[0].starts_with("reduction");
            assert!(reduction || simulated.contains(found), "{found} {simulated}");
            assert!(page.matches(found).count() >= 2, "{found} {page}");
        }
    }
}

/// A density with its unit is that in SI; of a force none is of accelerations.
#[test]
fn a_density_may_be_in_squared_gravity() {
    let of = |spectrum: &str, quantity: &str| {
        let noise = format!("{spectrum}\nduration = \"20 s\"\nseed = 3\nrealisations = 3\n");
        let file = CASE.lines().find(|line| line.starts_with("file = ")).expect("a file");
        let text = CASE.replace(file, &noise).replace("\"base-acceleration\"", quantity);
        Case::parse("tower.toml", &text)
    };
    let spectrum = |text: &str| of(text, "\"base-acceleration\"").expect("valid").recording;
    let plain = spectrum("spectrum = [[0.25, 48.085_192_111_25], [1, 48.085_192_111_25]]");
    let gravity = spectrum("spectrum = [[\"15 rpm\", \"0.5 g2/Hz\"], [1, \"0.5 g²/Hz\"]]");
    assert_eq!(plain, gravity);
    let error =
        of("spectrum = [[0.2, \"0.02 g2/Hz\"], [1, 0.02]]", "\"force\"").expect_err("a force");
    let problem = error.problems().next().expect("one");
    assert_eq!(problem.message, "a density of accelerations is none of this quantity");
    assert_eq!(problem.underlined, "\"0.02 g2/Hz\"");
    let error = of("spectrum = [[0.2, \"0.02\"], [1, 0.02]]", "\"force\"").expect_err("no unit");
    let problem = error.problems().next().expect("one");
    assert!(problem.message.contains("is a number in quotes without a unit"), "{problem:?}");
    assert!(problem.expected.contains("or a density of accelerations such as"), "{problem:?}");
}

#[test]
fn a_spectrum_is_told_with_its_scatter() {
    let noise =
        "spectrum = [[0.2, 0.02], [1.0, 0.02]]\nduration = \"20 s\"\nseed = 3\nrealisations = 3\n";
    let case = CASE.replace(
        "file = \"tower-record.csv\"     # beside this file: time and acceleration\n",
        noise,
    );
    let case = case.replace("[criteria]", "[simulation]\nstarts = 4\n\n[criteria]");
    let folder = of_case(None, &case);
    let run = || vinesink(&folder, &["simulate", "tower.toml", "--format", "json"]);
    let output = run();
    assert_eq!(text(&output.stderr), "");
    let printed: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let peak = &printed["quantities"]["bare_peak"];
    assert!(
        peak["error"].as_f64() > Some(0.01 * peak["value"].as_f64().expect("a number")),
        "{peak}"
    );
    assert_eq!(run().stdout, output.stdout);
}

#[test]
fn a_record_that_is_wrong_is_shown_where_it_is() {
    let none = vinesink(&of_case(None, CASE), &["simulate", "tower.toml"]);
    let said = text(&none.stderr);
    assert_eq!(none.status.code(), Some(2));
    assert!(said.contains("tower.toml") && said.contains("tower-record.csv"), "{said}");
    let refused = |record: &str| -> CaseError {
        let case = Case::parse("tower.toml", CASE).expect("a case");
        case.with_record("tower-record.csv", record).expect_err("wrong")
    };
    let good = format!("{HEAD}{}", short());
    for (from, to, line, words) in [
        ("0.40,", "0.40;", 4, "does not have two values"),
        ("0.40,0.0841", "0.40,high", 4, "\"high\" is no number"),
        ("0.40,", "0.20,", 4, "do not ascend"),
        ("(m/s²)", "(mm)", 1, "`mm` is the unit of a length"),
        ("(m/s²)", "", 1, "has no unit"),
        ("(m/s²)", "(m/ss)", 1, "unknown unit `m/ss`"),
        ("time (s)", "time (Hz)", 1, "`Hz` is the unit of a frequency"),
        ("time (s),", "", 1, "is not a record: there is an error in line 1"),
    ] {
        assert!(good.contains(from), "{from}");
        let error = refused(&good.replacen(from, to, 1));
        let problems: Vec<_> = error.problems().collect();
        let [problem] = problems.as_slice() else { panic!("{to}: {problems:?}") };
        assert_eq!((error.name(), problem.line), ("tower-record.csv", line), "{to}");
        assert!(problem.message.contains(words), "{to}: {}", problem.message);
    }
    assert!(refused("").problems().count() == 1 && refused(HEAD).problems().count() == 1);
    // Who took the wrong file is not told of every line.
    assert_eq!(refused(&format!("{HEAD}{}", "a,b\n".repeat(90))).problems().count(), 5);
    // Units are converted, comments and blank lines passed over.
    let read = |record: &str| {
        let case = Case::parse("tower.toml", CASE).expect("a case");
        let case = case.with_record("record.csv", record).expect("a record");
        case.recording.expect("recorded").records()[0].samples.clone()
    };
    let read = read("\u{feff}# a comment\n\ntime (ms), acceleration (g)\r\n0,1\r\n5, -2e-1\r\n");
    assert_eq!(read, [[0.0, 9.80665], [0.005, -0.2 * 9.80665]]);
}

#[test]
fn what_does_not_go_with_a_record_is_refused() {
    let file = "file = \"tower-record.csv\"";
    for (from, to, words) in [
        (file, "file = \"a.csv\"\nseed = 1", "`seed` has no meaning beside `file`"),
        (file, "spectrum = [[1, 1], [2, 1]]\nseed = 1", "`duration` is missing"),
        (file, "", "`file` or `spectrum` is missing"),
        (file, "file = \"a.csv\"\nspectrum = [[1, 1], [2, 1]]", "say the same thing twice"),
        (file, "spectrum = [[2, 1], [1, 1]]\nseed = 1\nduration = \"60 s\"", "do not rise"),
        (file, "spectrum = [[1, 1], [2, 1]]\nseed = 1\nduration = \"2 s\"", "has 3 lines"),
        (file, "spectrum = [[1, 1], [1e12, 1]]\nseed = 1\nduration = \"9 s\"", "samples together"),
        (file, "file = \"a.csv\"\nfrequency = \"2 Hz\"", "`frequency` has no meaning"),
        ("rms_displacement = \"<= 55 mm\"", "z3_share = \">= 80 %\"", "driven by a record"),
        ("[criteria]", "[band]\nover = \"frequency\"\n[criteria]", "[band] has no meaning"),
        (
            "[criteria]",
            "[optimize]\nobjective = \"margin\"\n[criteria]",
            "`objective` has no meaning in [optimize] for a structure that is driven by a record",
        ),
        (
            "[criteria]",
            "[optimize]\nreleases = [0.5, 2]\n[criteria]",
            "`releases` has no meaning in [optimize] for a structure that is driven by a record",
        ),
    ] {
        assert!(CASE.contains(from), "{from}");
        let error = Case::parse("tower.toml", &CASE.replacen(from, to, 1)).expect_err(to);
        let messages: Vec<&str> = error.problems().map(|one| one.message.as_str()).collect();
        assert!(messages.iter().any(|message| message.contains(words)), "{to}: {messages:?}");
    }
}
