//! Long-term motions of a structure of several modes with several absorbers at one excitation.
//!
//! They are searched for as those of one mode, by the same search: exact orbits that attract are solved for; each start is flown until
//! it is on one, or nearly repeats, and Newton's method solves for the periodic motion ([`ModalCycle`](crate::orbits::ModalCycle)). Where an
//! absorber rests on a wall, or there are more impacts than that covers, it does so on the simulated map (`polished.rs`). What is known
//! of several modes alone stands here (`sensed.rs`): their trajectories, what sensors read of them, and where starts begin. Further starts
//! are of the structure as it carries its absorbers, whose resonances lie elsewhere.
//!
//! An absorber that rests where no wall reaches it has no part in the motion of the others: such motions are those of the
//! structure without it, as a force that grows slowly leaves them. It may rest within `b - X` of the middle, `X` being the
//! largest displacement of the structure there: in the share `1 - X/b` of its cavity, and several in the product of their
//! shares.

mod at_rest;
mod motion;
mod polished;
mod proven;
mod search;
mod sensed;
mod starts;
mod watch;

pub use at_rest::modal_at_rest;
pub use motion::{ModalMotion, SensorExtent};
pub use search::{ModalEffort, modal_motions};
pub use sensed::longest_flight;
