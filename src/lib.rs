//! Analysis, event-driven simulation and design reports for vibro-impact nonlinear energy sinks.
//!
//! The physics is a crate of its own, [`vinesink_core`], whose modules are here as well: its page has the model, its
//! symbols and an example. This crate reads cases with units, answers what is asked of them, and writes reports.
//!
//! | module | answers | begin with |
//! | --- | --- | --- |
//! | [`case`] | a case file, read or refused with what to do | [`Case::parse`](case::Case::parse) |
//! | [`answer`] | what all commands know of a case | [`Answer::of`](answer::Answer::of) |
//! | [`criteria`], [`case_optimum`] | whether a design holds, and which is best | [`case_optimum::Optimum::of`] |
//! | [`sweep`] | grids of designs in Parquet files | [`sweep::Plan::of`] |
//! | [`case_report`], [`report`], [`diff`] | reports, and what changed between two | [`case_report::Report::of`] |
//!
//! The feature `cli` (default) adds the program, and what it shares with others; without it nothing here starts a thread.
//!
//! Programs to start from are in `examples/`. The book is in `docs/src/`: `accuracy.md` says how exact each layer is,
//! `limits.md` where the model ends. Modules may change at any time.
#![warn(missing_docs)]
#![forbid(unsafe_code)]

pub mod alternatives;
pub mod answer;
pub mod band;
pub mod case;
pub mod case_input;
pub mod case_optimum;
pub mod case_report;
pub mod contact;
pub mod criteria;
pub mod dampers;
pub mod diff;
pub mod digest;
pub mod measure;
pub mod modal;
pub mod operating_range;
pub mod optimize;
#[cfg(feature = "cli")]
pub mod program;
pub mod proposal;
pub mod quantity;
pub mod report;
pub mod store;
pub mod study;
pub mod sweep;
pub mod tradeoff;
pub mod transient;
pub mod validation;

pub(crate) use vinesink_core::numerics;
pub use vinesink_core::{
    analysis, bifurcation, cavity, dissipation, equations, excitation, executor, flights, linear,
    method, motions, operation_count, orbits, regimes, simulation, symbolic, system,
};
