//! Files that somebody else has written, in a pull request for instance, do no harm where they are read: nothing
//! outside of their folder is read or quoted, and nothing takes memory or time without bound.

use std::fs;
use std::path::Path;
use std::process::Output;
use std::time::{Duration, Instant};

use assert_cmd::Command;
use tempfile::TempDir;
use vinesink::case::Case;
use vinesink::sweep::{Plan, columns, parquet};

use crate::common;

const TOWER: &str = include_str!("../../cases/tower-record.toml");
const SECRET: &str = "TOKEN=correct-horse";

fn folder() -> TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// The program with a GiB of memory and half a minute: what needs more is killed.
fn bounded(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new("sh");
    let limited = "ulimit -v 1048576; exec \"$0\" \"$@\"";
    command.current_dir(folder).args(["-c", limited, env!("CARGO_BIN_EXE_vinesink")]);
    command.env("RAYON_NUM_THREADS", "2").timeout(Duration::from_secs(30));
    command.args(arguments).output().expect("it runs")
}

/// What it says, frames and line breaks left out, of what it cannot do.
#[track_caller]
fn refused(folder: &Path, arguments: &[&str]) -> String {
    let output = bounded(folder, arguments);
    let said = String::from_utf8(output.stderr).expect("UTF-8");
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
    assert!(output.stdout.is_empty() || arguments[0] == "check", "{arguments:?}");
    said.split(['\n', '│', ' ']).filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
}

fn tower(record: &str) -> String {
    TOWER.replace("tower-record.csv", record)
}

/// Links, for what is read in a folder of its own beside a secret.
#[cfg(unix)]
fn link(to: impl AsRef<Path>, at: impl AsRef<Path>) {
    std::os::unix::fs::symlink(to, at).expect("a link");
}

/// A folder with a secret, and in it the folder of a case.
fn beside_a_secret() -> (TempDir, std::path::PathBuf) {
    let folder = folder();
    fs::write(folder.path().join("secret"), format!("{SECRET}\nuser,password\n")).expect("written");
    let inside = folder.path().join("cases");
    fs::create_dir(&inside).expect("a folder");
    (folder, inside)
}

#[cfg(unix)]
#[test]
fn a_record_is_read_below_the_folder_of_its_case_alone() {
    let (outer, inside) = beside_a_secret();
    let absolute = outer.path().join("secret");
    link("../secret", inside.join("linked.csv"));
    link("..", inside.join("up"));
    let absolute = absolute.to_str().expect("UTF-8");
    let outside = [absolute, "../secret", "linked.csv", "up/secret", "x/../../secret"];
    fs::create_dir(inside.join("x")).expect("a folder");
    for record in outside.into_iter().chain(["/proc/self/environ", "/etc/passwd"]) {
        fs::write(inside.join("tower.toml"), tower(record)).expect("written");
        for command in ["simulate", "check", "optimize", "report", "sweep"] {
            let said = refused(&inside, &[command, "tower.toml"]);
            assert!(said.contains("leads out of the folder"), "{command} {record}: {said}");
            assert!(said.contains("--allow-outside"), "{command} {record}: {said}");
            assert!(!said.contains("TOKEN") && !said.contains("root:"), "{record}: {said}");
        }
        // What is allowed to be read is still no record, and its lines may be anything.
        let said = refused(&inside, &["simulate", "tower.toml", "--allow-outside"]);
        assert!(said.contains("is not a record"), "{record}: {said}");
        assert!(!said.contains("TOKEN") && !said.contains("root:"), "{record}: {said}");
    }
    // Links within the folder, and detours, are no harm.
    let samples = "time (s),acceleration (m/s²)\n0,0\n0.2,0.1\n0.4,0\n";
    fs::write(inside.join("x/quake.csv"), samples).expect("written");
    link("x/quake.csv", inside.join("here.csv"));
    for record in ["here.csv", "x/quake.csv", "x/../here.csv"] {
        fs::write(inside.join("tower.toml"), tower(record)).expect("written");
        let output = bounded(&inside, &["simulate", "tower.toml"]);
        assert_eq!(output.status.code(), Some(0), "{record}: {output:?}");
    }
    fs::write(outer.path().join("quake.csv"), samples).expect("written");
    fs::write(inside.join("tower.toml"), tower("../quake.csv")).expect("written");
    let output = bounded(&inside, &["simulate", "tower.toml", "--allow-outside"]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
}

/// A file of the folder that is no record may hold a secret too, such as `.git/config` beside a case.
#[test]
fn a_file_that_is_no_record_is_not_quoted() {
    let folder = folder();
    for secret in [SECRET, "user,password\nadmin,correct-horse", "[core]\n", ""] {
        for reduced in [false, true] {
            let case = if reduced { REDUCED.to_owned() } else { tower("config") };
            fs::write(folder.path().join("tower.toml"), case).expect("written");
            fs::write(folder.path().join("config"), secret).expect("written");
            for arguments in [["simulate", "tower.toml"], ["check", "tower.toml"]] {
                let output = bounded(folder.path(), &arguments);
                let said = format!("{output:?}");
                assert_eq!(output.status.code(), Some(2), "{secret}: {said}");
                assert!(said.contains("is not a record"), "{secret}: {said}");
                for word in ["TOKEN", "correct-horse", "password", "admin", "core]"] {
                    assert!(!said.contains(word), "{secret}: {said}");
                }
            }
        }
    }
}

const REDUCED: &str = "title = \"t\"\nsource = \"s\"\n[reduced]\nmass_ratio = 0.015\ndamping = 0.5\n\
    restitution = 0.6\nclearance = 1.0\nkind = \"record\"\nquantity = \"force\"\nfile = \"config\"\n";

#[cfg(unix)]
#[test]
fn a_case_that_is_a_link_is_neither_followed_out_of_its_folder_nor_quoted() {
    let (outer, inside) = beside_a_secret();
    for target in ["../secret", "/proc/self/environ", "/etc/passwd"] {
        let at = inside.join("case.toml");
        link(target, &at);
        for command in ["analyze", "check", "report", "sweep", "optimize", "tradeoff"] {
            let said = refused(&inside, &[command, "case.toml"]);
            assert!(said.contains("leads out of the folder"), "{target}: {said}");
            assert!(!said.contains("TOKEN") && !said.contains("root:"), "{target}: {said}");
        }
        fs::remove_file(at).expect("removed");
    }
    // What a link names in the folder, or a folder that is a link, is read and not quoted.
    fs::write(inside.join("config"), format!("{SECRET}\n[core]\n")).expect("written");
    link("config", inside.join("near.toml"));
    fs::create_dir(outer.path().join("home")).expect("a folder");
    fs::write(outer.path().join("home/credentials.toml"), "token = \"correct-horse\"\n")
        .expect("written");
    link("../home", inside.join("more"));
    for case in ["near.toml", "more/credentials.toml"] {
        for command in ["analyze", "check"] {
            let output = bounded(&inside, &[command, case]);
            let said = format!("{output:?}");
            assert_eq!(output.status.code(), Some(2), "{said}");
            assert!(said.contains("is not a case") && said.contains("line 1"), "{said}");
            for word in ["TOKEN", "token", "correct-horse", "core"] {
                assert!(!said.contains(word), "{word}: {said}");
            }
        }
        let said = refused(&inside, &["analyze", case, "--allow-outside"]);
        assert!(said.contains("correct-horse"), "{said}");
    }
    // A case behind a link is read.
    fs::write(outer.path().join("home/good.toml"), common::table_1_case()).expect("written");
    link("../home/good.toml", inside.join("good.toml"));
    refused(&inside, &["analyze", "good.toml"]);
    for arguments in [["good.toml", "--allow-outside"], ["more/good.toml", "--format=json"]] {
        let output = bounded(&inside, &[&["analyze"], arguments.as_slice()].concat());
        assert_eq!(output.status.code(), Some(0), "{output:?}");
    }
}

/// A pipe never ends, a device fills the memory: neither is read, whatever it stands for.
#[test]
fn only_regular_files_of_a_bounded_size_are_read() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let case = common::table_1_case();
    fs::write(at("good.toml"), case).expect("written");
    let output = bounded(folder.path(), &["report", "good.toml", "--fidelity", "manifold"]);
    assert!(output.status.code().is_some_and(|code| code < 2), "{output:?}");
    let pipe = |path: &Path| {
        assert!(std::process::Command::new("mkfifo").arg(path).status().expect("mkfifo").success());
    };
    pipe(&at("pipe"));
    fs::write(at("tower.toml"), tower("pipe")).expect("written");
    link("pipe", at("piped.toml"));
    link("/dev/zero", at("zero.toml"));
    fs::write(at("zero-record.toml"), tower("/dev/zero")).expect("written");
    let too_large = |name: &str, megabytes: usize| {
        fs::write(at(name), vec![b'\n'; (megabytes << 20) + 1]).expect("written");
    };
    too_large("lines.toml", 1);
    too_large("samples.csv", 64);
    fs::write(at("samples.toml"), tower("samples.csv")).expect("written");
    let refusals: [(&[&str], &str); 10] = [
        (&["check", "pipe"], "is no regular file"),
        (&["check", "piped.toml"], "is no regular file"),
        (&["check", "tower.toml"], "is no regular file"),
        (&["check", "zero.toml"], "leads out of the folder"),
        (&["check", "zero.toml", "--allow-outside"], "is no regular file"),
        (&["check", "/dev/zero"], "is no regular file"),
        (&["check", "zero-record.toml", "--allow-outside"], "is no regular file"),
        (&["check", "lines.toml"], "has more than 1 MiB"),
        (&["check", "samples.toml"], "has more than 64 MiB"),
        (&["check", "."], "does not name a file inside a folder"),
    ];
    for (arguments, why) in refusals {
        let said = refused(folder.path(), arguments);
        assert!(said.contains(why), "{arguments:?}: {said}");
    }
    // The same of what diff and the index read.
    let (report, figure) = (at("reports/good/report.json"), at("reports/good/figures/map.svg"));
    let json = fs::read(&report).expect("a report");
    fs::create_dir_all(at("reports/good/figures")).expect("a folder");
    for (file, commands) in [
        (
            &report,
            [&["diff", "reports/good", "reports/good"], &["index", "reports", "--allow-outside"]],
        ),
        (&figure, [&["diff", "reports", "reports"], &["diff", "reports/good", "reports"]]),
    ] {
        for device in ["pipe", "/dev/zero", "/etc/passwd"] {
            let _ = fs::remove_file(file);
            if device == "pipe" {
                pipe(file)
            } else {
                link(device, file)
            }
            for arguments in commands {
                if device == "/etc/passwd" && arguments[0] == "index" {
                    continue;
                }
                let said = bounded(folder.path(), arguments);
                let said = format!("{said:?}");
                let why =
                    ["is no regular file", "leads out of the folder", "there is no report.json"];
                assert!(why.iter().any(|why| said.contains(why)), "{device} {arguments:?}: {said}");
                assert!(!said.contains("root:"), "{device}: {said}");
            }
        }
        let _ = fs::remove_file(file);
        fs::write(&report, &json).expect("written");
    }
    // The case that a report is said to be of is looked at, but is no reason to wait.
    fs::remove_file(at("good.toml")).expect("removed");
    pipe(&at("good.toml"));
    let said = refused(folder.path(), &["diff", "reports", "reports", "--cases", "."]);
    assert!(said.contains("is no regular file"), "{said}");
}

/// Work that would take long is said before it begins, and begun only where that is asked for; the rest is answered.
#[test]
fn no_number_makes_work_without_end() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let case = common::table_1_case();
    let with = |from: &str, to: &str| {
        let text = case.lines().map(|line| if line.starts_with(from) { to } else { line });
        text.map(|line| format!("{line}\n")).collect::<String>()
    };
    let axis = "[sweep]\nclearance = { from = \"5 mm\", to = \"40 mm\", count = 100 }\n";
    for text in [
        with("frequency = ", "frequency = \"1e-30 Hz\""),
        with("frequency = ", "frequency = \"1e-307 Hz\""),
        with("mass = \"4.168 kg\"", "mass = \"1e-308 kg\""),
    ] {
        fs::write(at("slow.toml"), format!("{text}{axis}")).expect("written");
        for arguments in [
            &["analyze", "slow.toml"][..],
            &["simulate", "slow.toml"],
            &["check", "slow.toml"],
            &["sweep", "slow.toml"],
            &["sweep", "slow.toml", "--dry-run"],
            &["sweep", "run", "slow.toml"],
        ] {
            let said = refused(folder.path(), arguments);
            assert!(said.contains("would take about thousands of years"), "{arguments:?}: {said}");
            assert!(said.contains("add --long"), "{arguments:?}: {said}");
        }
    }
    let band = "[band]\nfrom = \"1e-3 Hz\"\nto = \"1e6 Hz\"\n[criteria]\npeak_displacement = \"<= 30 mm\"\n";
    fs::write(at("band.toml"), format!("{case}{band}")).expect("written");
    for command in ["check", "report", "optimize"] {
        let said = refused(folder.path(), &[command, "band.toml"]);
        assert!(said.contains("would take about") && said.contains("add --long"), "{said}");
    }
    // What is begun all the same is not ended by an overflow.
    let mut long = Command::cargo_bin("vinesink").expect("the program");
    long.current_dir(folder.path()).args(["simulate", "slow.toml", "--long"]);
    let output = long.timeout(Duration::from_secs(4)).output().expect("it runs");
    assert_eq!(output.status.code(), None, "{output:?}");
    let map = "[sweep]\nclearance = { from = \"5 mm\", to = \"40 mm\", count = 1000000 }\n\
        frequency = { from = \"8 Hz\", to = \"9 Hz\", count = 1000000 }\n";
    for record in ["", "record = [\"area\", \"theory_peak\"]\n", "follow = \"frequency\"\n"] {
        fs::write(at("map.toml"), format!("{case}{map}{record}")).expect("written");
        let said = refused(folder.path(), &["sweep", "map.toml"]);
        assert!(
            said.contains("would take about") && said.contains("1000000000000 points"),
            "{said}"
        );
        assert!(!at("sweeps/map/chunks").join("000000000.parquet").exists());
        let output = bounded(folder.path(), &["sweep", "map.toml", "--dry-run"]);
        assert_eq!(output.status.code(), Some(0), "{output:?}");
    }
}

/// As many errors as somebody reads, of any number of them, each as long as somebody reads.
#[test]
fn errors_are_few_short_and_told_in_time() {
    errors_are_few_of(3000);
}

#[test]
#[ignore = "deep"]
fn errors_are_few_short_and_told_in_time_of_very_many() {
    errors_are_few_of(20_000);
}

fn errors_are_few_of(wrong_lines: usize) {
    let folder = folder();
    let case = common::table_1_case();
    let at = |name: &str| folder.path().join(name);
    let keys: String = (0..wrong_lines).map(|k| format!("key_{k} = 1\n")).collect();
    let wrong = "a = = 1\n".repeat(wrong_lines);
    for text in [format!("{case}{keys}"), format!("{keys}{case}"), wrong] {
        fs::write(at("case.toml"), text).expect("written");
        let begun = Instant::now();
        let output = bounded(folder.path(), &["check", "case.toml", "--format", "json"]);
        assert!(begun.elapsed() < Duration::from_secs(10), "{:?}", begun.elapsed());
        assert_eq!(output.status.code(), Some(2));
        let said = String::from_utf8(output.stderr).expect("UTF-8");
        assert!(said.matches("case.toml:").count() <= 100, "{}", said.len());
        assert!(said.len() < 200_000 && output.stdout.len() < 200_000, "{}", said.len());
    }
    fs::write(at("case.toml"), format!("{case}{keys}")).expect("written");
    let said = refused(folder.path(), &["analyze", "case.toml"]);
    let told = format!("{wrong_lines} errors, of which 100 are shown");
    assert!(said.contains(&told), "{said}");
    // A text that is not TOML has one error; slips with a remedy have one each.
    for (text, errors) in [
        (
            "#!/bin/sh\nset -e\nfor i in a b c; do\n  echo \"$i\"\ndone\nfoo() { bar; }\n[x\n"
                .to_owned(),
            1,
        ),
        (case.replace("\"20 mm\"", "20 mm").replace("\"8.35 Hz\"", "8.35 Hz"), 2),
    ] {
        fs::write(at("case.toml"), &text).expect("written");
        let output = bounded(folder.path(), &["analyze", "case.toml"]);
        let said = String::from_utf8(output.stderr).expect("UTF-8");
        assert_eq!(said.matches("not valid TOML").count(), errors, "{text}\n{said}");
    }
    let long = "x".repeat(25 * wrong_lines);
    fs::write(at("tower.toml"), tower("long.csv")).expect("written");
    for (file, text) in [
        ("case.toml", case.replace("title = \"", &format!("title = {long} \""))),
        ("case.toml", format!("{case}{long} = 1\n")),
        ("case.toml", case.replace("\"8.35 Hz\"", &format!("\"{long} Hz\""))),
        ("case.toml", case.replace("base-displacement", &long)),
        ("long.csv", format!("time (s),acceleration (m/s²)\n0,0\n{long},{long}{long}\n")),
        ("long.csv", format!("time (s),acceleration (m/s²)\n0,0\n{long}{long}\n")),
        ("long.csv", format!("time (s),acceleration ({long})\n0,0\n")),
        ("long.csv", long.repeat(4)),
    ] {
        fs::write(at(file), text).expect("written");
        for format in ["text", "json", "github", "junit"] {
            let name = if file == "case.toml" { file } else { "tower.toml" };
            let output = bounded(folder.path(), &["check", name, "--format", format]);
            assert_eq!(output.status.code(), Some(2));
            let told = output.stdout.len().max(output.stderr.len());
            assert!(told < 6_000, "{file} {format}: {told}");
            assert!(output.stderr.len() > 100, "{file}");
        }
    }
}

/// Numbers at the end of what a number can be are told with what to do, and none of them is printed as infinite.
#[test]
fn extreme_numbers_are_told_with_what_to_do() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let case = common::table_1_case();
    for mass in [
        "nan",
        "inf",
        "-inf",
        "\"nan kg\"",
        "\"inf kg\"",
        "\"1e400 kg\"",
        "\"1e-400 kg\"",
        "\"1e99999999999 g\"",
    ] {
        fs::write(at("case.toml"), case.replace("\"32 g\"", mass)).expect("written");
        let said = refused(folder.path(), &["analyze", "case.toml"]);
        assert!(said.contains("help: write for example"), "{mass}: {said}");
        assert!(!said.contains("\"nan g\"") && !said.contains("\"inf g\""), "{mass}: {said}");
    }
    let record = "time (s),acceleration (m/s²)\n0,0\n0.2,1e308\n0.4,-1e308\n";
    fs::write(at("tower-record.csv"), record).expect("written");
    fs::write(at("tower.toml"), TOWER).expect("written");
    for command in ["simulate", "check", "optimize", "report"] {
        let said = refused(folder.path(), &[command, "tower.toml"]);
        assert!(
            said.contains("too large for the case") && said.contains("check its unit"),
            "{said}"
        );
    }
    let reduced = include_str!("../../cases/reduced-unit-clearance.toml");
    let sweep = include_str!("../../cases/sweep-fast.toml");
    let key = |name: &str, value: &str| {
        let line = |line: &str| match line.starts_with(name) {
            true => format!("{name} = {value}\n"),
            false => format!("{line}\n"),
        };
        reduced.lines().map(line).collect::<String>()
    };
    for text in [
        key("mass_ratio", "1e308"),
        key("mass_ratio", "1e307"),
        key("damping", "1e307"),
        key("damping", "1e-307"),
        sweep.replace("from = \"7.5 Hz\"", "from = \"1e-307 Hz\""),
        case.replace("\"11.47 kN/m\"", "\"1e-307 kN/m\""),
    ] {
        fs::write(at("case.toml"), text).expect("written");
        for command in ["simulate", "check", "report"] {
            let output = bounded(folder.path(), &[command, "case.toml"]);
            assert!(output.status.code().is_some(), "{output:?}");
            let said = String::from_utf8_lossy(&output.stderr).into_owned();
            for word in ["inf %", "NaN", "panicked", "-->", "{{", "{%"] {
                assert!(!said.contains(word), "{command} {word}: {said}");
            }
        }
    }
}

/// A case without a name would have its report in place of all others, or above them.
#[test]
fn a_case_without_a_name_is_refused() {
    let folder = folder();
    fs::create_dir(folder.path().join("reports")).expect("a folder");
    fs::write(folder.path().join("reports/kept.md"), "kept").expect("written");
    for name in ["..toml", "...toml"] {
        // No case at all: the name is looked at before there is any work.
        fs::write(folder.path().join(name), "no case").expect("written");
        for command in ["report", "tradeoff", "optimize"] {
            let mut arguments = vec![command, name];
            if command != "report" {
                arguments.extend(["--out", "reports"]);
            }
            let said = refused(folder.path(), &arguments);
            assert!(said.contains("has no name before its ending"), "{name}: {said}");
        }
    }
    let names = |folder: &Path| fs::read_dir(folder).expect("a folder").count();
    assert_eq!((names(folder.path()), names(&folder.path().join("reports"))), (3, 1));
}

/// The head of a page with billions of elements that the library passes over one by one: given up after five seconds. In a
/// process of its own, with which the thread ends that goes on.
#[test]
fn a_chunk_of_a_sweep_that_takes_for_ever_is_given_up() {
    const CHILD: &str = "VINESINK_TEST_CHILD";
    const NAME: &str = "untrusted_input::a_chunk_of_a_sweep_that_takes_for_ever_is_given_up";
    let begin = Instant::now();
    if std::env::var_os(CHILD).is_none() {
        let program = std::env::current_exe().expect("this program");
        let arguments = ["--exact", NAME, "--test-threads", "1"];
        let ended = Command::new(program).args(arguments).env(CHILD, "1").output().expect("run");
        assert!(ended.status.success(), "{}", String::from_utf8_lossy(&ended.stdout));
        assert!(begin.elapsed() < Duration::from_secs(60), "{:?}", begin.elapsed());
        return;
    }
    let case = fs::read_to_string("fuzz/corpus/results.toml").expect("a case");
    let plan = Plan::of(&Case::parse("case.toml", &case).expect("a case")).expect("a sweep");
    let most = usize::try_from(plan.points_per_chunk()).expect("few");
    let mut read = columns::empty(&plan);
    let mut file = fs::read("fuzz/corpus/results/000000000.parquet").expect("a chunk");
    let folder = folder();
    let path = folder.path().join("chunk.parquet");
    let mut read = |bytes: &[u8]| {
        fs::write(&path, bytes).expect("written");
        parquet::read(fs::File::open(&path).expect("a file"), &mut read, most)
    };
    read(&file).expect("what the program wrote");
    // A dictionary of 600 million words in 1,700 bytes, for which the library would take 10 GB.
    let dictionary = fs::read("fuzz/corpus/results/dictionary.parquet").expect("a chunk");
    let error = read(&dictionary).expect_err("refused");
    assert!(error.to_string().contains("more values than the file has rows"), "{error}");
    // After the magic number: fields that nobody knows, each a list of two billion flags that have no bytes of their own.
    let endless = [0xf9, 0xf1, 0xff, 0xff, 0xff, 0xff, 0x07].repeat(100);
    file.splice(4..4, endless);
    let error = read(&file).expect_err("damaged");
    assert!(error.to_string().contains("damaged"), "{error}");
}
