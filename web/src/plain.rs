//! The first figures in words that need no theory: what the limits of the theory are called, how exact they are and what is
//! unstable is left to those who ask for it.

use vinesink::regimes::Regime;
use vinesink::report::figure::{Figure, Label};

/// Layers that stay, with what they are called here.
const NAMES: [(&str, &str); 9] = [
    ("without absorber", "without absorber"),
    ("tuned mass damper", "tuned mass damper of the same mass"),
    ("stable 1:1 (theory)", "two symmetric impacts (theory)"),
    ("Z4: no 1:1", "few impacts, or none"),
    ("Z3: steady 1:1", "two symmetric impacts per period"),
    ("Z2: asymmetric", "two asymmetric impacts"),
    ("Z1: more impacts", "more than two impacts"),
    ("A1", "depends on the start"),
    ("A2", "it beats"),
];

/// The figure so, where it is one of the first; before it has its words.
pub fn of(mut figure: Figure) -> Figure {
    if !["amplitude", "map"].contains(&figure.name.as_str()) {
        return figure;
    }
    if figure.name == "map" {
        (figure.layout, figure.size) = (None, Figure::new("", "").size);
        if let Some(facts) = &mut figure.facts {
            facts.template = "captions/map-plain";
        }
        figure.panels.truncate(1);
    }
    for panel in &mut figure.panels {
        panel.layers.retain_mut(|layer| match layer.label_mut() {
            Some(label) => renamed(label),
            // The case itself has no name of its own, and P1 is theory.
            None => layer.marks_case(),
        });
    }
    figure
}

/// Gives a layer its name here, if it has one.
fn renamed(label: &mut Label) -> bool {
    let regime = Regime::ALL.into_iter().find(|one| one.short() == label.text);
    let name = match regime {
        Some(regime) => Some(simulated(regime)),
        None => NAMES.iter().find(|(name, _)| *name == label.text).map(|(_, here)| *here),
    };
    name.inspect(|name| label.text = (*name).to_owned()).is_some()
}

const fn simulated(regime: Regime) -> &'static str {
    match regime {
        Regime::AboveTwo => "simulated: more impacts",
        Regime::TwoAsymmetric => "simulated: two asymmetric impacts",
        Regime::TwoSymmetric => "simulated: two symmetric impacts",
        Regime::StronglyModulated => "simulated: it beats",
        Regime::BelowTwo => "simulated: few impacts",
        Regime::AtRest => "simulated: no impacts",
    }
}
