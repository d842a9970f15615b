//! A job of an engine: its files, from `templates/jobs/`, and the commands that submit it.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::Command;

use miette::{IntoDiagnostic, Result, WrapErr as _, miette};
use serde_json::json;
use vinesink::digest::sha256;
use vinesink::program::output::word;
use vinesink::quantity::Units;
use vinesink::report::template::render;

use super::super::{Sweep, shown};
use super::{Arguments, Engine};

/// Tasks unless said otherwise: one less than the number that Slurm allows in an array, 1001, unless it
/// is told to allow more.
const MOST_TASKS: u64 = 1000;

/// Everything of a job that is known before it is submitted.
pub(super) struct Job {
    engine: Engine,
    options: Vec<String>,
    pub(super) tasks: u64,
    /// The folder of all sweeps.
    pub(super) out: PathBuf,
    /// Receives the files.
    pub(super) folder: PathBuf,
    /// The script of the tasks; then Slurm's merge, or HyperQueue's job, which has it.
    pub(super) files: [(PathBuf, String); 2],
    /// The copy of the case that the tasks read.
    pub(super) case: PathBuf,
}

impl Job {
    pub(super) fn of(arguments: &Arguments, sweep: &Sweep) -> Result<Self> {
        let Arguments { engine, cpus_per_task, time, retries, pause, .. } = arguments;
        let program = std::env::current_exe().into_diagnostic();
        let program = program.wrap_err("cannot tell where this program is")?;
        let out = std::path::absolute(&arguments.sweep.out).into_diagnostic()?;
        let tasks = arguments.tasks.unwrap_or(MOST_TASKS).min(sweep.grid().chunks());
        // Jobs that differ get folders of their own: what is running keeps the files it began with.
        let told = format!(
            "{} {engine:?} {tasks} {cpus_per_task} {time:?} {retries} {pause} {}",
            sweep.grid().identity,
            program.display()
        );
        let folder = out.join(&sweep.name).join("submit").join(&sha256(told.as_bytes())[..12]);
        let name = &sweep.name;
        let case = folder.join(format!("{name}.toml"));
        for path in [&program, &folder] {
            is_writable_in_scripts(path)?;
        }
        let facts = json!({
            "engine": if *engine == Engine::Slurm { "slurm" } else { "hyperqueue" },
            "name": name, "folder": shown(&folder), "tasks": tasks, "cpus": cpus_per_task,
            "retries": retries, "pause": pause,
            "seconds": time, "time": time.map(clock),
            "program": shown(&program), "program_word": word(&shown(&program)),
            "case": shown(&case), "case_word": word(&shown(&case)),
            "outside": arguments.sweep.allow_outside,
            "out": shown(&out), "out_word": word(&shown(&out)),
        });
        let second = match engine {
            Engine::Slurm => "merge.sh",
            Engine::Hyperqueue => "job.toml",
        };
        let file = |name: &str| {
            let text = render(&format!("jobs/{name}"), &Units::reduced(), &facts);
            text.map(|text| (folder.join(name), text)).into_diagnostic()
        };
        let files = [file("tasks.sh")?, file(second)?];
        Ok(Self {
            engine: *engine,
            options: arguments.options.clone(),
            tasks,
            out,
            folder,
            files,
            case,
        })
    }

    /// The command that submits the tasks; and what submits the merge after Slurm's, HyperQueue having it from the job
    /// file. It runs whatever became of them: what is missing it can say better than a dependency that never
    /// comes true.
    fn command(&self, after: Option<&str>) -> Vec<String> {
        let file = match (self.engine, after) {
            (Engine::Slurm, None) => &self.files[0].0,
            _ => &self.files[1].0,
        };
        let after = after.map(|id| format!("--dependency=afterany:{id}"));
        let options = self.options.iter().cloned();
        let own = |words: &[&str]| words.iter().map(|word| (*word).to_owned()).collect::<Vec<_>>();
        let (begin, end) = match self.engine {
            Engine::Slurm => (own(&["sbatch", "--parsable"]), Vec::new()),
            Engine::Hyperqueue => {
                (own(&["hq"]), own(&["--output-mode=quiet", "job", "submit-file"]))
            }
        };
        begin.into_iter().chain(after).chain(options).chain(end).chain([shown(file)]).collect()
    }

    /// Submits it; returns the commands to watch and to cancel it.
    pub(super) fn submit(&self) -> Result<[String; 2]> {
        let kept =
            || format!("nothing is submitted; the files are kept in {}", shown(&self.folder));
        let id = told(&self.command(None)).wrap_err_with(kept)?;
        if self.engine == Engine::Hyperqueue {
            let hq = line(&[vec!["hq".to_owned()], self.options.clone()].concat());
            return Ok([format!("{hq} job info {id}"), format!("{hq} job cancel {id}")]);
        }
        let merge = told(&self.command(Some(&id))).wrap_err_with(|| {
            format!(
                "the tasks are submitted as job {id}, but not the merge after them; `vinesink sweep merge` \
                 does it by hand"
            )
        })?;
        Ok([format!("squeue --jobs={id},{merge}"), format!("scancel {id} {merge}")])
    }

    /// All that would be written and run.
    pub(super) fn described(&self) -> String {
        let files = self.files.iter().map(|(file, text)| format!("# {}\n{text}\n", shown(file)));
        let merge = (self.engine == Engine::Slurm).then(|| self.command(Some("ID")));
        let commands = [Some(self.command(None)), merge].into_iter().flatten();
        let commands = commands.map(|command| line(&command) + "\n");
        files.chain(["# Commands\n".to_owned()]).chain(commands).collect()
    }
}

/// Slurm and HyperQueue would read some letters as something else, each in its own way.
fn is_writable_in_scripts(path: &Path) -> Result<()> {
    if path.to_str().is_some_and(|text| !text.contains(['"', '\\', '%', '\n'])) {
        return Ok(());
    }
    Err(miette!(
        help = "choose another folder with --out, or rename what has one of them",
        "{} has a quotation mark, backslash, percent sign, line break or no Unicode in its name, which job \
         scripts cannot have",
        shown(path)
    ))
}

/// Seconds as hours, minutes and seconds.
fn clock(seconds: u64) -> String {
    format!("{:02}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60)
}

/// What an engine's command answers: the number of the job.
fn told(command: &[String]) -> Result<String> {
    let [program, arguments @ ..] = command else { return Err(miette!("no command")) };
    let output = match Command::new(program).args(arguments).output() {
        Ok(output) => output,
        Err(error) if error.kind() == ErrorKind::NotFound => {
            return Err(miette!(
                help = "run this where the engine's commands are, such as a login node, or choose the \
                        other --engine",
                "there is no program `{program}` in PATH"
            ));
        }
        Err(error) => {
            return Err(error).into_diagnostic().wrap_err(format!("cannot run {program}"));
        }
    };
    let said = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        return Err(miette!(
            help = "options for the engine come after `--`; a site may bound the number of --tasks \
                    (Slurm's MaxArraySize), --cpus-per-task or --time",
            "`{}` was refused:\n{}",
            line(command),
            said.trim_end()
        ));
    }
    // Slurm adds the cluster's name behind a semicolon.
    let answer = String::from_utf8_lossy(&output.stdout);
    let id = answer.trim().split(';').next().unwrap_or_default().to_owned();
    if id.is_empty() || !id.bytes().all(|byte| byte.is_ascii_digit()) {
        return Err(miette!(
            help = "look with the engine's own commands whether the job is there",
            "{program} answered {:?} instead of the number of a job",
            answer.trim()
        ));
    }
    Ok(id)
}

/// A command as a person would write it.
fn line(command: &[String]) -> String {
    command.iter().map(|one| word(one)).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_with_a_blank_is_quoted() {
        assert_eq!(word("--partition=long"), "--partition=long");
        assert_eq!(word("it's here"), r"'it'\''s here'");
        assert_eq!(word(""), "''");
    }
}
