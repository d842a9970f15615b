//! The theory of several absorbers: published and independent values, and against exact orbits, of first order in the mass ratio.

use vinesink_core::analysis::{
    AbsorberGroup, Analysis, Grading, GroupFixedPoint, apparent_restitution, effective_restitutions,
};
use vinesink_core::orbits::{ModalOrbit, antiperiodic_orbits};
use vinesink_core::system::{ModalSystem, System};

use super::cases::{EPS, OMEGA, mode, one_by_one, system, table1, two_by_two};
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

/// The system of the paper with a mode that is not forced, and the same with the first mode alone; mass ratios of the absorber on each
/// `eps`, detuning, damping and forcing of the slow flow as in the paper.
fn with_another(eps: f64, [frequency, damping_ratio]: [f64; 2], phi: f64) -> [ModalSystem; 2] {
    let of = |further: &[([f64; 2], f64)]| {
        let mut parameters = table1(further, &[[eps, 20.0, 0.6]]).parameters().clone();
        parameters.modes.iter_mut().skip(1).for_each(|one| one.forcing = 0.0);
        let scale = eps / EPS;
        parameters.modes[0].forcing *= scale;
        parameters.modes[0].damping_ratio *= scale;
        parameters.frequency_ratio = 1.0 + (OMEGA - 1.0) * scale;
        ModalSystem::new(parameters).expect("valid")
    };
    [of(&[]), of(&[([frequency, damping_ratio], phi)])]
}

/// What other modes do to a symmetric 1:1 motion is a restitution, and a clearance that their displacement at an impact changes: with
/// both the exact orbit of one mode is that of all. By hand: an oscillator under unit impulses of alternating sign every half period
/// `h` is at `-sin b/(2 w_d (cosh a + cos b))` then, `a = zeta w h`, `b = w_d h`.
#[test]
fn an_orbit_of_all_modes_is_one_of_one_mode_with_the_effective_restitution() {
    let mut compared = 0;
    for (w, zeta, phi) in [
        (4.3, 0.01, -1.0),
        (6.267, 0.1, 0.8),
        (9.0, 0.4, 1.3),
        (2.6, 0.03, -0.6),
        (6.267, 0.01, -1.0),
    ] {
        let [one, all] = with_another(0.02, [w, zeta], phi);
        let restitution = effective_restitutions(&all, 0).expect("a mode")[0];
        let half = std::f64::consts::PI / all.frequency_ratio();
        let damped = w * (1.0_f64 - zeta * zeta).sqrt();
        let (a, b) = (zeta * w * half, damped * half);
        let displaced = -libm::sin(b) / (2.0 * damped * (libm::cosh(a) + libm::cos(b)));
        for orbit in antiperiodic_orbits(&all) {
            let mut parameters = one.parameters().clone();
            let absorber = &mut parameters.absorbers[0];
            absorber.restitution = restitution;
            absorber.clearance += 2.0 * 0.02 * phi * phi * displaced * orbit.impact_speeds[0];
            let alone = ModalSystem::new(parameters).expect("valid");
            let off = |other: &ModalOrbit| (other.harmonics[0] / orbit.harmonics[0] - 1.0).abs();
            let same = antiperiodic_orbits(&alone).iter().map(off).fold(f64::INFINITY, f64::min);
            assert!(same < 1e-10, "{w} {zeta}: {same}");
            compared += 1;
        }
    }
    assert!(compared > 6, "{compared}");
}

/// A mode that is well damped takes the restitution of a drop test to that of a model of one mode.
#[test]
fn a_well_damped_mode_has_the_apparent_restitution() {
    let [_, all] = with_another(0.02, [9.0, 0.6], 1.2);
    let found = effective_restitutions(&all, 0).expect("a mode")[0];
    let expected = apparent_restitution(0.6, 0.02, 0.02 * (1.0 + 1.44));
    assert!((found - expected).abs() < 1e-6, "{found} {expected}");
    assert_eq!(effective_restitutions(&all, 2), None);
}

/// By how much another mode changes the amplitude, theory knows to first order: at a mass ratio of 0.8 % to a tenth of that change, of
/// 0.2 % to 3 %.
#[test]
fn theory_knows_what_another_mode_changes() {
    for (eps, within) in [(EPS, 0.1), (0.25 * EPS, 0.03)] {
        for (w, zeta) in
            [(4.3, 0.01), (6.267, 0.01), (4.3, 0.1), (6.267, 0.1), (9.0, 0.1), (9.0, 0.4)]
        {
            let both = with_another(eps, [w, zeta], -1.0);
            let [one, all] = &both;
            let exact = [one, all].map(|system| attracting(system).harmonics[0]);
            let group = AbsorberGroup::beside_others(all, 0).expect("seen");
            let point = group.fixed_points().into_iter().find(|point| point.stable);
            let theory = [stable(one).amplitude, point.expect("one is stable").amplitude];
            let [exact, theory] = [exact, theory].map(|[without, with]| with / without - 1.0);
            assert!((theory / exact - 1.0).abs() < within, "{eps} {w} {zeta}: {theory} {exact}");
        }
    }
}
