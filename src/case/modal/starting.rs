//! The text of a commented case of several modes to start from: of a uniform cantilever, or of the modes of a file.

use std::f64::consts::TAU;

use super::alike::alike;
use super::file::impossible;
use super::listing::most;
use super::table::{self, FileMode, ModesFile};
use super::universal::{self, Direction};
use super::{ModalCase, StructuralMode};
use crate::case::error::CaseError;
use crate::case::rewrite::{Rounding, in_unit_of};
use crate::case::starting::COMMENTS;
use crate::quantity::numbers::rounded_to;
use crate::system::MOST_MODES;

const STARTING_MODES: &str = include_str!("starting_modes.toml");

/// Of a uniform cantilever each frequency over the first, and the shape at half of its length where it is 1 at the tip. All modes have
/// a quarter of its mass as their modal mass.
const CANTILEVER: [[f64; 2]; MOST_MODES] = [
    [1.0, 0.340],
    [6.267, -0.714],
    [17.55, 0.020],
    [34.39, 0.707],
    [56.84, 0.001],
    [84.91, -0.707],
    [118.6, 0.0],
    [157.9, 0.707],
];
/// The first frequency in Hz and the modal mass in kg of the one that is written: a mast.
const FIRST: f64 = 1.1;
const MODAL_MASS: f64 = 30.0;
/// Damping ratio of its modes, and of those of a file that has none.
const DAMPING: f64 = 0.005;
/// The absorber's mass over that which its impacts see.
const MASS_RATIO: f64 = 0.08;
/// How fast the structure moves with the absorber, in m/s: of each frequency an amplitude of a plausible size.
const SPEED: f64 = 0.02;
/// Half of the range of frequencies about that of the mode which is driven.
const HALF_RANGE: f64 = 0.1;
/// The limit of the displacement over the clearance.
const LIMIT: f64 = 1.5;

/// The modes of a case to start from, and the first elastic one of them at the place where the absorber is.
#[derive(Debug, Clone, PartialEq)]
pub struct StartingModes {
    /// Their tables.
    tables: String,
    /// Where they come from.
    source: String,
    /// The name of the place.
    place: String,
    /// The number of the mode that is driven, from 1, as the case counts it.
    number: usize,
    /// Its natural frequency in Hz.
    frequency_hz: f64,
    /// Its damping ratio.
    damping_ratio: f64,
    /// Its mass in kg as it is met at the place.
    mass_kg: f64,
    /// The mass in kg that impacts see there.
    seen_kg: f64,
}

impl StartingModes {
    /// How many modes a case may have.
    pub const MOST: usize = MOST_MODES;

    /// That many of a uniform cantilever; none where a case has none or not so many.
    pub fn uniform(count: usize) -> Option<Self> {
        let all = CANTILEVER.get(..count).filter(|all| !all.is_empty())?;
        let mut tables = String::new();
        for (k, [ratio, middle]) in all.iter().enumerate() {
            let hertz = in_unit_of("1 Hz", ratio * FIRST, Rounding::Nearest);
            for (line, comment) in [
                ("[[mode]]".to_owned(), "one table for each mode, up to 8"),
                (format!("frequency = {hertz}"), "the natural one"),
                (format!("damping_ratio = \"{} %\"", 100.0 * DAMPING), ""),
                (
                    format!("mass = \"{MODAL_MASS} kg\""),
                    "the modal mass, by the scale of the shape",
                ),
                (
                    format!("shape = {{ tip = 1.0, middle = {middle:?} }}"),
                    "displacement at each place where the modal coordinate is 1",
                ),
            ] {
                tables += &commented(&line, if k == 0 { comment } else { "" });
            }
            tables += match k {
                0 => "# participation = 1.566       # of every mode, where the base moves\n\n",
                _ => "\n",
            };
        }
        let source = "constructed: a uniform cantilever of 120 kg, whose modal mass at the tip is a quarter in every mode; say here where \
                      each number comes from";
        let modes = all.iter().map(|[ratio, middle]| StructuralMode {
            frequency_hz: ratio * FIRST,
            damping_ratio: DAMPING,
            mass_kg: MODAL_MASS,
            shape: vec![1.0, *middle],
            participation: f64::NAN,
            forcing: 0.0,
        });
        let modes: Vec<StructuralMode> = modes.collect();
        Some(Self::of(&modes, 0, "tip", tables, source.to_owned()))
    }

    /// Those of a file that a case may have, up to [`MOST`](Self::MOST) in the order of the file; `name` is what the case beside it
    /// calls it. The absorber is where the first elastic mode moves most.
    ///
    /// # Errors
    /// [`CaseError`] with what is wrong with the file, or that no case can have any of its modes.
    pub fn of_file(file: &ModesFile, name: &str) -> Result<Self, CaseError> {
        let quoted = |text: &str| toml::Value::from(text).to_string();
        let is_universal = universal::is_universal(file.text());
        let (all, place, places, complex) = if is_universal {
            let at = most(&universal::read(file, &[])?);
            let direction = Direction::parse(&at);
            let found = universal::read(file, direction.as_slice())?;
            let places = commented(
                &format!("places = {{ tip = {} }}", quoted(&at)),
                "a name, a node and its direction; of the first mode the one that moves most",
            );
            (found.modes, None, places, !found.complex.is_empty())
        } else {
            let found = table::read(file, None)?;
            let places = "# places: every column that is none of the numbers; those that count alone by their names with\n\
                          # places = { tip = \"tip\" }\n";
            (found.modes, Some(found.places), places.to_owned(), false)
        };
        let kept = those_that_count(file, &all)?;
        let modes: Vec<StructuralMode> = kept.iter().map(|k| all[*k].mode.clone()).collect();
        // Of a Universal File the one place that was asked for.
        let shape = modes[0].shape.iter().enumerate();
        let at = shape.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())).map_or(0, |(at, _)| at);
        let place = place.and_then(|mut all| (at < all.len()).then(|| all.swap_remove(at)));
        let place = place.unwrap_or_else(|| "tip".to_owned());
        let numbers: Vec<String> = kept.iter().map(|k| (k + 1).to_string()).collect();
        let numbers = format!("numbers = [{}]", numbers.join(", "));
        let is_all = kept.len() == all.len() && !complex;
        let undamped = modes.iter().all(|mode| mode.damping_ratio == 0.0);
        let damping = format!("damping_ratio = \"{} %\"", 100.0 * DAMPING);
        let written = |line: &str, is_comment: bool, comment: &str| {
            commented(&format!("{}{line}", if is_comment { "# " } else { "" }), comment)
        };
        let tables = [
            commented("[modes]", "modes in a file, instead of tables [[mode]]"),
            commented(&format!("file = {}", quoted(name)), "below the folder of the case"),
            places,
            written(&numbers, is_all, "which modes of the file, from 1; all unless given"),
            written("mass = \"1 kg\"", true, "of every mode instead of the file's"),
            match undamped {
                true => written(&damping, false, "of every mode: the file has none; say yours"),
                false => written(&damping, true, "of every mode instead of the file's"),
            },
        ];
        let source = format!(
            "modes from {name}; absorber, load and limit are constructed: say here where each number comes from"
        );
        Ok(Self::of(&modes, at, &place, tables.concat(), source))
    }

    fn of(
        modes: &[StructuralMode],
        at: usize,
        place: &str,
        tables: String,
        source: String,
    ) -> Self {
        let met = |mode: &StructuralMode| mode.mass_kg / (mode.shape[at] * mode.shape[at]);
        let first = &modes[0];
        let undamped = modes.iter().all(|mode| mode.damping_ratio == 0.0);
        Self {
            tables,
            source,
            place: place.to_owned(),
            number: 1,
            frequency_hz: first.frequency_hz,
            damping_ratio: if undamped { DAMPING } else { first.damping_ratio },
            mass_kg: met(first),
            seen_kg: 1.0 / modes.iter().map(|mode| 1.0 / met(mode)).sum::<f64>(),
        }
    }

    /// The damping ratio of the mode that is driven, and the absorber's mass over that of this mode alone.
    pub fn resists(&self) -> [f64; 2] {
        [self.damping_ratio, self.absorber_kg() / self.mass_kg]
    }

    fn absorber_kg(&self) -> f64 {
        rounded_to(MASS_RATIO * self.seen_kg, 2)
    }
}

/// The modes of a file that a case may have, by their numbers from 0: without those that a case cannot have, and the second where one
/// stands twice.
fn those_that_count(file: &ModesFile, all: &[FileMode]) -> Result<Vec<usize>, CaseError> {
    let wrong = |k: usize| {
        let FileMode { mode, .. } = &all[k];
        let missing = mode.shape.iter().any(|value| value.is_nan());
        impossible(mode)
            .map(|(wrong, _)| wrong)
            .or_else(|| missing.then(|| "has no value at the node that moves most".to_owned()))
    };
    let shapes: Vec<(f64, &[f64])> =
        all.iter().map(|one| (one.mode.frequency_hz, one.whole.as_slice())).collect();
    let twice: Vec<usize> =
        alike(&shapes).into_iter().filter(|pair| pair.equal).map(|pair| pair.second).collect();
    let counts = |k: &usize| !twice.contains(k) && wrong(*k).is_none();
    let kept: Vec<usize> = (0..all.len()).filter(counts).take(MOST_MODES).collect();
    if kept.is_empty() {
        let wrong = (0..all.len()).find_map(|k| Some(format!("mode {} {}", k + 1, wrong(k)?)));
        let message = format!("no case can have any of its modes: {}", wrong.unwrap_or_default());
        let help = "export elastic modes with their modal masses; `vinesink modes` lists what the file has";
        return Err(CaseError::of_file(&file.name, message, help));
    }
    Ok(kept)
}

/// A line with a comment in its column.
fn commented(line: &str, comment: &str) -> String {
    match comment {
        "" => format!("{line}\n"),
        comment => format!("{line:width$} # {comment}\n", width = COMMENTS - 1),
    }
}

/// A line of the template with its values; the comment behind one stays in its column. One pass, for a value may be anything.
fn filled(line: &str, values: &[(&str, String)]) -> String {
    let fill = |text: &str| {
        let mut filled = String::new();
        let is_letter = |letter: char| letter.is_ascii_uppercase();
        let mut rest = text;
        while let Some(begin) = rest.find(is_letter) {
            let end = rest[begin..].find(|letter| !is_letter(letter));
            let end = end.map_or(rest.len(), |end| begin + end);
            let word = &rest[begin..end];
            let value =
                values.iter().find(|(key, _)| *key == word).map(|(_, value)| value.as_str());
            filled += &rest[..begin];
            filled += value.unwrap_or(word);
            rest = &rest[end..];
        }
        filled + rest
    };
    match line.split_once(" # ").filter(|_| !line.starts_with('#')) {
        Some((value, comment)) => {
            commented(&fill(value.trim_end()), &fill(comment)).trim_end().to_owned()
        }
        None => fill(line),
    }
}

/// A value in the unit in which it is short: the last of which it is at least one, else the first.
fn short(value: f64, units: &[&str]) -> String {
    let written = |unit: &&str| in_unit_of(&format!("1 {unit}"), value, Rounding::Nearest);
    let number = |text: &String| {
        let digits = text.trim_matches('"').split(' ').next()?;
        digits.parse::<f64>().ok().filter(|number| *number >= 1.0)
    };
    let mut all = units.iter().rev().map(written);
    let first = all.clone().find(|text| number(text).is_some());
    first.or(all.next_back()).unwrap_or_default()
}

impl ModalCase {
    /// The text of a commented case of several modes to start from, with the given title. `resistance` is what resists the mode that
    /// is driven at resonance, over its stiffness and displacement: by its damping and an absorber that follows, see
    /// [`StartingModes::resists`].
    pub fn starting_text(title: &str, modes: &StartingModes, resistance: f64) -> String {
        let quoted = |text: &str| toml::Value::from(text).to_string();
        let hertz = modes.frequency_hz;
        let clearance = rounded_to(SPEED / (TAU * hertz), 2);
        let stiffness = modes.mass_kg * (TAU * hertz) * (TAU * hertz);
        let force = rounded_to(stiffness * clearance * resistance, 2);
        let at = |factor: f64| in_unit_of("1 Hz", factor * hertz, Rounding::Nearest);
        const LENGTHS: [&str; 3] = ["um", "mm", "m"];
        let values = [
            ("TITLE", quoted(title)),
            ("SOURCE", quoted(&modes.source)),
            ("PLACE", quoted(&modes.place)),
            ("ABSORBER", short(modes.absorber_kg(), &["mg", "g", "kg", "t"])),
            ("CLEARANCE", short(clearance, &LENGTHS)),
            ("MODE", modes.number.to_string()),
            ("FORCE", short(force, &["mN", "N", "kN", "MN"])),
            ("FROM", at(1.0 - HALF_RANGE)),
            ("TO", at(1.0 + HALF_RANGE)),
            ("NATURAL", at(1.0)),
            ("LIMIT", short(LIMIT * clearance, &LENGTHS).replacen('"', "\"<= ", 1)),
        ];
        let mut text = String::new();
        for line in STARTING_MODES.lines() {
            if line == "MODES" {
                text += modes.tables.trim_end();
                text.push('\n');
                continue;
            }
            text += &filled(line, &values);
            text.push('\n');
        }
        text
    }
}
