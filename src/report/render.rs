//! From a report to the files of its folder. Nothing is decided here.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Serialize;
use tera::{Context, Kwargs, State, Tera, Value};

use super::document::{Document, Tone};
use super::equations::EquationGroup;
use super::extremes::Extremes;
use super::figure::{self, Figure, FigureError};
use super::html;
use super::optimize::OptimizePage;
use super::paper::Paper;
use super::sweep::SweepPage;
use super::template;
use super::tradeoff::TradeoffPage;
use crate::quantity::{Units, catalogue};
use crate::symbolic::MathError;

const PAPER: &str = include_str!("../../templates/paper.md.tera");
const EXTREMES: &str = include_str!("../../templates/extremes.md.tera");
const TRADEOFF: &str = include_str!("../../templates/tradeoff.md.tera");
const OPTIMIZE_MARKDOWN: &str = include_str!("../../templates/optimize.md.tera");
const OPTIMIZE_HTML: &str = include_str!("../../templates/optimize.html.tera");
const SWEEP_MARKDOWN: &str = include_str!("../../templates/sweep.md.tera");
const SWEEP_HTML: &str = include_str!("../../templates/sweep.html.tera");
pub(super) const STYLE: &str = include_str!("../../templates/report.css");

/// The drawings that belong to pages of other commands, in the folder of a report.
const FIGURES_OF_OTHERS: [&str; 3] =
    ["figures/tradeoff.svg", "figures/optimize-landscape.svg", "figures/optimize-chart.svg"];
/// How the names of a sweep's drawings begin, of which there are more or fewer.
const FIGURES_OF_SWEEP: &str = "figures/sweep-";

/// Whether a file of a report's folder, by its path in it, is the report's own: one that an older report
/// has left there is out of date. Pages of other commands, and whatever somebody else has put there, are
/// not.
pub fn is_of_report(file: &Path) -> bool {
    let Some(name) = file.to_str() else { return false };
    if ["report.md", "validation.md", "equations.md", "report.html", "report.json"].contains(&name)
    {
        return true;
    }
    let drawing = name.strip_prefix("figures/").and_then(|name| name.strip_suffix(".svg"));
    let drawing = drawing.is_some_and(|name| !name.contains('/') && !name.starts_with('.'));
    drawing && !FIGURES_OF_OTHERS.contains(&name) && !name.starts_with(FIGURES_OF_SWEEP)
}

/// Why a report cannot be rendered.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// A template does not fit the report.
    #[error("a template cannot be filled in: {0}")]
    Template(#[from] tera::Error),
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

/// What the equations of a case are printed from.
#[derive(Serialize)]
struct EquationsPage<'a> {
    title: &'a str,
    length_unit: &'static str,
    equations: &'a [EquationGroup],
}

/// The files of a report's folder, by their path in it.
///
/// # Errors
/// [`RenderError`] says which part cannot be rendered.
pub fn files(
    document: &Document,
    equations: &[EquationGroup],
    units: &Units,
    figures: &[Figure],
) -> Result<BTreeMap<PathBuf, Vec<u8>>, RenderError> {
    let drawings = drawings(figures)?;
    let page = |name: &str| -> Result<String, RenderError> {
        Ok(without_repeated_blank_lines(&template::render(name, units, document)?))
    };
    let (report, validation) = (page("report.md")?, page("validation.md")?);
    let (title, length_unit) = (document.title.as_str(), units.length_symbol());
    let equations = EquationsPage { title, length_unit, equations };
    let equations =
        without_repeated_blank_lines(&template::render("equations.md", units, &equations)?);
    let whole =
        [report.clone(), appendix("validation", &validation), appendix("equations", &equations)]
            .join("\n");
    let tone = match document.verdict.tone {
        Tone::Good => "good",
        Tone::Mixed => "mixed",
        Tone::Bad => "bad",
    };
    let html = html::page(&html::Page { title, tone, markdown: &whole, drawings: &drawings })?;
    let mut files = figure_files(drawings);
    let pages = [
        ("report.md", report),
        ("validation.md", validation),
        ("equations.md", equations),
        ("report.html", html),
        ("report.json", with_quantities_in_lines(&serde_json::to_string_pretty(document)?)),
    ];
    files.extend(pages.map(|(name, text)| (PathBuf::from(name), text.into_bytes())));
    Ok(files)
}

/// JSON with each quantity on a line of its own: a number that changes is a line that changes.
fn with_quantities_in_lines(json: &str) -> String {
    let mut text = String::with_capacity(json.len());
    let mut lines = json.lines().peekable();
    while let Some(line) = lines.next() {
        text.push_str(line);
        let first = lines.peek().map_or("", |next| next.trim_start());
        let id = first.strip_prefix("\"id\": \"").and_then(|rest| rest.strip_suffix("\","));
        if line.ends_with('{') && id.and_then(catalogue::kind).is_some() {
            for part in lines.by_ref() {
                let part = part.trim_start();
                let end = part.starts_with('}');
                if !end && !text.ends_with('{') {
                    text.push(' ');
                }
                text.push_str(part);
                if end {
                    break;
                }
            }
        }
        text.push('\n');
    }
    text
}

/// A page of its own as a part of another, where links to it lead: its headings one level deeper, without the
/// other's title.
fn appendix(name: &str, page: &str) -> String {
    let line = |line: &str| match line.strip_prefix("# ") {
        Some(title) => {
            let title = title.split(':').next().unwrap_or(title);
            format!("<a id=\"page-{name}\"></a>\n\n## {title}\n")
        }
        None if line.starts_with('#') => format!("#{line}\n"),
        None => format!("{line}\n"),
    };
    page.lines().map(line).collect()
}

/// The page that compares the paper's figures, as Markdown.
///
/// # Errors
/// [`RenderError::Template`] if template and page do not fit.
pub fn paper(page: &Paper) -> Result<String, RenderError> {
    let mut context = Context::new();
    context.insert("paper", page);
    let text = engine("paper.md", PAPER)?.render("paper.md", &context)?;
    Ok(without_repeated_blank_lines(&text))
}

/// The page about the simulation at the ends of its range, as Markdown.
///
/// # Errors
/// [`RenderError::Template`] if template and page do not fit.
pub fn extremes(page: &Extremes) -> Result<String, RenderError> {
    let mut context = Context::new();
    context.insert("page", page);
    let text = engine("extremes.md", EXTREMES)?.render("extremes.md", &context)?;
    Ok(without_repeated_blank_lines(&text))
}

/// The page of accuracy and cost with its figure, by their path in the case's folder.
///
/// # Errors
/// [`RenderError`] if template and page do not fit, or the figure cannot be drawn.
pub fn tradeoff(
    page: &TradeoffPage,
    drawn: &Figure,
) -> Result<BTreeMap<PathBuf, Vec<u8>>, RenderError> {
    let mut context = Context::new();
    context.insert("page", page);
    let text = engine("tradeoff.md", TRADEOFF)?.render("tradeoff.md", &context)?;
    Ok(BTreeMap::from([
        (PathBuf::from("tradeoff.md"), without_repeated_blank_lines(&text).into_bytes()),
        (PathBuf::from(format!("figures/{}.svg", drawn.name)), figure::render(drawn)?.into_bytes()),
    ]))
}

/// The page of an optimisation with its figures, by their path in the case's folder.
///
/// # Errors
/// [`RenderError`] if template and page do not fit, or a figure cannot be drawn.
pub fn optimize(
    page: &OptimizePage,
    drawn: &[Figure],
) -> Result<BTreeMap<PathBuf, Vec<u8>>, RenderError> {
    let drawings = drawings(drawn)?;
    let mut context = Context::new();
    context.insert("page", page);
    context.insert("style", STYLE);
    context.insert("drawings", &drawings);
    let text = engine("optimize.md", OPTIMIZE_MARKDOWN)?.render("optimize.md", &context)?;
    let html = engine("optimize.html", OPTIMIZE_HTML)?.render("optimize.html", &context)?;
    let mut files = figure_files(drawings);
    files.insert("optimize.md".into(), without_repeated_blank_lines(&text).into_bytes());
    files.insert("optimize.html".into(), html.into_bytes());
    Ok(files)
}

/// Every figure as SVG, by its name.
pub(super) fn drawings(figures: &[Figure]) -> Result<BTreeMap<String, String>, RenderError> {
    let each = figures.iter();
    each.map(|figure| Ok((figure.name.clone(), figure::render(figure)?))).collect()
}

/// The same as files of a report's folder.
pub(super) fn figure_files(drawings: BTreeMap<String, String>) -> BTreeMap<PathBuf, Vec<u8>> {
    let each = drawings.into_iter();
    each.map(|(name, drawing)| (format!("figures/{name}.svg").into(), drawing.into_bytes()))
        .collect()
}

/// The page of a sweep as Markdown and HTML, with its numbers and figures, by their path in the sweep's folder.
///
/// # Errors
/// [`RenderError`] if template and page do not fit, or a figure cannot be drawn.
pub fn sweep(
    page: &SweepPage,
    drawn: &[Figure],
) -> Result<BTreeMap<PathBuf, Vec<u8>>, RenderError> {
    let drawings = drawings(drawn)?;
    let mut context = Context::new();
    context.insert("page", page);
    context.insert("style", STYLE);
    context.insert("drawings", &drawings);
    let text = engine("sweep.md", SWEEP_MARKDOWN)?.render("sweep.md", &context)?;
    let html = engine("sweep.html", SWEEP_HTML)?.render("sweep.html", &context)?;
    let json = serde_json::to_string_pretty(&page.document)? + "\n";
    let pages = [
        ("sweep.md", without_repeated_blank_lines(&text)),
        ("sweep.html", html),
        ("sweep.json", json),
    ];
    let mut files = figure_files(drawings);
    files.extend(pages.map(|(name, text)| (PathBuf::from(name), text.into_bytes())));
    Ok(files)
}

/// The formula in a cell that is nothing but one.
fn dollars(cell: &str) -> Option<&str> {
    cell.strip_prefix('$')?.strip_suffix('$')
}

fn engine(name: &str, template: &str) -> Result<Tera, RenderError> {
    let mut tera = Tera::new();
    tera.register_filter("md_text", |text: &str, _: Kwargs, _: &State| markdown_text(text));
    tera.register_filter("md_cell", |text: &str, _: Kwargs, _: &State| {
        if dollars(text).is_some() { text.to_owned() } else { markdown_cell(text) }
    });
    tera.register_filter("md_attribute", |text: &str, _: Kwargs, _: &State| attribute(text));
    tera.register_filter("latex_of", |text: &str, _: Kwargs, _: &State| {
        dollars(text).unwrap_or_default().to_owned()
    });
    tera.register_filter("path", |text: &str, _: Kwargs, _: &State| url_path(text));
    tera.register_filter("lower_first", |text: &str, _: Kwargs, _: &State| lower_first(text));
    tera.register_filter("first_only", |list: Vec<Value>, _: Kwargs, _: &State| {
        list.into_iter().take(1).collect::<Vec<Value>>()
    });
    tera.register_filter("rest_only", |list: Vec<Value>, _: Kwargs, _: &State| {
        list.into_iter().skip(1).collect::<Vec<Value>>()
    });
    tera.add_raw_template(name, template)?;
    Ok(tera)
}

/// Text whose characters mean nothing to Markdown; a line of its own stays one line.
pub(super) fn markdown_text(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '\n' | '\r' => safe.push(' '),
            '\\' | '`' | '*' | '_' | '<' | '>' | '[' | ']' | '#' | '$' => {
                safe.push('\\');
                safe.push(letter);
            }
            _ => safe.push(letter),
        }
    }
    safe
}

/// The same inside a table.
pub fn markdown_cell(text: &str) -> String {
    markdown_text(text).replace('|', "\\|")
}

/// A sentence that goes on after a colon.
fn lower_first(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_lowercase().collect::<String>() + letters.as_str()
    })
}

/// A path as a link writes it: everything that could mean something else is encoded.
pub(super) fn url_path(path: &str) -> String {
    path.bytes().fold(String::with_capacity(path.len()), |mut link, byte| {
        if byte.is_ascii_alphanumeric() || b"-._~/".contains(&byte) {
            link.push(char::from(byte));
        } else {
            link.push_str(&format!("%{byte:02X}"));
        }
        link
    })
}

pub(super) fn attribute(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('"', "&quot;")
        .replace('<', "&lt;")
        .replace(['\n', '\r'], " ")
}

pub(crate) fn without_repeated_blank_lines(text: &str) -> String {
    let mut result = String::with_capacity(text.len());
    let mut blank = true;
    for line in text.lines().map(str::trim_end) {
        if !(blank && line.is_empty()) {
            result.push_str(line);
            result.push('\n');
        }
        blank = line.is_empty();
    }
    while result.ends_with("\n\n") {
        result.pop();
    }
    result
}
