//! Cavities with tilt, friction and unequal ends, against the theory without these and closed forms derived by hand.

use std::f64::consts::PI;

use vinesink::analysis::{Analysis, Manifold};
use vinesink::cavity::{CavityFixedPoint, CavityMotion, CavityTheory, Forcing};
use vinesink::dissipation::PairPoint;
use vinesink::equations::cavity as formulas;
use vinesink::regimes::Regime;
use vinesink::system::{Cavity, Excitation, Parameters, System};

fn cavity(a: f64, f: f64, restitutions: [f64; 2]) -> CavityTheory {
    CavityTheory::new(a, f, restitutions).expect("valid")
}

fn system(restitution: f64, forcing: &Forcing) -> System {
    let system = System::new(Parameters {
        mass_ratio: 0.01,
        damping: forcing.damping,
        restitution,
        frequency_ratio: 1.0,
        forcing_per_clearance: forcing.forcing_per_clearance,
        excitation: Excitation::Force,
        cavity: Cavity::IDEAL,
    });
    system.and_then(|system| system.with_detuning(forcing.detuning)).expect("valid")
}

const FORCINGS: [Forcing; 4] = [
    Forcing { damping: 1.799, detuning: -5.449, forcing_per_clearance: 4.3417 },
    Forcing { damping: 1.799, detuning: 2.348, forcing_per_clearance: 1.7 },
    Forcing { damping: 0.0, detuning: 0.3, forcing_per_clearance: 0.8 },
    Forcing { damping: 0.5, detuning: -0.6, forcing_per_clearance: 2.0 },
];

/// A level cavity with equal ends and no friction is (14) to (18), and so is one with next to none of all that.
#[test]
fn the_limit_is_the_theory_without_options() {
    let small = 1e-13;
    for r in [0.05, 0.3, 0.6, 0.9] {
        let manifold = Manifold::of(r);
        for [a, f, d] in
            [[0.0; 3], [small, 0.0, 0.0], [0.0, small, 0.0], [0.0, 0.0, small], [small; 3]]
        {
            let cavity = cavity(a, f, [r, r + d]);
            for c in
                [0.7, 0.9, 1.2].map(|part| part * manifold.symmetry_breaking.oscillator_amplitude)
            {
                let beta = manifold.stable_absorber(c).expect("above the fold");
                let motions = cavity.motions_at(c);
                let near = |one: &&CavityMotion| {
                    one.deviation.abs() < 1e-9 && one.absorber_amplitude > 1.0
                };
                let motion = motions.iter().find(near).expect("the symmetric one");
                let rho = manifold.restitution_ratio;
                let forces = [
                    16.0 * rho * beta * beta / (PI * PI * PI * c),
                    -8.0 * beta * (beta - 1.0) / (PI * PI * c),
                ];
                let apart = [
                    motion.absorber_amplitude - beta,
                    motion.resistance - forces[0],
                    motion.reactance - forces[1],
                ];
                assert!(apart.iter().all(|one| one.abs() < 1e-12), "{r} {c} {apart:?}");
                assert_eq!(motion.stable, c < manifold.symmetry_breaking.oscillator_amplitude);
            }
            for forcing in FORCINGS {
                let analysis = Analysis::of(&system(r, &forcing)).expect("in range");
                let mut found = cavity.fixed_points(&forcing);
                found.retain(|point| point.motion.deviation.abs() < 1e-9);
                assert_eq!(found.len(), analysis.fixed_points.len(), "{r} {forcing:?} {found:?}");
                for (one, known) in found.iter().zip(&analysis.fixed_points) {
                    let pairs = [
                        [one.motion.absorber_amplitude, known.absorber_amplitude],
                        [one.motion.oscillator_amplitude, known.oscillator_amplitude],
                        [one.eta, known.eta],
                    ];
                    assert!(
                        pairs.iter().all(|[a, b]| (a - b).abs() < 1e-12 * b.abs().max(1.0)),
                        "{pairs:?}"
                    );
                    // They have the distance from the fold in the denominator.
                    let far = (known.absorber_amplitude - manifold.fold.absorber_amplitude).abs();
                    let jacobian = [[one.trace, known.trace], [one.determinant, known.determinant]];
                    let close = |[a, b]: &[f64; 2]| {
                        (a - b).abs() < 1e-12 * (1.0 + b.abs()) * (1.0 + 1.0 / far)
                    };
                    assert!(jacobian.iter().all(close), "{jacobian:?}");
                    assert_eq!(one.stable, known.stable && known.admissible, "{one:?} {known:?}");
                }
            }
        }
    }
}

/// The asymmetric motion of the dissipation curve, whose averages were known from simulation only: those that were
/// printed, and those of the engine's impact pair.
#[test]
fn the_asymmetric_motion_has_the_known_averages() {
    let motions = cavity(0.0, 0.0, [0.6, 0.6]).motions_at(0.9);
    let asymmetric: Vec<_> =
        motions.iter().filter(|one| one.deviation != 0.0 && one.stable && one.admissible).collect();
    let [one, other] = asymmetric[..] else { panic!("{motions:?}") };
    assert!(
        (one.resistance - 0.538).abs() < 5e-4 && (one.reactance + 1.233).abs() < 5e-4,
        "{one:?}"
    );
    assert!((one.deviation + other.deviation).abs() < 1e-12);
    for c in [0.8, 0.9, 0.97] {
        let point = PairPoint::measured(0.6, c, [0.5, 0.3]).expect("a motion");
        assert_eq!((point.regime, point.repeats_after), (Regime::TwoAsymmetric, Some(1)), "{c}");
        let motions = cavity(0.0, 0.0, [0.6, 0.6]).motions_at(c);
        let motion = motions.iter().find(|one| one.stable && one.admissible).expect("one");
        // It repeats to 1e-12 when it is measured.
        let apart = [point.resistance - motion.resistance, point.reactance - motion.reactance];
        assert!(apart.iter().all(|one| one.abs() < 1e-10), "{c} {apart:?}");
    }
    assert!((one.resistance - other.resistance).abs() < 1e-12);
    assert!((one.reactance - other.reactance).abs() < 1e-12);
}

/// Fold and symmetry breaking with friction alone: a multiplier of the pair is 1 in both, and the amplitudes are as the
/// squares of `C cos Theta = b - B` and `C sin Theta = (2/pi) rho B + pi f/2` say.
#[test]
fn closed_forms_of_friction_alone_are_limits_of_stability() {
    for f in [0.0, 0.01, 0.2, 0.8] {
        for r in [0.2, 0.6, 0.95] {
            let cavity = cavity(0.0, f, [r, r]);
            let rho = (1.0 - r) / (1.0 + r);
            let (fold, breaking) =
                (cavity.fold().expect("one"), cavity.symmetry_breaking().expect("one"));
            for point in [fold, breaking] {
                let motion = cavity.symmetric_motion(point.absorber_amplitude).expect("one");
                let beta = point.absorber_amplitude;
                let square = (1.0 - beta) * (1.0 - beta)
                    + (2.0 / PI * rho * beta + PI * f / 2.0)
                        * (2.0 / PI * rho * beta + PI * f / 2.0);
                assert!((motion.oscillator_amplitude - square.sqrt()).abs() < 1e-14);
                assert!((motion.oscillator_amplitude - point.oscillator_amplitude).abs() < 1e-14);
                let at_one = 1.0 - motion.trace + motion.determinant;
                // The trace has terms of size 1/C.
                assert!(at_one.abs() < 1e-13 / (square.sqrt() * (1.0 - r)), "{f} {r} {at_one}");
                let loss = 16.0 * rho * beta * beta / (PI * PI * PI) + 4.0 / PI * f;
                assert!((motion.oscillator_amplitude * motion.resistance - loss).abs() < 1e-14);
                assert!(
                    (formulas::FRICTION_LOSS.at([f, rho, beta]) - loss).abs()
                        < 1e-15 * (1.0 + loss)
                );
            }
            let at = |beta: f64| cavity.symmetric_motion(beta).expect("one");
            let [low, high] = [fold.absorber_amplitude, breaking.absorber_amplitude];
            assert!(!at(low - 1e-6).stable && at(low + 1e-6).stable);
            assert!(at(high - 1e-6).stable && !at(high + 1e-6).stable);
            // The asymmetric motion begins there.
            let begin = cavity.motion(0.0).expect("one");
            assert!((begin.absorber_amplitude - high).abs() < 1e-14);
            let near = cavity.motion(1e-5).expect("one");
            assert!((near.absorber_amplitude - high).abs() < 1e-9);
            assert!(cavity.motions_at(fold.oscillator_amplitude - 1e-9).is_empty());
            assert!(cavity.motions_at(fold.oscillator_amplitude + 1e-9).len() >= 2);
        }
    }
    assert_eq!(cavity(0.0, 20.0, [0.6, 0.6]).fold(), None);
    assert_eq!(cavity(0.1, 0.0, [0.6, 0.6]).fold(), None);
    assert_eq!(cavity(0.0, 0.0, [0.6, 0.7]).symmetry_breaking(), None);
}

/// Folds are where motions begin and end as the amplitude grows; those of a symmetric cavity have closed forms, and those
/// of one that is almost symmetric are near to them, symmetry breaking having become the fold of the motions that
/// no longer belong to the almost symmetric ones.
#[test]
fn folds_are_where_the_number_of_motions_changes() {
    for (a, f, ends) in [(0.0, 0.0, [0.6, 0.6]), (0.0, 0.3, [0.8, 0.8])] {
        let cavity = cavity(a, f, ends);
        let closed =
            [cavity.fold(), cavity.symmetry_breaking()].map(|one| one.expect("closed form"));
        let found: Vec<_> = cavity.folds().into_iter().filter(|one| one.deviation == 0.0).collect();
        assert_eq!(found.len(), 2, "{found:?}");
        for (one, known) in found.iter().zip(closed) {
            // A change of sign is found to rounding, times the inverse of its slope.
            assert!((one.absorber_amplitude - known.absorber_amplitude).abs() < 1e-13, "{one:?}");
        }
    }
    for (a, f, ends) in
        [(1e-4, 0.0, [0.6, 0.6]), (0.05, 0.03, [0.6, 0.55]), (-0.2, 0.2, [0.5, 0.8])]
    {
        let cavity = cavity(a, f, ends);
        let folds = cavity.folds();
        assert!(folds.len() >= 2, "{folds:?}");
        for fold in &folds {
            let c = fold.oscillator_amplitude;
            let [below, above] = [-1e-7, 1e-7].map(|by| cavity.motions_at(c + by).len());
            assert_eq!(below.abs_diff(above), 2, "{cavity:?} {fold:?}");
            // Known to rounding times the trace, which is large where an impact almost grazes.
            let at_one = 1.0 - fold.trace + fold.determinant;
            assert!(!fold.admissible || at_one.abs() < 1e-9 || fold.trace.abs() > 1e6, "{fold:?}");
        }
    }
    let [symmetric, tilted] = [0.0, 1e-6].map(|a| {
        let smallest = |least: f64, one: &CavityMotion| least.min(one.oscillator_amplitude);
        cavity(a, 0.1, [0.6, 0.6]).folds().iter().fold(f64::INFINITY, smallest)
    });
    assert!((symmetric - tilted).abs() < 1e-6, "{symmetric} {tilted}");
}

/// The first order in tilt and difference of the ends: what is left is of second order, a third of it if both are.
#[test]
fn small_deviations_are_the_first_order() {
    for (a, d) in [(1.0, 0.0), (0.0, 1.0), (1.0, -0.6)] {
        for beta in [1.1, 1.4, 2.5] {
            let left = |size: f64| {
                let cavity = cavity(a * size, 0.05, [0.6, 0.6 + d * size]);
                let deviation = cavity.small_deviation(beta);
                let motion = cavity.motion(deviation).expect("one");
                (motion.absorber_amplitude - beta).abs()
            };
            let [large, small] = [left(1e-3), left(1e-4)];
            assert!(large < 0.1 && small < 0.15 * large, "{a} {d} {beta} {large} {small}");
        }
    }
    // A tilt that undoes unequal ends.
    let [r1, r2] = [0.6, 0.62];
    let [rho1, rho2] = [r1, r2].map(|r| (1.0 - r) / (1.0 + r));
    let tilt = 2.0 * (rho1 - rho2) * 1.3 / (PI * PI * 0.5 * (rho1 + rho2));
    assert!(cavity(tilt, 0.1, [r1, r2]).small_deviation(1.3).abs() < 1e-15);
}

/// With friction alone symmetric fixed points are the roots of a quadratic in `B/b`, derived by hand from the two
/// lines above (18); the scan finds those and no more.
#[test]
fn friction_alone_leaves_the_fixed_points_a_quadratic() {
    let mut found_any = 0;
    for f in [0.0, 0.03, 0.3] {
        for r in [0.3, 0.6, 0.9] {
            for Forcing { damping: lambda, detuning: sigma, forcing_per_clearance: gamma } in
                FORCINGS
            {
                let rho = (1.0 - r) / (1.0 + r);
                let s = lambda * lambda + 4.0 * sigma * sigma;
                let p0 = s * (1.0 + PI * PI * f * f / 4.0)
                    + 16.0 * f * f / (PI * PI)
                    + 8.0 * lambda * f / PI
                    + 8.0 * sigma * f * f;
                let p1 = s * (2.0 * rho * f - 2.0) + 32.0 * sigma / (PI * PI) * (rho * f - 1.0);
                let p2 = s * (1.0 + 4.0 * rho * rho / (PI * PI))
                    + 32.0 * lambda * rho / (PI * PI * PI)
                    + 32.0 * sigma / (PI * PI)
                    + 64.0 / (PI * PI * PI * PI);
                let root = (p1 * p1 - 4.0 * p2 * (p0 - gamma * gamma)).sqrt();
                let mut known = vec![(-p1 - root) / (2.0 * p2), (-p1 + root) / (2.0 * p2)];
                known.retain(|beta| *beta > 0.0);
                let forcing =
                    Forcing { damping: lambda, detuning: sigma, forcing_per_clearance: gamma };
                let mut found = cavity(0.0, f, [r, r]).fixed_points(&forcing);
                found.retain(|point| point.motion.deviation == 0.0);
                assert_eq!(found.len(), known.len(), "{f} {r} {forcing:?} {found:?} {known:?}");
                found_any += found.len();
                for (point, beta) in found.iter().zip(known) {
                    assert!(
                        (point.motion.absorber_amplitude - beta).abs() < 1e-11,
                        "{point:?} {beta}"
                    );
                }
            }
        }
    }
    assert!(found_any > 30, "{found_any}");
}

/// Rates of `C` and `eta`, the motion being the one nearest to another.
fn rates(
    cavity: &CavityTheory,
    forcing: &Forcing,
    [c, eta]: [f64; 2],
    near: &CavityMotion,
) -> [f64; 2] {
    let motions = cavity.motions_at(c);
    let apart = |one: &&CavityMotion| {
        (one.absorber_amplitude - near.absorber_amplitude).abs()
            + (one.deviation - near.deviation).abs()
    };
    let motion = motions.iter().min_by(|a, b| apart(a).total_cmp(&apart(b))).expect("one");
    let gamma = forcing.forcing_per_clearance;
    [
        (-forcing.damping * c - motion.resistance + gamma * libm::sin(eta)) / 2.0,
        forcing.detuning + (gamma * libm::cos(eta) - motion.reactance) / (2.0 * c),
    ]
}

/// At a fixed point the rates vanish, and trace and determinant are those of their differences. Those found are all: a
/// walk in `nu`, and around the almost symmetric motions in their amplitude, passes no other.
#[test]
fn fixed_points_are_those_of_the_slow_flow() {
    const STEP: f64 = 1e-6;
    let mut compared = 0;
    for (a, f, ends) in [
        (0.02, 0.0, [0.6, 0.6]),
        (0.003, 0.05, [0.6, 0.65]),
        (0.0, 0.1, [0.8, 0.7]),
        (0.0, 0.0, [0.6, 0.6]),
    ] {
        let cavity = cavity(a, f, ends);
        for forcing in FORCINGS {
            let points = cavity.fixed_points(&forcing);
            for CavityFixedPoint { motion, eta, trace, determinant, .. } in &points {
                let at = [motion.oscillator_amplitude, *eta];
                let rate =
                    |c: f64, eta: f64| rates(&cavity, &forcing, [at[0] + c, at[1] + eta], motion);
                let still = rate(0.0, 0.0);
                assert!(still.iter().all(|one| one.abs() < 1e-10), "{still:?} {motion:?}");
                let column = |c: f64, eta: f64| {
                    let (after, before) = (rate(c, eta), rate(-c, -eta));
                    [0, 1].map(|k| (after[k] - before[k]) / (2.0 * STEP))
                };
                let [by_c, by_eta] = [column(STEP, 0.0), column(0.0, STEP)];
                let found = [by_c[0] + by_eta[1], by_c[0] * by_eta[1] - by_c[1] * by_eta[0]];
                // Rounding over the step, and curvature, which grows towards the folds.
                let size = 1.0 + motion.slopes.iter().map(|one| one * one).sum::<f64>();
                let apart = [found[0] - trace, found[1] - determinant];
                assert!(apart.iter().all(|one| one.abs() < 1e-7 * size), "{apart:?} {motion:?}");
                compared += 1;
            }
            let held = |motion: &CavityMotion| {
                let Forcing { damping, detuning, forcing_per_clearance: gamma } = forcing;
                let c = motion.oscillator_amplitude;
                let sides =
                    [damping * c + motion.resistance, 2.0 * detuning * c - motion.reactance];
                (libm::hypot(sides[0], sides[1]) > gamma, motion.absorber_amplitude)
            };
            let walk: Vec<_> = (-15_000..15_000)
                .filter_map(|k| {
                    let motion = cavity.motion((f64::from(k) + 0.5) * 1e-4)?;
                    Some((motion.deviation, held(&motion)))
                })
                .collect();
            for pair in walk.windows(2) {
                let [(from, (above, b0)), (to, (after, b1))] = [pair[0], pair[1]];
                if above == after || to - from > 1.5e-4 || (b1 - b0).abs() > 0.5 {
                    continue;
                }
                let there =
                    points.iter().any(|point| (from..=to).contains(&point.motion.deviation));
                assert!(there, "{cavity:?} {forcing:?} {from} {to} {points:?}");
            }
        }
    }
    assert!(compared > 30, "{compared}");
}

#[test]
fn what_no_cavity_can_be_is_refused() {
    let text = |a, f, r| CavityTheory::new(a, f, r).unwrap_err().to_string();
    assert_eq!(text(f64::NAN, 0.0, [0.6; 2]), "acceleration is NaN, expected a finite number");
    assert_eq!(text(0.0, -1.0, [0.6; 2]), "friction is -1, expected a finite number, 0 or more");
    assert_eq!(
        text(0.0, 0.0, [1.5, 0.6]),
        "first restitution is 1.5, expected a number from 0 to 1"
    );
    assert_eq!(
        text(0.0, 0.0, [0.6, -0.1]),
        "second restitution is -0.1, expected a number from 0 to 1"
    );
}
