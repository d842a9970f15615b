//! A motion of several modes, impact by impact: its derivative, and whether it is one.

use nalgebra::{DMatrix, DVector};
use serde::Serialize;

use super::{ModalOrbit, applied, orbit_state, propagator};
use crate::bifurcation::Bifurcation;
use crate::numerics::crossing::{CrossingBand, Curve, Edge, Sample, Search, first_crossing};
use crate::system::{ModalState, ModalSystem};

/// Part of a period before its next impact from which on an absorber may touch that wall.
const AT_IMPACT: f64 = 1e-9;
/// Steps of Newton's method to the time of an impact: from a good start four are enough.
const STEPS_TO_IMPACT: usize = 12;
/// What is left of that time, over the period.
const OF_TIME: f64 = 1e-15;

/// An impact of a motion that is given by its impacts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CycleImpact {
    /// Time from the beginning of the motion, at phase 0 of the excitation.
    pub time: f64,
    /// Which absorber, from 0.
    pub absorber: usize,
    /// At which wall, +1 or -1.
    pub side: f64,
}

/// A motion from phase 0 of the excitation, impact by impact.
pub(super) struct Walk {
    pub derivative: DMatrix<f64>,
    /// The state at its end.
    pub end: ModalState,
    /// What ends the motion, where it is none.
    pub ends: Option<Bifurcation>,
}

impl Walk {
    /// Half a period of an antiperiodic orbit.
    pub fn along(system: &ModalSystem, orbit: &ModalOrbit) -> Self {
        let of = |absorber: usize| CycleImpact {
            time: orbit.impact_times[absorber],
            absorber,
            side: orbit.sides[absorber],
        };
        let mut impacts: Vec<CycleImpact> = (0..orbit.sides.len()).map(of).collect();
        impacts.sort_by(|a, b| a.time.total_cmp(&b.time));
        Self::of(system, &orbit_state(system, orbit), &impacts, 0.5 * system.period())
    }

    /// The derivative of the state after a time by the state before, at a fixed phase: free motion in between, and at
    /// each impact, with the map `R`, the flow `f` and the gap `h`,
    /// `DR + (f_after - DR f_before - dR/dt) grad h/(grad h f_before + dh/dt)`.
    pub fn of(
        system: &ModalSystem,
        start: &ModalState,
        impacts: &[CycleImpact],
        length: f64,
    ) -> Self {
        let size = 2 * (system.modes().len() + system.absorbers().len());
        let mut walk = Self { derivative: DMatrix::identity(size, size), end: *start, ends: None };
        let (mut time, mut left) = (0.0, None);
        for one in impacts {
            let piece = Piece { system, from: walk.end, time, length: one.time - time };
            walk.ends = walk.ends.or_else(|| piece.ends(left, Some(one.absorber)));
            walk.pass(&piece);
            let vanishes = walk.strike(system, one) <= 0.0;
            walk.ends = walk.ends.or(vanishes.then_some(Bifurcation::VanishingImpact));
            (time, left) = (one.time, Some(one.absorber));
        }
        let piece = Piece { system, from: walk.end, time, length: length - time };
        walk.ends = walk.ends.or_else(|| piece.ends(left, None));
        walk.pass(&piece);
        walk
    }

    /// The same without a look at what is in between, each impact at the time at which its absorber meets its wall, near that
    /// which is given; it is there then. None where one does not meet it, from inside.
    pub fn meeting(
        system: &ModalSystem,
        start: &ModalState,
        impacts: &mut [CycleImpact],
        length: f64,
    ) -> Option<Self> {
        let size = 2 * (system.modes().len() + system.absorbers().len());
        let mut walk = Self { derivative: DMatrix::identity(size, size), end: *start, ends: None };
        let mut time = 0.0;
        for one in impacts {
            let mut piece = Piece { system, from: walk.end, time, length: one.time - time };
            piece.length = piece.meets(one)?;
            one.time = time + piece.length;
            walk.pass(&piece);
            (walk.strike(system, one) > 0.0).then_some(())?;
            time = one.time;
        }
        walk.pass(&Piece { system, from: walk.end, time, length: length - time });
        Some(walk)
    }

    fn pass(&mut self, piece: &Piece) {
        self.derivative = piece.derivative() * &self.derivative;
        self.end = piece.at(piece.length);
    }

    /// An impact here, and the speed with which the wall is met.
    fn strike(&mut self, system: &ModalSystem, one: &CycleImpact) -> f64 {
        let (saltation, after, approach) =
            impact(system, &self.end, one.time, one.absorber, one.side);
        self.derivative = saltation * &self.derivative;
        self.end = after;
        approach
    }
}

/// Places of modes' and absorbers' numbers in a state: displacement, then velocity.
fn entry(n: usize) -> usize {
    2 * n
}

/// The derivative of an impact, the state after, and the speed with which the wall is met.
fn impact(
    system: &ModalSystem,
    before: &ModalState,
    time: f64,
    j: usize,
    side: f64,
) -> (DMatrix<f64>, ModalState, f64) {
    let (modes, absorber) = (system.modes(), system.absorbers()[j]);
    let (omega, base) = (system.frequency_ratio(), system.base_amplitude());
    let (sin, cos) = libm::sincos(omega * time);
    let y = entry(modes.len() + j);
    let size = 2 * (modes.len() + system.absorbers().len());
    let seen = absorber.mass / (1.0 + system.mass_ratio(j));
    let share = (1.0 + absorber.restitution) * seen;
    let acceleration = |k: usize, state: &ModalState| {
        let (mode, [q, v]) = (&modes[k], state.modes[k]);
        system.modal_forcing(k) * sin
            - 2.0 * mode.damping_ratio * mode.frequency * v
            - mode.frequency * mode.frequency * q
    };
    let speeds = modes.iter().zip(&before.modes).map(|(mode, [_, v])| mode.shape[j] * v);
    let w = base * omega * cos + speeds.sum::<f64>() - before.absorbers[j][1];
    // How the impulse depends on velocities, and what it does.
    let (mut slope, mut jump) = (DVector::zeros(size), DVector::zeros(size));
    let (mut gradient, mut from) = (DVector::zeros(size), DVector::zeros(size));
    let mut after = *before;
    for (k, mode) in modes.iter().enumerate() {
        slope[entry(k) + 1] = share * mode.shape[j];
        jump[entry(k) + 1] = -mode.shape[j] / mode.mass;
        gradient[entry(k)] = mode.shape[j];
        after.modes[k][1] -= mode.shape[j] / mode.mass * share * w;
        (from[entry(k)], from[entry(k) + 1]) = (before.modes[k][1], acceleration(k, before));
    }
    slope[y + 1] = -share;
    jump[y + 1] = 1.0 / absorber.mass;
    gradient[y] = -1.0;
    after.absorbers[j][1] += share * w / absorber.mass;
    for i in 0..system.absorbers().len() {
        from[entry(modes.len() + i)] = before.absorbers[i][1];
    }
    let map = DMatrix::identity(size, size) + &jump * slope.transpose();
    let mut to = from.clone();
    for k in 0..modes.len() {
        (to[entry(k)], to[entry(k) + 1]) = (after.modes[k][1], acceleration(k, &after));
    }
    to[y] = after.absorbers[j][1];
    let by_time = &jump * (-(share * base * omega * omega * sin));
    let moved = to - &map * from - by_time;
    (map + moved * gradient.transpose() / w, after, w * side)
}

/// Motion between two impacts.
struct Piece<'a> {
    system: &'a ModalSystem,
    from: ModalState,
    /// When, from phase 0, and for how long.
    time: f64,
    length: f64,
}

impl Piece<'_> {
    fn rates(&self, k: usize) -> [f64; 2] {
        let mode = &self.system.modes()[k];
        [mode.frequency, mode.damping_ratio]
    }

    fn derivative(&self) -> DMatrix<f64> {
        let (modes, count) = (self.system.modes().len(), self.system.absorbers().len());
        let mut derivative = DMatrix::identity(2 * (modes + count), 2 * (modes + count));
        for k in 0..modes {
            let block = propagator(self.rates(k), self.length);
            for (row, values) in block.iter().enumerate() {
                for (column, value) in values.iter().enumerate() {
                    derivative[(entry(k) + row, entry(k) + column)] = *value;
                }
            }
        }
        for j in 0..count {
            derivative[(entry(modes + j), entry(modes + j) + 1)] = self.length;
        }
        derivative
    }

    fn steady(&self, k: usize, s: f64) -> [f64; 2] {
        let (omega, steady) = (self.system.frequency_ratio(), self.system.steady_motion(k));
        let (sin, cos) = libm::sincos(omega * (self.time + s));
        [steady.sine * sin + steady.cosine * cos, omega * (steady.sine * cos - steady.cosine * sin)]
    }

    /// The free part of a mode at the beginning.
    fn free(&self, k: usize) -> [f64; 2] {
        let ([q, v], [x, rate]) = (self.from.modes[k], self.steady(k, 0.0));
        [q - x, v - rate]
    }

    fn at(&self, s: f64) -> ModalState {
        let mut state = self.from;
        for k in 0..self.system.modes().len() {
            let free = applied(propagator(self.rates(k), s), self.free(k));
            let steady = self.steady(k, s);
            state.modes[k] = [free[0] + steady[0], free[1] + steady[1]];
        }
        for absorber in &mut state.absorbers {
            absorber[0] += absorber[1] * s;
        }
        state
    }

    /// When, near its end, an absorber meets a wall from inside; none where Newton's method does not find it.
    fn meets(&self, one: &CycleImpact) -> Option<f64> {
        let wall = one.side * self.system.absorbers()[one.absorber].clearance;
        let curve = GapCurve { piece: self, absorber: one.absorber, bend: 0.0 };
        let mut s = self.length;
        for _ in 0..STEPS_TO_IMPACT {
            let Sample { value, slope, .. } = curve.sample(s);
            let step = (value - wall) / slope;
            if !(step.is_finite() && slope * one.side > 0.0) {
                return None;
            }
            s -= step;
            if step.abs() <= OF_TIME * self.system.period() * (1.0 + self.time) {
                break;
            }
        }
        Some(s)
    }

    /// What ends the motion where an absorber meets a wall, `left` being at its own at the beginning and `meets` at the end.
    fn ends(&self, left: Option<usize>, meets: Option<usize>) -> Option<Bifurcation> {
        let soon = AT_IMPACT * self.system.period();
        (0..self.system.absorbers().len()).find_map(|j| {
            let end = self.length - if meets == Some(j) { soon } else { 0.0 };
            // Right after its impact rounding may have it on the wall's other side.
            let begin = if left == Some(j) { soon } else { 0.0 };
            let absorber = &self.system.absorbers()[j];
            let b = absorber.clearance;
            let band = CrossingBand { lower: -b, upper: b, touch: 1e-13 * b };
            let curve = GapCurve { piece: self, absorber: j, bend: self.bend(j) };
            if end <= begin {
                return None;
            }
            let back = match first_crossing(&curve, begin, end, band) {
                Search::Clear { .. } => return None,
                Search::NotFinite(_) => false,
                Search::Crossed(crossing) => {
                    (crossing.edge == Edge::Upper) == (curve.sample(0.0).value > 0.0)
                }
            };
            let stays = left == Some(j) && back && absorber.restitution == 0.0;
            Some(if stays { Bifurcation::Sticking } else { Bifurcation::Grazing })
        })
    }

    /// A bound on the acceleration of the structure at an absorber.
    fn bend(&self, j: usize) -> f64 {
        let omega = self.system.frequency_ratio();
        let steady = self.system.steady_motion_at(j).amplitude() * omega * omega;
        let modes = self.system.modes().iter().enumerate();
        modes.fold(steady, |sum, (k, mode)| {
            let ([x, v], [w, zeta]) = (self.free(k), self.rates(k));
            let ringing = w * ((1.0 - zeta) * (1.0 + zeta)).sqrt();
            sum + mode.shape[j].abs() * w * w * libm::hypot(x, (v + zeta * w * x) / ringing)
        })
    }
}

struct GapCurve<'a> {
    piece: &'a Piece<'a>,
    absorber: usize,
    bend: f64,
}

impl Curve for GapCurve<'_> {
    fn sample(&self, s: f64) -> Sample {
        let (system, state) = (self.piece.system, self.piece.at(s));
        let (omega, base) = (system.frequency_ratio(), system.base_amplitude());
        let (sin, cos) = libm::sincos(omega * (self.piece.time + s));
        let [y, velocity] = state.absorbers[self.absorber];
        let start = [base * sin - y, base * omega * cos - velocity];
        let modes = system.modes().iter().zip(&state.modes);
        let [value, slope] = modes.fold(start, |[x, v], (mode, [q, rate])| {
            let phi = mode.shape[self.absorber];
            [x + phi * q, v + phi * rate]
        });
        Sample { value, slope, curvature_bound: self.bend }
    }
    fn horizon(&self) -> f64 {
        f64::INFINITY
    }
}
