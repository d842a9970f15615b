//! The largest displacement in a flight: at its ends, or where the velocity vanishes. A panel is looked at
//! closer only where its quintic lets it exceed what is known. For one flight or for several of a
//! trajectory side by side, with the same bits.

use fearless_simd::{Level, Simd, dispatch};

use super::certificate::Quintic;
use super::phasor::{At, Line, Rates, Steady};
use super::run::PANEL;
use crate::numerics::lanes::{LANES, Mask, Real, Wide};
use crate::tally;

/// The oscillator at one moment.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moment<R> {
    pub x: R,
    pub v: R,
    pub steady: Steady<R>,
}

/// What the oscillator does between two events.
#[derive(Debug, Clone, Copy)]
pub(super) struct Flight<R> {
    pub begin: Moment<R>,
    pub duration: R,
    /// Its end, where that is at hand.
    pub end: Option<Moment<R>>,
}

/// That of one flight.
pub(super) fn alone(
    rates: &Rates<f64>,
    [x, v]: [f64; 2],
    steady: Steady<f64>,
    duration: f64,
) -> f64 {
    let panels = (duration / rates.step).ceil().max(1.0);
    tally::note(PANEL * panels as u64);
    let flight = Flight { begin: Moment { x, v, steady }, duration, end: None };
    dispatch!(Level::baseline(), simd => highest(simd, rates, &flight))
}

/// Those of up to [`LANES`] flights; more are left out.
pub(super) fn together(rates: &Rates<f64>, flights: &[Flight<f64>]) -> [f64; LANES] {
    dispatch!(Level::new(), simd => side_by_side(simd, rates, flights))
}

#[inline(always)]
fn side_by_side<S: Simd>(simd: S, rates: &Rates<f64>, flights: &[Flight<f64>]) -> [f64; LANES] {
    simd.vectorize(
        #[inline(always)]
        || {
            let zero = Wide::splat(simd, 0.0);
            let nowhere = Moment { x: zero, v: zero, steady: Steady { x: zero, v: zero } };
            let (mut begin, mut end, mut duration) = (nowhere, nowhere, zero);
            for (lane, flight) in flights.iter().enumerate().take(LANES) {
                let ends = [(&mut begin, Some(flight.begin)), (&mut end, flight.end)];
                for (wide, moment) in ends.into_iter().filter_map(|(w, m)| Some((w, m?))) {
                    wide.x[lane] = moment.x;
                    wide.v[lane] = moment.v;
                    wide.steady.x[lane] = moment.steady.x;
                    wide.steady.v[lane] = moment.steady.v;
                }
                duration[lane] = flight.duration;
            }
            let known = flights.iter().all(|flight| flight.end.is_some());
            let flight = Flight { begin, duration, end: known.then_some(end) };
            let rates = rates.map(
                #[inline(always)]
                |rate| Wide::splat(simd, rate),
            );
            let highest = highest(simd, &rates, &flight);
            std::array::from_fn(|lane| highest[lane])
        },
    )
}

/// The largest absolute displacement in a flight.
#[inline(always)]
fn highest<R: Real, S: Simd>(simd: S, rates: &Rates<R>, flight: &Flight<R>) -> R {
    let zero = flight.duration.like(0.0);
    // Seen from the base the gap is the displacement.
    let base = Line { y: zero, velocity: zero };
    let Moment { x, v, steady } = flight.begin;
    let (mut here, slack) = rates.begin(x, v, steady, base);
    let end = flight.end.map(|Moment { x, v, steady }| rates.begin(x, v, steady, base).0);
    let (mut left, mut peak) = (flight.duration, here.gap.abs());
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
