//! A system from the numbers of a drawing against formulas in SI units, by hand.

use std::f64::consts::TAU;

use vinesink::system::{Absorber, Harmonic, STANDARD_GRAVITY, Structure, System};

const STRUCTURE: Structure =
    Structure { mass_kg: 12.0, stiffness_n_per_m: 5.4e4, damping_n_s_per_m: 31.0 };
const ABSORBER: Absorber = Absorber::new(0.9, 3.2e-3, 0.45);

/// A few roundings of numbers of order 1.
const ROUNDING: f64 = 1e-13;

#[track_caller]
fn close(found: f64, expected: f64) {
    assert!((found / expected - 1.0).abs() < ROUNDING, "{found} is not {expected}");
}

/// Amplitude in m of `m x'' + c x' + k x` under a force: `P/|k - m w^2 + i c w|`; under a moving base the force is
/// `F |k + i c w|`.
#[test]
fn a_structure_alone_moves_as_its_masses_springs_and_dampers_say() {
    let Structure { mass_kg: m, stiffness_n_per_m: k, damping_n_s_per_m: c } = STRUCTURE;
    for frequency in [2.0, 10.7, 128.0] {
        let w = TAU * frequency;
        let dynamic = libm::hypot(k - m * w * w, c * w);
        let cases = [
            (Harmonic::force(7.0, frequency), 7.0 / dynamic),
            (Harmonic::base(2e-4, frequency), 2e-4 * libm::hypot(k, c * w) / dynamic),
        ];
        for (harmonic, expected) in cases {
            let (system, scales) = System::physical(&STRUCTURE, &ABSORBER, &harmonic).unwrap();
            close(scales.length(system.linear_response().unwrap().amplitude()), expected);
            close(scales.frequency(system.frequency_ratio()), frequency);
        }
    }
}

#[test]
fn a_mode_is_its_mass_spring_and_damper() {
    let zeta = STRUCTURE.damping_n_s_per_m / STRUCTURE.critical_damping_n_s_per_m();
    let frequency = STRUCTURE.natural_frequency_rad_per_s() / TAU;
    let modal = Structure::modal(STRUCTURE.mass_kg, frequency, zeta);
    close(modal.stiffness_n_per_m, STRUCTURE.stiffness_n_per_m);
    close(modal.damping_n_s_per_m, STRUCTURE.damping_n_s_per_m);
}

#[test]
fn gravity_and_friction_are_accelerations_of_the_absorber() {
    let tilted = Absorber { inclination_rad: 0.3, friction: 0.02, ..ABSORBER };
    let (system, scales) =
        System::physical(&STRUCTURE, &tilted, &Harmonic::force(7.0, 10.0)).unwrap();
    let cavity = system.cavity();
    close(scales.acceleration(cavity.gravity_along), STANDARD_GRAVITY * libm::sin(0.3));
    close(
        scales.acceleration(cavity.friction_acceleration),
        0.02 * STANDARD_GRAVITY * libm::cos(0.3),
    );
    // A quarter turn, although no number is one: nothing presses on the track.
    let upright = Absorber { inclination_rad: TAU / 4.0, ..tilted };
    let (system, _) = System::physical(&STRUCTURE, &upright, &Harmonic::force(7.0, 10.0)).unwrap();
    assert_eq!(system.cavity().friction_acceleration, 0.0);
}

#[test]
fn what_no_drawing_has_is_named() {
    let refused = |structure, absorber, harmonic| {
        System::physical(&structure, &absorber, &harmonic).unwrap_err().to_string()
    };
    let [force, no_time] = [Harmonic::force(7.0, 10.0), Harmonic::force(7.0, 0.0)];
    let weightless = Absorber { mass_kg: 0.0, ..ABSORBER };
    let lively = Absorber { restitution: 1.2, ..ABSORBER };
    let unsprung = Structure { stiffness_n_per_m: f64::NAN, ..STRUCTURE };
    let above_0 = "expected a finite number above 0";
    assert_eq!(
        refused(STRUCTURE, weightless, force),
        format!("mass_kg of the absorber is 0, {above_0}")
    );
    assert_eq!(refused(unsprung, ABSORBER, force), format!("stiffness_n_per_m is NaN, {above_0}"));
    assert_eq!(refused(STRUCTURE, ABSORBER, no_time), format!("frequency_hz is 0, {above_0}"));
    assert_eq!(
        refused(STRUCTURE, lively, force),
        "restitution is 1.2, expected a number from 0 to 1"
    );
}
