//! One flight of one trajectory, panel by panel: see [`super::phasor`] for the formulas and the proof.

use super::events::Side;
use super::phasor::{At, Corrected, Crosses, Line, Rates, Steady, clear, inside};
use crate::numerics::lanes::Real;

/// Part of a panel below which it is not halved further: the slow search takes over.
const SHORTEST: f64 = 1e-3;
/// Corrections of a root before the slow search takes over; from inverse interpolation one suffices.
pub(super) const CORRECTIONS: u32 = 6;

/// Where a flight begins.
#[derive(Debug, Clone, Copy)]
pub(super) struct Takeoff {
    pub x: f64,
    pub v: f64,
    pub steady: Steady<f64>,
    pub line: Line<f64>,
    /// Time until the period is over.
    pub left: f64,
}

/// How a flight ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Landing {
    /// On a wall.
    Impact { side: Side, time: f64, x: f64, v: f64, steady: Steady<f64> },
    /// The period is over.
    PeriodEnd { time: f64, x: f64, v: f64 },
    /// Nothing is proven: the slow search must fly it.
    Doubt,
}

impl Rates<f64> {
    /// Flies to the first impact or the end of the period. Evaluations of the motion are added to
    /// `evaluations`.
    pub(super) fn fly(&self, from: &Takeoff, evaluations: &mut u64) -> Landing {
        let Takeoff { x, v, steady, line, left } = *from;
        let (mut here, jerk) = self.begin(x, v, steady, line);
        let mut time = 0.0;
        loop {
            let mut length = self.step;
            let mut there = self.next(&here, line.from(time + length));
            *evaluations += 1;
            let met = loop {
                if clear(&here, &there, length, jerk) {
                    break None;
                }
                if let Some(found) = self.meets(&here, &there, length, jerk) {
                    break Some(found);
                }
                if inside(&here, &there, length, jerk) {
                    break None;
                }
                if length < SHORTEST * self.step {
                    return Landing::Doubt;
                }
                length *= 0.5;
                there = self.after(&here, length, line.from(time));
                *evaluations += 1;
            };
            if let Some((side, guess)) = met {
                let line = line.from(time);
                let Some(found) = self.root(&here, guess, length, line, side, evaluations) else {
                    return Landing::Doubt;
                };
                if found.time <= left - time {
                    let Corrected { x, v, steady, .. } = found;
                    return Landing::Impact { side, time: time + found.time, x, v, steady };
                }
            }
            if left <= time + length {
                *evaluations += 1;
                let (x, v) = self.oscillator(&self.after(&here, left - time, line.from(time)));
                return Landing::PeriodEnd { time: left, x, v };
            }
            (here, time) = (there, time + length);
        }
    }

    /// Which wall the gap is proven to meet once in a panel, and when, nearly.
    fn meets(
        &self,
        here: &At<f64>,
        there: &At<f64>,
        length: f64,
        jerk: f64,
    ) -> Option<(Side, f64)> {
        let side = if there.gap > 0.0 { Side::Plus } else { Side::Minus };
        let Crosses { rises, dips } = Self::crosses(here, there, length, jerk, side.sign());
        (rises || dips).then(|| (side, Self::guess(here, there, length, side.sign(), dips)))
    }

    /// The only crossing in a panel, near `guess`.
    fn root(
        &self,
        here: &At<f64>,
        guess: f64,
        length: f64,
        line: Line<f64>,
        side: Side,
        evaluations: &mut u64,
    ) -> Option<Corrected<f64>> {
        let mut time = guess;
        for _ in 0..CORRECTIONS {
            *evaluations += 1;
            let time_inside = time.larger(0.0).smaller(length);
            let found = self.corrected(here, time_inside, line, side.sign());
            if found.exact {
                return Some(found);
            }
            time = found.time;
        }
        None
    }
}
