//! A range of excitations of one design: a band of frequencies, or of amplitudes.

use serde::Serialize;

use super::{Excitation, InvalidParameter, Parameter, Parameters, System};
use crate::names;

names! { name:
    /// What is varied along a band.
    #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
    pub enum BandOver {
        /// The excitation's frequency.
        Frequency = "frequency",
        /// Its amplitude, at the case's frequency.
        Amplitude = "amplitude",
    }
}

/// A range of excitations of one design.
#[derive(Debug, Clone, PartialEq)]
pub struct Band {
    /// The design, at its own frequency and amplitude.
    pub base: System,
    /// What is varied.
    pub over: BandOver,
    /// The ends, ascending: `Omega`, or amplitude over the base system's.
    pub range: [f64; 2],
    /// The amplitude over a band of frequencies: straight lines between corners of `Omega` and the
    /// amplitude over the base system's, constant before the first and after the last; the base
    /// system's where there are none.
    pub spectrum: Vec<[f64; 2]>,
}

/// Width of the band, over the excitation, that stands for a single one: what is the same all along it
/// is the same in its middle.
const POINT: f64 = 1e-12;

/// A part of a band that has something in common.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Stretch<T> {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// What it has in common.
    pub of: T,
}

impl Band {
    /// The excitation of a system alone.
    pub fn point(system: &System) -> Self {
        let at = system.frequency_ratio();
        Self {
            base: *system,
            over: BandOver::Frequency,
            range: [at * (1.0 - POINT), at * (1.0 + POINT)],
            spectrum: Vec::new(),
        }
    }

    /// The system at a place of the band.
    ///
    /// # Errors
    /// [`InvalidParameter`] outside of what a system can have.
    pub fn system(&self, at: f64) -> Result<System, InvalidParameter> {
        match self.over {
            BandOver::Amplitude => Parameter::Amplitude.applied(&self.base, at),
            BandOver::Frequency => {
                let there = self.base.with_frequency_ratio(at)?;
                match self.forcing(at) {
                    1.0 => Ok(there),
                    forcing => Parameter::Amplitude.applied(&there, forcing),
                }
            }
        }
    }

    /// The place of the base system's own excitation, `Omega` or an amplitude over its own; it may lie outside.
    pub fn own(&self) -> f64 {
        match self.over {
            BandOver::Frequency => self.base.frequency_ratio(),
            BandOver::Amplitude => 1.0,
        }
    }

    /// Whether that is an excitation of the band: inside of its range, and with the amplitude that the band has there.
    pub fn holds_own(&self) -> bool {
        let [from, to] = self.range;
        let own = self.own();
        from <= own && own <= to && self.system(own).is_ok_and(|system| system == self.base)
    }

    /// Whether it is a single excitation.
    pub fn is_point(&self) -> bool {
        self.width() <= 4.0 * POINT * self.range[0]
    }

    /// Whether it is of one frequency: a single excitation, or several amplitudes.
    pub fn is_of_one_frequency(&self) -> bool {
        self.over == BandOver::Amplitude || self.is_point()
    }

    /// The same excitation of a structure whose natural frequency is `factor` times as high, by its
    /// stiffness: mass, force and damping ratio stay. Lengths stay over the clearance, places are over the new
    /// natural frequency. `None` where no system has such values.
    pub fn with_structure_detuned(&self, factor: f64) -> Option<Self> {
        let parameters = self.base.parameters();
        let over_stiffness = match parameters.excitation {
            Excitation::Force => factor * factor,
            Excitation::BaseDisplacement => 1.0,
        };
        let base = System::new(Parameters {
            frequency_ratio: parameters.frequency_ratio / factor,
            forcing_per_clearance: parameters.forcing_per_clearance / over_stiffness,
            cavity: parameters.cavity.with_clearance_scaled(factor * factor),
            ..parameters
        });
        let mut band = self.with_base(base.ok()?);
        if self.over == BandOver::Frequency {
            band.range = band.range.map(|end| end / factor);
            band.spectrum.iter_mut().for_each(|corner| corner[0] /= factor);
        }
        Some(band)
    }

    /// The same range for another design.
    #[must_use]
    pub fn with_base(&self, base: System) -> Self {
        Self { base, ..self.clone() }
    }

    /// Its length, in `Omega` or amplitudes over the base system's own.
    pub fn width(&self) -> f64 {
        self.range[1] - self.range[0]
    }

    /// Evenly spread places, both ends among them.
    pub fn places(&self, count: u32) -> impl Iterator<Item = f64> + use<> {
        let [from, to] = self.range;
        let last = f64::from(count.max(2) - 1);
        (0..count.max(2)).map(move |k| {
            let part = f64::from(k) / last;
            from * (1.0 - part) + to * part
        })
    }

    /// The share of the band in the stretches for which something holds.
    pub fn share<T>(&self, stretches: &[Stretch<T>], holds: impl Fn(&T) -> bool) -> f64 {
        let inside = stretches.iter().filter(|stretch| holds(&stretch.of));
        // An empty sum is minus 0.
        inside.map(|stretch| stretch.to - stretch.from).sum::<f64>() / self.width() + 0.0
    }

    /// Amplitude over the base system's at a frequency ratio.
    fn forcing(&self, frequency_ratio: f64) -> f64 {
        let after = self.spectrum.partition_point(|corner| corner[0] <= frequency_ratio);
        match (after.checked_sub(1).map(|k| self.spectrum[k]), self.spectrum.get(after)) {
            (None, None) => 1.0,
            (Some(only), None) => only[1],
            (None, Some(only)) => only[1],
            (Some([a, before]), Some([b, behind])) => {
                let part = (frequency_ratio - a) / (b - a);
                before * (1.0 - part) + behind * part
            }
        }
    }

    /// Places at which the excitation has a corner, inside the band.
    pub fn corners(&self) -> impl Iterator<Item = f64> + '_ {
        let [from, to] = self.range;
        let corners = self.spectrum.iter().map(|corner| corner[0]);
        corners.filter(move |at| self.over == BandOver::Frequency && from < *at && *at < to)
    }

    /// The band cut at places inside of it, with what each piece is found to be in its middle;
    /// neighbours that are the same are one.
    pub fn cut<T: PartialEq>(
        &self,
        mut places: Vec<f64>,
        mut what: impl FnMut(f64) -> T,
    ) -> Vec<Stretch<T>> {
        let [from, to] = self.range;
        places.retain(|at| from < *at && *at < to);
        places.extend([from, to]);
        places.sort_by(f64::total_cmp);
        places.dedup();
        let mut found: Vec<Stretch<T>> = Vec::new();
        for pair in places.windows(2) {
            let of = what(0.5 * (pair[0] + pair[1]));
            match found.last_mut() {
                Some(last) if last.of == of => last.to = pair[1],
                _ => found.push(Stretch { from: pair[0], to: pair[1], of }),
            }
        }
        found
    }
}
