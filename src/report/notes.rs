//! Notes under the verdict: what is probably a slip in the case, was refuted, has not settled, or lies outside the theory's range.

use serde::Serialize;

use super::criteria::Place;
use super::numbers::{LengthFormat, fixed, percent, significant};
use crate::case::Case;
use crate::simulation::{Doubt, Stop};
use crate::study::CaseStudy;
use crate::system::System;
use crate::validation::tolerance::{LARGEST_DAMPING, LARGEST_MASS_RATIO, LARGEST_OFFSET};
use crate::validation::{Finding, Measure, Verdict};

/// Something that must not be overlooked.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Note {
    /// One of `warning`, `refuted`, `unsettled`, `validity`, `numerics`.
    pub kind: &'static str,
    /// What.
    pub text: String,
}

/// Everything that limits what the report says.
pub fn notes(case: &Case, study: &CaseStudy) -> Vec<Note> {
    let mut notes = Vec::new();
    let mut note = |kind, text: String| notes.push(Note { kind, text });
    for Place { line, message, .. } in case.warnings().iter().map(Place::from) {
        let end = if message.ends_with('?') { "" } else { "." };
        note("warning", format!("Line {line} of the case: {message}{end}"));
    }
    for claim in study.claims.iter().filter(|claim| claim.verdict == Verdict::Refuted) {
        note(
            "refuted",
            format!(
                "{}: predicted {}, observed {}. Judged by: {}.",
                claim.statement,
                finding(case, &claim.predicted),
                finding(case, &claim.observed),
                claim.tolerance.reason
            ),
        );
    }
    for found in &study.attractors {
        let attractor = &found.attractor;
        let evidence = &attractor.classification.evidence;
        let regime = found.regime().words();
        if attractor.stop != Stop::EndTime {
            note(
                "unsettled",
                format!("{regime}: the run was ended by {}.", attractor.stop.words()),
            );
        } else if !evidence.settled {
            note(
                "unsettled",
                format!(
                    "{regime}: two halves of {} periods differ; the motion is intermittent or its transient is not over.",
                    attractor.periods
                ),
            );
        }
        // That a run was ended early has been said.
        let numerical = attractor
            .doubts()
            .into_iter()
            .filter(|doubt| !matches!(doubt, Doubt::Unfinished { .. }));
        for doubt in numerical {
            note(
                "numerics",
                format!("{regime}: not to be trusted, {}; {}.", doubt.words(), doubt.advice()),
            );
        }
    }
    let system = &study.analysis.system;
    for text in theory_limits(system) {
        note("validity", text);
    }
    for point in study.analysis.fixed_points.iter().filter(|point| !point.admissible) {
        note(
            "validity",
            format!(
                "The fixed point at B/b = {} is not a motion: the absorber would reach {} times the clearance between impacts.",
                significant(point.absorber_amplitude, 3),
                significant(point.largest_relative_displacement, 3)
            ),
        );
    }
    notes
}

/// Why the theory may not hold for a system, a sentence each.
pub(super) fn theory_limits(system: &System) -> Vec<String> {
    let mut said = Vec::new();
    if system.restitution() == 1.0 {
        said.push(
            "Elastic impacts lose nothing: at leading order the manifold attracts no motion."
                .to_owned(),
        );
    }
    if system.mass_ratio() > LARGEST_MASS_RATIO {
        said.push(format!(
            "The mass ratio {} is not small: the theory, an expansion in it, is out of its range.",
            significant(system.mass_ratio(), 3)
        ));
    }
    if (system.frequency_ratio() - 1.0).abs() > LARGEST_OFFSET {
        said.push(format!(
            "The excitation is {} away from resonance: the theory holds near 1:1 resonance only.",
            percent((system.frequency_ratio() - 1.0).abs())
        ));
    }
    let damping = system.mass_ratio() * system.damping();
    if damping > LARGEST_DAMPING {
        said.push(format!(
            "The oscillator is heavily damped (damping ratio {}): it has no resonance, and the theory is out of its range.",
            significant(0.5 * damping, 3)
        ));
    }
    said
}

/// A finding with its unit.
pub fn finding(case: &Case, finding: &Finding) -> String {
    let scales = case.scales();
    match finding {
        Finding::Number(value, Measure::LengthOverClearance) => {
            LengthFormat::of(&scales).with_digits(scales.length(*value), 4)
        }
        Finding::Number(value, Measure::Angle) => {
            format!("{} rad", fixed(*value, 3))
        }
        Finding::Words(words) => words.clone(),
    }
}
