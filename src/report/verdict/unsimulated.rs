//! The verdict of a report for which nothing was simulated: what the stable exact orbit, or else the
//! stable fixed point, says.

use super::{NOTICEABLE, Tone, Verdict, Writer};
use crate::report::layers;
use crate::report::numbers::{decibels, significant};

/// What the limits are limits of, where no start was followed.
const LIMITS_OF_THE_MOTION: &str =
    " These are limits of the stable motion; the starts that lead to it may run out earlier.";

impl Writer<'_> {
    /// Headline and sentences without any simulated motion; `None` where theory and orbits have no
    /// stable motion either.
    pub(super) fn unsimulated(&self) -> Option<Verdict> {
        let bare = self.bare()?;
        let (peak, what) = match self.study.exact.attracting() {
            Some(orbit) => (
                orbit.peaks.displacement,
                format!(
                    "Two symmetric impacts per period, by an exact orbit that is stable and admissible (largest multiplier {} per half period)",
                    significant(orbit.orbit.multipliers.spectral_radius(), 3)
                ),
            ),
            None => (
                self.study.analysis.stable_points().last()?.oscillator_amplitude,
                "Two symmetric impacts per period, by a stable fixed point of the slow flow that no exact orbit confirms".into(),
            ),
        };
        let ratio = peak / bare;
        let change =
            format!("{} instead of {} ({})", self.length(peak), self.length(bare), decibels(ratio));
        let (tone, headline) = if ratio > 1.0 + NOTICEABLE {
            (
                Tone::Bad,
                format!("A stable 1:1 resonance exists, but it makes things worse: {change}."),
            )
        } else if ratio > 1.0 - NOTICEABLE {
            (
                Tone::Mixed,
                format!("A stable 1:1 resonance exists, but it changes little: {change}."),
            )
        } else {
            let text =
                format!("A stable 1:1 resonance exists. If it is reached, vibration {change}.");
            (Tone::Mixed, text)
        };
        let standing =
            format!("{what}; area {:?} by {}.", self.study.area.area, self.study.area.by.words());
        let sentences = [
            Some(standing),
            Some(layers::unlooked()),
            self.clearance().map(|limits| limits + LIMITS_OF_THE_MOTION),
            self.forcing_and_frequency(),
            self.theory_error(),
        ];
        Some(Verdict { tone, headline, sentences: sentences.into_iter().flatten().collect() })
    }
}
