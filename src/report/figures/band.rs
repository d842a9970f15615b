//! The response over the case's band: exact orbits, simulation where none attracts, and what else could
//! be done.

use crate::band::rivals::{TunedMassDamper, bare_amplitude};
use crate::band::simulated::{Effort, motions};
use crate::band::{Band, Stretch, exact, theory};
use crate::case::BandOver;
use crate::orbits::symmetric_orbits;
use crate::report::figure::{
    Axis, Color, Dash, Figure, Layer, MarkedPoint, Marker, Panel, Role, Shape, Style,
};
use crate::report::numbers::{percent, significant};
use crate::study::StudyError;
use crate::system::System;

use super::Scene;

/// Places along the band at which curves are evaluated.
const PLACES: u32 = 301;
/// Places that are simulated.
const SIMULATED: u32 = 41;
/// What the axis leaves of the bare oscillator's resonance, over the largest motion with absorber.
const CUT: f64 = 1.6;

pub(super) fn figure(scene: &Scene) -> Result<Option<Figure>, StudyError> {
    let Some(band) = scene.band.as_ref() else { return Ok(None) };
    let units = &scene.units;
    let x = |at: f64| match band.over {
        BandOver::Frequency => units.frequency(at),
        BandOver::Amplitude => units.forcing(at),
    };
    let damper = TunedMassDamper::best(band.base.mass_ratio());
    let damped = |system: &System| damper.amplitude(system);
    let stability = exact::stability(band);
    let marks = simulated(scene, band, &stability, &x)?;
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
    let (caption, alt) = words(scene, band, &stability);
    Ok(Some(
        Figure::new("band", "Response over the band").with_panel(panel).with_words(caption, alt),
    ))
}

/// An amplitude along the band, over the clearance.
fn curve(band: &Band, amplitude: &dyn Fn(&System) -> Option<f64>) -> Vec<[f64; 2]> {
    let value = |at: f64| band.system(at).ok().and_then(|system| amplitude(&system));
    band.places(PLACES).map(|at| [at, value(at).unwrap_or(f64::NAN)]).collect()
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

/// Simulated peaks over the clearance, and their marks.
fn simulated(
    scene: &Scene,
    band: &Band,
    stability: &[Stretch<bool>],
    x: &dyn Fn(f64) -> f64,
) -> Result<Vec<(f64, MarkedPoint)>, StudyError> {
    if !scene.study.simulated {
        return Ok(Vec::new());
    }
    let units = &scene.units;
    let inside = |at: f64| stability.iter().any(|s| s.of && s.from <= at && at <= s.to);
    let places: Vec<f64> = band.places(SIMULATED).collect();
    let systems: Vec<System> = places.iter().filter_map(|at| band.system(*at).ok()).collect();
    let found = motions(&systems, &Effort::default())?;
    let mut marks = Vec::new();
    for (at, motions) in places.iter().zip(&found) {
        for motion in motions {
            // What the exact orbit already says is not said again.
            let known = inside(*at) && (motion.impacts_per_period - 2.0).abs() < 0.01;
            if known && motions.len() == 1 {
                continue;
            }
            let words = format!(
                "simulated at {}: peak {}, z = {}",
                significant(x(*at), 4),
                units.length_text(motion.peak),
                significant(motion.impacts_per_period, 3)
            );
            let mark = MarkedPoint::new(x(*at), units.length(motion.peak)).with_tooltip(words);
            marks.push((motion.peak, mark));
        }
    }
    Ok(marks)
}

fn words(scene: &Scene, band: &Band, stability: &[Stretch<bool>]) -> (String, String) {
    let units = &scene.units;
    let zones = theory::zones(band);
    let z3 = band.share(&zones, |zone| zone.is_z3());
    let stable = band.share(stability, |stable| *stable);
    let text = |at: f64| match band.over {
        BandOver::Frequency => units.frequency_text(at),
        BandOver::Amplitude => units.forcing_text(at),
    };
    let parts: Vec<String> = zones
        .iter()
        .map(|zone| format!("{} to {} {}", text(zone.from), text(zone.to), zone.of.words()))
        .collect();
    let caption = format!(
        "{} of the band lies in area Z3 by theory, {} has a stable 1:1 orbit. By theory: {}. Simulation is \
         marked where it finds something else than that orbit.",
        percent(z3),
        percent(stable),
        parts.join(", ")
    );
    let alt = format!(
        "Peak displacement along the band with absorber, without it, and with the best tuned mass damper \
         of the same mass. {caption}"
    );
    (caption, alt)
}
