//! `vinesink sweep submit` and `sweep run --every`: what an engine is given, and what becomes of it.
//!
//! No engine is needed: `sbatch` and `hq` are scripts in PATH that note how they are called, and a task's
//! script is run as the engine would. The tests on real ones are in `tests/cluster/`.

use crate::common;
use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;

/// Hardly simulated, in five chunks.
const SWEEP: &str = "[sweep]\nstarts = 1\nperiods = 48\n\
    clearance = { from = \"5 mm\", to = \"40 mm\", count = 80 }\n\
    frequency = { from = \"8 Hz\", to = \"8.7 Hz\", count = 64 }\n";

fn case() -> String {
    format!("{}{SWEEP}", common::table_1_case())
}

/// Variables of an engine that the tests themselves may run under.
const ENGINES: [&str; 4] = ["SLURM_ARRAY_TASK_ID", "HQ_TASK_ID", "SLURM_CPUS_PER_TASK", "HQ_CPUS"];

/// A folder with a case, and one with the programs of an engine.
struct Place {
    folder: TempDir,
}

impl Place {
    fn new() -> Self {
        let folder = TempDir::new().expect("a folder");
        fs::create_dir(folder.path().join("bin")).expect("made");
        fs::write(folder.path().join("map.toml"), case()).expect("written");
        Self { folder }
    }

    fn path(&self, inside: &str) -> PathBuf {
        self.folder.path().join(inside)
    }

    /// Puts a script into PATH that notes its arguments, a line each and then a line of dashes, and goes
    /// on as it says.
    fn program(&self, name: &str, then: &str) {
        let (path, notes) = (self.path("bin").join(name), self.path("called"));
        let notes = notes.display();
        let text = format!(
            "#!/bin/sh\nfor word in \"$@\"; do echo \"$word\" >>'{notes}'; done\n\
             echo ---- >>'{notes}'\n{then}\n"
        );
        fs::write(&path, text).expect("written");
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).expect("executable");
    }

    /// How the programs of the engine were called.
    fn calls(&self) -> Vec<Vec<String>> {
        let notes = fs::read_to_string(self.path("called")).unwrap_or_default();
        let calls = notes.split_terminator("----\n");
        calls.map(|call| call.lines().map(str::to_owned).collect()).collect()
    }

    fn sweep(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_vinesink"));
        command.current_dir(self.folder.path()).arg("sweep").args(arguments);
        // The engine's programs and the few that their scripts need, and no others of this machine.
        command.env("PATH", self.path("bin"));
        for name in ENGINES {
            command.env_remove(name);
        }
        command
    }

    fn run(&self, arguments: &[&str]) -> Output {
        self.sweep(arguments).output().expect("it runs")
    }

    #[track_caller]
    fn done(&self, arguments: &[&str]) -> String {
        let output = self.run(arguments);
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {output:?}");
        String::from_utf8(output.stdout).expect("UTF-8")
    }

    /// What is said of something that cannot be done, as one line.
    #[track_caller]
    fn refused(&self, arguments: &[&str]) -> String {
        let output = self.run(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {output:?}");
        assert!(output.stdout.is_empty(), "{output:?}");
        let said = String::from_utf8(output.stderr).expect("UTF-8");
        said.split(['\n', '│', ' ']).filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
    }

    /// The folders of what was submitted.
    fn submitted(&self) -> Vec<PathBuf> {
        let Ok(folders) = fs::read_dir(self.path("sweeps/map/submit")) else { return Vec::new() };
        folders.map(|entry| entry.expect("an entry").path()).collect()
    }

    fn has_chunk(&self, number: u64) -> bool {
        self.path(&format!("sweeps/map/chunks/{number:09}.parquet")).is_file()
    }
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn a_dry_run_shows_everything_and_writes_nothing() {
    let place = Place::new();
    place.program("sbatch", "echo 1");
    let arguments =
        "submit map.toml --engine slurm --tasks 2 --cpus-per-task 3 --time 1:02:03 --dry-run";
    let arguments: Vec<&str> = arguments.split(' ').chain(["--", "--partition=long"]).collect();
    let said = place.done(&arguments);
    for line in [
        "#SBATCH --array=0-1",
        "#SBATCH --cpus-per-task=3",
        "#SBATCH --time=01:02:03",
        "#SBATCH --requeue",
        "    --chunk \"$SLURM_ARRAY_TASK_ID\" --every 2 --threads 3",
    ] {
        assert!(said.lines().any(|one| one == line), "{line}\n{said}");
    }
    let commands: Vec<&str> = said.lines().rev().take(2).collect();
    assert!(commands[1].starts_with("sbatch --parsable --partition=long /"), "{said}");
    let merge = "sbatch --parsable --dependency=afterany:ID --partition=long /";
    assert!(commands[0].starts_with(merge), "{said}");
    assert_eq!(said, place.done(&arguments));
    let said = place.done(&["submit", "map.toml", "--engine", "hyperqueue", "--dry-run"]);
    assert!(said.contains("hq --output-mode=quiet job submit-file /"), "{said}");
    assert!(!said.contains("#SBATCH"), "{said}");
    assert!(place.calls().is_empty() && !place.path("sweeps").exists());
}

/// Of many chunks a task has several: Slurm takes 1001 tasks of an array unless it is told otherwise.
#[test]
fn many_chunks_are_shared_by_a_thousand_tasks() {
    let place = Place::new();
    let many = case().replace("count = 80", "count = 20_000");
    fs::write(place.path("map.toml"), many).expect("written");
    let said = place.done(&["submit", "map.toml", "--engine", "slurm", "--dry-run"]);
    assert!(said.lines().any(|line| line == "#SBATCH --array=0-999"), "{said}");
    assert!(said.contains("--every 1000 "), "{said}");
}

#[test]
fn slurm_gets_an_array_and_a_merge_after_it() {
    let place = Place::new();
    // The second answer as from a site of several clusters.
    place.program("sbatch", "case $* in *afterany*) echo '4712;north';; *) echo 4711;; esac");
    let said =
        place.done(&["submit", "map.toml", "--engine", "slurm", "--", "--account=a b", "-p", "x"]);
    for part in [
        "5 chunks in 5 tasks",
        "squeue --jobs=4711,4712\n",
        "scancel 4711 4712\n",
        "vinesink sweep status map.toml\n",
        "vinesink sweep merge map.toml ",
    ] {
        assert!(said.contains(part), "{part}\n{said}");
    }
    let [folder] = place.submitted().try_into().expect("one folder");
    let script = |name: &str| folder.join(name).display().to_string();
    let tasks = ["--parsable", "--account=a b", "-p", "x", &script("tasks.sh")];
    let merge = [
        "--parsable",
        "--dependency=afterany:4711",
        "--account=a b",
        "-p",
        "x",
        &script("merge.sh"),
    ];
    assert_eq!(place.calls(), [tasks.as_slice(), merge.as_slice()]);
    assert_eq!(read(&folder.join("map.toml")), case());
    let text = read(&folder.join("tasks.sh"));
    // Slurm reads its directives up to the first line that is neither one nor a comment.
    let head: Vec<&str> = text.lines().take_while(|line| line.starts_with('#')).collect();
    assert_eq!(head.iter().filter(|line| line.starts_with("#SBATCH ")).count(), 8, "{text}");
    assert_eq!(text.matches("#SBATCH").count(), 8, "{text}");
    let log = format!("#SBATCH --output=\"{}\"", folder.join("task-%a.log").display());
    assert!(head.contains(&log.as_str()), "{text}");
    assert!(!text.contains("--time"), "{text}");

    // The same again is the same files; another number of tasks leaves them to those that run.
    place.done(&["submit", "map.toml", "--engine", "slurm"]);
    assert_eq!(place.submitted(), std::slice::from_ref(&folder));
    place.done(&["submit", "map.toml", "--engine", "slurm", "--tasks", "2"]);
    assert_eq!(place.submitted().len(), 2);
    for (k, option) in
        ["--cpus-per-task=2", "--time=1:00:00", "--retries=7", "--pause=9"].iter().enumerate()
    {
        place.done(&["submit", "map.toml", "--engine", "slurm", option]);
        assert_eq!(place.submitted().len(), 3 + k, "{option}");
    }
    assert_eq!(read(&folder.join("tasks.sh")), text);
}

#[test]
fn hyperqueue_gets_a_job_whose_last_task_needs_all_others() {
    let place = Place::new();
    place.program("hq", "echo 17");
    let arguments = "submit map.toml --engine hyperqueue --tasks 3 --cpus-per-task 2 --time 00:10:00 --retries 5 --out x";
    let arguments: Vec<&str> =
        arguments.split(' ').chain(["--", "--server-dir", "/srv/hq"]).collect();
    let said = place.done(&arguments);
    assert!(said.contains("hq --server-dir /srv/hq job info 17\n"), "{said}");
    assert!(said.contains("hq --server-dir /srv/hq job cancel 17\n"), "{said}");
    assert!(said.contains("vinesink sweep status map.toml --out x\n"), "{said}");
    let folder = fs::read_dir(place.path("x/map/submit")).expect("there").next();
    let folder = folder.expect("one").expect("an entry").path();
    let file = folder.join("job.toml");
    let wanted = ["--server-dir", "/srv/hq", "--output-mode=quiet", "job", "submit-file"];
    let wanted = [&wanted[..], &[file.to_str().expect("UTF-8")]].concat();
    assert_eq!(place.calls(), [wanted]);
    let job: toml::Table = read(&file).parse().expect("TOML");
    let tasks = job["task"].as_array().expect("tasks");
    assert_eq!(tasks.len(), 4);
    for (number, task) in tasks[..3].iter().enumerate() {
        assert_eq!(task["id"].as_integer(), Some(number as i64));
        let script = folder.join("tasks.sh");
        assert_eq!(task["command"].as_array().expect("words")[1].as_str(), script.to_str());
        assert_eq!(task["request"][0]["resources"]["cpus"].as_integer(), Some(2));
        assert_eq!(task["time_limit"].as_str(), Some("600s"));
        // Five workers may be lost under a task, and the sixth fails it.
        assert_eq!(task["crash_limit"].as_integer(), Some(6));
        assert!(task.get("deps").is_none());
    }
    let merge = &tasks[3];
    let deps: Vec<_> =
        merge["deps"].as_array().expect("a list").iter().map(|d| d.as_integer()).collect();
    assert_eq!(deps, [Some(0), Some(1), Some(2)]);
    assert_eq!(merge["command"].as_array().expect("words")[2].as_str(), Some("merge"));
    assert_eq!(merge["crash_limit"].as_integer(), Some(6));
    assert!(
        read(&folder.join("tasks.sh")).contains("--chunk \"$HQ_TASK_ID\" --every 3 --threads 2")
    );
}

#[test]
fn what_the_engine_does_not_take_is_kept_and_said() {
    let place = Place::new();
    let said = place.refused(&["submit", "map.toml", "--engine", "slurm"]);
    assert!(said.contains("no program `sbatch` in PATH") && said.contains("login node"), "{said}");
    assert!(said.contains("files are kept in"), "{said}");
    let [folder] = place.submitted().try_into().expect("one folder");
    assert!(folder.join("tasks.sh").is_file() && folder.join("merge.sh").is_file());
    let said = place.refused(&["submit", "map.toml", "--engine", "hyperqueue"]);
    assert!(said.contains("no program `hq` in PATH"), "{said}");

    place.program("sbatch", "echo 'sbatch: error: Invalid job array specification' >&2; exit 1");
    let said = place.refused(&["submit", "map.toml", "--engine", "slurm"]);
    assert!(said.contains("Invalid job array specification"), "{said}");
    assert!(said.contains("MaxArraySize"), "{said}");
    place.program("sbatch", "echo queued");
    let said = place.refused(&["submit", "map.toml", "--engine", "slurm"]);
    assert!(said.contains("answered \"queued\" instead of the number"), "{said}");
    // The tasks are taken and the merge is not.
    place.program("sbatch", "case $* in *afterany*) echo no >&2; exit 1;; *) echo 4711;; esac");
    let said = place.refused(&["submit", "map.toml", "--engine", "slurm"]);
    assert!(said.contains("submitted as job 4711, but not the merge"), "{said}");
    assert!(!said.contains("nothing is submitted"), "{said}");
}

#[test]
fn options_and_names_that_cannot_be_are_refused() {
    let place = Place::new();
    place.program("sbatch", "echo 1");
    for wrong in [
        &["--tasks", "0"][..],
        &["--cpus-per-task", "0"],
        &["--time", "90"],
        &["--time", "00:00:00"],
        &["--retries", "often"],
        &["--engine", "cron"],
    ] {
        let said = place.refused(&[&["submit", "map.toml", "--engine", "slurm"], wrong].concat());
        assert!(said.contains(wrong[0]), "{said}");
    }
    for name in ["a\"b", "50%", "back\\slash"] {
        let said = place.refused(&["submit", "map.toml", "--engine", "slurm", "--out", name]);
        assert!(said.contains("job scripts cannot have") && said.contains("--out"), "{said}");
        assert!(!place.path(name).exists(), "{name}");
    }
    assert!(place.calls().is_empty());
}

#[test]
fn a_complete_sweep_is_not_submitted() {
    let place = Place::new();
    place.program("sbatch", "echo 1");
    place.done(&["run", "map.toml"]);
    let said = place.done(&["submit", "map.toml", "--engine", "slurm"]);
    assert!(said.contains("all 5 chunks are there, and nothing is submitted"), "{said}");
    assert!(said.contains("vinesink sweep merge map.toml\n"), "{said}");
    assert!(place.calls().is_empty() && place.submitted().is_empty());
}

/// The script as the engine runs it: elsewhere, and after the case was edited. A blank and an apostrophe in
/// the folder's name are part of it.
#[test]
fn tasks_work_on_the_case_as_it_was_submitted() {
    let place = Place::new();
    place.program("sbatch", "echo 1");
    place.done(&["submit", "map.toml", "--engine", "slurm", "--tasks", "2", "--out", "it's here"]);
    fs::write(place.path("map.toml"), "edited").expect("written");
    let folder = fs::read_dir(place.path("it's here/map/submit")).expect("there").next();
    let folder = folder.expect("one").expect("an entry").path();
    let run = |script: &str, task: &str| {
        let mut command = Command::new("/bin/sh");
        command.arg(folder.join(script)).current_dir("/").env("SLURM_ARRAY_TASK_ID", task);
        let output = command.output().expect("it runs");
        assert_eq!(output.status.code(), Some(0), "{output:?}");
    };
    run("tasks.sh", "0");
    let there =
        |number: u64| place.path(&format!("it's here/map/chunks/{number:09}.parquet")).is_file();
    assert_eq!([0, 1, 2, 3, 4].map(there), [true, false, true, false, true]);
    run("tasks.sh", "1");
    run("merge.sh", "");
    let wanted = Place::new();
    wanted.done(&["map.toml"]);
    let merged = fs::read(place.path("it's here/map/sweep.parquet")).expect("merged");
    assert!(merged == fs::read(wanted.path("sweeps/map/sweep.parquet")).expect("merged"));
}

/// A record lies beside the case, and so a copy of it beside the copy.
#[test]
fn tasks_find_the_record_of_the_case() {
    let place = Place::new();
    place.program("sbatch", "echo 17");
    let record = read(Path::new("cases/tower-record.csv"));
    fs::write(place.path("tower-record.csv"), &record).expect("written");
    let sweep = "[sweep]\nclearance = { values = [\"50 mm\"] }\n";
    let case = format!("{}{sweep}", read(Path::new("cases/tower-record.toml")));
    fs::write(place.path("map.toml"), case).expect("written");
    place.done(&["submit", "map.toml", "--engine", "slurm"]);
    fs::remove_file(place.path("tower-record.csv")).expect("removed");
    let copy = &place.submitted()[0];
    assert_eq!(read(&copy.join("tower-record.csv")), record);
    let planned = place.done(&["plan", copy.join("map.toml").to_str().expect("UTF-8")]);
    assert_eq!(planned, "1 = 1 points, 64 starts each, in 1 chunk (0)\n");
}

/// A task that fails waits and begins again, and says so; after as many times as it may it fails.
#[test]
fn a_task_that_fails_begins_again() {
    let place = Place::new();
    place.program("hq", "echo 1");
    let submit = "submit map.toml --engine hyperqueue --tasks 5 --retries 2 --pause 1";
    place.done(&submit.split(' ').collect::<Vec<_>>());
    let [folder] = place.submitted().try_into().expect("one folder");
    assert!(read(&folder.join("tasks.sh")).lines().any(|line| line == "    sleep 1"));
    // A file where the folder of chunks should be: nothing can be written.
    let chunks = place.path("sweeps/map/chunks");
    fs::remove_dir(&chunks).expect("empty");
    fs::write(&chunks, "").expect("written");
    let mut task = Command::new("/bin/sh");
    task.arg(folder.join("tasks.sh")).env("HQ_TASK_ID", "3");
    let output = task.output().expect("it runs");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert_eq!(said.matches("cannot create").count(), 3, "{said}");
    for line in ["task 3 failed; retry 1 of 2 in 1 s", "task 3 failed; retry 2 of 2 in 1 s"] {
        assert!(said.contains(line), "{said}");
    }
    // This time the hindrance goes away while it waits.
    let log = place.path("log");
    let mut running =
        task.stderr(fs::File::create(&log).expect("made")).spawn().expect("it starts");
    let begin = Instant::now();
    while !read(&log).contains("retry 1 of 2") {
        assert!(begin.elapsed() < Duration::from_secs(60), "{}", read(&log));
        std::thread::sleep(Duration::from_millis(5));
    }
    fs::remove_file(&chunks).expect("there");
    assert!(running.wait().expect("ended").success(), "{}", read(&log));
    assert!(place.has_chunk(3));
}

#[test]
fn every_kth_chunk_from_one_on() {
    let place = Place::new();
    let there = || [0, 1, 2, 3, 4].map(|number| place.has_chunk(number));
    place.done(&["run", "map.toml", "--chunk", "1", "--every", "3"]);
    assert_eq!(there(), [false, true, false, false, true]);
    // The number from the engine; HyperQueue's counts where it runs inside Slurm.
    let mut inner = place.sweep(&["run", "map.toml", "--every", "3"]);
    inner.env("HQ_TASK_ID", "0").env("SLURM_ARRAY_TASK_ID", "7");
    assert!(inner.status().expect("it runs").success());
    assert_eq!(there(), [true, true, false, true, true]);
    let mut outer = place.sweep(&["run", "map.toml", "--every", "3"]);
    assert!(outer.env("SLURM_ARRAY_TASK_ID", "2").status().expect("it runs").success());
    assert_eq!(there(), [true; 5]);

    assert!(place.refused(&["run", "map.toml", "--every", "3"]).contains("counts from a chunk"));
    assert!(
        place.refused(&["run", "map.toml", "--chunk", "5", "--every", "3"]).contains("no chunk 5")
    );
    assert!(
        place.refused(&["run", "map.toml", "--chunk", "0", "--every", "0"]).contains("--every")
    );
    let mut wrong = place.sweep(&["run", "map.toml"]);
    let output = wrong.env("SLURM_CPUS_PER_TASK", "many").output().expect("it runs");
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    assert!(String::from_utf8_lossy(&output.stderr).contains("--threads"), "{output:?}");
}

/// As many more threads as there are more processors, by the option or by what the engine says.
#[cfg(target_os = "linux")]
#[test]
fn a_run_uses_the_processors_that_it_is_given() {
    let most = |threads: Option<&str>, variable: Option<(&str, &str)>| {
        let place = Place::new();
        let mut command = place.sweep(&["run", "map.toml"]);
        command.args(threads.iter().flat_map(|number| ["--threads", number]));
        command.envs(variable).stderr(Stdio::null());
        let mut running = command.spawn().expect("it starts");
        let folder = format!("/proc/{}/task", running.id());
        let mut most = 0;
        while running.try_wait().expect("asked").is_none() {
            most = most.max(fs::read_dir(&folder).map_or(0, Iterator::count));
        }
        most
    };
    let one = most(Some("1"), None);
    assert_eq!(most(Some("6"), None), one + 5);
    assert_eq!(most(None, Some(("HQ_CPUS", "0,1,5,7"))), one + 3);
    assert_eq!(most(None, Some(("SLURM_CPUS_PER_TASK", "3"))), one + 2);
    assert_eq!(most(Some("1"), Some(("HQ_CPUS", "0,1,5,7"))), one);
}
