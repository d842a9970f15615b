//! Steps of algebra and calculus that keep the structure of an expression: substitution,
//! derivative, coefficients, linear equations, and the elimination of an angle.
//!
//! Validity: identities of real analysis, used where denominators and arguments of square roots do
//! not vanish; whoever evaluates at such a point gets what floating point says there.

use super::expr::{Function, cos, sin};
use super::{AlgebraError, Expr, Symbol};

impl Expr {
    /// Whether `part`, a symbol or any sub-expression, occurs in the expression.
    pub fn contains(&self, part: &Expr) -> bool {
        self == part
            || match self {
                Expr::Number(_) | Expr::Symbol(_) => false,
                Expr::Function(_, inner) | Expr::Power(inner, _) => inner.contains(part),
                Expr::Sum(parts) | Expr::Product(parts) => {
                    parts.iter().any(|inner| inner.contains(part))
                }
            }
    }

    /// Replaces every occurrence of `part` by `replacement`. A `part` that is itself a power, such
    /// as `C^2`, is also found in the multiples of that power, such as `C^4`.
    pub fn substitute(&self, part: impl Into<Expr>, replacement: impl Into<Expr>) -> Expr {
        self.replaced(&part.into(), &replacement.into()).unwrap_or_else(|| self.clone())
    }

    /// The expression after replacement; nothing if the part does not occur.
    fn replaced(&self, part: &Expr, replacement: &Expr) -> Option<Expr> {
        if self == part {
            return Some(replacement.clone());
        }
        let in_all = |parts: &[Expr]| -> Option<Vec<Expr>> {
            let replaced: Vec<_> = parts.iter().map(|p| p.replaced(part, replacement)).collect();
            replaced.iter().any(Option::is_some).then(|| {
                let pairs = replaced.into_iter().zip(parts);
                pairs.map(|(new, old)| new.unwrap_or_else(|| old.clone())).collect()
            })
        };
        match self {
            Expr::Number(_) | Expr::Symbol(_) => None,
            Expr::Function(function, inner) => {
                Some(Expr::function(*function, inner.replaced(part, replacement)?))
            }
            Expr::Sum(terms) => in_all(terms).map(Expr::sum),
            Expr::Product(factors) => in_all(factors).map(Expr::product),
            Expr::Power(base, exponent) => match part {
                Expr::Power(known, divisor) if known == base && exponent % divisor == 0 => {
                    Some(replacement.power(exponent / divisor))
                }
                _ => Some(base.replaced(part, replacement)?.power(*exponent)),
            },
        }
    }

    /// The partial derivative by a symbol.
    pub fn differentiate(&self, symbol: Symbol) -> Expr {
        match self {
            Expr::Number(_) => Expr::ZERO,
            Expr::Symbol(known) => Expr::from(i32::from(*known == symbol)),
            Expr::Sum(terms) => Expr::sum(terms.iter().map(|term| term.differentiate(symbol))),
            Expr::Product(factors) => {
                Expr::sum(factors.iter().enumerate().filter_map(|(place, factor)| {
                    let slope = factor.differentiate(symbol);
                    let others = factors[..place].iter().chain(&factors[place + 1..]).cloned();
                    (!slope.is_zero()).then(|| Expr::product(others.chain([slope.clone()])))
                }))
            }
            Expr::Power(base, exponent) => {
                *exponent * base.power(exponent - 1) * base.differentiate(symbol)
            }
            Expr::Function(function, inner) => {
                let outer = match function {
                    Function::Sqrt => 1 / (2 * self),
                    Function::Sin => cos(inner.as_ref()),
                    Function::Cos => -sin(inner.as_ref()),
                };
                outer * inner.differentiate(symbol)
            }
        }
    }

    /// The coefficients of ascending powers of `variable`, a symbol or a function such as
    /// `sin(eta)`. Parts without the variable are kept as they are written.
    ///
    /// # Errors
    /// If the variable occurs in a denominator or inside a function.
    pub fn collect(&self, variable: impl Into<Expr>) -> Result<Vec<Expr>, AlgebraError> {
        let variable = variable.into();
        let mut coefficients = self.coefficients_of(&variable).ok_or_else(|| {
            let (expression, variable) = (self.to_latex(), variable.to_latex());
            AlgebraError::NotPolynomial { expression, variable }
        })?;
        while coefficients.last().is_some_and(Expr::vanishes) {
            coefficients.pop();
        }
        Ok(coefficients)
    }

    fn coefficients_of(&self, variable: &Expr) -> Option<Vec<Expr>> {
        if self == variable {
            return Some(vec![Expr::ZERO, Expr::ONE]);
        }
        if !self.contains(variable) {
            return Some(vec![self.clone()]);
        }
        match self {
            Expr::Number(_) | Expr::Symbol(_) | Expr::Function(..) => None,
            Expr::Sum(terms) => {
                let terms: Option<Vec<_>> =
                    terms.iter().map(|term| term.coefficients_of(variable)).collect();
                Some(add_by_power(&terms?))
            }
            Expr::Product(factors) => {
                let (dependent, free): (Vec<&Expr>, Vec<&Expr>) =
                    factors.iter().partition(|factor| factor.contains(variable));
                let free = vec![Expr::product(free.into_iter().cloned())];
                dependent.into_iter().try_fold(free, |product, factor| {
                    Some(convolve(&product, &factor.coefficients_of(variable)?))
                })
            }
            Expr::Power(base, exponent) if *exponent > 0 => {
                let base = base.coefficients_of(variable)?;
                Some((1..*exponent).fold(base.clone(), |power, _| convolve(&power, &base)))
            }
            Expr::Power(..) => None,
        }
    }

    /// Solves `self = 0` for `unknown`, which must occur with degree 1 once denominators are
    /// cleared. The solution is in lowest terms if the equation is a quotient of polynomials.
    ///
    /// # Errors
    /// If the unknown occurs inside a function, or with another degree.
    pub fn solve_linear(&self, unknown: impl Into<Expr>) -> Result<Expr, AlgebraError> {
        let unknown = unknown.into();
        let coefficients = match self.collect(unknown.clone()) {
            Ok(coefficients) => coefficients,
            Err(_) => self.numerator().collect(unknown.clone())?,
        };
        match coefficients.as_slice() {
            [constant, slope] => Ok(-constant / slope),
            _ => Err(AlgebraError::NotLinear {
                expression: self.to_latex(),
                variable: unknown.to_latex(),
                degree: coefficients.len().saturating_sub(1),
            }),
        }
    }

    /// Multiplies the other factors of a product into each term of its sum, and goes no deeper. An
    /// expression that is no product with exactly one such sum stays as it is.
    pub fn distribute(&self) -> Expr {
        let Expr::Product(factors) = self else { return self.clone() };
        let (sums, others): (Vec<&Expr>, Vec<&Expr>) =
            factors.iter().partition(|factor| matches!(factor, Expr::Sum(_)));
        let [Expr::Sum(terms)] = sums.as_slice() else { return self.clone() };
        let with_others =
            |term: &Expr| Expr::product(others.iter().copied().chain([term]).cloned());
        Expr::sum(terms.iter().map(with_others))
    }
}

/// What `sin^2 + cos^2 = 1` says about `a sin`, `a cos` (in either order) and `a`: the expression
/// that vanishes.
pub fn eliminate_angle(first_side: &Expr, second_side: &Expr, a: &Expr) -> Expr {
    first_side.squared() + second_side.squared() - a.squared()
}

fn add_by_power(terms: &[Vec<Expr>]) -> Vec<Expr> {
    let length = terms.iter().map(Vec::len).max().unwrap_or(0);
    let of_power = |power: usize| terms.iter().filter_map(move |term| term.get(power).cloned());
    (0..length).map(|power| Expr::sum(of_power(power))).collect()
}

fn convolve(left: &[Expr], right: &[Expr]) -> Vec<Expr> {
    let coefficient = |power: usize| {
        let lowest = (power + 1).saturating_sub(right.len());
        let highest = power.min(left.len() - 1);
        Expr::sum((lowest..=highest).map(|place| &left[place] * &right[power - place]))
    };
    (0..left.len() + right.len() - 1).map(coefficient).collect()
}
