//! Rational functions in lowest terms: common denominators, and common factors cancelled.
//!
//! The common factor of two polynomials comes from Euclid's algorithm with pseudo-remainders, one
//! variable at a time; that is enough for the few terms that the equations here have.

use super::polynomial::Polynomial;
use super::{AlgebraError, Expr};

/// A numerator over powers of factors.
struct Quotient {
    numerator: Polynomial,
    denominators: Vec<(Polynomial, i32)>,
}

impl Expr {
    /// One quotient in lowest terms, numerator and denominators multiplied out.
    pub fn cancel(&self) -> Expr {
        let Quotient { numerator, denominators } = Quotient::of(self).in_lowest_terms();
        let below = denominators.iter().flat_map(|(factor, power)| {
            let (content, primitive) = factor.primitive();
            [Expr::Number(content.power(-power)), primitive.to_expr().power(-power)]
        });
        Expr::product(below.chain([numerator.to_expr()]))
    }

    /// The numerator of the expression over its common denominator, multiplied out.
    pub fn numerator(&self) -> Expr {
        Quotient::of(self).in_lowest_terms().numerator.to_expr()
    }

    /// Whether the expression is 0 once it is brought to a single quotient.
    pub fn vanishes(&self) -> bool {
        let expanded = Polynomial::of(self);
        expanded.is_zero()
            || (expanded.has_composite_denominator() && Quotient::of(self).numerator.is_zero())
    }

    /// Brings what stands in a denominator to a quotient of its own, so that it has none inside.
    fn with_simple_denominators(&self) -> Expr {
        match self {
            _ if !self.has_nested_denominator() => self.clone(),
            Expr::Number(_) | Expr::Symbol(_) => self.clone(),
            Expr::Function(function, inner) => {
                Expr::function(*function, inner.with_simple_denominators())
            }
            Expr::Sum(terms) => Expr::sum(terms.iter().map(Expr::with_simple_denominators)),
            Expr::Product(factors) => {
                Expr::product(factors.iter().map(Expr::with_simple_denominators))
            }
            Expr::Power(base, exponent) => {
                let is_quotient = *exponent < 0 && base.has_denominator();
                let base =
                    if is_quotient { base.cancel() } else { base.with_simple_denominators() };
                base.power(*exponent)
            }
        }
    }

    fn has_nested_denominator(&self) -> bool {
        match self {
            Expr::Number(_) | Expr::Symbol(_) => false,
            Expr::Function(_, inner) => inner.has_nested_denominator(),
            Expr::Sum(parts) | Expr::Product(parts) => {
                parts.iter().any(Expr::has_nested_denominator)
            }
            Expr::Power(base, exponent) => {
                (*exponent < 0 && base.has_denominator()) || base.has_nested_denominator()
            }
        }
    }

    fn has_denominator(&self) -> bool {
        match self {
            Expr::Number(_) | Expr::Symbol(_) | Expr::Function(..) => false,
            Expr::Sum(parts) | Expr::Product(parts) => parts.iter().any(Expr::has_denominator),
            Expr::Power(base, exponent) => *exponent < 0 || base.has_denominator(),
        }
    }

    /// The same polynomial, multiplied out and written in descending powers of `variable`.
    ///
    /// # Errors
    /// If it is no polynomial in the variable.
    pub fn descending_in(&self, variable: impl Into<Expr>) -> Result<Expr, AlgebraError> {
        let variable = variable.into();
        let coefficients = self.expand().collect(variable.clone())?;
        let terms = coefficients.iter().enumerate().rev();
        Ok(Expr::sum(terms.map(|(power, coefficient)| match i32::try_from(power) {
            Ok(power) => coefficient.expand() * variable.power(power),
            Err(_) => unreachable!("exponents are 32 bit integers"),
        })))
    }
}

impl Quotient {
    /// Multiplies by every denominator.
    fn of(expression: &Expr) -> Self {
        let mut numerator = Polynomial::of(&expression.with_simple_denominators());
        let mut denominators: Vec<(Polynomial, i32)> = Vec::new();
        loop {
            let below: Vec<(Expr, i32)> = numerator
                .lowest_exponents()
                .into_iter()
                .filter(|(_, exponent)| *exponent < 0)
                .collect();
            if below.is_empty() {
                return Self { numerator, denominators };
            }
            let mut is_composite = false;
            for (variable, exponent) in below {
                is_composite |= !matches!(variable, Expr::Symbol(_));
                numerator = numerator.times(&Polynomial::variable_power(&variable, -exponent));
                denominators.push((Polynomial::of(&variable), -exponent));
            }
            if !is_composite {
                return Self { numerator, denominators };
            }
            // A sum that was cleared from one term is now a factor of the others: multiply it out.
            numerator = Polynomial::of(&numerator.to_expr());
        }
    }

    fn in_lowest_terms(mut self) -> Self {
        let mut kept: Vec<(Polynomial, i32)> = Vec::new();
        while let Some((factor, power)) = self.denominators.pop() {
            if power == 0 || factor == Polynomial::one() {
                continue;
            }
            let common = common_factor(&self.numerator, &factor);
            if common == Polynomial::one() || self.numerator.is_zero() {
                kept.push((factor, power));
                continue;
            }
            let (Some(numerator), Some(rest)) =
                (divided(&self.numerator, &common), divided(&factor, &common))
            else {
                kept.push((factor, power));
                continue;
            };
            self.numerator = numerator;
            self.denominators.push((rest, 1));
            self.denominators.push((factor, power - 1));
        }
        Self { denominators: kept, ..self }
    }
}

/// The largest polynomial that divides both, its numbers without a common content.
fn common_factor(left: &Polynomial, right: &Polynomial) -> Polynomial {
    if left.is_zero() {
        return right.primitive().1;
    }
    if right.is_zero() {
        return left.primitive().1;
    }
    if let Some(common) = left.common_monomial(right).or_else(|| right.common_monomial(left)) {
        return common;
    }
    let right_variables = right.variables();
    let Some(variable) = left.variables().into_iter().find(|v| right_variables.contains(v)) else {
        return Polynomial::one();
    };
    let (left_content, left) = content_and_rest(left, &variable);
    let (right_content, right) = content_and_rest(right, &variable);
    let rest = common_factor_in(left, right, &variable);
    common_factor(&left_content, &right_content).times(&rest).primitive().1
}

/// Euclid's algorithm for polynomials whose coefficients in `variable` share no factor.
fn common_factor_in(left: Polynomial, right: Polynomial, variable: &Expr) -> Polynomial {
    let (mut larger, mut smaller) = (left, right);
    if larger.coefficients(variable).len() < smaller.coefficients(variable).len() {
        std::mem::swap(&mut larger, &mut smaller);
    }
    while !smaller.is_zero() {
        if smaller.coefficients(variable).len() == 1 {
            return Polynomial::one();
        }
        let remainder = pseudo_remainder(&larger, &smaller, variable);
        larger = smaller;
        smaller =
            if remainder.is_zero() { remainder } else { content_and_rest(&remainder, variable).1 };
    }
    larger
}

/// What all coefficients of `variable` have in common, and the polynomial without it.
fn content_and_rest(polynomial: &Polynomial, variable: &Expr) -> (Polynomial, Polynomial) {
    let coefficients = polynomial.coefficients(variable);
    let mut content = Polynomial::zero();
    for coefficient in coefficients.iter().filter(|coefficient| !coefficient.is_zero()) {
        content = common_factor(&content, coefficient);
        if content == Polynomial::one() {
            return (content, polynomial.primitive().1);
        }
    }
    let rest = divided(polynomial, &content).unwrap_or_else(|| polynomial.clone());
    (content, rest.primitive().1)
}

/// The remainder of a multiple of `larger` large enough that no fractions arise.
fn pseudo_remainder(larger: &Polynomial, smaller: &Polynomial, variable: &Expr) -> Polynomial {
    let divisor = smaller.coefficients(variable);
    let mut remainder = larger.clone();
    loop {
        let coefficients = remainder.coefficients(variable);
        if coefficients.len() < divisor.len() {
            return remainder;
        }
        let shift = (coefficients.len() - divisor.len()) as i32;
        let lead = coefficients[coefficients.len() - 1]
            .times(&Polynomial::variable_power(variable, shift));
        remainder = remainder.times(&divisor[divisor.len() - 1]).minus(&lead.times(smaller));
    }
}

/// The exact quotient, or nothing if `divisor` does not divide.
fn divided(dividend: &Polynomial, divisor: &Polynomial) -> Option<Polynomial> {
    let Some(variable) = divisor.variables().into_iter().next() else {
        let (number, _) = divisor.primitive();
        return (!divisor.is_zero()).then(|| dividend.scaled(number.reciprocal()));
    };
    let below = divisor.coefficients(&variable);
    let mut quotient = Polynomial::zero();
    let mut remainder = dividend.clone();
    while !remainder.is_zero() {
        let above = remainder.coefficients(&variable);
        let shift = above.len().checked_sub(below.len())? as i32;
        let lead = divided(above.last()?, below.last()?)?
            .times(&Polynomial::variable_power(&variable, shift));
        remainder = remainder.minus(&lead.times(divisor));
        quotient = quotient.plus(lead);
    }
    Some(quotient)
}
