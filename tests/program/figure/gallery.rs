//! Figures as the reports will have them, from made-up data of the right form.

use std::f64::consts::PI;

use vinesink::report::figure::{
    Axis, Color, Figure, Fill, Hatch, Label, Layer, Layout, MarkedPoint, Marker, Panel, Role, Rule,
    Style,
};

/// All figures of the gallery.
pub fn all() -> Vec<Figure> {
    vec![
        manifold(),
        boundaries(),
        response(),
        motion(),
        return_map(),
        map_crowded(),
        loglog(),
        decay(),
    ]
}

const SQUARE: f64 = 4.0 * 0.0625 / (PI * PI);

/// The height of the slow invariant manifold.
fn height(b: f64) -> f64 {
    ((1.0 + SQUARE) * b * b - 2.0 * b + 1.0).sqrt()
}

fn sampled(first: f64, last: f64, count: usize, f: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
    (0..=count)
        .map(|i| first + (last - first) * i as f64 / count as f64)
        .map(|x| [x, f(x)])
        .collect()
}

fn gauss(x: f64, center: f64, width: f64) -> f64 {
    let z = (x - center) / width;
    1.0 / (1.0 + z * z)
}

/// A noise that repeats.
fn noise(i: usize) -> f64 {
    let v = libm::sin(i as f64 * 12.9898) * 43_758.545_3;
    2.0 * (v - v.floor()) - 1.0
}

fn branches() -> [Layer; 3] {
    let fold = 1.0 / (1.0 + SQUARE);
    [
        Layer::curve(Role::Unstable, sampled(0.0, fold, 200, height)).labelled("unstable"),
        Layer::curve(Role::Unstable, sampled(1.68148, 3.0, 200, height)),
        Layer::curve(Role::Stable, sampled(fold, 1.68148, 200, height)).labelled("stable"),
    ]
}

fn manifold() -> Figure {
    let [left, right, stable] = branches();
    let fold = 1.0 / (1.0 + SQUARE);
    let special = [
        MarkedPoint::new(fold, height(fold)).with_label("fold").with_tooltip("fold: B/b = 0.9753"),
        MarkedPoint::new(1.68148, height(1.68148)).with_label("symmetry breaking"),
    ];
    let fixed = [0.42, 1.21, 2.33].map(|b| {
        MarkedPoint::new(b, height(b))
            .with_tooltip(format!("fixed point: B/b = {b}, C/b = {:.3}", height(b)))
    });
    let panel = Panel::new(
        Axis::linear("absorber amplitude B/b (1)"),
        Axis::linear("oscillator amplitude C/b (1)"),
    )
    .with(left)
    .with(right)
    .with(stable)
    .with(Layer::points(Role::Stable, special))
    .with(Layer::points(Role::ExactOrbit, fixed).labelled("fixed points at 8.5 Hz"));
    Figure {
        caption: "Only the part between fold and symmetry breaking is stable.".into(),
        alt: "A curve that falls, turns at the fold, and rises.".into(),
        ..Figure::new("manifold", "The slow invariant manifold").with_panel(panel)
    }
}

fn boundaries() -> Figure {
    let hopf = |f: f64| 5.0 + 26.0 * gauss(f, 8.38, 0.32);
    let saddle = |f: f64| {
        hopf(f)
            + if f < 8.3036 { 1.3 * gauss(f, 8.15, 0.2) } else { 0.3 }
            + 13.0 * gauss(f, 8.42, 0.09)
            - 4.0 * gauss(f, 8.3, 0.05)
    };
    let broken = |f: f64| 1.2 + 17.0 * gauss(f, 8.3, 0.12);
    let strip = |a: f64, b: f64, fill| {
        Layer::between(&sampled(a, b, 200, hopf), &sampled(a, b, 200, saddle), fill)
    };
    let exact = |g: &dyn Fn(f64) -> f64, scale: f64| -> Vec<[f64; 2]> {
        (0..17).map(|i| 7.6 + 0.1 * f64::from(i)).map(|f| [f, scale * g(f)]).collect()
    };
    let tips = |points: Vec<[f64; 2]>, what: &str| -> Vec<MarkedPoint> {
        let tip = |[f, b]: [f64; 2]| {
            MarkedPoint::new(f, b).with_tooltip(format!("{what}: {f:.1} Hz, {b:.2} mm"))
        };
        points.into_iter().map(tip).collect()
    };
    let panel = Panel::new(
        Axis::linear("excitation frequency f (Hz)").with_range(7.4, 9.4),
        Axis::linear("clearance b (mm)").with_range(0.0, 50.0),
    )
    .with(
        strip(7.4, 8.3036, Fill::hatched(Color::Orange, Hatch::Rising))
            .labelled(Label::near("A1", [8.1, 31.0])),
    )
    .with(strip(8.3036, 9.4, Fill::hatched(Color::SkyBlue, Hatch::Falling)).labelled("A2"))
    .with(
        Layer::curve(Role::SymmetryBreaking, sampled(7.4, 9.4, 400, broken))
            .labelled("symmetry breaking"),
    )
    .with(Layer::curve(Role::Hopf, sampled(7.4, 9.4, 400, hopf)).labelled("Hopf (fold)"))
    .with(Layer::curve(Role::SaddleNode, sampled(7.4, 9.4, 400, saddle)).labelled("saddle-node"))
    .with(Layer::points(Role::SymmetryBreaking, tips(exact(&broken, 1.02), "symmetry breaking")))
    .with(
        Layer::points(Role::Hopf, tips(exact(&hopf, 0.93), "Neimark-Sacker"))
            .labelled("exact: Neimark-Sacker"),
    )
    .with(
        Layer::points(Role::SaddleNode, tips(exact(&saddle, 1.01), "orbits end"))
            .labelled("exact: orbits end"),
    )
    .with(Layer::points(Role::Stable, [MarkedPoint::new(8.3036, hopf(8.3036)).with_label("P1")]))
    .with(Layer::note([8.3, 3.0], "Z1"))
    .with(Layer::note([8.32, 8.0], "Z2"))
    .with(Layer::note([8.75, 8.0], "Z3"))
    .with(Layer::note([7.8, 30.0], "Z4"))
    .with(Layer::this_case([8.5, 20.0], Some("this case: 8.5 Hz, 20 mm".into())));
    Figure::new("boundaries", "This case among its boundaries").with_panel(panel)
}

fn response() -> Figure {
    let upper = |s: f64| 0.16 + 0.5 * gauss(s, -0.8, 1.9);
    let bare = |s: f64| 3.2 / (s * s + 0.81).sqrt();
    let simulated = (0..25)
        .map(|i| -4.0 + 0.35 * f64::from(i))
        .map(|s| [s, upper(s) * (1.0 + 0.02 * noise((s * 100.0 + 900.0) as usize))]);
    let panel = Panel::new(
        Axis::linear("detuning σ (1)").with_range(-10.0, 10.0),
        Axis::linear("amplitude C/b (1)").with_range(0.0, 1.25),
    )
    .with(
        Layer::curve(Role::BareOscillator, sampled(-10.0, 10.0, 2000, bare))
            .labelled("without absorber"),
    )
    .with(Layer::curve(Role::Unstable, sampled(-8.0, -4.0, 100, upper)))
    .with(Layer::curve(Role::Unstable, sampled(4.6, 9.0, 100, upper)))
    .with(
        Layer::curve(
            Role::Unstable,
            (0..=200)
                .map(|i| f64::from(i) / 200.0 * PI)
                .map(|t| [-0.6 + 7.4 * libm::cos(t), 0.2 + 0.75 * libm::sin(t)])
                .collect(),
        )
        .labelled("unstable"),
    )
    .with(Layer::curve(Role::Stable, sampled(-4.0, 4.6, 200, upper)).labelled("stable branch"))
    .with(Layer::points(Role::Simulation, simulated).labelled("simulation"))
    .with(Layer::rule(Rule::Horizontal(0.7348), Role::Guide.style()).labelled("symmetry breaking"));
    Figure::new("response", "Frequency response").with_panel(panel)
}

fn motion() -> Figure {
    let envelope = |t: f64| 2.0 + 1.4 * libm::cos(2.0 * PI * t / 2.1);
    let x = |t: f64| envelope(t) * libm::sin(2.0 * PI * 8.3 * t);
    let w = |t: f64| {
        let saw = 2.0 / PI * libm::asin(libm::sin(2.0 * PI * 8.3 * t + 0.6));
        11.5 * saw.clamp(-1.0, 1.0) * if envelope(t) > 1.7 { 1.0 } else { 0.83 }
    };
    let impacts = (0..80)
        .map(|k| (f64::from(k) * 0.5 + 0.25 - 0.6 / (2.0 * PI)) / 8.3)
        .filter(|t| *t > 0.0 && *t < 4.0 && envelope(*t) > 1.7);
    let impacts: Vec<MarkedPoint> = impacts
        .map(|t| MarkedPoint::new(t, w(t)).with_tooltip(format!("impact at {t:.3} s")))
        .collect();
    let time = || Axis::linear("time t (s)");
    let top = Panel::new(time(), Axis::linear("oscillator x (mm)"))
        .with(Layer::curve(Role::Simulation, sampled(0.0, 4.0, 5000, x)));
    let low = Panel::new(time(), Axis::linear("relative displacement w (mm)"))
        .with(Layer::rule(Rule::Horizontal(11.5), Role::Guide.style()))
        .with(Layer::rule(Rule::Horizontal(-11.5), Role::Guide.style()))
        .with(Layer::curve(Role::Simulation, sampled(0.0, 4.0, 5000, w)))
        .with(Layer::points(Role::Impact, impacts).labelled("impacts"));
    let [left, right, stable] = branches();
    let cycle = (0..=5000).map(|i| f64::from(i) * 0.02);
    let cycle = cycle.map(|t| {
        [
            1.1 + 0.55 * libm::cos(t) + 0.02 * noise((t * 50.0) as usize),
            0.42 + 0.26 * libm::sin(t + 0.8),
        ]
    });
    let side = Panel::new(
        Axis::linear("absorber amplitude B/b (1)").with_range(0.0, 2.5),
        Axis::linear("oscillator amplitude C/b (1)").with_range(0.0, 1.6),
    )
    .with(Layer::curve(Role::Simulation, cycle.collect()).labelled("motion"))
    .with(left)
    .with(right)
    .with(stable)
    .with_heading("projection");
    Figure::new("motion", "A modulated response")
        .with_size(860, 420)
        .with_layout(Layout::cells(
            &[1.15, 1.0],
            &[1.0, 1.0],
            &[[0, 0, 1, 1], [0, 1, 1, 1], [1, 0, 1, 2]],
        ))
        .with_panel(top.with_heading("time series"))
        .with_panel(low)
        .with_panel(side)
}

fn return_map() -> Figure {
    let point = |i: usize| {
        let (x, y) = (0.5 + 0.42 * noise(i), 0.5 + 0.3 * noise(7 * i + 3));
        if i.is_multiple_of(3) {
            [x, 1.0 - x + 0.03 * noise(i + 11)]
        } else if i % 3 == 1 {
            [x, x + 0.04 * y]
        } else {
            [x, y]
        }
    };
    let line = Role::Guide.style().colored(Color::Grey);
    let sloped = |through, slope| Layer::rule(Rule::Sloped { through, slope }, line);
    let axis = |label: &str| Axis::linear(label).with_range(0.0, 1.3);
    let panel = Panel::new(axis("Δtₖ / T (1)"), axis("Δtₖ₊₁ / T (1)"))
        .with(sloped([0.0, 1.0], -1.0).labelled("L1"))
        .with(Layer::rule(Rule::Vertical(1.0), line).labelled("L2"))
        .with(Layer::rule(Rule::Horizontal(1.0), line).labelled("L3"))
        .with(sloped([0.0, 0.0], 1.0).labelled(Label::near("L4", [1.2, 1.2])))
        .with(
            Layer::marked(Marker::dot(), Role::Simulation.color(), (0..400).map(point))
                .labelled("simulated pairs of impacts"),
        )
        .with_equal_aspect();
    Figure::new("return-map", "Return map of the times between impacts")
        .with_size(480, 450)
        .with_panel(panel)
}

fn map_crowded() -> Figure {
    let family = [3.0, 1.6, 1.1, 0.7].into_iter().zip([
        Color::Black,
        Color::Vermillion,
        Color::BluishGreen,
        Color::Blue,
    ]);
    let mut panel = Panel::new(Axis::linear("detuning σ (1)"), Axis::linear("amplitude C/b (1)"));
    for (gamma, color) in family {
        let curve =
            sampled(-10.0, 10.0, 500, |s| 0.16 + 0.4 * gamma * gauss(s, 0.3 - 0.5 * gamma, gamma));
        panel = panel.with(
            Layer::curve(Role::Stable.style().colored(color), curve)
                .labelled(format!("G/b = {gamma}")),
        );
    }
    let wave = |k: usize| {
        Layer::curve(
            Role::Simulation,
            sampled(-10.0, 10.0, 4000, move |s| 0.7 + 0.65 * libm::sin(s * (31.0 + k as f64))),
        )
    };
    let full = Panel::new(Axis::linear("time t (ms)"), Axis::linear("acceleration a (m/s²)"))
        .with(wave(0).labelled("measured"))
        .with(wave(1).labelled("simulated"))
        .with(
            Layer::curve(Role::Forcing, sampled(-10.0, 10.0, 300, |s| 0.7 + 0.3 * libm::sin(s)))
                .labelled("forcing"),
        );
    Figure::new("crowded", "Two panels side by side")
        .with_panel(panel.with_heading("(a) family of responses"))
        .with_panel(full.with_heading("(b) no room for names"))
}

fn loglog() -> Figure {
    let rk = (0..8)
        .map(|i| libm::pow(10.0, -0.5 * f64::from(i) - 1.0))
        .map(|h| [h, 0.3 * h * h * h * h + 3e-14 / h]);
    let event = (0..8)
        .map(|i| libm::pow(10.0, -0.5 * f64::from(i) - 1.0))
        .map(|h| [h, 2e-15 * (1.0 + 0.3 / h.sqrt())]);
    let (rk, event): (Vec<[f64; 2]>, Vec<[f64; 2]>) = (rk.collect(), event.collect());
    let style = Style::new(Color::Vermillion, 1.4, vinesink::report::figure::Dash::Dashed);
    let panel = Panel::new(Axis::log("step Δτ (1)"), Axis::log("error of x (1)"))
        .with(Layer::curve(style, rk.clone()).labelled("fixed step, order 4"))
        .with(Layer::points(Role::SaddleNode, rk))
        .with(
            Layer::curve(
                Style::new(Color::Blue, 1.4, vinesink::report::figure::Dash::Solid),
                event.clone(),
            )
            .labelled("closed form between events"),
        )
        .with(Layer::points(Role::Hopf, event));
    Figure::new("loglog", "Error against step").with_panel(panel)
}

fn decay() -> Figure {
    let time = || Axis::linear("time t (s)");
    let wave = |a: f64| move |t: f64| a * libm::exp(-0.4 * t) * libm::sin(40.0 * t);
    let panel = |label: &str, a: f64| {
        Panel::new(time(), Axis::linear(label))
            .with(Layer::curve(Role::Simulation, sampled(0.0, 8.0, 20_000, wave(a))))
    };
    Figure::new("decay", "Three quantities over one time")
        .with_layout(Layout::rows(&[1.0; 3]))
        .with_panel(
            panel("displacement x (mm)", 3.2).with(
                Layer::rule(Rule::Vertical(2.0), Role::Guide.style()).labelled("impacts end"),
            ),
        )
        .with_panel(panel("velocity v (m/s)", 0.16))
        .with_panel(panel("energy flow P (W)", 2.4e-5))
}
