//! Analysis, exact orbits and event-driven simulation of vibro-impact nonlinear energy sinks.
//!
//! # Model
//!
//! ```text
//!    base             ┌─────────────────────────────────┐
//!  F sin ωt    k1     │          oscillator m1          │
//!     ┃──────/\/\/\───┤    ┌───────────────────────┐    │
//!     ┃               │    │ ←─ b ─→ (m2) ←─ b ─→  │    │   the absorber m2 is free between
//!     ┃───────┤ ├─────┤    └───────────────────────┘    │   two walls, which it hits
//!              c1     └─────────────────────────────────┘
//!                         ├─→ x           ├─→ y
//! ```
//!
//! Everything is dimensionless: lengths are over the clearance `b`, time is `τ = ω0 t` with the natural
//! frequency `ω0 = √(k1/m1)` (rad/s), a prime is a derivative by `τ`, and `w = x - y` is the relative displacement.
//!
//! | motion | equation |
//! | --- | --- |
//! | oscillator, `abs(w) < 1` | `x'' + ε λ x' + x = ε γ sin Ωτ + ε² λ Ω γ cos Ωτ` (a force on the mass has no second term) |
//! | absorber, `abs(w) < 1` | `y'' = 0` |
//! | impact, `abs(w) = 1` | `w'` becomes `-r w'`; `x' + ε y'` does not change |
//!
//! | symbol | definition | in [`Parameters`](system::Parameters) |
//! | --- | --- | --- |
//! | `ε` | mass ratio `m2 / m1` | `mass_ratio` |
//! | `λ` | damping `c1 / (m2 ω0)`; the damping ratio is `ε λ / 2` | `damping` |
//! | `r` | restitution, 0 to 1 | `restitution` |
//! | `Ω` | excitation frequency `ω / ω0` | `frequency_ratio` |
//! | `γ` | forcing per clearance: `F / (ε b)` for a base that moves by `F`, `P / (k1 ε b)` for a force `P` | `forcing_per_clearance` |
//!
//! The equations are those of T. Li, S. Seguy, A. Berlioz, "On the dynamics around targeted energy transfer for
//! vibro-impact nonlinear energy sink", Nonlinear Dynamics (2016). A length in metres is the number here times
//! `b`, a velocity in m/s times `b ω0`, a time in seconds is `τ / ω0`, an energy in joules times `m1 (b ω0)²`.
//!
//! # Example
//!
//! Table 1 of the paper at 8 Hz by theory, by an exact orbit and by simulation (the base's amplitude is inferred):
//!
//! ```
#![doc = include_str!("../examples/ten_lines.rs")]
//! ```
//!
//! # Layers
//!
//! | layer | answers | begin with |
//! | --- | --- | --- |
//! | [`system`] | what moves: parameters that are proven valid once | [`System::physical`](system::System::physical), [`System::new`](system::System::new) |
//! | [`analysis`] | what the theory of first order in `ε` says, in closed form | [`Analysis::of`](analysis::Analysis::of) |
//! | [`orbits`] | exact periodic orbits at any `ε`, their bifurcations and branches | [`symmetric_orbits`](orbits::symmetric_orbits), [`branch::follow`](orbits::branch::follow) |
//! | [`simulation`] | one trajectory, or many side by side, from event to event | [`Simulation::new`](simulation::Simulation::new) |
//! | [`regimes`] | what a trajectory does, and what to call it | [`classify`](regimes::classify) |
//! | [`motions`] | every long-term motion of a system, found and identified once | [`motions`](motions::motions) |
//! | [`excitation`], [`linear`], [`flights`] | what is not steady: a release, a sweep, a record; alone, with a tuned mass damper, with the absorber | [`flights::follow`], [`linear::swept`] |
//! | [`cavity`] | the theory where the cavity is tilted, rubs, or has unequal ends | [`CavityTheory::new`](cavity::CavityTheory::new) |
//! | [`dissipation`] | what the absorber takes in every regime, and the slow flow with it | [`DissipationCurve::of`](dissipation::DissipationCurve::of) |
//! | several modes and absorbers: in [`system`], [`analysis`], [`orbits`] and [`simulation`] | the same of a structure of up to eight modes with up to eight absorbers | [`ModalSystem::new`](system::ModalSystem::new), [`AbsorberGroup::of`](analysis::AbsorberGroup::of), [`antiperiodic_orbits`](orbits::antiperiodic_orbits), [`stable_stretches`](orbits::stable_stretches), [`ModalSimulation::new`](simulation::ModalSimulation::new) |
//!
//! `analysis`, `orbits` and `simulation` do not use one another: that they agree is evidence.
//!
//! No layer reads files, starts threads or needs C code; the crate compiles for `wasm32-unknown-unknown` as well: build it
//! with `-C target-feature=+simd128`, as the engine for many runs at once works with vectors. The feature `schema` describes
//! the enumerations that a case file names.
//!
//! # Further
//!
//! Programs to start from are in `examples/`. The book is in `docs/src/`: `model.md` has every equation with
//! its source, `theory.md` and `orbits.md` what is derived from them, `regimes.md` what motions are called,
//! `accuracy.md` how exact each layer is, `limits.md` where the model ends.
//!
//! Cases, reports and the program are the crate `vinesink`. Modules whose page says that they are for the program itself may
//! change at any time.
#![warn(missing_docs)]
#![forbid(unsafe_code)]

pub mod dissipation;
pub mod excitation;
pub mod flights;
pub mod linear;
pub mod motions;

#[doc(inline)]
pub use vinesink_base::{
    bifurcation, equations, executor, method, operation_count, symbolic, system,
};
#[doc(hidden)]
pub use vinesink_base::{names, numerics};
#[doc(inline)]
pub use vinesink_orbits::{analysis, cavity, orbits};
#[doc(inline)]
pub use vinesink_simulation::{regimes, simulation};
