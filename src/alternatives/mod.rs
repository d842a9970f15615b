//! An honest choice: what nothing, the absorbers and tuned mass dampers of their mass come to under the loads, or over the band,
//! release, sweep or record of a case, as designed, in the room of the absorbers, without a damping medium, and where the structure's
//! natural frequencies are others than were thought.

mod drifted_case;
mod drifting;

use serde::Serialize;

use crate::band::Survey;
use crate::case::{AlternativesSettings, Case, Criterion, Of, Relation};
use crate::criteria::Judged;
use crate::dampers::{AtBound, Designing};
use crate::executor::{Executor, map};
use crate::flights::DrivenError;
use crate::linear::TunedMassDamper;
use crate::measure::{Device, Measure};
use crate::motions::Effort;
use crate::transient::Study;
use drifted_case::{DriftedCase, as_designed, asked, own};

pub use drifting::Dampers;
pub(crate) use drifting::Drifting;

/// Which room a device has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Room {
    /// As much as it takes.
    AsDesigned,
    /// That of the absorber: a damper is designed to stay within.
    Equal,
    /// That of the absorber: a damper as designed hits stops with the restitution of the absorber's walls.
    Stops,
}

/// A device with its room and how it was designed, in a word.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Which {
    /// The absorber of the case.
    Absorber,
    /// No device.
    NoAbsorber,
    /// The tuned mass damper that is best for the case.
    Damper,
    /// The best that stays within the absorber's room.
    DamperInEqualRoom,
    /// The best, with stops at the absorber's room.
    DamperWithStops,
    /// The best of a damping ratio that is given.
    DamperWithoutMedium,
    /// The best, whose own frequency has changed.
    DamperOfChangedFrequency,
    /// The best for the whole range of the drift.
    RobustDamper,
}

/// A device and what the structure does with it where its natural frequencies are off by a share, at the worse end.
#[derive(Debug, Clone, PartialEq)]
pub struct Row<D = TunedMassDamper> {
    /// The device.
    pub device: Device,
    /// Its room.
    pub room: Room,
    /// Share by which it was designed to bear a frequency that is off; 0 for one that was told the frequency.
    pub robust_for: f64,
    /// Its damping ratio, where that was given and not designed.
    pub given_damping: Option<f64>,
    /// Whether its own frequency is another than designed.
    pub changed: bool,
    /// Share by which the natural frequencies are off, either way.
    pub drift: f64,
    /// What was asked, in SI or the units of a reduced case; the error as that of the measure.
    pub worst: [f64; 2],
    /// Displacement against the structure, in the same; none of no device.
    pub stroke: Option<f64>,
    /// The damper, or several that are used together.
    pub damper: Option<D>,
}

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Alternatives<D = TunedMassDamper> {
    /// What is compared: the peak, or what the first criterion asks about.
    pub measure: Measure,
    /// Of which place, or of any.
    pub of: Of,
    /// What is asked at most of that, where it is.
    pub limit: Option<f64>,
    /// Whether the absorber's worst is that of one which stays at rest, so that the structure is as good as alone.
    pub inactive: bool,
    /// One row for each device, room and drift.
    pub rows: Vec<Row<D>>,
    /// What becomes of it as the structure's natural frequencies drift.
    pub over_drift: OverDrift,
}

/// What was asked over the share by which the natural frequency is off, negative below.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OverDrift {
    /// With the absorber, and its error.
    pub absorber: Vec<(f64, [f64; 2])>,
    /// With the damper that is best for the case, as designed and in the absorber's room.
    pub dampers: [Vec<[f64; 2]>; 2],
}

/// Relative error of a designed damper and of what it does, which a simplex finds: from other starts it came to within 2e-7.
pub const DESIGN: f64 = 1e-6;
/// Points of a line over the drift.
const POINTS: u32 = 40;

/// What is known of a case.
#[derive(Clone, Copy)]
pub struct Known<'a> {
    /// Along its band, where it is driven steadily.
    pub survey: Option<&'a Survey>,
    /// Where it is not.
    pub study: Option<&'a Study>,
    /// How thoroughly motions are searched.
    pub effort: &'a Effort,
}

impl Alternatives {
    /// Of a case and what is known of it; none where nothing moves, or nothing was found to compare with.
    ///
    /// # Errors
    /// [`DrivenError`] where a motion cannot be followed.
    pub fn of(
        case: &Case,
        known: Known<'_>,
        on: &dyn Executor,
    ) -> Result<Option<Self>, DrivenError> {
        let measure = asked(case);
        let Some((worst, inactive)) = own(case, known, measure) else { return Ok(None) };
        let here = DriftedCase::of(case, measure, known.effort);
        let own = Own { measure, of: Of::Any, inactive, worst };
        let usual = vec![as_designed(known, &here)];
        Self::beside(&here, own, usual, (&case.criteria, &case.alternatives), on)
    }
}

/// What devices are compared by where they are driven steadily: the first criterion, in the order of a page, of which dampers have a
/// closed form; else the peak of any place.
pub(crate) fn compared_by(criteria: &[Criterion]) -> Option<&Criterion> {
    criteria.iter().find(|one| one.measure.is_of_sines())
}

/// The same as it was judged.
pub(crate) fn compared(judged: &[Judged]) -> Option<&Judged> {
    judged.iter().find(|one| one.criterion.measure.is_of_sines())
}

/// What is asked at most of a measure of a place, or of any.
fn limit(criteria: &[Criterion], measure: Measure, of: Of) -> Option<f64> {
    let about = |one: &&Criterion| one.measure == measure && one.of == of;
    let mut all = criteria.iter().filter(about);
    all.find(|one| one.relation == Relation::AtMost).map(|one| one.limit)
}

/// What is known of the absorbers.
pub(crate) struct Own {
    /// What is compared.
    pub measure: Measure,
    /// Of which place, or of any.
    pub of: Of,
    /// Whether the worst is that of absorbers which stay at rest.
    pub inactive: bool,
    /// What is asked, with its error.
    pub worst: [f64; 2],
}

impl<D: Dampers> Alternatives<D> {
    /// Beside absorbers those dampers that are best for the case, each with what comes of it; the best first. None where nothing moves.
    ///
    /// # Errors
    /// Where a motion of the absorbers cannot be flown.
    pub(crate) fn beside<S: Drifting<Dampers = D> + Sync>(
        here: &S,
        own: Own,
        mut usual: Vec<D>,
        (criteria, settings): (&[Criterion], &AlternativesSettings),
        on: &dyn Executor,
    ) -> Result<Option<Self>, S::Error> {
        let Own { measure, of, inactive, worst } = own;
        let limit = limit(criteria, measure, of);
        if worst[0].is_nan() || worst[0] <= 0.0 || usual.is_empty() {
            return Ok(None);
        }
        let by_worst = |a: &Row<D>, b: &Row<D>| a.worst[0].total_cmp(&b.worst[0]);
        let reach = |one: &D| here.told(Some(one), Room::AsDesigned)[0];
        usual.sort_by(|a, b| reach(a).total_cmp(&reach(b)));
        let over_drift = OverDrift { absorber: vec![(0.0, worst)], ..OverDrift::default() };
        let rows = vec![Row::of(Device::Absorber, worst, 0.0).with_stroke(here.room())];
        let mut found = Self { measure, of, limit, inactive, rows, over_drift };
        let drifts = found.add_absorber(here, &settings.drift, on)?;
        // Designs for a drift are of no use at a single frequency.
        let robust = drifts.iter().filter(|_| !here.is_of_one_frequency()).map(Some);
        let kinds: Vec<Option<&(f64, Vec<S>)>> = [None, None].into_iter().chain(robust).collect();
        // A damper that bears a drift bears every smaller one: what is best at the ends may be worse between them.
        let up_to = |drift: f64| {
            let smaller = drifts.iter().filter(move |(other, _)| *other <= drift);
            smaller.flat_map(|(_, ends)| ends).collect::<Vec<&S>>()
        };
        let metal = Some(settings.damper_damping);
        let designed = |k: usize| {
            let (kind, from) = (k / usual.len(), &usual[k % usual.len()]);
            let as_designed = Room::AsDesigned;
            match kinds[kind] {
                Some((drift, _)) => here.designed(&up_to(*drift), from, as_designed, None),
                None if kind == 0 => here.designed(&[], from, Room::Equal, None),
                None => here.designed(&[], from, as_designed, metal),
            }
        };
        let count = kinds.len() * usual.len();
        let mut all = map(on, "tuned mass dampers", count, designed).into_iter();
        let mut next = || all.by_ref().take(usual.len()).map(Row::with).collect::<Vec<_>>();
        let equal = next().into_iter().map(|row| Row { room: Room::Equal, ..row });
        let equal: Vec<Row<D>> = equal.collect();
        let plain = next().into_iter().map(|row| Row { given_damping: metal, ..row });
        let plain: Vec<Row<D>> = plain.collect();
        let mut devices = vec![vec![Row::of(Device::Without, [0.0; 2], 0.0)]];
        let usual_rows = || usual.iter().cloned().map(Row::with);
        devices.push(usual_rows().collect());
        devices.push(equal);
        if here.has_stops() {
            devices.push(usual_rows().map(|row| Row { room: Room::Stops, ..row }).collect());
        }
        devices.push(plain);
        if let Some(factor) = settings.damper_frequency_factor {
            let changed = |one: &D| Row { changed: true, ..Row::with(one.retuned(factor)) };
            devices.push(usual.iter().map(changed).collect());
        }
        for mut alike in devices {
            let there = |row: &Row<D>| row.at(std::slice::from_ref(here), 0.0);
            alike = alike.iter().filter_map(there).collect();
            alike.sort_by(by_worst);
            for device in alike {
                let off = drifts.iter().filter_map(|(drift, ends)| device.at(ends, *drift));
                let off: Vec<Row<D>> = off.collect();
                found.rows.push(device);
                found.rows.extend(off);
            }
        }
        for (drift, _) in kinds.iter().flatten() {
            let told = next().into_iter().map(|row| Row { robust_for: *drift, ..row });
            let told =
                told.filter_map(|row| row.at(up_to(*drift).into_iter().chain([here]), *drift));
            let mut alike: Vec<Row<D>> = told.collect();
            alike.sort_by(by_worst);
            found.rows.extend(alike);
        }
        let furthest = settings.drift.last().copied().unwrap_or_default();
        let best = |which| found.row(which, 0.0).and_then(|row| row.damper.clone());
        if let (Some(usual), Some(equal)) = (best(Which::Damper), best(Which::DamperInEqualRoom)) {
            found.add_lines(here, furthest, [&usual, &equal]);
        }
        Ok(Some(found))
    }

    /// Adds what becomes of the absorbers where the structure's frequencies are off; gives the structures at both ends of each
    /// drift.
    fn add_absorber<S: Drifting<Dampers = D>>(
        &mut self,
        here: &S,
        drifts: &[f64],
        on: &dyn Executor,
    ) -> Result<Vec<(f64, Vec<S>)>, S::Error> {
        let mut found = Vec::new();
        for drift in drifts {
            let mut worst: Option<[f64; 2]> = None;
            let mut ends = Vec::new();
            for factor in [1.0 - drift, 1.0 + drift] {
                let Some(there) = here.drifted(factor) else { continue };
                if let Some(told) = there.absorber(on)? {
                    self.over_drift.absorber.push((factor - 1.0, told));
                    let reach = |one: [f64; 2]| one[0] + one[1];
                    worst = Some(worst.filter(|one| reach(*one) > reach(told)).unwrap_or(told));
                }
                ends.push(there);
            }
            let row = |worst| Row::of(Device::Absorber, worst, *drift).with_stroke(here.room());
            self.rows.extend(worst.map(row));
            found.push((*drift, ends));
        }
        self.over_drift.absorber.sort_by(|a, b| a.0.total_cmp(&b.0));
        Ok(found)
    }

    /// Adds the lines of two dampers over the drift. What takes long is known where the absorbers are.
    fn add_lines<S: Drifting<Dampers = D>>(&mut self, here: &S, furthest: f64, dampers: [&D; 2]) {
        let at = |k: u32| (2.0 * f64::from(k) / f64::from(POINTS) - 1.0) * furthest;
        let drifts: Vec<f64> = match here.designing() == Designing::USUAL {
            true => (0..=POINTS).map(at).collect(),
            false => self.over_drift.absorber.iter().map(|(drift, _)| *drift).collect(),
        };
        for drift in drifts {
            let Some(there) = here.drifted(1.0 + drift) else { continue };
            for (line, damper) in self.over_drift.dampers.iter_mut().zip(dampers) {
                line.push([drift, there.told(Some(damper), Room::AsDesigned)[0]]);
            }
        }
    }

    /// The row of a device at a drift; of several that are called the same the best.
    pub fn row(&self, which: Which, drift: f64) -> Option<&Row<D>> {
        self.all(which, drift).min_by(|a, b| a.worst[0].total_cmp(&b.worst[0]))
    }

    /// All of these, that first which is best where nothing is off.
    pub fn all(&self, which: Which, drift: f64) -> impl Iterator<Item = &Row<D>> {
        self.rows.iter().filter(move |row| row.which() == which && row.drift == drift)
    }
}

impl<D> Row<D> {
    /// What it is called.
    pub fn which(&self) -> Which {
        match (self.device, self.room) {
            (Device::Absorber, _) => Which::Absorber,
            (Device::Without, _) => Which::NoAbsorber,
            (Device::Damper, Room::Equal) => Which::DamperInEqualRoom,
            (Device::Damper, Room::Stops) => Which::DamperWithStops,
            _ if self.robust_for > 0.0 => Which::RobustDamper,
            _ if self.changed => Which::DamperOfChangedFrequency,
            _ if self.given_damping.is_some() => Which::DamperWithoutMedium,
            _ => Which::Damper,
        }
    }

    /// A device as designed, without any damper's numbers.
    fn of(device: Device, worst: [f64; 2], drift: f64) -> Self {
        Self {
            device,
            room: Room::AsDesigned,
            robust_for: 0.0,
            given_damping: None,
            changed: false,
            drift,
            worst,
            stroke: None,
            damper: None,
        }
    }

    /// Dampers as designed.
    fn with(damper: D) -> Self {
        Self { damper: Some(damper), ..Self::of(Device::Damper, [0.0; 2], 0.0) }
    }

    fn with_stroke(self, stroke: f64) -> Self {
        Self { stroke: Some(stroke), ..self }
    }
}

impl<D: Dampers> Row<D> {
    /// The same linear device at a drift, on the worst of some structures.
    fn at<'a, S: Drifting<Dampers = D> + 'a>(
        &self,
        all: impl IntoIterator<Item = &'a S>,
        drift: f64,
    ) -> Option<Self> {
        let told = all.into_iter().map(|one| one.told(self.damper.as_ref(), self.room));
        let [worst, stroke] = told.reduce(larger)?;
        let is_damper = self.damper.is_some();
        let error = if is_damper { D::DESIGN * worst } else { 0.0 };
        let stroke = is_damper.then_some(stroke);
        Some(Self { worst: [worst, error], stroke, drift, ..self.clone() })
    }
}

impl Row {
    /// What its damper is where the search for it ended at a bound; none where it did not, or its numbers were given.
    pub fn at_bound(&self) -> Option<AtBound> {
        let damper = self.damper.filter(|_| !self.changed)?;
        // A ratio that is given is none that was looked for.
        let damping_ratio = if self.given_damping.is_some() { 1.0 } else { damper.damping_ratio };
        AtBound::of(damper.tuning, damping_ratio)
    }
}

/// The larger of two values and of two strokes.
pub(crate) fn larger(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0].max(b[0]), a[1].max(b[1])]
}
