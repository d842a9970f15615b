//! The verdict: what an engineer wants to know first, in a few sentences.

use serde::Serialize;

use super::notes;
use super::numbers::{LengthFormat, decibels, percent, significant};
use crate::analysis::{Area, BoundaryKind, Branch, Strip};
use crate::case::Case;
use crate::regimes::{FoundAttractor, Regime};
use crate::study::CaseStudy;
use crate::study::margins::Margin;
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

/// Writes the verdict of a study.
pub fn verdict(case: &Case, study: &CaseStudy) -> Verdict {
    let writer = Writer { case, study, lengths: LengthFormat::of(&case.scales()) };
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
        writer.reason(main),
        writer.clearance(),
        writer.simulated_limit(),
        writer.forcing_and_frequency(),
        writer.best_clearance(),
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
        if ratio > 1.0 + NOTICEABLE && rms < bare_rms * (1.0 - NOTICEABLE) {
            let text = format!(
                "{regime}: higher peaks, {change}, but less on average, rms {} instead of {} ({}).",
                self.length(rms),
                self.length(bare_rms),
                decibels(rms / bare_rms)
            );
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
            (Tone::Mixed, format!("{regime}. Vibration up to {change}."))
        }
    }

    fn regime(&self, main: &FoundAttractor) -> String {
        let evidence = &main.attractor.classification.evidence;
        // Averages of motions that do not repeat are known to two digits.
        let digits = if evidence.periodicity.is_some() { 3 } else { 2 };
        let z = significant(evidence.impacts_per_period, digits);
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

    /// Regime, area, and how firmly both stand.
    fn standing(&self, main: &FoundAttractor) -> String {
        let area = self.study.area.area;
        let strip = match self.study.analysis.zone.strip {
            Some(Strip::A1) => ", hysteresis strip A1",
            Some(Strip::A2) => ", beat strip A2",
            None => "",
        };
        let confirmed =
            self.study.claims.iter().filter(|claim| claim.verdict == Outcome::Confirmed).count();
        let starts = self.study.effort.starts;
        let late = match main.late_starts {
            0 => String::new(),
            late => {
                let some =
                    if late == main.starts { "all".into() } else { format!("{late} of them") };
                format!(
                    ", {some} only after transients of up to {} periods",
                    main.longest_transient
                )
            }
        };
        let led = match main.starts {
            all if all == starts => format!("all {starts} starts lead to it{late}"),
            0 => "only starts on the predicted motion lead to it".into(),
            some => format!("{some} of {starts} starts lead to it{late}"),
        };
        let criterion = match (area, self.study.analysis.zone.strip) {
            (Area::Z3, Some(Strip::A1)) => "steady 1:1 resonance beside a modulated response",
            (Area::Z3, Some(Strip::A2)) => "1:1 resonance in transient captures only",
            (Area::Z3, None) => "where the paper wants a design to be",
            (Area::Z4, _) => "no 1:1 resonance",
            (Area::Z2, _) => "past symmetry breaking",
            (Area::Z1, _) => "far past symmetry breaking",
        };
        let claims = match self.study.claims.len() {
            0 => "it makes no claim that simulation could decide".into(),
            1 if confirmed == 1 => "its one claim is confirmed by simulation".into(),
            all if all == confirmed => format!("all its {all} claims are confirmed by simulation"),
            all => format!("simulation confirms {confirmed} of its {all} claims"),
        };
        format!(
            "Simulation: {}; {led}. Theory: area {area:?}{strip}, {criterion}; {claims}.",
            main.regime().words(),
        )
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

    fn clearance(&self) -> Option<String> {
        let neighbours = self.study.margins.clearance_neighbours();
        let scales = self.case.scales();
        let describe = |margin: Margin, way: &str| {
            format!(
                "{way} {} (to {}) {}",
                extent(margin.factor),
                self.lengths.text(scales.length(margin.factor)),
                self.consequence(&margin, margin.factor > 1.0)
            )
        };
        let above = neighbours.above.map(|margin| describe(margin, "grow"));
        let below = neighbours.below.map(|margin| describe(margin, "shrink"));
        match (above, below) {
            (None, None) => None,
            (Some(one), None) | (None, Some(one)) => {
                Some(format!("By theory, clearance can {one}."))
            }
            (Some(above), Some(below)) => {
                Some(format!("By theory, clearance can {above}, and {below}."))
            }
        }
    }

    /// What happens where the case meets a boundary, `outwards` in clearance or not.
    fn consequence(&self, margin: &Margin, outwards: bool) -> &'static str {
        match (margin.kind, outwards) {
            (BoundaryKind::SymmetryBreaking, false) => {
                "before the impacts turn asymmetric (symmetry breaking)"
            }
            (BoundaryKind::SymmetryBreaking, true) => {
                "before the impacts turn symmetric (symmetry breaking)"
            }
            (BoundaryKind::Hopf, true) if margin.ends_steady_resonance => {
                "before the response becomes modulated (Hopf)"
            }
            (BoundaryKind::Hopf, true) => "before a modulated response coexists (Hopf)",
            (BoundaryKind::Hopf, false) if margin.ends_steady_resonance => {
                "before steady 1:1 resonance sets in (Hopf)"
            }
            (BoundaryKind::Hopf, false) => "before 1:1 resonance is the only response (Hopf)",
            (BoundaryKind::SaddleNode, true) if margin.branch == Branch::Stable => {
                "before 1:1 resonance ends (saddle-node)"
            }
            (BoundaryKind::SaddleNode, true) => {
                "before no 1:1 resonance is left, not even a transient one (saddle-node)"
            }
            (BoundaryKind::SaddleNode, false) if margin.branch == Branch::Stable => {
                "before 1:1 resonance becomes possible (saddle-node)"
            }
            (BoundaryKind::SaddleNode, false) => {
                "before captures in 1:1 resonance begin (saddle-node)"
            }
        }
    }

    fn forcing_and_frequency(&self) -> Option<String> {
        let forcing = self.study.margins.forcing_neighbours();
        let frequency = self.study.margins.frequency;
        let change =
            |margin: Margin| format!("{} ({})", relative(margin.factor), margin.kind.words());
        let list = |below: Option<Margin>, above: Option<Margin>| {
            let both: Vec<String> = below.into_iter().chain(above).map(change).collect();
            (!both.is_empty()).then(|| both.join(" and "))
        };
        let hertz = |margin: Margin| {
            let system = &self.study.analysis.system;
            let ratio = margin.factor * system.frequency_ratio();
            match self.case.scales().frequency_hz(ratio) {
                Some(hertz) => format!("{} Hz ({})", significant(hertz, 4), margin.kind.words()),
                None => format!("Ω = {} ({})", significant(ratio, 4), margin.kind.words()),
            }
        };
        let in_frequency: Vec<String> =
            frequency.below.into_iter().chain(frequency.above).map(hertz).collect();
        let in_forcing = list(forcing.below, forcing.above);
        match (in_forcing, in_frequency.is_empty()) {
            (None, true) => None,
            (Some(forcing), true) => {
                Some(format!("Nearest boundaries in forcing: {forcing}; none in frequency."))
            }
            (None, false) => {
                Some(format!("Nearest boundaries in frequency: {}.", in_frequency.join(" and ")))
            }
            (Some(forcing), false) => Some(format!(
                "Nearest boundaries in forcing: {forcing}; in frequency: {}.",
                in_frequency.join(" and ")
            )),
        }
    }

    /// What simulation says of the margin that theory gives upwards in clearance.
    fn simulated_limit(&self) -> Option<String> {
        let limit = self.study.confirmations.upper_limit?;
        let at = |factor: f64| self.length(factor);
        let other = limit.lost.other.map_or("another motion", Regime::words);
        let way = if limit.kept > 1.0 {
            format!(
                "all starts keep 1:1 resonance up to {} ({})",
                at(limit.kept),
                relative(limit.kept)
            )
        } else {
            "no larger clearance keeps 1:1 resonance from all starts".into()
        };
        Some(format!(
            "Simulated from {} starts each, {way}; at {} some end in {other} (peak {}).",
            limit.lost.starts,
            at(limit.lost.factor),
            at(limit.lost.other_peak),
        ))
    }

    /// Where theory would put the clearance, and what simulation finds there; not said where the
    /// theory is out of its range.
    fn best_clearance(&self) -> Option<String> {
        if notes::outside_range(&self.study.analysis.system) {
            return None;
        }
        let bare = self.bare()?;
        let Some(best) = self.study.margins.best_clearance else {
            return Some(
                "By theory, no clearance gives steady 1:1 resonance at this frequency and forcing."
                    .into(),
            );
        };
        let found = self.study.confirmations.best?;
        let at = self.length(best.factor);
        if best.amplitude > bare * (1.0 - NOTICEABLE) {
            return Some(format!(
                "No clearance with steady 1:1 resonance reduces the vibration at this frequency and forcing; by theory the best is near {at} ({}, {} against the bare oscillator).",
                self.length(best.amplitude),
                decibels(best.amplitude / bare),
            ));
        }
        let outcome = match found.steady {
            0 => format!("simulated there, none of {} starts ends in 1:1 resonance", found.starts),
            some => format!(
                "simulated there {} ({}), from {some} of {} starts",
                self.length(found.steady_peak),
                decibels(found.steady_peak / bare),
                found.starts
            ),
        };
        Some(format!(
            "Best clearance for steady 1:1 resonance at this frequency and forcing: near {at} by theory; {outcome}."
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
                    (0, Regime::AtRest) => "from a start at rest".into(),
                    (0, _) => "from a start on the predicted motion".into(),
                    _ => format!("{} of the starts", percent(found.share)),
                };
                format!("{} (peak {peak}, {share})", found.regime().words())
            })
            .collect();
        if others.is_empty() {
            return Some("No other long-term motion was found.".into());
        }
        Some(format!("Coexisting answers: {}.", others.join("; ")))
    }

    /// Error of the predicted amplitude, where one was compared.
    fn theory_error(&self) -> Option<String> {
        let claim = self.study.claims.iter().find(|claim| claim.id.ends_with("-C"))?;
        let difference = claim.difference?;
        let way = if difference > 0.0 { "low" } else { "high" };
        Some(format!(
            "Leading-order theory is {} {way} in the amplitude C of this motion.",
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
