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
    let place = |at: f64, value: f64| [words.lengths.number(at), words.number(value)];
    let finite = found.landscape.iter().filter(|(_, value)| value.is_finite());
    let cheap = finite.map(|(at, value)| place(*at, *value));
    let bounds = found.task.bounds[0];
    let [low, high] = [bounds.from, bounds.to].map(|at| words.lengths.number(at));
    let x = Axis::log(clearance_label(words)).with_range(low, high);
    let mut panel = Panel::new(x, Axis::linear(words.axis()));
    // A coarse survey scatters: nothing is known between its places.
    panel.layers.push(if words.is_amplitude() {
        let small = Marker::filled(Shape::Circle).sized(2.0);
        let points = cheap.map(|[x, y]| MarkedPoint::new(x, y));
        Layer::marked(small, Color::Grey, points).labelled("coarse survey")
    } else {
        Layer::curve(Role::Stable, cheap.collect::<Vec<_>>()).labelled("as written")
    });
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
    let judged = |feasible: bool| -> Vec<MarkedPoint> {
        let some = found.judged.iter().filter(|one| one.feasible == feasible);
        some.filter(|one| one.value.is_finite())
            .map(|one| {
                let [x, y] = place(one.clearance, one.value);
                MarkedPoint::new(x, y).with_tooltip(format!(
                    "{}: {}",
                    words.lengths.text(one.clearance),
                    words.value_with_error(one.value, one.error)
                ))
            })
            .collect()
    };
    let [holding, failing] = [judged(true), judged(false)];
    if !failing.is_empty() {
        let layer = Layer::marked(Marker::hollow(Shape::Square), Color::Vermillion, failing);
        panel.layers.push(layer.labelled("checked, criteria fail"));
    }
    if !holding.is_empty() && words.is_amplitude() {
        let layer = Layer::marked(Marker::hollow(Shape::Circle), Color::Blue, holding);
        panel.layers.push(layer.labelled("checked"));
    }
    let mut mark = |at: f64, value: f64, name: &str, marker: Marker| {
        if value.is_finite() && found.reached() {
            let [x, y] = place(at, value);
            let tooltip = format!("{name}: {}, {}", words.lengths.text(at), words.value(value));
            let point = MarkedPoint::new(x, y).with_tooltip(tooltip);
            panel.layers.push(Layer::marked(marker, Color::Black, [point]).labelled(name));
        }
    };
    let best = &found.best;
    mark(best.choice.clearance, best.value, "optimum", Marker::filled(Shape::Circle));
    if let Some(robust) = &found.robust {
        let marker = Marker::hollow(Shape::Diamond);
        let expected = robust.under[0].expected;
        mark(robust.design.choice.clearance, expected, "robust, expected", marker);
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
        let at = Rule::Horizontal(length(found.best.choice.clearance));
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
