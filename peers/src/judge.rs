//! What a tool's impacts are worth: against the reference of 77 digits over the first periods, and
//! flight by flight against the exact next impact.

use vinesink::simulation::Simulation;
use vinesink::simulation::flow::Oscillator;
use vinesink::system::{State, System};

use crate::reference::{Moment, Reference};
use crate::{Hit, START};

/// Fast time by which a tool's impact may differ from the exact one and still be the same: a 600th of
/// a period, a hundred times what the coarsest tolerance here leaves in one flight, and what a graze
/// makes of an error of `1e-5` in the gap.
const SAME: f64 = 1e-2;
/// Periods after which a flight without impact is given up.
const PATIENCE: u64 = 50;
/// Parts of a period in which the reference looks for impacts.
const SCAN: f64 = 97.0;
/// Points of a missed excursion at which its depth is looked for.
const POINTS: u32 = 10_000;

/// Times of the first impacts, to 77 digits, and their walls.
pub fn reference(system: &System, impacts: usize) -> Vec<(f64, f64)> {
    let reference = Reference::new(system);
    let mut moment = Moment::start([START.x, START.x_velocity, START.y, START.y_velocity]);
    let times = (0..impacts).map(|_| {
        moment = reference.next(&moment, system.period() / SCAN);
        (moment.time.to_f64(), moment.side)
    });
    times.collect()
}

/// Largest error of an impact time; `None` where the tool has other impacts.
pub fn error(hits: &[Hit], truth: &[(f64, f64)]) -> Option<f64> {
    let alike = hits.len() == truth.len()
        && hits.iter().zip(truth).all(|(hit, (_, side))| hit.side == *side);
    let errors = hits.iter().zip(truth).map(|(hit, (time, _))| (hit.time - time).abs());
    alike.then(|| errors.fold(0.0, f64::max))
}

/// What became of a tool's flights.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Flights {
    pub checked: u64,
    /// It had its next impact later than the exact one, or on the other wall.
    pub missed: u64,
    /// It had an impact before the exact next one.
    pub invented: u64,
    /// How far beyond a wall the deepest of the missed ones went before it came back or the tool saw
    /// it, over the clearance.
    pub deepest: f64,
}

fn state(hit: &Hit) -> State {
    State { x: hit.x, x_velocity: hit.x_velocity, y: hit.x - hit.side, y_velocity: hit.y_velocity }
}

/// Flight by flight: from the state with which the tool went on, the exact next impact, by
/// vinesink's slow and finer search, against the tool's.
pub fn flights(system: &System, hits: &[Hit]) -> Flights {
    let mut flights = Flights::default();
    for pair in hits.windows(2) {
        let [from, to] = pair else { continue };
        let phase = system.frequency_ratio() * from.time;
        let Ok(simulation) = Simulation::new(system, state(from), phase) else { continue };
        let mut simulation = simulation.step_by_step();
        let begin = simulation_phase(phase) / system.frequency_ratio();
        let next = simulation.next_impact(PATIENCE);
        flights.checked += 1;
        let taken = to.time - from.time;
        match next {
            Some(impact) => {
                let exact = impact.tau - begin;
                if taken < exact - SAME {
                    flights.invented += 1;
                } else if taken > exact + SAME || to.side != impact.side.sign() {
                    flights.missed += 1;
                    let depth = depth(system, from, exact, taken, impact.side.sign());
                    flights.deepest = flights.deepest.max(depth);
                }
            }
            None => flights.invented += 1,
        }
    }
    flights
}

/// The phase as the engine reduces it.
fn simulation_phase(phase: f64) -> f64 {
    phase.rem_euclid(std::f64::consts::TAU)
}

/// How far beyond a wall the motion goes that missed it, until it first comes back.
fn depth(system: &System, from: &Hit, exact: f64, taken: f64, side: f64) -> f64 {
    let start = state(from);
    let phase = simulation_phase(system.frequency_ratio() * from.time);
    let motion = Oscillator::alone(system).motion(start.x, start.x_velocity, phase);
    let mut deepest = 0.0_f64;
    for k in 1..=POINTS {
        let s = exact + (taken - exact) * f64::from(k) / f64::from(POINTS);
        let beyond = side * (motion.at(s).x - start.y - start.y_velocity * s) - 1.0;
        if beyond < 0.0 {
            break;
        }
        deepest = deepest.max(beyond);
    }
    deepest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::Engine;
    use crate::runge_kutta::RungeKutta;
    use crate::{CLEARANCES, Tool, system};

    #[test]
    fn an_impact_that_is_left_out_is_missed_and_one_put_in_is_invented() {
        let system = system(CLEARANCES[1]);
        let hits = Engine::Single.hits(&system, 100).expect("runs");
        let all = flights(&system, &hits);
        assert_eq!((all.checked, all.missed, all.invented), (hits.len() as u64 - 1, 0, 0));

        let mut less = hits.clone();
        less.remove(50);
        let less = flights(&system, &less);
        assert_eq!((less.missed, less.invented), (1, 0));
        assert!(less.deepest > 0.0, "{less:?}");

        let mut more = hits.clone();
        let early = Hit { time: 0.5 * (hits[50].time + hits[51].time), ..hits[51] };
        more.insert(51, early);
        assert!(flights(&system, &more).invented >= 1);
    }

    #[test]
    fn errors_are_those_of_the_method() {
        let system = system(CLEARANCES[0]);
        let exact = Engine::Single.hits(&system, 50).expect("runs");
        let truth = reference(&system, exact.len());
        // Some ulps of tau = 314, 5.7e-14 each.
        assert!(error(&exact, &truth).expect("alike") < 1e-12);
        // Fourth order: twice the steps, a sixteenth of the error.
        let [coarse, fine] = [200, 400].map(|steps| {
            let hits = RungeKutta { steps }.hits(&system, 50).expect("runs");
            error(&hits, &truth).expect("alike")
        });
        assert!((8.0..32.0).contains(&(coarse / fine)), "{coarse:e} / {fine:e}");
        assert_eq!(error(&exact[1..], &truth), None);
    }
}
