//! LaTeX of an expression, with symbols or with a case's numbers in their place.
//!
//! Only commands that both MathJax and the converter to MathML know: `\frac`, `\sqrt`, `\sin`,
//! `\cos`, `\mathrm`, `\left( \right)`, `\cdot`, `\times`, and the symbols of the table. Hosts of Markdown
//! forbid some macros, `\operatorname` among them: none is used.

use super::{Expr, Symbol, Values};

impl Expr {
    /// The expression in LaTeX.
    pub fn to_latex(&self) -> String {
        TexWriter { values: &Values::default(), digits: 1 }.piece(self).text
    }

    /// The expression in LaTeX with numbers for the symbols that have values, to `digits`
    /// significant digits. `pi` remains a symbol, as do symbols without a value.
    pub fn to_latex_with(&self, values: &Values, digits: usize) -> String {
        TexWriter { values, digits }.piece(self).text
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
enum TexKind {
    /// A letter, a root or a function: stands by itself.
    Closed,
    /// A number without sign or power of ten.
    Number,
    /// Another number, factors side by side or a fraction: in parentheses as a base.
    Product,
    /// Terms with signs between them: in parentheses as a factor, too.
    Sum,
}

struct TexPiece {
    text: String,
    kind: TexKind,
}

impl TexPiece {
    fn new(text: String, kind: TexKind) -> Self {
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

struct TexWriter<'a> {
    values: &'a Values,
    digits: usize,
}

impl TexWriter<'_> {
    fn piece(&self, expr: &Expr) -> TexPiece {
        match expr {
            Expr::Number(number) => TexPiece::new(number.to_string(), TexKind::Number),
            Expr::Symbol(symbol) => self.symbol(*symbol),
            Expr::Negative(inner) => {
                let inner = self.piece(inner);
                let needed = inner.kind == TexKind::Sum || inner.is_negative();
                TexPiece::new(format!("-{}", inner.parenthesised_if(needed)), TexKind::Product)
            }
            Expr::Binary('/', sides) => {
                let below = self.piece(&sides[1]).text;
                if let Expr::Negative(above) = &sides[0] {
                    let text = format!(r"-\frac{{{}}}{{{below}}}", self.piece(above).text);
                    return TexPiece::new(text, TexKind::Product);
                }
                let above = self.piece(&sides[0]);
                let (sign, above) = match above.text.strip_prefix('-') {
                    Some(rest) if above.kind != TexKind::Sum => ("-", rest),
                    _ => ("", above.text.as_str()),
                };
                TexPiece::new(format!(r"{sign}\frac{{{above}}}{{{below}}}"), TexKind::Product)
            }
            Expr::Binary('*', sides) => self.product(&sides[0], &sides[1]),
            Expr::Binary(sign, sides) => self.sum(*sign, &sides[0], &sides[1]),
            Expr::Function(function, arguments) => self.function(function, arguments),
        }
    }

    fn symbol(&self, symbol: Symbol) -> TexPiece {
        match self.values.get(symbol) {
            Some(value) if symbol != Symbol::PI => {
                let text = format_number(value, self.digits);
                let is_plain = text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
                TexPiece::new(text, if is_plain { TexKind::Number } else { TexKind::Product })
            }
            _ => TexPiece::new(symbol.entry().latex.to_owned(), TexKind::Closed),
        }
    }

    /// A term that begins with a minus sign turns the sign before it.
    fn sum(&self, sign: char, left: &Expr, right: &Expr) -> TexPiece {
        let (left, right) = (self.piece(left).text, self.piece(right));
        let turned = if sign == '+' { '-' } else { '+' };
        let text = match right.text.strip_prefix('-') {
            Some(rest) if right.kind != TexKind::Sum => format!("{left} {turned} {rest}"),
            _ => {
                let needed = right.kind == TexKind::Sum && (sign == '-' || right.is_negative());
                format!("{left} {sign} {}", right.parenthesised_if(needed))
            }
        };
        TexPiece::new(text, TexKind::Sum)
    }

    /// Factors side by side: sums, and later factors that begin with a sign, in parentheses; a dot
    /// before a number.
    fn product(&self, left: &Expr, right: &Expr) -> TexPiece {
        let (left, right) = (self.piece(left), self.piece(right));
        let digit = |c: char| c.is_ascii_digit();
        let mixed = left.text.ends_with(digit) && right.text.starts_with(r"\frac");
        let needed = right.kind == TexKind::Sum || right.is_negative();
        let right = right.parenthesised_if(needed);
        let dot = if mixed || right.starts_with(digit) { r"\cdot " } else { "" };
        let needed = left.kind == TexKind::Sum;
        TexPiece::new(format!("{} {dot}{right}", left.parenthesised_if(needed)), TexKind::Product)
    }

    fn function(&self, name: &str, arguments: &[Expr]) -> TexPiece {
        match name {
            "square" => self.power(&arguments[0], 2),
            "cube" => self.power(&arguments[0], 3),
            "sin" | "cos" => self.angle_function(&format!(r"\{name}"), &arguments[0]),
            "sqrt" => {
                let text = format!(r"\sqrt{{{}}}", self.piece(&arguments[0]).text);
                TexPiece::new(text, TexKind::Closed)
            }
            _ => {
                let all: Vec<String> = arguments.iter().map(|one| self.piece(one).text).collect();
                let text = format!(r"\mathrm{{{name}}}{}", parenthesised(&all.join(", ")));
                TexPiece::new(text, TexKind::Closed)
            }
        }
    }

    fn angle_function(&self, name: &str, argument: &Expr) -> TexPiece {
        let angle = self.piece(argument);
        let needed = !matches!(argument, Expr::Symbol(_)) || angle.is_negative();
        TexPiece::new(format!("{name} {}", angle.parenthesised_if(needed)), TexKind::Closed)
    }

    fn power(&self, base: &Expr, exponent: u32) -> TexPiece {
        match base {
            Expr::Function(name @ ("sin" | "cos"), angle) => {
                self.angle_function(&format!(r"\{name}^{{{exponent}}}"), &angle[0])
            }
            _ => {
                let base = self.piece(base);
                let kind =
                    if base.kind == TexKind::Number { TexKind::Number } else { TexKind::Closed };
                let needed = matches!(base.kind, TexKind::Sum | TexKind::Product);
                TexPiece::new(format!("{}^{{{exponent}}}", base.parenthesised_if(needed)), kind)
            }
        }
    }
}
