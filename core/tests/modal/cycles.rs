//! Periodic motions by Newton's method: against simulation, against the antiperiodic orbits, and against the layer for one mode
//! and one absorber.

use std::f64::consts::TAU;

use nalgebra::DMatrix;
use vinesink_core::orbits::newton;
use vinesink_core::orbits::{
    AfterImpact, Closure, Cycle, CycleImpact, ModalCycle, ModalPeriodicOrbit, OrbitError, Origin,
    Wall, antiperiodic_orbits, orbit_state,
};
use vinesink_core::simulation::{Detail, ModalImpact, ModalObserver, ModalSimulation, Side};
use vinesink_core::system::{ModalState, ModalSystem};

use super::cases::{Draw, one_by_one, two_by_two};

/// The impacts of a stretch, and whether an absorber came to rest on a wall in it.
#[derive(Default)]
struct Seen {
    impacts: Vec<ModalImpact>,
    sticks: bool,
}

impl ModalObserver for Seen {
    fn detail(&self) -> Detail {
        Detail::Events
    }
    fn impact(&mut self, impact: &ModalImpact) {
        self.impacts.push(*impact);
    }
    fn sticks(&mut self, _absorber: usize, _loss: f64) {
        self.sticks = true;
    }
}

fn side(of: Side) -> f64 {
    if of == Side::Plus { 1.0 } else { -1.0 }
}

fn numbers(system: &ModalSystem, state: &ModalState) -> Vec<f64> {
    let modes = state.modes[..system.modes().len()].iter().flatten();
    modes.chain(state.absorbers[..system.absorbers().len()].iter().flatten()).copied().collect()
}

fn apart(system: &ModalSystem, a: &ModalState, b: &ModalState) -> f64 {
    let (a, b) = (numbers(system, a), numbers(system, b));
    let size = a.iter().fold(0.0_f64, |most, one| most.max(one.abs()));
    a.iter().zip(&b).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs())) / size
}

fn after(system: &ModalSystem, from: &ModalState, periods: u64) -> Option<(ModalState, Seen)> {
    let mut simulation = ModalSimulation::new(system, from, 0.0).ok()?;
    let mut seen = Seen::default();
    simulation.run(periods, 2000 * periods, &mut seen);
    Some((simulation.state(), seen))
}

/// The motion that a start leads to, where it nearly repeats within six periods without coming to rest on a wall.
fn nearly(system: &ModalSystem, start: &ModalState, near: f64) -> Option<ModalCycle> {
    let (mut state, _) = after(system, start, 1)?;
    for _ in 0..400 {
        let (settled, _) = after(system, &state, 20)?;
        state = settled;
        let found = (1..=6).find_map(|periods| {
            let (end, seen) = after(system, &state, periods)?;
            (apart(system, &state, &end) < near).then_some((periods, seen))
        });
        let Some((periods, seen)) = found else { continue };
        let impact = |one: &ModalImpact| CycleImpact {
            time: one.tau,
            absorber: one.absorber,
            side: side(one.side),
        };
        let usual = !seen.sticks && (1..=64).contains(&seen.impacts.len());
        return usual.then(|| ModalCycle {
            state,
            periods: periods as u32,
            impacts: seen.impacts.iter().map(impact).collect(),
        });
    }
    None
}

/// The derivative of the simulation's map by central differences.
fn by_differences(system: &ModalSystem, orbit: &ModalPeriodicOrbit) -> DMatrix<f64> {
    let count = system.modes().len();
    let own = numbers(system, &orbit.cycle.state);
    let rests = |j: usize| orbit.cycle.impacts.iter().all(|one| one.absorber != j);
    let moves = |entry: &usize| (entry / 2).checked_sub(count).is_none_or(|j| !rests(j));
    let entries: Vec<usize> = (0..own.len()).filter(moves).collect();
    let size = own.iter().fold(0.0_f64, |most, one| most.max(one.abs()));
    let step = 1e-6 * size;
    let column = |entry: usize| {
        let moved = |by: f64| {
            let mut state = orbit.cycle.state;
            let (n, part) = (entry / 2, entry % 2);
            match n < count {
                true => state.modes[n][part] += by,
                false => state.absorbers[n - count][part] += by,
            }
            let (end, _) = after(system, &state, orbit.cycle.periods.into()).expect("inside");
            numbers(system, &end)
        };
        let (up, down) = (moved(step), moved(-step));
        up.iter().zip(&down).map(|(up, down)| (up - down) / (2.0 * step)).collect::<Vec<_>>()
    };
    let columns: Vec<f64> = entries.iter().flat_map(|entry| column(*entry)).collect();
    DMatrix::from_vec(own.len(), entries.len(), columns).select_rows(&entries)
}

/// The sum of powers of multipliers, which does not ask for their order.
fn power_sum(values: &[[f64; 2]], power: u32) -> f64 {
    let each = values.iter().map(|[re, im]| {
        let times = |[a, b]: [f64; 2]| [a * re - b * im, a * im + b * re];
        (0..power).fold([1.0, 0.0], |product, _| times(product))[0]
    });
    each.sum()
}

/// Structures that nobody chose: what nearly repeats is solved for, the simulation stays on it, and the multipliers are those of
/// differences of the simulation.
#[test]
fn what_repeats_is_a_periodic_orbit_with_the_multipliers_of_the_simulation() {
    let mut draw = Draw(20_261_129);
    let (mut found, mut repel, mut several, mut longest, mut most) = (0, 0, 0, 0, 0);
    for number in 0..240 {
        let system = draw.structure();
        let mut start = ModalState::AT_REST;
        for j in 0..system.absorbers().len() {
            start.absorbers[j][0] = draw.within(-0.9, 0.9) * system.absorbers()[j].clearance;
        }
        // Far from the orbit, so that Newton's method has something to do.
        let Some(cycle) = nearly(&system, &start, 1e-4) else { continue };
        let orbit = match cycle.solve(&system) {
            Ok(orbit) => orbit,
            // An impact that fades on the way to the motion is none of it.
            Err(_) => match nearly(&system, &cycle.state, 1e-9).map(|one| one.solve(&system)) {
                Some(Ok(orbit)) => orbit,
                other => panic!("{number}: {other:?} {cycle:?}"),
            },
        };
        let orbit = match orbit.admissible {
            true => orbit,
            false => match nearly(&system, &cycle.state, 1e-9).map(|one| one.solve(&system)) {
                Some(Ok(orbit)) => orbit,
                _ => continue,
            },
        };
        assert!(orbit.admissible, "{number}: {orbit:?}");
        // What wanders passes close to motions that repel.
        repel += usize::from(!orbit.attracts());
        assert!(orbit.convergence.residual < 1e-11, "{number}: {:?}", orbit.convergence);
        let periods = orbit.cycle.periods;
        let (end, seen) = after(&system, &orbit.cycle.state, periods.into()).expect("inside");
        assert!(apart(&system, &orbit.cycle.state, &end) < 1e-10, "{number}");
        assert_eq!(seen.impacts.len(), orbit.cycle.impacts.len(), "{number}");
        for (one, other) in seen.impacts.iter().zip(&orbit.cycle.impacts) {
            assert_eq!((one.absorber, side(one.side)), (other.absorber, other.side), "{number}");
            assert!((one.tau - other.time).abs() < 1e-8, "{number}: {one:?} {other:?}");
        }
        // Differences of a motion that nearly grazes are none.
        let derivative = by_differences(&system, &orbit);
        let powers = |of: &DMatrix<f64>| [of.trace(), (of * of).trace(), (of * of * of).trace()];
        let scale = derivative.amax().max(1.0);
        let sizes = [scale, scale * scale, scale * scale * scale];
        for ((power, by_differences), size) in (1..).zip(powers(&derivative)).zip(sizes) {
            let off = (power_sum(&orbit.multipliers, power) - by_differences).abs();
            assert!(off < 1e-5 * size, "{number} {power}: {off:e} of {scale}: {orbit:?}");
        }
        found += 1;
        several += usize::from(system.absorbers().len() > 1 && system.modes().len() > 1);
        longest = longest.max(periods);
        most = most.max(orbit.cycle.impacts.len());
    }
    println!(
        "{found} orbits, {repel} that repel, {several} of several of each, up to {longest} periods and {most} impacts"
    );
    assert!(
        found > 60 && several > 15 && longest > 1 && most > 6,
        "{found} {several} {longest} {most}"
    );
}

/// An antiperiodic orbit written out: its multipliers are the squares.
#[test]
fn an_antiperiodic_orbit_is_one_of_a_whole_period() {
    for name in ['A', 'B', 'D'] {
        let system = two_by_two(name);
        let half = 0.5 * system.period();
        let orbits = antiperiodic_orbits(&system);
        assert!(!orbits.is_empty());
        for orbit in orbits {
            let impact = |later: f64, sign: f64| {
                (0..orbit.sides.len()).map(move |j| (j, later, sign)).collect::<Vec<_>>()
            };
            let both = impact(0.0, 1.0).into_iter().chain(impact(half, -1.0));
            let of = |(absorber, later, sign): (usize, f64, f64)| CycleImpact {
                time: orbit.impact_times[absorber] + later,
                absorber,
                side: sign * orbit.sides[absorber],
            };
            let mut impacts: Vec<CycleImpact> = both.map(of).collect();
            impacts.sort_by(|a, b| a.time.total_cmp(&b.time));
            let cycle = ModalCycle { state: orbit_state(&system, &orbit), periods: 1, impacts };
            let found = cycle.solve(&system).expect("an orbit");
            assert_eq!(found.admissible, orbit.admissible, "{name}");
            assert!(apart(&system, &found.cycle.state, &cycle.state) < 1e-9, "{name}");
            let squares: f64 = orbit.multipliers.iter().map(|[re, im]| re * re - im * im).sum();
            let sum: f64 = found.multipliers.iter().map(|[re, _]| re).sum();
            let scale = 1.0 + orbit.spectral_radius() * orbit.spectral_radius();
            assert!((sum - squares).abs() < 1e-7 * scale, "{name}: {sum} {squares}");
            let radius = orbit.spectral_radius();
            assert!((found.radius_per_period() - radius * radius).abs() < 1e-7 * scale, "{name}");
        }
    }
}

/// One mode and one absorber: Newton's method on the impact map finds the same motion with the same multipliers, of whatever
/// sequence of impacts.
#[test]
fn one_mode_and_one_absorber_have_the_orbits_of_the_impact_map() {
    let mut draw = Draw(77);
    let (mut found, mut others) = (0, 0);
    for _ in 0..60 {
        let parameters = [
            draw.within(0.01, 0.1),
            draw.within(0.3, 1.5),
            draw.within(0.2, 0.8),
            draw.within(0.9, 1.1),
            draw.within(0.5, 5.0),
        ];
        let clearance = 2.5;
        let (one, several) = one_by_one(parameters, clearance);
        let mut start = ModalState::AT_REST;
        start.absorbers[0][0] = draw.within(-0.9, 0.9) * clearance;
        let Some(cycle) = nearly(&several, &start, 1e-9) else { continue };
        let Ok(orbit) = cycle.solve(&several) else { continue };
        let (_, seen) =
            after(&several, &orbit.cycle.state, orbit.cycle.periods.into()).expect("inside");
        let after_impact = |one: &ModalImpact| AfterImpact {
            wall: if one.side == Side::Plus { Wall::Plus } else { Wall::Minus },
            phase: several.frequency_ratio() * one.tau,
            x: one.x / clearance,
            x_velocity: one.x_velocity[1] / clearance,
            y_velocity: one.y_velocity[1] / clearance,
        };
        let times: Vec<f64> = seen.impacts.iter().map(|one| one.tau).collect();
        let whole = f64::from(orbit.cycle.periods) * TAU / several.frequency_ratio();
        let next = times.iter().skip(1).copied().chain([times[0] + whole]);
        let impact_map = Cycle {
            closure: Closure::Repeats { periods: orbit.cycle.periods },
            impacts: seen.impacts.iter().map(after_impact).collect(),
            durations: times.iter().zip(next).map(|(one, next)| next - one).collect(),
        };
        let known = newton::solve(&one, &impact_map, Origin::Simulation).expect("an orbit");
        assert!(known.cycle.distance(&impact_map) < 1e-8);
        assert_eq!(known.admissibility.admissible, orbit.admissible);
        for n in 1..=4 {
            let [a, b] =
                [&known.multipliers.values[..], &orbit.multipliers].map(|all| power_sum(all, n));
            assert!((a - b).abs() < 1e-8 * (1.0 + a.abs()), "{n}: {a} {b}");
        }
        found += 1;
        others += usize::from(orbit.cycle.impacts.len() != 2);
    }
    println!("{found} orbits, {others} of another sequence than two impacts");
    assert!(found > 15 && others > 4, "{found} {others}");
}

#[test]
fn what_is_no_cycle_is_refused() {
    let system = two_by_two('A');
    let impact = CycleImpact { time: 1.0, absorber: 0, side: 1.0 };
    let cycle = |periods: u32, impacts: Vec<CycleImpact>| ModalCycle {
        state: ModalState::AT_REST,
        periods,
        impacts,
    };
    for wrong in [
        cycle(1, Vec::new()),
        cycle(0, vec![impact]),
        cycle(1, vec![impact; 65]),
        cycle(1, vec![CycleImpact { absorber: 2, ..impact }]),
        cycle(1, vec![CycleImpact { side: 0.5, ..impact }]),
        cycle(1, vec![CycleImpact { time: f64::NAN, ..impact }]),
    ] {
        let refused = wrong.solve(&system);
        assert!(matches!(refused, Err(OrbitError::NotACycle { .. })), "{refused:?}");
    }
    // From rest no wall is met there.
    assert!(cycle(1, vec![impact]).solve(&system).is_err());
}
