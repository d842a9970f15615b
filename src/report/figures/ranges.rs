//! How far the case may change before steady 1:1 resonance ends: bars for clearance, frequency and forcing.

use serde_json::{Value, json};

use crate::method::Method;
use crate::quantity::Quantity;
use crate::report::figure::{
    Axis, AxisScale, Color, Dash, Figure, Fill, Hatch, Layer, Layout, MarkedPoint, Marker, Panel,
    Shape, Style, Tick,
};
use crate::study::plots::Ranges;

use super::DrawnCase;

/// Thickness of a bar in pixels.
const BAR: f64 = 9.0;
/// Half the height of an arrow's head; rows are 1 apart.
const HALF: f64 = 0.3;
/// Height above the bars for the mark of the case.
const ABOVE: f64 = 0.9;
/// Part of the span that an arrow's head takes, and what is free beyond the last end.
const HEAD: f64 = 0.03;
const ROOM: f64 = 0.22;

/// One panel for each parameter.
pub(super) fn figure(scene: &DrawnCase, data: &[Ranges]) -> Option<Figure> {
    let heights: Vec<f64> = data.iter().map(|one| rows(one) + ABOVE).collect();
    let height = 52.0 * data.len() as f64 + 32.0 * heights.iter().sum::<f64>();
    let ranges = || data.iter().flat_map(|one| &one.layers).flat_map(|(_, ranges)| ranges);
    let facts = json!({
        "open": ranges().flatten().any(Option::is_none),
        "rows": data.iter().map(|one| row_facts(scene, one)).collect::<Vec<_>>(),
        "inside": scene.study.exact.stretch().is_some(),
    });
    let figure = scene
        .figure("ranges", "captions/ranges", facts)
        .with_size(720, height as u32)
        .with_layout(Layout::rows(&heights));
    let figure = data.iter().map(|one| panel(scene, one)).fold(figure, Figure::with_panel);
    ranges().next().map(|_| figure)
}

fn rows(data: &Ranges) -> f64 {
    data.layers.len().max(1) as f64
}

fn row_facts(scene: &DrawnCase, data: &Ranges) -> Value {
    let kind = scene.kind(data.parameter);
    let bars = data.layers.iter().flat_map(|(layer, ranges)| {
        let end = |at: Option<f64>| at.map(|at| scene.si(kind, at));
        ranges.iter().map(move |range| json!({ "by": layer, "ends": range.map(end) }))
    });
    let here = scene.si(kind, data.parameter.of(scene.system()));
    let here = Quantity::new(kind, here, Method::Given);
    json!({ "of": kind.id, "here": here, "bars": bars.collect::<Vec<_>>() })
}

/// What a layer's row is called, and its colour.
const fn look(layer: Method) -> (&'static str, Color) {
    match layer {
        Method::Simulation => ("every start", Color::ReddishPurple),
        Method::ExactOrbit => ("exact orbit", Color::Black),
        _ => ("theory", Color::Blue),
    }
}

/// A row of bars for each layer, below the case's mark.
fn panel(scene: &DrawnCase, data: &Ranges) -> Panel {
    let (parameter, kind) = (data.parameter, scene.kind(data.parameter));
    let here = parameter.of(scene.system());
    let ends = data.layers.iter().flat_map(|(_, ranges)| ranges.iter().flatten().flatten());
    let span = ends.fold([here; 2], |[low, high], end| [low.min(*end), high.max(*end)]);
    let span = if span[0] < span[1] { span } else { [0.9 * here, 1.1 * here] };
    let edges = [-ROOM, 1.0 + ROOM].map(|part| parameter.between(span, part));
    let scale = if parameter.is_logarithmic() { AxisScale::Log } else { AxisScale::Linear };
    let x = scene.axis(kind, edges).with_scale(scale);
    let count = rows(data);
    let row = |index: usize| count - 0.5 - index as f64;
    let tick = |(index, (layer, _)): (usize, &(Method, _))| Tick {
        value: row(index),
        label: Some(look(*layer).0.to_owned()),
    };
    let ticks = data.layers.iter().enumerate().map(tick).collect();
    let y = Axis::of_ticks((0.0, count + ABOVE), ticks);
    let star = [here, count + 0.5 * ABOVE];
    let mut panel = Panel::new(x, y)
        .with(Layer::vertical(here, Style::new(Color::Black, 1.0, Dash::Dashed)))
        .with(Layer::this_case(star, Some(scene.tip("this case", &[(kind, here)]))));
    if data.layers.is_empty() {
        let middle = parameter.between(span, 0.5);
        panel = panel.with(Layer::note([middle, row(0)], "no range is known"));
    }
    let necks = [HEAD - ROOM, 1.0 + ROOM - HEAD].map(|part| parameter.between(span, part));
    for (index, (layer, ranges)) in data.layers.iter().enumerate() {
        let place = |value: f64| [value, row(index)];
        let (what, color) = look(*layer);
        for range in ranges {
            let ends = [0, 1].map(|k| range[k].unwrap_or(necks[k]));
            let line = Layer::curve(Style::new(color, BAR, Dash::Solid), ends.map(place).to_vec());
            let known = range.iter().flatten().filter(|end| **end != here).map(|end| {
                let tooltip = scene.tip(what, &[(kind, *end)]);
                let words = scene.short(kind, *end);
                MarkedPoint::from(place(*end)).with_label(words).with_tooltip(tooltip)
            });
            let caps = Layer::marked(Marker::filled(Shape::Square).sized(9.0), color, known);
            panel = panel.with(line).with(caps);
            for k in (0..2).filter(|k| range[*k].is_none()) {
                panel.layers.push(arrow(color, place(edges[k]), place(necks[k])));
            }
        }
    }
    panel
}

/// The head of an arrow, where no end was found.
fn arrow(color: Color, tip: [f64; 2], neck: [f64; 2]) -> Layer {
    let fill = Fill { color, opacity: 1.0, hatch: Hatch::None };
    let side = |up: f64| [neck[0], neck[1] + up];
    Layer::between(&[tip], &[side(-HALF), side(HALF)], fill)
}
