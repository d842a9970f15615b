//! How hard the oscillator shakes: its velocity and acceleration, largest and root mean square, in the flights and contacts
//! between impacts. An impact jumps the velocity, which is read on both sides of it; the acceleration is infinite there and
//! left out.

use std::f64::consts::FRAC_PI_4;

use super::events::{Detail, Observer, Segment};
use crate::numerics::extremes::{self, RateSums};
use crate::numerics::quadrature;
use crate::operation_count;
use crate::system::{Shaking, System};

/// An [`Observer`] that measures [`Shaking`]. It has to be told of every flight, which takes several times as long as to fly
/// it: nobody has it who does not ask.
///
/// An oscillator alone with a steady motion has `X Omega` and `X Omega^2`:
///
/// ```
/// # use vinesink_core::system::{Cavity, Excitation, Parameters, System};
/// # let system = System::new(Parameters {
/// #     mass_ratio: 0.01, damping: 2.0, restitution: 0.6, frequency_ratio: 0.8,
/// #     forcing_per_clearance: 5.0, excitation: Excitation::Force, cavity: Cavity::IDEAL,
/// # })?;
/// use vinesink_core::simulation::{ShakingMeter, Simulation};
///
/// let steady = system.linear_response().expect("damped");
/// let mut simulation = Simulation::new(&system, steady.state(&system), 0.0)?;
/// let mut meter = ShakingMeter::of(&system);
/// simulation.run(1, u64::MAX, &mut meter);
/// let (found, amplitude) = (meter.found(), steady.amplitude());
/// assert!((found.peak_velocity / (0.8 * amplitude) - 1.0).abs() < 1e-12);
/// assert!((found.rms_acceleration * 2.0_f64.sqrt() / (0.64 * amplitude) - 1.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct ShakingMeter {
    /// Longest panels, the second where fast decay has not ended.
    panel: f64,
    first_panel: f64,
    /// Whether segments are so short that the motion is a cubic in them.
    short: bool,
    /// Velocity of the frame in which segments are told.
    frame: f64,
    sums: RateSums,
}

impl ShakingMeter {
    /// That of a system, nothing measured yet.
    pub fn of(system: &System) -> Self {
        let driven = system.forcing_per_clearance() != 0.0;
        let oscillating = if driven { system.frequency_ratio().max(1.0) } else { 1.0 };
        let decaying = oscillating.max(system.mass_ratio() * system.damping());
        Self {
            panel: FRAC_PI_4 / oscillating,
            first_panel: FRAC_PI_4 / decaying,
            short: false,
            frame: 0.0,
            sums: RateSums::default(),
        }
    }

    /// The same where segments are so short that velocity and acceleration are cubics in them: off by `h^4/384`.
    #[must_use]
    #[doc(hidden)]
    pub const fn of_short(self) -> Self {
        Self { short: true, ..self }
    }

    /// Segments that follow are told in a frame with that velocity.
    #[doc(hidden)]
    pub const fn set_frame(&mut self, velocity: f64) {
        self.frame = velocity;
    }

    /// Measures from zero on, and gives what was measured before.
    #[doc(hidden)]
    pub fn taken(&mut self) -> Self {
        let before = *self;
        self.sums = RateSums::default();
        before
    }

    /// Both together.
    #[must_use]
    #[doc(hidden)]
    pub fn and(self, other: &Self) -> Self {
        Self { sums: self.sums.and(&other.sums), ..self }
    }

    /// Largest absolute velocity and acceleration so far.
    #[doc(hidden)]
    pub const fn peaks(&self) -> [f64; 2] {
        self.sums.peaks
    }

    /// Mean square velocity and acceleration so far; 0 where no time has passed.
    #[doc(hidden)]
    pub fn mean_squares(&self) -> [f64; 2] {
        self.sums.mean_squares()
    }

    /// What was measured so far.
    pub fn found(&self) -> Shaking {
        Shaking::of(self.sums.peaks, self.sums.mean_squares())
    }

    /// Velocity, acceleration and jerk a time `s` after a segment began.
    fn rates(&self, segment: &Segment, s: f64) -> [f64; 3] {
        let motion = &segment.motion;
        let at = motion.at(s);
        // Sine and cosine of the excitation twice more.
        operation_count::note(4 * operation_count::ELEMENTARY + 20);
        [at.v + self.frame, motion.acceleration(s, at), motion.jerk(s, at)]
    }
}

impl Observer for ShakingMeter {
    fn detail(&self) -> Detail {
        Detail::Flights
    }

    fn segment(&mut self, segment: &Segment) {
        let duration = segment.duration;
        let seen = *self;
        if self.short {
            let ends = [0.0, duration].map(|s| seen.rates(segment, s));
            self.sums.add_short(duration, ends);
            return;
        }
        let sums = &mut self.sums;
        sums.time += duration;
        let largest = extremes::largest_each(duration, self.panel, |s| seen.rates(segment, s));
        for (peak, one) in sums.peaks.iter_mut().zip(largest) {
            *peak = peak.max(one);
        }
        // Eight nodes on a quarter of a turn leave 2e-15 of a square of sinusoids.
        let [first, panel] = [self.first_panel, self.panel].map(|one| 2.0 * one);
        quadrature::graded_nodes(duration, first, panel, |s, weight| {
            let at = segment.motion.at(s);
            let rates = [at.v + seen.frame, segment.motion.acceleration(s, at)];
            operation_count::note(2 * operation_count::ELEMENTARY + 14);
            for (sum, rate) in sums.squares.iter_mut().zip(rates) {
                *sum += weight * rate * rate;
            }
        });
    }
}
