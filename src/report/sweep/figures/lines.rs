//! Diagrams over one axis.

use serde_json::json;

use super::super::Swept;
use super::super::axis::AxisShown;
use super::super::grid::{Measure, Numbers, SweepDirection};
use super::super::kinds::{mark, tint};
use super::QUANTITIES;
use crate::case::Recorded;
use crate::quantity::catalogue::{PEAK, SECTION};
use crate::regimes::Regime;
use crate::report::figure::{
    Axis, Cells, Color, Dash, Figure, Image, Layer, Layout, MarkedPoint, Marker, Panel, Role, Rule,
    Shape, Style, Tick,
};
use crate::sweep::columns::{self, kind};

/// The template of the figures' words.
const WORDS: &str = "captions/sweep-line";

pub(super) fn all(swept: &Swept, axis: &AxisShown) -> Vec<Figure> {
    let diagram = Diagram { swept, axis, directions: swept.directions() };
    let mut figures: Vec<Figure> = diagram.peaks().into_iter().chain(diagram.section()).collect();
    let others = QUANTITIES.iter().filter(|(_, of, _)| *of != Recorded::Peak);
    figures.extend(others.filter_map(|(name, of, _)| diagram.values(name, *of)));
    figures
}

struct Diagram<'a> {
    swept: &'a Swept<'a>,
    axis: &'a AxisShown,
    directions: Vec<SweepDirection>,
}

impl Diagram<'_> {
    /// A figure with one panel, the case's own value marked; nothing where nothing is drawn.
    fn figure(&self, name: &str, of: &str, label: String, layers: Vec<Layer>) -> Option<Figure> {
        if layers.is_empty() {
            return None;
        }
        let mut panel = Panel::new(self.axis.drawn(), Axis::linear(label));
        panel.layers = layers;
        panel.layers.extend(self.axis.own_within().map(|own| {
            let style = Style::new(Color::Grey, 1.2, Dash::DashDot);
            Layer::rule(Rule::Vertical(own), style).labelled("this case")
        }));
        let facts = json!({
            "of": of, "x": self.axis.kind.id, "x_ends": self.axis.ends(),
            "followed": self.directions.len() > 1,
            "simulated": self.directions.iter().any(|way| self.swept.numbers(Recorded::Peak, *way).is_some())
        });
        Some(Figure::new(name, "").with_panel(panel).with_facts(WORDS, facts))
    }

    /// A quantity of the main motion over the axis.
    fn values(&self, name: &str, of: Recorded) -> Option<Figure> {
        let known = |way: &SweepDirection| Some((*way, self.swept.numbers(of, *way)?));
        let all: Vec<_> = self.directions.iter().filter_map(known).collect();
        let measure = Measure::of(&self.swept.units(), kind(of)?, all.iter().map(|(_, one)| one));
        let all = all.iter().flat_map(|(way, values)| self.marks(*way, &measure.shown(values)));
        self.figure(name, kind(of)?.id, measure.label.clone(), all.collect())
    }

    /// The peak over the axis, with exact orbit and bare oscillator as lines; a strip of regimes below where the
    /// way up and the way down are both drawn.
    fn peaks(&self) -> Option<Figure> {
        let of = |recorded| self.swept.numbers(recorded, SweepDirection::Single);
        let [bare, orbit, largest] =
            [Recorded::BareAmplitude, Recorded::OrbitPeak, Recorded::LargestPeak].map(of);
        let known = |way: &SweepDirection| Some((*way, self.swept.numbers(Recorded::Peak, *way)?));
        let peaks: Vec<_> = self.directions.iter().filter_map(known).collect();
        let all = peaks.iter().map(|(_, one)| one).chain(&bare).chain(&orbit);
        let measure = Measure::of(&self.swept.units(), &PEAK, all);
        let mut layers = Vec::new();
        layers.extend(bare.map(|bare| {
            let line = self.line(&measure.shown(&bare));
            Layer::curve(Role::BareOscillator, line).labelled("without absorber")
        }));
        if let (Some(largest), [(SweepDirection::Single, main)]) = (largest, peaks.as_slice()) {
            layers.extend(self.others(&measure, &largest, main));
        }
        for (way, values) in &peaks {
            layers.extend(self.marks(*way, &measure.shown(values)));
        }
        // In front of the marks, which would else hide it where they agree.
        let orbit = orbit.filter(|orbit| orbit.iter().any(Option::is_some));
        layers.extend(orbit.map(|orbit| {
            let line = self.line(&measure.shown(&orbit));
            Layer::curve(Role::ExactOrbit, line).labelled("exact 1:1 orbit")
        }));
        let figure = self.figure("sweep-bifurcation", PEAK.id, measure.label.clone(), layers)?;
        Some(if self.directions.len() > 1 { self.with_strip(figure) } else { figure })
    }

    /// Other motions, where they are told apart from the main one at this size.
    fn others(&self, measure: &Measure, largest: &Numbers, main: &Numbers) -> Option<Layer> {
        let other = |(largest, main): (&Option<f64>, &Option<f64>)| {
            largest.filter(|largest| main.is_none_or(|main| *largest > 1.01 * main))
        };
        let others: Numbers = largest.iter().zip(main).map(other).collect();
        let marker = Marker::hollow(Shape::Diamond).sized(5.0);
        let layer = Layer::marked(marker, Color::Grey, self.points(&measure.shown(&others)));
        let any = others.iter().any(Option::is_some);
        any.then(|| layer.labelled("largest other motion"))
    }

    /// The displacement once a period, at the end of the last periods.
    fn section(&self) -> Option<Figure> {
        let named = |way: SweepDirection| {
            let columns = 1..=columns::SECTION;
            let all = columns.filter_map(|k| self.swept.named(&format!("section_{k:02}"), way));
            (way, all.collect::<Vec<Numbers>>())
        };
        let all: Vec<_> = self.directions.iter().map(|way| named(*way)).collect();
        let columns = all.iter().flat_map(|(_, columns)| columns);
        let measure = Measure::of(&self.swept.units(), &SECTION, columns);
        let layers = all.iter().filter_map(|(way, columns)| {
            let dots = columns.iter().flat_map(|column| self.points(&measure.shown(column)));
            let dots: Vec<[f64; 2]> = dots.collect();
            let (_, color) = way_mark(*way);
            let filled = *way != SweepDirection::Down;
            let layer = Layer::marked(Marker { filled, ..Marker::dot() }, color, dots.clone());
            let single = *way == SweepDirection::Single;
            let layer = if single { layer } else { layer.labelled(way.words()) };
            (!dots.is_empty()).then_some(layer)
        });
        self.figure("sweep-section", SECTION.id, measure.label.clone(), layers.collect())
    }

    fn points(&self, values: &Numbers) -> Vec<[f64; 2]> {
        let pairs = self.axis.shown.iter().zip(values);
        pairs.filter_map(|(x, y)| Some([*x, (*y)?])).collect()
    }

    /// A line that is interrupted where there is no value.
    fn line(&self, values: &Numbers) -> Vec<[f64; 2]> {
        let pairs = self.axis.shown.iter().zip(values);
        pairs.map(|(x, y)| [*x, y.unwrap_or(f64::NAN)]).collect()
    }

    /// Points of each regime in its own colour and mark; or of a direction, where there are two.
    fn marks(&self, way: SweepDirection, values: &Numbers) -> Vec<Layer> {
        let known = values.iter().any(Option::is_some);
        match self.swept.regimes(way).filter(|_| way == SweepDirection::Single) {
            Some(regimes) => {
                let of = |regime: Regime| {
                    let here = (0..values.len()).filter(|k| regimes[*k] == Some(regime));
                    let here =
                        here.filter_map(|k| Some(MarkedPoint::new(self.axis.shown[k], values[k]?)));
                    let (here, (marker, color)) = (here.collect::<Vec<_>>(), mark(regime));
                    let layer = || Layer::marked(marker, color, here.clone());
                    (!here.is_empty()).then(|| layer().labelled(regime.short()))
                };
                Regime::ALL.into_iter().filter_map(of).collect()
            }
            None if known => {
                let (marker, color) = way_mark(way);
                vec![Layer::marked(marker, color, self.points(values)).labelled(way.words())]
            }
            None => Vec::new(),
        }
    }

    /// The regimes of each direction as a row of colours below, the first above the second.
    fn with_strip(&self, mut figure: Figure) -> Figure {
        let rows: Option<Vec<_>> =
            self.directions.iter().map(|way| self.swept.regimes(*way)).collect();
        let Some(rows) = rows else { return figure };
        let cells = rows.iter().rev().flatten();
        let image = Image {
            x_edges: self.axis.edges(),
            y_edges: (0..=rows.len()).map(|k| k as f64).collect(),
            cells: Cells::Kinds(
                Regime::ALL.map(tint).to_vec(),
                cells.map(|regime| regime.map(|one| one.index() as u8)).collect(),
            ),
        };
        let ticks = self.directions.iter().rev().zip(0_u8..).map(|(way, row)| {
            let name = if *way == SweepDirection::Up { "up" } else { "down" };
            Tick { value: f64::from(row) + 0.5, label: Some(name.to_owned()) }
        });
        let y = Axis::linear("").with_range(0.0, rows.len() as f64).with_ticks(ticks.collect());
        let present = |regime: &Regime| rows.iter().flatten().any(|one| *one == Some(*regime));
        for regime in Regime::ALL.into_iter().filter(present) {
            figure = figure.with_key(tint(regime), regime.words());
        }
        let strip = Panel::new(self.axis.drawn(), y).with(Layer::Image(image));
        figure.with_size(720, 560).with_layout(Layout::rows(&[5.0, 1.0])).with_panel(strip)
    }
}

/// How points of a direction look where colours do not tell regimes.
fn way_mark(way: SweepDirection) -> (Marker, Color) {
    match way {
        SweepDirection::Down => (Marker::hollow(Shape::Square).sized(5.4), Color::Blue),
        _ => (Marker::filled(Shape::Circle).sized(4.4), Color::ReddishPurple),
    }
}
