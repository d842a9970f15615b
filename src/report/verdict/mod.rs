//! The verdict: what an engineer wants to know first, in a few sentences.

mod along;
mod margins;
mod standing;
mod unsimulated;

use serde::Serialize;

use super::numbers::{LengthFormat, decibels, known_to, percent, significant, with_error};
use crate::band::{Band, Inactive, Rivals};
use crate::case::Case;
use crate::regimes::{DynamicsKind, FoundAttractor, Regime};
use crate::study::CaseStudy;
use crate::validation::Verdict as Outcome;

/// Relative change of the vibration that is worth calling a change.
const NOTICEABLE: f64 = 0.02;
/// Whether the news is good.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Tone {
    /// The absorber reduces the vibration in steady 1:1 resonance.
    Good,
    /// Something between.
    Mixed,
    /// It does not help.
    Bad,
}

/// The answer.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Verdict {
    /// Good, mixed or bad.
    pub tone: Tone,
    /// One or two short sentences.
    pub headline: String,
    /// What follows, a sentence each.
    pub sentences: Vec<String>,
}

/// Writes the verdict of a study: that of the case's band, if it has one, before that of its own
/// excitation.
pub fn verdict(case: &Case, study: &CaseStudy) -> Verdict {
    let own = of_own_excitation(case, study);
    match &study.band {
        Some(survey) => along::verdict(case, survey, own),
        None => own,
    }
}

fn of_own_excitation(case: &Case, study: &CaseStudy) -> Verdict {
    let writer = Writer { case, study, lengths: LengthFormat::of(&case.scales()) };
    if !study.simulated
        && let Some(verdict) = writer.unsimulated()
    {
        return verdict;
    }
    let Some(main) = study.main_attractor() else {
        return Verdict {
            tone: Tone::Bad,
            headline: "No long-term motion was found: no start was simulated.".into(),
            sentences: Vec::new(),
        };
    };
    if study.analysis.system.forcing_per_clearance() == 0.0 {
        return Verdict {
            tone: Tone::Mixed,
            headline: "Nothing drives this case: every vibration dies out or goes on by itself."
                .into(),
            sentences: vec!["Give an excitation amplitude above 0 for a design report.".into()],
        };
    }
    let (tone, headline) = writer.headline(main);
    let sentences = [
        Some(writer.standing(main)),
        writer.inactive(main),
        writer.tuned_mass_damper(),
        writer.reason(main),
        writer.clearance(),
        writer.simulated_limit(),
        writer.forcing_and_frequency(),
        // The best at one excitation is none for a band.
        writer.best_clearance().filter(|_| study.band.is_none()),
        writer.coexistence(main),
        writer.theory_error(),
    ];
    Verdict { tone, headline, sentences: sentences.into_iter().flatten().collect() }
}

struct Writer<'a> {
    case: &'a Case,
    study: &'a CaseStudy,
    lengths: LengthFormat,
}

impl Writer<'_> {
    fn length(&self, over_clearance: f64) -> String {
        self.lengths.text(self.case.scales().length(over_clearance))
    }

    fn bare(&self) -> Option<f64> {
        let amplitude = self.study.analysis.system.linear_response()?.amplitude();
        (amplitude > 0.0).then_some(amplitude)
    }

    fn headline(&self, main: &FoundAttractor) -> (Tone, String) {
        let peak = main.attractor.peak;
        let steady = main.regime() == Regime::TwoSymmetric;
        let regime = self.regime(main);
        let Some(bare) = self.bare() else {
            let text = format!(
                "{regime}. Vibration {}; alone it would have no steady vibration.",
                self.length(peak)
            );
            return (if steady { Tone::Good } else { Tone::Mixed }, text);
        };
        let change = format!(
            "{} instead of {} ({})",
            self.length(peak),
            self.length(bare),
            decibels(peak / bare)
        );
        let ratio = peak / bare;
        if main.regime() == Regime::AtRest {
            let text =
                format!("{regime}: the oscillator vibrates as if alone, {}.", self.length(peak));
            return (Tone::Bad, text);
        }
        // A modulated vibration may peak higher and still be smaller on average.
        let rms = main.attractor.rms;
        let bare_rms = bare * std::f64::consts::FRAC_1_SQRT_2;
        let average = format!(
            "rms {}{} instead of {} ({})",
            self.length(rms),
            main.attractor.errors.map_or_else(String::new, |[error, _]| known_to(error / rms)),
            self.length(bare_rms),
            decibels(rms / bare_rms)
        );
        let less = rms < bare_rms * (1.0 - NOTICEABLE);
        if ratio > 1.0 + NOTICEABLE && less {
            let text = format!("{regime}: higher peaks, {change}, but less on average, {average}.");
            (Tone::Mixed, text)
        } else if ratio > 1.0 - NOTICEABLE && less {
            let text =
                format!("{regime}: less on average, {average}; peaks hardly change, {change}.");
            (Tone::Mixed, text)
        } else if ratio > 1.0 + NOTICEABLE {
            let joint = if steady { ", but the" } else { ". The" };
            (Tone::Bad, format!("{regime}{joint} absorber makes it worse: {change}."))
        } else if ratio > 1.0 - NOTICEABLE {
            let joint = if steady { ", but it" } else { ". It" };
            (Tone::Mixed, format!("{regime}{joint} changes little: {change}."))
        } else if steady {
            (Tone::Good, format!("{regime}: the absorber works. Vibration {change}."))
        } else {
            (Tone::Mixed, format!("{regime}. Vibration up to {change}, {average}."))
        }
    }

    /// The motion of an absorber that a start from rest never wakes.
    fn inactive(&self, main: &FoundAttractor) -> Option<String> {
        let inactive = Inactive::of(&self.study.analysis.system)?;
        if main.regime() == Regime::AtRest {
            return None;
        }
        let counted = match (self.case.criteria.is_empty(), self.case.count_inactive) {
            (false, false) => " The criteria do not count it (count_inactive = false).",
            _ => "",
        };
        Some(format!(
            "An absorber that rests within {} of the middle of its cavity, {} of its resting places, does not wake when the vibration starts from rest: then {}.{counted}",
            self.length(inactive.share),
            percent(inactive.share),
            self.length(inactive.amplitude)
        ))
    }

    /// What a tuned mass damper of the same mass does at a single excitation.
    fn tuned_mass_damper(&self) -> Option<String> {
        if self.study.band.is_some() {
            return None;
        }
        let rivals = Rivals::along(&Band::point(&self.study.analysis.system));
        Some(format!(
            "A tuned mass damper of the same mass (Den Hartog) has {} here, with a stroke of {}.",
            self.length(rivals.damped.amplitude),
            self.length(rivals.damped.stroke)
        ))
    }

    fn regime(&self, main: &FoundAttractor) -> String {
        let evidence = &main.attractor.classification.evidence;
        let z = match main.attractor.errors {
            Some([_, error]) if error > 0.0 && error.is_finite() => {
                with_error(evidence.impacts_per_period, error)
            }
            _ => significant(evidence.impacts_per_period, 3),
        };
        match main.regime() {
            Regime::AboveTwo if self.resting_share(main) > 0.0 => format!(
                "Chattering: impacts crowd in until the absorber rests on a wall, {} of the time",
                percent(self.resting_share(main))
            ),
            Regime::TwoSymmetric => "Steady 1:1 resonance".into(),
            Regime::TwoAsymmetric => "Two asymmetric impacts per period".into(),
            Regime::AboveTwo => format!("More than two impacts per period (z = {z})"),
            Regime::StronglyModulated => format!("Strongly modulated response (z = {z})"),
            Regime::BelowTwo => format!("Fewer than two impacts per period (z = {z})"),
            Regime::AtRest => "The absorber rests".into(),
        }
    }

    /// Share of the time in sustained contact.
    fn resting_share(&self, main: &FoundAttractor) -> f64 {
        let attractor = &main.attractor;
        let duration = attractor.periods.max(1) as f64 * self.study.analysis.system.period();
        attractor.sustained_contact.duration_tau / duration
    }

    /// Why an absorber that works may still make things worse.
    fn reason(&self, main: &FoundAttractor) -> Option<String> {
        let bare = self.bare()?;
        if main.attractor.peak <= bare * (1.0 + NOTICEABLE) || main.regime() == Regime::AtRest {
            return None;
        }
        let offset = self.study.analysis.system.frequency_ratio() - 1.0;
        let side = if offset < 0.0 { "below" } else { "above" };
        let why = match main.regime() {
            Regime::TwoSymmetric | Regime::TwoAsymmetric | Regime::AboveTwo if offset < 0.0 => {
                "where the moving mass lowers the resonance towards the excitation"
            }
            Regime::StronglyModulated => {
                "and between captures the oscillator grows past its own steady vibration"
            }
            Regime::BelowTwo => return None,
            _ => "where the oscillator alone already vibrates little",
        };
        Some(format!(
            "The excitation lies {} {side} the oscillator's natural frequency, {why}.",
            percent(offset.abs())
        ))
    }

    fn coexistence(&self, main: &FoundAttractor) -> Option<String> {
        let others: Vec<String> = self
            .study
            .attractors
            .iter()
            .filter(|found| !std::ptr::eq(*found, main))
            .map(|found| {
                let peak = self.length(found.attractor.peak);
                let share = match (found.starts, found.regime()) {
                    (0, Regime::AtRest) if found.attractor.keeps_its_start() => {
                        "from a start at rest; undamped, so its peak depends on the start".into()
                    }
                    (0, Regime::AtRest) => "from a start at rest".into(),
                    (0, _) => "from a start on the predicted motion".into(),
                    _ => format!("{} of the starts", percent(found.share)),
                };
                let dynamics = match found.attractor.classification.dynamics {
                    DynamicsKind::AtRest | DynamicsKind::Periodic { .. } => String::new(),
                    other => format!("{}, ", other.words()),
                };
                format!("{} ({dynamics}peak {peak}, {share})", found.regime().words())
            })
            .collect();
        if others.is_empty() {
            return Some("No other long-term motion was found.".into());
        }
        Some(format!("Coexisting answers: {}.", others.join("; ")))
    }

    /// Error of the predicted amplitude of the stable motion, where an exact orbit tells it.
    fn theory_error(&self) -> Option<String> {
        let points = &self.study.analysis.fixed_points;
        let number = points.iter().rposition(|point| point.stable)? + 1;
        let id = format!("fixed-point-{number}-C");
        let difference = self.study.claims.iter().find(|claim| claim.id == id)?.difference?;
        let way = if difference < 0.0 { "low" } else { "high" };
        Some(format!(
            "Leading-order theory is {} {way} in the amplitude C of the steady motion.",
            percent(difference.abs())
        ))
    }
}

/// By how much a quantity grows or shrinks by a factor, in words.
fn extent(factor: f64) -> String {
    match factor {
        f if f >= MANY_FOLD => format!("{}-fold", significant(f, 2)),
        f if f <= 1.0 / MANY_FOLD => format!("to one part in {}", significant(1.0 / f, 2)),
        f => format!("by {}", percent((f - 1.0).abs())),
    }
}

/// The same with a sign, for lists and tables.
pub fn relative(factor: f64) -> String {
    match factor {
        f if f >= MANY_FOLD => format!("× {}", significant(f, 2)),
        f if f <= 1.0 / MANY_FOLD => format!("÷ {}", significant(1.0 / f, 2)),
        f if f >= 1.0 => format!("+{}", percent(f - 1.0)),
        f => format!("\u{2212}{}", percent(1.0 - f)),
    }
}

/// Factor from which people say "ten-fold" instead of "900 % more".
const MANY_FOLD: f64 = 10.0;
