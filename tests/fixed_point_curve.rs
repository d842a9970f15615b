//! The closed quadratic of fixed points against their certified solution.

use proptest::prelude::*;

use vinesink::analysis::{Analysis, FixedPointCurve};
use vinesink::system::{Excitation, Parameters, System};

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    /// Boundaries, fixed points and areas by the formula are those of the certified solution; next to
    /// a boundary rounding may decide.
    #[test]
    fn the_quadratic_is_the_theory(
        damping in 0.0..6.0_f64,
        restitution in 0.0..1.0_f64,
        detuning in -12.0..12.0_f64,
        gamma in 0.01..30.0_f64,
    ) {
        let base = System::new(Parameters {
            mass_ratio: 0.008,
            damping,
            restitution,
            frequency_ratio: 1.0,
            forcing_per_clearance: gamma,
            excitation: Excitation::BaseDisplacement,
        }).expect("valid");
        let system = base.with_detuning(detuning).expect("valid");
        let theory = Analysis::of(&system).expect("moderate numbers");
        let curve = FixedPointCurve::of(&system, &theory.manifold);
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-9 * a.abs().max(b.abs()).max(1e-3);
        prop_assert!(near(curve.hopf(), theory.boundaries.hopf));
        prop_assert!(near(curve.symmetry_breaking(), theory.boundaries.symmetry_breaking));
        let collision = curve.collision().filter(|(gamma, _)| *gamma > 1e-6);
        let certified = theory.boundaries.saddle_nodes.first();
        prop_assert_eq!(collision.is_some(), certified.is_some_and(|node| node.forcing_over_clearance > 1e-6));
        if let (Some((gamma, beta)), Some(node)) = (collision, certified) {
            prop_assert!(near(gamma, node.forcing_over_clearance), "{gamma} {node:?}");
            prop_assert!((beta - node.absorber).abs() <= 1e-6 * beta, "{beta} {node:?}");
        }
        for point in &theory.fixed_points {
            let squared = curve.forcing_squared(point.absorber);
            let scale = 4.0 * (detuning * detuning + damping * damping) + gamma * gamma + 1.0;
            prop_assert!((squared - gamma * gamma).abs() <= 1e-9 * scale * (1.0 + point.absorber * point.absorber));
        }
        let at_boundary = theory.boundaries.all().any(|(_, other)| (gamma - other).abs() < 1e-9 * gamma);
        prop_assert!(at_boundary || curve.zone(gamma) == theory.zone, "{:?} {:?}", curve.zone(gamma), theory.zone);
    }
}
