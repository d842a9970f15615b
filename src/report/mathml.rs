//! LaTeX to MathML, for documents that must show formulas without any script.
//!
//! For the program itself: this module may change at any time.

use pulldown_latex::config::{DisplayMode, RenderConfig};
use pulldown_latex::{Event, Parser, ParserError, Storage, push_mathml};

/// A formula that cannot be converted.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the formula `{latex}` cannot be converted to MathML: {reason}")]
pub struct MathError {
    /// The formula.
    pub latex: String,
    /// What the converter says.
    pub reason: String,
}

/// Converts a formula to a `<math display="block">` element. The same text gives the same element.
///
/// # Errors
/// If the formula is not valid LaTeX of the subset that the converter knows.
pub fn to_mathml(latex: &str) -> Result<String, MathError> {
    let error = |reason: String| MathError { latex: latex.to_owned(), reason };
    let storage = Storage::new();
    let events: Result<Vec<Event<'_>>, ParserError> = Parser::new(latex, &storage).collect();
    let events = events.map_err(|reason| error(reason.to_string()))?;
    let config = RenderConfig { display_mode: DisplayMode::Block, ..RenderConfig::default() };
    let mut mathml = String::new();
    let events = events.into_iter().map(Ok::<_, ParserError>);
    push_mathml(&mut mathml, events, config).map_err(|reason| error(reason.to_string()))?;
    Ok(mathml)
}
