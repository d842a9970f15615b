//! Does a motion repeat, after how many periods, and is it symmetric?

use serde::Serialize;

use crate::simulation::{Impact, PeriodRecord};

/// Longest repetition that is looked for, in excitation periods.
const LONGEST: usize = 24;
/// Largest distance between the states at the beginnings of two repetitions that counts as the
/// same, over the size of the motion: far above the rounding of a simulation and far below the
/// distance between distinct orbits.
const CLOSURE: f64 = 1e-6;
/// The same for a motion that has settled: what is left of its transient shows in no digit of a report, nor does
/// a motion that settles from alternate sides, and repeats after twice its periods first, pass for that.
const SETTLED: f64 = 1e-8;
/// Repetitions that must be seen.
const REPETITIONS: usize = 4;

/// A repetition.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Periodicity {
    /// `p`, impacts until the motion repeats.
    pub impacts: u32,
    /// `n`, excitation periods until the motion repeats.
    pub periods: u32,
    /// Largest distance between states that should be equal, over the size of the motion.
    pub closure: f64,
}

impl Periodicity {
    /// Whether watching it any longer changes nothing.
    pub fn has_settled(self) -> bool {
        self.closure <= SETTLED
    }

    /// Excitation periods that show a repetition after so many.
    pub fn shown_in(periods: u32) -> u64 {
        (REPETITIONS as u64 + 1) * u64::from(periods)
    }

    /// The records of the last repetition.
    pub fn last(self, records: &[PeriodRecord]) -> &[PeriodRecord] {
        &records[records.len().saturating_sub(self.periods as usize)..]
    }
}

/// The impacts of one repetition, the last `found.impacts` of `impacts`, in order of time; `None` if
/// fewer were kept. Together they determine the motion: each is a state, with its phase.
pub fn last_repetition(found: Periodicity, impacts: &[Impact]) -> Option<&[Impact]> {
    impacts.get(impacts.len().checked_sub(found.impacts as usize)?..)
}

/// The longest repetition that so many periods can show.
pub fn longest_within(periods: u64) -> u64 {
    (periods / (REPETITIONS as u64 + 1)).min(LONGEST as u64)
}

/// The shortest repetition at the end of `records`, if there is one.
pub fn find(records: &[PeriodRecord]) -> Option<Periodicity> {
    let latest = &records[records.len().saturating_sub((REPETITIONS + 1) * LONGEST)..];
    let last = records.last()?.end;
    // Most do not close over the last pair of states already.
    let far = CLOSURE * size(latest);
    let closes = |periods: &usize| {
        let before = latest.len().checked_sub(periods + 1).map(|index| latest[index].end);
        before.is_some_and(|before| before.distance(&last) <= far)
    };
    (1..=LONGEST).filter(closes).find_map(|periods| repeats_after(records, periods))
}

/// The size of the motion at the ends of periods.
fn size(records: &[PeriodRecord]) -> f64 {
    records.iter().map(|record| record.end.size()).fold(0.0, f64::max)
}

fn repeats_after(records: &[PeriodRecord], periods: usize) -> Option<Periodicity> {
    let needed = (REPETITIONS + 1) * periods;
    if records.len() < needed {
        return None;
    }
    let tail = &records[records.len() - needed..];
    let closure = tail
        .iter()
        .zip(&tail[periods..])
        .map(|(before, after)| before.end.distance(&after.end))
        .fold(0.0, f64::max)
        / size(tail).max(f64::MIN_POSITIVE);
    let last = &tail[tail.len() - periods..];
    let impacts = last.iter().flat_map(|record| record.impacts).sum();
    (closure <= CLOSURE).then_some(Periodicity { impacts, periods: periods as u32, closure })
}

/// Mean absolute difference of successive intervals between these times of impacts over the excitation period; 0 for fewer than three.
pub fn asymmetry(times: &[f64], period: f64) -> f64 {
    if times.len() < 3 {
        return 0.0;
    }
    let sum: f64 =
        times.windows(3).map(|three| (three[2] - 2.0 * three[1] + three[0]).abs() / period).sum();
    sum / (times.len() - 2) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::Side;
    use crate::system::State;

    /// `x = 1 + offset (-0.98)^k` after period `k`: a repetition after 1 period that settles from alternate
    /// sides, or with a constant offset one after 2.
    #[test]
    fn what_settles_from_alternate_sides_is_no_longer_repetition() {
        let records = |offset: f64, factor: f64| -> Vec<PeriodRecord> {
            let x = (0..40).map(|k| 1.0 + offset * libm::pow(-factor, f64::from(k)));
            x.map(|x| PeriodRecord {
                end: State { x, ..State::AT_REST },
                ..PeriodRecord::default()
            })
            .collect()
        };
        let found = find(&records(2e-5, 0.98)).expect("two periods apart it is within the closure");
        assert!(found.periods == 2 && !found.has_settled());
        let found = find(&records(0.1, 1.0)).expect("it repeats");
        assert!(found.periods == 2 && found.has_settled());
    }

    #[test]
    fn the_last_repetition_is_at_the_end() {
        let impact = |tau: f64| Impact {
            tau,
            phase: 0.0,
            side: Side::Plus,
            x: 0.0,
            x_velocity_before: 1.0,
            x_velocity_after: 1.0,
            y_velocity_before: 0.0,
            y_velocity_after: 0.0,
            loss: 0.0,
            penetration: 0.0,
        };
        let all: Vec<Impact> = (0..5).map(|k| impact(f64::from(k))).collect();
        let found = |impacts| Periodicity { impacts, periods: 1, closure: 0.0 };
        assert_eq!(last_repetition(found(2), &all), Some(&all[3..]));
        assert_eq!(last_repetition(found(5), &all), Some(&all[..]));
        assert_eq!(last_repetition(found(6), &all), None);
    }
}
