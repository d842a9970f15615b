//! How wrong the leading-order theory is: its errors fall in proportion to the mass ratio.
//!
//! The truth is direct simulation of the full system, which knows nothing of the expansion. Scaling
//! eps at fixed sigma, lambda, r and gamma keeps the theory's answer and changes the motion; a wrong
//! coefficient anywhere in the leading order would leave an error that does not fall.

mod common;

use vinesink::analysis::Analysis;
use vinesink::analysis::motion::{read_off, state_of, wrapped};
use vinesink::regimes::attractor::Effort;
use vinesink::regimes::{Attractor, Regime};
use vinesink::system::{Parameters, System};
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
    let effort = Effort { discard, periods: 20, prolongations: 0, impact_limit: 1_000_000 };
    let start = state_of(point, system);
    let reached = Attractor::reach(system, start, &effort).expect("inside the cavity");
    assert_eq!(reached.classification.regime, Regime::TwoSymmetric, "eps scaled by {scale}");
    let seen = read_off(system, reached.oscillator_harmonic, reached.absorber_harmonic);
    [
        seen.oscillator / point.oscillator - 1.0,
        seen.absorber / point.absorber - 1.0,
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
