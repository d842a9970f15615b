//! Numbers for symbols.

use super::{Expr, Group, Symbol};

/// An expression cannot be evaluated because one of its symbols has no value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("`{}` ({}) has no value; set it before evaluating", .symbol, .symbol.entry().description)]
pub struct MissingValue {
    /// The first symbol without a value, in the order of the expression.
    pub symbol: Symbol,
}

/// A number for each symbol that has one; `pi` always has.
#[derive(Debug, Clone, PartialEq)]
pub struct Values([Option<f64>; Symbol::ALL.len()]);

impl Default for Values {
    fn default() -> Self {
        Self([None; Symbol::ALL.len()]).with(Symbol::PI, std::f64::consts::PI)
    }
}

impl Values {
    /// The same values with one more, or another one.
    pub fn with(mut self, symbol: Symbol, number: f64) -> Self {
        self.0[symbol as usize] = Some(number);
        self
    }

    /// The number of a symbol, if it has one.
    pub fn get(&self, symbol: Symbol) -> Option<f64> {
        self.0[symbol as usize]
    }

    /// The number of a symbol.
    ///
    /// # Errors
    /// If it has none.
    pub fn require(&self, symbol: Symbol) -> Result<f64, MissingValue> {
        self.get(symbol).ok_or(MissingValue { symbol })
    }

    /// The same values with all that follow from them: a symbol that is the left side of an equation
    /// and has no value gets that of the right side, once it is a finite number.
    pub fn completed<'a>(mut self, groups: impl IntoIterator<Item = &'a Group>) -> Self {
        let all = groups.into_iter().flat_map(|group| group.equations);
        let mut open: Vec<_> = all.map(|equation| (equation.left(), equation.right())).collect();
        loop {
            let before = open.len();
            open.retain(|(left, right)| {
                let Expr::Symbol(symbol) = *left else { return false };
                match right.evaluate(&self) {
                    Ok(value) if self.get(symbol).is_none() && value.is_finite() => {
                        self.0[symbol as usize] = Some(value);
                        false
                    }
                    Ok(_) => false,
                    Err(_) => true,
                }
            });
            if open.len() == before {
                return self;
            }
        }
    }
}
