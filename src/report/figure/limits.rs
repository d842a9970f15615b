//! Which part of each axis a panel shows.

use super::data::{Axis, Figure, Panel, Scale};
use super::layers::{Layer, Rule};
use super::render::FigureError;
use super::ticks::round_step;

/// The margin beside the data, as a part of their span.
const MARGIN: f64 = 0.05;
/// At most this part of the data may be left out as outliers ...
const OUTLYING: f64 = 0.01;
/// ... and only where they lie beyond the others by more than this multiple of the others' span.
const FAR: f64 = 2.0;
/// Values beyond this size are taken as not drawable; pixels are computed without overflow below.
const HUGE: f64 = 1e150;
/// Places further outside a panel than this many times its size are drawn there.
const FAR_OFF: f64 = 1e9;

/// What an axis shows, proven valid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Span {
    pub first: f64,
    pub last: f64,
    pub scale: Scale,
}

impl Span {
    /// Where a value is, as a part of the axis; NaN where it cannot be drawn.
    pub(super) fn part(&self, value: f64) -> f64 {
        if value.is_nan() || value.abs() > HUGE {
            return f64::NAN;
        }
        let part = match self.scale {
            Scale::Linear => (value - self.first) / (self.last - self.first),
            Scale::Log if value <= 0.0 => f64::NAN,
            Scale::Log => libm::log(value / self.first) / libm::log(self.last / self.first),
        };
        part.clamp(-FAR_OFF, FAR_OFF)
    }

    fn joined(self, other: Self) -> Self {
        let (first, last) = (self.first.min(other.first), self.last.max(other.last));
        Self { first, last, ..self }
    }
}

/// The two axes of a panel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Spans {
    pub x: Span,
    pub y: Span,
}

/// The spans of all panels; `shared` tells which panels show one x axis.
pub(super) fn spans(figure: &Figure, shared: &[Vec<usize>]) -> Result<Vec<Spans>, FigureError> {
    let mut all = Vec::new();
    for panel in &figure.panels {
        let span = |axis: &Axis, index| resolve(&figure.name, panel, axis, index);
        all.push(Spans { x: span(&panel.x, 0)?, y: span(&panel.y, 1)? });
    }
    for group in shared {
        let spans: Vec<Span> = group.iter().map(|&i| all[i].x).collect();
        if let Some(joined) = spans.into_iter().reduce(Span::joined) {
            for &i in group {
                all[i].x = joined;
            }
        }
    }
    Ok(all)
}

fn resolve(name: &str, panel: &Panel, axis: &Axis, index: usize) -> Result<Span, FigureError> {
    let scale = axis.scale;
    if let Some((first, last)) = axis.range {
        let positive = scale == Scale::Linear || first >= 1.0 / HUGE;
        let wide = (last - first) / first.abs().max(last.abs()) > 1e-12;
        if !(first < last && last - first < HUGE && positive && wide) {
            let reason = format!("axis {:?} cannot run from {first} to {last}", axis.label);
            return Err(FigureError::new(name, reason));
        }
        return Ok(Span { first, last, scale });
    }
    let data = collect(panel, index);
    let usable = |v: &f64| v.abs() <= HUGE && (scale == Scale::Linear || *v >= 1.0 / HUGE);
    let to_scale = |v: f64| if scale == Scale::Log { libm::log10(v) } else { v };
    let keep = |values: &[f64]| values.iter().copied().filter(usable).map(to_scale).collect();
    let (lines, marks, must): (Vec<f64>, Vec<f64>, Vec<f64>) =
        (keep(&data.lines), keep(&data.marks), keep(&data.must));
    let (low, high) = extent(&lines, &marks, &must, index == 1, data.floor);
    if scale == Scale::Log {
        return Ok(Span { first: libm::pow(10.0, low), last: libm::pow(10.0, high), scale });
    }
    Ok(rounded(low, high, index))
}

/// Coordinates of one axis, by what they ask for.
#[derive(Default)]
struct Coordinates {
    /// Lines may touch the panel's sides.
    lines: Vec<f64>,
    /// Points want a margin.
    marks: Vec<f64>,
    /// These are shown even if they are outliers.
    must: Vec<f64>,
    /// All values are at least 0, and the axis is linear: a margin must not go below.
    floor: bool,
}

fn collect(panel: &Panel, index: usize) -> Coordinates {
    let mut all = Coordinates::default();
    for layer in &panel.layers {
        match layer {
            Layer::Curve { points, .. } => all.lines.extend(points.iter().map(|p| p[index])),
            Layer::Band { outline, .. } => all.lines.extend(outline.iter().map(|p| p[index])),
            Layer::Points { points, .. } => {
                for point in points {
                    let value = [point.x, point.y][index];
                    let list = if point.label.is_some() { &mut all.must } else { &mut all.marks };
                    list.push(value);
                }
            }
            Layer::Image(image) => {
                let edges = [&image.x_edges, &image.y_edges][index];
                all.lines.extend(edges.first().into_iter().chain(edges.last()));
            }
            Layer::ThisCase { at, .. } => all.must.push(at[index]),
            Layer::Note { at, .. } => all.must.push(at[index]),
            Layer::Rule { rule, .. } => match (rule, index) {
                (Rule::Vertical(v), 0) | (Rule::Horizontal(v), 1) => all.marks.push(*v),
                _ => {}
            },
        }
    }
    let axis = if index == 0 { &panel.x } else { &panel.y };
    let values = || all.lines.iter().chain(&all.marks).chain(&all.must);
    let floor = axis.scale == Scale::Linear && !values().any(|v| *v < 0.0);
    Coordinates { floor, ..all }
}

/// The interval to show, with its margin.
fn extent(lines: &[f64], marks: &[f64], must: &[f64], ordinate: bool, floor: bool) -> (f64, f64) {
    let mut sorted: Vec<f64> = lines.iter().chain(marks).copied().collect();
    sorted.sort_by(f64::total_cmp);
    let (mut low, mut high) = inliers(&sorted);
    for v in must {
        (low, high) = (low.min(*v), high.max(*v));
    }
    if low > high {
        (low, high) = (0.0, 1.0);
    }
    let size = low.abs().max(high.abs());
    let span = high - low;
    if span <= 1e-9 * size || span == 0.0 {
        let half = if size > 0.0 { 0.1 * size } else { 1.0 };
        return (low - half, high + half);
    }
    let nearly = |a: f64, b: f64| (a - b).abs() < 0.5 * MARGIN * span;
    let wants = |end: f64| ordinate || marks.iter().chain(must).any(|v| nearly(*v, end));
    let mut padded = (
        if wants(low) { low - MARGIN * span } else { low },
        if wants(high) { high + MARGIN * span } else { high },
    );
    if floor && (padded.0 < 0.0 || (ordinate && low < 0.35 * high)) {
        padded.0 = 0.0;
    }
    padded
}

/// First and last value, without the few that lie far from all others.
fn inliers(sorted: &[f64]) -> (f64, f64) {
    let (Some(first), Some(last)) = (sorted.first(), sorted.last()) else {
        return (f64::INFINITY, f64::NEG_INFINITY);
    };
    let drop = (sorted.len() as f64 * OUTLYING).floor() as usize;
    let (low, high) = (sorted[drop], sorted[sorted.len() - 1 - drop]);
    let reach = FAR * (high - low);
    if reach == 0.0 {
        return (*first, *last);
    }
    (if low - first > reach { low } else { *first }, if last - high > reach { high } else { *last })
}

/// Moves the ends outwards to round numbers.
fn rounded(low: f64, high: f64, index: usize) -> Span {
    let quantum = round_step(high - low, 6.0) / if index == 0 { 5.0 } else { 2.0 };
    let first = libm::floor(low / quantum + 1e-6) * quantum;
    let last = libm::ceil(high / quantum - 1e-6) * quantum;
    Span { first, last, scale: Scale::Linear }
}
