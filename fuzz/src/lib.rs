//! What the targets have in common.

use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme};

/// An error as a terminal shows it, which must be possible and short whatever was read.
pub fn told(error: impl Diagnostic) {
    let mut told = String::new();
    let handler = GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor());
    handler.render_report(&mut told, &error).expect("text");
    assert!(told.len() < 500_000, "a message of {} bytes", told.len());
}
