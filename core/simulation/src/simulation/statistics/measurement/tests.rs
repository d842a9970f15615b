use super::*;
use crate::simulation::PeriodRecord;
use crate::simulation::statistics::tests::{START, systems};
use crate::simulation::{Simulation, Stop};

/// Where flights have been left out at the beginning, the periods after are measured as if it had begun there.
#[test]
fn flights_left_out_change_nothing_of_those_after() {
    const LEFT_OUT: u64 = 7;
    for system in systems() {
        let mut simulation = Simulation::new(&system, START, 0.0).expect("inside");
        let mut later = Measurement::after(LEFT_OUT, &system, START);
        let mut whole = Measurement::begin(&system, START);
        let both = &mut (&mut later, &mut whole);
        assert_eq!(simulation.run(LEFT_OUT, u64::MAX, both), Stop::EndTime);
        let mut fresh = Measurement::begin(&system, simulation.state());
        let all = &mut (&mut (&mut later, &mut whole), &mut fresh);
        assert_eq!(simulation.run(9, u64::MAX, all), Stop::EndTime);
        let (early, late) = later.statistics().records().split_at(LEFT_OUT as usize);
        let records = whole.statistics().records();
        for (one, other) in early.iter().zip(records) {
            assert_eq!((one.peak, one.mean_square), (0.0, 0.0));
            assert_eq!((one.impacts, one.end), (other.impacts, other.end));
        }
        for (one, other) in late.iter().zip(fresh.statistics().records()) {
            let sizes = |one: &PeriodRecord| (one.peak, one.mean_square, one.impact_speed);
            assert_eq!(sizes(one), sizes(other), "{system:?}");
            assert_eq!((one.impacts, one.end), (other.impacts, other.end));
        }
        for (one, other) in late.iter().zip(&records[LEFT_OUT as usize..]) {
            assert_eq!(one.visits, other.visits, "{system:?}");
        }
    }
}

/// What is asked for on the way leaves the flight under way as it is.
#[test]
fn statistics_may_be_asked_for_on_the_way() {
    for system in systems() {
        let run = |parts: u64| {
            let mut measurement = Measurement::begin(&system, START);
            let mut simulation = Simulation::new(&system, START, 0.0).expect("inside");
            for _ in 0..parts {
                // Several flights wait then, seldom as many as are measured together.
                simulation.run(60 / parts, u64::MAX, &mut measurement);
                measurement.statistics();
            }
            measurement.statistics().clone()
        };
        let (once, often) = (run(1), run(60));
        assert_eq!(once.impacts(), often.impacts());
        // Exponentials of flights side by side are halved alike: rounding.
        assert!((often.rms() / once.rms() - 1.0).abs() < 1e-13, "{system:?}");
        assert!((often.peak() / once.peak() - 1.0).abs() < 1e-13, "{system:?}");
        let (a, b) = (often.energy().input, once.energy().input);
        assert!((a - b).abs() <= 1e-12 * once.largest_energy.max(b.abs()), "{system:?}");
    }
}
