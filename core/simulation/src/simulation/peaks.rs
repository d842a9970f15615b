//! The largest displacement in flights, and their integrals, several of a trajectory side by side. It is at an
//! end, or where the velocity vanishes: a panel is looked at closer only where its quintic lets it exceed
//! what is known.

use fearless_simd::{Level, Simd, dispatch};

use super::certificate::Quintic;
use super::integrals::{FlightEnds, Integrals, Ringing, Turning};
use super::path::StraightLine;
use super::phasor::{FlightState, Rates, Slack, Steady};
use crate::numerics::lanes::{LANES, Mask, Real, Wide};

/// The oscillator at one moment, seen from where it would rest.
#[derive(Debug, Clone, Copy)]
struct OscillatorMoment<R> {
    x: R,
    v: R,
    steady: Steady<R>,
}

/// What flights add to what is measured.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Contribution {
    pub peaks: [f64; LANES],
    pub integrals: Integrals<[f64; LANES]>,
}

/// Measures [`LANES`] flights.
pub(super) fn together(
    ringing: &Ringing,
    flights: &FlightEnds<[f64; LANES]>,
    measured: &mut Contribution,
) {
    dispatch!(Level::new(), simd => side_by_side(simd, ringing, flights, measured));
}

#[inline(always)]
fn side_by_side<S: Simd>(
    simd: S,
    ringing: &Ringing,
    flights: &FlightEnds<[f64; LANES]>,
    measured: &mut Contribution,
) {
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
            let base = -ends.rest;
            highest(simd, &rates, base, &begin, duration, &end).store(&mut measured.peaks);
            ringing.over(simd, &ends, excitation).store(&mut measured.integrals);
        },
    );
}

impl Ringing {
    /// The oscillator at either end of flights.
    #[inline(always)]
    fn moment<R: Real>(
        &self,
        ends: &FlightEnds<R>,
        excitation: &[Turning<R>; 2],
        k: usize,
    ) -> OscillatorMoment<R> {
        let steady = excitation[k].scaled(self.steady);
        let v = -(steady.im * self.rates.frequency);
        let x = ends.x[k] - ends.rest;
        OscillatorMoment { x, v: ends.v[k], steady: Steady { x: steady.re, v } }
    }
}

/// Flights side by side.
#[inline(always)]
fn gathered<S: Simd>(simd: S, flights: &FlightEnds<[f64; LANES]>) -> FlightEnds<Wide<S>> {
    let FlightEnds { phase, x, v, y, y_velocity, y_acceleration, rest } = flights;
    FlightEnds {
        phase: [Wide::load(simd, &phase[0]), Wide::load(simd, &phase[1])],
        x: [Wide::load(simd, &x[0]), Wide::load(simd, &x[1])],
        v: [Wide::load(simd, &v[0]), Wide::load(simd, &v[1])],
        y: Wide::load(simd, y),
        y_velocity: Wide::load(simd, y_velocity),
        y_acceleration: Wide::load(simd, y_acceleration),
        rest: Wide::load(simd, rest),
    }
}

impl<S: Simd> Integrals<Wide<S>> {
    #[inline(always)]
    fn store(&self, to: &mut Integrals<[f64; LANES]>) {
        self.displacement_squared.store(&mut to.displacement_squared);
        self.velocity_squared.store(&mut to.velocity_squared);
        self.work.store(&mut to.work);
        for k in 0..2 {
            self.oscillator[k].store(&mut to.oscillator[k]);
            self.absorber[k].store(&mut to.absorber[k]);
        }
    }
}

impl Integrals<[f64; LANES]> {
    /// Those of one flight.
    pub(super) fn at(&self, lane: usize) -> Integrals<f64> {
        Integrals {
            displacement_squared: self.displacement_squared[lane],
            velocity_squared: self.velocity_squared[lane],
            work: self.work[lane],
            oscillator: [self.oscillator[0][lane], self.oscillator[1][lane]],
            absorber: [self.absorber[0][lane], self.absorber[1][lane]],
        }
    }
}

impl<R: Real> OscillatorMoment<R> {
    /// Seen from the base, where the gap is the displacement.
    #[inline(always)]
    fn seen(&self, rates: &Rates<R>, base: StraightLine<R>) -> (FlightState<R>, Slack<R>) {
        rates.begin(self.x, self.v, self.steady, base)
    }
}

/// A panel at whose ends the velocity differs in sign.
#[derive(Debug, Clone, Copy)]
struct Turn<R> {
    here: FlightState<R>,
    there: FlightState<R>,
    length: R,
}

impl<R: Real> Turn<R> {
    /// The largest displacement known, and what some flights reach where they turn.
    #[inline(always)]
    fn highest<S: Simd>(
        &self,
        simd: S,
        rates: &Rates<R>,
        base: StraightLine<R>,
        slack: &Slack<R>,
        lanes: R::Mask,
        known: R,
    ) -> R {
        let Self { here, there, length } = self;
        let turn = Quintic::through(here, there, *length).turning_point();
        let open = lanes & !turn.highest(slack).at_most(known);
        if !open.any() {
            return known;
        }
        let height = rates.turning_point(simd, here, base, turn.at * *length, *length, open);
        R::choose(open, known.larger(height.abs()), known)
    }
}

/// The largest absolute displacement in a flight.
#[inline(always)]
fn highest<R: Real, S: Simd>(
    simd: S,
    rates: &Rates<R>,
    base: R,
    begin: &OscillatorMoment<R>,
    duration: R,
    end: &OscillatorMoment<R>,
) -> R {
    let zero = duration.like(0.0);
    let base = StraightLine { y: base, velocity: zero };
    let (mut here, slack) = begin.seen(rates, base);
    let (end, _) = end.seen(rates, base);
    let (mut left, mut peak) = (duration, here.gap.abs());
    // Most flights turn once: where, is kept until one of them turns again, and looked at together.
    let (mut turn, mut turned) = (Turn { here, there: here, length: left }, zero.less(zero));
    loop {
        let flying = zero.less(left);
        let last = left.less(rates.step);
        let length = rates.step.smaller(left);
        let mut there = rates.next(&here, base);
        if last.any() {
            there = FlightState::choose(last, &end, &there);
        }
        peak = R::choose(flying, peak.larger(there.gap.abs()), peak);
        let turns = flying & (here.slope * there.slope).less(zero);
        let over = !flying.any();
        if over || (turns & turned).any() {
            peak = turn.highest(simd, rates, base, &slack, turned, peak);
            turned = zero.less(zero);
        }
        if over {
            return peak;
        }
        if turns.any() {
            turn.here = FlightState::choose(turns, &here, &turn.here);
            turn.there = FlightState::choose(turns, &there, &turn.there);
            turn.length = R::choose(turns, length, turn.length);
            turned = turned | turns;
        }
        (here, left) = (there, left - rates.step);
    }
}
