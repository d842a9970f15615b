//! What would spoil the design first, as data.

use serde::Serialize;
use serde_json::{Value, json};

use super::scale::Scale;
use crate::criteria::method;
use crate::method::Method::{Given, Simulation};
use crate::motions::Motion;
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;
use crate::study::Deviations;
use crate::study::deviations::{APART, Deviation, FREQUENCY, FRICTION, RESTITUTION, Rig, TILT};

/// Relative change of the peak from which on a deviation spoils a design: half a decibel, which a measurement of two
/// rigs still tells apart.
const SPOILT: f64 = 0.05;

/// What the table comes to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
enum DeviationsOutcome {
    /// The first deviation raises the peak by more than a reader would pass over.
    First,
    /// None does, but one lowers it by as much.
    NoneRaises,
    /// None changes it by as much.
    NoneChanges,
    /// Nothing is known beyond the scatter of the motions.
    Scatter,
}

/// The rigs, those whose peak is worst first.
pub fn deviations(scale: &Scale, found: &Deviations) -> Value {
    let changes = || found.rigs.iter().filter_map(|rig| rig.change);
    let largest = changes().fold(0.0, f64::max);
    let smallest = changes().fold(0.0, f64::min);
    let outcome = match () {
        () if largest > SPOILT => DeviationsOutcome::First,
        () if changes().next().is_none() => DeviationsOutcome::Scatter,
        () if smallest < -SPOILT => DeviationsOutcome::NoneRaises,
        () => DeviationsOutcome::NoneChanges,
    };
    let most = match outcome {
        DeviationsOutcome::NoneChanges => largest.max(-smallest),
        _ => largest,
    };
    json!({
        "outcome": outcome,
        // The bound in whole per cent that the changes keep.
        "most": 0.01 * (100.0 * most).ceil(),
        "own_peak": peak(scale, &found.own),
        "rows": found.rigs.iter().map(|rig| row(scale, rig)).collect::<Vec<_>>(),
    })
}

fn peak(scale: &Scale, motion: &Motion) -> Quantity {
    let peak = motion.facts().peak;
    scale.units.quantity_with(&of::PEAK, [peak.value, peak.error], method(motion))
}

fn row(scale: &Scale, rig: &Rig) -> Value {
    let (kind, size) = match rig.deviation {
        Deviation::Tilt => (&of::INCLINATION, TILT),
        Deviation::Friction => (&of::FRICTION, FRICTION),
        Deviation::UnequalEnds => (&of::RESTITUTION, APART),
        Deviation::RestitutionLower | Deviation::RestitutionHigher => {
            (&of::RESTITUTION, RESTITUTION)
        }
        Deviation::FrequencyLower | Deviation::FrequencyHigher => (&of::OFFSET, FREQUENCY),
    };
    // It follows from the peaks, which have errors.
    let change = |change| Quantity::new(&of::RELATIVE_CHANGE, change, Simulation);
    json!({
        "deviation": rig.deviation,
        // Whichever way it is.
        "size": Quantity::new(kind, size, Given),
        "peak": peak(scale, &rig.motion),
        // None within the scatter.
        "change": rig.change.map(|one| change(one).with_error(f64::NAN)),
        "regime": rig.motion.regime(),
        "settled": rig.motion.settled(),
    })
}
