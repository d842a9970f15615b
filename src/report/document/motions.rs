//! The long-term motions: what they are, what proves it, where their energy goes.

use serde::Serialize;

use super::scale::{Scale, level_error};
use super::theory::ROOT_OF_ROUNDING;
use crate::method::Method::Simulation;
use crate::orbits::Origin;
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;
use crate::regimes::{Attractor, DynamicsKind, FoundAttractor, Regime};
use crate::simulation::{Doubt, Stop};
use crate::study::Proof;
use crate::system::System;

/// A motion that was measured.
#[derive(Debug, Clone, Serialize)]
pub struct MotionFacts {
    regime: Regime,
    dynamics: DynamicsKind,
    peak: Quantity,
    rms: Quantity,
    impacts_per_period: Quantity,
    impact_speed: Quantity,
    modulation: Quantity,
    capture_share: Quantity,
    contact_share: Quantity,
    change: Option<Quantity>,
    rms_change: Option<Quantity>,
    exponent: Option<Quantity>,
    captures: CaptureFacts,
    energy: EnergyFacts,
    /// Undamped and without impacts: its peak is that of its start.
    keeps_its_start: bool,
    settled: bool,
    /// Whether two halves of the window agree.
    stationary: bool,
    numerics: NumericsFacts,
    doubts: Vec<DoubtFacts>,
    proof: Option<ProofFacts>,
    /// Which starts led to it; none for a trajectory from one start.
    starts: Option<StartFacts>,
}

/// Stays in 1:1 resonance, in periods.
#[derive(Debug, Clone, Serialize)]
struct CaptureFacts {
    count: usize,
    mean: f64,
    longest: usize,
}

/// Energies of an excitation period.
#[derive(Debug, Clone, Serialize)]
struct EnergyFacts {
    work: Quantity,
    damper: Quantity,
    impacts: Quantity,
    per_impact: Option<Quantity>,
    efficiency: Option<Quantity>,
}

/// Quality of the simulation.
#[derive(Debug, Clone, Serialize)]
struct NumericsFacts {
    periods: u64,
    impacts: u64,
    /// Transient included.
    followed: u64,
    energy_residual: f64,
    penetration_over_clearance: f64,
    contacts: u64,
    stop: Stop,
    stopped_by: &'static str,
}

/// A reason not to trust a motion.
#[derive(Debug, Clone, Serialize)]
struct DoubtFacts {
    #[serde(flatten)]
    doubt: Doubt,
    words: String,
    advice: &'static str,
}

/// Energy flows and captures ride on impacts and amplitude and scatter as they do, captures most: between
/// runs of the shipped cases that differ in rounding only, some moved by twice as much.
const RIDES: f64 = 3.0;
/// Impacts may be locked to a whole number per period and then have no error; a motion that is modulated
/// moves by as much all the same, up to this share.
const WEAK_MODULATION: f64 = 0.01;
/// Fewer captures than this say nothing of how long they are.
const FEW_CAPTURES: usize = 10;

/// The relative error of an average that has none of its own; NaN where nothing is known of it.
fn error_of_averages(motion: &Attractor) -> f64 {
    let Some([rms, impacts]) = motion.errors() else { return 0.0 };
    let evidence = &motion.classification.evidence;
    let scatter = RIDES * (rms / motion.rms + impacts / evidence.impacts_per_period);
    let known = motion.rms > 0.0 && evidence.impacts_per_period > 0.0;
    if known { scatter.max(evidence.modulation_depth.min(WEAK_MODULATION)) } else { f64::NAN }
}

/// The exact orbit that a motion is.
#[derive(Debug, Clone, Serialize)]
struct ProofFacts {
    /// Walls in the order of the impacts, `+` and `-`.
    sequence: String,
    impacts: usize,
    periods: u32,
    /// Largest multiplier per period.
    multiplier: Quantity,
    residual: f64,
    origin: Origin,
    distance_from_simulation: f64,
}

/// Starts that lead to a motion.
#[derive(Debug, Clone, Serialize)]
struct StartFacts {
    count: u32,
    share: Quantity,
    /// 95 % interval of the share.
    interval: [Quantity; 2],
    /// Those that did so only after a long transient.
    late: u32,
    longest_transient: u64,
    from_theory: bool,
}

impl MotionFacts {
    /// One of those that many starts lead to.
    pub fn found(
        scale: &Scale,
        system: &System,
        found: &FoundAttractor,
        proof: Option<&Proof>,
    ) -> Self {
        let share = |value: f64| Quantity::new(&of::START_SHARE, value, Simulation);
        let reach = found.share_interval.map(|end| (end - found.share).abs());
        Self {
            starts: Some(StartFacts {
                count: found.starts,
                share: share(found.share).with_error(reach[0].max(reach[1])),
                interval: found.share_interval.map(share),
                late: found.late_starts,
                longest_transient: found.longest_transient,
                from_theory: found.reached_from_theory,
            }),
            ..Self::measured(scale, system, &found.attractor, proof)
        }
    }

    /// A motion by itself.
    pub fn measured(
        scale: &Scale,
        system: &System,
        motion: &Attractor,
        proof: Option<&Proof>,
    ) -> Self {
        let evidence = &motion.classification.evidence;
        let [rms_error, impacts_error] = motion.errors().unwrap_or_default();
        let number = |kind, value: f64| Quantity::new(kind, value, Simulation);
        let energetics = &motion.energetics;
        // Another run of a motion that does not repeat gives another extreme; nobody has measured by how much.
        let extreme = |kind, value: f64| {
            number(kind, value).with_error(if motion.repeats() { 0.0 } else { f64::NAN })
        };
        let level = |kind, value: Option<f64>, error: f64| {
            value.map(|value| number(kind, value).with_error(error))
        };
        let peak_error = level_error(motion.peak, motion.peak_error);
        let window = motion.periods.max(1) as f64 * system.period();
        Self {
            regime: motion.classification.regime,
            dynamics: motion.classification.dynamics,
            peak: scale.length_with(&of::PEAK, [motion.peak, motion.peak_error], Simulation),
            rms: scale.length_with(&of::RMS, [motion.rms, rms_error], Simulation),
            impacts_per_period: number(&of::IMPACTS_PER_PERIOD, evidence.impacts_per_period)
                .with_error(impacts_error),
            impact_speed: scale.velocity(
                &of::IMPACT_SPEED,
                [motion.impact_speed, motion.impact_speed_error],
                Simulation,
            ),
            modulation: extreme(&of::MODULATION, evidence.modulation_depth),
            capture_share: match evidence.captures.count {
                FEW_CAPTURES.. => number(&of::CAPTURE_SHARE, evidence.captures.share)
                    .with_error(error_of_averages(motion) * evidence.captures.share),
                _ => extreme(&of::CAPTURE_SHARE, evidence.captures.share),
            },
            contact_share: extreme(
                &of::CONTACT_SHARE,
                motion.sustained_contact.duration_tau / window,
            ),
            change: level(&of::CHANGE_DB, energetics.peak_change_db, peak_error),
            rms_change: level(
                &of::RMS_CHANGE_DB,
                energetics.rms_change_db,
                level_error(motion.rms, rms_error),
            ),
            exponent: evidence.exponent.as_ref().map(|exponent| {
                number(&of::LYAPUNOV_EXPONENT, exponent.per_period)
                    .with_error(2.0 * exponent.standard_error)
            }),
            captures: CaptureFacts {
                count: evidence.captures.count,
                mean: evidence.captures.mean,
                longest: evidence.captures.longest,
            },
            energy: EnergyFacts::of(scale, motion, system.period()),
            keeps_its_start: motion.keeps_its_start(),
            settled: motion.settled,
            stationary: evidence.settled,
            numerics: NumericsFacts::of(motion),
            doubts: motion.doubts().into_iter().map(DoubtFacts::of).collect(),
            proof: proof.map(ProofFacts::of),
            starts: None,
        }
    }
}

impl MotionFacts {
    /// The numbers that stand for a case.
    pub fn headline(&self) -> impl Iterator<Item = Quantity> {
        let known = [self.peak, self.rms, self.impacts_per_period, self.impact_speed];
        known.into_iter().chain(self.change).chain(self.rms_change)
    }
}

impl EnergyFacts {
    /// Per period of the excitation.
    fn of(scale: &Scale, motion: &Attractor, period: f64) -> Self {
        let energetics = &motion.energetics;
        let error = error_of_averages(motion);
        let energy = |kind, value: f64| {
            let energy = scale.energy(kind, value, Simulation);
            energy.with_error(error * energy.value.abs())
        };
        Self {
            work: energy(&of::WORK, energetics.input_power * period),
            damper: energy(&of::DAMPER_LOSS, energetics.damper_power * period),
            impacts: energy(&of::IMPACT_LOSS, energetics.loss_per_period),
            per_impact: energetics.loss_per_impact.map(|one| energy(&of::LOSS_PER_IMPACT, one)),
            efficiency: energetics
                .transfer_efficiency
                .map(|one| Quantity::new(&of::EFFICIENCY, one, Simulation).with_error(error * one)),
        }
    }
}

impl NumericsFacts {
    fn of(motion: &Attractor) -> Self {
        Self {
            periods: motion.periods,
            impacts: motion.impact_count,
            followed: motion.followed,
            energy_residual: motion.energy.relative_residual,
            penetration_over_clearance: motion.penetration,
            contacts: motion.sustained_contact.intervals,
            stop: motion.stop,
            stopped_by: motion.stop.words(),
        }
    }
}

impl DoubtFacts {
    fn of(doubt: Doubt) -> Self {
        Self { doubt, words: doubt.words(), advice: doubt.advice() }
    }
}

impl ProofFacts {
    fn of(proof: &Proof) -> Self {
        let orbit = &proof.orbit;
        Self {
            sequence: orbit.cycle.sequence(),
            impacts: orbit.cycle.impact_count(),
            periods: orbit.cycle.periods(),
            multiplier: Quantity::new(
                &of::SPECTRAL_RADIUS,
                orbit.radius_per_period(),
                crate::method::Method::ExactOrbit,
            )
            .with_error(ROOT_OF_ROUNDING * orbit.radius_per_period()),
            residual: orbit.convergence.residual,
            origin: orbit.origin,
            distance_from_simulation: proof.distance,
        }
    }
}
