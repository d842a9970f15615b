//! What of a design is chosen: its absorber.

use serde::Serialize;

use super::Design;

/// The absorber of a design.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct AbsorberDesign {
    /// `b`, in metres or the case's own unit.
    pub clearance: f64,
    /// `r`.
    pub restitution: f64,
    /// `m2` in kg; `None` for a reduced design, whose mass ratio stays.
    pub mass: Option<f64>,
}

impl AbsorberDesign {
    /// That of a design.
    pub fn of(design: &Design) -> Self {
        match design {
            Design::Physical(physical) => Self {
                clearance: physical.clearance_m,
                restitution: physical.restitution,
                mass: Some(physical.absorber_mass_kg),
            },
            Design::Reduced(reduced) => {
                Self { clearance: reduced.clearance, restitution: reduced.restitution, mass: None }
            }
        }
    }
}

impl Design {
    /// The amplitude of its excitation, in m, in N, or in its own unit.
    pub(super) fn amplitude(&self) -> f64 {
        match self {
            Self::Physical(physical) => physical.excitation.amplitude(),
            Self::Reduced(reduced) => reduced.forcing,
        }
    }

    /// The same oscillator and excitation with another absorber. Mass ratio, damping `lambda` and
    /// forcing `G` of its system follow from the mass.
    #[must_use]
    pub fn with(&self, choice: &AbsorberDesign) -> Self {
        match *self {
            Self::Physical(physical) => {
                let mut changed = physical;
                changed.clearance_m = choice.clearance;
                changed.restitution = choice.restitution;
                changed.absorber_mass_kg = choice.mass.unwrap_or(physical.absorber_mass_kg);
                Self::Physical(changed)
            }
            Self::Reduced(reduced) => {
                let mut changed = reduced;
                changed.clearance = choice.clearance;
                changed.restitution = choice.restitution;
                Self::Reduced(changed)
            }
        }
    }
}
