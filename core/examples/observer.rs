//! A simulation with an observer: how hard and how often the absorber hits the walls, in SI units.
//!
//! `cargo run --example observer`

use std::f64::consts::TAU;

use vinesink_core::simulation::{Detail, Impact, Observer, Simulation};
use vinesink_core::system::{Cavity, Excitation, Parameters, State, System};

/// What is kept of the impacts; lengths over the clearance, fast time.
#[derive(Default)]
struct Walls {
    count: u32,
    fastest: f64,
    lost: f64,
}

impl Observer for Walls {
    fn detail(&self) -> Detail {
        Detail::Events // flights between impacts are not described, which saves time
    }

    fn impact(&mut self, impact: &Impact) {
        self.count += 1;
        let closing = impact.x_velocity_before - impact.y_velocity_before;
        self.fastest = self.fastest.max(closing.abs());
        self.lost += impact.loss;
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // 32 g in 4.168 kg, natural frequency 8.349 Hz, base moved by 0.25 mm at 8.5 Hz.
    let (mass, natural, frequency) = (4.168, 8.349 * TAU, 8.5);
    println!("clearance   impacts per period   fastest impact   lost in impacts");
    for clearance in [2.5e-3, 5e-3, 10e-3, 15e-3] {
        let system = System::new(Parameters {
            mass_ratio: 0.032 / mass,
            damping: 1.799,
            restitution: 0.6,
            frequency_ratio: frequency * TAU / natural,
            forcing_per_clearance: 0.25e-3 * mass / 0.032 / clearance,
            excitation: Excitation::BaseDisplacement,
            cavity: Cavity::IDEAL,
        })?;
        let mut simulation = Simulation::new(&system, State { y: 0.5, ..State::AT_REST }, 0.0)?;
        simulation.run(1000, u64::MAX, &mut ()); // the transient, which nobody observes
        let mut walls = Walls::default();
        let periods = 500;
        simulation.run(periods, u64::MAX, &mut walls);
        let unit = clearance * natural; // of velocities, m/s
        let seconds = periods as f64 / frequency;
        println!(
            "{:6.1} mm   {:18.2}   {:10.3} m/s   {:12.2} mW",
            1e3 * clearance,
            f64::from(walls.count) / periods as f64,
            walls.fastest * unit,
            1e3 * walls.lost * mass * unit * unit / seconds,
        );
    }
    Ok(())
}
