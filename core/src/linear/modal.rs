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
        let omega = self.omega;
        let stiffness = |of: &ModalDamper| {
            let own = of.mass * of.frequency * of.frequency;
            Complex::new(own, 2.0 * of.mass * of.damping_ratio * of.frequency * omega)
        };
        // Stroke over the motion of its place.
        let stroke = |of: &ModalDamper| {
            let inertia = of.mass * omega * omega;
            Complex::from(inertia) / (stiffness(of) - inertia)
        };
        let pushes: Vec<Complex<f64>> =
            dampers.iter().map(|of| stroke(of) * stiffness(of)).collect();
        let count = dampers.len();
        let matrix = DMatrix::from_fn(count, count, |d, e| {
            let own = Complex::from(f64::from(u8::from(d == e)));
            own - self.receptance(&dampers[d].shape, &dampers[e].shape) * pushes[e]
        });
        let alone = DVector::from_fn(count, |d, _| self.free(&dampers[d].shape));
        let solve = || matrix.lu().solve(&alone);
        let moved = if count == 0 { Some(DVector::zeros(0)) } else { solve() };
        let moved = moved.unwrap_or_else(|| DVector::repeat(count, Complex::from(f64::NAN)));
        let amplitude = |value: Complex<f64>| libm::hypot(value.re, value.im);
        let at = |(shape, free): &(Vec<f64>, Complex<f64>)| {
            let of_dampers = (0..count)
                .map(|e| self.receptance(shape, &dampers[e].shape) * pushes[e] * moved[e]);
            amplitude(free + of_dampers.sum::<Complex<f64>>())
        };
        ModalAmplitudes {
            places: self.places.iter().map(at).collect(),
            strokes: dampers
                .iter()
                .zip(moved.iter())
                .map(|(of, x)| amplitude(stroke(of) * x))
                .collect(),
        }
    }
}
