//! What the program derives, against what was derived by hand, and against published numbers.

use std::f64::consts::PI;
use vinesink::equations::{Equations, Programs, Quadratic, equations};
use vinesink::simulation::contact::rebound;
use vinesink::simulation::flow::Oscillator;
use vinesink::symbolic::Symbol::{
    AbsorberAmplitude, AbsorberPhase, AmplitudeRatio, Clearance, Damping, Detuning, Discriminant,
    ExcitationPhase, FirstHarmonic, ForcingPerClearance, ForcingSquare, ManifoldCurvature,
    OscillatorAmplitude, ReducedForcing, Restitution, RestitutionRatio, Shift,
};
use vinesink::symbolic::{Expr, Symbol, Values, to_mathml};
use vinesink::system::{Excitation, Parameters, System};

/// A few dozen operations on numbers of order 1: a hundred units in the last place.
const ROUNDING: f64 = 2e-14;

fn assert_close(found: f64, expected: f64, relative: f64) {
    let error = (found - expected).abs();
    assert!(error <= relative * expected.abs().max(1.0), "{found} is not {expected}");
}

fn number(expression: &Expr, values: &Values) -> f64 {
    expression.evaluate(values).expect("all symbols have values")
}

fn quadratic(case: Case) -> Quadratic {
    programs().quadratic(&case.values()).expect("set")
}

/// `gamma` that holds a point of the manifold.
fn forcing(point: &Values) -> f64 {
    libm::sqrt(number(&equations().fixed_points.forcing_squared, point))
}

/// `eta` of a fixed point.
fn phase(point: &Values) -> f64 {
    let [sine, cosine] = programs().sides(point).expect("set");
    libm::atan2(sine, cosine)
}

fn programs() -> &'static Programs {
    &equations().programs
}

/// Restitution, damping, detuning, forcing per clearance.
#[derive(Debug, Clone, Copy)]
struct Case(f64, f64, f64, f64);

impl Case {
    fn values(self) -> Values {
        let Case(restitution, damping, detuning, forcing) = self;
        programs()
            .values_of(restitution)
            .with(Damping, damping)
            .with(Detuning, detuning)
            .with(ForcingPerClearance, forcing)
    }
}

/// Ordinary cases and every limit: elastic and plastic impacts, no damping, no forcing.
const CASES: [Case; 8] = [
    Case(0.6, 1.8, -0.7, 1.1),
    Case(0.3, 0.4, 2.5, 3.0),
    Case(0.9, 5.0, -6.0, 0.2),
    Case(0.999_999, 1.0, 0.5, 1.0),
    Case(1.0, 1.8, -0.7, 1.1),
    Case(0.0, 1.8, 0.3, 1.1),
    Case(0.6, 0.0, -0.7, 1.1),
    Case(0.6, 1.8, 0.0, 0.0),
];

/// Short-hands of the formulas derived by hand.
struct Hand {
    damping: f64,
    detuning: f64,
    curvature: f64,
    m: f64,
    k: f64,
}

impl Hand {
    fn of(Case(r, damping, detuning, _): Case) -> Self {
        let rho = (1.0 - r) / (1.0 + r);
        let curvature = 4.0 * rho * rho / (PI * PI);
        let (m, k) = (8.0 / (PI * PI), 16.0 * rho / (PI * PI * PI));
        Self { damping, detuning, curvature, m, k }
    }

    /// `c_2` by powers of `beta`.
    fn square(&self) -> [f64; 3] {
        [1.0, -2.0, 1.0 + self.curvature]
    }

    /// `(lambda c_2 + k beta^2)^2 + (m beta (1 - beta) - 2 sigma c_2)^2` by powers of `beta`.
    fn numerator(&self) -> [f64; 5] {
        let c = self.square();
        let (l, s) = (self.damping, 2.0 * self.detuning);
        let sine = [l * c[0], l * c[1], l * c[2] + self.k];
        let cosine = [-s * c[0], self.m - s * c[1], -self.m - s * c[2]];
        let mut sum = [0.0; 5];
        for i in 0..3 {
            for j in 0..3 {
                sum[i + j] += sine[i] * sine[j] + cosine[i] * cosine[j];
            }
        }
        sum
    }

    /// `gamma^2` of a fixed point at `beta`, by squaring and adding.
    fn forcing_squared(&self, beta: f64) -> f64 {
        let square = (1.0 - beta) * (1.0 - beta) + self.curvature * beta * beta;
        let sine = self.damping * square + self.k * beta * beta;
        let cosine = self.m * beta * (1.0 - beta) - 2.0 * self.detuning * square;
        (sine * sine + cosine * cosine) / square
    }
}

fn horner(coefficients: &[f64], variable: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, coefficient| sum * variable + coefficient)
}

#[test]
fn the_manifold_is_equation_16() {
    let manifold = &equations().manifold;
    assert_eq!(manifold.square.to_latex(), r"\left(b - B\right)^{2} + R B^{2}");
    assert_eq!(manifold.square_by_powers.to_latex(), r"\left(1 + R\right) B^{2} - 2 b B + b^{2}");
    let stated = &equations().stated;
    let printed = stated.manifold.right.clone();
    let derived = manifold
        .square
        .substitute(ManifoldCurvature, &stated.curvature.right)
        .substitute(RestitutionRatio, &stated.restitution_ratio.right);
    assert!((printed - derived).vanishes());
}

#[test]
fn the_fold_is_where_the_slope_vanishes() {
    let manifold = &equations().manifold;
    assert_eq!(manifold.fold_amplitude.to_latex(), r"\frac{b}{1 + R}");
    assert_eq!(manifold.fold_shift.to_latex(), r"-\frac{R}{1 + R}");
    assert_eq!(manifold.fold_square.to_latex(), r"\frac{R}{1 + R}");
    for case in CASES {
        let (values, hand) = (case.values().with(Clearance, 2.5), Hand::of(case));
        let expected = 2.5 * libm::sqrt(hand.curvature / (1.0 + hand.curvature));
        assert_close(number(&manifold.fold_oscillator, &values), expected, ROUNDING);
        let fold = programs().fold(&values).expect("R is set");
        assert_close(fold.ratio, 1.0 / (1.0 + hand.curvature), ROUNDING);
        assert_close(fold.ratio, 1.0 + fold.shift, ROUNDING);
        assert_close(2.5 * 2.5 * fold.square, expected * expected, ROUNDING);
    }
}

#[test]
fn a_multiplier_of_1_is_the_fold_and_of_minus_1_breaks_symmetry() {
    let Equations { stated, manifold, .. } = equations();
    let fold = manifold
        .fold_ratio
        .substitute(ManifoldCurvature, &stated.curvature.right)
        .substitute(RestitutionRatio, &stated.restitution_ratio.right);
    assert!((fold - &manifold.unit_multiplier_ratio).vanishes());
    assert_eq!(manifold.breaking_ratio.to_latex(), r"\frac{\pi^{2}}{\pi^{2} - 4}");
    for case in CASES {
        let breaking = programs().symmetry_breaking(&case.values()).expect("R is set");
        // The check value has six digits.
        assert_close(breaking.ratio, 1.68148, 0.5e-5);
        let at = programs().at_shift(&case.values(), breaking.shift).expect("R is set");
        assert_close(breaking.square, programs().manifold_square(&at).expect("a point"), ROUNDING);
    }
}

#[test]
fn manifold_relations_hold_in_any_unit_of_length() {
    let Equations { stated, manifold, .. } = equations();
    for case in CASES {
        let values = case.values().with(Clearance, 3.0).with(AbsorberAmplitude, 4.2);
        let square = number(&manifold.square, &values);
        let ratio = values.with(AmplitudeRatio, 1.4);
        assert_close(square, 9.0 * number(&manifold.ratio_square, &ratio), ROUNDING);
        let values = ratio.with(OscillatorAmplitude, libm::sqrt(square));
        let (sine, cosine) = (number(&manifold.sine, &values), number(&manifold.cosine, &values));
        let values = values.with(AbsorberPhase, libm::atan2(sine, cosine));
        assert_close(number(&stated.impact_position.residual(), &values), 0.0, 1e-14);
        assert_close(number(&stated.impact_velocity.residual(), &values), 0.0, 1e-14);
    }
}

/// The two conditions, multiplied by C, squared and added by hand, are a quartic in beta; it is
/// `c_2` times the quadratic, coefficient by coefficient, with the quadratic as PHYSICS writes it.
#[test]
fn squaring_the_two_conditions_gives_the_manifold_times_the_quadratic() {
    for case in CASES {
        let hand = Hand::of(case);
        let (quadratic, square) = (quadratic(case).coefficients, hand.square());
        let mut product = [0.0; 5];
        for i in 0..3 {
            for j in 0..3 {
                product[i + j] += quadratic[i] * square[j];
            }
        }
        for (found, expected) in product.into_iter().zip(hand.numerator()) {
            // The hand-derived sums hold terms up to 16 sigma^2, which cancel in part.
            assert_close(found, expected, 1e-12);
        }
        let Case(r, lambda, sigma, _) = case;
        let (rho, s) = ((1.0 - r) / (1.0 + r), sigma * sigma + 0.25 * lambda * lambda);
        let expected = [
            4.0 * s,
            -(8.0 * s + 32.0 * sigma / (PI * PI)),
            4.0 * s * (1.0 + hand.curvature)
                + 32.0 * (sigma / (PI * PI) + lambda * rho / (PI * PI * PI))
                + 64.0 / (PI * PI * PI * PI),
        ];
        for (found, expected) in quadratic.into_iter().zip(expected) {
            assert_close(found, expected, 1e-13);
        }
    }
}

/// The smallest forcing is where the quadratic's slope vanishes, and that is where the derivative of
/// the condition as squared by hand does.
#[test]
fn the_saddle_node_is_the_smallest_forcing() {
    for case in CASES {
        let (hand, found) = (Hand::of(case), quadratic(case));
        let Case(r, lambda, sigma, _) = case;
        let (rho, s) = ((1.0 - r) / (1.0 + r), sigma * sigma + 0.25 * lambda * lambda);
        let [_, linear, square] = found.coefficients;
        let expected = 8.0 * (rho * s / PI + lambda / (PI * PI)) / square.sqrt();
        assert_close(found.collision, expected, ROUNDING);
        let beta = -linear / (2.0 * square);
        // Where C vanishes the condition by hand is 0 over 0.
        if horner(&hand.square(), beta) > 1e-3 {
            // Squares of numbers up to 12 lose their digits in the root.
            let lost = 1e-14 * 144.0 / expected.max(1e-6);
            assert_close(hand.forcing_squared(beta).max(0.0).sqrt(), expected, lost.max(1e-12));
            for step in [-0.01, 0.01] {
                assert!(hand.forcing_squared(beta + step) > hand.forcing_squared(beta), "{case:?}");
            }
        }
    }
}

/// Near -4/pi^2 with little loss the terms of p_2 cancel if they are multiplied out.
#[test]
fn the_square_s_coefficient_keeps_its_digits() {
    for distance in [1e-3, 1e-6, 1e-8] {
        let sigma = distance - 4.0 / (PI * PI);
        let [_, _, square] = quadratic(Case(1.0, 0.0, sigma, 1.0)).coefficients;
        let expected = 4.0 * distance * distance;
        // sigma itself is rounded at 6e-17.
        assert!((square / expected - 1.0).abs() < 1e-15 / distance, "{square} {expected}");
    }
}

#[test]
fn a_root_of_the_condition_is_a_rest_point_of_the_paper_s_equations() {
    let stated = &equations().stated;
    for case in CASES.into_iter().take(3) {
        for step in -6..=12 {
            let u = 0.1 * f64::from(step) + 0.03;
            let point = programs().at_shift(&case.values(), u).expect("R is set");
            let (forcing, eta) = (forcing(&point), phase(&point));
            let c = libm::sqrt(programs().manifold_square(&point).expect("set"));
            let values = point
                .with(Clearance, 1.0)
                .with(AbsorberAmplitude, 1.0 + u)
                .with(OscillatorAmplitude, c)
                .with(ReducedForcing, forcing)
                .with(ExcitationPhase, eta);
            let manifold = &equations().manifold;
            let theta =
                libm::atan2(number(&manifold.sine, &values), number(&manifold.cosine, &values));
            let values = values.with(AbsorberPhase, theta);
            let values =
                values.clone().with(FirstHarmonic, number(&stated.first_harmonic.right, &values));
            // Rates are differences of terms of order 10, divided by C of order 0.1.
            assert_close(number(&stated.amplitude_rate.right, &values), 0.0, 1e-13);
            assert_close(number(&stated.phase_rate.right, &values), 0.0, 1e-13);
            let rates = programs().slow_flow(&values.with(ForcingPerClearance, forcing));
            for rate in rates.expect("set") {
                assert_close(rate, 0.0, 1e-12);
            }
        }
    }
}

#[test]
fn the_frequency_response_solves_the_same_condition() {
    for case in CASES {
        for u in [-0.4, 0.1, 0.7] {
            let point = programs().at_shift(&case.values(), u).expect("R is set");
            let by_detuning = programs().detuning_coefficients(&point).expect("set");
            let expected = Hand::of(case).forcing_squared(1.0 + u) - case.3 * case.3;
            // Terms up to 4 sigma^2, about 100.
            assert_close(horner(&by_detuning, case.2), expected, 1e-12);
        }
    }
}

/// `gamma_SN^2 p_2 - gamma^2 p_2` by powers of the detuning is what it is at one detuning.
#[test]
fn detunings_of_a_saddle_node_are_where_its_forcing_is_the_case_s() {
    for case in CASES {
        let by_detuning = programs().collision_detunings(&case.values()).expect("set");
        let Quadratic { coefficients: [_, _, square], collision, .. } = quadratic(case);
        let expected = square * (collision - case.3) * (collision + case.3);
        // Terms up to sigma^4.
        assert_close(horner(&by_detuning, case.2), expected, 1e-12);
    }
}

#[test]
fn boundaries_are_fixed_points_at_the_special_points() {
    for case in CASES.into_iter().take(3) {
        let values = case.values();
        let fold = programs().fold(&values).expect("set");
        let breaking = programs().symmetry_breaking(&values).expect("set");
        let found = quadratic(case);
        for (at, found) in [fold, breaking].into_iter().zip([found.hopf, found.breaking]) {
            let expected = Hand::of(case).forcing_squared(at.ratio).sqrt();
            assert_close(found, expected, 1e-12);
            let point = programs().at_shift(&values, at.shift).expect("set");
            assert_close(found, forcing(&point), ROUNDING);
        }
    }
}

#[test]
fn boundaries_reach_their_limits() {
    // r = 1: C = 0 at the fold, and only the absorber's own first harmonic, 8/pi^2, is left.
    let elastic = Case(1.0, 1.8, -0.7, 1.0);
    assert_close(quadratic(elastic).hopf, 8.0 / (PI * PI), ROUNDING);
    let meeting = programs().meeting_detuning(&elastic.values()).expect("set");
    assert_close(meeting, -4.0 / (PI * PI), ROUNDING);
    // No damping: sine and cosine sides at the fold, by hand.
    let undamped = Case(0.6, 0.0, 0.3, 1.0);
    let expected = Hand::of(undamped).forcing_squared(1.0 / (1.0 + Hand::of(undamped).curvature));
    assert_close(quadratic(undamped).hopf, expected.sqrt(), 1e-13);
}

#[test]
fn p1_agrees_with_the_formula_derived_by_hand() {
    for case in CASES {
        let hand = Hand::of(case);
        let beta = 1.0 / (1.0 + hand.curvature);
        let square = hand.curvature / (1.0 + hand.curvature);
        if square == 0.0 {
            continue; // The formula by hand divides 0 by 0; its limit has its own test.
        }
        let sine = hand.damping * square + hand.k * beta * beta;
        let slope = 2.0 * hand.k * beta * sine / (hand.m * (1.0 - 2.0 * beta));
        let expected = (hand.m * beta * (1.0 - beta) + slope) / (2.0 * square);
        let found = programs().meeting_detuning(&case.values()).expect("set");
        // By hand 1 - beta, as small as R, is a difference: for r = 0.999999 R is 1e-13.
        let tolerance = if hand.curvature < 1e-6 { 1e-2 } else { 1e-12 };
        assert_close(found, expected, tolerance);
        // There the saddle-node is at the fold itself.
        let there = quadratic(Case(case.0, case.1, found, case.3));
        let [_, linear, square] = there.coefficients;
        assert_close(-linear / (2.0 * square), beta, 1e-12);
        assert_close(there.collision, there.hopf, 1e-12);
    }
}

/// Table 1 of the paper, from the printed masses, stiffness and damping.
struct TableOne {
    mass_ratio: f64,
    frequency: f64,
    damping: f64,
}

impl TableOne {
    fn new() -> Self {
        let natural = libm::sqrt(11.47e3 / 4.168);
        Self {
            mass_ratio: 0.032 / 4.168,
            frequency: natural / (2.0 * PI),
            damping: 3.02 / (0.032 * natural),
        }
    }

    fn at(&self, frequency: f64) -> Values {
        let system = System::new(Parameters {
            mass_ratio: self.mass_ratio,
            damping: self.damping,
            restitution: 0.6,
            frequency_ratio: frequency / self.frequency,
            forcing_per_clearance: 1.0,
            excitation: Excitation::BaseDisplacement,
        });
        programs().values(&system.expect("a physical system"))
    }
}

#[test]
fn table_1_has_its_meeting_point_where_an_independent_program_found_it() {
    let table = TableOne::new();
    let values = table.at(8.0);
    let meeting = programs().meeting_detuning(&values).expect("set");
    let there = programs().quadratic(&values.with(Detuning, meeting)).expect("set");
    // Half a unit of the last printed digit.
    assert!((meeting - -0.70958).abs() < 0.5e-5, "{meeting}");
    assert!((there.hopf - 1.11876).abs() < 0.5e-5, "{there:?}");
    let frequency = table.frequency * (1.0 + table.mass_ratio * meeting);
    assert!((frequency - 8.3036).abs() < 0.5e-4, "{frequency}");
}

#[test]
fn table_1_has_its_boundaries_where_an_independent_program_found_them() {
    let table = TableOne::new();
    let reduced_forcing = 0.25 / table.mass_ratio;
    for (frequency, expected) in [(8.0, [4.687, 15.346, 16.259]), (8.5, [6.443, 26.496, 34.913])] {
        let found = programs().quadratic(&table.at(frequency)).expect("set");
        for (found, expected) in [found.breaking, found.hopf, found.collision].iter().zip(expected)
        {
            // Half a unit of the last printed digit, in mm.
            let clearance = reduced_forcing / found;
            assert!((clearance - expected).abs() < 0.5e-3, "{frequency}: {clearance} {expected}");
        }
    }
}

/// Trace and determinant in closed form against difference quotients of the rates, at fixed points on
/// both sides of the collision and of the fold.
#[test]
fn stability_is_the_limit_of_difference_quotients() {
    for case in CASES.into_iter().take(3) {
        for u in [-0.6, -0.3, 0.2, 0.9] {
            let point = programs().at_shift(&case.values(), u).expect("set");
            let (gamma, eta) = (forcing(&point), phase(&point));
            let rates = |u: f64, eta: f64| {
                let at = programs().at_shift(&case.values(), u).expect("set");
                let at = at.with(ForcingPerClearance, gamma).with(ExcitationPhase, eta);
                programs().slow_flow(&at).expect("set")
            };
            let step = 1e-5;
            let slope = |row: usize, [du, deta]: [f64; 2]| {
                let sides = [rates(u + du, eta + deta), rates(u - du, eta - deta)];
                (sides[0][row] - sides[1][row]) / (2.0 * step)
            };
            let by = [[step, 0.0], [0.0, step]];
            let [[a, b], [c, d]] = [0, 1].map(|row| by.map(|by| slope(row, by)));
            let [_, linear, square] = quadratic(case).coefficients;
            let root = square * (1.0 + u) + 0.5 * linear;
            let at = point.with(Discriminant, root * root);
            let [trace, larger] = programs().stability(&at).expect("set");
            // step^2 of third derivatives of order 1000, and 1e-15 / step: below 1e-6.
            assert_close(trace, a + d, 1e-6);
            assert_close(larger * root.signum(), a * d - b * c, 1e-5);
        }
    }
}

#[test]
fn values_of_a_system_hold_the_paper_s_short_hands() {
    let values = TableOne::new().at(8.0);
    assert_close(values.require(RestitutionRatio).expect("set"), 0.25, ROUNDING);
    assert_close(values.require(Damping).expect("set"), 1.7990, 0.5e-4);
    let error = programs().manifold_square(&values).expect_err("no point was chosen");
    assert_eq!(error.symbol, Shift);
    assert!(programs().values_of(0.5).get(Damping).is_none());
    assert!(programs().values_of(0.5).get(Restitution).is_some());
}

#[test]
fn the_main_formulas_read_as_on_paper() {
    let Equations { stated, fixed_points, boundaries, slow_flow, .. } = equations();
    let formulas = [
        (
            stated.motion_of_base.to_latex(),
            r"\ddot{x} + \varepsilon \lambda \dot{x} + x = \varepsilon G \sin \left(\Omega \tau\right) + \varepsilon^{2} \lambda G \Omega \cos \left(\Omega \tau\right)",
        ),
        (stated.impact_position.to_latex(), r"C \cos \Theta = b - B"),
        (
            stated.impact_velocity.to_latex(),
            r"\left(1 + r\right) C \sin \Theta = \frac{2}{\pi} \left(1 - r\right) B",
        ),
        (
            stated.amplitude_rate.to_latex(),
            r"\mathrm{D}_1 C = -\frac{1}{2} \lambda C - \frac{1}{2} E \sin \Theta + \frac{1}{2} G \sin \eta",
        ),
        (
            stated.phase_rate.to_latex(),
            r"\mathrm{D}_1 \eta = \frac{G \cos \eta}{2 C} - \frac{E \cos \Theta}{2 C} + \sigma",
        ),
        (
            fixed_points.along.to_latex(),
            r"\frac{2}{\pi} \lambda \rho \beta + 2 \sigma u + \frac{8}{\pi^{2}} \beta",
        ),
        (fixed_points.across.to_latex(), r"-\lambda u + \frac{4}{\pi} \rho \sigma \beta"),
        (fixed_points.quadratic[0].to_latex(), r"\lambda^{2} + 4 \sigma^{2}"),
        (
            fixed_points.quadratic[1].to_latex(),
            r"-\frac{32}{\pi^{2}} \sigma - 2 \lambda^{2} - 8 \sigma^{2}",
        ),
        (
            fixed_points.quadratic[2].to_latex(),
            r"\left(\frac{2}{\pi} \lambda \rho + \frac{8}{\pi^{2}} + 2 \sigma\right)^{2} + \left(\frac{4}{\pi} \rho \sigma - \lambda\right)^{2}",
        ),
        (
            fixed_points.collision_forcing.to_latex(),
            r"\frac{2 \left(\frac{4}{\pi^{2}} \lambda + \frac{1}{\pi} \lambda^{2} \rho + \frac{4}{\pi} \rho \sigma^{2}\right)}{\sqrt{p_2}}",
        ),
        (fixed_points.collision_ratio.to_latex(), r"-\frac{p_1}{2 p_2}"),
        (
            slow_flow.trace.to_latex(),
            r"-\lambda - \frac{16 \rho \beta}{\pi^{3} \left(u + R \beta\right)}",
        ),
        (slow_flow.determinant.to_latex(), r"\frac{\sqrt{\Delta}}{4 \left(u + R \beta\right)}"),
        (
            boundaries.meeting_detuning.to_latex(),
            r"\frac{2 \left(2 + \pi \lambda \rho\right)}{\pi^{2} R - \pi^{2}}",
        ),
    ];
    for (found, expected) in formulas {
        assert_eq!(found, expected);
    }
}

#[test]
fn every_formula_of_the_report_converts_with_and_without_numbers() {
    let values = programs().at_shift(&CASES[0].values().with(ExcitationPhase, 0.3), 0.2);
    let values = values.expect("R is set");
    let list = equations().for_report();
    assert!(list.len() > 40);
    for equation in &list {
        for latex in [equation.to_latex(), equation.to_latex_with(&values, 4)] {
            if let Err(error) = to_mathml(&latex) {
                panic!("{}: {error}", equation.title);
            }
            // Hosts of Markdown refuse formulas with this macro.
            assert!(!latex.contains("operatorname"), "{latex}");
        }
        assert!(!equation.gives.is_empty() && !equation.source.is_empty(), "{}", equation.title);
    }
    for number in ["(1)", "(2)", "(7)", "(14)", "(15)", "(16)", "(18)"] {
        assert!(list.iter().any(|equation| equation.number == Some(number)), "{number}");
    }
}

#[test]
fn what_the_report_prints_is_what_is_evaluated() {
    let values = CASES[0].values();
    let Quadratic { coefficients, collision, hopf, .. } = quadratic(CASES[0]);
    let list = equations().for_report();
    let printed = |left: &str| {
        let equation = list.iter().find(|equation| equation.left == left);
        equation.unwrap_or_else(|| panic!("{left} is not listed"))
    };
    let evaluated = |left: &str, values: &Values| number(&printed(left).right, values);
    for (power, coefficient) in coefficients.into_iter().enumerate() {
        assert_eq!(evaluated(&format!("p_{{{power}}}"), &values), coefficient);
    }
    let values = values.with(ForcingSquare, coefficients[2]);
    assert_eq!(evaluated(r"\gamma_{\mathrm{SN}}", &values), collision);
    assert_eq!(evaluated(r"\gamma_{H}^{2}", &values).sqrt(), hopf);
    let text = printed("p_{2}").to_latex_with(&values, 4);
    assert!(text.ends_with("= 4.184"), "{text}");
}

/// What is simulated is what is stated: (1) with the closed-form motion put in leaves nothing, for
/// either kind of excitation, and so does (2) with the velocities around an impact.
#[test]
fn the_simulated_motion_satisfies_the_stated_equations() {
    for kind in [Excitation::BaseDisplacement, Excitation::Force] {
        let parameters = Parameters {
            mass_ratio: 0.03,
            damping: 2.5,
            restitution: 0.7,
            frequency_ratio: 1.1,
            forcing_per_clearance: 3.0,
            excitation: kind,
        };
        let system = System::new(parameters).expect("valid");
        let stated = &equations().stated;
        let motion = match kind {
            Excitation::BaseDisplacement => &stated.motion_of_base,
            Excitation::Force => &stated.motion_by_force,
        };
        let phase = 0.4;
        let flight = Oscillator::alone(&system).motion(0.3, -0.8, phase);
        for s in [0.0, 0.7, 2.9] {
            let at = flight.at(s);
            let values = equations()
                .programs
                .values(&system)
                .with(Symbol::ReducedForcing, system.forcing_per_clearance())
                .with(Symbol::FastTime, phase / system.frequency_ratio() + s)
                .with(Symbol::X, at.x)
                .with(Symbol::XDot, at.v)
                .with(Symbol::XDotDot, flight.acceleration(s, at));
            let residual = motion.residual().evaluate(&values).expect("all symbols have values");
            // Terms of order one, some ten roundings.
            assert!(residual.abs() < 2e-15, "{kind:?} {s} {residual}");
        }
        let (before, after) = ([0.9, -0.4], rebound(0.03, 0.7, 0.9, -0.4));
        let values = equations()
            .programs
            .values(&system)
            .with(Symbol::WDotBefore, before[0] - before[1])
            .with(Symbol::WDotAfter, after.x_velocity - after.y_velocity);
        let residual = stated.restitution.residual().evaluate(&values).expect("values");
        assert!(residual.abs() < 1e-15, "{residual}");
    }
}
