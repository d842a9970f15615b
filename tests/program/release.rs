//! Commands on a structure that is released or struck.

use std::fs;

use serde_json::Value;
use vinesink::case::Case;
use vinesink::executor::Serial;
use vinesink::flights::Places;
use vinesink::measure::Measure;
use vinesink::transient::{DecayStudy, Study};

use super::run::{message, refused, vinesink};

const CASE: &str = "cases/footbridge-jump.toml";

fn json(arguments: &[&str], code: i32) -> Value {
    let output = vinesink(arguments);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {output:?}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// One number for one question, whichever command is asked: without absorber `ln 10/(zeta omega0)`, 36.6 s, which an
/// absorber in the very middle of a cavity wider than the swing leaves as it is.
#[test]
#[ignore = "deep"]
fn all_commands_say_the_same() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().to_str().expect("UTF-8");
    let simulated = json(&["simulate", CASE, "--format", "json"], 0);
    let theory = json(&["analyze", CASE, "--format", "json"], 0);
    let checked = json(&["check", CASE, "--format", "json"], 1);
    assert_eq!(vinesink(&["report", CASE, "--out", out]).status.code(), Some(0));
    let folder = format!("{out}/footbridge-jump");
    let text = fs::read_to_string(format!("{folder}/report.json")).expect("a report");
    let report: Value = serde_json::from_str(&text).expect("JSON");
    let time = |of: &Value, id: &str| of["quantities"][id]["value"].as_f64().expect("a number");
    let alone = std::f64::consts::LN_10 / (0.005 * std::f64::consts::TAU * 2.0);
    assert!((time(&theory, "bare_decay_time") / alone - 1.0).abs() < 1e-12);
    assert_eq!(report["quantities"], simulated["quantities"]);
    for id in ["decay_time", "bare_decay_time"] {
        assert!((time(&report, id) / alone - 1.0).abs() < 1e-12, "{id}");
    }
    let criteria = checked["cases"][0]["criteria"].as_array().expect("criteria");
    let asked = criteria.iter().find(|one| one["name"] == "decay_time").expect("asked");
    assert_eq!(asked["found"], report["quantities"]["decay_time"]["value"]);
    assert!(time(&report, "active_decay_time") < 0.35 * alone);
    let page = fs::read_to_string(format!("{folder}/report.md")).expect("a page");
    let first: Vec<&str> = page.lines().take(6).collect();
    assert!(
        first[2].contains("FAILS (1 of 2)") && first[2].contains("in 36.6 s, as without it"),
        "{page}"
    );
}

/// The case that `optimize` writes does what it says, by `check`.
#[test]
fn the_best_clearance_is_checked_and_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let [case, better] = ["case.toml", "better.toml"].map(|name| folder.path().join(name));
    let text = fs::read_to_string(CASE).expect("the case").replace("\"<= 10 s\"", "\"<= 20 s\"");
    fs::write(&case, text.replace("releases", "# releases")).expect("written");
    let [case, better] = [&case, &better].map(|path| path.to_str().expect("UTF-8"));
    let found = json(&["optimize", case, "--write", better, "--format", "json"], 0);
    let [claimed, checked] = ["claimed", "checked"].map(|id| found[id]["value"].as_f64());
    let (claimed, checked) = (claimed.expect("a time"), checked.expect("a time"));
    assert!((claimed / checked - 1.0).abs() < 0.1, "{claimed} {checked}");
    let judged = json(&["check", better, "--format", "json"], 0);
    let time = &judged["cases"][0]["criteria"].as_array().expect("criteria")[1]["found"];
    assert_eq!(time.as_f64(), Some(checked));
}

/// Let go at 3 mm, the structure swings back to 3 mm exp(-0.005 pi): a resting absorber in a clearance above the mean of
/// both, 2.9766 mm, may be where no wall reaches it. The larger the clearance below, the sooner the structure is down to
/// a half, so that the best is rounded into that trap by any other direction than down.
#[test]
fn a_written_clearance_is_not_above_the_best() {
    let folder = tempfile::tempdir().expect("a folder");
    let [path, better] = ["case.toml", "better.toml"].map(|name| folder.path().join(name));
    let text = fs::read_to_string(CASE).expect("the case").replace("releases", "# releases");
    let text = text.replace("kind = \"impulse\"", "kind = \"free\"");
    let text = text.replace("impulse = \"150 N s\"", "displacement = \"3 mm\"");
    let text = text.replace("\"<= 10 s\"", "\"<= 8 s\"\ndecay_level = 0.5");
    let text = text.replace("\"1 mm\", \"10 mm\"", "\"2.97656 mm\", \"2.9766 mm\"");
    fs::write(&path, &text).expect("written");
    let [path, better] = [&path, &better].map(|path| path.to_str().expect("UTF-8"));
    let inactive = |text: &str| {
        let case = Case::parse("case.toml", text).expect("a case");
        (case.design.clearance(), DecayStudy::by_theory(&case).expect("released").inactive.share)
    };
    assert!(inactive(&text.replace("\"3 mm\"\nrest", "\"2.977 mm\"\nrest")).1 > 0.0);
    let found = json(&["optimize", path, "--write", better, "--format", "json"], 0);
    let best = found["optimum"]["clearance"].as_f64().expect("a number");
    let (clearance, share) = inactive(&fs::read_to_string(better).expect("written"));
    assert!(clearance <= best && clearance > 0.999 * best && share == 0.0, "{clearance} {share}");
    let judged = json(&["check", better, "--format", "json"], 0);
    for (k, one) in found["criteria"]["all"].as_array().expect("criteria").iter().enumerate() {
        assert_eq!(judged["cases"][0]["criteria"][k]["found"], one["found"]["value"]);
    }
}

#[test]
fn what_has_no_meaning_is_refused() {
    let told = message(&["tradeoff", CASE]);
    assert!(told.contains("released or struck"), "{told}");
    let told = message(&["simulate", CASE, "--discard", "10"]);
    assert!(told.contains("--discard has no meaning for a structure that is released"), "{told}");
    let text = fs::read_to_string(CASE).expect("the case");
    let changes = [
        ("impulse = \"150 N s\"", "impulse = \"150 N\"", "is the unit of a force"),
        (
            "impulse = \"150 N s\"",
            "frequency = \"2 Hz\"",
            "no meaning in [excitation] with kind = \"impulse\"",
        ),
        ("impulse = \"150 N s\"", "velocity = \"0 m/s\"", "nothing sets the oscillator in motion"),
        ("impulse = \"150 N s\"", "", "`impulse` or `velocity` is missing"),
        (
            "decay_time = \"<= 10 s\"",
            "z3_share = \">= 80 %\"",
            "has no meaning for a structure that is released",
        ),
        ("decay_time = \"<= 10 s\"", "rms_velocity = \"<= 1 m/s\"", "ask for `peak_velocity`"),
        (
            "[criteria]",
            "[band]\nfrom = \"1 Hz\"\nto = \"2 Hz\"\n[criteria]",
            "[band] has no meaning",
        ),
        ("[criteria]", "[simulation]\nperiods = 3\n[criteria]", "`periods` has no meaning"),
        ("[criteria]", "[report]\nfigures = [\"areas\"]\n[criteria]", "`figures` has no meaning"),
        (
            "releases",
            "objective = \"margin\"\nreleases",
            "`objective` has no meaning in [optimize]",
        ),
    ];
    refused("analyze", &text, &changes);
}

/// Every impact of a release, a sweep and a record, from a chosen start, as the single engine flies it: the gap is closed at
/// each, and restitution holds.
#[test]
fn impacts_of_every_kind_are_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("impacts.csv");
    let file = file.to_str().expect("UTF-8");
    for (case, restitution) in
        [(CASE, 0.6), ("cases/sweep-fast.toml", 0.6), ("cases/tower-record.toml", 0.6)]
    {
        let started = json(
            &["simulate", case, "--initial", "0,0.9,0.5,0", "--impacts", file, "--format", "json"],
            0,
        );
        assert_eq!(started["start"], serde_json::json!([0.0, 0.9, 0.5, 0.0]));
        let text = fs::read_to_string(file).expect("written");
        let rows: Vec<Vec<f64>> = text
            .lines()
            .skip(1)
            .map(|line| line.split(',').map(|cell| cell.parse().expect("a number")).collect())
            .collect();
        assert_eq!(started["impacts"]["value"].as_f64(), Some(rows.len() as f64), "{case}");
        assert!(rows.len() > 5 && rows.windows(2).all(|two| two[0][0] < two[1][0]), "{case}");
        for row in rows {
            let (before, after) = (row[3] - row[5], row[4] - row[6]);
            assert!((after + restitution * before).abs() < 1e-9 * (1.0 + before.abs()), "{row:?}");
        }
        // From the worst place where none is chosen, for a while.
        let worst = json(&["simulate", case, "--periods", "12", "--format", "json"], 0);
        let full = json(&["simulate", case, "--impacts", file, "--format", "json"], 0);
        let long = |of: &Value| of["duration"]["value"].as_f64().expect("a time");
        assert!(long(&worst) < long(&full), "{case}");
        let said = json(&["simulate", case, "--format", "json"], 0);
        let id = if case == CASE { "active_decay_time" } else { "peak_displacement" };
        let own = if case == CASE { &full["decay_time"] } else { &full["peak"] };
        let of_study = &said["quantities"][id]["value"];
        assert_eq!(own["value"], *of_study, "{case}");
    }
}

/// Where nothing happens, the sentences say so, and no number is without limit.
#[test]
fn what_does_not_happen_is_said() {
    let folder = tempfile::tempdir().expect("a folder");
    let written = |name: &str, text: String| {
        let path = folder.path().join(name);
        fs::write(&path, text).expect("written");
        path.to_str().expect("UTF-8").to_owned()
    };
    let sweep = fs::read_to_string("cases/sweep-fast.toml").expect("the case");
    let still = written("still.toml", sweep.replace("\"0.25 mm\"", "\"0 mm\""));
    let released = fs::read_to_string(CASE).expect("the case").replace("impulse\"", "free\"");
    let little = written(
        "little.toml",
        released.replace("impulse = \"150 N s\"", "displacement = \"1 nm\""),
    );
    let out = folder.path().join("out");
    let out = out.to_str().expect("UTF-8");
    assert_eq!(vinesink(&["report", &still, &little, "--out", out]).status.code(), Some(0));
    for (name, sentence) in [
        ("still", "Nothing excites the structure in the sweep"),
        ("little", "From no place does the absorber hit a wall"),
    ] {
        let page = fs::read_to_string(format!("{out}/{name}/report.md")).expect("a page");
        let case = if name == "still" { &still } else { &little };
        let told = String::from_utf8(vinesink(&["simulate", case]).stdout).expect("UTF-8");
        for text in [&page, &told] {
            assert!(text.contains(sentence) && !text.contains("without limit"), "{text}");
        }
    }
}

/// A structure that is let go: mass, natural frequency, damping ratio, absorber, clearance, restitution and displacement.
fn let_go([mass, hertz, damping, absorber, clearance, restitution, from]: [f64; 7]) -> String {
    format!(
        "title = 't'\nsource = 's'\n[oscillator]\nmass = \"{mass:?} kg\"\nfrequency = \"{hertz:?} Hz\"\n\
         damping_ratio = {damping:?}\n[absorber]\nmass = \"{absorber:?} kg\"\nclearance = \"{clearance:?} m\"\n\
         restitution = {restitution:?}\n[excitation]\nkind = \"free\"\ndisplacement = \"{from:?} m\"\n\
         [criteria]\ndecay_time = \"<= 1000 s\"\n"
    )
}

const LET_GO: [[f64; 7]; 3] = [
    [37.689_31, 1.513_504, 0.008_395_775, 2.241_567, 0.003_703_672, 0.607, 0.009_074_807],
    [120.0, 4.2, 0.006, 4.1, 0.002, 0.52, 0.007],
    [2.5, 17.0, 0.004, 0.08, 0.000_4, 0.71, 0.001_3],
];

/// What was flown is the worst of a share of all places, and no more is said: wherever such a number stands that share stands
/// beside it.
#[test]
fn the_share_of_places_is_said_beside_their_worst() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("out");
    let with_criteria = |name: &str, criteria: &str| {
        let text = fs::read_to_string(format!("cases/{name}.toml")).expect("a case");
        let before = text.split_once("[criteria]").map_or(text.as_str(), |(before, _)| before);
        let before = before.replace("\"tower-record.csv\"", "\"record.csv\"");
        format!("{before}\n[criteria]\n{criteria}\n")
    };
    fs::copy("cases/tower-record.csv", folder.path().join("record.csv")).expect("copied");
    let cases = [
        ("let-go", let_go(LET_GO[0])),
        ("sweep", with_criteria("sweep-fast", "peak_displacement = \"<= 1 m\"")),
        ("record", with_criteria("tower-record", "rms_displacement = \"<= 1 m\"")),
    ];
    for (name, text) in cases {
        let path = folder.path().join(format!("{name}.toml"));
        fs::write(&path, text).expect("written");
        let [path, out] = [&path, &out].map(|path| path.to_str().expect("UTF-8"));
        let told =
            |arguments: &[&str]| String::from_utf8(vinesink(arguments).stdout).expect("UTF-8");
        let checked = told(&["check", path, "--criteria-only"]);
        assert!(checked.contains(", worst of 95.4 % of places"), "{checked}");
        assert!(checked.contains("at most 4.6 % of all places are worse"), "{checked}");
        let json = json(&["check", path, "--criteria-only", "--format", "json"], 0);
        let sample = &json["cases"][0]["criteria"][0]["sample"];
        assert_eq!((&sample["even"], &sample["all"]), (&64.into(), &96.into()), "{sample}");
        assert!((sample["share_above"].as_f64().expect("a share") - 0.045_7).abs() < 1e-3);
        let simulated = told(&["simulate", path]);
        assert!(
            simulated.contains("from the worst of 95.4 % of the absorber's places"),
            "{simulated}"
        );
        let mut all = vec![checked, simulated];
        // Those of a sweep and of a record take long.
        if name == "let-go" {
            vinesink(&["report", path, "--out", out]);
            let page = |kind: &str| fs::read_to_string(format!("{out}/{name}/report.{kind}"));
            let pages = ["md", "html"].map(|kind| page(kind).expect("a page"));
            let said = "from the worst of 95.4 % of the absorber's places";
            assert!(pages[0].contains(said), "{}", pages[0]);
            all.extend(pages);
        }
        for text in all {
            assert!(!text.contains("worst place of the absorber"), "{text}");
        }
    }
}

/// 2000 even places of three releases and of a sweep, none of which is one that a study flies: some are worse than the worst
/// that the study has, so that this is not that of all places, and no more of them than it says.
#[test]
fn no_larger_share_of_places_is_worse_than_is_said() {
    let of = |even, closer| Places { even, closer, shaking: false, executor: &Serial };
    let shares = LET_GO.map(|numbers| {
        let case = Case::parse("case.toml", &let_go(numbers)).expect("a case");
        let (system, units, release) =
            (case.system(), case.units(), case.design.release().expect("released"));
        let starts = |places| {
            let study = DecayStudy::of(&system, &units, &release, case.decay_level, places);
            study.expect("flown").starts
        };
        let told = starts(of(64, true));
        let [worst, _] = told.largest(Measure::DecayTime).expect("flown");
        let all = starts(of(2000, false)).all;
        let worse = all.iter().filter(|(_, one)| one.oscillations > worst).count();
        (worse as f64 / all.len() as f64, told.sample().share_above())
    });
    println!("{shares:?}");
    assert!(shares.iter().all(|(share, most)| share <= most), "{shares:?}");
    assert!(shares.iter().any(|(share, _)| *share > 0.0), "{shares:?}");
    let text = fs::read_to_string("cases/sweep-fast.toml").expect("the case");
    let case = Case::parse("case.toml", &text).expect("a case");
    let starts = |places| match Study::brief_of_case(&case, places).expect("a sweep") {
        Ok(Study::Sweep(study)) => study.starts,
        other => panic!("{other:?}"),
    };
    let told = starts(of(64, true));
    let [worst, _] = told.largest(Measure::Peak).expect("flown");
    let all = starts(of(500, false)).all;
    let worse = all.iter().filter(|(_, one)| one.peak()[1] > worst).count();
    assert!(worse as f64 / all.len() as f64 <= told.sample().share_above(), "{worse}");
}
