//! A sweep through resonance with everything that is known of it: from all places of the absorber and in both
//! directions, at other rates, beside its alternatives and the steady motions.

use std::f64::consts::TAU;
use std::sync::OnceLock;

use super::Runs;
use crate::case::Case;
use crate::dampers;
use crate::excitation::SineSweep;
use crate::executor::{Executor, map};
use crate::flights::{Passage, Places, even, survey};
use crate::linear::{TunedMassDamper, bare_amplitude, swept};
use crate::measure::Measure;
use crate::orbits::steady_orbit;
use crate::quantity::Units;
use crate::simulation::{Impact, StartError};
use crate::system::{State, System};

/// Rates over the case's own.
pub const RATES: [f64; 5] = [0.25, 0.5, 1.0, 2.0, 4.0];
/// Frequencies at which steady motions are known.
const PLACES: u32 = 300;

/// The absorber's relative displacement at a start, and what happened.
pub type SweepStart = (f64, Passage);

/// A passage at some rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ByRate {
    /// The sweep.
    pub sweep: SineSweep,
    /// Frequency ratio and size of the largest displacement: with absorber from the worst start, alone, with the
    /// damper.
    pub peaks: [[f64; 2]; 3],
}

/// A sudden change of the envelope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jump {
    /// Frequency ratio.
    pub at: f64,
    /// The largest displacement before, and after.
    pub levels: [f64; 2],
}

/// A structure that was swept through its resonance.
#[derive(Debug, Clone)]
pub struct SweepStudy {
    /// The system; its frequency is that of the start.
    pub system: System,
    /// The sweep.
    pub sweep: SineSweep,
    /// Every start.
    pub starts: Runs<Passage>,
    /// The worst of the starts in the other direction.
    pub back: Passage,
    /// The structure alone.
    pub alone: Passage,
    units: Units,
    /// With the tuned mass damper, once somebody asks.
    damped: OnceLock<(TunedMassDamper, Passage)>,
    /// Frequency ratio, amplitude of the structure alone, peak of the symmetric 1:1 orbit, NaN where none attracts: of
    /// steady motion.
    pub steady: Vec<[f64; 3]>,
    /// Where the envelope jumps, in the case's own direction and in the other.
    pub jumps: [Vec<Jump>; 2],
    /// Lowest and highest frequency ratio at which the directions differ.
    pub differ: Option<[f64; 2]>,
    /// Other rates, and the own one.
    pub by_rate: Vec<ByRate>,
}

impl SweepStudy {
    /// At most so many for each other rate, and for the other direction.
    pub const STARTS_BESIDE: u32 = 16;

    /// Studies a case that is swept; none for another.
    ///
    /// # Errors
    /// [`StartError`] where the motion is so large that rounding hides the walls.
    pub fn of_case(case: &Case, executor: &dyn Executor) -> Option<Result<Self, StartError>> {
        let sweep = case.design.sine_sweep()?;
        let (even, shaking) = (case.absorber_places()?, case.asks_for_shaking());
        let (system, units) = (case.system(), case.units());
        let places = Places { even, closer: true, shaking, executor };
        Some(Self::of(&system, &units, &sweep, places, case.count_inactive))
    }

    /// From rest, the absorber at a relative displacement `w`.
    pub(super) fn start(
        system: &System,
        units: &Units,
        sweep: &SineSweep,
        w: f64,
        shaking: bool,
    ) -> Result<SweepStart, StartError> {
        let start = State { y: -w, ..State::AT_REST };
        let told = &mut |_: &Impact| {};
        let flown = Passage::follow_telling(system, units, sweep, start, u64::MAX, shaking, told);
        flown.map(|(found, _)| (w, found))
    }

    /// From even places of the absorber and closer ones.
    pub(super) fn starts(
        system: &System,
        units: &Units,
        sweep: &SineSweep,
        places: Places<'_>,
        inactive: bool,
    ) -> Result<Runs<Passage>, StartError> {
        let counts = |of: fn(&Passage) -> f64| {
            move |found: &Passage| match inactive || found.impacts > 0 {
                true => of(found),
                false => f64::NAN,
            }
        };
        let (peaks, speeds) = (counts(|found| found.peak()[1]), counts(|found| found.impact_speed));
        let all = survey(places, &[&peaks, &speeds], |w| {
            Self::start(system, units, sweep, w, places.shaking).map(|(_, found)| found)
        })?;
        Ok(Runs { all, even: places.even, count_inactive: inactive })
    }

    /// The starts, the structure alone and with the damper, and nothing beside.
    pub(super) fn brief(
        system: &System,
        units: &Units,
        sweep: &SineSweep,
        places: Places<'_>,
        inactive: bool,
    ) -> Result<Self, StartError> {
        Ok(Self {
            system: *system,
            sweep: *sweep,
            starts: Self::starts(system, units, sweep, places, inactive)?,
            back: Passage::new(0, 0.0),
            alone: swept(system, None, units, sweep, places.shaking),
            units: *units,
            damped: OnceLock::new(),
            steady: Vec::new(),
            jumps: Default::default(),
            differ: None,
            by_rate: Vec::new(),
        })
    }

    fn of(
        system: &System,
        units: &Units,
        sweep: &SineSweep,
        places: Places<'_>,
        inactive: bool,
    ) -> Result<Self, StartError> {
        let study = Self::brief(system, units, sweep, places, inactive)?;
        let rates: Vec<SineSweep> = RATES
            .into_iter()
            .map(|factor| sweep.faster(factor))
            .filter(|other| other.fastest_change() <= SineSweep::LARGEST_CHANGE)
            .filter(|other| other.count() >= SineSweep::FEWEST)
            .collect();
        let others = rates.iter().copied().filter(|other| other != sweep);
        let all: Vec<SineSweep> = [sweep.reversed()].into_iter().chain(others).collect();
        let at: Vec<f64> = even(places.even.min(Self::STARTS_BESIDE.into())).collect();
        let passage =
            |k: usize| Self::start(system, units, &all[k / at.len()], at[k % at.len()], false);
        let flown = map(places.executor, "passages", all.len() * at.len(), passage);
        let flown = flown.into_iter().collect::<Result<Vec<SweepStart>, StartError>>()?;
        let worst_of = |sweep: &SineSweep| -> Option<Passage> {
            let n = all.iter().position(|other| other == sweep)?;
            let all = flown[n * at.len()..(n + 1) * at.len()].to_vec();
            let of = Runs { all, even: at.len() as u64, count_inactive: inactive };
            of.worst(Measure::Peak).map(|(_, found)| found.clone())
        };
        let there = study.worst().map(|(_, found)| found.clone());
        let damper = study.damped().0;
        let linear = |damper: Option<&TunedMassDamper>, sweep: &SineSweep| {
            swept(system, damper, units, sweep, false)
        };
        let by_rate = rates.iter().map(|other| {
            let found = if other == sweep { there.clone() } else { worst_of(other) };
            ByRate {
                sweep: *other,
                peaks: [
                    found.map_or([f64::NAN; 2], |found| found.peak()),
                    linear(None, other).peak(),
                    linear(Some(&damper), other).peak(),
                ],
            }
        });
        let by_rate = by_rate.collect();
        let none = || Passage::new(0, 0.0);
        let back = worst_of(&sweep.reversed()).unwrap_or_else(none);
        let there = there.unwrap_or_else(none);
        let window = window(system);
        Ok(Self {
            steady: steady(system, units, sweep),
            jumps: [&there, &back].map(|passage| jumps(&passage.envelope, window)),
            differ: differ(&there.envelope, &back.envelope, window),
            by_rate,
            back,
            ..study
        })
    }

    /// The tuned mass damper of the absorber's mass that is best in it, and the structure with it.
    pub fn damped(&self) -> &(TunedMassDamper, Passage) {
        self.damped.get_or_init(|| {
            let Self { system, units, sweep, .. } = self;
            let damper = dampers::for_sweep(system, units, sweep);
            (damper, swept(system, Some(&damper), units, sweep, self.alone.shaking.is_some()))
        })
    }

    /// The start with the largest displacement.
    pub fn worst(&self) -> Option<&SweepStart> {
        self.starts.worst(Measure::Peak)
    }
}

/// Amplitudes of steady motion along the range.
fn steady(system: &System, units: &Units, sweep: &SineSweep) -> Vec<[f64; 3]> {
    let place = |k: u32| {
        let part = f64::from(k) / f64::from(PLACES);
        let ratio = units.frequency_ratio(sweep.from + part * (sweep.to - sweep.from));
        let there = system.with_frequency_ratio(ratio).ok()?;
        let orbit = steady_orbit(&there).map_or(f64::NAN, |orbit| orbit.peaks.displacement);
        Some([ratio, bare_amplitude(&there), orbit])
    };
    (0..=PLACES).filter_map(place).collect()
}

/// Periods whose largest displacement is a level: as many as the absorber needs to take the structure's energy, about
/// `1/(2 pi eps)`, in which it may be caught and lost again, and as the structure's damping needs, so that beating is
/// no change of level; not more than that is of an absorber of a thousandth of the mass.
fn window(system: &System) -> usize {
    let eps = system.mass_ratio();
    let damping = 0.5 * eps * system.damping();
    let periods = 1.0 / (TAU * eps.max(1e-3)) + 1.0 / (TAU * damping.max(1e-3));
    libm::ceil(periods) as usize
}

/// A level that changes by more from one window to the next: where the response has the width of the structure's
/// resonance and the sweep is slow, its flanks rise by less.
const JUMP: f64 = 1.6;

/// Where the level of an envelope changes by the factor [`JUMP`] from the window before to that behind: the
/// largest change among all within a window.
fn jumps(envelope: &[[f64; 2]], window: usize) -> Vec<Jump> {
    let level = |some: &[[f64; 2]]| some.iter().map(|one| one[1]).fold(0.0, f64::max);
    // From rest a structure first has to come to its motion.
    let places = 3 * window..envelope.len().saturating_sub(window);
    let change = |k: usize| {
        let levels = [level(&envelope[k - window..k]), level(&envelope[k..k + window])];
        (k, levels, libm::fabs(libm::log(levels[1] / levels[0])))
    };
    let mut found: Vec<(usize, [f64; 2], f64)> = Vec::new();
    for one in places.map(change).filter(|one| one.2 > libm::log(JUMP)) {
        match found.last_mut() {
            Some(last) if one.0 - last.0 <= window => {
                if one.2 > last.2 {
                    *last = one;
                }
            }
            _ => found.push(one),
        }
    }
    // A level knows its change to a window; the envelope is steepest where it jumps.
    let steepness = |k: &usize| libm::fabs(libm::log(envelope[*k][1] / envelope[*k - 1][1]));
    let place = |k: usize| {
        let near = k - window..(k + window).min(envelope.len());
        near.max_by(|a, b| steepness(a).total_cmp(&steepness(b))).unwrap_or(k)
    };
    found
        .iter()
        .map(|(k, levels, _)| Jump { at: envelope[place(*k)][0], levels: *levels })
        .collect()
}

/// Difference of two levels that is one, over the largest displacement of all: irregular motion on the flanks of a
/// resonance differs by more of itself in any two sweeps.
const DIFFERENT: f64 = 0.05;

/// Lowest and highest frequency at which the levels of two directions differ, without what either needs to begin.
fn differ(there: &[[f64; 2]], back: &[[f64; 2]], window: usize) -> Option<[f64; 2]> {
    let settled = |some: &[[f64; 2]]| some.get(3 * window..).unwrap_or_default().to_vec();
    let level = |some: &[[f64; 2]], k: usize| {
        let part = &some[k.saturating_sub(window / 2)..(k + window / 2).min(some.len())];
        part.iter().map(|one| one[1]).fold(0.0, f64::max)
    };
    let (there, mut back) = (settled(there), settled(back));
    let rises = |some: &[[f64; 2]]| Some(some.last()?[0] > some.first()?[0]);
    if rises(&there)? == rises(&back)? {
        return None;
    }
    back.reverse();
    let rising = rises(&back)?;
    let largest = there.iter().chain(&back).map(|one| one[1]).fold(0.0, f64::max);
    let apart = |k: &usize| {
        let frequency = there[*k][0];
        let other = back.partition_point(|one| (one[0] < frequency) == rising);
        let within = other > 0 && other < back.len();
        let [own, other] = [level(&there, *k), level(&back, other)];
        within && (own - other).abs() > DIFFERENT * largest
    };
    let all = (0..there.len()).filter(apart).map(|k| there[k][0]);
    all.fold(None, |range, at| {
        let [low, high] = range.unwrap_or([at, at]);
        Some([at.min(low), at.max(high)])
    })
}

#[cfg(test)]
mod tests {
    use super::{differ, jumps};

    const WINDOW: usize = 20;

    /// An envelope over 2000 periods from one frequency to another, whose size follows the frequency.
    fn envelope([from, to]: [f64; 2], size: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
        let place = |k: i32| from + (to - from) * f64::from(k) / 1999.0;
        (0..2000).map(|k| [place(k), size(place(k))]).collect()
    }

    /// A resonance that is followed up to 1.02 on the way up and is left from above at 0.99 on the way down.
    fn hysteresis(up: bool) -> Vec<[f64; 2]> {
        let resonance = |f: f64| 1.0 / (0.05 + (f - 1.0).abs());
        let upper = move |f: f64| if f < if up { 1.02 } else { 0.99 } { resonance(f) } else { 2.0 };
        envelope(if up { [0.9, 1.1] } else { [1.1, 0.9] }, upper)
    }

    #[test]
    fn a_jump_is_where_the_envelope_jumps() {
        // A period is 1e-4 of frequency, a window 2e-3.
        for (up, at, levels) in [(true, 1.02, [1.0 / 0.068, 2.0]), (false, 0.99, [2.0, 1.0 / 0.06])]
        {
            let found = jumps(&hysteresis(up), WINDOW);
            assert_eq!(found.len(), 1, "{found:?}");
            assert!((found[0].at - at).abs() < 2e-4, "{found:?}");
            assert!(
                found[0].levels.iter().zip(levels).all(|(a, b)| (a / b - 1.0).abs() < 0.1),
                "{found:?}"
            );
        }
        let smooth = envelope([0.9, 1.1], |f| 1.0 / (0.05 + (f - 1.0).abs()));
        assert_eq!(jumps(&smooth, WINDOW), []);
    }

    #[test]
    fn directions_differ_where_only_one_follows_the_resonance() {
        let [low, high] =
            differ(&hysteresis(true), &hysteresis(false), WINDOW).expect("between the jumps");
        assert!((low - 0.99).abs() < 2e-3 && (high - 1.02).abs() < 2e-3, "{low} {high}");
        // Eight per cent of a flank are three of the largest displacement, and no difference.
        let with_flanks = |range: [f64; 2], factor: f64| {
            let flank = move |f: f64| if (f - 1.0).abs() > 0.08 { factor } else { 1.0 };
            envelope(range, move |f| flank(f) / (0.05 + (f - 1.0).abs()))
        };
        let (up, down) = (with_flanks([0.9, 1.1], 1.0), with_flanks([1.1, 0.9], 1.08));
        assert_eq!(differ(&up, &down, WINDOW), None);
    }
}
