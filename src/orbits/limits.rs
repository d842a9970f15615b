//! Where symmetric 1:1 orbits begin and end: the stability limits of the full system at one
//! frequency, over all clearances and forcings at once.
//!
//! Each value of `beta` belongs to one forcing per clearance ([`super::symmetric`]), so that the whole
//! family is a curve over `beta` and its bifurcations are roots of functions of one variable; the
//! saddle-node is explicit.

use serde::Serialize;

use super::OrbitError;
use super::admissibility::{Admissibility, Departure};
use super::impact_map::{ImpactMap, Wall};
use super::multipliers::{Multipliers, minus_one, unit_product};
use super::orbit::Cycle;
use super::symmetric::{SymmetricCurve, SymmetricOrbit, symmetric_orbit};
use crate::bifurcation::Bifurcation;
use crate::numerics::bracket::brent;
use crate::numerics::scan::below;
use crate::system::{Parameters, System};

/// Largest amplitude of the absorber that is looked at, over the clearance: far beyond symmetry
/// breaking, which the leading-order theory puts at 1.68.
const LARGEST: f64 = 5.0;
/// Pieces of that range in which sign changes are looked for. Two roots of a multiplier within one
/// are found by the dip between them; two grazings within a fiftieth of a clearance would be missed.
const PIECES: u32 = 250;
/// How often the distance to the saddle-node is halved: next to it, on either orbit, may lie others.
const HALVINGS: i32 = 24;
/// Share of a stretch over which the slope at its ends is asked for.
const SLOPE: f64 = 1e-3;
/// Width to which a root in `beta` is bracketed: its rounding.
const WIDTH: f64 = 1e-14;

/// Change of `beta`, over itself, at which stability beside a limit is asked for: close to the limit,
/// and far outside of its rounding, which the multipliers show to the square root of 1e-14 where two
/// of them meet.
const ASIDE: f64 = 1e-5;

/// Value of a test function at its root, over its values on either side, above which it jumps there
/// instead of vanishing: roots of closed forms leave 1e-12.
const VANISHES: f64 = 1e-6;

/// Distance in `beta` from a root at which the test function is asked for once more: a hundred
/// times the width to which it was bracketed.
const ROUNDING: f64 = 1e-12;

/// A limit of the family.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Limit {
    /// What happens there.
    pub kind: Bifurcation,
    /// `beta` there.
    pub absorber_amplitude: f64,
    /// `gamma` there.
    pub forcing_over_clearance: f64,
    /// Clearance over the system's own at its own forcing.
    pub clearance: f64,
    /// Clearances between which it was bracketed, over the system's own.
    pub bracket: [f64; 2],
    /// The test function's value there.
    pub test: f64,
    /// Whether an attracting orbit exists on one side of it and not on the other.
    pub bounds_stability: bool,
}

/// A stretch of clearances with an attracting symmetric 1:1 orbit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct StableStretch {
    /// Clearances over the system's own, ascending.
    pub clearance: [f64; 2],
    /// What ends it at either; `None` at the edge of the range that was looked at.
    pub ends: [Option<Bifurcation>; 2],
}

/// All symmetric 1:1 orbits at one frequency.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SymmetricFamily {
    /// Limits in order of `beta`.
    pub limits: Vec<Limit>,
    /// Clearances with an attracting orbit.
    pub stable: Vec<StableStretch>,
}

/// The family while it is looked at: a unit of forcing, scaled to each `beta`.
struct Family {
    system: System,
    map: ImpactMap,
    curve: SymmetricCurve,
    forcing: f64,
}

impl Family {
    fn of(system: &System) -> Result<Self, OrbitError> {
        let unit = Parameters { forcing_per_clearance: 1.0, ..system.parameters() };
        // Every other parameter has been proven valid.
        let unit = System::new(unit).map_err(|_| OrbitError::NoSteadyMotion)?;
        let map = ImpactMap::of(&unit)?;
        let curve = SymmetricCurve::with(&unit, &map.flight);
        Ok(Self { system: unit, map, curve, forcing: system.forcing_per_clearance() })
    }

    fn map_at(&self, beta: f64) -> ImpactMap {
        self.map.with_forcing(self.curve.forcing(beta))
    }

    fn orbit(&self, beta: f64) -> Option<SymmetricOrbit> {
        symmetric_orbit(&self.system, &self.map_at(beta), &self.curve, beta)
    }

    fn test(&self, kind: Bifurcation, beta: f64) -> f64 {
        let map = self.map_at(beta);
        let cycle = self.curve.cycle(&map.flight, beta);
        match kind {
            Bifurcation::SymmetryBreaking => minus_one(&cycle.jacobian(&map)),
            Bifurcation::NeimarkSacker => unit_product(&cycle.jacobian(&map)),
            Bifurcation::Grazing => Admissibility::of(&map, &cycle.flights()).min_wall_distance,
            Bifurcation::Sticking => self.curve.departure(&map.flight, beta),
            _ => beta - self.curve.turning(),
        }
    }

    fn attracts(&self, beta: f64) -> bool {
        beta > 0.0 && self.orbit(beta).is_some_and(|orbit| orbit.orbit.attracts())
    }

    fn limit(&self, kind: Bifurcation, beta: f64, bracket: [f64; 2]) -> Limit {
        let forcing = self.curve.forcing(beta);
        let clearance = |beta: f64| self.forcing / self.curve.forcing(beta);
        let [a, b] = bracket.map(clearance);
        let aside = ASIDE * beta;
        Limit {
            kind,
            absorber_amplitude: beta,
            forcing_over_clearance: forcing,
            clearance: clearance(beta),
            bracket: [a.min(b), a.max(b)],
            test: self.test(kind, beta),
            bounds_stability: self.attracts(beta - aside) != self.attracts(beta + aside),
        }
    }
}

impl Limit {
    /// The orbit at the limit, as half a cycle; lengths over the clearance there.
    ///
    /// # Errors
    /// As [`SymmetricFamily::of`].
    pub fn cycle(&self, system: &System) -> Result<Cycle, OrbitError> {
        let family = Family::of(system)?;
        Ok(family
            .curve
            .cycle(&family.map_at(self.absorber_amplitude).flight, self.absorber_amplitude))
    }
}

impl SymmetricFamily {
    /// The family of `system`'s frequency, mass ratio, damping and restitution.
    ///
    /// # Errors
    /// [`OrbitError::NoSteadyMotion`] for an undamped oscillator driven at its natural frequency.
    pub fn of(system: &System) -> Result<Self, OrbitError> {
        let family = Family::of(system)?;
        let turning = family.curve.turning();
        let mut limits = Vec::new();
        if turning > 0.0 && turning < LARGEST {
            let width = WIDTH * turning;
            limits.push(family.limit(
                Bifurcation::SaddleNode,
                turning,
                [turning - width, turning + width],
            ));
        }
        limits.extend(family.sticking());
        for kind in
            [Bifurcation::SymmetryBreaking, Bifurcation::NeimarkSacker, Bifurcation::Grazing]
        {
            limits.extend(family.roots(kind));
        }
        limits.sort_by(|a, b| a.absorber_amplitude.total_cmp(&b.absorber_amplitude));
        let stable = family.stable_stretches(&limits);
        Ok(Self { limits, stable })
    }

    /// The nearest limit of stability of either kind on each side of a clearance factor, among
    /// stretches that contain it.
    pub fn stretch_around(&self, clearance: f64) -> Option<&StableStretch> {
        self.stable
            .iter()
            .find(|stretch| stretch.clearance[0] <= clearance && clearance <= stretch.clearance[1])
    }
}

impl Family {
    /// Where the absorber begins to stay on the wall; only an impact without rebound lets it.
    fn sticking(&self) -> Option<Limit> {
        let beta = self.curve.sticking(&self.map.flight).filter(|beta| *beta < LARGEST)?;
        let map = self.map_at(beta);
        let after = self.curve.after_impact(&map.flight, beta);
        let width = WIDTH * beta;
        Departure::of(&map, &after, Wall::Plus)
            .is_still()
            .then(|| self.limit(Bifurcation::Sticking, beta, [beta - width, beta + width]))
    }

    fn roots(&self, kind: Bifurcation) -> Vec<Limit> {
        let step = LARGEST / f64::from(PIECES);
        let mut found = Vec::new();
        let mut before = self.test(kind, 0.5 * step);
        for k in 1..PIECES {
            let (from, to) = ((f64::from(k) - 0.5) * step, (f64::from(k) + 0.5) * step);
            let after = self.test(kind, to);
            let scale = before.abs().max(after.abs());
            for bracket in self.brackets(kind, [from, to], [before, after]) {
                found.extend(self.root(kind, bracket, scale));
            }
            before = after;
        }
        found
    }

    /// Every stretch within a piece at whose ends the test function differs in sign.
    fn brackets(
        &self,
        kind: Bifurcation,
        [from, to]: [f64; 2],
        [before, after]: [f64; 2],
    ) -> Vec<[f64; 2]> {
        let mut points = vec![(from, before), (to, after)];
        if kind != Bifurcation::Grazing {
            let turning = self.curve.turning();
            let offsets = (0..HALVINGS).map(|k| libm::ldexp(to - from, -k));
            let beside = offsets.flat_map(|offset| [turning - offset, turning + offset]);
            let inside = beside.chain([turning]).filter(|beta| from < *beta && *beta < to);
            points.extend(inside.map(|beta| (beta, self.test(kind, beta))));
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            let dips: Vec<_> =
                points.windows(2).filter_map(|pair| self.dip(kind, pair[0], pair[1])).collect();
            points.extend(dips);
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        let changes = points.windows(2).filter(|pair| pair[0].1 * pair[1].1 < 0.0);
        let found: Vec<[f64; 2]> = changes.map(|pair| [pair[0].0, pair[1].0]).collect();
        if found.len() == 1 { vec![[from, to]] } else { found }
    }

    /// A place between two points at which the test function has the other sign than at both.
    fn dip(&self, kind: Bifurcation, a: (f64, f64), b: (f64, f64)) -> Option<(f64, f64)> {
        let height = |beta: f64| a.1.signum() * self.test(kind, beta);
        let (low, high) = (a.0, b.0);
        let step = SLOPE * (high - low);
        let sinks = |from: f64, by: f64, there: f64| height(from + by) < there.abs();
        if a.1 * b.1 <= 0.0 || !sinks(low, step, a.1) || !sinks(high, -step, b.1) {
            return None;
        }
        let (at, height) = below(low, high, height)?;
        Some((at, a.1.signum() * height))
    }

    fn root(&self, kind: Bifurcation, [from, to]: [f64; 2], scale: f64) -> Option<Limit> {
        let root = brent(from, to, WIDTH, |beta| self.test(kind, beta))?;
        self.is_real(kind, root.at, scale)
            .then(|| self.limit(kind, root.at, [root.at - WIDTH, root.at + WIDTH]))
    }

    /// Not a jump of the test function, and not two real reciprocal multipliers.
    fn is_real(&self, kind: Bifurcation, beta: f64, scale: f64) -> bool {
        if self.test(kind, beta).abs() > VANISHES * scale {
            return false;
        }
        if kind == Bifurcation::Grazing {
            // Where the absorber begins to stay on the wall the room jumps, from nothing.
            let beside = [beta - ROUNDING, beta + ROUNDING].map(|beta| self.test(kind, beta));
            return beside.iter().all(|room| room.abs() <= VANISHES * scale);
        }
        if kind != Bifurcation::NeimarkSacker {
            return true;
        }
        let map = self.map_at(beta);
        let jacobian = self.curve.cycle(&map.flight, beta).jacobian(&map);
        Multipliers::of(&jacobian).is_some_and(|found| found.has_pair_on_circle())
    }

    /// Between neighbouring limits stability is one and the same.
    fn stable_stretches(&self, limits: &[Limit]) -> Vec<StableStretch> {
        let mut edges: Vec<(f64, Option<Bifurcation>)> =
            vec![(0.5 * LARGEST / f64::from(PIECES), None)];
        edges.extend(limits.iter().map(|limit| (limit.absorber_amplitude, Some(limit.kind))));
        edges.push((LARGEST, None));
        let mut found: Vec<StableStretch> = Vec::new();
        let clearance = |beta: f64| self.forcing / self.curve.forcing(beta);
        let mut open: Option<(f64, Option<Bifurcation>)> = None;
        for pair in edges.windows(2) {
            let middle = 0.5 * (pair[0].0 + pair[1].0);
            let attracts = self.attracts(middle);
            if attracts && open.is_none() {
                open = Some(pair[0]);
            }
            let last = pair[1].0 == LARGEST;
            if let Some(begin) = open
                && (!attracts || last)
            {
                let end = if attracts { pair[1] } else { pair[0] };
                found.push(stretch(begin, end, &clearance));
                open = None;
            }
        }
        found
    }
}

fn stretch(
    begin: (f64, Option<Bifurcation>),
    end: (f64, Option<Bifurcation>),
    clearance: &impl Fn(f64) -> f64,
) -> StableStretch {
    let (a, b) = (clearance(begin.0), clearance(end.0));
    if a <= b {
        StableStretch { clearance: [a, b], ends: [begin.1, end.1] }
    } else {
        StableStretch { clearance: [b, a], ends: [end.1, begin.1] }
    }
}
