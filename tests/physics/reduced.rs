//! A design in physical units that is let go, struck, swept or driven by a record, and the same by hand without units:
//! one structure, so the same answers over the clearance and in fast time.

#![allow(clippy::disallowed_methods, reason = "a test may use the platform's functions")]

use std::f64::consts::TAU;

use vinesink::case::Case;
use vinesink::criteria::judge_transient;
use vinesink::excitation::Record;
use vinesink::executor::Serial;
use vinesink::flights::{Passage, follow};
use vinesink::linear::swept;
use vinesink::system::State;
use vinesink::transient::{DecayStudy, Study};

/// Roundings of the numbers themselves, which a few hundred impacts of a motion that attracts do not enlarge.
const ROUNDING: f64 = 1e-12;

fn close(physical: f64, reduced: f64, what: &str) {
    let off = (physical - reduced).abs();
    assert!(off <= ROUNDING * physical.abs(), "{what}: {physical} {reduced}");
}

fn case(tables: &str) -> Case {
    let text = format!("title = \"t\"\nsource = \"s\"\n{tables}");
    Case::parse("case.toml", &text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// By hand: omega0 = sqrt(16/4) = 2 rad/s, eps = 0.0625/4, lambda = 0.09375/(0.0625 x 2) = 0.75. The unit of length is
/// half the clearance, 0.0625 m, that of velocity 0.125 m/s, of acceleration 0.25 m/s². All exact in a double, so that
/// not even an irregular motion has a difference to enlarge.
const PHYSICAL: &str = "[oscillator]\nmass = \"4 kg\"\nstiffness = \"16 N/m\"\ndamping = \"0.09375 N s/m\"\n\
    [absorber]\nmass = \"62.5 g\"\nclearance = \"12.5 cm\"\nrestitution = 0.6\n[excitation]\n";
const REDUCED: &str =
    "[reduced]\nmass_ratio = 0.015625\ndamping = 0.75\nrestitution = 0.6\nclearance = 2\n";

/// The same structure twice, with an excitation and perhaps tables behind it.
fn twice(physical: &str, reduced: &str) -> [Case; 2] {
    let [physical, reduced] =
        [[PHYSICAL, physical], [REDUCED, reduced]].map(|it| case(&it.concat()));
    let [one, other] = [&physical, &reduced].map(|case| case.system().parameters());
    assert_eq!(one.mass_ratio, other.mass_ratio);
    assert_eq!(one.damping, other.damping);
    assert_eq!(physical.design.scene(), reduced.design.scene());
    [physical, reduced]
}

#[test]
fn a_release_is_the_same_without_units() {
    // 4 kg x 2 rad/s x 0.0625 m = 0.5 N s.
    for (physical, reduced) in [
        ("kind = \"free\"\ndisplacement = \"0.1875 m\"", "kind = \"free\"\ndisplacement = 3"),
        (
            "kind = \"free\"\ndisplacement = \"0.0625 m\"\nvelocity = \"0.375 m/s\"",
            "kind = \"free\"\ndisplacement = 1\nvelocity = 3.0",
        ),
        ("kind = \"impulse\"\nimpulse = \"1.5 N s\"", "kind = \"impulse\"\nimpulse = 3"),
        ("kind = \"impulse\"\nvelocity = \"0.375 m/s\"", "kind = \"impulse\"\nvelocity = 3"),
    ] {
        let asked = |time: &str, speed: &str, length: &str| {
            format!(
                "\n[simulation]\nstarts = 3\n[criteria]\ndecay_level = \"30 %\"\ndecay_time = \"<= {time}\"\n\
                 impact_velocity = \"<= {speed}\"\npeak_displacement = \"<= {length}\"\n"
            )
        };
        let [one, other] = twice(
            &format!("{physical}{}", asked("50 s", "1 m/s", "1 m")),
            &format!("{reduced}{}", asked("100", "8", "16")),
        );
        let study =
            |case: &Case| DecayStudy::of_case(case, &Serial).expect("released").expect("flown");
        let [a, b] = [&one, &other].map(study);
        assert_eq!((a.starts.even, a.starts.all.len()), (3, 4));
        assert_eq!((a.from, a.level), (b.from, b.level), "{reduced}");
        for ((_, a), (_, b)) in a.starts.all.iter().zip(&b.starts.all) {
            assert!(a.impacts >= 5, "{a:?}");
            close(a.oscillations, b.oscillations, "decay time in oscillations");
            close(a.peak, b.peak, "peak over the clearance");
            close(a.impact_speed, b.impact_speed, "impact speed");
        }
        close(a.bare, b.bare, "without absorber");
        close(a.damped().1.settles, b.damped().1.settles, "tuned mass damper");
        let theory = |study: &DecayStudy| study.predicted.oscillations.expect("near enough");
        close(theory(&a), theory(&b), "theory");
        let judge = |case: &Case, study: &DecayStudy| {
            judge_transient(case, &Study::Release(Box::new(study.clone())))
        };
        let [first, second] = [judge(&one, &a), judge(&other, &b)];
        // Lengths, velocities and times in the units of each.
        let found = |judged: &[vinesink::criteria::Judged]| {
            judged.iter().map(|one| one.found.expect("found")).collect::<Vec<f64>>()
        };
        for (a, b) in first.iter().zip(&second) {
            assert_eq!((a.criterion.measure, a.holds), (b.criterion.measure, b.holds));
        }
        let factors = [0.0625, 0.125, 0.5];
        for ((a, b), factor) in found(&first).iter().zip(found(&second)).zip(factors) {
            close(*a, factor * b, "criterion");
        }
    }
}

/// Table 1 of the paper, whose numbers are not exact: `Omega = 2 pi f/omega0`, its rate over `omega0` once more.
#[test]
fn a_sweep_is_the_same_without_units() {
    let [from, to, rate] = [7.95, 8.1, 0.01];
    let (mass, stiffness, absorber, clearance) = (4.168, 11.47e3, 0.032, 7.5e-3);
    let physical = include_str!("../../cases/sweep-fast.toml")
        .replace("\"7.5 Hz\"", &format!("\"{from} Hz\""))
        .replace("\"9 Hz\"", &format!("\"{to} Hz\""))
        .replace("\"0.1 Hz/s\"", &format!("\"{rate} Hz/s\""));
    let physical = Case::parse("sweep.toml", &physical).expect("a case");
    let omega0 = f64::sqrt(stiffness / mass);
    let eps = absorber / mass;
    // The clearance is three units of length.
    let reduced = case(&format!(
        "[reduced]\nmass_ratio = {eps:?}\ndamping = {:?}\nrestitution = 0.6\nclearance = 3\n\
         kind = \"sine-sweep\"\nof = \"base-displacement\"\nforcing = {:?}\nfrom = {:?}\nto = {:?}\n\
         rate = {:?}\n",
        3.02 / (absorber * omega0),
        3.0 * 0.25e-3 / eps / clearance,
        TAU * from / omega0,
        TAU * to / omega0,
        TAU * rate / (omega0 * omega0),
    ));
    let flown = |case: &Case| {
        let (system, units) = (case.system(), case.units());
        let sweep = case.design.sine_sweep().expect("swept");
        let start = State { y: 0.5, ..State::AT_REST };
        [
            Passage::follow(&system, &units, &sweep, start).expect("flown"),
            swept(&system, None, &units, &sweep, false),
        ]
    };
    let [physical, reduced] = [&physical, &reduced].map(flown);
    // Caught in 1:1 resonance the motion attracts: an irregular one would enlarge the roundings.
    assert!(physical[0].impacts > 150, "{}", physical[0].impacts);
    for (one, other) in physical.iter().zip(&reduced) {
        assert_eq!((one.envelope.len(), one.impacts), (other.envelope.len(), other.impacts));
        for ([at, peak], [same_at, same_peak]) in one.envelope.iter().zip(&other.envelope) {
            close(*at, *same_at, "frequency ratio");
            close(*peak, *same_peak, "envelope");
        }
    }
}

#[test]
fn a_record_is_the_same_without_units() {
    for (quantity, column, factor) in [
        ("base-acceleration", "acceleration (m/s²)", 0.25),
        ("base-displacement", "displacement (m)", 0.0625),
        // k1 times the unit of length.
        ("force", "force (N)", 1.0),
    ] {
        let driven =
            format!("kind = \"record\"\nquantity = \"{quantity}\"\nfile = \"record.csv\"\n");
        let [one, other] = twice(&driven, &driven);
        let samples = |time: f64, factor: f64| -> String {
            let value = |k: u32| 4.0 * libm::sin(0.2 * f64::from(k)) * factor;
            (0..200).map(|k| format!("{:?},{:?}\n", time * f64::from(k), value(k))).collect()
        };
        let [one, other] = [
            one.with_record("record.csv", format!("time (s),{column}\n{}", samples(0.125, factor))),
            other.with_record("record.csv", format!("time,value\n{}", samples(0.25, 1.0))),
        ]
        .map(|case| case.expect("a record"));
        let flown = |case: &Case| {
            let records = case.recording.as_ref().expect("driven").records();
            let pieces = records[0].pieces(&case.units(), Record::LONGEST);
            follow(&case.system(), &pieces, 0.5).expect("flown")
        };
        let [one, other] = [&one, &other].map(flown);
        assert!(one.impacts > 10, "{quantity}: {}", one.impacts);
        assert_eq!(one.impacts, other.impacts, "{quantity}");
        close(one.peak, other.peak, "peak over the clearance");
        close(one.rms, other.rms, "rms");
        close(one.impact_speed, other.impact_speed, "impact speed");
        close(one.work, other.work, "work");
    }
}
