//! Places of a band with their motions, added where a number that is asked for may still be worse between two of them; what
//! is found at a place is followed to those beside it, and what sets how bad a number may be is flown in full.

use serde::Serialize;

use super::between::worst_between;
use super::stability::Extreme;
use super::{Effort, Motion, MotionKind, Motions, Place, motions};
use crate::executor::Executor;
use crate::simulation::StartError;
use crate::system::{Band, BandOver, State, Stretch};

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

/// Distance of places that is never halved, over the width of the resonance and of the slow flow: what
/// scatters on a finer scale is chaos, whose peaks have an error of their own.
const FINEST: f64 = 0.1;
/// The same over a band of amplitudes.
const FINEST_AMPLITUDE: f64 = 1.0 / 256.0;
/// Smallest finest distance, over the band.
const NARROWEST: f64 = 1.0 / 4096.0;
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
/// Most motions that are followed from each neighbour.
const MOST_FOLLOWED: usize = 3;
/// Distance from the end of a stable stretch, over the band, at which its other side is simulated.
pub(super) const BESIDE: f64 = 1e-3;

/// Smallest distance of places.
fn finest(band: &Band) -> f64 {
    let eps = band.base.mass_ratio();
    let fine = match band.over {
        BandOver::Frequency => FINEST * eps.min(0.5 * eps * band.base.damping()),
        BandOver::Amplitude => FINEST_AMPLITUDE * band.width(),
    };
    fine.max(NARROWEST * band.width())
}

/// Even places, both sides of each end of a stable stretch, the middles of the others, and the flanks of the resonances,
/// which may lie between two even places.
fn first_places(band: &Band, stability: &[Stretch<bool>], sampling: &BandEffort) -> Vec<f64> {
    let [from, to] = band.range;
    let mut places: Vec<f64> = band.places(sampling.even).collect();
    let unstable = stability.iter().filter(|one| !one.of);
    places.extend(unstable.map(|one| 0.5 * (one.from + one.to)));
    let beside = BESIDE * band.width();
    places.extend(stability.windows(2).flat_map(|pair| [pair[0].to - beside, pair[0].to + beside]));
    if band.over == BandOver::Frequency {
        let eps = band.base.mass_ratio();
        let width = 0.5 * eps * band.base.damping();
        for resonance in [1.0, 1.0 / (1.0 + eps).sqrt()] {
            places.extend([-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| resonance + k * width));
        }
    }
    places.retain(|at| from <= *at && *at <= to);
    places
}

/// A place on the way.
struct Spot {
    at: f64,
    motions: Motions,
    /// The largest peak of a neighbour that was followed here.
    followed: f64,
    /// Whether what wanders here was flown as long as where a case has one place.
    in_full: bool,
}

impl Spot {
    fn place(self) -> (f64, Motions) {
        (self.at, self.motions)
    }

    /// Motions with impacts.
    fn moving(&self) -> impl Iterator<Item = &Motion> {
        self.motions.iter().filter(|motion| motion.rest().is_none())
    }

    /// Whether a motion that wanders was told from a transient.
    fn has_waited(&self) -> bool {
        self.moving().any(|one| matches!(one.kind, MotionKind::Wanders) && one.settled())
    }

    /// Largest peak of one; 0 without one.
    fn peak(&self) -> f64 {
        self.moving().map(|motion| motion.facts().peak.value).fold(0.0, f64::max)
    }

    /// The worst of a number of motions with impacts, its sign turned where the smallest is; none where there is none.
    fn worst(&self, of: Extreme) -> Option<f64> {
        let all = self.moving().filter_map(|one| of.of.of(one));
        all.map(|one| of.sign() * one.value).max_by(f64::total_cmp)
    }

    /// The motion that it may be worst in, with its error, and what it is there at the worst.
    fn reach(&self, of: Extreme) -> Option<(f64, &Motion)> {
        let value = |one: &Motion| of.of.of(one).map(|of_it| of.sign() * of_it.value + of_it.error);
        let all = self.motions.iter().filter_map(|one| Some((value(one)?, one)));
        all.max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Whether all that was found is solved for, whose largest peak is known without places.
    fn is_exact(&self) -> bool {
        let exact = |motion: &Motion| motion.is_solved();
        self.moving().next().is_some() && self.moving().all(exact)
    }

    /// States on the largest motions whose peaks exceed `least`, the largest first.
    fn states(&self, least: f64) -> Vec<State> {
        let mut larger: Vec<&Motion> =
            self.moving().filter(|one| one.facts().peak.value > least).collect();
        larger.sort_by(|a, b| b.facts().peak.value.total_cmp(&a.facts().peak.value));
        larger.into_iter().take(MOST_FOLLOWED).map(Motion::state).collect()
    }
}

/// The patience that is left where others may have waited.
const fn patience(waited: bool) -> f64 {
    if waited { WAITED } else { 1.0 }
}

/// The worst of a number at all places; none where nothing moves.
fn worst_of(spots: &[Spot], of: Extreme) -> Option<f64> {
    spots.iter().filter_map(|one| one.worst(of)).max_by(f64::total_cmp)
}

pub(super) struct Sampler<'a> {
    band: &'a Band,
    effort: &'a Effort,
    on: &'a dyn Executor,
    finest: f64,
    /// The numbers whose worst value is looked for, the peak first.
    worst: Vec<Extreme>,
}

impl<'a> Sampler<'a> {
    pub(super) fn new(
        band: &'a Band,
        effort: &'a Effort,
        on: &'a dyn Executor,
        worst: Vec<Extreme>,
    ) -> Self {
        Self { band, effort, on, finest: finest(band), worst }
    }

    /// The places of a band with their motions, and by how much each number that is asked for may be worse between them.
    /// The first are even ones, those that the ends of stability ask for, and these `extremes`.
    pub(super) fn sampled(
        &self,
        stability: &[Stretch<bool>],
        extremes: Vec<f64>,
        own: Option<&Motions>,
    ) -> Result<Sampled, StartError> {
        let at = self.band.own();
        let mut spots = Vec::new();
        if self.band.holds_own() {
            let motions = match own {
                Some(own) => own.clone(),
                None => {
                    let place = Place::new(&self.band.base, self.effort.starts);
                    motions(&[place], self.effort, self.on)?.remove(0)
                }
            };
            // Nobody adds to what every command has there.
            spots.push(Spot { at, motions, followed: f64::INFINITY, in_full: true });
        }
        if self.band.is_point() {
            return Ok((spots.into_iter().map(Spot::place).collect(), Vec::new()));
        }
        let mut first = first_places(self.band, stability, &self.effort.band);
        first.extend(extremes);
        first.retain(|place| *place != at || spots.is_empty());
        first.sort_by(f64::total_cmp);
        first.dedup();
        let last = first.len().saturating_sub(1);
        let sparse = |k: usize| k.is_multiple_of(SPARSE) || k == last;
        for round in [true, false] {
            let places = first.iter().enumerate().filter(|(k, _)| sparse(*k) == round);
            let new = self.at(places.map(|(_, at)| *at).collect(), &spots, true)?;
            spots.extend(new);
            spots.sort_by(|a, b| a.at.total_cmp(&b.at));
        }
        loop {
            let room = self.effort.band.most.saturating_sub(spots.len());
            let mut between: Vec<f64> = Vec::new();
            for of in &self.worst {
                let worst = worst_of(&spots, *of).unwrap_or_default();
                let limit = worst + self.effort.band.tolerance * worst.abs();
                let wide = self.gaps(&spots, *of).into_iter().filter(|gap| gap.1 > limit);
                let wide = wide.map(|gap| gap.0).take(room.min(TOGETHER));
                between.extend(wide.filter(|at| !between.contains(at)).collect::<Vec<_>>());
            }
            between.truncate(room.min(TOGETHER));
            let followed = self.follow(&mut spots)?;
            if between.is_empty() && !followed && !self.fly_in_full(&mut spots)? {
                break;
            }
            let new = self.at(between, &spots, false)?;
            spots.extend(new);
            spots.sort_by(|a, b| a.at.total_cmp(&b.at));
        }
        // What is within the tolerance is an error as well.
        let between = |of: &Extreme| {
            let worst = worst_of(&spots, *of)?;
            let gaps = self.gaps(&spots, *of).into_iter().map(|gap| gap.1);
            let narrow = (1..spots.len()).filter_map(|right| self.beyond(&spots, right, *of));
            Some((*of, gaps.chain(narrow).fold(worst, f64::max) - worst))
        };
        let unresolved = self.worst.iter().filter_map(between).collect();
        Ok((spots.into_iter().map(Spot::place).collect(), unresolved))
    }

    /// Searches places again, each start for at least as long as in a case with one place, while what wanders there, and was not
    /// flown for as long, sets how bad a number may be along the band: it may be a transient. Whether there were any.
    fn fly_in_full(&self, spots: &mut [Spot]) -> Result<bool, StartError> {
        if self.effort.patience < 1.0 || self.effort.band.even < BandEffort::FULL.even {
            return Ok(false);
        }
        let mut chosen: Vec<usize> = Vec::new();
        for of in &self.worst {
            let each = spots.iter().enumerate().filter_map(|(k, spot)| Some((k, spot.reach(*of)?)));
            let worst = each.max_by(|a, b| a.1.0.total_cmp(&b.1.0));
            let open = worst.filter(|(k, (_, motion))| {
                !spots[*k].in_full && matches!(motion.kind, MotionKind::Wanders)
            });
            chosen.extend(open.map(|one| one.0).filter(|k| !chosen.contains(k)));
        }
        let place = |k: &usize| {
            let system = self.band.system(spots[*k].at).ok()?;
            let further = spots[*k].moving().map(Motion::state).collect();
            let place = Place::new(&system, self.effort.band.starts_between);
            Some((*k, Place { further, in_full: true, ..place }))
        };
        let (chosen, places): (Vec<usize>, Vec<Place>) = chosen.iter().filter_map(place).unzip();
        let found = motions(&places, &self.effort.in_full(), self.on)?;
        for (k, found) in chosen.iter().zip(found) {
            (spots[*k].motions, spots[*k].in_full) = (found, true);
        }
        Ok(!chosen.is_empty())
    }

    /// The motions at new places: from the usual starts at the first, else also from what `known` places beside them have.
    fn at(
        &self,
        mut places: Vec<f64>,
        known: &[Spot],
        first: bool,
    ) -> Result<Vec<Spot>, StartError> {
        places.sort_by(f64::total_cmp);
        places.dedup();
        // Between known places the motions beside are the starts that matter.
        let BandEffort { starts, starts_between, .. } = self.effort.band;
        let starts = if first { starts } else { starts_between };
        let place = |at: f64| {
            let system = self.band.system(at).ok()?;
            let right = known.partition_point(|place| place.at < at);
            let beside = &known[right.saturating_sub(1)..known.len().min(right + 1)];
            let further = match first {
                true => Vec::new(),
                false => beside.iter().flat_map(|place| place.states(0.0)).collect(),
            };
            // Both have waited for what may be the same transient.
            let patience = patience(beside.len() == 2 && beside.iter().all(Spot::has_waited));
            Some((at, Place { further, patience, ..Place::new(&system, starts) }))
        };
        let (at, places): (Vec<f64>, Vec<Place>) = places.into_iter().filter_map(place).unzip();
        let found = motions(&places, &self.effort.between(), self.on)?;
        let spot = |(at, motions)| Spot { at, motions, followed: 0.0, in_full: false };
        Ok(at.into_iter().zip(found).map(spot).collect())
    }

    /// Follows larger motions to the places beside them; whether there were any.
    fn follow(&self, spots: &mut [Spot]) -> Result<bool, StartError> {
        let mut chosen = Vec::new();
        let mut places = Vec::new();
        for k in 0..spots.len() {
            let known = (1.0 + FOLLOWED) * spots[k].peak().max(spots[k].followed);
            let beside = [k.checked_sub(1), Some(k + 1)];
            let beside = beside.into_iter().flatten().filter_map(|beside| spots.get(beside));
            let further: Vec<State> = beside.clone().flat_map(|spot| spot.states(known)).collect();
            if let (false, Ok(system)) = (further.is_empty(), self.band.system(spots[k].at)) {
                chosen.push((k, beside.map(Spot::peak).fold(0.0, f64::max)));
                let known = spots[k].motions.iter().cloned().collect();
                let patience = patience(spots[k].has_waited());
                places.push(Place { further, known, patience, ..Place::with(&system, Vec::new()) });
            }
        }
        let found = motions(&places, &self.effort.between(), self.on)?;
        for ((k, peak), found) in chosen.iter().zip(found) {
            spots[*k].followed = *peak;
            spots[*k].motions.join(&found);
        }
        Ok(!places.is_empty())
    }

    /// The middles of gaps that may be halved, with how bad a number may be in them; the worst first.
    fn gaps(&self, spots: &[Spot], of: Extreme) -> Vec<(f64, f64)> {
        let mut gaps: Vec<(f64, f64)> = (1..spots.len())
            .filter(|right| spots[*right].at - spots[right - 1].at > self.finest)
            .filter(|right| !(spots[right - 1].is_exact() && spots[*right].is_exact()))
            .filter_map(|right| {
                let [left, at] = [spots[right - 1].at, spots[right].at];
                Some((0.5 * (left + at), possible(spots, right, of)?))
            })
            .collect();
        gaps.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.total_cmp(&b.0)));
        gaps
    }

    /// How bad a number may be in a gap that is never halved, by how it rises towards it on either side; no worse than in any
    /// other. None of what scatters, which is chaos with an error of its own, and of what is solved for.
    fn beyond(&self, spots: &[Spot], right: usize, of: Extreme) -> Option<f64> {
        let [one, other] = [&spots[right - 1], &spots[right]];
        let width = other.at - one.at;
        let wanders =
            |spot: &Spot| spot.moving().any(|one| matches!(one.kind, MotionKind::Wanders));
        let around = &spots[right.saturating_sub(2)..spots.len().min(right + 2)];
        if width > self.finest || one.is_exact() && other.is_exact() || around.iter().any(wanders) {
            return None;
        }
        let rises = |from: &Spot, before: Option<&Spot>| {
            let before = before?;
            let (value, earlier) = (from.worst(of)?, before.worst(of)?);
            Some(value + ((value - earlier) / (from.at - before.at).abs() * width).max(0.0))
        };
        let left = rises(one, right.checked_sub(2).map(|k| &spots[k]));
        let most = left.into_iter().chain(rises(other, spots.get(right + 1)));
        let most = most.max_by(f64::total_cmp)?;
        Some(most.min(possible(spots, right, of)?))
    }
}

/// Places with their motions, and by how much each number that was asked for may be worse between them.
pub(super) type Sampled = (Vec<(f64, Motions)>, Vec<(Extreme, f64)>);

impl Motions {
    /// Takes over what another search of the same place has found beyond these, which it was given.
    fn join(&mut self, other: &Self) {
        let is_known = |one: &Motion| {
            let same = |known: &Motion| known.kind.is_same(&one.kind) || known.facts == one.facts;
            self.iter().any(same)
        };
        let new: Vec<Motion> = other.iter().filter(|one| !is_known(one)).cloned().collect();
        let all = std::mem::take(&mut self.all).into_iter().chain(new).collect();
        *self =
            Self { operations: self.operations, ..Self::ordered(all, self.of_starts, Vec::new()) };
    }
}

/// The worst that a number may be between two neighbouring places.
fn possible(spots: &[Spot], right: usize, of: Extreme) -> Option<f64> {
    // Where nothing moves nothing is large; how small it is is not known.
    let value = |spot: &Spot| spot.worst(of).or((!of.least).then_some(0.0));
    let place = |spot: &Spot| Some([spot.at, value(spot)?]);
    let [one, other] = [&spots[right - 1], &spots[right]];
    // An end at which nothing is known is taken for as bad as the other.
    let left_end = [one.at, value(one).or_else(|| value(other))?];
    let right_end = [other.at, value(other).or_else(|| value(one))?];
    let before = right.checked_sub(2).and_then(|k| place(&spots[k]));
    let after = spots.get(right + 1).and_then(place);
    let gap = 1 + usize::from(before.is_some());
    let around: Vec<[f64; 2]> =
        before.into_iter().chain([left_end, right_end]).chain(after).collect();
    Some(worst_between(&around, gap))
}
