//! Peak displacement over the band, over frequency and over the clearance: what a designer wants to know.

use serde_json::json;

use crate::band::Survey;
use crate::case::{BandOver, Criterion};
use crate::measure::Device;
use crate::motions::Fact;
use crate::quantity::catalogue as of;
use crate::regimes::Regime;
use crate::report::chart::Chart;
use crate::report::figure::{
    Color, Dash, Figure, Layer, MarkedPoint, Marker, Panel, Role, Shape, Style,
};
use crate::study::plots::{AmplitudeCurves, BandCurves, Line};
use crate::study::scenes::WalkPoint;

use super::parts;
use super::{DrawnCase, Ends};

/// The response over the case's band, and what else could be done.
pub(super) fn band(scene: &DrawnCase, data: &BandCurves) -> Option<Figure> {
    let survey = scene.study.band.as_ref()?;
    let band = survey.band();
    let found = beside_orbits(scene, survey);
    let drawn = data.orbits.iter().flatten().map(|point| point[1]);
    let highest = drawn.chain(found.iter().map(|one| one.at[1]));
    let highest = highest.filter(|value| value.is_finite()).fold(0.0, f64::max);
    let rival = data.bare.iter().chain(&data.damper).map(|point| point[1]).fold(0.0, f64::max);
    // The bare oscillator's resonance is cut where it would hide the rest.
    let top = 1.05 * if highest > 0.0 { rival.min(1.6 * highest).max(highest) } else { rival };
    let kind = match band.over {
        BandOver::Frequency => &of::EXCITATION_FREQUENCY,
        BandOver::Amplitude => scene.forcing.0,
    };
    let chart = scene.chart([kind, &of::PEAK], [band.range, [0.0, top]]);
    let marks = |exact: bool| {
        let chosen = found.iter().filter(move |one| one.exact == exact);
        chosen.map(|one| scene.mark(&chart, one.at, &one.what))
    };
    let marker = Marker::filled(Shape::Cross).sized(7.0);
    let ring = Marker::hollow(Shape::Circle).sized(5.0);
    let [stable, unstable] = &data.orbits;
    // What is cut off is told.
    let bare = survey.bare().1;
    let without = match bare > top && bare.is_finite() {
        true => format!("without absorber, up to {}", scene.text(&of::BARE_PEAK, bare)),
        false => "without absorber".to_owned(),
    };
    let mut panel = chart
        .panel()
        .with(Layer::curve(Role::BareOscillator, data.bare.clone()).labelled(without))
        .with(damper(&data.damper))
        .with(Layer::curve(Role::Unstable, unstable.clone()).labelled("unstable 1:1"))
        .with(Layer::curve(Role::Stable, stable.clone()).labelled("stable 1:1 (exact)"))
        .with(Layer::marked(ring, Role::ExactOrbit.color(), marks(true)).labelled("other orbit"))
        .with(Layer::marked(marker, Role::Simulation.color(), marks(false)).labelled("simulated"));
    if let Some(limit) = scene.limit.filter(|limit| *limit < top) {
        let style = Style::new(Color::Vermillion, 1.4, Dash::Dotted);
        panel = panel.with(Layer::horizontal(limit, style).labelled("limit"));
    }
    let zones = survey.zones().iter().map(|zone| {
        let ends = [zone.from, zone.to].map(|at| scene.si(kind, at));
        json!({ "ends": ends, "of": zone.of })
    });
    let facts = json!({
        "z3": survey.z3_share(),
        "stable": survey.motions.stable_share(),
        "over": kind.id,
        "zones": zones.collect::<Vec<_>>(),
        "inactive": survey.count_rest && survey.motions.rest_at().is_some(),
    });
    Some(scene.figure("band", "captions/band", facts).with_panel(panel))
}

/// The largest of something else along the band that is asked of a structure which moves in sines: without absorber and with a
/// damper as lines, and in every motion that counts as points.
pub(super) fn band_of(scene: &DrawnCase, data: &BandCurves, asked: &Criterion) -> Option<Figure> {
    let survey = scene.study.band.as_ref()?;
    let (band, measure) = (survey.band(), asked.measure);
    let kind = measure.kind(Device::Absorber)?;
    let unit = scene.units.number(kind.dimension, 1.0);
    let of_sines = |line: &Line| -> Line {
        let value = |at: f64, amplitude: f64| {
            let system = band.system(at).ok()?;
            measure.of_sine(amplitude, system.frequency_ratio())
        };
        line.iter().map(|[at, x]| [*at, value(*at, *x).unwrap_or(f64::NAN)]).collect()
    };
    let (without, with_damper) = (of_sines(&data.bare), of_sines(&data.damper));
    let mut found = Vec::new();
    for (at, here) in survey.motions.places() {
        for (_, motion) in here.counting(survey.count_rest) {
            let number = |fact: Fact| fact.of(motion);
            let value = measure.of_motion(motion, &number, f64::NAN, &scene.units);
            let what = motion.regime().words();
            found.extend(value.map(|[value, _]| (*at, value / unit, what)));
        }
    }
    let limit = asked.limit / unit;
    let highest = found.iter().map(|one| one.1).fold(0.0, f64::max);
    let lines = without.iter().chain(&with_damper).map(|point| point[1]);
    let lines = lines.filter(|value| value.is_finite()).fold(0.0, f64::max);
    // A resonance or a limit far above all motions would hide them.
    let top =
        1.05 * if highest > 0.0 { lines.max(limit).min(1.6 * highest).max(highest) } else { lines };
    let over = match band.over {
        BandOver::Frequency => &of::EXCITATION_FREQUENCY,
        BandOver::Amplitude => scene.forcing.0,
    };
    let chart = scene.chart([over, kind], [band.range, [0.0, top]]);
    let marks = found.iter().map(|(at, value, what)| scene.mark(&chart, [*at, *value], what));
    let marker = Marker::filled(Shape::Circle).sized(4.0);
    let mut panel = chart
        .panel()
        .with(Layer::curve(Role::BareOscillator, without).labelled("without absorber"))
        .with(damper(&with_damper))
        .with(Layer::marked(marker, Role::Simulation.color(), marks).labelled("with absorber"));
    if limit < top {
        let style = Style::new(Color::Vermillion, 1.4, Dash::Dotted);
        panel = panel.with(Layer::horizontal(limit, style).labelled("limit"));
    }
    let name = format!("band-{}", asked.key.replace('_', "-"));
    let facts = json!({ "drawn": kind.name, "over": over.name });
    Some(scene.figure(&name, "captions/band-of", facts).with_panel(panel))
}

/// The response with a tuned mass damper.
fn damper(line: &Line) -> Layer {
    let style = Style::new(Color::Orange, 1.6, Dash::LongDashed);
    Layer::curve(style, line.clone()).labelled("tuned mass damper")
}

/// A motion along the band.
struct Beside {
    at: [f64; 2],
    what: String,
    /// Whether it is a proven orbit.
    exact: bool,
}

/// Peaks along the band of what is on neither line of 1:1 orbits.
fn beside_orbits(scene: &DrawnCase, survey: &Survey) -> Vec<Beside> {
    let mut found = Vec::new();
    for (at, here) in survey.motions.places() {
        for (_, motion) in here.counting(survey.count_rest) {
            let exact = motion.orbit().is_some();
            let what = match motion.rest() {
                Some(rest) => {
                    let share = scene.text(&of::INACTIVE_SHARE, rest.share);
                    format!("inactive absorber, from {share} of its resting places")
                }
                None if motion.is_solved() => continue,
                None => {
                    let impacts = motion.facts().impacts_per_period.value;
                    let known = if exact { "exact orbit" } else { "simulated" };
                    format!("{known}, z = {}", scene.text(&of::IMPACTS_PER_PERIOD, impacts))
                }
            };
            found.push(Beside { at: [*at, motion.facts().peak.value], what, exact });
        }
    }
    found
}

/// With and without absorber over frequency.
pub(super) fn amplitude(scene: &DrawnCase, data: &AmplitudeCurves) -> Figure {
    let kinds = [&of::EXCITATION_FREQUENCY, &of::PEAK];
    let chart = scene.chart(kinds, [data.window, [0.0, data.top]]);
    let [stable, unstable] = &data.theory;
    let mut panel = chart
        .panel()
        .with(Layer::curve(Role::BareOscillator, data.bare.clone()).labelled("without absorber"))
        .with(damper(&data.damper))
        .with(Layer::curve(Role::Unstable, unstable.clone()).labelled("unstable 1:1"))
        .with(Layer::curve(Role::Stable, stable.clone()).labelled("stable 1:1 (theory)"));
    for (attracts, name) in [(true, "exact stable orbit"), (false, "exact unstable orbit")] {
        let chosen = data.exact.iter().filter(|(_, one)| one.orbit.attracts() == attracts);
        let marks = chosen.map(|(ratio, one)| {
            let radius = scene.text(&of::SPECTRAL_RADIUS, one.orbit.radius_per_period());
            let what = format!("multiplier {radius}");
            scene.mark(&chart, [*ratio, one.peaks.displacement], &what)
        });
        let marker = Marker { filled: attracts, ..Marker::hollow(Shape::Circle).sized(4.0) };
        let layer = Layer::marked(marker, Role::ExactOrbit.color(), marks);
        panel = panel.with(layer.labelled(name));
    }
    let found = data.simulated.iter().map(|(ratio, _, one)| {
        let what = format!("simulated, {}", one.regime().words());
        (one.regime(), scene.mark(&chart, [*ratio, one.facts().peak.value], &what))
    });
    panel.layers.extend(parts::by_regime(&found.collect::<Vec<_>>(), true));
    let star = data.here.map(|peak| scene.star(&chart, [scene.system().frequency_ratio(), peak]));
    panel.layers.extend(star);
    let bare = bare(scene);
    let both = data.here.zip(bare.filter(|bare| *bare > 0.0));
    let facts = json!({
        "peak": data.here,
        "bare": bare,
        "change": both.map(|(peak, bare)| decibels(peak / bare)),
        "ratio": both.map(|(peak, bare)| peak / bare),
    });
    scene.figure("amplitude", "captions/amplitude", facts).with_panel(panel)
}

/// The peak without absorber, if anything limits it.
fn bare(scene: &DrawnCase) -> Option<f64> {
    Some(scene.study.rivals.bare.1).filter(|bare| bare.is_finite())
}

fn decibels(ratio: f64) -> f64 {
    20.0 * libm::log10(ratio)
}

/// What simulation finds at many clearances: where on the manifold (Fig. 11g), and how much the oscillator
/// vibrates (section 3.1 and the red cross in Fig. 6c).
pub(super) fn clearances(scene: &DrawnCase, found: &[WalkPoint]) -> Figure {
    let least = found.iter().min_by(|a, b| a.peak.total_cmp(&b.peak));
    let facts = json!({
        "count": found.len(),
        "least": least,
        "bare": bare(scene),
        "change": least.zip(bare(scene)).map(|(least, bare)| decibels(least.peak / bare)),
    });
    scene
        .figure("clearances", "captions/clearances", facts)
        .with_size(860, 470)
        .with_panel(on_manifold(scene, found))
        .with_panel(over_clearance(scene, found))
}

/// The motions by regime, and the case.
fn walked(
    scene: &DrawnCase,
    found: &[WalkPoint],
    chart: &Chart,
    place: fn(&WalkPoint) -> [f64; 2],
) -> Vec<Layer> {
    let marks = found.iter().map(|point| -> (Regime, MarkedPoint) {
        let what = format!("{}, {}", scene.at_clearance(point.clearance), point.regime.words());
        (point.regime, scene.mark(chart, place(point), &what))
    });
    let named = chart.kinds[1].id == of::PEAK.id;
    let mut layers = parts::by_regime(&marks.collect::<Vec<_>>(), named);
    if let Some(here) = found.iter().find(|point| point.clearance == 1.0) {
        layers.push(Layer::this_case(place(here), None));
    }
    layers
}

fn on_manifold(scene: &DrawnCase, found: &[WalkPoint]) -> Panel {
    let manifold = &scene.study.analysis.manifold;
    let over = |index: usize| found.iter().map(move |point| point.amplitudes[index]);
    let farthest = over(0).fold(2.0, f64::max);
    let nearest = over(0).fold(0.4, f64::min).max(0.02);
    let heights = [manifold.fold.oscillator_amplitude.max(0.02), over(1).fold(1.0, f64::max)];
    let y = [0.7 * heights[0], 1.4 * heights[1]];
    let chart = parts::amplitudes(scene, [0.7 * nearest, 1.4 * farthest], y).with_log([true; 2]);
    let mut panel = chart.panel().with_heading("on the manifold");
    panel.layers.extend(parts::manifold_layers(manifold, 1.4 * farthest));
    panel.layers.extend(walked(scene, found, &chart, |point| point.amplitudes));
    // The ends of the walk say which way the clearance grows.
    let ends = [found.first(), found.last()].into_iter().flatten().map(|point| {
        MarkedPoint::from(point.amplitudes).with_label(scene.at_clearance(point.clearance))
    });
    panel.with(Layer::marked(Role::Guide.marker().sized(3.0), Color::Black, ends))
}

fn over_clearance(scene: &DrawnCase, found: &[WalkPoint]) -> Panel {
    let bare = bare(scene);
    let highest = found.iter().map(|point| point.peak).chain(bare).fold(0.0, f64::max);
    let ends = [found.first(), found.last()].map(|at| at.map_or(1.0, |at| at.clearance));
    let ranges = [[0.9 * ends[0], 1.15 * ends[1]], [0.0, 1.15 * highest]];
    let chart = scene.chart([&of::CLEARANCE, &of::PEAK], ranges).with_log([true, false]);
    let Ends { breaking, hopf, .. } = scene.ends;
    let mut panel = chart
        .panel()
        .with_heading("peak displacement")
        .with(Layer::vertical(breaking, Role::SymmetryBreaking).labelled("breaking"))
        .with(Layer::vertical(hopf, Role::Hopf).labelled("Hopf"));
    let last = scene.study.margins.clearance.iter().map(|at| at.clearance).fold(hopf, f64::max);
    if last > 1.02 * hopf {
        panel = panel.with(Layer::vertical(last, Role::SaddleNode).labelled("collision"));
    }
    if let Some(bare) = bare {
        let rule = Layer::horizontal(bare, Role::BareOscillator);
        panel = panel.with(rule.labelled("without absorber"));
    }
    panel.layers.extend(walked(scene, found, &chart, |point| [point.clearance, point.peak]));
    panel
}
