//! How far numbers of a structure of several modes may change before a criterion fails.

use serde_json::Value;
use vinesink::answer::{Answer, Asked};
use vinesink::case::{Case, ModalCase};
use vinesink::executor::Serial;
use vinesink::modal::ModalAnswer;
use vinesink::operating_range::{
    HoldsFor, Reliability, Together, Varied, Varies, combined, holds_for,
};

use super::choice::{checked, fails, with};

/// A board with two modes that hardly shakes where its absorber works.
fn board(limit: &str, excitation: &str) -> String {
    format!(
        "title = 't'\nsource = 's'\n[[mode]]\nfrequency = '180 Hz'\ndamping_ratio = 0.012\nmass = '120 g'\n\
         shape = {{ centre = 1, edge = 0.3 }}\n[[mode]]\nfrequency = '410 Hz'\ndamping_ratio = 0.01\nmass = '90 g'\n\
         shape = {{ centre = -0.4, edge = 1 }}\n[[absorber]]\nplace = 'centre'\nmass = '5 g'\nclearance = \"0.25 mm\"\n\
         restitution = 0.6\n[[excitation]]\nkind = 'force'\nplace = 'centre'\namplitude = \"1 N\"\n{excitation}\n\
         [criteria]\npeak_displacement = {{ limit = '<= {limit}', place = 'centre' }}\n"
    )
}

fn ranges(text: &str, numbers: &[Varied], least: Together) -> Vec<HoldsFor> {
    let case = ModalCase::parse("case.toml", text).expect("a case");
    let answer = ModalAnswer::of(&case, &Serial).expect("flown");
    answer.decided(&case, numbers, least, false, &Serial).expect("flown").holds_for
}

/// At each end of a range `check` finds nothing that fails, beyond it, by a fifth of the way from the case, it does, and at each
/// design that is said to have been tried all criteria hold.
fn ends_where_check_says_so(text: &str, numbers: &[(Varied, &str, &str)], least: [usize; 2]) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("case.toml");
    let path = path.to_str().expect("UTF-8");
    let (mut ends, mut held) = (0, 0);
    for (number, key, unit) in numbers {
        let found = ranges(text, &[*number], Together::Undecided);
        let [range] = &found[..] else { panic!("{found:?}") };
        let there = |value: f64| -> Value {
            std::fs::write(path, with(text, &[key], value, unit)).expect("written");
            checked(path, &["--criteria-only"])
        };
        for (end, at) in range.range.into_iter().enumerate() {
            assert!(!fails(&there(at)), "{key}: fails at {at}, {range:?}");
            if !range.open[end] {
                let own = range.value;
                let beyond = at + 0.2 * (at - own) + 0.02 * (at - own).signum() * own;
                assert!(fails(&there(beyond)), "{key}: holds at {beyond}, {range:?}");
                ends += 1;
            }
        }
        if range.holds.is_some() {
            for at in &range.tried {
                assert_eq!(there(*at)["holds"], true, "{key}: not at {at}, {range:?}");
                held += 1;
            }
        }
    }
    println!("{ends} ends, {held} designs that hold");
    assert!(ends >= least[0] && held >= least[1], "{ends} ends, {held} designs that hold");
}

const NUMBERS: [(Varied, &str, &str); 3] = [
    (Varied::Amplitude, "amplitude", "N"),
    (Varied::Clearance, "clearance", "m"),
    (Varied::Restitution, "restitution", "1"),
];

#[test]
fn ranges_of_a_load_over_frequencies_end_where_check_says_so() {
    let text = board("0.35 mm", "from = '165 Hz'\nto = '195 Hz'");
    ends_where_check_says_so(&text, &NUMBERS[..1], [1, 2]);
}

#[test]
#[ignore = "deep"]
fn all_ranges_of_a_board_end_where_check_says_so() {
    ends_where_check_says_so(&board("0.35 mm", "from = '165 Hz'\nto = '195 Hz'"), &NUMBERS, [1, 6]);
    ends_where_check_says_so(&board("0.3 mm", "frequency = '182 Hz'"), &NUMBERS, [1, 12]);
}

/// A mode that takes no part leaves the ranges of the one mode and its engine: what varies, every value that is tried, and where all hold.
#[test]
fn a_mode_that_takes_no_part_leaves_the_ranges() {
    let one = format!(
        "title = 't'\nsource = 's'\n[oscillator]\n{SPRING}[absorber]\n{ABSORBER}[excitation]\n{EXCITATION}\
         [criteria]\npeak_displacement = '<= 2.2 mm'\n"
    );
    let numbers = [Varied::Amplitude, Varied::NaturalFrequency, Varied::Mass, Varied::Clearance];
    let several = ranges(&with_idle_mode(""), &numbers, Together::Hold);
    let case = Case::parse("case.toml", &one).expect("a case");
    let judged = Answer::of(&case, Asked::Criteria, None, &Serial).expect("judged").judged;
    let single = holds_for(&case, &judged, &numbers, Together::Hold, &case.effort(), &Serial);
    let single = single.expect("ranges");
    assert_eq!(several.len(), numbers.len());
    for (several, single) in several.iter().zip(&single) {
        println!("{:?}: {:?} {:?}", several.parameter, several.holds, single.holds);
        assert_eq!(several.parameter, single.parameter);
        let (several, single) = (several.holds.expect("holds"), single.holds.expect("holds"));
        for (a, b) in several.into_iter().zip(single) {
            assert!((a / b - 1.0).abs() < 1e-12, "{several:?} {single:?}");
        }
    }
}

/// With the amplitude of a load and the natural frequencies changed at once the same designs hold and fail as of the one mode, where a
/// second one takes no part.
#[test]
fn a_mode_that_takes_no_part_leaves_the_combinations() {
    let limit = "peak_displacement = '<= 3.4 mm'\n";
    let one = format!(
        "title = 't'\nsource = 's'\n[oscillator]\n{SPRING}[absorber]\n{ABSORBER}[excitation]\n{EXCITATION}[criteria]\n{limit}"
    );
    let one = Case::parse("case.toml", &one).expect("a case");
    let judged = Answer::of(&one, Asked::Criteria, None, &Serial).expect("answered").judged;
    let effort = one.effort();
    let numbers = &Varied::FIRST;
    let found = holds_for(&one, &judged, numbers, Together::Undecided, &effort, &Serial);
    let single = combined(&one, &found.expect("flown"), &effort, &Serial).expect("flown");
    let two = with_idle_mode("").replace("<= 2.2 mm", "<= 3.4 mm");
    let two = ModalCase::parse("case.toml", &two).expect("a case");
    let answer = ModalAnswer::of(&two, &Serial).expect("flown");
    let answer = answer.decided(&two, numbers, Together::Undecided, false, &Serial);
    let several = answer.expect("flown").combined(&two, &Serial).expect("flown").combined;
    println!("{single:?}\n{several:?}");
    assert_eq!(single.len(), several.len());
    let (mut alike, mut promised) = (0, 0);
    for (a, b) in single.iter().zip(&several) {
        assert_eq!(b.of, None, "there is one load");
        let off = [0, 1].map(|k| (a.at[k] / b.at[k] - 1.0).abs());
        // An end is known to an eighth of a step, and the worst place of a stretch may be another one of its places.
        let same = off[0] < 0.02 && off[1] < 0.02;
        if same && a.outcome != Together::Undecided && b.outcome != Together::Undecided {
            assert_eq!(a.outcome, b.outcome, "{a:?} {b:?}");
            alike += 1;
        }
        if !b.promised {
            continue;
        }
        promised += 1;
        // As a case with both numbers, read anew.
        let [amplitude, frequency] = b.at;
        let text = with_idle_mode("").replace("<= 2.2 mm", "<= 3.4 mm");
        let text = text.replacen("frequency = '5 Hz'", &format!("frequency = '{frequency} Hz'"), 1);
        let text = text.replace("'17 Hz'", &format!("'{} Hz'", 17.0 / 5.0 * frequency));
        let text = text.replace("amplitude = '0.1 N'", &format!("amplitude = '{amplitude} N'"));
        let there = ModalCase::parse("case.toml", &text).expect("a case");
        let judged = ModalAnswer::of(&there, &Serial).expect("flown").judged;
        assert_eq!(Together::of(&judged), b.outcome, "{b:?}");
    }
    assert!(alike >= 8 && promised >= 4, "{alike} {promised}");
}

const SPRING: &str = "mass = '1 kg'\nfrequency = '5 Hz'\ndamping_ratio = 0.02\n";
const ABSORBER: &str = "mass = '30 g'\nclearance = '2 mm'\nrestitution = 0.5\n";
const EXCITATION: &str = "kind = 'force'\namplitude = '0.1 N'\nfrequency = '5 Hz'\n";
const UNCERTAIN: &str = "[uncertainty]\nclearance = '± 0.8 mm'\nrestitution = 0.05\namplitude = '60 mN'\noscillator_mass = '30 g'\n\
                         natural_frequency = '0.1 Hz'\ndamping_ratio = '± 0.5 %'\nabsorber_mass = '2 g'\nsamples = 40\n";

/// A structure with a mode that takes no part.
fn with_idle_mode(more: &str) -> String {
    format!(
        "title = 't'\nsource = 's'\n[[mode]]\n{SPRING}shape = {{ a = 1, b = 0 }}\n\
         [[mode]]\nmass = '1 kg'\nfrequency = '17 Hz'\ndamping_ratio = 0.02\nshape = {{ a = 0, b = 1 }}\n\
         [[absorber]]\nplace = 'a'\n{ABSORBER}[[excitation]]\nplace = 'a'\n{EXCITATION}\
         [criteria]\npeak_displacement = {{ limit = '<= 2.2 mm', place = 'a' }}\n{more}"
    )
}

/// The same designs are drawn of a structure with a mode that takes no part as of the one mode, and as many fail, by the engine of
/// several modes and that of one.
#[test]
fn a_mode_that_takes_no_part_leaves_the_probability() {
    let one = format!(
        "title = 't'\nsource = 's'\n[oscillator]\n{SPRING}[absorber]\n{ABSORBER}[excitation]\n{EXCITATION}\
         [criteria]\npeak_displacement = '<= 2.2 mm'\n{UNCERTAIN}"
    );
    let two = ModalCase::parse("case.toml", &with_idle_mode(UNCERTAIN)).expect("a case");
    let answer = ModalAnswer::of(&two, &Serial).expect("flown");
    let answer = answer.decided(&two, &[], Together::Hold, true, &Serial).expect("flown");
    let several = answer.reliability.expect("something is uncertain");
    let one = Case::parse("case.toml", &one).expect("a case");
    let single = Reliability::of(&one, &one.effort(), &Serial).expect("flown");
    let single = single.expect("something is uncertain");
    println!("{several:?}\n{single:?}");
    let fail = |of: &Reliability| of.samples - of.hold - of.undecided;
    assert_eq!([several.samples, fail(&several)], [single.samples, fail(&single)]);
    // What wanders of several modes is given up earlier, and is not decided then.
    assert!(several.hold.abs_diff(single.hold) <= 1, "{several:?} {single:?}");
    // Or nothing would be told apart.
    assert!(fail(&several) > 5 && several.hold > 5, "{several:?}");
}

/// What cannot be uncertain is refused with what to do.
#[test]
fn what_cannot_be_uncertain_of_several_is_refused() {
    let base =
        "[[excitation]]\nkind = 'base-displacement'\namplitude = '1 mm'\nfrequency = '5 Hz'\n";
    let undamped = with_idle_mode("[uncertainty]\ndamping_ratio = '0.1 %'\n");
    let undamped = undamped.replacen("damping_ratio = 0.02", "damping_ratio = 0", 1);
    let undamped =
        undamped.replacen("frequency = '5 Hz'\n[criteria]", "frequency = '4 Hz'\n[criteria]", 1);
    let participates = |text: String| text.replace("shape =", "participation = 1\nshape =");
    let reduced = "title = 't'\nsource = 's'\n[reduced]\nfrequency_ratio = 1.0\n[[reduced.mode]]\nfrequency_ratio = 1.0\n\
                   damping_ratio = 0.02\nmass = 1.0\nforcing = 0.01\nshape = { a = 1 }\n[[reduced.mode]]\nfrequency_ratio = 3.0\n\
                   damping_ratio = 0.02\nmass = 1.0\nforcing = 0.0\nshape = { a = 1 }\n[[reduced.absorber]]\nmass = 0.03\n\
                   clearance = 1.0\nrestitution = 0.5\n[uncertainty]\nclearance = 0.1\nabsorber_mass = 0.01\n";
    for (text, message) in [
        (with_idle_mode("[uncertainty]\ninclination = '1 deg'\n"), "unknown key `inclination`"),
        (with_idle_mode("[uncertainty]\nclearance = '1 kg'\n"), "kg"),
        (with_idle_mode("[uncertainty]\namplitude = '1 mm'\n"), "mm"),
        (
            participates(with_idle_mode(&format!("{base}[uncertainty]\namplitude = '1 N'\n"))),
            "one error cannot be",
        ),
        (undamped, "undamped first mode"),
        (reduced.to_owned(), "`absorber_mass` cannot be uncertain beside [reduced]"),
    ] {
        let error = ModalCase::parse("case.toml", &text).expect_err(message);
        let told: Vec<&str> = error.problems().map(|one| one.message.as_str()).collect();
        assert!(told.len() == 1 && told[0].contains(message), "{message}: {told:?}");
    }
    let own = reduced.replace("absorber_mass = 0.01\n", "damping_ratio = 0.001\n");
    let case = ModalCase::parse("case.toml", &own).expect("a case");
    assert_eq!(case.uncertainty.parameters().count(), 2);
}

/// A design fails before anything is flown where a criterion does that exact orbits decide, and only there.
#[test]
fn what_needs_no_simulation_decides_first() {
    let with = |asked: &str| {
        let text = with_idle_mode("")
            .replace("peak_displacement = { limit = '<= 2.2 mm', place = 'a' }", asked);
        ModalCase::parse("case.toml", &text).expect("a case")
    };
    let peak = "peak_displacement = '<= 1 nm'\n";
    for (asked, fails) in [
        (format!("{peak}margin_clearance = '>= 99 %'"), true),
        (format!("{peak}margin_clearance = '>= 1 %'"), false),
        (peak.to_owned(), false),
    ] {
        assert_eq!(with(&asked).fails_unflown().expect("nothing is flown"), fails, "{asked}");
    }
}
