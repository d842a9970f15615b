//! A structure that carries some of its absorbers with it, as where their clearances are small against its motion: in closed form.
//!
//! With the set `C` of those that it carries the modes `q` are those of the mass matrix `M + sum_C m_j phi_j phi_j^T`:
//! `M_k (w_k^2 - Omega^2 + 2 i zeta_k w_k Omega) q_k - Omega^2 sum_C m_j phi_kj X_j = M_k f_k`, `X_j = x_0 + sum_k phi_kj q_k`. Its
//! resonances lie lower than without absorbers, where the structure alone hardly moves.

use nalgebra::{Complex, DMatrix, DVector};

use crate::system::{ModalState, ModalSystem};

/// The state at phase 0 of its steady motion, in which the others are in the middle of their cavities; none where there is no such motion. Displacements
/// and velocities of the modes, and of the absorbers.
pub fn carried_state(system: &ModalSystem, carried: &[usize]) -> Option<ModalState> {
    let omega = system.frequency_ratio();
    let modes = system.modes();
    let shape = |k: usize, j: usize| modes[k].shape[j];
    let mass = |j: usize| system.absorbers()[j].mass;
    let matrix = DMatrix::from_fn(modes.len(), modes.len(), |k, l| {
        let added: f64 = carried.iter().map(|j| mass(*j) * shape(k, *j) * shape(l, *j)).sum();
        let own = &modes[k];
        let free = Complex::new(
            (own.frequency - omega) * (own.frequency + omega),
            2.0 * own.damping_ratio * own.frequency * omega,
        );
        let own = if k == l { free * own.mass } else { Complex::from(0.0) };
        own - omega * omega * added
    });
    let by_base = omega * omega * system.base_amplitude();
    let forces = DVector::from_fn(modes.len(), |k, _| {
        let of_carried: f64 = carried.iter().map(|j| mass(*j) * shape(k, *j)).sum();
        Complex::from(modes[k].mass * system.modal_forcing(k) + by_base * of_carried)
    });
    let solved = matrix.lu().solve(&forces)?;
    let mut state = ModalState::AT_REST;
    for (own, q) in state.modes.iter_mut().zip(solved.iter()) {
        *own = [q.im, omega * q.re];
    }
    for j in 0..system.absorbers().len() {
        let [place, velocity] = system.displaced(j, &state);
        state.absorbers[j] = [place, if carried.contains(&j) { velocity } else { 0.0 }];
    }
    let finite = state.modes.iter().flatten().all(|one| one.is_finite());
    finite.then_some(state)
}

/// Natural frequencies of a structure that carries all of its absorbers, over that of reference, ascending.
pub fn carried_frequencies(system: &ModalSystem) -> Vec<f64> {
    let modes = system.modes();
    // Of `q = K^-1/2 p` the mass matrix is `K^-1/2 M K^-1/2`, and the stiffness one.
    let root = |k: usize| modes[k].frequency * modes[k].mass.sqrt();
    let matrix = DMatrix::from_fn(modes.len(), modes.len(), |k, l| {
        let absorbers = system.absorbers().iter().enumerate();
        let added = absorbers.map(|(j, one)| one.mass * modes[k].shape[j] * modes[l].shape[j]);
        let own = if k == l { modes[k].mass } else { 0.0 };
        (own + added.sum::<f64>()) / (root(k) * root(l))
    });
    let mut all: Vec<f64> =
        matrix.symmetric_eigenvalues().iter().map(|one| 1.0 / one.sqrt()).collect();
    all.sort_by(f64::total_cmp);
    all
}
