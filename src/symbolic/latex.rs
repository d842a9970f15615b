//! LaTeX of an expression, with symbols or with a case's numbers in their place.
//!
//! Only commands that both MathJax and the converter to MathML know: `\frac`, `\sqrt`, `\sin`,
//! `\cos`, `\left( \right)`, `\cdot`, `\times`, and the symbols of the table. Hosts of Markdown
//! forbid some macros, `\operatorname` among them: none is used.

use super::expr::Function;
use super::{Expr, Symbol, Values};

impl Expr {
    /// The expression in LaTeX.
    pub fn to_latex(&self) -> String {
        Writer { values: None, digits: 0 }.expression(self)
    }

    /// The expression in LaTeX with numbers for the symbols that have values, to `digits`
    /// significant digits. `pi` remains a symbol, as do symbols without a value.
    pub fn to_latex_with(&self, values: &Values, digits: usize) -> String {
        Writer { values: Some(values), digits }.expression(self)
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

/// A piece of LaTeX and what has to be known to put it next to others.
struct Piece {
    text: String,
    kind: Kind,
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// A letter, a command or a group that stands by itself.
    Closed,
    /// A number without sign or power of ten.
    Plain,
    /// A number that needs parentheses as a base or a later factor.
    Awkward,
    /// Terms with signs between them.
    Open,
}

struct Writer<'a> {
    values: Option<&'a Values>,
    digits: usize,
}

impl Writer<'_> {
    fn expression(&self, expr: &Expr) -> String {
        match expr {
            Expr::Sum(terms) => self.sum(terms),
            Expr::Product(factors) => self.product(factors),
            Expr::Number(_) => self.product(std::slice::from_ref(expr)),
            Expr::Power(_, exponent) if *exponent < 0 => self.product(std::slice::from_ref(expr)),
            other => self.factor(other).text,
        }
    }

    fn sum(&self, terms: &[Expr]) -> String {
        let mut text = String::new();
        for term in terms {
            let term = self.expression(term);
            match term.strip_prefix('-') {
                Some(rest) if text.is_empty() => text = format!("-{}", rest.trim_start()),
                Some(rest) => text.push_str(&format!(" - {}", rest.trim_start())),
                None if text.is_empty() => text = term,
                None => text.push_str(&format!(" + {term}")),
            }
        }
        text
    }

    /// A product: constants as one fraction in front, unless other factors are below the line too.
    fn product(&self, factors: &[Expr]) -> String {
        let is_constant = |expr: &Expr| match expr {
            Expr::Number(_) | Expr::Symbol(Symbol::Pi) => true,
            Expr::Power(base, _) => **base == Expr::Symbol(Symbol::Pi),
            _ => false,
        };
        let negative = matches!(&factors[0], Expr::Number(number) if number.is_negative());
        let is_below = |expr: &&Expr| matches!(expr, Expr::Power(_, exponent) if *exponent < 0);
        let one_line = factors.iter().filter(is_below).all(is_constant);
        let (constants, others): (Vec<&Expr>, Vec<&Expr>) =
            factors.iter().partition(|factor| one_line && is_constant(factor));
        let front = self.quotient(&constants);
        let back = self.quotient(&others);
        let text = match (front, back) {
            (Some(front), Some(back)) => juxtapose(vec![front, back]),
            (Some(piece), None) | (None, Some(piece)) => piece.text,
            (None, None) => "1".to_owned(),
        };
        if !negative {
            text
        } else if text.starts_with('-') {
            format!(r"-\left({text}\right)")
        } else {
            format!("-{text}")
        }
    }

    /// Factors over factors; the sign is left to the caller. Nothing for the factor 1.
    fn quotient(&self, factors: &[&Expr]) -> Option<Piece> {
        let (mut above, mut below) = (Vec::new(), Vec::new());
        for factor in factors {
            match factor {
                Expr::Number(number) => {
                    let size = number.abs();
                    if size.numerator() != 1 {
                        above.push(plain(size.numerator()));
                    }
                    if size.denominator() != 1 {
                        below.push(plain(size.denominator()));
                    }
                }
                Expr::Power(base, exponent) if *exponent < 0 => {
                    below.push(self.power(base, -exponent));
                }
                other => above.push(self.factor(other)),
            }
        }
        if below.is_empty() {
            return match above.len() {
                0 => None,
                1 => above.pop(),
                _ => Some(Piece { kind: leading_kind(&above), text: juxtapose(above) }),
            };
        }
        let above = if above.is_empty() { "1".to_owned() } else { alone_or_juxtaposed(above) };
        let below = alone_or_juxtaposed(below);
        Some(Piece { text: format!(r"\frac{{{above}}}{{{below}}}"), kind: Kind::Closed })
    }

    fn factor(&self, expr: &Expr) -> Piece {
        match expr {
            Expr::Number(_) | Expr::Product(_) | Expr::Sum(_) => {
                Piece { text: self.expression(expr), kind: Kind::Open }
            }
            Expr::Symbol(symbol) => self.symbol(*symbol),
            Expr::Power(base, exponent) => self.power(base, *exponent),
            Expr::Function(function, argument) => self.function(*function, argument, 1),
        }
    }

    fn symbol(&self, symbol: Symbol) -> Piece {
        let value = self.values.and_then(|values| values.get(symbol));
        match value {
            Some(value) if symbol != Symbol::Pi => {
                let text = format_number(value, self.digits);
                let is_plain = text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
                Piece { text, kind: if is_plain { Kind::Plain } else { Kind::Awkward } }
            }
            _ => Piece { text: symbol.entry().latex.to_owned(), kind: Kind::Closed },
        }
    }

    fn power(&self, base: &Expr, exponent: i32) -> Piece {
        if exponent == 1 {
            return self.factor(base);
        }
        if let Expr::Function(function @ (Function::Sin | Function::Cos), argument) = base {
            return self.function(*function, argument, exponent);
        }
        let base = self.factor(base);
        let kind = if base.kind == Kind::Plain { Kind::Plain } else { Kind::Closed };
        let base = match base.kind {
            Kind::Closed | Kind::Plain => base.text,
            Kind::Awkward | Kind::Open => parenthesised(&base.text),
        };
        Piece { text: format!("{base}^{{{exponent}}}"), kind }
    }

    fn function(&self, function: Function, argument: &Expr, exponent: i32) -> Piece {
        let text = self.expression(argument);
        let name = match function {
            Function::Sqrt => {
                return Piece { text: format!(r"\sqrt{{{text}}}"), kind: Kind::Closed };
            }
            Function::Sin => r"\sin",
            Function::Cos => r"\cos",
        };
        let power = if exponent == 1 { String::new() } else { format!("^{{{exponent}}}") };
        let is_symbol = matches!(argument, Expr::Symbol(_)) && !text.starts_with('-');
        let argument = if is_symbol { text } else { parenthesised(&text) };
        Piece { text: format!("{name}{power} {argument}"), kind: Kind::Closed }
    }
}

fn plain(number: i128) -> Piece {
    Piece { text: number.to_string(), kind: Kind::Plain }
}

fn parenthesised(text: &str) -> String {
    format!(r"\left({text}\right)")
}

fn leading_kind(pieces: &[Piece]) -> Kind {
    match pieces[0].kind {
        Kind::Awkward if !pieces[0].text.starts_with('-') => Kind::Plain,
        Kind::Awkward | Kind::Open => Kind::Closed,
        kind => kind,
    }
}

fn alone_or_juxtaposed(mut pieces: Vec<Piece>) -> String {
    if pieces.len() == 1 { pieces.remove(0).text } else { juxtapose(pieces) }
}

/// Factors side by side: sums and negative numbers in parentheses, a dot before a number.
fn juxtapose(pieces: Vec<Piece>) -> String {
    let mut text = String::new();
    for piece in pieces {
        let is_number = matches!(piece.kind, Kind::Plain | Kind::Awkward);
        let dotted = is_number && !text.is_empty();
        let negative = piece.kind == Kind::Awkward && piece.text.starts_with('-');
        let piece = if piece.kind == Kind::Open || negative {
            parenthesised(&piece.text)
        } else {
            piece.text
        };
        let separator = match (text.is_empty(), dotted) {
            (true, _) => "",
            (false, true) => r" \cdot ",
            (false, false) => " ",
        };
        text.push_str(separator);
        text.push_str(&piece);
    }
    text
}
