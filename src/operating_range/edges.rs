//! Edges: numbers of a case that nobody holds as closely as a criterion, or an absorber that wakes, asks for.

use super::varied::Varied;
use super::{Depth, Number, Together, Varies};
use crate::case::{Case, Criterion};
use crate::criteria::{Judged, Outcome};
use crate::executor::{Executor, map};
use crate::flights::DrivenError;
use crate::measure::Measure;
use crate::motions::Effort;

/// A number so close beside which a criterion fails that nobody holds it as closely.
#[derive(Debug, Clone, PartialEq)]
pub struct Edge {
    /// What varies, all else as it is.
    pub parameter: Varied,
    /// Its value in the case, in SI or the units of a reduced case.
    pub value: f64,
    /// The value at which the criterion fails.
    pub at: f64,
    /// The criterion there.
    pub fails: Judged,
    /// What it came to in the case itself.
    pub instead: Option<f64>,
}

/// Numbers that are not held to a fiftieth: what drives a structure, what is built, what it is.
const OF_EDGES: [Varied; 3] = [Varied::Amplitude, Varied::Clearance, Varied::NaturalFrequency];
/// Factor within which an edge is looked for. A step that is this but for rounding is within.
const EDGE: f64 = 1.02;
/// How many times what it is in the case a value may be that is `watched`, and not asked for. Where an absorber is no longer
/// woken it is several times as large; along a slope 2 % change it by less.
const LOST: f64 = 1.5;

/// Where a fiftieth less or more of a number makes a criterion fail, or a value that is watched half as large again: the
/// first such place to either side. None where a criterion fails in the case itself.
///
/// # Errors
/// [`DrivenError`] where a motion cannot be followed.
pub fn edges(
    case: &Case,
    watched: Option<Measure>,
    effort: &Effort,
    on: &dyn Executor,
) -> Result<Vec<Edge>, DrivenError> {
    let (mut case, asked) = (case.clone(), case.criteria.len());
    // No displacement is at most 0, which does not matter yet: the worst of all is found, whatever the limit.
    case.criteria.extend(watched.and_then(|measure| Criterion::at_most(measure, 0.0)));
    let own = case.judge(effort, Depth::AsCheck)?;
    if own.is_empty() || Together::of(&own[..asked.min(own.len())]) == Together::Fail {
        return Ok(Vec::new());
    }
    for (limited, own) in case.criteria.iter_mut().zip(&own).skip(asked) {
        limited.limit = LOST * own.found.unwrap_or(f64::INFINITY);
    }
    let all = Number::all(&case, &OF_EDGES, effort);
    let sides = map(on, "edges", 2 * all.len(), |k| all[k / 2].edge(k % 2 == 1, &own));
    Ok(sides.into_iter().collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect())
}

impl Number<'_, Case> {
    /// The first step that is no further than an edge at which a criterion fails.
    fn edge(&self, up: bool, own: &[Judged]) -> Result<Option<Edge>, DrivenError> {
        for at in self.varied.steps(self.own, up) {
            if (at / self.own).max(self.own / at) > EDGE * (1.0 + f64::EPSILON) {
                break;
            }
            let looked = self.judged(at, Depth::OnTheWay)?;
            if looked.is_none_or(|judged| Together::of(&judged) != Together::Fail) {
                continue;
            }
            let there = self.judged(at, Depth::AsCheck)?.unwrap_or_default();
            let lost = there
                .into_iter()
                .zip(own)
                .find(|(one, _)| matches!(one.outcome(), Outcome::Fails | Outcome::NotMeasured));
            if let Some((fails, own)) = lost {
                let (parameter, value) = (self.varied, self.own);
                return Ok(Some(Edge { parameter, value, at, fails, instead: own.found }));
            }
        }
        Ok(None)
    }
}
