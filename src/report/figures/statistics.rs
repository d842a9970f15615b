//! Return maps (Fig. 11), basins of attraction, and Lyapunov exponents.

use serde_json::{Value, json};

use crate::method::Method;
use crate::motions::Motion;
use crate::quantity::{Quantity, catalogue as of};
use crate::regimes::return_map::pairs;
use crate::regimes::{Exponent, Regime};
use crate::report::chart::FITTED;
use crate::report::figure::{
    Cells, Color, Dash, Figure, Fill, Hatch, Image, Key, Label, Layer, MarkedPoint, Marker, Role,
    Rule, Style, Tint,
};
use crate::study::plots::{MotionExponents, StartPlane, drawn};

use super::DrawnCase;
use super::regimes::tint;

/// At most so many points of a return map, the last ones.
const POINTS: usize = 600;
/// Points that differ by less in both coordinates are one.
const SAME: f64 = 2e-3;
/// Up to so many points are drawn large and with a tooltip.
const SINGLE: usize = 12;
/// Axes of a return map end at the data between these, in periods.
const ENDS: [f64; 2] = [1.25, 4.0];

/// Each time between impacts against the next one; none where there are too few impacts.
pub(super) fn return_map(scene: &DrawnCase, index: usize) -> Option<Figure> {
    let impacts = &drawn(scene.study, index)?.1.impacts;
    let first = impacts.len().saturating_sub(POINTS + 2);
    let all = pairs(&impacts[first..], scene.system().period());
    let points = distinct(&all);
    let largest = points.iter().flatten().copied().reduce(f64::max)?;
    let end = (1.08 * largest).clamp(ENDS[0], ENDS[1]);
    let kinds = [&of::IMPACT_INTERVAL, &of::NEXT_INTERVAL];
    let chart = scene.chart(kinds, [[0.0, end]; 2]);
    let few = points.len() <= SINGLE;
    let marker = Marker::dot().sized(if few { 8.0 } else { 3.6 });
    let marks = points.iter().map(|at| {
        let mark = scene.mark(&chart, *at, "time between impacts");
        if few { mark } else { MarkedPoint::from(*at) }
    });
    let names = if end < 2.0 { ["L1: sum is T", "L4: equal"] } else { ["L1", "L4"] };
    let near = 0.94 * end;
    let style = Role::Guide.style().colored(Color::Grey);
    let guide = |rule, name, at| Layer::rule(rule, style).labelled(Label::near(name, at));
    let sloped = |through, slope| Rule::Sloped { through, slope };
    let panel = chart
        .panel()
        .with(guide(sloped([0.0, 1.0], -1.0), names[0], [0.7, 0.35]))
        .with(guide(Rule::Vertical(1.0), "L2", [1.0, near]))
        .with(guide(Rule::Horizontal(1.0), "L3", [near, 1.0]))
        .with(guide(sloped([0.0, 0.0], 1.0), names[1], [0.95 * near, 0.95 * near]))
        .with(Layer::marked(marker, Role::Simulation.color(), marks))
        .with_equal_aspect();
    let facts = return_facts(&all, &points, index);
    let figure = scene.figure(&format!("return-map-{}", index + 1), "captions/return-map", facts);
    Some(figure.with_size(480, 450).with_panel(panel))
}

/// The points without those that coincide with an earlier one.
fn distinct(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut kept: Vec<[f64; 2]> = Vec::new();
    for point in points {
        let same = |other: &[f64; 2]| (0..2).all(|i| (point[i] - other[i]).abs() < SAME);
        if !kept.iter().any(same) {
            kept.push(*point);
        }
    }
    kept
}

fn return_facts(all: &[[f64; 2]], distinct: &[[f64; 2]], index: usize) -> Value {
    let on_line = all.iter().filter(|[x, y]| (x + y - 1.0).abs() < 0.02).count();
    let firsts = || distinct.iter().map(|point| point[0]);
    let (least, most) = (firsts().fold(f64::INFINITY, f64::min), firsts().fold(0.0, f64::max));
    json!({
        "index": index,
        "points": distinct.len(),
        // Each of them seen several times.
        "repeats": distinct.len() <= SINGLE && all.len() >= 4 * distinct.len(),
        "least": least,
        "most": most,
        "on_line": on_line as f64 / all.len() as f64,
        "beyond": (most > ENDS[1]).then_some(ENDS[1]),
    })
}

/// The tint of each motion in turn, whatever its regime; the last stands for all further ones.
const TINTS: [Tint; 5] = [
    tint(Regime::TwoAsymmetric),
    tint(Regime::StronglyModulated),
    tint(Regime::TwoSymmetric),
    tint(Regime::AboveTwo),
    tint(Regime::BelowTwo),
];

/// Which starts lead to which long-term motion.
pub(super) fn basins(scene: &DrawnCase, data: &StartPlane) -> Figure {
    let cells = data.motions.led();
    let kinds = [&of::DISPLACEMENT, &of::VELOCITY];
    let chart = scene.chart(kinds, [[-data.reach, data.reach]; 2]);
    let edges: Vec<f64> = data.edges().collect();
    // What still settles leads nowhere that is known.
    let settled = |index: &usize| data.motions.get(*index).is_some_and(Motion::settled);
    let leads = |cell: &Option<usize>| cell.filter(settled);
    let kind = |cell: &Option<usize>| leads(cell).map(|index| index.min(TINTS.len() - 1) as u8);
    let image = Image {
        x_edges: edges.clone(),
        y_edges: edges,
        cells: Cells::Kinds(TINTS.to_vec(), cells.iter().map(kind).collect()),
    };
    let share = |wanted: Option<usize>| {
        let count = cells.iter().filter(|cell| leads(cell) == wanted).count();
        (count > 0).then_some(count as f64 / cells.len() as f64)
    };
    // Without impacts and damping a free vibration never fades.
    let undamped = scene.system().damping() == 0.0;
    let (mut keys, mut motions) = (Vec::new(), Vec::new());
    for (index, motion) in data.motions.iter().enumerate() {
        let Some(share) = share(Some(index)) else { continue };
        let (regime, free) = (motion.regime(), motion.rest().is_some() && undamped);
        let peak = (!free).then_some(motion.facts().peak.value);
        let words = peak.map_or("depends on the start".to_owned(), |x| scene.text(&of::PEAK, x));
        let label = format!("{}, peak {words}", regime.words());
        keys.push(Key { tint: TINTS[index.min(TINTS.len() - 1)], label });
        motions.push(json!({ "share": share, "regime": regime, "peak": peak }));
    }
    let open = share(None);
    keys.extend(open.map(|_| Key::from((Tint::UNKNOWN, "not settled"))));
    let facts = json!({
        "starts": cells.len(),
        "periods": data.transient,
        "motions": motions,
        "open": open,
    });
    let panel = chart.panel().with(Layer::Image(image)).with_heading("the oscillator at the start");
    let figure = scene.figure("basins", "captions/basins", facts);
    Figure { keys, ..figure.with_size(640, 640).with_panel(panel) }
}

/// How the largest Lyapunov exponent of each motion converges, and what the exact orbit says of it.
pub(super) fn exponents(scene: &DrawnCase, data: &[MotionExponents]) -> Option<Figure> {
    data.first()?;
    let kinds = [&of::WINDOW, &of::LYAPUNOV_EXPONENT];
    let chart = scene.chart(kinds, [FITTED; 2]).with_log([true, false]);
    let mut panel = chart.panel().with(Layer::horizontal(0.0, Role::Guide));
    let mut motions = Vec::new();
    for (one, color) in data.iter().zip([Color::Blue, Color::Vermillion, Color::BluishGreen]) {
        let line = |value: fn(&Exponent) -> f64| -> Vec<[f64; 2]> {
            one.exponents.iter().map(|at| [at.periods as f64, value(at)]).collect()
        };
        let fill = Fill { color, opacity: 0.15, hatch: Hatch::None };
        let interval = [line(|at| at.interval[0]), line(|at| at.interval[1])];
        let found = &scene.study.measured[one.index];
        let dynamics = found.classification.dynamics.words();
        let style = Style::new(color, 1.8, Dash::Solid);
        let exponent = Layer::curve(style, line(|at| at.per_period));
        let name = format!("{}, {dynamics}", found.regime().words());
        panel = panel.with(Layer::between(&interval[0], &interval[1], fill));
        panel = panel.with(exponent.labelled(name));
        if let Some(exact) = one.exact {
            let style = Style { dash: Dash::Dashed, ..Role::ExactOrbit.style() };
            let rule = Layer::horizontal(exact, style);
            panel = panel.with(rule.labelled("logarithm of the multiplier"));
        }
        let last = one.exponents.last()?;
        let value = Quantity::new(&of::LYAPUNOV_EXPONENT, last.per_period, Method::Simulation);
        motions.push(json!({
            "regime": found.regime(),
            "dynamics": dynamics,
            "exponent": value.with_error(2.0 * last.standard_error),
            "periods": last.periods,
            "exact": one.exact,
        }));
    }
    let facts = json!({ "motions": motions });
    Some(scene.figure("exponents", "captions/exponents", facts).with_panel(panel))
}
