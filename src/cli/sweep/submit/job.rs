//! A job of an engine: the scripts and the definition it is made of, and the commands that submit it.

use std::fmt::Write as _;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::Command;

use miette::{IntoDiagnostic, Result, WrapErr as _, miette};
use vinesink::digest::sha256;

use super::super::{Sweep, Where, shown};
use super::{Arguments, Engine, Time};

/// Tasks unless said otherwise: one less than the number that Slurm allows in an array, 1001, unless it
/// is told to allow more.
const MOST_TASKS: u64 = 1000;

/// Everything of a job that is known before it is submitted.
pub(super) struct Job {
    engine: Engine,
    name: String,
    program: PathBuf,
    out: PathBuf,
    pub(super) tasks: u64,
    cpus: u16,
    time: Option<Time>,
    retries: u16,
    pause: u16,
    options: Vec<String>,
    /// Receives the files.
    pub(super) folder: PathBuf,
}

/// What to tell the user about what was submitted.
pub(super) struct Submitted {
    pub(super) watch: String,
    pub(super) cancel: String,
}

impl Job {
    pub(super) fn of(arguments: &Arguments, sweep: &Sweep) -> Result<Self> {
        let Arguments { engine, cpus_per_task, time, retries, pause, options, .. } = arguments;
        let program = std::env::current_exe().into_diagnostic();
        let program = program.wrap_err("cannot tell where this program is")?;
        let out = std::path::absolute(&arguments.sweep.out).into_diagnostic()?;
        let folder = std::path::absolute(&sweep.folder).into_diagnostic()?;
        let tasks = arguments.tasks.unwrap_or(MOST_TASKS).min(sweep.plan.chunks());
        let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        // Jobs that differ get folders of their own: what is running keeps the files it began with.
        let told = format!(
            "{} {engine:?} {tasks} {cpus_per_task} {time:?} {retries} {pause} {}",
            sweep.plan.identity,
            program.display()
        );
        let digest = sha256(told.as_bytes());
        let job = Self {
            engine: *engine,
            name,
            program,
            out,
            tasks,
            cpus: *cpus_per_task,
            time: *time,
            retries: *retries,
            pause: *pause,
            options: options.clone(),
            folder: folder.join("submit").join(&digest[..12]),
        };
        for path in [&job.program, &job.folder] {
            // Slurm and HyperQueue would read these as something else, each in its own way.
            if path.to_str().is_none_or(|text| text.contains(['"', '\\', '%', '\n'])) {
                return Err(miette!(
                    help = "choose another folder with --out, or rename what has one of them",
                    "{} has a quotation mark, backslash, percent sign, line break or no Unicode in \
                     its name, which job scripts cannot have",
                    shown(path)
                ));
            }
        }
        Ok(job)
    }

    /// The copy of the case that the tasks read.
    pub(super) fn case(&self) -> PathBuf {
        self.folder.join(format!("{}.toml", self.name))
    }

    fn tasks_script(&self) -> PathBuf {
        self.folder.join("tasks.sh")
    }

    /// The files that the engine gets.
    pub(super) fn files(&self) -> Vec<(PathBuf, String)> {
        let mut files = vec![(self.tasks_script(), self.tasks_text())];
        files.push(match self.engine {
            Engine::Slurm => (self.folder.join("merge.sh"), self.merge_text()),
            Engine::Hyperqueue => (self.folder.join("job.toml"), self.definition()),
        });
        files
    }

    fn vinesink(&self, verb: &str) -> String {
        let [program, case, out] =
            [&self.program, &self.case(), &self.out].map(|path| quoted(path));
        format!("{program} sweep {verb} {case} --out {out}")
    }

    /// The script of a task.
    fn tasks_text(&self) -> String {
        let Self { tasks, cpus, retries, pause, .. } = self;
        let number = match self.engine {
            Engine::Slurm => "$SLURM_ARRAY_TASK_ID",
            Engine::Hyperqueue => "$HQ_TASK_ID",
        };
        let mut text = "#!/bin/sh\n".to_owned();
        if self.engine == Engine::Slurm {
            text.push_str(&self.directives("", "task-%a.log"));
            let _ = write!(
                text,
                "#SBATCH --array=0-{}\n#SBATCH --cpus-per-task={cpus}\n\
                 # After a lost node the engine runs its tasks again.\n#SBATCH --requeue\n",
                tasks - 1
            );
            if let Some(Time(seconds)) = self.time {
                let (hours, minutes) = (seconds / 3600, seconds / 60 % 60);
                let _ =
                    writeln!(text, "#SBATCH --time={hours:02}:{minutes:02}:{:02}", seconds % 60);
            }
        }
        let _ = write!(
            text,
            "# A task that merely fails begins again here; chunks that are there are not done again.\n\
             failed=0\n\
             until {} \\\n    --chunk \"{number}\" --every {tasks} --threads {cpus}\n\
             do\n    \
             status=$?\n    \
             if [ \"$failed\" -ge {retries} ]; then exit \"$status\"; fi\n    \
             failed=$((failed + 1))\n    \
             echo \"task {number} failed; retry $failed of {retries} in {pause} s\" >&2\n    \
             sleep {pause}\n\
             done\n",
            self.vinesink("run")
        );
        text
    }

    /// What both of Slurm's scripts begin with.
    fn directives(&self, what: &str, log: &str) -> String {
        format!(
            "#SBATCH --job-name=\"{}{what}\"\n#SBATCH --nodes=1\n#SBATCH --ntasks=1\n\
             #SBATCH --open-mode=append\n#SBATCH --output=\"{}\"\n",
            self.name,
            shown(&self.folder.join(log))
        )
    }

    /// The script that puts the chunks together after Slurm's tasks.
    fn merge_text(&self) -> String {
        format!(
            "#!/bin/sh\n{}#SBATCH --requeue\nexec {}\n",
            self.directives(" merge", "merge.log"),
            self.vinesink("merge")
        )
    }

    /// The job of HyperQueue: one command per task, and the merge, which needs them all.
    fn definition(&self) -> String {
        let (folder, cpus) = (shown(&self.folder), self.cpus);
        // Of a number of crashed workers the last one fails the task.
        let crashes = u32::from(self.retries) + 1;
        let time = match self.time {
            Some(Time(seconds)) => format!("time_limit = \"{seconds}s\"\n"),
            None => String::new(),
        };
        let mut text = format!("name = \"{}\"\n", self.name);
        for task in 0..self.tasks {
            let _ = write!(
                text,
                "\n[[task]]\nid = {task}\ncommand = [\"/bin/sh\", \"{folder}/tasks.sh\"]\n\
                 stdout = \"none\"\nstderr = \"{folder}/task-{task}.log\"\ncrash_limit = {crashes}\n{time}\
                 [[task.request]]\nresources = {{ \"cpus\" = {cpus} }}\n"
            );
        }
        let all: Vec<String> = (0..self.tasks).map(|task| task.to_string()).collect();
        let [program, case, out] = [&self.program, &self.case(), &self.out].map(|path| shown(path));
        let _ = write!(
            text,
            "\n[[task]]\nid = {}\n\
             command = [\"{program}\", \"sweep\", \"merge\", \"{case}\", \"--out\", \"{out}\"]\n\
             stdout = \"none\"\nstderr = \"{folder}/merge.log\"\ncrash_limit = {crashes}\ndeps = [{}]\n",
            self.tasks,
            all.join(", ")
        );
        text
    }

    /// The command that submits the tasks.
    fn command(&self) -> Vec<String> {
        let mut command = Vec::new();
        match self.engine {
            Engine::Slurm => {
                command.extend(["sbatch", "--parsable"].map(str::to_owned));
                command.extend(self.options.iter().cloned());
                command.push(shown(&self.tasks_script()));
            }
            Engine::Hyperqueue => {
                command.push("hq".to_owned());
                command.extend(self.options.iter().cloned());
                command.extend(["--output-mode=quiet", "job", "submit-file"].map(str::to_owned));
                command.push(shown(&self.folder.join("job.toml")));
            }
        }
        command
    }

    /// The command that submits the merge after Slurm's tasks; HyperQueue has it from the job file. It runs
    /// whatever became of them: what is missing it can say better than a dependency that never comes true.
    fn merge_command(&self, id: &str) -> Vec<String> {
        let mut command = vec![
            "sbatch".to_owned(),
            "--parsable".to_owned(),
            format!("--dependency=afterany:{id}"),
        ];
        command.extend(self.options.iter().cloned());
        command.push(shown(&self.folder.join("merge.sh")));
        command
    }

    pub(super) fn submit(&self) -> Result<Submitted> {
        let kept =
            || format!("nothing is submitted; the files are kept in {}", shown(&self.folder));
        let id = told(&self.command()).wrap_err_with(kept)?;
        match self.engine {
            Engine::Slurm => {
                let merge = told(&self.merge_command(&id)).wrap_err_with(|| {
                    format!("the tasks are submitted as job {id}, but not the merge after them; `vinesink \
                             sweep merge` does it by hand")
                })?;
                Ok(Submitted {
                    watch: format!("squeue --jobs={id},{merge}"),
                    cancel: format!("scancel {id} {merge}"),
                })
            }
            Engine::Hyperqueue => {
                let options: String =
                    self.options.iter().map(|option| format!(" {}", plain(option))).collect();
                Ok(Submitted {
                    watch: format!("hq{options} job info {id}"),
                    cancel: format!("hq{options} job cancel {id}"),
                })
            }
        }
    }

    /// All that would be written and run.
    pub(super) fn described(&self) -> String {
        let mut text = String::new();
        for (file, content) in self.files() {
            let _ = write!(text, "# {}\n{content}\n", shown(&file));
        }
        text.push_str("# Commands\n");
        let line = |command: &[String]| {
            let words: Vec<String> = command.iter().map(|word| plain(word)).collect();
            words.join(" ") + "\n"
        };
        text.push_str(&line(&self.command()));
        if self.engine == Engine::Slurm {
            text.push_str(&line(&self.merge_command("ID")));
        }
        text
    }

    /// A command on the sweep as the user would write it.
    pub(super) fn by_hand(&self, verb: &str, at: &Where) -> String {
        let [case, out] = [&at.case, &at.out].map(|path| plain(&shown(path)));
        let out = if out == "sweeps" { String::new() } else { format!(" --out {out}") };
        format!("vinesink sweep {verb} {case}{out}")
    }
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
        let words: Vec<String> = command.iter().map(|word| plain(word)).collect();
        return Err(miette!(
            help = "options for the engine come after `--`; a site may bound the number of --tasks \
                    (Slurm's MaxArraySize), --cpus-per-task or --time",
            "`{}` was refused:\n{}",
            words.join(" "),
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

/// A path as one word of a shell.
fn quoted(path: &Path) -> String {
    format!("'{}'", shown(path).replace('\'', r"'\''"))
}

/// A word as a person would write it in a shell.
fn plain(word: &str) -> String {
    let harmless = |byte: u8| byte.is_ascii_alphanumeric() || b"-_=./:,+@%".contains(&byte);
    match !word.is_empty() && word.bytes().all(harmless) {
        true => word.to_owned(),
        false => quoted(Path::new(word)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_with_a_blank_is_quoted() {
        assert_eq!(plain("--partition=long"), "--partition=long");
        assert_eq!(plain("it's here"), r"'it'\''s here'");
        assert_eq!(plain(""), "''");
    }
}
