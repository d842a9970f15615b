//! The best place between bounds: looked for everywhere first, narrowed down then, and moved to the
//! middle where a whole stretch of places is best. Places are parts of the way, from 0 to 1.

use std::cell::RefCell;

use argmin::core::{CostFunction, Error, Executor, PopulationState};
use argmin::solver::neldermead::NelderMead;
use argmin::solver::particleswarm::ParticleSwarm;
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use crate::executor::{Executor as Evaluations, map};
use crate::numerics::scan::narrow;

/// A score between bounds, minus infinity where there is none.
pub type Score<'f> = &'f (dyn Fn(&[f64]) -> f64 + Sync);

/// How thoroughly is looked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SearchEffort {
    /// Pieces of a line.
    pub pieces: usize,
    /// Particles of a swarm.
    pub particles: usize,
    /// Steps of a swarm.
    pub steps: u64,
    /// Width to which a maximum is narrowed down on a line.
    pub width: f64,
    /// Whether the score is smooth, so that a maximum can be narrowed down at all.
    pub smooth: bool,
}

/// A place with its score.
pub type ScoredPlace = (Vec<f64>, f64);

/// The best place.
#[derive(Debug, Clone, PartialEq)]
pub struct BestPlace {
    /// Where.
    pub parts: Vec<f64>,
    /// The score there.
    pub score: f64,
    /// The first coordinate's stretch that is as good, all others held; the place is its middle.
    pub plateau: [f64; 2],
    /// Every place that was asked for on the way.
    pub seen: Vec<ScoredPlace>,
}

/// Relative difference of two scores that are the same: the rounding of roots.
const SAME: f64 = 1e-9;
/// Local maxima of a scan that are narrowed down.
const PEAKS: usize = 4;
/// Width to which the end of a plateau is known, over that of a maximum.
const END: f64 = 0.01;
/// Steps of the polish in several dimensions, and the size of its first simplex.
const POLISH: u64 = 120;
const SIMPLEX: f64 = 0.05;
/// First step, over the width, in which a plateau is followed.
const STRIDE: f64 = 1.0 / 256.0;
/// Where every swarm begins.
const SEED: u64 = 2016;

/// What stands for a place without a score.
const NOTHING: f64 = 1e300;

/// A problem for the optimiser, which remembers all that it was asked.
struct ScoredProblem<'f> {
    score: Score<'f>,
    seen: RefCell<Vec<ScoredPlace>>,
}

impl<'f> ScoredProblem<'f> {
    fn new(score: Score<'f>) -> Self {
        Self { score, seen: RefCell::default() }
    }

    /// Places outside of the bounds count as the nearest inside.
    fn asked(&self, parts: &[f64]) -> f64 {
        let inside: Vec<f64> = parts.iter().map(|part| part.clamp(0.0, 1.0)).collect();
        let score = (self.score)(&inside);
        self.seen.borrow_mut().push((inside, score));
        score
    }

    /// The best of all that was asked; `None` where nothing has a score.
    fn best(&self) -> Option<BestPlace> {
        let seen = self.seen.borrow();
        let mut scored = seen.iter().filter(|one| one.1 > f64::NEG_INFINITY);
        let first = scored.next()?;
        // What is better by rounding only does not replace the middle of a plateau.
        let better = |a: &ScoredPlace, b: &ScoredPlace| b.1 > a.1 && !same(a.1, b.1);
        let (parts, score) = scored.fold(first, |a, b| if better(a, b) { b } else { a }).clone();
        Some(BestPlace { plateau: [parts[0]; 2], parts, score, seen: seen.clone() })
    }
}

impl CostFunction for &ScoredProblem<'_> {
    type Param = Vec<f64>;
    type Output = f64;
    fn cost(&self, parts: &Self::Param) -> Result<f64, Error> {
        let score = self.asked(parts);
        Ok(if score.is_finite() { -score } else { NOTHING })
    }
}

/// The score at even parts of a line, both ends among them.
pub fn scan(
    what: &str,
    pieces: usize,
    executor: &dyn Evaluations,
    score: &(dyn Fn(f64) -> f64 + Sync),
) -> Vec<(f64, f64)> {
    let place = |k: usize| k as f64 / pieces as f64;
    let found = map(executor, what, pieces + 1, |k| score(place(k)));
    found.into_iter().enumerate().map(|(k, score)| (place(k), score)).collect()
}

fn same(a: f64, b: f64) -> bool {
    // Infinity is as far from every number as it is large.
    let near = || (a - b).abs() <= SAME * a.abs().max(b.abs());
    a == b || (a.is_finite() && b.is_finite() && near())
}

/// The best place on a line that was scanned; `None` where it has a score nowhere.
pub fn on_line(
    scanned: &[(f64, f64)],
    width: f64,
    score: &(dyn Fn(f64) -> f64 + Sync),
) -> Option<BestPlace> {
    let asked = |parts: &[f64]| score(parts[0]);
    let problem = ScoredProblem::new(&asked);
    let last = scanned.len().checked_sub(1)?;
    let around = |k: usize| (scanned[k.saturating_sub(1)], scanned[(k + 1).min(last)]);
    let mut peaks: Vec<usize> = (0..=last)
        .filter(|k| {
            let (before, after) = around(*k);
            scanned[*k].1 >= before.1.max(after.1) && scanned[*k].1.is_finite()
        })
        .collect();
    peaks.sort_by(|a, b| scanned[*b].1.total_cmp(&scanned[*a].1));
    // A plateau is as wide as it is, wherever on it one looks: the widest of the best ones wins.
    let top = scanned[*peaks.first()?].1;
    let level: Vec<usize> = (0..=last).filter(|k| same(scanned[*k].1, top)).collect();
    let runs = level.chunk_by(|a, b| a + 1 == *b);
    let widest = runs.max_by(|a, b| a.len().cmp(&b.len()).then(b[0].cmp(&a[0])))?;
    if widest.len() == scanned.len() && last > 0 {
        let seen = scanned.iter().map(|(part, score)| (vec![*part], *score)).collect();
        return Some(BestPlace { parts: vec![0.5], score: score(0.5), plateau: [0.0, 1.0], seen });
    }
    let middle = scanned[widest[widest.len() / 2]];
    problem.asked(&[middle.0]);
    for k in peaks.into_iter().filter(|k| !level.contains(k) || level.len() == 1).take(PEAKS) {
        let (before, after) = around(k);
        narrowed(&problem, before.0, after.0, width);
    }
    if widest.len() < 3 {
        let (from, to) = (around(widest[0]).0, around(widest[widest.len() - 1]).1);
        narrowed(&problem, from.0, to.0, width);
    }
    let mut best = centred(problem.best()?, width, &asked);
    best.seen.extend(scanned.iter().map(|(part, score)| (vec![*part], *score)));
    Some(best)
}

/// What was found between all bounds.
pub struct SearchResult {
    /// The score along the first coordinate, the others being those that were given.
    pub line: Vec<(f64, f64)>,
    /// Every place of that line, and every one that was asked for in several dimensions.
    pub seen: Vec<ScoredPlace>,
    /// The best place; `None` where nothing has a score, and on a line whose score is not smooth.
    pub best: Option<BestPlace>,
}

/// The best place between all bounds: in all dimensions, then along the first coordinate from there. Where a search begins has
/// no part in it, so that one from its own result finds the same.
pub fn everywhere(
    what: &str,
    dimensions: usize,
    effort: &SearchEffort,
    executor: &dyn Evaluations,
    score: Score,
) -> SearchResult {
    let mut seen: Vec<ScoredPlace> = Vec::new();
    let mut found = match (dimensions, effort.smooth) {
        (1, _) => None,
        (_, true) => in_box(dimensions, effort, score),
        (_, false) => {
            let count = effort.particles * effort.steps as usize;
            spread_out(what, dimensions, count, executor, &|parts, _| score(parts))
        }
    };
    seen.extend(found.iter_mut().flat_map(|best| std::mem::take(&mut best.seen)));
    let from = found.as_ref().map_or_else(|| vec![0.5; dimensions], |best| best.parts.clone());
    let at = |part: f64| -> Vec<f64> {
        std::iter::once(part).chain(from[1..].iter().copied()).collect()
    };
    let along = |part: f64| score(&at(part));
    let line = scan(what, effort.pieces, executor, &along);
    seen.extend(line.iter().map(|(part, score)| (at(*part), *score)));
    if effort.smooth {
        let narrowed = on_line(&line, effort.width, &along);
        let narrowed = narrowed.map(|best| BestPlace { parts: at(best.parts[0]), ..best });
        let better = |known: &BestPlace, one: &BestPlace| {
            one.score > known.score || same(one.score, known.score)
        };
        found = match (found, narrowed) {
            (Some(known), Some(one)) if !better(&known, &one) => Some(known),
            (known, one) => one.or(known),
        };
    }
    SearchResult { line, seen, best: found }
}

/// Golden section between two places, until it moves by less than `width`; what it finds is remembered by the
/// problem.
fn narrowed(problem: &ScoredProblem, from: f64, to: f64, width: f64) {
    let mut last = f64::INFINITY;
    narrow([from, to], |part| {
        let moved = (part - last).abs();
        last = part;
        let score = problem.asked(&[part]);
        (moved > width).then_some(score)
    });
}

/// The best place in several dimensions: a swarm with a fixed beginning, then for a smooth score a simplex
/// from the best of it; `None` where nothing has a score.
fn in_box(dimensions: usize, effort: &SearchEffort, score: Score) -> Option<BestPlace> {
    let problem = ScoredProblem::new(score);
    problem.asked(&vec![0.5; dimensions]);
    let bounds = (vec![0.0; dimensions], vec![1.0; dimensions]);
    let swarm = ParticleSwarm::new(bounds, effort.particles)
        .with_rng_generator(Xoshiro256PlusPlus::seed_from_u64(SEED));
    let steps = effort.steps;
    let _ = Executor::new(&problem, swarm)
        .configure(|state: PopulationState<_, f64>| state.max_iters(steps))
        .timer(false)
        .run();
    let found = problem.best()?;
    if !effort.smooth {
        return Some(found);
    }
    let start = found.parts;
    let mut simplex = vec![start.clone()];
    for k in 0..dimensions {
        let mut corner = start.clone();
        corner[k] += if corner[k] > 0.5 { -SIMPLEX } else { SIMPLEX };
        simplex.push(corner);
    }
    if let Ok(polish) = NelderMead::new(simplex).with_sd_tolerance(f64::EPSILON) {
        let _ = Executor::new(&problem, polish)
            .configure(|state| state.max_iters(POLISH))
            .timer(false)
            .run();
    }
    Some(centred(problem.best()?, effort.width, score))
}

/// Multiples of the roots of these, modulo 1, are evenly spread in as many dimensions (Richtmyer, 1951).
const PRIMES: [f64; 16] =
    [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0, 23.0, 29.0, 31.0, 37.0, 41.0, 43.0, 47.0, 53.0];
/// Places around which is looked closer, how many there, and how far away in each dimension, in turn.
const AROUND: usize = 6;
const CLOSER: usize = 8;
const REACH: [f64; 2] = [0.08, 0.03];

/// The best of so many evenly spread places for a score that scatters, and of some around those that are best, side by side. The
/// score is told the best so far, of rounds before: what cannot reach it need not be known exactly.
pub fn spread_out(
    what: &str,
    dimensions: usize,
    count: usize,
    executor: &dyn Evaluations,
    score: &(dyn Fn(&[f64], f64) -> f64 + Sync),
) -> Option<BestPlace> {
    let even = |k: usize| -> Vec<f64> {
        let part = |prime: &f64| (0.5 + prime.sqrt() * (k + 1) as f64).fract();
        PRIMES.iter().cycle().take(dimensions).map(part).collect()
    };
    let of = |places: &[Vec<f64>], best: f64| -> Vec<ScoredPlace> {
        let scores = map(executor, what, places.len(), |k| score(&places[k], best));
        places.iter().cloned().zip(scores).collect()
    };
    let mut seen = of(&(0..count).map(even).collect::<Vec<_>>(), f64::NEG_INFINITY);
    for reach in REACH {
        let around = shortlist(&seen, reach, AROUND);
        let best = around.first().map_or(f64::NEG_INFINITY, |(_, score)| *score);
        let places = around.into_iter().flat_map(|(best, _)| {
            (0..CLOSER).map(move |k| -> Vec<f64> {
                let beside =
                    |(at, part): (&f64, f64)| (at + reach * (2.0 * part - 1.0)).clamp(0.0, 1.0);
                best.iter().zip(even(k)).map(beside).collect()
            })
        });
        seen.extend(of(&places.collect::<Vec<_>>(), best));
    }
    let (parts, score) = shortlist(&seen, 0.0, 1).pop()?;
    Some(BestPlace { plateau: [parts[0]; 2], parts, score, seen })
}

/// How far two places are apart, in the coordinate in which they are farthest.
pub fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// The best of the places that were seen, each this far from every better one, the best first.
pub fn shortlist(seen: &[ScoredPlace], apart: f64, most: usize) -> Vec<ScoredPlace> {
    let mut sorted: Vec<&ScoredPlace> =
        seen.iter().filter(|(_, score)| score.is_finite()).collect();
    // Equal scores keep the order in which they were seen.
    sorted.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut found: Vec<ScoredPlace> = Vec::new();
    for one in sorted {
        if found.len() < most && found.iter().all(|known| distance(&known.0, &one.0) >= apart) {
            found.push(one.clone());
        }
    }
    found
}

/// A place moved to the middle of the stretch that is as good, coordinate by coordinate.
fn centred(mut best: BestPlace, width: f64, score: Score) -> BestPlace {
    for k in (0..best.parts.len()).rev() {
        let at = best.parts[k];
        let as_good = |part: f64| {
            let mut parts = best.parts.clone();
            parts[k] = part;
            same(score(&parts), best.score)
        };
        let ends = [-1.0, 1.0].map(|side| end_of_plateau(at, side, width, &as_good));
        let middle = 0.5 * (ends[0] + ends[1]);
        if as_good(middle) {
            best.parts[k] = middle;
        }
        if k == 0 {
            best.plateau = ends;
        }
    }
    best
}

/// How far places are as good, to one side.
fn end_of_plateau(at: f64, side: f64, width: f64, as_good: &dyn Fn(f64) -> bool) -> f64 {
    let (mut inside, mut stride) = (at, width);
    if !as_good((at + side * stride).clamp(0.0, 1.0)) {
        return at;
    }
    let mut outside = loop {
        let next = (inside + side * stride).clamp(0.0, 1.0);
        if next == inside {
            return inside;
        }
        if !as_good(next) {
            break next;
        }
        inside = next;
        // By doubling from close by, then evenly: nothing wider than a piece is stepped over.
        stride = if stride < STRIDE { 2.0 * stride } else { STRIDE };
    };
    while (outside - inside).abs() > END * width {
        let middle = 0.5 * (inside + outside);
        if as_good(middle) {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shortlist_holds_the_best_that_are_apart() {
        let seen = |part: f64, score: f64| (vec![part, 0.5], score);
        let all = [
            seen(0.50, 3.0),
            seen(0.505, 2.9),
            seen(0.10, f64::NEG_INFINITY),
            seen(0.51, 2.8),
            seen(0.30, 5.0),
            seen(0.90, 1.0),
        ];
        let parts = |most: usize| -> Vec<f64> {
            shortlist(&all, 0.01, most).iter().map(|(parts, _)| parts[0]).collect()
        };
        assert_eq!(parts(9), [0.30, 0.50, 0.51, 0.90]);
        assert_eq!(parts(2), [0.30, 0.50]);
    }

    #[test]
    fn what_is_the_same_everywhere_is_not_searched() {
        let scanned = scan("", 8, &crate::executor::Serial, &|_| 0.0);
        let best = on_line(&scanned, 1e-7, &|_| 0.0).expect("a score");
        assert_eq!((best.parts, best.score, best.plateau), (vec![0.5], 0.0, [0.0, 1.0]));
    }
}
