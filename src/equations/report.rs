//! The equations in the order in which a reader meets them, with what each one gives.

use super::Equations;
use crate::symbolic::Symbol::{
    AbsorberPhase as Theta, AmplitudeRatio as beta, CollisionForcing, Detuning as sigma,
    Discriminant as Delta, ExcitationPhase as eta, ForcingPerClearance as gamma,
    ManifoldSquare as c_2, RatioRate,
};
use crate::symbolic::{Equation, Expr, Values, cos, format_number, sin, sqrt};
use crate::system::Excitation;

/// The motion whose numbers belong into an equation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Motion {
    /// A fixed point of the slow flow: first order in the mass ratio.
    FixedPoint,
    /// An exact symmetric orbit; amplitudes have the same symbols and other values.
    SymmetricOrbit,
}

/// An equation with its explanation.
#[derive(Debug, Clone, PartialEq)]
pub struct ReportEquation {
    /// The number in the paper, if it has one.
    pub number: Option<&'static str>,
    /// A title.
    pub title: &'static str,
    /// What it is for.
    pub gives: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// The motion that its amplitudes are of.
    pub motion: Motion,
    /// The kind of excitation that it is for, if not for all.
    pub only: Option<Excitation>,
    /// The left side, in LaTeX.
    pub left: String,
    /// The left side where it is more than a name, so that numbers can be put in.
    pub left_expression: Option<Expr>,
    /// The right side: the very expression that is evaluated.
    pub right: Expr,
}

impl ReportEquation {
    /// The general formula.
    pub fn to_latex(&self) -> String {
        format!("{} = {}", self.left, self.right.to_latex())
    }

    /// The formula with a case's numbers, and the value if all symbols have one.
    pub fn to_latex_with(&self, values: &Values, digits: usize) -> String {
        let formula = self.right.to_latex_with(values, digits);
        let left = match &self.left_expression {
            Some(left) => left.to_latex_with(values, digits),
            None => self.left.clone(),
        };
        match self.right.evaluate(values) {
            Ok(value) if !matches!(self.right, Expr::Number(_)) => {
                let value = format_number(value, digits);
                if value == formula {
                    format!("{left} = {value}")
                } else {
                    format!("{left} = {formula} = {value}")
                }
            }
            _ => format!("{left} = {formula}"),
        }
    }
}

const DERIVED: &str = "derived here";

pub(super) fn stated(equation: &Equation, gives: &'static str) -> ReportEquation {
    ReportEquation {
        number: equation.number,
        title: equation.name,
        gives,
        source: equation.source,
        motion: Motion::FixedPoint,
        only: None,
        left: equation.left.to_latex(),
        left_expression: (!matches!(equation.left, Expr::Symbol(_))).then(|| equation.left.clone()),
        right: equation.right.clone(),
    }
}

pub(super) fn derived(
    title: &'static str,
    gives: &'static str,
    left: impl Into<String>,
    right: &Expr,
) -> ReportEquation {
    let (left, right) = (left.into(), right.clone());
    ReportEquation {
        number: None,
        title,
        gives,
        source: DERIVED,
        motion: Motion::FixedPoint,
        only: None,
        left,
        left_expression: None,
        right,
    }
}

fn by_powers<const N: usize>(
    title: &'static str,
    gives: &'static str,
    name: &str,
    coefficients: &[Expr; N],
) -> Vec<ReportEquation> {
    let one = |(power, right)| derived(title, gives, format!("{name}_{{{power}}}"), right);
    coefficients.iter().enumerate().map(one).collect()
}

pub(super) fn latex(expression: impl Into<Expr>) -> String {
    expression.into().to_latex()
}

impl Equations {
    /// All equations in reading order: what is assumed, the manifold, the fixed points, the
    /// boundaries, the slow flow, the exact symmetric orbits.
    pub fn for_report(&self) -> Vec<ReportEquation> {
        [
            self.assumptions(),
            self.manifold(),
            self.fixed_points(),
            self.boundaries(),
            self.flow(),
            self.symmetric_orbits(),
        ]
        .concat()
    }

    fn assumptions(&self) -> Vec<ReportEquation> {
        let s = &self.stated;
        vec![
            ReportEquation {
                only: Some(Excitation::BaseDisplacement),
                ..stated(&s.motion_of_base, "the motion that is simulated when the base moves")
            },
            ReportEquation {
                only: Some(Excitation::Force),
                ..stated(&s.motion_by_force, "the motion that is simulated when a force acts")
            },
            stated(&s.absorber_motion, "a straight line between impacts"),
            stated(&s.restitution, "the velocity after an impact"),
            stated(&s.reduced_forcing, "the size of the excitation"),
            stated(&s.detuning, "how far the excitation is from resonance"),
            stated(&s.forcing_per_clearance, "the one measure of excitation against clearance"),
            stated(&s.restitution_ratio, "the loss at an impact"),
            stated(&s.curvature, "the shape of the manifold"),
            stated(&s.impact_position, "one relation of the amplitudes at an impact"),
            stated(&s.impact_velocity, "the other relation of the amplitudes at an impact"),
            stated(&s.first_harmonic, "the absorber's action on the oscillator"),
            stated(&s.amplitude_rate, "growth or decay of the oscillator's motion"),
            stated(&s.phase_rate, "drift of the phase against the excitation"),
            stated(&s.trace, "stability of the impacts at order 0"),
            stated(&s.determinant, "stability of the impacts at order 0"),
        ]
    }

    fn manifold(&self) -> Vec<ReportEquation> {
        let m = &self.manifold;
        let square = self.stated.manifold.left.to_latex();
        vec![
            ReportEquation {
                number: self.stated.manifold.number,
                source: "derived here from (14) and (15); paper (16)",
                ..derived(
                    "Slow invariant manifold",
                    "every motion with two symmetric impacts per cycle",
                    square,
                    &m.square_by_powers,
                )
            },
            derived("Fold", "where the manifold's stable branch begins", "B", &m.fold_amplitude),
            derived(
                "Fold",
                "the smallest amplitude that sustains impacts",
                "C",
                &m.fold_oscillator,
            ),
            derived(
                "Symmetry breaking",
                "where the stable branch ends: a multiplier is -1",
                latex(beta),
                &m.breaking_ratio,
            ),
            derived(
                "Manifold over the clearance",
                "the form that is evaluated",
                latex(c_2),
                &m.shifted_square,
            ),
            stated(&self.stated.shift, "a small difference that the formulas keep exact"),
        ]
    }

    fn fixed_points(&self) -> Vec<ReportEquation> {
        let f = &self.fixed_points;
        let side = |function: Expr| latex(gamma * sqrt(c_2) * function);
        let turned = |function: &str| {
            format!(r"{} \{function} \left({} - {}\right)", latex(gamma), latex(eta), latex(Theta))
        };
        let mut list = vec![
            derived("Fixed point", "the phase of a fixed point", side(sin(eta)), &f.sine),
            derived("Fixed point", "the phase of a fixed point", side(cos(eta)), &f.cosine),
            derived(
                "Fixed point, in the absorber's phase",
                "linear in the amplitude",
                turned("cos"),
                &f.along,
            ),
            derived(
                "Fixed point, in the absorber's phase",
                "linear in the amplitude",
                turned("sin"),
                &f.across,
            ),
            derived(
                "Forcing of a fixed point",
                "which excitation holds an amplitude",
                latex(gamma.squared()),
                &f.forcing_squared,
            ),
        ];
        let title = "Quadratic of the fixed points";
        list.extend(by_powers(
            title,
            "coefficients of powers of the amplitude in the squared forcing",
            "p",
            &f.quadratic,
        ));
        list.extend([
            derived(
                "Saddle-node",
                "the forcing per clearance below which there is no fixed point",
                latex(CollisionForcing),
                &f.collision_forcing,
            ),
            derived(
                "Saddle-node",
                "the amplitude at which the two fixed points meet",
                format!(r"{}_{{\mathrm{{SN}}}}", latex(beta)),
                &f.collision_ratio,
            ),
            derived(
                "Number of fixed points",
                "two where it is above 0, none below: it is the distance from the saddle-node",
                latex(Delta),
                &f.discriminant,
            ),
        ]);
        let ratio = |k: usize| format!("{}_{{{k}}}", latex(beta));
        let [smaller, larger] = &f.ratios;
        let ratios =
            [(ratio(1), smaller), (ratio(2), larger), (ratio(1) + " " + &ratio(2), &f.product)];
        let gives = "the one further from 0 is evaluated as a sum, the other from the product";
        list.extend(ratios.map(|(left, right)| derived("Fixed points", gives, left, right)));
        list.extend(by_powers(
            "Saddle-node over the detuning",
            "coefficients of powers of the detuning: its roots are where two fixed points meet at this forcing",
            "s",
            &f.collision_by_detuning,
        ));
        list.extend(by_powers(
            "Frequency response",
            "coefficients of powers of the detuning at a given amplitude",
            "f",
            &f.by_detuning,
        ));
        list
    }

    fn boundaries(&self) -> Vec<ReportEquation> {
        let b = &self.boundaries;
        let named = |index: &str| format!("{}_{{{index}}}^{{2}}", latex(gamma));
        vec![
            derived(
                "Hopf boundary",
                "forcing per clearance with which a fixed point reaches the fold",
                named("H"),
                &b.hopf_squared,
            ),
            derived(
                "Symmetry-breaking boundary",
                "forcing per clearance with which a fixed point reaches symmetry breaking",
                named("c"),
                &b.breaking_squared,
            ),
            derived(
                "Meeting point P1",
                "the detuning at which the saddle-node boundary reaches the Hopf boundary",
                format!(r"{}_{{P1}}", latex(sigma)),
                &b.meeting_detuning,
            ),
        ]
    }

    fn flow(&self) -> Vec<ReportEquation> {
        let f = &self.slow_flow;
        let title = "Stability of a fixed point";
        vec![
            derived("Slow flow", "the amplitude's rate", latex(RatioRate), &f.ratio_rate),
            derived(
                "Slow flow",
                "the phase's rate",
                self.stated.phase_rate.left.to_latex(),
                &f.phase_rate,
            ),
            derived(title, "trace of the slow flow's Jacobian", r"\mathrm{tr} J", &f.trace),
            derived(
                title,
                "its determinant at the larger fixed point; at the smaller one the sign is the other",
                r"\det J",
                &f.determinant,
            ),
        ]
    }
}
