//! What such a case can be read with, and is almost surely a slip: a unit or a per cent sign, by the limits of
//! [`crate::case::warnings`].

use std::ops::Range;

use super::{AbsorberKey, ActsOn, Load, ModalCase, PlacedAbsorber, StructuralMode};
use crate::case::error::Problem;
use crate::case::warnings::{
    FAR_APART, HEAVY_DAMPING, MASS_RATIOS, far_from_walls, hertz, meant, percent, resonant, short,
    times,
};

/// Where numbers stand that a slip may be in.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Spans {
    /// The damping ratio of each mode; of modes in a file that in `[modes]`, or the name of the file.
    pub damping: Vec<Range<usize>>,
    /// Of each load the frequency, or both ends of its range.
    pub frequencies: Vec<Vec<Range<usize>>>,
}

/// What to look at where an absorber is no small mass.
const UNITS: &str = "check the units of its mass and of the modal masses, which belong to the scale of the shapes: an absorber \
                     usually has a few per cent";
/// Mass ratios beyond which nothing that is computed means anything.
const ANY_MASS_RATIO: [f64; 2] = [1e-12, 1e6];

/// Each absorber's mass over that which its impacts see.
fn mass_ratios(case: &ModalCase) -> impl Iterator<Item = f64> {
    case.absorbers.iter().map(|one| {
        let inverse = case.modes.iter().map(|mode| {
            let phi = mode.shape[one.place];
            phi * (phi / mode.mass_kg)
        });
        one.mass_kg * inverse.sum::<f64>()
    })
}

/// The first absorber that is no mass beside the structure at all, or the structure none beside it: where, what and what to do.
pub(super) fn out_of_scale(case: &ModalCase, text: &str) -> Option<Problem> {
    let [least, most] = ANY_MASS_RATIO;
    let (k, ratio) =
        mass_ratios(case).enumerate().find(|(_, ratio)| !(least..=most).contains(ratio))?;
    let key = AbsorberKey::ALL.iter().position(|key| *key == AbsorberKey::Mass)?;
    let span = case.values.get(k)?[key].clone()?;
    let (side, than) = match ratio < least {
        true => ("less than", least),
        false => ("more than", most),
    };
    let message = format!(
        "absorber {} has {side} {} times the mass that its impacts see",
        k + 1,
        short(than)
    );
    Some(Problem::new(text, span, message, "expected a mass beside the structure's").help(UNITS))
}

/// Everything that a case is warned of, what was `found` as it was read among it, in the order of its lines.
pub(super) fn of(
    case: &ModalCase,
    text: &str,
    spans: &Spans,
    mut found: Vec<Problem>,
) -> Vec<Problem> {
    let read = Read { case, text };
    found.extend(read.damping(spans));
    // What has no unit has none that is wrong.
    if !case.reduced {
        found.extend(read.masses());
        found.extend(read.frequencies(spans));
        // Beside another slip sizes mean nothing.
        if found.is_empty() {
            found.extend(read.clearances());
        }
    }
    found.sort_by_key(|warning| warning.span.start);
    found
}

/// The most that a load may move a place without absorbers in m, with every mode at its resonance; infinite without damping.
fn most_moved(case: &ModalCase, load: &Load, place: usize) -> f64 {
    // Over modal mass and the square of the mode's frequency.
    let moved = |(k, mode): (usize, &StructuralMode)| {
        let omega = std::f64::consts::TAU * mode.frequency_hz;
        let over_mass = match load.on {
            ActsOn::Place(pushed) => mode.shape[pushed] * load.amplitude / mode.mass_kg,
            ActsOn::Mode(driven) if driven == k => load.amplitude / mode.mass_kg,
            ActsOn::Mode(_) => 0.0,
            ActsOn::Modes => mode.forcing * load.amplitude,
            ActsOn::Base => mode.participation * load.amplitude * omega * omega,
        };
        let moved = (mode.shape[place] * over_mass).abs() / (omega * omega);
        if moved > 0.0 { resonant(moved, mode.damping_ratio) } else { 0.0 }
    };
    let base = if load.on == ActsOn::Base { load.amplitude } else { 0.0 };
    base + case.modes.iter().enumerate().map(moved).sum::<f64>()
}

struct Read<'a> {
    case: &'a ModalCase,
    text: &'a str,
}

impl Read<'_> {
    fn written(&self, span: &Range<usize>) -> &str {
        self.text[span.clone()].trim_matches(['"', '\''])
    }

    fn warning(&self, span: &Range<usize>, message: String, label: &str, meant: String) -> Problem {
        Problem::new(self.text, span.clone(), message, label).help(meant).into_warning()
    }

    /// Of modes that share a place in the text the worst is told.
    fn damping(&self, spans: &Spans) -> Vec<Problem> {
        let modes = self.case.modes.iter().map(|mode| mode.damping_ratio);
        let mut heavy: Vec<(&Range<usize>, f64)> = Vec::new();
        for (span, ratio) in spans.damping.iter().zip(modes).filter(|one| one.1 > HEAVY_DAMPING) {
            match heavy.last_mut().filter(|(last, _)| *last == span) {
                Some((_, most)) => *most = most.max(ratio),
                None => heavy.push((span, ratio)),
            }
        }
        let told = heavy.into_iter().map(|(span, ratio)| {
            let message = format!("a damping ratio is {}", percent(ratio));
            let part = ratio / 100.0;
            let meant = format!("was {} ({}) meant?", percent(part), short(part));
            self.warning(span, message, "most structures have less than 5 %", meant)
        });
        told.collect()
    }

    fn masses(&self) -> Vec<Problem> {
        let [least, most] = MASS_RATIOS;
        let key = AbsorberKey::ALL.iter().position(|key| *key == AbsorberKey::Mass);
        let of = |(ratio, values): (f64, &[Option<Range<usize>>; 4])| {
            let span = values[key?].as_ref().filter(|_| !(least..=most).contains(&ratio))?;
            let message = format!(
                "`mass` = {}: the absorber has {} times the mass that its impacts see",
                self.written(span),
                short(ratio)
            );
            Some(self.warning(span, message, "no small mass beside a structure", UNITS.to_owned()))
        };
        mass_ratios(self.case).zip(&self.case.values).filter_map(of).collect()
    }

    /// Clearances of absorbers that no load moves their place to, or far beyond.
    fn clearances(&self) -> Vec<Problem> {
        let case = self.case;
        let key = AbsorberKey::ALL.iter().position(|key| *key == AbsorberKey::Clearance);
        let of = |(absorber, values): (&PlacedAbsorber, &[Option<Range<usize>>; 4])| {
            let span = values[key?].as_ref()?;
            let moved = case.loads.iter().map(|load| most_moved(case, load, absorber.place));
            let most = moved.fold(0.0, f64::max) / absorber.clearance_m;
            let (message, label, meant) = far_from_walls(most)?;
            let message = format!("`clearance` = {}: {message}", self.written(span));
            Some(self.warning(span, message, label, meant.to_owned()))
        };
        case.absorbers.iter().zip(&case.values).filter_map(of).collect()
    }

    /// Frequencies of loads that are far from those of all modes.
    fn frequencies(&self, spans: &Spans) -> Vec<Problem> {
        let apart = |ratio: f64| ratio.max(1.0 / ratio);
        let loads = self.case.loads.iter().zip(&spans.frequencies);
        let each = loads.flat_map(|(load, spans)| spans.iter().zip(load.range_hz));
        let far = each.filter_map(|(span, hz)| {
            let natural = self.case.modes.iter().map(|mode| mode.frequency_hz);
            let nearest = natural
                .min_by(|a, b| apart(hz / a).total_cmp(&apart(hz / b)))
                .filter(|nearest| apart(hz / nearest) > FAR_APART)?;
            let (ratio, written) = (hz / nearest, self.written(span));
            let than = format!("the nearest natural frequency, {}", hertz(nearest));
            let message = format!("{written} is {}", times(ratio, &than));
            Some(self.warning(
                span,
                message,
                "far from every mode",
                meant(written, hz, ratio, true),
            ))
        });
        far.collect()
    }
}
