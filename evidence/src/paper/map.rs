//! Where all panels of Figs. 11 and 12 hold, over natural frequency and forcing amplitude, by simulation; and the
//! boundaries that say why, in closed form.

use serde_json::{Value, json};

use super::PaperError;
use super::detuning::{Set, panels};
use vinesink::case::Case;
use vinesink::executor::{self, Executor};
use vinesink::motions::{Effort, follow, starts};
use vinesink::regimes::Regime;
use vinesink::report::figure::{
    Axis, AxisScale, Cells, Color, Dash, Figure, Image, Key, Layer, Layout, MarkedPoint, Marker,
    Panel, Shape, Style, Tint, edges,
};
use vinesink::study::StudyError;
use vinesink::system::System;

/// Natural frequencies over Table 1's, and how many of them.
const FREQUENCIES: (f64, f64, usize) = (0.946, 1.006, 61);
/// Forcing amplitudes in metres, in equal ratios, and how many of them.
const AMPLITUDES: (f64, f64, usize) = (4e-5, 3e-4, 61);
/// Evenly spread starts at each point.
const STARTS: u32 = 4;
/// How much holds at a point: not all of Fig. 11, all of it, Fig. 12 as well.
const TINTS: [(Tint, &str); 3] = [
    (Tint([0xFF, 0xFF, 0xFF]), "not all panels"),
    (Tint([0x9F, 0xD3, 0xEE]), "all six panels of Fig. 11"),
    (Tint([0x00, 0x72, 0xB2]), "and strong modulation at 15 mm"),
];

/// The largest `b_end/b_SB` that panels (c) and (e) allow, and the smallest `b_fold/b_end` for (e) and Fig. 12.
pub(super) fn bounds(clearances: &[f64]) -> [f64; 2] {
    [clearances[4] / clearances[2], clearances[6] / clearances[4]]
}

/// How much holds where, at one restitution.
pub(super) struct HoldsMap {
    /// Sets of parameters to mark; the first has the map's restitution.
    marks: Vec<(&'static str, Set)>,
    /// Row by row, that of the smallest `F` first.
    places: Vec<Set>,
    /// Which of [`TINTS`], of each place.
    cells: Vec<u8>,
    /// Table 1's `f0` in Hz.
    table_1: f64,
    /// Whether every place with all panels keeps both [`bounds`].
    bounded: bool,
}

impl HoldsMap {
    pub(super) fn of(
        case: &Case,
        marks: Vec<(&'static str, Set)>,
        clearances: &[f64],
        executor: &dyn Executor,
    ) -> Result<Self, PaperError> {
        let (table_1, restitution) = (Set::of(case).natural_frequency, marks[0].1.restitution);
        let places: Vec<Set> = axis(AMPLITUDES, true)
            .flat_map(|amplitude| {
                axis(FREQUENCIES, false).map(move |part| Set {
                    natural_frequency: part * table_1,
                    restitution,
                    amplitude,
                })
            })
            .collect();
        let found = executor::map(executor, "Figs. 11 and 12", places.len(), |k| {
            held(case, &places[k], clearances)
        });
        let cells: Vec<u8> = found.into_iter().collect::<Result<_, _>>()?;
        let ([most, least], mut bounded) = (bounds(clearances), true);
        for (set, _) in places.iter().zip(&cells).filter(|(_, held)| **held == 2) {
            let [breaking, end, fold] = set.limits(case)?;
            bounded &= end / breaking < most && fold / end > least;
        }
        Ok(Self { marks, places, cells, table_1, bounded })
    }

    /// Where what holds, `f0` by how much it is below Table 1's.
    pub(super) fn told(&self) -> Value {
        let among = |least: u8| {
            let here = || self.places.iter().zip(&self.cells).filter(move |(_, at)| **at >= least);
            let ends = |value: &dyn Fn(&Set) -> f64| {
                let values = || here().map(|(set, _)| value(set));
                [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)]
            };
            json!({
                "points": here().count(),
                "lower": ends(&|set| 1.0 - set.natural_frequency / self.table_1),
                "amplitude": ends(&|set| set.amplitude),
            })
        };
        json!({
            "restitution": self.marks[0].1.restitution,
            "starts": STARTS,
            "all": among(0),
            "six": among(1),
            "seven": among(2),
            "bounded": self.bounded,
        })
    }
}

/// Values from the first to the last, in equal steps or ratios.
fn axis((first, last, count): (f64, f64, usize), ratios: bool) -> impl Iterator<Item = f64> {
    (0..count).map(move |k| {
        let part = k as f64 / (count - 1) as f64;
        if ratios { first * libm::pow(last / first, part) } else { first + (last - first) * part }
    })
}

/// How much holds with a set: which of [`TINTS`]. The smallest clearance, with the most impacts, comes last.
fn held(case: &Case, set: &Set, clearances: &[f64]) -> Result<u8, PaperError> {
    let wanted: Vec<Regime> = panels().map(|(.., regime)| regime).collect();
    for panel in [4, 2, 3, 5, 1, 0] {
        if !every_start(&set.system(case, clearances[panel])?, wanted[panel])? {
            return Ok(0);
        }
    }
    Ok(1 + u8::from(every_start(&set.system(case, clearances[6])?, wanted[6])?))
}

/// Whether each start that moves the absorber leads to the regime, and one does.
fn every_start(system: &System, regime: Regime) -> Result<bool, PaperError> {
    let starts: Vec<_> = starts::spread(system, STARTS).map(|start| (*system, start)).collect();
    let found = follow(&starts, &Effort::default()).map_err(StudyError::from)?;
    let mut moving = found.iter().flatten().filter(|one| one.rest().is_none()).peekable();
    Ok(moving.peek().is_some() && moving.all(|one| one.regime() == regime))
}

/// The maps side by side, with the boundaries as lines.
pub(super) fn figure(
    maps: &[HoldsMap],
    case: &Case,
    clearances: &[f64],
) -> Result<Figure, PaperError> {
    let facts = json!({ "maps": maps.iter().map(HoldsMap::told).collect::<Vec<_>>() });
    let mut figure = Figure::new("nearer-resonance", "")
        .with_size(860, 480)
        .with_layout(Layout::columns(&vec![1.0; maps.len()]))
        .with_facts("captions/nearer-resonance", facts);
    figure.keys = TINTS[1..].iter().map(|one| Key::from(*one)).collect();
    for map in maps {
        figure = figure.with_panel(panel(map, case, clearances)?);
    }
    Ok(figure)
}

fn panel(map: &HoldsMap, case: &Case, clearances: &[f64]) -> Result<Panel, PaperError> {
    let amplitudes: Vec<f64> = axis(AMPLITUDES, true).collect();
    let row = &map.places[..FREQUENCIES.2];
    let frequencies: Vec<f64> = row.iter().map(|set| set.natural_frequency).collect();
    let image = Image {
        x_edges: edges(&frequencies, AxisScale::Linear),
        y_edges: edges(&amplitudes, AxisScale::Log),
        cells: Cells::Kinds(
            TINTS.map(|(tint, _)| tint).into(),
            map.cells.iter().copied().map(Some).collect(),
        ),
    };
    let ends = |of: &[f64]| (of[0], of[of.len() - 1]);
    let ((left, right), (low, high)) = (ends(&frequencies), ends(&amplitudes));
    let x = Axis::linear("natural frequency f0 (Hz)").with_range(left, right);
    let y = Axis::log("shaker amplitude F (mm)").with_factor(1e3).with_range(low, high);
    let mut panel = Panel::new(x, y)
        .with_heading(format!("r = {:.2}", map.marks[0].1.restitution))
        .with(Layer::Image(image));
    let style = |color, dash| Style::new(color, 1.8, dash);
    // Which limit is at which panel's clearance.
    for (name, limit, place, style) in [
        ("asymmetric at 4 mm above", 0, 2, style(Color::BluishGreen, Dash::DashDot)),
        ("no steady 1:1 at 11.5 mm below", 1, 4, style(Color::Vermillion, Dash::Dashed)),
        ("fold reached at 15 mm above", 2, 6, style(Color::Grey, Dash::Dotted)),
    ] {
        let mut line = Vec::new();
        for set in row {
            // A limit is proportional to F.
            let amplitude = set.amplitude * clearances[place] / set.limits(case)?[limit];
            line.push([set.natural_frequency, amplitude]);
        }
        panel.layers.push(Layer::curve(style, line).labelled(name));
    }
    let point = |(name, set): &(&str, Set)| {
        MarkedPoint::new(set.natural_frequency, set.amplitude).with_label(*name)
    };
    let marker = Marker::filled(Shape::Diamond).sized(11.0);
    Ok(panel.with(Layer::marked(marker, Color::Black, map.marks.iter().map(point))))
}
