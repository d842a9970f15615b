//! `vinesink sweep submit CASE`: scripts for an engine that runs jobs on many machines, and the jobs.
//!
//! Where and when a task runs, and again after a machine is lost, is the engine's business. Ours is that a
//! chunk may be worked out anywhere and any number of times.

mod job;

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use miette::Result;
use vinesink::case::{Recording, modes_file};
use vinesink::program::output::{self, word};
use vinesink::store::{self, Output};

use super::subject::Subject;
use super::{Long, Sweep, Where, shown};
use job::Job;

/// Submit all chunks to the engine of a cluster, and the merge after them
///
/// Writes scripts and a copy of the case to OUT/<name>/submit, and submits them. The folder OUT and this
/// program must have the same path on all machines. A machine that is lost in the middle costs what it was
/// working out: its tasks run again, on another one. Chunks that are there already are not done again.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    sweep: Where,
    #[command(flatten)]
    long: Long,
    /// What runs the tasks
    #[arg(long, value_enum)]
    engine: Engine,
    /// Tasks to share the chunks between [default: one for each chunk, at most 1000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    tasks: Option<u64>,
    /// Processors of a task
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..))]
    cpus_per_task: u16,
    /// Longest time a task may take [default: the engine's]
    #[arg(long, value_name = "HH:MM:SS", value_parser = seconds)]
    time: Option<u64>,
    /// How often a task that fails begins again; with HyperQueue also how many of its workers may be lost
    /// under it
    #[arg(long, value_name = "N", default_value_t = 3)]
    retries: u16,
    /// Seconds before it does
    #[arg(long, value_name = "SECONDS", default_value_t = 10)]
    pause: u16,
    /// Print the scripts and the commands; write and submit nothing
    #[arg(long)]
    dry_run: bool,
    /// Options that the engine's command gets as they are
    #[arg(last = true, value_name = "ENGINE OPTIONS")]
    options: Vec<String>,
}

const EXAMPLES: &str = "\
Examples:
  vinesink sweep submit map.toml --engine slurm --cpus-per-task 8 --time 02:00:00
  vinesink sweep submit map.toml --engine slurm -- --partition=long --account=dampers
  vinesink sweep submit map.toml --engine hyperqueue --tasks 5000
  vinesink sweep submit map.toml --engine hyperqueue --dry-run

Options after -- go to sbatch, for both the tasks and the merge; or to hq, which knows --server-dir.";

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Engine {
    /// A job array by `sbatch`
    Slurm,
    /// A job by `hq`
    Hyperqueue,
}

/// The seconds of a time in hours, minutes and seconds.
fn seconds(text: &str) -> Result<u64, String> {
    let refused = || "write hours, minutes and seconds, such as 02:30:00".to_owned();
    let number = |part: &str| match part.bytes().all(|byte| byte.is_ascii_digit()) {
        true => part.parse::<u32>().map(u64::from).map_err(|_| refused()),
        false => Err(refused()),
    };
    let numbers: Vec<u64> = text.split(':').map(number).collect::<Result<_, _>>()?;
    match numbers.as_slice() {
        &[hours, minutes @ 0..60, seconds @ 0..60] if hours + minutes + seconds > 0 => {
            Ok(hours * 3600 + minutes * 60 + seconds)
        }
        _ => Err(refused()),
    }
}

pub fn run(arguments: &Arguments) -> Result<bool> {
    let sweep = Sweep::open(&arguments.sweep)?;
    sweep.of.is_ordinary(&arguments.sweep.case, arguments.long)?;
    let job = Job::of(arguments, &sweep)?;
    if arguments.dry_run {
        output::print(job.described())?;
        return Ok(true);
    }
    let at = &arguments.sweep;
    let out = match shown(&at.out).as_str() {
        "sweeps" => String::new(),
        out => format!(" --out {}", word(out)),
    };
    let by_hand = |verb: &str| format!("vinesink sweep {verb} {}{out}", word(&shown(&at.case)));
    if sweep.missing()?.is_empty() {
        output::print(format!(
            "all {} chunks are there, and nothing is submitted\n  put together  {}\n",
            sweep.grid().chunks(),
            by_hand("merge")
        ))?;
        return Ok(true);
    }
    let inside = |path: &Path| path.strip_prefix(&job.out).unwrap_or(path).to_owned();
    let scripts = job.files.iter().map(|(file, text)| (inside(file), text.clone().into_bytes()));
    let case = (inside(&job.case), sweep.case_text.clone().into_bytes());
    let named = named_file(&sweep, at)?;
    let named = named.map(|(file, bytes)| (inside(&job.folder.join(file)), bytes));
    let files = scripts.chain([case]).chain(named).collect();
    Output::open(&job.out)?.add("", &files)?;
    let [watch, cancel] = job.submit()?;
    output::print(format!(
        "submitted: {} chunks in {} tasks, and the merge after them\n  \
         watch         {watch}\n                {}\n  \
         what failed   {}\n  \
         cancel        {cancel}\n  \
         put together  {}   (by hand, where the merge found chunks missing)\n",
        sweep.grid().chunks(),
        job.tasks,
        by_hand("status"),
        shown(&job.folder.join("*.log")),
        by_hand("merge"),
    ))?;
    Ok(true)
}

/// The record that drives a case, or the file of its modes, where the case's copy looks for it.
fn named_file(sweep: &Sweep, from: &Where) -> Result<Option<(PathBuf, Vec<u8>)>> {
    let file = match &sweep.of {
        Subject::One(of) => of.0.recording.as_ref().and_then(Recording::file).map(str::to_owned),
        Subject::Several(_) => modes_file(&sweep.case_text),
    };
    let Some(file) = file.filter(|file| Path::new(file).is_relative()) else { return Ok(None) };
    let folder = from.case.parent().unwrap_or(Path::new(""));
    let (_, bytes) = store::read_record(folder, &file, from.reading().reach())?;
    Ok(Some((file.into(), bytes)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_is_hours_minutes_and_seconds() {
        for (text, seconds) in [("02:30:00", 9000), ("0:00:01", 1), ("100:59:59", 363_599)] {
            assert_eq!(self::seconds(text), Ok(seconds));
        }
        for wrong in
            ["", "30", "2:30", "00:00:00", "1:60:00", "1:00:60", "+1:00:00", "a:b:c", "1:2:3:4"]
        {
            assert!(seconds(wrong).is_err(), "{wrong}");
        }
    }
}
