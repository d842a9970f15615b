//! What else could be done along a band: nothing, or a tuned mass damper of the same mass, with the best design of it.

use super::Band;
use crate::dampers::{self, AtBound, SineLimits};
use crate::linear::{BandSystems, Damped, TunedMassDamper, bare_amplitude};

/// What can be done without the absorber. Lengths over the clearance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rivals {
    /// Largest amplitude of the bare oscillator, and where; infinite where nothing limits it.
    pub bare: (f64, f64),
    /// The tuned mass damper of the same mass that is best along the band.
    pub damper: TunedMassDamper,
    /// Its largest amplitude and stroke.
    pub damped: Damped,
}

impl Rivals {
    /// What the damper is where the search for it ended at a bound.
    pub fn at_bound(&self) -> Option<AtBound> {
        AtBound::of(self.damper.tuning, self.damper.damping_ratio)
    }

    /// Those along a band, the damper by what is asked.
    pub fn along(band: &Band, asked: &SineLimits) -> Self {
        let along = BandSystems::of(band);
        let damper = dampers::for_band(&along, asked);
        Self { bare: along.largest(bare_amplitude), damper, damped: along.damped(damper) }
    }

    /// The same with the damper that lets the structure move least, whatever is asked.
    pub fn of_displacement(band: &Band) -> Self {
        Self::along(band, &SineLimits::default())
    }

    /// What the damper comes to along the same band where the structure's natural frequency is `factor` times as high, and
    /// nobody told it; none where there is no such structure.
    pub fn damped_off(&self, band: &Band, factor: f64) -> Option<Damped> {
        let band = band.with_structure_detuned(factor)?;
        Some(self.damper.on_detuned(factor).along(&band))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::{BandOver, Cavity, Excitation, Parameters, System};

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

    fn around_resonance(base: System) -> Band {
        Band { base, over: BandOver::Frequency, range: [0.7, 1.3], spectrum: Vec::new() }
    }

    /// Nishihara and Asami (2002) give the exact optimum of an undamped oscillator in closed form; its
    /// height is Den Hartog's to a few thousandths, its damping ratio
    /// `sqrt((8 + 9 mu - 4 sqrt(4 + 3 mu))/(1 + mu))/4`. The simplex ends where the peaks differ by 1e-3, which
    /// leaves the damping 2 %.
    #[test]
    fn the_design_of_an_undamped_oscillator_is_den_hartogs_but_for_what_he_neglects() {
        for mu in [0.005, 0.02, 0.08] {
            let rivals =
                Rivals::of_displacement(&around_resonance(system(mu, 0.0, Excitation::Force)));
            let height = (1.0 + 2.0 / mu).sqrt();
            assert!((rivals.damped.amplitude / height - 1.0).abs() < 4e-3, "{mu} {rivals:?}");
            let den_hartog = TunedMassDamper::den_hartog(mu);
            assert!((rivals.damper.tuning / den_hartog.tuning - 1.0).abs() < 3e-3, "{rivals:?}");
            let exact = (8.0 + 9.0 * mu - 4.0 * (4.0 + 3.0 * mu).sqrt()) / (1.0 + mu);
            let exact = 0.25 * exact.sqrt();
            assert!((rivals.damper.damping_ratio / exact - 1.0).abs() < 0.02, "{mu} {rivals:?}");
            assert!((den_hartog.damping_ratio / exact - 1.0).abs() < 0.02, "{mu} {den_hartog:?}");
        }
    }

    #[test]
    fn no_neighbour_of_the_design_is_better() {
        for (mu, zeta, excitation) in
            [(0.015, 0.004, Excitation::Force), (0.01, 0.02, Excitation::BaseDisplacement)]
        {
            let band = around_resonance(system(mu, zeta, excitation));
            let Rivals { damper, damped, .. } = Rivals::of_displacement(&band);
            for (tuning, damping) in
                [(0.99, 1.0), (1.01, 1.0), (1.0, 0.9), (1.0, 1.1), (0.995, 1.05)]
            {
                let other = TunedMassDamper {
                    tuning: tuning * damper.tuning,
                    damping_ratio: damping * damper.damping_ratio,
                };
                let (_, height) = BandSystems::of(&band).largest(|system| other.amplitude(system));
                assert!(height > damped.amplitude, "{mu} {tuning} {damping}");
            }
        }
    }
}
