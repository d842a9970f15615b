//! `vinesink optimize CASE`

use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::TypedValueParser;
use miette::{IntoDiagnostic, Result, miette};
use vinesink::case::{Case, ModalCase, Objective};
use vinesink::case_input::AnyCase;
use vinesink::case_optimum::Optimum;
use vinesink::excitation::Scene;
use vinesink::optimize::{Optimization, Task};
use vinesink::program::parallel::Parallel;
use vinesink::program::{case_file, output, reports};
use vinesink::report::{optimize as page, transient as clearance};
use vinesink::store;

use super::budget::Work;
use super::one_case::{self, Format, OneCase};
use super::several;

/// Choose the clearance, and on request restitution and mass, that serve a case best
///
/// Looks everywhere between the bounds of the case's table [optimize], or around the largest clearance at
/// which 1:1 resonance ends by theory, over its [band] if it has one. With a table [uncertainty] the best in expectation
/// stands beside the best as written. Every absorber that is shown was judged as `check` does, over the
/// whole band; the best of those that meet all criteria wins. Ends with exit code 1 if none meets them, or
/// none is better than the case's own.
///
/// For a structure that is released or struck it looks for the clearance with which it comes to rest
/// first; for one that is swept, or that a record drives, for that with the smallest largest displacement.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    one: OneCase,
    /// What to look for, instead of what the case says
    #[arg(long, value_parser = objectives())]
    objective: Option<Objective>,
    /// Also write optimize.md and its figures into OUT/<name of the case file>
    #[arg(long, value_name = "OUT")]
    out: Option<PathBuf>,
    /// Write the case with the optimum into a new file; comments stay, but for those behind a changed number that
    /// name another; nothing where there is no optimum
    #[arg(long, value_name = "FILE")]
    write: Option<PathBuf>,
    /// Write the robust optimum, the best in expectation, instead
    #[arg(long, requires = "write")]
    robust: bool,
}

const EXAMPLES: &str = "\
Examples:
  vinesink optimize cases/li2016-band.toml
  vinesink optimize damper.toml --objective worst-amplitude --write better.toml
  vinesink optimize damper.toml --out reports

A case says what it wants in
  [optimize]
  objective = \"z3-share\"
  clearance = [\"5 mm\", \"40 mm\"]

  [uncertainty]
  clearance = \"0.2 mm\"     # standard deviation
  restitution = \"± 0.05\"   # anywhere within";

/// Reads what a design is chosen for.
fn objectives() -> impl TypedValueParser<Value = Objective> {
    one_case::one_of(Objective::ALL.map(|objective| {
        let help = match objective {
            Objective::Z3Share => "Largest share of the band in area Z3 of the theory",
            Objective::StableShare => "Largest share of the band with a stable 1:1 orbit",
            Objective::WorstAmplitude => "Smallest worst amplitude over the band",
            Objective::Margin => {
                "Largest distance of the clearance from the ends of the stable 1:1 motion"
            }
        };
        (objective.name(), objective, help)
    }))
}

pub fn run(arguments: Arguments) -> Result<bool> {
    let OneCase { path, long, reading, .. } = &arguments.one;
    if let Some(new) = &arguments.write {
        store::must_be_new(new)?;
    }
    if arguments.out.is_some() {
        case_file::name(path)?;
    }
    let (case, text) = case_file::read_any(path, *reading)?;
    let case = match case {
        AnyCase::One(case) => *case,
        AnyCase::Several(case) => return several(&arguments, &case, &text),
    };
    let steady = case.design.scene() == Scene::Steady;
    if arguments.robust && !steady {
        return Err(miette!(
            help = "leave out --robust; what a release may be off by is `releases` in [optimize]",
            "{}: the case is not driven steadily, so that there is no robust optimum",
            path.display()
        ));
    }
    if arguments.robust && !case.uncertainty.is_any() {
        return Err(nothing_uncertain(path));
    }
    let given =
        [("--objective", arguments.objective.is_some()), ("--out", arguments.out.is_some())];
    one_case::without(&case, path, &given)?;
    let mut work = match steady {
        true => Work::designs(&Task::of(&case, arguments.objective).map_err(|error| {
            miette!(
                help = "give the excitation an amplitude above 0",
                "{}: {error}",
                path.display()
            )
        })?),
        false => Work::clearances(&case),
    };
    work.extend(Work::edges(&case));
    long.allows(path, &case, &work)?;
    let name = path.display().to_string();
    let found = Optimum::of(&name, &case, &text, arguments.objective, &Parallel);
    let found = found.into_diagnostic()?;
    let Some(search) = &found.search else {
        arguments
            .one
            .print(|| clearance::optimum_text(&case, &found.document), || &found.document)?;
        if let (Some(new), Some(better)) = (&arguments.write, &found.better) {
            store::write_new(new, better.text.as_bytes())?;
            arguments.tell(&format!("written: {}", new.display()), "")?;
        }
        return Ok(found.succeeds);
    };
    if let Some(out) = &arguments.out {
        reports::add_to_report(out, path, &page::files(&case, search).into_diagnostic()?)?;
    }
    let written = match &arguments.write {
        Some(new) => Some(written(new, &case, search, arguments.robust)?),
        None => None,
    };
    arguments.one.print(|| page::summary(&case, search), || &found.document)?;
    if let Some(line) = written {
        arguments.tell(&line, "\n")?;
    }
    Ok(found.succeeds)
}

/// That there is nothing that a robust optimum could allow for.
fn nothing_uncertain(path: &Path) -> miette::Report {
    miette!(
        help = "add a table [uncertainty], or leave out --robust",
        "{}: nothing is uncertain, so that there is no robust optimum",
        path.display()
    )
}

/// The same of a structure of several modes or absorbers.
fn several(arguments: &Arguments, case: &ModalCase, text: &str) -> Result<bool> {
    let path = &arguments.one.path;
    if arguments.objective == Some(Objective::Z3Share) {
        return Err(miette!(
            help = "ask for --objective stable-share, the same of the exact orbits of all modes",
            "{}: z3-share is an area of the theory of one mode and one absorber",
            path.display()
        ));
    }
    if arguments.robust && !case.uncertainty.is_any() {
        return Err(nothing_uncertain(path));
    }
    let asked = (arguments.objective, arguments.robust);
    let better = several::optimize(&arguments.one, case, text, asked, arguments.out.as_deref())?;
    if let (Some(new), Some(better)) = (&arguments.write, &better) {
        store::write_new(new, better.as_bytes())?;
        arguments.tell(&format!("written: {}", new.display()), "\n")?;
    } else if let Some(new) = &arguments.write {
        arguments.tell(&format!("not written: {}", new.display()), "\n")?;
    }
    Ok(better.is_some())
}

impl Arguments {
    /// What is said beside the result, after a text before it.
    fn tell(&self, line: &str, before: &str) -> Result<()> {
        match self.one.format {
            Format::Text => output::print(format!("{before}{line}\n"))?,
            Format::Json => output::complain(line),
        }
        Ok(())
    }
}

/// Writes the absorber that was asked for, if it meets all criteria and is better than the case's own, and says what
/// became of the file.
fn written(new: &Path, case: &Case, found: &Optimization, robust: bool) -> Result<String> {
    let robust = found.robust.as_ref().filter(|_| robust);
    let design = robust.map_or(&found.best, |robust| &robust.design);
    let better = found.improves() && design.is_feasible() && design.choice != found.own.choice;
    if better {
        let written = design.written.clone().with_fitting_comments(case).into_diagnostic()?;
        store::write_new(new, written.text.as_bytes())?;
    }
    let file = new.display().to_string();
    let design = Some(design).filter(|_| better);
    page::written(case, found, &file, design, robust.is_some()).into_diagnostic()
}
