//! Puts the layers together for one case: what is analysed, simulated and confronted.

pub mod attractors;
pub mod starts;
