//! The displacement over time, and the peak over the structure's natural frequency.

use serde_json::Value;

use crate::case::Case;
use crate::quantity::catalogue as of;
use crate::report::chart::AxisOf;
use crate::report::figure::{AxisScale, Color, Dash, Figure, Layer, Panel, Role, Style};
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
    let shown = |kind| AxisOf::dimensionless(case.units(), kind);
    let first = study.first()?;
    let (_, worst) = first.worst()?;
    let end = first.bare.trace.last()?[0].max(worst.trace.last()?[0]);
    let largest = [first.bare.peak, first.damped.peak, worst.peak].into_iter().fold(0.0, f64::max);
    let line = |trace: &[[f64; 2]]| -> Vec<[f64; 2]> {
        let ends = trace.chunks(trace.len() / STRETCHES + 1).flat_map(|stretch| {
            let by_size = |a: &&[f64; 2], b: &&[f64; 2]| a[1].total_cmp(&b[1]);
            let mut ends = [stretch.iter().min_by(by_size), stretch.iter().max_by(by_size)];
            ends.sort_by(|a, b| a.map_or(0.0, |a| a[0]).total_cmp(&b.map_or(0.0, |b| b[0])));
            ends
        });
        ends.flatten().copied().collect()
    };
    let y = shown(&of::DISPLACEMENT).axis([-1.08 * largest, 1.08 * largest]);
    let panel = Panel::new(shown(&of::TIME).axis([0.0, end]), y)
        .with(
            Layer::curve(Role::BareOscillator, line(&first.bare.trace))
                .labelled("without absorber"),
        )
        .with(
            Layer::curve(Role::Simulation, line(&worst.trace))
                .labelled("absorber, worst place flown"),
        );
    Some(Figure::new("history", "").with_panel(panel))
}

fn spectrum(case: &Case, study: &RecordStudy) -> Figure {
    let shown = |kind| AxisOf::dimensionless(case.units(), kind);
    let peaks = study.spectrum.iter().flat_map(|one| [one.bare, one.absorber, one.damped]);
    let (least, most) = peaks
        .fold((f64::INFINITY, 0.0_f64), |(least, most), peak| (least.min(peak), most.max(peak)));
    let line = |peak: fn(&SpectrumPoint) -> f64| -> Vec<[f64; 2]> {
        study.spectrum.iter().map(|one| [one.ratio, peak(one)]).collect()
    };
    let ends = [study.spectrum.first(), study.spectrum.last()];
    let ends = ends.map(|one| one.map_or(1.0, |one| one.ratio));
    // The prefix is that of the structure itself.
    let x = shown(&of::STRUCTURE_FREQUENCY).axis_up_to(1.0, ends).with_scale(AxisScale::Log);
    let y = shown(&of::PEAK).axis([0.8 * least, 1.25 * most]).with_scale(AxisScale::Log);
    let panel = Panel::new(x, y)
        .with(Layer::vertical(1.0, Role::Guide).labelled("this structure"))
        .with(Layer::curve(Role::BareOscillator, line(|one| one.bare)).labelled("without absorber"))
        .with(Layer::curve(DAMPER, line(|one| one.damped)).labelled("tuned mass damper"))
        .with(
            Layer::curve(ABSORBER, line(|one| one.absorber))
                .labelled("absorber, worst place flown"),
        );
    Figure::new("response-spectrum", "").with_panel(panel)
}
