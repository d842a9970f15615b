use super::*;
use crate::simulation::{Impact, ImpactLog};
use crate::system::{Cavity, Excitation, Parameters, System};

fn simulations() -> Vec<Simulation> {
    (0..40)
        .map(|k| {
            let part = f64::from(k) / 40.0;
            let system = System::new(Parameters {
                mass_ratio: 0.01 + 0.2 * part,
                damping: 3.0 * part,
                restitution: 0.3 + 0.6 * part,
                frequency_ratio: 0.7 + part,
                forcing_per_clearance: 20.0,
                excitation: Excitation::BaseDisplacement,
                cavity: Cavity::IDEAL,
            })
            .expect("valid");
            let start = State { x: part, x_velocity: 0.3, y: 0.2, y_velocity: -0.5 * part };
            Simulation::new(&system, start, 0.0).expect("inside the cavity")
        })
        .collect()
}

/// No instruction that another processor lacks, or rounds otherwise, has a say in a result.
#[test]
fn every_set_of_instructions_gives_the_same_bits() {
    let by = |level: Level| {
        let (mut together, mut alone) = (simulations(), simulations());
        let mut logs: Vec<ImpactLog> = together.iter().map(|_| ImpactLog::default()).collect();
        run_at(level, &mut together, &[Extent { periods: 60, impacts: u64::MAX }; 40], &mut logs);
        for simulation in &mut alone {
            *simulation = simulation.clone().at_level(level);
            simulation.run(60, u64::MAX, &mut ());
        }
        let states = |all: Vec<Simulation>| all.iter().map(Simulation::state).collect();
        let impacts: Vec<Vec<Impact>> = logs.into_iter().map(|log| log.impacts).collect();
        let states: [Vec<State>; 2] = [states(together), states(alone)];
        (impacts, states)
    };
    let (impacts, states) = by(Level::new());
    assert!(impacts.iter().map(Vec::len).sum::<usize>() > 1000);
    assert_eq!(states[0], states[1]);
    assert_eq!((impacts, states), by(Level::baseline()));
}
