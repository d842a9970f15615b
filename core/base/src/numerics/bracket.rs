//! Roots of a continuous function inside a bracket, with their evidence.

use roots::{Convergency, find_root_brent};

/// Step from the secant's root towards the middle of a bracket, over its squared width and by that of the first one.
const TOWARDS_MIDDLE: f64 = 0.2;

/// A root together with what proves it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Root {
    /// Where.
    pub at: f64,
    /// The function's value there.
    pub residual: f64,
}

/// Stops on an exact zero or on a bracket of `width`; never on a small function value, which would
/// accept a point far from the root of a badly scaled function.
struct BracketWidth {
    width: f64,
}

impl Convergency<f64> for BracketWidth {
    fn is_root_found(&mut self, value: f64) -> bool {
        value == 0.0
    }
    fn is_converged(&mut self, from: f64, to: f64) -> bool {
        (to - from).abs() <= self.width
    }
    fn is_iteration_limit_reached(&mut self, iteration: usize) -> bool {
        iteration > 200
    }
}

/// Why a bracket gave no root.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum NoRoot {
    /// The ends do not differ in sign, or one of them is not a number: there may be none.
    #[error("the function does not change its sign between the ends")]
    NoSignChange,
    /// There is a change of sign, and after 200 steps the bracket is still wider than asked for.
    #[error("the bracket of a root did not shrink to the width that was asked for")]
    NotConverged,
}

/// Brent's method on `[from, to]` until the bracket is `width` wide (Brent, Algorithms for Minimization without Derivatives,
/// 1973, chapter 4).
///
/// # Errors
/// [`NoRoot`].
pub fn brent(
    from: f64,
    to: f64,
    width: f64,
    mut function: impl FnMut(f64) -> f64,
) -> Result<Root, NoRoot> {
    let (at_from, at_to) = (function(from), function(to));
    for (at, residual) in [(from, at_from), (to, at_to)] {
        if residual == 0.0 {
            return Ok(Root { at, residual });
        }
    }
    if at_from.is_nan() || at_to.is_nan() || (at_from > 0.0) == (at_to > 0.0) {
        return Err(NoRoot::NoSignChange);
    }
    // The ends are known, and of the places in between that of the smallest value is usually the root.
    let mut best = Root { at: f64::NAN, residual: f64::INFINITY };
    let known = |at: f64| match at {
        _ if at == from => at_from,
        _ if at == to => at_to,
        _ => {
            let residual = function(at);
            if residual.abs() < best.residual.abs() {
                best = Root { at, residual };
            }
            residual
        }
    };
    let found = find_root_brent(from, to, known, &mut BracketWidth { width });
    let at = found.map_err(|_| NoRoot::NotConverged)?;
    Ok(if at == best.at { best } else { Root { at, residual: function(at) } })
}

/// Where `function` changes between above 0 and not above 0, from the side on which it is at `from`, to
/// rounding and whatever the magnitudes; what is not a number counts as not above. `None` where both
/// ends are on one side.
pub fn bisected([mut from, mut to]: [f64; 2], mut function: impl FnMut(f64) -> f64) -> Option<f64> {
    let above = function(from) > 0.0;
    if (function(to) > 0.0) == above {
        return None;
    }
    loop {
        let middle = 0.5 * (from + to);
        if middle == from || middle == to {
            return Some(to);
        }
        if (function(middle) > 0.0) == above {
            from = middle;
        } else {
            to = middle;
        }
    }
}

/// The same with `from` below `to` for a function whose values tell where to look: by the method of Oliveira and Takahashi
/// ("An enhancement of the bisection method average performance", ACM Transactions on Mathematical Software 47, 2021), which
/// takes one evaluation more than [`bisected`] at worst.
pub fn narrowed([mut from, mut to]: [f64; 2], mut function: impl FnMut(f64) -> f64) -> Option<f64> {
    let (mut low, mut high) = (function(from), function(to));
    let above = low > 0.0;
    if (high > 0.0) == above {
        return None;
    }
    let width = to - from;
    // What bisection would have left, one step late.
    let mut allowed = width;
    loop {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        if middle == from || middle == to {
            return Some(to);
        }
        let secant = (from * high - to * low) / (high - low);
        let side = (secant - middle).signum();
        let off = (secant - middle).abs() - TOWARDS_MIDDLE * 4.0 * half * half / width;
        let next = middle + side * off.max(0.0).min(allowed - half);
        let inside = next.max(from.next_up()).min(to.next_down());
        let next = if next.is_nan() { middle } else { inside };
        let value = function(next);
        if (value > 0.0) == above {
            (from, low) = (next, value);
        } else {
            (to, high) = (next, value);
        }
        allowed *= 0.5;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_badly_scaled_function_still_gives_its_root() {
        let root = brent(0.0, 3.0, 1e-15, |x| 1e-16 * (x - 1.0)).expect("bracketed");
        assert!((root.at - 1.0).abs() < 1e-14, "{root:?}");
    }

    #[test]
    fn ends_of_one_sign_are_refused() {
        assert_eq!(brent(0.0, 1.0, 1e-15, |x| x + 1.0), Err(NoRoot::NoSignChange));
        assert_eq!(brent(0.0, 1.0, 1e-15, |_| f64::NAN), Err(NoRoot::NoSignChange));
        assert_eq!(bisected([0.0, 1.0], |x| x + 1.0), None);
    }

    /// Next to 1 doubles are 2e-16 apart, and the root is none of them.
    #[test]
    fn a_bracket_that_cannot_shrink_so_far_is_told() {
        let found = brent(0.5, 3.0, 1e-17, |x| x * x - 2.0);
        assert_eq!(found, Err(NoRoot::NotConverged));
    }

    /// A smooth root, one of third order, the end of a square root, a jump, and a root among huge numbers.
    #[test]
    fn narrowing_finds_what_bisection_does_in_hardly_ever_more_steps() {
        type Case = (fn(f64) -> f64, usize);
        let functions: [Case; 5] = [
            (|x| libm::sin(x) - 0.3, 16),
            (|x| (x - 0.3) * (x - 0.3) * (x - 0.3), 60),
            (|x| if x < 0.3 { (0.3 - x).sqrt() } else { -f64::MIN_POSITIVE }, 60),
            (|x| if x < 0.3 { 1.0 } else { f64::NAN }, 60),
            (|x| 1e300 * (libm::exp(x) - 1.5), 16),
        ];
        for (k, (f, most)) in functions.into_iter().enumerate() {
            let mut count = 0;
            let found = narrowed([-0.5, 1.5], |x| {
                count += 1;
                f(x)
            });
            assert_eq!(found, bisected([-0.5, 1.5], f), "{k}");
            assert!(count <= most, "{k}: {count}");
        }
        assert_eq!(narrowed([0.0, 1.0], |x| x + 1.0), None);
    }
}
