//! An honest choice: what nothing, the absorber and a tuned mass damper of its mass come to over the band, release, sweep or
//! record of a case, as designed, in the room of the absorber, without a damping medium, and where the structure's natural
//! frequency is another than was thought.

mod drifted_case;

use serde::Serialize;

use crate::band::{Survey, SurveySettings, Worst};
use crate::case::Case;
use crate::criteria;
use crate::dampers::{self, AtBound, Designing, more_damped};
use crate::excitation::Scene;
use crate::executor::Executor;
use crate::flights::{DrivenError, Places};
use crate::linear::TunedMassDamper;
use crate::measure::{Device, Measure};
use crate::motions::{BandEffort, Effort, along};
use crate::transient::Study;
use drifted_case::DriftedCase;

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

/// A device and what the structure does with it where its natural frequency is off by a share, at the worse end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
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
    /// Share by which the natural frequency is off, either way.
    pub drift: f64,
    /// What was asked, in SI or the units of a reduced case; the error as that of the measure.
    pub worst: [f64; 2],
    /// Displacement against the structure, in the same; none of no device.
    pub stroke: Option<f64>,
    /// The damper.
    pub damper: Option<TunedMassDamper>,
}

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Alternatives {
    /// What is compared: the peak, or what the first criterion asks about.
    pub measure: Measure,
    /// Whether the absorber's worst is that of one which stays at rest, so that the structure is as good as alone.
    pub inactive: bool,
    /// One row for each device, room and drift.
    pub rows: Vec<Row>,
    /// What becomes of it as the structure's natural frequency drifts.
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

/// Places along a band where its structure is another: the error says what they may miss.
const BAND: BandEffort =
    BandEffort { even: 13, starts: 6, starts_between: 2, most: 60, tolerance: 0.05 };
/// Places of the absorber under a record, each of which is long.
const PLACES_OF_RECORD: u64 = 8;
/// How much more than its room a penalty takes the stroke of a damper for: an optimum at the edge stays there.
const PENALTY: f64 = 20.0;

/// Relative error of a designed damper and of what it does, which a simplex finds: from other starts it came to within 2e-7.
pub const DESIGN: f64 = 1e-6;
/// Points of a line over the drift.
const POINTS: u32 = 40;
/// Dampers from the best of which one for little room is looked for: tunings over the usual one, and so many steps of equal
/// ratio from its damping to a heavy one.
const TUNINGS: [f64; 3] = [0.95, 1.0, 1.05];
const DAMPINGS: u32 = 8;
const HEAVY: f64 = 4.0;

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
        let found = own(case, known, measure).filter(|([worst, _], _)| *worst > 0.0);
        let Some((own, inactive)) = found else { return Ok(None) };
        let Some(here) = DriftedCase::of(case, measure, 1.0) else { return Ok(None) };
        let usual = as_designed(known, &here);
        let equal = here.designed(&[], usual, Some(1.0), None);
        let over_drift = OverDrift { absorber: vec![(0.0, own)], ..OverDrift::default() };
        let rows = vec![Row::of(Device::Absorber, own, 0.0).with_stroke(case.design.clearance())];
        let mut found = Self { measure, inactive, rows, over_drift };
        let drifts = found.add_absorber(case, known.effort, on)?;
        for device in linear(case, &here, usual, equal) {
            found.rows.extend(device.at(std::slice::from_ref(&here), 0.0));
            found.rows.extend(drifts.iter().filter_map(|(drift, ends)| device.at(ends, *drift)));
        }
        for (drift, ends) in drifts.iter().filter(|_| !here.is_of_one_frequency()) {
            let damper = Some(here.designed(ends, usual, None, None));
            let all = ends.iter().chain([&here]);
            let told = Row { robust_for: *drift, damper, ..Row::of(Device::Damper, [0.0; 2], 0.0) };
            found.rows.extend(told.at(all, *drift));
        }
        found.add_lines(case, &here, [usual, equal]);
        Ok(Some(found))
    }

    /// Adds what becomes of the absorber where the structure's frequency is off; gives the structures at both ends of each
    /// drift.
    fn add_absorber(
        &mut self,
        case: &Case,
        effort: &Effort,
        on: &dyn Executor,
    ) -> Result<Vec<(f64, Vec<DriftedCase>)>, DrivenError> {
        let mut drifts = Vec::new();
        for drift in &case.alternatives.drift {
            let mut worst: Option<[f64; 2]> = None;
            let mut ends = Vec::new();
            for factor in [1.0 - drift, 1.0 + drift] {
                let Some(there) = DriftedCase::of(case, self.measure, factor) else { continue };
                if let Some(found) = absorber(&there.case, self.measure, effort, on)? {
                    self.over_drift.absorber.push((factor - 1.0, found));
                    let reach = |one: [f64; 2]| one[0] + one[1];
                    worst = Some(worst.filter(|one| reach(*one) > reach(found)).unwrap_or(found));
                }
                ends.push(there);
            }
            let row = |worst| Row::of(Device::Absorber, worst, *drift);
            let row = worst.map(|worst| row(worst).with_stroke(case.design.clearance()));
            self.rows.extend(row);
            drifts.push((*drift, ends));
        }
        self.over_drift.absorber.sort_by(|a, b| a.0.total_cmp(&b.0));
        Ok(drifts)
    }

    /// Adds the lines of two dampers over the drift. A passage or a record is long: there they are known where the absorber
    /// is.
    fn add_lines(&mut self, case: &Case, here: &DriftedCase, dampers: [TunedMassDamper; 2]) {
        let furthest = case.alternatives.drift.last().copied().unwrap_or_default();
        let at = |k: u32| (2.0 * f64::from(k) / f64::from(POINTS) - 1.0) * furthest;
        let drifts: Vec<f64> = match here.designing() == Designing::USUAL {
            true => (0..=POINTS).map(at).collect(),
            false => self.over_drift.absorber.iter().map(|(drift, _)| *drift).collect(),
        };
        for drift in drifts {
            let Some(there) = DriftedCase::of(case, self.measure, 1.0 + drift) else { continue };
            for (line, damper) in self.over_drift.dampers.iter_mut().zip(&dampers) {
                line.push([drift, there.told(Some(damper), Room::AsDesigned)[0]]);
            }
        }
    }

    /// The row of a device at a drift.
    pub fn row(&self, which: Which, drift: f64) -> Option<&Row> {
        self.rows.iter().find(|row| row.which() == which && row.drift == drift)
    }
}

impl Row {
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

    /// What its damper is where the search for it ended at a bound; none where it did not, or its numbers were given.
    pub fn at_bound(&self) -> Option<AtBound> {
        let damper = self.damper.filter(|_| !self.changed)?;
        // A ratio that is given is none that was looked for.
        let damping_ratio = if self.given_damping.is_some() { 1.0 } else { damper.damping_ratio };
        AtBound::of(damper.tuning, damping_ratio)
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

    fn with_stroke(self, stroke: f64) -> Self {
        Self { stroke: Some(stroke), ..self }
    }

    /// The same linear device at a drift, on the worst of some structures.
    fn at<'a>(&self, all: impl IntoIterator<Item = &'a DriftedCase>, drift: f64) -> Option<Self> {
        let told = all.into_iter().map(|one| one.told(self.damper.as_ref(), self.room));
        let [worst, stroke] = told.reduce(larger)?;
        let error = if self.damper.is_some() { DESIGN * worst } else { 0.0 };
        Some(Self { worst: [worst, error], stroke: self.damper.map(|_| stroke), drift, ..*self })
    }
}

/// No device, and every damper but those that are designed for a drift.
fn linear(
    case: &Case,
    here: &DriftedCase,
    usual: TunedMassDamper,
    equal: TunedMassDamper,
) -> Vec<Row> {
    let damper = |of| Row { damper: Some(of), ..Row::of(Device::Damper, [0.0; 2], 0.0) };
    let mut all = vec![
        Row::of(Device::Without, [0.0; 2], 0.0),
        damper(usual),
        Row { room: Room::Equal, ..damper(equal) },
    ];
    if here.has_stops() {
        all.push(Row { room: Room::Stops, ..damper(usual) });
    }
    let metal = case.alternatives.damper_damping;
    let plain = here.designed(&[], usual, None, Some(metal));
    all.push(Row { given_damping: Some(metal), ..damper(plain) });
    let changed = |factor| TunedMassDamper { tuning: factor * usual.tuning, ..usual };
    let changed = case.alternatives.damper_frequency_factor.map(changed);
    all.extend(changed.map(|of| Row { changed: true, ..damper(of) }));
    all
}

fn larger(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0].max(b[0]), a[1].max(b[1])]
}

/// What devices are compared by: what the first criterion asks about, where a damper has a closed form of it.
fn asked(case: &Case) -> Measure {
    let first = case.criteria.first().map(|one| one.measure);
    match (case.design.scene(), first) {
        (Scene::Release, _) => Measure::DecayTime,
        (_, Some(asked)) if asked.of_sine(1.0, 1.0).is_some() => asked,
        _ => Measure::Peak,
    }
}

/// What the first criterion of a case that is driven steadily found, and whether in an absorber that stays at rest.
fn by_first_criterion(case: &Case, survey: &Survey) -> Option<([f64; 2], bool)> {
    let judged = criteria::judge(case, survey).into_iter().next()?;
    Some(([judged.found?, judged.error], judged.inactive.is_some()))
}

/// The absorber as every page tells it, and whether that is one which stays at rest.
fn own(case: &Case, known: Known<'_>, measure: Measure) -> Option<([f64; 2], bool)> {
    let units = case.units();
    if let Some(study) = known.study {
        let found = study.quantity(&units, measure, Device::Absorber)?;
        let inactive = matches!(study, Study::Release(of) if of.decay().inactive);
        return Some(([found.value, found.error], inactive));
    }
    if measure != Measure::Peak {
        return by_first_criterion(case, known.survey?);
    }
    let worst = known.survey?.worst()?;
    let peak = [worst.peak.value, worst.peak.error].map(|one| units.length(one));
    Some((peak, worst.motion.rest().is_some()))
}

/// The absorber in another structure.
fn absorber(
    case: &Case,
    measure: Measure,
    effort: &Effort,
    on: &dyn Executor,
) -> Result<Option<[f64; 2]>, DrivenError> {
    let units = case.units();
    if case.design.transient().is_none() {
        let effort = Effort { band: BAND, ..effort.short() };
        if measure != Measure::Peak {
            let settings = SurveySettings { effort: Some(effort), ..criteria::settings(case) };
            let survey = Survey::of(&case.range(), &settings, None, on)?;
            return Ok(by_first_criterion(case, &survey).map(|(found, _)| found));
        }
        let found = along(&case.range(), &[], None, Some(&effort), on)?;
        let worst = Worst::of(&found, case.count_inactive);
        return Ok(worst.map(|one| [one.peak.value, one.peak.error].map(|one| units.length(one))));
    }
    let even = case.absorber_places().unwrap_or_default();
    let even = if case.recording.is_some() { even.min(PLACES_OF_RECORD) } else { even };
    let closer = case.recording.is_none();
    let places = Places { even, closer, shaking: measure.is_of_shaking(), executor: on };
    let Some(study) = Study::brief_of_case(case, places) else { return Ok(None) };
    let study = study?;
    let found = study.quantity(&units, measure, Device::Absorber);
    Ok(found.map(|found| [found.value, found.error]))
}

/// The damper of the same mass that is designed for what is asked, as every page tells it.
fn as_designed(known: Known<'_>, here: &DriftedCase) -> TunedMassDamper {
    match (known.study, known.survey) {
        (Some(Study::Release(study)), _) => study.damped().0,
        (Some(Study::Sweep(study)), _) => study.damped().0,
        (Some(Study::Record(study)), _) => study.damper,
        (None, Some(survey)) => survey.rivals().damper,
        (None, None) => TunedMassDamper::den_hartog(here.case.system().mass_ratio()),
    }
}

impl DriftedCase {
    /// For a single frequency the best damper would be undamped, and of no use beside it: that of Den Hartog keeps its
    /// tuning, and gets the damping that is given or as much more as its room asks for.
    fn at_one_frequency(
        &self,
        from: TunedMassDamper,
        room: Option<f64>,
        damping: Option<f64>,
    ) -> TunedMassDamper {
        let with = |damping_ratio: f64| TunedMassDamper { damping_ratio, ..from };
        if let Some(damping) = damping {
            return with(damping);
        }
        let room = room.map_or(f64::INFINITY, |room| room * self.case.design.clearance());
        more_damped(from, |damper| self.told(Some(damper), Room::AsDesigned)[1] <= room)
    }

    /// The damper whose worst value over this structure and others is smallest, within a room over the clearance, of a
    /// damping that may be given.
    fn designed(
        &self,
        others: &[Self],
        from: TunedMassDamper,
        room: Option<f64>,
        damping: Option<f64>,
    ) -> TunedMassDamper {
        if self.is_of_one_frequency() {
            return self.at_one_frequency(from, room, damping);
        }
        let how = Designing { damping, ..self.designing() };
        let all: Vec<&Self> = others.iter().chain([self]).collect();
        let clearance = self.case.design.clearance();
        let cost = |damper: &TunedMassDamper| {
            let found = all.iter().map(|one| one.told(Some(damper), Room::AsDesigned));
            let [worst, stroke] = found.reduce(larger).unwrap_or([f64::INFINITY; 2]);
            let beyond = room.map_or(0.0, |room| (stroke / (room * clearance) - 1.0).max(0.0));
            worst * (1.0 + PENALTY * beyond)
        };
        let Some(room) = room else { return dampers::best(from, how, cost) };
        // What keeps a damper in little room may be far from what it does with much: from its damping up to a multiple of the
        // critical one.
        let ratio = HEAVY / from.damping_ratio.clamp(1e-6, 0.5 * HEAVY);
        let heavier = |k: u32| libm::pow(ratio, f64::from(k) / f64::from(DAMPINGS));
        let others = TUNINGS.iter().flat_map(|tuning| {
            (0..=DAMPINGS).map(move |k| TunedMassDamper {
                tuning: tuning * from.tuning,
                damping_ratio: from.damping_ratio * heavier(k),
            })
        });
        let first = others.chain([from]).min_by(|a, b| cost(a).total_cmp(&cost(b)));
        let found = dampers::best(first.unwrap_or(from), how, cost);
        let fits = |damper: &TunedMassDamper| {
            let strokes = all.iter().map(|one| one.told(Some(damper), Room::AsDesigned)[1]);
            strokes.fold(0.0, f64::max) <= (1.0 + DESIGN) * room * clearance
        };
        more_damped(found, fits)
    }
}
