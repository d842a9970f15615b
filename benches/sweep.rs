//! What a sweep takes beside the batch engine that flies its trajectories, in the same run and for the same
//! stretches of points: the engine alone, with nobody watching; the same trajectories measured one by one, none proven;
//! and the whole work on chunks, from points to sealed bytes.
//!
//! The lines printed are the ratios. Nothing here asserts a time.

use std::hint::black_box;
use std::ops::Range;
use std::time::{Duration, Instant};

use vinesink::case::Case;
use vinesink::digest;
use vinesink::motions::{Effort, Motion, SettlingTime, follow, starts};
use vinesink::simulation::Simulation;
use vinesink::simulation::batch::{self, Extent};
use vinesink::sweep::{Plan, parquet, work};
use vinesink::system::{State, System};

/// Stretches of points, evenly over the map, and how long one is: with its starts, as many trajectories
/// as are side by side in a sweep.
const STRETCHES: u64 = 17;
const STRETCH: u64 = 64;

fn timed<T>(what: &mut impl FnMut() -> T) -> (Duration, T) {
    let begin = Instant::now();
    let made = black_box(what());
    (begin.elapsed(), made)
}

/// The best of some runs of each, taken in turn, so that a slow moment of the machine hits all alike.
fn in_turn<const N: usize>(mut all: [&mut dyn FnMut(); N]) -> [Duration; N] {
    let mut best = [Duration::MAX; N];
    for _ in 0..5 {
        for (best, what) in best.iter_mut().zip(&mut all) {
            *best = timed(&mut || what()).0.min(*best);
        }
    }
    best
}

/// A stretch of a sweep.
struct Stretch {
    points: Range<u64>,
    starts: Vec<(System, State)>,
    /// As far as each trajectory is followed to be measured.
    extents: Vec<Extent>,
}

impl Stretch {
    fn of(plan: &Plan, points: Range<u64>) -> Self {
        let systems = points.clone().filter_map(|number| plan.point(number).system);
        let of = |system| {
            starts::spread(&system, plan.settings.starts).map(move |start| (system, start))
        };
        let starts: Vec<(System, State)> = systems.flat_map(of).collect();
        let periods = plan.settings.periods;
        let motions = follow(&starts, &Effort::over(periods)).expect("finite");
        let extent = |(motion, (system, _)): (&Option<Motion>, &(System, State))| {
            let once = motion.as_ref().and_then(Motion::repeats_after).map(u64::from);
            let all = SettlingTime::of(system).periods + once.unwrap_or(periods);
            Extent { periods: all, impacts: 1000 * all }
        };
        let extents = motions.iter().zip(&starts).map(extent).collect();
        Self { points, starts, extents }
    }

    fn flown(&self) {
        let begin = |(system, start): &(System, State)| Simulation::new(system, *start, 0.0);
        let begun = self.starts.iter().map(|one| begin(one).expect("finite"));
        let mut simulations: Vec<Simulation> = begun.collect();
        let mut nobody: Vec<()> = vec![(); simulations.len()];
        black_box(batch::run_each(&mut simulations, &self.extents, &mut nobody));
    }
}

fn main() {
    let text = include_str!("../cases/li2016-map.toml").replace("count = 500", "count = 64");
    let case = Case::parse("map.toml", &text).expect("a case");
    let plan = Plan::of(&case).expect("a sweep");
    let stretches: Vec<Stretch> = (0..STRETCHES)
        .map(|k| k * (plan.points() - STRETCH) / (STRETCHES - 1))
        .map(|from| Stretch::of(&plan, from..from + STRETCH))
        .collect();
    let trajectories: usize = stretches.iter().map(|stretch| stretch.starts.len()).sum();
    let [engine, measured, swept] = in_turn([
        &mut || stretches.iter().for_each(Stretch::flown),
        &mut || {
            for stretch in &stretches {
                black_box(
                    follow(&stretch.starts, &Effort::over(plan.settings.periods)).expect("finite"),
                );
            }
        },
        &mut || {
            for stretch in &stretches {
                let results = work::points(&plan, stretch.points.clone()).expect("finite");
                let bytes = parquet::file(&results, &Vec::new()).expect("written");
                black_box(digest::sha256(&bytes));
            }
        },
    ]);
    let ratio = |a: Duration, b: Duration| a.as_secs_f64() / b.as_secs_f64();
    let each = |time: Duration| time / trajectories as u32;
    println!("the engine with nobody watching: {:.1?} a trajectory", each(engine));
    println!("measured: {:.1?} a trajectory", each(measured));
    println!("  the engine takes {:.2} of that", ratio(engine, measured));
    println!(
        "a sweep, its motions found and proven, sealed bytes: {:.1?} a trajectory",
        each(swept)
    );
    println!("  that is {:.3} times as long as they take to be measured", ratio(swept, measured));
}
