//! Tests of the physics: theory, exact orbits, simulation, regimes. One program, which is linked once: run a
//! part by its name, `cargo test --test physics orbits::`.

#[path = "../common/mod.rs"]
mod common;
mod orbit_support;
#[path = "../reference/mod.rs"]
mod reference;

mod alternatives;
mod asymptotic_error;
mod batch;
mod cavity;
mod cavity_pair;
mod clearance;
mod coexistence;
mod contact;
mod diagrams;
mod dissipation;
mod drawing;
mod dynamics_kind;
mod equations;
mod fixed_point_curve;
mod free_decay;
mod fuzz;
mod impact_times;
mod limits;
mod missed_impacts;
mod nearer_resonance;
mod orbit_branches;
mod orbit_equations;
mod orbits;
mod published;
mod pulse;
mod real_cavity;
mod real_cavity_branches;
mod real_cavity_engine;
mod real_cavity_orbits;
mod record;
mod reduced;
mod regimes;
mod release;
mod shaking;
mod simulation_properties;
mod sine_sweep;
mod sliding;
mod symbolic;
mod tangent;
mod transient_times;
mod transients;
mod validation;
