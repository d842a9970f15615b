//! `vinesink simulate CASE`

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::Args;
use miette::{IntoDiagnostic, Result, miette};
use vinesink::analysis::Analysis;
use vinesink::case::Case;
use vinesink::regimes::Attractor;
use vinesink::report::console::Simulated;
use vinesink::simulation::{Impact, ImpactLog, Simulation};
use vinesink::store;
use vinesink::study::{self, LongTermMotions, Proof, StudyEffort};
use vinesink::system::State;

use super::budget::Work;
use super::case_file::{self, OneCase};
use super::output;
use super::progress::Progress;
use super::transient;

/// Simulate a case directly, impact by impact
///
/// Without --initial the case is simulated from many starts, because answers coexist: every
/// long-term motion is listed with the share of starts that led to it, and the numbers are those of
/// the moving one that most starts lead to. With --initial one trajectory is followed. A measurement
/// that is not to be trusted says why and what to do, and ends with exit code 1.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    one: OneCase,
    /// Excitation periods to measure [default: the case's, or 1000]
    #[arg(long, value_name = "N", value_parser = positive_number)]
    periods: Option<u64>,
    /// Excitation periods to leave out before measuring [default: the case's, or until the
    /// transient has faded]
    #[arg(long, value_name = "N", value_parser = whole_number)]
    discard: Option<u64>,
    /// One start at excitation phase 0 instead of many: lengths over the clearance, velocities per
    /// fast time tau = omega0 t
    #[arg(long, value_name = "X,XDOT,Y,YDOT", value_parser = state, allow_hyphen_values = true)]
    initial: Option<State>,
    /// Write every impact of the measured window to this file
    #[arg(long, value_name = "FILE.csv")]
    impacts: Option<PathBuf>,
}

const EXAMPLES: &str = "\
Examples:
  vinesink simulate cases/li2016-8hz-b15mm.toml
  vinesink simulate damper.toml --initial 0,0,0,1 --discard 0 --periods 50 --impacts impacts.csv

The CSV file has one line an impact: tau,side,x,xdot_before,xdot_after,ydot_before,ydot_after;
lengths over the clearance, tau counted from the start of the run, side +1 where x - y = +b.";

pub fn run(arguments: Arguments) -> Result<bool> {
    let OneCase { path, long, .. } = &arguments.one;
    let case = case_file::read(path)?;
    let Arguments { periods, discard, initial, impacts, .. } = &arguments;
    let given = [
        ("--periods", periods.is_some()),
        ("--discard", discard.is_some()),
        ("--initial", initial.is_some()),
        ("--impacts", impacts.is_some()),
    ];
    transient::without(&case, path, &given)?;
    if let Some(done) = transient::simulate(&arguments.one, &case)? {
        return Ok(done);
    }
    let effort = arguments.effort(&case);
    let mut work = vec![trajectory(&case, &effort)];
    if arguments.initial.is_none() {
        work.extend(Work::motions(&case, &effort));
    }
    long.allows(path, &case, &work)?;
    let (motion, found) = match arguments.initial {
        Some(start) => (follow(&case, start, &effort, &arguments)?, None),
        None => {
            let analysis = Analysis::of(&case.system()).into_diagnostic()?;
            let mut found = search(&analysis, &effort)?;
            let continued = StudyEffort { discard: Some(0), ..effort };
            let motion = found.followed(|start| follow(&case, start, &continued, &arguments))?;
            let none = || miette!("no start led anywhere; ask for more than 0 starts");
            let motion = motion.ok_or_else(none)?;
            (motion, Some(found))
        }
    };
    let proof = Proof::of(&case.system(), &motion);
    let (found, proof) = (found.as_ref(), proof.as_ref());
    let simulated = Simulated { case: &case, motion: &motion, proof, found };
    arguments.one.print(|| simulated.text(), || simulated.document())?;
    let doubts = motion.doubts();
    for doubt in &doubts {
        output::complain(&format!("not to be trusted: {}; {}", doubt.words(), doubt.advice()));
    }
    Ok(doubts.is_empty())
}

impl Arguments {
    fn effort(&self, case: &Case) -> StudyEffort {
        let asked = StudyEffort::of(&case.simulation);
        StudyEffort {
            periods: self.periods.unwrap_or(asked.periods),
            discard: self.discard.or(asked.discard),
            ..asked
        }
    }
}

fn trajectory(case: &Case, effort: &StudyEffort) -> Work {
    let left_out = effort.left_out(&case.system());
    Work::trajectory(case, left_out.saturating_add(effort.periods))
}

/// Follows one trajectory and writes its impacts if asked to.
fn follow(
    case: &Case,
    start: State,
    effort: &StudyEffort,
    arguments: &Arguments,
) -> Result<Attractor> {
    let mut simulation = Simulation::new(&case.system(), start, 0.0).into_diagnostic()?;
    let _progress = Progress::estimated("measuring", trajectory(case, effort).seconds());
    let window = effort.full_window(&case.system());
    let Some(path) = &arguments.impacts else {
        return Ok(Attractor::measure(&mut simulation, &window));
    };
    let mut log = ImpactLog::default();
    let motion = Attractor::measure_with(&mut simulation, &window, &mut log);
    store::write_file(path, csv(&log.impacts).as_bytes())?;
    Ok(motion)
}

/// Looks for all long-term motions of a case.
pub fn search(analysis: &Analysis, effort: &StudyEffort) -> Result<LongTermMotions> {
    let progress = Progress::new("simulating", u64::from(effort.starts));
    let mut advance = |done| progress.advance(done);
    study::long_term_motions(analysis, effort, &mut advance).into_diagnostic()
}

fn csv(impacts: &[Impact]) -> String {
    let mut text = String::from("tau,side,x,xdot_before,xdot_after,ydot_before,ydot_after\n");
    for impact in impacts {
        let side = if impact.side.sign() > 0.0 { "+1" } else { "-1" };
        // Rust prints the shortest text that reads back to the same number.
        let _ = writeln!(
            text,
            "{},{side},{},{},{},{},{}",
            impact.tau,
            impact.x,
            impact.x_velocity_before,
            impact.x_velocity_after,
            impact.y_velocity_before,
            impact.y_velocity_after
        );
    }
    text
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
