//! The section "Which layer answered": question by question, how exact, how that is known, and what it
//! cost.

use serde::Serialize;

use super::numbers::{LengthFormat, percent, significant};
use super::tables::{KeyRow, Table, table};
use super::tradeoff::{asked, error_text, operations};
use crate::case::Case;
use crate::study::fidelity::{Answered, Answers, Fidelity, KnownBy, Question};
use crate::study::tradeoff::ErrorOf;

/// The section.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Layers {
    /// What was decided and why it is enough, a sentence each.
    pub sentences: Vec<String>,
    /// A row for each question.
    pub table: Table,
    /// The numbers behind it.
    pub data: Answers,
}

impl Layers {
    /// Writes the section.
    pub fn new(case: &Case, answers: &Answers) -> Self {
        let rows = answers.answers.iter().map(|answer| row(case, answer)).collect();
        let columns = [
            ("Question", false),
            ("Answer", false),
            ("Layer", false),
            ("Error", true),
            ("Allowed", true),
            ("Known by", false),
            ("Enough", false),
        ];
        Self { sentences: sentences(answers), table: table(columns, rows), data: answers.clone() }
    }

    /// The answer for the first screen.
    pub(super) fn key_row(&self) -> Option<KeyRow> {
        let answer = self.data.answers.first()?;
        let row = self.table.rows.first()?;
        Some(KeyRow {
            quantity: format!("rms displacement, known to {}", row[3]),
            value: row[1].clone(),
            from: answer.layer.words(),
            anchor: "which-layer-answered",
        })
    }

    /// The same for a terminal.
    pub fn text(&self) -> String {
        use std::fmt::Write as _;
        let mut text = String::from("\nWhich layer answered\n");
        for row in &self.table.rows {
            let _ = writeln!(
                text,
                "  {}: {} by {} (error {}, allowed {}, known by {}; enough: {})",
                row[0], row[1], row[2], row[3], row[4], row[5], row[6]
            );
        }
        for sentence in &self.sentences {
            let _ = writeln!(text, "  {sentence}");
        }
        text
    }
}

fn row(case: &Case, answer: &Answered) -> [String; 7] {
    let relative = |error: f64| error_text(ErrorOf { value: error, below: false });
    let (question, value, error) = match answer.question {
        Question::Amplitude => {
            let scales = case.scales();
            let lengths = LengthFormat::of(&scales);
            let text = |rms: f64| lengths.with_digits(scales.length(rms), 4);
            ("amplitude (rms displacement)", answer.value.map(text), answer.error.map(relative))
        }
        Question::ImpactsPerPeriod => (
            "impacts per period",
            answer.value.map(|z| significant(z, 4)),
            answer.error.map(|error| significant(error, 1)),
        ),
        Question::Regime => ("regime", answer.regime.map(|regime| regime.words().to_owned()), None),
        Question::Coexistence => {
            let others = answer.others.map(|others| match others {
                0 => "no other motion found".to_owned(),
                1 => "1 other motion found".to_owned(),
                more => format!("{more} other motions found"),
            });
            ("coexisting motions", others, None)
        }
    };
    let none = || "–".to_owned();
    let allowed = answer.allowed.map(|allowed| match answer.question {
        Question::Amplitude => asked(allowed),
        _ => significant(allowed, 1),
    });
    [
        question.to_owned(),
        value.unwrap_or_else(|| "not looked for".to_owned()),
        answer.layer.words().to_owned(),
        error.unwrap_or_else(none),
        allowed.unwrap_or_else(none),
        known_by(answer.known_by).to_owned(),
        if answer.enough { "yes" } else { "no" }.to_owned(),
    ]
}

fn known_by(known: KnownBy) -> &'static str {
    match known {
        KnownBy::ExactOrbit => "exact orbit",
        KnownBy::Asymptotics => "ε (2 + |σ| + λ), not measured",
        KnownBy::Closure => "closure of the orbit",
        KnownBy::Scatter => "two standard errors",
        KnownBy::Outcome => "starts",
    }
}

fn sentences(answers: &Answers) -> Vec<String> {
    let layer = answers.answers.first().map_or(Fidelity::Simulation, |answer| answer.layer);
    let allowed = asked(answers.demand.amplitude);
    let closed = answers.error_of_closed_form.map(|error| percent(error.abs()));
    let why = match (layer, answers.forced, &closed) {
        (_, Some(forced), _) => {
            format!("The {} answers because it was insisted on.", forced.words())
        }
        (Fidelity::Manifold, None, Some(error)) => format!(
            "The closed form answers: the exact orbit beside it is stable and admissible and shows its error, {error} of the {allowed} allowed."
        ),
        (Fidelity::Orbit, None, Some(error)) => format!(
            "The exact orbit answers: it is stable and admissible, so its error is rounding; the closed form is off by {error}, more than the {allowed} allowed."
        ),
        (Fidelity::Orbit, None, None) => {
            "The exact orbit answers: it is stable and admissible, so its error is rounding; the closed form has no stable fixed point.".into()
        }
        _ => "Simulation answers: no symmetric orbit is stable and admissible here, so neither closed form nor orbit has an amplitude to offer.".into(),
    };
    let mut said = vec![why];
    said.push(cost(answers));
    if answers.coexistence_looked_for {
        said.push(
            "Other motions were looked for from many starts, which only simulation does.".into(),
        );
    } else {
        said.push(
            "Coexistence was not looked for: other motions may exist beside this one, and starts may lead to them; coexistence = true in the case's table [accuracy] looks for them.".into(),
        );
    }
    for doubt in &answers.doubts {
        said.push(format!("The simulation is not to be trusted: {}.", doubt.words()));
    }
    if !answers.enough() {
        said.push("Not everything is known as well as was asked for.".into());
    }
    said
}

fn cost(answers: &Answers) -> String {
    let names = ["closed form", "exact orbit", "simulation"];
    let parts: Vec<String> = names
        .iter()
        .zip(answers.operations)
        .filter_map(|(name, cost)| Some(format!("{name} {}", operations(cost?))))
        .collect();
    let simulated = if answers.operations[2].is_some() { "" } else { "; nothing was simulated" };
    format!("Cost in operations: {}{simulated}.", parts.join(", "))
}

/// What the verdict says where nothing was simulated.
pub(super) fn unlooked() -> String {
    "Nothing was simulated (see Which layer answered): which starts lead to this motion, and whether others, perhaps stronger ones, coexist, is not known. Near its limits hardly any start may lead to it.".into()
}
