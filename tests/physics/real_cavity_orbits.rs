//! Exact orbits of a system whose cavity is inclined, rubs, or has different ends.
//!
//! Truth, in this order: the equation of motion itself, summed as a Taylor series that shares nothing with the
//! program; closed-form identities; the ideal cavity as a limit; the theory at leading order.

use crate::common::table_1;
use vinesink::cavity::{CavityTheory, Forcing};
use vinesink::orbits::branch::{BranchPoint, Direction, Settings, follow};
use vinesink::orbits::newton::solve;
use vinesink::orbits::{
    AfterImpact, Bifurcation, Closure, Cycle, FullSystem, ImpactMap, Measures, Orbit, OrbitError,
    Origin, SymmetricFamily, Wall, attracting_orbit, symmetric_orbits, two_impact_orbits,
};
use vinesink::system::{Cavity, Excitation, Parameter, Parameters, System};

/// `g/(b omega0^2)` of Table 1 at 7.5 mm.
const GRAVITY: f64 = 0.4753;

fn with(
    system: &System,
    gravity_along: f64,
    friction_acceleration: f64,
    difference: f64,
) -> System {
    let cavity =
        Cavity { gravity_along, friction_acceleration, restitution_difference: difference };
    System::new(Parameters { cavity, ..system.parameters() }).expect("valid")
}

/// Tilts up to 3 degrees, friction up to 0.1, ends up to 0.1 from their mean: each alone, and all together.
fn cavities() -> [[f64; 3]; 6] {
    let (a, f) = (0.0175 * GRAVITY, 0.05 * GRAVITY);
    [
        [a, 0.0, 0.0],
        [0.0, f, 0.0],
        [0.0, 0.0, 0.2],
        [a, f, -0.1],
        [-3.0 * a, 0.2 * f, 0.1],
        [a, 2.0 * f, 0.2],
    ]
}

fn systems() -> Vec<System> {
    let heavy = System::new(Parameters {
        mass_ratio: 0.15,
        damping: 0.8,
        restitution: 0.7,
        frequency_ratio: 0.9,
        forcing_per_clearance: 3.0,
        excitation: Excitation::Force,
        cavity: Cavity::IDEAL,
    });
    let ideal = [table_1(8.0, 7.5), table_1(8.0, 4.2), table_1(8.5, 20.0), heavy.expect("valid")];
    let of = |system: &System| cavities().map(|[a, f, d]| with(system, a, f, d));
    ideal.iter().flat_map(of).collect()
}

/// `x, x', y, y'`.
type Motion = [f64; 4];

/// Equation (1) and the absorber's, written out from the parameters, over a step from `phase`: Taylor series of 30
/// terms, whose remainder over a quarter of a radian is below `0.25^30/30!`.
fn step(system: &System, slip: f64, phase: f64, [x, v, y, u]: Motion, h: f64) -> Motion {
    let Parameters { mass_ratio: eps, damping, frequency_ratio: omega, .. } = system.parameters();
    let Cavity { gravity_along, friction_acceleration, .. } = system.cavity();
    let sine = eps * system.forcing_per_clearance();
    let cosine = match system.excitation() {
        Excitation::BaseDisplacement => eps * damping * omega * sine,
        Excitation::Force => 0.0,
    };
    let mut terms = vec![x, v];
    let mut scale = 1.0;
    for n in 0..28_u32 {
        // n-th derivative of the excitation over n!.
        let turned = phase + f64::from(n) * std::f64::consts::FRAC_PI_2;
        let force = (sine * turned.sin() + cosine * turned.cos()) * scale;
        let push = if n == 0 { eps * slip * friction_acceleration } else { 0.0 };
        let (here, next) = (terms[n as usize], terms[n as usize + 1]);
        let k = f64::from(n + 1);
        terms.push((force - push - eps * damping * k * next - here) / (k * (k + 1.0)));
        scale *= omega / k;
    }
    let x = terms.iter().rev().fold(0.0, |sum, c| sum * h + c);
    let rates = terms.iter().enumerate().skip(1).rev();
    let v = rates.fold(0.0, |sum, (k, c)| sum * h + k as f64 * c);
    let acceleration = gravity_along + slip * friction_acceleration;
    [x, v, y + u * h + 0.5 * acceleration * h * h, u + acceleration * h]
}

/// A flight by many steps: the end, and whether the absorber slides one way between the walls all along.
fn fly(system: &System, after: &AfterImpact, duration: f64) -> (Motion, bool) {
    let side = after.wall.sign();
    let slip = -side;
    let mut motion = [after.x, after.x_velocity, after.x - side, after.y_velocity];
    let steps = 400;
    let h = duration / f64::from(steps);
    let mut clean = true;
    for k in 0..steps {
        let phase = after.phase + system.frequency_ratio() * h * f64::from(k);
        motion = step(system, slip, phase, motion, h);
        let [x, v, y, u] = motion;
        let rubs = system.cavity().friction_acceleration > 0.0;
        clean &= (x - y).abs() < 1.0 + 1e-9 && (!rubs || slip * (v - u) > 0.0);
    }
    (motion, clean)
}

/// Largest defect of an orbit, round once by Taylor series and the impact's own two equations; whether all its flights
/// are clean and its impacts from inside.
fn defect(system: &System, cycle: &Cycle) -> (f64, bool) {
    let whole = cycle.unfolded();
    let eps = system.mass_ratio();
    let (mut largest, mut motion) = (0.0_f64, true);
    for (k, after) in whole.impacts.iter().enumerate() {
        let ([x, v, y, u], clean) = fly(system, after, whole.durations[k]);
        let next = whole.impacts[(k + 1) % whole.impacts.len()];
        let r = system.restitutions()[usize::from(next.wall == Wall::Minus)];
        // Momentum, and the relative velocity turned round.
        let momentum = v + eps * u;
        let parting = -r * (v - u);
        let u_after = (momentum - parting) / (1.0 + eps);
        let turns = (after.phase + system.frequency_ratio() * whole.durations[k] - next.phase)
            / std::f64::consts::TAU;
        let defects = [
            x - y - next.wall.sign(),
            x - next.x,
            u_after + parting - next.x_velocity,
            u_after - next.y_velocity,
            turns - turns.round(),
        ];
        largest = defects.iter().fold(largest, |most, one| most.max(one.abs()));
        motion &= clean && next.wall.sign() * (v - u) > 0.0;
    }
    (largest, motion)
}

fn orbits(system: &System) -> Vec<Orbit> {
    let found = two_impact_orbits(system).expect("steady");
    assert!(found.undecided.is_empty(), "{:?}", found.undecided);
    found.orbits
}

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

/// Largest difference of two cycles, whose phases may be whole turns apart.
fn apart(a: &Cycle, b: &Cycle) -> f64 {
    let pairs = a.impacts.iter().zip(&b.impacts);
    let differences = pairs.map(|(a, b)| {
        let mut difference = a.vector() - b.vector();
        difference[0] = (0.5 * difference[0]).sin();
        difference.amax()
    });
    differences.fold(0.0, f64::max)
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

/// `det = r_1^2 r_2^2 exp(-eps lambda T)`: the map's volume is what impacts and damper leave of it.
#[test]
fn the_period_map_has_the_determinant_of_both_impacts_and_the_damper() {
    for system in systems() {
        let map = ImpactMap::of(&system).expect("steady");
        let [r1, r2] = system.restitutions();
        let damped = (-system.mass_ratio() * system.damping() * system.period()).exp();
        for orbit in orbits(&system) {
            let jacobian = orbit.cycle.unfolded().jacobian(&map);
            let expected = r1 * r1 * r2 * r2 * damped;
            // A determinant of numbers up to 1e2 is known to that many digits less, four times.
            let error = (jacobian.determinant() / expected - 1.0).abs();
            assert!(error < 1e-14 * (1.0 + jacobian.amax()).powi(3), "{error:e} {system:?}");
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
                assert!(error < 1e-9 * (1.0 + jacobian.amax()).powi(3), "{error:e} {k} {system:?}");
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
                (0..4).map(|n| here.next_by_parameter[n] * weights[n]).sum();
            let gap: f64 = (0..4).map(|n| here.gap_by_parameter[n] * weights[n]).sum();
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
            let half = &symmetric_orbits(&ideal).expect("steady")[1].orbit.cycle;
            let refused = solve(&system, half, Origin::Simulation).unwrap_err();
            assert!(matches!(refused, OrbitError::NotACycle { .. }), "{refused}");
            // Written out over a whole period it is a start.
            let near = with(&ideal, 0.1 * a, 0.1 * f, 0.1 * d);
            let found = solve(&near, &half.unfolded(), Origin::Simulation).expect("converges");
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
        for direction in [Direction::Up, Direction::Down] {
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
                let reached = stiffness.hypot(mass_ratio * damping * frequency_ratio);
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
