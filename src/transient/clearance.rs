//! The clearance with which a released structure comes to rest first, from the worst place of the absorber, for a
//! range of releases.

use super::study::{awake, bare};
use super::{DecayStudy, Release};
use crate::case::{Case, Design};
use crate::executor::{Executor, map};
use crate::system::Parameter;

/// Clearances of a round, rounds, and the releases looked at where there is a range of them.
const PLACES: u32 = 32;
const ROUNDS: u32 = 3;
const RELEASES: u32 = 5;
/// Places of the absorber by which a clearance is chosen, and other ones by which the choice is checked.
const STARTS: u32 = 16;
const CHECKED_STARTS: u32 = 50;
/// Bounds where the case has none, over its own clearance.
const CLEARANCES: [f64; 2] = [0.2, 5.0];

/// The best clearance that was found.
#[derive(Debug, Clone)]
pub struct Best {
    /// The design with it.
    pub design: Design,
    /// Time to come to rest from the worst start of all releases, in oscillations; infinite where none of the
    /// clearances brings it to rest.
    pub oscillations: f64,
    /// The same from other starts.
    pub checked: f64,
    /// The same of the case's own clearance.
    pub own: f64,
    /// Clearances, in the units of the design, and the times that decided.
    pub landscape: Vec<[f64; 2]>,
}

/// Looks for it within the bounds of `[optimize]`. None for a case that is not released.
pub fn best_clearance(case: &Case, executor: &dyn Executor) -> Option<Best> {
    let release = case.design.release()?;
    let own = case.design.clearance();
    let bounds = case.optimize.clearance.unwrap_or(CLEARANCES.map(|factor| factor * own));
    let time = |clearance: f64, starts: u32| slowest(case, &release, clearance, starts);
    let mut landscape: Vec<[f64; 2]> = Vec::new();
    let mut within = bounds;
    for _ in 0..ROUNDS {
        let place = |k: usize| {
            let part = k as f64 / f64::from(PLACES - 1);
            within[0] * libm::pow(within[1] / within[0], part)
        };
        let one = |k: usize| [place(k), time(place(k), STARTS)];
        landscape.extend(map(executor, "clearances", PLACES as usize, one));
        landscape.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let best = least(&landscape);
        within =
            [best.saturating_sub(1), (best + 1).min(landscape.len() - 1)].map(|k| landscape[k][0]);
    }
    let [clearance, oscillations] = landscape[least(&landscape)];
    let both = map(executor, "", 2, |k| time([clearance, own][k], CHECKED_STARTS));
    let design = case.design.with(Parameter::Clearance, clearance);
    Some(Best { design, oscillations, checked: both[0], own: both[1], landscape })
}

fn least(landscape: &[[f64; 2]]) -> usize {
    let least = landscape.iter().enumerate().min_by(|a, b| a.1[1].total_cmp(&b.1[1]));
    least.map_or(0, |(index, _)| index)
}

/// Time to come to rest of the slowest release from the worst start; infinite where that is not seen.
fn slowest(case: &Case, release: &Release, clearance: f64, starts: u32) -> f64 {
    let design = case.design.with(Parameter::Clearance, clearance);
    let Ok(system) = design.system() else { return f64::INFINITY };
    let scales = design.scales();
    let factors = match case.optimize.releases {
        None => vec![1.0],
        Some([from, to]) => {
            let part = |k: u32| f64::from(k) / f64::from(RELEASES - 1);
            (0..RELEASES).map(|k| from * libm::pow(to / from, part(k))).collect()
        }
    };
    let time = |factor: &f64| {
        let release = release.scaled(*factor);
        if case.count_inactive && release.may_not_wake(&system, &scales) {
            return bare(&system, case.decay_level);
        }
        let found = DecayStudy::starts(&system, &scales, &release, case.decay_level, starts);
        let Ok(found) = found else { return f64::INFINITY };
        let times = awake(&found).map(|start| start.oscillations);
        times.reduce(f64::max).unwrap_or_else(|| bare(&system, case.decay_level))
    };
    factors.iter().map(time).fold(0.0, f64::max)
}
