//! The exact symmetric orbits in the order in which a reader meets them.

use super::report::{Motion, derived, latex, stated};
use super::{Equations, ReportEquation, SteadyMotion};
use crate::symbolic::Expr;
use crate::symbolic::Symbol::{
    AmplitudeRatio as beta, Discriminant, DisplacementCoefficient, FlightChange,
    ForcingPerClearance as gamma, ImpactPhase as phi, LinearGain, RepeatedDisplacement,
    RepeatedVelocity, SteadyCosine, SteadyDisplacement, SteadySine, SteadyVelocity,
    VelocityCoefficient, VelocityRatioAfter, VelocityRatioBefore, WDotBefore, YDotAfter,
};
use crate::symbolic::{cos, sin};
use crate::system::Excitation;

impl Equations {
    /// Conditions, what follows from them, and the orbits of one forcing.
    pub(super) fn symmetric_orbits(&self) -> Vec<ReportEquation> {
        let list = [self.orbit_conditions(), self.orbit_curve(), self.orbits_at_forcing()].concat();
        let on_orbit = |equation| ReportEquation { motion: Motion::SymmetricOrbit, ..equation };
        list.into_iter().map(on_orbit).collect()
    }

    fn orbit_conditions(&self) -> Vec<ReportEquation> {
        let c = &self.orbits.conditions;
        let propagated = "the oscillator half a period later, less the steady motion; after a unit \
                          of velocity the free oscillator has displacement g and velocity g' there";
        vec![
            stated(&c.period, "half of it lies between the impacts of an exact symmetric orbit"),
            stated(&c.amplitude, "the exact counterpart of the slow amplitude"),
            stated(&c.contact, "where the absorber is at an impact on the wall +b"),
            stated(&c.flight, "the absorber's speed"),
            stated(&c.arrival, "the velocity with which the absorber reaches the wall +b"),
            stated(&c.momentum, "one relation of the velocities at an impact"),
            stated(&c.restitution, "the other relation of the velocities at an impact"),
            stated(&c.propagation[0], propagated),
            stated(&c.propagation[1], propagated),
        ]
    }

    fn orbit_curve(&self) -> Vec<ReportEquation> {
        let o = &self.orbits;
        let repeated = "what the oscillator keeps of impulses that repeat with opposite sign";
        let velocities = "velocity of the oscillator after and before an impact over the \
                          absorber's speed";
        let steady = "the steady motion that an orbit with amplitude B needs";
        let coefficients = "what all symmetric orbits of the system share, at any forcing";
        let quantity = |title, gives, symbol, right| derived(title, gives, latex(symbol), right);
        vec![
            stated(&o.conditions.repetition[0], repeated),
            stated(&o.conditions.repetition[1], repeated),
            quantity("Repeated impulse", repeated, RepeatedVelocity, &o.repeated_velocity),
            quantity("Repeated impulse", repeated, RepeatedDisplacement, &o.repeated_displacement),
            quantity(
                "Speed of the absorber",
                "its flight takes half a period",
                YDotAfter,
                &o.speed,
            ),
            quantity("Velocities at an impact", velocities, VelocityRatioAfter, &o.velocity_after),
            quantity(
                "Velocities at an impact",
                velocities,
                VelocityRatioBefore,
                &o.velocity_before,
            ),
            quantity(
                "Impact speed",
                "the relative speed at which the wall is met",
                WDotBefore,
                &o.impact_speed,
            ),
            quantity("Steady motion at an impact", steady, SteadyDisplacement, &o.displacement),
            quantity("Steady motion at an impact", steady, SteadyVelocity, &o.velocity),
            quantity(
                "Coefficients of the exact orbits",
                coefficients,
                DisplacementCoefficient,
                &o.displacement_coefficient,
            ),
            quantity(
                "Coefficients of the exact orbits",
                coefficients,
                VelocityCoefficient,
                &o.velocity_coefficient,
            ),
        ]
    }

    fn orbits_at_forcing(&self) -> Vec<ReportEquation> {
        let o = &self.orbits;
        let mut list = vec![
            stated(&o.conditions.stiffness, "the oscillator's answer to the excitation"),
            stated(&o.conditions.loss, "the oscillator's answer to the excitation"),
        ];
        list.extend(steady_motion(&o.steady_of_base, Excitation::BaseDisplacement));
        list.extend(steady_motion(&o.steady_by_force, Excitation::Force));
        let quadratic = "its roots above 0 are the exact symmetric orbits";
        let saddle_node = "two orbits meet and less forcing has none, if this amplitude is above 0";
        let phase = "the phase of the excitation at an impact on the wall +b";
        list.extend([
            ReportEquation {
                left_expression: Some(o.condition.clone()),
                ..derived("Exact symmetric orbits", quadratic, o.condition.to_latex(), &Expr::ZERO)
            },
            derived("Exact symmetric orbits", quadratic, latex(Discriminant), &o.discriminant),
            derived("Exact symmetric orbits", quadratic, r"\beta_{1}", &o.ratios[0]),
            derived("Exact symmetric orbits", quadratic, r"\beta_{2}", &o.ratios[1]),
            derived(
                "Forcing of an exact orbit",
                "which excitation holds an amplitude",
                latex(gamma.squared()),
                &o.forcing_squared,
            ),
            derived(
                "Exact saddle-node",
                saddle_node,
                format!("{}_{{SN}}", latex(beta)),
                &o.turning_ratio,
            ),
            derived(
                "Exact saddle-node",
                saddle_node,
                format!("{}_{{SN}}", latex(gamma)),
                &o.turning_forcing,
            ),
            derived("Phase of an impact", phase, latex(cos(phi)), &o.phase_cosine),
            derived("Phase of an impact", phase, latex(sin(phi)), &o.phase_sine),
            derived(
                "Length of a flight",
                "how a gap dw at the end of a flight changes its length: part of every multiplier",
                latex(FlightChange),
                &o.flight_change,
            ),
            stated(&o.conditions.determinant, "the product of the multipliers of half a period"),
        ]);
        list
    }
}

fn steady_motion(steady: &SteadyMotion, only: Excitation) -> Vec<ReportEquation> {
    let title = "Steady motion without impacts";
    let gives =
        "coefficients of sin and cos of the excitation's phase, and the amplitude over gamma b";
    let parts =
        [(SteadySine, &steady.sine), (SteadyCosine, &steady.cosine), (LinearGain, &steady.gain)];
    let one = |(symbol, right)| ReportEquation {
        only: Some(only),
        ..derived(title, gives, latex(symbol), right)
    };
    parts.map(one).to_vec()
}
