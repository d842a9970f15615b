//! Claims that only a case in a strip raises, by simulation against theory: Table 1 at 8 Hz in strip
//! A1, where an independent program found steady 1:1 resonance beside a modulated response.

use crate::common;
use vinesink::analysis::{Analysis, Strip};
use vinesink::executor::Serial;
use vinesink::method::Method;
use vinesink::motions::{Effort, Measured, Motion, Motions, Place, measured, motions as search};
use vinesink::orbits::FullSystem;
use vinesink::regimes::Regime;
use vinesink::study::CaseStudy;
use vinesink::system::{Cavity, Excitation, Parameters, System};
use vinesink::validation::{Finding, ReachedMotion, Reason, Verdict, motions, orbits};

#[test]
fn in_strip_a1_answers_coexist_and_close_fixed_points_are_told_apart() {
    let system = common::table_1(8.0, 15.8);
    assert_eq!(Analysis::of(&system).expect("analysable").zone.strip, Some(Strip::A1));
    let motions = found(Place::new(&system, 32));
    let study = CaseStudy::of(&system, &motions, Effort::default()).expect("studied");
    let found: Vec<Regime> = study.motions.iter().map(Motion::regime).collect();
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
    let predicted = |stable| Finding::Stability { stable, multiplier: None };
    assert_eq!(unstable.predicted, predicted(false));
    assert_eq!(unstable.verdict, Verdict::Confirmed, "{unstable:?}");
    assert_eq!(stable.predicted, predicted(true));
    assert_eq!(stable.verdict, Verdict::Confirmed, "{stable:?}");
    assert!([unstable, stable].iter().all(|claim| claim.checked_by == Method::ExactOrbit));
    // Simulation, in turn, confirms both orbits: one repeats and holds, one repeats and is left.
    for id in ["orbit-1-repeats", "orbit-2-repeats", "orbit-1-stability", "orbit-2-stability"] {
        assert_eq!(claim(id).checked_by, Method::Simulation);
        assert_eq!(claim(id).verdict, Verdict::Confirmed, "{:?}", claim(id));
    }
}

fn found(place: Place) -> Motions {
    search(&[place], &Effort::default(), &Serial).expect("finite").remove(0)
}

/// Table 1 at 8 Hz and 15 mm: from a fifth of the starts a chaotic motion lasts for some 100,000 periods
/// beside the steady one, of which some are watched. Whether it is seen to end is decided by the last
/// digit of the frequency, the verdict on the area is not; from starts that all lead to the steady one it is confirmed.
#[test]
fn an_area_that_rounding_decides_is_undecided() {
    let table = common::table_1(8.0, 15.0).parameters();
    let verdict = |system: &System, motions: &Motions| {
        let analysis = Analysis::of(system).expect("analysable");
        let each = motions.iter();
        let each = each.map(|one| measured(system, one, &Effort::default(), &mut Measured::log()));
        let each: Vec<Measured> = each.collect::<Result<_, _>>().expect("finite");
        let claim = motions::area(&analysis, motions, &each);
        let told = matches!(claim.reason, Reason::Starts { by_chance: true, .. });
        assert_eq!(told, claim.verdict == Verdict::Undecided, "{claim:?}");
        claim.verdict
    };
    for digit in 0..8 {
        let frequency_ratio = table.frequency_ratio * (1.0 + 1e-15 * f64::from(digit));
        let system = System::new(Parameters { frequency_ratio, ..table }).expect("valid");
        let motions = found(Place::new(&system, 32));
        assert_eq!(verdict(&system, &motions), Verdict::Undecided, "{digit}");
        let steady = motions.iter().find(|one| one.is_one_to_one()).expect("it attracts");
        let alone = found(Place::with(&system, vec![steady.state(); 4]));
        assert_eq!(verdict(&system, &alone), Verdict::Confirmed, "{digit}");
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
    let numbers: Vec<_> = all
        .filter(|claim| matches!(claim.predicted, Finding::Length(_) | Finding::Angle(_)))
        .collect();
    assert!(!numbers.is_empty());
    for claim in numbers {
        assert!(claim.tolerance > 0.5);
        assert_eq!(claim.reason, Reason::NeglectedTerms { says_nothing: true });
        assert_eq!(claim.verdict, Verdict::Undecided, "{claim:?}");
    }
}

/// 3 % of mass at resonance: 1 % above the clearance at which the orbit loses stability in a supercritical
/// Neimark–Sacker bifurcation the motion still has two symmetric impacts in every period, and yet is
/// modulated, which is what the limit predicts.
#[test]
fn a_small_torus_beyond_a_limit_is_no_steady_motion() {
    let parameters = Parameters {
        mass_ratio: 0.03,
        damping: 1.0 / 3.0,
        restitution: 0.6,
        frequency_ratio: 8.0 * std::f64::consts::TAU / (30_320.0_f64 / 12.0).sqrt(),
        forcing_per_clearance: 0.01 / 0.02,
        excitation: Excitation::BaseDisplacement,
        cavity: Cavity::IDEAL,
    };
    let exact = FullSystem::of(&System::new(parameters).expect("valid"));
    let claims = orbits::limits(&exact).expect("simulated");
    let [limit] = claims.as_slice() else { panic!("{claims:?}") };
    assert_eq!(limit.id, "limit-Neimark-Sacker");
    let predicted = Finding::Steady { below: true, above: false, rests: false };
    assert_eq!(limit.predicted, predicted);
    let reached =
        |repeats_after| ReachedMotion { regime: Regime::TwoSymmetric, repeats_after, rests: false };
    let seen = Finding::Reached { below: reached(Some(1)), above: reached(None) };
    assert_eq!((&limit.observed, limit.verdict), (&seen, Verdict::Confirmed));
}
