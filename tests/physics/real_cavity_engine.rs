//! The engine in a real cavity against the reference in 77 digits, event by event: impacts, reversals, where friction
//! holds the absorber and where it gives way.

use std::f64::consts::{FRAC_PI_2, TAU};

use crate::common;
use crate::fuzz::{Dice, fuzz};
use vinesink::executor::Serial;
use vinesink::motions::{Effort, Place, motions};
use vinesink::simulation::{Impact, Observer, Reversal, Segment, Simulation};
use vinesink::system::{Cavity, Excitation, Parameters, State, System};
use vinesink_evidence::reference::{Event, Reference, real::Decimal};

/// Relative speed of an impact, a rest's duration and a gap to a wall: what is smaller belongs to the end of a
/// chattering sequence, which the engine may cut short.
const SLOW: f64 = 1e-4;
const SHORT: f64 = 1e-3;
const NARROW: f64 = 1e-9;
/// Difference from which on two trajectories are two.
const VISIBLE: f64 = 1e-6;
/// How much further than rounding once an event the engine may be from the reference: an event is some dozen
/// operations, each of which rounds, and so is the end of a period.
const ROUNDINGS: f64 = 32.0;

/// Events that no regular motion has in fifty periods.
const MOST: usize = 5000;

/// An event that is no part of the end of a chattering sequence.
#[derive(Debug, Clone, Copy)]
struct Mark {
    tau: f64,
    /// The wall of an impact, 0 for what friction does.
    side: f64,
    x: f64,
    gap: f64,
}

impl Mark {
    fn distance(&self, other: &Self) -> f64 {
        let parts = [self.tau - other.tau, self.x - other.x, self.gap - other.gap];
        parts.iter().map(|part| part.abs()).fold(0.0, f64::max)
    }
}

/// The reference's marks up to a time, after at most so many events.
fn marks(system: &System, start: State, rounding: f64, latest: f64, events: usize) -> Vec<Mark> {
    let mut reference = Reference::new(system, start, rounding);
    let (mut marks, mut rests_since) = (Vec::new(), 0.0);
    for _ in 0..events {
        let Some(event) = reference.next(latest) else { break };
        let [tau, x, v, y, u] = reference.moment();
        let gap = &x - &y;
        let off = (&Decimal::of(1.0) - &gap.abs()).to_f64();
        let [tau, x, slip, gap] = [tau, x, &v - &u, gap].map(|part| part.to_f64());
        let seen = match event {
            Event::Impact { side, loss, .. } => {
                (approach(system, side, loss, slip) > SLOW).then_some(side)
            }
            Event::Release { .. } => {
                // At the wall, to far more digits than chattering is followed by, or clearly off it.
                let clear = !(1e-39..=NARROW).contains(&off);
                (tau - rests_since > SHORT && clear).then_some(0.0)
            }
            _ => (off > NARROW).then_some(0.0),
        };
        if !matches!(event, Event::Release { .. }) {
            rests_since = tau;
        }
        if let Some(side) = seen {
            marks.push(Mark { tau, side, x, gap });
        }
    }
    marks
}

/// The relative speed before an impact, from its loss or, where little is lost, from that after it.
fn approach(system: &System, side: f64, loss: f64, after: f64) -> f64 {
    let eps = system.mass_ratio();
    let r = system.restitutions()[usize::from(side < 0.0)];
    match r < 0.5 {
        true => libm::sqrt(2.0 * (1.0 + eps) * loss / (eps * (1.0 - r * r))),
        false => after.abs() / r,
    }
}

/// What the engine tells.
#[derive(Default)]
struct Record {
    omega: f64,
    /// When each stretch begins.
    begins: Vec<f64>,
    segments: Vec<Segment>,
    impacts: Vec<Impact>,
}

impl Observer for Record {
    fn segment(&mut self, segment: &Segment) {
        self.begins.push((segment.turns as f64 * TAU + segment.phase) / self.omega);
        self.segments.push(*segment);
    }
    fn impact(&mut self, impact: &Impact) {
        self.impacts.push(*impact);
    }
}

impl Record {
    fn of(system: &System, start: State, latest: f64) -> Self {
        let mut record = Self { omega: system.frequency_ratio(), ..Self::default() };
        let mut simulation = Simulation::new(system, start, 0.0).expect("inside the cavity");
        let periods = (latest / system.period()).ceil() as u64 + 1;
        simulation.run(periods, 100_000, &mut record);
        record
    }

    /// What the engine has next to an event: when, and where bodies are at the event's time.
    fn nearest(&self, mark: &Mark) -> Mark {
        let nearest = |times: &mut dyn Iterator<Item = f64>| {
            let nearer = |a: &f64, b: &f64| (a - mark.tau).abs().total_cmp(&(b - mark.tau).abs());
            times.min_by(nearer).unwrap_or(f64::INFINITY)
        };
        let tau = match mark.side == 0.0 {
            true => nearest(&mut self.begins.iter().copied()),
            false => {
                let there = self.impacts.iter().filter(|impact| impact.side.sign() == mark.side);
                nearest(&mut there.map(|impact| impact.tau))
            }
        };
        let current = self.begins.partition_point(|begin| *begin <= mark.tau).saturating_sub(1);
        let state = self.segments[current].at(mark.tau - self.begins[current]);
        Mark { tau, x: state.x, gap: state.relative_displacement(), ..*mark }
    }
}

/// How far the engine is from the reference.
#[derive(Debug)]
struct Found {
    /// The event with the largest difference of time or displacement, and what the engine has there.
    worst: Option<(Mark, Mark)>,
    /// An impact of the engine that the reference does not have.
    invented: Option<Impact>,
}

impl Found {
    fn of(system: &System, start: State, marks: &[Mark]) -> Self {
        let last = marks.last().map_or(0.0, |mark| mark.tau);
        let record = Record::of(system, start, last);
        let pairs = marks.iter().map(|mark| (*mark, record.nearest(mark)));
        let worst = pairs.max_by(|(a, b), (c, d)| a.distance(b).total_cmp(&c.distance(d)));
        let invented = record.impacts.iter().find(|impact| {
            let fast = (impact.x_velocity_before - impact.y_velocity_before).abs() > 2.0 * SLOW;
            let known = marks.iter().any(|mark| {
                mark.side == impact.side.sign() && (mark.tau - impact.tau).abs() <= VISIBLE
            });
            fast && impact.tau < last - VISIBLE && !known
        });
        Self { worst, invented: invented.copied() }
    }

    fn agrees(&self, allowed: f64) -> bool {
        let near = self.worst.is_none_or(|(a, b)| a.distance(&b) <= allowed);
        near && self.invented.is_none()
    }
}

/// Table 1 at 8 Hz under gravity along the cavity and friction, both over `b omega0^2`.
fn table_1(clearance_mm: f64, a: f64, f: f64, [plus, minus]: [f64; 2]) -> System {
    let cavity =
        Cavity { gravity_along: a, friction_acceleration: f, restitution_difference: plus - minus };
    let restitution = 0.5 * (plus + minus);
    let ideal = common::table_1(8.0, clearance_mm).parameters();
    System::new(Parameters { restitution, cavity, ..ideal }).expect("valid")
}

/// Motions that forget what rounding does: disturbed by roundings the reference's own events move by 3e-14 to 2e-12,
/// and a spacing of numbers at the last times is 6e-14.
fn agrees_over_fifty_periods(system: &System, at_least: usize) {
    let start = State { x: 0.25, x_velocity: 0.3, y: -0.4, y_velocity: 0.6 };
    let latest = 50.0 * system.period();
    let marks = marks(system, start, 0.0, latest, MOST);
    let found = Found::of(system, start, &marks);
    assert!(marks.len() >= at_least, "{} events", marks.len());
    assert!(found.agrees(1e-10), "{found:?}");
}

#[test]
fn an_absorber_that_slides_between_impacts_is_the_references() {
    agrees_over_fifty_periods(&table_1(5.0, 0.0, 0.06, [0.6; 2]), 95);
}

#[test]
fn an_absorber_on_an_incline_between_unlike_walls_is_the_references() {
    agrees_over_fifty_periods(&table_1(7.5, 0.02, 0.03, [0.65, 0.55]), 95);
}

/// Friction carries it to and fro, and it turns before the walls.
#[test]
fn an_absorber_that_meets_no_wall_is_the_references() {
    agrees_over_fifty_periods(&table_1(7.5, 0.0, 0.06, [0.6; 2]), 95);
}

/// The oscillator shakes it loose and friction stops it again.
#[test]
fn an_absorber_that_sticks_and_slips_is_the_references() {
    agrees_over_fifty_periods(&table_1(20.0, 0.0, 0.08, [0.6; 2]), 120);
}

/// It falls back onto one wall, chatters, rests and is thrown again.
#[test]
fn an_absorber_that_bounces_on_one_wall_is_the_references() {
    agrees_over_fifty_periods(&table_1(10.0, 0.15, 0.02, [0.6, 0.05]), 350);
}

/// Friction that holds against gravity, or does not, from a hundredth of it to ten times it; level to upright; forces
/// from a fraction of the weight to many times it.
fn real_cavity(dice: &mut Dice) -> System {
    let restitutions = [0, 1].map(|_| match dice.below(5) {
        0 => dice.one_of(&[0.0, 1.0]),
        _ => dice.part(),
    });
    let weight = dice.scale(0.05, 50.0);
    let angle = match dice.below(5) {
        0 => dice.one_of(&[0.0, FRAC_PI_2]),
        _ => dice.between(0.0, FRAC_PI_2),
    };
    let friction = match dice.below(6) {
        0 => 0.0,
        _ => dice.scale(1e-2, 10.0),
    };
    let cavity = Cavity {
        gravity_along: dice.sign() * weight * libm::sin(angle),
        friction_acceleration: friction * weight * libm::sin(FRAC_PI_2 - angle),
        restitution_difference: restitutions[0] - restitutions[1],
    };
    let mass_ratio = dice.scale(1e-4, 0.5);
    System::new(Parameters {
        mass_ratio,
        damping: dice.scale(0.1, 10.0),
        restitution: 0.5 * (restitutions[0] + restitutions[1]),
        frequency_ratio: dice.scale(0.5, 2.0),
        forcing_per_clearance: dice.scale(0.1, 30.0) / mass_ratio,
        excitation: match dice.below(2) {
            0 => Excitation::BaseDisplacement,
            _ => Excitation::Force,
        },
        cavity,
    })
    .expect("in range")
}

/// On a wall without a rounding between, at rest against the oscillator or not, or anywhere in the cavity.
fn start(dice: &mut Dice) -> State {
    let x = libm::round(1024.0 * dice.between(-2.0, 2.0)) / 1024.0;
    let gap = match dice.below(4) {
        0 => dice.sign(),
        _ => dice.between(-1.0, 1.0),
    };
    let x_velocity = dice.between(-2.0, 2.0);
    let y_velocity = match dice.below(3) {
        0 => x_velocity,
        _ => dice.between(-3.0, 3.0),
    };
    State { x, x_velocity, y: x - gap, y_velocity }
}

/// Events of the reference that a case may cost, and periods.
const EVENTS: usize = 40;
const PERIODS: u64 = 8;

fn engine_and_reference(case: u64) {
    let mut dice = Dice(case);
    let (system, start) = (real_cavity(&mut dice), start(&mut dice));
    let latest = PERIODS as f64 * system.period();
    let mut exact = marks(&system, start, 0.0, latest, EVENTS);
    let peak = exact.iter().map(|mark| mark.x.abs()).fold(start.x.abs(), f64::max);
    // The engine keeps the oscillator's displacement as the sum of a steady and a free part.
    let peak = peak + system.linear_response().expect("damped").amplitude();
    let moved = marks(&system, start, f64::EPSILON * (1.0 + peak), latest, EVENTS);
    // Beyond the first event that rounding moves visibly nothing can be compared.
    let pairs = exact.iter().zip(&moved);
    let same = |(a, b): &(&Mark, &Mark)| a.side == b.side && a.distance(b) <= VISIBLE;
    let known = pairs.clone().take_while(same).count();
    let one_rounding = pairs.take(known).map(|(a, b)| a.distance(b)).fold(0.0, f64::max);
    exact.truncate(known);
    let found = Found::of(&system, start, &exact);
    let clock = f64::EPSILON * (exact.last().map_or(0.0, |mark| mark.tau) + system.period());
    let each = (PERIODS as f64 / known.max(1) as f64).max(1.0);
    let allowed = ROUNDINGS * each * (one_rounding + clock);
    assert!(
        found.agrees(allowed),
        "case {case}: {found:?} of {allowed:e}: {system:?} from {start:?}"
    );
}

#[test]
fn any_real_cavity_is_the_references() {
    fuzz(16, engine_and_reference);
}

/// Ends of sliding after which friction held the absorber, and after which it did not; the first that is not what forces
/// say: to go along, the absorber needs `(x'' - a)/(1 + eps)`, `x''` being that of the oscillator alone.
struct Holds {
    system: System,
    seen: [u32; 2],
    wrong: Option<Reversal>,
}

impl Observer for Holds {
    fn reversal(&mut self, reversal: &Reversal) {
        let (system, State { x, x_velocity, .. }) = (&self.system, reversal.state);
        let Cavity { gravity_along: a, friction_acceleration: f, .. } = system.cavity();
        let (sine, cosine) = system.excitation_amplitudes();
        let force = sine * libm::sin(reversal.phase) + cosine * libm::cos(reversal.phase);
        let loss = system.mass_ratio() * system.damping() * x_velocity;
        let needed = (force - loss - x - a) / (1.0 + system.mass_ratio());
        let after = if needed.abs() <= f { 0.0 } else { needed.signum() };
        self.seen[usize::from(after != 0.0)] += 1;
        // Of forces that nearly balance rounding decides.
        let size = sine.abs() + cosine.abs() + x.abs() + x_velocity.abs() + a.abs() + f;
        if (needed.abs() - f).abs() > 1e-12 * size && reversal.after != after {
            self.wrong = self.wrong.or(Some(*reversal));
        }
    }
}

#[test]
fn friction_holds_what_it_can_where_sliding_ends() {
    let mut seen = [0; 2];
    for case in 0..400 {
        let mut dice = Dice(case);
        let (system, start) = (real_cavity(&mut dice), start(&mut dice));
        let mut holds = Holds { system, seen: [0; 2], wrong: None };
        let mut simulation = Simulation::new(&system, start, 0.0).expect("inside the cavity");
        simulation.run(20, 500, &mut holds);
        assert!(holds.wrong.is_none(), "case {case}: {:?} {system:?}", holds.wrong);
        (0..2).for_each(|k| seen[k] += holds.seen[k]);
    }
    assert!(seen.iter().all(|count| *count > 300), "{seen:?}");
}

/// Whatever watches a trajectory measures it alike where friction turns the absorber in flight: a foot of a machine at 12 Hz,
/// the track inclined by 30 degrees, the absorber chattering on its lower wall.
#[test]
fn a_motion_that_friction_turns_is_measured_alike() {
    let (clearance, natural, mass_ratio) = (1.731e-3, TAU * 12.0, 0.01);
    let gravity = 9.806_65 / (clearance * natural * natural);
    let tilt = 30.0_f64.to_radians();
    let system = System::new(Parameters {
        mass_ratio,
        damping: 2.0,
        restitution: 0.55,
        frequency_ratio: 11.82 / 12.0,
        forcing_per_clearance: 60.0 / (400.0 * natural * natural * mass_ratio * clearance),
        excitation: Excitation::Force,
        cavity: Cavity {
            gravity_along: gravity * libm::sin(tilt),
            friction_acceleration: 0.02 * gravity * libm::cos(tilt),
            restitution_difference: 0.1,
        },
    })
    .expect("valid");
    let start = State { x: 0.0, x_velocity: 0.1, y: 0.0, y_velocity: 0.0 };
    let place = Place::with(&system, vec![start]);
    let all = motions(&[place], &Effort::over(200), &Serial).expect("inside").remove(0);
    let found = all.main().expect("one");
    assert_eq!((found.repeats_after(), found.reached().starts), (Some(1), 1));
    let mut simulation = Simulation::new(&system, start, 0.0).expect("inside");
    simulation.run(3000, u64::MAX, &mut ());
    // By the midpoint rule in steps of 1e-3 within flights: off by some 1e-7.
    let mut sampled = Squares::default();
    simulation.run(10, u64::MAX, &mut sampled);
    let rms = (sampled.sum / sampled.time).sqrt();
    let found = found.facts().rms.value;
    assert!((found / rms - 1.0).abs() < 1e-6, "{found} {rms}");
}

/// The integral of the oscillator's squared displacement.
#[derive(Default)]
struct Squares {
    sum: f64,
    time: f64,
}

impl Observer for Squares {
    fn segment(&mut self, segment: &Segment) {
        const STEP: f64 = 1e-3;
        let steps = (segment.duration / STEP).ceil();
        for k in 0..steps as u32 {
            let x = segment.at(segment.duration * (f64::from(k) + 0.5) / steps).x;
            self.sum += x * x * segment.duration / steps;
        }
        self.time += segment.duration;
    }
}
