//! The answer: what an engineer wants to know first, as data.

use serde::Serialize;

use super::NOTICEABLE;
use super::criteria::{Badge, CriteriaFacts};
use crate::regimes::{FoundAttractor, Regime};
use crate::study::CaseStudy;

/// Whether the news is good.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Tone {
    /// The criteria hold, or without any the absorber reduces the vibration.
    Good,
    /// Something between.
    Mixed,
    /// A criterion fails, or the absorber does not help.
    Bad,
}

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
    /// The absorber does not move.
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

/// Why an absorber that moves makes things worse.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Reason {
    /// Below resonance the moving mass lowers the resonance towards the excitation.
    LowersResonance,
    /// Between captures the oscillator grows past its own steady vibration.
    GrowsBetweenCaptures,
    /// The oscillator alone vibrates little there.
    LittleAlone,
}

/// The answer.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Verdict {
    /// Good, mixed or bad.
    pub tone: Tone,
    /// What the criteria came to; none without criteria.
    pub badge: Option<Badge>,
    /// At the case's own excitation.
    pub headline: Headline,
    /// Along the band; none without one, or where nothing was found.
    pub band: Option<Headline>,
    /// Why it is worse.
    pub reason: Option<Reason>,
    /// Claims that were confirmed.
    pub confirmed: usize,
}

impl Verdict {
    /// That of a study and its criteria.
    pub fn of(study: &CaseStudy, criteria: Option<&CriteriaFacts>) -> Self {
        use crate::validation::Verdict::Confirmed;
        let headline = headline(study);
        let band = along_band(study);
        let badge = criteria.map(|criteria| criteria.badge);
        let tone = match badge {
            Some(Badge::Holds) => Tone::Good,
            Some(Badge::Fails) => Tone::Bad,
            Some(Badge::TooCloseToCall) => Tone::Mixed,
            None => band.map_or_else(|| tone(study, headline), Headline::tone),
        };
        let main = study.main_attractor();
        Self {
            tone,
            badge,
            headline,
            band,
            reason: main
                .filter(|_| headline == Headline::Worse)
                .and_then(|main| reason(study, main)),
            confirmed: study.claims.iter().filter(|claim| claim.verdict == Confirmed).count(),
        }
    }
}

impl Headline {
    fn tone(self) -> Tone {
        match self {
            Self::Less => Tone::Good,
            Self::NoMotion | Self::AtRest | Self::Worse => Tone::Bad,
            _ => Tone::Mixed,
        }
    }
}

/// A smaller vibration is only good news where it is steady 1:1 resonance that starts were seen to end in.
fn tone(study: &CaseStudy, headline: Headline) -> Tone {
    let steady = study.main_attractor().is_some_and(|main| main.regime() == Regime::TwoSymmetric);
    match headline {
        Headline::UnlimitedWithout if steady => Tone::Good,
        Headline::Less if !steady => Tone::Mixed,
        other => other.tone(),
    }
}

fn headline(study: &CaseStudy) -> Headline {
    if study.analysis.system.forcing_per_clearance() == 0.0 {
        return Headline::NothingDrives;
    }
    let bare = study.rivals.bare.1;
    let without_simulation = || {
        let orbit = study.exact.attracting().map(|orbit| orbit.peaks.displacement);
        let point = study.analysis.stable_points().last().map(|point| point.oscillator_amplitude);
        orbit.or(point)
    };
    let Some(main) = study.main_attractor() else {
        return match without_simulation().filter(|_| !study.simulated) {
            Some(peak) if bare.is_finite() => compared(peak / bare),
            Some(_) => Headline::UnlimitedWithout,
            None => Headline::NoMotion,
        };
    };
    if !bare.is_finite() {
        return Headline::UnlimitedWithout;
    }
    if main.regime() == Regime::AtRest {
        return Headline::AtRest;
    }
    let peak = main.attractor.peak / bare;
    let rms = main.attractor.rms / (bare * std::f64::consts::FRAC_1_SQRT_2);
    match (compared(peak), compared(rms)) {
        (Headline::Worse, Headline::Less) => Headline::HigherPeaks,
        (Headline::Little, Headline::Less) => Headline::LessOnAverage,
        (found, _) => found,
    }
}

/// Along the band, by the worst motion with its error.
fn along_band(study: &CaseStudy) -> Option<Headline> {
    let survey = study.band.as_ref()?;
    let Some(worst) = survey.motions.worst() else { return Some(Headline::NoMotion) };
    let bare = survey.rivals.bare.1;
    if !bare.is_finite() {
        return Some(Headline::UnlimitedWithout);
    }
    Some(compared((worst.peak + worst.error) / bare))
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

fn reason(study: &CaseStudy, main: &FoundAttractor) -> Option<Reason> {
    let below = study.analysis.system.frequency_ratio() < 1.0;
    match main.regime() {
        Regime::TwoSymmetric | Regime::TwoAsymmetric | Regime::AboveTwo if below => {
            Some(Reason::LowersResonance)
        }
        Regime::StronglyModulated => Some(Reason::GrowsBetweenCaptures),
        Regime::BelowTwo => None,
        _ => Some(Reason::LittleAlone),
    }
}
