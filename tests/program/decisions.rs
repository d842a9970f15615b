//! Decisions over a whole band, on designs that version 0.1 judged wrongly. What is true of them is from an
//! independent simulator, `peers/brute`, where no closed form says it.

use std::path::Path;
use std::process::Output;

use serde_json::Value;

use super::run::vinesink;

fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{error}: {output:?}"))
}

/// One criterion of a check.
fn criterion(path: &str, name: &str) -> Value {
    let document = json(&vinesink(&["check", path, "--criteria-only", "--format", "json"]));
    let criteria = document["cases"][0]["criteria"].as_array().expect("criteria");
    criteria.iter().find(|one| one["name"] == name).expect(name).clone()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// The largest displacement over the band with its error, by a check.
fn peak(path: &str) -> [f64; 2] {
    let found = criterion(path, "peak_displacement");
    [number(&found["found"]), number(&found["error"])]
}

/// The case's text with other lines, in a file of a folder.
fn changed(folder: &Path, name: &str, from: &str, to: &str) -> String {
    let text = std::fs::read_to_string(format!("tests/decisions/{name}.toml")).expect("a case");
    assert!(text.contains(from), "{name} has no {from}");
    let path = folder.join(format!("{name}.toml"));
    std::fs::write(&path, text.replace(from, to)).expect("written");
    path.to_str().expect("UTF-8").to_owned()
}

/// The text up to its deviations, with criteria that any of its designs meets: nothing else is written down.
fn within_reach(text: &str) -> String {
    let (before, rest) = text.split_once("[criteria]").expect("criteria");
    let (_, after) = rest.split_once("\n[").expect("a table after them");
    format!("{before}[criteria]\npeak_displacement = \"<= 1 m\"\n\n[{after}")
}

/// The same without deviations, which are the last table.
fn without_deviations(text: &str) -> &str {
    text.split_once("[uncertainty]").expect("its last table").0
}

/// The peak hides between even places: at 10.66 mm it is 133.4 mm at 2.0835 Hz, at 50 mm 97.7 mm (`peers/brute`, 231
/// frequencies). At 104.4 mm irregular motions have 75 mm, an absorber that a sudden start does not wake 94 mm, and one that
/// a force which grows slowly leaves one place in a hundred 99 % of the clearance.
#[test]
fn the_worst_of_a_band_is_that_of_a_dense_scan() {
    let folder = tempfile::tempdir().expect("a folder");
    for (clearance, truth) in
        [("10.66", 0.1334), ("14.4", 0.1270), ("50", 0.0977), ("104.4", 0.99 * 0.1044)]
    {
        let path = changed(
            folder.path(),
            "bridge",
            "clearance = \"50 mm\"",
            &format!("clearance = \"{clearance} mm\""),
        );
        let [found, error] = peak(&path);
        println!("{clearance} mm: {found} (+{error}) m, {truth} m");
        // A regular peak is known to 2 %, and an irregular one to its error.
        assert!((found / truth - 1.0).abs() < 0.02, "{clearance} mm: {found} {truth}");
    }
}

/// What `optimize` claims is what `check` says of the file it wrote; it is not worse than the start (97.7 mm),
/// and within 5 % of brute force: 74.26 mm at 74.05 mm (`peers/brute`, an absorber at rest
/// counted where the structure alone does not reach a wall).
#[test]
#[ignore = "deep"]
fn an_optimum_keeps_its_word_over_the_whole_band() {
    let folder = tempfile::tempdir().expect("a folder");
    let better = folder.path().join("better.toml");
    let better = better.to_str().expect("UTF-8");
    // Bounds around the best: those of the case are a matter of CI, with the program in release.
    let bounds = ("clearance = [\"5 mm\", \"300 mm\"]", "clearance = [\"60 mm\", \"150 mm\"]");
    let path = changed(folder.path(), "bridge", bounds.0, bounds.1);
    let text = std::fs::read_to_string(&path).expect("written");
    // What no absorber meets is told after few starts as after many.
    let few = format!("{}[simulation]\nstarts = 2\n", without_deviations(&text));
    std::fs::write(&path, few).expect("written");
    // 8 mm is out of reach, and a tuned mass damper of the same mass would have 12.9 mm.
    let out = folder.path().to_str().expect("UTF-8");
    let arguments = ["optimize", &path, "--write", better, "--out", out, "--format", "json"];
    let output = vinesink(&arguments);
    let document = json(&output);
    assert_eq!((output.status.code(), &document["feasible"]), (Some(1), &Value::Bool(false)));
    assert!(!Path::new(better).exists(), "what meets no criterion is not written");
    let damper = number(&document["tuned_mass_damper"]["peak"]["value"]);
    assert!((damper / 0.0129 - 1.0).abs() < 0.01, "{damper}");
    let page = Path::new(&path).with_extension("").join("optimize.md");
    let told = std::fs::read_to_string(page).expect("a page");
    assert!(told.contains("No absorber between the bounds meets all criteria."), "{told}");
    assert!(told.contains("A tuned mass damper of the same mass"), "{told}");
    std::fs::write(&path, within_reach(without_deviations(&text))).expect("written");
    let document = json(&vinesink(&["optimize", &path, "--write", better, "--format", "json"]));
    let claimed = number(&document["claimed"]["value"]);
    let [checked, error] = peak(better);
    println!("claimed {claimed} m, checked {checked} (+{error}) m, {}", document["optimum"]);
    assert_eq!((claimed, number(&document["checked"]["value"])), (checked, checked));
    assert!(checked + error < peak("tests/decisions/bridge.toml")[0]);
    assert!(checked + error < 1.05 * 0.07426, "{checked} (+{error})");
}

/// The bare structure has 149.6 mm at resonance: from rest an absorber within 50 mm of the middle of its
/// cavity of 200 mm never wakes, a quarter of its resting places.
#[test]
fn an_absorber_that_never_wakes_fails_the_criterion() {
    let path = "tests/decisions/inactive.toml";
    let found = criterion(path, "peak_displacement");
    // F/(k 2 zeta): 250 N, 1200 kg, 2.1 Hz, 0.4 %.
    let omega = std::f64::consts::TAU * 2.1;
    let bare = 250.0 / (1200.0 * omega * omega) / 0.008;
    assert!((number(&found["found"]) / bare - 1.0).abs() < 1e-3, "{found}");
    assert_eq!(found["holds"], false);
    let share = number(&found["inactive_share"]);
    assert!((share - (1.0 - bare / 0.2)).abs() < 0.01, "{share}");
    let text = vinesink(&["check", path, "--criteria-only"]);
    let text = String::from_utf8_lossy(&text.stdout);
    assert!(text.contains("absorber inactive from 25 % of resting places"), "{text}");
    // A device in which it cannot rest there is judged by its other motions, visibly.
    let folder = tempfile::tempdir().expect("a folder");
    let path =
        changed(folder.path(), "inactive", "[criteria]", "[criteria]\ncount_inactive = false");
    let [awake, error] = peak(&path);
    assert!(awake < bare, "{awake} (+{error})");
    // The largest motion is strongly modulated: windows of it have peaks from 72 to 130 mm, and the error
    // that is said covers that.
    assert!(awake + error > 0.13 && error < 0.5 * awake, "{awake} (+{error})");
    let text = vinesink(&["check", &path, "--criteria-only"]);
    let text = String::from_utf8_lossy(&text.stdout);
    assert!(text.contains("an inactive absorber is not counted"), "{text}");
}

/// A motion inside a band is not larger than the largest of the band.
#[test]
fn no_place_of_a_band_exceeds_its_worst() {
    let folder = tempfile::tempdir().expect("a folder");
    let with = "[criteria]\ncount_inactive = false";
    let band = peak(&changed(folder.path(), "inactive", "[criteria]", with));
    let text = std::fs::read_to_string("tests/decisions/inactive.toml").expect("a case");
    let table = "[band]\nfrom = \"1.9 Hz\"\nto = \"2.3 Hz\"\n";
    assert!(text.contains(table));
    let alone = folder.path().join("alone.toml");
    for frequency in ["2.05 Hz", "2.1 Hz", "2.12 Hz"] {
        let text = text.replace(table, "").replace("[criteria]", with);
        let text = text.replacen(
            "frequency = \"2.1 Hz\"\n\n[criteria]",
            &format!("frequency = \"{frequency}\"\n\n[criteria]"),
            1,
        );
        std::fs::write(&alone, text).expect("written");
        let [found, _] = peak(alone.to_str().expect("UTF-8"));
        assert!(found <= band[0] + band[1], "{frequency}: {found} above {band:?}");
    }
}

/// More damping, and a circuit board under base motion: what is claimed is what is checked, and better than
/// the start.
#[test]
#[ignore = "deep"]
fn other_optima_keep_their_word() {
    let folder = tempfile::tempdir().expect("a folder");
    // Close around the best: the whole range is looked at by the agreement of all commands.
    let cases = [
        ("bridge", "\"0.4 %\"", "\"2 %\"", "\"5 mm\", \"300 mm\"", "\"20 mm\", \"35 mm\""),
        ("board", "\"0.3 %\"", "\"0.3 %\"", "\"0.05 mm\", \"2 mm\"", "\"0.9 mm\", \"2 mm\""),
    ];
    for (name, damping, other, bounds, around) in cases {
        let path = changed(folder.path(), name, damping, other);
        let text = std::fs::read_to_string(&path).expect("written").replace(bounds, around);
        std::fs::write(&path, within_reach(without_deviations(&text))).expect("written");
        let better = folder.path().join(format!("better-{}.toml", other.len() + bounds.len()));
        let better = better.to_str().expect("UTF-8");
        let document = json(&vinesink(&["optimize", &path, "--write", better, "--format", "json"]));
        let [checked, error] = peak(better);
        let start = peak(&path);
        println!("{name} {other}: {checked} (+{error}) m, start {start:?}");
        assert_eq!(number(&document["claimed"]["value"]), checked, "{name} {other}");
        assert!(checked + error < start[0], "{name} {other}: {checked} (+{error}), {start:?}");
        std::fs::remove_file(better).expect("written");
    }
}

/// The robust optimum is judged as the optimum is: its worst corner is what `check` says of the corners of its
/// deviations, none of which is worse; and it is not worse than the start.
#[test]
#[ignore = "deep"]
fn a_robust_optimum_keeps_its_word_at_the_corners() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = changed(folder.path(), "bridge", "\"0.4 %\"", "\"2 %\"");
    let text = std::fs::read_to_string(&path).expect("written");
    let around = text.replace("\"5 mm\", \"300 mm\"", "\"20 mm\", \"45 mm\"");
    std::fs::write(&path, within_reach(&around)).expect("written");
    let robust = folder.path().join("robust.toml");
    let robust = robust.to_str().expect("UTF-8");
    let arguments = ["optimize", &path, "--robust", "--write", robust, "--format", "json"];
    let document = json(&vinesink(&arguments));
    let said = &document["robust"];
    let [checked, error] = peak(robust);
    println!("{said}, checked {checked} (+{error}) m");
    assert_eq!(number(&said["value"]), checked);
    assert!(checked + error <= peak(&path)[0]);
    let clearance = number(&said["clearance"]);
    let text = std::fs::read_to_string(robust).expect("written");
    let line = |key: &str| {
        let found = text.lines().find(|line| line.starts_with(&format!("{key} = ")));
        found.unwrap_or_else(|| panic!("{key} in {text}")).to_owned()
    };
    // Uniform up to 5 mm; two standard deviations of 0.05.
    let corners = [-5e-3, 5e-3].into_iter().flat_map(|off| [0.5, 0.7].map(|r| (off, r)));
    let found = corners.map(|(off, restitution)| {
        let there = text
            .replacen(&line("clearance"), &format!("clearance = \"{} m\"", clearance + off), 1)
            .replacen(&line("restitution"), &format!("restitution = {restitution}"), 1);
        std::fs::write(&path, there).expect("written");
        peak(&path)
    });
    let worst =
        found.fold(
            [0.0; 2],
            |worst: [f64; 2], one| {
                if one[0] + one[1] > worst[0] + worst[1] { one } else { worst }
            },
        );
    println!("worst corner {worst:?} m");
    // A survey knows its worst peak to 2 %.
    let claimed = number(&said["worst_corner"]);
    let worst = worst[0] + worst[1];
    assert!((claimed / worst - 1.0).abs() < 0.02, "{claimed} m, {worst} m by check");
    let expected = number(&said["expected"]);
    assert!(expected < claimed && expected > 0.9 * checked, "{expected} m");
}
