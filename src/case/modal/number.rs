//! Numbers of a structure of several modes and absorbers that may be others, by their parameter: of one absorber, of one excitation, or of
//! the modes, of which that of the first one is told and all others change in proportion.

use super::{ModalCase, StructuralMode};
use crate::case::parameter::possible;
use crate::quantity::Kind;
use crate::quantity::catalogue as of;
use crate::system::Parameter;

impl ModalCase {
    /// The parts that have a number, by index; none as the only one where it is of the whole structure, or there is one part.
    pub(crate) fn parts_of(&self, number: Parameter) -> Vec<Option<usize>> {
        let count = match number {
            Parameter::Frequency | Parameter::Amplitude => self.loads.len(),
            one if is_of_absorber(one) => self.absorbers.len(),
            _ => 1,
        };
        if count > 1 { (0..count).map(Some).collect() } else { vec![None] }
    }

    /// What a number is.
    pub fn kind_of(&self, number: Parameter, of: Option<usize>) -> &'static Kind {
        match number {
            Parameter::Frequency => &of::EXCITATION_FREQUENCY,
            Parameter::Amplitude => self.loads[of.unwrap_or_default()].amplitude_kind(),
            Parameter::NaturalFrequency => &of::NATURAL_FREQUENCY,
            Parameter::DampingRatio => &of::DAMPING_RATIO,
            Parameter::Mass => &of::OSCILLATOR_MASS,
            Parameter::Restitution => &of::RESTITUTION,
            Parameter::AbsorberMass => &of::ABSORBER_MASS,
            _ => &of::CLEARANCE,
        }
    }

    /// The value of a number in SI units; none of a frequency of a range, of what it has not, and of units of a reduced case.
    pub(crate) fn number(&self, number: Parameter, of: Option<usize>) -> Option<f64> {
        let (mode, k) = (&self.modes[0], of.unwrap_or_default());
        let is_unit = matches!(number, Parameter::NaturalFrequency | Parameter::Mass);
        Some(match number {
            _ if is_unit && self.reduced => return None,
            Parameter::Frequency => {
                let [from, to] = self.loads.get(k)?.range_hz;
                return (from == to).then_some(from);
            }
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

    /// Gives a number another value; what it has not stays.
    pub(super) fn set(&mut self, number: Parameter, of: Option<usize>, value: f64) {
        let k = of.unwrap_or_default();
        let times =
            self.number(number, of).filter(|own| *own != value).map_or(1.0, |own| value / own);
        match number {
            Parameter::Frequency => self.loads[k].range_hz = [value; 2],
            Parameter::Amplitude => self.loads[k].amplitude = value,
            Parameter::Clearance => self.absorbers[k].clearance_m = value,
            Parameter::Restitution => self.absorbers[k].restitution = value,
            Parameter::AbsorberMass => self.absorbers[k].mass_kg = value,
            Parameter::NaturalFrequency => self.change(|mode| mode.frequency_hz *= times),
            Parameter::DampingRatio => self.change(|mode| mode.damping_ratio *= times),
            // Stiffness, damping constant and forces stay.
            Parameter::Mass => self.change(|mode| {
                mode.mass_kg *= times;
                mode.frequency_hz /= times.sqrt();
                mode.damping_ratio /= times.sqrt();
                mode.forcing /= times;
            }),
            _ => {}
        }
    }

    fn change(&mut self, change: impl Fn(&mut StructuralMode)) {
        self.modes.iter_mut().for_each(change);
    }

    /// The same with another value of a number; none where that is no structure.
    pub(crate) fn varied(&self, number: Parameter, of: Option<usize>, value: f64) -> Option<Self> {
        self.number(number, of)?;
        let mut case = self.clone();
        case.set(number, of, value);
        let moves = case.loads.iter().all(|load| case.system(load, load.range_hz[0]).is_ok());
        moves.then_some(case)
    }

    /// The same with so many times all natural frequencies, by the stiffness: modal masses and damping ratios stay.
    pub(crate) fn with_frequencies(&self, times: f64) -> Self {
        let mut case = self.clone();
        case.change(|mode| mode.frequency_hz *= times);
        case
    }

    /// The same with errors added to some numbers, as [`Design::deviating`](crate::case::Design::deviating).
    pub(crate) fn deviating(&self, errors: &[(Parameter, Option<usize>, f64)]) -> Option<Self> {
        errors.iter().try_fold(self.clone(), |case, (number, of, error)| {
            let value = case.number(*number, *of)? + error;
            case.varied(*number, *of, possible(*number, value, 0.0))
        })
    }
}

/// Whether a number is of an absorber.
pub const fn is_of_absorber(number: Parameter) -> bool {
    matches!(number, Parameter::Clearance | Parameter::Restitution | Parameter::AbsorberMass)
}
