//! What a search along a range of excitations must know of it.

use super::Value;

/// A range of excitations of one design, at whose places motions are searched. Places are numbers of its own unit.
///
/// For the program itself: it may change at any time.
pub trait Line {
    /// A state from which a motion can be flown.
    type State: Copy;
    /// A long-term motion.
    type Motion;
    /// Those of a place.
    type Motions;
    /// A number whose worst value is looked for.
    type Wanted: Copy + PartialEq;
    /// Why motions cannot be flown.
    type Error;

    /// Distance of places that is never halved: what scatters on a finer scale is chaos, whose largest values have an error of
    /// their own.
    fn finest(&self) -> f64;
    /// What is looked at to see which motions are followed to the places beside them.
    fn followed(&self) -> Vec<Self::Wanted>;
    /// The motions at some places, where there is a system.
    ///
    /// # Errors
    /// Where one cannot be flown.
    fn search(
        &self,
        purpose: Purpose,
        sites: &[Site<'_, Self>],
    ) -> Result<Vec<(usize, Self::Motions)>, Self::Error>;
    /// Adds motions that were followed to a place.
    fn join(&self, known: &mut Self::Motions, found: Self::Motions);

    /// The motions of a place that may be worst.
    fn motions<'a>(&'a self, of: &'a Self::Motions) -> Vec<&'a Self::Motion>;
    /// Whether an absorber impacts in one.
    fn moves(motion: &Self::Motion) -> bool;
    /// Whether it is known by averages.
    fn wanders(motion: &Self::Motion) -> bool;
    /// Whether it has settled.
    fn has_settled(motion: &Self::Motion) -> bool;
    /// Whether its extremes along the range are known without places.
    fn is_solved(motion: &Self::Motion) -> bool;
    /// A state on it, where one is known.
    fn state(motion: &Self::Motion) -> Option<Self::State>;
    /// A number of it, its sign turned where the smallest is the worst, and by how much it may be worse.
    fn value(&self, motion: &Self::Motion, of: Self::Wanted) -> Option<Value>;
    /// How bad a number may become of a motion before it ends, where it has no counterpart at the place beside it and where it ends is
    /// known.
    fn at_its_end(
        &self,
        motion: &Self::Motion,
        beside: &Self::Motions,
        of: Self::Wanted,
    ) -> Option<f64>;
    /// Whether the smallest of a number is the worst.
    fn is_least(of: Self::Wanted) -> bool;
}

/// A place at which motions are looked for.
#[derive(Debug)]
pub struct Site<'a, L: Line + ?Sized> {
    /// Where.
    pub at: f64,
    /// States where starts begin that are not counted.
    pub further: Vec<L::State>,
    /// The motions that are known there.
    pub known: Option<&'a L::Motions>,
    /// Share of the patience with what may be a transient.
    pub patience: f64,
}

/// Why motions are looked for at a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// It is one of the first.
    First,
    /// A number may be worse there than at the places beside it.
    Between,
    /// Motions of those are followed to it, from these states alone.
    Followed,
    /// It decides: starts are flown for as long as where there is no other place.
    InFull,
}
