//! The envelope over frequency, and the largest displacement by rate.

use serde_json::Value;

use crate::case::Case;
use crate::excitation::SweepRate;
use crate::quantity::{Dimension, catalogue as of};
use crate::report::figure::{Axis, Color, Dash, Figure, Layer, MarkedPoint, Panel, Role, Style};
use crate::report::transient::DAMPER;
use crate::transient::SweepStudy;

/// Points of a line: as many as there are pixels.
const POINTS: usize = 700;
const BACK: Style = Style::new(Color::SkyBlue, 1.1, Dash::Solid);

/// All figures.
pub fn figures(case: &Case, study: &SweepStudy, facts: &Value) -> Vec<Figure> {
    // Nothing moves without an excitation.
    if study.alone.peak()[1] == 0.0 {
        return Vec::new();
    }
    let figures = [("envelope", envelope(case, study)), ("rates", rates(case, study))];
    let figure = |(name, panel): (&str, Panel)| {
        let template =
            if name == "envelope" { "captions/sine-sweep" } else { "captions/sweep-rates" };
        Figure::new(name, "").with_panel(panel).with_facts(template, facts.clone())
    };
    figures.map(figure).into()
}

fn envelope(case: &Case, study: &SweepStudy) -> Panel {
    let units = case.units();
    let [from, to] = [study.sweep.from, study.sweep.to];
    let highest = from.max(to);
    let peak = |passage: &crate::flights::Passage| passage.peak()[1];
    let there = study.worst().map(|(_, worst)| worst);
    let own = there.map_or(0.0, peak);
    let largest = own.max(peak(&study.back)).max(peak(&study.alone));
    let frequency_unit = units.axis_unit(&of::EXCITATION_FREQUENCY, highest).size;
    let length_unit = units.unit(Dimension::Length, units.length(largest)).size;
    let at = |[ratio, length]: [f64; 2]| {
        [units.frequency(ratio) / frequency_unit, units.length(length) / length_unit]
    };
    let line = |envelope: &[[f64; 2]]| {
        // The largest of what shares a pixel.
        let together = envelope.len() / POINTS + 1;
        let larger = |a: &[f64; 2], b: &[f64; 2]| a[1].total_cmp(&b[1]);
        let groups = envelope.chunks(together);
        groups.filter_map(|some| some.iter().copied().max_by(|a, b| larger(a, b))).map(at).collect()
    };
    let steady = |k: usize| {
        let within = |[ratio, length]: [f64; 2]| {
            at([ratio, if length > 1.1 * largest { f64::NAN } else { length }])
        };
        study.steady.iter().map(|one| within([one[0], one[k]])).collect::<Vec<_>>()
    };
    let x = Axis::linear(units.axis_label(&of::EXCITATION_FREQUENCY, highest));
    let x = x.with_range(from.min(to) / frequency_unit, highest / frequency_unit);
    let y = Axis::linear(units.axis_label(&of::PEAK, units.length(largest)));
    let y = y.with_range(0.0, 1.1 * at([0.0, largest])[1]);
    let [own_name, back_name] = if from > to { ["down", "up"] } else { ["up", "down"] };
    let mut panel = Panel::new(x, y)
        .with(Layer::curve(Role::BareOscillator, steady(1)).labelled("steady, without absorber"))
        .with(Layer::curve(DAMPER, line(&study.damped.1.envelope)).labelled("tuned mass damper"))
        .with(Layer::curve(Role::Guide, line(&study.alone.envelope)).labelled("without absorber"))
        .with(Layer::curve(BACK, line(&study.back.envelope)).labelled(back_name));
    if let Some(there) = there {
        panel =
            panel.with(Layer::curve(Role::Simulation, line(&there.envelope)).labelled(own_name));
    }
    if study.steady.iter().any(|one| one[2].is_finite()) {
        let orbit = Layer::curve(Role::Stable, steady(2)).labelled("stable 1:1 motion, exact");
        panel = panel.with(orbit);
    }
    let marks: Vec<MarkedPoint> =
        study.jumps.iter().flatten().map(|jump| at([jump.at, jump.levels[1]]).into()).collect();
    if !marks.is_empty() {
        panel = panel.with(Layer::points(Role::Impact, marks).labelled("jump"));
    }
    panel
}

fn rates(case: &Case, study: &SweepStudy) -> Panel {
    let units = case.units();
    let size = |rate: SweepRate| match rate {
        SweepRate::Linear(rate) => (&of::SWEEP_RATE, rate),
        SweepRate::Octaves(rate) => (&of::OCTAVE_RATE, rate),
    };
    let fastest = study.by_rate.iter().map(|one| size(one.sweep.rate).1).fold(0.0, f64::max);
    let kind = size(study.sweep.rate).0;
    let rate_unit = units.axis_unit(kind, fastest).size;
    let largest = study.by_rate.iter().flat_map(|one| one.peaks.map(|peak| peak[1]));
    let largest = units.length(largest.fold(0.0, f64::max));
    let length_unit = units.unit(Dimension::Length, largest).size;
    let line = |k: usize| -> Vec<[f64; 2]> {
        let point = |one: &crate::transient::ByRate| {
            [size(one.sweep.rate).1 / rate_unit, units.length(one.peaks[k][1]) / length_unit]
        };
        study.by_rate.iter().map(point).collect()
    };
    let y = Axis::linear(units.axis_label(&of::PEAK, largest))
        .with_range(0.0, 1.1 * largest / length_unit);
    Panel::new(Axis::log(units.axis_label(kind, fastest)), y)
        .with(Layer::curve(Role::BareOscillator, line(1)).labelled("without absorber"))
        .with(Layer::curve(DAMPER, line(2)).labelled("tuned mass damper"))
        .with(Layer::curve(Role::Simulation, line(0)).labelled("with absorber, worst start"))
}
