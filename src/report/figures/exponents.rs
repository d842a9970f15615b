//! How the largest Lyapunov exponent of each motion converges, and what the exact orbit's
//! multipliers say of it.

use crate::regimes::Exponent;
use crate::report::figure::{
    Axis, Color, Dash, Figure, Fill, Hatch, Layer, Panel, Role, Rule, Style,
};
use crate::report::numbers::{capitalised, significant, with_error};
use crate::study::scenes::exponents;
use crate::study::{Proof, StudyError};

use super::{ATTRACTORS, Scene};

/// Window at whose ends the exponent is shown: from the shortest that has an error to one in which
/// the error of a chaotic motion has shrunk to some per cent.
const WINDOWS: std::ops::RangeInclusive<u32> = 4..=13;

/// One motion's exponents, by length of the window.
struct Shown {
    name: String,
    exponents: Vec<Exponent>,
    exact: Option<f64>,
    color: Color,
}

pub(super) fn figure(scene: &Scene) -> Result<Option<Figure>, StudyError> {
    let system = &scene.study.analysis.system;
    let periods: Vec<u64> = WINDOWS.map(|power| 1 << power).collect();
    let colors = [Color::Blue, Color::Vermillion, Color::BluishGreen];
    let mut shown = Vec::new();
    for index in 0..scene.study.attractors.len().min(ATTRACTORS) {
        let Some(found) = scene.drawn(index) else { continue };
        let exponents = exponents(system, found.attractor.state, &periods)?;
        let exact = scene.study.proofs[index].as_ref().map(exact);
        let name = format!(
            "{}, {}",
            found.regime().words(),
            found.attractor.classification.dynamics.words()
        );
        let color = colors[shown.len()];
        if !exponents.is_empty() {
            shown.push(Shown { name, exponents, exact, color });
        }
    }
    if shown.is_empty() {
        return Ok(None);
    }
    let x = Axis::log("window in excitation periods (1)")
        .with_range(f64::from(1_u32 << WINDOWS.start()), f64::from(1_u32 << WINDOWS.end()));
    let y = Axis::linear("largest Lyapunov exponent per period (1)");
    let mut panel = Panel::new(x, y).with(Layer::rule(Rule::Horizontal(0.0), Role::Guide.style()));
    for one in &shown {
        panel.layers.extend(layers(one));
    }
    let (caption, alt) = words(&shown);
    Ok(Some(
        Figure::new("exponents", "Convergence of the largest Lyapunov exponent")
            .with_panel(panel)
            .with_words(caption, alt),
    ))
}

/// Growth per period that the orbit's largest multiplier stands for.
fn exact(proof: &Proof) -> f64 {
    libm::log(proof.orbit.radius_per_period())
}

fn layers(one: &Shown) -> Vec<Layer> {
    let at = |value: fn(&Exponent) -> f64| -> Vec<[f64; 2]> {
        one.exponents.iter().map(|found| [found.periods as f64, value(found)]).collect()
    };
    let fill = Fill { color: one.color, opacity: 0.15, hatch: Hatch::None };
    let style = Style::new(one.color, 1.8, Dash::Solid);
    let mut layers = vec![
        Layer::between(&at(|found| found.interval[0]), &at(|found| found.interval[1]), fill),
        Layer::styled(style, at(|found| found.per_period)).labelled(one.name.clone()),
    ];
    if let Some(exact) = one.exact {
        let style = Role::ExactOrbit.style();
        let style = Style { dash: Dash::Dashed, ..style };
        layers.push(
            Layer::rule(Rule::Horizontal(exact), style).labelled("logarithm of the multiplier"),
        );
    }
    layers
}

fn words(shown: &[Shown]) -> (String, String) {
    let say = |one: &Shown| {
        let Some(last) = one.exponents.last() else { return one.name.clone() };
        let exact = match one.exact {
            Some(exact) => format!(" (exact orbit: {})", significant(exact, 3)),
            None => String::new(),
        };
        format!(
            "{}: {} per period after {} periods{exact}",
            one.name,
            with_error(last.per_period, 2.0 * last.standard_error),
            last.periods
        )
    };
    let all: Vec<String> = shown.iter().map(say).collect();
    let caption = format!("{}. Bands are 95 % intervals.", capitalised(&all.join("; ")));
    let alt = format!(
        "Largest Lyapunov exponent over the length of the window, one line and band for each motion. {caption}"
    );
    (caption, alt)
}
