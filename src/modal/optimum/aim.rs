//! What absorbers are looked for by.

use crate::case::{Criterion, ModalCase, Objective};
use crate::criteria::Judged;
use crate::dampers::missed;
use crate::measure::Measure;
use crate::modal::ModalAnswer;
use crate::modal::judge::unflown;

/// What absorbers are looked for by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Aim {
    /// That all criteria hold with the most room: the largest share that any motion has of what one allows.
    Room,
    /// The smallest displacement, or the largest share or margin of exact orbits.
    Of(Objective),
}

impl Aim {
    /// That of a case, unless another objective is asked for.
    pub fn of(case: &ModalCase, objective: Option<Objective>) -> Self {
        match objective.or(case.bounds.objective) {
            Some(objective) => Self::Of(objective),
            None if case.criteria.is_empty() => Self::Of(Objective::WorstAmplitude),
            None => match Objective::asked(&case.criteria) {
                Objective::WorstAmplitude => Self::Room,
                exact => Self::Of(exact),
            },
        }
    }

    /// What exact orbits are asked for, if they decide.
    pub(super) fn of_orbits(self) -> Option<Measure> {
        match self {
            Self::Of(Objective::StableShare) => Some(Measure::StableShare),
            Self::Of(Objective::Margin) => Some(Measure::MarginClearance),
            _ => None,
        }
    }

    /// What exact orbits of a case come to; none where motions decide.
    pub(super) fn exact(self, case: &ModalCase) -> Option<f64> {
        let asked = Criterion::at_most(self.of_orbits()?, 0.0)?;
        ModalAnswer::of_loads(unflown(case)).judge(case, &asked).found
    }

    /// What absorbers come to, with its error; what they use of criteria with their errors, or as they are found.
    pub(super) fn value(self, case: &ModalCase, answer: &ModalAnswer, errors: bool) -> [f64; 2] {
        let lost = [f64::INFINITY, 0.0];
        match self {
            Self::Room => [missed(&reaches(case, answer, errors)), 0.0],
            Self::Of(_) => match self.exact(case) {
                Some(value) => [value, 0.0],
                None => {
                    answer.worst(case, None).map_or(lost, |one| [one.found.value, one.found.error])
                }
            },
        }
    }

    /// The more the better: of a value with its error.
    pub(super) fn score(self, [value, error]: [f64; 2]) -> f64 {
        if self.of_orbits().is_some() { value } else { -(value + error) }
    }
}

/// The most that any motion may have of what each criterion is about, over what that allows; without criteria the largest displacement
/// over that of the structure alone.
pub(super) fn reaches(case: &ModalCase, answer: &ModalAnswer, errors: bool) -> Vec<f64> {
    let of = |error: f64| if errors { error } else { 0.0 };
    let reach = |one: &Judged| {
        let room = one.margin.map(|room| room - of(one.error));
        room.map_or(f64::INFINITY, |room| 1.0 - room / one.criterion.scale())
    };
    match case.criteria.is_empty() {
        true => {
            let worst = answer.worst(case, None).map(|worst| worst.found);
            vec![worst.map_or(f64::INFINITY, |one| (one.value + of(one.error)) / answer.bare())]
        }
        false => answer.judged.iter().map(reach).collect(),
    }
}
