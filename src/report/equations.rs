//! The equations of a case, general and with its numbers put in.

use serde::Serialize;

use super::numbers::LengthFormat;
use crate::analysis::FixedPointCurve;
use crate::case::Case;
use crate::equations::{Motion, ReportEquation, equations};
use crate::orbits::flight::Flight;
use crate::orbits::symmetric_orbits;
use crate::study::CaseStudy;
use crate::symbolic::{Symbol, Values};
use crate::system::System;

/// Digits of the numbers that are put into formulas.
const DIGITS: usize = 4;

/// Equations under one title.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EquationGroup {
    /// The title.
    pub title: &'static str,
    /// What they are for.
    pub gives: &'static str,
    /// Where they come from, with the paper's number if they have one.
    pub source: String,
    /// Each in general and with numbers, in LaTeX.
    pub formulas: Vec<Formula>,
}

/// A formula in LaTeX, twice.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Formula {
    /// With symbols.
    pub general: String,
    /// With this case's numbers.
    pub numbers: String,
}

/// All equations with the case's numbers.
pub fn groups(case: &Case, study: &CaseStudy) -> Vec<EquationGroup> {
    let (at_fixed_point, on_orbit) = (values(case, study), orbit_values(case, study));
    let mut groups: Vec<EquationGroup> = Vec::new();
    let excitation = study.analysis.system.excitation();
    let of_this_case =
        |equation: &ReportEquation| equation.only.is_none_or(|only| only == excitation);
    for equation in equations().for_report().into_iter().filter(of_this_case) {
        let values = match equation.motion {
            Motion::FixedPoint => &at_fixed_point,
            Motion::SymmetricOrbit => &on_orbit,
        };
        let formula = Formula {
            general: equation.to_latex(),
            numbers: equation.to_latex_with(values, DIGITS),
        };
        match groups.last_mut() {
            Some(last) if last.title == equation.title => last.formulas.push(formula),
            _ => groups.push(EquationGroup {
                title: equation.title,
                gives: equation.gives,
                source: cited(&equation),
                formulas: vec![formula],
            }),
        }
    }
    groups
}

fn cited(equation: &ReportEquation) -> String {
    match equation.number {
        Some(number) if !equation.source.contains(number) => {
            format!("paper {number}; {}", equation.source)
        }
        _ => equation.source.to_owned(),
    }
}

/// The case's numbers that belong to no motion: dimensionless ones, and lengths in the report's unit.
fn case_values(case: &Case, system: &System) -> Values {
    let scales = case.scales();
    let lengths = LengthFormat::of(&scales);
    equations()
        .programs
        .values(system)
        .with(Symbol::Clearance, lengths.number(scales.length(1.0)))
        .with(Symbol::ReducedForcing, lengths.number(scales.forcing))
        .with(Symbol::BaseAmplitude, lengths.number(scales.forcing) * system.mass_ratio())
}

/// The case's numbers with those of the exact symmetric orbit: of the larger attracting one, else of
/// the last one. Symbols of an orbit have no numbers where there is none, and those of the steady
/// motion none where there is no such motion.
fn orbit_values(case: &Case, study: &CaseStudy) -> Values {
    let programs = &equations().programs.orbits;
    let system = &study.analysis.system;
    let values = case_values(case, system);
    let (Ok(flight), Ok(orbits)) = (Flight::of(system), symmetric_orbits(system)) else {
        return values;
    };
    let free = flight.free(0.5 * system.period());
    let propagator = values
        .with(Symbol::ImpulseResponse, free.impulse)
        .with(Symbol::ImpulseResponseRate, free.impulse_rate);
    // All symbols that the programs need are set: the values stay as they are otherwise.
    let curve = programs.curve(&propagator, system.excitation()).unwrap_or(propagator);
    let shown = orbits.iter().rfind(|orbit| orbit.orbit.attracts()).or_else(|| orbits.last());
    match shown {
        Some(orbit) => programs.at_ratio(&curve, orbit.absorber_amplitude).unwrap_or(curve),
        None => curve,
    }
}

/// The case's numbers with the amplitudes of the stable fixed point, else of the last one.
fn values(case: &Case, study: &CaseStudy) -> Values {
    let programs = &equations().programs;
    let system = &study.analysis.system;
    let scales = case.scales();
    let lengths = LengthFormat::of(&scales);
    let length = |over_clearance: f64| lengths.number(scales.length(over_clearance));
    let curve = FixedPointCurve::of(system, &study.analysis.manifold);
    let [constant, linear, square] = curve.coefficients();
    let mut values = case_values(case, system)
        .with(Symbol::ForcingConstant, constant)
        .with(Symbol::ForcingLinear, linear)
        .with(Symbol::ForcingSquare, square)
        .with(Symbol::CollisionForcing, curve.collision_forcing());
    // Without fixed points its root is none.
    match equations().fixed_points.discriminant.evaluate(&values) {
        Ok(discriminant) if discriminant >= 0.0 => values.set(Symbol::Discriminant, discriminant),
        _ => {}
    }
    let points = &study.analysis.fixed_points;
    let shown = points.iter().rfind(|point| point.stable).or_else(|| points.last());
    if let Some(point) = shown {
        // Both symbols that the point needs are set: the values stay as they are otherwise.
        values = programs.at_shift(&values, point.shift).unwrap_or(values);
        values.set(Symbol::ExcitationPhase, point.eta);
        values.set(Symbol::AbsorberPhase, point.absorber_phase);
        values.set(Symbol::OscillatorAmplitude, length(point.oscillator_amplitude));
        values.set(Symbol::AbsorberAmplitude, length(point.absorber_amplitude));
        let harmonic = equations().stated.first_harmonic.right.evaluate(&values);
        if let Ok(harmonic) = harmonic {
            values.set(Symbol::FirstHarmonic, harmonic);
        }
    }
    values
}
