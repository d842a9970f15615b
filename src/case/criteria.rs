//! The optional table `[criteria]`: what a design must achieve.

use std::f64::consts::FRAC_PI_4;
use std::ops::Range;

use schemars::{JsonSchema, Schema};
use serde::Deserialize;
use serde_json::{Value, json};

use super::Design;
use super::limits::{Asked, read_limits};
use super::reader::{Reader, Table};
use super::schema::add_names;
use crate::measure::{Device, Measure, Part};
use crate::quantity::Dimension;
use crate::quantity::numbers::rounded_to;
use vinesink_core::names;

names! { key:
    /// Keys of the table, each for a measure. Over a band the worst place of it counts.
    #[derive(schemars::JsonSchema)]
    pub(super) enum Subject {
        /// Share of the band in area Z3 of the theory, strips included.
        Z3Share = "z3_share",
        /// Share of the band with a stable symmetric 1:1 orbit.
        StableShare = "stable_share",
        /// Largest absolute displacement of the oscillator.
        PeakDisplacement = "peak_displacement",
        /// Root mean square displacement of the oscillator.
        RmsDisplacement = "rms_displacement",
        /// Largest absolute velocity of the oscillator, not against a moving base; of an impact that before and behind it.
        PeakVelocity = "peak_velocity",
        /// Root mean square velocity of the oscillator.
        RmsVelocity = "rms_velocity",
        /// Largest absolute acceleration of the oscillator in the flights between impacts; with `contact_time` of the absorber
        /// that of the fastest impact's pulse.
        Acceleration = "acceleration",
        /// Root mean square acceleration of the oscillator in the flights between impacts.
        RmsAcceleration = "rms_acceleration",
        /// Largest amplitude along the band against the bare oscillator's largest, in decibels; positive
        /// where it is smaller.
        ReductionDb = "reduction_db",
        /// The same against a tuned mass damper of the same mass, the best for steady vibration.
        ReductionDbTmd = "reduction_db_tmd",
        /// Share by which the clearance may be off before the stable 1:1 motion is lost.
        MarginClearance = "margin_clearance",
        /// Largest relative speed of an impact.
        ImpactVelocity = "impact_velocity",
        /// Impacts per excitation period.
        ImpactsPerPeriod = "impacts_per_period",
        /// Whether every start leads to the same long-term motion.
        NoCoexistence = "no_coexistence",
        /// Time in which a released structure comes down to `decay_level`, from the worst of the absorber's places that are flown.
        DecayTime = "decay_time",
    }
}

/// How a value is measured against its limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Relation {
    /// Not below it.
    AtLeast,
    /// Not above it.
    AtMost,
    /// The same.
    Equal,
}

/// What of a structure a limit is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Of {
    /// Everything that has it: every place, or every absorber.
    #[default]
    Any,
    /// A place, by its number in the case.
    Place(usize),
    /// An absorber, by its number in the case from 0.
    Absorber(usize),
}

impl Of {
    /// Whether it speaks of this part.
    pub fn holds(self, part: Self) -> bool {
        self == Self::Any || self == part
    }
}

/// One limit.
#[derive(Debug, Clone, PartialEq)]
pub struct Criterion {
    /// Its key in the table.
    pub key: &'static str,
    /// What it is about, of the structure with the absorber.
    pub measure: Measure,
    /// Of which place or absorber.
    pub of: Of,
    /// How it is measured.
    pub relation: Relation,
    /// Against what, in SI or the units of a reduced case; 1 for true.
    pub limit: f64,
    /// As its author wrote it, without quotes.
    pub as_written: String,
}

impl Criterion {
    /// Whether it asks for an acceleration in g, which its page then tells in g.
    pub(crate) fn is_in_g(&self) -> bool {
        self.measure.is_of_shaking() && self.as_written.ends_with('g')
    }

    /// That a measure is at most so much, as nobody has written it yet; none of a measure that has no key.
    pub(crate) fn at_most(measure: Measure, limit: f64) -> Option<Self> {
        let subject = Subject::ALL.into_iter().find(|one| one.measure() == measure)?;
        let (relation, of) = (Relation::AtMost, Of::Any);
        Some(Self { key: subject.key(), measure, of, relation, limit, as_written: String::new() })
    }
}

impl Subject {
    pub(super) fn measure(self) -> Measure {
        match self {
            Self::Z3Share => Measure::Z3Share,
            Self::StableShare => Measure::StableShare,
            Self::PeakDisplacement => Measure::Peak,
            Self::RmsDisplacement => Measure::Rms,
            Self::PeakVelocity => Measure::PeakVelocity,
            Self::RmsVelocity => Measure::RmsVelocity,
            Self::Acceleration => Measure::PeakAcceleration,
            Self::RmsAcceleration => Measure::RmsAcceleration,
            Self::ReductionDb => Measure::ReductionDb,
            Self::ReductionDbTmd => Measure::ReductionDbTmd,
            Self::MarginClearance => Measure::MarginClearance,
            Self::ImpactVelocity => Measure::ImpactSpeed,
            Self::ImpactsPerPeriod => Measure::ImpactsPerPeriod,
            Self::NoCoexistence => Measure::NoCoexistence,
            Self::DecayTime => Measure::DecayTime,
        }
    }

    /// The largest value of that whose root mean square it is.
    pub(super) const fn largest(self) -> Option<Self> {
        match self {
            Self::RmsDisplacement => Some(Self::PeakDisplacement),
            Self::RmsVelocity => Some(Self::PeakVelocity),
            Self::RmsAcceleration => Some(Self::Acceleration),
            _ => None,
        }
    }

    pub(super) fn dimension(self) -> Option<Dimension> {
        self.measure().kind(Device::Absorber).map(|kind| kind.dimension)
    }
}

/// What the design must achieve; over a band its worst place counts. The table may be left out.
#[derive(Deserialize, JsonSchema)]
#[schemars(extend("additionalProperties" = false), transform = with_subjects)]
pub(super) struct CriteriaTable {
    /// Whether an absorber that rests where no wall reaches it, and never wakes, counts as a motion; true
    /// unless given. False for a device in which it cannot rest there.
    #[schemars(example = false)]
    count_inactive: Option<bool>,
    /// Share of its first amplitude at which a released structure has come to rest, below 1; a tenth unless given.
    #[schemars(extend("x-measurand" = "a share", "exclusiveMinimum" = 0, "maximum" = 0.99), example = 0.1, example = "10 %")]
    decay_level: Option<f64>,
    /// f_c, up to which a sensor reads `acceleration`, above 0: it then includes impacts, each of which an ideal low-pass filter
    /// shows with a peak of 2 f_c times the jump of the velocity, as `contact_time` = pi/(4 f_c) does. Impacts are left out
    /// unless one of the two is given.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0, "x-symbol" = r"f_\mathrm{c}"), example = "1 kHz")]
    acceleration_upto: Option<f64>,
}

/// The table as it was read.
pub(super) struct Criteria {
    pub all: Vec<Criterion>,
    pub count_inactive: bool,
    pub decay_level: f64,
    /// How long an impact takes in s as a sensor sees it, where the table says up to which frequency that reads.
    pub contact_time: Option<f64>,
}

/// Where the table does not say when a released structure has come to rest.
const DECAY_LEVEL: f64 = 0.1;

fn with_subjects(schema: &mut Schema) {
    add_names::<Subject>(schema, |key| Some(Subject::of_name(key)?.property()));
}

/// The same with limits of one place or absorber, or of several in a list.
pub(super) fn with_placed_subjects(schema: &mut Schema) {
    add_names::<Subject>(schema, |key| {
        let subject = Subject::of_name(key).filter(|one| one.is_of_several())?;
        let mut property = subject.property();
        let part = match subject.measure().part() {
            Part::Place => json!({ "place": { "type": "string" } }),
            Part::Absorber => json!({ "absorber": { "type": "integer", "minimum": 1 } }),
            Part::Whole => return Some(property),
        };
        let mut keys = part;
        keys["limit"] = json!({ "anyOf": property["anyOf"].clone() });
        let table = json!({
            "type": "object", "properties": keys, "required": ["limit"], "additionalProperties": false,
        });
        let list = json!({ "type": "array", "items": { "anyOf": [property["anyOf"][0], table] } });
        let types = property["anyOf"].as_array_mut();
        types.into_iter().for_each(|types| types.extend([table.clone(), list.clone()]));
        Some(property)
    });
}

impl Subject {
    /// A limit of it, and one without units; null where that is the same.
    pub(super) fn examples(self) -> [Value; 2] {
        let (example, plain) = match self.dimension() {
            _ if self == Self::MarginClearance => (json!(">= 10 %"), Value::Null),
            Some(Dimension::Length) => (json!("<= 3 mm"), json!("<= 0.3")),
            Some(Dimension::Velocity) => (json!("<= 0.5 m/s"), json!("<= 1.5")),
            Some(Dimension::Acceleration) => (json!("<= 0.5 g"), json!("<= 0.4")),
            Some(Dimension::Time) => (json!("<= 5 s"), json!("<= 100")),
            Some(Dimension::Level) => (json!(">= 12"), Value::Null),
            Some(Dimension::Number) => (json!(2), Value::Null),
            Some(_) => (json!(">= 80 %"), Value::Null),
            None => (json!(true), Value::Null),
        };
        [example, plain]
    }

    /// How its limit is written.
    fn property(self) -> Value {
        let [example, plain] = self.examples();
        let types = match &example {
            Value::Bool(_) => json!([{ "type": "boolean" }]),
            Value::Number(_) => json!([{ "type": "number", "minimum": 0 }, { "type": "string" }]),
            _ => json!([{ "type": "string" }]),
        };
        json!({ "anyOf": types, "examples": [example], "x-plain": [plain] })
    }

    /// Whether it may be asked of a structure of several modes or absorbers: the theory's areas are of one, and nobody releases one
    /// yet.
    pub(super) const fn is_of_several(self) -> bool {
        !matches!(self, Self::Z3Share | Self::DecayTime)
    }
}

/// Reads the table. No criteria where there is none, or no design whose units they could be in.
pub(super) fn read(reader: &mut Reader, root: &Table) -> Criteria {
    let read = reader.optional::<CriteriaTable>(root, "criteria");
    let mut found = Criteria {
        all: Vec::new(),
        count_inactive: true,
        decay_level: DECAY_LEVEL,
        contact_time: None,
    };
    let (Some((table, read)), Some(design)) = (read, reader.design) else { return found };
    let asked = Asked {
        scene: design.scene(),
        has_areas: design.has_ideal_cavity(),
        is_physical: design.is_physical(),
        places: &[],
        absorbers: 0,
    };
    found.all = read_limits(reader, &table, &asked);
    found.count_inactive = read.count_inactive.unwrap_or(true);
    found.decay_level = read.decay_level.unwrap_or(DECAY_LEVEL);
    let upto = read.acceleration_upto;
    found.contact_time = upto.and_then(|upto| seen_for(reader, &table, upto, &found.all, &design));
    found
}

/// How long an impact takes for a sensor that reads up to a frequency; reported where nothing is read of it.
fn seen_for(
    reader: &mut Reader,
    table: &Table,
    upto: f64,
    asked: &[Criterion],
    design: &Design,
) -> Option<f64> {
    let span = table.span_of(UPTO);
    let Design::Physical(of) = design else {
        let message = "`acceleration_upto` has no meaning beside [reduced]";
        reader.report(span, message, UPTO_EXPECTED, "remove the line");
        return None;
    };
    let asks = asked.iter().any(|one| one.measure == Measure::PeakAcceleration);
    sensor_sees(reader, span, upto, [asks, of.contact_time_s.is_some()], of.most_contact_time_s())
}

/// The key of a criterion's sensor, and what it is expected beside.
pub(super) const UPTO: &str = "acceleration_upto";
const UPTO_EXPECTED: &str =
    "expected a frequency beside `acceleration`, of a case in physical units";

/// How long an impact takes in s for a sensor that reads up to a frequency in Hz: of a case that asks for the largest acceleration or
/// not, and has a contact time already or not, where impacts may take so long at most.
pub(super) fn sensor_sees(
    reader: &mut Reader,
    span: Range<usize>,
    upto: f64,
    [asks, timed]: [bool; 2],
    most: f64,
) -> Option<f64> {
    let mut refused = |message: &str, help: &str| {
        reader.report(span.clone(), message, UPTO_EXPECTED, help);
        None
    };
    let contact_time = FRAC_PI_4 / upto;
    if !asks {
        let help = "ask for one, such as acceleration = \"<= 2 g\", or remove the line";
        refused("`acceleration_upto` is about an `acceleration` that nothing asks for", help)
    } else if timed {
        let help = "remove one of them: both say how an impact is read";
        refused("`acceleration_upto` stands beside a `contact_time`", help)
    } else if contact_time > most {
        let least = rounded_to(FRAC_PI_4 / most, 3);
        let help = format!("a sensor that reads impacts reads up to {least} Hz or more here");
        refused(
            "`acceleration_upto` is below what a sensor needs to tell an impact from the vibration",
            &help,
        )
    } else {
        Some(contact_time)
    }
}

/// What there is to say of shares in area Z3 where the cavity is inclined, rubs or has unequal walls, and what is
/// expected instead.
pub(crate) const AREAS_ARE_IDEAL: &str =
    "area Z3 is of a level cavity without friction whose walls are alike";
pub(super) const EXACT_INSTEAD: &str = "expected what exact orbits of this cavity decide";
