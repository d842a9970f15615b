//! The structure without the absorber: alone, and with a tuned mass damper of the same mass. All of it is linear, so that
//! nothing is simulated: amplitudes of steady motion are closed forms, and any other motion is a matrix exponential.
//!
//! `x'' + eps lambda x' + x = f`, with `f` the excitation over the clearance and `tau = omega0 t`; the damper is described
//! at [`TunedMassDamper`]. What is read of a motion stands here too, as the same is read where the absorber impacts
//! ([`Passage`], [`Response`]).

mod along;
mod carried;
mod damper;
mod modal;
mod motion;
mod passage;
mod response;
mod settling;

pub use along::BandSystems;
pub use along::{Damped, bare_along};
pub use carried::{carried_frequencies, carried_state};
pub use damper::TunedMassDamper;
pub use modal::{ModalAmplitudes, ModalDamper, ModalResponse, PlacedResponse, frequencies_with};
pub use motion::{Linear, driven, released, released_between, swept};
pub use passage::Passage;
pub use response::Meter;
pub use response::Response;
pub(crate) use response::StillToCome;
pub use settling::STEPS;
pub use settling::Settling;

use std::f64::consts::TAU;

use crate::system::System;

/// Amplitude of the oscillator alone, over the system's clearance; infinite where nothing limits it.
pub fn bare_amplitude(system: &System) -> f64 {
    system.linear_response().map_or(f64::INFINITY, |response| response.amplitude())
}

/// Oscillations in which the structure alone comes to a share of its amplitude; infinite without damping.
pub fn bare_decay(system: &System, share: f64) -> f64 {
    // C = C0 exp(-eps lambda tau/2).
    -2.0 * libm::log(share) / (system.mass_ratio() * system.damping() * TAU)
}

/// Reduction in decibels of an amplitude against another: positive where it is smaller.
pub fn reduction_db(amplitude: f64, against: f64) -> f64 {
    20.0 * libm::log10(against / amplitude)
}

/// The same of an amplitude with its error: a larger one is reduced by so much less.
pub fn reduction([amplitude, error]: [f64; 2], against: f64) -> [f64; 2] {
    [reduction_db(amplitude, against), level_error(amplitude, error)]
}

/// The error in decibels of a level whose amplitude may be larger by an error.
pub fn level_error(amplitude: f64, error: f64) -> f64 {
    if amplitude > 0.0 {
        20.0 * std::f64::consts::LOG10_E * libm::log1p(error / amplitude)
    } else {
        error
    }
}

#[cfg(test)]
mod tests {
    use super::{TunedMassDamper, reduction_db};
    use crate::system::{Cavity, Excitation, Parameters, System};

    fn system(mass_ratio: f64, zeta: f64, excitation: Excitation) -> System {
        System::new(Parameters {
            mass_ratio,
            damping: 2.0 * zeta / mass_ratio,
            restitution: 0.6,
            frequency_ratio: 1.0,
            // A static displacement of 1: eps gamma = 1.
            forcing_per_clearance: 1.0 / mass_ratio,
            excitation,
            cavity: Cavity::IDEAL,
        })
        .expect("valid")
    }

    /// Den Hartog's own check: without damping of the oscillator the response at both fixed points is
    /// `sqrt(1 + 2/mu)` times the static one, whatever the damper's damping.
    #[test]
    fn the_fixed_points_are_as_high_as_den_hartog_says() {
        for mu in [0.01, 0.05, 0.25] {
            let damper = TunedMassDamper::den_hartog(mu);
            let height = (1.0 + 2.0 / mu).sqrt();
            // Fixed points: g^2 = (1 -+ sqrt(mu/(2 + mu)))/(1 + mu).
            for sign in [-1.0, 1.0] {
                let squared: f64 = (1.0 + sign * (mu / (2.0 + mu)).sqrt()) / (1.0 + mu);
                let there = system(mu, 0.0, Excitation::Force).with_frequency_ratio(squared.sqrt());
                let there = there.expect("valid");
                for factor in [0.3, 1.0, 4.0] {
                    let other =
                        TunedMassDamper { damping_ratio: factor * damper.damping_ratio, ..damper };
                    let amplitude = other.amplitude(&there);
                    assert!((amplitude / height - 1.0).abs() < 1e-12, "{mu} {sign} {factor}");
                }
            }
        }
    }

    #[test]
    fn half_the_amplitude_is_six_decibels() {
        assert!((reduction_db(0.5, 1.0) - 6.020_599_913_279_624).abs() < 1e-12);
    }
}
