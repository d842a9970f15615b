//! Diagrams over one axis.

use serde_json::json;

use super::super::Swept;
use super::super::axis::AxisShown;
use super::super::grid::{self, Numbers};
use super::QUANTITIES;
use crate::case::Recorded;
use crate::quantity::Kind;
use crate::quantity::catalogue::{PEAK, SECTION};
use crate::regimes::Regime;
use crate::report::figure::{
    Axis, Cells, Color, Dash, Figure, Image, Key, Layer, Layout, Marker, Panel, Role, Shape, Style,
    Tick,
};
use crate::report::figures::regimes::{mark, tint};
use crate::report::transient::{DAMPER, THEORY};
use crate::sweep::columns::{self, Direction};

/// The template of the figures' words.
const WORDS: &str = "captions/sweep-line";

pub(super) fn all(swept: &Swept, axis: &AxisShown) -> Vec<Figure> {
    let diagram = LineDiagram { swept, axis, directions: swept.directions() };
    let values = |of: &dyn Fn(Recorded) -> bool| {
        let some = QUANTITIES.iter().filter(|(_, one, _)| of(*one));
        some.filter_map(|(name, one, _)| diagram.values(name, *one)).collect::<Vec<Figure>>()
    };
    let mut figures = values(&|one| one == Recorded::DecayTime);
    figures.extend(diagram.peaks().into_iter().chain(diagram.section()));
    let drawn = [Recorded::DecayTime, Recorded::LargestPeak, Recorded::Peak];
    figures.extend(values(&|one| !drawn.contains(&one)));
    figures
}

/// A quantity, and what else a structure could have, as a line beside it.
type Beside = (Recorded, Recorded, Style, &'static str);
const BARE: Style = Role::BareOscillator.style();
const BESIDE: [Beside; 6] = [
    (Recorded::DecayTime, Recorded::BareDecayTime, BARE, "without absorber"),
    (Recorded::DecayTime, Recorded::DamperDecayTime, DAMPER, "tuned mass damper"),
    (Recorded::DecayTime, Recorded::TheoryDecayTime, THEORY, "theory"),
    (Recorded::Peak, Recorded::BareAmplitude, BARE, "without absorber"),
    (Recorded::Peak, Recorded::BarePeak, BARE, "without absorber"),
    (Recorded::Peak, Recorded::DamperPeak, DAMPER, "tuned mass damper"),
];

struct LineDiagram<'a> {
    swept: &'a Swept<'a>,
    axis: &'a AxisShown,
    directions: Vec<Direction>,
}

impl LineDiagram<'_> {
    /// A figure with one panel, the case's own value marked; nothing where nothing is drawn.
    fn figure(&self, name: &str, of: &Kind, y: Axis, layers: Vec<Layer>) -> Option<Figure> {
        if layers.is_empty() {
            return None;
        }
        let mut panel = Panel::new(self.axis.drawn(), y);
        panel.layers = layers;
        panel.layers.extend(self.axis.own_within().map(|own| {
            let style = Style::new(Color::Grey, 1.2, Dash::DashDot);
            Layer::vertical(own, style).labelled("this case")
        }));
        let facts = json!({
            "of": of.id, "x": self.axis.kind.id, "x_ends": self.axis.ends(),
            "followed": self.directions.len() > 1, "steady": self.swept.is_steady(), "several": self.swept.is_of_several(),
            "simulated": self.directions.iter().any(|way| {
                let is_there = |of: Recorded| self.swept.cells(of.key(), *way).is_some();
                is_there(Recorded::Peak) || is_there(Recorded::LargestPeak)
            }),
        });
        Some(Figure::new(name, "").with_panel(panel).with_facts(WORDS, facts))
    }

    /// A quantity of the main motion over the axis.
    fn values(&self, name: &str, of: Recorded) -> Option<Figure> {
        let all = self.swept.in_directions(of);
        let beside = self.beside(of);
        let columns = all.iter().map(|(_, one)| one).chain(beside.iter().map(|(one, _)| one));
        let y = self.swept.axis_of(of.kind()?, columns);
        let mut layers = self.lines(&beside);
        layers.extend(all.iter().flat_map(|(way, values)| self.marks(*way, values)));
        self.figure(name, of.kind()?, y, layers)
    }

    fn beside(&self, of: Recorded) -> Vec<(Numbers, Beside)> {
        let all = BESIDE.into_iter().filter(|one| one.0 == of);
        all.filter_map(|one| Some((self.swept.numbers(one.1, Direction::Single)?, one))).collect()
    }

    fn lines(&self, beside: &[(Numbers, Beside)]) -> Vec<Layer> {
        let line = |(values, (.., style, name)): &(Numbers, Beside)| {
            Layer::curve(*style, self.line(values)).labelled(*name)
        };
        beside.iter().map(line).collect()
    }

    /// The peak over the axis, with exact orbit and bare oscillator as lines; a strip of regimes below where the
    /// way up and the way down are both drawn.
    fn peaks(&self) -> Option<Figure> {
        let of = |recorded| self.swept.numbers(recorded, Direction::Single);
        let [orbit, largest] = [Recorded::OrbitPeak, Recorded::LargestPeak].map(of);
        let beside = self.beside(Recorded::Peak);
        let mut peaks = self.swept.in_directions(Recorded::Peak);
        // Over a range of frequencies no motion is the most common one.
        if peaks.is_empty() {
            peaks = self.swept.in_directions(Recorded::LargestPeak);
        }
        let all = peaks.iter().map(|(_, one)| one).chain(beside.iter().map(|(one, _)| one));
        let y = self.swept.axis_of(&PEAK, all.chain(&orbit));
        let mut layers = self.lines(&beside);
        if let (Some(largest), [(Direction::Single, main)]) = (largest, peaks.as_slice()) {
            layers.extend(self.others(&largest, main));
        }
        for (way, values) in &peaks {
            layers.extend(self.marks(*way, values));
        }
        // In front of the marks, which would else hide it where they agree.
        let orbit = orbit.filter(|orbit| orbit.iter().any(Option::is_some));
        layers.extend(orbit.map(|orbit| {
            Layer::curve(Role::ExactOrbit, self.line(&orbit)).labelled("exact 1:1 orbit")
        }));
        let figure = self.figure("sweep-bifurcation", &PEAK, y, layers)?;
        Some(if self.directions.len() > 1 { self.with_strip(figure) } else { figure })
    }

    /// Other motions, where they are told apart from the main one at this size.
    fn others(&self, largest: &Numbers, main: &Numbers) -> Option<Layer> {
        let other = |(largest, main): (&Option<f64>, &Option<f64>)| {
            largest.filter(|largest| main.is_none_or(|main| *largest > 1.01 * main))
        };
        let others: Numbers = largest.iter().zip(main).map(other).collect();
        let marker = Marker::hollow(Shape::Diamond).sized(5.0);
        let points = self.points(&others);
        let layer = |points| Layer::marked(marker, Color::Grey, points);
        (!points.is_empty()).then(|| layer(points).labelled("largest other motion"))
    }

    /// The displacement once a period, at the end of the last periods.
    fn section(&self) -> Option<Figure> {
        let named = |way: &Direction| {
            let names = columns::names(Recorded::Section);
            let all = names.iter().filter_map(|name| self.swept.named(name, *way));
            (*way, all.collect::<Vec<Numbers>>())
        };
        let all: Vec<_> = self.directions.iter().map(named).collect();
        let columns = all.iter().flat_map(|(_, columns)| columns);
        let y = self.swept.axis_of(&SECTION, columns);
        let layers = all.iter().filter_map(|(way, columns)| {
            let dots = columns.iter().flat_map(|column| self.points(column));
            let dots: Vec<[f64; 2]> = dots.collect();
            if dots.is_empty() {
                return None;
            }
            let marker = Marker { filled: *way != Direction::Down, ..Marker::dot() };
            let layer = Layer::marked(marker, way_mark(*way).1, dots);
            let single = *way == Direction::Single;
            Some(if single { layer } else { layer.labelled(grid::words(*way)) })
        });
        self.figure("sweep-section", &SECTION, y, layers.collect())
    }

    fn points(&self, values: &Numbers) -> Vec<[f64; 2]> {
        let pairs = self.axis.values.iter().zip(values);
        pairs.filter_map(|(x, y)| Some([*x, (*y)?])).collect()
    }

    /// A line that is interrupted where there is no value.
    fn line(&self, values: &Numbers) -> Vec<[f64; 2]> {
        let pairs = self.axis.values.iter().zip(values);
        pairs.map(|(x, y)| [*x, y.unwrap_or(f64::NAN)]).collect()
    }

    /// Points of each regime in its own colour and mark; or of a direction, where there are two.
    fn marks(&self, way: Direction, values: &Numbers) -> Vec<Layer> {
        let layer = |(marker, color), points: Vec<[f64; 2]>, name: &'static str| {
            (!points.is_empty()).then(|| Layer::marked(marker, color, points).labelled(name))
        };
        let Some(regimes) = self.swept.regimes(way).filter(|_| way == Direction::Single) else {
            let layer = layer(way_mark(way), self.points(values), grid::words(way));
            return layer.into_iter().collect();
        };
        let of = |regime: Regime| {
            let here = values.iter().zip(&regimes);
            let here = here.map(|(value, one)| value.filter(|_| *one == Some(regime)));
            layer(mark(regime), self.points(&here.collect()), regime.short())
        };
        Regime::ALL.into_iter().filter_map(of).collect()
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
            let name = if *way == Direction::Up { "up" } else { "down" };
            Tick { value: f64::from(row) + 0.5, label: Some(name.to_owned()) }
        });
        let y = Axis::of_ticks((0.0, rows.len() as f64), ticks.collect());
        let present = |regime: &Regime| rows.iter().flatten().any(|one| *one == Some(*regime));
        let shown = Regime::ALL.into_iter().filter(present);
        figure.keys = shown.map(|regime| Key::from((tint(regime), regime.words()))).collect();
        let strip = Panel::new(self.axis.drawn(), y).with(Layer::Image(image));
        figure.with_size(720, 560).with_layout(Layout::rows(&[5.0, 1.0])).with_panel(strip)
    }
}

/// How points of a direction look where colours do not tell regimes.
fn way_mark(way: Direction) -> (Marker, Color) {
    match way {
        Direction::Down => (Marker::hollow(Shape::Square).sized(5.4), Color::Blue),
        _ => (Marker::filled(Shape::Circle).sized(4.4), Color::ReddishPurple),
    }
}
