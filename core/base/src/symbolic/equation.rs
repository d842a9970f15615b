//! Equations, and the macro that writes each of them once.

use super::{Expr, Symbol, Values};
use crate::operation_count::{self, ELEMENTARY};

/// An equation as its two sides were written in the code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Equation {
    /// The left side: a symbol that gets a value, or more where the equation is a condition.
    pub left_text: &'static str,
    /// The right side.
    pub right_text: &'static str,
}

impl Equation {
    /// The left side.
    pub fn left(&self) -> Expr {
        Expr::parse(self.left_text)
    }

    /// The right side.
    pub fn right(&self) -> Expr {
        Expr::parse(self.right_text)
    }

    /// Both sides in LaTeX.
    pub fn to_latex(&self) -> String {
        format!("{} = {}", self.left().to_latex(), self.right().to_latex())
    }

    /// The equation with numbers put in, and the value of the right side where all of its symbols have
    /// numbers. The general form where that value is none.
    pub fn to_latex_with(&self, values: &Values, digits: usize) -> String {
        let (left, right) = (self.left(), self.right());
        let left = match left {
            Expr::Symbol(_) => left.to_latex(),
            _ => left.to_latex_with(values, digits),
        };
        let formula = right.to_latex_with(values, digits);
        match right.evaluate(values) {
            Ok(value) if value.is_nan() => self.to_latex(),
            Ok(value) if !matches!(right, Expr::Number(_)) => {
                let value = super::format_number(value, digits);
                if value == formula {
                    format!("{left} = {value}")
                } else {
                    format!("{left} = {formula} = {value}")
                }
            }
            _ => format!("{left} = {formula}"),
        }
    }
}

/// An equation whose right side is evaluated.
#[derive(Debug, Clone, Copy)]
pub struct Formula<const N: usize> {
    /// As it is printed.
    pub equation: Equation,
    /// What the right side depends on.
    pub parameters: [Symbol; N],
    /// The right side as compiled code.
    pub function: fn([f64; N]) -> f64,
    /// Operations of one evaluation, as [`operation_count`] counts them.
    pub cost: u64,
}

impl<const N: usize> Formula<N> {
    /// The right side for values of the parameters, in their order.
    #[inline]
    pub fn at(&self, values: [f64; N]) -> f64 {
        operation_count::note(self.cost);
        (self.function)(values)
    }
}

/// Equations under one title.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Group {
    /// The title.
    pub title: &'static str,
    /// What they are for.
    pub gives: &'static str,
    /// Where they come from, with the paper's number if they have one, and where they hold.
    pub source: &'static str,
    /// In reading order.
    pub equations: &'static [&'static Equation],
}

/// Operations in the text of an expression, as [`operation_count`] counts them: one for each sign and
/// root, [`ELEMENTARY`] for each sine, cosine, logarithm and arctangent.
pub const fn operations(text: &str) -> u64 {
    let text = text.as_bytes();
    let (mut count, mut place) = (0, 0);
    while place < text.len() {
        let opens = place + 1 < text.len() && text[place + 1] == b'(';
        count += match text[place] {
            b'+' | b'-' | b'*' | b'/' => 1,
            // `sqrt(`, `square(`; `cube(` is one more; `sin(`, `ln(`, `cos(`; `atan2(`.
            b't' | b'e' if opens => 1,
            b'n' | b's' | b'2' if opens => ELEMENTARY,
            _ => 0,
        };
        place += 1;
    }
    count
}

/// Declares [`Formula`]s, each `NAME(parameters): [left] = right;`, in groups of `"title", "what they
/// give", source { ... }`, and a list of these groups. Parameters are symbols, the right side is Rust over
/// `f64` with `PI` and the functions of [`crate::symbolic`].
#[doc(hidden)]
#[macro_export]
macro_rules! declared_equations {
    ($(#[$list_doc:meta])* $list:ident = $($title:literal, $gives:literal, $source:expr => {
        $($name:ident($($symbol:ident),*): [$($left:tt)*] = $right:expr;)+
    })+) => {
        $($(
            #[doc = concat!($title, ": ", $gives, ".\n\n`", stringify!($($left)*), " = ", stringify!($right), "`")]
            pub static $name: $crate::symbolic::Formula<
                { <[$crate::symbolic::Symbol]>::len(&[$($crate::symbolic::Symbol::$symbol),*]) },
            > = $crate::symbolic::Formula {
                equation: $crate::symbolic::Equation {
                    left_text: stringify!($($left)*),
                    right_text: stringify!($right),
                },
                parameters: [$($crate::symbolic::Symbol::$symbol),*],
                function: |[$($symbol),*]| $right,
                cost: $crate::symbolic::operations(stringify!($right)),
            };
        )+)+
        $(#[$list_doc])*
        pub static $list: &[$crate::symbolic::Group] = &[$($crate::symbolic::Group {
            title: $title,
            gives: $gives,
            source: $source,
            equations: &[$(&$name.equation),+],
        }),+];
    };
}
// A macro for other crates stands at the root, where `equations` is a room.
#[doc(hidden)]
pub use declared_equations as equations;

impl Values {
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
                        self.set(symbol, value);
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
