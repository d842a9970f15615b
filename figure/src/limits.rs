//! Which part of each axis a panel shows.

use super::data::{AxisScale, Figure, Panel};
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

/// What an axis shows, proven valid. Its ends are in the unit of the label.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Span {
    pub first: f64,
    pub last: f64,
    pub scale: AxisScale,
    /// That of the axis.
    pub factor: f64,
}

impl Span {
    /// First and last value of the data.
    pub(super) fn of_data(&self) -> [f64; 2] {
        [self.first, self.last].map(|end| end / self.factor)
    }

    /// Where a number of the data is, as a part of the axis; NaN where it cannot be drawn.
    pub(super) fn part(&self, number: f64) -> f64 {
        self.labelled(number * self.factor)
    }

    /// The same of a value in the unit of the label.
    pub(super) fn labelled(&self, value: f64) -> f64 {
        if value.is_nan() || value.abs() > HUGE {
            return f64::NAN;
        }
        let part = match self.scale {
            AxisScale::Linear => (value - self.first) / (self.last - self.first),
            AxisScale::Log if value <= 0.0 => f64::NAN,
            AxisScale::Log => libm::log(value / self.first) / libm::log(self.last / self.first),
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

/// The spans of all panels; those that are `sharing` the same one show one x axis.
pub(super) fn spans(figure: &Figure, sharing: &[usize]) -> Result<Vec<Spans>, FigureError> {
    let span = |panel: &Panel, index| {
        resolve(panel, index).map_err(|reason| FigureError::new(&figure.name, reason))
    };
    let both = |panel| Ok(Spans { x: span(panel, 0)?, y: span(panel, 1)? });
    let own = figure.panels.iter().map(both).collect::<Result<Vec<Spans>, FigureError>>()?;
    let joined = |(spans, first): (&Spans, &usize)| {
        let with = own.iter().zip(sharing).filter(|(_, other)| *other == first);
        Spans { x: with.fold(spans.x, |x, (other, _)| x.joined(other.x)), ..*spans }
    };
    Ok(own.iter().zip(sharing).map(joined).collect())
}

/// What an axis shows, or why it cannot.
fn resolve(panel: &Panel, index: usize) -> Result<Span, String> {
    let axis = [&panel.x, &panel.y][index];
    let (scale, factor) = (axis.scale, axis.factor);
    let span = |[first, last]: [f64; 2]| Span { first, last, scale, factor };
    if let Some((first, last)) = axis.range {
        let [first, last] = [first, last].map(|end| end * factor);
        let positive = scale == AxisScale::Linear || first >= 1.0 / HUGE;
        let wide = (last - first) / first.abs().max(last.abs()) > 1e-12;
        if first < last && last - first < HUGE && positive && wide {
            return Ok(span([first, last]));
        }
        return Err(format!("axis {:?} cannot run from {first} to {last}", axis.label));
    }
    let mut values = coordinates(panel, index);
    values.iter_mut().for_each(|(v, _)| *v *= factor);
    // Where nothing is below 0, a margin is not either.
    let floor = scale == AxisScale::Linear && !values.iter().any(|(v, _)| *v < 0.0);
    values.retain(|(v, _)| v.abs() <= HUGE && (scale == AxisScale::Linear || *v >= 1.0 / HUGE));
    if scale == AxisScale::Log {
        values.iter_mut().for_each(|(v, _)| *v = libm::log10(*v));
        return Ok(span(extent(&values, index, floor).map(|end| libm::pow(10.0, end))));
    }
    Ok(span(rounded(extent(&values, index, floor), index)))
}

/// What is drawn at, and whether it is shown even if it is an outlier.
fn coordinates(panel: &Panel, index: usize) -> Vec<(f64, bool)> {
    let mut all = Vec::new();
    for layer in &panel.layers {
        match layer {
            Layer::Curve { points, .. } | Layer::Band { outline: points, .. } => {
                all.extend(points.iter().map(|p| (p[index], false)));
            }
            Layer::Points { points, .. } => all.extend(
                points.iter().map(|point| ([point.x, point.y][index], point.label.is_some())),
            ),
            Layer::Image(image) => {
                let edges = [&image.x_edges, &image.y_edges][index];
                all.extend(edges.first().into_iter().chain(edges.last()).map(|v| (*v, false)));
            }
            Layer::Rule { rule, .. } => match (rule, index) {
                (Rule::Vertical(v), 0) | (Rule::Horizontal(v), 1) => all.push((*v, false)),
                _ => {}
            },
        }
    }
    all
}

/// The interval to show, with its margin.
fn extent(values: &[(f64, bool)], index: usize, floor: bool) -> [f64; 2] {
    let (must, others): (Vec<_>, Vec<_>) = values.iter().partition(|(_, must)| *must);
    let mut sorted: Vec<f64> = others.iter().map(|(v, _)| *v).collect();
    sorted.sort_by(f64::total_cmp);
    let inside = inliers(&sorted, OUTLYING, FAR);
    let [mut low, mut high] = inside.unwrap_or([f64::INFINITY, f64::NEG_INFINITY]);
    for (v, _) in must {
        (low, high) = (low.min(v), high.max(v));
    }
    if low > high {
        (low, high) = (0.0, 1.0);
    }
    let size = low.abs().max(high.abs());
    let span = high - low;
    if span <= 1e-9 * size || span == 0.0 {
        let half = if size > 0.0 { 0.1 * size } else { 1.0 };
        return [low - half, high + half];
    }
    let mut padded = [low - MARGIN * span, high + MARGIN * span];
    if floor && (padded[0] < 0.0 || (index == 1 && low < 0.35 * high)) {
        padded[0] = 0.0;
    }
    padded
}

/// First and last value, at either end without at most a part `outlying` of them, if these lie beyond the others
/// by more than `far` times the others' span.
pub fn inliers(sorted: &[f64], outlying: f64, far: f64) -> Option<[f64; 2]> {
    let (first, last) = (*sorted.first()?, *sorted.last()?);
    let drop = (sorted.len() as f64 * outlying).floor() as usize;
    let (low, high) = (sorted[drop], sorted[sorted.len() - 1 - drop]);
    let reach = far * (high - low);
    if reach == 0.0 {
        return Some([first, last]);
    }
    let low = if low - first > reach { low } else { first };
    Some([low, if last - high > reach { high } else { last }])
}

/// Moves the ends outwards to round numbers.
fn rounded([low, high]: [f64; 2], index: usize) -> [f64; 2] {
    let quantum = round_step(high - low, 6.0) / if index == 0 { 5.0 } else { 2.0 };
    [libm::floor(low / quantum + 1e-6) * quantum, libm::ceil(high / quantum - 1e-6) * quantum]
}
