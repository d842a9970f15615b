//! An equation with the name and number it is known by, and where it comes from.

use super::{Expr, Values};

/// Two sides that are equal.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Equation {
    /// The number in the paper, such as `(16)`.
    pub number: Option<&'static str>,
    /// What it states, as a title.
    pub name: &'static str,
    /// The left side.
    pub left: Expr,
    /// The right side.
    pub right: Expr,
    /// Where it comes from and where it holds.
    pub source: &'static str,
}

impl Equation {
    /// Left less right: the expression that vanishes.
    pub fn residual(&self) -> Expr {
        &self.left - &self.right
    }

    /// Both sides in LaTeX.
    pub fn to_latex(&self) -> String {
        format!("{} = {}", self.left.to_latex(), self.right.to_latex())
    }

    /// The equation with numbers put in on the right, to `digits` significant digits.
    pub fn to_latex_with(&self, values: &Values, digits: usize) -> String {
        format!("{} = {}", self.left.to_latex(), self.right.to_latex_with(values, digits))
    }
}
