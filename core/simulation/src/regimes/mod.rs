//! What a trajectory is: at rest, `z > 2`, two impacts per period, strongly modulated, `z < 2`.
//!
//! `z` is the number of impacts per excitation period (section 3.1 of Li, Seguy, Berlioz 2016).
//! Every name comes with the numbers that decided it.

mod dynamics_kind;
mod energetics;
pub mod lyapunov;
mod modal;
#[doc(hidden)]
pub mod modulation;
#[doc(hidden)]
pub mod periodicity;
pub mod return_map;
mod sequence;

use serde::Serialize;

use crate::simulation::{Impact, PeriodRecord, Statistics};
pub use dynamics_kind::DynamicsKind;
pub use energetics::Energetics;
pub use lyapunov::{Exponent, Lyapunov};
pub use modal::{ModalRecords, ModalRegimes};
pub use modulation::{AbsorberAmplitude, Amplitudes, Captures};
pub use periodicity::Periodicity;
pub use sequence::ImpactSequence;

/// The regimes of section 3.1, and rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Regime {
    /// More than two impacts per period, Fig. 4a.
    AboveTwo,
    /// Two impacts per period at unequal intervals, Fig. 4b.
    TwoAsymmetric,
    /// Two impacts per period, half a period apart: steady 1:1 resonance, Fig. 4c.
    TwoSymmetric,
    /// Strongly modulated response: 1:1 captures alternate with escapes, Fig. 4d.
    StronglyModulated,
    /// Fewer than two impacts per period without captures, Fig. 4e.
    BelowTwo,
    /// No impacts at all: the absorber stands still and the oscillator vibrates as if alone.
    AtRest,
}

impl Regime {
    /// Every regime, from many impacts to none.
    pub const ALL: [Self; 6] = [
        Self::AboveTwo,
        Self::TwoAsymmetric,
        Self::TwoSymmetric,
        Self::StronglyModulated,
        Self::BelowTwo,
        Self::AtRest,
    ];

    /// Its name in results and documents, in a few words, and in as few as a figure has room for.
    const fn names(self) -> [&'static str; 3] {
        match self {
            Self::AtRest => ["at-rest", "absorber at rest, no impacts", "at rest"],
            Self::AboveTwo => ["above-two", "more than two impacts per period", "more impacts"],
            Self::TwoAsymmetric => {
                ["two-asymmetric", "two asymmetric impacts per period", "asymmetric"]
            }
            Self::TwoSymmetric => {
                ["two-symmetric", "two symmetric impacts per period", "symmetric 1:1"]
            }
            Self::StronglyModulated => {
                ["strongly-modulated", "strongly modulated response", "strongly modulated"]
            }
            Self::BelowTwo => ["below-two", "fewer than two impacts per period", "fewer impacts"],
        }
    }

    /// The regime's name in results and documents.
    pub const fn key(self) -> &'static str {
        self.names()[0]
    }

    /// The regime that results name so.
    pub fn of_key(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|regime| regime.key() == key)
    }

    /// The worst word for several absorbers of one structure: that of the one that drains energy least steadily.
    pub fn worst(each: impl IntoIterator<Item = Self>) -> Option<Self> {
        let order = |one: &Self| match one {
            Self::TwoSymmetric => 0,
            Self::TwoAsymmetric => 1,
            Self::AboveTwo => 2,
            Self::StronglyModulated => 3,
            Self::BelowTwo => 4,
            Self::AtRest => 5,
        };
        each.into_iter().max_by_key(order)
    }

    /// Its place in [`Regime::ALL`].
    pub const fn index(self) -> usize {
        self as usize
    }

    /// The regime in a few words.
    pub const fn words(self) -> &'static str {
        self.names()[1]
    }

    /// The regime in as few words as a figure has room for.
    pub const fn short(self) -> &'static str {
        self.names()[2]
    }

    /// Whether two impacts happen in every period.
    pub fn is_two_per_period(self) -> bool {
        matches!(self, Self::TwoAsymmetric | Self::TwoSymmetric)
    }
}

/// Where one regime ends and another begins. Each is a convention, with its reason.
pub mod thresholds {
    /// Distance of `z` from 2 that still counts as two impacts per period: in a few hundred periods
    /// a single extra impact moves `z` by less.
    pub const IMPACTS_PER_PERIOD: f64 = 0.01;
    /// Difference of successive impact intervals, over the period, above which a motion is
    /// asymmetric. A periodic orbit repeats to 1e-6, so 1e-3 is a thousand times above its noise.
    pub const ASYMMETRY: f64 = 1e-3;
    /// The same for a motion that does not repeat, where modulation itself makes intervals unequal.
    pub const ASYMMETRY_MODULATED: f64 = 0.02;
    /// Shortest capture, in periods: three successive periods with two alternating impacts cannot
    /// be told from coincidence below that.
    pub const SHORTEST_CAPTURE: usize = 3;
    /// Share of the time in captures above which a motion with `z < 2` is strongly modulated.
    pub const CAPTURED_SHARE: f64 = 0.05;
    /// Modulation depth above which modulation is strong.
    pub const MODULATION_DEPTH: f64 = 0.1;
}

/// The numbers that a regime was decided by.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Evidence {
    /// `z`.
    pub impacts_per_period: f64,
    /// The same with every chattering sequence that ended in sustained contact counted once.
    pub visits_per_period: f64,
    /// The repetition found, if the motion repeats.
    pub periodicity: Option<Periodicity>,
    /// Which walls are hit in what order over one repetition.
    pub sequence: Option<ImpactSequence>,
    /// Mean difference of successive impact intervals over the excitation period.
    pub asymmetry: f64,
    /// `(max - min) / (max + min)` of the oscillator's peak per period.
    pub modulation_depth: f64,
    /// Depth of modulation in the second half of the window over that in the first.
    pub modulation_growth: f64,
    /// Stretches of 1:1 resonance.
    pub captures: Captures,
    /// The amplitude `E` of equation (17).
    pub absorber_amplitude: AbsorberAmplitude,
    /// The largest Lyapunov exponent; `None` where the window was too short.
    pub exponent: Option<Exponent>,
    /// Whether the second half of the window looks like the first: if not, the transient may not
    /// be over.
    pub settled: bool,
}

/// A regime with its evidence.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Classification {
    /// The name: what the impacts do.
    pub regime: Regime,
    /// What kind of dynamics it is.
    pub dynamics: DynamicsKind,
    /// Why.
    pub evidence: Evidence,
}

/// Names the motion measured by `statistics` and `impacts` over one window. One that repeats is named by its last
/// repetition: before that may be the end of a transient.
pub fn classify(
    statistics: &Statistics,
    impacts: &[Impact],
    exponent: Option<Exponent>,
    period: f64,
) -> Classification {
    let records = statistics.records();
    let of_impacts = Evidence::of_impacts(statistics, impacts, period);
    let repetition =
        of_impacts.periodicity.and_then(|found| periodicity::last_repetition(found, impacts));
    let amplitudes = modulation::amplitudes(records, thresholds::SHORTEST_CAPTURE);
    let evidence = Evidence {
        sequence: repetition.and_then(ImpactSequence::of),
        modulation_growth: modulation::growth(records),
        absorber_amplitude: modulation::absorber_amplitude(&amplitudes),
        exponent,
        settled: modulation::settled(records),
        ..of_impacts
    };
    let (regime, dynamics) = (Regime::of(&evidence), DynamicsKind::of(&evidence));
    Classification { regime, dynamics, evidence }
}

impl Evidence {
    /// What a regime is decided by, from a window in which only impacts and peaks were measured; the rest is
    /// left open.
    #[doc(hidden)]
    pub fn of_impacts(statistics: &Statistics, impacts: &[Impact], period: f64) -> Self {
        let records = statistics.records();
        let per_period = [statistics.impacts_per_period(), statistics.visits_per_period()];
        let times = impacts.iter().map(|impact| impact.tau);
        let times: Vec<f64> = times.collect();
        Self::of_records(records, periodicity::find(records), per_period, &times, period)
    }

    /// The same of the records of periods, the repetition that they show, impacts and visits in a period, and the times of impacts.
    fn of_records(
        records: &[PeriodRecord],
        periodicity: Option<Periodicity>,
        per_period: [f64; 2],
        times: &[f64],
        period: f64,
    ) -> Self {
        let (per_period, last) = match periodicity {
            Some(found) => {
                let per = |count: u32| f64::from(count) / f64::from(found.periods);
                let visits = found.last(records).iter().flat_map(|record| record.visits).sum();
                // Two impacts more make as many intervals follow each other as there are impacts.
                let from = times.len().saturating_sub(found.impacts as usize + 2);
                ([per(found.impacts), per(visits)], &times[from..])
            }
            None => (per_period, times),
        };
        Self {
            impacts_per_period: per_period[0],
            visits_per_period: per_period[1],
            periodicity,
            sequence: None,
            asymmetry: periodicity::asymmetry(last, period),
            modulation_depth: modulation::depth(records),
            modulation_growth: 1.0,
            captures: modulation::captures(&modulation::captured(
                records,
                thresholds::SHORTEST_CAPTURE,
            )),
            absorber_amplitude: AbsorberAmplitude::default(),
            exponent: None,
            settled: true,
        }
    }
}

impl Regime {
    /// That of what several windows of one motion show together.
    #[doc(hidden)]
    pub fn of_several(windows: &[Evidence]) -> Self {
        let Some(first) = windows.first() else { return Self::AtRest };
        let count = windows.len() as f64;
        let mean = |of: fn(&Evidence) -> f64| windows.iter().map(of).sum::<f64>() / count;
        let captures = Captures {
            count: windows.iter().map(|one| one.captures.count).sum(),
            share: mean(|one| one.captures.share),
            ..first.captures
        };
        Self::of(&Evidence {
            impacts_per_period: mean(|one| one.impacts_per_period),
            visits_per_period: mean(|one| one.visits_per_period),
            asymmetry: mean(|one| one.asymmetry),
            modulation_depth: windows.iter().map(|one| one.modulation_depth).fold(0.0, f64::max),
            captures,
            periodicity: None,
            ..*first
        })
    }

    #[doc(hidden)]
    pub fn of(evidence: &Evidence) -> Self {
        if evidence.impacts_per_period == 0.0 {
            return Self::AtRest;
        }
        // Many impacts make a motion of more than two per period only where the absorber goes to and
        // fro in every period; a chattering sequence now and then is one visit to a wall.
        let to_and_fro = evidence.visits_per_period > 2.0 - thresholds::IMPACTS_PER_PERIOD;
        let excess = evidence.impacts_per_period - 2.0;
        if excess > thresholds::IMPACTS_PER_PERIOD && to_and_fro {
            return Self::AboveTwo;
        }
        let captures = &evidence.captures;
        // One capture and one escape are a transient; modulation returns.
        let escapes = captures.count > 1 && captures.share < 1.0 - thresholds::CAPTURED_SHARE;
        let strong = evidence.modulation_depth > thresholds::MODULATION_DEPTH;
        let captured = captures.share > thresholds::CAPTURED_SHARE;
        let repeats = evidence.periodicity.is_some();
        if !repeats && captured && escapes && strong {
            return Self::StronglyModulated;
        }
        if !to_and_fro {
            return Self::BelowTwo;
        }
        let limit = if repeats { thresholds::ASYMMETRY } else { thresholds::ASYMMETRY_MODULATED };
        if evidence.asymmetry > limit { Self::TwoAsymmetric } else { Self::TwoSymmetric }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of two absorbers, one in steady resonance and one that rests, nobody reads "symmetric 1:1".
    #[test]
    fn the_worst_word_of_several_absorbers() {
        let worst = |each: &[Regime]| Regime::worst(each.iter().copied());
        let ordered = [
            Regime::TwoSymmetric,
            Regime::TwoAsymmetric,
            Regime::AboveTwo,
            Regime::StronglyModulated,
            Regime::BelowTwo,
            Regime::AtRest,
        ];
        for pair in ordered.windows(2) {
            assert_eq!(worst(pair), Some(pair[1]));
            assert_eq!(worst(&[pair[1], pair[0]]), Some(pair[1]));
        }
        assert_eq!(worst(&[]), None);
    }

    /// Results and reports that are stored already are read by these names.
    #[test]
    fn names_in_results_stay_as_they_are() {
        let keys = [
            "above-two",
            "two-asymmetric",
            "two-symmetric",
            "strongly-modulated",
            "below-two",
            "at-rest",
        ];
        assert_eq!(Regime::ALL.map(Regime::key), keys);
        assert_eq!(Regime::ALL.map(Regime::index), [0, 1, 2, 3, 4, 5]);
        assert_eq!(keys.map(Regime::of_key), Regime::ALL.map(Some));
        assert_eq!(Regime::of_key("at rest"), None);
    }
}
