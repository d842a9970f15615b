//! What a case asks for, held against what its design does: each criterion by the cheapest layer that
//! can decide it.
//!
//! Shares are roots ([`crate::band`]). An amplitude, a count of impacts or their speed must hold for every
//! motion that is found: for the exact symmetric orbit where one attracts, and for what starts lead to
//! along the band, that from rest among them, as an orbit does not know which other motions there are.
//! What is found is the worst of all, whatever the limit is: two designs, or two limits, can be compared.

mod scope;

use crate::band::Survey;
use crate::case::{Case, Criterion, Relation, Scales, Subject};
use crate::regimes::long_term::Motion;
use crate::simulation::StartError;
use crate::study::fidelity::Fidelity;

pub use scope::Scope;

/// Distance from a count that still is that count: as regimes are told apart.
const SAME_COUNT: f64 = 0.01;

/// A value of the design, as a criterion is about.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Value {
    /// In the criterion's unit.
    found: f64,
    /// How far it may be off.
    error: f64,
    /// Place in the band, where it is the worst of one.
    at: Option<f64>,
    by: Fidelity,
}

/// A criterion and what was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Judged {
    /// What was asked.
    pub criterion: Criterion,
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
    /// The layer that `found` is from.
    pub decided_by: Fidelity,
}

/// A motion of the oscillator, whichever layer it is from. Lengths over the clearance, fast time.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Seen {
    peak: f64,
    rms: f64,
    impact_speed: f64,
    impacts_per_period: f64,
    /// Relative, of amplitudes and speeds.
    error: f64,
    impacts_error: f64,
}

/// What an orbit leaves open: rounding.
const ROUNDING: f64 = 1e-9;
/// What a simulated window leaves open of a peak, beside the scatter of its average: the largest of
/// some hundred periods is not the largest of all.
const PEAK_OF_A_WINDOW: f64 = 0.01;

impl From<&Motion> for Seen {
    fn from(motion: &Motion) -> Self {
        Self {
            peak: motion.peak,
            rms: motion.rms,
            impact_speed: motion.impact_speed,
            impacts_per_period: motion.impacts_per_period,
            error: motion.rms_error / motion.rms.max(f64::MIN_POSITIVE) + PEAK_OF_A_WINDOW,
            impacts_error: motion.impacts_error,
        }
    }
}

/// Judges every criterion of a case; what is already known along its band is not found again.
///
/// # Errors
/// [`StartError`] where a start of a simulation is not finite.
pub fn judge(case: &Case, known: Option<&Survey>) -> Result<Vec<Judged>, StartError> {
    let scope = Scope::of(case, known);
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

    fn judged(&self, value: Option<Value>, otherwise: Fidelity) -> Judged {
        let Some(value) = value else {
            return Judged {
                criterion: self.clone(),
                found: None,
                error: 0.0,
                margin: None,
                holds: None,
                near_limit: false,
                at: None,
                decided_by: otherwise,
            };
        };
        let room = self.room(value.found);
        Judged {
            criterion: self.clone(),
            found: Some(value.found),
            error: value.error,
            margin: Some(room),
            holds: Some(room >= 0.0),
            near_limit: value.error > 0.0 && room.abs() <= value.error,
            at: value.at,
            decided_by: value.by,
        }
    }
}

/// Whether every criterion holds; what could not be measured does not.
pub fn all_hold(judged: &[Judged]) -> bool {
    judged.iter().all(|one| one.holds == Some(true))
}

/// What a motion has of a subject, in the unit of the criterion, and its error. Reductions are against
/// the largest amplitudes of bare oscillator and tuned mass damper along the range.
fn of_motion(
    subject: Subject,
    seen: &Seen,
    [bare, damper]: [f64; 2],
    scales: &Scales,
) -> Option<(f64, f64)> {
    let length = |value: f64| (scales.length(value), scales.length(value) * seen.error);
    let decibels = |against: f64| {
        if against.is_infinite() {
            // Anything is less than what has no limit: that says nothing.
            return None;
        }
        let reduction = crate::band::rivals::reduction_db(seen.peak, against);
        Some((reduction, 20.0 * libm::log10(1.0 + seen.error)))
    };
    Some(match subject {
        Subject::PeakDisplacement => length(seen.peak),
        Subject::RmsDisplacement => length(seen.rms),
        Subject::ReductionDb => decibels(bare)?,
        Subject::ReductionDbTmd => decibels(damper)?,
        Subject::ImpactVelocity => {
            let speed = scales
                .velocity_m_per_s(seen.impact_speed)
                .unwrap_or_else(|| scales.length(seen.impact_speed));
            (speed, speed * seen.error)
        }
        Subject::ImpactsPerPeriod => (seen.impacts_per_period, seen.impacts_error),
        Subject::Z3Share
        | Subject::StableShare
        | Subject::MarginClearance
        | Subject::NoCoexistence => return None,
    })
}
