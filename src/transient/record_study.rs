//! A structure that is driven by a record, or by several records of one spectrum: from all places of the absorber,
//! beside its alternatives, and for other natural frequencies.

use super::{Runs, WithError};
use crate::case::Case;
use crate::excitation::{Piece, Record};
use crate::executor::{Executor, map};
use crate::flights::{
    DrivenError, PlaceReading, Places, Response, even, follow, follow_from, survey,
};
use crate::linear::{TunedMassDamper, driven};
use crate::measure::Measure;
use crate::numerics::scatter::twice_standard_error;
use crate::quantity::Units;
use crate::system::{Scales, State, System};

/// What becomes of the structure under one record.
#[derive(Debug, Clone, PartialEq)]
pub struct Realisation {
    /// The structure alone.
    pub bare: Response,
    /// With the tuned mass damper of Den Hartog.
    pub damped: Response,
    /// Every place of the absorber. The trace is kept of the first record alone.
    pub places: Runs<Response>,
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
    /// Response spectrum, ascending.
    pub spectrum: Vec<SpectrumPoint>,
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
        let records = case.recording.as_ref()?.records();
        let places = case.absorber_places()?;
        let (closer, shaking) = (records.len() == 1, case.asks_for_shaking());
        let places = Places { even: places, closer, shaking, executor };
        let inactive = case.count_inactive;
        Some(Self::of(&case.system(), &case.units(), records, places, inactive))
    }

    /// Studies a system under records, from places of the absorber; those from which it never touches a wall count if they
    /// are to.
    ///
    /// # Errors
    /// As [`Self::of_case`].
    pub fn of(
        system: &System,
        units: &Units,
        records: &[Record],
        places: Places<'_>,
        inactive: bool,
    ) -> Result<Self, DrivenError> {
        let study = Self::brief(system, units, records, places, inactive)?;
        let point = |k: usize| {
            let part = 2.0 * k as f64 / f64::from(FREQUENCIES - 1) - 1.0;
            spectrum_point(system, units, records, libm::pow(FURTHEST, part))
        };
        let spectrum = map(places.executor, "frequencies", FREQUENCIES as usize, point);
        Ok(Self { spectrum: spectrum.into_iter().collect::<Result<_, _>>()?, ..study })
    }

    /// The same without the response spectrum.
    pub(super) fn brief(
        system: &System,
        units: &Units,
        records: &[Record],
        places: Places<'_>,
        inactive: bool,
    ) -> Result<Self, DrivenError> {
        let first = records.first().ok_or(DrivenError::NoRecord)?;
        let [from, to] = [first.samples.first(), first.samples.last()]
            .map(|sample| sample.map_or(0.0, |sample| sample[0]));
        Ok(Self {
            system: *system,
            damper: TunedMassDamper::den_hartog(system.mass_ratio()),
            input_peaks: records.iter().map(Record::peak).collect(),
            length: (to - from, first.samples.len()),
            realisations: realisations(system, units, records, places, inactive)?,
            spectrum: Vec::new(),
        })
    }

    /// The longest time for which a structure was followed after the end of its record.
    pub fn rang(&self) -> f64 {
        self.responses().map(|one| one.rang).fold(0.0, f64::max)
    }

    /// By how much a displacement of a motion that was given up may become larger: 0 unless nothing takes its energy.
    pub fn open(&self) -> f64 {
        self.responses().map(|one| one.open).fold(0.0, f64::max)
    }

    fn responses(&self) -> impl Iterator<Item = &Response> {
        fn of_one(one: &Realisation) -> impl Iterator<Item = &Response> {
            let placed = one.places.all.iter().map(|(_, found)| found);
            [&one.bare, &one.damped].into_iter().chain(placed)
        }
        self.realisations.iter().flat_map(of_one)
    }

    /// What happened under the first record.
    pub fn first(&self) -> Option<&Realisation> {
        self.realisations.first()
    }
}

impl Realisation {
    /// The largest from any place of the absorber, and by how much others may exceed it: of the displacement also what may
    /// come of a motion that was given up.
    pub(super) fn largest(&self, of: Measure) -> Option<WithError> {
        let [value, error] = self.places.largest(of)?;
        let more = |(_, found): &(f64, Response)| found.peak + found.open - value;
        let open = match of {
            Measure::Peak => self.places.all.iter().map(more).fold(0.0, f64::max),
            _ => 0.0,
        };
        Some([value, error + open])
    }

    /// The place of the absorber with the largest displacement, and what it did from there.
    pub fn worst(&self) -> Option<&(f64, Response)> {
        self.places.worst(Measure::Peak)
    }
}

/// What is known of all records: of one its own, of several the mean.
pub(super) fn over_records(each: &[WithError]) -> WithError {
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
    places: Places<'_>,
    inactive: bool,
) -> Result<Vec<Realisation>, DrivenError> {
    let damper = TunedMassDamper::den_hartog(system.mass_ratio());
    let pieces: Vec<Vec<Piece>> =
        records.iter().map(|record| record.pieces_to_rest(units, Record::LONGEST)).collect();
    let one = |(k, pieces): (usize, &Vec<Piece>)| {
        let found = flown(system, pieces, places, inactive)?;
        let kept = |response: Response| match k {
            0 => response,
            _ => Response { trace: Vec::new(), ..response },
        };
        Ok(Realisation {
            bare: kept(driven(system, None, pieces, places.shaking)),
            damped: kept(driven(system, Some(&damper), pieces, places.shaking)),
            places: Runs {
                all: found.all.into_iter().map(|(w, response)| (w, kept(response))).collect(),
                ..found
            },
        })
    };
    pieces.iter().enumerate().map(one).collect()
}

/// What the structure does from each place of the absorber.
pub(super) fn flown(
    system: &System,
    pieces: &[Piece],
    places: Places<'_>,
    inactive: bool,
) -> Result<Runs<Response>, DrivenError> {
    let measures: [PlaceReading<'_, Response>; 3] =
        [&|found| found.peak, &|found| found.rms, &|found| found.impact_speed];
    let all = survey(places, &measures, |w| {
        let start = State { y: -w, ..State::AT_REST };
        follow_from(system, pieces, start, places.shaking, &mut |_| {})
    })?;
    Ok(Runs { all, even: places.even, count_inactive: inactive })
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
        let pieces = record.pieces_to_rest(&units, Record::LONGEST);
        let mut worst = 0.0_f64;
        for w in even(places) {
            worst = worst.max(follow(system, &pieces, w)?.peak);
        }
        let linear = |damper| driven(system, damper, &pieces, false).peak;
        for (sum, peak) in sums.iter_mut().zip([linear(None), worst, linear(Some(&damper))]) {
            *sum += peak;
        }
    }
    let [bare, absorber, damped] = sums.map(|sum| sum / records.len() as f64);
    Ok(SpectrumPoint { ratio, bare, absorber, damped })
}
