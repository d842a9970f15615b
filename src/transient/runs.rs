//! Runs of one structure from many places of its absorber, and what of them counts.

use crate::flights::{Passage, Response, share_above, worst_of_places};
use crate::linear::Linear;
use crate::measure::Measure;
use crate::system::Shaking;

/// A value and its error: of one record how much worse other places of the absorber may be, of several twice the
/// standard error of the mean over records.
pub type WithError = [f64; 2];

/// One run, with the absorber, a damper or neither. Lengths over the clearance, times in oscillations of the structure.
pub trait Run {
    /// What it has of a measure; none where it has no such number.
    fn get(&self, of: Measure) -> Option<f64>;

    /// Whether the absorber hits a wall in it.
    fn wakes(&self) -> bool {
        true
    }
}

/// From which places of the absorber something is known: how many were flown, the even ones of them first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sample {
    /// Even ones.
    pub even: u64,
    /// All, with those closer to the worst.
    pub all: usize,
}

impl Sample {
    /// The share of all places that are worse than the worst of these, at most, at odds of 19 to 1.
    pub fn share_above(self) -> f64 {
        share_above(self.even)
    }
}

/// The relative displacement of the absorber at each start, and what happened, in the order in which they were flown.
#[derive(Debug, Clone, PartialEq)]
pub struct Runs<R> {
    /// All of them.
    pub all: Vec<(f64, R)>,
    /// How many of the first are at even places.
    pub even: u64,
    /// Whether those count in which the absorber never hits a wall, beside those in which it does.
    pub count_inactive: bool,
}

impl<R> Runs<R> {
    /// From which places it is known.
    pub const fn sample(&self) -> Sample {
        Sample { even: self.even, all: self.all.len() }
    }
}

impl<R: Run> Runs<R> {
    /// Those that count: any, where the absorber hits a wall in none.
    pub fn counting(&self) -> Vec<&(f64, R)> {
        self.with(self.count_inactive)
    }

    /// The same where those in which the absorber never hits a wall count, or do not.
    fn with(&self, inactive: bool) -> Vec<&(f64, R)> {
        let counts = |one: &&(f64, R)| inactive || one.1.wakes();
        let some: Vec<&(f64, R)> = self.all.iter().filter(counts).collect();
        if some.is_empty() { self.all.iter().collect() } else { some }
    }

    fn values(&self, of: Measure) -> Option<Vec<f64>> {
        let values: Option<Vec<f64>> =
            self.counting().into_iter().map(|(_, run)| run.get(of)).collect();
        values.filter(|values| !values.is_empty())
    }

    /// The largest, and by how much those of other places may exceed it.
    pub fn largest(&self, of: Measure) -> Option<WithError> {
        self.values(of).map(|values| worst_of_places(&values))
    }

    /// The least.
    pub fn least(&self, of: Measure) -> Option<f64> {
        self.values(of)?.into_iter().min_by(f64::total_cmp)
    }

    /// The run with the largest value.
    pub fn worst(&self, of: Measure) -> Option<&(f64, R)> {
        let value = |one: &(f64, R)| one.1.get(of).unwrap_or(f64::NEG_INFINITY);
        self.counting().into_iter().max_by(|a, b| value(a).total_cmp(&value(b)))
    }

    /// From the largest value on, those in which the absorber never hits a wall among them if they count.
    pub fn sorted(&self, of: Measure, inactive: bool) -> Vec<&(f64, R)> {
        let mut all = self.with(inactive);
        let value = |one: &(f64, R)| one.1.get(of).unwrap_or(f64::NEG_INFINITY);
        all.sort_by(|a, b| value(b).total_cmp(&value(a)));
        all
    }

    /// By the place of the absorber.
    pub fn by_place(&self) -> Vec<&(f64, R)> {
        let mut all: Vec<&(f64, R)> = self.all.iter().collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all
    }
}

impl Run for Linear {
    fn get(&self, of: Measure) -> Option<f64> {
        match of {
            Measure::DecayTime => Some(self.settles),
            Measure::Stroke => Some(self.stroke),
            _ => None,
        }
    }
}

/// What velocity and acceleration have of a measure.
pub(super) fn shaken(shaking: Option<&Shaking>, of: Measure) -> Option<f64> {
    of.fact()?.of_shaking(shaking?)
}

impl Run for Passage {
    fn get(&self, of: Measure) -> Option<f64> {
        Some(match of {
            Measure::Peak => self.peak()[1],
            Measure::PeakFrequency => self.peak()[0],
            Measure::ImpactSpeed => self.impact_speed,
            Measure::Impacts => self.impacts as f64,
            Measure::Stroke => self.stroke,
            _ => return shaken(self.shaking.as_ref(), of),
        })
    }

    fn wakes(&self) -> bool {
        self.impacts > 0
    }
}

impl Run for Response {
    fn get(&self, of: Measure) -> Option<f64> {
        Some(match of {
            Measure::Peak => self.peak,
            Measure::Rms => self.rms,
            Measure::ImpactSpeed => self.impact_speed,
            Measure::Impacts => self.impacts as f64,
            Measure::ImpactEnergyShare => self.impact_loss / self.work,
            Measure::Stroke => self.stroke,
            _ => return shaken(self.shaking.as_ref(), of),
        })
    }

    fn wakes(&self) -> bool {
        self.impacts > 0
    }
}

#[cfg(test)]
mod tests {
    use super::{Measure, Response, Runs};

    /// What does not count is no row above what the verdict says.
    #[test]
    fn the_worst_rows_are_those_that_count() {
        let run =
            |peak: f64, impacts: u64| (0.0, Response { peak, impacts, ..Response::default() });
        let runs = Runs { all: vec![run(3.0, 0), run(2.0, 5)], even: 2, count_inactive: false };
        let peaks = |inactive: bool| -> Vec<f64> {
            runs.sorted(Measure::Peak, inactive).iter().map(|(_, found)| found.peak).collect()
        };
        assert_eq!((peaks(true), peaks(false)), (vec![3.0, 2.0], vec![2.0]));
        assert_eq!(runs.largest(Measure::Peak), Some([2.0, 0.0]));
    }
}
