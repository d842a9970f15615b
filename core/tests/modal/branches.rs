//! Branches of antiperiodic orbits: against those of one mode and one absorber, against all orbits at many values, and against
//! simulation on either side of a limit.

use vinesink_core::orbits::branch::{BranchDirection, BranchEnd, Settings};
use vinesink_core::orbits::{
    Bifurcation, ModalBranch, SymmetricFamily, antiperiodic_orbits, orbit_state, stable_reach,
    stable_stretches,
};
use vinesink_core::simulation::ModalSimulation;
use vinesink_core::system::{ModalParameter, ModalSystem};

use super::cases::{EPS, one_by_one, two_by_two};
use super::orbits::attracting;
use super::simulation::{Noise, random};

/// Limits over the clearance are those of the closed form for one mode and one absorber.
#[test]
fn one_mode_and_one_absorber_have_the_limits_of_the_layer_for_these() {
    let mut kinds = Vec::new();
    for parameters in
        [[EPS, 1.799, 0.6, 0.958, 4.34], [0.05, 1.0, 0.5, 1.01, 1.5], [0.02, 2.0, 0.75, 0.97, 3.0]]
    {
        let (one, several) = one_by_one(parameters, 2.5);
        let family = SymmetricFamily::of(&one).expect("damped");
        for stretch in &family.stable {
            let [from, to] = stretch.clearance;
            let middle = from + 0.4 * (to - from);
            let there = ModalParameter::Clearance(0);
            let system = there.applied(&several, 2.5 * middle).expect("positive");
            let orbits = antiperiodic_orbits(&system);
            let orbit = orbits.iter().find(|orbit| orbit.stable()).expect("one attracts");
            let range = [0.5 * 2.5 * from, 1.5 * 2.5 * to];
            let reach = stable_reach(&system, orbit, there, range).expect("an orbit");
            for (k, end) in reach.iter().enumerate() {
                if stretch.ends[k].is_none() {
                    continue;
                }
                let off = end.value / 2.5 / stretch.clearance[k] - 1.0;
                assert_eq!(end.kind, stretch.ends[k], "{reach:?} {stretch:?}");
                // Both are located to 1e-12; a multiplier is known to 1e-10 and passes the circle at an angle.
                assert!(off.abs() < 1e-8, "{k}: {off:e} {reach:?} {stretch:?}");
                kinds.extend(end.kind);
            }
        }
    }
    kinds.sort_unstable();
    kinds.dedup();
    assert!(kinds.len() >= 3, "{kinds:?}");
}

fn attracts(system: &ModalSystem) -> bool {
    antiperiodic_orbits(system).iter().any(|orbit| orbit.stable())
}

/// Of one absorber all orbits are known at every value: inside of a reach one attracts, and next to an end on the other side
/// none does that goes on from there.
#[test]
fn a_reach_ends_where_no_orbit_attracts_any_more() {
    let mut noise = Noise(3);
    let (mut ends, mut kinds) = (0, Vec::new());
    for k in 0..60 {
        let system = random(&mut noise, 1 + k % 4, 1);
        let Some(orbit) = antiperiodic_orbits(&system).into_iter().find(|orbit| orbit.stable())
        else {
            continue;
        };
        for (parameter, range) in [
            (ModalParameter::Excitation, [0.25, 4.0]),
            (ModalParameter::FrequencyRatio, [0.8, 1.2]),
            (ModalParameter::Restitution(0), [0.0, 1.0]),
        ] {
            let reach = stable_reach(&system, &orbit, parameter, range).expect("an orbit");
            let at = |value: f64| parameter.applied(&system, value).expect("valid");
            let (from, to) = (reach[0].value, reach[1].value);
            for share in [0.001, 0.3, 0.6, 0.999] {
                assert!(attracts(&at(from + share * (to - from))), "{k} {parameter:?} {reach:?}");
            }
            for (end, way) in reach.iter().zip([-1.0, 1.0]) {
                let Some(kind) = end.kind else {
                    let edge = if way < 0.0 { range[0] } else { range[1] };
                    assert!((end.value - edge).abs() < 1e-9, "{k} {parameter:?} {reach:?}");
                    continue;
                };
                let beyond = end.value + way * 1e-4 * end.value.max(0.1);
                let Ok(beyond) = parameter.applied(&system, beyond) else {
                    // At a restitution of 0 the absorber begins to stay on its wall.
                    assert!(end.value < 1e-6, "{k} {reach:?}");
                    continue;
                };
                assert!(!attracts(&beyond), "{k} {parameter:?} {reach:?} {kind:?}");
                ends += 1;
                kinds.push(kind);
            }
        }
    }
    kinds.sort_unstable();
    kinds.dedup();
    assert!(ends > 60 && kinds.len() >= 3, "{ends} {kinds:?}");
}

/// Along amplitudes and clearances an orbit attracts inside of the stretches, and none does outside: at many values, each
/// searched by itself.
#[test]
fn stretches_are_where_an_orbit_attracts() {
    stretches_of_systems(8, [20, 800]);
}

#[test]
#[ignore = "deep"]
fn stretches_of_forty_systems_are_where_an_orbit_attracts() {
    stretches_of_systems(40, [300, 300]);
}

/// Of so many systems; at least so many values lie inside of a stretch and outside of all.
fn stretches_of_systems(count: usize, least: [usize; 2]) {
    let mut noise = Noise(11);
    let (mut inside, mut outside) = (0, 0);
    for k in 0..count {
        let absorbers = 1 + k % 2;
        let system = random(&mut noise, 1 + k % 3, absorbers);
        for parameter in [ModalParameter::Excitation, ModalParameter::Clearance(absorbers - 1)] {
            let own = parameter.of(&system);
            let range = [0.25 * own, 4.0 * own];
            let found = stable_stretches(&system, parameter, range);
            let values = if absorbers == 1 { 100 } else { 12 };
            for n in 0..values {
                let share = (f64::from(n) + 0.37) / f64::from(values);
                let value = range[0] * libm::pow(range[1] / range[0], share);
                let within = found.iter().any(|[a, b]| a.value < value && value < b.value);
                let there = parameter.applied(&system, value).expect("positive");
                assert_eq!(attracts(&there), within, "{k} {parameter:?} {value} {found:?}");
                if within { inside += 1 } else { outside += 1 }
            }
        }
    }
    assert!(inside > least[0] && outside > least[1], "{inside} {outside}");
}

/// What is a little off comes back on one side of a limit, and leaves on the other. The simulation shares nothing with the
/// continuation.
#[test]
fn simulation_leaves_an_orbit_behind_its_limits() {
    let mut left = 0;
    for name in ['A', 'B', 'D'] {
        let system = two_by_two(name);
        let orbit = attracting(&system);
        for parameter in [
            ModalParameter::Excitation,
            ModalParameter::Clearance(0),
            ModalParameter::Clearance(1),
            ModalParameter::FrequencyRatio,
        ] {
            let own = parameter.of(&system);
            let range = [0.5 * own, 2.0 * own];
            for (k, direction) in
                [BranchDirection::Down, BranchDirection::Up].into_iter().enumerate()
            {
                let reach = stable_reach(&system, &orbit, parameter, range).expect("an orbit")[k];
                let Some(kind) = reach.kind else { continue };
                let settings = Settings::within(range);
                let branch = ModalBranch::follow(&system, &orbit, parameter, direction, &settings)
                    .expect("an orbit");
                assert_eq!(branch.specials[0].kind, kind);
                if kind == Bifurcation::SaddleNode || !branch.specials[0].orbit.admissible {
                    assert!(
                        !matches!(branch.end, BranchEnd::Range { .. })
                            || kind != Bifurcation::Grazing
                    );
                    continue;
                }
                // A point on either side.
                for point in branch.points.iter().filter(|point| point.passed < 2) {
                    let radius = point.orbit.spectral_radius();
                    let beyond = point.passed == 1;
                    if !point.orbit.admissible || (radius - 1.0).abs() < 0.02 {
                        continue;
                    }
                    let there = parameter.applied(&system, point.value).expect("valid");
                    let state = orbit_state(&there, &point.orbit);
                    let mut off = state;
                    off.modes[0][0] += 1e-6;
                    let mut simulation = ModalSimulation::new(&there, &off, 0.0).expect("inside");
                    simulation.run(400, u64::MAX, &mut ());
                    let away = (simulation.state().modes[0][0] - state.modes[0][0]).abs();
                    assert_eq!(
                        away > 1e-6,
                        beyond,
                        "{name} {parameter:?} {kind:?} {away:e} {radius}"
                    );
                    left += usize::from(beyond);
                }
            }
        }
    }
    assert!(left > 5, "{left}");
}
