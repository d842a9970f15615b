//! What a design holds, in each of the two ways to write a case: one row for each parameter.
//!
//! A reduced design is not a physical one with `m1 = k1 = 1`: with the mass of its absorber a physical design keeps the
//! amplitude `F` and the damping `c1`, a reduced one `G` and `lambda`.

use std::f64::consts::TAU;

use serde_json::Value;

use super::excitation::ExcitationTable;
use super::inputs::Input;
use super::physical::{AbsorberTable, OscillatorTable};
use super::reduced::ReducedTable;
use super::schema::of_table;
use super::{Design, physical, reduced};
use crate::excitation::{Release, SweepRate, Transient};
use crate::quantity::Kind;
use crate::quantity::catalogue as of;
use crate::system::{Excitation, Parameter};

/// A parameter as designs of one kind hold it.
pub(super) struct ParameterRow {
    pub parameter: Parameter,
    /// The table and the key in the case file.
    place: [&'static str; 2],
    /// What it is, and so its dimension.
    kind: &'static Kind,
    /// Its value in SI, or as a plain number of a reduced design.
    pub get: fn(&Design) -> Option<f64>,
    /// Gives it another value, and leaves the numbers of all other keys as they are.
    pub set: fn(&mut Design, f64),
}

/// A way to write a design.
pub(super) struct Writing {
    /// Its name in a message.
    pub words: &'static str,
    /// Its tables, that of the excitation the last.
    pub tables: &'static [&'static str],
    /// What else may vary under steady excitation.
    pub steady: &'static str,
    rows: &'static [ParameterRow],
}

impl Writing {
    fn rows() -> impl Iterator<Item = &'static ParameterRow> {
        PHYSICAL.rows.iter().chain(REDUCED.rows)
    }
}

/// Rows: `Parameter = table.key, KIND`, and the number itself, the number `over` what the parameter is a ratio to, or what
/// it is and how it is set.
macro_rules! rows {
    (@row [$design:ident $parameter:ident $table:ident $key:ident $kind:ident] $held:ident $get:expr, $value:ident $set:expr) => {
        ParameterRow {
            parameter: Parameter::$parameter,
            place: [stringify!($table), stringify!($key)],
            kind: &of::$kind,
            get: |design| if let Design::$design($held) = design { Some($get) } else { None },
            set: |design, $value| if let Design::$design($held) = design { $set },
        }
    };
    (@number $row:tt $($number:ident).+) => {
        rows!(@row $row held held.$($number).+, value held.$($number).+ = value)
    };
    (@number $row:tt $number:ident over $($of:tt)+) => {
        rows!(@row $row held held.$number / held.$($of)+, value held.$number = value * held.$($of)+)
    };
    (@number $row:tt |$held:ident| $get:expr, |$value:ident| $set:expr) => {
        rows!(@row $row $held $get, $value $set)
    };
    ($design:ident { $($parameter:ident = $table:ident.$key:ident, $kind:ident { $($number:tt)+ })+ }) => {
        &[$(rows!(@number [$design $parameter $table $key $kind] $($number)+)),+]
    };
}

static PHYSICAL: Writing = Writing {
    words: "a design in [oscillator], [absorber] and [excitation]",
    tables: &physical::TABLES,
    steady: "frequency",
    rows: rows! { Physical {
        Clearance = absorber.clearance, CLEARANCE { clearance_m }
        Frequency = excitation.frequency, EXCITATION_FREQUENCY { frequency_hz }
        Amplitude = excitation.amplitude, BASE_AMPLITUDE { amplitude }
        Restitution = absorber.restitution, RESTITUTION { restitution }
        Inclination = absorber.inclination, INCLINATION { inclination_rad }
        Friction = absorber.friction, FRICTION { friction }
        AbsorberMass = absorber.mass, ABSORBER_MASS { absorber_mass_kg }
        MassRatio = absorber.mass_ratio, MASS_RATIO { absorber_mass_kg over structure().mass_kg }
        Mass = oscillator.mass, OSCILLATOR_MASS { mass_kg }
        Stiffness = oscillator.stiffness, STIFFNESS { stiffness_n_per_m }
        // By its stiffness: mass and damping ratio stay.
        NaturalFrequency = oscillator.frequency, NATURAL_FREQUENCY { |held| held.natural_frequency_rad_per_s() / TAU, |value| {
            held.damping_n_s_per_m *= TAU * value / held.natural_frequency_rad_per_s();
            held.stiffness_n_per_m = held.mass_kg * (TAU * value) * (TAU * value);
        } }
        Damping = oscillator.damping, DAMPING { damping_n_s_per_m }
        DampingRatio = oscillator.damping_ratio, DAMPING_RATIO { damping_n_s_per_m over critical_damping_n_s_per_m() }
    } },
};

static REDUCED: Writing = Writing {
    words: "a design in [reduced]",
    tables: &[reduced::TABLE],
    steady: "mass_ratio or damping",
    rows: rows! { Reduced {
        // Gravity and friction stay what they are, not their ratio to the clearance.
        Clearance = reduced.clearance, CLEARANCE { |held| held.clearance, |value| {
            held.cavity = held.cavity.with_clearance_scaled(value / held.clearance);
            held.clearance = value;
        } }
        Frequency = reduced.frequency_ratio, FREQUENCY_RATIO { |held| held.frequency_ratio(), |value| {
            (held.frequency_ratio, held.detuning) = (Some(value), None);
        } }
        Detuning = reduced.detuning, DETUNING { |held| held.detuning(), |value| {
            (held.frequency_ratio, held.detuning) = (None, Some(value));
        } }
        Amplitude = reduced.forcing, REDUCED_FORCING { forcing }
        Restitution = reduced.restitution, RESTITUTION { restitution }
        GravityAlong = reduced.gravity_along, GRAVITY_ALONG { cavity.gravity_along }
        FrictionAcceleration = reduced.friction_acceleration, FRICTION_ACCELERATION { cavity.friction_acceleration }
        MassRatio = reduced.mass_ratio, MASS_RATIO { mass_ratio }
        Damping = reduced.damping, REDUCED_DAMPING { damping }
    } },
};

/// What a parameter is of what is not steady, and its key in the table of the excitation; none where it is no number
/// of that.
fn of_transient(
    transient: &Transient,
    parameter: Parameter,
) -> Option<(&'static Kind, &'static str)> {
    use Parameter as P;
    Some(match (transient, parameter) {
        (Transient::Release(Release::LetGo { .. }), P::InitialDisplacement) => {
            (&of::INITIAL_DISPLACEMENT, "displacement")
        }
        (Transient::Release(Release::LetGo { .. }), P::InitialVelocity)
        | (Transient::Release(Release::BaseMoves { .. }), P::Amplitude) => {
            (&of::INITIAL_VELOCITY, "velocity")
        }
        (Transient::Release(Release::Struck { .. }), P::Amplitude) => (&of::IMPULSE, "impulse"),
        (Transient::Sweep(sweep), P::Rate) => match sweep.rate {
            SweepRate::Linear(_) => (&of::SWEEP_RATE, "rate"),
            SweepRate::Octaves(_) => (&of::OCTAVE_RATE, "rate"),
        },
        _ => return None,
    })
}

/// What both kinds of design hold under one name.
macro_rules! held {
    ($design:expr, $of:ident => $what:expr) => {
        match $design {
            Design::Physical($of) => $what,
            Design::Reduced($of) => $what,
        }
    };
}

impl Design {
    /// Whether it is written in physical units.
    pub fn is_physical(&self) -> bool {
        matches!(self, Self::Physical(_))
    }

    /// How it is written.
    pub(super) fn writing(&self) -> &'static Writing {
        if self.is_physical() { &PHYSICAL } else { &REDUCED }
    }

    /// What is not steady vibration in it.
    pub fn transient(&self) -> Option<Transient> {
        held!(self, of => of.transient)
    }

    pub(super) fn transient_mut(&mut self) -> Option<&mut Transient> {
        held!(self, of => of.transient.as_mut())
    }

    fn excitation(&self) -> Excitation {
        held!(self, of => of.excitation)
    }

    /// The row of a parameter; none of what is a part of the start, or what the design has not.
    pub(super) fn row(&self, parameter: Parameter) -> Option<&'static ParameterRow> {
        self.writing().rows.iter().find(|row| row.parameter == parameter)
    }

    /// The quantity that a parameter is beside this design.
    pub fn kind(&self, parameter: Parameter) -> &'static Kind {
        use Parameter as P;
        let forced = self.excitation() == Excitation::Force;
        let other = || Writing::rows().find(|row| row.parameter == parameter);
        if let Some((kind, _)) = self.transient().and_then(|of| of_transient(&of, parameter)) {
            return kind;
        }
        match parameter {
            P::Amplitude if forced && self.is_physical() => &of::FORCE_AMPLITUDE,
            P::Rate => &of::SWEEP_RATE,
            P::InitialDisplacement => &of::INITIAL_DISPLACEMENT,
            P::InitialVelocity => &of::INITIAL_VELOCITY,
            P::InitialAbsorberDisplacement => &of::INITIAL_ABSORBER_DISPLACEMENT,
            _ => {
                let row = self.row(parameter).or_else(other);
                row.map_or(&of::INITIAL_ABSORBER_VELOCITY, |row| row.kind)
            }
        }
    }

    /// The key in which a design has a parameter; `None` where it has no such number.
    pub(super) fn schema(&self, parameter: Parameter) -> Option<&'static Value> {
        use Parameter as P;
        let own = self.transient().and_then(|of| of_transient(&of, parameter));
        let [table, key] = match (own, parameter) {
            (Some((_, key)), _) => [*self.writing().tables.last()?, key],
            // The key of the excitation's has no example.
            (_, P::Frequency) if self.is_physical() => ["oscillator", "frequency"],
            _ => self.row(parameter)?.place,
        };
        let schema = match table {
            "oscillator" => of_table::<OscillatorTable>(),
            "absorber" => of_table::<AbsorberTable>(),
            "excitation" => of_table::<ExcitationTable>(),
            _ => of_table::<ReducedTable>(),
        };
        // What an amplitude measures, the kind of excitation says.
        let forced = usize::from(self.excitation() == Excitation::Force);
        let schema = if key == "amplitude" { &schema["oneOf"][forced] } else { schema };
        schema["properties"].get(key)
    }
}

impl Input {
    /// What it says of the design.
    pub(super) fn parameter(&self) -> Option<Parameter> {
        let place = [self.table.as_str(), self.name];
        let row = Writing::rows().find(|row| row.place == place);
        let rate = matches!(place, ["excitation" | "reduced", "rate"]).then_some(Parameter::Rate);
        row.map(|row| row.parameter).or(rate)
    }
}

#[cfg(test)]
mod tests {
    use super::of_transient;
    use crate::case::{Case, excitation_kinds};
    use crate::system::Parameter;

    /// A key that is misspelt here would be found in no table.
    #[test]
    fn every_row_has_its_key_and_gives_back_what_is_set() {
        let reduced = "title = 't'\nsource = 's'\n[reduced]\nmass_ratio = 0.01\ndamping = 1.5\nrestitution = 0.6\n\
                       clearance = 1.0\nforcing = 4.0\nfrequency_ratio = 0.99";
        for text in [Case::starting_text("t"), reduced.to_owned()] {
            let design = Case::parse("a case", &text).expect("valid").design;
            for row in design.writing().rows {
                assert!(design.schema(row.parameter).is_some(), "{:?}", row.place);
                let set = design.with(row.parameter, 0.25).value(row.parameter);
                assert!((set.expect("a number") / 0.25 - 1.0).abs() < 1e-12, "{:?}", row.place);
            }
        }
    }

    /// What core holds as a number of an excitation has a name, a unit and a key here.
    #[test]
    fn every_number_of_an_excitation_has_its_key() {
        let mut numbers = 0;
        for kind in excitation_kinds() {
            let text = Case::starting_text_of("t", kind);
            let design = Case::parse("a case", &text).expect("valid").design;
            let Some(mut transient) = design.transient() else { continue };
            for parameter in Parameter::ALL {
                let held = transient.number(parameter).is_some();
                assert_eq!(
                    held,
                    of_transient(&transient, parameter).is_some(),
                    "{kind} {parameter:?}"
                );
                assert!(!held || design.schema(parameter).is_some(), "{kind} {parameter:?}");
                numbers += usize::from(held);
            }
        }
        assert!(numbers >= 4, "{numbers}");
    }
}
