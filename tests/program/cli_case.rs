//! The commands around case files, run as a person runs them.

use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Output, Stdio};

use assert_cmd::Command;
use vinesink::case::Case;

fn run_in(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::cargo_bin("vinesink").expect("the program");
    command.current_dir(folder).args(arguments).output().expect("it runs")
}

fn run(arguments: &[&str]) -> Output {
    run_in(Path::new("."), arguments)
}

#[track_caller]
fn ends_with_code(output: &Output, code: i32) {
    assert_eq!(output.status.code(), Some(code), "{}", text(&output.stderr));
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

fn names_in(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> = entries
        .map(|entry| entry.expect("an entry").file_name().into_string().expect("UTF-8"))
        .collect();
    names.sort();
    names
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

#[test]
fn new_writes_a_case_that_parses() {
    let folder = folder();
    for (name, file) in [("damper", "damper.toml"), ("a.toml", "a.toml"), ("8.5hz", "8.5hz.toml")] {
        let output = run_in(folder.path(), &["new", name]);
        ends_with_code(&output, 0);
        assert_eq!(text(&output.stdout), format!("{file}\n"));
        assert_eq!(text(&output.stderr), "");
        let written = fs::read_to_string(folder.path().join(file)).expect("the file");
        let case = Case::parse(file, &written).expect("a valid case");
        assert_eq!(case.title, file.trim_end_matches(".toml"));
    }
    assert_eq!(names_in(folder.path()), ["8.5hz.toml", "a.toml", "damper.toml"]);
}

#[test]
fn new_writes_under_a_path() {
    let folder = folder();
    fs::create_dir(folder.path().join("cases")).expect("a folder");
    ends_with_code(&run_in(folder.path(), &["new", "cases/bridge"]), 0);
    assert_eq!(names_in(&folder.path().join("cases")), ["bridge.toml"]);
}

#[cfg(unix)]
#[test]
fn new_files_can_be_read_by_whoever_may_read_others() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder();
    ends_with_code(&run_in(folder.path(), &["new", "damper"]), 0);
    fs::write(folder.path().join("other"), "").expect("a file");
    let mode = |name| {
        let metadata = fs::metadata(folder.path().join(name)).expect("a file");
        metadata.permissions().mode()
    };
    assert_eq!(mode("damper.toml"), mode("other"));
}

#[test]
fn new_refuses_to_overwrite() {
    let folder = folder();
    fs::write(folder.path().join("damper.toml"), "mine").expect("a file");
    let output = run_in(folder.path(), &["new", "damper"]);
    ends_with_code(&output, 2);
    assert_eq!(text(&output.stdout), "");
    assert!(text(&output.stderr).contains("damper.toml exists already and is left as it is"));
    let kept = fs::read_to_string(folder.path().join("damper.toml")).expect("the file");
    assert_eq!(kept, "mine");
    assert_eq!(names_in(folder.path()), ["damper.toml"]);
}

#[test]
fn new_leaves_nothing_behind_when_it_cannot_write() {
    let folder = folder();
    let output = run_in(folder.path(), &["new", "missing/damper"]);
    ends_with_code(&output, 2);
    assert!(text(&output.stderr).contains("cannot write missing/damper.toml"));
    assert_eq!(names_in(folder.path()), [""; 0]);
    for name in ["", "..", "/"] {
        let output = run_in(folder.path(), &["new", name]);
        ends_with_code(&output, 2);
        assert!(!text(&output.stderr).contains("panicked"), "{name:?}");
    }
    assert_eq!(names_in(folder.path()), [""; 0]);
}

#[test]
fn schema_prints_one_json_document() {
    let output = run(&["schema"]);
    ends_with_code(&output, 0);
    let printed: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(printed, vinesink::case::schema());
    assert_eq!(text(&output.stderr), "");
}

#[test]
fn completions_print_a_script_for_each_shell() {
    for (shell, mark) in
        [("bash", "complete -F"), ("zsh", "#compdef vinesink"), ("fish", "complete -c vinesink")]
    {
        let output = run(&["completions", shell]);
        ends_with_code(&output, 0);
        let script = text(&output.stdout);
        assert!(script.contains(mark) && script.contains("schema"), "{shell}");
    }
    ends_with_code(&run(&["completions", "tcl"]), 2);
}

/// One page for the program and one for each command that its help lists.
#[test]
fn every_command_has_a_manual_page() {
    let folder = folder();
    let output = run_in(folder.path(), &["manual", "share/man1"]);
    ends_with_code(&output, 0);
    let help = text(&run(&["--help"]).stdout);
    let listed = help.lines().skip_while(|line| *line != "Commands:");
    let listed = listed.skip(1).take_while(|line| !line.is_empty());
    let mut names: Vec<String> = listed
        .filter_map(|line| line.strip_prefix("  ")?.split_once(' '))
        .filter(|(name, _)| !name.is_empty() && *name != "help")
        .map(|(name, _)| format!("vinesink-{name}.1"))
        .chain(["vinesink.1".to_owned()])
        .collect();
    names.sort();
    let pages = folder.path().join("share/man1");
    assert_eq!(names_in(&pages), names);
    let page = fs::read_to_string(pages.join("vinesink-report.1")).expect("written");
    for mark in [".TH vinesink-report 1", ".SH OPTIONS", "Examples:", "reports"] {
        assert!(page.contains(mark), "{mark}");
    }
}

#[test]
fn usage_errors_are_2_and_help_is_0() {
    for arguments in [&[][..], &["nonsense"], &["new"], &["schema", "extra"]] {
        let output = run(arguments);
        ends_with_code(&output, 2);
        assert_eq!(text(&output.stdout), "", "{arguments:?}");
        assert!(text(&output.stderr).contains("Usage: vinesink"), "{arguments:?}");
    }
    for arguments in [&["--help"][..], &["new", "--help"], &["help", "schema"], &["--version"]] {
        let output = run(arguments);
        ends_with_code(&output, 0);
        assert!(!output.stdout.is_empty(), "{arguments:?}");
    }
    assert!(text(&run(&["new", "--help"]).stdout).contains("Examples:"));
}

#[test]
fn errors_have_no_colours_off_a_terminal() {
    let folder = folder();
    let output = run_in(folder.path(), &["new", "missing/damper"]);
    assert!(!output.stderr.contains(&0x1b), "{}", text(&output.stderr));
}

/// A reader that goes away before everything is written, such as `head`, is no failure.
#[test]
fn a_closed_pipe_is_not_a_panic() {
    let program = assert_cmd::cargo::cargo_bin("vinesink");
    let mut child = std::process::Command::new(program)
        .args(["completions", "zsh"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it runs");
    drop(child.stdout.take());
    let mut complaints = String::new();
    child.stderr.take().expect("a pipe").read_to_string(&mut complaints).expect("UTF-8");
    assert_eq!((complaints.as_str(), child.wait().expect("it ends").code()), ("", Some(0)));
}
