//! The optional table `[criteria]`: what a design must achieve.

use toml::Spanned;
use toml::de::DeValue;

use super::Design;
use super::quantity::{Dimension, Length, Quantity, Share, Velocity};
use super::reader::Reader;
use super::suggest::nearest;
use super::table::{Table, kind};

/// What a criterion is about. Over a band the worst place of it counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Subject {
    /// Share of the band in area Z3 of the theory, strips included.
    Z3Share,
    /// Share of the band with a stable symmetric 1:1 orbit.
    StableShare,
    /// Largest absolute displacement of the oscillator.
    PeakDisplacement,
    /// Root mean square displacement of the oscillator.
    RmsDisplacement,
    /// Largest amplitude along the band against the bare oscillator's largest, in decibels; positive
    /// where it is smaller.
    ReductionDb,
    /// The same against the best tuned mass damper of the same mass.
    ReductionDbTmd,
    /// Share by which the clearance may be off before the stable 1:1 motion is lost.
    MarginClearance,
    /// Largest relative speed of an impact.
    ImpactVelocity,
    /// Impacts per excitation period.
    ImpactsPerPeriod,
    /// Whether every start leads to the same long-term motion.
    NoCoexistence,
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

/// What a criterion's value is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// A share of one.
    Share,
    /// A length, in the case's unit.
    Length,
    /// Decibels.
    Decibel,
    /// A velocity, in m/s or the case's own unit in fast time.
    Velocity,
    /// A count.
    Count,
    /// True or false.
    Flag,
}

/// One line of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct Criterion {
    /// What it is about.
    pub subject: Subject,
    /// How it is measured.
    pub relation: Relation,
    /// Against what, in the unit of [`Subject::measure`]; 1 for true.
    pub limit: f64,
    /// As its author wrote it, without quotes.
    pub as_written: String,
}

impl Subject {
    /// Every subject, in the order of a report.
    pub const ALL: [Self; 10] = [
        Self::Z3Share,
        Self::StableShare,
        Self::PeakDisplacement,
        Self::RmsDisplacement,
        Self::ReductionDb,
        Self::ReductionDbTmd,
        Self::MarginClearance,
        Self::ImpactVelocity,
        Self::ImpactsPerPeriod,
        Self::NoCoexistence,
    ];

    /// The key in a case file.
    pub fn key(self) -> &'static str {
        match self {
            Self::Z3Share => "z3_share",
            Self::StableShare => "stable_share",
            Self::PeakDisplacement => "peak_displacement",
            Self::RmsDisplacement => "rms_displacement",
            Self::ReductionDb => "reduction_db",
            Self::ReductionDbTmd => "reduction_db_tmd",
            Self::MarginClearance => "margin_clearance",
            Self::ImpactVelocity => "impact_velocity",
            Self::ImpactsPerPeriod => "impacts_per_period",
            Self::NoCoexistence => "no_coexistence",
        }
    }

    /// Whether it is about the motions that can happen, which only simulation finds.
    pub fn is_of_motions(self) -> bool {
        !matches!(self, Self::Z3Share | Self::StableShare | Self::MarginClearance)
    }

    /// Whether it is the largest of something that was seen.
    pub fn is_largest(self) -> bool {
        matches!(self, Self::PeakDisplacement | Self::ImpactVelocity)
    }

    /// Whether it compares the largest displacement with another.
    pub fn is_reduction(self) -> bool {
        matches!(self, Self::ReductionDb | Self::ReductionDbTmd)
    }

    /// What its value is.
    pub fn measure(self) -> Measure {
        match self {
            Self::Z3Share | Self::StableShare | Self::MarginClearance => Measure::Share,
            Self::PeakDisplacement | Self::RmsDisplacement => Measure::Length,
            Self::ReductionDb | Self::ReductionDbTmd => Measure::Decibel,
            Self::ImpactVelocity => Measure::Velocity,
            Self::ImpactsPerPeriod => Measure::Count,
            Self::NoCoexistence => Measure::Flag,
        }
    }

    fn example(self) -> &'static str {
        match self {
            Self::Z3Share | Self::StableShare => "\">= 0.8\"",
            Self::PeakDisplacement => "\"<= 3 mm\"",
            Self::RmsDisplacement => "\"<= 2 mm\"",
            Self::ReductionDb | Self::ReductionDbTmd => "\">= 12\"",
            Self::MarginClearance => "\">= 10 %\"",
            Self::ImpactVelocity => "\"<= 0.5 m/s\"",
            Self::ImpactsPerPeriod => "2",
            Self::NoCoexistence => "true",
        }
    }
}

pub(super) const TABLE: &str = "criteria";
pub(super) const KEYS: &[&str] = &[
    "z3_share",
    "stable_share",
    "peak_displacement",
    "rms_displacement",
    "reduction_db",
    "reduction_db_tmd",
    "margin_clearance",
    "impact_velocity",
    "impacts_per_period",
    "no_coexistence",
    "count_inactive",
];

/// Reads the table, and whether an inactive absorber counts, which it does unless the table says
/// otherwise. Empty where there is none, or no design whose units it could be in.
pub(super) fn read(
    reader: &mut Reader,
    root: &Table,
    design: Option<&Design>,
) -> (Vec<Criterion>, bool) {
    let table = reader.table(root, TABLE);
    let (Some(table), Some(design)) = (table, design) else { return (Vec::new(), true) };
    let count_inactive = table.flag(reader, "count_inactive").unwrap_or(true);
    let mut found = Vec::new();
    for subject in Subject::ALL {
        let Some((_, value)) = table.entry(subject.key()) else { continue };
        found.extend(criterion(reader, subject, value, design));
    }
    (found, count_inactive)
}

fn criterion(
    reader: &mut Reader,
    subject: Subject,
    value: &Spanned<DeValue>,
    design: &Design,
) -> Option<Criterion> {
    let as_written = reader.as_written(value.span());
    let of = |relation, limit| {
        Some(Criterion { subject, relation, limit, as_written: as_written.clone() })
    };
    let key = subject.key();
    let problem = match (value.get_ref(), subject.measure()) {
        (DeValue::Boolean(flag), Measure::Flag) => {
            return of(Relation::Equal, f64::from(u8::from(*flag)));
        }
        (DeValue::Integer(_) | DeValue::Float(_), Measure::Count) => {
            match as_written.parse::<f64>() {
                Ok(count) if count.is_finite() && count >= 0.0 => {
                    return of(Relation::Equal, count);
                }
                _ => format!("`{key}` is {as_written}"),
            }
        }
        (DeValue::Integer(_) | DeValue::Float(_), measure) if measure != Measure::Flag => {
            format!("`{key}` does not say whether {as_written} is the least or the most")
        }
        (DeValue::String(text), measure) if measure != Measure::Flag => {
            match bound(text, subject, design) {
                Ok((relation, limit)) => return of(relation, limit),
                Err(message) => format!("`{key}` {message}"),
            }
        }
        (other, _) => format!("`{key}` is {}", kind(other)),
    };
    let expected = match subject.measure() {
        Measure::Flag => "expected true or false".to_owned(),
        Measure::Count => {
            "expected a number without quotes, or \">=\" or \"<=\" and a number, in quotes"
                .to_owned()
        }
        _ => "expected \">=\" or \"<=\", and a value with its unit, in quotes".to_owned(),
    };
    let mut help = format!("write for example {key} = {}", example(subject, design));
    if subject.measure() == Measure::Count {
        help += &format!(", or {key} = \">= {}\"", example(subject, design));
    }
    reader.report(value.span(), problem, expected, help);
    None
}

/// An example in the way the case is written.
fn example(subject: Subject, design: &Design) -> &'static str {
    match (subject.measure(), design) {
        (Measure::Length, Design::Reduced(_)) => "\"<= 0.3\"",
        (Measure::Velocity, Design::Reduced(_)) => "\"<= 1.5\"",
        _ => subject.example(),
    }
}

/// A relation and a limit in the unit of the subject.
fn bound(text: &str, subject: Subject, design: &Design) -> Result<(Relation, f64), String> {
    let text = text.trim();
    let relations = [
        (">=", Relation::AtLeast),
        ("≥", Relation::AtLeast),
        ("<=", Relation::AtMost),
        ("≤", Relation::AtMost),
        ("==", Relation::Equal),
    ];
    let found = relations
        .iter()
        .find_map(|(sign, relation)| text.strip_prefix(sign).map(|rest| (*relation, rest.trim())));
    let Some((relation, rest)) = found else {
        return Err(match nearest(text.get(..2).unwrap_or(text), &[">=", "<="]) {
            Some(_) => format!("is \"{text}\", which does not begin with >= or <="),
            None => format!("is \"{text}\", which says neither >= nor <="),
        });
    };
    let physical = matches!(design, Design::Physical(_));
    let plain = || {
        rest.parse::<f64>()
            .ok()
            .filter(|number| number.is_finite())
            .ok_or_else(|| format!("asks for \"{rest}\", which is not a number"))
    };
    let limit = match subject.measure() {
        Measure::Share if rest.ends_with('%') => quantity::<Share>(rest)?,
        Measure::Length if physical => quantity::<Length>(rest)?,
        Measure::Velocity if physical => quantity::<Velocity>(rest)?,
        Measure::Decibel => match rest.strip_suffix("dB") {
            Some(number) => number
                .trim()
                .parse::<f64>()
                .map_err(|_| format!("asks for \"{rest}\", which is not a number of decibels"))?,
            None => plain()?,
        },
        _ => plain()?,
    };
    possible(limit, rest, subject.measure())?;
    Ok((relation, limit))
}

/// Refuses a limit that no value of its kind can have.
fn possible(limit: f64, written: &str, measure: Measure) -> Result<(), String> {
    match measure {
        Measure::Share if limit > 1.0 && limit <= 100.0 && !written.ends_with('%') => Err(format!(
            "asks for {written}, and a share is at most 1; if {written} % is meant, write the % sign"
        )),
        Measure::Share if !(0.0..=1.0).contains(&limit) => {
            Err(format!("asks for {written}, and a share lies between 0 and 100 %"))
        }
        Measure::Length | Measure::Velocity | Measure::Count if limit < 0.0 => {
            Err(format!("asks for {written}, and it is never below 0"))
        }
        _ => Ok(()),
    }
}

fn quantity<D: Dimension>(text: &str) -> Result<f64, String> {
    Quantity::<D>::parse(text).map(Quantity::si).map_err(|error| error.message)
}

/// What the design must achieve; over a band its worst place counts. The table may be left out.
#[derive(schemars::JsonSchema)]
#[schemars(deny_unknown_fields)]
#[expect(dead_code, reason = "describes the table to editors; read() is what reads it")]
pub(super) struct CriteriaTable {
    /// Share of the band in area Z3 of the theory, strips included.
    #[schemars(example = ">= 0.8")]
    z3_share: Option<String>,
    /// Share of the band with a stable symmetric 1:1 orbit.
    #[schemars(example = ">= 80 %")]
    stable_share: Option<String>,
    /// Largest absolute displacement of the oscillator.
    #[schemars(example = "<= 3 mm")]
    peak_displacement: Option<String>,
    /// Root mean square displacement of the oscillator.
    #[schemars(example = "<= 2 mm")]
    rms_displacement: Option<String>,
    /// Decibels by which the largest amplitude is below the bare oscillator's largest.
    #[schemars(example = ">= 12")]
    reduction_db: Option<String>,
    /// The same against the best tuned mass damper of the same mass.
    #[schemars(example = ">= 0")]
    reduction_db_tmd: Option<String>,
    /// Share by which the clearance may be off before the stable 1:1 motion is lost.
    #[schemars(example = ">= 10 %")]
    margin_clearance: Option<String>,
    /// Largest relative speed of an impact.
    #[schemars(example = "<= 0.5 m/s")]
    impact_velocity: Option<String>,
    /// Impacts per excitation period: a number, or a bound.
    #[schemars(example = 2)]
    impacts_per_period: Option<serde_json::Value>,
    /// Whether every start must lead to the same long-term motion.
    #[schemars(example = true)]
    no_coexistence: Option<bool>,
    /// Whether an absorber that rests where no wall reaches it, and never wakes, counts as a motion; true
    /// unless given. False for a device in which it cannot rest there.
    #[schemars(example = false)]
    count_inactive: Option<bool>,
}
