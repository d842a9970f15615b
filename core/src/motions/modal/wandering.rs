//! Starts that wander: whether they are transients, what motions they are on, and how long to measure these.
//!
//! They are flown on while others of their place still settle ([`Patience`]), then measured. In a place that is searched in full they are
//! measured again, each time for twice as long, where together they are not one motion yet, look like one that repeats, or where a
//! longer run may come to a good part more than was seen.

use super::flight::{End, Flight, Of, window};
use super::motion::ModalMotion;
use super::search::ModalEffort;
use crate::motions::patience::{Missing, Patience, Thoroughness};
use crate::motions::sampler::VAGUE_IN_FULL;
use crate::simulation::Reading;

/// Impacts of starts that wander, times modes and absorbers, after which a place is given up that is searched in full: some seconds. What
/// still wanders may then be a transient.
const MOST_IMPACTS: f64 = 6e6;
/// Starts above which a search is no thorougher than that: so many fly about as many windows together as where another motion attracts,
/// and the engine of several modes is fifty times slower than that of one.
const THOROUGH: u32 = 6;
/// How often what wanders is measured again where it is not one motion, and where it looks like one that repeats.
const LONGEST: usize = 4;
const FEWEST: usize = 3;

/// Starts of a place that have not settled.
pub(super) struct Wandering {
    open: Vec<Box<Flight>>,
    patience: Patience,
    in_full: bool,
    /// Impacts that they have flown for since, and at most.
    impacts: f64,
    most: f64,
}

impl Wandering {
    /// Those of a search with so many starts and this part of the usual patience.
    pub fn of(open: Vec<Box<Flight>>, of: &Of, starts: u32, part: f64) -> Self {
        let patience = Patience::with(Thoroughness {
            periods: window(of.system, of.periods),
            starts: starts.min(THOROUGH) as usize,
            effort: if part > 0.0 { 1.0 } else { 0.0 },
            place: part,
            in_full: false,
        });
        let size = of.system.modes().len() * of.system.absorbers().len();
        let most = MOST_IMPACTS * part / size as f64;
        Self { open, patience, in_full: part >= ModalEffort::IN_FULL, impacts: 0.0, most }
    }

    fn gives_up(&self) -> bool {
        !self.patience.goes_on() || self.impacts > self.most
    }

    /// What they come to, beside motions that are found.
    pub fn ends(mut self, of: &mut Of, found: &[ModalMotion]) -> Vec<ModalMotion> {
        let mut ends: Vec<ModalMotion> = Vec::new();
        for round in 0..=LONGEST {
            let impatient = self.wait(of, found, &mut ends);
            let count = self.open.len();
            let measured: Vec<ModalMotion> =
                self.open.iter_mut().map(|flight| of.measured(flight, count, 1 << round)).collect();
            let motions = apart(&measured);
            // What looks like a motion that repeats may leave, or settle, slowly.
            let each = || motions.iter().map(|one| &one.0);
            let restless =
                motions.len() > 1 || round < FEWEST && each().any(ModalMotion::looks_repeating);
            let again = self.in_full && !self.gives_up() && round < LONGEST;
            if again && restless {
                self.release(measured, &mut ends);
                let [_, most] = self.next(0.0);
                self.fly_on(of, most, &mut ends);
            } else if !(again && each().any(is_vague)) {
                // There was no time to tell whether they are transients, on their way to what most are on; of many places those are
                // searched again that decide.
                let rank = |k: &usize| (motions[*k].0.starts, motions[*k].1.len());
                let main = (0..motions.len()).max_by_key(rank);
                let gives_up = self.in_full && self.gives_up();
                let open = |k: usize| self.in_full && impatient || gives_up && Some(k) != main;
                let all = motions.into_iter().enumerate().flat_map(|(k, (_, starts))| {
                    let open = open(k);
                    starts.into_iter().map(move |start| (start, open))
                });
                let mut measured = measured;
                all.for_each(|(start, open)| measured[start].settled &= !open);
                ends.extend(measured);
                break;
            }
        }
        ends
    }

    /// Flies them on until patience is at its end; whether it ended before its time.
    fn wait(&mut self, of: &mut Of, found: &[ModalMotion], ends: &mut Vec<ModalMotion>) -> bool {
        while !self.open.is_empty() {
            let beside = found.iter().chain(&*ends).any(|one| one.settled && !one.rests());
            let Missing { windows, usual } = self.patience.missing(self.open.len(), beside);
            if windows <= 0.0 || self.gives_up() {
                return usual;
            }
            let [each, _] = self.next(windows);
            self.fly_on(of, each, ends);
        }
        false
    }

    /// Lets go of those that were seen to repeat.
    fn release(&mut self, measured: Vec<ModalMotion>, ends: &mut Vec<ModalMotion>) {
        for (flight, motion) in std::mem::take(&mut self.open).into_iter().zip(measured) {
            if motion.repeats_after.is_some() {
                self.patience.settles();
                ends.push(motion);
            } else {
                self.open.push(flight);
            }
        }
    }

    /// A round of the patience.
    fn next(&mut self, windows: f64) -> [u64; 2] {
        let busiest = self.open.iter().map(|one| one.busy).fold(0.0, f64::max);
        self.patience.next(windows, self.open.len().max(1), busiest)
    }

    /// Flies all of them on for so many periods; adds those that have settled by then.
    fn fly_on(&mut self, of: &mut Of, periods: u64, ends: &mut Vec<ModalMotion>) {
        for flight in std::mem::take(&mut self.open) {
            self.impacts += flight.busy * periods as f64;
            let most = flight.most_impacts(periods);
            match of.fly_on(*flight, periods, most) {
                End::On(motion) => {
                    if motion.settled {
                        self.patience.settles();
                    }
                    ends.push(*motion);
                }
                End::Open(flight) => {
                    self.patience.flown(periods);
                    self.open.push(flight);
                }
            }
        }
    }
}

/// Motions that wander, each by all of its starts, and which these are.
fn apart(starts: &[ModalMotion]) -> Vec<(ModalMotion, Vec<usize>)> {
    let mut motions: Vec<(ModalMotion, Vec<usize>)> = Vec::new();
    let wander = starts.iter().enumerate().filter(|(_, one)| one.repeats_after.is_none());
    for (k, one) in wander {
        match motions.iter_mut().find(|known| known.0.is_same(one)) {
            Some((known, starts)) => {
                known.join(one);
                starts.push(k);
            }
            None => motions.push((one.clone(), vec![k])),
        }
    }
    motions
}

/// Whether a longer run may have a displacement that is larger by a good part of what was seen.
fn is_vague(motion: &ModalMotion) -> bool {
    motion.read(Reading::Displacement).any(|one| one.error > VAGUE_IN_FULL * one.peak)
}
