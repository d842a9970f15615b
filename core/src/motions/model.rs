//! What a search must know of what moves: a structure of one mode with one absorber, or of several with several. The search, its patience
//! and its identity are written once, over this.

use super::{Reached, Value};
use crate::simulation::Stop;
use crate::simulation::batch::Extent;

/// Excitation periods over which a start is measured at least, where it does not repeat; several times the slowest modulation.
pub(super) const RECOGNITION: u64 = 200;
/// Push off an orbit that does not attract, over the size of the motion: far above what a repetition leaves open.
pub(super) const PUSH: f64 = 1e-3;
/// Flights of an absorber from wall to wall in a window in which it is slow: enough for extremes.
pub(super) const FLIGHTS: f64 = 16.0;

/// What moves under an excitation, and how it is flown, watched and proven.
pub(super) trait Model: Clone + PartialEq + Send + Sync {
    /// A state at excitation phase 0.
    type State: Copy + Send + Sync;
    /// A long-term motion.
    type Motion: LongTerm;
    /// What a motion that is proven, or was seen to repeat, is.
    type Kind;
    /// A trajectory that can be continued. It knows of what.
    type Flight: Send;
    /// What measures a trajectory.
    type Watch;
    /// What was seen of a trajectory over a window.
    type Sample: Sample;
    /// Why a start cannot be flown.
    type StartError: Send;

    /// Starts above which a search is no thorougher.
    const MOST_STARTS: usize;

    /// Excitation periods that a start is left alone, beside the motions that were solved for.
    fn settling(&self, known: &[KnownMotion<Self>]) -> u64;
    /// A window of so many excitation periods, or as many of them as a run can wait for.
    fn window(&self, periods: u64) -> u64;
    /// Excitation periods over which a start is measured at least, where it does not repeat; several times the slowest modulation.
    fn shortest_window(&self) -> u64;
    /// Impacts of the starts of a place that wander, together, after which it is given up that is searched with this part of the
    /// usual patience.
    fn most_impacts(&self, patience: f64) -> f64;
    /// Whether a start shows nothing new that is flown on, so slowly does the structure come back.
    fn creeps(&self) -> bool;
    /// Whether whatever moves comes to rest.
    fn comes_to_rest(&self) -> bool;

    /// A trajectory from a state at an excitation phase.
    fn begin(&self, state: &Self::State, phase: f64) -> Result<Self::Flight, Self::StartError>;
    /// A trajectory beside a state, in no direction that a symmetry has.
    fn pushed(&self, state: &Self::State) -> Option<Self::Flight>;
    /// Of what a trajectory is.
    fn of(flight: &Self::Flight) -> &Self;
    /// Where it stands.
    fn state(flight: &Self::Flight) -> Self::State;
    /// Excitation periods since it began.
    fn periods(flight: &Self::Flight) -> u64;
    /// Impacts since it began.
    fn impacts(flight: &Self::Flight) -> u64;
    /// How far it goes in so many periods with at most so many impacts in each.
    fn extent(flight: &Self::Flight, periods: u64, most_impacts: u64) -> Extent;
    /// Continues each as far as it is to go, told to a watch or to nobody.
    fn run(
        flights: &mut [&mut Self::Flight],
        far: &[Extent],
        watches: Option<&mut [Self::Watch]>,
    ) -> Vec<Stop>;
    /// Excitation periods of some flights of an absorber from wall to wall; 0 where none moves.
    fn periods_of_flights(flight: &Self::Flight) -> u64;
    /// The state at phase 0 of absorbers at rest that no wall reaches any more.
    fn at_rest(flight: &Self::Flight) -> Option<Self::State>;

    /// Measures a trajectory over a window of so many periods.
    fn watch(flight: &Self::Flight, window: u64) -> Self::Watch;
    /// Sees whether a trajectory repeats in so many periods; it need measure nothing.
    fn watch_of_repetition(flight: &Self::Flight, periods: u64) -> Self::Watch;
    /// Whether what it has seen so far repeats; if so whether watching it any longer changes nothing.
    fn repeats(watch: &mut Self::Watch) -> Option<bool>;
    /// Whether it has seen no impact.
    fn is_silent(watch: &mut Self::Watch) -> bool;
    /// What was seen; none where the trajectory came to a bad end.
    fn sample(watch: &mut Self::Watch, flight: &Self::Flight, stop: Stop) -> Option<Self::Sample>;
    /// Where a trajectory stood at the end of a window.
    fn end(sample: &Self::Sample) -> &Self::State;

    /// What is solved for before a start is flown, absorbers at rest among it.
    fn solved(&self) -> Vec<KnownMotion<Self>>;
    /// Whether no absorber takes part in what was seen, and none will.
    fn rests(&self, sample: &Self::Sample) -> bool;
    /// That motion, where it was not solved for, by what was seen if anything was.
    fn resting(&self, seen: Option<&Self::Sample>) -> Option<Self::Motion>;
    /// What a trajectory is that was seen to repeat.
    fn proof(&self, sample: &Self::Sample) -> Proof<Self>;
    /// The motion of a kind.
    fn proven(&self, kind: Self::Kind, sample: &Self::Sample) -> Option<Self::Motion>;
    /// Whether a motion is of a kind.
    fn is_kind(motion: &Self::Motion, kind: &Self::Kind) -> bool;
    /// The motion that wanders of some samples, in a case with a window of so many periods.
    fn wandering(&self, samples: &[Self::Sample], periods: u64) -> Self::Motion;

    /// States of a motion that attracts, and of its mirror image, with their phases, and after how many periods it repeats; none of one
    /// that is known by averages.
    fn begins(&self, motion: &Self::Motion) -> (Vec<(Self::State, f64)>, u32);
    /// How far apart two states are, and the size of a motion with some, in one unit.
    fn distance(of: &Self::State, other: &Self::State) -> f64;
    /// See [`Self::distance`].
    fn size(states: &[Self::State]) -> f64;
}

/// A long-term motion, as a search sees it.
pub(super) trait LongTerm: Clone + Send + Sync {
    /// Whether all absorbers rest.
    fn rests(&self) -> bool;
    /// Whether it is known by averages.
    fn wanders(&self) -> bool;
    /// Whether two motions of one place are one that are not known by averages.
    fn is_same(&self, other: &Self) -> bool;
    /// Largest modulus of the multipliers over an excitation period, where it is known.
    fn multiplier(&self) -> Option<f64>;
    /// Its averages.
    fn averages(&self) -> Averages;
    /// Its largest displacements, each with by how much a longer run may exceed it.
    fn largest(&self) -> Vec<Value>;
    /// How starts led to it.
    fn reached(&self) -> Reached;
    /// The same that starts led to in another way.
    fn with(self, reached: Reached) -> Self;
    /// Whether it has settled.
    fn has_settled(&self) -> bool;
    /// The same that has settled, or may be a transient.
    fn with_settled(self, settled: bool) -> Self;
}

/// What was seen of a trajectory over a window, as a search sees it.
pub(super) trait Sample: Clone + Send {
    /// Why it ended.
    fn stop(&self) -> Stop;
    /// Whether it stands for a window of so many periods: one of a few in which a trajectory seemed to repeat may not.
    fn covers(&self, _window: u64) -> bool {
        true
    }
    /// Its averages.
    fn averages(&self) -> Averages;
    /// Mean squares of displacements in its halves.
    fn mean_squares(&self) -> Vec<[f64; 2]>;
    /// The depth of modulation in its halves.
    fn depths(&self) -> [f64; 2];
    /// Whether a mean square goes up or down.
    fn drifts(&self) -> bool;
    /// Whether it was seen to repeat.
    fn repeats(&self) -> bool;
    /// Whether it is of a kind that repeats and was not seen to.
    fn of_repeating_kind(&self) -> bool;
}

/// Averages by which motions are told apart, each with its error.
#[derive(Debug, Clone, Default)]
pub(super) struct Averages {
    /// Root mean squares of displacements.
    pub amplitudes: Vec<Value>,
    /// Impacts per excitation period.
    pub impacts: Vec<Value>,
}

impl Averages {
    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &Value> {
        self.amplitudes.iter().chain(&self.impacts)
    }
}

/// What a trajectory that was seen to repeat is.
pub(super) enum Proof<M: Model> {
    /// A motion that attracts, with what is seen of it.
    Is(M::Kind, Box<M::Sample>),
    /// It is on its way to one, and not there yet.
    Nears(M::Kind, Box<M::Sample>),
    /// A motion that does not attract: the trajectory is about to leave it.
    Leaves,
    /// Neither: it is still settling.
    Open,
}

/// Distance from an attracting motion, over its size, times its distance from losing stability, below which a trajectory that
/// comes closer is on it. Next to a saddle-node the orbit that bounds its basin is as far away as its largest multiplier is
/// from 1, next to other bifurcations the root of that.
const CAPTURED: f64 = 0.03;

/// A motion of a place that trajectories are held against.
#[derive(Debug)]
pub(super) struct KnownMotion<M: Model> {
    pub motion: M::Motion,
    states: Vec<M::State>,
    size: f64,
}

impl<M: Model> Clone for KnownMotion<M> {
    fn clone(&self) -> Self {
        Self { motion: self.motion.clone(), states: self.states.clone(), size: self.size }
    }
}

impl<M: Model> KnownMotion<M> {
    /// A motion with where it stands at phase 0, if it repeats and is known to attract.
    pub fn new(model: &M, motion: M::Motion) -> Self {
        let (begins, periods) = model.begins(&motion);
        let states = states_from(model, &begins, periods);
        let size = M::size(&states);
        Self { motion, states, size }
    }

    /// Whether trajectories may be held against it.
    pub fn attracts(&self) -> bool {
        !self.states.is_empty() && self.motion.multiplier().is_some_and(|one| one < 1.0)
    }

    /// How far a state at phase 0 is from it, over what counts as being on it; infinite where that is not known.
    pub fn distance(&self, state: &M::State) -> f64 {
        let Some(multiplier) = self.motion.multiplier() else { return f64::INFINITY };
        let near =
            self.states.iter().map(|known| M::distance(known, state)).fold(f64::INFINITY, f64::min);
        let room = CAPTURED * (1.0 - multiplier);
        near / (room * self.size).max(f64::MIN_POSITIVE)
    }
}

/// States at the ends of so many excitation periods from states at phases.
pub(super) fn states_from<M: Model>(
    model: &M,
    begins: &[(M::State, f64)],
    periods: u32,
) -> Vec<M::State> {
    let mut found = Vec::new();
    for (state, phase) in begins {
        let Ok(mut flight) = model.begin(state, *phase) else { continue };
        for _ in 0..periods {
            let far = [Extent { periods: 1, impacts: u64::MAX }];
            M::run(&mut [&mut flight], &far, None);
            found.push(M::state(&flight));
        }
    }
    found
}
