//! The section "Band": shares, amplitudes against the rivals, the smallest gap, and where motions
//! coexist; and the same as data.

use serde::Serialize;

use super::numbers::percent;
use super::tables::{Table, table};
use super::units::Units;
use crate::analysis::{Area, Strip};
use crate::band::rivals::TunedMassDamper;
use crate::band::simulated::Place;
use crate::band::{Stretch, Survey};
use crate::case::{BandOver, Case, Scales};
use crate::regimes::long_term::Motion;
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
    bare: RivalDocument,
    tuned_mass_damper: RivalDocument,
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

/// Largest and average amplitude; `null` where nothing limits them.
#[derive(Debug, Clone, Serialize)]
struct RivalDocument {
    largest_peak: f64,
    mean_peak: f64,
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
    motions: usize,
    /// Whether the absorber stays asleep in one of them.
    asleep: bool,
    largest_peak: f64,
    smallest_peak: f64,
}

impl BandDocument {
    /// Writes down what is known along a band.
    pub fn new(survey: &Survey, scales: &Scales) -> Self {
        let length = |over_clearance: f64| scales.length(over_clearance);
        let rival = |rival: crate::band::rivals::Rival| RivalDocument {
            largest_peak: length(rival.largest),
            mean_peak: length(rival.mean),
        };
        let (at, share) = survey.smallest_gap;
        let zone = |zone: &Stretch<crate::analysis::Zone>| ZoneDocument {
            from: zone.from,
            to: zone.to,
            area: zone.of.area,
            strip: zone.of.strip,
        };
        Self {
            over: match survey.band.over {
                BandOver::Frequency => "frequency",
                BandOver::Amplitude => "amplitude",
            },
            range: survey.band.range,
            z3_share: survey.z3_share(),
            a1_share: survey.strip_share(Strip::A1),
            a2_share: survey.strip_share(Strip::A2),
            zones: survey.zones.iter().map(zone).collect(),
            stable_share: survey.stable_share(),
            stability: survey.stability.clone(),
            stable_orbit: survey.orbit.map(|orbit| PeaksDocument {
                largest_peak: length(orbit.largest),
                at: orbit.at,
                mean_peak: length(orbit.mean),
            }),
            bare: rival(survey.bare),
            tuned_mass_damper: rival(survey.damper),
            smallest_gap: GapDocument { share, at },
            simulated: survey
                .simulated
                .iter()
                .map(|place| {
                    let peaks = || place.motions.iter().map(|motion| motion.peak);
                    PlaceDocument {
                        at: place.at,
                        motions: place.motions.len(),
                        asleep: place.sleeps(),
                        largest_peak: length(peaks().fold(f64::NAN, f64::max)),
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
        let survey = self.survey;
        let theory = "theory, closed form";
        let mut rows = vec![
            row("Share in area Z3", percent(survey.z3_share()), theory),
            row("of it in strip A1 (hysteresis)", percent(survey.strip_share(Strip::A1)), theory),
            row("of it in strip A2 (beats)", percent(survey.strip_share(Strip::A2)), theory),
            row("Share with a stable 1:1 orbit", percent(survey.stable_share()), "exact orbits"),
        ];
        if let Some(found) = survey.orbit {
            let largest = format!("{} at {}", self.length(found.largest), self.place(found.at));
            rows.push(row("Largest peak, stable 1:1 orbit", largest, "exact orbits"));
            let mean = self.length(found.mean);
            rows.push(row("Average of that peak where it is stable", mean, "exact orbits"));
        }
        if let Some((at, motion)) = self.largest_simulated() {
            let words = format!(
                "{} at {}, z = {}",
                self.length(motion.peak),
                self.place(at),
                super::numbers::significant(motion.impacts_per_period, 3)
            );
            rows.push(row("Largest peak, any motion", words, "simulation"));
        }
        let damper = TunedMassDamper::best(survey.band.base.mass_ratio());
        let tuned = format!(
            "closed form, Den Hartog: tuned to {}, damping ratio {}",
            self.units.frequency_text(damper.tuning),
            percent(damper.damping_ratio)
        );
        for (name, rival, from) in [
            ("bare oscillator", survey.bare, "closed form"),
            ("tuned mass damper of the same mass", survey.damper, tuned.as_str()),
        ] {
            let words =
                format!("{}, on average {}", self.length(rival.largest), self.length(rival.mean));
            rows.push(row(&format!("Largest peak, {name}"), words, from));
        }
        rows.push(row("Smallest gap to a boundary", self.gap(), "exact orbits"));
        if !survey.simulated.is_empty() {
            let several = self.simulated_places(Place::has_several);
            rows.push(row("Several motions with impacts", several, "simulation"));
            let sleeps = self.simulated_places(Place::sleeps);
            rows.push(row("From rest the absorber never wakes", sleeps, "simulation"));
        }
        table([("Quantity", false), ("Value", true), ("From", false)], rows)
    }

    fn zones(&self) -> Table {
        let rows =
            self.survey.zones.iter().map(|zone| {
                [self.place(zone.from), self.place(zone.to), zone.of.words().to_owned()]
            });
        table([("From", true), ("To", true), ("Area by theory", false)], rows.collect())
    }

    fn largest_simulated(&self) -> Option<(f64, Motion)> {
        let places = self.survey.simulated.iter();
        let largest = places.filter_map(|place| Some((place.at, *place.largest()?)));
        largest.max_by(|a, b| a.1.peak.total_cmp(&b.1.peak))
    }

    fn gap(&self) -> String {
        let (at, gap) = self.survey.smallest_gap;
        if gap > 0.0 {
            format!("{} of the clearance, at {}", percent(gap), self.place(at))
        } else {
            format!("none: no stable 1:1 orbit at {}", self.place(at))
        }
    }

    /// The simulated places at which something holds.
    fn simulated_places(&self, holds: impl Fn(&Place) -> bool) -> String {
        let places = &self.survey.simulated;
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
        self.units.band_text(self.survey.band.over, at)
    }
}

fn row(quantity: &str, value: String, from: &str) -> [String; 3] {
    [quantity.to_owned(), value, from.to_owned()]
}
