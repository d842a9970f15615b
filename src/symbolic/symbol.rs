//! The one table of symbols: what code, documentation and reports call each quantity.
//!
//! The order of the table is the order in which factors of a product are written, so constants and
//! parameters come before amplitudes, and amplitudes before phases and time.

/// What is known about a symbol besides its value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SymbolEntry {
    /// The name in plain text.
    pub name: &'static str,
    /// The name in LaTeX.
    pub latex: &'static str,
    /// What it stands for.
    pub description: &'static str,
    /// Its unit: `1` for a pure number, `length` for whatever unit of length the case uses.
    pub unit: &'static str,
}

macro_rules! symbol_table {
    ($($variant:ident: $name:literal, $latex:literal, $unit:literal, $description:literal;)*) => {
        /// A named quantity; its texts are in the table behind [`Symbol::entry`].
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Symbol {
            $(#[doc = concat!("`", $name, "`: ", $description, ".")] $variant,)*
        }

        impl Symbol {
            /// Every symbol, in the order of the table.
            pub const ALL: &'static [Symbol] = &[$(Symbol::$variant),*];

            /// Name, LaTeX, description and unit.
            pub const fn entry(self) -> SymbolEntry {
                match self {
                    $(Symbol::$variant => SymbolEntry {
                        name: $name, latex: $latex, description: $description, unit: $unit,
                    },)*
                }
            }
        }
    };
}

symbol_table! {
    Pi: "pi", r"\pi", "1", "ratio of a circle's circumference to its diameter";
    MassRatio: "epsilon", r"\varepsilon", "1", "mass of the absorber over mass of the oscillator";
    Damping: "lambda", r"\lambda", "1", "damping of the oscillator, so that its term is epsilon lambda x'";
    Restitution: "r", "r", "1", "coefficient of restitution";
    RestitutionRatio: "rho", r"\rho", "1", "short-hand (1 - r)/(1 + r)";
    ManifoldCurvature: "R", "R", "1", "short-hand 4 rho^2/pi^2";
    Detuning: "sigma", r"\sigma", "1", "detuning, so that Omega = 1 + epsilon sigma";
    ForcingPerClearance: "gamma", r"\gamma", "1", "reduced forcing over clearance, G/b";
    BaseAmplitude: "F", "F", "length", "amplitude of the base displacement";
    ReducedForcing: "G", "G", "length", "reduced forcing, F/epsilon";
    Clearance: "b", "b", "length", "clearance: the absorber is free while |w| < b";
    OscillatorAmplitude: "C", "C", "length", "slow amplitude of the oscillator";
    AbsorberAmplitude: "B", "B", "length", "slow amplitude of the absorber's sawtooth";
    FirstHarmonic: "E", "E", "length", "amplitude of the first harmonic of the sawtooth (2/pi) B Pi";
    ManifoldSquare: "c_2", "c_2", "1", "square of the oscillator's amplitude on the manifold over b^2";
    AmplitudeRatio: "beta", r"\beta", "1", "amplitude of the absorber over clearance, B/b";
    Shift: "u", "u", "1", "amplitude beyond the clearance, beta - 1";
    CosineLength: "s", "s", "length", "C cos Theta";
    SineLength: "c", "c", "length", "C sin Theta";
    ImpactFactor: "k", "k", "1/length", "sensitivity of the impact time, pi (1 - r)/(2 c)";
    Trace: "tr", r"\mathrm{tr}", "1", "trace of the half-period map of the impact pair";
    Determinant: "det", r"\det", "1", "determinant of the half-period map of the impact pair";
    FrequencyRatio: "Omega", r"\Omega", "1", "excitation frequency over natural frequency";
    Period: "T", "T", "1", "period of the excitation in fast time, 2 pi/Omega";
    Stiffness: "kappa", r"\kappa", "1", "dynamic stiffness of the oscillator, 1 - Omega^2";
    Loss: "delta", r"\delta", "1", "damping force of the oscillator per displacement, epsilon lambda Omega";
    LinearGain: "chi", r"\chi", "1", "amplitude of the steady motion without impacts over gamma b";
    ImpulseResponse: "g", "g", "1", "displacement of the free oscillator at T/2 after a unit of velocity";
    ImpulseResponseRate: "g'", r"\dot{g}", "1", "velocity of the free oscillator at T/2 after a unit of velocity";
    RepeatedDisplacement: "q_1", "q_1", "1", "displacement right after an impulse of one that repeats every T/2 with opposite sign";
    RepeatedVelocity: "q_2", "q_2", "1", "velocity right after an impulse of one that repeats every T/2 with opposite sign";
    VelocityRatioAfter: "v+", "v_{+}", "1", "velocity of the oscillator after an impact over the absorber's speed";
    VelocityRatioBefore: "v-", "v_{-}", "1", "velocity of the oscillator before an impact over the absorber's speed";
    DisplacementCoefficient: "A", "A", "1", "loss of steady displacement at an impact per beta b";
    VelocityCoefficient: "D", "D", "1", "loss of steady velocity over Omega at an impact per beta b";
    ForcingConstant: "p_0", "p_0", "1", "gamma^2 of a fixed point: constant part of the quadratic in beta";
    ForcingLinear: "p_1", "p_1", "1", "gamma^2 of a fixed point: coefficient of beta";
    ForcingSquare: "p_2", "p_2", "1", "gamma^2 of a fixed point: coefficient of beta^2";
    CollisionForcing: "gamma_SN", r"\gamma_{\mathrm{SN}}", "1", "gamma at which two fixed points meet";
    Discriminant: "Delta", r"\Delta", "1", "quarter of the discriminant of a quadratic in beta";
    SteadySine: "X_s", "X_s", "length", "coefficient of sin(phi) in the steady motion";
    SteadyCosine: "X_c", "X_c", "length", "coefficient of cos(phi) in the steady motion";
    SteadyDisplacement: "X", "X", "length", "displacement of the steady motion at an impact on the wall +b";
    SteadyVelocity: "X'", r"\dot{X}", "length", "velocity of the steady motion at an impact on the wall +b, in fast time";
    ImpactDisplacement: "x_0", "x_0", "length", "displacement of the oscillator at an impact on the wall +b";
    ImpactAbsorber: "y_0", "y_0", "length", "displacement of the absorber at an impact on the wall +b";
    XDotBefore: "x'-", r"\dot{x}^{-}", "length", "velocity of the oscillator before an impact on the wall +b, in fast time";
    XDotAfter: "x'+", r"\dot{x}^{+}", "length", "velocity of the oscillator after an impact on the wall +b, in fast time";
    YDotBefore: "y'-", r"\dot{y}^{-}", "length", "velocity of the absorber before an impact on the wall +b, in fast time";
    YDotAfter: "y'+", r"\dot{y}^{+}", "length", "velocity of the absorber after an impact on the wall +b, in fast time";
    X: "x", "x", "length", "displacement of the oscillator";
    XDot: "x'", r"\dot{x}", "length", "velocity of the oscillator in fast time";
    XDotDot: "x''", r"\ddot{x}", "length", "acceleration of the oscillator in fast time";
    YDotDot: "y''", r"\ddot{y}", "length", "acceleration of the absorber in fast time";
    WDotBefore: "w'-", r"\dot{w}^{-}", "length", "relative velocity before an impact";
    WDotAfter: "w'+", r"\dot{w}^{+}", "length", "relative velocity after an impact";
    GapChange: "dw", r"\mathrm{d}w", "length", "small change of the relative displacement at the end of a flight";
    FlightChange: "dtau", r"\mathrm{d}\tau", "1", "small change of the length of a flight in fast time";
    AmplitudeRate: "D1 C", r"\mathrm{D}_1 C", "length", "slow rate of the oscillator's amplitude";
    PhaseRate: "D1 eta", r"\mathrm{D}_1 \eta", "1", "slow rate of the excitation's phase";
    RatioRate: "D1 beta", r"\mathrm{D}_1 \beta", "1", "slow rate of the absorber's amplitude over clearance";
    OscillatorPhase: "theta", r"\theta", "rad", "slow phase of the oscillator";
    SawtoothPhase: "zeta", r"\zeta", "rad", "slow phase of the sawtooth";
    AbsorberPhase: "Theta", r"\Theta", "rad", "phase of the absorber against the oscillator, zeta - theta";
    ExcitationPhase: "eta", r"\eta", "rad", "phase of the excitation against the oscillator";
    ImpactPhase: "phi", r"\varphi", "rad", "phase Omega tau of the excitation at an impact on the wall +b";
    FastTime: "tau", r"\tau", "1", "fast time, omega0 t";
}

impl Symbol {
    /// How many symbols there are.
    pub const COUNT: usize = Self::ALL.len();

    /// Place in the table.
    pub const fn index(self) -> usize {
        self as usize
    }
}

impl std::fmt::Display for Symbol {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.entry().name)
    }
}
