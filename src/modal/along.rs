//! Every long-term motion along a load, looked for more closely around the worst of each place.

use super::ModalError;
use super::linear::{amplitudes, largest, linear_places};
use crate::case::{Load, ModalCase};
use crate::executor::{Executor, map};
use crate::motions::{ModalMotion, longest_flight, modal_at_rest, modal_motions};
use crate::numerics::scan;

/// What is known along a load.
#[derive(Debug, Clone, PartialEq)]
pub struct AlongLoad {
    /// The load.
    pub load: Load,
    /// Frequencies in Hz, ascending, with their motions.
    pub places: Vec<AtFrequency>,
    /// For each place of the structure its largest displacement without absorbers, and where in Hz.
    pub bare: Vec<[f64; 2]>,
}

/// What is known at a frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct AtFrequency {
    /// In Hz.
    pub at: f64,
    /// The long-term motions.
    pub motions: Vec<ModalMotion>,
}

/// The largest displacement of a place along a load, of any motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorstOfPlace {
    /// Which load.
    pub load: usize,
    /// Which place.
    pub place: usize,
    /// Where in Hz.
    pub at: f64,
    /// In m.
    pub peak: f64,
    /// By how much it may be larger: by the error of any motion along the load, and by what may lie between the frequencies.
    pub error: f64,
    /// The largest of the motions that have settled.
    pub settled_peak: f64,
    /// Whether every motion has settled.
    pub settled: bool,
    /// Whether every absorber rests in it.
    pub rests: bool,
}

/// Even frequencies along a load, each searched with half of the starts, and rounds of closer ones around the worst of each
/// place.
const EVEN: u32 = 13;
const ROUNDS: u32 = 3;
/// Least distance of a neighbour, over the range: less than that of the closest round.
const NEAREST: f64 = 0.005;
/// How often the ends of a range of frequencies are halved.
const HALVINGS: u32 = 50;

/// About how many seconds its motions take on one processor: of an impact, and impacts in a period of each absorber.
pub fn seconds(case: &ModalCase) -> f64 {
    const IMPACT: f64 = 3e-7;
    const IMPACTS: f64 = 3.0;
    let size = (case.modes.len() * case.absorbers.len()) as f64;
    let of_load = |load: &Load| {
        let [from, to] = load.range_hz;
        let places = if from < to { f64::from(EVEN + 2 * ROUNDS) } else { 1.0 };
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
                let within = resonances.filter(|at| from < *at && *at < to);
                let even = scan::places([from, to], EVEN - 1).chain(within);
                let at_rest = farthest_at_rest(case, load).into_iter().map(|one| one.0);
                even.chain(at_rest).collect()
            }
            false => vec![from],
        };
        let mut places: Vec<AtFrequency> = Vec::new();
        for round in 0..=ROUNDS {
            let starts =
                if round == 0 && from < to { case.starts.div_ceil(2) } else { case.starts };
            let look = |k: usize| AtFrequency::of(case, load, wanted[k], starts);
            let found = map(on, "motions along the loads", wanted.len(), look);
            places.extend(found.into_iter().collect::<Result<Vec<_>, _>>()?);
            places.sort_by(|a, b| a.at.total_cmp(&b.at));
            places.dedup_by(|a, b| a.at == b.at);
            if round < ROUNDS {
                wanted = beside_worst(&places, case.places.len());
            }
        }
        let bare = (0..case.places.len())
            .map(|p| largest(load.range_hz, case, |at| amplitudes(case, load, at, &[]).places[p]));
        Ok(Self { load: *load, bare: bare.collect(), places })
    }

    /// The worst of a place; none where no motion was found. Between the frequencies it may be worse by as much as the top of the
    /// parabola through the worst and its neighbours is higher.
    pub fn worst(&self, load: usize, place: usize) -> Option<WorstOfPlace> {
        let motions = || {
            let each = self.places.iter().enumerate();
            each.flat_map(|(k, here)| here.motions.iter().map(move |motion| (k, motion)))
        };
        let of = |motion: &ModalMotion| motion.places[place];
        let worst = motions().max_by(|a, b| of(a.1).peak.total_cmp(&of(b.1).peak));
        let (k, motion) = worst?;
        let (at, peak) = (self.places[k].at, of(motion).peak);
        // What rests is looked for between the frequencies as well. Others are held against neighbours of their kind, none so near
        // that chance decides a slope.
        let [from, to] = self.load.range_hz;
        let apart = |there: &&AtFrequency| (there.at - at).abs() >= NEAREST * (to - from);
        let beside = |there: Option<&AtFrequency>| {
            let there = there?;
            Some([there.at - at, there.peak(place, false)? - peak])
        };
        let left = beside(self.places[..k].iter().rev().find(apart));
        let right = beside(self.places[k + 1..].iter().find(apart));
        let between = match (left, right) {
            (Some(left), Some(right)) if !motion.rests() => top_above(left, right),
            _ => 0.0,
        };
        let reach = motions().map(|(_, one)| of(one).peak + of(one).error).fold(peak, f64::max);
        let settled = motions().filter(|(_, one)| one.settled).map(|(_, one)| of(one).peak);
        Some(WorstOfPlace {
            load,
            place,
            at,
            peak,
            error: reach - peak + between,
            settled_peak: settled.fold(0.0, f64::max),
            settled: motions().all(|(_, one)| one.settled),
            rests: motion.rests(),
        })
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
        let motions = modal_motions(&system, &case.shapes(), starts, case.periods)?;
        Ok(Self { at, motions })
    }

    /// The largest displacement of a place, also with every absorber at rest or not.
    fn peak(&self, place: usize, rests: bool) -> Option<f64> {
        let motions = self.motions.iter().filter(|one| rests || !one.rests());
        motions.map(|one| one.places[place].peak).max_by(f64::total_cmp)
    }
}

/// For each place of the structure the frequency at which it moves farthest while every absorber rests, with that motion: often where
/// a wall begins to reach one.
pub(super) fn farthest_at_rest(case: &ModalCase, load: &Load) -> Vec<(f64, ModalMotion)> {
    let shapes = case.shapes();
    let at_rest = |at: f64| modal_at_rest(&case.system(load, at).ok()?, &shapes);
    let mut all: Vec<f64> = linear_places(load.range_hz, case);
    let edge = |pair: &[f64]| {
        let [mut rests, mut reached] = match [pair[0], pair[1]].map(|at| at_rest(at).is_some()) {
            [true, false] => [pair[0], pair[1]],
            [false, true] => [pair[1], pair[0]],
            _ => return None,
        };
        for _ in 0..HALVINGS {
            let middle = 0.5 * (rests + reached);
            *if at_rest(middle).is_some() { &mut rests } else { &mut reached } = middle;
        }
        Some(rests)
    };
    let edges: Vec<f64> = all.windows(2).filter_map(edge).collect();
    all.extend(edges);
    let found: Vec<(f64, ModalMotion)> =
        all.into_iter().filter_map(|at| Some((at, at_rest(at)?))).collect();
    let of_place = |p: usize| {
        found.iter().max_by(|a, b| a.1.places[p].peak.total_cmp(&b.1.places[p].peak)).cloned()
    };
    let mut farthest: Vec<_> = (0..case.places.len()).filter_map(of_place).collect();
    farthest.dedup_by(|a, b| a.0 == b.0);
    farthest
}

/// By how much the top of the parabola through the origin and two points to its left and right, which are no higher, is above the
/// origin.
fn top_above([left, below_left]: [f64; 2], [right, below_right]: [f64; 2]) -> f64 {
    // y = p x + c x^2.
    let [a, b] = [below_left / left, below_right / right];
    let c = (b - a) / (right - left);
    let p = a - c * left;
    if c < 0.0 { (-0.25 * p * p / c).max(0.0) } else { 0.0 }
}

/// Frequencies half way to the neighbours of the worst of each place: of all motions, and of those in which an absorber moves.
fn beside_worst(places: &[AtFrequency], count: usize) -> Vec<f64> {
    let mut wanted: Vec<f64> = Vec::new();
    for (p, rests) in (0..count).flat_map(|p| [(p, true), (p, false)]) {
        let peak = |k: &usize| places[*k].peak(p, rests).unwrap_or_default();
        let Some(k) = (0..places.len()).max_by(|a, b| peak(a).total_cmp(&peak(b))) else {
            continue;
        };
        let here = places[k].at;
        for other in [k.checked_sub(1), Some(k + 1)].into_iter().flatten() {
            let Some(there) = places.get(other) else { continue };
            let middle = 0.5 * (here + there.at);
            if !wanted.contains(&middle) {
                wanted.push(middle);
            }
        }
    }
    wanted
}
