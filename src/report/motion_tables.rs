//! Tables of the long-term motions: what they are, and where their energy goes.

use super::numbers::{
    LengthFormat, MINUS, fixed, known_to, percent, signed, significant, with_error,
};
use super::tables::{Table, table};
use crate::case::{Case, Scales};
use crate::regimes::{Attractor, DynamicsKind, Exponent, FoundAttractor};
use crate::study::{CaseStudy, Proof};

/// Every long-term motion.
pub fn attractors(case: &Case, study: &CaseStudy) -> Table {
    let scales = case.scales();
    let lengths = LengthFormat::of(&scales);
    let rows = study.attractors.iter().map(|found| {
        let attractor = &found.attractor;
        let evidence = &attractor.classification.evidence;
        [
            found.regime().words().to_owned(),
            share(found),
            impacts_per_period(attractor),
            peak(attractor, &scales),
            lengths.text(scales.length(attractor.rms)) + &rms_known_to(attractor),
            percent(evidence.modulation_depth),
        ]
    });
    table(
        [
            ("Motion", false),
            ("Starts", true),
            ("z", true),
            ("Peak of x", true),
            ("rms of x", true),
            ("Modulation", true),
        ],
        rows.collect(),
    )
}

/// Impacts per period, with their error where they scatter.
pub(super) fn impacts_per_period(attractor: &Attractor) -> String {
    let z = attractor.classification.evidence.impacts_per_period;
    match attractor.errors {
        Some([_, error]) if error > 0.0 && error.is_finite() => with_error(z, error),
        _ => significant(z, 4),
    }
}

/// The largest displacement that was seen, and of a motion that does not repeat also what a run ten times
/// as long may reach, at odds of 19 to 1.
pub(super) fn peak(attractor: &Attractor, scales: &Scales) -> String {
    let lengths = LengthFormat::of(scales);
    let text = |over_clearance: f64| lengths.text(scales.length(over_clearance));
    let [seen, grown] = [attractor.peak, attractor.peak + attractor.peak_error].map(text);
    if grown == seen { seen } else { format!("{seen}, up to {grown} in ten times as long") }
}

/// What follows the root mean square of a motion that does not repeat.
pub(super) fn rms_known_to(attractor: &Attractor) -> String {
    attractor.errors.map_or_else(String::new, |[error, _]| known_to(error / attractor.rms))
}

/// The share of starts with its 95 % interval; none of them says nothing about others.
fn share(found: &FoundAttractor) -> String {
    if found.starts == 0 {
        return percent(found.share);
    }
    let [low, high] = found.share_interval;
    format!("{} ({} to {})", percent(found.share), percent(low), percent(high))
}

/// An exponent with twice its standard error: `0.66 ± 0.05`.
pub(super) fn text_of(exponent: &Exponent) -> String {
    with_error(exponent.per_period, 2.0 * exponent.standard_error)
}

/// What kind of dynamics each motion is, and what says so.
pub fn dynamics_table(study: &CaseStudy) -> Table {
    let beside = repeats(&study.attractors);
    let rows = study.attractors.iter().zip(&study.proofs).map(|(found, proof)| {
        let (kind, evidence) = dynamics(&found.attractor, proof.as_ref(), beside);
        [found.regime().words().to_owned(), kind, evidence]
    });
    table([("Motion", false), ("Nature", false), ("Evidence", false)], rows.collect())
}

/// Whether some motion repeats: beside it, a chaotic one may be a transient of any length.
pub(super) fn repeats(found: &[FoundAttractor]) -> bool {
    found.iter().any(|found| found.attractor.repeats())
}

/// What kind of dynamics, and what says so; `beside` says whether another motion repeats.
pub(super) fn dynamics(
    attractor: &Attractor,
    proof: Option<&Proof>,
    beside: bool,
) -> (String, String) {
    let evidence = &attractor.classification.evidence;
    let exponent = evidence
        .exponent
        .as_ref()
        .map(|exponent| format!("Lyapunov exponent {} per period", text_of(exponent)));
    let captured = (evidence.captures.count > 1).then(|| {
        format!(
            "captured {} of the time, {} periods on average, up to {}",
            percent(evidence.captures.share),
            significant(evidence.captures.mean, 2),
            evidence.captures.longest
        )
    });
    let unsettled = (!attractor.settled)
        .then(|| format!("not settled after {} periods: its averages drift", attractor.followed));
    let measured = || {
        let all = unsettled.into_iter().chain(exponent).chain(captured);
        all.collect::<Vec<_>>().join("; ")
    };
    match attractor.classification.dynamics {
        DynamicsKind::Periodic { periods, .. } => {
            let every = match periods {
                1 => "periodic, every period".into(),
                more => format!("periodic, every {more} periods"),
            };
            let proven = match proof {
                Some(proof) => format!(
                    "proven: orbit {}, largest multiplier {} per period",
                    proof.orbit.cycle.sequence().replace('-', &MINUS.to_string()),
                    significant(proof.orbit.radius_per_period(), 3)
                ),
                None if attractor.sustained_contact.intervals > 0 => {
                    "seen to repeat; rests on a wall in between, so no orbit of impacts".into()
                }
                None => "seen to repeat, not proven".into(),
            };
            (every, proven)
        }
        DynamicsKind::AtRest => {
            let depends = if attractor.keeps_its_start() {
                "; undamped, so its peak depends on the start"
            } else {
                ""
            };
            ("at rest".into(), format!("no impact in {} periods{depends}", attractor.periods))
        }
        DynamicsKind::TransientNotOver => ("transient not over".into(), measured()),
        DynamicsKind::Chaotic if beside => {
            (format!("chaotic for {} periods, perhaps a transient", attractor.followed), measured())
        }
        other => (other.words().to_owned(), measured()),
    }
}

/// Where the energy goes, per excitation period.
pub fn energies(case: &Case, study: &CaseStudy) -> Table {
    let scales = case.scales();
    let period = study.analysis.system.period();
    let rows = study.attractors.iter().map(|found| {
        let energy = &found.attractor.energetics;
        let none = || "\u{2013}".to_owned();
        let decibels = |change: Option<f64>| {
            change.map_or_else(none, |change| format!("{} dB", signed(change, 1)))
        };
        [
            found.regime().words().to_owned(),
            joules(&scales, energy.input_power * period),
            joules(&scales, energy.damper_power * period),
            joules(&scales, energy.loss_per_period),
            energy.loss_per_impact.map_or_else(none, |loss| joules(&scales, loss)),
            energy
                .transfer_efficiency
                .map_or_else(none, |share| format!("{} %", fixed(100.0 * share, 0))),
            decibels(energy.rms_change_db),
        ]
    });
    table(
        [
            ("Motion", false),
            ("Work in", true),
            ("Damper", true),
            ("Impacts", true),
            ("Per impact", true),
            ("Efficiency", true),
            ("rms against bare", true),
        ],
        rows.collect(),
    )
}

/// An energy in millijoules, or in the case's own unit.
fn joules(scales: &Scales, dimensionless: f64) -> String {
    match scales.energy_j(dimensionless) {
        Some(energy) => format!("{} mJ", significant(1e3 * energy, 3)),
        None => {
            let square = scales.clearance * scales.clearance;
            format!("{} m₁ω₀² units²", significant(dimensionless * square, 3))
        }
    }
}
