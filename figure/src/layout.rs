//! Where the panels are: margins are what the words take, so that nothing is cut.

use super::data::{Axis, AxisScale, Figure, GridCell, Layout, Panel, Tick};
use super::geometry::{Point, Rect};
use super::layers::Layer;
use super::limits::{Span, Spans, spans};
use super::render::FigureError;
use super::text::{Anchor, LARGE, SMALL, Words, width, wrap};
use super::ticks::ticks;

/// From the plot to the nearest tick label, pixels.
const TICK: f64 = 9.0;
/// From one line of words to the next, pixels.
const LINE: f64 = 18.0;
/// Height of a row of the legend, pixels.
const LEGEND: f64 = 20.0;
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
/// Left, top, right and bottom: beyond the words, and the least margins, pixels.
const BEYOND: [f64; 4] = [7.0, 4.0, 4.0, 5.0];
const LEAST_MARGINS: [f64; 4] = [7.0, 11.0, 14.0, 7.0];

/// A panel in its place.
#[derive(Debug, Clone)]
pub(super) struct Frame {
    /// The rectangle of the data.
    pub plot: Rect,
    pub spans: Spans,
    pub x_ticks: Vec<Tick>,
    pub y_ticks: Vec<Tick>,
    /// The words of ticks, axes and legend, and the heading.
    pub words: Vec<Words>,
    /// Layers in the legend, and where their samples are: the middle of the left edge.
    pub legend: Vec<(usize, Point)>,
}

impl Frame {
    /// From parts of the axes to pixels.
    pub(super) fn place(&self, [x, y]: Point) -> Point {
        [self.plot.left + x * self.plot.width(), self.plot.bottom - y * self.plot.height()]
    }

    /// From data to pixels; NaN where it cannot be drawn.
    pub(super) fn map(&self, [x, y]: Point) -> Point {
        self.place([self.spans.x.part(x), self.spans.y.part(y)])
    }

    /// From a tick of the horizontal axis to pixels.
    pub(super) fn across(&self, tick: &Tick) -> f64 {
        self.place([self.spans.x.labelled(tick.value), 0.0])[0]
    }

    /// From a tick of the vertical axis to pixels.
    pub(super) fn up(&self, tick: &Tick) -> f64 {
        self.place([0.0, self.spans.y.labelled(tick.value)])[1]
    }

    /// What is left of, above, right of and below the plot.
    fn margins(&self) -> [f64; 4] {
        let Rect { left, top, right, bottom } = self.plot;
        let mut most = LEAST_MARGINS;
        for room in self.words.iter().map(Words::bounds) {
            let taken =
                [left - room.left, top - room.top, room.right - right, room.bottom - bottom];
            for (side, most) in most.iter_mut().enumerate() {
                *most = most.max(taken[side] + BEYOND[side]);
            }
        }
        most
    }
}

/// The grid of a figure, proven valid.
fn grid(figure: &Figure) -> Result<Layout, FigureError> {
    let row = || Layout::columns(&vec![1.0; figure.panels.len()]);
    let grid = figure.layout.clone().unwrap_or_else(row);
    let Layout { widths, heights, cells } = &grid;
    let wrong = |reason: String| Err(FigureError::new(&figure.name, reason));
    if cells.len() != figure.panels.len() {
        let panels = figure.panels.len();
        return wrong(format!("{panels} panels, but {} cells for them", cells.len()));
    }
    if let Some(w) = widths.iter().chain(heights).find(|w| !(**w > 0.0 && **w < 1e6)) {
        return wrong(format!("a relative width or height is {w}, expected above 0"));
    }
    let fits = |c: &GridCell| {
        c.column + c.columns <= widths.len()
            && c.row + c.rows <= heights.len()
            && c.columns * c.rows > 0
    };
    if let Some(i) = cells.iter().position(|cell| !fits(cell)) {
        return wrong(format!("the cell of panel {i} is empty or outside the grid"));
    }
    Ok(grid)
}

/// For each panel the first one above or below it with the same horizontal axis, which may be itself.
fn sharing(figure: &Figure, grid: &Layout) -> Vec<usize> {
    let axis = |i: usize| {
        let (cell, x) = (grid.cells[i], &figure.panels[i].x);
        (cell.column, cell.columns, &x.label, x.scale, x.range, x.factor)
    };
    let first = |i| (0..i).find(|&k| axis(k) == axis(i)).unwrap_or(i);
    (0..figure.panels.len()).map(first).collect()
}

/// Lays the panels out. `legends` lists, for each panel, the layers named above it.
pub(super) fn lay_out(figure: &Figure, legends: &[Vec<usize>]) -> Result<Vec<Frame>, FigureError> {
    if figure.panels.is_empty() {
        return Err(FigureError::new(&figure.name, "has no panels; add one with `with_panel`"));
    }
    let grid = grid(figure)?;
    let sharing = sharing(figure, &grid);
    let spans = spans(figure, &sharing)?;
    let all = || 0..figure.panels.len();
    let lowest = |i: usize| {
        let below = |k: usize| sharing[k] == sharing[i] && grid.cells[k].row > grid.cells[i].row;
        !all().any(below)
    };
    let dressed = |i: usize, plot| dress(&figure.panels[i], plot, spans[i], lowest(i), &legends[i]);
    let (width, height) = (f64::from(figure.size.0), f64::from(figure.size.1));
    let room = Rect::new(0.0, keys_room(figure), width, height);
    let [columns, rows] = [grid.widths.len(), grid.heights.len()].map(|n| n as f64);
    let plot = Rect::new(0.0, 0.0, 0.8 * room.width() / columns, 0.8 * room.height() / rows);
    let mut frames: Vec<Frame> = all().map(|i| dressed(i, plot)).collect();
    // Words decide margins, margins decide plots, plots decide ticks, hence words: settles at once
    // or alternates between two; a fixed number of rounds ends with plots that fit their words.
    for _ in 0..4 {
        for (i, plot) in plots(&grid, &frames, &room).into_iter().enumerate() {
            let (width, height) = (plot.width(), plot.height());
            if !(width >= LEAST && height >= LEAST) {
                let reason = format!(
                    "panel {i} is left with {width:.0} x {height:.0} pixels; enlarge the figure"
                );
                return Err(FigureError::new(&figure.name, reason));
            }
            let plot = if figure.panels[i].equal_aspect { equal(plot, &spans[i]) } else { plot };
            frames[i] = dressed(i, plot);
        }
    }
    align(&grid, &mut frames);
    Ok(frames)
}

/// Gives the vertical axes of a column their words at the same place, and the panels of a row their headings
/// at the same height.
fn align(grid: &Layout, frames: &mut [Frame]) {
    let ([columns, rows], _) = margins(grid, frames);
    for (cell, frame) in grid.cells.iter().zip(frames) {
        let [left, top, ..] = frame.margins();
        for words in &mut frame.words {
            if words.upright {
                words.at[0] -= columns[cell.column] - left;
            } else if words.bold {
                words.at[1] -= rows[cell.row] - top;
            }
        }
    }
}

/// The plot, made smaller so that one unit is equally long on both axes.
fn equal(plot: Rect, spans: &Spans) -> Rect {
    let size = |s: &Span| match s.scale {
        AxisScale::Linear => s.last - s.first,
        AxisScale::Log => libm::log10(s.last / s.first),
    };
    let (sx, sy) = (size(&spans.x), size(&spans.y));
    let unit = (plot.width() / sx).min(plot.height() / sy);
    Rect::around(plot.center(), unit * sx, unit * sy)
}

/// Ticks and words for a plot.
fn dress(panel: &Panel, plot: Rect, spans: Spans, x_words: bool, legend: &[usize]) -> Frame {
    let x_ticks = fitting(&panel.x, &spans.x, plot.width(), plot.width() / 68.0, false);
    let y_ticks = fitting(&panel.y, &spans.y, plot.height(), plot.height() / 40.0, true);
    let mut frame = Frame { plot, spans, x_ticks, y_ticks, words: Vec::new(), legend: Vec::new() };
    let legend_room = legend_words(&mut frame, panel, legend);
    let large =
        |text: &str, at, anchor| Words { color: "#000000", ..Words::new(text, at, anchor, LARGE) };
    let mut words = Vec::new();
    let mut room = 0.0_f64;
    for tick in frame.y_ticks.iter().filter(|tick| tick.label.is_some()) {
        let at = [plot.left - TICK, frame.up(tick)];
        words.push(Words::new(tick.words(), at, Anchor::End, SMALL));
        room = room.max(width(tick.words(), SMALL));
    }
    let [cx, cy] = plot.center();
    for (i, text) in wrap(&panel.y.label, LARGE, plot.height() + 8.0).iter().rev().enumerate() {
        let x = plot.left - TICK - room - 4.0 - LINE * (i as f64 + 0.5);
        words.push(Words { upright: true, ..large(text, [x, cy], Anchor::Middle) });
    }
    for tick in frame.x_ticks.iter().filter(|tick| x_words && tick.label.is_some()) {
        let at = [frame.across(tick), plot.bottom + TICK + SMALL / 2.0 + 0.5];
        words.push(Words::new(tick.words(), at, Anchor::Middle, SMALL));
    }
    let label = wrap(&panel.x.label, LARGE, plot.width() + 40.0);
    for (i, text) in label.iter().enumerate().filter(|_| x_words) {
        let y = plot.bottom + TICK + SMALL + 6.0 + LINE * (i as f64 + 0.5);
        words.push(large(text, [cx, y], Anchor::Middle));
    }
    let heading = panel.heading.as_ref().map(|text| wrap(text, LARGE, plot.width() + 40.0));
    for (i, text) in heading.iter().flat_map(|lines| lines.iter().rev()).enumerate() {
        let at = [plot.left, plot.top - legend_room - LINE * (i as f64 + 0.5) - 4.0];
        words.push(Words { bold: true, ..large(text, at, Anchor::Start) });
    }
    frame.words.extend(words);
    frame
}

/// Adds rows of legend entries, the last one just above the plot; gives the height that they take.
fn legend_words(frame: &mut Frame, panel: &Panel, legend: &[usize]) -> f64 {
    let name = |layer: &Layer| layer.label().map_or("", |label| &label.text).to_owned();
    let entries: Vec<(usize, &Layer)> = legend.iter().map(|&i| (i, &panel.layers[i])).collect();
    let widths = entries.iter().map(|(_, of)| swatch(of) + GAP + width(&name(of), SMALL));
    let places = in_rows(widths, frame.plot.width());
    let rows = places.last().map_or(0.0, |(_, row)| row + 1.0);
    for ((index, layer), (x, row)) in entries.into_iter().zip(places) {
        let at = [frame.plot.left + x, frame.plot.top + LEGEND * (row - rows + 0.3)];
        frame.legend.push((index, at));
        let at = [at[0] + swatch(layer) + GAP, at[1]];
        let words = Words::new(name(layer), at, Anchor::Start, SMALL);
        frame.words.push(Words { color: layer.text_color(), ..words });
    }
    rows * LEGEND
}

/// As many ticks as the axis has room for.
fn fitting(axis: &Axis, span: &Span, length: f64, most: f64, ordinate: bool) -> Vec<Tick> {
    let extent = |tick: &Tick| if ordinate { SMALL } else { width(tick.words(), SMALL) };
    let gap = if ordinate { 4.0 } else { 9.0 };
    let free = |a: &Tick, b: &Tick| {
        let distance = (span.labelled(b.value) - span.labelled(a.value)).abs() * length;
        distance >= f64::midpoint(extent(a), extent(b)) + gap
    };
    if let Some(given) = &axis.ticks {
        let inside = |tick: &&Tick| (-1e-9..=1.0 + 1e-9).contains(&span.labelled(tick.value));
        return given.iter().filter(inside).cloned().collect();
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
    wanted.or(fits.last()).map_or_else(Vec::new, |(ticks, _)| ticks.clone())
}

/// The margins before and after each column and each row.
fn margins(grid: &Layout, frames: &[Frame]) -> ([Vec<f64>; 2], [Vec<f64>; 2]) {
    let mut before = [vec![0.0_f64; grid.widths.len()], vec![0.0_f64; grid.heights.len()]];
    let mut after = before.clone();
    for (frame, cell) in frames.iter().zip(&grid.cells) {
        let [left, top, right, bottom] = frame.margins();
        let last = [cell.column + cell.columns - 1, cell.row + cell.rows - 1];
        before[0][cell.column] = before[0][cell.column].max(left);
        before[1][cell.row] = before[1][cell.row].max(top);
        after[0][last[0]] = after[0][last[0]].max(right);
        after[1][last[1]] = after[1][last[1]].max(bottom);
    }
    (before, after)
}

/// The plots' rectangles: what the margins leave, shared by the relative widths and heights.
fn plots(grid: &Layout, frames: &[Frame], room: &Rect) -> Vec<Rect> {
    let (before, after) = margins(grid, frames);
    let columns = tracks(&before[0], &grid.widths, &after[0], room.width());
    let rows = tracks(&before[1], &grid.heights, &after[1], room.height());
    let place = |cell: &GridCell| {
        let (left, right) = (columns[cell.column].0, columns[cell.column + cell.columns - 1].1);
        let (top, bottom) = (rows[cell.row].0, rows[cell.row + cell.rows - 1].1);
        Rect::new(room.left + left, room.top + top, room.left + right, room.top + bottom)
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

/// The middle of the left edge of each key's sample, from a left end.
pub(super) fn key_places(figure: &Figure, left: f64) -> Vec<Point> {
    let widths = figure.keys.iter().map(|key| KEY + GAP + width(&key.label, SMALL));
    let places = in_rows(widths, KEYS * f64::from(figure.size.0));
    places.into_iter().map(|(x, row)| [left + x, 8.0 + LEGEND * (row + 0.5)]).collect()
}

/// The height that the keys take.
fn keys_room(figure: &Figure) -> f64 {
    key_places(figure, 0.0).last().map_or(0.0, |at| at[1] + 0.5 * LEGEND)
}

/// The width of a layer's sample in the legend, pixels.
pub(super) const fn swatch(layer: &Layer) -> f64 {
    if matches!(layer, Layer::Points { .. }) { MARKER } else { SWATCH }
}
