//! Impact times against a reference of 77 decimal digits that shares no code with the engine.

use crate::common;
use std::f64::consts::TAU;

use crate::reference::{Decimal, Moment, Reference};
use vinesink::simulation::{Impact, ImpactLog, Simulation, Stop};
use vinesink::system::{State, System};

/// Parts of a period in which the reference looks for impacts.
const SCAN: f64 = 97.0;
const PERIODS: u64 = 50;

fn impacts(system: &System, start: State) -> Vec<Impact> {
    let mut simulation = Simulation::new(system, start, 0.0).expect("inside the cavity");
    let mut log = ImpactLog::default();
    assert_eq!(simulation.run(PERIODS, 10_000, &mut log), Stop::EndTime);
    log.impacts
}

fn first(start: State) -> Moment {
    Moment::start([start.x, start.x_velocity, start.y, start.y_velocity])
}

#[test]
fn impact_times_agree_with_the_multiple_precision_reference_over_fifty_periods() {
    let system = common::table_1(8.0, 7.5);
    let start = State { x: 0.25, x_velocity: 0.3, y: -0.4, y_velocity: 0.6 };
    let impacts = impacts(&system, start);
    assert!(impacts.len() > 95, "a stable 1:1 case: {} impacts", impacts.len());

    let reference = Reference::new(&system);
    let mut moment = first(start);
    let mut worst = 0.0_f64;
    for impact in &impacts {
        moment = reference.next(&moment, system.period() / SCAN);
        assert_eq!(impact.side.sign(), moment.side);
        worst = worst.max((impact.tau - moment.time.to_f64()).abs());
    }
    // A stable orbit forgets rounding; what is left is some ulps of tau = 330, 6e-14 each.
    assert!(worst < 1e-12, "largest error of an impact time: {worst:e}");
}

/// Time and state: `tau`, `x`, `x'`, `y`, `y'`.
const NUMBERS: usize = 5;
/// A change of one number that leaves 37 digits of a difference quotient right: what is left out is
/// of the order of the change, and 77 digits less 40 remain.
const CHANGE: f64 = 1e-40;

/// Flights back to the wall that they begin on, as at the end of a chattering sequence: their duration to rounding of
/// itself, where the gap that opens is far below rounding of the displacements.
#[test]
fn short_returns_take_as_long_as_in_multiple_precision() {
    let mut shortest = f64::MAX;
    for (frequency, clearance) in [(8.0, 0.3), (8.35, 2.5), (8.5, 11.5)] {
        let system = common::table_1(frequency, clearance);
        let reference = Reference::new(&system);
        for k in 9..44 {
            // All of these are doubles.
            let opening = libm::ldexp(1.0, -k);
            let start = State { x: -0.5, x_velocity: 0.25, y: -1.5, y_velocity: 0.25 + opening };
            let [impact, ..] = impacts(&system, start)[..] else { panic!("none") };
            let after = Decimal::of(impact.tau);
            let exact = reference.next_near(&first(start), &after, 1.0).time.to_f64();
            assert_eq!(impact.side.sign(), 1.0);
            // The acceleration is a difference of numbers some ten times as large.
            let error = (impact.tau - exact).abs() / exact;
            assert!(error <= 1e-14, "{frequency} Hz, {clearance} mm, 2^-{k}: {error:e}");
            shortest = shortest.min(exact);
        }
    }
    assert!(shortest < 1e-12, "{shortest:e}");
}

/// How the numbers at an impact follow those at the one before: difference quotients of the
/// reference, for each number there those of the numbers here.
type Jacobian = [[f64; NUMBERS]; NUMBERS];

fn numbers(moment: &Moment) -> [Decimal; NUMBERS] {
    let [x, v, y, u] = moment.state.clone();
    [moment.time.clone(), x, v, y, u]
}

fn jacobian(reference: &Reference, from: &Moment, to: &Moment) -> Jacobian {
    let change = Decimal::of(CHANGE);
    let after = &to.time - &from.time;
    let end = numbers(to);
    std::array::from_fn(|changed| {
        let mut near = from.clone();
        let number = match changed {
            0 => &mut near.time,
            _ => &mut near.state[changed - 1],
        };
        *number = &*number + &change;
        let later = numbers(&reference.next_near(&near, &after, to.side));
        std::array::from_fn(|k| (&(&later[k] - &end[k]) / &change).to_f64())
    })
}

/// A trajectory of the reference, and how each of its impacts follows the one before.
struct Path {
    moments: Vec<Moment>,
    jacobians: Vec<Jacobian>,
}

impl Path {
    fn new(system: &System, start: State, impacts: usize) -> Self {
        let reference = Reference::new(system);
        let mut moments = vec![first(start)];
        let mut jacobians = Vec::new();
        for k in 0..impacts {
            let to = reference.next(&moments[k], system.period() / SCAN);
            jacobians.push(jacobian(&reference, &moments[k], &to));
            moments.push(to);
        }
        Self { moments, jacobians }
    }

    /// What the motion allows a program that keeps its state in doubles: for each impact time half
    /// an ulp of every number at every earlier impact and period's end, times what becomes of it,
    /// all added up as if no two had different signs.
    fn conditioning(&self, system: &System) -> Vec<f64> {
        // The oscillator's displacement is kept as the sum of a steady and a free part.
        let steady = system.linear_response().expect("damped").amplitude();
        let times: Vec<f64> = self.moments.iter().map(|moment| moment.time.to_f64()).collect();
        let conditioning = (1..self.moments.len()).map(|k| {
            let mut row = [1.0, 0.0, 0.0, 0.0, 0.0];
            let mut sum = times[k];
            for j in (0..k).rev() {
                row = self.jacobians[j]
                    .map(|later| row.iter().zip(later).map(|(each, by)| each * by).sum());
                let [_, x, v, y, u] = numbers(&self.moments[j]).map(|number| number.to_f64().abs());
                let sizes = [TAU, steady + x, steady + v, 1.0 + x + y, u];
                let [begin, end] = [j, j + 1].map(|k| (times[k] / system.period()).floor());
                let kept = 1.0 + end - begin;
                sum += kept * (0..NUMBERS).map(|i| row[i].abs() * sizes[i]).sum::<f64>();
            }
            0.5 * f64::EPSILON * sum
        });
        conditioning.collect()
    }

    /// Largest error of a time over its conditioning, and the number of times that were compared:
    /// up to the first that doubles do not determine to [`DETERMINED`].
    fn worst(&self, system: &System, times: &[(f64, f64)]) -> (f64, usize) {
        let conditioning = self.conditioning(system);
        let determined = conditioning.iter().take_while(|part| **part < DETERMINED).count();
        let mut worst = 0.0_f64;
        for (k, (time, side)) in times.iter().take(determined).enumerate() {
            let expected = &self.moments[k + 1];
            assert_eq!(*side, expected.side, "impact {k}");
            worst = worst.max((time - expected.time.to_f64()).abs() / conditioning[k]);
        }
        (worst, determined)
    }
}

/// Beyond that error of a time, products of two changes of state, which the conditioning leaves out,
/// begin to count: they are amplified as it is squared, and 1e-10 times the amplification of one
/// flight, 1e2 where it nearly grazes, is the most that is as small as 1e-2 of it.
const DETERMINED: f64 = 1e-5;

/// Roundings of each number in a flight are not one but about fifty (three in each of some ten
/// panels, the series at both ends, the impact): of random signs and evenly spread up to half an ulp
/// they add up to the root of 50/3.
const ROUNDINGS: f64 = 4.0;

/// Table 1 at resonance with b = 7.5 mm: chaotic, 2.8 impacts per period.
fn chaotic() -> System {
    common::table_1(common::natural_frequency() / TAU, 7.5)
}

/// From nearly at rest, after a dozen periods without impact, and with an absorber under way.
const STARTS: [State; 3] = [
    State { x: 0.0, x_velocity: 0.01, y: 0.0, y_velocity: 0.0 },
    State { x: 0.0, x_velocity: 0.11, y: 0.0, y_velocity: 0.0 },
    State { x: 0.9, x_velocity: -0.4, y: 0.2, y_velocity: 0.7 },
];

/// The engine, but every impact happens `late`.
fn disturbed(system: &System, start: State, late: f64) -> Vec<(f64, f64)> {
    let end = PERIODS as f64 * system.period();
    let (mut state, mut phase, mut time) = (start, 0.0, 0.0);
    let mut times = Vec::new();
    loop {
        let mut simulation = Simulation::new(system, state, phase).expect("inside the cavity");
        let mut log = ImpactLog::default();
        simulation.run(PERIODS, 1, &mut log);
        let Some(impact) = log.impacts.first() else { return times };
        time += impact.tau - phase / system.frequency_ratio() + late;
        if time > end {
            return times;
        }
        times.push((time, impact.side.sign()));
        let x = impact.x + impact.x_velocity_before * late;
        state = State {
            x,
            x_velocity: impact.x_velocity_after,
            y: x - impact.side.sign(),
            y_velocity: impact.y_velocity_after,
        };
        phase = impact.phase + system.frequency_ratio() * late;
    }
}

#[test]
fn chaotic_impact_times_are_as_good_as_the_conditioning_of_the_motion_allows() {
    let system = chaotic();
    let mut to_the_end = 0;
    for start in STARTS {
        let times: Vec<(f64, f64)> =
            impacts(&system, start).iter().map(|impact| (impact.tau, impact.side.sign())).collect();
        let path = Path::new(&system, start, times.len());
        let (worst, determined) = path.worst(&system, &times);
        assert!(
            worst < ROUNDINGS,
            "{start:?}: {worst} times what half an ulp of each number allows"
        );
        to_the_end += usize::from(determined == times.len());

        let amplified = path.conditioning(&system)[determined - 1] / path.conditioning(&system)[0];
        assert!(
            determined > 60 && amplified > 1e6,
            "{start:?}: {amplified} in {determined} impacts"
        );

        // The bound is no formality: an engine that is late by 1e-13, an ulp of tau = 500, fails it.
        let (caught, _) = path.worst(&system, &disturbed(&system, start, 1e-13));
        assert!(caught > 4.0 * ROUNDINGS, "{start:?}: late by 1e-13 is {caught} times it");
        println!("{start:?}: {worst:.2}, late by 1e-13: {caught:.0}; {determined} impacts");
    }
    assert!(to_the_end > 0, "no start is determined for all of {PERIODS} periods");
}

/// Time is a count of periods and a phase, and the steady motion returns to its known value at the end
/// of each: after a million periods the impacts of a stable orbit come at the phases at which they came
/// before. `VINESINK_PERIODS=1000000000` looks after as many.
#[test]
fn a_million_periods_later_the_impacts_come_at_the_same_phases() {
    let wanted = std::env::var("VINESINK_PERIODS").ok().and_then(|text| text.parse().ok());
    let wanted: u64 = wanted.unwrap_or(1_000_000);
    let system = common::table_1(8.0, 7.5);
    let start = State { x: 0.25, x_velocity: 0.3, y: -0.4, y_velocity: 0.6 };
    let mut simulation = Simulation::new(&system, start, 0.0).expect("inside the cavity");
    let mut phases = |periods: u64| {
        assert_eq!(simulation.run(periods, u64::MAX, &mut ()), Stop::EndTime);
        let mut log = ImpactLog::default();
        assert_eq!(simulation.run(1, 10, &mut log), Stop::EndTime);
        let phases = log.impacts.iter().map(|impact| impact.phase);
        (phases.collect::<Vec<_>>(), simulation.impacts())
    };
    let (early, before) = phases(2000);
    let (late, after) = phases(wanted);
    assert_eq!((early.len(), late.len()), (2, 2), "{early:?} {late:?}");
    assert_eq!(after - before, 2 * (wanted + 1), "an impact was lost or added");
    for (early, late) in early.iter().zip(&late) {
        // Rounding makes the orbit a cloud of some ulps of the phase, 1e-15 each.
        assert!((early - late).abs() < 1e-13, "{early} {late}");
    }
}
