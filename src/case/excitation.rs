//! What drives the oscillator or sets it in motion, by its kind: in `[excitation]`, and without units in `[reduced]`.

use schemars::{JsonSchema, Schema};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::reader::{Reader, Table, fields};
use super::record;
use super::schema::{add_key, one_of, schema_of};
use crate::excitation::{RecordQuantity, Release, SineSweep, SweepRate, Transient};
use crate::quantity::Dimension;
use crate::system::Excitation;
use vinesink_core::names;

names! { name:
    /// How the oscillator is set in motion.
    #[derive(Default, Serialize)]
    #[derive(schemars::JsonSchema)]
    pub(super) enum ExcitationKind {
        /// The base moves by F sin(omega t).
        #[default]
        BaseDisplacement = "base-displacement",
        /// A force P sin(omega t) acts on the oscillator.
        Force = "force",
        /// The oscillator is let go, and nothing drives it.
        Free = "free",
        /// A shock: a force too short to be followed, or a sudden velocity of the base.
        Impulse = "impulse",
        /// The frequency of a harmonic excitation goes evenly through a range.
        SineSweep = "sine-sweep",
        /// A record of the base's motion or of a force, or noise of a given spectrum.
        Record = "record",
    }
}

names! { name:
    /// What becomes of a gap in a record.
    #[derive(Serialize, schemars::JsonSchema)]
    pub(super) enum Gaps {
        /// The record is refused.
        Refuse = "refuse",
        /// It is a straight line.
        Linear = "linear",
    }
}

// What `x-reduced` says of a key holds in `[reduced]` instead.
/// What drives the oscillator, or sets it in motion.
#[derive(Default, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields, extend("oneOf" = keys_by_kind(false)))]
pub(super) struct ExcitationTable {
    /// "base-displacement" shakes the base, "force" pushes the oscillator; "free" lets it go, "impulse" strikes it;
    /// "sine-sweep" goes through a range of frequencies; "record" drives it as a file or a spectrum says.
    pub(super) kind: ExcitationKind,
    /// F, the displacement amplitude of the base, or P, the amplitude of the force; 0 or more.
    #[schemars(with = "Option<String>", example = "0.25 mm")]
    pub(super) amplitude: Option<f64>,
    /// f, the excitation frequency, above 0.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0, "x-symbol" = "f"))]
    pub(super) frequency: Option<f64>,
    /// What is swept: "base-displacement" or "force".
    pub(super) of: Option<Excitation>,
    /// Frequency at which a sweep begins, from rest, above 0; with one above `to` it goes down.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0, "x-symbol" = "f_1"), example = "7.5 Hz")]
    #[schemars(extend("x-reduced" = plain(0.9, r"\Omega_1", "Frequency ratio at which a sweep begins, from rest, above 0; \
        with one above `to` it goes down.")))]
    pub(super) from: Option<f64>,
    /// Frequency at which it ends, above 0.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0, "x-symbol" = "f_2"), example = "9 Hz")]
    #[schemars(extend("x-reduced" = plain(1.1, r"\Omega_2", "Frequency ratio at which it ends, above 0.")))]
    pub(super) to: Option<f64>,
    /// How fast the frequency changes, above 0: by so many hertz or octaves in a time.
    #[schemars(extend("x-measurand" = "a sweep rate", "exclusiveMinimum" = 0, "x-symbol" = r"\dot{f}"), example = "0.1 Hz/s")]
    #[schemars(extend("x-reduced" = plain(0.0002, r"\dot{\Omega}", "Change of the frequency ratio in a fast time \
        tau = omega0 t, above 0.")))]
    pub(super) rate: Option<f64>,
    /// Displacement from which the oscillator is let go, its velocity, or both; 0 or more.
    #[schemars(extend("x-measurand" = "a length", "minimum" = 0, "x-symbol" = "x_0"), example = "5 mm")]
    #[schemars(extend("x-reduced" = plain(5.0, "x_0", "Displacement from which the oscillator is let go, in the unit of \
        the clearance, 0 or more.")))]
    pub(super) displacement: Option<f64>,
    /// Velocity of the oscillator when it is let go, or that which a shock gives the base; 0 or more.
    #[schemars(extend("x-measurand" = "a velocity", "minimum" = 0, "x-symbol" = r"\dot{x}_0"), example = "0.2 m/s")]
    #[schemars(extend("x-reduced" = plain(5.0, r"\dot{x}_0", "Velocity when it is let go, or that which a shock gives the \
        base, in that unit times omega0; 0 or more.")))]
    pub(super) velocity: Option<f64>,
    /// Impulse on the oscillator, above 0; or give the velocity of the base.
    #[schemars(extend("x-measurand" = "an impulse", "exclusiveMinimum" = 0, "x-symbol" = "J"), example = "2 N s")]
    #[schemars(extend("x-reduced" = plain(5.0, "J", "Impulse on the oscillator over m1 omega0, in that unit, above 0; or \
        give the velocity of the base.")))]
    pub(super) impulse: Option<f64>,
    /// What a record, or a spectrum, is of.
    #[schemars(example = "base-acceleration")]
    #[schemars(extend("x-reduced" = json!({ "description": "What a record is of: in the unit of the clearance, times \
        omega0^2 an acceleration, times k1 a force." })))]
    pub(super) quantity: Option<RecordQuantity>,
    /// The record: a CSV file beside the case, a time and a value a line below a head that names the units.
    #[schemars(example = "quake.csv")]
    #[schemars(extend("x-reduced" = json!({ "description": "The record: a CSV file beside the case, a fast time and a \
        value a line below a head without units." })))]
    pub(super) file: Option<String>,
    /// The column of the values in the file, by its name in the head or its number from 1; needed where several fit.
    #[schemars(example = &"ch3")]
    pub(super) column: Option<String>,
    /// The column of the times, by its name or number; the first unless given.
    #[schemars(example = "t (s)")]
    #[schemars(extend("x-reduced" = json!({ "examples": ["tau"] })))]
    pub(super) time_column: Option<String>,
    /// The unit of the values, where the file does not name it.
    #[schemars(example = &"g")]
    pub(super) unit: Option<String>,
    /// What becomes of a gap of more than three steps: "refuse", unless given, or "linear", a straight line.
    #[schemars(example = &"linear")]
    pub(super) gaps: Option<Gaps>,
    /// One-sided power spectral density instead of a file: frequencies in Hz that ascend, each with the density there
    /// in the squared SI unit of the quantity per Hz, or of a base acceleration as text, "0.02 g2/Hz"; straight in between
    /// on logarithmic scales, nothing outside.
    #[schemars(extend("minItems" = 2, "x-ascending" = true, "items" = corner()))]
    #[schemars(example = vec![[0.5, 0.02], [5.0, 0.02]])]
    pub(super) spectrum: Option<Vec<[f64; 2]>>,
    /// How long each record of a spectrum is, above 0.
    #[schemars(extend("x-measurand" = "a time", "exclusiveMinimum" = 0, "x-symbol" = "T"), example = "60 s")]
    pub(super) duration: Option<f64>,
    /// What the random numbers of a spectrum begin with: the same seed gives the same records.
    #[schemars(range(min = 0, max = 1_000_000_000), extend("x-symbol" = r"\mathrm{seed}"), example = 1)]
    pub(super) seed: Option<u64>,
    /// How many records are made of a spectrum, 20 unless given.
    #[schemars(range(min = 2, max = 1000), extend("x-symbol" = r"N_\mathrm{records}"), example = 20)]
    pub(super) realisations: Option<u64>,
}

/// What a number is in `[reduced]`.
fn plain(example: f64, symbol: &str, description: &str) -> Value {
    json!({
        "description": description, "examples": [example], "x-symbol": symbol, "type": "number", "format": "double",
    })
}

/// A frequency and a density, in hertz and the squared SI unit of the quantity per hertz where they have no unit.
fn corner() -> Value {
    let number = |measurand: &str, examples: Value| json!({ "type": "number", "exclusiveMinimum": 0, "x-measurand": measurand, "examples": examples });
    let frequency = number("a frequency", json!([20, "20 Hz"]));
    let density = number("a density of accelerations", json!([0.02, "0.02 g2/Hz"]));
    json!({ "type": "array", "minItems": 2, "maxItems": 2, "prefixItems": [frequency, density] })
}

/// A kind of excitation: what a case has of it.
pub(super) struct KindRow {
    kind: ExcitationKind,
    /// Where it enters, once for each that its amplitude may be of.
    enters: &'static [Excitation],
    /// Keys that it must have.
    required: &'static [&'static str],
    /// Two of which it must have one, or at least one: "oneOf" or "anyOf".
    choice: Option<(&'static str, [&'static str; 2])>,
    /// Keys that it may have, each with those that go with it.
    optional: &'static [(&'static str, &'static [&'static str])],
    /// Its lines in a case to start from, below that of `kind`.
    pub(super) lines: &'static str,
}

const BOTH: &[Excitation] = &[Excitation::BaseDisplacement, Excitation::Force];

const NO_KEYS: KindRow = KindRow {
    kind: ExcitationKind::BaseDisplacement,
    enters: &[],
    required: &[],
    choice: None,
    optional: &[],
    lines: "",
};

/// All kinds; the first is that of a case to start from.
pub(super) static KINDS: [KindRow; 6] = [
    KindRow {
        kind: ExcitationKind::BaseDisplacement,
        enters: &[Excitation::BaseDisplacement],
        required: &["amplitude", "frequency"],
        lines: "amplitude = \"0.25 mm\"\nfrequency = \"8.5 Hz\"\n",
        ..NO_KEYS
    },
    KindRow {
        kind: ExcitationKind::Force,
        enters: &[Excitation::Force],
        required: &["amplitude", "frequency"],
        lines: "amplitude = \"2.9 N\"           # on the oscillator\nfrequency = \"8.5 Hz\"\n",
        ..NO_KEYS
    },
    KindRow {
        kind: ExcitationKind::Free,
        choice: Some(("anyOf", ["displacement", "velocity"])),
        lines: "displacement = \"15 mm\"        # or velocity = \"0.2 m/s\", or both\n",
        ..NO_KEYS
    },
    KindRow {
        kind: ExcitationKind::Impulse,
        choice: Some(("oneOf", ["impulse", "velocity"])),
        lines: "impulse = \"6 N s\"             # or the velocity that the base gets at once\n",
        ..NO_KEYS
    },
    KindRow {
        kind: ExcitationKind::SineSweep,
        enters: BOTH,
        required: &["of", "amplitude", "from", "to", "rate"],
        lines: "of = \"base-displacement\"      # or \"force\"\namplitude = \"0.25 mm\"\nfrom = \"7.5 Hz\"\n\
                to = \"9 Hz\"\nrate = \"0.1 Hz/s\"             # or \"1 oct/min\"\n",
        ..NO_KEYS
    },
    KindRow {
        kind: ExcitationKind::Record,
        required: &["quantity"],
        choice: Some(("oneOf", ["file", "spectrum"])),
        optional: &[
            ("spectrum", &["duration", "seed"]),
            ("duration", &["spectrum"]),
            ("seed", &["spectrum"]),
            ("realisations", &["spectrum"]),
            ("column", &["file"]),
            ("time_column", &["file"]),
            ("rate", &["file"]),
            ("unit", &["file"]),
            ("gaps", &["file"]),
        ],
        lines: "quantity = \"base-acceleration\" # or \"base-displacement\", \"force\"\n\
                spectrum = [[5, 0.02], [12, 0.02]] # (m/s²)²/Hz over Hz; or a file = \"quake.csv\" and none of what follows\n\
                duration = \"60 s\"             # a file may need column = \"ch3\", time_column = \"t\", unit = \"g\", rate = \"2 kHz\", gaps = \"linear\"\n\
                seed = 1                      # and realisations = 20\n",
        ..NO_KEYS
    },
];

impl KindRow {
    /// Its name in a case file.
    pub(super) fn name(&self) -> &'static str {
        self.kind.name()
    }

    /// What a table of this kind must be like, its amplitude of this.
    fn branch(&self, enters: Option<Excitation>, reduced: bool) -> Value {
        let there = |key: &&str| !(reduced && ONLY_PHYSICAL.contains(key));
        let mut properties = Map::new();
        let (mut required, mut choice) = (Vec::new(), self.choice);
        for key in self.required {
            match *key {
                "amplitude" if reduced => required.push("forcing"),
                "frequency" if reduced => choice = Some(("oneOf", ["frequency_ratio", "detuning"])),
                key => required.push(key),
            }
        }
        // A spectrum has units.
        if let Some((_, keys)) = choice.filter(|(_, keys)| !keys.iter().all(there)) {
            required.extend(keys.iter().filter(|key| there(key)));
            choice = None;
        }
        let optional = || self.optional.iter().filter(|(key, _)| there(key));
        let chosen = choice.iter().flat_map(|(_, keys)| keys);
        let keys = required.iter().chain(chosen).copied().chain(optional().map(|(key, _)| *key));
        properties.extend(keys.map(|key| (key.to_owned(), json!(true))));
        if self.kind == ExcitationKind::Record {
            properties.insert("rate".into(), record_rate(reduced));
        }
        properties.insert("kind".into(), json!({ "const": self.kind }));
        if self.kind != ExcitationKind::default() {
            required.push("kind");
        }
        if let Some(enters) = enters {
            if self.required.contains(&"of") {
                properties.insert("of".into(), json!({ "const": enters }));
            }
            if !reduced {
                properties.insert("amplitude".into(), amplitude(enters));
            }
        }
        let mut branch = json!({ "properties": properties, "required": required });
        if let Some((how, [first, second])) = choice {
            branch[how] = one_of(first, second);
        }
        if optional().next().is_some() {
            branch["dependentRequired"] =
                optional().map(|(key, with)| ((*key).to_owned(), json!(with))).collect();
        }
        branch
    }
}

/// Keys that `[reduced]` says in another way, or not at all.
const ONLY_PHYSICAL: [&str; 7] =
    ["amplitude", "frequency", "spectrum", "duration", "seed", "realisations", "unit"];

/// The rate of the samples of a record, which is no sweep rate.
fn record_rate(reduced: bool) -> Value {
    match reduced {
        true => json!({
            "description": "Samples of a record in a fast time, above 0, where its file has no times.",
            "type": "number", "exclusiveMinimum": 0, "examples": [50], "x-symbol": r"f_\mathrm{s}",
        }),
        false => json!({
            "description": "Samples of a record in a second, above 0, where its file has no times.",
            "type": "number", "exclusiveMinimum": 0, "examples": ["2 kHz"], "x-measurand": "a frequency",
            "x-symbol": r"f_\mathrm{s}",
        }),
    }
}

/// The number of an amplitude of this.
fn amplitude(of: Excitation) -> Value {
    let (example, measures, symbol) = match of {
        Excitation::BaseDisplacement => ("0.25 mm", "a length", "F"),
        Excitation::Force => ("2.9 N", "a force", "P"),
    };
    json!({
        "type": "number", "examples": [example], "minimum": 0,
        "x-measurand": measures, "x-symbol": symbol,
    })
}

/// For each kind of excitation the keys that it has, and how its amplitude is written; in `[reduced]` that is its
/// forcing, and the first kind holds where none is given.
pub(super) fn keys_by_kind(reduced: bool) -> Value {
    let of_row = |row: &'static KindRow| match row.enters {
        [] => vec![row.branch(None, reduced)],
        all => all.iter().map(|enters| row.branch(Some(*enters), reduced)).collect(),
    };
    KINDS.iter().flat_map(of_row).collect()
}

/// Gives `[reduced]` the keys of an excitation.
pub(super) fn add_keys(schema: &mut Schema) {
    let own = schema_of::<ExcitationTable>();
    for key in fields::<ExcitationTable>().iter().filter(|key| !ONLY_PHYSICAL.contains(key)) {
        let mut property = own["properties"][*key].clone();
        if let Some(Value::Object(reduced)) = property.get("x-reduced").cloned() {
            let numbers = property.as_object_mut().into_iter();
            numbers.for_each(|one| {
                one.retain(|key, _| {
                    !["x-measurand", "x-reduced", "pattern"].contains(&key.as_str())
                })
            });
            property.as_object_mut().into_iter().for_each(|one| one.extend(reduced.clone()));
        }
        if *key == "kind" {
            property["default"] = json!(ExcitationKind::default());
            property["description"] =
                json!("How the oscillator is set in motion; base-displacement unless given.");
        }
        add_key(schema, key, property);
    }
}

impl ExcitationTable {
    /// Where it enters.
    pub(super) fn enters(&self) -> Excitation {
        match (self.kind, self.quantity) {
            (ExcitationKind::Force, _) | (_, Some(RecordQuantity::Force)) => Excitation::Force,
            _ => self.of.unwrap_or_default(),
        }
    }

    /// What is not steady in it, none of harmonic excitation of one frequency. `None` where something is missing or
    /// was reported. With the phase of a period in the unit of frequencies.
    pub(super) fn transient(
        &self,
        reader: &mut Reader,
        place: &Table,
        turn: f64,
    ) -> Option<Option<Transient>> {
        let found = match self.kind {
            ExcitationKind::BaseDisplacement | ExcitationKind::Force => return Some(None),
            ExcitationKind::Record => {
                reader.recording = Some(record::read(reader, place, self)?);
                return self.quantity.map(|quantity| Some(Transient::Record(quantity)));
            }
            ExcitationKind::SineSweep => {
                let written = place.value("rate").and_then(|rate| rate.get_ref().as_str());
                let rate = match written.and_then(Dimension::of) {
                    Some(Dimension::OctaveRate) => SweepRate::Octaves(self.rate?),
                    _ => SweepRate::Linear(self.rate?),
                };
                Transient::Sweep(SineSweep { from: self.from?, to: self.to?, rate, turn })
            }
            ExcitationKind::Free | ExcitationKind::Impulse => {
                let given = [self.displacement, self.velocity, self.impulse];
                // A number that could not be read was reported.
                let unread = |(key, value): (&str, Option<f64>)| value.is_none() && place.has(key);
                if ["displacement", "velocity", "impulse"].into_iter().zip(given).any(unread) {
                    return None;
                }
                let [displacement, velocity, _] = given.map(Option::unwrap_or_default);
                Transient::Release(match (self.kind, self.impulse) {
                    (ExcitationKind::Free, _) => Release::LetGo { displacement, velocity },
                    (_, Some(impulse)) => Release::Struck { impulse },
                    _ => Release::BaseMoves { velocity },
                })
            }
        };
        // Let go from 0, in so many words: an absorber may be kicked all the same.
        let is_still =
            matches!(found, Transient::Release(of @ Release::LetGo { .. }) if of.is_rest());
        if is_still && place.has("displacement") {
            return Some(Some(found));
        }
        let Some((message, expected, help)) = impossible(&found) else { return Some(Some(found)) };
        reader.report(place.span.clone(), message, expected, help);
        None
    }
}

/// Why an excitation whose numbers are each valid cannot be: message, what was expected, help.
pub(super) fn impossible(transient: &Transient) -> Option<(String, String, &'static str)> {
    match transient {
        Transient::Release(release) if release.is_rest() => Some((
            "nothing sets the oscillator in motion".into(),
            "expected a displacement, a velocity or an impulse above 0".into(),
            "to let it go takes `displacement` or `velocity` above 0, a shock `impulse` or `velocity`",
        )),
        Transient::Sweep(sweep) if sweep.fastest_change() > SineSweep::LARGEST_CHANGE => Some((
            match 100.0 * sweep.fastest_change() {
                told if told < 1e6 => format!("the frequency changes by {told:.3} % in a period"),
                _ => "the frequency changes by more than 1e6 % in a period".into(),
            },
            format!("expected at most {} %", 100.0 * SineSweep::LARGEST_CHANGE),
            "choose a lower `rate`: so fast a change is a shock, not a sweep",
        )),
        Transient::Sweep(sweep) if sweep.count() < SineSweep::FEWEST => Some((
            format!("the sweep has {} whole periods", sweep.count()),
            format!("expected at least {}", SineSweep::FEWEST),
            "choose `from` and `to` further apart, or a lower `rate`",
        )),
        Transient::Release(_) | Transient::Sweep(_) | Transient::Record(_) => None,
    }
}
