//! Symmetric 1:1 orbits of the full system at any mass ratio: two impacts per excitation period,
//! half a period apart, each the mirror image of the other.
//!
//! [`OrbitConditions`] states what such an orbit has to satisfy, [`SymmetricOrbits`] what follows:
//! the steady motion at an impact is linear in the absorber's amplitude, so its squared amplitude is
//! a quadratic, `(1 - A beta)^2 + (D beta)^2 = gamma^2 chi^2`. Exact; nothing is expanded in the
//! mass ratio. Valid where a steady motion exists, and a motion only if the absorber stays between
//! the walls from impact to impact. `B = b - x_0` is the exact counterpart of the slow amplitude in
//! (14), and `beta = B/b`.

use super::Stated;
use super::fixed_points::collected;
use super::manifold::in_clearances;
use super::stated::{definition, equation};
use crate::symbolic::Symbol::{
    AbsorberAmplitude as B, AmplitudeRatio as beta, Clearance as b, Damping as lambda, Determinant,
    Discriminant as Delta, DisplacementCoefficient as A, FastTime as tau, FlightChange,
    ForcingPerClearance as gamma, FrequencyRatio as Omega, GapChange, ImpactAbsorber as y_0,
    ImpactDisplacement as x_0, ImpactPhase as phi, ImpulseResponse as g,
    ImpulseResponseRate as g_dot, LinearGain as chi, Loss as delta, MassRatio as epsilon,
    Period as T, Pi as pi, ReducedForcing as G, RepeatedDisplacement as q_1,
    RepeatedVelocity as q_2, Restitution as r, SteadyCosine as X_c, SteadyDisplacement,
    SteadySine as X_s, SteadyVelocity, Stiffness as kappa, VelocityCoefficient as D,
    VelocityRatioAfter as v_after, WDotAfter, WDotBefore, X as x, XDot, XDotAfter, XDotBefore,
    XDotDot, YDotAfter, YDotBefore,
};
use crate::symbolic::{AlgebraError, Equation, Expr, cos, eliminate_angle, fraction, sin, sqrt};

const MIRRORED: &str = "exact for motions that repeat with opposite sign after T/2";
const FREE: &str = "free oscillator of (1) over T/2, exact";

/// What an exact symmetric 1:1 orbit has to satisfy, at an impact on the wall `+b`.
#[derive(Debug, Clone)]
pub struct OrbitConditions {
    /// `T`.
    pub period: Equation,
    /// `kappa`.
    pub stiffness: Equation,
    /// `delta`.
    pub loss: Equation,
    /// `B` of an orbit, through the displacement at the impact.
    pub amplitude: Equation,
    /// The absorber touches the wall.
    pub contact: Equation,
    /// The absorber flies freely for `T/2` and arrives at its mirror image.
    pub flight: Equation,
    /// It arrives with the velocity it left with, mirrored.
    pub arrival: Equation,
    /// (2), the momentum of an impact.
    pub momentum: Equation,
    /// (2), the restitution of an impact, in the two velocities.
    pub restitution: Equation,
    /// The oscillator's deviation from its steady motion after `T/2`: displacement, then velocity.
    pub propagation: [Equation; 2],
    /// `(Phi + I) q = (0, 1)`, by rows, `Phi` being the free propagator over `T/2`.
    pub repetition: [Equation; 2],
    /// The steady motion at the impact by its phase: displacement, and velocity over `Omega`.
    pub steady: [Equation; 2],
    /// `|Phi|`, and with it the determinant of the half-period map.
    pub determinant: Equation,
    /// What a small change of the state before a flight does to its length: the gap at its end,
    /// together with the longer flight, stays closed.
    pub saltation: Equation,
}

impl OrbitConditions {
    /// States them; the restitution is the one of `stated`.
    pub fn new(stated: &Stated) -> Self {
        let keep = g_dot + epsilon * lambda * g;
        let (x_free, v_free) = (x_0 - SteadyDisplacement, XDotAfter - SteadyVelocity);
        let in_velocities = |side: &Expr| {
            side.substitute(WDotAfter, XDotAfter - YDotAfter)
                .substitute(WDotBefore, XDotBefore - YDotBefore)
        };
        Self {
            period: definition("Period of the excitation", T, 2 * pi / Omega),
            stiffness: definition("Dynamic stiffness", kappa, (1 - Omega) * (1 + Omega)),
            loss: definition("Damping force", delta, epsilon * lambda * Omega),
            amplitude: equation(
                None,
                "Absorber amplitude of an orbit",
                B,
                b - x_0,
                "definition, as in (14)",
            ),
            contact: equation(None, "Contact at an impact", x_0 - y_0, b, "paper (2)"),
            flight: equation(
                None,
                "Flight of the absorber over half a period",
                y_0 + fraction(1, 2) * T * YDotAfter,
                -y_0,
                MIRRORED,
            ),
            arrival: equation(None, "Arrival of the absorber", YDotBefore, -YDotAfter, MIRRORED),
            momentum: equation(
                Some("(2)"),
                "Momentum at an impact",
                XDotAfter + epsilon * YDotAfter,
                XDotBefore + epsilon * YDotBefore,
                "paper (2)",
            ),
            restitution: equation(
                stated.restitution.number,
                "Restitution in the two velocities",
                in_velocities(&stated.restitution.left),
                in_velocities(&stated.restitution.right),
                "paper (2)",
            ),
            propagation: [
                equation(
                    None,
                    "Oscillator over half a period",
                    &keep * &x_free + g * &v_free,
                    -&x_free,
                    MIRRORED,
                ),
                equation(
                    None,
                    "Oscillator over half a period",
                    -g * &x_free + g_dot * &v_free,
                    -(XDotBefore - SteadyVelocity),
                    MIRRORED,
                ),
            ],
            repetition: [
                equation(None, "Repeated impulse", (1 + &keep) * q_1 + g * q_2, 0, FREE),
                equation(None, "Repeated impulse", -g * q_1 + (1 + g_dot) * q_2, 1, FREE),
            ],
            steady: [
                equation(
                    None,
                    "Steady motion at an impact",
                    SteadyDisplacement,
                    X_s * sin(phi) + X_c * cos(phi),
                    "definition",
                ),
                equation(
                    None,
                    "Steady motion at an impact",
                    SteadyVelocity / Omega,
                    X_s * cos(phi) - X_c * sin(phi),
                    "definition",
                ),
            ],
            determinant: equation(
                None,
                "Determinant of the exact half-period map",
                Determinant,
                r.squared() * (g_dot * &keep + g.squared()),
                "free flight and impact, derived here; it is r^2 exp(-eps lambda T/2)",
            ),
            saltation: equation(
                None,
                "Length of a flight",
                GapChange + WDotBefore * FlightChange,
                0,
                "first order in a change of the state before the flight",
            ),
        }
    }
}

/// Steady motion of the oscillator without impacts, and its amplitude.
#[derive(Debug, Clone)]
pub struct SteadyMotion {
    /// `X_s`, coefficient of `sin(Omega tau)`, in `epsilon`, `G`, `kappa`, `delta`.
    pub sine: Expr,
    /// `X_c`, coefficient of `cos(Omega tau)`.
    pub cosine: Expr,
    /// `chi`, the amplitude over `gamma b`.
    pub gain: Expr,
}

/// What follows for symmetric 1:1 orbits.
#[derive(Debug, Clone)]
pub struct SymmetricOrbits {
    /// What all of it is derived from.
    pub conditions: OrbitConditions,
    /// `q_1`, by `q_2`, `g`, `g'`.
    pub repeated_displacement: Expr,
    /// `q_2` by `g`, `g'`.
    pub repeated_velocity: Expr,
    /// `y'+`, the absorber's speed, by `B` and `T`.
    pub speed: Expr,
    /// `v_+ = x'+ / y'+`.
    pub velocity_after: Expr,
    /// `v_- = x'- / y'+`.
    pub velocity_before: Expr,
    /// `w'-`, the relative speed at which the wall is met, by `y'+`.
    pub impact_speed: Expr,
    /// `X`, the steady motion's displacement at the impact, by `B`.
    pub displacement: Expr,
    /// `X'`, its velocity.
    pub velocity: Expr,
    /// `A`.
    pub displacement_coefficient: Expr,
    /// `D`.
    pub velocity_coefficient: Expr,
    /// Steady motion when the base moves.
    pub steady_of_base: SteadyMotion,
    /// Steady motion when a force acts.
    pub steady_by_force: SteadyMotion,
    /// What vanishes at an orbit, in `beta`, `gamma`, `A`, `D`, `chi`.
    pub condition: Expr,
    /// Its coefficients by ascending powers of `beta`.
    pub by_ratio: [Expr; 3],
    /// `Delta`, a quarter of its discriminant.
    pub discriminant: Expr,
    /// `beta` of the two orbits, the smaller first, in `Delta`.
    pub ratios: [Expr; 2],
    /// `gamma^2` at which the orbit with `beta` exists.
    pub forcing_squared: Expr,
    /// `beta` of the saddle-node, where `gamma` is least.
    pub turning_ratio: Expr,
    /// `gamma` of the saddle-node.
    pub turning_forcing: Expr,
    /// `cos(phi)` in `X_s`, `X_c`, `X`, `X'`.
    pub phase_cosine: Expr,
    /// `sin(phi)`.
    pub phase_sine: Expr,
    /// By how much a flight gets longer if the gap at its end is wider by `dw`.
    pub flight_change: Expr,
}

impl SymmetricOrbits {
    /// Derives everything from the conditions.
    ///
    /// # Errors
    /// Never for the stated equations; a test runs it.
    pub fn derive(stated: &Stated) -> Result<Self, AlgebraError> {
        let conditions = OrbitConditions::new(stated);
        let position = conditions.amplitude.residual().solve_linear(x_0)?;
        let absorber = conditions.contact.residual().substitute(x_0, &position);
        let absorber = absorber.solve_linear(y_0)?;
        let flight = conditions.flight.residual().substitute(y_0, absorber);
        let speed = flight.solve_linear(YDotAfter)?;
        let [before, after] = velocities(&conditions)?;
        let over_speed = |velocity: &Expr| (velocity / YDotAfter).cancel();
        let approach = over_speed(&(&before - &conditions.arrival.right)) * YDotAfter;
        let [repeated_displacement, repeated_velocity] = repeated_impulse(&conditions)?;

        let [displacement, velocity] = steady_at_impact(&conditions)?;
        let impulse = conditions.momentum.residual().solve_linear(XDotBefore)?;
        let impulse = impulse.substitute(YDotBefore, &conditions.arrival.right);
        let of_amplitude = |steady: &Expr| {
            let by_speed = steady.substitute(XDotBefore, &impulse).expand();
            let by_speed = by_speed.substitute(XDotAfter, v_after * YDotAfter);
            by_speed.substitute(YDotAfter, &speed).substitute(x_0, &position)
        };
        let (displacement, velocity) = (of_amplitude(&displacement), of_amplitude(&velocity));
        let [_, by_displacement] = collected(&displacement, B)?;
        let [_, by_velocity] = collected(&velocity, B)?;

        let condition =
            in_clearances(&eliminate_angle(&(b - A * B), &(-D * B), &(gamma * chi * b)));
        let by_ratio: [Expr; 3] = collected(&condition, beta)?;
        let [constant, linear, quadratic] = &by_ratio;
        let discriminant = (fraction(1, 4) * linear.squared() - constant * quadratic).expand();
        let [unforced, _, forced]: [Expr; 3] = collected(&discriminant, gamma)?;
        let forced = (forced / chi.squared()).cancel() * gamma.squared() * chi.squared();
        let root = |sign: i32| (sign * sqrt(Delta) - fraction(1, 2) * linear) / quadratic;
        let forcing_squared = condition.solve_linear(gamma.squared())?;
        let turning_ratio = forcing_squared.differentiate(beta).solve_linear(beta)?.cancel();
        let least = (&forcing_squared * chi.squared()).substitute(beta, &turning_ratio).cancel();
        let [phase_sine, phase_cosine] = phase(&conditions)?;
        Ok(Self {
            velocity_after: over_speed(&after),
            velocity_before: over_speed(&before),
            impact_speed: approach,
            displacement_coefficient: by_mass_ratio(&-by_displacement)?,
            velocity_coefficient: by_mass_ratio(&(-by_velocity / Omega))?,
            steady_of_base: SteadyMotion::derive(&conditions, &stated.motion_of_base)?,
            steady_by_force: SteadyMotion::derive(&conditions, &stated.motion_by_force)?,
            discriminant: forced + unforced,
            ratios: [root(-1), root(1)],
            turning_forcing: sqrt(least) / chi,
            flight_change: conditions.saltation.residual().solve_linear(FlightChange)?,
            repeated_displacement,
            repeated_velocity,
            speed,
            displacement,
            velocity,
            condition,
            by_ratio,
            forcing_squared,
            turning_ratio,
            phase_cosine,
            phase_sine,
            conditions,
        })
    }
}

impl SteadyMotion {
    /// Harmonic balance of `motion`.
    fn derive(conditions: &OrbitConditions, motion: &Equation) -> Result<Self, AlgebraError> {
        let square = conditions.stiffness.residual().expand().solve_linear(Omega.squared())?;
        let damping = conditions.loss.residual().solve_linear(lambda)?;
        let turn = Omega * tau;
        let displacement = X_s * sin(turn.clone()) + X_c * cos(turn.clone());
        let velocity = displacement.differentiate(tau);
        let balance = motion
            .residual()
            .substitute(XDotDot, velocity.differentiate(tau))
            .substitute(XDot, velocity)
            .substitute(x, displacement)
            .expand();
        let part = |function: Expr| -> Result<Expr, AlgebraError> {
            let coefficients = balance.collect(function)?;
            let part = coefficients.get(1).cloned().unwrap_or(Expr::ZERO);
            Ok(part.substitute(lambda, &damping).substitute(Omega.squared(), &square).expand())
        };
        let (in_phase, across) = (part(sin(turn.clone()))?, part(cos(turn))?);
        let cosine = across.solve_linear(X_c)?;
        let sine = in_phase.substitute(X_c, &cosine).solve_linear(X_s)?.cancel();
        let cosine = cosine.substitute(X_s, &sine).cancel();
        let per_forcing = |part: &Expr| (part / (epsilon * G)).cancel();
        let [sine, cosine] = [per_forcing(&sine), per_forcing(&cosine)];
        let gain = epsilon * sqrt((sine.squared() + cosine.squared()).cancel());
        Ok(Self { gain, sine: epsilon * G * sine, cosine: epsilon * G * cosine })
    }
}

/// The same in ascending powers of the mass ratio.
fn by_mass_ratio(expression: &Expr) -> Result<Expr, AlgebraError> {
    let [light, heavy] = collected(&expression.expand(), epsilon)?;
    Ok(light + heavy * epsilon)
}

/// `x'-` and `x'+` by `y'+`, from the impact law.
fn velocities(conditions: &OrbitConditions) -> Result<[Expr; 2], AlgebraError> {
    let arrived =
        |equation: &Equation| equation.residual().substitute(YDotBefore, &conditions.arrival.right);
    let before = arrived(&conditions.momentum).solve_linear(XDotBefore)?;
    let restitution = arrived(&conditions.restitution).substitute(XDotBefore, &before);
    let after = restitution.expand().solve_linear(XDotAfter)?.cancel();
    Ok([before.substitute(XDotAfter, &after).cancel(), after])
}

/// `q_1` in `q_2`, and `q_2`. Written without multiplying out: near resonance `g` and `1 + g'` are
/// small, and so are the products.
fn repeated_impulse(conditions: &OrbitConditions) -> Result<[Expr; 2], AlgebraError> {
    let [first, second] = conditions.repetition.each_ref().map(Equation::residual);
    let displacement = first.solve_linear(q_1)?;
    let velocity = second.substitute(q_1, &displacement).solve_linear(q_2)?;
    Ok([displacement, velocity])
}

/// `X` and `X'` at an impact by `q_1`, `q_2`, the displacement and the velocities: the entries of
/// the propagator are eliminated with `(Phi + I) q = (0, 1)`.
fn steady_at_impact(conditions: &OrbitConditions) -> Result<[Expr; 2], AlgebraError> {
    let [first, second] = conditions.repetition.each_ref().map(Equation::residual);
    let rate = second.solve_linear(g_dot)?;
    let impulse = first.substitute(g_dot, &rate).solve_linear(g)?.cancel();
    let rate = rate.substitute(g, &impulse).cancel();
    let [first, second] = conditions
        .propagation
        .each_ref()
        .map(|equation| equation.residual().substitute(g, &impulse).substitute(g_dot, &rate));
    let displacement = first.numerator().solve_linear(SteadyDisplacement)?;
    let velocity = second.substitute(SteadyDisplacement, &displacement);
    let velocity = velocity.numerator().solve_linear(SteadyVelocity)?.cancel();
    Ok([displacement.substitute(SteadyVelocity, &velocity).cancel(), velocity])
}

/// `sin(phi)` and `cos(phi)` by the steady motion at the impact.
fn phase(conditions: &OrbitConditions) -> Result<[Expr; 2], AlgebraError> {
    let [first, second] = conditions.steady.each_ref().map(Equation::residual);
    let sine = first.solve_linear(sin(phi))?;
    let cosine = second.substitute(sin(phi), &sine).solve_linear(cos(phi))?.cancel();
    Ok([sine.substitute(cos(phi), &cosine).cancel(), cosine])
}
