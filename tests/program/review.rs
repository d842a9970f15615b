//! Reviews of committed reports: revisions read through git, the script and the workflow for pull
//! requests, run for real in repositories that are made here. The truth is the change that was made.

use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

use tempfile::TempDir;

/// A case that is simulated in a moment.
const CASE: &str = "\
title = \"Damper\"
source = \"made up\"

[reduced]
mass_ratio = 0.0077
damping = 1.8
restitution = 0.6
clearance = 1.0
forcing = 2.0
frequency_ratio = 1.0

[simulation]
starts = 2
periods = 50
discard = 50
";

/// A repository with a report on `main` and another clearance on `wider`, which is checked out.
struct Repository {
    folder: TempDir,
    /// Programs that come before all others.
    bin: TempDir,
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

fn executable(path: &Path, content: &str) {
    fs::write(path, content).expect("written");
    fs::set_permissions(path, fs::Permissions::from_mode(0o755)).expect("executable");
}

/// The repository of all tests; each works on its own copy.
static TEMPLATE: OnceLock<Repository> = OnceLock::new();

impl Repository {
    fn new() -> Self {
        let template = TEMPLATE.get_or_init(Self::make);
        let repository = Self {
            folder: tempfile::tempdir().expect("a folder"),
            bin: tempfile::tempdir().expect("a folder"),
        };
        for (from, to) in [(&template.folder, &repository.folder), (&template.bin, &repository.bin)]
        {
            let mut copy = Command::new("cp");
            copy.arg("-R").arg(from.path().join(".")).arg(to.path());
            assert!(copy.status().expect("it runs").success());
        }
        repository
    }

    fn make() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let bin = tempfile::tempdir().expect("a folder");
        let repository = Self { folder, bin };
        // Where a test wants it, `check` answers so; everything else is the program itself.
        executable(
            &repository.bin.path().join("vinesink"),
            &format!(
                "#!/bin/sh\nif [ \"$1\" = check ] && [ -n \"$CHECK\" ]; then echo \"checked $*\"; exit \"$CHECK\"; fi\nexec '{}' \"$@\"\n",
                env!("CARGO_BIN_EXE_vinesink")
            ),
        );
        repository.git(&["init", "--quiet", "--initial-branch", "main"]);
        repository.git(&["config", "user.name", "Somebody"]);
        repository.git(&["config", "user.email", "somebody@example.org"]);
        repository.write("cases/damper.toml", CASE);
        repository.report();
        repository.commit("A damper");
        repository.git(&["switch", "--quiet", "--create", "wider"]);
        repository.write("cases/damper.toml", &CASE.replace("clearance = 1.0", "clearance = 1.1"));
        repository.report();
        repository.commit("A wider clearance");
        repository
    }

    fn path(&self) -> &Path {
        self.folder.path()
    }

    fn write(&self, file: &str, content: &str) {
        let path = self.path().join(file);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, content).expect("written");
    }

    fn run(&self, program: &str, arguments: &[&str], variables: &[(&str, &str)]) -> Output {
        let path = std::env::var("PATH").expect("a PATH");
        let mut command = Command::new(program);
        command.current_dir(self.path()).args(arguments);
        command.env("PATH", format!("{}:{path}", self.bin.path().display()));
        // Nobody's own settings.
        command.env("GIT_CONFIG_GLOBAL", "/dev/null").env("GIT_CONFIG_SYSTEM", "/dev/null");
        command.envs(variables.iter().copied());
        command.output().expect("it runs")
    }

    fn git(&self, arguments: &[&str]) -> String {
        let output = self.run("git", arguments, &[]);
        assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
        text(&output.stdout).trim().to_owned()
    }

    fn commit(&self, message: &str) {
        self.git(&["add", "--all"]);
        self.git(&["commit", "--quiet", "--message", message]);
    }

    fn report(&self) {
        let output = self.run("vinesink", &["report", "cases/damper.toml"], &[]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        // As in a repository that leaves the web page out.
        fs::remove_file(self.path().join("reports/damper/report.html")).expect("a page");
    }

    #[track_caller]
    fn diff(&self, arguments: &[&str], code: i32) -> String {
        let output = self.run("vinesink", &[&["diff"], arguments].concat(), &[]);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {message}");
        assert!(!message.contains("panicked"), "{message}");
        let words = message.split(['\n', '│', ' ']).filter(|word| !word.is_empty());
        if code == 2 { words.collect::<Vec<_>>().join(" ") } else { text(&output.stdout) }
    }

    /// Runs the script of `examples/`; the comment that it wrote, and its exit code.
    #[track_caller]
    fn review(&self, base: &str, variables: &[(&str, &str)], code: i32) -> (String, Output) {
        let script = root().join("examples/ci/review-reports.sh");
        let script = script.to_str().expect("UTF-8");
        let output = self.run("bash", &[script, base], variables);
        assert_eq!(output.status.code(), Some(code), "{}", text(&output.stderr));
        let review = fs::read_to_string(self.path().join("review.md")).unwrap_or_default();
        (review, output)
    }
}

const CHANGED: &str = "| Reduced clearance | 1.0 | 1.1 |";

#[test]
fn revisions_are_read_without_a_checkout() {
    let repository = Repository::new();
    let before = repository.git(&["status", "--porcelain"]);
    let printed = repository.diff(&["main", "HEAD"], 1);
    assert!(printed.starts_with("## 1 of 1 report changed"), "{printed}");
    assert!(printed.contains(CHANGED), "{printed}");
    // Without an address, figures are named.
    assert!(printed.contains("<code>map</code>") && !printed.contains("<img"), "{printed}");
    assert_eq!(
        repository.diff(&["wider", "HEAD"], 0),
        "No change: 1 report is the same within their errors.\nChecked against their cases: 1 of 1 report.\n"
    );
    // A revision against the working folder, a folder of a revision, a single report.
    assert!(repository.diff(&["main", "reports"], 1).contains(CHANGED));
    assert!(repository.diff(&["main:reports", "wider:reports"], 1).contains(CHANGED));
    let one = repository.diff(&["main", "wider", "--path", "reports/damper"], 1);
    assert!(one.contains(CHANGED), "{one}");
    assert!(repository.diff(&["main", "wider", "--path", "."], 1).contains(CHANGED));
    assert_eq!(repository.git(&["status", "--porcelain"]), before);
    // Below the root, folders are those that are seen from there.
    let mut command = Command::new(env!("CARGO_BIN_EXE_vinesink"));
    command.args(["diff", "main", "HEAD", "--path", "../reports"]);
    let output = command.current_dir(repository.path().join("cases")).output().expect("it runs");
    assert!(text(&output.stdout).contains(CHANGED), "{}", text(&output.stderr));
}

/// A case that was committed without its report: the revision's own case counts, not the working folder's.
#[test]
fn a_revision_whose_report_is_out_of_date_is_named() {
    let repository = Repository::new();
    repository.write("cases/damper.toml", &CASE.replace("clearance = 1.0", "clearance = 1.2"));
    // Of the working folder alone.
    repository.diff(&["wider", "HEAD"], 0);
    let printed = repository.diff(&["HEAD", "reports"], 1);
    assert!(printed.contains("`reports/damper/report.json` was made from another"), "{printed}");
    repository.commit("A clearance without its report");
    let printed = repository.diff(&["wider~1", "HEAD"], 1);
    for part in [
        "`HEAD:./reports/damper/report.json` was made from another text of `HEAD:./cases/damper.toml`",
        "run `vinesink report cases/damper.toml --out reports` in a checkout of `HEAD`.",
    ] {
        assert!(printed.contains(part), "{part}\n{printed}");
    }
    // The same from the root, from a folder below, and with the cases named.
    assert!(repository.diff(&["main:reports", "wider:reports"], 1).contains("`wider:cases/damper"));
    let named = ["main", "HEAD", "--cases", "cases"];
    assert!(repository.diff(&named, 1).contains("`HEAD:./cases/damper.toml`"));
    let mut command = Command::new(env!("CARGO_BIN_EXE_vinesink"));
    command.args(["diff", "main", "HEAD", "--path", "../reports"]);
    let output = command.current_dir(repository.path().join("cases")).output().expect("it runs");
    let printed = text(&output.stdout);
    assert!(printed.contains("`HEAD:./../cases/damper.toml`"), "{printed}");
}

#[test]
fn what_git_cannot_read_is_told() {
    let repository = Repository::new();
    let unknown = repository.diff(&["mian", "HEAD"], 2);
    assert!(unknown.contains("`mian` is neither a file or folder nor a revision"), "{unknown}");
    assert!(unknown.contains("unshallow"), "{unknown}");
    let nowhere = repository.diff(&["main", "HEAD", "--path", "nowhere"], 2);
    assert!(nowhere.contains("no report.json in `nowhere` at `main`"), "{nowhere}");
    let file = repository.diff(&["main", "HEAD", "--path", "cases/damper.toml"], 2);
    assert!(file.contains("no report.json"), "{file}");
    let binary = env!("CARGO_BIN_EXE_vinesink");
    let refused = |folder: &Path, path: &str| {
        let mut command = Command::new(binary);
        command.args(["diff", "main", "HEAD"]).current_dir(folder).env("PATH", path);
        // A repository around the temporary folder is none of ours.
        command.env("GIT_CEILING_DIRECTORIES", folder.parent().expect("a folder"));
        let output = command.output().expect("it runs");
        assert_eq!(output.status.code(), Some(2));
        text(&output.stderr)
            .split(['\n', '│', ' '])
            .filter(|word| !word.is_empty())
            .collect::<Vec<_>>()
            .join(" ")
    };
    let outside = tempfile::tempdir().expect("a folder");
    let path = std::env::var("PATH").expect("a PATH");
    let none = refused(outside.path(), &path);
    assert!(none.contains("git knows no revisions here: not a git repository"), "{none}");
    let without = refused(repository.path(), outside.path().to_str().expect("UTF-8"));
    assert!(without.contains("git") && without.contains("cannot be run"), "{without}");
}

#[test]
fn a_report_is_checked_and_nothing_is_written() {
    let repository = Repository::new();
    let check = |code: i32| {
        let arguments = ["report", "--check", "cases/damper.toml"];
        let output = repository.run("vinesink", &arguments, &[]);
        assert_eq!(output.status.code(), Some(code), "{}", text(&output.stderr));
        text(&output.stdout)
    };
    assert_eq!(check(0), "");
    repository.write("reports/damper/figures/old.svg", "<svg/>");
    repository.write("reports/damper/figures/tradeoff.svg", "<svg/>");
    repository.write("reports/damper/figures/map.svg", "<svg/>");
    fs::remove_file(repository.path().join("reports/damper/report.md")).expect("removed");
    let before = repository.git(&["status", "--porcelain"]);
    assert_eq!(
        check(1),
        "reports/damper/figures/map.svg: is not up to date\n\
         reports/damper/figures/old.svg: is no longer part of the report\n\
         reports/damper/report.md: is missing\n"
    );
    assert_eq!(repository.git(&["status", "--porcelain"]), before);
    fs::remove_dir_all(repository.path().join("reports")).expect("removed");
    assert_eq!(check(1), "reports/damper: there is no report\n");
    assert!(!repository.path().join("reports").exists());
    repository.write("cases/damper.toml", "title = 3\n");
    assert_eq!(check(2), "");
}

/// What other commands and people put beside a report stays when it is written again, and is not taken for
/// a part of it; figures that it no longer has go.
#[test]
fn a_report_written_again_keeps_what_is_not_its_own() {
    let repository = Repository::new();
    let out = ["--out", "reports"];
    for command in ["tradeoff", "optimize"] {
        let arguments = [[command, "cases/damper.toml"], out].concat();
        let output = repository.run("vinesink", &arguments, &[]);
        assert!(output.status.code().is_some_and(|code| code < 2), "{}", text(&output.stderr));
    }
    repository.write("reports/damper/measured.csv", "1,2\n");
    let files = || {
        let listed = repository.git(&["status", "--porcelain", "--untracked-files=all"]);
        let mut files: Vec<String> =
            listed.lines().map(|line| line.trim_start_matches("?? ").to_owned()).collect();
        files.retain(|file| !file.ends_with("report.html"));
        files
            .into_iter()
            .map(|file| (fs::read(repository.path().join(&file)).ok(), file))
            .collect::<Vec<_>>()
    };
    let before = files();
    let names: Vec<&str> = before.iter().map(|(_, file)| file.as_str()).collect();
    for name in ["tradeoff.md", "figures/tradeoff.svg", "optimize.md", "measured.csv"] {
        assert!(names.contains(&format!("reports/damper/{name}").as_str()), "{name}: {names:?}");
    }
    assert!(names.iter().filter(|name| name.contains("figures/optimize-")).count() > 0);
    let report = |more: &[&str]| {
        let arguments = [&["report", "cases/damper.toml"], more].concat();
        let output = repository.run("vinesink", &arguments, &[]);
        (output.status.code(), text(&output.stdout))
    };
    assert_eq!(report(&["--check"]), (Some(0), String::new()));
    repository.write("reports/damper/figures/old.svg", "<svg/>");
    assert_eq!(report(&[]).0, Some(0));
    assert_eq!(files(), before);
    assert_eq!(report(&["--check"]), (Some(0), String::new()));
}

#[test]
fn the_script_reviews_a_branch() {
    let repository = Repository::new();
    // A change on the base after the branch was made is not the branch's.
    repository.git(&["switch", "--quiet", "main"]);
    repository.write("cases/damper.toml", &CASE.replace("restitution = 0.6", "restitution = 0.7"));
    repository.report();
    repository.commit("Another restitution");
    repository.git(&["switch", "--quiet", "wider"]);
    let url = "https://forge.example/raw";
    let (review, output) = repository.review("main", &[("RAW_URL", url), ("CHECK", "0")], 0);
    assert!(review.starts_with("<!-- vinesink-review -->\n## 1 of 1 report changed"), "{review}");
    assert!(review.contains(CHANGED) && !review.contains("estitution |"), "{review}");
    let [base, head] = ["main~1", "HEAD"].map(|revision| repository.git(&["rev-parse", revision]));
    for commit in [base, head] {
        let image = format!("<img src=\"{url}/{commit}/reports/damper/figures/map.svg\"");
        assert!(review.contains(&image), "{image}\n{review}");
    }
    assert_eq!(text(&output.stdout), "checked check --format text -- cases/damper.toml\n");
    assert_eq!(repository.git(&["status", "--porcelain"]), "?? review.md");

    let (review, _) = repository.review("main", &[("CHECK", "1")], 1);
    assert!(review.contains("**A criterion fails**") && review.contains(CHANGED), "{review}");
    repository.review("main", &[("CHECK", "2")], 2);
    repository.review("nowhere", &[], 2);
}

/// The first pull request of a repository: no reports on the base, or none at all; no cases; no history.
#[test]
fn the_script_reviews_the_first_reports() {
    let repository = Repository::new();
    repository.git(&["switch", "--quiet", "main"]);
    repository.git(&["rm", "--quiet", "-r", "reports"]);
    repository.commit("No reports");
    repository.git(&["switch", "--quiet", "--create", "first"]);
    let (review, _) = repository.review("main", &[], 1);
    assert!(review.contains("reports/damper: there is no report"), "{review}");
    assert!(review.contains("1 report added"), "{review}");
    repository.report();
    repository.git(&["add", "reports"]);
    repository.git(&["commit", "--quiet", "--message", "Reports"]);
    let (review, _) = repository.review("main", &[], 0);
    assert!(review.contains("### Reports added") && !review.contains("not up to date"), "{review}");
    // A review that could not be done leaves none of an earlier one.
    let (review, output) = repository.review("nowhere", &[], 2);
    assert_eq!(review, "");
    assert!(text(&output.stderr).contains("fetch the whole history"), "{output:?}");
    fs::remove_dir_all(repository.path().join("cases")).expect("removed");
    let (_, output) = repository.review("main", &[], 2);
    assert!(text(&output.stderr).contains("there is no case"), "{output:?}");
}

/// What the script adds to the longest difference still fits in a comment.
#[test]
fn the_longest_review_fits_in_a_comment() {
    let repository = Repository::new();
    let long = "x".repeat(200);
    let stub = format!(
        "#!/bin/sh\ncase \"$1 $2\" in\n'report --check') for k in $(seq 60); do echo \"reports/${{k}}{long}/figures/transfer-stretches.svg: is no longer part of the report\"; done; exit 1;;\ndiff*) printf '%060000d' 0; exit 1;;\ncheck*) exit 1;;\nesac\n"
    );
    executable(&repository.bin.path().join("vinesink"), &stub);
    let (review, _) = repository.review("main", &[], 1);
    let length = review.chars().count();
    assert!((60_000..65_536).contains(&length), "{length} characters");
    assert!(review.contains("and 45 more"), "{}", &review[..9000]);
}

/// With the program's own `check`: a criterion that held on the base and fails on the branch.
#[test]
fn the_script_tells_of_a_criterion_that_flips() {
    let repository = Repository::new();
    let criteria = "[criteria]\npeak_displacement = \"<= LIMIT\"\n";
    let case = |limit: &str| format!("{CASE}{}", criteria.replace("LIMIT", limit));
    repository.git(&["switch", "--quiet", "main"]);
    repository.write("cases/damper.toml", &case("100.0"));
    repository.report();
    repository.commit("A generous criterion");
    repository.git(&["switch", "--quiet", "--create", "strict"]);
    repository.write("cases/damper.toml", &case("0.001"));
    repository.report();
    repository.commit("A strict one");
    let (review, output) = repository.review("main", &[("CHECK_FORMAT", "github")], 1);
    assert!(text(&output.stdout).starts_with("::error file=cases/damper.toml"), "{output:?}");
    assert!(review.contains("**A criterion fails**"), "{review}");
    assert!(review.contains("1 flipped criterion") && review.contains("| Criterion |"), "{review}");
    repository.git(&["switch", "--quiet", "main"]);
    let (review, _) = repository.review("main", &[], 0);
    assert!(!review.contains("A criterion fails"), "{review}");
}

#[test]
fn the_script_refuses_stale_reports_and_reviews_what_they_should_be() {
    let repository = Repository::new();
    repository.write("cases/damper.toml", &CASE.replace("clearance = 1.0", "clearance = 1.2"));
    repository.commit("A clearance without its report");
    let (review, _) = repository.review("main", &[("RAW_URL", "https://forge.example")], 1);
    assert!(review.contains("**Reports are not up to date**"), "{review}");
    assert!(review.contains("reports/damper/report.md: is not up to date"), "{review}");
    assert!(review.contains("| Reduced clearance | 1.0 | 1.2 |"), "{review}");
    assert_eq!(repository.git(&["status", "--porcelain"]), "?? review.md");
}

/// The commands of a step of the action.
fn step(name: &str) -> String {
    let action = fs::read_to_string(root().join("action.yml")).expect("the action");
    let from = action.find(&format!("- name: {name}\n")).unwrap_or_else(|| panic!("{name}"));
    let step = &action[from..];
    let commands = &step[step.find("run: |\n").expect("commands") + 7..];
    let lines = commands.lines().take_while(|line| line.is_empty() || line.starts_with("        "));
    lines.map(|line| format!("{}\n", line.trim_start_matches("        "))).collect()
}

/// The action's commands, one step after the other, with a `gh` that notes what it is asked.
#[test]
fn the_action_comments_once_and_fails_where_a_criterion_does() {
    let repository = Repository::new();
    executable(
        &repository.bin.path().join("gh"),
        "#!/bin/sh\necho \"$*\" >>gh.log\ncase \"$*\" in *--jq*) printf '%s' \"$EARLIER\";; esac\n",
    );
    let run = |name: &str, variables: &[(&str, &str)]| {
        // As the forge runs it.
        let arguments = ["-e", "-o", "pipefail", "-c", &step(name)];
        repository.run("bash", &arguments, variables)
    };
    let action = root();
    let action = ("GITHUB_ACTION_PATH", action.to_str().expect("UTF-8"));
    assert!(run("Install", &[action]).status.success(), "it is there already");
    // One program has one sum, which a change of a template changes.
    let sum = |of: &str| {
        let output = repository.path().join("sum");
        let place =
            [("GITHUB_ACTION_PATH", of), ("GITHUB_OUTPUT", output.to_str().expect("UTF-8"))];
        let told = run("Version", &place);
        assert!(told.status.success(), "{}", text(&told.stderr));
        let read = fs::read_to_string(&output).expect("written");
        read.lines().last().expect("a line").to_owned()
    };
    let copy = TempDir::new().expect("a folder");
    let sources = ["build.rs", "core/src/lib.rs", "figure/src/lib.rs", "src/lib.rs"];
    for file in ["Cargo.toml", "Cargo.lock", "templates/report.md.tera"].into_iter().chain(sources)
    {
        let to = copy.path().join(file);
        fs::create_dir_all(to.parent().expect("a folder")).expect("made");
        fs::copy(root().join(file), to).expect("copied");
    }
    let place = copy.path().to_str().expect("UTF-8");
    let first = sum(place);
    assert!(first == sum(place) && first.len() == "sum=".len() + 64, "{first}");
    fs::write(copy.path().join("templates/report.md.tera"), "other").expect("written");
    assert_ne!(sum(place), first);
    let files = [("GITHUB_OUTPUT", "output"), ("GITHUB_STEP_SUMMARY", "summary")];
    let review = |check: &str| {
        let more = [
            ("BASE", "main"),
            ("CASES", "cases/*.toml"),
            ("REPORTS", "reports"),
            ("CHECK", check),
            ("CHECK_FORMAT", "github"),
            action,
        ];
        let output = run("Review", &[files.as_slice(), &more].concat());
        assert!(output.status.success(), "{}", text(&output.stderr));
        let read = |file: &str| fs::read_to_string(repository.path().join(file)).expect(file);
        assert!(read("summary").contains(CHANGED), "{}", read("summary"));
        assert!(text(&output.stdout).contains("--format github"));
        read("output").lines().last().expect("a line").to_owned()
    };
    assert_eq!(review("0"), "code=0");
    assert_eq!(review("1"), "code=1");
    let comment = |earlier: &str| {
        let more = [("REPOSITORY", "me/it"), ("PULL_REQUEST", "7"), ("EARLIER", earlier)];
        let output = run("Comment", &more);
        assert!(output.status.success(), "{}", text(&output.stderr));
        let log = fs::read_to_string(repository.path().join("gh.log")).expect("a log");
        log.lines().last().expect("a line").to_owned()
    };
    // An earlier comment is found by the line that the script writes first.
    let review = fs::read_to_string(repository.path().join("review.md")).expect("a review");
    let first = review.lines().next().expect("a line");
    assert!(step("Comment").contains(&format!("startswith(\"{first}\")")), "{first}");
    let body = "--field body=@review.md";
    assert_eq!(comment(""), format!("api --method POST repos/me/it/issues/7/comments {body}"));
    let again = format!("api --method PATCH repos/me/it/issues/comments/42 {body}");
    assert_eq!(comment("42\n43\n"), again);
    assert_eq!(run("Result", &[("CODE", "1")]).status.code(), Some(1));
    assert_eq!(run("Result", &[("CODE", "0")]).status.code(), Some(0));
}

#[test]
fn drawings_are_folded_in_reviews_and_the_report_is_not() {
    let repository = Repository::new();
    fs::copy(root().join(".gitattributes"), repository.path().join(".gitattributes"))
        .expect("copied");
    let attribute = |file: &str| {
        let file = format!("reports/damper/{file}");
        let answer = repository.git(&["check-attr", "linguist-generated", "--", &file]);
        answer.rsplit(' ').next().expect("a word").to_owned()
    };
    assert_eq!(attribute("figures/map.svg"), "set");
    assert_eq!(attribute("report.json"), "set");
    assert_eq!(attribute("report.md"), "unspecified");
}
