//! Cases of several modes or absorbers as a search for ranges sees them: the structure's numbers are those of all modes together, a
//! clearance and a restitution are of one absorber, an amplitude is of one load.

use super::along::AlongEffort;
use super::linear::linear_most;
use super::{AlongLoad, ModalAnswer, ModalError, judge};
use crate::case::{Criterion, ModalCase, Uncertainty};
use crate::criteria::{Judged, kept_alone};
use crate::executor::Serial;
use crate::operating_range::{Depth, Together, Uncertain, Varied, Varies};
use crate::system::Parameter;

/// About how many times a `check` of the case the ranges of one number take: of loads of one frequency every look is one, of others
/// those at the ends are.
const OF_POINTS: f64 = 50.0;
const OF_RANGES: f64 = 15.0;

/// What is known of the case itself.
pub struct Known {
    pub(super) case: ModalCase,
    pub(super) along: Vec<AlongLoad>,
}

/// About how many times a `check` of a case the ranges of some numbers take.
pub fn looks(case: &ModalCase, numbers: &[Varied]) -> f64 {
    let parameters = numbers.iter().filter_map(|one| case.parameter(*one));
    let parts: usize = parameters.map(|one| case.parts_of(one).len()).sum();
    parts as f64 * if case.is_short() { OF_POINTS } else { OF_RANGES }
}

impl Varies for ModalCase {
    type Effort = Known;
    type Error = ModalError;

    fn parameter(&self, number: Varied) -> Option<Parameter> {
        Some(match number {
            Varied::Amplitude => Parameter::Amplitude,
            Varied::NaturalFrequency => Parameter::NaturalFrequency,
            Varied::Damping => Parameter::DampingRatio,
            Varied::Mass => Parameter::Mass,
            Varied::Restitution => Parameter::Restitution,
            Varied::Clearance => Parameter::Clearance,
            Varied::Inclination | Varied::Friction => return None,
        })
    }

    fn parts(&self, number: Parameter) -> Vec<Option<usize>> {
        self.parts_of(number)
    }

    fn number(&self, number: Parameter, of: Option<usize>) -> Option<f64> {
        Self::number(self, number, of)
    }

    fn with(&self, number: Parameter, of: Option<usize>, value: f64) -> Option<Self> {
        self.varied(number, of, value)
    }

    fn tolerance(&self, number: Varied) -> Option<(f64, f64)> {
        let parameter = self.parameter(number)?;
        let stated = self.uncertainty.parameters().find(|(one, _)| *one == parameter)?;
        Some(stated.1.tolerance())
    }

    fn mirrors(&self, _: Varied) -> bool {
        false
    }

    fn is_short(&self) -> bool {
        self.is_point()
    }

    fn is_point(&self) -> bool {
        self.loads.iter().all(|load| load.range_hz[0] == load.range_hz[1])
    }

    fn judge(&self, known: &Known, how: Depth) -> Result<Vec<Judged>, ModalError> {
        let effort = match how {
            Depth::OnTheWay if !self.is_short() => AlongEffort::SCREENING,
            _ => AlongEffort::of(self),
        };
        // A load that is what it was does what it did.
        let Known { case, along } = known;
        let same = self.modes == case.modes && self.absorbers == case.absorbers;
        let along = if same { along.as_slice() } else { &[] };
        let found = match how {
            Depth::WhetherAllHold => ModalAnswer::whether_all_hold(self, &effort, along, &Serial)?,
            _ => ModalAnswer::with(self, &effort, along, &Serial)?,
        };
        Ok(found.judged)
    }

    fn kept_without_absorber(&self) -> bool {
        kept_alone(&self.criteria, |one| linear_most(self, one, &[]))
    }

    fn criteria(&self) -> &[Criterion] {
        &self.criteria
    }

    fn uncertainty(&self) -> &Uncertainty {
        &self.uncertainty
    }

    fn deviating(&self, errors: &[(Uncertain, f64)]) -> Option<Self> {
        let errors = errors.iter().map(|(one, error)| (one.parameter, one.of, *error));
        Self::deviating(self, &errors.collect::<Vec<_>>())
    }

    fn fails_unflown(&self) -> Result<bool, ModalError> {
        let mut unflown = self.clone();
        unflown.criteria.retain(|one| !one.measure.is_of_motions());
        let unknown = judge::unflown(self);
        Ok(Together::of(&ModalAnswer::judged(&unflown, unknown).judged) == Together::Fail)
    }
}
