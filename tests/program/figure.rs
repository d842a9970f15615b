//! What every figure owes its reader: the same bytes each time, a small and well-formed file,
//! nothing lost that matters, nothing covered, nothing cut.

mod gallery;
mod reduction;
mod xml;

use crate::common;
use std::f64::consts::TAU;

use proptest::prelude::*;
use vinesink::report::figure::{
    Axis, AxisScale, Cells, Color, Drawing, Figure, Fill, GridCell, Image, Label, Layer, Layout,
    MarkedPoint, Panel, Role, Rule, Tick, Tint, draw, render,
};

fn simple(layers: Vec<Layer>) -> Figure {
    let panel = Panel { layers, ..Panel::new(Axis::linear("x (1)"), Axis::linear("y (1)")) };
    Figure::new("simple", "Simple").with_panel(panel)
}

fn svg(figure: &Figure) -> String {
    let svg = render(figure).expect("can be drawn");
    xml::check(&svg);
    for word in ["NaN", "inf", "<style", "<script", " id=", "clip-path", "href", "opacity=\"1\""] {
        assert!(!svg.contains(word), "{word} in {}", figure.name);
    }
    svg
}

fn has_text(drawing: &Drawing, text: &str) -> bool {
    drawing.texts.iter().any(|t| t.text == text)
}

#[test]
fn gallery_is_small_well_formed_and_the_same_each_time() {
    for figure in gallery::all() {
        let first = svg(&figure);
        assert_eq!(first, svg(&figure.clone()), "{}", figure.name);
        assert!(first.len() < 60_000, "{}: {} bytes", figure.name, first.len());
        let (w, h) = figure.size;
        assert!(first.contains(&format!(
            "width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w}0 {h}0\" role=\"img\""
        )));
        assert!(first.contains(&format!("<title>{}</title>", figure.title)));
        assert!(first.contains("fill=\"#FFFFFF\""), "no white ground");
    }
}

#[test]
fn gallery_words_neither_touch_nor_are_cut() {
    for figure in gallery::all() {
        let texts = draw(&figure).unwrap().texts;
        common::words_are_apart(&figure, &texts);
    }
}

/// On a phone too: panels one above the other, as far as the words have room.
#[test]
fn narrow_words_neither_touch_nor_are_cut() {
    let all = gallery::all();
    let narrow: Vec<Figure> = all.iter().filter_map(Figure::narrow).collect();
    assert!(narrow.len() > all.len() / 2, "{} of {}", narrow.len(), all.len());
    for figure in narrow {
        assert_eq!(figure.size.0, 400);
        let texts = draw(&figure).unwrap().texts;
        common::words_are_apart(&figure, &texts);
    }
}

/// A heading that is wider than its panel goes on below, and takes no room from the panel beside it.
#[test]
fn a_long_heading_is_wrapped() {
    let heading = ["the", "displacement", "of", "a", "place"].repeat(4).join(" ");
    let panel = |text: &str| {
        simple(vec![Layer::curve(Role::Stable, vec![[0.0; 2], [1.0; 2]])]).panels[0]
            .clone()
            .with_heading(text)
    };
    let figure = Figure::new("wrapped", "").with_layout(Layout::columns(&[1.0; 2]));
    let figure = figure.with_size(500, 320).with_panel(panel(&heading)).with_panel(panel("short"));
    let drawing = draw(&figure).expect("can be drawn");
    common::words_are_apart(&figure, &drawing.texts);
    assert!(!has_text(&drawing, &heading) && has_text(&drawing, "short"));
}

/// Words that a phone has no room for, and a figure that is nothing but bars, keep the usual drawing.
#[test]
fn what_would_not_be_read_is_not_narrow() {
    let curve = || Layer::curve(Role::Stable, vec![[0.0, 0.0], [1.0, 1.0]]);
    assert!(simple(vec![curve().labelled("short")]).narrow().is_some());
    let long = "words that go on and on and on and on, beyond all that a phone has room for";
    assert!(simple(vec![curve().labelled(long)]).narrow().is_none());
    assert!(simple(vec![curve()]).with_size(720, 110).narrow().is_none());
}

#[test]
fn gallery_words_are_large_enough_at_full_size() {
    for figure in gallery::all() {
        let svg = svg(&figure);
        let sizes = svg.split("font-size=\"").skip(1);
        for size in sizes.map(|rest| rest.split('"').next().unwrap()) {
            let size: f64 = size.parse().unwrap();
            assert!((120.0..=160.0).contains(&size), "{}: {size}", figure.name);
        }
    }
}

#[test]
fn every_label_is_written_once() {
    for figure in gallery::all() {
        let texts = draw(&figure).unwrap().texts;
        for layer in figure.panels.iter().flat_map(|p| &p.layers) {
            let (Layer::Curve { label, .. }
            | Layer::Points { label, .. }
            | Layer::Band { label, .. }
            | Layer::Rule { label, .. }) = layer
            else {
                continue;
            };
            let Some(label) = label else { continue };
            let count = texts.iter().filter(|t| t.text == label.text).count();
            assert_eq!(count, 1, "{}: {}", figure.name, label.text);
        }
    }
}

/// Names cover no data: no vertex or middle of a drawn line lies in the room of a name. The figure
/// has enough room for its names beside its curves.
#[test]
fn names_keep_off_the_curves() {
    let wave = |phase: f64| {
        (0..=400)
            .map(|i| f64::from(i) / 40.0)
            .map(|x| [x, libm::sin(x + phase)])
            .collect::<Vec<_>>()
    };
    let figure = simple(vec![
        Layer::curve(Role::Stable, wave(0.0)).labelled("first"),
        Layer::curve(Role::Hopf, wave(2.0)).labelled("second"),
    ]);
    let drawing = draw(&figure).unwrap();
    let lines = xml::lines(&drawing.svg);
    assert_eq!(lines.len(), 2);
    for name in ["first", "second"] {
        let room = drawing.texts.iter().find(|t| t.text == name).unwrap().room;
        for pair in lines.iter().flat_map(|line| line.windows(2)) {
            for t in [0.0, 0.25, 0.5, 0.75] {
                let [x, y] = [0, 1].map(|i| (pair[0][i] + t * (pair[1][i] - pair[0][i])) / 10.0);
                let inside = x > room.left && x < room.right && y > room.top && y < room.bottom;
                assert!(!inside, "{name} lies on a curve at {x} {y}");
            }
        }
    }
}

#[test]
fn names_without_a_place_go_above_the_plot() {
    let wave = (0..=4000).map(|i| f64::from(i) / 400.0).map(|x| [x, libm::sin(90.0 * x)]).collect();
    let mut figure = simple(vec![Layer::curve(Role::Simulation, wave).labelled("everywhere")]);
    figure.panels[0].y.range = Some((-0.9, 0.9));
    let drawing = draw(&figure).unwrap();
    let room = drawing.texts.iter().find(|t| t.text == "everywhere").unwrap().room;
    let top = xml::lines(&drawing.svg).iter().flatten().map(|p| p[1]).fold(f64::INFINITY, f64::min);
    // The first line found may be the legend's sample; the plot is below it.
    assert!(room.bottom < 35.0 && top / 10.0 < room.bottom, "{room:?} {top}");
}

#[test]
fn ticks_are_round_and_short() {
    let ticks_of = |first: f64, last: f64| {
        let mut figure = simple(vec![]);
        figure.panels[0].x.range = Some((first, last));
        figure.panels[0].y.range = Some((0.0, 1.0));
        figure.panels[0].y.ticks = Some(vec![]);
        let texts = draw(&figure).unwrap().texts;
        let words = texts.into_iter().map(|t| t.text).filter(|t| !t.contains("(1)"));
        words.collect::<Vec<String>>().join(" ")
    };
    assert_eq!(ticks_of(-10.0, 10.0), "−10 −5 0 5 10");
    assert_eq!(ticks_of(7.4, 9.4), "7.5 8.0 8.5 9.0");
    assert_eq!(ticks_of(0.0, 0.3), "0.00 0.05 0.10 0.15 0.20 0.25 0.30");
    assert_eq!(ticks_of(0.0, 2e-5), "0 0.5×10⁻⁵ 1.0×10⁻⁵ 1.5×10⁻⁵ 2.0×10⁻⁵");
    assert_eq!(ticks_of(0.0, 50_000.0), "0 10000 20000 30000 40000 50000");
}

#[test]
fn log_ticks_are_powers_of_ten() {
    let points = vec![[1e-7, 0.02], [1e3, 30.0]];
    let panel =
        Panel::new(Axis::log("h (1)"), Axis::log("e (1)")).with(Layer::curve(Role::Stable, points));
    let drawing = draw(&Figure::new("log", "Log").with_panel(panel)).unwrap();
    for text in ["10⁻⁶", "10⁻²", "10²", "0.1", "1", "10"] {
        assert!(has_text(&drawing, text), "{text} missing in {:?}", drawing.texts);
    }
}

#[test]
fn given_ticks_are_kept() {
    let mut figure = simple(vec![]);
    let tick = |value: f64, label: &str| Tick { value, label: Some(label.into()) };
    figure.panels[0].x.range = Some((0.0, TAU));
    figure.panels[0].x.ticks =
        Some(vec![tick(0.0, "0"), tick(TAU / 2.0, "π"), tick(TAU, "2π"), tick(9.0, "3π")]);
    let drawing = draw(&figure).unwrap();
    assert!(has_text(&drawing, "π") && has_text(&drawing, "2π") && !has_text(&drawing, "3π"));
}

#[test]
fn words_are_escaped() {
    let nasty = "a < b & \"c\" > d\u{1}";
    let mut figure = simple(vec![
        Layer::points(
            Role::ExactOrbit,
            [MarkedPoint::new(0.5, 0.5).with_tooltip(nasty).with_label(nasty)],
        )
        .labelled(nasty),
        Layer::note([0.2, 0.2], nasty),
    ]);
    figure.title = nasty.into();
    figure.alt = nasty.into();
    figure.panels[0].x.label = nasty.into();
    figure.panels[0].heading = Some("m < n & o".into());
    let svg = svg(&figure);
    assert!(svg.contains("<title>a &lt; b &amp; &quot;c&quot; &gt; d\u{fffd}</title>"));
    assert!(svg.contains("m &lt; n &amp; o"));
}

#[test]
fn an_outlier_does_not_decide_the_limits_but_the_case_at_hand_does() {
    let mut points: Vec<[f64; 2]> =
        (0..1000).map(|i| f64::from(i) / 1000.0).map(|x| [x, x]).collect();
    points[500][1] = 1e4;
    let with = |extra: Option<Layer>| {
        let mut layers = vec![Layer::points(Role::Simulation, points.clone())];
        layers.extend(extra);
        draw(&simple(layers)).unwrap()
    };
    let near = with(None);
    assert!(!has_text(&near, "10000"), "{:?}", near.texts);
    let far = with(Some(Layer::this_case([0.5, 1e4], None)));
    assert!(has_text(&far, "10000"), "{:?}", far.texts);
    assert!(has_text(&far, "this case"));
    let named = MarkedPoint::new(0.5, 1e4).with_label("fold");
    let far = with(Some(Layer::points(Role::Stable, [named])));
    assert!(has_text(&far, "10000") && has_text(&far, "fold"), "{:?}", far.texts);
}

#[test]
fn equal_aspect_is_equal() {
    let mut figure = simple(vec![]);
    figure.panels[0].equal_aspect = true;
    figure.panels[0].x.range = Some((0.0, 3.0));
    figure.panels[0].y.range = Some((0.0, 2.0));
    let [left, top, right, bottom] = xml::frame(&svg(&figure));
    assert!(((right - left) / 3.0 - (bottom - top) / 2.0).abs() < 1.0);
}

#[test]
fn nothing_to_draw_is_still_a_figure() {
    svg(&simple(vec![]));
    svg(&simple(vec![
        Layer::curve(Role::Stable, vec![]).labelled("no points"),
        Layer::curve(Role::Stable, vec![[1.0, 1.0]]).labelled("one point"),
        Layer::points(Role::ExactOrbit, Vec::<[f64; 2]>::new()).labelled("none"),
        Layer::between(&[], &[], Fill::tint(Color::Orange)).labelled("no area"),
        Layer::between(&[[0.0, 0.0]], &[], Fill::tint(Color::Orange)).labelled("a point"),
        Layer::this_case([f64::NAN, 0.0], None),
        Layer::note([0.0, f64::INFINITY], "nowhere"),
    ]));
}

#[test]
fn mistakes_are_told() {
    let tells = |figure: &Figure, words: &str| {
        let error = render(figure).unwrap_err().to_string();
        let named = error.starts_with(&format!("figure {}: ", figure.name));
        assert!(named && error.contains(words), "{error}");
    };
    tells(&Figure::new("e", "E"), "has no panels");
    for range in [(1.0, 1.0), (2.0, 1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
        let mut figure = simple(vec![]);
        figure.panels[0].x.range = Some(range);
        tells(&figure, &format!("axis \"x (1)\" cannot run from {} to {}", range.0, range.1));
    }
    let mut figure = simple(vec![]);
    figure.panels[0].y = Axis::log("y (1)").with_range(0.0, 1.0);
    tells(&figure, "axis \"y (1)\" cannot run from 0 to 1");
    tells(&simple(vec![]).with_size(60, 60), "pixels; enlarge the figure");
    let cells = vec![GridCell { column: 1, row: 0, columns: 1, rows: 1 }];
    let layout = Layout { widths: vec![1.0], heights: vec![1.0], cells };
    tells(&simple(vec![]).with_layout(layout), "the cell of panel 0 is empty or outside the grid");
}

#[test]
fn stacked_panels_share_their_time_axis() {
    let panel = |end: f64| {
        Panel::new(Axis::linear("time t (s)"), Axis::linear("y (1)"))
            .with(Layer::curve(Role::Simulation, vec![[0.0, 0.0], [end, 1.0]]))
    };
    let figure = Figure::new("stack", "Stack").with_layout(Layout::rows(&[1.0; 2]));
    let drawing = draw(&figure.with_panel(panel(5.0)).with_panel(panel(10.0))).unwrap();
    assert_eq!(drawing.texts.iter().filter(|t| t.text == "time t (s)").count(), 1);
    assert_eq!(drawing.texts.iter().filter(|t| t.text == "10").count(), 1);
    let lines = xml::lines(&drawing.svg);
    let end = |i: usize| lines[i].last().unwrap()[0] - lines[i][0][0];
    assert!((2.0 * end(0) - end(1)).abs() < 3.0, "{} {}", end(0), end(1));
}

/// Everything that can be drawn, in one of several units of the data. Powers of two lose no digit.
fn in_units(units: [f64; 2], scale: AxisScale, range: Option<(f64, f64)>) -> Figure {
    let at = |[x, y]: [f64; 2]| [x / units[0], y / units[1]];
    let line = |bend: f64| -> Vec<[f64; 2]> {
        (1..90).map(|k| f64::from(k) / 10.0).map(|x| at([x, 2.0 + bend * x * x])).collect()
    };
    let image = Image {
        x_edges: [1.0, 2.0, 4.0].map(|x| x / units[0]).to_vec(),
        y_edges: [2.0, 5.0, 6.0].map(|y| y / units[1]).to_vec(),
        cells: Cells::Kinds(vec![Tint([9, 9, 9])], vec![Some(0), None, None, Some(0)]),
    };
    let axis = |k: usize| {
        let axis = Axis::linear("x (mm)").with_scale(scale).with_factor(units[k]);
        range.map_or(axis.clone(), |(first, last)| {
            axis.with_range(first / units[k], last / units[k])
        })
    };
    let near = Label::near("near", at([7.0, 3.0]));
    let panel = Panel::new(axis(0), axis(1))
        .with(Layer::Image(image))
        .with(Layer::between(&line(0.02), &line(0.03), Fill::tint(Color::Orange)))
        .with(Layer::curve(Role::Stable, line(0.05)).labelled(near))
        .with(Layer::points(Role::ExactOrbit, line(0.1)).labelled("points"))
        .with(Layer::vertical(3.0 / units[0], Role::Guide).labelled("at 3"))
        .with(Layer::horizontal(4.0 / units[1], Role::Guide))
        .with(Layer::this_case(at([5.0, 5.0]), None));
    let through = at([1.0, 1.0]);
    let sloped = Rule::Sloped { through, slope: units[0] / units[1] };
    let below = panel.clone().with(Layer::rule(sloped, Role::Guide));
    let figure = Figure::new("units", "Units").with_layout(Layout::rows(&[1.0; 2]));
    figure.with_panel(panel).with_panel(below)
}

/// What the axes multiply by might as well have been multiplied before.
#[test]
fn data_in_another_unit_make_the_same_drawing() {
    for scale in [AxisScale::Linear, AxisScale::Log] {
        for range in [None, Some((0.5, 9.5))] {
            let plain = draw(&in_units([1.0; 2], scale, range)).expect("can be drawn");
            let other = draw(&in_units([1024.0, 0.125], scale, range)).expect("can be drawn");
            assert_eq!(plain.svg, other.svg, "{scale:?} {range:?}");
            let [x, y] = other.panels[0].axes;
            let ends = [(1024.0 * x.0, 1024.0 * x.1, x.2), (0.125 * y.0, 0.125 * y.1, y.2)];
            assert_eq!(plain.panels[0].axes, ends);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Whatever the numbers, the file is well formed and has only finite numbers.
    #[test]
    fn any_numbers_can_be_drawn(
        points in prop::collection::vec(prop::array::uniform2(prop::num::f64::ANY), 0..40),
        small in prop::collection::vec(prop::array::uniform2(-1e3..1e3_f64), 0..40),
        log in any::<bool>(),
    ) {
        let axis = |l: &str| if log { Axis::log(l) } else { Axis::linear(l) };
        let layers = vec![
            Layer::curve(Role::Stable, points.clone()).labelled("curve"),
            Layer::points(Role::ExactOrbit, points.clone()).labelled("points"),
            Layer::curve(Role::Unstable, small.clone()).labelled(Label::near("small", [0.0, 0.0])),
            Layer::Band { outline: small, fill: Fill::tint(Color::SkyBlue), label: Some("band".into()) },
        ];
        let panel = Panel { layers, ..Panel::new(axis("x (1)"), axis("y (1)")) };
        svg(&Figure::new("any", "Any").with_panel(panel));
    }
}
