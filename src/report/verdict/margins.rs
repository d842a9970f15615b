//! How far the design is from where its motion changes: by the exact orbits, with what theory says
//! of the same limits and what simulation makes of them.

use super::{NOTICEABLE, Writer, extent, relative};
use crate::orbits::{Bifurcation, StableStretch};
use crate::regimes::Regime;
use crate::report::numbers::{decibels, percent, significant};
use crate::study::margins::{ExactMargin, ExactMargins};
use crate::validation::AsymptoticError;

impl Writer<'_> {
    /// Both ways in clearance, or where a steady motion would be.
    pub(super) fn clearance(&self) -> Option<String> {
        self.study.exact.boundaries.as_ref()?;
        let Some(margins) = self.study.margins.exact else {
            return Some(self.elsewhere(self.study.exact.stable_stretches()));
        };
        let [below, above] = margins.clearance;
        let describe = |margin: ExactMargin, way: &str| {
            format!(
                "{way} {} (to {}) {}",
                extent(margin.factor),
                self.length(margin.factor),
                ending(margin.kind)
            )
        };
        let both: Vec<String> = above
            .map(|margin| describe(margin, "grow"))
            .into_iter()
            .chain(below.map(|margin| describe(margin, "shrink")))
            .collect();
        if both.is_empty() {
            return None;
        }
        let theory = self
            .theory_on_limits(&margins)
            .map_or_else(String::new, |text| format!(" Leading-order theory puts {text}."));
        Some(format!("Clearance can {}.{theory}", both.join(", and ")))
    }

    /// Where theory has the limits of the case's own stretch, and how far off it is.
    fn theory_on_limits(&self, margins: &ExactMargins) -> Option<String> {
        let [below, above] = margins.clearance;
        let side = |margin: Option<ExactMargin>, name: &str| {
            let margin = margin?;
            let same = |price: &&AsymptoticError| price.exact == Some(margin.factor);
            let price = self.study.asymptotic_errors.iter().find(same)?;
            let (at, difference) = (price.theory?, price.difference?);
            Some(format!("the {name} limit at {} ({})", self.length(at), off(difference)))
        };
        let both: Vec<String> =
            side(above, "upper").into_iter().chain(side(below, "lower")).collect();
        (!both.is_empty()).then(|| both.join(" and "))
    }

    fn elsewhere(&self, stretches: &[StableStretch]) -> String {
        let listed: Vec<String> = stretches
            .iter()
            .map(|stretch| {
                let [from, to] = stretch.clearance;
                format!(
                    "from {} ({}) to {} ({})",
                    self.length(from),
                    relative(from),
                    self.length(to),
                    relative(to)
                )
            })
            .collect();
        if listed.is_empty() {
            "At this frequency and forcing no clearance has a stable symmetric 1:1 orbit.".into()
        } else {
            format!(
                "Stable symmetric 1:1 orbits exist for clearances {}, at this frequency and forcing.",
                listed.join(" and ")
            )
        }
    }

    pub(super) fn forcing_and_frequency(&self) -> Option<String> {
        let margins = self.study.margins.exact?;
        let change =
            |margin: ExactMargin| format!("{} ({})", relative(margin.factor), margin.kind.words());
        let hertz = |margin: ExactMargin| {
            let ratio = margin.factor * self.study.analysis.system.frequency_ratio();
            match self.case.scales().frequency_hz(ratio) {
                Some(hertz) => format!("{} Hz ({})", significant(hertz, 4), margin.kind.words()),
                None => format!("Ω = {} ({})", significant(ratio, 4), margin.kind.words()),
            }
        };
        let joined = |words: Vec<String>| (!words.is_empty()).then(|| words.join(" and "));
        let forcing = joined(margins.forcing().into_iter().flatten().map(change).collect());
        let frequency = joined(margins.frequency.into_iter().flatten().map(hertz).collect());
        match (forcing, frequency) {
            (None, None) => None,
            (Some(forcing), None) => Some(format!("The same limits in forcing: {forcing}.")),
            (None, Some(frequency)) => Some(format!("Limits in frequency: {frequency}.")),
            (Some(forcing), Some(frequency)) => {
                Some(format!("The same limits in forcing: {forcing}; in frequency: {frequency}."))
            }
        }
    }

    /// What simulation from several starts says of the upper limit in clearance.
    pub(super) fn simulated_limit(&self) -> Option<String> {
        let limit = self.study.confirmations.upper_limit?;
        let other = limit.lost.other.map_or("another motion", Regime::words);
        let way = if limit.kept > 1.0 {
            format!(
                "all starts keep 1:1 resonance up to {} ({})",
                self.length(limit.kept),
                relative(limit.kept)
            )
        } else {
            "no larger clearance keeps 1:1 resonance from all starts".into()
        };
        Some(format!(
            "Not every start finds the stable motion that far: simulated from {} each, {way}; at {} some end in {other} (peak {}).",
            limit.lost.starts,
            self.length(limit.lost.factor),
            self.length(limit.lost.other_peak),
        ))
    }

    /// Where the exact orbit vibrates least, and how many starts find it there.
    pub(super) fn best_clearance(&self) -> Option<String> {
        let bare = self.bare()?;
        let best = self.study.margins.best_clearance?;
        let at = self.length(best.factor);
        let peak = self.length(best.peak);
        let change = decibels(best.peak / bare);
        if best.peak > bare * (1.0 - NOTICEABLE) {
            return Some(format!(
                "No clearance with steady 1:1 resonance reduces the vibration at this frequency and forcing; the best is near {at} ({peak}, {change} against the bare oscillator)."
            ));
        }
        let found = self.study.confirmations.best?;
        let outcome = match found.steady {
            0 => format!("but none of {} simulated starts ends in it", found.starts),
            some => format!("found by {some} of {} simulated starts", found.starts),
        };
        Some(format!(
            "Best clearance for steady 1:1 resonance at this frequency and forcing: near {at}, {peak} ({change}), {outcome}{}.",
            self.room_at(best.factor)
        ))
    }

    /// How near the best clearance is to where the exact orbit ends, if it is too near for a design.
    fn room_at(&self, factor: f64) -> String {
        let stretches = self.study.exact.stable_stretches().iter();
        let ends = stretches.flat_map(|stretch| stretch.clearance);
        let rooms = ends.map(|end| (end / factor - 1.0).abs());
        match rooms.min_by(f64::total_cmp) {
            Some(room) if room < TOO_NEAR => {
                format!("; the margin is {}, too small for a design", percent(room))
            }
            _ => String::new(),
        }
    }
}

/// Share of a clearance within which the end of steady resonance is too near for a design.
const TOO_NEAR: f64 = 0.1;

/// What a steady motion turns into.
fn ending(kind: Bifurcation) -> &'static str {
    match kind {
        Bifurcation::SymmetryBreaking => "before the impacts turn asymmetric (symmetry breaking)",
        Bifurcation::NeimarkSacker => "before the response becomes modulated (Neimark–Sacker)",
        Bifurcation::SaddleNode => "before 1:1 resonance ends (saddle-node)",
        Bifurcation::Grazing => "before a further impact appears (grazing)",
        Bifurcation::Sticking => {
            "before the absorber rests on the wall after each impact (sticking)"
        }
        Bifurcation::PeriodDoubling => "before the motion doubles its period (period doubling)",
        Bifurcation::VanishingImpact => "before an impact disappears",
        Bifurcation::BranchPoint => "before the motion gives way to another (branch point)",
    }
}

fn off(difference: f64) -> String {
    let way = if difference > 0.0 { "too high" } else { "too low" };
    format!("{} {way}", percent(difference.abs()))
}
