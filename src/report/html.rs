//! An HTML page from its Markdown: one file that needs nothing from outside, with the drawings inline, formulas
//! as MathML, a table of contents and tables that scroll.
//!
//! For the program itself: this module may change at any time.

use std::collections::{BTreeMap, HashMap};

use pulldown_cmark::{Alignment, CowStr, Event, HeadingLevel, Options, Parser, Tag, TagEnd};
use serde_json::json;

use super::error::RenderError;
use super::escape;
use super::mathml::to_mathml;
use super::template;
use crate::quantity::Units;

/// Drawings as SVG by their names: the usual one, and one for the screen of a phone, which may be empty.
pub type Drawings = BTreeMap<String, (String, String)>;

/// The page as HTML, called by its first heading: of its Markdown, with the files that it links to after it, and of
/// its drawings. `tone` is the class of the first quotation, the verdict: `good`, `mixed`, `bad`,
/// or nothing. The first table is of the numbers that a report begins with, which stand out.
///
/// # Errors
/// [`RenderError::Formula`] if a formula is not understood.
pub fn page(tone: &str, markdown: &str, drawings: &Drawings) -> Result<String, RenderError> {
    page_with(true, tone, markdown, drawings)
}

/// The same of a page whose first table is one like the others, unless it begins with such numbers.
pub(super) fn page_with(
    tiles: bool,
    tone: &str,
    markdown: &str,
    drawings: &Drawings,
) -> Result<String, RenderError> {
    let mut writer = PageWriter { tone, drawings: Some(drawings), ..PageWriter::default() };
    writer.tables = usize::from(!tiles);
    let options = Options::ENABLE_TABLES | Options::ENABLE_MATH;
    let mut events = Vec::new();
    for event in Parser::new_ext(markdown, options) {
        writer.take(event, &mut events)?;
    }
    writer.end_figure(&mut events);
    writer.end_formulas(&mut events);
    let mut body = String::new();
    pulldown_cmark::html::push_html(&mut body, events.into_iter());
    let facts = json!({
        "title": writer.title,
        "contents": writer.contents,
        "body": body,
        "version": env!("CARGO_PKG_VERSION"),
    });
    template::render("page.html", &Units::reduced(), &facts)
}

/// Turns the events of Markdown into those of the page.
#[derive(Default)]
struct PageWriter<'a> {
    tone: &'a str,
    drawings: Option<&'a Drawings>,
    /// The first heading.
    title: Option<String>,
    /// Anchors and headings of the table of contents.
    contents: Vec<[String; 2]>,
    /// Text of the heading that is being read, and its level.
    heading: Option<(HeadingLevel, String)>,
    /// The section's heading: regions for screen readers are named after it.
    section: String,
    /// How often each name of a region was given.
    regions: HashMap<String, u32>,
    figure: Caption,
    /// Whether the first quotation is over, and whether it is being read.
    quoted: bool,
    in_verdict: bool,
    /// How many tables there were; the first, of number 0, stands out.
    tables: usize,
    /// How the columns of the table that is being read are aligned, the name of its cells, and the next one's column.
    alignments: Vec<Alignment>,
    cell: &'static str,
    column: usize,
    in_formulas: bool,
}

/// What follows a drawing is its caption.
#[derive(Default, PartialEq)]
enum Caption {
    #[default]
    None,
    Expected,
    Open,
}

impl<'a> PageWriter<'a> {
    fn take(&mut self, event: Event<'a>, out: &mut Vec<Event<'a>>) -> Result<(), RenderError> {
        match event {
            Event::Start(Tag::Heading { level, .. }) => {
                self.end_figure(out);
                self.end_formulas(out);
                self.heading = Some((level, String::new()));
            }
            Event::End(TagEnd::Heading(_)) => self.end_heading(out),
            Event::Text(ref text) | Event::Code(ref text) if self.heading.is_some() => {
                if let Some((_, heading)) = &mut self.heading {
                    heading.push_str(text);
                }
            }
            Event::InlineMath(latex) => out.push(html(inline_math(&latex)?)),
            Event::DisplayMath(latex) => {
                self.begin_formulas(out);
                out.push(html(format!("<span class=\"formula\">{}</span>", to_mathml(&latex)?)));
            }
            Event::Html(ref text) | Event::InlineHtml(ref text) if text.starts_with("<img ") => {
                self.end_figure(out);
                self.drawing(text, out);
            }
            Event::Start(Tag::Paragraph) if self.figure == Caption::Expected => {
                self.figure = Caption::Open;
                out.push(html("<figcaption>"));
            }
            Event::End(TagEnd::Paragraph) if self.figure == Caption::Open => {
                out.push(html("</figcaption></figure>\n"));
                self.figure = Caption::None;
            }
            Event::Start(Tag::BlockQuote(_)) if !self.quoted => {
                self.in_verdict = true;
                out.push(html(format!("<section class=\"verdict {}\">\n", self.tone)));
            }
            Event::End(TagEnd::BlockQuote(_)) if !self.quoted => {
                (self.quoted, self.in_verdict) = (true, false);
                out.push(html("</section>\n"));
            }
            Event::Start(Tag::Table(alignments)) => {
                let name = self.region();
                // The first numbers of a page stand out.
                let class = if self.tables == 0 { "table tiles" } else { "table" };
                self.tables += 1;
                out.push(html(format!(
                    "<div class=\"{class}\" role=\"region\" aria-label=\"{name}\" tabindex=\"0\">"
                )));
                out.push(Event::Start(Tag::Table(Vec::new())));
                self.alignments = alignments;
            }
            Event::Start(Tag::TableHead) => {
                (self.cell, self.column) = ("th", 0);
                out.push(event);
            }
            Event::Start(Tag::TableRow) => {
                (self.cell, self.column) = ("td", 0);
                out.push(event);
            }
            // The writer of Markdown would align cells by styles of their own, which the page's policy forbids.
            Event::Start(Tag::TableCell) => {
                let class = match self.alignments.get(self.column) {
                    Some(Alignment::Right) => " class=\"right\"",
                    Some(Alignment::Center) => " class=\"center\"",
                    _ => "",
                };
                self.column += 1;
                out.push(html(format!("<{}{class}>", self.cell)));
            }
            Event::End(TagEnd::TableCell) => out.push(html(format!("</{}>", self.cell))),
            Event::End(TagEnd::Table) => out.extend([event, html("</div>\n")]),
            Event::SoftBreak if self.in_verdict => out.push(html("<br>\n")),
            Event::Text(text) => out.push(Event::Text(unbroken(&text).into())),
            Event::Start(Tag::Link { link_type, dest_url, title, id }) => {
                let dest_url = inside(dest_url);
                out.push(Event::Start(Tag::Link { link_type, dest_url, title, id }));
            }
            other => out.push(other),
        }
        Ok(())
    }

    fn end_heading(&mut self, out: &mut Vec<Event<'a>>) {
        let Some((level, text)) = self.heading.take() else { return };
        let (id, name) = (slug(&text), escape::html(&text));
        if level == HeadingLevel::H2 {
            self.contents.push([id.clone(), text.clone()]);
        }
        self.title.get_or_insert_with(|| text.clone());
        self.section = text;
        out.push(html(format!("<{level} id=\"{id}\">{name}</{level}>\n")));
    }

    /// The name of a region, another for each.
    fn region(&mut self) -> String {
        let count = self.regions.entry(self.section.clone()).or_default();
        *count += 1;
        match *count {
            1 => escape::html(&self.section),
            more => format!("{} ({more})", escape::html(&self.section)),
        }
    }

    /// A drawing inline instead of a link to its file.
    fn drawing(&mut self, image: &str, out: &mut Vec<Event<'a>>) {
        let part = |key: &str| {
            let rest = image.split_once(&format!("{key}=\""))?.1;
            Some(rest.split_once('"')?.0)
        };
        let file = part("src").unwrap_or_default();
        let name = file.rsplit('/').next().unwrap_or_default().trim_end_matches(".svg");
        let Some((usual, narrow)) = self.drawings.and_then(|all| all.get(name)) else {
            return out.push(html(image.to_owned()));
        };
        out.push(html(format!(
            "<figure><div class=\"drawing\" tabindex=\"0\">{usual}{narrow}</div>"
        )));
        self.figure = Caption::Expected;
    }

    /// The formulas of a section scroll together: one region that the keyboard reaches.
    fn begin_formulas(&mut self, out: &mut Vec<Event<'a>>) {
        if !self.in_formulas {
            self.in_formulas = true;
            let name = self.region();
            let region = format!(
                "<div class=\"formulas\" role=\"region\" aria-label=\"{name}\" tabindex=\"0\">\n"
            );
            // Before the paragraph that the formula stands in.
            out.insert(out.len().saturating_sub(1), html(region));
        }
    }

    fn end_formulas(&mut self, out: &mut Vec<Event<'a>>) {
        if std::mem::take(&mut self.in_formulas) {
            out.push(html("</div>\n"));
        }
    }

    /// Ends a figure without caption.
    fn end_figure(&mut self, out: &mut Vec<Event<'a>>) {
        if self.figure == Caption::Expected {
            out.push(html("</figure>\n"));
            self.figure = Caption::None;
        }
    }
}

fn html<'a>(text: impl Into<CowStr<'a>>) -> Event<'a> {
    Event::InlineHtml(text.into())
}

fn inline_math(latex: &str) -> Result<String, RenderError> {
    Ok(to_mathml(latex)?.replacen("display=\"block\"", "display=\"inline\"", 1))
}

/// A link to a file that is part of the page.
fn inside(link: CowStr<'_>) -> CowStr<'_> {
    match link.split_once(".md") {
        Some((file, "")) if !file.contains('/') => format!("#page-{file}").into(),
        Some((file, anchor)) if !file.contains('/') && anchor.starts_with('#') => {
            anchor.to_owned().into()
        }
        _ => link,
    }
}

/// The anchor of a heading, as GitHub makes it.
fn slug(heading: &str) -> String {
    let kept = heading.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
    kept.flat_map(char::to_lowercase).map(|c| if c == ' ' { '-' } else { c }).collect()
}

/// Text in which a number stays on the line of its unit and of its relation.
pub fn unbroken(text: &str) -> String {
    let mut before = ' ';
    let mut letters = text.chars().peekable();
    let mut result = String::with_capacity(text.len());
    while let Some(letter) = letters.next() {
        let unit = letters.peek().is_some_and(|next| next.is_alphabetic() || *next == '%');
        // Nor does a limit leave its relation.
        let asked = "≤≥".contains(before);
        let space = letter == ' ' && (before.is_ascii_digit() && unit || asked);
        result.push(if space { '\u{a0}' } else { letter });
        before = letter;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_has_its_drawings_formulas_and_contents() {
        let drawings =
            BTreeMap::from([("map".to_owned(), ("<svg></svg>".to_owned(), String::new()))]);
        let markdown = "# Case & co\n\n> **Works.** Yes.\n\n<img src=\"figures/map.svg\" width=\"720\" alt=\"A map\">\n\nWhat to see.\n\n## Theory, (18)\n\n| a | b |\n| --- | ---: |\n| $x^2$ | [c](validation.md#claims) |\n";
        let text = page("good", markdown, &drawings).expect("a page");
        for part in [
            "<title>Case &amp; co</title>",
            "<h1 id=\"case--co\">Case &amp; co</h1>",
            "<section class=\"verdict good\">",
            "<svg></svg></div><figcaption>What to see.</figcaption></figure>",
            "<li><a href=\"#theory-18\">Theory, (18)</a></li>",
            "aria-label=\"Theory, (18)\"",
            "<math display=\"inline\"",
            "<a href=\"#claims\">c</a>",
        ] {
            assert!(text.contains(part), "{part} in {text}");
        }
    }
}
