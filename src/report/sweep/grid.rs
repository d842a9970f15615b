//! The table of a sweep, looked at by axes, slices and directions.

use super::axis::{At, AxisShown};
use super::{Swept, SweptCase};
use crate::case::Recorded;
use crate::criteria::Outcome;
use crate::quantity::{Kind, Units};
use crate::regimes::Regime;
use crate::report::chart::{AxisOf, FITTED};
use crate::report::figure::Axis;
use crate::sweep::columns::{Cell, Column, Direction};
use crate::sweep::{LIMITS, indices};
use crate::system::Parameter;

/// What a panel or a mark of a direction is called.
pub(super) const fn words(direction: Direction) -> &'static str {
    match direction {
        Direction::Single => "simulated",
        Direction::Up => "way up",
        Direction::Down => "way down",
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

impl Swept<'_> {
    pub(super) fn units(&self) -> Units {
        self.case.units()
    }

    /// The axis of some columns of a kind.
    pub(super) fn axis_of<'b>(
        &self,
        kind: &Kind,
        columns: impl IntoIterator<Item = &'b Numbers>,
    ) -> Axis {
        let all = columns.into_iter().flatten().flatten();
        let largest = all.fold(0.0, |most: f64, value| most.max(value.abs()));
        AxisOf::si(self.units(), kind).axis_up_to(largest, FITTED)
    }

    pub(super) fn points(&self) -> usize {
        self.axes.iter().map(|axis| axis.values.len()).fold(1, usize::saturating_mul)
    }

    /// Whether the axes are starts of one system.
    pub(super) fn is_basin(&self) -> bool {
        self.is_steady() && self.axes.iter().any(|axis| axis.parameter.is_initial())
    }

    pub(super) fn is_steady(&self) -> bool {
        self.case.is_steady()
    }

    /// Whether it is of several modes or absorbers: at each point the worst motion is told, not the main one.
    pub(super) fn is_of_several(&self) -> bool {
        matches!(self.case, SweptCase::Several(_))
    }

    /// Up and down where a motion was followed.
    pub(super) fn directions(&self) -> Vec<Direction> {
        let mut found = vec![Direction::Up, Direction::Down];
        found.retain(|way| self.columns.iter().any(|column| column.name.ends_with(way.suffix())));
        if found.is_empty() { vec![Direction::Single] } else { found }
    }

    /// The column of a name.
    pub(super) fn cells(&self, name: &str, direction: Direction) -> Option<&[Option<Cell>]> {
        let same = |column: &&Column| column.name.strip_suffix(direction.suffix()) == Some(name);
        self.columns.iter().find(same).map(|column| column.cells.as_slice())
    }

    /// The same as numbers.
    pub(super) fn named(&self, name: &str, direction: Direction) -> Option<Numbers> {
        let cells = self.cells(name, direction)?;
        Some(cells.iter().map(|cell| cell.and_then(Cell::number)).collect())
    }

    /// The same by what it records.
    pub(super) fn numbers(&self, of: Recorded, direction: Direction) -> Option<Numbers> {
        self.named(of.key(), direction)
    }

    /// The same in each direction that has it.
    pub(super) fn in_directions(&self, of: Recorded) -> Vec<(Direction, Numbers)> {
        let numbers = |way: Direction| Some((way, self.numbers(of, way)?));
        self.directions().into_iter().filter_map(numbers).collect()
    }

    /// The theory's area at each point, which no direction changes.
    pub(super) fn areas(&self) -> Option<Vec<Option<&'static str>>> {
        let cells = self.cells(Recorded::Area.key(), Direction::Single)?;
        Some(cells.iter().map(|cell| cell.and_then(Cell::text)).collect())
    }

    /// What all limits come to at each point, where there are limits.
    pub(super) fn outcomes(&self) -> Option<Vec<Option<Outcome>>> {
        let cells = self.cells(LIMITS, Direction::Single)?;
        let outcome = |cell: &Option<Cell>| cell.and_then(Cell::text).and_then(Outcome::of_name);
        Some(cells.iter().map(outcome).collect())
    }

    pub(super) fn regimes(&self, direction: Direction) -> Option<Vec<Option<Regime>>> {
        let cells = self.cells(Recorded::Regime.key(), direction)?;
        let regime = |cell: &Option<Cell>| cell.and_then(Cell::text).and_then(Regime::of_key);
        Some(cells.iter().map(regime).collect())
    }

    /// The last two axes; `None` where there is only one.
    pub(super) fn plane(&self) -> Option<Plane<'_>> {
        use Parameter as P;
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
        indices(point as u64, self.axes.iter().map(|axis| axis.values.len()))
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
