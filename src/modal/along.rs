//! Every long-term motion along a load, looked for more closely around the worst of what is asked.

use super::ModalError;
use super::linear::{amplitudes, largest};
use super::rest::farthest_at_rest;
use super::sensors::{Look, sensors};
use crate::case::{Load, ModalCase};
use crate::executor::{Executor, map};
use crate::linear::carried_frequencies;
use crate::motions::{ModalEffort, ModalMotion, longest_flight, modal_motions, worst_between};
use crate::numerics::scan;
use crate::system::ModalState;

/// What is known along a load.
#[derive(Debug, Clone, PartialEq)]
pub struct AlongLoad {
    /// The load.
    pub load: Load,
    /// Frequencies in Hz, ascending, with their motions.
    pub places: Vec<AtFrequency>,
    /// For each place of the structure its largest displacement without absorbers in m, and where in Hz.
    pub bare: Vec<[f64; 2]>,
    /// Natural frequencies in its range, in Hz.
    pub modes: Vec<f64>,
}

/// What is known at a frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct AtFrequency {
    /// In Hz.
    pub at: f64,
    /// The long-term motions.
    pub motions: Vec<ModalMotion>,
    /// Whether those count in which absorbers rest.
    pub count_rest: bool,
}

/// Even frequencies along a load, each searched with half of the starts, and rounds of closer ones around the worst of each
/// place.
const EVEN: u32 = 13;
const ROUNDS: u32 = 3;
/// How often frequencies are searched in full that set how bad something may be.
const MOST_IN_FULL: usize = 2;
/// Most of those at which a motion has not settled, each time.
const MOST_OPEN: usize = 4;
/// By how much a motion is worse at least that is followed to the next frequency, and most of them from there.
const FOLLOWED: f64 = 0.02;
const MOST_STATES: usize = 2;
/// How far beside the frequency of an undamped mode it is looked at, over it.
const BESIDE: f64 = 1e-6;
/// Least distance of a neighbour, over the range, and over the frequency where the range is wide: less than that of the closest round,
/// and none so near that chance decides a slope.
const NEAREST: f64 = 0.005;
const NEAREST_OF_FREQUENCY: f64 = 0.0025;
/// Even steps that are longer than this, over a mode's frequency, may step over its resonance: it is then looked at beside it as well.
const COARSE: f64 = 0.03;
const CLOSE: [f64; 6] = [-0.1, -0.05, -0.025, 0.025, 0.05, 0.1];
/// Where a mode has at least this part of the largest value, it is looked at more closely too.
const NOT_SMALL: f64 = 0.5;

/// About how many seconds its motions take on one processor: of an impact, and impacts in a period of each absorber.
pub fn seconds(case: &ModalCase) -> f64 {
    const IMPACT: f64 = 3e-7;
    const IMPACTS: f64 = 3.0;
    let size = (case.modes.len() * case.absorbers.len()) as f64;
    let of_load = |load: &Load| {
        let [from, to] = load.range_hz;
        let modes = within(case, load).len().max(1) as f64;
        let more = f64::from(2 * ROUNDS) * modes + close(case, load).count() as f64;
        let places = if from < to { f64::from(EVEN) + more } else { 1.0 };
        let Ok(system) = case.system(load, load.centre(case)) else { return 0.0 };
        f64::from(case.starts_of(load)) * places * longest_flight(&system, case.periods)
    };
    let periods: f64 = case.loads.iter().map(of_load).sum();
    periods * IMPACTS * IMPACT * size
}

/// A search along a load.
struct Search<'a> {
    case: &'a ModalCase,
    load: &'a Load,
    looks: Vec<Look>,
    on: &'a dyn Executor,
}

impl Search<'_> {
    /// The motions at a frequency in Hz, from so many starts with this part of the patience, and from `further` states.
    fn at(&self, at: f64, starts: u32, patience: f64, further: &[ModalState]) -> Place {
        let effort = ModalEffort { starts, periods: self.case.periods, patience };
        AtFrequency::of(self.case, self.load, at, effort, further)
    }

    /// Closer and closer frequencies, from the first that are wanted.
    fn round_by_round(&self, mut wanted: Vec<f64>) -> Result<Vec<AtFrequency>, ModalError> {
        let [from, to] = self.load.range_hz;
        let Self { case, load, .. } = *self;
        // An undamped mode has no steady motion where an even step falls on it: a little beside.
        let steady = |at: f64| if case.system(load, at).is_ok() { at } else { at * (1.0 + BESIDE) };
        let patience = if from < to { ModalEffort::OF_MANY } else { ModalEffort::IN_FULL };
        let (modes, mut places) = (within(case, load), Vec::<AtFrequency>::new());
        for round in 0..=ROUNDS {
            let part = if round == 0 && from < to { 2 } else { 1 };
            let starts = case.starts_of(load).div_ceil(part);
            // Between known frequencies the motions beside are the starts that matter.
            let look = |k: usize| {
                let at = steady(wanted[k]);
                let right = places.partition_point(|one| one.at < at);
                let beside = &places[right.saturating_sub(1)..places.len().min(right + 1)];
                let states = |one: &AtFrequency| one.states().take(MOST_STATES).collect::<Vec<_>>();
                let further: Vec<ModalState> = beside.iter().flat_map(states).collect();
                self.at(at, starts, patience, &further)
            };
            let found = map(self.on, "motions along the loads", wanted.len(), look);
            places.extend(found.into_iter().collect::<Result<Vec<_>, _>>()?);
            places.sort_by(|a, b| a.at.total_cmp(&b.at));
            places.dedup_by(|a, b| a.at == b.at);
            if round < ROUNDS {
                wanted = self.beside_worst(&places, &modes);
            }
        }
        Ok(places)
    }

    /// Follows motions that are worse to the frequencies beside them, where they may be as well.
    fn follow(&self, places: &mut [AtFrequency]) -> Result<(), ModalError> {
        let all: &[AtFrequency] = places;
        let worse = |k: usize| -> Vec<ModalState> {
            let beside = [k.checked_sub(1), Some(k + 1)].into_iter().flatten();
            let motions = beside.filter_map(|k| all.get(k)).flat_map(AtFrequency::counting);
            let is_worse = |one: &&ModalMotion| {
                self.looks.iter().any(|look| {
                    // What a longer run may come to there is no other motion.
                    let known = all[k].reach(self.case, look).map(|reach| reach.0);
                    let beyond = |known: f64| known + FOLLOWED * known.abs();
                    let value = look.signed(self.case, one);
                    value.is_some_and(|value| known.is_none_or(|known| value > beyond(known)))
                })
            };
            motions.filter(is_worse).filter_map(|one| one.state).take(MOST_STATES).collect()
        };
        let followed = (0..all.len()).map(|k| (k, worse(k)));
        let followed: Vec<(usize, Vec<ModalState>)> =
            followed.filter(|(_, states)| !states.is_empty()).collect();
        let look = |n: usize| {
            let (k, states) = &followed[n];
            self.at(all[*k].at, 0, ModalEffort::OF_MANY, states)
        };
        let found = map(self.on, "motions that are followed", followed.len(), look);
        for ((k, _), found) in followed.iter().zip(found) {
            places[*k].join(found?);
        }
        Ok(())
    }

    /// Searches frequencies again, with all patience, while what wanders there, and was not searched so, sets how bad something may be
    /// along the load, or has not settled: it may be a transient, or hardly be known.
    fn in_full(&self, places: &mut [AtFrequency]) -> Result<(), ModalError> {
        let mut known: Vec<usize> = Vec::new();
        for _ in 0..MOST_IN_FULL {
            let worst = |look: &Look| {
                let reach = |k: usize| Some((k, places[k].reach(self.case, look)?));
                let all = (0..places.len()).filter_map(reach);
                let (k, (_, wanders)) = all.max_by(|a, b| a.1.0.total_cmp(&b.1.0))?;
                (wanders && !known.contains(&k)).then_some(k)
            };
            let open = |k: &usize| places[*k].counting().any(|one| !one.settled);
            let open = (0..places.len()).filter(|k| open(k) && !known.contains(k));
            let mut chosen: Vec<usize> = self.looks.iter().filter_map(worst).collect();
            chosen.extend(open.take(MOST_OPEN));
            chosen.sort_unstable();
            chosen.dedup();
            let look = |n: usize| {
                let here = &places[chosen[n]];
                let further: Vec<ModalState> = here.states().collect();
                self.at(here.at, self.case.starts, ModalEffort::IN_FULL, &further)
            };
            let found = map(self.on, "motions that decide", chosen.len(), look);
            for (k, found) in chosen.iter().zip(found) {
                places[*k] = found?;
            }
            known.extend(chosen);
        }
        Ok(())
    }

    /// Frequencies half way to the neighbours of the worst of all that is looked at: of all motions, and of those in which an absorber
    /// moves; near each of these modes where that is not small.
    fn beside_worst(&self, places: &[AtFrequency], modes: &[f64]) -> Vec<f64> {
        let mut wanted: Vec<f64> = Vec::new();
        for (look, rests) in self.looks.iter().flat_map(|one| [(one, true), (one, false)]) {
            let worst =
                |k: usize| places[k].worst(self.case, look, rests).unwrap_or(f64::NEG_INFINITY);
            let most = (0..places.len()).map(worst).fold(f64::NEG_INFINITY, f64::max);
            let not_small = if most > 0.0 { NOT_SMALL * most } else { most / NOT_SMALL };
            for mode in 0..modes.len().max(1) {
                let near = (0..places.len()).filter(|k| nearest(modes, places[*k].at) == mode);
                let top = near.max_by(|a, b| worst(*a).total_cmp(&worst(*b)));
                let Some(k) = top.filter(|k| worst(*k) >= not_small) else { continue };
                for there in neighbours(places, k).into_iter().flatten() {
                    let middle = 0.5 * (places[k].at + there.at);
                    if !wanted.contains(&middle) {
                        wanted.push(middle);
                    }
                }
            }
        }
        wanted
    }
}

/// What is found at a frequency.
type Place = Result<AtFrequency, ModalError>;

impl AlongLoad {
    pub(super) fn of(case: &ModalCase, load: &Load, on: &dyn Executor) -> Result<Self, ModalError> {
        let [from, to] = load.range_hz;
        let wanted: Vec<f64> = match from < to {
            true => {
                // An undamped mode has no steady motion at its own frequency.
                let damped = case.modes.iter().filter(|mode| mode.damping_ratio > 0.0);
                let resonances = damped.map(|mode| mode.frequency_hz);
                let resonances = resonances.filter(|at| from < *at && *at < to);
                let even = scan::places([from, to], EVEN - 1).chain(resonances);
                let even = even.chain(close(case, load)).chain(carried(case, load));
                let at_rest = farthest_at_rest(case, load).into_iter().map(|one| one.0);
                even.chain(at_rest).collect()
            }
            false => vec![from],
        };
        let search = Search { case, load, looks: Look::all(case), on };
        let mut places = search.round_by_round(wanted)?;
        if from < to {
            search.follow(&mut places)?;
            search.in_full(&mut places)?;
        }
        let bare = (0..case.places.len())
            .map(|p| largest(load.range_hz, case, |at| amplitudes(case, load, at, &[]).places[p]));
        let modes = within(case, load);
        Ok(Self { load: *load, bare: bare.collect(), places, modes })
    }

    /// What is known at one of its frequencies.
    pub fn at(&self, at: f64) -> Option<&AtFrequency> {
        self.places.iter().find(|one| one.at == at)
    }

    /// By how much what is looked at may be worse between the frequencies, where absorbers move, than at any of them, near every
    /// mode.
    pub(super) fn between(&self, case: &ModalCase, look: &Look) -> f64 {
        let number = |there: &AtFrequency| Some([there.at, there.worst(case, look, false)?]);
        let each: Vec<Option<f64>> =
            self.places.iter().map(|there| there.worst(case, look, false)).collect();
        let Some(worst) = each.iter().flatten().copied().max_by(f64::total_cmp) else { return 0.0 };
        let tops = (0..self.modes.len().max(1)).filter_map(|mode| {
            let near = |k: &usize| nearest(&self.modes, self.places[*k].at) == mode;
            let moves = (0..each.len()).filter(near).filter_map(|k| Some((k, each[k]?)));
            moves.max_by(|a, b| a.1.total_cmp(&b.1))
        });
        let reach = tops.map(|(k, top)| {
            let [left, right] = neighbours(&self.places, k).map(|there| there.and_then(number));
            let around: Vec<[f64; 2]> =
                left.into_iter().chain([[self.places[k].at, top]]).chain(right).collect();
            (1..around.len()).map(|gap| worst_between(&around, gap)).fold(top, f64::max)
        });
        reach.fold(worst, f64::max) - worst
    }
}

impl AtFrequency {
    pub(super) fn of(
        case: &ModalCase,
        load: &Load,
        at: f64,
        effort: ModalEffort,
        further: &[ModalState],
    ) -> Result<Self, ModalError> {
        let system = case.system(load, at)?;
        let motions = modal_motions(&system, &sensors(case), effort, further)?;
        Ok(Self { at, motions, count_rest: case.count_inactive })
    }

    /// The motions that count.
    pub fn counting(&self) -> impl Iterator<Item = &ModalMotion> {
        self.motions.iter().filter(|one| one.counts(self.count_rest))
    }

    /// States on its motions, from which they may be followed.
    fn states(&self) -> impl Iterator<Item = ModalState> {
        self.counting().filter_map(|one| one.state)
    }

    /// Takes over motions that are not known.
    fn join(&mut self, found: Self) {
        for motion in found.motions {
            if !self.motions.iter().any(|known| known.is_same(&motion)) {
                // Those in which absorbers rest stay last.
                let end =
                    self.motions.iter().position(ModalMotion::rests).unwrap_or(self.motions.len());
                self.motions.insert(end, motion);
            }
        }
    }

    /// How bad what is looked at may be with its error, its sign turned where the smallest is, and whether the motion wanders.
    fn reach(&self, case: &ModalCase, look: &Look) -> Option<(f64, bool)> {
        let each = self.counting().filter_map(|one| {
            let [value, error] = look.measured(case, one)?;
            Some((value + error, one.repeats_after.is_none()))
        });
        each.max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The worst of what is looked at, its sign turned where the smallest is, also with every absorber at rest or not.
    fn worst(&self, case: &ModalCase, look: &Look, rests: bool) -> Option<f64> {
        let motions = self.counting().filter(|one| rests || !one.rests());
        motions.filter_map(|one| look.signed(case, one)).max_by(f64::total_cmp)
    }
}

/// The next frequencies to either side of one, but for those that are almost the same.
fn neighbours(places: &[AtFrequency], k: usize) -> [Option<&AtFrequency>; 2] {
    let [first, .., last] = places else { return [None; 2] };
    let here = places[k].at;
    let least = (NEAREST * (last.at - first.at)).min(NEAREST_OF_FREQUENCY * here);
    let apart = |there: &&AtFrequency| (there.at - here).abs() >= least;
    [places[..k].iter().rev().find(apart), places[k + 1..].iter().find(apart)]
}

/// Natural frequencies in the range of a load, in Hz.
fn within(case: &ModalCase, load: &Load) -> Vec<f64> {
    let [from, to] = load.range_hz;
    let all = case.modes.iter().map(|mode| mode.frequency_hz);
    all.filter(|at| (from..=to).contains(at)).collect()
}

/// Natural frequencies in the range of a load of the structure that carries its absorbers, in Hz.
fn carried(case: &ModalCase, load: &Load) -> Vec<f64> {
    let [from, to] = load.range_hz;
    let Ok(system) = case.system(load, load.centre(case)) else { return Vec::new() };
    let all = carried_frequencies(&system).into_iter();
    all.map(|over| over * case.modes[0].frequency_hz).filter(|at| from < *at && *at < to).collect()
}

/// Which of some natural frequencies is nearest; the first where there is none.
fn nearest(modes: &[f64], at: f64) -> usize {
    let off = |k: usize| libm::log(at / modes[k]).abs();
    (0..modes.len()).min_by(|a, b| off(*a).total_cmp(&off(*b))).unwrap_or(0)
}

/// Frequencies beside those of modes that even steps along a load may step over.
fn close(case: &ModalCase, load: &Load) -> impl Iterator<Item = f64> {
    let [from, to] = load.range_hz;
    let step = (to - from) / f64::from(EVEN - 1);
    let coarse = within(case, load).into_iter().filter(move |at| step > COARSE * at);
    let all = coarse.flat_map(|at| CLOSE.map(|off| at * (1.0 + off)));
    all.filter(move |at| (from..=to).contains(at))
}
