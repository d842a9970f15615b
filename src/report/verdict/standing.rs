//! How firmly the verdict stands: what kind of motion it is, what proves it, from how many starts.

use super::{Outcome, Writer};
use crate::analysis::{Area, Strip};
use crate::regimes::{DynamicsKind, FoundAttractor, Regime};
use crate::report::motion_tables::text_of;
use crate::report::numbers::{capitalised, significant};

impl Writer<'_> {
    /// Regime, area, and how firmly both stand.
    pub(super) fn standing(&self, main: &FoundAttractor) -> String {
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
            0 => "it makes no claim that could be checked".into(),
            1 if confirmed == 1 => "the one claim that could be checked is confirmed".into(),
            all if all == confirmed => {
                format!("all {all} claims of theory and orbits are confirmed")
            }
            all => format!("{confirmed} of {all} claims of theory and orbits are confirmed"),
        };
        let by = self.study.area.by.words();
        let dynamics = self.dynamics(main);
        let orbit = match self.study.exact.attracting() {
            Some(_) if main.regime() == Regime::TwoSymmetric => String::new(),
            Some(_) => "; the exact symmetric orbit is stable beside it".into(),
            None if self.study.exact.orbits.is_empty() => {
                "; no exact symmetric orbit exists".into()
            }
            None => "; no exact symmetric orbit is stable".into(),
        };
        format!(
            "{} (area {area:?}{strip} by {by}: {criterion}), {dynamics}: {led}{orbit}; {claims}.",
            capitalised(main.regime().words()),
        )
    }

    /// What kind of dynamics the motion is, and what proves it.
    fn dynamics(&self, found: &FoundAttractor) -> String {
        let attractor = &found.attractor;
        let proofs = self.study.attractors.iter().zip(&self.study.proofs);
        let proof = proofs
            .filter(|(one, _)| std::ptr::eq(*one, found))
            .find_map(|(_, proof)| proof.as_ref());
        match (attractor.classification.dynamics, proof) {
            (DynamicsKind::Periodic { .. }, Some(proof)) => format!(
                "periodic, proven by an exact orbit with largest multiplier {} per period",
                significant(proof.orbit.radius_per_period(), 3)
            ),
            (DynamicsKind::Periodic { periods, .. }, None) => match periods {
                1 => "repeating every period".into(),
                more => format!("repeating every {more} periods"),
            },
            (DynamicsKind::TransientNotOver, _) => {
                format!("a transient not over after {} periods", attractor.followed)
            }
            (other, _) => {
                let exponent = attractor.classification.evidence.exponent;
                let exponent = exponent.filter(|_| other != DynamicsKind::AtRest).map(|exponent| {
                    format!(" with Lyapunov exponent {} per period", text_of(&exponent))
                });
                format!("{}{}", other.words(), exponent.unwrap_or_default())
            }
        }
    }
}
