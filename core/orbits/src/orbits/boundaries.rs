//! Boundaries of the full system in clearance, at one frequency and forcing: where two symmetric
//! impacts per period begin and end, and how far the two asymmetric ones that follow them reach.
//!
//! The last is the border between Z2 and Z1, which no closed form gives: the asymmetric orbit is
//! followed from the symmetry breaking, towards smaller clearances, until another impact appears.

use serde::Serialize;

use super::OrbitError;
use super::branch::{BranchEnd, Settings};
use super::continuation::trace;
use super::limits::{Limit, SymmetricFamily};
use super::orbit::Origin;
use super::special_point::SpecialPoint;
use super::switching::leave;
use super::tracer::{TracedPoint, Tracer};
use crate::bifurcation::Bifurcation;
use crate::executor::{Executor, map};
use crate::system::{Parameter, System};

/// Clearances, over that of the symmetry breaking, in which the asymmetric orbits are followed; past
/// a hundredth impacts crowd in whatever the parameters.
const RANGE: [f64; 2] = [0.01, 2.0];

/// Points of the branch of which one must attract for the asymmetric orbits to be attracting: the
/// first lie so close to the symmetry breaking that rounding decides their stability, and later ones
/// may have doubled their period.
const ENTRY_POINTS: usize = 4;

/// The two asymmetric impacts per period beyond a symmetry breaking. Clearances are over the
/// system's own.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AsymmetricOrbits {
    /// Where the symmetric orbit gives way to them.
    pub symmetry_breaking: f64,
    /// Where they double their period; none if a wall is grazed first.
    pub period_doubling: Option<f64>,
    /// Where the absorber grazes a wall and a third impact appears.
    pub grazing: Option<f64>,
    /// The sequence of walls beyond the grazing, where an orbit was found there.
    pub sequence_beyond: Option<String>,
    /// Whether they exist on the side of smaller clearances, as attracting orbits.
    pub attracting: bool,
    /// Why the branch ends.
    pub end: BranchEnd,
}

/// All boundaries at one frequency and forcing.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ExactBoundaries {
    /// `Omega`.
    pub frequency_ratio: f64,
    /// Of the symmetric orbits.
    pub symmetric: SymmetricFamily,
    /// Of the asymmetric ones next to them; `None` where no symmetry breaking bounds the symmetric
    /// ones, or their branch could not be entered.
    pub asymmetric: Option<AsymmetricOrbits>,
}

impl ExactBoundaries {
    /// The clearance over the system's own at which the asymmetric orbits graze a wall: the border between Z2 and Z1.
    pub fn grazing(&self) -> Option<f64> {
        self.asymmetric.as_ref()?.grazing
    }

    /// At the frequency and forcing of `system`.
    ///
    /// # Errors
    /// As [`SymmetricFamily::of`].
    pub fn of(system: &System) -> Result<Self, OrbitError> {
        let symmetric = SymmetricFamily::of(system)?;
        let breaking = symmetric
            .limits
            .iter()
            .find(|limit| limit.kind == Bifurcation::SymmetryBreaking && limit.bounds_stability);
        // A branch that cannot be entered is a boundary that is not drawn.
        let asymmetric = breaking.and_then(|limit| asymmetric(system, limit).ok());
        Ok(Self { frequency_ratio: system.frequency_ratio(), symmetric, asymmetric })
    }
}

/// The boundaries at each of `frequency_ratios`, everything else being as in `system`; frequencies
/// without a steady motion are left out.
pub fn over_frequency(
    system: &System,
    frequency_ratios: &[f64],
    on: &dyn Executor,
) -> Vec<ExactBoundaries> {
    let of = |ratio: f64| ExactBoundaries::of(&system.with_frequency_ratio(ratio).ok()?).ok();
    map(on, "", frequency_ratios.len(), |k| of(frequency_ratios[k])).into_iter().flatten().collect()
}

/// The asymmetric orbits of `system` over the clearance, followed from the symmetry breaking at `limit`.
///
/// # Errors
/// [`OrbitError`] where their branch cannot be entered.
fn asymmetric(system: &System, limit: &Limit) -> Result<AsymmetricOrbits, OrbitError> {
    let settings = Settings::within(RANGE.map(|factor| factor * limit.clearance));
    let cycle = limit.cycle(system)?;
    let tracer = Tracer::new(system, Parameter::Clearance);
    let first = leave(&tracer, limit.clearance, &cycle)?;
    let attracts =
        |point: &TracedPoint| point.orbit(Origin::Switching).is_ok_and(|orbit| orbit.attracts());
    let mut seen = 1;
    let mut attracting = attracts(&first);
    let branch = trace(&tracer, first, &settings, |point, _| {
        attracting = attracting || seen < ENTRY_POINTS && attracts(point);
        seen += 1;
        Ok(())
    });
    let first = |kind| branch.specials.iter().find(|special| special.kind == kind);
    let value = |special: &SpecialPoint| special.value;
    let grazing = first(Bifurcation::Grazing);
    Ok(AsymmetricOrbits {
        symmetry_breaking: limit.clearance,
        period_doubling: first(Bifurcation::PeriodDoubling).map(value),
        grazing: grazing.map(value),
        sequence_beyond: grazing.and_then(|special| special.sequence_beyond.clone()),
        attracting,
        end: branch.end,
    })
}
