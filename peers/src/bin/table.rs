//! Prints the table: every tool on the same work, in turns on the same core, vinesink before each.
//!
//! `table PYTHON SCRIPTS [ROUNDS]`: a Python with the packages of `requirements.txt`, the folder of the
//! scripts, and how often each tool runs. A slow tool runs fewer times.

use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

use vinesink_peers::diffsol::Tsit45;
use vinesink_peers::engine::Engine;
use vinesink_peers::judge::{self, Flights};
use vinesink_peers::runge_kutta::RungeKutta;
use vinesink_peers::script::Script;
use vinesink_peers::{CLEARANCES, Failure, Hit, Run, Tool, system};

const PERIODS: u64 = 2_000;
/// Periods over which impact times are compared with the reference.
const COMPARED: u64 = 50;
const ROUNDS: usize = 30;
/// Time after which a tool has run often enough, if it has run twice.
const ENOUGH: Duration = Duration::from_secs(10);
/// Tools that vinesink is compared with, in the order of the table, as script and argument.
const SCRIPTS: [(&str, &str); 5] = [
    ("scipy_peer.py", "1e-9"),
    ("scipy_peer.py", "1e-12"),
    ("numba_peer.py", "200"),
    ("numba_peer.py", "2000"),
    ("heyoka_peer.py", "1e-15"),
];

fn tools(python: &Path, scripts: &Path) -> Result<Vec<Box<dyn Tool>>, Failure> {
    let mut tools: Vec<Box<dyn Tool>> = Vec::new();
    for (script, argument) in SCRIPTS {
        tools.push(Box::new(Script::start(python, &scripts.join(script), argument)?));
    }
    for tolerance in [1e-6, 1e-9] {
        tools.push(Box::new(Tsit45 { tolerance }));
    }
    tools.push(Box::new(RungeKutta { steps: 200 }));
    tools.push(Box::new(Engine::StepByStep));
    tools.push(Box::new(Engine::Batch));
    Ok(tools)
}

/// Times of a tool, and of vinesink right before each.
#[derive(Default)]
struct Times {
    tool: Vec<Duration>,
    vinesink: Vec<Duration>,
    impacts: [u64; 2],
}

impl Times {
    fn best(of: &[Duration]) -> f64 {
        of.iter().min().map_or(f64::NAN, Duration::as_secs_f64)
    }

    /// Impacts per second, at best.
    fn rate(&self) -> f64 {
        self.impacts[0] as f64 / Self::best(&self.tool)
    }

    /// How many times as many impacts vinesink simulates in a second: the best times of either, and
    /// the median of the pairs.
    fn ratio(&self) -> [f64; 2] {
        let work = self.impacts[1] as f64 / self.impacts[0] as f64;
        let mut pairs: Vec<f64> = self
            .tool
            .iter()
            .zip(&self.vinesink)
            .map(|(tool, own)| tool.as_secs_f64() / own.as_secs_f64())
            .collect();
        pairs.sort_by(f64::total_cmp);
        [Self::best(&self.tool) / Self::best(&self.vinesink) * work, pairs[pairs.len() / 2] * work]
    }

    fn add(&mut self, tool: Run, vinesink: Run) {
        self.tool.push(tool.took);
        self.vinesink.push(vinesink.took);
        self.impacts = [tool.impacts, vinesink.impacts];
    }
}

/// All tools on one case, in turns.
fn race(tools: &mut [Box<dyn Tool>], clearance: f64, rounds: usize) -> Result<Vec<Times>, Failure> {
    let system = system(clearance);
    let mut times: Vec<Times> = tools.iter().map(|_| Times::default()).collect();
    for round in 0..rounds {
        for (tool, times) in tools.iter_mut().zip(&mut times) {
            if round >= 2 && times.tool.iter().sum::<Duration>() > ENOUGH {
                continue;
            }
            let vinesink = Engine::Single.run(&system, PERIODS)?;
            times.add(tool.run(&system, PERIODS)?, vinesink);
        }
    }
    Ok(times)
}

struct Worth {
    error: Option<f64>,
    flights: Flights,
}

fn worth(tool: &mut dyn Tool, truth: &[(f64, f64)]) -> Result<Worth, Failure> {
    let [periodic, chaotic] = CLEARANCES.map(system);
    let hits: Vec<Hit> = tool.hits(&periodic, COMPARED)?;
    let flights = judge::flights(&chaotic, &tool.hits(&chaotic, PERIODS)?);
    Ok(Worth { error: judge::error(&hits, truth), flights })
}

fn preparation(tool: &dyn Tool) -> String {
    tool.preparation().map_or("none".into(), |time| format!("{:.1} s", time.as_secs_f64()))
}

/// Two to three digits.
fn ratio(ratio: f64) -> String {
    if ratio < 10.0 { format!("{ratio:.1}") } else { format!("{ratio:.0}") }
}

fn error(error: Option<f64>) -> String {
    error.map_or("other impacts".into(), |error| format!("{error:.1e}"))
}

fn missed(flights: &Flights) -> String {
    let Flights { checked, missed, invented, deepest } = *flights;
    let mut text = format!("{missed} of {checked}");
    if missed > 0 {
        text += &format!(", up to {deepest:.0e} beyond the wall");
    }
    if invented > 0 {
        text += &format!("; {invented} that do not exist");
    }
    text
}

fn table(arguments: &[String]) -> Result<(), Failure> {
    let (python, scripts, rounds) = match arguments {
        [python, scripts] => (python, scripts, ROUNDS),
        [python, scripts, rounds] => (python, scripts, rounds.parse()?),
        _ => return Err("usage: table PYTHON SCRIPTS [ROUNDS]".into()),
    };
    let mut tools = tools(Path::new(python), Path::new(scripts))?;
    let truth = {
        let system = system(CLEARANCES[0]);
        judge::reference(&system, Engine::Single.hits(&system, COMPARED)?.len())
    };
    let mut races = Vec::new();
    for clearance in CLEARANCES {
        races.push(race(&mut tools, clearance, rounds)?);
    }
    println!(
        "| tool | impacts per second, b = {} / {} mm | error of impact times, {COMPARED} periods, \
         b = {} | impacts missed, b = {} | vinesink single takes less time by a factor of, best (median) | before the first run |",
        CLEARANCES[0], CLEARANCES[1], CLEARANCES[0], CLEARANCES[1]
    );
    println!("|---|---|---|---|---|---|");
    let mut own = [0.0_f64; 2];
    for (k, tool) in tools.iter_mut().enumerate() {
        let worth = worth(tool.as_mut(), &truth)?;
        let rates: Vec<String> =
            races.iter().map(|race| format!("{:.2e}", race[k].rate())).collect();
        let ratios: Vec<String> = races
            .iter()
            .map(|race| race[k].ratio())
            .map(|[best, median]| format!("{} ({})", ratio(best), ratio(median)))
            .collect();
        for (own, race) in own.iter_mut().zip(&races) {
            *own = own.max(race[k].impacts[1] as f64 / Times::best(&race[k].vinesink));
        }
        println!(
            "| {} | {} | {} | {} | {} | {} |",
            tool.name(),
            rates.join(" / "),
            error(worth.error),
            missed(&worth.flights),
            ratios.join(" / "),
            preparation(tool.as_ref()),
        );
    }
    let worth = worth(&mut Engine::Single, &truth)?;
    println!(
        "| {} | {:.2e} / {:.2e} | {} | {} | | none |",
        Engine::Single.name(),
        own[0],
        own[1],
        error(worth.error),
        missed(&worth.flights),
    );
    Ok(())
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match table(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("{failure}");
            ExitCode::from(2)
        }
    }
}
