//! The answer: what an engineer wants to know first, as data.

use serde::Serialize;
use serde_json::{Value, json};

use super::NOTICEABLE;
use super::criteria::badge;
use super::word::Word;
use crate::analysis::Analysis;
use crate::criteria::Judged;
use crate::motions::{Motion, RestKind};
use crate::regimes::Regime;
use crate::study::CaseStudy;
use crate::validation::Verdict;

/// What the absorber does to the vibration.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Headline {
    /// No start was simulated, and theory and orbits have no stable motion.
    NoMotion,
    /// There is no excitation.
    NothingDrives,
    /// Without the absorber nothing limits the vibration.
    UnlimitedWithout,
    /// Nothing moves the absorber, and the structure vibrates as if alone.
    AtRest,
    /// Higher peaks, less on average.
    HigherPeaks,
    /// Peaks hardly change, less on average.
    LessOnAverage,
    /// More vibration.
    Worse,
    /// Hardly any change.
    Little,
    /// Less vibration.
    Less,
}

/// The answer: good, mixed or bad; in a word, by the criteria or else by what the absorber does; at the case's
/// own excitation; along the band, none without one or where nothing was found; and why it is worse.
pub fn verdict(study: &CaseStudy, judged: &[Judged], count_rest: bool) -> Value {
    let headline = headline(study);
    let band = along_band(study);
    let without = || band.map_or_else(|| word(study, headline, count_rest), Headline::word);
    let word = badge(judged).unwrap_or_else(without);
    let worse = study.motions.main().filter(|_| headline == Headline::Worse);
    let confirmed = study.claims.iter().filter(|claim| claim.verdict == Verdict::Confirmed);
    json!({
        "tone": word.tone(),
        "word": word,
        "headline": headline,
        "band": band,
        "reason": worse.and_then(|main| reason(study, main)),
        // Claims that were confirmed.
        "confirmed": confirmed.count(),
    })
}

impl Headline {
    fn word(self) -> Word {
        match self {
            Self::Less => Word::Works,
            Self::Worse => Word::MakesItWorse,
            Self::Little | Self::AtRest => Word::DoesNothing,
            Self::NoMotion | Self::NothingDrives => Word::NoAnswer,
            Self::UnlimitedWithout | Self::HigherPeaks | Self::LessOnAverage => Word::Mixed,
        }
    }
}

/// A smaller vibration is only good news where it is steady 1:1 resonance that starts were seen to end in, those of an absorber
/// at rest among them.
fn word(study: &CaseStudy, headline: Headline, count_rest: bool) -> Word {
    let steady = study.motions.main().is_some_and(Motion::is_one_to_one);
    let rests = || study.motions.counting(count_rest).any(|(_, one)| one.rest().is_some());
    match headline {
        Headline::UnlimitedWithout if steady => Word::Works,
        Headline::Less if !steady || rests() => Word::Mixed,
        other => other.word(),
    }
}

fn headline(study: &CaseStudy) -> Headline {
    if study.analysis.system.forcing_per_clearance() == 0.0 {
        return Headline::NothingDrives;
    }
    let bare = study.rivals.bare.1;
    let without_simulation =
        || study.exact.attracting_peak().or_else(|| stable_amplitude(&study.analysis));
    let Some(main) = study.motions.main() else {
        return match without_simulation().filter(|_| !study.simulated) {
            Some(peak) if bare.is_finite() => compared(peak / bare),
            Some(_) => Headline::UnlimitedWithout,
            None => Headline::NoMotion,
        };
    };
    if !bare.is_finite() {
        return Headline::UnlimitedWithout;
    }
    if main.rest().is_some_and(|rest| rest.rest == RestKind::Floating) {
        return Headline::AtRest;
    }
    let peak = main.facts().peak.value / bare;
    let rms = main.facts().rms.value / (bare * std::f64::consts::FRAC_1_SQRT_2);
    match (compared(peak), compared(rms)) {
        (Headline::Worse, Headline::Less) => Headline::HigherPeaks,
        (Headline::Little, Headline::Less) => Headline::LessOnAverage,
        (found, _) => found,
    }
}

/// Amplitude of the last stable fixed point of the theory of the case's cavity.
fn stable_amplitude(analysis: &Analysis) -> Option<f64> {
    match &analysis.cavity {
        None => analysis.stable_points().last().map(|point| point.oscillator_amplitude),
        Some(cavity) => cavity.stable_point().map(|point| point.motion.oscillator_amplitude),
    }
}

/// Along the band, by the worst motion with its error.
fn along_band(study: &CaseStudy) -> Option<Headline> {
    let survey = study.band.as_ref()?;
    let Some(worst) = survey.worst() else { return Some(Headline::NoMotion) };
    let bare = survey.bare().1;
    if !bare.is_finite() {
        return Some(Headline::UnlimitedWithout);
    }
    Some(compared((worst.peak.value + worst.peak.error) / bare))
}

fn compared(ratio: f64) -> Headline {
    if ratio > 1.0 + NOTICEABLE {
        Headline::Worse
    } else if ratio > 1.0 - NOTICEABLE {
        Headline::Little
    } else {
        Headline::Less
    }
}

/// Why an absorber that moves makes things worse.
fn reason(study: &CaseStudy, main: &Motion) -> Option<&'static str> {
    let below = study.analysis.system.frequency_ratio() < 1.0;
    match main.regime() {
        // Below resonance the moving mass lowers the resonance towards the excitation.
        Regime::AtRest | Regime::TwoSymmetric | Regime::TwoAsymmetric | Regime::AboveTwo
            if below =>
        {
            Some("lowers-resonance")
        }
        // Between captures the oscillator grows past its own steady vibration.
        Regime::StronglyModulated => Some("grows-between-captures"),
        Regime::AtRest | Regime::BelowTwo => None,
        // The oscillator alone vibrates little there.
        _ => Some("little-alone"),
    }
}
