//! The theory of several absorbers: published and independent values, and against exact orbits, of first order in the mass ratio.

use vinesink_core::analysis::{AbsorberGroup, Analysis, Grading, GroupFixedPoint};
use vinesink_core::system::{ModalSystem, System};

use super::cases::{EPS, mode, one_by_one, system, table1, two_by_two};
use super::orbits::attracting;

fn stable(system: &ModalSystem) -> GroupFixedPoint {
    let group = AbsorberGroup::of(system, 0).expect("seen");
    let points = group.fixed_points();
    let mut stable: Vec<GroupFixedPoint> =
        points.iter().filter(|point| point.stable).cloned().collect();
    assert_eq!(stable.len(), 1, "{points:?}");
    stable.remove(0)
}

#[test]
fn amplitudes_are_the_known_ones() {
    for (absorbers, expected) in [
        (vec![[EPS, 20.0, 0.6]], 3.63919),
        (vec![[0.5 * EPS, 20.0, 0.6], [0.5 * EPS, 10.0, 0.6]], 3.93920),
        (vec![[0.3 * EPS, 20.0, 0.6], [0.3 * EPS, 12.0, 0.7], [0.4 * EPS, 8.0, 0.5]], 4.09905),
    ] {
        let found = stable(&table1(&[], &absorbers)).amplitude;
        assert!((found - expected).abs() < 5.1e-6, "{found} {expected}");
    }
    for (name, expected) in [('B', 4.0), ('D', 2.0)] {
        let found = stable(&two_by_two(name)).amplitude;
        assert!((found - expected).abs() < 1e-9, "{name}: {found}");
    }
}

#[test]
fn gradings_are_the_known_ones() {
    for (r, lower, upper, ratio) in [
        (0.3, 0.3243, 0.8926, 2.75),
        (0.4, 0.2632, 0.8215, 3.12),
        (0.5, 0.2076, 0.7692, 3.71),
        (0.6, 0.1572, 0.7321, 4.66),
        (0.7, 0.1116, 0.7072, 6.33),
        (0.8, 0.0706, 0.6918, 9.80),
        (0.9, 0.0335, 0.6838, 20.4),
    ] {
        let found = Grading::of(r);
        assert!((found.lower - lower).abs() < 5.1e-5 && (found.upper - upper).abs() < 5.1e-5);
        let digits = if ratio > 10.0 { 0.051 } else { 0.0051 };
        assert!((found.ratio - ratio).abs() < digits, "{r}: {found:?}");
    }
}

/// One absorber has the fixed points of the theory for one, with trace and determinant in other variables.
#[test]
fn one_absorber_has_the_theory_for_one() {
    for (omega, gamma) in [(1.0181, 1.6), (0.958, 4.34), (0.99, 1.2)] {
        let clearance = 3.0;
        let (one, several): (System, ModalSystem) =
            one_by_one([EPS, 1.799, 0.6, omega, gamma], clearance);
        let known = Analysis::of(&one).expect("finite");
        let group = AbsorberGroup::of(&several, 0).expect("seen");
        let found = group.fixed_points();
        for point in &known.fixed_points {
            let upper = point.shift > known.manifold.fold_shift;
            let c = point.oscillator_amplitude * clearance;
            if !upper || c > 1.5 * group.range().expect("one")[1] {
                continue;
            }
            let same = found.iter().find(|one| (one.amplitude / c - 1.0).abs() < 1e-9);
            let same = same.unwrap_or_else(|| panic!("{point:?} {found:?}"));
            assert!(
                (same.absorber_amplitudes[0] / point.absorber_amplitude / clearance - 1.0).abs()
                    < 1e-9
            );
            assert!((same.eta - point.eta).abs() < 1e-8, "{same:?} {point:?}");
            // Both do not depend on the variables.
            assert!((same.trace - point.trace).abs() < 1e-8, "{same:?} {point:?}");
            assert!((same.determinant - point.determinant).abs() < 1e-8, "{same:?} {point:?}");
            assert_eq!(same.stable, point.stable);
        }
        let collision = known.boundaries.saddle_node;
        let nodes = group.saddle_nodes();
        if let (Some(known), Some([_, forcing])) = (collision, nodes.first()) {
            let known = known.forcing_over_clearance * clearance;
            assert!((forcing / known - 1.0).abs() < 1e-9, "{forcing} {known}");
        }
    }
}

/// Where the two detunings of an amplitude are, that amplitude is a fixed point.
#[test]
fn the_response_is_that_of_the_fixed_points() {
    let group = AbsorberGroup::of(&two_by_two('B'), 0).expect("seen");
    let [from, to] = group.range().expect("all at once");
    for n in 1..20 {
        let amplitude = from + (to - from) * f64::from(n) / 20.0;
        let Some(detunings) = group.detunings(amplitude) else { continue };
        for detuning in detunings {
            let there = AbsorberGroup { detuning, ..group.clone() };
            let found = there.fixed_points();
            let near = found.iter().any(|point| (point.amplitude / amplitude - 1.0).abs() < 1e-9);
            assert!(near, "{amplitude} {detuning} {found:?}");
        }
        // The derivative in closed form against a difference.
        let [_, slope] = group.forcing_squared(amplitude).expect("above the folds");
        let step = 1e-5 * amplitude;
        let [more, less] =
            [step, -step].map(|by| group.forcing_squared(amplitude + by).expect("above")[0]);
        assert!((slope / ((more - less) / (2.0 * step)) - 1.0).abs() < 1e-5);
    }
}

/// Case B with smaller mass ratios at the same detuning, damping and forcing of the slow flow.
#[test]
fn the_theory_is_of_first_order_in_the_mass_ratio() {
    let whole = AbsorberGroup::of(&two_by_two('B'), 0).expect("seen");
    let errors = [1.0, 0.25, 0.0625].map(|scale| {
        let mut parameters = two_by_two('B').parameters().clone();
        let eps = whole.mass_ratio * scale;
        parameters.absorbers.iter_mut().for_each(|absorber| absorber.mass *= scale);
        parameters.frequency_ratio = 1.0 + eps * whole.detuning;
        parameters.modes[0].damping_ratio *= scale;
        parameters.modes.iter_mut().for_each(|mode| mode.forcing *= scale);
        let system = ModalSystem::new(parameters).expect("valid");
        let amplitude = stable(&system).amplitude;
        assert!((amplitude - 4.0).abs() < 1e-9);
        amplitude / attracting(&system).harmonics[0] - 1.0
    });
    for (found, expected) in errors.iter().zip([0.0173, 0.0043, 0.0011]) {
        assert!((found - expected).abs() < 6e-5, "{errors:?}");
    }
}

/// The same two forces in a balance of first harmonics at a finite mass ratio, as a published program has it: the structure has
/// the mass `1 - m`, stiffness 1 and the damping `2 D`, and `q_ref = F/(2 D)`. On the backbone
/// `w^2 = 1/(1 - m - m K/q)` and `F = 2 D w q + m w^2 S`; the best clearance is the largest
/// that has a motion there.
#[test]
fn a_published_backbone_has_these_forces() {
    let (m, damping) = (0.02, 1e-3);
    let structure = vec![mode([1.0, damping, 1.0 - m, 1.0], &[1.0])];
    let group = AbsorberGroup::of(&system(0.99, structure, &[[m, 1.0, 0.8]]), 0).expect("seen");
    // Amplitude over the clearance; clearance and amplitude over `q_ref`; frequency.
    let backbone = |xi: f64| {
        let forces = group.forces(xi).expect("above the fold");
        let w = 1.0 / (1.0 - m - m * forces.reactance / xi).sqrt();
        let gamma = 1.0 / (w * xi + m * w * w * forces.resistance / (2.0 * damping));
        [gamma, xi * gamma, w]
    };
    let [mut from, mut to] = group.range().expect("one");
    for _ in 0..200 {
        let third = (to - from) / 3.0;
        if backbone(from + third)[0] > backbone(to - third)[0] {
            to -= third
        } else {
            from += third
        }
    }
    // A maximum is flat: its place is known to fewer digits than its value.
    assert!((from - 0.570270).abs() < 3e-6 && (backbone(from)[0] - 0.338665).abs() < 5.1e-7);
    let [gamma, amplitude, w] = backbone(0.570270);
    assert!((gamma - 0.338665).abs() < 5.1e-7 && (amplitude - 0.193130).abs() < 5.1e-7);
    assert!((w - 0.988455).abs() < 5.1e-7, "{w}");
    let wide = bisect([1.0, 20.0], |xi| backbone(xi)[0] - 0.07);
    let [_, amplitude, _] = backbone(wide);
    assert!(
        (wide - 8.3158).abs() < 5.1e-5 && (amplitude - 0.58210).abs() < 5.6e-6,
        "{wide} {amplitude}"
    );
}

fn bisect([mut from, mut to]: [f64; 2], falls: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..100 {
        let middle = 0.5 * (from + to);
        if falls(middle) > 0.0 { from = middle } else { to = middle }
    }
    from
}
