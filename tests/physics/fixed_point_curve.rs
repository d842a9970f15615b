//! The closed quadratic of fixed points against the two conditions of (18), written out and squared by
//! hand, on random systems and at the ends of every range.

use crate::common;
use std::f64::consts::PI;

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use vinesink::analysis::{Analysis, FixedPoint, ManifoldBranch, Strip, boundaries};
use vinesink::analysis::{Area, FixedPointCurve};
use vinesink::bifurcation::Bifurcation;
use vinesink::system::{Cavity, Excitation, Parameters, System};

/// Amplitudes at which the conditions are evaluated; denser where the manifold turns.
const SCAN: u32 = 20_000;
const LARGEST: f64 = 50.0;
/// Some dozen operations, over the sum of the terms' sizes.
const ROUNDING: f64 = 1e-13;

/// `(lambda c2 + k beta^2)^2 + (m beta (1 - beta) - 2 sigma c2)^2 = gamma^2 c2`.
#[derive(Debug, Clone, Copy)]
struct Hand {
    damping: f64,
    detuning: f64,
    gamma: f64,
    rho: f64,
    curvature: f64,
    m: f64,
    k: f64,
}

impl Hand {
    fn of(system: &System) -> Self {
        let r = system.restitution();
        let rho = (1.0 - r) / (1.0 + r);
        Self {
            damping: system.damping(),
            detuning: system.detuning(),
            gamma: system.forcing_per_clearance(),
            rho,
            curvature: 4.0 * rho * rho / (PI * PI),
            m: 8.0 / (PI * PI),
            k: 16.0 * rho / (PI * PI * PI),
        }
    }

    fn square(&self, beta: f64) -> f64 {
        (1.0 - beta) * (1.0 - beta) + self.curvature * beta * beta
    }

    /// `gamma^2 c2` that a fixed point at `beta` needs.
    fn needed(&self, beta: f64) -> f64 {
        let square = self.square(beta);
        let loss = self.damping * square + self.k * beta * beta;
        let reactance = self.m * beta * (1.0 - beta) - 2.0 * self.detuning * square;
        loss * loss + reactance * reactance
    }

    fn condition(&self, beta: f64) -> f64 {
        self.needed(beta) - self.gamma * self.gamma * self.square(beta)
    }

    /// The rates of (18) with the amplitudes and angles that are reported, over the sizes of their
    /// terms.
    fn residual(&self, point: &FixedPoint) -> f64 {
        let theta = libm::atan2(
            2.0 / PI * self.rho * point.absorber_amplitude,
            1.0 - point.absorber_amplitude,
        );
        let (c, e) = (point.oscillator_amplitude, self.m * point.absorber_amplitude);
        let size = (self.damping + 2.0 * self.detuning.abs()) * c + e + self.gamma;
        [
            [-self.damping * c, -e * libm::sin(theta), self.gamma * libm::sin(point.eta)],
            [2.0 * self.detuning * c, self.gamma * libm::cos(point.eta), -e * libm::cos(theta)],
        ]
        .map(|terms| terms.iter().sum::<f64>().abs() / size)
        .into_iter()
        .fold(0.0, f64::max)
    }
}

type Forcing<'a> = &'a dyn Fn(&FixedPointCurve) -> f64;

fn beta(step: u32) -> f64 {
    let t = f64::from(step) / f64::from(SCAN);
    LARGEST * t * t * t
}

fn analysis(system: &System) -> Analysis {
    Analysis::of(system).expect("analysable")
}

fn with_forcing(system: &System, gamma: f64) -> System {
    let there = Parameters { forcing_per_clearance: gamma, ..system.parameters() };
    let there = System::new(there).expect("valid").with_detuning(system.detuning());
    there.expect("a positive frequency")
}

fn systems() -> impl Strategy<Value = System> {
    let damping = prop_oneof![4 => 0.0..5.0, 1 => 0.0..50.0, 1 => Just(0.0)];
    let restitution = prop_oneof![6 => 0.0..1.0, 1 => 0.99..1.0, 1 => Just(0.0), 1 => Just(1.0)];
    let detuning = prop_oneof![6 => -8.0..8.0, 1 => Just(0.0)];
    (damping, restitution, detuning, -2.0..1.5).prop_map(
        |(damping, restitution, detuning, log_gamma)| {
            let parameters = Parameters {
                mass_ratio: 0.01,
                damping,
                restitution,
                frequency_ratio: 1.0,
                forcing_per_clearance: libm::exp10(log_gamma),
                excitation: Excitation::Force,
                cavity: Cavity::IDEAL,
            };
            let system = System::new(parameters).expect("valid");
            system.with_detuning(detuning).expect("a positive frequency")
        },
    )
}

fn limited(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(2017),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(limited(400))]

    /// Both conditions hold at every root, with its reported phase, amplitude and branch.
    #[test]
    fn both_conditions_hold_at_every_fixed_point(system in systems()) {
        let (hand, theory) = (Hand::of(&system), analysis(&system));
        prop_assert!(theory.fixed_points.len() <= 2);
        prop_assert!(theory.fixed_points.windows(2).all(|pair| pair[0].absorber_amplitude < pair[1].absorber_amplitude));
        for point in &theory.fixed_points {
            prop_assert!(hand.residual(point) < ROUNDING, "{:?}", point);
            prop_assert!(point.residual < ROUNDING, "{:?}", point);
            prop_assert!(point.absorber_amplitude > 0.0 && point.oscillator_amplitude > 0.0);
        }
    }

    /// A sign change of the condition between two scanned amplitudes is one root, none is no root or
    /// both. An elastic absorber has another zero of it, where C vanishes.
    #[test]
    fn the_count_agrees_with_a_dense_scan(system in systems()) {
        let hand = Hand::of(&system);
        let found = analysis(&system).fixed_points;
        let mut points = found.iter().peekable();
        for step in 0..SCAN {
            let (left, right) = (beta(step), beta(step + 1));
            let mut inside = Vec::new();
            while let Some(point) = points.next_if(|point| point.absorber_amplitude <= right) {
                inside.push(point);
            }
            if hand.curvature < 1e-9 && left < 1.0 && 1.0 < right {
                continue;
            }
            let changes = (hand.condition(left) > 0.0) != (hand.condition(right) > 0.0);
            prop_assert_eq!(inside.len() % 2 == 1, changes, "{:?} in {}..{}", inside, left, right);
            if let [one, other] = inside[..] {
                let between = hand.condition(0.5 * (one.absorber_amplitude + other.absorber_amplitude));
                prop_assert!((between > 0.0) != (hand.condition(left) > 0.0), "{:?}", inside);
            }
        }
        let beyond = points.count();
        prop_assert_eq!(beyond % 2 == 1, hand.condition(LARGEST) < 0.0, "{} beyond", beyond);
    }

    /// Crossing the saddle-node changes the count by two, from 1e-3 down to 1e-12 of it, and the distance
    /// that is reported is the one that was gone.
    #[test]
    fn two_points_appear_together_at_the_saddle_node(system in systems()) {
        let Some(node) = analysis(&system).boundaries.saddle_node else { return Ok(()) };
        let gamma = node.forcing_over_clearance;
        // Below zero amplitude the smaller point is none.
        let vanishing = libm::hypot(system.damping(), 2.0 * system.detuning());
        for exponent in 3..=12 {
            let distance = libm::exp10(-f64::from(exponent));
            let at = |factor: f64| analysis(&with_forcing(&system, gamma * factor)).fixed_points;
            let (below, above) = (at(1.0 - distance), at(1.0 + distance));
            if gamma * (1.0 + distance) < vanishing {
                prop_assert_eq!((below.len(), above.len()), (0, 2), "{}", distance);
            }
            for point in &above {
                let told = point.above_collision.expect("there is one");
                // The product gamma (1 + distance) is rounded.
                prop_assert!((told - distance).abs() < 4.0 * f64::EPSILON, "{} {}", told, distance);
                prop_assert!(Hand::of(&with_forcing(&system, gamma * (1.0 + distance))).residual(point) < ROUNDING);
            }
        }
    }

    /// Areas by the quadratic are those of the fixed points' branches; a stable point is the larger one.
    #[test]
    fn the_area_is_that_of_the_fixed_points(system in systems()) {
        let theory = analysis(&system);
        let on = |branch| theory.fixed_points.iter().any(|point| point.branch == branch);
        let below_hopf = system.forcing_per_clearance() < theory.boundaries.hopf;
        let expected = if on(ManifoldBranch::Stable) {
            (Area::Z3, below_hopf.then_some(Strip::A1))
        } else if on(ManifoldBranch::Right) {
            let grazes = theory.boundaries.grazing;
            let asymmetric = grazes.is_some_and(|gamma| system.forcing_per_clearance() <= gamma);
            (if asymmetric { Area::Z2 } else { Area::Z1 }, None)
        } else if on(ManifoldBranch::Left) && below_hopf {
            (Area::Z3, Some(Strip::A2))
        } else {
            (Area::Z4, None)
        };
        prop_assert_eq!((theory.zone.area, theory.zone.strip), expected);
        if let [smaller, larger] = &theory.fixed_points[..] {
            prop_assert!(!smaller.stable && smaller.determinant * larger.determinant
                * (smaller.absorber_amplitude - theory.manifold.fold.absorber_amplitude)
                * (larger.absorber_amplitude - theory.manifold.fold.absorber_amplitude) < 0.0, "{:?}", theory.fixed_points);
        }
    }

    /// Wherever a boundary is said to pass through the case's forcing, it has that forcing; and a scan of
    /// the detuning finds no other.
    #[test]
    fn boundaries_pass_where_they_are_said_to(system in systems()) {
        let theory = analysis(&system);
        let gamma = system.forcing_per_clearance();
        let at = |sigma: f64| FixedPointCurve::at_detuning(&system, &theory.manifold, sigma);
        let collision = |curve: &FixedPointCurve| curve.collision().map_or(f64::NAN, |(gamma, _)| gamma);
        let kinds: [(Bifurcation, Forcing); 3] = [
            (Bifurcation::NeimarkSacker, &FixedPointCurve::hopf),
            (Bifurcation::SymmetryBreaking, &FixedPointCurve::symmetry_breaking),
            (Bifurcation::SaddleNode, &collision),
        ];
        for (kind, forcing) in kinds {
            let found = boundaries::crossings(kind, &system, &theory.manifold);
            for sigma in &found {
                let there = forcing(&at(*sigma));
                // Squares of terms up to sigma^2 are compared.
                let scale = gamma + 1e-3 * (1.0 + sigma * sigma);
                prop_assert!((there - gamma).abs() < 1e-6 * scale, "{:?} {} {}", kind, sigma, there);
            }
            let mut count = 0;
            for step in -2000..2000 {
                let [left, right] = [step, step + 1].map(|k| 0.01 * f64::from(k) + 0.003);
                let [low, high] = [left, right].map(|sigma| forcing(&at(sigma)) - gamma);
                count += usize::from(low * high < 0.0);
            }
            let within = found.iter().filter(|sigma| sigma.abs() < 20.0).count();
            prop_assert!(count <= within, "{:?}: {} of {:?}", kind, count, found);
        }
    }
}

/// The same at the collision of Fig. 6a, in numbers that can be checked by hand.
#[test]
fn the_published_collision_adds_two_points_on_its_near_side() {
    // Table 1 at 8 Hz: 16.259 mm is the largest clearance with a steady 1:1 motion.
    let base = common::table_1(8.0, 10.0);
    let node = analysis(&base).boundaries.saddle_node.expect("one");
    let gamma = node.forcing_over_clearance;
    assert!((common::forcing_mm() / gamma - 16.259).abs() < 1e-3);
    let count = |gamma: f64| analysis(&with_forcing(&base, gamma)).fixed_points.len();
    for exponent in 3..=12 {
        let distance = libm::exp10(-f64::from(exponent));
        let (near, far) = (count(gamma * (1.0 + distance)), count(gamma * (1.0 - distance)));
        assert_eq!((near, far), (2, 0), "a part in 1e{exponent} away");
    }
    // At the collision itself there is one, and nothing is said of its stability.
    let at = analysis(&with_forcing(&base, gamma)).fixed_points;
    assert!(at.len() == 1 && at[0].determinant == 0.0 && !at[0].stable, "{at:?}");
    assert!(
        (at[0].absorber_amplitude - node.absorber_amplitude).abs() < 1e-15
            && at[0].above_collision == Some(0.0)
    );
}
