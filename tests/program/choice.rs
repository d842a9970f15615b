//! How far a promise holds, against `check` at its ends; and what a case is held against, in words and in numbers.

use serde_json::Value;
use vinesink::answer::{Answer, Asked};
use vinesink::case::Case;
use vinesink::executor::Serial;
use vinesink::operating_range::{HoldsFor, Reliability, Together, Varied, holds_for};

use super::run::vinesink;

pub fn checked(path: &str, more: &[&str]) -> Value {
    let arguments = [&["check", path, "--format", "json"], more].concat();
    let output = vinesink(&arguments);
    let document: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    document["cases"][0].clone()
}

/// Whether a criterion fails by what was found, and not by its error alone.
pub fn fails(checked: &Value) -> bool {
    let criteria = checked["criteria"].as_array().expect("criteria");
    criteria
        .iter()
        .any(|one| one["holds"] == false && one["near_limit"] == false && one["decided"] != false)
}

/// The text with another number behind the first of some keys that it has.
pub fn with(text: &str, keys: &[&str], value: f64, unit: &str) -> String {
    let key = keys.iter().find(|key| text.contains(&format!("\n{key} = "))).expect("a key");
    let line = text.lines().find(|line| line.starts_with(&format!("{key} = "))).expect("a line");
    let quoted = if unit == "1" { format!("{value:?}") } else { format!("\"{value:?} {unit}\"") };
    text.replacen(line, &format!("{key} = {quoted}"), 1)
}

/// At the ends of a range `check` finds nothing that fails, and beyond them, by a fifth of the way from the case, it does; on
/// designs that nobody tuned to.
#[test]
fn ranges_end_where_check_says_so() {
    ranges_end(&["tests/designs/floor"], [2, 2]);
}

#[test]
#[ignore = "deep"]
fn ranges_of_six_designs_end_where_check_says_so() {
    let designs = [
        "tests/designs/floor",
        "tests/designs/footbridge",
        "cases/arm-empty",
        // Beside it few starts miss a motion that many find.
        "cases/mast-mode-3",
        "tests/decisions/board",
        "tests/designs/pipe",
    ];
    ranges_end(&designs, [12, 12]);
}

/// At least so many ends are found and so many checks hold.
fn ranges_end(designs: &[&str], least: [usize; 2]) {
    let folder = tempfile::tempdir().expect("a folder");
    let [mut ends, mut held] = [0; 2];
    for name in designs {
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
        let case = Case::parse(path, &text).unwrap_or_else(|error| panic!("{name}: {error:?}"));
        let effort = case.effort();
        let own = Answer::of(&case, Asked::Criteria, None, &Serial).expect("judged");
        // Those that a line of the case says; of all eight a report tells.
        let numbers = [Varied::Amplitude, Varied::Clearance];
        let ranges = holds_for(&case, &own.judged, &numbers, Together::Undecided, &effort, &Serial)
            .expect("ranges");
        assert_eq!(ranges.len(), 2, "{name}");
        for range in ranges {
            let keys: &[&str] = match range.parameter {
                Varied::Amplitude => &["amplitude", "velocity"],
                _ => &["clearance"],
            };
            let parameter = range.parameter.parameter(&case).expect("it has it");
            let unit = case.design.kind(parameter).dimension.symbol(true);
            for (end, at) in range.range.into_iter().enumerate() {
                let own = range.value;
                let there = |value: f64| {
                    std::fs::write(path, with(&text, keys, value, unit)).expect("written");
                    fails(&checked(path, &["--criteria-only"]))
                };
                assert!(!there(at), "{name} {keys:?}: fails at {at}, {range:?}");
                if !range.open[end] {
                    let beyond = at + 0.2 * (at - own) + 0.02 * (at - own).signum() * own;
                    assert!(there(beyond), "{name} {keys:?}: holds at {beyond}, {range:?}");
                    ends += 1;
                }
            }
            // Where all criteria are said to hold `check` says so.
            for at in range.holds.into_iter().flatten() {
                std::fs::write(path, with(&text, keys, at, unit)).expect("written");
                let there = checked(path, &["--criteria-only"]);
                assert_eq!(there["holds"], true, "{name} {keys:?}: not at {at}, {range:?}");
                held += 1;
            }
        }
    }
    assert!(ends >= least[0] && held >= least[1], "{ends} ends, {held} of what holds");
}

/// A range that goes to where no absorber is needed says so: a structure at resonance moves by x_st/(2 zeta) without one.
#[test]
fn a_range_says_where_the_structure_alone_keeps_the_limit() {
    let text = "title = 't'\nsource = 's'\n[oscillator]\nmass = \"10 kg\"\nfrequency = \"5 Hz\"\ndamping_ratio = 0.02\n\
                [absorber]\nmass = \"0.5 kg\"\nclearance = \"0.8 mm\"\nrestitution = 0.5\n\
                [excitation]\nkind = \"force\"\namplitude = \"0.7 N\"\nfrequency = \"5 Hz\"\n\
                [criteria]\npeak_displacement = \"<= 1.2 mm\"\n";
    let case = Case::parse("case.toml", text).expect("valid");
    let judged = Answer::of(&case, Asked::Criteria, None, &Serial).expect("judged").judged;
    let (all, effort) = ([Varied::Amplitude], case.effort());
    let ranges = holds_for(&case, &judged, &all, Together::Hold, &effort, &Serial);
    let range = ranges.expect("ranges").remove(0);
    let stiffness = 10.0 * libm::pow(std::f64::consts::TAU * 5.0, 2.0);
    let alone = |force: f64| force / (stiffness * 0.04) <= 1.2e-3;
    let ends = range.holds.expect("it holds");
    println!("{ends:?} N, the limit alone at {} N", 1.2e-3 * stiffness * 0.04);
    assert_eq!((alone(range.value), range.kept_alone), (false, ends.map(alone)), "{range:?}");
    assert_eq!(range.kept_alone, [true, false]);
}

/// What is said of an amplitude and a natural frequency that change at once is what `check` says of that case, on designs that
/// nobody tuned to: what fails there fails, and what holds does not fail.
#[test]
#[ignore = "deep"]
fn combinations_are_what_check_says_of_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("case.toml");
    let path = path.to_str().expect("UTF-8");
    let (mut seen, mut promised) = ([0; 2], 0);
    for name in ["tests/designs/floor", "cases/arm-empty"] {
        let text = std::fs::read_to_string(format!("{name}.toml")).expect("a case");
        std::fs::write(path, &text).expect("written");
        let out = folder.path().join("out");
        vinesink(&["report", path, "--out", out.to_str().expect("UTF-8")]);
        let report = std::fs::read(out.join("case/report.json")).expect("a report");
        let report: Value = serde_json::from_slice(&report).expect("JSON");
        let own = report["holds_for"].as_array().expect("ranges");
        let unit = |name: &str| {
            let row = own.iter().find(|row| row["parameter"] == name).expect(name);
            (row["value"].as_f64().expect("a value"), row["unit"].as_str().expect("a unit"))
        };
        let ((_, of_amplitude), (_, hertz)) = (unit("amplitude"), unit("natural-frequency"));
        for one in report["combined"].as_array().expect("combinations") {
            let value = |key: &str| one[key]["value"].as_f64().expect(key);
            let (amplitude, frequency) = (value("amplitude"), value("natural_frequency"));
            let there = with(&text, &["amplitude", "velocity"], amplitude, of_amplitude);
            let there = with(&there, &["frequency"], frequency, hertz);
            std::fs::write(path, there).expect("written");
            let there = checked(path, &["--criteria-only"]);
            let fails = fails(&there);
            // What the verdict counts: there errors count too.
            if one["promised"] == true {
                assert_eq!(one["outcome"] == "hold", there["holds"] == true, "{name}: {one}");
                promised += 1;
            }
            match one["outcome"].as_str() {
                Some("fail") => {
                    assert!(fails, "{name} holds at {one}");
                    seen[0] += 1;
                }
                Some("hold") => {
                    assert!(!fails, "{name} fails at {one}");
                    seen[1] += 1;
                }
                _ => {}
            }
        }
    }
    assert!(seen[0] >= 5 && seen[1] >= 5, "{seen:?} fail and hold");
    assert!(promised >= 8, "{promised} that a verdict counts");
}

/// Two changes that a design stands alone, and at the ends of both, it may not stand together: at 660 N this chimney keeps
/// 51 mm, as another integrator with 600 steps a period finds too, and with a frequency 5 % lower it does not keep 60 mm (that
/// integrator: 62 mm).
#[test]
#[ignore = "deep"]
fn what_the_ends_alone_would_miss_is_found() {
    const CHIMNEY: &str = r#"
title = "Chimney"
source = "constructed"

[oscillator]
mass = "9 t"
frequency = "0.8 Hz"
damping_ratio = "0.4 %"

[absorber]
mass_ratio = "8 %"
clearance = "34.53 mm"
restitution = 0.3

[excitation]
kind = "force"
amplitude = "600 N"
frequency = "0.8 Hz"

[band]
from = "0.72 Hz"
to = "0.88 Hz"

[criteria]
peak_displacement = "<= 60 mm"
"#;
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("case.toml");
    std::fs::write(&path, CHIMNEY).expect("written");
    let out = folder.path().join("out");
    let [path, out_text] = [&path, &out].map(|one| one.to_str().expect("UTF-8"));
    vinesink(&["report", path, "--out", out_text]);
    let report = std::fs::read(out.join("case/report.json")).expect("a report");
    let report: Value = serde_json::from_slice(&report).expect("JSON");
    let ends = |name: &str| {
        let all = report["holds_for"].as_array().expect("ranges");
        all.iter().find(|row| row["parameter"] == name).expect(name)["holds"].clone()
    };
    let (amplitudes, frequencies) = (ends("amplitude"), ends("natural-frequency"));
    let is_end = |one: &Value, key: &str, of: &Value| {
        of.as_array().expect("two ends").contains(&one[key]["value"])
    };
    let counted = report["combined"].as_array().expect("combinations").iter();
    let counted: Vec<&Value> = counted.filter(|one| one["promised"] == true).collect();
    let fails = |one: &&&Value| one["outcome"] == "fail";
    let corners = counted.iter().filter(|one| {
        is_end(one, "amplitude", &amplitudes) && is_end(one, "natural_frequency", &frequencies)
    });
    assert_eq!(corners.clone().count(), 4, "{counted:?}");
    assert_eq!(corners.filter(fails).count(), 0, "{counted:?}");
    assert_eq!(counted.iter().filter(fails).count(), 1, "{counted:?}");
}

/// Criteria alone: no device beside the absorber, no range.
#[test]
#[ignore = "deep"]
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

/// An absorber that friction holds leaves a linear structure with its mass, whose peak is proportional to its force: with a normal error of
/// the force the limit lies at one standard deviation, and the probability is that of the normal distribution there.
#[test]
fn the_probability_of_a_linear_structure_is_that_of_the_normal_distribution() {
    const NORMAL_AT_1: f64 = 0.841_344_746;
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("linear.toml");
    let (stiffness, ratio, damping): (f64, f64, f64) = (4000.0, 0.5, 0.05);
    let inertia = 1.01 * ratio * ratio;
    let response = 1.0 / libm::hypot(1.0 - inertia, 2.0 * damping * ratio);
    let limit = 8.0 * 1.1 / stiffness * response;
    let text = format!(
        "title = 't'\nsource = 's'\n[oscillator]\nmass = \"1 kg\"\nstiffness = \"{stiffness:?} N/m\"\n\
         damping_ratio = {damping:?}\n[absorber]\nmass = \"10 g\"\nclearance = \"1 m\"\nrestitution = 0.5\nfriction = 1.0\n\
         [excitation]\nkind = \"force\"\namplitude = \"8 N\"\nfrequency = \"{:?} Hz\"\n\
         [criteria]\npeak_displacement = \"<= {limit:?} m\"\n\
         [uncertainty]\namplitude = \"0.8 N\"\nclearance = \"10 mm\"\nsamples = 1000\n",
        ratio * stiffness.sqrt() / std::f64::consts::TAU
    );
    std::fs::write(&path, text).expect("written");
    let found = &checked(path.to_str().expect("UTF-8"), &[])["reliability"];
    let end = |k: usize| found["interval"][k]["value"].as_f64().expect("an end");
    assert!(end(0) < NORMAL_AT_1 && NORMAL_AT_1 < end(1), "{found}");
    // 1.96 standard errors of 1000 draws are 2.3 %; nothing is undecided, as all is exact.
    assert!(end(1) - end(0) < 0.05 && found["undecided"] == 0, "{found}");
    let count = |key: &str| found[key].as_u64().expect("a count");
    assert_eq!(count("hold") + count("fail"), 1000, "{found}");
    assert_eq!(found["causes"][0]["parameter"], "amplitude");
    assert_eq!(found["causes"][0]["failures"], found["examined"]);
    assert_eq!(found["causes"].as_array().map(Vec::len), Some(1), "{found}");
}

/// The share of designs that `check` passes, each a case file of its own with errors drawn here, against the probability.
#[test]
fn the_probability_is_the_share_of_designs_that_check_passes() {
    const DESIGNS: u32 = 200;
    let folder = tempfile::tempdir().expect("a folder");
    let text = std::fs::read_to_string("cases/li2016-8p5hz-fig4c.toml").expect("a case");
    let text = format!(
        "{text}\n[criteria]\npeak_displacement = \"<= 3.7 mm\"\ncount_inactive = false\n\n[simulation]\nstarts = 6\n"
    );
    let path = folder.path().join("uncertain.toml");
    let uncertain = "\n[uncertainty]\nclearance = \"± 2 mm\"\namplitude = \"± 0.02 mm\"\nrestitution = \"± 0.05\"\n";
    std::fs::write(&path, format!("{text}{uncertain}")).expect("written");
    let found = &checked(path.to_str().expect("UTF-8"), &[])["reliability"];
    // Additive recurrences of three irrational numbers fill the box evenly.
    let (mut hold, mut undecided) = (0, 0);
    let mut paths = Vec::new();
    for k in 1..=DESIGNS {
        let error = |step: f64, largest: f64| largest * (2.0 * (step * f64::from(k)).fract() - 1.0);
        let mut text = with(&text, &["clearance"], 20.0 + error(0.819_172_513_396, 2.0), "mm");
        text = with(&text, &["amplitude"], 0.25 + error(0.671_043_606_704, 0.02), "mm");
        text = with(&text, &["restitution"], 0.6 + error(0.549_700_477_901, 0.05), "1");
        let path = folder.path().join(format!("design-{k}.toml"));
        std::fs::write(&path, text).expect("written");
        paths.push(path.to_str().expect("UTF-8").to_owned());
    }
    let mut arguments = vec!["check", "--criteria-only", "--format", "json"];
    arguments.extend(paths.iter().map(String::as_str));
    let document: Value = serde_json::from_slice(&vinesink(&arguments).stdout).expect("JSON");
    for case in document["cases"].as_array().expect("cases") {
        let holds = case["holds"] == true;
        hold += u32::from(holds);
        undecided += u32::from(!holds && !fails(case));
    }
    let share = |count: u32| f64::from(count) / f64::from(DESIGNS);
    let end = |k: usize| found["interval"][k]["value"].as_f64().expect("an end");
    // Evenly spread designs are some percent off themselves at most: their share has no more than a third of the error of
    // as many that are drawn.
    let own = 0.03;
    assert!(end(0) - own < share(hold + undecided), "{hold} {undecided} {found}");
    assert!(share(hold) < end(1) + own, "{hold} {undecided} {found}");
    assert!(hold > 40 && hold < 180, "both happen: {hold} {undecided}");
}

/// A damper that bears more drift bears every smaller one: what it does at worst is no better. Of every shipped report.
#[test]
fn a_damper_for_more_drift_is_no_better() {
    let mut compared = 0;
    for folder in std::fs::read_dir("reports").expect("reports") {
        let path = folder.expect("a folder").path().join("report.json");
        let Ok(text) = std::fs::read_to_string(&path) else { continue };
        let report: Value = serde_json::from_str(&text).expect("JSON");
        let rows = report["alternatives"].as_array().into_iter().flatten();
        let robust: Vec<&Value> = rows.filter(|one| one["which"] == "robust-damper").collect();
        for one in &robust {
            let of = |row: &Value| row["worst"]["value"].as_f64().expect("a number");
            let alike = robust.iter().filter(|other| other["dampers"] == one["dampers"]);
            for other in alike.filter(|other| other["drift"].as_f64() > one["drift"].as_f64()) {
                // A simplex for little drift ends up to so far beside what a simplex for more finds.
                assert!(of(other) >= 0.999 * of(one), "{}: {one} {other}", path.display());
                compared += 1;
            }
        }
    }
    assert!(compared > 30, "{compared}");
}

/// A level in decibels compares two peaks at two frequencies; where the absorber is worse than none at one frequency the band says
/// so, and a search there and the closed form of the structure alone say the same.
#[test]
fn a_band_says_where_the_absorber_is_worse_than_none() {
    const NATURAL: f64 = 6.894;
    let text = std::fs::read_to_string("cases/mast-mode-2.toml").expect("a case");
    let text = text.split_once("[criteria]").expect("criteria").0;
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mast.toml");
    let path = path.to_str().expect("UTF-8");
    std::fs::write(path, text).expect("written");
    vinesink(&["report", path, "--out", folder.path().to_str().expect("UTF-8")]);
    let report = std::fs::read(folder.path().join("mast/report.json")).expect("a report");
    let report: Value = serde_json::from_slice(&report).expect("JSON");
    let worse = &report["band"]["worse"];
    // By the closed form of the structure alone.
    let bare = |hertz: f64| {
        let natural = std::f64::consts::TAU * NATURAL;
        let stiffness = 30.0 * natural * natural;
        let ratio = hertz / NATURAL;
        14.07 / stiffness / libm::hypot(1.0 - ratio * ratio, 2.0 * 0.005 * ratio)
    };
    let ratios = report["places"].as_array().expect("places").iter().map(|place| {
        let counts = place["motions"].as_array().expect("motions").iter();
        let peaks =
            counts.filter(|one| one["counts"] == true).map(|one| one["peak"]["value"].as_f64());
        let peak = peaks.map(|one| one.expect("a peak")).fold(0.0, f64::max);
        peak / bare(place["at"].as_f64().expect("a place"))
    });
    let ratios: Vec<f64> = ratios.collect();
    let count = ratios.iter().filter(|ratio| **ratio > 1.01).count();
    assert_eq!([&worse["count"], &worse["of"]], [count, ratios.len()]);
    assert!(0 < count && count < ratios.len(), "{worse}");
    let hertz = worse["at"]["value"].as_f64().expect("a frequency");
    // The second frequency of the file is that of the force; the search is at it alone.
    let (structure, rest) = text.split_once("[excitation]").expect("a force");
    let excitation = rest.split_once("[band]").expect("a band").0;
    let there = with(excitation, &["frequency"], hertz, "Hz");
    std::fs::write(path, format!("{structure}[excitation]{there}")).expect("written");
    let found = vinesink(&["simulate", path, "--format", "json"]);
    let found: Value = serde_json::from_slice(&found.stdout).expect("JSON");
    let motions = found["motions"].as_array().expect("motions");
    let peaks = motions.iter().filter_map(|one| one["peak"]["value"].as_f64());
    let peak = peaks.fold(0.0, f64::max);
    let most = worse["most"].as_f64().expect("a ratio");
    // A peak of a motion that does not repeat is what was seen in one run or another.
    assert!((peak / bare(hertz) / most - 1.0).abs() < 0.05, "{peak} m and {most}");
}

/// A structure that is driven at one frequency: mass, natural frequency, damping ratio, absorber, clearance, restitution, force,
/// its frequency, and the largest displacement that is asked for.
fn driven(
    [mass, hertz, damping, absorber, clearance, restitution, force, at, limit]: [f64; 9],
) -> String {
    format!(
        "title = 't'\nsource = 's'\n[oscillator]\nmass = \"{mass:?} kg\"\nfrequency = \"{hertz:?} Hz\"\n\
         damping_ratio = {damping:?}\n[absorber]\nmass = \"{absorber:?} kg\"\nclearance = \"{clearance:?} m\"\n\
         restitution = {restitution:?}\ninclination = \"0.0 rad\"\n[excitation]\nkind = \"force\"\n\
         amplitude = \"{force:?} N\"\nfrequency = \"{at:?} Hz\"\n[criteria]\npeak_displacement = \"<= {limit:?} m\"\n"
    )
}

/// One whose motion wanders, with an error that reaches the limit with some clearances.
const WANDERS: [f64; 9] = [
    4.214234688595195,
    25.148522407192015,
    0.007482023634801036,
    0.3918853992501443,
    0.0011180259648442528,
    0.4,
    18.67786697155288,
    25.151715368046954,
    0.0013675522286967384,
];

/// Where a range is told `check` holds at every design that was tried, first of all close to the case: in steps of half of the
/// tolerance where that is stated. A search that judged its steps by fewer starts, and began a fiftieth away, told of stretches
/// in which `check` fails: of the first by its amplitude and clearance, of the second by its tilt.
#[test]
fn all_criteria_hold_at_every_design_that_was_tried() {
    let first = [
        1.2163048250089792,
        23.46930409285462,
        0.0054174768425583174,
        0.07035946232988434,
        0.0007776324733504057,
        0.301,
        1.7925392327954894,
        23.781267516119424,
        0.0006935166236554767,
    ];
    let second = [
        4.624608774105471,
        3.756169584177345,
        0.006263862806129511,
        0.07909689750541998,
        0.00027388110706417064,
        0.415,
        0.020279888807387236,
        3.747065410179219,
        0.0002828045289481739,
    ];
    let third = [
        18.978943768838743,
        0.6474654511831506,
        0.0148265515135668,
        0.7051335405786774,
        0.0010219765597645175,
        0.4,
        0.022601736128704017,
        0.6468798230423702,
        0.0012071893206184894,
    ];
    let uncertain = format!(
        "{}[uncertainty]\nclearance = \"± 0.000004 m\"\namplitude = \"0.0002 N\"\n",
        driven(third)
    );
    let cases = [
        (driven(first), [Varied::Amplitude, Varied::Clearance], [0.0; 2]),
        (driven(second), [Varied::Amplitude, Varied::Inclination], [0.0; 2]),
        // A normal error is likely up to twice its deviation.
        (uncertain, [Varied::Amplitude, Varied::Clearance], [0.0001, 0.000_002]),
    ];
    let mut texts = Vec::new();
    for (text, numbers, half) in cases {
        let case = Case::parse("case.toml", &text).expect("a case");
        let own = Answer::of(&case, Asked::Criteria, None, &Serial).expect("judged").judged;
        let effort = case.effort();
        let ranges = holds_for(&case, &own, &numbers, Together::Hold, &effort, &Serial);
        let before = texts.len();
        for (range, half) in ranges.expect("ranges").iter().zip(half) {
            let [from, to] = range.holds.expect("it holds");
            let ends = [from, range.value, to].map(|end| range.tried.contains(&end));
            assert_eq!(ends, [true; 3], "{range:?}");
            assert!(range.tried.iter().all(|at| (from..=to).contains(at)), "{range:?}");
            let nearest = range.tried.iter().map(|at| (at - range.value).abs());
            let nearest = nearest.filter(|off| *off > 0.0).fold(f64::INFINITY, f64::min);
            if half > 0.0 {
                for step in 1..=2 {
                    let at = range.value + f64::from(step) * half;
                    let there = range.tried.iter().any(|one| (one - at).abs() < 1e-9 * at);
                    assert!(at > to || there, "{at} in {range:?}");
                }
                assert!(nearest < 1.001 * half, "{nearest} in {range:?}");
            } else if range.tried.len() > 1 && range.value > 0.0 {
                assert!(nearest <= 0.01 * range.value, "{range:?}");
            }
            let (key, unit) = match range.parameter {
                Varied::Amplitude => ("amplitude", "N"),
                Varied::Clearance => ("clearance", "m"),
                _ => ("inclination", "rad"),
            };
            // The last line of that name is that of a tolerance.
            let design = text.split_once("[uncertainty]").map_or(text.as_str(), |one| one.0);
            texts.extend(range.tried.iter().map(|at| with(design, &[key], *at, unit)));
        }
        assert!(texts.len() > before + 20, "{}", texts.len() - before);
    }
    each_holds(&texts);
}

/// By `check`.
fn each_holds(texts: &[String]) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |k: usize| folder.path().join(format!("{k}.toml")).display().to_string();
    let paths: Vec<String> = (0..texts.len()).map(path).collect();
    for (path, text) in paths.iter().zip(texts) {
        std::fs::write(path, text).expect("written");
    }
    let mut arguments = vec!["check", "--criteria-only", "--format", "json"];
    arguments.extend(paths.iter().map(String::as_str));
    let document: Value = serde_json::from_slice(&vinesink(&arguments).stdout).expect("JSON");
    let found = document["cases"].as_array().expect("cases");
    assert_eq!(found.len(), texts.len());
    for (text, one) in texts.iter().zip(found) {
        assert_eq!(one["holds"], true, "{text}{one}");
    }
}

/// Along a band few starts say that criteria hold where all of them do not decide it.
#[test]
#[ignore = "deep"]
fn what_few_starts_found_was_not_tried() {
    let text = std::fs::read_to_string("cases/cryogenic-bracket.toml").expect("a case");
    let case = Case::parse("case.toml", &text).expect("a case");
    let (effort, numbers) = (case.effort(), [Varied::Amplitude]);
    let own = Answer::of(&case, Asked::Criteria, None, &Serial).expect("judged").judged;
    let ranges = holds_for(&case, &own, &numbers, Together::Hold, &effort, &Serial);
    let HoldsFor { tried, reached, holds, .. } = &ranges.expect("ranges")[0];
    let [from, to] = holds.expect("it holds");
    let within = reached.iter().filter(|[at, _]| (from..=to).contains(at)).count();
    assert!(tried.len() > 2 && tried.len() < within, "{tried:?} {reached:?}");
    let texts = tried.iter().map(|at| with(&text, &["amplitude"], *at, "N"));
    each_holds(&texts.collect::<Vec<_>>());
}

/// How many designs were tried stands beside every range, on the terminal as in numbers.
#[test]
fn a_range_says_how_many_designs_were_tried() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("case.toml");
    let text = driven([10.0, 5.0, 0.02, 0.5, 0.8e-3, 0.5, 0.7, 5.0, 1.2e-3]);
    std::fs::write(&path, text).expect("written");
    let path = path.to_str().expect("UTF-8");
    let document = checked(path, &[]);
    let told = String::from_utf8(vinesink(&["check", path]).stdout).expect("UTF-8");
    for row in &document["holds_for"].as_array().expect("ranges")[..2] {
        let tried = row["tried"].as_array().expect("values").len();
        assert!(told.contains(&format!("at every one of {tried} designs tried for ")), "{told}");
    }
}

/// Designs that are not decided are none that hold: the probability counts what `check` says of designs that are drawn here,
/// within the chance of so many draws, and the three numbers stand beside one another.
#[test]
fn what_is_not_decided_does_not_count_as_holding() {
    const DESIGNS: u32 = 60;
    let folder = tempfile::tempdir().expect("a folder");
    let design = driven(WANDERS);
    let text = format!(
        "{design}[uncertainty]\nclearance = \"± {:?} m\"\nsamples = {DESIGNS}\n",
        0.02 * WANDERS[4]
    );
    let case = Case::parse("case.toml", &text).expect("a case");
    let found = Reliability::of(&case, &case.effort(), &Serial).expect("flown").expect("uncertain");
    let mut paths = Vec::new();
    for k in 0..DESIGNS {
        let off = 0.02 * (2.0 * (f64::from(k) + 0.5) / f64::from(DESIGNS) - 1.0);
        let path = folder.path().join(format!("{k}.toml"));
        std::fs::write(&path, with(&design, &["clearance"], (1.0 + off) * WANDERS[4], "m"))
            .expect("written");
        paths.push(path.to_str().expect("UTF-8").to_owned());
    }
    let mut arguments = vec!["check", "--criteria-only", "--format", "json"];
    arguments.extend(paths.iter().map(String::as_str));
    let document: Value = serde_json::from_slice(&vinesink(&arguments).stdout).expect("JSON");
    let cases = document["cases"].as_array().expect("cases");
    let held = cases.iter().filter(|one| one["holds"] == true).count() as f64;
    let failed = cases.iter().filter(|one| fails(one)).count() as f64;
    let undecided = f64::from(DESIGNS) - held - failed;
    println!("{held} hold, {undecided} undecided, {failed} fail; {found:?}");
    let (share, [least, most]) = found.probability();
    assert_eq!(share, f64::from(found.hold) / f64::from(DESIGNS));
    assert!(least < share && share < most, "{found:?}");
    // Two standard errors of a half are 13 % of the draws; strata err by less.
    let near = |a: u32, b: f64| (f64::from(a) - b).abs() <= 0.13 * f64::from(DESIGNS);
    assert!(near(found.hold, held) && near(found.undecided, undecided), "{found:?}");
    assert!(undecided > 5.0, "{undecided} are not decided");
}
