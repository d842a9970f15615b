//! Points of a structure of several modes: each is a case of its own, and has what is known of that.

use std::ops::Range;

use super::columns::{Cell, Column, Storage, push};
use super::{Grid, fewest_of};
use crate::case::{ModalCase, Of};
use crate::criteria::{Judged, together};
use crate::executor::Serial;
use crate::measure::Device;
use crate::modal::{ModalAnswer, seconds};
use crate::motions::ModalMotion;
use crate::quantity::catalogue::ROOM;
use crate::quantity::{Dimension, Kind};
use crate::simulation::Reading;
use crate::system::Parameter;

/// What is worked out at every point of a structure of several modes.
#[derive(Debug, Clone)]
pub struct ModalPlan {
    /// Its points.
    pub grid: Grid,
    case: ModalCase,
}

/// The largest displacement of any place in a motion.
fn peak(motion: &ModalMotion) -> f64 {
    let all = motion.read(Reading::Displacement).map(|one| one.peak);
    all.fold(0.0, f64::max)
}

/// The column that says whether all limits hold.
pub const LIMITS: &str = "limits";

impl ModalPlan {
    /// That of a case; `None` where it has no table `[sweep]`.
    pub fn of(case: &ModalCase) -> Option<Self> {
        let settings = &case.sweep.as_ref()?.settings;
        let mut named = case.text_hash.clone();
        named.extend(case.modes_file.iter().map(|file| file.sha256.clone()));
        let plan = Self { grid: Grid::of(settings.clone(), 1, &named), case: case.clone() };
        let grid = Grid::of(settings.clone(), fewest_of(plan.seconds()), &named);
        Some(Self { grid, ..plan })
    }

    /// About how many seconds a point takes.
    pub fn seconds(&self) -> f64 {
        let last = self.grid.points() - 1;
        let some = [0, last / 2, last].map(|number| seconds(&self.case_at(number).1));
        some.into_iter().sum::<f64>() / some.len() as f64
    }

    /// A point's place on each axis, and its case.
    fn case_at(&self, number: u64) -> (Vec<f64>, ModalCase) {
        let coordinates = self.grid.coordinates(number);
        let case = self.case.at_point(&coordinates);
        (coordinates, case)
    }

    /// Whether each point is at one frequency.
    fn at_a_frequency(&self) -> bool {
        self.grid.settings.axes.iter().any(|axis| axis.parameter == Parameter::Frequency)
    }

    /// Criteria with the names of their columns: by what they are about and their place, as those of criteria where there is a column
    /// of that name; what is asked twice has one.
    fn asked(&self) -> Vec<(usize, String)> {
        let taken: Vec<String> = self.own_columns().into_iter().map(|one| one.name).collect();
        let mut named: Vec<(usize, String)> = Vec::new();
        for (k, asked) in self.case.criteria.iter().enumerate() {
            let key = asked.key;
            let name = match asked.of {
                Of::Place(place) => format!("{key}_{}", self.case.places[place]),
                Of::Absorber(j) => format!("{key}_absorber_{}", j + 1),
                Of::Any => key.to_owned(),
            };
            let name = if taken.contains(&name) { format!("criterion_{name}") } else { name };
            if !named.iter().any(|(_, known)| *known == name) {
                named.push((k, name));
            }
        }
        named
    }

    fn number(&self, name: &str, dimension: Dimension) -> Column {
        Column::empty(name.to_owned(), dimension.symbol(!self.case.reduced), Storage::Number)
    }

    /// The columns that a sweep has without criteria, empty.
    fn own_columns(&self) -> Vec<Column> {
        let number = |name: &str, dimension: Dimension| self.number(name, dimension);
        let mut columns = vec![Column::empty("point".to_owned(), "1", Storage::Whole)];
        let axes = self
            .grid
            .settings
            .axes
            .iter()
            .map(|axis| number(axis.parameter.key(), self.case.kind(axis.parameter).dimension));
        columns.extend(axes);
        if self.at_a_frequency() {
            columns.push(number("peak", Dimension::Length));
        }
        columns.push(number("largest_peak", Dimension::Length));
        columns.push(number("error_of_largest_peak", Dimension::Length));
        columns.push(number("bare_amplitude", Dimension::Length));
        columns.push(number("reduction_db", Dimension::Level));
        match self.at_a_frequency() {
            true => columns.push(Column::empty("motions".to_owned(), "1", Storage::Whole)),
            false => columns.push(number("peak_frequency", Dimension::Frequency)),
        }
        columns
    }

    /// The columns, empty.
    pub fn empty(&self) -> Vec<Column> {
        let number = |name: &str, dimension: Dimension| self.number(name, dimension);
        let mut columns = self.own_columns();
        if !self.case.criteria.is_empty() {
            columns.push(Column::empty(LIMITS.to_owned(), "", Storage::Text));
            columns.push(number(ROOM.id, ROOM.dimension));
        }
        for (k, name) in self.asked() {
            let asked = &self.case.criteria[k];
            let kind = asked.measure.kind(Device::Absorber);
            let dimension = kind.map_or(Dimension::Number, |kind: &Kind| kind.dimension);
            columns.push(number(&name, dimension));
            columns.push(number(&format!("error_of_{name}"), dimension));
        }
        columns
    }

    /// The results of some points, in their order.
    pub fn points(&self, numbers: Range<u64>) -> Vec<Column> {
        let mut columns = self.empty();
        for number in numbers {
            let (coordinates, case) = self.case_at(number);
            // Values that are each possible may together leave no system; then nothing is known.
            let cells = ModalAnswer::of(&case, &Serial).map(|answer| self.cells(&case, &answer));
            push(&mut columns, number, &coordinates, cells.unwrap_or_default());
        }
        columns
    }

    fn cells(&self, case: &ModalCase, answer: &ModalAnswer) -> Vec<Option<Cell>> {
        let number = |value: f64| Some(Cell::Number(value));
        let Some(worst) = answer.worst(case, None).map(|worst| worst.found) else {
            return Vec::new();
        };
        let bare = answer.bare();
        let here = self.at_a_frequency().then(|| &answer.along[0].places[0]);
        let main = here.map(|here| number(peak(ModalMotion::main(&here.motions)?)));
        let mut cells: Vec<Option<Cell>> = main.into_iter().collect();
        cells.extend([
            number(worst.value),
            number(worst.error),
            number(bare),
            // What is certain of it.
            number(20.0 * libm::log10(bare / worst.most())),
            here.map_or_else(
                || worst.at.map(Cell::Number),
                |here| number(here.counting().count() as f64),
            ),
        ]);
        if let Some(outcome) = together(&answer.judged) {
            cells.push(Some(Cell::Text(outcome.name())));
            let room = |one: &Judged| {
                // Yes and no have no room.
                one.criterion.measure.kind(Device::Absorber)?;
                Some((one.margin? - one.error) / one.criterion.scale())
            };
            let rooms = answer.judged.iter().filter_map(room);
            cells.push(rooms.min_by(f64::total_cmp).map(Cell::Number));
        }
        for one in self.asked().into_iter().filter_map(|(k, _)| answer.judged.get(k)) {
            cells.extend([one.found.map(Cell::Number), number(one.error)]);
        }
        cells
    }
}
