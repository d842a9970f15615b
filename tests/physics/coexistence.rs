//! Long-term motions are told apart by what they are: two simulated motions that Newton's method
//! takes to one orbit are one, and two orbits with the same impacts are two.

use crate::common::table_1;
use std::f64::consts::PI;

use vinesink::regimes::{Attractor, DynamicsKind, FoundAttractor, Regime, Window};
use vinesink::simulation::{Impact, Simulation};
use vinesink::study::{CaseStudy, LongTermMotions, Proof, StudyEffort};
use vinesink::system::{State, System};

/// The transients of both motions here are over after some hundred periods.
const WINDOW: Window = Window { discard: 2000, periods: 200, impact_limit: u64::MAX };

fn found(attractor: Attractor, starts: u32) -> FoundAttractor {
    FoundAttractor {
        attractor,
        starts,
        first_start: None,
        share: 0.0,
        share_interval: [0.0, 1.0],
        reached_from_theory: false,
        late_starts: 0,
        longest_transient: 0,
    }
}

/// What becomes of the mirror image of a motion.
fn mirrored(system: &System, motion: &Attractor) -> Attractor {
    let State { x, x_velocity, y, y_velocity } = motion.state;
    let image = State { x: -x, x_velocity: -x_velocity, y: -y, y_velocity: -y_velocity };
    // The excitation changes its sign after half a period.
    let start = Simulation::new(system, image, PI).expect("inside the cavity");
    Attractor::measure(&mut { start }, &WINDOW)
}

/// Two asymmetric impacts per period exist twice, each the mirror image of the other, with the weaker
/// impact on either wall. One orbit stands for both.
#[test]
fn a_motion_and_its_mirror_image_are_one() {
    let system = table_1(8.5, 6.0);
    let start = State { x: 0.0, x_velocity: 0.0, y: 0.0, y_velocity: 1.0 };
    let one = Attractor::reach(&system, start, &WINDOW).expect("inside the cavity");
    assert_eq!(one.classification.regime, Regime::TwoAsymmetric);
    let image = mirrored(&system, &one);
    let fastest = |motion: &Attractor| {
        let speed = |impact: &Impact| impact.y_velocity_after.abs();
        let all = motion.impacts.iter();
        all.max_by(|a, b| speed(a).total_cmp(&speed(b))).expect("impacts").side
    };
    assert_ne!(fastest(&one), fastest(&image), "not the mirror image");
    let motions = LongTermMotions::proven(&system, vec![found(one, 3), found(image, 5)], 16);
    assert_eq!(motions.attractors.len(), 1);
    assert!(motions.proofs[0].is_some());
    assert_eq!((motions.attractors[0].starts, motions.attractors[0].share), (8, 0.5));
    let [low, high] = motions.attractors[0].share_interval;
    assert!(low < 0.5 && 0.5 < high && high - low < 0.5);
}

/// Between 5.069 mm, where the asymmetric orbit doubles its period at 8.5 Hz, and 5.107 mm, where the
/// one with three impacts ends in a Neimark-Sacker bifurcation, both attract; evenly spread starts miss
/// the second. Neither is taken for the other.
#[test]
fn asymmetric_and_three_impacts_coexist() {
    let start = State { x: 0.0, x_velocity: 0.0, y: 0.0, y_velocity: 1.0 };
    let there = |clearance: f64, start: State| {
        let system = table_1(8.5, clearance);
        Attractor::reach(&system, start, &WINDOW).expect("inside the cavity")
    };
    let asymmetric = there(5.09, start);
    let three = [4.9, 5.0, 5.05, 5.09].iter().fold(there(4.8, start), |motion, clearance| {
        // Lengths are over the clearance, which hardly changes.
        there(*clearance, motion.state)
    });
    let both = vec![found(asymmetric, 3), found(three, 5)];
    let motions = LongTermMotions::proven(&table_1(8.5, 5.09), both, 8);
    let sequence = |proof: &Option<Proof>| Some(proof.as_ref()?.orbit.cycle.sequence());
    let proven: Vec<_> = motions.proofs.iter().map(sequence).collect();
    assert_eq!(proven, [Some("+-".to_owned()), Some("++-".to_owned())]);
}

/// A multiplier near -1 makes a motion come to its orbit from alternate sides: it repeats every two
/// periods long before it repeats every period, and looks like another motion. The orbit tells.
#[test]
fn a_motion_that_alternates_is_not_a_doubled_one() {
    let system = table_1(8.5, 5.08);
    let study = CaseStudy::of(&system, StudyEffort::default(), &mut |_| {}).expect("studied");
    let proofs: Vec<&Proof> = study.motions.proofs.iter().flatten().collect();
    assert_eq!(proofs.len(), 1, "{proofs:?}");
    assert_eq!(proofs[0].orbit.cycle.periods(), 1);
    let leading = proofs[0].orbit.multipliers.values[0];
    assert!(leading[0] < -0.95 && leading[1] == 0.0, "no alternation: {leading:?}");
    let dynamics = study.motions.attractors[0].attractor.classification.dynamics;
    assert_eq!(dynamics, DynamicsKind::Periodic { impacts: 2, periods: 1 });
}
