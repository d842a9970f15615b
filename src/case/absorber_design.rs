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
            Self::Physical(physical) => physical.amplitude,
            Self::Reduced(reduced) => reduced.forcing,
        }
    }

    /// The same oscillator and excitation with another absorber. Mass ratio, damping `lambda` and
    /// forcing `G` of its system follow from the mass.
    #[must_use]
    pub fn with(mut self, choice: &AbsorberDesign) -> Self {
        let (clearance, restitution) = match &mut self {
            Self::Physical(physical) => {
                physical.absorber_mass_kg = choice.mass.unwrap_or(physical.absorber_mass_kg);
                (&mut physical.clearance_m, &mut physical.restitution)
            }
            Self::Reduced(reduced) => (&mut reduced.clearance, &mut reduced.restitution),
        };
        (*clearance, *restitution) = (choice.clearance, choice.restitution);
        self
    }
}
