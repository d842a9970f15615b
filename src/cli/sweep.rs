//! `vinesink sweep CASE`

mod results;
mod subject;
mod submit;
mod task;

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::{Args, Subcommand};
use miette::{IntoDiagnostic, Result, miette};
use rayon::iter::{IndexedParallelIterator as _, IntoParallelIterator as _, ParallelIterator as _};
use vinesink::program::case_file::{self, Reading};
use vinesink::program::output;
use vinesink::program::progress::{Progress, duration};
use vinesink::store::{Found, Shards, Sharing, Turn};
use vinesink::sweep::{Grid, parquet};

use super::budget::{Long, Work};
use subject::Subject;

/// Work out every point of a case's table [sweep]
///
/// A sweep is cut into chunks with fixed numbers. Each is written to OUT/<name>/chunks as it is done,
/// and what is there already is not done again: a run that was interrupted goes on where it stopped, and
/// ends in the same bytes. All chunks together become OUT/<name>/sweep.parquet, and beside it sweep.html and
/// sweep.md show maps or diagrams with what they say in words.
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, after_long_help = EXAMPLES)]
pub struct Arguments {
    #[command(subcommand)]
    verb: Option<Verb>,
    #[command(flatten)]
    sweep: Option<Where>,
    /// Write nothing; say how many points there are and about how long they take
    #[arg(long)]
    dry_run: bool,
    #[command(flatten)]
    long: Long,
    #[command(flatten)]
    wanted: results::ResultFiles,
}

/// Which sweep, and where its results are.
#[derive(Debug, Args)]
struct Where {
    /// The case file
    #[arg(value_name = "CASE")]
    case: PathBuf,
    /// The folder that receives a folder per case
    #[arg(long, value_name = "OUT", default_value = "sweeps")]
    out: PathBuf,
    // Not flattened in: a group that may be missing must not hold another one.
    /// As that of other commands: also read files outside of the folder of the case
    #[arg(long)]
    allow_outside: bool,
}

impl Where {
    fn reading(&self) -> Reading {
        Reading { allow_outside: self.allow_outside }
    }
}

#[derive(Debug, Subcommand)]
enum Verb {
    /// Say how many points and chunks there are
    Plan(Where),
    /// Work out chunks without putting them together
    Run {
        #[command(flatten)]
        sweep: Where,
        /// The chunk, from 0 [default: $HQ_TASK_ID or $SLURM_ARRAY_TASK_ID; without either all that are
        /// not there]
        #[arg(long, value_name = "N")]
        chunk: Option<u64>,
        /// Also every K-th chunk after it: N, N + K, N + 2 K and so on. K jobs, with N from 0 to K - 1, do
        /// all
        #[arg(long, value_name = "K", value_parser = clap::value_parser!(u64).range(1..))]
        every: Option<u64>,
        /// Processors to use [default: as many as the engine grants, by $HQ_CPUS or $SLURM_CPUS_PER_TASK;
        /// without either all]
        #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
        threads: Option<u16>,
        #[command(flatten)]
        long: Long,
    },
    Submit(submit::Arguments),
    /// Say which chunks are there; ends with exit code 1 while some are not
    Status(Where),
    /// Put the chunks together
    Merge {
        #[command(flatten)]
        sweep: Where,
        #[command(flatten)]
        wanted: results::ResultFiles,
    },
}

const EXAMPLES: &str = "\
Examples:
  vinesink sweep map.toml --dry-run        how much work it is
  vinesink sweep map.toml                  all of it, on all processors
  vinesink sweep run map.toml --chunk 7    one chunk, wherever it runs
  vinesink sweep submit map.toml --engine slurm
                                           all of it, on a cluster
  vinesink sweep status map.toml
  vinesink sweep merge map.toml

A case says what it varies in
  [sweep]
  clearance = { from = \"5 mm\", to = \"40 mm\", count = 100 }
  frequency = { from = \"8 Hz\", to = \"8.7 Hz\", count = 100 }
  starts = 4";

/// An estimate is made from so many stretches of the sweep,
const STRETCHES: u64 = 8;
/// so many points long.
const SAMPLE: u64 = 64;
/// Seconds that a stretch may take at most, about; where it would be more they are not measured.
const LONGEST_SAMPLE: f64 = 120.0;
/// Points from which on it costs little to work out some more before the sweep begins.
const MANY: u64 = 100 * STRETCHES * SAMPLE;

pub fn run(arguments: Arguments) -> Result<bool> {
    match (arguments.verb, arguments.sweep) {
        (Some(Verb::Plan(at)), _) => plan(&Sweep::open(&at)?),
        (Some(Verb::Run { sweep: at, chunk, every, threads, long }), _) => {
            task::keep_to_processors(threads)?;
            let sweep = Sweep::open(&at)?;
            sweep.of.is_ordinary(&at.case, long)?;
            let wanted = task::chunks(chunk, every, sweep.grid().chunks())?;
            let _turn = sweep.take_turn(Sharing::WithOthers)?;
            sweep.work(&wanted)?;
            Ok(true)
        }
        (Some(Verb::Submit(arguments)), _) => submit::run(&arguments),
        (Some(Verb::Status(at)), _) => status(&Sweep::open(&at)?),
        (Some(Verb::Merge { sweep, wanted }), _) => {
            let sweep = Sweep::open(&sweep)?;
            sweep.is_whole()?;
            sweep.merge(&wanted, &sweep.take_turn(Sharing::Alone)?)
        }
        (None, Some(at)) => {
            let sweep = Sweep::open(&at)?;
            sweep.of.is_ordinary(&at.case, arguments.long)?;
            if arguments.dry_run {
                return estimate(&sweep);
            }
            sweep.is_ordinary_in_all(&at.case, arguments.long)?;
            let turn = sweep.take_turn(Sharing::Alone)?;
            sweep.work(&(0..sweep.grid().chunks()).collect::<Vec<_>>())?;
            sweep.merge(&arguments.wanted, &turn)
        }
        (None, None) => Err(miette!(
            help = "write for example `vinesink sweep map.toml`",
            "there is no case to sweep"
        )),
    }
}

/// A sweep and where its results are.
struct Sweep {
    of: Subject,
    case_text: String,
    /// The folder of all sweeps, the name of this one and its own folder there.
    out: PathBuf,
    name: String,
    folder: PathBuf,
}

impl Sweep {
    fn open(at: &Where) -> Result<Self> {
        let (case, text) = case_file::read_any(&at.case, at.reading())?;
        let name = case_file::name(&at.case)?;
        let of = Subject::of(case).ok_or_else(|| {
            miette!(
                help = "add a table [sweep]; `vinesink sweep --help` shows one",
                "{} does not say what to vary",
                at.case.display()
            )
        })?;
        Ok(Self { of, case_text: text, out: at.out.clone(), folder: at.out.join(&name), name })
    }

    fn grid(&self) -> &Grid {
        self.of.grid()
    }

    /// Whether all points together take as long as is ordinary, or more is asked for. Some are worked out to tell where
    /// there are many, or where they are not surely few enough.
    fn is_ordinary_in_all(&self, path: &Path, long: Long) -> Result<()> {
        let points = self.grid().points();
        let known = self.seconds(self.of.roughly());
        if points <= MANY && self.of.all_ordinary(path, long, known, "").is_ok() {
            return Ok(());
        }
        let seconds = self.seconds(self.seconds_of_a_point()?);
        self.of.all_ordinary(path, long, seconds, &format!("{points} points"))
    }

    /// Seconds of all points on all processors, from those of one.
    fn seconds(&self, each: f64) -> f64 {
        let at_once = rayon::current_num_threads().min(self.grid().chunks() as usize).max(1);
        each * self.grid().points() as f64 / at_once as f64
    }

    /// Seconds that a point takes, measured on some spread over the sweep.
    fn seconds_of_a_point(&self) -> Result<f64> {
        let plan = self.grid();
        let points = plan.points();
        // Whole chunks where a motion is followed, else a part of them.
        let chunk = plan.points_per_chunk();
        let stretch = if plan.settings.follow { chunk } else { SAMPLE.min(chunk) };
        let stretch = stretch.min(self.of.sample());
        let stretches = if plan.settings.follow { 1 } else { STRETCHES };
        if self.of.roughly() * stretch as f64 > LONGEST_SAMPLE {
            return Ok(self.of.roughly());
        }
        let begin = Instant::now();
        let progress = Progress::new("sample", stretches);
        let mut worked = 0;
        for k in 0..stretches {
            let from = (points - stretch.min(points)) * k / (STRETCHES - 1);
            let range = from..from + stretch.min(points);
            worked += range.end - range.start;
            self.of.points(range)?;
            progress.advance(1);
        }
        Ok(begin.elapsed().as_secs_f64() / worked.max(1) as f64)
    }

    fn shards(&self) -> Result<Shards> {
        let chunks = Path::new(&self.name).join("chunks");
        Ok(Shards::open(&self.out, &chunks, &self.grid().identity_of_chunks())?)
    }

    /// Waits until this process may work on the chunks, and says so.
    fn take_turn(&self, sharing: Sharing) -> Result<Turn> {
        Ok(self.shards()?.take_turn(sharing, |folder| {
            output::complain(&format!(
                "Another process works on this sweep in {}: waiting until it is done.",
                shown(folder)
            ));
        }))
    }

    /// Works out those of some chunks that are not there, on all processors. All are looked at before: what cannot be read, or
    /// is damaged, is said before hours of work and not after.
    fn work(&self, chunks: &[u64]) -> Result<()> {
        let shards = self.shards()?;
        let found = self.look(chunks)?;
        let unfit: Vec<u64> =
            found.iter().filter(|(_, found)| *found == Found::Unfit).map(|one| one.0).collect();
        if let [first, rest @ ..] = unfit.as_slice() {
            let others = match rest.len() {
                0 => String::new(),
                more => format!(" and {more} more"),
            };
            output::complain(&format!(
                "{}{others}: damaged, or of another sweep; worked out again.",
                shown(&shards.path(*first))
            ));
        }
        let missing = found.iter().filter(|(_, found)| *found != Found::Whole);
        let chunks: &[u64] = &missing.map(|one| one.0).collect::<Vec<_>>();
        let points = |chunk: &u64| self.grid().chunk(*chunk).count() as u64;
        let progress = Progress::new("points", chunks.iter().map(points).sum());
        // Each chunk on its own: in longer pieces a processor would be left with many at the end.
        let worked = chunks.into_par_iter().with_max_len(1).try_for_each(|chunk| {
            self.work_out(&shards, *chunk)?;
            progress.advance(points(chunk));
            Ok(())
        });
        worked.map_err(|error: miette::Report| {
            error.wrap_err(
                "the sweep stopped; what was worked out is kept, and the same command goes on",
            )
        })
    }

    fn work_out(&self, shards: &Shards, chunk: u64) -> Result<()> {
        if shards.holds(chunk)? {
            return Ok(());
        }
        let results = self.of.points(self.grid().chunk(chunk))?;
        let notes = vec![("vinesink.sweep".to_owned(), self.grid().identity.clone())];
        let bytes = parquet::file(&results, &notes).into_diagnostic()?;
        Ok(shards.keep(chunk, &bytes)?)
    }

    /// What is there of some chunks.
    fn look(&self, chunks: &[u64]) -> Result<Vec<(u64, Found)>> {
        let shards = self.shards()?;
        chunks.into_par_iter().map(|chunk| Ok((*chunk, shards.look(*chunk)?))).collect()
    }

    /// The chunks that are not there.
    fn missing(&self) -> Result<Vec<u64>> {
        let found = self.look(&(0..self.grid().chunks()).collect::<Vec<_>>())?;
        let missing = found.into_iter().filter(|(_, found)| *found != Found::Whole);
        Ok(missing.map(|(chunk, _)| chunk).collect())
    }
}

fn shown(path: &Path) -> String {
    path.display().to_string()
}

fn plan(sweep: &Sweep) -> Result<bool> {
    let Grid { settings, .. } = sweep.grid();
    let axes: Vec<String> =
        settings.axes.iter().map(|axis| axis.values.len().to_string()).collect();
    let motions = match (settings.axes.last(), settings.starts) {
        (Some(axis), _) if settings.follow => {
            format!("motions followed along {} up and down", axis.parameter.key())
        }
        (_, 1) => "1 start each".to_owned(),
        (_, starts) => format!("{starts} starts each"),
    };
    let chunks = match sweep.grid().chunks() {
        1 => "1 chunk (0)".to_owned(),
        chunks => format!("{chunks} chunks (0 to {})", chunks - 1),
    };
    output::print(format!(
        "{} = {} points, {motions}, in {chunks}\n",
        axes.join(" x "),
        sweep.grid().points()
    ))?;
    Ok(true)
}

fn status(sweep: &Sweep) -> Result<bool> {
    let missing = sweep.missing()?;
    let chunks = sweep.grid().chunks();
    output::print(format!("{} of {chunks} chunks are there\n", chunks - missing.len() as u64))?;
    Ok(missing.is_empty())
}

/// Works out some points spread over the sweep, and says how long all would take.
fn estimate(sweep: &Sweep) -> Result<bool> {
    plan(sweep)?;
    let each = sweep.seconds_of_a_point()?;
    output::print(format!(
        "about {} on {} processors ({:.3} ms a point)\n",
        duration(sweep.seconds(each)),
        rayon::current_num_threads(),
        1e3 * each
    ))?;
    Ok(true)
}
