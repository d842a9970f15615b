//! What can be asked of an expression in vain.

use super::Symbol;

/// A step of algebra that does not apply to the expression it was asked of.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum AlgebraError {
    /// Coefficients were asked for in something that the expression is no polynomial of.
    #[error("`{expression}` is not a polynomial in `{variable}`; clear its denominators first")]
    NotPolynomial {
        /// In LaTeX.
        expression: String,
        /// In LaTeX.
        variable: String,
    },
    /// A solution was asked for, but the degree is not 1.
    #[error("`{expression}` has degree {degree} in `{variable}`; only degree 1 can be solved for")]
    NotLinear {
        /// In LaTeX.
        expression: String,
        /// In LaTeX.
        variable: String,
        /// The degree that was found.
        degree: usize,
    },
}

/// An expression cannot be evaluated because one of its symbols has no value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("`{}` ({}) has no value; set it before evaluating", .symbol, .symbol.entry().description)]
pub struct MissingValue {
    /// The first symbol without a value, in the order of the expression.
    pub symbol: Symbol,
}
