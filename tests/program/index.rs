//! `vinesink index`: what it writes, what it leaves alone, and what it refuses.

use std::fs;
use std::path::{Path, PathBuf};

use assert_cmd::Command;
use serde_json::{Value, json};
use tempfile::TempDir;

fn vinesink(arguments: &[&str]) -> (i32, String, String) {
    let mut command = Command::cargo_bin("vinesink").expect("built");
    let output = command.args(arguments).output().expect("runs");
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).expect("UTF-8");
    // Line breaks are undone, so that a sentence can be looked for.
    let message = text(&output.stderr);
    let words = message.split(['\n', '│', ' ']).filter(|word| !word.is_empty());
    let message = words.collect::<Vec<_>>().join(" ");
    (output.status.code().expect("an end"), text(&output.stdout), message)
}

fn index(folder: &Path) -> (i32, String, String) {
    vinesink(&["index", folder.to_str().expect("UTF-8")])
}

fn shipped() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("reports")
}

/// A folder with the `report.json` of some shipped cases, under other names.
fn folder(members: &[(&str, &str)]) -> TempDir {
    let folder = TempDir::new().expect("a folder");
    for (case, name) in members {
        fs::create_dir(folder.path().join(name)).expect("writable");
        let from = shipped().join(case).join("report.json");
        fs::copy(from, folder.path().join(name).join("report.json")).expect("copied");
    }
    folder
}

fn edit(folder: &TempDir, name: &str, change: impl FnOnce(&mut Value)) {
    let path = folder.path().join(name).join("report.json");
    let mut report = serde_json::from_str(&read(folder, &format!("{name}/report.json")));
    change(report.as_mut().expect("JSON"));
    fs::write(path, report.expect("JSON").to_string()).expect("writable");
}

fn read(folder: &TempDir, name: &str) -> String {
    fs::read_to_string(folder.path().join(name)).expect("readable")
}

#[test]
fn every_case_is_listed_with_its_verdict_and_numbers() {
    let folder = folder(&[("li2016-8p5hz-fig4c", "b"), ("li2016-8hz-b15mm", "a")]);
    edit(&folder, "a", |report| report["notes"] = json!([{"kind": "limit"}, {"kind": "limit"}]));
    fs::write(folder.path().join("a/tradeoff.md"), "# T").expect("writable");
    fs::write(folder.path().join("paper.md"), "Text\n\n# The paper\n").expect("writable");
    fs::create_dir(folder.path().join("something else")).expect("writable");
    let (code, printed, message) = index(folder.path());
    assert_eq!((code, message.as_str()), (0, ""));
    assert!(printed.contains("index.html\n") && printed.contains("README.md\n"), "{printed}");
    let markdown = read(&folder, "README.md");
    assert!(markdown.contains("\n2 cases: 1 mixed, 1 makes it worse.\n"), "{markdown}");
    let rows: Vec<&str> = markdown.lines().filter(|line| line.starts_with("| [")).collect();
    assert!(rows[0].starts_with("| [a](a/report.md): Li 2016, 8 Hz, b = 15 mm; [accuracy and cost](a/tradeoff.md) | **Makes it worse**, 2 notes | "), "{}", rows[0]);
    assert!(
        rows[0].contains("2 notes | 15 mm | 8 Hz | 3.36 mm | +1.0 dB | 3.40 mm |"),
        "{}",
        rows[0]
    );
    assert!(rows[1].contains("| 20 mm | 8.5 Hz | 3.59 mm | −5.0 dB | 3.22 mm |"), "{}", rows[1]);
    assert!(markdown.contains("- [The paper](paper.md)"));
    for line in markdown.lines().filter(|line| line.starts_with('|')) {
        assert_eq!(line.matches('|').count(), 8, "seven columns: {line}");
    }
    let html = read(&folder, "index.html");
    for part in ["a/report.html", "a/tradeoff.md", "paper.md", "−5.0 dB"] {
        assert!(html.contains(part), "{part}");
    }
}

#[test]
fn the_same_reports_give_the_same_bytes() {
    let folder = folder(&[("li2016-8hz-b15mm", "a"), ("reduced-unit-clearance", "b")]);
    let both = || {
        assert_eq!(index(folder.path()).0, 0);
        [read(&folder, "README.md"), read(&folder, "index.html")]
    };
    assert_eq!(both(), both());
}

#[test]
fn names_and_texts_mean_nothing_to_the_page() {
    let folder = folder(&[("li2016-8hz-b15mm", "50 % #1 | <b>")]);
    edit(&folder, "50 % #1 | <b>", |report| {
        report["title"] = "<script>alert(1)</script> | *x*".into();
    });
    assert_eq!(index(folder.path()).0, 0);
    let (html, markdown) = (read(&folder, "index.html"), read(&folder, "README.md"));
    assert!(!html.contains("<script>alert") && !html.contains("<b>"), "{html}");
    assert!(html.contains("href=\"50%20%25%20%231%20%7C%20%3Cb%3E/report.html\""));
    assert!(markdown.contains("(50%20%25%20%231%20%7C%20%3Cb%3E/report.md)"));
    assert!(
        markdown.contains("&#60;script>alert(1)&#60;/script> &#124; &#42;x&#42;"),
        "{markdown}"
    );
}

/// The shipped case with a band, one of whose five criteria fails: its report says 14.6 mm with the
/// absorber (and what it may be more between the places that were solved), 18.1 mm without, 3.39 mm
/// with a tuned mass damper, and 11.7 mm at its own excitation.
#[test]
fn a_case_with_a_band_is_judged_over_the_band() {
    let folder = folder(&[("li2016-band", "a")]);
    assert_eq!(index(folder.path()).0, 0);
    let (markdown, html) = (read(&folder, "README.md"), read(&folder, "index.html"));
    let row = "| 11.5 mm | 8 Hz to 8.7 Hz | 14.6 mm (+0.27 mm) | −1.8 dB (+0.2 dB) | 3.39 mm |";
    assert!(markdown.contains(row), "{markdown}");
    assert!(
        markdown.contains("\n1 case: 1 fails.\n") && markdown.contains("| **FAILS (1 of 5)** |")
    );
    for cell in ["8 Hz to 8.7 Hz", "18.1 mm", "14.6 mm (+0.27 mm)", "−1.8 dB (+0.2 dB)", "3.39 mm"]
    {
        assert!(html.contains(&format!(">{cell}</td>")), "{cell}");
    }
    assert!(html.contains("<strong class=\"bad\">FAILS (1 of 5)</strong>"), "{html}");
    let table = html.split("<section").next().expect("the table of cases");
    for page in [&markdown, table] {
        assert!(
            !page.contains("11.7 mm |") && !page.contains(">11.7 mm<") && !page.contains("Mixed.")
        );
    }
    // No figure is too small to be read.
    assert!(!markdown.contains("<img") && !table.contains("<img"));
    // Where nothing limits the structure alone.
    edit(&folder, "a", |report| {
        report["band"]["bare"]["peak"]["value"] = Value::Null;
        report["verdict"] = json!({"word": "mixed", "tone": "mixed"});
    });
    assert_eq!(index(folder.path()).0, 0);
    let (markdown, html) = (read(&folder, "README.md"), read(&folder, "index.html"));
    assert!(markdown.contains("| **Mixed** |") && html.contains(">without limit</td>"));
}

#[test]
fn criteria_decide_the_verdict_where_a_report_has_them() {
    let folder = folder(&[("li2016-8hz-b15mm", "a")]);
    let verdict = |word: &str, failing: u32| {
        edit(&folder, "a", |report| {
            report["verdict"]["word"] = json!(word);
            report["criteria"] = json!({"failing": failing, "count": 3});
        });
        assert_eq!(index(folder.path()).0, 0);
        let markdown = read(&folder, "README.md");
        let (_, verdict) = markdown.split_once("| **").expect("a verdict");
        verdict.split_once("**").expect("a verdict").0.to_owned()
    };
    assert_eq!(verdict("holds", 0), "HOLDS");
    assert_eq!(verdict("fails", 1), "FAILS (1 of 3)");
    assert_eq!(verdict("too-close-to-call", 1), "TOO CLOSE TO CALL");
    assert_eq!(verdict("makes-it-worse", 0), "Makes it worse");
}

#[test]
fn what_is_no_report_is_refused_and_nothing_is_written() {
    let refused = |folder: &TempDir, parts: &[&str]| {
        let (code, printed, message) = index(folder.path());
        assert_eq!((code, printed.as_str()), (2, ""), "{message}");
        for part in parts {
            assert!(message.contains(part), "{part}: {message}");
        }
        assert!(!folder.path().join("index.html").exists());
    };
    refused(&folder(&[]), &["holds no report", "vinesink report CASE --out"]);
    let broken = folder(&[("li2016-8hz-b15mm", "a"), ("li2016-8hz-b4mm", "b")]);
    let path = broken.path().join("b/report.json");
    fs::write(&path, "{\n  \"format\": oops\n}").expect("writable");
    refused(&broken, &["report.json", "line 2 column", "write the report again"]);
    fs::write(&path, "{\"format\": \"vinesink/report@7\"}").expect("writable");
    refused(&broken, &["vinesink/report@7", "vinesink/answer@2", "write the report again"]);
    fs::write(&path, b"\xff").expect("writable");
    refused(&broken, &["not UTF-8"]);
    let (code, _, message) = index(Path::new("/nowhere/at all"));
    assert_eq!(code, 2);
    assert!(message.contains("cannot read /nowhere/at all"), "{message}");
}

#[test]
fn a_readme_of_somebody_else_is_left_alone() {
    let folder = folder(&[("li2016-8hz-b15mm", "a")]);
    fs::write(folder.path().join("README.md"), "# My reports\n").expect("writable");
    let (code, _, message) = index(folder.path());
    assert_eq!(code, 2);
    assert!(message.contains("is not an index and is left as it is"), "{message}");
    assert_eq!(read(&folder, "README.md"), "# My reports\n");
    assert!(!folder.path().join("index.html").exists());
}

#[test]
fn a_report_refreshes_an_index_that_is_there() {
    let folder = folder(&[("li2016-8hz-b15mm", "a")]);
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/reduced-unit-clearance.toml");
    let out = folder.path().to_str().expect("UTF-8").to_owned();
    let report = || vinesink(&["report", case.to_str().expect("UTF-8"), "--out", &out]);
    assert_eq!(report().0, 0);
    assert!(!folder.path().join("README.md").exists(), "nobody asked for an index");
    fs::remove_dir_all(folder.path().join("reduced-unit-clearance")).expect("writable");
    assert_eq!(index(folder.path()).0, 0);
    assert!(!read(&folder, "README.md").contains("reduced-unit-clearance"));
    assert_eq!(report().0, 0);
    for file in ["README.md", "index.html"] {
        assert!(read(&folder, file).contains("reduced-unit-clearance"), "{file}");
    }
    fs::write(folder.path().join("a/report.json"), "{}").expect("writable");
    let (code, printed, message) = report();
    assert_eq!(code, 2, "the report is there, the index is not up to date");
    assert!(printed.contains("reduced-unit-clearance"), "{printed}");
    assert!(message.contains("index beside the reports is not up to date"), "{message}");
}

/// The committed index is checked against the program by `.ci/run`; its links here.
#[test]
fn the_shipped_index_lists_every_report() {
    let markdown = fs::read_to_string(shipped().join("README.md")).expect("is committed");
    let mut folders = 0;
    for entry in fs::read_dir(shipped()).expect("a folder") {
        let entry = entry.expect("readable");
        if entry.path().is_dir() {
            folders += 1;
            let name = entry.file_name().into_string().expect("UTF-8");
            assert!(markdown.contains(&format!("]({name}/report.md)")), "{name}");
        }
    }
    assert_eq!(markdown.lines().filter(|line| line.starts_with("| [")).count(), folders);
    for link in markdown.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
        assert!(shipped().join(link).is_file(), "{link} is linked and missing");
    }
}

/// A structure with loads is driven at their frequencies, from the lowest to the highest.
#[test]
fn loads_have_their_frequencies_in_the_index() {
    let index = fs::read_to_string("reports/README.md").expect("the index");
    let line = index.lines().find(|line| line.contains("](mast/report.md)")).expect("a line");
    assert!(line.contains("| 0.935 Hz to 21.24 Hz |"), "{line}");
}
