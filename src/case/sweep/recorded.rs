//! What a sweep records of each point.

use crate::excitation::Scene;
use crate::measure::{Device, Measure};
use crate::quantity::Kind;
use vinesink_core::names;

names! { key:
    /// Something that is recorded of each point.
    #[derive(schemars::JsonSchema)]
    pub enum Recorded {
        /// Time in which a structure that is released or struck comes to rest without absorber.
        BareDecayTime = "bare_decay_time",
        /// The same with a tuned mass damper of the absorber's mass.
        DamperDecayTime = "damper_decay_time",
        /// The same with the absorber, by theory.
        TheoryDecayTime = "theory_decay_time",
        /// Share of the absorber's resting places from which no wall ever reaches it.
        InactiveShare = "inactive_share",
        /// Largest displacement without absorber in a sweep through resonance or under a record; mean over records.
        BarePeak = "bare_peak",
        /// The same with a tuned mass damper of the absorber's mass.
        DamperPeak = "damper_peak",
        /// Root mean square displacement without absorber under a record.
        BareRms = "bare_rms",
        /// The same with a tuned mass damper.
        DamperRms = "damper_rms",
        /// Area Z1 to Z4 of the theory, and the strip A1 or A2 within it.
        Area = "area",
        /// Smallest amplitude of a stable fixed point of the slow flow.
        TheoryPeak = "theory_peak",
        /// Relative change of the excitation that leads to the nearest boundary of the theory.
        BoundaryDistance = "boundary_distance",
        /// Amplitude of the oscillator alone.
        BareAmplitude = "bare_amplitude",
        /// Peak displacement of the exact symmetric 1:1 orbit that attracts.
        OrbitPeak = "orbit_peak",
        /// Largest modulus of that orbit's multipliers over an excitation period: stable below 1.
        OrbitMultiplier = "orbit_multiplier",
        /// Regime of the motion that most starts lead to.
        Regime = "regime",
        /// Its impacts per excitation period, z.
        ImpactsPerPeriod = "impacts_per_period",
        /// Its largest displacement of the oscillator.
        Peak = "peak",
        /// Its root mean square displacement of the oscillator.
        Rms = "rms",
        /// Its largest absolute velocity of the oscillator.
        PeakVelocity = "peak_velocity",
        /// Its root mean square velocity of the oscillator.
        RmsVelocity = "rms_velocity",
        /// Its largest absolute acceleration of the oscillator between impacts, or that of the fastest impact's pulse.
        Acceleration = "acceleration",
        /// Its root mean square acceleration of the oscillator between impacts.
        RmsAcceleration = "rms_acceleration",
        /// Reduction of the largest peak of any motion that counts against the oscillator alone.
        ReductionDb = "reduction_db",
        /// Share of the excitation's work that its impacts dissipate.
        Efficiency = "efficiency",
        /// Its largest relative speed of an impact.
        ImpactSpeed = "impact_speed",
        /// Excitation periods after which it repeats.
        RepeatsAfter = "repeats_after",
        /// Its largest Lyapunov exponent per excitation period.
        Lyapunov = "lyapunov",
        /// Its displacement of the oscillator at the end of 16 successive excitation periods.
        Section = "section",
        /// Share of the starts that lead to it.
        ShareOfStarts = "share_of_starts",
        /// Largest peak of any motion that counts.
        LargestPeak = "largest_peak",
        /// Number of distinct motions that starts lead to.
        Motions = "motions",
        /// Whether a start leads to the exact symmetric orbit that attracts; nothing where none does.
        OrbitReached = "orbit_reached",
        /// Time in which a structure that is released or struck comes to rest, from the worst of the absorber's places that are flown.
        DecayTime = "decay_time",
        /// Frequency of the largest displacement in a sweep through resonance.
        PeakFrequency = "peak_frequency",
        /// Impacts of the absorber from the worst of its places that are flown; of several records under the first.
        Impacts = "impacts",
        /// Reduction of the peak against a tuned mass damper of the absorber's mass.
        ReductionDbTmd = "reduction_db_tmd",
    }
}

impl Recorded {
    /// Whether only simulation knows it: what is recorded stands in the order of layers, those of formulas
    /// and exact orbits before it.
    pub fn is_simulated(self) -> bool {
        self > Self::OrbitMultiplier
    }

    /// Whether it compares what several starts lead to.
    pub fn is_of_starts(self) -> bool {
        matches!(self, Self::ShareOfStarts | Self::LargestPeak | Self::Motions)
    }

    /// What it is, and of which structure.
    pub const fn asked(self) -> (Measure, Device) {
        let measure = match self {
            Self::BareDecayTime => return (Measure::DecayTime, Device::Without),
            Self::DamperDecayTime => return (Measure::DecayTime, Device::Damper),
            Self::BarePeak | Self::BareAmplitude => return (Measure::Peak, Device::Without),
            Self::DamperPeak => return (Measure::Peak, Device::Damper),
            Self::BareRms => return (Measure::Rms, Device::Without),
            Self::DamperRms => return (Measure::Rms, Device::Damper),
            Self::DecayTime => Measure::DecayTime,
            Self::TheoryDecayTime => Measure::TheoryDecayTime,
            Self::InactiveShare => Measure::InactiveShare,
            Self::Peak => Measure::Peak,
            Self::PeakFrequency => Measure::PeakFrequency,
            Self::Rms => Measure::Rms,
            Self::PeakVelocity => Measure::PeakVelocity,
            Self::RmsVelocity => Measure::RmsVelocity,
            Self::Acceleration => Measure::PeakAcceleration,
            Self::RmsAcceleration => Measure::RmsAcceleration,
            Self::ReductionDb => Measure::ReductionDb,
            Self::ReductionDbTmd => Measure::ReductionDbTmd,
            Self::ImpactSpeed => Measure::ImpactSpeed,
            Self::ImpactsPerPeriod => Measure::ImpactsPerPeriod,
            Self::Impacts => Measure::Impacts,
            Self::Area => Measure::Area,
            Self::TheoryPeak => Measure::TheoryPeak,
            Self::BoundaryDistance => Measure::BoundaryDistance,
            Self::OrbitPeak => Measure::OrbitPeak,
            Self::OrbitMultiplier => Measure::OrbitMultiplier,
            Self::OrbitReached => Measure::OrbitReached,
            Self::Regime => Measure::Regime,
            Self::Efficiency => Measure::Efficiency,
            Self::RepeatsAfter => Measure::RepeatsAfter,
            Self::Lyapunov => Measure::Lyapunov,
            Self::Section => Measure::Section,
            Self::ShareOfStarts => Measure::ShareOfStarts,
            Self::LargestPeak => Measure::LargestPeak,
            Self::Motions => Measure::Motions,
        };
        (measure, Device::Absorber)
    }

    /// The kind of its numbers; none of words and flags.
    pub const fn kind(self) -> Option<&'static Kind> {
        let (measure, device) = self.asked();
        measure.kind(device)
    }

    /// Whether it is known of a structure that is subjected to something.
    pub fn is_of(self, scene: Scene) -> bool {
        let steady = scene == Scene::Steady;
        let (measure, device) = self.asked();
        measure.is_of(scene)
            && match self {
                Self::BareAmplitude => steady,
                Self::ReductionDbTmd => !steady,
                // Of a release nothing is larger than its beginning.
                _ => {
                    device == Device::Absorber
                        || !steady && (measure != Measure::Peak || scene != Scene::Release)
                }
            }
    }

    /// What is recorded where the case does not say: theory of a decay may cost more than simulation, and flights cost more
    /// where velocities are measured.
    pub fn usual(scene: Scene) -> Vec<Self> {
        let dear = |one: &Self| *one == Self::TheoryDecayTime || one.asked().0.is_of_shaking();
        let cheap = |one: &Self| !dear(one) && one.is_of(scene);
        match scene {
            Scene::Steady => Self::USUAL.into(),
            _ => Self::ALL.into_iter().filter(cheap).collect(),
        }
    }

    const USUAL: [Self; 12] = [
        Self::Area,
        Self::BareAmplitude,
        Self::OrbitPeak,
        Self::Regime,
        Self::ImpactsPerPeriod,
        Self::Peak,
        Self::Rms,
        Self::ReductionDb,
        Self::Efficiency,
        Self::ShareOfStarts,
        Self::LargestPeak,
        Self::Motions,
    ];
}
