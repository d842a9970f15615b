//! A structure whose natural frequency may be off, with a linear device or none.

use super::drifting::{Dampers, Drifting};
use super::{DESIGN, Known, Room, compared, compared_by};
use crate::band::{Survey, SurveySettings, Worst};
use crate::case::Case;
use crate::criteria;
use crate::dampers::{Designing, SineLimits};
use crate::excitation::{Piece, Record, Scene, Transient};
use crate::executor::Executor;
use crate::flights::{DrivenError, Places};
use crate::linear::{
    BandSystems, TunedMassDamper, bare_amplitude, bare_decay, driven, released_between, swept,
};
use crate::measure::{Device, Measure};
use crate::motions::{BandEffort, Effort, along};
use crate::system::{Band, System};
use crate::transient::{Run, Study, longest};

/// Its case, and what drives it.
pub(super) struct DriftedCase<'a> {
    pub case: Case,
    measure: Measure,
    /// What dampers are designed for where it is driven steadily.
    asked: SineLimits,
    /// How thoroughly motions of the case are searched.
    effort: &'a Effort,
    /// Natural frequency over the case's own.
    factor: f64,
    band: Band,
    pieces: Vec<Vec<Piece>>,
}

/// Places along a band where its structure is another: the error says what they may miss.
const BAND: BandEffort =
    BandEffort { even: 13, starts: 6, starts_between: 2, most: 60, tolerance: 0.05 };
/// Places of the absorber under a record, each of which is long.
const PLACES_OF_RECORD: u64 = 8;
/// Steps of a simplex where one evaluation is a whole sweep or record.
const STEPS_OF_LONG: u64 = 30;

impl<'a> DriftedCase<'a> {
    /// That of a case.
    pub fn of(case: &Case, measure: Measure, effort: &'a Effort) -> Self {
        Self::with(case.clone(), measure, 1.0, effort)
    }

    fn with(case: Case, measure: Measure, factor: f64, effort: &'a Effort) -> Self {
        let units = case.units();
        let pieces =
            case.records().iter().map(|record| record.pieces_to_rest(&units, Record::LONGEST));
        let pieces = pieces.collect();
        Self {
            band: case.range(),
            asked: criteria::sine_limits(&case),
            pieces,
            case,
            measure,
            effort,
            factor,
        }
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

impl Drifting for DriftedCase<'_> {
    type Dampers = TunedMassDamper;
    type Error = DrivenError;

    fn drifted(&self, factor: f64) -> Option<Self> {
        let case = match factor {
            1.0 => self.case.clone(),
            _ => self.case.with_natural_frequency(factor)?,
        };
        Some(Self::with(case, self.measure, factor, self.effort))
    }

    fn room(&self) -> f64 {
        self.case.design.clearance()
    }

    fn is_of_one_frequency(&self) -> bool {
        self.case.design.transient().is_none() && self.band.is_of_one_frequency()
    }

    fn has_stops(&self) -> bool {
        self.case.design.release().is_some()
    }

    fn designing(&self) -> Designing {
        match self.case.design.transient() {
            Some(Transient::Sweep(_) | Transient::Record(_)) => {
                Designing { steps: STEPS_OF_LONG, restarts: 1, damping: None }
            }
            _ => Designing::USUAL,
        }
    }

    fn told(&self, damper: Option<&TunedMassDamper>, room: Room) -> [f64; 2] {
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

    /// Where it is driven steadily by all that is asked, as the damper that is best for the case.
    fn cost(&self, damper: &TunedMassDamper) -> [f64; 2] {
        if self.case.design.transient().is_some() || self.asked.is_of_displacement() {
            return self.told(Some(damper), Room::AsDesigned);
        }
        let along = BandSystems::of(&self.band);
        let damper = damper.on_detuned(self.factor);
        let missed = self.asked.missed(&along, |system| damper.amplitude(system));
        let stroke = along.largest(|system| damper.stroke(system)).1;
        [missed, self.case.units().length(stroke)]
    }

    fn absorber(&self, on: &dyn Executor) -> Result<Option<[f64; 2]>, DrivenError> {
        let Self { case, measure, .. } = self;
        let (measure, units) = (*measure, case.units());
        if case.design.transient().is_none() {
            let effort = Effort { band: BAND, ..self.effort.short() };
            if measure != Measure::Peak {
                let settings = SurveySettings { effort: Some(effort), ..criteria::settings(case) };
                let survey = Survey::of(&case.range(), &settings, None, on)?;
                return Ok(by_criterion(case, &survey).map(|(found, _)| found));
            }
            let found = along(&case.range(), &[], None, Some(&effort), on)?;
            let worst = Worst::of(&found, case.count_inactive);
            return Ok(
                worst.map(|one| [one.peak.value, one.peak.error].map(|one| units.length(one)))
            );
        }
        let even = case.absorber_places().unwrap_or_default();
        let even = if case.recording.is_some() { even.min(PLACES_OF_RECORD) } else { even };
        let closer = case.recording.is_none();
        let places = Places { even, closer, shaking: measure.is_of_shaking(), executor: on };
        let Some(study) = Study::brief_of_case(case, places) else { return Ok(None) };
        let study = study?;
        let found = study.quantity(&units, measure, Device::Absorber);
        Ok(found.map(|found| [found.value, found.error]))
    }
}

impl Dampers for TunedMassDamper {
    const DESIGN: f64 = DESIGN;

    fn each(&self) -> Vec<TunedMassDamper> {
        vec![*self]
    }

    fn with(&self, each: &[TunedMassDamper]) -> Self {
        each.first().copied().unwrap_or(*self)
    }
}

/// What devices are compared by: of a release the time that it takes.
pub(super) fn asked(case: &Case) -> Measure {
    match case.design.scene() {
        Scene::Release => Measure::DecayTime,
        _ => compared_by(&case.criteria).map_or(Measure::Peak, |one| one.measure),
    }
}

/// What the criterion by which devices are compared found, of a case that is driven steadily, and whether in an absorber that stays at
/// rest.
fn by_criterion(case: &Case, survey: &Survey) -> Option<([f64; 2], bool)> {
    let judged = criteria::judge(case, survey);
    let judged = compared(&judged)?;
    Some(([judged.found?, judged.error], judged.inactive.is_some()))
}

/// The absorber as every page tells it, and whether that is one which stays at rest.
pub(super) fn own(case: &Case, known: Known<'_>, measure: Measure) -> Option<([f64; 2], bool)> {
    let units = case.units();
    if let Some(study) = known.study {
        let found = study.quantity(&units, measure, Device::Absorber)?;
        let inactive = matches!(study, Study::Release(of) if of.decay().inactive);
        return Some(([found.value, found.error], inactive));
    }
    if measure != Measure::Peak {
        return by_criterion(case, known.survey?);
    }
    let worst = known.survey?.worst()?;
    let peak = [worst.peak.value, worst.peak.error].map(|one| units.length(one));
    Some((peak, worst.motion.rest().is_some()))
}

/// The damper of the same mass that is designed for what is asked, as every page tells it.
pub(super) fn as_designed(known: Known<'_>, here: &DriftedCase<'_>) -> TunedMassDamper {
    match (known.study, known.survey) {
        (Some(Study::Release(study)), _) => study.damped().0,
        (Some(Study::Sweep(study)), _) => study.damped().0,
        (Some(Study::Record(study)), _) => study.damper,
        (None, Some(survey)) => survey.rivals().damper,
        (None, None) => TunedMassDamper::den_hartog(here.case.system().mass_ratio()),
    }
}
