//! One flight of one trajectory, panel by panel: see [`super::phasor`] for the formulas and the proof.

use fearless_simd::{Level, Simd, dispatch};

use super::events::Side;
use super::phasor::{At, Corrected, Hull, Line, Rates, Slack, Steady};
use crate::numerics::lanes::Real;

/// Part of a panel below which it is not halved further: the slow search takes over.
const SHORTEST: f64 = 1e-3;
/// Corrections of a root before the slow search takes over; from the quintic's root one suffices.
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

/// Where a flight ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct Landing {
    /// On which wall; none where the period is over first.
    pub wall: Option<Side>,
    /// Time since it began.
    pub time: f64,
    pub x: f64,
    pub v: f64,
    pub steady: Steady<f64>,
}

impl Rates<f64> {
    /// Flies to the first impact or the end of the period, by the instructions of `level`; none where
    /// nothing is proven, and the slow search must fly. Evaluations of the motion are added to
    /// `evaluations`.
    pub(super) fn fly(
        &self,
        level: Level,
        from: &Takeoff,
        evaluations: &mut u64,
    ) -> Option<Landing> {
        dispatch!(level, simd => self.fly_by(simd, from, evaluations))
    }

    /// By the instructions that `simd` stands for.
    #[inline(always)]
    fn fly_by<S: Simd>(&self, simd: S, from: &Takeoff, evaluations: &mut u64) -> Option<Landing> {
        let Takeoff { x, v, steady, line, left } = *from;
        let (mut here, slack) = self.begin(x, v, steady, line);
        if self.short(&here) {
            return None;
        }
        let mut time = 0.0;
        loop {
            let (mut length, mut slack) = (self.step, slack);
            let mut there = self.next(&here, line.from(time + length));
            *evaluations += 1;
            loop {
                let hull = Hull::of(&here, &there, length, &slack);
                if hull.clear() {
                    break;
                }
                let side = if there.gap > 0.0 { Side::Plus } else { Side::Minus };
                if hull.meets(side.sign()) {
                    let guess = Self::guess(&here, &there, length, side.sign(), true);
                    let guess = guess.larger(0.0).smaller(length);
                    let (line, rest) = (line.from(time), left - time);
                    if rest < guess {
                        *evaluations += 1;
                        let at = self.moment(simd, &here, rest, line);
                        if slack.before(&at, side.sign()) {
                            let (x, v) = self.oscillator(&at);
                            return Some(Landing {
                                wall: None,
                                time: left,
                                x,
                                v,
                                steady: self.origin,
                            });
                        }
                    }
                    let guess = Guess { time: guess, length, side, line };
                    if let Some(found) = self.root(simd, &here, guess, &slack, evaluations) {
                        if rest < found.time {
                            break;
                        }
                        let Corrected { x, v, steady, .. } = found;
                        let time = time + found.time;
                        return Some(Landing { wall: Some(side), time, x, v, steady });
                    }
                }
                if length < SHORTEST * self.step {
                    return None;
                }
                (length, slack) = (length * 0.5, slack.halved());
                there = self.moment(simd, &here, length, line.from(time));
                *evaluations += 1;
            }
            if left <= time + length {
                *evaluations += 1;
                let (x, v) =
                    self.oscillator(&self.moment(simd, &here, left - time, line.from(time)));
                return Some(Landing { wall: None, time: left, x, v, steady: self.origin });
            }
            (here, time) = (there, time + length);
        }
    }

    /// As [`Self::after`]; kept out of the loop over panels, into which it would be hoisted.
    #[inline(never)]
    fn moment<S: Simd>(&self, simd: S, here: &At<f64>, s: f64, line: Line<f64>) -> At<f64> {
        simd.vectorize(
            #[inline(always)]
            || self.after(here, s, line),
        )
    }

    /// The first crossing in a panel that is proven to have one.
    #[inline(never)]
    fn root<S: Simd>(
        &self,
        simd: S,
        here: &At<f64>,
        guess: Guess,
        slack: &Slack<f64>,
        evaluations: &mut u64,
    ) -> Option<Corrected<f64>> {
        simd.vectorize(
            #[inline(always)]
            || {
                let Guess { mut time, length, side, line } = guess;
                for _ in 0..CORRECTIONS {
                    *evaluations += 1;
                    let inside = time.larger(0.0).smaller(length);
                    let found = self.corrected(here, inside, line, side.sign(), slack);
                    if found.exact {
                        return Some(found);
                    }
                    time = found.time;
                }
                None
            },
        )
    }
}

/// Roughly when and where a flight ends in a panel.
#[derive(Debug, Clone, Copy)]
struct Guess {
    time: f64,
    length: f64,
    side: Side,
    line: Line<f64>,
}
