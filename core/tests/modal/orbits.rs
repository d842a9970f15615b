//! Exact antiperiodic orbits against values of two programs that share nothing with this one, against simulation, and against
//! those of one mode and one absorber.

use vinesink_core::orbits::{ModalOrbit, antiperiodic_orbits, orbit_state, symmetric_orbits};
use vinesink_core::simulation::{Detail, ModalImpact, ModalObserver, ModalSimulation};
use vinesink_core::system::ModalSystem;

use super::cases::{EPS, OMEGA, mode, one_by_one, system, table1, two_by_two};

/// The orbit that attracts.
pub fn attracting(system: &ModalSystem) -> ModalOrbit {
    let orbits = antiperiodic_orbits(system);
    let mut stable: Vec<ModalOrbit> = orbits.iter().filter(|one| one.stable()).cloned().collect();
    assert_eq!(stable.len(), 1, "{orbits:#?}");
    stable.remove(0)
}

fn close(found: &[f64], expected: &[f64], digits: f64) {
    let off = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(found.len() == expected.len() && off < digits, "{found:?} {expected:?}: {off:e}");
}

#[test]
fn orbits_of_one_mode_have_the_known_times_speeds_and_harmonics() {
    let half = 0.5 * EPS;
    for (absorbers, times, speeds, harmonic) in [
        (vec![[EPS, 20.0, 0.6]], vec![1.979110475], vec![13.686029045], 3.57661474),
        (
            vec![[half, 20.0, 0.6], [half, 10.0, 0.6]],
            vec![2.058861207, 1.521180229],
            vec![14.039462525, 8.576268162],
            3.85682037,
        ),
    ] {
        let orbit = attracting(&table1(&[], &absorbers));
        close(&orbit.impact_times, &times, 1.1e-9);
        close(&orbit.impact_speeds, &speeds, 1.1e-9);
        close(&orbit.harmonics, &[harmonic], 1.1e-8);
    }
}

/// Two equal absorbers do not hit together.
#[test]
fn equal_absorbers_stagger() {
    let half = 0.5 * EPS;
    let orbits = antiperiodic_orbits(&table1(&[], &[[half, 20.0, 0.6], [half, 20.0, 0.6]]));
    let stable: Vec<&ModalOrbit> = orbits.iter().filter(|one| one.stable()).collect();
    assert!(!stable.is_empty(), "{orbits:#?}");
    for orbit in stable {
        // The two may be named either way.
        let mut pairs: Vec<(f64, f64)> =
            orbit.impact_times.iter().copied().zip(orbit.impact_speeds.iter().copied()).collect();
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        close(&[pairs[0].0, pairs[1].0], &[1.948949208, 2.005302273], 1.1e-9);
        close(&[pairs[0].1, pairs[1].1], &[13.756243636, 13.630702822], 1.1e-9);
        close(&orbit.harmonics, &[3.57056825], 1.1e-8);
    }
}

#[test]
fn orbits_with_further_modes_have_the_known_times_speeds_and_harmonics() {
    let absorber = [[EPS, 20.0, 0.6]];
    for (further, t, u, at_absorber, first) in [
        (vec![([6.267, 0.01], -1.0)], 1.98546345, 13.67013406, 3.60219015, 3.59655558),
        (
            vec![([6.267, 0.01], -1.0), ([17.55, 0.01], 1.0)],
            2.016788078,
            13.590394475,
            3.70125087,
            3.69628637,
        ),
    ] {
        let orbit = attracting(&table1(&further, &absorber));
        close(&orbit.impact_times, &[t], 1.1e-8);
        close(&orbit.impact_speeds, &[u], 1.1e-8);
        // Of the second a simulation says 3.701250858 as well.
        close(&orbit.harmonics_at_absorbers, &[at_absorber], 1.3e-8);
        close(&orbit.harmonics[..1], &[first], 1.1e-8);
    }
}

#[test]
fn orbits_of_two_modes_and_two_absorbers_have_the_known_multipliers() {
    for (name, times, speeds, harmonics, multiplier) in [
        (
            'A',
            [1.984319483, 1.677247264],
            [14.329945602, 7.887574432],
            [4.15140399, 0.00774446],
            0.946546,
        ),
        (
            'B',
            [1.432120461, 1.692686370],
            [8.120628411, 6.322633540],
            [3.93213970, 0.01365604],
            0.957116,
        ),
        (
            'D',
            [1.461224553, 1.182404134],
            [4.203682517, 3.467391156],
            [1.98289493, 0.04245878],
            0.936404,
        ),
    ] {
        let orbit = attracting(&two_by_two(name));
        close(&orbit.impact_times, &times, 1.1e-9);
        close(&orbit.impact_speeds, &speeds, 1.1e-9);
        close(&orbit.harmonics, &harmonics, 1.1e-8);
        let radius = orbit.spectral_radius();
        assert!((radius * radius - multiplier).abs() < 1e-6, "{name}: {}", radius * radius);
    }
}

#[test]
fn one_mode_and_one_absorber_have_the_orbits_of_the_layer_for_these() {
    for parameters in [[EPS, 1.799, 0.6, 0.958, 4.34], [0.05, 1.0, 0.5, 1.01, 1.5]] {
        let clearance = 2.5;
        let (one, several) = one_by_one(parameters, clearance);
        let mut known = symmetric_orbits(&one).expect("damped");
        let mut found = antiperiodic_orbits(&several);
        known.sort_by(|a, b| a.absorber_amplitude.total_cmp(&b.absorber_amplitude));
        found.sort_by(|a, b| a.impact_speeds[0].total_cmp(&b.impact_speeds[0]));
        assert_eq!(known.len(), found.len());
        for (known, found) in known.iter().zip(&found) {
            // The speed is four absorber amplitudes in a period.
            let speed = 4.0 * known.absorber_amplitude / several.period() * clearance;
            assert!((found.impact_speeds[0] / speed - 1.0).abs() < 1e-12);
            assert_eq!(known.orbit.attracts(), found.stable());
            let multipliers = known.orbit.multipliers.values;
            for (a, b) in multipliers.iter().zip(&found.multipliers) {
                // At a fixed phase one of them is what a section makes of a shift along the orbit.
                assert!(
                    (libm::hypot(a[0], a[1]) - libm::hypot(b[0], b[1])).abs() < 1e-9,
                    "{known:?} {found:?}"
                );
            }
        }
    }
}

#[derive(Default)]
struct Log(Vec<ModalImpact>);

impl ModalObserver for Log {
    fn detail(&self) -> Detail {
        Detail::Events
    }
    fn impact(&mut self, impact: &ModalImpact) {
        self.0.push(*impact);
    }
}

/// A simulation that starts on an orbit stays there.
#[test]
fn simulation_keeps_to_the_orbits() {
    let third = table1(&[([6.267, 0.01], -1.0), ([17.55, 0.01], 1.0)], &[[EPS, 20.0, 0.6]]);
    for system in [two_by_two('A'), two_by_two('B'), two_by_two('D'), third] {
        let orbit = attracting(&system);
        let state = orbit_state(&system, &orbit);
        let mut simulation = ModalSimulation::new(&system, &state, 0.0).expect("inside");
        let mut log = Log::default();
        simulation.run(50, u64::MAX, &mut log);
        let count = system.absorbers().len();
        assert_eq!(log.0.len(), 100 * count);
        let half = 0.5 * system.period();
        for impact in &log.0 {
            let j = impact.absorber;
            let halves = ((impact.tau - orbit.impact_times[j]) / half).round();
            let sign = if halves % 2.0 == 0.0 { 1.0 } else { -1.0 } * orbit.sides[j];
            assert!((impact.tau - orbit.impact_times[j] - halves * half).abs() < 1e-9);
            assert!((impact.y_velocity[1] - sign * orbit.impact_speeds[j]).abs() < 1e-9);
            assert_eq!(impact.side.sign(), sign);
        }
        // And what is not quite there comes back as the multipliers say.
        let mut off = state;
        off.modes[0][0] += 1e-3;
        let mut simulation = ModalSimulation::new(&system, &off, 0.0).expect("inside");
        simulation.run(400, u64::MAX, &mut ());
        let back = simulation.state();
        assert!((back.modes[0][0] - state.modes[0][0]).abs() < 1e-3 * 1e-3);
    }
}

/// With a base that moves, from its impacts alone: the simulation is the judge.
#[test]
fn a_base_that_moves_has_orbits_too() {
    let mut parameters = two_by_two('B').parameters().clone();
    parameters.base_amplitude = 0.1;
    parameters.modes[0].participation = 1.2;
    parameters.modes[1].participation = -0.4;
    parameters.modes.iter_mut().for_each(|mode| mode.forcing *= 0.3);
    let system = ModalSystem::new(parameters).expect("valid");
    let orbit = attracting(&system);
    let state = orbit_state(&system, &orbit);
    let mut simulation = ModalSimulation::new(&system, &state, 0.0).expect("inside");
    simulation.run(40, u64::MAX, &mut ());
    let (after, mut off) = (simulation.state(), 0.0_f64);
    for k in 0..2 {
        for n in 0..2 {
            off = off.max((after.modes[k][n] - state.modes[k][n]).abs());
            off = off.max((after.absorbers[k][n] - state.absorbers[k][n]).abs());
        }
    }
    assert!(off < 1e-10, "{off:e}");
    assert_eq!(simulation.impacts(), 160);
    // What a small change comes to in half a period is what the derivative says: by the largest multiplier in the end.
    let step = |size: f64, periods: u64| {
        let mut moved = state;
        moved.modes[0][1] += size;
        let mut simulation = ModalSimulation::new(&system, &moved, 0.0).expect("inside");
        simulation.run(periods, u64::MAX, &mut ());
        let at = simulation.state();
        let terms = at.modes.iter().chain(&at.absorbers).flatten();
        let from = state.modes.iter().chain(&state.absorbers).flatten();
        terms.zip(from).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
    };
    let radius = orbit.spectral_radius();
    let (early, late) = (step(1e-4, 200), step(1e-4, 400));
    assert!(
        (libm::log(late / early) / 400.0 - libm::log(radius)).abs() < 2e-3,
        "{radius} {early} {late}"
    );
}

/// A restitution that stands for residual modes which are damped out between impacts.
#[test]
fn residual_modes_act_like_a_smaller_restitution() {
    let r = vinesink_core::analysis::apparent_restitution(0.6, EPS, 2.0 * EPS);
    assert!((r - 0.5879).abs() < 5e-5, "{r}");
    let harmonic = |system: &ModalSystem| attracting(system).harmonics_at_absorbers[0];
    let residual = |further: [f64; 2]| {
        let base = table1(&[(further, -1.0)], &[[EPS, 20.0, 0.6]]);
        let mut parameters = base.parameters().clone();
        parameters.modes[1].forcing = 0.0;
        harmonic(&ModalSystem::new(parameters).expect("valid"))
    };
    let one = |restitution: f64| harmonic(&table1(&[], &[[EPS, 20.0, restitution]]));
    let expected = [
        (residual([6.267, 0.5]), 3.6538, 5.1e-5),
        (residual([20.0, 0.5]), 3.65344, 5.1e-6),
        (one(r), 3.65336, 5.1e-6),
        (one(0.6), 3.5766, 5.1e-5),
    ];
    for (found, expected, digits) in expected {
        assert!((found - expected).abs() < digits, "{found} {expected}");
    }
    // Less damping leaves something of it until the next impact.
    assert!((residual([6.267, 0.2]) / one(r) - 1.0).abs() < 1e-3);
}

/// What each impact scatters into a mode that is not forced.
#[test]
fn impacts_scatter_the_energy_of_the_formula() {
    use vinesink_core::analysis::{UnforcedMode, scattered};
    for (numbers, speed, expected) in [
        ([6.267, 0.01], 13.665984, 0.002306968),
        ([6.267, 0.2], 13.623518, 0.021005894),
        ([4.1, 0.05], 13.657073, 0.006773895),
    ] {
        let mut parameters = table1(&[(numbers, -1.0)], &[[EPS, 20.0, 0.6]]).parameters().clone();
        parameters.modes[1].forcing = 0.0;
        let system = ModalSystem::new(parameters).expect("valid");
        let orbit = attracting(&system);
        close(&orbit.impact_speeds, &[speed], 5.1e-7);
        let impulse = 2.0 * EPS * orbit.impact_speeds[0];
        let mode =
            UnforcedMode { frequency: numbers[0], damping_ratio: numbers[1], excitation: OMEGA };
        let energy = 0.5 * impulse * impulse * scattered(mode);
        assert!((energy - expected).abs() < 1.1e-9, "{energy} {expected}");
        // It is what the mode's damper takes: from the motion itself, over half a period.
        let state = orbit_state(&system, &orbit);
        struct Damper([f64; 2], f64);
        impl ModalObserver for Damper {
            fn segment(&mut self, segment: &vinesink_core::simulation::ModalSegment<'_>) {
                let pieces = (segment.duration * 8.0).ceil();
                let h = segment.duration / pieces;
                for piece in 0..pieces as u32 {
                    for (node, weight) in vinesink_core::numerics::gauss::uniform(8) {
                        let at = segment.at(h * (f64::from(piece) + 0.5 * (1.0 + node)));
                        let v = at.modes[1][1];
                        self.1 += h * weight * 2.0 * self.0[1] * self.0[0] * v * v;
                    }
                }
            }
        }
        let mut damper = Damper(numbers, 0.0);
        ModalSimulation::new(&system, &state, 0.0).expect("inside").run(10, u64::MAX, &mut damper);
        assert!((damper.1 / 20.0 / energy - 1.0).abs() < 1e-9, "{} {energy}", damper.1 / 20.0);
    }
    let ratios = [
        ([3.3, 0.03], 0.771231),
        ([2.97, 0.004], 2.087530),
        ([5.05, 0.005], 25.478039),
        ([9.2, 0.15], 1.027638),
    ];
    for ([frequency, damping_ratio], expected) in ratios {
        let found = scattered(UnforcedMode { frequency, damping_ratio, excitation: 1.01 });
        assert!((found - expected).abs() < 5.1e-7, "{found} {expected}");
    }
}

/// The law of impact sees all modes, whatever their order.
#[test]
fn modes_may_be_in_any_order() {
    let a = two_by_two('A');
    let mut parameters = a.parameters().clone();
    parameters.modes.reverse();
    let b = ModalSystem::new(parameters).expect("valid");
    let (one, other) = (attracting(&a), attracting(&b));
    close(&one.impact_times, &other.impact_times, 1e-11);
    close(&one.harmonics, &[other.harmonics[1], other.harmonics[0]], 1e-11);
    // A mode that no absorber sees changes nothing.
    let mut parameters = a.parameters().clone();
    parameters.modes.push(mode([2.2, 0.02, 1.0, 0.3], &[0.0, 0.0]));
    let seen = attracting(&ModalSystem::new(parameters).expect("valid"));
    close(&one.impact_times, &seen.impact_times, 1e-11);
    let _ = system;
}
