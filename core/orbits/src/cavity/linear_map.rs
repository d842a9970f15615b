//! The impact pair's map over a cycle, linearised: what small changes of the first impact become.
//!
//! The state right after an impact at the phase `phi` is `phi` and the absorber's velocity `u`; the oscillator is
//! prescribed. A flight of length `t` with the acceleration `a` to the other wall, which it reaches with
//! `m = u + a t`, changes by `(x_2' - m) d phi_2 = (x_1' - m) d phi_1 + t du` and
//! `dm = du + a (d phi_2 - d phi_1)`; the impact by `du_2 = (1 + r) x_2'' d phi_2 - r dm`. The determinant of
//! this is `-r` times the relative velocity after the first impact over that before the second, of the cycle
//! `r_1^2 r_2^2`.

use super::CavityTheory;
use super::shape::MotionShape;
use crate::operation_count;

/// By phase and velocity.
type Matrix = [[f64; 2]; 2];

/// Trace and determinant over a cycle, from after the first impact; `velocities` are the absorber's after the impacts.
pub(super) fn trace_and_determinant(
    cavity: &CavityTheory,
    shape: &MotionShape,
    [u1, u2]: [f64; 2],
) -> [f64; 2] {
    let (a, f, [r1, r2]) = (cavity.acceleration, cavity.friction, cavity.restitutions);
    let [[x1, v1], [x2, v2]] = shape.at_impacts();
    let [t1, t2] = shape.times;
    let there = flight([v1, v2], -x2, u1, [t1, a - f, r2]);
    let back = flight([v2, v1], -x1, u2, [t2, a + f, r1]);
    operation_count::note(50 + operation_count::ELEMENTARY);
    let product = |i: usize, j: usize| back[i][0] * there[0][j] + back[i][1] * there[1][j];
    [product(0, 0) + product(1, 1), r1 * r1 * r2 * r2]
}

/// A flight and the impact at its end: velocities of the oscillator at both ends, its acceleration at the second.
fn flight([v1, v2]: [f64; 2], acceleration: f64, u: f64, [t, a, r]: [f64; 3]) -> Matrix {
    let before = u + a * t;
    let phase = [(v1 - before) / (v2 - before), t / (v2 - before)];
    let velocity = [a * (phase[0] - 1.0), 1.0 + a * phase[1]];
    [phase, [0, 1].map(|k| (1.0 + r) * acceleration * phase[k] - r * velocity[k])]
}
