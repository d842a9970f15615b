//! What is measured along a trajectory: impacts, amplitudes, first harmonics, energy balance.
//!
//! Work of the excitation and loss in the damper are integrated independently of the change of
//! stored energy, so that the balance is a check and not an identity.

mod measurement;

use serde::Serialize;

use super::events::{Impact, Side};
use super::integrals::Integrals;
use crate::numerics::is_zero;
use crate::numerics::scatter::{LONGER, error_of_largest, error_of_root, twice_error_of_mean};
use crate::system::{State, System};

pub use measurement::Measurement;

/// Energy balance over a window, per unit of the oscillator's mass, over the squared clearance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Energy {
    /// Work of the excitation.
    pub input: f64,
    /// Lost in the damper.
    pub damper: f64,
    /// Lost in impacts, including the ends of chattering sequences.
    pub impact: f64,
    /// Lost by friction in the cavity.
    #[serde(skip_serializing_if = "is_zero")]
    pub friction: f64,
    /// Change of kinetic and potential energy.
    pub stored: f64,
    /// `abs(input - damper - impact - friction - stored)` over the largest energy that appears in the balance.
    pub relative_residual: f64,
}

/// Time spent in sustained contact.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct SustainedContact {
    /// How often the absorber stuck to a wall.
    pub intervals: u64,
    /// Total fast time it stayed there.
    pub duration_tau: f64,
}

/// What one excitation period looked like.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
#[non_exhaustive]
pub struct PeriodRecord {
    /// Impacts on the `+b` and on the `-b` side.
    pub impacts: [u32; 2],
    /// Visits to the walls: as impacts, but a chattering sequence that ended in sustained contact
    /// is one visit, counted where it began.
    pub visits: [u32; 2],
    /// Largest absolute displacement of the oscillator.
    pub peak: f64,
    /// Largest relative speed of an impact.
    pub impact_speed: f64,
    /// Mean square displacement of the oscillator.
    pub mean_square: f64,
    /// Energy lost in the damper, in impacts and by friction up to the end of the period.
    pub lost: [f64; 3],
    /// State at the end of the period, phase 0.
    pub end: State,
    /// First harmonic of the absorber: coefficients of `sin` and `cos` of the excitation's phase.
    pub absorber_harmonic: [f64; 2],
    /// The same for the oscillator.
    pub oscillator_harmonic: [f64; 2],
}

/// What each of some periods that follow one another came to: by their scatter it is known how well all of them together are.
#[doc(hidden)]
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Course {
    pub peak: Vec<f64>,
    pub impact_speed: Vec<f64>,
    pub mean_square: Vec<f64>,
    pub impacts: Vec<f64>,
}

/// What a [`Measurement`] has measured over whole excitation periods.
#[derive(Debug, Clone)]
pub struct Statistics {
    system: System,
    start: State,
    end: State,
    impacts: u64,
    visits: u64,
    run: WallRun,
    peak: f64,
    impact_speed: f64,
    squared: f64,
    input: f64,
    damper: f64,
    impact_loss: f64,
    friction_loss: f64,
    contact: SustainedContact,
    penetration: f64,
    largest_energy: f64,
    /// The period under way.
    current: PeriodRecord,
    periods: u64,
    records: Vec<PeriodRecord>,
}

/// At least this many of the last periods are kept one by one; sums run over all of them. It bounds
/// the memory of a run of any length, and no regime needs longer to show.
const KEPT: usize = 20_000;

impl Statistics {
    fn begin(system: &System, start: State) -> Self {
        Self {
            system: *system,
            start,
            end: start,
            impacts: 0,
            visits: 0,
            run: WallRun::default(),
            peak: start.x.abs(),
            impact_speed: 0.0,
            squared: 0.0,
            input: 0.0,
            damper: 0.0,
            impact_loss: 0.0,
            friction_loss: 0.0,
            contact: SustainedContact::default(),
            penetration: 0.0,
            largest_energy: energy(system, &start).abs(),
            current: PeriodRecord::default(),
            periods: 0,
            records: Vec::new(),
        }
    }

    /// Whole periods measured.
    pub fn periods(&self) -> u64 {
        self.periods
    }

    /// Impacts in the window.
    pub fn impacts(&self) -> u64 {
        self.impacts
    }

    /// `z`, impacts per excitation period.
    pub fn impacts_per_period(&self) -> f64 {
        self.impacts as f64 / self.periods().max(1) as f64
    }

    /// Visits to a wall per excitation period: as `z`, but a chattering sequence that was seen to end
    /// in sustained contact is one visit, however many impacts it takes.
    pub fn visits_per_period(&self) -> f64 {
        self.visits as f64 / self.periods().max(1) as f64
    }

    /// Largest absolute displacement of the oscillator, over the clearance.
    pub fn peak(&self) -> f64 {
        self.peak
    }

    /// Largest relative speed of an impact, over the clearance, in fast time.
    pub fn impact_speed(&self) -> f64 {
        self.impact_speed
    }

    /// What each of the kept periods came to.
    #[doc(hidden)]
    pub fn course(&self) -> Course {
        let each = |of: fn(&PeriodRecord) -> f64| self.records.iter().map(of).collect();
        Course {
            peak: each(|one| one.peak),
            impact_speed: each(|one| one.impact_speed),
            mean_square: each(|one| one.mean_square),
            impacts: each(|one| f64::from(one.impacts[0] + one.impacts[1])),
        }
    }

    /// By how much another run, ten times as long, may exceed [`Self::peak`] and [`Self::impact_speed`] of a
    /// motion that does not repeat, at odds of 19 to 1, from their scatter between blocks of the kept periods.
    pub fn errors_of_largest(&self) -> [f64; 2] {
        let Course { peak, impact_speed, .. } = self.course();
        [peak, impact_speed].map(|one| error_of_largest(&[&one], LONGER))
    }

    /// Root mean square of the oscillator's displacement, over the clearance.
    pub fn rms(&self) -> f64 {
        let duration = self.periods().max(1) as f64 * self.system.period();
        (self.squared / duration).sqrt()
    }

    /// Two standard errors of [`Self::rms`] and of [`Self::impacts_per_period`], from their scatter
    /// between stretches of the kept periods: how well a motion that does not repeat is known.
    pub fn errors(&self) -> [f64; 2] {
        let Course { mean_square, impacts, .. } = self.course();
        let [square, impacts] = [mean_square, impacts].map(|one| twice_error_of_mean(&[&one]));
        [error_of_root(self.rms(), square), impacts]
    }

    /// Largest penetration of a wall, over the clearance: rounding.
    pub fn penetration(&self) -> f64 {
        self.penetration
    }

    /// Sustained contact in the window.
    pub fn sustained_contact(&self) -> SustainedContact {
        self.contact
    }

    /// One record per period, for the last periods of a long run.
    pub fn records(&self) -> &[PeriodRecord] {
        &self.records
    }

    /// The energy balance over the window.
    pub fn energy(&self) -> Energy {
        let stored = energy(&self.system, &self.end) - energy(&self.system, &self.start);
        let gap = self.input - self.damper - self.impact_loss - self.friction_loss - stored;
        let scale = [
            self.input.abs(),
            self.damper,
            self.impact_loss,
            self.friction_loss,
            self.largest_energy,
        ];
        let scale = scale.into_iter().fold(f64::MIN_POSITIVE, f64::max);
        Energy {
            input: self.input,
            damper: self.damper,
            impact: self.impact_loss,
            friction: self.friction_loss,
            stored,
            relative_residual: gap.abs() / scale,
        }
    }

    /// Share of what the kept periods dissipate that impacts take, with two standard errors between stretches of them; none
    /// where nothing is dissipated. In the long run that is the share of the excitation's work.
    pub fn efficiency(&self) -> Option<[f64; 2]> {
        // Of a long run the first record that was kept has lost what all before it have.
        share_of_impacts(&self.records, self.periods > self.records.len() as u64)
    }

    /// Mean first harmonics of oscillator and absorber over the kept periods: coefficients of `sin` and `cos`.
    pub fn harmonics(&self) -> ([f64; 2], [f64; 2]) {
        let count = self.records.len().max(1) as f64;
        let mut mean = ([0.0; 2], [0.0; 2]);
        for record in &self.records {
            for k in 0..2 {
                mean.0[k] += record.oscillator_harmonic[k] / count;
                mean.1[k] += record.absorber_harmonic[k] / count;
            }
        }
        mean
    }

    /// Adds flights or another stretch in a period, the number of whole periods before which is given: their
    /// peaks and integrals.
    fn add(&mut self, period: u64, stretches: impl Iterator<Item = (f64, Integrals<f64>)>) {
        let scale = self.system.frequency_ratio() / std::f64::consts::PI;
        let (duration, damping) =
            (self.system.period(), self.system.mass_ratio() * self.system.damping());
        let since = self.records.len().checked_sub((self.periods - period) as usize);
        let later = &mut self.records[since.unwrap_or(0)..];
        let mut not_kept = PeriodRecord::default();
        for (peak, sums) in stretches {
            let record = match since {
                Some(_) => later.first_mut().unwrap_or(&mut self.current),
                None => &mut not_kept,
            };
            record.peak = record.peak.max(peak);
            if period < self.periods {
                self.peak = self.peak.max(peak);
            }
            self.squared += sums.displacement_squared;
            record.mean_square += sums.displacement_squared / duration;
            self.input += sums.work;
            for k in 0..2 {
                record.oscillator_harmonic[k] += scale * sums.oscillator[k];
                record.absorber_harmonic[k] += scale * sums.absorber[k];
            }
            let lost = damping * sums.velocity_squared;
            self.damper += lost;
            for record in &mut *later {
                record.lost[0] += lost;
            }
        }
    }

    /// Turns the chattering sequence that has just ended into the visit that its first impact began.
    fn close_sequence(&mut self) {
        let latest = std::iter::once(&mut self.current).chain(self.records.iter_mut().rev());
        self.visits -= u64::from(self.run.close(latest));
    }

    fn impact(&mut self, impact: &Impact) {
        self.impacts += 1;
        let speed = (impact.x_velocity_before - impact.y_velocity_before).abs();
        self.current.impact_speed = self.current.impact_speed.max(speed);
        self.impact_loss += impact.loss;
        self.penetration = self.penetration.max(impact.penetration);
        let wall = impact.side.index();
        self.current.impacts[wall] += 1;
        self.current.visits[wall] += 1;
        self.visits += 1;
        self.run.impact(impact.side);
    }

    fn sticks(&mut self, loss: f64) {
        self.close_sequence();
        self.impact_loss += loss;
        self.contact.intervals += 1;
    }

    /// The absorber has slid one way, so far.
    fn slides(&mut self, slid: f64) {
        let friction = self.system.mass_ratio() * self.system.cavity().friction_acceleration;
        self.friction_loss += friction * slid.abs();
    }

    fn period(&mut self, state: &State) {
        let current = std::mem::take(&mut self.current);
        self.peak = self.peak.max(current.peak);
        self.impact_speed = self.impact_speed.max(current.impact_speed);
        self.end = *state;
        self.largest_energy = self.largest_energy.max(energy(&self.system, state).abs());
        self.periods += 1;
        if self.records.len() >= 2 * KEPT {
            self.records.drain(..KEPT);
        }
        self.records.push(PeriodRecord {
            lost: [self.damper, self.impact_loss, self.friction_loss],
            end: *state,
            ..current
        });
    }
}

/// Successive impacts on one wall since the last impact on the other or the last contact.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct WallRun(Option<(Side, u32)>);

impl WallRun {
    pub fn impact(&mut self, side: Side) {
        self.0 = match self.0 {
            Some((last, length)) if last == side => Some((side, length + 1)),
            _ => Some((side, 1)),
        };
    }

    /// Turns a chattering sequence that has just ended into the visit that its first impact began: by how many visits fewer that makes.
    /// Periods are given from the one under way backwards.
    pub fn close<'a>(&mut self, periods: impl Iterator<Item = &'a mut PeriodRecord>) -> u32 {
        let Some((side, length)) = self.0.take() else { return 0 };
        let fewer = length.saturating_sub(1);
        let mut further = fewer;
        // The latest impacts on this wall are the sequence's; it may have lasted several periods.
        for visits in periods.map(|record| &mut record.visits[side.index()]) {
            if further == 0 {
                break;
            }
            let here = further.min(*visits);
            *visits -= here;
            further -= here;
        }
        fewer
    }
}

/// Share of what some periods dissipate that impacts take, with two standard errors between stretches of them; none where nothing is
/// dissipated. The first of them may have lost what others before it have.
pub(crate) fn share_of_impacts(records: &[PeriodRecord], has_earlier: bool) -> Option<[f64; 2]> {
    let [whole, impact] = lost_in(None, records);
    let share = impact / whole;
    let mut before = records.first().filter(|_| has_earlier).copied();
    let each = records.iter().skip(usize::from(has_earlier)).map(|record| {
        let [dissipated, impact] = lost_in(before, std::slice::from_ref(record));
        before = Some(*record);
        impact - share * dissipated
    });
    let each: Vec<f64> = each.collect();
    let mean = whole / records.len().max(1) as f64;
    (whole > 0.0).then(|| [share, twice_error_of_mean(&[&each]) / mean])
}

/// What some successive periods dissipate, and what impacts take of it; `before` is the period before them.
#[doc(hidden)]
pub fn lost_in(before: Option<PeriodRecord>, periods: &[PeriodRecord]) -> [f64; 2] {
    let begin = before.map_or([0.0; 3], |record| record.lost);
    let end = periods.last().map_or(begin, |record| record.lost);
    let [damper, impact, friction] = [0, 1, 2].map(|k| end[k] - begin[k]);
    [damper + impact + friction, impact]
}

/// Kinetic and potential energy per unit of the oscillator's mass, that of the absorber along a tilted cavity included.
fn energy(system: &System, state: &State) -> f64 {
    let eps = system.mass_ratio();
    state.energy(eps) - eps * system.cavity().gravity_along * state.y
}

#[cfg(test)]
mod tests;
