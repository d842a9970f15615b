use super::*;
use crate::system::{Cavity, Excitation, Parameters};

fn oscillator(eps: f64, lambda: f64, frequency_ratio: f64) -> Oscillator {
    let parameters = Parameters {
        mass_ratio: eps,
        damping: lambda,
        restitution: 0.6,
        frequency_ratio,
        forcing_per_clearance: 2.0,
        excitation: Excitation::BaseDisplacement,
        cavity: Cavity::IDEAL,
    };
    Oscillator::alone(&System::new(parameters).expect("valid"))
}

/// Equation (1) by central differences of the closed form, in every damping regime and at
/// resonance. The differences are good to `h^2` relative to the fastest time scale.
#[test]
fn the_motion_satisfies_the_equation_of_motion() {
    let cases = [
        (0.0077, 1.8, 0.96),
        (0.0077, 0.0, 1.0),
        (0.0077, 1e-5, 1.0 + 1e-9),
        (0.5, 4.0, 1.3),
        (0.5, 4.000_000_1, 1.3),
        (0.9, 30.0, 0.4),
    ];
    for (eps, lambda, ratio) in cases {
        let o = oscillator(eps, lambda, ratio);
        let motion = o.motion(0.3, -0.7, 1.1);
        let start = motion.at(0.0);
        assert!((start.x - 0.3).abs() < 1e-15 && (start.v + 0.7).abs() < 1e-15);
        let h = 1e-4;
        for s in [0.2, 1.0, 3.0, 6.0] {
            let (before, here, after) = (motion.at(s - h), motion.at(s), motion.at(s + h));
            let velocity = (after.x - before.x) / (2.0 * h);
            let acceleration = (after.v - before.v) / (2.0 * h);
            let scale = 1.0 + 30.0 * o.decay;
            assert!((velocity - here.v).abs() < 1e-7 * scale, "{eps} {lambda} {ratio} {s}");
            let expected = motion.acceleration(s, here);
            assert!((acceleration - expected).abs() < 1e-6 * scale * scale, "{lambda} {s}");
        }
    }
}

/// The bounds hold for all later times, or for the horizon, and for an overdamped or slowly driven
/// oscillator they fall to what is left of the motion.
#[test]
fn derivatives_stay_within_their_bounds() {
    let cases = [(0.9, 1e3, 0.958), (0.9, 4.0, 2.0), (0.0077, 1.8, 1e-3), (0.0077, 1.8, 0.05)];
    for (eps, lambda, ratio) in cases {
        let o = oscillator(eps, lambda, ratio);
        let motion = o.motion(0.3, -0.7, 1.1);
        for k in 0..60 {
            let s = 0.05 * f64::from(k);
            let bounds = motion.bounds(s, motion.at(s), 1.0);
            for l in 0..40 {
                let later = s + f64::from(l) / 40.0;
                let at = motion.at(later);
                let (a, jerk) = (motion.acceleration(later, at), motion.jerk(later, at));
                let slack = 1.0 + 1e-12;
                assert!(a.abs() <= bounds.acceleration * slack, "{lambda} {ratio} {s} {later}");
                assert!(jerk.abs() <= bounds.jerk * slack, "{lambda} {ratio} {s} {later}");
            }
        }
        let general = derivative_bounds(&o, motion.at(3.0), 1.0);
        let better = motion.bounds(3.0, motion.at(3.0), 1.0);
        assert!(better.snap <= general.snap);
        if lambda == 1e3 {
            assert!(better.snap < 1e-6 * general.snap, "{better:?} {general:?}");
        }
    }
}

#[test]
fn both_forced_forms_agree_where_both_are_accurate() {
    let mut o = oscillator(0.01, 0.05, 1.002);
    let steady = o.motion(0.1, 0.2, 0.4);
    assert!(o.steady.is_some());
    o.steady = None;
    let from_rest = o.motion(0.1, 0.2, 0.4);
    for s in [0.0, 0.01, 0.3, 2.0, 6.2] {
        let (a, b) = (steady.at(s), from_rest.at(s));
        // The steady motion is about 400 times the excitation: 1e-14 of it may cancel.
        assert!((a.x - b.x).abs() < 1e-13 && (a.v - b.v).abs() < 1e-13, "{s}: {a:?} {b:?}");
    }
}

#[test]
fn the_bounds_hold_along_the_motion() {
    let o = oscillator(0.3, 2.0, 1.7);
    let motion = o.motion(0.8, 0.4, 0.3);
    let bounds = derivative_bounds(&o, motion.at(0.0), 2.0);
    for k in 0..=200 {
        let s = f64::from(k) * 0.01;
        let at = motion.at(s);
        assert!(motion.acceleration(s, at).abs() <= bounds.acceleration);
        assert!(motion.jerk(s, at).abs() <= bounds.jerk);
    }
}

/// Without damping, a displacement against the largest force reaches the bound on the
/// acceleration, and a velocity against the fastest change of the force that on the jerk: smaller
/// ones would not hold.
#[test]
fn the_bounds_are_reached() {
    let o = oscillator(0.3, 0.0, 1.7);
    let quarter = 0.5 * std::f64::consts::PI;
    for (x, v, phase) in [(-1.0, 0.0, quarter), (0.0, -1.0, 0.0)] {
        let motion = o.motion(x, v, phase);
        let at = motion.at(0.0);
        let bounds = derivative_bounds(&o, at, 0.0);
        let (reached, bound) = if v == 0.0 {
            (motion.acceleration(0.0, at), bounds.acceleration)
        } else {
            (motion.jerk(0.0, at), bounds.jerk)
        };
        assert!((reached / bound - 1.0).abs() < 1e-12, "{reached} {bound}");
    }
}
