//! What else could be done: nothing, or a tuned mass damper of the same mass.

use argmin::core::{CostFunction, Error, Executor, State as _};
use argmin::solver::neldermead::NelderMead;
use nalgebra::Complex;
use serde::Serialize;

use super::Band;
use crate::case::BandOver;
use crate::numerics::scan::largest;
use crate::system::System;

/// A tuned mass damper: a mass on a spring and a viscous damper.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TunedMassDamper {
    /// Natural frequency over the oscillator's.
    pub tuning: f64,
    /// Damping over its own critical one.
    pub damping_ratio: f64,
}

/// Size of the first simplex of a design, in the logarithms of tuning and damping ratio.
const SIMPLEX: [f64; 2] = [0.02, 0.3];
/// Steps of a simplex, and how often it begins again where it ended: the largest of two resonances has
/// a kink where they are equal, at which a simplex may collapse early.
const STEPS: u64 = 120;
const RESTARTS: u32 = 3;

impl TunedMassDamper {
    /// That of Den Hartog (Mechanical Vibrations, 4th ed., section 3.3) for a mass ratio `mu`: tuning
    /// `1/(1 + mu)` and damping `sqrt(3 mu/(8 (1 + mu)^3))` of the oscillator's critical one, so
    /// `sqrt(3 mu/(8 (1 + mu)))` of its own, make the two fixed points of the response of an undamped
    /// oscillator driven by a force equally high.
    pub fn den_hartog(mass_ratio: f64) -> Self {
        let total = 1.0 + mass_ratio;
        Self { tuning: 1.0 / total, damping_ratio: (3.0 * mass_ratio / (8.0 * total)).sqrt() }
    }

    /// The one of the absorber's mass whose largest amplitude along a band is smallest, with the damping of
    /// the structure and the kind of its excitation. For a single excitation that of Den Hartog: the best
    /// for one frequency alone would be undamped and of no use beside it.
    pub fn designed(band: &Band) -> Self {
        let start = Self::den_hartog(band.base.mass_ratio());
        if band.is_point() {
            return start;
        }
        let mut best = start.logarithms();
        for _ in 0..RESTARTS {
            let mut simplex = vec![best.clone(); 3];
            simplex[1][0] += SIMPLEX[0];
            simplex[2][1] += SIMPLEX[1];
            let solver = NelderMead::new(simplex);
            let run = Executor::new(Design(band), solver)
                .configure(|state| state.max_iters(STEPS))
                .timer(false)
                .run();
            let found = run.ok().and_then(|run| run.state().get_best_param().cloned());
            best = found.unwrap_or(best);
        }
        Self::of_logarithms(&best)
    }

    fn logarithms(&self) -> Vec<f64> {
        vec![libm::log(self.tuning), libm::log(self.damping_ratio)]
    }

    fn of_logarithms(logarithms: &[f64]) -> Self {
        Self { tuning: libm::exp(logarithms[0]), damping_ratio: libm::exp(logarithms[1]) }
    }

    /// The same damper on a structure whose natural frequency is `factor` times as high.
    fn on_detuned(&self, factor: f64) -> Self {
        Self { tuning: self.tuning / factor, ..*self }
    }

    /// Amplitudes of the oscillator that carries it instead of the absorber, and of its own motion against
    /// the oscillator, the stroke; over the system's clearance, infinite where nothing limits them.
    pub fn amplitudes(&self, system: &System) -> [f64; 2] {
        let omega = system.frequency_ratio();
        let mu = system.mass_ratio();
        let (sine, cosine) = system.excitation_amplitudes();
        // What the damper's mass does to the oscillator, as a dynamic mass.
        let spring = self.tuning * self.tuning;
        let coupling = Complex::new(spring, 2.0 * self.damping_ratio * self.tuning * omega);
        let against = coupling - omega * omega;
        let loss = mu * system.damping() * omega;
        let stiffness =
            Complex::new(1.0 - omega * omega, loss) - omega * omega * mu * coupling / against;
        let amplitude = libm::hypot(sine, cosine) / libm::hypot(stiffness.re, stiffness.im);
        let relative = omega * omega / libm::hypot(against.re, against.im);
        [amplitude, amplitude * relative].map(|one| if one.is_nan() { f64::INFINITY } else { one })
    }
}

/// The largest amplitude along a band as a function of the damper's logarithms.
struct Design<'a>(&'a Band);

impl CostFunction for Design<'_> {
    type Param = Vec<f64>;
    type Output = f64;
    fn cost(&self, logarithms: &Vec<f64>) -> Result<f64, Error> {
        let damper = TunedMassDamper::of_logarithms(logarithms);
        Ok(largest_along(self.0, |system| damper.amplitudes(system)[0]).1)
    }
}

/// Amplitude of the oscillator alone, over the system's clearance; infinite where nothing limits it.
pub fn bare_amplitude(system: &System) -> f64 {
    system.linear_response().map_or(f64::INFINITY, |response| response.amplitude())
}

/// Pieces of a band in which a rival's largest amplitude is looked for: a resonance has a few hundredths
/// of its frequency as width.
const PIECES: u32 = 256;

/// By how much the structure's natural frequency may be off, to either side, where a tuned device is
/// compared with one that is not.
pub const DETUNED: [f64; 2] = [0.97, 1.03];

/// What can be done without the absorber. Lengths over the clearance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rivals {
    /// Largest amplitude of the bare oscillator, and where; infinite where nothing limits it.
    pub bare: (f64, f64),
    /// The tuned mass damper of the same mass that is best along the band.
    pub damper: TunedMassDamper,
    /// Its largest amplitude and stroke.
    pub damped: Damped,
    /// The same where the structure's natural frequency is off by [`DETUNED`] and the damper as designed.
    pub detuned: [Damped; 2],
}

/// The largest values along a band of a structure with a tuned mass damper, over the clearance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Damped {
    /// Amplitude of the structure.
    pub amplitude: f64,
    /// Where.
    pub at: f64,
    /// Displacement of the damper's mass against the structure.
    pub stroke: f64,
}

impl Rivals {
    /// Those along a band.
    pub fn along(band: &Band) -> Self {
        let damper = TunedMassDamper::designed(band);
        let damped = |band: &Band, damper: TunedMassDamper| {
            let (at, amplitude) = largest_along(band, |system| damper.amplitudes(system)[0]);
            let (_, stroke) = largest_along(band, |system| damper.amplitudes(system)[1]);
            Damped { amplitude, at, stroke }
        };
        Self {
            bare: largest_along(band, bare_amplitude),
            damper,
            damped: damped(band, damper),
            detuned: DETUNED.map(|factor| match band.with_structure_detuned(factor) {
                Some(band) => damped(&band, damper.on_detuned(factor)),
                None => Damped { amplitude: f64::NAN, at: f64::NAN, stroke: f64::NAN },
            }),
        }
    }
}

/// Where along a band an amplitude is largest, and that amplitude.
fn largest_along(band: &Band, amplitude: impl Fn(&System) -> f64) -> (f64, f64) {
    let there = |at: f64| band.system(at).ok().map(|system| amplitude(&system));
    let found = largest(band.range, PIECES, there).unwrap_or((band.range[0], f64::INFINITY));
    // The peak of a hardly damped oscillator is narrower than a piece.
    let [from, to] = band.range;
    let resonates = band.over == BandOver::Frequency && from <= 1.0 && 1.0 <= to;
    match there(1.0).filter(|resonant| resonates && *resonant > found.1) {
        Some(resonant) => (1.0, resonant),
        None => found,
    }
}

/// Reduction in decibels of an amplitude against another: positive where it is smaller.
pub fn reduction_db(amplitude: f64, against: f64) -> f64 {
    20.0 * libm::log10(against / amplitude)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::{Excitation, Parameters};

    fn system(mass_ratio: f64, zeta: f64, excitation: Excitation) -> System {
        System::new(Parameters {
            mass_ratio,
            damping: 2.0 * zeta / mass_ratio,
            restitution: 0.6,
            frequency_ratio: 1.0,
            // A static displacement of 1: eps gamma = 1.
            forcing_per_clearance: 1.0 / mass_ratio,
            excitation,
        })
        .expect("valid")
    }

    fn around_resonance(base: System) -> Band {
        Band { base, over: BandOver::Frequency, range: [0.7, 1.3], spectrum: Vec::new() }
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
                    let [amplitude, _] = other.amplitudes(&there);
                    assert!((amplitude / height - 1.0).abs() < 1e-12, "{mu} {sign} {factor}");
                }
            }
        }
    }

    /// Nishihara and Asami (2002) give the exact optimum of an undamped oscillator in closed form; its
    /// height is Den Hartog's to a few thousandths, its damping ratio
    /// `sqrt((8 + 9 mu - 4 sqrt(4 + 3 mu))/(1 + mu))/4`. The simplex ends where the peaks differ by 1e-3, which
    /// leaves the damping 2 %.
    #[test]
    fn the_design_of_an_undamped_oscillator_is_den_hartogs_but_for_what_he_neglects() {
        for mu in [0.005, 0.02, 0.08] {
            let rivals = Rivals::along(&around_resonance(system(mu, 0.0, Excitation::Force)));
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
    fn no_neighbour_of_the_design_is_better_and_detuning_costs_what_it_costs() {
        for (mu, zeta, excitation) in
            [(0.015, 0.004, Excitation::Force), (0.01, 0.02, Excitation::BaseDisplacement)]
        {
            let band = around_resonance(system(mu, zeta, excitation));
            let Rivals { damper, damped, detuned, .. } = Rivals::along(&band);
            for (tuning, damping) in
                [(0.99, 1.0), (1.01, 1.0), (1.0, 0.9), (1.0, 1.1), (0.995, 1.05)]
            {
                let other = TunedMassDamper {
                    tuning: tuning * damper.tuning,
                    damping_ratio: damping * damper.damping_ratio,
                };
                let (_, height) = largest_along(&band, |system| other.amplitudes(system)[0]);
                assert!(height > damped.amplitude, "{mu} {tuning} {damping}");
            }
            // A damper off by 3 % on the same structure, in the structure's own units.
            for (factor, off) in DETUNED.into_iter().zip(detuned) {
                let other = TunedMassDamper { tuning: damper.tuning / factor, ..damper };
                let (_, height) = largest_along(&band, |system| other.amplitudes(system)[0]);
                let scale = if excitation == Excitation::Force { factor * factor } else { 1.0 };
                // The damping ratio of the structure changes with its frequency, by 3 %.
                assert!((off.amplitude * scale / height - 1.0).abs() < 0.03, "{mu} {factor}");
                assert!(off.amplitude > damped.amplitude);
            }
        }
    }

    #[test]
    fn half_the_amplitude_is_six_decibels() {
        assert!((reduction_db(0.5, 1.0) - 6.020_599_913_279_624).abs() < 1e-12);
    }
}
