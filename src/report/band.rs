//! The section "Band": shares, amplitudes against the rivals, the smallest gap, and where motions
//! coexist.

use super::numbers::{LengthFormat, percent, significant};
use super::tables::{Table, table};
use crate::analysis::Strip;
use crate::band::rivals::{TunedMassDamper, bare_amplitude, largest_amplitudes};
use crate::band::simulated::{Effort, motions};
use crate::band::{Band, exact, margin, theory};
use crate::case::{BandOver, Case};
use crate::study::CaseStudy;
use crate::system::System;

/// Places over which the amplitudes of rivals are averaged.
const PLACES: u32 = 1001;
/// Places that are simulated.
const SIMULATED: u32 = 41;

/// The tables of the section; none where the case has no band.
pub(super) fn tables(case: &Case, study: &CaseStudy) -> Option<[Table; 2]> {
    let band = Band::of(&case.system(), case.band.as_ref()?);
    let section = Section { band, case, lengths: LengthFormat::of(&case.scales()) };
    Some([section.quantities(study), section.zones()])
}

struct Section<'a> {
    band: Band,
    case: &'a Case,
    lengths: LengthFormat,
}

impl Section<'_> {
    fn quantities(&self, study: &CaseStudy) -> Table {
        let Self { band, .. } = self;
        let zones = theory::zones(band);
        let strip = |wanted| band.share(&zones, |zone| zone.strip == Some(wanted));
        let stability = exact::stability(band);
        let stable = band.share(&stability, |stable| *stable);
        let z3 = band.share(&zones, |zone| zone.is_z3());
        let mut rows = vec![
            row("Share in area Z3", percent(z3), "theory, closed form"),
            row("of it in strip A1 (hysteresis)", percent(strip(Strip::A1)), "theory, closed form"),
            row("of it in strip A2 (beats)", percent(strip(Strip::A2)), "theory, closed form"),
            row("Share with a stable 1:1 orbit", percent(stable), "exact orbits"),
        ];
        let damper = TunedMassDamper::best(band.base.mass_ratio());
        let [bare, damped] = largest_amplitudes(band);
        let peak = |_: f64, orbit: &crate::orbits::SymmetricOrbit| orbit.peaks.displacement;
        if let Some(found) = exact::extreme(band, &stability, peak) {
            let largest = format!("{} at {}", self.length(found.largest), self.place(found.at));
            rows.push(row("Largest peak, stable 1:1 orbit", largest, "exact orbits"));
            let mean = self.length(found.mean);
            rows.push(row("Average of that peak where it is stable", mean, "exact orbits"));
        }
        for (name, largest, amplitude) in [
            ("bare oscillator", bare, &bare_amplitude as &dyn Fn(&System) -> Option<f64>),
            ("best tuned mass damper", damped, &|system: &System| damper.amplitude(system)),
        ] {
            let words = format!(
                "{}, on average {}",
                self.length(largest),
                self.length(self.mean(amplitude))
            );
            rows.push(row(&format!("Largest peak, {name}"), words, "closed form"));
        }
        let (at, gap) = margin::smallest(band);
        let gap = if gap > 0.0 {
            format!("{} of the clearance, at {}", percent(gap), self.place(at))
        } else {
            format!("none: no stable 1:1 orbit at {}", self.place(at))
        };
        rows.push(row("Smallest gap to a boundary", gap, "exact orbits"));
        if study.simulated {
            rows.push(row("Several motions coexist", self.coexistence(), "simulation"));
        }
        table([("Quantity", false), ("Value", true), ("From", false)], rows)
    }

    fn zones(&self) -> Table {
        let zones = theory::zones(&self.band);
        let rows = zones
            .iter()
            .map(|zone| [self.place(zone.from), self.place(zone.to), zone.of.words().to_owned()]);
        table([("From", true), ("To", true), ("Area by theory", false)], rows.collect())
    }

    /// Where simulation from several starts finds more than one motion.
    fn coexistence(&self) -> String {
        let places: Vec<f64> = self.band.places(SIMULATED).collect();
        let systems: Vec<System> =
            places.iter().filter_map(|at| self.band.system(*at).ok()).collect();
        let effort = Effort::default();
        let Ok(found) = motions(&systems, &effort) else { return "not simulated".into() };
        let several: Vec<f64> = places
            .iter()
            .zip(&found)
            .filter(|(_, motions)| motions.len() > 1)
            .map(|(at, _)| *at)
            .collect();
        match several.as_slice() {
            [] => format!("at none of {SIMULATED} places, {} starts each", effort.starts),
            [only] => format!("at 1 of {SIMULATED} places, {}", self.place(*only)),
            [first, .., last] => format!(
                "at {} of {SIMULATED} places, from {} to {}",
                several.len(),
                self.place(*first),
                self.place(*last)
            ),
        }
    }

    fn mean(&self, amplitude: &dyn Fn(&System) -> Option<f64>) -> f64 {
        let there = |at: f64| self.band.system(at).ok().and_then(|system| amplitude(&system));
        let values: Vec<f64> =
            self.band.places(PLACES).map(|at| there(at).unwrap_or(f64::INFINITY)).collect();
        values.iter().sum::<f64>() / values.len() as f64
    }

    fn length(&self, over_clearance: f64) -> String {
        if over_clearance.is_finite() {
            self.lengths.text(self.case.scales().length(over_clearance))
        } else {
            "without limit".into()
        }
    }

    fn place(&self, at: f64) -> String {
        match self.band.over {
            BandOver::Frequency => match self.case.scales().frequency_hz(at) {
                Some(hertz) => format!("{} Hz", significant(hertz, 4)),
                None => format!("Ω = {}", significant(at, 4)),
            },
            BandOver::Amplitude => format!("{} × the case's amplitude", significant(at, 3)),
        }
    }
}

fn row(quantity: &str, value: String, from: &str) -> [String; 3] {
    [quantity.to_owned(), value, from.to_owned()]
}
