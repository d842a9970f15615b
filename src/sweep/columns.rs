//! What is recorded of points, as columns with names and units.

use super::Plan;
use super::facts::{PointFacts, PointMotions};
use crate::analysis::{Area, Strip};
use crate::case::Recorded;
use crate::criteria::Outcome;
use crate::motions::Motion;
use crate::quantity::Dimension;
use crate::regimes::Regime;

/// A value of a column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cell {
    /// A finite number; a whole one where the column has these, and 1 or 0 where it says yes or no.
    Number(f64),
    /// A word.
    Text(&'static str),
}

impl Cell {
    /// The number, if it is one.
    pub const fn number(self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(number),
            Self::Text(_) => None,
        }
    }

    /// The word, if it is one.
    pub const fn text(self) -> Option<&'static str> {
        match self {
            Self::Number(_) => None,
            Self::Text(text) => Some(text),
        }
    }
}

/// What the cells of a column are, and are stored as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Storage {
    /// Numbers.
    Number,
    /// Whole numbers.
    Whole,
    /// Yes or no.
    Flag,
    /// Words.
    Text,
}

/// A column.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// Its unit; `1` for a pure number, empty for words.
    pub unit: &'static str,
    /// What its cells are.
    pub storage: Storage,
    /// Its cells; nothing where a point has no value.
    pub cells: Vec<Option<Cell>>,
}

impl Column {
    pub(super) fn empty(name: String, unit: &'static str, storage: Storage) -> Self {
        Self { name, unit, storage, cells: Vec::new() }
    }
}

/// How the motions of a column were come by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Direction {
    /// Looked for at each point by itself.
    Single,
    /// Followed with the axis ascending.
    Up,
    /// Followed with the axis descending.
    Down,
}

impl Direction {
    /// How the names of its columns end.
    pub const fn suffix(self) -> &'static str {
        match self {
            Self::Single => "",
            Self::Up => "_up",
            Self::Down => "_down",
        }
    }
}

/// Columns of a section: displacements at the end of so many excitation periods.
pub const SECTION: usize = 16;

/// The columns of a sweep, empty.
pub fn empty(plan: &Plan) -> Vec<Column> {
    let mut columns = vec![Column::empty("point".to_owned(), "1", Storage::Whole)];
    columns.extend(plan.settings.axes.iter().map(|axis| {
        let unit = plan.design.unit(axis.parameter);
        Column::empty(axis.parameter.key().to_owned(), unit, Storage::Number)
    }));
    let physical = plan.design.is_physical();
    for (recorded, direction) in recorded(plan) {
        let unit = recorded.kind().map_or("", |kind| kind.dimension.symbol(physical));
        let storage = match recorded.kind().map(|kind| kind.dimension) {
            Some(Dimension::Count) => Storage::Whole,
            Some(_) => Storage::Number,
            None if recorded == Recorded::OrbitReached => Storage::Flag,
            None => Storage::Text,
        };
        let column = |name| Column::empty(format!("{name}{}", direction.suffix()), unit, storage);
        columns.extend(names(recorded).into_iter().map(column));
    }
    columns
}

/// What is recorded, in each direction in which it is found.
fn recorded(plan: &Plan) -> impl Iterator<Item = (Recorded, Direction)> {
    plan.settings.record.iter().flat_map(|recorded| {
        let both = plan.settings.follow && recorded.is_simulated();
        let directions: &[_] =
            if both { &[Direction::Up, Direction::Down] } else { &[Direction::Single] };
        directions.iter().map(|direction| (*recorded, *direction))
    })
}

/// The columns of what is recorded; most have one.
pub fn names(recorded: Recorded) -> Vec<String> {
    match recorded {
        Recorded::Area => vec!["area".into(), "strip".into()],
        Recorded::Section => (1..=SECTION).map(|k| format!("section_{k:02}")).collect(),
        other => vec![other.key().into()],
    }
}

/// Adds a point and what is recorded of it to the columns of its sweep.
pub(super) fn push(
    columns: &mut [Column],
    number: u64,
    coordinates: &[f64],
    recorded: Vec<Option<Cell>>,
) {
    let place = [number as f64].into_iter().chain(coordinates.iter().copied());
    let cells = place.map(|value| Some(Cell::Number(value))).chain(recorded);
    // What is not recorded of a point is not known of it.
    let cells = cells.chain(std::iter::repeat(None));
    let known = |cell: &Cell| cell.number().is_none_or(f64::is_finite);
    for (column, cell) in columns.iter_mut().zip(cells) {
        column.cells.push(cell.filter(known));
    }
}

/// What is recorded of a point.
pub(super) fn cells(plan: &Plan, facts: &PointFacts) -> Vec<Option<Cell>> {
    let nothing = PointMotions::default();
    let point = facts.point;
    let mut cells = Vec::new();
    for (recorded, direction) in recorded(plan) {
        let found = facts.found.get(usize::from(direction == Direction::Down)).unwrap_or(&nothing);
        match recorded {
            Recorded::Area => {
                let zone = facts.zone();
                cells.push(zone.map(|zone| Cell::Text(zone.area.key())));
                cells.push(zone.and_then(|zone| zone.strip).map(Strip::key).map(Cell::Text));
            }
            Recorded::Regime => {
                cells.push(found.motions.main().map(|motion| Cell::Text(motion.regime().key())));
            }
            Recorded::Section => cells.extend((0..SECTION).map(|k| {
                found.section.displacements.get(k).map(|x| Cell::Number(point.units.length(*x)))
            })),
            other => cells.push(number(plan, other, facts, found).map(Cell::Number)),
        }
    }
    cells
}

/// The value of what fills one column of numbers, whole numbers or flags.
fn number(
    plan: &Plan,
    recorded: Recorded,
    facts: &PointFacts,
    found: &PointMotions,
) -> Option<f64> {
    let units = &facts.point.units;
    let length = |over_clearance: f64| units.length(over_clearance);
    let motions = &found.motions;
    let main = || motions.main();
    let counting = || motions.counting(plan.count_rest).map(|(_, motion)| motion);
    let peak = |motion: &&Motion| motion.facts().peak.value;
    let largest = || counting().max_by(|a, b| peak(a).total_cmp(&peak(b)));
    match recorded {
        Recorded::TheoryPeak => facts.theory_peak().map(length),
        Recorded::BoundaryDistance => facts.boundary_distance(),
        Recorded::BareAmplitude => facts.bare().map(length),
        Recorded::OrbitPeak => Some(length(facts.orbit()?.facts().peak.value)),
        Recorded::OrbitMultiplier => facts.orbit()?.largest_multiplier(),
        Recorded::OrbitReached => {
            facts.orbit()?;
            let reached = |motion: &Motion| motion.is_one_to_one() && motion.reached().starts > 0;
            Some(f64::from(motions.iter().any(reached)))
        }
        Recorded::RepeatsAfter => main()?.repeats_after().map(f64::from),
        Recorded::Lyapunov => found.section.exponent,
        Recorded::ShareOfStarts => {
            let all = f64::from(motions.of_starts().max(1));
            Some(f64::from(main()?.reached().starts) / all)
        }
        Recorded::LargestPeak => largest().map(|motion| length(motion.facts().peak.value)),
        Recorded::Motions => Some(counting().count() as f64).filter(|_| !motions.is_empty()),
        other => {
            // A point that is a start has the motion that it leads to.
            let worst = other == Recorded::ReductionDb && facts.point.start.is_none();
            let motion = if worst { largest() } else { main() }?;
            let bare = facts.bare().unwrap_or(f64::INFINITY);
            let of = other.asked().0;
            of.of_motion(motion, &|fact| fact.of(motion), bare, units).map(|[value, _]| value)
        }
    }
}

/// The word that a column of words may hold, from its bytes.
pub(super) fn word(bytes: &[u8]) -> Option<&'static str> {
    let regimes = Regime::ALL.map(Regime::key).into_iter();
    let areas = Area::ALL.map(Area::key);
    let outcomes = Outcome::ALL.map(Outcome::name);
    let mut all = regimes.chain(areas).chain(Strip::ALL.map(Strip::key)).chain(outcomes);
    all.find(|word| word.as_bytes() == bytes)
}
