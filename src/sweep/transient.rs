//! What is recorded of structures that are not driven steadily: numbers of the study that a case of the point has,
//! without what costs more and is not recorded. A motion that cannot be followed has none.

use crate::quantity::Units;
use std::f64::consts::TAU;
use std::sync::OnceLock;

use super::columns::Cell;
use super::{Plan, Point};
use crate::case::{Case, RecordSource, Recorded, Recording};
use crate::excitation::{Record, Transient};
use crate::executor::Serial;
use crate::flights::{Places, Predicted, seconds_of, with_closer};
use crate::linear::{TunedMassDamper, bare_decay, reduction_db, swept};
use crate::transient::{DecayStudy, RecordStudy, SweepStart, SweepStudy, followed, worst};

/// Places of the absorber that take as long as the structure alone and with a damper.
const ALTERNATIVES: f64 = 4.0;
/// Seconds for theory, and those that grow with the cube of the amplitude over the clearance: 0.03, 0.3 and 2.5 s
/// at 1.5, 6 and 11.5.
const THEORY: [f64; 2] = [0.02, 1.6e-3];

/// What a case says of a structure that is not driven steadily beside its design.
#[derive(Debug, Clone)]
pub(super) struct Subject {
    decay_level: f64,
    count_inactive: bool,
    recording: Option<Recording>,
    records: OnceLock<Vec<Record>>,
}

/// What is found at a point.
enum Found {
    Release(Box<DecayStudy>),
    /// Largest displacement without absorber and with the damper.
    Sweep {
        starts: Vec<SweepStart>,
        peaks: [f64; 2],
    },
    Record(RecordStudy),
}

impl Subject {
    /// None for a structure that is driven steadily.
    pub fn of(case: &Case) -> Option<Self> {
        case.design.transient().map(|_| Self {
            decay_level: case.decay_level,
            count_inactive: case.count_inactive,
            recording: case.recording.clone(),
            records: OnceLock::new(),
        })
    }

    /// SHA-256 of the file that drives the structure.
    pub fn digest(&self) -> Option<&str> {
        match &self.recording.as_ref()?.source {
            RecordSource::File { read, .. } => read.as_ref().map(|(digest, _)| digest.as_str()),
            RecordSource::Spectrum(_) => None,
        }
    }

    fn records(&self) -> &[Record] {
        self.records.get_or_init(|| self.recording.iter().flat_map(Recording::records).collect())
    }

    /// What is recorded of a point, in the order of the settings.
    pub fn cells(&self, plan: &Plan, point: &Point) -> Vec<Option<Cell>> {
        let study = self.study(plan, point);
        let number = |of: &Recorded| number(*of, study.as_ref()?, &point.units);
        plan.settings.record.iter().map(|of| number(of).map(Cell::Number)).collect()
    }

    fn study(&self, plan: &Plan, point: &Point) -> Option<Found> {
        let (system, units, inactive) = (point.system?, &point.units, self.count_inactive);
        let places = Places { even: places(plan).into(), closer: true, executor: &Serial };
        Some(match point.design.transient()? {
            Transient::Release(release) => {
                let share = self.decay_level;
                let study = DecayStudy::without_theory(&system, units, &release, share, places);
                Found::Release(Box::new(DecayStudy { count_inactive: inactive, ..study.ok()? }))
            }
            Transient::Sweep(sweep) => {
                let starts = SweepStudy::starts(&system, units, &sweep, places, inactive).ok()?;
                let damper = TunedMassDamper::den_hartog(system.mass_ratio());
                let peak = |damper| swept(&system, damper, units, &sweep).peak()[1];
                Found::Sweep { starts, peaks: [None, Some(&damper)].map(peak) }
            }
            Transient::Record(_) => {
                let (records, places) = (self.records(), places.even);
                let study = RecordStudy::without_spectrum(&system, units, records, places, &Serial);
                Found::Record(RecordStudy { count_inactive: inactive, ..study.ok()? })
            }
        })
    }

    /// About how many seconds a point takes.
    pub fn seconds(&self, plan: &Plan, point: &Point) -> f64 {
        let (Some(system), Some(of)) = (&point.system, point.design.transient()) else {
            return 0.0;
        };
        let (places, units) = (with_closer(places(plan).into()) as f64, &point.units);
        let each = seconds_of(point.design.scene());
        match of {
            Transient::Release(release) => {
                let flown = places * followed(bare_decay(system, self.decay_level)) * each;
                let from = release.amplitude(units);
                let asked = plan.settings.record.contains(&Recorded::TheoryDecayTime);
                match asked && from <= Predicted::LARGEST {
                    true => flown + THEORY[0] + THEORY[1] * from * from * from,
                    false => flown,
                }
            }
            Transient::Sweep(sweep) => (places + ALTERNATIVES) * sweep.count() as f64 * each,
            Transient::Record(_) => {
                let pieces = self.records().iter().map(|record| record.count(units)).sum::<u64>();
                (places + ALTERNATIVES) * pieces as f64 * each
            }
        }
    }
}

/// Places of the absorber that are simulated; none where nothing asks for it.
fn places(plan: &Plan) -> u32 {
    if plan.needs_simulation() { plan.settings.starts } else { 0 }
}

/// A number of what was found.
fn number(of: Recorded, found: &Found, units: &Units) -> Option<f64> {
    let time = |oscillations: f64| units.time(TAU * oscillations);
    let length = |over_clearance: f64| units.length(over_clearance);
    let speed = |over_clearance: f64| units.velocity(over_clearance);
    Some(match found {
        Found::Release(study) => match of {
            Recorded::DecayTime => time(study.decay().oscillations[0]),
            Recorded::BareDecayTime => time(study.bare),
            Recorded::DamperDecayTime => time(study.damped.1.settles),
            Recorded::TheoryDecayTime => {
                time(Predicted::of(&study.system, study.from, study.level).oscillations?)
            }
            Recorded::InactiveShare => study.inactive.share,
            Recorded::Peak => length(study.largest(|start| start.peak)[0]),
            Recorded::ImpactSpeed => speed(study.largest(|start| start.impact_speed)[0]),
            Recorded::Impacts => study.worst()?.impacts as f64,
            _ => return None,
        },
        Found::Sweep { starts, peaks } => {
            match (of, worst(starts.iter()).map(|(_, worst)| worst)) {
                (Recorded::BarePeak, _) => length(peaks[0]),
                (Recorded::DamperPeak, _) => length(peaks[1]),
                (Recorded::Peak, Some(worst)) => length(worst.peak()[1]),
                (Recorded::PeakFrequency, Some(worst)) => units.frequency(worst.peak()[0]),
                (Recorded::ReductionDb, Some(worst)) => reduction_db(worst.peak()[1], peaks[0]),
                (Recorded::ReductionDbTmd, Some(worst)) => reduction_db(worst.peak()[1], peaks[1]),
                (Recorded::ImpactSpeed, _) => {
                    speed(starts.iter().map(|(_, one)| one.impact_speed).reduce(f64::max)?)
                }
                (Recorded::Impacts, Some(worst)) => worst.impacts as f64,
                _ => return None,
            }
        }
        Found::Record(study) => match of {
            Recorded::BarePeak => length(study.mean(|one| one.bare.peak)[0]),
            Recorded::BareRms => length(study.mean(|one| one.bare.rms)[0]),
            Recorded::DamperPeak => length(study.mean(|one| one.damped.peak)[0]),
            Recorded::DamperRms => length(study.mean(|one| one.damped.rms)[0]),
            Recorded::Peak => length(study.worst(|_, place| place.peak)[0]),
            Recorded::Rms => length(study.worst(|_, place| place.rms)[0]),
            Recorded::ReductionDb => study.reduction_db(|one| one.bare.peak)[0],
            Recorded::ReductionDbTmd => study.reduction_db(|one| one.damped.peak)[0],
            Recorded::ImpactSpeed => speed(study.worst(|_, place| place.impact_speed)[0]),
            Recorded::Impacts => study.shown()?.1.impacts as f64,
            _ => return None,
        },
    })
}
