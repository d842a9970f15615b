//! The search: starts, with every set of absorbers at rest that no wall reaches.

use super::at_rest::sudden_share;
use super::motion::ModalMotion;
use super::sensed::{Sensed, most_impacts, transient, window};
use super::starts::{carried, start};
use crate::executor::Serial;
use crate::motions::Effort;
use crate::motions::model::Model;
use crate::motions::sampler::{VAGUE, VAGUE_IN_FULL};
use crate::motions::search::{Starts, searched};
use crate::simulation::{ModalStartError, Reading, Sensor};
use crate::system::{ModalState, ModalSystem};

/// How thoroughly motions are searched.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModalEffort {
    /// Starts, that from rest among them.
    pub starts: u32,
    /// Excitation periods that what does not repeat is measured for at least.
    pub periods: u64,
    /// Part of the patience that starts which wander get where a case has one place, [`ModalEffort::IN_FULL`]: less where others beside
    /// the place are searched too, none where designs are only ranked.
    pub patience: f64,
    /// Relative error of root mean squares, and error of impacts per period, to which what does not repeat is measured; as its window says
    /// where there is none.
    pub accuracy: Option<[f64; 2]>,
}

impl ModalEffort {
    /// The patience where a case has one place.
    pub const IN_FULL: f64 = 1.0;
    /// The same where a place is one of many.
    pub const OF_MANY: f64 = 0.1;
}

/// Most starts for each set of absorbers that are held at rest: of eight there are 254 such sets.
const MOST_HELD: u32 = 6;

/// The long-term motions that these sensors read; the most common first, then those in which some absorbers rest, and where every one
/// can rest that. `further` are states of motions elsewhere, where starts begin that are not counted.
///
/// # Errors
/// [`ModalStartError`] where the structure's own motion is not finite.
pub fn modal_motions(
    system: &ModalSystem,
    sensors: &[Sensor],
    effort: ModalEffort,
    further: &[ModalState],
) -> Result<Vec<ModalMotion>, ModalStartError> {
    // How far the structure moves at each absorber says which of them may rest.
    let ModalEffort { starts, .. } = effort;
    let search = Search { system, sensors: with_absorbers(system, sensors), effort };
    let (mut found, at_rest) = search.moving(&[], starts, further)?;
    let mut tried: Vec<Vec<usize>> = Vec::new();
    let held = starts.div_ceil(2).min(MOST_HELD);
    let mut next = 0;
    while let Some(motion) = found.get(next).filter(|_| held > 0) {
        next += 1;
        for rest in search.may_rest(motion) {
            if tried.contains(&rest) {
                continue;
            }
            let (further, _) = search.moving(&rest, held, &[])?;
            let known = |one: &ModalMotion| found.iter().any(|known| known.is_same(one));
            let further = further.into_iter().filter(|one| !known(one));
            let further: Vec<ModalMotion> = further.collect();
            found.extend(further);
            tried.push(rest);
        }
    }
    found.sort_by_key(|one| std::cmp::Reverse(one.starts));
    found.extend(at_rest);
    for motion in &mut found {
        motion.read_by_first(sensors.len());
    }
    Ok(found)
}

/// Sensors, and the displacement of the structure at each absorber behind them.
fn with_absorbers(system: &ModalSystem, sensors: &[Sensor]) -> Vec<Sensor> {
    let at = |j: usize| system.modes().iter().map(|mode| mode.shape[j]).collect();
    let own = (0..system.absorbers().len()).map(|j| Sensor::displacement(at(j)));
    sensors.iter().cloned().chain(own).collect()
}

/// A search of motions of a structure.
struct Search<'a> {
    system: &'a ModalSystem,
    /// The last ones are those of its absorbers.
    sensors: Vec<Sensor>,
    effort: ModalEffort,
}

impl Search<'_> {
    /// Those in which these absorbers rest and another one impacts, and every absorber at rest. Starts are counted where none is
    /// held at rest.
    fn moving(
        &self,
        rest: &[usize],
        starts: u32,
        further: &[ModalState],
    ) -> Result<(Vec<ModalMotion>, Option<ModalMotion>), ModalStartError> {
        let Some(system) = self.system.without(rest) else { return Ok((Vec::new(), None)) };
        let carried = if starts > 0 { carried(&system, rest.is_empty()) } else { Vec::new() };
        let counted = (0..starts).map(|k| start(&system, k)).collect();
        // Of motions in which absorbers rest there are many.
        let most = if rest.is_empty() { ModalEffort::IN_FULL } else { ModalEffort::OF_MANY };
        let patience = self.effort.patience.min(most);
        let vague = match patience {
            0.0 => f64::INFINITY,
            ModalEffort::IN_FULL => VAGUE_IN_FULL,
            _ => VAGUE,
        };
        let effort = Effort {
            starts,
            periods: window(&system, self.effort.periods),
            patience: if patience > 0.0 { 1.0 } else { 0.0 },
            most_impacts: most_impacts(&system),
            accuracy: self.effort.accuracy.filter(|_| rest.is_empty()),
            vague,
            ..Effort::default()
        };
        let most_impacts = effort.most_impacts;
        let model = Sensed::new(system.clone(), self.without(rest));
        // Its place may be just outside of a cavity here.
        let begins = |state: &&ModalState| model.begin(state, 0.0).is_ok();
        let further = further.iter().chain(&carried).filter(begins).copied().collect();
        let (known, in_full) = (Vec::new(), false);
        let place = Starts { model: model.clone(), counted, further, known, patience, in_full };
        let mut found = searched(&[place], &effort, &Serial, &|_| ())?.remove(0).all;
        let still = |one: &ModalMotion| one.rests() && one.resting.iter().all(Option::is_some);
        let at_rest = found.iter().position(still).map(|index| found.remove(index));
        let sudden =
            || if patience > 0.0 { sudden_share(&system, transient(&system)) } else { None };
        let at_rest = at_rest.map(|one| match rest.is_empty() {
            true => ModalMotion { sudden: sudden(), ..one },
            false => one,
        });
        let told = |one: ModalMotion| match patience > 0.0 {
            true => one.of_structure(&model, most_impacts),
            false => one,
        };
        let found = found.into_iter().map(told);
        let found = found.filter_map(|one| self.with_resting(one, rest)).collect();
        Ok((found, at_rest))
    }

    /// The sensors for a structure without these absorbers.
    fn without(&self, rest: &[usize]) -> Vec<Sensor> {
        let of = |sensor: &Sensor| match sensor.reads {
            // Nothing is what one reads that has no impacts.
            Reading::Jump { absorber } if rest.contains(&absorber) => {
                Sensor { reads: Reading::Displacement, scale: 0.0, ..sensor.clone() }
            }
            Reading::Jump { absorber } => {
                let before = rest.iter().filter(|j| **j < absorber).count();
                Sensor { reads: Reading::Jump { absorber: absorber - before }, ..sensor.clone() }
            }
            _ => sensor.clone(),
        };
        self.sensors.iter().map(of).collect()
    }

    /// A motion of the structure without these absorbers as one of all; none where a wall would reach one of them.
    fn with_resting(&self, motion: ModalMotion, rest: &[usize]) -> Option<ModalMotion> {
        let mut motion = motion;
        for (extent, sensor) in motion.sensors.iter_mut().zip(&self.sensors) {
            extent.reads = sensor.reads;
        }
        for j in rest {
            motion.insert_at_rest(*j);
        }
        let rests = |j: usize| motion.impacts_per_period[j][0] == 0.0;
        let share = |j: usize| rests(j).then(|| self.share(&motion, j));
        motion.resting = (0..self.system.absorbers().len()).map(share).collect();
        if !rest.is_empty() {
            motion.starts = 0;
            motion.state = None;
        }
        let stay = rest.iter().all(|j| motion.resting[*j].is_some_and(|share| share > 0.0));
        (stay && (rest.is_empty() || !motion.rests())).then_some(motion)
    }

    /// The share of its cavity within which no wall reaches an absorber at rest in a motion; 0 or less where one does everywhere.
    fn share(&self, motion: &ModalMotion, j: usize) -> f64 {
        let own = self.sensors.len() - self.system.absorbers().len();
        1.0 - motion.sensors[own + j].peak / self.system.absorbers()[j].clearance
    }

    /// Sets of absorbers that may rest, of which one more does than in a motion, and another one impacts.
    fn may_rest(&self, motion: &ModalMotion) -> Vec<Vec<usize>> {
        let count = self.system.absorbers().len();
        let rest: Vec<usize> = (0..count).filter(|j| motion.resting[*j].is_some()).collect();
        let more = (0..count).filter(|j| !rest.contains(j) && self.share(motion, *j) > 0.0);
        let with = |j: usize| {
            let mut set: Vec<usize> = rest.iter().copied().chain([j]).collect();
            set.sort_unstable();
            set
        };
        more.map(with).filter(|set| set.len() < count).collect()
    }
}
