//! Structures of several modes with several absorbers: theory, exact orbits and simulation against one another, against the
//! engine for one of each, and against values of two programs that share nothing with this one.

mod branches;
mod cases;
mod contact;
mod cycles;
mod motions;
mod orbits;
mod simulation;
mod theory;
