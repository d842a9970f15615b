//! What is wrong with a case file, said where it is wrong.

use std::fmt;
use std::ops::Range;

use miette::{Diagnostic, LabeledSpan, NamedSource, Severity, SourceCode};

/// One thing wrong with a case file, or suspicious in it.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct Problem {
    /// What is wrong, as a sentence.
    pub message: String,
    /// What was expected; shown at the underlined text.
    pub expected: String,
    /// What to do about it.
    pub help: Option<String>,
    /// An error, unless the case can be read all the same.
    pub severity: Severity,
    /// The offending bytes of the text.
    pub span: Range<usize>,
    /// Line of the offending text, from 1.
    pub line: usize,
    /// Column of the offending text in characters, from 1.
    pub column: usize,
    /// The offending text.
    pub underlined: String,
}

impl Problem {
    /// A problem with the bytes `span` of `text`, shortened to the first line it touches.
    pub(super) fn new(
        text: &str,
        span: Range<usize>,
        message: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        let span = within_line(text, span);
        let before = &text[..span.start];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        Self {
            message: message.into(),
            expected: expected.into(),
            help: None,
            severity: Severity::Error,
            line: 1 + before.matches('\n').count(),
            column: 1 + before[line_start..].chars().count(),
            underlined: text[span.clone()].to_owned(),
            span,
        }
    }

    pub(super) fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    /// The same as a warning.
    pub(super) fn into_warning(self) -> Self {
        Self { severity: Severity::Warning, ..self }
    }
}

fn within_line(text: &str, span: Range<usize>) -> Range<usize> {
    let start = text.floor_char_boundary(span.start.min(text.len()));
    let end = text.ceil_char_boundary(span.end.clamp(start, text.len()));
    let line_end = text[start..end].find(['\r', '\n']).map_or(end, |at| start + at);
    start..line_end
}

impl Diagnostic for Problem {
    fn severity(&self) -> Option<Severity> {
        Some(self.severity)
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let label = LabeledSpan::new_with_span(Some(self.expected.clone()), self.span.clone());
        Some(Box::new(std::iter::once(label)))
    }
}

/// Everything wrong with a case file, in the order of its lines; never empty.
///
/// As a `miette` diagnostic it shows each place in the file's text.
#[derive(Debug)]
pub struct CaseError {
    source: Box<NamedSource<String>>,
    problems: Vec<Problem>,
}

impl CaseError {
    pub(super) fn new(name: &str, text: &str, mut problems: Vec<Problem>) -> Self {
        if problems.is_empty() {
            problems.push(Problem::new(
                text,
                0..0,
                "the case could not be read",
                "expected a case",
            ));
        }
        problems.sort_by_key(|problem| problem.span.start);
        Self { source: Box::new(NamedSource::new(name, text.to_owned())), problems }
    }

    /// The name under which the text was parsed, usually the file's path.
    pub fn name(&self) -> &str {
        self.source.name()
    }

    /// The problems, in the order of the file's lines.
    pub fn problems(&self) -> impl Iterator<Item = &Problem> {
        self.problems.iter()
    }

    /// The problem, if it is only one: it is then shown without a line about them all.
    fn only(&self) -> Option<&Problem> {
        if let [only] = self.problems.as_slice() { Some(only) } else { None }
    }
}

impl std::error::Error for CaseError {}

impl fmt::Display for CaseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.only() {
            Some(only) => only.fmt(f),
            None => write!(f, "{} has {} errors", self.name(), self.problems.len()),
        }
    }
}

impl Diagnostic for CaseError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.only()?.help()
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(self.source.as_ref())
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        self.only()?.labels()
    }

    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        let related = self.problems.iter().map(|problem| problem as &dyn Diagnostic);
        self.only().is_none().then_some(Box::new(related))
    }
}
