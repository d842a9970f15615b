//! The areas along the manifold, and how the fixed points move as the clearance grows (Fig. 5).

use serde::Serialize;

use crate::analysis::{AsymmetricLimits, FixedPoint, FixedPointCurve, Manifold, fixed_points};
use crate::study::{CaseStudy, StudyError};
use crate::system::System;

use super::{Line, branches, on_stable_branch};

/// The areas of Fig. 5a as levels of `C/b`: below the fold there is no 1:1 motion (Z4), up to symmetry
/// breaking a steady one (Z3), beyond that Z2, then Z1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Levels {
    /// Between Z4 and Z3.
    pub fold: f64,
    /// Between Z3 and Z2.
    pub breaking: f64,
    /// Between Z2 and Z1: where the asymmetric motion gains a third impact, if anywhere.
    pub grazing: Option<f64>,
}

impl Levels {
    pub(super) fn of(manifold: &Manifold) -> Self {
        let grazing = AsymmetricLimits::of(manifold.restitution).grazing;
        Self {
            fold: manifold.fold.oscillator_amplitude,
            breaking: manifold.symmetry_breaking.oscillator_amplitude,
            grazing: grazing.map(|end| end.oscillator_amplitude),
        }
    }
}

/// Areas and fixed points at the case's frequency; clearances over the case's.
#[derive(Debug, Clone)]
pub struct Areas {
    /// Where the areas end.
    pub levels: Levels,
    /// Fixed points over the clearance, `[clearance, C/b]`: stable ones, and the others.
    pub lines: [Line; 2],
    /// Clearances that show the way, with their fixed points.
    pub chosen: Vec<(f64, Vec<FixedPoint>)>,
}

impl Areas {
    /// The manifold is shown up to this `B/b`.
    pub const WIDEST: f64 = 2.6;

    pub(super) fn of(study: &CaseStudy) -> Result<Option<Self>, StudyError> {
        let (system, manifold) = (&study.analysis.system, &study.analysis.manifold);
        let gamma = system.forcing_per_clearance();
        if manifold.fold.oscillator_amplitude == 0.0 {
            return Ok(None);
        }
        let at = &study.analysis.boundaries;
        let [breaking, hopf] = [gamma / at.symmetry_breaking, gamma / at.hopf];
        // One in each area, and two on the way to the collision.
        let end = at.saddle_node.map_or(1.3 * hopf, |node| gamma / node.forcing_over_clearance);
        let between = |part: f64| hopf + part * (end - hopf);
        let mut chosen = Vec::new();
        for clearance in
            [0.75 * breaking, (breaking * hopf).sqrt(), 0.93 * hopf, between(0.5), between(0.97)]
        {
            let Ok(there) = system.with_clearance_scaled(clearance) else { continue };
            chosen.push((clearance, fixed_points(&there, manifold)?));
        }
        Ok(Some(Self { levels: Levels::of(manifold), lines: lines(system, manifold), chosen }))
    }
}

/// At a given amplitude the clearance is explicit. A fixed point is a saddle where `gamma^2` falls with the
/// amplitude.
fn lines(system: &System, manifold: &Manifold) -> [Line; 2] {
    let curve = FixedPointCurve::of(system, manifold);
    let gamma = system.forcing_per_clearance();
    let mut shifts: Vec<f64> = super::even(-1.0, Areas::WIDEST - 1.0, 1200)
        .skip(1)
        .chain([manifold.fold_shift, manifold.symmetry_breaking.absorber_amplitude - 1.0])
        .collect();
    shifts.sort_by(f64::total_cmp);
    let forcing = |shift: f64| curve.forcing_squared(1.0 + shift).sqrt();
    let place =
        |shift: &f64| [gamma / forcing(*shift), manifold.point(*shift).oscillator_amplitude];
    let stable = |[a, b]: [&f64; 2]| {
        on_stable_branch([a, b].map(|at| manifold.branch(*at)), forcing(*b) > forcing(*a))
    };
    branches(&shifts, &stable, &place)
}
