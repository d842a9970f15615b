use vinesink_core::analysis::Analysis;
use vinesink_core::orbits::attracting_orbit;
use vinesink_core::simulation::{Measurement, Simulation};
use vinesink_core::system::{Absorber, Harmonic, State, Structure, System};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let structure =
        Structure { mass_kg: 4.168, stiffness_n_per_m: 11_470.0, damping_n_s_per_m: 3.02 };
    let absorber = Absorber::new(0.032, 7.5e-3, 0.6); // 32 g, 7.5 mm to either wall, restitution 0.6
    let shaken = Harmonic::base(0.25e-3, 8.0); // the base moves by 0.25 mm at 8 Hz
    let (system, scales) = System::physical(&structure, &absorber, &shaken)?;
    let millimetres = |over_clearance| 1e3 * scales.length(over_clearance);
    for point in Analysis::of(&system)?.stable_points() {
        let amplitude = millimetres(point.oscillator_amplitude);
        println!("fixed point of the slow flow: amplitude {amplitude:.3} mm");
    }
    let orbit = attracting_orbit(&system).ok_or("no symmetric orbit attracts")?;
    println!("exact orbit: peak {:.3} mm", millimetres(orbit.peaks.displacement));

    let start = State { y: 0.5, ..State::AT_REST };
    let mut simulation = Simulation::new(&system, start, 0.0)?;
    simulation.run(1000, u64::MAX, &mut ()); // the transient: 1000 excitation periods
    let mut measured = Measurement::begin(&system, simulation.state());
    simulation.run(100, u64::MAX, &mut measured);
    println!("simulation: peak {:.3} mm", millimetres(measured.statistics().peak()));
    assert!((measured.statistics().peak() - orbit.peaks.displacement).abs() < 1e-9);
    Ok(())
}
