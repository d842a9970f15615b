//! Tuned mass dampers, each designed for what is asked of it: the smallest amplitude along a band, the fastest decay of a
//! release, the smallest displacement in a sweep. A simplex looks for tuning and damping ratio.

mod missed;

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::sync::{Mutex, PoisonError};

use argmin::core::{CostFunction, Error, Executor, State as _};
use argmin::solver::neldermead::NelderMead;
use serde::Serialize;

use crate::excitation::{SineSweep, SweepRate, amplitude};
use crate::linear::{BandSystems, TunedMassDamper, released, swept};
use crate::system::{Cavity, Excitation, Parameters, Scales, State, System};

pub use missed::{SineLimits, missed, missed_with};

/// Size of the first simplex of a design, in the logarithms of tuning and damping ratio.
const SIMPLEX: [f64; 2] = [0.02, 0.3];
/// Steps of a simplex, and how often it begins again where it ended: the largest of two resonances has
/// a kink where they are equal, at which a simplex may collapse early.
const STEPS: u64 = 120;
const RESTARTS: u32 = 3;
/// What a restart saves of the cost of several dampers at least.
const ENOUGH: f64 = 1e-4;
/// The same of a sweep, each of whose passages is many periods.
const STEPS_OF_SWEEP: u64 = 40;
/// How often the way to the largest damping is halved.
const HALVINGS: u32 = 40;

/// Tunings within which a damper is looked for, over the frequency that it is for: beyond them it follows the structure, or
/// stays where it is.
const TUNED_WITHIN: [f64; 2] = [0.1, 10.0];
/// Damping ratios within which it is: from that of a steel bell up to ten times the critical one, with which its mass moves
/// against the structure by a twentieth of what that moves.
const DAMPED_WITHIN: [f64; 2] = [1e-4, 10.0];

/// What a damper is at a bound of the search for it, where it no longer is one that is tuned and damped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum AtBound {
    /// As stiff or as damped as makes sense: as good as fixed to the structure.
    Fixed,
    /// As soft as makes sense: as good as none.
    Detached,
    /// As little damped as makes sense.
    Undamped,
}

impl AtBound {
    /// Of a tuning, over the frequency that the damper is for, and a damping ratio that were looked for.
    pub fn of(tuning: f64, damping_ratio: f64) -> Option<Self> {
        let [soft, stiff] = [1.0 + NEAR, 1.0 - NEAR];
        if tuning >= stiff * TUNED_WITHIN[1] || damping_ratio >= stiff * DAMPED_WITHIN[1] {
            Some(Self::Fixed)
        } else if tuning <= soft * TUNED_WITHIN[0] {
            Some(Self::Detached)
        } else {
            (damping_ratio <= soft * DAMPED_WITHIN[0]).then_some(Self::Undamped)
        }
    }
}

/// Relative distance from a bound at which a simplex that runs into it has ended there.
const NEAR: f64 = 1e-3;

/// Tuning, over the frequency that it is for, and damping ratio of a damper by their logarithms, within what makes sense.
fn within_bounds([tuning, damping_ratio]: [f64; 2]) -> [f64; 2] {
    let within = |logarithm: f64, [least, most]: [f64; 2]| libm::exp(logarithm).clamp(least, most);
    [within(tuning, TUNED_WITHIN), within(damping_ratio, DAMPED_WITHIN)]
}

/// By which the cost grows beyond what makes sense: a simplex that strays comes back.
fn penalty([tuning, damping_ratio]: [f64; 2]) -> f64 {
    let beyond = |logarithm: f64, ends: [f64; 2]| {
        let [least, most] = ends.map(libm::log);
        (least - logarithm).max(logarithm - most).max(0.0)
    };
    1.0 + beyond(tuning, TUNED_WITHIN) + beyond(damping_ratio, DAMPED_WITHIN)
}

/// What a design may vary.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Designing {
    /// Its damping ratio, where it is given.
    pub damping: Option<f64>,
    /// Steps of a simplex for each damper, and restarts.
    pub steps: u64,
    /// See [`Self::steps`].
    pub restarts: u32,
}

impl Designing {
    /// Of tuning and damping.
    pub const USUAL: Self = Self { damping: None, steps: STEPS, restarts: RESTARTS };

    /// Where a damper ended at a bound of the search; a ratio that is given is none that was looked for.
    fn bound_of(&self, damper: &TunedMassDamper) -> Option<AtBound> {
        let damping_ratio = if self.damping.is_some() { 1.0 } else { damper.damping_ratio };
        AtBound::of(damper.tuning, damping_ratio)
    }
}

/// Damping ratios and so many steps between all tunings, of which the best is where a simplex begins once more that ended at a
/// bound: far from a resonance there are several places with no better one beside them. Without much damping they are narrow.
const DAMPED: [f64; 4] = [0.01, 0.05, 0.2, 0.8];
const TUNED: [u32; 2] = [40, 200];

/// The damper with the smallest cost that a simplex finds from one to begin with, within what makes sense.
pub fn best(
    from: TunedMassDamper,
    how: Designing,
    cost: impl Fn(&TunedMassDamper) -> f64,
) -> TunedMassDamper {
    best_together(&[from], how, |one| cost(&one[0]))[0]
}

/// The same of dampers that are used together, each tuned to a frequency of its own.
pub fn best_together(
    from: &[TunedMassDamper],
    how: Designing,
    cost: impl Fn(&[TunedMassDamper]) -> f64,
) -> Vec<TunedMassDamper> {
    let found = beside(from, how, &cost);
    if !found.iter().any(|one| how.bound_of(one).is_some()) {
        return found;
    }
    let (steps, dampings) = match how.damping {
        Some(damping) => (TUNED[1], vec![damping]),
        None => (TUNED[0], DAMPED.to_vec()),
    };
    let [least, most] = TUNED_WITHIN;
    let others = (0..=steps).flat_map(|k| {
        let tuning = least * libm::pow(most / least, f64::from(k) / f64::from(steps));
        dampings.iter().map(move |damping| TunedMassDamper { tuning, damping_ratio: *damping })
    });
    // Of several that which ended at a bound, beside the others as they are.
    let others = others.flat_map(|other| {
        let there = |k: &usize| how.bound_of(&found[*k]).is_some();
        let found = &found;
        (0..found.len()).filter(there).map(move |k| {
            let mut all = found.clone();
            all[k] = other;
            all
        })
    });
    let others: Vec<Vec<TunedMassDamper>> = others.collect();
    let by_cost = |a: &Vec<TunedMassDamper>, b: &Vec<TunedMassDamper>| cost(a).total_cmp(&cost(b));
    let other = others.into_iter().min_by(by_cost).map(|first| beside(&first, how, &cost));
    let better = other.filter(|other| by_cost(other, &found).is_lt());
    better.unwrap_or(found)
}

/// The same from one place to begin at.
fn beside(
    from: &[TunedMassDamper],
    how: Designing,
    cost: &impl Fn(&[TunedMassDamper]) -> f64,
) -> Vec<TunedMassDamper> {
    let logarithms = |one: &TunedMassDamper| {
        let damping = how.damping.is_none().then(|| libm::log(one.damping_ratio));
        std::iter::once(libm::log(one.tuning)).chain(damping)
    };
    let each = if how.damping.is_none() { 2 } else { 1 };
    let damper = |logarithms: &[f64]| {
        let logarithm = logarithms.get(1).copied();
        let [tuning, damping] = within_bounds([logarithms[0], logarithm.unwrap_or_default()]);
        let damping_ratio = logarithm.map_or(how.damping.unwrap_or_default(), |_| damping);
        TunedMassDamper { tuning, damping_ratio }
    };
    let dampers = |all: &[f64]| all.chunks(each).map(damper).collect::<Vec<_>>();
    let cost = |all: &[f64]| {
        // A ratio that is given is within.
        let beyond =
            all.chunks(each).map(|one| penalty([one[0], one.get(1).copied().unwrap_or_default()]));
        beyond.product::<f64>() * cost(&dampers(all))
    };
    let sizes: Vec<f64> = from.iter().flat_map(|_| SIMPLEX[..each].iter().copied()).collect();
    let steps = how.steps * from.len() as u64;
    let restarts = how.restarts * from.len() as u32;
    let start = from.iter().flat_map(logarithms).collect();
    // One damper is cheap.
    let enough = if from.len() > 1 { ENOUGH } else { 0.0 };
    dampers(&simplex(start, &sizes, [steps, restarts.into()], enough, cost))
}

/// Where a simplex that begins at a place, with these sizes along each axis, finds the smallest cost in so many steps; it begins
/// again where it ended, so often, unless that has saved less than a share of it.
fn simplex(
    mut best: Vec<f64>,
    sizes: &[f64],
    [steps, restarts]: [u64; 2],
    enough: f64,
    cost: impl Fn(&[f64]) -> f64,
) -> Vec<f64> {
    let of = Cost(cost);
    let mut before = f64::INFINITY;
    for _ in 0..restarts {
        let mut simplex = vec![best.clone(); best.len() + 1];
        for k in 0..best.len() {
            simplex[k + 1][k] += sizes[k];
        }
        let run = Executor::new(&of, NelderMead::new(simplex))
            .configure(|state| state.max_iters(steps))
            .timer(false)
            .run();
        let Some(found) = run.ok() else { continue };
        best = found.state().get_best_param().cloned().unwrap_or(best);
        let least = found.state().get_best_cost();
        if before - least < enough * before {
            break;
        }
        before = least;
    }
    best
}

/// What a simplex makes small.
struct Cost<F>(F);

impl<F: Fn(&[f64]) -> f64> CostFunction for &Cost<F> {
    type Param = Vec<f64>;
    type Output = f64;
    fn cost(&self, place: &Vec<f64>) -> Result<f64, Error> {
        Ok((self.0)(place))
    }
}

/// The damper of the absorber's mass that is best along a band, with the damping of the structure and the kind of its excitation:
/// by what is asked, or else with the smallest largest amplitude. For a single excitation that of Den Hartog: the best
/// for one frequency alone would be undamped and of no use beside it.
pub fn for_band(along: &BandSystems, asked: &SineLimits) -> TunedMassDamper {
    let start = TunedMassDamper::den_hartog(along.band.base.mass_ratio());
    if along.band.is_of_one_frequency() {
        return start;
    }
    best(start, Designing::USUAL, |damper| asked.missed(along, |system| damper.amplitude(system)))
}

/// Designs that were found, by the numbers that decide them: those of a sweep over clearances are one.
static KNOWN: Mutex<BTreeMap<Vec<u64>, TunedMassDamper>> = Mutex::new(BTreeMap::new());

/// The design by some numbers, which it gets to twelve digits: what differs by rounding is one design.
fn known<const N: usize>(
    by: [f64; N],
    design: impl FnOnce([f64; N]) -> TunedMassDamper,
) -> TunedMassDamper {
    const LOST: u64 = 1 << 12;
    let by = by.map(|one| f64::from_bits((one.to_bits() + LOST / 2) & !(LOST - 1)));
    let key: Vec<u64> = by.iter().map(|one| one.to_bits()).collect();
    let lock = || KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let there = lock().get(&key).copied();
    there.unwrap_or_else(|| {
        let found = design(by);
        lock().insert(key, found);
        found
    })
}

/// The same dampers with as much more damping, each in proportion, as it takes to fit, or as makes sense of the first.
pub fn more_damped(
    from: &[TunedMassDamper],
    fits: impl Fn(&[TunedMassDamper]) -> bool,
) -> Vec<TunedMassDamper> {
    let Some(first) = from.first() else { return Vec::new() };
    let with = |damping_ratio: f64| {
        let others = from.iter().skip(1).map(|one| {
            let damping_ratio = damping_ratio * (one.damping_ratio / first.damping_ratio);
            TunedMassDamper { damping_ratio, ..*one }
        });
        std::iter::once(TunedMassDamper { damping_ratio, ..*first })
            .chain(others)
            .collect::<Vec<_>>()
    };
    let [mut least, mut most] = [first.damping_ratio, DAMPED_WITHIN[1]];
    if fits(from) || least >= most {
        return from.to_vec();
    }
    for _ in 0..HALVINGS {
        let middle = (least * most).sqrt();
        if fits(&with(middle)) { most = middle } else { least = middle }
    }
    with(most)
}

/// A structure with nothing but what a linear one has.
fn linear(mass_ratio: f64, damping: f64, excitation: Excitation) -> Option<System> {
    let forcing_per_clearance = 1.0 / mass_ratio;
    let (restitution, frequency_ratio, cavity) = (0.0, 1.0, Cavity::IDEAL);
    let of = Parameters {
        mass_ratio,
        damping,
        restitution,
        frequency_ratio,
        forcing_per_clearance,
        excitation,
        cavity,
    };
    System::new(of).ok()
}

/// Tunings and damping ratios, over those of [`TunedMassDamper::for_free_decay`], from whose best a simplex begins: the time
/// to a level jumps where a beat comes to touch it.
const TUNINGS: [f64; 5] = [0.94, 0.97, 1.0, 1.03, 1.06];
const DAMPINGS: [f64; 6] = [0.3, 0.4, 0.5, 0.65, 0.8, 1.0];

/// Part of the level to which it is to come down: the fastest of all just touches the level in its next beat, and with a
/// little less damping exceeds it.
const SPARE: f64 = 0.97;

/// The damper with which a structure that is released comes down to a share of its first amplitude fastest.
pub fn for_release(
    system: &System,
    start: State,
    share: f64,
    oscillations: u64,
) -> TunedMassDamper {
    let size = amplitude(&start);
    if size <= 0.0 {
        return TunedMassDamper::for_free_decay(system.mass_ratio());
    }
    let State { x, x_velocity, y_velocity, .. } = start;
    let [x, x_velocity, y_velocity] = [x, x_velocity, y_velocity].map(|one| one / size);
    let by = [system.mass_ratio(), system.damping(), x, x_velocity, y_velocity, share];
    known(by, |[mass_ratio, damping, x, x_velocity, y_velocity, share]| {
        let usual = TunedMassDamper::for_free_decay(mass_ratio);
        let Some(system) = linear(mass_ratio, damping, Excitation::Force) else { return usual };
        let start = State { x, x_velocity, y: x, y_velocity };
        let time = |damper: &TunedMassDamper| {
            released(&system, Some(damper), start, SPARE * share, oscillations).settles
        };
        let all = TUNINGS.iter().flat_map(|tuning| {
            DAMPINGS.map(|damping| TunedMassDamper {
                tuning: tuning * usual.tuning,
                damping_ratio: damping * usual.damping_ratio,
            })
        });
        let first = all.min_by(|a, b| time(a).total_cmp(&time(b)));
        best(first.unwrap_or(usual), Designing::USUAL, time)
    })
}

/// The damper with which a structure moves least in a sweep.
pub fn for_sweep(system: &System, scales: &Scales, sweep: &SineSweep) -> TunedMassDamper {
    let second = 1.0 / scales.natural_frequency;
    let (rate, octaves) = match sweep.rate {
        SweepRate::Linear(rate) => (scales.frequency_ratio(rate) * second, false),
        SweepRate::Octaves(rate) => (rate * second, true),
    };
    let [from, to] = [sweep.from, sweep.to].map(|one| scales.frequency_ratio(one));
    let forced = system.excitation() == Excitation::Force;
    let flags = f64::from(u8::from(forced) + 2 * u8::from(octaves));
    let by = [system.mass_ratio(), system.damping(), from, to, rate, flags];
    known(by, |[mass_ratio, damping, from, to, rate, _]| {
        let usual = TunedMassDamper::den_hartog(mass_ratio);
        let Some(system) = linear(mass_ratio, damping, system.excitation()) else { return usual };
        // Frequency ratios over the fast time are angles.
        let rate = if octaves { SweepRate::Octaves(rate) } else { SweepRate::Linear(rate) };
        let sweep = SineSweep { from, to, rate, turn: TAU };
        let how = Designing { steps: STEPS_OF_SWEEP, restarts: 1, ..Designing::USUAL };
        best(usual, how, |damper| {
            swept(&system, Some(damper), &Scales::REDUCED, &sweep, false).peak()[1]
        })
    })
}

#[cfg(test)]
mod tests {
    use super::{AtBound, Designing, best};
    use crate::linear::TunedMassDamper;

    /// Whatever the cost falls towards, the search ends at the bound there and says so; one with a least value inside does not.
    #[test]
    fn a_search_that_runs_to_its_end_says_so() {
        let from = TunedMassDamper::den_hartog(0.05);
        let found = |cost: &dyn Fn(&TunedMassDamper) -> f64| best(from, Designing::USUAL, cost);
        let at = |one: TunedMassDamper| AtBound::of(one.tuning, one.damping_ratio);
        let inside = |value: f64, least: f64| {
            let off = libm::log(value / least);
            1.0 + off * off
        };
        let heavy = found(&|one| inside(one.tuning, 1.1) / one.damping_ratio);
        assert_eq!((at(heavy), heavy.damping_ratio <= 10.0), (Some(AtBound::Fixed), true));
        let stiff = found(&|one| inside(one.damping_ratio, 0.1) / one.tuning);
        assert_eq!((at(stiff), stiff.tuning <= 10.0), (Some(AtBound::Fixed), true));
        let soft = found(&|one| inside(one.damping_ratio, 0.1) * one.tuning);
        assert_eq!((at(soft), soft.tuning >= 0.1), (Some(AtBound::Detached), true));
        let light = found(&|one| inside(one.tuning, 1.1) * one.damping_ratio);
        assert_eq!((at(light), light.damping_ratio >= 1e-4), (Some(AtBound::Undamped), true));
        let own = found(&|one| inside(one.tuning, 1.1) * inside(one.damping_ratio, 0.2));
        assert_eq!(at(own), None);
        assert!(
            (own.tuning / 1.1 - 1.0).abs() < 1e-3 && (own.damping_ratio / 0.2 - 1.0).abs() < 1e-3
        );
    }
}
