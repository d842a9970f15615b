//! A structure of one mode with one absorber is one structure, however it is written: lists of one `[[mode]]`, `[[absorber]]` and
//! `[[excitation]]` are read as `[oscillator]`, `[absorber]` and `[excitation]`.
//!
//! The displacement of the absorber's place is `x = phi q`: a force there meets the mass `m/phi^2`, and a base that moves by `F`
//! does so as under `[oscillator]` where the mode's part `phi Gamma` in that is 1. Values keep where they stand in the text. What
//! says more than the other form can, as several places or a force in the mode alone, stays a list.

use std::borrow::Cow;
use std::ops::{Range, RangeInclusive};

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::Problem;
use super::number::plain_number;
use crate::quantity::Dimension;

/// What such a document comes to.
pub(super) struct OneMode<'t> {
    /// The same with the tables of the other form.
    pub document: DeTable<'t>,
    /// The mode's shape at the absorber.
    pub shape: f64,
    /// Whether its structure is written as a mode.
    pub is_mode: bool,
}

/// Keys of a mode that are the structure's.
const STRUCTURE: [&str; 3] = ["frequency", "damping_ratio", "mass"];
/// Keys of `[sweep]` and `[optimize]` that choose among several.
const CHOICES: [(&str, &[&str]); 2] =
    [("sweep", &["absorber", "excitation"]), ("optimize", &["places", "split_mass"])];
/// Shapes at which no number of a structure leaves what a system can have by that alone.
const SHAPES: RangeInclusive<f64> = 1e-6..=1e6;
/// Relative distance from 1 within which a base moves the structure as it does itself: what is written has some digits.
const WHOLE: f64 = 1e-9;

impl<'t> OneMode<'t> {
    /// None where there are several of something, or it says what the other form cannot.
    pub fn of(document: &DeTable<'t>) -> Option<Self> {
        if document.contains_key("oscillator") {
            return Self::beside_oscillator(document);
        }
        if ["reduced", "modes"].iter().any(|name| document.contains_key(*name)) {
            return None;
        }
        let [mode, absorber, load] =
            ["mode", "absorber", "excitation"].map(|name| only(document, name));
        let ((mode_span, mode), (absorber_span, absorber), (load_span, load)) =
            (mode?, absorber?, load?);
        let (place, shape) = shape_of(&mode)?;
        let is_there = |table: &DeTable| match table.get("place") {
            Some(named) => named.get_ref().as_str() == Some(place.as_str()),
            None => true,
        };
        if !is_there(&absorber) || !is_there(&load) || !acts_there(&mode, &load, shape) {
            return None;
        }
        let structure: DeTable = mode
            .iter()
            .filter(|(key, _)| STRUCTURE.contains(&key.get_ref().as_ref()))
            .map(|(key, value)| (key.clone(), value.clone()))
            .collect();
        let mut document = document.clone();
        for name in ["mode", "absorber", "excitation"] {
            document.remove(name);
        }
        let mut excitation = without(&load, &["place", "mode", "from", "to"]);
        let band: DeTable = load
            .iter()
            .filter(|(key, _)| ["from", "to"].contains(&key.get_ref().as_ref()))
            .map(|(key, value)| (key.clone(), value.clone()))
            .collect();
        // Both say a range.
        if !band.is_empty() && document.contains_key("band") {
            return None;
        }
        if !band.is_empty() {
            let own = own_frequency(&mode, &band)?;
            excitation.insert(key("frequency", &load_span), own);
            document.insert(key("band", &load_span), table(band, &load_span));
        }
        let mut add = |name: &'static str, of: DeTable<'t>, span: &Range<usize>| {
            document.insert(key(name, span), table(of, span));
        };
        add("oscillator", structure, &mode_span);
        add("absorber", without(&absorber, &["place"]), &absorber_span);
        add("excitation", excitation, &load_span);
        with_limits_of_one_place(&mut document, &place)?;
        for (name, choices) in CHOICES {
            let Some(value) = document.get_mut(name) else { continue };
            if let DeValue::Table(of) = value.get_mut() {
                choices.iter().for_each(|choice| drop(of.remove(*choice)));
            }
        }
        Some(Self { document, shape, is_mode: true })
    }

    /// Lists of one absorber or one excitation beside `[oscillator]`, which has no places.
    fn beside_oscillator(document: &DeTable<'t>) -> Option<Self> {
        // Which of them is meant is asked of the author.
        if ["mode", "modes"].iter().any(|name| document.contains_key(*name)) {
            return None;
        }
        let mut document = document.clone();
        let mut is_list = false;
        for name in ["absorber", "excitation"] {
            if !document.get(name)?.get_ref().is_array() {
                continue;
            }
            let (span, one) = only(&document, name)?;
            document.remove(name);
            document.insert(key(name, &span), table(one, &span));
            is_list = true;
        }
        is_list.then_some(Self { document, shape: 1.0, is_mode: false })
    }
}

/// A problem in the words of lists.
pub(super) fn of_lists(problem: Problem) -> Problem {
    let words = |text: String| text.replace("[oscillator]", "[[mode]]");
    Problem {
        message: words(problem.message),
        expected: words(problem.expected),
        help: problem.help.map(words),
        ..problem
    }
}

fn key<'t>(name: &'static str, span: &Range<usize>) -> Spanned<Cow<'t, str>> {
    Spanned::new(span.clone(), Cow::Borrowed(name))
}

fn table<'t>(of: DeTable<'t>, span: &Range<usize>) -> Spanned<DeValue<'t>> {
    Spanned::new(span.clone(), DeValue::Table(of))
}

fn without<'t>(of: &DeTable<'t>, keys: &[&str]) -> DeTable<'t> {
    let all = of.iter().filter(|(key, _)| !keys.contains(&key.get_ref().as_ref()));
    all.map(|(key, value)| (key.clone(), value.clone())).collect()
}

/// The table of a name that is the only one of it, and where it stands.
fn only<'t>(document: &DeTable<'t>, name: &str) -> Option<(Range<usize>, DeTable<'t>)> {
    let (key, value) = document.get_key_value(name)?;
    match value.get_ref() {
        DeValue::Table(one) => Some((key.span(), one.clone())),
        DeValue::Array(all) => match all.iter().collect::<Vec<_>>().as_slice() {
            [one] => Some((one.span(), one.get_ref().as_table()?.clone())),
            _ => None,
        },
        _ => None,
    }
}

/// The one place of a mode and its shape there.
fn shape_of(mode: &DeTable) -> Option<(String, f64)> {
    let known = |key: &str| STRUCTURE.contains(&key) || ["shape", "participation"].contains(&key);
    let is_whole = STRUCTURE.iter().all(|key| mode.contains_key(*key));
    if !is_whole || !mode.iter().all(|(key, _)| known(key.get_ref())) {
        return None;
    }
    let mut places = mode.get("shape")?.get_ref().as_table()?.iter();
    let (Some((name, shape)), None) = (places.next(), places.next()) else { return None };
    let shape = plain_number(shape.get_ref()).filter(|shape| SHAPES.contains(&shape.abs()))?;
    Some((name.get_ref().to_string(), shape))
}

/// Whether a load drives the structure as one of `[oscillator]` is driven.
fn acts_there(mode: &DeTable, load: &DeTable, shape: f64) -> bool {
    let kind = load.get("kind").and_then(|kind| kind.get_ref().as_str().map(str::to_owned));
    let is_whole = |of: f64| (of - 1.0).abs() <= WHOLE;
    match kind.as_deref() {
        Some("base-displacement") => {
            let part = mode.get("participation").and_then(|part| plain_number(part.get_ref()));
            part.is_some_and(|part| is_whole(part * shape))
        }
        // In the mode alone a force is one at a place where its shape is 1.
        Some("force") => !load.contains_key("mode") || is_whole(shape),
        _ => false,
    }
}

/// The frequency of a range that stands for its own excitation: the structure's, or the end that is next to it.
fn own_frequency<'t>(mode: &DeTable<'t>, band: &DeTable<'t>) -> Option<Spanned<DeValue<'t>>> {
    let hertz = |of: &Spanned<DeValue>| {
        let text = of.get_ref().as_str()?;
        Dimension::Frequency.parse(text).ok()
    };
    let [own, from, to] =
        [mode.get("frequency")?, band.get("from")?, band.get("to")?].map(|of| (of, hertz(of)));
    let (own_hz, from_hz, to_hz) = (own.1?, from.1?, to.1?);
    let chosen = if own_hz < from_hz {
        from.0
    } else if own_hz > to_hz {
        to.0
    } else {
        own.0
    };
    Some(chosen.clone())
}

/// Limits of the one place as limits of the structure; none where one says more.
fn with_limits_of_one_place(document: &mut DeTable, place: &str) -> Option<()> {
    let Some(criteria) = document.get_mut("criteria") else { return Some(()) };
    let DeValue::Table(criteria) = criteria.get_mut() else { return Some(()) };
    for (_, value) in criteria.iter_mut() {
        let one = match value.get_ref() {
            DeValue::Array(all) => match all.iter().collect::<Vec<_>>().as_slice() {
                [one] => (*one).clone(),
                _ => return None,
            },
            _ => value.clone(),
        };
        let limit = match one.get_ref() {
            DeValue::Table(entries) => {
                let of_it = |named: &Spanned<DeValue>| named.get_ref().as_str() == Some(place);
                let known = |key: &str| ["limit", "place"].contains(&key);
                let fits = entries.get("place").is_none_or(of_it)
                    && entries.iter().all(|(key, _)| known(key.get_ref()));
                entries.get("limit").filter(|_| fits)?.clone()
            }
            _ => one,
        };
        *value = limit;
    }
    Some(())
}
