//! The equations of exact symmetric orbits: derived expressions against the orbits computed without
//! them, against limits derived by hand, and against the theory of first order in the mass ratio.

mod common;

use common::table_1;
use proptest::prelude::*;
use vinesink::equations::{Motion, OrbitPrograms, equations};
use vinesink::orbits::flight::Flight;
use vinesink::orbits::symmetric::SymmetricCurve;
use vinesink::orbits::{ImpactMap, Wall, symmetric_orbits};
use vinesink::symbolic::Symbol::{
    AbsorberAmplitude, AmplitudeRatio, Clearance, Damping, DisplacementCoefficient, GapChange,
    ImpactDisplacement, ImpactPhase, ImpulseResponse, ImpulseResponseRate, LinearGain,
    ManifoldCurvature, MassRatio, Period, ReducedForcing, RepeatedDisplacement, RepeatedVelocity,
    Restitution, RestitutionRatio, SteadyDisplacement, SteadyVelocity, VelocityCoefficient,
    VelocityRatioAfter, WDotBefore, XDotAfter, XDotBefore, YDotAfter,
};
use vinesink::symbolic::{Expr, Symbol, Values, to_mathml};
use vinesink::system::{Excitation, Parameters, System};

fn programs() -> &'static OrbitPrograms {
    &equations().programs.orbits
}

fn number(expression: &Expr, values: &Values) -> f64 {
    expression.evaluate(values).expect("all symbols have values")
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
    })
    .expect("a physical system")
}

/// All that the orbits of a system share, in clearances.
fn curve_of(system: &System) -> Values {
    let free = Flight::of(system).expect("steady").free(0.5 * system.period());
    let values = equations()
        .programs
        .values(system)
        .with(Clearance, 1.0)
        .with(ReducedForcing, system.forcing_per_clearance())
        .with(ImpulseResponse, free.impulse)
        .with(ImpulseResponseRate, free.impulse_rate);
    programs().curve(&values, system.excitation()).expect("set")
}

/// Relative error that rounding of `g` and `g'` leaves in `q`: both stand beside 1, and near
/// resonance the sums `1 + g'` are small.
fn rounding(values: &Values) -> f64 {
    let rate = 1.0 + of(values, ImpulseResponseRate);
    let damping = of(values, MassRatio) * of(values, Damping);
    let keep = rate + damping * of(values, ImpulseResponse);
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
            };
            System::new(parameters).expect("a physical system")
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

    /// The derivation says what the closed form of the orbits says.
    #[test]
    fn the_derived_curve_is_the_one_of_the_orbits(system in systems()) {
        let values = curve_of(&system);
        let flight = Flight::of(&system).expect("steady");
        let curve = SymmetricCurve::of(&system).expect("steady");
        let tolerance = rounding(&values);
        prop_assert!(tolerance < 1e-8);
        let [q1, q2] = flight.repeated_impulse();
        let size = q1.abs().max(q2.abs());
        assert_near(of(&values, RepeatedDisplacement), q1, tolerance * size, "q_1");
        assert_near(of(&values, RepeatedVelocity), q2, tolerance * size, "q_2");
        let size = 1.0 + 8.0 * system.mass_ratio() * size / system.period();
        let (a, d) = (curve.displacement, curve.velocity);
        assert_near(of(&values, DisplacementCoefficient), a, tolerance * size, "A");
        assert_near(of(&values, VelocityCoefficient), d, tolerance * size, "D");
        assert_near(of(&values, VelocityRatioAfter), curve.rebound, 1e-15, "v_+");
        assert_near(of(&values, LinearGain), curve.gain, 1e-14 * curve.gain, "chi");
        assert_near(of(&values, Period), 2.0 * curve.half_period, 1e-14 * curve.half_period, "T");

        let turning = programs().turning(&values).expect("set");
        let (scale, relative) = (a.abs() + d.abs(), tolerance * size / (a.abs() + d.abs()));
        assert_near(turning.ratio, curve.turning(), 8.0 * relative / scale, "turning");
        let least = curve.forcing(curve.turning());
        assert_near(turning.forcing_per_clearance, least, 8.0 * relative / curve.gain, "gamma_SN");

        for beta in [0.2, 1.0, 1.7, 5.0] {
            let at = values.clone().with(AmplitudeRatio, beta);
            let found = libm::sqrt(programs().forcing_squared(&at).expect("set"));
            let slack = tolerance * (1.0 + beta * (size + scale)) / curve.gain;
            assert_near(found, curve.forcing(beta), 4.0 * slack, "gamma");
        }
    }

    /// On the orbits themselves: both roots, the velocities around an impact, and its phase.
    #[test]
    fn the_derived_orbits_are_the_orbits(system in systems()) {
        let values = curve_of(&system);
        let (map, curve) = (ImpactMap::of(&system), SymmetricCurve::of(&system));
        let (map, curve) = (map.expect("steady"), curve.expect("steady"));
        let ratios = programs().ratios(&values).expect("set");
        let found = symmetric_orbits(&system).expect("steady");
        let linear = of(&values, LinearGain) * system.forcing_per_clearance();
        let scale = libm::hypot(curve.displacement, curve.velocity);
        let discriminant = linear * linear * scale * scale - curve.velocity * curve.velocity;
        // Two orbits that nearly meet lose half of the digits, and are left out.
        prop_assume!(discriminant.abs() > 1e-3 * scale * scale);
        let tolerance = 1e2 * rounding(&values) * (1.0 + linear) * (1.0 + 1.0 / scale);
        let mut expected = ratios.map_or(Vec::new(), |pair| pair.to_vec());
        expected.retain(|beta| *beta > tolerance);
        prop_assert_eq!(found.len(), expected.len());
        for (orbit, beta) in found.iter().zip(expected) {
            assert_near(beta, orbit.absorber_amplitude, tolerance * (1.0 + beta), "beta");
            let at = programs().at_ratio(&values, orbit.absorber_amplitude).expect("set");
            let after = curve.after_impact(&map.flight, orbit.absorber_amplitude);
            let size = 1.0 + orbit.absorber_amplitude;
            assert_near(of(&at, ImpactDisplacement), after.x, 1e-14 * size, "x_0");
            assert_near(of(&at, XDotAfter), after.x_velocity, 1e-14 * size, "x'+");
            assert_near(of(&at, YDotAfter), after.y_velocity, 1e-14 * size, "y'+");
            let momentum = of(&at, XDotBefore) - of(&at, XDotAfter);
            assert_near(momentum, orbit.impulse, 1e-14 * size, "impulse");
            assert_near(of(&at, WDotBefore), orbit.impact_speed, 1e-14 * size, "w'-");
            // The phase is as good as the steady motion at the impact over its amplitude.
            let turned = libm::sin(0.5 * (of(&at, ImpactPhase) - after.phase));
            assert_near(turned.abs(), 0.0, tolerance * size / linear, "phi");
            let steady = map.flight.steady_at(after.phase);
            assert_near(of(&at, SteadyDisplacement), steady.x, 4.0 * tolerance * size, "X");
            let velocity = of(&at, SteadyVelocity) / system.frequency_ratio();
            let expected = steady.v / system.frequency_ratio();
            assert_near(velocity, expected, 4.0 * tolerance * size, "X'");
            for condition in conditions() {
                let size = tolerance * size * (1.0 + linear) * (1.0 + of(&at, YDotAfter));
                assert_near(number(&condition, &at), 0.0, size, &condition.to_latex());
            }
        }
    }
}

/// Everything that is stated of an orbit, as expressions that vanish on it.
fn conditions() -> Vec<Expr> {
    let c = &equations().orbits.conditions;
    let single = [&c.period, &c.amplitude, &c.contact, &c.flight, &c.arrival];
    let impact = [&c.momentum, &c.restitution];
    let all = single.into_iter().chain(impact).chain(&c.propagation).chain(&c.repetition);
    all.map(|equation| equation.residual()).collect()
}

/// Table 1 at 8 Hz, `b` = 7.5 mm: the check value of the displacement at an impact, from the
/// expressions alone once `g` and `g'` are known.
#[test]
fn the_check_value_of_table_1_follows_from_the_expressions() {
    let values = curve_of(&table_1(8.0, 7.5)).with(Clearance, 7.5);
    let [_, larger] = programs().ratios(&values).expect("set").expect("two orbits");
    let at = programs().at_ratio(&values, larger).expect("set");
    assert_near(of(&at, ImpactDisplacement), -3.110, 0.5e-3, "x_0 in mm");
    assert_near(of(&at, AbsorberAmplitude), 10.610, 0.5e-3, "B in mm");
}

#[test]
fn the_formulas_read_as_on_paper() {
    let o = &equations().orbits;
    let formulas = [
        (&o.speed, r"\frac{4 B}{T}"),
        (&o.velocity_after, r"\frac{1 - 2 \varepsilon r - r}{1 + r}"),
        (&o.velocity_before, r"\frac{1 + 2 \varepsilon - r}{1 + r}"),
        (&o.displacement_coefficient, r"1 - \frac{8 \varepsilon q_1}{T}"),
        (
            &o.velocity_coefficient,
            r"-\frac{4 v_{+}}{\Omega T} - \frac{8 \varepsilon q_2}{\Omega T}",
        ),
        (&o.by_ratio[0], r"1 - \gamma^{2} \chi^{2}"),
        (&o.by_ratio[1], "-2 A"),
        (&o.by_ratio[2], "A^{2} + D^{2}"),
        (&o.discriminant, r"\gamma^{2} \chi^{2} \left(A^{2} + D^{2}\right) - D^{2}"),
        (&o.turning_ratio, r"\frac{A}{A^{2} + D^{2}}"),
        (&o.turning_forcing, r"\frac{\sqrt{\frac{D^{2}}{A^{2} + D^{2}}}}{\chi}"),
        (&o.flight_change, r"-\frac{\mathrm{d}w}{\dot{w}^{-}}"),
    ];
    for (found, expected) in formulas {
        assert_eq!(found.to_latex(), expected);
    }
}

/// `|Phi| = exp(-eps lambda T/2)`, and the product of the multipliers is what is stated.
#[test]
fn the_determinant_is_that_of_the_half_period_map() {
    let determinant = &equations().orbits.conditions.determinant.right;
    for (frequency, clearance) in [(8.0, 7.5), (8.0, 15.0), (8.5, 20.0), (9.0, 5.0)] {
        let system = table_1(frequency, clearance);
        let map = ImpactMap::of(&system).expect("damped");
        let values = curve_of(&system);
        let found = number(determinant, &values);
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
    let values = programs().at_ratio(&curve_of(&system), orbit.absorber_amplitude).expect("set");
    let (start, duration) = (orbit.orbit.cycle.impacts[0], orbit.orbit.cycle.durations[0]);
    let gap = |change: f64, duration: f64| {
        let start =
            vinesink::orbits::AfterImpact { x_velocity: start.x_velocity + change, ..start };
        map.step(&start, Wall::Plus, Wall::Minus, duration).gap
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
    let change = &equations().orbits.flight_change;
    let expected = number(change, &values.with(GapChange, widened));
    // h^2 times a third derivative of order 10.
    assert_near(found, expected, 1e-6, "d tau");
    assert!(expected.abs() > 0.01);
}

/// Without a light absorber's reaction the orbits are the slow invariant manifold (16): `A = 1`,
/// `D = -(2/pi) rho`, at any frequency; and elastic impacts then have `D = 0`.
#[test]
fn a_massless_absorber_leaves_the_manifold() {
    let (stated, manifold, o) = (&equations().stated, &equations().manifold, &equations().orbits);
    let massless = |expression: &Expr| expression.substitute(MassRatio, 0);
    let displacement = massless(&o.displacement_coefficient);
    assert_eq!(displacement, Expr::ONE);
    let velocity = massless(&o.velocity_coefficient)
        .substitute(Period, &o.conditions.period.right)
        .substitute(VelocityRatioAfter, massless(&o.velocity_after));
    let by_hand = -2 * &stated.restitution_ratio.right / Symbol::Pi;
    assert!((&velocity - by_hand).vanishes(), "{}", velocity.to_latex());
    assert!(velocity.substitute(Restitution, 1).vanishes());
    let square = (&o.forcing_squared * LinearGain.squared())
        .substitute(DisplacementCoefficient, displacement)
        .substitute(VelocityCoefficient, velocity);
    let expected = manifold
        .ratio_square
        .substitute(ManifoldCurvature, &stated.curvature.right)
        .substitute(RestitutionRatio, &stated.restitution_ratio.right);
    assert!((square - expected).vanishes());
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
                let [_, linear, quadratic] = programs().coefficients(&values).expect("set");
                let manifold = 1.0 + of(&values, ManifoldCurvature);
                [(quadratic - manifold).abs(), (linear + 2.0).abs()]
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
                let at = curve_of(&system).with(AmplitudeRatio, beta);
                let exact = programs().forcing_squared(&at).expect("set");
                let slow = equations().programs.at_shift(&at, beta - 1.0).expect("set");
                let slow = equations().fixed_points.forcing_squared.evaluate(&slow).expect("set");
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
    let list = equations().for_report();
    let exact: Vec<_> =
        list.iter().filter(|equation| equation.motion == Motion::SymmetricOrbit).collect();
    assert!(exact.len() > 30, "{}", exact.len());
    let system_at_rest = table_1(8.0, 30.0);
    assert!(symmetric_orbits(&system_at_rest).expect("damped").is_empty());
    let orbit = symmetric_orbits(&table_1(8.0, 15.0)).expect("damped").pop().expect("exists");
    let with_orbit = programs().at_ratio(&curve_of(&table_1(8.0, 15.0)), orbit.absorber_amplitude);
    let undamped = equations().programs.values(&system(0.01, 0.0, 0.6, 1.0, 1.0));
    let mut complete = 0;
    for equation in exact {
        for values in [&with_orbit.clone().expect("set"), &curve_of(&system_at_rest), &undamped] {
            let numbers = equation.to_latex_with(values, 4);
            if let Err(error) = to_mathml(&numbers) {
                panic!("{}: {numbers}: {error}", equation.title);
            }
            assert!(!numbers.contains("undefined"), "{}: {numbers}", equation.title);
            assert!(!numbers.ends_with("= 1 = 1.000"), "{numbers}");
        }
        let has_value = equation.right.evaluate(&with_orbit.clone().expect("set")).is_ok();
        complete += usize::from(has_value);
        assert!(has_value || equation.right.contains(&GapChange.into()), "{}", equation.title);
    }
    assert!(complete > 30);
    let ratios = list.iter().filter(|equation| equation.left.starts_with(r"\beta_{1}"));
    for equation in ratios.filter(|equation| equation.motion == Motion::SymmetricOrbit) {
        assert!(equation.to_latex_with(&curve_of(&system_at_rest), 4).contains(r"\Delta"));
    }
}
