//! Reading the limits of `[criteria]`: of a structure, or of its places and absorbers.

use serde_json::{Value, json};
use toml::Spanned;
use toml::de::DeValue;

use super::criteria::{AREAS_ARE_IDEAL, Criterion, EXACT_INSTEAD, Of, Relation, Subject};
use super::modal::find_place;
use super::number::{Bound, Form, sign_of};
use super::reader::{Reader, Table, kind};
use super::value::{ValuePlace, nearest};
use crate::excitation::Scene;
use crate::measure::Part;
use crate::quantity::Dimension;

/// What limits are asked of.
pub(super) struct Asked<'a> {
    pub scene: Scene,
    /// Whether areas of the theory are those of its cavity.
    pub has_areas: bool,
    pub is_physical: bool,
    /// Places that a limit may name, and how many absorbers; none and 0 of a structure that has one of each.
    pub places: &'a [String],
    pub absorbers: usize,
}

/// The limits of a table.
pub(super) fn read_limits(reader: &mut Reader, table: &Table, asked: &Asked) -> Vec<Criterion> {
    let mut found = Vec::new();
    for subject in Subject::ALL {
        // Keys that are not of several are unknown there.
        let is_known = asked.absorbers == 0 || subject.is_of_several();
        let Some(value) = table.value(subject.key()).filter(|_| is_known) else { continue };
        if !makes_sense(reader, table, subject, asked) {
            continue;
        }
        let each: Vec<&Spanned<DeValue>> = match value.get_ref() {
            DeValue::Array(all) if asked.absorbers > 0 => all.iter().collect(),
            _ => vec![value],
        };
        for one in each {
            let placed = match one.get_ref() {
                DeValue::Table(_) if asked.absorbers > 0 => part(reader, one, subject, asked),
                _ => Some((one, Of::Any)),
            };
            let limit =
                placed.and_then(|(limit, of)| criterion(reader, table, subject, limit, of, asked));
            found.extend(limit);
        }
    }
    found
}

/// Whether a limit says anything of a structure; reported where it does not.
fn makes_sense(reader: &mut Reader, table: &Table, subject: Subject, asked: &Asked) -> bool {
    let (key, scene, measure) = (subject.key(), asked.scene, subject.measure());
    if !measure.is_of(scene) {
        let what = scene.words();
        let other = [Scene::Steady, Scene::Release].into_iter().find(|one| measure.is_of(*one));
        let other = other.unwrap_or(Scene::Steady).words();
        let message = format!("`{key}` has no meaning for a structure that is {what}");
        let expected = format!("expected criteria of a structure that is {what}");
        let help = match subject.largest() {
            Some(largest) => format!(
                "it moves for no given time over which a mean could be taken; ask for `{}`, sqrt(2) times the root mean square of a cycle",
                largest.key()
            ),
            None => format!("remove the line: `{key}` is for one that is {other}"),
        };
        reader.report(table.span_of(key), message, expected, help);
        return false;
    }
    if subject == Subject::Z3Share && !asked.has_areas {
        reader.report(table.span_of(key), AREAS_ARE_IDEAL, EXACT_INSTEAD, "ask for `stable_share`");
        return false;
    }
    true
}

/// The limit in a table beside the place or the absorber that it is of.
fn part<'a>(
    reader: &mut Reader,
    one: &'a Spanned<DeValue<'a>>,
    subject: Subject,
    asked: &Asked,
) -> Option<(&'a Spanned<DeValue<'a>>, Of)> {
    let (key, own) = (subject.key(), subject.measure().part().key());
    let entries = one.get_ref().as_table()?;
    let example = match subject.measure().part() {
        Part::Place => format!(", place = \"{}\"", asked.places.first().map_or("", String::as_str)),
        Part::Absorber => ", absorber = 1".to_owned(),
        Part::Whole => String::new(),
    };
    let [with_units, plain] = subject.examples();
    let limit = if asked.is_physical || plain.is_null() { with_units } else { plain };
    let help = format!("write {key} = {{ limit = {limit}{example} }}");
    let foreign = entries.iter().find(|(key, _)| !["limit", own].contains(&key.get_ref().as_ref()));
    if let Some((foreign, _)) = foreign {
        let message = format!("`{}` says nothing of `{key}`", foreign.get_ref());
        let expected = if own.is_empty() {
            "expected `limit` alone, which is of the whole structure".to_owned()
        } else {
            format!("expected `limit` and `{own}`")
        };
        let known: Vec<&str> = ["limit", own].into_iter().filter(|one| !one.is_empty()).collect();
        let help = match nearest(foreign.get_ref(), &known) {
            Some(near) => format!("did you mean `{near}`?"),
            None => help,
        };
        reader.report(foreign.span(), message, expected, help);
        return None;
    }
    let Some(limit) = entries.get("limit") else {
        let message = format!("a limit of `{key}` is not written as one");
        reader.report(one.span(), message, "expected `limit` in it", help);
        return None;
    };
    let Some(named) = entries.get(own) else { return Some((limit, Of::Any)) };
    let of = match subject.measure().part() {
        Part::Absorber => {
            let number = match named.get_ref() {
                DeValue::Integer(number) => number.as_str().parse::<usize>().ok(),
                _ => None,
            };
            let number = number.filter(|number| (1..=asked.absorbers).contains(number));
            if number.is_none() {
                let message = format!("there is no absorber {}", reader.as_written(named.span()));
                let expected = format!(
                    "expected the number of an [[absorber]] in the order of the file, from 1 to {}",
                    asked.absorbers
                );
                reader.report(named.span(), message, expected, help);
            }
            Of::Absorber(number? - 1)
        }
        Part::Place | Part::Whole => {
            let name = named.get_ref().as_str().unwrap_or_default();
            Of::Place(find_place(reader, named.span(), Some(name), asked.places)?)
        }
    };
    Some((limit, of))
}

/// A limit.
fn criterion(
    reader: &mut Reader,
    table: &Table,
    subject: Subject,
    value: &Spanned<DeValue>,
    of: Of,
    asked: &Asked,
) -> Option<Criterion> {
    let (key, measure) = (subject.key(), subject.measure());
    let as_written = reader.as_written(value.span());
    let place = ValuePlace { alone: false, ..reader.place(table, key, value) };
    let form = |of: Dimension| form(of, asked.is_physical);
    let found = match (value.get_ref(), subject.dimension()) {
        (DeValue::Boolean(flag), None) => Ok((Relation::Equal, f64::from(u8::from(*flag)))),
        (DeValue::String(text), Some(of)) => match relation_of(text) {
            Some((relation, sign)) => {
                let limit = reader.number(&ValuePlace { sign, ..place.clone() }, &form(of))?;
                possible(limit, &as_written, of).map(|()| (relation, limit))
            }
            None => Err(format!("is \"{text}\", which says neither >= nor <=")),
        },
        (DeValue::Integer(_) | DeValue::Float(_), Some(of)) => match of {
            Dimension::Number => Ok((Relation::Equal, reader.number(&place, &form(of))?)),
            _ => Err(format!("does not say whether {as_written} is the least or the most")),
        },
        (other, _) => Err(format!("is {}", kind(other))),
    };
    match found {
        Ok((relation, limit)) => Some(Criterion { key, measure, of, relation, limit, as_written }),
        Err(problem) => {
            refuse(reader, &place, subject, &problem);
            None
        }
    }
}

/// How a limit is written: a length, a velocity or an acceleration of a reduced design without unit, a share also without %.
fn form(of: Dimension, is_physical: bool) -> Form {
    let measured = match of {
        Dimension::Number => None,
        Dimension::Length | Dimension::Velocity | Dimension::Acceleration | Dimension::Time
            if !is_physical =>
        {
            None
        }
        _ => Some(of),
    };
    let plain = measured.is_none() || matches!(of, Dimension::Share | Dimension::Level);
    let least = if of == Dimension::Number { json!({ "minimum": 0 }) } else { Value::Null };
    Form { plain, bound: Bound::of(&least), ..Form::free(measured, "2", "") }
}

/// Signs of a limit, and what they say.
const RELATIONS: [(&str, Relation); 5] = [
    (">=", Relation::AtLeast),
    ("≥", Relation::AtLeast),
    ("<=", Relation::AtMost),
    ("≤", Relation::AtMost),
    ("==", Relation::Equal),
];

/// The relation that a text begins with, and the bytes that its sign takes up.
fn relation_of(text: &str) -> Option<(Relation, usize)> {
    let found = |(sign, relation)| Some((relation, sign_of(text, &[sign])?));
    RELATIONS.into_iter().find_map(found)
}

/// What is wrong with a limit that no value of its kind can have.
fn possible(limit: f64, written: &str, of: Dimension) -> Result<(), String> {
    let number = written.trim_start_matches(['>', '<', '=', '≥', '≤', ' ']);
    let why = match of {
        Dimension::Share if limit > 1.0 && limit <= 100.0 && !written.ends_with('%') => {
            format!("a share is at most 1; if {number} % is meant, write the % sign")
        }
        Dimension::Share if !(0.0..=1.0).contains(&limit) => {
            "a share lies between 0 and 100 %".to_owned()
        }
        Dimension::Length | Dimension::Velocity | Dimension::Acceleration | Dimension::Time
            if limit <= 0.0 =>
        {
            "it is always above 0".to_owned()
        }
        _ => return Ok(()),
    };
    Err(format!("asks for {number}, and {why}"))
}

fn refuse(reader: &mut Reader, place: &ValuePlace, subject: Subject, problem: &str) {
    let mut help = format!("write for example {}", place.line);
    let expected = match subject {
        Subject::NoCoexistence => "expected true or false",
        Subject::ImpactsPerPeriod => {
            help += &format!(", or {} = \">= 2\"", place.key);
            "expected a number without quotes, or \">=\" or \"<=\" and a number, in quotes"
        }
        _ => "expected \">=\" or \"<=\", and a value with its unit, in quotes",
    };
    reader.refuse(place, problem, expected.to_owned(), help);
}
