//! The largest values that are read in flights: not sampled.
//!
//! In each panel what is read lies between the coefficients of its quintic in Bernstein's form, with the remainder that is
//! proven: only where these exceed what is known is a panel divided, where its quintic is level, until nothing is left but a
//! part of [`PEAK_ERROR`].

use super::motion::{Constants, Free, Gap, Phasors, View, longer, longest};
use super::{MOST, STILL};
use crate::simulation::certificate::{Hull, Quintic};
use crate::simulation::phasor::Slack;

/// Share of a peak by which it may be too small.
const PEAK_ERROR: f64 = 1e-13;
/// Most divisions of a panel, of what is level to rounding, and most parts that wait.
const MOST_PARTS: usize = 200;
const MOST_OPEN: usize = 64;

/// What is read, and its largest value without the sign.
#[derive(Debug)]
pub(super) struct Reader<'a> {
    /// The order of the derivative that it is.
    pub order: usize,
    /// How it sees the motion.
    pub view: &'a View<MOST>,
    /// Its place in the list of largest values.
    pub index: usize,
}

/// Looks at flights of a structure of some modes.
pub(super) trait FindPeaks: Send {
    /// Raises the largest values to those of a flight.
    fn find(&mut self, begin: &Phasors<MOST>, end: &Phasors<MOST>, whole: f64, peaks: &mut [f64]);
}

/// That of as many modes.
pub(super) fn finder(
    constants: &Constants<MOST, MOST>,
    modes: usize,
    readers: &[Reader<'_>],
) -> Box<dyn FindPeaks> {
    match modes {
        1 => Box::new(Finder::<1>::of(constants, readers)),
        2 => Box::new(Finder::<2>::of(constants, readers)),
        3 => Box::new(Finder::<3>::of(constants, readers)),
        4 => Box::new(Finder::<4>::of(constants, readers)),
        _ => Box::new(Finder::<MOST>::of(constants, readers)),
    }
}

struct Finder<const N: usize> {
    constants: Constants<N, 0>,
    /// Those that read a derivative, by its order.
    orders: Vec<(usize, Vec<Read<N>>)>,
}

/// One of them in a flight.
struct Read<const N: usize> {
    view: View<N>,
    index: usize,
    /// Whether it may exceed what is known, and what is.
    open: bool,
    peak: f64,
    slack: Slack<f64>,
    bend: f64,
    /// At the beginning of a panel, and at its end.
    here: Gap,
    there: Gap,
}

impl<const N: usize> Finder<N> {
    fn of(constants: &Constants<MOST, MOST>, readers: &[Reader<'_>]) -> Self {
        let mut orders: Vec<(usize, Vec<Read<N>>)> = Vec::new();
        for reader in readers {
            let nothing = Gap { gap: 0.0, slope: 0.0, a: 0.0 };
            let read = Read {
                view: reader.view.first(),
                index: reader.index,
                open: false,
                peak: 0.0,
                slack: Slack { coefficient: 0.0, slope_squared: 0.0 },
                bend: 0.0,
                here: nothing,
                there: nothing,
            };
            match orders.iter_mut().find(|one| one.0 == reader.order) {
                Some((_, known)) => known.push(read),
                None => orders.push((reader.order, vec![read])),
            }
        }
        orders.sort_by_key(|one| one.0);
        Self { constants: constants.first(), orders }
    }
}

impl<const N: usize> FindPeaks for Finder<N> {
    fn find(&mut self, begin: &Phasors<MOST>, end: &Phasors<MOST>, whole: f64, peaks: &mut [f64]) {
        let Self { constants, orders } = self;
        let mut ends = [begin, end].map(|at| {
            let z = std::array::from_fn(|k| at.z[k]);
            Phasors::<N> { z, rotor: at.rotor }
        });
        let mut derived = 0;
        for (order, reads) in orders {
            while derived < *order {
                ends = ends.map(|at| constants.derivative(&at));
                derived += 1;
            }
            find(constants, reads, ends, whole, peaks);
        }
    }
}

/// Where a flight cannot go beyond what is known, by the sizes of its phasors or by the ends of a panel and a bound on the acceleration
/// between, nothing is looked at.
fn find<const N: usize>(
    constants: &Constants<N, 0>,
    reads: &mut [Read<N>],
    [begin, end]: [Phasors<N>; 2],
    whole: f64,
    peaks: &mut [f64],
) {
    let sizes = constants.sizes(&begin);
    let mut any = false;
    for read in &mut *reads {
        let free = read.view.shape.iter().zip(&sizes).map(|(phi, size)| phi.abs() * size);
        read.peak = peaks[read.index];
        read.open = free.sum::<f64>() + read.view.steady_size > read.peak;
        any |= read.open;
    }
    if !any {
        return;
    }
    let seen = |view: &View<N>, free: &Free<N>, at: &Phasors<N>| {
        Gap::of(constants.seen(view, free, at.rotor), STILL)
    };
    let free = constants.free(&begin);
    for read in reads.iter_mut().filter(|one| one.open) {
        (read.slack, read.bend) = constants.slack(&read.view, &sizes);
        read.here = seen(&read.view, &free, &begin);
        // Both ends are values of the flight: the longer panels are then told from what is small beside them.
        read.peak = read.peak.max(read.here.gap.abs()).max(read.view.at(&end).abs());
    }
    // Of what is known, as the certificate of flights is of a clearance.
    let slack = |read: &Read<N>| read.slack.coefficient / read.peak;
    let most = longest(reads.iter().filter(|one| one.open).map(slack));
    let (mut here, mut left, mut times) = (begin, whole, most);
    while left > 0.0 {
        let mut length = constants.step * longer(times);
        if times > 0 && length > left {
            times -= 1;
            continue;
        }
        let there = if length <= left {
            constants.next(&here, times)
        } else {
            length = left;
            end
        };
        let free = constants.free(&there);
        let mut clear = true;
        for read in reads.iter_mut().filter(|one| one.open) {
            read.there = seen(&read.view, &free, &there);
            if times > 0 {
                let slack = read.slack.part(longer(times));
                clear &= Hull::of(&read.here, &read.there, length, &slack).highest() <= read.peak;
            } else if read.may_exceed(length) {
                let moment = |s: f64| {
                    let at = constants.after(&here, s);
                    seen(&read.view, &constants.free(&at), &at)
                };
                let slack = read.slack.part(length / constants.step);
                let ends = [read.here, read.there];
                read.peak = highest(moment, ends, length, slack, read.peak);
                clear = false;
            }
        }
        if times > 0 && !clear {
            times -= 1;
            continue;
        }
        if !clear {
            times = most;
        }
        (here, left) = (there, left - length);
        reads.iter_mut().for_each(|read| read.here = read.there);
    }
    reads.iter().for_each(|read| peaks[read.index] = read.peak);
}

impl<const N: usize> Read<N> {
    /// Whether it may in a panel exceed what is known, by its ends and a bound on the acceleration.
    #[inline(always)]
    fn may_exceed(&self, length: f64) -> bool {
        let ends = self.here.gap.abs().max(self.there.gap.abs());
        ends + 0.125 * self.bend * length * length > self.peak
    }
}

/// The largest that is read in a panel, or what is known.
pub(super) fn highest(
    moment: impl Fn(f64) -> Gap,
    [here, there]: [Gap; 2],
    whole: f64,
    slack: Slack<f64>,
    mut peak: f64,
) -> f64 {
    peak = peak.max(here.gap.abs()).max(there.gap.abs());
    if Hull::of(&here, &there, whole, &slack).highest() <= peak {
        return peak;
    }
    let mut open = [(0.0, here, whole, there); MOST_OPEN];
    let mut count = 1;
    for _ in 0..MOST_PARTS {
        if count == 0 {
            break;
        }
        count -= 1;
        let (begin, here, end, there) = open[count];
        peak = peak.max(there.gap.abs());
        let length = end - begin;
        let slack = slack.part(length / whole);
        if Hull::of(&here, &there, length, &slack).highest() <= peak * (1.0 + PEAK_ERROR) {
            continue;
        }
        let turns = here.slope * there.slope < 0.0;
        let quintic = Quintic::through(&here, &there, length);
        let at = if turns { quintic.turning_point().at } else { 0.5 };
        let middle = begin + at.clamp(0.01, 0.99) * length;
        let between = moment(middle);
        peak = peak.max(between.gap.abs());
        if count + 2 > MOST_OPEN {
            break;
        }
        open[count] = (begin, here, middle, between);
        open[count + 1] = (middle, between, end, there);
        count += 2;
    }
    peak
}
