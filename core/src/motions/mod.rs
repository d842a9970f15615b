//! Every long-term motion of a system at an excitation: found once, identified once, read by everybody.
//!
//! [`motions`] solves for what can be solved, every orbit with one impact on each wall per period that attracts and the
//! absorber at rest; then it flies starts, sees what each ends in, proves a repetition by Newton's method, and flies on
//! what has not settled. [`along`] does so at the places of a band that its largest motion asks for.
//!
//! Two ends are one motion by this table and no other (`identity`):
//!
//! | kinds | one motion if |
//! | --- | --- |
//! | at rest | always: a damped structure has one steady motion without impacts |
//! | orbits | the same cycle to 1e-6, mirror images included |
//! | repetitions that no solver of orbits covers | impacts, periods and walls are equal; `C`, `E` and peak to 1e-3 |
//! | wandering | root mean square and impacts per period within twice both errors |
//! | different kinds | never: what may settle is flown on, not compared |
//!
//! Lengths are over the clearance, in fast time.

mod along;
mod between;
mod cluster;
mod facts;
mod flight;
mod follow;
mod identity;
mod line;
mod listed;
mod measured;
mod modal;
mod model;
mod of_band;
mod one;
mod patience;
mod repetition;
mod rest;
mod sampler;
mod search;
mod section;
mod settling;
mod shaking;
mod share;
mod solved;
mod stability;
pub mod starts;
mod watch;

use serde::Serialize;

pub use along::{Along, along, along_until};
pub use facts::{Facts, Value};
pub use follow::{DiagramError, DiagramPoint, SweepDirection, carried_over, follow, sweep};
pub use identity::orbit_of;
pub use line::{Line, Purpose, Site};
pub use measured::{Measured, Window, measured};
pub use modal::{
    ModalEffort, ModalMotion, SensorExtent, longest_flight, modal_at_rest, modal_motions,
};
pub use repetition::Repetition;
pub use rest::{Rest, RestKind};
pub use sampler::{BandEffort, Misses, Sampled, Sampling, sampled};
pub use search::motions;
pub use section::{Section, sections};
pub use settling::{SettlingTime, window as longest_window};
pub use share::wilson;
pub use solved::{at_rest, one_to_one, steady};
pub use stability::{Extreme, Fact, stability};

use crate::orbits::Orbit;
use crate::regimes::Regime;
use crate::simulation::Stop;
use crate::system::{State, System};

/// Share of the resting places below which nobody will meet an absorber that stays at rest.
pub const NEGLIGIBLE: f64 = 0.01;

/// How thoroughly motions are searched. The same for every command on a case.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Effort {
    /// Evenly spread starts; shares of 32 are good to about 9 %.
    pub starts: u32,
    /// Excitation periods left out before a start is measured; none for as many as [`SettlingTime`] says.
    pub discard: Option<u64>,
    /// Excitation periods over which a motion that does not repeat is measured, its window.
    pub periods: u64,
    /// Part of the usual patience with what has not settled: 1; less where designs are only ranked.
    #[serde(skip)]
    pub patience: f64,
    /// Impacts per natural or excitation period, whichever is shorter, from which on a trajectory is given up: many
    /// impacts are a regime already.
    #[serde(skip)]
    pub most_impacts: u64,
    /// Largest relative error of the root mean square displacement, and error of the impacts per period, to which a motion
    /// that wanders is measured; none where its window will do.
    #[serde(skip)]
    pub accuracy: Option<[f64; 2]>,
    /// Relative error of a largest value from which on what wanders is measured for longer, for up to sixteen times as long.
    #[serde(skip)]
    pub vague: f64,
    /// What a band asks for beside that.
    #[serde(skip)]
    pub band: BandEffort,
    /// Whether velocity and acceleration of the structure are measured as well.
    #[serde(skip)]
    pub shaking: bool,
}

impl Default for Effort {
    fn default() -> Self {
        Self {
            starts: 32,
            discard: None,
            periods: 1000,
            patience: 1.0,
            most_impacts: 1000,
            accuracy: None,
            vague: 0.3,
            band: BandEffort::FULL,
            shaking: false,
        }
    }
}

impl Effort {
    /// The same with short windows and no patience with what has not settled then: what is found stays, errors of irregular
    /// motions are larger.
    #[must_use]
    pub fn short(&self) -> Self {
        const PERIODS: u64 = 300;
        Self { periods: self.periods.min(PERIODS), patience: 0.0, ..*self }
    }

    /// Windows of so many periods, all else as usual.
    pub fn over(periods: u64) -> Self {
        Self { periods, ..Self::default() }
    }
}

/// A system at an excitation, and where its motions begin.
#[derive(Debug, Clone, PartialEq)]
pub struct Place {
    /// The system.
    pub system: System,
    /// Starts at excitation phase 0 that are counted.
    pub starts: Vec<State>,
    /// Starts that are not: motions of a neighbour.
    pub further: Vec<State>,
    /// Motions that are known already; they keep their places in the list.
    pub known: Vec<Motion>,
    /// Share of [`Effort::patience`] with what may be a transient, 0 to 1: less than 1 where that was told from one beside it.
    pub patience: f64,
    /// Whether each start is flown for as long as where a search has all [`Effort::starts`], and for longer where others have
    /// left what it is on.
    pub in_full: bool,
}

impl Place {
    /// A system with so many evenly spread starts.
    pub fn new(system: &System, starts: u32) -> Self {
        Self::with(system, starts::spread(system, starts).collect())
    }

    /// A system with starts of its own.
    pub fn with(system: &System, starts: Vec<State>) -> Self {
        Self {
            system: *system,
            starts,
            further: Vec::new(),
            known: Vec::new(),
            patience: 1.0,
            in_full: false,
        }
    }
}

/// What a motion is, and thereby how surely it is known.
#[derive(Debug, Clone, PartialEq)]
pub enum MotionKind {
    /// The absorber takes no part: there is no impact.
    Rest(Rest),
    /// A proven periodic orbit that attracts.
    Orbit(Box<Orbit>),
    /// It was seen to repeat, and no solver of orbits covers it: the absorber rests on a wall, its slip reverses, or
    /// it has more than 64 impacts.
    Repeats(Repetition),
    /// It never repeats: it is known by averages.
    Wanders,
}

/// How starts led to a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct Reached {
    /// How many of the counted starts; 0 where it attracts and no start led to it.
    pub starts: u32,
    /// How many of them out of a transient that looked like a motion of its own.
    pub late: u32,
    /// Excitation periods after which the last of those was over; else those from the first start to the motion.
    pub followed: u64,
    /// Whether it was solved for before any start was flown.
    pub solved: bool,
}

/// Why a motion does not count for criteria.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum WhyNot {
    /// An absorber at rest that fewer than one in a hundred resting places lead to, and no start.
    BelowThreshold,
    /// The case leaves absorbers at rest out.
    LeftOut,
}

/// A long-term motion. There is no other way to one than a search.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    facts: Facts,
    kind: MotionKind,
    regime: Regime,
    state: State,
    reached: Reached,
    settled: bool,
    stop: Stop,
}

impl Motion {
    /// Its numbers.
    pub fn facts(&self) -> &Facts {
        &self.facts
    }

    /// What it is.
    pub fn kind(&self) -> &MotionKind {
        &self.kind
    }

    /// The name of its kind in documents.
    pub fn kind_name(&self) -> &'static str {
        match self.kind {
            MotionKind::Rest(_) => "rest",
            MotionKind::Orbit(_) => "orbit",
            MotionKind::Repeats(_) => "repeats",
            MotionKind::Wanders => "wanders",
        }
    }

    /// What its impacts do.
    pub fn regime(&self) -> Regime {
        self.regime
    }

    /// A state on it, at excitation phase 0; of one that wanders where its window begins.
    pub fn state(&self) -> State {
        self.state
    }

    /// How starts led to it.
    pub fn reached(&self) -> Reached {
        self.reached
    }

    /// Whether it is over with settling: it is solved for, repeats, or wanders with averages that do not drift and no
    /// start leaving it. If not, it may be a transient.
    pub fn settled(&self) -> bool {
        self.settled
    }

    /// Why its measurement ended: at the limit on impacts the numbers are those of a part.
    pub fn stop(&self) -> Stop {
        self.stop
    }

    /// The same where the absorber is at rest.
    pub fn rest(&self) -> Option<&Rest> {
        if let MotionKind::Rest(rest) = &self.kind { Some(rest) } else { None }
    }

    /// The proven orbit that it is.
    pub fn orbit(&self) -> Option<&Orbit> {
        if let MotionKind::Orbit(orbit) = &self.kind { Some(orbit) } else { None }
    }

    /// Whether it was solved for, so that along a band its extremes are known without places.
    pub fn is_solved(&self) -> bool {
        self.reached.solved
    }

    /// Excitation periods after which it repeats.
    pub fn repeats_after(&self) -> Option<u32> {
        match &self.kind {
            MotionKind::Rest(_) => Some(1),
            MotionKind::Orbit(orbit) => Some(orbit.cycle.periods()),
            MotionKind::Repeats(repetition) => Some(repetition.periods),
            MotionKind::Wanders => None,
        }
    }

    /// Largest modulus of the multipliers over one excitation period; none at rest, and where none is known.
    pub fn largest_multiplier(&self) -> Option<f64> {
        match &self.kind {
            MotionKind::Orbit(orbit) => Some(orbit.radius_per_period()),
            MotionKind::Repeats(repetition) => repetition.multiplier,
            MotionKind::Rest(_) | MotionKind::Wanders => None,
        }
    }

    /// Whether it has one impact on each wall in every excitation period, steadily: 1:1 resonance, symmetric or not.
    pub fn is_one_to_one(&self) -> bool {
        let walls = match &self.kind {
            MotionKind::Orbit(orbit) => orbit.cycle.sequence(),
            MotionKind::Repeats(repetition) => repetition.walls(),
            MotionKind::Rest(_) | MotionKind::Wanders => return false,
        };
        walls == "+-" && self.repeats_after() == Some(1)
    }

    /// Why it does not count; `count_rest` says whether absorbers at rest do.
    pub fn why_not(&self, count_rest: bool) -> Option<WhyNot> {
        WhyNot::of(self.rest().map(|rest| rest.share), self.reached.starts, count_rest)
    }
}

/// The long-term motions of one place, by share, then peak.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Motions {
    all: Vec<Motion>,
    of_starts: u32,
    led: Vec<Option<usize>>,
    operations: u64,
}

impl Motions {
    /// That of a single trajectory, which says nothing of others.
    pub fn of_one(motion: Motion) -> Self {
        Self { all: vec![motion], of_starts: 1, led: vec![Some(0)], operations: 0 }
    }

    /// All of them.
    pub fn iter(&self) -> std::slice::Iter<'_, Motion> {
        self.all.iter()
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.all.len()
    }

    /// Whether no start led anywhere and nothing could be solved for.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// One of them.
    pub fn get(&self, index: usize) -> Option<&Motion> {
        self.all.get(index)
    }

    /// Counted starts.
    pub fn of_starts(&self) -> u32 {
        self.of_starts
    }

    /// What finding them has cost, in operations as [`crate::operation_count`] counts them.
    pub fn operations(&self) -> u64 {
        self.operations
    }

    /// Which of them each counted start led to; none where it could not be followed.
    pub fn led(&self) -> &[Option<usize>] {
        &self.led
    }

    /// The name of one, local to its place.
    pub fn id(index: usize) -> String {
        format!("m{}", index + 1)
    }

    /// The share of one: of starts, or of resting places where the absorber is at rest.
    pub fn share(&self, motion: &Motion) -> f64 {
        match motion.rest() {
            Some(rest) => rest.share,
            None => listed::share_of_starts(motion.reached.starts, self.of_starts),
        }
    }

    /// The place of the main motion: the moving one that most starts lead to, or else the absorber at rest; where no start
    /// was flown the first that moves.
    pub fn main_index(&self) -> Option<usize> {
        listed::main(&self.all)
    }

    /// That motion.
    pub fn main(&self) -> Option<&Motion> {
        self.get(self.main_index()?)
    }

    /// The 1:1 motion that a single number speaks of, as [`steady`] chooses it.
    pub fn steady(&self) -> Option<&Motion> {
        solved::steady_of(&self.all)
    }

    /// The absorber at rest.
    pub fn rest(&self) -> Option<&Motion> {
        self.all.iter().find(|motion| motion.rest().is_some())
    }

    /// Those that count for criteria, with their places.
    pub fn counting(&self, count_rest: bool) -> impl Iterator<Item = (usize, &Motion)> {
        self.all.iter().enumerate().filter(move |(_, one)| one.why_not(count_rest).is_none())
    }
}

impl<'a> IntoIterator for &'a Motions {
    type Item = &'a Motion;
    type IntoIter = std::slice::Iter<'a, Motion>;
    fn into_iter(self) -> Self::IntoIter {
        self.all.iter()
    }
}
