//! What comes from somebody else, a case, a record or a `report.json` in a pull request, does nothing where it is
//! written or printed: in a page, a comment, a terminal, the log of a build server, another folder.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};
use regex::Regex;
use serde_json::{Value, json};
use tempfile::TempDir;
use vinesink::diff::markdown::markdown;
use vinesink::diff::{Difference, Document, Reports};
use vinesink::quantity::Units;
use vinesink::report::index::{self, IndexedReport, Summary};
use vinesink::report::{document::FORMAT, escape, template};
use vinesink::store;

/// Text that means something wherever it is not escaped, on one line.
const HOSTILE: &str = "\"><img src=x onerror=boom(1)><script>boom(2)</script> a`<img src=x onerror=boom(3)>`b \
    [c](javascript:boom(4)) ![d](//evil.example/d) @somebody owner/repo#1 GH-1 https://evil.example www.evil.example \
    me@evil.example ~~e~~ **f** | $g$ &#64;somebody ##[error]h ##vso[i]j";

/// The same with what ends a line, a code fence or a paragraph, and with control characters.
const LINES: &str = "0\n\n# INJECTED\n\n```\n\n- INJECTED\n\n<h1>INJECTED</h1>\n\n::set-output name=a::b\n::error::c\r::d\u{0}\u{1b}[31m\u{9b}2J\u{202e}";

fn hostile() -> String {
    format!("{LINES}{HOSTILE}")
}

/// A text as TOML writes it.
fn toml(text: &str) -> String {
    let letters = text.chars().map(|c| match c {
        '"' | '\\' => format!("\\{c}"),
        c if c.is_control() => format!("\\u{:04x}", u32::from(c)),
        c => c.to_string(),
    });
    format!("\"{}\"", letters.collect::<String>())
}

/// A case that is simulated in a moment, with a title.
fn case(title: &str) -> String {
    let title = toml(title);
    format!(
        "title = {title}\nsource = {title}\n
[reduced]
mass_ratio = 0.0077
damping = 1.8
restitution = 0.6
clearance = 1.0
forcing = 2.0
frequency_ratio = 1.0

[criteria]
impact_velocity = \"<= 0.001\"

[simulation]
starts = 2
periods = 50
discard = 50
"
    )
}

fn vinesink(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_vinesink"));
    command.current_dir(folder).args(arguments).output().expect("it runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

fn folder_with(files: &[(&str, &str)]) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, content) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, content).expect("written");
    }
    folder
}

/// What of a Markdown text, as a forge reads it, comes from [`HOSTILE`] or [`LINES`] and is more than text.
fn active(markdown: &str) -> Vec<String> {
    let links =
        Regex::new(r"(^|\W)@[A-Za-z0-9]|#[0-9]|(?i:gh-[0-9])|[a-z]://|www\.[a-z]").expect("valid");
    let mut found = Vec::new();
    let (mut plain, mut heading, mut code) = (String::new(), false, false);
    for event in Parser::new_ext(markdown, Options::ENABLE_TABLES | Options::ENABLE_STRIKETHROUGH) {
        match event {
            Event::Start(Tag::CodeBlock(_)) => code = true,
            Event::End(TagEnd::CodeBlock) => code = false,
            Event::Text(text) if !code => {
                if heading && text.starts_with("INJECTED") {
                    found.push(format!("heading: {text}"));
                }
                plain += &text;
                continue;
            }
            Event::Start(Tag::Heading { .. }) => heading = true,
            Event::End(TagEnd::Heading(_)) => heading = false,
            Event::Html(html) | Event::InlineHtml(html) => {
                // Attributes in quotation marks are text.
                let bare = html.split('"').step_by(2).collect::<String>();
                if ["onerror", "<script", "<h1", "<img src=x"]
                    .iter()
                    .any(|part| bare.contains(part))
                {
                    found.push(format!("element: {html}"));
                }
            }
            Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. })
                if dest_url.contains("evil") || dest_url.starts_with("javascript") =>
            {
                found.push(format!("link: {dest_url}"));
            }
            Event::Start(Tag::Strikethrough) => found.push("struck out".to_owned()),
            _ => {}
        }
        plain.push('\n');
    }
    found.extend(links.find_iter(&plain).map(|one| format!("forge: {}", one.as_str())));
    found.extend(markdown.contains(['\0', '\u{1b}', '\u{202e}']).then(|| "control".to_owned()));
    found
}

/// In an attribute Markdown needs an escape of its own: filters make what has any.
#[test]
fn no_template_of_markdown_prints_into_an_attribute() {
    let markup = Regex::new(r#"<[a-z]+ [a-z]+="[^">]*\{\{"#).expect("valid");
    for entry in fs::read_dir("templates").expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.to_str().is_some_and(|path| path.ends_with(".md.tera")) {
            let template = fs::read_to_string(&path).expect("readable");
            assert!(!markup.is_match(&template), "{}", path.display());
        }
    }
}

/// The check itself sees what it is there for.
#[test]
fn unescaped_text_is_active() {
    let found = active(&format!("# A {HOSTILE}\n")).join("\n");
    for part in [
        "element: <img",
        "element: <script",
        "link: javascript",
        "link: //evil",
        "struck",
        "@s",
        "#1",
        "GH-1",
        "s://",
        "www.e",
    ] {
        assert!(found.contains(part), "{part}: {found}");
    }
    assert!(active(LINES).join("\n").contains("heading: INJECTED"));
}

#[test]
fn nothing_of_a_case_is_active_in_its_pages() {
    let folder = folder_with(&[("bad.toml", &case(&hostile()))]);
    let output = vinesink(folder.path(), &["report", "bad.toml", "--out", "reports"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    for arguments in [&["index"][..], &["tradeoff", "bad.toml", "--out", "reports"]] {
        assert!(vinesink(folder.path(), arguments).status.success(), "{arguments:?}");
    }
    let read =
        |file: &str| fs::read_to_string(folder.path().join("reports").join(file)).expect(file);
    for page in
        ["bad/report.md", "bad/validation.md", "bad/equations.md", "bad/tradeoff.md", "README.md"]
    {
        let page_text = read(page);
        assert!(page_text.contains("INJECTED"), "{page} does not show the title");
        assert_eq!(active(&page_text), [""; 0], "{page}");
    }
    for page in ["bad/report.html", "index.html"] {
        let html = read(page);
        assert!(!html.contains("<img src=x") && !html.contains("<script>boom"), "{page}");
        let policy = "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none';";
        assert!(html.contains(policy) && !html.contains("unsafe"), "{page}");
        assert!(!html.contains("style=\""), "{page}");
    }
}

/// The reports of [`HOSTILE`] cases of several kinds, and their index.
fn hostile_reports() -> TempDir {
    let record = "a`<img src=x onerror=boom(5)>`b.csv";
    let shipped = |name: &str| fs::read_to_string(format!("cases/{name}")).expect("a case");
    let bridge = shipped("tower-record.toml");
    let bridge = bridge.replace("tower-record.csv", record);
    let titled = |case: String| {
        let lines = case.lines().map(|line| match line.split_once(" = ") {
            Some((key @ ("title" | "source"), _)) => format!("{key} = {}\n", toml(HOSTILE)),
            _ => format!("{line}\n"),
        });
        lines.collect::<String>()
    };
    let names =
        ["steady\"><img src=x onerror=boom(6)>.toml", "record.toml", "band.toml", "sweep.toml"];
    let folder = folder_with(&[
        (names[0], &case(HOSTILE)),
        (names[1], &titled(bridge)),
        (names[2], &titled(shipped("footbridge-jump.toml"))),
        (names[3], &titled(shipped("sweep-fast.toml"))),
        (record, &shipped("tower-record.csv")),
    ]);
    let output = vinesink(folder.path(), &[&["report"], &names[..]].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(vinesink(folder.path(), &["index"]).status.success());
    folder
}

/// In Chromium: `.ci/deep browser` runs them.
mod in_a_browser {
    use super::*;
    use crate::browser::browser;
    use crate::browser_support::checks::{self, DESKTOP};

    #[test]
    #[ignore = "deep"]
    fn no_script_of_a_case_runs() {
        let mut browser = browser();
        let folder = hostile_reports();
        let root = folder.path().canonicalize().expect("a path");
        let reports = root.join("reports");
        let mut pages = vec![reports.join("index.html")];
        for entry in fs::read_dir(&reports).expect("a folder") {
            let page = entry.expect("an entry").path().join("report.html");
            pages.extend(page.is_file().then_some(page));
        }
        assert_eq!(pages.len(), 5);
        for file in pages {
            let mut page = browser.page(DESKTOP);
            let name = file.to_str().expect("UTF-8").bytes().map(|byte| match byte {
                b'/' | b'.' | b'-' | b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' => {
                    char::from(byte).to_string()
                }
                other => format!("%{other:02X}"),
            });
            page.open_address(&format!("file://{}", name.collect::<String>()));
            checks::unfold(&mut page);
            let strange =
                "document.querySelectorAll('[onerror], main script, img[src=x], h1 img').length";
            assert_eq!(page.evaluate(strange), 0, "{}", file.display());
            assert_eq!(checks::noise(&mut page, &root), [""; 0], "{}", file.display());
        }
    }

    /// What the pages themselves do is allowed, and a script that gets into one all the same does not run.
    #[test]
    #[ignore = "deep"]
    fn the_policy_lets_a_page_do_its_own_work_and_nothing_else() {
        let mut browser = browser();
        let folder = hostile_reports();
        let root = folder.path().canonicalize().expect("a path");
        let index = root.join("reports/index.html");
        let mut page = browser.page(DESKTOP);
        page.open(&index);
        page.evaluate(
            "document.querySelectorAll('#cases thead button').forEach((one) => one.click())",
        );
        page.evaluate("document.querySelectorAll('#cases input').forEach((one) => one.click())");
        let images = "[...document.querySelectorAll('#figures img')].filter((one) => one.naturalWidth > 0 || !one.complete).length";
        assert_eq!(page.evaluate(images), 4);
        page.evaluate("document.querySelector('#clear').click()");
        assert_eq!(checks::noise(&mut page, &root), [""; 0]);
        let right = "getComputedStyle(document.querySelector('td.right')).textAlign";
        let report = root.join("reports/record/report.html");
        drop(page);
        let mut page = browser.page(DESKTOP);
        page.open(&report);
        assert_eq!(page.evaluate(right), "right");
        assert_eq!(checks::noise(&mut page, &root), [""; 0]);
        drop(page);
        for file in [index, report] {
            let attack = "<script>document.title = 'ran'</script><img src=x onerror=\"document.title = 'ran'\"><p style=\"color: red\">a</p></main>";
            let attacked =
                fs::read_to_string(&file).expect("a page").replacen("</main>", attack, 1);
            fs::write(&file, attacked).expect("written");
            let mut page = browser.page(DESKTOP);
            page.open(&file);
            assert_ne!(page.evaluate("document.title"), "ran");
            let noise = checks::noise(&mut page, &root).join("\n");
            assert!(noise.matches("Content Security Policy").count() >= 3, "{noise}");
        }
    }
}

const SHIPPED: [&str; 2] = ["li2016-8hz-b15mm", "li2016-band"];

fn shipped(name: &str) -> Value {
    let report = fs::read_to_string(format!("reports/{name}/report.json")).expect("a report");
    serde_json::from_str(&report).expect("JSON")
}

fn pointers(value: &Value, at: &str, found: &mut Vec<String>) {
    let mut inner = |key: String, value: &Value| {
        pointers(value, &format!("{at}/{}", key.replace('~', "~0").replace('/', "~1")), found);
    };
    match value {
        Value::Object(fields) => fields.iter().for_each(|(key, one)| inner(key.clone(), one)),
        Value::Array(items) => {
            items.iter().enumerate().for_each(|(k, one)| inner(k.to_string(), one))
        }
        Value::String(_) => found.push(at.to_owned()),
        _ => {}
    }
}

/// The comment on two reports, and whether it says that something changed; nothing where one is refused.
fn reviewed(old: &str, new: &str) -> Option<(String, bool)> {
    let side = |text: &str| {
        let drawings = BTreeMap::from([("map".to_owned(), text.as_bytes().to_vec())]);
        let document = Document::parse("c/report.json", text, drawings).ok()?;
        Some(Reports::from([("c".to_owned(), document)]))
    };
    let (old, new) = (side(old)?, side(new)?);
    let difference = Difference::of(("old", &old), ("new", &new));
    let comment = markdown(&difference, [Some("https://a.example/old"), None]).ok()?;
    Some((comment, difference.is_significant()))
}

fn indexed(report: &str) -> Option<(String, String)> {
    let summary = Summary::read("c/report.json", report).ok()?;
    let case = IndexedReport { name: "c".to_owned(), summary, files: Vec::new(), orphan: false };
    let files = index::files(vec![case], Vec::new()).ok()?;
    let file = |name: &str| text(&files[&PathBuf::from(name)]);
    Some((file(index::MARKDOWN), file(index::HTML)))
}

/// Texts of reports, replaced: a reviewer is told, or the report is refused, and nothing of it is active.
#[test]
fn no_text_of_a_report_is_active_in_a_comment_or_an_index() {
    replaced_texts_are_told_and_not_active(9);
}

/// The same of every text.
#[test]
#[ignore = "deep"]
fn no_text_at_all_of_a_report_is_active_in_a_comment_or_an_index() {
    replaced_texts_are_told_and_not_active(1);
}

/// Of every `step`th text of each report.
fn replaced_texts_are_told_and_not_active(step: usize) {
    let mut told = 0;
    for name in SHIPPED {
        let whole = shipped(name);
        let mut all = Vec::new();
        pointers(&whole, "", &mut all);
        assert!(all.len() > 300, "{}", all.len());
        for (k, at) in all.into_iter().step_by(step).enumerate() {
            // The second text differs in what it tries, not in how it is told: one direction of every third is enough.
            let texts = [(HOSTILE.to_owned(), 2), (hostile(), 1)];
            for (hostile, directions) in texts.into_iter().take(if k % 3 == 0 { 2 } else { 1 }) {
                let mut changed = whole.clone();
                *changed.pointer_mut(&at).expect("a text") = json!(hostile);
                let (old, new) = (whole.to_string(), changed.to_string());
                for (old, new) in [(&old, &new), (&new, &old)].into_iter().take(directions) {
                    let Some((comment, significant)) = reviewed(old, new) else { continue };
                    told += usize::from(comment.contains("INJECTED"));
                    assert_eq!(active(&comment), [""; 0], "{at}: {comment}");
                    assert!(significant || is_passed_over(&at), "{at} changed and nobody is told");
                }
                let Some((markdown, html)) = indexed(&new) else { continue };
                assert_eq!(active(&markdown), [""; 0], "{at}");
                assert!(!html.contains("<img src=x") && !html.contains("<script>boom"), "{at}");
            }
        }
    }
    assert!(told > 100 / step, "{told} comments show the text");
}

/// A generator of numbers, the same on every machine (SplitMix64).
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % limit as u64) as usize
    }
}

/// Where two documents differ in more than numbers.
fn difference(old: &Value, new: &Value, at: &str) -> Option<String> {
    match (old, new) {
        (Value::Object(a), Value::Object(b)) => {
            let keys = a.keys().chain(b.keys());
            keys.into_iter().find_map(|key| match (a.get(key), b.get(key)) {
                (Some(a), Some(b)) => difference(a, b, &format!("{at}/{key}")),
                _ => Some(format!("{at}/{key}")),
            })
        }
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            let pairs = a.iter().zip(b).enumerate();
            pairs.into_iter().find_map(|(k, (a, b))| difference(a, b, &format!("{at}/{k}")))
        }
        (Value::Number(_), Value::Number(_)) => None,
        (a, b) => (a != b).then(|| at.to_owned()),
    }
}

/// What a comparison passes over: other texts are inputs or stand in a list that grows and shrinks by chance or along a
/// band, and are summed up.
fn is_passed_over(at: &str) -> bool {
    // The hash is held to the case file, which is not there; the badge is what the verdict says.
    ["/criteria/badge", "/name", "/provenance/case_sha256", "/provenance/program"].contains(&at)
        || at.starts_with("/band/")
        || at.contains("/outcome/shares")
        // A motion that one start of many found may be missed by the next ones.
        || (at.starts_with("/motions/") && at.ends_with("/regime"))
}

/// Whether a quantity moved by far more than it is known to.
fn is_beyond_errors(old: &Value, new: &Value) -> bool {
    match (old, new) {
        (Value::Object(a), Value::Object(b)) => {
            let number = |of: &serde_json::Map<String, Value>, key: &str| of.get(key)?.as_f64();
            let values = number(a, "value").zip(number(b, "value"));
            let errors = number(a, "error").zip(number(b, "error"));
            let beyond = values.zip(errors).is_some_and(|((a, b), (c, d))| {
                (a - b).abs() > c + d + 1e-5 * a.abs().max(b.abs()).max(1e-3)
            });
            let inside =
                |(key, a): (&String, &Value)| b.get(key).is_some_and(|b| is_beyond_errors(a, b));
            beyond || a.iter().any(inside)
        }
        (Value::Array(a), Value::Array(b)) => a.iter().zip(b).any(|(a, b)| is_beyond_errors(a, b)),
        _ => false,
    }
}

/// A bit flipped, an end cut off, a piece taken out or doubled.
#[test]
fn a_damaged_report_is_refused_or_told() {
    let text = fs::read_to_string("reports/li2016-8hz-b7p5mm/report.json").expect("a report");
    let whole: Value = serde_json::from_str(&text).expect("JSON");
    let mut numbers = Numbers(7);
    let (mut refused, mut told, mut silent) = (0, 0, 0);
    for round in 0..600 {
        let mut bytes = text.clone().into_bytes();
        let at = numbers.below(bytes.len());
        let end = (at + 1 + numbers.below(30)).min(bytes.len());
        match numbers.below(6) {
            0 => bytes.truncate(at),
            1 => drop(bytes.drain(at..end)),
            2 => {
                let piece = bytes[at..end].to_vec();
                drop(bytes.splice(at..at, piece));
            }
            _ => bytes[at] ^= 1 << numbers.below(7),
        }
        let Ok(damaged) = String::from_utf8(bytes) else { continue };
        indexed(&damaged);
        match (reviewed(&text, &damaged), serde_json::from_str::<Value>(&damaged)) {
            (None, _) => refused += 1,
            (Some((_, true)), _) => told += 1,
            (Some((comment, false)), Ok(read)) => {
                silent += 1;
                let differing = difference(&whole, &read, "");
                let told = differing.as_deref().is_none_or(is_passed_over);
                assert!(told, "{round} at {at}, {differing:?}: {comment}");
                assert!(!is_beyond_errors(&whole, &read), "{round} at {at}: {comment}");
            }
            (Some(_), Err(error)) => panic!("{round} at {at}: {error}"),
        }
    }
    assert!(refused > 100 && told > 100 && silent < 100, "{refused} {told} {silent}");
}

/// What a command says of a damaged report: no source of a template, no crash.
#[test]
fn a_damaged_report_is_named_without_the_source_of_a_template() {
    let name = "li2016-band";
    for (at, value) in [
        ("/criteria/all/0/found/id", json!("nonsense")),
        ("/quantities/clearance/id", json!("nonsense")),
        ("/verdict/word", json!("nonsense")),
        ("/claims/0/statement", json!({ "about": "boundary" })),
        ("/band/worst/peak", json!({ "value": "a", "error": [] })),
    ] {
        let mut report = shipped(name);
        let old = report.to_string();
        *report.pointer_mut(at).expect(at) = value;
        let folder =
            folder_with(&[("old/c/report.json", &old), ("new/c/report.json", &report.to_string())]);
        for arguments in [&["diff", "old", "new"][..], &["index", "new"]] {
            let output = vinesink(folder.path(), arguments);
            let said = text(&output.stderr);
            assert!(output.status.code().is_some_and(|code| code < 3), "{at}: {said}");
            for part in ["{{", "{%", "panicked", "-->"] {
                assert!(!said.contains(part), "{at}, {arguments:?}: {said}");
            }
            assert!(output.status.code() != Some(0) || arguments[0] == "index", "{at}: {said}");
        }
    }
    let error = template::render("report.md", &Units::reduced(), &json!({})).expect_err("no facts");
    let error = error.to_string();
    assert!(
        error.starts_with("the page report.md cannot be made: ") && error.lines().count() == 1,
        "{error}"
    );
}

/// Lines that a terminal or a build server would obey.
fn obeyed(printed: &str) -> Vec<String> {
    let acts = |line: &&str| {
        line.trim_start().starts_with("::")
            || line.contains("##[")
            || line.contains("##vso[")
            || line.chars().any(|c| c != '\t' && escape::is_control(c))
    };
    printed.split('\n').filter(acts).map(str::to_owned).collect()
}

#[test]
fn nothing_printed_is_obeyed_by_a_terminal_or_a_build_server() {
    let bytes = format!("{}\nboom = '\u{1b}[31m\u{7} ##[error]a'\n\u{9b}::error::b\n", case("a"));
    let unknown = format!("{}\n[{}]\na = 1\n", case("a"), toml(&hostile()));
    let bad = case(&hostile());
    let line = "a\n::error::b ```\n##[c].toml";
    let folder = folder_with(&[
        ("bad.toml", &bad),
        ("bytes.toml", &bytes),
        ("unknown.toml", &unknown),
        (line, &bad),
    ]);
    let path = folder.path();
    for arguments in [
        &["analyze", "bad.toml"][..],
        &["analyze", "bad.toml", "--format", "json"],
        &["simulate", "bad.toml"],
        &["simulate", "bad.toml", "--format", "json"],
        &["check", "bad.toml"],
        &["check", "bad.toml", "--format", "markdown"],
        &["check", "bad.toml", "--format", "junit"],
        &["report", "bad.toml", "--out", "reports"],
        &["report", line, "--out", "reports"],
        &["report", line, "--check", "--out", "none\n::error::d"],
        &["diff", "reports/bad", "reports/a\n::error::b ```\n##[c]"],
        &["analyze", "bytes.toml"],
        &["check", "bytes.toml", "unknown.toml", line],
        &["check", "unknown.toml", "--format", "json"],
        &["analyze", "::error::e\u{1b}[31m"],
        &["\u{1b}[31m\n::error::f"],
    ] {
        let output = vinesink(path, arguments);
        assert!(output.status.code().is_some(), "{arguments:?}");
        for stream in [text(&output.stdout), text(&output.stderr)] {
            assert_eq!(obeyed(&stream), [""; 0], "{arguments:?}: {stream}");
        }
    }
    // Annotations are commands; nothing of a case is one.
    let output = vinesink(path, &["check", "bad.toml", "unknown.toml", line, "--format", "github"]);
    let printed = text(&output.stdout);
    assert!(printed.lines().count() >= 3, "{printed}");
    for line in printed.lines() {
        assert!(line.starts_with("::error file="), "{printed}");
        // What begins with one command is none of the older kind, wherever that stands.
        assert!(!line.chars().any(escape::is_control), "{printed}");
    }
    // JSON says the same as before.
    let output = vinesink(path, &["check", "bad.toml", "--format", "json"]);
    let document: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(document["cases"][0]["case"], "bad");
}

#[cfg(unix)]
#[test]
fn no_output_is_written_through_a_link() {
    for command in ["report", "optimize", "sweep"] {
        writes_through_no_link(command);
    }
}

#[cfg(unix)]
#[test]
#[ignore = "deep"]
fn no_tradeoff_is_written_through_a_link() {
    writes_through_no_link("tradeoff");
}

#[cfg(unix)]
fn writes_through_no_link(command: &str) {
    use std::os::unix::fs::symlink;
    let sweep = "\n[sweep]\nclearance = { from = 0.9, to = 1.1, count = 3 }\nstarts = 1\n";
    let bounds = "\n[optimize]\nobjective = \"stable-share\"\nclearance = [0.5, 2.0]\n";
    let text_of = format!(
        "{}{sweep}{bounds}",
        case("a").replace("[criteria]\nimpact_velocity = \"<= 0.001\"\n", "")
    );
    let command = &[command, "a.toml"][..];
    for linked in ["out/a", "out/a/figures", "out/a/chunks"] {
        let folder = folder_with(&[("a.toml", &text_of), ("elsewhere/kept.txt", "kept")]);
        let (path, elsewhere) = (folder.path(), folder.path().join("elsewhere"));
        let at = path.join(linked);
        fs::create_dir_all(at.parent().expect("a folder")).expect("a folder");
        symlink(&elsewhere, &at).expect("a link");
        let output = vinesink(path, &[command, &["--out", "out"]].concat());
        let said = text(&output.stderr);
        let there: Vec<_> = fs::read_dir(&elsewhere).expect("a folder").collect();
        assert_eq!(there.len(), 1, "{command:?} {linked}: {said}");
        assert!(at.is_symlink(), "{command:?} {linked}: {said}");
        if linked == "out/a" {
            assert_eq!(output.status.code(), Some(2), "{command:?}: {said}");
            let said = said.split(['\n', '│', ' ']).filter(|word| !word.is_empty());
            let said = said.collect::<Vec<_>>().join(" ");
            assert!(said.contains("is a link, through which nothing is written"), "{said}");
        }
    }
    // The folder that was named may be one.
    let folder = folder_with(&[("a.toml", &text_of), ("elsewhere/kept.txt", "kept")]);
    symlink("elsewhere", folder.path().join("out")).expect("a link");
    let output = vinesink(folder.path(), &[command, &["--out", "out"]].concat());
    assert!(output.status.code() != Some(2), "{command:?}: {}", text(&output.stderr));
    assert!(folder.path().join("elsewhere/a").is_dir(), "{command:?}");
}

/// Who writes a report and who adds a page to it wait for one another.
#[test]
fn nothing_is_lost_where_several_write_at_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("out");
    let files = |name: String| BTreeMap::from([(PathBuf::from(name), b"a".to_vec())]);
    let ours = |file: &Path| file == Path::new("report.md");
    std::thread::scope(|scope| {
        for _ in 0..3 {
            scope.spawn(|| {
                for _ in 0..40 {
                    let output = store::Output::open(&out).expect("a folder");
                    output.replace("case", &files("report.md".to_owned()), ours).expect("replaced");
                }
            });
        }
        for writer in 0..2 {
            let (out, files) = (&out, &files);
            scope.spawn(move || {
                for page in 0..60 {
                    let output = store::Output::open(out).expect("a folder");
                    output.add("case", &files(format!("{writer}-{page}.md"))).expect("added");
                }
            });
        }
    });
    let left = fs::read_dir(out.join("case")).expect("a folder").count();
    assert_eq!(left, 121, "pages are lost");
    assert_eq!(fs::read_dir(&out).expect("a folder").count(), 1, "something is left over");
}

/// The lock of a writer that is killed is gone with it.
#[cfg(unix)]
#[test]
fn a_report_waits_for_another_writer_no_longer_than_that_lives() {
    let folder = folder_with(&[("a.toml", &case("a")), ("out/kept.txt", "kept")]);
    let held = store::Output::open(&folder.path().join("out")).expect("a folder");
    let mut command = Command::new(env!("CARGO_BIN_EXE_vinesink"));
    command.current_dir(folder.path()).args(["report", "a.toml", "--out", "out"]);
    let mut child = command.stdout(std::process::Stdio::null()).spawn().expect("it runs");
    std::thread::sleep(std::time::Duration::from_secs(3));
    assert!(child.try_wait().expect("asked").is_none(), "it did not wait");
    assert!(!folder.path().join("out/a").exists());
    drop(held);
    assert!(child.wait().expect("it ends").success());
    assert!(folder.path().join("out/a/report.md").is_file());
}

/// The format is part of what is checked: tests above would pass on reports that are refused for it.
#[test]
fn shipped_reports_are_read() {
    for name in SHIPPED {
        let report = shipped(name);
        assert_eq!(report["format"], FORMAT);
        let report = report.to_string();
        let (comment, significant) = reviewed(&report, &report).expect("read");
        assert!(!significant && comment.starts_with("No change"), "{comment}");
        assert!(indexed(&report).is_some());
    }
}

/// Marks of direction and other characters that nobody sees, in titles and names of places.
#[test]
fn characters_that_nobody_sees_reach_no_page_and_no_terminal() {
    let unseen = [
        '\u{202e}',
        '\u{2066}',
        '\u{200f}',
        '\u{61c}',
        '\u{200b}',
        '\u{2060}',
        '\u{ad}',
        '\u{feff}',
        '\u{e0041}',
        '\u{3164}',
    ];
    let title: String = unseen.iter().map(|one| format!("a{one}b ")).collect();
    let mast = fs::read_to_string("cases/several/mast-two.toml").expect("a case");
    let modes = fs::read_to_string("cases/several/mast.csv").expect("a file");
    // As a name of a place in the file of modes, and in the case.
    let place = title.replace(' ', "");
    let mast = mast.lines().map(|line| match line.split_once(" = ") {
        Some(("title", _)) => format!("title = {}", toml(&title)),
        Some(("place", _)) => format!("place = {}", toml(&place)),
        _ => line.replace("place = \"tip\"", &format!("place = {}", toml(&place))),
    });
    let mast = mast.collect::<Vec<_>>().join("\n");
    // One load and one absorber are enough.
    let (head, rest) = mast.split_once("[[excitation]]").expect("loads");
    let (head, _) = head.rsplit_once("[[absorber]]").expect("two");
    let (load, rest) = rest.split_once("[[excitation]]").expect("loads");
    let (_, tail) = rest.split_once("[criteria]").expect("a table");
    let load = load
        .replace("from = \"0.935 Hz\"", "frequency = \"1.1 Hz\"")
        .replace("to = \"1.21 Hz\"", "")
        // Absorbers that rest are soon known.
        .replace("0.3583 N", "0.01 N");
    let mast = format!("{head}[[excitation]]{load}[simulation]\nstarts = 2\n[criteria]{tail}");
    let folder = folder_with(&[
        ("one.toml", &case(&title)),
        ("mast.toml", &mast),
        ("mast.csv", &modes.replace("tip", &place)),
    ]);
    let mut printed = String::new();
    for arguments in [
        &["report", "one.toml", "mast.toml", "--out", "reports"][..],
        &["report", "one.toml", "--out", "old", "--criteria-only"],
        &["index"],
        &["check", "one.toml"],
        &["check", "one.toml", "--format", "json"],
        &["check", "one.toml", "--format", "github"],
        &["simulate", "mast.toml"],
        &["diff", "old", "reports"],
    ] {
        let output = vinesink(folder.path(), arguments);
        assert_ne!(output.status.code(), Some(2), "{arguments:?} {}", text(&output.stderr));
        printed += &text(&output.stdout);
        printed += &text(&output.stderr);
    }
    assert!(!printed.contains(unseen), "{printed}");
    let mut pages = 0;
    let mut folders = vec![folder.path().join("reports")];
    while let Some(inside) = folders.pop() {
        for entry in fs::read_dir(inside).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending != "json") {
                let page = fs::read_to_string(&path).expect("text");
                assert!(!page.contains(unseen), "{}", path.display());
                pages += 1;
            }
        }
    }
    assert!(pages > 10, "{pages}");
}
