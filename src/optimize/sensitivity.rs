//! What a change of each parameter does to the objective.

use serde::Serialize;

use super::task::{Deviation, Task};
use crate::case::AbsorberDesign;
use crate::executor::{Executor, Serial, map};

/// Relative change of a parameter; of the frequency a tenth of it, since resonance is sharp.
pub const CHANGE: f64 = 0.01;

/// A parameter that may change.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Changed {
    /// The clearance.
    Clearance,
    /// The restitution.
    Restitution,
    /// The absorber's mass.
    Mass,
    /// The excitation's frequency, a whole band shifted.
    Frequency,
    /// The excitation's amplitude, that of a whole band.
    Amplitude,
}

/// The objective with a parameter a little smaller and a little larger.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Sensitivity {
    /// The parameter.
    pub of: Changed,
    /// Its relative change.
    pub change: f64,
    /// Its value with the parameter smaller by that, `None` where there is no such system.
    pub smaller: Option<f64>,
    /// With it larger by that.
    pub larger: Option<f64>,
}

/// The sensitivities at an absorber.
pub fn of(task: &Task, choice: &AbsorberDesign, executor: &dyn Executor) -> Vec<Sensitivity> {
    let omega = task.design.system().map_or(1.0, |system| system.frequency_ratio());
    let at = |of: Changed, change: f64| {
        let mut choice = *choice;
        let mut off = Deviation::default();
        match of {
            Changed::Clearance => choice.clearance *= 1.0 + change,
            Changed::Restitution => off.restitution = change * choice.restitution,
            Changed::Mass => choice.mass = choice.mass.map(|mass| mass * (1.0 + change)),
            Changed::Frequency => off.frequency_ratio = change * omega,
            Changed::Amplitude => off.amplitude = change,
        }
        task.score(&choice, &off, &Serial).map(|score| task.value(score))
    };
    let mut all = vec![
        (Changed::Clearance, CHANGE),
        (Changed::Restitution, CHANGE),
        (Changed::Mass, CHANGE),
        (Changed::Frequency, 0.1 * CHANGE),
        (Changed::Amplitude, CHANGE),
    ];
    all.retain(|(of, _)| *of != Changed::Mass || choice.mass.is_some());
    let scores = map(executor, "sensitivities", 2 * all.len(), |k| {
        let (of, change) = all[k / 2];
        at(of, if k % 2 == 0 { -change } else { change })
    });
    let pairs = all.into_iter().zip(scores.chunks(2));
    pairs
        .map(|((of, change), pair)| Sensitivity { of, change, smaller: pair[0], larger: pair[1] })
        .collect()
}
