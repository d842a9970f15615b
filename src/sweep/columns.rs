//! What is recorded of points, as columns with names and units.

use super::Plan;
use super::facts::{Facts, Found};
use crate::analysis::{Area, Strip, Zone};
use crate::case::{Design, Layer, Recorded};
use crate::quantity::catalogue as of;
use crate::quantity::{Dimension, Kind};
use crate::regimes::Regime;

/// Values of a column; nothing where a point has none.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Numbers, all finite.
    Number(Vec<Option<f64>>),
    /// Whole numbers.
    Whole(Vec<Option<i64>>),
    /// True or false.
    Flag(Vec<Option<bool>>),
    /// Words.
    Text(Vec<Option<&'static str>>),
}

/// A column.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// Its unit; `1` for a pure number, empty for words.
    pub unit: &'static str,
    /// Its values.
    pub values: Values,
}

/// A value of a column.
#[derive(Debug, Clone, Copy)]
enum Cell {
    Number(Option<f64>),
    Whole(Option<i64>),
    Flag(Option<bool>),
    Text(Option<&'static str>),
}

/// Columns of a section: displacements at the end of so many excitation periods.
pub const SECTION: usize = 16;

impl Values {
    /// How many there are, those that are missing included.
    pub fn len(&self) -> usize {
        match self {
            Self::Number(all) => all.len(),
            Self::Whole(all) => all.len(),
            Self::Flag(all) => all.len(),
            Self::Text(all) => all.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Adds a value, which is of the column's kind.
    fn push(&mut self, cell: Cell) {
        match (self, cell) {
            (Self::Number(all), Cell::Number(one)) => all.push(one.filter(|one| one.is_finite())),
            (Self::Whole(all), Cell::Whole(one)) => all.push(one),
            (Self::Flag(all), Cell::Flag(one)) => all.push(one),
            (Self::Text(all), Cell::Text(one)) => all.push(one),
            (_, other) => debug_assert!(false, "the column holds no {other:?}"),
        }
    }
}

/// What a column of numbers holds; `None` for words and flags.
pub const fn kind(recorded: Recorded) -> Option<&'static Kind> {
    Some(match recorded {
        Recorded::TheoryPeak => &of::THEORY_PEAK,
        Recorded::BoundaryDistance => &of::BOUNDARY_DISTANCE,
        Recorded::BareAmplitude => &of::BARE_PEAK,
        Recorded::OrbitPeak => &of::ORBIT_PEAK,
        Recorded::OrbitMultiplier => &of::SPECTRAL_RADIUS,
        Recorded::ImpactsPerPeriod => &of::IMPACTS_PER_PERIOD,
        Recorded::Peak => &of::PEAK,
        Recorded::Rms => &of::RMS,
        Recorded::ReductionDb => &of::REDUCTION_DB,
        Recorded::Efficiency => &of::EFFICIENCY,
        Recorded::ImpactSpeed => &of::IMPACT_SPEED,
        Recorded::RepeatsAfter => &of::REPEATS_AFTER,
        Recorded::Lyapunov => &of::LYAPUNOV_EXPONENT,
        Recorded::Section => &of::SECTION,
        Recorded::ShareOfStarts => &of::START_SHARE,
        Recorded::LargestPeak => &of::LARGEST_PEAK,
        Recorded::Motions => &of::MOTIONS,
        Recorded::Area | Recorded::Regime | Recorded::OrbitReached => return None,
    })
}

/// The columns of a sweep, empty.
pub fn empty(plan: &Plan) -> Vec<Column> {
    let column = |name: &str, unit, values| Column { name: name.to_owned(), unit, values };
    let mut columns = vec![column("point", "1", Values::Whole(Vec::new()))];
    columns.extend(plan.settings.axes.iter().map(|axis| {
        let unit = axis.parameter.unit(&plan.design);
        column(axis.parameter.key(), unit, Values::Number(Vec::new()))
    }));
    let physical = matches!(plan.design, Design::Physical(_));
    for (recorded, direction) in recorded(plan) {
        let end = direction.map_or("", |direction| ["_up", "_down"][direction]);
        let unit = kind(recorded).map_or("", |kind| kind.dimension.symbol(physical));
        let values = values(recorded);
        columns.extend(
            names(recorded)
                .iter()
                .map(|name| column(&format!("{name}{end}"), unit, values.clone())),
        );
    }
    columns
}

/// What is recorded, and in which direction it is found: 0 upwards, 1 downwards.
fn recorded(plan: &Plan) -> impl Iterator<Item = (Recorded, Option<usize>)> {
    plan.settings.record.iter().flat_map(|recorded| {
        let both = plan.settings.follow && recorded.layer() == Layer::Simulation;
        let directions = if both { vec![Some(0), Some(1)] } else { vec![None] };
        directions.into_iter().map(|direction| (*recorded, direction))
    })
}

/// The columns of what is recorded; most have one.
fn names(recorded: Recorded) -> Vec<String> {
    match recorded {
        Recorded::Area => vec!["area".into(), "strip".into()],
        Recorded::Section => (1..=SECTION).map(|k| format!("section_{k:02}")).collect(),
        other => vec![other.key().into()],
    }
}

fn values(recorded: Recorded) -> Values {
    match kind(recorded).map(|kind| kind.dimension) {
        Some(Dimension::Count) => Values::Whole(Vec::new()),
        Some(_) => Values::Number(Vec::new()),
        None if recorded == Recorded::OrbitReached => Values::Flag(Vec::new()),
        None => Values::Text(Vec::new()),
    }
}

/// Adds a point to the columns of its sweep.
pub(super) fn push(plan: &Plan, columns: &mut [Column], facts: &Facts) {
    let nothing = Found::default();
    let mut cells = vec![Cell::Whole(Some(facts.point.number as i64))];
    cells.extend(facts.point.coordinates.iter().map(|value| Cell::Number(Some(*value))));
    for (recorded, direction) in recorded(plan) {
        let found = facts.found.get(direction.unwrap_or(0)).unwrap_or(&nothing);
        match recorded {
            Recorded::Area => {
                let zone = facts.zone();
                cells.push(Cell::Text(zone.map(|zone| zone.area_key())));
                cells.push(Cell::Text(zone.and_then(|zone| zone.strip).map(Strip::key)));
            }
            Recorded::Section => cells.extend((0..SECTION).map(|k| {
                Cell::Number(found.section.get(k).map(|x| facts.point.scales.length(*x)))
            })),
            other => cells.push(cell(other, facts, found)),
        }
    }
    for (column, cell) in columns.iter_mut().zip(cells) {
        column.values.push(cell);
    }
}

/// The value of what fills one column.
fn cell(recorded: Recorded, facts: &Facts, found: &Found) -> Cell {
    let scales = &facts.point.scales;
    let length = |over_clearance: f64| scales.length(over_clearance);
    let main = found.main();
    let number = Cell::Number;
    match recorded {
        Recorded::TheoryPeak => number(facts.theory_peak().map(length)),
        Recorded::BoundaryDistance => number(facts.boundary_distance()),
        Recorded::BareAmplitude => number(facts.bare().map(length)),
        Recorded::OrbitPeak => number(facts.orbit().map(|orbit| length(orbit.peaks.displacement))),
        Recorded::OrbitMultiplier => {
            number(facts.orbit().map(|orbit| orbit.orbit.radius_per_period()))
        }
        Recorded::Regime => Cell::Text(main.map(|motion| motion.regime.key())),
        Recorded::ImpactsPerPeriod => number(main.map(|motion| motion.impacts_per_period)),
        Recorded::Peak => number(main.map(|motion| length(motion.peak))),
        Recorded::Rms => number(main.map(|motion| length(motion.rms))),
        Recorded::ReductionDb => {
            let both = main.zip(facts.bare());
            number(both.map(|(motion, bare)| 20.0 * libm::log10(bare / motion.peak)))
        }
        Recorded::Efficiency => number(main.and_then(|motion| motion.efficiency)),
        Recorded::ImpactSpeed => number(main.map(|motion| scales.velocity(motion.impact_speed))),
        Recorded::RepeatsAfter => {
            Cell::Whole(main.and_then(|motion| motion.repeats_after).map(i64::from))
        }
        Recorded::Lyapunov => number(found.lyapunov),
        Recorded::ShareOfStarts => number(main.map(|motion| {
            let all: u32 = found.motions.iter().map(|motion| motion.starts).sum();
            f64::from(motion.starts) / f64::from(all)
        })),
        Recorded::LargestPeak => {
            let peaks = found.motions.iter().map(|motion| motion.peak);
            number(peaks.max_by(f64::total_cmp).map(length))
        }
        Recorded::Motions => {
            Cell::Whole(Some(found.motions.len() as i64).filter(|count| *count > 0))
        }
        Recorded::OrbitReached => Cell::Flag(facts.orbit().map(|orbit| {
            found.motions.iter().any(|motion| motion.is_orbit_with_peak(orbit.peaks.displacement))
        })),
        Recorded::Area | Recorded::Section => number(None),
    }
}

/// The word that a column of words may hold, from its bytes.
pub(super) fn word(bytes: &[u8]) -> Option<&'static str> {
    let regimes = Regime::ALL.map(Regime::key).into_iter();
    let areas = Area::ALL.map(Area::key).into_iter().chain([Zone::UNSETTLED]);
    let mut all = regimes.chain(areas).chain(Strip::ALL.map(Strip::key));
    all.find(|word| word.as_bytes() == bytes)
}
