//! The response over the case's band: exact orbits, simulation where none attracts, and what else could
//! be done.

use crate::band::rivals::bare_amplitude;
use crate::band::{Band, Survey};
use crate::case::BandOver;
use crate::orbits::symmetric_orbits;
use crate::report::figure::{
    Axis, Color, Dash, Figure, Layer, MarkedPoint, Marker, Panel, Role, Rule, Shape, Style,
};
use crate::report::numbers::{percent, significant};
use crate::system::System;

use super::Scene;

/// Places along the band at which curves are evaluated.
const PLACES: u32 = 301;
/// What the axis leaves of the bare oscillator's resonance, over the largest motion with absorber.
const CUT: f64 = 1.6;

pub(super) fn figure(scene: &Scene) -> Option<Figure> {
    let survey = scene.study.band.as_ref()?;
    let band = survey.band();
    let units = &scene.units;
    let x = |at: f64| match band.over {
        BandOver::Frequency => units.frequency(at),
        BandOver::Amplitude => units.forcing(at),
    };
    let damper = survey.rivals.damper;
    let damped = |system: &System| damper.amplitudes(system)[0];
    let marks = simulated(scene, survey, &x);
    let [stable, unstable] = orbits(band);
    let drawn = stable.iter().chain(&unstable).map(|point| point[1]);
    let highest = drawn
        .chain(marks.iter().map(|mark| mark.0))
        .filter(|value| value.is_finite())
        .fold(0.0, f64::max);
    let [bare, with_damper] = [curve(band, &bare_amplitude), curve(band, &damped)];
    let rival = bare.iter().chain(&with_damper).map(|point| point[1]).fold(0.0, f64::max);
    let top = 1.05 * if highest > 0.0 { rival.min(CUT * highest).max(highest) } else { rival };
    let shown = |points: Vec<[f64; 2]>| -> Vec<[f64; 2]> {
        points.into_iter().map(|[at, value]| [x(at), units.length(value)]).collect()
    };
    let name = match band.over {
        BandOver::Frequency => units.frequency_axis().to_owned(),
        BandOver::Amplitude => units.forcing_axis(),
    };
    let own = Style::new(Color::Orange, 1.6, Dash::LongDashed);
    let marker = Marker::filled(Shape::Cross).sized(7.0);
    let panel = Panel::new(
        Axis::linear(name).with_range(x(band.range[0]), x(band.range[1])),
        Axis::linear(units.length_axis("peak displacement")).with_range(0.0, units.length(top)),
    )
    .with(Layer::curve(Role::BareOscillator, shown(bare)).labelled("without absorber"))
    .with(Layer::styled(own, shown(with_damper)).labelled("tuned mass damper"))
    .with(Layer::curve(Role::Unstable, shown(unstable)).labelled("unstable 1:1"))
    .with(Layer::curve(Role::Stable, shown(stable)).labelled("stable 1:1 (exact)"))
    .with(
        Layer::marked(marker, Role::Simulation.color(), marks.into_iter().map(|mark| mark.1))
            .labelled("simulated"),
    );
    let panel = match scene.limit.filter(|limit| *limit < top) {
        Some(limit) => {
            let style = Style::new(Color::Vermillion, 1.4, Dash::Dotted);
            panel.with(Layer::rule(Rule::Horizontal(units.length(limit)), style).labelled("limit"))
        }
        None => panel,
    };
    let (caption, alt) = words(scene, survey);
    Some(Figure::new("band", "Response over the band").with_panel(panel).with_words(caption, alt))
}

/// An amplitude along the band, over the clearance.
fn curve(band: &Band, amplitude: &dyn Fn(&System) -> f64) -> Vec<[f64; 2]> {
    let value = |at: f64| band.system(at).map_or(f64::NAN, |system| amplitude(&system));
    band.places(PLACES).map(|at| [at, value(at)]).collect()
}

/// Peaks of the admissible symmetric orbits, the stable and the unstable ones, as lines with gaps.
fn orbits(band: &Band) -> [Vec<[f64; 2]>; 2] {
    let mut lines = [Vec::new(), Vec::new()];
    // Both orbits of a place in turn, from the larger absorber amplitude down, so that a line follows
    // one of them where the other begins or ends.
    for which in 0..2 {
        for at in band.places(PLACES) {
            let found = band.system(at).ok().and_then(|system| symmetric_orbits(&system).ok());
            let found = found.unwrap_or_default();
            let orbit = found.iter().rev().nth(which);
            let orbit = orbit.filter(|one| one.orbit.admissibility.admissible);
            let peak = orbit.map(|one| (one.orbit.attracts(), one.peaks.displacement));
            for (line, stable) in lines.iter_mut().zip([true, false]) {
                match peak {
                    Some((attracts, peak)) if attracts == stable => line.push([at, peak]),
                    _ => line.push([f64::NAN; 2]),
                }
            }
        }
        lines.iter_mut().for_each(|line| line.push([f64::NAN; 2]));
    }
    lines
}

/// Simulated peaks over the clearance, and their marks, where they are not the exact orbit's.
fn simulated(scene: &Scene, survey: &Survey, x: &dyn Fn(f64) -> f64) -> Vec<(f64, MarkedPoint)> {
    let units = &scene.units;
    let mut marks = Vec::new();
    let over = survey.band().over;
    for place in &survey.motions.places {
        for motion in place.beside_orbit() {
            let words = format!(
                "simulated at {}: peak {}, z = {}",
                units.band_text(over, place.at),
                units.length_text(motion.peak),
                significant(motion.impacts_per_period, 3),
            );
            let mark = MarkedPoint::new(x(place.at), units.length(motion.peak));
            marks.push((motion.peak, mark.with_tooltip(words)));
        }
        if let Some(inactive) = place.inactive.filter(|_| survey.motions.count_inactive) {
            let words = format!(
                "absorber never wakes at {}, from {} of its resting places: {}",
                units.band_text(over, place.at),
                percent(inactive.share),
                units.length_text(inactive.amplitude),
            );
            let mark = MarkedPoint::new(x(place.at), units.length(inactive.amplitude));
            marks.push((inactive.amplitude, mark.with_tooltip(words)));
        }
    }
    marks
}

fn words(scene: &Scene, survey: &Survey) -> (String, String) {
    let text = |at: f64| scene.units.band_text(survey.band().over, at);
    let parts: Vec<String> = survey
        .zones
        .iter()
        .map(|zone| format!("{} to {} {}", text(zone.from), text(zone.to), zone.of.words()))
        .collect();
    let caption = format!(
        "{} of the band lies in area Z3 by theory, {} has a stable 1:1 orbit. By theory: {}. Simulation is \
         marked where it finds something else than that orbit; marks on the line of the bare oscillator \
         are absorbers that never wake from rest.",
        percent(survey.z3_share()),
        percent(survey.motions.stable_share()),
        parts.join(", ")
    );
    let alt = format!(
        "Peak displacement along the band with absorber, without it, and with the best tuned mass damper \
         of the same mass. {caption}"
    );
    (caption, alt)
}
