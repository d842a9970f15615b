//! The page of `vinesink tradeoff` as data, which is also its JSON document. The sentences are in
//! `templates/`. Seconds belong to one machine and stay out of the page.

use serde_json::{Value, json};

use super::{Best, ImpactSearch, MethodGroup, Tradeoff, TradeoffMethod, Trial};
use crate::case::Case;
use crate::method::Method as KnownBy;
use crate::quantity::{Quantity, catalogue};
use crate::report::render::{Files, RenderError, page_files};
use crate::report::template::{render, worded};

/// Relative error of the amplitude that the page speaks of where the case asks for none.
pub const USUAL: f64 = 0.01;

/// Layers that compete, from the cheapest; the baseline is compared with them.
const COMPETING: [MethodGroup; 5] = [
    MethodGroup::ClosedForm,
    MethodGroup::SlowFlow,
    MethodGroup::AveragedFlow,
    MethodGroup::ExactOrbit,
    MethodGroup::Simulation,
];

/// The page of a case.
#[derive(Debug, Clone, Copy)]
pub struct Page<'a> {
    /// The case.
    pub case: &'a Case,
    /// What was tried.
    pub found: &'a Tradeoff,
    /// Relative error of the amplitude that is asked for.
    pub allowed: f64,
    /// What each trial took, in their order; with it the document is not the same twice.
    pub seconds: Option<&'a [f64]>,
}

impl Page<'_> {
    /// `vinesink/tradeoff@3`. What refers to a method is its place in `methods`.
    pub fn document(&self) -> Value {
        let Self { case, found, allowed, seconds } = *self;
        let units = case.units();
        let enough = winner(found, allowed);
        let answering = found.trials.iter().filter(|trial| trial.answer.rms.is_some());
        let cheapest = enough.map(|k| found.trials[k].operations);
        let cheapest = cheapest.or(answering.map(|trial| trial.operations).min()).unwrap_or(1);
        let method = |(k, trial): (usize, &Trial)| {
            let rms = trial.answer.rms;
            let mut row = json!(trial);
            row["layer"] = json!(trial.method.layer());
            row["rms_displacement"] = json!(rms.map(|rms| units.length(rms)));
            // Operations over those of the cheapest that is enough, or of the cheapest.
            let times = trial.operations as f64 / cheapest.max(1) as f64;
            row["times"] = json!(rms.map(|_| times));
            if let Some(seconds) = seconds {
                row["seconds"] = json!(seconds.get(k));
            }
            row
        };
        let others = COMPETING.into_iter().chain([MethodGroup::FixedStep]);
        let others =
            others.filter(|layer| enough.is_none_or(|k| found.trials[k].method.layer() != *layer));
        let mut document = json!(found);
        document["format"] = json!("vinesink/tradeoff@3");
        document["title"] = json!(case.title);
        document["allowed"] = json!(allowed);
        // Of the best answer: in metres, or in the case's own unit of length.
        document["rms_displacement"] = json!(units.length(found.best.rms));
        document["impacts"] = json!(impacts(&found.best));
        document["methods"] = found.trials.iter().enumerate().map(method).collect();
        // The cheapest that is enough; none where none is.
        document["enough"] = json!(enough);
        document["layers"] = others.map(|of| layer(found, of, allowed)).collect();
        document["longer"] = json!(longer(found, allowed));
        // A baseline whose amplitude is right and whose impacts are not.
        document["wrong_count"] = json!(wrong_count(found));
        document["flights"] = json!(flights(found));
        document["case_sha256"] = json!(case.text_hash);
        document
    }

    /// The files of the page, by their path in the case's folder.
    ///
    /// # Errors
    /// [`RenderError`] if template and page do not fit, or the figure cannot be drawn.
    pub fn files(&self) -> Result<Files, RenderError> {
        let units = self.case.units();
        let figures = worded(vec![super::figure(self)], &units)?;
        let facts = json!({ "page": self.document(), "version": env!("CARGO_PKG_VERSION") });
        page_files("tradeoff", "tradeoff.md", None, &units, facts, &figures)
    }

    /// What the terminal shows: the page's words and every method with the time that it took.
    ///
    /// # Errors
    /// [`RenderError::Template`] if template and page do not fit.
    pub fn text(&self) -> Result<String, RenderError> {
        render("tradeoff.txt", &self.case.units(), &json!({ "page": self.document() }))
    }
}

fn impacts(best: &Best) -> Quantity {
    let method = match best.layer {
        MethodGroup::ExactOrbit => KnownBy::ExactOrbit,
        _ => KnownBy::Simulation,
    };
    let found = Quantity::new(&catalogue::IMPACTS_PER_PERIOD, best.impacts_per_period, method);
    found.with_error(best.impacts_error)
}

/// What a layer has to offer against the cheapest that is enough.
fn layer(found: &Tradeoff, layer: MethodGroup, allowed: f64) -> Value {
    let trials = || found.of_layer(layer);
    let errors = trials().filter_map(|(k, trial)| Some((k, trial.rms_error?.value)));
    let closest = errors.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, _)| k);
    json!({
        "layer": layer,
        // Its cheapest method that is enough.
        "enough": found.cheapest(layer, allowed),
        // Where none is, the method that comes closest.
        "closest": closest,
        // Excitation periods that this left out for a transient that is not over.
        "transient": closest.and_then(|k| found.transient(&found.trials[k])),
        // Why it gives no answer.
        "why_not": trials().find_map(|(_, trial)| trial.answer.why_not),
    })
}

/// The cheapest method of the competing layers that is enough.
fn winner(found: &Tradeoff, allowed: f64) -> Option<usize> {
    let within = COMPETING.iter().filter_map(|layer| found.cheapest(*layer, allowed));
    within.min_by_key(|place| found.trials[*place].operations)
}

/// The length that a simulation of a motion without repetition would take: its scatter falls with
/// the root of the length. Of a transient that is not over no length can be told.
fn longer(found: &Tradeoff, allowed: f64) -> Option<Value> {
    let simulations = found.trials.iter().filter_map(|trial| match trial.method {
        TradeoffMethod::Simulation { periods, search: ImpactSearch::Panels, .. } => {
            Some((periods, trial))
        }
        _ => None,
    });
    let (periods, longest) = simulations
        .filter(|(_, trial)| trial.answer.scatter.is_some_and(f64::is_finite))
        .max_by_key(|(periods, _)| *periods)?;
    let in_transient = found.transient(longest).is_some();
    let factor = longest.answer.scatter? / allowed;
    let told = in_transient || (found.best.layer == MethodGroup::Simulation && factor > 1.0);
    let longer = json!({
        // Whether the longest that was tried is still in its transient: then no length can be told.
        "in_transient": in_transient,
        // Rounded up to whole thousands.
        "periods": (periods as f64 * factor * factor / 1000.0).ceil() as u64 * 1000,
        "operations": (longest.operations as f64 * factor * factor) as u64,
    });
    told.then_some(longer)
}

/// Relative difference of a count of impacts that is worth a sentence.
const WRONG_COUNT: f64 = 0.5;

fn wrong_count(found: &Tradeoff) -> Option<usize> {
    let exact = found.best.impacts_per_period;
    let hand = found.of_layer(MethodGroup::FixedStep);
    let off = hand.filter_map(|(k, trial)| {
        let difference = (trial.answer.impacts_per_period? - exact).abs();
        Some((k, difference / exact.max(f64::MIN_POSITIVE)))
    });
    let (k, off) = off.max_by(|a, b| a.1.total_cmp(&b.1))?;
    (off > WRONG_COUNT).then_some(k)
}

/// The baseline's flights in short: variants, those that miss impacts or invent some, and the worst of them.
fn flights(found: &Tradeoff) -> Option<Value> {
    let flown = || {
        found.trials.iter().enumerate().filter_map(|(k, trial)| {
            let flights = trial.flights?;
            let wrong = flights.missed + flights.invented;
            Some((k, wrong as f64 / flights.compared.max(1) as f64))
        })
    };
    let (worst, _) = flown().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let wrong = flown().filter(|(_, wrong)| *wrong > 0.0).count();
    Some(json!({ "variants": flown().count(), "wrong": wrong, "worst": worst }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::executor::Serial;
    use crate::motions::Effort;
    use crate::tradeoff::TradeoffEffort;

    #[test]
    fn page_and_terminal_say_what_is_enough() {
        let text = include_str!("../../cases/li2016-8hz-b7p5mm.toml");
        let case = Case::parse("case.toml", text).expect("a case");
        let effort = TradeoffEffort {
            search: Effort { starts: 2, discard: Some(100), ..Effort::over(50) },
            lengths: vec![50, 100],
            steps: vec![50],
            usual_length: 20,
            longest: 400,
            flights: 5,
        };
        let found = Tradeoff::of(&case.system(), &effort, &Serial, &mut |_| ()).expect("tried");
        let seconds = vec![0.5; found.trials.len()];
        let page = Page { case: &case, found: &found, allowed: 0.01, seconds: None };
        let timed = Page { seconds: Some(&seconds), ..page };
        let terminal = timed.text().expect("a text");
        let files = page.files().expect("files");
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
