//! What kind of dynamics a motion is.
//!
//! The truth is what is known of these motions otherwise: the 1:1 motion's multipliers, the
//! published order of regimes, and that a quasi-periodic motion keeps its exponent at zero however
//! long it is watched.

use crate::common;
use vinesink::executor::Serial;
use vinesink::motions::{Effort, Measured, Motion, Place, Window, motions};
use vinesink::regimes::{DynamicsKind, Regime};
use vinesink::system::{Cavity, Excitation, Parameters, State, System};

const START: State = State { x: 0.3, x_velocity: 0.2, y: 0.1, y_velocity: 0.8 };

fn reached(system: &System, discard: u64, periods: u64) -> Measured {
    let effort = Window { discard, periods, impact_limit: 1_000_000 };
    Measured::reach(system, START, &effort).expect("inside the cavity")
}

fn dynamics(system: &System, discard: u64, periods: u64) -> (Regime, DynamicsKind) {
    let classification = reached(system, discard, periods).classification;
    (classification.regime, classification.dynamics)
}

#[test]
fn the_published_regimes_have_their_natures() {
    let once = DynamicsKind::Periodic { impacts: 2, periods: 1 };
    for (frequency, clearance, regime, expected) in [
        (8.0, 4.0, Regime::TwoAsymmetric, once),
        (8.0, 7.5, Regime::TwoSymmetric, once),
        (8.5, 20.0, Regime::TwoSymmetric, once),
        (8.0, 20.0, Regime::BelowTwo, DynamicsKind::Chaotic),
        (8.5, 27.0, Regime::StronglyModulated, DynamicsKind::Chaotic),
        (8.5, 30.0, Regime::StronglyModulated, DynamicsKind::Chaotic),
        (8.5, 35.0, Regime::BelowTwo, DynamicsKind::Chaotic),
    ] {
        let found = dynamics(&common::table_1(frequency, clearance), 1500, 2000);
        assert_eq!(found, (regime, expected), "{frequency} Hz, b = {clearance} mm");
    }
}

/// Slowly decaying modulation around the 1:1 motion: the exponent tells before the motion repeats.
#[test]
fn a_motion_that_is_still_settling_is_not_over() {
    let system = common::table_1(8.5, 20.0);
    let early = reached(&system, 80, 90);
    assert!(!early.repeats(), "{:?}", early.classification.evidence);
    assert_eq!(early.classification.dynamics, DynamicsKind::TransientNotOver);
    assert!(early.classification.evidence.modulation_growth < 0.5);
    let late = reached(&system, 1500, 200);
    assert_eq!(late.classification.dynamics, DynamicsKind::Periodic { impacts: 2, periods: 1 });
}

/// A chaotic transient cannot be told from chaos that stays until it is over: at b = 14.5 mm it gives
/// way to the 1:1 motion after 500 periods on average, from one start in eight after a thousand.
#[test]
fn a_chaotic_transient_is_chaotic_until_it_is_over() {
    let system = common::table_1(8.0, 14.5);
    let effort = Window { discard: 400, periods: 1000, impact_limit: 1_000_000 };
    let long = Window { discard: 20_000, ..effort };
    let mut ended = 0;
    for k in 0..60 {
        let x_velocity = 0.1 + 0.01 * f64::from(k);
        let start = State { x: 0.0, x_velocity, y: 0.0, y_velocity: -0.2 };
        let early = Measured::reach(&system, start, &effort).expect("inside the cavity");
        // One that has just ended is settling, and says so.
        if early.repeats() || early.classification.dynamics == DynamicsKind::TransientNotOver {
            continue;
        }
        assert_eq!(
            early.classification.dynamics,
            DynamicsKind::Chaotic,
            "{:?}",
            early.classification
        );
        let late = Measured::reach(&system, early.state, &long).expect("finite");
        if late.classification.dynamics == (DynamicsKind::Periodic { impacts: 2, periods: 1 }) {
            ended += 1;
        }
    }
    assert!(ended > 0, "no transient ended within 20000 periods");
    // A search waits for that, and lists no motion that is none.
    let place = Place::new(&system, 32);
    let found = motions(&[place], &Effort::default(), &Serial).expect("finite").remove(0);
    let moving: Vec<&Motion> = found.iter().filter(|one| one.rest().is_none()).collect();
    let [only] = moving.as_slice() else { panic!("{moving:?}") };
    assert!(only.is_one_to_one() && only.reached().starts == 32 && only.reached().late > 0);
}

/// A window of 20 periods decides nothing that does not repeat.
#[test]
fn a_short_window_leaves_chaos_undecided_or_open() {
    let (_, found) = dynamics(&common::table_1(8.0, 20.0), 1500, 20);
    assert!(matches!(found, DynamicsKind::Undecided | DynamicsKind::TransientNotOver), "{found:?}");
}

/// Past a Neimark-Sacker bifurcation that is not abrupt: two symmetric impacts, modulated for ever.
#[test]
fn a_modulation_that_never_repeats_nor_parts_neighbours_is_quasi_periodic() {
    let system = System::new(Parameters {
        mass_ratio: 0.17,
        damping: 0.387,
        restitution: 0.5635,
        frequency_ratio: 0.966,
        forcing_per_clearance: 0.7276,
        excitation: Excitation::Force,
        cavity: Cavity::IDEAL,
    })
    .expect("valid");
    let found = reached(&system, 2000, 16_000);
    assert_eq!(
        found.classification.dynamics,
        DynamicsKind::QuasiPeriodic,
        "{:?}",
        found.classification
    );
    assert!(found.classification.evidence.modulation_depth > 0.2);
    // Less of it is no proof.
    let (_, short) = dynamics(&system, 2000, 200);
    assert_eq!(short, DynamicsKind::Undecided);
}

/// Neighbours of an undamped elastic motion drift apart in proportion to time, which must not be
/// called chaos: its exponent is zero.
#[test]
fn linear_drift_of_a_motion_without_losses_is_not_chaos() {
    let system = System::new(Parameters {
        mass_ratio: 0.1,
        damping: 0.0,
        restitution: 1.0,
        frequency_ratio: 1.2,
        forcing_per_clearance: 0.0,
        excitation: Excitation::Force,
        cavity: Cavity::IDEAL,
    })
    .expect("valid");
    // The oscillator hardly moves: the absorber flies to and fro at nearly constant speed.
    let start = State { x: 1e-7, x_velocity: 0.0, y: 0.0, y_velocity: 1e-7 };
    for periods in [200, 1000, 5000] {
        let effort = Window { discard: 0, periods, impact_limit: 1_000_000 };
        let found = Measured::reach(&system, start, &effort).expect("inside the cavity");
        assert_ne!(
            found.classification.dynamics,
            DynamicsKind::Chaotic,
            "{:?}",
            found.classification
        );
    }
}

#[test]
fn rest_is_rest_only_once_the_oscillator_has_settled() {
    let system = common::table_1(7.0, 30.0);
    let rest = State { y: 0.0, ..system.linear_response().expect("damped").state(&system) };
    let effort = Window { discard: 0, periods: 100, impact_limit: 1000 };
    let found = Measured::reach(&system, rest, &effort).expect("inside the cavity");
    assert_eq!(found.classification.regime, Regime::AtRest);
    assert_eq!(found.classification.dynamics, DynamicsKind::AtRest);
    // From a start off the steady motion the oscillator is on its way for hundreds of periods.
    let away = State { x: rest.x + 0.1, y: rest.y + 0.1, ..rest };
    let found = Measured::reach(&system, away, &effort).expect("inside the cavity");
    assert_eq!(found.classification.regime, Regime::AtRest);
    assert_ne!(found.classification.dynamics, DynamicsKind::AtRest);
}
