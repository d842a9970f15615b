//! What is measured of a case's places, and the sensors for it.

use std::f64::consts::FRAC_PI_2;

use crate::case::ModalCase;
use crate::measure::{PlaceMeasure, riding};
use crate::motions::ModalMotion;
use crate::quantity::catalogue::PEAK_ACCELERATION;
use crate::simulation::{Reading, Sensor};

/// What is measured of each place: the largest displacement, and what else criteria ask for.
pub(super) fn measures(case: &ModalCase) -> Vec<PlaceMeasure> {
    let mut measures = vec![PlaceMeasure::PEAK];
    for one in &case.criteria {
        if !measures.contains(&one.measure) {
            measures.push(one.measure);
        }
    }
    measures
}

/// Sensors for that, in SI units: for each reading one at each place, displacements first.
pub fn sensors(case: &ModalCase) -> Vec<Sensor> {
    let measures = measures(case);
    let mut readings: Vec<Reading> = measures.iter().map(|one| one.reads).collect();
    if measures.contains(&PlaceMeasure { reads: Reading::Acceleration, mean: false }) {
        let all = case.absorbers.iter().enumerate();
        let pulses = all.filter(|(_, one)| one.contact_time_s.is_some());
        readings.extend(pulses.map(|(absorber, _)| Reading::Jump { absorber }));
    }
    readings.sort_unstable();
    readings.dedup();
    let of = |reads: Reading| {
        // By a time in seconds; of a jump the top of the half-sine that has it.
        let pulse = match reads {
            Reading::Jump { absorber } => {
                case.absorbers[absorber].contact_time_s.map_or(0.0, |time| FRAC_PI_2 / time)
            }
            _ => 1.0,
        };
        let scale = (0..reads.rates()).fold(pulse, |scale, _| scale * case.omega());
        case.shapes().into_iter().map(move |shape| Sensor { shape, reads, scale })
    };
    readings.into_iter().flat_map(of).collect()
}

/// What is measured of a place in a motion, in SI units, and its error.
pub(super) fn measured(motion: &ModalMotion, place: usize, asked: PlaceMeasure) -> [f64; 2] {
    let read = |reads: Reading| motion.read(reads).nth(place);
    let Some(own) = read(asked.reads) else { return [f64::NAN, 0.0] };
    match (asked.mean, asked.reads) {
        (true, _) => own.rms,
        // With the pulses of absorbers whose impacts take time.
        (false, Reading::Acceleration) => {
            let absorbers = 0..motion.impacts_per_period.len();
            let pulses = absorbers.filter_map(|absorber| read(Reading::Jump { absorber }));
            let top = pulses.clone().map(|one| one.peak).fold(0.0, f64::max);
            let most = pulses.map(|one| one.peak + one.error).fold(0.0, f64::max);
            riding(&PEAK_ACCELERATION, [own.peak, own.error], [top, most - top])
        }
        _ => [own.peak, own.error],
    }
}
