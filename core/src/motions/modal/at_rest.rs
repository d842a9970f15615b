//! Every absorber at rest, in closed form; and where an excitation that begins at once leaves them there.

use std::sync::OnceLock;

use super::motion::{ModalMotion, SensorExtent};
use crate::linear::ModalAmplitudes;
use crate::regimes::ModalRegimes;
use crate::simulation::{ModalMeter, ModalSimulation, Sensor};
use crate::system::{ModalAbsorber, ModalState, ModalSystem};

/// Clearances, over their own, that no motion reaches.
const FAR: f64 = 1e9;

/// The share of the resting places of all absorbers, together, in which no wall reaches them where the excitation begins at once, at
/// phase 0, beside a structure at rest; its motion is followed for so many periods. None where the structure's motion is not finite.
pub(super) fn sudden_share(system: &ModalSystem, periods: u64) -> Option<f64> {
    let mut parameters = system.parameters().clone();
    parameters.absorbers.iter_mut().for_each(|one| one.clearance *= FAR);
    let alone = ModalSystem::new(parameters).ok()?;
    let at = |j: usize| system.modes().iter().map(|mode| mode.shape[j]).collect();
    let sensors = (0..system.absorbers().len()).map(|j| Sensor::displacement(at(j)));
    let mut meter = ModalMeter::new(&alone, &sensors.collect::<Vec<_>>());
    let mut simulation = ModalSimulation::new(&alone, &ModalState::AT_REST, 0.0).ok()?;
    simulation.run(periods, u64::MAX, &mut meter);
    let records = meter.records();
    let each = records.iter().zip(system.absorbers());
    Some(each.map(|(read, one)| (1.0 - read.peak / one.clearance).max(0.0)).product())
}

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
        seen_from: None,
        regimes: OnceLock::from(Some(ModalRegimes::at_rest(system.absorbers().len()))),
        sudden: None,
        followed: 0,
        periods: 0,
        flights: Vec::new(),
    })
}
