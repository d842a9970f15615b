//! States that starts begin in.

use crate::linear::carried_state;
use crate::motions::starts::{REACH, position};
use crate::system::{MOST_MODES, ModalState, ModalSystem};

/// One prime for displacement and velocity of each mode, then for place and velocity of each absorber.
const PRIMES: [f64; 4 * MOST_MODES] = [
    2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0, 23.0, 29.0, 31.0, 37.0, 41.0, 43.0, 47.0, 53.0,
    59.0, 61.0, 67.0, 71.0, 73.0, 79.0, 83.0, 89.0, 97.0, 101.0, 103.0, 107.0, 109.0, 113.0, 127.0,
    131.0,
];

/// The `k`-th start: from rest, each absorber half way to a wall; then each mode anywhere in a box as large as its own steady motion and
/// the absorbers anywhere in their cavities, evenly spread.
pub(super) fn start(system: &ModalSystem, k: u32) -> ModalState {
    let mut start = ModalState::AT_REST;
    let from = |axis: usize| match k {
        0 => 0.0,
        _ => 2.0 * position(PRIMES[axis], k - 1) - 1.0,
    };
    let (reach, omega) = (reach_of(system), system.frequency_ratio());
    for mode in 0..system.modes().len() {
        let most = reach * system.steady_motion(mode).amplitude();
        start.modes[mode] = [most * from(2 * mode), omega * most * from(2 * mode + 1)];
    }
    for (j, absorber) in system.absorbers().iter().enumerate() {
        let [x, v] = system.displaced(j, &start);
        let axis = 2 * (system.modes().len() + j);
        let place = if k == 0 { 0.5 } else { 0.99 * from(axis) };
        let most = reach * omega * system.steady_motion_at(j).amplitude();
        let velocity = if k == 0 { v } else { most * from(axis + 1) };
        start.absorbers[j] = [x - place * absorber.clearance, velocity];
    }
    start
}

/// Most times as far starts go for the sake of a clearance that the motion does not reach.
const FARTHEST: f64 = 10.0;

/// The largest start, over the structure's own steady motion: beyond that, and beyond the clearance of the absorber that is nearest to
/// its walls where the motion reaches none. What modes have at an absorber counts, where they cancel each other too.
fn reach_of(system: &ModalSystem) -> f64 {
    let over = system.absorbers().iter().enumerate().map(|(j, one)| {
        let each = system.modes().iter().enumerate();
        let modes = each.map(|(k, mode)| mode.shape[j].abs() * system.steady_motion(k).amplitude());
        (system.base_amplitude().abs() + modes.sum::<f64>()) / one.clearance
    });
    REACH / over.fold(0.0, f64::max).clamp(1.0 / FARTHEST, 1.0)
}

/// States of the structure as it carries all of its absorbers, or `each` alone. Those that no start is near, which are of the structure
/// without absorbers, and in which these hit both of their walls.
pub(super) fn carried(system: &ModalSystem, each: bool) -> Vec<ModalState> {
    let all: Vec<usize> = (0..system.absorbers().len()).collect();
    let alone = all.iter().map(|j| vec![*j]).filter(|_| each && all.len() > 1);
    let sets = std::iter::once(all.clone()).chain(alone);
    let reach = reach_of(system);
    let states = sets.filter_map(|set| {
        let state = carried_state(system, &set)?;
        let farther = |j: &usize| {
            let [x, v] = system.displaced(*j, &state);
            let amplitude = libm::hypot(x, v / system.frequency_ratio());
            let near = reach * system.steady_motion_at(*j).amplitude();
            amplitude > near && amplitude > system.absorbers()[*j].clearance
        };
        set.iter().any(farther).then_some(state)
    });
    states.collect()
}
