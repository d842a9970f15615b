//! How far the case is from the boundaries of its regime, in clearance, forcing and frequency: by
//! theory, and exactly.

use serde::Serialize;

use crate::analysis::{Analysis, Branch, boundaries};
use crate::orbits::{BestClearance, Bifurcation, FullSystem};
use crate::system::System;
use crate::validation::boundaries::{EITHER_SIDE, clearances, ends_steady_resonance};
use crate::validation::tolerance::LARGEST_OFFSET;

/// A boundary and where it is met when one parameter alone is changed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Margin {
    /// Which boundary.
    pub kind: Bifurcation,
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
    /// Exactly, where an attracting symmetric orbit exists.
    pub exact: Option<ExactMargins>,
    /// Where the attracting symmetric orbit vibrates least, exactly.
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
    pub fn of(analysis: &Analysis, exact: &FullSystem) -> Self {
        let clearance: Vec<Margin> = clearances(analysis)
            .iter()
            .map(|at| Margin {
                kind: at.kind,
                branch: at.branch,
                ends_steady_resonance: ends_steady_resonance(&analysis.system, at.clearance),
                factor: at.clearance,
            })
            .collect();
        Self {
            clearance,
            frequency: in_frequency(analysis),
            exact: ExactMargins::of(exact),
            best_clearance: exact.best_clearance(),
        }
    }

    /// Nearest in clearance.
    pub fn clearance_neighbours(&self) -> Neighbours {
        Neighbours {
            below: self.clearance.iter().rfind(|margin| margin.factor <= 1.0).copied(),
            above: self.clearance.iter().find(|margin| margin.factor > 1.0).copied(),
        }
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
fn in_frequency(analysis: &Analysis) -> Neighbours {
    let system = &analysis.system;
    let mut all = Vec::new();
    for kind in [Bifurcation::SymmetryBreaking, Bifurcation::NeimarkSacker, Bifurcation::SaddleNode]
    {
        for detuning in boundaries::crossings(kind, system, &analysis.manifold) {
            let ratio = 1.0 + system.mass_ratio() * detuning;
            // Far from resonance a boundary of this theory means nothing.
            if (ratio - 1.0).abs() > LARGEST_OFFSET {
                continue;
            }
            let Ok(there) = system.with_frequency_ratio(ratio) else { continue };
            let ends = ends_steady_resonance(&there, 1.0);
            // A saddle-node within an area only leans the response.
            if kind == Bifurcation::SaddleNode && !ends && !changes_area(&there) {
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
    Neighbours {
        below: all.iter().rfind(|margin| margin.factor < 1.0).filter(near).copied(),
        above: all.iter().find(|margin| margin.factor > 1.0).filter(near).copied(),
    }
}

/// A limit of the attracting exact orbit and where it is met when one parameter alone is changed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ExactMargin {
    /// What happens there.
    pub kind: Bifurcation,
    /// The parameter's value there over its value in the case.
    pub factor: f64,
}

/// How far the attracting symmetric orbit of the case persists, exactly.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ExactMargins {
    /// Below and above in clearance; in forcing they are the reciprocals, the other way round.
    pub clearance: [Option<ExactMargin>; 2],
    /// Below and above in frequency, by continuation.
    pub frequency: [Option<ExactMargin>; 2],
}

impl ExactMargins {
    fn of(exact: &FullSystem) -> Option<Self> {
        let stretch = exact.stretch()?;
        let at = |k: usize| {
            stretch.ends[k].map(|kind| ExactMargin { kind, factor: stretch.clearance[k] })
        };
        let own = exact.system.frequency_ratio();
        let frequency = exact.frequency_limits().map(|limit| {
            limit.map(|special| ExactMargin { kind: special.kind, factor: special.value / own })
        });
        Some(Self { clearance: [at(0), at(1)], frequency })
    }

    /// Below and above in forcing: `gamma = G / b`, so a limit at `k` times the clearance is met at
    /// `1/k` times the forcing.
    pub fn forcing(&self) -> [Option<ExactMargin>; 2] {
        let inverse = |margin: ExactMargin| ExactMargin { factor: 1.0 / margin.factor, ..margin };
        let [below, above] = self.clearance;
        [above.map(inverse), below.map(inverse)]
    }
}
