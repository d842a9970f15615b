//! A structure with its absorber on the way to rest, impact by impact.

use std::f64::consts::TAU;

use super::unforced;
use crate::excitation::amplitude;
use crate::linear::{STEPS, Settling};
use crate::numerics::extremes::largest;
use crate::simulation::{
    Detail, Impact, Observer, Segment, ShakingMeter, Simulation, StartError, Stop,
};
use crate::system::{Shaking, State, System};

/// Impacts per oscillation after which a run is given up: chattering ends in contact long before.
const MOST_IMPACTS: u64 = 1000;

/// What became of one start. Values per step, the start first.
#[derive(Debug, Clone, PartialEq)]
pub struct Ringdown {
    /// Amplitude of the structure.
    pub amplitudes: Vec<f64>,
    /// Energy that impacts have taken, as a share of that at the start.
    pub taken: Vec<f64>,
    /// Impacts so far.
    pub impacts: Vec<u64>,
    /// Largest relative speed of an impact so far, over the clearance in fast time.
    pub impact_speeds: Vec<f64>,
    /// Largest displacement of the structure.
    pub peak: f64,
    /// Oscillations after which the amplitude stays at the level or below it; infinite where that was not seen.
    pub settles: f64,
    /// Largest velocity and acceleration of the structure, absolute; root mean squares are those until neither can become
    /// larger. None where they were not asked for.
    pub shaking: Option<Shaking>,
}

struct RingdownLog<'a> {
    told: &'a mut dyn FnMut(&Impact),
    found: Ringdown,
    settling: Settling,
    energy: f64,
    lost: f64,
    impacts: u64,
    speed: f64,
    shaking: Option<ShakingMeter>,
}

impl Observer for RingdownLog<'_> {
    fn detail(&self) -> Detail {
        Detail::Events
    }

    fn impact(&mut self, impact: &Impact) {
        (self.told)(impact);
        self.lost += impact.loss;
        self.impacts += 1;
        for velocity in [impact.x_velocity_before, impact.x_velocity_after] {
            self.settling.see(impact.tau, libm::hypot(impact.x, velocity));
        }
        self.speed = self.speed.max((impact.x_velocity_before - impact.y_velocity_before).abs());
    }

    fn sticks(&mut self, loss: f64) {
        self.lost += loss;
    }

    fn period(&mut self, state: &State) {
        let found = &mut self.found;
        let time = TAU / f64::from(STEPS) * found.amplitudes.len() as f64;
        self.settling.see(time, amplitude(state));
        found.amplitudes.push(amplitude(state));
        found.taken.push(self.lost / self.energy);
        found.impacts.push(self.impacts);
        found.impact_speeds.push(self.speed);
    }
}

/// Hears of flights too, which may hold the largest displacement.
struct Watching<'a, 'b>(&'a mut RingdownLog<'b>);

impl Observer for Watching<'_, '_> {
    fn segment(&mut self, segment: &Segment) {
        let peak = largest(segment.duration, TAU / f64::from(STEPS), |s| {
            let at = segment.motion.at(s);
            [at.x, at.v]
        });
        self.0.found.peak = self.0.found.peak.max(peak);
        self.0.shaking.segment(segment);
    }

    fn impact(&mut self, impact: &Impact) {
        self.0.impact(impact);
    }

    fn sticks(&mut self, loss: f64) {
        self.0.sticks(loss);
    }

    fn period(&mut self, state: &State) {
        self.0.period(state);
    }
}

impl Ringdown {
    /// Follows a start until the amplitude has come down to a level, for so many oscillations at the most. The
    /// excitation of the system does not matter.
    ///
    /// # Errors
    /// [`StartError`] for a start outside of the cavity, or so large that rounding hides the walls.
    pub fn follow(
        system: &System,
        start: State,
        level: f64,
        oscillations: u64,
    ) -> Result<Self, StartError> {
        Self::follow_telling(system, start, level, oscillations, None, &mut |_| {})
    }

    /// The same; velocity and acceleration are measured where the velocity of the frame of the start is given, over clearance
    /// and fast time ([`crate::excitation::Release::frame_velocity`]), and `told` hears of every impact.
    ///
    /// # Errors
    /// As [`Self::follow`].
    pub fn follow_telling(
        system: &System,
        start: State,
        level: f64,
        oscillations: u64,
        frame: Option<f64>,
        told: &mut dyn FnMut(&Impact),
    ) -> Result<Self, StartError> {
        let step = TAU / f64::from(STEPS);
        let free = unforced(system, step).map_err(|_| StartError::NotFinite { state: start })?;
        let mut simulation = Simulation::new(&free, start, 0.0)?;
        let found = Self {
            amplitudes: Vec::new(),
            taken: Vec::new(),
            impacts: Vec::new(),
            impact_speeds: Vec::new(),
            peak: 0.0,
            settles: f64::INFINITY,
            shaking: None,
        };
        let energy = start.energy(system.mass_ratio());
        let settling = Settling::to(level);
        let shaking = frame.map(|velocity| {
            let mut meter = ShakingMeter::of(&free);
            meter.set_frame(velocity);
            meter
        });
        let (lost, impacts, speed) = (0.0, 0, 0.0);
        let mut log = RingdownLog { told, found, settling, energy, lost, impacts, speed, shaking };
        let damping = system.mass_ratio() * system.damping();
        log.period(&start);
        for _ in 0..oscillations {
            // The energy of all is the structure's at most.
            let energy = simulation.state().energy(system.mass_ratio());
            let shakes_more = log.shaking.is_some_and(|meter| {
                let most = (2.0 * energy).sqrt();
                let [velocity, acceleration] = meter.peaks();
                let frame = frame.unwrap_or_default().abs();
                most + frame >= velocity || (1.0 + damping) * most >= acceleration
            });
            let done = 2.0 * energy < log.found.peak * log.found.peak
                && !shakes_more
                && !system.cavity().moves_absorber();
            let run = match done {
                true => simulation.run(STEPS.into(), MOST_IMPACTS, &mut log),
                false => simulation.run(STEPS.into(), MOST_IMPACTS, &mut Watching(&mut log)),
            };
            match run {
                Stop::EndTime => {}
                Stop::ImpactLimit => break,
                _ => return Err(StartError::NotFinite { state: start }),
            }
            // Below the level for a whole oscillation: the absorber's own energy cannot lift it back.
            let latest = &log.found.amplitudes[log.found.amplitudes.len() - STEPS as usize..];
            if latest.iter().all(|one| *one <= ENOUGH * level) {
                break;
            }
        }
        let shaking = log.shaking.map(|meter| meter.found());
        Ok(Self { settles: log.settling.time / TAU, shaking, ..log.found })
    }
}

/// Share of a level below which the structure stays below it.
const ENOUGH: f64 = 0.9;
