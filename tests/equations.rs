//! What the program derives, against what was derived by hand, and against published numbers.

use std::f64::consts::PI;
use vinesink::equations::{Equations, Programs, equations};
use vinesink::simulation::contact::rebound;
use vinesink::simulation::flow::Oscillator;
use vinesink::symbolic::Symbol::{
    AbsorberAmplitude, AbsorberPhase, AmplitudeRatio, Clearance, Damping, Detuning,
    ExcitationPhase, FirstHarmonic, ForcingPerClearance, ManifoldCurvature, OscillatorAmplitude,
    ReducedForcing, Restitution, RestitutionRatio, Shift,
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
    forcing: f64,
    curvature: f64,
    m: f64,
    k: f64,
}

impl Hand {
    fn of(Case(r, damping, detuning, forcing): Case) -> Self {
        let rho = (1.0 - r) / (1.0 + r);
        let curvature = 4.0 * rho * rho / (PI * PI);
        let (m, k) = (8.0 / (PI * PI), 16.0 * rho / (PI * PI * PI));
        Self { damping, detuning, forcing, curvature, m, k }
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

    fn quartic(&self) -> [f64; 5] {
        let (mut sum, c) = (self.numerator(), self.square());
        (0..3).for_each(|power| sum[power] -= self.forcing * self.forcing * c[power]);
        sum
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

#[test]
fn quartic_coefficients_agree_with_those_derived_by_hand() {
    for case in CASES {
        let found = programs().fixed_point_coefficients_by_ratio(&case.values()).expect("set");
        for (found, expected) in found.into_iter().zip(Hand::of(case).quartic()) {
            // The hand-derived sums hold terms up to 16 sigma^2, which cancel in part.
            assert_close(found, expected, 1e-12);
        }
    }
}

#[test]
fn the_shifted_quartic_is_the_same_polynomial() {
    for case in CASES {
        let values = case.values();
        let by_shift = programs().fixed_point_coefficients(&values).expect("set");
        let by_ratio = programs().fixed_point_coefficients_by_ratio(&values).expect("set");
        let hand = Hand::of(case);
        let (l, s) = (hand.damping * hand.curvature + hand.k, 2.0 * hand.detuning * hand.curvature);
        let constant = l * l + s * s - hand.forcing * hand.forcing * hand.curvature;
        assert_close(by_shift[0], constant, ROUNDING);
        for step in -20..=20 {
            let u = 0.1 * f64::from(step);
            let size: f64 = by_ratio.iter().map(|c| c.abs()).sum::<f64>() * 81.0;
            let difference = horner(&by_shift, u) - horner(&by_ratio, 1.0 + u);
            // Horner's rule errs by a few units in the last place of the sum of sizes, 3^4 = 81.
            assert!(difference.abs() < 1e-15 * 8.0 * size, "{case:?} {u}");
        }
    }
}

#[test]
fn shifted_coefficients_keep_their_digits_when_impacts_hardly_lose_energy() {
    let values = Case(1.0 - 1e-9, 0.0, 2.0, 1.0).values();
    let rho = 1e-9 / (2.0 - 1e-9);
    let curvature = 4.0 * rho * rho / (PI * PI);
    let k = 16.0 * rho / (PI * PI * PI);
    let [constant, ..] = programs().fixed_point_coefficients(&values).expect("set");
    let expected = k * k + 16.0 * curvature * curvature - curvature;
    // 1 - r itself is rounded at 1e-16 of 1, that is 1e-7 of 1e-9; squared it is 2e-7.
    assert!((constant - expected).abs() < 3e-7 * expected.abs(), "{constant} {expected}");
    assert!(constant < 0.0);
}

#[test]
fn a_root_of_the_condition_is_a_rest_point_of_the_paper_s_equations() {
    let stated = &equations().stated;
    for case in CASES.into_iter().take(3) {
        for step in -6..=12 {
            let u = 0.1 * f64::from(step) + 0.03;
            let point = programs().at_shift(&case.values(), u).expect("R is set");
            let forcing = libm::sqrt(programs().forcing_squared(&point).expect("set"));
            let eta = programs().excitation_phase(&point).expect("set");
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
fn the_saddle_node_condition_is_the_derivative_of_the_forcing() {
    for case in CASES.into_iter().take(3) {
        let values = case.values();
        let coefficients = programs().saddle_node_coefficients(&values).expect("set");
        let forcing_squared = |u: f64| {
            let point = programs().at_shift(&values, u).expect("R is set");
            programs().forcing_squared(&point).expect("set")
        };
        for step in -6..=12 {
            let u = 0.1 * f64::from(step) + 0.03;
            let slope = |h: f64| (forcing_squared(u + h) - forcing_squared(u - h)) / (2.0 * h);
            let (coarse, fine) = (slope(2e-5), slope(1e-5));
            let point = programs().at_shift(&values, u).expect("R is set");
            let square = programs().manifold_square(&point).expect("set");
            let found = horner(&coefficients, u) / (square * square);
            // Two steps show the truncation error; rounding over the step is 1e-16 / 1e-5.
            let error = 2.0 * (coarse - fine).abs() + 1e-9 * (1.0 + forcing_squared(u));
            assert!((found - fine).abs() < error, "{case:?} {u}: {found} {fine}");
        }
    }
}

#[test]
fn saddle_node_coefficients_agree_by_ratio_and_with_hand() {
    let expressions = &equations().fixed_points.saddle_node_by_ratio;
    for case in CASES {
        let (hand, values) = (Hand::of(case), case.values());
        let (n, c) = (hand.numerator(), hand.square());
        let mut expected = [0.0; 6];
        for i in 0..5 {
            for j in 0..3 {
                if i + j > 0 {
                    expected[i + j - 1] += (i as f64 - j as f64) * n[i] * c[j];
                }
            }
        }
        for (expression, expected) in expressions.iter().zip(expected) {
            assert_close(number(expression, &values), expected, 1e-12);
        }
        let by_shift = programs().saddle_node_coefficients(&values).expect("set");
        let size: f64 = expected.iter().map(|c| c.abs()).sum::<f64>() * 32.0;
        let difference = horner(&by_shift, 0.4) - horner(&expected, 1.4);
        assert!(difference.abs() < 1e-14 * size, "{case:?}");
    }
}

#[test]
fn the_frequency_response_solves_the_same_condition() {
    for case in CASES {
        for u in [-0.4, 0.1, 0.7] {
            let point = programs().at_shift(&case.values(), u).expect("R is set");
            let quadratic = programs().detuning_coefficients(&point).expect("set");
            let quartic = programs().fixed_point_coefficients(&point).expect("set");
            // Terms up to sigma^2 c_2^2, about 100.
            assert_close(horner(&quadratic, case.2), horner(&quartic, u), 1e-12);
        }
    }
}

#[test]
fn boundaries_are_fixed_points_at_the_special_points() {
    for case in CASES.into_iter().take(3) {
        let values = case.values();
        let fold = programs().fold(&values).expect("set");
        let breaking = programs().symmetry_breaking(&values).expect("set");
        let found = [programs().hopf_forcing(&values), programs().breaking_forcing(&values)];
        for (shift, found) in [fold.shift, breaking.shift].into_iter().zip(found) {
            let point = programs().at_shift(&values, shift).expect("set");
            let expected = libm::sqrt(programs().forcing_squared(&point).expect("set"));
            assert_close(found.expect("set"), expected, 1e-13);
        }
    }
}

#[test]
fn boundaries_reach_their_limits() {
    // r = 1: C = 0 at the fold, and only the absorber's own first harmonic, 8/pi^2, is left.
    let elastic = Case(1.0, 1.8, -0.7, 1.0).values();
    assert_close(programs().hopf_forcing(&elastic).expect("set"), 8.0 / (PI * PI), ROUNDING);
    let meeting = programs().meeting_point(&elastic).expect("set");
    assert_close(meeting.detuning, -4.0 / (PI * PI), ROUNDING);
    // No damping: sine and cosine sides at the fold, by hand.
    let hand = Hand::of(Case(0.6, 0.0, 0.3, 1.0));
    let (beta, square) = (1.0 / (1.0 + hand.curvature), hand.curvature / (1.0 + hand.curvature));
    let sine = hand.k * beta * beta;
    let cosine = hand.m * beta * (1.0 - beta) - 0.6 * square;
    let expected = libm::sqrt((sine * sine + cosine * cosine) / square);
    let found = programs().hopf_forcing(&Case(0.6, 0.0, 0.3, 1.0).values()).expect("set");
    assert_close(found, expected, ROUNDING);
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
        let found = programs().meeting_point(&case.values()).expect("set");
        // By hand 1 - beta, as small as R, is a difference: for r = 0.999999 R is 1e-13.
        let tolerance = if hand.curvature < 1e-6 { 1e-2 } else { 1e-12 };
        assert_close(found.detuning, expected, tolerance);
        let values = case.values().with(Detuning, found.detuning);
        let hopf = programs().hopf_forcing(&values).expect("set");
        assert_close(found.forcing_per_clearance, hopf, ROUNDING);
        // There the saddle-node condition holds at the fold itself.
        let coefficients = programs().saddle_node_coefficients(&values).expect("set");
        let fold = programs().fold(&values).expect("set");
        let size = coefficients[0].abs().max(hand.curvature);
        assert!(horner(&coefficients, fold.shift).abs() < 1e-12 * size, "{case:?}");
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
    let meeting = programs().meeting_point(&table.at(8.0)).expect("set");
    // Half a unit of the last printed digit.
    assert!((meeting.detuning - -0.70958).abs() < 0.5e-5, "{meeting:?}");
    assert!((meeting.forcing_per_clearance - 1.11876).abs() < 0.5e-5, "{meeting:?}");
    let frequency = table.frequency * (1.0 + table.mass_ratio * meeting.detuning);
    assert!((frequency - 8.3036).abs() < 0.5e-4, "{frequency}");
}

#[test]
fn table_1_has_its_boundaries_where_an_independent_program_found_them() {
    let table = TableOne::new();
    let reduced_forcing = 0.25 / table.mass_ratio;
    for (frequency, breaking, hopf) in [(8.0, 4.687, 15.346), (8.5, 6.443, 26.496)] {
        let values = table.at(frequency);
        let found_breaking = reduced_forcing / programs().breaking_forcing(&values).expect("set");
        let found_hopf = reduced_forcing / programs().hopf_forcing(&values).expect("set");
        // Half a unit of the last printed digit, in mm.
        assert!((found_breaking - breaking).abs() < 0.5e-3, "{frequency}: {found_breaking}");
        assert!((found_hopf - hopf).abs() < 0.5e-3, "{frequency}: {found_hopf}");
    }
}

#[test]
fn the_jacobian_is_the_limit_of_difference_quotients() {
    for case in CASES.into_iter().take(3) {
        for (u, eta) in [(0.2, 0.3), (-0.5, 2.0), (0.9, -2.5)] {
            let at = |u: f64, eta: f64| {
                programs().at_shift(&case.values().with(ExcitationPhase, eta), u).expect("set")
            };
            let found = programs().stability(&at(u, eta)).expect("set");
            let rates = |u: f64, eta: f64| programs().slow_flow(&at(u, eta)).expect("set");
            let step = 1e-5;
            let by_shift = [rates(u + step, eta), rates(u - step, eta)];
            let by_phase = [rates(u, eta + step), rates(u, eta - step)];
            for row in 0..2 {
                for (column, sides) in [by_shift, by_phase].iter().enumerate() {
                    let expected = (sides[0][row] - sides[1][row]) / (2.0 * step);
                    // step^2 of third derivatives of order 1000, and 1e-15 / step: below 1e-6.
                    assert_close(found.jacobian[row][column], expected, 1e-6);
                }
            }
            let [[a, b], [c, d]] = found.jacobian;
            assert_close(found.trace, a + d, ROUNDING);
            assert_close(found.determinant, a * d - b * c, ROUNDING);
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
    let Equations { stated, fixed_points, boundaries, .. } = equations();
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
            fixed_points.condition.to_latex(),
            r"\left(\lambda c_2 + \frac{16}{\pi^{3}} \rho \beta^{2}\right)^{2} + \left(\frac{8}{\pi^{2}} \beta \left(1 - \beta\right) - 2 \sigma c_2\right)^{2} - \gamma^{2} c_2",
        ),
        (
            fixed_points.by_shift[0].to_latex(),
            r"\left(\lambda R + \frac{16}{\pi^{3}} \rho\right)^{2} + 4 R^{2} \sigma^{2} - R \gamma^{2}",
        ),
        (
            boundaries.meeting_detuning.to_latex(),
            r"\frac{2 \left(2 + \pi \lambda \rho\right)}{\pi^{2} \left(R - 1\right)}",
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
    let values = programs().at_shift(&CASES[0].values(), 0.2).expect("R is set");
    let coefficients = programs().fixed_point_coefficients(&values).expect("set");
    let list = equations().for_report();
    let quartic = list.iter().filter(|equation| equation.title.starts_with("Quartic"));
    for (equation, coefficient) in quartic.zip(coefficients) {
        assert_eq!(number(&equation.right, &values).to_bits(), coefficient.to_bits());
    }
    let p0 = list.iter().find(|equation| equation.left == "p_{0}").expect("listed");
    assert!(
        p0.to_latex_with(&values, 4).ends_with("= 0.001093"),
        "{}",
        p0.to_latex_with(&values, 4)
    );
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
