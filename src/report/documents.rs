//! The JSON documents that other programs read: `vinesink/analysis@1` and `vinesink/simulation@1`.
//!
//! Lengths named `_over_clearance`, and `B` and `C`, are over the clearance; other lengths are in
//! metres for a physical case and in the case's own unit for a reduced one. Energies are in joules,
//! or per `m1 omega0^2` in the case's own unit of length squared. Angles are in radians.

use serde::Serialize;

use super::document::place::Place;
use crate::analysis::{Analysis, Area, Branch, FixedPoint, ManifoldPoint, Strip};
use crate::case::{Problem, Scales};
use crate::method::Method;
use crate::orbits::{
    AsymmetricOrbits, Bifurcation, Closure, FullSystem, Leading, Origin, SymmetricOrbit,
};
use crate::regimes::{Attractor, DynamicsKind, Energetics, Evidence, FoundAttractor, Regime};
use crate::simulation::{Doubt, Energy, Stop, SustainedContact};
use crate::study::fidelity::Answers;
use crate::study::{LongTermMotions, Proof, SettledArea};
use crate::system::{Excitation, System};
use crate::validation::asymptotic_error::asymptotic_errors;

/// `vinesink/analysis@1`.
#[derive(Debug, Clone, Serialize)]
pub struct AnalysisDocument {
    format: &'static str,
    reduced: Reduced,
    manifold: ManifoldDocument,
    fixed_points: Vec<FixedPoint>,
    boundaries: BoundariesDocument,
    area: Area,
    /// The layer that told the area; closed form cannot tell Z1 from Z2.
    area_settled_by: Method,
    strip: Option<Strip>,
    /// Exact symmetric orbits of the full system.
    orbits: Vec<OrbitDocument>,
    /// Boundaries of the full system, beside those of the theory.
    exact_boundaries: Vec<ExactBoundaryDocument>,
    /// The two asymmetric impacts beyond symmetry breaking.
    asymmetric_orbits: Option<AsymmetricDocument>,
    /// Which layer answered what; lengths over the clearance.
    #[serde(skip_serializing_if = "Option::is_none")]
    answers: Option<Answers>,
    /// What is probably a slip in the case; left out where nothing is.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<Place>,
}

/// A symmetric 1:1 orbit of the full system.
#[derive(Debug, Clone, Serialize)]
struct OrbitDocument {
    impact_displacement: f64,
    peak_displacement: f64,
    /// In metres a second for a physical case, else in the case's unit per fast time.
    peak_velocity: f64,
    /// Relative, in the same unit.
    impact_speed: f64,
    /// Momentum handed over in an impact, over the oscillator's mass, in the same unit.
    impulse_per_mass: f64,
    phase: f64,
    multipliers: [[f64; 2]; 4],
    spectral_radius: f64,
    leading_multiplier: Leading,
    admissible: bool,
    /// Smallest distance to a wall between impacts.
    room_over_clearance: f64,
    stable: bool,
    residual: f64,
    sequence: String,
    impacts: usize,
    periods: u32,
    origin: Origin,
}

#[derive(Debug, Clone, Serialize)]
struct ExactBoundaryDocument {
    kind: Bifurcation,
    clearance: Option<f64>,
    bracket: Option<[f64; 2]>,
    test_function: &'static str,
    test: Option<f64>,
    theory: Option<f64>,
    /// Theory minus exact, relative to the exact.
    error_of_theory: Option<f64>,
    bounds_stability: bool,
}

#[derive(Debug, Clone, Serialize)]
struct AsymmetricDocument {
    symmetry_breaking_clearance: f64,
    period_doubling_clearance: Option<f64>,
    grazing_clearance: Option<f64>,
    sequence_beyond_grazing: Option<String>,
    attracting: bool,
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
    pub fn new(
        analysis: &Analysis,
        exact: &FullSystem,
        area: SettledArea,
        scales: &Scales,
    ) -> Self {
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
                    .saddle_node
                    .iter()
                    .map(|node| SaddleNodeDocument {
                        clearance: clearance(node.forcing_over_clearance),
                        absorber: node.absorber_amplitude,
                        branch: node.branch,
                    })
                    .collect(),
                codimension_two: boundaries.codimension_two,
            },
            area: area.area,
            area_settled_by: area.by,
            strip: analysis.zone.strip,
            orbits: exact.orbits.iter().map(|orbit| OrbitDocument::new(orbit, scales)).collect(),
            exact_boundaries: exact_boundaries(analysis, exact, scales),
            asymmetric_orbits: exact
                .boundaries
                .as_ref()
                .and_then(|found| found.asymmetric.as_ref())
                .map(|found| AsymmetricDocument::new(found, scales)),
            answers: None,
            warnings: Vec::new(),
        }
    }

    /// The same with answers to what the case asks for.
    #[must_use]
    pub fn with_answers(self, answers: Option<Answers>) -> Self {
        Self { answers, ..self }
    }

    /// The same with what is probably a slip in the case.
    #[must_use]
    pub fn with_warnings(self, warnings: &[Problem]) -> Self {
        Self { warnings: warnings.iter().map(Place::from).collect(), ..self }
    }
}

impl OrbitDocument {
    fn new(orbit: &SymmetricOrbit, scales: &Scales) -> Self {
        let SymmetricOrbit { orbit: found, .. } = orbit;
        let velocity = |value: f64| scales.velocity(value);
        Self {
            impact_displacement: scales.length(orbit.impact_displacement),
            peak_displacement: scales.length(orbit.peaks.displacement),
            peak_velocity: velocity(orbit.peaks.velocity),
            impact_speed: velocity(orbit.impact_speed),
            impulse_per_mass: velocity(orbit.impulse),
            phase: orbit.phase,
            multipliers: found.multipliers.values,
            spectral_radius: found.multipliers.spectral_radius(),
            leading_multiplier: found.multipliers.leading(),
            admissible: found.admissibility.admissible,
            room_over_clearance: found.admissibility.min_wall_distance,
            stable: found.attracts(),
            residual: found.convergence.residual,
            sequence: found.cycle.sequence(),
            impacts: found.cycle.impact_count(),
            periods: found.cycle.periods(),
            origin: found.origin,
        }
    }
}

impl AsymmetricDocument {
    fn new(found: &AsymmetricOrbits, scales: &Scales) -> Self {
        Self {
            symmetry_breaking_clearance: scales.length(found.symmetry_breaking),
            period_doubling_clearance: found.period_doubling.map(|at| scales.length(at)),
            grazing_clearance: found.grazing.map(|at| scales.length(at)),
            sequence_beyond_grazing: found.sequence_beyond.clone(),
            attracting: found.attracting,
        }
    }
}

/// The boundaries of both layers, with the evidence of the exact ones.
fn exact_boundaries(
    analysis: &Analysis,
    exact: &FullSystem,
    scales: &Scales,
) -> Vec<ExactBoundaryDocument> {
    let limits = exact.boundaries.iter().flat_map(|found| &found.symmetric.limits);
    let limits: Vec<_> = limits.collect();
    asymptotic_errors(analysis, exact)
        .into_iter()
        .map(|price| {
            let limit = limits.iter().find(|limit| Some(limit.clearance) == price.exact);
            ExactBoundaryDocument {
                kind: price.kind,
                clearance: price.exact.map(|at| scales.length(at)),
                bracket: limit.map(|limit| limit.bracket.map(|at| scales.length(at))),
                test_function: price.kind.test_function(),
                test: limit.map(|limit| limit.test),
                theory: price.theory.map(|at| scales.length(at)),
                error_of_theory: price.difference,
                bounds_stability: price.bounds_stability,
            }
        })
        .collect()
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
    /// What is probably a slip in the case; left out where nothing is.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<Place>,
}

/// A measured motion.
#[derive(Debug, Clone, Serialize)]
pub struct MotionDocument {
    periods: u64,
    impacts: u64,
    impacts_per_period: f64,
    regime: Regime,
    dynamics: DynamicsKind,
    /// Dimensionless: per m1, lengths over the clearance, fast time.
    energetics: Energetics,
    evidence: Evidence,
    displacement: Displacement,
    /// How well averages are known, where the motion does not repeat.
    two_standard_errors: Option<ErrorsDocument>,
    /// Largest relative speed of an impact, in metres a second for a physical case, else in the case's
    /// unit per fast time.
    impact_speed: f64,
    /// By how much a run ten times as long may exceed the largest values, at odds of 19 to 1, where the
    /// motion does not repeat.
    errors_of_largest: Option<LargestDocument>,
    /// Whether the transient is over.
    settled: bool,
    energy: Energy,
    sustained_contact: SustainedContact,
    largest_penetration_over_clearance: f64,
    stop: Stop,
    /// Whether there is no reason to doubt the numbers.
    trusted: bool,
    doubts: Vec<DoubtDocument>,
}

/// A reason not to trust a motion, with its numbers.
#[derive(Debug, Clone, Serialize)]
struct DoubtDocument {
    #[serde(flatten)]
    doubt: Doubt,
    words: String,
    advice: &'static str,
}

#[derive(Debug, Clone, Copy, Serialize)]
struct Displacement {
    peak: f64,
    rms: f64,
    peak_over_clearance: f64,
    rms_over_clearance: f64,
}

/// Two standard errors of averages over a motion that does not repeat.
#[derive(Debug, Clone, Copy, Serialize)]
struct ErrorsDocument {
    rms_over_clearance: f64,
    impacts_per_period: f64,
}

/// Errors of the largest values of a motion that does not repeat, in the units of those values.
#[derive(Debug, Clone, Copy, Serialize)]
struct LargestDocument {
    peak: f64,
    peak_over_clearance: f64,
    impact_speed: f64,
}

/// An attractor and the share of starts that led to it.
#[derive(Debug, Clone, Serialize)]
pub struct AttractorDocument {
    starts: u32,
    share_of_starts: f64,
    share_interval_95: [f64; 2],
    reached_from_theory: bool,
    late_starts: u32,
    longest_transient_periods: u64,
    /// The exact orbit that the motion is, where Newton's method converges to one.
    proof: Option<ProofDocument>,
    #[serde(flatten)]
    motion: MotionDocument,
}

/// An exact orbit that proves a motion periodic.
#[derive(Debug, Clone, Serialize)]
struct ProofDocument {
    sequence: String,
    impacts: usize,
    periods: u32,
    /// Of the whole orbit, or of half of it where it equals its mirror image.
    multipliers: [[f64; 2]; 4],
    mirrors_itself: bool,
    spectral_radius_per_period: f64,
    residual: f64,
    admissible: bool,
    origin: Origin,
    distance_from_simulation: f64,
}

impl ProofDocument {
    fn new(proof: &Proof) -> Self {
        let orbit = &proof.orbit;
        Self {
            sequence: orbit.cycle.sequence(),
            impacts: orbit.cycle.impact_count(),
            periods: orbit.cycle.periods(),
            multipliers: orbit.multipliers.values,
            mirrors_itself: matches!(orbit.cycle.closure, Closure::Mirrors { .. }),
            spectral_radius_per_period: orbit.radius_per_period(),
            residual: orbit.convergence.residual,
            admissible: orbit.admissibility.admissible,
            origin: orbit.origin,
            distance_from_simulation: proof.distance,
        }
    }
}

impl SimulationDocument {
    /// The document of one motion, and of those it was chosen from.
    pub fn new(motion: &Attractor, others: Option<&LongTermMotions>, scales: &Scales) -> Self {
        Self {
            format: "vinesink/simulation@1",
            motion: MotionDocument::new(motion, scales),
            attractors: others.map(|found| {
                let proven = found.attractors.iter().zip(&found.proofs);
                proven
                    .map(|(one, proof)| AttractorDocument::new(one, proof.as_ref(), scales))
                    .collect()
            }),
            warnings: Vec::new(),
        }
    }

    /// The same with what is probably a slip in the case.
    #[must_use]
    pub fn with_warnings(self, warnings: &[Problem]) -> Self {
        Self { warnings: warnings.iter().map(Place::from).collect(), ..self }
    }
}

impl AttractorDocument {
    /// The document of an attractor.
    pub fn new(found: &FoundAttractor, proof: Option<&Proof>, scales: &Scales) -> Self {
        Self {
            starts: found.starts,
            share_of_starts: found.share,
            share_interval_95: found.share_interval,
            reached_from_theory: found.reached_from_theory,
            late_starts: found.late_starts,
            longest_transient_periods: found.longest_transient,
            proof: proof.map(ProofDocument::new),
            motion: MotionDocument::new(&found.attractor, scales),
        }
    }
}

impl MotionDocument {
    /// The document of a motion.
    pub fn new(motion: &Attractor, scales: &Scales) -> Self {
        let energy = |value: f64| scales.energy(value);
        let velocity = |value: f64| scales.velocity(value);
        let balance = &motion.energy;
        let doubts = motion.doubts();
        Self {
            periods: motion.periods,
            impacts: motion.impact_count,
            impacts_per_period: motion.classification.evidence.impacts_per_period,
            regime: motion.classification.regime,
            dynamics: motion.classification.dynamics,
            energetics: motion.energetics,
            evidence: motion.classification.evidence,
            displacement: Displacement {
                peak: scales.length(motion.peak),
                rms: scales.length(motion.rms),
                peak_over_clearance: motion.peak,
                rms_over_clearance: motion.rms,
            },
            two_standard_errors: motion.errors().map(|[rms_over_clearance, impacts_per_period]| {
                ErrorsDocument { rms_over_clearance, impacts_per_period }
            }),
            impact_speed: velocity(motion.impact_speed),
            errors_of_largest: (!motion.repeats()).then(|| LargestDocument {
                peak: scales.length(motion.peak_error),
                peak_over_clearance: motion.peak_error,
                impact_speed: velocity(motion.impact_speed_error),
            }),
            settled: motion.settled,
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
            trusted: doubts.is_empty(),
            doubts: doubts
                .into_iter()
                .map(|doubt| DoubtDocument { doubt, words: doubt.words(), advice: doubt.advice() })
                .collect(),
        }
    }
}
