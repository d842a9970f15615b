//! What `bench.py` holds Python against: the same work without it. Prints seconds, each the best of some runs.

use std::hint::black_box;
use std::time::Instant;

use rayon::iter::ParallelIterator as _;
use rayon::slice::ParallelSlice as _;
use vinesink::case::Case;
use vinesink::executor::Serial;
use vinesink::motions::{Effort, Measured, Place, Window, motions, starts};
use vinesink::simulation::{ImpactLog, Simulation};
use vinesink::system::{Parameter, State};

/// Starts on their way to two impacts per period.
const START: State = State { y_velocity: 1.0, ..State::AT_REST };

fn best<T>(runs: u32, mut work: impl FnMut() -> T) -> f64 {
    let one = |_| {
        let begin = Instant::now();
        black_box(work());
        begin.elapsed().as_secs_f64()
    };
    (0..runs).map(one).fold(f64::INFINITY, f64::min)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let numbers: Vec<String> = std::env::args().skip(1).collect();
    let [text, periods, systems, runs] = numbers.as_slice() else {
        return Err("expected the text of a case, periods, systems, runs".into());
    };
    let case = Case::parse("case", text)?;
    let (periods, systems): (u64, u32) = (periods.parse()?, systems.parse()?);
    let runs: u32 = runs.parse()?;
    let system = case.system();
    let begin = || Simulation::new(&system, START, 0.0).expect("inside the cavity");

    let mut impacts = 0;
    let alone = best(runs, || {
        let mut log = ImpactLog::default();
        begin().run(periods, u64::MAX, &mut log);
        impacts = log.impacts.len();
        log
    });
    let window = Window { discard: 0, periods, impact_limit: u64::MAX };
    let measured = best(runs, || {
        let mut log = ImpactLog::default();
        (Measured::of(&mut begin(), &window, &mut log), log)
    });
    // As `simulate_many` with clearances evenly spread over 2 to 20 mm.
    let place = |k: u32| {
        let clearance = 2e-3 + f64::from(k) * ((20e-3 - 2e-3) / f64::from(systems - 1));
        let system = case.design.with(Parameter::Clearance, clearance).system().expect("valid");
        Place::with(&system, vec![starts::FROM_REST])
    };
    let effort = Effort::over(250);
    let many = best(runs, || {
        let places: Vec<Place> = (0..systems).map(place).collect();
        let each = |some: &[Place]| motions(some, &effort, &Serial).expect("valid");
        places.par_chunks(256).flat_map_iter(each).collect::<Vec<_>>()
    });
    println!("{impacts} {alone} {measured} {many}");
    Ok(())
}
