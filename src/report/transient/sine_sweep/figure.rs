//! The envelope over frequency, and the largest displacement by rate.

use serde_json::Value;

use crate::case::Case;
use crate::excitation::SweepRate;
use crate::quantity::catalogue as of;
use crate::report::chart::{AxisOf, FITTED};
use crate::report::figure::{AxisScale, Color, Dash, Figure, Layer, Panel, Role, Style};
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
    vec![
        envelope(case, study).with_facts("captions/sine-sweep", facts.clone()),
        rates(case, study).with_facts("captions/sweep-rates", facts.clone()),
    ]
}

fn envelope(case: &Case, study: &SweepStudy) -> Figure {
    let shown = |kind| AxisOf::dimensionless(case.units(), kind);
    let ends = [study.sweep.from, study.sweep.to];
    let [from, to] = ends.map(|frequency| case.units().frequency_ratio(frequency));
    let peak = |passage: &crate::flights::Passage| passage.peak()[1];
    let there = study.worst().map(|(_, worst)| worst);
    let own = there.map_or(0.0, peak);
    let largest = own.max(peak(&study.back)).max(peak(&study.alone));
    let line = |envelope: &[[f64; 2]]| {
        // The largest of what shares a pixel.
        let together = envelope.len() / POINTS + 1;
        let larger = |a: &[f64; 2], b: &[f64; 2]| a[1].total_cmp(&b[1]);
        let groups = envelope.chunks(together);
        groups.filter_map(|some| some.iter().copied().max_by(|a, b| larger(a, b))).collect()
    };
    let top = 1.1 * largest;
    let steady = |k: usize| {
        let within = |length: f64| if length > top { f64::NAN } else { length };
        study.steady.iter().map(|one| [one[0], within(one[k])]).collect::<Vec<_>>()
    };
    let x = shown(&of::EXCITATION_FREQUENCY).axis([from.min(to), from.max(to)]);
    let y = shown(&of::PEAK).axis([0.0, top]);
    let [own_name, back_name] = if from > to { ["down", "up"] } else { ["up", "down"] };
    let mut panel = Panel::new(x, y)
        .with(Layer::curve(Role::BareOscillator, steady(1)).labelled("steady, without absorber"))
        .with(Layer::curve(DAMPER, line(&study.damped().1.envelope)).labelled("tuned mass damper"))
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
    let jumps = study.jumps.iter().flatten().map(|jump| [jump.at, jump.levels[1]]);
    let marks: Vec<[f64; 2]> = jumps.collect();
    if !marks.is_empty() {
        panel = panel.with(Layer::points(Role::Impact, marks).labelled("jump"));
    }
    Figure::new("envelope", "").with_panel(panel)
}

fn rates(case: &Case, study: &SweepStudy) -> Figure {
    let units = case.units();
    let size = |rate: SweepRate| match rate {
        SweepRate::Linear(rate) => (&of::SWEEP_RATE, rate),
        SweepRate::Octaves(rate) => (&of::OCTAVE_RATE, rate),
    };
    let fastest = study.by_rate.iter().map(|one| size(one.sweep.rate).1).fold(0.0, f64::max);
    let kind = size(study.sweep.rate).0;
    let x = AxisOf::si(units, kind).axis_up_to(fastest, FITTED).with_scale(AxisScale::Log);
    let largest = study.by_rate.iter().flat_map(|one| one.peaks.map(|peak| peak[1]));
    let largest = largest.fold(0.0, f64::max);
    let y = AxisOf::dimensionless(units, &of::PEAK).axis([0.0, 1.1 * largest]);
    let line = |k: usize| -> Vec<[f64; 2]> {
        let rates = study.by_rate.iter();
        rates.map(|one| [size(one.sweep.rate).1, one.peaks[k][1]]).collect()
    };
    let panel = Panel::new(x, y)
        .with(Layer::curve(Role::BareOscillator, line(1)).labelled("without absorber"))
        .with(Layer::curve(DAMPER, line(2)).labelled("tuned mass damper"))
        .with(Layer::curve(Role::Simulation, line(0)).labelled("with absorber, worst start flown"));
    Figure::new("rates", "").with_panel(panel)
}
