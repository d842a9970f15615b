//! Exact periodic orbits over a range of one parameter: both symmetric 1:1 orbits, the asymmetric
//! ones that leave them, those with one more impact beyond a grazing, and every bifurcation between.

use serde::Serialize;

use crate::orbits::Peaks;
use crate::orbits::branch::{BranchDirection, Settings, follow};
use crate::orbits::switching::{branch_off, continue_beyond};
use crate::orbits::{
    Bifurcation, Branch, BranchEnd, Cycle, ImpactMap, Orbit, SpecialPoint, symmetric_orbits,
};
use crate::system::{Parameter, System};

/// Values at which symmetric orbits are looked for, in closed form; a branch that lies between two of
/// them is less than a line's width of a figure.
const SEEDS: u32 = 64;
/// Displacement at impact, over the clearance, by which two symmetric orbits at one value differ at
/// least: a branch is interpolated between points a twentieth apart, which bends less.
const APART: f64 = 5e-3;
/// Relative difference below which two located bifurcations are one.
const SAME: f64 = 1e-6;

/// Relative difference below which a branch ends at a bifurcation: where it is entered, a thousandth of
/// a clearance away in state, its parameter has moved by the square of that.
const ENTRY: f64 = 1e-4;

/// An exact orbit at a value of the parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct ExactPoint {
    /// The parameter.
    pub value: f64,
    /// Largest displacement of the oscillator, over the base system's clearance.
    pub peak: f64,
    /// Times between the impacts of the whole orbit, over the excitation period.
    pub intervals: Vec<f64>,
    /// The impacts; lengths over the clearance at this value.
    pub cycle: Cycle,
}

/// Neighbouring orbits of one branch, all attracting or none.
#[derive(Debug, Clone, PartialEq)]
pub struct ExactPiece {
    /// Whether they attract.
    pub stable: bool,
    /// Whether they are the symmetric 1:1 orbits.
    pub symmetric: bool,
    /// The orbits in order along the branch; the ends may be bifurcations.
    pub points: Vec<ExactPoint>,
}

/// A located bifurcation.
#[derive(Debug, Clone, PartialEq)]
pub struct ExactMark {
    /// Which.
    pub kind: Bifurcation,
    /// Whether it happens to the symmetric 1:1 orbit.
    pub symmetric: bool,
    /// Whether attracting orbits lie on at least one side.
    pub beside_stable: bool,
    /// The orbit there.
    pub at: ExactPoint,
}

/// Neighbouring values at which the symmetric 1:1 orbit attracts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct OrbitStretch {
    /// First and last.
    pub values: [f64; 2],
    /// What happens there; `None` at the end of the range.
    pub ends: [Option<Bifurcation>; 2],
}

/// All branches in a range of the parameter.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ExactBranches {
    /// Pieces of one stability.
    pub pieces: Vec<ExactPiece>,
    /// Bifurcations between them, each once.
    pub marks: Vec<ExactMark>,
}

impl ExactBranches {
    /// Over `range` of `parameter`, everything else being as in `base`. Clearance and forcing are
    /// over those of `base`.
    pub fn over(base: &System, parameter: Parameter, range: [f64; 2]) -> Self {
        let mut all = Self::default();
        let own = parameter.of(base);
        let [low, high] = range;
        let part = |k: u32| (f64::from(k) + 0.5) / f64::from(SEEDS);
        let spread = |k| low * libm::exp(libm::log(high / low) * part(k));
        let seeds = (low..=high).contains(&own).then_some(own);
        for value in seeds.into_iter().chain((0..SEEDS).map(spread)) {
            let Ok(there) = parameter.applied(base, value) else { continue };
            let factor = value / parameter.of(&there);
            let settings = Settings::within(range.map(|edge| edge / factor));
            let trunk = Trunk { system: there, parameter, factor, settings };
            for found in symmetric_orbits(&there).unwrap_or_default() {
                let known = all.passes(value, found.impact_displacement);
                if found.orbit.admissibility.admissible && !known {
                    trunk.grow(&found.orbit, &mut all);
                }
            }
        }
        all
    }

    /// Pairs of neighbouring orbits between which the parameter has a value.
    fn around(&self, value: f64) -> impl Iterator<Item = (&ExactPiece, [&ExactPoint; 2])> {
        self.pieces.iter().flat_map(move |piece| {
            let pairs = piece.points.windows(2).map(|pair| [&pair[0], &pair[1]]);
            pairs
                .filter(move |[a, b]| (a.value - value) * (b.value - value) <= 0.0)
                .map(move |pair| (piece, pair))
        })
    }

    /// For every attracting branch the orbit next to a value of the parameter.
    pub fn attracting(&self, value: f64) -> impl Iterator<Item = &ExactPoint> {
        let stable = self.around(value).filter(|(piece, _)| piece.stable);
        stable.map(
            move |(_, [a, b])| {
                if (a.value - value).abs() <= (b.value - value).abs() { a } else { b }
            },
        )
    }

    /// Where the symmetric 1:1 orbit attracts, and what ends that; ascending.
    #[must_use]
    pub fn attracting_stretches(&self) -> Vec<OrbitStretch> {
        let attracting = self.pieces.iter().filter(|piece| piece.symmetric && piece.stable);
        // A branch turns back only where its stability changes.
        let ends =
            attracting.filter_map(|piece| Some([piece.points.first()?, piece.points.last()?]));
        let mut ranges: Vec<[f64; 2]> =
            ends.map(|[a, b]| [a.value.min(b.value), a.value.max(b.value)]).collect();
        ranges.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut joined: Vec<[f64; 2]> = Vec::new();
        for [low, high] in ranges {
            match joined.last_mut() {
                // A branch is followed both ways from where it was met.
                Some(last) if low <= last[1] * (1.0 + SAME) => last[1] = last[1].max(high),
                _ => joined.push([low, high]),
            }
        }
        let ends_at = |value: f64| {
            let near = |mark: &&ExactMark| (mark.at.value / value - 1.0).abs() < SAME;
            self.marks.iter().filter(|mark| mark.symmetric).find(near).map(|mark| mark.kind)
        };
        joined
            .into_iter()
            .map(|values| OrbitStretch { values, ends: values.map(ends_at) })
            .collect()
    }

    /// Whether a symmetric branch is known that passes a displacement at impact.
    fn passes(&self, value: f64, displacement: f64) -> bool {
        self.around(value).filter(|(piece, _)| piece.symmetric).any(|(_, [a, b])| {
            let x = |point: &ExactPoint| point.cycle.impacts[0].x;
            let width = b.value - a.value;
            let share = if width == 0.0 { 0.0 } else { (value - a.value) / width };
            (x(a) + share * (x(b) - x(a)) - displacement).abs() < APART
        })
    }

    fn mark(&mut self, mark: ExactMark) {
        let same = |other: &&mut ExactMark| {
            let near = |a: f64, b: f64| (a / b - 1.0).abs() < SAME;
            other.kind == mark.kind
                && near(other.at.value, mark.at.value)
                && near(other.at.peak, mark.at.peak)
        };
        match self.marks.iter_mut().find(same) {
            Some(known) => known.beside_stable |= mark.beside_stable,
            None => self.marks.push(mark),
        }
    }
}

/// Where a branch was met: values of clearance and forcing are over this system's own.
struct Trunk {
    system: System,
    parameter: Parameter,
    /// Value of the parameter over its value on a branch that begins with this system.
    factor: f64,
    settings: Settings,
}

impl Trunk {
    /// Follows a symmetric orbit both ways, and what leaves it.
    fn grow(&self, orbit: &Orbit, all: &mut ExactBranches) {
        for direction in [BranchDirection::Down, BranchDirection::Up] {
            let Ok(branch) = follow(&self.system, orbit, self.parameter, direction, &self.settings)
            else {
                continue;
            };
            let closed = matches!(branch.end, BranchEnd::Closed { .. });
            self.add(&branch, true, all);
            for special in &branch.specials {
                self.leave(special, all);
            }
            if closed {
                break;
            }
        }
    }

    /// Follows the asymmetric orbits off a symmetry breaking that they were not seen to end at, and
    /// on across a grazing.
    fn leave(&self, special: &SpecialPoint, all: &mut ExactBranches) {
        let value = self.factor * special.value;
        let ends = all.pieces.iter().filter(|piece| !piece.symmetric);
        let known = ends
            .flat_map(|piece| [piece.points.first(), piece.points.last()])
            .flatten()
            .any(|end| (end.value / value - 1.0).abs() < ENTRY);
        if special.kind != Bifurcation::SymmetryBreaking || known {
            return;
        }
        let Ok(branch) = branch_off(&self.system, self.parameter, special, &self.settings) else {
            return;
        };
        self.add(&branch, false, all);
        for special in branch.specials.iter().filter(|special| special.kind == Bifurcation::Grazing)
        {
            let beyond = continue_beyond(&self.system, self.parameter, special, &self.settings);
            if let Ok(beyond) = beyond {
                self.add(&beyond, false, all);
            }
        }
    }

    fn point(&self, value: f64, orbit: &Orbit) -> Option<ExactPoint> {
        let there = self.parameter.applied(&self.system, value).ok()?;
        let map = ImpactMap::of(&there).ok()?;
        let value = self.factor * value;
        let unit = self.parameter.unit(value);
        let durations = orbit.cycle.unfolded().durations;
        Some(ExactPoint {
            value,
            peak: unit * Peaks::of(&map, &orbit.cycle).displacement,
            intervals: durations.iter().map(|time| time / there.period()).collect(),
            cycle: orbit.cycle.clone(),
        })
    }

    /// Cuts a branch into pieces of one stability, and marks what lies between them.
    fn add(&self, branch: &Branch, symmetric: bool, all: &mut ExactBranches) {
        let mut entries = in_order(branch);
        if !symmetric {
            truncate_at_mirror(&mut entries);
        }
        let points: Option<Vec<ExactPoint>> =
            entries.iter().map(|entry| self.point(entry.value, entry.orbit)).collect();
        let Some(points) = points else { return };
        let stable: Vec<bool> = entries.windows(2).map(stable_between).collect();
        let mut first = 0;
        for run in stable.chunk_by(|a, b| a == b) {
            let last = first + run.len();
            let points = points[first..=last].to_vec();
            all.pieces.push(ExactPiece { stable: run[0], symmetric, points });
            first = last;
        }
        for (k, entry) in entries.iter().enumerate() {
            let Some(kind) = entry.special else { continue };
            let sides = [k.checked_sub(1), Some(k)].into_iter().flatten();
            let beside_stable = sides.filter_map(|side| stable.get(side)).any(|stable| *stable);
            all.mark(ExactMark { kind, symmetric, beside_stable, at: points[k].clone() });
        }
    }
}

/// An orbit of a branch, or a bifurcation on it.
struct BranchEntry<'a> {
    value: f64,
    orbit: &'a Orbit,
    special: Option<Bifurcation>,
}

impl<'a> BranchEntry<'a> {
    fn of_bifurcation(special: &'a SpecialPoint) -> Self {
        Self { value: special.value, orbit: &special.orbit, special: Some(special.kind) }
    }
}

/// Points and bifurcations in order along a branch.
fn in_order(branch: &Branch) -> Vec<BranchEntry<'_>> {
    let (mut entries, mut passed) = (Vec::new(), 0);
    for point in &branch.points {
        entries
            .extend(branch.specials[passed..point.passed].iter().map(BranchEntry::of_bifurcation));
        entries.push(BranchEntry { value: point.value, orbit: &point.orbit, special: None });
        passed = point.passed;
    }
    entries.extend(branch.specials[passed..].iter().map(BranchEntry::of_bifurcation));
    entries
}

/// Stability between two neighbours; at a bifurcation itself it is undefined.
fn stable_between(pair: &[BranchEntry]) -> bool {
    let mut regular = pair.iter().filter(|entry| entry.special.is_none()).peekable();
    regular.peek().is_some() && regular.all(|entry| entry.orbit.attracts())
}

/// Leaves out what lies beyond the place where a branch of asymmetric orbits meets its own mirror
/// image: from there on it is that image.
fn truncate_at_mirror(entries: &mut Vec<BranchEntry>) {
    let met = |entry: &BranchEntry| entry.special == Some(Bifurcation::SymmetryBreaking);
    if let Some(last) = entries.iter().position(met) {
        entries.truncate(last + 1);
    }
}
