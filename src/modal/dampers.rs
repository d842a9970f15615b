//! Tuned mass dampers beside the absorbers of a structure of several modes.

use super::linear::{amplitudes, largest, largest_peak, linear_most};
use crate::alternatives::Dampers;
use crate::case::{Load, ModalCase};
use crate::dampers::AtBound;
use crate::linear::{ModalDamper, TunedMassDamper};

/// Dampers of equal mass, together as heavy as the absorbers, each where its mode moves farthest.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedDampers {
    /// Each, over the frequency of its mode.
    pub each: Vec<TunedMassDamper>,
    /// The modes that they are for.
    pub modes: Vec<usize>,
    /// Where each is.
    pub places: Vec<usize>,
    /// The mass of one, in kg.
    pub mass_kg: f64,
}

impl Dampers for PlacedDampers {
    /// Other starts of the simplex led to displacements that differ by up to as much.
    const DESIGN: f64 = 1e-3;

    fn each(&self) -> Vec<TunedMassDamper> {
        self.each.clone()
    }

    fn with(&self, each: &[TunedMassDamper]) -> Self {
        Self { each: each.to_vec(), ..self.clone() }
    }
}

impl PlacedDampers {
    /// Den Hartog's for these modes.
    pub(super) fn den_hartog(case: &ModalCase, modes: &[usize]) -> Self {
        let mass_kg =
            case.absorbers.iter().map(|one| one.mass_kg).sum::<f64>() / modes.len() as f64;
        let (mut each, mut places) = (Vec::new(), Vec::new());
        for k in modes {
            let mode = &case.modes[*k];
            let place = Self::place(case, *k);
            let ratio = mass_kg * mode.shape[place] * mode.shape[place] / mode.mass_kg;
            // A mode that moves nowhere has none.
            each.push(TunedMassDamper::den_hartog(ratio.max(1e-9)));
            places.push(place);
        }
        Self { each, modes: modes.to_vec(), places, mass_kg }
    }

    /// Where the damper of a mode is.
    pub(super) fn place(case: &ModalCase, mode: usize) -> usize {
        let size = |p: &usize| case.modes[mode].shape[*p].abs();
        let farthest = (0..case.places.len()).max_by(|a, b| size(a).total_cmp(&size(b)));
        farthest.unwrap_or_default()
    }

    /// The natural frequency of each, in Hz.
    pub fn frequencies_hz<'a>(&'a self, case: &'a ModalCase) -> impl Iterator<Item = f64> + 'a {
        let each = self.each.iter().zip(&self.modes);
        each.map(|(one, mode)| one.tuning * case.modes[*mode].frequency_hz)
    }

    /// The same on the structure of a case whose natural frequencies are so many times those that they were made for.
    pub fn on(&self, case: &ModalCase, factor: f64) -> Vec<ModalDamper> {
        let first = case.modes[0].frequency_hz;
        let each = self.each.iter().zip(self.frequencies_hz(case)).zip(&self.places);
        let damper = |((one, frequency), place): ((&TunedMassDamper, f64), &usize)| ModalDamper {
            mass: self.mass_kg,
            frequency: frequency / (factor * first),
            damping_ratio: one.damping_ratio,
            shape: case.modes.iter().map(|mode| mode.shape[*place]).collect(),
        };
        each.map(damper).collect()
    }

    /// What each is where the search for it ended at a bound; a damping ratio that is given was not looked for.
    pub fn at_bound(&self, is_given: bool) -> Vec<Option<AtBound>> {
        let ratio = |one: &TunedMassDamper| if is_given { 1.0 } else { one.damping_ratio };
        self.each.iter().map(|one| AtBound::of(one.tuning, ratio(one))).collect()
    }
}

/// Dampers, and what they do.
#[derive(Debug, Clone, PartialEq)]
pub struct DamperChoice {
    /// The dampers.
    pub dampers: PlacedDampers,
    /// The largest displacement under each load, of any place, in m.
    pub worst: Vec<f64>,
    /// The largest stroke of each damper under any load, in m.
    pub strokes: Vec<f64>,
    /// What each criterion comes to, in SI units; none of what only an absorber has.
    pub criteria: Vec<Option<f64>>,
}

impl DamperChoice {
    /// What dampers that were made for a case do.
    pub fn of(case: &ModalCase, dampers: PlacedDampers) -> Self {
        let on = dampers.on(case, 1.0);
        let stroke = |d: usize| {
            let most = |load: &Load| {
                largest(load.range_hz, case, &on, |at| amplitudes(case, load, at, &on).strokes[d])
                    [0]
            };
            case.loads.iter().map(most).fold(0.0, f64::max)
        };
        Self {
            worst: case.loads.iter().map(|load| largest_peak(case, load, &on)).collect(),
            strokes: (0..on.len()).map(stroke).collect(),
            criteria: case.criteria.iter().map(|one| linear_most(case, one, &on)).collect(),
            dampers,
        }
    }
}
