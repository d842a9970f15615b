//! Why a page cannot be made.

use super::figure::FigureError;
use super::mathml::MathError;

/// Why a report cannot be rendered.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// A template does not fit the report.
    #[error(
        "the page {name} cannot be made: {reason}; check the units of the case, and report it if they are right"
    )]
    Template {
        /// The template.
        name: String,
        /// What it lacks, without the text around it, which says nothing to a reader.
        reason: String,
    },
    /// A figure cannot be drawn.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// A formula cannot be shown.
    #[error(transparent)]
    Formula(#[from] MathError),
    /// The numbers cannot be written down.
    #[error("the report cannot be written as JSON: {0}")]
    Json(#[from] serde_json::Error),
}
