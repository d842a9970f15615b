//! What an expert should know first, and the limits of steady 1:1 resonance layer by layer.

use serde::Serialize;

use super::boundaries::route;
use super::{CaseReport, CaseSet, PaperError};
use crate::orbits::Bifurcation;
use crate::report::numbers::decibels;

/// The limits of steady 1:1 resonance in clearance at one frequency, in words.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Limit {
    /// The frequency.
    frequency: String,
    /// Symmetry breaking, by the leading-order theory.
    breaking: String,
    /// Where the theory ends it.
    end: String,
    /// Symmetry breaking and the end of stability of the exact orbit.
    exact: String,
    /// Where simulation from several starts does.
    simulated: String,
}

/// Limits at the two frequencies of the paper, from a case in the middle of Z3 each.
pub(super) fn limits(shelf: &CaseSet) -> Result<Vec<Limit>, PaperError> {
    let of = |name: &'static str, frequency: &str| -> Result<Limit, PaperError> {
        let member = shelf.case(name)?;
        let (breaking, hopf, last, branch) = route(member, name)?;
        let end = match branch {
            crate::analysis::Branch::Stable => {
                format!("{} (saddle-node; Hopf {})", member.length(last), member.length(hopf))
            }
            _ => format!("{} (Hopf; saddle-node {})", member.length(hopf), member.length(last)),
        };
        let simulated = match member.study.confirmations.upper_limit {
            Some(limit) => {
                format!("{} to {}", member.length(limit.kept), member.length(limit.lost.factor))
            }
            None => "beyond the theory's".to_owned(),
        };
        let breaking = member.length(breaking);
        let exact = member.study.exact.stretch().map_or_else(
            || "none".to_owned(),
            |stretch| {
                let [from, to] = stretch.clearance;
                let kind = stretch.ends[1].map_or("end of the range", Bifurcation::words);
                format!("{} to {} ({kind})", member.length(from), member.length(to))
            },
        );
        Ok(Limit { frequency: frequency.to_owned(), breaking, end, exact, simulated })
    };
    Ok(vec![of("li2016-8hz-b7p5mm", "8 Hz")?, of("li2016-8p5hz-fig4c", "8.5 Hz")?])
}

/// The findings, each a line.
pub(super) fn findings(shelf: &CaseSet) -> Result<Vec<String>, PaperError> {
    let (below, above) = ("li2016-8hz-b7p5mm", "li2016-8p5hz-fig4c");
    let change = |name: &'static str| -> Result<(&CaseReport, f64, f64), PaperError> {
        let member = shelf.case(name)?;
        let bare = member.study.analysis.system.linear_response();
        let bare = bare.ok_or(PaperError::NoResult { case: name, what: "linear response" })?;
        let main = member.main().ok_or(PaperError::NoResult { case: name, what: "motion" })?;
        Ok((member, main.attractor.peak, bare.amplitude()))
    };
    let (worse, with_8, without_8) = change(below)?;
    let (better, with_85, without_85) = change(above)?;
    Ok(vec![
        format!(
            "**Being in Z3 is not vibrating less.** At 8 Hz and b = {} the absorber works in steady 1:1 resonance and the peak is {} instead of {} ({}); at 8.5 Hz and b = {} it is {} instead of {} ({}).",
            worse.length(1.0),
            worse.length(with_8),
            worse.length(without_8),
            decibels(with_8 / without_8),
            better.length(1.0),
            better.length(with_85),
            better.length(without_85),
            decibels(with_85 / without_85)
        ),
        "**No single forcing amplitude gives all of Fig. 11** in the paper's own model: see [there](#fig-11).".into(),
        "**The vibration is not smallest where 1:1 resonance ends**, as section 3.3 assumes: the minimum comes before, see [Fig. 6](#fig-6).".into(),
        "**An intermediate restitution maximises $E\\sin\\Theta$, but not always $E$**: see [Fig. 9](#fig-9).".into(),
        "**Figs. 11e and 12 differ** at the paper's clearances: the model is steady there; it is strongly modulated at 8.5 Hz, see [Fig. 12](#fig-12).".into(),
    ])
}
