//! Shares of a band as roots against a dense scan, and its motions side by side against one by one, in
//! the same run.
//!
//! The lines printed are the ratios. Nothing here asserts a time.

use std::hint::black_box;
use std::time::{Duration, Instant};

use vinesink::analysis::Analysis;
use vinesink::band::{Band, Survey, SurveySettings, theory};
use vinesink::case::BandOver;
use vinesink::executor::Serial;
use vinesink::motions::{Effort, Place, motions, one_to_one, stability};
use vinesink::system::System;
use vinesink_benches as common;

/// Places of a scan whose share is good to a thousandth.
const SCANNED: u32 = 1001;
/// Places that are simulated.
const SIMULATED: u32 = 33;

/// Table 1 of Li, Seguy, Berlioz (2016) over 8.0 to 8.7 Hz, b = 11.5 mm, F = 0.25 mm.
fn band() -> Band {
    let ratio = |hertz: f64| common::table_1(hertz, 11.5).frequency_ratio();
    let range = [ratio(8.0), ratio(8.7)];
    Band { base: common::table_1(8.35, 11.5), over: BandOver::Frequency, range, spectrum: vec![] }
}

fn timed<T>(repeats: u32, mut work: impl FnMut() -> T) -> Duration {
    let mut best = Duration::MAX;
    for _ in 0..5 {
        let begin = Instant::now();
        for _ in 0..repeats {
            black_box(work());
        }
        best = best.min(begin.elapsed() / repeats);
    }
    best
}

fn compared(what: &str, ours: Duration, how: &str, other: Duration) {
    println!("{what}: {ours:.1?}");
    println!("  {how} takes {:.1} times as long", other.as_secs_f64() / ours.as_secs_f64());
}

fn main() {
    let band = band();
    let systems = |count| -> Vec<System> {
        band.places(count).map(|at| band.system(at).expect("valid")).collect()
    };
    let scanned = systems(SCANNED);
    let share = |holds: &dyn Fn(&System) -> bool| scanned.iter().filter(|one| holds(one)).count();
    compared(
        "areas of the theory along a band, ends to 1e-9",
        timed(20, || theory::zones(black_box(&band))),
        "a scan with the whole analysis, ends to 1e-3,",
        timed(1, || share(&|one| Analysis::of(one).is_ok_and(|there| there.zone.is_z3()))),
    );
    compared(
        "where an exact orbit attracts, ends to 1e-9",
        timed(5, || stability(black_box(&band))),
        "a scan, ends to 1e-3,",
        timed(1, || share(&|one| !one_to_one(one).is_empty())),
    );
    let places: Vec<Place> =
        systems(SIMULATED).iter().map(|system| Place::new(system, 8)).collect();
    let effort = Effort::default();
    let alone =
        |place: &Place| motions(std::slice::from_ref(place), &effort, &Serial).expect("finite");
    compared(
        "motions at 33 places from 8 starts, side by side",
        timed(1, || motions(&places, &effort, &Serial).expect("finite")),
        "place by place",
        timed(1, || places.iter().map(alone).collect::<Vec<_>>()),
    );
    let survey = |effort| {
        let settings = SurveySettings { effort, extremes: Vec::new(), count_rest: true };
        timed(1, || Survey::of(&band, &settings, None, &Serial).expect("finite"))
    };
    compared(
        "a survey of the band without simulation",
        survey(None),
        "with simulation it",
        survey(Some(Effort::default())),
    );
}
