//! Bifurcation diagrams: one parameter swept up and down by simulation, with the exact orbits over it.

use crate::orbits::Bifurcation;
use crate::regimes::diagram::{DiagramPoint, SweepDirection};
use crate::report::figure::{
    Axis, Color, Dash, Figure, Label, Layer, Layout, MarkedPoint, Marker, Panel, Role, Rule, Scale,
    Shape, Style,
};
use crate::report::numbers::significant;
use crate::study::StudyError;
use crate::study::diagrams::{Diagram, Hysteresis};
use crate::study::exact_branches::ExactPoint;
use crate::system::Parameter;
use crate::validation::tolerance::has_resonance;

use super::Scene;
use super::diagram_lines::thinned;
use crate::report::units::Units;

/// Longest time between impacts that is shown, in periods; a modulated motion has single longer ones.
const LONGEST: f64 = 1.6;
/// Room above and below the points, as part of their span.
const MARGIN: f64 = 0.06;
/// Samples of the oscillator without absorber.
const BARE: u32 = 200;

pub(super) fn figure(
    scene: &Scene,
    name: &str,
    parameter: Parameter,
) -> Result<Option<Figure>, StudyError> {
    let (study, units) = (scene.study, &scene.units);
    let system = &study.analysis.system;
    if system.forcing_per_clearance() == 0.0 || !has_resonance(system) {
        return Ok(None);
    }
    let Some(diagram) = Diagram::around(&study.exact, parameter)? else { return Ok(None) };
    let shown = Shown { scene, units, diagram: &diagram };
    let (caption, alt) = shown.words();
    let title = format!("Bifurcation diagram over the {}", parameter.words());
    Ok(Some(
        Figure::new(name, title)
            .with_size(800, 680)
            .with_layout(Layout::rows(&[1.5, 1.0]))
            .with_panel(shown.peaks())
            .with_panel(shown.intervals())
            .with_words(caption, alt),
    ))
}

/// How each way looks: squares, dots in them, and thin lines across, which dots on top would cut into
/// dashes.
const DOWN: (SweepDirection, &str, Marker, Color) = (
    SweepDirection::Down,
    "simulated, down",
    Marker::hollow(Shape::Square).sized(5.4),
    Color::Orange,
);
const UP: (SweepDirection, &str, Marker, Color) =
    (SweepDirection::Up, "simulated, up", Marker::dot().sized(3.8), Color::ReddishPurple);

const STABLE: Style = Style::new(Color::Black, 1.2, Dash::Solid);
const UNSTABLE: Style = Style::new(Color::Black, 1.0, Dash::Dashed);

/// How a bifurcation is marked, where it is one that a reader of this figure looks for.
const KINDS: [(Bifurcation, Shape, Color); 6] = [
    (Bifurcation::SaddleNode, Shape::Cross, Color::Vermillion),
    (Bifurcation::SymmetryBreaking, Shape::Triangle, Color::BluishGreen),
    (Bifurcation::PeriodDoubling, Shape::Diamond, Color::Vermillion),
    (Bifurcation::NeimarkSacker, Shape::Circle, Color::Blue),
    (Bifurcation::Grazing, Shape::Square, Color::Black),
    (Bifurcation::Sticking, Shape::Triangle, Color::Black),
];

/// What the panels show.
pub(super) struct Shown<'a> {
    scene: &'a Scene<'a>,
    pub units: &'a Units,
    pub diagram: &'a Diagram,
}

/// Heights of what is at one value: of a simulated motion, and of an exact orbit.
pub(super) struct Heights<'a> {
    simulated: &'a dyn Fn(&DiagramPoint) -> Vec<f64>,
    pub exact: &'a dyn Fn(&ExactPoint) -> Vec<f64>,
}

impl Shown<'_> {
    pub(super) fn place(&self, value: f64) -> f64 {
        match self.diagram.parameter {
            Parameter::Clearance => self.units.length(value),
            Parameter::FrequencyRatio => self.units.frequency(value),
            Parameter::Forcing => self.units.forcing(value),
            Parameter::Restitution => value,
        }
    }

    pub(super) fn text(&self, value: f64) -> String {
        match self.diagram.parameter {
            Parameter::Clearance => self.units.length_text(value),
            Parameter::FrequencyRatio => self.units.frequency_text(value),
            Parameter::Forcing => self.units.forcing_text(value),
            Parameter::Restitution => significant(value, 3),
        }
    }

    fn axis(&self) -> Axis {
        let parameter = self.diagram.parameter;
        let [first, last] = self.diagram.range.map(|value| self.place(value));
        let label = match parameter {
            Parameter::Clearance => self.units.length_axis("clearance b"),
            Parameter::FrequencyRatio => self.units.frequency_axis().to_owned(),
            Parameter::Forcing => self.units.forcing_axis(),
            Parameter::Restitution => "restitution r (1)".to_owned(),
        };
        let axis = if parameter.is_logarithmic() { Axis::log(label) } else { Axis::linear(label) };
        axis.with_range(first, last)
    }

    fn own(&self) -> f64 {
        self.diagram.parameter.of(&self.scene.study.analysis.system)
    }

    /// Largest displacement in each period.
    fn peaks(&self) -> Panel {
        let units = self.units;
        let heights = Heights {
            simulated: &|point| point.period_peaks.iter().map(|peak| units.length(*peak)).collect(),
            exact: &|point| vec![units.length(point.peak)],
        };
        let log = self.diagram.parameter == Parameter::Forcing;
        let name = units.length_axis("peak of x in each period");
        let axis = if log { Axis::log(name) } else { Axis::linear(name) };
        let axis = self.fitted(axis, &heights);
        let mut panel = Panel::new(self.axis(), axis).with(self.case());
        let bare = Layer::curve(Role::BareOscillator, self.bare());
        panel = panel.with(bare.labelled("without absorber"));
        self.draw(&mut panel, &heights, true);
        let found = self.scene.first_drawn().map(|found| found.attractor.peak);
        if let Some(peak) = found {
            let at = [self.place(self.own()), units.length(peak)];
            let words = format!("this case: peak {}", units.length_text(peak));
            panel = panel.with(Layer::this_case(at, Some(words)));
        }
        panel
    }

    /// Times between impacts.
    fn intervals(&self) -> Panel {
        let heights = Heights {
            simulated: &|point| point.intervals.clone(),
            exact: &|point| point.intervals.clone(),
        };
        let all = self.diagram.points.iter().flat_map(|point| &point.intervals);
        let longest = all.copied().fold(0.5, f64::max).min(LONGEST);
        let axis = Axis::linear("impact interval over period (1)")
            .with_range(0.0, (1.0 + MARGIN) * longest);
        let mut panel = Panel::new(self.axis(), axis).with(self.case());
        self.draw(&mut panel, &heights, false);
        panel
    }

    fn case(&self) -> Layer {
        Layer::rule(Rule::Vertical(self.place(self.own())), Role::Guide.style())
    }

    /// The oscillator alone.
    fn bare(&self) -> Vec<[f64; 2]> {
        let [low, high] = self.diagram.range;
        let parameter = self.diagram.parameter;
        let system = &self.scene.study.analysis.system;
        let at = |k: u32| {
            let value = low + (high - low) * f64::from(k) / f64::from(BARE);
            let there = parameter.applied(system, value).ok()?;
            let amplitude = parameter.unit(value) * there.linear_response()?.amplitude();
            Some([self.place(value), self.units.length(amplitude)])
        };
        (0..=BARE).filter_map(at).collect()
    }

    /// An axis that shows all simulated points and every attracting orbit.
    fn fitted(&self, axis: Axis, heights: &Heights) -> Axis {
        let simulated = self.diagram.points.iter().flat_map(heights.simulated);
        let stable = self.diagram.exact.pieces.iter().filter(|piece| piece.stable);
        let exact = stable.flat_map(|piece| &piece.points).flat_map(heights.exact);
        let all = || simulated.clone().chain(exact.clone()).filter(|value| *value > 0.0);
        let (low, high) = (all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max));
        if low >= high {
            return axis;
        }
        if axis.scale == Scale::Log {
            let room = libm::pow(high / low, MARGIN);
            return axis.with_range(low / room, high * room);
        }
        let room = MARGIN * (high - low);
        axis.with_range((low - room).max(0.0), high + room)
    }

    /// A place where only one way leads: in the widest hysteresis.
    fn told_apart(&self, way: SweepDirection) -> Option<[f64; 2]> {
        let width = |one: &&Hysteresis| one.values[1] / one.values[0];
        let found = self.diagram.hysteresis.iter();
        let widest = found.max_by(|a, b| width(a).total_cmp(&width(b)))?;
        let middle = f64::midpoint(widest.values[0], widest.values[1]);
        let peak = widest.peaks[usize::from(way == SweepDirection::Down)];
        Some([self.place(middle), self.units.length(peak)])
    }

    fn draw(&self, panel: &mut Panel, heights: &Heights, named: bool) {
        let label = |layer: Layer, name: &str| if named { layer.labelled(name) } else { layer };
        let (low, high) = panel.y.range.unwrap_or((0.0, 1.0));
        let log = panel.y.scale == Scale::Log;
        let part = |height: f64| {
            if log {
                libm::log(height / low) / libm::log(high / low)
            } else {
                (height - low) / (high - low)
            }
        };
        let way = |(way, name, marker, color): (SweepDirection, &str, Marker, Color)| {
            let points = self.diagram.way(way).into_iter().flat_map(|point| {
                let x = self.place(point.value);
                thinned((heights.simulated)(point), &part).into_iter().map(move |y| [x, y])
            });
            let layer = Layer::marked(marker, color, points);
            match self.told_apart(way).filter(|_| named) {
                Some(place) => layer.labelled(Label::near(name, place)),
                None => label(layer, name),
            }
        };
        let exact = |stable: bool, style: Style, name: &str| {
            label(Layer::styled(style, self.lines(stable, heights)), name)
        };
        panel.layers.extend([
            way(DOWN),
            way(UP),
            exact(false, UNSTABLE, "exact orbit, unstable"),
            exact(true, STABLE, "exact orbit, stable"),
        ]);
        for (kind, shape, color) in KINDS {
            let marks = self.diagram.exact.marks.iter().filter(|mark| {
                let told = mark.beside_stable || kind == Bifurcation::Grazing;
                mark.kind == kind && told
            });
            let points: Vec<MarkedPoint> = marks
                .flat_map(|mark| {
                    let words = format!("{} at {}", kind.words(), self.text(mark.at.value));
                    let mut all = (heights.exact)(&mark.at);
                    all.dedup_by(|a, b| (*a - *b).abs() < 1e-6 * *b);
                    let x = self.place(mark.at.value);
                    all.into_iter().map(move |y| MarkedPoint::new(x, y).with_tooltip(words.clone()))
                })
                .collect();
            if !points.is_empty() {
                let marker = Marker::hollow(shape).sized(8.0);
                panel.layers.push(label(Layer::marked(marker, color, points), kind.words()));
            }
        }
    }
}
