//! What commands print on a terminal: templates over the same facts as a report.

use serde::Serialize;

use super::document::{MotionFacts, Scale, TheoryFacts, TheoryLimit};
use super::render::RenderError;
use super::template;
use crate::analysis::{Analysis, ManifoldPoint};
use crate::case::Case;
use crate::method::Method::Theory;
use crate::orbits::FullSystem;
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;
use crate::regimes::Attractor;
use crate::study::fidelity::Answers;
use crate::study::{LongTermMotions, Proof, SettledArea};

#[derive(Serialize)]
struct AnalysisPage<'a> {
    title: &'a str,
    limits: Vec<TheoryLimit>,
    theory: TheoryFacts,
    /// `B` and `C`.
    fold: [Quantity; 2],
    symmetry_breaking: [Quantity; 2],
    p1: PointOne,
    answers: Option<&'a Answers>,
}

/// Where saddle-node and Hopf meet.
#[derive(Serialize)]
struct PointOne {
    detuning: Quantity,
    forcing: Quantity,
    frequency: Quantity,
}

/// What theory and exact orbits say of a case.
///
/// # Errors
/// [`RenderError::Template`] if the template does not fit.
pub fn analysis(
    case: &Case,
    analysis: &Analysis,
    exact: &FullSystem,
    area: SettledArea,
    answers: Option<&Answers>,
) -> Result<String, RenderError> {
    let scale = Scale::of(case);
    let point = |point: &ManifoldPoint| {
        [
            scale.length(&of::ABSORBER_AMPLITUDE, point.absorber_amplitude, Theory),
            scale.length(&of::OSCILLATOR_AMPLITUDE, point.oscillator_amplitude, Theory),
        ]
    };
    let p1 = analysis.boundaries.codimension_two;
    let page = AnalysisPage {
        title: &case.title,
        limits: TheoryLimit::of(&analysis.system),
        theory: TheoryFacts::of(&scale, analysis, exact, area),
        fold: point(&analysis.manifold.fold),
        symmetry_breaking: point(&analysis.manifold.symmetry_breaking),
        p1: PointOne {
            detuning: Quantity::new(&of::DETUNING, p1.detuning, Theory),
            forcing: Quantity::new(&of::FORCING_PER_CLEARANCE, p1.forcing_over_clearance, Theory),
            frequency: scale.frequency(1.0 + analysis.system.mass_ratio() * p1.detuning, Theory),
        },
        answers,
    };
    template::render("analyze.txt", &scale.units(), &page)
}

#[derive(Serialize)]
struct SimulationPage<'a> {
    title: &'a str,
    motion: MotionFacts,
    motions: Option<Vec<MotionFacts>>,
}

/// What simulation found.
///
/// # Errors
/// As [`analysis`].
pub fn simulation(
    case: &Case,
    motion: &Attractor,
    found: Option<&LongTermMotions>,
) -> Result<String, RenderError> {
    let scale = Scale::of(case);
    let system = case.system();
    let all = found.map(|found| {
        let each = found.attractors.iter().zip(&found.proofs);
        each.map(|(one, proof)| MotionFacts::found(&scale, &system, one, proof.as_ref())).collect()
    });
    let proof = Proof::of(&system, motion);
    let page = SimulationPage {
        title: &case.title,
        motion: MotionFacts::measured(&scale, &system, motion, proof.as_ref()),
        motions: all,
    };
    template::render("simulate.txt", &scale.units(), &page)
}
