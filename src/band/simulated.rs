//! What simulation finds along a band, from several starts at each place. Places are added where the
//! largest motion may still be larger between two of them, and motions are followed from a place to its
//! neighbours, until the largest is known to a tolerance.

use serde::Serialize;

use super::{Band, Inactive, Stretch, exact};
use crate::case::BandOver;
use crate::executor::{Executor, map};
use crate::regimes::long_term::motions;
use crate::regimes::motion::distinct;
use crate::regimes::{Effort, Motion, starts};
use crate::simulation::StartError;
use crate::system::{State, System};

/// How thoroughly a band is simulated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sampling {
    /// Even places at the beginning, the band's ends among them.
    pub even: u32,
    /// Starts at each of the first places.
    pub starts: u32,
    /// Starts at each place between them, beside the motions of its neighbours.
    pub starts_between: u32,
    /// Starts where there is only one place.
    pub starts_alone: u32,
    /// Excitation periods over which a motion that does not repeat is measured.
    pub periods: u64,
    /// Places at most.
    pub most: usize,
    /// Relative error to which the largest displacement is to be known.
    pub tolerance: f64,
}

impl Sampling {
    /// What decides: a criterion, an optimum, a verdict.
    pub const FULL: Self = Self {
        even: 25,
        starts: 8,
        starts_between: 3,
        starts_alone: 32,
        periods: 250,
        most: 160,
        tolerance: 0.02,
    };
    /// Enough to rank designs before the best are sampled in full.
    pub const SCREENING: Self = Self {
        even: 13,
        starts: 3,
        starts_between: 2,
        starts_alone: 8,
        periods: 120,
        most: 40,
        tolerance: 0.1,
    };
}

/// A place of a band and the motions that starts led to there. Lengths over the clearance.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Place {
    /// `Omega`, or the amplitude over the base system's.
    pub at: f64,
    /// The motions with impacts, in the order in which starts led to them.
    pub motions: Vec<Motion>,
    /// Peak displacement of the symmetric 1:1 orbit that attracts, if one does.
    pub orbit: Option<f64>,
    /// The motion of an absorber that stays at rest, if one can.
    pub inactive: Option<Inactive>,
    /// The largest peak of a neighbour that was followed here.
    #[serde(skip)]
    followed: f64,
}

impl Place {
    /// The motion with impacts whose peak, with its error, is largest.
    pub fn largest(&self) -> Option<&Motion> {
        let with_error = |motion: &&Motion| motion.peak + motion.peak_error;
        self.motions.iter().max_by(|a, b| with_error(a).total_cmp(&with_error(b)))
    }

    /// Motions with impacts that are not the attracting symmetric orbit.
    pub fn beside_orbit(&self) -> impl Iterator<Item = &Motion> {
        let known =
            |motion: &&Motion| self.orbit.is_some_and(|peak| motion.is_orbit_with_peak(peak));
        self.motions.iter().filter(move |motion| !known(motion))
    }

    /// Number of different motions, that of an inactive absorber and an orbit that no start led to included.
    pub fn count(&self, with_inactive: bool) -> usize {
        let inactive = usize::from(with_inactive && self.inactive.is_some());
        self.beside_orbit().count() + usize::from(self.orbit.is_some()) + inactive
    }

    /// Largest peak of a motion with impacts; 0 without one.
    fn peak(&self) -> f64 {
        self.motions.iter().map(|motion| motion.peak).chain(self.orbit).fold(0.0, f64::max)
    }

    /// Whether all that was found is the exact orbit, whose largest peak is known without places.
    fn is_exact(&self) -> bool {
        self.orbit.is_some() && self.beside_orbit().next().is_none()
    }
}

/// Distance of places that is never halved, over the width of the resonance and of the slow flow: what
/// scatters on a finer scale is chaos, whose peaks have an error of their own.
const FINEST: f64 = 0.1;
/// The same over a band of amplitudes.
const FINEST_AMPLITUDE: f64 = 1.0 / 256.0;
/// Smallest finest distance, over the band.
const NARROWEST: f64 = 1.0 / 4096.0;
/// Places that are added before the next gaps are chosen.
const TOGETHER: usize = 16;
/// Relative amount by which a neighbour's motion must be larger to be followed to a place.
const FOLLOWED: f64 = 0.02;
/// Most motions that are followed from each neighbour.
const MOST_FOLLOWED: usize = 3;
/// Distance from the end of a stable stretch, over the band, at which its other side is simulated.
const BESIDE: f64 = 1e-3;
/// Trajectories that fly side by side: a few times the lanes of the batch engine.
const SIDE_BY_SIDE: usize = 64;

/// A system and the starts that are to be followed in it.
type Task = (System, Vec<State>);

/// The places of a band, in order, and by how much the largest peak between them may exceed the largest at
/// them, over the clearance: 0 where every gap between places is resolved.
///
/// # Errors
/// [`StartError`] where a start is not finite.
pub fn along(
    band: &Band,
    stability: &[Stretch<bool>],
    sampling: &Sampling,
    executor: &dyn Executor,
) -> Result<(Vec<Place>, f64), StartError> {
    let sampler = Sampler { band, sampling, executor, finest: finest(band) };
    let mut places = sampler.at(first_places(band, stability, sampling), &[])?;
    if band.is_point() {
        return Ok((places, 0.0));
    }
    loop {
        let room = sampling.most.saturating_sub(places.len());
        let mut between = sampler.gaps(&places);
        between.truncate(room.min(TOGETHER));
        let followed = sampler.follow(&mut places)?;
        if between.is_empty() && !followed {
            break;
        }
        let new = sampler.at(between.into_iter().map(|gap| gap.0).collect(), &places)?;
        places.extend(new);
        places.sort_by(|a, b| a.at.total_cmp(&b.at));
    }
    let largest = largest(&places);
    let highest = sampler.gaps(&places).first().map_or(largest, |gap| gap.1);
    Ok((places, highest - largest))
}

fn largest(places: &[Place]) -> f64 {
    places.iter().map(Place::peak).fold(0.0, f64::max)
}

/// Smallest distance of places.
fn finest(band: &Band) -> f64 {
    let eps = band.base.mass_ratio();
    let fine = match band.over {
        BandOver::Frequency => FINEST * eps.min(0.5 * eps * band.base.damping()),
        BandOver::Amplitude => FINEST_AMPLITUDE * band.width(),
    };
    fine.max(NARROWEST * band.width())
}

/// Even places, both sides of each end of a stable stretch, the middles of the others, the case's own
/// excitation, and the flanks of the resonances, which may lie between two even places.
fn first_places(band: &Band, stability: &[Stretch<bool>], sampling: &Sampling) -> Vec<f64> {
    let [from, to] = band.range;
    if band.is_point() {
        return vec![0.5 * (from + to)];
    }
    let mut places: Vec<f64> = band.places(sampling.even).collect();
    let unstable = stability.iter().filter(|one| !one.of);
    places.extend(unstable.map(|one| 0.5 * (one.from + one.to)));
    let beside = BESIDE * band.width();
    places.extend(stability.windows(2).flat_map(|pair| [pair[0].to - beside, pair[0].to + beside]));
    match band.over {
        BandOver::Frequency => {
            let eps = band.base.mass_ratio();
            let width = 0.5 * eps * band.base.damping();
            places.push(band.base.frequency_ratio());
            for resonance in [1.0, 1.0 / (1.0 + eps).sqrt()] {
                places.extend([-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| resonance + k * width));
            }
        }
        BandOver::Amplitude => places.push(1.0),
    }
    places.retain(|at| from <= *at && *at <= to);
    places
}

struct Sampler<'a> {
    band: &'a Band,
    sampling: &'a Sampling,
    executor: &'a dyn Executor,
    finest: f64,
}

impl Sampler<'_> {
    /// The motions at new places, from the usual starts and from what `known` places beside them have.
    fn at(&self, mut places: Vec<f64>, known: &[Place]) -> Result<Vec<Place>, StartError> {
        places.sort_by(f64::total_cmp);
        places.dedup();
        // Between known places the motions beside are the starts that matter.
        let starts = match (self.band.is_point(), known.is_empty()) {
            (true, _) => self.sampling.starts_alone,
            (false, true) => self.sampling.starts,
            (false, false) => self.sampling.starts_between,
        };
        let task = |at: f64| {
            let system = self.band.system(at).ok()?;
            let right = known.partition_point(|place| place.at < at);
            let beside = known[right.saturating_sub(1)..known.len().min(right + 1)].iter();
            let beside = beside.flat_map(|place| followed(place, 0.0));
            Some((at, (system, starts::of(&system, starts).chain(beside).collect())))
        };
        let (places, tasks): (Vec<f64>, Vec<Task>) = places.into_iter().filter_map(task).unzip();
        let found = self.simulated(&tasks)?;
        let place = |((at, motions), (system, _)): ((f64, Vec<Motion>), &Task)| Place {
            at,
            motions,
            orbit: exact::attracting(self.band, at).map(|orbit| orbit.peaks.displacement),
            inactive: Inactive::of(system),
            followed: 0.0,
        };
        Ok(places.into_iter().zip(found).zip(&tasks).map(place).collect())
    }

    /// Follows larger motions to the places beside them; whether there were any.
    fn follow(&self, places: &mut [Place]) -> Result<bool, StartError> {
        let mut chosen = Vec::new();
        let mut tasks = Vec::new();
        for k in 0..places.len() {
            let known = (1.0 + FOLLOWED) * places[k].peak().max(places[k].followed);
            let beside = [k.checked_sub(1), Some(k + 1)];
            let beside = beside.into_iter().flatten().filter_map(|beside| places.get(beside));
            let starts: Vec<State> =
                beside.clone().flat_map(|place| followed(place, known)).collect();
            if let (false, Ok(system)) = (starts.is_empty(), self.band.system(places[k].at)) {
                chosen.push((k, beside.map(Place::peak).fold(0.0, f64::max)));
                tasks.push((system, starts));
            }
        }
        let found = self.simulated(&tasks)?;
        for ((k, peak), motions) in chosen.iter().zip(found) {
            let place = &mut places[*k];
            place.followed = *peak;
            let both = std::mem::take(&mut place.motions).into_iter().chain(motions);
            place.motions = distinct(&both.map(Some).collect::<Vec<_>>());
        }
        Ok(!tasks.is_empty())
    }

    /// The motions with impacts that each task's starts lead to.
    fn simulated(&self, tasks: &[Task]) -> Result<Vec<Vec<Motion>>, StartError> {
        let each = tasks.iter().map(|task| task.1.len()).max().unwrap_or(1).max(1);
        let groups: Vec<&[Task]> = tasks.chunks((SIDE_BY_SIDE / each).max(1)).collect();
        let effort = Effort::over(self.sampling.periods);
        let found =
            map(self.executor, "surveying the band", groups.len(), |k| motions(groups[k], &effort));
        let mut all = Vec::with_capacity(tasks.len());
        for group in found {
            all.extend(group?);
        }
        all.iter_mut().for_each(|found| found.retain(|motion| !motion.is_inactive()));
        Ok(all)
    }

    /// The middles of gaps in which the largest peak may exceed the largest that is known by more than the
    /// tolerance, with what it may be; the highest first.
    fn gaps(&self, places: &[Place]) -> Vec<(f64, f64)> {
        let limit = (1.0 + self.sampling.tolerance) * largest(places);
        let mut gaps: Vec<(f64, f64)> = (1..places.len())
            .filter(|right| places[*right].at - places[right - 1].at > self.finest)
            .filter(|right| !(places[right - 1].is_exact() && places[*right].is_exact()))
            .map(|right| {
                let [left, at] = [places[right - 1].at, places[right].at];
                (0.5 * (left + at), possible(places, right))
            })
            .filter(|gap| gap.1 > limit)
            .collect();
        gaps.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.total_cmp(&b.0)));
        gaps
    }
}

/// States on the largest motions of a place whose peaks exceed `least`, the largest first.
fn followed(place: &Place, least: f64) -> impl Iterator<Item = State> {
    let mut larger: Vec<&Motion> = place.motions.iter().filter(|one| one.peak > least).collect();
    larger.sort_by(|a, b| b.peak.total_cmp(&a.peak));
    let states: Vec<State> = larger.into_iter().take(MOST_FOLLOWED).map(|one| one.state).collect();
    states.into_iter()
}

/// The largest peak that may lie between two neighbouring places: the larger of theirs and half of the
/// range of the four places around. Around a smooth top, whose neighbours are lower by as much as it is
/// from its own, that is enough; steep flanks and scatter make it wide.
fn possible(places: &[Place], right: usize) -> f64 {
    let around = &places[right.saturating_sub(2)..places.len().min(right + 2)];
    let peaks = || around.iter().map(Place::peak);
    let range = peaks().fold(0.0, f64::max) - peaks().fold(f64::INFINITY, f64::min);
    places[right - 1].peak().max(places[right].peak()) + 0.5 * range
}
