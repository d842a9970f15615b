//! Every long-term motion along a load, looked for more closely around the worst of what is asked.

use super::ModalError;
use super::linear::{amplitudes, largest};
use super::rest::farthest_at_rest;
use super::sensors::{Look, sensors};
use crate::case::{Load, ModalCase, StructuralMode};
use crate::executor::{Executor, map};
use crate::linear::carried_frequencies;
use crate::motions::{
    Line, Misses, ModalEffort, ModalMotion, NEGLIGIBLE, Purpose, Sampling, Site, Value,
    longest_flight, modal_motions, sampled,
};
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
    /// By how much what was looked at may be worse between the frequencies, where absorbers move, than at any of them.
    between: Vec<(Look, f64)>,
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

const IN_FULL: f64 = ModalEffort::IN_FULL;
const OF_MANY: f64 = ModalEffort::OF_MANY;

/// Even frequencies along a load.
const EVEN: u32 = 13;

/// How closely a load is looked along.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct AlongEffort {
    /// Most frequencies beside the first ones, for each mode in its range.
    further: usize,
    /// Relative error to which the worst of what is looked at is to be known.
    tolerance: f64,
    /// That of averages, and of impacts per period, under a load of one frequency; as a window says where there is none.
    accuracy: Option<[f64; 2]>,
    /// Parts of the starts at each of the first frequencies, and at each between these, beside the motions of its neighbours.
    parts: [u32; 2],
    /// Most starts under a load of one frequency.
    at_one: u32,
    /// The patience with what wanders at one of many frequencies, and at the only one.
    patience: [f64; 2],
    /// Most frequencies for each mode in its range that are searched in full, as what wanders there sets how bad something may be or has
    /// not settled.
    most_in_full: usize,
}

impl AlongEffort {
    /// What decides, as exactly as a case asks for in `[accuracy]`.
    pub fn of(case: &ModalCase) -> Self {
        let Some(asked) = case.accuracy else { return Self::FULL };
        let accuracy = Some([asked.amplitude(), asked.impacts_per_period()]);
        let Some(tolerance) = asked.amplitude else { return Self { accuracy, ..Self::FULL } };
        // What lies between two places falls with the square of their distance.
        let closer = (Self::FULL.tolerance / tolerance).sqrt().clamp(1.0, CLOSEST);
        let further = (closer * Self::FULL.further as f64).ceil() as usize;
        Self { further, tolerance, accuracy, ..Self::FULL }
    }

    /// The usual one of that.
    const FULL: Self = Self {
        further: 15,
        tolerance: 0.05,
        accuracy: None,
        parts: [2, 4],
        at_one: u32::MAX,
        patience: [OF_MANY, IN_FULL],
        most_in_full: 4,
    };
    /// Another structure, beside the one that decides.
    pub const COARSE: Self = Self {
        further: 6,
        tolerance: 0.1,
        accuracy: None,
        parts: [3, 6],
        at_one: 16,
        patience: [OF_MANY, IN_FULL],
        most_in_full: 1,
    };
    /// Enough to see where a limit may be missed, before that is looked at in full.
    pub const SCREENING: Self = Self {
        further: 4,
        tolerance: 0.1,
        accuracy: None,
        parts: [3, 6],
        at_one: 8,
        patience: [0.0, 0.0],
        most_in_full: 0,
    };
}

/// So many times as many places as usual at most, where a case asks for accuracy.
const CLOSEST: f64 = 4.0;
/// By how much a motion may grow on the way to a wall that no frequency beside it has.
const MOST_GROWTH: f64 = 1.5;
/// Least distance of frequencies over the narrower of a mode's width and what its absorbers add, and over the range.
const FINEST: f64 = 0.25;
const NARROWEST: f64 = 1.0 / 4096.0;
/// Relative distance up to which two frequencies are one.
const SAME: f64 = 1e-12;
/// Even steps that are longer than this, over a mode's frequency, may step over its resonance: it is then looked at beside it as well.
const COARSE: f64 = 0.03;
const CLOSE: [f64; 6] = [-0.1, -0.05, -0.025, 0.025, 0.05, 0.1];
/// How much longer a structure takes of which a mode is undamped, so that starts wander until patience ends: 4 and 6 times in two that
/// were measured.
const UNDAMPED: f64 = 6.0;

/// About how many seconds its motions take on one processor.
pub fn seconds(case: &ModalCase) -> f64 {
    let of_load = |load: &Load| {
        let [from, to] = load.range_hz;
        let most = first_and(AlongEffort::of(case).further, case, load);
        let places = if from < to { 0.5 * most as f64 } else { 1.0 };
        let Ok(system) = case.system(load, load.centre(case)) else { return 0.0 };
        f64::from(case.starts_of(load)) * places * longest_flight(&system, case.periods)
    };
    let is_undamped = case.modes.iter().any(|mode| mode.damping_ratio == 0.0);
    let longer = if is_undamped { UNDAMPED } else { 1.0 };
    seconds_of_flight(case, longer * case.loads.iter().map(of_load).sum::<f64>())
}

/// About how many seconds so many excitation periods of its motions take on one processor: of an impact, and impacts in a period of
/// each absorber.
pub fn seconds_of_flight(case: &ModalCase, periods: f64) -> f64 {
    const IMPACT: f64 = 3e-7;
    const IMPACTS: f64 = 3.0;
    let size = (case.modes.len() * case.absorbers.len()) as f64;
    periods * IMPACTS * IMPACT * size
}

/// A search along a load.
struct OfLoad<'a> {
    case: &'a ModalCase,
    load: &'a Load,
    effort: &'a AlongEffort,
    looks: Vec<Look>,
    on: &'a dyn Executor,
}

impl OfLoad<'_> {
    /// The frequencies to begin with, in Hz.
    fn first(&self) -> Vec<f64> {
        let Self { case, load, .. } = *self;
        let [from, to] = load.range_hz;
        // An undamped mode has no steady motion at its own frequency.
        let damped = case.modes.iter().filter(|mode| mode.damping_ratio > 0.0);
        let resonances: Vec<f64> = damped.map(|mode| mode.frequency_hz).collect();
        // An even one may be that of a mode, but for rounding.
        let own = |at: f64| {
            let near = resonances.iter().find(|one| (at / *one - 1.0).abs() <= SAME);
            near.map_or(at, |one| *one)
        };
        let within = resonances.iter().copied().filter(|at| from < *at && *at < to);
        let even = scan::places([from, to], EVEN - 1).map(own).chain(within);
        let even = even.chain(close(case, load)).chain(carried(case, load));
        let at_rest = farthest_at_rest(case, load).into_iter().map(|one| one.0);
        let mut first: Vec<f64> = even.chain(at_rest).collect();
        first.sort_by(f64::total_cmp);
        first.dedup();
        first
    }
}

impl Line for OfLoad<'_> {
    type State = ModalState;
    type Motion = ModalMotion;
    type Motions = AtFrequency;
    type Wanted = Look;
    type Error = ModalError;

    fn finest(&self) -> f64 {
        let Self { case, load, .. } = *self;
        let [from, to] = load.range_hz;
        let system = case.system(load, load.centre(case));
        let scale = |(k, mode): (usize, &StructuralMode)| {
            let added = system.as_ref().map_or(0.0, |system| {
                let of = &system.modes()[k];
                (0..case.absorbers.len()).map(|j| system.modal_mass_ratio(of, j)).sum()
            });
            let own = mode.frequency_hz;
            // An undamped mode is as wide as absorbers make it, one at whose nodes they are as its damping does.
            let widths = [mode.damping_ratio, added].into_iter().filter(|width| *width > 0.0);
            let width = widths.reduce(f64::min).unwrap_or_default();
            // What a resonance does beside it changes over its distance.
            (own * width).max((own - own.clamp(from, to)).abs())
        };
        let narrowest = case.modes.iter().enumerate().map(scale).fold(f64::INFINITY, f64::min);
        (FINEST * narrowest.min(to - from)).max(NARROWEST * (to - from))
    }

    fn followed(&self) -> Vec<Look> {
        self.looks.clone()
    }

    fn search(
        &self,
        purpose: Purpose,
        sites: &[Site<'_, Self>],
    ) -> Result<Vec<(usize, AtFrequency)>, ModalError> {
        let Self { case, load, .. } = *self;
        let AlongEffort { parts: [first, between], patience: [of_many, _], .. } = *self.effort;
        let (what, starts, full) = match purpose {
            Purpose::First => ("motions along the loads", case.starts.div_ceil(first), of_many),
            // Between known places the motions beside are the starts that matter.
            Purpose::Between => ("motions along the loads", case.starts.div_ceil(between), of_many),
            Purpose::Followed => ("motions that are followed", 0, of_many),
            Purpose::InFull => ("motions that decide", case.starts, IN_FULL),
        };
        let look = |k: usize| {
            let Site { at, further, patience, .. } = &sites[k];
            let (periods, patience) = (case.periods, patience * full);
            let effort = ModalEffort { starts, periods, patience, accuracy: None };
            let at = case.steady(load, *at);
            AtFrequency::of(case, load, at, effort, further).map(|found| (k, found))
        };
        map(self.on, what, sites.len(), look).into_iter().collect()
    }

    /// Takes over motions that are not known.
    fn join(&self, known: &mut AtFrequency, found: AtFrequency) {
        for motion in found.motions {
            if !known.motions.iter().any(|known| known.is_same(&motion)) {
                // Those in which absorbers rest stay last.
                let rests = known.motions.iter().position(ModalMotion::rests);
                known.motions.insert(rests.unwrap_or(known.motions.len()), motion);
            }
        }
    }

    fn motions<'a>(&'a self, of: &'a AtFrequency) -> Vec<&'a ModalMotion> {
        of.counting().collect()
    }

    fn moves(motion: &ModalMotion) -> bool {
        !motion.rests()
    }

    fn wanders(motion: &ModalMotion) -> bool {
        motion.repeats_after.is_none()
    }

    fn has_settled(motion: &ModalMotion) -> bool {
        motion.settled
    }

    fn is_solved(_: &ModalMotion) -> bool {
        false
    }

    fn state(motion: &ModalMotion) -> Option<ModalState> {
        motion.state
    }

    fn value(&self, motion: &ModalMotion, of: Look) -> Option<Value> {
        let [value, error] = of.measured(self.case, motion)?;
        Some(Value { value, error })
    }

    /// Where absorbers rest while others impact, the motion counts up to where a wall leaves one of them a hundredth of its places: on the
    /// way there all of it grows as the displacement of that absorber does. What would have to grow much more ends otherwise.
    fn at_its_end(&self, motion: &ModalMotion, beside: &AtFrequency, of: Look) -> Option<f64> {
        let rests =
            |one: &ModalMotion| -> Vec<bool> { one.resting.iter().map(Option::is_some).collect() };
        let own = rests(motion);
        if !own.contains(&true) || beside.counting().any(|one| rests(one) == own) {
            return None;
        }
        let room = motion.resting.iter().flatten().map(|share| (1.0 - NEGLIGIBLE) / (1.0 - share));
        let grows = room.fold(f64::INFINITY, f64::min).max(1.0);
        let value = self.value(motion, of)?.value;
        (!of.least && grows <= MOST_GROWTH).then_some(grows * value)
    }

    fn is_least(of: Look) -> bool {
        of.least
    }
}

impl AlongLoad {
    /// Whether the load has one frequency.
    pub fn is_point(&self) -> bool {
        self.load.range_hz[0] == self.load.range_hz[1]
    }

    pub(super) fn of(
        case: &ModalCase,
        load: &Load,
        effort: &AlongEffort,
        on: &dyn Executor,
    ) -> Result<Self, ModalError> {
        Ok(Self::until(case, load, effort, None, on)?.0)
    }

    /// The same that ends with the first frequency, searched in full, at which something is missed, if one is given that says so; and
    /// whether it did, and has that alone.
    pub(super) fn until(
        case: &ModalCase,
        load: &Load,
        effort: &AlongEffort,
        misses: Option<&Misses<'_, AtFrequency>>,
        on: &dyn Executor,
    ) -> Result<(Self, bool), ModalError> {
        let [from, to] = load.range_hz;
        let line = OfLoad { case, load, effort, looks: Look::all(case), on };
        let (places, between, missed) = if from < to {
            let (first, worst) = (line.first(), line.looks.clone());
            let most = first_and(effort.further, case, load);
            let most_in_full = effort.most_in_full * modes_within(case, load);
            let (own, tolerance, are_dear) = (None, effort.tolerance, true);
            let sampling =
                Sampling { first, own, worst, most, tolerance, most_in_full, are_dear, misses };
            sampled(&line, sampling)?
        } else {
            let starts = case.starts_at_one.min(effort.at_one);
            let patience = effort.patience[1];
            let (periods, accuracy) = (case.periods, effort.accuracy);
            let effort = ModalEffort { starts, periods, patience, accuracy };
            let found = map(on, "motions along the loads", 1, |_| {
                AtFrequency::of(case, load, from, effort, &[])
            });
            let found = found.into_iter().collect::<Result<Vec<_>, _>>()?;
            let missed = misses.is_some_and(|misses| found.iter().any(misses));
            (found.into_iter().map(|found| (from, found)).collect(), Vec::new(), missed)
        };
        let bare = (0..case.places.len()).map(|p| {
            largest(load.range_hz, case, &[], |at| amplitudes(case, load, at, &[]).places[p])
        });
        let mut places: Vec<AtFrequency> = places.into_iter().map(|one| one.1).collect();
        places.iter_mut().for_each(|one| ModalMotion::sort(&mut one.motions));
        Ok((Self { load: *load, bare: bare.collect(), places, between }, missed))
    }

    /// Single frequencies of a load.
    pub(super) fn at_some(load: Load, places: Vec<AtFrequency>, bare: Vec<[f64; 2]>) -> Self {
        Self { load, places, bare, between: Vec::new() }
    }

    /// What is known at one of its frequencies.
    pub fn at(&self, at: f64) -> Option<&AtFrequency> {
        self.places.iter().find(|one| one.at == at)
    }

    /// By how much what is looked at may be worse between the frequencies, where absorbers move, than at any of them.
    pub(super) fn between(&self, look: &Look) -> f64 {
        let known = self.between.iter().find(|one| one.0 == *look);
        known.map_or(0.0, |one| one.1)
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
}

/// How many modes are in the range of a load, at least one.
fn modes_within(case: &ModalCase, load: &Load) -> usize {
    within(case, load).len().max(1)
}

/// Even frequencies along a load, and so many further ones for each mode in its range.
fn first_and(further: usize, case: &ModalCase, load: &Load) -> usize {
    EVEN as usize + further * modes_within(case, load)
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

/// Frequencies beside those of modes that even steps along a load may step over.
fn close(case: &ModalCase, load: &Load) -> impl Iterator<Item = f64> {
    let [from, to] = load.range_hz;
    let step = (to - from) / f64::from(EVEN - 1);
    let coarse = within(case, load).into_iter().filter(move |at| step > COARSE * at);
    let all = coarse.flat_map(|at| CLOSE.map(|off| at * (1.0 + off)));
    all.filter(move |at| (from..=to).contains(at))
}
