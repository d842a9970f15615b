//! The figures of a report, made from the [`Plot`]s of a study.
//!
//! A figure places data on axes by what these show (`report/chart.rs`); title, caption and alternative text come
//! from `templates/captions/`.

pub(super) mod borders;
mod boundaries;
mod diagram;
mod dissipation;
mod motions;
mod over_time;
pub(in crate::report) mod parts;
mod peaks;
mod ranges;
pub mod regimes;
mod responses;
mod statistics;

use serde::Serialize;
use serde_json::{Value, json};

use crate::analysis::ManifoldBranch;
use crate::case::{Case, Criterion};
use crate::measure::Measure;
use crate::method::Method;
use crate::quantity::{Digits, Dimension, Kind, Units, catalogue as of};
use crate::study::CaseStudy;
use crate::study::plots::Plot;
use crate::system::{Parameter, System};

use super::chart::{AxisOf, Chart};
use super::document::motions::found;
use super::document::{Scale, theory};
use super::figure::{Axis, Figure, Layer, MarkedPoint};

/// All figures of a report, in reading order; their words are still to be filled in by
/// [`super::template::worded`].
pub fn all(case: &Case, study: &CaseStudy, plots: &[Plot]) -> Vec<Figure> {
    let scene = DrawnCase::new(case, study);
    let mut figures: Vec<Figure> = plots.iter().flat_map(|plot| scene.figures_of(plot)).collect();
    for panel in figures.iter_mut().flat_map(|figure| &mut figure.panels) {
        // A layer without points would still be named.
        let empty =
            |layer: &Layer| matches!(layer, Layer::Points { points, .. } if points.is_empty());
        panel.layers.retain(|layer| !empty(layer));
    }
    figures
}

/// A studied case and its units. Numbers that go in are dimensionless: lengths over the clearance, times in
/// excitation periods, frequencies and excitation amplitudes as ratios.
struct DrawnCase<'a> {
    study: &'a CaseStudy,
    units: Units,
    /// The excitation's amplitude, and what it is.
    forcing: (&'static Kind, f64),
    /// The largest displacement that the case allows.
    limit: Option<f64>,
    /// What else it asks of a structure that moves in sines, each measure once.
    asked: Vec<&'a Criterion>,
    /// Where the theory's boundaries are.
    ends: Ends,
    /// What every caption may speak of.
    known: Value,
}

/// Clearances over the case's at which a boundary of the theory lies.
#[derive(Debug, Clone, Copy, Serialize)]
struct Ends {
    breaking: f64,
    hopf: f64,
    /// Where two fixed points collide and leave nothing, and on which branch, if they do.
    last: Option<f64>,
    branch: Option<ManifoldBranch>,
}

impl<'a> DrawnCase<'a> {
    fn new(case: &'a Case, study: &'a CaseStudy) -> Self {
        let scale = Scale::of(case);
        let mut limits = case.criteria.iter();
        let asked = limits.find(|one| one.measure == Measure::Peak);
        let mut others: Vec<&Criterion> = Vec::new();
        for one in case.criteria.iter().filter(|one| one.measure.is_of_sines()) {
            let is_known = others.iter().any(|known| known.measure == one.measure);
            if one.measure != Measure::Peak && !is_known {
                others.push(one);
            }
        }
        let own = scale.amplitude(1.0, Method::Given);
        let system = &study.analysis.system;
        let bounds = &study.analysis.boundaries;
        let over_own = |gamma: f64| system.forcing_per_clearance() / gamma;
        let ends = Ends {
            breaking: over_own(bounds.symmetry_breaking),
            hopf: over_own(bounds.hopf),
            last: bounds.saddle_node.map(|node| over_own(node.forcing_over_clearance)),
            branch: bounds.saddle_node.map(|node| node.branch),
        };
        let motions = found(&scale, study, case.count_inactive);
        let known = json!({
            "frequency": scale.units.quantity(&of::EXCITATION_FREQUENCY, system.frequency_ratio(), Method::Given),
            "clearance": scale.units.quantity(&of::CLEARANCE, 1.0, Method::Given),
            // Units of lengths over the clearance and of frequency ratios.
            "b": scale.units.length(1.0),
            "f0": scale.units.frequency(1.0),
            "theory": theory::with_margins(&scale, study),
            "ends": ends,
            "motions": motions,
        });
        Self {
            study,
            units: scale.units,
            forcing: (own.kind, own.value),
            limit: asked.map(|one| one.limit / scale.units.length(1.0)),
            asked: others,
            ends,
            known,
        }
    }

    fn figures_of(&self, plot: &Plot) -> Vec<Figure> {
        let figure = match plot {
            Plot::Band(data) => {
                let others = self.asked.iter().map(|one| peaks::band_of(self, data, one));
                return peaks::band(self, data).into_iter().chain(others.flatten()).collect();
            }
            Plot::Ranges(data) => ranges::figure(self, data),
            Plot::Map(data) => Some(boundaries::map(self, data)),
            Plot::Plane(data) => Some(boundaries::plane(self, data)),
            Plot::Manifold => Some(responses::manifold(self)),
            Plot::Responses(data) => Some(responses::figure(self, data)),
            Plot::Amplitude(data) => Some(peaks::amplitude(self, data)),
            Plot::Motion(data) => {
                let motion = over_time::motion(self, data);
                return [motion]
                    .into_iter()
                    .chain(statistics::return_map(self, data.index))
                    .collect();
            }
            Plot::Areas(data) => Some(responses::areas(self, data)),
            Plot::Bifurcations(data) => Some(boundaries::bifurcations(self, data)),
            Plot::Modulation(data) => Some(motions::modulation(self, data)),
            Plot::Restitutions(data) => Some(motions::restitutions(self, data)),
            Plot::Dissipation(data) => Some(dissipation::figure(self, data)),
            Plot::Basins(data) => Some(statistics::basins(self, data)),
            Plot::Captures => over_time::captures(self),
            Plot::Exponents(data) => statistics::exponents(self, data),
            Plot::Clearances(data) => Some(peaks::clearances(self, data)),
            Plot::Transfer(data) => Some(over_time::transfer(self, data)),
            Plot::TransferStretches(data) => over_time::stretches(self, data),
            Plot::Diagram(data, bare) => Some(diagram::figure(self, data, bare)),
        };
        figure.into_iter().collect()
    }

    const fn system(&self) -> &'a System {
        &self.study.analysis.system
    }

    /// The clearance, over the case's, that a forcing per clearance stands for.
    fn clearance(&self, gamma: f64) -> f64 {
        self.system().forcing_per_clearance() / gamma
    }

    /// The frequency ratio of a detuning.
    fn ratio(&self, detuning: f64) -> f64 {
        1.0 + self.system().mass_ratio() * detuning
    }

    /// A dimensionless number in SI, or in the units of a reduced case.
    fn si(&self, kind: &Kind, value: f64) -> f64 {
        if kind.id == self.forcing.0.id {
            return value * self.forcing.1;
        }
        let of_time = kind.dimension == Dimension::Time;
        let unit = if of_time { self.system().period() } else { 1.0 };
        self.units.number(kind.dimension, value * unit)
    }

    /// An axis of dimensionless numbers.
    fn axis(&self, kind: &Kind, range: [f64; 2]) -> Axis {
        AxisOf::si(self.units, kind).counting(self.si(kind, 1.0)).axis(range)
    }

    /// Two of them that know their kinds.
    fn chart(&self, kinds: [&'static Kind; 2], ranges: [[f64; 2]; 2]) -> Chart {
        Chart { kinds, ranges, axes: [0, 1].map(|k| self.axis(kinds[k], ranges[k])) }
    }

    /// A number with its unit.
    fn text(&self, kind: &Kind, value: f64) -> String {
        self.units.text(kind, self.si(kind, value))
    }

    /// A name of a curve by its clearance: `b = 7.500 mm`.
    fn at_clearance(&self, clearance: f64) -> String {
        format!("b = {}", self.short(&of::BOUNDARY, clearance))
    }

    /// A number in three digits, with its unit.
    fn short(&self, kind: &Kind, value: f64) -> String {
        self.units.with_digits(kind, self.si(kind, value), Digits::Significant(3))
    }

    /// What a tooltip says: `simulated, symmetric 1:1: f = 8.304 Hz, x̂ = 3.56 mm`.
    fn tip(&self, what: &str, values: &[(&'static Kind, f64)]) -> String {
        let say = |(kind, value): &(&'static Kind, f64)| {
            let symbol = if kind.symbol.is_empty() { kind.name } else { kind.symbol };
            format!("{symbol} = {}", self.text(kind, *value))
        };
        let said: Vec<String> = values.iter().map(say).collect();
        format!("{what}: {}", said.join(", "))
    }

    /// A point with a tooltip that gives both of its coordinates.
    fn mark(&self, chart: &Chart, at: [f64; 2], what: &str) -> MarkedPoint {
        let [x, y] = chart.kinds;
        MarkedPoint::from(at).with_tooltip(self.tip(what, &[(x, at[0]), (y, at[1])]))
    }

    /// The mark of the case.
    fn star(&self, chart: &Chart, at: [f64; 2]) -> Layer {
        Layer::this_case(at, self.mark(chart, at, "this case").tooltip)
    }

    /// What a parameter is.
    fn kind(&self, parameter: Parameter) -> &'static Kind {
        match parameter {
            Parameter::Clearance => &of::CLEARANCE,
            Parameter::Frequency => &of::EXCITATION_FREQUENCY,
            Parameter::Amplitude => self.forcing.0,
            _ => &of::RESTITUTION,
        }
    }

    /// A figure whose words come from `templates/captions/`, which get what is known of the case beside the
    /// facts.
    fn figure(&self, name: &str, template: &'static str, facts: Value) -> Figure {
        let mut all = self.known.clone();
        if let (Value::Object(all), Value::Object(facts)) = (&mut all, facts) {
            all.extend(facts);
        }
        Figure::new(name, "").with_facts(template, all)
    }
}
