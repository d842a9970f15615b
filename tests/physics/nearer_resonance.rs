//! Figs. 11 and 12 of Li, Seguy, Berlioz (2016) with the drive nearer resonance than Table 1 puts it: every panel from
//! many starts with two sets of parameters, and the two ratios of boundaries that forbid it at Table 1's.

use std::f64::consts::{PI, TAU};

use crate::common;
use vinesink::analysis::{Analysis, ManifoldBranch};
use vinesink::motions::{Effort, Motion, follow, starts};
use vinesink::regimes::Regime;
use vinesink::system::{Cavity, Excitation, Parameters, State, System};

/// Natural frequency over that of Table 1, restitution, `F` in mm: inferred from the regimes.
type Set = (f64, f64, f64);
const TABLE_1: Set = (1.0, 0.6, 0.25);
const A: Set = (0.964, 0.6, 0.07);
const B: Set = (0.964, 0.7, 0.066);

/// Clearances in mm with the regime that the experiment shows: Fig. 11a to f, and Fig. 12.
const PANELS: [(f64, Regime); 7] = [
    (0.3, Regime::AboveTwo),
    (2.5, Regime::AboveTwo),
    (4.0, Regime::TwoAsymmetric),
    (7.5, Regime::TwoSymmetric),
    (11.5, Regime::StronglyModulated),
    (20.0, Regime::BelowTwo),
    (15.0, Regime::StronglyModulated),
];

/// Masses, damper and drive at 8 Hz of Table 1.
fn system((natural, restitution, amplitude): Set, clearance: f64) -> System {
    let omega_0 = natural * common::natural_frequency();
    System::new(Parameters {
        mass_ratio: common::MASS_RATIO,
        damping: 3.02 / (0.032 * omega_0),
        restitution,
        frequency_ratio: 8.0 * TAU / omega_0,
        forcing_per_clearance: amplitude / common::MASS_RATIO / clearance,
        excitation: Excitation::BaseDisplacement,
        cavity: Cavity::IDEAL,
    })
    .expect("valid")
}

/// The motions that evenly spread starts lead to, without those that leave the absorber at rest.
fn moving(set: Set, clearance: f64, starts: u32) -> Vec<Motion> {
    let system = system(set, clearance);
    let starts: Vec<(System, State)> =
        starts::spread(&system, starts).map(|start| (system, start)).collect();
    // As long as a report measures: the share of time in captures scatters less than its distance from the threshold.
    let found = follow(&starts, &Effort::over(1000)).expect("inside the cavity");
    found.into_iter().flatten().filter(|motion| motion.rest().is_none()).collect()
}

#[test]
fn all_panels_hold_from_every_start() {
    for set in [A, B] {
        for (clearance, regime) in PANELS {
            let found = moving(set, clearance, 16);
            assert!(found.len() >= 14, "{set:?}, {clearance} mm: {} starts move", found.len());
            for motion in found {
                assert_eq!(motion.regime(), regime, "{set:?}, {clearance} mm: {motion:?}");
            }
        }
    }
}

/// Fig. 11a is judged as chaos, and Fig. 11b repeats with three impacts: so it is with set B. With Table 1's
/// restitution the impacts at 0.3 mm repeat, and those at 2.5 mm do not from most starts.
#[test]
fn a_larger_restitution_gives_the_regularity_of_panels_a_and_b() {
    let repeat = |set, clearance| {
        let found = moving(set, clearance, 16);
        let repeating = found.iter().filter(|motion| motion.repeats_after().is_some()).count();
        (repeating, found)
    };
    assert_eq!(repeat(B, 0.3).0, 0);
    let (repeating, found) = repeat(B, 2.5);
    assert_eq!(repeating, 16);
    assert!(
        found.iter().all(|motion| (motion.facts().impacts_per_period.value - 3.0).abs() < 1e-9)
    );
    assert_eq!(repeat(A, 0.3).0, 16);
    assert!(repeat(A, 2.5).0 < 8);
}

/// `gamma^2 = q0 + q1 beta + q2 beta^2` of the fixed point with `beta = B/b`, written out by hand.
fn ratios(set: Set) -> [f64; 2] {
    let system = system(set, 10.0);
    let (lambda, sigma, r) = (system.damping(), system.detuning(), system.restitution());
    let (rho, s) = ((1.0 - r) / (1.0 + r), sigma * sigma + lambda * lambda / 4.0);
    let curvature = 4.0 * rho * rho / (PI * PI);
    let square = PI * PI;
    let q = [
        4.0 * s,
        -8.0 * s - 32.0 * sigma / square,
        4.0 * s * (1.0 + curvature)
            + 32.0 / square * (sigma + lambda * rho / PI)
            + 64.0 / (square * square),
    ];
    let gamma = |beta: f64| (q[0] + q[1] * beta + q[2] * beta * beta).sqrt();
    let breaking = PI * PI / (PI * PI - 4.0);
    let collision = -q[1] / (2.0 * q[2]);
    let (hopf, on_stable) = (1.0 / (1.0 + curvature), collision > 1.0 / (1.0 + curvature));
    let end = if on_stable { collision } else { hopf };
    // The program's own boundaries are these.
    let found = Analysis::of(&system).expect("analysable").boundaries;
    let node = found.saddle_node.filter(|node| node.branch == ManifoldBranch::Stable);
    assert_eq!(node.is_some(), on_stable);
    let ends = node.map_or(found.hopf, |node| node.forcing_over_clearance);
    assert!((ends / gamma(end) - 1.0).abs() < 1e-12);
    assert!((found.symmetry_breaking / gamma(breaking) - 1.0).abs() < 1e-12);
    // The oscillator alone, of which the second ratio asks that it reaches the fold.
    let (eps, omega) = (system.mass_ratio(), system.frequency_ratio());
    let (loss, stiff) = (eps * lambda * omega, 1.0 - omega * omega);
    let bare = eps * (1.0 + loss * loss).sqrt() / (stiff * stiff + loss * loss).sqrt();
    let fold = (curvature / (1.0 + curvature)).sqrt();
    [gamma(breaking) / gamma(end), gamma(end) * bare / fold]
}

/// Known from an independent program: 3.47 and 1.18 with Table 1. Asymmetric impacts at 4 mm and none steady at 11.5 mm
/// need the first below 11.5/4, captures at 15 mm about the second above 15/11.5; neither depends on `F`.
#[test]
fn two_ratios_forbid_table_1_and_allow_the_sets() {
    let [most, least] = [11.5 / 4.0, 15.0 / 11.5];
    let [end, fold] = ratios(TABLE_1);
    assert_eq!(format!("{end:.2} {fold:.2}"), "3.47 1.18");
    assert!(end > most && fold < least);
    for set in [A, B] {
        let [end, fold] = ratios(set);
        assert!(end < most && fold > least, "{set:?}: {end} {fold}");
    }
    // A smaller restitution mends the first and worsens the second, a larger one the other way round.
    let [smaller, larger] = [0.5, 0.7].map(|r| ratios((1.0, r, 0.25)));
    assert!(smaller[0] < end && end < larger[0]);
    assert!(smaller[1] < fold && fold < larger[1] && larger[1] < least);
}

/// What the first ratio says, by simulation of the full system: each panel has its `F`, and none is both's.
#[test]
fn no_forcing_amplitude_gives_panels_c_and_e_with_table_1() {
    let mut held = [0, 0];
    for step in 0..12 {
        let set = (1.0, 0.6, 0.1 + 0.02 * f64::from(step));
        let at = |clearance| moving(set, clearance, 4).into_iter().map(|motion| motion.regime());
        let asymmetric = at(4.0).all(|regime| regime == Regime::TwoAsymmetric);
        let unsteady = at(11.5).all(|regime| regime != Regime::TwoSymmetric);
        assert!(!(asymmetric && unsteady), "{set:?}");
        held = [held[0] + u32::from(asymmetric), held[1] + u32::from(unsteady)];
    }
    assert!(held[0] > 0 && held[1] > 0, "{held:?}");
}
