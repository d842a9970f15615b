//! The boundaries of the 1:1 response over the detuning, and the strips between them.
//!
//! At each detuning the collision of fixed points that counts is the one at the smallest forcing (the largest
//! clearance), beyond which no fixed point is left. Other collisions bound no area.

use serde::Serialize;

use crate::analysis::{
    AsymmetricLimits, Boundaries, FixedPointCurve, Manifold, ManifoldBranch, Strip,
};
use crate::study::CaseStudy;
use crate::system::System;

use super::{Line, even};

/// Detunings that resolve the resonance, where the boundaries turn quickly.
const NEAR: f64 = 10.0;
/// Samples over the whole window, and over its part near resonance.
const SAMPLES: u32 = 240;

/// The boundaries at one detuning, as values of `gamma`.
#[derive(Debug, Clone, Copy)]
pub struct Border {
    /// `sigma`.
    pub detuning: f64,
    /// Symmetry breaking.
    pub breaking: f64,
    /// Grazing of the asymmetric motion, the end of Z2; NaN where there is none.
    pub grazing: f64,
    /// Hopf.
    pub hopf: f64,
    /// NaN where no collision bounds the strip beside Z3.
    pub saddle: f64,
    /// Below it there is no fixed point: the collision, or where `B` has shrunk to nothing, or the Hopf
    /// boundary itself.
    pub last: f64,
    /// The strip between Hopf and saddle-node.
    pub strip: Option<Strip>,
}

/// The boundaries over a window.
#[derive(Debug, Clone)]
pub struct Borders {
    /// By ascending detuning.
    pub samples: Vec<Border>,
    /// `[sigma, gamma]` of P1, if in the window.
    pub meeting: Option<[f64; 2]>,
}

impl Borders {
    /// Samples the boundaries from the detuning `first` to `last`.
    pub fn over(system: &System, manifold: &Manifold, (first, last): (f64, f64)) -> Self {
        let asymmetric = AsymmetricLimits::of(manifold.restitution);
        let of = |detuning: f64| {
            let there = system.with_detuning(detuning).ok()?;
            Some(Boundaries::with(&there, manifold, &asymmetric))
        };
        let within = |detuning: f64| (first..=last).contains(&detuning);
        let meeting = of(f64::midpoint(first, last))
            .map(|at| [at.codimension_two.detuning, at.codimension_two.forcing_over_clearance])
            .filter(|at| within(at[0]) && at[1].is_finite() && at[1] > 0.0);
        let mut detunings: Vec<f64> = even(first, last, SAMPLES)
            .chain(even(-NEAR, NEAR, SAMPLES).filter(|detuning| within(*detuning)))
            .chain(meeting.map(|at| at[0]))
            .collect();
        detunings.sort_by(f64::total_cmp);
        detunings.dedup();
        let sample = |detuning| Some(Border::of(system, detuning, &of(detuning)?));
        Self { samples: detunings.into_iter().filter_map(sample).collect(), meeting }
    }

    /// Around a case's detuning and P1: at least six to either side of resonance.
    pub(super) fn around(study: &CaseStudy) -> Self {
        let system = &study.analysis.system;
        let half = (1.35 * system.detuning().abs()).max(6.0);
        // A lower frequency than none is not possible.
        let lowest = (-0.95 / system.mass_ratio()).min(system.detuning());
        Self::over(system, &study.analysis.manifold, ((-half).max(lowest), half))
    }

    /// First and last detuning.
    pub fn window(&self) -> [f64; 2] {
        [self.samples.first(), self.samples.last()].map(|at| at.map_or(f64::NAN, |at| at.detuning))
    }
}

impl Border {
    fn of(system: &System, detuning: f64, at: &Boundaries) -> Self {
        // Without a collision a fixed point that passes the fold lives on until B = 0, where C = b.
        let vanishing = libm::hypot(system.damping(), 2.0 * detuning);
        let (last, strip) = match at.saddle_node {
            Some(node) if node.branch == ManifoldBranch::Left => {
                (node.forcing_over_clearance, Some(Strip::A2))
            }
            Some(node) => (node.forcing_over_clearance, Some(Strip::A1)),
            None if vanishing < at.hopf => (vanishing, Some(Strip::A2)),
            None => (at.hopf, None),
        };
        Self {
            detuning,
            breaking: at.symmetry_breaking,
            grazing: at.grazing.unwrap_or(f64::NAN),
            hopf: at.hopf,
            saddle: at.saddle_node.map_or(f64::NAN, |node| node.forcing_over_clearance),
            last,
            strip,
        }
    }
}

/// At three frequencies, P1's in the middle: where a fixed point is at the fold, and where two collide.
#[derive(Debug, Clone)]
pub struct Bifurcations {
    /// The three.
    pub conditions: Vec<Condition>,
    /// The boundaries around them.
    pub borders: Borders,
}

/// Fixed points at one frequency; clearances over the case's.
#[derive(Debug, Clone, Serialize)]
pub struct Condition {
    /// The frequency over the natural one.
    pub ratio: f64,
    /// Which clearance gives which amplitude: `[B/b, clearance]`.
    #[serde(skip)]
    pub line: Line,
    /// The clearance with a fixed point at the fold.
    pub hopf: f64,
    /// The clearance at which two fixed points collide, their `B/b`, and the branch.
    pub collision: Option<(f64, f64, ManifoldBranch)>,
}

impl Bifurcations {
    /// Amplitudes `B/b` that are shown: both boundaries lie far inside.
    pub const AMPLITUDES: [f64; 2] = [0.5, 1.75];

    pub(super) fn of(study: &CaseStudy) -> Option<Self> {
        let (system, manifold) = (&study.analysis.system, &study.analysis.manifold);
        let meeting = study.analysis.boundaries.codimension_two;
        let known = meeting.forcing_over_clearance > 0.0 && meeting.detuning.is_finite();
        let folds = manifold.fold.oscillator_amplitude > 0.0;
        if !known || !folds {
            return None;
        }
        let away = system.detuning() - meeting.detuning;
        let away = away.abs().max(0.8).copysign(away);
        let middle = meeting.detuning;
        let condition = |part: f64| {
            Some(Condition::of(&system.with_detuning(middle + part * away).ok()?, manifold))
        };
        let conditions = [-1.0, 0.0, 1.0].into_iter().map(condition).collect::<Option<_>>()?;
        let first = (middle - 1.5 * away.abs()).max(-0.95 / system.mass_ratio());
        let borders = Borders::over(system, manifold, (first, middle + 1.5 * away.abs()));
        Some(Self { conditions, borders })
    }
}

impl Condition {
    fn of(there: &System, manifold: &Manifold) -> Self {
        let curve = FixedPointCurve::of(there, manifold);
        let gamma = there.forcing_per_clearance();
        let [first, last] = Bifurcations::AMPLITUDES;
        let at = |ratio: f64| [ratio, gamma / curve.forcing_squared(ratio).sqrt()];
        let line = even(first, last, SAMPLES).map(at).collect();
        let found = Boundaries::of(there, manifold);
        let collision = found.saddle_node.map(|node| {
            (gamma / node.forcing_over_clearance, node.absorber_amplitude, node.branch)
        });
        Self { ratio: there.frequency_ratio(), line, hopf: gamma / found.hopf, collision }
    }
}
