//! The JSON documents that other programs read: `vinesink/analysis@1` and `vinesink/simulation@1`.
//!
//! Lengths named `_over_clearance`, and `B` and `C`, are over the clearance; other lengths are in
//! metres for a physical case and in the case's own unit for a reduced one. Energies are in joules,
//! or per `m1 omega0^2` in the case's own unit of length squared. Angles are in radians.

use serde::Serialize;

use crate::analysis::{Analysis, Area, Branch, FixedPoint, ManifoldPoint, Strip};
use crate::case::Scales;
use crate::regimes::{Attractor, Evidence, FoundAttractor, Regime};
use crate::simulation::{Energy, Stop, SustainedContact};
use crate::study::SettledArea;
use crate::system::{Excitation, System};

/// `vinesink/analysis@1`.
#[derive(Debug, Clone, Serialize)]
pub struct AnalysisDocument {
    format: &'static str,
    reduced: Reduced,
    manifold: ManifoldDocument,
    fixed_points: Vec<FixedPoint>,
    boundaries: BoundariesDocument,
    area: Area,
    /// Whether simulation had to tell Z1 from Z2, which closed form cannot.
    area_settled_by_simulation: bool,
    strip: Option<Strip>,
    /// Exact symmetric orbits of the full system; none are computed yet.
    orbits: [(); 0],
}

#[derive(Debug, Clone, Serialize)]
struct Reduced {
    mass_ratio: f64,
    damping: f64,
    restitution: f64,
    frequency_ratio: f64,
    detuning: f64,
    forcing_over_clearance: f64,
    excitation: Excitation,
}

#[derive(Debug, Clone, Serialize)]
struct ManifoldDocument {
    fold: ManifoldPoint,
    symmetry_breaking: ManifoldPoint,
}

#[derive(Debug, Clone, Serialize)]
struct BoundariesDocument {
    symmetry_breaking_clearance: f64,
    hopf_clearance: f64,
    saddle_node: Vec<SaddleNodeDocument>,
    codimension_two: crate::analysis::boundaries::CodimensionTwo,
}

#[derive(Debug, Clone, Serialize)]
struct SaddleNodeDocument {
    clearance: f64,
    #[serde(rename = "B")]
    absorber: f64,
    branch: Branch,
}

impl AnalysisDocument {
    /// The document of an analysis whose area has been settled.
    pub fn new(analysis: &Analysis, area: SettledArea, scales: &Scales) -> Self {
        let boundaries = &analysis.boundaries;
        let clearance = |gamma: f64| scales.forcing / gamma;
        Self {
            format: "vinesink/analysis@1",
            reduced: Reduced::of(&analysis.system),
            manifold: ManifoldDocument {
                fold: analysis.manifold.fold,
                symmetry_breaking: analysis.manifold.symmetry_breaking,
            },
            fixed_points: analysis.fixed_points.clone(),
            boundaries: BoundariesDocument {
                symmetry_breaking_clearance: clearance(boundaries.symmetry_breaking),
                hopf_clearance: clearance(boundaries.hopf),
                saddle_node: boundaries
                    .saddle_nodes
                    .iter()
                    .map(|node| SaddleNodeDocument {
                        clearance: clearance(node.forcing_over_clearance),
                        absorber: node.absorber,
                        branch: node.branch,
                    })
                    .collect(),
                codimension_two: boundaries.codimension_two,
            },
            area: area.area,
            area_settled_by_simulation: area.by_simulation,
            strip: analysis.zone.strip,
            orbits: [],
        }
    }
}

impl Reduced {
    fn of(system: &System) -> Self {
        Self {
            mass_ratio: system.mass_ratio(),
            damping: system.damping(),
            restitution: system.restitution(),
            frequency_ratio: system.frequency_ratio(),
            detuning: system.detuning(),
            forcing_over_clearance: system.forcing_per_clearance(),
            excitation: system.excitation(),
        }
    }
}

/// `vinesink/simulation@1`.
#[derive(Debug, Clone, Serialize)]
pub struct SimulationDocument {
    format: &'static str,
    #[serde(flatten)]
    motion: MotionDocument,
    /// Every long-term motion found, when no initial state was given.
    #[serde(skip_serializing_if = "Option::is_none")]
    attractors: Option<Vec<AttractorDocument>>,
}

/// A measured motion.
#[derive(Debug, Clone, Serialize)]
pub struct MotionDocument {
    periods: u64,
    impacts: u64,
    impacts_per_period: f64,
    regime: Regime,
    evidence: Evidence,
    displacement: Displacement,
    energy: Energy,
    sustained_contact: SustainedContact,
    largest_penetration_over_clearance: f64,
    stop: Stop,
}

#[derive(Debug, Clone, Copy, Serialize)]
struct Displacement {
    peak: f64,
    rms: f64,
    peak_over_clearance: f64,
    rms_over_clearance: f64,
}

/// An attractor and the share of starts that led to it.
#[derive(Debug, Clone, Serialize)]
pub struct AttractorDocument {
    starts: u32,
    share_of_starts: f64,
    reached_from_theory: bool,
    late_starts: u32,
    longest_transient_periods: u64,
    #[serde(flatten)]
    motion: MotionDocument,
}

impl SimulationDocument {
    /// The document of one motion, and of the attractors it was chosen from.
    pub fn new(motion: &Attractor, others: Option<&[FoundAttractor]>, scales: &Scales) -> Self {
        Self {
            format: "vinesink/simulation@1",
            motion: MotionDocument::new(motion, scales),
            attractors: others
                .map(|found| found.iter().map(|one| AttractorDocument::new(one, scales)).collect()),
        }
    }
}

impl AttractorDocument {
    /// The document of an attractor.
    pub fn new(found: &FoundAttractor, scales: &Scales) -> Self {
        Self {
            starts: found.starts,
            share_of_starts: found.share,
            reached_from_theory: found.reached_from_theory,
            late_starts: found.late_starts,
            longest_transient_periods: found.longest_transient,
            motion: MotionDocument::new(&found.attractor, scales),
        }
    }
}

impl MotionDocument {
    /// The document of a motion.
    pub fn new(motion: &Attractor, scales: &Scales) -> Self {
        let energy = |value: f64| {
            scales.energy_j(value).unwrap_or(value * scales.clearance * scales.clearance)
        };
        let balance = &motion.energy;
        Self {
            periods: motion.periods,
            impacts: motion.impact_count,
            impacts_per_period: motion.classification.evidence.impacts_per_period,
            regime: motion.classification.regime,
            evidence: motion.classification.evidence,
            displacement: Displacement {
                peak: scales.length(motion.peak),
                rms: scales.length(motion.rms),
                peak_over_clearance: motion.peak,
                rms_over_clearance: motion.rms,
            },
            energy: Energy {
                input: energy(balance.input),
                damper: energy(balance.damper),
                impact: energy(balance.impact),
                stored: energy(balance.stored),
                relative_residual: balance.relative_residual,
            },
            sustained_contact: motion.sustained_contact,
            largest_penetration_over_clearance: motion.penetration,
            stop: motion.stop,
        }
    }
}
