//! The figures of a sweep as data: lines, marks, keys and bars, in their units and at their places.

use super::*;

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
    let near = |a: f64, b: f64| (a * bar.y.factor - b).abs() <= 1e-12 * b.abs();
    let ((low, high), cells) = values(map);
    assert!(near(low, 1.0) && near(high, 8.0), "{low} {high}");
    let wanted = [2.0, 3.0, 4.0, 5.0, 6.0, 1.0, 8.0].map(Some).into_iter().chain([None]);
    for (found, wanted) in cells.iter().zip(wanted) {
        assert!(found.zip(wanted).map_or(*found == wanted, |(a, b)| near(a, b)), "{cells:?}");
    }
    assert_eq!(bar.y.label, "peak displacement x̂ (mm)");
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
            axis(&case, Parameter::Clearance, &values(20, 0.01)),
            axis(&case, Parameter::Frequency, &values(20, 8.0)),
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
        axis(&case, Parameter::Clearance, &[0.005, 0.01, 0.02, 0.03]),
        axis(&case, Parameter::Frequency, &[8.0, 8.7]),
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
            Layer::Points { points, marker: Marker::THIS_CASE, .. } => {
                Some([points[0].x * map.x.factor, points[0].y * map.y.factor])
            }
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
        axis(&case, Parameter::Restitution, &[0.4, 0.6]),
        axis(&case, Parameter::Frequency, &[8.0, 8.2]),
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
            Layer::Points { points, marker: Marker::NONE, .. } => {
                Some((points[0].x, points[0].label.as_deref()?))
            }
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
    let axes = vec![axis(&case, Parameter::Clearance, &[0.018, 0.019, 0.021, 0.022])];
    let swept = swept(&case, axes, &columns);
    let diagram = figure(&swept, "sweep-bifurcation");
    let panel = &diagram.panels[0];
    assert_eq!(
        (panel.x.label.as_str(), panel.y.label.as_str()),
        ("clearance b (mm)", "peak displacement x̂ (mm)")
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
    assert!(
        matches!(rules[..], [Rule::Vertical(at)] if (1e3 * at - 20.0).abs() < 1e-12),
        "{rules:?}"
    );
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
    assert!(sum.abs() < 1e-15, "four times 1, 2 and -3 mm: {dots:?}");
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

/// No words touch others or are cut, whatever is shown.
#[test]
fn words_neither_touch_nor_are_cut() {
    let case = case();
    let columns = small_columns();
    let two = swept(&case, small_axes(&case), &columns);
    let restitutions = [0.3, 0.6, 0.9];
    let mut axes = vec![axis(&case, Parameter::Restitution, &restitutions)];
    axes.extend(small_axes(&case));
    let regimes: Vec<&'static str> = (0..24).map(|point| [SYM, ASY, SMR, LOW][point % 4]).collect();
    let areas: Vec<&'static str> =
        (0..24).map(|point| if point % 8 < 4 { "Z3" } else { "Z4" }).collect();
    let peaks: Vec<f64> = (0..24).map(|point| 1e-3 * f64::from(point)).collect();
    let more = [texts("regime", &regimes), texts("area", &areas), all("peak", &peaks)];
    let three = swept(&case, axes, &more);
    for figure in two.figures().expect("figures").iter().chain(&three.figures().expect("figures")) {
        common::words_are_apart(figure, &draw(figure).expect("drawn").texts);
        common::caption_is_short(figure);
    }
}
