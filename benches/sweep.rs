//! What a sweep takes beside the batch engine that flies its trajectories, in the same run: the engine alone,
//! with nobody watching; the same trajectories measured; and the whole work on chunks, from points to sealed
//! bytes.
//!
//! The lines printed are the ratios. Nothing here asserts a time.

use std::hint::black_box;
use std::time::{Duration, Instant};

use sha2::{Digest as _, Sha256};
use vinesink::band::simulated::{FROM_REST, Motion, left_out, long_term};
use vinesink::case::Case;
use vinesink::regimes::starts::StartBox;
use vinesink::simulation::batch::{self, Extent};
use vinesink::simulation::{Nobody, Simulation};
use vinesink::sweep::{Plan, parquet, work};
use vinesink::system::{State, System};

/// Every so many points of the map are worked out, so that all of its corners have a part.
const COARSER: u64 = 61;
/// As in a sweep.
const TOGETHER: usize = 256;

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

fn main() {
    let text = include_str!("../cases/li2016-map.toml").replace("count = 500", "count = 64");
    let case = Case::parse("map.toml", &text).expect("a case");
    let plan = Plan::of(&case).expect("a sweep");
    let numbers: Vec<u64> = (0..plan.points()).step_by(COARSER as usize).collect();
    let systems: Vec<System> =
        numbers.iter().filter_map(|number| plan.point(*number).system).collect();
    let starts: Vec<(System, State)> = systems
        .iter()
        .flat_map(|system| {
            let sample = StartBox::around(system);
            let others = (1..plan.settings.starts).map(move |index| sample.start(index - 1));
            [FROM_REST].into_iter().chain(others).map(|start| (*system, start))
        })
        .collect();
    let periods = plan.settings.periods;
    let measured = || -> Vec<Option<Motion>> {
        let together = |some: &[(System, State)]| long_term(some, periods).expect("finite");
        starts.chunks(TOGETHER).flat_map(together).collect()
    };
    // As many periods as each trajectory takes to be measured.
    let extents: Vec<Extent> = measured()
        .iter()
        .zip(&starts)
        .map(|(motion, (system, _))| {
            let once = motion.and_then(|motion| motion.repeats_after).map(u64::from);
            let all = left_out(system) + once.unwrap_or(periods);
            Extent { periods: all, impacts: 1000 * all }
        })
        .collect();
    let alone = || {
        for (some, extents) in starts.chunks(TOGETHER).zip(extents.chunks(TOGETHER)) {
            let begin = |(system, start): &(System, State)| Simulation::new(system, *start, 0.0);
            let mut simulations: Vec<Simulation> =
                some.iter().map(|one| begin(one).expect("finite")).collect();
            let mut nobody: Vec<Nobody> = some.iter().map(|_| Nobody).collect();
            black_box(batch::run_each(&mut simulations, extents, &mut nobody));
        }
    };
    // Stretches of points as a chunk has them, as many points in all.
    let whole = || {
        let stretch = (TOGETHER as u64) / u64::from(plan.settings.starts);
        let stretches = (numbers.len() as u64).div_ceil(stretch);
        for k in 0..stretches {
            let from = k * (plan.points() - stretch) / (stretches - 1);
            let results = work::points(&plan, from..from + stretch).expect("finite");
            let bytes = parquet::file(&results, &Vec::new()).expect("written");
            black_box(Sha256::digest(&bytes));
        }
    };
    // The same points, so that the measured part can be told from the rest.
    let points = || {
        let stretch = (TOGETHER as u64) / u64::from(plan.settings.starts);
        let stretches = (numbers.len() as u64).div_ceil(stretch);
        for k in 0..stretches {
            let from = k * (plan.points() - stretch) / (stretches - 1);
            let some: Vec<(System, State)> = (from..from + stretch)
                .filter_map(|number| plan.point(number).system)
                .flat_map(|system| {
                    let sample = StartBox::around(&system);
                    let others = (1..plan.settings.starts).map(move |k| sample.start(k - 1));
                    [FROM_REST].into_iter().chain(others).map(move |start| (system, start))
                })
                .collect();
            black_box(long_term(&some, periods).expect("finite"));
        }
    };
    let [engine, watched, simulated, swept] = in_turn([
        &mut || alone(),
        &mut || {
            black_box(measured());
        },
        &mut || points(),
        &mut || whole(),
    ]);
    let ratio = |a: Duration, b: Duration| a.as_secs_f64() / b.as_secs_f64();
    let each = |time: Duration| time / starts.len() as u32;
    println!("the engine with nobody watching: {:.1?} a trajectory", each(engine));
    println!("  measuring the same trajectories takes {:.2} times as long", ratio(watched, engine));
    println!("trajectories of whole stretches measured: {:.1?} each", each(simulated));
    println!(
        "  a sweep of them, sealed bytes at the end, takes {:.3} times as long",
        ratio(swept, simulated)
    );
}
