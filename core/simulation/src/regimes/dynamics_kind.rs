//! What kind of dynamics a motion is, decided from what was measured and never guessed.

use serde::Serialize;

use super::{Evidence, Exponent};

/// What kind of dynamics a motion is; the regime says what its impacts do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum DynamicsKind {
    /// No impacts, and every period like the one before.
    AtRest,
    /// It was seen to repeat.
    Periodic {
        /// `p`, impacts until it repeats.
        impacts: u32,
        /// `n`, excitation periods until it repeats.
        periods: u32,
    },
    /// It never repeats, and neighbours neither part nor come together: the largest Lyapunov
    /// exponent is zero.
    QuasiPeriodic,
    /// Neighbours part exponentially: the largest Lyapunov exponent is above zero.
    Chaotic,
    /// It is still on its way: to a motion that it approaches, or with averages that drift.
    TransientNotOver,
    /// The window was too short to tell.
    Undecided,
}

impl DynamicsKind {
    /// The kind of dynamics in a few words.
    pub fn words(self) -> &'static str {
        match self {
            Self::AtRest => "at rest",
            Self::Periodic { .. } => "periodic",
            Self::QuasiPeriodic => "quasi-periodic",
            Self::Chaotic => "chaotic",
            Self::TransientNotOver => "transient not over",
            Self::Undecided => "undecided",
        }
    }
}

/// Largest distance of either end of the exponent's interval from zero, in nats per period, at which
/// an exponent is called zero: neighbours then need over 500 periods to part or approach by a factor
/// of e, longer than any modulation of these systems, and a faster approach would show in the depth
/// of modulation.
const ZERO: f64 = 2e-3;
/// What an exponent of zero may still look like after `periods`, in nats per period: without damping
/// and losses neighbours drift apart in proportion to time, by `ln(periods)/periods` a period, and
/// the worst of it is in the first of them; twice that is no such drift.
fn drift(periods: u64) -> f64 {
    let count = periods.max(2) as f64;
    2.0 * libm::log(count) / count
}
/// Depth of modulation in the second half of a window over that in the first which still counts as
/// the same: quasi-periodic motion keeps its depth, which is sampled to a few percent.
const SAME_DEPTH: std::ops::Range<f64> = 0.9..1.1;
/// The same ratio outside of which a modulation fades or builds up; a modulation that stays, even a
/// chaotic one in a short window, keeps within a factor of two.
const STEADY_DEPTH: std::ops::Range<f64> = 0.5..2.0;

impl DynamicsKind {
    /// Decides by the evidence, in this order (of a chaotic motion no window says whether it stays:
    /// beside a motion that repeats it may be a transient of any length):
    ///
    /// 1. what repeats is periodic, or at rest without impacts;
    /// 2. without impacts and not repeating: not over if it drifts, undecided otherwise;
    /// 3. a converged exponent with its interval above zero, and above what a linear drift gives:
    ///    chaotic;
    /// 4. an interval below zero: it approaches something that it has not reached, so not over;
    /// 5. averages of both halves differ, or the modulation fades or builds up: not over;
    /// 6. a converged exponent with zero in a narrow interval, and a modulation that stays:
    ///    quasi-periodic;
    /// 7. undecided.
    pub fn of(evidence: &Evidence) -> Self {
        let silent = evidence.impacts_per_period == 0.0;
        if let Some(found) = evidence.periodicity {
            let (impacts, periods) = (found.impacts, found.periods);
            return if silent { Self::AtRest } else { Self::Periodic { impacts, periods } };
        }
        let exponent = if silent { None } else { evidence.exponent };
        let converged = exponent.filter(|exponent| exponent.converged);
        if converged.is_some_and(|exponent| exponent.interval[0] > drift(exponent.periods)) {
            Self::Chaotic
        } else if exponent.is_some_and(|exponent| exponent.is_negative())
            || !evidence.settled
            || !STEADY_DEPTH.contains(&evidence.modulation_growth)
        {
            Self::TransientNotOver
        } else if converged.is_some_and(is_zero) && SAME_DEPTH.contains(&evidence.modulation_growth)
        {
            Self::QuasiPeriodic
        } else {
            Self::Undecided
        }
    }
}

fn is_zero(exponent: Exponent) -> bool {
    let [low, high] = exponent.interval;
    (-ZERO..=0.0).contains(&low) && (0.0..=ZERO).contains(&high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::regimes::{AbsorberAmplitude, Captures, Periodicity};

    fn exponent(low: f64, high: f64) -> Exponent {
        Exponent {
            per_period: 0.5 * (low + high),
            standard_error: 0.0,
            interval: [low, high],
            periods: 1000,
            block: 50,
            block_correlation: 0.0,
            converged: true,
        }
    }

    fn evidence(exponent: Option<Exponent>) -> Evidence {
        Evidence {
            impacts_per_period: 1.0,
            visits_per_period: 1.0,
            periodicity: None,
            sequence: None,
            asymmetry: 0.1,
            modulation_depth: 0.5,
            modulation_growth: 1.0,
            captures: Captures::default(),
            absorber_amplitude: AbsorberAmplitude::default(),
            exponent,
            settled: true,
        }
    }

    #[test]
    fn the_exponent_decides_where_nothing_repeats() {
        let of = |low, high| DynamicsKind::of(&evidence(Some(exponent(low, high))));
        assert_eq!(of(0.3, 0.4), DynamicsKind::Chaotic);
        assert_eq!(of(-0.4, -0.3), DynamicsKind::TransientNotOver);
        assert_eq!(of(-1e-3, 1e-3), DynamicsKind::QuasiPeriodic);
        // Too wide to tell, on either side of zero.
        assert_eq!(of(-0.1, 1e-3), DynamicsKind::Undecided);
        assert_eq!(of(-1e-3, 0.1), DynamicsKind::Undecided);
        // Above zero by no more than a linear drift over 1000 periods, 2 ln(1000)/1000 = 0.0138.
        assert_eq!(of(0.013, 0.3), DynamicsKind::Undecided);
        assert_eq!(of(0.0145, 0.3), DynamicsKind::Chaotic);
        assert_eq!(DynamicsKind::of(&evidence(None)), DynamicsKind::Undecided);
    }

    #[test]
    fn what_has_not_converged_or_settled_decides_nothing() {
        let loose = |low, high| Some(Exponent { converged: false, ..exponent(low, high) });
        assert_eq!(DynamicsKind::of(&evidence(loose(0.3, 0.4))), DynamicsKind::Undecided);
        assert_eq!(DynamicsKind::of(&evidence(loose(-1e-3, 1e-3))), DynamicsKind::Undecided);
        let zero = evidence(Some(exponent(-1e-3, 1e-3)));
        let drifting = Evidence { settled: false, ..zero };
        assert_eq!(DynamicsKind::of(&drifting), DynamicsKind::TransientNotOver);
        for (growth, expected) in [
            (0.4, DynamicsKind::TransientNotOver),
            (0.8, DynamicsKind::Undecided),
            (1.05, DynamicsKind::QuasiPeriodic),
            (2.5, DynamicsKind::TransientNotOver),
        ] {
            let modulated = Evidence { modulation_growth: growth, ..zero };
            assert_eq!(DynamicsKind::of(&modulated), expected, "{growth}");
        }
    }

    #[test]
    fn what_repeats_is_periodic_whatever_its_exponent_looks_like() {
        let found = Periodicity { impacts: 3, periods: 2, closure: 1e-9 };
        let repeating = Evidence { periodicity: Some(found), ..evidence(Some(exponent(0.3, 0.4))) };
        assert_eq!(DynamicsKind::of(&repeating), DynamicsKind::Periodic { impacts: 3, periods: 2 });
        let silent = Evidence { impacts_per_period: 0.0, ..repeating };
        assert_eq!(DynamicsKind::of(&silent), DynamicsKind::AtRest);
        // An absorber that drifts through its cavity is not at rest.
        let drifting = Evidence { periodicity: None, ..silent };
        assert_eq!(DynamicsKind::of(&drifting), DynamicsKind::Undecided);
    }
}
