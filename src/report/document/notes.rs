//! What a reader must not overlook.

use serde_json::{Value, json};

use super::place::FilePlace;
use crate::case::Case;
use crate::method::Method;
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;
use crate::simulation::{Doubt, Stop};
use crate::study::CaseStudy;
use crate::system::System;
use crate::validation::Verdict;
use crate::validation::tolerance::{LARGEST_DAMPING, LARGEST_MASS_RATIO, LARGEST_OFFSET};

/// Why the theory may not hold for a system: elastic impacts, a mass ratio that is not small, an excitation
/// far from resonance, an oscillator without resonance.
pub fn theory_limits(system: &System) -> Vec<Value> {
    let offset = (system.frequency_ratio() - 1.0).abs();
    let damping = system.mass_ratio() * system.damping();
    let limit = |limit: &str, kind, value| json!({ "limit": limit, "value": Quantity::new(kind, value, Method::Given) });
    let all = [
        // At leading order the manifold attracts no motion.
        (system.restitution() == 1.0, json!({ "limit": "elastic" })),
        (
            system.mass_ratio() > LARGEST_MASS_RATIO,
            limit("mass-ratio", &of::MASS_RATIO, system.mass_ratio()),
        ),
        (offset > LARGEST_OFFSET, limit("offset", &of::OFFSET, offset)),
        (damping > LARGEST_DAMPING, limit("damping", &of::DAMPING_RATIO, 0.5 * damping)),
    ];
    all.into_iter().filter_map(|(holds, limit)| holds.then_some(limit)).collect()
}

/// Everything that limits what a report says. Claims, motions and fixed points by their index.
pub fn notes(case: &Case, study: &CaseStudy) -> Vec<Value> {
    let noted = |kind: &str, mut note: Value| {
        note["kind"] = json!(kind);
        note
    };
    let warnings = case.warnings().iter().map(|one| noted("warning", json!(FilePlace::from(one))));
    let claims = study.claims.iter().enumerate();
    let refuted = claims
        .filter(|(_, claim)| claim.verdict == Verdict::Refuted)
        .map(|(claim, _)| noted("refuted", json!({ "claim": claim })));
    let runs = study.each().enumerate().flat_map(|(index, (motion, measured))| {
        let early = measured.stop != Stop::EndTime;
        // That a run was ended early is said once.
        let doubtful =
            measured.doubts().iter().any(|doubt| !matches!(doubt, Doubt::Unfinished { .. }));
        let all = [
            ("stopped", early),
            // It may be a transient.
            ("not-settled", !early && !motion.settled()),
            ("doubtful", doubtful),
        ];
        let notes = all.into_iter().filter(|(_, holds)| *holds);
        notes.map(move |(kind, _)| noted(kind, json!({ "motion": index })))
    });
    let limits = theory_limits(&study.analysis.system).into_iter();
    let limits = limits.map(|limit| noted("limit", limit));
    let points = study.analysis.fixed_points.iter().enumerate();
    let outside = points
        .filter(|(_, point)| !point.admissible && study.analysis.system.cavity().is_ideal())
        .map(|(point, _)| noted("not-admissible", json!({ "point": point })));
    warnings.chain(refuted).chain(runs).chain(limits).chain(outside).collect()
}
