//! Functions of one variable, looked at everywhere: where they change their sign, where they are
//! largest.

use super::bracket::narrowed;

/// Golden section, and steps of it: down to 1e-8 of two pieces, where a smooth extremum is flat.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// See [`GOLDEN`].
const NARROWINGS: u32 = 40;
/// A golden section does not come to 0 where this many values in a row are the same to this part of the smallest: next to a
/// root, of whatever order, they differ by parts of themselves.
const LEVEL: usize = 4;
const LEVEL_WITHIN: f64 = 1e-3;

/// Ends of `pieces` even pieces.
pub fn places([from, to]: [f64; 2], pieces: u32) -> impl Iterator<Item = f64> {
    let part = move |k: u32| f64::from(k) / f64::from(pieces);
    (0..=pieces).map(move |k| from * (1.0 - part(k)) + to * part(k))
}

/// Every place between `from` and `to` at which `f` changes between above 0 and not above 0; what is
/// not a number counts as not above. Exact to rounding for each that is found. Found is every change
/// between neighbours among `pieces` even pieces, and every pair of changes around an extremum that
/// lies between two neighbours on the same side.
pub fn sign_changes(range: [f64; 2], pieces: u32, mut f: impl FnMut(f64) -> f64) -> Vec<f64> {
    let mut points: Vec<(f64, f64)> = places(range, pieces).map(|at| (at, f(at))).collect();
    let dips: Vec<(f64, f64)> = points.windows(3).filter_map(|three| dip(three, &mut f)).collect();
    points.extend(dips);
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let pairs = points.windows(2).filter(|pair| (pair[0].1 > 0.0) != (pair[1].1 > 0.0));
    pairs.filter_map(|pair| narrowed([pair[0].0, pair[1].0], &mut f)).collect()
}

/// A place between three neighbours on one side at which the function is on the other, if its size
/// has a smallest value in the middle.
fn dip(three: &[(f64, f64)], f: &mut impl FnMut(f64) -> f64) -> Option<(f64, f64)> {
    let above = three[1].1 > 0.0;
    let size = |value: f64| if above { value } else { -value };
    let [left, middle, right] = [0, 1, 2].map(|k| size(three[k].1));
    let one_side = three.iter().all(|(_, value)| (*value > 0.0) == above);
    // What is the same at all three has no smallest value that could be narrowed down.
    let lowest = middle <= left && middle <= right && (middle < left || middle < right);
    if !(one_side && lowest) {
        return None;
    }
    let (at, height) = below(three[0].0, three[2].0, |at| size(f(at)))?;
    Some((at, size(height)))
}

/// A place at which a function that is above 0 at both ends is not, by golden section; `None` where it
/// has a smallest value above 0.
pub fn below(low: f64, high: f64, mut height: impl FnMut(f64) -> f64) -> Option<(f64, f64)> {
    let not_above = |value: f64| value.is_nan() || value <= 0.0;
    let mut found = None;
    let mut last = [f64::INFINITY; LEVEL];
    narrow([low, high], |at| {
        let value = height(at);
        if not_above(value) {
            found = Some((at, value));
        }
        last.rotate_left(1);
        last[LEVEL - 1] = value;
        let [least, most] = [f64::min, f64::max].map(|of| last.into_iter().fold(value, of));
        let ends = found.is_some() || most - least < LEVEL_WITHIN * least;
        (!ends).then_some(-value)
    });
    found
}

/// Narrows a range around the largest value of `f` by golden section, until `f` says `None`.
pub fn narrow([mut low, mut high]: [f64; 2], mut f: impl FnMut(f64) -> Option<f64>) {
    let mut value = |part: f64, [low, high]: [f64; 2]| {
        let at = low + (high - low) * part;
        f(at).map(|value| (at, value))
    };
    let Some(mut left) = value(1.0 - GOLDEN, [low, high]) else { return };
    let Some(mut right) = value(GOLDEN, [low, high]) else { return };
    for _ in 0..NARROWINGS {
        // Each step keeps one of the two places inside.
        let next = if left.1 > right.1 {
            (high, right) = (right.0, left);
            value(1.0 - GOLDEN, [low, high]).map(|found| left = found)
        } else {
            (low, left) = (left.0, right);
            value(GOLDEN, [low, high]).map(|found| right = found)
        };
        if next.is_none() {
            return;
        }
    }
}

/// The largest value of a continuous function and where it is, from `pieces` even pieces, the best
/// narrowed down; `None` where it is a number nowhere.
pub fn largest(
    range: [f64; 2],
    pieces: u32,
    mut f: impl FnMut(f64) -> Option<f64>,
) -> Option<(f64, f64)> {
    let tried: Vec<(f64, f64)> =
        places(range, pieces).filter_map(|at| Some((at, f(at)?))).collect();
    largest_of(tried, range, pieces, f)
}

/// The same where the values at the [`places`] are known.
pub fn largest_of(
    tried: impl IntoIterator<Item = (f64, f64)>,
    [from, to]: [f64; 2],
    pieces: u32,
    mut f: impl FnMut(f64) -> Option<f64>,
) -> Option<(f64, f64)> {
    let mut best = tried.into_iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let step = (to - from) / f64::from(pieces);
    narrow([(best.0 - step).max(from), (best.0 + step).min(to)], |at| {
        let value = f(at).unwrap_or(f64::NEG_INFINITY);
        if value > best.1 {
            best = (at, value);
        }
        Some(value)
    });
    Some(best)
}

/// Halvings of the place of a smallest value: to a thousandth of the range, which changes what is smooth by a millionth of itself.
const HALVINGS: u32 = 7;

/// Where a function is smallest that is nowhere below 0, and what it is there: of even pieces of a range, which may be a point, then
/// halving the distance to the neighbours of the best. A 0 is not followed by another look.
pub fn smallest([from, to]: [f64; 2], pieces: u32, mut f: impl FnMut(f64) -> f64) -> (f64, f64) {
    if from == to {
        return (from, f(from));
    }
    let mut better = |best: (f64, f64), at: f64| {
        let value = f(at);
        if value < best.1 { (at, value) } else { best }
    };
    let mut best = (from, f64::INFINITY);
    for at in places([from, to], pieces) {
        best = better(best, at);
        if best.1 == 0.0 {
            return best;
        }
    }
    let mut step = (to - from) / f64::from(pieces);
    for _ in 0..HALVINGS {
        step *= 0.5;
        let beside = [best.0 - step, best.0 + step].into_iter();
        best = beside.filter(|at| from <= *at && *at <= to).fold(best, &mut better);
    }
    best
}

/// By how much the top of the parabola through the origin and two points to its left and right, which are no higher, is above the
/// origin.
fn top_above([left, below_left]: [f64; 2], [right, below_right]: [f64; 2]) -> f64 {
    // y = p x + c x^2.
    let [a, b] = [below_left / left, below_right / right];
    let c = (b - a) / (right - left);
    let p = a - c * left;
    if c < 0.0 { (-0.25 * p * p / c).max(0.0) } else { 0.0 }
}

/// How many times as far a neighbour may be as the other: what two places that almost coincide differ by is chance, a slope that chance
/// decides has its top anywhere, and what a peak falls by on the way to a far one says nothing of its top. Below 2.4 half of the
/// differences is more than the top.
const UNEVEN: f64 = 4.0;

/// The top of the parabola through a place and its neighbours, each with its value, where these are no higher and about as far.
pub fn top_of([left, own, right]: [[f64; 2]; 3]) -> Option<f64> {
    let beside = |[at, value]: [f64; 2]| {
        let lower = value <= own[1] && value.is_finite();
        lower.then_some([at - own[0], value - own[1]])
    };
    let (left, right) = (beside(left)?, beside(right)?);
    let alike = (1.0 / UNEVEN..=UNEVEN).contains(&(-left[0] / right[0]));
    alike.then(|| own[1] + top_above(left, right))
}

/// The largest of values, each behind its place, ascending, or the top of the parabola through it and its neighbours where these are
/// about as far: a smooth top between even places is known to the fourth power of their distance.
pub fn top(values: &[[f64; 2]]) -> f64 {
    let highest = (0..values.len()).max_by(|a, b| values[*a][1].total_cmp(&values[*b][1]));
    let Some(k) = highest else { return f64::NEG_INFINITY };
    let around = k.checked_sub(1).and_then(|before| values.get(before..k + 2));
    around.and_then(|around| top_of([around[0], around[1], around[2]])).unwrap_or(values[k][1])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of y = 1 - (x - 0.1)^2 / 2 between its places; on a narrow peak a far neighbour adds nothing.
    #[test]
    fn a_top_lies_between_even_places_and_nowhere_else() {
        let smooth = |x: f64| [x, 1.0 - 0.5 * (x - 0.1) * (x - 0.1)];
        assert!((top(&[-1.0, 0.0, 1.0].map(smooth)) - 1.0).abs() < 1e-12);
        let narrow = |x: f64| [x, 1.0 / (1.0 + 1e6 * x * x)];
        assert_eq!(top(&[-0.01, 0.0, 1.0].map(narrow)), 1.0);
        // The largest at an end has no neighbour there.
        assert_eq!(top(&[[0.0, 3.0], [1.0, 1.0]]), 3.0);
    }

    #[test]
    fn a_pair_of_changes_within_one_piece_is_found() {
        // Roots at 0.5 -+ 1e-5: far closer than the pieces.
        let f = |x: f64| (x - 0.5) * (x - 0.5) - 1e-10;
        let found = sign_changes([0.0, 1.03], 16, f);
        assert_eq!(found.len(), 2, "{found:?}");
        assert!((found[0] - 0.49999).abs() < 1e-14 && (found[1] - 0.50001).abs() < 1e-14);
        assert_eq!(sign_changes([0.0, 1.03], 16, |x| -f(x)), found);
    }

    /// By hand: `1 - 1.1/(1 + u^2)` vanishes at `u^2 = 0.1`; in units of 3e-4 it is a dip 200 times narrower than a piece,
    /// on a level ground. A smallest value far above 0, and level ground alone, are soon left.
    #[test]
    fn a_dip_in_level_ground_is_found_and_the_ground_is_not_searched() {
        let dip = |x: f64| 1.0 - 1.1 / (1.0 + ((x - 0.52) / 3e-4) * ((x - 0.52) / 3e-4));
        let found = sign_changes([0.0, 1.03], 16, dip);
        let off = 3e-4 * 0.1_f64.sqrt();
        assert_eq!(found.len(), 2, "{found:?}");
        // Rounding of the place.
        assert!((found[0] - 0.52 + off).abs() < 1e-15 && (found[1] - 0.52 - off).abs() < 1e-15);
        for (far, most) in [(1.0, 17 + 12), (0.0, 17)] {
            let mut count = 0;
            let none = sign_changes([0.0, 1.03], 16, |x| {
                count += 1;
                1.0 + far * (x - 0.52) * (x - 0.52)
            });
            assert!(none.is_empty() && count <= most, "{count}");
        }
    }

    #[test]
    fn what_is_not_a_number_is_not_above() {
        let found = sign_changes([0.0, 1.0], 10, |x| if x < 0.33 { f64::NAN } else { 1.0 });
        assert_eq!(found.len(), 1);
        assert!((found[0] - 0.33).abs() < 1e-15);
    }

    #[test]
    fn the_largest_value_is_narrowed_down() {
        let (at, value) = largest([0.0, 3.0], 7, |x| Some(libm::sin(x))).expect("it has values");
        assert!((at - std::f64::consts::FRAC_PI_2).abs() < 1e-7 && (value - 1.0).abs() < 1e-15);
        assert_eq!(largest([0.0, 1.0], 4, Some).map(|best| best.1), Some(1.0));
        assert!(largest([0.0, 1.0], 4, |_| None).is_none());
    }

    #[test]
    fn the_smallest_value_is_halved_down() {
        let (at, value) = smallest([0.0, 3.0], 7, |x| (x - 1.1).abs());
        assert!((at - 1.1).abs() < 3.0 / 7.0 / 128.0 && (value - (at - 1.1).abs()).abs() < 1e-15);
        assert_eq!(smallest([2.0, 2.0], 7, |x| x), (2.0, 2.0));
        let mut looks = 0;
        let nothing = smallest([0.0, 1.0], 4, |_| {
            looks += 1;
            0.0
        });
        assert_eq!((nothing, looks), ((0.0, 0.0), 1));
    }
}
