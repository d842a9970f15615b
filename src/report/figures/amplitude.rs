//! Peak displacement of the oscillator over frequency: what a designer wants to know.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI};

use crate::analysis::Manifold;
use crate::analysis::frequency_response::ResponsePoint;
use crate::analysis::manifold::ManifoldPoint;
use crate::orbits::{SymmetricOrbit, symmetric_orbits};
use crate::regimes::Regime;
use crate::report::figure::{Axis, Figure, Layer, MarkedPoint, Marker, Panel, Role, Shape};
use crate::report::numbers::{decibels, significant};
use crate::simulation::Stop;
use crate::study::StudyError;
use crate::study::scenes::{SweepPoint, sweep};
use crate::system::System;

use super::Scene;
use super::branches::{branches_of, joined};
use super::map::window;

/// Simulated frequencies.
const SWEEP: u32 = 17;
/// Frequencies of the exact orbits.
const EXACT: u32 = 60;
/// Samples of the bare oscillator's resonance.
const BARE: u32 = 600;
/// The resonance of the bare oscillator is cut at this many times the absorber's highest peak.
const CUT: f64 = 2.2;

pub(super) fn figure(scene: &Scene) -> Result<Option<Figure>, StudyError> {
    let analysis = &scene.study.analysis;
    let (system, manifold, units) = (&analysis.system, &analysis.manifold, &scene.units);
    if system.forcing_per_clearance() == 0.0 {
        // Everything comes to rest.
        return Ok(None);
    }
    let (first, last) = window(system);
    let even = |k: f64, count: u32| first + (last - first) * k / f64::from(count);
    let bare: Vec<[f64; 2]> = (0..=BARE)
        .map(|k| even(f64::from(k), BARE))
        .chain([system.frequency_ratio(), 1.0])
        .map(|ratio| [ratio, bare_amplitude(system, ratio)])
        .collect();
    let bare = sorted(bare);
    let ratios: Vec<f64> = (0..SWEEP).map(|k| even(f64::from(k) + 0.5, SWEEP)).collect();
    let simulated = sweep(system, &ratios)?;
    let here = observed(scene);
    let top = top(scene, &bare, &simulated, here);
    let largest = 2.0 + top;
    let place = |point: &ResponsePoint| {
        let ratio = 1.0 + system.mass_ratio() * point.detuning;
        let peak = peak(system.mass_ratio(), manifold, point);
        [units.frequency(ratio), units.length(peak)]
    };
    let pieces = branches_of(system, manifold, largest, &place)?;
    let shown = |[ratio, peak]: [f64; 2]| [units.frequency(ratio), units.length(peak)];
    let x = Axis::linear(units.frequency_axis())
        .with_range(units.frequency(first), units.frequency(last));
    let y = Axis::linear(units.length_axis("peak displacement of the oscillator x"))
        .with_range(0.0, units.length(top));
    let bare_line = bare.iter().copied().map(shown).collect();
    let mut panel = Panel::new(x, y)
        .with(Layer::curve(Role::BareOscillator, bare_line).labelled("without absorber"))
        .with(Layer::curve(Role::Unstable, joined(&pieces, false)).labelled("unstable 1:1"))
        .with(Layer::curve(Role::Stable, joined(&pieces, true)).labelled("stable 1:1 (theory)"));
    let ratios: Vec<f64> = (0..=EXACT).map(|k| even(f64::from(k), EXACT)).collect();
    panel.layers.extend(exact(scene, &ratios));
    panel.layers.extend(markers(scene, &simulated));
    if let Some(peak) = here {
        let at = shown([system.frequency_ratio(), peak]);
        let words =
            format!("this case: {}, peak {}", units.place_text(system), units.length_text(peak));
        panel = panel.with(Layer::this_case(at, Some(words)));
    }
    let (caption, alt) = words(scene, here);
    let title = "Peak displacement with and without absorber";
    Ok(Some(Figure::new("amplitude", title).with_panel(panel).with_words(caption, alt)))
}

/// How simulated regimes are marked.
pub(super) const KINDS: [(&str, Marker, &[Regime]); 5] = [
    ("symmetric 1:1", Marker::filled(Shape::Circle), &[Regime::TwoSymmetric]),
    ("asymmetric", Marker::hollow(Shape::Triangle), &[Regime::TwoAsymmetric]),
    ("more impacts", Marker::hollow(Shape::Square), &[Regime::AboveTwo]),
    (
        "modulated or fewer",
        Marker::filled(Shape::Cross).sized(8.0),
        &[Regime::StronglyModulated, Regime::BelowTwo],
    ),
    ("at rest", Marker::hollow(Shape::Circle), &[Regime::AtRest]),
];

/// Peak over the clearance of the case's main attractor.
fn observed(scene: &Scene) -> Option<f64> {
    let attractor = &scene.study.main_attractor()?.attractor;
    let known = attractor.stop == Stop::EndTime && attractor.periods > 0;
    (known && attractor.peak.is_finite()).then_some(attractor.peak)
}

fn bare_amplitude(system: &System, ratio: f64) -> f64 {
    let there = system.with_frequency_ratio(ratio).ok();
    let response = there.and_then(|there| there.linear_response());
    response.map_or(f64::NAN, |response| response.amplitude())
}

fn sorted(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    points
}

/// The upper end of the axis over the clearance: all that was simulated, and the bare oscillator's
/// resonance as far as it leaves the rest legible.
fn top(scene: &Scene, bare: &[[f64; 2]], simulated: &[SweepPoint], here: Option<f64>) -> f64 {
    let system = &scene.study.analysis.system;
    let largest = |values: &mut dyn Iterator<Item = f64>| {
        values.filter(|value| value.is_finite()).fold(0.0, f64::max)
    };
    let moving = largest(&mut simulated.iter().map(|point| point.peak).chain(here));
    let resonance = largest(&mut bare.iter().map(|point| point[1]));
    let alone = bare_amplitude(system, system.frequency_ratio());
    let alone = if alone.is_finite() { alone } else { 0.0 };
    let cut = if moving > 0.0 { resonance.min(CUT * moving) } else { resonance };
    let top = 1.08 * moving.max(cut).max(alone.min(2.0 * CUT * moving.max(1e-3)));
    if top > 0.0 { top } else { 1.0 }
}

/// Largest displacement over the clearance of the motion that a point of the response stands for:
/// `(1 + eps) x = (1 + eps) C sin z + eps (2/pi) B Pi(z + Theta)`, which is stationary where
/// `cos z = -/+ eps (2/pi) B/((1 + eps) C)`, or has a corner.
fn peak(mass_ratio: f64, manifold: &Manifold, point: &ResponsePoint) -> f64 {
    let ManifoldPoint { absorber_amplitude: absorber, oscillator_amplitude: oscillator } =
        ManifoldPoint {
            absorber_amplitude: point.absorber_amplitude,
            oscillator_amplitude: point.oscillator_amplitude,
        };
    let theta = manifold.absorber_phase(absorber, absorber - 1.0);
    let share = mass_ratio / (1.0 + mass_ratio) * FRAC_2_PI * absorber;
    let displacement =
        |z: f64| oscillator * libm::sin(z) + share * libm::asin(libm::sin(z + theta));
    let turning = libm::acos((share / oscillator).clamp(-1.0, 1.0));
    let corner = FRAC_PI_2 - theta;
    [turning, -turning, PI - turning, PI + turning, corner, corner + PI]
        .into_iter()
        .map(|z| displacement(z).abs())
        .fold(0.0, f64::max)
}

/// Exact symmetric orbits that are motions: filled where they attract, hollow where they do not.
fn exact(scene: &Scene, ratios: &[f64]) -> Vec<Layer> {
    let system = &scene.study.analysis.system;
    let units = &scene.units;
    let orbits: Vec<(f64, SymmetricOrbit)> = ratios
        .iter()
        .filter_map(|ratio| Some((*ratio, system.with_frequency_ratio(*ratio).ok()?)))
        .flat_map(|(ratio, there)| {
            let orbits = symmetric_orbits(&there).unwrap_or_default();
            orbits.into_iter().map(move |orbit| (ratio, orbit))
        })
        .filter(|(_, orbit)| orbit.orbit.admissibility.admissible)
        .collect();
    let layer = |attracts: bool, name: &str| {
        let chosen = orbits.iter().filter(|(_, orbit)| orbit.orbit.attracts() == attracts);
        let marks: Vec<MarkedPoint> = chosen
            .map(|(ratio, orbit)| {
                let peak = orbit.peaks.displacement;
                let words = format!(
                    "{name} at {}: peak {}, largest multiplier {} per period",
                    units.frequency_text(*ratio),
                    units.length_text(peak),
                    significant(orbit.orbit.radius_per_period(), 3)
                );
                MarkedPoint::new(units.frequency(*ratio), units.length(peak)).with_tooltip(words)
            })
            .collect();
        let marker =
            if attracts { Marker::filled(Shape::Circle) } else { Marker::hollow(Shape::Circle) };
        let layer = Layer::marked(marker.sized(4.0), Role::ExactOrbit.color(), marks.clone());
        (!marks.is_empty()).then(|| layer.labelled(name))
    };
    let both = [layer(true, "exact stable orbit"), layer(false, "exact unstable orbit")];
    both.into_iter().flatten().collect()
}

/// Simulated peaks, by regime.
fn markers(scene: &Scene, simulated: &[SweepPoint]) -> Vec<Layer> {
    let units = &scene.units;
    let layer = |(name, marker, regimes): (&str, Marker, &[Regime])| {
        let chosen = simulated.iter().filter(|point| regimes.contains(&point.regime));
        let marks: Vec<MarkedPoint> = chosen
            .map(|point| {
                let words = format!(
                    "simulated at {}: peak {}, {}",
                    units.frequency_text(point.frequency_ratio),
                    units.length_text(point.peak),
                    point.regime.words()
                );
                let at = units.frequency(point.frequency_ratio);
                MarkedPoint::new(at, units.length(point.peak)).with_tooltip(words)
            })
            .collect();
        let color = Role::Simulation.color();
        (!marks.is_empty()).then(|| Layer::marked(marker, color, marks).labelled(name))
    };
    KINDS.into_iter().filter_map(layer).collect()
}

fn words(scene: &Scene, here: Option<f64>) -> (String, String) {
    let system = &scene.study.analysis.system;
    let units = &scene.units;
    let place = units.place_text(system);
    let alone = bare_amplitude(system, system.frequency_ratio());
    let caption = match here {
        Some(peak) if alone.is_finite() && alone > 0.0 => {
            let verdict = match peak / alone {
                ratio if ratio < 0.97 => "the absorber reduces",
                ratio if ratio > 1.03 => "the absorber increases",
                _ => "the absorber hardly changes",
            };
            format!(
                "At {place} {verdict} the peak displacement: {} instead of {} ({}).",
                units.length_text(peak),
                units.length_text(alone),
                decibels(peak / alone)
            )
        }
        Some(peak) => format!(
            "At {place} the oscillator peaks at {}; without absorber it has no steady motion.",
            units.length_text(peak)
        ),
        None => format!(
            "At {place} the absorber hits its walls too often to be followed; without it the peak would be {}.",
            units.length_text(alone)
        ),
    };
    let alt = format!(
        "Peak displacement over frequency: a resonance peak without absorber, and with it a curve that is flat where 1:1 resonance is \
         stable, with exact orbits along it and simulated points. {caption}"
    );
    (caption, alt)
}
