//! How regimes look in any figure.

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
