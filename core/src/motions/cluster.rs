//! What wanders is known by averages: which windows are of one motion, whether it still settles, and its numbers.

use super::model::{Averages, LongTerm, Model, Sample};
use super::{Reached, Value};
use crate::numerics::scatter::twice_standard_error;
use crate::simulation::Stop;

/// What two averages that scatter may differ by, over the sum of their errors.
pub(super) const ERRORS: f64 = 2.0;
/// Windows from which on their scatter says more than each of them.
const MANY: usize = 4;
/// A change from the first half of all windows to the second, over twice its standard error, that is no chance.
const DRIFT: f64 = 1.5;
/// Modulation in the second half of a window over that in the first which is that of a motion that stays: of a few windows,
/// in which it is sampled to a few per cent, and of many in which it comes and goes.
const STAYS: std::ops::Range<f64> = 0.9..1.1;
const MANY_STAY: std::ops::Range<f64> = 0.5..2.0;
/// Relative difference below which averages are the same whatever their errors: what nobody measures.
pub(super) const NO_DIFFERENCE: f64 = 1e-3;

/// Starts that wander together: windows of one motion, as far as averages tell.
pub(super) struct Cluster<'a, M: Model> {
    /// Which flights they are.
    pub members: Vec<usize>,
    model: &'a M,
    samples: Vec<M::Sample>,
    /// Excitation periods of a case's window: largest values are spoken of for ten times as long.
    periods: u64,
}

impl<'a, M: Model> Cluster<'a, M> {
    /// Puts together what wanders, in the order of the starts, in a case with a window of so many periods.
    pub fn all(model: &'a M, samples: Vec<(usize, M::Sample)>, periods: u64) -> Vec<Self> {
        let mut clusters: Vec<Self> = Vec::new();
        for (member, sample) in samples {
            match clusters.iter_mut().find(|one| one.holds(&sample)) {
                Some(one) => {
                    one.members.push(member);
                    one.samples.push(sample);
                }
                None => {
                    let (members, samples) = (vec![member], vec![sample]);
                    clusters.push(Self { members, model, samples, periods });
                }
            }
        }
        clusters
    }

    /// Whether another window is one of the same motion: its averages are within twice both errors, where what several
    /// windows differ by is an error as well.
    fn holds(&self, sample: &M::Sample) -> bool {
        let ended = |one: &M::Sample| one.stop() == Stop::EndTime;
        ended(&self.samples[0]) == ended(sample) && self.is_like(&sample.averages())
    }

    /// Whether what is known of a motion that wanders may be of these windows.
    pub fn is_like(&self, averages: &Averages) -> bool {
        near(&self.samples.iter().map(Sample::averages).collect::<Vec<_>>(), averages)
    }

    /// Whether relative errors of root mean squares and errors of the impacts per period are within limits.
    pub fn is_within(&self, [amplitude, impacts]: [f64; 2]) -> bool {
        let averages = self.whole().averages();
        averages.amplitudes.iter().all(|rms| rms.error <= amplitude * rms.value)
            && averages.impacts.iter().all(|count| count.error <= impacts)
    }

    /// Whether a longer run may have displacements that are larger by more than this part of what was seen: of a motion that is
    /// captured now and then windows of which some have no peak at all are too short.
    pub fn is_vague(&self, from: f64) -> bool {
        self.whole().largest().iter().any(|peak| peak.error > from * peak.value)
    }

    /// The motion of all its windows together.
    fn whole(&self) -> M::Motion {
        self.model.wandering(&self.samples, self.periods)
    }

    /// Whether its averages still go up or down: of a few windows where most do, of many where all do together.
    pub fn drifts(&self) -> bool {
        let count = self.samples.len();
        if count < MANY {
            return 2 * self.samples.iter().filter(|one| one.drifts()).count() > count;
        }
        let squares: Vec<Vec<[f64; 2]>> = self.samples.iter().map(Sample::mean_squares).collect();
        (0..squares[0].len()).any(|n| {
            let changes: Vec<f64> = squares.iter().map(|one| one[n][1] - one[n][0]).collect();
            let mean = changes.iter().sum::<f64>() / count as f64;
            let size = squares.iter().map(|one| one[n][0]).sum::<f64>() / count as f64;
            mean.abs() > (DRIFT * twice_standard_error(&changes)).max(NO_DIFFERENCE * size)
        })
    }

    /// Whether it may be on its way to a motion that repeats, or to other averages; `young` is one that was not measured
    /// often enough to tell.
    pub fn settles(&self, young: bool) -> bool {
        let depth = |half: usize| self.samples.iter().map(|one| one.depths()[half]).sum::<f64>();
        let stays = if self.samples.len() < MANY { STAYS } else { MANY_STAY };
        let fades = depth(0) > 0.0 && !stays.contains(&(depth(1) / depth(0)));
        let repeating = 2 * self.samples.iter().filter(|one| one.of_repeating_kind()).count();
        self.drifts()
            || repeating > self.samples.len()
                && (young || fades || self.samples.iter().any(Sample::repeats))
    }

    /// The motion. It has settled unless it drifts, or may be a transient.
    pub fn motion(&self, reached: Reached, settled: bool) -> M::Motion {
        let motion = self.whole();
        let settled = settled && motion.has_settled() && !self.drifts();
        motion.with(reached).with_settled(settled)
    }
}

/// Whether averages are within twice both errors of those of some windows.
fn near(windows: &[Averages], other: &Averages) -> bool {
    let count = windows.len() as f64;
    other.iter().enumerate().all(|(k, other)| {
        let values = || windows.iter().filter_map(|one| one.iter().nth(k).copied());
        let mean = values().map(|one| one.value).sum::<f64>() / count;
        let apart = |one: Value| (one.value - mean) * (one.value - mean);
        let scatter = (values().map(apart).sum::<f64>() / count).sqrt();
        let own = (values().map(|one| one.error * one.error).sum::<f64>() / count).sqrt();
        let errors = own.max(2.0 * scatter) + other.error;
        (mean - other.value).abs() <= (ERRORS * errors).max(NO_DIFFERENCE * mean.max(other.value))
    })
}
