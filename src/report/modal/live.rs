//! What the live page says of a structure of several modes.

use serde_json::{Value, json};

use super::{Beside, document, figure, units};
use crate::case::ModalCase;
use crate::modal::ModalAnswer;
use crate::report::document::Content;
use crate::report::error::RenderError;
use crate::report::figure::Figure;
use crate::report::template::{render, worded};

/// What is known at one frequency of one load: a sentence, and its motions as a table, in Markdown; and the verdict's tone.
///
/// # Errors
/// [`RenderError`] if the template does not fit.
pub fn at_frequency(case: &ModalCase, answer: &ModalAnswer) -> Result<Value, RenderError> {
    let facts = document("live", case, answer, &Beside::default(), Content::Simulation);
    let markdown = render("loads-live.md", &units(case), &facts)?;
    Ok(json!({ "markdown": markdown, "tone": facts["verdict"]["tone"] }))
}

/// The largest displacement over the frequency of its loads, with absorbers and without.
///
/// # Errors
/// [`RenderError`] if a template does not fit.
pub fn over_frequency(case: &ModalCase, answer: &ModalAnswer) -> Result<Vec<Figure>, RenderError> {
    let facts = document("live", case, answer, &Beside::default(), Content::Report);
    worded(figure::loads(case, answer, &Beside::default(), &facts), &units(case))
}
