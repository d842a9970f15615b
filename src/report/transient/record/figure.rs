//! The displacement over time, and the peak over the structure's natural frequency.

use serde_json::Value;

use crate::case::Case;
use crate::quantity::{Dimension, catalogue as of};
use crate::report::figure::{Axis, Color, Dash, Figure, Layer, Panel, Role, Rule, Style};
use crate::report::transient::DAMPER;
use crate::transient::{RecordStudy, SpectrumPoint};

/// Stretches of a line: of each its least and its largest value are drawn.
const STRETCHES: usize = 350;
const ABSORBER: Style = Style::new(Color::ReddishPurple, 1.8, Dash::Solid);

/// All figures.
pub fn figures(case: &Case, study: &RecordStudy, facts: &Value) -> Vec<Figure> {
    let figures = [
        (history(case, study), "captions/record-history"),
        (Some(spectrum(case, study)), "captions/record-spectrum"),
    ];
    let drawn = figures.into_iter().filter_map(|(figure, words)| Some((figure?, words)));
    drawn.map(|(figure, words)| figure.with_facts(words, facts.clone())).collect()
}

fn history(case: &Case, study: &RecordStudy) -> Option<Figure> {
    let units = case.units();
    let first = study.first()?;
    let (_, worst) = first.worst()?;
    let end = units.time(first.bare.trace.last()?[0]);
    let largest = [first.bare.peak, first.damped.peak, worst.peak].into_iter().fold(0.0, f64::max);
    let time_unit = units.axis_unit(&of::TIME, end).size;
    let length_unit = units.unit(Dimension::Length, units.length(largest)).size;
    let line = |trace: &[[f64; 2]]| -> Vec<[f64; 2]> {
        let at = |point: &[f64; 2]| {
            [units.time(point[0]) / time_unit, units.length(point[1]) / length_unit]
        };
        let ends = trace.chunks(trace.len() / STRETCHES + 1).flat_map(|stretch| {
            let by_size = |a: &&[f64; 2], b: &&[f64; 2]| a[1].total_cmp(&b[1]);
            let mut ends = [stretch.iter().min_by(by_size), stretch.iter().max_by(by_size)];
            ends.sort_by(|a, b| a.map_or(0.0, |a| a[0]).total_cmp(&b.map_or(0.0, |b| b[0])));
            ends
        });
        ends.flatten().map(at).collect()
    };
    let x = Axis::linear(units.axis_label(&of::TIME, end)).with_range(0.0, end / time_unit);
    let range = 1.08 * units.length(largest) / length_unit;
    let y = Axis::linear(units.axis_label(&of::DISPLACEMENT, units.length(largest)));
    let panel = Panel::new(x, y.with_range(-range, range))
        .with(
            Layer::curve(Role::BareOscillator, line(&first.bare.trace))
                .labelled("without absorber"),
        )
        .with(Layer::curve(Role::Simulation, line(&worst.trace)).labelled("absorber, worst place"));
    Some(Figure::new("history", "").with_panel(panel))
}

fn spectrum(case: &Case, study: &RecordStudy) -> Figure {
    let units = case.units();
    let peaks = study.spectrum.iter().flat_map(|one| [one.bare, one.absorber, one.damped]);
    let (least, most) = peaks
        .fold((f64::INFINITY, 0.0_f64), |(least, most), peak| (least.min(peak), most.max(peak)));
    let own = units.frequency(1.0);
    let frequency_unit = units.axis_unit(&of::STRUCTURE_FREQUENCY, own).size;
    let length_unit = units.unit(Dimension::Length, units.length(most)).size;
    let at = |ratio: f64, peak: f64| {
        [units.frequency(ratio) / frequency_unit, units.length(peak) / length_unit]
    };
    let line = |peak: fn(&SpectrumPoint) -> f64| -> Vec<[f64; 2]> {
        study.spectrum.iter().map(|one| at(one.ratio, peak(one))).collect()
    };
    let ends = [study.spectrum.first(), study.spectrum.last()]
        .map(|one| at(one.map_or(1.0, |one| one.ratio), 0.0)[0]);
    let x = Axis::log(units.axis_label(&of::STRUCTURE_FREQUENCY, own));
    let y = Axis::log(units.axis_label(&of::PEAK, units.length(most)));
    let y = y.with_range(0.8 * at(1.0, least)[1], 1.25 * at(1.0, most)[1]);
    let panel = Panel::new(x.with_range(ends[0], ends[1]), y)
        .with(Layer::rule(Rule::Vertical(at(1.0, 0.0)[0]), Role::Guide).labelled("this structure"))
        .with(Layer::curve(Role::BareOscillator, line(|one| one.bare)).labelled("without absorber"))
        .with(Layer::curve(DAMPER, line(|one| one.damped)).labelled("tuned mass damper"))
        .with(Layer::curve(ABSORBER, line(|one| one.absorber)).labelled("absorber, worst place"));
    Figure::new("response-spectrum", "").with_panel(panel)
}
