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
        ("time (s),", "", 1, "the head of the record names 1 column"),
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

/// The tower's case with more lines in `[excitation]`.
fn with_lines(lines: &str) -> Case {
    let file = CASE.lines().find(|line| line.starts_with("file = ")).expect("a file");
    let text = CASE.replace(file, &format!("file = \"a.csv\"\n{lines}"));
    Case::parse("tower.toml", &text).unwrap_or_else(|error| panic!("{error:?}"))
}

/// A swing that begins and ends at rest: times in s, values in g.
fn swing() -> Vec<[f64; 2]> {
    let value = |t: f64| 0.05 * libm::sin(3.1 * t) * libm::exp(-(t - 8.0) * (t - 8.0) / 9.0);
    let rounded = |x: f64| (1e6 * x).round() / 1e6;
    (0..=320).map(|k| 0.05 * f64::from(k)).map(|t| [rounded(t), rounded(value(t))]).collect()
}

/// The swing as text: what stands before, between the cells, and for a decimal point.
fn table(head: &str, separator: &str, mark: &str) -> String {
    let row = |[t, a]: [f64; 2]| format!("{t:.2}{separator}{a:.6}\n").replace('.', mark);
    let rows: String = swing().into_iter().map(|one| row(one).replace("SEP", separator)).collect();
    format!("{head}{rows}")
}

fn samples_of(case: Case, file: &[u8]) -> Vec<[f64; 2]> {
    let case = case.with_record("a.csv", file).unwrap_or_else(|error| panic!("{error:?}"));
    case.recording.expect("recorded").records()[0].samples.clone()
}

fn problem_of(case: Case, file: &[u8]) -> (String, String) {
    let error = case.with_record("a.csv", file).expect_err("wrong");
    let problem = error.problems().next().expect("one");
    (problem.message.clone(), problem.help.clone().unwrap_or_default())
}

/// Separators, decimal commas, heads of many lines, columns, a rate and encodings: the same record.
#[test]
fn a_record_is_read_as_loggers_write_it() {
    let g: Vec<[f64; 2]> = swing().iter().map(|[t, a]| [*t, a * 9.80665]).collect();
    let long =
        |last: &str| format!("Recorder 7\nSampling rate: 20 Hz\n{}{last}", "x: y, z\n".repeat(18));
    let utf16 = |text: &str, of: fn(u16) -> [u8; 2], mark: [u8; 2]| -> Vec<u8> {
        let units = text.encode_utf16().flat_map(of);
        mark.into_iter().chain(units).collect()
    };
    let latin =
        |text: &str| text.chars().map(|c| u8::try_from(u32::from(c)).expect("Latin-1")).collect();
    let column = |head: &str, mark: &str| -> String {
        let rows = swing().into_iter().map(|[_, a]| format!("{a:.6}\n").replace('.', mark));
        head.to_owned() + &rows.collect::<String>()
    };
    let several: String =
        swing().iter().map(|[t, a]| format!("{t:.2},0.1,OK,{a:.6},7\n")).collect();
    let several = format!("t (s),ch1 (g),state,ch3 (g),Temp (N)\n{several}");
    let quoted: String = swing().iter().map(|[t, a]| format!("\"{t:.2}\",\"{a:.6}\",\n")).collect();
    let comma = table("time (s),acceleration (g)\n", ",", ".");
    for (lines, file) in [
        ("", comma.clone().into_bytes()),
        ("", comma.replace('\n', "\r").into_bytes()),
        ("", table("time [s];acceleration [g]\n", ";", ".").into_bytes()),
        ("", table("Zeit [s];a [g]\n", ";", ",").into_bytes()),
        ("", table("time (s)\tacceleration (g)\n", "\t", ",").into_bytes()),
        ("", table("time (s)   acceleration (g)\n", "   ", ".").into_bytes()),
        ("", table("time (s), acceleration (g)\n", ", ", ",").into_bytes()),
        ("", table("# made somewhere\n# time (s) acceleration (g)\n", " ", ".").into_bytes()),
        ("", table(&long("time (s),acceleration (g)\n"), ",", ".").into_bytes()),
        ("", table(&long("time,acceleration\n[s],[g]\n"), ",", ".").into_bytes()),
        ("", table("time;acceleration\ns;g\n", ";", ",").into_bytes()),
        ("", format!("\"time (s)\",\"acceleration, x (g)\"\n{quoted}").into_bytes()),
        ("", latin(&table("Messger\u{e4}t 7, 20 \u{b0}C\ntime (s),acceleration (g)\n", ",", "."))),
        ("", format!("\u{feff}{comma}").into_bytes()),
        ("", utf16(&comma, u16::to_le_bytes, [0xff, 0xfe])),
        ("", utf16(&comma, u16::to_be_bytes, [0xfe, 0xff])),
        ("unit = \"g\"", table("time (s),Accel (X)\n", ",", ".").into_bytes()),
        ("unit = \"g\"\ntime_column = \"1 (s)\"", table("", ",", ".").into_bytes()),
        ("column = \"ch3\"", several.clone().into_bytes()),
        ("column = \"4\"\ntime_column = \"t\"", several.clone().into_bytes()),
        ("rate = \"20 Hz\"", column("acceleration (g)\n", ".").into_bytes()),
        ("rate = \"0.02 kHz\"\nunit = \"g\"", column("", ".").into_bytes()),
        ("rate = \"20 Hz\"", column("acceleration (g)\n", ",").into_bytes()),
        ("rate = \"20 Hz\"", comma.clone().into_bytes()),
    ] {
        let found = samples_of(with_lines(lines), &file);
        let shown = String::from_utf8_lossy(&file[..file.len().min(80)]).into_owned();
        assert_eq!(found.len(), g.len(), "{lines} {shown}");
        for (found, exact) in found.iter().zip(&g) {
            assert!((found[0] - exact[0]).abs() < 1e-12, "{shown}: {found:?} {exact:?}");
            assert!((found[1] - exact[1]).abs() < 1e-12, "{shown}: {found:?} {exact:?}");
        }
    }
    // A column whose unit alone fits, and one in Gal.
    let file = table("time (ms),acceleration (cm/s2)\n", ",", ".");
    let found = samples_of(with_lines(""), file.as_bytes());
    assert!(
        (found[100][1] - 0.01 * swing()[100][1]).abs() < 1e-15
            && (found[100][0] - 0.005).abs() < 1e-15
    );
    let text: String = swing().iter().map(|[t, a]| format!("{t:.2};3;{a:.6}\n")).collect();
    assert_eq!(samples_of(with_lines(""), format!("t (s);F (N);a (g)\n{text}").as_bytes()), g);
}

/// Files of the PEER database, whose head has changed over the years.
#[test]
fn a_file_of_the_peer_database_is_read() {
    let values: Vec<String> = swing().iter().map(|[_, a]| format!("{a:15.7E}")).collect();
    let rows = |per: usize| values.chunks(per).map(|row| row.concat() + "\n").collect::<String>();
    let new = "PEER NGA STRONG MOTION DATABASE RECORD\nSomewhere, 10/15/1979, Delta, 262\n\
               ACCELERATION TIME SERIES IN UNITS OF G\nNPTS=    321, DT=   .0500 SEC,\n";
    let old = "PEER\nx\nACCELERATION TIME HISTORY IN UNITS OF G\n 321   0.0500  NPTS, DT\n";
    let gal = new.replace("UNITS OF G", "UNITS OF CM/SEC/SEC");
    for (head, per, unit) in [(new, 5, 9.80665), (old, 8, 9.80665), (gal.as_str(), 5, 0.01)] {
        let found = samples_of(with_lines(""), (head.to_owned() + &rows(per)).as_bytes());
        assert_eq!(found.len(), 321);
        for (found, [t, a]) in found.iter().zip(swing()) {
            assert!((found[0] - t).abs() < 1e-12 && (found[1] - unit * a).abs() < 1e-12);
        }
    }
    for (file, words) in [
        (new.to_owned() + &rows(5).replacen('E', "F", 1), "is no number"),
        (new.to_owned() + &rows(5)[..900], "the head says 321 samples"),
        (new.replace("OF G", "OF CM/SEC") + &rows(5), "`cm/s` is the unit of a velocity"),
    ] {
        let (message, _) = problem_of(with_lines(""), file.as_bytes());
        assert!(message.contains(words), "{message}");
    }
}

/// What a file lacks is said by its own head; no unit is proposed in its place.
#[test]
fn a_help_shows_the_files_own_head_and_guesses_no_unit() {
    let bare = table("Logger 3, 20 Hz\nt,a\n", ",", ".");
    let one: String = swing().iter().map(|[_, a]| format!("{a:.6}\n")).collect();
    let deep = format!("Abtastrate 20 Hz\n{}acc (g)\n{one}", "x: y\n".repeat(19));
    let several: String =
        swing().iter().map(|[t, a]| format!("{t:.2}\t{a:.6}\t{a:.6}\n")).collect();
    let several = format!("t (s)\tNorth (g)\tEast (g)\n{several}");
    for (lines, file, message, help) in [
        ("", &bare, "the time of the record has no unit", "own head is: Logger 3, 20 Hz | t,a"),
        (
            "unit = \"g\"",
            &bare,
            "the time of the record has no unit",
            "time_column = \"name (unit)\"",
        ),
        ("", &deep, "no column of times", "Abtastrate 20 Hz"),
        ("", &several, "2 columns that may be its values", "column = \"...\""),
        ("column = \"Up\"", &several, "no single column \"Up\"", "t (s)\tNorth (g)\tEast (g)"),
        ("unit = \"m/s2\"\ncolumn = \"East\"", &several, "is in g by the head, and in m/s2", ""),
    ] {
        let (told, helped) = problem_of(with_lines(lines), file.as_bytes());
        assert!(told.contains(message), "{told}");
        assert!(helped.contains(help), "{helped}");
        assert!(!helped.contains("(m/s²)") && !helped.contains("time (s)"), "{helped}");
    }
    // Comma between columns, or before decimals: the file does not decide.
    let either: String = (1..50).map(|k| format!("{},{}\n", k, 1000 + k)).collect();
    let (message, help) =
        problem_of(with_lines("rate = \"9 Hz\"\nunit = \"g\""), either.as_bytes());
    assert!(
        message.contains("2 columns between commas") && message.contains("one column"),
        "{message}"
    );
    assert!(help.contains("semicolons"), "{help}");
    // A head decides.
    assert_eq!(samples_of(with_lines(""), format!("t (s),a (g)\n{either}").as_bytes()).len(), 49);
    // A rate beside times that say another one.
    let timed = table("time (s),acceleration (g)\n", ",", ".");
    let (message, _) = problem_of(with_lines("rate = \"40 Hz\""), timed.as_bytes());
    assert!(message.contains("20 samples in a second, not of `rate`"), "{message}");
    let of_file = |lines: &str| {
        let text = CASE.replace("quantity =", &format!("{lines}\nquantity ="));
        let error = Case::parse("tower.toml", &text).expect_err("wrong");
        error.problems().next().expect("one").message.clone()
    };
    assert!(of_file("unit = \"mm\"").contains("`mm` is the unit of a length"));
    assert!(of_file("rate = \"2 Hz/s\"").contains("`rate` is a frequency"));
    assert!(of_file("rate = \"2 Hz\"\ntime_column = \"t\"").contains("say the same thing twice"));
}

/// Records with a few bytes changed, by a generator of random numbers: read, or refused, whatever they are.
#[test]
fn any_bytes_are_read_or_refused() {
    let several = "Hz: 20\ntime (s)\tNorth (g)\tEast (g)\n0,0\t1,5\t2\n0,1\t-1\t3,5e-1\n0,2\t1\t4\n0,3\t2\t1\n";
    let peer = "PEER\nx\nIN UNITS OF G\nNPTS= 6, DT= .01 SEC\n 1E-1 2E-1 3E-1\n 4E-1 5E-1 6E-1\n";
    let begins = [
        "time (s), acceleration (g)\n0,1\n1,2\n2;5\n",
        several,
        peer,
        "# t [s]  \"a\" (g)\n1 2\n2 3\n3 4\n",
    ];
    let cases = ["", "rate = \"9 Hz\"\nunit = \"g\"", "column = \"East (g)\"\ngaps = \"linear\""]
        .map(with_lines);
    let mut random = 7_u64;
    let mut next = |below: usize| {
        random =
            random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (random >> 33) as usize % below
    };
    let bytes = b"\0\t\n\r \"#%(),-.;=[]0159EeGT\xb2\xc3\xff\xfe";
    let (mut read, mut refused) = (0, 0);
    for round in 0..3000 {
        let mut file = begins[round % begins.len()].as_bytes().to_vec();
        for _ in 0..=next(4) {
            let at = next(file.len());
            match next(3) {
                0 => file[at] = bytes[next(bytes.len())],
                1 => file.insert(at, bytes[next(bytes.len())]),
                _ => drop(file.remove(at)),
            }
        }
        for case in &cases {
            match case.clone().with_record("a.csv", &file) {
                Ok(_) => read += 1,
                Err(error) => {
                    refused += 1;
                    assert!(!format!("{:?}", miette::Report::new(error)).is_empty());
                }
            }
        }
    }
    assert!(read > 500 && refused > 500, "{read} {refused}");
}

/// Another file than a record is not quoted, and one that is no text says how to make one of it.
#[test]
fn what_is_no_record_is_not_quoted() {
    for file in [
        "root:x:0:0:root:/root:/bin/sh\ndaemon:x:1:1::/usr/sbin:/bin/false\n",
        "# fstab\nUUID=5ec4e7 / ext4 defaults 0 1\nUUID=5ec4e8 /a ext4 ro 0 2\nUUID=9 /b ext4 ro 0 2\n",
        "password = 5ec4e7\nport = 22\n",
        "user,5ec4e7,12\nother,5ec4e8,13\nthird,5ec4e9,14\nfourth,5ec4f0,15\n",
    ] {
        let error = with_lines("").with_record("a.csv", file).expect_err("no record");
        let shown = format!("{:?}", miette::Report::new(error));
        assert!(shown.contains("is not a record"), "{shown}");
        for secret in ["5ec4e", "root", "daemon", "defaults"] {
            assert!(!shown.contains(secret), "{shown}");
        }
    }
    for (name, file, words) in [
        ("a.xlsx", b"PK\x03\x04\x14\0".as_slice(), "CSV UTF-8"),
        ("a.xls", b"\xd0\xcf\x11\xe0\xa1\xb1", "CSV UTF-8"),
        ("a.csv.gz", b"\x1f\x8b\x08\0", "gunzip"),
        ("a.tdms", b"TDSm\x0e\0\0\0", "npTDMS"),
        ("a.mat", b"MATLAB 5.0 MAT-file, Platform", "writematrix"),
        ("a.mat", b"\x89HDF\r\n", "writematrix"),
        ("a.bin", b"\0\x01\x02", "export the record as text"),
        (
            "a.csv",
            b"version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 9\n",
            "git lfs pull",
        ),
    ] {
        let error = with_lines("").with_record(name, file).expect_err("no text");
        let problem = error.problems().next().expect("one");
        assert!(problem.help.as_deref().is_some_and(|help| help.contains(words)), "{problem:?}");
        assert!(problem.message.contains(name), "{problem:?}");
    }
}

/// Where samples are missing nothing is drawn across unless the case says so.
#[test]
fn a_gap_is_refused_unless_it_is_accepted() {
    let full = table("time (s),acceleration (g)\n", ",", ".");
    let without = |from: usize, to: usize| -> String {
        let kept = full.lines().enumerate().filter(|(k, _)| !(from..to).contains(k));
        kept.map(|(_, line)| format!("{line}\n")).collect()
    };
    // Six seconds, four steps, and three, which are none.
    for (from, to, between) in [(100, 220, "4.9 and 10.95"), (50, 53, "2.4 and 2.6")] {
        let file = without(from, to);
        let (message, help) = problem_of(with_lines(""), file.as_bytes());
        assert!(
            message.contains(between) && help.contains("gaps = \"linear\""),
            "{message} {help}"
        );
        let (message, _) = problem_of(with_lines("gaps = \"refuse\""), file.as_bytes());
        assert!(message.contains(between), "{message}");
        let read = samples_of(with_lines("gaps = \"linear\""), file.as_bytes());
        assert_eq!(read.len(), 321 - (to - from));
    }
    assert_eq!(samples_of(with_lines(""), without(50, 52).as_bytes()).len(), 319);
}

/// An offset, values that stand alone and coarse steps are warned of with time and value; what is meant is not.
#[test]
fn faults_of_a_record_are_warned_of() {
    let warned = |values: &dyn Fn(usize, f64) -> f64, every: usize| -> Vec<String> {
        let rows = swing().into_iter().enumerate().step_by(every);
        let rows = rows.map(|(k, [t, a])| format!("{t:.2},{:.6}\n", values(k, a)));
        let file = format!("time (s),acceleration (g)\n{}", rows.collect::<String>());
        let case = with_lines("").with_record("a.csv", file).expect("read");
        let told = case.warnings().iter();
        told.map(|one| {
            assert!(one.underlined.contains("a.csv") && one.line > 1, "{one:?}");
            one.message.clone()
        })
        .collect()
    };
    let random =
        |k: usize| libm::sin(12.9 * (k * k) as f64) + libm::sin(7.7 * (k * k * k % 911) as f64);
    for (values, every, words) in [
        (
            &(|_, a| a + 1.0) as &dyn Fn(usize, f64) -> f64,
            1,
            "an offset: most of its values are about 1 g from 0 s to 16 s",
        ),
        (&|_, a| a - 0.01, 1, "an offset"),
        (&|k, a| a + 0.1 * random(k) + 0.1, 1, "an offset: its mean is"),
        (&|k, a| if k == 77 { -9999.0 } else { a }, 1, "stands alone: -9999 g at 3.85 s"),
        (
            &|k, a| if (70..90).contains(&k) { -999.0 } else { a },
            1,
            "-999 g at 3.5 s, and 19 more up to 4.45 s",
        ),
        (
            &|k, a| if k == 200 || k == 300 { 0.4 } else { a },
            1,
            "stands alone: 0.4 g at 10 s, and 1 more up to 15 s",
        ),
        (&|_, a| a, 10, "steps of the record are up to 0.5 s"),
    ] {
        let told = warned(values, every);
        assert!(told.len() == 1 && told[0].contains(words), "{words}: {told:?}");
    }
    // A swing, a half sine, a square pulse, a triangle, a step at the end, noise, a half swing that is cut.
    let pulse = |k: usize| libm::sin(std::f64::consts::PI * k as f64 / 320.0);
    for values in [
        &(|_, a| a) as &dyn Fn(usize, f64) -> f64,
        &|k, _| 0.1 * pulse(k),
        &|k, _| if (100..120).contains(&k) { 0.1 } else { 0.0 },
        &|k, _| 0.01 * (10.0 - (k as f64 - 150.0).abs()).max(0.0),
        &|k, _| 0.1 * random(k),
        &|k, _| 0.05 * libm::sin(0.1 * k as f64),
    ] {
        assert_eq!(warned(values, 1), Vec::<String>::new());
    }
    let whole = include_str!("../../cases/tower-record.csv");
    let case = Case::parse("tower.toml", CASE).expect("a case").with_record("a.csv", whole);
    assert!(case.expect("read").warnings().is_empty());
}

/// A warning is on standard error and on the page.
#[test]
fn a_warning_of_a_record_is_told_and_shown() {
    let file = format!("{HEAD}{}", short().replace("0.40,0.0841", "0.40,-9999"));
    let folder = of_case(Some(&file), CASE);
    let output = vinesink(&folder, &["check", "tower.toml", "--criteria-only"]);
    let words = "a value of the record stands alone: -9999 m/s² at 0.4 s";
    let said = text(&output.stderr)
        .split(['\n', '│', ' '])
        .filter(|word| !word.is_empty())
        .collect::<Vec<_>>()
        .join(" ");
    assert!(said.contains(words), "{said}");
    vinesink(&folder, &["report", "tower.toml", "--out", "out"]);
    for name in ["report.md", "report.json"] {
        let page = fs::read_to_string(folder.path().join("out/tower").join(name)).expect("a page");
        assert!(page.contains("stands alone: -9999 m/s² at 0.4 s"), "{name}");
    }
}

const PULSE: &str = "title = \"A pulse\"\nsource = \"test\"\n\n[oscillator]\nmass = \"100 kg\"\nfrequency = \"2 Hz\"\n\
    damping_ratio = \"1 %\"\n\n[absorber]\nmass_ratio = \"2 %\"\nclearance = \"2 mm\"\nrestitution = 0.6\n\n\
    [excitation]\nkind = \"record\"\nfile = \"tower-record.csv\"\nquantity = \"force\"\n\n\
    [criteria]\npeak_displacement = \"<= 5 mm\"\n\n[sweep]\nclearance = { values = [\"2 mm\"] }\nstarts = 64\n";

/// A half sine of 20 ms on a structure of 2 Hz: an independent integration (scipy, tolerance 1e-9, events at the walls) has
/// a peak of 9.8526 mm from the worst of nine places, and the shortest of blows `J/(m omega0)` 10.1 mm alone. Every
/// command says the same, and the page for how long the motion was followed.
#[test]
fn a_pulse_fails_by_every_command() {
    let value = |k: u32| 1000.0 * libm::sin(std::f64::consts::PI * f64::from(k) / 40.0);
    let rows = (0..=40).map(|k| format!("{:.6},{:.6}\n", 0.0005 * f64::from(k), value(k)));
    let file = format!("time (s),force (N)\n{}", rows.collect::<String>());
    let folder = of_case(Some(&file), PULSE);
    let json = |arguments: &[&str]| -> Value {
        let output = vinesink(&folder, arguments);
        serde_json::from_slice(&output.stdout)
            .unwrap_or_else(|_| panic!("{}", text(&output.stderr)))
    };
    let checked = json(&["check", "tower.toml", "--format", "json"]);
    let criterion = &checked["cases"][0]["criteria"][0];
    let found = criterion["found"].as_f64().expect("a number");
    assert_eq!(criterion["holds"], false);
    assert!((found / 9.8526e-3 - 1.0).abs() < 2e-4, "{found}");
    let simulated = json(&["simulate", "tower.toml", "--format", "json"]);
    let number = |id: &str| simulated["quantities"][id]["value"].as_f64().expect("a number");
    assert_eq!(number("peak_displacement"), found);
    let blow = 1000.0 * 0.04 / std::f64::consts::PI / (100.0 * 2.0 * std::f64::consts::TAU);
    let first_swing = libm::exp(-0.01 * std::f64::consts::FRAC_PI_2);
    assert!(
        (number("bare_peak") / (blow * first_swing) - 1.0).abs() < 2e-3,
        "{}",
        number("bare_peak")
    );
    assert!(number("damper_peak") > 0.9 * number("bare_peak"));
    let optimized = json(&["optimize", "tower.toml", "--format", "json"]);
    assert_eq!(optimized["own"]["value"]["value"].as_f64(), Some(found));
    vinesink(&folder, &["sweep", "tower.toml", "--csv", "--out", "out"]);
    let csv = fs::read_to_string(folder.path().join("out/tower/sweep.csv")).expect("results");
    let cells = |k: usize| csv.lines().nth(k).expect("a line").split(',').collect::<Vec<_>>();
    let column = cells(0).iter().position(|name| name.starts_with("peak")).expect("a column");
    let swept: f64 = cells(1)[column].parse().expect("a number");
    assert!((swept / found - 1.0).abs() < 1e-3, "{swept} {found}");
    vinesink(&folder, &["report", "tower.toml", "--out", "out"]);
    let page = fs::read_to_string(folder.path().join("out/tower/report.md")).expect("a page");
    assert!(
        page.contains(
            "After the end of the record no force acts, and the motion is followed for up to"
        ),
        "{page}"
    );
    let report = fs::read_to_string(folder.path().join("out/tower/report.json")).expect("JSON");
    let report: Value = serde_json::from_str(&report).expect("JSON");
    assert!(report["input"]["followed"]["value"].as_f64() > Some(5.0), "{}", report["input"]);
    let alone = report["alternatives"].as_array().expect("rows").iter();
    let mut alone = alone.filter(|row| row["device"] == "none" && row["drift"] == 0.0);
    let worst = alone.next().and_then(|row| row["worst"]["value"].as_f64());
    assert!(
        worst.is_none_or(|worst| (worst / number("bare_peak") - 1.0).abs() < 1e-12),
        "{worst:?}"
    );
    // Every frequency of the response spectrum: a blow swings it to J/(m omega), and stiffer ones to less.
    for point in report["spectrum"].as_array().expect("points") {
        let frequency = point["frequency"]["value"].as_f64().expect("a number");
        let bare = point["bare"]["value"].as_f64().expect("a number");
        let exact = blow * first_swing * 2.0 / frequency;
        assert!((bare / exact - 1.0).abs() < 0.03, "{frequency} {bare} {exact}");
    }
}
