//! The objective over the clearance, and the best clearance of one excitation over its frequency and
//! amplitude.

use super::words::Words;
use crate::case::Case;
use crate::optimize::Optimization;
use crate::report::figure::{
    Axis, Color, Dash, Figure, Fill, Label, Layer, Layout, MarkedPoint, Marker, Panel, Role, Rule,
    Shape, Style,
};

/// Amplitudes of the chart, over the case's own.
const AMPLITUDES: [f64; 2] = [0.25, 2.0];

/// Both figures.
pub fn figures(case: &Case, found: &Optimization) -> Vec<Figure> {
    let words = Words::new(case, found);
    let mut figures = vec![landscape(&words)];
    figures.extend(chart(&words));
    figures
}

fn clearance_label(words: &Words) -> String {
    format!("clearance b ({})", words.lengths.unit)
}

fn landscape(words: &Words) -> Figure {
    let found = words.found;
    let place = |at: f64, score: f64| [words.lengths.number(at), words.number(score)];
    let curve = |points: &[(f64, f64)]| -> Vec<[f64; 2]> {
        let finite = points.iter().filter(|(_, score)| score.is_finite());
        finite.map(|(at, score)| place(*at, *score)).collect()
    };
    let bounds = found.task.bounds[0];
    let [low, high] = [bounds.from, bounds.to].map(|at| words.lengths.number(at));
    let x = Axis::log(clearance_label(words)).with_range(low, high);
    let mut panel = Panel::new(x, Axis::linear(words.axis()));
    panel = panel.with(Layer::curve(Role::Stable, curve(&found.landscape)).labelled("as written"));
    if !found.robust_landscape.is_empty() {
        let style = Style::new(Color::Orange, 1.8, Dash::Dashed);
        panel =
            panel.with(Layer::styled(style, curve(&found.robust_landscape)).labelled("expected"));
    }
    let mut rule = |at: f64, name: &str, style: Style| {
        let at = words.lengths.number(at);
        if low < at && at < high {
            panel.layers.push(Layer::rule(Rule::Vertical(at), style).labelled(name));
        }
    };
    rule(found.own.choice.clearance, "the case", Style::new(Color::Grey, 1.4, Dash::Dotted));
    if let Some(claim) = &found.claim {
        let end = claim.end_clearance * found.own.choice.clearance;
        rule(end, "1:1 disappears", Style::new(Color::Vermillion, 1.4, Dash::DashDot));
    }
    let mut mark = |at: f64, score: f64, name: &str, marker: Marker, color: Color| {
        if score.is_finite() && found.reached() {
            let [x, y] = place(at, score);
            let tooltip = format!("{name}: {}, {}", words.lengths.text(at), words.value(score));
            let point = MarkedPoint::new(x, y).with_tooltip(tooltip);
            panel.layers.push(Layer::marked(marker, color, [point]).labelled(name));
        }
    };
    let best = &found.nominal;
    let filled = Marker::filled(Shape::Circle);
    mark(best.choice.clearance, best.judged(), "optimum", filled, Color::Black);
    if let Some(robust) = &found.robust {
        let score = robust.expected.unwrap_or(f64::NAN);
        let hollow = Marker::hollow(Shape::Diamond);
        mark(robust.choice.clearance, score, "robust optimum", hollow, Color::Black);
    }
    let simulated = found.candidates.iter().filter(|one| one.simulated.is_finite());
    let simulated: Vec<MarkedPoint> = simulated
        .map(|one| {
            let [x, y] = place(one.choice.clearance, one.simulated);
            MarkedPoint::new(x, y).with_tooltip(format!(
                "{}, {} as simulated",
                words.lengths.text(one.choice.clearance),
                words.value(one.simulated)
            ))
        })
        .collect();
    if !simulated.is_empty() {
        let cross = Layer::marked(Marker::hollow(Shape::Square), Color::Vermillion, simulated);
        panel.layers.push(cross.labelled("candidates, simulated"));
    }
    let caption = format!("{} {}", words.headline(), words.against_own());
    let alt = format!("{} over the clearance. {caption}", words.objective_words());
    Figure::new("optimize-landscape", "The objective over the clearance")
        .with_panel(panel)
        .with_words(caption, alt)
}

/// `None` where no clearance suits any of the frequencies.
fn chart(words: &Words) -> Option<Figure> {
    let found = words.found;
    let scales = words.scales;
    let physical = scales.natural_frequency_rad_per_s.is_some();
    let frequency = |omega: f64| scales.frequency_hz(omega).unwrap_or(omega);
    let length = |at: f64| words.lengths.number(at);
    let best: Vec<[f64; 2]> = found
        .chart
        .iter()
        .filter_map(|one| Some([frequency(one.frequency_ratio), length(one.best?)]))
        .collect();
    let largest = best.iter().map(|point| point[1]).max_by(f64::total_cmp)?;
    let smallest = best.iter().map(|point| point[1]).min_by(f64::total_cmp)?;
    let ends = |k: usize| -> Vec<[f64; 2]> {
        let placed = found
            .chart
            .iter()
            .filter_map(|one| Some([frequency(one.frequency_ratio), length(one.stable?[k])]));
        placed.map(|[x, y]| [x, y.clamp(0.3 * smallest, 2.0 * largest)]).collect()
    };
    let name = if physical { "frequency f (Hz)" } else { "frequency ratio Ω (1)" };
    let fill = Fill::tint(Color::SkyBlue);
    let chosen = found.reached().then(|| {
        let at = Rule::Horizontal(length(found.nominal.choice.clearance));
        Layer::rule(at, Style::new(Color::Grey, 1.4, Dash::Dotted)).labelled("chosen")
    });
    let (first, last) = (found.chart.first()?, found.chart.last()?);
    let x = Axis::linear(name)
        .with_range(frequency(first.frequency_ratio), frequency(last.frequency_ratio));
    let mut over_frequency = Panel::new(x, Axis::log(clearance_label(words)))
        .with(Layer::between(&ends(0), &ends(1), fill).labelled("stable 1:1"))
        .with(Layer::curve(Role::Stable, best.clone()).labelled("best"));
    over_frequency.layers.extend(chosen);
    let own = found.task.design.system().ok()?.frequency_ratio();
    let here = found.chart.iter().filter(|one| one.best.is_some()).min_by(|a, b| {
        let away = |one: &crate::optimize::chart::Suited| (one.frequency_ratio - own).abs();
        away(a).total_cmp(&away(b))
    })?;
    let line = |at: f64| AMPLITUDES.map(|amplitude| [amplitude, length(at) * amplitude]).to_vec();
    let mut over_amplitude = Panel::new(
        Axis::linear("amplitude over the case's (1)").with_range(AMPLITUDES[0], AMPLITUDES[1]),
        Axis::linear(clearance_label(words)),
    );
    if let Some([low, high]) = here.stable {
        let fill = Fill::tint(Color::SkyBlue);
        over_amplitude = over_amplitude.with(
            Layer::between(&line(low), &line(high), fill).labelled(Label::from("stable 1:1")),
        );
    }
    let over_amplitude = over_amplitude
        .with(Layer::curve(Role::Stable, line(here.best?)).labelled("best"))
        .with(Layer::this_case([1.0, length(found.own.choice.clearance)], None));
    let at = words.frequency(here.frequency_ratio);
    let caption = format!(
        "The clearance that is best for one excitation alone, over its frequency with the case's amplitude (left), and at {at} over its amplitude, to which it is exactly proportional (right)."
    );
    let alt = format!("Two panels. {caption}");
    Some(
        Figure::new("optimize-chart", "The best clearance of one excitation")
            .with_layout(Layout::columns(&[1.0, 1.0]))
            .with_panel(over_frequency)
            .with_panel(over_amplitude)
            .with_words(caption, alt),
    )
}
