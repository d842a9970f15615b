//! The table of a sweep, looked at by axes, slices and passes.

use super::{AxisShown, Swept};
use crate::case::SweepParameter;
use crate::regimes::Regime;
use crate::report::numbers::LengthFormat;
use crate::sweep::columns::Values;

/// How the motions of a column were come by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SweepDirection {
    /// Looked for at each point by itself.
    Single,
    /// Followed with the axis ascending.
    Up,
    /// Followed with the axis descending.
    Down,
}

impl SweepDirection {
    pub(super) const fn suffix(self) -> &'static str {
        match self {
            Self::Single => "",
            Self::Up => "_up",
            Self::Down => "_down",
        }
    }

    /// A heading, or the end of a title.
    pub(super) const fn words(self) -> &'static str {
        match self {
            Self::Single => "",
            Self::Up => "on the way up",
            Self::Down => "on the way down",
        }
    }
}

/// Number columns that only simulation fills; any of them tells which passes there are.
const SIMULATED: [&str; 6] =
    ["regime", "peak", "rms", "reduction_db", "impacts_per_period", "efficiency"];

/// The table of a sweep.
pub(super) struct Grid<'a> {
    pub swept: &'a Swept<'a>,
    pub lengths: LengthFormat,
}

/// Two axes of a plane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plane<'a> {
    pub x: &'a AxisShown,
    pub y: &'a AxisShown,
    /// Whether the horizontal axis is the last one, which varies fastest.
    pub x_is_last: bool,
}

impl<'a> Grid<'a> {
    pub(super) fn of(swept: &'a Swept<'a>) -> Self {
        Self { swept, lengths: LengthFormat::of(&swept.case.scales()) }
    }

    pub(super) fn points(&self) -> usize {
        self.swept.axes.iter().map(|axis| axis.values.len()).product()
    }

    /// Whether the axes are starts of one system.
    pub(super) fn is_basin(&self) -> bool {
        self.swept.axes.iter().any(AxisShown::is_initial)
    }

    pub(super) fn passes(&self) -> Vec<SweepDirection> {
        let any = |pass: SweepDirection| {
            SIMULATED.iter().any(|name| self.values(name, pass).is_some())
                || self.values("section_01", pass).is_some()
        };
        let found: Vec<SweepDirection> =
            [SweepDirection::Single, SweepDirection::Up, SweepDirection::Down]
                .into_iter()
                .filter(|pass| any(*pass))
                .collect();
        if found.is_empty() { vec![SweepDirection::Single] } else { found }
    }

    fn values(&self, name: &str, pass: SweepDirection) -> Option<&'a Values> {
        let suffix = pass.suffix();
        let same = |column: &str| column.strip_suffix(suffix) == Some(name);
        let column = self.swept.columns.iter().find(|column| same(&column.name))?;
        Some(&column.values)
    }

    /// A column of numbers, or of whole numbers as such.
    pub(super) fn number(&self, name: &str, pass: SweepDirection) -> Option<Vec<Option<f64>>> {
        let finite = |value: &Option<f64>| value.filter(|value| value.is_finite());
        match self.values(name, pass)? {
            Values::Number(values) => Some(values.iter().map(finite).collect()),
            Values::Whole(values) => {
                Some(values.iter().map(|value| value.map(|value| value as f64)).collect())
            }
            Values::Flag(values) => Some(
                values.iter().map(|value| value.map(|value| f64::from(u8::from(value)))).collect(),
            ),
            Values::Text(_) => None,
        }
    }

    /// A column of lengths in displayed units.
    pub(super) fn length(&self, name: &str, pass: SweepDirection) -> Option<Vec<Option<f64>>> {
        let shown = |value: Option<f64>| value.map(|value| self.lengths.number(value));
        Some(self.number(name, pass)?.into_iter().map(shown).collect())
    }

    pub(super) fn text(
        &self,
        name: &str,
        pass: SweepDirection,
    ) -> Option<&'a [Option<&'static str>]> {
        match self.values(name, pass)? {
            Values::Text(values) => Some(values),
            _ => None,
        }
    }

    pub(super) fn regimes(&self, pass: SweepDirection) -> Option<Vec<Option<Regime>>> {
        let regimes = self.text("regime", pass)?.iter();
        Some(regimes.map(|name| name.and_then(Regime::of_key)).collect())
    }

    /// The last two axes; `None` where there is only one.
    pub(super) fn plane(&self) -> Option<Plane<'a>> {
        use SweepParameter::{
            Clearance, Detuning, Frequency, InitialAbsorberDisplacement, InitialAbsorberVelocity,
            InitialDisplacement, InitialVelocity,
        };
        let [.., first, last] = self.swept.axes.as_slice() else { return None };
        // A frequency lies along the page and a clearance up it, as in every other figure.
        let lies = |axis: &AxisShown| match axis.parameter {
            Frequency | Detuning => 3,
            InitialDisplacement | InitialAbsorberDisplacement => 2,
            Clearance | InitialVelocity | InitialAbsorberVelocity => 0,
            _ => 1,
        };
        let x_is_last = lies(last) > lies(first);
        let (x, y) = if x_is_last { (last, first) } else { (first, last) };
        Some(Plane { x, y, x_is_last })
    }

    /// The axes besides those of the plane.
    fn others(&self) -> &'a [AxisShown] {
        let axes = self.swept.axes.as_slice();
        &axes[..axes.len().saturating_sub(2)]
    }

    /// Number of planes, one for each combination of the other axes' values.
    pub(super) fn slices(&self) -> usize {
        self.others().iter().map(|axis| axis.values.len()).product()
    }

    /// The values of the other axes at a slice, in words.
    pub(super) fn slice_words(&self, slice: usize) -> String {
        let first = slice * (self.points() / self.slices());
        self.words(self.others(), first)
    }

    /// Where a point lies, in words.
    pub(super) fn place(&self, point: usize) -> String {
        self.words(&self.swept.axes, point)
    }

    /// Where a point lies on the first axes.
    fn words(&self, axes: &[AxisShown], point: usize) -> String {
        let indices = self.indices(point);
        let words: Vec<String> = axes.iter().zip(&indices).map(|(axis, k)| axis.text(*k)).collect();
        words.join(", ")
    }

    /// A point's index on each axis; the last varies fastest.
    pub(super) fn indices(&self, point: usize) -> Vec<usize> {
        let mut rest = point;
        let mut found: Vec<usize> = Vec::new();
        for axis in self.swept.axes.iter().rev() {
            found.push(rest % axis.values.len());
            rest /= axis.values.len();
        }
        found.reverse();
        found
    }
}

impl Plane<'_> {
    /// The cells of a slice, row by row from the smallest ordinate.
    pub(super) fn cells<T: Clone>(&self, values: &[T], slice: usize) -> Vec<T> {
        let (across, up) = (self.x.values.len(), self.y.values.len());
        let slice = &values[slice * across * up..][..across * up];
        if self.x_is_last {
            return slice.to_vec();
        }
        let cell = |row: usize, column: usize| slice[column * up + row].clone();
        (0..up).flat_map(|row| (0..across).map(move |column| cell(row, column))).collect()
    }
}
