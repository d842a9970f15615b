//! Two impacts per cycle in a cavity with a tilt, friction and two restitutions, lengths over the clearance.
//!
//! At leading order the oscillator is prescribed, `x = c sin(phi)`, and the absorber flies from the wall `w = b` to
//! `w = -b` in the phase `t_1` with `y'' = a - f`, and back in `t_2 = 2 pi - t_1` with `y'' = a + f`. With the phase
//! midway between the impacts, `c_c` and `c_s` are `c` times its cosine and sine: `x_2 - x_1 = 2 c_c cos(nu)`, so that
//! the absorber goes `2 beta = 2 (c_c cos(nu) + 1)` from wall to wall, which gives `u_1` and `u_2`. An impact at a wall
//! with `rho_i` has the oscillator's velocity `(u + m)/2 + rho_i (u - m)/2`, `m` and `u` the absorber's before and
//! after. Over both impacts the sum of these velocities is `-2 c_c sin(nu)`, which with `beta` gives `c_c`; their
//! difference is `-2 c_s cos(nu)`, which gives `c_s`. At the walls' symmetry, `a = rho_d = 0`, both sides of
//! the equation of `c_c` vanish at `nu = 0`, and `c_c = beta - 1` is free: (14), and with `c_s` (15) and a constant.
//!
//! Without tilt and friction and with equal ends a change `d phi`, `du` right after the first impact becomes
//! `d phi_2 = ((x_1' - u_1) d phi + t_1 du)/s_2` at the second, `s_i` the relative velocity before an impact, and the absorber
//! leaves it with `du_2 = -(1 + r) x_2 d phi_2 - r du`; likewise back. As `x_i' - u_i = -r s_i`, the trace over both is
//! `2 r^2 + 2 pi r (g_1 + g_2) + t_1 t_2 g_1 g_2` with `g_i = (1 + r) x_i/s_i`. In the longer flight `w` turns where
//! `x' = u_1`: at `x = -sqrt(c^2 - u_1^2)`, and, towards the wall that the absorber left, at `x_w = sqrt(c^2 - u_1^2)`, where
//! `w - 1 = x_w - x_1 - u_1 (phi - phi_1)`.
//!
//! The first harmonic of `y` is that of `-y''`: two impulses and two constant accelerations. `S` and `K` are its
//! components, as in [`super::dissipation`]. Valid at first order in the mass ratio while `w'` keeps its sign in
//! flight; without friction, while `abs(w) < b` there.

use std::f64::consts::PI;

use crate::symbolic::{atan2, cos, cube, equations, sin, sqrt, square};

const DEFINITION: &str = "definition";
const DERIVED: &str = "derived here beyond the paper; first order in epsilon, 1:1 resonance, two impacts per cycle, \
     the relative velocity keeping its sign between them";
const LIMITS: &str = "derived here beyond the paper; level cavity without friction, equal ends";
const FRICTION: &str = "derived here beyond the paper; level cavity, equal ends, t_1 = t_2";

equations! {
    /// In reading order.
    GROUPS =
    "Restitution at two ends", "mean and difference of rho at the walls w = b and w = -b", DEFINITION => {
        RATIO_MEAN(rho_1, rho_2): [rho_m] = (rho_1 + rho_2) / 2.0;
        RATIO_DIFFERENCE(rho_1, rho_2): [rho_d] = rho_1 - rho_2;
    }
    "Times between two impacts", "phase of the flights from w = b to w = -b and back", DEFINITION => {
        TIME_1(nu): [t_1] = PI + 2.0 * nu;
        TIME_2(nu): [t_2] = PI - 2.0 * nu;
    }
    "Manifold of a cavity with tilt and friction", "every motion with two impacts per cycle, by the times between them",
    DERIVED => {
        SIDE(a, f, rho_m, rho_d, nu, t_1, t_2): [n_c]
            = 4.0 * nu - PI * rho_d + rho_m * (PI * a / 2.0 - f * nu) * t_1 * t_2;
        FACTOR(rho_d, nu, t_1, t_2): [d_c] = t_1 * t_2 * sin(nu) - (4.0 * nu - PI * rho_d) * cos(nu);
        IN_PHASE(n_c, d_c): [c_c] = n_c / d_c;
        ABSORBER(nu, c_c): [beta] = 1.0 + c_c * cos(nu);
        DRIFT(a, f, nu): [v_T] = 2.0 * PI * a - 4.0 * f * nu;
        QUADRATURE(a, f, rho_m, rho_d, nu, t_1, t_2, beta, v_T): [c_s]
            = (4.0 * PI * rho_m * beta / (t_1 * t_2) + PI * f - 2.0 * a * nu - rho_d * v_T / 4.0) / (2.0 * cos(nu));
        AMPLITUDE(c_c, c_s): [c] = sqrt(square(c_c) + square(c_s));
    }
    "Oscillator at two impacts", "its displacements and velocities at w = b and w = -b", DERIVED => {
        PLACE_1(nu, c_c, c_s): [x_1] = -(c_c * cos(nu) + c_s * sin(nu));
        SPEED_1(nu, c_c, c_s): [v_1] = c_s * cos(nu) - c_c * sin(nu);
        PLACE_2(nu, c_c, c_s): [x_2] = c_c * cos(nu) - c_s * sin(nu);
        SPEED_2(nu, c_c, c_s): [v_2] = -(c_s * cos(nu) + c_c * sin(nu));
    }
    "Velocities of the absorber", "right after the impacts at w = b and w = -b", DERIVED => {
        VELOCITY_1(a, f, t_1, beta): [u_1] = 2.0 * beta / t_1 - (a - f) * t_1 / 2.0;
        VELOCITY_2(a, f, t_2, beta): [u_2] = -2.0 * beta / t_2 - (a + f) * t_2 / 2.0;
    }
    "Force of the absorber with tilt and friction", "its part that takes energy and its part in phase with the displacement",
    DERIVED => {
        IMPULSE(nu, t_1, t_2, beta): [M] = 8.0 * PI * beta * cos(nu) / (t_1 * t_2);
        CONTACT(f, nu, v_T): [N] = 4.0 * f * cos(nu) - v_T * sin(nu);
        RESISTANCE(c_c, c_s, c, M, N): [S] = (c_s * M - c_c * N) / (PI * c);
        REACTANCE(c_c, c_s, c, M, N): [K] = -(c_c * M + c_s * N) / (PI * c);
    }
    "Friction alone", "energy that a cycle takes, fold and symmetry breaking", FRICTION => {
        FRICTION_LOSS(f, rho, beta): [c * S] = 16.0 / cube(PI) * rho * square(beta) + 4.0 / PI * f;
        FRICTION_FOLD_RATIO(f, rho, R): [beta_fold] = (1.0 - rho * f) / (1.0 + R);
        FRICTION_FOLD(f, rho, R): [c_fold] = (2.0 / PI * rho + PI * f / 2.0) / sqrt(1.0 + R);
        FRICTION_BREAKING(f, rho): [beta_c] = square(PI) * (1.0 - rho * f) / (square(PI) - 4.0);
    }
    "End of two asymmetric impacts", "their trace over a cycle, and what falls to 0 where they double their period and \
     rises to 0 where the absorber grazes the wall w = b again",
    LIMITS => {
        WALL_1(r, x_1, v_1, u_2): [g_1] = (1.0 + r) * x_1 / (v_1 - u_2);
        WALL_2(r, x_2, v_2, u_1): [g_2] = (1.0 + r) * x_2 / (v_2 - u_1);
        TRACE(r, t_1, t_2, g_1, g_2): [tr_c] = 2.0 * square(r) + 2.0 * PI * r * (g_1 + g_2) + t_1 * t_2 * g_1 * g_2;
        DETERMINANT(r): [det] = square(r);
        DOUBLING(tr_c, det): [h_PD] = 1.0 + tr_c + square(det);
        TURNING(c, u_1): [x_w] = sqrt(square(c) - square(u_1));
        GRAZING(c_c, c_s, t_1, u_1, x_1, x_w): [h_g]
            = x_w - x_1 - u_1 * (atan2(x_w, u_1) - atan2(c_s, c_c) + t_1 / 2.0);
    }
    "Small tilt or unequal ends", "how far the flights differ, at first order in tilt and difference of the ends",
    "derived here beyond the paper; far from symmetry breaking, where it has no limit" => {
        DEVIATION(a, f, rho_m, rho_d, beta): [nu]
            = PI * (rho_d * beta - square(PI) * rho_m * a / 2.0)
                / (square(PI) * (1.0 - rho_m * f) - (square(PI) - 4.0) * beta);
    }
}
