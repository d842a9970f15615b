//! What is measured of a case's places and absorbers, and the sensors for it.

use std::f64::consts::FRAC_PI_2;

use crate::case::{Criterion, ModalCase, Of, Relation};
use crate::measure::{Measure, Part, riding};
use crate::motions::ModalMotion;
use crate::quantity::catalogue::PEAK_ACCELERATION;
use crate::simulation::{Reading, Sensor};

/// A number of a place or an absorber, and whether the smallest is the worst.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Look {
    pub of: Of,
    pub measure: Measure,
    pub least: bool,
}

impl Look {
    /// What is looked at along the loads of a case: the largest displacement of each place, and what else criteria ask for.
    pub fn all(case: &ModalCase) -> Vec<Self> {
        let peak = parts(case, Measure::Peak, Of::Any);
        let mut all: Vec<Self> =
            peak.map(|of| Self { of, measure: Measure::Peak, least: false }).collect();
        for one in &case.criteria {
            for look in parts(case, one.measure, one.of).flat_map(|of| Self::of(one, of)) {
                if !all.contains(&look) {
                    all.push(look);
                }
            }
        }
        all
    }

    /// What a criterion asks of a part: one side of it, or both.
    pub fn of(asked: &Criterion, of: Of) -> impl Iterator<Item = Self> {
        // The peak alone says what a reduction is.
        let (measure, turned) = match asked.measure.against() {
            Some(_) => (Measure::Peak, true),
            None => (asked.measure, false),
        };
        let (relation, both) = (asked.relation, asked.relation == Relation::Equal);
        let sides = [false, true].into_iter();
        let asked =
            move |least: &bool| both || *least == ((relation == Relation::AtLeast) != turned);
        sides.filter(asked).map(move |least| Self { of, measure, least })
    }

    /// The number in a motion, its sign turned where the smallest is the worst, and its error.
    pub fn measured(&self, case: &ModalCase, motion: &ModalMotion) -> Option<[f64; 2]> {
        let [value, error] = measured(case, motion, self.of, self.measure)?;
        Some([if self.least { -value } else { value }, error])
    }
}

/// The parts of a structure that have a measure, of those that are asked about.
pub(super) fn parts(case: &ModalCase, measure: Measure, asked: Of) -> impl Iterator<Item = Of> {
    let all: Vec<Of> = match measure.part() {
        Part::Place => (0..case.places.len()).map(Of::Place).collect(),
        Part::Absorber => (0..case.absorbers.len()).map(Of::Absorber).collect(),
        Part::Whole => Vec::new(),
    };
    all.into_iter().filter(move |one| asked.holds(*one))
}

/// Sensors for that, in SI units: for each reading one at each place, displacements first.
pub fn sensors(case: &ModalCase) -> Vec<Sensor> {
    let measures = || case.criteria.iter().map(|one| one.measure);
    let sensed = measures().filter_map(|one| one.sensor().map(|(reads, _)| reads));
    let mut readings: Vec<Reading> = sensed.chain([Reading::Displacement]).collect();
    if measures().any(|one| one == Measure::PeakAcceleration) {
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

/// The largest of a measure in a motion, of what is asked about, with its error; none of what no motion has.
pub fn largest_of(
    case: &ModalCase,
    motion: &ModalMotion,
    measure: Measure,
    asked: Of,
) -> Option<[f64; 2]> {
    let each = parts(case, measure, asked).filter_map(|of| measured(case, motion, of, measure));
    each.max_by(|a, b| a[0].total_cmp(&b[0]))
}

/// What a place or an absorber has of a measure in a motion, in SI units, and its error; none of what no motion has.
pub(super) fn measured(
    case: &ModalCase,
    motion: &ModalMotion,
    of: Of,
    measure: Measure,
) -> Option<[f64; 2]> {
    let place = match (of, measure) {
        (Of::Absorber(j), Measure::ImpactSpeed) => {
            return Some(motion.impact_speed[j].map(|one| case.omega() * one));
        }
        (Of::Absorber(j), Measure::ImpactsPerPeriod) => return Some(motion.impacts_per_period[j]),
        (Of::Place(place), _) => place,
        _ => return None,
    };
    let read = |reads: Reading| motion.read(reads).nth(place);
    let (reads, mean) = measure.sensor()?;
    let own = read(reads)?;
    Some(match (mean, reads) {
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
    })
}
