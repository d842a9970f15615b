//! Areas Z1 to Z4 and the strips A1 and A2 (sections 3.2 and 3.3, Figs. 5 and 6c).

use serde::Serialize;

/// The areas of Fig. 5a.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum Area {
    /// More than two impacts per period.
    Z1,
    /// Two asymmetric impacts per period.
    Z2,
    /// Steady 1:1 resonance, or one of the strips beside it.
    Z3,
    /// No 1:1 resonance.
    Z4,
}

impl Area {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Z1, Self::Z2, Self::Z3, Self::Z4];

    /// Its name in the paper, in results and in documents.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Z1 => "Z1",
            Self::Z2 => "Z2",
            Self::Z3 => "Z3",
            Self::Z4 => "Z4",
        }
    }
}

/// The transition strips of Fig. 6c.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum Strip {
    /// Hysteresis: steady 1:1 resonance beside a modulated response.
    A1,
    /// Beat motion: strongly modulated response.
    A2,
}

impl Strip {
    /// Both of them.
    pub const ALL: [Self; 2] = [Self::A1, Self::A2];

    /// Its name in the paper, in results and in documents.
    pub const fn key(self) -> &'static str {
        match self {
            Self::A1 => "A1",
            Self::A2 => "A2",
        }
    }
}

/// Where closed form puts a system.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Zone {
    /// The area.
    pub area: Area,
    /// The strip next to Z3, if in one.
    pub strip: Option<Strip>,
}

impl Zone {
    /// Whether it is in Z3, strips included: where the paper wants as much of a band as possible.
    pub fn is_z3(&self) -> bool {
        self.area == Area::Z3
    }

    /// What a table calls it.
    pub fn words(&self) -> &'static str {
        match self.strip {
            Some(Strip::A1) => "strip A1",
            Some(Strip::A2) => "strip A2",
            None => self.area.key(),
        }
    }
}
