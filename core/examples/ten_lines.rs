use vinesink_core::analysis::Analysis;
use vinesink_core::orbits::attracting_orbit;
use vinesink_core::simulation::{Measurement, Simulation};
use vinesink_core::system::{Cavity, Excitation, Parameters, State, System};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let system = System::new(Parameters {
        mass_ratio: 0.032 / 4.168,     // 32 g in 4.168 kg
        damping: 1.799,                // 3.02 N s/m at 32 g and a natural frequency of 8.349 Hz
        restitution: 0.6,              // of the relative velocity, at an impact
        frequency_ratio: 8.0 / 8.349,  // driven at 8 Hz
        forcing_per_clearance: 4.3417, // the base moves by 0.25 mm, b = 7.5 mm
        excitation: Excitation::BaseDisplacement,
        cavity: Cavity::IDEAL,
    })?;
    for point in Analysis::of(&system)?.stable_points() {
        println!("fixed point of the slow flow: amplitude {:.4} b", point.oscillator_amplitude);
    }
    let orbit = attracting_orbit(&system).ok_or("no symmetric orbit attracts")?;
    println!("exact orbit: peak {:.4} b", orbit.peaks.displacement);

    let start = State { y: 0.5, ..State::AT_REST };
    let mut simulation = Simulation::new(&system, start, 0.0)?;
    simulation.run(1000, u64::MAX, &mut ()); // the transient: 1000 excitation periods
    let mut measured = Measurement::begin(&system, simulation.state());
    simulation.run(100, u64::MAX, &mut measured);
    println!("simulation: peak {:.4} b", measured.statistics().peak());
    assert!((measured.statistics().peak() - orbit.peaks.displacement).abs() < 1e-9);
    Ok(())
}
