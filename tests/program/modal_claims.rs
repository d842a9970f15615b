//! Claims of theory and exact orbits of several modes and absorbers, judged by the layer that is independent of them.

use vinesink::case::ModalCase;
use vinesink::executor::Serial;
use vinesink::modal::{LoadClaim, LoadOrbits, at_resonances, claims};
use vinesink::validation::{Claim, Statement, Verdict};

use super::common::random::Random;
use super::modal_theory::case;

fn of(case: &ModalCase, orbits: &[LoadOrbits]) -> Vec<Claim> {
    let all = claims(case, orbits, &Serial).expect("a steady motion");
    all.into_iter().map(|LoadClaim { claim, .. }| claim).collect()
}

/// Of designs that nobody tuned to no exact orbit is refuted by simulation, whether it attracts or not.
#[test]
fn simulations_repeat_exact_orbits_and_leave_those_that_repel() {
    let mut drawn = Random(61);
    let (mut repeats, mut dies_out, mut grows) = (0, 0, 0);
    for number in 0..600 {
        let case = case(&mut drawn);
        for claim in of(&case, &at_resonances(&case).expect("a steady motion")) {
            match claim.statement {
                Statement::Repeats { .. } => repeats += 1,
                Statement::Disturbance { multiplier, .. } if multiplier < 1.0 => dies_out += 1,
                Statement::Disturbance { .. } => grows += 1,
                _ => continue,
            }
            assert_eq!(claim.verdict, Verdict::Confirmed, "{number}: {claim:?}");
        }
    }
    println!("{repeats} repeat, {dies_out} attract, {grows} repel");
    assert!(repeats > 250 && dies_out > 10 && grows > 250, "{repeats} {dies_out} {grows}");
}

/// An orbit that is none, or a multiplier that is not its own, is refuted: the judge can say no.
#[test]
fn what_is_no_orbit_is_refuted() {
    let mut drawn = Random(62);
    let [mut none, mut turned] = [0; 2];
    for _ in 0..60 {
        let case = case(&mut drawn);
        let mut found = at_resonances(&case).expect("a steady motion");
        found.iter_mut().for_each(|one| one.orbits.retain(|orbit| orbit.admissible));
        let verdict = |orbits: &[LoadOrbits], repeats: bool| {
            let all = of(&case, orbits).into_iter();
            let asked = all.filter(|one| match one.statement {
                Statement::Repeats { .. } => repeats,
                Statement::Disturbance { .. } => !repeats,
                _ => false,
            });
            asked.map(|one| one.verdict).collect::<Vec<_>>()
        };
        let mut faster = found.clone();
        for orbit in faster.iter_mut().flat_map(|one| &mut one.orbits) {
            orbit.impact_speeds.iter_mut().for_each(|speed| *speed *= 1.0 + 1e-6);
        }
        let judged = verdict(&faster, true);
        none += judged.len();
        assert!(judged.iter().all(|one| *one == Verdict::Refuted), "{judged:?}");
        let mut other = found.clone();
        for orbit in other.iter_mut().flat_map(|one| &mut one.orbits) {
            let factor = 1.0 / orbit.spectral_radius();
            for one in orbit.multipliers.iter_mut().flatten() {
                *one *= factor * factor;
            }
        }
        let judged = verdict(&other, false);
        turned += judged.len();
        assert!(judged.iter().all(|one| *one == Verdict::Refuted), "{judged:?}");
    }
    assert!(none > 20 && turned > 15, "{none} {turned}");
}
