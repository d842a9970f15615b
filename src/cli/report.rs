//! `vinesink report CASE...`

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use clap::Args;
use miette::{Context as _, IntoDiagnostic, Result, miette};
use vinesink::answer::{Asked, Decided};
use vinesink::case::{Case, ModalCase};
use vinesink::case_input::AnyCase;
use vinesink::case_report::Report;
use vinesink::digest::{one_line_end, text_sha256};
use vinesink::excitation::Scene;
use vinesink::method::Method;
use vinesink::program::case_file::{self, Reading};
use vinesink::program::parallel::Parallel;
use vinesink::program::{cases, output, reports};
use vinesink::report::render::{self, Files};
use vinesink::report::{live, stored};
use vinesink::store::{self, Output};
use vinesink::study::fidelity::LayerPlan;

use super::budget::{self, Long, Work};
use super::{one_case, several};

/// Write the design report of each case
///
/// Writes report.md, report.html, report.json and figures/*.svg into OUT/<name of the case file>, in place
/// of those of an older report; all other files there stay, as those of `tradeoff` and `optimize`. A
/// report appears whole or not at all, and the same case gives the same bytes.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// The case files
    #[arg(value_name = "CASE", required = true)]
    cases: Vec<PathBuf>,
    /// The folder that receives a folder per case
    #[arg(long, value_name = "OUT", default_value = "reports")]
    out: PathBuf,
    /// The layer that answers [default: with [accuracy] in the case the cheapest that is exact enough,
    /// without it all of them, and simulation decides]
    #[arg(long, value_parser = one_case::layer(), value_name = "LAYER")]
    fidelity: Option<Method>,
    /// Write nothing; say which files in OUT are not as this would write them, which reports in OUT have no case any more, and
    /// exit with 1 if any. report.html is not looked at: it is the same report once more
    #[arg(long)]
    check: bool,
    /// Add the live page to report.html, which stays one file: PAGE, or `vinesink-live.html` beside the program
    #[arg(long, value_name = "PAGE", require_equals = true, conflicts_with = "check")]
    live: Option<Option<PathBuf>>,
    /// Without tuned mass dampers beside the absorber, and without the ranges over which criteria hold
    #[arg(long)]
    criteria_only: bool,
    #[command(flatten)]
    long: Long,
    #[command(flatten)]
    reading: Reading,
}

const EXAMPLES: &str = "\
Examples:
  vinesink report cases/li2016-8p5hz-fig4c.toml
  vinesink report cases/*.toml --out /somewhere/else
  vinesink report damper.toml --fidelity orbit     without any simulation
  vinesink report damper.toml --live               with sliders in report.html
  vinesink report --check cases/*.toml             are the reports in reports/ up to date?";

/// Seconds of theory, limits and figures, about.
const ORDINARY: f64 = 2.0;

pub fn run(arguments: Arguments) -> Result<bool> {
    let names = names(&arguments.cases)?;
    let mut failures = Vec::new();
    let mut holds = true;
    for (path, name) in arguments.cases.iter().zip(&names) {
        let folder = arguments.out.join(name);
        let done = match arguments.check {
            false => write(path, name, &arguments),
            true => check(path, name, &folder, &arguments),
        };
        match done {
            Ok(one) if arguments.check => holds &= one,
            Ok(one) => {
                holds &= one;
                let page = folder.join("report.md");
                // It is there, whether anybody is told or not.
                let told = output::print_path(&page);
                let told = told.wrap_err_with(|| format!("{} was written", page.display()));
                failures.extend(told.err());
            }
            Err(error) => {
                let not_done = if arguments.check { "checked" } else { "written" };
                let which = format!("no report was {not_done} for {}", path.display());
                failures.push(error.wrap_err(which));
            }
        }
    }
    if arguments.check {
        match without_case(&arguments, &names) {
            Ok((count, orphans)) => {
                orphans.iter().try_for_each(output::print)?;
                holds &= orphans.is_empty();
                let cases = counted(names.len(), "case");
                let (reports, out) = (counted(count, "report"), output::place(&arguments.out));
                output::complain(&format!("{cases} compared with {reports} in {out}"));
            }
            Err(error) => failures.push(error),
        }
    } else {
        reports::refresh(&arguments.out).unwrap_or_else(|error| failures.push(error));
    }
    // One bad case does not keep the others from being written; each is named.
    output::last_of(failures)?;
    Ok(holds)
}

fn counted(count: usize, word: &str) -> String {
    format!("{count} {word}{}", if count == 1 { "" } else { "s" })
}

/// How many reports there are, and a line for each whose case is neither among those that are checked, which have these
/// names, nor anywhere else.
fn without_case(arguments: &Arguments, names: &[String]) -> Result<(usize, Vec<String>)> {
    let out = &arguments.out;
    if !out.is_dir() {
        return Ok((0, Vec::new()));
    }
    let stored = store::read_reports(out, arguments.reading.reach())?;
    let project = cases::of_project(out);
    let beside = |name: &str| {
        let own = arguments.cases.iter().map(|path| path.with_file_name(format!("{name}.toml")));
        own.into_iter().any(|path| path.is_file())
    };
    let digest = |path: &PathBuf| {
        let text = store::read_text_if_there(path).ok().flatten();
        text.map(|text| text_sha256(&text))
    };
    let mut orphans = Vec::new();
    for (folder, report) in &stored {
        let name = folder.rsplit('/').next().unwrap_or(folder);
        let place = out.join(folder);
        if names.iter().any(|own| own == name)
            || beside(name)
            || cases::of_report(&place, name, &project).is_some()
        {
            continue;
        }
        let made_from = stored::read(&report.place, &report.json)?;
        let made_from = made_from["provenance"]["case_sha256"].as_str().map(str::to_owned);
        let renamed =
            arguments.cases.iter().find(|path| made_from.is_some() && digest(path) == made_from);
        let why = match renamed {
            Some(path) => format!("its case is now called {}", output::place(path)),
            None => format!("its case {name}.toml is gone"),
        };
        orphans.push(format!("{}: {why}; remove the folder\n", output::place(&place)));
    }
    Ok((stored.len(), orphans))
}

/// The folder's name for each case; two cases must not share one.
fn names(cases: &[PathBuf]) -> Result<Vec<String>> {
    let mut names: Vec<String> = Vec::new();
    for path in cases {
        let name = case_file::name(path)?;
        if names.contains(&name) {
            return Err(miette!(
                help = "rename one, or write them to different folders with --out",
                "two cases are called `{name}` and would overwrite each other's report"
            ));
        }
        names.push(name);
    }
    reports::warn_of_letter_case(&names);
    Ok(names)
}

/// Writes one report; what was asked of accuracy does not hold where a layer that was insisted on, or
/// the longest simulation, is not exact enough.
fn write(path: &Path, name: &str, arguments: &Arguments) -> Result<bool> {
    let (case, text) = case_file::read_any(path, arguments.reading)?;
    let case = match case {
        AnyCase::One(case) => *case,
        AnyCase::Several(case) => {
            let live = arguments.live.as_ref();
            let live = live.map(|page| live_page_of_several(page.as_deref(), path, &case));
            let live = live.transpose()?;
            let mut files = arguments.of_several(path, name, &case)?;
            with_live(&mut files, live, &text)?;
            Output::open(&arguments.out)?.replace(name, &files, render::is_of_report)?;
            return Ok(true);
        }
    };
    let live =
        arguments.live.as_ref().map(|page| live_page(page.as_deref(), path, &case)).transpose()?;
    let (mut files, holds) = rendered(path, name, &case, arguments)?;
    with_live(&mut files, live, &text)?;
    Output::open(&arguments.out)?.replace(name, &files, render::is_of_report)?;
    Ok(holds)
}

impl Arguments {
    /// The files of the report of a structure of several modes, without options about one.
    fn of_several(&self, path: &Path, name: &str, case: &ModalCase) -> Result<Files> {
        several::without(path, &[("--fidelity", self.fidelity.is_some())])?;
        several::report(path, name, case, self.decided(), self.long)
    }

    /// What is looked at beside the criteria.
    const fn decided(&self) -> Decided {
        if self.criteria_only { Decided::NOTHING } else { Decided::ALL }
    }
}

/// Puts the live page with a case of this text at the end of the report's page.
fn with_live(files: &mut Files, live: Option<(String, String)>, text: &str) -> Result<()> {
    let Some((page, live)) = live else { return Ok(()) };
    let file = files.entry("report.html".into()).or_default();
    let whole = live::embed(&String::from_utf8_lossy(file), &live, text).into_diagnostic();
    *file = whole.wrap_err(page)?.into_bytes();
    Ok(())
}

/// The live page for the report of a case, with its name.
fn live_page(page: Option<&Path>, path: &Path, case: &Case) -> Result<(String, String)> {
    if case.design.scene() != Scene::Steady {
        return Err(miette!(
            help = "leave out --live",
            "the live page shows steady vibration, which {} is not",
            path.display()
        ));
    }
    page_text(page)
}

/// The same of a structure of several modes.
fn live_page_of_several(
    page: Option<&Path>,
    path: &Path,
    case: &ModalCase,
) -> Result<(String, String)> {
    if case.modes_file.is_some() {
        return Err(miette!(
            help = "leave out --live, or write the modes as [[mode]]",
            "the live page cannot read the file of the modes of {}",
            path.display()
        ));
    }
    page_text(page)
}

/// The live page with its name: that which is given, or the one beside the program.
fn page_text(page: Option<&Path>) -> Result<(String, String)> {
    let page = match page {
        None => std::env::current_exe().into_diagnostic()?.with_file_name("vinesink-live.html"),
        Some(page) => page.to_owned(),
    };
    let live = store::read_text(&page)
        .wrap_err("--live needs the live page: `web/build` makes it, releases bring it along")?;
    Ok((page.display().to_string(), live))
}

/// Says which files of a report are not as [`write()`] would leave them.
fn check(path: &Path, name: &str, folder: &Path, arguments: &Arguments) -> Result<bool> {
    let is_checked = |file: &Path| render::is_of_report(file) && file != Path::new("report.html");
    let mut files = match case_file::read_any(path, arguments.reading)?.0 {
        AnyCase::One(case) => rendered(path, name, &case, arguments)?.0,
        AnyCase::Several(case) => arguments.of_several(path, name, &case)?,
    };
    files.retain(|file, _| is_checked(file));
    let mut there = store::read_folder(folder, is_checked)?;
    // A checkout may end lines otherwise.
    there.values_mut().for_each(|bytes| *bytes = one_line_end(bytes).into_owned());
    if there.is_empty() {
        output::print(format!("{}: there is no report\n", output::place(folder)))?;
        return Ok(false);
    }
    let all: BTreeSet<&PathBuf> = files.keys().chain(there.keys()).collect();
    let mut holds = true;
    for file in all {
        let why = match (files.get(file), there.get(file)) {
            (new, old) if new == old => continue,
            (Some(_), Some(_)) => "is not up to date",
            (Some(_), None) => "is missing",
            (None, _) => "is no longer part of the report",
        };
        output::print(format!("{}: {why}\n", output::place(&folder.join(file))))?;
        holds = false;
    }
    Ok(holds)
}

/// The files of a report, and whether it is exact enough and to be trusted.
fn rendered(path: &Path, name: &str, case: &Case, arguments: &Arguments) -> Result<(Files, bool)> {
    let plan = LayerPlan::of_case(case, arguments.fidelity).into_diagnostic()?;
    let work = Work::of(case, Asked::Report, plan.as_ref());
    arguments.long.allows(path, case, &work)?;
    let decides = arguments.long.decides(path, case, &work, arguments.decided());
    let besides = ORDINARY + budget::of_decision(case, decides);
    let _progress = budget::progress(name, case, &work, besides);
    let report = Report::of(name, case, plan.as_ref(), decides, &Parallel).into_diagnostic()?;
    // As `simulate`: what is not to be trusted is written down, and does not pass for an answer.
    let trusted = report.answer.trusted();
    if !trusted {
        output::complain(&format!(
            "{name}: a simulation is not to be trusted; its report says why"
        ));
    }
    Ok((report.files(case, &Parallel).into_diagnostic()?, trusted && report.answer.exact_enough()))
}
