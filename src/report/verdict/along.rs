//! The verdict of a band: its worst place, not the one excitation that the case also has.

use super::{NOTICEABLE, Tone, Verdict};
use crate::band::Survey;
use crate::case::{BandOver, Case};
use crate::report::numbers::{decibels, percent};
use crate::report::units::Units;

/// Puts what holds along the band first, and what holds at the case's own excitation after it.
pub(super) fn verdict(case: &Case, survey: &Survey, own: Verdict) -> Verdict {
    let units = Units::of(case);
    let (band, motions) = (survey.band(), &survey.motions);
    let place = |at: f64| units.band_text(band.over, at);
    let length = |over: f64| units.length_text(over);
    let [from, to] = band.range;
    let bare = survey.rivals.bare.1;
    let (tone, vibration) = match motions.worst() {
        None => (Tone::Mixed, "no steady motion was found, and nothing was simulated".to_owned()),
        Some(worst) => {
            let peak = units.length_with_error(worst.peak, worst.error);
            let up_to = format!("vibration up to {peak} at {}", place(worst.at));
            if bare.is_finite() {
                let change = decibels(worst.peak / bare);
                let tone = match (worst.peak + worst.error) / bare {
                    worse if worse > 1.0 + NOTICEABLE => Tone::Bad,
                    less if less < 1.0 - NOTICEABLE => Tone::Good,
                    _ => Tone::Mixed,
                };
                let bare = length(bare);
                (tone, format!("{up_to}, instead of up to {bare} without absorber ({change})"))
            } else {
                (Tone::Mixed, format!("{up_to}; without absorber nothing limits it"))
            }
        }
    };
    let damped = survey.rivals.damped;
    let headline = format!(
        "From {} to {}: {vibration}; a tuned mass damper of the same mass has up to {}.",
        place(from),
        place(to),
        length(damped.amplitude),
    );
    let mut sentences = Vec::new();
    if let Some((at, inactive)) = motions.inactive {
        let counted = match motions.count_inactive {
            true => "",
            false => " This motion is not counted (count_inactive = false).",
        };
        sentences.push(format!(
            "From rest the absorber may never wake: the structure then has up to {}, at {} from {} of the resting places.{counted}",
            length(inactive.amplitude),
            place(at),
            percent(inactive.share)
        ));
    }
    sentences.push(against_damper(survey, &length));
    sentences.push(format!(
        "A stable 1:1 orbit exists over {} of the band.",
        percent(motions.stable_share())
    ));
    let excitation = match band.over {
        BandOver::Frequency => units.frequency_text(band.base.frequency_ratio()),
        BandOver::Amplitude => units.forcing_text(1.0),
    };
    sentences.push(format!("At {excitation}, the case's own excitation: {}", own.headline));
    sentences.extend(own.sentences);
    Verdict { tone, headline, sentences }
}

/// Where the absorber wins against a tuned mass damper, and where it loses.
fn against_damper(survey: &Survey, length: &dyn Fn(f64) -> String) -> String {
    let damped = survey.rivals.damped;
    let stroke = match damped.stroke > 1.0 {
        true => "more than the clearance of the absorber",
        false => "less than the clearance of the absorber",
    };
    let mut text =
        format!("The tuned mass damper needs a stroke of {}, {stroke}.", length(damped.stroke));
    let largest = |worst: crate::band::Worst| worst.peak + worst.error;
    let Some(worst) = survey.motions.worst() else { return text };
    let vibrates_less = |absorber: f64, damper: f64| match absorber < damper {
        true => "absorber",
        false => "tuned mass damper",
    };
    let here = vibrates_less(largest(worst), damped.amplitude);
    let off = survey.detuned.iter().copied().flatten().map(largest).reduce(f64::max);
    let damper = survey.rivals.detuned.map(|one| one.amplitude).into_iter().fold(0.0, f64::max);
    let Some(off) = off else { return format!("{text} The {here} vibrates less.") };
    let there = vibrates_less(off, damper);
    let (absorber, damper) = (length(off), length(damper));
    text += &match here == there {
        true => {
            format!(" The {here} vibrates less, also with the structure's frequency off by 3 %")
        }
        false => format!(
            " The {here} vibrates less, but with the structure's frequency off by 3 % the {there} does"
        ),
    };
    format!("{text} (absorber up to {absorber}, damper up to {damper}).")
}
