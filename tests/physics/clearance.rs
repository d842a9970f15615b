//! The best clearance of a structure that is swept or that a record drives, against studies of clearances and places of
//! the absorber that the search has not looked at.

use std::f64::consts::{PI, TAU};

use vinesink::case::Case;
use vinesink::executor::Serial;
use vinesink::flights::Places;
use vinesink::measure::{Device, Measure};
use vinesink::system::Parameter;
use vinesink::transient::{RecordStudy, Study, SweepStudy, best_clearance};

const SWEPT: &str = include_str!("../../cases/sweep-fast.toml");
const TOWER: &str = include_str!("../../cases/tower-record.toml");

/// From an odd number of places, which has the middle and others that no search and no check has looked at.
const PLACES: &str = "\n[simulation]\nstarts = 41\n";

/// Largest displacement and that of the structure alone, by the study.
fn peaks_of_sweep(text: &str, clearance: f64) -> [f64; 2] {
    let text = text.replace("\"7.5 mm\"", &format!("\"{clearance} m\""));
    let case = Case::parse("sweep.toml", &format!("{text}{PLACES}")).expect("a case");
    let study = SweepStudy::of_case(&case, &Serial).expect("swept").expect("flown");
    let (_, worst) = study.worst().expect("a start");
    [worst.peak()[1], study.alone.peak()[1]].map(|peak| case.units().length(peak))
}

/// What drives the structure is the same for every clearance: so is what it does alone. Clearances to either side of the
/// best, from the lower to the upper bound, leave more; in between, three per cent are what other places may add.
#[test]
fn no_other_clearance_leaves_less_of_a_sweep() {
    let text = SWEPT.replace("\"0.1 Hz/s\"", "\"0.4 Hz/s\"");
    let case = Case::parse("sweep.toml", &text).expect("a case");
    let best = best_clearance(&case, &Serial).expect("not steady");
    let own = case.design.clearance();
    let [checked, error] = best.checked;
    assert!(checked < best.own[0], "{best:?}");
    let [found, alone] = peaks_of_sweep(&text, best.design.clearance());
    assert!(found <= 1.03 * checked + error && found > 0.9 * checked, "{found} {best:?}");
    let [of_own, alone_with_own] = peaks_of_sweep(&text, own);
    assert!((alone / alone_with_own - 1.0).abs() < 1e-12, "{alone} {alone_with_own}");
    assert!((of_own / best.own[0] - 1.0).abs() < 0.03, "{of_own} {best:?}");
    for factor in [0.2, 0.4, 0.7, 1.3, 2.0, 4.0] {
        let clearance = factor * best.design.clearance();
        let [other, _] = peaks_of_sweep(&text, clearance);
        assert!(other > 0.97 * checked, "{clearance}: {other} {best:?}");
    }
}

/// The tower under a base acceleration of these values every 0.1 s.
fn tower(clearance: &str, count: u32, value: impl Fn(f64) -> f64) -> Case {
    let text = TOWER.replace("\"100 mm\"", &format!("\"{clearance}\""));
    let rows =
        (0..=count).map(|k| format!("{},{}\n", 0.1 * f64::from(k), value(0.1 * f64::from(k))));
    let record = format!("time (s),acceleration (m/s²)\n{}", rows.collect::<String>());
    let bounds = "\n[optimize]\nclearance = [\"10 mm\", \"80 mm\"]\n";
    let case = Case::parse("tower.toml", &format!("{text}{PLACES}{bounds}")).expect("a case");
    case.with_record("tower.csv", record).expect("a record")
}

fn peaks_of_record(case: &Case, clearance: f64) -> [f64; 2] {
    let design = case.design.with(Parameter::Clearance, clearance);
    let (system, units) = (design.system().expect("a system"), design.units());
    let records = case.recording.as_ref().expect("recorded").records();
    let places = Places { even: 41, closer: records.len() == 1, shaking: false, executor: &Serial };
    let study = RecordStudy::of(&system, &units, records, places, true).expect("studied");
    let study = Study::Record(Box::new(study));
    [Device::Absorber, Device::Without]
        .map(|by| study.quantity(&units, Measure::Peak, by).expect("flown").value)
}

/// Twenty periods of a sine at the tower's own frequency, and clearances from which the absorber is not lost: a larger one
/// leaves less, as it takes more from a large motion, so that the best is near the upper bound: places of the absorber differ
/// there by as much as the last tenth of the clearance brings.
#[test]
fn no_other_clearance_leaves_less_of_a_record() {
    let case = tower("20 mm", 400, |t| 0.05 * libm::sin(PI * t));
    let best = best_clearance(&case, &Serial).expect("not steady");
    let [checked, error] = best.checked;
    let [found, alone] = peaks_of_record(&case, best.design.clearance());
    assert!(checked < 0.97 * best.own[0] && checked < 0.9 * alone, "{alone} {best:?}");
    assert!(found <= checked + error && found > 0.9 * checked, "{found} {best:?}");
    let [_, alone_with_own] = peaks_of_record(&case, 0.02);
    assert!((alone / alone_with_own - 1.0).abs() < 1e-9, "{alone} {alone_with_own}");
    assert!((0.072..=0.08 * (1.0 + 1e-12)).contains(&best.design.clearance()), "{best:?}");
    for clearance in [0.01, 0.02, 0.04, 0.06] {
        let [other, _] = peaks_of_record(&case, clearance);
        assert!(other > checked, "{clearance}: {other} {best:?}");
    }
}

/// A blow of a tenth of a period: the largest displacement is that of the first swing, before the absorber, which the
/// base has set in motion as it has the tower, can have taken anything.
#[test]
fn a_blow_leaves_an_absorber_no_time() {
    let blow = |t: f64| if t <= 0.2 { 5.0 * libm::sin(0.5 * TAU * t / 0.2) } else { 0.0 };
    let case = tower("100 mm", 100, blow);
    let best = best_clearance(&case, &Serial).expect("not steady");
    for clearance in [0.02, 0.07, 0.2, 0.5] {
        let [other, alone] = peaks_of_record(&case, clearance);
        assert!(other > 0.98 * alone && best.checked[0] > 0.98 * alone, "{other} {alone} {best:?}");
    }
}
