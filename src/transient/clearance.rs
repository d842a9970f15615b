//! The clearance that serves a structure best which is not driven steadily: with which a released one comes to rest
//! first, or a swept or shaken one moves least, from the worst place of the absorber. What drives it stays as it is
//! in SI.

use std::f64::consts::TAU;

use super::record_study::over_records;
use super::study::{bare, slowest_of};
use super::{
    DecayStudy, Measured, Record, RecordStudy, Release, Response, SineSweep, SweepStudy, Transient,
    counted, follow, places, worst_of_places,
};
use crate::case::{Case, Design, Recording};
use crate::executor::{Executor, map};
use crate::system::Parameter;

/// Clearances of a round, rounds, and the releases looked at where there is a range of them.
const PLACES: u32 = 32;
const ROUNDS: u32 = 2;
const RELEASES: u32 = 5;
/// Clearances that are looked at again: where an absorber is about to be lost, it is lost from few places at first, and
/// just there a displacement is least. At 0.7 % from one to the next they reach back by 8 %.
const CANDIDATES: u32 = 12;
/// Places of the absorber by which a choice is checked.
const CHECKED_STARTS: u32 = 50;
/// Bounds where the case has none, over its own clearance.
const CLEARANCES: [f64; 2] = [0.2, 5.0];

/// The best clearance that was found. Values are in SI, from the worst place of the absorber, with how much worse others
/// may be: the time to come to rest of the slowest release, or the largest displacement, mean over records; infinite
/// where a structure does not come to rest, or cannot be followed.
#[derive(Debug, Clone)]
pub struct Best {
    /// The design with it.
    pub design: Design,
    /// From the places of the absorber by which it was chosen.
    pub claimed: Measured,
    /// From other places.
    pub checked: Measured,
    /// The same of the case's own clearance.
    pub own: Measured,
    /// Clearances, in the units of the design, and the values that made candidates of the best.
    pub landscape: Vec<[f64; 2]>,
}

/// Clearances that are looked at and places of the absorber for each, under each of so many records: all, the best of
/// them again, and the chosen beside the case's own. No place is in two of the sets: multiplied by the counts, which
/// have different powers of two, they are odd.
pub fn looked_at(records: usize) -> [[u32; 2]; 3] {
    let starts = RecordStudy::usual_places(records);
    [[ROUNDS * PLACES, starts], [CANDIDATES, 2 * starts], [2, CHECKED_STARTS]]
}

/// Looks for it within the bounds of `[optimize]`. None for a case that is driven steadily.
pub fn best_clearance(case: &Case, executor: &dyn Executor) -> Option<Best> {
    let transient = case.design.transient()?;
    let records = case.recording.as_ref().map_or_else(Vec::new, Recording::records);
    let [[_, starts], [_, more_starts], [_, other_starts]] = looked_at(records.len());
    let own = case.design.clearance();
    let bounds = case.optimize.clearance.unwrap_or(CLEARANCES.map(|factor| factor * own));
    let value = |clearance: f64, starts: u32| {
        let design = case.design.with(Parameter::Clearance, clearance);
        let found = match &transient {
            Transient::Release(release) => slowest(case, release, &design, starts),
            Transient::Sweep(sweep) => swept(case, sweep, &design, starts),
            Transient::Record(_) => shaken(case, &records, &design, starts),
        };
        found.unwrap_or([f64::INFINITY, 0.0])
    };
    let mut all: Vec<(f64, Measured)> = Vec::new();
    let mut within = bounds;
    for _ in 0..ROUNDS {
        let place = |k: usize| {
            let part = k as f64 / f64::from(PLACES - 1);
            within[0] * libm::pow(within[1] / within[0], part)
        };
        let one = |k: usize| (place(k), value(place(k), starts));
        all.extend(map(executor, "clearances", PLACES as usize, one));
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        let best = least(&all);
        within = [best.saturating_sub(1), (best + 1).min(all.len() - 1)].map(|k| all[k].0);
    }
    let landscape = all.iter().map(|(clearance, [value, _])| [*clearance, *value]).collect();
    all.sort_by(|a, b| a.1[0].total_cmp(&b.1[0]));
    let again = |k: usize| {
        let (clearance, [first, _]) = all[k];
        let [again, error] = value(clearance, more_starts);
        (clearance, [first.max(again), error])
    };
    let candidates = map(executor, "", CANDIDATES as usize, again);
    let (clearance, claimed) = candidates[least(&candidates)];
    let both = map(executor, "", 2, |k| value([clearance, own][k], other_starts));
    Some(Best {
        design: case.design.with(Parameter::Clearance, clearance),
        claimed,
        checked: both[0],
        own: both[1],
        landscape,
    })
}

fn least(all: &[(f64, Measured)]) -> usize {
    let least = all.iter().enumerate().min_by(|a, b| a.1.1[0].total_cmp(&b.1.1[0]));
    least.map_or(0, |(index, _)| index)
}

/// Time to come to rest of the slowest release from the worst start; none where that is not seen.
fn slowest(case: &Case, release: &Release, design: &Design, starts: u32) -> Option<Measured> {
    let (system, scales) = (design.system().ok()?, design.scales());
    let factors = match case.optimize.releases {
        None => vec![1.0],
        Some([from, to]) => {
            let part = |k: u32| f64::from(k) / f64::from(RELEASES - 1);
            (0..RELEASES).map(|k| from * libm::pow(to / from, part(k))).collect()
        }
    };
    let alone = bare(&system, case.decay_level);
    let time = |factor: &f64| {
        let release = release.scaled(*factor);
        let inactive = case.count_inactive && release.may_not_wake(&system, &scales);
        if inactive && alone.is_infinite() {
            return Some([alone, 0.0]);
        }
        let found = DecayStudy::starts(&system, &scales, &release, case.decay_level, starts);
        Some(slowest_of(&found.ok()?, alone, inactive))
    };
    let times = factors.iter().map(time).collect::<Option<Vec<Measured>>>()?;
    let slowest = times.into_iter().max_by(|a, b| a[0].total_cmp(&b[0]))?;
    Some(slowest.map(|oscillations| scales.time(TAU * oscillations)))
}

/// Largest displacement of the passage from the worst start.
fn swept(case: &Case, sweep: &SineSweep, design: &Design, starts: u32) -> Option<Measured> {
    let (system, scales) = (design.system().ok()?, design.scales());
    let counted = SweepStudy::starts(&system, &scales, sweep, starts, case.count_inactive).ok()?;
    let peaks: Vec<f64> = counted.iter().map(|(_, found)| found.peak()[1]).collect();
    Some(worst_of_places(&peaks).map(|peak| scales.length(peak)))
}

/// Largest displacement from the worst place of the absorber, mean over records.
fn shaken(case: &Case, records: &[Record], design: &Design, starts: u32) -> Option<Measured> {
    let (system, scales) = (design.system().ok()?, design.scales());
    let of_record = |record: &Record| {
        let pieces = record.pieces(&scales, Record::LONGEST);
        let place = |w| follow(&system, &pieces, w).ok();
        let found = places(starts.into()).map(place).collect::<Option<Vec<Response>>>()?;
        let counted = counted(&found, case.count_inactive, |found| found.impacts);
        let peaks: Vec<f64> = counted.iter().map(|found| found.peak).collect();
        Some(worst_of_places(&peaks))
    };
    let each = records.iter().map(of_record).collect::<Option<Vec<Measured>>>()?;
    Some(over_records(&each).map(|peak| scales.length(peak)))
}
