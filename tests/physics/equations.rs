//! What follows from the paper's equations, against those equations, what was derived by hand, and published
//! numbers.

use std::f64::consts::PI;

use vinesink::equations::{self, fixed_points, manifold, slow_flow, stated};
use vinesink::report::mathml::to_mathml;
use vinesink::simulation::contact::rebound;
use vinesink::simulation::flow::Oscillator;
use vinesink::symbolic::{Equation, Formula, Symbol, Values};
use vinesink::system::{Cavity, Excitation, Parameters, System};

/// A few dozen operations on numbers of order 1: a hundred units in the last place.
const ROUNDING: f64 = 2e-14;

fn assert_close(found: f64, expected: f64, relative: f64) {
    let error = (found - expected).abs();
    assert!(error <= relative * expected.abs().max(1.0), "{found} is not {expected}");
}

/// Left less right: what vanishes where the equation holds.
fn difference(equation: &Equation, values: &Values) -> f64 {
    let [left, right] = [equation.left(), equation.right()]
        .map(|side| side.evaluate(values).expect("all symbols have values"));
    left - right
}

fn number<const N: usize>(formula: &Formula<N>, values: &Values) -> f64 {
    formula.at(formula.parameters.map(|symbol| values.require(symbol).expect("a value")))
}

/// By how much an equation does not hold.
fn residual<const N: usize>(formula: &Formula<N>, values: &Values) -> f64 {
    difference(&formula.equation, values)
}

fn of(values: &Values, symbol: Symbol) -> f64 {
    values.require(symbol).expect("set")
}

fn quadratic(case: Case) -> [f64; 3] {
    let values = case.values();
    [Symbol::p_0, Symbol::p_1, Symbol::p_2].map(|symbol| of(&values, symbol))
}

/// `gamma` that holds a point of the manifold.
fn forcing(point: &Values) -> f64 {
    let sides = [number(&fixed_points::ALONG, point), number(&fixed_points::ACROSS, point)];
    libm::hypot(sides[0], sides[1])
}

/// `eta` of a fixed point.
fn phase(point: &Values) -> f64 {
    libm::atan2(number(&fixed_points::SINE_SIDE, point), number(&fixed_points::COSINE_SIDE, point))
}

fn completed(values: Values) -> Values {
    values.completed(equations::groups(Excitation::BaseDisplacement))
}

/// Restitution, damping, detuning, forcing per clearance.
#[derive(Debug, Clone, Copy)]
struct Case(f64, f64, f64, f64);

impl Case {
    fn given(self) -> Values {
        let Case(restitution, damping, detuning, forcing) = self;
        Values::default()
            .with(Symbol::r, restitution)
            .with(Symbol::lambda, damping)
            .with(Symbol::sigma, detuning)
            .with(Symbol::gamma, forcing)
            .with(Symbol::b, 1.0)
    }

    fn values(self) -> Values {
        completed(self.given())
    }

    /// With a point of the manifold.
    fn at(self, u: f64) -> Values {
        completed(self.given().with(Symbol::u, u).with(Symbol::beta, 1.0 + u))
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

/// (14) and (15) squared and added, and (16) as the paper prints it, are what is derived; in `beta` and
/// `u` as well.
#[test]
fn the_manifold_is_equation_16() {
    for case in CASES {
        for u in [-0.9, -0.3, 0.0, 0.4, 2.0] {
            let at = case.at(u).with(Symbol::b, 3.0).with(Symbol::B, 3.0 * (1.0 + u));
            let r = case.0;
            let cosine = 3.0 - of(&at, Symbol::B);
            let sine = 2.0 / PI * (1.0 - r) / (1.0 + r) * of(&at, Symbol::B);
            let found = number(&manifold::MANIFOLD, &at);
            let printed = (1.0 + 4.0 * (1.0 - r) * (1.0 - r) / (PI * PI * (1.0 + r) * (1.0 + r)))
                * of(&at, Symbol::B)
                * of(&at, Symbol::B)
                - 2.0 * 3.0 * of(&at, Symbol::B)
                + 9.0;
            assert_close(found, cosine * cosine + sine * sine, ROUNDING);
            assert_close(found, printed, ROUNDING);
            assert_close(9.0 * number(&manifold::MANIFOLD_SQUARE, &at), found, ROUNDING);
            let theta = of(&at, Symbol::Theta);
            let c = 3.0 * libm::sqrt(of(&at, Symbol::c_2));
            let at = at.with(Symbol::C, c).with(Symbol::Theta, theta);
            assert_close(residual(&stated::IMPACT_POSITION, &at), 0.0, 1e-14);
            assert_close(residual(&stated::IMPACT_VELOCITIES, &at), 0.0, 1e-14);
            // The stable branch is the larger root.
            let square = of(&at, Symbol::c_2);
            let root = manifold::STABLE_ROOT.at([of(&at, Symbol::R), square]);
            let beta = manifold::STABLE_RATIO.at([of(&at, Symbol::R), root.max(0.0)]);
            let expected = (1.0 + u).max(2.0 * of(&at, Symbol::beta_fold) - 1.0 - u);
            // At the fold half of the digits are lost in the root.
            assert_close(beta, expected, 1e-7);
        }
    }
}

#[test]
fn the_fold_is_where_the_slope_vanishes() {
    for case in CASES {
        let (values, hand) = (case.values().with(Symbol::b, 2.5), Hand::of(case));
        let expected = 2.5 * libm::sqrt(hand.curvature / (1.0 + hand.curvature));
        assert_close(number(&manifold::FOLD_OSCILLATOR, &values), expected, ROUNDING);
        assert_close(
            number(&manifold::FOLD_ABSORBER, &values),
            2.5 / (1.0 + hand.curvature),
            ROUNDING,
        );
        let [ratio, shift] = [Symbol::beta_fold, Symbol::u_fold].map(|symbol| of(&values, symbol));
        assert_close(ratio, 1.0 / (1.0 + hand.curvature), ROUNDING);
        assert_close(ratio, 1.0 + shift, ROUNDING);
        let square = |u| manifold::MANIFOLD_SQUARE.at([hand.curvature, u]);
        assert_close(2.5 * 2.5 * square(shift), expected * expected, ROUNDING);
        assert!(square(shift + 1e-4) > square(shift) && square(shift - 1e-4) > square(shift));
    }
}

/// The stated trace and determinant, at the fold and at symmetry breaking.
#[test]
fn a_multiplier_of_1_is_the_fold_and_of_minus_1_breaks_symmetry() {
    for case in CASES {
        let values = case.values();
        let multiplier = |sign: f64, u: f64| {
            let at = case.at(u).with(Symbol::C, libm::sqrt(of(&case.at(u), Symbol::c_2)));
            let at = at.clone().with(Symbol::k, number(&stated::IMPACT_FACTOR, &at));
            let trace = number(&stated::PAIR_TRACE, &at);
            1.0 - sign * trace + number(&stated::PAIR_DETERMINANT, &at)
        };
        // Without loss sin(Theta) is 0, and k C infinite.
        if case.0 < 0.99 {
            assert_close(multiplier(1.0, of(&values, Symbol::u_fold)), 0.0, ROUNDING);
            assert_close(multiplier(-1.0, of(&values, Symbol::u_c)), 0.0, ROUNDING);
        }
        // The check value has six digits.
        assert_close(of(&values, Symbol::beta_c), 1.68148, 0.5e-5);
        assert_close(of(&values, Symbol::beta_c), 1.0 + of(&values, Symbol::u_c), ROUNDING);
    }
}

/// The sides of a fixed point are (18) at rest, with (14), (15) and the first harmonic put in; turned by
/// the absorber's phase they are the two that are linear in `beta`.
#[test]
fn the_sides_of_a_fixed_point_are_the_paper_s_rates() {
    for case in CASES {
        for u in [-0.7, -0.2, 0.15, 0.9] {
            let at = case.at(u);
            let c = libm::sqrt(of(&at, Symbol::c_2));
            let [sine, cosine] =
                [number(&fixed_points::SINE_SIDE, &at), number(&fixed_points::COSINE_SIDE, &at)];
            let (e, theta) = (8.0 / (PI * PI) * (1.0 + u), of(&at, Symbol::Theta));
            let Case(_, lambda, sigma, _) = case;
            assert_close(sine / c, lambda * c + e * libm::sin(theta), 1e-13);
            assert_close(cosine / c, e * libm::cos(theta) - 2.0 * sigma * c, 1e-13);
            let along = (cosine * libm::cos(theta) + sine * libm::sin(theta)) / c;
            let across = (sine * libm::cos(theta) - cosine * libm::sin(theta)) / c;
            assert_close(number(&fixed_points::ALONG, &at), along, 1e-13);
            assert_close(number(&fixed_points::ACROSS, &at), across, 1e-13);
        }
    }
}

/// The two conditions, multiplied by C, squared and added by hand, are a quartic in beta; it is
/// `c_2` times the quadratic, coefficient by coefficient, with the quadratic as PHYSICS writes it.
#[test]
fn squaring_the_two_conditions_gives_the_manifold_times_the_quadratic() {
    for case in CASES {
        let hand = Hand::of(case);
        let (quadratic, square) = (quadratic(case), hand.square());
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
        let (hand, found) = (Hand::of(case), of(&case.values(), Symbol::gamma_SN));
        let Case(r, lambda, sigma, _) = case;
        let (rho, s) = ((1.0 - r) / (1.0 + r), sigma * sigma + 0.25 * lambda * lambda);
        let [_, linear, square] = quadratic(case);
        let expected = 8.0 * (rho * s / PI + lambda / (PI * PI)) / square.sqrt();
        assert_close(found, expected, ROUNDING);
        let beta = -linear / (2.0 * square);
        assert_close(of(&case.values(), Symbol::beta_SN), beta, ROUNDING);
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
        let [_, _, square] = quadratic(Case(1.0, 0.0, sigma, 1.0));
        let expected = 4.0 * distance * distance;
        // sigma itself is rounded at 6e-17.
        assert!((square / expected - 1.0).abs() < 1e-15 / distance, "{square} {expected}");
    }
}

#[test]
fn a_root_of_the_condition_is_a_rest_point_of_the_paper_s_equations() {
    for case in CASES.into_iter().take(3) {
        for step in -6..=12 {
            let u = 0.1 * f64::from(step) + 0.03;
            let point = case.at(u);
            let (forcing, eta) = (forcing(&point), phase(&point));
            let values = Case(case.0, case.1, case.2, forcing).at(u);
            let values = values.with(Symbol::B, 1.0 + u).with(Symbol::G, forcing);
            let values = values.with(Symbol::eta, eta);
            let c = libm::sqrt(of(&values, Symbol::c_2));
            let values = completed(values.with(Symbol::C, c));
            // Rates are differences of terms of order 10, divided by C of order 0.1.
            assert_close(number(&stated::AMPLITUDE_RATE, &values), 0.0, 1e-13);
            assert_close(number(&stated::PHASE_RATE, &values), 0.0, 1e-13);
            for rate in [
                number(&slow_flow::SQUARE_RATE, &values),
                number(&slow_flow::RATIO_RATE, &values),
                number(&slow_flow::PHASE_RATE, &values),
            ] {
                assert_close(rate, 0.0, 1e-12);
            }
            // All forms of the condition have it.
            let squared = forcing * forcing;
            assert_close(number(&fixed_points::FORCING_SQUARED, &values), squared, 1e-12);
            assert_close(number(&fixed_points::FORCING_FROM_NODE, &values), squared, 1e-12);
            // At the collision rounding may leave no real root.
            let met = of(&values, Symbol::beta_SN);
            let [smaller, larger] =
                [Symbol::beta_1, Symbol::beta_2].map(|root| values.get(root).unwrap_or(met));
            let nearer = (smaller - 1.0 - u).abs().min((larger - 1.0 - u).abs());
            // Near the collision half of the digits are lost in the root.
            assert_close(nearer, 0.0, 1e-7);
            assert_close(smaller * larger, number(&fixed_points::RATIO_PRODUCT, &values), 1e-12);
        }
    }
}

/// Away from rest the derived flow is the stated one: `d c_2 = 2 C dC`, and the same rate of the phase.
#[test]
fn the_slow_flow_is_the_paper_s() {
    for case in CASES {
        for (u, eta) in [(-0.6, 0.3), (0.2, -2.0), (0.9, 2.5)] {
            let point = case.at(u).with(Symbol::eta, eta).with(Symbol::B, 1.0 + u);
            let c = libm::sqrt(of(&point, Symbol::c_2));
            let point = point.with(Symbol::C, c).with(Symbol::G, case.3);
            let point = completed(point);
            let square_rate = number(&slow_flow::SQUARE_RATE, &point);
            assert_close(square_rate, 2.0 * c * number(&stated::AMPLITUDE_RATE, &point), 1e-13);
            let phase_rate = number(&slow_flow::PHASE_RATE, &point);
            assert_close(phase_rate, number(&stated::PHASE_RATE, &point), 1e-13);
            // Along the manifold.
            let step = 1e-6;
            let square = |u| manifold::MANIFOLD_SQUARE.at([of(&point, Symbol::R), u]);
            let slope = (square(u + step) - square(u - step)) / (2.0 * step);
            let expected = square_rate / slope;
            assert_close(number(&slow_flow::RATIO_RATE, &point), expected, 1e-8);
        }
    }
}

#[test]
fn the_frequency_response_solves_the_same_condition() {
    for case in CASES {
        for u in [-0.4, 0.1, 0.7] {
            let point = case.at(u);
            let by_detuning =
                [Symbol::f_0, Symbol::f_1, Symbol::f_2].map(|symbol| of(&point, symbol));
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
        let values = case.values();
        let by_detuning = [Symbol::s_0, Symbol::s_1, Symbol::s_2, Symbol::s_3, Symbol::s_4];
        let by_detuning = by_detuning.map(|symbol| of(&values, symbol));
        let (square, collision) = (of(&values, Symbol::p_2), of(&values, Symbol::gamma_SN));
        let expected = square * (collision - case.3) * (collision + case.3);
        // Terms up to sigma^4.
        assert_close(horner(&by_detuning, case.2), expected, 1e-12);
    }
}

#[test]
fn boundaries_are_fixed_points_at_the_special_points() {
    for case in CASES.into_iter().take(3) {
        let values = case.values();
        let special = [(Symbol::u_fold, Symbol::gamma_H), (Symbol::u_c, Symbol::gamma_c)];
        for (shift, found) in special.map(|pair| (of(&values, pair.0), of(&values, pair.1))) {
            let expected = Hand::of(case).forcing_squared(1.0 + shift).sqrt();
            assert_close(found, expected, 1e-12);
            assert_close(found, forcing(&case.at(shift)), ROUNDING);
        }
    }
}

#[test]
fn boundaries_reach_their_limits() {
    // r = 1: C = 0 at the fold, and only the absorber's own first harmonic, 8/pi^2, is left.
    let elastic = Case(1.0, 1.8, -0.7, 1.0).values();
    assert_close(of(&elastic, Symbol::gamma_H), 8.0 / (PI * PI), ROUNDING);
    assert_close(of(&elastic, Symbol::sigma_P1), -4.0 / (PI * PI), ROUNDING);
    // No damping: sine and cosine sides at the fold, by hand.
    let undamped = Case(0.6, 0.0, 0.3, 1.0);
    let expected = Hand::of(undamped).forcing_squared(1.0 / (1.0 + Hand::of(undamped).curvature));
    assert_close(of(&undamped.values(), Symbol::gamma_H), expected.sqrt(), 1e-13);
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
        let found = of(&case.values(), Symbol::sigma_P1);
        // By hand 1 - beta, as small as R, is a difference: for r = 0.999999 R is 1e-13.
        let tolerance = if hand.curvature < 1e-6 { 1e-2 } else { 1e-12 };
        assert_close(found, expected, tolerance);
        // There the saddle-node is at the fold itself.
        let there = Case(case.0, case.1, found, case.3).values();
        assert_close(of(&there, Symbol::beta_SN), beta, 1e-12);
        assert_close(of(&there, Symbol::gamma_SN), of(&there, Symbol::gamma_H), 1e-12);
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
            cavity: Cavity::IDEAL,
        });
        completed(equations::values_of(&system.expect("a physical system")))
    }
}

#[test]
fn table_1_has_its_meeting_point_where_an_independent_program_found_it() {
    let table = TableOne::new();
    let values = table.at(8.0);
    let meeting = of(&values, Symbol::sigma_P1);
    let there = number(&fixed_points::HOPF, &values.with(Symbol::sigma, meeting));
    // Half a unit of the last printed digit.
    assert!((meeting - -0.70958).abs() < 0.5e-5, "{meeting}");
    assert!((there - 1.11876).abs() < 0.5e-5, "{there}");
    let frequency = table.frequency * (1.0 + table.mass_ratio * meeting);
    assert!((frequency - 8.3036).abs() < 0.5e-4, "{frequency}");
}

#[test]
fn table_1_has_its_boundaries_where_an_independent_program_found_them() {
    let table = TableOne::new();
    let reduced_forcing = 0.25 / table.mass_ratio;
    for (frequency, expected) in [(8.0, [4.687, 15.346, 16.259]), (8.5, [6.443, 26.496, 34.913])] {
        let values = table.at(frequency);
        let found = [Symbol::gamma_c, Symbol::gamma_H, Symbol::gamma_SN];
        for (found, expected) in found.map(|symbol| of(&values, symbol)).into_iter().zip(expected) {
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
            let point = case.at(u);
            let (gamma, eta) = (forcing(&point), phase(&point));
            let rates = |u: f64, eta: f64| {
                let at = Case(case.0, case.1, case.2, gamma).at(u).with(Symbol::eta, eta);
                let square_rate = number(&slow_flow::SQUARE_RATE, &at);
                let at = at.with(Symbol::D1_c_2, square_rate);
                [number(&slow_flow::RATIO_RATE, &at), number(&slow_flow::PHASE_RATE, &at)]
            };
            let step = 1e-5;
            let slope = |row: usize, [du, deta]: [f64; 2]| {
                let sides = [rates(u + du, eta + deta), rates(u - du, eta - deta)];
                (sides[0][row] - sides[1][row]) / (2.0 * step)
            };
            let by = [[step, 0.0], [0.0, step]];
            let [[a, b], [c, d]] = [0, 1].map(|row| by.map(|by| slope(row, by)));
            let [_, linear, square] = quadratic(case);
            let root = square * (1.0 + u) + 0.5 * linear;
            let at = point.with(Symbol::Delta, root * root);
            let trace = number(&slow_flow::TRACE, &at);
            let larger = number(&slow_flow::DETERMINANT, &at);
            // step^2 of third derivatives of order 1000, and 1e-15 / step: below 1e-6.
            assert_close(trace, a + d, 1e-6);
            assert_close(larger * root.signum(), a * d - b * c, 1e-5);
        }
    }
}

#[test]
fn values_of_a_system_hold_the_paper_s_short_hands() {
    let values = TableOne::new().at(8.0);
    assert_close(of(&values, Symbol::rho), 0.25, ROUNDING);
    assert_close(of(&values, Symbol::lambda), 1.7990, 0.5e-4);
    let error = manifold::MANIFOLD_SQUARE.equation.right().evaluate(&values);
    let error = error.expect_err("no point was chosen");
    assert_eq!(error.symbol, Symbol::u);
}

#[test]
fn the_main_formulas_read_as_on_paper() {
    let formulas = [
        (
            stated::MOTION_OF_BASE.equation,
            r"\ddot{x} + \varepsilon \lambda \dot{x} + x = \varepsilon G \sin \left(\Omega \tau\right) + \varepsilon^{2} \lambda \Omega G \cos \left(\Omega \tau\right)",
        ),
        (stated::IMPACT_POSITION.equation, r"C \cos \Theta = b - B"),
        (
            stated::IMPACT_VELOCITIES.equation,
            r"\left(1 + r\right) C \sin \Theta = \frac{2}{\pi} \left(1 - r\right) B",
        ),
        (
            stated::AMPLITUDE_RATE.equation,
            r"\mathrm{D}_1 C = -\frac{\lambda C}{2} - \frac{E \sin \Theta}{2} + \frac{G \sin \eta}{2}",
        ),
        (
            stated::PHASE_RATE.equation,
            r"\mathrm{D}_1 \eta = \frac{G \cos \eta}{2 C} - \frac{E \cos \Theta}{2 C} + \sigma",
        ),
        (manifold::MANIFOLD.equation, r"C^{2} = \left(1 + R\right) B^{2} - 2 b B + b^{2}"),
        (manifold::MANIFOLD_SQUARE.equation, r"c_2 = u^{2} + R \left(1 + u\right)^{2}"),
        (manifold::FOLD_SHIFT.equation, r"u_{\mathrm{fold}} = -\frac{R}{1 + R}"),
        (manifold::BREAKING_RATIO.equation, r"\beta_c = \frac{\pi^{2}}{\pi^{2} - 4}"),
        (
            fixed_points::ALONG.equation,
            r"\gamma \cos \left(\eta - \Theta\right) = \frac{2}{\pi} \lambda \rho \beta + \frac{8}{\pi^{2}} \beta + 2 \sigma u",
        ),
        (
            fixed_points::ACROSS.equation,
            r"\gamma \sin \left(\eta - \Theta\right) = \frac{4}{\pi} \rho \sigma \beta - \lambda u",
        ),
        (fixed_points::CONSTANT.equation, r"p_0 = \lambda^{2} + 4 \sigma^{2}"),
        (
            fixed_points::LINEAR.equation,
            r"p_1 = -2 \lambda^{2} - 8 \sigma^{2} - \frac{32}{\pi^{2}} \sigma",
        ),
        (
            fixed_points::SQUARE.equation,
            r"p_2 = \left(\frac{2}{\pi} \lambda \rho + \frac{8}{\pi^{2}} + 2 \sigma\right)^{2} + \left(\frac{4}{\pi} \rho \sigma - \lambda\right)^{2}",
        ),
        (
            fixed_points::NODE_FORCING.equation,
            r"\gamma_{\mathrm{SN}} = \frac{n_0 + n_2 \sigma^{2}}{\sqrt{p_2}}",
        ),
        (fixed_points::NODE_RATIO.equation, r"\beta_{\mathrm{SN}} = -\frac{p_1}{2 p_2}"),
        (
            slow_flow::TRACE.equation,
            r"\mathrm{tr} J = -\lambda - \frac{16 \rho \beta}{\pi^{3} \left(u + R \beta\right)}",
        ),
        (
            slow_flow::DETERMINANT.equation,
            r"\det J = \frac{\sqrt{\Delta}}{4 \left(u + R \beta\right)}",
        ),
        (
            fixed_points::MEETING_DETUNING.equation,
            r"\sigma_{\mathrm{P1}} = \frac{2 \left(2 + \pi \lambda \rho\right)}{\pi^{2} \left(R - 1\right)}",
        ),
    ];
    for (found, expected) in formulas {
        assert_eq!(found.to_latex(), expected);
    }
}

#[test]
fn every_formula_of_the_report_converts_with_and_without_numbers() {
    let values = CASES[0].at(0.2).with(Symbol::eta, 0.3);
    for excitation in [Excitation::BaseDisplacement, Excitation::Force] {
        let groups: Vec<_> =
            equations::groups(excitation).chain(equations::groups_beyond()).collect();
        let list = groups.iter().flat_map(|group| group.equations);
        assert!(list.clone().count() > 40);
        for equation in list {
            for latex in [equation.to_latex(), equation.to_latex_with(&values, 4)] {
                if let Err(error) = to_mathml(&latex) {
                    panic!("{latex}: {error}");
                }
                // Hosts of Markdown refuse formulas with this macro.
                assert!(!latex.contains("operatorname"), "{latex}");
            }
        }
        assert!(groups.iter().all(|group| !group.gives.is_empty()));
        for number in ["(1)", "(2)", "(7)", "(14)", "(15)", "(16)", "(18)"] {
            assert!(groups.iter().any(|group| group.source.contains(number)), "{number}");
        }
    }
}

/// The numbers of an analysis are the values of the printed formulas, bit by bit.
#[test]
fn what_the_report_prints_is_what_is_evaluated() {
    let system = System::new(Parameters {
        mass_ratio: 0.01,
        damping: 1.8,
        restitution: 0.6,
        frequency_ratio: 0.993,
        forcing_per_clearance: 3.0,
        excitation: Excitation::BaseDisplacement,
        cavity: Cavity::IDEAL,
    });
    let system = system.expect("valid");
    let analysis = vinesink::analysis::Analysis::of(&system).expect("analysable");
    let point = analysis.fixed_points.last().expect("one");
    let given = equations::values_of(&system).with(Symbol::b, 1.0);
    let values =
        completed(given.with(Symbol::u, point.shift).with(Symbol::beta, point.absorber_amplitude));
    let pairs = [
        (Symbol::rho, analysis.manifold.restitution_ratio),
        (Symbol::R, analysis.manifold.curvature),
        (Symbol::C_fold, analysis.manifold.fold.oscillator_amplitude),
        (Symbol::beta_c, analysis.manifold.symmetry_breaking.absorber_amplitude),
        (Symbol::gamma_H, analysis.boundaries.hopf),
        (Symbol::gamma_c, analysis.boundaries.symmetry_breaking),
        (Symbol::sigma_P1, analysis.boundaries.codimension_two.detuning),
        (Symbol::beta_2, point.absorber_amplitude),
        (Symbol::Theta, point.absorber_phase),
        (Symbol::tr_J, point.trace),
    ];
    for (symbol, evaluated) in pairs {
        assert_eq!(of(&values, symbol), evaluated, "{symbol}");
    }
    let text = fixed_points::SQUARE.equation.to_latex_with(&CASES[0].values(), 4);
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
            cavity: Cavity::IDEAL,
        };
        let system = System::new(parameters).expect("valid");
        let motion = match kind {
            Excitation::BaseDisplacement => stated::MOTION_OF_BASE.equation,
            Excitation::Force => stated::MOTION_BY_FORCE.equation,
        };
        let phase = 0.4;
        let flight = Oscillator::alone(&system).motion(0.3, -0.8, phase);
        for s in [0.0, 0.7, 2.9] {
            let at = flight.at(s);
            let values = equations::values_of(&system)
                .with(Symbol::G, system.forcing_per_clearance())
                .with(Symbol::tau, phase / system.frequency_ratio() + s)
                .with(Symbol::x, at.x)
                .with(Symbol::x_dot, at.v)
                .with(Symbol::x_dot_dot, flight.acceleration(s, at));
            let residual = difference(&motion, &values);
            // Terms of order one, some ten roundings.
            assert!(residual.abs() < 2e-15, "{kind:?} {s} {residual}");
        }
        let (before, after) = ([0.9, -0.4], rebound(0.03, 0.7, 0.9, -0.4));
        let values = equations::values_of(&system)
            .with(Symbol::w_dot_before, before[0] - before[1])
            .with(Symbol::w_dot_after, after.x_velocity - after.y_velocity);
        let residual = residual(&stated::RESTITUTION, &values);
        assert!(residual.abs() < 1e-15, "{residual}");
    }
}
