//! The equations of exact symmetric orbits: what is evaluated against what is stated, against limits derived
//! by hand, and against the theory of first order in the mass ratio.

use crate::common::table_1;
use proptest::prelude::*;
use vinesink::equations::{self, fixed_points};
use vinesink::orbits::equations as formulas;
use vinesink::orbits::flight::OrbitFlight;
use vinesink::orbits::{ImpactMap, SymmetricCurve, SymmetricOrbit, Wall, symmetric_orbits};
use vinesink::report::mathml::to_mathml;
use vinesink::symbolic::{Equation, Expr, Formula, Symbol, Values};
use vinesink::system::{Cavity, Excitation, Parameters, System};

/// Left less right: what vanishes where the equation holds.
fn residual(equation: &Equation, values: &Values) -> f64 {
    let [left, right] = [equation.left(), equation.right()]
        .map(|side| side.evaluate(values).expect("all symbols have values"));
    left - right
}

fn number<const N: usize>(formula: &Formula<N>, values: &Values) -> f64 {
    formula.at(formula.parameters.map(|symbol| values.require(symbol).expect("a value")))
}

fn of(values: &Values, symbol: Symbol) -> f64 {
    values.require(symbol).expect("set")
}

fn system(eps: f64, damping: f64, restitution: f64, frequency_ratio: f64, forcing: f64) -> System {
    System::new(Parameters {
        mass_ratio: eps,
        damping,
        restitution,
        frequency_ratio,
        forcing_per_clearance: forcing,
        excitation: Excitation::BaseDisplacement,
        cavity: Cavity::IDEAL,
    })
    .expect("a physical system")
}

/// All that the orbits of a system share, in clearances.
fn given(system: &System) -> Values {
    let [g, h] = OrbitFlight::of(system).expect("steady").half_period_response();
    equations::values_of(system)
        .with(Symbol::b, 1.0)
        .with(Symbol::G, system.forcing_per_clearance())
        .with(Symbol::g, g)
        .with(Symbol::h, h)
}

fn curve_of(system: &System) -> Values {
    given(system).completed(formulas::groups(system.excitation()))
}

/// The same on an orbit.
fn at_orbit(system: &System, orbit: &SymmetricOrbit) -> Values {
    let on_orbit = given(system)
        .with(Symbol::beta, orbit.absorber_amplitude)
        .with(Symbol::B, orbit.absorber_amplitude)
        .with(Symbol::x_0, 1.0 - orbit.absorber_amplitude);
    on_orbit.completed(formulas::groups(system.excitation()))
}

/// Relative error that rounding of `g` and `g'` leaves in `q`: both stand beside 1, and near
/// resonance the sums `1 + g'` are small.
fn rounding(values: &Values) -> f64 {
    let rate = of(values, Symbol::h);
    let keep = rate + 2.0 * of(values, Symbol::d) * of(values, Symbol::g);
    2e-14 + 2e-15 / rate.min(keep).max(1e-300)
}

fn assert_near(found: f64, expected: f64, tolerance: f64, what: &str) {
    let error = (found - expected).abs();
    assert!(error <= tolerance, "{what}: {found} is not {expected} within {tolerance:.1e}");
}

fn systems() -> impl Strategy<Value = System> {
    let frequency = prop_oneof![0.3..0.999, 1.001..3.0];
    let kind = prop_oneof![Just(Excitation::BaseDisplacement), Just(Excitation::Force)];
    (1e-3..0.5f64, 0.0..6.0f64, 0.0..=1.0f64, frequency, 0.01..30.0f64, kind).prop_map(
        |(mass_ratio, damping, restitution, frequency_ratio, forcing_per_clearance, excitation)| {
            let parameters = Parameters {
                mass_ratio,
                damping,
                restitution,
                frequency_ratio,
                forcing_per_clearance,
                excitation,
                cavity: Cavity::IDEAL,
            };
            System::new(parameters).expect("a physical system")
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

    /// The free response over half a period is that of the propagator, and what a repeated impulse
    /// leaves inverts it: `(Phi + I) q = (0, 1)`.
    #[test]
    fn the_repeated_impulse_inverts_the_propagator(system in systems()) {
        let flight = OrbitFlight::of(&system).expect("steady");
        let free = flight.free(0.5 * system.period());
        let [g, h] = flight.half_period_response();
        assert_near(g, free[(0, 1)], 1e-14, "g");
        assert_near(h, 1.0 + free[(1, 1)], 1e-14, "1 + g'");
        let values = curve_of(&system);
        let size = of(&values, Symbol::q_1).abs().max(of(&values, Symbol::q_2).abs());
        for condition in [formulas::REPEATED_FIRST.equation, formulas::REPEATED_SECOND.equation] {
            let residual = residual(&condition, &values);
            assert_near(residual, 0.0, 1e-15 * (1.0 + 8.0 * size), &condition.to_latex());
        }
    }

    /// The coefficients that orbits compute with are the values of the printed formulas, bit by bit, and
    /// the steady motion is the system's.
    #[test]
    fn the_printed_curve_is_the_one_of_the_orbits(system in systems()) {
        let values = curve_of(&system);
        let curve = SymmetricCurve::of(&system).expect("steady");
        let flight = OrbitFlight::of(&system).expect("steady");
        let (q, steady) = (flight.repeated_impulse(), flight.steady());
        let pairs = [
            (Symbol::A, curve.displacement),
            (Symbol::D, curve.velocity),
            (Symbol::v_after, curve.rebound),
            (Symbol::chi, curve.gain),
            (Symbol::T, 2.0 * curve.half_period),
            (Symbol::beta_SN, curve.turning()),
            (Symbol::gamma_SN, curve.forcing(curve.turning())),
            (Symbol::X_s, steady[0]),
            (Symbol::X_c, steady[1]),
        ];
        for (symbol, evaluated) in pairs {
            prop_assert_eq!(of(&values, symbol), evaluated, "{}", symbol);
        }
        // The decay rate is rounded once more in one of the two.
        assert_near(of(&values, Symbol::q_1), q[0], 1e-15 * q[0].abs(), "q_1");
        assert_near(of(&values, Symbol::q_2), q[1], 1e-15 * q[1].abs(), "q_2");
        let amplitude = libm::hypot(steady[0], steady[1]);
        let expected = curve.gain * system.forcing_per_clearance();
        assert_near(amplitude, expected, 1e-14 * expected, "chi");
    }

    /// The quadratic's roots, the least forcing, and the forcing of an amplitude, against one another.
    #[test]
    fn the_saddle_node_has_the_least_forcing(system in systems()) {
        let values = curve_of(&system);
        let curve = SymmetricCurve::of(&system).expect("steady");
        let (a, d) = (curve.displacement, curve.velocity);
        // D^2/(A^2 + D^2), by hand, at the turning point.
        let least = libm::sqrt(d * d / (a * a + d * d)) / curve.gain;
        // 1 - A beta, up to 1, is a difference there.
        assert_near(of(&values, Symbol::gamma_SN), least, 4e-15 / curve.gain, "gamma_SN");
        for beta in [0.2, 1.0, 1.7, 5.0] {
            prop_assert!(curve.forcing(beta) >= least - 4e-15 / curve.gain);
        }
    }

    /// On the orbits themselves: both roots, the velocities around an impact, and its phase; and all that
    /// is stated holds there, in the motion of the impact map.
    #[test]
    fn the_orbits_satisfy_what_is_stated(system in systems()) {
        let values = curve_of(&system);
        let (map, curve) = (ImpactMap::of(&system), SymmetricCurve::of(&system));
        let (map, curve) = (map.expect("steady"), curve.expect("steady"));
        let found = symmetric_orbits(&system).expect("steady");
        let linear = of(&values, Symbol::chi) * system.forcing_per_clearance();
        let scale = libm::hypot(curve.displacement, curve.velocity);
        let discriminant = linear * linear * scale * scale - curve.velocity * curve.velocity;
        // Two orbits that nearly meet lose half of the digits, and are left out.
        prop_assume!(discriminant.abs() > 1e-3 * scale * scale);
        let tolerance = 1e2 * rounding(&values) * (1.0 + linear) * (1.0 + 1.0 / scale);
        let mut expected = [Symbol::beta_1, Symbol::beta_2].map(|root| values.get(root)).to_vec();
        expected.retain(|beta| beta.is_some_and(|beta| beta > tolerance));
        prop_assert_eq!(found.len(), expected.len());
        for (orbit, beta) in found.iter().zip(expected) {
            assert_near(beta.unwrap_or(f64::NAN), orbit.absorber_amplitude, tolerance * (1.0 + orbit.absorber_amplitude), "beta");
            let at = at_orbit(&system, orbit);
            let after = orbit.orbit.cycle.impacts[0];
            let size = 1.0 + orbit.absorber_amplitude;
            assert_near(of(&at, Symbol::x_0), after.x, 1e-14 * size, "x_0");
            assert_near(of(&at, Symbol::x_dot_after), after.x_velocity, 1e-14 * size, "x'+");
            assert_near(of(&at, Symbol::y_dot_after), after.y_velocity, 1e-14 * size, "y'+");
            let momentum = of(&at, Symbol::x_dot_before) - of(&at, Symbol::x_dot_after);
            assert_near(momentum, orbit.impulse, 1e-14 * size, "impulse");
            assert_near(of(&at, Symbol::w_dot_before), orbit.impact_speed, 1e-14 * size, "w'-");
            let turned = libm::sin(0.5 * (of(&at, Symbol::phi) - after.phase));
            assert_near(turned.abs(), 0.0, 1e-14, "phi");
            // The phase is as good as the steady motion at the impact over its amplitude.
            let steady = map.flight.steady_at(after.phase);
            assert_near(of(&at, Symbol::X), steady.x, 4.0 * tolerance * size, "X");
            let expected = steady.y / system.frequency_ratio();
            assert_near(of(&at, Symbol::V), expected, 4.0 * tolerance * size, "V");
            let stated = [formulas::CONDITIONS, formulas::CURVE, formulas::ORBITS];
            for equation in stated.into_iter().flatten().flat_map(|group| group.equations) {
                // Roots that are another orbit's, and a derivative: not conditions of this one.
                if matches!(equation.left(), Expr::Symbol(_)) || equation.left_text.contains("beta_1") {
                    continue;
                }
                let size = tolerance * size * (1.0 + linear) * (1.0 + of(&at, Symbol::y_dot_after));
                let residual = residual(equation, &at);
                assert_near(residual, 0.0, size, &equation.to_latex());
            }
        }
    }
}

/// Table 1 at 8 Hz, `b` = 7.5 mm: the check value of the displacement at an impact, from the
/// expressions alone once `g` and `g'` are known.
#[test]
fn the_check_value_of_table_1_follows_from_the_expressions() {
    let larger = of(&curve_of(&table_1(8.0, 7.5)), Symbol::beta_2);
    assert_near(7.5 * (1.0 - larger), -3.110, 0.5e-3, "x_0 in mm");
    assert_near(7.5 * larger, 10.610, 0.5e-3, "B in mm");
}

#[test]
fn the_formulas_read_as_on_paper() {
    let read = [
        (formulas::SPEED.equation, r"\dot{y}^{+} = \frac{4 B}{T}"),
        (formulas::VELOCITY_RATIO_AFTER.equation, r"v_{+} = \frac{1 - r - 2 \varepsilon r}{1 + r}"),
        (formulas::VELOCITY_RATIO_BEFORE.equation, r"v_{-} = \frac{1 - r + 2 \varepsilon}{1 + r}"),
        (formulas::DISPLACEMENT_LOSS.equation, r"A = 1 - \frac{8 \varepsilon q_1}{T}"),
        (
            formulas::VELOCITY_LOSS.equation,
            r"D = -\frac{4 \left(v_{+} + 2 \varepsilon q_2\right)}{\Omega T}",
        ),
        (
            formulas::CONDITION.equation,
            r"\left(1 - A \beta\right)^{2} + \left(D \beta\right)^{2} = L_2",
        ),
        (formulas::DISCRIMINANT.equation, r"\Delta = \left(A^{2} + D^{2}\right) L_2 - D^{2}"),
        (formulas::TURNING_RATIO.equation, r"\beta_{\mathrm{SN}} = \frac{A}{A^{2} + D^{2}}"),
        (formulas::FLIGHT_CHANGE.equation, r"\mathrm{d}\tau = -\frac{\mathrm{d}w}{\dot{w}^{-}}"),
    ];
    for (found, expected) in read {
        assert_eq!(found.to_latex(), expected);
    }
}

/// `|Phi| = exp(-eps lambda T/2)`, and the product of the multipliers is what is stated.
#[test]
fn the_determinant_is_that_of_the_half_period_map() {
    for (frequency, clearance) in [(8.0, 7.5), (8.0, 15.0), (8.5, 20.0), (9.0, 5.0)] {
        let system = table_1(frequency, clearance);
        let map = ImpactMap::of(&system).expect("damped");
        let values = curve_of(&system);
        let found = number(&formulas::DETERMINANT, &values);
        let (r, damping) = (system.restitution(), system.mass_ratio() * system.damping());
        let shrinkage = r * r * libm::exp(-0.5 * damping * system.period());
        assert_near(found, shrinkage, 1e-14, "Abel's identity");
        for orbit in symmetric_orbits(&system).expect("damped") {
            let jacobian = orbit.orbit.cycle.jacobian(&map);
            let size = libm::pow(jacobian.amax(), 2.0);
            assert_near(jacobian.determinant(), found, 1e-12 * size, "Jacobian");
        }
    }
}

/// `d tau = -dw / w'-` against the flight of a displaced start, timed by bisection.
#[test]
fn a_flight_gets_longer_by_what_is_stated() {
    let system = table_1(8.0, 15.0);
    let map = ImpactMap::of(&system).expect("damped");
    let orbit = symmetric_orbits(&system).expect("damped").pop().expect("exists");
    let values = at_orbit(&system, &orbit);
    let (start, duration) = (orbit.orbit.cycle.impacts[0], orbit.orbit.cycle.durations[0]);
    let gap = |change: f64, duration: f64| {
        let start =
            vinesink::orbits::AfterImpact { x_velocity: start.x_velocity + change, ..start };
        map.step(&start, Wall::Minus, duration).gap
    };
    let ends = |change: f64| {
        let (mut low, mut high) = (duration - 0.1, duration + 0.1);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            // The absorber approaches the wall at -b: the gap falls.
            if gap(change, middle) > 0.0 { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    };
    let h = 1e-4;
    let found = (ends(h) - ends(-h)) / (2.0 * h);
    // Met mirrored: at the wall -b the relative velocity is -w'-.
    let widened = -(gap(h, duration) - gap(-h, duration)) / (2.0 * h);
    let expected = number(&formulas::FLIGHT_CHANGE, &values.with(Symbol::dw, widened));
    // h^2 times a third derivative of order 10.
    assert_near(found, expected, 1e-6, "d tau");
    assert!(expected.abs() > 0.01);
}

/// Without a light absorber's reaction the orbits are the slow invariant manifold (16): `A = 1`,
/// `D = -(2/pi) rho`, at any frequency; and elastic impacts then have `D = 0`.
#[test]
fn a_massless_absorber_leaves_the_manifold() {
    for (omega, r) in [(0.7, 0.0), (1.0, 0.3), (1.3, 0.6), (2.0, 1.0)] {
        let period = formulas::PERIOD.at([omega]);
        let rebound = formulas::VELOCITY_RATIO_AFTER.at([0.0, r]);
        let a = formulas::DISPLACEMENT_LOSS.at([0.0, period, 7.0]);
        let d = formulas::VELOCITY_LOSS.at([0.0, omega, period, 7.0, rebound]);
        let rho = (1.0 - r) / (1.0 + r);
        assert_eq!(a, 1.0);
        assert_near(d, -2.0 * rho / std::f64::consts::PI, 1e-15, "D");
        for beta in [0.3, 1.0, 2.2] {
            let forcing = formulas::FORCING.at([beta, 1.0, a, d]);
            let curvature = equations::stated::CURVATURE.at([rho]);
            let expected = equations::manifold::MANIFOLD_SQUARE.at([curvature, beta - 1.0]);
            assert_near(forcing * forcing, expected, 1e-14, "c_2");
        }
    }
}

/// Orders with which three errors, at `eps`, `eps/4` and `eps/16`, fall.
fn orders(errors: [f64; 3]) -> [f64; 2] {
    [errors[0] / errors[1], errors[1] / errors[2]].map(|ratio| libm::log(ratio) / libm::log(4.0))
}

/// `A^2 + D^2` tends to `1 + R` at first order while the oscillator's own motion is kept: away from
/// resonance, and at resonance if `eps lambda` is.
#[test]
fn the_curvature_of_the_orbits_tends_to_that_of_the_manifold_at_first_order() {
    for (frequency, own_damping) in [(0.8, 0.02), (1.3, 0.02), (2.0, 0.3), (1.0, 0.1), (1.0, 0.5)] {
        for r in [0.3, 0.6, 0.9] {
            let error = |eps: f64| {
                let values = curve_of(&system(eps, own_damping / eps, r, frequency, 1.0));
                let (a, d) = (of(&values, Symbol::A), of(&values, Symbol::D));
                let rho = (1.0 - r) / (1.0 + r);
                let manifold = 1.0 + equations::stated::CURVATURE.at([rho]);
                [(a * a + d * d - manifold).abs(), (-2.0 * a + 2.0).abs()]
            };
            let errors = [2e-4, 5e-5, 1.25e-5].map(error);
            for part in [0, 1] {
                for order in orders(errors.map(|error| error[part])) {
                    assert!((order - 1.0).abs() < 0.05, "{frequency} {r}: order {order}");
                }
            }
        }
    }
}

/// With `lambda` and `sigma` kept, the scaling of the slow flow, `A` and `D` do not tend to the
/// manifold's: the absorber's reaction is as large as what else acts near resonance. The forcing of
/// an orbit tends, at first order, to the forcing of the fixed point of (18) with its amplitude.
#[test]
fn the_forcing_of_an_orbit_tends_to_that_of_the_fixed_point_at_first_order() {
    for (r, damping, detuning) in [(0.6, 1.8, -0.7), (0.3, 0.4, 2.5), (0.9, 5.0, -6.0)] {
        for beta in [0.4, 0.9, 1.2, 1.9] {
            let error = |eps: f64| {
                let system = system(eps, damping, r, 1.0 + eps * detuning, 1.0);
                let system = system.with_detuning(detuning).expect("valid");
                let curve = SymmetricCurve::of(&system).expect("steady");
                let exact = curve.forcing(beta) * curve.forcing(beta);
                let slow = equations::values_of(&system).with(Symbol::beta, beta);
                let slow = slow.completed(equations::groups(system.excitation()));
                let slow = number(&fixed_points::FORCING_SQUARED, &slow);
                (exact / slow - 1.0).abs()
            };
            let errors = [1e-3, 2.5e-4, 6.25e-5].map(error);
            for order in orders(errors) {
                assert!((order - 1.0).abs() < 0.1, "{r} {beta}: order {order}, {errors:?}");
            }
        }
    }
}

/// Formulas render with the numbers of an orbit, without an orbit, and without a steady motion; and
/// no number is printed that is none.
#[test]
fn the_report_s_formulas_render_whatever_has_a_value() {
    let exact: Vec<_> =
        formulas::groups(Excitation::BaseDisplacement).flat_map(|group| group.equations).collect();
    assert!(exact.len() > 30, "{}", exact.len());
    let system_at_rest = table_1(8.0, 30.0);
    assert!(symmetric_orbits(&system_at_rest).expect("damped").is_empty());
    let at_rest = curve_of(&system_at_rest);
    let system_with_orbit = table_1(8.0, 15.0);
    let orbit = symmetric_orbits(&system_with_orbit).expect("damped").pop().expect("exists");
    let with_orbit = at_orbit(&system_with_orbit, &orbit);
    let undamped = equations::values_of(&system(0.01, 0.0, 0.6, 1.0, 1.0));
    let undamped = undamped.completed(formulas::groups(Excitation::BaseDisplacement));
    let mut complete = 0;
    for equation in exact {
        for values in [&with_orbit, &at_rest, &undamped] {
            let numbers = equation.to_latex_with(values, 4);
            if let Err(error) = to_mathml(&numbers) {
                panic!("{numbers}: {error}");
            }
            assert!(!numbers.contains("undefined"), "{numbers}");
            assert!(!numbers.ends_with("= 1 = 1.000"), "{numbers}");
        }
        let has_value = equation.right().evaluate(&with_orbit).is_ok();
        complete += usize::from(has_value);
        assert!(has_value || equation.right_text.contains("dw"), "{equation:?}");
    }
    assert!(complete > 30);
    for ratio in [formulas::SMALLER_RATIO.equation, formulas::LARGER_RATIO.equation] {
        assert!(ratio.to_latex_with(&at_rest, 4).contains(r"\Delta"));
    }
}
