//! Several absorbers at leading order: one mode, 1:1 resonance, each absorber on the stable branch of its own manifold.
//!
//! The mode moves by `C sin(tau + theta)`; at the place of an absorber by `abs(phi_j) C`, so that the clearance in units of
//! the mode's coordinate is `b_j/abs(phi_j)`, and the mass ratio is `eps_j = m_j phi_j^2/M`. Each absorber meets the mode by
//! equations (14) to (16) of Li, Seguy, Berlioz (2016) by itself, whatever the others do, and the forces on the mode add up in
//! (18) by the shares `mu_j = eps_j/eps`, `eps = sum eps_j`:
//!
//! `dC/dtau1 = (-lambda C - S + G sin eta)/2`, `d eta/dtau1 = sigma + (G cos eta - K)/(2 C)`,
//! `S = sum mu_j S_j`, `K = sum mu_j K_j`, `S_j = (16/pi^3) rho_j B_j^2/C`, `K_j = (8/pi^2) B_j (b_j - B_j)/C`.
//!
//! So `G^2 = (lambda C + S)^2 + (2 sigma C - K)^2`: fixed points are the roots of one function of `C`, and the frequency
//! response needs no continuation. The Jacobian has the determinant `(d G^2/dC)/(8 C)`: saddle-nodes are where `G^2` is level.

use std::f64::consts::{PI, TAU};

use serde::Serialize;

use super::Manifold;
use crate::equations::dissipation::{REACTANCE, RESISTANCE};
use crate::numerics::bracket::bisected;
use crate::system::{ModalSystem, Mode};

/// Amplitudes at which roots are looked for.
const COUNT: usize = 2000;

/// Amplitudes of the structure over the clearance at which an absorber is in symmetric 1:1 resonance, and by what ratio
/// clearances that are neighbours may differ for one to take over from the other.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Grading {
    /// `C/b` at the fold, `sqrt(R/(1 + R))`.
    pub lower: f64,
    /// `C/b` at symmetry breaking, `sqrt(u^2 + R (1 + u)^2)` with `u = 4/(pi^2 - 4)`.
    pub upper: f64,
    /// `upper/lower`.
    pub ratio: f64,
}

impl Grading {
    /// That of a restitution.
    ///
    /// ```
    /// use vinesink_core::analysis::Grading;
    ///
    /// let grading = Grading::of(0.6);
    /// assert!((grading.lower - 0.1572).abs() < 5e-5 && (grading.upper - 0.7321).abs() < 5e-5);
    /// ```
    pub fn of(restitution: f64) -> Self {
        let manifold = Manifold::of(restitution);
        let [lower, upper] =
            [manifold.fold, manifold.symmetry_breaking].map(|end| end.oscillator_amplitude);
        Self { lower, upper, ratio: upper / lower }
    }
}

/// An absorber as the theory sees it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct GroupMember {
    /// `mu_j`, its share of the mass ratio.
    pub share: f64,
    /// `b_j/abs(phi_j)`.
    pub clearance: f64,
    /// Its manifold, lengths over that clearance.
    pub manifold: Manifold,
}

/// One mode with several absorbers at leading order. Lengths are those of the mode's coordinate, time is that of its own
/// frequency.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AbsorberGroup {
    /// `eps`, the sum of all mass ratios.
    pub mass_ratio: f64,
    /// `lambda = 2 zeta/eps`.
    pub damping: f64,
    /// `sigma = (Omega/w - 1)/eps`.
    pub detuning: f64,
    /// `G = F/(w^2 eps)`.
    pub forcing: f64,
    /// The absorbers.
    pub members: Vec<GroupMember>,
}

/// A fixed point of a group: a steady 1:1 motion as the theory sees it.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct GroupFixedPoint {
    /// `C`.
    pub amplitude: f64,
    /// `B_j`.
    pub absorber_amplitudes: Vec<f64>,
    /// Phase of the excitation against the mode.
    pub eta: f64,
    /// Trace of the slow flow's Jacobian.
    pub trace: f64,
    /// Its determinant.
    pub determinant: f64,
    /// Whether both of its eigenvalues have a negative real part, and each absorber is between fold and symmetry breaking.
    pub stable: bool,
}

/// The forces of all absorbers at one amplitude, and their derivatives by it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct GroupForces {
    /// `S`, against the velocity.
    pub resistance: f64,
    /// `K`.
    pub reactance: f64,
    /// `dS/dC`.
    pub resistance_slope: f64,
    /// `dK/dC`.
    pub reactance_slope: f64,
}

impl AbsorberGroup {
    /// The absorbers of a system on one of its modes, from 0; the others enter in no way: see [`apparent_restitution`] and
    /// [`scattered`]. An absorber that sits in a node of the mode is left out. `None` where all do, or there is no such mode.
    pub fn of(system: &ModalSystem, mode: usize) -> Option<Self> {
        let own = system.modes().get(mode)?;
        let ratio = |j: usize| system.modal_mass_ratio(own, j);
        let indices = 0..system.absorbers().len();
        let mass_ratio: f64 = indices.clone().map(ratio).sum();
        let members = indices.filter(|j| own.shape[*j] != 0.0).map(|j| GroupMember {
            share: ratio(j) / mass_ratio,
            clearance: system.absorbers()[j].clearance / own.shape[j].abs(),
            manifold: Manifold::of(system.absorbers()[j].restitution),
        });
        (mass_ratio > 0.0).then(|| Self {
            mass_ratio,
            damping: 2.0 * own.damping_ratio / mass_ratio,
            detuning: (system.frequency_ratio() / own.frequency - 1.0) / mass_ratio,
            forcing: system.modal_forcing(mode).abs()
                / (own.frequency * own.frequency * mass_ratio),
            members: members.collect(),
        })
    }

    /// The same with the [`effective_restitutions`] that impacts seem to have as they set the other modes in motion too. `None` also where
    /// one is below 0: impacts then shake the others more than the mode.
    pub fn beside_others(system: &ModalSystem, mode: usize) -> Option<Self> {
        let restitutions = effective_restitutions(system, mode)?;
        if restitutions.iter().any(|one| *one < 0.0) {
            return None;
        }
        let mut parameters = system.parameters().clone();
        for (one, effective) in parameters.absorbers.iter_mut().zip(restitutions) {
            one.restitution = effective;
        }
        Self::of(&ModalSystem::new(parameters).ok()?, mode)
    }

    /// The amplitudes at which every absorber is in symmetric 1:1 resonance, if there are any.
    pub fn range(&self) -> Option<[f64; 2]> {
        let ends = self.members.iter().map(|member| {
            let Manifold { fold, symmetry_breaking, .. } = member.manifold;
            [fold, symmetry_breaking].map(|end| end.oscillator_amplitude * member.clearance)
        });
        let [from, to] =
            ends.fold([0.0, f64::INFINITY], |[a, b]: [f64; 2], [c, d]| [a.max(c), b.min(d)]);
        (from < to).then_some([from, to])
    }

    /// `S` and `K` at an amplitude on the upper branch of every manifold; `None` below a fold.
    pub fn forces(&self, amplitude: f64) -> Option<GroupForces> {
        let none = GroupForces {
            resistance: 0.0,
            reactance: 0.0,
            resistance_slope: 0.0,
            reactance_slope: 0.0,
        };
        self.members.iter().try_fold(none, |sum, member| {
            let GroupMember { share, clearance, manifold } = *member;
            let c = amplitude / clearance;
            let beta = manifold.stable_absorber(c)?;
            let shift = beta - 1.0;
            let rho = manifold.restitution_ratio;
            let (s, k) = (RESISTANCE.at([rho, beta, c]), REACTANCE.at([beta, shift, c]));
            // beta = (1 + w)/(1 + R) with w^2 = (1 + R) c^2 - R: a slope c/w.
            let slope = c / ((1.0 + manifold.curvature) * beta - 1.0);
            let s_slope = s * (2.0 * slope / beta - 1.0 / c);
            let k_slope = 8.0 / (PI * PI) * (1.0 - 2.0 * beta) * slope / c - k / c;
            Some(GroupForces {
                resistance: sum.resistance + share * clearance * s,
                reactance: sum.reactance + share * clearance * k,
                resistance_slope: sum.resistance_slope + share * s_slope,
                reactance_slope: sum.reactance_slope + share * k_slope,
            })
        })
    }

    /// `G^2` that holds an amplitude, and its derivative by the amplitude; `None` below a fold.
    pub fn forcing_squared(&self, amplitude: f64) -> Option<[f64; 2]> {
        let forces = self.forces(amplitude)?;
        let active = self.damping * amplitude + forces.resistance;
        let idle = 2.0 * self.detuning * amplitude - forces.reactance;
        let slope = active * (self.damping + forces.resistance_slope)
            + idle * (2.0 * self.detuning - forces.reactance_slope);
        Some([active * active + idle * idle, 2.0 * slope])
    }

    /// The two detunings at which the forcing holds an amplitude, ascending; `None` below a fold, or where the forcing is too
    /// small for it.
    pub fn detunings(&self, amplitude: f64) -> Option<[f64; 2]> {
        let forces = self.forces(amplitude)?;
        let active = self.damping * amplitude + forces.resistance;
        let idle = (self.forcing - active) * (self.forcing + active);
        (idle >= 0.0).then(|| {
            [-idle.sqrt(), idle.sqrt()].map(|root| (forces.reactance + root) / (2.0 * amplitude))
        })
    }

    /// The fixed points between the largest fold and one and a half times the largest amplitude of symmetry breaking, by
    /// ascending amplitude.
    pub fn fixed_points(&self) -> Vec<GroupFixedPoint> {
        let square = self.forcing * self.forcing;
        let roots = self.roots(|c| Some(self.forcing_squared(c)?[0] - square));
        roots.into_iter().filter_map(|c| self.fixed_point(c)).collect()
    }

    /// Where two fixed points collide: amplitude and forcing, by ascending amplitude, in the same range.
    pub fn saddle_nodes(&self) -> Vec<[f64; 2]> {
        let roots = self.roots(|c| Some(self.forcing_squared(c)?[1]));
        let point = |c| Some([c, self.forcing_squared(c)?[0].sqrt()]);
        roots.into_iter().filter_map(point).collect()
    }

    fn fixed_point(&self, amplitude: f64) -> Option<GroupFixedPoint> {
        let forces = self.forces(amplitude)?;
        let active = self.damping * amplitude + forces.resistance;
        let idle = forces.reactance - 2.0 * self.detuning * amplitude;
        let trace =
            -self.damping - 0.5 * forces.resistance_slope - 0.5 * forces.resistance / amplitude;
        let determinant = self.forcing_squared(amplitude)?[1] / (8.0 * amplitude);
        let within = self.range().is_some_and(|[from, to]| (from..=to).contains(&amplitude));
        let absorber = |member: &GroupMember| {
            let beta = member.manifold.stable_absorber(amplitude / member.clearance);
            beta.map(|beta| beta * member.clearance)
        };
        Some(GroupFixedPoint {
            amplitude,
            absorber_amplitudes: self.members.iter().filter_map(absorber).collect(),
            eta: libm::atan2(active, idle),
            trace,
            determinant,
            stable: trace < 0.0 && determinant > 0.0 && within,
        })
    }

    /// Roots of a function of the amplitude.
    fn roots(&self, function: impl Fn(f64) -> Option<f64>) -> Vec<f64> {
        let end = |of: fn(&Manifold) -> f64| {
            let ends = self.members.iter().map(|one| of(&one.manifold) * one.clearance);
            ends.fold(0.0, f64::max)
        };
        let from = end(|one| one.fold.oscillator_amplitude) * (1.0 + 1e-12);
        let to = 1.5 * end(|one| one.symmetry_breaking.oscillator_amplitude).max(from);
        let value = |c: f64| function(c).unwrap_or(f64::NAN);
        // Closer together towards the fold, where branches are steep.
        let place = |n: usize| {
            let part = n as f64 / COUNT as f64;
            from + (to - from) * part * part
        };
        let pairs = (0..COUNT).map(|n| [place(n), place(n + 1)]);
        pairs.filter_map(|pair| bisected(pair, value)).filter(|c| value(*c).is_finite()).collect()
    }
}

/// Relative size of what the expansion to leading order neglects, `eps (2 + abs(sigma) + lambda)`: terms that are `eps` times the kept
/// ones, with coefficients made of 1, `sigma` and `lambda`.
pub fn neglected_at_leading_order(mass_ratio: f64, detuning: f64, damping: f64) -> f64 {
    mass_ratio * (2.0 + detuning.abs() + damping)
}

/// Restitution that a model of one mode needs where impacts also set other modes in motion that are well damped:
/// `r_app = (1 + r)(1 + eps_n)/(1 + e) - 1`, from a drop test's `r`, the mass ratio `eps_n` of the mode that is kept and the
/// sum `e` of all. A restitution fitted on the structure is already this one.
pub fn apparent_restitution(restitution: f64, kept: f64, all: f64) -> f64 {
    (1.0 + restitution) * (1.0 + kept) / (1.0 + all) - 1.0
}

/// The restitution that impacts of each absorber of a system seem to have in a model of one of its modes, in symmetric 1:1 motion;
/// `None` where there is no such mode, or another is as heavily damped as to not vibrate.
///
/// With `e_j` the sum of all `eps_kj` and `s_k` what is [`scattered`] into mode `k`, the other modes move the absorber's place right
/// after an impact as fast as `A = (1 - r + 2 e)/(1 + r) - sum eps_k (1 - s_k)`, and
///
/// `r_n = (1 + 2 eps_n - A)/(1 + A)`:
///
/// condition (2) of an antiperiodic orbit for all modes, written as that of mode `n` alone. Where the others are well damped, `s_k = 1`,
/// that is [`apparent_restitution`].
pub fn effective_restitutions(system: &ModalSystem, mode: usize) -> Option<Vec<f64>> {
    let own = system.modes().get(mode)?;
    let others = (0..system.modes().len()).filter(|k| *k != mode);
    let each = system.absorbers().iter().enumerate().map(|(j, one)| {
        let r = one.restitution;
        let kept = |k: usize| {
            let back = 1.0 - scattered(UnforcedMode::of(system, k));
            system.modal_mass_ratio(&system.modes()[k], j) * back
        };
        let all = (1.0 - r + 2.0 * system.mass_ratio(j)) / (1.0 + r);
        let a = all - others.clone().map(kept).sum::<f64>();
        (1.0 + 2.0 * system.modal_mass_ratio(own, j) - a) / (1.0 + a)
    });
    Some(each.collect())
}

/// A mode that is not forced, under impulses of alternating sign every half period of the excitation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct UnforcedMode {
    /// `w`.
    pub frequency: f64,
    /// `zeta`, below 1.
    pub damping_ratio: f64,
    /// `Omega`.
    pub excitation: f64,
}

impl UnforcedMode {
    /// A mode of a system, from 0, as if nothing forced it.
    pub fn of(system: &ModalSystem, mode: usize) -> Self {
        let Mode { frequency, damping_ratio, .. } = system.modes()[mode];
        Self { frequency, damping_ratio, excitation: system.frequency_ratio() }
    }
}

/// The energy that each impact of a symmetric 1:1 motion scatters into a mode that is not forced, over that which it would on
/// the average over a random phase, `J^2 phi^2/(2 M)` with the impulse `J`:
///
/// `(sinh a + zeta/sqrt(1 - zeta^2) sin beta)/(cosh a + cos beta)`, `a = zeta w T/2`, `beta = w_d T/2`.
///
/// The mode's antiperiodic velocity right before an impulse is what `(I + Phi(T/2))^-1` leaves of the ones before; the work
/// of an impulse is that of the mean velocity over it. Resonant where `w_d` is an odd multiple of `Omega`.
///
/// ```
/// use vinesink_core::analysis::{UnforcedMode, scattered};
///
/// let near_fifth = UnforcedMode { frequency: 5.05, damping_ratio: 0.005, excitation: 1.01 };
/// assert!((scattered(near_fifth) - 25.478_039).abs() < 1e-6);
/// ```
pub fn scattered(mode: UnforcedMode) -> f64 {
    let UnforcedMode { frequency, damping_ratio, excitation } = mode;
    let half = 0.5 * TAU / excitation;
    let root = ((1.0 - damping_ratio) * (1.0 + damping_ratio)).sqrt();
    let (sin, cos) = libm::sincos(frequency * root * half);
    // Over half of `e^a`, which may be a number too large.
    let faded = libm::exp(-(damping_ratio * frequency * half));
    let (less, more) = (1.0 - faded * faded, 1.0 + faded * faded);
    (less + 2.0 * faded * damping_ratio / root * sin) / (more + 2.0 * faded * cos)
}
