//! A difference as Markdown for a comment on GitHub: what is out of date, then for each report inputs,
//! criteria and key numbers; the rest is folded and counted. What moved within its error never appears.

use super::compare::VERDICT;
use super::shown::{self, Shown};
use super::stale::{Reason, StaleReport};
use super::{CriterionChange, Difference, Found, ReportDifference, Summary, WordChange};
use crate::report::criteria_rows::{subject, verdict};
use crate::report::numbers::with_minus;
use crate::report::render::markdown_cell as cell;

/// GitHub refuses comments of more than 65,536 characters; a script may add some of its own.
pub const LIMIT: usize = 60_000;
/// Rows of key numbers before the fold, and how many of them may be words.
const KEY_ROWS: usize = 8;
/// See [`KEY_ROWS`].
const KEY_WORDS: usize = 4;
/// Inputs before the fold.
const INPUTS: usize = 12;
/// Rows of a folded table.
const FOLDED_ROWS: usize = 40;
/// Reports of one kind that are named as out of date.
const NAMED: usize = 5;
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

/// The whole difference, of at most [`LIMIT`] characters: folded tables go first, then whole reports from
/// the end. One line where there is nothing to look at.
pub fn markdown(difference: &Difference, addresses: &Addresses) -> String {
    let drawn = difference.reports.iter().any(|report| !report.figures.is_empty());
    if !difference.is_significant() && !drawn {
        let reports = counted(difference.compared, "report is", "reports are");
        return format!("No change: {reports} the same within their errors.\n");
    }
    let whole = sections(difference, addresses, true).concat();
    if whole.chars().count() <= LIMIT {
        whole
    } else {
        cut(&sections(difference, addresses, false))
    }
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

fn sections(difference: &Difference, addresses: &Addresses, tables: bool) -> Vec<String> {
    let mut sections = vec![head(difference), stale(&difference.stale)];
    for (title, reports) in [("added", &difference.added), ("removed", &difference.removed)] {
        sections.push(summaries(title, reports));
    }
    let (changed, rest): (Vec<_>, Vec<_>) =
        difference.reports.iter().partition(|report| report.is_significant());
    sections.extend(changed.iter().map(|report| section(report, addresses, tables)));
    let drawn: Vec<_> = rest.iter().filter(|report| !report.figures.is_empty()).collect();
    if !drawn.is_empty() {
        let number = drawn.iter().map(|report| report.figures.len()).sum();
        let count = counted(number, "figure", "figures");
        let reports = counted(drawn.len(), "report", "reports");
        let figures = drawn.iter().map(|report| figures(report, addresses, tables));
        let figures: String = figures.collect();
        sections.push(format!("\n### {count} in {reports} without any other change\n{figures}"));
    }
    sections.retain(|section| !section.is_empty());
    sections
}

/// The answer in a line, and what has nothing to be looked at.
fn head(difference: &Difference) -> String {
    let reports = &difference.reports;
    let significant = reports.iter().filter(|report| report.is_significant()).count();
    let sum = |count: &dyn Fn(&ReportDifference) -> usize| reports.iter().map(count).sum::<usize>();
    let flipped =
        |report: &ReportDifference| report.criteria.iter().filter(|one| one.is_flipped()).count();
    let parts = counts(&[
        (difference.stale.len(), "report out of date", "reports out of date"),
        (sum(&|report| report.inputs.len()), "input", "inputs"),
        (sum(&flipped), "flipped criterion", "flipped criteria"),
        (sum(&|one| one.criteria.len() - flipped(one)), "other criterion", "other criteria"),
        (sum(&|report| report.verdicts.len()), "verdict", "verdicts"),
        (sum(&|report| report.states.len()), "state", "states"),
        (sum(&|report| report.numbers.len()), "number", "numbers"),
        (sum(&|report| report.figures.len()), "figure", "figures"),
        (difference.added.len(), "report added", "reports added"),
        (difference.removed.len(), "report removed", "reports removed"),
    ]);
    let equal = match difference.compared - significant {
        0 => String::new(),
        equal => format!("{} the same. ", counted(equal, "report is", "reports are")),
    };
    let title = match significant {
        0 => parts,
        _ => {
            let reports = counted(difference.compared, "report", "reports");
            format!("{significant} of {reports} changed\n\n{parts}.")
        }
    };
    let Difference { old, new, .. } = difference;
    let end = if significant == 0 { "\n\n" } else { " " };
    format!("## {title}{end}{equal}Old: `{old}`, new: `{new}`.\n")
}

/// Reports that are out of date: which, what differs, what to do. Those of one version are one line.
fn stale(reports: &[StaleReport]) -> String {
    if reports.is_empty() {
        return String::new();
    }
    let mut lines: Vec<String> = Vec::new();
    let (of_text, of_version): (Vec<_>, Vec<_>) =
        reports.iter().partition(|stale| matches!(stale.reason, Reason::CaseText { .. }));
    for stale in of_text.iter().take(NAMED) {
        if let Reason::CaseText { case, reported, current } = &stale.reason {
            lines.push(format!(
                "`{}` was made from another text of `{case}` (SHA-256 {}…, the file has {}…): {}.",
                stale.file,
                start(reported),
                start(current),
                remedy(stale)
            ));
        }
    }
    if let Some(more) = of_text.len().checked_sub(NAMED).filter(|more| *more > 0) {
        lines.push(format!(
            "{} made from another text of the case.",
            counted(more, "more report was", "more reports were")
        ));
    }
    let mut groups: Vec<Vec<&StaleReport>> = Vec::new();
    for stale in of_version {
        let same = |one: &StaleReport| one.side == stale.side && one.reason == stale.reason;
        match groups.iter_mut().find(|group| same(group[0])) {
            Some(group) => group.push(stale),
            None => groups.push(vec![stale]),
        }
    }
    for group in groups {
        let Reason::ProgramVersion { reported, current } = &group[0].reason else { continue };
        let others = match group.len() - 1 {
            0 => String::new(),
            others => {
                format!(" and {} of the {} side", counted(others, "other", "others"), group[0].side)
            }
        };
        let more = if others.is_empty() { "" } else { ", and the same for the others" };
        lines.push(format!(
            "`{}`{others}: written by version {reported}, this is {current}: {}{more}.",
            group[0].file,
            remedy(group[0])
        ));
    }
    let lines: String = lines.into_iter().map(|line| format!("- {line}\n")).collect();
    format!("\n**Out of date**\n\n{lines}")
}

fn remedy(stale: &StaleReport) -> String {
    let revision = stale.revision.as_ref();
    let checkout = revision.map(|revision| format!(" in a checkout of `{revision}`"));
    format!("run `{}`{}", stale.command, checkout.unwrap_or_default())
}

/// The first digits of a hash, enough to tell two apart.
fn start(hash: &str) -> String {
    hash.chars().take(8).collect()
}

fn summaries(title: &str, reports: &[Summary]) -> String {
    if reports.is_empty() {
        return String::new();
    }
    let line =
        |report: &Summary| format!("- **{}**: {}\n", cell(&report.name), cell(&report.headline));
    let lines: String = reports.iter().map(line).collect();
    format!("\n### Reports {title}\n\n{lines}")
}

fn section(report: &ReportDifference, addresses: &Addresses, tables: bool) -> String {
    let (name, title, headline) = (cell(&report.name), cell(&report.title), cell(&report.headline));
    let (own, claims): (Vec<_>, Vec<_>) =
        report.verdicts.iter().cloned().partition(|change| change.what == VERDICT);
    let before = own.iter().filter_map(|change| change.old.as_deref());
    let before: String = before.map(|before| format!(">\n> Before: {}\n", cell(before))).collect();
    let key_words = claims.len() + report.states.iter().filter(|one| is_key(one)).count();
    let words = [claims, report.states.clone()].concat();
    let (inputs, more_inputs) = report.inputs.split_at(report.inputs.len().min(INPUTS));
    let (first, words) = words.split_at(key_words.min(KEY_WORDS));
    let (numbers, more) = report.numbers.split_at(report.numbers.len().min(KEY_ROWS - first.len()));
    let first = first.iter().map(|one| word_row(one) + " |");
    let rows = first.chain(numbers.iter().map(|one| Shown::of(one).row()));
    let text = format!("\n### {name}: {title}\n\n> {headline}\n{before}")
        + &table("Input", &WORDS, inputs.iter().map(word_row).collect())
        + &criteria(&report.criteria)
        + &table("Key number", &NUMBERS, rows.collect())
        + &figures(report, addresses, tables);
    let folded = &report.folded;
    let summary = counts(&[
        (more_inputs.len(), "input", "inputs"),
        (words.len(), "state", "states"),
        (more.len(), "further number", "further numbers"),
        (folded.unjudged, "value that chance moves", "values that chance moves"),
        (folded.unknown, "value of one version only", "values of one version only"),
        (folded.same + folded.within.len(), "value the same", "values the same"),
    ]);
    let inside = [
        table("Input", &WORDS, more_inputs.iter().map(word_row).collect()),
        table("State", &WORDS, limited(words, word_row)),
        table("Number", &NUMBERS, limited(more, |one| Shown::of(one).row())),
    ];
    text + &fold(&format!("Everything else: {summary}"), &inside.concat(), tables)
}

/// Whether a state is one of the first that a reviewer asks for.
fn is_key(state: &WordChange) -> bool {
    ["main motion", "area", "strip", "note"].contains(&state.what.as_str())
}

/// The first rows of a folded table.
fn limited<T>(changes: &[T], row: impl Fn(&T) -> String) -> Vec<String> {
    let mut rows: Vec<String> = changes.iter().take(FOLDED_ROWS).map(row).collect();
    if let Some(more) = changes.len().checked_sub(FOLDED_ROWS).filter(|more| *more > 0) {
        rows.push(format!("| … and {more} more | | |"));
    }
    rows
}

/// A table of what changed, with these columns after the first; nothing where nothing did.
fn table(what: &str, columns: &[&str], rows: Vec<String>) -> String {
    if rows.is_empty() {
        return String::new();
    }
    let line = |cells: &[&str]| cells.iter().map(|cell| format!(" {cell} |")).collect::<String>();
    let rule = vec![if columns == NUMBERS { "---:" } else { "---" }; columns.len()];
    let head = format!("\n| {what} |{}\n| --- |{}\n", line(columns), line(&rule));
    rows.into_iter().fold(head, |text, row| text + &row + "\n")
}

const WORDS: [&str; 2] = ["Old", "New"];
const NUMBERS: [&str; 3] = ["Old", "New", "Change"];

fn word_row(change: &WordChange) -> String {
    let word = |word: &Option<String>| word.as_deref().map_or("–".to_owned(), cell);
    format!("| {} | {} | {} |", cell(&change.what), word(&change.old), word(&change.new))
}

fn criteria(changes: &[CriterionChange]) -> String {
    let row = |change: &CriterionChange| {
        let asked = |found: &Option<Found>| Some(asked(&found.as_ref()?.asked));
        let asked = match (asked(&change.old), asked(&change.new)) {
            (Some(old), Some(new)) if old != new => format!("{old}, now {new}"),
            (old, new) => new.or(old).unwrap_or_default(),
        };
        let what = format!("{} {asked}", subject(&change.name));
        let values = shown::found(change);
        let side = |found: &Option<Found>, value: &Option<String>| {
            let value = value.as_ref().map(|value| format!(" ({value})")).unwrap_or_default();
            let found = found.as_ref()?;
            Some(format!("{}{value}", verdict(found.holds, found.near_limit)))
        };
        let [old, new] = [side(&change.old, &values[0]), side(&change.new, &values[1])]
            .map(|side| side.map_or("–".into(), |side| cell(&side)));
        let flipped = if change.is_flipped() { "**flipped** " } else { "" };
        format!("| {} | {old} | {new} | {flipped}|", cell(&what))
    };
    table("Criterion", &["Old", "New", ""], changes.iter().map(row).collect())
}

/// A relation as it is printed, not as it is typed.
fn asked(as_written: &str) -> String {
    with_minus(&as_written.replace(">=", "≥").replace("<=", "≤"))
}

fn figures(report: &ReportDifference, addresses: &Addresses, tables: bool) -> String {
    if report.figures.is_empty() {
        return String::new();
    }
    let names = report.figures.iter().map(|figure| format!("<code>{}</code>", figure.name));
    let names: Vec<String> = names.collect();
    let count = counted(names.len(), "figure", "figures");
    let summary = format!("{}: {count} changed: {}", report.name, names.join(", "));
    let known = addresses.old.is_some() || addresses.new.is_some();
    let folder =
        if report.folder.is_empty() { String::new() } else { format!("/{}", report.folder) };
    let mut images = "\n| Old | New |\n| --- | --- |\n".to_owned();
    for figure in &report.figures {
        let image = |address: &Option<String>, there: bool| match address {
            _ if !there => "–".to_owned(),
            None => format!("`{}`", figure.name),
            Some(address) => format!(
                "<img src=\"{}{folder}/figures/{}.svg\" width=\"{WIDTH}\" alt=\"{}\">",
                address.trim_end_matches('/'),
                figure.name,
                cell(&figure.title).replace('"', "&quot;")
            ),
        };
        let (old, new) =
            (image(&addresses.old, figure.in_old), image(&addresses.new, figure.in_new));
        images += &format!("| {old} | {new} |\n");
    }
    fold(&summary, if known { &images } else { "" }, tables)
}

/// Folded text; where nothing is inside, its head alone.
fn fold(summary: &str, inside: &str, tables: bool) -> String {
    if inside.is_empty() || !tables {
        return format!("\n{summary}.\n");
    }
    format!("\n<details>\n<summary>{summary}</summary>\n{inside}\n</details>\n")
}

fn counts(parts: &[(usize, &str, &str)]) -> String {
    let some = parts.iter().filter(|(count, ..)| *count > 0);
    some.map(|(count, one, many)| counted(*count, one, many)).collect::<Vec<_>>().join(", ")
}

fn counted(count: usize, one: &str, many: &str) -> String {
    if count == 1 { format!("1 {one}") } else { format!("{count} {many}") }
}
