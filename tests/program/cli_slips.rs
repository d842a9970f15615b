//! Slips in a case are said, work far beyond what is ordinary is not begun, and long work shows progress.
//!
//! The truth is the slip itself: each case is a good one with one unit or one per cent sign changed.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;
use std::time::Duration;

use assert_cmd::Command;
use tempfile::TempDir;
use vinesink::case::{Case, ModalCase};

use crate::common::{BAND, BRIDGE};

const CRITERIA: &str = "\n[criteria]\npeak_displacement = \"<= 8 mm\"\n";
/// Hooke's way to the same structure: 4 pi^2 2.1^2 1200 N/m.
const BY_STIFFNESS: [&str; 2] = ["frequency = \"2.1 Hz\"\nd", "stiffness = \"208.9 kN/m\"\nd"];
const REDUCED: &str = "title = \"t\"\nsource = \"s\"\n[reduced]\nmass_ratio = 0.015\n\
    damping = 0.5\nrestitution = 0.6\nclearance = 1.0\nforcing = 4.0\nfrequency_ratio = 1.0\n";

/// A case with a slip in it.
fn slipped(case: &str, from: &str, to: &str) -> String {
    assert!(case.contains(from), "{from}");
    case.replacen(from, to, 1)
}

/// Line, message and what was meant, of every warning.
fn warnings(case: &str) -> Vec<(usize, String)> {
    let case = Case::parse("case.toml", case).expect("a valid case");
    let said = case.warnings().iter();
    said.map(|one| (one.line, format!("{}; {}", one.message, one.help.as_deref().unwrap_or(""))))
        .collect()
}

#[track_caller]
fn one_warning(case: &str, line: usize, words: &[&str]) {
    let said = warnings(case);
    let [(at, text)] = said.as_slice() else { panic!("{said:?}") };
    assert_eq!(*at, line, "{text}");
    assert!(words.iter().all(|word| text.contains(word)), "{text}");
}

#[test]
fn what_is_no_slip_is_not_warned_of() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    let entries = fs::read_dir(folder).expect("the folder of cases");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let cases: Vec<PathBuf> =
        paths.filter(|path| path.extension() == Some("toml".as_ref())).collect();
    assert!(cases.len() >= 14, "{cases:?}");
    for path in cases {
        assert_eq!(warnings(&fs::read_to_string(&path).expect("a text")), [], "{path:?}");
    }
    let fine = [
        BRIDGE.to_owned(),
        format!("{BRIDGE}{BAND}"),
        REDUCED.to_owned(),
        // A drive nineteen times as fast, a heavily damped structure, a large mass.
        slipped(BRIDGE, "250 N\"\nfrequency = \"2.1 Hz", "250 N\"\nfrequency = \"40 Hz"),
        slipped(BRIDGE, "damping_ratio = \"0.4 %\"", "damping_ratio = 0.2"),
        slipped(BRIDGE, "mass_ratio = \"1.5 %\"", "mass_ratio = 0.5"),
        // A limit of the theory, not a unit.
        slipped(REDUCED, "mass_ratio = 0.015", "mass_ratio = 1e-9"),
    ];
    for case in fine {
        assert_eq!(warnings(&case), [], "{case}");
    }
}

#[test]
fn frequencies_far_apart_name_the_slip() {
    let kilohertz = slipped(BRIDGE, "frequency = \"2.1 Hz\"", "frequency = \"2.1 kHz\"");
    // With a band the structure is alone against three frequencies; without, either may be the odd one.
    let words = ["2.1 kHz, is 1000 times", "2.1 kHz for 2.1 Hz?"];
    one_warning(&format!("{kilohertz}{BAND}"), 6, &words);
    one_warning(&kilohertz, 17, &["1/1000 of", "2.1 Hz for 2.1 kHz?"]);
    let drive = |unit: &str| {
        slipped(BRIDGE, "N\"\nfrequency = \"2.1 Hz\"", &format!("N\"\nfrequency = \"{unit}\""))
    };
    one_warning(&drive("2.1 kHz"), 17, &["1000 times", "2.1 kHz for 2.1 Hz?"]);
    // 126 turns per minute are 2.1 Hz.
    one_warning(
        &drive("126 Hz"),
        17,
        &["60 times", "126 Hz for as many turns per minute (2.1 Hz)?"],
    );
    one_warning(&drive("2.1 MHz"), 17, &["1000000 times", "check the units"]);
    assert_eq!(warnings(&drive("62.9 Hz")), []);
    one_warning(&drive("63.1 Hz"), 17, &["30 times"]);
    one_warning(
        &slipped(&format!("{BRIDGE}{BAND}"), "\"2.3 Hz\"", "\"2.3 kHz\""),
        21,
        &["2.3 kHz for 2.3 Hz?"],
    );
    let [from, to] = BY_STIFFNESS;
    let by_stiffness = format!("{}{BAND}", slipped(BRIDGE, from, to));
    assert_eq!(warnings(&by_stiffness), []);
    one_warning(
        &slipped(&by_stiffness, "kN/m", "MN/m").replace("208.9", "208900"),
        6,
        &["1000 times", "`stiffness` and `mass`"],
    );
    one_warning(
        &slipped(REDUCED, "_ratio = 1.0", "_ratio = 31"),
        9,
        &["31 times", "1 is resonance"],
    );
}

#[test]
fn heavy_damping_names_the_slip() {
    let ratio = |text: &str| {
        slipped(BRIDGE, "damping_ratio = \"0.4 %\"", &format!("damping_ratio = {text}"))
    };
    one_warning(&ratio("40"), 7, &["= 40 means 4000 %", "was 0.4 % (0.004) or 40 % meant?"]);
    one_warning(&ratio("0.4"), 7, &["means 40 %", "was 0.4 % (0.004) meant?"]);
    one_warning(&ratio("\"40 %\""), 7, &["means 40 %", "was 0.4 % (0.004) meant?"]);
    // Critical damping is 2 sqrt(k m) = 4 pi 2.1 1200 N s/m = 31.7 kN s/m.
    let newtons = slipped(BRIDGE, "damping_ratio = \"0.4 %\"", "damping = \"126.7 kN s/m\"");
    one_warning(&newtons, 7, &["a damping ratio of 400 %", "31700 N s/m"]);
    one_warning(
        &slipped(REDUCED, "damping = 0.5", "damping = 400"),
        5,
        &["300 %", "damping = 1.33"],
    );
}

#[test]
fn masses_that_are_no_absorber_name_the_slip() {
    let mass = |text: &str| slipped(BRIDGE, "mass_ratio = \"1.5 %\"", text);
    one_warning(&mass("mass_ratio = 1.5"), 10, &["1.5 times", "was 1.5 % (0.015) meant?"]);
    one_warning(&mass("mass = \"18000 kg\""), 10, &["15 times", "units of both masses"]);
    one_warning(&mass("mass = \"1 mg\""), 10, &["8.33e-10 times", "units of both masses"]);
}

/// The truth is the inclined plane and a linear oscillator with both masses.
/// The bridge moves by 151 mm at resonance: its static 1.2 mm, 125 times and once.
#[test]
fn clearances_far_from_what_moves_name_the_slip() {
    let clearance =
        |of: &str| slipped(BRIDGE, "clearance = \"50 mm\"", &format!("clearance = \"{of}\""));
    one_warning(&clearance("50 m"), 11, &["50 m: the structure", "1/332 of that", "its unit"]);
    one_warning(&clearance("50 um"), 11, &["50 um", "3020 times that"]);
    let moderate = [clearance("4 m"), clearance("0.2 mm")];
    // Undamped it may move as far as you like; where the amplitude varies it is another.
    let undamped = slipped(&clearance("50 m"), "\"0.4 %\"", "0");
    let over = format!(
        "{}\n[band]\nof = \"amplitude\"\nfrom = \"250 N\"\nto = \"100 kN\"\n",
        clearance("50 m")
    );
    for case in moderate.into_iter().chain([undamped, over]) {
        assert_eq!(warnings(&case), [], "{case}");
    }
    let two = "[[mode]]\nmass = \"1200 kg\"\nfrequency = \"2.1 Hz\"\ndamping_ratio = \"0.4 %\"\nshape = { a = 1.0, b = 0.0 }\n\
               [[mode]]\nmass = \"1200 kg\"\nfrequency = \"9 Hz\"\ndamping_ratio = \"0.4 %\"\nshape = { a = 0.0, b = 1.0 }\n\
               [[absorber]]\nplace = \"a\"\nmass = \"18 kg\"\nclearance = \"CLEARANCE\"\nrestitution = 0.6\n\
               [[excitation]]\nkind = \"force\"\nplace = \"a\"\namplitude = \"250 N\"\nfrequency = \"2.1 Hz\"\n";
    let of_two = |clearance: &str| {
        let text =
            format!("title = \"t\"\nsource = \"s\"\n{}", two.replace("CLEARANCE", clearance));
        let case = ModalCase::parse("case.toml", &text).expect("a valid case");
        case.warnings.iter().map(|one| one.message.clone()).collect::<Vec<_>>()
    };
    let [of_metres, of_micrometres] = ["50 m", "50 um"].map(of_two);
    assert!(of_metres.len() == 1 && of_metres[0].contains("1/332 of that"), "{of_metres:?}");
    assert!(
        of_micrometres.len() == 1 && of_micrometres[0].contains("3020 times"),
        "{of_micrometres:?}"
    );
    assert_eq!(of_two("50 mm"), [] as [String; 0]);
}

#[test]
fn cavities_that_hold_the_absorber_name_the_slip() {
    let cavity =
        |keys: &str| slipped(BRIDGE, "restitution = 0.6", &format!("restitution = 0.6\n{keys}"));
    one_warning(&cavity("friction = 3"), 13, &["= 3 means 300 %", "was 3 % (0.03) meant?"]);
    one_warning(&cavity("friction = \"300 %\""), 13, &["means 300 %"]);
    // At the natural frequency it accelerates by F/(m sqrt(eps^2 + (2 zeta)^2)) = 250/(1200 0.017) = 12.25 m/s^2.
    assert_eq!(warnings(&cavity("friction = 1\ninclination = \"89 deg\"")), []);
    let weak = cavity("inclination = \"-45 deg\"").replace("250 N", "100 N");
    one_warning(&weak, 13, &["is 1.41 times", "0 deg is a level cavity"]);
    assert_eq!(warnings(&format!("{weak}{BAND}")), []);
    let twin = slipped(REDUCED, "clearance = 1.0", "clearance = 1.0\ngravity_along = 30");
    one_warning(&twin, 8, &["`gravity_along` = 30", "0 is a level cavity"]);
}

fn written(folder: &TempDir, case: &str) -> String {
    let path = folder.path().join("case.toml");
    fs::write(&path, case).expect("a file");
    path.to_str().expect("UTF-8").to_owned()
}

/// Runs the program with lines of progress `seconds` apart.
fn vinesink(arguments: &[&str], seconds: &str) -> Output {
    let mut command = Command::cargo_bin("vinesink").expect("the program");
    // Work that is begun all the same takes minutes.
    command
        .args(arguments)
        .env("VINESINK_PROGRESS_SECONDS", seconds)
        .timeout(Duration::from_secs(60));
    command.output().expect("it runs")
}

/// Standard error in one line.
fn said(output: &Output) -> String {
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    text.split(['\n', '│', ' ']).filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
}

const NEVER: &str = "3600";

#[test]
fn a_slip_of_a_unit_is_refused_at_once() {
    let folder = TempDir::new().expect("a folder");
    let slip = slipped(BRIDGE, "frequency = \"2.1 Hz\"", "frequency = \"2.1 kHz\"");
    let case = written(&folder, &format!("{slip}{BAND}{CRITERIA}"));
    let out = folder.path().join("reports");
    let out = out.to_str().expect("UTF-8");
    let report = ["report", "--out", out];
    let commands: [&[&str]; 6] =
        [&["analyze"], &["check"], &["simulate"], &report, &["optimize"], &["tradeoff"]];
    for command in commands {
        let output = vinesink(&[command, &[&case]].concat(), NEVER);
        let said = said(&output);
        assert_eq!(output.status.code(), Some(2), "{command:?}: {said}");
        let units = [" s:", " min:", " h:"];
        assert!(units.iter().any(|unit| said.contains(unit)), "{command:?}: {said}");
        for word in [
            "⚠",
            "would take about",
            "periods of about 1000 oscillations each",
            "help: line 6: 2.1 kHz for 2.1 Hz?; to do it all the same, add --long",
        ] {
            assert!(said.contains(word), "{command:?}: {said}");
        }
    }
}

#[test]
fn many_periods_are_begun_only_when_asked_for() {
    let folder = TempDir::new().expect("a folder");
    let settings = "\n[simulation]\nperiods = 1_000_000\nstarts = 32\n";
    let case = written(&folder, &format!("{BRIDGE}{settings}"));
    let output = vinesink(&["simulate", &case], NEVER);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        said(&output).contains("164000000 periods help: to do it all the same"),
        "{}",
        said(&output)
    );
    let output = vinesink(&["sweep", &case, "--long"], NEVER);
    assert!(said(&output).contains("does not say what to vary"), "{}", said(&output));
    let slow = slipped(REDUCED, "_ratio = 1.0", "_ratio = 1e-5");
    let axis = "[sweep]\nclearance = { from = 1.0, to = 2.0, count = 4 }\n";
    let case = written(&folder, &format!("{slow}{axis}"));
    for more in [&["--dry-run"][..], &[]] {
        let output = vinesink(&[&["sweep", &case], more].concat(), NEVER);
        assert_eq!(output.status.code(), Some(2), "{}", said(&output));
        assert!(said(&output).contains("4 points"), "{}", said(&output));
    }
}

#[test]
fn what_was_asked_for_is_begun() {
    let folder = TempDir::new().expect("a folder");
    // One start, one value: the window of a motion that might never repeat is what would take long, and
    // this one repeats.
    let text = "[accuracy]\ncoexistence = true\n[simulation]\nperiods = 1_000_000\nstarts = 1\n";
    let case = written(&folder, &format!("{BRIDGE}\n{text}").replace("50 mm", "20 mm"));
    let refused = vinesink(&["analyze", &case], NEVER);
    assert_eq!(refused.status.code(), Some(2), "{}", said(&refused));
    let done = vinesink(&["analyze", &case, "--long"], NEVER);
    assert_eq!(done.status.code(), Some(0), "{}", said(&done));
    assert_eq!(said(&done), "");
}

#[test]
fn warnings_are_carried_in_documents_and_reports() {
    let folder = TempDir::new().expect("a folder");
    let case = slipped(BRIDGE, "damping_ratio = \"0.4 %\"", "damping_ratio = 40");
    // What is said of a slip does not depend on how thoroughly motions are searched.
    let short = "\n[simulation]\nstarts = 2\nperiods = 100\n[report]\ndeviations = false\n";
    let case = written(&folder, &format!("{case}{CRITERIA}{short}"));
    for command in ["analyze", "simulate", "check"] {
        let output = vinesink(&[command, &case, "--format", "json"], NEVER);
        let said = said(&output);
        assert!(said.contains("⚠") && said.contains("damping_ratio = 40"), "{command}: {said}");
        let document: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        let warnings = match command {
            "check" => &document["cases"][0]["warnings"],
            _ => &document["warnings"],
        };
        assert_eq!(warnings[0]["line"], 7, "{command}: {document}");
        let message = warnings[0]["message"].as_str().expect("a text");
        assert!(message.ends_with("was 0.4 % (0.004) or 40 % meant?"), "{command}: {message}");
    }
    let github = vinesink(&["check", &case, "--format", "github"], NEVER);
    let annotations = String::from_utf8_lossy(&github.stdout).into_owned();
    assert!(
        annotations.contains("::warning file=") && annotations.contains(",line=7,col=17,"),
        "{annotations}"
    );
    let out = folder.path().join("reports");
    let output = vinesink(&["report", &case, "--out", out.to_str().expect("UTF-8")], NEVER);
    assert!(output.status.code().is_some_and(|code| code < 2), "{}", said(&output));
    let page = fs::read_to_string(out.join("case/report.md")).expect("a report");
    let note =
        page.lines().position(|line| line.starts_with("- **Warning**: Line 7 of the case: "));
    assert!(note.is_some_and(|line| line < 12), "{page}");
}

/// With no time between lines every step has one, and what is not counted in steps one at its begin, whatever the machine.
#[test]
#[ignore = "deep"]
fn long_work_says_how_far_it_is() {
    let folder = TempDir::new().expect("a folder");
    let axis = "\n[sweep]\nclearance = { from = \"20 mm\", to = \"30 mm\", count = 3 }\n";
    let case = written(&folder, &format!("{BRIDGE}{axis}\n[simulation]\nstarts = 4\n"));
    let out = folder.path().to_str().expect("UTF-8");
    let commands: [(&[&str], &str); 4] = [
        (&["simulate"], "simulating: about"),
        (&["report", "--out", out], "case: about"),
        (&["tradeoff", "--format", "json"], "layers: 5 of"),
        (&["sweep", "--dry-run"], "sample: 8 of 8, ending"),
    ];
    for (command, line) in commands {
        let arguments = [command, &[&case]].concat();
        let [shown, silent] = ["0", NEVER].map(|seconds| vinesink(&arguments, seconds));
        let text = String::from_utf8_lossy(&shown.stderr).into_owned();
        assert!(text.lines().any(|said| said.starts_with(line)), "{command:?}: {text}");
        assert_eq!(silent.stderr, b"", "{command:?}");
        if command[0] != "sweep" {
            assert_eq!(shown.stdout, silent.stdout, "{command:?}: results are their own");
        }
    }
}

/// A slip of a letter is told: the command, or the case file, that was meant.
#[test]
fn what_was_meant_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::copy("cases/arm-empty.toml", folder.path().join("damper.toml")).expect("copied");
    let told = |arguments: &[&str]| {
        let mut command = assert_cmd::Command::cargo_bin("vinesink").expect("the program");
        let output = command.current_dir(folder.path()).args(arguments).output().expect("it runs");
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        String::from_utf8(output.stderr).expect("UTF-8")
    };
    let text = told(&["chek", "damper.toml"]);
    assert!(text.contains("'check'") && !text.contains("'schema'"), "{text}");
    for command in ["report", "check", "analyze"] {
        let text = told(&[command, "damper.tml"]);
        assert!(text.contains("did you mean damper.toml?"), "{command}: {text}");
        assert!(!told(&[command, "chimney.toml"]).contains("did you mean"), "{command}");
        assert!(told(&[command, "damper"]).contains("did you mean damper.toml?"), "{command}");
    }
}

/// A share without a per cent sign that would be warned of is not written into a case.
#[test]
fn a_share_of_a_proposal_is_no_slip() {
    let folder = TempDir::new().expect("a folder");
    let known = ["--mass", "30 kg", "--frequency", "6.9 Hz", "--force", "14 N"];
    for (flag, value, words) in [
        ("--damping", "0.4", "was 0.4 % (0.004) meant?"),
        ("--damping", "3", "was 3 % (0.03) meant?"),
        ("--mass-ratio", "2", "was 2 % (0.02) meant?"),
    ] {
        let mut command = Command::cargo_bin("vinesink").expect("built");
        let damping: &[&str] = if flag == "--damping" { &[] } else { &["--damping", "0.5 %"] };
        let output = command
            .current_dir(folder.path())
            .args(["new", "case", flag, value])
            .args(known)
            .args(damping)
            .output()
            .expect("it runs");
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(2) && told.contains(words), "{flag} {value}: {told}");
        assert!(!folder.path().join("case.toml").exists());
    }
}

/// What is asked back makes sense.
#[test]
fn a_slip_is_not_asked_back_as_another() {
    let with = |line: &str| {
        slipped(BRIDGE, "restitution = 0.6\n", &format!("restitution = 0.6\n{line}\n"))
    };
    let said = |line: &str| warnings(&with(line))[0].1.clone();
    assert!(said("friction = 30").contains("was 30 % (0.3) meant?"));
    for line in ["friction = 1000", "friction = 1e6"] {
        assert!(
            said(line).contains("the friction force over the normal force")
                && !said(line).contains("meant?")
        );
    }
    let table = BRIDGE.replacen("restitution = 0.6", "restitution = { plus = 0.6 }", 1);
    let error = Case::parse("case.toml", &table).expect_err("refused");
    let one = error.problems().next().expect("a problem");
    assert!(one.message.contains("is a table, where a plain number belongs"), "{}", one.message);
    let help = one.help.as_deref().unwrap_or_default();
    assert!(help.contains("restitution = [0.65, 0.55] for one value at each wall"), "{help}");
}

/// An absorber may be kicked in a structure at rest: one flight of it is told, and nothing else is said of a structure that nothing
/// moves.
#[test]
fn an_absorber_may_be_kicked() {
    let folder = TempDir::new().expect("a folder");
    let (design, _) = BRIDGE.split_once("[excitation]").expect("a table");
    let text = format!(
        "{design}[excitation]\nkind = \"free\"\ndisplacement = \"0 mm\"\n[criteria]\ndecay_time = \"<= 5 s\"\n"
    );
    fs::write(folder.path().join("kick.toml"), text).expect("written");
    let run = |arguments: &[&str]| {
        let mut command = Command::cargo_bin("vinesink").expect("built");
        let output = command.current_dir(folder.path()).args(arguments).output().expect("it runs");
        let told =
            [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
        (output.status.code(), told.concat())
    };
    for y_velocity in ["1", "0.5", "-2"] {
        let start = format!("0,0,0,{y_velocity}");
        let (code, told) =
            run(&["simulate", "kick.toml", "--initial", &start, "--impacts", "impacts.csv"]);
        assert_eq!(code, Some(0), "{told}");
        // The first impact is at the speed of the kick, after one clearance.
        let impacts = fs::read_to_string(folder.path().join("impacts.csv")).expect("written");
        let first: Vec<f64> = impacts
            .lines()
            .nth(1)
            .expect("an impact")
            .split(',')
            .map(|one| one.parse().expect("a number"))
            .collect();
        let speed: f64 = y_velocity.parse().expect("a number");
        assert!((first[0] - 1.0 / speed.abs()).abs() < 1e-12 && first[5] == speed, "{first:?}");
    }
    for command in ["check", "simulate", "analyze", "report", "optimize"] {
        let (code, told) = run(&[command, "kick.toml"]);
        assert!(
            code == Some(2) && told.contains("nothing sets the oscillator in motion"),
            "{command}: {told}"
        );
    }
}

/// Pages in inches and pounds of every scene, and lengths in thousandths of an inch.
#[test]
fn units_of_pages_and_mil_belong_to_every_scene() {
    let (design, _) = BRIDGE.split_once("[excitation]").expect("a table");
    let noise = "kind = \"record\"\nquantity = \"force\"\nspectrum = [[1, 1.0], [4, 1.0]]\nduration = \"20 s\"\nseed = 1\nrealisations = 2\n";
    for drive in [
        "kind = \"free\"\ndisplacement = \"2000 mil\"\n",
        "kind = \"sine-sweep\"\nof = \"force\"\namplitude = \"250 N\"\nfrom = \"1.8 Hz\"\nto = \"2.4 Hz\"\nrate = \"0.01 Hz/s\"\n",
        noise,
    ] {
        let text = format!("{design}[excitation]\n{drive}[report]\nunits = \"us\"\n");
        let case = Case::parse("case.toml", &text).expect("a case");
        let shown = case.units().text(&vinesink::quantity::catalogue::PEAK, 1.0);
        assert!(shown.ends_with(" in"), "{shown}");
        let refused = text.replace("units = \"us\"", "figures = [\"areas\"]");
        let error = Case::parse("case.toml", &refused).expect_err("refused");
        let words = "`figures` has no meaning for a structure that is";
        assert!(error.problems().any(|one| one.message.contains(words)));
    }
    for (written, metres) in [("1000 mil", 0.0254), ("50 thou", 0.00127)] {
        let text = slipped(BRIDGE, "clearance = \"50 mm\"", &format!("clearance = \"{written}\""));
        let case = Case::parse("case.toml", &text).expect("a case");
        assert_eq!(case.units().clearance, metres, "{written}");
    }
}
