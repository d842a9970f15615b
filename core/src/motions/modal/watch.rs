//! What watches a trajectory, and what it has seen.

use super::motion::{FlightCourse, ModalMotion};
use crate::motions::model::{Averages, LongTerm, Sample};
use crate::numerics::scatter;
use crate::simulation::{
    Detail, ModalImpact, ModalMeter, ModalObserver, ModalSegment, ModalSimulation, Reading, Sensor,
    Stop,
};
use crate::system::{MOST_MODES, ModalState, ModalSystem};

/// Most periods after which a motion is seen to repeat, and the difference of its states, over their size, up to which they
/// are the same.
const MOST_REPEATS: usize = 6;
pub(super) const SAME_STATE: f64 = 1e-9;
/// The same from which on it is worth to solve for the motion, and to try it once.
const NEARLY: f64 = 1e-4;
const ROUGHLY: f64 = 0.01;
/// Most impacts in a period, of all absorbers: more are of chatter that does not end.
pub(super) const MOST_IMPACTS: u64 = 2000;
/// Stretches of a window, each of which is measured by itself: largest values are spoken of by how long the motion remembers.
const STRETCHES: u64 = 128;
/// Parts of it whose mean squares say whether it drifts.
const BLOCKS: usize = 8;
/// Relative difference of largest displacements of stretches up to which they are nearly the same.
const NEARLY_LEVEL: f64 = 0.02;

/// Measures one trajectory.
pub(in crate::motions) struct ModalWatch {
    begin: ModalState,
    /// None where it is only seen whether it repeats.
    meter: Option<ModalMeter>,
    reads: Vec<Reading>,
    /// States at the ends of the last periods.
    states: Vec<ModalState>,
    /// Periods of a stretch, and of the one that is measured.
    stretch: u64,
    flown: u64,
    /// Impacts of each absorber in it, and the largest relative speed of one.
    impacts: [u64; MOST_MODES],
    speeds: [f64; MOST_MODES],
    course: FlightCourse,
}

impl ModalWatch {
    /// Of a trajectory over a window of so many periods.
    pub fn new(
        system: &ModalSystem,
        sensors: &[Sensor],
        simulation: &ModalSimulation,
        window: u64,
    ) -> Self {
        Self::in_stretches(system, sensors, simulation, window.div_ceil(STRETCHES).max(1))
    }

    /// The same in stretches of so many periods.
    pub fn in_stretches(
        system: &ModalSystem,
        sensors: &[Sensor],
        simulation: &ModalSimulation,
        stretch: u64,
    ) -> Self {
        Self::with(system, Some(sensors), simulation, stretch)
    }

    /// The same that only sees whether it repeats.
    pub fn of_repetition(system: &ModalSystem, simulation: &ModalSimulation, periods: u64) -> Self {
        Self::with(system, None, simulation, periods)
    }

    fn with(
        system: &ModalSystem,
        sensors: Option<&[Sensor]>,
        simulation: &ModalSimulation,
        stretch: u64,
    ) -> Self {
        let meter = sensors.map(|sensors| ModalMeter::new(system, sensors));
        let sensors = sensors.unwrap_or_default();
        Self {
            begin: simulation.state(),
            meter,
            reads: sensors.iter().map(|one| one.reads).collect(),
            states: Vec::new(),
            stretch,
            flown: 0,
            impacts: [0; MOST_MODES],
            speeds: [0.0; MOST_MODES],
            course: FlightCourse::new(sensors.len(), system.absorbers().len()),
        }
    }

    /// Whether it has seen no impact.
    pub fn is_silent(&self) -> bool {
        self.impacts == [0; MOST_MODES] && self.course.is_silent()
    }

    /// After how many periods the last state was there before, and those after which it nearly was.
    pub fn repeats(&self) -> Repeats {
        let Some((last, before)) = self.states.split_last() else { return Repeats::default() };
        let each = before.iter().rev().zip(1..).map(|(other, after)| (after, last.distance(other)));
        let each: Vec<(u32, f64)> = each.collect();
        let within = |most: f64| each.iter().filter(move |one| one.1 <= most).map(|one| one.0);
        let roughly = each.iter().filter(|one| (NEARLY..ROUGHLY).contains(&one.1));
        let roughly = roughly.min_by(|a, b| a.1.total_cmp(&b.1)).map(|one| one.0);
        Repeats { exactly: within(SAME_STATE).next(), nearly: within(NEARLY).collect(), roughly }
    }

    /// What was seen; none where the trajectory came to a bad end.
    pub fn sample(&mut self, simulation: &ModalSimulation, stop: Stop) -> Option<ModalSample> {
        if !matches!(stop, Stop::EndTime | Stop::ImpactLimit) {
            return None;
        }
        if self.course.periods == 0 {
            self.end_stretch();
        }
        let (begin, end) = (self.begin, simulation.state());
        let (reads, course) = (self.reads.clone(), self.course.clone());
        let whole = ModalMotion::of(&reads, vec![course.clone()], None, true, course.periods);
        let (averages, repeats) = (whole.averages(), self.repeats());
        let measured = self.meter.as_ref().map_or(0, |_| self.course.periods + self.flown);
        Some(ModalSample { begin, end, repeats, reads, course, averages, stop, measured })
    }

    fn end_stretch(&mut self) {
        let periods = self.flown.max(1);
        let read = self.meter.as_mut().map(ModalMeter::taken).unwrap_or_default();
        self.course.add(periods, &read, &self.impacts, &self.speeds);
        (self.flown, self.impacts, self.speeds) = (0, [0; MOST_MODES], [0.0; MOST_MODES]);
    }
}

impl ModalObserver for ModalWatch {
    fn detail(&self) -> Detail {
        self.meter.as_ref().map_or(Detail::Events, ModalMeter::detail)
    }

    fn segment(&mut self, segment: &ModalSegment<'_>) {
        self.meter.iter_mut().for_each(|meter| meter.segment(segment));
    }

    fn impact(&mut self, impact: &ModalImpact) {
        self.meter.iter_mut().for_each(|meter| meter.impact(impact));
        let ModalImpact { absorber, x_velocity: [x, _], y_velocity: [y, _], .. } = *impact;
        self.impacts[absorber] += 1;
        self.speeds[absorber] = self.speeds[absorber].max((x - y).abs());
    }

    fn period(&mut self, _turns: u64, state: &ModalState) {
        if self.states.len() > MOST_REPEATS {
            self.states.remove(0);
        }
        self.states.push(*state);
        self.flown += 1;
        if self.flown == self.stretch {
            self.end_stretch();
        }
    }
}

/// Excitation periods after which a state was there before.
#[derive(Debug, Clone, Default)]
pub(super) struct Repeats {
    pub exactly: Option<u32>,
    /// Ascending.
    pub nearly: Vec<u32>,
    /// After which it was so at best, where that is only roughly.
    pub roughly: Option<u32>,
}

impl Repeats {
    /// Whether it does by any measure; if so whether watching it any longer changes nothing.
    pub fn settled(&self) -> Option<bool> {
        let nearly = !self.nearly.is_empty();
        (nearly || self.roughly.is_some()).then_some(nearly)
    }
}

/// What was seen of a trajectory over a window.
#[derive(Debug, Clone)]
pub(in crate::motions) struct ModalSample {
    /// States at its beginning and its end, phase 0.
    pub begin: ModalState,
    pub end: ModalState,
    pub repeats: Repeats,
    /// What each sensor reads.
    pub reads: Vec<Reading>,
    pub course: FlightCourse,
    averages: Averages,
    pub stop: Stop,
    /// Periods that it was measured over; 0 where it was only seen whether it repeats.
    pub measured: u64,
}

impl ModalSample {
    /// What the sensors of displacements say of each stretch.
    fn displaced<'a>(&'a self, of: &'a [Vec<f64>]) -> impl Iterator<Item = &'a [f64]> {
        let each = of.iter().zip(&self.reads);
        each.filter(|one| *one.1 == Reading::Displacement).map(|one| one.0.as_slice())
    }
}

fn mean(of: &[f64]) -> f64 {
    of.iter().sum::<f64>() / of.len().max(1) as f64
}

/// The least and the largest.
fn ends(of: &[f64]) -> [f64; 2] {
    [f64::min, f64::max].map(|end| of.iter().copied().reduce(end).unwrap_or_default())
}

impl Sample for ModalSample {
    fn stop(&self) -> Stop {
        self.stop
    }

    fn covers(&self, window: u64) -> bool {
        self.measured >= window.max(1)
    }

    fn averages(&self) -> Averages {
        self.averages.clone()
    }

    fn mean_squares(&self) -> Vec<[f64; 2]> {
        let halves = |of: &[f64]| {
            let (first, second) = of.split_at(of.len() / 2);
            [mean(first), mean(second)]
        };
        self.displaced(&self.course.squares).map(halves).collect()
    }

    fn depths(&self) -> [f64; 2] {
        let depth = |of: &[f64]| {
            let [least, most] = ends(of);
            if most > 0.0 { (most - least) / (most + least) } else { 0.0 }
        };
        let each = self.displaced(&self.course.peaks).map(|of| of.split_at(of.len() / 2));
        each.fold([0.0; 2], |[a, b], (first, second)| [a.max(depth(first)), b.max(depth(second))])
    }

    fn drifts(&self) -> bool {
        let drifts = |of: &[f64]| {
            let blocks = of.chunks_exact((of.len() / BLOCKS).max(1));
            scatter::drifts(&blocks.map(|one| mean(one).sqrt()).collect::<Vec<_>>())
        };
        self.displaced(&self.course.squares).any(drifts)
    }

    fn repeats(&self) -> bool {
        self.repeats.settled().is_some()
    }

    /// The same impacts and nearly the same peaks all the time.
    fn of_repeating_kind(&self) -> bool {
        let level = |of: &[f64], within: f64| {
            let [least, most] = ends(of);
            most - least <= within * most
        };
        self.course.impacts.iter().all(|of| level(of, 0.0))
            && self.displaced(&self.course.peaks).all(|of| level(of, NEARLY_LEVEL))
    }
}
