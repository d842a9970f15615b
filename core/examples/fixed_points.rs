//! Fixed points of the slow flow against the excitation frequency: the frequency response that the theory predicts.
//!
//! `cargo run --example fixed_points`

use std::f64::consts::TAU;

use vinesink_core::analysis::Analysis;
use vinesink_core::system::{Cavity, Excitation, Parameters, System};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // An oscillator of 4.168 kg on 11.47 kN/m and 3.02 N s/m; the absorber has 32 g and 20 mm to either side.
    let (mass, stiffness, damping) = (4.168, 11.47e3, 3.02);
    let (absorber_mass, clearance, base_amplitude) = (0.032, 20e-3, 0.25e-3);
    let natural: f64 = f64::sqrt(stiffness / mass);
    let mass_ratio = absorber_mass / mass;
    println!("natural frequency {:.3} Hz", natural / TAU);
    println!("{:>8}  {:>6}  {:>12}  {:>12}  stability", "Hz", "area", "structure", "absorber");
    for step in 0..=12 {
        let frequency = 8.0 + 0.05 * f64::from(step);
        let system = System::new(Parameters {
            mass_ratio,
            damping: damping / (absorber_mass * natural),
            restitution: 0.6,
            frequency_ratio: frequency * TAU / natural,
            forcing_per_clearance: base_amplitude / (mass_ratio * clearance),
            excitation: Excitation::BaseDisplacement,
            cavity: Cavity::IDEAL,
        })?;
        let analysis = Analysis::of(&system)?;
        for point in &analysis.fixed_points {
            println!(
                "{frequency:8.2}  {:>6}  {:9.3} mm  {:9.3} mm  {} {}",
                analysis.zone.area.key(),
                1e3 * clearance * point.oscillator_amplitude,
                1e3 * clearance * point.absorber_amplitude,
                if point.stable { "stable" } else { "unstable" },
                point.kind.words(),
            );
        }
    }
    Ok(())
}
