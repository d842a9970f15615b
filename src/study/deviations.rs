//! What would spoil a design first: its largest motion in rigs that differ from the case by what rigs differ by.

use std::f64::consts::PI;

use serde::Serialize;

use crate::band::Band;
use crate::case::{Case, Design};
use crate::executor::Executor;
use crate::motions::{Effort, Motion, Motions, Place, motions};
use crate::simulation::StartError;
use crate::study::CaseStudy;
use crate::system::{Parameter, System};

/// A tilt of the cavity in rad: 0.2 degrees, what is left after levelling with a workshop spirit level.
pub const TILT: f64 = 0.2 * PI / 180.0;
/// A coefficient of friction: what is left of a slider on good bearings, or of a ball that is guided.
pub const FRICTION: f64 = 0.005;
/// By how much the restitutions of two walls of one make differ.
pub const APART: f64 = 0.02;
/// By how much a restitution differs from its measurement at another impact speed.
pub const RESTITUTION: f64 = 0.02;
/// By how much a natural frequency differs, relative: 2 % of the stiffness.
pub const FREQUENCY: f64 = 0.01;

/// Evenly spread starts of each rig, the first of the report's: a motion that half of all starts lead to is missed one
/// time in sixteen. Those that the case itself has are followed besides; more starts would double the time of a report.
pub const STARTS: u32 = 4;
/// The largest motions of the case that are followed into each rig.
const FOLLOWED: usize = 3;
/// How a rig differs from its case.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Deviation {
    /// The cavity is inclined by [`TILT`] more.
    Tilt,
    /// Friction is larger by [`FRICTION`].
    Friction,
    /// The restitutions of the walls are further apart by [`APART`], their mean is the same.
    UnequalEnds,
    /// Both restitutions are lower by [`RESTITUTION`].
    RestitutionLower,
    /// Both are higher.
    RestitutionHigher,
    /// The natural frequency is lower by [`FREQUENCY`], by the stiffness.
    FrequencyLower,
    /// It is higher.
    FrequencyHigher,
}

impl Deviation {
    /// Every deviation.
    pub const ALL: [Self; 7] = [
        Self::Tilt,
        Self::Friction,
        Self::UnequalEnds,
        Self::RestitutionLower,
        Self::RestitutionHigher,
        Self::FrequencyLower,
        Self::FrequencyHigher,
    ];

    /// The system of the rig. None where a design has no such number, as a reduced one, whose gravity is not known,
    /// or where no system has such a one, as a restitution above 1.
    pub fn system(self, design: &Design) -> Option<System> {
        let more = |parameter, more: f64| {
            let own = design.value(parameter)?;
            design.with(parameter, own + more).possible_system()
        };
        let detuned =
            |factor| Some(Band::point(&design.system().ok()?).with_structure_detuned(factor)?.base);
        match self {
            Self::Tilt => {
                let own = design.value(Parameter::Inclination)?;
                more(Parameter::Inclination, TILT.copysign(own))
            }
            Self::Friction => more(Parameter::Friction, FRICTION),
            Self::UnequalEnds => design.with_restitutions_apart(APART).possible_system(),
            Self::RestitutionLower => more(Parameter::Restitution, -RESTITUTION),
            Self::RestitutionHigher => more(Parameter::Restitution, RESTITUTION),
            Self::FrequencyLower => detuned(1.0 - FREQUENCY),
            Self::FrequencyHigher => detuned(1.0 + FREQUENCY),
        }
    }
}

/// A rig and its largest motion. Lengths over the clearance, which no deviation changes.
#[derive(Debug, Clone)]
pub struct Rig {
    /// How it differs.
    pub deviation: Deviation,
    /// Its motion with the largest peak.
    pub motion: Motion,
    /// Change of the peak, relative to the case's; none where that is within the scatter of either.
    pub change: Option<f64>,
}

/// The case's own largest motion, and the rigs, those first whose peak is worst.
#[derive(Debug, Clone)]
pub struct Deviations {
    /// The largest motion of the case.
    pub own: Motion,
    /// The rigs; those within the scatter between those that are worse and those that are better.
    pub rigs: Vec<Rig>,
}

impl Deviations {
    /// What becomes of the motions that a study has found; none where nothing moves, was simulated or keeps its size.
    ///
    /// # Errors
    /// [`StartError`] where a motion of the case is none that a rig can start from.
    pub fn of(
        case: &Case,
        study: &CaseStudy,
        on: &dyn Executor,
    ) -> Result<Option<Self>, StartError> {
        let free = study.measured.iter().any(|one| one.keeps_its_start());
        let own = largest(&study.motions).filter(|own| own.facts().peak.value > 0.0 && !free);
        let Some(own) = own else { return Ok(None) };
        let mut found: Vec<&Motion> = study.motions.iter().collect();
        found.sort_by(|a, b| peak(b).total_cmp(&peak(a)));
        let of = |deviation: Deviation| Some((deviation, deviation.system(&case.design)?));
        let rigs: Vec<(Deviation, System)> = Deviation::ALL.into_iter().filter_map(of).collect();
        let effort = Effort { starts: STARTS.min(study.effort.starts), ..case.effort() };
        let further: Vec<_> = found.iter().take(FOLLOWED).map(|motion| motion.state()).collect();
        let place = |(_, system): &(Deviation, System)| Place {
            further: further.clone(),
            ..Place::new(system, effort.starts)
        };
        let places: Vec<Place> = rigs.iter().map(place).collect();
        let each = motions(&places, &effort, on)?;
        let rigs = rigs.into_iter().zip(each).filter_map(|((deviation, _), found)| {
            let motion = largest(&found)?.clone();
            Some(Rig { deviation, change: change(own, &motion), motion })
        });
        let mut rigs: Vec<Rig> = rigs.collect();
        rigs.sort_by(|a, b| b.change.unwrap_or(0.0).total_cmp(&a.change.unwrap_or(0.0)));
        Ok(Some(Self { own: own.clone(), rigs }))
    }
}

fn peak(motion: &Motion) -> f64 {
    motion.facts().peak.value
}

/// The motion with the largest peak, that of an absorber at rest only where there is no other.
fn largest(found: &Motions) -> Option<&Motion> {
    let order = |motion: &Motion| (motion.rest().is_none(), peak(motion));
    found.iter().max_by(|a, b| {
        let (a, b) = (order(a), order(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    })
}

/// The relative change of a peak; none where a run ten times as long may find either motion as large as the other.
fn change(own: &Motion, other: &Motion) -> Option<f64> {
    let [own, other] = [own, other].map(|motion| motion.facts().peak);
    let beyond = |one: f64, of: crate::motions::Value| one > of.value + of.error;
    let apart = beyond(own.value, other) || beyond(other.value, own);
    apart.then_some(other.value / own.value - 1.0)
}
