//! How far a promise holds: the stretch of each number of a case, around its own, on which no criterion fails when that
//! number alone changes, over the whole band, release, sweep or record.
//!
//! What holds is not monotone in a number, as errors of chaotic peaks come and go: so the search tries designs close to the
//! case first and goes outwards in steps, an end is narrowed down between the last step at which nothing fails and the next,
//! and places at which an error could turn a criterion are told as not decided. Between two designs nothing is known: what
//! holds is told of the designs that were tried as `check` does, and of nothing else.

mod combined;
mod edges;
mod reliability;
mod steady;
mod varied;
mod varies;

use serde::Serialize;

use crate::criteria::{Judged, Outcome};
use crate::executor::{Executor, map};
use crate::system::Parameter;

pub use combined::{Combined, combined};
pub use edges::{Edge, edges};
pub(crate) use reliability::drawn;
pub use reliability::{Reliability, Uncertain};
pub use varied::Varied;
pub use varies::{Depth, Varies};

/// What all criteria together come to, the worst first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Together {
    /// One fails by what was found, or nothing was.
    Fail,
    /// None fails, and an error or a motion that still settles could turn one.
    Undecided,
    /// Every criterion holds with its error.
    Hold,
}

impl Together {
    /// Of all criteria of a case.
    pub fn of(judged: &[Judged]) -> Self {
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
    /// Of which absorber, or of an amplitude which load, where a case has a list of them.
    pub of: Option<usize>,
    /// Its value in the case, in SI or the units of a reduced case.
    pub value: f64,
    /// The stretch.
    pub range: [f64; 2],
    /// Whether the search ended there before anything failed.
    pub open: [bool; 2],
    /// The part of it around the case in which every place that was looked at is decided: all criteria hold with their
    /// errors. None where the case itself is not decided.
    pub holds: Option<[f64; 2]>,
    /// Values in that part, or in the stretch where there is none, at which the case was judged as `check` judges it, ascending;
    /// its own among them.
    pub tried: Vec<f64>,
    /// Places in it at which an error could turn a criterion: from one that is decided to the next.
    pub undecided: Vec<[f64; 2]>,
    /// Whether the structure alone keeps the limits of its motion too where all that holds ends, or where the stretch does.
    pub kept_alone: [bool; 2],
    /// Places that were looked at, ascending, those beyond the ends too, and what the first criterion found there.
    pub reached: Vec<[f64; 2]>,
}

/// Parts of a step to which an end is known.
const FINEST: f64 = 8.0;
/// Steps before the first of the usual ones, over that.
const BEFORE: [f64; 2] = [0.25, 0.5];

/// The ranges of these numbers of a case and what is known of it; none where a criterion fails at the case itself, or it has none.
/// They go to where no criterion comes to less than `least`; where all are to hold that is not asked of a case that is not
/// decided itself.
///
/// # Errors
/// Where a motion cannot be followed.
pub fn holds_for<C: Varies>(
    case: &C,
    judged: &[Judged],
    numbers: &[Varied],
    least: Together,
    effort: &C::Effort,
    on: &dyn Executor,
) -> Result<Vec<HoldsFor>, C::Error> {
    if judged.is_empty() || Together::of(judged) == Together::Fail {
        return Ok(Vec::new());
    }
    let own = Together::of(judged);
    let all = Number::all(case, numbers, effort);
    let side = |k: usize| {
        let (number, up) = (&all[k / 2], k % 2 == 1);
        // Its starts are not mirrored, so that it is looked at where that is short.
        if case.mirrors(number.varied) && !up && !case.is_short() {
            Ok(None)
        } else {
            number.search(own, least, up).map(Some)
        }
    };
    let sides = map(on, "ranges", 2 * all.len(), side);
    let mut sides = sides.into_iter().collect::<Result<Vec<_>, _>>()?.into_iter();
    let mut found = Vec::new();
    for Number { varied, parameter, of, own: value, .. } in all {
        let (Some(below), Some(Some(above))) = (sides.next(), sides.next()) else { break };
        let below = below.unwrap_or_else(|| above.mirrored());
        let mut undecided: Vec<[f64; 2]> =
            below.undecided.into_iter().map(|[a, b]| [b, a]).chain(above.undecided).collect();
        undecided.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let here = judged.first().and_then(|first| first.found).map(|found| [value, found]);
        let mut reached: Vec<[f64; 2]> =
            below.reached.into_iter().chain(here).chain(above.reached).collect();
        reached.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut tried: Vec<f64> =
            below.tried.into_iter().chain([value]).chain(above.tried).collect();
        tried.sort_by(f64::total_cmp);
        undecided.dedup_by(|next, before| {
            // The case itself is decided.
            let here = own == Together::Hold && next[0] == value;
            let joins = next[0] <= before[1] && !here;
            if joins {
                before[1] = before[1].max(next[1]);
            }
            joins
        });
        let range = [below.end, above.end];
        let holds = (own == Together::Hold).then_some([below.holds, above.holds]);
        let kept_alone = holds.unwrap_or(range).map(|end| {
            case.with(parameter, of, end).is_some_and(|case| case.kept_without_absorber())
        });
        found.push(HoldsFor {
            parameter: varied,
            of,
            value,
            range,
            open: [below.open, above.open],
            holds,
            tried,
            kept_alone,
            undecided,
            reached,
        });
    }
    Ok(found)
}

/// A number of a case that varies.
struct Number<'a, C: Varies> {
    case: &'a C,
    effort: &'a C::Effort,
    varied: Varied,
    parameter: Parameter,
    of: Option<usize>,
    own: f64,
}

/// What was found in one direction.
struct Reach {
    end: f64,
    open: bool,
    /// Where places begin that are not decided, from the case's own.
    holds: f64,
    /// See [`HoldsFor::tried`]; without the case's own.
    tried: Vec<f64>,
    /// From a place that is decided, or the case's own, to the next, in the direction of the search.
    undecided: Vec<[f64; 2]>,
    /// See [`HoldsFor::reached`]; in the order in which they were looked at.
    reached: Vec<[f64; 2]>,
}

impl Reach {
    fn mirrored(&self) -> Self {
        let undecided = self.undecided.iter().map(|ends| ends.map(|end| -end)).collect();
        let reached = self.reached.iter().map(|[at, found]| [-at, *found]).collect();
        // None of these was looked at.
        let tried = Vec::new();
        // Not the negative zero.
        let holds = 0.0 - self.holds;
        Self { end: -self.end, open: self.open, holds, tried, undecided, reached }
    }
}

impl<'a, C: Varies> Number<'a, C> {
    /// Those that a case has.
    fn all(case: &'a C, of: &[Varied], effort: &'a C::Effort) -> Vec<Self> {
        let parts = |varied: &Varied| {
            let varied = *varied;
            let parameter = case.parameter(varied);
            let parts = parameter.map_or_else(Vec::new, |one| case.parts(one)).into_iter();
            parts.filter_map(move |of| {
                let parameter = parameter?;
                let own = case.number(parameter, of)?;
                let has = own > 0.0 || varied.is_added();
                has.then_some(Self { case, effort, varied, parameter, of, own })
            })
        };
        of.iter().flat_map(parts).collect()
    }

    /// The case with another value.
    fn with(&self, value: f64) -> Option<C> {
        self.case.with(self.parameter, self.of, value)
    }

    /// Goes outwards to where all criteria hold, if they do in the case itself, and unless that is all that is asked for on to
    /// where one fails.
    fn search(&self, own: Together, least: Together, up: bool) -> Result<Reach, C::Error> {
        let case =
            Looked { at: self.own, outcome: own, how: Depth::AsCheck, blurred: false, step: 0.0 };
        let near = self.varied.near(self.case.tolerance(self.varied), self.own, up);
        let steps = self.steps(&near, up);
        let (looked, reached) = (vec![case], Vec::new());
        let mut search = Outwards { number: self, near, steps, looked, reached };
        let (mut end, mut open, mut holds) = (self.own, true, self.own);
        if own == Together::Hold {
            (holds, open) = search.until(Together::Hold)?;
            end = holds;
        }
        if least < Together::Hold || own < Together::Hold {
            (end, open) = search.until(Together::Undecided)?;
        }
        let Outwards { looked, reached, .. } = search;
        let mut undecided = Vec::new();
        let within = |end: f64| looked.iter().position(|one| one.at == end).unwrap_or_default();
        let told = within(if own == Together::Hold { holds } else { end });
        let tried =
            looked[1..=told].iter().filter(|one| one.is_as_checked()).map(|one| one.at).collect();
        let within = within(end);
        for pair in looked[..=within].windows(2) {
            if pair.iter().any(|one| one.outcome == Together::Undecided) {
                undecided.push([pair[0].at, pair[1].at]);
            }
        }
        Ok(Reach { end, open, holds, tried, undecided, reached })
    }

    /// Values from the case's own outwards: those near it, then the usual ones. Where a look is short there are more: before
    /// the first of these, and at a single excitation between them.
    fn steps(&self, near: &[f64], up: bool) -> Vec<f64> {
        let mut all = self.varied.steps(self.own, up);
        if self.case.is_short() {
            let before = all.first().map_or(0.0, |first| first - self.own);
            let more = BEFORE.map(|part| self.own + part * before);
            let is_point = self.case.is_point();
            let between = all.windows(2).filter(|_| is_point).map(|two| 0.5 * (two[0] + two[1]));
            let more: Vec<f64> = more.into_iter().chain(between).collect();
            all.extend(more);
        }
        all.extend(near);
        all.sort_by(|a, b| (a - self.own).abs().total_cmp(&(b - self.own).abs()));
        all.dedup();
        all
    }

    /// The criteria at a value.
    fn judged(&self, value: f64, how: Depth) -> Result<Option<Vec<Judged>>, C::Error> {
        self.with(value).map(|case| case.judge(self.effort, how)).transpose()
    }
}

/// What was looked at on the way outwards.
struct Looked {
    at: f64,
    outcome: Together,
    /// How deeply that was looked into.
    how: Depth,
    /// Whether all that fails does so by less than its error.
    blurred: bool,
    /// The step that it is in.
    step: f64,
}

impl Looked {
    /// Whether that is what `check` says: one that was looked into as far as that not all criteria hold may fail there.
    fn is_as_checked(&self) -> bool {
        match self.how {
            Depth::AsCheck => true,
            Depth::WhetherAllHold => self.outcome == Together::Hold,
            Depth::OnTheWay => false,
        }
    }

    /// Whether `check` says so that it comes to no less than this, or does.
    fn is_told(&self, least: Together) -> bool {
        self.is_as_checked() || (self.how == Depth::WhetherAllHold && least == Together::Hold)
    }
}

/// A search in one direction.
struct Outwards<'a, C: Varies> {
    number: &'a Number<'a, C>,
    /// Steps that are so near to the case's own that each is judged as `check` does.
    near: Vec<f64>,
    steps: Vec<f64>,
    /// From the case's own outwards.
    looked: Vec<Looked>,
    reached: Vec<[f64; 2]>,
}

impl<C: Varies> Outwards<'_, C> {
    /// The last place up to which every one comes to no less than this, as `check` says it there; and whether the search ended
    /// before one did.
    fn until(&mut self, least: Together) -> Result<(f64, bool), C::Error> {
        let open = self.go_out(least)?;
        // With fewer starts something may have been missed.
        let outermost = self.end(least) - 1;
        if self.comes_to(outermost, least)? {
            return Ok((self.looked[outermost].at, open));
        }
        // Then it lies among the places within: one step back, then two, four, and no more than half of what is left at a time;
        // and at last in the middle of a step.
        let mut back = 1;
        loop {
            let end = self.end(least);
            let known = (0..end).rev().find(|k| self.looked[*k].is_told(least)).unwrap_or_default();
            if end - known == 1 {
                break;
            }
            let half = known + (end - known) / 2;
            self.comes_to(half.max(end.saturating_sub(back)), least)?;
            back *= 2;
        }
        let end = self.end(least);
        let [known, beyond] = [end - 1, end].map(|k| &self.looked[k]);
        let (middle, step) = (0.5 * (known.at + beyond.at), beyond.step);
        let there = self.look(middle, step, Depth::telling(least))?;
        self.looked.insert(end, there);
        Ok((self.looked[self.end(least) - 1].at, false))
    }

    /// Whether one of the places comes to no less than this as `check` says it; so it is looked at, if it was not.
    fn comes_to(&mut self, k: usize, least: Together) -> Result<bool, C::Error> {
        if !self.looked[k].is_told(least) {
            let Looked { at, step, .. } = self.looked[k];
            self.looked[k] = self.look(at, step, Depth::telling(least))?;
        }
        Ok(self.looked[k].outcome >= least)
    }

    /// Steps outwards to the first place that comes to less, and halves the step before it; whether there was none.
    fn go_out(&mut self, least: Together) -> Result<bool, C::Error> {
        loop {
            let outside = self.end(least);
            if outside == self.looked.len() {
                if self.step_out(least)? {
                    continue;
                }
                return Ok(true);
            }
            let [inside, beyond] = [outside - 1, outside].map(|k| &self.looked[k]);
            let undecided = beyond.outcome == Together::Undecided;
            // With more starts and longer windows an error may be smaller.
            if undecided && !beyond.is_told(least) {
                let (at, step) = (beyond.at, beyond.step);
                self.looked[outside] = self.look(at, step, Depth::telling(least))?;
                continue;
            }
            // Where exactly an error begins to matter is not known any better.
            let errs = beyond.blurred || undecided;
            if errs || (beyond.at - inside.at).abs() <= beyond.step / FINEST {
                return Ok(false);
            }
            let (middle, step) = (0.5 * (inside.at + beyond.at), beyond.step);
            let there = self.look(middle, step, Depth::OnTheWay)?;
            self.looked.insert(outside, there);
        }
    }

    /// Looks at the next step; whether there is one.
    fn step_out(&mut self, least: Together) -> Result<bool, C::Error> {
        let own = self.number.own;
        let last = self.looked.last().map_or(own, |last| last.at);
        let next = self.steps.iter().find(|next| (*next - own).abs() > (last - own).abs());
        let Some(next) = next.copied() else { return Ok(false) };
        if self.number.with(next).is_none() {
            return Ok(false);
        }
        let is_near = self.near.contains(&next);
        let how = if is_near { Depth::telling(least) } else { Depth::OnTheWay };
        let there = self.look(next, (next - last).abs(), how)?;
        self.looked.push(there);
        Ok(true)
    }

    /// The first place, after the case's own, that comes to less; their number where none does.
    fn end(&self, least: Together) -> usize {
        let all = 1..self.looked.len();
        all.clone().find(|k| self.looked[*k].outcome < least).unwrap_or(all.end)
    }

    /// The criteria at a value, which is reached then; where there is no such case they fail.
    fn look(&mut self, at: f64, step: f64, how: Depth) -> Result<Looked, C::Error> {
        let judged = self.number.judged(at, how)?.unwrap_or_default();
        // A place that is looked at again is known better then.
        self.reached.retain(|one| one[0] != at);
        self.reached.extend(judged.first().and_then(|first| Some([at, first.found?])));
        let outcome = if judged.is_empty() { Together::Fail } else { Together::of(&judged) };
        let how = how.of(self.number.case);
        Ok(Looked { at, outcome, how, blurred: is_blurred(&judged), step })
    }
}

/// Whether all that fails does so by less than its error: where exactly it begins to is not known better.
fn is_blurred(judged: &[Judged]) -> bool {
    let mut fails = judged.iter().filter(|one| one.outcome() == Outcome::Fails).peekable();
    fails.peek().is_some() && fails.all(Judged::fails_within_its_error)
}
