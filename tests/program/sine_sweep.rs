//! Commands on a structure that is swept through resonance.

use serde_json::Value;

use super::run::{message, refused, vinesink};

const CASE: &str = "cases/sweep-fast.toml";

#[test]
fn commands_answer_or_say_that_they_are_about_something_else() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let text = std::fs::read_to_string(CASE).expect("the case");
    // Fewer starts, and criteria of which one cannot hold.
    let quick = "\n[simulation]\nstarts = 2\n[criteria]\npeak_displacement = \"<= 1 mm\"\n";
    let path = folder.join("quick.toml");
    std::fs::write(&path, format!("{text}{quick}")).expect("written");
    let path = path.to_str().expect("UTF-8");

    let simulated = vinesink(&["simulate", path, "--format", "json"]);
    assert_eq!(simulated.status.code(), Some(0), "{simulated:?}");
    let found: Value = serde_json::from_slice(&simulated.stdout).expect("JSON");
    let value = |id: &str| found["quantities"][id]["value"].as_f64().expect(id);
    assert!(value("peak_displacement") < value("bare_peak"));
    assert!((value("sweep_time") - 15.0).abs() < 0.2);
    assert_eq!(found["by_rate"].as_array().map(Vec::len), Some(5));

    let checked = vinesink(&["check", path, "--criteria-only", "--format", "json"]);
    assert_eq!(checked.status.code(), Some(1), "{checked:?}");
    let checked: Value = serde_json::from_slice(&checked.stdout).expect("JSON");
    assert_eq!(checked["cases"][0]["criteria"][0]["found"], value("peak_displacement"));

    let out = folder.join("reports");
    let out = out.to_str().expect("UTF-8");
    assert_eq!(vinesink(&["report", path, "--out", out]).status.code(), Some(0));
    let page = std::fs::read_to_string(format!("{out}/quick/report.md")).expect("a page");
    assert!(page.contains("## Rates") && page.contains("100 mHz/s (this case)"), "{page}");
    for name in ["report.html", "report.json", "figures/envelope.svg", "figures/rates.svg"] {
        assert!(std::fs::exists(format!("{out}/quick/{name}")).is_ok_and(|there| there), "{name}");
    }

    for command in ["analyze", "tradeoff"] {
        let message = message(&[command, CASE]);
        assert!(message.contains("swept through resonance"), "{command}: {message}");
    }
}

/// The case that `optimize` writes does what it says, by `check`: its clearance is within the bounds that are asked for,
/// and not above the best.
#[test]
fn the_best_clearance_is_checked_and_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let [case, better] = ["case.toml", "better.toml"].map(|name| folder.path().join(name));
    let text = std::fs::read_to_string(CASE).expect("the case");
    let text = text.replace("\"7.5 Hz\"", "\"8 Hz\"").replace("\"0.1 Hz/s\"", "\"0.4 Hz/s\"");
    let asked = "\n[criteria]\npeak_displacement = \"<= 20 mm\"\n[optimize]\nclearance = [\"3 mm\", \"30 mm\"]\n";
    std::fs::write(&case, format!("{text}{asked}").replace("\"7.5 mm\"", "\"2 mm\""))
        .expect("written");
    let [case, better] = [&case, &better].map(|path| path.to_str().expect("UTF-8"));
    let json = |arguments: &[&str]| -> Value {
        let output = vinesink(arguments);
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {output:?}");
        serde_json::from_slice(&output.stdout).expect("JSON")
    };
    let found = json(&["optimize", case, "--write", better, "--format", "json"]);
    let number = |of: &Value| of["value"].as_f64().expect("a number");
    let checked = number(&found["checked"]);
    assert!(checked < number(&found["own"]["value"]) && checked < number(&found["alone"]));
    assert!(number(&found["damper"]) < number(&found["alone"]));
    let places = found["landscape"].as_array().expect("clearances");
    let ends = [places.first(), places.last()].map(|one| one.and_then(|one| one[0].as_f64()));
    for (end, bound) in ends.iter().zip([0.003, 0.03]) {
        // As they would be written.
        assert!((end.expect("a number") / bound - 1.0).abs() < 1e-3, "{found}");
    }
    let written = std::fs::read_to_string(better).expect("written");
    let written = vinesink::case::Case::parse(better, &written).expect("a case").design.clearance();
    let best = number(&found["clearance"]);
    assert!(written <= best && written > 0.999 * best, "{written} {best}");
    let judged = json(&["check", better, "--format", "json"]);
    for (k, one) in found["criteria"]["all"].as_array().expect("criteria").iter().enumerate() {
        assert_eq!(judged["cases"][0]["criteria"][k]["found"], one["found"]["value"]);
    }
    assert_eq!(judged["cases"][0]["criteria"][0]["found"], found["checked"]["value"]);
}

#[test]
fn what_a_sweep_cannot_be_is_said() {
    let text = std::fs::read_to_string(CASE).expect("the case");
    let changes = [
        ("\"0.1 Hz/s\"", "\"5 Hz/s\"", "changes by 8.889 % in a period"),
        ("\"9 Hz\"", "\"7.51 Hz\"", "0 whole periods"),
        ("\"0.1 Hz/s\"", "\"0.1 Hz\"", "`Hz` is the unit of a frequency"),
        (
            "\"0.1 Hz/s\"",
            "\"0.1 oct/minute\"",
            "did you mean `oct/min`? a sweep rate is accepted in Hz/s, mHz/s",
        ),
        ("\"0.1 Hz/s\"", "\"0.1 Hz/s\"\nfrequency = \"8 Hz\"", "`frequency` has no meaning"),
        ("\"0.25 mm\"", "\"2.9 N\"", "`N` is the unit of a force"),
        (
            "[excitation]",
            "[band]\nfrom = \"8 Hz\"\nto = \"9 Hz\"\n[excitation]",
            "[band] has no meaning",
        ),
        (
            "[excitation]",
            "[optimize]\nreleases = [0.5, 2]\n[excitation]",
            "`releases` has no meaning in [optimize] for a structure that is swept",
        ),
        (
            "[excitation]",
            "[criteria]\ndecay_time = \"<= 1 s\"\n[excitation]",
            "`decay_time` has no meaning",
        ),
    ];
    refused("simulate", &text, &changes);
}
