//! What a case asks for, held against what its design does: each criterion by the cheapest layer that
//! can decide it.
//!
//! Shares are roots ([`crate::band`]). An amplitude, a count of impacts or their speed must hold for every
//! motion that can happen ([`crate::motions`]) and counts. What is found is the worst of all with its error, whatever the
//! limit is: two designs, or two limits, can be compared. One that only a motion decides which is still settling is not
//! decided.

pub mod contact;
mod found;
mod scope;

use crate::band::{Rivals, Survey, SurveySettings};
use crate::case::{Case, Criterion, Of, Relation};
use crate::dampers::SineLimits;
use crate::linear::{BandSystems, bare_along, bare_amplitude};
use crate::measure::{Device, Measure};
use crate::method::Method;
use crate::motions::{Along, Extreme, Fact, Motion, MotionKind, Motions, RestKind};
use crate::system::MOST_MODES;
use crate::transient::{Sample, Study};

pub use contact::Contact;
pub use found::{Findings, Found, Worst};
use scope::Scope;
use vinesink_core::names;

names! { name:
    /// What a criterion came to, the worse the later.
    pub enum Outcome {
        /// It is met, with its error.
        Holds = "holds",
        /// What was found meets or misses it by less than its error.
        TooCloseToCall = "too-close-to-call",
        /// A motion that could decide otherwise was still settling.
        NotDecided = "not-decided",
        /// Nothing could be measured.
        NotMeasured = "not-measured",
        /// It is missed by what was found.
        Fails = "fails",
    }
}

/// What several came to together: the worst of them; none where there are none.
pub fn together(judged: &[Judged]) -> Option<Outcome> {
    judged.iter().map(Judged::outcome).max()
}

/// Distance from a count that still is that count: as regimes are told apart.
const SAME_COUNT: f64 = 0.01;

/// A criterion and what was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Judged {
    /// What was asked.
    pub criterion: Criterion,
    /// Records that it is about; 0 where none drives the structure.
    pub records: usize,
    /// From which places of the absorber it is known, where that is not driven steadily: others may be worse.
    pub sample: Option<Sample>,
    /// What was found, in the criterion's unit; none where nothing could be measured.
    pub found: Option<f64>,
    /// How far that may be off by what the deciding layer neglects: the theory's boundaries by its own
    /// order, a simulated average by two standard errors, an orbit by rounding.
    pub error: f64,
    /// Room that is left, in the criterion's unit; negative where it does not hold.
    pub margin: Option<f64>,
    /// Whether it holds; none where nothing could be measured.
    pub holds: Option<bool>,
    /// Whether it is so close to its limit that the error could turn it.
    pub near_limit: bool,
    /// Under which load of the case it is worst.
    pub load: usize,
    /// Place in the band where it is worst: `Omega`, or amplitude over the case's own; of several modes the frequency in Hz.
    pub at: Option<f64>,
    /// Which place or absorber of the structure is worst there.
    pub of: Of,
    /// The place of the motion that decides, in the list there.
    pub motion: Option<usize>,
    /// Share of the absorber's resting places from which a start from rest stays in that motion, where it is that of an
    /// absorber at rest.
    pub inactive: Option<f64>,
    /// Which absorbers rest in it, by their numbers from 0.
    pub resting: [bool; MOST_MODES],
    /// That share of an absorber at rest with which it would not hold, where it is too small for that motion to count.
    pub but_at_rest: Option<f64>,
    /// Excitation periods after which a motion that could decide otherwise was still settling: it is not decided then, and
    /// does not hold.
    pub undecided: Option<u64>,
    /// The layer that `found` is from.
    pub decided_by: Method,
    /// What impacts that take time make of it; none where they take none. The error covers the difference.
    pub contact: Option<Contact>,
}

/// The layer that a motion is known by.
pub fn method(motion: &Motion) -> Method {
    match motion.kind() {
        MotionKind::Rest(rest) if rest.rest == RestKind::Sliding => Method::Simulation,
        MotionKind::Rest(_) => Method::ClosedForm,
        MotionKind::Orbit(_) => Method::ExactOrbit,
        MotionKind::Repeats(_) | MotionKind::Wanders => Method::Simulation,
    }
}

/// The layer that the stability of 1:1 motions along a band is known by.
pub fn of_stability(motions: &Along) -> Method {
    if motions.stability_is_exact() { Method::ExactOrbit } else { Method::Simulation }
}

/// Error of what is a root: its rounding.
const ROUNDING: f64 = 1e-9;

/// Whether criteria can only be judged with simulation.
pub fn needs_simulation(criteria: &[Criterion]) -> bool {
    criteria.iter().any(|one| one.measure.is_of_motions())
}

/// Whether a structure that is driven steadily meets what is asked of it without an absorber too; not where only an absorber
/// can, or nothing is asked of the structure. `largest` says to how much of a measure that has a closed form it comes alone.
pub(crate) fn kept_alone(
    criteria: &[Criterion],
    largest: impl Fn(&Criterion) -> Option<f64>,
) -> bool {
    let of_absorbers = [Measure::ImpactSpeed, Measure::ImpactsPerPeriod, Measure::NoCoexistence];
    let mut of_structure =
        criteria.iter().filter(|one| !of_absorbers.contains(&one.measure)).peekable();
    let keeps = |one: &Criterion| {
        one.relation == Relation::AtMost && largest(one).is_some_and(|most| most <= one.limit)
    };
    of_structure.peek().is_some() && of_structure.all(keeps)
}

/// The same of a case with one mode.
pub fn kept_without_absorber(case: &Case) -> bool {
    let (range, units) = (case.range(), case.units());
    let along = BandSystems::of(&range);
    let largest = |one: &Criterion| {
        let kind = one.measure.kind(Device::Without).filter(|_| one.measure.is_of_sines())?;
        Some(units.number(kind.dimension, one.measure.largest_of_sines(&along, bare_amplitude)))
    };
    case.design.transient().is_none() && kept_alone(&case.criteria, largest)
}

/// What a survey has to look at to judge a case: nothing is simulated that no criterion needs. The worst
/// value is known to the error that `[accuracy]` asks for.
pub fn settings(case: &Case) -> SurveySettings {
    let shocks = case.units().pulse().is_some();
    let facts = |one: Measure| {
        let speed = (shocks && one == Measure::PeakAcceleration).then_some(Fact::ImpactSpeed);
        one.fact().into_iter().chain(speed)
    };
    let sides = case.criteria.iter().flat_map(|one| facts(one.measure).map(move |of| (of, one)));
    let extremes = sides.flat_map(|(of, one)| {
        let larger_is_worse = (one.relation == Relation::AtMost) != one.measure.against().is_some();
        let both = one.relation == Relation::Equal;
        let wanted =
            |least: bool| (both || least != larger_is_worse).then_some(Extreme { of, least });
        [false, true].into_iter().filter_map(wanted).collect::<Vec<_>>()
    });
    SurveySettings {
        effort: needs_simulation(&case.criteria).then(|| case.effort()),
        extremes: extremes.collect(),
        count_rest: case.count_inactive,
        asked: sine_limits(case),
    }
}

/// What is asked at most of a structure that moves in sines, over the clearance and in fast time.
pub fn sine_limits(case: &Case) -> SineLimits {
    let units = case.units();
    let limits = case.criteria.iter().filter(|one| one.limits_sines());
    SineLimits::of(limits.filter_map(|one| {
        let kind = one.measure.kind(Device::Damper)?;
        Some((one.measure, one.limit / units.number(kind.dimension, 1.0)))
    }))
}

/// Judges every criterion of a case by a survey of its range, as [`settings`] asks for it.
pub fn judge(case: &Case, survey: &Survey) -> Vec<Judged> {
    let scope = Scope { survey, units: case.units() };
    case.criteria.iter().map(|criterion| scope.judge(criterion)).collect()
}

/// What each motion of a survey that counts has of a criterion of a case.
pub fn each(case: &Case, survey: &Survey, asked: &Criterion) -> Vec<Found> {
    Scope { survey, units: case.units() }.each(asked)
}

/// Places of a survey that are worth another search, the worst of each criterion first; `known` were searched in full. None
/// where that cannot change what all criteria together come to.
pub fn open(case: &Case, survey: &Survey, judged: &[Judged], known: &[f64]) -> Vec<f64> {
    let scope = Scope { survey, units: case.units() };
    if judged.iter().any(|one| scope.fails_for_good(one, known)) {
        return Vec::new();
    }
    let of_motions = case.criteria.iter().filter(|one| one.measure.is_of_motions());
    let each: Vec<Vec<f64>> = of_motions.map(|one| scope.open(one)).collect();
    let fails = judged.iter().any(|one| one.outcome() == Outcome::Fails);
    // What was searched in full and is open is so whatever other places come to.
    if !fails && each.iter().flatten().any(|at| known.contains(at)) {
        return Vec::new();
    }
    let mut open = Vec::new();
    for rank in 0..each.iter().map(Vec::len).max().unwrap_or_default() {
        for at in each.iter().filter_map(|places| places.get(rank)) {
            if !open.contains(at) && !known.contains(at) {
                open.push(*at);
            }
        }
    }
    open
}

/// Says whether a motion at a place of a case's range that counts misses a criterion: not all can hold then.
pub fn misses(case: &Case) -> impl Fn(&Motions) -> bool + '_ {
    let (range, units) = (case.range(), case.units());
    let against = |one: &Criterion| {
        let damped = || Rivals::of_displacement(&range).damped.amplitude;
        one.measure.compared_with(|| bare_along(&range).1, damped)
    };
    let of_motions = case.criteria.iter().filter(|one| one.measure.is_of_motions());
    let asked: Vec<(&Criterion, f64)> = of_motions.map(|one| (one, against(one))).collect();
    move |here: &Motions| {
        let misses = |motion: &Motion, (one, against): &(&Criterion, f64)| {
            let found = one.measure.of_motion(motion, &|fact| fact.of(motion), *against, &units);
            found.is_some_and(|own| one.is_missed_by(own, method(motion), motion.settled()))
        };
        here.counting(case.count_inactive)
            .any(|(_, motion)| asked.iter().any(|one| misses(motion, one)))
    }
}

/// Decibels that count as much as missing a limit by all of it: a factor of 2.
const DOUBLE_DB: f64 = 6.0;

impl Criterion {
    /// What missing it by all of it is, in its unit.
    pub fn scale(&self) -> f64 {
        match self.measure {
            Measure::ReductionDb | Measure::ReductionDbTmd => DOUBLE_DB,
            Measure::NoCoexistence => 1.0,
            _ => self.limit.max(f64::MIN_POSITIVE),
        }
    }

    /// Whether it limits what a structure does that moves in sines, so that a linear device may be designed for it.
    pub(crate) fn limits_sines(&self) -> bool {
        self.relation == Relation::AtMost && self.measure.is_of_sines()
    }

    /// What a value is of what is allowed: 1 at the limit, more where it is missed.
    pub fn part(&self, value: f64) -> f64 {
        1.0 - self.room(value) / self.scale()
    }

    /// Room that a value leaves: positive where it holds.
    fn room(&self, value: f64) -> f64 {
        match self.relation {
            Relation::AtLeast => value - self.limit,
            Relation::AtMost => self.limit - value,
            Relation::Equal => SAME_COUNT - (value - self.limit).abs(),
        }
    }

    /// Whether the error could turn what holds or not. The worst value seen may be worse, and not better.
    fn is_open(&self, room: f64, error: f64, records: usize) -> bool {
        let within = is_within(room, error);
        let worst = self.measure.is_worst(records);
        let against =
            if self.measure.against().is_some() { Relation::AtLeast } else { Relation::AtMost };
        within && (room >= 0.0 || !(worst && self.relation == against))
    }

    /// Whether a motion that has so much of it, with the error that is its own, still settles or does not meet it: whatever else
    /// there is, it does not hold then.
    pub(crate) fn is_missed_by(
        &self,
        [value, error]: [f64; 2],
        known_by: Method,
        settled: bool,
    ) -> bool {
        !settled || self.judged(Some(value), error, known_by).outcome() != Outcome::Holds
    }

    /// A value that is known of the whole range, or of a motion that has settled.
    fn judged(&self, found: Option<f64>, error: f64, decided_by: Method) -> Judged {
        // What is about motions holds if it does so with its error.
        let counts = self.measure.is_of_motions() && self.relation != Relation::Equal;
        let margin = found.map(|found| self.room(found));
        Judged {
            criterion: self.clone(),
            records: 0,
            sample: None,
            found,
            error,
            margin,
            holds: margin.map(|room| room >= if counts { error } else { 0.0 }),
            near_limit: margin.is_some_and(|room| self.is_open(room, error, 0)),
            at: None,
            motion: None,
            inactive: None,
            resting: [false; MOST_MODES],
            but_at_rest: None,
            undecided: None,
            load: 0,
            of: Of::Any,
            decided_by,
            contact: None,
        }
    }
}

impl Judged {
    /// What is asked of the motions of a structure, by what is known of them.
    pub fn of_motions(criterion: &Criterion, of: &dyn Findings) -> Self {
        match criterion.measure {
            Measure::NoCoexistence => found::one_motion(of, criterion),
            _ => found::worst(of, criterion),
        }
    }

    /// What is asked of where a 1:1 motion attracts, or by how much a clearance may be off: worst at a place under a load.
    pub fn of_stability(criterion: &Criterion, found: f64, load: usize, at: Option<f64>) -> Self {
        // All and nothing have no end that could be off.
        let is_whole = found == 0.0 || found == 1.0;
        let error = if is_whole { 0.0 } else { ROUNDING };
        Self { load, at, ..criterion.judged(Some(found), error, Method::ExactOrbit) }
    }

    /// What it came to: it may be so close to its limit that its error could turn it.
    pub const fn outcome(&self) -> Outcome {
        match (self.holds, self.near_limit) {
            (None, _) => Outcome::NotMeasured,
            _ if self.undecided.is_some() => Outcome::NotDecided,
            (_, true) if matches!(self.contact, Some(Contact { crosses: true, .. })) => {
                Outcome::NotDecided
            }
            (_, true) => Outcome::TooCloseToCall,
            (Some(true), _) => Outcome::Holds,
            (Some(false), _) => Outcome::Fails,
        }
    }

    /// Whether it fails by a simulated value that misses the limit by less than its error.
    pub fn fails_within_its_error(&self) -> bool {
        let within = self.margin.is_some_and(|room| is_within(room, self.error));
        self.outcome() == Outcome::Fails && within && self.decided_by == Method::Simulation
    }

    /// The same of what becomes of places of the absorber, under records whose error may mean something else.
    fn of_study(self, study: &Study) -> Self {
        let (records, sample) = (study.records(), study.sample());
        let open = |room| self.criterion.is_open(room, self.error, records);
        Self { records, sample, near_limit: self.margin.is_some_and(open), ..self }
    }
}

/// Whether the error could turn a sign of the room.
fn is_within(room: f64, error: f64) -> bool {
    error > 0.0 && room.abs() <= error
}

/// Whether every criterion holds; what could not be measured does not.
pub fn all_hold(judged: &[Judged]) -> bool {
    judged.iter().all(|one| one.holds == Some(true))
}

/// Judges every criterion of a case that is not driven steadily.
pub fn judge_transient(case: &Case, study: &Study) -> Vec<Judged> {
    let units = case.units();
    let inactive = match study {
        Study::Release(study) => Some(study.inactive.share),
        _ => None,
    };
    let judge = |criterion: &Criterion| {
        let Some(found) = study.quantity(&units, criterion.measure, Device::Absorber) else {
            return criterion.judged(None, 0.0, Method::Simulation);
        };
        let judged = criterion.judged(Some(found.value), found.error, found.method);
        // What is not simulated is the structure alone, where no wall reaches the absorber.
        let inactive = inactive.filter(|_| found.method == Method::ClosedForm);
        Judged { inactive, ..judged }.of_study(study)
    };
    case.criteria.iter().map(judge).collect()
}
