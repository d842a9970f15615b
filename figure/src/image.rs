//! A panel's cells as an image: one colour a cell, in a PNG inside the drawing.

use super::colors::{Ramp, Tint};
use super::data::AxisScale;
use super::geometry::Rect;
use super::layout::Frame;
use super::limits::Span;
use super::text::tenths;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// Cells of a grid with their boundaries in data coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    /// Where columns begin and end, ascending; one more than there are columns.
    pub x_edges: Vec<f64>,
    /// Where rows begin and end, ascending; one more than there are rows.
    pub y_edges: Vec<f64>,
    /// What the cells hold, row by row, the row of the smallest ordinate first.
    pub cells: Cells,
}

/// What cells hold.
#[derive(Debug, Clone, PartialEq)]
pub enum Cells {
    /// Kinds, at most 255 of them: which of the tints, or nothing where none is known.
    Kinds(Vec<Tint>, Vec<Option<u8>>),
    /// Values on a ramp between two ends, or nothing where none is known.
    Values(Ramp, (f64, f64), Vec<Option<f64>>),
}

/// Levels of a ramp in a file that is small enough; neighbours differ by less than the eye sees.
const LEVELS: f64 = 128.0;
/// Fewer levels would show as bands.
const FEWEST_LEVELS: f64 = 16.0;
/// Columns and rows of an image in blocks, and levels of a ramp in it.
const BLOCKS: [usize; 2] = [36, 27];
const BLOCK_LEVELS: f64 = 12.0;
/// Pixels of an image per pixel of the figure where cells are unevenly wide.
const FINE: f64 = 2.0;
/// More pixels than this beside one another are more than a screen shows.
const MOST: usize = 1500;
/// Parts of an axis that differ by less are equally wide: a thousandth of a cell among a thousand.
const EVEN: f64 = 1e-6;

/// The cell boundaries of values along an axis: midway between neighbours, as the axis measures, and as far
/// beyond the first and the last.
///
/// A single value has a cell of a tenth of itself to both sides, or of 1 where it is 0.
#[must_use]
pub fn edges(values: &[f64], scale: AxisScale) -> Vec<f64> {
    let log = scale == AxisScale::Log;
    let measured = |v: f64| if log { libm::log(v) } else { v };
    let back = |v: f64| if log { libm::exp(v) } else { v };
    let at: Vec<f64> = values.iter().map(|v| measured(*v)).collect();
    let [Some(first), Some(last)] = [at.first(), at.last()] else { return Vec::new() };
    let (before, after) = match at.as_slice() {
        [one] => {
            let half = if log || *one == 0.0 { 0.1 } else { 0.1 * one.abs() };
            (half, half)
        }
        [a, .., b] => (0.5 * (at[1] - a), 0.5 * (b - at[at.len() - 2])),
        [] => return Vec::new(),
    };
    let inner = at.windows(2).map(|pair| f64::midpoint(pair[0], pair[1]));
    let all = std::iter::once(first - before).chain(inner).chain(std::iter::once(last + after));
    all.map(back).collect()
}

/// Where an image lies, and which cell each of its pixels shows.
struct Placed {
    place: Rect,
    /// The column of cells for each column of pixels, from the left.
    columns: Vec<usize>,
    /// The row of cells for each row of pixels, from the top.
    rows: Vec<usize>,
}

/// Places an image in a plot; nothing where none of it is visible.
fn placed(image: &Image, frame: &Frame) -> Option<Placed> {
    let plot = &frame.plot;
    let (across, columns) = track(&image.x_edges, &frame.spans.x, plot.width())?;
    let (up, mut rows) = track(&image.y_edges, &frame.spans.y, plot.height())?;
    rows.reverse();
    let place = Rect::new(
        plot.left + across.0 * plot.width(),
        plot.bottom - up.1 * plot.height(),
        plot.left + across.1 * plot.width(),
        plot.bottom - up.0 * plot.height(),
    );
    Some(Placed { place, columns, rows })
}

/// The visible parts of an axis from a first to a last edge, and which cell each pixel between them shows: one
/// pixel a cell where all are equally wide.
fn track(edges: &[f64], span: &Span, length: f64) -> Option<((f64, f64), Vec<usize>)> {
    let parts: Vec<f64> = edges.iter().map(|edge| span.part(*edge)).collect();
    let ascending = parts.windows(2).all(|pair| pair[0] < pair[1]);
    let (&first, &last) = (parts.first()?, parts.last()?);
    if !ascending || parts.len() < 2 || last <= 0.0 || first >= 1.0 {
        return None;
    }
    let count = parts.len() - 1;
    let even = |k: usize| first + (last - first) * k as f64 / count as f64;
    let whole = first >= -EVEN && last <= 1.0 + EVEN;
    let one_a_cell = whole && (0..=count).all(|k| (parts[k] - even(k)).abs() < EVEN);
    let (from, to) = (first.max(0.0), last.min(1.0));
    let fine = ((to - from) * length * FINE).ceil().max(1.0) as usize;
    let pixels = MOST.min(if one_a_cell { count } else { fine });
    let cell = |k: usize| {
        let at = from + (to - from) * (k as f64 + 0.5) / pixels as f64;
        parts.partition_point(|part| *part <= at).clamp(1, count) - 1
    };
    Some(((from, to), (0..pixels).map(cell).collect()))
}

/// One in so many pixels.
fn thinned(cells: &[usize], one_in: usize) -> Vec<usize> {
    let count = cells.len().div_ceil(one_in).max(1);
    (0..count).map(|k| cells[(2 * k + 1) * cells.len() / (2 * count)]).collect()
}

/// What some columns and rows of cells hold, as numbers of a palette whose last tint is for what is not known;
/// values take one of so many levels.
fn indexed(
    image: &Image,
    columns: &[usize],
    rows: &[usize],
    levels: f64,
) -> (Vec<Tint>, Vec<Vec<u8>>) {
    let (mut palette, numbers): (Vec<Tint>, Vec<Option<u8>>) = match &image.cells {
        Cells::Kinds(tints, cells) => (tints.clone(), cells.clone()),
        Cells::Values(ramp, (low, high), cells) => {
            let middle = |k: u32| low + (high - low) * (f64::from(k) + 0.5) / levels;
            let tints = (0..levels as u32).map(|k| ramp.tint(middle(k), (*low, *high)));
            let level = |value: f64| (value - low) / (high - low) * levels;
            let level = |value: f64| level(value).floor().clamp(0.0, levels - 1.0) as u8;
            (tints.collect(), cells.iter().map(|value| value.map(level)).collect())
        }
    };
    let unknown = palette.len() as u8;
    palette.push(Tint::UNKNOWN);
    let across = image.x_edges.len() - 1;
    let number = |cell: usize| numbers.get(cell).copied().flatten().unwrap_or(unknown);
    let row = |row: &usize| columns.iter().map(|column| number(row * across + column)).collect();
    (palette, rows.iter().map(row).collect())
}

/// Writes an image: each cell keeps its edges at any size. Below it are large blocks of the same colours, for
/// viewers that refuse an image within an image: GitHub's pages in Firefox do.
pub(super) fn write(svg: &mut String, image: &Image, frame: &Frame, coarseness: f64) {
    let Some(placed) = placed(image, frame) else { return };
    for (tint, d) in blocks(image, &placed) {
        let fill = tint.hex();
        *svg += &format!("<path d=\"{d}\" fill=\"{fill}\" shape-rendering=\"crispEdges\"/>\n");
    }
    let place = &placed.place;
    let [x, y, right, bottom] = [place.left, place.top, place.right, place.bottom].map(tenths);
    let (width, height, url) = (right - x, bottom - y, url(image, &placed, coarseness));
    *svg += &format!(
        "<image x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" \
         preserveAspectRatio=\"none\" image-rendering=\"pixelated\" href=\"{url}\"/>\n"
    );
}

/// The image as a URL that holds it; coarser where it would be too large: first fewer levels, then fewer
/// pixels.
fn url(image: &Image, placed: &Placed, coarseness: f64) -> String {
    let kinds = matches!(image.cells, Cells::Kinds(..));
    let one_in = if kinds { coarseness } else { (coarseness / 4.0).max(1.0) } as usize;
    let [columns, rows] = [&placed.columns, &placed.rows].map(|cells| thinned(cells, one_in));
    let levels = (LEVELS / coarseness).max(FEWEST_LEVELS);
    let (palette, pixels) = indexed(image, &columns, &rows, levels);
    // What repeats is shorter as it is, what changes slowly as differences.
    let filter = if kinds { png::Filter::NoFilter } else { png::Filter::Adaptive };
    format!("data:image/png;base64,{}", STANDARD.encode(png(&palette, &pixels, filter)))
}

/// The image in a few large blocks: each tint with the path data of its runs of neighbours.
fn blocks(image: &Image, placed: &Placed) -> Vec<(Tint, String)> {
    let sampled = |cells: &[usize], most: usize| thinned(cells, cells.len().div_ceil(most));
    let (columns, rows) = (sampled(&placed.columns, BLOCKS[0]), sampled(&placed.rows, BLOCKS[1]));
    let (palette, pixels) = indexed(image, &columns, &rows, BLOCK_LEVELS);
    let place = &placed.place;
    let x = |k: usize| tenths(place.left + place.width() * k as f64 / columns.len() as f64);
    let y = |k: usize| tenths(place.top + place.height() * k as f64 / rows.len() as f64);
    let mut found = vec![String::new(); palette.len()];
    for (row, pixels) in pixels.iter().enumerate() {
        let mut begin = 0;
        for run in pixels.chunk_by(|a, b| a == b) {
            let end = begin + run.len();
            let (left, top) = (x(begin), y(row));
            let (width, height) = (x(end) - left, y(row + 1) - top);
            found[usize::from(run[0])] += &format!("M{left} {top}h{width}v{height}H{left}z");
            begin = end;
        }
    }
    palette.into_iter().zip(found).filter(|(_, d)| !d.is_empty()).collect()
}

/// A file with a palette.
fn png(palette: &[Tint], pixels: &[Vec<u8>], filter: png::Filter) -> Vec<u8> {
    let (width, height) = (pixels.first().map_or(0, Vec::len) as u32, pixels.len() as u32);
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(palette.iter().flat_map(|tint| tint.0).collect::<Vec<u8>>());
    encoder.set_compression(png::Compression::High);
    encoder.set_filter(filter);
    let written = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(&pixels.concat())?;
        writer.finish()
    });
    written.expect("memory takes all bytes, and there are as many as the header says");
    file
}
