//! LaTeX of an expression, with symbols or with a case's numbers in their place.
//!
//! Only commands that both MathJax and the converter to MathML know: `\frac`, `\sqrt`, `\sin`,
//! `\cos`, `\mathrm`, `\left( \right)`, `\cdot`, `\times`, and the symbols of the table. Hosts of Markdown
//! forbid some macros, `\operatorname` among them: none is used.

use super::{Expr, Symbol, Values};

impl Expr {
    /// The expression in LaTeX.
    pub fn to_latex(&self) -> String {
        Writer { values: &Values::default(), digits: 1 }.piece(self).text
    }

    /// The expression in LaTeX with numbers for the symbols that have values, to `digits`
    /// significant digits. `pi` remains a symbol, as do symbols without a value.
    pub fn to_latex_with(&self, values: &Values, digits: usize) -> String {
        Writer { values, digits }.piece(self).text
    }
}

/// A number in LaTeX to `digits` significant digits: decimal from a thousandth to a million,
/// scientific beyond.
pub fn format_number(number: f64, digits: usize) -> String {
    if number == 0.0 {
        return "0".to_owned();
    }
    if !number.is_finite() {
        let text = if number.is_nan() { r"\text{undefined}" } else { r"\infty" };
        return if number < 0.0 { format!("-{text}") } else { text.to_owned() };
    }
    let digits = digits.max(1);
    let scientific = format!("{number:.*e}", digits - 1);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if !(-3..6).contains(&exponent) {
        return format!(r"{mantissa}\times 10^{{{exponent}}}");
    }
    let decimals = usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0);
    format!("{number:.decimals$}")
}

/// What has to be known of a piece of LaTeX to put it next to others.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// A letter, a root or a function: stands by itself.
    Closed,
    /// A number without sign or power of ten.
    Number,
    /// Another number, factors side by side or a fraction: in parentheses as a base.
    Product,
    /// Terms with signs between them: in parentheses as a factor, too.
    Sum,
}

struct Piece {
    text: String,
    kind: Kind,
}

impl Piece {
    fn new(text: String, kind: Kind) -> Self {
        Self { text, kind }
    }

    fn is_negative(&self) -> bool {
        self.text.starts_with('-')
    }

    fn parenthesised_if(self, needed: bool) -> String {
        if needed { parenthesised(&self.text) } else { self.text }
    }
}

fn parenthesised(text: &str) -> String {
    format!(r"\left({text}\right)")
}

struct Writer<'a> {
    values: &'a Values,
    digits: usize,
}

impl Writer<'_> {
    fn piece(&self, expr: &Expr) -> Piece {
        match expr {
            Expr::Number(number) => Piece::new(number.to_string(), Kind::Number),
            Expr::Symbol(symbol) => self.symbol(*symbol),
            Expr::Negative(inner) => {
                let inner = self.piece(inner);
                let needed = inner.kind == Kind::Sum || inner.is_negative();
                Piece::new(format!("-{}", inner.parenthesised_if(needed)), Kind::Product)
            }
            Expr::Binary('/', sides) => {
                let below = self.piece(&sides[1]).text;
                if let Expr::Negative(above) = &sides[0] {
                    let text = format!(r"-\frac{{{}}}{{{below}}}", self.piece(above).text);
                    return Piece::new(text, Kind::Product);
                }
                let above = self.piece(&sides[0]);
                let (sign, above) = match above.text.strip_prefix('-') {
                    Some(rest) if above.kind != Kind::Sum => ("-", rest),
                    _ => ("", above.text.as_str()),
                };
                Piece::new(format!(r"{sign}\frac{{{above}}}{{{below}}}"), Kind::Product)
            }
            Expr::Binary('*', sides) => self.product(&sides[0], &sides[1]),
            Expr::Binary(sign, sides) => self.sum(*sign, &sides[0], &sides[1]),
            Expr::Function(function, arguments) => self.function(function, arguments),
        }
    }

    fn symbol(&self, symbol: Symbol) -> Piece {
        match self.values.get(symbol) {
            Some(value) if symbol != Symbol::PI => {
                let text = format_number(value, self.digits);
                let is_plain = text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
                Piece::new(text, if is_plain { Kind::Number } else { Kind::Product })
            }
            _ => Piece::new(symbol.entry().latex.to_owned(), Kind::Closed),
        }
    }

    /// A term that begins with a minus sign turns the sign before it.
    fn sum(&self, sign: char, left: &Expr, right: &Expr) -> Piece {
        let (left, right) = (self.piece(left).text, self.piece(right));
        let turned = if sign == '+' { '-' } else { '+' };
        let text = match right.text.strip_prefix('-') {
            Some(rest) if right.kind != Kind::Sum => format!("{left} {turned} {rest}"),
            _ => {
                let needed = right.kind == Kind::Sum && (sign == '-' || right.is_negative());
                format!("{left} {sign} {}", right.parenthesised_if(needed))
            }
        };
        Piece::new(text, Kind::Sum)
    }

    /// Factors side by side: sums, and later factors that begin with a sign, in parentheses; a dot
    /// before a number.
    fn product(&self, left: &Expr, right: &Expr) -> Piece {
        let (left, right) = (self.piece(left), self.piece(right));
        let digit = |c: char| c.is_ascii_digit();
        let mixed = left.text.ends_with(digit) && right.text.starts_with(r"\frac");
        let needed = right.kind == Kind::Sum || right.is_negative();
        let right = right.parenthesised_if(needed);
        let dot = if mixed || right.starts_with(digit) { r"\cdot " } else { "" };
        let needed = left.kind == Kind::Sum;
        Piece::new(format!("{} {dot}{right}", left.parenthesised_if(needed)), Kind::Product)
    }

    fn function(&self, name: &str, arguments: &[Expr]) -> Piece {
        match name {
            "square" => self.power(&arguments[0], 2),
            "cube" => self.power(&arguments[0], 3),
            "sin" | "cos" => self.angle_function(&format!(r"\{name}"), &arguments[0]),
            "sqrt" => {
                let text = format!(r"\sqrt{{{}}}", self.piece(&arguments[0]).text);
                Piece::new(text, Kind::Closed)
            }
            _ => {
                let all: Vec<String> = arguments.iter().map(|one| self.piece(one).text).collect();
                let text = format!(r"\mathrm{{{name}}}{}", parenthesised(&all.join(", ")));
                Piece::new(text, Kind::Closed)
            }
        }
    }

    fn angle_function(&self, name: &str, argument: &Expr) -> Piece {
        let angle = self.piece(argument);
        let needed = !matches!(argument, Expr::Symbol(_)) || angle.is_negative();
        Piece::new(format!("{name} {}", angle.parenthesised_if(needed)), Kind::Closed)
    }

    fn power(&self, base: &Expr, exponent: u32) -> Piece {
        match base {
            Expr::Function(name @ ("sin" | "cos"), angle) => {
                self.angle_function(&format!(r"\{name}^{{{exponent}}}"), &angle[0])
            }
            _ => {
                let base = self.piece(base);
                let kind = if base.kind == Kind::Number { Kind::Number } else { Kind::Closed };
                let needed = matches!(base.kind, Kind::Sum | Kind::Product);
                Piece::new(format!("{}^{{{exponent}}}", base.parenthesised_if(needed)), kind)
            }
        }
    }
}
