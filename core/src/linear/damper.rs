//! A tuned mass damper of mass ratio `mu` on the structure: a spring of frequency `f omega0` and a damping ratio `zeta` of
//! its own. With `Omega` the frequency ratio and `k = f^2 + 2 i zeta f Omega` the structure's complex amplitude is
//! `X = F/(1 - Omega^2 + i eps lambda Omega - Omega^2 mu k/(k - Omega^2))` (Den Hartog, Mechanical Vibrations, 4th ed.,
//! section 3.3), and the damper moves against it by `Omega^2 X/(k - Omega^2)`.

use nalgebra::Complex;
use serde::Serialize;

use crate::system::System;

/// A tuned mass damper: a mass on a spring and a viscous damper.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TunedMassDamper {
    /// Natural frequency over the oscillator's.
    pub tuning: f64,
    /// Damping over its own critical one.
    pub damping_ratio: f64,
}

impl TunedMassDamper {
    /// That of Den Hartog (Mechanical Vibrations, 4th ed., section 3.3) for a mass ratio `mu`: tuning
    /// `1/(1 + mu)` and damping `sqrt(3 mu/(8 (1 + mu)^3))` of the oscillator's critical one, so
    /// `sqrt(3 mu/(8 (1 + mu)))` of its own, make the two fixed points of the response of an undamped
    /// oscillator driven by a force equally high.
    pub fn den_hartog(mass_ratio: f64) -> Self {
        let total = 1.0 + mass_ratio;
        Self { tuning: 1.0 / total, damping_ratio: (3.0 * mass_ratio / (8.0 * total)).sqrt() }
    }

    /// The damper with which an undamped structure comes to rest fastest: its four roots are a double pair, at
    /// tuning `1/(1 + mu)` and damping ratio `sqrt(mu/(1 + mu))` (Nishihara and Matsuhisa 1997, maximum stability).
    pub fn for_free_decay(mass_ratio: f64) -> Self {
        let total = 1.0 + mass_ratio;
        Self { tuning: 1.0 / total, damping_ratio: (mass_ratio / total).sqrt() }
    }

    /// The same damper on a structure whose natural frequency is `factor` times as high.
    pub fn on_detuned(&self, factor: f64) -> Self {
        Self { tuning: self.tuning / factor, ..*self }
    }

    /// Amplitude of the oscillator that carries it instead of the absorber, over the system's clearance;
    /// infinite where nothing limits it.
    pub fn amplitude(&self, system: &System) -> f64 {
        let omega = system.frequency_ratio();
        let mu = system.mass_ratio();
        let (sine, cosine) = system.excitation_amplitudes();
        let (coupling, against) = self.coupling(omega);
        let loss = mu * system.damping() * omega;
        let stiffness =
            Complex::new(1.0 - omega * omega, loss) - omega * omega * mu * coupling / against;
        limited(libm::hypot(sine, cosine) / libm::hypot(stiffness.re, stiffness.im))
    }

    /// Amplitude of its own motion against the oscillator, over the same.
    pub fn stroke(&self, system: &System) -> f64 {
        let omega = system.frequency_ratio();
        let (_, against) = self.coupling(omega);
        let relative = omega * omega / libm::hypot(against.re, against.im);
        limited(self.amplitude(system) * relative)
    }

    /// What the damper's spring and damping do, over its mass, and what is left of it against its inertia.
    fn coupling(&self, omega: f64) -> (Complex<f64>, Complex<f64>) {
        let spring = self.tuning * self.tuning;
        let coupling = Complex::new(spring, 2.0 * self.damping_ratio * self.tuning * omega);
        (coupling, coupling - omega * omega)
    }
}

fn limited(amplitude: f64) -> f64 {
    if amplitude.is_nan() { f64::INFINITY } else { amplitude }
}
