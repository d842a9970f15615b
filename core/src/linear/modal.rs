//! A structure of several modes without absorbers, alone or with tuned mass dampers, in closed form.
//!
//! A damper of mass `m`, stiffness `k = m w^2` and damping `c = 2 m zeta w` at a place that moves by `X e^{i Omega tau}` pushes
//! it with `K X`, `K = m Omega^2 (k + i c Omega)/(k + i c Omega - m Omega^2)`, and strokes by `m Omega^2 X/(k + i c Omega -
//! m Omega^2)` against it; so the places of the dampers move by the solution of `X_d = X0_d + sum_e H_de K_e X_e` with the
//! receptances `H_de = sum_k phi_kd phi_ke/(M_k (w_k^2 - Omega^2 + 2 i zeta_k w_k Omega))`.

use nalgebra::{Complex, DMatrix, DVector};

use crate::system::ModalSystem;

/// A tuned mass damper at a place of a structure of several modes.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalDamper {
    /// Its mass.
    pub mass: f64,
    /// Its own frequency over that of reference.
    pub frequency: f64,
    /// Its own damping ratio.
    pub damping_ratio: f64,
    /// Value of each mode's shape at its place.
    pub shape: Vec<f64>,
}

/// Natural frequencies of a structure with dampers, without any damping, over that of reference; of each mode its natural frequency
/// and mass. Ascending: where damping is small resonances are there.
///
/// ```
/// use vinesink_core::linear::{ModalDamper, frequencies_with};
///
/// // Den Hartog, Mechanical Vibrations, eq. 3.25: of a damper as tuned as the structure g^2 = 1 + mu/2 ± (mu + mu^2/4)^(1/2).
/// let damper = ModalDamper { mass: 0.1, frequency: 1.0, damping_ratio: 0.2, shape: vec![1.0] };
/// let found = frequencies_with(&[[1.0, 1.0]], &[damper]);
/// let root = 0.1025_f64.sqrt();
/// assert!((found[0].powi(2) - 1.05 + root).abs() < 1e-12 && (found[1].powi(2) - 1.05 - root).abs() < 1e-12);
/// ```
pub fn frequencies_with(modes: &[[f64; 2]], dampers: &[ModalDamper]) -> Vec<f64> {
    let count = modes.len();
    // Of coordinates over the root of their mass the mass matrix is one.
    let coupled = |k: usize, of: &ModalDamper| -of.shape[k] * (of.mass / modes[k][1]).sqrt();
    let stiffness = DMatrix::from_fn(count + dampers.len(), count + dampers.len(), |a, b| {
        let square = |of: &ModalDamper| of.frequency * of.frequency;
        match (a.checked_sub(count), b.checked_sub(count)) {
            (None, None) => {
                let own = if a == b { modes[a][0] * modes[a][0] } else { 0.0 };
                let added = dampers.iter().map(|of| square(of) * coupled(a, of) * coupled(b, of));
                own + added.sum::<f64>()
            }
            (None, Some(d)) => square(&dampers[d]) * coupled(a, &dampers[d]),
            (Some(d), None) => square(&dampers[d]) * coupled(b, &dampers[d]),
            (Some(d), Some(e)) => {
                if d == e {
                    square(&dampers[d])
                } else {
                    0.0
                }
            }
        }
    });
    let squares = stiffness.symmetric_eigenvalues();
    let mut all: Vec<f64> = squares.iter().map(|one| one.max(0.0).sqrt()).collect();
    all.sort_by(f64::total_cmp);
    all
}

/// Amplitudes of steady harmonic motion.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalAmplitudes {
    /// Of each place that was asked for.
    pub places: Vec<f64>,
    /// Of each damper against its place.
    pub strokes: Vec<f64>,
}

impl ModalAmplitudes {
    /// Those at places with these values of each mode, without absorbers and with these dampers; not a number where the
    /// dampers have no steady motion.
    pub fn of(system: &ModalSystem, dampers: &[ModalDamper], places: &[Vec<f64>]) -> Self {
        ModalResponse::of(system, places).with(dampers)
    }
}

/// Steady harmonic motion of a structure without absorbers at one frequency, which dampers change.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalResponse {
    omega: f64,
    base: f64,
    /// Of each mode its displacement under a modal force of 1 over modal mass, that of its own force, and its mass.
    modes: Vec<(Complex<f64>, Complex<f64>, f64)>,
    /// Values of each mode at places, and the displacement there.
    places: Vec<(Vec<f64>, Complex<f64>)>,
}

impl ModalResponse {
    /// That at places with these values of each mode.
    pub fn of(system: &ModalSystem, places: &[Vec<f64>]) -> Self {
        let omega = system.frequency_ratio();
        let modes = system.modes().iter().enumerate().map(|(k, mode)| {
            let stiffness = (mode.frequency - omega) * (mode.frequency + omega);
            let loss = 2.0 * mode.damping_ratio * mode.frequency * omega;
            let inverse = Complex::new(stiffness, loss).inv();
            (inverse, inverse * system.modal_forcing(k), mode.mass)
        });
        let (modes, base) = (modes.collect(), system.base_amplitude());
        let mut response = Self { omega, base, modes, places: Vec::new() };
        let places = places.iter().map(|shape| (shape.clone(), response.free(shape)));
        response.places = places.collect();
        response
    }

    /// Displacement at a place with these values of each mode.
    fn free(&self, shape: &[f64]) -> Complex<f64> {
        let each = shape.iter().zip(&self.modes);
        each.fold(Complex::from(self.base), |sum, (phi, (_, own, _))| sum + own * phi)
    }

    /// Displacement at one place under a force of 1 at another.
    fn receptance(&self, here: &[f64], there: &[f64]) -> Complex<f64> {
        let each = self.modes.iter().zip(here.iter().zip(there));
        each.map(|((of, _, mass), (a, b))| of * (a * b / mass)).sum()
    }

    /// Amplitudes with these dampers; not a number where they have no steady motion.
    pub fn with(&self, dampers: &[ModalDamper]) -> ModalAmplitudes {
        let shapes = |d: usize| dampers[d].shape.as_slice();
        solved(
            self.omega,
            dampers,
            |d, e| self.receptance(shapes(d), shapes(e)),
            |d| self.free(shapes(d)),
            self.places.iter().map(|(shape, free)| {
                (*free, move |e: usize| self.receptance(shape, &dampers[e].shape))
            }),
        )
    }

    /// The same as dampers at some of its places see it, by the numbers of these places.
    pub fn seen_from(&self, sites: &[usize]) -> PlacedResponse {
        let under = |site: &usize| {
            let there = &self.places[*site].0;
            let each = self.places.iter().map(|(here, _)| self.receptance(here, there));
            (*site, each.collect())
        };
        PlacedResponse {
            omega: self.omega,
            free: self.places.iter().map(|(_, free)| *free).collect(),
            under: sites.iter().map(under).collect(),
        }
    }
}

/// A structure without absorbers at one frequency, and how each of its places moves under a force at some of them: all that dampers
/// there need of it, however they are tuned.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedResponse {
    omega: f64,
    free: Vec<Complex<f64>>,
    /// Displacement of each place under a force of 1 at one of them.
    under: Vec<(usize, Vec<Complex<f64>>)>,
}

impl PlacedResponse {
    /// Amplitudes with dampers at these places, to the bit those of [`ModalResponse::with`]; none where one is somewhere else.
    pub fn with(&self, dampers: &[ModalDamper], places: &[usize]) -> Option<ModalAmplitudes> {
        let under = places.iter().map(|place| {
            let found = self.under.iter().find(|(site, _)| site == place);
            found.map(|(_, each)| each.as_slice())
        });
        let under: Vec<&[Complex<f64>]> = under.collect::<Option<_>>()?;
        Some(solved(
            self.omega,
            dampers,
            |d, e| under[e][places[d]],
            |d| self.free[places[d]],
            self.free.iter().enumerate().map(|(p, free)| {
                let under = &under;
                (*free, move |e: usize| under[e][p])
            }),
        ))
    }
}

/// Amplitudes of places and strokes of dampers at a frequency: by the displacement of the place of one under a force at that of another,
/// that of each without dampers, and both of every place.
fn solved<T: Fn(usize) -> Complex<f64>>(
    omega: f64,
    dampers: &[ModalDamper],
    between: impl Fn(usize, usize) -> Complex<f64>,
    alone: impl Fn(usize) -> Complex<f64>,
    places: impl Iterator<Item = (Complex<f64>, T)>,
) -> ModalAmplitudes {
    let stiffness = |of: &ModalDamper| {
        let own = of.mass * of.frequency * of.frequency;
        Complex::new(own, 2.0 * of.mass * of.damping_ratio * of.frequency * omega)
    };
    // Stroke over the motion of its place.
    let stroke = |of: &ModalDamper| {
        let inertia = of.mass * omega * omega;
        Complex::from(inertia) / (stiffness(of) - inertia)
    };
    let strokes: Vec<Complex<f64>> = dampers.iter().map(stroke).collect();
    let pushes = dampers.iter().zip(&strokes).map(|(of, stroke)| stroke * stiffness(of));
    let pushes: Vec<Complex<f64>> = pushes.collect();
    let count = dampers.len();
    let matrix = DMatrix::from_fn(count, count, |d, e| {
        let own = Complex::from(f64::from(u8::from(d == e)));
        own - between(d, e) * pushes[e]
    });
    let alone = DVector::from_fn(count, |d, _| alone(d));
    let moved = if count == 0 { Some(DVector::zeros(0)) } else { matrix.lu().solve(&alone) };
    let moved = moved.unwrap_or_else(|| DVector::repeat(count, Complex::from(f64::NAN)));
    let amplitude = |value: Complex<f64>| libm::hypot(value.re, value.im);
    let at = |(free, under): (Complex<f64>, T)| {
        let of_dampers = (0..count).map(|e| under(e) * pushes[e] * moved[e]);
        amplitude(free + of_dampers.sum::<Complex<f64>>())
    };
    let of_damper = |(stroke, x): (&Complex<f64>, &Complex<f64>)| amplitude(stroke * x);
    ModalAmplitudes {
        places: places.map(at).collect(),
        strokes: strokes.iter().zip(moved.iter()).map(of_damper).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::{ModalAbsorber, ModalParameters, Mode};

    /// What is put together beforehand is what is solved for at once, bit by bit; a damper elsewhere was not seen.
    #[test]
    fn what_dampers_see_is_the_response() {
        let shapes = [[1.0, -0.4], [0.3, 1.0], [-0.2, 0.7]];
        let mode = |frequency: f64, k: usize| Mode {
            frequency,
            damping_ratio: 0.01,
            mass: 3.0,
            forcing: 0.2,
            participation: 0.4,
            shape: vec![shapes[0][k]],
        };
        let absorber = ModalAbsorber { mass: 0.1, clearance: 1.0, restitution: 0.5 };
        for frequency_ratio in [0.97, 2.31] {
            let parameters = ModalParameters {
                modes: vec![mode(1.0, 0), mode(2.3, 1)],
                absorbers: vec![absorber],
                frequency_ratio,
                base_amplitude: 0.3,
            };
            let system = ModalSystem::new(parameters).expect("valid");
            let response = ModalResponse::of(&system, &shapes.map(Vec::from));
            let seen = response.seen_from(&[0, 2]);
            let damper = |place: usize, frequency: f64| ModalDamper {
                mass: 0.1,
                frequency,
                damping_ratio: 0.1,
                shape: shapes[place].to_vec(),
            };
            let both = [damper(2, 0.98), damper(0, 2.2)];
            assert_eq!(seen.with(&both, &[2, 0]), Some(response.with(&both)));
            assert_eq!(seen.with(&both[..1], &[2]), Some(response.with(&both[..1])));
            assert_eq!(seen.with(&[], &[]), Some(response.with(&[])));
            assert_eq!(seen.with(&[damper(1, 1.0)], &[1]), None);
        }
    }
}
