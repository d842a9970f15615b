//! The largest displacement in flights, and their integrals, several of a trajectory side by side. It is at an
//! end, or where the velocity vanishes: a panel is looked at closer only where its quintic lets it exceed
//! what is known.

use fearless_simd::{Level, Simd, dispatch};

use super::certificate::{Quintic, Slack};
use super::integrals::{Ends, Integrals, Ringing, Turning};
use super::phasor::{At, Line, Rates, Steady};
use crate::numerics::lanes::{LANES, Mask, Real, Wide};

/// The oscillator at one moment.
#[derive(Debug, Clone, Copy)]
struct Moment<R> {
    x: R,
    v: R,
    steady: Steady<R>,
}

/// What a flight adds to what is measured.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Measured {
    pub peak: f64,
    /// None where they are not asked for.
    pub integrals: Option<Integrals<f64>>,
}

/// Measures up to [`LANES`] flights; more are left out.
pub(super) fn together(
    ringing: &Ringing,
    flights: &[Ends<f64>],
    integrals: bool,
) -> [Measured; LANES] {
    dispatch!(Level::new(), simd => side_by_side(simd, ringing, flights, integrals))
}

#[inline(always)]
fn side_by_side<S: Simd>(
    simd: S,
    ringing: &Ringing,
    flights: &[Ends<f64>],
    integrals: bool,
) -> [Measured; LANES] {
    simd.vectorize(
        #[inline(always)]
        || {
            let ends = gathered(simd, flights);
            let excitation = ringing.excitation(simd, &ends);
            let rates = Rates::gathered(
                #[inline(always)]
                |rate| Wide::splat(simd, rate(&ringing.rates)),
            );
            let begin = ringing.moment(&ends, &excitation, 0);
            let end = ringing.moment(&ends, &excitation, 1);
            let duration = (ends.phase[1] - ends.phase[0]) * rates.inverse_frequency;
            let peaks = highest(simd, &rates, &begin, duration, &end);
            let mut measured = [Measured::default(); LANES];
            for (lane, one) in measured.iter_mut().enumerate() {
                one.peak = peaks[lane];
            }
            if integrals {
                let integrals = ringing.over(simd, &ends, excitation);
                for (lane, one) in measured.iter_mut().enumerate() {
                    one.integrals = Some(integrals.at(lane));
                }
            }
            measured
        },
    )
}

impl Ringing {
    /// The oscillator at either end of flights.
    #[inline(always)]
    fn moment<R: Real>(&self, ends: &Ends<R>, excitation: &[Turning<R>; 2], k: usize) -> Moment<R> {
        let steady = excitation[k].scaled(self.steady);
        let v = -(steady.im * self.rates.frequency);
        Moment { x: ends.x[k], v: ends.v[k], steady: Steady { x: steady.re, v } }
    }
}

/// Flights side by side; the lanes that are left have a flight of no duration.
#[inline(always)]
fn gathered<S: Simd>(simd: S, flights: &[Ends<f64>]) -> Ends<Wide<S>> {
    let zero = Wide::splat(simd, 0.0);
    let mut all = Ends { phase: [zero; 2], x: [zero; 2], v: [zero; 2], y: zero, y_velocity: zero };
    for (lane, flight) in flights.iter().enumerate().take(LANES) {
        for k in 0..2 {
            all.phase[k][lane] = flight.phase[k];
            all.x[k][lane] = flight.x[k];
            all.v[k][lane] = flight.v[k];
        }
        all.y[lane] = flight.y;
        all.y_velocity[lane] = flight.y_velocity;
    }
    all
}

impl<S: Simd> Integrals<Wide<S>> {
    /// Those of one flight.
    #[inline(always)]
    fn at(&self, lane: usize) -> Integrals<f64> {
        Integrals {
            displacement_squared: self.displacement_squared[lane],
            velocity_squared: self.velocity_squared[lane],
            work: self.work[lane],
            oscillator: [self.oscillator[0][lane], self.oscillator[1][lane]],
            absorber: [self.absorber[0][lane], self.absorber[1][lane]],
        }
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
    end: &Moment<R>,
) -> R {
    let zero = duration.like(0.0);
    let base = Line { y: zero, velocity: zero };
    let (mut here, slack) = begin.seen(rates, base);
    let (end, _) = end.seen(rates, base);
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
            there = At::choose(last, &end, &there);
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
