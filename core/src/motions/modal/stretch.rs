//! A stretch of excitation periods: what sensors read in it, and whether its last state was there before.

use crate::simulation::{
    Detail, ModalImpact, ModalMeter, ModalObserver, ModalSimulation, Sensor, SensorRecord,
};
use crate::system::{MOST_MODES, ModalState, ModalSystem};

/// Most periods after which a motion is seen to repeat, and the difference of its states, over their size, up to which they
/// are the same.
const MOST_REPEATS: usize = 6;
pub(super) const SAME_STATE: f64 = 1e-9;
/// The same from which on it is worth to solve for the motion, and to try it once.
const NEARLY: f64 = 1e-4;
const ROUGHLY: f64 = 0.01;
/// Most impacts in a period, of all absorbers: more are of chatter that does not end.
pub(super) const MOST_IMPACTS: u64 = 2000;

/// States at the ends of the last periods, and impacts.
#[derive(Default)]
pub(super) struct Seen {
    states: Vec<ModalState>,
    impacts: [u64; MOST_MODES],
    /// The largest relative speed of an impact of each absorber.
    speeds: [f64; MOST_MODES],
}

impl ModalObserver for Seen {
    fn detail(&self) -> Detail {
        Detail::Events
    }
    fn impact(&mut self, impact: &ModalImpact) {
        let ModalImpact { absorber, x_velocity: [x, _], y_velocity: [y, _], .. } = *impact;
        self.impacts[absorber] += 1;
        self.speeds[absorber] = self.speeds[absorber].max((x - y).abs());
    }
    fn period(&mut self, _turns: u64, state: &ModalState) {
        if self.states.len() > MOST_REPEATS {
            self.states.remove(0);
        }
        self.states.push(*state);
    }
}

impl Seen {
    /// After how many periods the last state was there before, and those after which it nearly was.
    pub fn repeats_after(&self) -> Repeats {
        let Some((last, before)) = self.states.split_last() else { return Repeats::default() };
        let each =
            before.iter().rev().zip(1..).map(|(other, after)| (after, distance(last, other)));
        let each: Vec<(u32, f64)> = each.collect();
        let within = |most: f64| each.iter().filter(move |one| one.1 <= most).map(|one| one.0);
        let roughly = each.iter().filter(|one| (NEARLY..ROUGHLY).contains(&one.1));
        let roughly = roughly.min_by(|a, b| a.1.total_cmp(&b.1)).map(|one| one.0);
        Repeats { exactly: within(SAME_STATE).next(), nearly: within(NEARLY).collect(), roughly }
    }
}

/// Excitation periods after which a state was there before.
#[derive(Default)]
pub(super) struct Repeats {
    pub exactly: Option<u32>,
    /// Ascending.
    pub nearly: Vec<u32>,
    /// After which it was so at best, where that is only roughly.
    pub roughly: Option<u32>,
}

/// Largest difference of two states, over the largest number of the first.
pub(super) fn distance(of: &ModalState, other: &ModalState) -> f64 {
    let numbers = |state: &ModalState| -> Vec<f64> {
        state.modes.iter().chain(&state.absorbers).flatten().copied().collect()
    };
    let (of, other) = (numbers(of), numbers(other));
    let size = of.iter().fold(0.0, |most: f64, one| most.max(one.abs()));
    let off = of.iter().zip(&other).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
    off / size
}

/// What a stretch of periods came to.
pub(super) struct Stretch {
    pub periods: u64,
    pub sensors: Vec<SensorRecord>,
    /// Of each absorber, in a period.
    pub impacts: Vec<f64>,
    /// The largest relative speed of an impact of each.
    pub speeds: Vec<f64>,
    pub repeats_after: Repeats,
}

impl Stretch {
    /// Flies so many periods.
    pub fn fly(
        simulation: &mut ModalSimulation,
        system: &ModalSystem,
        sensors: &[Sensor],
        periods: u64,
    ) -> Self {
        let mut observer = (ModalMeter::new(system, sensors), Seen::default());
        simulation.run(periods, periods * MOST_IMPACTS, &mut observer);
        let (meter, seen) = observer;
        let counts = &seen.impacts[..system.absorbers().len()];
        let impacts = counts.iter().map(|all| *all as f64 / periods as f64).collect();
        let speeds = seen.speeds[..counts.len()].to_vec();
        let repeats_after = seen.repeats_after();
        Self { periods, sensors: meter.records(), impacts, speeds, repeats_after }
    }
}
