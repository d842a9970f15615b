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
        let omega = system.frequency_ratio();
        let base = Complex::from(system.base_amplitude());
        let inverse: Vec<Complex<f64>> = system
            .modes()
            .iter()
            .map(|mode| {
                let stiffness = (mode.frequency - omega) * (mode.frequency + omega);
                let loss = 2.0 * mode.damping_ratio * mode.frequency * omega;
                Complex::new(stiffness, loss).inv()
            })
            .collect();
        let free = |shape: &[f64]| {
            let each = shape.iter().zip(&inverse).enumerate();
            let sum: Complex<f64> =
                each.map(|(k, (phi, of))| of * phi * system.modal_forcing(k)).sum();
            base + sum
        };
        let receptance = |here: &[f64], there: &[f64]| -> Complex<f64> {
            let each = system.modes().iter().zip(&inverse).zip(here.iter().zip(there));
            each.map(|((mode, of), (a, b))| of * (a * b / mode.mass)).sum()
        };
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
            own - receptance(&dampers[d].shape, &dampers[e].shape) * pushes[e]
        });
        let alone = DVector::from_fn(count, |d, _| free(&dampers[d].shape));
        let solve = || matrix.lu().solve(&alone);
        let moved = if count == 0 { Some(DVector::zeros(0)) } else { solve() };
        let moved = moved.unwrap_or_else(|| DVector::repeat(count, Complex::from(f64::NAN)));
        let amplitude = |value: Complex<f64>| libm::hypot(value.re, value.im);
        let at = |shape: &Vec<f64>| {
            let of_dampers =
                (0..count).map(|e| receptance(shape, &dampers[e].shape) * pushes[e] * moved[e]);
            amplitude(free(shape) + of_dampers.sum::<Complex<f64>>())
        };
        Self {
            places: places.iter().map(at).collect(),
            strokes: dampers
                .iter()
                .zip(moved.iter())
                .map(|(of, x)| amplitude(stroke(of) * x))
                .collect(),
        }
    }
}
