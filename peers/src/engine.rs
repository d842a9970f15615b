//! vinesink's own engines.

use vinesink::simulation::{Detail, Impact, Observer, Simulation, Stop, batch};
use vinesink::system::{State, System};

use crate::{Failure, Hit, Run, START, Tool, timed};

/// Which of them. A further one needs a variant, a name and a line where it runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Engine {
    /// One trajectory.
    Single,
    /// One trajectory, by the slow and finer search alone.
    StepByStep,
    /// [`TRAJECTORIES`] of them side by side; the first starts as the others' tools do, the rest a
    /// little faster each.
    Batch,
}

/// Trajectories of a batch: four times what flies side by side, so that lanes are refilled.
const TRAJECTORIES: u32 = 64;

impl Engine {
    pub const ALL: [Self; 3] = [Self::Single, Self::StepByStep, Self::Batch];

    /// As it is called on a command line.
    pub fn word(self) -> &'static str {
        match self {
            Self::Single => "single",
            Self::StepByStep => "step-by-step",
            Self::Batch => "batch",
        }
    }

    /// The engine of that name.
    pub fn named(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|engine| engine.word() == word)
    }

    fn simulation(self, system: &System) -> Simulation {
        let simulation = Simulation::new(system, START, 0.0).expect("inside the cavity");
        match self {
            Self::Single | Self::Batch => simulation,
            Self::StepByStep => simulation.step_by_step(),
        }
    }

    /// Impacts of all trajectories in so many periods.
    pub fn impacts(self, system: &System, periods: u64) -> Result<u64, Failure> {
        if self == Self::Batch {
            let mut simulations = together(system);
            let mut nobody: Vec<()> = vec![(); simulations.len()];
            let stops = batch::run(&mut simulations, periods, u64::MAX, &mut nobody);
            return match stops.iter().find(|stop| **stop != Stop::EndTime) {
                None => Ok(simulations.iter().map(Simulation::impacts).sum()),
                Some(stop) => Err(format!("a run ended at {}", stop.words()).into()),
            };
        }
        let mut simulation = self.simulation(system);
        match simulation.run(periods, u64::MAX, &mut ()) {
            Stop::EndTime => Ok(simulation.impacts()),
            stop => Err(format!("the run ended at {}", stop.words()).into()),
        }
    }
}

/// The trajectories of a batch.
fn together(system: &System) -> Vec<Simulation> {
    (0..TRAJECTORIES)
        .map(|k| {
            let faster = 1.0 + f64::from(k) / f64::from(TRAJECTORIES);
            let start = State { x_velocity: START.x_velocity * faster, ..START };
            Simulation::new(system, start, 0.0).expect("inside the cavity")
        })
        .collect()
}

#[derive(Default)]
struct Hits(Vec<Hit>);

impl Observer for Hits {
    fn detail(&self) -> Detail {
        Detail::Events
    }
    fn impact(&mut self, impact: &Impact) {
        self.0.push(Hit {
            time: impact.tau,
            side: impact.side.sign(),
            x: impact.x,
            x_velocity: impact.x_velocity_after,
            y_velocity: impact.y_velocity_after,
        });
    }
}

impl Tool for Engine {
    fn name(&self) -> String {
        format!("vinesink {}, {}", version(), self.word())
    }

    fn run(&mut self, system: &System, periods: u64) -> Result<Run, Failure> {
        timed(|| self.impacts(system, periods))
    }

    fn hits(&mut self, system: &System, periods: u64) -> Result<Vec<Hit>, Failure> {
        if *self == Self::Batch {
            let mut simulations = together(system);
            let mut hits: Vec<Hits> = simulations.iter().map(|_| Hits::default()).collect();
            batch::run(&mut simulations, periods, u64::MAX, &mut hits);
            return Ok(hits.swap_remove(0).0);
        }
        let mut hits = Hits::default();
        self.simulation(system).run(periods, u64::MAX, &mut hits);
        Ok(hits.0)
    }
}

/// vinesink's, as its manifest says.
fn version() -> &'static str {
    let manifest = include_str!("../../Cargo.toml");
    let line = manifest.lines().find_map(|line| line.strip_prefix("version = "));
    line.map_or("", |quoted| quoted.trim_matches('"'))
}
