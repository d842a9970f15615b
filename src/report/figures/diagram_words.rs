//! What a bifurcation diagram says in words.

use crate::report::numbers::significant;
use crate::study::diagrams::{EFFORT, Hysteresis, STEPS};
use crate::study::exact_branches::Stretch;

use super::diagram::Shown;

/// Hysteresis is told for so many places.
const MOST_TOLD: usize = 3;

impl Shown<'_> {
    pub(super) fn words(&self) -> (String, String) {
        let noun = self.diagram.parameter.words();
        let [first, last] = self.diagram.range.map(|value| self.text(value));
        let method = format!(
            "The {noun} was swept from {first} to {last} and back in {STEPS} steps, each going on from the one before. \
             At each of them the transient was left out; a motion that does not repeat was measured over {} periods.",
            EFFORT.periods
        );
        let hysteresis = match &self.diagram.hysteresis[..] {
            [] => "Up and down end in the same motions: no hysteresis was found in steps of this size.".to_owned(),
            found => {
                let told = found.iter().take(MOST_TOLD).map(|one| self.branches_in(one));
                let all = told.collect::<Vec<String>>().join("; and ");
                let more = match found.len().saturating_sub(MOST_TOLD) {
                    0 => String::new(),
                    1 => "; and in one more place".into(),
                    count => format!("; and in {count} more places"),
                };
                format!("Hysteresis {all}{more}.")
            }
        };
        let caption = format!("{hysteresis} {} {} {method}", self.exact(), self.agreement());
        let alt = format!(
            "Above, the oscillator's peak in each period over the {noun}, simulated upwards (dots) and downwards (squares), with \
             exact orbits as lines; below, the times between impacts, which part where symmetry breaks. {caption}"
        );
        (caption, alt)
    }

    fn branches_in(&self, one: &Hysteresis) -> String {
        let [first, last] = one.values.map(|value| self.text(value));
        let [up, down] = one.regimes.map(|regime| regime.words());
        let [high, low] = one.peaks.map(|peak| self.units.length_text(peak));
        format!(
            "from {first} to {last}: {up} (peak {high}) on the way up, {down} (peak {low}) on the way down"
        )
    }

    fn exact(&self) -> String {
        let end = |stretch: &Stretch, k: usize| match stretch.ends[k] {
            Some(kind) => format!("{} ({})", self.text(stretch.values[k]), kind.words()),
            None => self.text(stretch.values[k]),
        };
        let stretches = self.diagram.exact.attracting_stretches();
        let all: Vec<String> = stretches
            .iter()
            .map(|one| format!("from {} to {}", end(one, 0), end(one, 1)))
            .collect();
        format!("The exact symmetric orbit attracts {}.", all.join(" and "))
    }

    fn agreement(&self) -> String {
        let Some(found) = self.diagram.agreement else {
            return "No simulated motion with impacts repeats every period.".to_owned();
        };
        let others = match found.without_orbit {
            0 => String::new(),
            1 => " (one more is on a branch that is not drawn)".into(),
            count => format!(" ({count} more are on branches that are not drawn)"),
        };
        format!(
            "{} simulated motions that repeat every period have the peak of an attracting exact orbit{others}; they differ by at \
             most {} of it, at {}.",
            found.compared,
            significant(found.largest, 2),
            self.text(found.at)
        )
    }
}
