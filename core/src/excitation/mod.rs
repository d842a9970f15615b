//! What a structure is subjected to: data, and what follows from them in closed form.
//!
//! | scene | what it says | in dimensionless form |
//! | --- | --- | --- |
//! | steady | `F sin(2 pi f t)` of the base, or such a force | [`System`](crate::system::System) |
//! | [`Release`] | displacement, velocity, an impulse | a [`State`](crate::system::State) |
//! | [`SineSweep`] | `sin(phi(t))` with `phi' = 2 pi f(t)` | stretches of a constant frequency ratio |
//! | [`Record`], [`Spectrum`] | values over time, or the density of noise | [`Piece`]s in which `f` is linear |
//!
//! Numbers are in SI, or without units where a case is, until [`Scales`](crate::system::Scales) divide them: lengths by
//! the clearance, times by `1/omega0`. Nothing is flown here.

mod record;
mod release;
mod sine_sweep;

pub use record::{Piece, Record, RecordQuantity, Spectrum};
pub use release::{Release, amplitude};
pub use sine_sweep::{SineSweep, SweepRate, SweepStretch};

use crate::system::Parameter;

/// What a structure is subjected to that is not steady harmonic excitation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Transient {
    /// It is let go or struck.
    Release(Release),
    /// The frequency of its excitation is swept.
    Sweep(SineSweep),
    /// A record or noise drives it, whose values are of this quantity.
    Record(RecordQuantity),
}

impl Transient {
    /// Places of the absorber that are simulated unless a case says how many.
    pub const PLACES: u32 = 64;
    /// The same under each of several records.
    const PLACES_OF_MANY: u32 = 8;

    /// Places of the absorber under each of so many records, unless a case says how many.
    pub const fn places_under(records: usize) -> u32 {
        if records > 1 { Self::PLACES_OF_MANY } else { Self::PLACES }
    }

    /// Places of the absorber that are simulated unless a case says how many: of several records fewer of each.
    pub const fn places(self, records: usize) -> u32 {
        match self {
            Self::Release(_) | Self::Sweep(_) => Self::PLACES,
            Self::Record(_) => Self::places_under(records),
        }
    }

    /// The number that a parameter is in it: how far and how fast a structure is let go, how hard it is struck, how
    /// fast it is swept.
    pub const fn number(&mut self, parameter: Parameter) -> Option<&mut f64> {
        match (self, parameter) {
            (Self::Release(of), parameter) => of.number(parameter),
            (Self::Sweep(of), Parameter::Rate) => match &mut of.rate {
                SweepRate::Linear(rate) | SweepRate::Octaves(rate) => Some(rate),
            },
            _ => None,
        }
    }
}

/// What a structure is subjected to: which criteria, tables and commands make sense of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scene {
    /// Harmonic excitation.
    Steady,
    /// None: it is let go or struck.
    Release,
    /// Harmonic excitation whose frequency changes.
    Sweep,
    /// A record or noise.
    Record,
}

impl Scene {
    /// "a structure that is ...".
    pub const fn words(self) -> &'static str {
        match self {
            Self::Steady => "driven steadily",
            Self::Release => "released or struck",
            Self::Sweep => "swept through resonance",
            Self::Record => "driven by a record",
        }
    }
}
