//! An expression as it was written, to be typeset, and evaluated where numbers are put in for a reader.

use super::{MissingValue, Symbol, Values};

/// A function with its name; it reads its arguments in order.
type Named = (&'static str, fn(&[f64]) -> f64);

/// The functions of expressions.
const FUNCTIONS: [Named; 7] = [
    ("sqrt", |x| sqrt(x[0])),
    ("sin", |x| sin(x[0])),
    ("cos", |x| cos(x[0])),
    ("square", |x| square(x[0])),
    ("cube", |x| cube(x[0])),
    ("ln", |x| ln(x[0])),
    ("atan2", |x| atan2(x[0], x[1])),
];

/// Square root.
pub fn sqrt(x: f64) -> f64 {
    x.sqrt()
}

/// Sine of an angle in radians.
pub fn sin(x: f64) -> f64 {
    libm::sin(x)
}

/// Cosine of an angle in radians.
pub fn cos(x: f64) -> f64 {
    libm::cos(x)
}

/// The second power.
pub fn square(x: f64) -> f64 {
    x * x
}

/// The third power.
pub fn cube(x: f64) -> f64 {
    x * x * x
}

/// Natural logarithm.
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// The angle from -pi to pi whose sine and cosine are as `y` and `x`.
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// An expression, operation by operation.
#[derive(Debug, Clone, PartialEq)]
pub enum Expr {
    /// A number.
    Number(f64),
    /// A named quantity.
    Symbol(Symbol),
    /// What follows a minus sign.
    Negative(Box<Expr>),
    /// One of `+ - * /` between two expressions.
    Binary(char, Box<[Expr; 2]>),
    /// A function of expressions, by its name in Rust, and its arguments.
    Function(&'static str, Vec<Expr>),
}

impl Expr {
    /// Reads an expression of Rust.
    ///
    /// # Panics
    /// For a symbol that is not in the table, and for more of Rust than expressions need. The texts are
    /// constants of the program, all of which a test reads.
    pub fn parse(text: &str) -> Self {
        let mut reader = ExpressionReader { text, rest: text.trim_start() };
        let expr = reader.sum();
        if reader.rest.is_empty() { expr } else { reader.fail("an operator") }
    }

    /// The value, by the operations of the compiled expression in their order. What floating point
    /// cannot say is infinite or not a number.
    ///
    /// # Errors
    /// If a symbol has no value; the error names it.
    pub fn evaluate(&self, values: &Values) -> Result<f64, MissingValue> {
        Ok(match self {
            Self::Number(number) => *number,
            Self::Symbol(symbol) => values.require(*symbol)?,
            Self::Negative(inner) => -inner.evaluate(values)?,
            Self::Binary(sign, sides) => {
                let (left, right) = (sides[0].evaluate(values)?, sides[1].evaluate(values)?);
                match sign {
                    '+' => left + right,
                    '-' => left - right,
                    '*' => left * right,
                    _ => left / right,
                }
            }
            Self::Function(name, arguments) => {
                let arguments: Vec<f64> = arguments
                    .iter()
                    .map(|argument| argument.evaluate(values))
                    .collect::<Result<_, _>>()?;
                let known = FUNCTIONS.iter().find(|(known, _)| known == name);
                known.map_or(f64::NAN, |(_, function)| function(&arguments))
            }
        })
    }
}

/// Reads by descent: a sum of products of signed atoms, each from left to right, as Rust does.
struct ExpressionReader<'a> {
    text: &'a str,
    rest: &'a str,
}

impl ExpressionReader<'_> {
    fn fail(&self, expected: &str) -> ! {
        panic!("`{}`: expected {expected} before `{}`", self.text, self.rest)
    }

    fn take(&mut self, signs: &[char]) -> Option<char> {
        let sign = self.rest.chars().next().filter(|sign| signs.contains(sign))?;
        self.rest = self.rest[1..].trim_start();
        Some(sign)
    }

    fn chain(&mut self, signs: &[char], part: fn(&mut Self) -> Expr) -> Expr {
        let mut expr = part(self);
        while let Some(sign) = self.take(signs) {
            expr = Expr::Binary(sign, Box::new([expr, part(self)]));
        }
        expr
    }

    fn sum(&mut self) -> Expr {
        self.chain(&['+', '-'], Self::product)
    }

    fn product(&mut self) -> Expr {
        self.chain(&['*', '/'], Self::signed)
    }

    fn signed(&mut self) -> Expr {
        match self.take(&['-']) {
            Some(_) => Expr::Negative(Box::new(self.signed())),
            None => self.atom(),
        }
    }

    fn atom(&mut self) -> Expr {
        if self.take(&['(']).is_some() {
            let inner = self.sum();
            return if self.take(&[')']).is_some() { inner } else { self.fail("`)`") };
        }
        let of_word = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
        let length = self.rest.find(|c| !of_word(c)).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(length);
        self.rest = rest.trim_start();
        if let Ok(number) = word.parse() {
            return Expr::Number(number);
        }
        if let Some((name, _)) = FUNCTIONS.iter().find(|(name, _)| *name == word) {
            return Expr::Function(name, self.arguments());
        }
        let known = Symbol::ALL.iter().find(|symbol| symbol.entry().name == word);
        known.map_or_else(|| self.fail("a symbol"), |symbol| Expr::Symbol(*symbol))
    }

    fn arguments(&mut self) -> Vec<Expr> {
        let mut arguments = Vec::new();
        while self.take(&['(', ',']).is_some() {
            arguments.push(self.sum());
        }
        if self.take(&[')']).is_some() { arguments } else { self.fail("`)`") }
    }
}
