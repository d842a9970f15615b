//! The dimensionless system of a design, and the units that lead back.
//!
//! Lengths are divided by the clearance `b`, time by `1/omega0` with `omega0 = sqrt(k1/m1)`,
//! energies by `m1 omega0^2 b^2`. With `eps = m2/m1`:
//! `lambda = c1/(m2 omega0)`, `Omega = 2 pi f/omega0`, and the reduced forcing `G = F/eps` for a
//! base displacement `F` (equation (7) of Li, Seguy, Berlioz 2016) or `G = P/(k1 eps)` for a force
//! `P`; `gamma = G/b`. Accelerations are over `b omega0^2`: of a cavity's gravity `g sin(alpha)` and friction
//! `mu g cos(alpha)`, with standard gravity `g = 9.80665 m/s^2`.

use std::f64::consts::FRAC_PI_2;

use super::{Design, Physical};
use crate::excitation::{Release, Scene, SineSweep, Transient};
use crate::quantity::Units;
use crate::quantity::unit::STANDARD_GRAVITY;
use crate::system::{Cavity, Excitation, InvalidParameter, Parameters, Scales, System};

impl Design {
    /// The dimensionless system.
    ///
    /// # Errors
    /// [`InvalidParameter`] when values, each valid by itself, combine to a number that a double
    /// cannot hold, or when the design did not come from [`Case::parse`](super::Case::parse).
    pub fn system(&self) -> Result<System, InvalidParameter> {
        let units = self.units();
        let forcing_per_clearance = self.forcing() / units.clearance;
        match self {
            Self::Physical(p) => System::new(Parameters {
                mass_ratio: p.absorber_mass_kg / p.mass_kg,
                damping: p.damping_n_s_per_m / (p.absorber_mass_kg * units.natural_frequency),
                restitution: p.restitution,
                frequency_ratio: units.frequency_ratio(p.frequency_hz),
                forcing_per_clearance,
                excitation: p.excitation,
                cavity: cavity(p, &units),
            }),
            Self::Reduced(r) => {
                let system = System::new(Parameters {
                    mass_ratio: r.mass_ratio,
                    damping: r.damping,
                    restitution: r.restitution,
                    frequency_ratio: r.frequency_ratio.unwrap_or(1.0),
                    forcing_per_clearance,
                    excitation: r.excitation,
                    cavity: r.cavity,
                })?;
                // A small detuning would be lost in a ratio near 1.
                match (r.frequency_ratio, r.detuning) {
                    (None, Some(detuning)) => system.with_detuning(detuning),
                    _ => Ok(system),
                }
            }
        }
    }

    /// How the oscillator is set in motion, where nothing drives it.
    pub fn release(&self) -> Option<Release> {
        match self.transient()? {
            Transient::Release(release) => Some(release),
            _ => None,
        }
    }

    /// The sweep of its excitation's frequency.
    pub fn sine_sweep(&self) -> Option<SineSweep> {
        match self.transient()? {
            Transient::Sweep(sweep) => Some(sweep),
            _ => None,
        }
    }

    /// Whether the cavity is level, does not rub, and its ends are alike.
    pub fn has_ideal_cavity(&self) -> bool {
        self.system().is_ok_and(|system| system.cavity().is_ideal())
    }

    /// What the structure is subjected to.
    pub fn scene(&self) -> Scene {
        match self.transient() {
            None => Scene::Steady,
            Some(Transient::Release(_)) => Scene::Release,
            Some(Transient::Sweep(_)) => Scene::Sweep,
            Some(Transient::Record(_)) => Scene::Record,
        }
    }

    /// The units of its results.
    pub fn units(&self) -> Units {
        let scales: Scales = match self {
            Self::Physical(p) => Scales {
                natural_frequency: p.natural_frequency_rad_per_s(),
                oscillator_mass: p.mass_kg,
                physical: true,
                clearance: p.clearance_m,
            },
            Self::Reduced(r) => Scales { clearance: r.clearance, ..Scales::REDUCED },
        };
        Units::from(scales).with_pulse(self.pulse())
    }

    /// Acceleration of the oscillator at the top of the half-sine pulse of an impact, over the relative speed of the impact,
    /// in 1/s: its integral over the contact is the change of the velocity. None where impacts take no time.
    fn pulse(&self) -> Option<f64> {
        let Self::Physical(p) = self else { return None };
        let ratio = p.absorber_mass_kg / p.mass_kg;
        let restitution = p.restitution + 0.5 * p.restitution_difference.abs();
        let change = ratio / (1.0 + ratio) * (1.0 + restitution);
        Some(FRAC_PI_2 * change / p.contact_time_s?)
    }

    /// `G`, the reduced forcing, in metres or the design's own unit.
    pub fn forcing(&self) -> f64 {
        match self {
            Self::Physical(p) => {
                let displacement = match p.excitation {
                    Excitation::BaseDisplacement => p.amplitude,
                    Excitation::Force => p.amplitude / p.stiffness_n_per_m,
                };
                displacement / (p.absorber_mass_kg / p.mass_kg)
            }
            Self::Reduced(r) => r.forcing,
        }
    }
}

/// Gravity and friction in a cavity, over `b omega0^2`; neither acts on an absorber that a pendulum or a spring carries.
fn cavity(physical: &Physical, units: &Units) -> Cavity {
    let Physical { friction, restitution_difference, .. } = *physical;
    let unit = units.acceleration(1.0);
    // A level cavity is level even where the unit is too small for a number.
    let over_unit =
        |share: f64| if share == 0.0 { 0.0 } else { STANDARD_GRAVITY.size * share / unit };
    let carried = physical.support.is_some_and(|support| support.carries());
    let [along, across] = if carried { [0.0; 2] } else { physical.gravity_shares() };
    Cavity {
        gravity_along: over_unit(along),
        friction_acceleration: over_unit(friction * across),
        restitution_difference,
    }
}
