//! How far the case is from the boundaries of its regime, in clearance, forcing and frequency.

use serde::Serialize;

use crate::analysis::{Analysis, AnalysisError, Area, BoundaryKind, Branch, Zone, boundaries};
use crate::system::System;
use crate::validation::boundaries::{EITHER_SIDE, clearances, ends_steady_resonance};
use crate::validation::tolerance::{LARGEST_OFFSET, asymptotic_error};

/// A boundary and where it is met when one parameter alone is changed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Margin {
    /// Which boundary.
    pub kind: BoundaryKind,
    /// For a saddle-node in clearance: the branch on which two fixed points collide.
    pub branch: Branch,
    /// Whether steady 1:1 resonance begins or ends there, as far as the theory says.
    pub ends_steady_resonance: bool,
    /// The parameter's value there over its value in the case.
    pub factor: f64,
}

/// The nearest boundaries on either side, per parameter.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Margins {
    /// All boundaries in clearance, ascending.
    pub clearance: Vec<Margin>,
    /// Nearest in frequency below and above the case's.
    pub frequency: Neighbours,
    /// Where the theory expects the smallest steady vibration.
    pub best_clearance: Option<BestClearance>,
}

/// The nearest boundary below and above.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Neighbours {
    /// With a factor below 1.
    pub below: Option<Margin>,
    /// With a factor above 1.
    pub above: Option<Margin>,
}

impl Margins {
    /// Margins of an analysed system.
    ///
    /// # Errors
    /// As [`Analysis::of`].
    pub fn of(analysis: &Analysis) -> Result<Self, AnalysisError> {
        let clearance: Vec<Margin> = clearances(analysis)
            .iter()
            .map(|at| Margin {
                kind: at.kind,
                branch: at.branch,
                ends_steady_resonance: ends_steady_resonance(&analysis.system, at.clearance),
                factor: at.clearance,
            })
            .collect();
        Ok(Self {
            clearance,
            frequency: in_frequency(analysis)?,
            best_clearance: BestClearance::of(analysis),
        })
    }

    /// Nearest in clearance.
    pub fn clearance_neighbours(&self) -> Neighbours {
        Neighbours {
            below: self.clearance.iter().rfind(|margin| margin.factor <= 1.0).copied(),
            above: self.clearance.iter().find(|margin| margin.factor > 1.0).copied(),
        }
    }

    /// Nearest in forcing: `gamma = G / b`, so a boundary at `k` times the clearance is met at `1/k`
    /// times the forcing.
    pub fn forcing_neighbours(&self) -> Neighbours {
        let inverse = |margin: Margin| Margin { factor: 1.0 / margin.factor, ..margin };
        let Neighbours { below, above } = self.clearance_neighbours();
        Neighbours { below: above.map(inverse), above: below.map(inverse) }
    }
}

/// Whether the area or strip differs a little below and a little above the clearance of `system`.
fn changes_area(system: &System) -> bool {
    let zone =
        |factor: f64| Some(Analysis::of(&system.with_clearance_scaled(factor).ok()?).ok()?.zone);
    zone(1.0 - EITHER_SIDE) != zone(1.0 + EITHER_SIDE)
}

/// A boundary at half or twice the frequency is not a neighbour.
const FAR: f64 = 2.0;

/// Frequencies at which a boundary passes through the case's clearance and forcing.
fn in_frequency(analysis: &Analysis) -> Result<Neighbours, AnalysisError> {
    let system = &analysis.system;
    let mut all = Vec::new();
    for kind in [BoundaryKind::SymmetryBreaking, BoundaryKind::Hopf, BoundaryKind::SaddleNode] {
        for detuning in boundaries::crossings(kind, system, &analysis.manifold)? {
            let ratio = 1.0 + system.mass_ratio() * detuning;
            // Far from resonance a boundary of this theory means nothing.
            if (ratio - 1.0).abs() > LARGEST_OFFSET {
                continue;
            }
            let Ok(there) = system.with_frequency_ratio(ratio) else { continue };
            let ends = ends_steady_resonance(&there, 1.0);
            // A saddle-node within an area only leans the response.
            if kind == BoundaryKind::SaddleNode && !ends && !changes_area(&there) {
                continue;
            }
            all.push(Margin {
                kind,
                branch: Branch::Stable,
                ends_steady_resonance: ends,
                factor: ratio / system.frequency_ratio(),
            });
        }
    }
    all.sort_by(|a, b| a.factor.total_cmp(&b.factor));
    let near = |margin: &&Margin| (1.0 / FAR..FAR).contains(&margin.factor);
    Ok(Neighbours {
        below: all.iter().rfind(|margin| margin.factor < 1.0).filter(near).copied(),
        above: all.iter().find(|margin| margin.factor > 1.0).filter(near).copied(),
    })
}

/// The clearance at which theory predicts the smallest steady 1:1 vibration at the case's forcing.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BestClearance {
    /// Clearance over the case's.
    pub factor: f64,
    /// Amplitude of the oscillator over the case's clearance.
    pub amplitude: f64,
}

/// Where steady 1:1 resonance is the only prediction.
const STEADY: Zone = Zone { area: Some(Area::Z3), strip: None };
/// Clearances tried per unit of the logarithm; the optimum is an estimate to one percent, or an end
/// of the stable range.
const STEPS_PER_E_FOLD: f64 = 100.0;

impl BestClearance {
    /// Scans the clearances between the outermost boundaries at which a stable 1:1 motion exists.
    pub fn of(analysis: &Analysis) -> Option<Self> {
        let boundaries = clearances(analysis);
        let (first, last) = (boundaries.first()?.clearance, boundaries.last()?.clearance);
        let error = asymptotic_error(&analysis.system);
        let steps = (libm::log(last / first) * STEPS_PER_E_FOLD).ceil().clamp(1.0, 2000.0);
        let tried = (0..=steps as u32).filter_map(|k| {
            let factor = first * libm::exp(libm::log(last / first) * f64::from(k) / steps);
            let there = analysis.system.with_clearance_scaled(factor).ok()?;
            let there = Analysis::of(&there).ok()?;
            // Strips, and the last stretch before a boundary that is known to this accuracy only,
            // are no place for a design.
            let beyond = there.system.with_clearance_scaled(1.0 + error).ok()?;
            let room = Analysis::of(&beyond).ok()?.zone == STEADY;
            if there.zone != STEADY || !room {
                return None;
            }
            let smallest = there.stable_points().map(|point| point.oscillator * factor);
            let amplitude = smallest.min_by(f64::total_cmp)?;
            Some(Self { factor, amplitude })
        });
        tried.min_by(|a, b| a.amplitude.total_cmp(&b.amplitude))
    }
}
