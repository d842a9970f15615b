//! What a trajectory is: at rest, `z > 2`, two impacts per period, strongly modulated, `z < 2`.
//!
//! `z` is the number of impacts per excitation period (section 3.1 of Li, Seguy, Berlioz 2016).
//! Every name comes with the numbers that decided it.

pub mod attractor;
pub mod basins;
pub mod diagram;
pub mod dynamics_kind;
pub mod energetics;
pub mod long_term;
pub mod lyapunov;
pub mod modulation;
pub mod periodicity;
pub mod return_map;
pub mod search;
pub mod sequence;
pub mod share;
pub mod starts;
pub mod transient;

use serde::{Serialize, Serializer};

use crate::simulation::{Impact, Statistics};
pub use attractor::Attractor;
pub use dynamics_kind::DynamicsKind;
pub use energetics::Energetics;
pub use lyapunov::{Exponent, Lyapunov};
pub use modulation::{AbsorberAmplitude, Amplitudes, Captures};
pub use periodicity::Periodicity;
pub use search::FoundAttractor;
pub use sequence::ImpactSequence;
pub use transient::Transient;

/// The regimes of section 3.1, and rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Regime {
    /// No impacts at all: the absorber stands still and the oscillator vibrates as if alone.
    AtRest,
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

    /// The regime's name in results and documents.
    pub const fn key(self) -> &'static str {
        match self {
            Self::AtRest => "at-rest",
            Self::AboveTwo => "above-two",
            Self::TwoAsymmetric => "two-asymmetric",
            Self::TwoSymmetric => "two-symmetric",
            Self::StronglyModulated => "strongly-modulated",
            Self::BelowTwo => "below-two",
        }
    }

    /// The regime that results name so.
    pub fn of_key(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|regime| regime.key() == key)
    }

    /// Its place in [`Regime::ALL`].
    pub const fn index(self) -> usize {
        match self {
            Self::AboveTwo => 0,
            Self::TwoAsymmetric => 1,
            Self::TwoSymmetric => 2,
            Self::StronglyModulated => 3,
            Self::BelowTwo => 4,
            Self::AtRest => 5,
        }
    }

    /// The regime in a few words.
    pub fn words(self) -> &'static str {
        match self {
            Self::AtRest => "absorber at rest, no impacts",
            Self::AboveTwo => "more than two impacts per period",
            Self::TwoAsymmetric => "two asymmetric impacts per period",
            Self::TwoSymmetric => "two symmetric impacts per period",
            Self::StronglyModulated => "strongly modulated response",
            Self::BelowTwo => "fewer than two impacts per period",
        }
    }

    /// The regime in as few words as a table has room for.
    pub fn short(self) -> &'static str {
        match self {
            Self::AtRest => "rest",
            Self::AboveTwo => "z > 2",
            Self::TwoAsymmetric => "asymmetric",
            Self::TwoSymmetric => "symmetric 1:1",
            Self::StronglyModulated => "strongly modulated",
            Self::BelowTwo => "z < 2",
        }
    }

    /// Whether two impacts happen in every period.
    pub fn is_two_per_period(self) -> bool {
        matches!(self, Self::TwoAsymmetric | Self::TwoSymmetric)
    }
}

impl Serialize for Regime {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.key())
    }
}

/// Where one regime ends and another begins. Each field is a convention, with its reason.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Thresholds {
    /// Distance of `z` from 2 that still counts as two impacts per period: in a few hundred periods
    /// a single extra impact moves `z` by less.
    pub impacts_per_period: f64,
    /// Difference of successive impact intervals, over the period, above which a motion is
    /// asymmetric. A periodic orbit repeats to 1e-6, so 1e-3 is a thousand times above its noise.
    pub asymmetry: f64,
    /// The same for a motion that does not repeat, where modulation itself makes intervals unequal.
    pub asymmetry_modulated: f64,
    /// Shortest capture, in periods: three successive periods with two alternating impacts cannot
    /// be told from coincidence below that.
    pub shortest_capture: usize,
    /// Share of the time in captures above which a motion with `z < 2` is strongly modulated.
    pub captured_share: f64,
    /// Modulation depth above which modulation is strong.
    pub modulation_depth: f64,
}

impl Default for Thresholds {
    fn default() -> Self {
        Self {
            impacts_per_period: 0.01,
            asymmetry: 1e-3,
            asymmetry_modulated: 0.02,
            shortest_capture: 3,
            captured_share: 0.05,
            modulation_depth: 0.1,
        }
    }
}

/// The numbers that a regime was decided by.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
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
pub struct Classification {
    /// The name: what the impacts do.
    pub regime: Regime,
    /// What kind of dynamics it is.
    pub dynamics: DynamicsKind,
    /// Why.
    pub evidence: Evidence,
}

/// Names the motion measured by `statistics` and `impacts` over one window.
pub fn classify(
    statistics: &Statistics,
    impacts: &[Impact],
    exponent: Option<Exponent>,
    period: f64,
    thresholds: &Thresholds,
) -> Classification {
    let records = statistics.records();
    let periodicity = periodicity::find(records);
    let repetition = periodicity.and_then(|found| periodicity::last_repetition(found, impacts));
    let amplitudes = modulation::amplitudes(records, thresholds.shortest_capture);
    let evidence = Evidence {
        impacts_per_period: statistics.impacts_per_period(),
        visits_per_period: statistics.visits_per_period(),
        periodicity,
        sequence: repetition.and_then(ImpactSequence::of),
        asymmetry: periodicity::asymmetry(impacts, period),
        modulation_depth: modulation::depth(records),
        modulation_growth: modulation::growth(records),
        captures: modulation::captures(records, thresholds.shortest_capture),
        absorber_amplitude: modulation::absorber_amplitude(&amplitudes),
        exponent,
        settled: modulation::settled(records),
    };
    Classification {
        regime: Signs::of(&evidence).regime(thresholds),
        dynamics: DynamicsKind::of(&evidence),
        evidence,
    }
}

/// Those numbers of [`Evidence`] that a regime is decided by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Signs {
    /// `z`.
    pub impacts_per_period: f64,
    /// The same with every chattering sequence that ended in sustained contact counted once.
    pub visits_per_period: f64,
    /// Whether the motion repeats.
    pub repeats: bool,
    /// Mean difference of successive impact intervals over the excitation period.
    pub asymmetry: f64,
    /// Stretches of 1:1 resonance; of no account where the motion repeats.
    pub captures: Captures,
    /// `(max - min) / (max + min)` of the oscillator's peak per period; of no account where the motion
    /// repeats.
    pub modulation_depth: f64,
}

impl Signs {
    fn of(evidence: &Evidence) -> Self {
        Self {
            impacts_per_period: evidence.impacts_per_period,
            visits_per_period: evidence.visits_per_period,
            repeats: evidence.periodicity.is_some(),
            asymmetry: evidence.asymmetry,
            captures: evidence.captures,
            modulation_depth: evidence.modulation_depth,
        }
    }

    /// The regime.
    pub fn regime(&self, thresholds: &Thresholds) -> Regime {
        if self.impacts_per_period == 0.0 {
            return Regime::AtRest;
        }
        // Many impacts make a motion of more than two per period only where the absorber goes to and
        // fro in every period; a chattering sequence now and then is one visit to a wall.
        let to_and_fro = self.visits_per_period > 2.0 - thresholds.impacts_per_period;
        let excess = self.impacts_per_period - 2.0;
        if excess > thresholds.impacts_per_period && to_and_fro {
            return Regime::AboveTwo;
        }
        // One capture and one escape are a transient; modulation returns.
        let escapes =
            self.captures.count > 1 && self.captures.share < 1.0 - thresholds.captured_share;
        let strong = self.modulation_depth > thresholds.modulation_depth;
        let captured = self.captures.share > thresholds.captured_share;
        if !self.repeats && captured && escapes && strong {
            return Regime::StronglyModulated;
        }
        if !to_and_fro {
            return Regime::BelowTwo;
        }
        let limit =
            if self.repeats { thresholds.asymmetry } else { thresholds.asymmetry_modulated };
        if self.asymmetry > limit { Regime::TwoAsymmetric } else { Regime::TwoSymmetric }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
