//! The response over a case's band, and what else could be done.

use crate::band::Band;
use crate::linear::bare_amplitude;
use crate::motions::one_to_one;
use crate::regimes::Regime;
use crate::study::CaseStudy;
use crate::system::System;

use super::{Line, steady_orbits_at};

/// Peaks over the clearance along a band, `[place, peak]`.
#[derive(Debug, Clone)]
pub struct BandCurves {
    /// Without absorber.
    pub bare: Line,
    /// With the best tuned mass damper of the same mass.
    pub damper: Line,
    /// Of the admissible symmetric orbits: those that attract, and those that do not; the asymmetric ones that attract are
    /// among the first.
    pub orbits: [Line; 2],
}

impl BandCurves {
    /// Places along the band.
    const PLACES: u32 = 301;

    pub(super) fn of(study: &CaseStudy) -> Option<Self> {
        let survey = study.band.as_ref()?;
        let (band, damper) = (survey.band(), survey.rivals().damper);
        let curve = |amplitude: &dyn Fn(&System) -> f64| -> Line {
            let value = |at: f64| band.system(at).map_or(f64::NAN, |system| amplitude(&system));
            band.places(Self::PLACES).map(|at| [at, value(at)]).collect()
        };
        Some(Self {
            bare: curve(&bare_amplitude),
            damper: curve(&|system| damper.amplitude(system)),
            orbits: Self::orbits(band),
        })
    }

    fn orbits(band: &Band) -> [Line; 2] {
        let mut lines = [Vec::new(), Vec::new()];
        // Both orbits of a place in turn, from the larger absorber amplitude down, so that a line follows
        // one of them where the other begins or ends.
        for which in 0..2 {
            for at in band.places(Self::PLACES) {
                let found = steady_orbits_at(band.system(at).ok());
                let orbit = found.iter().rev().nth(which);
                let orbit = orbit.filter(|one| one.orbit.admissibility.admissible);
                for (line, stable) in lines.iter_mut().zip([true, false]) {
                    let shown = orbit.filter(|one| one.orbit.attracts() == stable);
                    line.push(shown.map_or([f64::NAN; 2], |one| [at, one.peaks.displacement]));
                }
            }
            lines.iter_mut().for_each(|line| line.push([f64::NAN; 2]));
        }
        if band.base.cavity().is_ideal() {
            lines[0].extend(band.places(Self::PLACES).map(|at| {
                let found = band.system(at).map(|system| one_to_one(&system)).unwrap_or_default();
                let others = found.iter().filter(|one| one.regime() != Regime::TwoSymmetric);
                let peaks = others.map(|one| one.facts().peak.value);
                peaks.max_by(f64::total_cmp).map_or([f64::NAN; 2], |peak| [at, peak])
            }));
        }
        lines
    }
}
