//! The long-term motions: what they are, what proves it, where their energy goes.

use serde_json::{Value, json};

use super::scale::{Scale, level_error};
use super::theory::ROOT_OF_ROUNDING;
use crate::method::Method::{ExactOrbit, Simulation};
use crate::quantity::catalogue as of;
use crate::quantity::{Kind, Quantity};
use crate::regimes::{Attractor, FoundAttractor};
use crate::study::Proof;
use crate::system::System;

/// Energy flows and captures ride on impacts and amplitude and scatter as they do, captures most: between
/// runs of the shipped cases that differ in rounding only, some moved by twice as much.
const RIDES: f64 = 3.0;
/// Impacts may be locked to a whole number per period and then have no error; a motion that is modulated
/// moves by as much all the same, up to this share.
const WEAK_MODULATION: f64 = 0.01;
/// Fewer captures than this say nothing of how long they are.
const FEW_CAPTURES: usize = 10;

/// One of the motions that many starts lead to, with those starts.
pub fn found(
    scale: &Scale,
    system: &System,
    found: &FoundAttractor,
    proof: Option<&Proof>,
) -> Value {
    let share = |value: f64| Quantity::new(&of::START_SHARE, value, Simulation);
    let reach = found.share_interval.map(|end| (end - found.share).abs());
    let mut motion = measured(scale, system, &found.attractor, proof);
    motion["starts"] = json!({
        "count": found.starts,
        "share": share(found.share).with_error(reach[0].max(reach[1])),
        // 95 % interval of the share.
        "interval": found.share_interval.map(share),
        // Those that did so only after a long transient.
        "late": found.late_starts,
        "longest_transient": found.longest_transient,
        "from_theory": found.reached_from_theory,
    });
    motion
}

/// A motion that was measured, from whatever start.
pub fn measured(
    scale: &Scale,
    system: &System,
    motion: &Attractor,
    proof: Option<&Proof>,
) -> Value {
    let evidence = &motion.classification.evidence;
    let captures = &evidence.captures;
    // Another run of a motion that does not repeat gives another extreme; nobody has measured by how much.
    let extreme = |kind, value: f64| {
        let error = if motion.repeats() { 0.0 } else { f64::NAN };
        Quantity::new(kind, value, Simulation).with_error(error)
    };
    let capture_share = match captures.count {
        FEW_CAPTURES.. => Quantity::new(&of::CAPTURE_SHARE, captures.share, Simulation)
            .with_error(error_of_averages(motion) * captures.share),
        _ => extreme(&of::CAPTURE_SHARE, captures.share),
    };
    let window = motion.periods.max(1) as f64 * system.period();
    let contacts = &motion.sustained_contact;
    let exponent = evidence.exponent.as_ref().map(|exponent| {
        Quantity::new(&of::LYAPUNOV_EXPONENT, exponent.per_period, Simulation)
            .with_error(2.0 * exponent.standard_error)
    });
    let mut told = json!({
        "regime": motion.classification.regime,
        "dynamics": motion.classification.dynamics,
        "modulation": extreme(&of::MODULATION, evidence.modulation_depth),
        "capture_share": capture_share,
        "contact_share": extreme(&of::CONTACT_SHARE, contacts.duration_tau / window),
        "change": null,
        "rms_change": null,
        "exponent": exponent,
        // Stays in 1:1 resonance, in periods.
        "captures": { "count": captures.count, "mean": captures.mean, "longest": captures.longest },
        "energy": energy(scale, motion, system),
        // Undamped and without impacts: its peak is that of its start.
        "keeps_its_start": motion.keeps_its_start(),
        "settled": motion.settled,
        // Whether two halves of the window agree.
        "stationary": evidence.settled,
        "numerics": numerics(motion),
        "doubts": doubts(motion),
        "proof": proof.map(proven),
        "starts": null,
    });
    for (key, quantity) in headline(scale, motion) {
        told[key] = json!(quantity);
    }
    told
}

/// Quality of the simulation.
fn numerics(motion: &Attractor) -> Value {
    json!({
        "periods": motion.periods,
        "impacts": motion.impact_count,
        // Transient included.
        "followed": motion.followed,
        "energy_residual": motion.energy.relative_residual,
        "penetration_over_clearance": motion.penetration,
        "contacts": motion.sustained_contact.intervals,
        "stop": motion.stop,
        "stopped_by": motion.stop.words(),
    })
}

/// Reasons not to trust a motion, in words with what to do.
fn doubts(motion: &Attractor) -> Vec<Value> {
    let doubts = motion.doubts().into_iter().map(|doubt| {
        let mut told = json!(doubt);
        told["words"] = json!(doubt.words());
        told["advice"] = json!(doubt.advice());
        told
    });
    doubts.collect()
}

/// The numbers that stand for a case, by their key in a motion.
pub fn headline(scale: &Scale, motion: &Attractor) -> Vec<(&'static str, Quantity)> {
    let [rms_error, impacts_error] = motion.errors().unwrap_or_default();
    let speed = [motion.impact_speed, motion.impact_speed_error];
    let impacts = motion.classification.evidence.impacts_per_period;
    let number =
        |kind, value: f64, error: f64| Quantity::new(kind, value, Simulation).with_error(error);
    let length = |kind, value| scale.length_with(kind, value, Simulation);
    let level = |key, kind: &'static Kind, change: Option<f64>, of: [f64; 2]| {
        change.map(|value| (key, number(kind, value, level_error(of[0], of[1]))))
    };
    let (peak, rms) = ([motion.peak, motion.peak_error], [motion.rms, rms_error]);
    let energetics = &motion.energetics;
    let known = [
        ("peak", length(&of::PEAK, peak)),
        ("rms", length(&of::RMS, rms)),
        ("impacts_per_period", number(&of::IMPACTS_PER_PERIOD, impacts, impacts_error)),
        ("impact_speed", scale.velocity(&of::IMPACT_SPEED, speed, Simulation)),
    ];
    let changes = [
        level("change", &of::CHANGE_DB, energetics.peak_change_db, peak),
        level("rms_change", &of::RMS_CHANGE_DB, energetics.rms_change_db, rms),
    ];
    known.into_iter().chain(changes.into_iter().flatten()).collect()
}

/// The relative error of an average that has none of its own; NaN where nothing is known of it.
fn error_of_averages(motion: &Attractor) -> f64 {
    let Some([rms, impacts]) = motion.errors() else { return 0.0 };
    let evidence = &motion.classification.evidence;
    let scatter = RIDES * (rms / motion.rms + impacts / evidence.impacts_per_period);
    let known = motion.rms > 0.0 && evidence.impacts_per_period > 0.0;
    if known { scatter.max(evidence.modulation_depth.min(WEAK_MODULATION)) } else { f64::NAN }
}

/// Energies of a period of the excitation.
fn energy(scale: &Scale, motion: &Attractor, system: &System) -> Value {
    let period = system.period();
    let energetics = &motion.energetics;
    let error = error_of_averages(motion);
    let energy = |kind, value: f64| {
        let energy = scale.energy(kind, value, Simulation);
        energy.with_error(error * energy.value.abs())
    };
    let efficiency = energetics
        .transfer_efficiency
        .map(|share| Quantity::new(&of::EFFICIENCY, share, Simulation).with_error(error * share));
    let mut told = json!({
        "work": energy(&of::WORK, energetics.input_power * period),
        "damper": energy(&of::DAMPER_LOSS, energetics.damper_power * period),
        "impacts": energy(&of::IMPACT_LOSS, energetics.loss_per_period),
        "per_impact": energetics.loss_per_impact.map(|one| energy(&of::LOSS_PER_IMPACT, one)),
        "efficiency": efficiency,
    });
    if system.cavity().friction_acceleration > 0.0 {
        told["friction"] = json!(energy(&of::FRICTION_LOSS, energetics.friction_power * period));
    }
    told
}

/// The exact orbit that a motion is: walls in the order of the impacts, largest multiplier per period.
fn proven(proof: &Proof) -> Value {
    let orbit = &proof.orbit;
    let multiplier = Quantity::new(&of::SPECTRAL_RADIUS, orbit.radius_per_period(), ExactOrbit);
    json!({
        "sequence": orbit.cycle.sequence(),
        "impacts": orbit.cycle.impact_count(),
        "periods": orbit.cycle.periods(),
        "multiplier": multiplier.with_error(ROOT_OF_ROUNDING * multiplier.value),
        "residual": orbit.convergence.residual,
        "origin": orbit.origin,
        "distance_from_simulation": proof.distance,
    })
}
