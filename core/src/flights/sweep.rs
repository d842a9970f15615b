//! A structure with its absorber through a range of frequencies, flight by flight: each stretch of the sweep
//! ([`SweepStretch`]) is flown exactly at the constant frequency that it has on average, from the state and the phase in which
//! the one before ended.

use std::f64::consts::TAU;

use crate::excitation::{SineSweep, SweepStretch};
use crate::linear::Passage;
use crate::simulation::{
    Detail, Impact, Measurement, Observer, ShakingMeter, Simulation, StartError, Stop,
};
use crate::system::{Scales, State, System};

impl Passage {
    /// Follows a start through a sweep; the frequency of the system does not matter.
    ///
    /// # Errors
    /// [`StartError`] for a start outside of the cavity, or where a motion becomes so large that rounding hides the
    /// walls.
    pub fn follow(
        system: &System,
        scales: &Scales,
        sweep: &SineSweep,
        start: State,
    ) -> Result<Self, StartError> {
        let all = Self::follow_telling(system, scales, sweep, start, u64::MAX, false, &mut |_| {});
        all.map(|(found, _)| found)
    }

    /// The same for so many periods at the most, and its duration; velocity and acceleration are measured where they are asked
    /// for, and `told` hears of every impact, its time that since the start.
    ///
    /// # Errors
    /// As [`Self::follow`].
    pub fn follow_telling(
        system: &System,
        scales: &Scales,
        sweep: &SineSweep,
        start: State,
        periods: u64,
        shaking: bool,
        told: &mut dyn FnMut(&Impact),
    ) -> Result<(Self, f64), StartError> {
        let mut found = Self::new(sweep.count().min(periods), 1.0);
        let (mut state, mut elapsed) = (start, 0.0);
        let mut shakes = shaking.then(|| ShakingMeter::of(system));
        for stretch in sweep.stretches(scales) {
            if stretch.first && found.envelope.len() as u64 == periods {
                break;
            }
            let refused = StartError::NotFinite { state };
            let system = stretch.system(system).map_err(|_| refused)?;
            let mut simulation = Simulation::new(&system, state, stretch.begins)?;
            let measured = Measurement::begin_within(&system, state, stretch.begins);
            let mut teller = Teller { elapsed, stretch, told: &mut *told };
            let meter = shakes.map(|_| ShakingMeter::of(&system));
            let mut measured = ((measured, &mut teller), meter);
            if simulation.run(1, u64::MAX, &mut measured) != Stop::EndTime {
                return Err(refused);
            }
            (state, elapsed) = (simulation.state(), elapsed + stretch.duration());
            shakes = shakes.zip(measured.1).map(|(before, here)| before.and(&here));
            let period = measured.0.0.statistics();
            found.passed(&stretch, period.peak());
            found.impacts += period.impacts();
            found.impact_speed = found.impact_speed.max(period.impact_speed());
            found.residual = found.residual.max(period.energy().relative_residual);
        }
        found.shaking = shakes.map(|meter| meter.found());
        Ok((found, elapsed))
    }
}

/// Tells of impacts of a stretch in the time and phase of the sweep.
struct Teller<'a> {
    elapsed: f64,
    stretch: SweepStretch,
    told: &'a mut dyn FnMut(&Impact),
}

impl Observer for Teller<'_> {
    fn detail(&self) -> Detail {
        Detail::Events
    }

    fn impact(&mut self, impact: &Impact) {
        let since = (impact.phase - self.stretch.begins) / self.stretch.ratio;
        let phase = (impact.phase + self.stretch.lead).rem_euclid(TAU);
        (self.told)(&Impact { tau: self.elapsed + since, phase, ..*impact });
    }
}
