//! vinesink's engine for several modes and absorbers, on the structure of the other engines with a second mode and a second
//! absorber.

use vinesink::simulation::{ModalSimulation, Stop};
use vinesink::system::{ModalAbsorber, ModalParameters, ModalState, ModalSystem, Mode};

use crate::Failure;

/// Numbers of modes and absorbers that are counted.
pub const SIZES: [[usize; 2]; 4] = [[1, 1], [1, 2], [2, 1], [2, 2]];

/// As a size is called on a command line.
pub fn word([modes, absorbers]: [usize; 2]) -> String {
    format!("several-{modes}-{absorbers}")
}

/// The structure of [`crate::system`] under a force, in mm: a cantilever's second mode beside its first, the absorber's mass
/// shared with one that has half of its clearance.
fn system([modes, absorbers]: [usize; 2], clearance_mm: f64) -> ModalSystem {
    let all = [([1.0, 0.0069], [1.0, 0.7]), ([6.267, 0.01], [-1.0, 0.5])];
    let modes = all[..modes].iter().map(|([frequency, damping_ratio], shape)| Mode {
        frequency: *frequency,
        damping_ratio: *damping_ratio,
        mass: 1.0,
        forcing: 0.25,
        participation: 0.0,
        shape: shape[..absorbers].to_vec(),
    });
    let mass = 0.032 / 4.168 / absorbers as f64;
    let absorbers = [1.0, 0.5][..absorbers].iter().map(|share| ModalAbsorber {
        mass,
        clearance: share * clearance_mm,
        restitution: 0.6,
    });
    ModalSystem::new(ModalParameters {
        modes: modes.collect(),
        absorbers: absorbers.collect(),
        frequency_ratio: 1.0,
        base_amplitude: 0.0,
    })
    .expect("a valid system")
}

/// Impacts in so many periods from rest.
pub fn impacts(size: [usize; 2], clearance_mm: f64, periods: u64) -> Result<u64, Failure> {
    let system = system(size, clearance_mm);
    let mut simulation = ModalSimulation::new(&system, &ModalState::AT_REST, 0.0)?;
    match simulation.run(periods, u64::MAX, &mut ()) {
        Stop::EndTime => Ok(simulation.impacts()),
        stop => Err(format!("the run ended at {}", stop.words()).into()),
    }
}
