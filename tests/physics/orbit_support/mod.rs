//! What tests of orbits share.

#![allow(dead_code, reason = "each test file uses a part")]

pub mod real_cavity;

use nalgebra::Matrix4;
use vinesink::orbits::{AfterImpact, SymmetricOrbit};
use vinesink::simulation::{Impact, ImpactLog, Simulation, Stop};
use vinesink::system::System;

/// The next impacts of a simulation that starts at `after`.
pub fn impacts_from(system: &System, after: &AfterImpact, count: u64) -> Vec<Impact> {
    let mut simulation = Simulation::new(system, after.state(), after.phase).expect("on the wall");
    let mut log = ImpactLog::default();
    let stop = simulation.run(20 + count, count, &mut log);
    assert!(matches!(stop, Stop::ImpactLimit | Stop::EndTime));
    log.impacts
}

/// The same, on a symmetric orbit.
pub fn simulated_impacts(system: &System, orbit: &SymmetricOrbit, count: u64) -> Vec<Impact> {
    let cycle = &orbit.orbit.cycle;
    impacts_from(system, &cycle.impacts[0], count)
}

/// Jacobian of the half-period map, mirrored, by central differences of the simulation.
pub fn simulated_half_map(system: &System, orbit: &SymmetricOrbit, h: f64) -> Matrix4<f64> {
    let cycle = &orbit.orbit.cycle;
    let base = cycle.impacts[0].vector();
    let close = cycle.closure.matrix();
    let mapped = |k: usize, h: f64| {
        let mut vector = base;
        vector[k] += h;
        let start = cycle.impacts[0].moved_to(&vector);
        let impact = impacts_from(system, &start, 1)[0];
        // The simulation reduces phases to one turn.
        let turns = (start.phase.div_euclid(std::f64::consts::TAU)) * std::f64::consts::TAU;
        let begun = start.phase - turns;
        let passed = impact.tau * system.frequency_ratio();
        let phase = turns + if passed >= begun { passed } else { passed + std::f64::consts::TAU };
        AfterImpact {
            wall: start.wall,
            phase,
            x: impact.x,
            x_velocity: impact.x_velocity_after,
            y_velocity: impact.y_velocity_after,
        }
        .vector()
    };
    let columns = [0, 1, 2, 3].map(|k| close * (mapped(k, h) - mapped(k, -h)) / (2.0 * h));
    Matrix4::from_columns(&columns)
}
