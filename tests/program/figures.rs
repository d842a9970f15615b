//! What the figures of a case owe their reader, for shipped cases and for systems at the edge of
//! what a case can be.

use crate::common;
use std::fs;

use vinesink::case::{Case, ExtraFigure, ReportSettings};
use vinesink::executor::Serial;
use vinesink::motions::{Effort, Place, motions};
use vinesink::report::document::{self, Source};
use vinesink::report::figure::{AxisScale, Color, Figure, Layer, Marker, Panel, Shape, draw};
use vinesink::report::{figures as made, template};
use vinesink::study::CaseStudy;
use vinesink::study::plots::Plot;

/// A study from a few starts.
fn quick(case: &Case) -> CaseStudy {
    let effort = Effort { starts: 6, discard: Some(150), ..Effort::over(150) };
    let place = Place::new(&case.system(), effort.starts);
    let found = motions(&[place], &effort, &Serial).expect("finite").remove(0);
    CaseStudy::of(&case.system(), &found, effort).expect("can be studied")
}

fn shipped(name: &str) -> Case {
    let path = format!("cases/{name}.toml");
    let text = fs::read_to_string(&path).expect("is shipped");
    Case::parse(&path, &text).expect("is valid")
}

/// Table 1 of the paper at 8 Hz and 7.5 mm, with some lines replaced.
fn changed(changes: &[(&str, &str)]) -> Case {
    let path = "cases/li2016-8hz-b7p5mm.toml";
    let mut text = fs::read_to_string(path).expect("is shipped");
    for (key, value) in changes {
        let line =
            text.lines().find(|line| line.starts_with(&format!("{key} ="))).expect("is a key");
        text = text.replace(&line.to_owned(), &format!("{key} = {value}"));
    }
    Case::parse(path, &text).expect("is valid")
}

fn figures(case: &Case) -> Vec<Figure> {
    let mut study = quick(case);
    if case.report.figures.contains(&ExtraFigure::Dissipation) {
        study = study.with_averages().expect("can be averaged");
    }
    of_study(case, &study)
}

fn of_study(case: &Case, study: &CaseStudy) -> Vec<Figure> {
    let plots = Plot::all(case, study, &Serial).expect("can be worked out");
    let figures = made::all(case, study, &plots);
    template::worded(figures, &case.units()).expect("have words")
}

/// Everything that holds for every case; returns the figures' names.
fn check(case: &Case) -> Vec<String> {
    let figures = figures(case);
    let mut sum = 0;
    for figure in &figures {
        let name = &figure.name;
        let drawing = draw(figure).unwrap_or_else(|error| panic!("{}: {error}", case.title));
        let size = drawing.svg.len();
        sum += size;
        // A diagram holds two sweeps of a hundred values twice.
        let most = if name.starts_with("diagram-") { 80_000 } else { 60_000 };
        assert!((2_000..most).contains(&size), "{}: {name} has {size} bytes", case.title);
        assert!(!drawing.svg.contains("NaN") && !drawing.svg.contains("inf\""), "{name}");
        for words in [&figure.caption, &figure.alt] {
            assert!(words.len() > 30 && words.ends_with('.'), "{name}: {words}");
            assert!(!words.contains("NaN") && !words.contains("undefined"), "{name}: {words}");
            assert!(has_unit(words), "{}: no unit in {name}: {words}", case.title);
        }
        assert!(!figure.title.is_empty(), "{name}");
        common::caption_is_short(figure);
        common::words_are_apart(figure, &drawing.texts);
        if let Some(narrow) = figure.narrow() {
            let drawing = draw(&narrow).unwrap_or_else(|error| panic!("{}: {error}", case.title));
            common::words_are_apart(&narrow, &drawing.texts);
        }
    }
    let allowed = 190_000 + 30_000 * case.report.figures.len();
    assert!(sum < allowed, "{}: {sum} bytes", case.title);
    let mut names: Vec<String> = figures.iter().map(|figure| figure.name.clone()).collect();
    let of = |name: &str| figures.iter().find(|figure| figure.name == name);
    assert_eq!(of("ranges").is_some(), names[0] == "ranges", "{names:?}");
    for panel in [of("ranges"), of("map")].into_iter().flatten().flat_map(case_panels) {
        case_is_inside(panel);
    }
    names.sort();
    names.dedup();
    assert_eq!(names.len(), figures.len(), "two figures with one name");
    figures.into_iter().map(|figure| figure.name).collect()
}

fn has_unit(words: &str) -> bool {
    let units = ["mm", "µm", "nm", "Hz", "units", "f₀", " T", "period"];
    units.iter().any(|unit| words.contains(unit))
}

/// The panels that mark the case: all of the ranges, the upper one of the map.
fn case_panels(figure: &Figure) -> &[Panel] {
    if figure.name == "map" { &figure.panels[..1] } else { &figure.panels }
}

/// The case's mark is well inside the panel, and there is one.
fn case_is_inside(panel: &Panel) {
    let marks: Vec<[f64; 2]> = panel
        .layers
        .iter()
        .filter_map(|layer| match layer {
            Layer::Points { points, marker: Marker::THIS_CASE, .. } => {
                points[0].tooltip.as_ref().map(|_| [points[0].x, points[0].y])
            }
            _ => None,
        })
        .collect();
    let [at] = marks.as_slice() else { panic!("{} marks", marks.len()) };
    for (axis, value) in [&panel.x, &panel.y].into_iter().zip(at) {
        let (first, last) = axis.range.expect("is fixed");
        let part = match axis.scale {
            AxisScale::Linear => (value - first) / (last - first),
            AxisScale::Log => libm::log(value / first) / libm::log(last / first),
        };
        assert!((0.01..0.99).contains(&part), "{}: {value} in {first}..{last}", axis.label);
    }
}

/// The same case with every further figure asked for.
fn with_further_figures(mut case: Case) -> Case {
    case.report =
        ReportSettings { figures: ExtraFigure::ALL.to_vec(), ..ReportSettings::default() };
    case
}

fn has(names: &[String], name: &str) -> bool {
    names.iter().any(|one| one == name)
}

#[test]
fn shipped_cases_have_every_figure() {
    for name in [
        "li2016-8hz-b7p5mm",
        "li2016-8hz-b0p3mm",
        "li2016-8hz-b15mm",
        "li2016-8p5hz-fig4b",
        "li2016-8p5hz-fig4d",
        "li2016-8p5hz-fig4e",
        "reduced-unit-clearance",
        "force-on-mass",
    ] {
        let names = check(&shipped(name));
        for wanted in
            ["ranges", "map", "plane", "sim", "response", "amplitude", "motion-1", "return-map-1"]
        {
            assert!(has(&names, wanted), "{name} lacks {wanted}: {names:?}");
        }
    }
}

#[test]
fn further_figures_come_only_where_they_are_asked_for() {
    let names = check(&shipped("li2016-8p5hz-fig4d"));
    for figure in ExtraFigure::ALL {
        assert!(!has(&names, figure.name()), "{}", figure.name());
    }
    for name in ["li2016-8p5hz-fig4d", "force-on-mass", "reduced-unit-clearance"] {
        let names = check(&with_further_figures(shipped(name)));
        let modulated = name == "li2016-8p5hz-fig4d";
        for figure in ExtraFigure::ALL {
            // A motion that never leaves 1:1 resonance has no way into it, and its peak neither grows nor falls.
            let comes_and_goes =
                [ExtraFigure::Modulation, ExtraFigure::Captures, ExtraFigure::TransferStretches]
                    .contains(&figure);
            if modulated || !comes_and_goes {
                assert!(has(&names, figure.name()), "{name} lacks {}: {names:?}", figure.name());
            }
        }
    }
}

/// Further figures at the edges: what cannot be shown is left out, and nothing fails.
#[test]
fn further_figures_at_the_edges() {
    at_the_edges(false);
}

/// With those that follow motions along a hundred places, and with basins.
#[test]
#[ignore = "deep"]
fn basins_and_diagrams_at_the_edges() {
    at_the_edges(true);
}

fn at_the_edges(with_long_ones: bool) {
    for changes in [
        &[("amplitude", "\"0 mm\"")][..],
        &[("restitution", "0.0")],
        &[("restitution", "1.0")],
        &[("clearance", "\"1 um\"")],
        &[("clearance", "\"2 m\"")],
        &[("frequency", "\"0.5 Hz\"")],
        &[("damping", "\"3 kN s/m\"")],
        &[("mass", "\"2.084 kg\"")],
    ] {
        let mut case = with_further_figures(changed(changes));
        // Basins take 1600 simulations: where a start is most special is enough.
        let basins = with_long_ones && changes[0].0 == "restitution";
        case.report.figures.retain(|figure| basins || *figure != ExtraFigure::Basins);
        // Diagrams follow motions along a hundred places: so do only the edges of what they are over.
        let diagram = match changes[0].0 {
            "clearance" => Some(ExtraFigure::DiagramClearance),
            "frequency" => Some(ExtraFigure::DiagramFrequency),
            "amplitude" => Some(ExtraFigure::DiagramForcing),
            _ => None,
        };
        let diagrams = [
            ExtraFigure::DiagramClearance,
            ExtraFigure::DiagramFrequency,
            ExtraFigure::DiagramForcing,
        ];
        let diagram = diagram.filter(|_| with_long_ones);
        case.report.figures.retain(|one| !diagrams.contains(one) || Some(*one) == diagram);
        check(&case);
    }
}

/// Captions carry the numbers that the figures are there for.
#[test]
fn further_captions_say_what_to_see() {
    let figures = figures(&with_further_figures(shipped("li2016-8hz-b15mm")));
    let caption = |name: &str| {
        let figure = figures.iter().find(|figure| figure.name == name).expect("is there");
        figure.caption.as_str()
    };
    assert!(caption("areas").contains("collide at 16.3 mm"), "{}", caption("areas"));
    assert!(caption("bifurcations").contains("8.304 Hz, γ = 1.119"), "{}", caption("bifurcations"));
    assert!(caption("clearances").contains("Without absorber the peak is 3.01 mm"));
    assert!(
        caption("dissipation").contains("clearances off the reduced forcing of 2.17 clearances")
    );
    assert!(caption("restitutions").contains("E is largest for r = 1.0"));
    assert!(caption("forcing-responses").contains("0 % for b = 36.0 mm"));
    // The exact orbit's largest multiplier is 0.931 per period, its logarithm -0.071.
    assert!(caption("exponents").contains("(exact orbit: −0.071"), "{}", caption("exponents"));
    // From rest the vibration of 3.01 mm never reaches the absorber across 15 mm.
    let basins = caption("basins");
    assert!(basins.contains("% end with absorber at rest, no impacts, peak 3.01 mm"), "{basins}");
    assert!(basins.contains("% end with two symmetric impacts per period"), "{basins}");
    assert!(caption("map").contains("−2.6 % for saddle-node"), "{}", caption("map"));
    let diagram = caption("diagram-clearance");
    assert!(diagram.contains("from 4.85 mm (symmetry breaking) to 16.7 mm (saddle-node)"));
    assert!(diagram.contains("to 16.5 mm: two symmetric impacts per period"), "{diagram}");
    assert!(caption("diagram-frequency").contains("from 7.948 Hz (saddle-node)"));
    assert!(caption("diagram-forcing").contains("from 0.225 mm (saddle-node) to 0.774 mm"));
}

/// What a designer remembers, and nothing drawn through what is not known: the closed form is the thickest line, no
/// line but that of its error holds an average of a motion that does not repeat.
#[test]
fn the_dissipation_figure_draws_no_line_through_scattered_averages() {
    let mut case = shipped("li2016-8hz-b7p5mm");
    case.report.figures = vec![ExtraFigure::Dissipation];
    let study = quick(&case);
    assert!(!of_study(&case, &study).iter().any(|figure| figure.name == "dissipation"));
    let study = study.with_averages().expect("can be averaged");
    let figures = of_study(&case, &study);
    let figure = figures.iter().find(|figure| figure.name == "dissipation").expect("is there");
    let caption = &figure.caption;
    assert!(
        caption.contains("Between C = 1.2 mm and 18 mm the absorber takes 0.50 to 0.82"),
        "{caption}"
    );
    assert!(caption.contains("forcing of 4.34 clearances (11 % to 19 %)"), "{caption}");
    assert!(caption.contains("stable at C = 3.52 mm (symmetric 1:1)"), "{caption}");
    let curve = &study.averages.as_ref().expect("asked for").curve;
    let (mut scattered, mut thickest) = (0, 0.0_f64);
    for layer in &figure.panels[0].layers {
        let Layer::Curve { points, style, .. } = layer else { continue };
        thickest = thickest.max(style.width);
        for branch in &curve.branches {
            for point in &branch.points {
                let drawn = points.contains(&[point.amplitude, point.resistance]);
                assert!(!drawn || point.repeats_after.is_some(), "{point:?}");
                scattered += usize::from(point.repeats_after.is_none());
                assert!(!branch.closed_form || !drawn || style.width > 3.0, "{style:?}");
            }
        }
    }
    assert!(scattered > 20 && thickest > 3.0, "{scattered} {thickest}");
}

#[test]
fn figures_are_the_same_each_time() {
    let case = shipped("li2016-8p5hz-fig4d");
    let drawn = || -> Vec<String> {
        figures(&case).iter().map(|figure| draw(figure).expect("can be drawn").svg).collect()
    };
    assert!(drawn() == drawn());
}

#[test]
fn captions_say_what_the_case_does() {
    let figures = figures(&shipped("li2016-8hz-b7p5mm"));
    let caption = |name: &str| {
        let figure = figures.iter().find(|figure| figure.name == name).expect("is there");
        figure.caption.as_str()
    };
    // The ends of the exact orbit and of what every start finds, as among the margins.
    assert!(caption("ranges").contains("from 4.85 mm to 16.7 mm (exact orbit), and every"));
    assert!(caption("ranges").contains("up to 14.7 mm"), "{}", caption("ranges"));
    assert!(caption("map").contains("Z3") && caption("map").contains("4.69 mm"));
    assert!(caption("amplitude").contains("3.56 mm instead of 3.01 mm (+1.4 dB)"));
    assert!(caption("return-map-1").contains("every 0.500 T"));
    assert!(caption("motion-1").contains("3.56 mm"));
}

/// In Z4 there is no fixed point, and still the ranges are shown, with the case beside them.
#[test]
fn a_case_outside_every_range_shows_where_they_are() {
    let figures = figures(&shipped("li2016-8hz-b20mm"));
    let ranges = &figures[0];
    assert_eq!((ranges.name.as_str(), ranges.panels.len()), ("ranges", 3));
    let caption = &ranges.caption;
    assert!(caption.starts_with("This case has no stable 1:1 orbit; one is stable"), "{caption}");
    assert!(caption.contains("from 4.85 mm to 16.7 mm (exact orbit)"), "{caption}");
    assert!(ranges.alt.contains("here 20 mm") && ranges.alt.contains("8.09 Hz to 8.63 Hz"));
}

/// Up and down differ in shape as well as in colour, in both panels, under the exact branches.
#[test]
fn both_ways_of_a_diagram_are_told_apart() {
    let mut case = shipped("li2016-8p5hz-fig12");
    case.report = ReportSettings {
        figures: vec![ExtraFigure::DiagramClearance],
        ..ReportSettings::default()
    };
    let figures = figures(&case);
    let figure = figures.last().expect("some");
    assert_eq!((figure.name.as_str(), figure.panels.len()), ("diagram-clearance", 2));
    for panel in &figure.panels {
        let clouds: Vec<(Shape, Color)> = panel
            .layers
            .iter()
            .filter_map(|layer| match layer {
                Layer::Points { points, marker, color, .. } if points.len() > 100 => {
                    Some((marker.shape, *color))
                }
                _ => None,
            })
            .collect();
        let [down, up] = clouds[..] else { panic!("{clouds:?}") };
        assert!(down.0 != up.0 && down.1 != up.1, "{clouds:?}");
        let lines = panel.layers.iter().filter(|layer| matches!(layer, Layer::Curve { .. }));
        assert!(lines.count() >= 2);
    }
}

#[test]
fn without_forcing_nothing_moves() {
    let names = check(&with_further_figures(changed(&[("amplitude", "\"0 mm\"")])));
    assert!(!names.iter().any(|name| name.starts_with("diagram-")), "{names:?}");
    assert!(!has(&names, "map") && !has(&names, "motion-1") && has(&names, "sim"), "{names:?}");
}

#[test]
fn restitution_at_its_ends() {
    for r in ["0.0", "1.0"] {
        let names = check(&changed(&[("restitution", r)]));
        assert!(has(&names, "map") && has(&names, "sim"), "{names:?}");
    }
}

#[test]
fn undamped_at_resonance_there_is_no_linear_response() {
    let text = "title = \"t\"\nsource = \"s\"\n[reduced]\nmass_ratio = 0.0076775\ndamping = 0.0\n\
        restitution = 0.6\nclearance = 1.0\nforcing = 1.5\nfrequency_ratio = 1.0\n";
    let names = check(&Case::parse("undamped", text).expect("is valid"));
    assert!(has(&names, "map") && has(&names, "amplitude"), "{names:?}");
}

#[test]
fn clearances_far_from_every_boundary() {
    for clearance in ["\"1 um\"", "\"2 m\""] {
        let names = check(&changed(&[("clearance", clearance)]));
        assert!(has(&names, "map"), "{names:?}");
    }
}

#[test]
fn an_absorber_half_as_heavy_as_the_oscillator() {
    let names = check(&changed(&[("mass", "\"2.084 kg\"")]));
    assert!(has(&names, "map"), "{names:?}");
}

#[test]
fn far_from_resonance() {
    for frequency in ["\"0.5 Hz\"", "\"60 Hz\""] {
        let names = check(&changed(&[("frequency", frequency)]));
        assert!(has(&names, "map"), "{names:?}");
    }
}

/// A figure that was asked for and has nothing to show is named, not dropped in silence.
#[test]
fn a_figure_with_nothing_to_show_is_named() {
    let mut case = shipped("li2016-8hz-b7p5mm");
    case.report.figures = vec![ExtraFigure::Captures, ExtraFigure::Exponents];
    let study = quick(&case);
    let drawn = of_study(&case, &study);
    let source = Source {
        name: "one",
        case: &case,
        study: &study,
        judged: &[],
        answers: None,
        figures: &drawn,
    };
    assert_eq!(document::document(&source)["left_out"], serde_json::json!(["captures"]));
}

/// Without damping a free vibration never fades, so that no peak may be named for an absorber at rest;
/// and one modulated motion stays one in short windows.
#[test]
fn basins_of_an_undamped_oscillator_name_no_peak_at_rest() {
    let mut case = changed(&[("damping", "\"0 N s/m\"")]);
    case.report.figures = vec![ExtraFigure::Basins];
    let figures = figures(&case);
    let basins = figures.iter().find(|figure| figure.name == "basins").expect("is there");
    let caption = &basins.caption;
    assert!(caption.contains("at rest, no impacts (peak depends on the start)"), "{caption}");
}
