//! Where the panels are: margins adapt to the words, so that nothing is cut.

use std::collections::BTreeMap;

use super::data::{Axis, Cell, Figure, Layout, Panel, Scale, Tick};
use super::geometry::Rect;
use super::layers::Layer;
use super::limits::{Span, Spans, spans};
use super::render::FigureError;
use super::text::{self, LARGE, SMALL, width, wrap};
use super::ticks::ticks;

/// From the plot to the nearest tick label, pixels.
pub(super) const TICK: f64 = 9.0;
/// From one line of words to the next, pixels.
pub(super) const LINE: f64 = 18.0;
/// Height of a row of the legend, pixels.
pub(super) const LEGEND: f64 = 20.0;
/// Width of a legend's sample of line or marker, pixels.
const SWATCH: f64 = 28.0;
const MARKER: f64 = 10.0;
/// Width of a key's sample, pixels.
pub(super) const KEY: f64 = 20.0;
/// The part of a figure's width over which keys run, and how far from the left they begin at most.
const KEYS: f64 = 0.86;
pub(super) const KEYS_FROM: f64 = 0.11;
/// From the sample to its words, pixels.
pub(super) const GAP: f64 = 6.0;
/// Between two entries of a legend, pixels.
const BETWEEN: f64 = 18.0;
/// The least plot, pixels.
const LEAST: f64 = 40.0;

/// A panel in its place.
#[derive(Debug, Clone)]
pub(super) struct Frame {
    /// The rectangle of the data.
    pub plot: Rect,
    pub spans: Spans,
    pub x_ticks: Vec<Tick>,
    pub y_ticks: Vec<Tick>,
    /// Whether the horizontal axis has words, or leaves them to a panel below.
    pub x_words: bool,
    pub x_label: Vec<String>,
    pub y_label: Vec<String>,
    pub heading: Option<String>,
    /// Room for the words of the vertical ticks, the same for all panels of a column, pixels.
    pub tick_room: f64,
    /// Room for legends below the headings, the same for all panels of a row, pixels.
    pub legend_room: f64,
    /// Layers and the left middle of their legend entries, relative to the plot's top left.
    pub legend: Vec<(usize, [f64; 2])>,
}

impl Frame {
    /// From an abscissa to pixels; NaN where it cannot be drawn.
    pub(super) fn across(&self, x: f64) -> f64 {
        self.plot.left + self.spans.x.part(x) * self.plot.width()
    }

    /// From an ordinate to pixels; NaN where it cannot be drawn.
    pub(super) fn up(&self, y: f64) -> f64 {
        self.plot.bottom - self.spans.y.part(y) * self.plot.height()
    }

    /// From data to pixels.
    pub(super) fn map(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.across(x), self.up(y)]
    }
}

/// The grid that a layout stands for.
struct Grid {
    widths: Vec<f64>,
    heights: Vec<f64>,
    cells: Vec<Cell>,
}

fn grid(figure: &Figure) -> Result<Grid, FigureError> {
    let even = vec![1.0; figure.panels.len()];
    let layout = match &figure.layout {
        Layout::Row => &Layout::columns(&even),
        Layout::Column => &Layout::rows(&even),
        cells => cells,
    };
    let Layout::Cells { widths, heights, cells } = layout.clone() else {
        unreachable!("rows and columns are cells")
    };
    let wrong = |reason: String| Err(FigureError::new(&figure.name, reason));
    if cells.len() != figure.panels.len() {
        let panels = figure.panels.len();
        return wrong(format!("{panels} panels, but {} cells for them", cells.len()));
    }
    if let Some(w) = widths.iter().chain(&heights).find(|w| !(**w > 0.0 && **w < 1e6)) {
        return wrong(format!("a relative width or height is {w}, expected above 0"));
    }
    let fits = |c: &Cell| {
        c.column + c.columns <= widths.len()
            && c.row + c.rows <= heights.len()
            && c.columns * c.rows > 0
    };
    if let Some(i) = cells.iter().position(|cell| !fits(cell)) {
        return wrong(format!("the cell of panel {i} is empty or outside the grid"));
    }
    Ok(Grid { widths, heights, cells })
}

/// Panels one above the other with the same horizontal axis.
fn shared(figure: &Figure, grid: &Grid) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (i, cell) in grid.cells.iter().enumerate() {
        let same = |k: usize| {
            let (a, b, other) = (&figure.panels[i].x, &figure.panels[k].x, grid.cells[k]);
            let column = (cell.column, cell.columns) == (other.column, other.columns);
            column && a.label == b.label && a.scale == b.scale && a.range == b.range
        };
        match groups.iter_mut().find(|group| same(group[0])) {
            Some(group) => group.push(i),
            None => groups.push(vec![i]),
        }
    }
    groups
}

/// Lays the panels out. `legends` lists, for each panel, the layers named above it.
pub(super) fn lay_out(figure: &Figure, legends: &[Vec<usize>]) -> Result<Vec<Frame>, FigureError> {
    if figure.panels.is_empty() {
        return Err(FigureError::new(&figure.name, "has no panels; add one with `with_panel`"));
    }
    let grid = grid(figure)?;
    let groups = shared(figure, &grid);
    let spans = spans(figure, &groups)?;
    let lowest = |i: usize| {
        let row = grid.cells[i].row;
        !groups.iter().any(|g| g.contains(&i) && g.iter().any(|&k| grid.cells[k].row > row))
    };
    let [width, height] = [figure.size.0, figure.size.1].map(f64::from);
    let above = keys_room(figure);
    let height = height - above;
    let mut frames: Vec<Frame> = (0..figure.panels.len())
        .map(|i| {
            let [columns, rows] = [grid.widths.len(), grid.heights.len()].map(|n| n as f64);
            let plot = Rect::new(0.0, 0.0, 0.8 * width / columns, 0.8 * height / rows);
            dress(&figure.panels[i], plot, spans[i], lowest(i), &legends[i])
        })
        .collect();
    // Words decide margins, margins decide plots, plots decide ticks, hence words: settles at once
    // or alternates between two; a fixed number of rounds ends with plots that fit their words.
    for _ in 0..4 {
        let plots = plots(&grid, &frames, width, height);
        for (i, mut plot) in plots.into_iter().enumerate() {
            (plot.top, plot.bottom) = (plot.top + above, plot.bottom + above);
            if !(plot.width() >= LEAST && plot.height() >= LEAST) {
                let (width, height) = (plot.width(), plot.height());
                let reason = format!(
                    "panel {i} is left with {width:.0} x {height:.0} pixels; enlarge the figure"
                );
                return Err(FigureError::new(&figure.name, reason));
            }
            let plot = if figure.panels[i].equal_aspect { equal(plot, &spans[i]) } else { plot };
            frames[i] = dress(&figure.panels[i], plot, spans[i], lowest(i), &legends[i]);
        }
        align(&grid, &mut frames);
    }
    Ok(frames)
}

/// Gives the vertical axes of a column their words at the same distance, and the panels of a row
/// their headings at the same height.
fn align(grid: &Grid, frames: &mut [Frame]) {
    let share =
        |frames: &mut [Frame], track: fn(&Cell) -> usize, room: fn(&mut Frame) -> &mut f64| {
            let mut largest: BTreeMap<usize, f64> = BTreeMap::new();
            for (cell, frame) in grid.cells.iter().zip(frames.iter_mut()) {
                let most = largest.entry(track(cell)).or_default();
                *most = most.max(*room(frame));
            }
            for (cell, frame) in grid.cells.iter().zip(frames) {
                *room(frame) = largest[&track(cell)];
            }
        };
    share(frames, |cell| cell.column, |frame| &mut frame.tick_room);
    share(frames, |cell| cell.row, |frame| &mut frame.legend_room);
}

/// The plot, made smaller so that one unit is equally long on both axes.
fn equal(plot: Rect, spans: &Spans) -> Rect {
    let size = |s: &Span| match s.scale {
        Scale::Linear => s.last - s.first,
        Scale::Log => libm::log10(s.last / s.first),
    };
    let (sx, sy) = (size(&spans.x), size(&spans.y));
    let unit = (plot.width() / sx).min(plot.height() / sy);
    Rect::around(plot.center(), unit * sx, unit * sy)
}

/// Ticks and words for a plot.
fn dress(panel: &Panel, plot: Rect, spans: Spans, x_words: bool, legend: &[usize]) -> Frame {
    let y_ticks = fitting(&panel.y, &spans.y, plot.height(), plot.height() / 40.0, true);
    let places = legend_places(panel, legend, plot.width());
    Frame {
        x_ticks: fitting(&panel.x, &spans.x, plot.width(), plot.width() / 68.0, false),
        x_label: lines(&panel.x.label, plot.width() + 40.0),
        y_label: lines(&panel.y.label, plot.height() + 8.0),
        heading: panel.heading.clone(),
        tick_room: y_ticks.iter().map(|tick| width(tick.words(), SMALL)).fold(0.0, f64::max),
        legend_room: legend_room(&places),
        legend: places,
        y_ticks,
        plot,
        spans,
        x_words,
    }
}

/// The lines of an axis' words; none where it has none.
fn lines(label: &str, limit: f64) -> Vec<String> {
    if label.is_empty() { Vec::new() } else { wrap(label, LARGE, limit) }
}

/// As many ticks as the axis has room for.
fn fitting(axis: &Axis, span: &Span, length: f64, most: f64, ordinate: bool) -> Vec<Tick> {
    let extent = |tick: &Tick| if ordinate { SMALL } else { width(tick.words(), SMALL) };
    let gap = if ordinate { 4.0 } else { 9.0 };
    let free = |a: &Tick, b: &Tick| {
        let distance = (span.part(b.value) - span.part(a.value)).abs() * length;
        distance >= f64::midpoint(extent(a), extent(b)) + gap
    };
    if let Some(given) = &axis.ticks {
        let mut kept: Vec<Tick> = Vec::new();
        for tick in given.iter().filter(|t| (-1e-9..=1.0 + 1e-9).contains(&span.part(t.value))) {
            let clear = kept.iter().filter(|other| other.label.is_some()).all(|o| free(o, tick));
            kept.push(Tick { value: tick.value, label: tick.label.clone().filter(|_| clear) });
        }
        return kept;
    }
    // Not so few that they say nothing, not so many that their words touch.
    let most = most.max(2.0).floor() as usize;
    let tries = (1..=most + 6).map(|n| {
        let ticks = ticks(span.scale, span.first, span.last, n as f64);
        let named: Vec<&Tick> = ticks.iter().filter(|tick| tick.label.is_some()).collect();
        let apart = named.windows(2).all(|pair| free(pair[0], pair[1]));
        let named = named.len();
        (ticks, named, apart)
    });
    let fits: Vec<(Vec<Tick>, usize)> =
        tries.filter_map(|(ticks, named, apart)| apart.then_some((ticks, named))).collect();
    let wanted = fits.iter().rev().find(|(_, named)| (3..=most.max(3)).contains(named));
    let enough = || fits.iter().find(|(_, named)| *named >= 3);
    wanted.or_else(enough).or(fits.last()).map_or_else(Vec::new, |(ticks, _)| ticks.clone())
}

/// Left, top, right and bottom margins of a panel.
fn margins(frame: &Frame) -> [f64; 4] {
    let labels = frame.y_label.len() as f64 * LINE;
    let left = 6.0 + labels + 4.0 + frame.tick_room + TICK;
    let overhang = |tick: &Tick| {
        let outside = (1.0 - frame.spans.x.part(tick.value)) * frame.plot.width();
        width(tick.words(), SMALL) / 2.0 - outside
    };
    let right = 4.0 + frame.x_ticks.iter().map(overhang).fold(10.0, f64::max);
    let heading = if frame.heading.is_some() { LINE + 4.0 } else { 0.0 };
    let top = 11.0 + heading + frame.legend_room;
    let bottom = if frame.x_words {
        TICK + SMALL + 6.0 + frame.x_label.len() as f64 * LINE + 4.0
    } else {
        7.0
    };
    [left, top, right, bottom]
}

/// The plots' rectangles: what the margins leave, shared by the relative widths and heights.
fn plots(grid: &Grid, frames: &[Frame], width: f64, height: f64) -> Vec<Rect> {
    let (columns, rows) = (grid.widths.len(), grid.heights.len());
    let mut before = [vec![0.0_f64; columns], vec![0.0_f64; rows]];
    let mut after = before.clone();
    for (frame, cell) in frames.iter().zip(&grid.cells) {
        let [left, top, right, bottom] = margins(frame);
        let (last_column, last_row) = (cell.column + cell.columns - 1, cell.row + cell.rows - 1);
        before[0][cell.column] = before[0][cell.column].max(left);
        before[1][cell.row] = before[1][cell.row].max(top);
        after[0][last_column] = after[0][last_column].max(right);
        after[1][last_row] = after[1][last_row].max(bottom);
    }
    let [across, down] = [(&grid.widths, width), (&grid.heights, height)];
    let columns = tracks(&before[0], across.0, &after[0], across.1);
    let rows = tracks(&before[1], down.0, &after[1], down.1);
    let place = |cell: &Cell| {
        let (first, last) = (columns[cell.column], columns[cell.column + cell.columns - 1]);
        let (top, bottom) = (rows[cell.row], rows[cell.row + cell.rows - 1]);
        Rect::new(first.0, top.0, last.1, bottom.1)
    };
    grid.cells.iter().map(place).collect()
}

/// Start and end of every track.
fn tracks(before: &[f64], weights: &[f64], after: &[f64], total: f64) -> Vec<(f64, f64)> {
    let margins: f64 = before.iter().chain(after).sum();
    let unit = (total - margins) / weights.iter().sum::<f64>();
    let mut position = 0.0;
    let mut tracks = Vec::new();
    for ((before, weight), after) in before.iter().zip(weights).zip(after) {
        let start = position + before;
        let end = start + weight * unit;
        tracks.push((start, end));
        position = end + after;
    }
    tracks
}

/// Entries of these widths in rows of some room: where each begins, and in which row.
fn in_rows(widths: impl IntoIterator<Item = f64>, room: f64) -> Vec<(f64, f64)> {
    let (mut x, mut row) = (0.0, 0.0);
    let place = |size: f64| {
        if x > 0.0 && x + size > room {
            (x, row) = (0.0, row + 1.0);
        }
        let at = (x, row);
        x += size + BETWEEN;
        at
    };
    widths.into_iter().map(place).collect()
}

/// Legend entries, the last row just above the plot.
fn legend_places(panel: &Panel, legend: &[usize], room: f64) -> Vec<(usize, [f64; 2])> {
    let entry = |&index: &usize| {
        let layer = &panel.layers[index];
        Some((index, swatch(layer) + GAP + text::width(&layer.label()?.text, SMALL)))
    };
    let entries: Vec<(usize, f64)> = legend.iter().filter_map(entry).collect();
    let places = in_rows(entries.iter().map(|(_, width)| *width), room);
    let last = places.last().map_or(0.0, |(_, row)| *row);
    let above = |row: f64| -(last - row + 1.0) * LEGEND + 0.3 * LEGEND;
    let placed = entries.iter().zip(places);
    placed.map(|((index, _), (x, row))| (*index, [x, above(row)])).collect()
}

/// The middle of the left edge of each key's sample, from a left end.
pub(super) fn key_places(figure: &Figure, left: f64) -> Vec<[f64; 2]> {
    let widths = figure.keys.iter().map(|key| KEY + GAP + text::width(&key.label, SMALL));
    let places = in_rows(widths, KEYS * f64::from(figure.size.0));
    places.into_iter().map(|(x, row)| [left + x, 8.0 + LEGEND * (row + 0.5)]).collect()
}

/// The height that the keys take.
fn keys_room(figure: &Figure) -> f64 {
    key_places(figure, 0.0).iter().map(|at| at[1] + 0.5 * LEGEND).fold(0.0, f64::max)
}

/// The height that rows of legend entries take.
fn legend_room(places: &[(usize, [f64; 2])]) -> f64 {
    places.iter().map(|(_, at)| 0.3 * LEGEND - at[1]).fold(0.0, f64::max)
}

/// The width of a layer's sample in the legend, pixels.
pub(super) const fn swatch(layer: &Layer) -> f64 {
    if matches!(layer, Layer::Points { .. }) { MARKER } else { SWATCH }
}
