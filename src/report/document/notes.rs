//! What a reader must not overlook.

use serde::Serialize;

use super::place::Place;
use crate::case::Case;
use crate::method::Method;
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;
use crate::study::CaseStudy;
use crate::system::System;
use crate::validation::Verdict;
use crate::validation::tolerance::{LARGEST_DAMPING, LARGEST_MASS_RATIO, LARGEST_OFFSET};

/// Something that limits what a report says.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Note {
    /// Probably a slip in the case file.
    Warning {
        /// Where, and what.
        #[serde(flatten)]
        place: Place,
    },
    /// A claim was refuted.
    Refuted {
        /// Its index in the claims.
        claim: usize,
    },
    /// A run ended early.
    Stopped {
        /// Index of the motion.
        motion: usize,
    },
    /// Two halves of a run differ.
    NotStationary {
        /// Index of the motion.
        motion: usize,
    },
    /// The numbers of a run are not to be trusted.
    Doubtful {
        /// Index of the motion.
        motion: usize,
    },
    /// The theory may not hold.
    Limit {
        /// Why.
        #[serde(flatten)]
        limit: TheoryLimit,
    },
    /// A fixed point at which the absorber would leave its cavity.
    NotAdmissible {
        /// Its index.
        point: usize,
    },
}

/// Why the theory may not hold for a system.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "limit", rename_all = "kebab-case")]
pub enum TheoryLimit {
    /// Elastic impacts: at leading order the manifold attracts no motion.
    Elastic,
    /// The mass ratio is not small.
    MassRatio {
        /// The mass ratio.
        value: Quantity,
    },
    /// The excitation is far from resonance.
    Offset {
        /// Distance from it over the natural frequency.
        value: Quantity,
    },
    /// The oscillator has no resonance.
    Damping {
        /// Its damping ratio.
        value: Quantity,
    },
}

impl TheoryLimit {
    /// Those of a system.
    pub fn of(system: &System) -> Vec<Self> {
        let offset = (system.frequency_ratio() - 1.0).abs();
        let damping = system.mass_ratio() * system.damping();
        let share = |kind, value| Quantity::new(kind, value, Method::Given);
        let all = [
            (system.restitution() == 1.0, Self::Elastic),
            (
                system.mass_ratio() > LARGEST_MASS_RATIO,
                Self::MassRatio { value: share(&of::MASS_RATIO, system.mass_ratio()) },
            ),
            (offset > LARGEST_OFFSET, Self::Offset { value: share(&of::OFFSET, offset) }),
            (
                damping > LARGEST_DAMPING,
                Self::Damping { value: share(&of::DAMPING_RATIO, 0.5 * damping) },
            ),
        ];
        all.into_iter().filter_map(|(holds, limit)| holds.then_some(limit)).collect()
    }
}

/// All notes of a case.
pub fn notes(case: &Case, study: &CaseStudy) -> Vec<Note> {
    let warnings = case.warnings().iter().map(|one| Note::Warning { place: Place::from(one) });
    let claims = study.claims.iter().enumerate();
    let refuted = claims
        .filter(|(_, claim)| claim.verdict == Verdict::Refuted)
        .map(|(claim, _)| Note::Refuted { claim });
    let runs = study.attractors.iter().enumerate().flat_map(|(motion, found)| {
        use crate::simulation::{Doubt, Stop};
        let attractor = &found.attractor;
        let early = attractor.stop != Stop::EndTime;
        let drifts = !early && !attractor.classification.evidence.settled;
        // That a run was ended early is said once.
        let doubtful =
            attractor.doubts().iter().any(|doubt| !matches!(doubt, Doubt::Unfinished { .. }));
        let all = [
            (early, Note::Stopped { motion }),
            (drifts, Note::NotStationary { motion }),
            (doubtful, Note::Doubtful { motion }),
        ];
        all.into_iter().filter_map(|(holds, note)| holds.then_some(note))
    });
    let limits = TheoryLimit::of(&study.analysis.system).into_iter();
    let points = study.analysis.fixed_points.iter().enumerate();
    let outside = points
        .filter(|(_, point)| !point.admissible)
        .map(|(point, _)| Note::NotAdmissible { point });
    let limits = limits.map(|limit| Note::Limit { limit });
    warnings.chain(refuted).chain(runs).chain(limits).chain(outside).collect()
}
