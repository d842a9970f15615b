//! How areas and counts are coloured.

use crate::analysis::Area;
use crate::criteria::Outcome;
use crate::regimes::Regime;
use crate::report::figure::Tint;
use crate::report::figures::regimes::tint;

/// The theory's areas as results name them, and their tints where they are all that is drawn.
pub(super) const AREAS: [(&str, Tint); 4] = [
    (Area::Z1.key(), tint(Regime::AboveTwo)),
    (Area::Z2.key(), tint(Regime::TwoAsymmetric)),
    (Area::Z3.key(), tint(Regime::TwoSymmetric)),
    (Area::Z4.key(), tint(Regime::StronglyModulated)),
];

/// Tints of what all limits come to, and their words, in the order of [`Outcome::ALL`].
pub(super) const OUTCOMES: [(Tint, &str); Outcome::ALL.len()] = [
    (Tint([0x4F, 0x8F, 0xC9]), "all limits hold"),
    (Tint([0xC9, 0xDC, 0xEE]), "too close to call"),
    (Tint([0xF3, 0xE3, 0xC3]), "a motion still settles"),
    (Tint([0x60, 0x60, 0x60]), "nothing measured"),
    (Tint([0xE0, 0x9A, 0x3E]), "a limit fails"),
];

/// Tints of the number of motions found, and its name: the last stands for all larger ones.
pub(super) const COUNTS: [(Tint, &str); 5] = [
    (Tint([0x60, 0x60, 0x60]), "none measured"),
    (Tint([0xF3, 0xF3, 0xF3]), "one motion"),
    (Tint([0xB4, 0xC9, 0xE8]), "2"),
    (Tint([0x4F, 0x8F, 0xC9]), "3"),
    (Tint([0x12, 0x42, 0x7E]), "4 or more"),
];
