//! Every quantity that a page, a table, a figure or a file names: identifier, symbol, name, dimension, digits.

/// What a quantity is. Its unit follows from the dimension.
#[derive(Debug, PartialEq, Eq)]
pub struct Kind {
    /// Its key in files.
    pub id: &'static str,
    /// Its symbol; empty where it has none.
    pub symbol: &'static str,
    /// Its name within a sentence, in the singular.
    pub name: &'static str,
    /// Its dimension.
    pub dimension: Dimension,
    /// How many digits a reader gets.
    pub digits: Digits,
    /// What its error means.
    pub error: ErrorKind,
}

/// A dimension; [`crate::quantity::Units`] has the units and prefixes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dimension {
    /// m
    Length,
    /// s
    Time,
    /// Hz
    Frequency,
    /// Hz/s
    FrequencyRate,
    /// octaves per minute
    OctaveRate,
    /// m/s
    Velocity,
    /// m/s²
    Acceleration,
    /// kg
    Mass,
    /// N/m
    Stiffness,
    /// N s/m
    Damping,
    /// N
    Force,
    /// J
    Energy,
    /// W
    Power,
    /// N s
    Impulse,
    /// (m/s²)²/Hz
    AccelerationDensity,
    /// rad
    Angle,
    /// rad, shown in degrees.
    Inclination,
    /// A part of a whole, shown in per cent.
    Share,
    /// A relative change or error, shown in per cent with its sign.
    Change,
    /// dB, with its sign.
    Level,
    /// Without dimension.
    Number,
    /// A whole number.
    Count,
}

/// How many digits of a number a reader gets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Digits {
    /// Significant digits.
    Significant(u8),
    /// Digits after the point.
    Decimals(u8),
}

/// What the error of a quantity means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ErrorKind {
    /// The value of an average: it may be off either way.
    Interval,
    /// The largest value seen: the true one may be larger by the error.
    Most,
    /// The smallest value seen, of a reduction: the true one may be smaller by the error.
    Least,
}

macro_rules! catalogue {
    ($($(#[$doc:meta])* $constant:ident = $id:literal, $symbol:literal, $name:literal, $dimension:ident, $digits:ident($count:literal), $error:ident;)*) => {
        $(
            $(#[$doc])*
            #[doc = concat!("The ", $name, ".")]
            pub static $constant: Kind = Kind {
                id: $id,
                symbol: $symbol,
                name: $name,
                dimension: Dimension::$dimension,
                digits: Digits::$digits($count),
                error: ErrorKind::$error,
            };
        )*
        /// All kinds, in the order of the catalogue.
        pub static ALL: &[&Kind] = &[$(&$constant),*];
    };
}

catalogue! {
    OSCILLATOR_MASS = "oscillator_mass", "m₁", "mass of the oscillator", Mass, Significant(4), Interval;
    STIFFNESS = "stiffness", "k₁", "stiffness", Stiffness, Significant(4), Interval;
    DAMPING = "damping", "c₁", "damping", Damping, Significant(4), Interval;
    DAMPING_RATIO = "damping_ratio", "ζ", "damping ratio", Share, Significant(3), Interval;
    ABSORBER_MASS = "absorber_mass", "m₂", "mass of the absorber", Mass, Significant(4), Interval;
    MASS_RATIO = "mass_ratio", "ε", "mass ratio", Share, Significant(3), Interval;
    CLEARANCE = "clearance", "b", "clearance", Length, Significant(4), Interval;
    RESTITUTION = "restitution", "r", "restitution", Number, Significant(3), Interval;
    RESTITUTION_PLUS = "restitution_at_plus_b", "r₁", "restitution at the wall x − y = +b", Number, Significant(3), Interval;
    RESTITUTION_MINUS = "restitution_at_minus_b", "r₂", "restitution at the wall x − y = −b", Number, Significant(3), Interval;
    INCLINATION = "inclination", "α", "inclination of the cavity", Inclination, Significant(3), Interval;
    FRICTION = "friction", "μ", "friction in the cavity", Number, Significant(3), Interval;
    SUPPORT_FREQUENCY = "support_frequency", "", "frequency of the absorber's support", Frequency, Significant(3), Interval;
    SUPPORT_LENGTH = "support_length", "", "length of the pendulum, or stretch of the spring, that carries the absorber", Length, Significant(2), Interval;
    SUPPORT_LEFT_OUT = "support_left_out", "", "restoring acceleration of the support over the structure's", Share, Significant(2), Interval;
    GRAVITY_ALONG = "gravity_along", "a", "gravity along the cavity over bω₀²", Number, Significant(3), Interval;
    FRICTION_ACCELERATION = "friction_acceleration", "", "friction in the cavity over m₂bω₀²", Number, Significant(3), Interval;
    BASE_AMPLITUDE = "base_amplitude", "F", "amplitude of the base", Length, Significant(4), Interval;
    FORCE_AMPLITUDE = "force_amplitude", "P", "amplitude of the force", Force, Significant(4), Interval;
    AMPLITUDE_OVER_OWN = "amplitude_over_own", "", "amplitude over the case's", Number, Significant(3), Interval;
    EXCITATION_FREQUENCY = "excitation_frequency", "f", "excitation frequency", Frequency, Significant(4), Interval;
    NATURAL_FREQUENCY = "natural_frequency", "f₀", "natural frequency", Frequency, Significant(4), Interval;
    FREQUENCY_DRIFT = "frequency_drift", "", "share by which the natural frequency is off", Share, Significant(2), Interval;
    FREQUENCY_RATIO = "frequency_ratio", "Ω", "frequency ratio", Number, Significant(4), Interval;
    DETUNING = "detuning", "σ", "detuning", Number, Significant(4), Interval;
    REDUCED_DAMPING = "reduced_damping", "λ", "reduced damping", Number, Significant(4), Interval;
    REDUCED_FORCING = "reduced_forcing", "G", "reduced forcing", Length, Significant(4), Interval;
    FORCING_PER_CLEARANCE = "forcing_per_clearance", "γ", "reduced forcing over the clearance", Number, Significant(4), Interval;
    PEAK = "peak_displacement", "x̂", "peak displacement", Length, Significant(3), Most;
    RMS = "rms_displacement", "", "rms displacement", Length, Significant(3), Interval;
    BARE_PEAK = "bare_peak", "", "peak displacement without absorber", Length, Significant(3), Interval;
    INACTIVE_PEAK = "inactive_peak", "", "peak displacement with an inactive absorber", Length, Significant(3), Interval;
    INACTIVE_SHARE = "inactive_share", "", "share of the absorber's resting places from which it stays inactive", Share, Significant(2), Interval;
    SUDDEN_SHARE = "share_sudden", "", "share of the absorber's resting places from which it stays inactive when the excitation begins at once", Share, Significant(2), Interval;
    DAMPER_PEAK = "damper_peak", "", "peak displacement with a tuned mass damper", Length, Significant(3), Interval;
    DAMPER_STROKE = "damper_stroke", "", "stroke of the tuned mass damper", Length, Significant(3), Interval;
    DAMPER_FREQUENCY = "damper_frequency", "", "frequency of the tuned mass damper", Frequency, Significant(4), Interval;
    DAMPER_FREQUENCY_RATIO = "damper_frequency_ratio", "", "frequency of the tuned mass damper over the structure's", Number, Significant(4), Interval;
    DAMPER_DAMPING_RATIO = "damper_damping_ratio", "", "damping ratio of the tuned mass damper", Share, Significant(3), Interval;
    CHANGE_DB = "change_db", "", "change against the structure without absorber", Level, Decimals(1), Most;
    RMS_CHANGE_DB = "rms_change_db", "", "change of the rms against the structure without absorber", Level, Decimals(1), Interval;
    IMPACTS_PER_PERIOD = "impacts_per_period", "z", "impacts per period", Number, Significant(4), Interval;
    CONTACT_TIME = "contact_time", "", "duration of an impact", Time, Significant(3), Interval;
    IMPACT_SPEED = "impact_speed", "", "impact speed", Velocity, Significant(3), Most;
    START_SHARE = "start_share", "", "share of the starts", Share, Significant(2), Interval;
    MODULATION = "modulation_depth", "", "modulation", Share, Significant(2), Interval;
    CAPTURE_SHARE = "capture_share", "", "share of the time in 1:1 resonance", Share, Significant(2), Interval;
    CONTACT_SHARE = "contact_share", "", "share of the time in sustained contact", Share, Significant(2), Interval;
    LYAPUNOV_EXPONENT = "lyapunov_exponent", "", "Lyapunov exponent per period", Number, Significant(3), Interval;
    WORK = "work_per_period", "", "work of the excitation per period", Energy, Significant(3), Interval;
    DAMPER_LOSS = "damper_loss_per_period", "", "loss in the structure's damper per period", Energy, Significant(3), Interval;
    FRICTION_LOSS = "friction_loss_per_period", "", "loss by friction in the cavity per period", Energy, Significant(3), Interval;
    IMPACT_LOSS = "impact_loss_per_period", "", "loss in impacts per period", Energy, Significant(3), Interval;
    LOSS_PER_IMPACT = "loss_per_impact", "", "loss per impact", Energy, Significant(3), Interval;
    EFFICIENCY = "transfer_efficiency", "", "share of the work that impacts dissipate", Share, Significant(2), Interval;
    OSCILLATOR_AMPLITUDE = "oscillator_amplitude", "C", "amplitude of the oscillator", Length, Significant(4), Interval;
    ABSORBER_AMPLITUDE = "absorber_amplitude", "B", "amplitude of the absorber", Length, Significant(4), Interval;
    ABSORBER_AMPLITUDE_RATIO = "absorber_amplitude_over_clearance", "B/b", "absorber amplitude", Number, Significant(3), Interval;
    ETA = "eta", "η", "phase of the oscillator", Angle, Decimals(3), Interval;
    THETA = "theta", "Θ", "phase of the absorber", Angle, Decimals(3), Interval;
    TRACE = "trace", "", "trace", Number, Significant(3), Interval;
    DETERMINANT = "determinant", "", "determinant", Number, Significant(3), Interval;
    ABOVE_COLLISION = "above_collision", "", "distance of the forcing above the collision of the fixed points", Share, Significant(2), Interval;
    IMPACT_DISPLACEMENT = "impact_displacement", "", "displacement at impact", Length, Significant(4), Interval;
    IMPACT_PHASE = "impact_phase", "", "phase of the impact", Angle, Decimals(3), Interval;
    FLIGHT_SHARE = "flight_share", "", "share of the period from the impact at +b to that at −b", Share, Significant(4), Interval;
    SPECTRAL_RADIUS = "spectral_radius", "", "largest multiplier", Number, Significant(4), Interval;
    BOUNDARY = "boundary_clearance", "b", "clearance at the boundary", Length, Significant(4), Interval;
    THEORY_ERROR = "theory_error", "", "error of theory", Change, Significant(2), Interval;
    ANGLE_ERROR = "angle_error", "", "error of an angle", Angle, Decimals(4), Interval;
    TOLERANCE = "tolerance", "", "allowed error", Share, Significant(2), Interval;
    CLAIMED_LENGTH = "length", "", "length", Length, Significant(4), Interval;
    CLAIMED_ANGLE = "angle", "", "angle", Angle, Decimals(3), Interval;
    OFFSET = "offset", "", "distance of the excitation from resonance", Share, Significant(2), Interval;
    MARGIN = "margin", "", "change until the boundary", Change, Significant(2), Interval;
    ROOM = "room", "", "room below the tightest limit", Change, Significant(2), Interval;
    MODAL_FORCING = "modal_forcing", "", "largest force over modal mass", Acceleration, Significant(4), Interval;
    GAP = "gap", "", "distance of the clearance from the next boundary", Share, Significant(2), Interval;
    Z3_SHARE = "z3_share", "", "share in area Z3", Share, Significant(3), Interval;
    A1_SHARE = "a1_share", "", "share in strip A1", Share, Significant(3), Interval;
    A2_SHARE = "a2_share", "", "share in strip A2", Share, Significant(3), Interval;
    PROBABILITY = "probability", "", "probability that all criteria hold", Share, Significant(3), Interval;
    STABLE_SHARE = "stable_share", "", "share with a stable 1:1 orbit", Share, Significant(3), Interval;
    REDUCTION_DB = "reduction_db", "", "reduction against the structure without absorber", Level, Decimals(1), Least;
    OSCILLATOR_AMPLITUDE_RATIO = "oscillator_amplitude_over_clearance", "C/b", "oscillator amplitude", Number, Significant(3), Interval;
    HARMONIC_AMPLITUDE = "harmonic_amplitude", "E", "first harmonic of the absorber", Length, Significant(3), Interval;
    HARMONIC_AMPLITUDE_RATIO = "harmonic_amplitude_over_clearance", "E/b", "first harmonic of the absorber", Number, Significant(3), Interval;
    RESISTANCE = "resistance", "S", "force against the velocity", Number, Significant(3), Interval;
    REACTANCE = "reactance", "K", "force along the displacement", Number, Significant(3), Interval;
    TIME = "time", "t", "time", Time, Significant(4), Interval;
    DISPLACEMENT = "displacement", "x", "displacement", Length, Significant(3), Interval;
    RELATIVE_DISPLACEMENT = "relative_displacement", "w", "relative displacement", Length, Significant(3), Interval;
    VELOCITY = "velocity", "ẋ", "velocity", Velocity, Significant(3), Interval;
    ACCELERATION = "acceleration", "ẍ", "acceleration", Acceleration, Significant(3), Interval;
    PEAK_VELOCITY = "peak_velocity", "", "peak velocity", Velocity, Significant(3), Most;
    RMS_VELOCITY = "rms_velocity", "", "rms velocity", Velocity, Significant(3), Interval;
    PEAK_ACCELERATION = "peak_acceleration", "", "peak acceleration", Acceleration, Significant(3), Most;
    RMS_ACCELERATION = "rms_acceleration", "", "rms acceleration between impacts", Acceleration, Significant(3), Interval;
    IMPULSE = "impulse", "", "impulse", Impulse, Significant(3), Interval;
    IMPACT_INTERVAL = "impact_interval", "Δt/T", "time between impacts", Number, Significant(3), Interval;
    NEXT_INTERVAL = "next_impact_interval", "Δtₖ₊₁/T", "the next one", Number, Significant(3), Interval;
    WINDOW = "window", "", "window in excitation periods", Number, Significant(3), Interval;
    SMALLEST_MARGIN = "smallest_margin", "", "smallest margin in clearance", Share, Significant(3), Interval;
    REDUCTION_DB_TMD = "reduction_db_tmd", "", "reduction against a tuned mass damper", Level, Decimals(1), Least;
    POINT_SHARE = "point_share", "", "share of the points", Share, Significant(3), Interval;
    THEORY_PEAK = "theory_peak", "", "smallest amplitude of a stable fixed point", Length, Significant(3), Interval;
    BOUNDARY_DISTANCE = "boundary_distance", "", "change of the excitation that leads to the nearest boundary of the theory", Change, Significant(2), Interval;
    ORBIT_PEAK = "orbit_peak", "", "peak displacement of the exact 1:1 orbit", Length, Significant(3), Interval;
    LARGEST_PEAK = "largest_peak", "", "largest peak displacement of any motion", Length, Significant(3), Most;
    MOTIONS = "motions", "", "number of motions", Count, Significant(3), Interval;
    REPEATS_AFTER = "repeats_after", "", "number of periods after which the motion repeats", Count, Significant(3), Interval;
    SECTION = "section", "", "displacement once a period", Length, Significant(3), Interval;
    INITIAL_DISPLACEMENT = "initial_displacement", "x", "initial displacement", Length, Significant(3), Interval;
    INITIAL_VELOCITY = "initial_velocity", "ẋ", "initial velocity", Velocity, Significant(3), Interval;
    INITIAL_ABSORBER_DISPLACEMENT = "initial_absorber_displacement", "y", "initial displacement of the absorber", Length, Significant(3), Interval;
    INITIAL_ABSORBER_VELOCITY = "initial_absorber_velocity", "ẏ", "initial velocity of the absorber", Velocity, Significant(3), Interval;
    DECAY_TIME = "decay_time", "", "time to come to rest", Time, Significant(3), Most;
    BARE_DECAY_TIME = "bare_decay_time", "", "time to come to rest without absorber", Time, Significant(3), Interval;
    DAMPER_DECAY_TIME = "damper_decay_time", "", "time to come to rest with a tuned mass damper", Time, Significant(3), Interval;
    THEORY_DECAY_TIME = "theory_decay_time", "", "time to come to rest by theory", Time, Significant(3), Interval;
    ACTIVE_DECAY_TIME = "active_decay_time", "", "time to come to rest where the absorber wakes", Time, Significant(3), Most;
    FASTEST_DECAY_TIME = "fastest_decay_time", "", "shortest time to come to rest from any place of the absorber", Time, Significant(3), Interval;
    DECAY_LEVEL = "decay_level", "", "amplitude that counts as rest", Length, Significant(3), Interval;
    RESIDUAL_AMPLITUDE = "residual_amplitude", "", "amplitude at which capture ends", Length, Significant(3), Interval;
    INITIAL_AMPLITUDE = "initial_amplitude", "", "amplitude at the start", Length, Significant(3), Interval;
    IMPACT_ENERGY_SHARE = "impact_energy_share", "", "share of the energy that impacts take", Share, Significant(2), Interval;
    IMPACT_COUNT = "impact_count", "", "number of impacts", Count, Decimals(0), Interval;
    LARGEST_RMS = "largest_rms", "", "largest rms displacement", Length, Significant(3), Most;
    LARGEST_RMS_VELOCITY = "largest_rms_velocity", "", "largest rms velocity", Velocity, Significant(3), Most;
    LARGEST_RMS_ACCELERATION = "largest_rms_acceleration", "", "largest rms acceleration between impacts", Acceleration, Significant(3), Most;
    MEAN_PEAK_VELOCITY = "mean_peak_velocity", "", "mean peak velocity", Velocity, Significant(3), Interval;
    MEAN_PEAK_ACCELERATION = "mean_peak_acceleration", "", "mean peak acceleration", Acceleration, Significant(3), Interval;
    MEAN_PEAK = "mean_peak", "", "mean peak displacement", Length, Significant(3), Interval;
    MEAN_REDUCTION_DB = "mean_reduction_db", "", "mean reduction against the structure without absorber", Level, Decimals(1), Interval;
    MEAN_REDUCTION_DB_TMD = "mean_reduction_db_tmd", "", "mean reduction against a tuned mass damper", Level, Decimals(1), Interval;
    MEAN_IMPACT_SPEED = "mean_impact_speed", "", "mean of the largest impact speeds", Velocity, Significant(3), Interval;
    BARE_RMS = "bare_rms", "", "rms displacement without absorber", Length, Significant(3), Interval;
    DAMPER_RMS = "damper_rms", "", "rms displacement with a tuned mass damper", Length, Significant(3), Interval;
    STRUCTURE_FREQUENCY = "structure_frequency", "f₀", "natural frequency of the structure", Frequency, Significant(4), Interval;
    SWEEP_RATE = "sweep_rate", "", "rate of the sweep", FrequencyRate, Significant(3), Interval;
    OCTAVE_RATE = "octave_rate", "", "rate of the sweep", OctaveRate, Significant(3), Interval;
    SWEEP_FROM = "sweep_from", "", "frequency at which the sweep begins", Frequency, Significant(4), Interval;
    SWEEP_TO = "sweep_to", "", "frequency at which the sweep ends", Frequency, Significant(4), Interval;
    SWEEP_TIME = "sweep_time", "", "duration of the sweep", Time, Significant(3), Interval;
    PEAK_FREQUENCY = "peak_frequency", "", "frequency of the largest displacement", Frequency, Significant(4), Interval;
    BARE_PEAK_FREQUENCY = "bare_peak_frequency", "", "frequency of the largest displacement without absorber", Frequency, Significant(4), Interval;
    DAMPER_PEAK_FREQUENCY = "damper_peak_frequency", "", "frequency of the largest displacement with a tuned mass damper", Frequency, Significant(4), Interval;
    RETURN_PEAK = "return_peak", "", "peak displacement of the sweep in the other direction", Length, Significant(3), Most;
    RETURN_PEAK_FREQUENCY = "return_peak_frequency", "", "frequency of the largest displacement in the other direction", Frequency, Significant(4), Interval;
    LEAST_PEAK = "least_peak", "", "peak displacement from the best place of the absorber", Length, Significant(3), Interval;
    RELATIVE_CHANGE = "relative_change", "", "relative change", Change, Significant(2), Interval;
}

/// The kind with an identifier.
pub fn kind(id: &str) -> Option<&'static Kind> {
    ALL.iter().copied().find(|kind| kind.id == id)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identifiers_are_unique() {
        let ids: std::collections::BTreeSet<&str> = ALL.iter().map(|kind| kind.id).collect();
        assert_eq!(ids.len(), ALL.len());
    }
}
