//! All orbits with two impacts per excitation period, one on each wall, in a cavity of any kind: the roots of one
//! function of the time between them.
//!
//! Impact 1 is on the wall `+b`, impact 2, a time `t_1` later, on `-b`, `t_2 = T - t_1`. The absorber goes the way
//! `delta = t_1 t_2 eta/T` and back, with the accelerations `alpha_1 = a - f`, `alpha_2 = a + f`:
//!
//! `u_1 = t_2 eta/T - alpha_1 t_1/2` after impact 1, `u_1 + alpha_1 t_1` before impact 2, and so on. With them the changes
//! `j_1 = eta - m`, `j_2 = -eta - m`, `2 m = alpha_1 t_1 + alpha_2 t_2`, of the absorber's velocity are linear in `eta`; so
//! are by restitution the oscillator's velocities `(1 + r) v_- = u_+ + r u_- + eps j`, and so is its motion `z` under the
//! impulses `-eps j` and friction `+-eps f`, which repeats after `T`. The steady motion at the impacts is what is left,
//! `X = x - z`, `V = v_- - z'_-`. It is `A sin + B cos` of the phase from midway between them, `-h` and `h = Omega t_1/2`,
//!
//! `2 A sin h = X_2 - X_1 = delta - 2 - z_2 + z_1 = E`, `2 Omega A cos h = V_1 + V_2`, `2 Omega B sin h = V_1 - V_2 = G`.
//!
//! The first two are one linear equation, `l_0 + l_1 eta = Omega E cos h - (V_1 + V_2) sin h = 0`, and the amplitude of the
//! steady motion without impacts, `A^2 + B^2 = L^2`, is `F(t_1) = 0` with
//!
//! `F = Omega^2 (E_0 l_1 - E_1 l_0)^2 + (G_0 l_1 - G_1 l_0)^2 - (2 Omega L l_1 sin h)^2`.
//!
//! `F` is an entire function: it has no poles, and at either end it is
//! `(2 Omega (1 + eps)(1 - r_1 r_2)/((1 + r_1)(1 + r_2)))^2`, so that no orbit hides there. In a symmetric cavity `l_0` and
//! `l_1` vanish at `T/2`, where the symmetric orbits are ([`symmetric_orbits`]), and `F/cos(h)^2` has the asymmetric roots.
//!
//! Its roots are counted: on every piece the polynomial through the values at Chebyshev nodes, with what it misses at the
//! places between them, says that there is no root, or that `F` is monotone; else the piece is halved, of the same polynomial
//! while what it misses is little, then of another. What is left undecided is returned: orbits that are about to collide.
//! Exact, at any mass ratio; the orbits with both impacts on one wall are others.

use nalgebra::{Matrix2, RowVector2, Vector2};
use serde::Serialize;

use super::OrbitError;
use super::cycle::{Closure, Cycle};
use super::impact_map::{AfterImpact, ImpactMap, Wall};
use super::measures::Peaks;
use super::newton::{Converged, converge};
use super::orbit::{Orbit, Origin};
use super::symmetric::{SymmetricOrbit, attracting_orbit, symmetric_orbits};
use crate::numerics::bracket::narrowed;
use crate::numerics::chebyshev::Interpolant;
use crate::numerics::scan::places;
use crate::system::System;

/// Radians of the fastest motion in the pieces of a period that the search begins with, and most pieces.
const RADIANS: f64 = 8.0;
const PIECES: f64 = 1e4;
/// Width over the period below which a piece stays undecided: rounding of `F` at neighbouring roots.
const NARROWEST: f64 = 1e-12;
/// Most pieces that are looked at beyond those the search begins with: forty halvings around each of some hundred roots.
const MOST: usize = 10_000;
/// Shortest flight over the period that is looked for. Where an impact takes energy there is none shorter, see above;
/// without any loss a flight that short would have a speed of 1e8 clearances a radian.
const SHORTEST: f64 = 1e-9;
/// Distance from `T/2`, over the period, from which asymmetric orbits of a symmetric cavity are looked for: its square,
/// the distance in clearance or forcing from the symmetry breaking, is rounding.
const ASYMMETRIC: f64 = 1e-6;
/// Change of `t_1` over the period by which Newton's method leads to another orbit: a root is bisected to rounding.
const SAME: f64 = 1e-6;

/// The orbits of a system with two impacts per period, one on each wall.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TwoImpactOrbits {
    /// By ascending time from the impact on the `+b` wall to the other one; those that are no motions included, if both
    /// walls are met from inside. The
    /// symmetric ones of a symmetric cavity are [`Closure::Mirrors`], the asymmetric ones come with their mirror images.
    pub orbits: Vec<Orbit>,
    /// Times between which the search cannot tell whether there are orbits; fast time.
    pub undecided: Vec<[f64; 2]>,
}

/// All orbits of a system with two impacts per excitation period, one on each wall, whatever its cavity.
///
/// ```
/// # use vinesink_core::system::{Cavity, Excitation, Parameters, System};
/// use vinesink_core::orbits::two_impact_orbits;
///
/// // The system of the crate page with 1 degree of inclination: the way down, to the wall at -b, is shorter.
/// let system = System::new(Parameters {
///     mass_ratio: 0.032 / 4.168, damping: 1.799, restitution: 0.6, frequency_ratio: 8.0 / 8.349,
///     forcing_per_clearance: 4.3417, excitation: Excitation::BaseDisplacement,
///     cavity: Cavity { gravity_along: 0.4753 * 0.01745, ..Cavity::IDEAL },
/// })?;
/// let found = two_impact_orbits(&system)?;
/// assert!(found.undecided.is_empty());
/// let steady = found.orbits.iter().find(|orbit| orbit.attracts()).expect("one attracts");
/// let [there, back] = steady.cycle.durations[..] else { panic!("two flights") };
/// assert!(there < back && (there + back - system.period()).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`OrbitError::NoSteadyMotion`] for an undamped oscillator driven at its natural frequency,
/// [`OrbitError::Singular`] for one driven at a whole part of it.
pub fn two_impact_orbits(system: &System) -> Result<TwoImpactOrbits, OrbitError> {
    let pair = Pair::of(system)?;
    let symmetric = symmetric_orbits(system)?.into_iter();
    let mut orbits: Vec<Orbit> = symmetric.map(|found| found.orbit).collect();
    let (roots, mut undecided) = pair.cycles(system.cavity().is_symmetric());
    for s in roots {
        let orbit = pair.converged(s).and_then(|found| found.orbit(Origin::ClosedForm).ok());
        undecided.extend(orbit.is_none().then_some([s, s]));
        orbits.extend(orbit);
    }
    orbits.sort_by(|a, b| a.cycle.durations[0].total_cmp(&b.cycle.durations[0]));
    let undecided = undecided.iter().map(|piece| piece.map(|s| 0.5 * pair.period + s)).collect();
    Ok(TwoImpactOrbits { orbits, undecided })
}

/// An orbit with two impacts per period, with what a design asks of it; lengths over the clearance, fast time.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct SteadyOrbit {
    /// The orbit.
    pub orbit: Orbit,
    /// Largest displacement and velocity of the oscillator.
    pub peaks: Peaks,
    /// Relative speed at which the walls are met, the larger of both.
    pub impact_speed: f64,
}

impl SteadyOrbit {
    /// An orbit, measured.
    pub fn of(map: &ImpactMap, orbit: Orbit) -> Self {
        let impact_speed = Self::impact_speed_of(map, &orbit.cycle);
        Self { peaks: Peaks::of(map, &orbit.cycle), impact_speed, orbit }
    }

    /// Largest relative speed at which a cycle meets a wall.
    pub fn impact_speed_of(map: &ImpactMap, cycle: &Cycle) -> f64 {
        cycle.steps(map).iter().map(|step| step.approach.abs()).fold(0.0, f64::max)
    }
}

impl From<SymmetricOrbit> for SteadyOrbit {
    fn from(found: SymmetricOrbit) -> Self {
        let SymmetricOrbit { orbit, peaks, impact_speed, .. } = found;
        Self { orbit, peaks, impact_speed }
    }
}

/// Relative distance between the impacts of two orbits below which one is the other, or its mirror image: solved to 1e-10,
/// with room for the multipliers of a nearly singular one.
pub const ONE_ORBIT: f64 = 1e-6;

/// Every orbit with one impact on each wall per period that attracts, in a cavity of any kind; of two mirror images one.
///
/// # Errors
/// As [`two_impact_orbits`].
pub fn attracting_orbits(system: &System) -> Result<Vec<Orbit>, OrbitError> {
    let pair = Pair::of(system)?;
    let symmetric = symmetric_orbits(system)?.into_iter().map(|found| found.orbit);
    let mut orbits: Vec<Orbit> = symmetric.filter(Orbit::attracts).collect();
    let (roots, _) = pair.cycles(system.cavity().is_symmetric());
    let converged = roots.into_iter().filter_map(|s| pair.converged(s));
    orbits.extend(converged.filter_map(|found| found.attracting_orbit(Origin::ClosedForm)));
    orbits.sort_by(|a, b| a.cycle.durations[0].total_cmp(&b.cycle.durations[0]));
    let mut found: Vec<Orbit> = Vec::new();
    for orbit in orbits {
        if !found.iter().any(|known| known.cycle.is_one_with(&orbit.cycle, ONE_ORBIT)) {
            found.push(orbit);
        }
    }
    Ok(found)
}

/// The first of them that is symmetric, or else the first, measured.
pub fn steady_orbit(system: &System) -> Option<SteadyOrbit> {
    let symmetric = || attracting_orbit(system).map(SteadyOrbit::from);
    if let Some(found) = system.cavity().is_ideal().then(symmetric).flatten() {
        return Some(found);
    }
    let orbit = attracting_orbits(system).ok()?.into_iter().next()?;
    Some(SteadyOrbit::of(&ImpactMap::of(system).ok()?, orbit))
}

/// The same, measured.
///
/// # Errors
/// As [`two_impact_orbits`].
pub fn steady_orbits(system: &System) -> Result<Vec<SteadyOrbit>, OrbitError> {
    if system.cavity().is_ideal() {
        return Ok(symmetric_orbits(system)?.into_iter().map(SteadyOrbit::from).collect());
    }
    let (map, found) = (ImpactMap::of(system)?, two_impact_orbits(system)?.orbits);
    Ok(found.into_iter().map(|orbit| SteadyOrbit::of(&map, orbit)).collect())
}

/// The two impacts of a system, at any time between them.
struct Pair {
    map: ImpactMap,
    eps: f64,
    period: f64,
    /// `L^2`.
    squared: f64,
    /// `(I - Phi(T))^-1`.
    repeated: Matrix2<f64>,
}

/// What follows from `s = t_1 - T/2`; rows are the constant and the coefficient of `eta`.
struct ImpactRows {
    durations: [f64; 2],
    /// `sin(h)`, `cos(h)`.
    turn: [f64; 2],
    /// `E`, `G`, `l`.
    way: RowVector2<f64>,
    difference: RowVector2<f64>,
    line: RowVector2<f64>,
    /// Changes of the absorber's velocity.
    jumps: [RowVector2<f64>; 2],
    /// Displacement beside the steady motion, velocities of oscillator and absorber after each impact.
    after: [[RowVector2<f64>; 3]; 2],
}

impl ImpactRows {
    /// `(1, eta)` by the linear equation.
    fn solved(&self) -> Vector2<f64> {
        Vector2::new(1.0, -self.line[0] / self.line[1])
    }

    /// Whether the walls throw the absorber back: in a cycle whose impacts come from outside they would pull it.
    fn meets_from_inside(&self) -> bool {
        let [first, second] = self.jumps.map(|jump| (jump * self.solved())[0]);
        first > 0.0 && second < 0.0
    }
}

impl Pair {
    fn of(system: &System) -> Result<Self, OrbitError> {
        let map = ImpactMap::of(system)?;
        let period = system.period();
        let left = Matrix2::identity() - map.flight.free(period);
        let repeated = left.try_inverse().ok_or(OrbitError::Singular)?;
        let [s, c] = map.flight.steady();
        Ok(Self { map, eps: system.mass_ratio(), period, squared: s * s + c * c, repeated })
    }

    fn impacts(&self, s: f64) -> ImpactRows {
        let Self { map, eps, period, .. } = self;
        let [t1, t2] = [0.5 * period + s, 0.5 * period - s];
        let ([alpha1, rest1], [alpha2, rest2]) =
            (map.sliding(Wall::Plus), map.sliding(Wall::Minus));
        let mean = 0.5 * (alpha1 * t1 + alpha2 * t2);
        let row = RowVector2::new;
        let jumps = [row(-mean, 1.0), row(-mean, -1.0)];
        let absorber =
            [row(-0.5 * alpha1 * t1, t2 / period), row(-0.5 * alpha2 * t2, -t1 / period)];
        let before = [0, 1].map(|k: usize| {
            let r = map.restitution([Wall::Plus, Wall::Minus][k]);
            let met = absorber[k] - jumps[k];
            (absorber[k] + met * r + jumps[k] * *eps) / (1.0 + r)
        });
        let place = |x: f64| Matrix2::new(x, 0.0, 0.0, 0.0);
        let kick = |k: usize| Matrix2::from_rows(&[row(0.0, 0.0), jumps[k] * -eps]);
        let [there, back] = [t1, t2].map(|t| map.flight.free(t));
        let (rest1, rest2) = (place(rest1), place(rest2));
        let pushed = rest1 - there * rest1 + kick(1) - rest2;
        let first = self.repeated * (kick(0) + rest2 + back * pushed);
        let second = rest1 + there * (first - rest1);
        let velocities = [before[0] - first.row(1) - jumps[0] * *eps, before[1] - second.row(1)];
        // h = pi/2 + Omega s/2.
        let omega = map.flight.frequency();
        let (sine, cosine) = libm::sincos(0.5 * omega * s);
        let turn = [cosine, -sine];
        let way = row(-2.0, t1 * t2 / period) - (second.row(0) - first.row(0));
        let after = |k: usize, beside: Matrix2<f64>| {
            [beside.row(0).into(), before[k] - jumps[k] * *eps, absorber[k]]
        };
        ImpactRows {
            durations: [t1, t2],
            jumps,
            turn,
            way,
            difference: velocities[0] - velocities[1],
            line: way * (omega * turn[1]) - (velocities[0] + velocities[1]) * turn[0],
            after: [after(0, first), after(1, second)],
        }
    }

    /// `F`, over `cos(h)^2` where asked.
    fn defect(&self, s: f64, symmetric: bool) -> f64 {
        let at = self.impacts(s);
        let omega = self.map.flight.frequency();
        let line = if symmetric { at.line / at.turn[1] } else { at.line };
        let with = |row: &RowVector2<f64>| row[0] * line[1] - row[1] * line[0];
        let (way, difference) = (omega * with(&at.way), with(&at.difference));
        let steady = 2.0 * omega * at.turn[0] * line[1];
        way * way + difference * difference - steady * steady * self.squared
    }

    /// Roots of `F` at which both walls are met from inside, those of mirror images included, and what is undecided.
    fn cycles(&self, symmetric: bool) -> (Vec<f64>, Vec<[f64; 2]>) {
        let (mut roots, mut undecided) = self.roots(symmetric);
        if symmetric {
            roots.extend(roots.clone().iter().map(|s| -s));
            undecided.extend(undecided.clone().iter().map(|[from, to]| [-to, -from]));
        }
        roots.retain(|s| self.impacts(*s).meets_from_inside());
        (roots, undecided)
    }

    /// Roots of `F`, and what is undecided; of a symmetric cavity those of asymmetric orbits above 0.
    fn roots(&self, symmetric: bool) -> (Vec<f64>, Vec<[f64; 2]>) {
        let half = (0.5 - SHORTEST) * self.period;
        let from = if symmetric { ASYMMETRIC * self.period } else { -half };
        let fastest = self.map.flight.frequency().max(1.0);
        let count = (fastest * (half - from) / RADIANS).ceil().min(PIECES);
        // What is even in `s` is a function of its square, that has a slope at 0 too, where asymmetric orbits leave the
        // symmetric one.
        let squared = |s: f64| if symmetric { s * s } else { s };
        let rooted = |at: f64| if symmetric { at.sqrt() } else { at };
        let narrowest = NARROWEST * squared(self.period);
        let edges: Vec<f64> = places([from, half], count as u32).map(squared).collect();
        let mut pieces: Vec<([f64; 2], Option<Interpolant>)> =
            edges.windows(2).map(|ends| ([ends[0], ends[1]], None)).collect();
        let (mut roots, mut undecided) = (Vec::new(), Vec::new());
        let mut left = pieces.len() + MOST;
        let f = |at: f64| self.defect(rooted(at), symmetric);
        while let Some((ends, known)) = pieces.pop() {
            left -= 1;
            let place = |z: f64| 0.5 * ((1.0 - z) * ends[0] + (1.0 + z) * ends[1]);
            let near = known.unwrap_or_else(|| Interpolant::of(|z| f(place(z))));
            if near.has_no_root() {
                continue;
            }
            if near.is_monotone() {
                roots.extend(narrowed(ends, f).map(rooted));
            } else if ends[1] - ends[0] > narrowest && left > pieces.len() + 1 {
                let middle = 0.5 * (ends[0] + ends[1]);
                let halves = [[ends[0], middle], [middle, ends[1]]];
                if near.is_exhausted() {
                    let anew = |[low, high]: [f64; 2]| {
                        let place = |z: f64| 0.5 * ((1.0 - z) * low + (1.0 + z) * high);
                        ([low, high], Some(Interpolant::of_few(|z| f(place(z)))))
                    };
                    pieces.extend(halves.map(anew));
                } else {
                    pieces.extend(halves.into_iter().zip(near.halves().map(Some)));
                }
            } else {
                undecided.push(ends.map(rooted));
            }
        }
        (roots, undecided)
    }

    /// The cycle with the root `s`, by Newton's method from its closed form; `None` where that fails or leads elsewhere.
    fn converged(&self, s: f64) -> Option<Converged> {
        let at = self.impacts(s);
        let flight = &self.map.flight;
        let omega = flight.frequency();
        let state = at.solved();
        let value = |row: &RowVector2<f64>| (row * state)[0];
        let [sine, cosine] = at.turn;
        let a = 0.5 * value(&at.way) / sine;
        let b = 0.5 * value(&at.difference) / (omega * sine);
        let [p, q] = flight.steady();
        let middle = libm::atan2(p * b - q * a, p * a + q * b);
        let impact = |wall: Wall| {
            let ([x, x_velocity, y_velocity], side) =
                (at.after[usize::from(wall == Wall::Minus)].map(|row| value(&row)), wall.sign());
            let phase = middle - 0.5 * side * omega * at.durations[0];
            AfterImpact { wall, phase, x: x + b * cosine - side * a * sine, x_velocity, y_velocity }
        };
        let cycle = Cycle {
            closure: Closure::Repeats { periods: 1 },
            impacts: vec![impact(Wall::Plus), impact(Wall::Minus)],
            durations: at.durations.to_vec(),
        };
        let found = converge(&self.map, &cycle).ok()?;
        let moved = found.cycle.durations[0] - at.durations[0];
        (moved.abs() <= SAME * self.period).then_some(found)
    }
}
