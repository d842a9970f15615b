//! The paper's equations and what follows from them, each written once: analysis evaluates them, reports
//! print them.
//!
//! Results hold at first order in the mass ratio, near 1:1 resonance, for two symmetric impacts per cycle.
//! What follows from the paper is derived in each file's head, and `tests/physics/equations.rs` proves it against
//! the paper's equations. `orbits::equations` of `vinesink-core` holds such motions exactly, at any mass ratio and
//! frequency.
//!
//! For the program itself: this module may change at any time.

#![allow(non_snake_case)]

pub mod cavity;
pub mod dissipation;
pub mod fixed_points;
pub mod free_decay;
pub mod manifold;
pub mod slow_flow;
pub mod stated;

use crate::symbolic::{Group, Symbol, Values};
use crate::system::{Excitation, System};

/// All equations of the theory in reading order: what is assumed, the manifold, the fixed points, the
/// boundaries, the slow flow. See also
/// [`groups_beyond`].
pub fn groups(excitation: Excitation) -> impl Iterator<Item = &'static Group> + Clone {
    let motion = match excitation {
        Excitation::BaseDisplacement => stated::MOTION_OF_BASE_GROUP,
        Excitation::Force => stated::MOTION_BY_FORCE_GROUP,
    };
    [motion, stated::GROUPS, manifold::GROUPS, fixed_points::GROUPS, slow_flow::GROUPS]
        .into_iter()
        .flatten()
}

/// The equations beyond steady 1:1 resonance, in reading order: free decay, the slow flow in any regime, and cavities
/// with tilt, friction and unequal ends.
pub fn groups_beyond() -> impl Iterator<Item = &'static Group> + Clone {
    [free_decay::GROUPS, dissipation::GROUPS, cavity::GROUPS].into_iter().flatten()
}

/// `epsilon`, `lambda`, `r`, `Omega`, `sigma`, `gamma` of a system.
pub fn values_of(system: &System) -> Values {
    Values::default()
        .with(Symbol::eps, system.mass_ratio())
        .with(Symbol::lambda, system.damping())
        .with(Symbol::r, system.restitution())
        .with(Symbol::Omega, system.frequency_ratio())
        .with(Symbol::sigma, system.detuning())
        .with(Symbol::gamma, system.forcing_per_clearance())
}
