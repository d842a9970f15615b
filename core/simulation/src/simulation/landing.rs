//! Where a piece of flight ends: panel by panel until one may hold an event, and there by halving, up to what is proven.

use fearless_simd::Simd;

use super::certificate::{Hull, Quintic};
use super::events::Side;
use super::path::Path;
use super::phasor::{FlightState, Rates, Slack, Steady};
use super::roots::Corrected;
use super::sliding::CavityFlight;
use crate::numerics::lanes::Real;

/// Part of a panel below which it is not halved further: the slow search takes over.
const SHORTEST: f64 = 1e-3;
/// Most panels in a piece: the excitation turns by less than a period in one.
pub(super) const PANELS: u32 = 7;
/// Corrections of a root before the slow search takes over; from the quintic's root one suffices.
pub(super) const CORRECTIONS: u32 = 6;

/// What a piece of flight ends with.
#[derive(Debug, Clone, Copy)]
pub(super) enum Ending {
    /// An impact on this wall.
    Wall(Side),
    /// The end of sliding.
    Turn,
    /// Nothing: the flight goes on.
    Midair,
    /// A panel about which nothing is proven: it is to be flown in short ones.
    Doubtful,
}

/// Where a piece of flight ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct Landing {
    pub end: Ending,
    /// Time since it began.
    pub time: f64,
    pub x: f64,
    pub v: f64,
    pub steady: Steady<f64>,
}

impl Rates<f64> {
    /// Flies to the first event, or as far as a piece reaches or beyond the time `until`; none where nothing is proven.
    /// Evaluations of the motion are added to `evaluations`.
    #[inline(always)]
    pub(super) fn fly<S: Simd, C: CavityFlight>(
        &self,
        simd: S,
        mut here: FlightState<f64>,
        slack: Slack<f64>,
        flight: &Flight<C>,
        evaluations: &mut u64,
    ) -> Option<Landing> {
        let Flight { course, sense, path, fine, until } = *flight;
        let mut time = 0.0;
        for _ in 0..PANELS {
            let reach = time + self.step;
            let there = self.next(&here, path.from(reach));
            *evaluations += 1;
            let hull = Hull::of(&here, &there, self.step, &slack);
            if !(hull.clear() && course.one_way(sense, &hull, [&here, &there])) {
                let mut panel = FlightPanel { here, there, time, length: self.step, slack };
                if let Some(length) = course.reach(sense, &here, self.step) {
                    let there = self.moment(simd, &here, length, path.from(time));
                    let slack = slack.part(length / self.step);
                    panel = FlightPanel { there, length, slack, ..panel };
                    *evaluations += 1;
                }
                let found = self.look_into(simd, &panel, flight, evaluations);
                return match fine {
                    false => found
                        .or(Some(Landing { end: Ending::Doubtful, ..self.midair(&here, time) })),
                    // What was proven before stands.
                    true => found.or_else(|| (time > 0.0).then(|| self.midair(&here, time))),
                };
            }
            (here, time) = (there, reach);
            if until < time {
                break;
            }
        }
        Some(self.midair(&here, time))
    }

    /// A piece that ends without an event.
    #[inline(always)]
    fn midair(&self, at: &FlightState<f64>, time: f64) -> Landing {
        let (x, v) = self.oscillator(at);
        Landing { end: Ending::Midair, time, x, v, steady: at.steady }
    }

    /// Looks for an event in a panel that is not proven to be clear, or in the first part of it about
    /// which something is; none where nothing is.
    #[inline(always)]
    fn look_into<S: Simd, C: CavityFlight>(
        &self,
        simd: S,
        panel: &FlightPanel,
        flight: &Flight<C>,
        evaluations: &mut u64,
    ) -> Option<Landing> {
        let FlightPanel { here, mut there, time, mut length, mut slack } = *panel;
        let Flight { course, sense, path, fine, .. } = *flight;
        let path_here = path.from(time);
        let shortest = if fine { SHORTEST * length } else { f64::INFINITY };
        let mut hull = Hull::of(&here, &there, length, &slack);
        // The first part of a panel may be.
        let mut clear =
            length < self.step && hull.clear() && course.one_way(sense, &hull, [&here, &there]);
        while !clear {
            let side = Side::of(there.gap);
            let one_way = course.one_way(sense, &hull, [&here, &there]);
            if one_way && hull.meets(side.sign()) {
                let guess = Guess { length, side, path: path_here };
                let found = self.root(simd, [&here, &there], guess, &slack, evaluations);
                if let Some(found) = found {
                    return Some(found.after(time));
                }
            }
            let ends = [&here, &there];
            if !one_way && hull.clear() && course.turns(sense, &hull, ends) {
                let found = self.turn(simd, ends, length, path_here, &slack, evaluations);
                if let Some(found) = found {
                    return Some(found.after(time));
                }
            }
            if length < shortest {
                return None;
            }
            (length, slack) = (length * 0.5, slack.part(0.5));
            there = self.moment(simd, &here, length, path_here);
            *evaluations += 1;
            hull = Hull::of(&here, &there, length, &slack);
            clear = hull.clear() && course.one_way(sense, &hull, [&here, &there]);
        }
        Some(self.midair(&there, time + length))
    }

    /// When sliding ends in a panel in which it is proven to; none where the moment is not sharp.
    #[inline(never)]
    fn turn<S: Simd>(
        &self,
        simd: S,
        [here, there]: [&FlightState<f64>; 2],
        length: f64,
        path: impl Path<f64>,
        slack: &Slack<f64>,
        evaluations: &mut u64,
    ) -> Option<Landing> {
        let sense = -there.slope.signum();
        let bend_squared = slack.bend_squared(self.fastest, length);
        // From rest it does not turn where it begins.
        let first = if here.slope == 0.0 { 0.5 } else { here.slope / (here.slope - there.slope) };
        let mut time = Quintic::through(here, there, length).level(first) * length;
        for _ in 0..CORRECTIONS {
            *evaluations += 1;
            let found = simd.vectorize(
                #[inline(always)]
                || self.levelled(simd, here, time, path, sense, bend_squared),
            );
            let Corrected { time: at, x, v, steady, .. } = found;
            if found.exact {
                return Some(Landing { end: Ending::Turn, time: at, x, v, steady });
            }
            time = at.clamp(0.0, length);
        }
        None
    }

    /// As [`Self::after`], for what is rare.
    #[inline(never)]
    fn moment<S: Simd>(
        &self,
        simd: S,
        here: &FlightState<f64>,
        s: f64,
        path: impl Path<f64>,
    ) -> FlightState<f64> {
        simd.vectorize(
            #[inline(always)]
            || self.after(simd, here, s, path),
        )
    }

    /// The first crossing in a panel that is proven to have one, from the panel's beginning.
    #[inline(always)]
    fn root<S: Simd>(
        &self,
        simd: S,
        [here, there]: [&FlightState<f64>; 2],
        guess: Guess<impl Path<f64>>,
        slack: &Slack<f64>,
        evaluations: &mut u64,
    ) -> Option<Landing> {
        let Guess { length, side, path } = guess;
        let mut time = Self::guess(here, there, length, side.sign(), true);
        for _ in 0..CORRECTIONS {
            *evaluations += 1;
            let inside = time.larger(0.0).smaller(length);
            let found = self.corrected(simd, here, inside, path, side.sign(), slack);
            time = found.time;
            if found.exact {
                let Corrected { x, v, steady, .. } = found;
                return Some(Landing { end: Ending::Wall(side), time, x, v, steady });
            }
        }
        None
    }
}

impl Landing {
    /// The same, seen from a time before.
    #[inline(always)]
    fn after(self, time: f64) -> Self {
        Self { time: time + self.time, ..self }
    }
}

/// A panel of a flight, or its first part.
struct FlightPanel {
    here: FlightState<f64>,
    there: FlightState<f64>,
    /// Time from the flight's beginning to its own.
    time: f64,
    length: f64,
    slack: Slack<f64>,
}

/// A flight under way.
pub(super) struct Flight<C: CavityFlight> {
    pub course: C,
    /// Sign of `x' - y'`, where it has to stay.
    pub sense: f64,
    pub path: C::Path,
    /// Whether a panel about which nothing is proven is to be halved.
    pub fine: bool,
    /// Time after which nobody wants to know more.
    pub until: f64,
}

/// Where a flight ends in a panel.
#[derive(Debug, Clone, Copy)]
struct Guess<P> {
    length: f64,
    side: Side,
    path: P,
}
