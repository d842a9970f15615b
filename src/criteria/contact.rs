//! Criteria where impacts take time: the motions of the clearance and restitution that act like it are looked for as well
//! ([`crate::contact`]). Their difference is an error of every number of a motion, and where another motion decides there, nothing
//! is decided.

use super::{Judged, Outcome};
use crate::band::{Band, Survey, SurveySettings};
use crate::case::Case;
use crate::contact::Impacts;
use crate::measure::{Device, Measure};
use crate::motions::{Effort, Motions};
use crate::transient::Study;

/// The fastest of the motions where criteria are worst along a survey, whether it is those that decide or others.
fn fastest(survey: &Survey, judged: &[Judged]) -> Option<Impacts> {
    let mut places: Vec<f64> = Vec::new();
    for at in judged.iter().map(|one| one.at.unwrap_or_else(|| survey.band().own())) {
        if !places.contains(&at) {
            places.push(at);
        }
    }
    let each = places.into_iter().flat_map(|at| {
        let system = survey.band().system(at).ok();
        let motions = survey.motions.at(at).into_iter().flat_map(Motions::iter);
        motions.filter_map(move |motion| Impacts::of(&system?, motion))
    });
    each.max_by(|a, b| a.speed.total_cmp(&b.speed))
}

/// What a motion is, as far as a limit of it is one: at rest, one to one, or another.
fn kind(survey: &Survey, judged: &Judged) -> Option<[bool; 2]> {
    let at = judged.at.unwrap_or_else(|| survey.band().own());
    let motion = survey.motions.at(at)?.get(judged.motion?)?;
    Some([motion.rest().is_some(), motion.is_one_to_one()])
}

/// The criteria of a case that is driven steadily, by a survey of it, with what a contact time makes of them: the range of the pair that
/// acts like it is looked along by `again` with the same effort.
///
/// # Errors
/// Those of `again`.
pub fn judge_in_contact<E>(
    case: &Case,
    survey: &Survey,
    effort: Effort,
    again: impl Fn(&Band, &SurveySettings) -> Result<Survey, E>,
) -> Result<Vec<Judged>, E> {
    let own = super::judge(case, survey);
    let Some(time) = case.impacts_take() else { return Ok(own) };
    let (mut there, mut judged) = (survey.clone(), own.clone());
    // Speeds at the pair itself: one more step is of second order.
    for _ in 0..2 {
        let Some(impacts) = fastest(&there, &judged) else { break };
        let Some(shifted) = case.acting_like(impacts, time) else { break };
        let settings = super::settings(&shifted);
        // An absorber at rest meets its walls where they are.
        let effort = settings.effort.map(|_| effort);
        let settings = SurveySettings { effort, count_rest: false, ..settings };
        there = again(&shifted.range(), &settings)?;
        judged = super::judge(&shifted, &there);
    }
    let each = own.into_iter().zip(&judged).map(|(own, shifted)| {
        let crosses = kind(survey, &own) != kind(&there, shifted);
        own.in_contact(shifted, crosses)
    });
    Ok(each.collect())
}

/// The same of a case that is not driven steadily, by its study; `again` studies another.
///
/// # Errors
/// Those of `again`.
pub fn judge_transient_in_contact<E>(
    case: &Case,
    study: &Study,
    again: impl Fn(&Case) -> Result<Study, E>,
) -> Result<Vec<Judged>, E> {
    let own = super::judge_transient(case, study);
    let (Some(time), false) = (case.impacts_take(), own.is_empty()) else { return Ok(own) };
    let units = case.units();
    let largest = |of: Measure| study.quantity(&units, of, Device::Absorber);
    let impacts = largest(Measure::ImpactSpeed).zip(largest(Measure::Peak)).map(|(speed, peak)| {
        // Near its own frequency the structure accelerates by no more than its largest displacement says.
        Impacts {
            speed: speed.value / units.velocity(1.0),
            acceleration: peak.value / units.length(1.0),
        }
    });
    let impacts = impacts.filter(|one| one.speed > 0.0);
    let Some(shifted) = impacts.and_then(|one| case.acting_like(one, time)) else { return Ok(own) };
    let there = super::judge_transient(&shifted, &again(&shifted)?);
    Ok(own.into_iter().zip(&there).map(|(one, there)| one.in_contact(there, false)).collect())
}

/// What a contact time makes of a criterion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// What is found with the clearance and restitution that act like it; none where nothing could be measured.
    pub found: Option<f64>,
    /// Whether another kind of motion decides there.
    pub crosses: bool,
}

impl Judged {
    /// The same with the difference to what is found at the pair that acts like impacts that take time; `crosses` where another kind of
    /// motion decides there.
    #[must_use]
    pub fn in_contact(self, there: &Self, crosses: bool) -> Self {
        let (Some(room), Some(shifted)) = (self.margin, there.margin) else { return self };
        if !self.criterion.measure.is_of_motions() {
            return self;
        }
        let contact = Some(Contact { found: there.found, crosses });
        let [own, there_least] = [room - self.error, shifted - there.error];
        if self.inactive.is_some() && there_least >= own {
            return self;
        }
        let least = own.min(there_least);
        let same = self.outcome() == there.outcome();
        let holds = self.holds.map(|holds| holds && there.holds == Some(true));
        let undecided = self.undecided.or(there.undecided);
        let near_limit = !same || self.near_limit || there.near_limit;
        let near_limit =
            near_limit && undecided.is_none() && self.outcome() != Outcome::NotMeasured;
        Self { error: room - least, holds, near_limit, undecided, contact, ..self }
    }
}
