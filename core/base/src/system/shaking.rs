//! How hard an oscillator shakes: what is measured of its velocity and acceleration, whoever measures.

use serde::Serialize;

/// Velocity and acceleration of the oscillator between impacts, absolute. Lengths over the clearance, fast time.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Shaking<T = f64> {
    /// Largest absolute velocity.
    pub peak_velocity: T,
    /// Root mean square velocity.
    pub rms_velocity: T,
    /// Largest absolute acceleration.
    pub peak_acceleration: T,
    /// Root mean square acceleration.
    pub rms_acceleration: T,
}

impl<T> Shaking<T> {
    /// The same of each of its four.
    pub fn map<U>(self, of: impl Fn(T) -> U) -> Shaking<U> {
        Shaking {
            peak_velocity: of(self.peak_velocity),
            rms_velocity: of(self.rms_velocity),
            peak_acceleration: of(self.peak_acceleration),
            rms_acceleration: of(self.rms_acceleration),
        }
    }
}

impl Shaking {
    /// Of the largest velocity and acceleration, and their mean squares.
    #[doc(hidden)]
    pub fn of([velocity, acceleration]: [f64; 2], mean_squares: [f64; 2]) -> Self {
        let [rms_velocity, rms_acceleration] = mean_squares.map(f64::sqrt);
        let (peak_velocity, peak_acceleration) = (velocity, acceleration);
        Self { peak_velocity, rms_velocity, peak_acceleration, rms_acceleration }
    }

    /// That of a sine: its amplitude and frequency ratio.
    pub fn of_sine(amplitude: f64, frequency: f64) -> Self {
        let velocity = amplitude * frequency;
        let acceleration = velocity * frequency;
        let [rms_velocity, rms_acceleration] =
            [velocity, acceleration].map(|one| one * std::f64::consts::FRAC_1_SQRT_2);
        Self {
            peak_velocity: velocity,
            rms_velocity,
            peak_acceleration: acceleration,
            rms_acceleration,
        }
    }
}
