//! A difference as Markdown for a comment on GitHub, from `templates/diff.md.tera` and, for each report,
//! `templates/diff_report.md.tera`. What moved within its error never appears.

use serde::Serialize;
use serde_json::{Value, json};

use super::{Change, Difference, ReportDifference};
use crate::quantity::Units;
use crate::report::render::RenderError;
use crate::report::template::render;

/// GitHub refuses comments of more than 65,536 characters; a script may add some of its own.
pub const LIMIT: usize = 60_000;
/// Where the figures of the old and the new side can be looked at, such as an address of the forge: the folder of
/// the reports. Without one they are named and not shown.
pub type Addresses<'a> = [Option<&'a str>; 2];

/// The whole difference, of at most [`LIMIT`] characters: folded tables go first, then whole reports from the end, which are
/// the least important, then words of the head. Every verdict that flips is in the head.
///
/// # Errors
/// [`RenderError::Template`] if a template does not fit.
pub fn markdown(difference: &Difference, addresses: Addresses) -> Result<String, RenderError> {
    let whole = sections(difference, addresses, true)?.concat();
    if whole.chars().count() <= LIMIT {
        return Ok(whole);
    }
    let mut sections = sections(difference, addresses, false)?;
    for brief in [Brief::Words, Brief::Names] {
        if sections[0].chars().count() > MOST_OF_HEAD {
            sections[0] = head(difference, brief)?;
        }
    }
    Ok(cut(&sections))
}

/// Characters of a head that leave room for a notice.
const MOST_OF_HEAD: usize = LIMIT - 1000;

/// The same of the names in it: an escape may be longer than its character.
const MOST_OF_NAMES: usize = LIMIT / 2;

/// How much a head says of each report.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
enum Brief {
    /// Words, criteria and causes.
    Whole,
    /// The words of both sides; of other lists the first few.
    Words,
    /// Names alone.
    Names,
}

const NO_TABLES: &str = "\n_The folded tables are left out: with them this would be longer than a comment may be. `vinesink diff --format json` has them._\n";

/// As many sections as fit, and a notice of what is missing.
fn cut(sections: &[String]) -> String {
    let notice = |left: usize| {
        let sections = if left == 1 { "section is" } else { "sections are" };
        format!(
            "\n_Cut here: {left} {sections} left out, because a comment may have 65,536 characters. `vinesink diff --format json` has everything._\n"
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

/// The head, then every report that changed, then those of which only figures did.
fn sections(
    difference: &Difference,
    addresses: Addresses,
    tables: bool,
) -> Result<Vec<String>, RenderError> {
    let (changed, rest): (Vec<_>, Vec<_>) =
        difference.reports.iter().partition(|report| report.is_significant());
    let drawn: Vec<_> = rest.into_iter().filter(|report| !report.figures.is_empty()).collect();
    let figures: usize = drawn.iter().map(|report| report.figures.len()).sum();
    // Before the first of those of which nothing but figures changed.
    let heading = json!({"reports": drawn.len(), "figures": figures});
    let mut sections = vec![head(difference, Brief::Whole)?];
    for report in changed {
        sections.push(section(report, addresses, tables, &Value::Null)?);
    }
    for (index, report) in drawn.into_iter().enumerate() {
        let heading = if index == 0 { &heading } else { &Value::Null };
        sections.push(section(report, addresses, tables, heading)?);
    }
    Ok(sections)
}

/// The answer in a line, and what has nothing to be compared with.
fn head(difference: &Difference, brief: Brief) -> Result<String, RenderError> {
    let reports = &difference.reports;
    let changed = reports.iter().filter(|one| one.is_significant()).count();
    let flips = reports.iter().filter(|one| one.flips());
    // A length is told in the unit of its own report.
    let flips = flips.map(|report| match brief {
        Brief::Names => Ok(report.new["name"].clone()),
        _ => {
            let facts = json!({ "report": report, "lead": lead(report), "brief": brief });
            let line = render("diff_flip.md", &units(report), &facts)?;
            Ok(json!(line.trim_end()))
        }
    });
    let mut flips = flips.collect::<Result<Vec<_>, RenderError>>()?;
    let flipped_reports = flips.len();
    if brief == Brief::Names {
        let mut room = MOST_OF_NAMES;
        flips.retain(|name| {
            room = room.saturating_sub(2 + name.as_str().map_or(0, |name| name.chars().count()));
            room > 0
        });
    }
    let sum = |count: &dyn Fn(&ReportDifference) -> usize| reports.iter().map(count).sum::<usize>();
    let flipped =
        |one: &ReportDifference| one.criteria.iter().filter(|one| one["flipped"] == true).count();
    let facts = json!({
        "old": difference.old,
        "new": difference.new,
        "significant": difference.is_significant(),
        "changed": changed,
        "compared": difference.compared,
        "brief": brief,
        "flipping": flipped_reports,
        "flips": flips,
        "failing": difference.failing,
        "stale": difference.stale,
        "checked": difference.checked,
        "diverged": difference.diverged,
        "unreported": difference.unreported,
        "added": difference.added,
        "removed": difference.removed,
        "counts": {
            "stale": difference.stale.len(),
            "inputs": sum(&|one| one.inputs.len()),
            "flipped": sum(&flipped),
            "criteria": sum(&|one| one.criteria.len() - flipped(one)),
            "verdicts": sum(&|one| one.claims.len() + usize::from(one.verdict)),
            "states": sum(&|one| one.states.len()),
            "numbers": sum(&|one| one.numbers.len()),
            "figures": sum(&|one| one.figures.len()),
            "added": difference.added.len(),
            "removed": difference.removed.len(),
        },
    });
    render("diff.md", &Units::reduced(), &facts)
}

fn section(
    report: &ReportDifference,
    addresses: Addresses,
    tables: bool,
    heading: &Value,
) -> Result<String, RenderError> {
    let facts = json!({
        "report": report,
        "lead": lead(report),
        "significant": report.is_significant(),
        "key_states": report.states.iter().filter(|one| one.is_key_state()).count(),
        "headlines": report.numbers.iter().filter(|one| one.is_headline()).count(),
        "same": report.folded.same + report.folded.within,
        "old_url": url(addresses[0]),
        "new_url": url(addresses[1]),
        "tables": tables,
        "heading": heading,
    });
    Ok(format!("\n{}", render("diff_report.md", &units(report), &facts)?))
}

fn units(report: &ReportDifference) -> Units {
    report.clearance_m.map_or(Units::reduced(), Units::physical)
}

/// Inputs that are named in the first lines.
const NAMED: usize = 3;

/// What the first lines say: criteria that failed before too, and as the cause the first inputs but title and source, and how
/// many more there are.
fn lead(report: &ReportDifference) -> Value {
    let says = |one: &&Change| !["title", "source"].contains(&one.what.as_str());
    let inputs: Vec<&Change> = report.inputs.iter().filter(says).collect();
    let fails = |one: &&Value| {
        one["flipped"] == false && one["old"].is_object() && one["new"]["holds"] == false
    };
    let moved = report.criteria.iter().filter(fails).map(|one| &one["new"]);
    json!({
        "inputs": inputs[..inputs.len().min(NAMED)],
        "more": inputs.len().saturating_sub(NAMED),
        "failing": moved.chain(&report.failing).collect::<Vec<_>>(),
    })
}

fn url(address: Option<&str>) -> Option<&str> {
    address.map(|url| url.trim_end_matches('/'))
}
