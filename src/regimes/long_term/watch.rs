//! What watches a trajectory: whether it repeats, and how large it is.

use super::{Ended, Motion, WATCHED};
use crate::regimes::{Captures, Periodicity, Signs, Thresholds, modulation, periodicity};
use crate::simulation::{Impact, ImpactLog, ImpactStatistics, Observer, Segment, Simulation, Stop};
use crate::system::{State, System};

/// Impacts that are kept to tell a regime by: their intervals are averaged.
const KEPT_IMPACTS: usize = 1000;

/// Measures one trajectory.
pub(super) struct Watch {
    pub(super) impact_statistics: ImpactStatistics,
    log: ImpactLog,
}

impl Observer for Watch {
    fn flights(&self) -> bool {
        self.impact_statistics.flights()
    }
    fn segment(&mut self, segment: &Segment) {
        self.impact_statistics.segment(segment);
    }
    fn impact(&mut self, impact: &Impact) {
        self.log.impact(impact);
        self.impact_statistics.impact(impact);
    }
    fn sticks(&mut self, loss: f64) {
        self.impact_statistics.sticks(loss);
    }
    fn period(&mut self, state: &State) {
        self.impact_statistics.period(state);
    }
}

impl Watch {
    pub(super) fn begin(simulation: &Simulation) -> Self {
        Self {
            impact_statistics: ImpactStatistics::begin(simulation.system(), simulation.state()),
            log: ImpactLog::of_the_last(KEPT_IMPACTS),
        }
    }

    /// The motion measured; none where the trajectory came to a bad end.
    pub(super) fn motion(
        mut self,
        ended: &Ended,
        repetition: Option<Repetition>,
    ) -> Option<Motion> {
        let Ended { simulation, stop, .. } = ended;
        if !matches!(stop, Stop::EndTime | Stop::ImpactLimit) {
            return None;
        }
        let impact_statistics = &mut self.impact_statistics;
        let thresholds = Thresholds::default();
        let period = simulation.system().period();
        let (impacts_per_period, visits_per_period) =
            (impact_statistics.impacts_per_period(), impact_statistics.visits_per_period());
        let (signs, errors, repeats_after) = match repetition {
            Some(Repetition { found, asymmetry }) => {
                let signs = Signs {
                    impacts_per_period,
                    visits_per_period,
                    repeats: true,
                    asymmetry,
                    captures: Captures::default(),
                    modulation_depth: 0.0,
                };
                (signs, [0.0; 2], Some(found.periods))
            }
            None => {
                let records = impact_statistics.records();
                let found = periodicity::find(records);
                let signs = Signs {
                    impacts_per_period,
                    visits_per_period,
                    repeats: found.is_some(),
                    asymmetry: periodicity::asymmetry(&self.log.impacts, period),
                    captures: modulation::captures(records, thresholds.shortest_capture),
                    modulation_depth: modulation::depth(records),
                };
                (signs, impact_statistics.errors(), found.map(|found| found.periods))
            }
        };
        let settled = repeats_after.is_some() || !modulation::drifting(impact_statistics.records());
        let largest =
            if repeats_after.is_some() { [0.0; 2] } else { impact_statistics.errors_of_largest() };
        Some(Motion {
            peak: impact_statistics.peak(),
            peak_error: largest[0],
            rms: impact_statistics.rms(),
            rms_error: errors[0],
            impacts_per_period,
            impacts_error: errors[1],
            impact_speed: impact_statistics.impact_speed(),
            impact_speed_error: largest[1],
            settled,
            regime: signs.regime(&thresholds),
            starts: 1,
            efficiency: impact_statistics.efficiency(),
            repeats_after,
            state: simulation.state(),
        })
    }
}

/// Watches whether a trajectory repeats, which costs next to nothing.
pub(super) struct Strobes {
    pub(super) periods: Vec<Strobe>,
    pub(super) log: ImpactLog,
    impacts: u32,
}

/// An excitation period, seen at its end.
pub(super) struct Strobe {
    end: State,
    impacts: u32,
}

impl periodicity::Strobed for Strobe {
    fn end(&self) -> &State {
        &self.end
    }
    fn impacts(&self) -> u32 {
        self.impacts
    }
}

impl Strobes {
    pub(super) fn new() -> Self {
        Self {
            periods: Vec::with_capacity(WATCHED as usize),
            log: ImpactLog::of_the_last(KEPT_IMPACTS),
            impacts: 0,
        }
    }
}

impl Observer for Strobes {
    const SEGMENTS: bool = false;
    fn impact(&mut self, impact: &Impact) {
        self.impacts += 1;
        self.log.impact(impact);
    }
    fn period(&mut self, state: &State) {
        let impacts = std::mem::take(&mut self.impacts);
        self.periods.push(Strobe { end: *state, impacts });
    }
}

/// What is known of a motion that repeats before it is measured.
pub(super) struct Repetition {
    pub(super) found: Periodicity,
    asymmetry: f64,
}

impl Repetition {
    pub(super) fn of(found: Periodicity, log: &ImpactLog, system: &System) -> Self {
        Self { found, asymmetry: periodicity::asymmetry(&log.impacts, system.period()) }
    }
}
