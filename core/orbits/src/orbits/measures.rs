//! What an orbit means for a design: amplitudes, first harmonics, and where its energy goes.
//!
//! Integrals along the orbit are taken by a quadrature that is exact to rounding for the closed-form
//! motion; the energy balance over a period is therefore a check and not an identity.

use std::f64::consts::{FRAC_PI_4, PI, TAU};

use serde::Serialize;

use super::OrbitError;
use super::admissibility::zeros;
use super::cycle::Cycle;
use super::flight::Derivatives;
use super::impact_map::{ImpactMap, Step};

use crate::numerics::{is_zero, quadrature};
use crate::operation_count;
use crate::system::System;

/// Radians, or decay times, of the fastest motion in one panel of the quadrature: eight Gauss points
/// on an eighth of a turn integrate products of two sinusoids to rounding.
const PANEL: f64 = FRAC_PI_4;

/// Largest values along an orbit, over the clearance, fast time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Peaks {
    /// Of the absolute displacement of the oscillator.
    pub displacement: f64,
    /// Of its absolute velocity.
    pub velocity: f64,
}

impl Peaks {
    /// Along a cycle: at impacts and where displacement or velocity turns between them.
    pub fn of(map: &ImpactMap, cycle: &Cycle) -> Self {
        let mut peaks = Self { displacement: 0.0, velocity: 0.0 };
        for leg in cycle.flights(map) {
            let frequency = map.flight.frequency();
            let zeros = |rates: fn(Derivatives) -> [f64; 2]| {
                zeros(&leg, frequency, |_, oscillator| rates(oscillator))
            };
            let turns = zeros(|at| [at.v, at.a]).into_iter().chain(zeros(|at| [at.a, at.jerk]));
            for at in [0.0, leg.duration].into_iter().chain(turns).map(|s| leg.oscillator(s)) {
                peaks.displacement = peaks.displacement.max(at.x.abs());
                peaks.velocity = peaks.velocity.max(at.v.abs());
            }
        }
        peaks
    }
}

/// Energy per excitation period, per unit of the oscillator's mass, over the squared clearance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct EnergyPerPeriod {
    /// Work of the excitation.
    pub input: f64,
    /// Lost in the damper.
    pub damper: f64,
    /// Lost in impacts.
    pub impact: f64,
    /// Lost by friction in the cavity.
    #[serde(skip_serializing_if = "is_zero")]
    pub friction: f64,
    /// `abs(input - damper - impact - friction)` over the largest of the four: rounding.
    pub relative_residual: f64,
}

/// Averages along an orbit; lengths over the clearance, fast time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Measures {
    /// Largest values.
    pub peaks: Peaks,
    /// Root mean square of the oscillator's displacement.
    pub rms: f64,
    /// First harmonic of the oscillator: coefficients of `sin` and `cos` of the excitation's phase.
    pub oscillator_harmonic: [f64; 2],
    /// The same for the absorber.
    pub absorber_harmonic: [f64; 2],
    /// Where the energy goes.
    pub energy: EnergyPerPeriod,
}

impl Measures {
    /// Along a cycle of `system`.
    ///
    /// # Errors
    /// [`OrbitError::NoSteadyMotion`] for an undamped oscillator driven at its natural frequency.
    pub fn of(system: &System, cycle: &Cycle) -> Result<Self, OrbitError> {
        let map = ImpactMap::of(system)?;
        let sums = integrals(system, &map, cycle);
        let omega = map.flight.frequency();
        let turn = cycle.closure.turn();
        let periods = turn / TAU;
        // Of half an orbit that equals its mirror image: quadratic terms and products with the
        // excitation repeat.
        let harmonic = |k: usize| omega * sums[k] / (periods * PI);
        let impact = impact_loss(system, &map, cycle) / periods;
        let friction = friction_loss(&map, cycle) / periods;
        let (input, damper) = (sums[1] / periods, sums[2] / periods);
        let largest = input.abs().max(damper).max(impact).max(friction).max(f64::MIN_POSITIVE);
        Ok(Self {
            peaks: Peaks::of(&map, cycle),
            rms: (sums[0] * omega / turn).sqrt(),
            oscillator_harmonic: [harmonic(3), harmonic(4)],
            absorber_harmonic: [harmonic(5), harmonic(6)],
            energy: EnergyPerPeriod {
                input,
                damper,
                impact,
                friction,
                relative_residual: (input - damper - impact - friction).abs() / largest,
            },
        })
    }
}

/// Over the computed part of the cycle: `x^2`, power of the excitation, power of the damper, `x` and
/// `y` times `sin` and `cos` of the phase.
fn integrals(system: &System, map: &ImpactMap, cycle: &Cycle) -> [f64; 7] {
    let omega = map.flight.frequency();
    let damping = map.flight.damping();
    let (sine, cosine) = system.excitation_amplitudes();
    let oscillating = 1.0_f64.max(omega);
    let panels = [PANEL / oscillating.max(damping), PANEL / oscillating];
    let mut sums = [0.0; 7];
    for leg in cycle.flights(map) {
        quadrature::graded_nodes(leg.duration, panels[0], panels[1], |s, weight| {
            operation_count::note(2 * operation_count::ELEMENTARY + 30);
            let at = leg.oscillator(s);
            let y = leg.absorber(s);
            let (sin, cos) = libm::sincos(leg.start.phase + omega * s);
            let force = sine * sin + cosine * cos;
            let terms = [
                at.x * at.x,
                force * at.v,
                damping * at.v * at.v,
                at.x * sin,
                at.x * cos,
                y * sin,
                y * cos,
            ];
            for (sum, term) in sums.iter_mut().zip(terms) {
                *sum += weight * term;
            }
        });
    }
    sums
}

/// Each impact loses `eps (1 - r^2) w'^2 / (2 (1 + eps))`.
fn impact_loss(system: &System, map: &ImpactMap, cycle: &Cycle) -> f64 {
    let eps = system.mass_ratio();
    let loss = |step: &Step| {
        let r = map.restitution(step.next.wall);
        let share = 0.5 * eps * (1.0 - r) * (1.0 + r) / (1.0 + eps);
        share * step.approach * step.approach
    };
    cycle.steps(map).iter().map(loss).sum()
}

/// Friction takes `eps f` from all that the absorber slides.
fn friction_loss(map: &ImpactMap, cycle: &Cycle) -> f64 {
    let flights = cycle.flights(map);
    flights.iter().map(|leg| leg.push() * (leg.start.wall.sign() - leg.to.sign())).sum()
}
