//! The only conversion between a design's units and the dimensionless system.
//!
//! Lengths are divided by the clearance `b`, time by `1/omega0` with `omega0 = sqrt(k1/m1)`,
//! energies by `m1 omega0^2 b^2`. With `eps = m2/m1`:
//! `lambda = c1/(m2 omega0)`, `Omega = 2 pi f/omega0`, and the reduced forcing `G = F/eps` for a
//! base displacement `F` (equation (7) of Li, Seguy, Berlioz 2016) or `G = P/(k1 eps)` for a force
//! `P`; `gamma = G/b`. Accelerations are over `b omega0^2`: of a cavity's gravity `g sin(alpha)` and friction
//! `mu g cos(alpha)`, with standard gravity `g = 9.80665 m/s^2`.

use std::f64::consts::TAU;

use super::{Design, Physical};
use crate::quantity::Dimension;
use crate::quantity::units::STANDARD_GRAVITY;
use crate::system::{Cavity, Excitation, InvalidParameter, Parameters, System};
use crate::transient::{Release, Scene, SineSweep, Transient};

/// What turns dimensionless results back into the design's units: SI, or for a reduced design those of an
/// oscillator with m1 = k1 = 1, lengths in the unit of its own clearance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scales {
    /// Whether the units are those of SI.
    pub physical: bool,
    /// `b`.
    pub clearance: f64,
    /// `omega0 = sqrt(k1/m1)` in rad/s; 1 for a reduced design.
    pub natural_frequency: f64,
    /// `m1` in kg; 1 for a reduced design.
    pub oscillator_mass: f64,
    /// `G`, the reduced forcing, in the unit of [`Scales::clearance`].
    pub forcing: f64,
}

impl Scales {
    /// The unit of [`Scales::clearance`], [`Scales::forcing`] and [`Scales::length`]: "m", or "1" for a
    /// reduced design's own.
    pub fn length_unit(&self) -> &'static str {
        Dimension::Length.symbol(self.physical)
    }

    /// A length given over the clearance.
    pub fn length(&self, over_clearance: f64) -> f64 {
        over_clearance * self.clearance
    }

    /// A length, over the clearance.
    pub fn over_clearance(&self, length: f64) -> f64 {
        length / self.clearance
    }

    /// The inclination in rad of a cavity along which gravity accelerates by so much over `b omega0^2`; none where that is
    /// more than gravity.
    pub fn inclination(&self, along: f64) -> Option<f64> {
        let sine = self.acceleration(along) / STANDARD_GRAVITY.size;
        (sine.abs() <= 1.0).then(|| libm::asin(sine))
    }

    /// The coefficient of friction in a cavity by the accelerations of gravity along it and of friction, over
    /// `b omega0^2`; none where gravity does not press on it.
    pub fn friction(&self, accelerations: [f64; 2]) -> Option<f64> {
        let [sine, friction] =
            accelerations.map(|one| self.acceleration(one) / STANDARD_GRAVITY.size);
        let coefficient = friction / ((1.0 - sine) * (1.0 + sine)).sqrt();
        coefficient.is_finite().then_some(coefficient)
    }

    /// The frequency of a frequency ratio `Omega`: in Hz, or the ratio itself for a reduced design.
    pub fn frequency(&self, ratio: f64) -> f64 {
        ratio * self.natural_frequency / self.turn()
    }

    /// The frequency ratio `Omega` of a frequency.
    pub fn frequency_ratio(&self, frequency: f64) -> f64 {
        self.turn() * frequency / self.natural_frequency
    }

    /// What frequencies are counted in, rad: turns, or those of the natural frequency.
    fn turn(&self) -> f64 {
        if self.physical { TAU } else { 1.0 }
    }

    /// The time of a fast time `tau`.
    pub fn time(&self, tau: f64) -> f64 {
        tau / self.natural_frequency
    }

    /// The velocity of one in clearances per fast time.
    pub fn velocity(&self, dimensionless: f64) -> f64 {
        dimensionless * (self.clearance * self.natural_frequency)
    }

    /// The acceleration of one in clearances per fast time squared.
    pub fn acceleration(&self, dimensionless: f64) -> f64 {
        self.velocity(dimensionless) * self.natural_frequency
    }

    /// The energy of one per unit `m1` with lengths over the clearance and fast time, so the factor is
    /// `m1 omega0^2 b^2`.
    pub fn energy(&self, dimensionless: f64) -> f64 {
        let speed = self.clearance * self.natural_frequency;
        dimensionless * self.oscillator_mass * speed * speed
    }
}

impl Design {
    /// The dimensionless system.
    ///
    /// # Errors
    /// [`InvalidParameter`] when values, each valid by itself, combine to a number that a double
    /// cannot hold, or when the design did not come from [`Case::parse`](super::Case::parse).
    pub fn system(&self) -> Result<System, InvalidParameter> {
        let scales = self.scales();
        let forcing_per_clearance = scales.forcing / scales.clearance;
        let omega0 = scales.natural_frequency;
        match self {
            Self::Physical(p) => System::new(Parameters {
                mass_ratio: p.absorber_mass_kg / p.mass_kg,
                damping: p.damping_n_s_per_m / (p.absorber_mass_kg * omega0),
                restitution: p.restitution,
                frequency_ratio: scales.frequency_ratio(p.frequency_hz),
                forcing_per_clearance,
                excitation: p.excitation,
                cavity: cavity(p, &scales),
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

    /// What is not steady vibration in it.
    pub fn transient(&self) -> Option<Transient> {
        *self.clone().common().transient
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

    /// What turns the system's results back into this design's units.
    pub fn scales(&self) -> Scales {
        match self {
            Self::Physical(p) => {
                let displacement = match p.excitation {
                    Excitation::BaseDisplacement => p.amplitude,
                    Excitation::Force => p.amplitude / p.stiffness_n_per_m,
                };
                Scales {
                    physical: true,
                    clearance: p.clearance_m,
                    natural_frequency: p.natural_frequency_rad_per_s(),
                    oscillator_mass: p.mass_kg,
                    forcing: displacement / (p.absorber_mass_kg / p.mass_kg),
                }
            }
            Self::Reduced(r) => Scales {
                physical: false,
                clearance: r.clearance,
                natural_frequency: 1.0,
                oscillator_mass: 1.0,
                forcing: r.forcing,
            },
        }
    }
}

/// Gravity and friction in a cavity, over `b omega0^2`.
fn cavity(physical: &Physical, scales: &Scales) -> Cavity {
    let Physical { inclination_rad, friction, restitution_difference, .. } = *physical;
    let unit = scales.acceleration(1.0);
    // A level cavity is level even where the unit is too small for a number.
    let over_unit =
        |share: f64| if share == 0.0 { 0.0 } else { STANDARD_GRAVITY.size * share / unit };
    // The cosine of a rounded quarter turn is not 0, and yet nothing presses the absorber on an upright track.
    let normal = Some(libm::cos(inclination_rad)).filter(|share| *share > f64::EPSILON);
    let normal = normal.unwrap_or_default();
    Cavity {
        gravity_along: over_unit(libm::sin(inclination_rad)),
        friction_acceleration: over_unit(friction * normal),
        restitution_difference,
    }
}
