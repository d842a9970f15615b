//! What becomes of a case that is not driven steadily: a structure that is released or struck, and comes to rest
//! ([`DecayStudy`]); one that is swept through its resonance ([`SweepStudy`]); one that a record or noise drives
//! ([`RecordStudy`]).
//!
//! Lengths over the clearance, fast time `tau = omega0 t`, as everywhere. The *amplitude* of the structure at a
//! time is `sqrt(x^2 + x'^2)`, the root of its own energy: that of the vibration that it would go on with alone.
//! What it does depends on where in its cavity the absorber is at the beginning, which nobody knows: it is
//! simulated from places all over the cavity ([`crate::flights`]), and the worst counts. Beside it stand the structure
//! alone and a tuned mass damper of the same mass ([`crate::linear`]), and theory ([`crate::flights::Predicted`]).

mod ask;
mod clearance;
mod flight;
mod passage;
mod record_study;
mod runs;
mod study;

pub use ask::AskedValue;
pub use clearance::{ClearanceOptimum, RELEASES, best_clearance, looked_at};
pub use flight::OneFlight;
pub use passage::{ByRate, Jump, SweepStart, SweepStudy};
pub use record_study::{Realisation, RecordStudy, SpectrumPoint};
pub use runs::{Run, Runs, Sample, WithError};
pub use study::{Decay, DecayStudy, DecayTime};
pub(crate) use study::{followed, longest};

use crate::case::Case;
use crate::excitation::{Record, Transient};
use crate::executor::Executor;
use crate::flights::{DrivenError, Places, Predicted};
use crate::quantity::Units;
use crate::simulation::StartError;
use crate::system::System;

/// What became of a structure that is not driven steadily.
#[derive(Debug, Clone)]
pub enum Study {
    /// One that was released or struck.
    Release(Box<DecayStudy>),
    /// One that was swept through resonance.
    Sweep(Box<SweepStudy>),
    /// One that a record drove.
    Record(Box<RecordStudy>),
}

/// What a design is studied by beside its system and its units.
#[derive(Clone, Copy)]
pub struct Brief<'a> {
    /// What its structure is subjected to.
    pub transient: Transient,
    /// The records that drive it, if any do.
    pub records: &'a [Record],
    /// Share of its first amplitude at which a released structure has come to rest.
    pub decay_level: f64,
    /// Whether an absorber that no wall reaches counts.
    pub count_inactive: bool,
    /// Whether theory is asked for as well, which may take longer than all starts.
    pub theory: bool,
}

impl Study {
    /// What becomes of a design from places of its absorber, beside its alternatives and nothing else.
    ///
    /// # Errors
    /// As [`Self::of_case`].
    pub fn brief(
        system: &System,
        units: &Units,
        of: &Brief<'_>,
        places: Places<'_>,
    ) -> Result<Self, DrivenError> {
        let inactive = of.count_inactive;
        Ok(match &of.transient {
            Transient::Release(release) => {
                let share = of.decay_level;
                let study = DecayStudy::without_theory(system, units, release, share, places)?;
                let predicted = match of.theory {
                    true => Predicted::of(system, study.from, study.level),
                    false => Predicted::none(system),
                };
                Self::Release(Box::new(study.counting(inactive, predicted)))
            }
            Transient::Sweep(sweep) => {
                let study = SweepStudy::brief(system, units, sweep, places, inactive)?;
                Self::Sweep(Box::new(study))
            }
            Transient::Record(_) => {
                let study = RecordStudy::brief(system, units, of.records, places, inactive)?;
                Self::Record(Box::new(study))
            }
        })
    }

    /// The same of a case, without theory; places closer to the worst are those of one condition alone. None for a case that
    /// is driven steadily.
    ///
    /// # Errors
    /// As [`Self::of_case`].
    pub fn brief_of_case(case: &Case, places: Places<'_>) -> Option<Result<Self, DrivenError>> {
        let records = case.records();
        let of = Brief {
            transient: case.design.transient()?,
            records,
            decay_level: case.decay_level,
            count_inactive: case.count_inactive,
            theory: false,
        };
        let places = Places { closer: places.closer && records.len() < 2, ..places };
        Some(Self::brief(&case.system(), &case.units(), &of, places))
    }

    /// What theory alone says of a case that is released; none for another.
    pub fn by_theory(case: &Case) -> Option<Self> {
        DecayStudy::by_theory(case).map(|study| Self::Release(Box::new(study)))
    }

    /// Studies a case that is not driven steadily; none for another.
    ///
    /// # Errors
    /// [`DrivenError`] where the motion is so large that rounding hides the walls, or samples are missing.
    pub fn of_case(case: &Case, executor: &dyn Executor) -> Option<Result<Self, DrivenError>> {
        let boxed = |done: Result<Self, StartError>| done.map_err(DrivenError::from);
        match case.design.transient()? {
            Transient::Release(_) => DecayStudy::of_case(case, executor)
                .map(|done| boxed(done.map(|study| Self::Release(Box::new(study))))),
            Transient::Sweep(_) => SweepStudy::of_case(case, executor)
                .map(|done| boxed(done.map(|study| Self::Sweep(Box::new(study))))),
            Transient::Record(_) => RecordStudy::of_case(case, executor)
                .map(|done| done.map(|study| Self::Record(Box::new(study)))),
        }
    }
}
