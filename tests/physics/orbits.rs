//! Exact periodic orbits of the full system.
//!
//! Truth, in this order: published check values, closed-form identities, the event-driven simulation,
//! which shares no code with the orbits.

use crate::common::table_1;
use crate::orbit_support::{simulated_half_map, simulated_impacts};
use proptest::prelude::*;
use vinesink::orbits::{
    Bifurcation, Leading, Measures, Multipliers, OrbitError, SymmetricFamily, Wall,
    symmetric_orbits,
};
use vinesink::simulation::{Measurement, Simulation};
use vinesink::system::{Cavity, Excitation, Parameters, System};

/// Half a unit of the last printed digit.
fn agrees(printed: f64, digits: i32, value: f64) -> bool {
    let unit = libm::pow(10.0, f64::from(-digits));
    (printed - value).abs() <= 0.5 * unit
}

/// Check values of the symmetric orbits: displacement at impact and peak in mm, largest multiplier.
#[test]
fn published_orbits_are_reproduced_to_all_printed_digits() {
    for (frequency, clearance, impact, peak, radius) in [
        (8.0, 7.5, -3.110, 3.562, 0.9726),
        (8.0, 15.0, -1.938, 3.364, 0.9650),
        (8.5, 20.0, -1.117, 3.587, 0.9667),
    ] {
        let orbits = symmetric_orbits(&table_1(frequency, clearance)).expect("damped");
        assert_eq!(orbits.len(), 2);
        let stable = &orbits[1];
        assert!(agrees(impact, 3, stable.impact_displacement * clearance));
        assert!(agrees(peak, 3, stable.peaks.displacement * clearance));
        assert!(agrees(radius, 4, stable.orbit.multipliers.spectral_radius()));
        assert_eq!(stable.orbit.multipliers.leading(), Leading::ComplexPair);
        assert!(stable.orbit.attracts());
        assert!(!orbits[0].orbit.attracts(), "the other root is the unstable one");
    }
}

/// Exact stability limits at 8 and 8.5 Hz, in mm.
#[test]
fn published_limits_are_reproduced_to_all_printed_digits() {
    use Bifurcation::{NeimarkSacker, SaddleNode, SymmetryBreaking};
    for (frequency, expected) in [
        (8.0, vec![(SymmetryBreaking, 4.846, true), (SaddleNode, 16.695, true)]),
        (
            8.5,
            vec![
                (SymmetryBreaking, 6.441, true),
                (NeimarkSacker, 25.219, true),
                (SaddleNode, 34.230, false),
            ],
        ),
    ] {
        let family = SymmetricFamily::of(&table_1(frequency, 10.0)).expect("damped");
        for (kind, clearance, bounds) in expected {
            let limit = family.limits.iter().find(|limit| limit.kind == kind).expect("exists");
            assert!(agrees(clearance, 3, 10.0 * limit.clearance), "{limit:?}");
            assert_eq!(limit.bounds_stability, bounds, "{limit:?}");
        }
        assert_eq!(family.stable.len(), 1);
    }
}

/// Without restitution the absorber leaves a wall only where the wall's acceleration leaves it behind;
/// with hardly any it comes back at once, next to there.
#[test]
fn a_motion_without_rebound_ends_where_the_absorber_stays_on_the_wall() {
    let at = |clearance: f64, restitution: f64| {
        let parameters = Parameters { restitution, ..table_1(8.0, clearance).parameters() };
        System::new(parameters).expect("valid")
    };
    for clearance in [7.5, 15.0] {
        let family = SymmetricFamily::of(&at(clearance, 0.0)).expect("damped");
        let [stretch] = family.stable[..] else { panic!("{family:?}") };
        let [sticking, node] = stretch.clearance.map(|factor| factor * clearance);
        assert_eq!(stretch.ends, [Bifurcation::Sticking, Bifurcation::SaddleNode].map(Some));
        let limits = family.limits.iter().filter(|limit| limit.bounds_stability);
        assert_eq!(limits.count(), 2, "{family:?}");
        for (inside, moved) in [(true, sticking * (1.0 + 1e-9)), (false, sticking * (1.0 - 1e-9))] {
            let orbits = symmetric_orbits(&at(moved, 0.0)).expect("damped");
            let orbit = &orbits.last().expect("exists").orbit;
            let departure = orbit.admissibility.slowest_departure.expect("no rebound");
            assert_eq!(orbit.attracts(), inside, "{orbit:?}");
            assert_eq!(departure > 0.0, inside, "{orbit:?}");
            assert!(departure.abs() < 1e-7, "{orbit:?}");
        }
        // A rebound r puts the grazing aside by its square root.
        for restitution in [1e-4, 1e-6] {
            let family = SymmetricFamily::of(&at(clearance, restitution)).expect("damped");
            let [stretch] = family.stable[..] else { panic!("{family:?}") };
            assert_eq!(stretch.ends, [Bifurcation::Grazing, Bifurcation::SaddleNode].map(Some));
            let [grazing, other] = stretch.clearance.map(|factor| factor * clearance);
            assert!((grazing / sticking - 1.0).abs() < 4.0 * restitution.sqrt(), "{family:?}");
            assert!((other / node - 1.0).abs() < 4.0 * restitution, "{family:?}");
        }
    }
}

/// A simulation started on an orbit comes back to it: 1e-10 over a period, in the norm of the states.
#[test]
fn a_simulation_started_on_an_orbit_follows_it() {
    for (frequency, clearance) in [(8.0, 7.5), (8.0, 15.0), (8.5, 20.0), (8.5, 30.0)] {
        let system = table_1(frequency, clearance);
        for orbit in symmetric_orbits(&system).expect("damped") {
            let impacts = simulated_impacts(&system, &orbit, 4);
            let after = orbit.orbit.cycle.unfolded();
            for (k, impact) in impacts.iter().enumerate() {
                let expected = after.impacts[(k + 1) % 2];
                // An unstable orbit multiplies rounding by its multiplier in each half period.
                let growth =
                    libm::pow(orbit.orbit.multipliers.spectral_radius().max(1.0), (k + 1) as f64);
                let tolerance = 1e-12 * growth;
                assert!(tolerance < 1e-9, "{tolerance}");
                assert!((impact.x - expected.x).abs() < tolerance, "{impact:?} {expected:?}");
                assert!((impact.x_velocity_after - expected.x_velocity).abs() < tolerance);
                assert!((impact.y_velocity_after - expected.y_velocity).abs() < tolerance);
            }
        }
    }
}

/// Multipliers against differences of the simulated half-period map.
#[test]
fn multipliers_are_those_of_the_simulated_map() {
    for (frequency, clearance) in [(8.0, 7.5), (8.0, 15.0), (8.5, 20.0), (8.5, 30.0)] {
        let system = table_1(frequency, clearance);
        for orbit in symmetric_orbits(&system).expect("damped") {
            let simulated = simulated_half_map(&system, &orbit, 1e-5);
            let exact = orbit.orbit.cycle.jacobian(&map_of(&system));
            // Central differences: h^2 times third derivatives, plus rounding over h.
            assert!((simulated - exact).amax() < 1e-6 * exact.amax(), "{simulated} {exact}");
            let simulated = Multipliers::of(&simulated).expect("finite").values;
            for (a, b) in simulated.iter().zip(orbit.orbit.multipliers.values) {
                assert!((a[0] - b[0]).abs() < 1e-6 * (1.0 + b[0].abs()), "{a:?} {b:?}");
                assert!((a[1] - b[1]).abs() < 1e-6 * (1.0 + b[0].abs()), "{a:?} {b:?}");
            }
        }
    }
}

fn map_of(system: &System) -> vinesink::orbits::ImpactMap {
    vinesink::orbits::ImpactMap::of(system).expect("damped")
}

/// Flights shrink volumes by the damping and each impact by `r^2`: the product of the multipliers of
/// half a period is `r^2 exp(-eps lambda T/2)`, whatever the orbit.
fn shrinkage(system: &System) -> f64 {
    let r = system.restitution();
    let damping = system.mass_ratio() * system.damping();
    r * r * libm::exp(-damping * 0.5 * system.period())
}

#[test]
fn an_undamped_oscillator_at_resonance_has_no_orbits_to_offer() {
    let parameters =
        Parameters { damping: 0.0, frequency_ratio: 1.0, ..table_1(8.0, 7.5).parameters() };
    let system = System::new(parameters).expect("valid");
    assert_eq!(symmetric_orbits(&system), Err(OrbitError::NoSteadyMotion));
}

fn any_system() -> impl Strategy<Value = System> {
    (
        -5.0..-0.5229f64,
        prop_oneof![4 => 0.0..=1.0, 1 => Just(0.0), 1 => Just(1.0)],
        prop_oneof![4 => 0.0..50.0, 1 => Just(0.0)],
        0.5..2.0f64,
        -2.0..2.0f64,
        any::<bool>(),
    )
        .prop_map(|(mass, restitution, damping, frequency_ratio, forcing, base)| {
            System::new(Parameters {
                mass_ratio: libm::pow(10.0, mass),
                damping,
                restitution,
                frequency_ratio,
                forcing_per_clearance: libm::pow(10.0, forcing),
                excitation: if base { Excitation::BaseDisplacement } else { Excitation::Force },
                cavity: Cavity::IDEAL,
            })
            .expect("valid")
        })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    /// Whatever the parameters: at most two orbits; each closes; the product of its multipliers is
    /// the shrinkage of volumes.
    #[test]
    fn orbits_close_and_shrink_volumes_as_they_must(system in any_system()) {
        let orbits = symmetric_orbits(&system).expect("never exactly at resonance");
        prop_assert!(orbits.len() <= 2);
        for orbit in &orbits {
            // Near a nearly undamped resonance the steady motion dwarfs the orbit.
            let linear = system.linear_response().expect("exists").amplitude();
            let scale = 1.0 + linear / (1.0 + orbit.impact_displacement.abs());
            prop_assert!(orbit.orbit.convergence.residual < 1e-13 * scale, "{orbit:?}");
            let jacobian = orbit.orbit.cycle.jacobian(&map_of(&system));
            let product = jacobian.determinant();
            // Rounding of a determinant is that of its largest products.
            let size = jacobian.amax().max(1.0);
            let noise = 1e-13 * scale * size * size;
            prop_assert!((product - shrinkage(&system)).abs() < noise, "{product} {}", shrinkage(&system));
        }
    }

    /// An admissible orbit is a motion of the simulated system, and one that is not, is none.
    #[test]
    fn simulation_agrees_on_what_is_admissible(system in any_system()) {
        for orbit in symmetric_orbits(&system).expect("never exactly at resonance") {
            let radius = orbit.orbit.multipliers.spectral_radius();
            // Beyond that a simulation cannot be expected to stay near for half a period.
            prop_assume!(radius < 1e4);
            // Too close to grazing to tell.
            prop_assume!(orbit.orbit.admissibility.min_wall_distance.abs() > 1e-6);
            prop_assume!(orbit.impact_speed * system.restitution() > 1e-6);
            let linear = system.linear_response().expect("exists").amplitude();
            let impacts = simulated_impacts(&system, &orbit, 1);
            let expected = orbit.orbit.cycle.impacts[0].mirrored(-1.0);
            let tolerance = 1e-11 * (1.0 + linear) * radius.max(1.0);
            let meets = impacts.first().is_some_and(|impact| {
                (impact.x - expected.x).abs() < tolerance
                    && (impact.y_velocity_after - expected.y_velocity).abs() < tolerance
            });
            prop_assert_eq!(meets, orbit.orbit.admissibility.admissible, "{:?} {:?}", orbit, impacts);
        }
    }
}

/// The largest multiplier governs how fast a nearby motion comes back.
#[test]
fn a_disturbed_motion_returns_at_the_rate_of_the_multiplier() {
    let system = table_1(8.0, 7.5);
    let orbit = &symmetric_orbits(&system).expect("damped")[1];
    let after = orbit.orbit.cycle.impacts[0];
    let mut start = after.state();
    start.y_velocity *= 1.0 + 1e-6;
    let mut simulation = Simulation::new(&system, start, after.phase).expect("inside");
    let distance = |simulation: &Simulation, reference: &Simulation| {
        libm::hypot(
            simulation.state().x - reference.state().x,
            simulation.state().x_velocity - reference.state().x_velocity,
        )
    };
    let undisturbed = after.state();
    let mut reference = Simulation::new(&system, undisturbed, after.phase).expect("inside");
    // A complex pair turns as it shrinks: the largest distance within a turn is compared.
    let mut largest = |periods: u64| {
        (0..periods)
            .map(|_| {
                simulation.run(1, u64::MAX, &mut ());
                reference.run(1, u64::MAX, &mut ());
                distance(&simulation, &reference)
            })
            .fold(0.0, f64::max)
    };
    let (first, _, last) = (largest(40), largest(20), largest(40));
    let rate = libm::pow(last / first, 1.0 / 120.0);
    let expected = orbit.orbit.multipliers.spectral_radius();
    // Of 120 half periods; the turn's phase moves the largest of 40 samples by a few percent.
    assert!((rate / expected - 1.0).abs() < 2e-3, "{rate} {expected}");
}

/// Averages along an orbit are those that a simulation on it measures.
#[test]
fn measures_of_an_orbit_are_those_of_its_simulation() {
    for (frequency, clearance) in [(8.0, 7.5), (8.5, 20.0)] {
        let system = table_1(frequency, clearance);
        let orbit = &symmetric_orbits(&system).expect("damped")[1];
        let exact = Measures::of(&system, &orbit.orbit.cycle).expect("damped");
        let after = orbit.orbit.cycle.impacts[0];
        let start = after.state();
        let mut simulation = Simulation::new(&system, start, after.phase).expect("on the wall");
        simulation.run(2000, u64::MAX, &mut ());
        let mut measurement = Measurement::begin(&system, simulation.state());
        simulation.run(10, u64::MAX, &mut measurement);
        let statistics = measurement.statistics();
        let close = |a: f64, b: f64| (a - b).abs() < 1e-11 * (1.0 + a.abs());
        assert!(close(exact.peaks.displacement, statistics.peak()));
        assert!(close(exact.rms, statistics.rms()));
        let (x, y) = statistics.harmonics();
        for k in 0..2 {
            assert!(close(exact.oscillator_harmonic[k], x[k]), "{exact:?} {x:?}");
            assert!(close(exact.absorber_harmonic[k], y[k]), "{exact:?} {y:?}");
        }
        let energy = statistics.energy();
        assert!(close(exact.energy.input, energy.input / 10.0), "{exact:?} {energy:?}");
        assert!(close(exact.energy.damper, energy.damper / 10.0));
        assert!(close(exact.energy.impact, energy.impact / 10.0));
        assert!(exact.energy.relative_residual < 1e-12, "{exact:?}");
    }
}

/// Derivatives of the impact map by forcing, frequency and restitution, against differences.
#[test]
fn derivatives_by_parameters_are_those_of_the_map() {
    let system = table_1(8.5, 20.0);
    let orbit = &symmetric_orbits(&system).expect("damped")[1].orbit;
    let start = orbit.cycle.impacts[0];
    let duration = orbit.cycle.durations[0];
    let step = |parameters: Parameters| {
        let map = map_of(&System::new(parameters).expect("valid"));
        map.step(&start, Wall::Minus, duration)
    };
    let base = system.parameters();
    let exact = step(base);
    let h = 1e-6;
    let varied: [fn(Parameters, f64) -> Parameters; 3] = [
        |p, h| Parameters { forcing_per_clearance: p.forcing_per_clearance + h, ..p },
        |p, h| Parameters { frequency_ratio: p.frequency_ratio + h, ..p },
        |p, h| Parameters { restitution: p.restitution + h, ..p },
    ];
    for (k, vary) in varied.iter().enumerate() {
        let (up, down) = (step(vary(base, h)), step(vary(base, -h)));
        let next = (up.next.vector() - down.next.vector()) / (2.0 * h);
        let gap = (up.gap - down.gap) / (2.0 * h);
        // The gain near resonance is some thirty: its third derivative times h^2.
        assert!((next - exact.next_by_parameter[k]).amax() < 1e-5, "{k} {next}");
        assert!((gap - exact.gap_by_parameter[k]).abs() < 1e-5, "{k} {gap}");
    }
}
/// Systems with any restitution: none, hardly any, and all of it.
fn any_restitution() -> impl Strategy<Value = f64> {
    let hardly = (-6.0..-1.301f64).prop_map(|power| libm::pow(10.0, power));
    prop_oneof![2 => Just(0.0), 3 => hardly, 2 => 0.0..=1.0]
}

/// Whether a clearance, over the system's own, is too close to a limit to tell. Beside an undamped resonance lengths are rounded at
/// the size of the steady motion: whether an absorber without rebound leaves its wall is told where it does so by more than 64 units
/// in the last place of that, at an amplitude of 5e5 from 1e-5 to 1e-4 of the clearance on, at 5e3 from 1e-7 to 1e-6.
fn next_to_a_limit(family: &SymmetricFamily, clearance: f64, amplitude: f64) -> bool {
    let told = (3e-10 * amplitude).max(1e-6);
    family.limits.iter().any(|limit| (limit.clearance / clearance - 1.0).abs() < told)
}

fn attracts_at(system: &System, clearance: f64) -> Option<Vec<f64>> {
    let there = system.with_clearance_scaled(clearance).ok()?;
    let orbits = symmetric_orbits(&there).ok()?;
    Some(
        orbits
            .iter()
            .filter(|one| one.orbit.attracts())
            .map(|one| one.absorber_amplitude)
            .collect(),
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, ..ProptestConfig::default() })]

    /// A stretch holds every clearance at which a symmetric orbit attracts, and no other.
    #[test]
    fn stretches_are_where_orbits_attract(
        mass in -3.5..-0.5229f64,
        restitution in any_restitution(),
        damping in prop_oneof![4 => 0.0..5.0, 1 => 0.0..50.0, 1 => Just(0.0)],
        frequency_ratio in prop_oneof![3 => 0.9..1.1f64, 1 => 0.5..2.0f64],
        places in proptest::collection::vec(0.0..1.0f64, 60),
    ) {
        let system = System::new(Parameters {
            mass_ratio: libm::pow(10.0, mass),
            damping,
            restitution,
            frequency_ratio,
            forcing_per_clearance: 1.0,
            excitation: Excitation::BaseDisplacement,
            cavity: Cavity::IDEAL,
        })
        .expect("valid");
        let family = SymmetricFamily::of(&system).expect("never exactly at resonance");
        // Around every limit, and in clearances from a fiftieth to fifty steady amplitudes.
        let amplitude = system.linear_response().expect("exists").amplitude();
        let mut tried: Vec<f64> = Vec::new();
        for (k, place) in places.iter().enumerate() {
            tried.push(amplitude * libm::pow(50.0, 2.0 * place - 1.0));
            if let Some(limit) = family.limits.get(k % family.limits.len().max(1)) {
                let aside = libm::pow(10.0, -5.9 + 4.9 * place);
                tried.extend([limit.clearance * (1.0 + aside), limit.clearance * (1.0 - aside)]);
            }
        }
        for clearance in tried {
            if next_to_a_limit(&family, clearance, amplitude) {
                continue;
            }
            let attracting = attracts_at(&system, clearance).expect("valid");
            prop_assert_eq!(
                family.stretch_around(clearance).is_some(),
                !attracting.is_empty(),
                "clearance {}, attracting {:?}, {:?}", clearance, attracting, family
            );
        }
    }
}
