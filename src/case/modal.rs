//! A case of several modes and absorbers: `[[mode]]`, `[[absorber]]` and `[excitation]`, or `[[excitation]]` where several
//! may act, one at a time.

use std::ops::Range;

use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::{Value, json};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::CaseError;
use super::number::{Form, sign_of};
use super::reader::{Reader, Table, fields, kind};
use super::settings::SimulationSettings;
use super::value::{ValuePlace, nearest, or};
use super::{Heading, document};
use crate::digest::sha256;
use crate::quantity::Dimension;
use crate::system::{
    InvalidModalSystem, LARGEST_DAMPING_RATIO, MOST_MODES, ModalAbsorber, ModalParameters,
    ModalSystem, Mode,
};
use vinesink_core::names;

/// A structure of several modes with absorbers, what drives it and what is asked of it, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalCase {
    /// What the case is, in a line.
    pub title: String,
    /// Where its numbers come from.
    pub source: String,
    /// SHA-256 of the file's text, in hexadecimal.
    pub text_hash: String,
    /// Names of the places that shapes are given at, in the order of the file.
    pub places: Vec<String>,
    /// The modes; the first is that which frequencies are over.
    pub modes: Vec<StructuralMode>,
    /// The absorbers.
    pub absorbers: Vec<PlacedAbsorber>,
    /// What may drive it, one at a time.
    pub loads: Vec<Load>,
    /// Limits of the displacement.
    pub criteria: Vec<PlaceCriterion>,
    /// Starts at each frequency, that from rest among them.
    pub starts: u32,
}

/// A mode of a structure.
#[derive(Debug, Clone, PartialEq)]
pub struct StructuralMode {
    /// Natural frequency in Hz.
    pub frequency_hz: f64,
    /// Damping ratio.
    pub damping_ratio: f64,
    /// Modal mass in kg, by the scale of the shape.
    pub mass_kg: f64,
    /// Displacement at each place where the modal coordinate is 1.
    pub shape: Vec<f64>,
    /// Participation in the motion of the base.
    pub participation: f64,
}

/// An absorber at a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlacedAbsorber {
    /// Which place.
    pub place: usize,
    /// Mass in kg.
    pub mass_kg: f64,
    /// Free distance to either wall in m.
    pub clearance_m: f64,
    /// Coefficient of restitution.
    pub restitution: f64,
}

/// What a harmonic excitation acts on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ActsOn {
    /// A force at a place.
    Place(usize),
    /// A force in one mode alone.
    Mode(usize),
    /// The base moves.
    Base,
}

/// A harmonic excitation over a range of frequencies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Load {
    /// What it acts on.
    pub on: ActsOn,
    /// Amplitude in N, or in m of the base.
    pub amplitude: f64,
    /// Frequencies in Hz, ascending; the same twice where there is one.
    pub range_hz: [f64; 2],
}

impl Load {
    /// The natural frequency of a mode in its range, of that which it acts on if it acts on one, in Hz; the middle of the range
    /// where there is none.
    pub fn centre(&self, case: &ModalCase) -> f64 {
        let [from, to] = self.range_hz;
        let modes = case.modes.iter().enumerate();
        let acts = |k: usize| !matches!(self.on, ActsOn::Mode(mode) if mode != k);
        let mut within =
            modes.filter(|(k, mode)| acts(*k) && (from..=to).contains(&mode.frequency_hz));
        within.next().map_or(0.5 * (from + to), |(_, mode)| mode.frequency_hz)
    }
}

/// A limit of the peak displacement at a place, or at the worst one.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaceCriterion {
    /// Which place; none: every one.
    pub place: Option<usize>,
    /// In m.
    pub limit: f64,
    /// As its author wrote it.
    pub as_written: String,
}

/// A mode of the structure.
#[derive(Deserialize, JsonSchema)]
#[schemars(extend("additionalProperties" = false))]
struct ModeTable {
    /// f_k, its natural frequency, above 0.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0), example = "1.1 Hz")]
    frequency: f64,
    /// zeta_k, its damping ratio, from 0 to 0.85.
    #[schemars(extend("x-measurand" = "a share", "minimum" = 0, "maximum" = LARGEST_DAMPING_RATIO), example = 0.005, example = "0.5 %")]
    damping_ratio: f64,
    /// M_k, its modal mass by the scale of the shape, above 0.
    #[schemars(extend("x-measurand" = "a mass", "exclusiveMinimum" = 0), example = "30 kg")]
    mass: f64,
    /// phi_k, its shape: the displacement at each place where the modal coordinate is 1.
    #[schemars(with = "Value", extend("type" = "object", "additionalProperties" = { "type": "number" }))]
    #[expect(dead_code, reason = "read by its own names")]
    #[serde(default)]
    shape: (),
    /// Gamma_k, its participation in the motion of the base; needed where the base moves.
    #[schemars(example = 1.3)]
    participation: Option<f64>,
}

/// An absorber of the structure.
#[derive(Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
struct ModalAbsorberTable {
    /// Where it is: a place of the shapes. May be left out where they have one.
    #[schemars(example = &"tip")]
    place: Option<String>,
    /// m_j, its mass, above 0.
    #[schemars(extend("x-measurand" = "a mass", "exclusiveMinimum" = 0), example = "3 kg")]
    mass: f64,
    /// b_j, the free distance from the middle to either wall, above 0.
    #[schemars(extend("x-measurand" = "a length", "exclusiveMinimum" = 0), example = "2.7 mm")]
    clearance: f64,
    /// r_j, the coefficient of restitution, from 0 to 1.
    #[schemars(range(min = 0, max = 1), example = 0.3)]
    restitution: f64,
}

names! { name:
    /// What moves the structure.
    #[derive(schemars::JsonSchema)]
    enum LoadKind {
        /// A force P sin(omega t), at a place or in one mode alone.
        Force = "force",
        /// The base moves by F sin(omega t).
        BaseDisplacement = "base-displacement",
    }
}

/// A harmonic excitation; of several `[[excitation]]` one acts at a time.
#[derive(Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields, extend("oneOf" = loads()))]
struct LoadTable {
    /// "force" or "base-displacement".
    kind: LoadKind,
    /// Where the force acts: a place of the shapes. May be left out where they have one.
    #[schemars(example = &"tip")]
    place: Option<String>,
    /// The mode in which alone the force acts, from 1, instead of a place.
    #[schemars(range(min = 1, max = 8), example = 2)]
    mode: Option<u64>,
    /// P, the amplitude of the force, or F, the displacement amplitude of the base; above 0.
    #[schemars(with = "String", example = "14 N")]
    amplitude: f64,
    /// f, its frequency, above 0; or give a range, `from` and `to`.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0), example = "6.9 Hz")]
    frequency: Option<f64>,
    /// Where its range of frequencies begins, above 0.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0), example = "6 Hz")]
    from: Option<f64>,
    /// Where it ends, above `from`.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0), example = "8 Hz")]
    to: Option<f64>,
}

/// How the amplitude of each kind is written.
fn loads() -> Value {
    let kind = |name: &str, measured: &str, example: &str| {
        let amplitude = json!({ "type": "number", "x-measurand": measured, "exclusiveMinimum": 0, "examples": [example] });
        let mut keys = json!({ "kind": { "const": name }, "amplitude": amplitude });
        for key in ["frequency", "from", "to"] {
            keys[key] = json!(true);
        }
        if name == LoadKind::Force.name() {
            (keys["place"], keys["mode"]) = (json!(true), json!(true));
        }
        json!({ "properties": keys })
    };
    json!([
        kind(LoadKind::Force.name(), "a force", "14 N"),
        kind(LoadKind::BaseDisplacement.name(), "a length", "0.25 mm"),
    ])
}

/// What the structure must achieve.
#[derive(Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
struct ModalCriteriaTable {
    /// Largest absolute displacement, at the worst place; of one place, or several, as a table or a list of tables
    /// with `limit` and `place`.
    #[schemars(with = "Value", example = &"<= 4 mm")]
    #[expect(dead_code, reason = "read as a text, a table or a list")]
    #[serde(default)]
    peak_displacement: (),
}

/// Tables of such a file.
#[derive(Deserialize, JsonSchema)]
#[expect(
    dead_code,
    reason = "each table is read by itself, so that one that is wrong hides no other"
)]
struct ModalTables {
    mode: Vec<ModeTable>,
    absorber: Vec<ModalAbsorberTable>,
    excitation: Vec<LoadTable>,
    simulation: Option<SimulationSettings>,
    criteria: Option<ModalCriteriaTable>,
}

/// A structure of several modes with absorbers, written as the tables mode, absorber and excitation, each once or as a list.
#[derive(JsonSchema)]
#[expect(dead_code, reason = "each table is read by itself")]
#[schemars(title = "vinesink case of several modes", deny_unknown_fields)]
pub(super) struct ModalFile {
    #[schemars(flatten)]
    heading: Heading,
    #[schemars(flatten)]
    tables: ModalTables,
}

/// Starts at each frequency unless given.
const STARTS: u32 = 6;

/// Whether a text is of several modes or absorbers: what does not parse is not.
pub fn is_modal(text: &str) -> bool {
    let Ok(document) = document::parse(text.strip_prefix('\u{feff}').unwrap_or(text)) else {
        return false;
    };
    tells_several(&document).is_some()
}

/// Where a document says that it is of several modes or absorbers.
pub(super) fn tells_several(document: &DeTable) -> Option<Range<usize>> {
    let listed = |name: &str, list: bool| {
        let (key, value) = document.get_key_value(name)?;
        (value.get_ref().is_array() || !list).then(|| key.span())
    };
    listed("mode", false).or_else(|| listed("absorber", true))
}

impl ModalCase {
    /// Reads a case from its text; `name`, usually the file's path, is for messages only.
    ///
    /// # Errors
    /// [`CaseError`] with everything that is wrong.
    pub fn parse(name: &str, text: &str) -> Result<Self, CaseError> {
        let visible = text.strip_prefix('\u{feff}').unwrap_or(text);
        let refused = |problems, more| CaseError::new(name, visible, problems, more);
        let document = document::parse(visible).map_err(|problems| refused(problems, 0))?;
        let mut reader = Reader::of(visible);
        match read(&mut reader, &document, sha256(text.as_bytes())) {
            Some(case) if reader.problems.is_empty() => Ok(case),
            _ => Err(refused(reader.problems, reader.more)),
        }
    }

    /// For each place the value of each mode's shape.
    pub fn shapes(&self) -> Vec<Vec<f64>> {
        let places = 0..self.places.len();
        places.map(|p| self.modes.iter().map(|mode| mode.shape[p]).collect()).collect()
    }

    /// Radians per unit of the dimensionless time: the first mode's natural frequency in rad/s.
    pub fn omega(&self) -> f64 {
        std::f64::consts::TAU * self.modes[0].frequency_hz
    }

    /// The structure with its absorbers under a load at a frequency in Hz: lengths in m, masses in kg, time `omega_1 t`. Shapes
    /// are those at the absorbers.
    ///
    /// # Errors
    /// [`InvalidModalSystem`] where the load has no steady motion.
    pub fn system(
        &self,
        load: &Load,
        frequency_hz: f64,
    ) -> Result<ModalSystem, InvalidModalSystem> {
        let first = self.modes[0].frequency_hz;
        let omega = self.omega();
        let modes = self.modes.iter().enumerate().map(|(k, mode)| {
            let force = match load.on {
                ActsOn::Place(place) => mode.shape[place] * load.amplitude,
                ActsOn::Mode(driven) if driven == k => load.amplitude,
                ActsOn::Mode(_) | ActsOn::Base => 0.0,
            };
            Mode {
                frequency: mode.frequency_hz / first,
                damping_ratio: mode.damping_ratio,
                mass: mode.mass_kg,
                forcing: force / (mode.mass_kg * omega * omega),
                participation: if load.on == ActsOn::Base { mode.participation } else { 0.0 },
                shape: self.absorbers.iter().map(|one| mode.shape[one.place]).collect(),
            }
        });
        let absorbers = self.absorbers.iter().map(|one| ModalAbsorber {
            mass: one.mass_kg,
            clearance: one.clearance_m,
            restitution: one.restitution,
        });
        let moves = if load.on == ActsOn::Base { load.amplitude } else { 0.0 };
        ModalSystem::new(ModalParameters {
            modes: modes.collect(),
            absorbers: absorbers.collect(),
            frequency_ratio: frequency_hz / first,
            base_amplitude: moves,
        })
    }
}

fn read(reader: &mut Reader, document: &DeTable, text_hash: String) -> Option<ModalCase> {
    let own = fields::<ModalTables>();
    let of_one: Vec<&str> =
        fields::<super::Tables>().iter().copied().filter(|name| !own.contains(name)).collect();
    let root = reader.root_of::<Heading>(document, &[own, &of_one].concat());
    for name in of_one.into_iter().filter(|name| root.has(name)) {
        let help = match name {
            "oscillator" | "reduced" => {
                "write the structure as [[mode]] with frequency, damping_ratio, mass and shape, or give one [absorber]"
            }
            "band" => "write `from` and `to` in [excitation] instead of `frequency`",
            _ => "remove the table: it is about a structure with one mode",
        };
        let message = format!("[{name}] has no meaning beside [[mode]] or [[absorber]]");
        let expected = format!("expected the tables {}", own.join(", "));
        reader.report(root.span_of(name), message, expected, help);
    }
    let heading = reader.read::<Heading>(&root);
    let mut places: Vec<String> = Vec::new();
    let mut modes = Vec::new();
    for table in tables::<ModeTable>(reader, &root, "mode") {
        modes.extend(read_mode(reader, &table, &mut places));
    }
    let shapes: Vec<_> = modes.iter().map(|(_, shape)| shape.clone()).collect();
    let modes: Vec<StructuralMode> = modes
        .into_iter()
        .map(|(mode, shape)| StructuralMode {
            shape: places.iter().map(|name| value_at(&shape, name)).collect(),
            ..mode
        })
        .collect();
    for (span, name) in missing(&shapes, &places) {
        let message = format!("the shape has no value at \"{name}\", where another mode has one");
        let help = format!("write shape = {{ {name} = 1.0, ... }}; 0 where the mode has a node");
        reader.report(span, message, "expected every place in the shape of every mode", help);
    }
    let mut absorbers = Vec::new();
    for table in tables::<ModalAbsorberTable>(reader, &root, "absorber") {
        let Some(read) = reader.read::<ModalAbsorberTable>(&table) else { continue };
        let place = find_place(reader, &table, read.place.as_deref(), &places);
        if let Some(place) = place
            && modes.iter().all(|mode| mode.shape[place] == 0.0)
        {
            let message = "the absorber is at a node of every mode, where nothing moves it";
            let expected = "expected a place at which a mode has a shape other than 0";
            reader.report(table.span_of("place"), message, expected, "name another place");
        }
        absorbers.extend(place.map(|place| PlacedAbsorber {
            place,
            mass_kg: read.mass,
            clearance_m: read.clearance,
            restitution: read.restitution,
        }));
    }
    let mut loads = Vec::new();
    for table in tables::<LoadTable>(reader, &root, "excitation") {
        loads.extend(read_load(reader, &table, &places, &modes));
    }
    let simulation = reader.settings::<SimulationSettings>(&root, "simulation");
    let criteria = read_criteria(reader, &root, &places);
    let heading = heading?;
    if !reader.problems.is_empty() {
        return None;
    }
    let starts = simulation.and_then(|one| u32::try_from(one.starts?).ok()).unwrap_or(STARTS);
    let case = ModalCase {
        title: heading.title,
        source: heading.source,
        text_hash,
        places,
        modes,
        absorbers,
        loads,
        criteria,
        starts,
    };
    for load in &case.loads {
        for frequency in load.range_hz {
            if let Err(error) = case.system(load, frequency) {
                let help = "check the values and their units";
                reader.report(
                    root.span_of("excitation"),
                    error.to_string(),
                    "expected values that fit one another",
                    help,
                );
                return None;
            }
        }
    }
    Some(case)
}

/// The tables of a name, once or as a list; reported where there is none, or more than a structure may have.
fn tables<'d, T: serde::de::DeserializeOwned + JsonSchema>(
    reader: &mut Reader,
    root: &Table<'d>,
    name: &'static str,
) -> Vec<Table<'d>> {
    let Some(value) = root.value(name) else {
        let message = format!("[[{name}]] is missing");
        let expected = format!("expected at least one table [[{name}]]");
        let help = format!("write [[{name}]] on a line of its own and its keys below it");
        reader.report(0..reader.first_line(), message, expected, help);
        return Vec::new();
    };
    let found: Vec<(Range<usize>, &'d DeTable<'d>)> = match value.get_ref() {
        DeValue::Table(one) => vec![(root.span_of(name), one)],
        DeValue::Array(all) => all
            .iter()
            .filter_map(|one| match one.get_ref() {
                DeValue::Table(table) => Some((one.span(), table)),
                _ => None,
            })
            .collect(),
        _ => Vec::new(),
    };
    if found.is_empty() || found.len() > MOST_MODES {
        let message = match found.len() {
            0 => format!("`{name}` is {}, but it must be a table", kind(value.get_ref())),
            many => format!("there are {many} of [[{name}]]"),
        };
        let expected = format!("expected 1 to {MOST_MODES} tables [[{name}]]");
        let help = "keep those that matter most; more are not computed";
        reader.report(root.span_of(name), message, expected, help);
        return Vec::new();
    }
    found.into_iter().map(|(span, entries)| reader.listed::<T>(name, span, entries)).collect()
}

type Shape = (Range<usize>, Vec<(String, f64)>);

fn value_at((_, shape): &Shape, name: &str) -> f64 {
    shape.iter().find(|(key, _)| key == name).map_or(0.0, |(_, value)| *value)
}

/// Places that a mode says nothing of.
fn missing(shapes: &[Shape], places: &[String]) -> Vec<(Range<usize>, String)> {
    let of = |shape: &Shape| {
        let span = shape.0.clone();
        let absent = places.iter().filter(|name| !shape.1.iter().any(|(key, _)| key == *name));
        absent.map(|name| (span.clone(), name.clone())).collect::<Vec<_>>()
    };
    shapes.iter().filter(|shape| !shape.1.is_empty()).flat_map(of).collect()
}

fn read_mode(
    reader: &mut Reader,
    table: &Table,
    places: &mut Vec<String>,
) -> Option<(StructuralMode, Shape)> {
    let read = reader.read::<ModeTable>(table);
    let help = "write shape = { tip = 1.0 }: a name and a number for each place";
    let expected = "expected the displacement at each place, as a table";
    let span = table.span_of("shape");
    let Some(DeValue::Table(entries)) = table.value("shape").map(Spanned::get_ref) else {
        if !table.misspelled.contains(&"shape") {
            reader.report(span, "a mode has no `shape`", expected, help);
        }
        return None;
    };
    let mut shape = Vec::new();
    for (name, value) in entries {
        let name = name.get_ref().as_ref();
        let place = ValuePlace {
            table: "mode",
            key: "shape",
            subject: format!("`{name}` of `shape`"),
            line: "shape = { tip = 1.0 }".to_owned(),
            value,
            sign: 0,
            alone: false,
        };
        let number = reader.number(&place, &Form::free(None, "1.0", ""))?;
        if !places.iter().any(|known| known == name) {
            places.push(name.to_owned());
        }
        shape.push((name.to_owned(), number));
    }
    if shape.iter().all(|(_, value)| *value == 0.0) {
        reader.report(span, "the shape of a mode is 0 everywhere", expected, help);
        return None;
    }
    let read = read?;
    let mode = StructuralMode {
        frequency_hz: read.frequency,
        damping_ratio: read.damping_ratio,
        mass_kg: read.mass,
        shape: Vec::new(),
        participation: read.participation.unwrap_or(f64::NAN),
    };
    Some((mode, (span, shape)))
}

/// The place of a name; the only one where none is given.
fn find_place(
    reader: &mut Reader,
    table: &Table,
    name: Option<&str>,
    places: &[String],
) -> Option<usize> {
    let known: Vec<&str> = places.iter().map(String::as_str).collect();
    let quoted: Vec<String> = places.iter().map(|name| format!("\"{name}\"")).collect();
    let message = match name {
        None if places.len() == 1 => return Some(0),
        None => "`place` is missing".to_owned(),
        Some(name) => match known.iter().position(|known| *known == name) {
            Some(found) => return Some(found),
            None => format!("`place` is \"{name}\", at which no mode has a shape"),
        },
    };
    if places.is_empty() {
        // Said of the modes.
        return None;
    }
    let help = match name.and_then(|name| nearest(name, &known)) {
        Some(near) => format!("did you mean \"{near}\"?"),
        None => format!("write place = {}", quoted[0]),
    };
    reader.report(table.span_of_value("place"), message, format!("expected {}", or(&quoted)), help);
    None
}

fn read_load(
    reader: &mut Reader,
    table: &Table,
    places: &[String],
    modes: &[StructuralMode],
) -> Option<Load> {
    let read = reader.read::<LoadTable>(table)?;
    let mut refused = |key: &str, message: String, expected: &str, help: &str| {
        reader.report(table.span_of_value(key), message, expected, help);
        None
    };
    let on = match (read.kind, read.mode, &read.place) {
        (LoadKind::BaseDisplacement, ..) => {
            if let Some(k) = modes.iter().position(|mode| mode.participation.is_nan()) {
                let message = format!("the base moves, and mode {} has no `participation`", k + 1);
                let help =
                    "write participation = 1.3, the mode's participation factor, in each [[mode]]";
                return refused("kind", message, "expected a participation of every mode", help);
            }
            ActsOn::Base
        }
        (_, Some(_), Some(_)) => {
            let message = "`mode` and `place` both say where the force acts".to_owned();
            return refused(
                "mode",
                message,
                "expected only one of the two",
                "remove one of the two lines",
            );
        }
        (_, Some(mode), None) if mode as usize > modes.len() => {
            let message = format!("`mode` is {mode}, and there are {}", modes.len());
            return refused(
                "mode",
                message,
                "expected one of the modes, from 1",
                "name another mode",
            );
        }
        (_, Some(mode), None) => ActsOn::Mode(mode as usize - 1),
        (..) => ActsOn::Place(find_place(reader, table, read.place.as_deref(), places)?),
    };
    let range_hz = match (read.frequency, read.from, read.to) {
        (Some(at), None, None) => [at; 2],
        (None, Some(from), Some(to)) if from < to => [from, to],
        (None, Some(_), Some(_)) => {
            let help = "swap `from` and `to`, or write a larger `to`";
            reader.report(
                table.span_of_value("to"),
                "the range ends where it begins, or before",
                "expected `to` above `from`",
                help,
            );
            return None;
        }
        _ => {
            let message = "the excitation has neither a frequency nor a whole range";
            let help = "write frequency = \"6.9 Hz\", or from = \"6 Hz\" and to = \"8 Hz\"";
            reader.report(
                table.span.clone(),
                message,
                "expected `frequency`, or `from` and `to`",
                help,
            );
            return None;
        }
    };
    Some(Load { on, amplitude: read.amplitude, range_hz })
}

/// Limits: a text, a table, or a list of tables.
fn read_criteria(reader: &mut Reader, root: &Table, places: &[String]) -> Vec<PlaceCriterion> {
    const KEY: &str = "peak_displacement";
    let Some(table) = reader.table::<ModalCriteriaTable>(root, "criteria") else {
        return Vec::new();
    };
    let Some(value) = table.value(KEY) else { return Vec::new() };
    let mut found = Vec::new();
    let each: Vec<&Spanned<DeValue>> = match value.get_ref() {
        DeValue::Array(all) => all.iter().collect(),
        _ => vec![value],
    };
    for one in each {
        let (limit, place) = match one.get_ref() {
            DeValue::Table(entries) => (entries.get("limit"), entries.get("place")),
            _ => (Some(one), None),
        };
        let place = match place {
            None => Some(None),
            Some(value) => {
                let name = value.get_ref().as_str().unwrap_or_default();
                let known: Vec<&str> = places.iter().map(String::as_str).collect();
                let at = known.iter().position(|known| *known == name);
                if at.is_none() {
                    let near = nearest(name, &known).or(known.first().copied()).unwrap_or("tip");
                    let message = format!("`place` is \"{name}\", at which no mode has a shape");
                    reader.report(
                        value.span(),
                        message,
                        "expected a place of the shapes",
                        format!("did you mean \"{near}\"?"),
                    );
                }
                at.map(Some)
            }
        };
        let text = limit.and_then(|value| Some((value, value.get_ref().as_str()?)));
        let sign = text.and_then(|(_, text)| sign_of(text, &["<=", "≤"]));
        let (Some((value, _)), Some(sign)) = (text, sign) else {
            let help = "write peak_displacement = \"<= 4 mm\", or { limit = \"<= 4 mm\", place = \"tip\" }";
            reader.report(
                one.span(),
                "a limit of `peak_displacement` is not written as one",
                "expected \"<=\" and a length, in quotes",
                help,
            );
            continue;
        };
        let place_of = ValuePlace {
            table: "criteria",
            key: KEY,
            subject: format!("`{KEY}`"),
            line: format!("{KEY} = \"<= 4 mm\""),
            value,
            sign,
            alone: false,
        };
        let form = Form::free(Some(Dimension::Length), "<= 4 mm", "");
        let as_written = reader.as_written(value.span());
        let limit = reader.number(&place_of, &form);
        found.extend(limit.zip(place).map(|(limit, place)| PlaceCriterion {
            place,
            limit,
            as_written,
        }));
    }
    found
}
