//! The amplitude on its way to rest.

use std::f64::consts::TAU;

use serde_json::Value;

use crate::case::Case;
use crate::flights::STEPS;
use crate::quantity::catalogue as of;
use crate::report::chart::AxisOf;
use crate::report::figure::{AxisScale, Figure, Layer, Panel, Role};
use crate::report::transient::{DAMPER, THEORY};
use crate::transient::DecayStudy;

/// Points of a line: as many as there are pixels.
const POINTS: usize = 700;

/// All figures.
pub fn figures(case: &Case, study: &DecayStudy, facts: &Value) -> Vec<Figure> {
    let figure = envelope(case, study).into_iter();
    figure.map(|one| one.with_facts("captions/release", facts.clone())).collect()
}

fn envelope(case: &Case, study: &DecayStudy) -> Option<Figure> {
    let units = case.units();
    let ((_, worst), found) = (study.worst()?, study.slowest_start.as_ref()?);
    let shown = [worst.oscillations, study.bare.min(3.0 * worst.oscillations)]
        .into_iter()
        .filter(|one| one.is_finite())
        .fold(0.0, f64::max);
    let shown =
        if shown > 0.0 { 1.05 * shown } else { found.amplitudes.len() as f64 / f64::from(STEPS) };
    let oscillations = AxisOf::dimensionless(units, &of::TIME).counting(TAU);
    let amplitude = AxisOf::dimensionless(units, &of::OSCILLATOR_AMPLITUDE);
    let lowest = 0.5 * study.level;
    let line = |mut points: Vec<[f64; 2]>| {
        points.retain(|one| one[0] <= shown && one[1] >= lowest);
        points
    };
    let sampled = |amplitudes: &[f64]| {
        let step = (shown * f64::from(STEPS)) as usize / POINTS + 1;
        let points = amplitudes.iter().enumerate().step_by(step);
        line(points.map(|(k, one)| [k as f64 / f64::from(STEPS), *one]).collect())
    };
    let decay = -libm::log(study.level / study.from) / study.bare;
    let alone = (0..=POINTS).map(|k| {
        let time = shown * k as f64 / POINTS as f64;
        [time, study.from * libm::exp(-decay * time)]
    });
    let y = amplitude.axis([lowest, 1.2 * study.from]).with_scale(AxisScale::Log);
    let mut panel = Panel::new(oscillations.axis([0.0, shown]), y)
        .with(Layer::horizontal(study.level, Role::Guide).labelled("at rest"))
        .with(
            Layer::curve(Role::BareOscillator, line(alone.collect())).labelled("without absorber"),
        )
        .with(
            Layer::curve(DAMPER, sampled(&study.damped().1.amplitudes))
                .labelled("tuned mass damper"),
        )
        .with(
            Layer::curve(Role::Simulation, sampled(&found.amplitudes))
                .labelled("absorber, slowest start flown"),
        )
        .with(Layer::curve(THEORY, line(study.predicted.path.clone())).labelled("theory"));
    if study.predicted.residual > study.level && study.system.cavity().is_ideal() {
        let end = Layer::horizontal(study.predicted.residual, Role::Hopf);
        panel = panel.with(end.labelled("capture ends"));
    }
    Some(Figure::new("decay", "").with_panel(panel))
}
