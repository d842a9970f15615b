//! The page of `vinesink tradeoff` as data, which is also its JSON document. The sentences are in
//! `templates/`. Seconds belong to one machine and stay out of the page.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::Serialize;
use serde_json::json;

use super::{Best, Layer, Method, Search, Tradeoff, Trial};
use crate::case::Case;
use crate::method::Method as KnownBy;
use crate::quantity::{Quantity, catalogue};
use crate::report::FigureRow;
use crate::report::document::Scale;
use crate::report::render::{RenderError, drawings, figure_files, without_repeated_blank_lines};
use crate::report::template::{aligned, render, worded};
use crate::study::answer::WhyNot;

/// Relative error of the amplitude that the page speaks of where the case asks for none.
pub const USUAL: f64 = 0.01;

/// Layers that compete, from the cheapest; the baseline is compared with them.
const COMPETING: [Layer; 4] =
    [Layer::ClosedForm, Layer::SlowFlow, Layer::ExactOrbit, Layer::Simulation];

/// `vinesink/tradeoff@3`. What refers to a method is its place in `methods`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TradeoffDocument<'a> {
    format: &'static str,
    title: &'a str,
    /// Relative error of the amplitude that is asked for.
    pub(super) allowed: f64,
    #[serde(flatten)]
    pub(super) found: &'a Tradeoff,
    /// Of the best answer: in metres, or in the case's own unit of length.
    rms_displacement: f64,
    /// Of the best answer: impacts per period with their error.
    impacts: Quantity,
    methods: Vec<MethodRow<'a>>,
    /// The cheapest that is enough; `None` where none is.
    enough: Option<usize>,
    /// The other layers.
    layers: Vec<LayerRow>,
    longer: Option<Longer>,
    /// A baseline whose amplitude is right and whose impacts are not.
    wrong_count: Option<usize>,
    flights: Option<FlightsRow>,
    case_sha256: &'a str,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct MethodRow<'a> {
    #[serde(flatten)]
    trial: &'a Trial,
    layer: Layer,
    rms_displacement: Option<f64>,
    /// Operations over those of the cheapest that is enough, or of the cheapest.
    times: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    seconds: Option<f64>,
}

/// What a layer has to offer against the cheapest that is enough.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct LayerRow {
    layer: Layer,
    /// Its cheapest method that is enough.
    enough: Option<usize>,
    /// Where none is, the method that comes closest.
    closest: Option<usize>,
    /// Excitation periods that this left out for a transient that is not over.
    transient: Option<u64>,
    /// Why it gives no answer.
    why_not: Option<WhyNot>,
}

/// What a longer simulation would take.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct Longer {
    /// Whether the longest that was tried is still in its transient: then no length can be told.
    in_transient: bool,
    periods: u64,
    operations: u64,
}

/// The baseline's flights in short.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct FlightsRow {
    variants: usize,
    /// Variants that miss impacts or invent some.
    wrong: usize,
    /// The worst of them.
    worst: usize,
}

impl<'a> TradeoffDocument<'a> {
    /// The document of a case, `allowed` being the relative error of the amplitude that it speaks of. With
    /// `seconds`, in the order of the trials, it is not the same twice.
    pub fn new(case: &'a Case, found: &'a Tradeoff, allowed: f64, seconds: Option<&[f64]>) -> Self {
        let scales = case.scales();
        let enough = winner(found, allowed);
        let answering = found.trials.iter().filter(|trial| trial.answer.rms.is_some());
        let cheapest = enough.map(|k| found.trials[k].operations);
        let cheapest = cheapest.or(answering.map(|trial| trial.operations).min()).unwrap_or(1);
        let row = |(k, trial): (usize, &'a Trial)| MethodRow {
            layer: trial.method.layer(),
            trial,
            times: trial.answer.rms.map(|_| trial.operations as f64 / cheapest.max(1) as f64),
            rms_displacement: trial.answer.rms.map(|rms| scales.length(rms)),
            seconds: seconds.and_then(|seconds| seconds.get(k).copied()),
        };
        let others = COMPETING.into_iter().chain([Layer::FixedStep]);
        let others =
            others.filter(|layer| enough.is_none_or(|k| found.trials[k].method.layer() != *layer));
        Self {
            format: "vinesink/tradeoff@3",
            title: &case.title,
            allowed,
            found,
            rms_displacement: scales.length(found.best.rms),
            impacts: impacts(&found.best),
            methods: found.trials.iter().enumerate().map(row).collect(),
            enough,
            layers: others.map(|layer| LayerRow::of(found, layer, allowed)).collect(),
            longer: longer(found, allowed),
            wrong_count: wrong_count(found),
            flights: flights(found),
            case_sha256: &case.text_hash,
        }
    }

    /// The files of the page, by their path in the case's folder.
    ///
    /// # Errors
    /// [`RenderError`] if template and page do not fit, or the figure cannot be drawn.
    pub fn files(&self, case: &Case) -> Result<BTreeMap<PathBuf, Vec<u8>>, RenderError> {
        let units = Scale::of(case).units();
        let figures = worded(vec![super::figure(self)], &units)?;
        let context = json!({
            "page": self,
            "figure": FigureRow::of(&figures[0]),
            "version": env!("CARGO_PKG_VERSION"),
        });
        let text = render("tradeoff.md", &units, &context)?;
        let mut files = figure_files(drawings(&figures)?);
        files.insert("tradeoff.md".into(), without_repeated_blank_lines(&text).into_bytes());
        Ok(files)
    }

    /// What the terminal shows: the page's words and every method with the time that it took.
    ///
    /// # Errors
    /// [`RenderError::Template`] if template and page do not fit.
    pub fn text(&self, case: &Case) -> Result<String, RenderError> {
        let text = render("tradeoff.txt", &Scale::of(case).units(), &json!({ "page": self }))?;
        Ok(aligned(&without_repeated_blank_lines(&text)))
    }
}

fn impacts(best: &Best) -> Quantity {
    let method = match best.layer {
        Layer::ExactOrbit => KnownBy::ExactOrbit,
        _ => KnownBy::Simulation,
    };
    let found = Quantity::new(&catalogue::IMPACTS_PER_PERIOD, best.impacts_per_period, method);
    found.with_error(best.impacts_error)
}

impl LayerRow {
    fn of(found: &Tradeoff, layer: Layer, allowed: f64) -> Self {
        let trials = || found.of_layer(layer);
        let errors = trials().filter_map(|(k, trial)| Some((k, trial.rms_error?.value)));
        let closest = errors.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, _)| k);
        Self {
            layer,
            enough: found.cheapest(layer, allowed),
            closest,
            transient: closest.and_then(|k| found.transient(&found.trials[k])),
            why_not: trials().find_map(|(_, trial)| trial.answer.why_not),
        }
    }
}

/// The cheapest method of the competing layers that is enough.
fn winner(found: &Tradeoff, allowed: f64) -> Option<usize> {
    let within = COMPETING.iter().filter_map(|layer| found.cheapest(*layer, allowed));
    within.min_by_key(|place| found.trials[*place].operations)
}

/// The length that a simulation of a motion without repetition would take: its scatter falls with
/// the root of the length. Of a transient that is not over no length can be told.
fn longer(found: &Tradeoff, allowed: f64) -> Option<Longer> {
    let simulations = found.trials.iter().filter_map(|trial| match trial.method {
        Method::Simulation { periods, search: Search::Panels, .. } => Some((periods, trial)),
        _ => None,
    });
    let (periods, longest) = simulations
        .filter(|(_, trial)| trial.answer.scatter.is_some_and(f64::is_finite))
        .max_by_key(|(periods, _)| *periods)?;
    let in_transient = found.transient(longest).is_some();
    let factor = longest.answer.scatter? / allowed;
    let told = in_transient || (found.best.layer == Layer::Simulation && factor > 1.0);
    told.then_some(Longer {
        in_transient,
        // Rounded up to whole thousands.
        periods: (periods as f64 * factor * factor / 1000.0).ceil() as u64 * 1000,
        operations: (longest.operations as f64 * factor * factor) as u64,
    })
}

/// Relative difference of a count of impacts that is worth a sentence.
const WRONG_COUNT: f64 = 0.5;

fn wrong_count(found: &Tradeoff) -> Option<usize> {
    let exact = found.best.impacts_per_period;
    let hand = found.of_layer(Layer::FixedStep);
    let off = hand.filter_map(|(k, trial)| {
        let difference = (trial.answer.impacts_per_period? - exact).abs();
        Some((k, difference / exact.max(f64::MIN_POSITIVE)))
    });
    let (k, off) = off.max_by(|a, b| a.1.total_cmp(&b.1))?;
    (off > WRONG_COUNT).then_some(k)
}

fn flights(found: &Tradeoff) -> Option<FlightsRow> {
    let flown = || {
        found.trials.iter().enumerate().filter_map(|(k, trial)| {
            let flights = trial.flights?;
            let wrong = flights.missed + flights.invented;
            Some((k, wrong as f64 / flights.compared.max(1) as f64))
        })
    };
    let (worst, _) = flown().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let wrong = flown().filter(|(_, wrong)| *wrong > 0.0).count();
    Some(FlightsRow { variants: flown().count(), wrong, worst })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evidence::tradeoff::TradeoffEffort;
    use crate::study::StudyEffort;

    #[test]
    fn page_and_terminal_say_what_is_enough() {
        let text = include_str!("../../../cases/li2016-8hz-b7p5mm.toml");
        let case = Case::parse("case.toml", text).expect("a case");
        let effort = TradeoffEffort {
            study: StudyEffort { starts: 2, discard: Some(100), periods: 50 },
            lengths: vec![50, 100],
            steps: vec![50],
            usual_length: 20,
            longest: 400,
            flights: 5,
        };
        let found = Tradeoff::of(&case.system(), &effort, &mut |_| ()).expect("tried");
        let seconds = vec![0.5; found.trials.len()];
        let timed = TradeoffDocument::new(&case, &found, 0.01, Some(&seconds));
        let terminal = timed.text(&case).expect("a text");
        let document = TradeoffDocument::new(&case, &found, 0.01, None);
        let files = document.files(&case).expect("files");
        let page = String::from_utf8_lossy(&files[std::path::Path::new("tradeoff.md")]);
        let answer =
            "For 1 % in amplitude the exact orbit is enough: symmetric orbit, closed form, ";
        for part in [answer, "The closed form misses by 2.6 %: manifold and fixed points, "] {
            assert!(
                page.contains(part) && terminal.contains(part),
                "{part} in\n{page}\n{terminal}"
            );
        }
        assert!(
            page.contains("| symmetric orbit, closed form | 2.5168 mm | below 1e−12 | 2.0000 |")
        );
    }
}
