//! Fixed points of the slow flow against the excitation frequency: the frequency response that the theory predicts.
//!
//! `cargo run --example fixed_points`

use vinesink_core::analysis::Analysis;
use vinesink_core::system::{Absorber, Harmonic, Structure, System};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let structure =
        Structure { mass_kg: 4.168, stiffness_n_per_m: 11.47e3, damping_n_s_per_m: 3.02 };
    let absorber = Absorber::new(0.032, 20e-3, 0.6);
    let natural = structure.natural_frequency_rad_per_s() / std::f64::consts::TAU;
    println!("natural frequency {natural:.3} Hz");
    println!("{:>8}  {:>6}  {:>12}  {:>12}  stability", "Hz", "area", "structure", "absorber");
    for step in 0..=12 {
        let frequency = 8.0 + 0.05 * f64::from(step);
        let shaken = Harmonic::base(0.25e-3, frequency);
        let (system, scales) = System::physical(&structure, &absorber, &shaken)?;
        let analysis = Analysis::of(&system)?;
        for point in &analysis.fixed_points {
            println!(
                "{frequency:8.2}  {:>6}  {:9.3} mm  {:9.3} mm  {} {}",
                analysis.zone.area.key(),
                1e3 * scales.length(point.oscillator_amplitude),
                1e3 * scales.length(point.absorber_amplitude),
                if point.stable { "stable" } else { "unstable" },
                point.kind.words(),
            );
        }
    }
    Ok(())
}
