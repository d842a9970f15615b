//! The page of `vinesink tradeoff`: every layer's error and cost on one case, in words, tables and a
//! work-precision diagram. Seconds belong to one machine and stay out of it.

mod figure;
mod words;

use serde::Serialize;

use super::figure::Figure;
use super::numbers::{LengthFormat, fixed, percent, significant, with_minus};
use super::tables::{Table, table};
use crate::case::{Case, Scales};
use crate::study::tradeoff::{Best, ErrorOf, Layer, Method, Tradeoff, Trial};
use crate::system::State;

pub use figure::figure;
pub use words::method as method_words;

/// Relative error of the amplitude that the page speaks of where the case asks for none.
pub const USUAL: f64 = 0.01;

/// The page as data.
#[derive(Debug, Clone, Serialize)]
pub struct TradeoffPage {
    /// The case's title.
    pub title: String,
    /// The answer in a sentence.
    pub headline: String,
    /// What follows from the rest, a sentence each.
    pub sentences: Vec<String>,
    /// What all is compared with.
    pub best: String,
    /// Every method.
    pub methods: Table,
    /// Flights of the baseline; without rows where it made none.
    pub flights: Table,
    /// The diagram's words; the drawing is a file of its own.
    pub figure: super::FigureRow,
    /// Folder name of the case's report.
    pub name: String,
    /// Version of the program.
    pub version: &'static str,
    /// SHA-256 of the case file's text.
    pub case_sha256: String,
}

impl TradeoffPage {
    /// Writes the page of a case, `allowed` being the relative error of the amplitude that it speaks
    /// of.
    pub fn new(
        name: &str,
        case: &Case,
        tradeoff: &Tradeoff,
        allowed: f64,
        figure: &Figure,
    ) -> Self {
        Self {
            title: case.title.clone(),
            headline: words::headline(tradeoff, allowed),
            sentences: words::sentences(tradeoff, allowed),
            best: words::best(case, tradeoff),
            methods: methods(case, tradeoff, allowed),
            flights: flights(tradeoff),
            figure: super::FigureRow::of(figure),
            name: name.to_owned(),
            version: env!("CARGO_PKG_VERSION"),
            case_sha256: case.text_hash.clone(),
        }
    }
}

fn methods(case: &Case, tradeoff: &Tradeoff, allowed: f64) -> Table {
    let scales = case.scales();
    let lengths = LengthFormat::of(&scales);
    let answering = tradeoff.trials.iter().filter(|trial| trial.answer.rms.is_some());
    let enough = words::winner(tradeoff, allowed).map(|trial| trial.operations);
    let over =
        if enough.is_some() { "Over the cheapest that is enough" } else { "Over the cheapest" };
    let cheapest = answering.map(|trial| trial.operations).min();
    let cheapest = enough.or(cheapest).unwrap_or(1).max(1);
    let rows = tradeoff.trials.iter().map(|trial| {
        let answer = &trial.answer;
        let missing = || answer.why_not.unwrap_or("not told").to_owned();
        [
            words::method(trial.method),
            answer.rms.map_or_else(missing, |rms| lengths.with_digits(scales.length(rms), 5)),
            trial.rms_error.map_or_else(dash, error_text),
            answer.impacts_per_period.map_or_else(dash, |z| fixed(z, 4)),
            answer.regime.map_or_else(dash, |regime| regime.short().to_owned()),
            operations(trial.operations),
            answer.rms.map_or_else(dash, |_| times(trial.operations as f64 / cheapest as f64)),
        ]
    });
    table(
        [
            ("Method", false),
            ("rms of x", true),
            ("Error", true),
            ("z", true),
            ("Regime", false),
            ("Operations", true),
            (over, true),
        ],
        rows.collect(),
    )
}

fn flights(tradeoff: &Tradeoff) -> Table {
    let rows = tradeoff.trials.iter().filter_map(|trial| {
        let flights = trial.flights?;
        Some([
            words::method(trial.method),
            flights.compared.to_string(),
            flights.missed.to_string(),
            flights.invented.to_string(),
        ])
    });
    table(
        [
            ("Method", false),
            ("Flights", true),
            ("Impacts missed", true),
            ("Impacts invented", true),
        ],
        rows.collect(),
    )
}

fn dash() -> String {
    "–".to_owned()
}

/// An error in per cent or powers of ten; one that is only bounded says so.
pub(in crate::report) fn error_text(error: ErrorOf) -> String {
    let size = if error.value < FINE { significant(error.value, 1) } else { percent(error.value) };
    if error.below { format!("below {size}") } else { size }
}

/// Relative errors below this are shown as plain numbers: nobody says 1e-7 %.
const FINE: f64 = 1e-4;

/// A count of operations with two digits, in powers of ten from a thousand on.
pub(in crate::report) fn operations(count: u64) -> String {
    let scientific = format!("{:.1e}", count as f64);
    if count < 1000 { count.to_string() } else { with_minus(&scientific) }
}

/// A share as people ask for it: "1 %", not "1.0 %".
pub(in crate::report) fn asked(share: f64) -> String {
    // Below what a percentage says with two decimals.
    if share < 5e-5 {
        return significant(share, 1);
    }
    percent(share).replace(".0 %", " %")
}

/// A ratio with two digits.
pub(super) fn times(ratio: f64) -> String {
    format!("× {}", significant(ratio, 2))
}

/// What the terminal shows: the page's words and every method with the time that it took, seconds,
/// in the order of the trials.
pub fn summary(case: &Case, tradeoff: &Tradeoff, allowed: f64, seconds: &[f64]) -> String {
    use std::fmt::Write as _;
    let mut text = format!("{}\n\n{}\n", case.title, words::headline(tradeoff, allowed));
    for sentence in words::sentences(tradeoff, allowed) {
        let _ = writeln!(text, "{sentence}");
    }
    let _ = writeln!(text, "\n{}\n", words::best(case, tradeoff));
    let widths = (52, 14, 12, 11, 9, 7);
    let _ = writeln!(
        text,
        "{:w0$}{:>w1$}{:>w2$}{:>w3$}{:>w4$}{:>w5$}",
        "method",
        "error",
        "operations",
        "seconds",
        "ns/op.",
        "missed",
        w0 = widths.0,
        w1 = widths.1,
        w2 = widths.2,
        w3 = widths.3,
        w4 = widths.4,
        w5 = widths.5,
    );
    for (trial, seconds) in tradeoff.trials.iter().zip(seconds) {
        let error = trial.rms_error.map_or_else(|| "no answer".to_owned(), error_text);
        let per_operation = 1e9 * seconds / trial.operations.max(1) as f64;
        let missed = trial.flights.map_or_else(String::new, |flights| flights.missed.to_string());
        let _ = writeln!(
            text,
            "{:w0$}{:>w1$}{:>w2$}{:>w3$}{:>w4$}{:>w5$}",
            words::method(trial.method),
            error,
            operations(trial.operations),
            significant(*seconds, 2),
            significant(per_operation, 2),
            missed,
            w0 = widths.0,
            w1 = widths.1,
            w2 = widths.2,
            w3 = widths.3,
            w4 = widths.4,
            w5 = widths.5,
        );
    }
    text
}

/// `vinesink/tradeoff@1`.
#[derive(Debug, Clone, Serialize)]
pub struct TradeoffDocument {
    format: &'static str,
    title: String,
    headline: String,
    /// Relative error of the amplitude that the headline speaks of.
    allowed: f64,
    /// Over the clearance, in fast time.
    start: State,
    start_number: Option<u32>,
    share: f64,
    other_motions: usize,
    sustained_contact: bool,
    best: BestDocument,
    methods: Vec<MethodDocument>,
}

#[derive(Debug, Clone, Serialize)]
struct BestDocument {
    #[serde(flatten)]
    best: Best,
    /// In metres, or in the case's own unit of length.
    rms_displacement: f64,
}

#[derive(Debug, Clone, Serialize)]
struct MethodDocument {
    method: String,
    layer: Layer,
    periods: Option<u64>,
    steps_per_period: Option<u32>,
    operations: u64,
    rms_displacement: Option<f64>,
    rms_error: Option<ErrorOf>,
    /// Two standard errors between blocks, relative; while a transient lasts, it makes most of them.
    rms_scatter: Option<f64>,
    impacts_per_period: Option<f64>,
    impacts_per_period_error: Option<ErrorOf>,
    regime: Option<crate::regimes::Regime>,
    why_not: Option<&'static str>,
    flights: Option<FlightsDocument>,
    #[serde(skip_serializing_if = "Option::is_none")]
    seconds: Option<f64>,
}

#[derive(Debug, Clone, Serialize)]
struct FlightsDocument {
    compared: u64,
    missed: u64,
    invented: u64,
}

impl TradeoffDocument {
    /// The document of a case; with `seconds`, in the order of the trials, it is not the same twice.
    pub fn new(case: &Case, tradeoff: &Tradeoff, allowed: f64, seconds: Option<&[f64]>) -> Self {
        let scales = case.scales();
        let timed = |k: usize| seconds.and_then(|seconds| seconds.get(k).copied());
        Self {
            format: "vinesink/tradeoff@1",
            title: case.title.clone(),
            headline: words::headline(tradeoff, allowed),
            allowed,
            start: tradeoff.start,
            start_number: tradeoff.start_number,
            share: tradeoff.share,
            other_motions: tradeoff.others,
            sustained_contact: tradeoff.rests,
            best: BestDocument {
                rms_displacement: scales.length(tradeoff.best.rms),
                best: tradeoff.best.clone(),
            },
            methods: tradeoff
                .trials
                .iter()
                .enumerate()
                .map(|(k, trial)| MethodDocument::new(trial, &scales, timed(k)))
                .collect(),
        }
    }
}

impl MethodDocument {
    fn new(trial: &Trial, scales: &Scales, seconds: Option<f64>) -> Self {
        let (periods, steps) = match trial.method {
            Method::FixedPoints | Method::SymmetricOrbit => (None, None),
            Method::SlowFlow { periods }
            | Method::OrbitFromSimulation { periods }
            | Method::Simulation { periods, .. } => (Some(periods), None),
            Method::FixedStep { periods, steps, .. } => (Some(periods), Some(steps)),
        };
        let answer = &trial.answer;
        Self {
            method: words::method(trial.method),
            layer: trial.method.layer(),
            periods,
            steps_per_period: steps,
            operations: trial.operations,
            rms_displacement: answer.rms.map(|rms| scales.length(rms)),
            rms_error: trial.rms_error,
            rms_scatter: answer.scatter.filter(|scatter| scatter.is_finite()),
            impacts_per_period: answer.impacts_per_period,
            impacts_per_period_error: trial.impacts_error,
            regime: answer.regime,
            why_not: answer.why_not,
            flights: trial.flights.map(|flights| FlightsDocument {
                compared: flights.compared,
                missed: flights.missed,
                invented: flights.invented,
            }),
            seconds,
        }
    }
}
