//! What is wrong with a case file, said where it is wrong.

use std::fmt;
use std::ops::Range;

use miette::{
    Diagnostic, LabeledSpan, MietteError, MietteSpanContents, NamedSource, Severity, SourceCode,
    SourceSpan, SpanContents,
};

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
            message: cut(message.into()),
            expected: cut(expected.into()),
            help: None,
            severity: Severity::Error,
            line: 1 + before.matches('\n').count(),
            column: 1 + before[line_start..].chars().count(),
            underlined: text[span.clone()].to_owned(),
            span,
        }
    }

    pub(super) fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(cut(help.into())), ..self }
    }

    /// The same as a warning.
    pub(super) fn into_warning(self) -> Self {
        Self { severity: Severity::Warning, ..self }
    }
}

/// Characters of a line that are shown before and behind where something is wrong, and of the text that is underlined.
const SHOWN: usize = 200;
/// Characters of a sentence that is shown whole; those of the program are shorter, with every key named that a table may have.
const WHOLE: usize = 1000;

/// A sentence without the middle of what it quotes, where that is very long.
fn cut(sentence: String) -> String {
    if sentence.chars().nth(WHOLE).is_none() {
        return sentence;
    }
    let begin = sentence.floor_char_boundary(SHOWN);
    let end = sentence.ceil_char_boundary(sentence.len() - SHOWN);
    format!("{} … {}", &sentence[..begin], &sentence[end..])
}

fn within_line(text: &str, span: Range<usize>) -> Range<usize> {
    let start = text.floor_char_boundary(span.start.min(text.len()));
    let end = text
        .ceil_char_boundary(span.end.clamp(start, (start + SHOWN).min(text.len())).min(text.len()));
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
    source: Box<Excerpts>,
    problems: Vec<Problem>,
    /// How many there are besides.
    more: usize,
    /// Whether the text is not shown.
    hidden: bool,
}

impl CaseError {
    pub(super) fn new(name: &str, text: &str, mut problems: Vec<Problem>, more: usize) -> Self {
        if problems.is_empty() {
            problems.push(Problem::new(
                text,
                0..0,
                "the case could not be read",
                "expected a case",
            ));
        }
        problems.sort_by_key(|problem| problem.span.start);
        let source = Box::new(Excerpts(NamedSource::new(name, text.to_owned())));
        Self { source, problems, more, hidden: false }
    }

    /// The same without a word of the text, which may hold what must not be shown: only that it is not `what` it should
    /// be, and in which line that is seen.
    #[must_use]
    pub fn without_text(self, what: &str, help: &str) -> Self {
        let line = self.problems.first().map_or(1, |first| first.line);
        let name = self.name();
        let message = match self.problems.len() + self.more {
            1 => format!("{name} is not {what}: there is an error in line {line}"),
            errors => {
                format!("{name} is not {what}: it has {errors} errors, the first in line {line}")
            }
        };
        let hidden = Problem { line, ..Problem::new("", 0..0, message, "").help(help) };
        let source = Box::new(Excerpts(NamedSource::new(self.name(), String::new())));
        Self { source, problems: vec![hidden], more: 0, hidden: true }
    }

    /// That a file is none that can be read, without a word of it.
    pub(super) fn of_file(name: &str, message: String, help: &str) -> Self {
        let problem = Problem::new("", 0..0, message, "").help(help);
        Self { hidden: true, ..Self::new(name, "", vec![problem], 0) }
    }

    /// The name under which the text was parsed, usually the file's path.
    pub fn name(&self) -> &str {
        self.source.0.name()
    }

    /// The problems, in the order of the file's lines.
    pub fn problems(&self) -> impl Iterator<Item = &Problem> {
        self.problems.iter()
    }

    /// The problem, if it is only one: it is then shown without a line about them all.
    fn only(&self) -> Option<&Problem> {
        if let ([only], 0) = (self.problems.as_slice(), self.more) { Some(only) } else { None }
    }
}

impl std::error::Error for CaseError {}

impl fmt::Display for CaseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.only() {
            Some(only) => only.fmt(f),
            None if self.more == 0 => {
                write!(f, "{} has {} errors", self.name(), self.problems.len())
            }
            None => {
                let shown = self.problems.len();
                write!(
                    f,
                    "{} has {} errors, of which {shown} are shown",
                    self.name(),
                    shown + self.more
                )
            }
        }
    }
}

impl Diagnostic for CaseError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.only()?.help()
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        (!self.hidden).then_some(self.source.as_ref())
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        self.only()?.labels()
    }

    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        let related = self.problems.iter().map(|problem| problem as &dyn Diagnostic);
        self.only().is_none().then_some(Box::new(related))
    }
}

/// A text of which messages show lines; of a very long one what is around the place.
#[derive(Debug)]
struct Excerpts(NamedSource<String>);

impl SourceCode for Excerpts {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let contents = self.0.read_span(span, before, after)?;
        let long = contents.data().split(|byte| *byte == b'\n').any(|line| line.len() > 4 * SHOWN);
        if !long {
            return Ok(contents);
        }
        let text = self.0.inner();
        let line = text[..span.offset()].rfind('\n').map_or(0, |newline| newline + 1);
        let end = span.offset() + span.len();
        let line_end = text[end..].find('\n').map_or(text.len(), |newline| end + newline);
        let start = text.floor_char_boundary(span.offset().saturating_sub(SHOWN)).max(line);
        let end = text.ceil_char_boundary((end + SHOWN).min(text.len())).min(line_end);
        Ok(Box::new(MietteSpanContents::new_named(
            self.0.name().to_owned(),
            &text.as_bytes()[start..end],
            (start..end).into(),
            text[..line].matches('\n').count(),
            text[line..start].chars().count(),
            1,
        )))
    }
}
