//! Bifurcation diagrams: one parameter swept up and down by simulation, with the exact orbits over it.

use serde_json::{Value, json};

use crate::motions::{DiagramPoint, SweepDirection};
use crate::orbits::Bifurcation;
use crate::quantity::catalogue as of;
use crate::report::chart::Chart;
use crate::report::figure::{
    AxisScale, Color, Dash, Figure, Label, Layer, Layout, MarkedPoint, Marker, Panel, Role, Shape,
    Style,
};
use crate::study::diagrams::{Diagram, Hysteresis, PERIODS, STEPS};
use crate::study::exact_branches::ExactPoint;
use crate::study::plots::first_drawn;
use crate::system::Parameter;

use super::DrawnCase;

/// Longest time between impacts that is shown, in periods; a modulated motion has single longer ones.
const LONGEST: f64 = 1.6;
/// Room above and below the points, as part of their span.
const MARGIN: f64 = 0.06;
/// Most points of one value and way: a chaotic band is a band with so many.
const MOST_POINTS: usize = 10;
/// Points of one value closer than this part of an axis are one.
const APART: f64 = 0.006;
/// Heights of orbits that are one in the figure.
const LEVEL: f64 = 1e-9;

/// How each way looks: squares, dots in them, and thin lines across, which dots on top would cut into dashes.
const WAYS: [(SweepDirection, &str, Marker, Color); 2] = [
    (
        SweepDirection::Down,
        "simulated, down",
        Marker::hollow(Shape::Square).sized(5.4),
        Color::Orange,
    ),
    (SweepDirection::Up, "simulated, up", Marker::dot().sized(3.8), Color::ReddishPurple),
];
const EXACT: [(bool, &str, Style); 2] = [
    (false, "exact orbit, unstable", Style::new(Color::Black, 1.0, Dash::Dashed)),
    (true, "exact orbit, stable", Style::new(Color::Black, 1.2, Dash::Solid)),
];
/// How a bifurcation is marked, where it is one that a reader of this figure looks for.
const KINDS: [(Bifurcation, Shape, Color); 6] = [
    (Bifurcation::SaddleNode, Shape::Cross, Color::Vermillion),
    (Bifurcation::SymmetryBreaking, Shape::Triangle, Color::BluishGreen),
    (Bifurcation::PeriodDoubling, Shape::Diamond, Color::Vermillion),
    (Bifurcation::NeimarkSacker, Shape::Circle, Color::Blue),
    (Bifurcation::Grazing, Shape::Square, Color::Black),
    (Bifurcation::Sticking, Shape::Triangle, Color::Black),
];

/// One panel: what is shown of a simulated motion and of an exact orbit at one value.
struct Heights<'a> {
    diagram: &'a Diagram,
    chart: Chart,
    simulated: fn(&DiagramPoint) -> Vec<f64>,
    exact: fn(&ExactPoint) -> Vec<f64>,
}

/// The largest displacement in each period above, the times between impacts below.
pub(super) fn figure(scene: &DrawnCase, diagram: &Diagram, bare: &[[f64; 2]]) -> Figure {
    let parameter = diagram.parameter;
    let own = parameter.of(scene.system());
    let log = [parameter.is_logarithmic(), parameter == Parameter::Amplitude];
    let peaks = |point: &DiagramPoint| point.period_peaks.clone();
    let range = fitted(diagram, log[1]);
    let kinds = [scene.kind(parameter), &of::PEAK];
    let upper = Heights {
        diagram,
        chart: scene.chart(kinds, [diagram.range, range]).with_log(log),
        simulated: peaks,
        exact: |point| vec![point.peak],
    };
    let mut first = upper.chart.panel().with(Layer::vertical(own, Role::Guide));
    let bare = Layer::curve(Role::BareOscillator, bare.to_vec());
    first = first.with(bare.labelled("without absorber"));
    upper.draw(scene, &mut first, true);
    if let Some((found, _)) = first_drawn(scene.study) {
        first = first.with(scene.star(&upper.chart, [own, found.facts().peak.value]));
    }
    let all = diagram.points.iter().flat_map(|point| &point.intervals);
    let longest = all.copied().fold(0.5, f64::max).min(LONGEST);
    let kinds = [scene.kind(parameter), &of::IMPACT_INTERVAL];
    let ranges = [diagram.range, [0.0, (1.0 + MARGIN) * longest]];
    let lower = Heights {
        diagram,
        chart: scene.chart(kinds, ranges).with_log([log[0], false]),
        simulated: |point| point.intervals.clone(),
        exact: |point| point.intervals.clone(),
    };
    let mut second = lower.chart.panel().with(Layer::vertical(own, Role::Guide));
    lower.draw(scene, &mut second, false);
    let name = match parameter {
        Parameter::Frequency => "diagram-frequency",
        Parameter::Amplitude => "diagram-forcing",
        _ => "diagram-clearance",
    };
    scene
        .figure(name, "captions/diagram", facts(scene, diagram))
        .with_size(800, 680)
        .with_layout(Layout::rows(&[1.5, 1.0]))
        .with_panel(first)
        .with_panel(second)
}

/// A range that shows all simulated points and every attracting orbit.
fn fitted(diagram: &Diagram, log: bool) -> [f64; 2] {
    let simulated = diagram.points.iter().flat_map(|point| &point.period_peaks).copied();
    let stable = diagram.exact.pieces.iter().filter(|piece| piece.stable);
    let exact = stable.flat_map(|piece| &piece.points).map(|point| point.peak);
    let all: Vec<f64> = simulated.chain(exact).filter(|value| *value > 0.0).collect();
    let low = all.iter().copied().fold(f64::INFINITY, f64::min);
    let high = all.iter().copied().fold(0.0, f64::max);
    if low >= high {
        return [low, f64::NAN];
    }
    let (ratio, room) = (libm::pow(high / low, MARGIN), MARGIN * (high - low));
    if log { [low / ratio, high * ratio] } else { [(low - room).max(0.0), high + room] }
}

impl Heights<'_> {
    fn draw(&self, scene: &DrawnCase, panel: &mut Panel, named: bool) {
        let label = |layer: Layer, name: &str| if named { layer.labelled(name) } else { layer };
        let (low, high) = panel.y.range.unwrap_or((0.0, 1.0));
        let log = panel.y.scale == AxisScale::Log;
        let part = |height: f64| {
            if log {
                libm::log(height / low) / libm::log(high / low)
            } else {
                (height - low) / (high - low)
            }
        };
        for (way, name, marker, color) in WAYS {
            let points = self.diagram.way(way).into_iter().flat_map(|point| {
                let all = (self.simulated)(point).into_iter();
                let all = all.map(|height| [point.value, height]);
                thinned(all.collect(), &part)
            });
            let layer = Layer::marked(marker, color, points);
            panel.layers.push(match self.told_apart(way).filter(|_| named) {
                Some(place) => layer.labelled(Label::near(name, place)),
                None => label(layer, name),
            });
        }
        for (stable, name, style) in EXACT {
            panel.layers.push(label(Layer::curve(style, self.lines(stable)), name));
        }
        for (kind, shape, color) in KINDS {
            let marker = Marker::hollow(shape).sized(8.0);
            let layer = Layer::marked(marker, color, self.marks(scene, kind));
            panel.layers.push(label(layer, kind.words()));
        }
    }

    fn marks(&self, scene: &DrawnCase, kind: Bifurcation) -> Vec<MarkedPoint> {
        let told = self.diagram.exact.marks.iter().filter(|mark| {
            mark.kind == kind && (mark.beside_stable || kind == Bifurcation::Grazing)
        });
        let all = told.flat_map(|mark| {
            let mut all = (self.exact)(&mark.at);
            all.dedup_by(|a, b| (*a - *b).abs() < 1e-6 * *b);
            all.into_iter().map(|y| scene.mark(&self.chart, [mark.at.value, y], kind.words()))
        });
        all.collect()
    }

    /// A place where only one way leads: in the widest hysteresis.
    fn told_apart(&self, way: SweepDirection) -> Option<[f64; 2]> {
        let width = |one: &&Hysteresis| one.values[1] / one.values[0];
        let found = self.diagram.hysteresis.iter();
        let widest = found.max_by(|a, b| width(a).total_cmp(&width(b)))?;
        let middle = f64::midpoint(widest.values[0], widest.values[1]);
        let peak = widest.peaks[usize::from(way == SweepDirection::Down)];
        Some([middle, peak])
    }

    /// All pieces of one stability as one line with gaps.
    fn lines(&self, stable: bool) -> Vec<[f64; 2]> {
        let mut line = Vec::new();
        let mut known: Vec<Vec<[f64; 2]>> = Vec::new();
        for piece in self.diagram.exact.pieces.iter().filter(|piece| piece.stable == stable) {
            let all: Vec<Vec<f64>> = piece.points.iter().map(self.exact).collect();
            for k in 0..all.first().map_or(0, Vec::len) {
                let points = piece.points.iter().zip(&all);
                let points = points.map(|(point, all)| [point.value, all[k]]);
                // Dashes over dashes would look solid.
                let Some(points) = outside(points.collect(), &known) else { continue };
                line.extend(points.iter().copied().chain([[f64::NAN; 2]]));
                known.push(points);
            }
        }
        line
    }
}

/// Points of one value that can be told apart, at most [`MOST_POINTS`], evenly chosen.
fn thinned(mut points: Vec<[f64; 2]>, part: &dyn Fn(f64) -> f64) -> Vec<[f64; 2]> {
    points.retain(|at| (0.0..=1.0).contains(&part(at[1])));
    points.sort_by(|a, b| a[1].total_cmp(&b[1]));
    points.dedup_by(|next, kept| part(next[1]) - part(kept[1]) < APART);
    if points.len() <= MOST_POINTS {
        return points;
    }
    let step = (points.len() - 1) as f64 / (MOST_POINTS - 1) as f64;
    (0..MOST_POINTS).map(|k| points[(step * k as f64) as usize]).collect()
}

/// A level line without what other level lines of its height cover already; any other line as it is.
fn outside(points: Vec<[f64; 2]>, known: &[Vec<[f64; 2]>]) -> Option<Vec<[f64; 2]>> {
    let height = points.first()?[1];
    let level = |line: &[[f64; 2]]| line.iter().all(|at| (at[1] - height).abs() < LEVEL);
    if !level(&points) {
        return Some(points);
    }
    let ends = |line: &[[f64; 2]]| {
        let low = line.iter().map(|at| at[0]).fold(f64::INFINITY, f64::min);
        [low, line.iter().map(|at| at[0]).fold(f64::NEG_INFINITY, f64::max)]
    };
    let [mut low, mut high] = ends(&points);
    for [from, to] in known.iter().filter(|line| level(line)).map(|line| ends(line)) {
        if from <= low {
            low = low.max(to);
        }
        if to >= high {
            high = high.min(from);
        }
    }
    (low < high).then(|| vec![[low, height], [high, height]])
}

fn facts(scene: &DrawnCase, diagram: &Diagram) -> Value {
    let kind = scene.kind(diagram.parameter);
    json!({
        "over": kind.id,
        "unit": scene.si(kind, 1.0),
        "digits": if diagram.parameter == Parameter::Frequency { 4 } else { 3 },
        "range": diagram.range,
        "steps": STEPS,
        "periods": PERIODS,
        "hysteresis": diagram.hysteresis,
        "attracting": diagram.exact.attracting_stretches(),
        "agreement": diagram.agreement.map(|found| found.largest),
    })
}
