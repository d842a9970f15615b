//! The maps of a sweep as images: each pixel against the point that it stands for.

use super::*;

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
    assert!(svg.contains("excitation frequency f (Hz)"));
}

/// Values that are not evenly spread have cells that end midway between them; on a logarithmic axis, at the
/// geometric mean.
#[test]
fn uneven_cells_end_midway() {
    assert_eq!(edges(&[1.0, 2.0, 4.0], AxisScale::Linear), [0.5, 1.5, 3.0, 5.0]);
    let log = edges(&[1.0, 4.0, 16.0], AxisScale::Log);
    for (found, wanted) in log.iter().zip([0.5, 2.0, 8.0, 32.0]) {
        // Through a logarithm and back.
        assert!((found / wanted - 1.0).abs() < 1e-14, "{log:?}");
    }
    assert_eq!(edges(&[5.0], AxisScale::Linear), [4.5, 5.5]);
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
        axis(&case, Parameter::Clearance, &values(0.005, 0.04)),
        axis(&case, Parameter::Frequency, &values(8.0, 8.7)),
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
        axis(&case, Parameter::Restitution, &values(1.0)),
        axis(&case, Parameter::Frequency, &values(8.0)),
    ];
    let drawn = render(&figure(&swept(&case, axes, &columns), "sweep-amplitude")).expect("drawn");
    let map = &shown(&drawn)[0];
    assert_eq!((map.rows.len(), map.rows[0].len()), (COUNT as usize, COUNT as usize));
    let tints: std::collections::BTreeSet<[u8; 3]> =
        map.rows.iter().flatten().map(|tint| tint.0).collect();
    assert_eq!(tints.len(), 64);
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
