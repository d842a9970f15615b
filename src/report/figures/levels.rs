//! The areas of Fig. 5a as bands of the oscillator's amplitude `C/b`: below the fold there is no
//! 1:1 motion (Z4), up to symmetry breaking a steady one (Z3), beyond that Z2, then Z1.

use crate::analysis::{Branch, Manifold, fixed_points};
use crate::orbits;
use crate::report::figure::{Color, Fill, Hatch, Layer};
use crate::study::StudyError;
use crate::system::System;
use crate::validation::tolerance::has_resonance;

/// `C/b` of the levels between the areas.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Levels {
    pub fold: f64,
    pub breaking: f64,
    /// Where the exact orbits gain a third impact, if anywhere.
    pub grazing: Option<f64>,
}

impl Levels {
    /// The levels at a system's frequency; the one between Z2 and Z1 is that of the exact orbits.
    pub(super) fn of(system: &System, manifold: &Manifold) -> Result<Self, StudyError> {
        let exact = has_resonance(system).then(|| orbits::Boundaries::of(system).ok()).flatten();
        let grazing = match exact.and_then(|exact| exact.grazing()) {
            Some(clearance) => level(system, manifold, clearance)?,
            None => None,
        };
        Ok(Self {
            fold: manifold.fold.oscillator_amplitude,
            breaking: manifold.symmetry_breaking.oscillator_amplitude,
            grazing,
        })
    }

    /// Tints and names over a panel's whole width; `left` is where names begin.
    pub(super) fn layers(&self, (first, last): (f64, f64), top: f64, left: f64) -> Vec<Layer> {
        let band = |low: f64, high: f64, color, opacity, hatch| {
            let fill = Fill { color, opacity, hatch };
            Layer::between(&[[first, low], [last, low]], &[[first, high], [last, high]], fill)
        };
        let name =
            |low: f64, high: f64, words: &str| Layer::note([left, f64::midpoint(low, high)], words);
        let mut layers = vec![
            band(self.fold, self.breaking, Color::BluishGreen, 0.1, Hatch::None),
            name(0.0, self.fold, "Z4"),
            name(self.fold, self.breaking, "Z3"),
        ];
        match self.grazing.filter(|grazing| *grazing < top) {
            Some(grazing) => {
                layers.insert(1, band(self.breaking, grazing, Color::Orange, 0.1, Hatch::None));
                layers.push(name(self.breaking, grazing, "Z2"));
                layers.push(name(grazing, top, "Z1"));
            }
            None => layers.push(name(self.breaking, top, "Z1, Z2")),
        }
        layers
    }
}

/// `C/b` of the symmetric motion at a clearance right of symmetry breaking.
fn level(system: &System, manifold: &Manifold, clearance: f64) -> Result<Option<f64>, StudyError> {
    let Ok(there) = system.with_clearance_scaled(clearance) else { return Ok(None) };
    let points = fixed_points::solve(&there, manifold)?;
    let right = points.iter().rfind(|point| point.branch == Branch::Right);
    Ok(right.map(|point| point.oscillator_amplitude))
}
