//! What wanders is known by averages: which windows are of one motion, whether it still settles, and its numbers.

use super::watch::WindowSample;
use super::{Facts, Motion, MotionKind, Reached, Value};
use crate::numerics::scatter::twice_standard_error;
use crate::regimes::Regime;
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
pub(super) struct Cluster {
    /// Which flights they are.
    pub members: Vec<usize>,
    samples: Vec<WindowSample>,
    /// Excitation periods of a case's window: largest values are spoken of for ten times as long.
    periods: u64,
}

impl Cluster {
    /// Puts together what wanders, in the order of the starts, in a case with a window of so many periods.
    pub fn all(samples: impl Iterator<Item = (usize, WindowSample)>, periods: u64) -> Vec<Self> {
        let mut clusters: Vec<Self> = Vec::new();
        for (member, sample) in samples {
            match clusters.iter_mut().find(|one| one.holds(&sample)) {
                Some(one) => {
                    one.members.push(member);
                    one.samples.push(sample);
                }
                None => {
                    clusters.push(Self { members: vec![member], samples: vec![sample], periods })
                }
            }
        }
        clusters
    }

    /// Whether another window is one of the same motion: its averages are within twice both errors, where what several
    /// windows differ by is an error as well.
    fn holds(&self, sample: &WindowSample) -> bool {
        let ended = |one: &WindowSample| one.stop == Stop::EndTime;
        ended(&self.samples[0]) == ended(sample) && self.is_like(&sample.facts)
    }

    /// Whether what is known of a motion that wanders may be of these windows.
    pub fn is_like(&self, facts: &Facts) -> bool {
        let windows: Vec<Facts> = self.samples.iter().map(|one| one.facts).collect();
        near(&windows, facts)
    }

    /// Whether relative error of the root mean square and error of the impacts per period are within limits.
    pub fn is_within(&self, [amplitude, impacts]: [f64; 2]) -> bool {
        let Facts { rms, impacts_per_period, .. } = self.facts();
        rms.error <= amplitude * rms.value && impacts_per_period.error <= impacts
    }

    /// Whether a longer run may have peaks that are larger by more than this part of what was seen: of a motion that is captured
    /// now and then windows of which some have no peak at all are too short.
    pub fn is_vague(&self, from: f64) -> bool {
        let Facts { peak, .. } = self.facts();
        peak.error > from * peak.value
    }

    /// Those of all its windows together.
    fn facts(&self) -> Facts {
        let windows: Vec<_> = self.samples.iter().map(|one| (one.facts, &one.course)).collect();
        Facts::pooled(&windows, self.periods)
    }

    /// By how much the mean square goes up from the first halves of its windows to the second, with twice its standard error.
    fn change(&self) -> [f64; 2] {
        let change = |one: &WindowSample| one.mean_squares[1] - one.mean_squares[0];
        let changes: Vec<f64> = self.samples.iter().map(change).collect();
        [changes.iter().sum::<f64>() / changes.len() as f64, twice_standard_error(&changes)]
    }

    /// Whether its averages still go up or down: of a few windows where most do, of many where all do together.
    pub fn drifts(&self) -> bool {
        let count = self.samples.len();
        if count < MANY {
            return 2 * self.samples.iter().filter(|one| one.drifts).count() > count;
        }
        let [mean, chance] = self.change();
        let size = self.samples.iter().map(|one| one.mean_squares[0]).sum::<f64>() / count as f64;
        mean.abs() > (DRIFT * chance).max(NO_DIFFERENCE * size)
    }

    /// Whether it may be on its way to a motion that repeats, or to other averages; `young` is one that was not measured
    /// often enough to tell.
    pub fn settles(&self, young: bool) -> bool {
        let repeats = |one: &WindowSample| one.evidence.periodicity.is_some();
        let depth = |half: usize| self.samples.iter().map(|one| one.depths[half]).sum::<f64>();
        let stays = if self.samples.len() < MANY { STAYS } else { MANY_STAY };
        let fades = depth(0) > 0.0 && !stays.contains(&(depth(1) / depth(0)));
        let repeating = 2 * self.samples.iter().filter(|one| one.of_repeating_kind()).count();
        self.drifts()
            || repeating > self.samples.len()
                && (young || fades || self.samples.iter().any(repeats))
    }

    /// The motion. It has the regime of what all its windows show together.
    pub fn motion(&self, reached: Reached, settled: bool) -> Motion {
        let evidence: Vec<_> = self.samples.iter().map(|one| one.evidence).collect();
        Motion {
            facts: self.facts(),
            kind: MotionKind::Wanders,
            regime: Regime::of_several(&evidence),
            state: self.samples[0].begin,
            reached,
            settled: settled && !self.drifts(),
            stop: self.samples[0].stop,
        }
    }
}

/// Whether averages are within twice both errors of those of some windows.
fn near(windows: &[Facts], other: &Facts) -> bool {
    let count = windows.len() as f64;
    let near = |of: fn(&Facts) -> Value| {
        let values = || windows.iter().map(of);
        let mean = values().map(|one| one.value).sum::<f64>() / count;
        let apart = |one: Value| (one.value - mean) * (one.value - mean);
        let scatter = (values().map(apart).sum::<f64>() / count).sqrt();
        let own = (values().map(|one| one.error * one.error).sum::<f64>() / count).sqrt();
        let (other, errors) = (of(other).value, own.max(2.0 * scatter) + of(other).error);
        (mean - other).abs() <= (ERRORS * errors).max(NO_DIFFERENCE * mean.max(other))
    };
    near(|facts| facts.rms) && near(|facts| facts.impacts_per_period)
}
