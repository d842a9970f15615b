//! The price of the asymptotics over frequency: how far each boundary of the theory lies from the
//! exact one, below the map that shows both.

use crate::orbits::{Bifurcation, Boundaries};
use crate::report::figure::{Axis, Layer, MarkedPoint, Panel, Role, Rule};
use crate::report::numbers::signed_percent;
use crate::study::StudyError;
use crate::validation::asymptotic_error::errors_over_frequency;

use super::Scene;

/// The boundaries that are compared, as the map draws them.
const COMPARED: [(Bifurcation, Role, &str); 3] = [
    (Bifurcation::SymmetryBreaking, Role::SymmetryBreaking, "symmetry breaking"),
    (Bifurcation::NeimarkSacker, Role::Hopf, "Hopf"),
    (Bifurcation::SaddleNode, Role::SaddleNode, "saddle-node"),
];
/// Least height of the axis to either side of zero, per cent: less cannot be seen on the map.
const LEAST: f64 = 1.0;

/// Error of the theory's boundaries in per cent at the frequencies of `exact`, over the frequency
/// axis of the map; `None` where there is nothing to compare.
pub(super) fn panel(
    scene: &Scene,
    exact: &[Boundaries],
    x: Axis,
) -> Result<Option<Panel>, StudyError> {
    let analysis = &scene.study.analysis;
    let asymptotic_errors = errors_over_frequency(&analysis.system, &analysis.manifold, exact)?;
    let units = &scene.units;
    let (mut low, mut high) = (-LEAST, LEAST);
    let mut layers = vec![Layer::rule(Rule::Horizontal(0.0), Role::Guide.style())];
    for (kind, role, name) in COMPARED {
        let mut marks = Vec::new();
        let mut line = Vec::new();
        for (ratio, asymptotic_errors) in &asymptotic_errors {
            let counts = |price: &&crate::validation::AsymptoticError| {
                price.kind == kind && price.bounds_stability && price.difference.is_some()
            };
            let difference =
                asymptotic_errors.iter().find(counts).and_then(|price| price.difference);
            let at = [units.frequency(*ratio), 100.0 * difference.unwrap_or(f64::NAN)];
            line.push(at);
            let Some(difference) = difference else { continue };
            (low, high) = (low.min(at[1]), high.max(at[1]));
            let words = format!(
                "{} at {}: theory {} from exact",
                name,
                units.frequency_text(*ratio),
                signed_percent(difference)
            );
            marks.push(MarkedPoint::new(at[0], at[1]).with_tooltip(words));
        }
        if marks.is_empty() {
            continue;
        }
        layers.push(Layer::curve(role, line).labelled(name));
        layers.push(Layer::marked(role.marker().sized(4.0), role.color(), marks));
    }
    if layers.len() == 1 {
        return Ok(None);
    }
    let case = units.frequency(analysis.system.frequency_ratio());
    layers.insert(0, Layer::rule(Rule::Vertical(case), Role::Guide.style()));
    let y = Axis::linear("theory over exact − 1 (%)").with_range(1.2 * low, 1.2 * high);
    Ok(Some(Panel { layers, ..Panel::new(x, y) }))
}

/// What the panel says at the case's own frequency; `None` where no boundary has a counterpart.
pub(super) fn words(scene: &Scene) -> Option<String> {
    let say = |(kind, _, name): (Bifurcation, Role, &str)| {
        let mut bounds =
            scene.study.asymptotic_errors.iter().filter(|price| price.bounds_stability);
        let price = bounds.find(|price| price.kind == kind)?;
        Some(format!("{} for {name}", signed_percent(price.difference?)))
    };
    let said: Vec<String> = COMPARED.into_iter().filter_map(say).collect();
    (!said.is_empty()).then(|| {
        format!("Below, the theory's clearances against the exact ones: {} here.", said.join(", "))
    })
}
