//! The symbolic layer: what is read from the text of a formula is the compiled formula, bit by bit, and
//! what is printed is readable.

use proptest::prelude::*;
use vinesink::report::mathml::to_mathml;
use vinesink::symbolic::{
    Equation, Expr, Formula, Group, Symbol, Values, format_number, operations,
};

const B: Symbol = Symbol::B;

fn values(numbers: [f64; 4]) -> Values {
    let symbols = [Symbol::lambda, Symbol::R, Symbol::b, B];
    symbols.into_iter().zip(numbers).fold(Values::default(), |all, (s, n)| all.with(s, n))
}

fn value(text: &str, at: &Values) -> f64 {
    Expr::parse(text).evaluate(at).expect("all symbols have values")
}

/// Text of an expression in four symbols whose roots and angles are harmless.
fn expressions() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        (0..40_i32).prop_map(|n| format!("{:?}", f64::from(n) / 4.0)),
        prop::sample::select(vec!["lambda", "R", "b", "B", "PI"]).prop_map(String::from),
    ];
    leaf.prop_recursive(4, 24, 3, |inner| {
        prop_oneof![
            (inner.clone(), inner.clone()).prop_map(|(x, y)| format!("{x} + {y}")),
            (inner.clone(), inner.clone()).prop_map(|(x, y)| format!("({x}) - ({y})")),
            (inner.clone(), inner.clone()).prop_map(|(x, y)| format!("({x}) * ({y})")),
            (inner.clone(), inner.clone())
                .prop_map(|(x, y)| format!("({x}) / (2.0 + square({y}))")),
            (inner.clone(), inner.clone()).prop_map(|(x, y)| format!("atan2({x}, {y})")),
            inner.clone().prop_map(|x| format!("-({x})")),
            inner.clone().prop_map(|x| format!("sqrt(1.0 + square({x})) * cube(sin({x}))")),
            inner.prop_map(|x| format!("cos({x})")),
        ]
    })
}

proptest! {
    #[test]
    fn every_expression_converts_to_mathml(x in expressions(), n in [-1.5..1.5, 0.2..1.5, 1e-9..1.5, 0.2..1e9_f64]) {
        let expr = Expr::parse(&x);
        for latex in [expr.to_latex(), expr.to_latex_with(&values(n), 4)] {
            prop_assert!(to_mathml(&latex).is_ok(), "{latex}");
            // Two signs never meet, and no number stands beside another without a sign between.
            prop_assert!(!latex.contains("- -") && !latex.contains("+ -") && !latex.contains("--"), "{latex}");
        }
    }

    /// The four operations by their rules of precedence, against the same in Rust.
    #[test]
    fn operations_are_read_in_the_order_of_rust([a, c, d, e] in [-9.0..9.0, -9.0..9.0, 0.1..9.0, -9.0..9.0_f64]) {
        let at = values([a, c, d, e]);
        let pairs = [
            ("lambda - R - b * B / R + B", a - c - d * e / c + e),
            ("-lambda * R - -b", -a * c + d),
            ("lambda / R / b * (R - B)", a / c / d * (c - e)),
            ("-(lambda + R) * sqrt(b) - 2.0 / square(B)", -(a + c) * d.sqrt() - 2.0 / (e * e)),
            ("atan2(lambda, R) * sin(B) + cos(-b)", libm::atan2(a, c) * libm::sin(e) + libm::cos(-d)),
        ];
        for (text, expected) in pairs {
            prop_assert_eq!(value(text, &at).to_bits(), expected.to_bits(), "{}", text);
        }
    }
}

/// Values for all symbols, each another one.
fn any_values(seed: f64) -> Values {
    let number = |k: usize| 0.3 + 0.7 * libm::fabs(libm::sin(seed + 1.7 * k as f64));
    let all = Symbol::ALL.iter().enumerate().filter(|(_, symbol)| **symbol != Symbol::PI);
    all.fold(Values::default(), |values, (k, symbol)| values.with(*symbol, number(k)))
}

fn same_bits<const N: usize>(formula: &Formula<N>) {
    for seed in 0..20 {
        let at = any_values(f64::from(seed));
        let compiled =
            formula.at(formula.parameters.map(|symbol| at.require(symbol).expect("a value")));
        let read = formula.equation.right().evaluate(&at).expect("all symbols have values");
        assert_eq!(compiled.to_bits(), read.to_bits(), "{:?}", formula.equation);
    }
}

/// What a page prints, evaluated as it is printed, has the bits of what analysis and orbits compute with.
#[test]
fn the_printed_formulas_are_the_compiled_ones() {
    use vinesink::equations::{
        dissipation as a, fixed_points as f, free_decay as d, manifold as m, slow_flow as s, stated,
    };
    use vinesink::orbits::equations as o;
    same_bits(&stated::RESTITUTION_RATIO);
    same_bits(&stated::CURVATURE);
    same_bits(&stated::AMPLITUDE_RATE);
    same_bits(&stated::PHASE_RATE);
    same_bits(&m::MANIFOLD_SQUARE);
    same_bits(&m::FOLD_OSCILLATOR);
    same_bits(&m::BREAKING_RATIO);
    same_bits(&m::STABLE_RATIO);
    same_bits(&f::SINE_SIDE);
    same_bits(&f::COSINE_SIDE);
    same_bits(&f::LINEAR);
    same_bits(&f::SQUARE);
    same_bits(&f::NODE_FORCING);
    same_bits(&f::DISCRIMINANT);
    same_bits(&f::LARGER_RATIO);
    same_bits(&f::RATIO_PRODUCT);
    same_bits(&f::NODE_DETUNING_0);
    same_bits(&f::NODE_DETUNING_2);
    same_bits(&f::HOPF);
    same_bits(&f::BREAKING);
    same_bits(&f::MEETING_DETUNING);
    same_bits(&s::SQUARE_RATE);
    same_bits(&s::PHASE_RATE);
    same_bits(&s::TRACE);
    same_bits(&d::ARCTANGENT);
    same_bits(&d::DECAY_TIME);
    same_bits(&d::IMPACT_ENERGY);
    same_bits(&a::RESISTANCE);
    same_bits(&a::RESPONSE_ROOT);
    same_bits(&a::DETERMINANT);
    same_bits(&o::REPEATED_VELOCITY);
    same_bits(&o::VELOCITY_LOSS);
    same_bits(&o::BASE_GAIN);
    same_bits(&o::DISCRIMINANT);
    same_bits(&o::FORCING);
    same_bits(&o::PHASE);
}

#[test]
fn a_missing_value_is_named() {
    let error = Expr::parse("B + lambda").evaluate(&Values::default().with(B, 1.0));
    let error = error.expect_err("no lambda");
    assert_eq!(error.symbol, Symbol::lambda);
    assert!(error.to_string().contains("lambda"), "{error}");
}

#[test]
fn what_is_no_expression_is_refused() {
    for text in ["", "B +", "(B", "nothing", "sin B", "B b", "2.0.0", "sin(B", "B % b"] {
        let read = std::panic::catch_unwind(|| Expr::parse(text));
        assert!(read.is_err(), "{text}: {read:?}");
    }
}

/// One for each sign and root, twenty for each sine, cosine and arctangent.
#[test]
fn operations_are_counted() {
    let cases = [
        ("B", 0),
        ("square(B) + R * (1.0 - B)", 4),
        ("sqrt(B) / cube(b)", 3),
        ("sin(B) * cos(eta)", 41),
        ("atan2(X_s, -X_c)", 21),
    ];
    for (text, expected) in cases {
        assert_eq!(operations(text), expected, "{text}");
    }
}

/// In reading order or not, what follows is found; what is known stays, and what is no number is left out.
#[test]
fn values_that_follow_are_completed() {
    const EQUATIONS: [Equation; 5] = [
        Equation { left_text: "B", right_text: "2.0 * b" },
        Equation { left_text: "b", right_text: "R + 1.0" },
        Equation { left_text: "R", right_text: "99.0" },
        Equation { left_text: "C", right_text: "sqrt(-R)" },
        Equation { left_text: "E + 1.0", right_text: "B" },
    ];
    const LIST: [&Equation; 5] =
        [&EQUATIONS[0], &EQUATIONS[1], &EQUATIONS[2], &EQUATIONS[3], &EQUATIONS[4]];
    let group = Group { title: "", gives: "", source: "", equations: &LIST };
    let found = Values::default().with(Symbol::R, 0.5).completed([&group]);
    assert_eq!((found.get(Symbol::R), found.get(B)), (Some(0.5), Some(3.0)));
    assert_eq!((found.get(Symbol::C), found.get(Symbol::E)), (None, None));
}

#[test]
fn latex_is_readable() {
    let cases = [
        ("-(b - B) / 2.0", r"-\frac{b - B}{2}"),
        ("(b - B) / 2.0", r"\frac{b - B}{2}"),
        ("2.0 / (3.0 * PI) * square(B)", r"\frac{2}{3 \pi} B^{2}"),
        ("1.0 / (2.0 * sqrt(1.0 + R))", r"\frac{1}{2 \sqrt{1 + R}}"),
        ("x_dot * square(sin(eta))", r"\dot{x} \sin^{2} \eta"),
        ("cos(Omega * tau) - 1.0", r"\cos \left(\Omega \tau\right) - 1"),
        ("(1.0 - r) / square(1.0 + r)", r"\frac{1 - r}{\left(1 + r\right)^{2}}"),
        ("b - 3.0 / 2.0", r"b - \frac{3}{2}"),
        ("b - (B + R)", r"b - \left(B + R\right)"),
        ("b + -R * B", "b - R B"),
        ("square(b / B)", r"\left(\frac{b}{B}\right)^{2}"),
        ("atan2(X_s, X_c)", r"\mathrm{atan2}\left(X_s, X_c\right)"),
    ];
    for (text, latex) in cases {
        assert_eq!(Expr::parse(text).to_latex(), latex);
    }
}

#[test]
fn numbers_in_formulas_are_unambiguous() {
    let at = values([-0.5, 1.25e-7, 2.0, 3.0]);
    let cases = [
        ("2.0 * lambda * b", r"2 \left(-0.500\right) \cdot 2.00"),
        ("square(lambda)", r"\left(-0.500\right)^{2}"),
        ("square(R)", r"\left(1.25\times 10^{-7}\right)^{2}"),
        ("-lambda", r"-\left(-0.500\right)"),
        ("-lambda / b", r"-\frac{-0.500}{2.00}"),
        ("lambda / b", r"-\frac{0.500}{2.00}"),
        ("B + lambda", r"3.00 - 0.500"),
        ("B - lambda", r"3.00 + 0.500"),
        ("sqrt(b) * B", r"\sqrt{2.00} \cdot 3.00"),
        ("B * Omega", r"3.00 \Omega"),
        ("B * (b / R)", r"3.00 \cdot \frac{2.00}{1.25\times 10^{-7}}"),
    ];
    for (text, latex) in cases {
        assert_eq!(Expr::parse(text).to_latex_with(&at, 3), latex);
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
    let mut names: Vec<&str> = Symbol::ALL.iter().map(|symbol| symbol.entry().latex).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), Symbol::ALL.len());
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
