//! Return map of the time between impacts, section 4.1 and Fig. 11.

use crate::simulation::Impact;

/// Successive pairs `(dt_i, dt_{i+1})` of the times between impacts, over the excitation period.
///
/// A motion with two impacts per period lies on L1, `dx + dy = 1`; a symmetric one where L1 meets
/// L4, `dx = dy`.
pub fn pairs(impacts: &[Impact], period: f64) -> Vec<[f64; 2]> {
    impacts
        .windows(3)
        .map(|three| {
            [(three[1].tau - three[0].tau) / period, (three[2].tau - three[1].tau) / period]
        })
        .collect()
}
