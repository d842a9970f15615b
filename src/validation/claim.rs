//! A claim as data: what is said, predicted and observed, why it is judged so, and the verdict.

use serde::Serialize;

use super::tolerance::SAYS_NOTHING;
use crate::analysis::motion::wrapped;
use crate::analysis::{Area, Strip};
use crate::method::Method;
use crate::motions::RestKind;
use crate::orbits::Bifurcation;
use crate::regimes::Regime;

/// What a comparison came to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Prediction and observation agree within the tolerance.
    Confirmed,
    /// They do not.
    Refuted,
    /// The simulation did not give an answer that could decide.
    Undecided,
}

impl Verdict {
    /// Of a claim that holds or not.
    pub fn of(holds: bool) -> Self {
        if holds { Self::Confirmed } else { Self::Refuted }
    }
}

/// What is claimed. Fixed points and exact orbits are numbered from 1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "about", rename_all = "kebab-case")]
#[allow(missing_docs, reason = "each variant says what its fields are")]
pub enum Statement {
    /// Whether a fixed point is stable; of one absorber at `B/b`.
    Stability { point: usize, absorber_amplitude: Option<f64>, stable: bool },
    /// An amplitude or phase of a fixed point.
    FixedPoint { point: usize, symbol: &'static str },
    /// Clearance of a boundary of steady 1:1 resonance.
    Boundary { bifurcation: Bifurcation },
    /// The amplitude of a simulated motion, numbered from 1, is one of the averaged flow's in its regime.
    Averaged { motion: usize, regime: Regime },
    /// The absorber rests, and the oscillator vibrates as if alone.
    Rest,
    /// The absorber of a cavity that is not ideal rests, and the oscillator vibrates accordingly.
    Inactive { absorber: RestKind },
    /// Where the case lies.
    Area { area: Area, strip: Option<Strip> },
    /// An exact orbit repeats after one period.
    Repeats { orbit: usize },
    /// A small disturbance of an exact orbit dies out or grows, by its largest multiplier per period.
    Disturbance { orbit: usize, multiplier: f64 },
    /// What the motion becomes on either side of an exact limit of stability.
    Limit { bifurcation: Bifurcation },
}

impl Statement {
    /// A stable name.
    fn id(self) -> String {
        let key = |of: Bifurcation| of.words().replace([' ', '–'], "-");
        match self {
            Self::Stability { point, .. } => format!("fixed-point-{point}-stability"),
            Self::FixedPoint { point, symbol } => format!("fixed-point-{point}-{symbol}"),
            Self::Boundary { bifurcation } => format!("boundary-{}", key(bifurcation)),
            Self::Averaged { motion, .. } => format!("averaged-motion-{motion}"),
            Self::Rest => "rest".into(),
            Self::Inactive { .. } => "inactive".into(),
            Self::Area { .. } => "area".into(),
            Self::Repeats { orbit } => format!("orbit-{orbit}-repeats"),
            Self::Disturbance { orbit, .. } => format!("orbit-{orbit}-stability"),
            Self::Limit { bifurcation } => format!("limit-{}", key(bifurcation)),
        }
    }

    /// The layer that checks it.
    fn checked_by(self) -> Method {
        match self {
            Self::Stability { .. } | Self::FixedPoint { .. } | Self::Boundary { .. } => {
                Method::ExactOrbit
            }
            _ => Method::Simulation,
        }
    }
}

/// Where a motion led.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct ReachedMotion {
    /// Its regime.
    pub regime: Regime,
    /// Excitation periods after which it repeats; none on a torus, as next to a Neimark–Sacker limit.
    pub repeats_after: Option<u32>,
    /// Whether the absorber rests on a wall in every repetition of it.
    pub rests: bool,
}

impl ReachedMotion {
    /// A regime is named by its impacts alone, which a small torus shares with the orbit inside of it.
    pub(super) fn is_steady_flight(self) -> bool {
        self.regime == Regime::TwoSymmetric && self.repeats_after == Some(1) && !self.rests
    }
}

/// One side of a comparison: a number, or what happens.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "is", rename_all = "kebab-case")]
#[allow(missing_docs, reason = "each variant says what its fields are")]
pub enum Finding {
    /// A length over the clearance.
    #[serde(skip)]
    Length(f64),
    /// An angle in radians.
    #[serde(skip)]
    Angle(f64),
    /// A fixed point or the exact orbit beside it; of the latter the largest multiplier.
    Stability { stable: bool, multiplier: Option<f64> },
    /// There is no exact orbit near a fixed point.
    NoOrbit,
    /// An undamped resonance has no exact orbit to compare.
    Unsolved,
    /// An orbit repeats.
    Repeats,
    /// It misses itself by this much, over the size of the motion.
    Misses { by: f64 },
    /// A disturbance dies out or grows.
    Disturbance { dies_out: bool },
    /// Share of a disturbance that is left after so many periods.
    Left { share: f64, periods: u64 },
    /// Whether 1:1 resonance is steady on either side; where it is not, it may go on with rests on a wall.
    Steady { below: bool, above: bool, rests: bool },
    /// Where motions led on either side.
    Reached { below: ReachedMotion, above: ReachedMotion },
    /// Steady 1:1 resonance and nothing else.
    OnlySteady,
    /// Steady 1:1 resonance beside a modulated response.
    SteadyBesideModulated,
    /// A strongly modulated response.
    StronglyModulated,
    /// A motion with two asymmetric impacts per period.
    TwoAsymmetric,
    /// A motion with more than two impacts per period.
    AboveTwo,
    /// No steady 1:1 resonance.
    NotSteady,
    /// No stable amplitude in a regime.
    NoAmplitude,
    /// Regimes with the share of starts that lead to each.
    Regimes { shares: Vec<(Regime, f64)> },
}

/// Why a claim is judged as it is: how large an error may be, or what is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "is", rename_all = "kebab-case")]
#[allow(missing_docs, reason = "each variant says what its fields are")]
pub enum Reason {
    /// Multipliers of the exact orbit nearest to the point, within twice the theory's error or, next to a
    /// saddle-node, its root.
    NearestOrbit,
    /// Terms that the expansion neglects: `eps (2 + abs(sigma) + lambda)`; whether that is so wide that
    /// agreement means nothing.
    NeglectedTerms { says_nothing: bool },
    /// The same beside other modes, and what these move where impacts are.
    OtherModes { says_nothing: bool },
    /// Twice that: at a boundary two conditions meet, each with that error.
    TwoConditions { says_nothing: bool },
    /// The neglected terms, and what a forcing that is off by as much would change.
    ForcingOff { says_nothing: bool },
    /// Three times `eps (2 + abs(sigma) + lambda)`, of averages in place of one motion; of a modulated one more.
    Averages { says_nothing: bool, modulated: bool },
    /// A closed form of the full system: rounding.
    Rounding,
    /// Dry friction at first order: the square of `4 f/(pi Omega^2 X)`, the absorber's amplitude over the structure's.
    DryFriction { says_nothing: bool },
    /// A part of the motion's size, times the growth of a disturbance in a period.
    Growth,
    /// A disturbance is followed until it should change a hundredfold.
    Followed,
    /// Started on the orbit, disturbed, to either side of the limit.
    EitherSide,
    /// The share of all starts.
    Starts {
        /// The nearest boundary, where it is within the theory's error.
        near: Option<NearBoundary>,
        /// Whether rounding decides how many starts are still on a chaotic motion when watching ends.
        by_chance: bool,
    },
}

/// A boundary of the theory nearer than the theory's error, both relative in clearance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct NearBoundary {
    /// Which one.
    pub bifurcation: Bifurcation,
    /// How far.
    pub distance: f64,
    /// The theory's error.
    pub error: f64,
}

/// A claim, what was predicted, what was observed, and what that means.
#[derive(Debug, Clone, PartialEq)]
pub struct Claim {
    /// A stable name.
    pub id: String,
    /// What is claimed.
    pub statement: Statement,
    /// By the theory.
    pub predicted: Finding,
    /// By the layer that checks it.
    pub observed: Finding,
    /// That layer.
    pub checked_by: Method,
    /// The error of the claim: predicted minus observed, relative to the observed for lengths, absolute
    /// for angles. How far an orbit misses itself has no sign.
    pub difference: Option<f64>,
    /// How large it may be: relative for lengths, in radians for angles, 0 for outcomes.
    pub tolerance: f64,
    /// Why this much.
    pub reason: Reason,
    /// The outcome.
    pub verdict: Verdict,
}

impl Claim {
    /// About an outcome that either happens or does not.
    pub(crate) fn of_outcome(
        statement: Statement,
        [predicted, observed]: [Finding; 2],
        reason: Reason,
        verdict: Verdict,
    ) -> Self {
        Self {
            id: statement.id(),
            statement,
            predicted,
            observed,
            checked_by: statement.checked_by(),
            difference: None,
            tolerance: 0.0,
            reason,
            verdict,
        }
    }

    /// About a number; without a verdict where the tolerance is so wide that agreement would mean nothing.
    pub(crate) fn of_number(
        statement: Statement,
        [predicted, observed]: [f64; 2],
        tolerance: f64,
        reason: Reason,
    ) -> Self {
        let angle =
            matches!(statement, Statement::FixedPoint { symbol: "eta" | "Theta" | "t_1", .. });
        let (finding, difference): (fn(f64) -> Finding, _) = match angle {
            true => (Finding::Angle, wrapped(predicted - observed)),
            false => (Finding::Length, predicted / observed - 1.0),
        };
        Self {
            id: statement.id(),
            statement,
            predicted: finding(predicted),
            observed: finding(observed),
            checked_by: statement.checked_by(),
            difference: Some(difference),
            tolerance,
            reason,
            verdict: match tolerance > SAYS_NOTHING {
                true => Verdict::Undecided,
                false => Verdict::of(difference.abs() <= tolerance),
            },
        }
    }
}
