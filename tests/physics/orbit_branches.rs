//! Continuation, bifurcations, and orbits beyond the symmetric ones.
//!
//! Truth: the closed form of the symmetric family, whose limits are found without continuation; the
//! event-driven simulation; identities of the bifurcations themselves.

use crate::common::table_1;
use crate::orbit_support::impacts_from;
use vinesink::orbits::branch::{BranchDirection, Settings, follow};
use vinesink::orbits::newton::solve;
use vinesink::orbits::switching::{branch_off, continue_beyond};
use vinesink::orbits::{
    Bifurcation, Branch, BranchEnd, Closure, Cycle, ExactBoundaries, Orbit, OrbitError, Origin,
    SpecialPoint, SymmetricFamily, symmetric_orbits,
};
use vinesink::system::{Parameter, Parameters, System};

fn stable_orbit(system: &System) -> Orbit {
    symmetric_orbits(system).expect("damped").pop().expect("exists").orbit
}

fn branch(
    system: &System,
    parameter: Parameter,
    direction: BranchDirection,
    range: [f64; 2],
) -> Branch {
    let start = stable_orbit(system);
    follow(system, &start, parameter, direction, &Settings::within(range)).expect("regular start")
}

fn first(branch: &Branch, kind: Bifurcation) -> &SpecialPoint {
    branch.specials.iter().find(|special| special.kind == kind).expect("on this branch")
}

/// Continuation finds the limits that the closed form has without it.
#[test]
fn continuation_and_closed_form_agree_on_the_limits() {
    use Bifurcation::{Grazing, NeimarkSacker, SaddleNode, SymmetryBreaking};
    for (frequency, clearance) in [(8.0, 7.5), (8.5, 20.0)] {
        let system = table_1(frequency, clearance);
        let family = SymmetricFamily::of(&system).expect("damped");
        let up = branch(&system, Parameter::Clearance, BranchDirection::Up, [0.05, 10.0]);
        let down = branch(&system, Parameter::Clearance, BranchDirection::Down, [0.05, 10.0]);
        let found: Vec<&SpecialPoint> = up.specials.iter().chain(&down.specials).collect();
        for kind in [SaddleNode, NeimarkSacker, SymmetryBreaking, Grazing] {
            let limits = family.limits.iter().filter(|limit| limit.kind == kind);
            for limit in limits {
                let near = found.iter().find(|special| {
                    special.kind == kind && (special.value / limit.clearance - 1.0).abs() < 1e-8
                });
                let special = near.unwrap_or_else(|| panic!("{limit:?}"));
                assert!(special.converged && special.precision < 1e-10, "{special:?}");
                // The bracket may be one number: then it is located to the last digit.
                let [low, high] = special.bracket;
                assert!(low <= special.value && special.value <= high);
            }
        }
    }
}

/// Every point of a branch is an orbit: it closes, and at its own clearance it is the closed form's.
#[test]
fn every_point_of_a_branch_is_an_orbit() {
    let system = table_1(8.5, 20.0);
    let up = branch(&system, Parameter::Clearance, BranchDirection::Up, [0.05, 10.0]);
    assert!(up.points.len() > 50);
    for point in &up.points {
        assert!(point.orbit.convergence.residual < 1e-13, "{point:?}");
        let there = system.with_clearance_scaled(point.value).expect("valid");
        let nearest = symmetric_orbits(&there)
            .expect("damped")
            .iter()
            .map(|orbit| (orbit.impact_displacement - point.orbit.cycle.impacts[0].x).abs())
            .fold(f64::INFINITY, f64::min);
        // Two orbits a distance d from collision are known to rounding over d.
        assert!(nearest < 1e-7, "{nearest} at {}", point.value);
    }
}

/// At a fixed clearance and forcing the orbits over the frequency form a closed curve (an isola).
#[test]
fn a_closed_branch_says_that_it_is_closed() {
    let system = table_1(8.5, 20.0);
    let isola = branch(&system, Parameter::Frequency, BranchDirection::Up, [0.5, 1.5]);
    assert!(matches!(isola.end, BranchEnd::Closed { .. }), "{:?}", isola.end);
    let turns = isola.specials.iter().filter(|s| s.kind == Bifurcation::SaddleNode).count();
    assert_eq!(turns, 2, "a closed curve turns back twice");
}

/// Parameters that end do end the branch, at their last value.
#[test]
fn a_branch_reaches_an_elastic_impact_and_stops_there() {
    let system = table_1(8.0, 7.5);
    let up = branch(&system, Parameter::Restitution, BranchDirection::Up, [0.0, 1.0]);
    assert_eq!(up.end, BranchEnd::Range { value: 1.0 });
    assert_eq!(up.points.last().expect("some").value, 1.0);
}

/// Two routes to the same asymmetric orbit: from simulation, and off the symmetry breaking.
#[test]
fn the_branch_off_a_symmetry_breaking_is_the_simulated_asymmetric_motion() {
    let system = table_1(8.0, 7.5);
    let down = branch(&system, Parameter::Clearance, BranchDirection::Down, [0.05, 10.0]);
    let breaking = first(&down, Bifurcation::SymmetryBreaking);
    let settings = Settings::within([0.05, 10.0]);
    let asymmetric =
        branch_off(&system, Parameter::Clearance, breaking, &settings).expect("supercritical");
    let target = 4.0 / 7.5;
    let nearest = asymmetric
        .points
        .iter()
        .min_by(|a, b| (a.value - target).abs().total_cmp(&(b.value - target).abs()))
        .expect("some");
    let there = table_1(8.0, 4.0);
    let orbit = solve(&there, &nearest.orbit.cycle, Origin::Continuation).expect("near");
    assert!(orbit.attracts(), "{orbit:?}");
    assert_eq!(orbit.cycle.sequence(), "+-");
    let [a, b] = [orbit.cycle.durations[0], orbit.cycle.durations[1]];
    assert!((a - b).abs() > 0.1, "it is asymmetric: {a} {b}");

    let impacts = impacts_from(&there, &common_start(&there), 4000);
    let last = &impacts[impacts.len() - 2..];
    let simulated: Vec<f64> = last.iter().map(|impact| impact.x.abs()).collect();
    let exact: Vec<f64> = orbit.cycle.impacts.iter().map(|impact| impact.x.abs()).collect();
    let matches = |i: usize, j: usize| {
        (simulated[0] - exact[i]).abs() < 1e-9 && (simulated[1] - exact[j]).abs() < 1e-9
    };
    assert!(matches(0, 1) || matches(1, 0), "{simulated:?} {exact:?}");
}

/// Any state after an impact from which the asymmetric motion is reached.
fn common_start(system: &System) -> vinesink::orbits::AfterImpact {
    let mut after = stable_orbit(system).cycle.impacts[0];
    after.x_velocity *= 1.01;
    after
}

/// Newton's method refines impacts of a simulation to the orbit, whatever its sequence.
#[test]
fn newton_refines_a_disturbed_orbit_of_three_impacts() {
    let system = table_1(8.0, 7.5);
    let settings = Settings::within([0.05, 10.0]);
    let down = branch(&system, Parameter::Clearance, BranchDirection::Down, [0.05, 10.0]);
    let breaking = first(&down, Bifurcation::SymmetryBreaking);
    let asymmetric = branch_off(&system, Parameter::Clearance, breaking, &settings).expect("found");
    let grazing = first(&asymmetric, Bifurcation::Grazing);
    assert_eq!(grazing.sequence_beyond.as_deref(), Some("++-"));
    let beyond =
        continue_beyond(&system, Parameter::Clearance, grazing, &settings).expect("found above");
    // Across the grazing the motion is continuous: the impact is born without speed.
    let born = &beyond.points[0].orbit.cycle;
    assert_eq!(born.sequence(), "++-");
    let before = grazing.orbit.cycle.impacts[0].vector();
    assert!((born.impacts[0].vector() - before).amax() < 1e-3, "{born:?} {before}");
    // 3.2 mm lies between the saddle-node at 3.506 mm and the period doubling at 3.104 mm.
    let stable = beyond.points.iter().find(|point| point.orbit.attracts()).expect("some");
    let there = system.with_clearance_scaled(stable.value).expect("valid");
    let mut disturbed = stable.orbit.cycle.clone();
    for impact in &mut disturbed.impacts {
        impact.x += 1e-3;
        impact.y_velocity *= 0.998;
    }
    let refined = solve(&there, &disturbed, Origin::Simulation).expect("near");
    assert!(refined.convergence.residual < 1e-14 && refined.convergence.iterations < 9);
    let gap = (refined.cycle.impacts[1].vector() - stable.orbit.cycle.impacts[1].vector()).amax();
    assert!(gap < 1e-11, "{gap}");
    // A simulation started on it stays: three impacts a period, for ten periods.
    let after = refined.cycle.impacts[0];
    let impacts = impacts_from(&there, &after, 30);
    assert_eq!(impacts.len(), 30);
    assert!((impacts[29].x - after.x).abs() < 1e-9, "{} {}", impacts[29].x, after.x);
}

/// Where a period doubles, the product of two halves is the whole: the doubled cycle at the
/// bifurcation has the squared multipliers of the single one.
#[test]
fn a_doubled_branch_leaves_with_squared_multipliers() {
    let system = table_1(8.5, 20.0);
    let settings = Settings::within([0.05, 10.0]);
    let down = branch(&system, Parameter::Clearance, BranchDirection::Down, [0.05, 10.0]);
    let breaking = first(&down, Bifurcation::SymmetryBreaking);
    let asymmetric = branch_off(&system, Parameter::Clearance, breaking, &settings).expect("found");
    let doubling = first(&asymmetric, Bifurcation::PeriodDoubling);
    assert!(doubling.converged);
    let doubled = branch_off(&system, Parameter::Clearance, doubling, &settings).expect("found");
    let start = &doubled.points[0].orbit;
    assert_eq!(start.cycle.closure, Closure::Repeats { periods: 2 });
    assert_eq!(start.cycle.impact_count(), 4);
    let mut squared: Vec<f64> =
        doubling.orbit.multipliers.values.iter().map(|[re, im]| re * re + im * im).collect();
    let mut found: Vec<f64> =
        start.multipliers.values.iter().map(|[re, im]| libm::hypot(*re, *im)).collect();
    squared.sort_by(f64::total_cmp);
    found.sort_by(f64::total_cmp);
    for (a, b) in squared.iter().zip(&found) {
        // The new branch is entered 1e-3 away from the old one.
        assert!((a - b).abs() < 1e-2, "{squared:?} {found:?}");
    }
}

/// A branch that cannot go on says where and why.
#[test]
fn a_cycle_that_is_none_is_refused() {
    let system = table_1(8.0, 7.5);
    let orbit = stable_orbit(&system);
    let broken = Cycle { durations: vec![-1.0], ..orbit.cycle.clone() };
    let error = solve(&system, &broken, Origin::Simulation).expect_err("negative duration");
    assert!(error.to_string().contains("not positive"), "{error}");
    // At twice the clearance of the saddle-node there is no such orbit to converge to.
    let beyond = system.with_clearance_scaled(2.0 * 16.695 / 7.5).expect("valid");
    let error = solve(&beyond, &orbit.cycle, Origin::Simulation).expect_err("no orbit");
    assert!(error.to_string().contains("residual") || error == OrbitError::Singular, "{error}");
}

/// One motion has one name, whichever impact it is written from and whichever mirror image.
#[test]
fn sequences_are_named_once() {
    use vinesink::orbits::Wall::{Minus, Plus};
    let orbit = stable_orbit(&table_1(8.0, 7.5));
    let named = |walls: Vec<vinesink::orbits::Wall>, closure| {
        let at = |wall| vinesink::orbits::AfterImpact { wall, ..orbit.cycle.impacts[0] };
        let durations = vec![1.0; walls.len()];
        Cycle { closure, impacts: walls.into_iter().map(at).collect(), durations }.sequence()
    };
    let repeats = Closure::Repeats { periods: 1 };
    for walls in [vec![Plus, Plus, Minus], vec![Plus, Minus, Plus], vec![Minus, Minus, Plus]] {
        assert_eq!(named(walls, repeats), "++-");
    }
    let mirrors = Closure::Mirrors { periods: 1 };
    assert_eq!(named(vec![Plus, Plus], mirrors), "++--");
    assert_eq!(named(vec![Minus], mirrors), named(vec![Plus, Minus], repeats));
}

/// The whole column of boundaries over a band of frequencies: the asymmetric orbits begin where the
/// symmetric ones end, and simulation sees two impacts a period above the grazing and another regime
/// far below it.
#[test]
fn the_border_between_two_and_more_impacts_is_a_grazing() {
    for frequency in [7.6, 7.8, 8.0, 8.2, 8.4, 8.5, 8.7, 9.0] {
        let system = table_1(frequency, 10.0);
        let boundaries = ExactBoundaries::of(&system).expect("damped");
        let asymmetric = boundaries.asymmetric.expect("below resonance and above");
        let grazing = asymmetric.grazing.expect("the branch ends by grazing");
        assert!(asymmetric.attracting, "{frequency}");
        assert!(matches!(asymmetric.end, BranchEnd::Grazing { .. }));
        assert!(grazing < asymmetric.symmetry_breaking);
        let doubling = asymmetric.period_doubling.expect("before the grazing");
        assert!(grazing < doubling && doubling < asymmetric.symmetry_breaking);
        println!(
            "{frequency} Hz: {:.3} {:.3} {:.3} {:?}",
            10.0 * asymmetric.symmetry_breaking,
            10.0 * doubling,
            10.0 * grazing,
            asymmetric.sequence_beyond
        );
        // Between symmetry breaking and period doubling a simulation settles on two impacts.
        let middle = 0.5 * (doubling + asymmetric.symmetry_breaking);
        let there = system.with_clearance_scaled(middle).expect("valid");
        let impacts = impacts_from(&there, &common_start(&there), 4000);
        let last = &impacts[impacts.len() - 5..];
        let passed = (last[4].tau - last[0].tau) / there.period();
        assert!((passed - 2.0).abs() < 1e-6, "{passed}");
    }
}

/// Over the frequency the asymmetric orbits of 8 Hz, 15 mm bridge two symmetry breakings.
#[test]
fn an_asymmetric_branch_ends_at_the_other_symmetry_breaking() {
    let system = table_1(8.0, 15.0);
    let settings = Settings::within([0.5, 2.0]);
    let symmetric = branch(&system, Parameter::Frequency, BranchDirection::Up, [0.5, 2.0]);
    let breakings: Vec<&SpecialPoint> = symmetric
        .specials
        .iter()
        .filter(|special| special.kind == Bifurcation::SymmetryBreaking)
        .collect();
    assert_eq!(breakings.len(), 2, "{breakings:?}");
    let asymmetric =
        branch_off(&system, Parameter::Frequency, breakings[0], &settings).expect("found");
    let met = first(&asymmetric, Bifurcation::SymmetryBreaking);
    assert!((met.value / breakings[1].value - 1.0).abs() < 1e-12, "{met:?}");
    assert!(matches!(met.orbit.cycle.closure, Closure::Mirrors { periods: 1 }));
    let turned = |special: &SpecialPoint| special.kind == Bifurcation::SaddleNode;
    assert!(!asymmetric.specials.iter().any(turned), "{:?}", asymmetric.specials);
}

/// The asymmetric orbits end where they meet their own mirror image: at the symmetry breaking from
/// which they came.
#[test]
fn an_asymmetric_branch_turns_back_at_the_symmetry_breaking() {
    let system = table_1(8.0, 7.5);
    let settings = Settings::within([0.05, 10.0]);
    let down = branch(&system, Parameter::Clearance, BranchDirection::Down, [0.05, 10.0]);
    let breaking = first(&down, Bifurcation::SymmetryBreaking);
    let asymmetric = branch_off(&system, Parameter::Clearance, breaking, &settings).expect("found");
    let inside = &asymmetric.points[asymmetric.points.len() / 2];
    let there = system.with_clearance_scaled(inside.value).expect("valid");
    let back = follow(&there, &inside.orbit, Parameter::Clearance, BranchDirection::Up, &settings)
        .expect("regular start");
    let met = first(&back, Bifurcation::SymmetryBreaking);
    assert!(met.converged, "{met:?}");
    // Both are roots of one function, located to 1e-12 of a step.
    let value = met.value * inside.value;
    assert!((value / breaking.value - 1.0).abs() < 1e-12, "{value} {}", breaking.value);
    assert!(met.bracket[0] <= met.value && met.value <= met.bracket[1]);
    assert!(!back.specials.iter().any(|special| special.kind == Bifurcation::SaddleNode));
    // It goes on as its own mirror image, to the same grazing.
    let grazing = first(&back, Bifurcation::Grazing).value * inside.value;
    let before = first(&asymmetric, Bifurcation::Grazing).value;
    assert!((grazing / before - 1.0).abs() < 1e-10, "{grazing} {before}");
}

/// Without restitution the followed orbit ends where the closed form lets the absorber stay on the
/// wall, and nothing grazes there.
#[test]
fn a_followed_orbit_ends_in_sticking_where_the_closed_form_says() {
    let parameters = Parameters { restitution: 0.0, ..table_1(8.0, 7.5).parameters() };
    let system = System::new(parameters).expect("valid");
    let family = SymmetricFamily::of(&system).expect("damped");
    let [expected, node] = family.stable[0].clearance;
    let inside = system.with_clearance_scaled(0.5 * (expected + node)).expect("valid");
    let branch = branch(&inside, Parameter::Clearance, BranchDirection::Down, [0.2, 2.0]);
    let expected = 2.0 * expected / (expected + node);
    let last = branch.specials.last().expect("ends");
    assert_eq!(last.kind, Bifurcation::Sticking, "{:?}", branch.specials);
    assert!(last.converged && (last.value / expected - 1.0).abs() < 1e-9, "{last:?} {expected}");
    assert!(matches!(branch.end, BranchEnd::Grazing { .. }));
}
