//! The symbolic layer against algebra's laws, difference quotients, and formulas written by hand.

use proptest::prelude::*;
use vinesink::symbolic::Symbol::{
    AbsorberAmplitude as B, Clearance as b, Damping as lambda, ExcitationPhase as eta, FastTime,
    FrequencyRatio as Omega, ManifoldCurvature as R, Pi as pi, Restitution as r, XDot,
};
use vinesink::symbolic::{
    AlgebraError, Compiled, Expr, Rational, Symbol, Values, cos, eliminate_angle, format_number,
    fraction, sin, sqrt, to_mathml,
};

/// Doubles carry 16 digits; a few hundred operations on numbers of order 10^4 keep 9 of them.
const ROUNDING: f64 = 1e-9;

fn values(numbers: [f64; 4]) -> Values {
    [lambda, R, b, B].into_iter().zip(numbers).fold(Values::new(), |all, (s, n)| all.with(s, n))
}

fn value(expression: &Expr, at: &Values) -> f64 {
    expression.evaluate(at).expect("all symbols have values")
}

fn close(left: f64, right: f64, scale: f64) -> bool {
    (left - right).abs() <= ROUNDING * scale.abs().max(1.0)
}

/// Polynomials in four symbols with small coefficients.
fn polynomials() -> impl Strategy<Value = Expr> {
    polynomials_of_depth(4)
}

/// Polynomials of degree 4 at most: Euclid's algorithm squares coefficients at every step, and
/// common factors of higher degree can leave the range of exact numbers.
fn short_polynomials() -> impl Strategy<Value = Expr> {
    polynomials_of_depth(2)
}

fn polynomials_of_depth(depth: u32) -> impl Strategy<Value = Expr> {
    let leaf = prop_oneof![
        (-3..4, 1..4).prop_map(|(above, below)| fraction(above, below)),
        prop::sample::select(vec![lambda, R, b, B]).prop_map(Expr::from),
    ];
    leaf.prop_recursive(depth, 6 * depth, 3, |inner| {
        prop_oneof![
            (inner.clone(), inner.clone()).prop_map(|(x, y)| x + y),
            (inner.clone(), inner.clone()).prop_map(|(x, y)| x - y),
            (inner.clone(), inner.clone()).prop_map(|(x, y)| x * y),
            inner.prop_map(|x| x.squared()),
        ]
    })
}

/// The same, with quotients, roots and angles whose arguments are harmless.
fn expressions() -> impl Strategy<Value = Expr> {
    (polynomials(), polynomials(), polynomials())
        .prop_map(|(x, y, z)| sin(&x) * sqrt(1 + y.squared()) / (2 + z.squared()) + cos(x * &y) * z)
}

fn numbers() -> impl Strategy<Value = [f64; 4]> {
    [0.2..1.5, 0.2..1.5, 0.2..1.5, 0.2..1.5_f64]
}

/// The sum of the absolute values of all monomials bounds what rounding can do.
fn scale(expression: &Expr, at: &Values) -> f64 {
    match expression.expand() {
        Expr::Sum(terms) => terms.iter().map(|term| value(term, at).abs()).sum(),
        term => value(&term, at),
    }
}

proptest! {
    #[test]
    fn operators_do_what_they_say(x in polynomials(), y in polynomials(), n in numbers()) {
        let at = values(n);
        let (u, v) = (value(&x, &at), value(&y, &at));
        let size = scale(&x, &at).abs() + scale(&y, &at).abs();
        prop_assert!(close(value(&(&x + &y), &at), u + v, size));
        prop_assert!(close(value(&(&x - &y), &at), u - v, size));
        prop_assert!(close(value(&(&x * &y), &at), u * v, size * size));
        prop_assert!(close(value(&-&x, &at), -u, size));
    }

    #[test]
    fn expanding_keeps_the_value_and_shows_equality(x in polynomials(), y in polynomials(), n in numbers()) {
        let at = values(n);
        prop_assert!(close(value(&x.expand(), &at), value(&x, &at), scale(&x, &at)));
        let difference = (&x + &y).squared() - x.squared() - 2 * &x * &y - y.squared();
        prop_assert_eq!(difference.expand(), Expr::ZERO);
        prop_assert_eq!(((&x + &y) * B).expand(), (&x * B + &y * B).expand());
    }

    #[test]
    fn collected_coefficients_rebuild_the_polynomial(x in polynomials()) {
        let coefficients = x.collect(B).expect("a polynomial");
        let rebuilt = coefficients.iter().enumerate().fold(Expr::ZERO, |sum, (power, coefficient)| {
            prop_assert_no_variable(coefficient);
            sum + coefficient * B.power(power as i32)
        });
        prop_assert!((rebuilt - &x).vanishes());
        prop_assert!(coefficients.last().is_none_or(|last| !last.vanishes()));
        prop_assert_eq!(x.descending_in(B).expect("a polynomial").expand(), x.expand());
    }

    #[test]
    fn derivatives_are_limits_of_difference_quotients(x in expressions(), n in numbers()) {
        let derivative = x.differentiate(B);
        // Central differences err by step^2/6 of the third derivative: compare two steps, so that
        // the estimate brings its own error along.
        let difference = |step: f64| {
            let [l, c, d, a] = n;
            let side = |sign: f64| value(&x, &values([l, c, d, a + sign * step]));
            (side(1.0) - side(-1.0)) / (2.0 * step)
        };
        let (coarse, fine) = (difference(2e-4), difference(1e-4));
        let size = value(&x, &values(n)).abs().max(fine.abs());
        let error = (coarse - fine).abs() + 1e-8 * size.max(1.0);
        prop_assert!((value(&derivative, &values(n)) - fine).abs() <= error);
    }

    #[test]
    fn programs_give_the_bits_of_the_expression(x in expressions(), n in numbers()) {
        let at = values(n);
        let [compiled] = Compiled::new([&x]).evaluate(&at).expect("all symbols have values");
        prop_assert_eq!(compiled.to_bits(), value(&x, &at).to_bits());
    }

    #[test]
    fn cancelling_removes_a_common_factor(x in short_polynomials(), y in polynomials_of_depth(1), n in numbers()) {
        let factor = 1 + R + Omega;
        let below = 2 + y.squared();
        let quotient = (&x * &factor).expand() / (&below * &factor).expand();
        let cancelled = quotient.cancel();
        prop_assert!((&cancelled - &x / &below).vanishes());
        prop_assert!(!cancelled.contains(&Omega.into()));
        let at = values(n);
        let size = scale(&x, &at).max(1.0);
        prop_assert!(close(value(&cancelled, &at), value(&x, &at) / value(&below, &at), size * size));
    }

    #[test]
    fn every_expression_converts_to_mathml(x in expressions(), n in numbers()) {
        prop_assert!(to_mathml(&x.to_latex()).is_ok());
        prop_assert!(to_mathml(&x.to_latex_with(&values(n), 4)).is_ok());
    }

    #[test]
    fn rationals_obey_the_laws_of_fractions(a in -50..50_i32, c in 1..50_i32, d in -50..50_i32, e in 1..50_i32) {
        let (x, y) = (Rational::new(a.into(), c.into()), Rational::new(d.into(), e.into()));
        prop_assert_eq!(x + y, y + x);
        prop_assert_eq!((x + y) * x, x * x + y * x);
        prop_assert_eq!(x + -x, Rational::ZERO);
        if !x.is_zero() {
            prop_assert_eq!(x * x.reciprocal(), Rational::ONE);
        }
    }
}

fn prop_assert_no_variable(coefficient: &Expr) {
    assert!(!coefficient.contains(&B.into()), "{}", coefficient.to_latex());
}

#[test]
fn like_terms_and_factors_merge() {
    assert_eq!(b + B - b, B.into());
    assert_eq!(1 - (1 + B.squared()), -B.squared());
    assert_eq!(B * b * B, b * B.squared());
    assert_eq!(sqrt(B) * sqrt(B), B.into());
    assert_eq!(sqrt(B).power(3), B * sqrt(B));
    assert_eq!((B * b).power(-2) * B.power(3) * b.squared(), B.into());
    assert_eq!(Expr::ZERO * sin(eta), Expr::ZERO);
    assert_eq!(fraction(6, -4), fraction(-3, 2));
}

#[test]
fn linear_equations_are_solved_in_lowest_terms() {
    let equation = (1 + r).squared() * (4 * B + pi.squared() * (b - B));
    let solution = equation.solve_linear(B).expect("degree 1").cancel();
    assert_eq!(solution.to_latex(), r"\frac{\pi^{2} b}{\pi^{2} - 4}");
    let under_the_line = (1 - r) / B - 2;
    assert_eq!(under_the_line.solve_linear(B), Ok((1 - r) / 2));
    assert_eq!((lambda * sin(eta) - b).solve_linear(sin(eta)), Ok(b / Expr::from(lambda)));
}

#[test]
fn what_cannot_be_solved_says_why() {
    let quadratic = B.squared() - 1;
    let error = quadratic.solve_linear(B).expect_err("degree 2");
    assert_eq!(
        error.to_string(),
        "`B^{2} - 1` has degree 2 in `B`; only degree 1 can be solved for"
    );
    let error = (1 / Expr::from(B)).collect(B).expect_err("not a polynomial");
    assert!(matches!(error, AlgebraError::NotPolynomial { .. }));
    assert!(sin(B).solve_linear(B).is_err());
}

#[test]
fn a_missing_value_is_named() {
    let error = (B + lambda).evaluate(&Values::new().with(B, 1.0)).expect_err("no lambda");
    assert_eq!(error.symbol, lambda);
    assert!(error.to_string().contains("lambda"), "{error}");
    let compiled = Compiled::new([&(B * lambda)]);
    assert_eq!(compiled.evaluate(&Values::new().with(B, 1.0)), Err(error));
}

#[test]
fn an_angle_is_eliminated_by_its_sine_and_cosine() {
    let sum = eliminate_angle(&(B * sin(eta)), &(b * cos(eta)), &B.into());
    let at = |angle: f64| values([1.0, 1.0, 0.7, 0.7]).with(eta, angle);
    // With b = B the condition holds for every angle; one rounding of a number near 1.
    assert!((-10..10).all(|n| value(&sum, &at(f64::from(n))).abs() < 1e-15));
}

#[test]
fn shared_operations_are_done_once() {
    let shared = sin(B * b + 1);
    let program = Compiled::new([&(&shared * 2), &(&shared * lambda)]);
    // B, b, b B, 1, sum, sine, 2, product, lambda, product.
    assert_eq!(program.operations(), 10);
}

#[test]
fn substitution_finds_sums_and_multiples_of_a_power() {
    assert_eq!((B.power(4) + B.power(-2)).substitute(B.squared(), b), b.squared() + b.power(-1));
    assert_eq!((3 * (1 - B) * b).substitute(1 - B, -lambda), -3 * lambda * b);
    assert_eq!(B.power(3).substitute(B.squared(), b), B.power(3));
}

#[test]
fn latex_is_readable() {
    let cases = [
        ((b - B) / -2, r"-\frac{1}{2} \left(b - B\right)"),
        (fraction(2, 3) * B.squared() / pi, r"\frac{2}{3 \pi} B^{2}"),
        (1 / (2 * sqrt(1 + R)), r"\frac{1}{2 \sqrt{1 + R}}"),
        (sin(eta).squared() * XDot, r"\dot{x} \sin^{2} \eta"),
        (cos(Omega * FastTime) - 1, r"\cos \left(\Omega \tau\right) - 1"),
        ((1 - r) * (1 + r).power(-2), r"\frac{1 - r}{\left(1 + r\right)^{2}}"),
        (b - fraction(3, 2), r"b - \frac{3}{2}"),
    ];
    for (expression, latex) in cases {
        assert_eq!(expression.to_latex(), latex);
    }
}

#[test]
fn numbers_in_formulas_are_unambiguous() {
    let at = values([-0.5, 1.25e-7, 2.0, 3.0]);
    let cases = [
        (2 * lambda * b, r"2 \left(-0.500\right) \cdot 2.00"),
        (lambda.squared(), r"\left(-0.500\right)^{2}"),
        (R.squared(), r"\left(1.25\times 10^{-7}\right)^{2}"),
        (-lambda, r"-\left(-0.500\right)"),
        (B + lambda, r"3.00 - 0.500"),
        (B * sqrt(b), r"\sqrt{2.00} \cdot 3.00"),
        (B * Omega, r"3.00 \Omega"),
    ];
    for (expression, latex) in cases {
        assert_eq!(expression.to_latex_with(&at, 3), latex);
    }
}

#[test]
fn numbers_have_the_digits_that_were_asked_for() {
    let cases = [
        (0.0, "0"),
        (0.00123456, "0.001235"),
        (9.99996, "10.00"),
        (-0.70958, "-0.7096"),
        (123_456.0, "123456"),
        (1_234_567.0, r"1.235\times 10^{6}"),
        (1.2e-3, "0.001200"),
        (f64::NAN, r"\text{undefined}"),
        (f64::NEG_INFINITY, r"-\infty"),
    ];
    for (number, text) in cases {
        assert_eq!(format_number(number, 4), text);
        assert!(to_mathml(&format_number(number, 4)).is_ok());
    }
}

#[test]
fn every_symbol_converts_and_has_its_own_name() {
    let mut names: Vec<&str> = Symbol::ALL.iter().map(|symbol| symbol.entry().name).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), Symbol::COUNT);
    for symbol in Symbol::ALL {
        let entry = symbol.entry();
        assert!(to_mathml(entry.latex).is_ok(), "{symbol}");
        assert!(!entry.description.is_empty() && !entry.unit.is_empty(), "{symbol}");
    }
}

#[test]
fn mathml_is_a_display_element_and_errors_are_told() {
    let mathml = to_mathml(r"\frac{1}{2} B").expect("a formula");
    assert!(mathml.starts_with(r#"<math display="block""#), "{mathml}");
    assert_eq!(mathml, to_mathml(r"\frac{1}{2} B").expect("a formula"));
    let error = to_mathml(r"\nosuchcommand").expect_err("unknown");
    assert!(error.to_string().contains("nosuchcommand"));
}
