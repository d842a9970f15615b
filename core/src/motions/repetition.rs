//! A motion that repeats and that no solver of orbits covers: what was seen of it, and the fixed point of the simulated map.

use nalgebra::{Matrix4, Vector4};
use serde::Serialize;

use super::watch::{Watch, WindowSample};
use crate::orbits::{Multipliers, ONE_ORBIT};
use crate::regimes::{ImpactSequence, Periodicity};
use crate::simulation::{Simulation, Stop, Tangent};
use crate::system::{State, System};

/// Relative difference of `C`, `E` and peak below which two repetitions with the same impacts are one: a thousand times what
/// a repetition to 1e-6 leaves open.
const SAME_REPETITION: f64 = 1e-3;
/// Closure of a repetition, over its size, at which Newton's method ends: what a few hundred impacts leave of rounding. Below
/// the other one it ends as well where it comes no closer.
const POLISHED: f64 = 1e-13;
const ROUGH: f64 = 1e-9;
/// Steps of Newton's method without coming closer after which it is given up; next to a bifurcation it may go astray for a
/// few, and each then halves the distance.
const STEPS: u32 = 6;

/// A motion that was seen to repeat and that no solver of orbits covers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Repetition {
    /// Excitation periods until it repeats.
    pub periods: u32,
    /// Impacts until then.
    pub impacts: u32,
    /// Which walls they are on; none where they are more than a sequence holds.
    pub sequence: Option<ImpactSequence>,
    /// `C` and `E` of equation (17) over the whole repetition, and the peak, over the clearance.
    pub amplitudes: [f64; 3],
    /// Largest distance between states that should be equal, over the size of the motion.
    pub closure: f64,
    /// Largest modulus of the multipliers over one excitation period, from exact tangents along it.
    pub multiplier: Option<f64>,
    /// Whether the absorber rests on a wall in it.
    pub contact: bool,
}

impl Repetition {
    /// As it was seen.
    pub(super) fn seen(sample: &WindowSample, found: Periodicity) -> Self {
        Self {
            periods: found.periods,
            impacts: found.impacts,
            sequence: sample.evidence.sequence,
            amplitudes: sample.amplitudes,
            closure: found.closure,
            multiplier: None,
            contact: sample.contact,
        }
    }

    /// Walls in the order of the impacts, as `+-`.
    pub fn walls(&self) -> String {
        self.sequence.map(|sequence| sequence.to_string()).unwrap_or_default()
    }

    pub(super) fn is_same(&self, other: &Self) -> bool {
        let near = |(a, b): (f64, f64)| (a - b).abs() <= SAME_REPETITION * a.max(b);
        (self.periods, self.impacts, self.sequence)
            == (other.periods, other.impacts, other.sequence)
            && self.amplitudes.into_iter().zip(other.amplitudes).all(near)
    }
}

/// A state at phase 0 on a motion that repeats, by Newton's method on the simulated map over its periods, whatever happens on
/// the way: contact, or a slip that reverses.
pub(super) struct Polished {
    pub state: State,
    periods: u32,
    /// Largest modulus of the multipliers over one excitation period.
    pub multiplier: f64,
}

/// Where a state at phase 0 is after some periods, and how that changes with it: exact tangents.
fn period_map(system: &System, state: State, periods: u32) -> Option<(State, Matrix4<f64>)> {
    let unit = |k: usize| {
        let [x, x_velocity, y, y_velocity] = [0, 1, 2, 3].map(|j| f64::from(u8::from(j == k)));
        Tangent::begin(system, State { x, x_velocity, y, y_velocity })
    };
    let mut tangents = ((unit(0), unit(1)), (unit(2), unit(3)));
    let mut simulation = Simulation::new(system, state, 0.0).ok()?;
    if simulation.run(periods.into(), u64::MAX, &mut tangents) != Stop::EndTime {
        return None;
    }
    let ((a, b), (c, d)) = tangents;
    let column = |tangent: Tangent| vector(&tangent.change) * libm::exp(tangent.logarithm());
    Some((simulation.state(), Matrix4::from_columns(&[a, b, c, d].map(column))))
}

fn vector(state: &State) -> Vector4<f64> {
    Vector4::new(state.x, state.x_velocity, state.y, state.y_velocity)
}

impl Polished {
    /// From a state, a motion that repeats after so many periods, or a part of them; none where Newton's method finds none.
    pub fn of(system: &System, from: State, periods: u32) -> Option<Self> {
        let size = from.size().max(1.0);
        let (mut state, mut last, mut best, mut astray) = (from, f64::INFINITY, f64::INFINITY, 0);
        let map = loop {
            let (end, map) = period_map(system, state, periods)?;
            let off = vector(&end) - vector(&state);
            let closure = off.amax() / size;
            if closure <= POLISHED || closure <= ROUGH && closure >= 0.5 * last {
                break map;
            }
            if closure < 0.9 * best {
                (best, astray) = (closure, 0);
            } else if astray == STEPS {
                return None;
            } else {
                astray += 1;
            }
            last = closure;
            let step = (Matrix4::identity() - map).lu().solve(&off)?;
            state = State {
                x: state.x + step[0],
                x_velocity: state.x_velocity + step[1],
                y: state.y + step[2],
                y_velocity: state.y_velocity + step[3],
            };
        };
        // What settles from alternate sides is seen to repeat after twice its periods.
        for shorter in (1..periods).filter(|shorter| periods.is_multiple_of(*shorter)) {
            let (end, map) = period_map(system, state, shorter)?;
            if end.distance(&state) <= ONE_ORBIT * size {
                return Some(Self::with(state, shorter, &map));
            }
        }
        Some(Self::with(state, periods, &map))
    }

    fn with(state: State, periods: u32, map: &Matrix4<f64>) -> Self {
        let radius = Multipliers::of(map).map_or(0.0, |one| one.spectral_radius());
        let multiplier = libm::pow(radius, 1.0 / f64::from(periods));
        Self { state, periods, multiplier }
    }

    /// What is seen of it, with its repetition.
    pub fn seen(&self, system: &System) -> Option<(WindowSample, Periodicity)> {
        let mut simulation = Simulation::new(system, self.state, 0.0).ok()?;
        let mut watch = Watch::begin(&simulation);
        let periods = Periodicity::shown_in(self.periods);
        let stop = simulation.run(periods, u64::MAX, &mut watch.observers);
        let sample = watch.sample(&simulation, stop)?;
        let found = sample.evidence.periodicity.filter(|found| found.periods == self.periods)?;
        Some((sample, found))
    }
}
