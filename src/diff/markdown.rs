//! A difference as Markdown for a comment on GitHub: what matters first, the rest folded.

use super::shown::{self, Shown};
use super::{
    CriterionChange, Difference, FigureChange, Folded, Found, NumberChange, ReportDifference,
    Summary, WordChange,
};
use crate::report::criteria::{subject, verdict};
use crate::report::render::markdown_cell as cell;

/// GitHub refuses comments of more than 65,536 characters; a script may add some of its own.
pub const LIMIT: usize = 60_000;
/// Rows of a table before the rest is folded: what a reviewer reads in two minutes.
const ROWS: usize = 12;
/// Rows of a folded table.
const FOLDED_ROWS: usize = 40;
/// Width of a figure of two side by side, in pixels.
const WIDTH: u32 = 400;

/// Where the figures can be looked at, such as an address of the forge: the folder of the reports of
/// either side. Without one they are named and not shown.
#[derive(Debug, Clone, Default)]
pub struct Addresses {
    /// Of the old side.
    pub old: Option<String>,
    /// Of the new side.
    pub new: Option<String>,
}

/// How much is written down.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd)]
enum Detail {
    Verdicts,
    NoTables,
    All,
}

/// The whole difference, of at most [`LIMIT`] characters: details go first, then whole reports from
/// the end. One line where there is nothing to look at.
pub fn markdown(difference: &Difference, addresses: &Addresses) -> String {
    if !difference.is_visible() {
        return equal(difference);
    }
    for detail in [Detail::All, Detail::NoTables] {
        let text = sections(difference, addresses, detail).concat();
        let left_out = if detail == Detail::All { "" } else { NO_TABLES };
        if text.chars().count() + left_out.chars().count() <= LIMIT {
            return text + left_out;
        }
    }
    cut(&sections(difference, addresses, Detail::Verdicts))
}

const NO_TABLES: &str = "\n_The folded tables are left out: with them this would be longer than a comment may be. `vinesink diff --format json` has them._\n";

/// As many sections as fit, and a notice of what is missing.
fn cut(sections: &[String]) -> String {
    let notice = |left: usize| {
        format!(
            "\n_Cut here: {} left out, because a comment may have 65,536 characters. `vinesink diff --format json` has everything._\n",
            counted(left, "section is", "sections are")
        )
    };
    let room = LIMIT - notice(sections.len()).chars().count();
    let mut text = String::new();
    let mut length = 0;
    for (index, section) in sections.iter().enumerate() {
        length += section.chars().count();
        if length > room {
            return text + &notice(sections.len() - index);
        }
        text += section;
    }
    text + NO_TABLES
}

fn equal(difference: &Difference) -> String {
    let folded = difference.reports.iter().map(|report| &report.folded);
    let folded: Vec<_> = folded.collect();
    let sum = |count: &dyn Fn(&Folded) -> usize| folded.iter().map(|folded| count(folded)).sum();
    let counts = moved([
        sum(&|folded| folded.within.len()),
        sum(&|folded| folded.wording.len()),
        sum(&|folded| folded.unjudged),
        sum(&|folded| folded.unknown),
    ]);
    let reports = counted(difference.compared, "report is", "reports are");
    if counts.is_empty() {
        return format!("No change: {reports} the same.\n");
    }
    format!("No change: {reports} equal within tolerance (not the same: {}).\n", counts.join(", "))
}

/// What moved and means nothing, in words: numbers within their errors, texts, values without an
/// error, values that only one version of the program writes.
fn moved([within, wording, unjudged, unknown]: [usize; 4]) -> Vec<String> {
    let counts = [
        (within, "number within its error", "numbers within their errors"),
        (wording, "text", "texts"),
        (unjudged, "value by chance", "values by chance"),
        (unknown, "value that only one version writes", "values that only one version writes"),
    ];
    let some = counts.into_iter().filter(|(count, ..)| *count > 0);
    some.map(|(count, one, many)| counted(count, one, many)).collect()
}

fn sections(difference: &Difference, addresses: &Addresses, detail: Detail) -> Vec<String> {
    let mut sections = vec![head(difference)];
    for (title, reports) in [("added", &difference.added), ("removed", &difference.removed)] {
        if !reports.is_empty() {
            sections.push(summaries(title, reports));
        }
    }
    let (changed, rest): (Vec<_>, Vec<_>) =
        difference.reports.iter().partition(|report| report.is_significant());
    for report in changed {
        sections.push(section(report, addresses, detail));
    }
    let drawn: Vec<_> = rest.iter().filter(|report| !report.figures.is_empty()).collect();
    if !drawn.is_empty() {
        let number = drawn.iter().map(|report| report.figures.len()).sum();
        let count = counted(number, "figure", "figures");
        let reports = counted(drawn.len(), "report", "reports");
        let mut text = format!("\n### {count} in {reports} without any other change\n");
        for report in drawn {
            text += &figures(report, addresses, detail);
        }
        sections.push(text);
    }
    sections
}

/// The answer in a line, and what has nothing to be looked at.
fn head(difference: &Difference) -> String {
    let reports = &difference.reports;
    let significant = reports.iter().filter(|report| report.is_significant()).count();
    let sum = |count: &dyn Fn(&ReportDifference) -> usize| reports.iter().map(count).sum::<usize>();
    let flipped = |report: &ReportDifference| {
        report.criteria.iter().filter(|criterion| criterion.is_flipped()).count()
    };
    let parts = [
        (sum(&|report| report.verdicts.len()), "verdict", "verdicts"),
        (sum(&flipped), "flipped criterion", "flipped criteria"),
        (
            sum(&|report| report.criteria.len() - flipped(report)),
            "other criterion",
            "other criteria",
        ),
        (sum(&|report| report.states.len()), "state", "states"),
        (sum(&|report| report.inputs.len()), "input", "inputs"),
        (
            sum(&|report| report.numbers.len()),
            "number beyond its tolerance",
            "numbers beyond their tolerance",
        ),
        (sum(&|report| report.figures.len()), "figure", "figures"),
        (difference.added.len(), "report added", "reports added"),
        (difference.removed.len(), "report removed", "reports removed"),
    ];
    let parts = parts.into_iter().filter(|(count, ..)| *count > 0);
    let parts: Vec<String> = parts.map(|(count, one, many)| counted(count, one, many)).collect();
    let equal = difference.compared - significant;
    let equal = match equal {
        0 => String::new(),
        count => {
            format!("{} equal within tolerance.\n", counted(count, "report is", "reports are"))
        }
    };
    format!(
        "## {} of {} changed\n\n{}.\n{equal}Old: `{}`, new: `{}`.\n",
        significant,
        counted(difference.compared, "report", "reports"),
        parts.join(", "),
        difference.old,
        difference.new,
    )
}

fn summaries(title: &str, reports: &[Summary]) -> String {
    let mut text = format!("\n### Reports {title}\n\n");
    for report in reports {
        text += &format!("- **{}**: {}\n", cell(&report.name), cell(&report.headline));
    }
    text
}

fn section(report: &ReportDifference, addresses: &Addresses, detail: Detail) -> String {
    let (name, title, headline) = (cell(&report.name), cell(&report.title), cell(&report.headline));
    let mut text = format!("\n### {name}\n\n{title}\n\n> {headline}\n");
    text += &words("Verdicts", "Verdict on", &report.verdicts);
    text += &criteria(&report.criteria);
    text += &words("Inputs", "Input", &report.inputs);
    let (first, rest) = report.states.split_at(report.states.len().min(ROWS));
    text += &words("States", "State", first);
    if !rest.is_empty() {
        let table = if detail == Detail::All { word_table("State", rest) } else { String::new() };
        text += &fold(&counted(rest.len(), "further state", "further states"), &table);
    }
    let (first, rest) = report.numbers.split_at(report.numbers.len().min(ROWS));
    if !first.is_empty() {
        text += &format!("\n**Numbers beyond their tolerance**\n\n{}", numbers(first));
    }
    if !rest.is_empty() {
        let count = counted(rest.len(), "further number", "further numbers");
        text += &fold(&format!("{count} beyond tolerance"), &folded_numbers(rest, detail));
    }
    text += &figures(report, addresses, detail);
    text + &folded(report, detail)
}

fn words(title: &str, column: &str, changes: &[WordChange]) -> String {
    if changes.is_empty() {
        return String::new();
    }
    format!("\n**{title}**\n\n{}", word_table(column, changes))
}

fn word_table(column: &str, changes: &[WordChange]) -> String {
    let mut text = format!("| {column} | Old | New |\n| --- | --- | --- |\n");
    let word = |word: &Option<String>| word.as_deref().map_or("–".to_owned(), cell);
    for WordChange { what, old, new } in changes {
        text += &format!("| {} | {} | {} |\n", cell(what), word(old), word(new));
    }
    text
}

fn criteria(changes: &[CriterionChange]) -> String {
    if changes.is_empty() {
        return String::new();
    }
    let mut text =
        "\n**Criteria**\n\n| Criterion | Asked | Old | New | |\n| --- | --- | --- | --- | --- |\n"
            .to_owned();
    for change in changes {
        let asked = |found: &Option<Found>| Some(asked(&found.as_ref()?.asked));
        let asked = match (asked(&change.old), asked(&change.new)) {
            (Some(old), Some(new)) if old != new => format!("{old}, now {new}"),
            (old, new) => new.or(old).unwrap_or_default(),
        };
        let told = if change.is_flipped() { "**flipped**" } else { "" };
        let values = shown::found(change);
        let side = |found: &Option<Found>, value: &Option<String>| {
            found.as_ref().map_or("–".to_owned(), |found| finding(found, value.as_deref()))
        };
        text += &format!(
            "| {} | {} | {} | {} | {told} |\n",
            cell(subject(&change.name)),
            cell(&asked),
            cell(&side(&change.old, &values[0])),
            cell(&side(&change.new, &values[1])),
        );
    }
    text
}

/// A relation as it is printed, not as it is typed.
fn asked(as_written: &str) -> String {
    as_written.replace(">=", "≥").replace("<=", "≤")
}

fn finding(found: &Found, value: Option<&str>) -> String {
    let value = value.map(|value| format!(" ({value})"));
    format!("{}{}", verdict(found.holds, found.near_limit), value.unwrap_or_default())
}

fn numbers(changes: &[NumberChange]) -> String {
    let mut text =
        "| Number | Old | New | Change | Allowed | Known to |\n| --- | ---: | ---: | ---: | ---: | --- |\n"
            .to_owned();
    for change in changes {
        let shown = Shown::of(change);
        text += &format!(
            "| {} | {} | {} | {} | {} | {} |\n",
            cell(&change.what),
            shown.old,
            shown.new,
            shown.change,
            shown.allowed,
            change.basis.words(),
        );
    }
    text
}

fn folded_numbers(changes: &[NumberChange], detail: Detail) -> String {
    if detail < Detail::All {
        return String::new();
    }
    let (first, rest) = changes.split_at(changes.len().min(FOLDED_ROWS));
    let more =
        if rest.is_empty() { String::new() } else { format!("\n… and {} more.\n", rest.len()) };
    numbers(first) + &more
}

fn figures(report: &ReportDifference, addresses: &Addresses, detail: Detail) -> String {
    if report.figures.is_empty() {
        return String::new();
    }
    let names: Vec<String> =
        report.figures.iter().map(|figure| format!("<code>{}</code>", figure.name)).collect();
    let count = counted(names.len(), "figure", "figures");
    let summary = format!("{}: {count} changed: {}", report.name, names.join(", "));
    let known = addresses.old.is_some() || addresses.new.is_some();
    if !known || detail == Detail::Verdicts {
        return format!("\n{summary}\n");
    }
    let mut table = "| Old | New |\n| --- | --- |\n".to_owned();
    for figure in &report.figures {
        let side = |address: &Option<String>, there| image(report, figure, address, there);
        let (old, new) = (side(&addresses.old, figure.in_old), side(&addresses.new, figure.in_new));
        table += &format!("| {old} | {new} |\n");
    }
    fold(&summary, &table)
}

fn image(
    report: &ReportDifference,
    figure: &FigureChange,
    address: &Option<String>,
    there: bool,
) -> String {
    let FigureChange { name, title, .. } = figure;
    match address {
        _ if !there => "–".to_owned(),
        None => format!("`{name}`"),
        Some(address) => {
            let address = address.trim_end_matches('/');
            let folder = if report.folder.is_empty() {
                String::new()
            } else {
                format!("/{}", report.folder)
            };
            let alt = cell(title).replace('"', "&quot;");
            format!(
                "<img src=\"{address}{folder}/figures/{name}.svg\" width=\"{WIDTH}\" alt=\"{alt}\">"
            )
        }
    }
}

/// What means nothing, counted; the numbers that moved within their errors as a table.
fn folded(report: &ReportDifference, detail: Detail) -> String {
    let folded = &report.folded;
    let counts = [folded.within.len(), folded.wording.len(), folded.unjudged, folded.unknown];
    let mut parts = moved(counts);
    parts.push(counted(folded.same, "value the same", "values the same"));
    let mut inside = String::new();
    if detail == Detail::All {
        if !folded.within.is_empty() {
            inside += &folded_numbers(&folded.within, detail);
        }
        if !folded.wording.is_empty() {
            inside += &format!("\n{}", word_table("Text", &folded.wording));
        }
    }
    fold(&format!("Everything else: {}", parts.join(", ")), &inside)
}

/// Folded text; where nothing is inside, its head alone.
fn fold(summary: &str, inside: &str) -> String {
    if inside.is_empty() {
        return format!("\n{summary}.\n");
    }
    format!("\n<details>\n<summary>{summary}</summary>\n\n{inside}\n</details>\n")
}

fn counted(count: usize, one: &str, many: &str) -> String {
    if count == 1 { format!("1 {one}") } else { format!("{count} {many}") }
}
