//! Stretches of a traced motion: where it is captured in 1:1 resonance, where the oscillator's
//! amplitude falls, where impacts are missing (sections 3.5 and 4.2 of Li, Seguy, Berlioz 2016).

use serde::Serialize;

use crate::simulation::{Impact, Trace};

pub use crate::regimes::thresholds::SHORTEST_CAPTURE;

/// Some whole periods of a trace.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct TraceStretch {
    /// The first period, from 0.
    pub first: usize,
    /// How many.
    pub periods: usize,
}

impl TraceStretch {
    /// The period after the last one.
    #[must_use]
    pub const fn end(&self) -> usize {
        self.first + self.periods
    }

    /// Whether a time, in periods, lies in it.
    #[must_use]
    pub fn holds(&self, periods: f64) -> bool {
        (self.first as f64..=self.end() as f64).contains(&periods)
    }
}

/// What each whole period of a trace looks like.
#[derive(Debug, Clone, PartialEq)]
pub struct Periods {
    /// Largest absolute displacement of the oscillator over the clearance, at the samples.
    pub peaks: Vec<f64>,
    /// Impacts on the `+b` and on the `-b` side.
    pub impacts: Vec<[u32; 2]>,
}

impl Periods {
    /// Looks at a trace, which begins at time 0.
    #[must_use]
    pub fn of(trace: &Trace) -> Self {
        let count = trace.points.last().map_or(0, |point| (point.periods + 1e-9) as usize);
        let mut periods = Self { peaks: vec![0.0; count], impacts: vec![[0; 2]; count] };
        for point in &trace.points {
            if let Some(peak) = periods.peaks.get_mut(point.periods as usize) {
                *peak = point.state.x.abs().max(*peak);
            }
        }
        for (at, impact) in &trace.impacts {
            if let Some(impacts) = periods.impacts.get_mut(*at as usize) {
                impacts[usize::from(impact.side.sign() < 0.0)] += 1;
            }
        }
        periods
    }

    /// Number of periods.
    #[must_use]
    pub fn count(&self) -> usize {
        self.peaks.len()
    }

    /// Whether every period of a stretch has one impact on each wall.
    #[must_use]
    pub fn captured(&self, stretch: TraceStretch) -> bool {
        self.impacts[stretch.first..stretch.end()].iter().all(|impacts| *impacts == [1, 1])
    }

    /// Impacts in a stretch.
    #[must_use]
    pub fn impacts_in(&self, stretch: TraceStretch) -> u32 {
        self.impacts[stretch.first..stretch.end()].iter().flatten().sum()
    }

    /// Last peak of a stretch over its first one.
    #[must_use]
    pub fn growth(&self, stretch: TraceStretch) -> f64 {
        self.peaks[stretch.end() - 1] / self.peaks[stretch.first]
    }

    /// Every capture, whole, in order of time.
    #[must_use]
    pub fn captures(&self) -> Vec<TraceStretch> {
        let mut found = Vec::new();
        let mut first = 0;
        for run in self.impacts.chunk_by(|a, b| (*a == [1, 1]) == (*b == [1, 1])) {
            if run[0] == [1, 1] && run.len() >= SHORTEST_CAPTURE {
                found.push(TraceStretch { first, periods: run.len() });
            }
            first += run.len();
        }
        found
    }

    /// Every stretch of a given length inside another one.
    fn within(outer: TraceStretch, periods: usize) -> impl Iterator<Item = TraceStretch> {
        let last = (outer.end() + 1).saturating_sub(periods);
        (outer.first..last).map(move |first| TraceStretch { first, periods })
    }

    /// The first stretch of a given length that shows at least two captures and as much escape as
    /// capture, as nearly as any does; the beginning where there are no captures.
    #[must_use]
    pub fn typical(&self, periods: usize) -> TraceStretch {
        let captures = self.captures();
        let all = TraceStretch { first: 0, periods: self.count() };
        let beginning = TraceStretch { first: 0, periods: periods.min(self.count()) };
        let unevenness = |stretch: &TraceStretch| {
            let inside = |capture: &&TraceStretch| {
                stretch.first <= capture.first && capture.end() <= stretch.end()
            };
            let parts: Vec<&TraceStretch> = captures.iter().filter(inside).collect();
            let captured: usize = parts.iter().map(|part| part.periods).sum();
            (parts.len() >= 2).then(|| (2 * captured).abs_diff(stretch.periods))
        };
        Self::within(all, periods)
            .filter_map(|stretch| Some((unevenness(&stretch)?, stretch)))
            .min_by_key(|(unevenness, stretch)| (*unevenness, stretch.first))
            .map_or(beginning, |(_, stretch)| stretch)
    }

    /// Where the amplitude falls most while captured (Fig. 12e).
    #[must_use]
    pub fn decrease(&self, outer: TraceStretch, periods: usize) -> Option<TraceStretch> {
        Self::within(outer, periods)
            .filter(|stretch| self.captured(*stretch) && self.growth(*stretch) < 1.0)
            .min_by(|a, b| self.growth(*a).total_cmp(&self.growth(*b)))
    }

    /// Where the amplitude rises most although captured (Fig. 12d).
    #[must_use]
    pub fn weak(&self, outer: TraceStretch, periods: usize) -> Option<TraceStretch> {
        Self::within(outer, periods)
            .filter(|stretch| self.captured(*stretch) && self.growth(*stretch) > 1.0)
            .max_by(|a, b| self.growth(*a).total_cmp(&self.growth(*b)))
    }

    /// Where there are fewest impacts, and among those where the amplitude rises most (Fig. 12f).
    #[must_use]
    pub fn sparse(&self, outer: TraceStretch, periods: usize) -> Option<TraceStretch> {
        Self::within(outer, periods).filter(|stretch| self.growth(*stretch) > 1.0).min_by(|a, b| {
            let fewer = self.impacts_in(*a).cmp(&self.impacts_in(*b));
            fewer.then(self.growth(*b).total_cmp(&self.growth(*a)))
        })
    }
}

/// Impulse of an impact over `m1 omega0 b`: `eps` times the change of the absorber's velocity.
#[must_use]
pub fn impulse(mass_ratio: f64, impact: &Impact) -> f64 {
    mass_ratio * (impact.y_velocity_after - impact.y_velocity_before).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn periods(peaks: &[f64], impacts: &[[u32; 2]]) -> Periods {
        Periods { peaks: peaks.to_vec(), impacts: impacts.to_vec() }
    }

    #[test]
    fn captures_are_runs_of_one_impact_on_each_wall() {
        let (two, none, one) = ([1, 1], [0, 0], [2, 0]);
        let all = periods(&[1.0; 9], &[two, two, none, two, two, two, one, two, two]);
        assert_eq!(all.captures(), [TraceStretch { first: 3, periods: 3 }]);
        assert!(all.captured(TraceStretch { first: 3, periods: 3 }));
        assert!(!all.captured(TraceStretch { first: 3, periods: 4 }));
        assert_eq!(all.impacts_in(TraceStretch { first: 2, periods: 3 }), 4);
    }

    #[test]
    fn stretches_are_chosen_by_what_they_show() {
        let two = [1, 1];
        let all = periods(
            &[5.0, 4.0, 2.0, 2.1, 2.3, 3.0, 4.0, 5.0],
            &[two, two, two, two, two, [1, 0], [0, 0], [0, 0]],
        );
        let whole = TraceStretch { first: 0, periods: 8 };
        assert_eq!(all.decrease(whole, 3), Some(TraceStretch { first: 0, periods: 3 }));
        assert_eq!(all.weak(whole, 3), Some(TraceStretch { first: 2, periods: 3 }));
        assert_eq!(all.sparse(whole, 2), Some(TraceStretch { first: 6, periods: 2 }));
        assert_eq!(all.weak(whole, 6), None);
        assert_eq!(all.typical(4), TraceStretch { first: 0, periods: 4 });
    }
}
