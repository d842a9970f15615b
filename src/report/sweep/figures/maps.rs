//! Maps over two axes; several side by side where there are more axes, or motions were followed up and down.

use serde_json::json;

use super::super::Swept;
use super::super::grid::{self, Plane};
use super::super::kinds::{AREAS, COUNTS, OUTCOMES};
use super::QUANTITIES;
use super::overlay::{self, Lines};
use crate::case::Recorded;
use crate::criteria::Outcome;
use crate::regimes::Regime;
use crate::report::figure::{
    Axis, Cells, Figure, GridCell, Image, Key, Layer, Layout, Panel, Ramp, Tint, inliers,
};
use crate::report::figures::regimes::tint;
use crate::sweep::columns::Direction;

/// At most so many maps in a figure.
const MOST_PANELS: usize = 6;
/// This part of the values, at either end, may have the colour of the nearest that counts.
const OUTLYING: f64 = 0.005;
/// Cells of the bar beside a map.
const BAR: u32 = 128;
/// The template of the figures' words.
const WORDS: &str = "captions/sweep-map";

/// A kind of map: its cells at all points, for each direction that has them.
struct Map {
    name: &'static str,
    /// What the template calls it: `regimes`, `areas`, or the id of a quantity.
    of: &'static str,
    cells: Vec<(Direction, Cells)>,
    keys: Vec<Key>,
    /// The axis of the bar beside a map of values, and whether some lie beyond its range.
    bar: Option<(Axis, bool)>,
}

/// Panels of a figure: slices of the other axes, or directions.
struct Panels<'a> {
    swept: &'a Swept<'a>,
    plane: Plane<'a>,
    shown: Vec<(usize, Direction)>,
}

pub(super) fn all(swept: &Swept) -> Vec<Figure> {
    let Some(plane) = swept.plane() else { return Vec::new() };
    let directions = swept.directions();
    let slices = chosen(swept.slices(), MOST_PANELS / directions.len());
    let both = |slice: &usize| directions.iter().map(|way| (*slice, *way)).collect::<Vec<_>>();
    let panels = Panels { swept, plane, shown: slices.iter().flat_map(both).collect() };
    let first = regimes(swept).or_else(|| areas(swept)).or_else(|| limits(swept));
    let mut maps: Vec<Map> = first.into_iter().collect();
    maps.extend(QUANTITIES.iter().filter_map(|(name, of, ramp)| panels.values(name, *of, *ramp)));
    maps.dedup_by(|next, before| next.name == before.name);
    maps.extend(motions(swept));
    maps.iter().filter_map(|map| panels.figure(map)).collect()
}

/// So many of `count` numbers, evenly spread, the first and the last among them.
fn chosen(count: usize, most: usize) -> Vec<usize> {
    if count <= most {
        return (0..count).collect();
    }
    if most < 2 {
        return vec![0];
    }
    // Rounded to the nearest.
    (0..most).map(|k| (2 * k * (count - 1) + (most - 1)) / (2 * (most - 1))).collect()
}

/// A map of kinds, of which those that occur are in the key.
fn kinds(
    name: &'static str,
    of: &'static str,
    table: &[(Tint, &'static str)],
    indices: Vec<(Direction, Vec<Option<usize>>)>,
) -> Option<Map> {
    let has = |k: usize| indices.iter().any(|(_, all)| all.contains(&Some(k)));
    let keys = (0..table.len()).filter(|k| has(*k)).map(|k| Key::from(table[k])).collect();
    let tints: Vec<Tint> = table.iter().map(|(tint, _)| *tint).collect();
    let cells = indices.into_iter().map(|(way, all)| {
        let all = all.into_iter().map(|index| index.map(|index| index as u8));
        (way, Cells::Kinds(tints.clone(), all.collect()))
    });
    let cells: Vec<_> = cells.collect();
    (!cells.is_empty()).then_some(Map { name, of, cells, keys, bar: None })
}

fn regimes(swept: &Swept) -> Option<Map> {
    let of = |way: Direction| {
        let regimes = swept.regimes(way)?.into_iter();
        Some((way, regimes.map(|regime| regime.map(Regime::index)).collect::<Vec<_>>()))
    };
    let all: Vec<_> = swept.directions().into_iter().filter_map(of).collect();
    let unknown = all.iter().any(|(_, regimes)| regimes.contains(&None));
    let table = Regime::ALL.map(|regime| (tint(regime), regime.words()));
    let mut map = kinds("sweep-regimes", "regimes", &table, all)?;
    map.keys.extend(unknown.then(|| Key::from((Tint::UNKNOWN, "not worked out"))));
    Some(map)
}

/// The theory's areas, where nothing was simulated to set beside them.
fn areas(swept: &Swept) -> Option<Map> {
    let index = |name: &'static str| AREAS.iter().position(|(area, _)| *area == name);
    let indices = swept.areas()?.into_iter().map(|area| area.and_then(index)).collect();
    let table = AREAS.map(|(area, tint)| (tint, area));
    kinds("sweep-areas", "areas", &table, vec![(swept.directions()[0], indices)])
}

/// What all limits come to; nothing where that is the same everywhere.
fn limits(swept: &Swept) -> Option<Map> {
    let outcomes = swept.outcomes()?;
    outcomes.iter().find(|one| **one != outcomes[0])?;
    let index = |one: Outcome| Outcome::ALL.iter().position(|other| *other == one);
    let indices = outcomes.into_iter().map(|one| one.and_then(index)).collect();
    kinds("sweep-limits", "limits", &OUTCOMES, vec![(Direction::Single, indices)])
}

/// How many motions there are; nothing where one is all that could be found.
fn motions(swept: &Swept) -> Option<Map> {
    if swept.starts < 2 && !swept.is_basin() {
        return None;
    }
    let motions = swept.numbers(Recorded::Motions, Direction::Single)?;
    let index = |count: f64| (count.max(0.0) as usize).min(COUNTS.len() - 1);
    let indices: Vec<_> = motions.iter().map(|count| count.map(index)).collect();
    let several = indices.iter().flatten().any(|index| *index > 1);
    several
        .then(|| kinds("sweep-motions", "motions", &COUNTS, vec![(Direction::Single, indices)]))?
}

impl Panels<'_> {
    /// A quantity on a ramp; nothing where it is not recorded.
    fn values(&self, name: &'static str, of: Recorded, ramp: Ramp) -> Option<Map> {
        let all = self.swept.in_directions(of);
        let axis = self.swept.axis_of(of.kind()?, all.iter().map(|(_, one)| one));
        let shown = self.shown.iter().flat_map(|(slice, way)| {
            let here = all.iter().find(|(of, _)| of == way);
            here.map(|(_, values)| self.plane.cells(values, *slice)).unwrap_or_default()
        });
        let (range, cut) = range(shown.flatten().collect())?;
        let unknown = all.iter().any(|(_, values)| values.contains(&None));
        let cells = all.into_iter().map(|(way, values)| (way, Cells::Values(ramp, range, values)));
        Some(Map {
            name,
            of: of.kind()?.id,
            cells: cells.collect(),
            keys: unknown.then(|| Key::from((Tint::UNKNOWN, "no value"))).into_iter().collect(),
            bar: Some((axis, cut)),
        })
    }

    /// The maps row by row, in a size that they have room in, and the bar beside maps of values.
    fn figure(&self, map: &Map) -> Option<Figure> {
        let count = self.shown.len();
        let columns = match count {
            0..=2 => count.max(1),
            4 => 2,
            _ => 3,
        };
        let rows = count.div_ceil(columns);
        let (width, height) = match (columns, rows) {
            (1, _) => (720, 500),
            (2, 1) => (880, 430),
            (2, _) => (880, 760),
            (_, rows) => (900, 120 + 260 * rows as u32),
        };
        let mut figure = Figure::new(map.name, "").with_size(width, height);
        let (mut cells, mut widths) = (Vec::new(), vec![1.0; columns]);
        let mut lines = Lines::default();
        for (index, (slice, way)) in self.shown.iter().enumerate() {
            let (_, of_way) = map.cells.iter().find(|(of, _)| of == way)?;
            let (mut panel, drawn) = self.panel(of_way, *slice, *way, map.of == "regimes", columns);
            let (column, row) = (index % columns, index / columns);
            if column > 0 {
                panel.y.label.clear();
            }
            lines = drawn;
            figure.panels.push(panel);
            cells.push(GridCell { column, row, columns: 1, rows: 1 });
        }
        if let Some(bar) = bar(map) {
            figure.panels.push(bar);
            cells.push(GridCell { column: columns, row: 0, columns: 1, rows });
            widths.push(0.11 * columns as f64);
        }
        figure.keys.clone_from(&map.keys);
        let facts = json!({
            "of": map.of, "steady": self.swept.is_steady(), "several": self.swept.is_of_several(), "basin": self.swept.is_basin(), "lines": lines,
            "x": self.plane.x.kind.id, "y": self.plane.y.kind.id,
            "x_ends": self.plane.x.ends(), "y_ends": self.plane.y.ends(),
            "cut": map.bar.as_ref().is_some_and(|(_, cut)| *cut),
            "others": self.swept.others().iter().map(|axis| axis.kind.id).collect::<Vec<_>>(),
            "slices": self.swept.slices(), "shown": count / self.swept.directions().len(),
        });
        let layout = Layout { widths, heights: vec![1.0; rows], cells };
        Some(figure.with_layout(layout).with_facts(WORDS, facts))
    }

    /// One map with what lies over it.
    fn panel(
        &self,
        cells: &Cells,
        slice: usize,
        way: Direction,
        named: bool,
        columns: usize,
    ) -> (Panel, Lines) {
        let Plane { x, y, .. } = self.plane;
        let cells = match cells {
            Cells::Kinds(tints, all) => Cells::Kinds(tints.clone(), self.plane.cells(all, slice)),
            Cells::Values(ramp, range, all) => {
                Cells::Values(*ramp, *range, self.plane.cells(all, slice))
            }
        };
        let image = Image { x_edges: x.edges(), y_edges: y.edges(), cells };
        let mut panel = Panel::new(x.drawn(), y.drawn()).with(Layer::Image(image));
        let mut words = self.swept.slice_words(slice);
        words.extend((way != Direction::Single).then(|| grid::words(way).to_owned()));
        panel.heading = (!words.is_empty()).then(|| words.join(", "));
        if self.swept.is_basin() {
            return (panel, Lines::default());
        }
        let (layers, lines) =
            overlay::boundaries(self.swept, self.plane, slice, self.shown.len() == 1);
        panel.layers.extend(layers);
        if named {
            panel.layers.extend(overlay::area_names(self.swept, self.plane, slice, columns));
        }
        if let (1, Some(x), Some(y)) = (self.swept.slices(), x.own_within(), y.own_within()) {
            panel.layers.push(Layer::this_case([x, y], None));
        }
        (panel, lines)
    }
}

/// What the colours of a map of values mean.
fn bar(map: &Map) -> Option<Panel> {
    let (axis, _) = map.bar.as_ref()?;
    let (_, Cells::Values(ramp, (low, high), _)) = map.cells.first()? else { return None };
    let part = |k: f64| low + (high - low) * k / f64::from(BAR);
    let cells = (0..BAR).map(|k| Some(part(f64::from(k) + 0.5))).collect();
    let image = Image {
        x_edges: vec![0.0, 1.0],
        y_edges: (0..=BAR).map(|k| part(f64::from(k))).collect(),
        cells: Cells::Values(*ramp, (*low, *high), cells),
    };
    let x = Axis::of_ticks((0.0, 1.0), Vec::new());
    Some(Panel::new(x, axis.clone().with_range(*low, *high)).with(Layer::Image(image)))
}

/// The range of a ramp, and whether some values lie beyond it.
fn range(mut values: Vec<f64>) -> Option<((f64, f64), bool)> {
    values.sort_by(f64::total_cmp);
    // Only what would take more than half as much room again is cut.
    let [low, high] = inliers(&values, OUTLYING, 0.5)?;
    let cut = low > values[0] || high < values[values.len() - 1];
    if high - low > 1e-9 * high.abs().max(low.abs()) {
        return Some(((low, high), cut));
    }
    let half = if low == 0.0 { 1.0 } else { 0.05 * low.abs() };
    Some(((low - half, high + half), cut))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_are_chosen_evenly_with_both_ends() {
        assert_eq!(chosen(4, 6), [0, 1, 2, 3]);
        assert_eq!(chosen(11, 6), [0, 2, 4, 6, 8, 10]);
        assert_eq!(chosen(100, 3), [0, 50, 99]);
        assert_eq!(chosen(7, 1), [0]);
    }

    #[test]
    fn a_few_outliers_do_not_decide_a_range() {
        let mut values: Vec<f64> = (0..1000).map(|k| f64::from(k) / 1000.0).collect();
        assert_eq!(range(values.clone()), Some(((0.0, 0.999), false)));
        values.push(1e6);
        let ((low, high), cut) = range(values).expect("values");
        assert!(low == 0.0 && high < 1.0 && cut, "{low} {high}");
        assert_eq!(range(vec![2.0, 2.0]), Some(((1.9, 2.1), false)));
        assert_eq!(range(Vec::new()), None);
    }
}
