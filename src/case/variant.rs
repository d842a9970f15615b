//! A case with another number, of which nothing is written.

use super::{Case, Design};
use crate::contact::Impacts;
use crate::system::{Excitation, Parameter};

impl Case {
    /// The same with another design, of which nothing is written; none where it leaves no system.
    pub(crate) fn with_design(&self, design: Design) -> Option<Self> {
        let system = design.system().ok()?;
        Some(Self { design, system, ..self.clone() })
    }

    /// The same with another value of a parameter, and its band as [`BandSettings::beside`] has it: amplitudes along it keep
    /// their ratio to the case's own. None where it leaves nothing that could happen.
    pub(crate) fn varied(&self, parameter: Parameter, value: f64) -> Option<Self> {
        self.beside(self.design.with(parameter, value))
    }

    /// The same with errors added to some parameters, as [`Design::deviating`].
    pub(crate) fn deviating(&self, errors: &[(Parameter, f64)]) -> Option<Self> {
        self.beside(self.design.deviating(errors))
    }

    fn beside(&self, design: Design) -> Option<Self> {
        design.possible_system()?;
        let band = self.band.as_ref().map(|band| band.beside(&self.design, &design));
        Some(Self { band, ..self.with_design(design)? })
    }

    /// The same of a structure with so many times the natural frequency, by its stiffness: mass, force and damping ratio stay.
    /// None where there is none, as of a reduced case that is not driven steadily, whose time is that of its structure.
    pub(crate) fn with_natural_frequency(&self, factor: f64) -> Option<Self> {
        let mut design = self.design;
        match &mut design {
            Design::Physical(_) => {
                let own = self.design.value(Parameter::NaturalFrequency)?;
                return self.varied(Parameter::NaturalFrequency, factor * own);
            }
            Design::Reduced(of) if of.transient.is_none() => {
                of.frequency_ratio = Some(of.frequency_ratio() / factor);
                of.detuning = None;
                of.cavity = of.cavity.with_clearance_scaled(factor * factor);
                if of.excitation == Excitation::Force {
                    of.forcing /= factor * factor;
                }
            }
            Design::Reduced(_) => return None,
        }
        let band = self.band.as_ref().map(|band| band.moved(1.0 / factor, 0.0));
        Some(Self { band, ..self.with_design(design)? })
    }

    /// The same with the clearance and restitution that act like impacts of so many seconds, as [`Impacts::act_like`] has them; `impacts` over
    /// the clearance in fast time. None where that leaves nothing that could happen.
    pub(crate) fn acting_like(&self, impacts: Impacts, seconds: f64) -> Option<Self> {
        let Design::Physical(mut of) = self.design else { return None };
        let time = seconds / self.units().time(1.0);
        let [clearance, restitution] = impacts.act_like([1.0, of.restitution], time);
        of.clearance_m *= clearance;
        of.restitution = restitution;
        self.beside(Design::Physical(of))
    }

    /// Whether its cavity is level and its ends are alike: mirrored it is the same.
    pub(crate) fn has_ideal_walls(&self) -> bool {
        let cavity = self.system.cavity();
        cavity.gravity_along == 0.0 && cavity.restitution_difference == 0.0
    }
}
