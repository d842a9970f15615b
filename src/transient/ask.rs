//! What becomes of a structure that is not driven steadily, asked measure by measure: criteria, sweeps, optima and pages
//! read this and nothing else.

use std::f64::consts::TAU;

use super::record_study::over_records;
use super::{Run, Runs, Sample, Study, WithError};
use crate::linear::reduction;
use crate::measure::{Device, Measure, with_pulse};
use crate::method::Method;
use crate::quantity::{Quantity, Units};

/// A value with its error, dimensionless, and the layer that it is from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AskedValue {
    /// Lengths over the clearance, fast time; and how much worse other places of the absorber may be, or twice the
    /// standard error of the mean over records; NaN where nobody knows.
    pub value: WithError,
    /// The layer.
    pub method: Method,
}

/// What is compared under one condition: a record, or the only release or sweep.
struct Compared<'a> {
    largest: &'a dyn Fn(Measure) -> Option<WithError>,
    without: &'a dyn Run,
    damper: &'a dyn Fn() -> &'a dyn Run,
}

/// The structure alone on its way to rest: oscillations in closed form.
struct Alone(f64);

impl Run for Alone {
    fn get(&self, of: Measure) -> Option<f64> {
        (of == Measure::DecayTime).then_some(self.0)
    }
}

impl Compared<'_> {
    /// With the absorber the largest from any place that counts; a reduction is that of the largest displacement.
    fn ask(&self, of: Measure, by: Device) -> Option<WithError> {
        let linear = |by: Device| if by == Device::Damper { (self.damper)() } else { self.without };
        match (by, of.against()) {
            (Device::Absorber, Some(other)) => {
                let against = linear(other).get(Measure::Peak)?;
                (self.largest)(Measure::Peak).map(|peak| reduction(peak, against))
            }
            (Device::Absorber, None) => (self.largest)(of),
            _ => linear(by).get(of).map(|value| [value, 0.0]),
        }
    }
}

impl Study {
    /// Records that drive the structure; 0 where none does.
    pub fn records(&self) -> usize {
        match self {
            Self::Record(study) => study.realisations.len(),
            _ => 0,
        }
    }

    /// From which places of the absorber it is known, of several records under each; none where nothing was flown.
    pub fn sample(&self) -> Option<Sample> {
        let sample = match self {
            Self::Release(study) => study.starts.sample(),
            Self::Sweep(study) => study.starts.sample(),
            Self::Record(study) => study.realisations.first()?.places.sample(),
        };
        (sample.all > 0).then_some(sample)
    }

    /// By which the worst place of the absorber is told.
    pub const fn objective(&self) -> Measure {
        match self {
            Self::Release(_) => Measure::DecayTime,
            Self::Sweep(_) | Self::Record(_) => Measure::Peak,
        }
    }

    /// What is known of a measure; none where it says nothing, or nothing was simulated.
    pub fn ask(&self, of: Measure, by: Device) -> Option<AskedValue> {
        let time = |[value, error]: WithError| [TAU * value, TAU * error];
        let exact =
            |value: f64| Some(AskedValue { value: [value, 0.0], method: Method::ClosedForm });
        let value = match (self, by, of) {
            (Self::Release(study), Device::Absorber, Measure::DecayTime) => {
                study.worst()?;
                let found = study.decay();
                let method = if found.inactive { Method::ClosedForm } else { Method::Simulation };
                return Some(AskedValue { value: time(found.oscillations), method });
            }
            (Self::Release(study), _, Measure::TheoryDecayTime) => {
                let theory = &study.predicted;
                // Of first order in the mass ratio, and more below the end of capture: nobody knows how much.
                let value = [TAU * theory.oscillations?, f64::NAN];
                return Some(AskedValue { value, method: theory.method });
            }
            (Self::Release(study), _, Measure::InactiveShare) => {
                return exact(study.inactive.share);
            }
            // Of the worst place, under the first record.
            (
                _,
                Device::Absorber,
                Measure::PeakFrequency | Measure::Impacts | Measure::ImpactEnergyShare,
            ) => [self.of_worst(of)?, 0.0],
            _ => over_records(&self.of_conditions(of, by)?),
        };
        let method = if by == Device::Absorber { Method::Simulation } else { Method::ClosedForm };
        let value = if of == Measure::DecayTime { time(value) } else { value };
        Some(AskedValue { value, method })
    }

    /// The same in SI, or in the units of a reduced case.
    pub fn quantity(&self, units: &Units, of: Measure, by: Device) -> Option<Quantity> {
        let found = self.told(units, of, by)?;
        if (of, by) != (Measure::PeakAcceleration, Device::Absorber) {
            return Some(found);
        }
        let pair = |one: Quantity| [one.value, one.error];
        let speed = self.told(units, Measure::ImpactSpeed, by).map_or([0.0; 2], pair);
        let [value, error] = with_pulse(found.kind, pair(found), speed, units);
        Some(Quantity::new(found.kind, value, found.method).with_error(error))
    }

    fn told(&self, units: &Units, of: Measure, by: Device) -> Option<Quantity> {
        let AskedValue { value, method } = self.ask(of, by)?;
        let kind = match by {
            Device::Absorber => of.kind_under(self.records()),
            _ => of.kind(by),
        };
        Some(units.quantity_with(kind?, value, method))
    }

    fn of_worst(&self, of: Measure) -> Option<f64> {
        fn worst<R: Run>(runs: &Runs<R>, of: Measure, by: Measure) -> Option<f64> {
            runs.worst(by)?.1.get(of)
        }
        let by = self.objective();
        match self {
            Self::Release(study) => worst(&study.starts, of, by),
            Self::Sweep(study) => worst(&study.starts, of, by),
            Self::Record(study) => worst(&study.realisations.first()?.places, of, by),
        }
    }

    /// What each condition says.
    fn of_conditions(&self, of: Measure, by: Device) -> Option<Vec<WithError>> {
        fn one<'a>(
            (of, by): (Measure, Device),
            largest: &'a dyn Fn(Measure) -> Option<WithError>,
            without: &'a dyn Run,
            damper: &'a dyn Fn() -> &'a dyn Run,
        ) -> Option<WithError> {
            Compared { largest, without, damper }.ask(of, by)
        }
        let asked = (of, by);
        match self {
            Self::Release(study) => {
                let alone = Alone(study.bare);
                let damper = || &study.damped().1 as &dyn Run;
                Some(vec![one(asked, &|of| study.starts.largest(of), &alone, &damper)?])
            }
            Self::Sweep(study) => {
                let damper = || &study.damped().1 as &dyn Run;
                Some(vec![one(asked, &|of| study.starts.largest(of), &study.alone, &damper)?])
            }
            Self::Record(study) => {
                let each = study.realisations.iter();
                each.map(|here| {
                    let damper = || &here.damped as &dyn Run;
                    one(asked, &|of| here.largest(of), &here.bare, &damper)
                })
                .collect()
            }
        }
    }
}
