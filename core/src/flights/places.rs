//! Where in its cavity the absorber is at the beginning: nobody knows, so that what happens from all places counts, and
//! the worst of them decides.
//!
//! Outcomes are smooth over stretches of places and jump between them, at places from which an impact just happens; on
//! either side they may rise without a bound that could be computed, over ever shorter stretches. So no number of places
//! finds the worst of all. Even places tell which share of all is worse than the worst of them ([`share_above`]); half as
//! many more, where outcomes are large and where they jump, find most of what is worse.

use crate::executor::{Executor, map};

/// Something that is read of an outcome, whose largest value counts; NaN where the outcome does not count.
pub type PlaceReading<'a, T> = &'a (dyn Fn(&T) -> f64 + Sync);

/// Places that are chosen together.
const ROUND: usize = 4;
/// Places that are not parted further, over the clearance.
const CLOSEST: f64 = 1e-4;

/// So many even places of the absorber, as relative displacements; an even number has not the middle, which theory
/// looks after.
pub fn even(count: u64) -> impl ExactSizeIterator<Item = f64> + Clone {
    (0..count as usize).map(move |k| (2 * k + 1) as f64 / count as f64 - 1.0)
}

/// The share of all places that are worse than the worst of so many even ones, at most, at odds of 19 to 1: `n` places
/// miss a share `p` with a probability of `(1 - p)^n`, if they are no better than places by chance.
pub fn share_above(count: u64) -> f64 {
    -libm::expm1(libm::log(0.05) / count as f64)
}

/// Places of a survey with so many even ones.
pub const fn with_closer(count: u64) -> u64 {
    count + count / 2
}

/// From which places something is flown, and what of it is measured.
#[derive(Clone, Copy)]
pub struct Places<'a> {
    /// Even ones.
    pub even: u64,
    /// Whether from half as many more, between those at which a measure is largest, or changes most beside a large value.
    pub closer: bool,
    /// Whether velocity and acceleration of the structure are measured as well.
    pub shaking: bool,
    /// By what.
    pub executor: &'a dyn Executor,
}

/// Outcomes from places, in the order in which they were flown.
pub fn survey<T: Send + Sync, E: Send + Sync>(
    places: Places<'_>,
    measures: &[PlaceReading<'_, T>],
    outcome: impl Fn(f64) -> Result<T, E> + Sync,
) -> Result<Vec<(f64, T)>, E> {
    let mut found: Vec<(f64, T)> = Vec::new();
    let count = if places.closer { with_closer(places.even) } else { places.even } as usize;
    let mut next: Vec<f64> = even(places.even).collect();
    while !next.is_empty() {
        let what = if found.is_empty() { "places" } else { "" };
        let flown = map(places.executor, what, next.len(), |k| outcome(next[k]));
        for (place, one) in next.iter().zip(flown) {
            found.push((*place, one?));
        }
        next = closer(&found, measures, ROUND.min(count - found.len()));
    }
    Ok(found)
}

/// Places in the middle of the gaps to look into next.
fn closer<T>(found: &[(f64, T)], measures: &[PlaceReading<'_, T>], count: usize) -> Vec<f64> {
    let mut by_place: Vec<&(f64, T)> = found.iter().collect();
    by_place.sort_by(|a, b| a.0.total_cmp(&b.0));
    let read: Vec<Vec<f64>> = measures
        .iter()
        .map(|measure| by_place.iter().map(|(_, one)| measure(one)).collect())
        // What is worst without a bound is known.
        .filter(|values: &Vec<f64>| !values.contains(&f64::INFINITY))
        .collect();
    let mut chosen: Vec<usize> = Vec::new();
    for k in 0..count.min(count * read.len()) {
        let (values, steep) = (&read[k % read.len()], k / read.len() % 2 == 1);
        let score = |gap: &usize| {
            let [a, b] = [values[*gap], values[gap + 1]];
            let jump = if steep && !(a - b).is_nan() { (a - b).abs() } else { 0.0 };
            a.max(b) + jump
        };
        let gaps = 0..by_place.len().saturating_sub(1);
        let best = gaps
            .filter(|gap| by_place[gap + 1].0 - by_place[*gap].0 > CLOSEST)
            .filter(|gap| !chosen.contains(gap) && !score(gap).is_nan())
            .max_by(|a, b| score(a).total_cmp(&score(b)));
        chosen.extend(best);
    }
    chosen.iter().map(|gap| 0.5 * (by_place[*gap].0 + by_place[gap + 1].0)).collect()
}

/// The largest of the values of a survey, and by how much the last quarter of its places has raised it: what further
/// ones may add.
pub fn worst_of_places(values: &[f64]) -> [f64; 2] {
    let largest = |some: &[f64]| some.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let worst = largest(values);
    let before = largest(&values[..values.len() - values.len() / 4]);
    [worst, if worst.is_finite() { worst - before } else { 0.0 }]
}

#[cfg(test)]
mod tests {
    use super::{Places, even, share_above, survey, worst_of_places};
    use crate::executor::Serial;

    /// The rule of three: none of `n` is so, then at most `3/n` are.
    #[test]
    fn a_share_that_no_place_has_seen_is_small() {
        assert!((share_above(64) - 3.0 / 64.0).abs() < 0.002, "{}", share_above(64));
        assert!((share_above(1) - 0.95).abs() < 1e-12);
    }

    /// A jump beside which the outcome rises like a logarithm, as at a place from which an impact just happens.
    #[test]
    fn what_rises_beside_a_jump_is_found() {
        let outcome = |w: f64| -> Result<f64, ()> {
            let from = w - 0.123_4;
            Ok(if from < 0.0 { 1.0 + w } else { 1.2 - 0.2 * libm::log(from) })
        };
        let largest = |found: &[(f64, f64)]| found.iter().map(|one| one.1).fold(0.0, f64::max);
        let from = |closer| Places { even: 32, closer, shaking: false, executor: &Serial };
        let plain = survey(from(false), &[&|one| *one], outcome).expect("flown");
        let refined = survey(from(true), &[&|one| *one], outcome).expect("flown");
        assert_eq!((plain.len(), refined.len()), (32, 48));
        assert!(even(32).eq(plain.iter().map(|one| one.0)));
        // Even places are 1/16 apart; 16 more in rounds of four halve the gap at the jump four times.
        let at_most = |distance: f64| 1.2 - 0.2 * libm::log(distance);
        let (plain, refined) = (largest(&plain), largest(&refined));
        assert!(plain < refined && refined >= at_most(1.0 / 256.0), "{plain} {refined}");
    }

    #[test]
    fn the_error_is_what_the_last_quarter_adds() {
        assert_eq!(worst_of_places(&[3.0, 1.0, 4.0, 5.0]), [5.0, 1.0]);
        assert_eq!(worst_of_places(&[5.0, 1.0, 4.0, 3.0]), [5.0, 0.0]);
        assert_eq!(worst_of_places(&[1.0, f64::INFINITY]), [f64::INFINITY, 0.0]);
    }
}
