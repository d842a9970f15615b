//! Periodic motions that attract: exact orbits that are solved for at first, and those that a trajectory nearly is on.

use super::motion::{FlightCourse, ModalMotion};
use super::polished::{Polished, ROUGH};
use super::sensed::Sensed;
use super::watch::{MOST_IMPACTS, ModalWatch, SAME_STATE};
use crate::orbits::{CycleImpact, ModalCycle, ModalOrbit, antiperiodic_orbits, orbit_state};
use crate::simulation::{Detail, ModalImpact, ModalObserver, ModalSimulation, Side};
use crate::system::ModalState;

/// Difference of states, over their size, up to which a trajectory is on the motion that Newton's method leads to.
const ON: f64 = 1e-3;
/// The same up to which it may be on its way to one that attracts: it is, if it comes closer and closer.
const NEAR_BY: f64 = 0.01;
/// Most impacts of an exact orbit.
const MOST_OF_CYCLE: usize = 64;

/// A periodic motion that a state nearly is on.
pub(super) enum Near {
    /// It attracts, and the state is on it.
    On(Box<ModalMotion>),
    /// It attracts, and the state is near it.
    Beside(Box<ModalMotion>),
    /// It does not: a trajectory on it is about to leave.
    Leaves,
}

/// The periodic motion that a state nearly is on; none where there is none.
pub(super) fn near(of: &Sensed, state: &ModalState, periods: u32) -> Option<Near> {
    let system = of.system();
    let mut simulation = ModalSimulation::new(system, state, 0.0).ok()?;
    let mut seen = Sequence::default();
    simulation.run(periods.into(), u64::from(periods) * MOST_IMPACTS, &mut seen);
    let moves = |j: &usize| seen.impacts.iter().any(|impact| impact.absorber == *j);
    let all = 0..system.absorbers().len();
    // One that hits nothing and moves is on its way to a wall.
    if all.clone().any(|j| state.absorbers[j][1] != 0.0 && !moves(&j)) {
        return None;
    }
    let is_orbit = !seen.sticks && seen.impacts.len() <= MOST_OF_CYCLE;
    let (begin, multiplier, attracts) = if is_orbit {
        let cycle = ModalCycle { state: *state, periods, impacts: seen.impacts };
        let orbit = cycle.solve(system).ok()?;
        (orbit.cycle.state, orbit.radius_per_period(), orbit.attracts())
    } else {
        let moves: Vec<usize> = all.filter(moves).collect();
        let Polished { state, multiplier } = Polished::of(system, state, periods, &moves)?;
        (state, multiplier, multiplier < 1.0)
    };
    let off = begin.distance(state);
    // What differences say of a multiplier does not tell whether others come to it.
    if off > if attracts && is_orbit { NEAR_BY } else { ON } {
        return None;
    }
    if !attracts {
        return Some(Near::Leaves);
    }
    let motion = solved(of, begin, once(of, &begin, periods)?, multiplier)?;
    let motion = ModalMotion { is_orbit, ..motion.within(if is_orbit { 0.0 } else { ROUGH }) };
    Some(if off <= ON { Near::On(Box::new(motion)) } else { Near::Beside(Box::new(motion)) })
}

/// Periods until a state is there again that is so after so many.
fn once(of: &Sensed, begin: &ModalState, periods: u32) -> Option<u32> {
    let mut simulation = ModalSimulation::new(of.system(), begin, 0.0).ok()?;
    let again = |_: &u32| {
        simulation.run(1, MOST_IMPACTS, &mut ());
        begin.distance(&simulation.state()) <= SAME_STATE
    };
    Some((1..periods).find(again).unwrap_or(periods))
}

/// A motion that repeats after so many periods, as it was seen from a state on it.
pub(super) fn seen(of: &Sensed, begin: &ModalState, periods: u32) -> Option<ModalMotion> {
    let mut simulation = ModalSimulation::new(of.system(), begin, 0.0).ok()?;
    let whole = u64::from(periods);
    let mut watch = ModalWatch::in_stretches(of.system(), of.sensors(), &simulation, whole);
    let stop = simulation.run(whole, whole * MOST_IMPACTS, &mut watch);
    let sample = watch.sample(&simulation, stop)?;
    let course: Vec<FlightCourse> = vec![sample.course];
    let motion = ModalMotion::of(&sample.reads, course, Some(periods), true, whole);
    Some(ModalMotion { state: Some(*begin), ..motion })
}

fn solved(of: &Sensed, begin: ModalState, periods: u32, multiplier: f64) -> Option<ModalMotion> {
    let motion = seen(of, &begin, periods)?;
    Some(ModalMotion { largest_multiplier: Some(multiplier), ..motion })
}

/// Impacts in their order, and whether an absorber came to rest on a wall.
#[derive(Default)]
struct Sequence {
    impacts: Vec<CycleImpact>,
    sticks: bool,
}

impl ModalObserver for Sequence {
    fn detail(&self) -> Detail {
        Detail::Events
    }
    fn impact(&mut self, impact: &ModalImpact) {
        let side = if impact.side == Side::Plus { 1.0 } else { -1.0 };
        let ModalImpact { tau: time, absorber, .. } = *impact;
        self.impacts.push(CycleImpact { time, absorber, side });
    }
    fn sticks(&mut self, _absorber: usize, _loss: f64) {
        self.sticks = true;
    }
}

/// The exact orbits that attract, each measured over a period of its own.
pub(super) fn attracting(of: &Sensed) -> Vec<ModalMotion> {
    let system = of.system();
    let stable = antiperiodic_orbits(system).into_iter().filter(ModalOrbit::stable);
    let each = stable.filter_map(|orbit| {
        let radius = orbit.spectral_radius();
        let motion = solved(of, orbit_state(system, &orbit), 1, radius * radius)?;
        Some(ModalMotion { is_orbit: true, ..motion })
    });
    each.collect()
}
