//! Fewer points, same picture: peaks, breaks and edges survive, files stay small.

use vinesink::report::figure::{Color, Fill, LIMIT, Layer, MarkedPoint, Role, Rule, render};

use super::{simple, svg, xml};

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
        // Tolerance 2 tenths, rounding of the vertices and of the frame about half a tenth each.
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
    assert!(error.reason.ends_with(&format!("{LIMIT} are allowed; draw fewer points")), "{error}");
    let bytes: usize = error.reason.split(' ').nth(1).unwrap().parse().expect("its size");
    assert!(bytes > LIMIT, "{error}");
}

#[test]
fn points_on_one_spot_are_one_element_that_tells_their_number() {
    let point = |x: f64| MarkedPoint::new(x, 1.0).with_tooltip("orbit");
    let points = [point(0.0), point(1e-6), point(2e-6), point(1.0)];
    let svg = svg(&simple(vec![Layer::points(Role::ExactOrbit, points)]));
    assert_eq!(svg.matches("</title></path>").count(), 2);
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
    assert_eq!(svg.matches("a38 38 0").count(), 1, "one hollow circle");
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
