//! An exact branch of periodic orbits over the clearance, with its bifurcations.
//!
//! `cargo run --example branch`

use vinesink_core::orbits::attracting_orbit;
use vinesink_core::orbits::branch::{BranchDirection, Settings, follow};
use vinesink_core::orbits::{Measures, OrbitError};
use vinesink_core::system::{Cavity, Excitation, Parameter, Parameters, System};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let clearance_mm = 10.0;
    // 32 g in 4.168 kg, natural frequency 8.349 Hz, base moved by 0.25 mm at 8 Hz.
    let system = System::new(Parameters {
        mass_ratio: 0.032 / 4.168,
        damping: 1.799,
        restitution: 0.6,
        frequency_ratio: 8.0 / 8.349,
        forcing_per_clearance: 0.25 * 4.168 / 0.032 / clearance_mm,
        excitation: Excitation::BaseDisplacement,
        cavity: Cavity::IDEAL,
    })?;
    let start = attracting_orbit(&system).ok_or("no symmetric orbit attracts")?;
    for direction in [BranchDirection::Down, BranchDirection::Up] {
        // Values of the parameter are clearances over that of the start.
        let settings = Settings::within([0.1, 3.0]);
        let branch = follow(&system, &start.orbit, Parameter::Clearance, direction, &settings)?;
        println!("{direction:?} from {clearance_mm} mm: {} orbits", branch.points.len());
        for special in &branch.specials {
            // Lengths are over the clearance of the orbit's own system.
            let here = Parameter::Clearance.applied(&system, special.value)?;
            let measures: Result<Measures, OrbitError> = Measures::of(&here, &special.orbit.cycle);
            println!(
                "  {:>18} at b = {:.4} mm, where the structure vibrates by {:.4} mm",
                special.kind.words(),
                clearance_mm * special.value,
                clearance_mm * special.value * measures?.peaks.displacement,
            );
        }
        println!("  ends: {:?}", branch.end);
    }
    Ok(())
}
