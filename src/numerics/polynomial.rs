//! Real roots of a polynomial with a certified count.
//!
//! The coefficients, being floating-point numbers, are exact rationals. Sturm's sequence in rational
//! arithmetic therefore counts the distinct real roots of *this* polynomial without any rounding,
//! isolates them, and leaves refinement to floating point; every refined root is enclosed by two
//! numbers between which the exact polynomial changes sign. Roots that are a thousandth of an ulp
//! apart are two, a double root is one and says so, and none is invented.

use dashu_ratio::RBig;

use super::bracket::brent;
use crate::tally;

/// A real root and its evidence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CertifiedRoot {
    /// The root, to rounding.
    pub at: f64,
    /// Lower end of an interval that contains this root and no other.
    pub lower: f64,
    /// Upper end of that interval.
    pub upper: f64,
    /// Exact value of the polynomial at `at`, over the sum of its terms' absolute values.
    pub residual: f64,
    /// Whether the root has even multiplicity: the polynomial touches zero without crossing it.
    pub touching: bool,
}

/// Why no roots can be given.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum PolynomialError {
    /// A coefficient is infinite or not a number.
    #[error("a coefficient of the polynomial is not finite")]
    NotFinite,
    /// All coefficients are zero: every number is a root.
    #[error("the polynomial is identically zero")]
    Zero,
}

/// All distinct real roots above `lower`, ascending; `coefficients` ascend by power.
///
/// # Errors
/// [`PolynomialError`] for a polynomial that has no well-defined set of roots.
pub fn roots_above(
    coefficients: &[f64],
    lower: f64,
) -> Result<Vec<CertifiedRoot>, PolynomialError> {
    let exact = ExactPolynomial::new(coefficients)?;
    if exact.0.len() == 1 {
        return Ok(Vec::new());
    }
    let chain = SturmChain::new(&exact);
    let upper = exact.bound_on_roots().max(lower);
    let whole = Interval {
        lower,
        upper,
        changes_lower: chain.sign_changes(lower),
        changes_upper: chain.sign_changes(upper),
    };
    let mut isolated = Vec::new();
    chain.isolate(whole, &mut isolated);
    let numbers = Horner::new(coefficients);
    Ok(isolated.iter().map(|interval| refine(interval, &chain, &exact, &numbers)).collect())
}

#[derive(Debug, Clone, Copy)]
struct Interval {
    lower: f64,
    upper: f64,
    changes_lower: usize,
    changes_upper: usize,
}

/// Ascending coefficients; the last one is not zero.
struct ExactPolynomial(Vec<RBig>);

impl ExactPolynomial {
    fn new(coefficients: &[f64]) -> Result<Self, PolynomialError> {
        let mut exact = Vec::with_capacity(coefficients.len());
        for &coefficient in coefficients {
            exact.push(RBig::try_from(coefficient).map_err(|_| PolynomialError::NotFinite)?);
        }
        trim(&mut exact);
        if exact.is_empty() { Err(PolynomialError::Zero) } else { Ok(Self(exact)) }
    }

    fn value(&self, at: f64) -> RBig {
        evaluate(&self.0, &rational(at))
    }

    fn sign(&self, at: f64) -> i8 {
        sign(&self.value(at))
    }

    /// Cauchy's bound, rounded up; infinity is cut to the largest number.
    fn bound_on_roots(&self) -> f64 {
        let leading = self.0.last().map_or(0.0, |c| c.to_f64().value().abs());
        let largest = self.0.iter().map(|c| c.to_f64().value().abs()).fold(0.0, f64::max);
        (1.01 * (1.0 + largest / leading)).min(f64::MAX)
    }
}

struct SturmChain(Vec<Vec<RBig>>);

impl SturmChain {
    fn new(polynomial: &ExactPolynomial) -> Self {
        let mut chain = vec![polynomial.0.clone(), derivative(&polynomial.0)];
        loop {
            let [.., before, last] = chain.as_slice() else { unreachable!("two to begin with") };
            let mut next = remainder(before, last);
            if next.is_empty() {
                return Self(chain);
            }
            // Any positive multiple serves; a leading coefficient of +-1 keeps the numbers short.
            let scale = absolute(&next[next.len() - 1]);
            for coefficient in &mut next {
                *coefficient = -(&*coefficient / &scale);
            }
            chain.push(next);
        }
    }

    fn sign_changes(&self, at: f64) -> usize {
        let at = rational(at);
        let signs = self.0.iter().map(|p| sign(&evaluate(p, &at))).filter(|&sign| sign != 0);
        let signs: Vec<i8> = signs.collect();
        signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
    }

    /// Splits until every interval holds one root; ends because distinct roots that share a
    /// floating-point interval are reported together only when no number lies between its ends.
    fn isolate(&self, interval: Interval, isolated: &mut Vec<Interval>) {
        let count = interval.changes_lower.saturating_sub(interval.changes_upper);
        if count == 0 {
            return;
        }
        let Some(middle) = between(interval.lower, interval.upper) else {
            isolated.extend(std::iter::repeat_n(interval, count));
            return;
        };
        if count == 1 {
            isolated.push(interval);
            return;
        }
        let changes = self.sign_changes(middle);
        self.isolate(Interval { upper: middle, changes_upper: changes, ..interval }, isolated);
        self.isolate(Interval { lower: middle, changes_lower: changes, ..interval }, isolated);
    }
}

fn refine(
    interval: &Interval,
    chain: &SturmChain,
    exact: &ExactPolynomial,
    numbers: &Horner,
) -> CertifiedRoot {
    let Interval { lower, upper, .. } = *interval;
    let (below, above) = (exact.sign(lower), exact.sign(upper));
    let enclosed = if above == 0 {
        Some((upper, upper))
    } else if below * above < 0 {
        quick_enclosure(interval, exact, numbers)
            .or_else(|| Some(bisect(interval, |at| exact.sign(at) != below)))
    } else {
        None
    };
    // The lower end is excluded, so a zero there belongs to another interval.
    let touching = enclosed.is_none() && below != 0;
    let (lower, upper) = enclosed
        .unwrap_or_else(|| bisect(interval, |at| chain.sign_changes(at) < interval.changes_lower));
    let at = best_of(lower, upper, numbers);
    CertifiedRoot { at, lower, upper, residual: numbers.scaled(at, exact), touching }
}

/// Brent's root in floating point, accepted when the exact polynomial changes sign a few ulps
/// around it.
fn quick_enclosure(
    interval: &Interval,
    exact: &ExactPolynomial,
    numbers: &Horner,
) -> Option<(f64, f64)> {
    let width = 4.0 * f64::EPSILON * interval.upper.abs().min(1.0);
    let root = brent(interval.lower, interval.upper, width, |at| numbers.value(at)).ok()?.at;
    let mut reach = 2.0 * f64::EPSILON * root.abs().max(f64::MIN_POSITIVE);
    for _ in 0..6 {
        let lower = (root - reach).max(interval.lower);
        let upper = (root + reach).min(interval.upper);
        if exact.sign(lower) * exact.sign(upper) < 0 {
            return Some((lower, upper));
        }
        reach *= 8.0;
    }
    None
}

/// Shrinks the interval to neighbouring numbers; `is_right(at)` says whether the root lies at or
/// left of `at`.
fn bisect(interval: &Interval, is_right: impl Fn(f64) -> bool) -> (f64, f64) {
    let (mut lower, mut upper) = (interval.lower, interval.upper);
    while let Some(middle) = between(lower, upper) {
        if is_right(middle) {
            upper = middle;
        } else {
            lower = middle;
        }
    }
    (lower, upper)
}

fn best_of(lower: f64, upper: f64, numbers: &Horner) -> f64 {
    let middle = 0.5 * (lower + upper);
    [lower, middle, upper]
        .into_iter()
        .min_by(|a, b| numbers.value(*a).abs().total_cmp(&numbers.value(*b).abs()))
        .unwrap_or(middle)
}

/// The number halfway between two others in the order of representable numbers, so that sixty-four
/// halvings reach neighbours whatever the magnitudes.
fn between(lower: f64, upper: f64) -> Option<f64> {
    let (a, b) = (ordered(lower), ordered(upper));
    let middle = ((i128::from(a) + i128::from(b)) / 2) as i64;
    (middle > a && middle < b).then(|| unordered(middle))
}

fn ordered(number: f64) -> i64 {
    let bits = number.to_bits() as i64;
    if bits < 0 { i64::MIN.wrapping_sub(bits) } else { bits }
}

fn unordered(order: i64) -> f64 {
    f64::from_bits(if order < 0 { i64::MIN.wrapping_sub(order) } else { order } as u64)
}

/// Compensated Horner scheme: as accurate as if computed in twice the working precision (Graillat,
/// Langlois, Louvet 2005).
struct Horner(Vec<f64>);

impl Horner {
    fn new(coefficients: &[f64]) -> Self {
        Self(coefficients.iter().rev().copied().collect())
    }

    fn value(&self, at: f64) -> f64 {
        let (mut value, mut correction) = (0.0_f64, 0.0_f64);
        for &coefficient in &self.0 {
            let product = value * at;
            let product_error = value.mul_add(at, -product);
            let sum = product + coefficient;
            let virtual_part = sum - product;
            let sum_error = (product - (sum - virtual_part)) + (coefficient - virtual_part);
            correction = correction * at + (product_error + sum_error);
            value = sum;
        }
        value + correction
    }

    fn scaled(&self, at: f64, exact: &ExactPolynomial) -> f64 {
        let size = self.0.iter().fold(0.0, |sum, c| sum * at.abs() + c.abs());
        exact.value(at).to_f64().value().abs() / size.max(f64::MIN_POSITIVE)
    }
}

fn rational(number: f64) -> RBig {
    RBig::try_from(number).unwrap_or(RBig::ZERO)
}

fn sign(number: &RBig) -> i8 {
    if *number == RBig::ZERO {
        0
    } else if *number > RBig::ZERO {
        1
    } else {
        -1
    }
}

fn absolute(number: &RBig) -> RBig {
    if sign(number) < 0 { -number.clone() } else { number.clone() }
}

fn trim(coefficients: &mut Vec<RBig>) {
    while coefficients.last().is_some_and(|c| *c == RBig::ZERO) {
        coefficients.pop();
    }
}

fn evaluate(coefficients: &[RBig], at: &RBig) -> RBig {
    tally::note(2 * tally::EXACT * coefficients.len() as u64);
    coefficients.iter().rev().fold(RBig::ZERO, |sum, c| sum * at + c)
}

fn derivative(coefficients: &[RBig]) -> Vec<RBig> {
    coefficients.iter().enumerate().skip(1).map(|(n, c)| c * RBig::from(n as u64)).collect()
}

fn remainder(dividend: &[RBig], divisor: &[RBig]) -> Vec<RBig> {
    let mut rest = dividend.to_vec();
    let leading = &divisor[divisor.len() - 1];
    while rest.len() >= divisor.len() {
        let shift = rest.len() - divisor.len();
        let factor = &rest[rest.len() - 1] / leading;
        tally::note(2 * tally::EXACT * divisor.len() as u64);
        for (n, coefficient) in divisor.iter().enumerate() {
            rest[shift + n] = &rest[shift + n] - &factor * coefficient;
        }
        rest.pop();
        trim(&mut rest);
    }
    rest
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn expand(roots: &[f64]) -> Vec<f64> {
        let mut coefficients = vec![1.0];
        for root in roots {
            let mut next = vec![0.0; coefficients.len() + 1];
            for (n, c) in coefficients.iter().enumerate() {
                next[n + 1] += c;
                next[n] -= root * c;
            }
            coefficients = next;
        }
        coefficients
    }

    #[test]
    fn simple_roots_are_found_to_rounding() {
        let found = roots_above(&expand(&[0.5, 1.0, 2.0, 8.0]), 0.0).expect("well defined");
        let at: Vec<f64> = found.iter().map(|root| root.at).collect();
        assert_eq!(at, [0.5, 1.0, 2.0, 8.0]);
        assert!(found.iter().all(|root| root.residual < 1e-16 && !root.touching), "{found:?}");
    }

    #[test]
    fn roots_one_part_in_ten_million_apart_are_two() {
        // (x - 1)(x - 1 - 2^-24)(x^2 + 1): the products are exact in double precision.
        let gap = libm::exp2(-24.0);
        let (b, c) = (-(2.0 + gap), 1.0 + gap);
        let found = roots_above(&[c, b, c + 1.0, b, 1.0], 0.0).expect("well defined");
        assert_eq!(found.len(), 2, "{found:?}");
        assert!((found[1].at - found[0].at - gap).abs() < 1e-15, "{found:?}");
    }

    #[test]
    fn an_exact_double_root_is_one_and_says_so() {
        // (x - 1)^2 (x^2 + 1)
        let found = roots_above(&[1.0, -2.0, 2.0, -2.0, 1.0], 0.0).expect("well defined");
        assert_eq!(found.len(), 1);
        assert!(found[0].touching && (found[0].at - 1.0).abs() < 1e-15, "{found:?}");
        // One unit in the last place lower there are two, higher there is none.
        let lower = roots_above(&[1.0_f64.next_down(), -2.0, 2.0, -2.0, 1.0], 0.0);
        assert_eq!(lower.expect("well defined").len(), 2);
        let higher = roots_above(&[1.0_f64.next_up(), -2.0, 2.0, -2.0, 1.0], 0.0);
        assert_eq!(higher.expect("well defined").len(), 0);
    }

    #[test]
    fn scales_from_tiny_to_huge_are_handled() {
        let found = roots_above(&expand(&[1e-30, 1.0, 1e30]), 0.0).expect("well defined");
        assert_eq!(found.len(), 3, "{found:?}");
        assert!((found[0].at / 1e-30 - 1.0).abs() < 1e-15);
        assert!((found[2].at / 1e30 - 1.0).abs() < 1e-15);
    }

    #[test]
    fn what_has_no_roots_is_refused_or_empty() {
        assert_eq!(roots_above(&[0.0, 0.0], 0.0), Err(PolynomialError::Zero));
        assert_eq!(roots_above(&[f64::NAN, 1.0], 0.0), Err(PolynomialError::NotFinite));
        assert_eq!(roots_above(&[3.0], 0.0), Ok(vec![]));
        assert_eq!(roots_above(&[1.0, 0.0, 1.0], 0.0), Ok(vec![]));
        assert_eq!(roots_above(&[1.0, 1.0], 0.0), Ok(vec![]), "-1 is not above 0");
    }

    proptest! {
        /// Roots in steps of 1/8 make exact coefficients, so that the true count is known.
        #[test]
        fn none_is_lost_and_none_is_invented(mut eighths in prop::collection::vec(1_i32..64, 1..6)) {
            eighths.sort_unstable();
            let roots: Vec<f64> = eighths.iter().map(|n| f64::from(*n) / 8.0).collect();
            let mut distinct = roots.clone();
            distinct.dedup();
            let found = roots_above(&expand(&roots), 0.0).expect("well defined");
            prop_assert_eq!(found.len(), distinct.len());
            for (root, truth) in found.iter().zip(distinct) {
                // The enclosure is what is certified; the polished value is its best point.
                prop_assert!(root.lower <= truth && truth <= root.upper, "{root:?} {truth}");
            }
        }
    }
}
