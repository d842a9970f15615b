//! The page of a sweep: words, tables and figures on tables that are made by hand and counted by hand.

mod common;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use vinesink::analysis::Analysis;
use vinesink::case::{Case, SweepAxis, SweepParameter};
use vinesink::orbits::attracting_orbit;
use vinesink::regimes::Regime;
use vinesink::report::figure::{
    Axis, Cells, Figure, Image, Label, Layer, Panel, Ramp, Rect, Rule, Scale, Tint, draw, edges,
    render,
};
use vinesink::report::render;
use vinesink::report::sweep::{AxisShown, SweepPage, Swept, SweptError, tint};
use vinesink::sweep::columns::{Column, Values};

/// Table 1 of Li, Seguy, Berlioz (2016) at 8.35 Hz and 20 mm.
fn case() -> Case {
    Case::parse("map.toml", common::table_1_case()).unwrap_or_else(|error| panic!("{error:?}"))
}

fn numbers(name: &'static str, values: &[Option<f64>]) -> Column {
    Column { name: name.to_owned(), unit: "1", values: Values::Number(values.to_vec()) }
}

fn all(name: &'static str, values: &[f64]) -> Column {
    numbers(name, &values.iter().map(|value| Some(*value)).collect::<Vec<_>>())
}

fn texts(name: &'static str, values: &[&'static str]) -> Column {
    let values = values.iter().map(|value| (!value.is_empty()).then_some(*value)).collect();
    Column { name: name.to_owned(), unit: "", values: Values::Text(values) }
}

fn counts(name: &'static str, values: &[i64]) -> Column {
    Column {
        name: name.to_owned(),
        unit: "1",
        values: Values::Whole(values.iter().map(|value| Some(*value)).collect()),
    }
}

fn swept<'a>(case: &'a Case, axes: Vec<AxisShown>, columns: &'a [Column]) -> Swept<'a> {
    let results_sha256 = "f".repeat(64);
    Swept { case, axes, columns, starts: 4, periods: 100, results_sha256 }
}

/// All files of the page, as text.
fn files(swept: &Swept) -> BTreeMap<PathBuf, String> {
    let figures = swept.figures().expect("figures");
    let page = SweepPage::new("map", swept, &figures).expect("a page");
    let files = render::sweep(&page, &figures).expect("rendered");
    files
        .into_iter()
        .map(|(path, bytes)| (path, String::from_utf8(bytes).expect("UTF-8")))
        .collect()
}

fn markdown(swept: &Swept) -> String {
    files(swept).remove(Path::new("sweep.md")).expect("a page")
}

const SYM: &str = Regime::TwoSymmetric.key();
const ASY: &str = Regime::TwoAsymmetric.key();
const SMR: &str = Regime::StronglyModulated.key();
const LOW: &str = Regime::BelowTwo.key();

/// Two clearances by four frequencies; the last point could not be worked out.
fn small_columns() -> Vec<Column> {
    let none = None;
    vec![
        texts("area", &["Z3", "Z3", "Z3", "Z4", "Z1|Z2", "Z3", "Z4", "Z4"]),
        texts("regime", &[SYM, SYM, SMR, LOW, ASY, SYM, SMR, ""]),
        numbers(
            "peak",
            &[
                Some(2e-3),
                Some(3e-3),
                Some(4e-3),
                Some(5e-3),
                Some(6e-3),
                Some(1e-3),
                Some(8e-3),
                none,
            ],
        ),
        numbers(
            "reduction_db",
            &[
                Some(3.0),
                Some(2.0),
                Some(-1.0),
                Some(-2.0),
                Some(0.5),
                Some(6.25),
                Some(-3.5),
                none,
            ],
        ),
        numbers(
            "orbit_peak",
            &[Some(2e-3), Some(3e-3), Some(4e-3), none, Some(6e-3), Some(1e-3), none, none],
        ),
        counts("motions", &[1, 2, 1, 1, 2, 3, 1, 0]),
    ]
}

fn axis(case: &Case, parameter: SweepParameter, values: &[f64]) -> AxisShown {
    let axis = SweepAxis { parameter, values: values.to_vec(), logarithmic: false };
    AxisShown::of(case, &axis)
}

fn small_axes(case: &Case) -> Vec<AxisShown> {
    vec![
        axis(case, SweepParameter::Clearance, &[0.01, 0.02]),
        axis(case, SweepParameter::Frequency, &[8.0, 8.2, 8.4, 8.6]),
    ]
}

#[test]
fn shares_and_places_are_those_counted_by_hand() {
    let case = case();
    let columns = small_columns();
    let text = markdown(&swept(&case, small_axes(&case), &columns));
    for line in [
        // 3 of 7 points with a motion; the best is the sixth point.
        "> **Two symmetric impacts per period over 42.9 % of the map. Vibration falls by up to 6.25 dB, at clearance 20.0 mm, frequency 8.20 Hz.**",
        "> Beside it: strongly modulated response 28.6 %; two asymmetric impacts per period 14.3 %; fewer than two impacts per period 14.3 %.",
        // 4 of 7 are above 0.
        "> The absorber reduces the peak at 57.1 % of the points; the peak grows most, by 3.50 dB, at clearance 20.0 mm, frequency 8.40 Hz.",
        "> Several motions coexist at 42.9 % of the points (up to 3 at a point), within frequency from 8.00 Hz to 8.20 Hz.",
        // 3 of 4 in Z3; none of the 3 others that have a motion.
        "> In area Z3, where the theory has steady 1:1 resonance, two symmetric impacts per period are the main motion at 75.0 % of the points, outside of it at 0 %.",
        // 5 of 7; 3 of these 5; the third point has one motion only, and another; of the fifth nothing is known.
        "> An exact 1:1 orbit attracts at 71.4 % of the points; two symmetric impacts per period are the main motion at 60.0 % of these; at 20.0 % no start led to it.",
        "| two symmetric impacts per period | 42.9 % | 1.00 to 3.00 mm | 2.00 to 6.25 dB |",
        "| strongly modulated response | 28.6 % | 4.00 to 8.00 mm | −3.50 to −1.00 dB |",
        "| Where | Points | asymmetric | symmetric 1:1 | strongly modulated | z < 2 |",
        "| area Z1 or Z2 | 1 | 100 % | 0 % | 0 % | 0 % |",
        "| area Z3 | 4 | 0 % | 75.0 % | 25.0 % | 0 % |",
        "| area Z4 | 2 | 0 % | 0 % | 50.0 % | 50.0 % |",
        "| exact 1:1 orbit attracts | 5 | 20.0 % | 60.0 % | 20.0 % | 0 % |",
        "| none attracts | 2 | 0 % | 0 % | 50.0 % | 50.0 % |",
        "2 × 4 = 8 points: clearance from 10.0 mm to 20.0 mm (2 values, even); frequency from 8.00 Hz to 8.60 Hz (4 values, even).",
        "1 of 8 points have no motion: their numbers leave no valid system, or nothing could be measured.",
    ] {
        assert!(text.lines().any(|one| one == line), "{line}\nis not in\n{text}");
    }
}

#[test]
fn numbers_behind_the_words_are_in_the_document() {
    let case = case();
    let columns = small_columns();
    let files = files(&swept(&case, small_axes(&case), &columns));
    let document: serde_json::Value =
        serde_json::from_str(&files[Path::new("sweep.json")]).expect("JSON");
    assert_eq!(document["format"], "vinesink/sweep@1");
    let motions = &document["motions"][0];
    assert_eq!(motions["worked_out"], 7);
    assert_eq!(motions["best"]["value"], 6.25);
    assert_eq!(motions["best"]["at"], serde_json::json!([20.0, 8.2]));
    assert_eq!(motions["regimes"][1]["regime"], "two-symmetric");
    assert_eq!(motions["regimes"][1]["points"], 3);
    assert_eq!(motions["orbit_missed"], 1);
}

/// An image of a drawing: its place in tenths of a pixel (x, y, width, height) and its colours, row by row from
/// the top.
struct Shown {
    place: [f64; 4],
    rows: Vec<Vec<Tint>>,
}

fn shown(svg: &str) -> Vec<Shown> {
    let images = svg.split("<image ").skip(1);
    images
        .map(|image| {
            let attribute = |name: &str| {
                let (_, rest) = image.split_once(&format!("{name}=\"")).expect(name);
                rest.split('"').next().expect("ended")
            };
            let length = |name| attribute(name).parse().expect("a length");
            let place = ["x", "y", "width", "height"].map(length);
            let data = attribute("href").strip_prefix("data:image/png;base64,").expect("a PNG");
            let file = STANDARD.decode(data).expect("base 64");
            let mut decoder = png::Decoder::new(std::io::Cursor::new(file));
            decoder.set_transformations(png::Transformations::EXPAND);
            let mut reader = decoder.read_info().expect("a PNG");
            let mut pixels = vec![0; reader.output_buffer_size().expect("small")];
            let info = reader.next_frame(&mut pixels).expect("pixels");
            assert_eq!(info.color_type, png::ColorType::Rgb);
            let row = |row: &[u8]| row.chunks(3).map(|p| Tint([p[0], p[1], p[2]])).collect();
            Shown { place, rows: pixels.chunks(info.line_size).map(row).collect() }
        })
        .collect()
}

fn regime_rows() -> Vec<Vec<Tint>> {
    use Regime::{BelowTwo, StronglyModulated, TwoAsymmetric, TwoSymmetric};
    vec![
        // The larger clearance is above.
        vec![tint(TwoAsymmetric), tint(TwoSymmetric), tint(StronglyModulated), Tint::UNKNOWN],
        vec![tint(TwoSymmetric), tint(TwoSymmetric), tint(StronglyModulated), tint(BelowTwo)],
    ]
}

#[test]
fn every_pixel_has_the_colour_of_its_point() {
    let case = case();
    let columns = small_columns();
    let files = files(&swept(&case, small_axes(&case), &columns));
    let svg = &files[Path::new("figures/sweep-regimes.svg")];
    let images = shown(svg);
    assert_eq!(images.len(), 1);
    assert_eq!(images[0].rows, regime_rows());
    assert!(svg.contains("image-rendering=\"pixelated\""));
    for words in ["two symmetric impacts per period", "not worked out"] {
        assert!(svg.contains(&format!(">{words}</text>")), "no key for {words}");
    }
    assert!(!svg.contains("more than two impacts"), "a key for what is nowhere");
    // The same in blocks below, for viewers that refuse the image: here each point is one.
    let blocks = |tint: Tint| {
        let (before, _) =
            svg.split_once(&format!("\" fill=\"{}\" shape-", tint.hex())).expect("drawn");
        before.rsplit_once("<path d=\"").expect("a path").1.matches('M').count()
    };
    // A run of neighbours in a row is one block.
    assert_eq!([Regime::TwoSymmetric, Regime::BelowTwo].map(|one| blocks(tint(one))), [2, 1]);
    let html = &files[Path::new("sweep.html")];
    assert!(html.contains("<image ") && !html.contains("src=\""), "one file, nothing beside it");
}

/// With the axes the other way round the table is another and the map the same.
#[test]
fn the_order_of_the_axes_does_not_turn_the_map() {
    let case = case();
    let columns = [texts("regime", &[SYM, ASY, SYM, SYM, SMR, SMR, LOW, ""])];
    let mut axes = small_axes(&case);
    axes.reverse();
    let files = files(&swept(&case, axes, &columns));
    let svg = &files[Path::new("figures/sweep-regimes.svg")];
    assert_eq!(shown(svg)[0].rows, regime_rows());
    assert!(svg.contains(">frequency f (Hz)</text>") || svg.contains("frequency f (Hz)"));
}

/// Name, symbol, unit, and the case's own value in that unit.
#[test]
fn an_axis_is_shown_in_the_terms_of_its_design() {
    use SweepParameter as P;
    let forced = common::table_1_case()
        .replace("base-displacement", "force")
        .replace("amplitude = \"0.25 mm\"", "amplitude = \"2.9 N\"");
    let reduced = "title = \"r\"\nsource = \"made up\"\n[reduced]\nmass_ratio = 0.0077\ndamping = 1.8\n\
                   restitution = 0.6\nforcing = 3.1\nclearance = 1.3\ndetuning = -1.5\n";
    let parse = |text: &str| Case::parse("map.toml", text).unwrap_or_else(|e| panic!("{e:?}"));
    let (base, forced, reduced) = (case(), parse(&forced), parse(reduced));
    let damping_ratio = 302.0 / (2.0 * (11_470.0 * 4.168_f64).sqrt());
    for (case, parameter, value, label, own) in [
        (&base, P::Clearance, 0.02, "clearance b (mm)", Some(20.0)),
        (&base, P::Frequency, 8.0, "frequency f (Hz)", Some(8.35)),
        (&base, P::Amplitude, 1e-3, "base displacement F (mm)", Some(0.25)),
        (&forced, P::Amplitude, 1.0, "force P (N)", Some(2.9)),
        (&base, P::Restitution, 0.5, "restitution r (1)", Some(0.6)),
        (&base, P::AbsorberMass, 0.05, "absorber mass m₂ (g)", Some(32.0)),
        (&base, P::AbsorberMass, 1.5, "absorber mass m₂ (kg)", Some(0.032)),
        (&base, P::MassRatio, 0.01, "mass ratio ε (%)", Some(3.2 / 4.168)),
        (&base, P::Mass, 0.5, "oscillator mass m₁ (kg)", Some(4.168)),
        (&base, P::Stiffness, 1e4, "stiffness k₁ (kN/m)", Some(11.47)),
        (&base, P::Stiffness, 900.0, "stiffness k₁ (N/m)", Some(11_470.0)),
        (&base, P::Damping, 1.0, "damping c₁ (N s/m)", Some(3.02)),
        (&base, P::DampingRatio, 0.01, "damping ratio ζ (%)", Some(damping_ratio)),
        (&base, P::InitialDisplacement, -0.01, "initial displacement x (mm)", None),
        (&base, P::InitialVelocity, 0.5, "initial velocity ẋ (m/s)", None),
        (
            &base,
            P::InitialAbsorberDisplacement,
            0.01,
            "initial displacement of the absorber y (mm)",
            None,
        ),
        (&base, P::InitialAbsorberVelocity, 0.5, "initial velocity of the absorber ẏ (m/s)", None),
        (&reduced, P::Clearance, 1.0, "clearance b (units)", Some(1.3)),
        (&reduced, P::Frequency, 1.0, "frequency ratio Ω (1)", Some(1.0 - 1.5 * 0.0077)),
        (&reduced, P::Detuning, 1.0, "detuning σ (1)", Some(-1.5)),
        (&reduced, P::Amplitude, 2.0, "reduced forcing G (units)", Some(3.1)),
        (&reduced, P::Damping, 1.0, "damping λ (1)", Some(1.8)),
        (&reduced, P::InitialDisplacement, 0.5, "initial displacement x (units)", None),
        (&reduced, P::InitialVelocity, 0.5, "initial velocity ẋ (1)", None),
    ] {
        let shown = axis(case, parameter, &[value]);
        assert_eq!(shown.label, label);
        // Rounded a few times on the way to the unit.
        let near = own.zip(shown.own).map(|(a, b): (f64, f64)| (a - b).abs() <= 1e-14 * a.abs());
        assert!(near.unwrap_or(own == shown.own), "{label}: {:?}", shown.own);
        assert_eq!(shown.is_initial(), own.is_none(), "{label}");
        let json = serde_json::to_value(&shown).expect("JSON");
        assert_eq!(json["key"], parameter.key());
    }
}

/// Values that are not evenly spread have cells that end midway between them; on a logarithmic axis, at the
/// geometric mean.
#[test]
fn uneven_cells_end_midway() {
    assert_eq!(edges(&[1.0, 2.0, 4.0], Scale::Linear), [0.5, 1.5, 3.0, 5.0]);
    let log = edges(&[1.0, 4.0, 16.0], Scale::Log);
    for (found, wanted) in log.iter().zip([0.5, 2.0, 8.0, 32.0]) {
        // Through a logarithm and back.
        assert!((found / wanted - 1.0).abs() < 1e-14, "{log:?}");
    }
    assert_eq!(edges(&[5.0], Scale::Linear), [4.5, 5.5]);
    let tints = vec![Tint([10, 20, 30]), Tint([200, 100, 50]), Tint([0, 200, 0])];
    let draw = |x_edges: &[f64], log: bool| {
        let (first, last) = (x_edges[0], x_edges[3]);
        let x = if log { Axis::log("x (1)") } else { Axis::linear("x (1)") };
        let image = Image {
            x_edges: x_edges.to_vec(),
            y_edges: vec![0.0, 1.0],
            cells: Cells::Kinds(tints.clone(), vec![Some(0), Some(1), Some(2)]),
        };
        let y = Axis::linear("y (1)").with_range(0.0, 1.0);
        let panel = Panel::new(x.with_range(first, last), y).with(Layer::Image(image));
        let svg = render(&Figure::new("cells", "Cells").with_panel(panel)).expect("drawn");
        shown(&svg).remove(0)
    };
    let uneven = draw(&[0.5, 1.5, 3.0, 5.0], false);
    let row = &uneven.rows[0];
    let count = |tint: Tint| row.iter().filter(|one| **one == tint).count() as f64;
    for (tint, wide) in tints.iter().zip([1.0, 1.5, 2.0]) {
        let pixels = wide / 4.5 * row.len() as f64;
        // A boundary falls between two pixels of the image.
        assert!((count(*tint) - pixels).abs() <= 1.0, "{wide}: {} {pixels}", count(*tint));
    }
    assert!(row.len() > 800, "finer than the drawing");
    let even = draw(&log, true);
    assert_eq!(
        even.rows,
        std::slice::from_ref(&tints),
        "one pixel a cell where cells are even on the axis"
    );
    assert_eq!(even.place, uneven.place);
}

#[test]
fn a_value_has_the_colour_of_its_ramp_and_a_bar_beside_it() {
    let case = case();
    let columns = small_columns();
    let files = files(&swept(&case, small_axes(&case), &columns));
    let images = shown(&files[Path::new("figures/sweep-reduction.svg")]);
    assert_eq!(images.len(), 2, "map and bar");
    let near = |a: Tint, value: f64| {
        let b = Ramp::Diverging.tint(value, (-3.5, 6.25));
        // A colour is that of the middle of its level, half a 128th of the range away: some 0.6 in CIELAB, which is
        // up to three steps of red where there is least of it.
        (0..3).all(|k| a.0[k].abs_diff(b.0[k]) <= 3)
    };
    assert!(near(images[0].rows[0][1], 6.25), "{:?}", images[0].rows);
    assert!(near(images[0].rows[1][0], 3.0) && near(images[0].rows[0][2], -3.5));
    assert_eq!(images[0].rows[0][3], Tint::UNKNOWN);
    assert!(near(images[1].rows[0][0], 6.25), "the bar's upper end");
    assert_eq!((images[1].rows.len(), images[1].rows[0].len()), (128, 1));
}

/// Whatever is not recorded is not drawn and not told, and nothing fails.
#[test]
fn any_column_may_be_missing_or_empty() {
    let case = case();
    let columns = small_columns();
    for left_out in 0..columns.len() {
        let name = columns[left_out].name.clone();
        let some: Vec<Column> = columns.iter().filter(|one| one.name != name).cloned().collect();
        let found = files(&swept(&case, small_axes(&case), &some));
        let has =
            |figure: &str| found.contains_key(Path::new(&format!("figures/sweep-{figure}.svg")));
        assert_eq!(has("regimes"), name != "regime");
        assert_eq!(has("areas"), name == "regime");
        assert_eq!(has("amplitude"), name != "peak");
        assert_eq!(has("reduction"), name != "reduction_db");
        assert_eq!(has("motions"), name != "motions");
        let text = &found[Path::new("sweep.md")];
        assert_eq!(
            text.contains("In area Z3"),
            !["area", "regime"].contains(&name.as_str()),
            "{name}"
        );
        assert_eq!(text.contains("coexist"), name != "motions", "{name}");
        assert!(text.contains("8 points"), "{name}");
    }
    let theory = [columns[0].clone()];
    let text = markdown(&swept(&case, small_axes(&case), &theory));
    assert!(text.contains("> **By theory 50.0 % of the map is area Z3.**"), "{text}");
    let nothing = markdown(&swept(&case, small_axes(&case), &[]));
    assert!(nothing.contains("> **8 points.**"), "{nothing}");
    let empty = [texts("regime", &[""; 8]), numbers("peak", &[None; 8])];
    let text = markdown(&swept(&case, small_axes(&case), &empty));
    assert!(
        text.contains("8 of 8 points have no motion") || text.contains("> **8 points.**"),
        "{text}"
    );
}

#[test]
fn a_column_of_another_sweep_is_refused() {
    let case = case();
    let columns = [all("peak", &[1.0; 7])];
    let error = swept(&case, small_axes(&case), &columns).figures().expect_err("too short");
    assert_eq!(error.to_string(), "the column `peak` has 7 values, and the axes make 8 points");
    let none = swept(&case, Vec::new(), &[]).figures().expect_err("nothing varies");
    assert!(matches!(none, SweptError::Empty));
}

#[test]
fn one_axis_is_told_in_stretches() {
    let case = case();
    let clearances = [0.01, 0.012, 0.014, 0.016, 0.018, 0.02];
    let columns = [
        texts("regime", &[ASY, ASY, SYM, SYM, SYM, SMR]),
        all("peak", &[6e-3, 5e-3, 4e-3, 3e-3, 2e-3, 9e-3]),
        numbers("orbit_peak", &[None, None, Some(4e-3), Some(3e-3), Some(2e-3), None]),
        all("section_01", &[1e-3; 6]),
        all("section_02", &[2e-3; 6]),
    ];
    let axes = vec![axis(&case, SweepParameter::Clearance, &clearances)];
    let found = files(&swept(&case, axes, &columns));
    let text = &found[Path::new("sweep.md")];
    for line in [
        "> **Two symmetric impacts per period over 50.0 % of the range. The smallest peak is 2.00 mm, at clearance 18.0 mm.**",
        "| 10.0 mm | 12.0 mm | 2 | two asymmetric impacts per period | 5.00 to 6.00 mm |",
        "| 14.0 mm | 18.0 mm | 3 | two symmetric impacts per period | 2.00 to 4.00 mm |",
        "| 20.0 mm | 20.0 mm | 1 | strongly modulated response | 9.00 mm |",
    ] {
        assert!(text.lines().any(|one| one == line), "{line}\nis not in\n{text}");
    }
    assert!(found.contains_key(Path::new("figures/sweep-bifurcation.svg")));
    assert!(found.contains_key(Path::new("figures/sweep-section.svg")));
    assert!(!found.contains_key(Path::new("figures/sweep-regimes.svg")));
}

#[test]
fn what_was_followed_up_and_down_shows_its_hysteresis() {
    let case = case();
    let columns = [
        texts("regime_up", &[SYM, SYM, SYM, SYM, SMR, SMR]),
        texts("regime_down", &[SYM, SYM, SMR, SMR, SMR, SMR]),
        all("peak_up", &[1e-3, 2e-3, 3e-3, 4e-3, 9e-3, 8e-3]),
        // A motion that does not repeat has another peak each time; one per cent is what a transient leaves.
        all("peak_down", &[1.01e-3, 2e-3, 7e-3, 7e-3, 5e-3, 4e-3]),
    ];
    let values = [8.0, 8.1, 8.2, 8.3, 8.4, 8.5];
    let axes = vec![axis(&case, SweepParameter::Frequency, &values)];
    let found = files(&swept(&case, axes.clone(), &columns));
    let text = &found[Path::new("sweep.md")];
    let line = "> Hysteresis: from 8.20 Hz to 8.30 Hz two symmetric impacts per period (peak 3.00 mm) up, strongly modulated response (peak 7.00 mm) down.";
    assert!(text.lines().any(|one| one == line), "{text}");
    assert!(text.contains("over 66.7 % of the range on the way up."), "{text}");
    let strip = shown(&found[Path::new("figures/sweep-bifurcation.svg")]);
    let (a, b) = (tint(Regime::TwoSymmetric), tint(Regime::StronglyModulated));
    assert_eq!(strip[0].rows, [[a, a, a, a, b, b], [a, a, b, b, b, b]], "up above down");
    let two = swept(&case, axes.clone(), &columns);
    let names: Vec<(f64, Option<String>)> = {
        let strip = &figure(&two, "sweep-bifurcation").panels[1];
        let ticks = strip.y.ticks.clone().expect("named rows");
        ticks.into_iter().map(|tick| (tick.value, tick.label)).collect()
    };
    assert_eq!(names, [(0.5, Some("down".to_owned())), (1.5, Some("up".to_owned()))]);
    // Over two axes, a panel for each way.
    let axes = vec![
        axis(&case, SweepParameter::Clearance, &[0.01, 0.02]),
        axis(&case, SweepParameter::Frequency, &values[..3]),
    ];
    let found = files(&swept(&case, axes, &columns));
    let maps = shown(&found[Path::new("figures/sweep-regimes.svg")]);
    assert_eq!(maps.len(), 2);
    assert_eq!(maps[0].rows, [[a, b, b], [a, a, a]]);
    assert_eq!(maps[1].rows, [[b, b, b], [a, a, b]]);
    let text = &found[Path::new("sweep.md")];
    assert!(text.contains("motions differ at 33.3 % of the points (hysteresis)"), "{text}");
}

#[test]
fn of_three_axes_some_slices_are_shown() {
    let case = case();
    let restitutions: Vec<f64> = (0..11).map(|k| 0.4 + 0.05 * f64::from(k)).collect();
    let mut axes = vec![axis(&case, SweepParameter::Restitution, &restitutions)];
    axes.extend(small_axes(&case));
    // Each slice is one regime: even ones symmetric, odd ones not.
    let regimes: Vec<&'static str> =
        (0..88).map(|point| if point / 8 % 2 == 0 { SYM } else { LOW }).collect();
    let columns = [texts("regime", &regimes), texts("area", &["Z3"; 88])];
    let found = files(&swept(&case, axes, &columns));
    let svg = &found[Path::new("figures/sweep-regimes.svg")];
    let maps = shown(svg);
    assert_eq!(maps.len(), 6);
    for map in &maps {
        // Slices 0, 2, 4, 6, 8 and 10.
        assert!(map.rows.iter().flatten().all(|one| *one == tint(Regime::TwoSymmetric)));
    }
    let text = &found[Path::new("sweep.md")];
    assert!(text.contains("6 of 11 values of restitution are shown, evenly chosen."), "{text}");
    for words in ["restitution 0.400", "restitution 0.900"] {
        assert!(svg.contains(words), "{words}");
    }
}

#[test]
fn a_map_of_starts_is_one_of_basins() {
    let case = case();
    let axes = vec![
        axis(&case, SweepParameter::InitialDisplacement, &[-0.01, 0.0, 0.01]),
        axis(&case, SweepParameter::InitialVelocity, &[-0.5, 0.5]),
    ];
    let columns = [
        texts("regime", &[SYM, SYM, SYM, SMR, SYM, SMR]),
        all("reduction_db", &[3.0; 6]),
        texts("area", &["Z3"; 6]),
    ];
    let found = files(&swept(&case, axes, &columns));
    let text = &found[Path::new("sweep.md")];
    assert!(
        text.contains("> **Two symmetric impacts per period over 66.7 % of the starts.**"),
        "{text}"
    );
    assert!(
        text.contains("Each point is a start; its colour is the regime that it leads to."),
        "{text}"
    );
    let svg = &found[Path::new("figures/sweep-regimes.svg")];
    assert!(svg.contains(
        "<title>Basins of attraction over initial displacement and initial velocity</title>"
    ));
    let (a, b) = (tint(Regime::TwoSymmetric), tint(Regime::StronglyModulated));
    assert_eq!(shown(svg)[0].rows, [[a, b, b], [a, a, a]]);
    assert!(!svg.contains("not worked out"), "a key for what is nowhere");
}

fn figure(swept: &Swept, name: &str) -> Figure {
    let all = swept.figures().expect("figures");
    all.into_iter().find(|figure| figure.name == name).expect(name)
}

/// The points of a layer with a name, finite ones only; several layers may have it.
fn drawn(panel: &Panel, name: &str) -> Vec<[f64; 2]> {
    let is = |label: &Option<Label>| label.as_ref().is_some_and(|label| label.text == name);
    let points = panel.layers.iter().flat_map(|layer| match layer {
        Layer::Curve { points, label, .. } if is(label) => points.clone(),
        Layer::Points { points, label, .. } if is(label) => {
            points.iter().map(|point| [point.x, point.y]).collect()
        }
        _ => Vec::new(),
    });
    points.filter(|point| point.iter().all(|part| part.is_finite())).collect()
}

/// As the values of a ramp: their range and the cells, row by row from below.
fn values(panel: &Panel) -> ((f64, f64), Vec<Option<f64>>) {
    let image = panel.layers.iter().find_map(|layer| match layer {
        Layer::Image(Image { cells: Cells::Values(_, range, cells), .. }) => Some((*range, cells)),
        _ => None,
    });
    let (range, cells) = image.expect("a map of values");
    (range, cells.clone())
}

/// Cells, range and bar of a length are in the unit that is written beside them.
#[test]
fn a_map_of_lengths_is_in_the_unit_of_its_bar() {
    let case = case();
    let columns = small_columns();
    let swept = swept(&case, small_axes(&case), &columns);
    let amplitude = figure(&swept, "sweep-amplitude");
    let [map, bar] = amplitude.panels.as_slice() else { panic!("map and bar") };
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-12 * b.abs();
    let ((low, high), cells) = values(map);
    assert!(near(low, 1.0) && near(high, 8.0), "{low} {high}");
    let wanted = [2.0, 3.0, 4.0, 5.0, 6.0, 1.0, 8.0].map(Some).into_iter().chain([None]);
    for (found, wanted) in cells.iter().zip(wanted) {
        assert!(found.zip(wanted).map_or(*found == wanted, |(a, b)| near(a, b)), "{cells:?}");
    }
    assert_eq!(bar.y.label, "peak displacement (mm)");
    assert_eq!((bar.y.range, values(bar).0), (Some((low, high)), (low, high)));
    let rising = values(bar).1;
    assert!(rising.windows(2).all(|pair| pair[0] < pair[1]), "{rising:?}");
    let keys: Vec<&str> = amplitude.keys.iter().map(|key| key.label.as_str()).collect();
    assert_eq!(keys, ["no value"]);
    assert!(!amplitude.caption.contains("most extreme"), "nothing is cut");
}

/// What a reader is told where a few values lie far beyond the others.
#[test]
fn values_that_are_cut_are_told() {
    let case = case();
    let peaks: Vec<f64> = (0..400).map(|k| 1e-3 * (1.0 + f64::from(k % 20) / 20.0)).collect();
    let mut far = peaks.clone();
    far[123] = 1.0;
    let values = |count: u32, from: f64| -> Vec<f64> {
        (0..count).map(|k| from * (1.0 + 0.001 * f64::from(k))).collect()
    };
    for (peaks, cut) in [(peaks, false), (far, true)] {
        let columns = [all("peak", &peaks)];
        let axes = vec![
            axis(&case, SweepParameter::Clearance, &values(20, 0.01)),
            axis(&case, SweepParameter::Frequency, &values(20, 8.0)),
        ];
        let caption = figure(&swept(&case, axes, &columns), "sweep-amplitude").caption;
        assert_eq!(caption.contains("The most extreme values"), cut, "{caption}");
    }
}

/// The theory's lines part areas, and the exact orbit's limits are those of its clearance: both by the layers,
/// at their places on the map.
#[test]
fn boundaries_lie_where_the_theory_has_them() {
    let case = case();
    let columns = small_columns();
    let axes = vec![
        axis(&case, SweepParameter::Clearance, &[0.005, 0.01, 0.02, 0.03]),
        axis(&case, SweepParameter::Frequency, &[8.0, 8.7]),
    ];
    let map = figure(&swept(&case, axes, &columns), "sweep-regimes").panels.remove(0);
    // The case's frequency and clearance are 8.35 Hz and 20 mm.
    let at = |[frequency, clearance]: [f64; 2]| {
        let there = case.system().with_clearance_scaled(clearance / 20.0).expect("valid");
        let ratio = there.frequency_ratio() * frequency / 8.35;
        there.with_frequency_ratio(ratio).expect("valid")
    };
    let zone = |place: [f64; 2]| Analysis::of(&at(place)).expect("solved").zone;
    for name in ["Hopf", "symmetry breaking"] {
        let line = drawn(&map, name);
        assert!(line.len() > 50, "{name}: {}", line.len());
        let parts = |place: &&[f64; 2]| {
            let [frequency, clearance] = **place;
            zone([frequency, 0.999 * clearance]) != zone([frequency, 1.001 * clearance])
        };
        let parting = line.iter().filter(parts).count();
        assert_eq!(parting, line.len(), "{name}");
    }
    let limits = drawn(&map, "exact limits");
    assert!(limits.len() > 20, "{limits:?}");
    for [frequency, clearance] in limits {
        let attracts =
            |factor: f64| attracting_orbit(&at([frequency, factor * clearance])).is_some();
        assert_ne!(attracts(0.999), attracts(1.001), "{frequency} {clearance}");
    }
    let stars: Vec<[f64; 2]> = map
        .layers
        .iter()
        .filter_map(|layer| match layer {
            Layer::ThisCase { at, .. } => Some(*at),
            _ => None,
        })
        .collect();
    assert_eq!(stars.len(), 1);
    assert!((stars[0][0] - 8.35).abs() < 1e-12 && (stars[0][1] - 20.0).abs() < 1e-12, "{stars:?}");
}

/// Over other axes lines are traced between cells: edges of area, and where the orbit ceases to attract.
#[test]
fn lines_are_traced_over_other_axes() {
    let case = case();
    let columns = [
        texts("regime", &[SYM, SYM, SYM, SMR]),
        texts("area", &["Z3", "Z4", "Z3", "Z4"]),
        numbers("orbit_peak", &[None, None, Some(1e-3), Some(1e-3)]),
    ];
    let axes = vec![
        axis(&case, SweepParameter::Restitution, &[0.4, 0.6]),
        axis(&case, SweepParameter::Frequency, &[8.0, 8.2]),
    ];
    let regimes = figure(&swept(&case, axes, &columns), "sweep-regimes");
    let near = |found: &[[f64; 2]], wanted: [[f64; 2]; 2]| {
        found.len() == 2
            && found.iter().zip(wanted).all(|(a, b)| (0..2).all(|k| (a[k] - b[k]).abs() < 1e-12))
    };
    // Frequencies from 7.9 to 8.3 Hz, restitutions from 0.3 to 0.7.
    let areas = drawn(&regimes.panels[0], "areas of the theory");
    assert!(near(&areas, [[8.1, 0.3], [8.1, 0.7]]), "{areas:?}");
    let orbit = drawn(&regimes.panels[0], "exact orbit attracts");
    assert!(near(&orbit, [[7.9, 0.5], [8.3, 0.5]]), "{orbit:?}");
    assert!(regimes.caption.contains("(solid)") && regimes.caption.contains("(dashed)"));
    // Each area is named inside of itself.
    let notes: Vec<(f64, &str)> = regimes.panels[0]
        .layers
        .iter()
        .filter_map(|layer| match layer {
            Layer::Note { at, text, .. } => Some((at[0], text.as_str())),
            _ => None,
        })
        .collect();
    assert_eq!(notes, [(8.0, "Z3"), (8.2, "Z4")]);
}

/// Every mark of a diagram over one axis, in the unit of its axis.
#[test]
fn a_diagram_shows_each_point_once_in_its_regime() {
    let case = case();
    let columns = [
        texts("regime", &[ASY, SYM, SYM, SMR]),
        all("peak", &[6e-3, 5e-3, 4e-3, 9e-3]),
        all("largest_peak", &[6e-3, 8e-3, 4.02e-3, 9e-3]),
        numbers("orbit_peak", &[Some(3e-3), None, Some(4e-3), None]),
        all("bare_amplitude", &[10e-3; 4]),
        all("section_01", &[1e-3; 4]),
        all("section_02", &[2e-3; 4]),
        all("section_16", &[-3e-3; 4]),
    ];
    let axes = vec![axis(&case, SweepParameter::Clearance, &[0.018, 0.019, 0.021, 0.022])];
    let swept = swept(&case, axes, &columns);
    let diagram = figure(&swept, "sweep-bifurcation");
    let panel = &diagram.panels[0];
    assert_eq!(
        (panel.x.label.as_str(), panel.y.label.as_str()),
        ("clearance b (mm)", "largest displacement (mm)")
    );
    let near = |found: Vec<[f64; 2]>, wanted: &[[f64; 2]]| {
        let same = |a: &[f64; 2], b: &[f64; 2]| (0..2).all(|k| (a[k] - b[k]).abs() < 1e-12);
        found.len() == wanted.len() && found.iter().zip(wanted).all(|(a, b)| same(a, b))
    };
    for (name, wanted) in [
        (Regime::TwoAsymmetric.short(), &[[18.0, 6.0]][..]),
        (Regime::TwoSymmetric.short(), &[[19.0, 5.0], [21.0, 4.0]]),
        (Regime::StronglyModulated.short(), &[[22.0, 9.0]]),
        // Of the two that are larger one is another motion, the other differs by half a per cent.
        ("largest other motion", &[[19.0, 8.0]]),
        ("exact 1:1 orbit", &[[18.0, 3.0], [21.0, 4.0]]),
        ("without absorber", &[[18.0, 10.0], [19.0, 10.0], [21.0, 10.0], [22.0, 10.0]]),
    ] {
        assert!(near(drawn(panel, name), wanted), "{name}: {:?}", drawn(panel, name));
    }
    // No orbit at the second value: its line is interrupted there.
    let gaps = panel.layers.iter().filter_map(|layer| match layer {
        Layer::Curve { points, label: Some(label), .. } if label.text == "exact 1:1 orbit" => {
            Some(points.iter().map(|point| point[1].is_nan()).collect::<Vec<_>>())
        }
        _ => None,
    });
    assert_eq!(gaps.collect::<Vec<_>>(), [[false, true, false, true]]);
    let rules: Vec<Rule> = panel
        .layers
        .iter()
        .filter_map(|layer| match layer {
            Layer::Rule { rule, .. } => Some(*rule),
            _ => None,
        })
        .collect();
    assert!(matches!(rules[..], [Rule::Vertical(at)] if (at - 20.0).abs() < 1e-12), "{rules:?}");
    let section = figure(&swept, "sweep-section");
    let dots: Vec<f64> = section.panels[0]
        .layers
        .iter()
        .flat_map(|layer| match layer {
            Layer::Points { points, .. } => points.iter().map(|point| point.y).collect(),
            _ => Vec::new(),
        })
        .collect();
    assert_eq!(dots.len(), 12);
    let sum: f64 = dots.iter().sum();
    assert!(sum.abs() < 1e-12, "four times 1, 2 and -3 mm: {dots:?}");
}

/// A start that is known to lead to the orbit, or not to, says more than the regime of the main motion.
#[test]
fn what_starts_reach_counts_where_it_is_recorded() {
    let case = case();
    let mut columns = small_columns();
    let reached = [Some(true), Some(false), Some(true), None, Some(false), Some(true), None, None];
    columns.push(Column {
        name: "orbit_reached".to_owned(),
        unit: "",
        values: Values::Flag(reached.to_vec()),
    });
    let text = markdown(&swept(&case, small_axes(&case), &columns));
    assert!(text.contains("of these; at 40.0 % no start led to it."), "{text}");
}

/// Numbers of motions, and what their tints stand for.
#[test]
fn motions_are_counted_up_to_four_and_more() {
    let case = case();
    let columns = [counts("motions", &[0, 1, 2, 3, 4, 5, 1, 1])];
    let mut of_four = swept(&case, small_axes(&case), &columns);
    let motions = figure(&of_four, "sweep-motions");
    let words: Vec<&str> = motions.keys.iter().map(|key| key.label.as_str()).collect();
    assert_eq!(words, ["none measured", "one motion", "2", "3", "4 or more"]);
    let shown = motions.panels[0].layers.iter().find_map(|layer| match layer {
        Layer::Image(Image { cells: Cells::Kinds(tints, cells), .. }) => Some(
            cells.iter().map(|kind| tints[usize::from(kind.expect("known"))]).collect::<Vec<_>>(),
        ),
        _ => None,
    });
    let tint = |k: usize| motions.keys[k].tint;
    assert_eq!(shown.expect("a map"), [0, 1, 2, 3, 4, 4, 1, 1].map(tint));
    // One start cannot lead to several.
    of_four.starts = 1;
    let names: Vec<String> =
        of_four.figures().expect("figures").into_iter().map(|figure| figure.name).collect();
    assert!(!names.iter().any(|name| name == "sweep-motions"), "{names:?}");
}

/// The sentences about what the absorber does at best and at worst.
#[test]
fn the_best_and_the_worst_are_told_by_their_signs() {
    let case = case();
    let says = |reductions: [f64; 8]| {
        let columns = [all("reduction_db", &reductions), texts("regime", &[SYM; 8])];
        markdown(&swept(&case, small_axes(&case), &columns))
    };
    for (reductions, sentence) in [
        (
            [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0],
            "The absorber reduces the peak everywhere, least by 1.00 dB, at clearance 10.0 mm, frequency 8.00 Hz.",
        ),
        (
            [0.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0],
            "The absorber reduces the peak at 87.5 % of the points, and increases it nowhere.",
        ),
        (
            [-4.0, -3.0, -2.0, -1.0, -1.0, -1.0, -1.0, -1.0],
            "It grows most, by 4.00 dB, at clearance 10.0 mm, frequency 8.00 Hz.",
        ),
        (
            [-4.0, -3.0, -2.0, -1.5, -1.0, -1.5, -1.5, -1.5],
            "Nowhere does the absorber reduce the vibration: at best it grows by 1.00 dB, at clearance 20.0 mm, frequency 8.00 Hz.",
        ),
    ] {
        let text = says(reductions);
        assert!(text.contains(sentence), "{sentence}\n{text}");
    }
}

/// Digits enough to tell neighbours apart, how values are spread, and no more stretches than are read.
#[test]
fn a_long_axis_is_told_in_short() {
    let case = case();
    let values: Vec<f64> = (0..60).map(|k| 8.3 + 1e-4 * f64::from(k)).collect();
    let regimes: Vec<&'static str> = (0..60).map(|k| if k % 2 == 0 { SYM } else { SMR }).collect();
    let columns = [texts("regime", &regimes)];
    let axes = vec![axis(&case, SweepParameter::Frequency, &values)];
    let text = markdown(&swept(&case, axes, &columns));
    assert!(text.contains("| 8.3001 Hz | 8.3001 Hz | 1 | strongly modulated response |"), "{text}");
    assert!(text.contains("and 36 more stretches"), "{text}");
    assert!(!text.contains("| 8.3024 Hz |"), "the 25th is not listed: {text}");
    for (values, logarithmic, how) in [
        ([8.0, 8.5, 9.0], false, "even"),
        ([8.0, 8.1, 9.0], false, "as listed"),
        ([4.0, 8.0, 16.0], true, "logarithmic"),
    ] {
        let axis = SweepAxis {
            parameter: SweepParameter::Frequency,
            values: values.to_vec(),
            logarithmic,
        };
        let columns = [texts("regime", &[SYM, SYM, SMR])];
        let text = markdown(&swept(&case, vec![AxisShown::of(&case, &axis)], &columns));
        assert!(text.contains(&format!("(3 values, {how})")), "{how}: {text}");
    }
}

#[test]
fn more_points_than_a_page_shows_are_refused() {
    let case = case();
    let values: Vec<f64> = (1..=1001).map(|k| 1e-3 * f64::from(k)).collect();
    let axes = vec![
        axis(&case, SweepParameter::Clearance, &values),
        axis(&case, SweepParameter::Frequency, &values),
    ];
    let error = swept(&case, axes, &[]).figures().expect_err("too many");
    assert!(matches!(error, SweptError::TooLarge { points: 1_002_001 }), "{error}");
}

/// No words touch others or are cut, whatever is shown.
#[test]
fn words_neither_touch_nor_are_cut() {
    let case = case();
    let columns = small_columns();
    let two = swept(&case, small_axes(&case), &columns);
    let restitutions = [0.3, 0.6, 0.9];
    let mut axes = vec![axis(&case, SweepParameter::Restitution, &restitutions)];
    axes.extend(small_axes(&case));
    let regimes: Vec<&'static str> = (0..24).map(|point| [SYM, ASY, SMR, LOW][point % 4]).collect();
    let areas: Vec<&'static str> =
        (0..24).map(|point| if point % 8 < 4 { "Z3" } else { "Z4" }).collect();
    let peaks: Vec<f64> = (0..24).map(|point| 1e-3 * f64::from(point)).collect();
    let more = [texts("regime", &regimes), texts("area", &areas), all("peak", &peaks)];
    let three = swept(&case, axes, &more);
    for figure in two.figures().expect("figures").iter().chain(&three.figures().expect("figures")) {
        let texts = draw(figure).expect("drawn").texts;
        let (right, bottom) = (f64::from(figure.size.0), f64::from(figure.size.1));
        let page = Rect { left: 0.0, top: 0.0, right, bottom };
        for (i, a) in texts.iter().enumerate() {
            assert!(page.contains(&a.room), "{}: {a:?} is cut", figure.name);
            for b in &texts[i + 1..] {
                assert!(!a.room.overlaps(&b.room), "{}: {a:?} touches {b:?}", figure.name);
            }
        }
        assert!(!figure.caption.is_empty() && !figure.alt.is_empty());
    }
}

/// A map of 500 by 500 points stays light even where no two neighbours are alike, and has the same bytes each
/// time.
#[test]
fn a_large_map_of_noise_stays_light() {
    let case = case();
    const COUNT: usize = 500;
    let mut state = 1_u64;
    let mut noise = || {
        // Multiplier and increment of Knuth's generator for 64 bits.
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / (1_u64 << 31) as f64
    };
    let peaks: Vec<f64> = (0..COUNT * COUNT).map(|_| 1e-3 * (1.0 + noise())).collect();
    let regimes: Vec<&'static str> =
        (0..COUNT * COUNT).map(|_| [SYM, ASY, SMR, LOW][(4.0 * noise()) as usize]).collect();
    let columns = [all("peak", &peaks), texts("regime", &regimes)];
    let values = |from: f64, to: f64| -> Vec<f64> {
        (0..COUNT).map(|k| from + (to - from) * k as f64 / (COUNT - 1) as f64).collect()
    };
    let axes = vec![
        axis(&case, SweepParameter::Clearance, &values(0.005, 0.04)),
        axis(&case, SweepParameter::Frequency, &values(8.0, 8.7)),
    ];
    let swept = swept(&case, axes, &columns);
    let first = files(&swept);
    for (path, text) in &first {
        if path.extension().is_some_and(|extension| extension == "svg") {
            assert!(text.len() <= 150_000, "{}: {}", path.display(), text.len());
        }
    }
    let regimes = &shown(&first[Path::new("figures/sweep-regimes.svg")])[0];
    assert_eq!((regimes.rows.len(), regimes.rows[0].len()), (COUNT, COUNT), "nothing is left out");
    assert!(first == files(&swept));
}

/// Where a map of values would be too large, levels of colour are left out before points are: neighbouring
/// levels look alike, and half of the points would be gone.
#[test]
fn levels_of_colour_are_left_out_before_points() {
    let case = case();
    // More than the limit on a file at 128 levels, seven bits a point; less at 64.
    const COUNT: u32 = 400;
    let part = |k: u32| (f64::from(k) * 2.0_f64.sqrt() * f64::from(k % 977)).fract();
    let peaks: Vec<f64> = (0..COUNT * COUNT).map(|k| 1e-3 * (1.0 + part(k))).collect();
    let columns = [all("peak", &peaks)];
    let values = |from: f64| -> Vec<f64> { (0..COUNT).map(|k| from + f64::from(k)).collect() };
    let axes = vec![
        axis(&case, SweepParameter::Restitution, &values(1.0)),
        axis(&case, SweepParameter::Frequency, &values(8.0)),
    ];
    let drawn = render(&figure(&swept(&case, axes, &columns), "sweep-amplitude")).expect("drawn");
    let map = &shown(&drawn)[0];
    assert_eq!((map.rows.len(), map.rows[0].len()), (COUNT as usize, COUNT as usize));
    let tints: std::collections::BTreeSet<[u8; 3]> =
        map.rows.iter().flatten().map(|tint| tint.0).collect();
    assert_eq!(tints.len(), 64);
}

/// A report that is written anew leaves the pages of a sweep where they are.
#[test]
fn a_report_leaves_a_sweep_alone() {
    for (file, own) in [
        ("figures/map.svg", true),
        ("figures/sweep-regimes.svg", false),
        ("figures/sweep-anything.svg", false),
        ("sweep.md", false),
        ("sweep.html", false),
        ("sweep.json", false),
    ] {
        assert_eq!(render::is_of_report(Path::new(file)), own, "{file}");
    }
}

/// CIELAB coordinates of linear sRGB (IEC 61966-2-1, CIE 15, white D65).
fn lab(linear: [f64; 3]) -> [f64; 3] {
    const MATRIX: [[f64; 3]; 3] = [
        [0.412_456_4, 0.357_576_1, 0.180_437_5],
        [0.212_672_9, 0.715_152_2, 0.072_175_0],
        [0.019_333_9, 0.119_192_0, 0.950_304_1],
    ];
    let dot = |row: [f64; 3]| (0..3).map(|k| row[k] * linear[k]).sum::<f64>();
    let of = |part: f64| {
        if part > 0.008_856 { libm::cbrt(part) } else { 7.787 * part + 16.0 / 116.0 }
    };
    let [x, y, z] = [dot(MATRIX[0]) / 0.950_47, dot(MATRIX[1]), dot(MATRIX[2]) / 1.088_83].map(of);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Tints of regimes stay apart for readers with any common colour vision (Machado, Oliveira and Fernandes 2009,
/// severity 1), and in a grey print.
#[test]
fn tints_of_regimes_stay_apart() {
    const SIGHTS: [[[f64; 3]; 3]; 4] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [
            [0.152_286, 1.052_583, -0.204_868],
            [0.114_503, 0.786_281, 0.099_216],
            [-0.003_882, -0.048_116, 1.051_998],
        ],
        [
            [0.367_322, 0.860_646, -0.227_968],
            [0.280_085, 0.672_501, 0.047_413],
            [-0.011_820, 0.042_940, 0.968_881],
        ],
        [
            [1.255_528, -0.076_749, -0.178_779],
            [-0.078_411, 0.930_809, 0.147_602],
            [0.004_733, 0.691_367, 0.303_900],
        ],
    ];
    let regimes = [
        Regime::AboveTwo,
        Regime::TwoAsymmetric,
        Regime::TwoSymmetric,
        Regime::StronglyModulated,
        Regime::BelowTwo,
        Regime::AtRest,
    ];
    let tints: Vec<[f64; 3]> = regimes
        .into_iter()
        .map(tint)
        .chain([Tint::UNKNOWN])
        .map(|tint| {
            tint.0.map(|part| {
                let part = f64::from(part) / 255.0;
                if part <= 0.040_45 { part / 12.92 } else { libm::pow((part + 0.055) / 1.055, 2.4) }
            })
        })
        .collect();
    for (i, a) in tints.iter().enumerate() {
        for b in &tints[i + 1..] {
            for sight in SIGHTS {
                let seen = |of: &[f64; 3]| {
                    let dot = |row: [f64; 3]| (0..3).map(|k| row[k] * of[k]).sum::<f64>();
                    lab(sight.map(|row| dot(row).clamp(0.0, 1.0)))
                };
                let (a, b) = (seen(a), seen(b));
                let apart = libm::sqrt((0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum());
                // Four times what is just told apart side by side, since keys are away from their areas.
                assert!(apart > 10.0, "{apart}: {a:?} {b:?}");
            }
            let grey = (lab(*a)[0] - lab(*b)[0]).abs();
            // Just told apart is 1 to 2; the tint of what is unknown comes nearest.
            assert!(grey > 1.5, "{grey}");
        }
    }
}
