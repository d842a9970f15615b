//! The search: starts, with every set of absorbers at rest that no wall reaches.

use super::flight::{End, Of};
use super::motion::{ModalMotion, SensorExtent};
use super::proven::attracting;
use super::wandering::Wandering;
use crate::linear::{ModalAmplitudes, carried_state};
use crate::motions::starts::position;
use crate::simulation::{ModalStartError, Reading, Sensor};
use crate::system::{MOST_MODES, ModalAbsorber, ModalState, ModalSystem};

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
        let sensors = self.without(rest);
        let orbits = attracting(&system, &sensors)?;
        let mut found: Vec<ModalMotion> = orbits.iter().map(|one| one.motion.clone()).collect();
        let mut at_rest = modal_at_rest(&system, &sensors);
        let mut of =
            Of { system: &system, sensors: &sensors, periods: self.effort.periods, orbits };
        let mut take = |motion: ModalMotion, found: &mut Vec<ModalMotion>| {
            // What is left of a transient then is no other motion.
            if let Some(at_rest) = at_rest.as_mut().filter(|_| motion.rests()) {
                at_rest.starts += motion.starts;
                return;
            }
            match found.iter_mut().find(|known| known.is_same(&motion)) {
                Some(known) => known.join(&motion),
                None => found.push(motion),
            }
        };
        let mut open = Vec::new();
        for k in 0..starts {
            match of.begin(&start(&system, k))? {
                End::On(motion) => take(*motion, &mut found),
                End::Open(flight) => open.push(flight),
            }
        }
        let carried = if starts > 0 { carried(&system, rest.is_empty()) } else { Vec::new() };
        for state in further.iter().chain(&carried) {
            // Its place may be just outside of a cavity here.
            match of.begin(state) {
                Ok(End::On(motion)) => take(ModalMotion { starts: 0, ..*motion }, &mut found),
                Ok(End::Open(flight)) => open.push(Box::new(flight.uncounted())),
                Err(_) => {}
            }
        }
        // Of motions in which absorbers rest there are many.
        let most = if rest.is_empty() { ModalEffort::IN_FULL } else { ModalEffort::OF_MANY };
        let part = self.effort.patience.min(most);
        for motion in Wandering::of(open, &of, starts, part).ends(&mut of, &found) {
            take(motion, &mut found);
        }
        let found = found.into_iter().filter_map(|one| self.with_resting(one, rest)).collect();
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

/// Every absorber at rest where no wall reaches it, as these sensors read it: in closed form. None where a wall reaches one.
pub fn modal_at_rest(system: &ModalSystem, sensors: &[Sensor]) -> Option<ModalMotion> {
    let share = |(j, one): (usize, &ModalAbsorber)| {
        1.0 - system.steady_motion_at(j).amplitude() / one.clearance
    };
    let shares: Vec<f64> = system.absorbers().iter().enumerate().map(share).collect();
    if shares.iter().any(|share| *share <= 0.0) {
        return None;
    }
    let shapes: Vec<Vec<f64>> = sensors.iter().map(|one| one.shape.clone()).collect();
    let amplitudes = ModalAmplitudes::of(system, &[], &shapes).places;
    let extent = |(sensor, amplitude): (&Sensor, f64)| {
        let peak = sensor.of_sine(amplitude, system.frequency_ratio());
        let rms = [peak * std::f64::consts::FRAC_1_SQRT_2, 0.0];
        SensorExtent { reads: sensor.reads, peak, error: 0.0, rms }
    };
    Some(ModalMotion {
        sensors: sensors.iter().zip(amplitudes).map(extent).collect(),
        impacts_per_period: vec![[0.0; 2]; system.absorbers().len()],
        impact_speed: vec![[0.0; 2]; system.absorbers().len()],
        repeats_after: Some(1),
        settled: true,
        largest_multiplier: None,
        is_orbit: false,
        starts: 0,
        state: None,
        resting: shares.into_iter().map(Some).collect(),
        periods: 0,
        flights: Vec::new(),
    })
}

/// States of the structure as it carries all of its absorbers, or `each` alone. Those that no start is near, which are of the structure
/// without absorbers, and in which these hit both of their walls.
fn carried(system: &ModalSystem, each: bool) -> Vec<ModalState> {
    let all: Vec<usize> = (0..system.absorbers().len()).collect();
    let alone = all.iter().map(|j| vec![*j]).filter(|_| each && all.len() > 1);
    let sets = std::iter::once(all.clone()).chain(alone);
    let states = sets.filter_map(|set| {
        let state = carried_state(system, &set)?;
        let farther = |j: &usize| {
            let [x, v] = system.displaced(*j, &state);
            let amplitude = libm::hypot(x, v / system.frequency_ratio());
            let near = BEYOND * system.steady_motion_at(*j).amplitude();
            amplitude > near && amplitude > system.absorbers()[*j].clearance
        };
        set.iter().any(farther).then_some(state)
    });
    states.collect()
}

/// The largest start, over the structure's own steady motion.
const BEYOND: f64 = 1.2;
/// One prime for the share of the steady motion, and for the place of each absorber.
const PRIMES: [f64; MOST_MODES + 1] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0, 23.0];

/// The `k`-th start: from rest, each absorber half way to a wall; then with a share of the structure's own steady motion and
/// the absorbers anywhere in their cavities, evenly spread.
fn start(system: &ModalSystem, k: u32) -> ModalState {
    let mut start = ModalState::AT_REST;
    let part = |axis: usize| position(PRIMES[axis], k.saturating_sub(1));
    let share = if k == 0 { 0.0 } else { BEYOND * part(0) };
    for mode in 0..system.modes().len() {
        let steady = system.steady_motion(mode);
        let velocity = system.frequency_ratio() * steady.sine;
        start.modes[mode] = [share * steady.cosine, share * velocity];
    }
    for (j, absorber) in system.absorbers().iter().enumerate() {
        let each = system.modes().iter().zip(&start.modes);
        let [x, v] = each.fold([0.0, 0.0], |[x, v], (mode, [q, p])| {
            [x + mode.shape[j] * q, v + mode.shape[j] * p]
        });
        let place = if k == 0 { 0.5 } else { 1.98 * part(1 + j) - 0.99 };
        start.absorbers[j] = [x - place * absorber.clearance, v];
    }
    start
}
