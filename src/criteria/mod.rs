//! What a case asks for, held against what its design does: each criterion by the cheapest layer that
//! can decide it.
//!
//! Shares are roots ([`crate::band`]). An amplitude, a count of impacts or their speed must hold for every
//! motion that can happen: the exact symmetric orbit where one attracts, what starts lead to along the band,
//! and that of an absorber which never wakes. What is found is the worst of all with its error, whatever the
//! limit is: two designs, or two limits, can be compared.

mod scope;
mod transient;

use crate::band::rivals::reduction_db;
use crate::band::simulated::Sampling;
use crate::band::{Band, Rivals, Survey, SurveySettings};
use crate::case::{Case, Criterion, Relation, Scales, Subject};
use crate::method::Method;
use crate::regimes::Motion;

use scope::Scope;
pub use transient::{judge_release, judge_sweep, judge_transient, of_records};

/// Distance from a count that still is that count: as regimes are told apart.
const SAME_COUNT: f64 = 0.01;

/// A criterion and what was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Judged {
    /// What was asked.
    pub criterion: Criterion,
    /// Records that it is about; 0 where none drives the structure.
    pub records: usize,
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
    /// Place in the band where it is worst: `Omega`, or amplitude over the case's own.
    pub at: Option<f64>,
    /// Share of the absorber's resting places from which a start from rest stays in the motion that
    /// decides, where that is the motion of an absorber that never wakes.
    pub inactive: Option<f64>,
    /// Whether the motion that decides has settled: false where it drifts for longer than a run can wait.
    pub settled: bool,
    /// The layer that `found` is from.
    pub decided_by: Method,
}

/// A motion of the oscillator, whichever layer it is from. Lengths over the clearance, fast time; each
/// value with its absolute error.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Seen {
    peak: [f64; 2],
    rms: [f64; 2],
    impact_speed: [f64; 2],
    impacts_per_period: [f64; 2],
}

/// Relative error of an orbit: rounding.
const ROUNDING: f64 = 1e-9;

impl Seen {
    /// A motion of a survey, in which the largest peak may be larger by `unresolved` than at its places.
    fn simulated(motion: &Motion, unresolved: f64) -> Self {
        Self {
            peak: [motion.peak, motion.peak_error.max(unresolved)],
            rms: [motion.rms, motion.rms_error],
            impact_speed: [motion.impact_speed, motion.impact_speed_error],
            impacts_per_period: [motion.impacts_per_period, motion.impacts_error],
        }
    }

    /// Of a sine about a place that the absorber's weight shifts.
    fn inactive(amplitude: f64, sag: f64) -> Self {
        let rms = libm::hypot(amplitude / std::f64::consts::SQRT_2, sag);
        Self {
            peak: [amplitude + sag, 0.0],
            rms: [rms, 0.0],
            impact_speed: [0.0; 2],
            impacts_per_period: [0.0; 2],
        }
    }
}

/// Whether criteria can only be judged with simulation.
pub fn needs_simulation(criteria: &[Criterion]) -> bool {
    criteria.iter().any(|one| one.subject.is_of_motions())
}

/// The range in which a case's criteria are asked about: its band, or its own excitation alone.
pub fn range(case: &Case) -> Band {
    let system = case.system();
    case.band.as_ref().map_or_else(|| Band::point(&system), |band| Band::of(&system, band))
}

/// What a survey has to look at to judge a case: nothing is simulated that no criterion needs. The worst
/// value is known to the error that `[accuracy]` asks for.
pub fn settings(case: &Case) -> SurveySettings {
    let needed = needs_simulation(&case.criteria);
    SurveySettings { sampling: needed.then(|| sampling(case)), count_inactive: case.count_inactive }
}

/// How thoroughly a case's range is simulated, where it is.
pub fn sampling(case: &Case) -> Sampling {
    let asked = case.accuracy.and_then(|asked| asked.amplitude);
    Sampling { tolerance: asked.unwrap_or(Sampling::FULL.tolerance), ..Sampling::FULL }
}

/// Judges every criterion of a case by a survey of its range, as [`settings`] asks for it.
pub fn judge(case: &Case, survey: &Survey) -> Vec<Judged> {
    let scope = Scope { survey, scales: case.scales() };
    case.criteria.iter().map(|criterion| scope.judge(criterion)).collect()
}

impl Criterion {
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
        let within = error > 0.0 && room.abs() <= error;
        let worst = self.subject.is_worst(records);
        let against =
            if self.subject.is_reduction() { Relation::AtLeast } else { Relation::AtMost };
        within && (room >= 0.0 || !(worst && self.relation == against))
    }

    /// Whether it is the harder to meet, the further the oscillator moves.
    fn is_against_displacement(&self) -> bool {
        match self.relation {
            Relation::AtMost => self.subject == Subject::PeakDisplacement,
            Relation::AtLeast => self.subject.is_reduction(),
            Relation::Equal => false,
        }
    }

    /// A value that is known of the whole range, or of a motion that has settled.
    fn judged(&self, found: Option<f64>, error: f64, decided_by: Method) -> Judged {
        // What is about motions holds if it does so with its error.
        let counts = self.subject.is_of_motions() && self.relation != Relation::Equal;
        let margin = found.map(|found| self.room(found));
        Judged {
            criterion: self.clone(),
            records: 0,
            found,
            error,
            margin,
            holds: margin.map(|room| room >= if counts { error } else { 0.0 }),
            near_limit: margin.is_some_and(|room| self.is_open(room, error, 0)),
            at: None,
            inactive: None,
            settled: true,
            decided_by,
        }
    }
}

impl Judged {
    /// The same of a value under so many records, whose error may mean something else.
    fn under(self, records: usize) -> Self {
        let open = |room| self.criterion.is_open(room, self.error, records);
        Self { records, near_limit: self.margin.is_some_and(open), ..self }
    }
}

/// Judges the criterion on the peak, if a case has one, by one motion at the case's own excitation.
pub fn judge_peak(case: &Case, motion: &Motion) -> Option<Judged> {
    let asked = |one: &&Criterion| one.subject == Subject::PeakDisplacement;
    let [peak, error] = [motion.peak, motion.peak_error].map(|one| case.scales().length(one));
    let asked = case.criteria.iter().find(asked)?;
    Some(asked.judged(Some(peak), error, Method::Simulation))
}

/// Whether every criterion holds; what could not be measured does not.
pub fn all_hold(judged: &[Judged]) -> bool {
    judged.iter().all(|one| one.holds == Some(true))
}

/// What a motion has of a subject, in the unit of the criterion, and its error. Reductions are against
/// the largest amplitudes of bare oscillator and tuned mass damper along the range.
fn of_motion(subject: Subject, seen: &Seen, rivals: &Rivals, scales: &Scales) -> Option<[f64; 2]> {
    let length = |value: [f64; 2]| value.map(|one| scales.length(one));
    let decibels = |against: f64| {
        if against.is_infinite() {
            // Anything is less than what has no limit: that says nothing.
            return None;
        }
        let [peak, error] = seen.peak;
        Some([reduction_db(peak, against), 20.0 * libm::log10(1.0 + error / peak)])
    };
    Some(match subject {
        Subject::PeakDisplacement => length(seen.peak),
        Subject::RmsDisplacement => length(seen.rms),
        Subject::ReductionDb => decibels(rivals.bare.1)?,
        Subject::ReductionDbTmd => decibels(rivals.damped.amplitude)?,
        Subject::ImpactVelocity => seen.impact_speed.map(|speed| scales.velocity(speed)),
        Subject::ImpactsPerPeriod => seen.impacts_per_period,
        Subject::Z3Share
        | Subject::StableShare
        | Subject::MarginClearance
        | Subject::NoCoexistence
        | Subject::DecayTime => return None,
    })
}
