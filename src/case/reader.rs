//! Reads the tables of a case file as their schema says: every value checked once, every problem kept
//! with its place. What is in order becomes the struct that the schema was derived from.

use std::borrow::Cow;
use std::ops::Range;

use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::Problem;
use super::inputs::Input;
use super::schema::{SCHEMA, of_table};
use super::value::nearest;
use super::{Design, Recording};

/// Problems that are told one by one: more than a case has keys.
const MOST_PROBLEMS: usize = 100;

/// What other programs, or structures of one mode, have in place of a key: the table, the word, the key, and what it is.
const OTHERWISE: [(&str, &str, &str, &str); 11] = [
    ("mode", "damping", "damping_ratio", "which is damping / (2 sqrt(stiffness mass))"),
    ("mode", "stiffness", "frequency", "the natural one: sqrt(stiffness / mass) / (2 pi)"),
    ("mode", "modal_mass", "mass", "the modal mass by the scale of the shape"),
    ("mode", "shapes", "shape", "the displacement at each place where the modal coordinate is 1"),
    ("absorber", "mass_ratio", "mass", "for there are several masses that it could be over"),
    ("absorber", "gap", "clearance", "which is from the middle to either wall: half of the gap"),
    ("", "load", "excitation", "with `kind` and `amplitude`"),
    ("", "loads", "excitation", "with `kind` and `amplitude`"),
    ("", "force", "excitation", "with kind = \"force\" and `amplitude`"),
    ("", "limits", "criteria", "with a key for each limit"),
    ("", "structure", "mode", "with frequency, damping_ratio, mass and shape"),
];

/// The text being read, with what was found wrong and what was read so far.
pub(super) struct Reader<'t> {
    pub text: &'t str,
    pub problems: Vec<Problem>,
    /// What is probably a slip.
    pub warnings: Vec<Problem>,
    /// How many were found after [`MOST_PROBLEMS`].
    pub more: usize,
    pub inputs: Vec<Input>,
    /// The design, once it is read: it decides the units of the optional tables.
    pub design: Option<Design>,
    /// Whether quantities are plain numbers, as beside [[reduced.mode]].
    pub plain: bool,
    /// Of a structure of several modes whether its swept load moves the base: it decides the units of axes.
    pub of_several: Option<bool>,
    /// What drives the design, where that is a record.
    pub recording: Option<Recording>,
    /// By how much the absorber's place moves of a structure that is written as a mode; else 1.
    pub shape: f64,
}

impl<'t> Reader<'t> {
    /// One that has read nothing.
    pub fn of(text: &'t str) -> Self {
        let (problems, inputs) = (Vec::new(), Vec::new());
        Self {
            text,
            problems,
            warnings: Vec::new(),
            more: 0,
            inputs,
            design: None,
            plain: false,
            of_several: None,
            recording: None,
            shape: 1.0,
        }
    }

    /// The bytes of the first line, to point at when there is nothing better.
    pub fn first_line(&self) -> usize {
        self.text.lines().next().map_or(0, str::len)
    }

    /// The line, from 1, in which a byte stands.
    pub fn line_of(&self, at: usize) -> usize {
        1 + self.text[..at].matches('\n').count()
    }

    /// Records a problem.
    pub fn report(
        &mut self,
        span: Range<usize>,
        message: impl Into<String>,
        expected: impl Into<String>,
        help: impl Into<String>,
    ) {
        self.keep(|text| Problem::new(text, span, message, expected).help(help));
    }

    /// Records what is probably a slip.
    pub fn warn(
        &mut self,
        span: Range<usize>,
        message: impl Into<String>,
        label: impl Into<String>,
        help: impl Into<String>,
    ) {
        let warning = Problem::new(self.text, span, message, label).help(help);
        self.warnings.push(warning.into_warning());
    }

    /// Keeps a problem, or counts it where there are enough: to say where each of thousands is would take seconds.
    pub fn keep(&mut self, problem: impl FnOnce(&str) -> Problem) {
        if self.problems.len() < MOST_PROBLEMS {
            self.problems.push(problem(self.text));
        } else {
            self.more += 1;
        }
    }

    /// The bytes of a value as its author wrote it, without the quotes.
    pub fn as_written(&self, span: Range<usize>) -> String {
        self.text[span].trim_matches(['"', '\'']).to_owned()
    }

    /// Opens the top level, which has keys and tables, reporting every unknown one in it.
    pub fn root<'d, Keys: DeserializeOwned + JsonSchema, Tables: DeserializeOwned>(
        &mut self,
        entries: &'d DeTable<'d>,
    ) -> Table<'d> {
        self.root_of::<Keys>(entries, fields::<Tables>())
    }

    /// The same with tables of these names.
    pub fn root_of<'d, Keys: DeserializeOwned + JsonSchema>(
        &mut self,
        entries: &'d DeTable<'d>,
        tables: &[&'static str],
    ) -> Table<'d> {
        let keys = [fields::<Keys>(), tables].concat();
        self.open(String::new(), of_table::<Keys>(), keys, 0..self.first_line(), entries)
    }

    /// Opens one of a list of tables.
    pub fn listed<'d, T: DeserializeOwned + JsonSchema>(
        &mut self,
        name: &str,
        span: Range<usize>,
        entries: &'d DeTable<'d>,
    ) -> Table<'d> {
        self.open(name.to_owned(), of_table::<T>(), fields::<T>().to_vec(), span, entries)
    }

    /// Opens a table, reporting every unknown key in it; `None` when there is no such table. It is read by its
    /// parent's schema, which may say more of it, if that knows it, else by its own.
    pub fn table<'d, T: DeserializeOwned + JsonSchema>(
        &mut self,
        parent: &Table<'d>,
        name: &str,
    ) -> Option<Table<'d>> {
        let (key, value) = parent.entries.get_key_value(name)?;
        let path = match parent.path.as_str() {
            "" => name.to_owned(),
            parent => format!("{parent}.{name}"),
        };
        if let DeValue::Table(entries) = value.get_ref() {
            let schema = parent.schema["properties"].get(name).unwrap_or_else(of_table::<T>);
            return Some(self.open(path, schema, fields::<T>().to_vec(), key.span(), entries));
        }
        let message = format!("`{name}` is {}, but it must be a table", kind(value.get_ref()));
        let help = format!("write [{path}] on a line of its own and the table's keys below it");
        self.report(key.span(), message, format!("expected the table [{path}]"), help);
        None
    }

    fn open<'d>(
        &mut self,
        path: String,
        schema: &'static Value,
        mut keys: Vec<&'static str>,
        span: Range<usize>,
        entries: &'d DeTable<'d>,
    ) -> Table<'d> {
        keys.extend(schema["x-keys"].as_array().into_iter().flatten().filter_map(Value::as_str));
        let mut table = Table { path, schema, keys, entries, span, misspelled: Vec::new() };
        let known = |key: &str| table.keys.contains(&key);
        let unknown = entries.iter().filter(|(key, _)| !known(key.get_ref()));
        let guesses: Vec<_> =
            unknown.filter_map(|(key, value)| self.unknown_key(&table, key, value)).collect();
        table.misspelled = guesses;
        table
    }

    fn unknown_key(
        &mut self,
        table: &Table,
        key: &Spanned<Cow<'_, str>>,
        value: &Spanned<DeValue>,
    ) -> Option<&'static str> {
        let written = key.get_ref().as_ref();
        let homes = homes_of(written);
        let otherwise = OTHERWISE.iter().find(|(path, other, own, _)| {
            (*path, *other) == (&table.path, written) && table.keys.contains(own)
        });
        let guess = if let Some((_, _, own, _)) = otherwise {
            Some(*own)
        } else if homes.is_empty() {
            nearest(written, &table.keys)
        } else {
            None
        };
        let what = if value.get_ref().is_table() { "table" } else { "key" };
        let expected = format!("expected one of {}", table.keys.join(", "));
        let help = match guess {
            Some(guess) if otherwise.is_some() => {
                let what = otherwise.map_or("", |(.., what)| what);
                format!("write `{guess}` instead, {what}")
            }
            Some(guess) => format!("did you mean `{guess}`?"),
            None if homes.contains(&format!("[{}]", table.path)) => {
                format!(
                    "remove `{written}`: it is read where a structure has one mode and one absorber"
                )
            }
            None if !homes.is_empty() => format!("`{written}` belongs in {}", homes.join(" or ")),
            None => format!("remove `{written}`, or write one of the keys named above"),
        };
        let message = format!("unknown {what} `{written}`{}", table.place());
        self.report(key.span(), message, expected, help);
        guess
    }

    /// Reads a table that may be missing.
    pub fn optional<'d, T: DeserializeOwned + JsonSchema>(
        &mut self,
        root: &Table<'d>,
        name: &str,
    ) -> Option<(Table<'d>, T)> {
        let table = self.table::<T>(root, name)?;
        let read = self.read(&table)?;
        Some((table, read))
    }

    /// The same without its places.
    pub fn settings<T: DeserializeOwned + JsonSchema>(
        &mut self,
        root: &Table,
        name: &str,
    ) -> Option<T> {
        self.optional(root, name).map(|(_, read)| read)
    }

    /// Reads the values of a table, but for those that are tables themselves; quantities become numbers
    /// in SI units. `None` where something that must be there is not, or not as it should be.
    pub fn read<T: DeserializeOwned>(&mut self, table: &Table) -> Option<T> {
        let values = self.values(table);
        serde_json::from_value(Value::Object(values)).ok()
    }

    /// The same before they become a struct: those that are as they should be.
    pub fn values(&mut self, table: &Table) -> Map<String, Value> {
        for group in table.groups() {
            self.exactly_one(table, &group);
        }
        let mut found = Map::new();
        for key in table.keys.iter().copied() {
            let Some(value) = table.value(key) else { continue };
            if let Some(chosen) = table.is_of_another_branch(key) {
                let message = format!("`{key}` has no meaning{} with {chosen}", table.place());
                let expected = format!("expected only keys that go with {chosen}");
                self.report(
                    table.span_of(key),
                    message,
                    expected,
                    format!("remove `{key}`, or write another kind"),
                );
                continue;
            }
            let read = self.item(self.place(table, key, value), table.schema_of(key));
            found.extend(read.map(|read| (key.to_owned(), read)));
        }
        found
    }

    /// Reports that there is none of some keys, or more than one.
    fn exactly_one(&mut self, table: &Table, group: &[&str]) {
        let there = || group.iter().filter(|key| table.has(key));
        let what: Vec<String> = group.iter().map(|key| format!("`{key}`")).collect();
        if there().count() == 0 {
            let (what, place) = (what.join(" or "), table.place());
            let within = if place.is_empty() { "before the first table" } else { "in this table" };
            let lines: Vec<String> = group.iter().map(|key| self.line(table, key)).collect();
            let help = format!("add the line {}", lines.join("  or  "));
            let message = format!("{what} is missing{place}");
            self.report(table.span.clone(), message, format!("expected {what} {within}"), help);
        } else if there().count() > 1 {
            let later = there().map(|key| table.span_of(key)).max_by_key(|span| span.start);
            let message = format!("{} say the same thing twice", what.join(" and "));
            let expected = "expected only one of the two";
            let help = "remove one of the two lines";
            self.report(later.unwrap_or_default(), message, expected, help);
        }
    }
}

/// One table of the file.
pub(super) struct Table<'t> {
    /// As its author has to write it, `band` or `sweep.clearance`; empty for the top level.
    pub path: String,
    pub schema: &'static Value,
    /// Every key that it may have, in the order in which they are documented.
    pub keys: Vec<&'static str>,
    pub entries: &'t DeTable<'t>,
    pub span: Range<usize>,
    /// Keys whose misspelling was reported, and which are therefore not reported missing.
    pub misspelled: Vec<&'static str>,
}

impl<'t> Table<'t> {
    /// The value of a key.
    pub fn value(&self, key: &str) -> Option<&'t Spanned<DeValue<'t>>> {
        self.entries.get(key)
    }

    /// Whether the key is there, or a misspelling of it.
    pub fn has(&self, key: &str) -> bool {
        self.entries.contains_key(key) || self.misspelled.contains(&key)
    }

    /// Where a key stands, or else the table's name.
    pub fn span_of(&self, key: &str) -> Range<usize> {
        self.entries.get_key_value(key).map_or(self.span.clone(), |(key, _)| key.span())
    }

    /// Where a key's value stands, or else the table's name.
    pub fn span_of_value(&self, key: &str) -> Range<usize> {
        self.value(key).map_or(self.span.clone(), Spanned::span)
    }

    /// " in [band]"; nothing for the top level.
    pub fn place(&self) -> String {
        if self.path.is_empty() { String::new() } else { format!(" in [{}]", self.path) }
    }

    /// What the schema says about a key, which may depend on what another one holds: the amplitude on the
    /// kind of excitation.
    pub fn schema_of(&self, key: &str) -> &'static Value {
        let own = self.branch().and_then(|branch| branch["properties"].get(key));
        let own = own.filter(|own| own.is_object() && own["const"].is_null());
        own.unwrap_or(&self.schema["properties"][key])
    }

    /// What the schema says beside what one of the keys holds.
    fn branch(&self) -> Option<&'static Value> {
        let says = |(key, schema): (&String, &Value)| {
            let default = self.schema["properties"][key]["default"].as_str();
            let written = self.value(key).map_or(default, |value| value.get_ref().as_str());
            schema["const"].as_str().is_some_and(|name| Some(name) == written)
        };
        let keys = |branch: &&'static Value| {
            let keys = branch["properties"].as_object().into_iter().flatten();
            keys.filter(|(_, schema)| schema["const"].is_string())
        };
        let mut branches = list(&self.schema["oneOf"]).filter(|branch| keys(branch).any(says));
        let whole = branches.clone().find(|branch| keys(branch).all(says));
        whole.or_else(|| branches.next())
    }

    /// What was chosen, `kind = "free"`, where a key goes with other choices only.
    fn is_of_another_branch(&self, key: &str) -> Option<String> {
        let branch = self.branch()?["properties"].as_object()?;
        let known = |branch: &Value| branch["properties"].get(key).is_some();
        if branch.contains_key(key) || !list(&self.schema["oneOf"]).any(known) {
            return None;
        }
        let (chosen, value) = branch.iter().find(|(_, schema)| !schema["const"].is_null())?;
        Some(format!("{chosen} = {}", value["const"]))
    }

    /// Keys of which exactly one must be there: those that are required, and pairs of alternatives.
    pub fn groups(&self) -> impl Iterator<Item = Vec<&'static str>> + use<> {
        let branch = self.branch();
        let all = std::iter::once(self.schema).chain(branch);
        let required = all.flat_map(|schema| list(&schema["required"]));
        let required = required.filter_map(Value::as_str).map(|one| vec![one]);
        let groups = list(&self.schema["allOf"]).chain([self.schema]).chain(branch);
        let pairs = groups.filter_map(|group| {
            // Nothing but the one key.
            let key = |branch: &'static Value| {
                branch["required"][0]
                    .as_str()
                    .filter(|_| branch.as_object().map(Map::len) == Some(1))
            };
            list(&group["oneOf"]).map(key).collect::<Option<Vec<_>>>()
        });
        required.chain(pairs.filter(|pair| pair.len() == 2))
    }
}

fn list(value: &'static Value) -> impl Iterator<Item = &'static Value> + Clone {
    value.as_array().into_iter().flatten()
}

/// What a TOML value is, with its article.
pub(super) fn kind(value: &DeValue) -> &'static str {
    match value {
        DeValue::String(_) => "text",
        DeValue::Integer(_) | DeValue::Float(_) => "a number",
        DeValue::Boolean(_) => "true or false",
        DeValue::Datetime(_) => "a date or time",
        DeValue::Array(_) => "a list",
        DeValue::Table(_) => "a table",
    }
}

/// The tables that a key belongs in.
fn homes_of(key: &str) -> Vec<String> {
    let root = &SCHEMA["properties"];
    let mut homes = Vec::new();
    if root.get(key).is_some() {
        homes.push("the lines before the first table".to_owned());
    }
    for name in fields::<super::Tables>() {
        let keys = &root[name]["properties"];
        if keys.get(key).is_some() {
            homes.push(format!("[{name}]"));
        }
        let nested = keys.as_object().into_iter().flatten();
        if nested.into_iter().any(|(_, table)| table["properties"].get(key).is_some()) {
            homes.push(format!("an axis of [{name}]"));
        }
    }
    homes
}

/// The keys of a table in the order in which its struct declares them.
pub(super) fn fields<T: DeserializeOwned>() -> &'static [&'static str] {
    let mut keys: &[&str] = &[];
    // It ends with an error as soon as it has the keys.
    let _ = T::deserialize(Fields(&mut keys));
    keys
}

struct Fields<'k>(&'k mut &'static [&'static str]);

impl<'de> serde::Deserializer<'de> for Fields<'_> {
    type Error = serde::de::value::Error;

    fn deserialize_any<V: serde::de::Visitor<'de>>(self, _: V) -> Result<V::Value, Self::Error> {
        Err(serde::de::Error::custom("only a struct has keys"))
    }

    fn deserialize_struct<V: serde::de::Visitor<'de>>(
        self,
        _: &'static str,
        keys: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Self::Error> {
        *self.0 = keys;
        self.deserialize_any(visitor)
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 u8 u16 u32 u64 f32 f64 char str string bytes byte_buf option unit
        unit_struct newtype_struct seq tuple tuple_struct map enum identifier ignored_any
    }
}
