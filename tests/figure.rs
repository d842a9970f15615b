//! What every figure owes its reader: the same bytes each time, a small and well-formed file,
//! nothing lost that matters, nothing covered, nothing cut.

#[path = "figure/gallery.rs"]
mod gallery;
#[path = "figure/xml.rs"]
mod xml;

use proptest::prelude::*;
use vinesink::report::figure::{
    Axis, Cell, Color, Drawing, Figure, FigureError, Fill, LIMIT, Label, Layer, Layout,
    MarkedPoint, Panel, Rect, Role, Rule, Tick, draw, render,
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

/// The labels of an axis, in order, as far as they read as numbers.
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
        let (right, bottom) = (f64::from(figure.size.0), f64::from(figure.size.1));
        let page = Rect { left: 0.0, top: 0.0, right, bottom };
        for (i, a) in texts.iter().enumerate() {
            assert!(page.contains(&a.room), "{}: {a:?} is cut", figure.name);
            for b in &texts[i + 1..] {
                assert!(!a.room.overlaps(&b.room), "{}: {a:?} touches {b:?}", figure.name);
            }
        }
    }
}

#[test]
fn gallery_words_are_large_enough_at_full_size() {
    for figure in gallery::all() {
        let svg = svg(&figure);
        let sizes = svg.split("font-size=\"").skip(1);
        for size in sizes.map(|rest| rest.split('"').next().unwrap()) {
            let size: f64 = size.parse().unwrap();
            assert!((120.0..=140.0).contains(&size), "{}: {size}", figure.name);
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
    assert!(room.bottom < 30.0 && top / 10.0 < room.bottom, "{room:?} {top}");
}

#[test]
fn long_series_keep_every_peak_and_stay_small() {
    let spike = 61_803;
    let points: Vec<[f64; 2]> = (0..100_000)
        .map(|i| {
            let t = f64::from(i) * 1e-4;
            [t, if i == spike { 9.0 } else { libm::sin(400.0 * t) }]
        })
        .collect();
    let mut figure = simple(vec![Layer::curve(Role::Simulation, points)]);
    figure.panels[0].y.range = Some((-10.0, 10.0));
    figure.panels[0].x.range = Some((0.0, 10.0));
    let svg = svg(&figure);
    assert!(svg.len() < 60_000, "{} bytes", svg.len());
    let line = &xml::lines(&svg)[0];
    let frame = xml::frame(&svg);
    let y = |v: f64| frame[3] - (v + 10.0) / 20.0 * (frame[3] - frame[1]);
    let x = |v: f64| frame[0] + v / 10.0 * (frame[2] - frame[0]);
    let peak = line.iter().min_by(|a, b| a[1].total_cmp(&b[1])).unwrap();
    assert!((peak[1] - y(9.0)).abs() <= 2.0, "peak at {} instead of {}", peak[1], y(9.0));
    assert!((peak[0] - x(6.1803)).abs() <= 2.0, "peak at {} instead of {}", peak[0], x(6.1803));
    // The swing of every half second is there in full.
    for k in 0..20 {
        let (from, to) = (x(f64::from(k) * 0.5), x(f64::from(k + 1) * 0.5));
        let within = || line.iter().filter(|p| p[0] >= from && p[0] <= to).map(|p| p[1]);
        let (least, most) = (within().fold(f64::MAX, f64::min), within().fold(f64::MIN, f64::max));
        assert!(least <= y(1.0) + 2.0 && most >= y(-1.0) - 2.0, "piece {k}: {least} {most}");
    }
}

#[test]
fn simplified_curves_stay_within_a_fifth_of_a_pixel() {
    let points: Vec<[f64; 2]> = (0..3000)
        .map(|i| f64::from(i) * 0.004)
        .map(|t| [libm::cos(t) * t, libm::sin(t) * t])
        .collect();
    let mut figure = simple(vec![Layer::curve(Role::Stable, points.clone())]);
    figure.panels[0].x.range = Some((-15.0, 15.0));
    figure.panels[0].y.range = Some((-15.0, 15.0));
    let svg = svg(&figure);
    let (line, frame) = (&xml::lines(&svg)[0], xml::frame(&svg));
    assert!(line.len() < 1000, "{} points", line.len());
    for p in &points {
        let at = [
            frame[0] + (p[0] + 15.0) / 30.0 * (frame[2] - frame[0]),
            frame[3] - (p[1] + 15.0) / 30.0 * (frame[3] - frame[1]),
        ];
        let nearest =
            line.windows(2).map(|s| xml::distance(at, s[0], s[1])).fold(f64::MAX, f64::min);
        // Tolerance 1.5 tenths, rounding of the vertices and of the frame about half a tenth each.
        assert!(nearest < 3.0, "{at:?} is {nearest} tenths of a pixel from the line");
    }
}

#[test]
fn too_much_is_drawn_coarser_and_then_refused() {
    let noise = |i: usize, k: f64| {
        let v = libm::sin(i as f64 * k) * 43_758.545_3;
        v - v.floor()
    };
    let cloud = |count| (0..count).map(|i| [noise(i, 12.9898), noise(i, 78.233)]);
    let svg = svg(&simple(vec![Layer::points(Role::Simulation, cloud(30_000))]));
    assert!(svg.len() <= LIMIT && svg.len() > LIMIT / 20, "{} bytes", svg.len());
    let talkative = |p: [f64; 2]| MarkedPoint::new(p[0], p[1]).with_tooltip("word ".repeat(400));
    let figure = simple(vec![Layer::points(Role::Simulation, cloud(3000).map(talkative))]);
    let error = render(&figure).unwrap_err();
    assert!(
        matches!(error, FigureError::TooLarge { bytes, limit: LIMIT, .. } if bytes > LIMIT),
        "{error}"
    );
}

#[test]
fn points_on_one_spot_are_one_element_that_tells_their_number() {
    let point = |x: f64| MarkedPoint::new(x, 1.0).with_tooltip("orbit");
    let points = [point(0.0), point(1e-6), point(2e-6), point(1.0)];
    let svg = svg(&simple(vec![Layer::points(Role::ExactOrbit, points)]));
    assert_eq!(svg.matches("<circle").count(), 2);
    assert!(svg.contains("<title>orbit (and 2 more here)</title>"));
    assert!(svg.contains("<title>orbit</title>"));
}

#[test]
fn nothing_is_drawn_outside_the_plot() {
    let wild =
        (0..=100).map(|i| f64::from(i) / 10.0).map(|x| [x, 1e6 * libm::sin(3.0 * x)]).collect();
    let mut figure = simple(vec![
        Layer::curve(Role::Stable, wild),
        Layer::rule(Rule::Sloped { through: [0.0, 0.0], slope: 1e9 }, Role::Guide.style()),
        Layer::rule(Rule::Horizontal(7.0), Role::Guide.style()).labelled("unseen"),
        Layer::points(Role::ExactOrbit, [[1e3, 0.5], [5.0, 0.5]]),
        Layer::between(
            &[[-9.0, -9.0], [99.0, -9.0]],
            &[[-9.0, 99.0], [99.0, 99.0]],
            Fill::tint(Color::Orange),
        ),
    ]);
    figure.panels[0].x.range = Some((0.0, 10.0));
    figure.panels[0].y.range = Some((0.0, 1.0));
    let svg = svg(&figure);
    let frame = xml::frame(&svg);
    for [x, y] in xml::paths(&svg).into_iter().flatten() {
        let inside = x >= frame[0] - 50.0
            && x <= frame[2] + 50.0
            && y >= frame[1] - 50.0
            && y <= frame[3] + 50.0;
        assert!(inside, "{x} {y} is outside {frame:?}");
    }
    assert!(!svg.contains("unseen"));
    assert_eq!(svg.matches("a38 38 0").count(), 2, "one hollow circle, two arcs");
}

#[test]
fn a_break_in_the_data_is_a_break_in_the_line() {
    let points = vec![
        [0.0, 0.0],
        [1.0, 1.0],
        [f64::NAN, f64::NAN],
        [2.0, 0.0],
        [3.0, f64::INFINITY],
        [4.0, 1.0],
        [5.0, 0.0],
    ];
    let svg = svg(&simple(vec![Layer::curve(Role::Stable, points)]));
    assert_eq!(xml::lines(&svg).len(), 2);
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
    assert_eq!(
        ticks_of(0.0, 2e-5),
        "0 5×10⁻⁶ 10×10⁻⁶ 15×10⁻⁶ 20×10⁻⁶"
            .replace("5×10⁻⁶ 10×10⁻⁶ 15×10⁻⁶ 20×10⁻⁶", "0.5×10⁻⁵ 1.0×10⁻⁵ 1.5×10⁻⁵ 2.0×10⁻⁵")
    );
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
    figure.panels[0].x.range = Some((0.0, 6.2832));
    figure.panels[0].x.ticks =
        Some(vec![tick(0.0, "0"), tick(3.14159, "π"), tick(6.2831, "2π"), tick(9.0, "3π")]);
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
    assert!(has_text(&with(None), "0.8"));
    let far = with(Some(Layer::this_case([0.5, 1e4], None)));
    assert!(!has_text(&far, "0.8") || has_text(&far, "10000"), "{:?}", far.texts);
    assert!(has_text(&far, "this case"));
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
    let error = |figure: &Figure| render(figure).unwrap_err();
    assert!(matches!(error(&Figure::new("e", "E")), FigureError::NoPanels { .. }));
    for range in [(1.0, 1.0), (2.0, 1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
        let mut figure = simple(vec![]);
        figure.panels[0].x.range = Some(range);
        assert!(matches!(error(&figure), FigureError::Range { .. }), "{range:?}");
    }
    let mut figure = simple(vec![]);
    figure.panels[0].y = Axis::log("y (1)").with_range(0.0, 1.0);
    assert!(matches!(error(&figure), FigureError::Range { .. }));
    assert!(matches!(error(&simple(vec![]).with_size(60, 60)), FigureError::TooSmall { .. }));
    let cells = vec![Cell { column: 1, row: 0, columns: 1, rows: 1 }];
    let layout = Layout::Cells { widths: vec![1.0], heights: vec![1.0], cells };
    assert!(matches!(error(&simple(vec![]).with_layout(layout)), FigureError::Layout { .. }));
}

#[test]
fn stacked_panels_share_their_time_axis() {
    let panel = |end: f64| {
        Panel::new(Axis::linear("time t (s)"), Axis::linear("y (1)"))
            .with(Layer::curve(Role::Simulation, vec![[0.0, 0.0], [end, 1.0]]))
    };
    let figure = Figure::new("stack", "Stack").with_layout(Layout::Column);
    let drawing = draw(&figure.with_panel(panel(5.0)).with_panel(panel(10.0))).unwrap();
    assert_eq!(drawing.texts.iter().filter(|t| t.text == "time t (s)").count(), 1);
    assert_eq!(drawing.texts.iter().filter(|t| t.text == "10").count(), 1);
    let lines = xml::lines(&drawing.svg);
    let end = |i: usize| lines[i].last().unwrap()[0] - lines[i][0][0];
    assert!((2.0 * end(0) - end(1)).abs() < 3.0, "{} {}", end(0), end(1));
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
