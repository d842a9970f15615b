//! The answer in a word, and whether it is good news.

use serde::{Deserialize, Serialize};

/// Whether the news is good.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Tone {
    /// The criteria hold, or without any the absorber reduces the vibration.
    Good,
    /// Something between.
    Mixed,
    /// A criterion fails, or the absorber does not help.
    Bad,
}

/// The answer in a word. The order is that of a sorted column.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Word {
    /// All criteria hold.
    Holds,
    /// The absorber reduces the vibration.
    Works,
    /// No criterion fails by more than its error.
    TooCloseToCall,
    /// No criterion fails by what has settled, and what has not may fail one.
    NotDecided,
    /// Something between.
    Mixed,
    /// Hardly any change.
    DoesNothing,
    /// More vibration.
    MakesItWorse,
    /// Nothing drives the case, or no motion was found.
    NoAnswer,
    /// A criterion fails.
    Fails,
}

impl Word {
    /// Whether that is good news.
    pub fn tone(self) -> Tone {
        match self {
            Self::Holds | Self::Works => Tone::Good,
            Self::TooCloseToCall | Self::NotDecided | Self::Mixed => Tone::Mixed,
            _ => Tone::Bad,
        }
    }
}
