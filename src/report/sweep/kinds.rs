//! How regimes, areas and counts are coloured.

use crate::analysis::{Area, Zone};
use crate::regimes::Regime;
use crate::report::figure::{Color, Marker, Shape, Tint};

/// A regime's tint: the hues of the Okabe-Ito palette at lightnesses of their own (58, 67, 84, 75, 92 and 97
/// of 100), so that they stay apart in a grey print and for readers with any common colour vision.
pub const fn tint(regime: Regime) -> Tint {
    match regime {
        Regime::AboveTwo => Tint([0xBE, 0x74, 0x9D]),
        Regime::TwoAsymmetric => Tint([0x53, 0xAC, 0xDB]),
        Regime::TwoSymmetric => Tint([0x8F, 0xE2, 0xC0]),
        Regime::StronglyModulated => Tint([0xF1, 0xAA, 0x63]),
        Regime::BelowTwo => Tint([0xF2, 0xEB, 0x99]),
        Regime::AtRest => Tint([0xF6, 0xF6, 0xF6]),
    }
}

/// A regime's mark in a diagram over one axis.
pub(in crate::report) const fn mark(regime: Regime) -> (Marker, Color) {
    match regime {
        Regime::AboveTwo => (Marker::filled(Shape::Square).sized(4.2), Color::ReddishPurple),
        Regime::TwoAsymmetric => (Marker::filled(Shape::Triangle).sized(5.0), Color::Blue),
        Regime::TwoSymmetric => (Marker::filled(Shape::Circle).sized(4.4), Color::BluishGreen),
        Regime::StronglyModulated => (Marker::filled(Shape::Diamond).sized(5.0), Color::Orange),
        Regime::BelowTwo => (Marker::filled(Shape::Cross).sized(4.6), Color::Vermillion),
        Regime::AtRest => (Marker::hollow(Shape::Circle).sized(4.4), Color::Grey),
    }
}

/// The theory's areas as results name them, and their tints where they are all that is drawn.
pub(super) const AREAS: [(&str, Tint); 5] = [
    (Area::Z1.key(), tint(Regime::AboveTwo)),
    (Zone::UNSETTLED, Tint([0x9A, 0x9C, 0xC4])),
    (Area::Z2.key(), tint(Regime::TwoAsymmetric)),
    (Area::Z3.key(), tint(Regime::TwoSymmetric)),
    (Area::Z4.key(), tint(Regime::StronglyModulated)),
];

/// An area as a figure names it.
pub(super) fn area_name(area: &str) -> &str {
    if area == Zone::UNSETTLED { Zone::UNSETTLED_WORDS } else { area }
}

/// Tints of the number of motions found, and its name: the last stands for all larger ones.
pub(super) const COUNTS: [(Tint, &str); 5] = [
    (Tint([0x60, 0x60, 0x60]), "none measured"),
    (Tint([0xF3, 0xF3, 0xF3]), "one motion"),
    (Tint([0xB4, 0xC9, 0xE8]), "2"),
    (Tint([0x4F, 0x8F, 0xC9]), "3"),
    (Tint([0x12, 0x42, 0x7E]), "4 or more"),
];
