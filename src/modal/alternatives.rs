//! Alternatives to the absorbers of a structure of several modes, also where its natural frequencies are off.

use super::along::AlongEffort;
use super::dampers::{DamperChoice, PlacedDampers};
use super::linear::{
    amplitudes, asked_of, largest, largest_peak, linear_most, linear_peak, places, resonances,
    response,
};
use super::{ModalAnswer, ModalError};
use crate::alternatives::{Alternatives, Drifting, Own, Room, compared, compared_by};
use crate::case::{ActsOn, Criterion, Load, ModalCase, Of};
use crate::dampers::{Designing, missed_with};
use crate::executor::Executor;
use crate::linear::{ModalAmplitudes, ModalDamper, PlacedResponse};
use crate::measure::Measure;
use crate::numerics::scan;
use crate::operating_range::Varies;
use crate::system::MOST_MODES;

/// How far beside a single frequency dampers are to work, over it: one for that frequency alone is a spring without damping.
const ASIDE: f64 = 0.02;
/// Pieces of a range, and steps beside each mode, in which a design is looked at beside its resonances.
const LOOKED_AT: [u32; 2] = [64, 8];
/// How far beside a resonance it is looked at too, over it: so that its top has even neighbours.
const NEAR: f64 = 1e-3;
/// Its case, and where dampers are looked at in a design.
pub(super) struct DriftedStructure {
    case: ModalCase,
    /// Natural frequencies over the case's own.
    factor: f64,
    /// What devices are compared by; the largest displacement where that is none.
    asked: Option<Criterion>,
    /// Frequencies in Hz along each load, with the structure alone as dampers see it; none where it has no steady motion by itself.
    along: Vec<Vec<(f64, Option<PlacedResponse>)>>,
    /// The largest displacement of any place without absorbers, in m.
    bare: f64,
}

/// Where dampers are looked at in a design, in Hz.
fn wide(load: &Load) -> [f64; 2] {
    match load.range_hz {
        [from, to] if from == to => [from * (1.0 - ASIDE), to * (1.0 + ASIDE)],
        range => range,
    }
}

impl DriftedStructure {
    /// That of a case.
    pub fn of(case: &ModalCase) -> Self {
        Self::with(case.clone(), 1.0)
    }

    fn with(case: ModalCase, factor: f64) -> Self {
        let mut sites: Vec<usize> =
            (0..case.modes.len()).map(|k| PlacedDampers::place(&case, k)).collect();
        sites.sort_unstable();
        sites.dedup();
        let of_load = |load: &Load| {
            let all = places(wide(load), &case, LOOKED_AT).into_iter();
            let seen = |at: f64| Some(response(&case, load, at)?.seen_from(&sites));
            all.map(|at| (at, seen(at))).collect()
        };
        let along = case.loads.iter().map(of_load).collect();
        let bare = case.loads.iter().map(|load| largest_peak(&case, load, &[])).fold(0.0, f64::max);
        Self { asked: compared_by(&case.criteria).cloned(), along, bare, case, factor }
    }

    /// What dampers come to, and their largest stroke.
    fn most(&self, dampers: &[ModalDamper]) -> [f64; 2] {
        let case = &self.case;
        let stroke = |load: &Load| {
            let of = |at: f64| {
                amplitudes(case, load, at, dampers).strokes.into_iter().fold(0.0, f64::max)
            };
            largest(load.range_hz, case, dampers, of)[0]
        };
        let strokes = case.loads.iter().map(stroke).fold(0.0, f64::max);
        let asked = self.asked.as_ref().and_then(|asked| linear_most(case, asked, dampers));
        let peak = || case.loads.iter().map(|load| largest_peak(case, load, dampers));
        [asked.unwrap_or_else(|| peak().fold(0.0, f64::max)), strokes]
    }
}

impl Drifting for DriftedStructure {
    type Dampers = PlacedDampers;
    type Error = ModalError;

    fn drifted(&self, factor: f64) -> Option<Self> {
        Some(Self::with(self.case.with_frequencies(factor), factor))
    }

    fn room(&self) -> f64 {
        self.case.absorbers.iter().map(|one| one.clearance_m).fold(0.0, f64::max)
    }

    fn is_of_one_frequency(&self) -> bool {
        self.case.is_point()
    }

    fn has_stops(&self) -> bool {
        false
    }

    fn designing(&self) -> Designing {
        Designing::USUAL
    }

    fn told(&self, dampers: Option<&PlacedDampers>, _: Room) -> [f64; 2] {
        let on = dampers.map(|dampers| dampers.on(&self.case, self.factor));
        self.most(&on.unwrap_or_default())
    }

    /// By how much limits are missed, or the largest displacement.
    fn cost(&self, dampers: &PlacedDampers) -> [f64; 2] {
        let case = &self.case;
        let on = dampers.on(case, self.factor);
        let limits = case.criteria.iter().filter(|one| one.limits_sines());
        let mut over: Vec<(&Criterion, f64)> = limits.map(|one| (one, 0.0)).collect();
        let [mut peak, mut stroke] = [0.0_f64; 2];
        let most = |all: &[f64]| all.iter().copied().fold(0.0, f64::max);
        for (load, all) in case.loads.iter().zip(&self.along) {
            let mut there: Vec<(f64, ModalAmplitudes)> = all
                .iter()
                .map(|(at, alone)| {
                    let seen = alone.as_ref().and_then(|alone| alone.with(&on, &dampers.places));
                    (*at, seen.unwrap_or_else(|| amplitudes(case, load, *at, &on)))
                })
                .collect();
            let resonant = resonances(wide(load), case, &on).into_iter();
            let resonant = resonant.flat_map(|at| [at * (1.0 - NEAR), at, at * (1.0 + NEAR)]);
            there.extend(resonant.map(|at| (at, amplitudes(case, load, at, &on))));
            there.sort_by(|a, b| a.0.total_cmp(&b.0));
            let top = |of: &dyn Fn(f64, &ModalAmplitudes) -> f64| {
                let values: Vec<[f64; 2]> =
                    there.iter().map(|(at, there)| [*at, of(*at, there)]).collect();
                scan::top(&values)
            };
            peak = peak.max(top(&|_, there| most(&there.places)));
            stroke = stroke.max(top(&|_, there| most(&there.strokes)));
            for (one, over) in &mut over {
                let part = |at: f64, there: &ModalAmplitudes| {
                    asked_of(case, one, there, at).map_or(0.0, |own| one.part(own))
                };
                *over = over.max(top(&part));
            }
        }
        let over: Vec<(Measure, f64)> =
            over.into_iter().map(|(of, over)| (of.measure, over)).collect();
        [missed_with(&over, [peak, self.bare]), stroke]
    }

    /// More coarsely than for the verdict, in windows of the usual length.
    fn absorber(&self, on: &dyn Executor) -> Result<Option<[f64; 2]>, ModalError> {
        let criteria = self.asked.iter().cloned().collect();
        let case = ModalCase { periods: 0, criteria, ..self.case.clone() };
        let answer = ModalAnswer::with(&case, &AlongEffort::COARSE, &[], on)?;
        Ok(own(&case, &answer).map(|(worst, _)| worst))
    }
}

/// Which absorbers rest, by their numbers from 0, in the motion by which devices are compared.
pub fn resting(case: &ModalCase, answer: &ModalAnswer) -> [bool; MOST_MODES] {
    let of_worst = || answer.worst(case, None).map(|worst| worst.found.resting);
    let judged = compared(&answer.judged).map(|one| one.resting);
    judged.or_else(of_worst).unwrap_or_default()
}

/// What devices are compared by as the absorbers have it, with its error, and whether some rest in that motion.
fn own(case: &ModalCase, answer: &ModalAnswer) -> Option<([f64; 2], bool)> {
    if let Some(judged) = compared(&answer.judged) {
        return Some(([judged.found?, judged.error], judged.inactive.is_some()));
    }
    let worst = answer.worst(case, None)?.found;
    Some(([worst.value, worst.error], worst.rest.is_some()))
}

/// What else could be done in place of the absorbers of a case; none where nothing was found to compare with.
///
/// # Errors
/// [`ModalError`] where a motion cannot be flown.
pub(super) fn alternatives(
    case: &ModalCase,
    answer: &ModalAnswer,
    on: &dyn Executor,
) -> Result<Option<Alternatives<PlacedDampers>>, ModalError> {
    let Some((worst, inactive)) = own(case, answer) else { return Ok(None) };
    let (measure, of) =
        compared_by(&case.criteria).map_or((Measure::Peak, Of::Any), |one| (one.measure, one.of));
    let own = Own { measure, of, inactive, worst };
    let here = DriftedStructure::of(case);
    Alternatives::beside(&here, own, designs(case), (&case.criteria, &case.alternatives), on)
}

/// The best one damper and, of structures that several modes drive, one for each of these modes: tuned and damped so that what criteria
/// ask for is smallest over what they allow, or without criteria the largest displacement of any place, under any load; under loads of
/// one frequency each Den Hartog's.
pub fn designs(case: &ModalCase) -> Vec<PlacedDampers> {
    let driven = driven_modes(case);
    let mut counts = vec![1];
    if driven.len() > 1 {
        counts.push(driven.len());
    }
    let here = DriftedStructure::of(case);
    let designed = |count: usize| {
        let usual = PlacedDampers::den_hartog(case, &driven[..count]);
        here.designed(&[], &usual, Room::AsDesigned, None)
    };
    counts.into_iter().map(designed).collect()
}

/// About how many seconds the designs of alternatives take on one processor: by the evaluations of a simplex for each number of dampers,
/// each at some frequencies of each load, as designed, in the room, undamped, and for each drift on three structures.
pub fn seconds_of_designs(case: &ModalCase) -> f64 {
    const EVALUATIONS: f64 = 600.0;
    const SECONDS: f64 = 2e-7;
    // Nothing is looked for there.
    if case.is_point() {
        return 0.0;
    }
    let frequencies = (64 + 20 * case.modes.len()) * case.loads.len();
    let designs = 3.0 + 3.0 * case.alternatives.drift.len() as f64;
    let count = driven_modes(case).len();
    let counts = if count > 1 { vec![1.0, count as f64] } else { vec![1.0] };
    let each = counts.into_iter().map(|count: f64| count * count * (1.0 + count));
    designs * EVALUATIONS * SECONDS * frequencies as f64 * each.sum::<f64>()
}

/// The same with what they do.
pub fn choices(case: &ModalCase) -> Vec<DamperChoice> {
    designs(case).into_iter().map(|one| DamperChoice::of(case, one)).collect()
}

/// The modes that a load is resonant with, the one that moves farthest first.
fn driven_modes(case: &ModalCase) -> Vec<usize> {
    let mut found: Vec<(usize, f64)> = Vec::new();
    for load in &case.loads {
        for (k, mode) in case.modes.iter().enumerate() {
            let [from, to] = load.range_hz;
            let near = mode.frequency_hz.clamp(from, to);
            let driven = !matches!(load.on, ActsOn::Mode(other) if other != k);
            // Within a twentieth of its frequency.
            if !driven || (near / mode.frequency_hz - 1.0).abs() > 0.05 {
                continue;
            }
            let most = linear_peak(case, load, near, &[]);
            match found.iter_mut().find(|(known, _)| *known == k) {
                Some((_, known)) => *known = known.max(most),
                None => found.push((k, most)),
            }
        }
    }
    found.sort_by(|a, b| b.1.total_cmp(&a.1));
    let modes: Vec<usize> = found.into_iter().map(|(k, _)| k).collect();
    if modes.is_empty() { vec![0] } else { modes }
}
