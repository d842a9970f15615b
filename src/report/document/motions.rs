//! The long-term motions: what they are, how surely they are known, where their energy goes.

use serde_json::{Value, json};

use super::scale::{ROOT_OF_ROUNDING, Scale};
use crate::criteria::method;
use crate::linear::level_error;
use crate::measure::with_pulse;
use crate::method::Method::{self, ExactOrbit, Simulation};
use crate::motions::Along;
use crate::motions::{self, Facts, Measured, Motions, RestKind, WhyNot, wilson};
use crate::orbits::Orbit;
use crate::quantity::catalogue as of;
use crate::quantity::{Kind, Quantity};
use crate::regimes::Regime;
use crate::study::CaseStudy;
use crate::system::System;

/// Energy flows and captures ride on impacts and amplitude and scatter as they do, captures most: between
/// runs of the shipped cases that differ in rounding only, some moved by twice as much.
const RIDES: f64 = 3.0;
/// Impacts may be locked to a whole number per period and then have no error; a motion that is modulated
/// moves by as much all the same, up to this share.
const WEAK_MODULATION: f64 = 0.01;
/// Fewer captures than this say nothing of how long they are.
const FEW_CAPTURES: usize = 10;

/// The list of motions of a place, the same in every document: fields and meaning are those of the page on formats.
/// `count_rest` says whether absorbers at rest count for criteria.
pub fn listed(scale: &Scale, motions: &Motions, count_rest: bool) -> Vec<Value> {
    (0..motions.len()).filter_map(|index| one(scale, motions, index, count_rest)).collect()
}

/// The places of a band with their lists.
pub fn places(scale: &Scale, along: &Along, count_rest: bool) -> Vec<Value> {
    let place = |(at, motions): &(f64, Motions)| {
        let at = scale.place(along.band().over, *at);
        json!({
            "at": at.value,
            "unit": scale.unit(&at),
            "motions": listed(scale, motions, count_rest),
        })
    };
    along.places().iter().map(place).collect()
}

/// A number of a list with its error.
pub(crate) fn pair([value, error]: [f64; 2]) -> Value {
    json!({ "value": value, "error": error })
}

/// What a list says of a motion, whatever the structure is: numbers in the case's units.
pub(crate) struct Listed<'a> {
    pub id: String,
    pub kind: &'static str,
    pub regime: Option<Regime>,
    pub settled: bool,
    pub why_not: Option<WhyNot>,
    /// How an absorber at rest rests.
    pub rest: Option<RestKind>,
    /// Largest displacement of any place, its root mean square; impacts in a period and impact speed, the largest of any absorber.
    pub peak: [f64; 2],
    pub rms: [f64; 2],
    pub impacts_per_period: [f64; 2],
    /// None at rest.
    pub impact_speed: Option<[f64; 2]>,
    pub efficiency: Option<[f64; 2]>,
    /// How many starts led to it, of how many.
    pub starts: [u32; 2],
    /// Of these starts, or of resting places under an excitation that grows slowly.
    pub share: f64,
    /// Of resting places when the excitation begins at once.
    pub share_sudden: Option<f64>,
    pub repeats_after: Option<u32>,
    pub largest_multiplier: Option<f64>,
    /// A chattering sequence that ends in contact is one visit to a wall, and many impacts.
    pub visits_per_period: Option<f64>,
    /// Excitation periods until the last start had come to it; of one that still settles those that it was followed.
    pub followed: u64,
    /// Further fields.
    pub further: &'a [(&'static str, Value)],
}

impl Listed<'_> {
    pub fn row(&self) -> Value {
        let mut row = json!({
            "id": self.id,
            "kind": self.kind,
            "regime": self.regime,
            "settled": self.settled,
            "counts": self.why_not.is_none(),
            "why_not": self.why_not,
            "rest": self.rest,
            "peak": pair(self.peak),
            "rms": pair(self.rms),
            "impacts_per_period": pair(self.impacts_per_period),
            "impact_speed": self.impact_speed.map(pair),
            "efficiency": self.efficiency.map(pair),
            "starts": self.starts[0],
            "of_starts": self.starts[1],
            "share": self.share,
            "share_sudden": self.share_sudden,
            "repeats_after": self.repeats_after,
            "largest_multiplier": self.largest_multiplier,
            "visits_per_period": self.visits_per_period,
            "followed": self.followed,
        });
        for (key, value) in self.further {
            row[*key] = value.clone();
        }
        row
    }
}

/// One of the motions of a place.
fn one(scale: &Scale, motions: &Motions, index: usize, count_rest: bool) -> Option<Value> {
    let motion = motions.get(index)?;
    let rest = motion.rest();
    let [peak, rms, impacts_per_period, impact_speed] =
        numbers(scale, motion.facts(), method(motion)).map(|(_, one)| [one.value, one.error]);
    let listed = Listed {
        id: Motions::id(index),
        kind: motion.kind_name(),
        regime: Some(motion.regime()),
        settled: motion.settled(),
        why_not: motion.why_not(count_rest),
        rest: rest.map(|rest| rest.rest),
        peak,
        rms,
        impacts_per_period,
        impact_speed: rest.is_none().then_some(impact_speed),
        efficiency: motion.facts().efficiency.map(|one| [one.value, one.error]),
        starts: [motion.reached().starts, motions.of_starts()],
        share: motions.share(motion),
        share_sudden: rest.map(|rest| rest.sudden),
        repeats_after: motion.repeats_after(),
        largest_multiplier: motion.largest_multiplier(),
        visits_per_period: Some(motion.facts().visits_per_period),
        followed: motion.reached().followed,
        further: &[],
    };
    Some(listed.row())
}

/// The motions of a case with all that was measured of them.
pub fn found(scale: &Scale, study: &CaseStudy, count_rest: bool) -> Vec<Value> {
    let (system, motions) = (&study.analysis.system, &study.motions);
    let each = study.measured.iter().enumerate();
    each.filter_map(|(index, one)| in_full(scale, system, motions, (index, one), count_rest))
        .collect()
}

/// One of them.
pub fn in_full(
    scale: &Scale,
    system: &System,
    motions: &Motions,
    (index, measured): (usize, &Measured),
    count_rest: bool,
) -> Option<Value> {
    let motion = motions.get(index)?;
    let mut all = one(scale, motions, index, count_rest)?;
    merge(&mut all, told(scale, system, measured, motion.orbit(), method(motion)));
    let mut told = all;
    let reached = motion.reached();
    let share = motions.share(motion);
    let interval = wilson(reached.starts, motions.of_starts());
    let quantity = |value: f64| match motion.rest() {
        Some(_) => Quantity::new(&of::INACTIVE_SHARE, value, method(motion)),
        None => Quantity::new(&of::START_SHARE, value, Simulation),
    };
    let reach = interval.map(|end| (end - share).abs());
    told["reached"] = json!({
        "share": match motion.rest() {
            Some(_) => quantity(share),
            None => quantity(share).with_error(reach[0].max(reach[1])),
        },
        // 95 % interval of the share of starts.
        "interval": interval.map(|end| Quantity::new(&of::START_SHARE, end, Simulation)),
        // Those that did so only after a long transient.
        "late": reached.late,
        // Found by solving for it, before any start was followed.
        "solved": reached.solved,
    });
    Some(told)
}

/// A trajectory that was measured, from whatever start, and the orbit that it is on.
pub fn measured(scale: &Scale, system: &System, motion: &Measured) -> Value {
    let orbit = motions::orbit_of(system, motion);
    told(scale, system, motion, orbit.as_ref(), Simulation)
}

fn merge(into: &mut Value, from: Value) {
    if let (Value::Object(into), Value::Object(from)) = (into, from) {
        into.extend(from);
    }
}

fn told(
    scale: &Scale,
    system: &System,
    motion: &Measured,
    orbit: Option<&Orbit>,
    method: Method,
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
        "visits_per_period": motion.facts.visits_per_period,
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
        "efficiency": efficiency(&motion.facts, method),
        "settled": motion.settled,
        "numerics": numerics(motion),
        "doubts": doubts(motion),
        "proof": orbit.map(proven),
        "reached": null,
    });
    for (key, quantity) in headline(scale, system, &motion.facts, method) {
        told[key] = json!(quantity);
    }
    if motion.regime() == Regime::AtRest {
        told["impact_speed"] = Value::Null;
    }
    told
}

/// Quality of the simulation.
fn numerics(motion: &Measured) -> Value {
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
fn doubts(motion: &Measured) -> Vec<Value> {
    let doubts = motion.doubts().into_iter().map(|doubt| {
        let mut told = json!(doubt);
        told["words"] = json!(doubt.words());
        told["advice"] = json!(doubt.advice());
        told
    });
    doubts.collect()
}

/// The numbers of a motion that have a unit of the case, by their key.
fn numbers(scale: &Scale, facts: &Facts, method: Method) -> [(&'static str, Quantity); 4] {
    let length =
        |kind, of: motions::Value| scale.units.quantity_with(kind, [of.value, of.error], method);
    let Facts { peak, rms, impacts_per_period: impacts, impact_speed: speed, .. } = *facts;
    let impacts =
        Quantity::new(&of::IMPACTS_PER_PERIOD, impacts.value, method).with_error(impacts.error);
    [
        ("peak", length(&of::PEAK, peak)),
        ("rms", length(&of::RMS, rms)),
        ("impacts_per_period", impacts),
        (
            "impact_speed",
            scale.units.quantity_with(&of::IMPACT_SPEED, [speed.value, speed.error], method),
        ),
    ]
}

fn efficiency(facts: &Facts, method: Method) -> Option<Quantity> {
    let share = facts.efficiency?;
    Some(Quantity::new(&of::EFFICIENCY, share.value, method).with_error(share.error))
}

/// The numbers that stand for a case, by their key in a motion.
pub fn headline(
    scale: &Scale,
    system: &System,
    facts: &Facts,
    method: Method,
) -> Vec<(&'static str, Quantity)> {
    // In decibels against the steady motion of the structure alone, where it has one.
    let alone = system.linear_response().map(|response| response.amplitude());
    let alone = alone.filter(|amplitude| *amplitude > 0.0);
    let level = |key, kind: &'static Kind, of: motions::Value, shape: f64| {
        let ratio = of.value / (alone? * shape);
        let change = Quantity::new(kind, 20.0 * libm::log10(ratio), method);
        let error = level_error(of.value, of.error);
        (ratio > 0.0).then(|| (key, change.with_error(error)))
    };
    let changes = [
        level("change", &of::CHANGE_DB, facts.peak, 1.0),
        level("rms_change", &of::RMS_CHANGE_DB, facts.rms, std::f64::consts::FRAC_1_SQRT_2),
    ];
    let shaking = facts.shaking.map(|of| {
        let all = [
            ("peak_velocity", &of::PEAK_VELOCITY, of.peak_velocity),
            ("rms_velocity", &of::RMS_VELOCITY, of.rms_velocity),
            ("rms_acceleration", &of::RMS_ACCELERATION, of.rms_acceleration),
        ];
        let units = &scale.units;
        let pair = |of: motions::Value| [of.value, of.error];
        let largest = pair(of.peak_acceleration).map(|one| units.acceleration(one));
        let speed = pair(facts.impact_speed).map(|one| units.velocity(one));
        let [value, error] = with_pulse(&of::PEAK_ACCELERATION, largest, speed, units);
        let largest = Quantity::new(&of::PEAK_ACCELERATION, value, method).with_error(error);
        let all = all.map(|(key, kind, one)| (key, units.quantity_with(kind, pair(one), method)));
        all.into_iter().chain([("peak_acceleration", largest)])
    });
    let numbers = numbers(scale, facts, method).into_iter().chain(changes.into_iter().flatten());
    numbers.chain(shaking.into_iter().flatten()).collect()
}

/// The relative error of an average that has none of its own; NaN where nothing is known of it.
fn error_of_averages(motion: &Measured) -> f64 {
    if motion.repeats() {
        return 0.0;
    }
    let evidence = &motion.classification.evidence;
    let Facts { rms, impacts_per_period: impacts, .. } = motion.facts;
    let scatter = RIDES * (rms.error / rms.value + impacts.error / impacts.value);
    let known = rms.value > 0.0 && impacts.value > 0.0;
    if known { scatter.max(evidence.modulation_depth.min(WEAK_MODULATION)) } else { f64::NAN }
}

/// Energies of a period of the excitation.
fn energy(scale: &Scale, motion: &Measured, system: &System) -> Value {
    let period = system.period();
    let energetics = &motion.energetics;
    let error = error_of_averages(motion);
    let energy = |kind, value: f64| {
        let energy = scale.units.quantity(kind, value, Simulation);
        energy.with_error(error * energy.value.abs())
    };
    let mut told = json!({
        "work": energy(&of::WORK, energetics.input_power * period),
        "damper": energy(&of::DAMPER_LOSS, energetics.damper_power * period),
        "impacts": energy(&of::IMPACT_LOSS, energetics.loss_per_period),
        "per_impact": energetics.loss_per_impact.map(|one| energy(&of::LOSS_PER_IMPACT, one)),
    });
    if system.cavity().friction_acceleration > 0.0 {
        told["friction"] = json!(energy(&of::FRICTION_LOSS, energetics.friction_power * period));
    }
    told
}

/// The exact orbit that a motion is: walls in the order of the impacts, largest multiplier per period.
fn proven(orbit: &Orbit) -> Value {
    let multiplier = Quantity::new(&of::SPECTRAL_RADIUS, orbit.radius_per_period(), ExactOrbit);
    json!({
        "sequence": orbit.cycle.sequence(),
        "impacts": orbit.cycle.impact_count(),
        "periods": orbit.cycle.periods(),
        "multiplier": multiplier.with_error(ROOT_OF_ROUNDING * multiplier.value),
        "residual": orbit.convergence.residual,
        "origin": orbit.origin,
    })
}
