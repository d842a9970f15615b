//! States that starts begin in.

use crate::linear::carried_state;
use crate::motions::starts::position;
use crate::system::{MOST_MODES, ModalState, ModalSystem};

/// The largest start, over the structure's own steady motion.
const BEYOND: f64 = 1.2;
/// One prime for the share of the steady motion, and for the place of each absorber.
const PRIMES: [f64; MOST_MODES + 1] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0, 23.0];

/// The `k`-th start: from rest, each absorber half way to a wall; then with a share of the structure's own steady motion and
/// the absorbers anywhere in their cavities, evenly spread.
pub(super) fn start(system: &ModalSystem, k: u32) -> ModalState {
    let mut start = ModalState::AT_REST;
    let part = |axis: usize| position(PRIMES[axis], k.saturating_sub(1));
    let share = if k == 0 { 0.0 } else { BEYOND * part(0) };
    for mode in 0..system.modes().len() {
        let steady = system.steady_motion(mode);
        let velocity = system.frequency_ratio() * steady.sine;
        start.modes[mode] = [share * steady.cosine, share * velocity];
    }
    for (j, absorber) in system.absorbers().iter().enumerate() {
        let [x, v] = system.displaced(j, &start);
        let place = if k == 0 { 0.5 } else { 1.98 * part(1 + j) - 0.99 };
        start.absorbers[j] = [x - place * absorber.clearance, v];
    }
    start
}

/// States of the structure as it carries all of its absorbers, or `each` alone. Those that no start is near, which are of the structure
/// without absorbers, and in which these hit both of their walls.
pub(super) fn carried(system: &ModalSystem, each: bool) -> Vec<ModalState> {
    let all: Vec<usize> = (0..system.absorbers().len()).collect();
    let alone = all.iter().map(|j| vec![*j]).filter(|_| each && all.len() > 1);
    let sets = std::iter::once(all.clone()).chain(alone);
    let states = sets.filter_map(|set| {
        let state = carried_state(system, &set)?;
        let farther = |j: &usize| {
            let [x, v] = system.displaced(*j, &state);
            let amplitude = libm::hypot(x, v / system.frequency_ratio());
            let near = BEYOND * system.steady_motion_at(*j).amplitude();
            amplitude > near && amplitude > system.absorbers()[*j].clearance
        };
        set.iter().any(farther).then_some(state)
    });
    states.collect()
}
