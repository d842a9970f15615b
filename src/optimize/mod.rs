//! The absorber that serves a case best: clearance, and on request restitution and mass.
//!
//! The objective is built on what is exact: areas of the theory and stability of orbits as roots, the
//! orbit's amplitude; simulation where no orbit attracts ([`task`], [`amplitude`]). It is looked for
//! everywhere between the bounds and then narrowed down ([`search`]), once as written and once expected
//! over what is uncertain ([`expected`]).

pub mod amplitude;
pub mod expected;
pub mod search;
pub mod task;

pub use search::{InTurn, Spread};
pub use task::{Bounds, Deviation, Task, TaskError, Variable};
