//! Places of a band with their motions, added where a number that is asked for may still be worse between two of them; what
//! is found at a place is followed to those beside it, and what sets how bad a number may be is flown in full.

use serde::Serialize;

use super::Effort;
use super::between::worst_between;
use super::line::{Line, Purpose, Site};

/// How thoroughly a band is looked at beside what one place asks for.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BandEffort {
    /// Even places at the beginning, the band's ends among them.
    pub even: u32,
    /// Starts at each of the first places; the case's own excitation has as many as a case without a band.
    pub starts: u32,
    /// Starts at each place between them, beside the motions of its neighbours.
    pub starts_between: u32,
    /// Places at most.
    pub most: usize,
    /// Relative error to which the largest displacement is to be known.
    pub tolerance: f64,
}

impl BandEffort {
    /// What decides: a criterion, an optimum, a verdict.
    pub const FULL: Self =
        Self { even: 25, starts: 8, starts_between: 3, most: 160, tolerance: 0.02 };
    /// Enough to rank designs before the best are looked at in full.
    pub const SCREENING: Self =
        Self { even: 13, starts: 3, starts_between: 2, most: 40, tolerance: 0.1 };
}

impl Effort {
    /// That at places other than the case's own: what is hardly known there is measured for longer before it decides.
    pub(super) fn between(&self) -> Self {
        Self { vague: VAGUE, ..self.in_full() }
    }

    /// That at a place that decides.
    pub(super) fn in_full(&self) -> Self {
        Self { accuracy: None, vague: self.vague.max(VAGUE_IN_FULL), ..*self }
    }
}

/// Of the first places one of so many is searched before those between.
const SPARSE: usize = 4;
/// Share of the patience with what may be a transient that is left where it was told from one before: at the same place, or
/// on either side of it.
const WAITED: f64 = 0.25;
/// Relative error of a largest value from which on it is hardly known at a place that may not decide.
pub(super) const VAGUE: f64 = 1.0;
/// The same where it may.
pub(super) const VAGUE_IN_FULL: f64 = 0.5;
/// Places that are added before the next gaps are chosen.
const TOGETHER: usize = 16;
/// Relative amount by which a neighbour's motion must be larger to be followed to a place.
const FOLLOWED: f64 = 0.02;
/// Most places that are searched in full beside a search, to end it; and where flights are dear.
const MOST_TRIED: [usize; 2] = [6, 1];
/// Part of the worst of all places from which on a motion is followed where flights are dear.
const NOT_SMALL: f64 = 0.5;
/// Most motions that are followed from each neighbour.
const MOST_FOLLOWED: usize = 3;

/// Whether something is missed by the motions at a place.
pub type Misses<'a, M> = dyn Fn(&M) -> bool + 'a;

/// What is looked for along a range.
pub struct Sampling<'a, L: Line> {
    /// Places to begin with, ascending.
    pub first: Vec<f64>,
    /// A place whose motions are known, and to which nobody adds.
    pub own: Option<(f64, L::Motions)>,
    /// The numbers whose worst values are looked for.
    pub worst: Vec<L::Wanted>,
    /// Places at most.
    pub most: usize,
    /// Relative error to which they are to be known.
    pub tolerance: f64,
    /// How many places that decide are searched in full.
    pub most_in_full: usize,
    /// Whether flights are dear: motions are followed when no place is missing any more, and only those that are not small beside the
    /// worst; places decide as well at which a motion has not settled, as it was given up.
    pub are_dear: bool,
    /// Whether something is missed by the motions at a place: with the first at which it is, searched in full, the search ends.
    pub misses: Option<&'a Misses<'a, L::Motions>>,
}

/// Places with their motions, ascending, by how much each number that was asked for may be worse between them, and whether something
/// was missed at the only one of them, with which the search ended.
pub type Sampled<L> = (Vec<(f64, <L as Line>::Motions)>, Vec<(<L as Line>::Wanted, f64)>, bool);

/// The places of a range with their motions.
///
/// # Errors
/// Where a motion cannot be flown.
pub fn sampled<L: Line>(line: &L, sampling: Sampling<'_, L>) -> Result<Sampled<L>, L::Error> {
    let Sampling { first, own, worst, most, tolerance, most_in_full, are_dear, misses } = sampling;
    let spot =
        |(at, motions)| Spot { at, motions, followed: Vec::new(), is_own: true, in_full: true };
    let spots = own.into_iter().map(spot).collect();
    let finest = line.finest();
    let tried = Vec::new();
    let mut sampler = Sampler {
        line,
        finest,
        worst,
        most,
        tolerance,
        most_in_full,
        are_dear,
        misses,
        tried,
        spots,
    };
    sampler.begin(&first)?;
    if let Some(k) = sampler.refine()? {
        let Spot { at, motions, .. } = sampler.spots.swap_remove(k);
        return Ok((vec![(at, motions)], Vec::new(), true));
    }
    // What is within the tolerance is an error as well.
    let between = |of: &L::Wanted| {
        let worst = sampler.worst_of(*of)?;
        let gaps = sampler.gaps(*of).into_iter().map(|gap| gap.1);
        let narrow = (1..sampler.spots.len()).flat_map(|right| {
            [sampler.beyond(right, *of), sampler.at_ends(right, *of)].into_iter().flatten()
        });
        Some((*of, gaps.chain(narrow).fold(worst, f64::max) - worst))
    };
    let unresolved = sampler.worst.iter().filter_map(between).collect();
    let places = sampler.spots.into_iter().map(|spot| (spot.at, spot.motions)).collect();
    Ok((places, unresolved, false))
}

/// A place on the way.
struct Spot<L: Line> {
    at: f64,
    motions: L::Motions,
    /// Of each number that is looked at the worst of a neighbour that was followed here.
    followed: Vec<f64>,
    /// Whether nothing is followed here.
    is_own: bool,
    /// Whether what wanders here was flown as long as where a case has one place.
    in_full: bool,
}

/// The patience that is left where others may have waited.
const fn patience(waited: bool) -> f64 {
    if waited { WAITED } else { 1.0 }
}

/// By which relative amount a motion is worse at least that is followed.
fn beyond(known: f64) -> f64 {
    if known.is_finite() { known + FOLLOWED * known.abs() } else { known }
}

struct Sampler<'a, L: Line> {
    line: &'a L,
    finest: f64,
    worst: Vec<L::Wanted>,
    most: usize,
    tolerance: f64,
    most_in_full: usize,
    are_dear: bool,
    misses: Option<&'a Misses<'a, L::Motions>>,
    /// Places that were tried for it.
    tried: Vec<f64>,
    /// Ascending.
    spots: Vec<Spot<L>>,
}

impl<L: Line> Sampler<'_, L> {
    /// Motions with impacts.
    fn moving<'s>(&'s self, spot: &'s Spot<L>) -> impl Iterator<Item = &'s L::Motion> {
        self.line.motions(&spot.motions).into_iter().filter(|motion| L::moves(motion))
    }

    /// Whether a motion that wanders was told from a transient.
    fn has_waited(&self, spot: &Spot<L>) -> bool {
        self.moving(spot).any(|one| L::wanders(one) && L::has_settled(one))
    }

    /// Whether a motion that has not settled decides.
    fn is_open(&self, spot: &Spot<L>) -> bool {
        self.are_dear && self.moving(spot).any(|one| !L::has_settled(one))
    }

    /// The worst of a number of motions with impacts; none where there is none.
    fn worst_at(&self, spot: &Spot<L>, of: L::Wanted) -> Option<f64> {
        let all = self.moving(spot).filter_map(|one| self.line.value(one, of));
        all.map(|one| one.value).max_by(f64::total_cmp)
    }

    /// The worst of a number at all places; none where nothing moves.
    fn worst_of(&self, of: L::Wanted) -> Option<f64> {
        self.spots.iter().filter_map(|one| self.worst_at(one, of)).max_by(f64::total_cmp)
    }

    /// The motion that it may be worst in, with its error, and what it is there at the worst.
    fn reach<'s>(&'s self, spot: &'s Spot<L>, of: L::Wanted) -> Option<(f64, &'s L::Motion)> {
        let all = self.line.motions(&spot.motions).into_iter();
        let all = all.filter_map(|one| {
            let found = self.line.value(one, of)?;
            Some((found.value + found.error, one))
        });
        all.max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Whether all that was found is solved for, whose extremes are known without places.
    fn is_exact(&self, spot: &Spot<L>) -> bool {
        self.moving(spot).next().is_some() && self.moving(spot).all(L::is_solved)
    }

    /// States on the motions in which one of the numbers that are followed is worse than it need be, the worst first.
    fn states(&self, spot: &Spot<L>, least: &[f64]) -> Vec<L::State> {
        let mut chosen: Vec<&L::Motion> = Vec::new();
        let mut states = Vec::new();
        for (of, least) in self.line.followed().into_iter().zip(least) {
            let value = |one: &L::Motion| self.line.value(one, of).map(|one| one.value);
            let worse = self.moving(spot).filter_map(|one| Some((value(one)?, one)));
            let mut worse: Vec<_> = worse.filter(|one| one.0 > *least).collect();
            worse.sort_by(|a, b| b.0.total_cmp(&a.0));
            for (_, motion) in worse.into_iter().take(MOST_FOLLOWED) {
                if !chosen.iter().any(|one| std::ptr::eq(*one, motion)) {
                    chosen.push(motion);
                    states.extend(L::state(motion));
                }
            }
        }
        states
    }

    /// The worst of each number that is followed, at a place; 0 and none where nothing moves.
    fn followed_at(&self, spot: &Spot<L>) -> Vec<f64> {
        let of = |of: L::Wanted| {
            let nothing = if L::is_least(of) { f64::NEG_INFINITY } else { 0.0 };
            self.worst_at(spot, of).unwrap_or(nothing)
        };
        self.line.followed().into_iter().map(of).collect()
    }

    fn add(&mut self, new: Vec<Spot<L>>) {
        self.spots.extend(new);
        self.spots.sort_by(|a, b| a.at.total_cmp(&b.at));
    }

    /// The first places: some of them before those between.
    fn begin(&mut self, first: &[f64]) -> Result<(), L::Error> {
        let last = first.len().saturating_sub(1);
        let sparse = |k: usize| k.is_multiple_of(SPARSE) || k == last;
        for round in [true, false] {
            let places = first.iter().enumerate().filter(|(k, _)| sparse(*k) == round);
            let new = self.at(places.map(|(_, at)| *at).collect(), Purpose::First)?;
            self.add(new);
        }
        Ok(())
    }

    /// Further places, until the worst of each number is known, or to the first at which something is missed: its number.
    fn refine(&mut self) -> Result<Option<usize>, L::Error> {
        loop {
            if let Some(missed) = self.missed()? {
                return Ok(Some(missed));
            }
            let room = self.most.saturating_sub(self.spots.len());
            let mut between: Vec<f64> = Vec::new();
            for of in &self.worst {
                let worst = self.worst_of(*of).unwrap_or_default();
                let limit = worst + self.tolerance * worst.abs();
                let wide = self.gaps(*of).into_iter().filter(|gap| gap.1 > limit);
                let wide = wide.map(|gap| gap.0).take(room.min(TOGETHER));
                between.extend(wide.filter(|at| !between.contains(at)).collect::<Vec<_>>());
            }
            between.truncate(room.min(TOGETHER));
            let followed = (between.is_empty() || !self.are_dear) && self.follow()?;
            if between.is_empty() && !followed && !self.fly_in_full()? {
                return Ok(None);
            }
            let new = self.at(between, Purpose::Between)?;
            self.add(new);
        }
    }

    /// Searches places again, each start for at least as long as in a case with one place, while what wanders there, and was not
    /// flown for as long, sets how bad a number may be along the range, or has not settled: it may be a transient. Whether there
    /// were any.
    fn fly_in_full(&mut self) -> Result<bool, L::Error> {
        let mut chosen: Vec<usize> = Vec::new();
        for of in &self.worst {
            let each = self.spots.iter().enumerate();
            let each = each.filter_map(|(k, spot)| Some((k, self.reach(spot, *of)?)));
            let worst = each.max_by(|a, b| a.1.0.total_cmp(&b.1.0));
            let open =
                worst.filter(|(k, (_, motion))| !self.spots[*k].in_full && L::wanders(motion));
            chosen.extend(open.map(|one| one.0).filter(|k| !chosen.contains(k)));
        }
        let open = |k: &usize| !self.spots[*k].in_full && self.is_open(&self.spots[*k]);
        let open = (0..self.spots.len()).filter(|k| !chosen.contains(k) && open(k));
        let open: Vec<usize> = open.collect();
        chosen.extend(open);
        chosen.truncate(self.most_in_full);
        self.most_in_full -= chosen.len();
        for (k, found) in self.in_full(&chosen)? {
            let spot = &mut self.spots[chosen[k]];
            (spot.motions, spot.in_full) = (found, true);
        }
        // One at which nothing can be flown is not looked at again.
        chosen.iter().for_each(|k| self.spots[*k].in_full = true);
        Ok(!chosen.is_empty())
    }

    /// A place, searched in full, at which something is missed. The worst of those at which it seems to be is tried beside the search,
    /// which goes on as if it had not been where it is not missed there.
    fn missed(&mut self) -> Result<Option<usize>, L::Error> {
        let (Some(misses), Some(worst)) = (self.misses, self.worst.first().copied()) else {
            return Ok(None);
        };
        let missed: Vec<usize> =
            (0..self.spots.len()).filter(|k| misses(&self.spots[*k].motions)).collect();
        if let Some(k) = missed.iter().find(|k| self.spots[**k].in_full) {
            return Ok(Some(*k));
        }
        let reach = |k: usize| self.reach(&self.spots[k], worst).map_or(0.0, |one| one.0);
        let new = missed.into_iter().filter(|k| !self.tried.contains(&self.spots[*k].at));
        let worst = new.max_by(|a, b| reach(*a).total_cmp(&reach(*b)));
        let Some(k) = worst.filter(|_| self.tried.len() < MOST_TRIED[usize::from(self.are_dear)])
        else {
            return Ok(None);
        };
        self.tried.push(self.spots[k].at);
        let found = self.in_full(&[k])?.pop().filter(|(_, found)| misses(found));
        Ok(found.map(|(_, found)| {
            self.spots[k].motions = found;
            k
        }))
    }

    /// The motions at places that are searched again, each start for at least as long as in a case with one place.
    fn in_full(&self, chosen: &[usize]) -> Result<Vec<(usize, L::Motions)>, L::Error> {
        let site = |k: &usize| {
            let spot = &self.spots[*k];
            let further = self.moving(spot).filter_map(L::state).collect();
            Site { at: spot.at, further, known: None, patience: 1.0 }
        };
        let sites: Vec<Site<L>> = chosen.iter().map(site).collect();
        self.line.search(Purpose::InFull, &sites)
    }

    /// The motions at new places: from the usual starts at the first, else also from what places beside them have.
    fn at(&self, mut places: Vec<f64>, purpose: Purpose) -> Result<Vec<Spot<L>>, L::Error> {
        places.sort_by(f64::total_cmp);
        places.dedup();
        let site = |at: &f64| {
            let right = self.spots.partition_point(|spot| spot.at < *at);
            let beside = &self.spots[right.saturating_sub(1)..self.spots.len().min(right + 1)];
            let least: Vec<f64> = self
                .line
                .followed()
                .into_iter()
                .map(|of| if L::is_least(of) { f64::NEG_INFINITY } else { 0.0 })
                .collect();
            let further = match purpose {
                Purpose::First => Vec::new(),
                _ => beside.iter().flat_map(|spot| self.states(spot, &least)).collect(),
            };
            // Both have waited for what may be the same transient.
            let waited = beside.len() == 2 && beside.iter().all(|spot| self.has_waited(spot));
            Site { at: *at, further, known: None, patience: patience(waited) }
        };
        let sites: Vec<Site<L>> = places.iter().map(site).collect();
        let found = self.line.search(purpose, &sites)?.into_iter();
        let spot = |(k, motions): (usize, L::Motions)| {
            let (at, followed) = (places[k], Vec::new());
            Spot { at, motions, followed, is_own: false, in_full: false }
        };
        Ok(found.map(spot).collect())
    }

    /// Follows worse motions to the places beside them; whether there were any.
    fn follow(&mut self) -> Result<bool, L::Error> {
        let mut chosen: Vec<(usize, Vec<f64>)> = Vec::new();
        let mut sites: Vec<Site<L>> = Vec::new();
        // What is small beside the worst of all places is not what a place beside it lacks.
        let least = |of: L::Wanted| match self.worst_of(of).filter(|_| self.are_dear) {
            Some(worst) if worst > 0.0 => NOT_SMALL * worst,
            Some(worst) => worst / NOT_SMALL,
            None => f64::NEG_INFINITY,
        };
        let least: Vec<f64> = self.line.followed().into_iter().map(least).collect();
        for (k, spot) in self.spots.iter().enumerate().filter(|one| !one.1.is_own) {
            let own = self.followed_at(spot);
            let before = |n: usize| spot.followed.get(n).copied().unwrap_or(f64::NEG_INFINITY);
            let known = own.iter().enumerate().map(|(n, own)| beyond(own.max(before(n))));
            let known: Vec<f64> =
                known.zip(&least).map(|(known, least)| known.max(*least)).collect();
            let beside = [k.checked_sub(1), Some(k + 1)];
            let beside = beside.into_iter().flatten().filter_map(|beside| self.spots.get(beside));
            let further: Vec<L::State> =
                beside.clone().flat_map(|spot| self.states(spot, &known)).collect();
            if further.is_empty() {
                continue;
            }
            let worst = beside
                .map(|spot| self.followed_at(spot))
                .reduce(|a, b| a.iter().zip(&b).map(|(a, b)| a.max(*b)).collect());
            chosen.push((k, worst.unwrap_or_default()));
            let (at, known) = (spot.at, Some(&spot.motions));
            sites.push(Site { at, further, known, patience: patience(self.has_waited(spot)) });
        }
        let found = self.line.search(Purpose::Followed, &sites)?;
        drop(sites);
        let any = !found.is_empty();
        for (n, found) in found {
            let k = chosen[n].0;
            self.line.join(&mut self.spots[k].motions, found);
            self.spots[k].in_full &= !self.is_open(&self.spots[k]);
        }
        for (k, worst) in chosen {
            self.spots[k].followed = worst;
        }
        Ok(any)
    }

    /// The middles of gaps that may be halved, with how bad a number may be in them; the worst first.
    fn gaps(&self, of: L::Wanted) -> Vec<(f64, f64)> {
        let spots = &self.spots;
        let mut gaps: Vec<(f64, f64)> = (1..spots.len())
            .filter(|right| spots[*right].at - spots[right - 1].at > self.finest)
            .filter(|right| !(self.is_exact(&spots[right - 1]) && self.is_exact(&spots[*right])))
            .filter_map(|right| {
                let [left, at] = [spots[right - 1].at, spots[right].at];
                Some((0.5 * (left + at), self.possible(right, of)?))
            })
            .collect();
        gaps.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.total_cmp(&b.0)));
        gaps
    }

    /// How bad a number may be in a gap that is never halved, by how it rises towards it on either side; no worse than in any
    /// other. None of what scatters, which is chaos with an error of its own, and of what is solved for.
    fn beyond(&self, right: usize, of: L::Wanted) -> Option<f64> {
        let spots = &self.spots;
        let [one, other] = [&spots[right - 1], &spots[right]];
        let width = other.at - one.at;
        let wanders = |spot: &Spot<L>| self.moving(spot).any(L::wanders);
        let around = &spots[right.saturating_sub(2)..spots.len().min(right + 2)];
        let exact = self.is_exact(one) && self.is_exact(other);
        if width > self.finest || exact || around.iter().any(wanders) {
            return None;
        }
        let rises = |from: &Spot<L>, before: Option<&Spot<L>>| {
            let before = before?;
            let (value, earlier) = (self.worst_at(from, of)?, self.worst_at(before, of)?);
            Some(value + ((value - earlier) / (from.at - before.at).abs() * width).max(0.0))
        };
        let left = rises(one, right.checked_sub(2).map(|k| &spots[k]));
        let most = left.into_iter().chain(rises(other, spots.get(right + 1)));
        let most = most.max_by(f64::total_cmp)?;
        Some(most.min(self.possible(right, of)?))
    }

    /// The worst that a number may be between two neighbouring places.
    fn possible(&self, right: usize, of: L::Wanted) -> Option<f64> {
        let spots = &self.spots;
        // Where nothing moves nothing is large; how small it is is not known.
        let value = |spot: &Spot<L>| self.worst_at(spot, of).or((!L::is_least(of)).then_some(0.0));
        let place = |spot: &Spot<L>| Some([spot.at, value(spot)?]);
        let [one, other] = [&spots[right - 1], &spots[right]];
        // An end at which nothing is known is taken for as bad as the other.
        let left_end = [one.at, value(one).or_else(|| value(other))?];
        let right_end = [other.at, value(other).or_else(|| value(one))?];
        let before = right.checked_sub(2).and_then(|k| place(&spots[k]));
        let after = spots.get(right + 1).and_then(place);
        let gap = 1 + usize::from(before.is_some());
        let around: Vec<[f64; 2]> =
            before.into_iter().chain([left_end, right_end]).chain(after).collect();
        let between = worst_between(&around, gap);
        Some(self.at_ends(right, of).map_or(between, |ends| ends.max(between)))
    }

    /// How bad a number may become of motions that end between two neighbouring places; none where none does.
    fn at_ends(&self, right: usize, of: L::Wanted) -> Option<f64> {
        let [one, other] = [&self.spots[right - 1], &self.spots[right]];
        let ends = [(one, other), (other, one)].into_iter().flat_map(|(here, beside)| {
            let end = |motion| self.line.at_its_end(motion, &beside.motions, of);
            self.moving(here).filter_map(end)
        });
        ends.max_by(f64::total_cmp)
    }
}
