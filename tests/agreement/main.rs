//! One answer: what all commands say of one design, held against one another.
//!
//! Each design of one mode is put to `simulate`, `analyze`, `check`, `report`, `sweep` and `tradeoff`, and some to `optimize`, each of
//! several to `simulate`, `check` and `report`, as a user would, and their JSON is compared: lists of motions, their numbers, criteria,
//! stability, limits, columns. Where two layers differ physically, as theory and simulation do, nothing is compared.
//!
//! `cargo test` looks at fifteen designs. `VINESINK_AGREEMENT=all` looks at all, `VINESINK_AGREEMENT=SEED` at forty and
//! twenty-four of several modes that nobody has seen, `SEED/NUMBER` at one of them, and `VINESINK_PROGRAM` names another program than the one of
//! the tests. Cases of contradictions are kept.

mod compare;
mod designs;
mod program;
#[path = "../common/random.rs"]
mod random;

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use compare::Tally;
use designs::Design;

/// Seed of the designs that every run looks at.
const SEED: u64 = 33;
/// Generated designs of a whole run, and those of them that are optimised, which takes longest.
const GENERATED: usize = 40;
const OPTIMISED: usize = 5;
/// Designs of several modes of a whole run, and of a usual one.
const OF_SEVERAL: [usize; 2] = [24, 3];
/// The same of a usual run, and the designs of its other kinds: one on which commands used to contradict one another of
/// every so many.
const FEW: usize = 4;
const EVERY: usize = 3;
/// Shipped cases of a usual run.
const SHIPPED: [&str; 2] = ["li2016-8hz-b7p5mm", "li2016-band"];

#[test]
fn all_commands_say_the_same() {
    let asked = std::env::var("VINESINK_AGREEMENT").unwrap_or_default();
    let designs: Vec<Design> = match asked.as_str() {
        "" => {
            let known = designs::known().into_iter().step_by(EVERY);
            let shipped = designs::shipped().into_iter();
            let shipped = shipped.filter(|one| SHIPPED.contains(&one.name.as_str()));
            known.chain(shipped).chain(designs::generated(SEED, FEW)).collect()
        }
        "all" => {
            let known = designs::known().into_iter().chain(designs::shipped());
            known.chain(designs::generated(SEED, GENERATED)).collect()
        }
        seed => {
            let (seed, number) = seed.split_once('/').unwrap_or((seed, ""));
            let mut all = designs::generated(seed.parse().expect("all, or a seed"), GENERATED);
            all.retain(|one| number.is_empty() || one.name.ends_with(&format!("-{number}")));
            all
        }
    };
    let usual = asked.is_empty();
    let seed = asked.split('/').next().and_then(|seed| seed.parse().ok()).unwrap_or(SEED);
    let mut of_several = designs::of_several(seed, OF_SEVERAL[usize::from(usual)]);
    of_several.retain(|one| {
        asked.split_once('/').is_none_or(|(_, number)| one.name.ends_with(&format!("-{number}")))
    });
    let count = designs.len() + of_several.len();
    let optimised = if usual { 0 } else { OPTIMISED };
    let tally = Mutex::new(Tally::default());
    let next = AtomicUsize::new(0);
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    let several = index.checked_sub(designs.len());
                    let several = several.and_then(|index| of_several.get(index));
                    let Some(design) = designs.get(index).or(several) else { break };
                    let number = design.number.unwrap_or(usize::MAX);
                    let found = match several {
                        Some(design) => compare::compared_of_several(design),
                        None => compare::compared(design, !usual, number < optimised),
                    };
                    if !found.contradictions.is_empty() {
                        eprintln!("kept: {}", compare::kept(design).display());
                    }
                    tally.lock().expect("no panic").add(found);
                }
            });
        }
    });
    let Tally { agreed, mut contradictions } = tally.into_inner().expect("no panic");
    contradictions.sort();
    println!("{} designs: {agreed} agreements, {} contradictions", count, contradictions.len());
    assert!(agreed > 40 * count, "{agreed} comparisons are too few");
    assert!(contradictions.is_empty(), "{}", contradictions.join("\n"));
}
