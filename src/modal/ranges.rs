//! Cases of several modes or absorbers as a search for ranges sees them: the structure's numbers are those of all modes together, a
//! clearance and a restitution are of one absorber, an amplitude is of one load.

use super::along::AlongEffort;
use super::linear::linear_most;
use super::{AlongLoad, ModalAnswer, ModalError};
use crate::case::{Distribution, ModalCase, StructuralMode};
use crate::criteria::Judged;
use crate::executor::Serial;
use crate::operating_range::{Look, Uncertain, Varied, Varies};
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

impl ModalCase {
    /// The same with so many times all natural frequencies, by the stiffness: modal masses and damping ratios stay.
    pub(super) fn with_frequencies(&self, times: f64) -> Self {
        self.with_modes(|mode| mode.frequency_hz *= times)
    }

    fn with_modes(&self, change: impl Fn(&mut StructuralMode)) -> Self {
        let mut case = self.clone();
        case.modes.iter_mut().for_each(change);
        case
    }

    /// The parts that have a number: see [`Varies::parts`].
    fn parts_of(&self, number: Parameter) -> Vec<Option<usize>> {
        let count = match number {
            Parameter::Amplitude => self.loads.len(),
            Parameter::Clearance | Parameter::Restitution | Parameter::AbsorberMass => {
                self.absorbers.len()
            }
            _ => 1,
        };
        if count > 1 { (0..count).map(Some).collect() } else { vec![None] }
    }

    /// A number of a part in SI units; of the modes that of the first one. None of what it has not, and of a reduced case of units.
    pub(crate) fn number(&self, number: Parameter, of: Option<usize>) -> Option<f64> {
        let (mode, k) = (&self.modes[0], of.unwrap_or_default());
        let is_unit = matches!(number, Parameter::NaturalFrequency | Parameter::Mass);
        Some(match number {
            _ if is_unit && self.reduced => return None,
            Parameter::Amplitude => self.loads.get(k)?.amplitude,
            Parameter::Clearance => self.absorbers.get(k)?.clearance_m,
            Parameter::Restitution => self.absorbers.get(k)?.restitution,
            Parameter::AbsorberMass => self.absorbers.get(k)?.mass_kg,
            Parameter::NaturalFrequency => mode.frequency_hz,
            Parameter::DampingRatio => mode.damping_ratio,
            Parameter::Mass => mode.mass_kg,
            _ => return None,
        })
    }

    /// The same with another value of a number, of the modes in proportion of all; none where that is no structure.
    fn with_number(&self, number: Parameter, of: Option<usize>, value: f64) -> Option<Self> {
        let (own, k) = (self.number(number, of)?, of.unwrap_or_default());
        let times = if value == own { 1.0 } else { value / own };
        let mut case = match number {
            Parameter::NaturalFrequency => self.with_frequencies(times),
            Parameter::DampingRatio => self.with_modes(|mode| mode.damping_ratio *= times),
            // Stiffness, damping constant and forces stay.
            Parameter::Mass => self.with_modes(|mode| {
                mode.mass_kg *= times;
                mode.frequency_hz /= times.sqrt();
                mode.damping_ratio /= times.sqrt();
                mode.forcing /= times;
            }),
            _ => self.clone(),
        };
        match number {
            Parameter::Amplitude => case.loads[k].amplitude = value,
            Parameter::Clearance => case.absorbers[k].clearance_m = value,
            Parameter::Restitution => case.absorbers[k].restitution = value,
            Parameter::AbsorberMass => case.absorbers[k].mass_kg = value,
            _ => {}
        }
        let moves = case.loads.iter().all(|load| case.system(load, load.range_hz[0]).is_ok());
        moves.then_some(case)
    }
}

/// What a number whose range is looked for is; none of what several modes do not have.
pub fn parameter(number: Varied) -> Option<Parameter> {
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

/// About how many times a `check` of a case the ranges of some numbers take.
pub fn looks(case: &ModalCase, numbers: &[Varied]) -> f64 {
    let parts: usize = numbers.iter().map(|one| case.parts(*one).len()).sum();
    parts as f64 * if case.is_short() { OF_POINTS } else { OF_RANGES }
}

impl Varies for ModalCase {
    type Effort = Known;
    type Error = ModalError;

    fn parts(&self, number: Varied) -> Vec<Option<usize>> {
        let Some(parameter) = parameter(number) else { return Vec::new() };
        let has = |of: &Option<usize>| {
            let own = self.number(parameter, *of);
            own.is_some_and(|own| own > 0.0 || number == Varied::Restitution)
        };
        self.parts_of(parameter).into_iter().filter(has).collect()
    }

    fn value(&self, number: Varied, of: Option<usize>) -> Option<f64> {
        self.number(parameter(number)?, of)
    }

    fn with(&self, number: Varied, of: Option<usize>, value: f64) -> Option<Self> {
        self.with_number(parameter(number)?, of, value)
    }

    fn tolerance(&self, number: Varied) -> Option<(f64, f64)> {
        let parameter = parameter(number)?;
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

    fn judge(&self, known: &Known, how: Look) -> Result<Vec<Judged>, ModalError> {
        let effort = match how {
            Look::OnTheWay if !self.is_short() => AlongEffort::SCREENING,
            _ => AlongEffort::FULL,
        };
        // A load that is what it was does what it did.
        let Known { case, along } = known;
        let same = self.modes == case.modes && self.absorbers == case.absorbers;
        let along = if same { along.as_slice() } else { &[] };
        Ok(ModalAnswer::with(self, &effort, along, &Serial)?.judged)
    }

    fn kept_without_absorber(&self) -> bool {
        let kept = self
            .criteria
            .iter()
            .filter_map(|one| linear_most(self, one, &[]).map(|value| one.part(value) <= 1.0));
        let kept: Vec<bool> = kept.collect();
        !kept.is_empty() && !kept.contains(&false)
    }

    fn has_criteria(&self) -> bool {
        !self.criteria.is_empty()
    }

    fn samples(&self) -> Option<u32> {
        self.uncertainty.samples
    }

    fn uncertain(&self) -> Vec<Uncertain> {
        let each = |(parameter, errors): (Parameter, Distribution)| {
            let parts = self.parts_of(parameter).into_iter();
            parts.map(move |of| Uncertain { parameter, of, errors })
        };
        self.uncertainty.parameters().flat_map(each).collect()
    }

    fn deviating(&self, errors: &[(Uncertain, f64)]) -> Option<Self> {
        errors.iter().try_fold(self.clone(), |case, (one, error)| {
            let value = case.number(one.parameter, one.of)? + error;
            let possible = match one.parameter {
                Parameter::Restitution => value.clamp(0.0, 1.0),
                Parameter::Amplitude | Parameter::DampingRatio => value.max(0.0),
                _ => value,
            };
            case.with_number(one.parameter, one.of, possible)
        })
    }

    fn fails_unflown(&self) -> Result<bool, ModalError> {
        Ok(false)
    }
}
