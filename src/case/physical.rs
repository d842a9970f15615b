//! The tables `[oscillator]`, `[absorber]` and `[excitation]`: a design in physical units.

use std::f64::consts::{FRAC_PI_2, TAU};

use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::{Value, json};

use super::excitation::ExcitationTable;
use super::reader::{Reader, Table};
use super::restitution::{Restitution, one_or_each};
use super::schema::one_of;
use super::support::{self, Orientation, SOFT, Support, SupportKind};
use super::warnings::{hertz, percent};
use crate::excitation::Transient;
use crate::quantity::Dimension;
use crate::quantity::numbers::rounded_to;
use crate::system::{Absorber, Excitation, Harmonic, Structure, modal_stiffness};

/// The linear oscillator whose vibration is to be reduced.
#[derive(Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields, extend("allOf" = [
    { "oneOf": one_of("stiffness", "frequency") },
    { "oneOf": one_of("damping", "damping_ratio") },
]))]
pub(super) struct OscillatorTable {
    /// m1, the oscillator's mass, above 0.
    #[schemars(extend("x-measurand" = "a mass", "exclusiveMinimum" = 0, "x-symbol" = "m_1"), example = "4.168 kg")]
    mass: f64,
    /// k1, the stiffness between base and oscillator, above 0; or give frequency.
    #[schemars(extend("x-measurand" = "a stiffness", "exclusiveMinimum" = 0, "x-symbol" = "k_1"))]
    stiffness: Option<f64>,
    /// f0 = sqrt(k1 / m1) / (2 pi), the natural frequency, above 0; or give stiffness.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0, "x-symbol" = "f_0"), example = "8.35 Hz")]
    frequency: Option<f64>,
    /// c1, the viscous damping between base and oscillator, 0 or more; or give damping_ratio.
    #[schemars(extend("x-measurand" = "a damping", "minimum" = 0, "x-symbol" = "c_1"))]
    damping: Option<f64>,
    /// c1 / (2 sqrt(k1 m1)), 0 or more; or give damping.
    #[schemars(extend("x-measurand" = "a share", "minimum" = 0, "x-symbol" = r"\zeta_1"), example = 0.0069, example = "0.69 %")]
    damping_ratio: Option<f64>,
}

impl OscillatorTable {
    /// The structure that a table says; none where something was reported.
    fn structure(&self, reader: &mut Reader, table: &Table) -> Option<Structure> {
        let mass_kg = self.mass;
        let stiffness_n_per_m = match (self.stiffness, self.frequency) {
            (Some(stiffness), _) => stiffness,
            (None, frequency) => stiffness_of(reader, table, frequency?, mass_kg)?,
        };
        let alone = Structure { mass_kg, stiffness_n_per_m, damping_n_s_per_m: 0.0 };
        let damping_n_s_per_m = match (self.damping, self.damping_ratio) {
            (Some(damping), _) => damping,
            (None, ratio) => ratio? * alone.critical_damping_n_s_per_m(),
        };
        Some(Structure { damping_n_s_per_m, ..alone })
    }

    /// The same as a mode: its natural frequency in Hz, its damping ratio and its mass in kg.
    pub(super) fn mode(&self, reader: &mut Reader, table: &Table) -> Option<[f64; 3]> {
        let of = self.structure(reader, table)?;
        let own = || of.natural_frequency_rad_per_s() / TAU;
        let ratio = || of.damping_n_s_per_m / of.critical_damping_n_s_per_m();
        Some([
            self.frequency.unwrap_or_else(own),
            self.damping_ratio.unwrap_or_else(ratio),
            of.mass_kg,
        ])
    }
}

/// The small mass that moves freely between two walls of the oscillator.
#[derive(Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields, extend("oneOf" = one_of("mass", "mass_ratio")))]
pub(super) struct AbsorberTable {
    /// m2, the absorber's mass, above 0; or give mass_ratio.
    #[schemars(extend("x-measurand" = "a mass", "exclusiveMinimum" = 0, "x-symbol" = "m_2"))]
    mass: Option<f64>,
    /// m2 / m1, above 0; or give mass.
    #[schemars(
        extend("x-measurand" = "a share", "exclusiveMinimum" = 0, "x-symbol" = r"\varepsilon"), example = 0.0077, example = "0.77 %"
    )]
    mass_ratio: Option<f64>,
    /// b, the free distance from the middle to either wall, above 0.
    #[schemars(extend("x-measurand" = "a length", "exclusiveMinimum" = 0, "x-symbol" = "b"))]
    clearance: f64,
    /// r, the coefficient of restitution: 1 loses no energy at an impact, 0 does not rebound. A pair is that of the
    /// wall at x - y = +b, x the oscillator's displacement and y the absorber's, and that of the wall at x - y = -b.
    #[schemars(with = "Value", extend("anyOf" = one_or_each()), example = 0.6, example = vec![0.65, 0.55])]
    restitution: Restitution,
    /// Angle of the cavity against the horizontal, from -90 to 90 degrees: where it is positive gravity, 9.80665 m/s^2,
    /// acts along positive displacements of the absorber. 0 unless given.
    #[schemars(extend("x-measurand" = "an angle", "minimum" = -FRAC_PI_2, "maximum" = FRAC_PI_2, "x-symbol" = r"\alpha"))]
    pub(super) inclination: Option<f64>,
    /// How the cavity lies, instead of `inclination`: horizontal is 0, vertical 90 degrees, positive displacements then
    /// point downwards.
    #[schemars(example = &"vertical")]
    pub(super) orientation: Option<Orientation>,
    /// mu, the coefficient of sliding (Coulomb) friction between absorber and cavity, 0 or more; 0 unless given.
    #[schemars(extend("x-measurand" = "a share", "minimum" = 0, "x-symbol" = r"\mu"), example = 0.003, example = "0.3 %")]
    pub(super) friction: Option<f64>,
    /// What carries the absorber; sliding unless given.
    #[schemars(example = &"spring")]
    pub(super) support: Option<SupportKind>,
    /// f_s, the frequency of the absorber on the pendulum or the spring that carries it, above 0, at most a fifth of the
    /// structure's and of the excitation's: the model leaves its force out.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0, "x-symbol" = r"f_\mathrm{s}"), example = "0.4 Hz")]
    pub(super) support_frequency: Option<f64>,
    /// Room for the length of the pendulum, or for the stretch of the spring by the absorber's weight,
    /// 0.25 m / (f_s / 1 Hz)^2, above 0: more is refused. Any length unless given.
    #[schemars(extend("x-measurand" = "a length", "exclusiveMinimum" = 0, "x-symbol" = r"\ell_\mathrm{s}"), example = "2 m")]
    pub(super) support_room: Option<f64>,
    /// How long the absorber touches a wall in an impact, above 0, at most a fiftieth of the structure's natural period:
    /// `acceleration` then includes the impact, a half-sine pulse of that length. Impacts take no time unless given.
    #[schemars(extend("x-measurand" = "a time", "exclusiveMinimum" = 0, "x-symbol" = r"t_\mathrm{c}"), example = "0.2 ms")]
    contact_time: Option<f64>,
}

/// A design in SI units. [`Case::parse`](super::Case::parse) proves every value finite, masses,
/// stiffness, clearance and frequency above 0, damping and amplitude at least 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Physical {
    /// `m1`, the mass of the linear oscillator; a modal mass where it is written as a mode.
    pub mass_kg: f64,
    /// `k1`, the stiffness between base and oscillator.
    pub stiffness_n_per_m: f64,
    /// `c1`, the viscous damping between base and oscillator.
    pub damping_n_s_per_m: f64,
    /// `m2`, the mass of the absorber.
    pub absorber_mass_kg: f64,
    /// `b`: the absorber is free while its displacement relative to the oscillator is below `b`.
    pub clearance_m: f64,
    /// `r`, the coefficient of restitution, from 0 to 1; the mean where the walls differ.
    pub restitution: f64,
    /// Restitution at the wall `x - y = +b` less that at `x - y = -b`.
    pub restitution_difference: f64,
    /// Angle of the cavity against the horizontal in rad: gravity acts along positive displacements of the absorber
    /// where it is positive.
    pub inclination_rad: f64,
    /// What carries the absorber; none where the case does not say, and it slides.
    pub support: Option<Support>,
    /// `mu`, the coefficient of sliding friction between absorber and cavity.
    pub friction: f64,
    /// How long an impact takes, where its pulse is asked for.
    pub contact_time_s: Option<f64>,
    /// What drives the oscillator.
    pub excitation: Excitation,
    /// `F` in m, the base's displacement, or `P` in N, the force on the oscillator's mass.
    pub amplitude: f64,
    /// `f`, the excitation frequency; that at which a sweep begins, the natural one where nothing drives the
    /// oscillator.
    pub frequency_hz: f64,
    /// What is not steady harmonic excitation.
    pub transient: Option<Transient>,
    /// `phi`, by how much the absorber's place moves where the oscillator's coordinate is 1: 1 unless it is written as a mode.
    pub shape: f64,
}

impl Physical {
    /// The linear oscillator as the absorber's place has it: mass, stiffness and damping over `phi^2`.
    pub const fn structure(&self) -> Structure {
        let scale = self.shape * self.shape;
        Structure {
            mass_kg: self.mass_kg / scale,
            stiffness_n_per_m: self.stiffness_n_per_m / scale,
            damping_n_s_per_m: self.damping_n_s_per_m / scale,
        }
    }

    /// The absorber; on one that a pendulum or a spring carries neither gravity nor friction acts.
    pub fn absorber(&self) -> Absorber {
        let ideal = Absorber {
            restitution_difference: self.restitution_difference,
            ..Absorber::new(self.absorber_mass_kg, self.clearance_m, self.restitution)
        };
        if self.support.is_some_and(|support| support.carries()) {
            return ideal;
        }
        Absorber { inclination_rad: self.inclination_rad, friction: self.friction, ..ideal }
    }

    /// What drives the oscillator.
    pub const fn harmonic(&self) -> Harmonic {
        let Self { excitation, amplitude, frequency_hz, .. } = *self;
        Harmonic { excitation, amplitude, frequency_hz }
    }

    /// The same as it is written.
    const fn own(&self) -> Structure {
        Self { shape: 1.0, ..*self }.structure()
    }

    /// `omega0 = sqrt(k1/m1)`, the natural frequency in rad/s.
    pub fn natural_frequency_rad_per_s(&self) -> f64 {
        self.own().natural_frequency_rad_per_s()
    }

    /// `2 sqrt(k1 m1)`, the damping at which the oscillator alone ceases to ring, in N s/m.
    pub fn critical_damping_n_s_per_m(&self) -> f64 {
        self.own().critical_damping_n_s_per_m()
    }

    /// The longest impact whose pulse is no part of the vibration, in s: a fiftieth of the natural period.
    pub(super) fn most_contact_time_s(&self) -> f64 {
        MOST_CONTACT * TAU / self.natural_frequency_rad_per_s()
    }
}

/// Longest impact over the natural period: its pulse would be a part of the motion, which the model has not.
pub(super) const MOST_CONTACT: f64 = 0.02;

pub(super) const TABLES: [&str; 3] = ["oscillator", "absorber", "excitation"];

/// Reads the three tables; `None` when something was reported.
pub(super) fn read(reader: &mut Reader, root: &Table) -> Option<Physical> {
    report_missing(reader, root);
    let oscillator = reader.optional::<OscillatorTable>(root, TABLES[0]);
    let absorber = reader.optional::<AbsorberTable>(root, TABLES[1]);
    let excitation = reader.optional::<ExcitationTable>(root, TABLES[2]);
    hint_other_kind(reader, root);
    let (table, oscillator) = oscillator?;
    let structure = oscillator.structure(reader, &table)?;
    let ((cavity, absorber), (place, excitation)) = (absorber?, excitation?);
    let (inclination_rad, support) = support::read(reader, &cavity, &absorber)?;
    let transient = excitation.transient(reader, &place, 1.0)?;
    let mut physical = Physical {
        mass_kg: structure.mass_kg,
        stiffness_n_per_m: structure.stiffness_n_per_m,
        damping_n_s_per_m: structure.damping_n_s_per_m,
        absorber_mass_kg: match (absorber.mass, absorber.mass_ratio) {
            (Some(mass), _) => mass,
            (None, ratio) => ratio? * oscillator.mass / (reader.shape * reader.shape),
        },
        clearance_m: absorber.clearance,
        restitution: absorber.restitution.mean(),
        restitution_difference: absorber.restitution.difference(),
        inclination_rad,
        support,
        friction: absorber.friction.unwrap_or_default(),
        contact_time_s: absorber.contact_time,
        excitation: excitation.enters(),
        amplitude: excitation.amplitude.unwrap_or_default(),
        frequency_hz: 0.0,
        transient,
        shape: reader.shape,
    };
    physical.frequency_hz = match transient {
        Some(Transient::Sweep(sweep)) => sweep.from,
        None => excitation.frequency?,
        _ => physical.natural_frequency_rad_per_s() / TAU,
    };
    let most = physical.most_contact_time_s();
    if physical.contact_time_s.is_some_and(|time| time > most) {
        let message = "an impact takes more than a fiftieth of the structure's natural period";
        let expected = format!("expected at most {} s", rounded_to(most, 3));
        let help = "between steel or hard rubber it takes 0.1 to 5 ms; without the line impacts take no time";
        reader.report(cavity.span_of_value("contact_time"), message, expected, help);
        return None;
    }
    let own = physical.natural_frequency_rad_per_s() / TAU;
    if let Some(ratio) = support.and_then(|one| one.frequency_hz).map(|of| of / own)
        && support::is_stiff(ratio)
    {
        let message = format!(
            "the support has {} of the structure's frequency, and the model leaves its force out",
            percent(ratio)
        );
        let expected = format!("expected at most {} %, {}", 100.0 * SOFT, hertz(SOFT * own));
        let help = "take a softer one, a longer pendulum for example: a stiff one holds the absorber back from its walls, and nothing here would say so";
        reader.report(cavity.span_of_value("support_frequency"), message, expected, help);
        return None;
    }
    Some(physical)
}

fn report_missing(reader: &mut Reader, root: &Table) {
    let present = TABLES.into_iter().find(|table| root.has(table)).unwrap_or_default();
    for name in TABLES.into_iter().filter(|name| !root.has(name)) {
        let message = format!("the table [{name}] is missing");
        let expected = format!("expected [{}] beside it", TABLES.join("], ["));
        let help = format!(
            "add a line [{name}] and its keys below it; `vinesink new NAME` shows them all"
        );
        reader.report(root.span_of(present), message, expected, help);
    }
}

/// `k1` in N/m of a natural frequency in Hz and a mass in kg, each valid by itself.
fn stiffness_of(reader: &mut Reader, table: &Table, frequency: f64, mass: f64) -> Option<f64> {
    let stiffness = modal_stiffness(mass, frequency);
    if stiffness.is_finite() && stiffness > 0.0 {
        return Some(stiffness);
    }
    let message =
        format!("a natural frequency with this mass gives a stiffness of {stiffness} N/m");
    let help = "check the units of `frequency` and `mass`";
    let expected = "expected a stiffness above 0 that a number can hold";
    reader.report(table.span_of_value("frequency"), message, expected, help);
    None
}

/// Adds the way out when the amplitude suits the other kind of excitation.
fn hint_other_kind(reader: &mut Reader, root: &Table) -> Option<()> {
    let amplitude = root.value(TABLES[2])?.get_ref().get("amplitude")?;
    let measured = Dimension::of(amplitude.get_ref().as_str()?)?;
    let kind = match measured {
        Dimension::Force => json!(Excitation::Force),
        Dimension::Length => json!(Excitation::BaseDisplacement),
        _ => return None,
    };
    let of_other_unit = |problem: &&mut super::Problem| {
        amplitude.span().contains(&problem.span.start) && problem.message.contains("is the unit of")
    };
    let problem = reader.problems.iter_mut().find(of_other_unit)?;
    let help = problem.help.take().unwrap_or_default();
    let measures = measured.words().0;
    problem.help = Some(format!("{help}; if {measures} is meant, write kind = {kind}"));
    Some(())
}
