//! The book in `docs/`: what it shows is what the program prints.
//!
//! A block marked `console` holds commands behind `$ `, an exit code that is not 0 behind `? `, and the output. The
//! blocks of a page run one after another in a folder of its own; a comment `<!-- run: ... -->` does so unseen.
//! A comment `<!-- slow: ... -->` before a block that takes seconds is done in its place where neither the test nor
//! the program is optimised. `BOOK_PROGRAM=target/release/vinesink cargo test --test program book:: -- --include-ignored` runs
//! all of them.
//! `[..]` stands for the rest of a line that is not the same on every machine. `SNAPSHOTS=overwrite` writes
//! what is printed, equations, quotations and formulas into the pages; twice, since one may follow from another.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;

use regex::Regex;
use serde_json::Value;
use snapbox::IntoData;
use tempfile::TempDir;
use vinesink::report::mathml::to_mathml;
use vinesink::symbolic::Group;
use vinesink::system::Excitation;

fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs")
}

fn overwrites() -> bool {
    std::env::var("SNAPSHOTS").is_ok_and(|action| action == "overwrite")
}

/// Tests that write pages take turns.
fn turn() -> Option<MutexGuard<'static, ()>> {
    static TURN: Mutex<()> = Mutex::new(());
    overwrites().then(|| TURN.lock().unwrap_or_else(PoisonError::into_inner))
}

/// The pages by their names, with their text.
fn pages() -> BTreeMap<String, String> {
    let mut pages = BTreeMap::new();
    for folder in ["", "commands"] {
        for entry in fs::read_dir(docs().join("src").join(folder)).expect("docs/src") {
            let path = entry.expect("an entry").path();
            if path.extension().is_some_and(|extension| extension == "md") {
                let name = path.strip_prefix(docs().join("src")).expect("it is inside");
                let name = name.to_str().expect("a name").to_owned();
                pages.insert(name, fs::read_to_string(&path).expect("a page"));
            }
        }
    }
    pages
}

fn write_page(name: &str, text: &str) {
    fs::write(docs().join("src").join(name), text).expect("written");
}

/// The lines of a page with whether they are inside a fence.
fn fenced(text: &str) -> impl Iterator<Item = (&str, bool)> {
    let mut inside = false;
    text.lines().map(move |line| {
        let fence = line.starts_with("```");
        let is_inside = inside || fence;
        inside ^= fence;
        (line, is_inside)
    })
}

/// A command of a page with what the page says of it.
#[derive(Default)]
struct Step {
    command: String,
    code: i32,
    output: String,
    /// The lines of the exit code and of the output, from and to before.
    lines: (usize, usize),
    shown: bool,
    /// What is done in its place where it would take too long; for the first of a block only.
    instead: Option<String>,
    slow: bool,
}

fn steps(text: &str) -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::new();
    let (mut inside, mut command_goes_on) = (false, false);
    let (mut slow, mut instead) = (false, None);
    let comment = |line: &str, name: &str| {
        let text = line.strip_prefix(&format!("<!-- {name}: "))?.strip_suffix(" -->")?;
        Some(text.to_owned())
    };
    for (number, line) in text.lines().enumerate() {
        if !inside {
            inside = line == "```console";
            if let Some(command) = comment(line, "run") {
                steps.push(Step { command, ..Step::default() });
            }
            if let Some(command) = comment(line, "slow") {
                (slow, instead) = (true, Some(command));
            }
        } else if line == "```" {
            (inside, slow) = (false, false);
        } else if let Some(command) = line.strip_prefix("$ ") {
            let (lines, instead) = ((number + 1, number + 1), instead.take());
            let command = command.to_owned();
            steps.push(Step { command, lines, shown: true, slow, instead, ..Step::default() });
            command_goes_on = true;
        } else if let Some(step) = steps.last_mut() {
            if let Some(more) = line.strip_prefix("> ").filter(|_| command_goes_on) {
                step.command = format!("{}\n{more}", step.command);
                step.lines = (number + 1, number + 1);
                continue;
            }
            command_goes_on = false;
            let code = line.strip_prefix("? ").filter(|_| step.output.is_empty());
            match code.and_then(|code| code.parse().ok()) {
                Some(code) => step.code = code,
                None => step.output = format!("{}{line}\n", step.output),
            }
            step.lines.1 = number + 1;
        }
    }
    steps
}

/// The programs whose commands the book describes.
const PROGRAMS: [&str; 2] = ["vinesink", "vinesink-evidence"];

/// The folder that they are in. Of the second, which belongs to another package, a test of this one alone does not
/// make a new build.
fn programs() -> PathBuf {
    // Another build, where that is quicker: `BOOK_PROGRAM=target/release/vinesink`.
    let program = std::env::var_os("BOOK_PROGRAM").map(PathBuf::from);
    let program = program.unwrap_or_else(|| env!("CARGO_BIN_EXE_vinesink").into());
    program.parent().expect("a folder").to_owned()
}

/// Runs a command as a reader would, both streams together.
fn run(command: &str, folder: &Path) -> (i32, String) {
    let path = std::env::var("PATH").unwrap_or_default();
    let who = [("GIT_AUTHOR", "Reader"), ("GIT_COMMITTER", "Reader")];
    let mut shell = Command::new("sh");
    shell.current_dir(folder.join("work")).arg("-c").arg(format!("exec 2>&1\n{command}"));
    shell.env_clear().env("PATH", format!("{}:{path}", programs().display()));
    // How often progress is told depends on the machine.
    shell.env("VINESINK_PROGRESS_SECONDS", "1000000");
    shell.env("HOME", folder).env("LC_ALL", "C.UTF-8").env("BOOK", docs().join("src"));
    for (prefix, name) in who {
        shell
            .env(format!("{prefix}_NAME"), name)
            .env(format!("{prefix}_EMAIL"), "reader@example.org");
        shell.env(format!("{prefix}_DATE"), "2026-03-02T09:00:00Z");
    }
    let output = shell.output().expect("a shell");
    let text = String::from_utf8(output.stdout).expect("text");
    // What the pages have of spaces at the ends of lines.
    let text: String = text.lines().map(|line| format!("{}\n", line.trim_end())).collect();
    (output.status.code().unwrap_or(-1), text)
}

/// Runs a page's commands: what differs, and the page as it should be.
fn run_page(name: &str, text: &str) -> (Vec<String>, String) {
    let folder = TempDir::new().expect("a folder");
    fs::create_dir(folder.path().join("work")).expect("a folder");
    let lines: Vec<&str> = text.lines().collect();
    let (mut faults, mut page, mut copied) = (Vec::new(), String::new(), 0);
    let quick = !cfg!(debug_assertions) || std::env::var_os("BOOK_PROGRAM").is_some();
    for mut step in steps(text) {
        if step.slow && !quick {
            let Some(command) = step.instead.take() else { continue };
            step = Step { command, ..Step::default() };
        }
        let (code, output) = run(&step.command, folder.path());
        let where_ = format!("{name}: {}", step.command);
        if !step.shown {
            if code != 0 {
                faults.push(format!("{where_}: exit code {code}\n{output}"));
            }
            continue;
        }
        if code != step.code {
            faults.push(format!("{where_}: exit code {code}, in the book {}\n", step.code));
        }
        // It would take a backslash for a part of a path.
        let plain = |text: &str| text.replace('\\', "\u{29f5}").into_data();
        let same = snapbox::Assert::new().action(snapbox::assert::Action::Verify).try_eq(
            Some(&where_),
            plain(&output),
            plain(&step.output),
        );
        for line in &lines[copied..step.lines.0] {
            page.push_str(line);
            page.push('\n');
        }
        copied = step.lines.1;
        if code != 0 {
            writeln!(page, "? {code}").expect("memory");
        }
        match same {
            Ok(()) => page.push_str(&step.output),
            Err(difference) => {
                faults.push(difference.to_string());
                page.push_str(&output);
            }
        }
    }
    for line in &lines[copied..] {
        page.push_str(line);
        page.push('\n');
    }
    (faults, page)
}

/// Pages whose commands take seconds each.
const SLOW_PAGES: [&str; 3] = ["first-design.md", "transients.md", "tutorial.md"];

#[test]
fn what_the_book_shows_is_what_the_program_prints() {
    run_pages(|name| !SLOW_PAGES.contains(&name));
}

#[test]
#[ignore = "deep"]
fn what_slow_pages_of_the_book_show_is_what_the_program_prints() {
    run_pages(|name| SLOW_PAGES.contains(&name));
}

fn run_pages(which: impl Fn(&str) -> bool) {
    let _turn = turn();
    // Where a page alone is worked on.
    let only = std::env::var("BOOK_PAGE").ok();
    let wanted = |name: &String| {
        which(name) && only.as_ref().is_none_or(|only| name.contains(only.as_str()))
    };
    let waiting: Vec<(String, String)> =
        pages().into_iter().filter(|(name, _)| wanted(name)).collect();
    let (waiting, faults) = (Mutex::new(waiting), Mutex::new(Vec::new()));
    let workers = thread::available_parallelism().map_or(2, usize::from).min(8);
    thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                loop {
                    let Some((name, text)) = waiting.lock().expect("no panic").pop() else { break };
                    let (differs, page) = run_page(&name, &text);
                    if overwrites() && page != text {
                        write_page(&name, &page);
                    } else {
                        faults.lock().expect("no panic").extend(differs);
                    }
                }
            });
        }
    });
    let faults = faults.into_inner().expect("no panic");
    assert!(faults.is_empty(), "{}\nSNAPSHOTS=overwrite writes it", faults.join("\n"));
}

/// The keys of a table of the schema, those of its alternatives included.
fn keys(schema: &Value) -> BTreeSet<String> {
    let mut keys: BTreeSet<String> = schema["properties"]
        .as_object()
        .into_iter()
        .flatten()
        .map(|(key, _)| key.clone())
        .collect();
    for alternatives in ["oneOf", "anyOf", "allOf"] {
        for alternative in schema[alternatives].as_array().into_iter().flatten() {
            keys.extend(self::keys(alternative));
        }
    }
    keys
}

/// The tables of a case by their names, each with its keys; the file itself has no name. A list of tables within a table has
/// both names.
fn tables(schema: &Value) -> BTreeMap<String, BTreeSet<String>> {
    let mut tables = BTreeMap::from([(String::new(), keys(schema))]);
    for key in keys(schema) {
        let table = &schema["properties"][&key];
        let inside = keys(table);
        for list in &inside {
            let items = &table["properties"][list]["items"];
            if items["properties"].is_object() {
                tables.insert(format!("{key}.{list}"), keys(items));
            }
        }
        if !inside.is_empty() {
            tables.insert(key, inside);
        }
    }
    tables
}

/// The names that a key may have as its value.
fn names(schema: &Value, found: &mut BTreeSet<String>) {
    match schema {
        Value::Object(entries) => {
            if let Some(name) = entries.get("const").and_then(Value::as_str) {
                found.insert(name.to_owned());
            }
            entries.values().for_each(|value| names(value, found));
        }
        Value::Array(items) => items.iter().for_each(|value| names(value, found)),
        _ => {}
    }
}

#[test]
fn every_key_of_a_case_has_its_line() {
    let text = &pages()["case-file.md"];
    // Rows of tables begin with a key between backticks; a heading names the table of the case.
    let mut told: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    let mut rows: BTreeMap<(String, String), String> = BTreeMap::new();
    let mut table = String::new();
    let heading = Regex::new(r"^##+ .*`\[+([a-z.]+)\]+`").expect("a pattern");
    for (line, inside) in fenced(text) {
        if inside {
            continue;
        }
        if let Some(named) = heading.captures(line) {
            named[1].clone_into(&mut table);
        } else if line.starts_with("### ") {
            "other".clone_into(&mut table);
        } else if line.starts_with("## ") {
            table.clear();
        }
        let first = line.strip_prefix("| `").and_then(|row| row.split('|').next());
        for key in first.into_iter().flat_map(|cell| cell.split(", ")) {
            let key = key.trim().trim_matches('`').to_owned();
            rows.entry((table.clone(), key.clone())).or_default().push_str(line);
            told.entry(table.clone()).or_default().insert(key);
        }
    }
    let schema = vinesink::case::schema();
    let [one, several] = ["one", "several"].map(|part| tables(&schema["$defs"][part]));
    let mut wanted = one.clone();
    for (table, keys) in &several {
        wanted.entry(table.clone()).or_default().extend(keys.iter().cloned());
    }
    let mut values = BTreeSet::new();
    names(&schema["$defs"], &mut values);
    for (table, keys) in &wanted {
        let empty = BTreeSet::new();
        let told = told.get(table).unwrap_or(&empty);
        let lacks: Vec<_> = keys.difference(told).collect();
        let has: Vec<_> = told.difference(keys).collect();
        assert!(lacks.is_empty(), "docs/src/case-file.md has no line for {lacks:?} of [{table}]");
        assert!(has.is_empty(), "docs/src/case-file.md has {has:?} in [{table}], no case has");
    }
    for table in told.keys() {
        assert!(wanted.contains_key(table), "docs/src/case-file.md has [{table}], no case has");
    }
    // Where a table is of every structure, what one mode and one absorber do not have is told in the key's row.
    for (table, keys) in one.iter().filter(|(table, _)| !table.is_empty()) {
        for key in several.get(table).into_iter().flatten().filter(|key| !keys.contains(*key)) {
            let row = rows.get(&(table.clone(), key.clone())).map_or("", String::as_str);
            let is_list = several.contains_key(&format!("{table}.{key}"));
            let says = is_list || row.contains("several");
            assert!(says, "docs/src/case-file.md: `{key}` of [{table}] is of several alone");
        }
    }
    for name in values {
        assert!(text.contains(&format!("`{name}`")), "docs/src/case-file.md lacks `{name}`");
    }
}

#[test]
fn every_command_has_its_page() {
    let summary = &pages()["SUMMARY.md"];
    for program in PROGRAMS {
        for command in subcommands(program, &[]) {
            let page = format!("commands/{command}.md");
            let text = pages().remove(&page).unwrap_or_else(|| panic!("no docs/src/{page}"));
            assert!(summary.contains(&format!("]({page})")), "docs/src/SUMMARY.md lacks {page}");
            for below in subcommands(program, &[&command]) {
                let named = format!("{program} {command} {below}");
                assert!(text.contains(&named), "docs/src/{page} lacks `{named}`");
            }
            for option in options(program, &command) {
                assert!(text.contains(&option), "docs/src/{page} lacks {option}");
            }
        }
    }
}

fn help(program: &str, of: &[&str]) -> String {
    let output = Command::new(programs().join(program)).args(of).arg("--help").output();
    let output = output.unwrap_or_else(|error| panic!("{program}: {error}; run cargo build"));
    String::from_utf8(output.stdout).expect("text")
}

fn subcommands(program: &str, of: &[&str]) -> Vec<String> {
    let help = help(program, of);
    let lines = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let lines = lines.take_while(|line| !line.is_empty());
    let names = lines.filter_map(|line| line.split_whitespace().next());
    names.filter(|name| *name != "help").map(str::to_owned).collect()
}

fn options(program: &str, command: &str) -> Vec<String> {
    let option = Regex::new(r"(?m)^ +(--[a-z-]+)").expect("a pattern");
    let help = help(program, &[command]);
    option.captures_iter(&help).map(|found| found[1].to_owned()).collect()
}

#[test]
fn every_page_is_listed_short_and_says_what_it_is_for() {
    let pages = pages();
    let summary = &pages["SUMMARY.md"];
    let generated = Regex::new(r"(?s)<!-- (equations|formula):.*?<!-- end -->").expect("a pattern");
    for (name, text) in &pages {
        if name == "SUMMARY.md" {
            continue;
        }
        assert!(summary.contains(&format!("]({name})")), "docs/src/SUMMARY.md lacks {name}");
        let first = text.lines().skip(1).find(|line| !line.is_empty() && !line.starts_with("<!--"));
        let first = first.unwrap_or_default();
        assert!(first.starts_with("After this page you "), "{name} begins with: {first}");
        let written = generated.replace_all(text, "");
        // The case file has a row for each key, however many there are.
        let is_row = |line: &str| name == "case-file.md" && line.starts_with('|');
        let text = fenced(&written).filter(|(line, inside)| !inside && !line.is_empty());
        let lines = text.filter(|(line, _)| !is_row(line)).count();
        assert!(lines <= 150, "{name} has {lines} lines of text");
    }
}

/// The formulas of a page between dollar signs, as `docs/formulas.py` finds them.
fn formulas(text: &str) -> Vec<String> {
    let pattern = Regex::new(r"`[^`]*`|\$\$(.+?)\$\$|\$([^$\n]+?)\$").expect("a pattern");
    let mut found = Vec::new();
    for (line, inside) in fenced(text) {
        if !inside {
            let captures = pattern.captures_iter(line);
            let formulas = captures.filter_map(|found| found.get(1).or(found.get(2)));
            found.extend(formulas.map(|formula| formula.as_str().to_owned()));
        }
    }
    found
}

#[test]
fn formulas_are_converted_by_the_program() {
    let _turn = turn();
    let mut known = BTreeMap::new();
    for (name, text) in pages() {
        for latex in formulas(&text) {
            let mathml = to_mathml(&latex).unwrap_or_else(|error| panic!("{name}: {error}"));
            known.insert(latex, mathml);
        }
    }
    let wanted = serde_json::to_string_pretty(&known).expect("text") + "\n";
    let path = docs().join("formulas.json");
    if overwrites() {
        fs::write(&path, wanted).expect("written");
        return;
    }
    let there = fs::read_to_string(&path).expect("docs/formulas.json");
    assert!(there == wanted, "docs/formulas.json is out of date; SNAPSHOTS=overwrite writes it");
}

/// A group of equations as the list of all of them has it.
fn typeset(group: &Group) -> String {
    let Group { title, gives, source, .. } = group;
    format!("**{title}**: {gives}.\n{}\n*Source: {source}.*\n", formulas_of(group))
}

/// Its equations alone, where the text says what they are for.
fn formulas_of(group: &Group) -> String {
    let mut text = String::new();
    for equation in group.equations {
        write!(text, "\n$${}$$\n", equation.to_latex()).expect("memory");
    }
    text
}

/// The equations of the book are those that the program evaluates, and one page has all of them.
#[test]
fn equations_are_those_that_are_evaluated() {
    let _turn = turn();
    let mut groups: BTreeMap<String, &Group> = BTreeMap::new();
    let mut add = |room: &str, group: &'static Group, excitation: Excitation| {
        let title = format!("{room}{}", group.title);
        // One title has a group for each kind of excitation.
        let repeated = groups.get(&title).is_some_and(|there| *there != group);
        let force = repeated && excitation == Excitation::Force;
        groups.insert(if force { title + ", force" } else { title }, group);
    };
    for kind in [Excitation::BaseDisplacement, Excitation::Force] {
        vinesink::equations::groups(kind).for_each(|group| add("", group, kind));
        vinesink::orbits::equations::groups(kind).for_each(|group| add("orbit: ", group, kind));
        vinesink::equations::groups_beyond().for_each(|group| add("", group, kind));
    }
    let mut left: BTreeSet<&str> = groups.keys().map(String::as_str).collect();
    let mark = r"(?s)<!-- (equations|formula): ([^\n]*?) -->\n(.*?)<!-- end -->";
    let mark = Regex::new(mark).expect("a pattern");
    for (name, text) in pages() {
        let mut page = text.clone();
        for found in mark.captures_iter(&text) {
            let [kind, titles] = [&found[1], &found[2]];
            let of = |title| {
                let group = groups.get(title);
                *group.unwrap_or_else(|| panic!("{name}: no group `{title}`"))
            };
            let wanted = if kind == "equations" {
                left.remove(titles);
                typeset(of(titles))
            } else {
                titles.split("; ").map(|title| formulas_of(of(title))).collect()
            };
            let wanted = format!("<!-- {kind}: {titles} -->\n{wanted}<!-- end -->");
            if overwrites() {
                page = page.replace(&found[0], &wanted);
            } else {
                assert!(found[0] == wanted, "{name}: SNAPSHOTS=overwrite writes\n{wanted}");
            }
        }
        if page != text {
            write_page(&name, &page);
        }
    }
    assert!(left.is_empty(), "no page has the equations {left:?}");
}

/// Lines that a page has from a report: from the first that contains some words to the next empty one, the
/// links without their addresses.
/// Links and pictures of a page, as (line, target); not those in code.
fn targets(text: &str) -> Vec<String> {
    let link = Regex::new(r#"\]\(([^)\s]+)(?: "[^"]*")?\)"#).expect("a pattern");
    let code = Regex::new(r"`[^`]*`").expect("a pattern");
    let lines =
        fenced(text).filter(|(_, fenced)| !fenced).map(|(line, _)| code.replace_all(line, ""));
    lines
        .flat_map(|line| link.captures_iter(&line).map(|one| one[1].to_owned()).collect::<Vec<_>>())
        .collect()
}

/// Where most people meet it, a forge shows the sources as they are: nothing is included, no frame is empty, every picture and
/// page is there, the drawings are those of the reports, and a file that is shown is the file.
#[test]
fn the_sources_read_well_on_a_forge() {
    let mut wrong = Vec::new();
    let mut seen = [0; 2];
    let shown = r"(?s)<!-- file: (\S+)(?: from line (\d+))? -->\n```\w+\n(.*?)\n```\n";
    let shown = Regex::new(shown).expect("a pattern");
    for (name, text) in pages() {
        let folder = docs().join("src").join(&name).parent().expect("a folder").to_owned();
        for (what, _) in [("{{#", 0), ("<iframe", 0), ("<img", 0)] {
            if fenced(&text).any(|(line, fenced)| !fenced && line.contains(what)) {
                wrong.push(format!("{name}: {what}"));
            }
        }
        for target in targets(&text) {
            let path = target.split('#').next().unwrap_or_default();
            if path.is_empty() || path.starts_with("http") {
                continue;
            }
            let file = folder.join(path);
            if !file.exists() || path.ends_with("live.html") {
                wrong.push(format!("{name}: {target} is not there"));
            }
            let Some((_, drawing)) = path.split_once("figures/") else { continue };
            if let Some((report, drawing)) = drawing.split_once('/') {
                seen[0] += 1;
                let of = docs().join("../reports").join(report).join("figures").join(drawing);
                if std::fs::read(&file).ok() != std::fs::read(&of).ok() {
                    wrong.push(format!(
                        "{name}: {target} is not that of the report; run docs/build"
                    ));
                }
            }
        }
        for one in shown.captures_iter(&text) {
            let file = std::fs::read_to_string(folder.join(&one[1])).expect("a file");
            let before = one.get(2).map_or(1, |line| line.as_str().parse().expect("a number")) - 1;
            let lines: Vec<&str> = file.lines().skip(before).collect();
            seen[1] += 1;
            if lines.join("\n") != one[3] {
                wrong.push(format!("{name}: {} is not as it is shown", &one[1]));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(seen[0] >= 40 && seen[1] == 5, "{seen:?} drawings and files");
}

fn quoted(file: &str, words: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{file}: {error}"));
    let lines = text.lines().skip_while(|line| !line.contains(words));
    let lines: Vec<&str> = lines.take_while(|line| !line.is_empty()).collect();
    assert!(!lines.is_empty(), "{file} has no line with `{words}`");
    let link = Regex::new(r"\[([^\]]*)\]\([^)]*\)").expect("a pattern");
    link.replace_all(&(lines.join("\n") + "\n"), "$1").into_owned()
}

#[test]
fn what_is_quoted_from_reports_stands_there() {
    let _turn = turn();
    let mark =
        Regex::new(r"(?s)<!-- lines: (\S+) (.*?) -->\n\n(.*?)\n?<!-- end -->").expect("a pattern");
    for (name, text) in pages() {
        let mut page = text.clone();
        for found in mark.captures_iter(&text) {
            let lines = quoted(&found[1], &found[2]);
            let wanted =
                format!("<!-- lines: {} {} -->\n\n{lines}\n<!-- end -->", &found[1], &found[2]);
            if overwrites() {
                page = page.replace(&found[0], &wanted);
            } else {
                assert!(found[0] == wanted, "{name}: SNAPSHOTS=overwrite writes\n{wanted}");
            }
        }
        if page != text {
            write_page(&name, &page);
        }
    }
}
