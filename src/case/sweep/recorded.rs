//! What a sweep records of each point.

use crate::names::names;

names! { key:
    /// Something that is recorded of each point.
    pub enum Recorded {
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
        /// Its reduction of the peak against the oscillator alone.
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
        /// Largest peak of any motion that a start leads to.
        LargestPeak = "largest_peak",
        /// Number of distinct motions that starts lead to.
        Motions = "motions",
        /// Whether a start leads to the exact symmetric orbit that attracts; nothing where none does.
        OrbitReached = "orbit_reached",
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

    /// What is recorded where the case does not say.
    pub const USUAL: [Self; 12] = [
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
