//! A system from the numbers on a drawing: SI units in, the dimensionless system and its scales out.

use std::f64::consts::TAU;

use super::{Cavity, Excitation, InvalidParameter, Parameters, Scales, System};

/// Standard gravity in m/s^2.
pub const STANDARD_GRAVITY: f64 = 9.80665;

/// The structure: a mass on a spring and a viscous damper.
///
/// [`Structure::modal`] has the same from the natural frequency and the damping ratio of a mode.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Structure {
    /// `m1`, above 0.
    pub mass_kg: f64,
    /// `k1`, above 0.
    pub stiffness_n_per_m: f64,
    /// `c1`, at least 0.
    pub damping_n_s_per_m: f64,
}

impl Structure {
    /// One mode: its modal mass, its natural frequency `f0 = omega0/(2 pi)` and its damping ratio
    /// `c1/(2 sqrt(k1 m1))`.
    pub fn modal(mass_kg: f64, natural_frequency_hz: f64, damping_ratio: f64) -> Self {
        let stiffness_n_per_m = modal_stiffness(mass_kg, natural_frequency_hz);
        let undamped = Self { mass_kg, stiffness_n_per_m, damping_n_s_per_m: 0.0 };
        let damping_n_s_per_m = damping_ratio * undamped.critical_damping_n_s_per_m();
        Self { damping_n_s_per_m, ..undamped }
    }

    /// `omega0 = sqrt(k1/m1)`, in radians per second.
    pub fn natural_frequency_rad_per_s(&self) -> f64 {
        self.stiffness_n_per_m.sqrt() / self.mass_kg.sqrt()
    }

    /// `2 sqrt(k1 m1)` in N s/m, the damping per unit of velocity at which the structure alone ceases to ring.
    pub fn critical_damping_n_s_per_m(&self) -> f64 {
        2.0 * self.stiffness_n_per_m.sqrt() * self.mass_kg.sqrt()
    }
}

/// `k1 = m1 (2 pi f0)^2` in N/m, of a mass in kg and a frequency in Hz.
pub fn modal_stiffness(mass_kg: f64, natural_frequency_hz: f64) -> f64 {
    let omega0 = TAU * natural_frequency_hz;
    mass_kg * omega0 * omega0
}

/// The mass that is free between two walls of the structure.
///
/// [`Absorber::new`] has a level cavity without friction, whose walls are alike:
/// `Absorber { friction: 0.01, ..Absorber::new(0.032, 0.0075, 0.6) }` has another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Absorber {
    /// `m2`, above 0.
    pub mass_kg: f64,
    /// `b`, from the middle to either wall, above 0.
    pub clearance_m: f64,
    /// `r`, from 0 to 1; the mean where the walls differ.
    pub restitution: f64,
    /// Restitution at the wall `x - y = +b` less that at `x - y = -b`.
    pub restitution_difference: f64,
    /// The angle of the cavity against the horizontal: gravity acts along positive displacements of the absorber where it
    /// is positive.
    pub inclination_rad: f64,
    /// `mu`, the coefficient of sliding friction, at least 0.
    pub friction: f64,
}

impl Absorber {
    /// In an ideal cavity.
    pub const fn new(mass_kg: f64, clearance_m: f64, restitution: f64) -> Self {
        let [restitution_difference, inclination_rad, friction] = [0.0; 3];
        Self {
            mass_kg,
            clearance_m,
            restitution,
            restitution_difference,
            inclination_rad,
            friction,
        }
    }
}

/// A harmonic excitation of the structure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Harmonic {
    /// Where it enters.
    pub excitation: Excitation,
    /// `F` in m of a base, `P` in N of a force; at least 0.
    pub amplitude: f64,
    /// `f`, above 0.
    pub frequency_hz: f64,
}

impl Harmonic {
    /// A force `P sin(2 pi f t)` on the structure's mass.
    pub const fn force(amplitude_n: f64, frequency_hz: f64) -> Self {
        Self { excitation: Excitation::Force, amplitude: amplitude_n, frequency_hz }
    }

    /// A base that moves by `F sin(2 pi f t)`.
    pub const fn base(amplitude_m: f64, frequency_hz: f64) -> Self {
        let excitation = Excitation::BaseDisplacement;
        Self { excitation, amplitude: amplitude_m, frequency_hz }
    }

    /// `G = F/eps`, or `P/(k1 eps)`, in m: the reduced forcing, equation (7) of Li, Seguy, Berlioz (2016).
    pub fn reduced_forcing_m(&self, structure: &Structure, absorber: &Absorber) -> f64 {
        let displacement = match self.excitation {
            Excitation::BaseDisplacement => self.amplitude,
            Excitation::Force => self.amplitude / structure.stiffness_n_per_m,
        };
        displacement / (absorber.mass_kg / structure.mass_kg)
    }
}

/// Shares of gravity along a cavity of an inclination in rad, and across it.
pub fn gravity_shares(inclination_rad: f64) -> [f64; 2] {
    // The cosine of a rounded quarter turn is not 0, and yet nothing presses the absorber on an upright track.
    let across = Some(libm::cos(inclination_rad).abs()).filter(|share| *share > f64::EPSILON);
    [libm::sin(inclination_rad), across.unwrap_or_default()]
}

impl Scales {
    /// Those of a design in SI units.
    pub fn of(structure: &Structure, absorber: &Absorber) -> Self {
        Self {
            physical: true,
            clearance: absorber.clearance_m,
            natural_frequency: structure.natural_frequency_rad_per_s(),
            oscillator_mass: structure.mass_kg,
        }
    }
}

impl System {
    /// The dimensionless system of a design in SI units, and the scales that lead back to it.
    ///
    /// `eps = m2/m1`, `lambda = c1/(m2 omega0)`, `Omega = 2 pi f/omega0`, `gamma = G/b`; accelerations of the cavity are
    /// over `b omega0^2`: `g sin(alpha)` and `mu g cos(alpha)`.
    ///
    /// ```
    /// use vinesink_core::system::{Absorber, Harmonic, Structure, System};
    ///
    /// // 4.168 kg at 8.35 Hz with 0.69 % damping; 32 g between walls 15 mm apart; the base moves by 0.25 mm at 8 Hz.
    /// let structure = Structure::modal(4.168, 8.35, 0.0069);
    /// let absorber = Absorber::new(0.032, 7.5e-3, 0.6);
    /// let (system, scales) = System::physical(&structure, &absorber, &Harmonic::base(0.25e-3, 8.0))?;
    ///
    /// let alone = system.linear_response().expect("damped").amplitude();
    /// assert!((scales.length(alone) - 3.01e-3).abs() < 0.02e-3); // m
    /// # Ok::<(), vinesink_core::system::InvalidParameter>(())
    /// ```
    ///
    /// # Errors
    /// [`InvalidParameter`] names what is not finite or out of its range, as [`System::new`] names it where numbers that
    /// are valid by themselves do not go together.
    pub fn physical(
        structure: &Structure,
        absorber: &Absorber,
        excitation: &Harmonic,
    ) -> Result<(Self, Scales), InvalidParameter> {
        let numbers = [
            ("mass_kg of the structure", structure.mass_kg),
            ("stiffness_n_per_m", structure.stiffness_n_per_m),
            ("mass_kg of the absorber", absorber.mass_kg),
            ("clearance_m", absorber.clearance_m),
            ("frequency_hz", excitation.frequency_hz),
        ];
        for (name, value) in numbers {
            super::check(name, value, value > 0.0, "a finite number above 0")?;
        }
        let scales = Scales::of(structure, absorber);
        let system = Self::new(Parameters {
            mass_ratio: absorber.mass_kg / structure.mass_kg,
            damping: structure.damping_n_s_per_m / (absorber.mass_kg * scales.natural_frequency),
            restitution: absorber.restitution,
            frequency_ratio: scales.frequency_ratio(excitation.frequency_hz),
            forcing_per_clearance: excitation.reduced_forcing_m(structure, absorber)
                / scales.clearance,
            excitation: excitation.excitation,
            cavity: cavity(absorber, &scales),
        })?;
        Ok((system, scales))
    }
}

fn cavity(absorber: &Absorber, scales: &Scales) -> Cavity {
    let unit = scales.acceleration(1.0);
    // A level cavity is level even where the unit is too small for a number.
    let over_unit = |share: f64| if share == 0.0 { 0.0 } else { STANDARD_GRAVITY * share / unit };
    let [along, across] = gravity_shares(absorber.inclination_rad);
    Cavity {
        gravity_along: over_unit(along),
        friction_acceleration: over_unit(absorber.friction * across),
        restitution_difference: absorber.restitution_difference,
    }
}
