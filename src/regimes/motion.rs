//! A long-term motion as impacts tell it: how large it is, how well that is known, what its impacts do.

use serde::Serialize;

use super::{Evidence, Periodicity, Regime, modulation};
use crate::numerics::scatter::error_of_largest_of;
use crate::simulation::{PeriodRecord, Simulation, Statistics, Stop};
use crate::system::{State, System};

/// Relative difference of root mean squares up to which two motions that hardly scatter are one.
const ALIKE: f64 = 0.01;
/// Relative difference of peaks up to which a simulated motion is that of an exact orbit, and
/// difference of impacts per period: what is left of a transient, and of a window's largest peak.
const AS_EXACT: f64 = 0.01;
/// Impacts per excitation period of a symmetric 1:1 orbit.
const TWO: f64 = 2.0;

/// A long-term motion that was simulated. Lengths over the clearance, fast time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Motion {
    /// Largest absolute displacement of the oscillator that was seen.
    pub peak: f64,
    /// By how much a window ten times as long may exceed that, at odds of 19 to 1, from the largest values
    /// of blocks of the window; 0 for a motion that repeats.
    pub peak_error: f64,
    /// Root mean square displacement of the oscillator.
    pub rms: f64,
    /// Two standard errors of that, between blocks of the window.
    pub rms_error: f64,
    /// Impacts per excitation period.
    pub impacts_per_period: f64,
    /// Two standard errors of that.
    pub impacts_error: f64,
    /// Largest relative speed of an impact.
    pub impact_speed: f64,
    /// As `peak_error`.
    pub impact_speed_error: f64,
    /// Whether its transient is over: it repeats, or its averages do not drift.
    pub settled: bool,
    /// What its impacts do.
    pub regime: Regime,
    /// How many of the starts led to it.
    pub starts: u32,
    /// Share of the excitation's work that impacts dissipate; none where it does no work.
    #[serde(skip)]
    pub efficiency: Option<f64>,
    /// Excitation periods after which it repeats, if it was seen to.
    #[serde(skip)]
    pub repeats_after: Option<u32>,
    /// A state on it, at excitation phase 0.
    #[serde(skip)]
    pub state: State,
    /// Excitation periods from the start to that state.
    #[serde(skip)]
    pub followed: u64,
    /// Why the measurement ended: at the limit on impacts the numbers are those of a part.
    #[serde(skip)]
    pub stop: Stop,
}

impl Motion {
    /// What statistics tell of a window at whose end `simulation` stands: of its last repetition, if the
    /// motion repeats.
    pub(super) fn of(
        statistics: &Statistics,
        evidence: &Evidence,
        simulation: &Simulation,
        stop: Stop,
    ) -> Self {
        let records = statistics.records();
        let motion = Self {
            peak: statistics.peak(),
            rms: statistics.rms(),
            impacts_per_period: evidence.impacts_per_period,
            impact_speed: statistics.impact_speed(),
            regime: Regime::of(evidence),
            efficiency: statistics.efficiency(),
            repeats_after: None,
            stop,
            ..Self::inactive(simulation.system(), simulation.state(), simulation.periods())
        };
        if let Some(found) = evidence.periodicity {
            return motion.repeating(found, records);
        }
        let [rms_error, impacts_error] = statistics.errors();
        let [peak_error, impact_speed_error] = statistics.errors_of_largest();
        Self {
            peak_error,
            rms_error,
            impacts_error,
            impact_speed_error,
            settled: !modulation::drifting(records),
            ..motion
        }
    }

    /// The same of the last repetition alone, in which nothing is stored.
    fn repeating(self, found: Periodicity, records: &[PeriodRecord]) -> Self {
        let last = found.last(records);
        let largest = |value: fn(&PeriodRecord) -> f64| last.iter().map(value).fold(0.0, f64::max);
        let mean_square = last.iter().map(|record| record.mean_square).sum::<f64>();
        let before =
            records.len().checked_sub(last.len() + 1).map_or([0.0; 2], |k| records[k].lost);
        let end = last.last().map_or(before, |record| record.lost);
        let [damper, impact] = [end[0] - before[0], end[1] - before[1]];
        Self {
            peak: largest(|record| record.peak),
            rms: (mean_square / f64::from(found.periods)).sqrt(),
            impact_speed: largest(|record| record.impact_speed),
            efficiency: (damper + impact > 0.0).then(|| impact / (damper + impact)),
            repeats_after: Some(found.periods),
            ..self
        }
    }

    /// The motion without impacts, in closed form; `state` is on it.
    pub(super) fn inactive(system: &System, state: State, followed: u64) -> Self {
        let peak = system.linear_response().map_or(0.0, |response| response.amplitude());
        Self {
            peak,
            peak_error: 0.0,
            rms: peak * std::f64::consts::FRAC_1_SQRT_2,
            rms_error: 0.0,
            impacts_per_period: 0.0,
            impacts_error: 0.0,
            impact_speed: 0.0,
            impact_speed_error: 0.0,
            settled: true,
            regime: Regime::AtRest,
            starts: 1,
            efficiency: (peak > 0.0).then_some(0.0),
            repeats_after: Some(1),
            state,
            followed,
            stop: Stop::EndTime,
        }
    }

    /// Whether the absorber takes no part: there is no impact.
    pub fn is_inactive(&self) -> bool {
        self.impacts_per_period == 0.0
    }

    /// Whether it was seen to repeat.
    pub fn repeats(&self) -> bool {
        self.repeats_after.is_some()
    }

    /// Two standard errors of root mean square and impacts per period, where it does not repeat.
    pub fn errors(&self) -> Option<[f64; 2]> {
        (!self.repeats()).then_some([self.rms_error, self.impacts_error])
    }

    /// Whether it is the symmetric 1:1 orbit with a peak that is known exactly.
    pub fn is_orbit_with_peak(&self, exact: f64) -> bool {
        (self.peak - exact).abs() <= AS_EXACT * exact
            && (self.impacts_per_period - TWO).abs() <= AS_EXACT
    }

    /// Whether it drifts, or is of a kind that repeats and was not seen to: an absorber that has come to rest, or was
    /// captured, only late, or that drifts from one wall to the other for longer than the window.
    pub(super) fn is_settling(&self) -> bool {
        let repeating =
            matches!(self.regime, Regime::AtRest | Regime::TwoSymmetric | Regime::TwoAsymmetric);
        !self.settled || (repeating && !self.repeats())
    }

    /// Whether two starts ended in one motion, as far as root mean square and impacts tell. The errors of a
    /// chaotic motion are so wide that it might else be any other: one that repeats, or is without impacts.
    /// A damped oscillator has one steady motion without impacts.
    pub fn is_same(&self, other: &Self) -> bool {
        if self.is_inactive() || other.is_inactive() {
            return self.is_inactive() == other.is_inactive();
        }
        let chaotic = !self.repeats() && !other.repeats();
        let near = |a: f64, b: f64, errors: f64| {
            within(a, b, ALIKE) || chaotic && (a - b).abs() <= 2.0 * errors
        };
        let impacts = [self, other].map(|one| one.impacts_per_period);
        near(self.rms, other.rms, self.rms_error + other.rms_error)
            && near(impacts[0], impacts[1], self.impacts_error + other.impacts_error)
    }

    /// Whether root mean square and peak agree to a part.
    pub(super) fn is_alike(&self, other: &Self, limit: f64) -> bool {
        within(self.rms, other.rms, limit) && within(self.peak, other.peak, limit)
    }

    /// Takes over another start's measurement of the same motion: the larger extremes, and errors
    /// of what has been seen from so many starts, by their mean scatter. Of several without impacts the
    /// first that has settled stands.
    pub(super) fn join(&mut self, other: &Self) {
        let starts = self.starts + other.starts;
        if self.is_inactive() {
            let settled = if self.settled || !other.settled { *self } else { *other };
            *self = Self { starts, ..settled };
            return;
        }
        self.peak = self.peak.max(other.peak);
        let joined = |a: f64, b: f64| {
            let sum = |error: f64, starts: u32| {
                let alone = error / error_of_largest_of(starts);
                f64::from(starts) * alone * alone
            };
            let mean = (sum(a, self.starts) + sum(b, other.starts)) / f64::from(starts);
            mean.sqrt() * error_of_largest_of(starts)
        };
        self.peak_error = joined(self.peak_error, other.peak_error);
        self.impact_speed_error = joined(self.impact_speed_error, other.impact_speed_error);
        self.impact_speed = self.impact_speed.max(other.impact_speed);
        self.settled |= other.settled;
        self.starts = starts;
    }
}

/// The motions of one system that trajectories have ended in.
pub fn distinct(ended: &[Option<Motion>]) -> Vec<Motion> {
    let mut distinct: Vec<Motion> = Vec::new();
    for motion in ended.iter().flatten() {
        match distinct.iter_mut().find(|known| known.is_same(motion)) {
            Some(known) => known.join(motion),
            None => distinct.push(*motion),
        }
    }
    distinct
}

/// Whether two sizes differ by no more than `limit`, relative to the larger.
pub(super) fn within(a: f64, b: f64, limit: f64) -> bool {
    (a - b).abs() <= limit * a.max(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A repeating motion of two impacts per period.
    fn motion() -> Motion {
        Motion {
            peak: 1.5,
            peak_error: 0.0,
            rms: 1.0,
            rms_error: 0.0,
            impacts_per_period: TWO,
            impacts_error: 0.0,
            impact_speed: 3.0,
            impact_speed_error: 0.0,
            settled: true,
            regime: Regime::TwoSymmetric,
            starts: 1,
            efficiency: None,
            repeats_after: Some(1),
            state: State::AT_REST,
            followed: 0,
            stop: Stop::EndTime,
        }
    }

    #[test]
    fn motions_that_repeat_are_one_within_a_percent() {
        let one = motion();
        for (rms, impacts_per_period, same) in [
            (1.009, 2.0, true),
            (1.02, 2.0, false),
            (0.98, 2.0, false),
            (1.0, 2.01, true),
            (1.0, 2.1, false),
        ] {
            let other = Motion { rms, impacts_per_period, ..one };
            assert_eq!(one.is_same(&other), same, "{rms} {impacts_per_period}");
            assert_eq!(other.is_same(&one), same, "{rms} {impacts_per_period}");
        }
    }

    /// Errors widen what is alike between motions that both scatter, and only there; and no impacts are
    /// never as good as few.
    #[test]
    fn a_motion_that_scatters_is_none_that_repeats() {
        let scattered = Motion {
            rms: 1.1,
            rms_error: 0.1,
            impacts_error: 0.3,
            repeats_after: None,
            ..motion()
        };
        assert!(!scattered.is_same(&motion()) && !motion().is_same(&scattered));
        // Twice the sum of both errors is 0.4.
        let like = |rms: f64| Motion { rms, ..scattered };
        assert!(scattered.is_same(&like(1.45)) && !scattered.is_same(&like(1.55)));
        let fewer = Motion { impacts_per_period: 1.0, ..scattered };
        assert!(scattered.is_same(&fewer), "within 1.2");
        let inactive = Motion { impacts_per_period: 0.0, impacts_error: 3.0, ..scattered };
        assert!(!scattered.is_same(&inactive));
    }

    #[test]
    fn what_starts_agree_on_has_the_larger_extremes() {
        let (smaller, larger) = (motion(), Motion { peak: 1.505, impact_speed: 3.01, ..motion() });
        let other = Motion { rms: 2.0, ..motion() };
        for pair in [[smaller, larger], [larger, smaller]] {
            let ended = [Some(pair[0]), None, Some(other), Some(pair[1])];
            let found = distinct(&ended);
            assert_eq!(found.len(), 2);
            let Motion { peak, impact_speed, starts, .. } = found[0];
            assert_eq!((peak, impact_speed, starts), (1.505, 3.01, 2));
        }
    }

    #[test]
    fn a_motion_of_a_repeating_kind_that_was_not_seen_to_repeat_is_settling() {
        for (regime, settling) in [
            (Regime::AtRest, true),
            (Regime::TwoSymmetric, true),
            (Regime::TwoAsymmetric, true),
            (Regime::StronglyModulated, false),
            (Regime::AboveTwo, false),
            (Regime::BelowTwo, false),
        ] {
            assert!(!Motion { regime, ..motion() }.is_settling());
            let restless = Motion { regime, repeats_after: None, ..motion() };
            assert_eq!(restless.is_settling(), settling, "{regime:?}");
        }
    }

    #[test]
    fn an_orbit_is_known_by_its_peak_and_by_two_impacts() {
        assert!(motion().is_orbit_with_peak(1.51) && !motion().is_orbit_with_peak(1.53));
        let more = Motion { impacts_per_period: 2.02, ..motion() };
        assert!(!more.is_orbit_with_peak(1.5));
    }
}
