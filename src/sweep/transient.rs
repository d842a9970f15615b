//! What is recorded of structures that are not driven steadily: numbers of the study that a case of the point has,
//! without what costs more and is not recorded. A motion that cannot be followed has none.

use super::columns::Cell;
use super::{GridPoint, Plan};
use crate::case::{Case, RecordSource, Recorded, Recording};
use crate::excitation::{Record, Transient};
use crate::executor::Serial;
use crate::flights::{Places, Predicted, seconds_of, with_closer};
use crate::linear::bare_decay;
use crate::transient::{Brief, Study, followed};

/// Places of the absorber that take as long as the structure alone and with a damper.
const ALTERNATIVES: f64 = 4.0;
/// Seconds for theory, and those that grow with the cube of the amplitude over the clearance: 0.03, 0.3 and 2.5 s
/// at 1.5, 6 and 11.5.
const THEORY: [f64; 2] = [0.02, 1.6e-3];

/// What a case says of a structure that is not driven steadily beside its design.
#[derive(Debug, Clone)]
pub(super) struct Unsteady {
    decay_level: f64,
    count_inactive: bool,
    recording: Option<Recording>,
}

impl Unsteady {
    /// None for a structure that is driven steadily.
    pub fn of(case: &Case) -> Option<Self> {
        case.design.transient().map(|_| Self {
            decay_level: case.decay_level,
            count_inactive: case.count_inactive,
            recording: case.recording.clone(),
        })
    }

    /// SHA-256 of the file that drives the structure.
    pub fn digest(&self) -> Option<&str> {
        match &self.recording.as_ref()?.source {
            RecordSource::File { read, .. } => read.as_ref().map(|read| read.sha256.as_str()),
            RecordSource::Spectrum(_) => None,
        }
    }

    fn records(&self) -> &[Record] {
        self.recording.as_ref().map_or(&[], Recording::records)
    }

    /// What is recorded of a point, in the order of the settings.
    pub fn cells(&self, plan: &Plan, point: &GridPoint) -> Vec<Option<Cell>> {
        let study = self.study(plan, point);
        let number = |of: &Recorded| {
            let (measure, device) = of.asked();
            Some(Cell::Number(study.as_ref()?.quantity(&point.units, measure, device)?.value))
        };
        plan.settings.record.iter().map(number).collect()
    }

    fn study(&self, plan: &Plan, point: &GridPoint) -> Option<Study> {
        let of = Brief {
            transient: point.design.transient()?,
            records: self.records(),
            decay_level: self.decay_level,
            count_inactive: self.count_inactive,
            theory: plan.settings.record.contains(&Recorded::TheoryDecayTime),
        };
        // Of several records each from fewer places, none beside the worst.
        let closer = of.records.len() < 2;
        let shaking = plan.asks_for_shaking();
        let places = Places { even: places(plan).into(), closer, shaking, executor: &Serial };
        Study::brief(&point.system?, &point.units, &of, places).ok()
    }

    /// About how many seconds a point takes.
    pub fn seconds(&self, plan: &Plan, point: &GridPoint) -> f64 {
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
