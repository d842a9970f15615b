//! A structure of several modes with several absorbers under its loads: every long-term motion along each, the structure alone
//! and tuned mass dampers beside it, and its criteria.
//!
//! For the program itself: this module may change at any time.

mod dampers;

use crate::case::{ActsOn, Load, ModalCase, PlaceCriterion};
use crate::executor::{Executor, map};
use crate::linear::{ModalAmplitudes, ModalDamper};
use crate::motions::{ModalMotion, longest_flight, modal_motions};
use crate::simulation::ModalStartError;
use crate::system::InvalidModalSystem;

pub use dampers::{DamperChoice, choices};

/// Why there is no answer.
#[derive(Debug, thiserror::Error)]
pub enum ModalError {
    /// A frequency of a load at which there is no structure.
    #[error(transparent)]
    System(#[from] InvalidModalSystem),
    /// A motion cannot be flown.
    #[error(transparent)]
    Start(#[from] ModalStartError),
}

/// What is known of a structure under its loads.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalAnswer {
    /// Along each load, in the order of the case.
    pub along: Vec<AlongLoad>,
    /// Its criteria.
    pub judged: Vec<JudgedPlace>,
}

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
    /// Amplitude of each place without absorbers, in m.
    pub bare: Vec<f64>,
}

/// The largest displacement of a place along a load.
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
    /// By how much it may be larger: the motion's own error, and what may lie between the frequencies.
    pub error: f64,
    /// Whether its motion has settled.
    pub settled: bool,
    /// Whether every absorber rests in it.
    pub rests: bool,
}

/// A criterion and what it came to.
#[derive(Debug, Clone, PartialEq)]
pub struct JudgedPlace {
    /// What was asked.
    pub criterion: PlaceCriterion,
    /// The worst place and load.
    pub worst: WorstOfPlace,
    /// Whether it holds with its error; none where an error or a motion that still settles could turn it.
    pub holds: Option<bool>,
}

/// Even frequencies along a load, each searched with half of the starts, and rounds of closer ones around the worst of each
/// place.
const EVEN: u32 = 13;
const ROUNDS: u32 = 3;

/// About how many seconds its motions take on one processor: of an impact, and impacts in a period of each absorber.
pub fn seconds(case: &ModalCase) -> f64 {
    const IMPACT: f64 = 1e-6;
    const IMPACTS: f64 = 3.0;
    let size = (case.modes.len() * case.absorbers.len()) as f64;
    let of_load = |load: &Load| {
        let [from, to] = load.range_hz;
        let places = if from < to { f64::from(EVEN + 2 * ROUNDS) } else { 1.0 };
        let Ok(system) = case.system(load, load.centre(case)) else { return 0.0 };
        places * longest_flight(&system)
    };
    let periods: f64 = case.loads.iter().map(of_load).sum();
    f64::from(case.starts) * periods * IMPACTS * IMPACT * size
}

impl ModalAnswer {
    /// Of a case, searched with its starts.
    ///
    /// # Errors
    /// [`ModalError`] where a motion cannot be flown.
    pub fn of(case: &ModalCase, on: &dyn Executor) -> Result<Self, ModalError> {
        let along = case.loads.iter().map(|load| AlongLoad::of(case, load, on));
        let along = along.collect::<Result<Vec<_>, _>>()?;
        let mut answer = Self { along, judged: Vec::new() };
        answer.judged = case.criteria.iter().filter_map(|one| answer.judge(case, one)).collect();
        Ok(answer)
    }

    /// The worst of a place, or of all, under a load, or under any.
    pub fn worst(&self, place: Option<usize>, load: Option<usize>) -> Option<WorstOfPlace> {
        let loads = self.along.iter().enumerate().filter(|(k, _)| load.is_none_or(|one| one == *k));
        let all = loads.flat_map(|(k, along)| {
            let places = 0..along.bare.len();
            let places = places.filter(move |p| place.is_none_or(|one| one == *p));
            places.filter_map(move |p| along.worst(k, p))
        });
        all.max_by(|a, b| a.peak.total_cmp(&b.peak))
    }

    fn judge(&self, case: &ModalCase, criterion: &PlaceCriterion) -> Option<JudgedPlace> {
        let places = 0..case.places.len();
        let places = places.filter(|p| criterion.place.is_none_or(|one| one == *p));
        let each: Vec<WorstOfPlace> = places
            .flat_map(|p| (0..self.along.len()).filter_map(move |k| self.along[k].worst(k, p)))
            .collect();
        let worst = *each.iter().max_by(|a, b| a.peak.total_cmp(&b.peak))?;
        let most = each.iter().map(|one| one.peak + one.error).fold(0.0, f64::max);
        let holds = match () {
            () if worst.settled && worst.peak > criterion.limit => Some(false),
            () if most <= criterion.limit && each.iter().all(|one| one.settled) => Some(true),
            () => None,
        };
        let worst = WorstOfPlace { error: most - worst.peak, ..worst };
        Some(JudgedPlace { criterion: criterion.clone(), worst, holds })
    }

    /// Whether every criterion holds.
    pub fn all_hold(&self) -> bool {
        self.judged.iter().all(|one| one.holds == Some(true))
    }
}

impl AlongLoad {
    fn of(case: &ModalCase, load: &Load, on: &dyn Executor) -> Result<Self, ModalError> {
        let [from, to] = load.range_hz;
        let mut wanted: Vec<f64> = match from < to {
            true => {
                let part = |k: u32| f64::from(k) / f64::from(EVEN - 1);
                let even = (0..EVEN).map(|k| from + (to - from) * part(k));
                let resonances = case.modes.iter().map(|mode| mode.frequency_hz);
                even.chain(resonances.filter(|at| from < *at && *at < to)).collect()
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
            if round < ROUNDS {
                wanted = beside_worst(&places, case.places.len());
            }
        }
        let bare = (0..case.places.len()).map(|p| {
            let at = |frequency: f64| bare_at(case, load, frequency).map_or(0.0, |all| all[p]);
            largest(load.range_hz, case, at)
        });
        Ok(Self { load: *load, bare: bare.collect(), places })
    }

    /// The worst of a place. Between the frequencies it may be worse by as much as the top of the parabola through the worst and
    /// its neighbours is higher.
    pub fn worst(&self, load: usize, place: usize) -> Option<WorstOfPlace> {
        let mut worst: Option<WorstOfPlace> = None;
        for (k, here) in self.places.iter().enumerate() {
            for motion in &here.motions {
                let extent = motion.places[place];
                if worst.is_some_and(|one| one.peak >= extent.peak) {
                    continue;
                }
                let beside = |k: Option<usize>| {
                    let there = self.places.get(k?)?;
                    Some([there.at - here.at, there.peak(place)? - extent.peak])
                };
                let between = match (beside(k.checked_sub(1)), beside(Some(k + 1))) {
                    (Some(left), Some(right)) => top_above(left, right),
                    _ => 0.0,
                };
                let rests = motion.rests();
                let (peak, error, settled) = (extent.peak, extent.error + between, motion.settled);
                worst =
                    Some(WorstOfPlace { load, place, at: here.at, peak, error, settled, rests });
            }
        }
        worst
    }
}

impl AtFrequency {
    fn of(case: &ModalCase, load: &Load, at: f64, starts: u32) -> Result<Self, ModalError> {
        let system = case.system(load, at)?;
        let motions = modal_motions(&system, &case.shapes(), starts)?;
        Ok(Self { at, motions, bare: bare_at(case, load, at)? })
    }

    /// The largest displacement of a place.
    pub fn peak(&self, place: usize) -> Option<f64> {
        self.motions.iter().map(|one| one.places[place].peak).max_by(f64::total_cmp)
    }
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

/// Frequencies half way to the neighbours of the worst of each place.
fn beside_worst(places: &[AtFrequency], count: usize) -> Vec<f64> {
    let mut wanted: Vec<f64> = Vec::new();
    for p in 0..count {
        let peak = |k: &usize| places[*k].peak(p).unwrap_or_default();
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

fn bare_at(case: &ModalCase, load: &Load, at: f64) -> Result<Vec<f64>, InvalidModalSystem> {
    Ok(ModalAmplitudes::of(&case.system(load, at)?, &[], &case.shapes()).places)
}

/// The largest amplitude of any place at a frequency in Hz, without absorbers and with these dampers.
pub fn linear_peak(case: &ModalCase, load: &Load, at: f64, dampers: &[ModalDamper]) -> f64 {
    let amplitudes = dampers::amplitudes(case, load, at, dampers);
    amplitudes.places.into_iter().fold(0.0, f64::max)
}

/// For each load the worst displacement that a model of the driven mode alone has: of the mode in which the load acts, or of
/// that which is nearest to its range.
///
/// # Errors
/// [`ModalError`] where a motion cannot be flown.
pub fn modes_alone(
    case: &ModalCase,
    on: &dyn Executor,
) -> Result<Vec<Option<WorstOfPlace>>, ModalError> {
    if case.modes.len() == 1 {
        return Ok(vec![None; case.loads.len()]);
    }
    let each = case.loads.iter().enumerate().map(|(number, load)| {
        let off = |k: &usize| {
            let own = case.modes[*k].frequency_hz;
            let [from, to] = load.range_hz;
            libm::log(own.clamp(from, to) / own).abs()
        };
        let nearest = (0..case.modes.len()).min_by(|a, b| off(a).total_cmp(&off(b)));
        let driven = match load.on {
            ActsOn::Mode(mode) => mode,
            _ => nearest.unwrap_or_default(),
        };
        let on_mode = match load.on {
            ActsOn::Mode(_) => ActsOn::Mode(0),
            other => other,
        };
        let load = Load { on: on_mode, ..*load };
        let alone = ModalCase {
            modes: vec![case.modes[driven].clone()],
            loads: vec![load],
            ..case.clone()
        };
        let along = AlongLoad::of(&alone, &load, on)?;
        let all = (0..case.places.len()).filter_map(|p| along.worst(number, p));
        Ok(all.max_by(|a, b| a.peak.total_cmp(&b.peak)))
    });
    each.collect()
}

/// Pieces of a range in which the largest amplitude of a linear structure is looked for, beside ever closer ones around its
/// modes.
const PIECES: u32 = 256;
const CLOSER: u32 = 16;

/// Frequencies at which a linear structure is looked at along a range.
pub fn linear_places([from, to]: [f64; 2], case: &ModalCase) -> Vec<f64> {
    let even = (0..=PIECES).map(|k| from + (to - from) * f64::from(k) / f64::from(PIECES));
    let around = case.modes.iter().flat_map(|mode| {
        let width = mode.damping_ratio * mode.frequency_hz;
        (0..=CLOSER).flat_map(move |k| {
            let off = f64::from(k) / f64::from(CLOSER) * 2.0 * width;
            [mode.frequency_hz - off, mode.frequency_hz + off]
        })
    });
    let mut all: Vec<f64> = even.chain(around).filter(|at| (from..=to).contains(at)).collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}

/// The largest value along a range, narrowed down around the best place, and where.
fn largest(range: [f64; 2], case: &ModalCase, of: impl Fn(f64) -> f64) -> [f64; 2] {
    let all = linear_places(range, case);
    let best = (0..all.len()).map(|k| (of(all[k]), k)).max_by(|a, b| a.0.total_cmp(&b.0));
    let Some((mut most, k)) = best else { return [0.0, range[0]] };
    let mut at = all[k];
    let mut ends = [all[k.saturating_sub(1)], all[(k + 1).min(all.len() - 1)]];
    // A parabola's top lies between: thirds of the interval.
    for _ in 0..40 {
        let inner = [ends[0] + (ends[1] - ends[0]) / 3.0, ends[1] - (ends[1] - ends[0]) / 3.0];
        let values = inner.map(&of);
        for (place, value) in inner.into_iter().zip(values) {
            if value > most {
                (most, at) = (value, place);
            }
        }
        if values[0] < values[1] { ends[0] = inner[0] } else { ends[1] = inner[1] }
    }
    [most, at]
}
