//! The equations of a case, general and with its numbers put in.

use serde::Serialize;

use super::numbers::LengthFormat;
use crate::case::Case;
use crate::equations::{ReportEquation, equations};
use crate::study::CaseStudy;
use crate::symbolic::{Symbol, Values};
use crate::system::Excitation;

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
    let values = values(case, study);
    let mut groups: Vec<EquationGroup> = Vec::new();
    let elsewhere = match study.analysis.system.excitation() {
        Excitation::BaseDisplacement => equations().stated.motion_by_force.name,
        Excitation::Force => equations().stated.motion_of_base.name,
    };
    let of_this_case = |equation: &ReportEquation| equation.title != elsewhere;
    for equation in equations().for_report().into_iter().filter(of_this_case) {
        let formula = Formula {
            general: equation.to_latex(),
            numbers: equation.to_latex_with(&values, DIGITS),
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

/// The case's numbers: dimensionless ones, lengths in the report's unit, and the amplitudes of the
/// stable fixed point, else of the last one.
fn values(case: &Case, study: &CaseStudy) -> Values {
    let programs = &equations().programs;
    let system = &study.analysis.system;
    let scales = case.scales();
    let lengths = LengthFormat::of(&scales);
    let length = |over_clearance: f64| lengths.number(scales.length(over_clearance));
    let mut values = programs
        .values(system)
        .with(Symbol::Clearance, length(1.0))
        .with(Symbol::ReducedForcing, lengths.number(scales.forcing))
        .with(Symbol::BaseAmplitude, lengths.number(scales.forcing) * system.mass_ratio());
    let points = &study.analysis.fixed_points;
    let shown = points.iter().rfind(|point| point.stable).or_else(|| points.last());
    if let Some(point) = shown {
        // Both symbols that the point needs are set: the values stay as they are otherwise.
        values = programs.at_shift(&values, point.shift).unwrap_or(values);
        values.set(Symbol::ExcitationPhase, point.eta);
        values.set(Symbol::AbsorberPhase, point.absorber_phase);
        values.set(Symbol::OscillatorAmplitude, length(point.oscillator));
        values.set(Symbol::AbsorberAmplitude, length(point.absorber));
        let harmonic = equations().stated.first_harmonic.right.evaluate(&values);
        if let Ok(harmonic) = harmonic {
            values.set(Symbol::FirstHarmonic, harmonic);
        }
    }
    values
}
