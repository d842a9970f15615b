//! The worst amplitude as simulation finds it: what orbits and two starts promise may be a small motion
//! beside a much larger one. The best candidates of the search, all over the bounds, are simulated as
//! thoroughly as the winner is confirmed, and the best of them as simulated wins.

use serde::Serialize;

use super::confirm::{self, Place};
use super::search::{Seen, Spread, distance, map, shortlist};
use super::task::Task;
use super::{Chosen, OptimizeError};
use crate::case::{Choice, Rewritten};

/// Distance between candidates all over the bounds, over the way between them, and most of them.
const APART: f64 = 0.04;
const MOST: usize = 32;
/// The same around the best of these as simulated.
const CLOSE: f64 = 0.01;
const MOST_CLOSE: usize = 16;
/// How many of them count as the best.
const BEST: usize = 2;
/// Candidates that are simulated side by side.
const TOGETHER: usize = 8;

/// A candidate of the search. Scores: the more the better.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Candidate {
    /// The absorber, rounded as it is written.
    pub choice: Choice,
    /// Its score in the search.
    pub score: f64,
    /// Its score as simulated.
    pub simulated: f64,
}

/// A candidate with its place between the bounds, its file, and what simulation finds of it.
struct Simulated {
    parts: Vec<f64>,
    chosen: Chosen,
    written: Rewritten,
    places: Vec<Place>,
}

/// The winner with its file and what simulation finds of it, and all that were simulated.
pub struct Judged {
    /// The best as simulated.
    pub chosen: Chosen,
    /// Its case file.
    pub written: Rewritten,
    /// What simulation finds at each place.
    pub places: Vec<Place>,
    /// Every candidate that was simulated with its file; the best of the search comes first.
    pub candidates: Vec<(Candidate, Rewritten)>,
}

/// The worst amplitude as a score: no better than the search has it, since simulation sees places of the
/// band and not all of it.
pub fn simulated(score: f64, places: &[Place]) -> f64 {
    confirm::largest(places).map_or(f64::NEG_INFINITY, |largest| score.min(-largest))
}

/// How a place is rounded to an absorber that is written.
pub type Rounded<'f> = &'f (dyn Fn(&[f64]) -> Result<(Chosen, Rewritten), OptimizeError> + Sync);

/// Simulates the best candidates of the search, first some that are spread over the bounds, then closer
/// ones around the best of these; leaves out what could not be better than one that was simulated.
///
/// # Errors
/// [`OptimizeError`] of a candidate that cannot be written or simulated, or where there is none.
pub fn judged(
    task: &Task,
    seen: &[Seen],
    spread: &dyn Spread,
    rounded: Rounded,
) -> Result<Judged, OptimizeError> {
    let mut all: Vec<Simulated> = Vec::new();
    let everywhere = shortlist(seen, APART, MOST);
    simulate(task, "candidates", &everywhere, &mut all, spread, rounded)?;
    let mut best: Vec<&Simulated> = all.iter().collect();
    best.sort_by(|a, b| b.chosen.judged().total_cmp(&a.chosen.judged()));
    best.truncate(BEST);
    let near = |(parts, _): &&Seen| {
        best.iter().any(|best| distance(&best.parts, parts) < APART)
            && all.iter().all(|known| distance(&known.parts, parts) >= CLOSE)
    };
    let close: Vec<Seen> = seen.iter().filter(near).cloned().collect();
    let close = shortlist(&close, CLOSE, MOST_CLOSE);
    simulate(task, "closer candidates", &close, &mut all, spread, rounded)?;
    let candidates = all.iter().map(|one| {
        let Chosen { choice, score, .. } = one.chosen;
        (Candidate { choice, score, simulated: one.chosen.judged() }, one.written.clone())
    });
    let candidates = candidates.collect();
    // Of equals the first, which the search likes better.
    let better = |a: Simulated, b: Simulated| {
        if b.chosen.judged() > a.chosen.judged() { b } else { a }
    };
    let Simulated { chosen, written, places, .. } =
        all.into_iter().reduce(better).ok_or(OptimizeError::Nowhere)?;
    Ok(Judged { chosen, written, places, candidates })
}

/// Simulates candidates in their order; one that the search finds no better than the best so far as
/// simulated is left out, since simulation finds none better than the search does.
fn simulate(
    task: &Task,
    what: &'static str,
    candidates: &[Seen],
    all: &mut Vec<Simulated>,
    spread: &dyn Spread,
    rounded: Rounded,
) -> Result<(), OptimizeError> {
    for some in candidates.chunks(TOGETHER) {
        let best = all.iter().map(|one| one.chosen.judged()).max_by(f64::total_cmp);
        let could = |(_, score): &&Seen| best.is_none_or(|best| *score > best);
        let left: Vec<&Seen> = some.iter().filter(could).collect();
        let found = map(spread, what, left.len(), |k| {
            let parts = left[k].0.clone();
            let (mut chosen, written) = rounded(&parts)?;
            let places = confirm::confirm(task, &chosen.choice)?;
            chosen.simulated = Some(simulated(chosen.score, &places));
            Ok::<_, OptimizeError>(Simulated { parts, chosen, written, places })
        });
        for one in found {
            all.push(one?);
        }
    }
    Ok(())
}
