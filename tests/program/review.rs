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

    /// Writes the reports of cases, as [`Self::report`].
    fn reports(&self, cases: &[&str]) {
        let output = self.run("vinesink", &[&["report", "--criteria-only"], cases].concat(), &[]);
        assert!(output.status.success(), "{}", text(&output.stderr));
    }

    /// `report --check`: its exit code, what it names and what it counts.
    fn check(&self, cases: &[&str]) -> (Option<i32>, String, String) {
        let arguments = [&["report", "--check", "--criteria-only"], cases].concat();
        let output = self.run("vinesink", &arguments, &[]);
        (output.status.code(), text(&output.stdout), text(&output.stderr))
    }

    fn replace(&self, file: &str, from: &str, to: &str) {
        let content = fs::read_to_string(self.path().join(file)).expect("readable");
        assert!(content.contains(from), "{from} in {content}");
        self.write(file, &content.replacen(from, to, 1));
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

/// A structure whose modes are in a file, under one load.
const SEVERAL: &str = "\
title = \"Mast\"
source = \"made up\"

[modes]
file = \"modes/mast.csv\"

[[absorber]]
place = \"tip\"
mass = \"2.4 kg\"
clearance = \"2.47 mm\"
restitution = 0.17

[[excitation]]
kind = \"force\"
mode = 1
amplitude = \"0.3583 N\"
frequency = \"1.1 Hz\"

[simulation]
starts = 2
";
const MODES: &str = "\
frequency (Hz), damping_ratio (%), mass (kg), tip, middle
1.1, 0.5, 30, 1.0, 0.340
6.894, 0.5, 30, 1.0, -0.714
";

/// A structure under a record.
const UNDER_RECORD: &str = "\
title = \"Tower\"
source = \"made up\"

[reduced]
mass_ratio = 0.0077
damping = 1.8
restitution = 0.6
clearance = 1.0
kind = \"record\"
file = \"quake.csv\"
quantity = \"force\"

[simulation]
starts = 2
";

fn record(scale: f64) -> String {
    let line =
        |k: u32| format!("{},{:.6}\n", 0.25 * f64::from(k), scale * libm::sin(0.2 * f64::from(k)));
    (0..120).fold("time,value\n".to_owned(), |text, k| text + &line(k))
}

/// A repository with the two of them and a third on `main`, in a folder of cases.
fn three_cases(folder: &str) -> (Repository, [String; 3]) {
    let repository = Repository::new();
    repository.git(&["switch", "--quiet", "main"]);
    repository.git(&["rm", "--quiet", "-r", "cases", "reports"]);
    let cases = ["damper", "mast", "tower"].map(|name| format!("{folder}/{name}.toml"));
    for (case, content) in cases.iter().zip([CASE, SEVERAL, UNDER_RECORD]) {
        repository.write(case, content);
    }
    repository.write(&format!("{folder}/modes/mast.csv"), MODES);
    repository.write(&format!("{folder}/quake.csv"), &record(1.0));
    repository.write(".gitignore", "report.html\n");
    repository.reports(&cases.each_ref().map(String::as_str));
    repository.commit("Three designs");
    repository.git(&["switch", "--quiet", "--create", "other"]);
    (repository, cases)
}

/// Keys of a case that are no numbers, and numbers of the file of its modes.
#[test]
fn what_is_no_number_is_an_input_of_a_real_report() {
    let (repository, [damper, mast, _]) = three_cases("cases");
    let more = "\n[criteria]\ncount_inactive = false\npeak_displacement = \"<= 100.0\"\n\n[report]\ndeviations = false\nfigures = [\"areas\"]\n\n[optimize]\nobjective = \"z3-share\"\n";
    repository.write(&damper, &format!("{CASE}{more}"));
    repository.replace(
        "cases/modes/mast.csv",
        "6.894, 0.5, 30, 1.0, -0.714",
        "6.894, 0.5, 30, 0.9, -0.714",
    );
    repository.replace("cases/modes/mast.csv", "1.1, 0.5", "1.1, 0.4");
    repository.reports(&[&damper, &mast]);
    let printed = repository.diff(&["HEAD", "reports"], 1);
    for row in [
        "| Criteria count inactive | – | false |",
        "| Criteria peak displacement | – | <= 100.0 |",
        "| Report deviations | – | false |",
        "| Report figures | – | [\"areas\"] |",
        "| Optimize objective | – | z3-share |",
        "| Mode 1 damping ratio | 0.5 % | 0.4 % |",
        "| Mode 2 shape tip | 1.0 | 0.9 |",
        "| Content of modes/mast.csv | SHA-256 ",
    ] {
        assert!(printed.contains(row), "{row}\n{printed}");
    }
    // The same modes written in the case.
    let own = SEVERAL.replace(
        "[modes]\nfile = \"modes/mast.csv\"\n",
        "[[mode]]\nfrequency = \"1.1 Hz\"\ndamping_ratio = 0.004\nmass = \"30 kg\"\nshape = { tip = 1.0, middle = 0.34 }\n\n[[mode]]\nfrequency = \"6.894 Hz\"\ndamping_ratio = 0.005\nmass = \"30 kg\"\nshape = { tip = 0.9, middle = -0.714 }\n",
    );
    repository.write(&mast, &own);
    repository.reports(&[&mast]);
    repository.commit("Modes in the case");
    repository.write(
        &mast,
        &own.replace("tip = 0.9", "tip = 0.8")
            .replace("damping_ratio = 0.004", "damping_ratio = 0.003"),
    );
    repository.reports(&[&mast]);
    let printed = repository.diff(&["HEAD", "reports"], 1);
    for row in ["| Mode 1 damping ratio | 0.004 | 0.003 |", "| Mode 2 shape tip | 0.9 | 0.8 |"] {
        assert_eq!(printed.matches(row).count(), 1, "{row}\n{printed}");
    }
}

/// The numbers of a record or of a file of modes changed and nobody wrote the report anew: in the working folder, and in a
/// revision, whose own file counts.
#[test]
fn a_report_is_held_to_the_files_that_its_case_reads() {
    let (repository, cases) = three_cases("cases");
    let all = cases.each_ref().map(String::as_str);
    assert!(
        repository.diff(&["main", "reports"], 0).contains("Checked against their cases: 3 of 3")
    );
    repository.write("cases/quake.csv", &record(1.5));
    let named = repository.diff(&["main", "reports"], 1);
    let line = "- `reports/tower/report.json` was made from another text of `quake.csv`, which `cases/tower.toml` reads (SHA-256 ";
    assert!(
        named.contains(line)
            && named.contains("run `vinesink report cases/tower.toml --out reports`."),
        "{named}"
    );
    // Not of the revision that has the file as it was.
    repository.diff(&["main", "HEAD"], 0);
    repository.commit("Another record");
    repository.replace("cases/modes/mast.csv", "0.340", "0.341");
    repository.commit("Another mode");
    let named = repository.diff(&["main", "HEAD"], 1);
    for (report, file) in [("tower", "quake.csv"), ("mast", "modes/mast.csv")] {
        let line = format!(
            "`HEAD:./reports/{report}/report.json` was made from another text of `{file}`, which `HEAD:./cases/{report}.toml` reads"
        );
        assert!(named.contains(&line), "{line}\n{named}");
    }
    assert!(named.starts_with("## 2 reports out of date"), "{named}");
    assert_eq!(repository.check(&all).0, Some(1));
    fs::remove_file(repository.path().join("cases/quake.csv")).expect("removed");
    assert!(
        repository.diff(&["main", "reports"], 1).contains("the file is not there, or outside"),
        "gone"
    );
    repository.git(&["restore", "cases"]);
    // Written anew, it is an input that changed.
    repository.reports(&all[1..]);
    repository.commit("Reports");
    let told = repository.diff(&["main", "HEAD"], 1);
    assert!(!told.contains("Out of date"), "{told}");
    for row in ["| Content of quake.csv | SHA-256 ", "| Mode 1 shape middle | 0.34 | 0.341 |"] {
        assert!(told.contains(row), "{row}\n{told}");
    }
    assert_eq!(
        repository.check(&all),
        (Some(0), String::new(), "3 cases compared with 3 reports in reports\n".to_owned())
    );
}

/// Cases in a folder of any name; a case that is gone, has another name, or came without a report.
#[test]
fn cases_and_reports_that_lost_each_other_are_named() {
    for folder in ["designs", "a/deep/folder"] {
        let (repository, cases) = three_cases(folder);
        let [damper, mast, tower] = cases.each_ref().map(String::as_str);
        let all = repository.diff(&["main", "HEAD"], 0);
        assert!(all.contains("Checked against their cases: 3 of 3 reports."), "{folder}: {all}");
        // Reports that are elsewhere are of the cases here, in whatever folder these are.
        let elsewhere = TempDir::new().expect("a folder");
        let out = elsewhere.path().to_str().expect("text");
        repository.write("cases/mast.toml", CASE);
        for (program, arguments) in
            [("cp", &["-r", "reports/.", out][..]), ("vinesink", &["index", out])]
        {
            assert!(repository.run(program, arguments, &[]).status.success());
        }
        let index = fs::read_to_string(elsewhere.path().join("README.md")).expect("an index");
        assert!(!index.contains("gone"), "{folder}: {index}");
        fs::remove_dir_all(repository.path().join("cases")).expect("removed");
        // Changed, and not reported.
        repository.replace(damper, "clearance = 1.0", "clearance = 1.3");
        let named = repository.diff(&["main", "reports"], 1);
        assert!(
            named.contains(&format!("was made from another text of `{damper}`")),
            "{folder}: {named}"
        );
        repository.commit("A clearance");
        let named = repository.diff(&["main", "HEAD"], 1);
        assert!(
            named.contains(&format!("was made from another text of `HEAD:./{damper}`")),
            "{folder}: {named}"
        );
        // A copy of before hides nothing.
        repository.write("a/archive/damper.toml", CASE);
        repository.commit("A copy");
        for arguments in [["main", "HEAD"], ["main", "reports"]] {
            let named = repository.diff(&arguments, 1);
            assert!(
                named.contains("report.json` was made from another text of"),
                "{folder}: {named}"
            );
        }
        repository.git(&["reset", "--quiet", "--hard", "main"]);
        // Deleted.
        repository.git(&["rm", "--quiet", damper]);
        repository.commit("No damper");
        let named = repository.diff(&["main", "HEAD"], 1);
        let line = "- `HEAD:./reports/damper/report.json` has no case, there is no `damper.toml`: remove its folder, or restore the case";
        assert!(named.contains(line), "{folder}: {named}");
        assert!(
            repository
                .diff(&["main", "reports"], 1)
                .contains("- `reports/damper/report.json` has no case"),
            "{folder}"
        );
        let gone = "reports/damper: its case damper.toml is gone; remove the folder\n";
        assert_eq!(
            repository.check(&[mast, tower]),
            (Some(1), gone.to_owned(), "2 cases compared with 3 reports in reports\n".to_owned())
        );
        assert!(repository.run("vinesink", &["index"], &[]).status.success());
        let index =
            fs::read_to_string(repository.path().join("reports/README.md")).expect("an index");
        let row = |name: &str| {
            index
                .lines()
                .find(|line| line.starts_with(&format!("| [{name}]")))
                .expect(name)
                .to_owned()
        };
        assert!(
            row("damper").contains("**its case is gone**") && !row("mast").contains("gone"),
            "{index}"
        );
        if folder != "designs" {
            continue;
        }
        // Another name, with the report or without.
        repository.git(&["reset", "--quiet", "--hard", "main"]);
        let shaker = format!("{folder}/shaker.toml");
        repository.git(&["mv", damper, &shaker]);
        repository.commit("A shaker");
        let named = repository.diff(&["main", "HEAD"], 1);
        let line = format!(
            "`HEAD:./reports/damper/report.json` is of a case that is now called `HEAD:./{shaker}`: remove its folder and run `vinesink report {shaker} --out reports`"
        );
        assert!(named.contains(&line), "{folder}: {named}");
        let (code, printed, _) = repository.check(&[&shaker, mast, tower]);
        assert_eq!(code, Some(1));
        assert!(
            printed.contains(&format!(
                "reports/damper: its case is now called {shaker}; remove the folder"
            )),
            "{printed}"
        );
        repository.git(&["rm", "--quiet", "-r", "reports/damper"]);
        repository.replace(&shaker, "restitution = 0.6", "restitution = 0.5");
        fs::remove_dir_all(repository.path().join("reports/damper")).unwrap_or_default();
        repository.reports(&[&shaker]);
        repository.commit("Its report");
        let paired = repository.diff(&["main", "HEAD"], 1);
        for part in [
            "### shaker: Damper",
            "> Compared with `damper`, which is no longer there",
            "| Reduced restitution | 0.6 | 0.5 |",
            "Checked against their cases: 3 of 3",
        ] {
            assert!(paired.contains(part), "{folder}: {part}\n{paired}");
        }
        assert!(
            !paired.contains("Out of date") && !paired.contains("### Reports"),
            "{folder}: {paired}"
        );
        // A new one without a report.
        repository.write(
            &format!("{folder}/fresh.toml"),
            &CASE.replace("restitution = 0.6", "restitution = 0.9"),
        );
        repository.commit("A fresh one");
        let named = repository.diff(&["main", "HEAD"], 1);
        let line = format!(
            "- `HEAD:./{folder}/fresh.toml` came or changed, and has no report: run `vinesink report {folder}/fresh.toml --out reports`"
        );
        assert!(named.contains(&line), "{folder}: {named}");
    }
}

/// A checkout that ends lines with a carriage return has the same cases, records and figures.
#[test]
fn line_ends_of_a_checkout_are_no_change() {
    let (repository, cases) = three_cases("cases");
    let all = cases.each_ref().map(String::as_str);
    fn carriage_returns(folder: &Path) {
        for entry in fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                carriage_returns(&path);
            } else {
                let content = fs::read_to_string(&path).expect("text");
                fs::write(&path, content.replace('\n', "\r\n")).expect("written");
            }
        }
    }
    for folder in ["cases", "reports"] {
        carriage_returns(&repository.path().join(folder));
    }
    let same = repository.diff(&["main", "reports"], 0);
    assert_eq!(
        same,
        "No change: 3 reports are the same within their errors.\nChecked against their cases: 3 of 3 reports.\n"
    );
    assert_eq!(repository.check(&all).0, Some(0));
    // As git does it.
    repository.git(&["restore", "cases", "reports"]);
    repository.git(&["config", "core.autocrlf", "true"]);
    repository.git(&["rm", "--quiet", "--cached", "-r", "."]);
    repository.git(&["reset", "--quiet", "--hard"]);
    let case = fs::read_to_string(repository.path().join(&cases[0])).expect("a case");
    assert!(case.contains("\r\n"), "{case:?}");
    repository.diff(&["main", "reports"], 0);
    assert_eq!(repository.check(&all).0, Some(0));
    // Written there, it is the report of everybody, with the digest of before.
    repository.reports(&all);
    repository.git(&["config", "core.autocrlf", "false"]);
    let json =
        fs::read_to_string(repository.path().join("reports/damper/report.json")).expect("a report");
    assert!(json.contains(&vinesink::digest::sha256(CASE.as_bytes())), "{json}");
    // A changed text is one, whatever its line ends.
    repository.write(
        &cases[0],
        &CASE.replace("clearance = 1.0", "clearance = 1.2").replace('\n', "\r\n"),
    );
    assert!(
        repository
            .diff(&["main", "reports"], 1)
            .contains("was made from another text of `cases/damper.toml`")
    );
}

/// What is a folder and a revision is neither until somebody says which.
#[test]
fn a_folder_called_like_a_revision_is_refused() {
    let repository = Repository::new();
    repository.git(&["tag", "v1"]);
    repository.git(&["branch", "designs/x"]);
    for (name, full) in [
        ("main", "refs/heads/main"),
        ("v1", "refs/tags/v1"),
        ("designs/x", "refs/heads/designs/x"),
        ("HEAD", "HEAD^0"),
    ] {
        repository.run("mkdir", &["-p", name], &[]);
        assert!(repository.run("cp", &["-r", "reports/damper", name], &[]).status.success());
        for arguments in [[name, "wider"], ["wider", name]] {
            let message = repository.diff(&arguments, 2);
            assert!(
                message.contains(&format!(
                    "`{name}` is a file or folder here, and a revision that git knows"
                )),
                "{message}"
            );
            assert!(
                message.contains(&format!(
                    "write ./{name} for what is there, or {full} for the revision"
                )),
                "{message}"
            );
        }
        // Both ways that are named are taken.
        repository.diff(&[full, "wider"], i32::from(name == "main"));
        repository.diff(&["wider", &format!("./{name}")], 0);
        fs::remove_dir_all(repository.path().join(name)).expect("removed");
    }
}

/// What others did on the base since is not the branch's.
#[test]
fn a_branch_is_compared_with_where_it_began() {
    let repository = Repository::new();
    repository.git(&["switch", "--quiet", "main"]);
    repository.write("cases/damper.toml", &CASE.replace("restitution = 0.6", "restitution = 0.7"));
    repository.report();
    repository.commit("Another restitution");
    repository.git(&["switch", "--quiet", "wider"]);
    for arguments in
        [&["main...HEAD"][..], &["main..."], &["main...wider"], &["main...", "reports"]]
    {
        let printed = repository.diff(arguments, 1);
        assert!(
            printed.contains(CHANGED) && !printed.contains("estitution |"),
            "{arguments:?}: {printed}"
        );
        assert!(printed.contains("Old: `main..."), "{printed}");
    }
    for arguments in [["main", "HEAD"], ["main", "reports"], ["main:reports", "wider"]] {
        let printed = repository.diff(&arguments, 1);
        assert!(printed.contains("| Reduced restitution | 0.7 | 0.6 |"), "{printed}");
        let [old, new] = arguments;
        assert!(
            printed.contains(&format!(
                "`{old}` has commits that `{new}` lacks: what they changed appears taken back."
            )),
            "{printed}"
        );
    }
    let forward = repository.diff(&["main~1", "HEAD"], 1);
    assert!(!forward.contains("lacks"), "{forward}");
    assert!(repository.diff(&["mian...HEAD"], 2).contains("`mian` is neither a file"));
    assert!(repository.diff(&["main"], 2).contains("there is nothing to compare `main` with"));
}

/// Whether a criterion that fails did so before is said, also where nothing else changed.
#[test]
fn a_criterion_that_failed_before_says_so() {
    let repository = Repository::new();
    let failing = |clearance: &str| {
        let case = CASE.replace("clearance = 1.0", &format!("clearance = {clearance}"));
        format!(
            "{case}\n[criteria]\npeak_displacement = \"<= 0.001\"\nimpact_velocity = \"<= 1e-6\"\n"
        )
    };
    repository.git(&["switch", "--quiet", "main"]);
    repository.write("cases/damper.toml", &failing("1.0"));
    repository.report();
    repository.commit("Strict");
    let same = repository.diff(&["main", "HEAD"], 0);
    assert!(same.contains("Failed before too: `damper` (2 of 2 criteria)."), "{same}");
    repository.write("cases/damper.toml", &failing("1.1"));
    repository.report();
    let printed = repository.diff(&["main", "reports"], 1);
    assert!(
        printed
            .contains("\n> Failed before too: peak displacement ≤ 0.001, impact velocity ≤ 1e-6."),
        "{printed}"
    );
    assert!(printed.contains("| failed before too |") && !printed.contains("flip"), "{printed}");
    let (review, _) = repository.review("main", &[], 1);
    assert!(
        review.contains("**A criterion fails**") && review.contains("Failed before too"),
        "{review}"
    );
}
