//! The section "Band": shares, amplitudes against the rivals, the smallest gap, and where motions
//! coexist; and the same as data.

use serde::Serialize;

use super::numbers::{percent, signed};
use super::tables::{Table, table};
use super::units::Units;
use crate::analysis::{Area, Strip};
use crate::band::rivals::DETUNED;
use crate::band::simulated::Place;
use crate::band::{Rivals, Source, Stretch, Survey, Worst};
use crate::case::{BandOver, Case, Scales};
use crate::study::CaseStudy;

/// A band in `report.json`. Places and ends are frequency ratios `Omega`, or amplitudes over the case's;
/// lengths in metres for a physical case, in its own unit for a reduced one.
#[derive(Debug, Clone, Serialize)]
pub struct BandDocument {
    /// `frequency` or `amplitude`.
    over: &'static str,
    range: [f64; 2],
    z3_share: f64,
    a1_share: f64,
    a2_share: f64,
    /// The theory's areas.
    zones: Vec<ZoneDocument>,
    stable_share: f64,
    /// Where a symmetric 1:1 orbit attracts, and where not.
    stability: Vec<Stretch<bool>>,
    /// Peaks of that orbit.
    stable_orbit: Option<PeaksDocument>,
    /// The largest displacement of every motion that can happen.
    worst: Option<WorstDocument>,
    bare: RivalDocument,
    tuned_mass_damper: DamperDocument,
    /// Where the structure with an absorber that never wakes vibrates most.
    inactive: Option<InactiveDocument>,
    /// The largest displacement with the absorber where the structure's frequency is off by as much as in
    /// `tuned_mass_damper`; empty where nothing was simulated.
    detuned: Vec<Option<WorstDocument>>,
    smallest_gap: GapDocument,
    /// What simulation finds, place by place; empty where nothing was simulated.
    simulated: Vec<PlaceDocument>,
}

/// A stretch of one area, left out where closed form cannot tell Z1 from Z2.
#[derive(Debug, Clone, Serialize)]
struct ZoneDocument {
    from: f64,
    to: f64,
    area: Option<Area>,
    strip: Option<Strip>,
}

/// Largest and average peak.
#[derive(Debug, Clone, Serialize)]
struct PeaksDocument {
    largest_peak: f64,
    at: f64,
    mean_peak: f64,
}

/// The largest displacement along a band.
#[derive(Debug, Clone, Serialize)]
struct WorstDocument {
    peak: f64,
    /// How much larger it may be.
    error: f64,
    at: f64,
    /// `orbit`, `simulated` or `inactive`.
    motion: &'static str,
}

/// Largest amplitude; `null` where nothing limits it.
#[derive(Debug, Clone, Serialize)]
struct RivalDocument {
    largest_peak: f64,
    at: f64,
}

/// The tuned mass damper of the absorber's mass that is best along the band.
#[derive(Debug, Clone, Serialize)]
pub struct DamperDocument {
    /// Its natural frequency over the structure's.
    tuning: f64,
    damping_ratio: f64,
    largest_peak: f64,
    at: f64,
    /// Largest displacement against the structure.
    stroke: f64,
    detuned: [DetunedDocument; 2],
}

/// The same damper where the structure's frequency is off.
#[derive(Debug, Clone, Serialize)]
struct DetunedDocument {
    /// The structure's frequency over the one that the damper was designed for.
    factor: f64,
    largest_peak: f64,
    stroke: f64,
}

impl DamperDocument {
    /// Writes it down, `length` turning a length over the clearance into one of the case.
    pub fn new(rivals: &Rivals, length: impl Fn(f64) -> f64) -> Self {
        let Rivals { damper, damped, detuned, .. } = rivals;
        let detuned = |k: usize| DetunedDocument {
            factor: DETUNED[k],
            largest_peak: length(detuned[k].amplitude),
            stroke: length(detuned[k].stroke),
        };
        Self {
            tuning: damper.tuning,
            damping_ratio: damper.damping_ratio,
            largest_peak: length(damped.amplitude),
            at: damped.at,
            stroke: length(damped.stroke),
            detuned: [detuned(0), detuned(1)],
        }
    }
}

/// An absorber that never wakes.
#[derive(Debug, Clone, Serialize)]
struct InactiveDocument {
    /// Amplitude of the structure.
    peak: f64,
    at: f64,
    /// Share of the absorber's resting places from which a start from rest never wakes it.
    share: f64,
    /// Whether it counts as a motion.
    counted: bool,
}

/// By which share the clearance may be off, and where least.
#[derive(Debug, Clone, Serialize)]
struct GapDocument {
    share: f64,
    at: f64,
}

/// The motions of a place.
#[derive(Debug, Clone, Serialize)]
struct PlaceDocument {
    at: f64,
    /// Those with impacts.
    motions: usize,
    /// Share of the absorber's resting places from which a start from rest never wakes it.
    inactive_share: f64,
    /// Of the motions with impacts; `null` without one.
    largest_peak: f64,
    peak_error: f64,
    smallest_peak: f64,
}

impl BandDocument {
    /// Writes down what is known along a band.
    pub fn new(survey: &Survey, scales: &Scales) -> Self {
        let length = |over_clearance: f64| scales.length(over_clearance);
        let worst = |worst: &Worst| WorstDocument {
            peak: length(worst.peak),
            error: length(worst.error),
            at: worst.at,
            motion: match worst.of {
                Source::Orbit => "orbit",
                Source::Simulated(_) => "simulated",
                Source::Inactive(_) => "inactive",
            },
        };
        let motions = &survey.motions;
        let (at, share) = survey.smallest_gap;
        let zone = |zone: &Stretch<crate::analysis::Zone>| ZoneDocument {
            from: zone.from,
            to: zone.to,
            area: zone.of.area,
            strip: zone.of.strip,
        };
        Self {
            over: match motions.band.over {
                BandOver::Frequency => "frequency",
                BandOver::Amplitude => "amplitude",
            },
            range: motions.band.range,
            z3_share: survey.z3_share(),
            a1_share: survey.strip_share(Strip::A1),
            a2_share: survey.strip_share(Strip::A2),
            zones: survey.zones.iter().map(zone).collect(),
            stable_share: motions.stable_share(),
            stability: motions.stability.clone(),
            stable_orbit: motions.orbit.map(|orbit| PeaksDocument {
                largest_peak: length(orbit.largest),
                at: orbit.at,
                mean_peak: length(orbit.mean),
            }),
            worst: motions.worst().as_ref().map(worst),
            bare: RivalDocument {
                largest_peak: length(survey.rivals.bare.1),
                at: survey.rivals.bare.0,
            },
            tuned_mass_damper: DamperDocument::new(&survey.rivals, length),
            inactive: motions.inactive.map(|(at, inactive)| InactiveDocument {
                peak: length(inactive.amplitude),
                at,
                share: inactive.share,
                counted: motions.count_inactive,
            }),
            detuned: survey.detuned.iter().map(|one| one.as_ref().map(worst)).collect(),
            smallest_gap: GapDocument { share, at },
            simulated: motions
                .places
                .iter()
                .map(|place| {
                    let peaks = || place.motions.iter().map(|motion| motion.peak);
                    PlaceDocument {
                        at: place.at,
                        motions: place.motions.len(),
                        inactive_share: place.inactive.map_or(0.0, |one| one.share),
                        largest_peak: length(place.largest().map_or(f64::NAN, |one| one.peak)),
                        peak_error: length(place.largest().map_or(f64::NAN, |one| one.peak_error)),
                        smallest_peak: length(peaks().fold(f64::NAN, f64::min)),
                    }
                })
                .collect(),
        }
    }
}

/// The tables of the section; none where the case has no band.
pub(super) fn tables(case: &Case, study: &CaseStudy) -> Option<[Table; 2]> {
    let section = Section { survey: study.band.as_ref()?, units: Units::of(case) };
    Some([section.quantities(), section.zones()])
}

struct Section<'a> {
    survey: &'a Survey,
    units: Units,
}

impl Section<'_> {
    fn quantities(&self) -> Table {
        let (survey, motions) = (self.survey, &self.survey.motions);
        let theory = "theory, closed form";
        let mut rows = Vec::new();
        if let Some(worst) = motions.worst() {
            let words = format!("{} at {}", self.worst(&worst), self.place(worst.at));
            rows.push(row("Largest displacement, any motion", words, source(&worst)));
        }
        if let Some(found) = motions.orbit {
            let largest = format!("{} at {}", self.length(found.largest), self.place(found.at));
            rows.push(row("The same, stable 1:1 orbit", largest, "exact orbits"));
        }
        if let Some((at, inactive)) = motions.inactive {
            let counted = if motions.count_inactive { "" } else { "; not counted" };
            let words = format!(
                "{} at {}, from {} of its resting places{counted}",
                self.length(inactive.amplitude),
                self.place(at),
                percent(inactive.share)
            );
            rows.push(row("The same, absorber never wakes from rest", words, "closed form"));
        }
        let bare = survey.rivals.bare;
        let words = format!("{} at {}", self.length(bare.1), self.place(bare.0));
        rows.push(row("The same, without absorber", words, "closed form"));
        rows.extend(self.damper());
        rows.push(row(
            "Share with a stable 1:1 orbit",
            percent(motions.stable_share()),
            "exact orbits",
        ));
        rows.push(row("Share in area Z3", percent(survey.z3_share()), theory));
        rows.push(row(
            "of it in strip A1 (hysteresis)",
            percent(survey.strip_share(Strip::A1)),
            theory,
        ));
        rows.push(row("of it in strip A2 (beats)", percent(survey.strip_share(Strip::A2)), theory));
        rows.push(row("Smallest gap to a boundary", self.relative_displacement(), "exact orbits"));
        if !motions.places.is_empty() {
            let several = self.simulated_places(|place| place.motions.len() > 1);
            rows.push(row("Several motions with impacts", several, "simulation"));
        }
        table([("Quantity", false), ("Value", true), ("From", false)], rows)
    }

    /// The tuned mass damper, and both where the structure is detuned.
    fn damper(&self) -> Vec<[String; 3]> {
        let survey = self.survey;
        let Rivals { damper, damped, detuned, .. } = survey.rivals;
        let from = format!(
            "closed form, best over the band: tuned to {}, damping ratio {}",
            self.units.frequency_text(damper.tuning),
            percent(damper.damping_ratio)
        );
        let words = format!(
            "{} at {}, stroke {}",
            self.length(damped.amplitude),
            self.place(damped.at),
            self.length(damped.stroke)
        );
        let mut rows = vec![row("The same, tuned mass damper of the same mass", words, &from)];
        for (k, off) in detuned.iter().enumerate() {
            let absorber = survey.detuned.get(k).copied().flatten();
            let absorber = absorber.map_or("–".to_owned(), |worst| self.worst(&worst));
            let words = format!(
                "absorber {absorber}; damper {}, stroke {}",
                self.length(off.amplitude),
                self.length(off.stroke)
            );
            let name =
                format!("Both, structure's frequency {} %", signed(100.0 * (DETUNED[k] - 1.0), 0));
            rows.push(row(&name, words, "simulation; closed form"));
        }
        rows
    }

    fn worst(&self, worst: &Worst) -> String {
        self.units.length_with_error(worst.peak, worst.error)
    }

    fn zones(&self) -> Table {
        let rows =
            self.survey.zones.iter().map(|zone| {
                [self.place(zone.from), self.place(zone.to), zone.of.words().to_owned()]
            });
        table([("From", true), ("To", true), ("Area by theory", false)], rows.collect())
    }

    fn relative_displacement(&self) -> String {
        let (at, gap) = self.survey.smallest_gap;
        if gap > 0.0 {
            format!("{} of the clearance, at {}", percent(gap), self.place(at))
        } else {
            format!("none: no stable 1:1 orbit at {}", self.place(at))
        }
    }

    /// The simulated places at which something holds.
    fn simulated_places(&self, holds: impl Fn(&Place) -> bool) -> String {
        let places = &self.survey.motions.places;
        let held: Vec<f64> =
            places.iter().filter(|place| holds(place)).map(|place| place.at).collect();
        let count = places.len();
        match held.as_slice() {
            [] => format!("at none of {count} places"),
            [only] => format!("at 1 of {count} places, {}", self.place(*only)),
            [first, .., last] => format!(
                "at {} of {count} places, from {} to {}",
                held.len(),
                self.place(*first),
                self.place(*last)
            ),
        }
    }

    fn length(&self, over_clearance: f64) -> String {
        if over_clearance.is_finite() {
            self.units.length_text(over_clearance)
        } else {
            "without limit".into()
        }
    }

    fn place(&self, at: f64) -> String {
        self.units.band_text(self.survey.band().over, at)
    }
}

fn row(quantity: &str, value: String, from: &str) -> [String; 3] {
    [quantity.to_owned(), value, from.to_owned()]
}

/// The layer that the worst motion is from.
fn source(worst: &Worst) -> &'static str {
    match worst.of {
        Source::Orbit => "exact orbits",
        Source::Simulated(_) => "simulation",
        Source::Inactive(_) => "closed form, absorber never wakes",
    }
}
