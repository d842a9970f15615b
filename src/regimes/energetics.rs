//! Where the energy goes, and what the absorber is worth.

use serde::Serialize;

use crate::numerics::is_zero;
use crate::simulation::Statistics;
use crate::system::System;

/// The energy balance of a measured window as rates, and the vibration against that of the oscillator
/// alone. Energies are per unit of the oscillator's mass and over the squared clearance, rates per
/// unit of fast time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Energetics {
    /// Mean power of the excitation.
    pub input_power: f64,
    /// Mean power lost in the damper.
    pub damper_power: f64,
    /// Mean power lost in impacts, ends of chattering sequences included.
    pub impact_power: f64,
    /// Mean power lost by friction in the cavity.
    #[serde(skip_serializing_if = "is_zero")]
    pub friction_power: f64,
    /// Mean loss of an impact; `None` without impacts.
    pub loss_per_impact: Option<f64>,
    /// Mean loss in impacts per excitation period.
    pub loss_per_period: f64,
    /// Share of the excitation's work that impacts dissipate: the efficiency of targeted energy
    /// transfer. `None` where the excitation does no work over the window (nothing drives the
    /// system, or it gives energy back), so that there is nothing to take a share of. Above 1 while
    /// stored energy runs down.
    pub transfer_efficiency: Option<f64>,
    /// Peak displacement against that of the oscillator alone in steady motion, `20 log10` of the
    /// ratio: below zero where the absorber reduces it. `None` if alone it has no steady motion, or
    /// none but rest.
    pub peak_change_db: Option<f64>,
    /// The same for the root mean square displacement.
    pub rms_change_db: Option<f64>,
}

impl Energetics {
    /// Of the window that `statistics` measured.
    pub fn of(system: &System, statistics: &Statistics) -> Self {
        let energy = statistics.energy();
        let periods = statistics.periods().max(1) as f64;
        let duration = periods * system.period();
        let impacts = statistics.impacts();
        let bare = system.linear_response().map(|response| response.amplitude());
        let change = |value: f64, shape: f64| {
            let alone = bare.filter(|amplitude| *amplitude > 0.0)? * shape;
            (value > 0.0).then(|| 20.0 * libm::log10(value / alone))
        };
        Self {
            input_power: energy.input / duration,
            damper_power: energy.damper / duration,
            impact_power: energy.impact / duration,
            friction_power: energy.friction / duration,
            loss_per_impact: (impacts > 0).then(|| energy.impact / impacts as f64),
            loss_per_period: energy.impact / periods,
            transfer_efficiency: (energy.input > 0.0).then(|| energy.impact / energy.input),
            peak_change_db: change(statistics.peak(), 1.0),
            rms_change_db: change(statistics.rms(), std::f64::consts::FRAC_1_SQRT_2),
        }
    }
}
