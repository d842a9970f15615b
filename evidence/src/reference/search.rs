//! How the reference finds an event: a fine scan, halving, Newton's method.

use super::oscillator::{LEVELS, ReferenceOscillator, TimePoint};
use super::real::Decimal;

/// Corrections by Newton's method; each doubles the twelve digits that halving leaves.
const CORRECTIONS: u32 = 12;
/// Relative correction that ends them: from there the next would be below 77 digits.
const CORRECTED: f64 = 1e-45;
/// Relative correction from which on a few more are enough.
const NEARLY: f64 = 0.01;
/// Corrections that shrink a first step to the shortest way of an excursion by halves.
const HALVES: u32 = 200;

/// The last point before what is `watched`, a value with its rate, exceeds 0, to a scan step halved
/// [`LEVELS`] times; `None` if it does not within `span`. Steps grow from that smallest one, doubling the
/// way each time. Between two points a maximum is looked at as well: a touch may be far shorter than a
/// step.
pub(super) fn scan(
    oscillator: &ReferenceOscillator,
    start: TimePoint,
    span: f64,
    watched: &impl Fn(&TimePoint) -> [Decimal; 2],
) -> Option<TimePoint> {
    let step = oscillator.scan_step();
    let mut rises = watched(&start)[1].is_positive();
    let mut here = start;
    let mut level = LEVELS;
    let mut walked = 0.0;
    loop {
        let there = oscillator.step(&here, level);
        let [value, rate] = watched(&there);
        if value.is_positive() {
            break;
        }
        if rises
            && !rate.is_positive()
            && let Some(before) = at_maximum(oscillator, &here, level, watched)
        {
            (here, level) = before;
            break;
        }
        (here, rises) = (there, rate.is_positive());
        walked += libm::scalbn(step, -(level as i32));
        if walked > span {
            return None;
        }
        // The first step is taken twice.
        if level > 0 && walked >= libm::scalbn(step, 1 - level as i32) {
            level -= 1;
        }
    }
    for finer in level + 1..=LEVELS {
        let there = oscillator.step(&here, finer);
        if !watched(&there)[0].is_positive() {
            here = there;
        }
    }
    Some(here)
}

/// Halves a step towards the maximum in it; where the value exceeds 0 on the way, the point before and
/// the halvings of the step from there.
fn at_maximum(
    oscillator: &ReferenceOscillator,
    from: &TimePoint,
    level: usize,
    watched: &impl Fn(&TimePoint) -> [Decimal; 2],
) -> Option<(TimePoint, usize)> {
    let mut here = from.clone();
    for finer in level + 1..=LEVELS {
        let there = oscillator.step(&here, finer);
        let [value, rate] = watched(&there);
        if value.is_positive() {
            return Some((here, finer));
        }
        if rate.is_positive() {
            here = there;
        }
    }
    None
}

/// The zero of what is `watched` next to a point, by Newton's method.
pub(super) fn polished(
    oscillator: &ReferenceOscillator,
    near: TimePoint,
    watched: &impl Fn(&TimePoint) -> [Decimal; 2],
) -> TimePoint {
    let mut at = near.clone();
    for _ in 0..CORRECTIONS {
        let [value, rate] = watched(&at);
        if value.is_zero() || rate.is_zero() {
            break;
        }
        let correction = &value / &rate;
        at = oscillator.later(&near, &(&(&at.s - &near.s) - &correction));
        if correction.abs().to_f64() <= CORRECTED * at.s.abs().to_f64() {
            break;
        }
    }
    at
}

/// The zero of what is `watched` before a point `beyond` it, where value and rate start from rest and grow: from
/// that side Newton's method cannot leave the slope.
pub(super) fn descended(
    oscillator: &ReferenceOscillator,
    start: &TimePoint,
    beyond: TimePoint,
    watched: &impl Fn(&TimePoint) -> [Decimal; 2],
) -> TimePoint {
    let mut at = beyond;
    for _ in 0..HALVES {
        let [value, rate] = watched(&at);
        let correction = &value / &rate;
        let small = correction.abs().to_f64() <= NEARLY * at.s.abs().to_f64();
        at = oscillator.later(start, &(&at.s - &correction));
        if small {
            break;
        }
    }
    polished(oscillator, at, watched)
}
