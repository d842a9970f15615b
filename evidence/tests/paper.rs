//! The page that goes through the paper's figures, as it is committed, and what it needs.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use assert_cmd::Command;
use regex::Regex;
use tempfile::TempDir;
use vinesink::case::{Case, ExtraFigure};
use vinesink_evidence::paper::{CASES, SETS, TRANSFER};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn page() -> String {
    fs::read_to_string(root().join("reports/paper.md")).expect("is committed")
}

fn found<'a>(pattern: &str, text: &'a str) -> Vec<&'a str> {
    let pattern = Regex::new(pattern).expect("a pattern");
    pattern.captures_iter(text).map(|at| at.get(1).expect("a group").as_str()).collect()
}

/// The section of one figure.
fn section<'a>(page: &'a str, number: &str) -> &'a str {
    let start = page.find(&format!("\n## Fig. {number}\n")).expect("a section");
    let rest = &page[start + 1..];
    rest[3..].find("\n## ").map_or(rest, |end| &rest[..end + 3])
}

#[test]
fn every_figure_of_the_paper_is_there_in_order() {
    let page = page();
    let sections = found(r"(?m)^## Fig\. (\d+)$", &page);
    assert_eq!(sections, ["3", "4", "5", "6", "7", "8", "9", "11", "12"]);
    let summary = page.split("\n## ").next().expect("a summary first");
    let rows = found(r"(?m)^\| \[?(\d+)", summary);
    assert_eq!(rows, ["1", "2", "3", "4", "5", "6", "7", "8", "9", "10", "11", "12"]);
    for number in sections {
        let section = section(&page, number);
        assert!(section.contains("<img src="), "Fig. {number} has no image");
        assert!(section.contains("\nNot given in the paper: "), "Fig. {number}");
        assert!(section.contains("holds"), "Fig. {number} has nothing checked");
    }
    for wrong in ["NaN", "infinite", "undefined", "{{"] {
        assert!(!page.contains(wrong), "{wrong}");
    }
}

#[test]
fn every_link_leads_somewhere() {
    let page = page();
    let reports = root().join("reports");
    let images = found("src=\"([^\"]+)\"", &page);
    assert!(images.len() >= 25, "{} images", images.len());
    let links = found(r"\]\(([^)#]+)\)", &page);
    assert!(links.len() >= images.len(), "{} links", links.len());
    for link in images.iter().chain(&links) {
        assert!(reports.join(link).is_file(), "{link} is linked and missing");
    }
    for anchor in found(r"\]\(#([^)]+)\)", &page) {
        let heading = |line: &&str| line.starts_with("## ");
        let slug = |line: &str| line[3..].to_lowercase().replace('.', "").replace(' ', "-");
        let mut slugs = page.lines().filter(heading).map(slug);
        assert!(slugs.any(|slug| slug == anchor), "#{anchor} leads nowhere");
    }
    let alts = found("alt=\"([^\"]*)\"", &page);
    assert!(alts.len() == images.len() && alts.iter().all(|alt| alt.len() > 60));
}

/// The sentences that explain what differs are written for exactly these statements.
#[test]
fn what_does_not_hold_is_what_the_text_explains() {
    let page = page();
    let failing = |number: &str| -> Vec<String> {
        let lines = section(&page, number).lines();
        let lines = lines.filter_map(|line| line.strip_prefix("- **does not hold**: "));
        lines.map(|line| line.chars().take(24).collect()).collect()
    };
    for number in ["3", "4", "5", "7", "8"] {
        assert_eq!(failing(number), [""; 0], "Fig. {number}");
        assert!(section(&page, number).contains(": reproduced.**"), "Fig. {number}");
    }
    assert_eq!(failing("6"), ["The vibration is smalles"]);
    assert_eq!(failing("9"), ["As far as 1:1 resonance ", "One amplitude puts $r = "]);
    assert_eq!(failing("11"), ["(e) strongly modulated r", "(a) The impacts at b = 0"]);
    // Whether a chaotic motion has stretch (d) within 400 periods is chance; the text must know.
    let stretch_found = section(&page, "12").contains("Stretch (d) was found");
    let stretch = ["The paper's case, 8 Hz a", "(d) It grows although th"];
    assert_eq!(failing("12"), stretch[..if stretch_found { 1 } else { 2 }]);
    for number in ["6", "9", "11", "12"] {
        let section = section(&page, number);
        assert!(section.contains(": reproduced with a difference.**"), "Fig. {number}");
    }
    assert!(section(&page, "11").contains("Another $F$ does not mend that"));
}

/// Sets of parameters that give every regime of the experiment; what else is claimed of them is no more than what
/// `tests/physics/nearer_resonance.rs` finds.
#[test]
fn the_sets_hold_where_table_1_does_not() {
    let page = page();
    let start = page.find("\n## Figs. 11 and 12 nearer resonance\n").expect("a section");
    let section = &page[start..start + page[start..].find("\n## Limits").expect("the next one")];
    let rows = |begin: &str| section.lines().find(|line| line.starts_with(begin)).expect("a row");
    let difference = "reproduced with a difference";
    assert_eq!(
        rows("| Fig. 11 |"),
        format!("| Fig. 11 | {difference} | {difference} | reproduced |")
    );
    // Bold cells are those of Table 1 at 11.5 mm and at 15 mm.
    let cells = section.lines().filter(|line| line.contains(" of 32) |"));
    let bold: Vec<&str> = cells.filter(|line| line.contains("**")).collect();
    assert_eq!(bold.len(), 2, "{bold:?}");
    for (row, clearance) in bold.iter().zip(["| 11.5 mm |", "| 15.0 mm |"]) {
        assert!(row.starts_with(clearance) && row.matches("(0 of 32)").count() == 1, "{row}");
        assert_eq!(row.matches("(32 of 32)").count(), 2, "{row}");
    }
    for known in [
        "With Table 1's natural frequency no $F$ does.",
        "| below 2.875 | above 1.304 |",
        "| Table 1 | 4.69 mm | 16.3 mm | 19.2 mm | 3.469 | 1.180 |",
        "does not hold** with Table 1, **does not hold** with set A, holds with set B.",
        "holds with Table 1, **does not hold** with set A, holds with set B.",
    ] {
        assert!(section.contains(known), "{known}");
    }
    assert_eq!(section.matches("everywhere within both bounds").count(), 2);
}

/// Check values of an independent program: P1, and the boundaries at both frequencies.
#[test]
fn the_page_states_the_known_numbers() {
    let page = page();
    for (number, known) in [
        ("3", "$B/b = 1.681$"),
        ("5", "Hopf, 26.5 mm"),
        ("5", "vanish (34.9 mm)"),
        ("5", "vanish (16.3 mm)"),
        ("6", "8.3036 Hz, $\\sigma = -0.7096$, $\\gamma = 1.119$"),
    ] {
        assert!(section(&page, number).contains(known), "Fig. {number} lacks {known}");
    }
    assert!(page.contains("3.56 mm instead of 3.01 mm"), "8 Hz");
}

#[test]
fn every_further_figure_is_in_a_shipped_report() {
    let mut shown = BTreeSet::new();
    for name in CASES.into_iter().chain([TRANSFER]).chain(SETS) {
        let path = root().join(format!("cases/{name}.toml"));
        let text = fs::read_to_string(&path).expect("is shipped");
        let case = Case::parse(name, &text).expect("is valid");
        for figure in &case.report.figures {
            let drawing = root().join(format!("reports/{name}/figures/{}.svg", figure.name()));
            assert!(drawing.is_file(), "{} is asked for and missing", drawing.display());
            shown.insert(figure.name());
        }
    }
    assert_eq!(shown, ExtraFigure::ALL.map(ExtraFigure::name).into());
}

#[test]
fn a_missing_case_or_figure_is_named() {
    let folder = TempDir::new().expect("a folder");
    let mut command = Command::cargo_bin("vinesink-evidence").expect("built");
    let output =
        command.arg("paper").arg("--cases").arg(folder.path()).arg("--out").arg(folder.path());
    let output = output.assert().code(2).get_output().clone();
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(message.contains("li2016-8p5hz-fig4a.toml"), "{message}");
    assert!(!folder.path().join("paper.md").exists());

    for name in CASES.into_iter().chain([TRANSFER]).chain(SETS) {
        let text = fs::read_to_string(root().join(format!("cases/{name}.toml"))).expect("shipped");
        // Few starts: what is asked is which figures there are.
        let text = text.split("\n[report]").next().expect("a design").to_owned()
            + "\n[simulation]\nstarts = 1\nperiods = 100\n";
        fs::write(folder.path().join(format!("{name}.toml")), text).expect("writable");
    }
    let mut command = Command::cargo_bin("vinesink-evidence").expect("built");
    let output =
        command.arg("paper").arg("--cases").arg(folder.path()).arg("--out").arg(folder.path());
    let output = output.assert().code(2).get_output().clone();
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(message.contains("has no figure") && message.contains("[report]"), "{message}");
}
