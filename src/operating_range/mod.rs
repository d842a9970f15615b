//! How far a promise holds: the stretch of each number of a case, around its own, on which no criterion fails when that
//! number alone changes, over the whole band, release, sweep or record.
//!
//! What holds is not monotone in a number, as errors of chaotic peaks come and go: so the search goes outwards in steps and
//! looks at each, an end is narrowed down between the last step at which nothing fails and the next, and places at which
//! an error could turn a criterion are told as not decided.

mod reliability;

use serde::Serialize;

use crate::band::Survey;
use crate::case::{Case, Criterion};
use crate::criteria::{self, Judged, Outcome};
use crate::excitation::Transient;
use crate::executor::{Executor, map};
use crate::flights::{DrivenError, Places};
use crate::measure::Measure;
use crate::motions::{BandEffort, Effort};
use crate::system::Parameter;
use crate::transient::Study;

pub use reliability::Reliability;

/// What all criteria together come to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Together {
    /// Every criterion holds with its error.
    Hold,
    /// None fails, and an error or a motion that still settles could turn one.
    Undecided,
    /// One fails by what was found, or nothing was.
    Fail,
}

impl Together {
    fn of(judged: &[Judged]) -> Self {
        let any = |of: &[Outcome]| judged.iter().any(|one| of.contains(&one.outcome()));
        if any(&[Outcome::Fails, Outcome::NotMeasured]) {
            Self::Fail
        } else if any(&[Outcome::NotDecided, Outcome::TooCloseToCall]) {
            Self::Undecided
        } else {
            Self::Hold
        }
    }
}

/// A number of a case, and the stretch on which no criterion fails.
#[derive(Debug, Clone, PartialEq)]
pub struct HoldsFor {
    /// What varies, all else as it is.
    pub parameter: Varied,
    /// Its value in the case, in SI or the units of a reduced case.
    pub value: f64,
    /// The stretch.
    pub range: [f64; 2],
    /// Whether the search ended there before anything failed.
    pub open: [bool; 2],
    /// Places in it at which an error could turn a criterion: from one that is decided to the next.
    pub undecided: Vec<[f64; 2]>,
    /// Places that were looked at, ascending, those beyond the ends too, and what the first criterion found there.
    pub reached: Vec<[f64; 2]>,
}

/// What varies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Varied {
    /// Of the force or the base, all amplitudes of a band with it; of a release its displacement or velocity, or the
    /// impulse.
    Amplitude,
    /// The structure's, by its stiffness.
    NaturalFrequency,
    /// The structure's damping constant.
    Damping,
    /// The structure's mass, its stiffness as it is.
    Mass,
    /// Restitution.
    Restitution,
    /// Clearance.
    Clearance,
    /// Inclination, or gravity along the cavity.
    Inclination,
    /// Friction.
    Friction,
}

/// Steps outwards, as factors.
const FACTORS: [f64; 13] = [1.02, 1.05, 1.1, 1.15, 1.22, 1.3, 1.4, 1.55, 1.75, 2.0, 2.4, 3.0, 4.0];
/// The same of what decides less: the structure's damping and mass.
const COARSE: [f64; 7] = [1.05, 1.12, 1.22, 1.4, 1.75, 2.4, 4.0];
/// The same of the natural frequency, which a resonance makes narrow.
const OF_FREQUENCY: [f64; 9] = [1.005, 1.01, 1.02, 1.035, 1.055, 1.08, 1.12, 1.18, 1.25];
/// Steps that are added: of a restitution, of an inclination in rad (0.1 to 10 degrees), of gravity along a reduced cavity
/// and of friction.
const OF_RESTITUTION: [f64; 8] = [0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.6];
const OF_INCLINATION: [f64; 5] = [0.001_745, 0.005_236, 0.017_453, 0.052_36, 0.174_533];
const OF_FRICTION: [f64; 5] = [0.002, 0.005, 0.02, 0.05, 0.2];
/// How often an end is halved: to an eighth of its step.
const HALVINGS: u32 = 3;
/// How thoroughly a band is looked at on the way, and starts of a place.
const BAND: BandEffort =
    BandEffort { even: 9, starts: 3, starts_between: 2, most: 24, tolerance: 0.1 };
const STARTS: u32 = 8;
/// Places of the absorber in a sweep, and under a record, each of which is long.
const PLACES_OF_SWEEP: u64 = 16;
const PLACES_OF_RECORD: u64 = 4;

impl Varied {
    /// Every one.
    pub const ALL: [Self; 8] = [
        Self::Amplitude,
        Self::NaturalFrequency,
        Self::Damping,
        Self::Mass,
        Self::Restitution,
        Self::Clearance,
        Self::Inclination,
        Self::Friction,
    ];

    /// The parameter of a case that it is; none where the case has no such number.
    pub fn parameter(self, case: &Case) -> Option<Parameter> {
        let all: &[Parameter] = match self {
            Self::Amplitude => {
                &[Parameter::Amplitude, Parameter::InitialDisplacement, Parameter::InitialVelocity]
            }
            Self::NaturalFrequency => &[Parameter::Stiffness],
            Self::Damping => &[Parameter::Damping],
            Self::Mass => &[Parameter::Mass],
            Self::Restitution => &[Parameter::Restitution],
            Self::Clearance => &[Parameter::Clearance],
            Self::Inclination => &[Parameter::Inclination, Parameter::GravityAlong],
            Self::Friction => &[Parameter::Friction, Parameter::FrictionAcceleration],
        };
        let has = |one: &&Parameter| {
            case.design.value(**one).is_some_and(|own| own > 0.0 || self.is_added())
        };
        all.iter().find(has).copied()
    }

    /// Whether steps are added, and not factors.
    fn is_added(self) -> bool {
        matches!(self, Self::Restitution | Self::Inclination | Self::Friction)
    }

    /// Values from the case's own outwards, down or up.
    fn steps(self, own: f64, up: bool) -> Vec<f64> {
        let sign = if up { 1.0 } else { -1.0 };
        let added = |steps: &[f64]| steps.iter().map(|step| own + sign * step).collect::<Vec<_>>();
        let times = |steps: &[f64]| {
            steps.iter().map(|step| if up { own * step } else { own / step }).collect::<Vec<_>>()
        };
        match self {
            Self::Restitution => {
                let mut all = added(&OF_RESTITUTION);
                all.retain(|one| (0.0..=1.0).contains(one));
                all
            }
            Self::Inclination => added(&OF_INCLINATION),
            Self::Friction => {
                let mut all = added(&OF_FRICTION);
                all.retain(|one| *one >= 0.0);
                all
            }
            Self::NaturalFrequency => times(&OF_FREQUENCY),
            Self::Damping | Self::Mass => times(&COARSE),
            _ => times(&FACTORS),
        }
    }

    /// The case with another value.
    fn with(self, case: &Case, parameter: Parameter, own: f64, value: f64) -> Option<Case> {
        match self {
            // Told by the frequency, done by the stiffness.
            Self::NaturalFrequency => case.with_natural_frequency(value / own),
            _ => case.varied(parameter, value),
        }
    }

    /// Its value in the case.
    fn own(self, case: &Case, parameter: Parameter) -> Option<f64> {
        match self {
            Self::NaturalFrequency => Some(case.units().natural_frequency / std::f64::consts::TAU),
            _ => case.design.value(parameter),
        }
    }
}

/// The ranges of a case and what is known of it; none where a criterion fails at the case itself, or it has none.
///
/// # Errors
/// [`DrivenError`] where a motion cannot be followed.
pub fn holds_for(
    case: &Case,
    judged: &[Judged],
    effort: &Effort,
    on: &dyn Executor,
) -> Result<Vec<HoldsFor>, DrivenError> {
    if judged.is_empty() || Together::of(judged) == Together::Fail {
        return Ok(Vec::new());
    }
    let own = Together::of(judged);
    let of = |varied: Varied| {
        let parameter = varied.parameter(case)?;
        Some((varied, parameter, varied.own(case, parameter)?))
    };
    let all: Vec<_> = Varied::ALL.into_iter().filter_map(of).collect();
    let side = |k: usize| {
        let (varied, parameter, value) = all[k / 2];
        let mut side = Side { case, effort, varied, parameter, own: value, reached: Vec::new() };
        let up = k % 2 == 1;
        // What is level and has ends alike does the mirrored thing at the mirrored inclination.
        let mirrored = varied == Varied::Inclination && !up && case.has_ideal_walls();
        if mirrored { Ok(None) } else { side.search(own, up).map(Some) }
    };
    let sides = map(on, "ranges", 2 * all.len(), side);
    let mut sides = sides.into_iter().collect::<Result<Vec<_>, _>>()?.into_iter();
    let mut found = Vec::new();
    for (parameter, _, value) in all {
        let (Some(below), Some(Some(above))) = (sides.next(), sides.next()) else { break };
        let below = below.unwrap_or_else(|| above.mirrored());
        let mut undecided: Vec<[f64; 2]> =
            below.undecided.into_iter().map(|[a, b]| [b, a]).chain(above.undecided).collect();
        undecided.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let here = judged.first().and_then(|first| first.found).map(|found| [value, found]);
        let mut reached: Vec<[f64; 2]> =
            below.reached.into_iter().chain(here).chain(above.reached).collect();
        reached.sort_by(|a, b| a[0].total_cmp(&b[0]));
        undecided.dedup_by(|next, before| {
            let joins = next[0] <= before[1];
            if joins {
                before[1] = before[1].max(next[1]);
            }
            joins
        });
        found.push(HoldsFor {
            parameter,
            value,
            range: [below.end, above.end],
            open: [below.open, above.open],
            undecided,
            reached,
        });
    }
    Ok(found)
}

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
    let own = judge(&case, effort, Looked::InFull)?;
    if own.is_empty() || Together::of(&own[..asked.min(own.len())]) == Together::Fail {
        return Ok(Vec::new());
    }
    for (limited, own) in case.criteria.iter_mut().zip(&own).skip(asked) {
        limited.limit = LOST * own.found.unwrap_or(f64::INFINITY);
    }
    let of = |varied: Varied| {
        let parameter = varied.parameter(&case)?;
        Some((varied, parameter, varied.own(&case, parameter)?))
    };
    let all: Vec<_> = OF_EDGES.into_iter().filter_map(of).collect();
    let sides = map(on, "edges", 2 * all.len(), |k| {
        let (varied, parameter, value) = all[k / 2];
        let reached = Vec::new();
        let mut side = Side { case: &case, effort, varied, parameter, own: value, reached };
        side.edge(k % 2 == 1, &own)
    });
    Ok(sides.into_iter().collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect())
}

/// One direction of one number.
struct Side<'a> {
    case: &'a Case,
    effort: &'a Effort,
    varied: Varied,
    parameter: Parameter,
    own: f64,
    /// See [`HoldsFor::reached`]; in the order in which they were looked at.
    reached: Vec<[f64; 2]>,
}

/// What was found there.
struct Reach {
    end: f64,
    open: bool,
    /// From a place that is decided, or the case's own, to the next, in the direction of the search.
    undecided: Vec<[f64; 2]>,
    reached: Vec<[f64; 2]>,
}

impl Reach {
    fn mirrored(&self) -> Self {
        let undecided = self.undecided.iter().map(|ends| ends.map(|end| -end)).collect();
        let reached = self.reached.iter().map(|[at, found]| [-at, *found]).collect();
        Self { end: -self.end, open: self.open, undecided, reached }
    }
}

impl Side<'_> {
    fn search(&mut self, own: Together, up: bool) -> Result<Reach, DrivenError> {
        let [undecided, reached] = [Vec::new(), Vec::new()];
        let mut reach = Reach { end: self.own, open: true, undecided, reached };
        let mut looked = vec![(self.own, own)];
        for step in self.varied.steps(self.own, up) {
            let Some(outcome) = self.outcome(step, Looked::OnTheWay)? else { break };
            if outcome == Together::Fail {
                reach.open = false;
                let (mut inside, mut outside) = (reach.end, step);
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (inside + outside);
                    match self.outcome(middle, Looked::OnTheWay)? {
                        Some(Together::Fail) | None => outside = middle,
                        Some(found) => {
                            looked.push((middle, found));
                            inside = middle;
                        }
                    }
                }
                reach.end = inside;
                break;
            }
            looked.push((step, outcome));
            reach.end = step;
        }
        // What `check` says of the end decides: with fewer starts something may have been missed. The case itself is known.
        while let [.., before, last] = looked[..] {
            looked.pop();
            let there = self.outcome(last.0, Looked::InFull)?;
            if let Some(found) = there.filter(|found| *found != Together::Fail) {
                looked.push((last.0, found));
                break;
            }
            reach.open = false;
            let middle = 0.5 * (before.0 + last.0);
            let between = self.outcome(middle, Looked::InFull)?;
            if let Some(found) = between.filter(|found| *found != Together::Fail) {
                looked.push((middle, found));
                break;
            }
        }
        reach.end = looked.last().map_or(self.own, |last| last.0);
        for pair in looked.windows(2) {
            if pair[0].1 == Together::Undecided || pair[1].1 == Together::Undecided {
                reach.undecided.push([pair[0].0, pair[1].0]);
            }
        }
        reach.reached = std::mem::take(&mut self.reached);
        Ok(reach)
    }

    /// The first step that is no further than an edge at which a criterion fails.
    fn edge(&mut self, up: bool, own: &[Judged]) -> Result<Option<Edge>, DrivenError> {
        for at in self.varied.steps(self.own, up) {
            if (at / self.own).max(self.own / at) > EDGE * (1.0 + f64::EPSILON) {
                break;
            }
            if self.outcome(at, Looked::OnTheWay)? != Some(Together::Fail) {
                continue;
            }
            let there = self.judged(at, Looked::InFull)?.unwrap_or_default();
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

    /// What the criteria come to at a value; none where there is no such case.
    fn outcome(&mut self, value: f64, how: Looked) -> Result<Option<Together>, DrivenError> {
        let Some(judged) = self.judged(value, how)? else { return Ok(None) };
        // A place that is looked at again is known better then.
        self.reached.retain(|[at, _]| *at != value);
        self.reached.extend(judged.first().and_then(|first| Some([value, first.found?])));
        Ok(Some(Together::of(&judged)))
    }

    /// The criteria at a value.
    fn judged(&self, value: f64, how: Looked) -> Result<Option<Vec<Judged>>, DrivenError> {
        let case = self.varied.with(self.case, self.parameter, self.own, value);
        case.map(|case| judge(&case, self.effort, how)).transpose()
    }
}

/// How thoroughly a case is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Looked {
    /// With fewer starts and places.
    OnTheWay,
    /// The same with windows as long as those of `check`: in short ones what has not settled may fail.
    Longer,
    /// With those of `check`.
    InFull,
}

/// The criteria of a case.
fn judge(case: &Case, effort: &Effort, how: Looked) -> Result<Vec<Judged>, DrivenError> {
    let on = &crate::executor::Serial;
    let Some(transient) = case.design.transient() else {
        let mut settings = criteria::settings(case);
        // Long windows make the errors of irregular peaks smaller, not what is found.
        let short = effort.short();
        let effort = match how {
            Looked::InFull => short,
            Looked::OnTheWay => Effort { starts: effort.starts.min(STARTS), band: BAND, ..short },
            Looked::Longer => Effort { starts: effort.starts.min(STARTS), band: BAND, ..*effort },
        };
        settings.effort = settings.effort.map(|_| effort);
        let survey = Survey::of(&case.range(), &settings, None, on)?;
        return Ok(criteria::judge(case, &survey));
    };
    let even = case.absorber_places().unwrap_or_default();
    let most = match transient {
        _ if how == Looked::InFull => even,
        Transient::Release(_) => even,
        Transient::Sweep(_) => PLACES_OF_SWEEP,
        Transient::Record(_) => PLACES_OF_RECORD,
    };
    let closer = case.design.release().is_some() || how == Looked::InFull;
    let shaking = case.asks_for_shaking();
    let places = Places { even: even.min(most), closer, shaking, executor: on };
    let Some(study) = Study::brief_of_case(case, places) else { return Ok(Vec::new()) };
    let study = study?;
    Ok(criteria::judge_transient(case, &study))
}
