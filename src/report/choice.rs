//! What an absorber and a tuned mass damper come to as the structure's natural frequency drifts.

use serde_json::Value;

use super::chart::AxisOf;
use super::figure::{Color, Dash, Figure, Layer, Marker, Panel, Role, Shape, Style};
use super::transient::DAMPER;
use crate::alternatives::Alternatives;
use crate::case::Case;
use crate::measure::Device;
use crate::quantity::catalogue as of;

/// A damper in the absorber's room.
const EQUAL: Style = Style::new(Color::SkyBlue, 1.1, Dash::Solid);
/// The name of the figure, which stands beside its table.
pub const NAME: &str = "choice";

/// The figure; none where the frequency of a structure cannot drift.
pub fn figure(case: &Case, found: &Alternatives, facts: &Value) -> Option<Figure> {
    let over = &found.over_drift;
    let (first, last) = (over.absorber.first()?.0, over.absorber.last()?.0);
    if first == last {
        return None;
    }
    let units = case.units();
    let absorber: Vec<[f64; 2]> =
        over.absorber.iter().map(|(drift, [value, _])| [*drift, *value]).collect();
    let all = over.dampers.iter().flatten().chain(&absorber).map(|one| one[1]);
    let largest = all.filter(|one| one.is_finite()).fold(0.0, f64::max);
    let x = AxisOf::si(units, &of::FREQUENCY_DRIFT).axis([first, last]);
    let y = AxisOf::si(units, found.measure.kind(Device::Absorber)?).axis([0.0, 1.1 * largest]);
    let [usual, equal] = over.dampers.clone();
    // Between what is computed at a few places nothing is known.
    let few = usual.len() == absorber.len();
    let line = |style: Style, shape, points: Vec<[f64; 2]>| match few {
        true => Layer::marked(Marker::hollow(shape), style.color, points),
        false => Layer::curve(style, points),
    };
    let panel = Panel::new(x, y)
        .with(line(DAMPER, Shape::Square, usual).labelled("tuned mass damper, best for this"))
        .with(line(EQUAL, Shape::Diamond, equal).labelled("in the absorber's room"))
        .with(Layer::points(Role::Simulation, absorber).labelled("absorber"));
    Some(Figure::new(NAME, "").with_panel(panel).with_facts("captions/choice", facts.clone()))
}
