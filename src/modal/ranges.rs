//! Cases of several modes or absorbers as a search for ranges sees them: the structure's numbers are those of all modes together, a
//! clearance and a restitution are of one absorber, an amplitude is of one load.

use super::along::AlongEffort;
use super::linear::linear_most;
use super::{AlongLoad, ModalAnswer, ModalError};
use crate::case::{ModalCase, StructuralMode};
use crate::criteria::Judged;
use crate::executor::Serial;
use crate::operating_range::{Look, Varied, Varies};

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
        let each =
            |count: usize| if count > 1 { (0..count).map(Some).collect() } else { vec![None] };
        let mut parts: Vec<Option<usize>> = match number {
            Varied::Amplitude => each(self.loads.len()),
            Varied::Clearance | Varied::Restitution => each(self.absorbers.len()),
            Varied::Damping => vec![None],
            // Of a reduced case they are units.
            Varied::NaturalFrequency | Varied::Mass if !self.reduced => vec![None],
            _ => Vec::new(),
        };
        let has = |of: &Option<usize>| {
            self.value(number, *of).is_some_and(|own| own > 0.0 || number == Varied::Restitution)
        };
        parts.retain(has);
        parts
    }

    fn value(&self, number: Varied, of: Option<usize>) -> Option<f64> {
        let (mode, k) = (&self.modes[0], of.unwrap_or_default());
        Some(match number {
            Varied::Amplitude => self.loads.get(k)?.amplitude,
            Varied::Clearance => self.absorbers.get(k)?.clearance_m,
            Varied::Restitution => self.absorbers.get(k)?.restitution,
            Varied::NaturalFrequency => mode.frequency_hz,
            Varied::Damping => mode.damping_ratio,
            Varied::Mass => mode.mass_kg,
            Varied::Inclination | Varied::Friction => return None,
        })
    }

    fn with(&self, number: Varied, of: Option<usize>, value: f64) -> Option<Self> {
        let times = value / self.value(number, of)?;
        let mut case = match number {
            Varied::NaturalFrequency => self.with_frequencies(times),
            Varied::Damping => self.with_modes(|mode| mode.damping_ratio *= times),
            // Stiffness, damping constant and forces stay.
            Varied::Mass => self.with_modes(|mode| {
                mode.mass_kg *= times;
                mode.frequency_hz /= times.sqrt();
                mode.damping_ratio /= times.sqrt();
                mode.forcing /= times;
            }),
            _ => self.clone(),
        };
        let k = of.unwrap_or_default();
        match number {
            Varied::Amplitude => case.loads.get_mut(k)?.amplitude = value,
            Varied::Clearance => case.absorbers.get_mut(k)?.clearance_m = value,
            Varied::Restitution => case.absorbers.get_mut(k)?.restitution = value,
            _ => {}
        }
        let moves = case.loads.iter().all(|load| case.system(load, load.range_hz[0]).is_ok());
        moves.then_some(case)
    }

    fn tolerance(&self, _: Varied) -> Option<(f64, f64)> {
        None
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
}
