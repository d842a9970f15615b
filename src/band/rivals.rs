//! What else could be done: nothing, or a tuned mass damper of the same mass.

use argmin::core::{CostFunction, Error, Executor, State as _};
use argmin::solver::neldermead::NelderMead;
use nalgebra::Complex;
use serde::Serialize;

use super::Band;
use crate::numerics::scan::{largest_of, narrow, places};
use crate::system::{BandOver, System};

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
    fn designed(along: &Along) -> Self {
        let start = Self::den_hartog(along.band.base.mass_ratio());
        if along.band.is_point() {
            return start;
        }
        let mut best = start.logarithms();
        for _ in 0..RESTARTS {
            let mut simplex = vec![best.clone(); 3];
            simplex[1][0] += SIMPLEX[0];
            simplex[2][1] += SIMPLEX[1];
            let solver = NelderMead::new(simplex);
            let run = Executor::new(along, solver)
                .configure(|state| state.max_iters(STEPS))
                .timer(false)
                .run();
            let found = run.ok().and_then(|run| run.state().get_best_param().cloned());
            best = found.unwrap_or(best);
        }
        Self::of_logarithms(&best)
    }

    /// What it comes to along a band.
    pub fn along(self, band: &Band) -> Damped {
        Along::of(band).damped(self)
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

impl CostFunction for &Along<'_> {
    type Param = Vec<f64>;
    type Output = f64;
    fn cost(&self, logarithms: &Vec<f64>) -> Result<f64, Error> {
        let damper = TunedMassDamper::of_logarithms(logarithms);
        Ok(self.largest(|system| damper.amplitude(system)).1)
    }
}

/// Amplitude of the oscillator alone, over the system's clearance; infinite where nothing limits it.
pub fn bare_amplitude(system: &System) -> f64 {
    system.linear_response().map_or(f64::INFINITY, |response| response.amplitude())
}

/// Pieces of a band in which a rival's largest amplitude is looked for: a resonance has a few hundredths
/// of its frequency as width.
const PIECES: u32 = 256;

/// Part of the highest value from which on a peak is looked at as well.
const ALMOST: f64 = 0.9;
/// Relative difference up to which two largest values are one: some roundings.
const SAME: f64 = 4e-15;
/// Ratio of distances of places around a narrow resonance, down to this part of its width; no resonance is narrower than
/// the last.
const CLOSER: f64 = 0.5;
const PART_OF_WIDTH: f64 = 0.25;
const NARROWEST: f64 = 1e-14;

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

/// Where the structure alone moves farthest along a band, and how far.
pub fn bare_along(band: &Band) -> (f64, f64) {
    Along::of(band).largest(bare_amplitude)
}

impl Rivals {
    /// Those along a band.
    pub fn along(band: &Band) -> Self {
        let along = Along::of(band);
        let damper = TunedMassDamper::designed(&along);
        Self {
            bare: along.largest(bare_amplitude),
            damper,
            damped: along.damped(damper),
            detuned: DETUNED.map(|factor| match band.with_structure_detuned(factor) {
                Some(band) => Along::of(&band).damped(damper.on_detuned(factor)),
                None => Damped { amplitude: f64::NAN, at: f64::NAN, stroke: f64::NAN },
            }),
        }
    }
}

/// Places around a resonance that is narrower than a piece of the band, ever closer ones down to its width; none in other
/// bands.
fn near_resonance(band: &Band) -> Vec<f64> {
    let [from, to] = band.range;
    let (piece, system) = ((to - from) / f64::from(PIECES), &band.base);
    if band.over != BandOver::Frequency || !(from <= 1.0 && 1.0 <= to) {
        return Vec::new();
    }
    // A damper's two resonances are the square root of its mass apart.
    let damping = system.mass_ratio() * system.damping();
    let width = damping.min(system.mass_ratio().sqrt()).max(NARROWEST);
    let mut found = Vec::new();
    let mut distance = piece;
    while distance > PART_OF_WIDTH * width {
        distance *= CLOSER;
        found.extend([1.0 - distance, 1.0 + distance]);
    }
    found.retain(|at| (from..=to).contains(at));
    found
}

/// A band with its systems at even places, at which many amplitudes are asked for.
struct Along<'a> {
    band: &'a Band,
    systems: Vec<(f64, System)>,
}

impl<'a> Along<'a> {
    fn of(band: &'a Band) -> Self {
        let system = |at: f64| Some((at, band.system(at).ok()?));
        let mut all: Vec<f64> = places(band.range, PIECES).collect();
        all.extend(near_resonance(band));
        all.sort_by(f64::total_cmp);
        Self { band, systems: all.into_iter().filter_map(system).collect() }
    }

    /// Where an amplitude is largest, and that amplitude.
    fn largest(&self, amplitude: impl Fn(&System) -> f64) -> (f64, f64) {
        let there = |at: f64| self.band.system(at).ok().map(|system| amplitude(&system));
        let [from, to] = self.band.range;
        let tried = self.systems.iter().map(|(at, system)| (*at, amplitude(system)));
        let tried: Vec<(f64, f64)> = tried.collect();
        let all = tried.iter().copied();
        let found = largest_of(all, [from, to], PIECES, there).unwrap_or((from, f64::INFINITY));
        let resonates = self.band.over == BandOver::Frequency && from <= 1.0 && 1.0 <= to;
        let mut best = match there(1.0).filter(|resonant| resonates && *resonant > found.1) {
            Some(resonant) => (1.0, resonant),
            None => found,
        };
        // Of peaks that are almost as high, as the two of a damper, another may be the higher one in truth; and one among close
        // places is narrower than a piece.
        let highest = tried.iter().map(|(_, value)| *value).fold(0.0, f64::max);
        for three in tried.windows(3).filter(|_| !self.band.is_point()) {
            let [(before, left), (_, middle), (after, right)] = [three[0], three[1], three[2]];
            if middle < left || middle < right || !middle.is_finite() || middle < ALMOST * highest {
                continue;
            }
            narrow([before, after], |at| {
                let value = there(at).unwrap_or(f64::NEG_INFINITY);
                if value > best.1 * (1.0 + SAME) {
                    best = (at, value);
                }
                Some(value)
            });
        }
        best
    }

    fn damped(&self, damper: TunedMassDamper) -> Damped {
        let (at, amplitude) = self.largest(|system| damper.amplitude(system));
        let (_, stroke) = self.largest(|system| damper.stroke(system));
        Damped { amplitude, at, stroke }
    }
}

/// Reduction in decibels of an amplitude against another: positive where it is smaller.
pub fn reduction_db(amplitude: f64, against: f64) -> f64 {
    20.0 * libm::log10(against / amplitude)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::{Cavity, Excitation, Parameters};

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
                let (_, height) = Along::of(&band).largest(|system| other.amplitude(system));
                assert!(height > damped.amplitude, "{mu} {tuning} {damping}");
            }
            // A damper off by 3 % on the same structure, in the structure's own units.
            for (factor, off) in DETUNED.into_iter().zip(detuned) {
                let other = TunedMassDamper { tuning: damper.tuning / factor, ..damper };
                let (_, height) = Along::of(&band).largest(|system| other.amplitude(system));
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
