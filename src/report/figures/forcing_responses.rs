//! Frequency responses for four forcings per clearance across the areas (Fig. 7).

use crate::analysis::frequency_response::ResponsePoint;
use crate::analysis::{AnalysisError, FixedPointCurve, Manifold};
use crate::report::figure::{Axis, Color, Dash, Figure, Layer, Layout, Panel, Role, Style};
use crate::report::numbers::percent;
use crate::study::StudyError;
use crate::system::{Parameters, System};

use super::Scene;
use super::branches::{Piece, branches_of, joined};
use super::levels::Levels;
use super::manifold::branches;

/// The manifold is shown up to this many symmetry-breaking amplitudes of the oscillator.
const ABOVE_BREAKING: f64 = 2.2;
/// Half the window in detuning.
const HALF: f64 = 6.0;
/// Half the band around the natural frequency that the absorber should serve, in detuning: where the
/// bare oscillator of Table 1 is amplified more than tenfold.
const BAND: f64 = 6.0;
/// Detunings at which a boundary's smallest forcing is sought.
const SAMPLES: i32 = 2000;

/// One of the four.
struct CaseReport {
    gamma: f64,
    color: Color,
    dash: Dash,
    pieces: Vec<Piece>,
    /// Share of the band that lies in Z3.
    share: f64,
}

pub(super) fn figure(scene: &Scene) -> Result<Option<Figure>, StudyError> {
    let analysis = &scene.study.analysis;
    let (system, manifold) = (&analysis.system, &analysis.manifold);
    let gamma = system.forcing_per_clearance();
    if gamma == 0.0 || manifold.fold.oscillator_amplitude == 0.0 {
        return Ok(None);
    }
    let family = family(system)?;
    let top = ABOVE_BREAKING * manifold.symmetry_breaking.oscillator_amplitude;
    let last = top + 1.0;
    let units = &scene.units;
    let mut members = Vec::new();
    let looks = [
        (Color::Black, Dash::Dotted),
        (Color::Vermillion, Dash::Dashed),
        (Color::BluishGreen, Dash::Solid),
        (Color::Blue, Dash::LongDashed),
    ];
    for (at, (color, dash)) in family.into_iter().zip(looks) {
        let there = Parameters { forcing_per_clearance: at, ..system.parameters() };
        let Ok(there) = System::new(there) else { return Ok(None) };
        let place = |point: &ResponsePoint| {
            [units.frequency(1.0 + there.mass_ratio() * point.detuning), point.oscillator_amplitude]
        };
        let pieces = branches_of(&there, manifold, last, &place)?;
        members.push(CaseReport { gamma: at, color, dash, pieces, share: share(system, at)? });
    }
    let levels = Levels { grazing: None, ..Levels::of(system, manifold)? };
    let y = || Axis::linear("oscillator amplitude C/b (1)").with_range(0.0, top);
    let widest = 2.0 * top;
    let [left, right, stable] = branches(manifold, last.min(widest));
    let x = Axis::linear("absorber amplitude B/b (1)").with_range(0.0, widest);
    let mut first = Panel::new(x, y()).with_heading("manifold");
    first.layers.extend(levels.layers((0.0, widest), top, 0.9 * widest));
    first.layers.extend([left.labelled("unstable"), right, stable.labelled("stable")]);
    let half = HALF * system.mass_ratio();
    let (from, to) = (units.frequency((1.0 - half).max(0.05)), units.frequency(1.0 + half));
    let x = Axis::linear(units.frequency_axis()).with_range(from, to);
    let mut second = Panel::new(x, y()).with_heading("responses");
    second.layers.extend(levels.layers((from, to), top, from + 0.04 * (to - from)));
    for member in &members {
        let name = format!("b = {}", units.length_text(gamma / member.gamma));
        let [stable, unstable] = [true, false].map(|stable| joined(&member.pieces, stable));
        let thin = Style::new(member.color, 1.0, member.dash);
        second = second.with(Layer::styled(thin, unstable).labelled(name));
        second = second.with(Layer::styled(Role::Stable.style().colored(member.color), stable));
    }
    let (caption, alt) = words(scene, &members);
    Ok(Some(
        Figure::new("forcing-responses", "Frequency responses for four forcings per clearance")
            .with_size(860, 450)
            .with_layout(Layout::columns(&[2.0, 3.0]))
            .with_panel(first)
            .with_panel(second)
            .with_words(caption, alt),
    ))
}

/// The four forcings per clearance, from the largest: one that lifts the response far beyond
/// symmetry breaking, one with which its top just reaches it, one inside Z3, and one below the fold
/// at every frequency.
fn family(system: &System) -> Result<[f64; 4], AnalysisError> {
    let least = |boundary: fn(&FixedPointCurve) -> f64| -> Result<f64, AnalysisError> {
        Ok(curves(system)?.map(|curve| boundary(&curve)).fold(f64::INFINITY, f64::min))
    };
    let (hopf, breaking) =
        (least(FixedPointCurve::hopf)?, least(FixedPointCurve::symmetry_breaking)?);
    Ok([2.5 * breaking, breaking, (hopf * breaking).sqrt(), 0.85 * hopf])
}

/// The clearances of the four over the case's, each with the share of the band that lies in Z3.
///
/// # Errors
/// As the theory's boundaries.
pub(crate) fn shares(system: &System) -> Result<Vec<(f64, f64)>, AnalysisError> {
    let gammas = family(system)?.into_iter();
    let own = system.forcing_per_clearance();
    gammas.map(|gamma| Ok((own / gamma, share(system, gamma)?))).collect()
}

/// The quadratics of the band's detunings.
fn curves(system: &System) -> Result<impl Iterator<Item = FixedPointCurve>, AnalysisError> {
    let manifold = Manifold::of(system.restitution());
    let detunings = (-SAMPLES..=SAMPLES).map(|k| BAND * f64::from(k) / f64::from(SAMPLES));
    Ok(detunings.map(move |at| FixedPointCurve::at_detuning(system, &manifold, at)))
}

/// Share of the band `abs(sigma) < BAND` between Hopf and symmetry breaking at the forcing `gamma`:
/// area Z3 without its strips.
fn share(system: &System, gamma: f64) -> Result<f64, AnalysisError> {
    let inside =
        curves(system)?.filter(|curve| curve.hopf() <= gamma && gamma <= curve.symmetry_breaking());
    Ok(inside.count() as f64 / f64::from(2 * SAMPLES + 1))
}

fn words(scene: &Scene, members: &[CaseReport]) -> (String, String) {
    let units = &scene.units;
    let system = &scene.study.analysis.system;
    let gamma = system.forcing_per_clearance();
    let shares: Vec<String> = members
        .iter()
        .map(|at| format!("{} for b = {}", percent(at.share), units.length_text(gamma / at.gamma)))
        .collect();
    let band = BAND * system.mass_ratio();
    let caption = format!(
        "Of the band from {} to {}, the share in Z3 is {}.",
        units.frequency_text(1.0 - band),
        units.frequency_text(1.0 + band),
        shares.join(", ")
    );
    let alt = format!(
        "Left, the manifold; right, the oscillator's amplitude over frequency for four clearances. The smallest clearance lifts the \
         response beyond symmetry breaking, the largest leaves it below the fold. {caption}"
    );
    (caption, alt)
}
