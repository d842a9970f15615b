//! Impacts that the fast search misses, counted flight by flight: from the state after each impact of
//! a trajectory the slow, finer search says what the next one is. Long-run averages would hide a miss.
//!
//! Starts that graze, and absorbers that cross their cavity within a panel, are aimed at.
//!
//! `VINESINK_FLIGHTS=100000000 cargo test --release --test physics missed_impacts::` checks as many flights.

use crate::common;
use std::env;

use vinesink::simulation::{Impact, Simulation};
use vinesink::system::{Cavity, Excitation, Parameters, State, System};

/// Flights without a word from the caller: a few seconds.
const FLIGHTS: u64 = 1_000_000;
/// Flights of each system before the next one.
const EACH: u64 = 2_000;
/// Periods after which a flight without impact is given up by both searches.
const PATIENCE: u64 = 50;

/// The next impact after a state.
fn next(mut simulation: Simulation) -> Option<Impact> {
    simulation.next_impact(PATIENCE)
}

/// Numbers in `0..1` that fill the unit cube evenly: multiples of roots of primes.
fn spread(index: u64, prime: f64) -> f64 {
    (0.5 + prime.sqrt() * (index + 1) as f64).fract()
}

/// Table 1 near and far from its boundaries first, then systems over the whole range, of which every third has a tilt, and some
/// of these unequal ends and friction.
fn system(index: u64) -> System {
    let shipped =
        [(8.0, 0.3), (8.0, 2.5), (8.0, 7.5), (8.0, 20.0), (8.5, 2.5), (8.5, 27.0), (8.35, 11.5)];
    if let Some((frequency, clearance)) = shipped.get(index as usize) {
        return common::table_1(*frequency, *clearance);
    }
    let log = |low: f64, high: f64, part: f64| low * libm::pow(high / low, part);
    let restitution = spread(index, 5.0);
    let cavity = match index % 3 {
        0 => Cavity {
            gravity_along: 2.0 * spread(index, 37.0) - 1.0,
            friction_acceleration: if index % 4 == 1 { 0.05 } else { 0.0 },
            restitution_difference: if index % 4 == 2 {
                0.1 * restitution.min(1.0 - restitution)
            } else {
                0.0
            },
        },
        _ => Cavity::IDEAL,
    };
    System::new(Parameters {
        mass_ratio: log(1e-5, 0.5, spread(index, 2.0)),
        damping: 10.0 * spread(index, 3.0),
        restitution,
        frequency_ratio: log(0.2, 5.0, spread(index, 7.0)),
        forcing_per_clearance: log(0.1, 1e4, spread(index, 11.0)),
        excitation: Excitation::BaseDisplacement,
        cavity,
    })
    .expect("in range")
}

/// The two searches agree on the next impact: the same wall, at the same time as far as rounding of
/// the gap, some ulps of the motion's size, determines it where the wall is met with that speed.
fn agree(fast: &Impact, slow: &Impact, start: &Impact, size: f64) -> bool {
    let apart = (fast.tau - slow.tau).abs();
    let speed = (slow.x_velocity_before - slow.y_velocity_before).abs();
    let resolved = 64.0 * f64::EPSILON * (size + slow.tau * (speed + start.x_velocity_after.abs()));
    // A grazing impact is known to the root of that; accelerations are at most about `size`.
    fast.side == slow.side && (apart * speed <= resolved || apart * apart * size <= resolved)
}

#[test]
fn no_impact_is_missed() {
    let wanted = env::var("VINESINK_FLIGHTS").ok().and_then(|text| text.parse().ok());
    let wanted: u64 = wanted.unwrap_or(FLIGHTS);
    let (mut checked, mut index, mut grazing, mut unknown) = (0, 0, 0, 0);
    while checked < wanted {
        let system = system(index);
        index += 1;
        let start = State { x: 0.0, x_velocity: 0.1, y: 0.0, y_velocity: 1.0 };
        let mut simulation = Simulation::new(&system, start, 0.0).expect("inside the cavity");
        for _ in 0..EACH {
            let Some(here) = simulation.next_impact(PATIENCE) else { break };
            // An absorber that leaves its wall more slowly than rounding can tell may as well be
            // said to touch it once more; whether it does, no search can know.
            let speeds = here.x_velocity_after.abs() + here.y_velocity_after.abs();
            let leaves = (here.x_velocity_after - here.y_velocity_after).abs();
            if leaves < 16.0 * f64::EPSILON * (1.0 + here.x.abs() + speeds) {
                unknown += 1;
                continue;
            }
            let after = State {
                x: here.x,
                x_velocity: here.x_velocity_after,
                y: here.x - here.side.sign(),
                y_velocity: here.y_velocity_after,
            };
            let begin = || Simulation::new(&system, after, here.phase).expect("on the wall");
            let (fast, slow) = (next(begin()), next(begin().step_by_step()));
            let size = 1.0
                + here.x.abs()
                + here.x_velocity_after.abs()
                + here.y_velocity_after.abs()
                + system.mass_ratio() * system.forcing_per_clearance();
            let fastest = system.frequency_ratio().max(1.0);
            let size = size * fastest * fastest;
            match (&fast, &slow) {
                (Some(fast), Some(slow)) => {
                    assert!(
                        agree(fast, slow, &here, size),
                        "{system:?}: after {here:?}\nfast {fast:?}\nslow {slow:?}"
                    );
                    let speed = (slow.x_velocity_before - slow.y_velocity_before).abs();
                    grazing += u64::from(speed < 1e-3 * size);
                }
                (None, None) => {}
                _ => panic!("{system:?}: after {here:?}\nfast {fast:?}\nslow {slow:?}"),
            }
            checked += 1;
        }
    }
    assert!(unknown * 100 < wanted, "{unknown} starts told nothing");
    println!("{checked} flights, {grazing} nearly grazing, {unknown} that rounding hides");
    assert!(
        grazing > wanted / 10_000,
        "{grazing} impacts nearly grazed: too few to prove anything"
    );
}

/// A start in the air; `part` moves the absorber's velocity between two values.
fn airborne(index: u64, part: f64) -> (State, f64) {
    let side = |prime: f64| 2.0 * spread(index, prime) - 1.0;
    let x = 3.0 * side(13.0);
    let fast = if index.is_multiple_of(4) { 30.0 } else { 3.0 };
    let start = State {
        x,
        x_velocity: 3.0 * side(17.0),
        y: x + 0.98 * side(19.0),
        y_velocity: fast * (side(23.0) + part * side(31.0)),
    };
    (start, std::f64::consts::TAU * spread(index, 29.0))
}

/// A system whose oscillator moves a few clearances, so that the absorber may graze.
fn mild(index: u64) -> System {
    let log = |low: f64, high: f64, part: f64| low * libm::pow(high / low, part);
    let mass_ratio = log(1e-3, 0.3, spread(index, 2.0));
    System::new(Parameters {
        mass_ratio,
        damping: 2.0 * spread(index, 3.0),
        restitution: spread(index, 5.0),
        frequency_ratio: log(0.3, 3.0, spread(index, 7.0)),
        forcing_per_clearance: spread(index, 11.0) / mass_ratio,
        excitation: Excitation::BaseDisplacement,
        cavity: Cavity::IDEAL,
    })
    .expect("in range")
}

/// The next impact of a start in the air, by either search.
fn both(system: &System, start: State, phase: f64) -> [Option<Impact>; 2] {
    let begin = || Simulation::new(system, start, phase).expect("inside the cavity");
    [next(begin()), next(begin().step_by_step())]
}

/// Between a start that meets a wall and one that flies past it to another lies one that grazes. It is
/// found by bisection with the slow search, and the fast one is asked on both sides of it, ever nearer:
/// there the gap has two roots in one panel, or none.
#[test]
fn no_graze_is_missed_or_invented() {
    let (mut grazes, mut pairs) = (0, 0);
    for index in 0..1200 {
        let system = mild(index);
        let slow = |part: f64| {
            let (start, phase) = airborne(index, part);
            both(&system, start, phase)[1]
        };
        // Where the next impact jumps in time or to the other wall.
        let jumps = |a: &Option<Impact>, b: &Option<Impact>| match (a, b) {
            (Some(a), Some(b)) => a.side != b.side || (a.tau - b.tau).abs() > 0.05,
            (a, b) => a.is_some() != b.is_some(),
        };
        let mut graze = None;
        for k in 0..20 {
            let (mut low, mut high) = (f64::from(k) / 20.0, f64::from(k + 1) / 20.0);
            let mut below = slow(low);
            if !jumps(&below, &slow(high)) {
                continue;
            }
            for _ in 0..46 {
                let middle = 0.5 * (low + high);
                let found = slow(middle);
                if jumps(&below, &found) {
                    high = middle;
                } else {
                    (low, below) = (middle, found);
                }
            }
            // A steep but steady change of time is no graze.
            if jumps(&below, &slow(high)) {
                graze = Some(high);
                break;
            }
        }
        let Some(graze) = graze else { continue };
        grazes += 1;
        for exponent in 3..=11 {
            for sign in [-1.0, 1.0] {
                let part = graze + sign * libm::pow(10.0, -f64::from(exponent));
                if !(0.0..=1.0).contains(&part) {
                    continue;
                }
                let (start, phase) = airborne(index, part);
                let [fast, slow] = both(&system, start, phase);
                let size = 10.0 * (1.0 + system.mass_ratio() * system.forcing_per_clearance());
                let same = match (&fast, &slow) {
                    (Some(fast), Some(slow)) => {
                        let size = size * (1.0 + slow.x.abs() + slow.y_velocity_before.abs());
                        let fastest = system.frequency_ratio().max(1.0);
                        agree(fast, slow, slow, size * fastest * fastest)
                    }
                    (None, None) => true,
                    _ => false,
                };
                assert!(same, "{index}, 1e-{exponent} from the graze: {fast:?}\n{slow:?}");
                pairs += 1;
            }
        }
    }
    assert!(
        grazes > 60 && pairs > 1000,
        "{grazes} grazes, {pairs} starts: too few to prove anything"
    );
}

/// An absorber that crosses its cavity many times within a panel meets the walls in turns.
#[test]
fn both_walls_within_one_panel_are_told_apart() {
    let mut checked = 0;
    for index in 0..400 {
        let system = mild(index);
        let (start, phase) = airborne(index, 0.5);
        let speed = libm::pow(10.0, 1.0 + 4.0 * spread(index, 37.0));
        let start = State { y_velocity: speed.copysign(start.y_velocity), ..start };
        if let [Some(fast), Some(slow)] = both(&system, start, phase) {
            let size = 10.0 + speed + system.mass_ratio() * system.forcing_per_clearance();
            assert!(agree(&fast, &slow, &slow, size), "{index}: {fast:?}\n{slow:?}");
            // A fast absorber meets the wall ahead of it.
            let after = slow.tau - phase / system.frequency_ratio();
            let ahead = if start.y_velocity > 0.0 { -1.0 } else { 1.0 };
            assert!(after > 0.05 || fast.side.sign() == ahead, "{index}: {fast:?}");
            checked += u32::from(after < 0.2);
        }
    }
    assert!(checked > 100, "{checked} met a wall within a panel");
}
