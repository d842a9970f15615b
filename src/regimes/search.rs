//! Every long-term motion that a set of starts leads to, measured in full, with the share of starts.

use serde::Serialize;

use super::attractor::{SAME_PERIODIC, Window};
use super::long_term::{Effort, long_term};
use super::starts::StartBox;
use super::{Attractor, Classification, DynamicsKind, Motion, Regime, share};
use crate::simulation::{StartError, Stop};
use crate::system::{State, System};

/// An attractor and how it was found.
#[derive(Debug, Clone)]
pub struct FoundAttractor {
    /// The motion, measured over a long window.
    pub attractor: Attractor,
    /// How many of the evenly spread starts led here.
    pub starts: u32,
    /// The first of them, counted from 0.
    pub first_start: Option<u32>,
    /// The same as a share of all evenly spread starts.
    pub share: f64,
    /// 95 % interval of the share that infinitely many starts would give (Wilson).
    pub share_interval: [f64; 2],
    /// Whether a start on a predicted motion led here.
    pub reached_from_theory: bool,
    /// How many of `starts` came here out of a transient that looked like a motion of its own.
    pub late_starts: u32,
    /// Periods after which the last such transient was over, as far as it was followed.
    pub longest_transient: u64,
}

impl FoundAttractor {
    /// Its regime.
    pub fn regime(&self) -> Regime {
        self.attractor.regime
    }

    /// Takes over the starts of another one that turned out to be the same motion.
    pub fn absorb(&mut self, other: Self) {
        self.starts += other.starts;
        self.first_start = self.first_start.into_iter().chain(other.first_start).min();
        self.late_starts += other.late_starts;
        self.longest_transient = self.longest_transient.max(other.longest_transient);
        self.reached_from_theory |= other.reached_from_theory;
        self.attractor.replace_if_settled(other.attractor);
    }

    /// Its share of `starts` starts, from its own.
    pub fn set_share(&mut self, starts: u32) {
        self.share = f64::from(self.starts) / f64::from(starts.max(1));
        self.share_interval = share::wilson(self.starts, starts);
    }
}

/// How often the window is doubled for a motion whose averages still drift or whose kind of dynamics is still
/// open: an exponent's error shrinks with the window, and sixteen of them settle all but the rarest
/// intermittency.
const LONGEST_WAIT: u32 = 4;
/// Starts that are followed side by side before progress is told: the lanes of a batch.
const TOGETHER: usize = 16;

/// Periods in which a regime is recognised; several times the slowest modulation.
pub const RECOGNITION: u64 = 200;
/// How many times the measured periods a motion that does not repeat is watched first, beside one that does: a
/// chaotic transient may last as long.
const PATIENCE: u64 = 20;

/// How thoroughly long-term motions are searched. Shares of 32 starts are good to about 9 %.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct SearchEffort {
    /// Evenly spread starts.
    pub starts: u32,
    /// Periods left out as transient; none for as many as [`Transient`](super::Transient) says.
    pub discard: Option<u64>,
    /// Periods over which a motion that does not repeat is measured.
    pub periods: u64,
}

impl Default for SearchEffort {
    fn default() -> Self {
        Self { starts: 32, discard: None, periods: 1000 }
    }
}

impl SearchEffort {
    /// Periods left out of the motions of a system.
    pub fn left_out(&self, system: &System) -> u64 {
        self.each().left_out(system)
    }

    fn each(&self) -> Effort {
        Effort { discard: self.discard, ..Effort::over(RECOGNITION.min(self.periods)) }
    }

    /// In which one motion is measured in full.
    pub fn full_window(&self, system: &System) -> Window {
        // At a million impacts a second some minutes.
        const IMPACT_LIMIT: u64 = 200_000_000;
        let discard = self.left_out(system);
        Window { discard, periods: self.periods, impact_limit: IMPACT_LIMIT }
    }

    /// In which a motion is recognised.
    pub fn window(&self, system: &System) -> Window {
        let each = self.each();
        let impact_limit = each.extent(system, each.periods).impacts;
        Window { discard: self.left_out(system), periods: each.periods, impact_limit }
    }
}

/// Follows the evenly spread starts and those in `predicted`, matches what they end in, and measures that
/// in full.
///
/// Ordered by share, largest first, those that have settled before the others; ties by order of discovery.
///
/// # Errors
/// [`StartError`] if a predicted start is impossible.
pub fn find(
    system: &System,
    predicted: &[State],
    effort: &SearchEffort,
    progress: &mut dyn FnMut(u64),
) -> Result<Vec<FoundAttractor>, StartError> {
    let sample = StartBox::around(system);
    let spread = (0..effort.starts).map(|index| (sample.start(index), Some(index)));
    let starts: Vec<(State, Option<u32>)> =
        predicted.iter().map(|start| (*start, None)).chain(spread).collect();
    let mut groups: Vec<Group> = Vec::new();
    for some in starts.chunks(TOGETHER) {
        let begun: Vec<(System, State)> = some.iter().map(|(start, _)| (*system, *start)).collect();
        for (motion, (_, number)) in long_term(&begun, &effort.each())?.into_iter().zip(some) {
            Group::add(&mut groups, motion, *number);
        }
        progress(some.len() as u64);
    }
    let some_repeat = groups.iter().any(|group| group.motion.repeats());
    let mut distinct: Vec<FoundAttractor> = Vec::new();
    for group in groups {
        let one = group.measured(system, some_repeat, effort)?;
        match distinct.iter_mut().find(|known| known.attractor.is_same(&one.attractor)) {
            Some(known) => known.absorb(one),
            None => distinct.push(one),
        }
    }
    distinct.iter_mut().for_each(|one| one.set_share(effort.starts));
    distinct.sort_by_key(|one| (!one.attractor.settled, std::cmp::Reverse(one.starts)));
    Ok(distinct)
}

/// A motion and the starts that led to it.
struct Group {
    motion: Motion,
    /// Numbers of the evenly spread ones; none for a predicted motion.
    starts: Vec<Option<u32>>,
}

impl Group {
    fn add(groups: &mut Vec<Self>, motion: Option<Motion>, start: Option<u32>) {
        let Some(motion) = motion else { return };
        // A quiet window is that of the motion without impacts, whether or not its absorber still flies.
        let same = |known: &Motion| {
            let repeat = known.repeats();
            let alike = !repeat || known.is_alike(&motion, SAME_PERIODIC);
            let both = known.is_inactive() || repeat == motion.repeats() && alike;
            both && known.is_same(&motion)
        };
        match groups.iter_mut().find(|known| same(&known.motion)) {
            Some(known) => {
                known.motion.join(&motion);
                known.starts.push(start);
            }
            None => groups.push(Self { motion, starts: vec![start] }),
        }
    }

    /// Measures the motion in full. One that repeats needs no longer look. The others are averages, which
    /// intermittent motions take long to give; and beside a motion that repeats they may be transients.
    fn measured(
        self,
        system: &System,
        some_repeat: bool,
        effort: &SearchEffort,
    ) -> Result<FoundAttractor, StartError> {
        let spread = self.starts.iter().flatten();
        let mut found = FoundAttractor {
            starts: spread.clone().count() as u32,
            first_start: spread.min().copied(),
            reached_from_theory: self.starts.contains(&None),
            attractor: self.attractor(system, some_repeat, effort)?,
            share: 0.0,
            share_interval: [0.0, 1.0],
            late_starts: 0,
            longest_transient: 0,
        };
        if found.attractor.repeats() && !self.motion.repeats() {
            found.late_starts = found.starts;
            found.longest_transient = found.attractor.followed;
        }
        Ok(found)
    }

    fn attractor(
        &self,
        system: &System,
        some_repeat: bool,
        effort: &SearchEffort,
    ) -> Result<Attractor, StartError> {
        let recognised = effort.window(system);
        if self.motion.repeats() || self.motion.stop != Stop::EndTime {
            return Attractor::of(&self.motion, system, &recognised);
        }
        let patience = if some_repeat { PATIENCE.saturating_mul(effort.periods) } else { 0 };
        let mut window =
            Window { discard: patience, periods: effort.periods, impact_limit: u64::MAX };
        let mut found = Attractor::of(&self.motion, system, &window)?;
        for _ in 0..LONGEST_WAIT {
            let Classification { dynamics, evidence, .. } = &found.classification;
            let open = matches!(dynamics, DynamicsKind::TransientNotOver | DynamicsKind::Undecided);
            if found.repeats() || (evidence.settled && !open) {
                break;
            }
            window = Window { discard: 0, periods: window.periods.saturating_mul(2), ..window };
            found = Attractor::of(&found, system, &window)?;
        }
        // Of a transient that has ended within a window nothing is left in the next.
        if found.repeats() { Attractor::of(&found, system, &recognised) } else { Ok(found) }
    }
}
