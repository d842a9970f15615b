//! Exact orbits of a system whose cavity is inclined, rubs, or has different ends.
//!
//! Truth, in this order: the equation of motion itself, summed as a Taylor series that shares nothing with the
//! program; closed-form identities; the theory at leading order.

use crate::common::table_1;
use crate::orbit_support::impacts_from;
use crate::orbit_support::real_cavity::{apart, cavities, defect, fly, orbits, systems, with};
use vinesink::cavity::{CavityTheory, Forcing};
use vinesink::orbits::newton::solve;
use vinesink::orbits::{
    AfterImpact, Closure, Cycle, ImpactMap, Measures, Orbit, Origin, Wall, attracting_orbits,
    two_impact_orbits,
};
use vinesink::simulation::{Impact, ImpactLog, Side, Simulation};
use vinesink::system::{Cavity, Excitation, Parameter, Parameters, System};

/// 1e-10 is what is asked of a closed orbit: rounding of 800 steps and of Newton's method are below.
#[test]
fn orbits_close_under_the_equation_of_motion() {
    let (mut seen, mut admissible, mut reversed) = (0, 0, 0);
    for system in systems() {
        for orbit in orbits(&system) {
            let (largest, motion) = defect(&system, &orbit.cycle);
            assert!(largest < 1e-10, "{largest:e} {system:?} {orbit:?}");
            // A slip or a wall missed by less than a step's rounding decides nothing; none here is.
            assert_eq!(orbit.admissibility.admissible, motion, "{system:?} {orbit:?}");
            seen += 1;
            admissible += u32::from(motion);
            reversed += u32::from(orbit.admissibility.reverses());
            assert!(!(motion && orbit.admissibility.reverses()));
        }
    }
    assert!(seen > 40 && admissible > 20 && reversed > 2, "{seen} {admissible} {reversed}");
}

/// Those that attract are found without measuring the others, of two mirror images one; where the excitation is 300 times
/// slower than the structure there are some hundred others.
#[test]
fn attracting_orbits_are_those_of_all_that_attract() {
    let slow =
        System::new(Parameters { frequency_ratio: 1.0 / 300.3, ..table_1(8.0, 0.3).parameters() });
    let mut attracting = 0;
    for system in systems().into_iter().chain([table_1(8.0, 4.0), slow.expect("a system")]) {
        let mut all: Vec<Orbit> = Vec::new();
        for orbit in orbits(&system).into_iter().filter(Orbit::attracts) {
            if !all.iter().any(|known| known.cycle.is_one_with(&orbit.cycle, 1e-6)) {
                all.push(orbit);
            }
        }
        assert_eq!(attracting_orbits(&system).expect("orbits"), all, "{system:?}");
        attracting += all.len();
    }
    assert!(attracting > 10, "{attracting}");
}

/// Every cycle with two impacts from inside that Newton's method comes to from anywhere is one of those that were counted.
#[test]
fn no_orbit_is_missed() {
    let mut random = 0.5_f64;
    let mut draw = |from: f64, to: f64| {
        random = (random * 997.0 + 0.123_456_789).fract();
        from + (to - from) * random
    };
    let mut met = 0;
    for system in systems() {
        let found = orbits(&system);
        let mut seen = vec![false; found.len()];
        for _ in 0..150 {
            let share = draw(0.05, 0.95);
            let durations = [share, 1.0 - share].map(|share| share * system.period()).to_vec();
            let phase = draw(-3.0, 3.0);
            let mut after = |wall: Wall, phase: f64| AfterImpact {
                wall,
                phase,
                x: draw(-2.0, 2.0),
                x_velocity: draw(-2.0, 2.0),
                y_velocity: wall.sign() * draw(0.1, 3.0),
            };
            let second = phase + system.frequency_ratio() * durations[0];
            let impacts = vec![after(Wall::Plus, phase), after(Wall::Minus, second)];
            let start = Cycle { closure: Closure::Repeats { periods: 1 }, impacts, durations };
            let Ok(orbit) = solve(&system, &start, Origin::Simulation) else { continue };
            if orbit.admissibility.slowest_impact <= 0.0 {
                continue;
            }
            let turned = |known: &Orbit| apart(&known.cycle.unfolded(), &orbit.cycle) < 1e-7;
            let known = found.iter().position(turned);
            seen[known.unwrap_or_else(|| panic!("{system:?} {orbit:?}"))] = true;
        }
        met += seen.iter().filter(|seen| **seen).count();
    }
    // The test is one only if most orbits are met from random starts.
    assert!(met > 40, "{met}");
}

/// `det = r_1^2 r_2^2 exp(-eps lambda T)`: the map's volume is what impacts and damper leave of it.
#[test]
fn the_period_map_has_the_determinant_of_both_impacts_and_the_damper() {
    for system in systems() {
        let map = ImpactMap::of(&system).expect("steady");
        let [r1, r2] = system.restitutions();
        let damped = libm::exp(-system.mass_ratio() * system.damping() * system.period());
        for orbit in orbits(&system) {
            let jacobian = orbit.cycle.unfolded().jacobian(&map);
            let expected = r1 * r1 * r2 * r2 * damped;
            // A determinant of numbers up to 1e2 is known to that many digits less, four times.
            let error = (jacobian.determinant() / expected - 1.0).abs();
            let size = 1.0 + jacobian.amax();
            assert!(error < 1e-14 * size * size * size, "{error:e} {system:?}");
        }
    }
}

/// The state after the next impact on `to`, by Taylor series alone.
fn mapped(system: &System, after: &AfterImpact, to: Wall, guess: f64) -> AfterImpact {
    let mut duration = guess;
    let mut end = fly(system, after, duration).0;
    for _ in 0..6 {
        let [x, v, y, u] = end;
        duration -= (x - y - to.sign()) / (v - u);
        end = fly(system, after, duration).0;
    }
    let [x, v, _, u] = end;
    let r = system.restitutions()[usize::from(to == Wall::Minus)];
    let (momentum, parting) = (v + system.mass_ratio() * u, -r * (v - u));
    let y_velocity = (momentum - parting) / (1.0 + system.mass_ratio());
    let phase = after.phase + system.frequency_ratio() * duration;
    AfterImpact { wall: to, phase, x, x_velocity: y_velocity + parting, y_velocity }
}

#[test]
fn the_jacobian_is_that_of_finite_differences() {
    let h = 1e-5;
    for system in systems() {
        let map = ImpactMap::of(&system).expect("steady");
        for orbit in orbits(&system).iter().filter(|one| one.admissibility.admissible) {
            let cycle = orbit.cycle.unfolded();
            let round = |k: usize, h: f64| {
                let mut vector = cycle.impacts[0].vector();
                vector[k] += h;
                let start = cycle.impacts[0].moved_to(&vector);
                let middle = mapped(&system, &start, Wall::Minus, cycle.durations[0]);
                mapped(&system, &middle, Wall::Plus, cycle.durations[1]).vector()
            };
            let jacobian = cycle.jacobian(&map);
            for k in 0..4 {
                let difference = (round(k, h) - round(k, -h)) / (2.0 * h);
                let error = (difference - jacobian.column(k)).amax();
                // h^2 times third derivatives, which grow with the cube of the map, and rounding over h.
                let size = 1.0 + jacobian.amax();
                assert!(error < 1e-9 * size * size * size, "{error:e} {k} {system:?}");
            }
        }
    }
}

/// What a step depends on, against differences of the systems themselves: the cavity's accelerations are over the
/// clearance.
#[test]
fn a_step_knows_what_each_parameter_does_to_it() {
    let [a, f, d] = cavities()[3];
    let system = with(&table_1(8.0, 7.5), a, f, d);
    let cycle = orbits(&system)[0].cycle.unfolded();
    for parameter in Parameter::OF_SYSTEM {
        let value = parameter.of(&system);
        let weights = parameter.derivatives(&system, value);
        for k in 0..2 {
            let step = |change: f64| {
                let there = parameter.applied(&system, value + change).expect("valid");
                let map = ImpactMap::of(&there).expect("steady");
                map.step(&cycle.impacts[k], cycle.next_wall(k), cycle.durations[k])
            };
            let h = 1e-6;
            let (here, up, down) = (step(0.0), step(h), step(-h));
            let next: nalgebra::Vector4<f64> =
                (0..5).map(|n| here.next_by_parameter[n] * weights[n]).sum();
            let gap: f64 = (0..5).map(|n| here.gap_by_parameter[n] * weights[n]).sum();
            let next_error = next - (up.next.vector() - down.next.vector()) / (2.0 * h);
            let gap_error = gap - (up.gap - down.gap) / (2.0 * h);
            // Near resonance the response turns within 1e-2 of the frequency: h^2 times 1e4, times values of 10.
            let error = next_error.amax().max(gap_error.abs());
            assert!(error < 1e-6, "{parameter:?} {k}: {error:e}");
        }
    }
}

/// The theory's stable fixed point against the attracting orbit at two mass ratios, of which one is a quarter of the
/// other: amplitude of the absorber and phase between the impacts are wrong by the first order. What remains of the ratio
/// is the second order: with friction alone the first is small.
#[test]
fn the_theory_is_wrong_by_first_order_in_the_mass_ratio() {
    let forcing = Forcing { damping: 1.799, detuning: -5.445, forcing_per_clearance: 4.3417 };
    for [a, f, d] in cavities() {
        let errors = [1.25e-4, 3.125e-5].map(|mass_ratio| {
            let system = System::new(Parameters {
                mass_ratio,
                damping: forcing.damping,
                restitution: 0.6,
                frequency_ratio: 1.0 + mass_ratio * forcing.detuning,
                forcing_per_clearance: forcing.forcing_per_clearance,
                excitation: Excitation::BaseDisplacement,
                cavity: Cavity {
                    gravity_along: a,
                    friction_acceleration: f,
                    restitution_difference: d,
                },
            })
            .expect("valid");
            let theory = CavityTheory::new(a, f, system.restitutions()).expect("valid");
            let points = theory.fixed_points(&forcing);
            let mut stable = points.iter().filter(|point| point.stable);
            let (point, None) = (stable.next().expect("one"), stable.next()) else { panic!("one") };
            let found = orbits(&system);
            assert_eq!(found.len(), points.len(), "{a} {f} {d} {mass_ratio}");
            let orbit = found.iter().find(|one| one.attracts()).expect("one");
            let cycle = orbit.cycle.unfolded();
            let way = cycle.impacts[1].state().y - cycle.impacts[0].state().y;
            let time = system.frequency_ratio() * cycle.durations[0];
            [0.5 * way - point.motion.absorber_amplitude, time - point.motion.times[0]]
        });
        for k in 0..2 {
            let ratio = errors[0][k] / errors[1][k];
            // A symmetric cavity has its impacts half a period apart in either.
            let same = errors[0][k].abs() < 1e-13;
            assert!(same || (ratio - 4.0).abs() < 0.08, "{a} {f} {d}: {errors:?}");
            assert!(same == (k == 1 && a == 0.0 && d == 0.0));
        }
    }
}

/// Friction takes what it slides: `4 eps f` in a period, with two impacts.
#[test]
fn the_energy_of_a_period_balances() {
    for system in systems() {
        let slid = 4.0 * system.mass_ratio() * system.cavity().friction_acceleration;
        for orbit in orbits(&system) {
            let energy = Measures::of(&system, &orbit.cycle).expect("steady").energy;
            assert!((energy.friction - slid).abs() < 1e-15);
            // As for the ideal cavity: rounding of a quadrature.
            assert!(energy.relative_residual < 1e-11, "{energy:?} {system:?}");
        }
    }
}

/// Far from resonance, from the lightest to an overdamped oscillator, from no restitution to all of it. With elastic
/// ends little or nothing fixes an orbit, and the search says where it cannot tell.
#[test]
fn extremes_are_searched_as_well() {
    let mut seen = 0;
    let cavities = [[0.0, 0.0], [0.01, 0.0], [0.02, 0.1], [0.3, 1.0]];
    for (mass_ratio, damping) in [(1e-5, 0.0), (1e-5, 300.0), (0.01, 2.0), (1.0, 0.0), (1.0, 30.0)]
    {
        for frequency_ratio in [0.11_f64, 0.97, 1.9, 7.3] {
            for (restitution, [a, f]) in
                [0.0, 0.5, 1.0].iter().flat_map(|r| cavities.map(|cavity| (*r, cavity)))
            {
                let stiffness = 1.0 - frequency_ratio * frequency_ratio;
                let reached = libm::hypot(stiffness, mass_ratio * damping * frequency_ratio);
                let ideal = System::new(Parameters {
                    mass_ratio,
                    damping,
                    restitution,
                    frequency_ratio,
                    // An amplitude of the oscillator of 1.3 clearances without absorber.
                    forcing_per_clearance: 1.3 * reached / mass_ratio,
                    excitation: Excitation::Force,
                    cavity: Cavity::IDEAL,
                });
                let system = with(&ideal.expect("valid"), a, f, 0.0);
                let found = two_impact_orbits(&system).expect("steady");
                let elastic = restitution == 1.0;
                assert!(found.undecided.is_empty() || elastic, "{system:?} {:?}", found.undecided);
                for orbit in &found.orbits {
                    let size = 1.0 + orbit.cycle.impacts[0].state().size();
                    assert!(defect(&system, &orbit.cycle).0 < 1e-10 * size, "{orbit:?}");
                }
                seen += found.orbits.len();
            }
        }
    }
    assert!(seen > 400, "{seen}");
}

/// The engine shares nothing with the orbits: started after an impact it comes back to each impact of a stable orbit for 20
/// periods, to those of an unstable one once, and leaves at once a cycle that is said to be no motion.
#[test]
fn the_simulation_follows_the_orbits_and_leaves_what_is_none() {
    let (mut followed, mut left) = (0, 0);
    for system in systems() {
        for orbit in orbits(&system) {
            let cycle = orbit.cycle.unfolded();
            let distance = |count: u64| {
                let impacts = impacts_from(&system, &cycle.impacts[0], count);
                let expected = cycle.impacts.iter().cycle().skip(1);
                let apart = impacts.iter().zip(expected).map(|(met, there)| {
                    let differences = [
                        met.x - there.x,
                        met.x_velocity_after - there.x_velocity,
                        met.y_velocity_after - there.y_velocity,
                    ];
                    differences.iter().fold(0.0_f64, |most, one| most.max(one.abs()))
                });
                if impacts.len() as u64 == count {
                    apart.fold(0.0, f64::max)
                } else {
                    f64::INFINITY
                }
            };
            if orbit.attracts() {
                // Rounding of 40 impacts, of which each shrinks.
                assert!(distance(40) < 1e-9, "{:e} {system:?} {orbit:?}", distance(40));
                followed += 1;
            } else if orbit.admissibility.admissible {
                assert!(distance(2) < 1e-9, "{:e} {system:?} {orbit:?}", distance(2));
                followed += 1;
            } else if !orbit.admissibility.admissible {
                assert!(distance(2) > 1e-6, "{system:?} {orbit:?}");
                left += 1;
            }
        }
    }
    assert!(followed > 35 && left > 15, "{followed} {left}");
}

/// Three impacts in a period, five in two, with two of them in a row on one wall: Newton's method takes what the simulation
/// comes to, which closes under the equation of motion. With friction the slip in between reverses: no motion of the map.
#[test]
fn cycles_of_more_impacts_are_exact_as_well() {
    for ([a, f, d], count, periods) in [
        ([0.02, 0.0, 0.0], 5, 2),
        ([0.0, 0.0, 0.1], 3, 1),
        ([-0.01, 0.0, 0.05], 3, 1),
        ([0.02, 0.01, 0.0], 5, 2),
    ] {
        let system = with(&table_1(8.0, 2.5), a, f, d);
        let start = system.linear_response().expect("damped").state(&system);
        let mut simulation = Simulation::new(&system, start, 0.0).expect("inside");
        let mut log = ImpactLog::default();
        simulation.run(600, u64::MAX, &mut log);
        let last = &log.impacts[log.impacts.len() - count - 1..];
        let whole = last[count].tau - last[0].tau;
        assert!((whole - f64::from(periods) * system.period()).abs() < 1e-6, "{a} {f} {d} {whole}");
        let after = |impact: &Impact| AfterImpact {
            wall: if impact.side == Side::Plus { Wall::Plus } else { Wall::Minus },
            phase: system.frequency_ratio() * impact.tau,
            x: impact.x,
            x_velocity: impact.x_velocity_after,
            y_velocity: impact.y_velocity_after,
        };
        let durations = last.windows(2).map(|pair| pair[1].tau - pair[0].tau).collect();
        let closure = Closure::Repeats { periods };
        let start =
            Cycle { closure, impacts: last[..count].iter().map(after).collect(), durations };
        let solved = solve(&system, &start, Origin::Simulation);
        if f == 0.0 {
            let orbit = solved.expect("converges");
            assert!(orbit.attracts() && apart(&orbit.cycle, &start) < 1e-6);
            assert!(defect(&system, &orbit.cycle).0 < 1e-10);
        } else {
            let reverses =
                |orbit: Orbit| !orbit.admissibility.admissible && orbit.admissibility.reverses();
            assert!(solved.is_ok_and(reverses));
        }
    }
}
