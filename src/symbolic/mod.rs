//! Expressions with named symbols: stated once, transformed, differentiated, evaluated, printed.
//!
//! This is no computer-algebra system. It knows rational functions, square roots, sines and
//! cosines, and the steps of algebra that the paper's equations need: substitution, multiplying
//! out, collecting powers, linear equations, derivatives, `sin^2 + cos^2 = 1`. What is evaluated
//! is what is printed: values and LaTeX come from the same [`Expr`].

mod calculus;
mod compiled;
mod equation;
mod error;
mod evaluate;
mod expr;
mod latex;
mod mathml;
mod operators;
mod polynomial;
mod quotient;
mod rational;
mod symbol;

pub use calculus::eliminate_angle;
pub use compiled::{CAPACITY, Compiled};
pub use equation::Equation;
pub use error::{AlgebraError, MissingValue};
pub use evaluate::Values;
pub use expr::{Expr, Function, cos, fraction, sin, sqrt};
pub use latex::format_number;
pub use mathml::{MathError, to_mathml};
pub use rational::Rational;
pub use symbol::{Symbol, SymbolEntry};
