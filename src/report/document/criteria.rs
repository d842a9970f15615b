//! Judged criteria as data, for `check`, the report and the index.

use serde::Serialize;

use super::scale::Scale;
use crate::case::{Case, Criterion, Relation, Subject};
use crate::criteria::Judged;
use crate::method::Method;
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;

/// What all criteria together came to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Badge {
    /// Every criterion holds.
    Holds,
    /// One fails by more than its error.
    Fails,
    /// None fails, but an error could turn one.
    TooCloseToCall,
}

/// What one criterion came to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// It holds.
    Holds,
    /// It does not.
    Fails,
    /// Its error could turn it.
    TooCloseToCall,
    /// Nothing could be measured.
    NotMeasured,
}

/// All criteria of a case.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CriteriaFacts {
    /// What they came to together.
    pub badge: Badge,
    /// How many there are.
    pub count: usize,
    /// How many fail, those too close to call that do not hold included.
    pub failing: usize,
    /// How many an error could turn.
    pub too_close: usize,
    /// Whether the motion of an inactive absorber counts.
    pub count_inactive: bool,
    /// One for each line of `[criteria]`, in the order of a report.
    pub all: Vec<CriterionFacts>,
}

/// A judged criterion.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CriterionFacts {
    /// Its key in the case file.
    pub name: &'static str,
    /// What was asked, as written.
    pub asked: String,
    /// `at-least`, `at-most`, `equal`, or `yes` for one without a number.
    pub relation: &'static str,
    /// What it is about; none for one without a number.
    pub limit: Option<Quantity>,
    /// What was found, with its error.
    pub found: Option<Quantity>,
    /// For one without a number.
    pub found_flag: Option<bool>,
    /// Room that is left; negative where it does not hold.
    pub margin: Option<Quantity>,
    /// What it came to.
    pub outcome: Outcome,
    /// Whether it holds.
    pub holds: Option<bool>,
    /// Where along the band it is worst.
    pub at: Option<Quantity>,
    /// Share of the resting places from which the absorber stays inactive, where that motion decides.
    pub inactive_share: Option<Quantity>,
    /// Whether the motion that decides has settled.
    pub settled: bool,
    /// The layer that decided.
    pub decided_by: Method,
    /// How far `found` may be off, whether or not a page shows it.
    #[serde(skip)]
    pub error: f64,
}

impl CriteriaFacts {
    /// Those that were judged; none where the case asks for nothing.
    pub fn of(case: &Case, judged: &[Judged]) -> Option<Self> {
        let scale = Scale::of(case);
        let all: Vec<CriterionFacts> =
            judged.iter().map(|one| CriterionFacts::of(case, &scale, one)).collect();
        let fails =
            |one: &CriterionFacts| matches!(one.outcome, Outcome::Fails | Outcome::NotMeasured);
        let close = |one: &&CriterionFacts| one.outcome == Outcome::TooCloseToCall;
        let too_close = all.iter().filter(close).count();
        let badge = match (all.iter().any(fails), too_close) {
            (true, _) => Badge::Fails,
            (false, 0) => Badge::Holds,
            (false, _) => Badge::TooCloseToCall,
        };
        (!all.is_empty()).then(|| Self {
            badge,
            count: all.len(),
            failing: all.iter().filter(|one| one.holds != Some(true)).count(),
            too_close,
            count_inactive: case.count_inactive,
            all,
        })
    }
}

impl CriterionFacts {
    fn of(case: &Case, scale: &Scale, judged: &Judged) -> Self {
        let Criterion { subject, relation, limit, as_written } = &judged.criterion;
        let method = judged.decided_by;
        let kind = subject.kind();
        let quantity = |value: f64| kind.map(|kind| Quantity::new(kind, value, method));
        // The errors of shares and margins are rounding, or theory's own.
        let error = if subject.is_of_motions() { judged.error } else { 0.0 };
        Self {
            name: subject.key(),
            asked: as_written.clone(),
            relation: match (kind, relation) {
                (None, _) => "yes",
                (_, Relation::AtLeast) => "at-least",
                (_, Relation::AtMost) => "at-most",
                (_, Relation::Equal) => "equal",
            },
            limit: kind.map(|kind| Quantity::new(kind, *limit, Method::Given)),
            found: judged.found.and_then(quantity).map(|found| found.with_error(error)),
            found_flag: judged.found.filter(|_| kind.is_none()).map(|found| found > 0.5),
            margin: judged
                .margin
                .filter(|_| *subject != Subject::ImpactsPerPeriod)
                .and_then(quantity),
            outcome: match (judged.holds, judged.near_limit) {
                (None, _) => Outcome::NotMeasured,
                (_, true) => Outcome::TooCloseToCall,
                (Some(true), _) => Outcome::Holds,
                (Some(false), _) => Outcome::Fails,
            },
            holds: judged.holds,
            at: judged.at.zip(case.band.as_ref()).map(|(at, band)| scale.place(band.over, at)),
            inactive_share: judged
                .inactive
                .map(|share| Quantity::new(&of::INACTIVE_SHARE, share, Method::ClosedForm)),
            settled: judged.settled,
            decided_by: judged.decided_by,
            error: judged.error,
        }
    }
}
