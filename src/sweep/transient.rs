//! What is recorded of structures that are not driven steadily: each number is that of the case's own study at the
//! point, and only what is recorded is computed. A motion that cannot be followed has no number.

use std::cell::LazyCell;
use std::f64::consts::TAU;
use std::sync::OnceLock;

use super::{Plan, Point};
use crate::band::rivals::{TunedMassDamper, reduction_db};
use crate::case::{Case, Recorded, Recording};
use crate::executor::Serial;
use crate::system::System;
use crate::transient::linear::swept;
use crate::transient::{
    self, DecayStudy, Predicted, Record, RecordStudy, Release, SineSweep, SweepStudy, Transient,
};

/// Seconds for an oscillation on the way to rest, a period of a sweep and a piece of a record from one place of the
/// absorber, measured in the release profile on one core of an ARM server: 2.8, 1.6 and 0.3 us with some impacts each.
const OSCILLATION: f64 = 3e-6;
const PERIOD: f64 = 1.6e-6;
const PIECE: f64 = 0.4e-6;
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

/// A number for what is recorded.
type Numbers<'a> = Box<dyn Fn(Recorded) -> Option<f64> + 'a>;

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
        self.recording.as_ref().and_then(Recording::digest)
    }

    fn records(&self) -> &[Record] {
        self.records.get_or_init(|| self.recording.iter().flat_map(Recording::records).collect())
    }

    /// What is recorded of a point, in the order of the settings.
    pub fn numbers(&self, plan: &Plan, point: &Point) -> Vec<Option<f64>> {
        let numbers = point.system.as_ref().and_then(|system| {
            Some(match point.design.transient()? {
                Transient::Release(release) => self.released(plan, point, system, release),
                Transient::Sweep(sweep) => self.swept(plan, point, system, sweep),
                Transient::Record(_) => self.driven(plan, point, system)?,
            })
        });
        let record = plan.settings.record.iter();
        record.map(|of| numbers.as_ref().and_then(|numbers| numbers(*of))).collect()
    }

    fn released<'a>(
        &self,
        plan: &Plan,
        point: &'a Point,
        system: &'a System,
        release: Release,
    ) -> Numbers<'a> {
        let (scales, share) = (&point.scales, self.decay_level);
        let start = release.state(scales, 0.0);
        let from = transient::amplitude(&start);
        let [alone, inactive] =
            [transient::bare(system, share), transient::inactive(system, &start)];
        let decides = self.count_inactive && inactive > 0.0;
        let starts =
            || DecayStudy::starts(system, scales, &release, share, plan.settings.starts).ok();
        let starts = plan.needs_simulation().then(starts).flatten();
        let time = |oscillations: f64| scales.time(TAU * oscillations);
        let level = share * from;
        Box::new(move |of| match of {
            Recorded::BareDecayTime => Some(time(alone)),
            Recorded::DamperDecayTime => {
                let most = transient::longest(alone);
                Some(time(transient::with_damper(system, start, level, most).2))
            }
            Recorded::TheoryDecayTime => Predicted::of(system, from, level).oscillations.map(time),
            Recorded::InactiveShare => Some(inactive),
            Recorded::DecayTime => Some(time(transient::slowest(starts.as_ref()?, alone, decides))),
            Recorded::Peak => {
                Some(scales.length(transient::largest(starts.as_ref()?, |start| start.peak)))
            }
            Recorded::ImpactSpeed => {
                let speed = transient::largest(starts.as_ref()?, |start| start.impact_speed);
                Some(scales.velocity(1.0) * speed)
            }
            Recorded::Impacts => Some(transient::worst(starts.as_ref()?)?.impacts as f64),
            _ => None,
        })
    }

    fn swept<'a>(
        &self,
        plan: &Plan,
        point: &'a Point,
        system: &'a System,
        sweep: SineSweep,
    ) -> Numbers<'a> {
        let scales = &point.scales;
        let starts = || {
            let places = plan.settings.starts;
            SweepStudy::starts(system, scales, &sweep, places, self.count_inactive).ok()
        };
        let starts = plan.needs_simulation().then(starts).flatten().unwrap_or_default();
        let worst = transient::worst_passage(&starts).map(|(_, worst)| worst.clone());
        let damper = TunedMassDamper::den_hartog(system.mass_ratio());
        let alone = LazyCell::new(move || swept(system, None, scales, &sweep).peak()[1]);
        let damped = LazyCell::new(move || swept(system, Some(&damper), scales, &sweep).peak()[1]);
        Box::new(move |of| match of {
            Recorded::BarePeak => Some(scales.length(*alone)),
            Recorded::DamperPeak => Some(scales.length(*damped)),
            Recorded::Peak => Some(scales.length(worst.as_ref()?.peak()[1])),
            Recorded::PeakFrequency => Some(scales.frequency(worst.as_ref()?.peak()[0])),
            Recorded::ReductionDb => Some(reduction_db(worst.as_ref()?.peak()[1], *alone)),
            Recorded::ReductionDbTmd => Some(reduction_db(worst.as_ref()?.peak()[1], *damped)),
            Recorded::ImpactSpeed => {
                let speeds = starts.iter().map(|(_, found)| found.impact_speed);
                Some(scales.velocity(1.0) * speeds.reduce(f64::max)?)
            }
            Recorded::Impacts => Some(worst.as_ref()?.impacts as f64),
            _ => None,
        })
    }

    fn driven<'a>(&self, plan: &Plan, point: &'a Point, system: &System) -> Option<Numbers<'a>> {
        let (scales, count_inactive) = (&point.scales, self.count_inactive);
        let places = if plan.needs_simulation() { plan.settings.starts } else { 0 };
        let study =
            RecordStudy::without_spectrum(system, scales, self.records(), places.into(), &Serial);
        let study = RecordStudy { count_inactive, ..study.ok()? };
        let length = |[value, _]: [f64; 2]| Some(scales.length(value));
        Some(Box::new(move |of| match of {
            Recorded::BarePeak => length(study.mean(|one| one.bare.peak)),
            Recorded::BareRms => length(study.mean(|one| one.bare.rms)),
            Recorded::DamperPeak => length(study.mean(|one| one.damped.peak)),
            Recorded::DamperRms => length(study.mean(|one| one.damped.rms)),
            Recorded::Peak => length(study.worst(|_, place| place.peak)),
            Recorded::Rms => length(study.worst(|_, place| place.rms)),
            Recorded::ReductionDb => Some(study.reduction_db(|one| one.bare.peak)[0]),
            Recorded::ReductionDbTmd => Some(study.reduction_db(|one| one.damped.peak)[0]),
            Recorded::ImpactSpeed => {
                let [speed, _] = study.worst(|_, place| place.impact_speed);
                Some(scales.velocity(1.0) * speed)
            }
            Recorded::Impacts => Some(study.shown()?.1.impacts as f64),
            _ => None,
        }))
    }

    /// About how many seconds a point takes.
    pub fn seconds(&self, plan: &Plan, point: &Point) -> f64 {
        let (Some(system), Some(of)) = (&point.system, point.design.transient()) else {
            return 0.0;
        };
        let places = f64::from(if plan.needs_simulation() { plan.settings.starts } else { 0 });
        let scales = &point.scales;
        match of {
            Transient::Release(release) => {
                let alone = transient::bare(system, self.decay_level);
                let from = transient::amplitude(&release.state(scales, 0.0));
                let asked = plan.settings.record.contains(&Recorded::TheoryDecayTime);
                let theory = match asked && from <= Predicted::LARGEST {
                    true => THEORY[0] + THEORY[1] * from * from * from,
                    false => 0.0,
                };
                places * alone.min(transient::longest(alone) as f64) * OSCILLATION + theory
            }
            Transient::Sweep(sweep) => (places + ALTERNATIVES) * sweep.count() as f64 * PERIOD,
            Transient::Record(_) => {
                let pieces = self.records().iter().map(|record| record.count(scales)).sum::<u64>();
                (places + ALTERNATIVES) * pieces as f64 * PIECE
            }
        }
    }
}
