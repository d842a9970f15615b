//! What (14) and (15) give: the slow invariant manifold, its fold, and where symmetry breaks.
//!
//! The squares of (14) and (15) add up to `C^2 = (b - B)^2 + R B^2`, which is (16). With `beta = B/b` and
//! `u = beta - 1`, kept apart because the fold is at `beta = 1` as impacts become elastic, it is
//! `c_2 = u^2 + R (1 + u)^2`. Its smallest value is the fold. The half-period map of the impact pair has a
//! multiplier 1 where `1 - tr + det = 0`, which is the fold again, and -1 where `1 + tr + det = 0`: with
//! `k C cos Theta = pi^2 (1 + r) (b - B)/(4 B)` that is `4 beta + pi^2 (1 - beta) = 0`. A point is a motion
//! only if the absorber stays between the walls from impact to impact.

use std::f64::consts::PI;

use crate::symbolic::{atan2, equations, sqrt, square};

equations! {
    /// In reading order.
    GROUPS =
    "Slow invariant manifold", "every motion with two symmetric impacts per cycle",
    "derived here from (14) and (15); paper (16)" => {
        MANIFOLD(R, b, B): [square(C)] = (1.0 + R) * square(B) - 2.0 * b * B + square(b);
    }
    "Manifold over the clearance", "the form that is evaluated", "derived here" => {
        MANIFOLD_SQUARE(R, u): [c_2] = square(u) + R * square(1.0 + u);
    }
    "Phase of the absorber", "from (14) and (15)", "derived here" => {
        ABSORBER_PHASE(rho, beta, u): [Theta] = atan2(2.0 / PI * rho * beta, -u);
    }
    "Fold", "where the manifold's stable branch begins, the smallest amplitude that sustains impacts",
    "derived here" => {
        FOLD_ABSORBER(R, b): [B_fold] = b / (1.0 + R);
        FOLD_OSCILLATOR(R, b): [C_fold] = b * sqrt(R / (1.0 + R));
        FOLD_RATIO(R): [beta_fold] = 1.0 / (1.0 + R);
        FOLD_SHIFT(R): [u_fold] = -R / (1.0 + R);
    }
    "Stable branch", "the amplitude to the right of the fold", "derived here: the larger root of (16)" => {
        STABLE_ROOT(R, c_2): [w_2] = (1.0 + R) * c_2 - R;
        STABLE_RATIO(R, w_2): [beta] = (1.0 + sqrt(w_2)) / (1.0 + R);
    }
    "Symmetry breaking", "where the stable branch ends: a multiplier is -1", "derived here" => {
        BREAKING_RATIO(): [beta_c] = square(PI) / (square(PI) - 4.0);
        BREAKING_SHIFT(): [u_c] = 4.0 / (square(PI) - 4.0);
    }
}
