//! Which walls a repeating motion hits, in what order.

use std::fmt::{self, Display, Formatter};

use serde::{Serialize, Serializer};

use crate::numerics::cyclic_word::canonical;
use crate::simulation::{Impact, Side};

/// Most impacts that a sequence holds. A longer one is chattering, whose order of walls says no
/// more than the number of impacts.
const LONGEST: usize = 128;

/// The sides of the impacts of one repetition, in one canonical form for all motions that differ by
/// where the repetition is said to begin or are mirror images of each other: `+-` for 1:1 resonance,
/// `++-` for two impacts on one wall and one on the other, whichever walls they are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct ImpactSequence {
    /// One bit for each impact, the first in the lowest place; set on the minus side.
    minus: u128,
    length: u8,
}

impl ImpactSequence {
    /// The sequence of the impacts of one repetition; `None` without impacts or with more than 128.
    pub fn of(repetition: &[Impact]) -> Option<Self> {
        let sides: Vec<bool> = repetition.iter().map(|impact| impact.side == Side::Minus).collect();
        Self::canonical(&sides)
    }

    fn canonical(sides: &[bool]) -> Option<Self> {
        let length = u8::try_from(sides.len()).ok().filter(|_| sides.len() <= LONGEST)?;
        let form = canonical(sides);
        let bit = |minus: u128, (k, side): (usize, &bool)| minus | (u128::from(*side) << k);
        (length > 0).then(|| Self { minus: form.iter().enumerate().fold(0, bit), length })
    }

    /// Number of impacts.
    pub fn length(self) -> usize {
        usize::from(self.length)
    }
}

impl Display for ImpactSequence {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        (0..self.length)
            .try_for_each(|k| f.write_str(if self.minus >> k & 1 == 1 { "-" } else { "+" }))
    }
}

impl Serialize for ImpactSequence {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Option<String> {
        let sides: Vec<bool> = text.chars().map(|side| side == '-').collect();
        ImpactSequence::canonical(&sides).map(|found| found.to_string())
    }

    #[test]
    fn rotations_and_mirror_images_are_one() {
        for (form, others) in
            [("+-", vec!["-+"]), ("++-", vec!["+-+", "-++", "--+", "-+-", "+--"]), ("+", vec!["-"])]
        {
            assert_eq!(of(form).as_deref(), Some(form));
            others.iter().for_each(|other| assert_eq!(of(other).as_deref(), Some(form)));
        }
        // The same number of impacts in another order is another motion.
        assert_ne!(of("++--"), of("+-+-"));
        assert_ne!(of("+-"), of("+-+-"));
    }

    #[test]
    fn long_and_empty_sequences_have_none() {
        assert_eq!(of(""), None);
        assert_eq!(of(&"+-".repeat(64)).as_deref(), Some("+-".repeat(64).as_str()));
        assert_eq!(of(&"+".repeat(129)), None);
        assert_eq!(of(&"+".repeat(300)), None);
    }
}
