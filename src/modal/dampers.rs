//! Tuned mass dampers beside the absorbers of a structure of several modes.

use super::cost::cost;
use super::linear::{
    amplitudes, asked_of, largest, largest_peak, linear_most, linear_peak, linear_places,
};
use crate::case::{ActsOn, Load, ModalCase};
use crate::dampers::{AtBound, penalty, simplex, within_bounds};
use crate::linear::ModalDamper;
use crate::measure::Measure;

/// Dampers of equal mass, together as heavy as the absorbers.
#[derive(Debug, Clone, PartialEq)]
pub struct DamperChoice {
    /// The dampers; lengths in m, masses in kg, frequencies over the first mode's.
    pub dampers: Vec<ModalDamper>,
    /// Where each is.
    pub places: Vec<usize>,
    /// What each is where the search for it ended at a bound.
    pub at_bound: Vec<Option<AtBound>>,
    /// The largest displacement under each load, of any place, in m.
    pub worst: Vec<f64>,
    /// The largest stroke of each damper under any load, in m.
    pub strokes: Vec<f64>,
    /// What each criterion comes to, in SI units; none of what only an absorber has.
    pub criteria: Vec<Option<f64>>,
}

/// Steps of a simplex, and how often it begins again where it ended.
const STEPS: u64 = 150;
const RESTARTS: u32 = 3;
/// How far beside a single frequency dampers are to work, over it: one for that frequency alone is a spring without damping.
const ASIDE: f64 = 0.02;
/// What the largest displacement over that of the structure alone counts beside limits that are of something else: one that holds
/// by a little more is not worth several times the vibration.
const BESIDE: f64 = 0.1;
/// Its first size in the logarithms of frequency and damping ratio.
const SIMPLEX: [f64; 2] = [0.02, 0.3];

/// The best one damper and, of structures that several modes drive, one for each of these modes: tuned and damped so that what criteria
/// ask for is smallest over what they allow, or without criteria the largest displacement of any place, under any load; under loads of
/// one frequency each Den Hartog's. Each is where its mode moves most.
pub fn choices(case: &ModalCase) -> Vec<DamperChoice> {
    let driven = driven_modes(case);
    let mut counts = vec![1];
    if driven.len() > 1 {
        counts.push(driven.len());
    }
    counts.into_iter().map(|count| best(case, &driven, count)).collect()
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

fn best(case: &ModalCase, modes: &[usize], count: usize) -> DamperChoice {
    let mass = case.absorbers.iter().map(|one| one.mass_kg).sum::<f64>() / count as f64;
    let first = case.modes[0].frequency_hz;
    let (mut start, mut places, mut shapes, mut own) =
        (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for k in &modes[..count] {
        let mode = &case.modes[*k];
        let size = |p: &usize| mode.shape[*p].abs();
        let place =
            (0..case.places.len()).max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or_default();
        let ratio = mass * mode.shape[place] * mode.shape[place] / mode.mass_kg;
        // Den Hartog's; tunings are over the frequency of its mode.
        let tuned = 1.0 / (1.0 + ratio);
        own.push(mode.frequency_hz / first);
        let damping = (3.0 * ratio / (8.0 * (1.0 + ratio))).sqrt();
        start.extend([libm::log(tuned), libm::log(damping)]);
        shapes.push(case.modes.iter().map(|one| one.shape[place]).collect::<Vec<f64>>());
        places.push(place);
    }
    let built = |logarithms: &[f64]| -> Vec<ModalDamper> {
        let pairs = logarithms.chunks(2).zip(own.iter().zip(&shapes));
        let damper = |(pair, (own, shape)): (&[f64], (&f64, &Vec<f64>))| {
            let [tuning, damping_ratio] = within_bounds([pair[0], pair[1]]);
            ModalDamper { mass, frequency: tuning * own, damping_ratio, shape: shape.clone() }
        };
        pairs.map(damper).collect()
    };
    let wide = |load: &Load| match load.range_hz {
        [from, to] if from == to => [from * (1.0 - ASIDE), to * (1.0 + ASIDE)],
        range => range,
    };
    let along: Vec<(&Load, Vec<f64>)> =
        case.loads.iter().map(|load| (load, linear_places(wide(load), case))).collect();
    let bare = case.loads.iter().map(|load| largest_peak(case, load, &[])).fold(0.0, f64::max);
    let others = case.criteria.iter().any(|one| one.measure != Measure::Peak);
    let cost = |logarithms: &[f64]| {
        let dampers = built(logarithms);
        let beyond: f64 = logarithms.chunks(2).map(|pair| penalty([pair[0], pair[1]])).product();
        let (mut over, mut peak) = (vec![0.0_f64; case.criteria.len()], 0.0_f64);
        for (load, all) in &along {
            for at in all {
                let there = amplitudes(case, load, *at, &dampers);
                peak = there.places.iter().copied().fold(peak, f64::max);
                for (over, one) in over.iter_mut().zip(&case.criteria) {
                    let own = asked_of(case, one, &there, *at);
                    *over = over.max(own.map_or(0.0, |own| one.part(own)));
                }
            }
        }
        beyond
            * match case.criteria.is_empty() {
                true => peak,
                false => cost(&over) + if others { BESIDE * peak / bare } else { 0.0 },
            }
    };
    let sizes: Vec<f64> = (0..start.len()).map(|k| SIMPLEX[k % 2]).collect();
    // For loads of one frequency alone the best would be undamped and of no use beside it, as with one mode.
    let is_range = |load: &Load| load.range_hz[0] < load.range_hz[1];
    let dampers = match case.loads.iter().any(is_range) {
        true => built(&simplex(start, &sizes, STEPS, RESTARTS, cost)),
        false => built(&start),
    };
    let at_bound =
        |(one, own): (&ModalDamper, &f64)| AtBound::of(one.frequency / own, one.damping_ratio);
    let stroke = |d: usize| {
        let most = |load: &Load| {
            largest(load.range_hz, case, |at| amplitudes(case, load, at, &dampers).strokes[d])[0]
        };
        case.loads.iter().map(most).fold(0.0, f64::max)
    };
    DamperChoice {
        worst: case.loads.iter().map(|load| largest_peak(case, load, &dampers)).collect(),
        strokes: (0..count).map(stroke).collect(),
        criteria: case.criteria.iter().map(|one| linear_most(case, one, &dampers)).collect(),
        at_bound: dampers.iter().zip(&own).map(at_bound).collect(),
        dampers,
        places,
    }
}
