//! The motion in which the structure moves farthest under each load, over time, with its impacts.

use std::f64::consts::TAU;

use super::{AlongLoad, ModalAnswer, ModalError};
use crate::case::ModalCase;
use crate::motions::{Effort, ModalMotion};
use crate::simulation::{ModalImpact, Reading, Side};

/// Periods shown of a motion that repeats, at least, and at most; of one that does not; and of one with fewer than two impacts per period,
/// which come irregularly.
const FEW: u64 = 6;
const MANY: u64 = 70;
const SOME: u64 = 12;
const RARE: u64 = 30;
/// Most absorbers that are shown.
const ABSORBERS: usize = 4;
/// About so many impacts can be told apart.
const IMPACTS: f64 = 400.0;
/// Samples in an excitation period, fewest and most, and in a period of the fastest mode between these.
const SAMPLES: [f64; 2] = [60.0, 300.0];
const SAMPLES_OF_MODE: f64 = 24.0;

/// Some periods of a motion under a load, in SI units or those of a reduced case, from excitation phase 0 on.
#[derive(Debug, Clone, PartialEq)]
pub struct OverTime {
    /// The load, by its number in the case from 0.
    pub load: usize,
    /// The frequency in Hz.
    pub at: f64,
    /// The motion, by its number in the list there from 0.
    pub motion: usize,
    /// Whether the structure moves farthest under the load in it; else every absorber rests in that motion, and this is the one with
    /// impacts in which it moves farthest.
    pub is_worst: bool,
    /// Whether it repeats; else the structure may move farther in it at another time.
    pub repeats: bool,
    /// The place that moves farthest in it, by its number in the case from 0.
    pub place: usize,
    /// The absorbers that are shown, by their numbers in the case from 0: those that impact at that place, or where none does all that
    /// impact; of more than a few those with the fastest impacts.
    pub absorbers: Vec<usize>,
    /// Excitation periods.
    pub periods: u64,
    /// Times of the samples in s, ascending; the same twice at an impact.
    pub times_s: Vec<f64>,
    /// Displacement of the place at these times in m.
    pub displacement_m: Vec<f64>,
    /// Displacement of the structure relative to each of the absorbers shown at these times in m.
    pub gaps_m: Vec<Vec<f64>>,
    /// Every impact of these absorbers, in order of time.
    pub impacts: Vec<LoadImpact>,
}

/// An impact of a motion under a load, in SI units or those of a reduced case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadImpact {
    /// The load, by its number in the case from 1.
    pub load: usize,
    /// The frequency in Hz.
    pub at: f64,
    /// The motion, by its number in the list there from 0.
    pub motion: usize,
    /// The absorber, by its number in the case from 1.
    pub absorber: usize,
    /// Time in s since excitation phase 0 of the first period.
    pub time_s: f64,
    /// The wall: that where the structure's displacement exceeds the absorber's by the clearance, or the other one.
    pub side: Side,
    /// Displacement of the structure at the absorber in m.
    pub x_m: f64,
    /// Velocity of the structure there in m/s before and after.
    pub x_velocity: [f64; 2],
    /// Velocity of the absorber in m/s before and after.
    pub y_velocity: [f64; 2],
}

impl LoadImpact {
    /// `tau`, `x`, the velocities of the structure before and after, and those of the absorber, as a file of impacts has them: lengths over
    /// the absorber's clearance, time in fast time of the first mode.
    pub fn over_clearance(&self, case: &ModalCase) -> [f64; 6] {
        let (length, omega) = (case.absorbers[self.absorber - 1].clearance_m, case.omega());
        let [x_before, x_after] = self.x_velocity.map(|one| one / (length * omega));
        let [y_before, y_after] = self.y_velocity.map(|one| one / (length * omega));
        [self.time_s * omega, self.x_m / length, x_before, x_after, y_before, y_after]
    }

    /// Relative speed in m/s at which they meet.
    pub fn speed(&self) -> f64 {
        (self.x_velocity[0] - self.y_velocity[0]).abs()
    }
}

/// The motion of a load that is shown.
struct Shown<'a> {
    load: usize,
    at: f64,
    number: usize,
    motion: &'a ModalMotion,
    is_worst: bool,
}

impl<'a> Shown<'a> {
    /// That in which the structure moves farthest under a load. Where every absorber rests in it the one with impacts in which it does, at
    /// the same frequency, or at any where there is none at that; none where nothing impacts.
    fn of(case: &ModalCase, answer: &'a ModalAnswer, load: usize) -> Option<Self> {
        let along: &AlongLoad = answer.along.get(load)?;
        let worst = answer.worst(case, Some(load))?.found;
        let here = along.at(worst.at?)?;
        let motion = here.motions.get(worst.motion)?;
        if !motion.rests() {
            return Some(Self { load, at: here.at, number: worst.motion, motion, is_worst: true });
        }
        let moving = |only: Option<f64>| {
            let places =
                along.places.iter().filter(move |one| only.is_none_or(|only| one.at == only));
            let all = places.flat_map(|one| {
                let motions = one.motions.iter().enumerate();
                let counts =
                    motions.filter(|(_, motion)| !motion.rests() && motion.counts(one.count_rest));
                counts.map(|(number, motion)| (one.at, number, motion))
            });
            all.max_by(|a, b| farthest(a.2).1.total_cmp(&farthest(b.2).1))
        };
        let (at, number, motion) = moving(Some(here.at)).or_else(|| moving(None))?;
        Some(Self { load, at, number, motion, is_worst: false })
    }

    fn impact(&self, case: &ModalCase, of: &ModalImpact) -> LoadImpact {
        let ModalImpact { tau, absorber, side, x, x_velocity, y_velocity, .. } = *of;
        let omega = case.omega();
        LoadImpact {
            load: self.load + 1,
            at: self.at,
            motion: self.number,
            absorber: absorber + 1,
            time_s: tau / omega,
            side,
            x_m: x,
            x_velocity: x_velocity.map(|one| omega * one),
            y_velocity: y_velocity.map(|one| omega * one),
        }
    }

    /// The absorbers that are shown beside a place, ascending.
    fn absorbers(&self, case: &ModalCase, place: usize) -> Vec<usize> {
        let impacts = |j: &usize| self.motion.impacts_per_period[*j][0] > 0.0;
        let mut all: Vec<usize> = (0..case.absorbers.len()).filter(impacts).collect();
        let there = |j: &usize| case.absorbers[*j].place == place;
        if all.iter().any(there) {
            all.retain(there);
        }
        let speed = |j: &usize| self.motion.impact_speed[*j][0];
        all.sort_by(|a, b| speed(b).total_cmp(&speed(a)));
        all.truncate(ABSORBERS);
        all.sort_unstable();
        all
    }

    /// So many that the pattern is seen, and no more impacts of one of these absorbers than can be told apart.
    fn periods(&self, absorbers: &[usize]) -> u64 {
        let counts = absorbers.iter().map(|j| self.motion.impacts_per_period[*j][0]);
        let impacts = counts.fold(0.0, f64::max);
        let wanted = match self.motion.repeats_after {
            Some(after) => FEW.max(2 * u64::from(after)).min(MANY),
            None if impacts < 2.0 => RARE,
            None => SOME,
        };
        let most = IMPACTS / impacts.max(0.1);
        wanted.min((most as u64).max(FEW))
    }
}

/// The place that moves farthest in a motion, and by how much in m.
fn farthest(motion: &ModalMotion) -> (usize, f64) {
    let each = motion.read(Reading::Displacement).map(|one| one.peak).enumerate();
    each.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default()
}

impl OverTime {
    /// Of each load under which an absorber impacts, in the order of the case.
    pub fn all(case: &ModalCase, answer: &ModalAnswer) -> Vec<Self> {
        (0..case.loads.len()).filter_map(|load| Self::of(case, answer, load)).collect()
    }

    /// Of a load, by its number in the case from 0; none where no absorber impacts under it.
    pub fn of(case: &ModalCase, answer: &ModalAnswer, load: usize) -> Option<Self> {
        let shown = Shown::of(case, answer, load)?;
        let (place, _) = farthest(shown.motion);
        let absorbers = shown.absorbers(case, place);
        let periods = shown.periods(&absorbers);
        let fastest = case.modes.iter().map(|mode| mode.frequency_hz).fold(0.0, f64::max);
        let samples = (SAMPLES_OF_MODE * fastest / shown.at).clamp(SAMPLES[0], SAMPLES[1]);
        let mut trace = shown.motion.trace(periods, samples)?;
        let period_s = TAU * case.modes[0].frequency_hz / (case.omega() * shown.at);
        let impacts = trace.impacts.iter().filter(|one| absorbers.contains(&one.absorber));
        let impacts = impacts.map(|one| shown.impact(case, one)).collect();
        Some(Self {
            load,
            at: shown.at,
            motion: shown.number,
            is_worst: shown.is_worst,
            repeats: shown.motion.repeats_after.is_some(),
            place,
            periods,
            times_s: trace.periods.iter().map(|at| at * period_s).collect(),
            displacement_m: trace.places.swap_remove(place),
            gaps_m: absorbers.iter().map(|j| std::mem::take(&mut trace.gaps[*j])).collect(),
            absorbers,
            impacts,
        })
    }
}

/// Excitation periods of which impacts are told, unless asked for otherwise.
pub fn usual_periods(case: &ModalCase) -> u64 {
    if case.periods > 0 { case.periods } else { Effort::default().periods }
}

impl ModalAnswer {
    /// Every impact of all absorbers in the first excitation periods of the motion in which the structure moves farthest under each load,
    /// or where every absorber rests in that of the one with impacts in which it does: load by load, in order of time.
    ///
    /// # Errors
    /// [`ModalError::Lost`] where one has more impacts than can be followed.
    pub fn impacts(&self, case: &ModalCase, periods: u64) -> Result<Vec<LoadImpact>, ModalError> {
        let shown = (0..case.loads.len()).filter_map(|load| Shown::of(case, self, load));
        let each = shown.map(|shown| {
            let lost = ModalError::Lost { load: shown.load + 1, periods };
            let trace = shown.motion.trace(periods, 0.0).ok_or(lost)?;
            Ok(trace.impacts.iter().map(|one| shown.impact(case, one)).collect::<Vec<_>>())
        });
        Ok(each.collect::<Result<Vec<_>, ModalError>>()?.concat())
    }
}
