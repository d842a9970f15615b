//! A structure whose natural frequency may be off, with a linear device or none.

use super::Room;
use crate::case::Case;
use crate::dampers::Designing;
use crate::excitation::{Piece, Record, Transient};
use crate::linear::{
    BandSystems, TunedMassDamper, bare_amplitude, bare_decay, driven, released_between, swept,
};
use crate::measure::{Device, Measure};
use crate::system::{Band, System};
use crate::transient::{Run, longest};

/// Its case, and what drives it.
pub(super) struct DriftedCase {
    pub case: Case,
    measure: Measure,
    /// Natural frequency over the case's own.
    factor: f64,
    band: Band,
    pieces: Vec<Vec<Piece>>,
}

/// Steps of a simplex where one evaluation is a whole sweep or record.
const STEPS_OF_LONG: u64 = 30;

impl DriftedCase {
    /// That of a case with so many times its natural frequency; none where there is none.
    pub fn of(case: &Case, measure: Measure, factor: f64) -> Option<Self> {
        let case = if factor == 1.0 { case.clone() } else { case.with_natural_frequency(factor)? };
        let units = case.units();
        let pieces =
            case.records().iter().map(|record| record.pieces_to_rest(&units, Record::LONGEST));
        let pieces = pieces.collect();
        Some(Self { band: case.range(), pieces, case, measure, factor })
    }

    /// How a damper is designed for it: what is long is evaluated less often.
    pub fn designing(&self) -> Designing {
        match self.case.design.transient() {
            Some(Transient::Sweep(_) | Transient::Record(_)) => {
                Designing { steps: STEPS_OF_LONG, restarts: 1, damping: None }
            }
            _ => Designing::USUAL,
        }
    }

    /// Whether it is driven steadily at one frequency.
    pub fn is_of_one_frequency(&self) -> bool {
        self.case.design.transient().is_none() && self.band.is_of_one_frequency()
    }

    /// Whether stops are simulated.
    pub fn has_stops(&self) -> bool {
        self.case.design.release().is_some()
    }

    /// What is asked, and the stroke, with a damper tuned to the case's own structure, or without; in SI or the units of a
    /// reduced case.
    pub fn told(&self, damper: Option<&TunedMassDamper>, room: Room) -> [f64; 2] {
        let damper = damper.map(|damper| damper.on_detuned(self.factor));
        let (system, units) = (self.case.system(), self.case.units());
        let asked = |found: &dyn Run| found.get(self.measure).unwrap_or(f64::INFINITY);
        let [worst, stroke] = match self.case.design.transient() {
            None => self.along(damper.as_ref()),
            Some(Transient::Release(release)) => {
                let start = release.state(&units, 0.0);
                let level = self.case.decay_level * crate::excitation::amplitude(&start);
                let bare = bare_decay(&system, self.case.decay_level);
                let Some(damper) = damper.as_ref() else {
                    return [units.time(std::f64::consts::TAU * bare), 0.0];
                };
                let stops = (room == Room::Stops).then_some(1.0);
                let found =
                    released_between(&system, Some(damper), stops, start, level, longest(bare));
                [found.settles, found.stroke]
            }
            Some(Transient::Sweep(sweep)) => {
                let shaking = self.measure.is_of_shaking();
                let found = swept(&system, damper.as_ref(), &units, &sweep, shaking);
                [asked(&found), found.stroke]
            }
            Some(Transient::Record(_)) => {
                let mut sums = [0.0; 2];
                for pieces in &self.pieces {
                    let shaking = self.measure.is_of_shaking();
                    let found = driven(&system, damper.as_ref(), pieces, shaking);
                    sums[0] += asked(&found);
                    sums[1] += found.stroke;
                }
                sums.map(|sum| sum / self.pieces.len() as f64)
            }
        };
        let worst = match self.measure {
            Measure::DecayTime => units.time(std::f64::consts::TAU * worst),
            of => {
                of.kind(Device::Damper).map_or(f64::NAN, |kind| units.number(kind.dimension, worst))
            }
        };
        [worst, units.length(stroke)]
    }

    /// The largest value and stroke along the band.
    fn along(&self, damper: Option<&TunedMassDamper>) -> [f64; 2] {
        let along = BandSystems::of(&self.band);
        let largest =
            |amplitude: &dyn Fn(&System) -> f64| self.measure.largest_of_sines(&along, amplitude);
        match damper {
            Some(damper) => {
                let stroke = along.largest(|system| damper.stroke(system)).1;
                [largest(&|system| damper.amplitude(system)), stroke]
            }
            None => [largest(&bare_amplitude), 0.0],
        }
    }
}
