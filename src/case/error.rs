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
    first: Box<Problem>,
    more: Vec<Problem>,
}

impl CaseError {
    pub(super) fn new(name: &str, text: &str, mut problems: Vec<Problem>) -> Self {
        problems.sort_by_key(|problem| problem.span.start);
        let mut problems = problems.into_iter();
        let first = problems.next().unwrap_or_else(|| {
            Problem::new(text, 0..0, "the case could not be read", "expected a case")
        });
        let source = Box::new(NamedSource::new(name, text.to_owned()));
        Self { source, first: Box::new(first), more: problems.collect() }
    }

    /// The name under which the text was parsed, usually the file's path.
    pub fn name(&self) -> &str {
        self.source.name()
    }

    /// The problems, in the order of the file's lines.
    pub fn problems(&self) -> impl Iterator<Item = &Problem> {
        std::iter::once(self.first.as_ref()).chain(&self.more)
    }
}

impl std::error::Error for CaseError {}

impl fmt::Display for CaseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.more.is_empty() {
            return self.first.fmt(f);
        }
        write!(f, "{} has {} errors", self.name(), 1 + self.more.len())
    }
}

impl Diagnostic for CaseError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.more.is_empty().then(|| Diagnostic::help(self.first.as_ref())).flatten()
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(self.source.as_ref())
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        self.more.is_empty().then(|| self.first.labels()).flatten()
    }

    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        if self.more.is_empty() {
            return None;
        }
        Some(Box::new(self.problems().map(|problem| problem as &dyn Diagnostic)))
    }
}
