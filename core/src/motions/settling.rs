//! When what a start leaves has faded: the one rule by which every simulation leaves transients out.
//!
//! Free vibration of the oscillator fades with its own decay, `exp(-eps lambda tau/2)` in fast time, however
//! many excitation periods that are; a motion near an attracting 1:1 orbit closes in on it with the orbit's
//! largest multiplier, of which the rates of the slow flow are the leading order. The slower of both counts.
//! What fades more slowly than a run can wait for is measured all the same, and said not to have settled if
//! it still drifts.

use serde::Serialize;

use crate::orbits::{Orbit, attracting_orbits};
use crate::system::{State, System};

/// E-folds that are left out: of a free vibration as large as the motion that remains, 6e-6 is then left.
const FADED: f64 = 12.0;
/// The same beyond the ratio of a free vibration as large as the clearance to the steady motion: where the
/// steady motion is small, 5e-5 of it is left.
const FADED_BESIDE_STEADY: f64 = 10.0;
/// Fewest excitation periods left out: a motion needs some to be captured, which the decay does not tell.
const FEWEST: f64 = 150.0;
/// Most natural periods, and most excitation periods, left out: what a run can wait for. A damping ratio
/// of 0.07 % fades within the first, 0.4 % at 60 times the natural frequency within the second.
const MOST: [f64; 2] = [3_000.0, 50_000.0];
/// Most natural periods left out of a structure whose decay takes more than [`HOPELESS`] times as long as a
/// run can wait: an undamped one keeps its free vibration however long one waits.
const MOST_UNDAMPED: f64 = 600.0;
/// See [`MOST_UNDAMPED`].
const HOPELESS: f64 = 4.0;

/// Fewest excitation periods that show a repetition; windows are no shorter.
const SHORTEST: u64 = 8;

/// A window of so many excitation periods, or as many of them as a run can wait for.
pub fn window(system: &System, periods: u64) -> u64 {
    let most = (MOST[0] * system.frequency_ratio()).min(MOST[1]) as u64;
    periods.min(most.max(SHORTEST))
}

/// What is left out of a trajectory before it is measured.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SettlingTime {
    /// Excitation periods.
    pub periods: u64,
    /// Whether what a start leaves has faded by then; else that would take longer than a run can wait.
    pub fades: bool,
}

impl SettlingTime {
    /// That of any start of a system.
    pub fn of(system: &System) -> Self {
        Self::beside(system, &attracting_orbits(system).unwrap_or_default())
    }

    /// The same where the attracting 1:1 orbits are known.
    pub(super) fn beside(system: &System, orbits: &[Orbit]) -> Self {
        let decay = decay_rate(system) * system.period();
        let rate = |orbit: &Orbit| -libm::log(orbit.radius_per_period());
        let orbit = orbits.iter().map(rate).min_by(f64::total_cmp);
        let steady = system.linear_response().map_or(1.0, |response| response.amplitude().min(1.0));
        let beside = FADED_BESIDE_STEADY - libm::log(steady.max(f64::MIN_POSITIVE));
        // Without excitation there is nothing beside which a free vibration is large.
        let folds = if steady > 0.0 { FADED.max(beside) } else { FADED };
        let needed = (folds / decay).max(orbit.map_or(0.0, |rate| FADED / rate));
        let natural = system.frequency_ratio();
        let most = (MOST[0] * natural).clamp(1.0, MOST[1]);
        if folds / decay > HOPELESS * most {
            let periods = (MOST_UNDAMPED * natural).clamp(1.0, MOST[1]).max(FEWEST.min(most));
            return Self { periods: periods as u64, fades: false };
        }
        Self { periods: needed.max(FEWEST).min(most) as u64, fades: needed <= most }
    }
}

/// Whether an overdamped structure comes back so slowly that no run sees it: a start that is flown on shows nothing new.
pub(super) fn creeps(system: &System) -> bool {
    let overdamped = system.mass_ratio() * system.damping() > 2.0;
    overdamped && !SettlingTime::beside(system, &[]).fades
}

/// Rate at which the slowest free vibration of the oscillator fades, per unit of fast time: `eps lambda/2`
/// where it rings.
fn decay_rate(system: &System) -> f64 {
    let decay = 0.5 * system.mass_ratio() * system.damping();
    if decay <= 1.0 { decay } else { 1.0 / (decay + ((decay - 1.0) * (decay + 1.0)).sqrt()) }
}

/// The long-term motion of an absorber at rest that no wall reaches any more, at excitation phase 0: the
/// oscillator on its steady motion. None where the absorber moves, gravity or friction move it, a wall may still
/// reach it, or the free vibration stays.
pub(super) fn at_rest(system: &System, state: &State) -> Option<State> {
    if system.cavity().moves_absorber() {
        return None;
    }
    let linear = system.linear_response()?;
    let steady = linear.state(system);
    // The energy of a free vibration never grows.
    let free = libm::hypot(state.x - steady.x, state.x_velocity - steady.x_velocity);
    let apart = state.y.abs() + linear.amplitude() + free;
    let stays = state.y_velocity == 0.0 && apart < 1.0 && system.damping() > 0.0;
    stays.then_some(State { y: state.y, ..steady })
}

/// Whether whatever moves comes to rest: nothing excites it, and the structure is damped. It may take for ever, at a rate that
/// falls with the energy, as an absorber that loses speed at each wall meets the next one later.
pub(super) fn comes_to_rest(system: &System) -> bool {
    system.forcing_per_clearance() == 0.0 && system.damping() > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::{Cavity, Excitation, Parameters};

    /// A footbridge, 2.1 Hz with 0.4 % of damping under a force, and 1.5 % of its mass in a wide cavity.
    fn bridge(frequency_ratio: f64, damping: f64) -> System {
        System::new(Parameters {
            mass_ratio: 0.015,
            damping,
            restitution: 0.6,
            frequency_ratio,
            forcing_per_clearance: 0.4,
            excitation: Excitation::Force,
            cavity: Cavity::IDEAL,
        })
        .expect("valid")
    }

    /// Each period of a slow excitation holds 1000 of the structure.
    #[test]
    fn a_window_is_what_a_run_can_wait_for() {
        assert_eq!(window(&bridge(1.0, 0.5), 250), 250);
        assert_eq!(window(&bridge(0.001, 0.5), 250), 8);
    }

    /// A start so near a wall that the transient may reach it is followed.
    #[test]
    fn only_an_absorber_that_no_wall_reaches_is_at_rest() {
        let system = bridge(1.0, 0.533);
        let steady = system.linear_response().expect("damped");
        assert!(steady.amplitude() < 1.0);
        let on_it = State { y: 0.0, ..steady.state(&system) };
        assert_eq!(at_rest(&system, &on_it), Some(on_it));
        for (x, y, y_velocity) in [(0.0, 0.3, 0.0), (0.0, 0.0, 1e-9), (0.5, 0.0, 0.0)] {
            let start = State { x, y, y_velocity, ..State::AT_REST };
            assert_eq!(at_rest(&system, &start), None, "{start:?}");
        }
    }
}
