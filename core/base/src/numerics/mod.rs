//! Numerical methods that know nothing of physics. Each result carries its evidence: a bracket, a
//! residual, the number of evaluations.

pub mod bracket;
pub mod chebyshev;
pub mod crossing;
pub mod cyclic_word;
pub mod extremes;
pub mod gauss;
pub mod lanes;
pub mod polynomial;
pub mod quadrature;
pub mod scan;
pub mod scatter;

/// Whether a number is left out where it is written.
#[allow(clippy::trivially_copy_pass_by_ref, reason = "as serde calls it")]
#[doc(hidden)]
pub fn is_zero(value: &f64) -> bool {
    *value == 0.0
}
