//! Tables of the exact layer: orbits, and boundaries beside those of the theory.

use super::numbers::{LengthFormat, fixed, signed_percent, significant};
use super::tables::{Table, table};
use super::verdict::relative;
use crate::analysis::{BoundaryKind, Branch};
use crate::case::{Case, Scales};
use crate::orbits::{Leading, SymmetricOrbit};
use crate::study::CaseStudy;
use crate::validation::asymptotic_error::counterpart;

/// The symmetric 1:1 orbits of the full system.
pub fn orbits(case: &Case, study: &CaseStudy) -> Table {
    let scales = case.scales();
    let lengths = LengthFormat::of(&scales);
    let length = |over_clearance: f64| lengths.with_digits(scales.length(over_clearance), 4);
    let rows = study.exact.orbits.iter().enumerate().map(|(index, orbit)| {
        [
            (index + 1).to_string(),
            length(orbit.impact_displacement),
            length(orbit.peaks.displacement),
            velocity(&scales, orbit.impact_speed),
            format!("{} rad", fixed(orbit.phase, 3)),
            multiplier(orbit),
            standing(orbit).to_owned(),
        ]
    });
    let columns = [
        ("No.", true),
        ("x at impact", true),
        ("Peak of x", true),
        ("Impact speed", true),
        ("Phase", true),
        ("Largest multiplier", false),
        ("Motion", false),
    ];
    table(columns, rows.collect())
}

/// A velocity in m/s, or in the case's own unit per radian of the natural oscillation.
fn velocity(scales: &Scales, dimensionless: f64) -> String {
    match scales.velocity_m_per_s(dimensionless) {
        Some(speed) => format!("{} m/s", significant(speed, 3)),
        None => format!("{} ω₀ units", significant(scales.length(dimensionless), 3)),
    }
}

fn multiplier(orbit: &SymmetricOrbit) -> String {
    let radius = orbit.orbit.multipliers.spectral_radius();
    let kind = match orbit.orbit.multipliers.leading() {
        Leading::ComplexPair => "complex pair",
        Leading::Positive => "positive",
        Leading::Negative => "negative",
    };
    format!("{}, {kind}", significant(radius, 4))
}

fn standing(orbit: &SymmetricOrbit) -> &'static str {
    let admissibility = &orbit.orbit.admissibility;
    if admissibility.sticks() {
        "none: the absorber would stay on the wall"
    } else if !admissibility.admissible {
        "none: the absorber would leave its cavity"
    } else if orbit.orbit.multipliers.stable() {
        "stable"
    } else {
        "unstable"
    }
}

/// Boundaries in clearance at the case's frequency and forcing: theory, full system, and the price.
pub fn boundaries(case: &Case, study: &CaseStudy) -> Table {
    let scales = case.scales();
    let lengths = LengthFormat::of(&scales);
    let length = |factor: f64| lengths.with_digits(scales.length(factor), 4);
    let none = || "\u{2013}".to_owned();
    let mut rows: Vec<(f64, [String; 6])> = study
        .asymptotic_errors
        .iter()
        .map(|price| {
            let place = price.exact.or(price.theory).unwrap_or(0.0);
            let theory = study.margins.clearance.iter().find(|m| Some(m.factor) == price.theory);
            let name = match theory {
                Some(found) if found.kind == BoundaryKind::Hopf => "Hopf (Neimark–Sacker)".into(),
                Some(found)
                    if found.kind == BoundaryKind::SaddleNode && found.branch != Branch::Stable =>
                {
                    format!("saddle-node of two unstable motions ({} branch)", found.branch.words())
                }
                _ => price.kind.words().to_owned(),
            };
            debug_assert!(theory.is_none_or(|found| counterpart(found.kind) == price.kind));
            let cells = [
                name,
                price.theory.map_or_else(none, length),
                price.exact.map_or_else(none, length),
                price.difference.map_or_else(none, signed_percent),
                relative(place),
                if price.bounds_stability { "yes" } else { "no" }.to_owned(),
            ];
            (place, cells)
        })
        .collect();
    let asymmetric = study.exact.boundaries.iter().filter_map(|found| found.asymmetric.as_ref());
    for found in asymmetric {
        let more = [
            ("period doubling of the asymmetric motion", found.period_doubling),
            ("grazing: a third impact, Z2 to Z1", found.grazing),
        ];
        for (name, at) in more {
            let Some(at) = at else { continue };
            let cells =
                [name.to_owned(), none(), length(at), none(), relative(at), "no".to_owned()];
            rows.push((at, cells));
        }
    }
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    table(
        [
            ("Boundary", false),
            ("Theory", true),
            ("Exact", true),
            ("Theory's error", true),
            ("From this case", true),
            ("Bounds steady 1:1", false),
        ],
        rows.into_iter().map(|(_, cells)| cells).collect(),
    )
}
