//! Diagrams over one axis.

use super::super::AxisShown;
use super::super::grid::{Grid, SweepDirection};
use super::super::kinds;
use crate::regimes::Regime;
use crate::report::figure::{Axis, Tick};
use crate::report::figure::{
    Cells, Color, Figure, Image, Layer, Layout, MarkedPoint, Marker, Panel, Role, Shape, Tint,
};

/// Columns of a Poincaré section.
const SECTIONS: u32 = 16;

pub(super) fn all(grid: &Grid) -> Vec<Figure> {
    let [axis] = grid.swept.axes.as_slice() else { return Vec::new() };
    let mut figures = Vec::new();
    figures.extend(diagram(grid, axis));
    figures.extend(section(grid, axis));
    for (name, column, what, label) in [
        ("sweep-reduction", "reduction_db", "Reduction of the peak", "reduction (dB)"),
        (
            "sweep-efficiency",
            "efficiency",
            "Efficiency of the targeted energy transfer",
            "efficiency (1)",
        ),
        ("sweep-lyapunov", "lyapunov", "Largest Lyapunov exponent", "exponent per period (1)"),
    ] {
        figures.extend(values(grid, axis, name, [column, what, label]));
    }
    figures
}

/// The axis with half a step to either side, where single cells have their middle.
fn horizontal(axis: &AxisShown) -> Axis {
    let edges = axis.edges();
    axis.drawn(edges[0], edges[edges.len() - 1])
}

/// How points of a pass look where colours do not tell regimes.
fn marks(pass: SweepDirection) -> (Marker, Color, &'static str) {
    match pass {
        SweepDirection::Single => {
            (Marker::filled(Shape::Circle).sized(4.4), Color::ReddishPurple, "simulated")
        }
        SweepDirection::Up => {
            (Marker::filled(Shape::Circle).sized(4.4), Color::ReddishPurple, "way up")
        }
        SweepDirection::Down => (Marker::hollow(Shape::Square).sized(5.4), Color::Blue, "way down"),
    }
}

fn points(axis: &AxisShown, values: &[Option<f64>]) -> Vec<[f64; 2]> {
    let pairs = axis.values.iter().zip(values);
    pairs.filter_map(|(x, y)| Some([*x, (*y)?])).collect()
}

/// A line that is interrupted where there is no value.
fn line(axis: &AxisShown, values: &[Option<f64>]) -> Vec<[f64; 2]> {
    axis.values.iter().zip(values).map(|(x, y)| [*x, y.unwrap_or(f64::NAN)]).collect()
}

/// The peak over the axis, with exact orbit and bare oscillator as lines; a strip of regimes below where the way
/// up and the way down are both drawn.
fn diagram(grid: &Grid, axis: &AxisShown) -> Option<Figure> {
    let passes = grid.passes();
    let peaks: Vec<(SweepDirection, Vec<Option<f64>>)> =
        passes.iter().filter_map(|pass| Some((*pass, grid.length("peak", *pass)?))).collect();
    let label = format!("largest displacement ({})", grid.lengths.unit);
    let mut panel = Panel::new(horizontal(axis), Axis::linear(label));
    if let Some(bare) = grid.length("bare_amplitude", SweepDirection::Single) {
        let layer = Layer::curve(Role::BareOscillator, line(axis, &bare));
        panel = panel.with(layer.labelled("without absorber"));
    }
    if let (Some(largest), [(SweepDirection::Single, main)]) =
        (grid.length("largest_peak", SweepDirection::Single), peaks.as_slice())
    {
        // Another motion where it is told apart from the main one at this size.
        let other = |(largest, main): (&Option<f64>, &Option<f64>)| {
            largest.filter(|largest| main.is_none_or(|main| *largest > 1.01 * main))
        };
        let others: Vec<Option<f64>> = largest.iter().zip(main).map(other).collect();
        let marker = Marker::hollow(Shape::Diamond).sized(5.0);
        let layer = Layer::marked(marker, Color::Grey, points(axis, &others));
        if others.iter().any(Option::is_some) {
            panel = panel.with(layer.labelled("largest other motion"));
        }
    }
    for (pass, values) in &peaks {
        match grid.regimes(*pass).filter(|_| *pass == SweepDirection::Single) {
            Some(regimes) => panel.layers.extend(by_regime(axis, values, &regimes)),
            None => {
                let (marker, color, name) = marks(*pass);
                panel =
                    panel.with(Layer::marked(marker, color, points(axis, values)).labelled(name));
            }
        }
    }
    // In front of the marks, which it would else be hidden by where they agree.
    let orbit = grid.length("orbit_peak", SweepDirection::Single);
    if let Some(orbit) = orbit.filter(|orbit| orbit.iter().any(Option::is_some)) {
        let layer = Layer::curve(Role::ExactOrbit, line(axis, &orbit));
        panel = panel.with(layer.labelled("exact 1:1 orbit"));
    }
    if panel.layers.is_empty() {
        return None;
    }
    let followed = passes.len() > 1;
    let caption = if followed {
        "The oscillator's peak where the motion was followed up and down; where the two differ there is hysteresis. Below: the regimes of \
         both ways."
    } else if peaks.is_empty() {
        "The oscillator's peak by closed form and exact orbit; nothing was simulated."
    } else {
        "The oscillator's peak in the main motion; colour and mark are its regime. Where the exact orbit's line runs through the marks \
         they are one motion."
    };
    let title = format!("Peak over {}", axis.name);
    let alt = format!("{title}. {caption}");
    let mut figure = Figure::new("sweep-bifurcation", title).with_words(caption, alt);
    panel.layers.extend(own(axis));
    let strip = strip(grid, axis, &passes).filter(|_| followed);
    figure = figure.with_panel(panel);
    if let Some((strip, present)) = strip {
        for regime in present {
            figure = figure.with_key(kinds::tint(regime), regime.words());
        }
        let layout = Layout::rows(&[5.0, 1.0]);
        figure = figure.with_size(720, 560).with_layout(layout).with_panel(strip);
    }
    Some(figure)
}

/// A line at the case's own value.
fn own(axis: &AxisShown) -> Option<Layer> {
    use crate::report::figure::{Dash, Rule, Style};
    let edges = axis.edges();
    let own = axis.own.filter(|own| *own > edges[0] && *own < edges[edges.len() - 1])?;
    let style = Style::new(Color::Grey, 1.2, Dash::DashDot);
    Some(Layer::rule(Rule::Vertical(own), style).labelled("this case"))
}

/// Points of each regime in its own colour and mark.
fn by_regime(axis: &AxisShown, values: &[Option<f64>], regimes: &[Option<Regime>]) -> Vec<Layer> {
    let of = |regime: Regime| {
        let here: Vec<MarkedPoint> = (0..values.len())
            .filter(|k| regimes[*k] == Some(regime))
            .filter_map(|k| Some(MarkedPoint::new(axis.values[k], values[k]?)))
            .collect();
        let (marker, color) = kinds::mark(regime);
        (!here.is_empty()).then(|| Layer::marked(marker, color, here).labelled(regime.short()))
    };
    Regime::ALL.into_iter().filter_map(of).collect()
}

/// The regimes of each pass as a row of colours, and those that occur.
fn strip(grid: &Grid, axis: &AxisShown, passes: &[SweepDirection]) -> Option<(Panel, Vec<Regime>)> {
    let rows: Option<Vec<Vec<Option<Regime>>>> =
        passes.iter().map(|pass| grid.regimes(*pass)).collect();
    let rows = rows?;
    // The first pass above the second.
    let cells =
        rows.iter().rev().flatten().map(|regime| regime.map(|one| one.index() as u8)).collect();
    let tints: Vec<Tint> = Regime::ALL.map(kinds::tint).to_vec();
    let image = Image {
        x_edges: axis.edges(),
        y_edges: (0..=rows.len()).map(|k| k as f64).collect(),
        cells: Cells::Kinds(tints, cells),
    };
    let name = |pass: &SweepDirection| if *pass == SweepDirection::Up { "up" } else { "down" };
    let ticks = passes
        .iter()
        .rev()
        .enumerate()
        .map(|(row, pass)| Tick { value: row as f64 + 0.5, label: Some(name(pass).to_owned()) });
    let y = Axis::linear("").with_range(0.0, rows.len() as f64).with_ticks(ticks.collect());
    let present = Regime::ALL
        .into_iter()
        .filter(|regime| rows.iter().flatten().any(|one| *one == Some(*regime)));
    Some((Panel::new(horizontal(axis), y).with(Layer::Image(image)), present.collect()))
}

/// The displacement once a period, at the end of the last periods.
fn section(grid: &Grid, axis: &AxisShown) -> Option<Figure> {
    let label = format!("displacement once a period ({})", grid.lengths.unit);
    let mut panel = Panel::new(horizontal(axis), Axis::linear(label));
    for pass in grid.passes() {
        let all = (1..=SECTIONS).filter_map(|k| grid.length(&format!("section_{k:02}"), pass));
        let dots: Vec<[f64; 2]> = all.flat_map(|values| points(axis, &values)).collect();
        if dots.is_empty() {
            continue;
        }
        let (_, color, name) = marks(pass);
        let marker = Marker { filled: pass != SweepDirection::Down, ..Marker::dot() };
        let layer = Layer::marked(marker, color, dots);
        panel =
            panel.with(if pass == SweepDirection::Single { layer } else { layer.labelled(name) });
    }
    if panel.layers.is_empty() {
        return None;
    }
    panel.layers.extend(own(axis));
    let title = format!("Poincaré section over {}", axis.name);
    let caption = "The oscillator's displacement at the end of each of the last 16 excitation periods: one dot where the motion repeats \
                   every period, some where it repeats after several, a cloud where it does not repeat.";
    Some(
        Figure::new("sweep-section", title.clone())
            .with_panel(panel)
            .with_words(caption, format!("{title}. {caption}")),
    )
}

/// A quantity of the main motion over the axis.
fn values(
    grid: &Grid,
    axis: &AxisShown,
    name: &'static str,
    [column, what, label]: [&str; 3],
) -> Option<Figure> {
    let mut panel = Panel::new(horizontal(axis), Axis::linear(label));
    for pass in grid.passes() {
        let Some(values) = grid.number(column, pass) else { continue };
        let known = points(axis, &values);
        if known.is_empty() {
            continue;
        }
        match grid.regimes(pass).filter(|_| pass == SweepDirection::Single) {
            Some(regimes) => panel.layers.extend(by_regime(axis, &values, &regimes)),
            None => {
                let (marker, color, name) = marks(pass);
                panel = panel.with(Layer::marked(marker, color, known).labelled(name));
            }
        }
    }
    if panel.layers.is_empty() {
        return None;
    }
    panel.layers.extend(own(axis));
    let title = format!("{what} over {}", axis.name);
    let caption = match column {
        "reduction_db" => {
            "Above 0 the main motion vibrates less than the oscillator alone, below 0 more."
        }
        "lyapunov" => "Above 0 neighbouring motions part: the main motion is chaotic.",
        _ => "The share of the excitation's work that impacts dissipate, in the main motion.",
    };
    let alt = format!("{title}. {caption}");
    Some(Figure::new(name, title).with_panel(panel).with_words(caption, alt))
}
