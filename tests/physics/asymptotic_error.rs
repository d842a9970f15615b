//! How wrong the leading-order theory is: its errors fall in proportion to the mass ratio.
//!
//! The truth is direct simulation of the full system, which knows nothing of the expansion. Scaling
//! eps at fixed sigma, lambda, r and gamma keeps the theory's answer and changes the motion; a wrong
//! coefficient anywhere in the leading order would leave an error that does not fall. The exact
//! orbits give the same errors without a transient, and those of the boundaries as well.

use crate::common;
use std::collections::BTreeMap;

use vinesink::analysis::Analysis;
use vinesink::analysis::motion::{read_off, state_of, wrapped};
use vinesink::motions::{Measured, Window};
use vinesink::orbits::{Bifurcation, ExactBoundaries, FullSystem, Measures, symmetric_orbits};
use vinesink::regimes::Regime;
use vinesink::system::{Cavity, Excitation, Parameters, System};
use vinesink::validation::asymptotic_error::asymptotic_errors;
use vinesink::validation::tolerance::asymptotic_error;

/// The mass ratio is multiplied by these.
const SCALES: [f64; 3] = [1.0, 0.25, 0.0625];
/// Frequency in Hz and clearance in mm, from next to symmetry breaking to next to the fold.
const CASES: [(f64, f64); 8] = [
    (8.0, 5.0),
    (8.0, 7.5),
    (8.0, 11.5),
    (8.0, 15.0),
    (8.5, 8.0),
    (8.5, 14.0),
    (8.5, 20.0),
    (8.5, 25.0),
];

/// Relative errors of `C` and `B`, absolute error of `eta`.
fn errors(system: &System, scale: f64) -> [f64; 3] {
    let analysis = Analysis::of(system).expect("analysable");
    let stable: Vec<_> = analysis.stable_points().collect();
    let [point] = stable.as_slice() else { panic!("one stable fixed point, not {stable:?}") };
    // Transients last some hundred periods over eps.
    let discard = (2000.0 / scale) as u64;
    let effort = Window { discard, periods: 20, impact_limit: 1_000_000 };
    let start = state_of(point, system);
    let reached = Measured::reach(system, start, &effort).expect("inside the cavity");
    assert_eq!(reached.classification.regime, Regime::TwoSymmetric, "eps scaled by {scale}");
    let seen = read_off(system, reached.oscillator_harmonic, reached.absorber_harmonic);
    [
        seen.oscillator_amplitude / point.oscillator_amplitude - 1.0,
        seen.absorber_amplitude / point.absorber_amplitude - 1.0,
        wrapped(seen.eta - point.eta),
    ]
}

fn scaled(system: &System, scale: f64) -> System {
    let mass_ratio = scale * system.mass_ratio();
    let scaled = System::new(Parameters { mass_ratio, ..system.parameters() }).expect("valid");
    scaled.with_detuning(system.detuning()).expect("a positive frequency")
}

#[test]
fn errors_of_the_theory_fall_in_proportion_to_the_mass_ratio() {
    for (frequency, clearance) in CASES {
        let base = common::table_1(frequency, clearance);
        let found = SCALES.map(|scale| errors(&scaled(&base, scale), scale));
        for quantity in 0..3 {
            let over_eps: Vec<f64> = found
                .iter()
                .zip(SCALES)
                .map(|(errors, scale)| errors[quantity] / (scale * base.mass_ratio()))
                .collect();
            // The next order changes error / eps by a multiple of eps, which a quarter of eps
            // quarters: 15 % from the first scale to the second, 4 % from there to the third.
            for (pair, change) in over_eps.windows(2).zip([0.15, 0.04]) {
                let drift = (pair[1] / pair[0] - 1.0).abs();
                assert!(drift < change, "{frequency} Hz, {clearance} mm: {over_eps:?}");
            }
            for (scale, errors) in SCALES.iter().zip(&found) {
                let bound = asymptotic_error(&scaled(&base, *scale));
                assert!(
                    errors[quantity].abs() < bound,
                    "{frequency} Hz, {clearance} mm: {errors:?}"
                );
            }
        }
    }
}

/// Relative errors of `C` and `B`, absolute errors of `eta` and `Theta`, against the exact orbit.
fn errors_by_exact_orbit(system: &System) -> [f64; 4] {
    let analysis = Analysis::of(system).expect("analysable");
    let point = *analysis.stable_points().next().expect("one");
    let orbits = symmetric_orbits(system).expect("damped");
    let orbit = orbits.iter().find(|orbit| orbit.orbit.attracts()).expect("one");
    let exact = Measures::of(system, &orbit.orbit.cycle).expect("damped");
    let seen = read_off(system, exact.oscillator_harmonic, exact.absorber_harmonic);
    [
        seen.oscillator_amplitude / point.oscillator_amplitude - 1.0,
        seen.absorber_amplitude / point.absorber_amplitude - 1.0,
        wrapped(seen.eta - point.eta),
        wrapped(seen.absorber_phase - point.absorber_phase),
    ]
}

/// Relative errors of the boundaries in forcing, of those that the exact families have.
fn errors_of_boundaries(system: &System) -> BTreeMap<Bifurcation, f64> {
    let theory = Analysis::of(system).expect("analysable").boundaries;
    let ExactBoundaries { symmetric: exact, asymmetric, .. } =
        ExactBoundaries::of(system).expect("damped");
    let asymmetric = asymmetric.expect("beyond symmetry breaking");
    let of_asymmetric = theory.of_asymmetric().map(|(kind, gamma)| {
        let doubles = kind == Bifurcation::PeriodDoubling;
        let clearance = if doubles { asymmetric.period_doubling } else { asymmetric.grazing };
        let exact = system.forcing_per_clearance() / clearance.expect("as by theory");
        (kind, gamma / exact - 1.0)
    });
    let node = theory.saddle_node.expect("one").forcing_over_clearance;
    let of_theory = |kind| match kind {
        Bifurcation::SymmetryBreaking => Some(theory.symmetry_breaking),
        Bifurcation::NeimarkSacker => Some(theory.hopf),
        Bifurcation::SaddleNode => Some(node),
        _ => None,
    };
    let limits = exact.limits.iter();
    limits
        .filter_map(|limit| {
            let exact = limit.forcing_over_clearance;
            Some((limit.kind, of_theory(limit.kind)? / exact - 1.0))
        })
        .chain(of_asymmetric)
        .collect()
}

/// Orders of convergence between successive mass ratios, each a quarter of the one before.
fn orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|pair| libm::log((pair[0] / pair[1]).abs()) / libm::log(4.0)).collect()
}

/// First order: what the second adds to the order quarters with the mass ratio. It begins with 0.35
/// where the first-order coefficient happens to be small (symmetry breaking at 8.5 Hz), elsewhere
/// with less than 0.1.
fn first_order(errors: &[f64], what: &str) {
    let orders = orders(errors);
    for (k, order) in orders.iter().enumerate() {
        let allowed = 0.6 / libm::pow(4.0, k as f64) + 1e-3;
        assert!((order - 1.0).abs() < allowed, "{what}: orders {orders:?}, errors {errors:?}");
    }
}

#[test]
fn amplitudes_and_phases_converge_to_exact_orbits_at_first_order() {
    for (frequency, clearance) in CASES {
        let base = common::table_1(frequency, clearance);
        let found: Vec<[f64; 4]> = (0..5)
            .map(|k| errors_by_exact_orbit(&scaled(&base, libm::pow(0.25, f64::from(k)))))
            .collect();
        for (quantity, name) in ["C", "B", "eta", "Theta"].iter().enumerate() {
            let errors: Vec<f64> = found.iter().map(|errors| errors[quantity]).collect();
            first_order(&errors, &format!("{name} at {frequency} Hz, {clearance} mm"));
        }
    }
}

#[test]
fn boundaries_converge_to_exact_ones_at_first_order() {
    for frequency in [8.0, 8.2, 8.5, 8.7] {
        let base = common::table_1(frequency, 10.0);
        let found: Vec<BTreeMap<Bifurcation, f64>> = (0..5)
            .map(|k| errors_of_boundaries(&scaled(&base, libm::pow(0.25, f64::from(k)))))
            .collect();
        // At 8 Hz the theory's Hopf lies on the saddle's side of the fold; the exact family has a
        // Neimark-Sacker point there only at small mass ratios.
        let kinds: Vec<Bifurcation> = found[0].keys().copied().collect();
        assert!(kinds.len() >= 4, "{found:?}");
        for kind in kinds {
            let errors: Vec<f64> = found.iter().map(|errors| errors[&kind]).collect();
            first_order(&errors, &format!("{} at {frequency} Hz", kind.words()));
        }
    }
}

/// The theory has one Hopf boundary, and these systems have two exact ones. Which of them it is about was found by hand: the
/// analysis at mass ratios a tenth smaller each time, detuning, damping and forcing as they are, down to 4e-4, where one of
/// them is within 2 % of the theory's and the other is elsewhere or gone. In the first three the one that is nearer now is the
/// wrong one.
#[test]
fn each_boundary_has_one_counterpart_by_continuation() {
    let systems = [
        (
            [0.021706993621104446, 1.29254999874258, 0.69, 1.4970857878389423],
            1.1142321020343064,
            [0.7347, 1.0633],
        ),
        (
            [0.09054223625381344, 2.0940902962802705, 0.685, 1.9704702632696096],
            1.2609355108417082,
            [1.1109, 1.7222],
        ),
        (
            [0.034916414718301404, 1.5376831916209246, 0.706, 3.24981956775633],
            1.1730451990782407,
            [1.5117, 2.4879],
        ),
        (
            [0.009651311225068342, 0.19084732451427405, 0.602, 1.0457202650725232],
            1.0129474985396378,
            [1.1607, 1.4612],
        ),
        (
            [0.00501613879335155, 0.47627744069596034, 0.668, 2.2611618187710816],
            0.9783724451277739,
            [1.4594, 0.9736],
        ),
    ];
    for ([mass_ratio, damping, restitution, forcing], frequency_ratio, [own, other]) in systems {
        let system = System::new(Parameters {
            mass_ratio,
            damping,
            restitution,
            frequency_ratio,
            forcing_per_clearance: forcing,
            excitation: Excitation::BaseDisplacement,
            cavity: Cavity::IDEAL,
        });
        let system = system.expect("valid");
        let analysis = Analysis::of(&system).expect("analysable");
        let errors = asymptotic_errors(&analysis, &FullSystem::of(&system));
        let hopf = errors.iter().filter(|one| one.kind == Bifurcation::NeimarkSacker);
        let hopf: Vec<(Option<f64>, f64)> =
            hopf.filter_map(|one| Some((one.theory, one.exact?))).collect();
        let theory = forcing / analysis.boundaries.hopf;
        let partner = |exact: f64| {
            let found = hopf.iter().find(|one| (one.1 / exact - 1.0).abs() < 1e-4);
            found.unwrap_or_else(|| panic!("{exact} is none of {hopf:?}")).0
        };
        assert_eq!(partner(other), None, "{hopf:?}");
        let found = partner(own).expect("the theory's");
        assert!((found / theory - 1.0).abs() < 1e-12, "{hopf:?}");
        for kind in errors.iter().map(|one| (one.kind, one.of_asymmetric)) {
            let same = errors.iter().filter(|one| (one.kind, one.of_asymmetric) == kind);
            let mut theory: Vec<u64> = same.filter_map(|one| Some(one.theory?.to_bits())).collect();
            let count = theory.len();
            theory.dedup();
            assert_eq!(theory.len(), count, "one to one: {errors:?}");
        }
    }
}
