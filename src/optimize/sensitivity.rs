//! What a change of each parameter does to the objective.

use super::task::Task;
use crate::case::Design;
use crate::executor::{Executor, Serial, map};
use crate::system::Parameter;

/// Relative change of a parameter; of the frequency a tenth of it, since resonance is sharp.
pub const CHANGE: f64 = 0.01;

/// The objective with a parameter a little smaller and a little larger.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensitivity {
    /// The parameter.
    pub of: Parameter,
    /// Its relative change.
    pub change: f64,
    /// Its value with the parameter smaller by that, `None` where there is no such system.
    pub smaller: Option<f64>,
    /// With it larger by that.
    pub larger: Option<f64>,
}

/// The sensitivities at a design; a whole band is shifted or scaled with its frequency or amplitude.
pub fn of(task: &Task, choice: &Design, executor: &dyn Executor) -> Vec<Sensitivity> {
    let of_value = |of: Parameter, change: f64| Some((of, change, choice.value(of)?));
    let all: Vec<(Parameter, f64, f64)> = [
        of_value(Parameter::Clearance, CHANGE),
        of_value(Parameter::Restitution, CHANGE),
        of_value(Parameter::AbsorberMass, CHANGE),
        of_value(Parameter::Frequency, 0.1 * CHANGE),
        of_value(Parameter::Amplitude, CHANGE),
    ]
    .into_iter()
    .flatten()
    .collect();
    let scores = map(executor, "sensitivities", 2 * all.len(), |k| {
        let (of, change, value) = all[k / 2];
        let error = if k % 2 == 0 { -change * value } else { change * value };
        task.score(&choice.deviating(&[(of, error)]), &Serial).map(|score| task.value(score))
    });
    let pairs = all.into_iter().zip(scores.chunks(2));
    pairs
        .map(|((of, change, _), pair)| Sensitivity {
            of,
            change,
            smaller: pair[0],
            larger: pair[1],
        })
        .collect()
}
