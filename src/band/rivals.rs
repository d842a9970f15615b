//! What else could be done along a band: nothing, or a tuned mass damper of the same mass, with the best design of it.

use argmin::core::{CostFunction, Error, Executor, State as _};
use argmin::solver::neldermead::NelderMead;

use super::Band;
use crate::linear::{BandSystems, Damped, TunedMassDamper, bare_amplitude};

/// Size of the first simplex of a design, in the logarithms of tuning and damping ratio.
const SIMPLEX: [f64; 2] = [0.02, 0.3];
/// Steps of a simplex, and how often it begins again where it ended: the largest of two resonances has
/// a kink where they are equal, at which a simplex may collapse early.
const STEPS: u64 = 120;
const RESTARTS: u32 = 3;

/// The damper of the absorber's mass whose largest amplitude along a band is smallest, with the damping of
/// the structure and the kind of its excitation. For a single excitation that of Den Hartog: the best
/// for one frequency alone would be undamped and of no use beside it.
fn designed(along: &BandSystems) -> TunedMassDamper {
    let start = TunedMassDamper::den_hartog(along.band.base.mass_ratio());
    if along.band.is_point() {
        return start;
    }
    let mut best = vec![libm::log(start.tuning), libm::log(start.damping_ratio)];
    for _ in 0..RESTARTS {
        let mut simplex = vec![best.clone(); 3];
        simplex[1][0] += SIMPLEX[0];
        simplex[2][1] += SIMPLEX[1];
        let solver = NelderMead::new(simplex);
        let run = Executor::new(LargestAmplitude(along), solver)
            .configure(|state| state.max_iters(STEPS))
            .timer(false)
            .run();
        let found = run.ok().and_then(|run| run.state().get_best_param().cloned());
        best = found.unwrap_or(best);
    }
    of_logarithms(&best)
}

/// A damper of the logarithms of its tuning and damping ratio.
fn of_logarithms(logarithms: &[f64]) -> TunedMassDamper {
    TunedMassDamper { tuning: libm::exp(logarithms[0]), damping_ratio: libm::exp(logarithms[1]) }
}

/// What the simplex makes small: the largest amplitude along a band.
struct LargestAmplitude<'a>(&'a BandSystems<'a>);

impl CostFunction for LargestAmplitude<'_> {
    type Param = Vec<f64>;
    type Output = f64;
    fn cost(&self, logarithms: &Vec<f64>) -> Result<f64, Error> {
        let damper = of_logarithms(logarithms);
        Ok(self.0.largest(|system| damper.amplitude(system)).1)
    }
}

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

impl Rivals {
    /// Those along a band.
    pub fn along(band: &Band) -> Self {
        let along = BandSystems::of(band);
        let damper = designed(&along);
        Self {
            bare: along.largest(bare_amplitude),
            damper,
            damped: along.damped(damper),
            detuned: DETUNED.map(|factor| match band.with_structure_detuned(factor) {
                Some(band) => BandSystems::of(&band).damped(damper.on_detuned(factor)),
                None => Damped { amplitude: f64::NAN, at: f64::NAN, stroke: f64::NAN },
            }),
        }
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
                let (_, height) = BandSystems::of(&band).largest(|system| other.amplitude(system));
                assert!(height > damped.amplitude, "{mu} {tuning} {damping}");
            }
            // A damper off by 3 % on the same structure, in the structure's own units.
            for (factor, off) in DETUNED.into_iter().zip(detuned) {
                let other = TunedMassDamper { tuning: damper.tuning / factor, ..damper };
                let (_, height) = BandSystems::of(&band).largest(|system| other.amplitude(system));
                let scale = if excitation == Excitation::Force { factor * factor } else { 1.0 };
                // The damping ratio of the structure changes with its frequency, by 3 %.
                assert!((off.amplitude * scale / height - 1.0).abs() < 0.03, "{mu} {factor}");
                assert!(off.amplitude > damped.amplitude);
            }
        }
    }
}
