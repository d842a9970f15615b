//! What may be asked of what becomes of a structure: one list, whatever drives it. A criterion, a column of a sweep, a number
//! of a page and what an absorber is chosen for are each a measure of a device.

use crate::excitation::Scene;
use crate::linear::{BandSystems, reduction};
use crate::motions::{Fact, Motion, Value};
use crate::quantity::catalogue as of;
use crate::quantity::{ErrorKind, Kind, Units};
use crate::simulation::Reading;
use crate::system::{Shaking, System};

/// Which structure a measure is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Device {
    /// With the absorber.
    Absorber,
    /// Without any.
    Without,
    /// With a tuned mass damper of the absorber's mass.
    Damper,
}

impl Device {
    /// Its word in a document.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Absorber => "absorber",
            Self::Without => "none",
            Self::Damper => "tuned-mass-damper",
        }
    }
}

/// What of a structure has a measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// A place.
    Place,
    /// An absorber.
    Absorber,
    /// All of it.
    Whole,
}

impl Part {
    /// The key that names one; empty of the whole.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Place => "place",
            Self::Absorber => "absorber",
            Self::Whole => "",
        }
    }
}

/// Something that has a number, a word or a yes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// Largest absolute displacement of the structure.
    Peak,
    /// Frequency at which it is reached in a sweep.
    PeakFrequency,
    /// Root mean square displacement.
    Rms,
    /// Largest absolute velocity of the structure, on both sides of impacts.
    PeakVelocity,
    /// Root mean square velocity.
    RmsVelocity,
    /// Largest absolute acceleration of the structure: between impacts, unless they have a pulse.
    PeakAcceleration,
    /// Root mean square acceleration between impacts.
    RmsAcceleration,
    /// Largest displacement of absorber or damper against the structure.
    Stroke,
    /// Reduction of the peak against the structure without absorber, in decibels.
    ReductionDb,
    /// The same against the damper.
    ReductionDbTmd,
    /// Largest relative speed of an impact.
    ImpactSpeed,
    /// Impacts per excitation period.
    ImpactsPerPeriod,
    /// Impacts.
    Impacts,
    /// Share of the energy that they take.
    ImpactEnergyShare,
    /// Time in which a released structure comes to rest.
    DecayTime,
    /// The same by theory.
    TheoryDecayTime,
    /// Share of the absorber's resting places from which no wall ever reaches it.
    InactiveShare,
    /// Share of a band in area Z3.
    Z3Share,
    /// Share of a band with a stable symmetric 1:1 orbit.
    StableShare,
    /// Share by which the clearance may be off before that is lost.
    MarginClearance,
    /// Whether every start leads to one motion.
    NoCoexistence,
    /// Area and strip of the theory.
    Area,
    /// Smallest amplitude of a stable fixed point of the slow flow.
    TheoryPeak,
    /// Relative change of the excitation to the nearest boundary of the theory.
    BoundaryDistance,
    /// Peak of the exact 1:1 orbit that attracts.
    OrbitPeak,
    /// Its largest multiplier.
    OrbitMultiplier,
    /// Whether a start leads to it.
    OrbitReached,
    /// Regime of the motion that most starts lead to.
    Regime,
    /// Share of the excitation's work that its impacts dissipate.
    Efficiency,
    /// Excitation periods after which it repeats.
    RepeatsAfter,
    /// Its largest Lyapunov exponent.
    Lyapunov,
    /// Its displacements at the ends of periods.
    Section,
    /// Share of the starts that lead to it.
    ShareOfStarts,
    /// Largest peak of any motion.
    LargestPeak,
    /// Number of motions.
    Motions,
}

/// The largest acceleration of the oscillator by that between impacts and the largest relative speed of an impact, each with
/// its error: that between impacts, unless impacts have a pulse.
pub fn with_pulse(kind: &Kind, flights: [f64; 2], speed: [f64; 2], units: &Units) -> [f64; 2] {
    let pulse = units.pulse().unwrap_or(0.0);
    riding(kind, flights, speed.map(|one| pulse * one))
}

/// The same by the largest acceleration of a pulse, 0 where there is none. It rides on an acceleration that is not known, and
/// no larger than that between impacts.
pub fn riding(kind: &Kind, flights: [f64; 2], [top, error]: [f64; 2]) -> [f64; 2] {
    if top <= 0.0 {
        return flights;
    }
    let rides = flights[0] + flights[1];
    let least = flights[0].max(top - rides);
    let most = top + error + rides;
    match kind.error {
        ErrorKind::Most => [least, most - least],
        ErrorKind::Interval | ErrorKind::Least => [0.5 * (least + most), 0.5 * (most - least)],
    }
}

impl Measure {
    /// The kind of its value; none where that is a word, or yes or no.
    pub const fn kind(self, by: Device) -> Option<&'static Kind> {
        Some(match (self, by) {
            (Self::Peak, Device::Absorber) => &of::PEAK,
            (Self::Peak, Device::Without) => &of::BARE_PEAK,
            (Self::Peak, Device::Damper) => &of::DAMPER_PEAK,
            (Self::PeakFrequency, Device::Absorber) => &of::PEAK_FREQUENCY,
            (Self::PeakFrequency, Device::Without) => &of::BARE_PEAK_FREQUENCY,
            (Self::PeakFrequency, Device::Damper) => &of::DAMPER_PEAK_FREQUENCY,
            (Self::Rms, Device::Absorber) => &of::RMS,
            (Self::Rms, Device::Without) => &of::BARE_RMS,
            (Self::Rms, Device::Damper) => &of::DAMPER_RMS,
            (Self::PeakVelocity, _) => &of::PEAK_VELOCITY,
            (Self::RmsVelocity, _) => &of::RMS_VELOCITY,
            (Self::PeakAcceleration, _) => &of::PEAK_ACCELERATION,
            (Self::RmsAcceleration, _) => &of::RMS_ACCELERATION,
            (Self::DecayTime, Device::Absorber) => &of::DECAY_TIME,
            (Self::DecayTime, Device::Without) => &of::BARE_DECAY_TIME,
            (Self::DecayTime, Device::Damper) => &of::DAMPER_DECAY_TIME,
            (Self::Stroke, _) => &of::DAMPER_STROKE,
            (Self::ReductionDb, _) => &of::REDUCTION_DB,
            (Self::ReductionDbTmd, _) => &of::REDUCTION_DB_TMD,
            (Self::ImpactSpeed, _) => &of::IMPACT_SPEED,
            (Self::ImpactsPerPeriod, _) => &of::IMPACTS_PER_PERIOD,
            (Self::Impacts, _) => &of::IMPACT_COUNT,
            (Self::ImpactEnergyShare, _) => &of::IMPACT_ENERGY_SHARE,
            (Self::TheoryDecayTime, _) => &of::THEORY_DECAY_TIME,
            (Self::InactiveShare, _) => &of::INACTIVE_SHARE,
            (Self::Z3Share, _) => &of::Z3_SHARE,
            (Self::StableShare, _) => &of::STABLE_SHARE,
            (Self::MarginClearance, _) => &of::GAP,
            (Self::TheoryPeak, _) => &of::THEORY_PEAK,
            (Self::BoundaryDistance, _) => &of::BOUNDARY_DISTANCE,
            (Self::OrbitPeak, _) => &of::ORBIT_PEAK,
            (Self::OrbitMultiplier, _) => &of::SPECTRAL_RADIUS,
            (Self::Efficiency, _) => &of::EFFICIENCY,
            (Self::RepeatsAfter, _) => &of::REPEATS_AFTER,
            (Self::Lyapunov, _) => &of::LYAPUNOV_EXPONENT,
            (Self::Section, _) => &of::SECTION,
            (Self::ShareOfStarts, _) => &of::START_SHARE,
            (Self::LargestPeak, _) => &of::LARGEST_PEAK,
            (Self::Motions, _) => &of::MOTIONS,
            (Self::NoCoexistence | Self::Area | Self::OrbitReached | Self::Regime, _) => {
                return None;
            }
        })
    }

    /// The same with the absorber under so many records, 0 where none drives the structure: of one the worst place of the
    /// absorber decides, of several the mean.
    pub fn kind_under(self, records: usize) -> Option<&'static Kind> {
        Some(match (self, records) {
            (Self::Rms, 1) => &of::LARGEST_RMS,
            (Self::RmsVelocity, 1) => &of::LARGEST_RMS_VELOCITY,
            (Self::RmsAcceleration, 1) => &of::LARGEST_RMS_ACCELERATION,
            (Self::Peak, 2..) => &of::MEAN_PEAK,
            (Self::PeakVelocity, 2..) => &of::MEAN_PEAK_VELOCITY,
            (Self::PeakAcceleration, 2..) => &of::MEAN_PEAK_ACCELERATION,
            (Self::ReductionDb, 2..) => &of::MEAN_REDUCTION_DB,
            (Self::ReductionDbTmd, 2..) => &of::MEAN_REDUCTION_DB_TMD,
            (Self::ImpactSpeed, 2..) => &of::MEAN_IMPACT_SPEED,
            _ => return self.kind(Device::Absorber),
        })
    }

    /// Whether it is then the worst of what was seen, which may be worse and not better.
    pub fn is_worst(self, records: usize) -> bool {
        self.kind_under(records).is_some_and(|kind| kind.error != ErrorKind::Interval)
    }

    /// Whether it makes sense of a structure that is subjected to this.
    pub fn is_of(self, scene: Scene) -> bool {
        match self {
            Self::Peak | Self::ImpactSpeed | Self::PeakVelocity | Self::PeakAcceleration => true,
            Self::Rms | Self::RmsVelocity | Self::RmsAcceleration => {
                matches!(scene, Scene::Steady | Scene::Record)
            }
            Self::ReductionDb | Self::ReductionDbTmd => scene != Scene::Release,
            Self::Impacts | Self::ImpactEnergyShare | Self::Stroke => scene != Scene::Steady,
            Self::DecayTime | Self::TheoryDecayTime | Self::InactiveShare => {
                scene == Scene::Release
            }
            Self::PeakFrequency => scene == Scene::Sweep,
            _ => scene == Scene::Steady,
        }
    }

    /// Whether it is about the motions that can happen, which only simulation finds.
    pub fn is_of_motions(self) -> bool {
        !matches!(self, Self::Z3Share | Self::StableShare | Self::MarginClearance)
    }

    /// Whether it is of velocity or acceleration, which nobody measures who does not ask.
    pub const fn is_of_shaking(self) -> bool {
        matches!(
            self,
            Self::PeakVelocity | Self::RmsVelocity | Self::PeakAcceleration | Self::RmsAcceleration
        )
    }

    /// What of a structure has it.
    pub const fn part(self) -> Part {
        match self {
            Self::ImpactSpeed | Self::ImpactsPerPeriod => Part::Absorber,
            _ if self.sensor().is_some() => Part::Place,
            _ => Part::Whole,
        }
    }

    /// What a sensor reads for it, and whether the root mean square of that counts; none of what a sensor does not show.
    pub const fn sensor(self) -> Option<(Reading, bool)> {
        Some(match self {
            Self::Peak | Self::ReductionDb | Self::ReductionDbTmd => (Reading::Displacement, false),
            Self::Rms => (Reading::Displacement, true),
            Self::PeakVelocity => (Reading::Velocity, false),
            Self::RmsVelocity => (Reading::Velocity, true),
            Self::PeakAcceleration => (Reading::Acceleration, false),
            Self::RmsAcceleration => (Reading::Acceleration, true),
            _ => return None,
        })
    }

    /// The device whose largest displacement it compares with; none of what compares nothing.
    pub fn against(self) -> Option<Device> {
        match self {
            Self::ReductionDb => Some(Device::Without),
            Self::ReductionDbTmd => Some(Device::Damper),
            _ => None,
        }
    }

    /// The amplitude that it compares with, of the structure alone or with a damper; not a number where it compares nothing.
    pub fn compared_with(self, bare: impl Fn() -> f64, damped: impl Fn() -> f64) -> f64 {
        match self.against() {
            Some(Device::Without) => bare(),
            Some(Device::Damper) => damped(),
            _ => f64::NAN,
        }
    }

    /// The number of a motion that decides it; none of what no single number does.
    pub const fn fact(self) -> Option<Fact> {
        Some(match self {
            Self::Peak | Self::ReductionDb | Self::ReductionDbTmd => Fact::Peak,
            Self::Rms => Fact::Rms,
            Self::ImpactSpeed => Fact::ImpactSpeed,
            Self::ImpactsPerPeriod => Fact::ImpactsPerPeriod,
            Self::PeakVelocity => Fact::PeakVelocity,
            Self::RmsVelocity => Fact::RmsVelocity,
            Self::PeakAcceleration => Fact::PeakAcceleration,
            Self::RmsAcceleration => Fact::RmsAcceleration,
            _ => return None,
        })
    }

    /// What a structure has of it that moves in a sine of this amplitude at this frequency ratio; none of what is not of the
    /// structure alone.
    pub fn of_sine(self, amplitude: f64, frequency: f64) -> Option<f64> {
        match self {
            Self::Peak => Some(amplitude),
            Self::Rms => Some(amplitude * std::f64::consts::FRAC_1_SQRT_2),
            _ => self.fact()?.of_shaking(&Shaking::of_sine(amplitude, frequency)),
        }
    }

    /// Whether a structure that moves in sines has it, which linear devices have a closed form of.
    pub fn is_of_sines(self) -> bool {
        self.of_sine(1.0, 1.0).is_some()
    }

    /// The largest of that along a band, over the clearance and in fast time, of sines with these amplitudes; infinite where
    /// nothing limits them.
    pub fn largest_of_sines(
        self,
        along: &BandSystems<'_>,
        amplitude: impl Fn(&System) -> f64,
    ) -> f64 {
        let of = |one: &System| self.of_sine(amplitude(one), one.frequency_ratio());
        along.largest(|system| of(system).unwrap_or(f64::INFINITY)).1
    }

    /// What a long-term motion has of it, with its error, in SI or the units of a reduced case; `number` has those of the motion,
    /// along a band with the error that they have between its places. A reduction is [`Self::against`] an amplitude: one that
    /// nothing limits says nothing.
    pub fn of_motion(
        self,
        motion: &Motion,
        number: &dyn Fn(Fact) -> Option<Value>,
        against: f64,
        units: &Units,
    ) -> Option<[f64; 2]> {
        let pair = |of: Value| [of.value, of.error];
        let known = |fact: Fact| number(fact).map(pair);
        let value = match self {
            Self::ReductionDb | Self::ReductionDbTmd if against.is_finite() => {
                reduction(known(Fact::Peak)?, against)
            }
            Self::ReductionDb | Self::ReductionDbTmd => return None,
            Self::PeakAcceleration => {
                let flights = known(Fact::PeakAcceleration)?.map(|one| units.acceleration(one));
                let speed = known(Fact::ImpactSpeed)?.map(|one| units.velocity(one));
                return Some(with_pulse(&of::PEAK_ACCELERATION, flights, speed, units));
            }
            Self::Efficiency => pair(motion.facts().efficiency?),
            _ => known(self.fact()?)?,
        };
        let dimension = self.kind(Device::Absorber)?.dimension;
        Some(value.map(|one| units.number(dimension, one)))
    }
}
