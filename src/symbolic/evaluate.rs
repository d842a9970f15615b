//! Numbers for symbols, and the value of an expression.
//!
//! The order of operations is part of the result: terms are added and factors multiplied from left
//! to right, a quotient is the product above the line over the product below it, and powers are
//! repeated products. [`Compiled`](super::Compiled) performs the very same operations.

use super::expr::Function;
use super::{Expr, MissingValue, Symbol};

/// A number for each symbol that has one; `pi` always has.
#[derive(Debug, Clone, PartialEq)]
pub struct Values {
    numbers: [Option<f64>; Symbol::COUNT],
}

impl Default for Values {
    fn default() -> Self {
        Self::new()
    }
}

impl Values {
    /// Only `pi`.
    pub fn new() -> Self {
        let mut numbers = [None; Symbol::COUNT];
        numbers[Symbol::Pi.index()] = Some(std::f64::consts::PI);
        Self { numbers }
    }

    /// The same values with one more, or another one.
    pub fn with(mut self, symbol: Symbol, number: f64) -> Self {
        self.set(symbol, number);
        self
    }

    /// Gives a symbol a number.
    pub fn set(&mut self, symbol: Symbol, number: f64) {
        self.numbers[symbol.index()] = Some(number);
    }

    /// The number of a symbol, if it has one.
    pub fn get(&self, symbol: Symbol) -> Option<f64> {
        self.numbers[symbol.index()]
    }

    /// The number of a symbol.
    ///
    /// # Errors
    /// If it has none.
    pub fn require(&self, symbol: Symbol) -> Result<f64, MissingValue> {
        self.get(symbol).ok_or(MissingValue { symbol })
    }
}

/// What carries out the operations of an expression: arithmetic, or the recording of a program.
pub(super) trait Machine {
    type Value: Copy;
    type Error;

    fn number(&mut self, number: f64) -> Self::Value;
    fn symbol(&mut self, symbol: Symbol) -> Result<Self::Value, Self::Error>;
    fn add(&mut self, left: Self::Value, right: Self::Value) -> Self::Value;
    fn multiply(&mut self, left: Self::Value, right: Self::Value) -> Self::Value;
    fn divide(&mut self, above: Self::Value, below: Self::Value) -> Self::Value;
    fn function(&mut self, function: Function, argument: Self::Value) -> Self::Value;
}

/// Performs the operations of an expression in their one fixed order.
pub(super) fn perform<M: Machine>(machine: &mut M, expr: &Expr) -> Result<M::Value, M::Error> {
    match expr {
        Expr::Symbol(symbol) => machine.symbol(*symbol),
        Expr::Function(function, argument) => {
            let argument = perform(machine, argument)?;
            Ok(machine.function(*function, argument))
        }
        Expr::Sum(terms) => {
            let mut sum = perform(machine, &terms[0])?;
            for term in &terms[1..] {
                let term = perform(machine, term)?;
                sum = machine.add(sum, term);
            }
            Ok(sum)
        }
        Expr::Product(factors) => perform_product(machine, factors),
        Expr::Number(_) | Expr::Power(..) => perform_product(machine, std::slice::from_ref(expr)),
    }
}

fn perform_product<M: Machine>(machine: &mut M, factors: &[Expr]) -> Result<M::Value, M::Error> {
    let (mut above, mut below) = (None, None);
    for factor in factors {
        match factor {
            Expr::Number(number) => {
                let numerator = machine.number(number.numerator() as f64);
                extend(machine, &mut above, numerator);
                if number.denominator() != 1 {
                    let denominator = machine.number(number.denominator() as f64);
                    extend(machine, &mut below, denominator);
                }
            }
            Expr::Power(base, exponent) => {
                let base = perform(machine, base)?;
                let size = exponent.unsigned_abs();
                let power = (1..size).fold(base, |power, _| machine.multiply(power, base));
                extend(machine, if *exponent > 0 { &mut above } else { &mut below }, power);
            }
            other => {
                let value = perform(machine, other)?;
                extend(machine, &mut above, value);
            }
        }
    }
    let above = above.unwrap_or_else(|| machine.number(1.0));
    Ok(below.map_or(above, |below| machine.divide(above, below)))
}

fn extend<M: Machine>(machine: &mut M, product: &mut Option<M::Value>, factor: M::Value) {
    *product = Some(match *product {
        Some(product) => machine.multiply(product, factor),
        None => factor,
    });
}

/// Applies a function to a number.
pub(super) fn apply(function: Function, argument: f64) -> f64 {
    match function {
        Function::Sqrt => libm::sqrt(argument),
        Function::Sin => libm::sin(argument),
        Function::Cos => libm::cos(argument),
    }
}

struct Arithmetic<'a>(&'a Values);

impl Machine for Arithmetic<'_> {
    type Value = f64;
    type Error = MissingValue;

    fn number(&mut self, number: f64) -> f64 {
        number
    }

    fn symbol(&mut self, symbol: Symbol) -> Result<f64, MissingValue> {
        self.0.require(symbol)
    }

    fn add(&mut self, left: f64, right: f64) -> f64 {
        left + right
    }

    fn multiply(&mut self, left: f64, right: f64) -> f64 {
        left * right
    }

    fn divide(&mut self, above: f64, below: f64) -> f64 {
        above / below
    }

    fn function(&mut self, function: Function, argument: f64) -> f64 {
        apply(function, argument)
    }
}

impl Expr {
    /// The value of the expression. What floating point cannot say is infinite or not a number.
    ///
    /// # Errors
    /// If a symbol has no value; the error names it.
    pub fn evaluate(&self, values: &Values) -> Result<f64, MissingValue> {
        perform(&mut Arithmetic(values), self)
    }
}
