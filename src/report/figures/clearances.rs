//! What simulation finds at many clearances: where on the manifold (Fig. 11g), and how much the
//! oscillator vibrates (the claims of section 3.1 and of the red cross in Fig. 6c).

use crate::regimes::Regime;
use crate::report::figure::{Axis, Color, Figure, Layer, Layout, MarkedPoint, Panel, Role, Rule};
use crate::report::numbers::{decibels, significant};
use crate::study::StudyError;
use crate::study::scenes::{WalkPoint, walk};
use crate::validation::tolerance::has_resonance;

use super::Scene;
use super::amplitude::KINDS;
use super::manifold::branches;

/// Clearances, evenly spread in their logarithm ...
const COUNT: u32 = 36;
/// ... from this many times that of symmetry breaking to this many times the last boundary.
const FIRST: f64 = 0.1;
const BEYOND: f64 = 1.35;
/// The axis of `B/b` begins at the smallest one, but not below this.
const LEAST: f64 = 0.02;

pub(super) fn figure(scene: &Scene) -> Result<Option<Figure>, StudyError> {
    let analysis = &scene.study.analysis;
    let (system, boundaries) = (&analysis.system, &analysis.boundaries);
    let gamma = system.forcing_per_clearance();
    if gamma == 0.0 || !has_resonance(system) {
        return Ok(None);
    }
    let breaking = gamma / boundaries.symmetry_breaking;
    let hopf = gamma / boundaries.hopf;
    let last = scene.study.margins.clearance.iter().map(|at| at.factor).fold(hopf, f64::max);
    let (from, to) = (libm::log(FIRST * breaking), libm::log(BEYOND * last));
    let mut clearances: Vec<f64> = (0..COUNT)
        .map(|k| libm::exp(from + (to - from) * f64::from(k) / f64::from(COUNT - 1)))
        .chain([1.0])
        .collect();
    clearances.sort_by(f64::total_cmp);
    let found = walk(system, &clearances)?;
    let bare = system.linear_response().map(|bare| bare.amplitude());
    let first = on_manifold(scene, &found);
    let second = peaks(scene, &found, bare, [breaking, hopf, last]);
    let (caption, alt) = words(scene, &found, bare, hopf);
    Ok(Some(
        Figure::new("clearances", "Regimes and vibration at many clearances, simulated")
            .with_size(860, 470)
            .with_layout(Layout::columns(&[1.0, 1.0]))
            .with_panel(first)
            .with_panel(second)
            .with_words(caption, alt),
    ))
}

/// Points by regime, with the same markers as over frequency.
fn marks(
    scene: &Scene,
    found: &[WalkPoint],
    named: bool,
    place: &dyn Fn(&WalkPoint) -> [f64; 2],
) -> Vec<Layer> {
    let units = &scene.units;
    let layer = |(name, marker, regimes): (&str, _, &[Regime])| {
        let chosen = found.iter().filter(|point| regimes.contains(&point.regime));
        let points: Vec<MarkedPoint> = chosen
            .map(|point| {
                let words = format!(
                    "simulated at b = {}: peak {}, {}",
                    units.length_text(point.clearance),
                    units.length_text(point.peak),
                    point.regime.words()
                );
                MarkedPoint::from(place(point)).with_tooltip(words)
            })
            .collect();
        let layer = Layer::marked(marker, Role::Simulation.color(), points.clone());
        let layer = if named { layer.labelled(name) } else { layer };
        (!points.is_empty()).then_some(layer)
    };
    KINDS.into_iter().filter_map(layer).collect()
}

fn on_manifold(scene: &Scene, found: &[WalkPoint]) -> Panel {
    let manifold = &scene.study.analysis.manifold;
    let farthest = found.iter().map(|point| point.amplitudes[0]).fold(2.0, f64::max);
    let highest = found.iter().map(|point| point.amplitudes[1]).fold(1.0, f64::max);
    let lowest = manifold.fold.oscillator_amplitude.max(0.02);
    let nearest = found.iter().map(|point| point.amplitudes[0]).fold(0.4, f64::min).max(LEAST);
    let [left, right, stable] = branches(manifold, 1.4 * farthest);
    let mut panel = Panel::new(
        Axis::log("absorber amplitude B/b (1)").with_range(0.7 * nearest, 1.4 * farthest),
        Axis::log("oscillator amplitude C/b (1)").with_range(0.7 * lowest, 1.4 * highest),
    )
    .with_heading("on the manifold");
    panel.layers.extend([left, right, stable]);
    panel.layers.extend(marks(scene, found, false, &|point| point.amplitudes));
    // The case and the ends of the walk say which way the clearance grows.
    let ends = [found.first(), found.last()].into_iter().flatten().map(|point| {
        let [x, y] = point.amplitudes;
        MarkedPoint::new(x, y)
            .with_label(format!("b = {}", scene.units.length_text(point.clearance)))
    });
    panel = panel.with(Layer::marked(Role::Guide.marker().sized(3.0), Color::Black, ends));
    if let Some(here) = found.iter().find(|point| point.clearance == 1.0) {
        panel = panel.with(Layer::this_case(here.amplitudes, None));
    }
    panel
}

fn peaks(
    scene: &Scene,
    found: &[WalkPoint],
    bare: Option<f64>,
    [breaking, hopf, last]: [f64; 3],
) -> Panel {
    let units = &scene.units;
    let highest = found.iter().map(|point| point.peak).chain(bare).fold(0.0, f64::max);
    let ends = [found.first(), found.last()].map(|at| at.map_or(1.0, |at| at.clearance));
    let x = Axis::log(units.length_axis("clearance b"))
        .with_range(units.length(0.9 * ends[0]), units.length(1.15 * ends[1]));
    let y =
        Axis::linear(units.length_axis("peak of x")).with_range(0.0, units.length(1.15 * highest));
    let rule = |at: f64, role: Role, name: &str| {
        Layer::rule(Rule::Vertical(units.length(at)), role.style()).labelled(name)
    };
    let mut panel = Panel::new(x, y)
        .with_heading("peak displacement")
        .with(rule(breaking, Role::SymmetryBreaking, "breaking"))
        .with(rule(hopf, Role::Hopf, "Hopf"));
    if last > 1.02 * hopf {
        panel = panel.with(rule(last, Role::SaddleNode, "collision"));
    }
    if let Some(bare) = bare {
        let rule = Layer::rule(Rule::Horizontal(units.length(bare)), Role::BareOscillator.style());
        panel = panel.with(rule.labelled("without absorber"));
    }
    panel.layers.extend(marks(scene, found, true, &|point| {
        [units.length(point.clearance), units.length(point.peak)]
    }));
    if let Some(here) = found.iter().find(|point| point.clearance == 1.0) {
        let at = [units.length(1.0), units.length(here.peak)];
        panel = panel.with(Layer::this_case(at, Some("this case".to_owned())));
    }
    panel
}

fn words(scene: &Scene, found: &[WalkPoint], bare: Option<f64>, hopf: f64) -> (String, String) {
    let units = &scene.units;
    let frequency = units.frequency_text(scene.study.analysis.system.frequency_ratio());
    let least = found.iter().min_by(|a, b| a.peak.total_cmp(&b.peak));
    let mut caption = match least {
        Some(least) => format!(
            "At {frequency} the smallest peak of the clearances tried is {} at b = {} ({}); the Hopf boundary is at {}.",
            units.length_text(least.peak),
            units.length_text(least.clearance),
            least.regime.words(),
            units.length_text(hopf)
        ),
        None => format!("At {frequency} no clearance could be followed."),
    };
    if let (Some(bare), Some(least)) = (bare, least) {
        caption.push_str(&format!(
            " Without absorber the peak is {} ({}).",
            units.length_text(bare),
            decibels(least.peak / bare)
        ));
    }
    let alt = format!(
        "Left, {} simulated motions in the plane of the amplitudes, which move down the right branch to the fold as the clearance \
         grows; right, the oscillator's peak over the clearance. {caption}",
        significant(found.len() as f64, 2)
    );
    (caption, alt)
}
