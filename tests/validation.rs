//! Claims that only a case in a strip raises, by simulation against theory: Table 1 at 8 Hz in strip
//! A1, where an independent program found steady 1:1 resonance beside a modulated response.

mod common;

use vinesink::analysis::{Analysis, Strip};
use vinesink::orbits::FullSystem;
use vinesink::regimes::Regime;
use vinesink::study::{CaseStudy, StudyEffort};
use vinesink::system::{Parameters, System};
use vinesink::validation::{Check, Finding, Verdict, motions};

#[test]
fn in_strip_a1_answers_coexist_and_close_fixed_points_are_told_apart() {
    let system = common::table_1(8.0, 15.8);
    assert_eq!(Analysis::of(&system).expect("analysable").zone.strip, Some(Strip::A1));
    let study = CaseStudy::of(&system, StudyEffort::default(), &mut |_| ()).expect("studied");
    let found: Vec<Regime> = study.attractors.iter().map(|found| found.regime()).collect();
    for regime in [Regime::TwoSymmetric, Regime::BelowTwo, Regime::AtRest] {
        assert!(found.contains(&regime), "{regime:?} is missing from {found:?}");
    }
    let claim = |id: &str| {
        study.claims.iter().find(|claim| claim.id == id).unwrap_or_else(|| panic!("no {id}"))
    };
    assert_eq!(claim("area").verdict, Verdict::Confirmed, "{:?}", claim("area"));
    // The two fixed points are 6 % apart in B, less than the theory's own error: each must still be
    // held against its own exact orbit.
    let [unstable, stable] = ["fixed-point-1-stability", "fixed-point-2-stability"].map(claim);
    assert_eq!(unstable.predicted, Finding::Words("unstable".into()));
    assert_eq!(unstable.verdict, Verdict::Confirmed, "{unstable:?}");
    assert_eq!(stable.predicted, Finding::Words("stable".into()));
    assert_eq!(stable.verdict, Verdict::Confirmed, "{stable:?}");
    assert!([unstable, stable].iter().all(|claim| claim.checked_by == Check::ExactOrbit));
    // Simulation, in turn, confirms both orbits: one repeats and holds, one repeats and is left.
    for id in ["orbit-1-repeats", "orbit-2-repeats", "orbit-1-stability", "orbit-2-stability"] {
        assert_eq!(claim(id).checked_by, Check::Simulation);
        assert_eq!(claim(id).verdict, Verdict::Confirmed, "{:?}", claim(id));
    }
}

/// An undamped oscillator driven at its natural frequency has no steady motion that exact orbits could
/// be written with: what they cannot tell is undecided, not refuted.
#[test]
fn what_exact_orbits_cannot_tell_is_undecided() {
    let table = common::table_1(8.0, 15.0);
    let parameters = Parameters { damping: 0.0, frequency_ratio: 1.0, ..table.parameters() };
    let system = System::new(parameters).expect("valid");
    let analysis = Analysis::of(&system).expect("analysable");
    assert!(!analysis.fixed_points.is_empty());
    let exact = FullSystem::of(&system);
    for claim in motions::fixed_points(&analysis, &exact) {
        assert_eq!(claim.verdict, Verdict::Undecided, "{claim:?}");
    }
}

/// With half the oscillator's mass the neglected terms are as large as the theory: agreement would mean
/// nothing, so that no claim on an amplitude or a boundary gets a verdict.
#[test]
fn a_theory_that_may_be_off_by_half_of_itself_gets_no_verdict() {
    let table = common::table_1(8.0, 7.5);
    let heavy = System::new(Parameters { mass_ratio: 0.5, ..table.parameters() }).expect("valid");
    let analysis = Analysis::of(&heavy).expect("analysable");
    let exact = FullSystem::of(&heavy);
    let all = motions::fixed_points(&analysis, &exact).into_iter();
    let numbers: Vec<_> =
        all.filter(|claim| matches!(claim.predicted, Finding::Number(..))).collect();
    assert!(!numbers.is_empty());
    for claim in numbers {
        assert!(claim.tolerance.value > 0.5 && claim.tolerance.reason.contains("says nothing"));
        assert_eq!(claim.verdict, Verdict::Undecided, "{claim:?}");
    }
}
