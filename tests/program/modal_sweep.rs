//! Sweeps of structures of several modes with several absorbers.

use std::fs;

use assert_cmd::Command;
use serde_json::Value;
use tempfile::tempdir;
use vinesink::case::ModalCase;
use vinesink::sweep::ModalPlan;
use vinesink::sweep::columns::{Cell, Column};

/// Two modes and two balls, with another load at its own frequency.
const RACK: &str = r#"
title = "rack"
source = "ours"

[[mode]]
frequency = "5 Hz"
damping_ratio = "2 %"
mass = "100 kg"
shape = { top = 1.0, shelf = 0.5 }

[[mode]]
frequency = "17 Hz"
damping_ratio = "2 %"
mass = "100 kg"
shape = { top = 1.0, shelf = -0.8 }

[[absorber]]
place = "top"
mass = "4 kg"
clearance = "4 mm"
restitution = 0.5

[[absorber]]
place = "shelf"
mass = "2 kg"
clearance = "2 mm"
restitution = 0.6

[[excitation]]
kind = "force"
place = "top"
amplitude = "60 N"
from = "4.5 Hz"
to = "5.5 Hz"

[[excitation]]
kind = "force"
mode = 2
amplitude = "300 N"
frequency = "17 Hz"

[simulation]
starts = 2

[criteria]
peak_displacement = "<= 7 mm"
acceleration = [{ limit = "<= 5 g", place = "shelf" }, { limit = "<= 6 g", place = "shelf" }]
"#;

fn with_sweep(sweep: &str) -> String {
    format!("{RACK}\n[sweep]\n{sweep}\n")
}

fn column<'a>(columns: &'a [Column], name: &str) -> &'a [Option<Cell>] {
    let found = columns.iter().find(|one| one.name == name);
    found.unwrap_or_else(|| panic!("no {name} in {columns:?}")).cells.as_slice()
}

fn number(columns: &[Column], name: &str, point: usize) -> f64 {
    column(columns, name)[point].and_then(Cell::number).expect("a number")
}

/// What `check` says of a case that has a point's numbers as its own.
fn checked(text: &str) -> Value {
    let folder = tempdir().expect("a folder");
    let path = folder.path().join("point.toml");
    fs::write(&path, text).expect("written");
    let mut command = Command::cargo_bin("vinesink").expect("built");
    let path = path.to_str().expect("text");
    let output = command.args(["check", path, "--format", "json"]).output().expect("it runs");
    let told: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    told["cases"][0].clone()
}

/// Each point has what `check` says of a case with its numbers, to the bit: of all loads, of one, of one absorber, at a frequency.
#[test]
fn a_point_is_what_check_says_of_it() {
    let own = ["clearance = \"4 mm\"", "clearance = \"2 mm\"", "restitution = 0.6"];
    let second_load =
        &RACK[RACK.rfind("[[excitation]]").expect("two")..RACK.find("[simulation]").expect("one")];
    let first_load = &RACK
        [RACK.find("[[excitation]]").expect("two")..RACK.rfind("[[excitation]]").expect("two")];
    let at_5_1 = first_load.replace("from = \"4.5 Hz\"\nto = \"5.5 Hz\"", "frequency = \"5.1 Hz\"");
    for (sweep, point, text) in [
        (
            "clearance = { values = [\"3 mm\", \"5 mm\"] }",
            1,
            RACK.replace(own[0], "clearance = \"5 mm\"").replace(own[1], "clearance = \"5 mm\""),
        ),
        (
            "absorber = 2\nexcitation = 1\nclearance = { values = [\"1 mm\", \"3 mm\"] }\nrestitution = { values = [0.3, 0.8] }",
            2,
            RACK.replace(own[1], "clearance = \"3 mm\"")
                .replace(own[2], "restitution = 0.3")
                .replace(second_load, ""),
        ),
        (
            "excitation = 1\nfrequency = { from = \"4.9 Hz\", to = \"5.1 Hz\", count = 2 }\namplitude = { values = [\"30 N\", \"90 N\"] }",
            3,
            RACK.replace(first_load, &at_5_1)
                .replace("\"60 N\"", "\"90 N\"")
                .replace(second_load, ""),
        ),
    ] {
        let case = ModalCase::parse("rack.toml", &with_sweep(sweep)).expect("a case");
        let plan = ModalPlan::of(&case).expect("a sweep");
        let found = plan.points(point..point + 1);
        let told = checked(&text);
        let criteria = told["criteria"].as_array().expect("criteria");
        let names = ["peak_displacement", "acceleration_shelf"];
        for (criterion, name) in criteria.iter().zip(names) {
            assert_eq!(criterion["found"], number(&found, name, 0), "{sweep}: {criterion}");
            let error = number(&found, &format!("error_of_{name}"), 0);
            assert_eq!(criterion["error"], error, "{sweep}: {criterion}");
        }
        let says = |key: &str, value: bool| criteria.iter().any(|one| one[key] == value);
        let worst = if criteria.iter().any(|one| one["holds"] == false && one["decided"] == true) {
            "fails"
        } else if says("decided", false) {
            "not-decided"
        } else if says("near_limit", true) {
            "too-close-to-call"
        } else {
            "holds"
        };
        assert_eq!(column(&found, "limits")[0].and_then(Cell::text), Some(worst), "{sweep}");
        let rooms = criteria.iter().map(|one| {
            let of = |key: &str| one[key].as_f64().expect("a number");
            (of("margin") - of("error")) / (of("found") + of("margin"))
        });
        let least = rooms.fold(f64::INFINITY, f64::min);
        assert!((number(&found, "room", 0) - least).abs() < 1e-12, "{sweep}");
    }
}

/// A criterion that is called as a column of every sweep is told apart from it, and a yes or no has no room.
#[test]
fn criteria_are_told_apart_and_yes_has_no_room() {
    let criteria = RACK.find("[criteria]").expect("criteria");
    let text = |asked: &str| {
        let sweep = "[sweep]\nexcitation = 2\nclearance = { values = [\"3 mm\", \"5 mm\"] }";
        format!("{}[criteria]\n{asked}\n{sweep}\n", &RACK[..criteria])
    };
    let points = |asked: &str| {
        let case = ModalCase::parse("rack.toml", &text(asked)).expect("a case");
        ModalPlan::of(&case).expect("a sweep").points(0..1)
    };
    let found = points("reduction_db = \">= -90\"\nno_coexistence = true");
    let mut names: Vec<&str> = found.iter().map(|one| one.name.as_str()).collect();
    names.sort_unstable();
    assert!(names.windows(2).all(|pair| pair[0] != pair[1]), "{names:?}");
    // Both are of the worst motion, one with its error.
    let [own, asked, error] =
        ["reduction_db", "criterion_reduction_db", "error_of_criterion_reduction_db"]
            .map(|name| number(&found, name, 0));
    assert!((asked - error - own).abs() < 1e-9, "{asked} {error} {own}");
    // Over what halves the motion.
    let room = (asked + 90.0 - error) / 6.0;
    assert!((number(&found, "room", 0) - room).abs() < 1e-12, "{}", number(&found, "room", 0));
    let found = points("no_coexistence = true");
    assert_eq!(column(&found, "room")[0], None);
}

/// The command: chunks that are there are kept, the page says where limits hold, and the table has units.
#[test]
fn the_command_writes_a_table_and_a_page() {
    let folder = tempdir().expect("a folder");
    let path = folder.path().join("rack.toml");
    let text = with_sweep(
        "excitation = 1\nfrequency = { from = \"4.5 Hz\", to = \"5.5 Hz\", count = 5 }\nclearance = { from = \"2 mm\", to = \"6 mm\", count = 3 }",
    );
    fs::write(&path, text).expect("written");
    let run = |arguments: &[&str]| {
        let mut command = Command::cargo_bin("vinesink").expect("built");
        command.current_dir(folder.path()).args(arguments).output().expect("it runs")
    };
    let plan = run(&["sweep", "plan", "rack.toml"]);
    assert!(String::from_utf8_lossy(&plan.stdout).starts_with("5 x 3 = 15 points"), "{plan:?}");
    let output = run(&["sweep", "rack.toml", "--csv"]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let read = |name: &str| {
        fs::read_to_string(folder.path().join("sweeps/rack").join(name)).expect("written")
    };
    let table = read("sweep.csv");
    let head = table.lines().next().expect("a head");
    for word in [
        "frequency [Hz]",
        "clearance [m]",
        "peak [m]",
        "motions",
        "limits",
        "acceleration_shelf [m/s²]",
    ] {
        assert!(head.contains(word), "{word} in {head}");
    }
    assert_eq!(table.lines().count(), 16);
    let page = read("sweep.md");
    assert!(page.contains("limits hold") && page.contains("Excitation 1 alone acts."), "{page}");
    let document: Value = serde_json::from_str(&read("sweep.json")).expect("JSON");
    let hold = table.lines().filter(|line| line.contains(",holds,")).count();
    assert_eq!(document["limits"]["points"], hold);
    // The nearest has the best outcome, and of those the most room; a reduction is what an error leaves of it.
    let cells: Vec<Vec<&str>> =
        table.lines().map(|line| line.split(',').collect::<Vec<_>>()).collect();
    let at = |name: &str| {
        let named = |one: &str| one.split(" [").next() == Some(name);
        cells[0].iter().position(|one| named(one)).expect("a column")
    };
    let number = |row: &[&str], name: &str| row[at(name)].parse::<f64>().expect("a number");
    let order = ["holds", "too-close-to-call", "not-decided", "not-measured", "fails"];
    let outcome = |row: &[&str]| order.iter().position(|word| *word == row[at("limits")]);
    let best = cells[1..].iter().map(|row| outcome(row)).min().expect("points");
    let rooms = cells[1..].iter().filter(|row| outcome(row) == best);
    let most = rooms.map(|row| number(row, "room")).fold(f64::NEG_INFINITY, f64::max);
    assert_eq!(document["limits"]["best"]["of"]["value"], most);
    for row in &cells[1..] {
        let most = number(row, "largest_peak") + number(row, "error_of_largest_peak");
        let left = 20.0 * libm::log10(number(row, "bare_amplitude") / most);
        assert!((number(row, "reduction_db") - left).abs() < 1e-9, "{row:?}");
    }
    // The same bytes when chunks are lost and worked out again.
    let before = fs::read(folder.path().join("sweeps/rack/sweep.parquet")).expect("written");
    fs::remove_file(folder.path().join("sweeps/rack/sweep.parquet")).expect("removed");
    let again = run(&["sweep", "rack.toml"]);
    assert_eq!(again.status.code(), Some(0), "{again:?}");
    let after = fs::read(folder.path().join("sweeps/rack/sweep.parquet")).expect("written");
    assert_eq!(before, after);
}

#[test]
fn slips_are_told() {
    let wrong = |sweep: &str| {
        let error = ModalCase::parse("case.toml", &with_sweep(sweep)).expect_err("refused");
        let told = error.problems().map(|one| {
            format!("{}; {}; {}", one.message, one.expected, one.help.as_deref().unwrap_or(""))
        });
        told.collect::<Vec<_>>().join("\n")
    };
    for (sweep, words) in [
        ("", "the sweep varies nothing; expected at least one of"),
        (
            "frequency = { values = [\"5 Hz\"] }",
            "`frequency` is of one excitation, and there are several",
        ),
        (
            "excitation = 3\nfrequency = { values = [\"5 Hz\"] }",
            "`excitation` is 3, and there are 2",
        ),
        ("absorber = 3\nclearance = { values = [\"5 mm\"] }", "`absorber` is 3, and there are 2"),
        (
            "excitation = 1\nabsorber = 2\nfrequency = { values = [\"5 Hz\"] }",
            "`absorber` has no meaning where no number of an absorber varies",
        ),
        ("clearance = { values = [\"5 kg\"] }", "expected a length such as"),
        ("clearance = { values = [5] }", "expected a length such as"),
        ("restitution = { values = [0.5, 1.5] }", "from 0 to 1"),
        ("excitation = 1\namplitude = { values = [\"5 mm\"] }", "expected a force such as"),
        ("clearance = { from = \"5 mm\", to = \"1 mm\", count = 3 }", "is not below its `to`"),
        ("mass_ratio = { values = [0.1] }", "unknown table `mass_ratio` in [sweep]"),
        ("starts = 0\nclearance = { values = [\"1 mm\"] }", "from 1 to 1000"),
    ] {
        let told = wrong(sweep);
        assert!(told.contains(words), "{sweep}: {told}");
    }
    // A base moves by a length.
    let moved =
        RACK.replace("mass = \"100 kg\"", "mass = \"100 kg\"\nparticipation = 1.2").replacen(
            "kind = \"force\"\nplace = \"top\"\namplitude = \"60 N\"",
            "kind = \"base-displacement\"\namplitude = \"1 mm\"",
            1,
        );
    let sweep = "[sweep]\nexcitation = 1\namplitude = { values = [\"1 mm\", \"2 mm\"] }\n";
    let case = ModalCase::parse("case.toml", &format!("{moved}{sweep}")).expect("a case");
    let columns = ModalPlan::of(&case).expect("a sweep").empty();
    assert_eq!(columns[1].unit, "m", "{columns:?}");
}
