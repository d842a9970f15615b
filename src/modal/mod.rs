//! A structure of several modes with several absorbers under its loads: every long-term motion along each, the structure alone
//! and tuned mass dampers beside it, and its criteria.
//!
//! For the program itself: this module may change at any time.

mod along;
mod alternatives;
mod beside;
mod claims;
mod dampers;
mod forces;
mod judge;
mod linear;
mod optimum;
mod orbits;
mod over_time;
mod ranges;
mod rest;
mod sensors;
mod theory;

use crate::alternatives::Alternatives;
use crate::case::{ActsOn, Load, ModalCase, RewriteError};
use crate::contact::of_absorbers;
use crate::criteria::{Judged, all_hold};
use crate::executor::{Executor, map};
use crate::method::Method;
use crate::motions::ModalMotion;
use crate::operating_range::{
    Combined, HoldsFor, Reliability, Together, Varied, combined, holds_for,
};
use crate::simulation::ModalStartError;
use crate::system::{InvalidModalSystem, ModalSystem};
use along::AlongEffort;
use ranges::Known;

pub use along::{AlongLoad, AtFrequency, seconds, seconds_of_flight};
pub use alternatives::{choices, resting, seconds_of_designs};
pub use beside::Beside;
pub use claims::{LoadClaim, claims};
pub use dampers::{DamperChoice, PlacedDampers};
pub use forces::{ForceLimits, ForceStep, OverForce, working_range};
pub use linear::{linear_at, linear_most, linear_peak, linear_places};
pub use optimum::{Aim, JudgedAbsorbers, ModalOptimum, RobustAbsorbers, checks, clearance_bounds};
pub use orbits::{LoadOrbits, Stretches, at_resonances, orbits};
pub use over_time::{LoadImpact, OverTime, usual_periods};
pub use ranges::looks;
pub use sensors::{largest_of, sensors};
pub use theory::{AbsorberManifold, ExactAmplitude, GroupTheory, LoadTheory};

/// Why there is no answer.
#[derive(Debug, thiserror::Error)]
pub enum ModalError {
    /// A frequency of a load at which there is no structure.
    #[error(transparent)]
    System(#[from] InvalidModalSystem),
    /// Other absorbers cannot be written into the case.
    #[error(transparent)]
    Rewrite(#[from] RewriteError),
    /// A motion cannot be flown.
    #[error(transparent)]
    Start(#[from] ModalStartError),
    /// A motion that was found has more impacts than can be followed over the time that is asked for.
    #[error(
        "the motion under load {load} has too many impacts to be followed over {periods} excitation periods; ask for fewer"
    )]
    Lost {
        /// Under which load, from 1.
        load: usize,
        /// Excitation periods.
        periods: u64,
    },
}

/// What is known of a structure under its loads.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalAnswer {
    /// Along each load, in the order of the case.
    pub along: Vec<AlongLoad>,
    /// Its criteria.
    pub judged: Vec<Judged>,
    /// What else could be done; none where nobody asked, or nothing was found to compare with.
    pub alternatives: Option<Alternatives<PlacedDampers>>,
    /// How far its numbers may change before a criterion fails; empty where one does, or nobody asked.
    pub holds_for: Vec<HoldsFor>,
    /// The same where the amplitude of a load and the natural frequencies change at once.
    pub combined: Vec<Combined>,
    /// With which probability its criteria hold; none where nothing is uncertain, or nobody asked.
    pub reliability: Option<Reliability>,
}

impl ModalAnswer {
    /// Of a case, searched with its starts; where impacts take time its criteria have what that makes of them.
    ///
    /// # Errors
    /// [`ModalError`] where a motion cannot be flown.
    pub fn of(case: &ModalCase, on: &dyn Executor) -> Result<Self, ModalError> {
        Self::with(case, &AlongEffort::of(case), &[], on)
    }

    /// The same with another effort, where these loads are known of the same structure with the same absorbers.
    fn with(
        case: &ModalCase,
        effort: &AlongEffort,
        known: &[AlongLoad],
        on: &dyn Executor,
    ) -> Result<Self, ModalError> {
        let own = Self::in_no_time(case, effort, known, on)?;
        own.in_contact(case, |shifted| Self::in_no_time(shifted, effort, &[], on))
    }

    /// Sees what absorbers do in each of its motions, which documents with all motions tell and nothing else asks for.
    pub fn observe(&self, on: &dyn Executor) {
        let places = self.along.iter().flat_map(|along| &along.places);
        let all: Vec<&ModalMotion> = places.flat_map(|place| &place.motions).collect();
        map(on, "what absorbers do", all.len(), |k| all[k].observe());
    }

    /// The same with what else could be done.
    ///
    /// # Errors
    /// As [`ModalAnswer::of`].
    pub fn compared(self, case: &ModalCase, on: &dyn Executor) -> Result<Self, ModalError> {
        Ok(Self { alternatives: alternatives::alternatives(case, &self, on)?, ..self })
    }

    /// The same with how far these numbers may change, to where no criterion comes to less than `least`, and if `draws` with which
    /// probability all hold where numbers are uncertain.
    ///
    /// # Errors
    /// As [`ModalAnswer::of`].
    pub fn decided(
        self,
        case: &ModalCase,
        numbers: &[Varied],
        least: Together,
        draws: bool,
        on: &dyn Executor,
    ) -> Result<Self, ModalError> {
        let known = Known { case: case.clone(), along: self.along };
        let holds_for = holds_for(case, &self.judged, numbers, least, &known, on)?;
        let reliability = if draws { Reliability::of(case, &known, on)? } else { None };
        Ok(Self { along: known.along, holds_for, reliability, ..self })
    }

    /// The same with what holds where the amplitude of a load and the natural frequencies change at once, each within its range.
    ///
    /// # Errors
    /// As [`ModalAnswer::of`].
    pub fn combined(self, case: &ModalCase, on: &dyn Executor) -> Result<Self, ModalError> {
        let known = Known { case: case.clone(), along: self.along };
        let combined = combined(case, &self.holds_for, &known, on)?;
        Ok(Self { along: known.along, combined, ..self })
    }

    /// The same with what it makes of the criteria that impacts take time: `again` looks at another case in the same way.
    fn in_contact(
        self,
        case: &ModalCase,
        again: impl Fn(&ModalCase) -> Result<Self, ModalError>,
    ) -> Result<Self, ModalError> {
        let Some(system) = self.fastest(case) else { return Ok(self) };
        let Some(shifted) = case.acting_like(&of_absorbers(&system)) else { return Ok(self) };
        let there = again(&shifted)?;
        let in_contact = |(one, shifted): (Judged, &Judged)| {
            match [&one, shifted].map(|one| one.decided_by == Method::ClosedForm) {
                // Absorbers at rest meet their walls where they are.
                [true, true] => one,
                [own, there] => one.in_contact(shifted, own != there),
            }
        };
        let judged = self.judged.into_iter().zip(&there.judged).map(in_contact);
        Ok(Self { judged: judged.collect(), ..self })
    }

    /// The structure where criteria are worst, of these places that with the fastest impact; none where absorbers rest.
    fn fastest(&self, case: &ModalCase) -> Option<ModalSystem> {
        let speed = |one: &Judged| {
            let (along, at) = (self.along.get(one.load)?, one.at?);
            let motion = along.at(at)?.motions.get(one.motion?)?;
            let speed = motion.impact_speed.iter().map(|one| one[0]).fold(0.0, f64::max);
            (speed > 0.0).then_some((&along.load, at, speed))
        };
        let (load, at, _) =
            self.judged.iter().filter_map(speed).max_by(|a, b| a.2.total_cmp(&b.2))?;
        case.system(load, at).ok()
    }

    /// The same where impacts take no time.
    fn in_no_time(
        case: &ModalCase,
        effort: &AlongEffort,
        known: &[AlongLoad],
        on: &dyn Executor,
    ) -> Result<Self, ModalError> {
        let along = case.loads.iter().map(|load| {
            let known = known.iter().find(|one| one.load == *load).cloned();
            known.map_or_else(|| AlongLoad::of(case, load, effort, on), Ok)
        });
        Ok(Self::judged(case, along.collect::<Result<_, _>>()?))
    }

    /// The same as [`with`](Self::with), or where not all criteria hold what is known of the first frequency that shows it.
    fn whether_all_hold(
        case: &ModalCase,
        effort: &AlongEffort,
        known: &[AlongLoad],
        on: &dyn Executor,
    ) -> Result<Self, ModalError> {
        let mut along = judge::unflown(case);
        for (k, load) in case.loads.iter().enumerate() {
            if let Some(known) = known.iter().find(|one| one.load == *load) {
                along[k] = known.clone();
                continue;
            }
            let misses = |here: &AtFrequency| judge::misses(case, k, here);
            let (found, missed) = AlongLoad::until(case, load, effort, Some(&misses), on)?;
            if missed {
                let mut only = judge::unflown(case);
                only[k] = found;
                return Ok(Self::judged(case, only));
            }
            along[k] = found;
        }
        let own = Self::judged(case, along);
        own.in_contact(case, |shifted| Self::in_no_time(shifted, effort, &[], on))
    }

    /// Of what is known along loads, and nothing else.
    const fn of_loads(along: Vec<AlongLoad>) -> Self {
        Self {
            along,
            judged: Vec::new(),
            alternatives: None,
            holds_for: Vec::new(),
            combined: Vec::new(),
            reliability: None,
        }
    }

    /// Of what is known along the loads of a case.
    fn judged(case: &ModalCase, along: Vec<AlongLoad>) -> Self {
        let mut answer = Self::of_loads(along);
        answer.judged = case.criteria.iter().map(|one| answer.judge(case, one)).collect();
        answer
    }

    /// The largest displacement of any place under any load without absorbers, in m.
    pub fn bare(&self) -> f64 {
        let all = self.along.iter().flat_map(|along| &along.bare);
        all.map(|[most, _]| *most).fold(0.0, f64::max)
    }

    /// Whether every criterion holds.
    pub fn all_hold(&self) -> bool {
        all_hold(&self.judged)
    }
}

/// The mode in which a load acts, or that which is nearest to its range.
fn driven_mode(case: &ModalCase, load: &Load) -> usize {
    let off = |k: &usize| {
        let own = case.modes[*k].frequency_hz;
        let [from, to] = load.range_hz;
        libm::log(own.clamp(from, to) / own).abs()
    };
    let nearest = (0..case.modes.len()).min_by(|a, b| off(a).total_cmp(&off(b)));
    match load.on {
        ActsOn::Mode(mode) => mode,
        _ => nearest.unwrap_or_default(),
    }
}

/// For each load the worst displacement that a model of the driven mode alone has, with its error: of the mode in which the load
/// acts, or of that which is nearest to its range.
///
/// # Errors
/// [`ModalError`] where a motion cannot be flown.
pub fn modes_alone(
    case: &ModalCase,
    on: &dyn Executor,
) -> Result<Vec<Option<[f64; 2]>>, ModalError> {
    if case.modes.len() == 1 {
        return Ok(vec![None; case.loads.len()]);
    }
    let each = case.loads.iter().map(|load| {
        let driven = driven_mode(case, load);
        let on_mode = match load.on {
            ActsOn::Mode(_) => ActsOn::Mode(0),
            other => other,
        };
        let load = Load { on: on_mode, ..*load };
        let alone = ModalCase {
            modes: vec![case.modes[driven].clone()],
            loads: vec![load],
            ..case.clone()
        };
        let along = vec![AlongLoad::of(&alone, &load, &AlongEffort::of(&alone), on)?];
        let worst = ModalAnswer::of_loads(along).worst(&alone, None);
        Ok(worst.map(|worst| [worst.found.value, worst.found.error]))
    });
    each.collect()
}
