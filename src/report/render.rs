//! From a report to the files of its folder. Nothing is decided here.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::document::figure_row;
pub use super::error::RenderError;
use super::figure::{self, Figure};
use super::html::{self, Drawings};
use super::template;
use crate::executor::{Executor, Serial, map};
use crate::quantity::Units;

/// Files by their path in a folder.
pub type Files = BTreeMap<PathBuf, Vec<u8>>;

/// The drawings that belong to pages of other commands, in the folder of a report.
const FIGURES_OF_OTHERS: [&str; 5] = [
    "figures/tradeoff.svg",
    "figures/optimize-landscape.svg",
    "figures/optimize-chart.svg",
    "figures/optimize-loads.svg",
    "figures/nearer-resonance.svg",
];
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

/// The files of a report's folder, by their path in it; the page by a template, which gets the figures beside its facts. Of a
/// structure for which equations are written out they are pages too.
///
/// # Errors
/// [`RenderError`] says which part cannot be rendered.
pub fn files(
    template: &str,
    document: &Value,
    equations: Option<&[Value]>,
    units: &Units,
    figures: &[Figure],
    on: &dyn Executor,
) -> Result<Files, RenderError> {
    let drawings = drawings(figures, on)?;
    let page = |name: &str| template::render(name, units, document);
    let (report, validation) = (page(template)?, page("validation.md")?);
    // The page has everything; the file beside it, which is under review, what is short.
    let mut whole = report.clone() + "\n" + &appendix("validation", &validation);
    let mut pages = vec![("report.md", report), ("validation.md", validation)];
    if let Some(equations) = equations {
        let facts = json!({
            "title": document["title"], "length_unit": units.length_symbol(), "equations": equations,
        });
        let page = |name: &str| template::render(name, units, &facts);
        whole = whole + "\n" + &appendix("equations", &page("equations-all.md")?);
        pages.push(("equations.md", page("equations.md")?));
    }
    let tone = document["verdict"]["tone"].as_str().unwrap_or_default();
    pages.push(("report.html", html::page(tone, &whole, &drawings)?));
    let mut files = figure_files(drawings);
    files.extend(texts(pages.into_iter().map(|(name, text)| (name.to_owned(), text))));
    Ok(files)
}

/// `report.json` among the files of a report.
pub fn with_document(mut files: Files, document: &Value) -> Files {
    files.extend(texts([("report.json".to_owned(), format!("{}\n", in_lines(document, 0)))]));
    files
}

/// The files of a page in a case's folder: `NAME.md` by a template, which gets the figures beside its facts, their
/// drawings, and where a tone is told `NAME.html`.
///
/// # Errors
/// [`RenderError`] says which part cannot be rendered.
pub fn page_files(
    name: &str,
    template: &str,
    tone: Option<&str>,
    units: &Units,
    mut facts: Value,
    figures: &[Figure],
) -> Result<Files, RenderError> {
    facts["figures"] = figures.iter().map(figure_row).collect();
    let markdown = template::render(template, units, &facts)?;
    let drawings = drawings(figures, &Serial)?;
    // Other pages begin with a table of absorbers, or of points.
    let tiles = name == "report";
    let html = tone.map(|tone| html::page_with(tiles, tone, &markdown, &drawings)).transpose()?;
    let mut files = figure_files(drawings);
    files.extend(texts(html.map(|html| (format!("{name}.html"), html))));
    files.extend(texts([(format!("{name}.md"), markdown)]));
    Ok(files)
}

fn texts(
    of: impl IntoIterator<Item = (String, String)>,
) -> impl Iterator<Item = (PathBuf, Vec<u8>)> {
    of.into_iter().map(|(name, text)| (name.into(), text.into_bytes()))
}

/// Characters of JSON up to which what belongs together stands on a line.
const LINE: usize = 120;

/// JSON with each quantity on a line of its own: a number that changes is a line that changes.
fn in_lines(value: &Value, indent: usize) -> String {
    let line = value.to_string();
    let inner = indent + 2;
    let (parts, [open, close]): (Vec<String>, _) = match value {
        Value::Object(fields) if line.len() > LINE => {
            let field = |(key, value)| format!("{}: {}", json!(key), in_lines(value, inner));
            (fields.iter().map(field).collect(), ["{", "}"])
        }
        Value::Array(items) if line.len() > LINE => {
            (items.iter().map(|item| in_lines(item, inner)).collect(), ["[", "]"])
        }
        _ => return line,
    };
    let before = format!("\n{:inner$}", "");
    format!("{open}{before}{}\n{:indent$}{close}", parts.join(&format!(",{before}")), "")
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

/// Every figure as SVG by its name: as its file has it, and one for a phone, or nothing.
fn drawings(figures: &[Figure], on: &dyn Executor) -> Result<Drawings, RenderError> {
    let both = |figure: &Figure| {
        let narrow = figure.narrow().map(|figure| figure::render(&figure)).transpose()?;
        Ok((figure.name.clone(), (figure::render(figure)?, narrow.unwrap_or_default())))
    };
    map(on, "", figures.len(), |k| both(&figures[k])).into_iter().collect()
}

fn figure_files(drawings: Drawings) -> Files {
    let path = |name: String| format!("figures/{name}.svg");
    texts(drawings.into_iter().map(|(name, (drawing, _))| (path(name), drawing))).collect()
}
