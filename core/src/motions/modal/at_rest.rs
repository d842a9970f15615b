//! Every absorber at rest, in closed form.

use super::motion::{ModalMotion, SensorExtent};
use crate::linear::ModalAmplitudes;
use crate::simulation::Sensor;
use crate::system::{ModalAbsorber, ModalSystem};

/// Every absorber at rest where no wall reaches it, as these sensors read it: in closed form. None where a wall reaches one.
pub fn modal_at_rest(system: &ModalSystem, sensors: &[Sensor]) -> Option<ModalMotion> {
    let share = |(j, one): (usize, &ModalAbsorber)| {
        1.0 - system.steady_motion_at(j).amplitude() / one.clearance
    };
    let shares: Vec<f64> = system.absorbers().iter().enumerate().map(share).collect();
    if shares.iter().any(|share| *share <= 0.0) {
        return None;
    }
    let shapes: Vec<Vec<f64>> = sensors.iter().map(|one| one.shape.clone()).collect();
    let amplitudes = ModalAmplitudes::of(system, &[], &shapes).places;
    let extent = |(sensor, amplitude): (&Sensor, f64)| {
        let peak = sensor.of_sine(amplitude, system.frequency_ratio());
        let rms = [peak * std::f64::consts::FRAC_1_SQRT_2, 0.0];
        SensorExtent { reads: sensor.reads, peak, error: 0.0, rms }
    };
    Some(ModalMotion {
        sensors: sensors.iter().zip(amplitudes).map(extent).collect(),
        impacts_per_period: vec![[0.0; 2]; system.absorbers().len()],
        impact_speed: vec![[0.0; 2]; system.absorbers().len()],
        repeats_after: Some(1),
        settled: true,
        largest_multiplier: None,
        is_orbit: false,
        starts: 0,
        state: None,
        resting: shares.into_iter().map(Some).collect(),
        periods: 0,
        flights: Vec::new(),
    })
}
