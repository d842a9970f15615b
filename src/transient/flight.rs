//! One flight of a structure that is not driven steadily, from a chosen state, impact by impact.

use std::f64::consts::TAU;

use super::Study;
use super::study::longest;
use crate::case::Case;
use crate::excitation::{Record, Transient};
use crate::flights::{DrivenError, Passage, Ringdown, STEPS, follow_from};
use crate::linear::bare_decay;
use crate::simulation::Impact;
use crate::system::State;

/// What one flight did. Lengths over the clearance, fast time.
#[derive(Debug, Clone, PartialEq)]
pub struct OneFlight {
    /// The state in which it began.
    pub start: State,
    /// How long it was.
    pub duration: f64,
    /// Largest displacement of the structure; against the base where a record moves it.
    pub peak: f64,
    /// Impacts.
    pub impacts: u64,
    /// Largest relative speed of one of them.
    pub impact_speed: f64,
    /// Of a released structure, time after which its amplitude stays at the level or below it; infinite where that was not
    /// seen.
    pub settles: Option<f64>,
}

impl OneFlight {
    /// Flies a case that is not driven steadily from a state, for so many oscillations of the structure or periods of the
    /// excitation at the most, under the first of its records; `told` hears of every impact, its time that since the
    /// start. None for another case.
    ///
    /// # Errors
    /// [`DrivenError`] for a start outside of the cavity, or where the motion cannot be followed.
    pub fn of_case(
        case: &Case,
        start: State,
        periods: Option<u64>,
        told: &mut dyn FnMut(&Impact),
    ) -> Option<Result<Self, DrivenError>> {
        let (system, units) = (case.system(), case.units());
        let none = Self {
            start,
            duration: 0.0,
            peak: start.x.abs(),
            impacts: 0,
            impact_speed: 0.0,
            settles: None,
        };
        let flown = match case.design.transient()? {
            Transient::Release(release) => {
                let level = case.decay_level * release.amplitude(&units);
                let most =
                    periods.unwrap_or_else(|| longest(bare_decay(&system, case.decay_level)));
                Ringdown::follow_telling(&system, start, level, most, None, told)
                    .map(|found| Self {
                        duration: TAU * (found.amplitudes.len() - 1) as f64 / f64::from(STEPS),
                        peak: found.peak,
                        impacts: found.impacts.last().copied().unwrap_or(0),
                        impact_speed: found.impact_speeds.last().copied().unwrap_or(0.0),
                        // Nothing comes down to a share of 0.
                        settles: (level > 0.0).then_some(TAU * found.settles),
                        ..none
                    })
                    .map_err(DrivenError::from)
            }
            Transient::Sweep(sweep) => {
                let most = periods.unwrap_or(u64::MAX);
                Passage::follow_telling(&system, &units, &sweep, start, most, false, told)
                    .map(|(found, duration)| Self {
                        duration,
                        peak: found.peak()[1],
                        impacts: found.impacts,
                        impact_speed: found.impact_speed,
                        ..none
                    })
                    .map_err(DrivenError::from)
            }
            Transient::Record(_) => {
                let Some(record) = case.records().first() else {
                    return Some(Err(DrivenError::NoRecord));
                };
                let mut pieces = record.pieces_to_rest(&units, Record::LONGEST);
                let mut left = periods.map_or(f64::INFINITY, |periods| TAU * periods as f64);
                pieces.retain_mut(|piece| {
                    let begins = left > 0.0;
                    piece.rings = piece.rings.min(left);
                    left -= piece.duration;
                    begins
                });
                follow_from(&system, &pieces, start, false, told).map(|found| Self {
                    duration: found.duration,
                    peak: found.peak.max(none.peak),
                    impacts: found.impacts,
                    impact_speed: found.impact_speed,
                    ..none
                })
            }
        };
        Some(flown)
    }

    /// The state in which a study's worst start begins: that of the place of the absorber which the case's numbers are
    /// of. None where nothing was flown.
    pub fn worst_start(case: &Case, study: &Study) -> Option<State> {
        let at_rest = |w: f64| State { y: -w, ..State::AT_REST };
        match study {
            Study::Release(study) => {
                Some(case.design.release()?.state(&case.units(), study.worst()?.0))
            }
            Study::Sweep(study) => study.worst().map(|(w, _)| at_rest(*w)),
            Study::Record(study) => study.first()?.worst().map(|(w, _)| at_rest(*w)),
        }
    }
}
