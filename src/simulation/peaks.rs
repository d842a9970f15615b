//! The largest displacement in a flight: at its ends, or where the velocity vanishes. A panel is looked at
//! closer only where its quintic lets it exceed what is known. For one flight or for several of a
//! trajectory side by side, with the same bits.

use fearless_simd::{Level, Simd, dispatch};

use super::certificate::{Quintic, Slack};
use super::phasor::{At, Line, Rates, Steady};
use super::run::PANEL;
use crate::numerics::lanes::{LANES, Mask, Real, Wide};
use crate::operation_count;

/// The oscillator at one moment.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moment<R> {
    pub x: R,
    pub v: R,
    pub steady: Steady<R>,
}

/// What the oscillator does between two events.
#[derive(Debug, Clone, Copy)]
pub(super) struct Flight {
    /// Whole periods before it.
    pub period: u64,
    pub begin: Moment<f64>,
    pub duration: f64,
    pub end: Moment<f64>,
}

/// That of one flight, whose end is not at hand.
pub(super) fn alone(rates: &Rates<f64>, begin: &Moment<f64>, duration: f64) -> f64 {
    let panels = (duration / rates.step).ceil().max(1.0);
    operation_count::note(PANEL * panels as u64);
    dispatch!(Level::baseline(), simd => highest(simd, rates, begin, duration, None))
}

/// Those of up to [`LANES`] flights; more are left out.
pub(super) fn together(rates: &Rates<f64>, flights: &[Flight]) -> [f64; LANES] {
    dispatch!(Level::new(), simd => side_by_side(simd, rates, flights))
}

#[inline(always)]
fn side_by_side<S: Simd>(simd: S, rates: &Rates<f64>, flights: &[Flight]) -> [f64; LANES] {
    simd.vectorize(
        #[inline(always)]
        || {
            let zero = Wide::splat(simd, 0.0);
            let nowhere = Moment { x: zero, v: zero, steady: Steady { x: zero, v: zero } };
            let (mut begin, mut end, mut duration) = (nowhere, nowhere, zero);
            for (lane, flight) in flights.iter().enumerate().take(LANES) {
                begin.set(lane, &flight.begin);
                end.set(lane, &flight.end);
                duration[lane] = flight.duration;
            }
            let rates = Rates::gathered(
                #[inline(always)]
                |rate| Wide::splat(simd, rate(rates)),
            );
            let highest = highest(simd, &rates, &begin, duration, Some(&end));
            std::array::from_fn(|lane| highest[lane])
        },
    )
}

impl<S: Simd> Moment<Wide<S>> {
    #[inline(always)]
    fn set(&mut self, lane: usize, one: &Moment<f64>) {
        self.x[lane] = one.x;
        self.v[lane] = one.v;
        self.steady.x[lane] = one.steady.x;
        self.steady.v[lane] = one.steady.v;
    }
}

impl<R: Real> Moment<R> {
    /// Seen from the base, where the gap is the displacement.
    #[inline(always)]
    fn seen(&self, rates: &Rates<R>, base: Line<R>) -> (At<R>, Slack<R>) {
        rates.begin(self.x, self.v, self.steady, base)
    }
}

/// The largest absolute displacement in a flight.
#[inline(always)]
fn highest<R: Real, S: Simd>(
    simd: S,
    rates: &Rates<R>,
    begin: &Moment<R>,
    duration: R,
    end: Option<&Moment<R>>,
) -> R {
    let zero = duration.like(0.0);
    let base = Line { y: zero, velocity: zero };
    let (mut here, slack) = begin.seen(rates, base);
    let end = end.map(|end| end.seen(rates, base).0);
    let (mut left, mut peak) = (duration, here.gap.abs());
    loop {
        let flying = zero.less(left);
        if !flying.any() {
            return peak;
        }
        let last = left.less(rates.step);
        let length = rates.step.smaller(left);
        let mut there = rates.next(&here, base);
        if last.any() {
            let short = || rates.after(simd, &here, length.larger(zero), base);
            there = At::choose(last, &end.unwrap_or_else(short), &there);
        }
        peak = R::choose(flying, peak.larger(there.gap.abs()), peak);
        let turns = flying & (here.slope * there.slope).less(zero);
        if turns.any() {
            let turn = Quintic::through(&here, &there, length).turning_point();
            let open = turns & !turn.highest(&slack).at_most(peak);
            if open.any() {
                let guess = turn.at * length;
                let height = rates.turning_point(simd, &here, guess, length, open);
                peak = R::choose(open, peak.larger(height.abs()), peak);
            }
        }
        (here, left) = (there, left - rates.step);
    }
}
