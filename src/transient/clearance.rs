//! The clearance that serves a structure best which is not driven steadily: with which a released one comes to rest
//! first, or a swept or shaken one moves least, from the worst place of the absorber. What drives it stays as it is
//! in SI.

use std::f64::consts::TAU;

use super::record_study::{flown, over_records};
use super::{DecayStudy, DecayTime, SweepStudy, WithError};
use crate::case::{Case, Design, Rounding};
use crate::excitation::{Record, Release, SineSweep, Transient};
use crate::executor::{Executor, Serial, map};
use crate::flights::{Places, inactive, with_closer};
use crate::linear::bare_decay;
use crate::measure::Measure;
use crate::system::Parameter;

/// Clearances that are looked at between the bounds, and then beside the best.
const CLEARANCES_OF_ROUND: [u32; 2] = [64, 32];
/// Releases that a clearance is looked at for where a case asks for a range of them.
pub const RELEASES: u32 = 5;
/// Places of the absorber by which all clearances are looked at. They are none of those by which a study looks at one:
/// multiplied by the counts, which have different powers of two, places are odd.
const SCREENED: u32 = 32;
const SCREENED_OF_MANY: u32 = 4;
/// Clearances that are judged by a study, about: where an absorber is about to be lost, it is lost from few places at
/// first, and just there a displacement is least.
const JUDGED: u32 = 12;
/// Bounds where the case has none, over its own clearance.
const CLEARANCES: [f64; 2] = [0.2, 5.0];

/// The best clearance that was found. Values are in SI, from the worst place of the absorber, with how much worse others
/// may be: the time to come to rest of the slowest release, or the largest displacement, mean over records; infinite
/// where a structure does not come to rest, or cannot be followed.
#[derive(Debug, Clone)]
pub struct ClearanceOptimum {
    /// The design with it: the case's own where none is better.
    pub design: Design,
    /// From the places of the absorber by which all clearances were looked at.
    pub claimed: WithError,
    /// From those of a study, as every command says it of the design.
    pub checked: WithError,
    /// The same of the case's own clearance.
    pub own: WithError,
    /// The bound beside which it lies, if any: beyond it may be better ones.
    pub bound: Option<f64>,
    /// Clearances, in the units of the design, and the values by which they were looked at.
    pub landscape: Vec<[f64; 2]>,
}

/// Clearances and places of the absorber for each, under each of so many records: all that are looked at, and about as
/// many as are judged by a study, the case's own among them.
pub fn looked_at(records: usize) -> [[u32; 2]; 2] {
    let closer = |starts: u32| if records > 1 { starts } else { with_closer(starts.into()) as u32 };
    let judged = closer(Transient::places_under(records));
    let [between, beside] = CLEARANCES_OF_ROUND;
    [[between + beside, screened(records)], [JUDGED, judged]]
}

fn screened(records: usize) -> u32 {
    if records > 1 { SCREENED_OF_MANY } else { SCREENED }
}

/// Looks for it within the bounds of `[optimize]`. None for a case that is driven steadily.
///
/// All clearances are looked at from even places. The best of them is judged by a study, as the next best is until none is
/// left that promises more than the best that was judged.
pub fn best_clearance(case: &Case, executor: &dyn Executor) -> Option<ClearanceOptimum> {
    let transient = case.design.transient()?;
    let records = case.records();
    let own = case.design.clearance();
    let bounds = case.optimize.clearance.unwrap_or(CLEARANCES.map(|factor| factor * own));
    let judged_by = case.absorber_places()?;
    let value = |clearance: f64, places: Places<'_>| {
        let design = case.design.with(Parameter::Clearance, clearance);
        let found = match &transient {
            Transient::Release(release) => slowest(case, release, &design, places),
            Transient::Sweep(sweep) => swept(case, sweep, &design, places),
            Transient::Record(_) => shaken(case, records, &design, places),
        };
        found.unwrap_or([f64::INFINITY, 0.0])
    };
    let looked = |clearance: f64| {
        let even = screened(records.len()).into();
        value(clearance, Places { even, closer: false, shaking: false, executor: &Serial })
    };
    let mut all: Vec<(f64, WithError)> = Vec::new();
    let mut within = bounds;
    let mut beside = [f64::NEG_INFINITY, f64::INFINITY];
    for (round, count) in CLEARANCES_OF_ROUND.into_iter().enumerate() {
        let place = |k: usize| {
            let part = k as f64 / f64::from(count - 1);
            let place = within[0] * libm::pow(within[1] / within[0], part);
            // As it will be written, within the bounds.
            let written = Rounding::Down.of(place);
            if (bounds[0]..=bounds[1]).contains(&written) { written } else { place }
        };
        let one = |k: usize| (place(k), looked(place(k)));
        all.extend(map(executor, "clearances", count as usize, one));
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        if round == 0 {
            beside = [all[1].0, all[all.len() - 2].0];
        }
        let best = least(&all);
        within = [best.saturating_sub(1), (best + 1).min(all.len() - 1)].map(|k| all[k].0);
    }
    let landscape = all.iter().map(|(clearance, [value, _])| [*clearance, *value]).collect();
    all.sort_by(|a, b| a.1[0].total_cmp(&b.1[0]));
    let judge = |clearance: f64| {
        let closer = records.len() < 2;
        value(clearance, Places { even: judged_by, closer, shaking: false, executor })
    };
    let of_own = judge(own);
    let (mut clearance, mut claimed, mut checked) = (own, looked(own), of_own);
    for (other, promised) in all {
        if promised[0] >= checked[0] {
            break;
        }
        let found = judge(other);
        if found[0] < checked[0] {
            (clearance, claimed, checked) = (other, promised, found);
        }
    }
    let bound = match clearance {
        _ if clearance == own => None,
        _ if clearance < beside[0] => Some(bounds[0]),
        _ if clearance > beside[1] => Some(bounds[1]),
        _ => None,
    };
    Some(ClearanceOptimum {
        design: case.design.with(Parameter::Clearance, clearance),
        claimed,
        checked,
        own: of_own,
        bound,
        landscape,
    })
}

fn least(all: &[(f64, WithError)]) -> usize {
    let least = all.iter().enumerate().min_by(|a, b| a.1.1[0].total_cmp(&b.1.1[0]));
    least.map_or(0, |(index, _)| index)
}

/// Time to come to rest of the slowest release from the worst start; none where that is not seen.
fn slowest(
    case: &Case,
    release: &Release,
    design: &Design,
    places: Places<'_>,
) -> Option<WithError> {
    let (system, units) = (design.system().ok()?, design.units());
    let factors = match case.optimize.releases {
        None => vec![1.0],
        Some([from, to]) => {
            let part = |k: u32| f64::from(k) / f64::from(RELEASES - 1);
            (0..RELEASES).map(|k| from * libm::pow(to / from, part(k))).collect()
        }
    };
    let alone = bare_decay(&system, case.decay_level);
    let time = |factor: &f64| {
        let release = release.scaled(*factor);
        let inactive = inactive(&system, &release.state(&units, 0.0));
        if case.count_inactive && inactive.share > 0.0 && alone.is_infinite() {
            return Some([alone, 0.0]);
        }
        let found = DecayStudy::starts(&system, &units, &release, case.decay_level, places);
        let time = DecayTime::of(&found.ok()?, alone, case.count_inactive, &inactive);
        Some(time.oscillations)
    };
    let times = factors.iter().map(time).collect::<Option<Vec<WithError>>>()?;
    let slowest = times.into_iter().max_by(|a, b| a[0].total_cmp(&b[0]))?;
    Some(slowest.map(|oscillations| units.time(TAU * oscillations)))
}

/// Largest displacement of the passage from the worst start.
fn swept(case: &Case, sweep: &SineSweep, design: &Design, places: Places<'_>) -> Option<WithError> {
    let (system, units) = (design.system().ok()?, design.units());
    let starts = SweepStudy::starts(&system, &units, sweep, places, case.count_inactive).ok()?;
    Some(starts.largest(Measure::Peak)?.map(|peak| units.length(peak)))
}

/// Largest displacement from the worst place of the absorber, mean over records.
fn shaken(
    case: &Case,
    records: &[Record],
    design: &Design,
    places: Places<'_>,
) -> Option<WithError> {
    let (system, units) = (design.system().ok()?, design.units());
    let of_record = |record: &Record| {
        let pieces = record.pieces_to_rest(&units, Record::LONGEST);
        flown(&system, &pieces, places, case.count_inactive).ok()?.largest(Measure::Peak)
    };
    let each = records.iter().map(of_record).collect::<Option<Vec<WithError>>>()?;
    Some(over_records(&each).map(|peak| units.length(peak)))
}
