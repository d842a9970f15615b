//! What is recorded of points, as columns with names and units.

use super::Plan;
use super::facts::{Facts, Found};
use crate::analysis::{Area, Strip, Zone};
use crate::case::{Design, Layer, Recorded};
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

/// Displacements of a section.
pub(super) const SECTION: usize = 16;
/// Ends of the names of what is found in either direction.
const WAYS: [&str; 2] = ["_up", "_down"];

/// A value of a column.
#[derive(Debug, Clone, Copy)]
enum Cell {
    Number(Option<f64>),
    Whole(Option<i64>),
    Flag(Option<bool>),
    Text(Option<&'static str>),
}

impl Column {
    fn like(name: impl Into<String>, unit: &'static str, cell: Cell) -> Self {
        let values = match cell {
            Cell::Number(_) => Values::Number(Vec::new()),
            Cell::Whole(_) => Values::Whole(Vec::new()),
            Cell::Flag(_) => Values::Flag(Vec::new()),
            Cell::Text(_) => Values::Text(Vec::new()),
        };
        Self { name: name.into(), unit, values }
    }

    /// Adds a value; of another kind than the others it would be one too many for the column's kind,
    /// and is left out.
    fn push(&mut self, cell: Cell) {
        match (&mut self.values, cell) {
            (Values::Number(all), Cell::Number(one)) => all.push(one.filter(|one| one.is_finite())),
            (Values::Whole(all), Cell::Whole(one)) => all.push(one),
            (Values::Flag(all), Cell::Flag(one)) => all.push(one),
            (Values::Text(all), Cell::Text(one)) => all.push(one),
            (_, other) => debug_assert!(false, "{} holds no {other:?}", self.name),
        }
    }
}

/// The columns of a sweep, empty.
pub fn empty(plan: &Plan) -> Vec<Column> {
    let mut columns = vec![Column::like("point", "1", Cell::Whole(None))];
    columns.extend(plan.settings.axes.iter().map(|axis| {
        let unit = axis.parameter.unit(&plan.design);
        Column::like(axis.parameter.key(), unit, Cell::Number(None))
    }));
    let units = Units::of(&plan.design);
    for (recorded, way) in recorded(plan) {
        let end = way.map_or("", |way| WAYS[way]);
        match recorded {
            Recorded::Area => columns
                .extend(["area", "strip"].map(|name| Column::like(name, "", Cell::Text(None)))),
            Recorded::Section => columns.extend((1..=SECTION).map(|k| {
                Column::like(format!("section_{k:02}{end}"), units.length, Cell::Number(None))
            })),
            other => {
                let (unit, cell) = units.of_values(other);
                columns.push(Column::like(format!("{}{end}", other.key()), unit, cell));
            }
        }
    }
    columns
}

/// What is recorded, and in which direction it is found.
fn recorded(plan: &Plan) -> impl Iterator<Item = (Recorded, Option<usize>)> {
    plan.settings.record.iter().flat_map(|recorded| {
        let both = plan.settings.follow && recorded.layer() == Layer::Simulation;
        let ways = if both { vec![Some(0), Some(1)] } else { vec![None] };
        ways.into_iter().map(|way| (*recorded, way))
    })
}

/// Units of a design's results.
struct Units {
    length: &'static str,
    velocity: &'static str,
}

impl Units {
    fn of(design: &Design) -> Self {
        match design {
            Design::Physical(_) => Self { length: "m", velocity: "m/s" },
            Design::Reduced(_) => Self { length: "1", velocity: "1" },
        }
    }

    /// Unit and kind of what fills one column.
    fn of_values(&self, recorded: Recorded) -> (&'static str, Cell) {
        let number = |unit| (unit, Cell::Number(None));
        match recorded {
            Recorded::TheoryPeak
            | Recorded::BareAmplitude
            | Recorded::OrbitPeak
            | Recorded::Peak
            | Recorded::Rms
            | Recorded::LargestPeak
            | Recorded::Section => number(self.length),
            Recorded::ImpactSpeed => number(self.velocity),
            Recorded::ReductionDb => number("dB"),
            Recorded::BoundaryDistance
            | Recorded::OrbitMultiplier
            | Recorded::ImpactsPerPeriod
            | Recorded::Efficiency
            | Recorded::Lyapunov
            | Recorded::ShareOfStarts => number("1"),
            Recorded::RepeatsAfter | Recorded::Motions => ("1", Cell::Whole(None)),
            Recorded::OrbitReached => ("", Cell::Flag(None)),
            Recorded::Area | Recorded::Regime => ("", Cell::Text(None)),
        }
    }
}

/// Adds a point to the columns of its sweep.
pub(super) fn push(plan: &Plan, columns: &mut [Column], facts: &Facts) {
    let mut next = columns.iter_mut();
    let mut put = |cell| {
        if let Some(column) = next.next() {
            column.push(cell);
        }
    };
    put(Cell::Whole(Some(facts.point.number as i64)));
    for value in &facts.point.coordinates {
        put(Cell::Number(Some(*value)));
    }
    let nothing = Found::default();
    for (recorded, way) in recorded(plan) {
        let found = facts.found.get(way.unwrap_or(0)).unwrap_or(&nothing);
        match recorded {
            Recorded::Area => {
                put(Cell::Text(facts.zone.map(|zone| zone.area_key())));
                put(Cell::Text(facts.zone.and_then(|zone| zone.strip).map(Strip::key)));
            }
            Recorded::Section => {
                for k in 0..SECTION {
                    let one = found.section.get(k);
                    put(Cell::Number(one.map(|x| facts.point.scales.length(*x))));
                }
            }
            other => put(cell(other, facts, found)),
        }
    }
}

/// The value of what fills one column.
fn cell(recorded: Recorded, facts: &Facts, found: &Found) -> Cell {
    let scales = &facts.point.scales;
    let length = |over_clearance: f64| scales.length(over_clearance);
    let main = found.main();
    match recorded {
        Recorded::TheoryPeak => Cell::Number(facts.theory_peak.map(length)),
        Recorded::BoundaryDistance => Cell::Number(facts.boundary_distance),
        Recorded::BareAmplitude => Cell::Number(facts.bare.map(length)),
        Recorded::OrbitPeak => {
            Cell::Number(facts.orbit.as_ref().map(|orbit| length(orbit.peaks.displacement)))
        }
        Recorded::OrbitMultiplier => {
            Cell::Number(facts.orbit.as_ref().map(|orbit| orbit.orbit.radius_per_period()))
        }
        Recorded::Regime => Cell::Text(main.map(|motion| motion.regime.key())),
        Recorded::ImpactsPerPeriod => Cell::Number(main.map(|motion| motion.impacts_per_period)),
        Recorded::Peak => Cell::Number(main.map(|motion| length(motion.peak))),
        Recorded::Rms => Cell::Number(main.map(|motion| length(motion.rms))),
        Recorded::ReductionDb => {
            let both = main.zip(facts.bare);
            Cell::Number(both.map(|(motion, bare)| 20.0 * libm::log10(bare / motion.peak)))
        }
        Recorded::Efficiency => Cell::Number(main.and_then(|motion| motion.efficiency)),
        Recorded::ImpactSpeed => Cell::Number(main.map(|motion| {
            let speed = scales.velocity_m_per_s(motion.impact_speed);
            speed.unwrap_or_else(|| length(motion.impact_speed))
        })),
        Recorded::RepeatsAfter => {
            Cell::Whole(main.and_then(|motion| motion.repeats_after).map(i64::from))
        }
        Recorded::Lyapunov => Cell::Number(found.lyapunov),
        Recorded::ShareOfStarts => Cell::Number(main.map(|motion| {
            let all: u32 = found.motions.iter().map(|motion| motion.starts).sum();
            f64::from(motion.starts) / f64::from(all)
        })),
        Recorded::LargestPeak => {
            let peaks = found.motions.iter().map(|motion| motion.peak);
            Cell::Number(peaks.max_by(f64::total_cmp).map(length))
        }
        Recorded::Motions => {
            let count = found.motions.len() as i64;
            Cell::Whole((count > 0).then_some(count))
        }
        Recorded::OrbitReached => Cell::Flag(facts.orbit.as_ref().map(|orbit| {
            found.motions.iter().any(|motion| motion.is_orbit_with_peak(orbit.peaks.displacement))
        })),
        Recorded::Area | Recorded::Section => Cell::Number(None),
    }
}

/// The word that a column of words may hold, from its bytes.
pub(super) fn word(bytes: &[u8]) -> Option<&'static str> {
    let regimes = Regime::ALL.map(Regime::key).into_iter();
    let areas = Area::ALL.map(Area::key).into_iter().chain([Zone::UNSETTLED]);
    let mut all = regimes.chain(areas).chain(Strip::ALL.map(Strip::key));
    all.find(|word| word.as_bytes() == bytes)
}
