//! Starts on a wall, impacts at a period's end, chattering and what ending it early costs.
//!
//! The truth is the reference in 77 digits, which follows every chattering sequence to its end, and
//! mechanics: a wall that moves towards a mass at rest against it carries it, one that recedes leaves
//! it behind.

use crate::common;
use std::f64::consts::TAU;

use vinesink::simulation::{
    AbsorberMotion, Impact, Measurement, Observer, Segment, Simulation, StartError, Stop,
};
use vinesink::system::{Cavity, Excitation, Parameters, State, System};
use vinesink_evidence::extremes::contact_costs;

/// What happened first.
#[derive(Default)]
struct First {
    impacts: Vec<Impact>,
    carried: bool,
    widest: f64,
}

impl Observer for First {
    fn segment(&mut self, segment: &Segment) {
        self.carried |=
            self.impacts.is_empty() && matches!(segment.absorber, AbsorberMotion::Carried(_));
        for k in 0..=20 {
            let gap =
                segment.at(segment.duration * f64::from(k) / 20.0).relative_displacement().abs();
            self.widest = self.widest.max(gap);
        }
    }
    fn impact(&mut self, impact: &Impact) {
        self.impacts.push(*impact);
    }
}

/// Unforced and undamped: the wall's acceleration is minus the displacement.
fn swinging(restitution: f64) -> System {
    System::new(Parameters {
        mass_ratio: 0.1,
        damping: 0.0,
        restitution,
        frequency_ratio: 1.0,
        forcing_per_clearance: 0.0,
        excitation: Excitation::Force,
        cavity: Cavity::IDEAL,
    })
    .expect("valid")
}

fn first(system: &System, start: State) -> First {
    let mut simulation = Simulation::new(system, start, 0.0).expect("on the wall is inside");
    let mut seen = First::default();
    assert_eq!(simulation.run(2, 1000, &mut seen), Stop::EndTime, "{start:?}");
    assert!(seen.widest < 1.0 + 1e-14, "{start:?}: {}", seen.widest);
    seen
}

#[test]
fn every_kind_of_start_on_a_wall_does_what_the_wall_makes_it_do() {
    for restitution in [0.0, 0.6, 1.0] {
        let system = swinging(restitution);
        for side in [1.0, -1.0] {
            // On the plus side a negative acceleration of the oscillator leaves the absorber behind,
            // so that the spring pushes the wall towards it where x is negative.
            let start = |x: f64, v: f64, relative: f64| State {
                x: side * x,
                x_velocity: side * v,
                y: side * (x - 1.0),
                y_velocity: side * (v - relative),
            };
            let case = format!("r = {restitution}, side {side}");
            let out = first(&system, start(0.2, 0.1, 0.5));
            assert_eq!(out.impacts[0].tau, 0.0, "{case}: moving out it collides at once");
            assert_eq!(out.impacts[0].side.sign(), side, "{case}");
            let inwards = first(&system, start(0.2, 0.1, -0.5));
            assert!(!inwards.carried && inwards.impacts[0].tau > 0.1, "{case}: moving in it flies");
            let pushed = first(&system, start(-0.5, 0.1, 0.0));
            assert!(pushed.carried, "{case}: a wall that pushes carries it");
            assert!(pushed.impacts.iter().all(|impact| impact.tau > 0.1), "{case}");
            let pulled = first(&system, start(0.5, 0.1, 0.0));
            assert!(!pulled.carried, "{case}: a wall that recedes leaves it");
            assert!(pulled.impacts.iter().all(|impact| impact.tau > 0.1), "{case}");
            // No acceleration, but soon: x = 0 and a velocity, so that the jerk is minus it.
            let receding = first(&system, start(0.0, 0.5, 0.0));
            assert!(!receding.carried, "{case}: a wall about to recede leaves it");
            assert!(receding.impacts.iter().all(|impact| impact.tau > 0.1), "{case}");
            // About to push: it touches at once, and rests on the wall before long.
            let mut simulation = Simulation::new(&system, start(0.0, -0.5, 0.0), 0.0).expect("in");
            let mut measurement = Measurement::begin(&system, start(0.0, -0.5, 0.0));
            assert_eq!(simulation.run(1, 100_000, &mut measurement), Stop::EndTime, "{case}");
            let statistics = measurement.statistics();
            assert!(statistics.penetration() < 1e-14, "{case}");
            assert!(statistics.sustained_contact().duration_tau > 2.0, "{case}");
            // Nothing moves at all.
            let still = first(&system, start(0.0, 0.0, 0.0));
            assert!(still.impacts.is_empty(), "{case}: nothing moves");
        }
    }
}

#[test]
fn starts_outside_are_refused_and_starts_within_rounding_of_a_wall_are_not() {
    let system = swinging(0.6);
    let at = |x: f64| State { x, x_velocity: 0.0, y: 0.0, y_velocity: 0.0 };
    for x in [1.0 + 1e-12, -1.0 - 1e-12, 1.5, -3.0] {
        let error = Simulation::new(&system, at(x), 0.0).map(drop);
        assert_eq!(error, Err(StartError::OutsideCavity { gap: x }));
    }
    for x in [1.0, -1.0, 1.0 + f64::EPSILON, -1.0 - f64::EPSILON] {
        assert!(Simulation::new(&system, at(x), 0.0).is_ok(), "{x}");
    }
}

/// The oscillator rests, the absorber drifts to the wall and arrives with the end of the period, or a
/// few units in the last place before or after: one impact, whichever period it falls into.
#[test]
fn an_impact_at_the_end_of_a_period_happens_once() {
    for (restitution, periods) in [(0.0, 1), (0.6, 1), (1.0, 1), (0.6, 3_u32)] {
        let system = swinging(restitution);
        let exact = 1.0 / (TAU * f64::from(periods));
        for ulps in -6_i32..=6 {
            let speed = exact * (1.0 + f64::from(ulps) * f64::EPSILON);
            let start = State { x: 0.0, x_velocity: 0.0, y: 0.0, y_velocity: speed };
            let mut simulation = Simulation::new(&system, start, 0.0).expect("inside");
            let mut seen = First::default();
            let end = u64::from(periods);
            assert_eq!(simulation.run(end - 1, 100, &mut seen), Stop::EndTime);
            assert!(seen.impacts.is_empty(), "{ulps}");
            assert_eq!(simulation.run(2, 100, &mut seen), Stop::EndTime);
            let count = seen.impacts.len();
            assert!(count >= 1, "r = {restitution}, {ulps}: the impact is missed");
            let impact = seen.impacts[0];
            let arrival = TAU * f64::from(periods);
            assert!((impact.tau - arrival).abs() < 1e-13, "{ulps}: {impact:?}");
            // The next one is a long way off: the absorber left with the speed r u. Without
            // restitution the wall, unaccelerated at the impact, takes it up by a touch that costs
            // nothing.
            let again = seen.impacts[1..].iter().all(|touch| touch.loss < 1e-25);
            assert!(count <= 2 && again, "r = {restitution}, {ulps}: {:?}", seen.impacts);
            assert!(count == 1 || restitution == 0.0, "r = {restitution}: {:?}", seen.impacts);
        }
    }
}

/// Sticking keeps the momentum and moves the centre of mass by less than the excursion, so releases
/// and displacements are off by less than it, over the largest of the velocities that turn one into
/// the other; the floor is rounding at the peak, in some hundred events.
#[test]
fn ending_a_chattering_sequence_early_costs_less_than_the_excursion() {
    let heavy =
        System::new(Parameters { mass_ratio: 0.9, ..common::table_1(8.0, 7.5).parameters() });
    for system in [common::table_1(8.0, 0.3), heavy.expect("valid")] {
        let costs = contact_costs(&system, 20).expect("measured");
        for cost in &costs {
            assert_eq!(cost.releases, 6, "{cost:?}");
            let floor = 100.0 * f64::EPSILON * (1.0 + 20.0);
            let allowed = cost.excursion + floor;
            assert!(cost.time < allowed && cost.displacement < allowed, "{cost:?}");
        }
        // It is the tolerance that is measured: a coarse one is seen, and costs less.
        let of = |excursion: f64| {
            let found = costs.iter().find(|cost| cost.excursion == excursion && cost.drift == 0.01);
            found.copied().expect("in the list")
        };
        assert!(of(1e-4).displacement > 10.0 * of(1e-12).displacement, "{costs:?}");
        assert!(of(1e-4).impacts_per_period < 0.7 * of(1e-12).impacts_per_period, "{costs:?}");
    }
}

/// From a speed of about 20 down to the 1e-6 at which the excursion is 1e-12 a sequence takes
/// `ln(2e7)/ln(1/r)` impacts, and there are at most two sequences a period.
#[test]
fn chattering_costs_a_bounded_number_of_impacts_and_evaluations() {
    let start = State { x: 0.3, x_velocity: 0.2, y: 0.1, y_velocity: 0.8 };
    for restitution in [0.0, 0.3, 0.6, 0.9, 0.95, 0.99, 0.999, 0.999_999, 1.0] {
        let table = common::table_1(8.0, 0.3).parameters();
        let system = System::new(Parameters { restitution, ..table }).expect("valid");
        let mut simulation = Simulation::new(&system, start, 0.0).expect("inside");
        let stop = simulation.run(500, 1_000_000, &mut ());
        assert_eq!(stop, Stop::EndTime);
        let impacts = simulation.impacts() as f64 / 500.0;
        // Beyond r = 0.9 the wall recedes before a sequence of this clearance is over.
        let decay = 1.0_f64.max(libm::log(2e7) / -libm::log(restitution.clamp(1e-9, 0.9)));
        assert!(impacts < 2.0 * (2.0 + decay), "r = {restitution}: {impacts} a period");
        let evaluations = simulation.evaluations() as f64 / 500.0;
        // Sixteen panels a period, and a dozen evaluations for each event that is no plain crossing.
        assert!(evaluations < 32.0 + 16.0 * impacts, "r = {restitution}: {evaluations} a period");
    }
}
