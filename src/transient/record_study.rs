//! A structure that is driven by a record, or by several records of one spectrum: from all places of the absorber,
//! beside its alternatives, and for other natural frequencies.

use super::counted;
use crate::case::Case;
use crate::excitation::{Piece, Record};
use crate::executor::{Executor, map};
use crate::flights::{
    DrivenError, Measure, Places, Response, even, follow, survey, worst_of_places,
};
use crate::linear::{TunedMassDamper, driven, reduction_db};
use crate::numerics::scatter::twice_standard_error;
use crate::quantity::Units;
use crate::system::{Scales, System};

/// A value and its error: of one record how much worse other places of the absorber may be, of several twice the
/// standard error of the mean over records.
pub type Measured = [f64; 2];

/// What becomes of the structure under one record.
#[derive(Debug, Clone, PartialEq)]
pub struct Realisation {
    /// The structure alone.
    pub bare: Response,
    /// With the tuned mass damper of Den Hartog.
    pub damped: Response,
    /// Every place of the absorber, over the clearance, and what it did from there, in the order in which they were
    /// flown. The trace is kept of the first record alone.
    pub places: Vec<(f64, Response)>,
}

/// Peak displacements of a structure of another natural frequency, mean over records. Its mass, damping ratio,
/// absorber and clearance are the same; the damper is tuned to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpectrumPoint {
    /// Natural frequency over the case's own.
    pub ratio: f64,
    /// The structure alone, over the clearance.
    pub bare: f64,
    /// With the absorber, at its worst place.
    pub absorber: f64,
    /// With the damper.
    pub damped: f64,
}

/// A driven structure with everything that is known of it.
#[derive(Debug, Clone)]
pub struct RecordStudy {
    /// The system; its excitation does not matter.
    pub system: System,
    /// The damper.
    pub damper: TunedMassDamper,
    /// Largest value of each record, in SI.
    pub input_peaks: Vec<f64>,
    /// Length of the records in seconds, and their samples.
    pub length: (f64, usize),
    /// One for each record.
    pub realisations: Vec<Realisation>,
    /// Even places of the absorber under each record; under a single one there are closer places as well.
    pub even: u64,
    /// Response spectrum, ascending.
    pub spectrum: Vec<SpectrumPoint>,
    /// Whether places count from which the absorber never touches a wall.
    pub count_inactive: bool,
}

/// The response spectrum: frequencies, the furthest over the structure's own, places times records, and the most
/// records.
const FREQUENCIES: u32 = 31;
const FURTHEST: f64 = 4.0;
const FLIGHTS_OF_FREQUENCY: usize = 8;
const RECORDS_OF_SPECTRUM: usize = 4;

impl RecordStudy {
    /// Flights of one record for its response spectrum.
    pub const FLIGHTS_OF_SPECTRUM: u64 = FREQUENCIES as u64 * FLIGHTS_OF_FREQUENCY as u64;

    /// Studies a case that is driven by a record; none for another.
    ///
    /// # Errors
    /// [`DrivenError`] where the motion cannot be followed, or where nobody has handed in the samples.
    pub fn of_case(case: &Case, executor: &dyn Executor) -> Option<Result<Self, DrivenError>> {
        let recording = case.recording.as_ref()?;
        let records = recording.records();
        let places = case.absorber_places()?;
        let study = Self::of(&case.system(), &case.units(), &records, places, executor);
        Some(study.map(|study| Self { count_inactive: case.count_inactive, ..study }))
    }

    /// Studies a system under records, the absorber at so many even places of its cavity.
    ///
    /// # Errors
    /// As [`Self::of_case`].
    pub fn of(
        system: &System,
        units: &Units,
        records: &[Record],
        places: u64,
        executor: &dyn Executor,
    ) -> Result<Self, DrivenError> {
        let study = Self::without_spectrum(system, units, records, places, executor)?;
        let point = |k: usize| {
            let part = 2.0 * k as f64 / f64::from(FREQUENCIES - 1) - 1.0;
            spectrum_point(system, units, records, libm::pow(FURTHEST, part))
        };
        let spectrum = map(executor, "frequencies", FREQUENCIES as usize, point);
        Ok(Self { spectrum: spectrum.into_iter().collect::<Result<_, _>>()?, ..study })
    }

    /// The same without the response spectrum.
    pub(crate) fn without_spectrum(
        system: &System,
        units: &Units,
        records: &[Record],
        places: u64,
        executor: &dyn Executor,
    ) -> Result<Self, DrivenError> {
        let first = records.first().ok_or(DrivenError::NoRecord)?;
        let [from, to] = [first.samples.first(), first.samples.last()]
            .map(|sample| sample.map_or(0.0, |sample| sample[0]));
        Ok(Self {
            system: *system,
            damper: TunedMassDamper::den_hartog(system.mass_ratio()),
            input_peaks: records.iter().map(Record::peak).collect(),
            length: (to - from, first.samples.len()),
            realisations: realisations(system, units, records, places, executor)?,
            even: places,
            spectrum: Vec::new(),
            count_inactive: true,
        })
    }

    fn counted<'a>(&self, one: &'a Realisation) -> Vec<&'a (f64, Response)> {
        counted(&one.places, self.count_inactive, |(_, response)| response.impacts)
    }

    /// The largest value over the places of the absorber, mean over records.
    pub fn worst(&self, value: impl Fn(&Realisation, &Response) -> f64) -> Measured {
        let of_places = |one: &Realisation| -> Measured {
            let counted = self.counted(one).into_iter();
            worst_of_places(&counted.map(|(_, place)| value(one, place)).collect::<Vec<f64>>())
        };
        over_records(&self.realisations.iter().map(of_places).collect::<Vec<Measured>>())
    }

    /// The mean over records of what each has for itself; without error where there is only one.
    pub fn mean(&self, value: impl Fn(&Realisation) -> f64) -> Measured {
        let values = self.realisations.iter().map(|one| [value(one), 0.0]);
        over_records(&values.collect::<Vec<Measured>>())
    }

    /// The least reduction of the largest displacement against another, in decibels.
    pub fn reduction_db(&self, against: impl Fn(&Realisation) -> f64) -> Measured {
        let [increase, error] = self.worst(|one, place| -reduction_db(place.peak, against(one)));
        [-increase, error]
    }

    /// What happened under the first record from the place with the largest displacement.
    pub fn shown(&self) -> Option<(&Realisation, &Response)> {
        let first = self.realisations.first()?;
        Some((first, &self.worst_of(first)?.1))
    }

    /// That place of the absorber, over the clearance.
    pub fn worst_place(&self) -> Option<f64> {
        Some(self.worst_of(self.realisations.first()?)?.0)
    }

    fn worst_of<'a>(&self, one: &'a Realisation) -> Option<&'a (f64, Response)> {
        let places = self.counted(one).into_iter();
        places.max_by(|a, b| a.1.peak.total_cmp(&b.1.peak))
    }
}

/// What is known of all records: of one its own, of several the mean.
pub(super) fn over_records(each: &[Measured]) -> Measured {
    if let [only] = each {
        return *only;
    }
    let values: Vec<f64> = each.iter().map(|[value, _]| *value).collect();
    [values.iter().sum::<f64>() / values.len() as f64, twice_standard_error(&values)]
}

fn realisations(
    system: &System,
    units: &Units,
    records: &[Record],
    places: u64,
    executor: &dyn Executor,
) -> Result<Vec<Realisation>, DrivenError> {
    let damper = TunedMassDamper::den_hartog(system.mass_ratio());
    let pieces: Vec<Vec<Piece>> =
        records.iter().map(|record| record.pieces(units, Record::LONGEST)).collect();
    let places = Places { even: places, closer: records.len() == 1, executor };
    let one = |(k, pieces): (usize, &Vec<Piece>)| {
        let found = flown(system, pieces, places)?.into_iter();
        let kept = |response: Response| match k {
            0 => response,
            _ => Response { trace: Vec::new(), ..response },
        };
        Ok(Realisation {
            bare: kept(driven(system, None, pieces)),
            damped: kept(driven(system, Some(&damper), pieces)),
            places: found.map(|(w, response)| (w, kept(response))).collect(),
        })
    };
    pieces.iter().enumerate().map(one).collect()
}

/// What the structure does from each place of the absorber.
pub(super) fn flown(
    system: &System,
    pieces: &[Piece],
    places: Places<'_>,
) -> Result<Vec<(f64, Response)>, DrivenError> {
    let measures: [Measure<'_, Response>; 3] =
        [&|found| found.peak, &|found| found.rms, &|found| found.impact_speed];
    survey(places, &measures, |w| follow(system, pieces, w))
}

fn spectrum_point(
    system: &System,
    units: &Units,
    records: &[Record],
    ratio: f64,
) -> Result<SpectrumPoint, DrivenError> {
    let units = Scales { natural_frequency: ratio * units.natural_frequency, ..**units };
    let damper = TunedMassDamper::den_hartog(system.mass_ratio());
    let records = &records[..records.len().min(RECORDS_OF_SPECTRUM)];
    let places = (FLIGHTS_OF_FREQUENCY / records.len()) as u64;
    let mut sums = [0.0; 3];
    for record in records {
        let pieces = record.pieces(&units, Record::LONGEST);
        let mut worst = 0.0_f64;
        for w in even(places) {
            worst = worst.max(follow(system, &pieces, w)?.peak);
        }
        let linear = |damper| driven(system, damper, &pieces).peak;
        for (sum, peak) in sums.iter_mut().zip([linear(None), worst, linear(Some(&damper))]) {
            *sum += peak;
        }
    }
    let [bare, absorber, damped] = sums.map(|sum| sum / records.len() as f64);
    Ok(SpectrumPoint { ratio, bare, absorber, damped })
}
