//! Exact orbits that attract: those that are solved for at first, and those that a start nearly is on.

use super::motion::ModalMotion;
use super::polished::{Polished, ROUGH};
use super::stretch::{MOST_IMPACTS, SAME_STATE, Stretch, distance};
use crate::orbits::{CycleImpact, ModalCycle, antiperiodic_orbits, orbit_state};
use crate::simulation::{
    Detail, ModalImpact, ModalObserver, ModalSimulation, ModalStartError, Sensor, Side,
};
use crate::system::{ModalState, ModalSystem};

/// Difference of states, over their size, up to which one is that of an orbit that attracts; of one that was solved for from a start, beside which others
/// may lie that belong to it, as after a period doubling.
const NEAR_ORBIT: f64 = 1e-3;
const NEAR_PROVEN: f64 = 1e-6;
/// The same up to which a start may be on its way to one that attracts: it is, if it comes closer and closer.
pub(super) const NEAR_BY: f64 = 0.01;
/// Most impacts of an exact orbit.
const MOST_OF_CYCLE: usize = 64;

/// An exact orbit that attracts, by a state at the end of one of its periods.
pub(super) struct Attracting {
    pub state: ModalState,
    /// Distance up to which another state is taken for one on it.
    pub reach: f64,
    pub motion: ModalMotion,
}

impl Attracting {
    /// The periodic motion that a state nearly is on; none where there is none.
    pub fn near(
        system: &ModalSystem,
        sensors: &[Sensor],
        state: &ModalState,
        periods: u32,
    ) -> Option<Near> {
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
        let off = distance(&begin, state);
        if off > if attracts { NEAR_BY } else { NEAR_ORBIT } {
            return None;
        }
        if !attracts {
            return Some(Near::Leaves);
        }
        // Its states, until it is there again: that may be so earlier.
        let mut on = ModalSimulation::new(system, &begin, 0.0).ok()?;
        let mut states = vec![begin];
        for _ in 1..periods {
            on.run(1, MOST_IMPACTS, &mut ());
            if distance(&begin, &on.state()) <= SAME_STATE {
                break;
            }
            states.push(on.state());
        }
        let periods = states.len() as u32;
        let mut simulation = ModalSimulation::new(system, &begin, 0.0).ok()?;
        let whole = Stretch::fly(&mut simulation, system, sensors, periods.into());
        let motion = ModalMotion::of(sensors, &[whole], Some(periods), true, 1);
        let motion = ModalMotion {
            largest_multiplier: Some(multiplier),
            is_orbit,
            state: Some(begin),
            ..motion.within(if is_orbit { 0.0 } else { ROUGH })
        };
        let on = |state| Self { state, reach: NEAR_PROVEN, motion: motion.clone() };
        let solved = states.into_iter().map(on).collect();
        Some(Near::Attracts { solved, is_on: off <= NEAR_ORBIT })
    }
}

/// An exact orbit that a state nearly is on.
pub(super) enum Near {
    /// It attracts; by each of its states at the ends of periods, and whether that is so near that the start is on it.
    Attracts { solved: Vec<Attracting>, is_on: bool },
    /// It does not: a start on it is about to leave.
    Leaves,
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
pub(super) fn attracting(
    system: &ModalSystem,
    sensors: &[Sensor],
) -> Result<Vec<Attracting>, ModalStartError> {
    let stable = antiperiodic_orbits(system).into_iter().filter(|orbit| orbit.stable());
    let each = stable.map(|orbit| {
        let state = orbit_state(system, &orbit);
        let mut simulation = ModalSimulation::new(system, &state, 0.0)?;
        let block = Stretch::fly(&mut simulation, system, sensors, 1);
        let radius = orbit.spectral_radius();
        let multiplier = Some(radius * radius);
        let motion = ModalMotion {
            largest_multiplier: multiplier,
            is_orbit: true,
            state: Some(state),
            starts: 0,
            ..ModalMotion::of(sensors, &[block], Some(1), true, 1)
        };
        Ok(Attracting { state, reach: NEAR_ORBIT, motion })
    });
    each.collect()
}
