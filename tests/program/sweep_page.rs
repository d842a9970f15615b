//! The page of a sweep: words, tables and figures on tables that are made by hand and counted by hand.

mod figures;
mod pixels;

use crate::common;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use vinesink::analysis::Analysis;
use vinesink::case::{Case, SweepAxis};
use vinesink::executor::Serial;
use vinesink::orbits::attracting_orbit;
use vinesink::regimes::Regime;
use vinesink::report::figure::{
    Axis, AxisScale, Cells, Figure, Image, Label, Layer, Marker, Panel, Ramp, Rule, Tint, draw,
    edges, render,
};
use vinesink::report::render;
use vinesink::report::sweep::{AxisShown, Swept, SweptCase, SweptError, tint};
use vinesink::sweep::columns::{Cell, Column, Storage};
use vinesink::sweep::limits::stability_limits;
use vinesink::system::Parameter;

/// Table 1 of Li, Seguy, Berlioz (2016) at 8.35 Hz and 20 mm.
fn case() -> Case {
    Case::parse("map.toml", common::table_1_case()).unwrap_or_else(|error| panic!("{error:?}"))
}

fn column<T: Copy>(
    name: &'static str,
    storage: Storage,
    values: &[T],
    cell: impl Fn(T) -> Option<Cell>,
) -> Column {
    let unit = if storage == Storage::Text { "" } else { "1" };
    let cells = values.iter().map(|value| cell(*value)).collect();
    Column { name: name.to_owned(), unit, storage, cells }
}

fn numbers(name: &'static str, values: &[Option<f64>]) -> Column {
    column(name, Storage::Number, values, |value| value.map(Cell::Number))
}

fn all(name: &'static str, values: &[f64]) -> Column {
    column(name, Storage::Number, values, |value| Some(Cell::Number(value)))
}

fn texts(name: &'static str, values: &[&'static str]) -> Column {
    column(name, Storage::Text, values, |value| (!value.is_empty()).then_some(Cell::Text(value)))
}

fn counts(name: &'static str, values: &[i64]) -> Column {
    column(name, Storage::Whole, values, |value| Some(Cell::Number(value as f64)))
}

fn swept<'a>(case: &'a Case, axes: Vec<AxisShown>, columns: &'a [Column]) -> Swept<'a> {
    let results_sha256 = "f".repeat(64);
    let frequency = axes.iter().find(|axis| axis.parameter == Parameter::Frequency);
    let frequencies = frequency.filter(|_| axes.len() == 2).map_or(&[][..], |axis| &axis.values);
    let limits = stability_limits(case, frequencies, &Serial);
    Swept {
        case: SweptCase::One(case),
        axes,
        columns,
        starts: 4,
        periods: 100,
        limits,
        results_sha256,
    }
}

/// All files of the page, as text.
fn files(swept: &Swept) -> BTreeMap<PathBuf, String> {
    let files = swept.files().expect("rendered");
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
        texts("area", &["Z3", "Z3", "Z3", "Z4", "Z2", "Z3", "Z4", "Z4"]),
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

fn axis(case: &Case, parameter: Parameter, values: &[f64]) -> AxisShown {
    let axis = SweepAxis { parameter, values: values.to_vec(), logarithmic: false };
    AxisShown::of(case, &axis)
}

fn small_axes(case: &Case) -> Vec<AxisShown> {
    vec![
        axis(case, Parameter::Clearance, &[0.01, 0.02]),
        axis(case, Parameter::Frequency, &[8.0, 8.2, 8.4, 8.6]),
    ]
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

#[test]
fn shares_and_places_are_those_counted_by_hand() {
    let case = case();
    let columns = small_columns();
    let text = markdown(&swept(&case, small_axes(&case), &columns));
    for line in [
        // 3 of 7 points with a motion; the best is the sixth point.
        "> **Two symmetric impacts per period over 42.9 % of the map. Vibration falls by up to 6.25 dB, at clearance 20 mm, excitation frequency 8.2 Hz.**",
        "> Beside it: strongly modulated response 28.6 %; two asymmetric impacts per period 14.3 %; fewer than two impacts per period 14.3 %.",
        // 4 of 7 are above 0.
        "> The absorber reduces the peak at 57.1 % of the points; the peak grows most, by 3.50 dB, at clearance 20 mm, excitation frequency 8.4 Hz.",
        "> Several motions coexist at 42.9 % of the points (up to 3 at a point), within excitation frequency from 8 Hz to 8.2 Hz.",
        // 3 of 4 in Z3; none of the 3 others that have a motion.
        "> In area Z3, where the theory has steady 1:1 resonance, two symmetric impacts per period are the main motion at 75.0 % of the points, outside of it at 0 %.",
        // 5 of 7; 3 of these 5; the third point has one motion only, and another; of the fifth nothing is known.
        "> An exact 1:1 orbit attracts at 71.4 % of the points; two symmetric impacts per period are the main motion at 60.0 % of these; at 20.0 % no start led to it.",
        "| two symmetric impacts per period | 42.9 % | 1.00 mm to 3.00 mm | +2.0 dB to +6.2 dB |",
        "| strongly modulated response | 28.6 % | 4.00 mm to 8.00 mm | −3.5 dB to −1.0 dB |",
        "| Where (points) | symmetric 1:1 | strongly modulated | asymmetric | z < 2 |",
        "| area Z2 (1) | 0 % | 0 % | 100 % | 0 % |",
        "| area Z3 (4) | 75.0 % | 25.0 % | 0 % | 0 % |",
        "| area Z4 (2) | 0 % | 50.0 % | 0 % | 50.0 % |",
        "| exact 1:1 orbit attracts (5) | 60.0 % | 20.0 % | 20.0 % | 0 % |",
        "| no exact 1:1 orbit attracts (2) | 0 % | 50.0 % | 0 % | 50.0 % |",
        "2 × 4 = 8 points: clearance from 10 mm to 20 mm (2 values, even); excitation frequency from 8 Hz to 8.6 Hz (4 values, even).",
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
    assert_eq!(document["format"], "vinesink/sweep@2");
    let motions = &document["motions"][0];
    assert_eq!(motions["worked_out"], 7);
    let best = &motions["reduction"]["best"];
    assert_eq!((&best["of"]["id"], &best["of"]["value"]), (&"reduction_db".into(), &6.25.into()));
    let at = [0, 1].map(|k| best["at"][k]["of"]["value"].as_f64().expect("a number"));
    assert_eq!(at, [0.02, 8.2]);
    assert_eq!(motions["regimes"][0]["regime"], "two-symmetric");
    assert_eq!(motions["regimes"][0]["points"], 3);
    assert_eq!(motions["orbit"]["missed"]["value"], 0.2);
    assert_eq!(document["axes"][0]["key"], "clearance");
}

/// Name, symbol, unit, and the case's own value in that unit.
#[test]
fn an_axis_is_shown_in_the_terms_of_its_design() {
    use Parameter as P;
    let forced = common::table_1_case()
        .replace("base-displacement", "force")
        .replace("amplitude = \"0.25 mm\"", "amplitude = \"2.9 N\"");
    let reduced = "title = \"r\"\nsource = \"made up\"\n[reduced]\nmass_ratio = 0.0077\ndamping = 1.8\n\
                   restitution = 0.6\nforcing = 3.1\nclearance = 1.3\ndetuning = -1.5\n";
    let parse = |text: &str| Case::parse("map.toml", text).unwrap_or_else(|e| panic!("{e:?}"));
    let (base, forced, reduced) = (case(), parse(&forced), parse(reduced));
    let damping_ratio = 3.02 / (2.0 * (11_470.0 * 4.168_f64).sqrt());
    for (case, parameter, value, label, own) in [
        (&base, P::Clearance, 0.02, "clearance b (mm)", Some(0.02)),
        (&base, P::Frequency, 8.0, "excitation frequency f (Hz)", Some(8.35)),
        (&base, P::Amplitude, 1e-3, "amplitude of the base F (mm)", Some(0.25e-3)),
        (&forced, P::Amplitude, 1.0, "amplitude of the force P (N)", Some(2.9)),
        (&base, P::Restitution, 0.5, "restitution r (1)", Some(0.6)),
        (&base, P::Inclination, 0.01, "inclination of the cavity α (deg)", Some(0.0)),
        (&base, P::Friction, 0.003, "friction in the cavity μ (1)", Some(0.0)),
        (&reduced, P::GravityAlong, 0.1, "gravity along the cavity over bω₀² a (1)", Some(0.0)),
        (&base, P::AbsorberMass, 0.05, "mass of the absorber m₂ (g)", Some(0.032)),
        (&base, P::AbsorberMass, 1.5, "mass of the absorber m₂ (kg)", Some(0.032)),
        (&base, P::MassRatio, 0.01, "mass ratio ε (%)", Some(0.032 / 4.168)),
        (&base, P::Mass, 1.5, "mass of the oscillator m₁ (kg)", Some(4.168)),
        (&base, P::Stiffness, 1e4, "stiffness k₁ (kN/m)", Some(11_470.0)),
        (&base, P::Stiffness, 900.0, "stiffness k₁ (N/m)", Some(11_470.0)),
        (&base, P::Damping, 1.0, "damping c₁ (N s/m)", Some(3.02)),
        (&base, P::DampingRatio, 0.01, "damping ratio ζ (%)", Some(damping_ratio)),
        (&base, P::InitialDisplacement, -0.01, "initial displacement x (mm)", None),
        (&base, P::InitialVelocity, 1.5, "initial velocity ẋ (m/s)", None),
        (
            &base,
            P::InitialAbsorberDisplacement,
            0.01,
            "initial displacement of the absorber y (mm)",
            None,
        ),
        (&base, P::InitialAbsorberVelocity, 0.5, "initial velocity of the absorber ẏ (mm/s)", None),
        (&reduced, P::Clearance, 1.0, "clearance b (units)", Some(1.3)),
        (&reduced, P::Frequency, 1.0, "frequency ratio Ω (1)", Some(1.0 - 1.5 * 0.0077)),
        (&reduced, P::Detuning, 1.0, "detuning σ (1)", Some(-1.5)),
        (&reduced, P::Amplitude, 2.0, "reduced forcing G (units)", Some(3.1)),
        (&reduced, P::Damping, 1.0, "reduced damping λ (1)", Some(1.8)),
        (&reduced, P::InitialDisplacement, 0.5, "initial displacement x (units)", None),
        (&reduced, P::InitialVelocity, 0.5, "initial velocity ẋ (ω₀ units)", None),
    ] {
        let shown = axis(case, parameter, &[value]);
        assert_eq!(shown.drawn().label, label);
        // Rounded a few times on the way to the unit.
        let near = own.zip(shown.own).map(|(a, b): (f64, f64)| (a - b).abs() <= 1e-14 * a.abs());
        assert!(near.unwrap_or(own == shown.own), "{label}: {:?}", shown.own);
        assert_eq!(shown.parameter.is_initial(), own.is_none(), "{label}");
    }
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
    let axes = vec![axis(&case, Parameter::Clearance, &clearances)];
    let found = files(&swept(&case, axes, &columns));
    let text = &found[Path::new("sweep.md")];
    for line in [
        "> **Two symmetric impacts per period over 50.0 % of the range. The smallest peak is 2.00 mm, at clearance 18 mm.**",
        "| 10 mm | 12 mm | 2 | two asymmetric impacts per period | 5.00 mm to 6.00 mm |",
        "| 14 mm | 18 mm | 3 | two symmetric impacts per period | 2.00 mm to 4.00 mm |",
        "| 20 mm | 20 mm | 1 | strongly modulated response | 9.00 mm |",
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
    let axes = vec![axis(&case, Parameter::Frequency, &values)];
    let found = files(&swept(&case, axes.clone(), &columns));
    let text = &found[Path::new("sweep.md")];
    let line = "> Hysteresis: from 8.2 Hz to 8.3 Hz two symmetric impacts per period (peak 3.00 mm) up, strongly modulated response (peak 7.00 mm) down.";
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
        axis(&case, Parameter::Clearance, &[0.01, 0.02]),
        axis(&case, Parameter::Frequency, &values[..3]),
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
    let mut axes = vec![axis(&case, Parameter::Restitution, &restitutions)];
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
        axis(&case, Parameter::InitialDisplacement, &[-0.01, 0.0, 0.01]),
        axis(&case, Parameter::InitialVelocity, &[-0.5, 0.5]),
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

/// The points of a layer with a name in the units of the labels, finite ones only; several layers may have it.
fn drawn(panel: &Panel, name: &str) -> Vec<[f64; 2]> {
    let is = |label: &Option<Label>| label.as_ref().is_some_and(|label| label.text == name);
    let points = panel.layers.iter().flat_map(|layer| match layer {
        Layer::Curve { points, label, .. } if is(label) => points.clone(),
        Layer::Points { points, label, .. } if is(label) => {
            points.iter().map(|point| [point.x, point.y]).collect()
        }
        _ => Vec::new(),
    });
    let finite = points.filter(|point| point.iter().all(|part| part.is_finite()));
    finite.map(|[x, y]| [x * panel.x.factor, y * panel.y.factor]).collect()
}

/// A start that is known to lead to the orbit, or not to, says more than the regime of the main motion.
#[test]
fn what_starts_reach_counts_where_it_is_recorded() {
    let case = case();
    let mut columns = small_columns();
    let reached = [Some(true), Some(false), Some(true), None, Some(false), Some(true), None, None];
    let flag = |reached: Option<bool>| reached.map(|reached| Cell::Number(f64::from(reached)));
    columns.push(column("orbit_reached", Storage::Flag, &reached, flag));
    let text = markdown(&swept(&case, small_axes(&case), &columns));
    assert!(text.contains("of these; at 40.0 % no start led to it."), "{text}");
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
            "The absorber reduces the peak everywhere, least by 1.00 dB, at clearance 10 mm, excitation frequency 8 Hz.",
        ),
        (
            [0.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0],
            "The absorber reduces the peak at 87.5 % of the points, and increases it nowhere.",
        ),
        (
            [-4.0, -3.0, -2.0, -1.0, -1.0, -1.0, -1.0, -1.0],
            "It grows most, by 4.00 dB, at clearance 10 mm, excitation frequency 8 Hz.",
        ),
        (
            [-4.0, -3.0, -2.0, -1.5, -1.0, -1.5, -1.5, -1.5],
            "Nowhere does the absorber reduce the vibration: at best it grows by 1.00 dB, at clearance 20 mm, excitation frequency 8 Hz.",
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
    let axes = vec![axis(&case, Parameter::Frequency, &values)];
    let text = markdown(&swept(&case, axes, &columns));
    assert!(text.contains("| 8.3001 Hz | 8.3001 Hz | 1 | strongly modulated response |"), "{text}");
    assert!(text.contains("and 36 more stretches"), "{text}");
    assert!(!text.contains("| 8.3024 Hz |"), "the 25th is not listed: {text}");
    for (values, logarithmic, how) in [
        ([8.0, 8.5, 9.0], false, "even"),
        ([8.0, 8.1, 9.0], false, "as listed"),
        ([4.0, 8.0, 16.0], true, "logarithmic"),
    ] {
        let axis =
            SweepAxis { parameter: Parameter::Frequency, values: values.to_vec(), logarithmic };
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
        axis(&case, Parameter::Clearance, &values),
        axis(&case, Parameter::Frequency, &values),
    ];
    let error = swept(&case, axes, &[]).figures().expect_err("too many");
    assert!(matches!(error, SweptError::TooLarge { points: 1_002_001 }), "{error}");
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
