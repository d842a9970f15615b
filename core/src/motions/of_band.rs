//! A band of one mode with one absorber: its places, and how motions are searched at them.

use super::line::{Line, Purpose, Site};
use super::sampler::{BandEffort, Misses, Sampled, Sampling, sampled};
use super::stability::Extreme;
use super::{Effort, Motion, MotionKind, Motions, Place, Value, motions};
use crate::executor::Executor;
use crate::simulation::StartError;
use crate::system::{Band, BandOver, State, Stretch};

/// Distance of places that is never halved, over the width of the resonance and of the slow flow: what
/// scatters on a finer scale is chaos, whose peaks have an error of their own.
const FINEST: f64 = 0.1;
/// The same over a band of amplitudes.
const FINEST_AMPLITUDE: f64 = 1.0 / 256.0;
/// Smallest finest distance, over the band.
const NARROWEST: f64 = 1.0 / 4096.0;
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

/// A band, with the effort of its search.
pub(super) struct OfBand<'a> {
    pub band: &'a Band,
    pub effort: &'a Effort,
    pub on: &'a dyn Executor,
}

impl OfBand<'_> {
    /// The places of the band with their motions, and by how much each number that is asked for, the peak first, may be worse
    /// between them. The first are even ones, those that the ends of stability ask for, and these `extremes`.
    pub fn sampled(
        &self,
        stability: &[Stretch<bool>],
        extremes: Vec<f64>,
        own: Option<&Motions>,
        worst: Vec<Extreme>,
        misses: Option<&Misses<'_, Motions>>,
    ) -> Result<Sampled<Self>, StartError> {
        let Self { band, effort, on } = *self;
        let at = band.own();
        let own = match own {
            _ if !band.holds_own() => None,
            Some(own) => Some((at, own.clone())),
            None => {
                let place = Place::new(&band.base, effort.starts);
                Some((at, motions(&[place], effort, on)?.remove(0)))
            }
        };
        if band.is_point() {
            return Ok((own.into_iter().collect(), Vec::new(), false));
        }
        let mut first = first_places(band, stability, &effort.band);
        first.extend(extremes);
        first.retain(|place| *place != at || own.is_none());
        first.sort_by(f64::total_cmp);
        first.dedup();
        let BandEffort { even, most, tolerance, .. } = effort.band;
        let in_full = effort.patience >= 1.0 && even >= BandEffort::FULL.even;
        let most_in_full = if in_full { usize::MAX } else { 0 };
        let are_dear = false;
        let sampling =
            Sampling { first, own, worst, most, tolerance, most_in_full, are_dear, misses };
        sampled(self, sampling)
    }
}

impl Line for OfBand<'_> {
    type State = State;
    type Motion = Motion;
    type Motions = Motions;
    type Wanted = Extreme;
    type Error = StartError;

    fn finest(&self) -> f64 {
        finest(self.band)
    }

    fn followed(&self) -> Vec<Extreme> {
        vec![Extreme::PEAK]
    }

    fn search(
        &self,
        purpose: Purpose,
        sites: &[Site<'_, Self>],
    ) -> Result<Vec<(usize, Motions)>, StartError> {
        let BandEffort { starts, starts_between, .. } = self.effort.band;
        // Between known places the motions beside are the starts that matter.
        let starts = match purpose {
            Purpose::First => starts,
            Purpose::Between | Purpose::InFull => starts_between,
            Purpose::Followed => 0,
        };
        let in_full = purpose == Purpose::InFull;
        let place = |(k, site): (usize, &Site<'_, Self>)| {
            let system = self.band.system(site.at).ok()?;
            let known = site.known.into_iter().flat_map(Motions::iter).cloned().collect();
            let (further, patience) = (site.further.clone(), site.patience);
            Some((k, Place { further, known, patience, in_full, ..Place::new(&system, starts) }))
        };
        let places = sites.iter().enumerate().filter_map(place);
        let (of, places): (Vec<usize>, Vec<Place>) = places.unzip();
        let effort = if in_full { self.effort.in_full() } else { self.effort.between() };
        Ok(of.into_iter().zip(motions(&places, &effort, self.on)?).collect())
    }

    fn join(&self, known: &mut Motions, found: Motions) {
        known.join(&found);
    }

    fn motions<'a>(&'a self, of: &'a Motions) -> Vec<&'a Motion> {
        of.iter().collect()
    }

    fn moves(motion: &Motion) -> bool {
        motion.rest().is_none()
    }

    fn wanders(motion: &Motion) -> bool {
        matches!(motion.kind, MotionKind::Wanders)
    }

    fn has_settled(motion: &Motion) -> bool {
        motion.settled
    }

    fn is_solved(motion: &Motion) -> bool {
        Motion::is_solved(motion)
    }

    fn state(motion: &Motion) -> Option<State> {
        Some(motion.state)
    }

    fn value(&self, motion: &Motion, of: Extreme) -> Option<Value> {
        let Value { value, error } = of.of.of(motion)?;
        Some(Value { value: of.sign() * value, error })
    }

    /// Where the absorber at rest moves farthest is a place.
    fn at_its_end(&self, _: &Motion, _: &Motions, _: Extreme) -> Option<f64> {
        None
    }

    fn is_least(of: Extreme) -> bool {
        of.least
    }
}

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
