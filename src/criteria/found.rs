//! What motions have of what is asked, and the worst of it: one rule for every structure.
//!
//! The worst leaves the least room, of equal ones that which is known best. Its error covers all others with theirs. One that is
//! missed by a motion which has settled fails, whatever else there is; else nothing is decided while a motion still settles.

use super::{Judged, ROUNDING};
use crate::case::{Criterion, Of};
use crate::measure::Measure;
use crate::method::Method;
use crate::system::MOST_MODES;

/// What a motion has of what is asked, in SI or the units of a reduced case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// What it is.
    pub value: f64,
    /// How far that may be off, and by how much worse it may be between the places of a range.
    pub error: f64,
    /// The error that is the motion's own.
    pub own: f64,
    /// Under which of the loads of the case.
    pub load: usize,
    /// At which place of a range, where there is more than one.
    pub at: Option<f64>,
    /// Which place or absorber of the structure has it.
    pub of: Of,
    /// The motion, in the list there.
    pub motion: usize,
    /// The layer that it is known by.
    pub known_by: Method,
    /// Whether the motion has settled.
    pub settled: bool,
    /// Excitation periods after which that was said.
    pub followed: u64,
    /// Which absorbers rest in it.
    pub resting: [bool; MOST_MODES],
    /// The share of their places in which those may, together; none where none does.
    pub rest: Option<f64>,
}

impl Found {
    /// Whether no absorber acts.
    pub fn rests(&self) -> bool {
        self.known_by == Method::ClosedForm
    }

    /// The most that it may be.
    pub fn most(&self) -> f64 {
        self.value + self.error
    }
}

/// What is known of the long-term motions of a structure.
pub trait Findings {
    /// What each motion that counts has of what is asked.
    fn each(&self, asked: &Criterion) -> Vec<Found>;
    /// The same of those that do not, as too few resting places lead to an absorber at rest.
    fn too_few(&self, asked: &Criterion) -> Vec<Found>;
}

/// The worst of what is asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Worst {
    /// What it is; its error covers all others.
    pub found: Found,
    /// Room that the worst leaves which has settled.
    settled_room: f64,
    /// Longest time after which a motion was still settling.
    open: Option<u64>,
}

impl Worst {
    /// That of some; none of nothing.
    pub fn of(all: &[Found], asked: &Criterion) -> Option<Self> {
        let room = |one: &Found| asked.room(one.value);
        let nearest = |settled: bool| {
            let of = all.iter().filter(|one| one.settled || !settled);
            of.min_by(|a, b| {
                // A limit that is far from all of them makes none of them alike.
                let size = a.value.abs().max(b.value.abs()).min(asked.limit.abs());
                let [a, b] = [*a, *b].map(|one| (room(one), one.known_by == Method::Simulation));
                let alike = (a.0 - b.0).abs() <= ROUNDING * size;
                if alike { a.1.cmp(&b.1) } else { a.0.total_cmp(&b.0) }
            })
        };
        let worst = nearest(false)?;
        let least = all.iter().map(|one| room(one) - one.error).fold(f64::INFINITY, f64::min);
        let open = all.iter().filter(|one| !one.settled).map(|one| one.followed).max();
        Some(Self {
            found: Found { error: room(worst) - least, ..*worst },
            settled_room: nearest(true).map_or(f64::INFINITY, room),
            open,
        })
    }

    /// Whether every motion has settled.
    pub fn all_settled(&self) -> bool {
        self.open.is_none()
    }
}

/// A criterion by the worst of what motions have of it.
pub(super) fn worst(of: &dyn Findings, asked: &Criterion) -> Judged {
    let all = of.each(asked);
    let Some(worst) = Worst::of(&all, asked) else {
        return asked.judged(None, 0.0, Method::Simulation);
    };
    let Found { value, error, load, at, of: part, motion, known_by, rest, resting, .. } =
        worst.found;
    let judged = asked.judged(Some(value), error, known_by);
    // What has settled may fail it, whatever else there is; what lies elsewhere, or between places, can only be worse.
    let fails = worst.settled_room < 0.0;
    let misses = |one: &Found| {
        let room = asked.room(one.value);
        one.settled && room < 0.0 && !asked.is_open(room, one.own, 0)
    };
    let near_limit = judged.near_limit && !all.iter().any(misses);
    let holds = |one: &Found| asked.judged(Some(one.value), one.error, one.known_by).holds;
    let few = of.too_few(asked).into_iter().filter(|one| holds(one) == Some(false));
    let few = few.filter_map(|one| one.rest).max_by(f64::total_cmp);
    let but_at_rest = few.filter(|_| judged.holds == Some(true));
    let (at, motion) = (at, Some(motion));
    Judged {
        load,
        at,
        of: part,
        motion,
        inactive: rest,
        resting,
        but_at_rest,
        near_limit,
        ..judged
    }
    .or_undecided(worst.open.filter(|_| !fails))
}

/// Whether every place has one motion: 1, or 0 where one has several.
pub(super) fn one_motion(of: &dyn Findings, asked: &Criterion) -> Judged {
    let Some(peak) = Criterion::at_most(Measure::Peak, 0.0) else {
        return asked.judged(None, 0.0, Method::Simulation);
    };
    let all = of.each(&peak);
    let is_there = |one: &Found, other: &Found| one.load == other.load && one.at == other.at;
    let several = |settled: bool| {
        let counts = |one: &&Found| one.settled || !settled;
        all.iter().filter(counts).find(|one| {
            let others = all.iter().filter(counts).filter(|other| is_there(one, other));
            others.into_iter().any(|other| other.motion != one.motion)
        })
    };
    let certain = several(true);
    let Some(one) = certain.or_else(|| several(false)) else {
        return asked.judged(Some(1.0), 0.0, Method::Simulation);
    };
    let here = || all.iter().filter(|other| is_there(one, other));
    let open = here().filter(|one| !one.settled).map(|one| one.followed).max();
    let judged = asked.judged(Some(0.0), 0.0, Method::Simulation);
    let resting = here().find(|one| one.rest.is_some());
    let (inactive, resting) =
        resting.map_or((None, [false; MOST_MODES]), |one| (one.rest, one.resting));
    Judged { load: one.load, at: one.at, inactive, resting, ..judged }
        .or_undecided(open.filter(|_| certain.is_none()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(value: f64, known_by: Method) -> Found {
        Found {
            value,
            error: 0.0,
            own: 0.0,
            load: 0,
            at: None,
            of: Of::Any,
            motion: 0,
            known_by,
            settled: true,
            followed: 0,
            resting: [false; MOST_MODES],
            rest: None,
        }
    }

    /// Values are alike beside one another, whatever the limit: the one that is known best of those, else the worst.
    #[test]
    fn the_worst_is_the_worst_however_far_the_limit_is() {
        let of = |limit: f64, values: [(f64, Method); 2]| {
            let asked = Criterion::at_most(Measure::Peak, limit).expect("a limit");
            let all = values.map(|(value, known_by)| found(value, known_by));
            Worst::of(&all, &asked).expect("found").found.value
        };
        let (exact, seen) = (Method::ExactOrbit, Method::Simulation);
        for limit in [1e-6, 2.0, 9e9] {
            assert_eq!(of(limit, [(0.06, exact), (1.07, seen)]), 1.07, "{limit}");
            assert_eq!(of(limit, [(1.07, seen), (0.06, exact)]), 1.07, "{limit}");
        }
        for limit in [2.0, 9e9] {
            assert_eq!(of(limit, [(1.07, exact), (1.07 + 1e-12, seen)]), 1.07, "{limit}");
        }
    }
}
