use super::*;
use crate::simulation::PeriodRecord;
use crate::simulation::statistics::tests::{START, systems};
use crate::simulation::{Simulation, Stop};

/// Against every stretch integrated.
#[test]
fn impacts_alone_say_what_flights_do() {
    let (mut in_contact, mut without) = (0, 0);
    for system in systems() {
        let mut both =
            (Measurement::of_impacts(&system, START), Measurement::begin(&system, START));
        without += u32::from(both.0.telescope.is_none());
        let mut simulation = Simulation::new(&system, START, 0.0).expect("inside");
        let (of_impacts, in_full) = (&mut both.0, &mut both.1);
        assert_eq!(simulation.run(60, u64::MAX, &mut (of_impacts, in_full)), Stop::EndTime);
        let (mut of_impacts, mut in_full) = both;
        let statistics = in_full.statistics();
        in_contact += u32::from(statistics.sustained_contact().intervals > 0);
        // The antiderivative is as large as the phasors squared over the damping, and is rounded
        // some ten times at each of two ends.
        let size = statistics.records().iter().map(|record| record.end.size()).fold(1.0, f64::max);
        let steady = system.linear_response().map_or(0.0, |response| response.amplitude());
        let phasors = (size + steady) * (size + steady);
        let damping = 2.0 * system.mass_ratio() * system.damping();
        let rounded = 40.0 * f64::EPSILON * phasors / damping.max(1e-4);
        for (one, other) in of_impacts.statistics().records().iter().zip(statistics.records()) {
            assert_eq!(
                (one.impacts, one.visits, one.end),
                (other.impacts, other.visits, other.end)
            );
            let (a, b) = (one.mean_square, other.mean_square);
            let visits = f64::from(one.impacts[0] + one.impacts[1] + 1);
            assert!((a - b).abs() <= visits * rounded + 1e-13 * b, "{a} {b} {rounded} {system:?}");
            assert_eq!(one.impact_speed, other.impact_speed);
            let (a, b) = (one.peak, other.peak);
            assert!((a - b).abs() <= 1e-13 * (size + steady), "{a} {b} {system:?}");
        }
        assert!((of_impacts.statistics().peak() / statistics.peak() - 1.0).abs() < 1e-12);
        assert!(
            (of_impacts.statistics().rms() / statistics.rms() - 1.0).abs() < 1e-9,
            "{system:?}"
        );
        let energy = statistics.energy();
        let wanted = (energy.input > 0.0).then(|| energy.impact / energy.input);
        let found = of_impacts.statistics().efficiency();
        let near = found.zip(wanted).map(|(a, b)| (a - b).abs() < 1e-8 * b.max(1.0));
        assert!(near.unwrap_or(found == wanted), "{found:?} {wanted:?} {system:?}");
    }
    assert!(in_contact > 0 && without == 1, "{in_contact} {without}");
}

/// Where flights have been left out at the beginning, the periods after are measured as if it had begun there.
#[test]
fn flights_left_out_change_nothing_of_those_after() {
    const LEFT_OUT: u64 = 7;
    for system in systems() {
        let mut simulation = Simulation::new(&system, START, 0.0).expect("inside");
        let mut later = Measurement::of_impacts_after(LEFT_OUT, &system, START);
        let mut whole = Measurement::of_impacts(&system, START);
        let both = &mut (&mut later, &mut whole);
        assert_eq!(simulation.run(LEFT_OUT, u64::MAX, both), Stop::EndTime);
        let mut fresh = Measurement::of_impacts(&system, simulation.state());
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
