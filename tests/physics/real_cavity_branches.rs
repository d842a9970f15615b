//! Where the exact orbits of a real cavity lead: to those of the ideal one as it becomes ideal, along branches, to the
//! ends of their stretch; and that nothing of the ideal one is told of it.

use crate::common::table_1;
use crate::orbit_support::real_cavity::{apart, cavities, orbits, with};
use vinesink::orbits::branch::{BranchDirection, BranchPoint, Settings, follow};
use vinesink::orbits::newton::solve;
use vinesink::orbits::{
    Bifurcation, Closure, Cycle, FullSystem, Orbit, OrbitError, Origin, SymmetricFamily,
    attracting_orbit, symmetric_orbits,
};
use vinesink::simulation::{Simulation, Stop};
use vinesink::system::Parameter;

/// As the cavity becomes ideal each orbit goes to one of the ideal cavity, symmetric and asymmetric, in proportion to
/// what is left; down to a tilt of 1e-11.
#[test]
fn orbits_go_to_those_of_the_ideal_cavity() {
    for (ideal, count) in [(table_1(8.0, 4.2), 4), (table_1(8.0, 7.5), 2), (table_1(8.5, 20.0), 2)]
    {
        let known: Vec<Cycle> = orbits(&ideal).iter().map(|one| one.cycle.unfolded()).collect();
        assert_eq!(known.len(), count);
        for [a, f, d] in cavities() {
            let largest = |k: f64| {
                let found = orbits(&with(&ideal, a * k, f * k, d * k));
                assert_eq!(found.len(), count, "{a} {f} {d} {k}");
                let nearest = |cycle: &Cycle| {
                    let distances = found.iter().map(|one| apart(&one.cycle.unfolded(), cycle));
                    distances.fold(f64::INFINITY, f64::min)
                };
                known.iter().map(nearest).fold(0.0, f64::max)
            };
            let ratio = largest(1e-3) / largest(1e-4);
            assert!((ratio - 10.0).abs() < 0.2, "{a} {f} {d}: {ratio}");
            assert!(largest(1e-8) < 1e-6 && largest(1e-9) < 1e-7);
        }
    }
}

/// Beyond symmetry breaking the counted asymmetric orbits are those that a branch followed from there leads to.
#[test]
fn asymmetric_orbits_of_an_ideal_cavity_are_those_of_their_branch() {
    let wide = table_1(8.0, 7.5);
    let family = SymmetricFamily::of(&wide).expect("ideal");
    let breaking = family.limits.iter().find(|one| one.kind == Bifurcation::SymmetryBreaking);
    let breaking = breaking.expect("exists").clearance;
    for (factor, count) in [(1.001, 0), (0.999, 2), (0.9, 2), (0.75, 2)] {
        let there = wide.with_clearance_scaled(factor * breaking).expect("valid");
        let found = orbits(&there);
        let asymmetric: Vec<&Orbit> = found
            .iter()
            .filter(|one| matches!(one.cycle.closure, Closure::Repeats { .. }))
            .collect();
        assert_eq!(asymmetric.len(), count, "{factor}");
        if let [one, other] = asymmetric[..] {
            assert!(one.cycle.is_one_with(&other.cycle, 1e-9), "mirror images");
            let longer = one.cycle.durations[0] - one.cycle.durations[1];
            // A pitchfork: the square of the asymmetry grows with the distance.
            let scale = longer * longer / (1.0 - factor);
            assert!((20.0..25.0).contains(&scale), "{factor} {scale}");
        }
    }
}

/// With friction the symmetric orbits have a closed form of their own; without symmetry there are none, and no orbit of
/// an ideal cavity stands in for one.
#[test]
fn nothing_of_an_ideal_cavity_is_told_of_a_real_one() {
    let ideal = table_1(8.0, 7.5);
    for [a, f, d] in cavities() {
        let system = with(&ideal, a, f, d);
        assert_eq!(SymmetricFamily::of(&system), Err(OrbitError::RealCavity));
        let symmetric = symmetric_orbits(&system).expect("steady");
        if a == 0.0 && d == 0.0 {
            assert_eq!(symmetric.len(), 2);
            for orbit in &symmetric {
                assert!(orbit.orbit.convergence.residual < 1e-13, "{orbit:?}");
                // What an impact hands over is what its speed says.
                let eps = system.mass_ratio();
                let handed = eps * 1.6 / (1.0 + eps) * orbit.impact_speed;
                assert!((orbit.impulse / handed - 1.0).abs() < 1e-13);
                assert!(
                    (orbit.impact_speed / orbit.orbit.admissibility.slowest_impact - 1.0).abs()
                        < 1e-12
                );
            }
            assert!(attracting_orbit(&system).is_some());
        } else {
            assert!(symmetric.is_empty() && attracting_orbit(&system).is_none());
            let half = &symmetric_orbits(&ideal).expect("steady")[1].orbit;
            let settings = Settings::within([0.9, 1.1]);
            let refused =
                follow(&system, half, Parameter::Clearance, BranchDirection::Up, &settings);
            assert!(matches!(refused, Err(OrbitError::NotACycle { .. })), "{refused:?}");
            // Over a whole period it is a start.
            let near = with(&ideal, 0.1 * a, 0.1 * f, 0.1 * d);
            let found = solve(&near, &half.cycle, Origin::Simulation).expect("converges");
            assert!(found.attracts() && found.convergence.iterations < 8);
        }
    }
}

/// A branch over the clearance goes through the orbits that are counted there, and ends where they do.
#[test]
fn branches_lead_through_the_orbits_that_are_counted() {
    let ideal = table_1(8.0, 7.5);
    for [a, f, d] in cavities() {
        let system = with(&ideal, a, f, d);
        let start = orbits(&system).into_iter().find(|one| one.attracts()).expect("one");
        for direction in [BranchDirection::Up, BranchDirection::Down] {
            let settings = Settings::within([0.3, 3.0]);
            let branch = follow(&system, &start, Parameter::Clearance, direction, &settings);
            let branch = branch.expect("followed");
            let met = |point: &&BranchPoint| point.orbit.admissibility.slowest_impact > 0.0;
            for point in branch.points.iter().step_by(8).filter(met) {
                let there = system.with_clearance_scaled(point.value).expect("valid");
                let near = orbits(&there)
                    .iter()
                    .any(|one| apart(&one.cycle.unfolded(), &point.orbit.cycle.unfolded()) < 1e-9);
                assert!(near, "{} {direction:?}", point.value);
            }
        }
    }
}

/// The stretch of clearances around an orbit that attracts: it attracts inside next to both ends, and not outside; with
/// hardly any tilt, friction or difference the ends are those of the ideal cavity, but for the symmetry breaking, which
/// becomes imperfect.
#[test]
fn a_stretch_of_clearances_ends_where_the_orbit_does() {
    let ideal = table_1(8.0, 7.5);
    let known = FullSystem::of(&ideal).stretch().expect("attracts");
    for [a, f, d] in cavities() {
        let system = with(&ideal, a, f, d);
        let full = FullSystem::of(&system);
        let stretch = full.stretch().expect("attracts");
        let leans = |orbit: &Orbit| match orbit.cycle.durations[..] {
            [there, back] => there > back,
            _ => false,
        };
        let lean = leans(full.attracting_orbit().expect("attracts"));
        // The other half of an imperfect pitchfork leans the other way, and attracts on its own.
        let attracts = |clearance: f64| {
            let there = system.with_clearance_scaled(clearance).expect("valid");
            orbits(&there).iter().any(|orbit| orbit.attracts() && leans(orbit) == lean)
        };
        let [low, high] = stretch.clearance;
        assert!(attracts(low * 1.001) && attracts(high * 0.999) && !attracts(high * 1.001));
        // Below a symmetry breaking the asymmetric orbits attract.
        let broken = stretch.ends[0] == Some(Bifurcation::SymmetryBreaking);
        assert_eq!(attracts(low * 0.999), broken, "{stretch:?}");
        assert_eq!(broken, a == 0.0 && d == 0.0);
        let frequencies = full.frequency_limits().map(|limit| limit.expect("ends").value);
        let inside =
            frequencies[0] < system.frequency_ratio() && system.frequency_ratio() < frequencies[1];
        assert!(inside, "{frequencies:?}");
        let hardly = with(&ideal, 1e-6 * a, 1e-6 * f, 1e-6 * d);
        let [_, upper] = FullSystem::of(&hardly).stretch().expect("attracts").clearance;
        assert!((upper / known.clearance[1] - 1.0).abs() < 1e-5);
    }
}

/// Up to the tilt and the friction at which a continuation ends an orbit is counted that attracts, and simulation stays on
/// it; beyond there is none.
#[test]
fn tilt_and_friction_are_borne_up_to_their_limits() {
    let ideal = table_1(8.0, 7.5);
    let mut kinds = Vec::new();
    for [a, f, d] in [[0.0; 3]].into_iter().chain(cavities()) {
        let system = with(&ideal, a, f, d);
        let full = FullSystem::of(&system);
        let own = full.attracting_orbit().expect("attracts").cycle.unfolded();
        let [down, up] = full.tilt_limits();
        let limits = [
            (Parameter::GravityAlong, down.expect("ends"), -1.0),
            (Parameter::GravityAlong, up.expect("ends"), 1.0),
            (Parameter::FrictionAcceleration, full.friction_limit().expect("ends"), 1.0),
        ];
        for (parameter, limit, outward) in limits {
            kinds.push(limit.kind);
            let attracting = |share: f64| {
                let value =
                    limit.value + outward * share * (limit.value - parameter.of(&system)).abs();
                let there = parameter.applied(&system, value).expect("valid");
                let found = orbits(&there).into_iter().filter(Orbit::attracts);
                let nearest = found.min_by(|x, y| {
                    let [x, y] = [x, y].map(|one| apart(&one.cycle.unfolded(), &own));
                    x.total_cmp(&y)
                });
                nearest.map(|orbit| (there, orbit))
            };
            let (there, orbit) = attracting(-0.01).expect("inside of the limit");
            assert!(attracting(0.01).is_none(), "{a} {f} {d} {parameter:?} {limit:?}");
            let first = orbit.cycle.unfolded().impacts[0];
            let begin = first.phase / there.frequency_ratio();
            let mut simulation = Simulation::new(&there, first.state(), begin).expect("inside");
            let mut impacts = [300, 200].map(|periods| {
                assert_eq!(simulation.run(periods, u64::MAX, &mut ()), Stop::EndTime);
                simulation.impacts()
            });
            impacts[1] -= impacts[0];
            // The first and the last may come a rounding later.
            assert!((399..=401).contains(&impacts[1]), "{impacts:?} {parameter:?} {limit:?}");
        }
    }
    let ends = [Bifurcation::PeriodDoubling, Bifurcation::SaddleNode];
    assert!(ends.iter().all(|kind| kinds.contains(kind)), "{kinds:?}");
}
