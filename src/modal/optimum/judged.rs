//! Absorbers as `check` judges them.

use std::cmp::Ordering;

use super::aim::{Aim, reaches};
use crate::case::ModalCase;
use crate::criteria::Outcome;
use crate::executor::Executor;
use crate::modal::{ModalAnswer, ModalError};

/// Absorbers and what they do.
#[derive(Debug, Clone, PartialEq)]
pub struct JudgedAbsorbers {
    /// The case with them.
    pub case: ModalCase,
    /// Its file.
    pub text: String,
    /// What they do, as `check` finds it.
    pub answer: ModalAnswer,
    /// The most that any motion may have of what each criterion is about, over what that allows; without criteria the largest
    /// displacement over that of the structure alone.
    pub reaches: Vec<f64>,
    /// What they are looked for by, with its error: a share of what criteria allow, a displacement in m that may be larger by the error,
    /// a share of ranges, or a relative distance.
    pub value: [f64; 2],
}

impl JudgedAbsorbers {
    pub(super) fn of(
        case: ModalCase,
        text: String,
        aim: Aim,
        on: &dyn Executor,
    ) -> Result<Self, ModalError> {
        let answer = ModalAnswer::of(&case, on)?;
        let (reaches, value) = (reaches(&case, &answer, true), aim.value(&case, &answer, true));
        Ok(Self { case, text, answer, reaches, value })
    }

    /// Whether every criterion holds; true without criteria.
    pub fn is_feasible(&self) -> bool {
        self.case.criteria.is_empty() || self.answer.all_hold()
    }

    /// First how many criteria are missed, then how many are not known to hold, then by what is looked for.
    pub(super) fn order(&self, other: &Self, aim: Aim) -> Ordering {
        let count = |one: &Self, which: fn(Outcome) -> bool| {
            one.answer.judged.iter().filter(|one| which(one.outcome())).count()
        };
        let fails: fn(Outcome) -> bool = |one| matches!(one, Outcome::Fails | Outcome::NotMeasured);
        let open: fn(Outcome) -> bool = |one| one != Outcome::Holds;
        let by = |which| count(self, which).cmp(&count(other, which));
        let of_aim = || aim.score(other.value).total_cmp(&aim.score(self.value));
        by(fails).then(by(open)).then_with(of_aim)
    }
}
