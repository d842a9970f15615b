//! What a load does with other amplitudes: how far it may grow, and at which displacement each absorber works.

use super::along::{AlongLoad, AtFrequency};
use super::orbits::{Stretches, stable_amplitudes};
use super::{ModalAnswer, ModalError, driven_mode, linear_peak};
use crate::analysis::Grading;
use crate::case::{Load, ModalCase, PlacedAbsorber};
use crate::criteria::{Judged, Outcome};
use crate::executor::{Executor, map};
use crate::motions::{ModalEffort, ModalMotion};

/// Steps of the root of two to either side of the load's own amplitude, from a quarter to four times it, and one close to it.
const STEPS: i32 = 4;
const NEAR: f64 = 0.02;
/// Relative distance up to which two frequencies are one.
const APART: f64 = 1e-3;

/// What a load does with other amplitudes, at some frequencies.
#[derive(Debug, Clone, PartialEq)]
pub struct OverForce {
    /// In Hz, ascending: the natural frequency of the mode that it is about, or the middle of its range; and where criteria are worst
    /// with its own amplitude, and the displacement.
    pub at: Vec<f64>,
    /// By ascending amplitude.
    pub steps: Vec<ForceStep>,
    /// For each absorber the largest displacements of the structure in that mode, in m, between which it is in symmetric 1:1
    /// resonance by itself, at leading order; none of one at a node.
    pub working: Vec<Option<[f64; 2]>>,
    /// The frequency of the mode that it is about, in Hz, and the amplitudes at which an exact orbit with two impacts of each
    /// absorber per period attracts there; none where the structure has no steady motion.
    pub exact: Option<(f64, Stretches)>,
}

/// What it does with one amplitude.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceStep {
    /// The amplitude over the load's own.
    pub times: f64,
    /// The long-term motions at all frequencies.
    pub motions: Vec<ModalMotion>,
    /// The largest displacement of any place without absorbers, in m.
    pub bare: f64,
    /// What each criterion comes to.
    pub outcomes: Vec<Outcome>,
}

/// What all limits come to with other amplitudes, over the load's own.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceLimits {
    /// Between which of those that were looked at all hold with their errors, one after the other; none where they hold with none.
    pub holds: Vec<[f64; 2]>,
    /// Those with which it is too close to call.
    pub open: Vec<f64>,
    /// Those with which one fails.
    pub fails: Vec<f64>,
}

impl OverForce {
    /// Of what is known along a load that is worst at some frequencies: other amplitudes are searched as the case itself is, of a load over
    /// a range of frequencies with half of its starts in the usual windows. None where the structure has no steady motion.
    ///
    /// # Errors
    /// [`ModalError`] where a motion cannot be flown.
    pub fn of(
        case: &ModalCase,
        along: &AlongLoad,
        worst_at: &[f64],
        on: &dyn Executor,
    ) -> Result<Option<Self>, ModalError> {
        let load = &along.load;
        let mut at: Vec<f64> = Vec::new();
        let centre = load.centre(case);
        for one in worst_at.iter().chain([&centre]) {
            if at.iter().all(|at| (at / one - 1.0).abs() > APART) {
                at.push(*one);
            }
        }
        at.retain(|at| case.system(load, *at).is_ok());
        at.sort_by(f64::total_cmp);
        if at.is_empty() {
            return Ok(None);
        }
        let far = (-STEPS..=STEPS).map(|step| libm::exp2(0.5 * f64::from(step)));
        let mut times: Vec<f64> = far.chain([1.0 - NEAR, 1.0 + NEAR]).collect();
        times.sort_by(f64::total_cmp);
        let with = |step: usize| Load { amplitude: times[step] * load.amplitude, ..*load };
        let [from, to] = load.range_hz;
        let (usual, starts) = match from < to {
            true => (&ModalCase { periods: 0, ..case.clone() }, case.starts.div_ceil(2)),
            false => (case, case.starts_at_one),
        };
        let (periods, patience) = (usual.periods, ModalEffort::OF_MANY);
        let effort = ModalEffort { starts, periods, patience, accuracy: None };
        let look = |k: usize| {
            let (step, at) = (k / at.len(), at[k % at.len()]);
            let known = along.places.iter().find(|one| times[step] == 1.0 && one.at == at);
            known.map_or_else(
                || AtFrequency::of(usual, &with(step), at, effort, &[]),
                |one| Ok(one.clone()),
            )
        };
        let found = map(on, "motions under other amplitudes", times.len() * at.len(), look);
        let found = found.into_iter().collect::<Result<Vec<_>, _>>()?;
        let step = |(step, found): (usize, &[AtFrequency])| {
            let load = with(step);
            let here = ModalCase { loads: vec![load], ..usual.clone() };
            let bare = at.iter().map(|at| linear_peak(case, &load, *at, &[]));
            let bare = bare.fold(0.0, f64::max);
            let motions = found.iter().flat_map(|one| one.motions.iter().cloned()).collect();
            let some = |places| AlongLoad::at_some(load, places, along.bare.clone());
            // Of its own amplitude all is known.
            let own = if times[step] == 1.0 { along.clone() } else { some(found.to_vec()) };
            let judged = ModalAnswer::judged(&here, vec![own]).in_contact(&here, |shifted| {
                let places = at.iter().map(|at| AtFrequency::of(shifted, &load, *at, effort, &[]));
                let places = places.collect::<Result<_, _>>()?;
                Ok(ModalAnswer::judged(shifted, vec![some(places)]))
            })?;
            let outcomes = judged.judged.iter().map(Judged::outcome).collect();
            Ok(ForceStep { times: times[step], motions, bare, outcomes })
        };
        let steps = found.chunks(at.len()).enumerate().map(step);
        let steps = steps.collect::<Result<_, ModalError>>()?;
        let exact = stable_amplitudes(case, load, centre).ok().map(|found| (centre, found));
        Ok(Some(Self { at, steps, working: working(case, driven_mode(case, load)), exact }))
    }

    /// What limits come to; none without them.
    pub fn limits(&self, case: &ModalCase) -> Option<ForceLimits> {
        if case.criteria.is_empty() {
            return None;
        }
        let fails = |step: &ForceStep| step.outcomes.contains(&Outcome::Fails);
        let holds = |step: &ForceStep| step.outcomes.iter().all(|one| *one == Outcome::Holds);
        let times = |of: &dyn Fn(&ForceStep) -> bool| -> Vec<f64> {
            self.steps.iter().filter(|step| of(step)).map(|step| step.times).collect()
        };
        let together = self.steps.chunk_by(|a, b| holds(a) == holds(b));
        let stretches = together.filter(|steps| holds(&steps[0]));
        let stretches = stretches.map(|steps| [steps[0].times, steps[steps.len() - 1].times]);
        let open = times(&|step| !fails(step) && !holds(step));
        Some(ForceLimits { holds: stretches.collect(), open, fails: times(&fails) })
    }
}

/// Displacements of its place, in m, between which an absorber is in symmetric 1:1 resonance by itself, at leading order.
pub fn working_range(absorber: &PlacedAbsorber) -> [f64; 2] {
    let Grading { lower, upper, .. } = Grading::of(absorber.restitution);
    [lower, upper].map(|end| end * absorber.clearance_m)
}

/// The same for each absorber in a mode, by the largest displacement of the structure; none of one at a node.
fn working(case: &ModalCase, mode: usize) -> Vec<Option<[f64; 2]>> {
    let shape = &case.modes[mode].shape;
    let most = shape.iter().map(|value| value.abs()).fold(0.0, f64::max);
    let of = case.absorbers.iter().map(|absorber| {
        let here = shape[absorber.place].abs();
        (here > 0.0).then(|| working_range(absorber).map(|end| end * most / here))
    });
    of.collect()
}
