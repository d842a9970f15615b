//! The structure along a load without absorbers, alone or with tuned mass dampers.

use crate::case::{Criterion, Load, ModalCase, Of};
use crate::linear::{ModalAmplitudes, ModalDamper, ModalResponse, frequencies_with};
use crate::measure::Measure;
use crate::numerics::scan;

/// Pieces of a range in which the largest amplitude is looked for, beside ever closer ones around the modes.
const PIECES: u32 = 256;
const CLOSER: u32 = 16;

/// How far beside the frequency of an undamped mode dampers are looked at, over it; twice as far an amplitude that nothing limits is
/// half as large, and one that they limit the same.
const BESIDE: f64 = 1e-7;
const DIVERGES: f64 = 1.5;

/// The structure at a frequency in Hz without absorbers; none where it has no steady motion.
pub(super) fn response(case: &ModalCase, load: &Load, at: f64) -> Option<ModalResponse> {
    Some(ModalResponse::of(&case.system(load, at).ok()?, &case.shapes()))
}

/// Amplitudes at a frequency in Hz; infinite where nothing limits them.
pub(super) fn amplitudes(
    case: &ModalCase,
    load: &Load,
    at: f64,
    dampers: &[ModalDamper],
) -> ModalAmplitudes {
    let of = |at: f64| Some(response(case, load, at)?.with(dampers));
    // At an undamped mode's own frequency it has no steady motion by itself, and has one with dampers that see it.
    let beside = || {
        let near = [1.0, 2.0].map(|times| of(at * (1.0 + times * BESIDE)));
        let [Some(near), Some(far)] = near else { return None };
        let limited =
            |(near, far): (&f64, &f64)| if *near > DIVERGES * far { f64::INFINITY } else { *near };
        let all = |near: &[f64], far: &[f64]| near.iter().zip(far).map(limited).collect();
        Some(ModalAmplitudes {
            places: all(&near.places, &far.places),
            strokes: all(&near.strokes, &far.strokes),
        })
    };
    let unlimited = || ModalAmplitudes {
        places: vec![f64::INFINITY; case.places.len()],
        strokes: vec![f64::INFINITY; dampers.len()],
    };
    of(at).or_else(|| beside().filter(|_| !dampers.is_empty())).unwrap_or_else(unlimited)
}

/// The largest amplitude of any place at a frequency in Hz.
pub fn linear_peak(case: &ModalCase, load: &Load, at: f64, dampers: &[ModalDamper]) -> f64 {
    amplitudes(case, load, at, dampers).places.into_iter().fold(0.0, f64::max)
}

/// The largest of a measure of any place at a frequency in Hz, in SI units; not a number of what sines do not have.
pub fn linear_at(
    case: &ModalCase,
    load: &Load,
    at: f64,
    dampers: &[ModalDamper],
    measure: Measure,
) -> f64 {
    let amplitude = linear_peak(case, load, at, dampers);
    measure.of_sine(amplitude, fast(case, at)).unwrap_or(f64::NAN)
}

/// A frequency in Hz in rad over the unit of time of a case.
fn fast(case: &ModalCase, at: f64) -> f64 {
    case.omega() * at / case.modes[0].frequency_hz
}

/// The largest amplitude of any place along a load.
pub(super) fn largest_peak(case: &ModalCase, load: &Load, dampers: &[ModalDamper]) -> f64 {
    let of_place = |p: usize| {
        largest(load.range_hz, case, dampers, |at| amplitudes(case, load, at, dampers).places[p])[0]
    };
    (0..case.places.len()).map(of_place).fold(0.0, f64::max)
}

/// What a criterion is about, in SI units, where places move with these amplitudes at a frequency in Hz; none of what only an absorber
/// has, or compares with something.
pub(super) fn asked_of(
    case: &ModalCase,
    asked: &Criterion,
    amplitudes: &ModalAmplitudes,
    at: f64,
) -> Option<f64> {
    let places = amplitudes.places.iter().enumerate();
    let places = places.filter(|(p, _)| asked.of.holds(Of::Place(*p)));
    let amplitude = places.map(|(_, amplitude)| *amplitude).fold(0.0, f64::max);
    asked.measure.of_sine(amplitude, fast(case, at))
}

/// The most of what a criterion is about under any load, in SI units; none as there.
pub fn linear_most(case: &ModalCase, asked: &Criterion, dampers: &[ModalDamper]) -> Option<f64> {
    if !asked.measure.is_of_sines() {
        return None;
    }
    let along = |load: &Load| {
        let of = |at: f64| {
            asked_of(case, asked, &amplitudes(case, load, at, dampers), at).unwrap_or_default()
        };
        largest(load.range_hz, case, dampers, of)[0]
    };
    Some(case.loads.iter().map(along).fold(0.0, f64::max))
}

/// Frequencies in Hz at which it is looked at along a range, ascending.
pub fn linear_places(range: [f64; 2], case: &ModalCase) -> Vec<f64> {
    places(range, case, [PIECES, CLOSER])
}

/// The same by so many pieces, and steps on either side of each mode.
pub(super) fn places(range: [f64; 2], case: &ModalCase, [pieces, closer]: [u32; 2]) -> Vec<f64> {
    let around = case.modes.iter().flat_map(|mode| {
        let width = mode.damping_ratio * mode.frequency_hz;
        (0..=closer).flat_map(move |k| {
            let off = f64::from(k) / f64::from(closer) * 2.0 * width;
            [mode.frequency_hz - off, mode.frequency_hz + off]
        })
    });
    let within = around.filter(|at| (range[0]..=range[1]).contains(at));
    let mut all: Vec<f64> = scan::places(range, pieces).chain(within).collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}

/// Frequencies in Hz within a range at which the structure with dampers is resonant, ascending.
pub(super) fn resonances(range: [f64; 2], case: &ModalCase, dampers: &[ModalDamper]) -> Vec<f64> {
    let first = case.modes[0].frequency_hz;
    let modes = case.modes.iter().map(|mode| [mode.frequency_hz / first, mode.mass_kg]);
    let all = frequencies_with(&modes.collect::<Vec<_>>(), dampers).into_iter();
    all.map(|one| one * first).filter(|at| (range[0]..=range[1]).contains(at)).collect()
}

/// The largest value along a range where dampers are used, narrowed down around the best place, and where.
pub(super) fn largest(
    range: [f64; 2],
    case: &ModalCase,
    dampers: &[ModalDamper],
    of: impl Fn(f64) -> f64,
) -> [f64; 2] {
    let mut all = linear_places(range, case);
    if !dampers.is_empty() {
        all.extend(resonances(range, case, dampers));
        all.sort_by(f64::total_cmp);
        all.dedup();
    }
    let best = (0..all.len()).map(|k| (of(all[k]), k)).max_by(|a, b| a.0.total_cmp(&b.0));
    let Some((mut most, k)) = best else { return [0.0, range[0]] };
    let mut at = all[k];
    scan::narrow([all[k.saturating_sub(1)], all[(k + 1).min(all.len() - 1)]], |place| {
        let value = of(place);
        if value > most {
            (most, at) = (value, place);
        }
        Some(value)
    });
    [most, at]
}
