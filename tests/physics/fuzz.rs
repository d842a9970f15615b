//! Random systems, starts and phases for the engine, random texts for the case parser: no panic, no
//! hang, nothing that is not a number, nobody outside the cavity, energy in balance, and the same
//! next impact as the slow search's.
//!
//! What comes is decided by a number, the same everywhere. Without a word from the caller a small
//! part of it runs; `VINESINK_FUZZ_SECONDS=600 cargo test --release --test physics fuzz::` goes on from there
//! for ten minutes with each target, and `VINESINK_FUZZ_CASE=NUMBER` runs one again.

use std::env;
use std::panic::catch_unwind;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use vinesink::case::Case;
use vinesink::simulation::{Impact, Measurement, Observer, Segment, Simulation, Stop};
use vinesink::system::{Cavity, Excitation, Parameters, State, System};

/// Cases of each target that always run.
const ALWAYS: u64 = 400;
/// A case takes milliseconds; one that is not over by then hangs. A busy machine is not that slow.
const HANGS: Duration = Duration::from_secs(60);

/// Numbers from a number: splitmix64.
pub(crate) struct Dice(pub(crate) u64);

impl Dice {
    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// `0 .. count`.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.next() % count as u64) as usize
    }

    /// `0 .. 1`.
    pub(crate) fn part(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.part()
    }

    /// Every order of magnitude alike.
    pub(crate) fn scale(&mut self, low: f64, high: f64) -> f64 {
        low * libm::pow(high / low, self.part())
    }

    pub(crate) fn one_of(&mut self, values: &[f64]) -> f64 {
        values[self.below(values.len())]
    }

    pub(crate) fn sign(&mut self) -> f64 {
        if self.next() & 1 == 0 { 1.0 } else { -1.0 }
    }
}

/// Cases that fail before a target is given up.
const FAILURES: usize = 20;

/// Runs cases from 0 on, `always` so many, or the one that is asked for, and watches them from another thread.
pub(crate) fn fuzz(always: u64, target: fn(u64)) {
    let number = |name| env::var(name).ok().and_then(|text| text.parse::<u64>().ok());
    let only = number("VINESINK_FUZZ_CASE");
    let seconds = Duration::from_secs(number("VINESINK_FUZZ_SECONDS").unwrap_or(0));
    let (begins, begun) = mpsc::channel();
    let worker = thread::spawn(move || {
        let started = Instant::now();
        let mut failed = Vec::new();
        for case in only.unwrap_or(0).. {
            let _ = begins.send(case);
            if catch_unwind(|| target(case)).is_err() {
                failed.push(case);
            }
            let enough = only.is_some() || case >= always && started.elapsed() >= seconds;
            if enough || failed.len() >= FAILURES {
                return (case, failed);
            }
        }
        unreachable!("numbers do not end")
    });
    let mut case = 0;
    loop {
        match begun.recv_timeout(HANGS) {
            Ok(next) => case = next,
            Err(RecvTimeoutError::Timeout) => panic!("VINESINK_FUZZ_CASE={case} hangs"),
            Err(RecvTimeoutError::Disconnected) => break,
        }
    }
    let (last, failed) = worker.join().expect("panics are caught");
    println!("cases up to {last}");
    assert!(failed.is_empty(), "VINESINK_FUZZ_CASE is one of {failed:?}");
}

/// The slowest excitation and the strongest damping `eps lambda` that come: the slow search, which
/// follows an absorber that rests on a wall or creeps along it, costs as the inverse of the one and
/// the square of the other, and beyond these a case takes minutes.
const SLOWEST: f64 = 1e-2;
const STRONGEST: f64 = 20.0;

/// From everyday numbers to the edges of what a case may say.
fn system(dice: &mut Dice) -> System {
    let everyday = dice.below(3) > 0;
    let scale = |dice: &mut Dice, usual: [f64; 2], extreme: [f64; 2]| {
        let [low, high] = if everyday { usual } else { extreme };
        dice.scale(low, high)
    };
    let mass_ratio = scale(dice, [1e-3, 0.1], [1e-9, 0.9]);
    let damping = scale(dice, [0.1, 10.0], [1e-3, 1e3]).min(STRONGEST / mass_ratio);
    let restitution = dice.part();
    let frequency_ratio = scale(dice, [0.5, 2.0], [SLOWEST, 1e3]);
    let forcing_per_clearance = scale(dice, [0.1, 100.0], [1e-8, 1e8]);
    let rarely = |dice: &mut Dice, value: f64, edges: &[f64]| match dice.below(5) {
        0 => dice.one_of(edges),
        _ => value,
    };
    System::new(Parameters {
        mass_ratio,
        damping: rarely(dice, damping, &[0.0, 2.0 / mass_ratio]),
        restitution: rarely(dice, restitution, &[0.0, 1e-9, 0.05, 0.999_999, 1.0]),
        frequency_ratio: rarely(dice, frequency_ratio, &[1.0, 1.0 + 1e-12]),
        forcing_per_clearance: rarely(dice, forcing_per_clearance, &[0.0]),
        excitation: if dice.next() & 1 == 0 {
            Excitation::BaseDisplacement
        } else {
            Excitation::Force
        },
        cavity: Cavity::IDEAL,
    })
    .expect("in range")
}

fn start(dice: &mut Dice) -> (State, f64) {
    let x = dice.sign() * dice.scale(1e-3, 10.0);
    let gap = match dice.below(4) {
        0 => dice.sign(),
        _ => dice.between(-1.0, 1.0),
    };
    let x_velocity = dice.sign() * dice.scale(1e-6, 10.0);
    let y_velocity = match dice.below(4) {
        0 => x_velocity,
        _ => dice.sign() * dice.scale(1e-6, 10.0),
    };
    let phase = match dice.below(4) {
        0 => 0.0,
        _ => dice.between(0.0, std::f64::consts::TAU),
    };
    (State { x, x_velocity, y: x - gap, y_velocity }, phase)
}

/// Impacts after which a trajectory has shown enough.
const IMPACTS: u64 = 300;
const PERIODS: u64 = 12;
/// Points of a stretch at which the cavity is looked into.
const POINTS: u32 = 12;

/// Looks into the cavity, and keeps the impacts.
struct Watch {
    complaint: Option<String>,
    impacts: Vec<Impact>,
    sticks: u64,
    /// Largest length or velocity so far, and the steady motion's: the free part holds as much.
    size: f64,
    fastest: f64,
}

impl Observer for Watch {
    fn segment(&mut self, segment: &Segment) {
        for k in 0..=POINTS {
            let state = segment.at(segment.duration * f64::from(k) / f64::from(POINTS));
            self.size = self.size.max(state.size());
            // Some dozen roundings of the largest length or velocity so far, and of the time of a
            // flight, which is a sum over its panels, a sixteenth of the faster period each. NaN is
            // not below it.
            let panels = 3.0 * segment.duration * self.fastest;
            let way = segment.duration * (state.x_velocity.abs() + state.y_velocity.abs());
            let rounding = 256.0 * (1.0 + self.size) + panels * way;
            let allowed = 1.0 + f64::EPSILON * rounding;
            let inside = state.relative_displacement().abs() <= allowed;
            if !inside && self.complaint.is_none() {
                let gap = state.relative_displacement();
                self.complaint = Some(format!("abs(w) = {gap} of {allowed} in {segment:?}"));
            }
        }
    }
    fn impact(&mut self, impact: &Impact) {
        self.impacts.push(*impact);
    }
    fn sticks(&mut self, _loss: f64) {
        self.sticks += 1;
    }
}

fn engine(case: u64) {
    let mut dice = Dice(case);
    let system = system(&mut dice);
    let (start, phase) = start(&mut dice);
    let what = format!("case {case}: {system:?} from {start:?} at {phase}");
    let mut simulation = Simulation::new(&system, start, phase).expect("inside the cavity");
    // Near an undamped resonance another form without it takes over, at a gain of 1e4.
    let steady = system.linear_response().map_or(f64::INFINITY, |steady| steady.amplitude());
    let (sine, cosine) = system.excitation_amplitudes();
    let size = start.size() + steady.min(1e4 * libm::hypot(sine, cosine));
    let fastest = system.frequency_ratio().max(1.0);
    let mut watch = Watch { complaint: None, impacts: Vec::new(), sticks: 0, size, fastest };
    let mut measurement = Measurement::begin(&system, start);
    let stop = simulation.run(PERIODS, IMPACTS, &mut (&mut watch, &mut measurement));
    let statistics = measurement.statistics();
    assert_ne!(stop, Stop::NotFinite, "{what}");
    if let Some(complaint) = watch.complaint {
        panic!("{what}: {complaint}");
    }
    for impact in &watch.impacts {
        let Impact { tau, x, x_velocity_after, y_velocity_after, loss, penetration, .. } = *impact;
        let numbers = [tau, x, x_velocity_after, y_velocity_after, loss, penetration];
        assert!(numbers.iter().all(|number| number.is_finite()), "{what}: {impact:?}");
        assert!(loss >= 0.0, "{what}: {impact:?}");
    }
    bounded(&what, &simulation, watch.sticks);
    // A window that does not begin and end with a period holds parts of other ones.
    if phase == 0.0 && stop == Stop::EndTime {
        let energy = statistics.energy();
        let residual = energy.input - energy.damper - energy.impact - energy.stored;
        // Over what goes to and fro within a period, which may be far more than what remains of it.
        let relative = residual.abs() / (watch.size * watch.size);
        assert!(relative < 1e-10, "{what}: energy {relative:e}");
    }
    same_as_the_slow_search(&what, &system, &watch.impacts);
}

/// A flight or a contact costs some evaluations, hundreds where it nearly grazes, and happens at most
/// once for each impact, contact and period. While the absorber rests on a wall or creeps along it the
/// steps are a clearance's worth of nothing over the largest acceleration that the motion's energy
/// allows: thousands in a unit of time, and with strong damping, `2 d`, as its square.
fn bounded(what: &str, simulation: &Simulation, sticks: u64) {
    let system = simulation.system();
    let stretches = simulation.periods() + 1 + simulation.impacts() + 2 * sticks;
    let damping = 1.0 + system.mass_ratio() * system.damping();
    let fastest = system.frequency_ratio().max(1.0);
    let time = (simulation.periods() + 1) as f64 * system.period();
    let most = 500.0 * stretches as f64 + 4e3 * fastest * damping * damping * time;
    let evaluations = simulation.evaluations();
    assert!(evaluations as f64 <= most, "{what}: {evaluations} evaluations of {most}");
}

fn same_as_the_slow_search(what: &str, system: &System, impacts: &[Impact]) {
    // Accelerations, from the motion's size.
    let fastest = system.frequency_ratio().max(1.0);
    let (sine, cosine) = system.excitation_amplitudes();
    let damping = system.mass_ratio() * system.damping();
    for from in impacts.iter().take(40) {
        let after = State {
            x: from.x,
            x_velocity: from.x_velocity_after,
            y: from.x - from.side.sign(),
            y_velocity: from.y_velocity_after,
        };
        let next = |slowly: bool| {
            let simulation = Simulation::new(system, after, from.phase).expect("on a wall");
            let mut simulation = if slowly { simulation.step_by_step() } else { simulation };
            simulation.next_impact(3)
        };
        let (fast, slow) = (next(false), next(true));
        let (Some(fast), Some(slow)) = (fast, slow) else {
            assert!(fast.is_none() && slow.is_none(), "{what}: {from:?}: {fast:?}, {slow:?}");
            continue;
        };
        let size = 1.0 + after.size() + slow.x.abs() + libm::hypot(sine, cosine);
        let acceleration = size * fastest * fastest * (1.0 + damping);
        let speed = (slow.x_velocity_before - slow.y_velocity_before).abs();
        let apart = (fast.tau - slow.tau).abs();
        // What rounding of the gap, and of the time in a velocity, leaves open; a graze is known to
        // the root of that.
        let open = 256.0 * f64::EPSILON * (size + slow.tau * (speed + after.y_velocity.abs()));
        let same = apart * speed <= open || apart * apart * acceleration <= open;
        assert!(same && fast.side == slow.side, "{what}: {from:?}\nfast {fast:?}\nslow {slow:?}");
    }
}

#[test]
fn the_engine_survives_anything() {
    fuzz(ALWAYS, engine);
}

/// Pieces of cases, right and wrong.
const PIECES: [&str; 40] = [
    "title = ",
    "source = ",
    "[oscillator]",
    "[absorber]",
    "[excitation]",
    "[reduced]",
    "[simulation]",
    "[report]",
    "mass = ",
    "stiffness = ",
    "damping = ",
    "damping_ratio = ",
    "mass_ratio = ",
    "clearance = ",
    "restitution = ",
    "kind = ",
    "amplitude = ",
    "frequency = ",
    "figures = ",
    "starts = ",
    "\"base-displacement\"",
    "\"force\"",
    "\"4.168 kg\"",
    "\"11.47 kN/m\"",
    "\"0.25 mm\"",
    "\"8 Hz\"",
    "1e999",
    "-0.0",
    "nan",
    "inf",
    "0x7f",
    "[[",
    "]]",
    "{",
    "\"\"\"",
    "'''",
    "\\u0000",
    "\u{feff}",
    "\r\n",
    "\u{1f980}",
];
const SHIPPED: [&str; 3] = [
    include_str!("../../cases/li2016-8p5hz-fig4c.toml"),
    include_str!("../../cases/reduced-unit-clearance.toml"),
    "",
];

/// A text that begins as a case and has been hit some times.
fn text(dice: &mut Dice) -> String {
    let mut bytes = SHIPPED[dice.below(SHIPPED.len())].as_bytes().to_vec();
    for _ in 0..=dice.below(8) {
        let at = dice.below(bytes.len() + 1);
        let length = dice.below(1 + (bytes.len() - at).min(20));
        match dice.below(6) {
            0 => drop(bytes.drain(at..at + length)),
            1 => bytes.insert(at, dice.next() as u8),
            2 => drop(bytes.splice(at..at, PIECES[dice.below(PIECES.len())].bytes())),
            3 => {
                let again = bytes[at..at + length].to_vec();
                let to = dice.below(bytes.len() + 1);
                drop(bytes.splice(to..to, again));
            }
            4 if at < bytes.len() => bytes[at] ^= 1 << dice.below(8),
            _ => bytes.insert(at, b"0123456789.-+eE\"'=[]{}#\n\t ,"[dice.below(27)]),
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

fn parser(case: u64) {
    let mut dice = Dice(case);
    let text = text(&mut dice);
    match Case::parse("fuzzed", &text) {
        Ok(case) => {
            let p = case.system().parameters();
            let numbers = [
                p.mass_ratio,
                p.damping,
                p.restitution,
                p.frequency_ratio,
                p.forcing_per_clearance,
                case.system().detuning(),
            ];
            assert!(numbers.iter().all(|number| number.is_finite()), "{p:?} from {text:?}");
        }
        Err(error) => {
            let visible = text.strip_prefix('\u{feff}').unwrap_or(&text);
            for problem in error.problems() {
                let there = visible.get(problem.span.clone());
                assert_eq!(there, Some(problem.underlined.as_str()), "{problem:?} of {text:?}");
                let lines = 1 + visible.matches('\n').count();
                assert!((1..=lines).contains(&problem.line), "{problem:?} of {text:?}");
                assert!(problem.column >= 1, "{problem:?} of {text:?}");
                assert!(!problem.message.is_empty() && !problem.expected.is_empty(), "{problem:?}");
            }
            // It is shown as it will be, in the terminal's own way.
            let shown = format!("{:?}", miette::Report::new(error));
            assert!(!shown.is_empty());
        }
    }
}

#[test]
fn the_case_parser_survives_anything() {
    fuzz(ALWAYS, parser);
}
