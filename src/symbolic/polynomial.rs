//! Multiplying out: polynomials in symbols and functions, with exact coefficients.
//!
//! An expression is read as a sum of monomials whose exponents may be negative; a sum in a
//! denominator is one more variable. The order of monomials is fixed, so results are reproducible.

use super::{Expr, Rational};
use std::collections::BTreeMap;

/// Variables with their exponents, sorted, none of them 0.
type Monomial = Vec<(Expr, i32)>;

/// A sum of monomials, none of them with coefficient 0.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Polynomial {
    terms: BTreeMap<Monomial, Rational>,
}

impl Polynomial {
    pub(super) fn zero() -> Self {
        Self { terms: BTreeMap::new() }
    }

    pub(super) fn number(number: Rational) -> Self {
        Self::term(Vec::new(), number)
    }

    pub(super) fn one() -> Self {
        Self::number(Rational::ONE)
    }

    fn term(monomial: Monomial, coefficient: Rational) -> Self {
        let mut polynomial = Self::zero();
        polynomial.add_term(monomial, coefficient);
        polynomial
    }

    pub(super) fn variable_power(variable: &Expr, exponent: i32) -> Self {
        match exponent {
            0 => Self::one(),
            _ => Self::term(vec![(variable.clone(), exponent)], Rational::ONE),
        }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// Multiplies the expression out.
    pub(super) fn of(expression: &Expr) -> Self {
        match expression {
            Expr::Number(number) => Self::number(*number),
            Expr::Symbol(_) => Self::variable_power(expression, 1),
            Expr::Function(function, inner) => {
                Self::variable_power(&Expr::function(*function, inner.expand()), 1)
            }
            Expr::Sum(terms) => {
                terms.iter().fold(Self::zero(), |sum, term| sum.plus(Self::of(term)))
            }
            Expr::Product(factors) => {
                factors.iter().fold(Self::one(), |product, factor| product.times(&Self::of(factor)))
            }
            Expr::Power(base, exponent) => Self::of(base).power(*exponent),
        }
    }

    /// The terms in their fixed order, or backwards if that avoids a leading minus sign.
    pub(super) fn to_expr(&self) -> Expr {
        let mut terms: Vec<Expr> = self.terms.iter().map(term_to_expr).collect();
        let is_negative = |term: Option<&Expr>| term.is_some_and(|t| t.coefficient().is_negative());
        if is_negative(terms.first()) && !is_negative(terms.last()) {
            terms.reverse();
        }
        Expr::sum(terms)
    }

    pub(super) fn power(&self, exponent: i32) -> Self {
        if exponent >= 0 {
            return (0..exponent).fold(Self::one(), |product, _| product.times(self));
        }
        let mut terms = self.terms.iter();
        if let (Some((monomial, coefficient)), None) = (terms.next(), terms.next()) {
            let scaled = |(variable, inner): &(Expr, i32)| (variable.clone(), inner * exponent);
            return Self::term(monomial.iter().map(scaled).collect(), coefficient.power(exponent));
        }
        let (content, primitive) = self.primitive();
        let inverse = Self::variable_power(&primitive.to_expr(), exponent);
        inverse.scaled(content.power(exponent))
    }

    pub(super) fn plus(mut self, other: Self) -> Self {
        for (monomial, coefficient) in other.terms {
            self.add_term(monomial, coefficient);
        }
        self
    }

    pub(super) fn minus(self, other: &Self) -> Self {
        self.plus(other.scaled(Rational::MINUS_ONE))
    }

    pub(super) fn scaled(&self, factor: Rational) -> Self {
        let scale = |(monomial, coefficient): (&Monomial, &Rational)| {
            (monomial.clone(), *coefficient * factor)
        };
        Self { terms: self.terms.iter().map(scale).collect() }
    }

    pub(super) fn times(&self, other: &Self) -> Self {
        let mut product = Self::zero();
        for (left, left_coefficient) in &self.terms {
            for (right, right_coefficient) in &other.terms {
                product.add_term(multiplied(left, right), *left_coefficient * *right_coefficient);
            }
        }
        product
    }

    fn add_term(&mut self, monomial: Monomial, coefficient: Rational) {
        let sum = self.terms.get(&monomial).copied().unwrap_or(Rational::ZERO) + coefficient;
        if sum.is_zero() {
            self.terms.remove(&monomial);
        } else {
            self.terms.insert(monomial, sum);
        }
    }

    /// The largest number that all terms share, with the last term's sign, and the rest.
    pub(super) fn primitive(&self) -> (Rational, Self) {
        let content = self.terms.values().map(|value| value.abs());
        let Some(content) = content.reduce(Rational::common_content) else {
            return (Rational::ONE, Self::zero());
        };
        let ends_negative =
            self.terms.values().next_back().is_some_and(|value| value.is_negative());
        let content = if ends_negative { -content } else { content };
        (content, self.scaled(content.reciprocal()))
    }

    /// Every variable with the lowest exponent it has, 0 if some term lacks it.
    pub(super) fn lowest_exponents(&self) -> BTreeMap<Expr, i32> {
        let mut lowest = BTreeMap::new();
        for variable in self.variables() {
            let exponents = self.terms.keys().map(|monomial| exponent_of(monomial, &variable));
            let exponent = exponents.min().unwrap_or(0);
            lowest.insert(variable, exponent);
        }
        lowest
    }

    /// What a single term has in common with another polynomial; nothing if this has more terms.
    pub(super) fn common_monomial(&self, other: &Self) -> Option<Self> {
        let [(monomial, _)] = self.terms.iter().collect::<Vec<_>>().try_into().ok()?;
        let shared = monomial.iter().filter_map(|(variable, exponent)| {
            let others = other.terms.keys().map(|monomial| exponent_of(monomial, variable));
            let lowest = others.min().unwrap_or(0).min(*exponent);
            (lowest > 0).then(|| (variable.clone(), lowest))
        });
        Some(Self::term(shared.collect(), Rational::ONE))
    }

    /// Whether something other than a symbol stands in a denominator.
    pub(super) fn has_composite_denominator(&self) -> bool {
        let mut powers = self.terms.keys().flatten();
        powers.any(|(variable, exponent)| *exponent < 0 && !matches!(variable, Expr::Symbol(_)))
    }

    /// All variables, in the fixed order.
    pub(super) fn variables(&self) -> Vec<Expr> {
        let mut variables: Vec<Expr> =
            self.terms.keys().flatten().map(|(variable, _)| variable.clone()).collect();
        variables.sort();
        variables.dedup();
        variables
    }

    /// Coefficients of ascending powers of a variable whose exponents are not negative.
    pub(super) fn coefficients(&self, variable: &Expr) -> Vec<Self> {
        let mut coefficients = Vec::new();
        for (monomial, coefficient) in &self.terms {
            let power = exponent_of(monomial, variable).unsigned_abs() as usize;
            if coefficients.len() <= power {
                coefficients.resize_with(power + 1, Self::zero);
            }
            let rest = monomial.iter().filter(|(known, _)| known != variable).cloned().collect();
            coefficients[power].add_term(rest, *coefficient);
        }
        coefficients
    }
}

fn term_to_expr((monomial, coefficient): (&Monomial, &Rational)) -> Expr {
    let powers = monomial.iter().map(|(variable, exponent)| variable.power(*exponent));
    Expr::product(powers.chain([Expr::Number(*coefficient)]))
}

fn exponent_of(monomial: &Monomial, variable: &Expr) -> i32 {
    monomial.iter().find(|(known, _)| known == variable).map_or(0, |(_, exponent)| *exponent)
}

fn multiplied(left: &Monomial, right: &Monomial) -> Monomial {
    let mut product = left.clone();
    for (variable, exponent) in right {
        match product.binary_search_by(|(known, _)| known.cmp(variable)) {
            Ok(place) => product[place].1 += exponent,
            Err(place) => product.insert(place, (variable.clone(), *exponent)),
        }
    }
    product.retain(|(_, exponent)| *exponent != 0);
    product
}

impl Expr {
    /// Multiplies products and powers of sums out and merges like terms. A sum in a denominator
    /// stays where it is.
    pub fn expand(&self) -> Expr {
        Polynomial::of(self).to_expr()
    }
}
