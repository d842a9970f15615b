//! What happens at a wall: impact by equation (2), the end of a chattering sequence, sustained
//! contact.
//!
//! After an impact with separation speed `u` while the wall accelerates towards the absorber with
//! `a`, the next impact follows after `2 u / a`, and the impacts crowd in geometrically: the
//! sequence is over after `2 u / (a (1 - r))`, and the gap never opens further than `u^2 / (2 a)`.
//! Once that excursion is below a named tolerance and the acceleration cannot change noticeably
//! before the sequence is over, the rest of it is replaced by its end: the absorber sticks.
//!
//! For the program itself: this module may change at any time.

use serde::Serialize;

use crate::numerics::lanes::Real;

/// When a chattering sequence is replaced by its end.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ContactTolerance {
    /// Largest opening of the gap that is neglected, over the clearance. The default of 1e-12 is
    /// far below any printed digit and a thousand times above rounding, as long as the motion is
    /// not a thousand clearances large; then rounding takes its place.
    pub excursion: f64,
    /// Largest relative change of the contact acceleration while the rest of the sequence lasts.
    /// The default of 0.01 keeps the geometric decay, on which the replacement rests, provable.
    pub drift: f64,
}

impl Default for ContactTolerance {
    fn default() -> Self {
        Self { excursion: 1e-12, drift: 0.01 }
    }
}

/// Velocities after an impact, over the clearance and in fast time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rebound<R = f64> {
    /// Oscillator after impact.
    pub x_velocity: R,
    /// Absorber after impact.
    pub y_velocity: R,
    /// Energy lost per unit of the oscillator's mass.
    pub loss: R,
}

/// Equation (2): total momentum is kept, the relative velocity is reversed and multiplied by `r`.
#[inline(always)]
pub fn rebound<R: Real>(mass_ratio: R, restitution: R, x_velocity: R, y_velocity: R) -> Rebound<R> {
    let approach = x_velocity - y_velocity;
    let share = approach / (mass_ratio + 1.0);
    let exchanged = (restitution + 1.0) * share;
    let lost = -(restitution * restitution) + 1.0;
    Rebound {
        x_velocity: x_velocity - mass_ratio * exchanged,
        y_velocity: y_velocity + exchanged,
        loss: mass_ratio * 0.5 * lost * approach * share,
    }
}

/// The state at a wall right after an impact or a touch, seen from the wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AtWall {
    /// Speed at which the gap opens; 0 or more.
    pub separation_speed: f64,
    /// Acceleration of the wall towards the absorber, were the absorber flying.
    pub closing_acceleration: f64,
    /// Speed of the wall.
    pub speed: f64,
    /// Largest rate at which the forcing of the oscillator changes.
    pub force_rate: f64,
    /// Damping coefficient of the oscillator, `eps lambda`.
    pub damping: f64,
    /// Stiffness of the oscillator.
    pub stiffness: f64,
}

impl AtWall {
    /// Bound on the rate at which the closing acceleration changes for a time `duration`, impacts
    /// included, as long as it has not grown by more than the share `drift`.
    ///
    /// Equation (1) makes it the forcing's rate, the damping times what the velocity changes by, and
    /// the stiffness times the velocity. The acceleration changes the velocity by at most
    /// `a (1 + drift)` times the duration, and the impacts that are left take back no more than that.
    fn jerk_bound(&self, drift: f64, duration: f64) -> f64 {
        let change = 2.0 * (1.0 + drift) * self.closing_acceleration;
        self.force_rate + self.damping * change + self.stiffness * (self.speed + change * duration)
    }
}

impl ContactTolerance {
    /// Whether the absorber sticks to the wall from here on.
    pub fn sticks(&self, restitution: f64, at: &AtWall) -> bool {
        let AtWall { separation_speed: u, closing_acceleration: a, .. } = *at;
        if a <= 0.0 {
            return false;
        }
        if u == 0.0 {
            return true;
        }
        let remaining = 2.0 * u / (a * (1.0 - restitution));
        let change = at.jerk_bound(self.drift, remaining) * remaining;
        u * u <= 2.0 * a * self.excursion && change <= self.drift * a
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at_wall(separation_speed: f64, closing_acceleration: f64) -> AtWall {
        AtWall {
            separation_speed,
            closing_acceleration,
            speed: 0.1,
            force_rate: 0.0,
            damping: 0.01,
            stiffness: 1.0,
        }
    }

    #[test]
    fn an_impact_keeps_momentum_and_reverses_the_relative_velocity() {
        let (eps, r, x, y) = (0.3, 0.6, 1.4, -0.2);
        let after = rebound(eps, r, x, y);
        assert!((after.x_velocity + eps * after.y_velocity - (x + eps * y)).abs() < 1e-15);
        assert!((after.x_velocity - after.y_velocity + r * (x - y)).abs() < 1e-15);
        let kinetic = |x: f64, y: f64| 0.5 * (x * x + eps * y * y);
        let lost = kinetic(x, y) - kinetic(after.x_velocity, after.y_velocity);
        assert!((lost - after.loss).abs() < 1e-15);
    }

    #[test]
    fn an_elastic_impact_loses_nothing_and_never_sticks() {
        assert_eq!(rebound(0.1, 1.0, 1.0, -1.0).loss, 0.0);
        let at = at_wall(1e-9, 1.0);
        assert!(!ContactTolerance::default().sticks(1.0, &at));
        assert!(ContactTolerance::default().sticks(0.6, &at));
    }

    #[test]
    fn a_wall_that_recedes_does_not_hold_the_absorber() {
        let at = at_wall(0.0, -1.0);
        assert!(!ContactTolerance::default().sticks(0.0, &at));
    }
}
