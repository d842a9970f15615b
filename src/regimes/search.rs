//! Every long-term motion that a set of starts leads to, with the share of starts.

use serde::Serialize;

use super::attractor::Effort;
use super::starts::StartBox;
use super::{Attractor, Classification, DynamicsKind, Regime, share};
use crate::simulation::{StartError, Stop};
use crate::system::{State, System};

/// An attractor and how it was found.
#[derive(Debug, Clone, Serialize)]
pub struct FoundAttractor {
    /// The motion, measured over a long window.
    #[serde(flatten)]
    pub attractor: Attractor,
    /// How many of the evenly spread starts led here.
    pub starts: u32,
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
        self.attractor.classification.regime
    }

    /// Takes over the starts of another one that turned out to be the same motion.
    pub fn absorb(&mut self, other: Self) {
        self.starts += other.starts;
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

/// How thoroughly attractors are searched.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SearchEffort {
    /// Evenly spread starts.
    pub starts: u32,
    /// Each of them.
    pub each: Effort,
    /// Periods over which each distinct attractor is measured.
    pub measured: u64,
    /// Periods for which a motion that does not repeat is watched first, beside one that does: a
    /// chaotic transient may last as long.
    pub patience: u64,
}

/// Follows the evenly spread starts and those in `predicted`, and matches what they end in.
///
/// Ordered by share, largest first; ties by order of discovery.
///
/// # Errors
/// [`StartError`] if a predicted start is impossible.
pub fn find(
    system: &System,
    predicted: &[State],
    effort: &SearchEffort,
    progress: &mut dyn FnMut(u64),
) -> Result<Vec<FoundAttractor>, StartError> {
    let mut found: Vec<FoundAttractor> = Vec::new();
    let sample = StartBox::around(system);
    let spread = (0..effort.starts).map(|index| (sample.start(index), false));
    for (start, from_theory) in predicted.iter().map(|start| (*start, true)).chain(spread) {
        let reached = Attractor::reach(system, start, &effort.each)?;
        let known = found.iter().position(|known| known.attractor.is_same(&reached));
        let index = known.unwrap_or(found.len());
        if let Some(known) = known {
            found[known].attractor.replace_if_settled(reached);
        } else {
            found.push(FoundAttractor {
                attractor: reached,
                starts: 0,
                share: 0.0,
                share_interval: [0.0, 1.0],
                reached_from_theory: false,
                late_starts: 0,
                longest_transient: 0,
            });
        }
        found[index].starts += u32::from(!from_theory);
        found[index].reached_from_theory |= from_theory;
        progress(1);
    }
    let some_repeat = found.iter().any(|one| one.attractor.repeats());
    for one in &mut found {
        look_longer(system, one, some_repeat, effort)?;
    }
    found.sort_by_key(|one| std::cmp::Reverse(one.starts));
    let mut distinct = merged(found);
    distinct.iter_mut().for_each(|one| one.set_share(effort.starts));
    Ok(distinct)
}

/// A motion that repeats needs no longer look. The others are averages, which intermittent motions
/// take long to give; and beside a motion that repeats they may be transients.
fn look_longer(
    system: &System,
    one: &mut FoundAttractor,
    some_repeat: bool,
    effort: &SearchEffort,
) -> Result<(), StartError> {
    if one.attractor.repeats() || one.attractor.stop != Stop::EndTime {
        return Ok(());
    }
    let patience = if some_repeat { effort.patience } else { 0 };
    one.attractor = one.attractor.continued(system, patience, effort.measured)?;
    let mut measured = effort.measured;
    for _ in 0..LONGEST_WAIT {
        let Classification { dynamics, evidence, .. } = &one.attractor.classification;
        let open = matches!(dynamics, DynamicsKind::TransientNotOver | DynamicsKind::Undecided);
        if one.attractor.repeats() || (evidence.settled && !open) {
            break;
        }
        measured = measured.saturating_mul(2);
        one.attractor = one.attractor.continued(system, 0, measured)?;
    }
    if one.attractor.repeats() {
        one.late_starts = one.starts;
        one.longest_transient = one.attractor.followed;
    }
    Ok(())
}

/// Merges attractors that the long measurement shows to be the same.
fn merged(found: Vec<FoundAttractor>) -> Vec<FoundAttractor> {
    let mut distinct: Vec<FoundAttractor> = Vec::new();
    for one in found {
        match distinct.iter_mut().find(|known| known.attractor.is_same(&one.attractor)) {
            Some(known) => known.absorb(one),
            None => distinct.push(one),
        }
    }
    distinct
}
