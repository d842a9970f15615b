//! A structure of one mode with one absorber is one structure, however it is written: as `[oscillator]` and `[absorber]`, or as
//! `[[mode]]` and `[[absorber]]`.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::Path;

use serde_json::Value;
use vinesink::case::{Case, Design, Rounding, is_modal};
use vinesink::system::{Excitation, Parameter};

use super::common::random::Random;
use super::run::vinesink;

/// A structure that is driven steadily, in SI units.
struct Written {
    name: String,
    mass: f64,
    hertz: f64,
    damping_ratio: f64,
    absorber: f64,
    clearance: f64,
    restitution: f64,
    excitation: Excitation,
    amplitude: f64,
    /// In Hz; one that is both is a single excitation.
    range: [f64; 2],
}

impl Written {
    /// Of a shipped case; none of one that says more than both ways of writing can.
    fn shipped(path: &Path) -> Option<Self> {
        let text = std::fs::read_to_string(path).ok()?;
        let case = Case::parse("case.toml", &text).ok()?;
        let Design::Physical(of) = &case.design else { return None };
        let level =
            of.inclination_rad == 0.0 && of.friction == 0.0 && of.restitution_difference == 0.0;
        let bare = of.transient.is_none() && of.contact_time_s.is_none() && of.support.is_none();
        let range = case.range();
        let over_frequency = range.range.map(|end| case.units().frequency(end));
        let ends = if range.is_point() { [of.frequency_hz; 2] } else { over_frequency };
        (level && bare && range.spectrum.is_empty()).then(|| Self {
            name: path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
            mass: of.mass_kg,
            hertz: (of.stiffness_n_per_m / of.mass_kg).sqrt() / TAU,
            damping_ratio: 0.5 * of.damping_n_s_per_m / (of.stiffness_n_per_m * of.mass_kg).sqrt(),
            absorber: of.absorber_mass_kg,
            clearance: of.clearance_m,
            restitution: of.restitution,
            excitation: of.excitation,
            amplitude: of.amplitude,
            range: ends,
        })
    }

    /// One that nobody chose: a clearance of 2 to 10 % of what an acceleration of 1 g moves, a structure that moves by 1.2 to 10
    /// clearances without an absorber.
    fn drawn(number: u32, random: &mut Random) -> Self {
        let hertz = random.ratio(0.4, 200.0);
        let mass = random.ratio(0.3, 3e4);
        let damping_ratio = random.ratio(0.001, 0.015);
        let ratio = random.ratio(0.004, 0.06);
        let omega = TAU * hertz;
        let clearance = 9.81 / (omega * omega) * random.within(0.02, 0.1);
        let alone = clearance * random.ratio(1.2, 10.0);
        let by_force = random.one_in(2.0);
        let width = (3.0 * damping_ratio).max(0.5 * ratio);
        let at = hertz * (1.0 + width * random.within(-1.0, 1.0));
        let band = [-1.0, 1.0].map(|side| hertz * (1.0 + side * width * random.within(0.5, 1.5)));
        let (excitation, amplitude) = match by_force {
            true => (Excitation::Force, alone * 2.0 * damping_ratio * mass * omega * omega),
            false => (Excitation::BaseDisplacement, alone * 2.0 * damping_ratio),
        };
        Self {
            name: format!("drawn-{number}"),
            mass,
            hertz,
            damping_ratio,
            absorber: ratio * mass,
            clearance,
            restitution: random.within(0.2, 0.85),
            excitation,
            amplitude,
            range: if random.one_in(2.0) { [at; 2] } else { band },
        }
    }

    /// As one structure and as a list of modes, with a limit of the largest displacement in m.
    fn both(&self, limit: f64) -> [String; 2] {
        let Self { mass, hertz, damping_ratio, absorber, clearance, restitution, .. } = self;
        let (kind, unit) = match self.excitation {
            Excitation::Force => ("force", "N"),
            _ => ("base-displacement", "m"),
        };
        let driven = format!("kind = '{kind}'\namplitude = '{:?} {unit}'\n", self.amplitude);
        let structure = format!(
            "mass = '{mass:?} kg'\nfrequency = '{hertz:?} Hz'\ndamping_ratio = {damping_ratio:?}\n"
        );
        let carried = format!(
            "mass = '{absorber:?} kg'\nclearance = '{clearance:?} m'\nrestitution = {restitution:?}\n"
        );
        let [from, to] = self.range;
        // A load over a range has none of its own: that of the structure stands for it, or the end next to it.
        let own = hertz.clamp(from, to);
        let band = match from < to {
            true => format!(
                "frequency = '{own:?} Hz'\n[band]\nfrom = '{from:?} Hz'\nto = '{to:?} Hz'\n"
            ),
            false => format!("frequency = '{from:?} Hz'\n"),
        };
        let listed = match from < to {
            true => format!("from = '{from:?} Hz'\nto = '{to:?} Hz'\n"),
            false => band.clone(),
        };
        let on = if kind == "force" { "place = 'top'\n" } else { "" };
        let moves = if kind == "force" { "" } else { "participation = 1.0\n" };
        let head = "title = 't'\nsource = 's'\n";
        let asked = format!("[criteria]\npeak_displacement = '<= {limit:?} m'\n");
        [
            format!(
                "{head}[oscillator]\n{structure}[absorber]\n{carried}[excitation]\n{driven}{band}{asked}"
            ),
            format!(
                "{head}[[mode]]\n{structure}shape = {{ top = 1.0 }}\n{moves}[[absorber]]\nplace = 'top'\n{carried}\
                 [[excitation]]\n{on}{driven}{listed}{asked}"
            ),
        ]
    }
}

/// What a command says of a case in each way of writing.
fn said(texts: &[String; 2], arguments: &[&str]) -> [Value; 2] {
    let folder = tempfile::tempdir().expect("a folder");
    [0, 1].map(|k| {
        // The same name, as pages have it.
        let place = folder.path().join(k.to_string());
        std::fs::create_dir(&place).expect("a folder");
        let path = place.join("case.toml");
        std::fs::write(&path, &texts[k]).expect("written");
        let (path, out) = (path.display().to_string(), place.display().to_string());
        let mut all = vec![arguments[0], &path];
        all.extend(&arguments[1..]);
        if arguments[0] == "sweep" {
            all.extend(["--out", &out]);
        }
        let output = vinesink(&all);
        let text = match arguments[0] {
            "sweep" => std::fs::read(place.join("case/sweep.json")).unwrap_or_default(),
            _ => output.stdout,
        };
        serde_json::from_slice(&text).unwrap_or_else(|_| {
            panic!("{arguments:?}\n{}\n{}", texts[k], String::from_utf8_lossy(&output.stderr))
        })
    })
}

/// Keys of what is written, and of where it was: the text is another one.
const WRITING: [&str; 8] =
    ["case", "case_sha256", "inputs", "text", "sha256", "results_sha256", "derived", "path"];

/// Where two documents differ beyond rounding, with both values.
fn differences(at: &str, one: &Value, other: &Value, told: &mut Vec<String>) {
    match (one, other) {
        (Value::Object(a), Value::Object(b)) => {
            for key in a.keys().chain(b.keys().filter(|key| !a.contains_key(*key))) {
                if !WRITING.contains(&key.as_str()) {
                    differences(&format!("{at}.{key}"), &one[key], &other[key], told);
                }
            }
        }
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            for (k, (one, other)) in a.iter().zip(b).enumerate() {
                differences(&format!("{at}[{k}]"), one, other, told);
            }
        }
        (Value::Number(a), Value::Number(b)) => {
            let [a, b] = [a, b].map(|of| of.as_f64().unwrap_or(f64::NAN));
            if (a - b).abs() > 1e-6 * a.abs().max(b.abs()) + 1e-12 {
                told.push(format!("{at} {a:?} {b:?}"));
            }
        }
        _ if one != other => told.push(format!("{at} {one} {other}")),
        _ => {}
    }
}

/// What differs between what a command says of each.
fn compared(texts: &[String; 2], arguments: &[&str]) -> Vec<String> {
    let [one, other] = said(texts, arguments);
    let mut told = Vec::new();
    differences("", &one, &other, &mut told);
    told
}

#[test]
#[ignore = "deep"]
fn one_mode_is_one_structure_however_it_is_written() {
    let mut random = Random(20_261_129);
    let mut designs: Vec<Written> = std::fs::read_dir("cases")
        .expect("cases")
        .filter_map(|entry| Written::shipped(&entry.expect("an entry").path()))
        .collect();
    designs.sort_by(|a, b| a.name.cmp(&b.name));
    let shipped = designs.len();
    designs.extend((0..40).map(|number| Written::drawn(number, &mut random)));
    let (mut told, mut differ, mut holds) = (String::new(), 0, 0);
    for (number, design) in designs.iter().enumerate() {
        let mut texts = design.both(1e3);
        // A limit between what was found and what it may be.
        let [found, _] = said(&texts, &["check", "--criteria-only", "--format", "json"]);
        let found = &found["cases"][0]["criteria"][0]["found"];
        let limit = 1.05 * found["value"].as_f64().or(found.as_f64()).expect("a value");
        texts = design.both(limit);
        let mut asked: Vec<Vec<&str>> = vec![
            vec!["check", "--criteria-only", "--format", "json"],
            vec!["simulate", "--format", "json"],
            vec!["analyze", "--format", "json"],
        ];
        // What takes longer of every sixteenth.
        if number % 16 == 0 {
            asked.push(vec!["check", "--format", "json"]);
            asked.push(vec!["optimize", "--format", "json"]);
            asked.push(vec!["sweep"]);
            let sweep = format!(
                "[sweep]\nstarts = 3\nperiods = 100\nclearance = {{ values = ['{:?} m', '{:?} m'] }}\n",
                0.7 * design.clearance,
                1.3 * design.clearance
            );
            texts.iter_mut().for_each(|text| text.push_str(&sweep));
        }
        for arguments in asked {
            let all = compared(&texts, &arguments);
            if !all.is_empty() {
                differ += 1;
                let some = all.iter().take(4).cloned().collect::<Vec<_>>().join("; ");
                writeln!(told, "{} {arguments:?}: {}: {some}", design.name, all.len())
                    .expect("written");
            }
        }
        let [judged, _] = said(&texts, &["check", "--criteria-only", "--format", "json"]);
        holds += usize::from(judged["cases"][0]["criteria"][0]["holds"] == true);
    }
    println!("{shipped} shipped of {}, {holds} hold", designs.len());
    assert!(
        differ == 0,
        "{shipped} shipped, {differ} answers of {} differ:\n{told}",
        designs.len()
    );
    assert!(holds > 5 && holds < designs.len() - 5, "{holds}");
}

const LISTS: &str = "title = 't'\nsource = 's'\n[[mode]]\nfrequency = '180 Hz'\ndamping_ratio = '1 %'\nmass = '0.4 kg'\n\
    shape = { centre = 2.0 }\n[[absorber]]\nplace = 'centre'\nmass = '4 g'\nclearance = '60 um'\nrestitution = 0.6\n\
    [[excitation]]\nkind = 'force'\nplace = 'centre'\namplitude = '0.5 N'\nfrom = '165 Hz'\nto = '175 Hz'\n\
    [criteria]\npeak_displacement = { limit = '<= 0.1 mm', place = 'centre' }\n[uncertainty]\nclearance = '3 um'\n";
const TABLES: &str = "title = 't'\nsource = 's'\n[oscillator]\nfrequency = '180 Hz'\ndamping_ratio = '1 %'\nmass = '0.1 kg'\n\
    [absorber]\nmass = '4 g'\nclearance = '60 um'\nrestitution = 0.6\n[excitation]\nkind = 'force'\namplitude = '0.5 N'\n\
    frequency = '175 Hz'\n[band]\nfrom = '165 Hz'\nto = '175 Hz'\n[criteria]\npeak_displacement = '<= 0.1 mm'\n\
    [uncertainty]\nclearance = '3 um'\n";

/// At a place where the shape is 2 the mass is a quarter of that of the mode. A range has its own excitation at the structure's
/// frequency, or at the end next to it; every table of one mode stands beside lists as well.
#[test]
fn lists_of_one_are_one_structure() {
    let parsed = |text: &str| Case::parse("case.toml", text).unwrap_or_else(|e| panic!("{e:?}"));
    let (lists, tables) = (parsed(LISTS), parsed(TABLES));
    let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-14;
    let [one, other] = [&lists, &tables].map(|case| case.system());
    assert!(close(one.mass_ratio(), other.mass_ratio()) && close(one.mass_ratio(), 0.04));
    assert!(close(one.damping(), other.damping()));
    assert!(close(one.forcing_per_clearance(), other.forcing_per_clearance()));
    assert!(close(one.frequency_ratio(), other.frequency_ratio()));
    assert_eq!(
        lists.range().range.map(|end| (end * 1e12).round()),
        tables.range().range.map(|end| (end * 1e12).round())
    );
    assert_eq!(lists.criteria.len(), 1);
    assert!(lists.uncertainty.parameters().next().is_some());
    // The mass that is said, and that varies, is the mode's.
    assert_eq!(lists.design.value(Parameter::Mass), Some(0.4));
    let heavier = |case: &Case, kg: f64| case.design.with(Parameter::Mass, kg).system();
    let [heavy, other] =
        [heavier(&lists, 0.44), heavier(&tables, 0.11)].map(|one| one.expect("valid"));
    assert!(
        close(heavy.mass_ratio(), other.mass_ratio()) && close(heavy.damping(), other.damping())
    );
    assert!(close(heavy.frequency_ratio(), other.frequency_ratio()));
    let share = parsed(&LISTS.replace("mass = '4 g'", "mass_ratio = '4 %'"));
    assert!(close(share.system().mass_ratio(), 0.04));
    // What stands in lists is changed there.
    let design = lists.design.with(Parameter::Clearance, 70e-6);
    let changed = lists.rewritten("case.toml", LISTS, &design, Rounding::Nearest);
    assert_eq!(changed.expect("a case").text, LISTS.replace("'60 um'", "\"70 um\""));

    // A base moves the structure as it does itself only with phi Gamma = 1.
    let base = |participation: f64| {
        let moved = format!("2.0 }}\nparticipation = {participation}");
        let text = LISTS
            .replace("2.0 }", &moved)
            .replace("place = 'centre'\namplitude = '0.5 N'", "amplitude = '1 um'");
        text.replace("kind = 'force'", "kind = 'base-displacement'")
    };
    assert_eq!(parsed(&base(0.5)).system().excitation(), Excitation::BaseDisplacement);
    let two = "2.0, edge = 0.1 }";
    let several = [
        base(0.6),
        LISTS.replace("2.0 }", two),
        LISTS.replace("kind = 'force'\nplace = 'centre'", "kind = 'force'\nmode = 1"),
    ];
    for text in &several {
        assert!(is_modal(text), "{text}");
    }
    assert!(!is_modal(LISTS) && !is_modal(TABLES));
    // A list of one absorber beside [oscillator] too.
    let listed = TABLES.replace("[absorber]", "[[absorber]]");
    let listed = listed.replace("[excitation]", "[[excitation]]");
    assert_eq!(parsed(&listed).system(), tables.system());
    let error = Case::parse("case.toml", &listed.replace("'4 g'", "'4 m'")).expect_err("no mass");
    let told = error.to_string();
    assert!(told.contains("mass") && !told.contains("[[mode]]"), "{told}");
    let error = Case::parse("case.toml", &LISTS.replace("'1 %'", "'1 Hz'")).expect_err("no share");
    assert!(!error.to_string().contains("oscillator"), "{error}");
}
