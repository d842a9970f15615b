//! Long-term motions and linear devices: one mode and one absorber by the room that knows them, and closed forms.

use vinesink_core::linear::{ModalAmplitudes, ModalDamper, TunedMassDamper, bare_amplitude};
use vinesink_core::motions::modal_motions;
use vinesink_core::orbits::FullSystem;
use vinesink_core::simulation::Sensor;
use vinesink_core::system::{
    Cavity, Excitation, ModalAbsorber, ModalParameters, ModalSystem, Mode, Parameters, System,
};

/// The structure of Li, Seguy and Berlioz (2016), Table 1, with a clearance of 20 mm and 0.25 mm of force over stiffness.
const EPS: f64 = 0.032 / 4.168;
const ZETA: f64 = 0.006_906;
const FORCE: f64 = 0.25 / 20.0;

/// One mode with one absorber, lengths over the clearance.
fn one(omega: f64) -> (System, ModalSystem) {
    let parameters = Parameters {
        mass_ratio: EPS,
        damping: 2.0 * ZETA / EPS,
        restitution: 0.6,
        frequency_ratio: omega,
        forcing_per_clearance: FORCE / EPS,
        excitation: Excitation::Force,
        cavity: Cavity::IDEAL,
    };
    let mode = Mode {
        frequency: 1.0,
        damping_ratio: ZETA,
        mass: 1.0,
        forcing: FORCE,
        shape: vec![1.0],
        ..Mode::default()
    };
    let absorber = ModalAbsorber { mass: EPS, clearance: 1.0, restitution: 0.6 };
    let modal = ModalParameters {
        modes: vec![mode],
        absorbers: vec![absorber],
        frequency_ratio: omega,
        ..ModalParameters::default()
    };
    (System::new(parameters).expect("valid"), ModalSystem::new(modal).expect("valid"))
}

#[test]
fn dampers_of_one_mode_are_those_of_the_closed_form() {
    for omega in [0.8, 0.97, 1.0, 1.04] {
        let (system, modal) = one(omega);
        let damper = TunedMassDamper { tuning: 0.98, damping_ratio: 0.09 };
        let own = ModalDamper { mass: EPS, frequency: 0.98, damping_ratio: 0.09, shape: vec![1.0] };
        let places = [vec![1.0]];
        let bare = ModalAmplitudes::of(&modal, &[], &places).places[0];
        assert!((bare / bare_amplitude(&system) - 1.0).abs() < 1e-12, "{omega}");
        let found = ModalAmplitudes::of(&modal, std::slice::from_ref(&own), &places);
        assert!((found.places[0] / damper.amplitude(&system) - 1.0).abs() < 1e-12, "{omega}");
        assert!((found.strokes[0] / damper.stroke(&system) - 1.0).abs() < 1e-12, "{omega}");
        // Two halves side by side are one.
        let half = ModalDamper { mass: 0.5 * EPS, ..own };
        let both = ModalAmplitudes::of(&modal, &[half.clone(), half], &places);
        assert!((both.places[0] / found.places[0] - 1.0).abs() < 1e-12, "{omega}");
    }
}

#[test]
fn the_motion_of_one_mode_and_one_absorber_is_its_exact_orbit() {
    let (mut seen, mut led) = (0, 0);
    for omega in [1.0, 8.5 / 8.349, 1.025] {
        let (system, modal) = one(omega);
        let Some(peak) = FullSystem::of(&system).attracting_peak() else { continue };
        let motions =
            modal_motions(&modal, &[Sensor::displacement(vec![1.0])], 4, 0).expect("they fly");
        let orbit = motions.iter().find(|one| one.repeats_after == Some(1) && !one.rests());
        let orbit = orbit.expect("the orbit attracts");
        assert!((orbit.sensors[0].peak / peak - 1.0).abs() < 1e-9, "{omega}: {orbit:?} {peak}");
        assert!(orbit.settled && orbit.sensors[0].error < 1e-9, "{orbit:?}");
        assert!((orbit.impacts_per_period[0][0] - 2.0).abs() < 1e-12, "{orbit:?}");
        assert!(orbit.largest_multiplier.is_some_and(|one| one < 1.0), "{orbit:?}");
        seen += 1;
        led += orbit.starts;
    }
    assert!(seen > 1 && led > 0, "{seen} orbits attract, {led} starts lead to one");
}
