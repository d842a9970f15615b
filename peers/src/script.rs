//! Tools in other languages: a script that is started once and then takes one request a line. Its
//! clock, of time spent on the processor, runs inside, so that neither its start nor this conversation
//! counts.
//!
//! It opens with `ready SECONDS NAME`, the seconds it took to import and to compile. A request is
//! `run` or `hits`, then mass ratio, damping, restitution, frequency ratio, the force's coefficients
//! of sine and cosine, the start's four numbers and the periods. The answer is
//! `done SECONDS IMPACTS`; to `hits`, a line `time side x x' y'` for each impact comes first.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::Duration;

use vinesink::system::System;

use crate::{Failure, Hit, Run, START, Tool};

/// A running script.
pub struct Script {
    name: String,
    preparation: Duration,
    child: Child,
    requests: ChildStdin,
    answers: BufReader<ChildStdout>,
}

impl Script {
    /// Starts a script with an argument and waits until it is ready.
    ///
    /// # Errors
    /// When it cannot be started or says something else.
    pub fn start(python: &Path, script: &Path, argument: &str) -> Result<Self, Failure> {
        let mut child = Command::new(python)
            .arg(script)
            .arg(argument)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()?;
        let requests = child.stdin.take().ok_or("no standard input")?;
        let answers = BufReader::new(child.stdout.take().ok_or("no standard output")?);
        let mut script =
            Self { name: String::new(), preparation: Duration::ZERO, child, requests, answers };
        let line = script.line()?;
        let said = line.strip_prefix("ready ").and_then(|rest| rest.split_once(' '));
        let (seconds, name) = said.ok_or_else(|| format!("not ready: {line}"))?;
        script.name = name.to_owned();
        script.preparation = Duration::from_secs_f64(seconds.parse()?);
        Ok(script)
    }

    fn line(&mut self) -> Result<String, Failure> {
        let mut line = String::new();
        if self.answers.read_line(&mut line)? == 0 {
            return Err(format!("{} ended", self.name).into());
        }
        Ok(line.trim_end().to_owned())
    }

    fn ask(
        &mut self,
        what: &str,
        system: &System,
        periods: u64,
    ) -> Result<(Run, Vec<Hit>), Failure> {
        let (sine, cosine) = system.excitation_amplitudes();
        writeln!(
            self.requests,
            "{what} {:?} {:?} {:?} {:?} {sine:?} {cosine:?} {:?} {:?} {:?} {:?} {periods}",
            system.mass_ratio(),
            system.damping(),
            system.restitution(),
            system.frequency_ratio(),
            START.x,
            START.x_velocity,
            START.y,
            START.y_velocity,
        )?;
        self.requests.flush()?;
        let mut hits = Vec::new();
        loop {
            let line = self.line()?;
            let words: Vec<&str> = line.split(' ').collect();
            match words[..] {
                ["done", seconds, impacts] => {
                    let took = Duration::from_secs_f64(seconds.parse()?);
                    return Ok((Run { took, impacts: impacts.parse()? }, hits));
                }
                [time, side, x, x_velocity, y_velocity] => hits.push(Hit {
                    time: time.parse()?,
                    side: side.parse()?,
                    x: x.parse()?,
                    x_velocity: x_velocity.parse()?,
                    y_velocity: y_velocity.parse()?,
                }),
                _ => return Err(format!("{} says: {line}", self.name).into()),
            }
        }
    }
}

impl Drop for Script {
    fn drop(&mut self) {
        // It may have ended already; there is nobody to tell.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Tool for Script {
    fn name(&self) -> String {
        self.name.clone()
    }

    fn preparation(&self) -> Option<Duration> {
        Some(self.preparation)
    }

    fn run(&mut self, system: &System, periods: u64) -> Result<Run, Failure> {
        Ok(self.ask("run", system, periods)?.0)
    }

    fn hits(&mut self, system: &System, periods: u64) -> Result<Vec<Hit>, Failure> {
        Ok(self.ask("hits", system, periods)?.1)
    }
}
