//! How a small change of state evolves along a trajectory: exact tangent dynamics at fixed
//! excitation phase.
//!
//! With `d` before a quantity for its small change at the same time (not at the same event):
//!
//! * **Flight.** The excitation is the same for both motions, so `(dx, dx')` moves freely, equation
//!   (1) without right-hand side, in closed form; `dy` grows by `dy' s`.
//! * **Impact.** The changed motion meets the wall earlier or later by `dt = -dw / w'-`, where
//!   `w'- = x'- - y'-`. Carried to its own impact the change is `d + f- dt`, with the state's rate of
//!   change `f- = (x'-, x''-, y'-, 0)`; equation (2) is linear with the matrix `J`; carried back with
//!   `f+` it is `J (d + f- dt) - f+ dt`, the saltation matrix. With `q = (1 + r)/(1 + eps)`,
//!   `x'- - x'+ = eps q w'-`, `y'- - y'+ = -q w'-`, `x''- - x''+ = -eps lambda (x'- - x'+)` (the
//!   damper feels the jump) and `y'' = 0` this becomes
//!
//!   `dx+ = dx - eps q dw`, `dy+ = dy + q dw` (so that `dw+ = -r dw`),
//!   `dx'+ = dx' - eps q (dw' - k dw) + eps lambda eps q dw`, `dy'+ = dy' + q (dw' - k dw)`,
//!
//!   with `k = x''- / w'-`, infinite at grazing. Its determinant is `r^2`. It keeps `dx + eps dy` and
//!   `dx' + eps dy' + eps lambda dx`: centre of mass and the impulse that the wall cannot change.
//! * **Sticking.** All further impacts of a completed chattering sequence happen at one moment and
//!   keep both of these; afterwards `dw = dw' = 0`. That is a projection, in which two directions
//!   are lost for good.
//! * **Sustained contact.** As in flight, with the mass `1 + eps`, `dy = dx`.
//! * **Tilt and friction.** Flights stay as they are. At an impact `k = w''-/w'-`, and friction changes its direction
//!   there, which takes `2 f dw/abs(w'-)` from `dy'+` and adds `eps` times it to `dx'+`. Where sliding ends,
//!   `dt = -dw'/w''-`: `dx' + eps dy'` is kept, and of `dw'` the part `w''+/w''-` is left; none where friction
//!   holds the absorber, which keeps its `dw`.
//! * **Release.** The wall's force, `eps y''`, vanishes at this moment, so that accelerations on both
//!   sides of it are equal, `f- = f+`, and a changed time of release changes nothing: identity.
//!
//! A flight that grazes a wall, and a contact that is lost or not, are the exceptions at which no
//! derivative exists; no trajectory meets them but by choice of its start.

use super::events::{AbsorberMotion, Impact, Observer, Reversal, Segment};
use super::flow::{Kinematics, Oscillator};
use super::sliding::Sliding;
use crate::system::{State, System};

/// A small change of state that is carried along a trajectory, an [`Observer`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tangent {
    alone: Oscillator,
    sliding: Sliding,
    mass_ratio: f64,
    restitutions: [f64; 2],
    /// `(dx, dx', dy, dy')`, on the scale of its choice: the dynamics is linear.
    pub change: State,
    /// Logarithm of the factors that [`Tangent::normalize`] has taken out, less their compensation.
    taken: f64,
    compensation: f64,
}

/// Sizes between which a change is left as it is within a period: far from overflow, so that even
/// the steepest impact cannot reach it in one step.
const COMFORTABLE: std::ops::Range<f64> = 1e-100..1e100;

impl Tangent {
    /// Begins with a change of state.
    pub fn begin(system: &System, change: State) -> Self {
        Self {
            alone: Oscillator::alone(system),
            sliding: Sliding::of(system),
            mass_ratio: system.mass_ratio(),
            restitutions: system.restitutions(),
            change,
            taken: 0.0,
            compensation: 0.0,
        }
    }

    /// Size of the change, lengths over the clearance and fast time: the root of the sum of squares. Growth rates do not
    /// depend on the norm.
    pub fn size(&self) -> f64 {
        let State { x, x_velocity, y, y_velocity } = self.change;
        libm::hypot(libm::hypot(x, x_velocity), libm::hypot(y, y_velocity))
    }

    /// Brings the change to size 1 and remembers the factor; `false` if there is nothing left of it
    /// or it is not finite.
    pub fn normalize(&mut self) -> bool {
        let size = self.size();
        if !(size > 0.0 && size.is_finite()) {
            return false;
        }
        let State { x, x_velocity, y, y_velocity } = self.change;
        self.change = State {
            x: x / size,
            x_velocity: x_velocity / size,
            y: y / size,
            y_velocity: y_velocity / size,
        };
        // Compensated summation: a million periods add no rounding.
        let term = libm::log(size) - self.compensation;
        let sum = self.taken + term;
        self.compensation = (sum - self.taken) - term;
        self.taken = sum;
        true
    }

    /// Natural logarithm of the growth factor since the beginning that was taken out by
    /// [`Tangent::normalize`].
    pub fn logarithm(&self) -> f64 {
        self.taken
    }

    /// Twice the decay rate of the free oscillator, `eps lambda`.
    fn damping(&self) -> f64 {
        2.0 * self.alone.decay
    }

    /// The limit of infinitely many impacts at one moment: `dw = dw' = 0`, and what every impact
    /// keeps is kept.
    fn project(&mut self) {
        let State { x, x_velocity, y, y_velocity } = self.change;
        let eps = self.mass_ratio;
        let whole = 1.0 + eps;
        let common = x - eps / whole * (x - y);
        let velocity = x_velocity - eps / whole * (x_velocity - y_velocity)
            + self.damping() * (x - common) / whole;
        self.change = State { x: common, x_velocity: velocity, y: common, y_velocity: velocity };
    }
}

impl Observer for Tangent {
    fn segment(&mut self, segment: &Segment) {
        if matches!(segment.absorber, AbsorberMotion::Carried(_)) {
            // A trajectory may begin in contact, with any change; later ones are projected already.
            self.project();
        }
        let State { x, x_velocity, y, y_velocity } = self.change;
        let Kinematics { x, v } = segment.motion.oscillator().free(x, x_velocity, segment.duration);
        self.change = match segment.absorber {
            AbsorberMotion::Flying { .. } => {
                State { x, x_velocity: v, y: y + y_velocity * segment.duration, y_velocity }
            }
            AbsorberMotion::Carried(_) => State { x, x_velocity: v, y: x, y_velocity: v },
            AbsorberMotion::Held { .. } => {
                let y = x - self.change.relative_displacement();
                State { x, x_velocity: v, y, y_velocity: v }
            }
        };
    }

    fn impact(&mut self, impact: &Impact) {
        let State { x, x_velocity, y, y_velocity } = self.change;
        let eps = self.mass_ratio;
        let restitution = self.restitutions[impact.side.index()];
        let q = (1.0 + restitution) / (1.0 + eps);
        let approach = impact.x_velocity_before - impact.y_velocity_before;
        let before = Kinematics { x: impact.x, v: impact.x_velocity_before };
        let acceleration = self.alone.acceleration(impact.phase, before);
        let Sliding { gravity, friction, .. } = self.sliding;
        let sense = approach.signum();
        let bend = acceleration - gravity - sense * self.sliding.grip();
        let gap = x - y;
        let rate = x_velocity - y_velocity - bend / approach * gap;
        let turned = 2.0 * friction * gap / approach.abs();
        self.change = State {
            x: x - eps * q * gap,
            x_velocity: x_velocity - eps * q * rate + self.damping() * eps * q * gap + eps * turned,
            y: y + q * gap,
            y_velocity: y_velocity + q * rate - turned,
        };
        if !COMFORTABLE.contains(&self.size()) {
            self.normalize();
        }
    }

    fn sticks(&mut self, _loss: f64) {
        self.project();
    }

    fn reversal(&mut self, reversal: &Reversal) {
        let State { x_velocity, y_velocity, .. } = self.change;
        let eps = self.mass_ratio;
        let Reversal { state, before, after, phase, .. } = *reversal;
        // Friction has no part in what both do together.
        let common = (x_velocity + eps * y_velocity) / (1.0 + eps);
        let slope = x_velocity - y_velocity;
        let pull = self.sliding.pull(&self.alone, phase, &state);
        let grip = self.sliding.grip();
        let left =
            if after == 0.0 { 0.0 } else { slope * (pull - after * grip) / (pull - before * grip) };
        self.change.x_velocity = common + eps / (1.0 + eps) * left;
        self.change.y_velocity = common - left / (1.0 + eps);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::Side;
    use crate::system::{Cavity, Excitation, Parameters};

    /// No force between the masses changes the centre of mass or its momentum, whose rate of change
    /// holds `-eps lambda x'`: what a wall does to a change of state leaves both.
    #[test]
    fn a_wall_changes_neither_centre_of_mass_nor_momentum() {
        let (eps, damping) = (0.3, 1.7);
        let system = System::new(Parameters {
            mass_ratio: eps,
            damping,
            restitution: 0.6,
            frequency_ratio: 1.1,
            forcing_per_clearance: 2.0,
            excitation: Excitation::Force,
            cavity: Cavity::IDEAL,
        })
        .expect("valid");
        let kept = |change: State| {
            let State { x, x_velocity, y, y_velocity } = change;
            [x + eps * y, x_velocity + eps * y_velocity + eps * damping * x]
        };
        let same = |a: [f64; 2], b: [f64; 2]| (0..2).all(|k| (a[k] - b[k]).abs() < 1e-14);
        let change = State { x: 0.3, x_velocity: -0.7, y: 0.9, y_velocity: 0.2 };
        let mut struck = Tangent::begin(&system, change);
        struck.impact(&Impact {
            tau: 1.0,
            phase: 0.4,
            side: Side::Plus,
            x: 0.5,
            x_velocity_before: 0.8,
            x_velocity_after: 0.0,
            y_velocity_before: -0.1,
            y_velocity_after: 0.0,
            loss: 0.0,
            penetration: 0.0,
        });
        assert!(same(kept(struck.change), kept(change)), "{struck:?}");
        // The gap's change is reversed and shrinks by r.
        assert!(
            (struck.change.relative_displacement() + 0.6 * change.relative_displacement()).abs()
                < 1e-14,
            "{struck:?}"
        );
        let mut stuck = Tangent::begin(&system, change);
        stuck.sticks(0.0);
        assert!(same(kept(stuck.change), kept(change)), "{stuck:?}");
        assert_eq!(stuck.change.relative_displacement(), 0.0);
        assert_eq!(stuck.change.x_velocity, stuck.change.y_velocity);
    }
}
