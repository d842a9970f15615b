//! What a search for ranges, and a probability, must know of a case.

use super::reliability::Uncertain;
use super::{Together, Varied};
use crate::case::{Criterion, Uncertainty};
use crate::criteria::Judged;
use crate::system::Parameter;

/// How deeply a case is looked into.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Depth {
    /// With fewer starts and places, and short windows.
    OnTheWay,
    /// As `check` does as far as whether all criteria hold: one place at which they do not, searched in full, ends it.
    WhetherAllHold,
    /// As `check` does.
    AsCheck,
}

impl Depth {
    /// That for a case: one that does not take long is always looked into as `check` does.
    pub(super) fn of(self, case: &impl Varies) -> Self {
        if case.is_short() { Self::AsCheck } else { self }
    }

    /// What tells as `check` does whether a case comes to no less than this.
    pub(super) fn telling(least: Together) -> Self {
        if least == Together::Hold { Self::WhetherAllHold } else { Self::AsCheck }
    }
}

/// A case as a search for ranges sees it: numbers, the same case with others, and what its criteria come to there. A number is of the
/// case, or of one of its parts, by index: a clearance and a restitution of an absorber, an amplitude of a load.
pub trait Varies: Sync + Sized {
    /// How thoroughly `check` searches it.
    type Effort: Sync;
    /// Why a motion cannot be followed.
    type Error: Send + Sync;

    /// What a number is whose range is looked for; none of what it has not.
    fn parameter(&self, number: Varied) -> Option<Parameter>;
    /// The parts that have a number, none as the only one where it is of the whole case.
    fn parts(&self, number: Parameter) -> Vec<Option<usize>>;
    /// The case's own value, in SI or the units of a reduced case.
    fn number(&self, number: Parameter, of: Option<usize>) -> Option<f64>;
    /// The same case with another value; none where that is no case.
    fn with(&self, number: Parameter, of: Option<usize>, value: f64) -> Option<Self>;
    /// The tolerance that the case states, and how many times that the number is likely to be off by at the most.
    fn tolerance(&self, number: Varied) -> Option<(f64, f64)>;
    /// Whether what is level and has ends alike does the mirrored thing at the mirrored value.
    fn mirrors(&self, number: Varied) -> bool;
    /// Whether a look as `check` has it is short.
    fn is_short(&self) -> bool;
    /// Whether it is driven steadily at single excitations.
    fn is_point(&self) -> bool;

    /// What is asked of it.
    fn criteria(&self) -> &[Criterion];
    /// What comes of that.
    ///
    /// # Errors
    /// Where a motion cannot be followed.
    fn judge(&self, effort: &Self::Effort, how: Depth) -> Result<Vec<Judged>, Self::Error>;
    /// Whether a criterion fails that needs no simulation: whatever motions there are, all together fail then.
    ///
    /// # Errors
    /// Where a motion cannot be followed.
    fn fails_unflown(&self) -> Result<bool, Self::Error>;
    /// Whether the structure alone keeps the limits of its motion too.
    fn kept_without_absorber(&self) -> bool;

    /// Its table `[uncertainty]`.
    fn uncertainty(&self) -> &Uncertainty;
    /// The same with errors added to some numbers; none where that is no case.
    fn deviating(&self, errors: &[(Uncertain, f64)]) -> Option<Self>;
    /// What is uncertain, of each part by itself.
    fn uncertain(&self) -> Vec<Uncertain> {
        let each = self.uncertainty().parameters().flat_map(|(parameter, errors)| {
            let parts = self.parts(parameter).into_iter();
            parts.map(move |of| Uncertain { parameter, of, errors })
        });
        each.collect()
    }
}
