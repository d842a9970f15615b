//! The verdict of a band: its worst place, not the one excitation that the case also has.

use super::{NOTICEABLE, Tone, Verdict};
use crate::band::Survey;
use crate::band::simulated::Place;
use crate::case::{BandOver, Case};
use crate::report::numbers::{decibels, percent};
use crate::report::units::Units;

/// Share of a band from which on it is all of it, but for rounding.
const ALL: f64 = 1.0 - 1e-9;

/// Puts what holds along the band first, and what holds at the case's own excitation after it.
pub(super) fn verdict(case: &Case, survey: &Survey, own: Verdict) -> Verdict {
    let units = Units::of(case);
    let place = |at: f64| units.band_text(survey.band.over, at);
    let [from, to] = survey.band.range;
    let stable = survey.stable_share();
    let (tone, vibration) = match survey.largest() {
        None => (Tone::Mixed, "no steady motion was found, and nothing was simulated".to_owned()),
        Some((at, peak)) => {
            let bare = survey.bare.largest;
            let worst = format!("vibration up to {} at {}", units.length_text(peak), place(at));
            if bare.is_finite() {
                let change = decibels(peak / bare);
                let bare = units.length_text(bare);
                let tone = match peak / survey.bare.largest {
                    worse if worse > 1.0 + NOTICEABLE => Tone::Bad,
                    less if less < 1.0 - NOTICEABLE && stable > ALL => Tone::Good,
                    _ => Tone::Mixed,
                };
                (tone, format!("{worst}, instead of up to {bare} without absorber ({change})"))
            } else {
                (Tone::Mixed, format!("{worst}; without absorber nothing limits it"))
            }
        }
    };
    let headline = format!(
        "From {} to {}: {vibration}; a stable 1:1 orbit over {} of the band.",
        place(from),
        place(to),
        percent(stable)
    );
    let excitation = match survey.band.over {
        BandOver::Frequency => units.frequency_text(survey.band.base.frequency_ratio()),
        BandOver::Amplitude => units.forcing_text(1.0),
    };
    let mut sentences =
        vec![format!("At {excitation}, the case's own excitation: {}", own.headline)];
    let asleep = survey.simulated.iter().filter(|place| Place::sleeps(place)).count();
    if asleep > 0 {
        sentences.push(format!(
            "From rest the absorber never wakes at {asleep} of {} simulated places of the band.",
            survey.simulated.len()
        ));
    }
    sentences.extend(own.sentences);
    Verdict { tone, headline, sentences }
}
