//! Expressions: exact numbers, symbols, sums, products, integer powers, and three functions.
//!
//! Every constructor simplifies lightly and keeps what a reader wrote: sums keep their order,
//! products are ordered as the table of symbols, like terms and like factors are merged, zeros and
//! ones vanish. Nothing is multiplied out unless [`Expr::expand`] is asked for.

use super::{Rational, Symbol};
use std::sync::Arc;

/// A function of one argument.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Function {
    /// Square root, of arguments that are not negative.
    Sqrt,
    /// Sine of an angle in radians.
    Sin,
    /// Cosine of an angle in radians.
    Cos,
}

/// An expression. Build it with operators, [`Expr::power`], [`sqrt`], [`sin`], [`cos`]; the
/// variants are public to be read, and hold what the constructors guarantee. Parts are shared, so a
/// clone costs nothing.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Expr {
    /// An exact number.
    Number(Rational),
    /// A named quantity.
    Symbol(Symbol),
    /// A function of an expression.
    Function(Function, Arc<Expr>),
    /// Two terms or more, in the order in which they were stated.
    Sum(Arc<Vec<Expr>>),
    /// Two factors or more in the order of the table of symbols, a number first.
    Product(Arc<Vec<Expr>>),
    /// A symbol, function or sum to a power other than 0 and 1.
    Power(Arc<Expr>, i32),
}

/// `numerator / denominator` as an expression.
pub fn fraction(numerator: i32, denominator: i32) -> Expr {
    Expr::Number(Rational::new(numerator.into(), denominator.into()))
}

/// The square root of an expression.
pub fn sqrt(argument: impl Into<Expr>) -> Expr {
    Expr::function(Function::Sqrt, argument.into())
}

/// The sine of an expression.
pub fn sin(argument: impl Into<Expr>) -> Expr {
    Expr::function(Function::Sin, argument.into())
}

/// The cosine of an expression.
pub fn cos(argument: impl Into<Expr>) -> Expr {
    Expr::function(Function::Cos, argument.into())
}

impl Expr {
    /// 0.
    pub const ZERO: Expr = Expr::Number(Rational::ZERO);
    /// 1.
    pub const ONE: Expr = Expr::Number(Rational::ONE);

    /// Whether this is the number 0 as it stands, without expanding.
    pub fn is_zero(&self) -> bool {
        matches!(self, Expr::Number(number) if number.is_zero())
    }

    /// The function of an argument; only 0 and 1 are simplified.
    pub fn function(function: Function, argument: Expr) -> Expr {
        let is_one = argument == Expr::ONE;
        match function {
            Function::Sqrt | Function::Sin if argument.is_zero() => Expr::ZERO,
            Function::Sqrt if is_one => Expr::ONE,
            Function::Cos if argument.is_zero() => Expr::ONE,
            _ => Expr::Function(function, Arc::new(argument)),
        }
    }

    /// The sum of terms, like terms merged at the first one's place.
    pub fn sum(terms: impl IntoIterator<Item = Expr>) -> Expr {
        let mut merged: Vec<(Expr, Rational)> = Vec::new();
        for term in terms {
            match term {
                Expr::Sum(inner) => {
                    owned(inner).into_iter().for_each(|term| merge(&mut merged, term))
                }
                term => merge(&mut merged, term),
            }
        }
        let terms: Vec<Expr> = merged
            .into_iter()
            .filter(|(_, coefficient)| !coefficient.is_zero())
            .map(|(rest, coefficient)| rest.scaled(coefficient))
            .collect();
        if terms.iter().any(|term| matches!(term, Expr::Sum(_))) && terms.len() > 1 {
            return Expr::sum(terms);
        }
        single_or(terms, Expr::ZERO, many_terms)
    }

    /// The product of factors, like factors merged into powers.
    pub fn product(factors: impl IntoIterator<Item = Expr>) -> Expr {
        let mut builder = ProductBuilder { coefficient: Rational::ONE, powers: Vec::new() };
        factors.into_iter().for_each(|factor| builder.push(factor, 1));
        builder.finish()
    }

    /// An integer power, negative ones included.
    ///
    /// # Panics
    /// For a negative power of the number 0.
    pub fn power(&self, exponent: i32) -> Expr {
        if matches!(self, Expr::Sum(_)) && exponent > 1 {
            return Expr::Power(Arc::new(self.clone()), exponent);
        }
        let mut builder = ProductBuilder { coefficient: Rational::ONE, powers: Vec::new() };
        builder.push(self.clone(), exponent);
        builder.finish()
    }

    /// The square.
    pub fn squared(&self) -> Expr {
        self.power(2)
    }

    /// Where a factor belongs in a product: at the last of its symbols in the table, so that
    /// `(1 + R)` comes before `B` and `(1 - beta)` after `beta`.
    fn rank(&self) -> Option<Symbol> {
        match self {
            Expr::Number(_) => None,
            Expr::Symbol(symbol) => Some(*symbol),
            Expr::Function(_, inner) | Expr::Power(inner, _) => inner.rank(),
            Expr::Sum(parts) | Expr::Product(parts) => parts.iter().map(Expr::rank).max().flatten(),
        }
    }

    /// A number times what is left of the expression when that number is taken out.
    pub(super) fn split_coefficient(self) -> (Rational, Expr) {
        match self {
            Expr::Number(number) => (number, Expr::ONE),
            Expr::Product(factors) => match factors[0] {
                Expr::Number(number) => {
                    let rest = factors[1..].to_vec();
                    (number, single_or(rest, Expr::ONE, many_factors))
                }
                _ => (Rational::ONE, Expr::Product(factors)),
            },
            other => (Rational::ONE, other),
        }
    }

    /// The number in front of a term.
    pub(super) fn coefficient(&self) -> Rational {
        match self {
            Expr::Number(number) => *number,
            Expr::Product(factors) => match factors[0] {
                Expr::Number(number) => number,
                _ => Rational::ONE,
            },
            _ => Rational::ONE,
        }
    }

    /// The same expression times a number; signs are carried into a sum, other numbers stay outside.
    pub(super) fn scaled(self, factor: Rational) -> Expr {
        if factor == Rational::ONE {
            return self;
        }
        match self {
            Expr::Number(number) => Expr::Number(number * factor),
            Expr::Sum(terms) if factor == Rational::MINUS_ONE => {
                many_terms(owned(terms).into_iter().map(|term| term.scaled(factor)).collect())
            }
            Expr::Product(_) => {
                let (coefficient, rest) = self.split_coefficient();
                rest.with_number(coefficient * factor)
            }
            other => other.with_number(factor),
        }
    }

    fn with_number(self, number: Rational) -> Expr {
        if number == Rational::ONE {
            return self;
        }
        if number.is_zero() {
            return Expr::ZERO;
        }
        match self {
            Expr::Product(factors) => {
                many_factors([&[Expr::Number(number)], factors.as_slice()].concat())
            }
            Expr::Sum(_) if number == Rational::MINUS_ONE => self.scaled(number),
            other => many_factors(vec![Expr::Number(number), other]),
        }
    }
}

fn merge(merged: &mut Vec<(Expr, Rational)>, term: Expr) {
    let (coefficient, rest) = term.split_coefficient();
    match merged.iter_mut().find(|(known, _)| *known == rest) {
        Some((_, sum)) => *sum = *sum + coefficient,
        None => merged.push((rest, coefficient)),
    }
}

fn owned(parts: Arc<Vec<Expr>>) -> Vec<Expr> {
    Arc::unwrap_or_clone(parts)
}

fn many_terms(terms: Vec<Expr>) -> Expr {
    Expr::Sum(Arc::new(terms))
}

fn many_factors(factors: Vec<Expr>) -> Expr {
    Expr::Product(Arc::new(factors))
}

fn single_or(mut parts: Vec<Expr>, none: Expr, many: fn(Vec<Expr>) -> Expr) -> Expr {
    match parts.len() {
        0 => none,
        1 => parts.remove(0),
        _ => many(parts),
    }
}

struct ProductBuilder {
    coefficient: Rational,
    powers: Vec<(Expr, i32)>,
}

impl ProductBuilder {
    fn push(&mut self, factor: Expr, exponent: i32) {
        match factor {
            _ if exponent == 0 => {}
            Expr::Number(number) => self.coefficient = self.coefficient * number.power(exponent),
            Expr::Power(base, inner) => self.push(Arc::unwrap_or_clone(base), inner * exponent),
            Expr::Product(factors) => {
                owned(factors).into_iter().for_each(|factor| self.push(factor, exponent));
            }
            Expr::Sum(terms) => {
                let content = content(&terms);
                if content == Rational::ONE {
                    return self.merge(Expr::Sum(terms), exponent);
                }
                self.coefficient = self.coefficient * content.power(exponent);
                let scale = content.reciprocal();
                let terms = owned(terms).into_iter().map(|term| term.scaled(scale)).collect();
                self.merge(many_terms(terms), exponent);
            }
            other => self.merge(other, exponent),
        }
    }

    fn merge(&mut self, base: Expr, exponent: i32) {
        match self.powers.iter_mut().find(|(known, _)| *known == base) {
            Some((_, sum)) => *sum += exponent,
            None => self.powers.push((base, exponent)),
        }
    }

    /// Even powers of a square root become powers of what is under it.
    fn unroot(&mut self) {
        let is_even_root = |(base, exponent): &(Expr, i32)| {
            matches!(base, Expr::Function(Function::Sqrt, _)) && exponent.abs() > 1
        };
        while let Some(place) = self.powers.iter().position(is_even_root) {
            let (root, exponent) = self.powers.swap_remove(place);
            if let Expr::Function(Function::Sqrt, argument) = &root {
                self.push(argument.as_ref().clone(), exponent / 2);
            }
            self.push(root, exponent % 2);
        }
    }

    /// `-(-a + b)` is written `(a - b)`.
    fn absorb_sign(&mut self) {
        let starts_negative = |(base, exponent): &(Expr, i32)| {
            let Expr::Sum(terms) = base else { return false };
            exponent % 2 != 0 && terms[0].coefficient().is_negative()
        };
        if !self.coefficient.is_negative() {
            return;
        }
        if let Some(place) = self.powers.iter().position(starts_negative) {
            self.coefficient = -self.coefficient;
            let base = std::mem::replace(&mut self.powers[place].0, Expr::ZERO);
            self.powers[place].0 = base.scaled(Rational::MINUS_ONE);
        }
    }

    fn finish(mut self) -> Expr {
        self.unroot();
        if self.coefficient.is_zero() {
            return Expr::ZERO;
        }
        self.powers.retain(|(_, exponent)| *exponent != 0);
        self.absorb_sign();
        if self.powers.len() > 1 {
            self.powers.sort_by(|(left, _), (right, _)| {
                left.rank().cmp(&right.rank()).then_with(|| left.cmp(right))
            });
        }
        let factors = self.powers.into_iter().map(|(base, exponent)| match exponent {
            1 => base,
            _ => Expr::Power(Arc::new(base), exponent),
        });
        single_or(factors.collect(), Expr::ONE, many_factors).with_number(self.coefficient)
    }
}

/// The largest number that all terms share; negative if every term is.
fn content(terms: &[Expr]) -> Rational {
    let coefficients = || terms.iter().map(Expr::coefficient);
    let size = coefficients().map(Rational::abs).reduce(Rational::common_content);
    let size = size.unwrap_or(Rational::ONE);
    if coefficients().all(Rational::is_negative) { -size } else { size }
}
