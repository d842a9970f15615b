//! How a cavity lies, and what carries the absorber in it.
//!
//! A pendulum or a soft spring of frequency `f_s` balances gravity and holds the absorber in the middle. The model takes it
//! as ideal and leaves out its restoring acceleration, `(2 pi f_s)^2` times the displacement against the structure. In 1:1
//! resonance that changes the motion by about `(f_s/f)^2`: between two impacts the absorber flies from wall to wall, and
//! what it is slowed down by on the one side of the middle it has been sped up by on the other.

use std::f64::consts::{FRAC_PI_2, TAU};

use libm::{sin, sqrt};
use vinesink_core::names;

use super::inputs::Input;
use super::physical::{AbsorberTable, Physical};
use super::reader::{Reader, Table};
use super::{Case, Design, Distribution, Rounding};
use crate::excitation::{Record, Scene, Transient};
use crate::linear::{BandSystems, bare_along, driven};
use crate::quantity::numbers::rounded_to;
use crate::system::{Band, BandOver, Parameter, Parameters, Scales, System};
use crate::system::{STANDARD_GRAVITY, gravity_shares};

names! { name:
    /// How a cavity lies.
    #[derive(schemars::JsonSchema)]
    pub enum Orientation {
        /// Its length is level.
        Horizontal = "horizontal",
        /// Its length is upright, and gravity acts along positive displacements of the absorber.
        Vertical = "vertical",
    }
}

names! { name:
    /// What carries the absorber.
    #[derive(schemars::JsonSchema)]
    pub enum SupportKind {
        /// The cavity: the absorber slides on it, and lies at its lower wall where it is not level.
        Sliding = "sliding",
        /// A pendulum on which it swings to and fro without friction, in a horizontal cavity.
        Pendulum = "pendulum",
        /// A soft spring that carries its weight.
        Spring = "spring",
    }
}

/// What carries the absorber in its cavity, where the case says so.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// What it is.
    pub kind: SupportKind,
    /// `f_s` in Hz, the frequency of the absorber on a pendulum or a spring; none of one that slides.
    pub frequency_hz: Option<f64>,
}

impl Support {
    /// Whether a pendulum or a spring carries the absorber: then neither gravity nor friction acts along the cavity.
    pub fn carries(&self) -> bool {
        self.kind != SupportKind::Sliding
    }
}

/// Frequency of a support over the structure's, or over the excitation's, up to which its force is left out: then `(f_s/f)^2`
/// is 4 %.
pub(super) const SOFT: f64 = 0.2;
/// Relative error that a ratio of two frequencies may have.
const ROUNDING: f64 = 1e-12;

/// Whether a support of so many times another frequency holds the absorber back: a case as it is written is then refused, for the model
/// has the absorber where it would not be.
pub(super) fn is_stiff(ratio: f64) -> bool {
    ratio > SOFT * (1.0 + ROUNDING)
}

/// Room in m where a case gives none: what is longer is a slip of a unit.
const MOST_ROOM: f64 = 1e6;

/// `g/(2 pi f)^2` in m: the length of a pendulum of a frequency in Hz, and by how much its weight stretches a spring.
pub(super) fn static_length(frequency_hz: f64) -> f64 {
    let omega = TAU * frequency_hz;
    STANDARD_GRAVITY / (omega * omega)
}

impl Physical {
    /// How the cavity lies; none where it is inclined.
    pub fn orientation(&self) -> Option<Orientation> {
        match gravity_shares(self.inclination_rad) {
            [0.0, _] => Some(Orientation::Horizontal),
            [_, 0.0] => Some(Orientation::Vertical),
            _ => None,
        }
    }

    /// `g/(2 pi f_s)^2` in m: the length of the pendulum, or by how much the weight along the cavity stretches the spring;
    /// none where there is neither.
    pub fn support_length_m(&self) -> Option<f64> {
        length(self.support?, self.inclination_rad)
    }
}

fn length(support: Support, inclination_rad: f64) -> Option<f64> {
    let along = match support.kind {
        SupportKind::Sliding => 0.0,
        SupportKind::Pendulum => 1.0,
        SupportKind::Spring => sin(inclination_rad).abs(),
    };
    Some(along * static_length(support.frequency_hz?)).filter(|length| *length > 0.0)
}

impl Design {
    /// What carries the absorber, where the case says so.
    pub fn support(&self) -> Option<Support> {
        match self {
            Self::Physical(of) => of.support,
            Self::Reduced(_) => None,
        }
    }

    /// What the absorber is, where a pendulum or a spring carries it and a parameter of the cavity therefore does nothing.
    pub(super) fn carried(&self, parameter: Parameter) -> Option<&'static str> {
        let of_cavity = matches!(parameter, Parameter::Inclination | Parameter::Friction);
        match self.support().filter(|_| of_cavity)?.kind {
            SupportKind::Sliding => None,
            SupportKind::Pendulum => Some("an absorber on a pendulum"),
            SupportKind::Spring => Some("an absorber on a spring"),
        }
    }
}

impl Case {
    /// The frequencies and amplitudes of a harmonic excitation that the case is about; none where it has another.
    fn harmonic(&self) -> Option<Band> {
        match self.design.transient() {
            None => Some(self.range()),
            Some(Transient::Sweep(sweep)) => {
                let [a, b] = [sweep.from, sweep.to].map(|end| self.units().frequency_ratio(end));
                let range = [a.min(b), a.max(b)];
                let over = BandOver::Frequency;
                Some(Band { base: self.system(), over, range, spectrum: Vec::new() })
            }
            Some(_) => None,
        }
    }

    /// The largest acceleration of the structure while it carries the absorber along, over `b omega0^2`; none where
    /// nobody has handed in the samples of its record.
    pub(super) fn acceleration_carried(&self) -> Option<f64> {
        if let Some(release) = self.design.release() {
            // With the absorber the structure is slower and its acceleration smaller.
            return Some(release.amplitude(&self.units()));
        }
        if self.recording.is_some() {
            let each = self.records().iter().filter_map(|record| self.carried_under(record));
            return each.reduce(f64::max);
        }
        let band = self.harmonic()?;
        let acceleration = |there: &System| {
            let omega = there.frequency_ratio();
            // Without damping nothing limits a resonance.
            let carried = there.response_carried();
            carried.map_or(f64::INFINITY, |response| omega * omega * response.amplitude())
        };
        Some(BandSystems::of(&band).largest(acceleration).1)
    }

    /// The same under a record. The structure is heavier then: one of a lower natural frequency.
    fn carried_under(&self, record: &Record) -> Option<f64> {
        let Parameters { mass_ratio, damping, .. } = self.system.parameters();
        let mass = 1.0 + mass_ratio;
        let units = self.units();
        let slower = Scales {
            natural_frequency: units.natural_frequency / sqrt(mass),
            oscillator_mass: units.oscillator_mass * mass,
            ..*units
        };
        let damping = damping / sqrt(mass);
        let heavier = System::new(Parameters { damping, ..self.system.parameters() }).ok()?;
        let moved = driven(&heavier, None, &record.pieces_to_rest(&slower, Record::LONGEST), true);
        Some(moved.shaking?.peak_acceleration / mass)
    }

    /// The restoring acceleration of the support that the model leaves out, over the structure's, both at their
    /// largest: `(f_s/f)^2`, or `(f_s/f)^2 b/x` where the structure with an absorber at rest moves by less than the
    /// clearance, with the lowest frequency `f` of the excitation; none where nothing is left out. Under a record the
    /// structure's size is not known, and the first is told.
    pub fn support_left_out(&self) -> Option<f64> {
        let ratio = self.support_ratio()?;
        let moves = match self.design.scene() {
            Scene::Record => None,
            Scene::Release => self.design.release().map(|one| one.amplitude(&self.units())),
            _ => self.harmonic().map(|band| bare_along(&band).1),
        };
        let moves = moves.filter(|one| *one > 0.0).unwrap_or(1.0);
        Some((ratio * ratio / moves.min(1.0)).min(f64::MAX))
    }

    /// The support's frequency over the lowest of the excitation.
    pub(super) fn support_ratio(&self) -> Option<f64> {
        Some(self.design.support()?.frequency_hz? / self.lowest_hz())
    }

    /// The support's frequency over the lowest that the structure has where its mass or its own frequency is uncertain, at twice a
    /// standard deviation, or swept; none where neither is.
    pub(super) fn support_ratio_in_drift(&self) -> Option<f64> {
        let support = self.design.support()?.frequency_hz?;
        let shapes = |one: &Parameter| matches!(one, Parameter::NaturalFrequency | Parameter::Mass);
        let uncertain = self.uncertainty.parameters().filter_map(|(of, errors)| {
            let largest = match errors {
                Distribution::Normal(deviation) => 2.0 * deviation,
                Distribution::Uniform(largest) => largest,
            };
            let own = self.design.value(of)?;
            // More mass is a lower frequency.
            Some((of, if of == Parameter::Mass { own + largest } else { own - largest }))
        });
        let swept = self.sweep.iter().flat_map(|sweep| &sweep.axes).filter_map(|axis| {
            let ends = [axis.values.first()?, axis.values.last()?];
            Some((axis.parameter, *ends[usize::from(axis.parameter == Parameter::Mass)]))
        });
        let own = |(of, value): (Parameter, f64)| match of {
            Parameter::Mass => {
                let mass = self.design.value(of)?;
                Some(self.units().frequency(1.0) * sqrt(mass / value))
            }
            _ => Some(value),
        };
        let all = uncertain.chain(swept).filter(|(of, _)| shapes(of)).filter_map(own);
        all.map(|own| support / own.max(0.0)).max_by(f64::total_cmp)
    }

    /// The lowest frequency of the excitation, or the structure's where it has none; in Hz, or over the latter.
    pub(super) fn lowest_hz(&self) -> f64 {
        let lowest = self.harmonic().map_or(1.0, |band| match band.is_of_one_frequency() {
            true => band.base.frequency_ratio(),
            false => band.range[0],
        });
        self.units().frequency(lowest)
    }
}

/// Reads how the cavity lies, as an inclination in rad, and what carries the absorber; `None` where something was
/// reported.
pub(super) fn read(
    reader: &mut Reader,
    table: &Table,
    absorber: &AbsorberTable,
) -> Option<(f64, Option<Support>)> {
    let inclination = inclination(reader, table, absorber)?;
    let kind = absorber.support.unwrap_or(SupportKind::Sliding);
    if kind == SupportKind::Sliding {
        if let Some(key) =
            ["support_frequency", "support_room"].into_iter().find(|key| table.has(key))
        {
            let message = format!("`{key}` has no meaning for an absorber that slides");
            let expected = "expected support = \"pendulum\" or support = \"spring\" beside it";
            let help = "write support = \"pendulum\" in a horizontal cavity, support = \"spring\", or remove the line";
            reader.report(table.span_of(key), message, expected, help);
            return None;
        }
        let said = absorber.support.is_some() || absorber.orientation.is_some();
        return Some((inclination, said.then_some(Support { kind, frequency_hz: None })));
    }
    if kind == SupportKind::Pendulum && gravity_shares(inclination)[0] != 0.0 {
        let message = "a pendulum swings to and fro, and the cavity is not level";
        let expected = "expected a horizontal cavity, or support = \"spring\"";
        let help = "a soft spring carries what moves up and down: write support = \"spring\"";
        reader.report(table.span_of_value("support"), message, expected, help);
        return None;
    }
    let Some(frequency) = absorber.support_frequency else {
        let message =
            format!("`support_frequency` is missing beside support = \"{}\"", kind.name());
        let expected = "expected the frequency of the absorber on it";
        let help = "add the line support_frequency = \"0.4 Hz\", at most a fifth of the excitation's frequency";
        reader.report(table.span_of("support"), message, expected, help);
        return None;
    };
    if absorber.friction.is_some_and(|friction| friction > 0.0) {
        let message =
            format!("an absorber on a {} does not rub, and there is `friction`", kind.name());
        let help = "remove the line, or write support = \"sliding\"";
        reader.report(table.span_of("friction"), message, "expected no friction", help);
        return None;
    }
    let support = Support { kind, frequency_hz: Some(frequency) };
    let room = absorber.support_room.unwrap_or(MOST_ROOM);
    if let Some(length) = length(support, inclination).filter(|length| *length > room) {
        let [told, most] = [length, room].map(metres);
        let of = rounded_to(frequency, 3);
        let does = match kind {
            SupportKind::Pendulum => format!("a pendulum of {of} Hz is {told} long"),
            _ => format!("the absorber's weight stretches a spring of {of} Hz by {told}"),
        };
        let message = format!("{does}, more than the room of {most}");
        let expected = "expected a length of 0.25 m/(f/Hz)^2 that fits into `support_room`";
        let help = format!(
            "give it more room, or {} Hz if that is at most a fifth of the excitation's frequency",
            Rounding::Up.of(frequency * sqrt(length / room))
        );
        reader.report(table.span_of_value("support_frequency"), message, expected, help);
        return None;
    }
    Some((inclination, Some(support)))
}

/// The inclination that the case says in one way or in both.
fn inclination(reader: &mut Reader, table: &Table, absorber: &AbsorberTable) -> Option<f64> {
    let Some(orientation) = absorber.orientation else {
        return Some(absorber.inclination.unwrap_or_default());
    };
    let upright = match orientation {
        Orientation::Horizontal => 0.0,
        Orientation::Vertical => FRAC_PI_2,
    };
    let given = absorber.inclination.unwrap_or(upright);
    // What is rounded at a quarter turn is one.
    let agree = match orientation {
        Orientation::Horizontal => given == 0.0,
        Orientation::Vertical => gravity_shares(given)[1] == 0.0,
    };
    let span = table.span_of_value("orientation");
    if !agree {
        let message = format!(
            "`orientation` is {}, and `inclination` is {}",
            orientation.name(),
            reader.as_written(table.span_of_value("inclination"))
        );
        let help = "remove one of the two lines: vertical is an inclination of 90 deg, horizontal one of 0 deg";
        reader.report(span, message, "expected both to say the same", help);
        return None;
    }
    let (place, name, symbol) = ("absorber".to_owned(), "orientation", r"\alpha".to_owned());
    let (as_written, unit) = (reader.as_written(span.clone()), "rad");
    // Its table may not be the last that was read.
    let after = reader.inputs.iter().rposition(|input| input.table == place);
    let after = after.map_or(reader.inputs.len(), |last| last + 1);
    let input = Input { table: place, name, symbol, value: given, unit, as_written, span };
    reader.inputs.insert(after, input);
    Some(given)
}

/// A length in m as text, three digits.
pub(super) fn metres(length: f64) -> String {
    match length {
        short if short < 0.1 => format!("{} mm", rounded_to(1000.0 * short, 3)),
        usual => format!("{} m", rounded_to(usual, 3)),
    }
}
