//! Claims about the motions of the case itself.

use super::boundaries::{BoundaryAt, clearances};
use super::tolerance::{asymptotic, exact};
use super::{Claim, Measure, Verdict};
use crate::analysis::motion::read_off;
use crate::analysis::{Analysis, Area, FixedPoint, Strip};
use crate::method::Method;
use crate::orbits::{FullSystem, Measures, SymmetricOrbit};
use crate::regimes::{Attractor, DynamicsKind, FoundAttractor, Regime, Window};
use crate::simulation::StartError;

/// For each fixed point: stable or not, and if an exact orbit is near it: amplitudes and phases.
pub fn fixed_points(analysis: &Analysis, exact: &FullSystem) -> Vec<Claim> {
    let mut claims = Vec::new();
    // The exact orbits are written with the steady motion between impacts.
    let unsolved = analysis.system.linear_response().is_none();
    for (index, point) in analysis.fixed_points.iter().enumerate() {
        let number = index + 1;
        let orbit = counterpart(analysis, exact, point);
        let observed = match orbit {
            Some(orbit) => {
                let radius = orbit.orbit.multipliers.spectral_radius();
                let stable = if orbit.orbit.attracts() { "stable" } else { "unstable" };
                format!("{stable}, largest multiplier {radius:.3}")
            }
            None if unsolved => "an undamped resonance has no exact orbit to compare".into(),
            None => "no orbit near it".into(),
        };
        let attracts = orbit.is_some_and(|orbit| orbit.orbit.attracts());
        let predicted = if point.stable { "stable" } else { "unstable" };
        let mut claim = Claim::of_outcome(
            [
                format!("fixed-point-{number}-stability"),
                format!(
                    "fixed point {number} (B/b = {:.3}) is {predicted}",
                    point.absorber_amplitude
                ),
            ],
            "manifold and slow flow (18)",
            [predicted.into(), observed],
            Method::ExactOrbit,
            "multipliers of the exact orbit nearest to the point, within twice ε (2 + |σ| + λ) or, next to a \
             saddle-node, its root",
            orbit.is_some() && attracts == point.stable,
        );
        if unsolved {
            claim.verdict = Verdict::Undecided;
        }
        claims.push(claim);
        claims
            .extend(orbit.into_iter().flat_map(|orbit| amplitudes(analysis, point, orbit, number)));
    }
    claims
}

/// The exact orbit that a fixed point stands for: the nearest in the absorber's amplitude, if no
/// other fixed point is nearer to it. Next to a saddle-node two points move apart with the root of
/// the distance from it, and so does their error.
fn counterpart<'a>(
    analysis: &Analysis,
    exact: &'a FullSystem,
    point: &FixedPoint,
) -> Option<&'a SymmetricOrbit> {
    let distance = |orbit: &SymmetricOrbit, point: &FixedPoint| {
        (orbit.absorber_amplitude / point.absorber_amplitude - 1.0).abs()
    };
    let nearest =
        exact.orbits.iter().min_by(|a, b| distance(a, point).total_cmp(&distance(b, point)))?;
    let mine = distance(nearest, point);
    let error = asymptotic(&analysis.system).value;
    let others = analysis.fixed_points.iter();
    let nearer = others.filter(|other| distance(nearest, other) < mine).count();
    (nearer == 0 && mine < (2.0 * error).max(error.sqrt())).then_some(nearest)
}

fn amplitudes(
    analysis: &Analysis,
    point: &FixedPoint,
    orbit: &SymmetricOrbit,
    number: usize,
) -> Vec<Claim> {
    let Ok(measures) = Measures::of(&analysis.system, &orbit.orbit.cycle) else {
        return Vec::new();
    };
    let observed =
        read_off(&analysis.system, measures.oscillator_harmonic, measures.absorber_harmonic);
    let tolerance = asymptotic(&analysis.system);
    let compare = |id: &str, statement: &str, source, predicted: f64, observed: f64, measure| {
        Claim::of_number(
            [format!("fixed-point-{number}-{id}"), format!("{statement} at fixed point {number}")],
            source,
            [predicted, observed],
            measure,
            Method::ExactOrbit,
            tolerance.clone(),
        )
    };
    let length = Measure::LengthOverClearance;
    let (c, b) = (point.oscillator_amplitude, point.absorber_amplitude);
    let angle = Measure::Angle;
    vec![
        compare("C", "amplitude C", "slow flow (18)", c, observed.oscillator_amplitude, length),
        compare("B", "amplitude B", "manifold (16)", b, observed.absorber_amplitude, length),
        compare("eta", "phase η", "slow flow (18)", point.eta, observed.eta, angle),
        compare(
            "Theta",
            "phase Θ",
            "manifold (14), (15)",
            point.absorber_phase,
            observed.absorber_phase,
            angle,
        ),
    ]
}

/// Rest is a motion of the full system exactly where the bare oscillator's amplitude is below the
/// clearance.
pub fn rest(analysis: &Analysis, window: &Window) -> Result<Option<Claim>, StartError> {
    let system = &analysis.system;
    let Some(linear) = system.linear_response() else {
        return Ok(None);
    };
    // A larger oscillation hits an absorber that rests in the middle; without excitation there is
    // no oscillation to compare.
    if linear.amplitude() >= 1.0 || linear.amplitude() == 0.0 {
        return Ok(None);
    }
    let reached = Attractor::reach(system, linear.state(system), window)?;
    let rests = reached.classification.regime == Regime::AtRest;
    let claim = Claim::of_number(
        ["rest".into(), "absorber at rest, oscillator vibrates as if alone".into()],
        "equation of motion (1)",
        [linear.amplitude(), reached.peak],
        Measure::LengthOverClearance,
        Method::Simulation,
        exact(),
    );
    let verdict = if rests { claim.verdict } else { Verdict::Refuted };
    Ok(Some(Claim { verdict, ..claim }))
}

/// What area and strip say of the attractors found. Beside a motion that repeats a chaotic one may be a
/// transient, and whether a start's is over by the end of the time that it is watched is chance, which
/// the rounding of the last digit decides: what follows from such starts alone is undecided.
pub fn area(analysis: &Analysis, attractors: &[FoundAttractor]) -> Option<Claim> {
    let moving = attractors.iter().filter(|found| found.regime() != Regime::AtRest);
    let (steady, others): (Vec<_>, Vec<_>) =
        moving.partition(|found| found.regime() == Regime::TwoSymmetric);
    let modulated = others.iter().any(|found| found.regime() == Regime::StronglyModulated);
    let stays = |found: &&FoundAttractor| {
        let dynamics = found.attractor.classification.dynamics;
        matches!(dynamics, DynamicsKind::Periodic { .. } | DynamicsKind::QuasiPeriodic)
    };
    let beside = !others.is_empty();
    let may_end = beside && !others.iter().any(stays);
    let ended = steady.iter().any(|found| found.late_starts > 0);
    let steady = !steady.is_empty();
    // What holds, and whether chance could have it otherwise.
    let (area, predicted, holds, by_chance) = match (analysis.zone.area?, analysis.zone.strip) {
        (Area::Z3, None) => {
            let by_chance = steady && (may_end || ended && !beside);
            ("Z3", "steady 1:1 resonance only", steady && !beside, by_chance)
        }
        (Area::Z3, Some(Strip::A1)) => {
            let predicted = "steady 1:1 beside a modulated response";
            ("Z3, strip A1", predicted, steady && beside, ended && !beside)
        }
        (Area::Z3, Some(Strip::A2)) => {
            ("Z3, strip A2", "strongly modulated response", modulated && !steady, false)
        }
        (Area::Z4, _) => ("Z4", "no steady 1:1 resonance", !steady && beside, false),
        _ => return None,
    };
    let mut reason = near_boundary(analysis);
    if by_chance {
        reason += "; a chaotic motion beside a steady one may be a transient, and how many starts are \
                   still on it when watching ends depends on rounding";
    }
    let claim = Claim::of_outcome(
        ["area".into(), format!("the case lies in area {area}")],
        "fixed points and boundaries",
        [predicted.into(), listed(attractors)],
        Method::Simulation,
        reason,
        holds,
    );
    let open = by_chance || !steady && !beside;
    let verdict = if open { Verdict::Undecided } else { claim.verdict };
    Some(Claim { verdict, ..claim })
}

/// An area is only as certain as the boundary next to it.
fn near_boundary(analysis: &Analysis) -> String {
    let error = asymptotic(&analysis.system).value;
    let distance = |at: &BoundaryAt| (at.clearance - 1.0).abs();
    let nearest =
        clearances(analysis).into_iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
    match nearest {
        Some(at) if distance(&at) < error => format!(
            "share of all starts; the {} boundary is {:.1} % away, within the theory's error of {:.1} %",
            at.kind.words_in_slow_flow(),
            100.0 * distance(&at),
            100.0 * error
        ),
        _ => "share of all starts".into(),
    }
}

fn listed(attractors: &[FoundAttractor]) -> String {
    let words: Vec<String> = attractors
        .iter()
        .map(|found| format!("{} {:.0} %", found.regime().short(), 100.0 * found.share))
        .collect();
    words.join(", ")
}
