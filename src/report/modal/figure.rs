//! The largest displacement under each load, drawn.

use serde_json::Value;

use super::{Beside, units};
use crate::case::{ActsOn, Load, ModalCase};
use crate::linear::ModalDamper;
use crate::modal::{ModalAnswer, linear_peak, linear_places};
use crate::motions::ModalMotion;
use crate::quantity::catalogue as of;
use crate::report::chart::AxisOf;
use crate::report::figure::{
    Color, Dash, Figure, Layer, Layout, Marker, Panel, Role, Shape, Style,
};
use crate::report::transient::DAMPER;

/// Several tuned mass dampers.
const DAMPERS: Style = Style::new(Color::SkyBlue, 1.1, Dash::Solid);
/// What is asked.
const LIMIT: Style = Style::new(Color::Vermillion, 1.3, Dash::Dashed);

/// Largest displacement of any place over the frequency, a panel for each load.
pub(super) fn loads(
    case: &ModalCase,
    answer: &ModalAnswer,
    beside: &Beside,
    facts: &Value,
) -> Figure {
    let units = units(case);
    let mut figure = Figure::new("loads", "");
    let mut count = 0;
    for (k, along) in answer.along.iter().enumerate() {
        let [from, to] = along.load.range_hz;
        if from == to {
            continue;
        }
        count += 1;
        let highest = along.places.iter().flat_map(|one| &one.motions).flat_map(|one| &one.places);
        let highest = highest.map(|one| one.peak).fold(0.0, f64::max);
        let limit =
            case.criteria.iter().map(|one| one.criterion.limit).fold(f64::INFINITY, f64::min);
        let limit = Some(limit).filter(|limit| limit.is_finite());
        let top = 1.15 * limit.map_or(highest, |limit| limit.max(highest));
        let x = AxisOf::si(units, &of::EXCITATION_FREQUENCY).axis([from, to]);
        let y = AxisOf::si(units, &of::PEAK).axis([0.0, top]);
        let curve = |of: &dyn Fn(f64) -> f64| -> Vec<[f64; 2]> {
            linear_places(along.load.range_hz, case).into_iter().map(|at| [at, of(at)]).collect()
        };
        let linear =
            |dampers: &[ModalDamper]| curve(&|at| linear_peak(case, &along.load, at, dampers));
        let mut panel = Panel::new(x, y)
            .with(Layer::curve(Role::BareOscillator, linear(&[])).labelled("without absorbers"));
        for (choice, style) in beside.dampers.iter().zip([DAMPER, DAMPERS]) {
            let name = match choice.dampers.len() {
                1 => "one tuned mass damper".to_owned(),
                many => format!("{many} tuned mass dampers"),
            };
            panel = panel.with(Layer::curve(style, linear(&choice.dampers)).labelled(name));
        }
        if let Some(limit) = limit {
            panel = panel.with(Layer::horizontal(limit, LIMIT).labelled("limit"));
        }
        // Not those in which every absorber rests, which are on the line without them.
        let seen = along.places.iter().flat_map(|one| {
            let most =
                |motion: &ModalMotion| motion.places.iter().map(|one| one.peak).fold(0.0, f64::max);
            let acts = |motion: &&ModalMotion| !motion.rests();
            one.motions.iter().filter(acts).map(move |motion| [one.at, most(motion)])
        });
        let marker = Marker::filled(Shape::Circle).sized(5.0);
        panel = panel.with(
            Layer::marked(marker, Role::Simulation.color(), seen.collect::<Vec<_>>())
                .labelled("with absorbers"),
        );
        figure = figure.with_panel(panel.with_heading(heading(case, k, &along.load)));
    }
    let layout = Layout::rows(&vec![1.0; count.max(1)]);
    let height = 90 + 250 * u32::try_from(count).unwrap_or(1);
    figure.with_layout(layout).with_size(720, height).with_facts("captions/loads", facts.clone())
}

fn heading(case: &ModalCase, number: usize, load: &Load) -> String {
    let on = match load.on {
        ActsOn::Place(place) => format!("force at {}", case.places[place]),
        ActsOn::Mode(mode) => format!("force in mode {}", mode + 1),
        ActsOn::Base => "moving base".to_owned(),
    };
    if case.loads.len() > 1 { format!("load {}: {on}", number + 1) } else { on }
}
