//! The batch engine flies the trajectories of the single one, to the bit.

use crate::common;
use vinesink::simulation::{Impact, Measurement, Observer, Segment, Simulation, Stop, batch};
use vinesink::system::{Cavity, Excitation, Parameters, State, System};

/// Everything that an observer is told.
#[derive(Default, Debug, PartialEq)]
struct Diary {
    impacts: Vec<Impact>,
    /// Duration and end of every smooth stretch.
    stretches: Vec<(f64, State)>,
    sticks: Vec<f64>,
    periods: Vec<State>,
}

impl Observer for Diary {
    fn segment(&mut self, segment: &Segment) {
        self.stretches.push((segment.duration, segment.at(segment.duration)));
    }
    fn impact(&mut self, impact: &Impact) {
        self.impacts.push(*impact);
    }
    fn sticks(&mut self, loss: f64) {
        self.sticks.push(loss);
    }
    fn period(&mut self, state: &State) {
        self.periods.push(*state);
    }
}

/// Numbers in `0..1` that fill the unit cube evenly: multiples of roots of primes.
fn spread(index: u64, prime: f64) -> f64 {
    (0.5 + prime.sqrt() * (index + 1) as f64).fract()
}

fn start(index: u64) -> State {
    let x = 4.0 * (spread(index, 13.0) - 0.5);
    State {
        x,
        x_velocity: 4.0 * (spread(index, 17.0) - 0.5),
        y: x + 1.99 * (spread(index, 19.0) - 0.5),
        y_velocity: 4.0 * (spread(index, 23.0) - 0.5),
    }
}

/// Every kind: strong damping, no ringing, no damping at resonance, chatter, `r` of 0 and 1.
fn system(index: u64) -> System {
    let log = |low: f64, high: f64, part: f64| low * libm::pow(high / low, part);
    let restitution = match index % 5 {
        0 => 0.0,
        1 => 1.0,
        _ => spread(index, 5.0),
    };
    let damping = match index % 7 {
        0 => 0.0,
        1 => log(1.0, 1e4, spread(index, 3.0)),
        _ => 10.0 * spread(index, 3.0),
    };
    System::new(Parameters {
        mass_ratio: log(1e-5, 0.5, spread(index, 2.0)),
        damping,
        restitution,
        frequency_ratio: if index.is_multiple_of(3) {
            1.0
        } else {
            log(0.2, 5.0, spread(index, 7.0))
        },
        forcing_per_clearance: log(0.1, 1e4, spread(index, 11.0)),
        excitation: Excitation::BaseDisplacement,
        cavity: Cavity::IDEAL,
    })
    .expect("in range")
}

fn simulation(system: &System, index: u64) -> Simulation {
    let phase = std::f64::consts::TAU * spread(index, 29.0);
    Simulation::new(system, start(index), phase).expect("inside the cavity")
}

/// Runs them side by side and one by one, in two goes, and compares all there is.
fn agree(mut together: Vec<Simulation>, periods: u64, impact_limit: u64) {
    let mut alone = together.clone();
    let mut diaries: Vec<Diary> = together.iter().map(|_| Diary::default()).collect();
    let mut diaries_alone: Vec<Diary> = together.iter().map(|_| Diary::default()).collect();
    for _ in 0..2 {
        let stops = batch::run(&mut together, periods, impact_limit, &mut diaries);
        let stops_alone: Vec<Stop> = alone
            .iter_mut()
            .zip(&mut diaries_alone)
            .map(|(simulation, diary)| simulation.run(periods, impact_limit, diary))
            .collect();
        assert_eq!(stops, stops_alone);
    }
    for (k, (a, b)) in together.iter().zip(&alone).enumerate() {
        assert_eq!(diaries[k].impacts, diaries_alone[k].impacts, "{k}: {:?}", a.system());
        assert_eq!(diaries[k], diaries_alone[k], "{k}: {:?}", a.system());
        assert_eq!(a.state(), b.state());
        let counts = |s: &Simulation| (s.periods(), s.impacts());
        assert_eq!(counts(a), counts(b));
    }
}

#[test]
fn systems_of_every_kind_fly_side_by_side_as_they_do_alone() {
    let simulations = (0..210).map(|k| simulation(&system(k), k)).collect();
    agree(simulations, 25, 400);
}

#[test]
fn many_starts_of_one_chaotic_system_fly_side_by_side_as_they_do_alone() {
    let system = common::table_1(8.5, 27.0);
    agree((0..37).map(|k| simulation(&system, k)).collect(), 150, u64::MAX);
}

#[test]
fn chatter_and_sustained_contact_fly_side_by_side_as_they_do_alone() {
    let simulations = (0..24)
        .map(|k| simulation(&common::table_1(8.0, [0.3, 2.5, 7.5][k as usize % 3]), k))
        .collect();
    agree(simulations, 40, u64::MAX);
}

/// Systems of every kind in cavities that are tilted, rub, or have unequal ends.
fn real(index: u64) -> System {
    let mut parameters = system(index).parameters();
    let room = parameters.restitution.min(1.0 - parameters.restitution);
    parameters.cavity = Cavity {
        gravity_along: if index.is_multiple_of(2) { spread(index, 37.0) - 0.5 } else { 0.0 },
        friction_acceleration: if index % 5 == 3 { 0.05 } else { 0.0 },
        restitution_difference: if index.is_multiple_of(3) { room } else { 0.0 },
    };
    System::new(parameters).expect("in range")
}

#[test]
fn real_cavities_fly_side_by_side_as_they_do_alone() {
    let of = |systems: std::ops::Range<u64>| systems.map(|k| simulation(&real(k), k)).collect();
    agree(of(0..210), 25, 400);
    // Friction and chatter: a short return that is turned is none.
    agree(
        (0..40)
            .map(|k| {
                let cavity = Cavity { friction_acceleration: 0.02, ..Cavity::IDEAL };
                let table = common::table_1(8.0, [0.3, 2.5][k as usize % 2]);
                let system =
                    System::new(Parameters { cavity, ..table.parameters() }).expect("valid");
                simulation(&system, k)
            })
            .collect(),
        40,
        u64::MAX,
    );
}

/// A run of one period after the other is the run of all of them, to the bit, with the same words to who observes.
#[test]
fn it_does_not_matter_where_a_run_is_interrupted() {
    for k in 0..150 {
        let begin = simulation(&real(k), k);
        let (mut whole, mut parts) = (begin.clone(), begin);
        let (mut of_whole, mut of_parts) = (Diary::default(), Diary::default());
        let stop = whole.run(30, u64::MAX, &mut of_whole);
        for _ in 0..30 {
            if parts.run(1, u64::MAX, &mut of_parts) != Stop::EndTime {
                break;
            }
        }
        assert_eq!(of_whole, of_parts, "{k}");
        if stop == Stop::EndTime {
            assert_eq!(whole.state(), parts.state(), "{k}");
            assert_eq!(whole.evaluations(), parts.evaluations(), "{k}");
        }
    }
}

/// Each goes as far as its own extent says, by periods or by impacts.
#[test]
fn each_goes_as_far_as_it_is_told() {
    let mut together: Vec<Simulation> =
        (0..40).map(|k| simulation(&common::table_1(8.5, 27.0), k)).collect();
    let mut alone = together.clone();
    let extents: Vec<batch::Extent> = (0..40)
        .map(|k| batch::Extent { periods: 3 * k % 31, impacts: if k % 4 == 0 { k } else { 500 } })
        .collect();
    let mut nobody = vec![(); 40];
    let stops = batch::run_each(&mut together, &extents, &mut nobody);
    for (k, one) in alone.iter_mut().enumerate() {
        let batch::Extent { periods, impacts } = extents[k];
        assert_eq!(one.run(periods, impacts, &mut ()), stops[k], "{k}");
        assert_eq!(one.state(), together[k].state(), "{k}");
        assert_eq!((one.periods(), one.impacts()), (together[k].periods(), together[k].impacts()));
    }
    let some = |wanted: Stop| stops.iter().filter(|stop| **stop == wanted).count();
    assert!(some(Stop::EndTime) > 10 && some(Stop::ImpactLimit) > 3, "{stops:?}");
}

#[test]
fn an_empty_batch_and_one_of_a_single_trajectory_are_batches() {
    agree(Vec::new(), 10, 10);
    agree(vec![simulation(&system(3), 3)], 10, u64::MAX);
    agree(vec![simulation(&system(3), 3)], 0, u64::MAX);
    agree(vec![simulation(&system(3), 3)], 10, 0);
}

/// The observer that reports are made of says the same of either.
#[test]
fn statistics_are_the_same_side_by_side() {
    let system = common::table_1(8.5, 27.0);
    let mut together: Vec<_> = (0..11).map(|k| simulation(&system, k)).collect();
    let mut alone = together.clone();
    let observer = |s: &Simulation| Measurement::begin(&system, s.state());
    let mut measurements: Vec<Measurement> = together.iter().map(observer).collect();
    batch::run(&mut together, 60, u64::MAX, &mut measurements);
    for (k, simulation) in alone.iter_mut().enumerate() {
        let mut own = Measurement::begin(&system, simulation.state());
        simulation.run(60, u64::MAX, &mut own);
        let (own, other) = (own.statistics(), measurements[k].statistics());
        assert_eq!(own.energy(), other.energy());
        assert_eq!(own.records(), other.records());
        assert_eq!((own.rms(), own.peak()), (other.rms(), other.peak()));
    }
}
