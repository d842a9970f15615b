//! `vinesink simulate CASE`

use std::path::PathBuf;

use clap::Args;
use miette::{IntoDiagnostic, Result, miette};
use vinesink::answer::trajectory::{Impact, ImpactLog, followed};
use vinesink::answer::{Answer, Asked};
use vinesink::case::Case;
use vinesink::case_input::AnyCase;
use vinesink::excitation::Scene;
use vinesink::motions::{Effort, Measured};
use vinesink::program::parallel::Parallel;
use vinesink::program::{case_file, output};
use vinesink::report::console::Simulated;
use vinesink::report::document::Content;
use vinesink::report::transient as page;
use vinesink::store;
use vinesink::system::State;
use vinesink::transient::OneFlight;

use super::budget;
use super::budget::Work;
use super::one_case::{self, OneCase};
use super::{impacts, several};

/// Simulate a case directly, impact by impact
///
/// Without --initial every long-term motion is looked for, because several may coexist: those that can be
/// solved for, and those that many starts lead to. Each is listed with its share of the starts; the numbers
/// are those of the moving one that most starts lead to. With --initial one trajectory is followed. A measurement
/// that is not to be trusted says why and what to do, and ends with exit code 1.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    one: OneCase,
    /// Excitation periods to measure [default: the case's, or 1000]; of a released or shaken structure its own, of a
    /// sweep the first ones; of several modes or absorbers those of --impacts
    #[arg(long, value_name = "N", value_parser = positive_number)]
    periods: Option<u64>,
    /// Excitation periods to leave out before measuring [default: the case's, or until the
    /// transient has faded]
    #[arg(long, value_name = "N", value_parser = whole_number)]
    discard: Option<u64>,
    /// One start at excitation phase 0, or the beginning of a release, sweep or record, instead of many: lengths over
    /// the clearance, velocities per fast time tau = omega0 t
    #[arg(long, value_name = "X,XDOT,Y,YDOT", value_parser = state, allow_hyphen_values = true)]
    initial: Option<State>,
    /// Write every impact of the measured window to this file, of a release, sweep or record those from --initial or the
    /// worst place; of several modes or absorbers those of the motion in which the structure moves farthest under each load
    #[arg(long, value_name = "FILE.csv")]
    impacts: Option<PathBuf>,
}

const EXAMPLES: &str = "\
Examples:
  vinesink simulate cases/li2016-8hz-b15mm.toml
  vinesink simulate damper.toml --initial 0,0,0,1 --discard 0 --periods 50 --impacts impacts.csv
  vinesink simulate cases/footbridge-jump.toml --impacts impacts.csv
  vinesink simulate cases/several/floor.toml --impacts impacts.csv --periods 100

The CSV file has one line an impact: tau,side,x,xdot_before,xdot_after,ydot_before,ydot_after;
lengths over the clearance, tau counted from the start of the run, side +1 where x - y = +b.
Of several modes or absorbers the number of the absorber stands behind the side, from 1, and load,frequency,motion
at the end; lengths are over the absorber's own clearance, tau is in fast time of the first mode from excitation phase 0.";

pub fn run(arguments: Arguments) -> Result<bool> {
    let OneCase { path, long, reading, .. } = &arguments.one;
    arguments.impacts.as_deref().map_or(Ok(()), store::must_have_folder)?;
    let read = match arguments.initial {
        Some(_) => case_file::read_even_at_rest(path, *reading)?,
        None => case_file::read_any(path, *reading)?,
    };
    let case = match read.0 {
        AnyCase::One(case) => *case,
        AnyCase::Several(case) => {
            let Arguments { periods, discard, initial, impacts, .. } = &arguments;
            let given = [("--initial", initial.is_some()), ("--discard", discard.is_some())];
            several::without(path, &given)?;
            if periods.is_some() && impacts.is_none() {
                return Err(miette!(
                    help = "leave out --periods, or name a file with --impacts",
                    "{}: of several modes or absorbers --periods says how many excitation periods --impacts writes",
                    path.display()
                ));
            }
            return several::simulate(&arguments.one, &case, impacts.as_deref(), *periods);
        }
    };
    let Arguments { periods, discard, initial, impacts, .. } = &arguments;
    one_case::without(&case, path, &[("--discard", discard.is_some())])?;
    let one_flight = periods.is_some() || initial.is_some() || impacts.is_some();
    if case.design.scene() != Scene::Steady && one_flight {
        return arguments.flight(&case);
    }
    let effort = arguments.effort(&case);
    let work = match arguments.initial {
        Some(_) => {
            let left_out = effort.left_out(&case.system());
            vec![Work::trajectory(&case, left_out.saturating_add(effort.periods))]
        }
        None => Work::search(&case, &effort),
    };
    long.allows(path, &case, &work)?;
    let progress = budget::progress("simulating", &case, &work, 0.0);
    let mut log = match arguments.impacts {
        Some(_) => ImpactLog::default(),
        None => Measured::log(),
    };
    let (measured, answer) = match arguments.initial {
        Some(start) => {
            (followed(&case.system(), start, &effort, &mut log).into_diagnostic()?, None)
        }
        None => {
            let answer = Answer::with(&case, Asked::Motions, None, effort, &Parallel);
            let answer = answer.into_diagnostic()?;
            if arguments.one.print_transient(&case, &answer, Content::Simulation)? {
                return Ok(true);
            }
            let main = answer.main(&case, &mut log).into_diagnostic()?;
            let none = || miette!("no start led anywhere; ask for more than 0 starts");
            (main.ok_or_else(none)?, Some(answer))
        }
    };
    drop(progress);
    if let Some(file) = &arguments.impacts {
        impacts::write(file, &log.impacts)?;
    }
    let found = answer.as_ref().and_then(|answer| answer.motions.as_ref());
    let simulated = Simulated { case: &case, measured: &measured, found };
    arguments.one.print(|| simulated.text(), || simulated.document())?;
    let doubts = measured.doubts();
    for doubt in &doubts {
        output::complain(&format!("not to be trusted: {}; {}", doubt.words(), doubt.advice()));
    }
    Ok(doubts.is_empty())
}

impl Arguments {
    /// One flight of a structure that is not driven steadily, from a chosen start or from that of the worst place, under the
    /// first record.
    fn flight(&self, case: &Case) -> Result<bool> {
        let start = match self.initial {
            Some(start) => start,
            None => {
                self.one.long.allows(&self.one.path, case, &Work::search(case, &case.effort()))?;
                let answer = Answer::of(case, Asked::Motions, None, &Parallel).into_diagnostic()?;
                let study = answer.transient.as_ref();
                let start = study.and_then(|study| OneFlight::worst_start(case, study));
                start.ok_or_else(|| miette!("no start was flown; ask for more than 0 starts"))?
            }
        };
        let mut log = ImpactLog::default();
        let mut told = |impact: &Impact| log.impacts.push(*impact);
        let flown = OneFlight::of_case(case, start, self.periods, &mut told).transpose();
        let none = || miette!("{} is driven steadily", self.one.path.display());
        let document = page::flight(case, &flown.into_diagnostic()?.ok_or_else(none)?);
        self.one.print(|| page::flight_text(case, &document), || &document)?;
        if let Some(file) = &self.impacts {
            impacts::write(file, &log.impacts)?;
        }
        Ok(true)
    }

    fn effort(&self, case: &Case) -> Effort {
        let asked = case.effort();
        Effort {
            periods: self.periods.unwrap_or(asked.periods),
            discard: self.discard.or(asked.discard),
            ..asked
        }
    }
}

/// A whole number above 0, also as `1e6`.
fn positive_number(text: &str) -> Result<u64, String> {
    match whole_number(text)? {
        0 => Err("expected at least 1 period to measure".into()),
        number => Ok(number),
    }
}

/// A whole number, also as `1e6`.
fn whole_number(text: &str) -> Result<u64, String> {
    let plain = text.replace('_', "");
    if let Ok(number) = plain.parse() {
        return Ok(number);
    }
    match plain.parse::<f64>() {
        Ok(number) if (0.0..=1e15).contains(&number) && number.fract() == 0.0 => Ok(number as u64),
        _ => Err("expected a whole number, for example 1000 or 1e6".into()),
    }
}

fn state(text: &str) -> Result<State, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[x, x_velocity, y, y_velocity]) => Ok(State { x, x_velocity, y, y_velocity }),
        _ => Err("expected four numbers X,XDOT,Y,YDOT, for example 0,0.01,0,0".into()),
    }
}
