//! How a cavity lies and what carries the absorber: what the keys mean, what is refused, what is said at once.
//!
//! The truth: gravity on an upright track, the pendulum and Hooke's law by hand, two masses under one force, and a
//! simulation by small steps in which the spring pulls.

use std::f64::consts::TAU;
use std::fs;

use assert_cmd::Command;
use serde_json::{Value, json};
use vinesink::case::{Case, Design, Orientation, Physical, SupportKind};
use vinesink::report::document::{Content, answer};
use vinesink::simulation::{AbsorberMotion, Measurement, Observer, Segment, Side, Simulation};
use vinesink::study::deviations::Deviation;
use vinesink::system::{Cavity, State};

use crate::common::{BAND, BRIDGE};

const SPRING: &str =
    "orientation = \"vertical\"\nsupport = \"spring\"\nsupport_frequency = \"0.4 Hz\"\n";
const PENDULUM: &str = "support = \"pendulum\"\nsupport_frequency = \"0.4 Hz\"\n";
const UPRIGHT: &str = "orientation = \"vertical\"\n";
/// The last line of `[absorber]` in [`BRIDGE`].
const LAST: &str = "restitution = 0.6\n";

fn with(keys: &str) -> String {
    assert!(BRIDGE.contains(LAST));
    BRIDGE.replacen(LAST, &format!("{LAST}{keys}"), 1)
}

fn parsed(text: &str) -> Case {
    Case::parse("case.toml", text).unwrap_or_else(|error| panic!("{error:?}"))
}

fn physical(text: &str) -> Physical {
    let Design::Physical(physical) = parsed(text).design else { panic!("physical") };
    physical
}

fn cavity(keys: &str) -> Cavity {
    parsed(&with(keys)).system().cavity()
}

/// Line, message and help of the one problem.
#[track_caller]
fn refused(text: &str, line: usize, words: &[&str]) {
    let error = Case::parse("case.toml", text).expect_err("refused");
    let all: Vec<_> = error.problems().collect();
    let [one] = all.as_slice() else { panic!("{all:?}") };
    let said = format!("{}; {}; {}", one.message, one.expected, one.help.as_deref().unwrap_or(""));
    assert_eq!(one.line, line, "{said}");
    assert!(words.iter().all(|word| said.contains(word)), "{said}");
}

/// The messages of all warnings, with what was meant.
fn warned(text: &str) -> Vec<String> {
    let case = parsed(text);
    let said = case.warnings().iter();
    said.map(|one| format!("{}; {}", one.message, one.help.as_deref().unwrap_or(""))).collect()
}

#[track_caller]
fn near(value: f64, expected: f64, within: f64) {
    assert!((value / expected - 1.0).abs() < within, "{value} {expected}");
}

#[test]
fn an_orientation_is_an_inclination_and_a_support_takes_gravity_and_friction_away() {
    // 9.80665/(0.05 (2 pi 2.1)^2): along positive y, and nothing presses on an upright track.
    let upright = cavity(&format!("{UPRIGHT}friction = 0.2\n"));
    near(upright.gravity_along, 1.126_555, 1e-6);
    assert_eq!(upright.friction_acceleration, 0.0);
    assert_eq!(upright, cavity("inclination = \"90 deg\"\n"));
    let downwards = cavity(&format!("{UPRIGHT}inclination = \"-90 deg\"\n"));
    assert_eq!(downwards.gravity_along, -upright.gravity_along, "both say vertical");
    let level = cavity("orientation = \"horizontal\"\nsupport = \"sliding\"\nfriction = 0.2\n");
    assert_eq!(level.gravity_along, 0.0);
    near(level.friction_acceleration, 0.2 * 1.126_555, 1e-6);
    let bare = parsed(BRIDGE).system();
    for keys in [SPRING, PENDULUM] {
        assert_eq!(parsed(&with(keys)).system(), bare, "the support is ideal: {keys}");
    }
    let of = |keys: &str| {
        let found = physical(&with(keys));
        (found.orientation(), found.support.map(|support| support.kind))
    };
    assert_eq!(of(""), (Some(Orientation::Horizontal), None));
    assert_eq!(of(UPRIGHT), (Some(Orientation::Vertical), Some(SupportKind::Sliding)));
    assert_eq!(of("inclination = \"10 deg\"\n"), (None, None));
    assert_eq!(of(SPRING), (Some(Orientation::Vertical), Some(SupportKind::Spring)));
    // The case to start from shows keys that are valid together.
    let shown = "orientation = \"vertical\"\nsupport = \"spring\"\nsupport_frequency = \"1.5 Hz\"\nsupport_room = \"0.15 m\"\n";
    let start = Case::starting_text("t");
    let start = parsed(&start.replacen("# orientation = \"vertical\"", shown, 1));
    assert_eq!(
        (start.design.support().map(|one| one.kind), start.warnings()),
        (Some(SupportKind::Spring), &[][..])
    );
}

#[test]
fn lengths_are_those_of_a_pendulum_and_of_hookes_law() {
    let length = |keys: &str| physical(&with(keys)).support_length_m();
    // 9.80665/(2 pi 0.4)^2 = 9.80665/6.316547.
    for keys in [SPRING, PENDULUM] {
        near(length(keys).expect("a length"), 1.552_533, 1e-6);
    }
    near(length(&PENDULUM.replace("0.4", "0.42")).expect("a length"), 1.408194, 1e-6);
    // Along 30 degrees half of the weight stretches it; leaf springs in a level cavity are not stretched.
    let inclined = SPRING.replace(UPRIGHT, "inclination = \"30 deg\"\n");
    near(length(&inclined).expect("a stretch"), 0.5 * 1.552_533, 1e-6);
    assert_eq!(length(&SPRING.replace("vertical", "horizontal")), None);
    assert_eq!(length(UPRIGHT), None);
}

#[test]
fn what_cannot_be_built_is_refused_with_what_would_work() {
    let both = ["is vertical, and `inclination` is 10 deg", "remove one of the two lines"];
    refused(&with(&format!("{UPRIGHT}inclination = \"10 deg\"\n")), 13, &both);
    refused(
        &with("orientation = \"horizontal\"\ninclination = \"1 deg\"\n"),
        13,
        &["is horizontal"],
    );
    refused(
        &with(&format!("{UPRIGHT}{PENDULUM}")),
        14,
        &["swings to and fro", "write support = \"spring\""],
    );
    refused(&with(&format!("inclination = \"5 deg\"\n{PENDULUM}")), 14, &["not level"]);
    refused(&with("support = \"spring\"\n"), 13, &["`support_frequency` is missing", "a fifth of"]);
    for key in ["support_frequency = \"0.4 Hz\"\n", "support_room = \"1 m\"\n"] {
        let words = ["no meaning for an absorber that slides", "support = \"spring\""];
        refused(&with(key), 13, &words);
        refused(&with(&format!("support = \"sliding\"\n{key}")), 14, &words);
    }
    refused(
        &with(&format!("{SPRING}friction = 0.1\n")),
        16,
        &["on a spring does not rub", "\"sliding\""],
    );
    // 1.5525 m into 1 m: 0.4 Hz sqrt(1.5525) = 0.4984 Hz.
    let small = format!("{SPRING}support_room = \"1 m\"\n");
    refused(&with(&small), 15, &["of 0.4 Hz by 1.55 m, more than the room of 1 m", "0.4985 Hz"]);
    let small = format!("{PENDULUM}support_room = \"50 mm\"\n");
    refused(&with(&small), 14, &["a pendulum of 0.4 Hz is 1.55 m long", "room of 50 mm"]);
    assert_eq!(warned(&with(&format!("{SPRING}support_room = \"1.6 m\"\n"))), Vec::<String>::new());
    refused(&with("orientation = \"upright\"\n"), 13, &["\"horizontal\" or \"vertical\""]);
    refused(&with("support = \"rope\"\n"), 13, &["\"sliding\", \"pendulum\" or \"spring\""]);
    let reduced = "title = \"t\"\nsource = \"s\"\n[reduced]\nmass_ratio = 0.015\ndamping = 0.5\nrestitution = 0.6\n\
        clearance = 1.0\nforcing = 4.0\nfrequency_ratio = 1.0\nsupport = \"spring\"\n";
    refused(reduced, 10, &["`support` belongs in [absorber]"]);
}

#[test]
fn nothing_tilts_or_rubs_an_absorber_that_is_carried() {
    let carried = parsed(&with(SPRING)).design;
    let sliding = parsed(BRIDGE).design;
    for deviation in [Deviation::Tilt, Deviation::Friction] {
        assert!(deviation.system(&sliding).is_some() && deviation.system(&carried).is_none());
    }
    assert!(Deviation::UnequalEnds.system(&carried).is_some());
    let uncertain = format!("{}\n[uncertainty]\nfriction = 0.01\n", with(SPRING));
    refused(&uncertain, 23, &["an absorber on a spring has no `friction` that could be uncertain"]);
    let axis = "\n[sweep]\ninclination = { values = [\"0 deg\", \"1 deg\"] }\n";
    refused(
        &format!("{}{axis}", with(PENDULUM)),
        22,
        &["an absorber on a pendulum has no `inclination` to vary"],
    );
}

/// Whether the absorber has left the wall that it lies on.
#[derive(Default)]
struct Lies {
    left: u64,
}

impl Observer for Lies {
    fn segment(&mut self, segment: &Segment) {
        self.left += u64::from(segment.absorber != AbsorberMotion::Carried(Side::Minus));
    }
}

/// Two masses under one force at the natural frequency: `a = F/(m sqrt(eps^2 + (2 zeta)^2))`, 9.80665 m/s^2 at
/// 1200 0.017 9.80665 = 200.06 N.
#[test]
fn an_absorber_lies_on_its_floor_where_the_structure_accelerates_by_less_than_gravity() {
    for (force, lies) in [("198 N", true), ("202 N", false)] {
        let text = with(UPRIGHT).replace("250 N", force);
        let said = warned(&text);
        assert_eq!(said.len(), usize::from(lies), "{force}: {said:?}");
        let system = parsed(&text).system();
        let (eps, zeta, a) = (0.015, 0.004, system.cavity().gravity_along);
        // On its floor, carried along: (1 + eps) x'' + 2 zeta x' + x = p sin(tau), 1 - (1 + eps) = -eps.
        let p = system.mass_ratio() * system.forcing_per_clearance();
        let scale = p / (eps * eps + 4.0 * zeta * zeta);
        let (sine, cosine) = (-eps * scale, -2.0 * zeta * scale);
        // Gravity pulls it towards positive y, to the wall x - y = -b, and shifts both by eps a.
        let x = cosine + eps * a;
        let start = State { x, x_velocity: sine, y: x + 1.0, y_velocity: sine };
        let mut simulation = Simulation::new(&system, start, 0.0).expect("on its floor");
        let mut seen = Lies::default();
        simulation.run(30, u64::MAX, &mut seen);
        assert_eq!((seen.left == 0, simulation.impacts() == 0), (lies, lies), "{force}");
    }
    let said = warned(&with(UPRIGHT).replace("250 N", "100 N"));
    // A fifth of 2.1 Hz, and 0.2484/0.42^2 m.
    let words = [
        "`orientation` = vertical: gravity along the cavity is 2 times",
        "write support = \"spring\"",
        "support_frequency = \"0.42 Hz\"",
        "stretches it by 1.41 m",
        "0.25 m/(f/Hz)^2",
    ];
    assert!(words.iter().all(|word| said[0].contains(word)), "{said:?}");
    // What it proposes is not warned of.
    let proposed = SPRING.replace("0.4 Hz", "0.42 Hz");
    assert_eq!(warned(&with(&proposed)), Vec::<String>::new());
    // In a band it is the strongest place that counts, of a shock the first amplitude: 0.1 m (2 pi 2.1)^2 = 17.4 m/s^2.
    // At 2.084 Hz in it the acceleration is F/(1200 0.0008 sqrt(1.015)), 9.31 m/s^2 of 9 N and 10.34 m/s^2 of 10 N, at a
    // resonance that lies between places of any grid.
    for (force, warnings) in [("9 N", 1), ("10 N", 0)] {
        let band = format!("{}{BAND}", with(UPRIGHT).replace("250 N", force));
        let band = band.replace("0.4 %", "0.04 %").replace("2.3 Hz", "2.301 Hz");
        assert_eq!(warned(&band).len(), warnings, "{force}");
    }
    let (design, _) = BRIDGE.split_once("[excitation]").expect("a table");
    for (displacement, warnings) in [("100 mm", 0), ("50 mm", 1)] {
        let free = format!("[excitation]\nkind = \"free\"\ndisplacement = \"{displacement}\"\n");
        let text = format!("{design}{free}").replacen(LAST, &format!("{LAST}{UPRIGHT}"), 1);
        assert_eq!(warned(&text).len(), warnings, "{displacement}");
    }
    // A record that is a sudden force: F/((1 + eps) m) at once, 1.015 1200 9.80665 = 11_944 N; without the absorber's mass
    // it would be 11_768 N. Noise is made where it is asked for.
    let record = "[excitation]\nkind = \"record\"\nquantity = \"force\"\n";
    let case = |drive: &str| {
        format!("{design}{record}{drive}").replacen(LAST, &format!("{LAST}{UPRIGHT}"), 1)
    };
    for (force, warnings) in [(11_900, 1), (11_990, 0)] {
        let unread = parsed(&case("file = \"sudden.csv\"\n"));
        assert!(unread.warnings().is_empty(), "nobody has seen the record");
        let sudden = format!("time (s),force (N)\n0,{force}\n1,{force}\n");
        let read = unread.with_record("sudden.csv", sudden).expect("a record");
        assert_eq!(read.warnings().len(), warnings, "{force} N");
    }
    let noise = "spectrum = [[1, 1.0], [4, 1.0]]\nduration = \"20 s\"\nseed = 1\n";
    assert_eq!(warned(&case(noise)).len(), 1);
    // Friction that holds: mu g = 0.5 9.80665 against half of g.
    let said = warned(&with("friction = 0.6\n").replace("250 N", "100 N"));
    let words = ["friction is 1.2 times", "support = \"pendulum\"", "it does not rub", "1.41 m"];
    assert!(words.iter().all(|word| said[0].contains(word)), "{said:?}");
    assert_eq!(warned(&with("friction = 0.4\n").replace("250 N", "100 N")), Vec::<String>::new());
}

#[test]
fn a_support_whose_force_is_not_small_is_warned_of() {
    let of = |keys: &str| parsed(&with(keys)).support_left_out();
    assert_eq!((of(""), of(UPRIGHT)), (None, None));
    // At resonance the structure alone moves by 250/(1200 (2 pi 2.1)^2 0.008) = 149.6 mm, more than 50 mm.
    near(of(SPRING).expect("a share"), 0.16 / 4.41, 1e-12);
    assert_eq!(warned(&with(SPRING)), Vec::<String>::new());
    // Of the case as it is written a support that holds the absorber back is refused, whatever drives the structure.
    let stiff = SPRING.replace("0.4 Hz", "0.43 Hz");
    let words = ["the support has 20.5 % of the structure's frequency", "at most 20 %, 0.42 Hz"];
    refused(&with(&stiff), 15, &words);
    refused(&with(&PENDULUM.replace("0.4 Hz", "10 Hz")), 14, &["476 %"]);
    let (design, _) = BRIDGE.split_once("[excitation]").expect("a table");
    let free = format!("{design}[excitation]\nkind = \"free\"\ndisplacement = \"0.1 m\"\n");
    refused(&free.replacen(LAST, &format!("{LAST}{stiff}"), 1), 15, &["20.5 %"]);
    // Where the structure is soft by chance or along an axis it is warned of: 0.4 Hz is 20.5 % of 1.95 Hz.
    for (table, warnings) in [
        ("[uncertainty]\nnatural_frequency = \"0.075 Hz\"\n", 1),
        ("[uncertainty]\nnatural_frequency = \"± 0.15 Hz\"\n", 1),
        ("[uncertainty]\nnatural_frequency = \"± 0.09 Hz\"\n", 0),
        ("[uncertainty]\noscillator_mass = \"± 200 kg\"\n", 1),
        ("[sweep.natural_frequency]\nfrom = \"1.95 Hz\"\nto = \"2.2 Hz\"\ncount = 3\n", 1),
        ("[sweep.natural_frequency]\nfrom = \"2.1 Hz\"\nto = \"2.2 Hz\"\ncount = 3\n", 0),
    ] {
        let said = warned(&format!("{}{table}", with(SPRING)));
        assert_eq!(said.len(), warnings, "{table} {said:?}");
    }
    // A twentieth of the force: 7.479 mm, so 50/7.479 times as much, 24.26 %, and a fifth at 0.4 sqrt(0.2/0.2426) Hz.
    let weak = with(SPRING).replace("250 N", "12.5 N");
    near(parsed(&weak).support_left_out().expect("a share"), 0.242_56, 1e-3);
    let said = warned(&weak);
    let words = ["24.3 %", "up to 0.363 Hz"];
    assert!(said.len() == 1 && words.iter().all(|word| said[0].contains(word)), "{said:?}");
    // Of a structure that is too damped by a slip, only that is said.
    let slip = weak.replace("\"0.4 %\"", "0.4");
    assert!(warned(&slip).len() == 1 && !warned(&slip)[0].contains("support"), "{slip}");
    // Along a band the lowest frequency counts, 1.9 Hz.
    near(
        parsed(&format!("{}{BAND}", with(SPRING))).support_left_out().expect("a share"),
        0.16 / 3.61,
        1e-12,
    );
}

/// The structure's peak by small steps in which a support of `kappa = (f_s/f0)^2` pulls the absorber back. Over the
/// clearance, fast time; the fan of the tutorial at resonance with its better clearance.
fn peak_by_steps(kappa: f64) -> f64 {
    let (zeta, eps, r, forcing) = (0.008, 0.025, 0.55, FORCING);
    let rate = |time: f64, s: [f64; 4]| {
        let pull = kappa * (s[0] - s[2]);
        [s[1], forcing * libm::sin(time) - 2.0 * zeta * s[1] - s[0] - eps * pull, s[3], pull]
    };
    let step = |time: f64, s: [f64; 4], h: f64| {
        let at = |d: [f64; 4], h: f64| [0, 1, 2, 3].map(|k| s[k] + h * d[k]);
        let a = rate(time, s);
        let b = rate(time + 0.5 * h, at(a, 0.5 * h));
        let c = rate(time + 0.5 * h, at(b, 0.5 * h));
        let d = rate(time + h, at(c, h));
        [0, 1, 2, 3].map(|k| s[k] + h / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]))
    };
    const STEPS: u32 = 1000;
    let h = TAU / f64::from(STEPS);
    let (mut s, mut peak) = ([0.0, 0.0, 0.3, 0.0], 0.0_f64);
    for period in 0..300 {
        for k in 0..STEPS {
            let time = h * f64::from(k);
            let next = step(time, s, h);
            let gap = next[0] - next[2];
            s = if gap.abs() < 1.0 || gap * (next[1] - next[3]) < 0.0 {
                next
            } else {
                let (mut before, mut after) = (0.0, h);
                for _ in 0..40 {
                    let middle = 0.5 * (before + after);
                    let there = step(time, s, middle);
                    if (there[0] - there[2]).abs() < 1.0 { before = middle } else { after = middle }
                }
                let [x, u, y, v] = step(time, s, after);
                let (common, apart) = ((u + eps * v) / (1.0 + eps), -r * (u - v) / (1.0 + eps));
                step(time + after, [x, common + eps * apart, y, common - apart], h - after)
            };
            if period >= 250 {
                peak = peak.max(s[0].abs());
            }
        }
    }
    peak
}

/// 60 N on 140 kg at 17.2 Hz, over 1.345 mm.
const FORCING: f64 = 0.027_28;

/// What the model leaves out changes the peak of 1:1 resonance by less than the share that is told, and not by nothing.
#[test]
fn what_is_left_out_is_as_small_as_it_is_told() {
    let fan = include_str!("../../docs/src/cases/fan-map.toml");
    let (fan, _) = fan.split_once("[sweep]").expect("a sweep");
    let soft = parsed(&fan.replace("\"2 Hz\"", "\"3.44 Hz\""));
    let told = soft.support_left_out().expect("a share");
    near(told, 0.04, 1e-12);
    let system = soft.system();
    near(system.mass_ratio() * system.forcing_per_clearance(), FORCING, 1e-3);
    let [ideal, pulled] = [0.0, told].map(peak_by_steps);
    let mut simulation =
        Simulation::new(&system, State { y: 0.3, ..State::AT_REST }, 0.0).expect("inside");
    simulation.run(300, u64::MAX, &mut ());
    let mut measured = Measurement::begin(&system, simulation.state());
    simulation.run(20, u64::MAX, &mut measured);
    // The forcing above is rounded to four digits, and steps sample the peak to 5e-6.
    near(ideal, measured.statistics().peak(), 1e-3);
    let change = (pulled / ideal - 1.0).abs();
    assert!((change - 0.033).abs() < 0.001, "the book says 3.3 %, less than {told}: {change}");
}

fn reported(text: &str) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("case.toml"), text).expect("written");
    let mut command = Command::cargo_bin("vinesink").expect("the program");
    let output = command.current_dir(folder.path()).args(["report", "case.toml"]).output();
    let code = output.expect("it runs").status.code();
    assert!(code.is_some_and(|code| code < 2), "{code:?}");
    fs::read_to_string(folder.path().join("reports/case/report.md")).expect("a page")
}

/// What documents of a case have of its support.
fn told(text: &str) -> Value {
    answer(&parsed(text), Content::Flight, json!({}))["support"].take()
}

#[test]
fn documents_say_how_the_cavity_lies() {
    let spring = told(&with(SPRING));
    assert_eq!(
        (&spring["orientation"], &spring["support"]),
        (&json!("vertical"), &json!("spring"))
    );
    let value = |of: &Value, key: &str| of[key]["value"].as_f64().expect(key);
    near(value(&spring, "frequency"), 0.4, 1e-12);
    near(value(&spring, "length"), 1.552_533, 1e-6);
    near(value(&spring, "left_out"), 0.16 / 4.41, 1e-12);
    assert_eq!(told(&with(PENDULUM))["orientation"], "horizontal");
    let upright = told(&with(UPRIGHT));
    assert_eq!((&upright["support"], &upright["length"]), (&json!("sliding"), &Value::Null));
    // A case that does not say it has the page of before.
    assert!(told(BRIDGE).is_null() && told(&with("inclination = \"1 deg\"\n")).is_null());
}

#[test]
#[ignore = "deep"]
fn a_report_says_among_its_inputs_how_the_cavity_lies() {
    let (design, _) = BRIDGE.split_once("[excitation]").expect("a table");
    let free =
        "[excitation]\nkind = \"free\"\ndisplacement = \"100 mm\"\n[simulation]\nstarts = 2\n";
    let of = |keys: &str| {
        reported(&format!("{design}{free}").replacen(LAST, &format!("{LAST}{keys}"), 1))
    };
    let page = of(SPRING);
    let (_, inputs) = page.split_once("## Inputs").expect("inputs");
    assert!(inputs.contains(
        "\nCavity: vertical, held by a soft spring of 0.4 Hz that is stretched by 1.6 m. The support is taken as ideal: \
         its restoring acceleration, up to 3.6 % of the structure's, is left out; at rest the absorber is in the middle.\n"
    ), "{inputs}");
    let input = "| absorber orientation | $\\alpha$ | vertical | case file |\n| excitation";
    assert!(inputs.contains(input), "{inputs}");
    assert!(!of("").contains("Cavity:"));
}
