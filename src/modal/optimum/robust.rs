//! Which absorbers are best on average, where numbers are uncertain.

use super::aim::Aim;
use super::judged::JudgedAbsorbers;
use crate::case::ModalCase;
use crate::criteria::Outcome;
use crate::executor::{Executor, Serial, map};
use crate::modal::along::AlongEffort;
use crate::modal::{ModalAnswer, ModalError};
use crate::operating_range::{Varies, drawn};
use crate::optimize::robust::{
    UnderDeviations, WeightedErrors, combinations, corners, nodes_simulated,
};

/// Most combinations of deviations, and so many draws where there were more.
const DRAWN: u32 = 27;

/// The best on average, where numbers are uncertain.
#[derive(Debug, Clone, PartialEq)]
pub struct RobustAbsorbers {
    /// The absorbers.
    pub design: JudgedAbsorbers,
    /// What they, and the best as written, come to under deviations.
    pub under: [UnderDeviations; 2],
    /// Combinations of deviations that were averaged.
    pub combinations: usize,
}

impl RobustAbsorbers {
    /// Of the best as written and others that meet as many criteria; none where nothing is uncertain.
    pub(super) fn of(
        nominal: &JudgedAbsorbers,
        others: &[&JudgedAbsorbers],
        aim: Aim,
        on: &dyn Executor,
    ) -> Result<Option<Self>, ModalError> {
        let (average, corners) = deviations(&nominal.case);
        if average.is_empty() {
            return Ok(None);
        }
        let under = |one: &JudgedAbsorbers| under(&one.case, aim, &average, &corners, on);
        let of_nominal = under(nominal)?;
        let mut best = (nominal, of_nominal);
        let missed = |one: &JudgedAbsorbers| {
            one.answer.judged.iter().filter(|one| one.outcome() != Outcome::Holds).count()
        };
        let others = others.iter().copied();
        for one in others.filter(|one| *one != nominal && missed(one) == missed(nominal)) {
            let there = under(one)?;
            if aim.score([there.expected, 0.0]) > aim.score([best.1.expected, 0.0]) {
                best = (one, there);
            }
        }
        let (design, of_best) = best;
        let under = [of_best, of_nominal];
        Ok(Some(Self { design: design.clone(), under, combinations: average.len() }))
    }
}

/// Deviations that are averaged with their weights, and those of which the worst counts: nodes of a quadrature and all corners, or where
/// these are many draws that cover each number evenly. Empty where nothing is uncertain.
pub(super) fn deviations(case: &ModalCase) -> (Vec<WeightedErrors>, Vec<WeightedErrors>) {
    let uncertain = case.uncertain();
    let nodes = nodes_simulated(uncertain.len());
    match uncertain.len() {
        0 => (Vec::new(), Vec::new()),
        count if libm::pow(nodes as f64, count as f64) <= f64::from(DRAWN) => {
            (combinations(&uncertain, nodes), corners(&uncertain))
        }
        _ => {
            let all = drawn(&uncertain, DRAWN).into_iter();
            let all: Vec<_> = all.map(|errors| (errors, 1.0 / f64::from(DRAWN))).collect();
            (all.clone(), all)
        }
    }
}

/// What absorbers come to under deviations, by fewer starts and frequencies than `check` takes and without their errors, which are
/// larger then; as bad as can be where one leaves no structure.
fn under(
    case: &ModalCase,
    aim: Aim,
    average: &[WeightedErrors],
    corners: &[WeightedErrors],
    on: &dyn Executor,
) -> Result<UnderDeviations, ModalError> {
    let lost = if aim.of_orbits().is_some() { 0.0 } else { f64::INFINITY };
    let all: Vec<&WeightedErrors> = average.iter().chain(corners).collect();
    let come_to = |k: usize| {
        let Some(there) = Varies::deviating(case, &all[k].0) else { return Ok(lost) };
        if let Some(value) = aim.exact(&there) {
            return Ok(value);
        }
        let answer = ModalAnswer::with(&there, &AlongEffort::SCREENING, &[], &Serial)?;
        let [value, _] = aim.value(&there, &answer, false);
        Ok(value)
    };
    let values = map(on, "deviations", all.len(), come_to);
    let values = values.into_iter().collect::<Result<Vec<f64>, ModalError>>()?;
    let (averaged, ends) = values.split_at(average.len());
    let expected = averaged.iter().zip(average).map(|(value, (_, weight))| value * weight).sum();
    let worst =
        ends.iter().copied().min_by(|a, b| aim.score([*a, 0.0]).total_cmp(&aim.score([*b, 0.0])));
    Ok(UnderDeviations { expected, worst_corner: worst.unwrap_or(lost) })
}
