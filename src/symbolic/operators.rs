//! Operators, so that an equation in the code reads like the equation on paper.
//!
//! Expressions, symbols and whole numbers mix freely: `2 * b * B`, `(1 + r) * sin(Theta)`.

use super::{Expr, Rational, Symbol};
use std::ops::{Add, Div, Mul, Neg, Sub};

impl From<i32> for Expr {
    fn from(value: i32) -> Self {
        Expr::Number(value.into())
    }
}

impl From<Symbol> for Expr {
    fn from(symbol: Symbol) -> Self {
        Expr::Symbol(symbol)
    }
}

impl From<Rational> for Expr {
    fn from(number: Rational) -> Self {
        Expr::Number(number)
    }
}

impl From<&Expr> for Expr {
    fn from(expression: &Expr) -> Self {
        expression.clone()
    }
}

fn add(left: Expr, right: Expr) -> Expr {
    Expr::sum([left, right])
}

fn subtract(left: Expr, right: Expr) -> Expr {
    Expr::sum([left, negate(right)])
}

fn multiply(left: Expr, right: Expr) -> Expr {
    Expr::product([left, right])
}

fn divide(left: Expr, right: Expr) -> Expr {
    Expr::product([left, right.power(-1)])
}

fn negate(expression: Expr) -> Expr {
    expression.scaled(Rational::MINUS_ONE)
}

macro_rules! operator {
    ($trait:ident, $method:ident, $function:ident) => {
        operator!($trait, $method, $function, Expr);
        operator!($trait, $method, $function, &Expr);
        operator!($trait, $method, $function, Symbol);
        operator!($trait, $method, $function, number Expr);
        operator!($trait, $method, $function, number &Expr);
        operator!($trait, $method, $function, number Symbol);
    };
    ($trait:ident, $method:ident, $function:ident, number $right:ty) => {
        impl $trait<$right> for i32 {
            type Output = Expr;

            fn $method(self, right: $right) -> Expr {
                $function(self.into(), right.into())
            }
        }
    };
    ($trait:ident, $method:ident, $function:ident, $left:ty) => {
        impl<T: Into<Expr>> $trait<T> for $left {
            type Output = Expr;

            fn $method(self, right: T) -> Expr {
                $function(self.into(), right.into())
            }
        }
    };
}

operator!(Add, add, add);
operator!(Sub, sub, subtract);
operator!(Mul, mul, multiply);
operator!(Div, div, divide);

macro_rules! negation {
    ($($operand:ty),*) => {$(
        impl Neg for $operand {
            type Output = Expr;

            fn neg(self) -> Expr {
                negate(self.into())
            }
        }
    )*};
}

negation!(Expr, &Expr, Symbol);

impl Symbol {
    /// An integer power of the symbol.
    pub fn power(self, exponent: i32) -> Expr {
        Expr::from(self).power(exponent)
    }

    /// The square of the symbol.
    pub fn squared(self) -> Expr {
        self.power(2)
    }
}
