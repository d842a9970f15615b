//! Equations that are written once: as code that is evaluated, and as the same text, typeset.
//!
//! `equations!` takes an equation's right side as an ordinary Rust
//! expression. The compiler makes a function of it; its text is read again ([`Expr`]) where it is
//! printed, with symbols or with a case's numbers. So what is printed is what is evaluated, operation by
//! operation, and evaluating costs what the expression costs. Nothing here rearranges an expression: what
//! follows from the paper's equations is derived by hand and proven by the tests, against those equations.
//!
//! For the program itself: this module may change at any time.

mod equation;
mod expr;
mod latex;
mod symbol;
mod values;

#[doc(hidden)]
pub use equation::equations;
pub use equation::{Equation, Formula, Group, operations};
pub use expr::{Expr, atan2, cos, cube, ln, sin, sqrt, square};
pub use latex::format_number;
pub use symbol::{Symbol, SymbolEntry};
pub use values::{MissingValue, Values};
