//! Absorbers at rest along a load: where they do, and where a place then has most.

use super::linear::linear_places;
use super::sensors::sensors;
use crate::case::{Load, ModalCase};
use crate::motions::{ModalMotion, modal_at_rest};
use crate::numerics::scan;
use crate::simulation::Reading;

/// How often the ends of a range of frequencies are halved.
const HALVINGS: u32 = 50;
/// The largest displacement of the structure against an absorber at rest, over its clearance; infinite where nothing limits it.
fn reach_at_rest(case: &ModalCase, load: &Load, at: f64) -> f64 {
    let Ok(system) = case.system(load, at) else { return f64::INFINITY };
    let absorbers = system.absorbers().iter().enumerate();
    let reach = absorbers.map(|(j, one)| system.steady_motion_at(j).amplitude() / one.clearance);
    reach.fold(0.0, f64::max)
}

/// For each sensor of the structure the frequency at which it reads most while every absorber rests, with that motion: often where a
/// wall begins to reach one.
pub(super) fn farthest_at_rest(case: &ModalCase, load: &Load) -> Vec<(f64, ModalMotion)> {
    let sensors = sensors(case);
    let counts = |one: &ModalMotion| one.counts(case.count_inactive);
    let at_rest = |at: f64| modal_at_rest(&case.system(load, at).ok()?, &sensors).filter(counts);
    let mut all = linear_places(load.range_hz, case);
    // An absorber may be near a node of the structure's motion in a range of frequencies that no two of these hold.
    let reaches: Vec<f64> = all.iter().map(|at| reach_at_rest(case, load, *at)).collect();
    let lowest =
        |k: &usize| reaches[*k] >= 1.0 && reaches[*k] <= reaches[*k - 1].min(reaches[*k + 1]);
    for k in (1..all.len().saturating_sub(1)).filter(lowest).collect::<Vec<_>>() {
        let mut least = (reaches[k], all[k]);
        scan::narrow([all[k - 1], all[k + 1]], |at| {
            let reach = reach_at_rest(case, load, at);
            if reach < least.0 {
                least = (reach, at);
            }
            Some(-reach)
        });
        all.extend((least.0 < 1.0).then_some(least.1));
    }
    all.sort_by(f64::total_cmp);
    let edge = |pair: &[f64]| {
        let [mut rests, mut reached] = match [pair[0], pair[1]].map(|at| at_rest(at).is_some()) {
            [true, false] => [pair[0], pair[1]],
            [false, true] => [pair[1], pair[0]],
            _ => return None,
        };
        for _ in 0..HALVINGS {
            let middle = 0.5 * (rests + reached);
            *if at_rest(middle).is_some() { &mut rests } else { &mut reached } = middle;
        }
        Some(rests)
    };
    let edges: Vec<f64> = all.windows(2).filter_map(edge).collect();
    all.extend(edges);
    all.sort_by(f64::total_cmp);
    let there: Vec<(f64, ModalMotion)> =
        all.into_iter().filter_map(|at| Some((at, at_rest(at)?))).collect();
    // What rests has no impacts.
    let flies = |n: usize| !matches!(sensors[n].reads, Reading::Jump { .. });
    let of_sensor = |n: usize| {
        let peak = |motion: &ModalMotion| motion.sensors[n].peak;
        let k =
            (0..there.len()).max_by(|a, b| peak(&there[*a].1).total_cmp(&peak(&there[*b].1)))?;
        let mut best = there[k].clone();
        // The top of a resonance is between two of them.
        let around = [k.saturating_sub(1), (k + 1).min(there.len() - 1)].map(|k| there[k].0);
        scan::narrow(around, |at| {
            let found = at_rest(at);
            let value = found.as_ref().map_or(0.0, peak);
            if let Some(motion) = found.filter(|_| value > peak(&best.1)) {
                best = (at, motion);
            }
            Some(value)
        });
        Some(best)
    };
    let mut farthest: Vec<_> =
        (0..sensors.len()).filter(|n| flies(*n)).filter_map(of_sensor).collect();
    farthest.dedup_by(|a, b| a.0 == b.0);
    farthest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against a few thousand frequencies, on designs that nobody chose: whichever absorber ends the rest.
    #[test]
    fn no_frequency_at_rest_moves_a_place_farther() {
        let mut noise = 7_u64;
        let mut between = |from: f64, to: f64| {
            noise = noise.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            from + (to - from) * (noise >> 11) as f64 / (1_u64 << 53) as f64
        };
        for number in 0..60 {
            let [low, high] = [between(0.2, 1.9), between(8.0, 60.0)];
            let [own, other] = [between(0.05, 3.0), between(0.05, 3.0)];
            let text = format!(
                "title = 't'\nsource = 's'\n[[mode]]\nfrequency = '2 Hz'\ndamping_ratio = 0.02\nmass = '1 t'\n\
                 shape = {{ a = 1.0, b = -0.4 }}\n[[mode]]\nfrequency = '5.2 Hz'\ndamping_ratio = 0.01\nmass = '1 t'\n\
                 shape = {{ a = 0.3, b = 1.0 }}\n[[absorber]]\nplace = 'a'\nmass = '9 kg'\nclearance = '{own} mm'\nrestitution = 0.5\n\
                 [[absorber]]\nplace = 'b'\nmass = '9 kg'\nclearance = '{other} mm'\nrestitution = 0.5\n\
                 [[excitation]]\nkind = 'force'\nplace = 'a'\namplitude = '100 N'\nfrom = '{low} Hz'\nto = '{high} Hz'\n"
            );
            let case = ModalCase::parse("case.toml", &text).expect("a case");
            let load = &case.loads[0];
            let sensors = sensors(&case);
            let farthest = farthest_at_rest(&case, load);
            for p in 0..2 {
                let at = |k: u32| low + (high - low) * f64::from(k) / 3e3;
                let motion = |k: u32| modal_at_rest(&case.system(load, at(k)).ok()?, &sensors);
                let scanned = (0..=3_000)
                    .filter_map(motion)
                    .filter(|one| one.counts(true))
                    .map(|one| one.sensors[p].peak);
                let scanned = scanned.fold(0.0, f64::max);
                let found = farthest.iter().map(|one| one.1.sensors[p].peak).fold(0.0, f64::max);
                assert!(found >= scanned, "{number} {p}: {found} {scanned}");
            }
        }
    }
}
