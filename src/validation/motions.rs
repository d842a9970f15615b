//! Claims about the motions of the case itself.

use super::boundaries::{BoundaryAt, clearances};
use super::tolerance::{asymptotic, exact, outcome};
use super::{Claim, Finding, Measure, Verdict};
use crate::analysis::motion::{read_off, state_of, wrapped};
use crate::analysis::{Analysis, Area, FixedPoint, Strip};
use crate::regimes::attractor::Effort;
use crate::regimes::{Attractor, FoundAttractor, Regime};
use crate::simulation::StartError;

/// For each fixed point: stable or not; for a stable one: amplitudes and phases.
pub fn fixed_points(analysis: &Analysis, effort: &Effort) -> Result<Vec<Claim>, StartError> {
    let mut claims = Vec::new();
    for (index, point) in analysis.fixed_points.iter().enumerate() {
        let start = state_of(point, &analysis.system);
        let reached = Attractor::reach(&analysis.system, start, effort)?;
        let name = format!("fixed point {} (B/b = {:.3})", index + 1, point.absorber);
        let stays = stays(analysis, point, &reached);
        claims.push(Claim {
            id: format!("fixed-point-{}-stability", index + 1),
            statement: format!("{name} is {}", if point.stable { "stable" } else { "unstable" }),
            source: "manifold and slow flow (18)",
            predicted: Finding::Words(if point.stable { "stays" } else { "leaves" }.into()),
            observed: Finding::Words(if stays {
                "stays".into()
            } else {
                format!("leaves for {}", reached.classification.regime.short())
            }),
            difference: None,
            tolerance: outcome("a start on the point stays near it, or leaves it"),
            verdict: Verdict::of(stays == point.stable),
        });
        if point.stable && stays {
            claims.extend(amplitudes(analysis, point, &reached, index + 1));
        }
    }
    Ok(claims)
}

/// A motion stays if it ends in two symmetric impacts per period with this point's amplitude, to
/// twice the expected error of the theory, and no other fixed point is nearer: two that are about
/// to collide lie within that error of each other.
fn stays(analysis: &Analysis, point: &FixedPoint, reached: &Attractor) -> bool {
    let observed =
        read_off(&analysis.system, reached.oscillator_harmonic, reached.absorber_harmonic);
    let relative = observed.absorber / point.absorber - 1.0;
    reached.classification.regime == Regime::TwoSymmetric
        && relative.abs() < 2.0 * asymptotic(&analysis.system).value
        && analysis.fixed_points.iter().all(|other| {
            (observed.absorber - other.absorber).abs() >= (observed.absorber - point.absorber).abs()
        })
}

fn amplitudes(
    analysis: &Analysis,
    point: &FixedPoint,
    reached: &Attractor,
    number: usize,
) -> Vec<Claim> {
    let observed =
        read_off(&analysis.system, reached.oscillator_harmonic, reached.absorber_harmonic);
    let tolerance = asymptotic(&analysis.system);
    let compare = |id: &str, statement: &str, source, predicted: f64, observed: f64, measure| {
        let difference = match measure {
            Measure::Angle => wrapped(observed - predicted),
            Measure::LengthOverClearance => observed / predicted - 1.0,
        };
        Claim {
            id: format!("fixed-point-{number}-{id}"),
            statement: format!("{statement} at fixed point {number}"),
            source,
            predicted: Finding::Number(predicted, measure),
            observed: Finding::Number(observed, measure),
            difference: Some(difference),
            tolerance: tolerance.clone(),
            verdict: Verdict::of(difference.abs() <= tolerance.value),
        }
    };
    let length = Measure::LengthOverClearance;
    vec![
        compare(
            "C",
            "amplitude C",
            "slow flow (18)",
            point.oscillator,
            observed.oscillator,
            length,
        ),
        compare("B", "amplitude B", "manifold (16)", point.absorber, observed.absorber, length),
        compare("eta", "phase η", "slow flow (18)", point.eta, observed.eta, Measure::Angle),
        compare(
            "Theta",
            "phase Θ",
            "manifold (14), (15)",
            point.absorber_phase,
            observed.absorber_phase,
            Measure::Angle,
        ),
    ]
}

/// Rest is a motion of the full system exactly where the bare oscillator's amplitude is below the
/// clearance.
pub fn rest(analysis: &Analysis, effort: &Effort) -> Result<Option<Claim>, StartError> {
    let system = &analysis.system;
    let Some(linear) = system.linear_response() else {
        return Ok(None);
    };
    // A larger oscillation hits an absorber that rests in the middle; without excitation there is
    // no oscillation to compare.
    if linear.amplitude() >= 1.0 || linear.amplitude() == 0.0 {
        return Ok(None);
    }
    let reached = Attractor::reach(system, linear.state(system), effort)?;
    let rests = reached.classification.regime == Regime::AtRest;
    let difference = reached.peak / linear.amplitude() - 1.0;
    let tolerance = exact();
    let verdict = Verdict::of(rests && difference.abs() < tolerance.value);
    Ok(Some(Claim {
        id: "rest".into(),
        statement: "absorber at rest, oscillator vibrates as if alone".into(),
        source: "equation of motion (1)",
        predicted: Finding::Number(linear.amplitude(), Measure::LengthOverClearance),
        observed: Finding::Number(reached.peak, Measure::LengthOverClearance),
        difference: Some(difference),
        tolerance,
        verdict,
    }))
}

/// What area and strip say of the attractors found.
pub fn area(analysis: &Analysis, attractors: &[FoundAttractor]) -> Option<Claim> {
    let moving = |regime: Regime| regime != Regime::AtRest;
    let found: Vec<Regime> = attractors
        .iter()
        .map(|found| found.attractor.classification.regime)
        .filter(|regime| moving(*regime))
        .collect();
    let steady = found.contains(&Regime::TwoSymmetric);
    let beside = found.iter().any(|regime| *regime != Regime::TwoSymmetric);
    let modulated = found.contains(&Regime::StronglyModulated);
    let (area, predicted, holds) = match (analysis.zone.area?, analysis.zone.strip) {
        (Area::Z3, None) => ("Z3", "steady 1:1 resonance only", steady && !beside),
        (Area::Z3, Some(Strip::A1)) => {
            ("Z3, strip A1", "steady 1:1 beside a modulated response", steady && beside)
        }
        (Area::Z3, Some(Strip::A2)) => {
            ("Z3, strip A2", "strongly modulated response", modulated && !steady)
        }
        (Area::Z4, _) => ("Z4", "no steady 1:1 resonance", !steady && !found.is_empty()),
        _ => return None,
    };
    Some(Claim {
        id: "area".into(),
        statement: format!("the case lies in area {area}"),
        source: "fixed points and boundaries",
        predicted: Finding::Words(predicted.into()),
        observed: Finding::Words(listed(attractors)),
        difference: None,
        tolerance: outcome(near_boundary(analysis)),
        verdict: if found.is_empty() { Verdict::Undecided } else { Verdict::of(holds) },
    })
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
            at.kind.words(),
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
