//! `vinesink new NAME`

mod ask;

use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::PossibleValuesParser;
use miette::{IntoDiagnostic, Result, miette};
use vinesink::case::{Case, ModalCase, Objective, StartingModes, excitation_kinds};
use vinesink::criteria::all_hold;
use vinesink::optimize::Task;
use vinesink::optimize::guess::resistance;
use vinesink::program::output;
use vinesink::program::parallel::Parallel;
use vinesink::proposal::{Drive, Proposal, Wish, Wishes};
use vinesink::report::proposal;
use vinesink::store;

use super::budget::{Long, Work};
use super::modes;

/// Write a commented case to start from
///
/// Writes NAME.toml, in the current folder or under the path given. An existing file is never
/// overwritten.
///
/// With --guide, or with what is known of a structure, it proposes an absorber: mass, clearance and
/// restitution by closed forms, judged as `check` judges the case that is written. Ends with exit code 1 if
/// the limit cannot be met; the best that was found is written then.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// Name or path of the case, with or without `.toml`
    #[arg(value_name = "NAME")]
    path: PathBuf,
    /// What drives the structure, or sets it in motion [default: base-displacement]
    #[arg(long, value_name = "KIND", value_parser = PossibleValuesParser::new(excitation_kinds()))]
    #[arg(conflicts_with_all = ["guide", "Known"])]
    kind: Option<String>,
    /// A structure of several modes instead of one: their number, or a file of them as `vinesink modes` lists it
    #[arg(long, value_name = "N|FILE", conflicts_with_all = ["guide", "kind", "Known"])]
    modes: Option<String>,
    /// Ask on the terminal for what is known, and propose an absorber
    #[arg(long)]
    guide: bool,
    #[command(flatten)]
    known: Known,
    #[command(flatten)]
    long: Long,
}

/// What is known of a structure, each as in a case file, such as "30 kg".
#[derive(Debug, Args)]
#[command(next_help_heading = "Propose an absorber")]
struct Known {
    /// Mass of the structure, of a mode its modal mass
    #[arg(long, value_name = "MASS")]
    mass: Option<String>,
    /// Its natural frequency
    #[arg(long, value_name = "FREQUENCY")]
    frequency: Option<String>,
    /// Its damping ratio, such as "0.5 %"
    #[arg(long, value_name = "SHARE")]
    damping: Option<String>,
    /// Amplitude of a harmonic force on it
    #[arg(long, value_name = "FORCE", conflicts_with_all = ["base", "release"])]
    force: Option<String>,
    /// Amplitude of a harmonic motion of its base
    #[arg(long, value_name = "LENGTH", conflicts_with = "release")]
    base: Option<String>,
    /// Displacement from which it is let go
    #[arg(long, value_name = "LENGTH")]
    release: Option<String>,
    /// Largest displacement that is allowed; with --release the longest time down to a tenth
    #[arg(long, value_name = "LIMIT")]
    limit: Option<String>,
    /// Excitation frequencies that occur [default: 10 % about the natural frequency]
    #[arg(long, value_names = ["FROM", "TO"], num_args = 2, conflicts_with = "release")]
    band: Option<Vec<String>>,
    /// Mass of the absorber over that of the structure [default: the smallest that holds the limit]
    #[arg(long, value_name = "SHARE")]
    mass_ratio: Option<String>,
    /// Restitution of its walls [default: 0.3]
    #[arg(long, value_name = "NUMBER")]
    restitution: Option<String>,
}

const EXAMPLES: &str = "\
Examples:
  vinesink new damper                write damper.toml
  vinesink new jump --kind impulse   the same for a structure that is struck
  vinesink new floor --modes 3       one of three modes
  vinesink new mast --modes mast.csv the modes of a file, which must be in the folder of the case or below it
  vinesink new cases/footbridge      write cases/footbridge.toml; the folder must exist
  vinesink new damper --guide        ask for the structure, and propose an absorber
  vinesink new damper --mass \"30 kg\" --frequency \"6.9 Hz\" --damping \"0.5 %\" --force \"14 N\" --limit \"4 mm\"";

/// What a proposal needs, whatever else is known.
const NEEDED: &str = "--mass, --frequency, --damping, and one of --force, --base and --release";
const FURTHER: &str = "--limit, --band, --mass-ratio and --restitution";

impl Known {
    fn drive(&self) -> Option<Drive> {
        let all = [
            (&self.force, Drive::Force),
            (&self.base, Drive::Base),
            (&self.release, Drive::Release),
        ];
        all.into_iter().find(|(given, _)| given.is_some()).map(|(_, drive)| drive)
    }

    /// What was given, with the flags that say it.
    fn given(&self) -> Vec<(Wish, &'static str, Vec<String>)> {
        let one = |wish, flag, given: &Option<String>| {
            given.as_ref().map(|given| (wish, flag, vec![given.clone()]))
        };
        let band = self.band.as_ref().map(|ends| (Wish::Band, "--band", ends.clone()));
        let all = [
            one(Wish::Mass, "--mass", &self.mass),
            one(Wish::Frequency, "--frequency", &self.frequency),
            one(Wish::Damping, "--damping", &self.damping),
            one(Wish::Excitation, "--force", &self.force),
            one(Wish::Excitation, "--base", &self.base),
            one(Wish::Excitation, "--release", &self.release),
            one(Wish::Limit, "--limit", &self.limit),
            band,
            one(Wish::MassRatio, "--mass-ratio", &self.mass_ratio),
            one(Wish::Restitution, "--restitution", &self.restitution),
        ];
        all.into_iter().flatten().collect()
    }

    /// The same as wishes; what is missing is asked for, or refused.
    fn wishes(&self, guide: bool) -> Result<Wishes> {
        if guide {
            ask::needs_terminal()?;
        }
        let drive = match self.drive() {
            None if guide => Some(ask::drive()?),
            drive => drive,
        };
        let all = self.given();
        for (wish, flag, given) in &all {
            if let Some(problem) = wish.refused(drive.unwrap_or(Drive::Force), given) {
                let help = problem.help.unwrap_or(problem.expected);
                let given = given.join(" ");
                return Err(miette!(help = help, "{flag} {given}: {}", problem.message));
            }
        }
        let given: Vec<_> = all.into_iter().map(|(wish, _, given)| (wish, given)).collect();
        let has = |wish| given.iter().any(|(one, _)| *one == wish);
        let needed = [Wish::Mass, Wish::Frequency, Wish::Damping, Wish::Excitation];
        match drive {
            Some(drive) if guide => ask::further(Wishes { drive, given }),
            Some(drive) if needed.into_iter().all(has) => Ok(Wishes { drive, given }),
            _ => Err(miette!(
                help = "add what is missing, or --guide, which asks for it on a terminal",
                "a proposal needs {NEEDED}"
            )),
        }
    }
}

pub fn run(arguments: Arguments) -> Result<bool> {
    // Also behind a dot that is part of the name, as in `8.5hz`.
    let path = match arguments.path.extension() {
        Some(extension) if extension == "toml" => arguments.path.clone(),
        _ => arguments.path.with_added_extension("toml"),
    };
    let title = path.file_stem().ok_or_else(|| {
        miette!(
            help = "write for example `vinesink new damper`",
            "`{}` is not a file's name",
            arguments.path.display()
        )
    })?;
    let title = title.to_string_lossy();
    if arguments.guide || !arguments.known.given().is_empty() {
        return arguments.propose(&path, &title);
    }
    let text = match (&arguments.modes, &arguments.kind) {
        (Some(modes), _) => {
            store::must_be_new(&path)?;
            of_modes(&path, &title, modes)?
        }
        (None, Some(kind)) => Case::starting_text_of(&title, kind),
        (None, None) => Case::starting_text(&title),
    };
    store::write_new(&path, text.as_bytes())?;
    output::print_path(&path)?;
    Ok(true)
}

/// The text of a case of so many modes, or of those of a file.
fn of_modes(path: &Path, title: &str, asked: &str) -> Result<String> {
    let (modes, file) = match asked.parse::<i64>() {
        Ok(count) => {
            let modes = usize::try_from(count).ok().and_then(StartingModes::uniform);
            let modes = modes.ok_or_else(|| {
                miette!(
                    help = "write for example --modes 3, or --modes FILE with a file of modes",
                    "--modes {count}: a case has 1 to {} modes",
                    StartingModes::MOST
                )
            })?;
            (modes, None)
        }
        Err(_) if !Path::new(asked).exists() => {
            return Err(miette!(
                help = "write a number, as in --modes 3, or the path of a file that `vinesink modes FILE` lists",
                "--modes {asked}: there is no such file"
            ));
        }
        Err(_) => {
            let file = modes::read(Path::new(asked))?;
            (StartingModes::of_file(&file, &beside(path, Path::new(asked))?)?, Some(file))
        }
    };
    let text = ModalCase::starting_text(title, &modes, resistance(modes.resists()));
    // Nobody is left with a case that cannot be read, as of places whose names break a table.
    ModalCase::parse_with(&path.display().to_string(), &text, file)?;
    Ok(text)
}

/// What a case calls a file that is in its folder or below it.
fn beside(case: &Path, file: &Path) -> Result<String> {
    let within = store::below(case.parent().unwrap_or(Path::new("")), file)?.ok_or_else(|| {
        miette!(
            help = "copy the file into the folder of the case, or write the case beside the file",
            "{} is not in the folder of {}: a case reads what is in its folder or below",
            file.display(),
            case.display()
        )
    })?;
    // Case files have one separator everywhere.
    let parts: Vec<_> = within.iter().map(|part| part.to_string_lossy()).collect();
    Ok(parts.join("/"))
}

impl Arguments {
    /// Writes a case with an absorber that is proposed; whether its limit holds.
    fn propose(&self, path: &Path, title: &str) -> Result<bool> {
        store::must_be_new(path)?;
        let wishes = self.known.wishes(self.guide)?;
        let first = wishes.first(title).map_err(|error| *error)?;
        let work = match Task::of(&first, Some(Objective::WorstAmplitude)) {
            Ok(task) if first.design.transient().is_none() => Work::designs(&task),
            _ => Work::clearances(&first),
        };
        self.long.allows(path, &first, &work)?;
        let found = Proposal::of(title, &wishes, &Parallel).into_diagnostic()?;
        store::write_new(path, found.text.as_bytes())?;
        let file = output::word(&output::place(path));
        output::print(proposal::text(&found, &file).into_diagnostic()?)?;
        Ok(all_hold(&found.answer.judged))
    }
}
