//! The equations of a case, general and with its numbers put in.

use serde_json::{Value, json};

use crate::case::Case;
use crate::equations;
use crate::orbits;
use crate::orbits::flight::OrbitFlight;
use crate::study::CaseStudy;
use crate::symbolic::{Equation, Expr, Group, Symbol, Values, format_number};

/// Digits of the numbers that are put into formulas.
const DIGITS: usize = 4;

/// All equations with the case's numbers, in groups.
pub fn groups(case: &Case, study: &CaseStudy) -> Vec<Value> {
    let excitation = study.analysis.system.excitation();
    let theory = equations::groups(excitation);
    let exact = orbits::equations::groups(excitation);
    let at_fixed_point = fixed_point_values(case, study).completed(theory.clone());
    let on_orbit = orbit_values(case, study).completed(exact.clone());
    let theory = theory.map(|group| with_numbers(group, &at_fixed_point));
    theory.chain(exact.map(|group| with_numbers(group, &on_orbit))).collect()
}

/// Equations under one title, each in LaTeX: in general, with numbers, and the value of its right side where that is
/// no number already and all of its symbols have numbers.
fn with_numbers(group: &Group, values: &Values) -> Value {
    let formula = |equation: &&Equation| {
        let right = equation.right();
        let told = |value: &f64| !value.is_nan() && !matches!(right, Expr::Number(_));
        let value = right.evaluate(values).ok().filter(told);
        json!({
            "general": equation.to_latex(),
            "numbers": equation.to_latex_with(values, DIGITS),
            "value": value.map(|value| format_number(value, DIGITS)),
        })
    };
    json!({
        "title": group.title,
        "gives": group.gives,
        "source": group.source,
        "formulas": group.equations.iter().map(formula).collect::<Vec<_>>(),
    })
}

/// A length over the clearance in the unit of the case's pages.
fn length(case: &Case, over_clearance: f64) -> f64 {
    case.units().length_number(case.units().length(over_clearance))
}

/// The case's numbers that belong to no motion: dimensionless ones, and lengths in the report's unit.
fn case_values(case: &Case, study: &CaseStudy) -> Values {
    let system = &study.analysis.system;
    let forcing = case.units().length_number(case.design.forcing());
    equations::values_of(system)
        .with(Symbol::b, length(case, 1.0))
        .with(Symbol::G, forcing)
        .with(Symbol::F, forcing * system.mass_ratio())
}

/// The case's numbers with those of the exact symmetric orbit: of the larger attracting one, else of
/// the last one. Symbols of an orbit have no numbers where there is none or the cavity is not ideal, and those of
/// the steady motion none where there is no such motion.
fn orbit_values(case: &Case, study: &CaseStudy) -> Values {
    let system = &study.analysis.system;
    let values = case_values(case, study);
    let Ok(flight) = OrbitFlight::of(system) else { return values };
    let orbits = &study.exact.orbits;
    let [impulse, rate_plus_one] = flight.half_period_response();
    let values = values.with(Symbol::g, impulse).with(Symbol::h, rate_plus_one);
    let shown = orbits.iter().rfind(|orbit| orbit.orbit.attracts()).or_else(|| orbits.last());
    let Some(orbit) = shown.filter(|_| system.cavity().is_ideal()) else { return values };
    values
        .with(Symbol::beta, orbit.absorber_amplitude)
        .with(Symbol::B, length(case, orbit.absorber_amplitude))
        .with(Symbol::x_0, length(case, orbit.impact_displacement))
}

/// The case's numbers with the amplitudes of the stable fixed point, else of the last one.
fn fixed_point_values(case: &Case, study: &CaseStudy) -> Values {
    let values = case_values(case, study);
    let points = &study.analysis.fixed_points;
    let Some(point) = points.iter().rfind(|point| point.stable).or_else(|| points.last()) else {
        return values;
    };
    values
        .with(Symbol::beta, point.absorber_amplitude)
        .with(Symbol::u, point.shift)
        .with(Symbol::eta, point.eta)
        .with(Symbol::C, length(case, point.oscillator_amplitude))
        .with(Symbol::B, length(case, point.absorber_amplitude))
}
