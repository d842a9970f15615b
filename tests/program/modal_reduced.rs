//! Dimensionless structures of several modes: `[reduced]` with `[[reduced.mode]]` and `[[reduced.absorber]]`.

use std::f64::consts::TAU;
use std::fs;

use serde_json::Value;
use tempfile::tempdir;
use vinesink::case::{ModalCase, is_modal};

use super::run::vinesink;

/// A rack in SI; its motion repeats every period, so that it is the same with other rounding.
const PHYSICAL: &str = r#"
title = "rack"
source = "ours"
[[mode]]
frequency = "5 Hz"
damping_ratio = "2 %"
mass = "100 kg"
shape = { top = 1.0, shelf = 0.5 }
[[mode]]
frequency = "17 Hz"
damping_ratio = "1 %"
mass = "80 kg"
shape = { top = 1.0, shelf = -0.8 }
[[absorber]]
place = "top"
mass = "4 kg"
clearance = "4 mm"
restitution = 0.5
[[excitation]]
kind = "force"
place = "top"
amplitude = "150 N"
frequency = "4.97 Hz"
[simulation]
starts = 2
[criteria]
peak_displacement = "<= 7 mm"
rms_velocity = "<= 0.5 m/s"
acceleration = { limit = "<= 1000 m/s2", place = "shelf" }
"#;

/// Its unit of length in m, and of mass in kg.
const LENGTH: f64 = 2e-3;
const MASS: f64 = 5.0;

/// The same in these units.
fn reduced() -> String {
    reduced_at(4.97)
}

/// Where it is driven at another frequency in Hz.
fn reduced_at(frequency: f64) -> String {
    let omega = TAU * 5.0;
    let forcing = |mass: f64| 150.0 / mass / (omega * omega) / LENGTH;
    format!(
        "title = \"rack\"\nsource = \"ours\"\n[simulation]\nstarts = 2\n\
         [reduced]\nfrequency_ratio = {}\n\
         [[reduced.mode]]\nfrequency_ratio = 1\ndamping_ratio = 0.02\nmass = {}\nforcing = {}\nshape = {{ top = 1.0, shelf = 0.5 }}\n\
         [[reduced.mode]]\nfrequency_ratio = 3.4\ndamping_ratio = \"1 %\"\nmass = {}\nforcing = {}\nshape = {{ top = 1.0, shelf = -0.8 }}\n\
         [[reduced.absorber]]\nplace = \"top\"\nmass = {}\nclearance = 2\nrestitution = 0.5\n\
         [criteria]\npeak_displacement = \"<= {}\"\nrms_velocity = \"<= {}\"\nacceleration = {{ limit = \"<= {}\", place = \"shelf\" }}\n",
        frequency / 5.0,
        100.0 / MASS,
        forcing(100.0),
        80.0 / MASS,
        forcing(80.0),
        4.0 / MASS,
        7e-3 / LENGTH,
        0.5 / LENGTH / omega,
        1000.0 / LENGTH / (omega * omega),
    )
}

fn json(text: &str, command: &str) -> Value {
    let folder = tempdir().expect("a folder");
    let path = folder.path().join("case.toml");
    fs::write(&path, text).expect("written");
    let output = vinesink(&[command, path.to_str().expect("text"), "--format", "json"]);
    serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{error}: {output:?}"))
}

#[track_caller]
fn same(found: &Value, scaled: f64, wanted: &Value, what: &str) {
    let [found, wanted] = [found, wanted].map(|one| one.as_f64().expect("a number"));
    let off = (found * scaled / wanted - 1.0).abs();
    // Rounding of the inputs, times the largest multiplier of a motion that repeats.
    assert!(off < 1e-9, "{what}: {found} times {scaled} is not {wanted}");
}

/// Every number is that of the case with units, in its own.
#[test]
fn a_reduced_case_is_the_same_structure() {
    let (text, omega) = (reduced(), TAU * 5.0);
    assert!(is_modal(&text) && !is_modal("[reduced]\nmass_ratio = 0.01\n"));
    let [own, si] = [&text, PHYSICAL].map(|text| json(text, "check")["cases"][0].clone());
    let speed = LENGTH * omega;
    for (k, scale) in [LENGTH, speed, speed * omega].into_iter().enumerate() {
        let [own, si] = [&own, &si].map(|one| &one["criteria"][k]);
        let name = si["name"].as_str().expect("a name");
        assert!(own["name"] == si["name"] && own["unit"] == "1", "{own}");
        same(&own["found"], scale, &si["found"], name);
        same(&own["margin"], scale, &si["margin"], name);
        same(&own["at_value"], 5.0, &si["at_value"], name);
        assert_eq!(own["at_unit"], "1");
    }
    // A list of loads has its own orbits, one excitation those of the document.
    let orbits =
        [&json(&text, "analyze")["orbits"], &json(PHYSICAL, "analyze")["loads"][0]["orbits"]]
            .map(|one| one.as_array().expect("a list").clone());
    assert!(orbits[0].len() == orbits[1].len() && !orbits[0].is_empty(), "{orbits:?}");
    for (own, si) in orbits[0].iter().zip(&orbits[1]) {
        same(&own["impact_times"][0], 1.0 / omega, &si["impact_times"][0], "time");
        same(&own["impact_speeds"][0], speed, &si["impact_speeds"][0], "speed");
        same(&own["spectral_radius"], 1.0, &si["spectral_radius"], "radius");
    }
}

/// What drives it may be said: forces in its modes, and nothing else.
#[test]
fn what_drives_it_may_be_said() {
    let text = reduced();
    let of = |kind: &str| text.replace("[reduced]\n", &format!("[reduced]\nkind = \"{kind}\"\n"));
    let [own, said] = [text.clone(), of("force")].map(|text| json(&text, "analyze"));
    assert_eq!(own["orbits"], said["orbits"]);
    let error = ModalCase::parse("case.toml", &of("base-displacement")).expect_err("no such kind");
    let problem = error.problems().next().expect("one");
    assert!(problem.expected.contains("\"force\"") && problem.line == 6, "{problem:?}");
}

/// Dampers beside it, and its masses on a page, which are over the first mode's.
#[test]
fn its_report_is_that_of_the_same_structure() {
    // Near either mode: a model of the one mode has another time.
    for frequency in [4.97, 16.9] {
        is_that_report(frequency);
    }
}

fn is_that_report(frequency: f64) {
    let folder = tempdir().expect("a folder");
    let si = PHYSICAL.replace("4.97 Hz", &format!("{frequency} Hz"));
    let [own, si] = [("own", reduced_at(frequency)), ("si", si)].map(|(name, text)| {
        let path = folder.path().join(format!("{name}.toml"));
        fs::write(&path, text).expect("written");
        let out = folder.path().join("out");
        let path = path.to_str().expect("text");
        let output = vinesink(&["report", path, "--out", out.to_str().expect("text")]);
        let stored = fs::read_to_string(out.join(name).join("report.json"));
        let page = fs::read_to_string(out.join(name).join("report.md"));
        let stored = stored.unwrap_or_else(|error| panic!("{error}: {output:?}"));
        (serde_json::from_str::<Value>(&stored).expect("JSON"), page.expect("written"))
    });
    assert_eq!(own.0["units"], "reduced");
    let of = |report: &Value, path: &str| report.pointer(path).cloned().expect("there");
    for (path, scale) in [
        ("/quantities/bare_peak/value", LENGTH),
        ("/quantities/damper_peak/value", LENGTH),
        ("/dampers/0/each/0/frequency/value", 5.0),
        ("/dampers/0/each/0/mass/value", 100.0),
        ("/dampers/0/stroke/value", LENGTH),
        ("/absorbers/0/mass/value", 100.0),
        ("/absorbers/0/mass_ratio/value", 1.0),
        ("/modes/1/frequency/value", 5.0),
        // Under fixed forces a softer structure moves farther.
        ("/alternatives/5/worst/value", LENGTH),
        ("/alternatives/7/worst/value", LENGTH),
        ("/alternatives/8/each/0/frequency/value", 5.0),
        ("/loads/0/alone/value", LENGTH),
    ] {
        let [found, wanted] = [&own.0, &si.0].map(|report| of(report, path));
        let [found, wanted] = [found, wanted].map(|one| one.as_f64().expect("a number"));
        // Dampers are searched for to a tolerance.
        assert!((found * scale / wanted - 1.0).abs() < 1e-6, "{path}: {found}, {wanted}");
    }
    for words in ["3.4 f₀", "0.04 m₁", "in all modes", "units"] {
        assert!(own.1.contains(words), "{words} is not in\n{}", own.1);
    }
    assert!(
        !own.1.contains(" Hz") && !own.1.contains(" kg") && !own.1.contains(" mm"),
        "{}",
        own.1
    );
}

/// Better absorbers are written as plain numbers, and a sweep has them.
#[test]
fn it_is_optimised_and_swept_in_its_own_units() {
    let folder = tempdir().expect("a folder");
    let path = folder.path().join("case.toml");
    let more = "[optimize]\nclearance = [2, 9]\n[sweep]\nclearance = { from = 2, to = 9, count = 2 }\nabsorber_mass = { values = [0.4, 0.8] }\n";
    fs::write(&path, reduced() + more).expect("written");
    let better = folder.path().join("better.toml");
    let [path, better, out] = [&path, &better, &folder.path().join("out")]
        .map(|one| one.to_str().expect("text").to_owned());
    vinesink(&["optimize", &path, "--write", &better]);
    if let Ok(text) = fs::read_to_string(&better) {
        let case = ModalCase::parse("better.toml", &text).expect("a case");
        assert!(text.contains(&format!("clearance = {}", case.absorbers[0].clearance_m)), "{text}");
    }
    let output = vinesink(&["sweep", &path, "--out", &out, "--csv"]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let table = fs::read_to_string(format!("{out}/case/sweep.csv")).expect("written");
    assert!(
        table.starts_with("point,clearance,absorber_mass,largest_peak,error_of_largest_peak,"),
        "{table}"
    );
    let page = fs::read_to_string(format!("{out}/case/sweep.md")).expect("written");
    // A mass of 0.8 is 0.04 of the first mode's, 20.
    assert!(page.contains("from 0.02 m₁ to 0.04 m₁"), "{page}");
}

#[test]
fn slips_are_told() {
    for (from, to, words) in [
        (
            "frequency_ratio = 1\n",
            "frequency_ratio = 2\n",
            "the first mode's `frequency_ratio` is 2",
        ),
        ("clearance = 2\n", "clearance = \"2 mm\"\n", "`clearance` is text"),
        ("frequency_ratio = 3.4", "frequency = 3.4", "unknown key `frequency` in [reduced.mode]"),
        (
            "peak_displacement = \"<= ",
            "peak_displacement = \"<= mm ",
            "is no number behind its sign",
        ),
        (
            "[reduced]\n",
            "[[absorber]]\nmass = \"1 kg\"\n[reduced]\n",
            "[absorber] has no meaning beside [reduced]",
        ),
        ("[[reduced.absorber]]", "[[reduced.absorbers]]", "did you mean `absorber`?"),
        (
            "[criteria]\n",
            "[criteria]\nacceleration_upto = 100\n",
            "`acceleration_upto` has no meaning beside [reduced]",
        ),
        ("restitution = 0.5", "restitution = 1.2", "from 0 to 1"),
        (
            "frequency_ratio = 0.994\n",
            "from = 1.1\nto = 0.9\n",
            "the range ends where it begins, or before",
        ),
    ] {
        let good = reduced();
        assert!(good.contains(from), "{from} is not in\n{good}");
        let error =
            ModalCase::parse("case.toml", &good.replacen(from, to, 1)).expect_err("refused");
        let told: Vec<String> = error
            .problems()
            .map(|one| {
                format!("{}; {}; {}", one.message, one.expected, one.help.as_deref().unwrap_or(""))
            })
            .collect();
        assert!(told.join("\n").contains(words), "{to}: {told:?}");
    }
    let still = reduced();
    let at: Vec<&str> = still
        .lines()
        .map(|line| if line.starts_with("forcing") { "forcing = 0" } else { line })
        .collect();
    let error = ModalCase::parse("case.toml", &at.join("\n")).expect_err("nothing drives it");
    assert!(error.problems().any(|one| one.message.contains("every `forcing` is 0")), "{error:?}");
}
