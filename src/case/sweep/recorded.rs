//! What a sweep records of each point, and which layer knows it.

/// A layer of the analysis, the cheapest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Layer {
    /// Formulas of the theory, and of the oscillator alone.
    ClosedForm,
    /// Exact symmetric 1:1 orbits.
    Orbit,
    /// Simulation, impact by impact.
    Simulation,
}

macro_rules! recorded {
    ($count:literal: $($name:ident, $key:literal, $layer:ident, $usual:literal, $doc:literal;)*) => {
        /// Something that is recorded of each point.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, schemars::JsonSchema)]
        #[schemars(rename_all = "snake_case")]
        pub enum Recorded {
            $(#[doc = $doc] $name,)*
        }

        impl Recorded {
            /// All of them.
            pub const ALL: [Self; $count] = [$(Self::$name),*];

            /// Its name in a case.
            pub const fn key(self) -> &'static str {
                match self { $(Self::$name => $key),* }
            }

            /// The layer that knows it.
            pub const fn layer(self) -> Layer {
                match self { $(Self::$name => Layer::$layer),* }
            }

            /// Whether it is recorded where the case does not say what is.
            const fn is_usual(self) -> bool {
                match self { $(Self::$name => $usual),* }
            }

            /// What it is, in a line.
            pub const fn words(self) -> &'static str {
                match self { $(Self::$name => $doc),* }
            }
        }
    };
}

recorded! { 20:
    Area, "area", ClosedForm, true, "Area Z1 to Z4 of the theory, and the strip A1 or A2 within it.";
    TheoryPeak, "theory_peak", ClosedForm, false, "Smallest amplitude of a stable fixed point of the slow flow.";
    BoundaryDistance, "boundary_distance", ClosedForm, false, "Relative change of the excitation that leads to the nearest boundary of the theory.";
    BareAmplitude, "bare_amplitude", ClosedForm, true, "Amplitude of the oscillator alone.";
    OrbitPeak, "orbit_peak", Orbit, true, "Peak displacement of the exact symmetric 1:1 orbit that attracts.";
    OrbitMultiplier, "orbit_multiplier", Orbit, false, "Largest modulus of that orbit's multipliers over an excitation period: stable below 1.";
    Regime, "regime", Simulation, true, "Regime of the motion that most starts lead to.";
    ImpactsPerPeriod, "impacts_per_period", Simulation, true, "Its impacts per excitation period, z.";
    Peak, "peak", Simulation, true, "Its largest displacement of the oscillator.";
    Rms, "rms", Simulation, true, "Its root mean square displacement of the oscillator.";
    ReductionDb, "reduction_db", Simulation, true, "Its reduction of the peak against the oscillator alone.";
    Efficiency, "efficiency", Simulation, true, "Share of the excitation's work that its impacts dissipate.";
    ImpactSpeed, "impact_speed", Simulation, false, "Its largest relative speed of an impact.";
    RepeatsAfter, "repeats_after", Simulation, false, "Excitation periods after which it repeats.";
    Lyapunov, "lyapunov", Simulation, false, "Its largest Lyapunov exponent per excitation period.";
    Section, "section", Simulation, false, "Its displacement of the oscillator at the end of 16 successive excitation periods.";
    ShareOfStarts, "share_of_starts", Simulation, true, "Share of the starts that lead to it.";
    LargestPeak, "largest_peak", Simulation, true, "Largest peak of any motion that a start leads to.";
    Motions, "motions", Simulation, true, "Number of distinct motions that starts lead to.";
    OrbitReached, "orbit_reached", Simulation, false, "Whether a start leads to the exact symmetric orbit that attracts; nothing where none does.";
}

impl Recorded {
    /// Whether it compares what several starts lead to.
    pub fn is_of_starts(self) -> bool {
        matches!(self, Self::ShareOfStarts | Self::LargestPeak | Self::Motions)
    }

    /// What is recorded where the case does not say.
    pub const USUAL: &'static [Self] = &{
        let mut usual = [Self::Area; 12];
        let (mut k, mut found) = (0, 0);
        while k < Self::ALL.len() {
            if Self::ALL[k].is_usual() {
                usual[found] = Self::ALL[k];
                found += 1;
            }
            k += 1;
        }
        assert!(found == usual.len());
        usual
    };
}
