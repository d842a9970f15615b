//! How far a promise holds, against `check` at its ends; and what a case is held against, in words and in numbers.

use serde_json::Value;

use super::run::vinesink;

fn checked(path: &str, more: &[&str]) -> Value {
    let arguments = [&["check", path, "--format", "json"], more].concat();
    let output = vinesink(&arguments);
    let document: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    document["cases"][0].clone()
}

/// Whether a criterion fails by what was found, and not by its error alone.
fn fails(checked: &Value) -> bool {
    let criteria = checked["criteria"].as_array().expect("criteria");
    criteria
        .iter()
        .any(|one| one["holds"] == false && one["near_limit"] == false && one["decided"] != false)
}

/// The text with another number behind the first of some keys that it has.
fn with(text: &str, keys: &[&str], value: f64, unit: &str) -> String {
    let key = keys.iter().find(|key| text.contains(&format!("\n{key} = "))).expect("a key");
    let line = text.lines().find(|line| line.starts_with(&format!("{key} = "))).expect("a line");
    let quoted = if unit == "1" { format!("{value:?}") } else { format!("\"{value:?} {unit}\"") };
    text.replacen(line, &format!("{key} = {quoted}"), 1)
}

/// At the ends of a range `check` finds nothing that fails, and beyond them, by a fifth of the way from the case, it does; on
/// designs that nobody tuned to.
#[test]
fn ranges_end_where_check_says_so() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut ends = 0;
    for name in [
        "tests/designs/floor",
        "tests/designs/footbridge",
        "cases/arm-empty",
        "tests/decisions/board",
        "tests/designs/pipe",
    ] {
        let mut text = std::fs::read_to_string(format!("{name}.toml")).expect("a case");
        // Two of them fail as they are; what is asked of them is twice as much here as they have.
        if name.ends_with("board") || name.ends_with("pipe") {
            let (before, rest) = text.split_once("[criteria]").expect("criteria");
            let after =
                rest.split_once("\n[").map_or(String::new(), |(_, after)| format!("[{after}"));
            let plain = format!("{before}{after}");
            let path = folder.path().join("plain.toml");
            std::fs::write(
                &path,
                format!("{before}[criteria]\npeak_displacement = \"<= 1 m\"\n\n{after}"),
            )
            .expect("written");
            let found = checked(path.to_str().expect("UTF-8"), &["--criteria-only"]);
            let peak = found["criteria"][0]["found"].as_f64().expect("a peak");
            text = plain.replacen(
                before,
                &format!("{before}[criteria]\npeak_displacement = \"<= {:?} m\"\n\n", 1.5 * peak),
                1,
            );
        }
        let path = folder.path().join("case.toml");
        let path = path.to_str().expect("UTF-8");
        std::fs::write(path, &text).expect("written");
        let found = checked(path, &[]);
        let ranges = found["holds_for"].as_array().expect("ranges");
        assert!(ranges.len() >= 6, "{name}: {found}");
        for range in ranges {
            let keys: &[&str] = match range["parameter"].as_str() {
                Some("amplitude") => &["amplitude", "velocity"],
                Some("clearance") => &["clearance"],
                _ => continue,
            };
            let number = |key: &str| range[key].as_f64().expect(key);
            let unit = range["unit"].as_str().expect("a unit");
            for (end, open) in [("from", "from_open"), ("to", "to_open")] {
                let (at, own) = (number(end), number("value"));
                let there = |value: f64| {
                    std::fs::write(path, with(&text, keys, value, unit)).expect("written");
                    fails(&checked(path, &["--criteria-only"]))
                };
                assert!(!there(at), "{name} {keys:?}: fails at {at}, {range}");
                if range[open] == false {
                    let beyond = at + 0.2 * (at - own) + 0.02 * (at - own).signum() * own;
                    assert!(there(beyond), "{name} {keys:?}: holds at {beyond}, {range}");
                    ends += 1;
                }
            }
        }
    }
    assert!(ends >= 12, "{ends} ends");
}

/// Criteria alone: no device beside the absorber, no range.
#[test]
fn criteria_alone_are_judged_alone() {
    let of = |more: &[&str]| checked("cases/arm-empty.toml", more);
    let (whole, alone) = (of(&[]), of(&["--criteria-only"]));
    assert_eq!(whole["criteria"], alone["criteria"]);
    assert!(whole["alternatives"].as_array().is_some_and(|rows| rows.len() > 20), "{whole}");
    assert_eq!(alone["alternatives"], Value::Null);
    assert!(whole["holds_for"].as_array().is_some_and(|rows| rows.len() == 8), "{whole}");
    // One answer: the absorber's row is what the criterion found.
    let row = &whole["alternatives"][0];
    assert_eq!(row["device"], "absorber");
    assert_eq!(row["worst"]["value"], whole["criteria"][0]["found"]);
}
