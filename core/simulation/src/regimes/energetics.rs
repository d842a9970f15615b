//! Where the energy goes.

use serde::Serialize;

use crate::numerics::is_zero;
use crate::simulation::Statistics;
use crate::system::System;

/// The energy balance of a measured window as rates. Energies are per unit of the oscillator's mass and over the squared clearance, rates per
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
}

impl Energetics {
    /// Of the window that `statistics` measured.
    pub fn of(system: &System, statistics: &Statistics) -> Self {
        let energy = statistics.energy();
        let periods = statistics.periods().max(1) as f64;
        let duration = periods * system.period();
        let impacts = statistics.impacts();
        Self {
            input_power: energy.input / duration,
            damper_power: energy.damper / duration,
            impact_power: energy.impact / duration,
            friction_power: energy.friction / duration,
            loss_per_impact: (impacts > 0).then(|| energy.impact / impacts as f64),
            loss_per_period: energy.impact / periods,
        }
    }
}
