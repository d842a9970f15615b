//! An expression as a flat program, for the places where it is evaluated thousands of times.
//!
//! The program is recorded from the expression itself and performs the same operations in the same
//! order, so both give the same bits. What occurs twice is computed once; evaluation allocates
//! nothing.

use super::evaluate::{Machine, apply, perform};
use super::expr::Function;
use super::{Expr, MissingValue, Symbol, Values};
use crate::operation_count;
use std::collections::HashMap;
use std::convert::Infallible;

/// How many intermediate results a program may have; they live on the stack during evaluation.
pub const CAPACITY: usize = 256;

#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Step {
    Number(u64),
    Symbol(Symbol),
    Add(u16, u16),
    Multiply(u16, u16),
    Divide(u16, u16),
    Function(Function, u16),
}

impl Step {
    fn cost(&self) -> u64 {
        match self {
            Self::Number(_) | Self::Symbol(_) => 0,
            Self::Add(..) | Self::Multiply(..) | Self::Divide(..) => 1,
            Self::Function(Function::Sqrt, _) => 1,
            Self::Function(Function::Sin | Function::Cos, _) => operation_count::ELEMENTARY,
        }
    }
}

/// A program that evaluates `N` expressions at once.
#[derive(Debug, Clone)]
pub struct Compiled<const N: usize> {
    steps: Vec<Step>,
    results: [u16; N],
    /// Operations of one evaluation, as [`crate::operation_count`] counts them.
    cost: u64,
}

impl<const N: usize> Compiled<N> {
    /// Records the operations of the expressions.
    ///
    /// # Panics
    /// If they need more than [`CAPACITY`] different operations.
    pub fn new(expressions: [&Expr; N]) -> Self {
        let mut recorder = Recorder { steps: Vec::new(), places: HashMap::new() };
        let results = expressions.map(|expression| match perform(&mut recorder, expression) {
            Ok(place) => place,
        });
        let count = recorder.steps.len();
        assert!(count <= CAPACITY, "{count} operations in one program, at most {CAPACITY}");
        let cost = recorder.steps.iter().map(Step::cost).sum();
        Self { steps: recorder.steps, results, cost }
    }

    /// How many operations one evaluation takes, loads of numbers and symbols included.
    pub fn operations(&self) -> usize {
        self.steps.len()
    }

    /// The values of the expressions.
    ///
    /// # Errors
    /// If a symbol has no value; the error names it.
    pub fn evaluate(&self, values: &Values) -> Result<[f64; N], MissingValue> {
        operation_count::note(self.cost);
        let mut slots = [0.0; CAPACITY];
        let at = |slots: &[f64; CAPACITY], place: u16| slots[usize::from(place) % CAPACITY];
        for (place, step) in self.steps.iter().enumerate() {
            slots[place % CAPACITY] = match *step {
                Step::Number(bits) => f64::from_bits(bits),
                Step::Symbol(symbol) => values.require(symbol)?,
                Step::Add(left, right) => at(&slots, left) + at(&slots, right),
                Step::Multiply(left, right) => at(&slots, left) * at(&slots, right),
                Step::Divide(above, below) => at(&slots, above) / at(&slots, below),
                Step::Function(function, argument) => apply(function, at(&slots, argument)),
            };
        }
        Ok(self.results.map(|place| at(&slots, place)))
    }
}

struct Recorder {
    steps: Vec<Step>,
    places: HashMap<Step, u16>,
}

impl Recorder {
    fn record(&mut self, step: Step) -> u16 {
        if let Some(place) = self.places.get(&step) {
            return *place;
        }
        let place = u16::try_from(self.steps.len()).unwrap_or(u16::MAX);
        self.steps.push(step);
        self.places.insert(step, place);
        place
    }
}

impl Machine for Recorder {
    type Value = u16;
    type Error = Infallible;

    fn number(&mut self, number: f64) -> u16 {
        self.record(Step::Number(number.to_bits()))
    }

    fn symbol(&mut self, symbol: Symbol) -> Result<u16, Infallible> {
        Ok(self.record(Step::Symbol(symbol)))
    }

    fn add(&mut self, left: u16, right: u16) -> u16 {
        self.record(Step::Add(left, right))
    }

    fn multiply(&mut self, left: u16, right: u16) -> u16 {
        self.record(Step::Multiply(left, right))
    }

    fn divide(&mut self, above: u16, below: u16) -> u16 {
        self.record(Step::Divide(above, below))
    }

    fn function(&mut self, function: Function, argument: u16) -> u16 {
        self.record(Step::Function(function, argument))
    }
}
