//! How areas and counts are coloured.

use crate::analysis::Area;
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

/// Tints of the number of motions found, and its name: the last stands for all larger ones.
pub(super) const COUNTS: [(Tint, &str); 5] = [
    (Tint([0x60, 0x60, 0x60]), "none measured"),
    (Tint([0xF3, 0xF3, 0xF3]), "one motion"),
    (Tint([0xB4, 0xC9, 0xE8]), "2"),
    (Tint([0x4F, 0x8F, 0xC9]), "3"),
    (Tint([0x12, 0x42, 0x7E]), "4 or more"),
];
