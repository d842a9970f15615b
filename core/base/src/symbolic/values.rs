//! Numbers for symbols.

use super::Symbol;

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
        self.set(symbol, number);
        self
    }

    pub(super) fn set(&mut self, symbol: Symbol, number: f64) {
        self.0[symbol as usize] = Some(number);
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
}
