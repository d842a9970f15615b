//! Long-term motions of a structure of several modes with several absorbers at one excitation.
//!
//! Exact orbits that attract are solved for. Each start is flown until its states at the ends of periods are those of such an
//! orbit, or nearly repeat: Newton's method then solves for the periodic motion ([`ModalCycle`]), which counts if it attracts.
//! Where an absorber rests on a wall, or there are more impacts than that covers, it does so on the simulated map (`polished.rs`). What
//! wanders once the slowest mode has died out is flown on while starts of its place still settle, as with one mode, and then measured
//! in blocks (`wandering.rs`). Further starts are of the structure as it carries its absorbers, whose resonances lie elsewhere.
//!
//! An absorber that rests where no wall reaches it has no part in the motion of the others: such motions are those of the
//! structure without it, as a force that grows slowly leaves them. It may rest within `b - X` of the middle, `X` being the
//! largest displacement of the structure there: in the share `1 - X/b` of its cavity, and several in the product of their
//! shares.

mod flight;
mod motion;
mod polished;
mod proven;
mod search;
mod stretch;
mod wandering;

pub use flight::longest_flight;
pub use motion::{ModalMotion, SensorExtent};
pub use search::{ModalEffort, modal_at_rest, modal_motions};
