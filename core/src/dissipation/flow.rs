//! The slow flow on the dissipation curve: steady amplitudes in every regime, their stability, frequency response,
//! and decay without excitation through all regimes.
//!
//! Equations: [`crate::equations::dissipation`], with `S` and `K` linear between the points of a branch, so that a
//! steady amplitude is the root of a quadratic. Of a chaotic motion the averages alone enter: it wanders about its
//! steady amplitude, and where it switches to another motion the flow says neither when nor whether.

use serde::Serialize;

use super::branch::PairBranch;
use super::curve::DissipationCurve;
use super::pair::PairPoint;
use crate::analysis::{self, Analysis, AnalysisError, FreeDecay};
use crate::equations::dissipation::{
    DECAY, DETERMINANT, LOWER_DETUNING, RESPONSE_ROOT, TRACE, UPPER_DETUNING,
};
use crate::regimes::Regime;
use crate::system::System;

/// Difference of impacts per period up to which two steady amplitudes at one place are one, of a motion that does
/// not repeat: what its scatter does.
const SAME_IMPACTS: f64 = 0.2;
/// Largest gap between the end of a branch and the next in a decay, over the clearance: beyond a step.
const GAP: f64 = 0.04;

/// A steady amplitude: a fixed point of the slow flow on one branch of the curve.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SteadyState {
    /// Amplitude of `v = x + eps y`, `C/b`.
    pub amplitude: f64,
    /// By how much what is not known of `S` and `K` may move it; the error of the theory, of first order in the
    /// mass ratio, is not in it.
    pub amplitude_error: f64,
    /// Phase of the excitation against the oscillator.
    pub eta: f64,
    /// The branch, by its place in [`DissipationCurve::branches`].
    pub branch: usize,
    /// What the impacts do.
    pub regime: Regime,
    /// Impacts per period of the oscillator.
    pub impacts_per_period: f64,
    /// Trace of the flow's Jacobian, per slow time.
    pub trace: f64,
    /// Its determinant.
    pub determinant: f64,
    /// Whether the flow returns to it.
    pub stable: bool,
}

/// An amplitude on its way down.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct DecayPoint {
    /// Slow time `eps tau` since the beginning.
    pub slow_time: f64,
    /// `C/b`.
    pub amplitude: f64,
    /// The branch, by its place in [`DissipationCurve::branches`].
    pub branch: usize,
}

/// The slow flow of a system in every regime.
///
/// Table 1 of Li, Seguy, Berlioz (2016) at 8.35 Hz with a clearance of 11.5 mm, whose base moves by 0.25 mm:
///
/// ```
/// # use vinesink_core::system::{Cavity, Excitation, Parameters, System};
/// # let system = System::new(Parameters {
/// #     mass_ratio: 0.032 / 4.168, damping: 1.799, restitution: 0.6, frequency_ratio: 8.35 / 8.349,
/// #     forcing_per_clearance: 0.25 * 4.168 / 0.032 / 11.5, excitation: Excitation::BaseDisplacement,
/// #     cavity: Cavity::IDEAL,
/// # })?;
/// use vinesink_core::dissipation::{AveragedFlow, DissipationCurve};
///
/// let curve = DissipationCurve::of(system.restitution(), [0.7, 1.5]);
/// let states = AveragedFlow::of(&system, &curve).steady_states()?;
/// // Three impacts per period, of which the theory of two knows nothing.
/// let three = states.iter().find(|state| state.stable && state.impacts_per_period == 3.0).expect("one");
/// assert!((three.amplitude - 1.018).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct AveragedFlow<'a> {
    system: System,
    curve: &'a DissipationCurve,
}

impl<'a> AveragedFlow<'a> {
    /// The flow of a system, with the curve of its restitution.
    pub fn of(system: &System, curve: &'a DissipationCurve) -> Self {
        Self { system: *system, curve }
    }

    /// All steady amplitudes within the range of the curve, ascending. On the manifold's stable branch they are the
    /// fixed points of [`crate::analysis`].
    ///
    /// # Errors
    /// [`AnalysisError`] where those cannot be computed.
    pub fn steady_states(&self) -> Result<Vec<SteadyState>, AnalysisError> {
        let mut found = Vec::new();
        for (index, branch) in self.curve.branches.iter().enumerate() {
            if branch.closed_form {
                found.extend(self.fixed_points(index)?);
            } else {
                found.extend(self.on(index, branch));
            }
        }
        found.sort_by(|a: &SteadyState, b| a.amplitude.total_cmp(&b.amplitude));
        found.dedup_by(|next, kept| is_same(kept, next));
        Ok(found)
    }

    /// The two detunings `sigma` at which the system's forcing holds a motion of the curve; none where it is too
    /// weak. Over all points of a branch that is the frequency response.
    pub fn detunings(&self, point: &PairPoint) -> Option<[f64; 2]> {
        let (lambda, gamma) = (self.system.damping(), self.system.forcing_per_clearance());
        let [resistance, reactance] = point.forces();
        let c = point.amplitude;
        let root = RESPONSE_ROOT.at([lambda, gamma, resistance, c]);
        let both =
            [LOWER_DETUNING.at([reactance, c, root]), UPPER_DETUNING.at([reactance, c, root])];
        both.iter().all(|detuning| detuning.is_finite()).then_some(both)
    }

    /// The same with whether the motion, on its branch, is stable at each of the two.
    pub fn stability(&self, branch: &PairBranch, point: &PairPoint) -> Option<[(f64, bool); 2]> {
        let slopes = branch.slopes(point.amplitude);
        let stable = |sigma: f64| {
            let [trace, determinant] =
                self.jacobian(sigma, point.amplitude, point.forces(), slopes);
            (sigma, trace < 0.0 && determinant > 0.0)
        };
        self.detunings(point).map(|both| both.map(stable))
    }

    /// Trace and determinant at a detuning, with `S` and `K` and their slopes.
    fn jacobian(&self, sigma: f64, c: f64, [s, k]: [f64; 2], [ds, dk]: [f64; 2]) -> [f64; 2] {
        let lambda = self.system.damping();
        [TRACE.at([lambda, s, ds, c]), DETERMINANT.at([lambda, sigma, s, k, ds, dk, c])]
    }

    /// The fall of the amplitude without excitation from `C/b` to a smaller one: on each branch as far as it goes,
    /// then on the one whose force is nearest; the absorber is at rest where there is none. The first is the branch
    /// that comes from the largest amplitude, one on which the absorber moves if there is any. Ends early where nothing takes energy.
    pub fn decay(&self, from: f64, to: f64) -> Vec<DecayPoint> {
        let mut path = Vec::new();
        let branches = self.curve.branches.iter().enumerate();
        let begins = |(_, branch): &(usize, &PairBranch)| branch.covers(from);
        let moves = |branch: &PairBranch| branch.points[0].regime != Regime::AtRest;
        let highest = |a: &(usize, &PairBranch), b: &(usize, &PairBranch)| {
            let by_end = a.1.range()[1].total_cmp(&b.1.range()[1]);
            moves(a.1).cmp(&moves(b.1)).then(by_end)
        };
        let mut next = branches.filter(begins).max_by(highest).map(|(index, _)| (index, from));
        let mut slow_time = 0.0;
        while let Some((index, top)) = next {
            let branch = &self.curve.branches[index];
            path.push(DecayPoint { slow_time, amplitude: top, branch: index });
            let [bottom, _] = branch.range();
            let within = |amplitude: &f64| *amplitude < top && *amplitude > to;
            let inner = branch.points.iter().rev().map(|point| point.amplitude).filter(within);
            let mut above = top;
            for amplitude in inner.chain((bottom <= to && to < top).then_some(to)) {
                let time = self.fall(branch, above, amplitude);
                if !time.is_finite() || time < 0.0 {
                    return path;
                }
                slow_time += time;
                above = amplitude;
                path.push(DecayPoint { slow_time, amplitude, branch: index });
            }
            next = if above > to { self.below(index, above) } else { None };
        }
        path
    }

    /// Slow time from one amplitude of a piece of a branch down to another.
    fn fall(&self, branch: &PairBranch, from: f64, to: f64) -> f64 {
        if branch.closed_form {
            return FreeDecay::of(&self.system).time(from, to).unwrap_or(f64::NAN);
        }
        let rate = |amplitude: f64| {
            let force = branch.forces(amplitude).map_or(f64::NAN, |(forces, _)| forces[0]);
            DECAY.at([self.system.damping(), force, amplitude])
        };
        // The rate is linear in between: its logarithmic mean counts.
        let [fast, slow] = [from, to].map(rate);
        let relative = (fast - slow) / slow;
        let mean = if relative == 0.0 { 1.0 } else { libm::log1p(relative) / relative };
        (to - from) / slow * mean
    }

    /// The branch on which a decay goes on below the end of another, and where.
    fn below(&self, left: usize, end: f64) -> Option<(usize, f64)> {
        let old = &self.curve.branches[left];
        let (forces, _) = old.forces(end)?;
        let others = self.curve.branches.iter().enumerate().filter(|(index, _)| *index != left);
        let distance = |(index, branch): (usize, &PairBranch)| {
            let [bottom, top] = branch.range();
            let at = end.min(top);
            let near = bottom < end && end - at < GAP;
            let (theirs, _) = branch.forces(at).filter(|_| near)?;
            let still = branch.points[0].regime == Regime::AtRest;
            let apart = libm::hypot(theirs[0] - forces[0], theirs[1] - forces[1]);
            Some((still, apart, index, at))
        };
        let mut near: Vec<_> = others.filter_map(distance).collect();
        near.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        near.first().map(|(_, _, index, at)| (*index, *at))
    }

    fn fixed_points(&self, branch: usize) -> Result<Vec<SteadyState>, AnalysisError> {
        let analysis = Analysis::of(&self.system)?;
        let stable = |point: &&analysis::FixedPoint| {
            point.branch == analysis::ManifoldBranch::Stable && point.admissible
        };
        let state = |point: &analysis::FixedPoint| SteadyState {
            amplitude: point.oscillator_amplitude,
            amplitude_error: f64::EPSILON * point.oscillator_amplitude,
            eta: point.eta,
            branch,
            regime: Regime::TwoSymmetric,
            impacts_per_period: 2.0,
            trace: point.trace,
            determinant: point.determinant,
            stable: point.stable,
        };
        Ok(analysis.fixed_points.iter().filter(stable).map(state).collect())
    }

    /// Steady amplitudes on a branch that was followed.
    fn on(&self, index: usize, branch: &PairBranch) -> Vec<SteadyState> {
        let (lambda, sigma) = (self.system.damping(), self.system.detuning());
        let gamma = self.system.forcing_per_clearance();
        let mut found = Vec::new();
        for (at, ends) in branch.points.windows(2).enumerate() {
            let [from, to] = [&ends[0], &ends[1]];
            let slopes = branch.piece_slopes(at);
            // gamma^2 is the sum of the squares of two lines over c - c_0.
            let at_from = [
                lambda * from.amplitude + from.resistance,
                2.0 * sigma * from.amplitude - from.reactance,
            ];
            let by = [lambda + slopes[0], 2.0 * sigma - slopes[1]];
            let square = by[0] * by[0] + by[1] * by[1];
            let half = at_from[0] * by[0] + at_from[1] * by[1];
            let excess = at_from[0] * at_from[0] + at_from[1] * at_from[1] - gamma * gamma;
            let root = (half * half - square * excess).sqrt();
            let far = -(half + root.copysign(half));
            let length = to.amplitude - from.amplitude;
            let roots = [far / square, excess / far];
            let within = |shift: &f64| (0.0..=length).contains(shift);
            found.extend(roots.into_iter().filter(within).map(|shift| {
                let nearer = if 2.0 * shift < length { from } else { to };
                self.state(index, branch, from.amplitude + shift, nearer)
            }));
        }
        found
    }

    fn state(&self, index: usize, branch: &PairBranch, c: f64, nearer: &PairPoint) -> SteadyState {
        let (lambda, sigma) = (self.system.damping(), self.system.detuning());
        let unknown = ([f64::NAN; 2], [f64::NAN; 2]);
        let ([resistance, reactance], errors) = branch.forces(c).unwrap_or(unknown);
        let sides = [lambda * c + resistance, reactance - 2.0 * sigma * c];
        let [trace, determinant] =
            self.jacobian(sigma, c, [resistance, reactance], branch.slopes(c));
        // d(gamma^2)/dc is 8 c times the determinant.
        let moved = sides[0].abs() * errors[0] + sides[1].abs() * errors[1];
        SteadyState {
            amplitude: c,
            amplitude_error: moved / (4.0 * c * determinant).abs() + f64::EPSILON * c,
            eta: libm::atan2(sides[0], sides[1]),
            branch: index,
            regime: nearer.regime,
            impacts_per_period: nearer.impacts_per_period,
            trace,
            determinant,
            stable: trace < 0.0 && determinant > 0.0,
        }
    }
}

/// Whether two neighbouring steady amplitudes are one: at the point that two pieces or branches share, or as far as
/// the scatter of averages tells.
fn is_same(a: &SteadyState, b: &SteadyState) -> bool {
    let close = (a.amplitude - b.amplitude).abs() <= a.amplitude_error + b.amplitude_error;
    close
        && a.regime == b.regime
        && (a.impacts_per_period - b.impacts_per_period).abs() < SAME_IMPACTS
}
