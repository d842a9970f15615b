//! Sentences come from `templates/`: a template gets quantities and enums as data, chooses the words and has
//! the numbers written by the filters below.
//!
//! | filter | of | gives |
//! |---|---|---|
//! | `q` | a quantity | the number with its unit and error; `digits=4`, `decimals=1`, `error=false`, `sign=true`, `reduced=true` (units), `like=other` (the unit of that) change it; `–` for none |
//! | `q(of="clearance")` | a plain number in SI | the same, as a quantity of that kind |
//! | `apart(from=other)` | a quantity | the number with as many digits as tell it from another one |
//! | `label` | a quantity or its id | "clearance b" |
//! | `name`, `symbol` | the same | its parts |
//! | `limit` | a criterion | what it asks, in the unit of what was found |
//! | `num(digits=3)` | a number | significant digits; `–` for none |
//! | `pct` | a number | a share in per cent |
//! | `rest` | a share | what is left beside it in per cent, rounded down |
//! | `asked` | a number | a share as people ask for it: "1 %" |
//! | `relative_error` | a number; `below=true` | a relative error in per cent or powers of ten |
//! | `operations` | a count | two digits, in powers of ten from a thousand on |
//! | `many(one="start", more="starts")` | a count | "1 start", "3 starts" |
//! | `cap` | text | with a capital letter first |
//! | `sha256` | text | its hash as a content security policy writes it |
//!
//! All that a template prints is escaped for its page ([`super::escape`]), but for what the following make of it, and
//! for the program's own text marked as `safe`:
//!
//! | filter | of | gives |
//! |---|---|---|
//! | `code` | text | text in the code marks of Markdown |
//! | `image` | a figure; `folder="a"`, `width=400` | the element that shows it |
//! | `path` | a path | a part of a link |
//! | `property` | text | a property of a message of a GitHub workflow |
//! | `tex` | a number; `digits=4` | the number inside a formula; without digits all that it has |

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::path::Path;
use std::rc::Rc;
use std::sync::LazyLock;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;
use sha2::{Digest as _, Sha256};
use tera::{Context, ErrorKind, Kwargs, Map, State, StringInput, Tera, TeraResult, Value};

use super::error::RenderError;
use super::escape;
use super::figure::Figure;
use crate::quantity::catalogue::{self, Digits, Kind};
use crate::quantity::{Units, numbers};

/// The files of `templates/`, by their path in it without `.tera`, and their texts.
const TEMPLATES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/templates.rs"));
/// Files of components, which every template may use.
const COMPONENTS: [&str; 4] = ["components", "loads", "optimize", "evidence"];
/// How a component begins.
const COMPONENT: &str = "{%- component ";

/// All texts by name: templates, and each component by itself.
static TEXTS: LazyLock<BTreeMap<&str, &str>> = LazyLock::new(|| {
    let (components, templates): (Vec<_>, Vec<_>) =
        TEMPLATES.iter().copied().partition(|(file, _)| COMPONENTS.contains(file));
    let components = components.into_iter().flat_map(|(_, text)| {
        let starts = text.match_indices(COMPONENT).map(|(start, _)| start);
        let starts: Vec<usize> = starts.chain([text.len()]).collect();
        let texts = starts.windows(2).map(|ends| &text[ends[0]..ends[1]]);
        texts.map(|text| (word(&text[COMPONENT.len()..]), text)).collect::<Vec<_>>()
    });
    templates.into_iter().chain(components).collect()
});

/// What a text begins with, up to the end of a name.
fn word(text: &str) -> &str {
    text.split([' ', '(', '"']).next().unwrap_or_default()
}

/// A template filled in; a quantity is written in `units`. Markdown has no repeated blank lines, and the tables
/// of a text are aligned.
///
/// # Errors
/// [`RenderError::Template`] if template and context do not fit.
pub fn render(name: &str, units: &Units, context: &impl Serialize) -> Result<String, RenderError> {
    filled_in(name, units, context).map_err(|error| {
        let reason = match error.kind() {
            ErrorKind::SyntaxError(report) | ErrorKind::RenderingError(report) => {
                report.message().to_owned()
            }
            other => other.to_string(),
        };
        RenderError::Template { name: name.to_owned(), reason }
    })
}

thread_local! {
    /// Templates that were read: to read one takes longer than to fill it in.
    static READ: RefCell<BTreeMap<String, Rc<Tera>>> = const { RefCell::new(BTreeMap::new()) };
    /// Those of the text that is being written.
    static UNITS: Cell<Option<Units>> = const { Cell::new(None) };
}

fn filled_in(name: &str, units: &Units, context: &impl Serialize) -> TeraResult<String> {
    let known = READ.with_borrow(|read| read.get(name).cloned());
    let tera = match known {
        Some(tera) => tera,
        None => {
            let tera = Rc::new(read(name)?);
            READ.with_borrow_mut(|all| all.insert(name.to_owned(), Rc::clone(&tera)));
            tera
        }
    };
    UNITS.set(Some(*units));
    let text = tera.render(name, &Context::from_serialize(context)?)?;
    Ok(match Path::new(name).extension().and_then(OsStr::to_str) {
        Some("md") => without_repeated_blank_lines(&text),
        Some("txt") => aligned(&without_repeated_blank_lines(&text)),
        _ => text,
    })
}

fn read(name: &str) -> TeraResult<Tera> {
    let mut tera = Tera::new();
    register(&mut tera);
    tera.autoescape_on(escape::suffixes());
    if let Some(escape) = escape::of_page(name) {
        tera.set_escape_fn(escape);
    }
    tera.add_raw_templates(needed(name)?)?;
    Ok(tera)
}

fn units() -> TeraResult<Units> {
    UNITS.get().ok_or_else(|| tera::Error::message("no units"))
}

/// A template with what it includes, between quotation marks, and the components that it uses, as in `<name `. To read
/// all of them would take longer than to write a page.
fn needed(name: &str) -> TeraResult<Vec<(&'static str, &'static str)>> {
    let text = |name: &str| TEXTS.get_key_value(name).map(|(name, text)| (*name, *text));
    let mut all =
        vec![text(name).ok_or_else(|| tera::Error::message(format!("no template {name}")))?];
    let mut next = 0;
    while let Some((_, reader)) = all.get(next) {
        for part in reader.split(['<', '"']).filter_map(|part| text(word(part))) {
            if !all.contains(&part) {
                all.push(part);
            }
        }
        next += 1;
    }
    Ok(all)
}

/// The figures with title, caption and alternative text from their templates: the first three lines of one.
///
/// # Errors
/// [`RenderError::Template`] if a template and its figure do not fit.
pub fn worded(mut figures: Vec<Figure>, units: &Units) -> Result<Vec<Figure>, RenderError> {
    for figure in &mut figures {
        let Some(facts) = &figure.facts else { continue };
        let text = render(facts.template, units, &facts.data)?;
        let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
        let mut next = || lines.next().unwrap_or_default().to_owned();
        (figure.title, figure.caption, figure.alt) = (next(), next(), next());
    }
    Ok(figures)
}

fn register(tera: &mut Tera) {
    tera.register_filter("q", |value: &Value, options: Kwargs, _: &State| {
        quantity_text(&units()?, value, &options)
    });
    tera.register_filter("apart", |value: &Value, options: Kwargs, _: &State| {
        let number = |one: &Value| field(one.as_map()?, "value")?.as_f64();
        let other = options.get::<Value>("from")?.as_ref().and_then(number);
        Ok::<_, tera::Error>(match number(value) {
            Some(number) => {
                let kind = kind_of(value)?;
                told_like(units()?, kind, &options)?.apart(kind, number, other.unwrap_or(number))
            }
            None => quantity_text(&units()?, value, &options)?,
        })
    });
    tera.register_filter("limit", |of: &Map, _: Kwargs, _: &State| limit_text(&units()?, of));
    tera.register_filter("label", |value: &Value, _: Kwargs, _: &State| {
        let kind = kind_of(value)?;
        Ok::<_, tera::Error>(match kind.symbol {
            "" => kind.name.to_owned(),
            symbol => format!("{} {symbol}", kind.name),
        })
    });
    tera.register_filter("name", |value: &Value, _: Kwargs, _: &State| {
        kind_of(value).map(|kind| kind.name)
    });
    tera.register_filter("symbol", |value: &Value, _: Kwargs, _: &State| {
        kind_of(value).map(|kind| kind.symbol)
    });
    tera.register_filter("num", |value: &Value, options: Kwargs, _: &State| {
        let digits = options.get::<u8>("digits")?.unwrap_or(3);
        match value.as_f64() {
            Some(number) => Ok(numbers::significant(number, usize::from(digits))),
            // A number that is not finite is none in a document.
            None if value.is_none() => Ok("–".to_owned()),
            None => Err(tera::Error::message(format!("{value} is no number"))),
        }
    });
    tera.register_filter("tex", |value: f64, options: Kwargs, _: &State| {
        let text = numbers::tex(value, options.get::<u8>("digits")?);
        Ok::<_, tera::Error>(Value::safe_string(&text))
    });
    tera.register_filter("asked", |share: f64, _: Kwargs, _: &State| numbers::asked(share));
    tera.register_filter("relative_error", |value: f64, options: Kwargs, _: &State| {
        let below = options.get::<bool>("below")?.unwrap_or(false);
        Ok::<_, tera::Error>(numbers::relative_error(value, below))
    });
    tera.register_filter("operations", |count: u64, _: Kwargs, _: &State| {
        numbers::operations(count)
    });
    tera.register_filter("rest", |value: f64, _: Kwargs, _: &State| numbers::rest(value));
    tera.register_filter("pct", |value: f64, _: Kwargs, _: &State| numbers::percent(value));
    tera.register_filter("many", |count: u64, options: Kwargs, _: &State| {
        let word: &str = options.must_get(if count == 1 { "one" } else { "more" })?;
        Ok::<_, tera::Error>(format!("{count} {word}"))
    });
    tera.register_filter("sha256", |text: &str, _: Kwargs, _: &State| {
        Value::safe_string(&policy_hash(text))
    });
    tera.register_filter("cap", |text: StringInput, _: Kwargs, _: &State| {
        text.inherit_safety(numbers::capitalised(text.as_str()))
    });
    let safe = |text: String| Value::safe_string(&text);
    tera.register_filter("code", move |text: &str, _: Kwargs, _: &State| safe(escape::code(text)));
    tera.register_filter("path", move |text: &str, _: Kwargs, _: &State| {
        safe(escape::url_path(text))
    });
    tera.register_filter("property", move |text: &str, _: Kwargs, _: &State| {
        safe(escape::property(text))
    });
    tera.register_filter("image", move |figure: &Map, options: Kwargs, _: &State| {
        let text = |key| field(figure, key).and_then(Value::as_str).unwrap_or_default();
        let folder = options.get::<&str>("folder")?.map(|folder| format!("{folder}/"));
        let source =
            format!("{}figures/{}.svg", folder.unwrap_or_default(), escape::url_path(text("name")));
        let width = field(figure, "width").and_then(Value::as_u64);
        let width = options.get::<u64>("width")?.or(width).unwrap_or_default();
        let [source, alt] = [&source, text("alt")].map(escape::attribute);
        let image = format!("<img src=\"{source}\" width=\"{width}\" alt=\"{alt}\">");
        Ok::<_, tera::Error>(safe(image))
    });
}

/// The hash by which a content security policy allows a style or a script.
pub(super) fn policy_hash(text: &str) -> String {
    format!("sha256-{}", STANDARD.encode(Sha256::digest(text)))
}

/// The kind of a quantity, or of an id.
fn kind_of(value: &Value) -> TeraResult<&'static Kind> {
    let id = value.as_str().or_else(|| field(value.as_map()?, "id")?.as_str());
    let kind = id.and_then(catalogue::kind);
    kind.ok_or_else(|| tera::Error::message(format!("{value} is not of the catalogue")))
}

fn field<'a>(map: &'a Map, key: &'static str) -> Option<&'a Value> {
    map.get(&tera::value::Key::Str(key))
}

/// A number as its author would write it: 8 Hz, not 8.000 Hz.
fn without_zeros(text: &str) -> String {
    let (number, unit) = text.split_at(text.find(' ').unwrap_or(text.len()));
    match number.contains('.') {
        true => format!("{}{unit}", number.trim_end_matches('0').trim_end_matches('.')),
        false => text.to_owned(),
    }
}

/// Digits of a limit, which may be written in another unit.
const LIMIT_DIGITS: Digits = Digits::Significant(5);

/// What a criterion asks, in the unit of what was found; as it is written where that is not in a unit of several.
fn limit_text(units: &Units, of: &Map) -> TeraResult<String> {
    let text = |key| field(of, key).and_then(Value::as_str).unwrap_or_default();
    let number = |key| field(field(of, key)?.as_map()?, "value")?.as_f64();
    let asked = text("asked").replace(">=", "\u{2265}").replace("<=", "\u{2264}");
    let written = if text("relation") == "equal" { format!("= {asked}") } else { asked };
    let (Some(limit), Some(found), true) = (number("limit"), number("found"), units.physical)
    else {
        return Ok(written);
    };
    let kind = kind_of(field(of, "limit").unwrap_or(&Value::none()))?;
    if kind.dimension.accepted_units().count() == 1 {
        return Ok(written);
    }
    let told = units.told_like(kind.dimension, found).with_digits(kind, limit, LIMIT_DIGITS);
    let sign: String = written.chars().take_while(|c| !c.is_ascii_digit()).collect();
    Ok(format!("{} {}", sign.trim_end(), without_zeros(&told)))
}

/// Units in which numbers of a kind are in that of the option `like`, a quantity or none.
fn told_like(units: Units, kind: &Kind, options: &Kwargs) -> TeraResult<Units> {
    let like = options.get::<Value>("like")?;
    let like = like.as_ref().and_then(|like| field(like.as_map()?, "value")?.as_f64());
    Ok(like.map_or(units, |like| units.told_like(kind.dimension, like)))
}

fn quantity_text(units: &Units, value: &Value, options: &Kwargs) -> TeraResult<String> {
    let of = options.get::<&str>("of")?.and_then(catalogue::kind);
    let plain = of.zip(value.as_f64());
    // What is listed has a value and an error, and no name.
    let (kind, map) = match (plain, value.as_map()) {
        (Some((kind, _)), _) => (kind, None),
        (None, Some(map)) => (of.map_or_else(|| kind_of(value), Ok)?, Some(map)),
        (None, None) => return Ok("\u{2013}".into()),
    };
    let number = |key| field(map?, key).and_then(Value::as_f64);
    let digits = match (options.get::<u8>("digits")?, options.get::<u8>("decimals")?) {
        (Some(digits), _) => Digits::Significant(digits),
        (_, Some(decimals)) => Digits::Decimals(decimals),
        _ => kind.digits,
    };
    let units = match options.get::<bool>("reduced")? {
        Some(true) => &Units::reduced(),
        _ => units,
    };
    let units = &told_like(*units, kind, options)?;
    let value = plain.map(|(_, value)| value).or_else(|| number("value"));
    let Some(value) = value else { return Ok("without limit".into()) };
    let error = match options.get::<bool>("error")? {
        Some(false) => 0.0,
        _ => number("error").unwrap_or(0.0),
    };
    let text = units.with_error(kind, value, error, digits);
    let given = map.and_then(|map| field(map, "method")).and_then(Value::as_str) == Some("given");
    let text = if given { without_zeros(&text) } else { text };
    let sign = options.get::<bool>("sign")? == Some(true) && value > 0.0 && !text.starts_with('+');
    Ok(if sign { format!("+{text}") } else { text })
}

/// Text for a terminal: the tables of its Markdown with their columns aligned.
fn aligned(markdown: &str) -> String {
    let lines: Vec<&str> = markdown.lines().collect();
    let is_row = |line: &&str| line.starts_with('|');
    let blocks = lines.chunk_by(|a, b| is_row(a) == is_row(b));
    let aligned = blocks.map(|block| match is_row(&block[0]) {
        true => table_text(block),
        false => block.iter().map(|line| format!("{line}\n")).collect(),
    });
    aligned.collect()
}

/// Rows of a Markdown table; its second line says which columns are aligned to the right.
fn table_text(lines: &[&str]) -> String {
    let cells = |line: &&str| -> Vec<String> {
        line.trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect()
    };
    let mut rows: Vec<Vec<String>> = lines.iter().map(cells).collect();
    let marks = if rows.len() > 1 { rows.remove(1) } else { Vec::new() };
    let width = |k: usize| rows.iter().filter_map(|row| Some(row.get(k)?.chars().count())).max();
    let text = |row: &Vec<String>| {
        let cells = row.iter().enumerate().map(|(k, cell)| {
            let width = width(k).unwrap_or(0);
            let right = marks.get(k).is_some_and(|mark| mark.ends_with(':'));
            if right { format!("{cell:>width$}") } else { format!("{cell:width$}") }
        });
        format!("{}\n", cells.collect::<Vec<_>>().join("  ").trim_end())
    };
    rows.iter().map(text).collect()
}

fn without_repeated_blank_lines(text: &str) -> String {
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
