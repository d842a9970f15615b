//! What each absorber of a structure of several modes does in a motion, and which share of the excitation's work impacts take.
//!
//! A regime is decided as with one mode, by what the absorber and the structure at its place do in each period. In the long run the
//! excitation's work is what dampers and impacts dissipate: of mode k `2 zeta_k omega_k m_k` times the integral of `q_k'^2`.

use serde::Serialize;

use super::{Evidence, Periodicity, Regime};
use crate::simulation::{
    ModalImpact, ModalMeter, ModalObserver, ModalSegment, PeriodRecord, Reading, Sensor, WallRun,
    lost_in, share_of_impacts,
};
use crate::system::{ModalState, ModalSystem};

/// Records of each period of a trajectory.
#[derive(Debug)]
pub struct ModalRecords {
    /// Velocities of the modes, and the displacement of the structure at each absorber.
    meter: ModalMeter,
    /// Of each mode the power of its damper over the square of its velocity.
    dampers: Vec<f64>,
    period: f64,
    lost: [f64; 2],
    /// What is lost up to the end of each period.
    energy: Vec<PeriodRecord>,
    absorbers: Vec<Recorded>,
}

#[derive(Debug, Default)]
struct Recorded {
    current: PeriodRecord,
    records: Vec<PeriodRecord>,
    run: WallRun,
    times: Vec<f64>,
    visits: u32,
}

/// What absorbers do, and where the energy goes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModalRegimes {
    /// Of each absorber.
    pub regimes: Vec<Regime>,
    /// Visits of each absorber to a wall per excitation period: a chattering sequence that ends in contact is one.
    pub visits_per_period: Vec<f64>,
    /// Share of the excitation's work that impacts dissipate, with two standard errors; none where it does no work.
    pub efficiency: Option<[f64; 2]>,
}

impl ModalRegimes {
    /// That of absorbers which rest beside a structure that moves.
    pub fn at_rest(absorbers: usize) -> Self {
        Self {
            regimes: vec![Regime::AtRest; absorbers],
            visits_per_period: vec![0.0; absorbers],
            efficiency: Some([0.0; 2]),
        }
    }

    /// Adds an absorber that rests, at a place in their list.
    pub fn insert_at_rest(&mut self, j: usize) {
        self.regimes.insert(j, Regime::AtRest);
        self.visits_per_period.insert(j, 0.0);
    }
}

impl ModalRecords {
    /// Of trajectories of a structure.
    pub fn new(system: &ModalSystem) -> Self {
        let modes = system.modes();
        let velocity = |k: usize| {
            let shape = (0..modes.len()).map(|of| f64::from(u8::from(of == k))).collect();
            Sensor { reads: Reading::Velocity, ..Sensor::displacement(shape) }
        };
        let at = |j: usize| Sensor::displacement(modes.iter().map(|mode| mode.shape[j]).collect());
        let count = system.absorbers().len();
        let sensors: Vec<Sensor> =
            (0..modes.len()).map(velocity).chain((0..count).map(at)).collect();
        let damper = modes.iter().map(|one| 2.0 * one.damping_ratio * one.frequency * one.mass);
        Self {
            meter: ModalMeter::new(system, &sensors),
            dampers: damper.collect(),
            period: system.period(),
            lost: [0.0; 2],
            energy: Vec::new(),
            absorbers: std::iter::repeat_with(Recorded::default).take(count).collect(),
        }
    }

    /// What was seen, of a motion that repeats after so many periods if it does.
    pub fn found(&self, repeats_after: Option<u32>) -> ModalRegimes {
        let each = self.absorbers.iter().map(|one| one.evidence(repeats_after, self.period));
        let each: Vec<Evidence> = each.collect();
        ModalRegimes {
            regimes: each.iter().map(Regime::of).collect(),
            visits_per_period: each.iter().map(|one| one.visits_per_period).collect(),
            efficiency: match repeats_after {
                None => share_of_impacts(&self.energy, false),
                // Over its last repetition, which is all of it.
                Some(periods) => {
                    let from = self.energy.len().saturating_sub(periods as usize);
                    let before = from.checked_sub(1).map(|last| self.energy[last]);
                    let [whole, impact] = lost_in(before, &self.energy[from..]);
                    (whole > 0.0).then(|| [impact / whole, 0.0])
                }
            },
        }
    }
}

impl Recorded {
    fn evidence(&self, repeats_after: Option<u32>, period: f64) -> Evidence {
        let over = |count: u32| f64::from(count) / self.records.len().max(1) as f64;
        let per_period = [over(self.times.len() as u32), over(self.visits)];
        let repetition = repeats_after.map(|periods| {
            let found = Periodicity { impacts: 0, periods, closure: 0.0 };
            let impacts = found.last(&self.records).iter().flat_map(|record| record.impacts).sum();
            Periodicity { impacts, ..found }
        });
        Evidence::of_records(&self.records, repetition, per_period, &self.times, period)
    }
}

impl ModalObserver for ModalRecords {
    fn segment(&mut self, segment: &ModalSegment<'_>) {
        self.meter.segment(segment);
    }

    fn impact(&mut self, impact: &ModalImpact) {
        self.lost[1] += impact.loss;
        let one = &mut self.absorbers[impact.absorber];
        let wall = impact.side.index();
        one.current.impacts[wall] += 1;
        one.current.visits[wall] += 1;
        one.visits += 1;
        one.times.push(impact.tau);
        one.run.impact(impact.side);
    }

    fn sticks(&mut self, absorber: usize, loss: f64) {
        self.lost[1] += loss;
        let one = &mut self.absorbers[absorber];
        let latest = std::iter::once(&mut one.current).chain(one.records.iter_mut().rev());
        one.visits -= one.run.close(latest);
    }

    fn period(&mut self, _turns: u64, _state: &ModalState) {
        let read = self.meter.taken();
        let (modes, places) = read.split_at(self.dampers.len());
        let power = self.dampers.iter().zip(modes).map(|(damper, one)| damper * one.mean_square);
        self.lost[0] += self.period * power.sum::<f64>();
        let [damper, impacts] = self.lost;
        self.energy.push(PeriodRecord { lost: [damper, impacts, 0.0], ..PeriodRecord::default() });
        for (one, place) in self.absorbers.iter_mut().zip(places) {
            let current = std::mem::take(&mut one.current);
            one.records.push(PeriodRecord { peak: place.peak, ..current });
        }
    }
}
