//! What a sweep's table says, counted.

use serde::Serialize;

use super::grid::{Grid, SweepDirection};
use super::kinds::AREAS;
use crate::regimes::Regime;

/// Peaks of one motion measured twice differ by less: where it repeats, by what is left of a transient; a
/// motion that does not repeat is told by its regime alone.
const SAME_PEAK: f64 = 0.02;

/// What is known of all motions of a pass.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Facts {
    #[serde(skip)]
    pub pass: SweepDirection,
    /// `up`, `down`, or nothing where each point was looked at by itself.
    pub direction: Option<&'static str>,
    /// Points with a motion.
    pub worked_out: usize,
    pub regimes: Vec<RegimeFacts>,
    /// The largest reduction of the peak and the smallest, and where.
    pub best: Option<Extreme>,
    pub worst: Option<Extreme>,
    /// The smallest peak and the largest.
    pub smallest: Option<Extreme>,
    pub largest: Option<Extreme>,
    pub coexistence: Option<Coexistence>,
    /// Regimes by the theory's area.
    pub areas: Vec<Group>,
    /// Regimes where an exact orbit attracts, and where none does.
    pub orbits: Vec<Group>,
    /// Points at which an exact orbit attracts and no start leads to it.
    pub orbit_missed: Option<usize>,
}

/// A regime's part of the points.
#[derive(Debug, Clone, Serialize)]
pub(super) struct RegimeFacts {
    pub regime: Regime,
    pub points: usize,
    /// Of the points with a regime.
    pub share: f64,
    /// In the case's unit of length.
    pub peak: Option<[f64; 2]>,
    pub reduction_db: Option<[f64; 2]>,
    pub impacts_per_period: Option<[f64; 2]>,
}

/// A value at a point.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Extreme {
    pub value: f64,
    pub point: usize,
    /// Where the point lies on each axis.
    pub at: Vec<f64>,
}

/// Where several motions exist.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Coexistence {
    pub points: usize,
    /// Of the points with a motion.
    pub share: f64,
    /// Most motions at a point.
    pub most: usize,
    /// First and last index on each axis at which there are several.
    pub from_to: Vec<[usize; 2]>,
}

/// Regimes of the points that have something in common.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Group {
    pub name: &'static str,
    pub points: usize,
    /// Points of each regime, in the order from many impacts to none.
    pub regimes: [usize; Regime::ALL.len()],
}

impl Group {
    pub(super) fn share(&self, regime: Regime) -> f64 {
        self.regimes[regime.index()] as f64 / self.points.max(1) as f64
    }
}

/// Smallest and largest of the values that are there.
fn range(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    values.fold(None, |range: Option<[f64; 2]>, value| {
        Some(range.map_or([value; 2], |[low, high]| [low.min(value), high.max(value)]))
    })
}

/// The first point with the largest value, and the first with the smallest.
fn extremes(grid: &Grid, values: Option<&[Option<f64>]>) -> [Option<Extreme>; 2] {
    let values = values.unwrap_or_default();
    let find = |sign: f64| {
        let there = values.iter().enumerate();
        let there = there.filter_map(|(point, value)| Some((point, (*value)?)));
        let (point, value) = there.reduce(|best, one| match sign * one.1 > sign * best.1 {
            true => one,
            false => best,
        })?;
        let at = grid.indices(point).into_iter().zip(&grid.swept.axes);
        Some(Extreme { value, point, at: at.map(|(k, axis)| axis.values[k]).collect() })
    };
    [find(1.0), find(-1.0)]
}

impl Facts {
    pub(super) fn of(grid: &Grid, pass: SweepDirection) -> Self {
        let points = grid.points();
        let regimes = grid.regimes(pass);
        let peak = grid.number("peak", pass);
        let reduction = grid.number("reduction_db", pass);
        let rate = grid.number("impacts_per_period", pass);
        let any = [&peak, &reduction, &rate, &grid.number("rms", pass)];
        let there = |point: usize| {
            let simulated = regimes.as_ref().map(|regimes| regimes[point].is_some());
            simulated.unwrap_or_else(|| any.into_iter().flatten().any(|of| of[point].is_some()))
        };
        let worked_out = (0..points).filter(|point| there(*point)).count();
        let group = |name: &'static str, within: &dyn Fn(usize) -> bool| {
            let mut group = Group { name, points: 0, regimes: [0; Regime::ALL.len()] };
            for (point, regime) in regimes.iter().flatten().enumerate() {
                let Some(regime) = regime.filter(|_| within(point)) else { continue };
                group.points += 1;
                group.regimes[regime.index()] += 1;
            }
            group
        };
        let all = group("", &|_| true);
        let of_regime = |regime: Regime| {
            let of = |values: &Option<Vec<Option<f64>>>| {
                let values = values.as_ref()?;
                let here = regimes.iter().flatten().enumerate();
                range(here.filter_map(|(k, found)| values[k].filter(|_| *found == Some(regime))))
            };
            RegimeFacts {
                regime,
                points: all.regimes[regime.index()],
                share: all.share(regime),
                peak: of(&peak),
                reduction_db: of(&reduction),
                impacts_per_period: of(&rate),
            }
        };
        let found = Regime::ALL.into_iter().map(of_regime);
        let areas = grid.text("area", SweepDirection::Single);
        let by_area = areas.iter().flat_map(|areas| {
            AREAS.iter().map(|(area, _)| group(area, &|point| areas[point] == Some(*area)))
        });
        let orbit = grid.number("orbit_peak", SweepDirection::Single);
        let by_orbit = orbit.iter().flat_map(|orbit| {
            [
                group("exact 1:1 orbit attracts", &|point| orbit[point].is_some()),
                group("none attracts", &|point| orbit[point].is_none()),
            ]
        });
        let [best, worst] = extremes(grid, reduction.as_deref());
        let [largest, smallest] = extremes(grid, peak.as_deref());
        Self {
            pass,
            direction: match pass {
                SweepDirection::Single => None,
                SweepDirection::Up => Some("up"),
                SweepDirection::Down => Some("down"),
            },
            worked_out,
            regimes: found.filter(|one| one.points > 0).collect(),
            best,
            worst,
            smallest,
            largest,
            coexistence: coexistence(grid, pass, worked_out),
            areas: by_area.filter(|group| group.points > 0).collect(),
            orbits: by_orbit.filter(|group| group.points > 0).collect(),
            orbit_missed: orbit_missed(grid, pass),
        }
    }

    /// The regime of the most points.
    pub(super) fn main(&self) -> Option<&RegimeFacts> {
        self.regimes.iter().reduce(|best, one| if one.points > best.points { one } else { best })
    }
}

fn coexistence(grid: &Grid, pass: SweepDirection, worked_out: usize) -> Option<Coexistence> {
    let motions = grid.number("motions", pass)?;
    let several: Vec<usize> = (0..motions.len())
        .filter(|point| motions[*point].is_some_and(|count| count > 1.0))
        .collect();
    let indices: Vec<Vec<usize>> = several.iter().map(|point| grid.indices(*point)).collect();
    let along = |axis: usize| {
        let on = || indices.iter().map(|of| of[axis]);
        [on().min().unwrap_or(0), on().max().unwrap_or(0)]
    };
    Some(Coexistence {
        points: several.len(),
        share: several.len() as f64 / worked_out.max(1) as f64,
        most: motions.iter().flatten().fold(0.0, |most: f64, count| most.max(*count)) as usize,
        from_to: (0..grid.swept.axes.len()).map(along).collect(),
    })
}

/// Where it is not recorded whether a start leads to the orbit, only a single motion that is another one
/// tells that none does.
fn orbit_missed(grid: &Grid, pass: SweepDirection) -> Option<usize> {
    let orbit = grid.number("orbit_peak", SweepDirection::Single)?;
    if let Some(reached) = grid.number("orbit_reached", pass) {
        let missed = |(orbit, reached): &(&Option<f64>, &Option<f64>)| {
            orbit.is_some() && reached.is_some_and(|reached| reached == 0.0)
        };
        return Some(orbit.iter().zip(&reached).filter(missed).count());
    }
    let (regimes, motions) = (grid.regimes(pass)?, grid.number("motions", pass)?);
    let missed = |point: &usize| {
        let other = regimes[*point].is_some_and(|regime| regime != Regime::TwoSymmetric);
        orbit[*point].is_some() && other && motions[*point] == Some(1.0)
    };
    Some((0..orbit.len()).filter(missed).count())
}

/// Points at which what was followed up differs from what was followed down; `None` where a motion was not
/// followed.
pub(super) fn hysteresis(grid: &Grid) -> Option<Vec<bool>> {
    let (up, down) = (grid.regimes(SweepDirection::Up), grid.regimes(SweepDirection::Down));
    let peaks = [SweepDirection::Up, SweepDirection::Down].map(|pass| grid.number("peak", pass));
    let regimes = up.zip(down);
    if regimes.is_none() && peaks.iter().any(Option::is_none) {
        return None;
    }
    let repeats = |regime: Option<Regime>| {
        !matches!(regime, None | Some(Regime::StronglyModulated | Regime::BelowTwo))
    };
    let differs = |point: usize| {
        if let Some((up, down)) = &regimes {
            let both = up[point].zip(down[point]);
            if both.is_some_and(|(up, down)| up != down) {
                return true;
            }
            if !repeats(up[point]) || both.is_none() {
                return false;
            }
        }
        let [up, down] = peaks.each_ref().map(|peaks| peaks.as_ref().and_then(|all| all[point]));
        up.zip(down).is_some_and(|(up, down)| (up - down).abs() > SAME_PEAK * up.max(down))
    };
    Some((0..grid.points()).map(differs).collect())
}
