//! A case whose cavity is tilted, rubs, or has ends that differ: what its keys mean, and where they appear.
//!
//! The truth is the acceleration of an inclined plane: g sin(alpha) along it, mu g cos(alpha) by sliding friction.

use std::f64::consts::FRAC_PI_2;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;
use vinesink::case::{Case, Objective, Rounding};
use vinesink::optimize::{OptimizeError, Task};
use vinesink::sweep::Plan;
use vinesink::system::{Cavity, Parameter, System};

const TILTED: &str = include_str!("../cavity/tilted.toml");
const KEYS: &str = "restitution = [0.65, 0.55]\ninclination = \"0.5 deg\"\nfriction = \"0.3 %\"\n";
/// g/(b omega0^2) of Table 1 with b = 7.5 mm: 9.80665 4.168/(0.0075 11470).
const GRAVITY: f64 = 0.475_142_309_793_66;

fn parsed(text: &str) -> Case {
    Case::parse("case.toml", text).unwrap_or_else(|error| panic!("{error:?}"))
}

/// The case with other keys in place of those of its cavity.
fn with(keys: &str) -> String {
    assert!(TILTED.contains(KEYS));
    TILTED.replacen(KEYS, keys, 1)
}

fn cavity(keys: &str) -> Cavity {
    parsed(&with(keys)).system().cavity()
}

/// The same design without units.
fn reduced(system: &System, clearance: f64) -> String {
    let ([plus, minus], of) = (system.restitutions(), system.cavity());
    format!(
        "title = \"t\"\nsource = \"s\"\n[reduced]\nmass_ratio = {:?}\ndamping = {:?}\nrestitution = [{plus:?}, {minus:?}]\n\
         gravity_along = {:?}\nfriction_acceleration = {:?}\nclearance = {clearance:?}\nforcing = {:?}\n\
         frequency_ratio = {:?}\n",
        system.mass_ratio(),
        system.damping(),
        of.gravity_along,
        of.friction_acceleration,
        system.forcing_per_clearance() * clearance,
        system.frequency_ratio(),
    )
}

/// A handful of roundings.
#[track_caller]
fn close(value: f64, expected: f64) {
    assert!((value - expected).abs() <= 16.0 * f64::EPSILON * expected.abs(), "{value} {expected}");
}

#[track_caller]
fn alike(one: &System, other: &System) {
    let numbers = |system: &System| {
        let ([plus, minus], of) = (system.restitutions(), system.cavity());
        let own = [system.mass_ratio(), system.damping(), system.frequency_ratio()];
        let cavity = [plus, minus, of.gravity_along, of.friction_acceleration];
        [own.as_slice(), &cavity, &[system.forcing_per_clearance()]].concat()
    };
    for (one, other) in numbers(one).into_iter().zip(numbers(other)) {
        close(one, other);
    }
}

fn vinesink(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_vinesink"));
    command.current_dir(folder).args(arguments).output().expect("it runs")
}

fn analysed(text: &str) -> Value {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("case.toml"), text).expect("written");
    let output = vinesink(folder.path(), &["analyze", "case.toml", "--format", "json"]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let mut found: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    // Which text it is of.
    found.as_object_mut().expect("a document").remove("provenance");
    found
}

#[test]
fn accelerations_are_those_of_an_inclined_plane() {
    let found = cavity("restitution = 0.6\ninclination = \"30 deg\"\nfriction = 0.2\n");
    // The constant has thirteen digits.
    let near = |value: f64, expected: f64| {
        assert!((value / expected - 1.0).abs() < 1e-12, "{value} {expected}");
    };
    near(found.gravity_along, 0.5 * GRAVITY);
    near(found.friction_acceleration, 0.2 * 0.75_f64.sqrt() * GRAVITY);
    assert_eq!(found.restitution_difference, 0.0);
    let upright = cavity("restitution = 0.6\ninclination = \"-90 deg\"\n");
    near(upright.gravity_along, -GRAVITY);
    // Every unit, and a share with and without its sign.
    for inclination in ["1800 mrad", "91 deg", "2 rad"] {
        let text = with(&format!("restitution = 0.6\ninclination = \"{inclination}\"\n"));
        assert!(Case::parse("case.toml", &text).is_err(), "{inclination}");
    }
    for (one, other) in [("\"90°\"", FRAC_PI_2), ("\"0.25 rad\"", 0.25), ("\"-250 mrad\"", -0.25)]
    {
        let found = cavity(&format!("restitution = 0.6\ninclination = {one}\nfriction = 1\n"));
        near(found.gravity_along, libm::sin(other) * GRAVITY);
        if other == FRAC_PI_2 {
            assert_eq!(
                found.friction_acceleration, 0.0,
                "nothing presses the absorber on its track"
            );
        } else {
            near(found.friction_acceleration, libm::cos(other) * GRAVITY);
        }
    }
    let shares =
        ["0.003", "\"0.3 %\""].map(|mu| cavity(&format!("restitution = 0.6\nfriction = {mu}\n")));
    assert_eq!(shares[0], shares[1]);
    near(shares[0].friction_acceleration, 0.003 * GRAVITY);
}

#[test]
fn each_wall_has_its_restitution() {
    let case = parsed(TILTED);
    let [plus, minus] = case.system().restitutions();
    close(plus, 0.65);
    close(minus, 0.55);
    let input = case.inputs().iter().find(|input| input.name == "restitution").expect("an input");
    assert_eq!((input.as_written.as_str(), input.unit), ("[0.65, 0.55]", "1"));
    close(input.value, 0.6);
    let ends = parsed(&with("restitution = [0, 1]\n"));
    assert_eq!(ends.system().restitutions(), [0.0, 1.0]);
    // Another mean leaves the difference, and an error leaves both between 0 and 1.
    let other = case.design.with(Parameter::Restitution, 0.5).system().expect("valid");
    let [plus, minus] = other.restitutions();
    close(plus, 0.55);
    close(minus, 0.45);
    for (error, end) in [(1.0, [1.0, 0.9]), (-1.0, [0.1, 0.0])] {
        let off =
            case.design.deviating(&[(Parameter::Restitution, error)]).system().expect("valid");
        let found = off.restitutions();
        // Half an ulp of 1 remains at the end that is 0.
        assert!((0..2).all(|k| (found[k] - end[k]).abs() < 2.0 * f64::EPSILON), "{found:?}");
    }
}

#[test]
fn a_reduced_case_says_the_same_without_units() {
    let case = parsed(TILTED);
    for clearance in [1.0, 2.5] {
        alike(&parsed(&reduced(&case.system(), clearance)).system(), &case.system());
    }
}

/// Not a bit of a result changes where the keys say what is so without them.
#[test]
fn an_ideal_cavity_may_be_written_out() {
    let plain = parsed(&with("restitution = 0.6\n"));
    let text = with("restitution = [0.6, 0.6]\ninclination = \"0 deg\"\nfriction = 0\n");
    let written = parsed(&text);
    assert_eq!(written.system(), plain.system());
    assert_eq!(written.design, plain.design);
    assert!(written.system().cavity().is_ideal());
    assert_eq!(written.derived(), plain.derived());
    let found = analysed(&text);
    assert!(found == analysed(&with("restitution = 0.6\n")));
    assert!(found["reduced"].get("gravity_along").is_none());
    // And 0 in [reduced].
    let lines = "gravity_along = 0\nfriction_acceleration = 0\n";
    let twin = reduced(&plain.system(), 1.0)
        .replace("gravity_along = 0.0\nfriction_acceleration = 0.0\n", lines);
    assert!(twin.contains(lines) && parsed(&twin).system().cavity().is_ideal());
}

#[test]
fn analyze_gives_the_numbers_of_a_cavity() {
    let found = analysed(TILTED);
    let cavity = parsed(TILTED).system().cavity();
    let of = |key: &str| found["reduced"][key].as_f64().expect(key);
    assert_eq!(of("gravity_along"), cavity.gravity_along);
    assert_eq!(of("friction_acceleration"), cavity.friction_acceleration);
    assert_eq!(of("restitution_difference"), cavity.restitution_difference);
    close(of("restitution"), 0.6);
}

/// Page, document and comparison say what the case says; with an ideal cavity they say nothing of it.
#[test]
fn reports_say_what_the_cavity_is() {
    let folder = tempfile::tempdir().expect("a folder");
    let quick = "[simulation]\nstarts = 1\nperiods = 8\ndiscard = 1\n";
    for (of, keys) in [("old", "restitution = 0.6\n"), ("new", KEYS)] {
        let case = folder.path().join("case.toml");
        fs::write(case, with(keys) + quick).expect("written");
        let output = vinesink(folder.path(), &["report", "case.toml", "--out", of]);
        assert_eq!(output.status.code(), Some(0), "{output:?}");
    }
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).expect(name);
    let [old, page] = ["old", "new"].map(|of| read(&format!("{of}/case/report.md")));
    for line in [
        "| absorber restitution | $r$ | [0.65, 0.55] | case file |",
        "| absorber inclination | $\\alpha$ | 0.5 deg | case file |",
        "| absorber friction | $\\mu$ | 0.3 % | case file |",
        // GRAVITY times sin(0.5 deg) = 0.0087265, and times 0.003.
        "| gravity along, over bω₀² | $a$ | 0.004146 | derived |",
        "| friction acceleration, over bω₀² | $f$ | 0.001425 | derived |",
        // What `cavity_report` proves; the reciprocals of the clearances would be 0.1140 mm and 0.4083 mm.
        "in forcing: 0.1150 mm (saddle-node) and 0.4082 mm (slip reversal, where exact orbits stop)",
        "Amplitude of the base, here 0.25 mm: exact orbit from 0.115 mm to 0.408 mm,",
        "The cavity is inclined by 0.5 deg, with a coefficient of friction of 0.003; restitution is 0.65 at x − y = +b and 0.55 at x − y = −b.",
    ] {
        assert!(page.contains(line), "{line} is not in {page}");
        assert!(!old.contains(line), "{line}");
    }
    assert!(
        !page.contains("no friction")
            && old.contains("The case gives its cavity no tilt and no friction.")
    );
    // Theory, orbits and claims are of this cavity; those of an ideal one are said to be.
    for line in [
        "those of an ideal cavity with the mean restitution; in it the case would lie in area Z3.",
        "Fixed points of the slow flow by the theory of this cavity",
        "in clearance: 4.592 mm (slip reversal, where exact orbits stop) and 16.44 mm (saddle-node)",
        "14 of 14 claims",
        "would, with an ideal cavity, lie in Z3",
    ] {
        assert!(page.contains(line), "{line} is not in {page}");
        assert!(!old.contains(line), "{line}");
    }
    assert!(old.contains("The case lies in area Z3") && !page.contains("The case lies in area"));
    let captions = page.lines().filter(|line| line.starts_with("**") && line.contains(".** "));
    for caption in captions {
        let said = caption.split_once(".** ").map_or("", |(_, said)| said);
        assert!(said.matches(". ").count() <= 1, "{caption}");
    }
    let of = |of: &str, id: &str| -> Option<f64> {
        let document: Value =
            serde_json::from_str(&read(&format!("{of}/case/report.json"))).ok()?;
        document["quantities"][id]["value"].as_f64()
    };
    close(of("new", "inclination").expect("there"), 0.5_f64.to_radians());
    assert_eq!(of("new", "friction"), Some(0.003));
    close(of("new", "restitution_at_plus_b").expect("there"), 0.65);
    close(of("new", "restitution_at_minus_b").expect("there"), 0.55);
    assert_eq!([of("old", "inclination"), of("old", "restitution_at_plus_b")], [None, None]);
    let found = vinesink(folder.path(), &["diff", "old", "new"]);
    let found = String::from_utf8(found.stdout).expect("UTF-8");
    assert!(found.contains("| Absorber restitution | 0.6 | [0.65, 0.55] |"), "{found}");
    assert!(found.contains("| Absorber inclination | – | 0.5 deg |"), "{found}");
}

/// Other numbers of a design leave the angle and the coefficient, whatever the scales become.
#[test]
fn gravity_and_friction_stay_when_the_scales_change() {
    let case = parsed(TILTED);
    let changes = [
        (Parameter::Clearance, 0.015, "\"7.5 mm\"", "\"15 mm\""),
        (Parameter::Stiffness, 22_940.0, "\"11.47 kN/m\"", "\"22.94 kN/m\""),
        (Parameter::Mass, 2.084, "\"4.168 kg\"", "\"2.084 kg\""),
    ];
    for (parameter, value, from, to) in changes {
        let found = case.design.with(parameter, value).system().expect("valid");
        let [head, body] = TILTED.split_once("[oscillator]").map(<[&str; 2]>::from).expect("there");
        let written = parsed(&format!("{head}[oscillator]{}", body.replacen(from, to, 1)));
        alike(&found, &written.system());
        // Each change doubles b omega0^2.
        close(2.0 * found.cavity().gravity_along, case.system().cavity().gravity_along);
        close(
            2.0 * found.cavity().friction_acceleration,
            case.system().cavity().friction_acceleration,
        );
    }
    // A clearance of 2.5 units that becomes 5, and the same made of the system.
    let twin = parsed(&reduced(&case.system(), 2.5));
    let wider = twin.design.with(Parameter::Clearance, 5.0).system().expect("valid");
    alike(&wider, &case.design.with(Parameter::Clearance, 0.015).system().expect("valid"));
    alike(&wider, &case.system().with_clearance_scaled(2.0).expect("valid"));
}

/// In [reduced] they are over the clearance, so an axis of them says what holds at that of another axis.
#[test]
fn an_axis_without_units_is_over_the_clearance_of_its_point() {
    let base = reduced(&parsed(TILTED).system(), 2.5);
    for axes in [
        "gravity_along = { values = [-0.1] }\nclearance = { values = [5.0] }\n",
        "clearance = { values = [5.0] }\ngravity_along = { values = [-0.1] }\n",
    ] {
        let plan = Plan::of(&parsed(&format!("{base}[sweep]\n{axes}"))).expect("a sweep");
        let found = plan.point(0).system.expect("valid").cavity();
        assert_eq!(found.gravity_along, -0.1);
        close(
            2.0 * found.friction_acceleration,
            parsed(TILTED).system().cavity().friction_acceleration,
        );
    }
    let text = format!("{base}[sweep]\nfriction_acceleration = {{ values = [0, 0.5] }}\n");
    let plan = Plan::of(&parsed(&text)).expect("a sweep");
    assert_eq!(plan.point(1).system.expect("valid").cavity().friction_acceleration, 0.5);
}

#[test]
fn what_may_be_uncertain_is_what_the_design_has() {
    let table =
        "[uncertainty]\nrestitution = 0.05\ninclination = \"± 0.2 deg\"\nfriction = 0.001\n";
    let uncertain = parsed(&format!("{TILTED}{table}")).uncertainty;
    let keys: Vec<&str> = uncertain.parameters().map(|(one, _)| one.key()).collect();
    assert_eq!(keys, ["restitution", "inclination", "friction"]);
    let twin = reduced(&parsed(TILTED).system(), 1.0);
    let table = "[uncertainty]\ngravity_along = \"± 0.001\"\nfriction_acceleration = 0.001\n";
    assert_eq!(parsed(&format!("{twin}{table}")).uncertainty.parameters().count(), 2);
    // Friction that is less than none is none.
    let off = parsed(TILTED).design.deviating(&[(Parameter::Friction, -1.0)]);
    assert_eq!(off.system().expect("valid").cavity().friction_acceleration, 0.0);
}

/// A file that is written with another restitution keeps the difference, and what it says of the cavity.
#[test]
fn a_rewritten_case_keeps_its_pair() {
    let case = parsed(TILTED);
    let design = case.design.with(Parameter::Restitution, 0.7).with(Parameter::Clearance, 0.01);
    let changed = case.rewritten("case.toml", TILTED, &design, Rounding::Nearest).expect("valid");
    let wanted = TILTED.replace("[0.65, 0.55]", "[0.75, 0.65]").replace("\"7.5 mm\"", "\"10 mm\"");
    assert_eq!(changed.text, wanted);
    let steep = case.design.with(Parameter::Inclination, 1f64.to_radians());
    let degrees = TILTED.replace("0.5 deg", "0.5°");
    let case = parsed(&degrees);
    let changed = case.rewritten("case.toml", &degrees, &steep, Rounding::Nearest).expect("valid");
    assert_eq!(changed.text, degrees.replace("0.5°", "1 °"));
}

#[test]
fn what_is_wrong_is_said_where_it_stands() {
    let twin = reduced(&parsed(TILTED).system(), 1.0);
    for (text, underlined, message, expected, help) in [
        (
            with("restitution = 0.6\nfriction = -0.1\n"),
            "-0.1",
            "`friction` is -0.1",
            "0 or more",
            "0.003",
        ),
        (
            with("restitution = 0.6\ninclination = \"100 deg\"\n"),
            "\"100 deg\"",
            "`inclination` is 100 deg",
            "expected a value from -90 deg to 90 deg",
            "\"0.5 deg\"",
        ),
        (
            with("restitution = 0.6\ninclination = 0.5\n"),
            "0.5",
            "`inclination` has no unit",
            "an angle such as \"0.5 deg\"",
            "inclination = \"0.5 deg\"",
        ),
        (
            with("restitution = 0.6\ninclination = \"0.5 degs\"\n"),
            "degs",
            "`inclination` has the unknown unit `degs`",
            "an angle",
            "did you mean `deg`?",
        ),
        (
            with("restitution = [0.6]\n"),
            "[0.6]",
            "`restitution` is not a pair",
            "two values, between brackets",
            "restitution = [0.65, 0.55]",
        ),
        (
            with("restitution = [0.6, 1.2]\n"),
            "1.2",
            "a value of `restitution` is 1.2",
            "from 0 to 1",
            "restitution = [0.65, 0.55]",
        ),
        (
            with("restitution = 0.6\ninclinaton = \"1 deg\"\n"),
            "inclinaton",
            "unknown key `inclinaton` in [absorber]",
            "inclination, orientation, friction",
            "did you mean `inclination`?",
        ),
        (
            format!("{TILTED}[optimize]\nfriction = [0, 0.1]\n"),
            "friction",
            "unknown key `friction` in [optimize]",
            "clearance",
            "belongs in [absorber]",
        ),
        (
            format!("{TILTED}[uncertainty]\ngravity_along = 0.1\n"),
            "gravity_along",
            "a design in [oscillator], [absorber] and [excitation] has no `gravity_along` that could be uncertain",
            "a number that the design has",
            "inclination instead",
        ),
        (
            format!("{twin}[sweep]\nfriction = {{ values = [0.1] }}\n"),
            "friction",
            "a design in [reduced] has no `friction` to vary",
            "a number that the design has",
            "vary friction_acceleration instead",
        ),
    ] {
        let error = Case::parse("case.toml", &text).expect_err(message);
        let problems: Vec<_> = error.problems().collect();
        assert_eq!(problems.len(), 1, "{error:?}");
        let found = problems[0];
        assert_eq!((found.message.as_str(), found.underlined.as_str()), (message, underlined));
        assert!(found.expected.contains(expected), "{}", found.expected);
        assert!(found.help.as_ref().is_some_and(|said| said.contains(help)), "{:?}", found.help);
    }
}

/// Nothing is decided by areas that are those of another cavity.
#[test]
fn areas_of_an_ideal_cavity_decide_nothing() {
    let band = "\n[band]\nfrom = \"7.9 Hz\"\nto = \"8.1 Hz\"\n";
    for (table, key) in [
        ("[criteria]\nz3_share = \">= 50 %\"\n", "z3_share"),
        ("[optimize]\nobjective = \"z3-share\"\n", "objective"),
    ] {
        let (ideal, real) = (with("restitution = 0.6\n"), TILTED);
        assert!(Case::parse("case.toml", &format!("{ideal}{band}{table}")).is_ok(), "{table}");
        let text = format!("{real}{band}{table}");
        let error = Case::parse("case.toml", &text).expect_err("refused");
        let problems: Vec<_> = error.problems().collect();
        assert_eq!(problems.len(), 1, "{error:?}");
        let found = problems[0];
        assert!(found.message.contains("area Z3 is of a level cavity"), "{}", found.message);
        assert!(found.underlined.starts_with(key), "{}", found.underlined);
        assert!(
            found.help.as_ref().is_some_and(|said| said.contains("stable")),
            "{:?}",
            found.help
        );
    }
    let task = |text: &str, objective| Task::of(&parsed(&format!("{text}{band}")), objective);
    let refused = task(TILTED, Some(Objective::Z3Share));
    assert!(matches!(refused, Err(OptimizeError::RealCavity)), "{refused:?}");
    // What nobody asks for otherwise is the smallest vibration; else what the first criterion is about.
    assert_eq!(task(TILTED, None).expect("driven").objective, Objective::WorstAmplitude);
    let asked = format!(
        "{TILTED}{band}[criteria]\nstable_share = \">= 10 %\"\npeak_displacement = \"<= 1 m\"\n"
    );
    let asked = Task::of(&parsed(&asked), None).expect("driven");
    assert_eq!(asked.objective, Objective::StableShare);
}
