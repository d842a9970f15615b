//! Every long-term motion along a load, looked for more closely around the worst of each place.

use super::ModalError;
use super::linear::{amplitudes, largest};
use super::rest::farthest_at_rest;
use super::sensors::{measured, measures, sensors};
use crate::case::{Load, ModalCase};
use crate::executor::{Executor, map};
use crate::measure::PlaceMeasure;
use crate::method::Method;
use crate::motions::{ModalMotion, longest_flight, modal_motions, worst_between};
use crate::numerics::scan;
use crate::system::MOST_MODES;

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

/// The largest of what is measured of a place along a load, of any motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorstOfPlace {
    /// Which load.
    pub load: usize,
    /// Which place.
    pub place: usize,
    /// Where in Hz.
    pub at: f64,
    /// What it is, in SI units.
    pub value: f64,
    /// By how much it may be larger: by the error of any motion along the load, and by what may lie between the frequencies.
    pub error: f64,
    /// The largest that it is at least in a motion that has settled.
    pub settled: f64,
    /// Whether every motion has settled.
    pub all_settled: bool,
    /// Whether every absorber rests in it.
    pub rests: bool,
    /// Whether it is an exact orbit.
    pub exact: bool,
    /// Which of the absorbers rest in it.
    pub resting: [bool; MOST_MODES],
    /// The share of their places in which those may, together; none where none does.
    pub share: Option<f64>,
}

/// Even frequencies along a load, each searched with half of the starts, and rounds of closer ones around the worst of each
/// place.
const EVEN: u32 = 13;
const ROUNDS: u32 = 3;
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
        places * longest_flight(&system, case.periods)
    };
    let periods: f64 = case.loads.iter().map(of_load).sum();
    f64::from(case.starts) * periods * IMPACTS * IMPACT * size
}

impl AlongLoad {
    pub(super) fn of(case: &ModalCase, load: &Load, on: &dyn Executor) -> Result<Self, ModalError> {
        let [from, to] = load.range_hz;
        let mut wanted: Vec<f64> = match from < to {
            true => {
                // An undamped mode has no steady motion at its own frequency.
                let damped = case.modes.iter().filter(|mode| mode.damping_ratio > 0.0);
                let resonances = damped.map(|mode| mode.frequency_hz);
                let resonances = resonances.filter(|at| from < *at && *at < to);
                let even = scan::places([from, to], EVEN - 1).chain(resonances);
                let even = even.chain(close(case, load));
                let at_rest = farthest_at_rest(case, load).into_iter().map(|one| one.0);
                even.chain(at_rest).collect()
            }
            false => vec![from],
        };
        // Nor is there one where an even step falls on it: a little beside.
        let steady = |at: f64| if case.system(load, at).is_ok() { at } else { at * (1.0 + BESIDE) };
        let (modes, mut places) = (within(case, load), Vec::<AtFrequency>::new());
        for round in 0..=ROUNDS {
            let starts =
                if round == 0 && from < to { case.starts.div_ceil(2) } else { case.starts };
            let look = |k: usize| AtFrequency::of(case, load, steady(wanted[k]), starts);
            let found = map(on, "motions along the loads", wanted.len(), look);
            places.extend(found.into_iter().collect::<Result<Vec<_>, _>>()?);
            places.sort_by(|a, b| a.at.total_cmp(&b.at));
            places.dedup_by(|a, b| a.at == b.at);
            if round < ROUNDS {
                wanted = beside_worst(&places, case, &modes);
            }
        }
        let bare = (0..case.places.len())
            .map(|p| largest(load.range_hz, case, |at| amplitudes(case, load, at, &[]).places[p]));
        Ok(Self { load: *load, bare: bare.collect(), places, modes })
    }

    /// The worst of a place; none where no motion was found. Between the frequencies it may be worse as [`worst_between`] has it.
    pub fn worst(&self, load: usize, place: usize, asked: PlaceMeasure) -> Option<WorstOfPlace> {
        let motions = || {
            let each = self.places.iter().enumerate();
            each.flat_map(|(k, here)| here.counting().map(move |motion| (k, motion)))
        };
        let of = |motion: &ModalMotion| measured(motion, place, asked);
        let worst = motions().max_by(|a, b| of(a.1)[0].total_cmp(&of(b.1)[0]));
        let (k, motion) = worst?;
        let (at, value) = (self.places[k].at, of(motion)[0]);
        let reach = motions().map(|(_, one)| of(one).iter().sum()).fold(value, f64::max);
        // What rests is looked for between the frequencies as well; what moves is held against neighbours of its kind.
        let moving = motions().filter(|(_, one)| !one.rests());
        let moving = moving.max_by(|a, b| of(a.1)[0].total_cmp(&of(b.1)[0]));
        let between = moving.map_or(0.0, |(k, one)| self.between(k, place, asked, of(one)[0]));
        let error = match moving {
            Some((_, one)) if motion.rests() => reach.max(of(one)[0] + between) - value,
            _ => reach - value + between,
        };
        // Near another mode it may be more between the frequencies too.
        let error = (0..self.modes.len()).fold(error, |error, mode| {
            let near = |k: &usize| nearest(&self.modes, self.places[*k].at) == mode;
            let near = (0..self.places.len()).filter(near);
            let moves =
                near.filter_map(|k| Some((k, self.places[k].largest(place, asked, false)?)));
            let top = moves.max_by(|a, b| a.1.total_cmp(&b.1));
            let most = top.map(|(k, top)| top + self.between(k, place, asked, top));
            most.map_or(error, |most| error.max(most - value))
        });
        let settled = motions().filter(|(_, one)| one.settled).map(|(_, one)| {
            let [value, error] = of(one);
            // A peak was seen; a mean may be smaller.
            if asked.mean { value - error } else { value }
        });
        Some(WorstOfPlace {
            load,
            place,
            at,
            value,
            error,
            settled: settled.fold(0.0, f64::max),
            all_settled: motions().all(|(_, one)| one.settled),
            rests: motion.rests(),
            exact: motion.largest_multiplier.is_some(),
            resting: std::array::from_fn(|j| motion.resting.get(j).copied().flatten().is_some()),
            share: motion.rest_share(),
        })
    }

    /// By how much it may be more, where absorbers move, beside the frequency where it is most.
    fn between(&self, k: usize, place: usize, asked: PlaceMeasure, value: f64) -> f64 {
        let number = |there: &AtFrequency| Some([there.at, there.largest(place, asked, false)?]);
        let [left, right] = neighbours(&self.places, k).map(|there| there.and_then(number));
        let around: Vec<[f64; 2]> =
            left.into_iter().chain([[self.places[k].at, value]]).chain(right).collect();
        let gaps = (1..around.len()).map(|gap| worst_between(&around, gap));
        gaps.fold(value, f64::max) - value
    }
}

impl WorstOfPlace {
    /// The layer that its motion is known by.
    pub fn method(&self) -> Method {
        match (self.rests, self.exact) {
            (true, _) => Method::ClosedForm,
            (false, true) => Method::ExactOrbit,
            (false, false) => Method::Simulation,
        }
    }
}

impl AtFrequency {
    pub(super) fn of(
        case: &ModalCase,
        load: &Load,
        at: f64,
        starts: u32,
    ) -> Result<Self, ModalError> {
        let system = case.system(load, at)?;
        let motions = modal_motions(&system, &sensors(case), starts, case.periods)?;
        Ok(Self { at, motions, count_rest: case.count_inactive })
    }

    /// The motions that count.
    pub fn counting(&self) -> impl Iterator<Item = &ModalMotion> {
        self.motions.iter().filter(|one| one.counts(self.count_rest))
    }

    /// The largest share of places of absorbers at rest in a motion that does not count for having few of them, where more than a
    /// limit is measured in it.
    pub(super) fn too_few(
        &self,
        places: impl Iterator<Item = usize> + Clone,
        asked: PlaceMeasure,
        limit: f64,
    ) -> Option<f64> {
        let few = self.motions.iter().filter(|one| self.count_rest && !one.counts(true));
        let over = few.filter(|one| places.clone().any(|p| measured(one, p, asked)[0] > limit));
        over.filter_map(ModalMotion::rest_share).max_by(f64::total_cmp)
    }

    /// The largest of what is measured of a place, also with every absorber at rest or not.
    fn largest(&self, place: usize, asked: PlaceMeasure, rests: bool) -> Option<f64> {
        let motions = self.counting().filter(|one| rests || !one.rests());
        motions.map(|one| measured(one, place, asked)[0]).max_by(f64::total_cmp)
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

/// Frequencies half way to the neighbours of the worst of all that is measured of each place: of all motions, and of those in which an
/// absorber moves; near each of these modes where that is not small.
fn beside_worst(places: &[AtFrequency], case: &ModalCase, modes: &[f64]) -> Vec<f64> {
    let mut wanted: Vec<f64> = Vec::new();
    let measures = measures(case);
    let each = measures.iter().flat_map(|asked| (0..case.places.len()).map(move |p| (p, *asked)));
    for ((p, asked), rests) in each.flat_map(|one| [(one, true), (one, false)]) {
        let largest = |k: usize| places[k].largest(p, asked, rests).unwrap_or_default();
        let most = (0..places.len()).map(largest).fold(0.0, f64::max);
        for mode in 0..modes.len().max(1) {
            let near = (0..places.len()).filter(|k| nearest(modes, places[*k].at) == mode);
            let top = near.max_by(|a, b| largest(*a).total_cmp(&largest(*b)));
            let Some(k) = top.filter(|k| largest(*k) >= NOT_SMALL * most) else { continue };
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
