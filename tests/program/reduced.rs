//! Commands on a structure without units that is not driven steadily.

use std::fs;
use std::path::Path;

use serde_json::Value;

use super::run::{message, refused, vinesink};

const HEAD: &str = "title = \"t\"\nsource = \"s\"\n[simulation]\nstarts = 2\n[reduced]\nmass_ratio = 0.02\n\
    damping = 1.5\nrestitution = 0.6\nclearance = 2.0\n";
const FREE: &str = "kind = \"free\"\ndisplacement = 3.0\n";
const SWEEP: &str =
    "kind = \"sine-sweep\"\nof = \"force\"\nforcing = 3.0\nfrom = 0.95\nto = 1.05\nrate = 0.001\n";
const RECORD: &str = "kind = \"record\"\nquantity = \"force\"\nfile = \"record.csv\"\n";

fn written(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    fs::write(&path, text).expect("written");
    path.to_str().expect("UTF-8").to_owned()
}

fn json(arguments: &[&str]) -> Value {
    let output = vinesink(arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {output:?}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// Without absorber the amplitude falls as `exp(-eps lambda tau/2)`, to 40 % in 61.1/omega0.
#[test]
fn every_command_answers_for_a_release() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = format!(
        "{HEAD}{FREE}[criteria]\ndecay_level = \"40 %\"\ndecay_time = \"<= 100\"\npeak_displacement = \"<= 3\"\n"
    );
    let case = written(folder.path(), "case.toml", &text);
    let [out, better] = ["out", "better.toml"].map(|name| folder.path().join(name));
    let [out, better] = [&out, &better].map(|path| path.to_str().expect("UTF-8"));
    let time = |found: &Value, id: &str| found["quantities"][id]["value"].as_f64().expect("a time");
    let alone = -libm::log(0.4) / (0.5 * 0.02 * 1.5);
    for command in ["analyze", "simulate"] {
        let found = json(&[command, &case, "--format", "json"]);
        assert!((time(&found, "bare_decay_time") / alone - 1.0).abs() < 1e-12, "{command}");
        assert_eq!(found["units"], "reduced");
    }
    let checked = json(&["check", &case, "--format", "json"]);
    assert_eq!(checked["cases"][0]["criteria"].as_array().map(Vec::len), Some(2));
    assert_eq!(vinesink(&["report", &case, "--out", out]).status.code(), Some(0));
    let page = fs::read_to_string(format!("{out}/case/report.md")).expect("a page");
    assert!(page.contains("instead of 61.1 /ω₀ without it"), "{page}");
    assert!(page.contains("| This absorber | "), "{page}");
    for si in [" mm", " ms", " s ", "Hz"] {
        assert!(!page.contains(si), "{si}: {page}");
    }
    assert_eq!(vinesink(&["index", out]).status.code(), Some(0));
    assert_eq!(vinesink(&["diff", out, out]).status.code(), Some(0));
    let found = json(&["optimize", &case, "--write", better, "--format", "json"]);
    let own = found["own"]["value"]["value"].as_f64();
    assert!(found["checked"]["value"].as_f64() < own, "{found}");
    let best = json(&["simulate", better, "--format", "json"]);
    assert_eq!(best["quantities"]["clearance"]["value"], {
        let text = fs::read_to_string(better).expect("written");
        let line = text.lines().find(|line| line.starts_with("clearance")).expect("a clearance");
        line.split(' ').nth(2).and_then(|number| number.parse::<f64>().ok()).expect("a number")
    });
}

/// 0.1 over a rate of 0.001; whole periods end a little before.
#[test]
fn a_sweep_and_a_record_have_pages_without_units() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let sample = |k: u32| format!("{k},{:?}\n", libm::sin(f64::from(k)));
    let samples: String = (0..20).map(sample).collect();
    written(folder, "record.csv", &format!("time,force\n{samples}"));
    let sweep = written(folder, "sweep.toml", &format!("{HEAD}{SWEEP}"));
    let record = written(folder, "record.toml", &format!("{HEAD}{RECORD}"));
    let out = folder.join("out");
    let out = out.to_str().expect("UTF-8");
    assert_eq!(vinesink(&["report", &sweep, &record, "--out", out]).status.code(), Some(0));
    let read = |name: &str| fs::read_to_string(format!("{out}/{name}")).expect(name);
    let page = read("sweep/report.md");
    assert!(page.contains("In the sweep from 0.95 f₀ to 1.05 f₀"), "{page}");
    assert!(page.contains("| 0.001 f₀ω₀ (this case) |"), "{page}");
    assert!(read("sweep/figures/rates.svg").contains("(f₀ω₀)"));
    let found: Value = serde_json::from_str(&read("sweep/report.json")).expect("JSON");
    let time = found["quantities"]["sweep_time"]["value"].as_f64().expect("a time");
    assert!((94.0..=100.0).contains(&time), "{time}");
    let page = read("record/report.md");
    assert!(page.contains("20 samples over 19 /ω₀, at most 1 k₁ units"), "{page}");
    let wrong = format!("time (s),force (N)\n{samples}");
    written(folder, "record.csv", &wrong);
    let told = message(&["simulate", &record]);
    assert!(told.contains("`s` is the unit of a time") && told.contains("time,value"), "{told}");
}

#[test]
fn what_has_no_meaning_is_refused() {
    let free = format!("{HEAD}{FREE}");
    let changes = [
        ("displacement = 3.0", "", "nothing sets the oscillator in motion"),
        ("displacement = 3.0", "velocity = 0", "nothing sets the oscillator in motion"),
        ("displacement = 3.0", "displacement = \"5 mm\"", "is text, where a plain number belongs"),
        ("displacement = 3.0", "displacement = -1", "`displacement` is -1"),
        // Rounding hides a wall at a distance of 2 there.
        ("displacement = 3.0", "displacement = 1e17", "is not finite"),
        ("displacement", "forcing", "`forcing` has no meaning in [reduced] with kind = \"free\""),
        ("displacement", "detuning", "`detuning` has no meaning"),
        ("displacement", "impulse", "`impulse` has no meaning"),
        ("\"free\"", "\"impulse\"", "`impulse` or `velocity` is missing"),
        ("kind = \"free\"", "", "no meaning in [reduced] with kind = \"base-displacement\""),
        ("kind = \"free\"", "", "`forcing` is missing"),
        ("kind = \"free\"", "", "`frequency_ratio` or `detuning` is missing"),
        ("\"free\"", "\"noise\"", "expected \"base-displacement\", \"force\", \"free\""),
        ("[reduced]", "[band]\nfrom = 0.9\nto = 1.1\n[reduced]", "[band] has no meaning"),
    ];
    refused("simulate", &free, &changes);
    let swept = format!("{HEAD}{SWEEP}");
    let changes = [
        ("rate = 0.001", "rate = -0.001", "`rate` is -0.001"),
        ("rate = 0.001", "rate = \"0.1 Hz/s\"", "is text, where a plain number belongs"),
        ("rate = 0.001", "", "`rate` is missing"),
        // 2 pi 0.01/0.95^2.
        ("rate = 0.001", "rate = 0.01", "the frequency changes by 6.962 % in a period"),
        ("to = 1.05", "to = 0.951", "the sweep has 0 whole periods"),
        ("forcing = 3.0", "", "`forcing` is missing"),
        ("of = \"force\"", "frequency_ratio = 1", "`of` is missing"),
        ("of = \"force\"", "frequency_ratio = 1", "`frequency_ratio` has no meaning"),
    ];
    refused("simulate", &swept, &changes);
    let spectrum = format!("{HEAD}{RECORD}spectrum = [[1, 1], [2, 1]]\n");
    refused("simulate", &spectrum, &[("t", "t", "`spectrum` belongs in [excitation]")]);
}
