//! The table of a sweep, looked at by axes, slices and directions.

use serde::Serialize;

use super::Swept;
use super::axis::{At, AxisShown};
use crate::case::{Recorded, SweepParameter};
use crate::quantity::{Kind, Units};
use crate::regimes::Regime;
use crate::report::document;
use crate::sweep::columns::Values;

/// How the motions of a column were come by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum SweepDirection {
    /// Looked for at each point by itself.
    Single,
    /// Followed with the axis ascending.
    Up,
    /// Followed with the axis descending.
    Down,
}

impl SweepDirection {
    /// How the names of its columns end.
    const fn suffix(self) -> &'static str {
        match self {
            Self::Single => "",
            Self::Up => "_up",
            Self::Down => "_down",
        }
    }

    /// What a panel or a mark is called.
    pub(super) const fn words(self) -> &'static str {
        match self {
            Self::Single => "simulated",
            Self::Up => "way up",
            Self::Down => "way down",
        }
    }
}

/// A number for each point, where it is known.
pub(super) type Numbers = Vec<Option<f64>>;

/// Two axes of a plane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plane<'a> {
    pub x: &'a AxisShown,
    pub y: &'a AxisShown,
    /// Whether the horizontal axis is the last one, which varies fastest.
    x_is_last: bool,
}

/// The axis and the unit in which columns of one dimension are drawn.
pub(super) struct Measure {
    pub label: String,
    size: f64,
}

impl Measure {
    /// That of columns of which none is larger than any of these.
    pub(super) fn of<'b>(
        units: &Units,
        kind: &Kind,
        columns: impl IntoIterator<Item = &'b Numbers>,
    ) -> Self {
        let all = columns.into_iter().flatten().flatten();
        let largest = all.fold(0.0, |most: f64, value| most.max(value.abs()));
        let size = units.axis_unit(kind, largest).size;
        Self { label: units.axis_label(kind, largest), size }
    }

    pub(super) fn shown(&self, column: &Numbers) -> Numbers {
        column.iter().map(|value| value.map(|value| value / self.size)).collect()
    }
}

impl Swept<'_> {
    pub(super) fn units(&self) -> Units {
        document::units(self.case)
    }

    pub(super) fn points(&self) -> usize {
        self.axes.iter().map(|axis| axis.values.len()).fold(1, usize::saturating_mul)
    }

    /// Whether the axes are starts of one system.
    pub(super) fn is_basin(&self) -> bool {
        self.axes.iter().any(|axis| axis.parameter.is_initial())
    }

    /// Up and down where a motion was followed.
    pub(super) fn directions(&self) -> Vec<SweepDirection> {
        let any = |direction: &SweepDirection| {
            self.columns.iter().any(|column| column.name.ends_with(direction.suffix()))
        };
        let mut found = vec![SweepDirection::Up, SweepDirection::Down];
        found.retain(any);
        if found.is_empty() { vec![SweepDirection::Single] } else { found }
    }

    fn values(&self, name: &str, direction: SweepDirection) -> Option<&Values> {
        let same = |column: &str| column.strip_suffix(direction.suffix()) == Some(name);
        self.columns.iter().find(|column| same(&column.name)).map(|column| &column.values)
    }

    /// A column of numbers, whole numbers or flags, by its name.
    pub(super) fn named(&self, name: &str, direction: SweepDirection) -> Option<Numbers> {
        match self.values(name, direction)? {
            Values::Number(all) => Some(all.clone()),
            Values::Whole(all) => Some(all.iter().map(|one| one.map(|one| one as f64)).collect()),
            Values::Flag(all) => Some(all.iter().map(|one| one.map(f64::from)).collect()),
            Values::Text(_) => None,
        }
    }

    /// The same by what it records.
    pub(super) fn numbers(&self, of: Recorded, direction: SweepDirection) -> Option<Numbers> {
        self.named(of.key(), direction)
    }

    /// The theory's area at each point, which no direction changes.
    pub(super) fn areas(&self) -> Option<&[Option<&'static str>]> {
        match self.values(Recorded::Area.key(), SweepDirection::Single)? {
            Values::Text(all) => Some(all),
            _ => None,
        }
    }

    pub(super) fn regimes(&self, direction: SweepDirection) -> Option<Vec<Option<Regime>>> {
        match self.values(Recorded::Regime.key(), direction)? {
            Values::Text(all) => {
                Some(all.iter().map(|name| name.and_then(Regime::of_key)).collect())
            }
            _ => None,
        }
    }

    /// The last two axes; `None` where there is only one.
    pub(super) fn plane(&self) -> Option<Plane<'_>> {
        use SweepParameter as P;
        let [.., first, last] = self.axes.as_slice() else { return None };
        // A frequency lies along the page and a clearance up it, as in every other figure.
        let lies = |axis: &AxisShown| match axis.parameter {
            P::Frequency | P::Detuning => 3,
            P::InitialDisplacement | P::InitialAbsorberDisplacement => 2,
            P::Clearance | P::InitialVelocity | P::InitialAbsorberVelocity => 0,
            _ => 1,
        };
        let x_is_last = lies(last) > lies(first);
        let (x, y) = if x_is_last { (last, first) } else { (first, last) };
        Some(Plane { x, y, x_is_last })
    }

    /// The axes besides those of the plane.
    pub(super) fn others(&self) -> &[AxisShown] {
        &self.axes[..self.axes.len().saturating_sub(2)]
    }

    /// Number of planes, one for each combination of the other axes' values.
    pub(super) fn slices(&self) -> usize {
        self.others().iter().map(|axis| axis.values.len()).product()
    }

    /// The values of the other axes at a slice, in words.
    pub(super) fn slice_words(&self, slice: usize) -> Vec<String> {
        let indices = self.indices(slice * (self.points() / self.slices()));
        self.others().iter().zip(indices).map(|(axis, k)| axis.text(k)).collect()
    }

    /// Where a point lies on each axis.
    pub(super) fn place(&self, point: usize) -> Vec<At> {
        self.axes.iter().zip(self.indices(point)).map(|(axis, k)| axis.at(k)).collect()
    }

    /// A point's index on each axis; the last varies fastest.
    pub(super) fn indices(&self, point: usize) -> Vec<usize> {
        let mut rest = point;
        let mut found: Vec<usize> = Vec::new();
        for axis in self.axes.iter().rev() {
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
