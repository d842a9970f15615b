//! Maps over two axes; several side by side where there are more axes, or motions were followed up and down.

use super::super::AxisShown;
use super::super::grid::{Grid, Plane, SweepDirection};
use super::super::kinds::{self, AREAS, COUNTS};
use super::overlay::{self, Overlay};
use crate::regimes::Regime;
use crate::report::figure::{
    Axis, Cell, Cells, Figure, Image, Layer, Layout, Panel, Ramp, Scale, Tint,
};

/// At most so many maps in a figure.
const MOST_PANELS: usize = 6;
/// This part of the values, at either end, may have the colour of the nearest that counts.
const OUTLYING: f64 = 0.005;
/// Cells of the bar beside a map.
const BAR: u32 = 128;

/// Panels of a figure: slices of the other axes, or passes.
struct Panels<'a> {
    grid: &'a Grid<'a>,
    plane: Plane<'a>,
    shown: Vec<(usize, SweepDirection)>,
}

/// What the cells of a panel hold.
type Content<'a> = dyn Fn(usize, SweepDirection) -> Option<Cells> + 'a;

/// What a kind of map is.
struct Map<'a> {
    name: &'static str,
    title: String,
    content: &'a Content<'a>,
    keys: Vec<(Tint, String)>,
    /// Ramp, range and label of the bar.
    bar: Option<(Ramp, (f64, f64), String)>,
    names: bool,
    caption: String,
}

pub(super) fn all(grid: &Grid) -> Vec<Figure> {
    let Some(plane) = grid.plane() else { return Vec::new() };
    let panels = Panels::of(grid, plane);
    let mut figures = Vec::new();
    figures.extend(panels.regimes());
    figures.extend(panels.areas());
    let length = format!("({})", grid.lengths.unit);
    figures.extend(panels.values("sweep-reduction", "reduction_db", Ramp::Diverging));
    figures.extend(panels.values("sweep-amplitude", &format!("peak {length}"), Ramp::Sequential));
    figures.extend(panels.motions());
    figures.extend(panels.values("sweep-efficiency", "efficiency", Ramp::Sequential));
    figures.extend(panels.values("sweep-lyapunov", "lyapunov", Ramp::Diverging));
    figures
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

impl<'a> Panels<'a> {
    fn of(grid: &'a Grid<'a>, plane: Plane<'a>) -> Self {
        let passes = grid.passes();
        let slices = chosen(grid.slices(), MOST_PANELS / passes.len());
        let shown =
            slices.iter().flat_map(|slice| passes.iter().map(|pass| (*slice, *pass))).collect();
        Self { grid, plane, shown }
    }

    fn heading(&self, slice: usize, pass: SweepDirection) -> Option<String> {
        let words = [self.grid.slice_words(slice), pass.words().to_owned()];
        let words: Vec<String> = words.into_iter().filter(|words| !words.is_empty()).collect();
        (!words.is_empty()).then(|| words.join(", "))
    }

    /// What a map is over, for its title.
    fn over(&self) -> String {
        format!("over {} and {}", self.plane.x.name, self.plane.y.name)
    }

    /// What a reader must know of the choice of panels.
    fn choice(&self) -> String {
        let (slices, passes) = (self.grid.slices(), self.grid.passes().len());
        let shown = self.shown.len() / passes;
        let others = self.grid.swept.axes.len().saturating_sub(2);
        let names: Vec<&str> =
            self.grid.swept.axes[..others].iter().map(|axis| axis.name.as_str()).collect();
        match names.is_empty() {
            true => String::new(),
            false if shown == slices => format!("One panel for each {}.", names.join(" and ")),
            false => {
                format!(
                    "{shown} of {slices} values of {} are shown, evenly chosen.",
                    names.join(" and ")
                )
            }
        }
    }

    fn figure(&self, map: &Map) -> Option<Figure> {
        let mut panels = Vec::new();
        let mut words = "";
        let columns = columns(self.shown.len());
        let (x_edges, y_edges) = (self.plane.x.edges(), self.plane.y.edges());
        for (index, (slice, pass)) in self.shown.iter().enumerate() {
            let cells = (map.content)(*slice, *pass)?;
            let drawn =
                |axis: &AxisShown, edges: &[f64]| axis.drawn(edges[0], edges[edges.len() - 1]);
            let x = drawn(self.plane.x, &x_edges);
            let mut y = drawn(self.plane.y, &y_edges);
            if index % columns > 0 {
                y.label.clear();
            }
            let image = Image { x_edges: x_edges.clone(), y_edges: y_edges.clone(), cells };
            let mut panel = Panel::new(x, y).with(Layer::Image(image));
            if !self.grid.is_basin() {
                let Overlay { layers, words: said } =
                    overlay::boundaries(self.grid, self.plane, *slice, self.shown.len() == 1);
                panel.layers.extend(layers);
                if !said.is_empty() {
                    words = said;
                }
                if map.names {
                    panel
                        .layers
                        .extend(overlay::area_names(self.grid, self.plane, *slice, columns));
                }
                if self.grid.slices() == 1 {
                    panel.layers.extend(overlay::this_case(self.plane));
                }
            }
            panel.heading = self.heading(*slice, *pass);
            panels.push(panel);
        }
        let caption: Vec<&str> = [map.caption.as_str(), words].into_iter().collect();
        let choice = self.choice();
        let caption: Vec<&str> =
            caption.into_iter().chain([choice.as_str()]).filter(|one| !one.is_empty()).collect();
        let caption = caption.join(" ");
        let alt = format!("{}. {caption}", map.title);
        let rows = panels.len().div_ceil(columns);
        let size = match (columns, rows) {
            (1, _) => (720, 500),
            (2, 1) => (880, 430),
            (2, _) => (880, 760),
            (_, rows) => (900, 120 + 260 * rows as u32),
        };
        let mut figure = Figure::new(map.name, map.title.clone())
            .with_size(size.0, size.1)
            .with_words(caption, alt);
        for (tint, label) in &map.keys {
            figure = figure.with_key(*tint, label.clone());
        }
        let mut cells: Vec<Cell> = (0..panels.len())
            .map(|k| Cell { column: k % columns, row: k / columns, columns: 1, rows: 1 })
            .collect();
        figure.panels = panels;
        let mut widths = vec![1.0; columns];
        if let Some((ramp, range, label)) = &map.bar {
            figure.panels.push(bar(*ramp, *range, label));
            cells.push(Cell { column: columns, row: 0, columns: 1, rows });
            widths.push(0.11 * columns as f64);
        }
        Some(figure.with_layout(Layout::Cells { widths, heights: vec![1.0; rows], cells }))
    }

    fn regimes(&self) -> Option<Figure> {
        let of = |pass| self.grid.regimes(pass);
        let all: Vec<(SweepDirection, Vec<Option<Regime>>)> =
            self.grid.passes().into_iter().filter_map(|pass| Some((pass, of(pass)?))).collect();
        let content = |slice: usize, pass: SweepDirection| {
            let (_, regimes) = all.iter().find(|(of, _)| *of == pass)?;
            let cells = self.plane.cells(regimes, slice);
            let cells = cells.iter().map(|regime| Some((*regime)?.index() as u8)).collect();
            Some(Cells::Kinds(Regime::ALL.map(kinds::tint).to_vec(), cells))
        };
        let present =
            |regime: &Regime| all.iter().any(|(_, regimes)| regimes.contains(&Some(*regime)));
        let mut keys: Vec<(Tint, String)> = Regime::ALL
            .into_iter()
            .filter(present)
            .map(|regime| (kinds::tint(regime), regime.words().to_owned()))
            .collect();
        if all.iter().any(|(_, regimes)| regimes.contains(&None)) {
            keys.push((Tint::UNKNOWN, "not worked out".to_owned()));
        }
        let (title, caption) = if self.grid.is_basin() {
            (
                format!("Basins of attraction {}", self.over()),
                "Each point is a start; its colour is the regime that it leads to.".to_owned(),
            )
        } else {
            (
                format!("Regimes {}", self.over()),
                "The colour is the regime of the main motion, as simulated; where it changes elsewhere than at the lines, simulation and \
                 theory differ, or other motions exist beside it."
                    .to_owned(),
            )
        };
        self.figure(&Map {
            name: "sweep-regimes",
            title,
            content: &content,
            keys,
            bar: None,
            names: true,
            caption,
        })
    }

    /// The theory's areas, where nothing was simulated to set beside them.
    fn areas(&self) -> Option<Figure> {
        if self.grid.passes().iter().any(|pass| self.grid.regimes(*pass).is_some()) {
            return None;
        }
        let areas = self.grid.text("area", SweepDirection::Single)?;
        let content = |slice: usize, _: SweepDirection| {
            let index = |name: &str| AREAS.iter().position(|(area, _)| *area == name);
            let cells = self.plane.cells(areas, slice);
            let cells = cells.iter().map(|area| Some(index((*area)?)? as u8)).collect();
            Some(Cells::Kinds(AREAS.map(|(_, tint)| tint).to_vec(), cells))
        };
        let present = AREAS.iter().filter(|(area, _)| areas.contains(&Some(*area)));
        self.figure(&Map {
            name: "sweep-areas",
            title: format!("Areas of the theory {}", self.over()),
            content: &content,
            keys: present
                .map(|(area, tint)| (*tint, format!("area {}", kinds::area_words(area))))
                .collect(),
            bar: None,
            names: false,
            caption: "The colour is the theory's area, by closed form; nothing was simulated."
                .to_owned(),
        })
    }

    /// A quantity on a ramp; nothing where it is not recorded.
    fn values(&self, name: &'static str, column: &str, ramp: Ramp) -> Option<Figure> {
        let of = |pass: SweepDirection| match column {
            "reduction_db" | "efficiency" | "lyapunov" => self.grid.number(column, pass),
            _ => self.grid.length("peak", pass),
        };
        let all: Vec<(SweepDirection, Vec<Option<f64>>)> =
            self.grid.passes().into_iter().filter_map(|pass| Some((pass, of(pass)?))).collect();
        let shown = self.shown.iter().flat_map(|(slice, pass)| {
            let here = all.iter().find(|(of, _)| of == pass);
            here.map(|(_, values)| self.plane.cells(values, *slice)).unwrap_or_default()
        });
        let (range, cut) = range(shown.flatten().collect())?;
        let content = |slice: usize, pass: SweepDirection| {
            let (_, values) = all.iter().find(|(of, _)| *of == pass)?;
            Some(Cells::Values(ramp, range, self.plane.cells(values, slice)))
        };
        let (what, label, caption) = match column {
            "reduction_db" => (
                "Reduction of the peak",
                "reduction (dB)".to_owned(),
                "Blue: the main motion vibrates less than the oscillator alone; orange: more.",
            ),
            "efficiency" => (
                "Efficiency of the targeted energy transfer",
                "efficiency (1)".to_owned(),
                "The share of the excitation's work that impacts dissipate, in the main motion.",
            ),
            "lyapunov" => (
                "Largest Lyapunov exponent",
                "exponent per period (1)".to_owned(),
                "Blue, above 0: neighbouring motions part, the main motion is chaotic; orange: they approach.",
            ),
            _ => (
                "Peak displacement",
                format!("peak displacement ({})", self.grid.lengths.unit),
                "The largest displacement of the oscillator in the main motion: dark is large.",
            ),
        };
        let mut caption = caption.to_owned();
        if cut {
            caption = format!(
                "{caption} The most extreme values, at most 1 % of the points, have the colour of the bar's ends."
            );
        }
        let unknown = all.iter().any(|(_, values)| values.contains(&None));
        self.figure(&Map {
            name,
            title: format!("{what} {}", self.over()),
            content: &content,
            keys: unknown.then(|| (Tint::UNKNOWN, "no value".to_owned())).into_iter().collect(),
            bar: Some((ramp, range, label)),
            names: false,
            caption,
        })
    }

    /// How many motions there are; nothing where one is all that could be found.
    fn motions(&self) -> Option<Figure> {
        if self.grid.swept.starts < 2 && !self.grid.is_basin() {
            return None;
        }
        let motions = self.grid.number("motions", SweepDirection::Single)?;
        let most = COUNTS.len() - 1;
        let kind = |count: f64| (count.max(0.0) as usize).min(most);
        let content = |slice: usize, _: SweepDirection| {
            let cells = self.plane.cells(&motions, slice);
            let cells = cells.iter().map(|count| Some(kind((*count)?) as u8)).collect();
            Some(Cells::Kinds(COUNTS.to_vec(), cells))
        };
        let mut present = [false; COUNTS.len()];
        motions.iter().flatten().for_each(|count| present[kind(*count)] = true);
        if present.iter().skip(2).all(|one| !one) {
            return None;
        }
        let words = |k: usize| match k {
            0 => "none measured".to_owned(),
            1 => "one motion".to_owned(),
            k if k == most => format!("{k} or more"),
            k => k.to_string(),
        };
        self.figure(&Map {
            name: "sweep-motions",
            title: format!("Coexisting motions {}", self.over()),
            content: &content,
            keys: (0..COUNTS.len())
                .filter(|k| present[*k])
                .map(|k| (COUNTS[k], words(k)))
                .collect(),
            bar: None,
            names: false,
            caption: "Where starts lead to more than one motion it depends on the past which of them is there.".to_owned(),
        })
    }
}

fn columns(panels: usize) -> usize {
    match panels {
        0..=2 => panels.max(1),
        4 => 2,
        _ => 3,
    }
}

/// The range of a ramp, and whether some values lie beyond it.
fn range(mut values: Vec<f64>) -> Option<((f64, f64), bool)> {
    values.sort_by(f64::total_cmp);
    let (first, last) = (*values.first()?, *values.last()?);
    let drop = (values.len() as f64 * OUTLYING).floor() as usize;
    let (low, high) = (values[drop], values[values.len() - 1 - drop]);
    // Only what would take more than half as much room again is cut.
    let far = 0.5 * (high - low);
    let low = if low - first > far { low } else { first };
    let high = if last - high > far { high } else { last };
    let cut = low > first || high < last;
    if high - low > 1e-9 * high.abs().max(low.abs()) {
        return Some(((low, high), cut));
    }
    let half = if low == 0.0 { 1.0 } else { 0.05 * low.abs() };
    Some(((low - half, high + half), cut))
}

/// The bar that says what the colours of a ramp mean.
fn bar(ramp: Ramp, (low, high): (f64, f64), label: &str) -> Panel {
    let part = |k: f64| low + (high - low) * k / f64::from(BAR);
    let cells = (0..BAR).map(|k| Some(part(f64::from(k) + 0.5))).collect();
    let image = Image {
        x_edges: vec![0.0, 1.0],
        y_edges: (0..=BAR).map(|k| part(f64::from(k))).collect(),
        cells: Cells::Values(ramp, (low, high), cells),
    };
    let x = Axis::linear("").with_range(0.0, 1.0).with_ticks(Vec::new());
    let y = Axis { scale: Scale::Linear, ..Axis::linear(label).with_range(low, high) };
    Panel::new(x, y).with(Layer::Image(image))
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
