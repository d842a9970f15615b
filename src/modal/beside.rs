//! What a report has beside the motions along the loads.

use super::alternatives::choices;
use super::claims::{LoadClaim, claims};
use super::dampers::DamperChoice;
use super::forces::OverForce;
use super::orbits::at_resonances;
use super::over_time::OverTime;
use super::theory::LoadTheory;
use super::{ModalAnswer, ModalError, modes_alone};
use crate::alternatives::Which;
use crate::case::ModalCase;
use crate::executor::Executor;

/// What else is known of its loads.
#[derive(Debug, Clone, Default)]
pub struct Beside {
    /// Tuned mass dampers.
    pub dampers: Vec<DamperChoice>,
    /// For each load what a model of the driven mode alone would say; none where there is none.
    pub alone: Vec<Option<[f64; 2]>>,
    /// For each load what it does with other amplitudes; none where there is no steady motion.
    pub forces: Vec<Option<OverForce>>,
    /// What theory says of the modes that the loads drive.
    pub theory: Vec<LoadTheory>,
    /// What theory and exact orbits claim.
    pub claims: Vec<LoadClaim>,
    /// The motion in which the structure moves farthest under each load under which an absorber impacts, over time.
    pub over_time: Vec<OverTime>,
}

impl Beside {
    /// All that a report has; what absorbers do is seen then.
    ///
    /// # Errors
    /// [`ModalError`] where a motion cannot be flown.
    pub fn of(
        case: &ModalCase,
        answer: &ModalAnswer,
        on: &dyn Executor,
    ) -> Result<Self, ModalError> {
        answer.observe(on);
        let worst = |k: usize| {
            let farthest = answer.worst(case, Some(k)).and_then(|worst| worst.found.at);
            let judged = answer.judged.iter().filter(|one| one.load == k);
            farthest.into_iter().chain(judged.filter_map(|one| one.at)).collect::<Vec<f64>>()
        };
        let each = answer.along.iter().enumerate();
        let forces = each.map(|(k, along)| OverForce::of(case, along, &worst(k), on));
        let forces = forces.collect::<Result<_, _>>()?;
        let compared = answer.alternatives.as_ref();
        let usual =
            compared.map(|all| all.all(Which::Damper, 0.0).filter_map(|row| row.damper.clone()));
        let mut dampers: Vec<DamperChoice> = match usual {
            Some(usual) => usual.map(|one| DamperChoice::of(case, one)).collect(),
            None => choices(case),
        };
        dampers.sort_by_key(|one| one.dampers.each.len());
        let orbits = at_resonances(case)?;
        let claims = claims(case, &orbits, on)?;
        let theory = orbits.into_iter().filter_map(|one| one.theory).collect();
        let over_time = OverTime::all(case, answer);
        let alone = modes_alone(case, on)?;
        Ok(Self { dampers, alone, forces, theory, claims, over_time })
    }
}
