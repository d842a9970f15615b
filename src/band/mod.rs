//! One design over a range of excitations: a band of frequencies, or of amplitudes.
//!
//! The paper's criterion (section 3.4 of Li, Seguy, Berlioz 2016) is to have as much of a target band
//! as possible in area Z3. Where areas begin and end along a band are roots, not samples
//! (`numerics/scan.rs`): of the theory's boundaries ([`theory`]), and of the stability of 1:1 motions, which
//! [`crate::motions::along`] knows with all others. [`survey`] puts them together: every command takes the worst of a band
//! from there. Beside the absorber stand its rivals ([`rivals`]): the bare oscillator, and the best tuned mass damper of
//! the same mass.

pub mod margin;
pub mod rivals;
pub mod survey;
pub mod theory;

pub use crate::system::{Band, Stretch};
pub use rivals::Rivals;
pub use survey::{Survey, SurveySettings, Worst};
