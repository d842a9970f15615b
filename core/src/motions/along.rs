//! A band as places of motions. Places are added where the largest motion may still be larger between two of them, and
//! motions are followed from a place to its neighbours, until the largest is known to a tolerance. Where an attracting 1:1
//! orbit begins and ends, and where its numbers are largest, are roots, not samples.

use super::of_band::{BESIDE, OfBand};
use super::sampler::Misses;
use super::stability::{Extreme, Fact, OneToOne, extreme_at, stability};
use super::{Effort, Motion, Motions, Place, Value, motions, rest, steady};
use crate::executor::{Executor, Serial};
use crate::simulation::StartError;
use crate::system::{Band, Stretch};

/// The motions that can happen along a band.
#[derive(Debug, Clone, PartialEq)]
pub struct Along {
    band: Band,
    stability: Vec<Stretch<bool>>,
    places: Vec<(f64, Motions)>,
    simulated: bool,
    /// Numbers by whose worst value places were chosen, and by how much each may be worse between them.
    unresolved: Vec<(Extreme, f64)>,
    peak_at: Option<f64>,
    rest_at: Option<f64>,
    ended_early: bool,
}

impl Along {
    /// The band.
    pub fn band(&self) -> &Band {
        &self.band
    }

    /// Where a 1:1 motion attracts.
    pub fn stability(&self) -> &[Stretch<bool>] {
        &self.stability
    }

    /// The share of the band where one does.
    pub fn stable_share(&self) -> f64 {
        self.band.share(&self.stability, |stable| *stable)
    }

    /// Whether orbits alone say where a 1:1 motion attracts; else somewhere one only was seen to repeat, as its slip reverses.
    pub fn stability_is_exact(&self) -> bool {
        let stable = self.stability.iter().filter(|stretch| stretch.of);
        let mut middles = stable.map(|stretch| 0.5 * (stretch.from + stretch.to));
        middles.all(|at| {
            let system = self.band.system(at).ok();
            system.and_then(|system| steady(&system)).is_none_or(|one| one.orbit().is_some())
        })
    }

    /// Whether starts were flown; else there is nothing but what can be solved for, at the places where it is extreme.
    pub fn simulated(&self) -> bool {
        self.simulated
    }

    /// Places that were looked at, in order, each with its motions.
    pub fn places(&self) -> &[(f64, Motions)] {
        &self.places
    }

    /// Searches some places again with another effort, as between the places of a band: what was found there are starts,
    /// beside the usual ones.
    ///
    /// # Errors
    /// [`StartError`] where a start is not finite.
    pub fn look_again(
        &mut self,
        places: &[f64],
        effort: &Effort,
        on: &dyn Executor,
    ) -> Result<(), StartError> {
        let again = |(k, (at, known)): (usize, &(f64, Motions))| {
            let system = self.band.system(*at).ok().filter(|_| places.contains(at))?;
            let further = known.iter().filter(|one| one.rest().is_none()).map(Motion::state);
            let further = further.collect();
            let starts = if *at == self.band.own() { effort.starts } else { effort.band.starts };
            Some((k, Place { further, ..Place::new(&system, starts) }))
        };
        let again = self.places.iter().enumerate().filter_map(again);
        let (again, places): (Vec<usize>, Vec<Place>) = again.unzip();
        for (k, found) in again.into_iter().zip(motions(&places, &effort.in_full(), on)?) {
            self.places[k].1 = found;
        }
        Ok(())
    }

    /// The motions at one of them.
    pub fn at(&self, at: f64) -> Option<&Motions> {
        self.places.iter().find(|place| place.0 == at).map(|place| &place.1)
    }

    /// Every motion that counts, with its place and its number in the list there.
    pub fn counting(&self, count_rest: bool) -> impl Iterator<Item = (f64, usize, &Motion)> {
        self.places.iter().flat_map(move |(at, here)| {
            here.counting(count_rest).map(move |(index, motion)| (*at, index, motion))
        })
    }

    /// A number of one of them, with how much worse it may be between places: extremes of what is solved for are places. None
    /// of velocity or acceleration where they were not asked for.
    pub fn value_of(&self, motion: &Motion, of: Fact) -> Option<Value> {
        let Value { value, error } = of.of(motion)?;
        let of_it = self.unresolved.iter().filter(|(one, _)| one.of == of && !motion.is_solved());
        Some(Value { value, error: of_it.map(|one| one.1).fold(error, f64::max) })
    }

    /// Its peak, which every band is looked at for.
    pub fn peak_of(&self, motion: &Motion) -> Value {
        self.value_of(motion, Fact::Peak).unwrap_or_default()
    }

    /// The place, `Omega` or an amplitude over the base system's own, where the attracting 1:1 motion has its largest peak;
    /// none where none attracts.
    pub fn peak_at(&self) -> Option<f64> {
        self.peak_at
    }

    /// Whether there is one place alone, searched in full, at which something is missed and the search ended; never of [`along`].
    pub fn ended_early(&self) -> bool {
        self.ended_early
    }

    /// The place, `Omega` or an amplitude over the base system's own, where the structure with an absorber at rest moves
    /// farthest; none where every start wakes it.
    pub fn rest_at(&self) -> Option<f64> {
        self.rest_at
    }
}

/// Looks along a band. `own` are the motions at the case's own excitation, where they are known; they stand in the band as
/// they are. Places at which the wanted extremes are lie among the others. Without an effort nothing is flown.
///
/// # Errors
/// [`StartError`] where a start is not finite.
pub fn along(
    band: &Band,
    wanted: &[Extreme],
    own: Option<&Motions>,
    effort: Option<&Effort>,
    on: &dyn Executor,
) -> Result<Along, StartError> {
    along_until(band, wanted, own, effort, None, on)
}

/// The same that ends with the first place, searched in full, at which something is missed, if one is given that says so: what lies
/// at others is not known then.
///
/// # Errors
/// As [`along`].
pub fn along_until(
    band: &Band,
    wanted: &[Extreme],
    own: Option<&Motions>,
    effort: Option<&Effort>,
    misses: Option<&Misses<'_, Motions>>,
    on: &dyn Executor,
) -> Result<Along, StartError> {
    let stability = stability(band);
    let shaking = wanted.iter().any(|one| one.of.is_of_shaking());
    let solved_for = OneToOne::along(band, shaking);
    let peak_at = extreme_at(&solved_for, &stability, Extreme::PEAK);
    let rest_at = rest::largest_along(band, 0);
    let shakes = wanted.iter().filter(|one| one.of.is_of_shaking() && !one.least);
    let shakes = shakes.filter_map(|one| rest::largest_along(band, one.of.power_of_frequency()));
    let mut extremes: Vec<f64> =
        wanted.iter().filter_map(|one| extreme_at(&solved_for, &stability, *one)).collect();
    extremes.extend(peak_at.into_iter().chain(rest_at).chain(shakes));
    // At an end of stability no start would ever settle; both sides of it are flown.
    let is_end = |at: &f64| {
        let mut ends = stability.windows(2).map(|pair| pair[0].to);
        ends.any(|end| (at - end).abs() < BESIDE * band.width())
    };
    let (ends, extremes): (Vec<f64>, Vec<f64>) = extremes.into_iter().partition(is_end);
    let (mut places, unresolved, ended_early) = match effort {
        Some(effort) => {
            let peak = Extreme::PEAK;
            let others = wanted.iter().copied().filter(|one| *one != peak);
            let worst = std::iter::once(peak).chain(others).collect();
            OfBand { band, effort, on }.sampled(&stability, extremes, own, worst, misses)?
        }
        None => (solved(band, extremes, shaking)?, Vec::new(), false),
    };
    if !ended_early {
        let missing = |at: &f64| places.iter().all(|place| place.0 != *at);
        let ends = ends.into_iter().filter(missing).collect();
        places.extend(solved(band, ends, shaking)?);
    }
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (band, simulated) = (band.clone(), effort.is_some());
    Ok(Along { band, stability, places, simulated, unresolved, peak_at, rest_at, ended_early })
}

/// What can be solved for at some places.
fn solved(band: &Band, mut at: Vec<f64>, shaking: bool) -> Result<Vec<(f64, Motions)>, StartError> {
    at.sort_by(f64::total_cmp);
    at.dedup();
    let system = |at: f64| Some((at, Place::with(&band.system(at).ok()?, Vec::new())));
    let (at, places): (Vec<f64>, Vec<Place>) = at.into_iter().filter_map(system).unzip();
    let found = motions(&places, &Effort { shaking, ..Effort::default() }, &Serial)?;
    Ok(at.into_iter().zip(found).collect())
}
