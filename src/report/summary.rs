//! Readable summaries for a terminal.

use std::fmt::Write as _;

use super::motion_tables;
use super::notes::theory_limits;
use super::numbers::{LengthFormat, capitalised, fixed, percent, significant};
use crate::analysis::{Analysis, Strip};
use crate::case::Case;
use crate::orbits::{Bifurcation, FullSystem};
use crate::regimes::Attractor;
use crate::study::{LongTermMotions, Proof, SettledArea, SettledBy};
use crate::validation::asymptotic_error::asymptotic_errors;

/// What the theory and the exact orbits say of a case.
pub fn analysis(case: &Case, analysis: &Analysis, exact: &FullSystem, area: SettledArea) -> String {
    let scales = case.scales();
    let lengths = LengthFormat::of(&scales);
    let length = |over_clearance: f64| lengths.text(scales.length(over_clearance));
    let mut text = format!("{}\n\n", case.title);
    let strip = match analysis.zone.strip {
        Some(Strip::A1) => ", strip A1: steady 1:1 resonance beside a modulated response",
        Some(Strip::A2) => ", strip A2: strongly modulated response",
        None => "",
    };
    let how = match area.by {
        SettledBy::ClosedForm => "",
        SettledBy::ExactOrbit => " (Z1 or Z2 told apart by the grazing of the exact orbit)",
        SettledBy::Simulation => " (Z1 or Z2 told apart by a short simulation)",
    };
    let _ = writeln!(text, "Area {:?}{strip}{how}", area.area);
    for limit in theory_limits(&analysis.system) {
        let _ = writeln!(text, "{limit}");
    }
    let manifold = &analysis.manifold;
    let _ = writeln!(
        text,
        "Slow invariant manifold: fold at B = {}, C = {}; symmetry breaking at B = {}, C = {}",
        length(manifold.fold.absorber_amplitude),
        length(manifold.fold.oscillator_amplitude),
        length(manifold.symmetry_breaking.absorber_amplitude),
        length(manifold.symmetry_breaking.oscillator_amplitude),
    );
    text.push_str(
        "\nFixed points of the slow flow (1:1 resonance, leading order in the mass ratio)\n",
    );
    if analysis.fixed_points.is_empty() {
        text.push_str("  none\n");
    }
    for point in &analysis.fixed_points {
        let _ = writeln!(
            text,
            "  C = {}, B = {}, eta = {} rad: {} on the {} branch, {}{}",
            length(point.oscillator_amplitude),
            length(point.absorber_amplitude),
            fixed(point.eta, 3),
            point.kind.words(),
            point.branch.words(),
            if point.stable { "a stable motion" } else { "not a stable motion" },
            if point.admissible {
                ""
            } else {
                ", and not a motion: the absorber would leave its cavity"
            },
        );
    }
    if let Some(above) = analysis.fixed_points.iter().find_map(|point| point.above_collision) {
        let _ = writeln!(text, "  the forcing is {} above their collision", percent(above));
    }
    text.push_str("\nExact symmetric 1:1 orbits of the full system at this clearance\n");
    if exact.orbits.is_empty() {
        text.push_str("  none\n");
    }
    for orbit in &exact.orbits {
        let found = &orbit.orbit;
        let _ = writeln!(
            text,
            "  x = {} at impact, peak {}: {}, largest multiplier {}",
            length(orbit.impact_displacement),
            length(orbit.peaks.displacement),
            match (found.admissibility.admissible, found.attracts()) {
                (false, _) if found.admissibility.sticks() => {
                    "not a motion, the absorber would stay on the wall"
                }
                (false, _) => "not a motion, the absorber would leave its cavity",
                (true, true) => "stable",
                (true, false) => "unstable",
            },
            significant(found.multipliers.spectral_radius(), 4),
        );
    }
    text.push_str("\nBoundaries at this frequency and forcing, as clearances: theory, exact\n");
    for price in asymptotic_errors(analysis, exact) {
        let shown = |at: Option<f64>| at.map_or_else(|| "none".into(), length);
        let _ = writeln!(
            text,
            "  {}: {}, {}",
            price.kind.words(),
            shown(price.theory),
            shown(price.exact)
        );
    }
    if exact.boundaries.is_some() {
        let _ = writeln!(text, "  {}", stable_clearances(exact, &length));
    }
    let p1 = analysis.boundaries.codimension_two;
    let frequency = scales.frequency_hz(1.0 + analysis.system.mass_ratio() * p1.detuning);
    let _ = writeln!(
        text,
        "  P1, where saddle-node and Hopf meet: sigma = {}, gamma = {}{}",
        significant(p1.detuning, 4),
        significant(p1.forcing_over_clearance, 4),
        frequency.map(|f| format!(", f = {} Hz", significant(f, 4))).unwrap_or_default(),
    );
    text
}

/// The clearances at which an exact symmetric orbit is stable, with what ends them: also those of
/// which the case's own is none.
fn stable_clearances(exact: &FullSystem, length: &dyn Fn(f64) -> String) -> String {
    let end = |at: f64, kind: Option<Bifurcation>| match kind {
        Some(kind) => format!("{} ({})", length(at), kind.words()),
        None => format!("{} (not looked further)", length(at)),
    };
    let stretches = exact.stable_stretches();
    let listed: Vec<String> = stretches
        .iter()
        .map(|stretch| {
            let ([from, to], [first, last]) = (stretch.clearance, stretch.ends);
            format!("from {} to {}", end(from, first), end(to, last))
        })
        .collect();
    if listed.is_empty() {
        return "a symmetric orbit is stable at no clearance".into();
    }
    let here = if exact.stretch().is_some() { "" } else { ", so none at this one" };
    format!("a symmetric orbit is stable at clearances {}{here}", listed.join(" and "))
}

/// What simulation found.
pub fn simulation(case: &Case, motion: &Attractor, found: Option<&LongTermMotions>) -> String {
    let scales = case.scales();
    let lengths = LengthFormat::of(&scales);
    let mut text = format!("{}\n\n", case.title);
    let evidence = &motion.classification.evidence;
    let _ = writeln!(text, "{}", capitalised(motion.classification.regime.words()));
    let _ = writeln!(
        text,
        "  {} impacts per period over {} periods; peak displacement {}, rms {}{}",
        motion_tables::impacts_per_period(motion),
        motion.periods,
        motion_tables::peak(motion, &scales),
        lengths.text(scales.length(motion.rms)),
        motion_tables::rms_known_to(motion),
    );
    let proof = Proof::of(&case.system(), motion);
    let beside = found.is_some_and(|found| motion_tables::repeats(&found.attractors));
    let (dynamics, reason) = motion_tables::dynamics(motion, proof.as_ref(), beside);
    let _ = writeln!(text, "  {dynamics}; {reason}");
    let _ = writeln!(
        text,
        "  modulation depth {}, captured in 1:1 resonance {} of the time",
        percent(evidence.modulation_depth),
        percent(evidence.captures.share)
    );
    let _ = writeln!(
        text,
        "  energy balance closed to {}, run ended by {}",
        significant(motion.energy.relative_residual, 1),
        motion.stop.words()
    );
    for doubt in motion.doubts() {
        let _ = writeln!(text, "  NOT TO BE TRUSTED: {}; {}", doubt.words(), doubt.advice());
    }
    if let Some(found) = found {
        text.push_str("\nLong-term motions found, by share of starts\n");
        for (one, proof) in found.attractors.iter().zip(&found.proofs) {
            let (dynamics, reason) =
                motion_tables::dynamics(&one.attractor, proof.as_ref(), beside);
            let _ = writeln!(
                text,
                "  {:>5}  {}, peak {}\n         {dynamics}; {reason}",
                percent(one.share),
                one.regime().words(),
                motion_tables::peak(&one.attractor, &scales),
            );
        }
    }
    text
}
